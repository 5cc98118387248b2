/* fram pressure: ice pressure on a hull by panel. */
#include "cli/cli.h"

#include "fram/results.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Coordinates as "-4,-2,0.5" and "FIRST:SPACING:LAST", in any mixture. */
typedef struct line_list {
    double value[FRAM_PRESSURE_LINES];
    int count;
} line_list;

static bool add_line(line_list *list, double value)
{
    if (list->count == FRAM_PRESSURE_LINES || !isfinite(value))
        return false;
    list->value[list->count++] = value;
    return true;
}

/* One number or three, up to the comma or the end, where *text is left; false: no such thing. */
static bool read_item(const char **text, line_list *list)
{
    double value[3];
    int count = 0;
    do {
        if (count == 3 || !take_number(text, ":,", &value[count++], NULL))
            return false;
    } while (*(*text) == ':' && (*text)++);
    if (count == 2)
        return false;
    if (count == 1)
        return add_line(list, value[0]);
    double steps = floor((value[2] - value[0]) / value[1] * (1 + 1e-12) + 1e-9);
    if (!(value[1] > 0 && steps >= 0 && steps < FRAM_PRESSURE_LINES))
        return false;
    bool good = true;
    for (int i = 0; i <= (int)steps && good; i++)
        good = add_line(list, value[0] + i * value[1]);
    return good;
}

static bool read_lines(const char *text, line_list *list)
{
    while (read_item(&text, list)) {
        if (!*text)
            return true;
        text++;
    }
    return false;
}

static int compute(const common_options *common, const char *run, const fram_pressure_definition *d)
{
    work_view work;
    fram_context *context = NULL;
    fram_error error = {0};
    int code = session_open_reading(common, &work, &context);
    if (code >= 0)
        return code;
    code = fram_pressure(context, run, d, &error) == FRAM_OK ? EXIT_GOOD : answer_error(common, &error);
    if (code == EXIT_GOOD && !common->quiet)
        tell(stderr, "%s: panels.csv, area.csv, zones.csv, hull.vtp, pressure.fram, pressure.png\n", d->output);
    if (code == EXIT_GOOD && common->json) {
        json j = json_begin();
        json_text(&j, "folder", d->output);
        json_end(&j);
    }
    fram_context_destroy(context);
    return code;
}

int command_pressure(const command_row *self, int argc, char **argv)
{
    common_options common;
    const char *run = NULL, *frames = NULL, *stringers = NULL;
    fram_pressure_definition d;
    fram_pressure_default(&d);
    const option_row rows[] = {
        {"--output", "-o", OPTION_TEXT, &d.output, "DIR", "folder for the results (required)"},
        {"--panel", NULL, OPTION_REAL, &d.panel, "M", "side of a panel [m] (1 at full size, times run.scale/30)"},
        {"--frames", NULL, OPTION_TEXT, &frames, "LIST",
         "x of frames instead of every M: coordinates or FIRST:SPACING:LAST, separated by commas [m]"},
        {"--stringers", NULL, OPTION_TEXT, &stringers, "LIST", "z of stringers, in the same way [m]"},
        {"--from", NULL, OPTION_REAL, &d.from, "T", "start after this time [s] (0)"},
        {"--to", NULL, OPTION_SIZE, &d.to, "T", "stop at this time [s] (the end of the run)"},
        {"--vessel", NULL, OPTION_TEXT, &d.vessel, "NAME", "of several vessels: whose hull (the first)"},
    };
    int code = options_read(self, rows, sizeof rows / sizeof *rows, &common, argc, argv, &run, 1);
    if (code >= 0)
        return code;
    if (!d.output)
        return answer_usage(&common, "--output", "is missing: name the folder for the results, -o DIR");
    char wanted[120];
    snprintf(wanted, sizeof wanted, "expected coordinates like -4,-2,0.5 or FIRST:SPACING:LAST, %d at most",
             FRAM_PRESSURE_LINES);
    line_list *lines = calloc(2, sizeof *lines);
    if (!lines)
        return answer_memory(&common);
    if (frames && !read_lines(frames, &lines[0]))
        code = answer_usage(&common, "--frames", wanted);
    else if (stringers && !read_lines(stringers, &lines[1]))
        code = answer_usage(&common, "--stringers", wanted);
    d.frames = lines[0].value;
    d.frame_count = lines[0].count;
    d.stringers = lines[1].value;
    d.stringer_count = lines[1].count;
    d.stop = session_stop_flag();
    d.force = common.force;
    if (code < 0)
        code = compute(&common, run, &d);
    free(lines);
    return code;
}
