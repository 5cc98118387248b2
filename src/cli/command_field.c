/* fram field: an ice field from a file; what it is, a drawing, a file. */
#include "cli/cli.h"

#include "fram/field.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Notes that are printed for people; JSON has all. */
enum { NOTES_SHOWN = 12 };

/* What the words say. */
typedef struct field_words {
    const char *path;
    fram_field_definition field;
    const char *crop, *bad;
    const char *draw, *output;
} field_words;

static int read_words(const command_row *self, field_words *w, common_options *common, int argc, char **argv)
{
    const option_row rows[] = {
        {"--scale", NULL, OPTION_REAL, &w->field.scale, "S", "lengths of the file times this are metres, 1"},
        {"--centre", NULL, OPTION_FLAG, &w->field.centre, NULL, "put the centre of the field at (x, y) = (0, 0)"},
        {"--x", NULL, OPTION_REAL, &w->field.offset[0], "X", "move the field by this [m], 0"},
        {"--y", NULL, OPTION_REAL, &w->field.offset[1], "Y", "move the field by this [m], 0"},
        {"--crop", NULL, OPTION_TEXT, &w->crop, "X0,Y0,X1,Y1", "cut floes at the edge of this window [m]"},
        {"--simplify", NULL, OPTION_REAL, &w->field.simplify, "T", "leave out vertices, moving no edge by more [m], 0"},
        {"--smallest", NULL, OPTION_REAL, &w->field.smallest_area, "A", "leave out smaller floes and pieces [m2], 0"},
        {"--bad", NULL, OPTION_TEXT, &w->bad, "refuse|drop|repair",
         "rings that are no simple outlines: refuse the file, leave them out, mend them; refuse"},
        {"--draw", NULL, OPTION_TEXT, &w->draw, "FILE.png", "draw the field from above"},
        {"--output", "-o", OPTION_TEXT, &w->output, "FILE.geojson", "write the floes; numbers read back to the bit"},
    };
    return options_read(self, rows, sizeof rows / sizeof *rows, common, argc, argv, &w->path, 1);
}

static bool read_crop(field_words *w)
{
    double value[4];
    const char *at = w->crop;
    for (int k = 0; k < 4; k++) {
        char *end;
        value[k] = strtod(at, &end);
        if (end == at || !isfinite(value[k]) || *end != (k < 3 ? ',' : '\0'))
            return false;
        at = end + 1;
    }
    w->field.crop = true;
    for (int k = 0; k < 2; k++) {
        w->field.crop_lo[k] = value[k];
        w->field.crop_hi[k] = value[k + 2];
    }
    return value[0] < value[2] && value[1] < value[3];
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

static const char *title_of(const field_words *w)
{
    const char *slash = strrchr(w->path, '/');
    return slash ? slash + 1 : w->path;
}

/* ---- answers ---- */

static void print_summary(const field_words *w, const fram_field_summary *s)
{
    printf("%s: %d floes of %d rings\n", title_of(w), s->floes, s->rings);
    printf("  %d vertices, %d floes concave\n", s->vertices, s->concave);
    printf("  x from %.6g to %.6g m, y from %.6g to %.6g m\n", s->lo[0], s->hi[0], s->lo[1], s->hi[1]);
    printf("  ice of %.6g m2, concentration %.2f %% of %s\n", s->area, 100 * s->concentration,
           w->crop ? "the window" : "the box around it");
    printf("  floes of %.4g to %.6g m2, the largest %.4g m across\n", s->smallest_area, s->largest_area,
           s->largest_diameter);
    printf("  diameter of equal area   floes\n");
    for (int i = 0; i < FRAM_FIELD_BINS; i++)
        if (s->bin[i] > 0)
            printf("    %8.4g to %8.4g m %6d\n", s->bin_edge[i], s->bin_edge[i + 1], s->bin[i]);
    if (s->overlaps)
        printf("  overlaps: %d pairs share %.4g m2, at most %.4g m wide; the most, features %d and %d\n", s->overlaps,
               s->overlap_area, s->overlap_width, s->overlap_features[0], s->overlap_features[1]);
    else
        printf("  no overlaps\n");
    printf("  left out: %d, repaired: %d\n", s->dropped, s->repaired);
}

static void print_notes(const fram_field_note *notes, int count)
{
    for (int i = 0; i < count && i < NOTES_SHOWN; i++)
        printf("    %s: feature %d, polygon %d, ring %d (line %d): %s\n", notes[i].dropped ? "left out" : "repaired",
               notes[i].feature, notes[i].polygon, notes[i].ring, notes[i].line, notes[i].reason);
    if (count > NOTES_SHOWN)
        printf("    and %d more; --json lists all\n", count - NOTES_SHOWN);
}

static void json_notes(json *j, const char *key, bool dropped, const fram_field_note *notes, int count)
{
    json_open_list(j, key);
    for (int i = 0; i < count; i++) {
        if (notes[i].dropped != dropped)
            continue;
        json_open(j, NULL);
        json_integer(j, "feature", notes[i].feature);
        json_integer(j, "polygon", notes[i].polygon);
        json_integer(j, "ring", notes[i].ring);
        json_integer(j, "line", notes[i].line);
        json_text(j, "reason", notes[i].reason);
        json_close(j);
    }
    json_close_list(j);
}

static void print_json(const field_words *w, const fram_field_summary *s, const fram_field_note *notes, int count)
{
    const double bounds[4] = {s->lo[0], s->lo[1], s->hi[0], s->hi[1]};
    double bins[FRAM_FIELD_BINS];
    for (int i = 0; i < FRAM_FIELD_BINS; i++)
        bins[i] = s->bin[i];
    json j = json_begin();
    json_text(&j, "field", w->path);
    json_integer(&j, "rings", s->rings);
    json_integer(&j, "floes", s->floes);
    json_real(&j, "area_m2", s->area);
    json_real(&j, "concentration", s->concentration);
    json_reals(&j, "bounds_m", bounds, 4);
    json_integer(&j, "vertices", s->vertices);
    json_integer(&j, "concave", s->concave);
    json_real(&j, "largest_diameter_m", s->largest_diameter);
    json_real(&j, "smallest_area_m2", s->smallest_area);
    json_real(&j, "largest_area_m2", s->largest_area);
    json_open(&j, "overlap");
    json_integer(&j, "pairs", s->overlaps);
    json_real(&j, "area_m2", s->overlap_area);
    json_real(&j, "largest_width_m", s->overlap_width);
    json_integer(&j, "feature_a", s->overlap_features[0]);
    json_integer(&j, "feature_b", s->overlap_features[1]);
    json_close(&j);
    json_open(&j, "histogram");
    json_reals(&j, "diameter_edges_m", s->bin_edge, FRAM_FIELD_BINS + 1);
    json_reals(&j, "floes", bins, FRAM_FIELD_BINS);
    json_close(&j);
    json_notes(&j, "dropped", true, notes, count);
    json_notes(&j, "repaired", false, notes, count);
    if (w->draw)
        json_text(&j, "drawing", w->draw);
    if (w->output)
        json_text(&j, "written", w->output);
    json_end(&j);
}

/* ---- the command ---- */

static int answer(const field_words *w, const common_options *common, const fram_field *field)
{
    fram_field_summary summary;
    fram_field_summary_get(field, &summary);
    int count = fram_field_notes(field, NULL, 0);
    fram_field_note *notes = calloc((size_t)count + 1, sizeof *notes);
    if (!notes)
        return answer_error(common, &(fram_error){.status = FRAM_ERROR_MEMORY, .message = "out of memory"});
    fram_field_notes(field, notes, count);
    if (common->json) {
        print_json(w, &summary, notes, count);
    } else {
        print_summary(w, &summary);
        print_notes(notes, count);
    }
    free(notes);
    return EXIT_GOOD;
}

int command_field(const command_row *self, int argc, char **argv)
{
    common_options common;
    field_words w = {.path = NULL};
    fram_field_default(&w.field);
    int code = read_words(self, &w, &common, argc, argv);
    if (code >= 0)
        return code;
    if (w.crop && !read_crop(&w))
        return answer_usage(&common, "--crop", "expected X0,Y0,X1,Y1 in metres, with X0 < X1 and Y0 < Y1");
    if (w.bad && !read_bad(&w))
        return answer_usage(&common, "--bad", "expected refuse, drop or repair");
    fram_context *context = NULL;
    code = session_open(&common, &context);
    if (code >= 0)
        return code;

    fram_field *field = NULL;
    fram_error error = {0};
    fram_status status = fram_field_load(context, w.path, &w.field, &field, &error);
    if (status == FRAM_OK && w.draw)
        status = fram_field_draw(field, title_of(&w), w.draw, &error);
    if (status == FRAM_OK && w.output)
        status = fram_field_save(field, w.output, &error);
    code = status == FRAM_OK ? answer(&w, &common, field) : answer_error(&common, &error);
    fram_field_destroy(field);
    fram_context_destroy(context);
    return code;
}
