/* fram report, plot, compare and video: results for people. */
#include "cli/cli.h"

#include "fram/results.h"
#include <math.h>
#include <string.h>

static void print_file(const common_options *common, const char *path, const char *advice)
{
    if (!common->quiet)
        tell(stderr, "%s%s\n", path, advice);
    if (!common->json)
        return;
    json j = json_begin();
    json_text(&j, "file", path);
    json_end(&j);
}

int command_report(const command_row *self, int argc, char **argv)
{
    common_options common;
    const char *run = NULL, *output = NULL;
    bool with_paths = false;
    const option_row rows[] = {
        {"--output", "-o", OPTION_TEXT, &output, "FILE", "the page (RUN/report.html)"},
        {"--with-paths", NULL, OPTION_FLAG, &with_paths, NULL,
         "show the full paths of input files, not only their names"},
    };
    int code = options_read(self, rows, sizeof rows / sizeof *rows, &common, argc, argv, &run, 1);
    if (code >= 0)
        return code;
    const command_files files = {.runs = {run}, .outputs = {{"--output", output, PAGE_ENDINGS}}};
    work_view work;
    fram_context *context = NULL;
    code = session_open_files(&common, &files, SESSION_MAKES, &work, &context);
    if (code >= 0)
        return code;
    fram_result result = {0};
    fram_error error = {0};
    if (fram_report(context, run, output, with_paths, &result, &error) != FRAM_OK) {
        code = answer_error(&common, &error);
    } else {
        code = EXIT_GOOD;
        print_file(&common, result.path, ": open it in a browser, or print it");
    }
    fram_context_destroy(context);
    return code;
}

/* ---- plot ---- */

/* "name [unit]" of each line as an object. */
static void json_channels(char *text)
{
    json j = json_begin();
    json_open_list(&j, "channels");
    for (char *line = text, *end; (end = strchr(line, '\n')) != NULL; line = end + 1) {
        *end = '\0';
        char *unit = strstr(line, " [");
        size_t length = unit ? strlen(unit) : 0;
        json_open(&j, NULL);
        if (length > 2) {
            unit[length - 1] = '\0';
            *unit = '\0';
        }
        json_text(&j, "name", line);
        json_text(&j, "unit", length > 2 ? unit + 2 : "");
        json_close(&j);
    }
    json_close_list(&j);
    json_end(&j);
}

static fram_status list_channels(const common_options *common, fram_context *context, const char *run,
                                 fram_error *error)
{
    char *text = NULL;
    fram_status status = fram_channels(context, run, &text, error);
    if (status == FRAM_OK && common->json)
        json_channels(text);
    else if (status == FRAM_OK)
        put_shown(stdout, text);
    fram_text_free(context, text);
    return status;
}

int command_plot(const command_row *self, int argc, char **argv)
{
    common_options common;
    const char *word[1 + FRAM_PLOT_CHANNELS] = {NULL}, *output = NULL;
    double from = (double)NAN, to = (double)NAN;
    const option_row rows[] = {
        {"--output", "-o", OPTION_TEXT, &output, "FILE", "the plot, .png or .svg (required with channels)"},
        {"--from", NULL, OPTION_REAL, &from, "T", "begin at this time [s]"},
        {"--to", NULL, OPTION_REAL, &to, "T", "end at this time [s]"},
    };
    int code =
        options_read_some(self, rows, sizeof rows / sizeof *rows, &common, argc, argv, word, 1, 1 + FRAM_PLOT_CHANNELS);
    if (code >= 0)
        return code;
    int count = 0;
    while (count < FRAM_PLOT_CHANNELS && word[1 + count])
        count++;
    if (count > 0 && !output)
        return answer_usage(&common, "--output", "is missing: name the picture, -o FILE.png or FILE.svg");
    if (count == 0 && output)
        return answer_usage(&common, "CHANNEL", "is missing: name what to draw; without -o the channels are listed");
    const command_files files = {.runs = {word[0]}, .outputs = {{"--output", output, PICTURE_ENDINGS}}};
    work_view work;
    fram_context *context = NULL;
    code = session_open_files(&common, &files, session_kind_for(output), &work, &context);
    if (code >= 0)
        return code;
    fram_error error = {0};
    fram_status status = count == 0 ? list_channels(&common, context, word[0], &error)
                                    : fram_plot(context, word[0], word + 1, count, from, to, output, &error);
    code = status == FRAM_OK ? EXIT_GOOD : answer_error(&common, &error);
    if (status == FRAM_OK && count > 0)
        print_file(&common, output, "");
    fram_context_destroy(context);
    return code;
}

/* ---- compare ---- */

/* Of two numbers their difference is rounding where it is less than this part of them. */
#define DIFFERENCE_LEAST 1e-12

/* Lengths from here on are places far from the origin, of which six digits would not tell the decimetre [m]. */
#define FAR_LENGTH 1e5

/* A dash where a run has no such number. */
static void print_number(double x, const char *unit, int digits)
{
    if (isfinite(x) && fabs(x) >= FAR_LENGTH && strcmp(unit, "m") == 0)
        printf(" %14.1f", x);
    else if (isfinite(x))
        printf(" %14.*g", digits, x);
    else
        printf(" %14s", "-");
}

enum { COMPARED_NAME_ROOM = 136 };

static int compared_name(const fram_comparison_row *row, char out[COMPARED_NAME_ROOM])
{
    return snprintf(out, COMPARED_NAME_ROOM, row->unit[0] ? "%s [%s]" : "%s%s", row->name, row->unit);
}

static void print_compared(const fram_comparison *c)
{
    char heading[64] = "after the transient", name[COMPARED_NAME_ROOM];
    if (c->counted_from > 0)
        snprintf(heading, sizeof heading, "after %.6g s, of what both recorded", c->counted_from);
    int width = (int)strlen(heading);
    for (int i = 0; i < c->count; i++) {
        int length = compared_name(&c->rows[i], name);
        width = length > width ? length : width;
    }
    printf("%-*s %14s %14s %14s\n", width, heading, "A", "B", "B - A");
    for (int i = 0; i < c->count; i++) {
        const fram_comparison_row *row = &c->rows[i];
        compared_name(row, name);
        tell(stdout, "%-*s", width, name);
        print_number(row->a, row->unit, 6);
        print_number(row->b, row->unit, 6);
        const double difference = row->b - row->a;
        const bool is_rounding = fabs(difference) < DIFFERENCE_LEAST * fmax(fabs(row->a), fabs(row->b));
        print_number(is_rounding ? 0 : difference, row->unit, 4);
        putchar('\n');
    }
    if (c->no_time_shared)
        printf("nothing is of both after their transients and the beginnings of their recordings (from %.6g s on)\n",
               c->counted_from);
    if (c->told_a[0])
        printf("told A by a program, in place of its scenario's: %s\n", c->told_a);
    if (c->told_b[0])
        printf("told B by a program, in place of its scenario's: %s\n", c->told_b);
    /* What is read of a changed scenario may be the same where what was run was not. */
    bool read = c->same_as_read || c->only_files_differ || c->only_told_differs;
    printf("scenarios: %s%s; final states: %s\n",
           c->same_scenario       ? "the same"
           : c->same_as_read      ? "the same, as this Fram reads them"
           : c->only_files_differ ? "the same but for the files that they name"
           : c->only_told_differs ? "the same but for what a program told"
                                  : "different",
           read && (c->changed_a || c->changed_b) ? ", or scenario.yaml was changed since" : "",
           c->same_state ? "identical to the bit" : "different");
}

static void print_comparison(const common_options *common, const fram_comparison *c, const char *output)
{
    if (!common->json) {
        print_compared(c);
        if (output && !common->quiet)
            tell(stderr, "%s: open it in a browser\n", output);
        return;
    }
    json j = json_begin();
    json_boolean(&j, "same_scenario", c->same_scenario);
    json_boolean(&j, "same_as_read", c->same_as_read);
    json_boolean(&j, "only_files_differ", c->only_files_differ);
    json_boolean(&j, "only_told_differs", c->only_told_differs);
    json_boolean(&j, "changed_a", c->changed_a);
    json_boolean(&j, "changed_b", c->changed_b);
    json_boolean(&j, "same_state", c->same_state);
    json_text(&j, "told_a", c->told_a);
    json_text(&j, "told_b", c->told_b);
    json_real(&j, "counted_from", c->counted_from);
    json_boolean(&j, "no_time_shared", c->no_time_shared);
    json_open_list(&j, "rows");
    for (int i = 0; i < c->count; i++) {
        json_open(&j, NULL);
        json_text(&j, "name", c->rows[i].name);
        json_text(&j, "unit", c->rows[i].unit);
        json_real(&j, "a", c->rows[i].a);
        json_real(&j, "b", c->rows[i].b);
        json_close(&j);
    }
    json_close_list(&j);
    json_end(&j);
}

int command_compare(const command_row *self, int argc, char **argv)
{
    common_options common;
    const char *run[2] = {NULL, NULL}, *output = NULL;
    const option_row rows[] = {
        {"--output", "-o", OPTION_TEXT, &output, "FILE", "also a page with plots of both, .html"},
    };
    int code = options_read(self, rows, sizeof rows / sizeof *rows, &common, argc, argv, run, 2);
    if (code >= 0)
        return code;
    const command_files files = {.runs = {run[0], run[1]}, .outputs = {{"--output", output, PAGE_ENDINGS}}};
    work_view work;
    fram_context *context = NULL;
    code = session_open_files(&common, &files, session_kind_for(output), &work, &context);
    if (code >= 0)
        return code;
    fram_comparison comparison;
    fram_error error = {0};
    if (fram_compare(context, run[0], run[1], output, &comparison, &error) != FRAM_OK) {
        code = answer_error(&common, &error);
    } else {
        code = EXIT_GOOD;
        print_comparison(&common, &comparison, output);
        fram_comparison_free(context, &comparison);
    }
    fram_context_destroy(context);
    return code;
}

/* ---- video ---- */

int command_video(const command_row *self, int argc, char **argv)
{
    common_options common;
    const char *run = NULL;
    fram_video_definition d;
    fram_video_default(&d);
    const option_row rows[] = {
        {"--output", "-o", OPTION_TEXT, &d.output, "FILE",
         "the video (RUN/run.mp4), or the folder of --pictures (RUN/video)"},
        {"--colour", NULL, OPTION_TEXT, &d.colour, "NAME", "plain, speed (default), force, thickness or age"},
        {"--speed", NULL, OPTION_SIZE, &d.speed, "X", "simulated seconds per second (so that it lasts 30 s at most)"},
        {"--camera", NULL, OPTION_TEXT, &d.camera, "NAME",
         "orbit (default), follow (the vessel), or plan (from above)"},
        {"--span", NULL, OPTION_SIZE, &d.span, "M", "plan camera: follow the vessel, M metres across"},
        {"--fps", NULL, OPTION_INTEGER, &d.frames_per_second, "N", "frames per second (25)"},
        {"--width", NULL, OPTION_INTEGER, &d.width, "PX", "width of the picture [pixels] (1280)"},
        {"--height", NULL, OPTION_INTEGER, &d.height, "PX", "height of the picture [pixels] (720)"},
        {"--pictures", NULL, OPTION_FLAG, &d.pictures, NULL, "numbered PNG files instead; needs no ffmpeg"},
    };
    int code = options_read(self, rows, sizeof rows / sizeof *rows, &common, argc, argv, &run, 1);
    if (code >= 0)
        return code;
    d.force = common.force;
    const command_files files = {.runs = {run},
                                 .outputs = {{"--output", d.output, d.pictures ? FOLDER_OUTPUT : VIDEO_ENDINGS}}};
    work_view work;
    fram_context *context = NULL;
    code = session_open_files(&common, &files, SESSION_MAKES, &work, &context);
    if (code >= 0)
        return code;
    fram_result result = {0};
    fram_error error = {0};
    if (fram_video(context, run, &d, &result, &error) != FRAM_OK) {
        code = answer_error(&common, &error);
    } else {
        code = EXIT_GOOD;
        print_file(&common, result.path, "");
    }
    fram_context_destroy(context);
    return code;
}
