/* fram field: an ice field from a file or of a scenario; what it is, drawings, files. */
#include "cli/field_words.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static int read_field_words(const command_row *self, field_words *w, common_options *common, int argc, char **argv)
{
    const option_row rows[] = {
        {"--scale", NULL, OPTION_REAL, &w->field.scale, "S", "factor from the lengths of the file to metres (1)"},
        {"--degrees", NULL, OPTION_FLAG, &w->field.degrees, NULL,
         "coordinates are longitude and latitude; project them about the centre of the field"},
        {"--centre", NULL, OPTION_FLAG, &w->field.centre, NULL, "put the centre of the field at (x, y) = (0, 0)"},
        {"--x", NULL, OPTION_REAL, &w->field.offset[0], "X", "shift the field by this [m] (0)"},
        {"--y", NULL, OPTION_REAL, &w->field.offset[1], "Y", "shift the field by this [m] (0)"},
        {"--crop", NULL, OPTION_TEXT, &w->crop, "X0,Y0,X1,Y1", "clip floes to this window [m]"},
        {"--simplify", NULL, OPTION_REAL, &w->field.simplify, "T",
         "remove vertices; no edge moves by more than this [m] (0)"},
        {"--smallest", NULL, OPTION_REAL, &w->field.smallest_area, "A",
         "discard floes and pieces smaller than this [m2] (0)"},
        {"--bad", NULL, OPTION_TEXT, &w->bad, "refuse|drop|repair",
         "rings that are not simple: refuse the file, drop them, or repair them (refuse)"},
        {"--set", NULL, OPTION_LIST, &w->overrides, "KEY=VALUE", "override a scenario key; may be repeated"},
        {"--window", NULL, OPTION_LIST, &w->window_words, "X0,Y0,X1,Y1",
         "report the concentration in this window [m]; may be repeated"},
        {"--draw", NULL, OPTION_TEXT, &w->draw, "FILE", "draw the field from above, .png or .svg"},
        {"--cover", NULL, OPTION_TEXT, &w->cover, "FILE",
         "draw the concentration on a grid of square cells, .png or .svg"},
        {"--cell", NULL, OPTION_SIZE, &w->cell, "L", "side of a cell [m] (about a fortieth of the field)"},
        {"--table", NULL, OPTION_TEXT, &w->table, "FILE.csv",
         "write one row per floe, with the shape and size it was drawn from"},
        {"--output", "-o", OPTION_TEXT, &w->output, "FILE.geojson", "write the floes; numbers read back to the bit"},
    };
    return options_read(self, rows, sizeof rows / sizeof *rows, common, argc, argv, &w->path, 1);
}

/* X0,Y0,X1,Y1 */
static bool read_window(const char *text, double lo[2], double hi[2])
{
    double value[4];
    const char *at = text;
    for (int k = 0; k < 4; k++) {
        if (!take_number(&at, ",", &value[k], NULL) || *at != (k < 3 ? ',' : '\0'))
            return false;
        at++;
    }
    for (int k = 0; k < 2; k++) {
        lo[k] = value[k];
        hi[k] = value[k + 2];
    }
    return lo[0] < hi[0] && lo[1] < hi[1];
}

static bool read_windows(field_words *w)
{
    for (w->windows = 0; w->windows < w->window_words.count; w->windows++)
        if (!read_window(w->window_words.value[w->windows], w->window[w->windows].lo, w->window[w->windows].hi))
            return false;
    return true;
}

static bool read_bad(field_words *w)
{
    static const char *const names[] = {"refuse", "drop", "repair"};
    for (int k = 0; k < 3; k++) {
        if (strcmp(w->bad, names[k]) == 0) {
            w->field.bad = (fram_field_bad)k;
            return true;
        }
    }
    return false;
}

/* NULL, or an option that has nothing to act on. */
static const char *misplaced_option(const field_words *w)
{
    const fram_field_definition *f = &w->field;
    if (!w->scenario)
        return w->overrides.count > 0 ? "--set" : NULL;
    if (f->lengths)
        return "--scale";
    if (f->degrees)
        return "--degrees";
    if (f->centre)
        return "--centre";
    if (f->offset[0] != 0 || f->offset[1] != 0)
        return f->offset[0] != 0 ? "--x" : "--y";
    if (w->crop)
        return "--crop";
    if (f->simplify != 0)
        return "--simplify";
    if (f->smallest_area != 0)
        return "--smallest";
    return w->bad ? "--bad" : NULL;
}

/* ---- the command ---- */

static command_files files_of(const field_words *w)
{
    return (command_files){.inputs = {w->path},
                           .outputs = {{"--draw", w->draw, PICTURE_ENDINGS},
                                       {"--cover", w->cover, PICTURE_ENDINGS},
                                       {"--table", w->table, TABLE_ENDINGS},
                                       {"--output", w->output, "geojson json"}}};
}

/* Words that contradict themselves: an exit code, -1 to go on. */
static int check_field_words(const common_options *common, field_words *w)
{
    w->scenario = field_is_scenario(w->path);
    const char *misplaced = misplaced_option(w);
    if (misplaced)
        return answer_usage(common, misplaced,
                            w->scenario ? "is for files of outlines; a scenario has keys for it"
                                        : "is for scenarios, which are .yaml, .yml or .json");
    if (w->crop && !read_window(w->crop, w->field.crop_lo, w->field.crop_hi))
        return answer_usage(common, "--crop", "expected X0,Y0,X1,Y1 in metres, with X0 < X1 and Y0 < Y1");
    w->field.crop = w->crop != NULL;
    if (!read_windows(w))
        return answer_usage(common, "--window", "expected X0,Y0,X1,Y1 in metres, with X0 < X1 and Y0 < Y1");
    if (w->bad && !read_bad(w))
        return answer_usage(common, "--bad", "expected refuse, drop or repair");
    if (w->cell != 0 && !w->cover)
        return answer_usage(common, "--cell", "is the size of the cells of --cover FILE, which is missing");
    const command_files files = files_of(w);
    return refuse_outputs(common, &files);
}

/* -1, or an exit code, told. */
static int generate_field(fram_context *context, const common_options *common, const field_words *w, fram_field **field)
{
    const command_files files = files_of(w);
    fram_scenario *scenario = NULL;
    fram_error error = {0};
    int code = -1;
    fram_status status =
        fram_scenario_load(context, w->path, w->overrides.value, w->overrides.count, &scenario, &error);
    if (status == FRAM_OK)
        code = refuse_scenario_files(common, &files, scenario);
    if (status == FRAM_OK && code < 0)
        status = fram_field_generate(scenario, field, &error);
    fram_scenario_destroy(scenario);
    return status == FRAM_OK ? code : answer_error(common, &error);
}

/* Of what says where floes lie the library names members of its definition. */
static void name_options(fram_error *error)
{
    static const char members[] = "look at scale, offset and crop";
    char *at = strstr(error->message, members);
    if (at)
        snprintf(at, sizeof error->message - (size_t)(at - error->message), "look at --scale, --x, --y and --crop");
}

static int make_field(fram_context *context, const common_options *common, const field_words *w, fram_field **field)
{
    fram_error error = {0};
    if (w->scenario)
        return generate_field(context, common, w, field);
    fram_status status = fram_field_load(context, w->path, &w->field, field, &error);
    if (status == FRAM_OK)
        return -1;
    name_options(&error);
    return answer_error(common, &error);
}

static fram_status write_files(const field_words *w, const fram_field *field, fram_error *error)
{
    fram_status status = FRAM_OK;
    /* First, for its cells may be refused: then nothing is written. */
    if (w->cover)
        status = fram_field_draw_cover(field, w->cell, field_title(w), w->cover, error);
    if (status == FRAM_OK && w->draw)
        status = fram_field_draw(field, field_title(w), w->draw, error);
    if (status == FRAM_OK && w->table)
        status = fram_field_table(field, w->table, error);
    if (status == FRAM_OK && w->output)
        status = fram_field_save(field, w->output, error);
    return status;
}

int command_field(const command_row *self, int argc, char **argv)
{
    common_options common;
    field_words w = {.path = NULL};
    fram_field_default(&w.field);
    const double usual = w.field.scale;
    w.field.scale = (double)NAN;
    int code = read_field_words(self, &w, &common, argc, argv);
    w.field.lengths = !isnan(w.field.scale);
    if (!w.field.lengths)
        w.field.scale = usual;
    if (code < 0)
        code = check_field_words(&common, &w);
    if (code >= 0)
        return code;
    work_view work;
    fram_context *context = NULL;
    code = session_open_making(&common, &work, &context);
    if (code >= 0)
        return code;

    fram_field *field = NULL;
    fram_error error = {0};
    code = make_field(context, &common, &w, &field);
    if (code < 0 && write_files(&w, field, &error) != FRAM_OK)
        code = answer_error(&common, &error);
    if (code < 0)
        code = field_answer(&w, &common, field);
    fram_field_destroy(field);
    fram_context_destroy(context);
    return code;
}
