/* Exports, reports and pictures of the public API. */
#include "fram/results.h"

#include "api/arguments.h"
#include "api/handles.h"
#include "io/fill.h"
#include "io/folder.h"
#include "io/path.h"
#include "results/export.h"
#include "results/manage.h"
#include "results/plot.h"
#include "results/report.h"
#include "results/video.h"
#include "sim/capability.h"
#include "sim/notes.h"

#include <string.h>

/* Bounds of what a caller may ask for, far beyond every use: simulated seconds a second, metres across. */
#define SPEED_MOST 1e9
#define SPAN_MOST 1e7

_Static_assert((int)FRAM_PATH_ROOM == (int)PATH_ROOM, "one size of paths");
_Static_assert((int)FRAM_PLOT_CHANNELS == (int)PLOT_CHANNELS_MOST, "one number of channels");

static fram_status answer(fram_status status, const export_report *from, fram_result *to, size_t size)
{
    if (status == FRAM_OK) {
        fram_result full = {.frames = from->frames, .time = from->time};
        memcpy(full.path, from->path, sizeof full.path);
        result_give(to, size, &full);
    }
    return status;
}

fram_status(fram_export_vtk)(fram_context *c, const char *run, const char *output, int64_t every, fram_result *result,
                             fram_error *error, size_t size)
{
    export_report report;
    fram_status status = REFUSE_NULL(error, {"context", c}, {"run", run});
    if (status == FRAM_OK)
        status = RESULT_CHECK(result, size, fram_result, error);
    if (status == FRAM_OK && every < 1)
        status =
            error_set(error, FRAM_ERROR_USAGE, NULL, 0, "every", "expected 1 or more, found %lld", (long long)every);
    if (status != FRAM_OK)
        return status;
    return answer(export_vtk(&c->inner, run, output, every, &report, error), &report, result, size);
}

fram_status(fram_export_geojson)(fram_context *c, const char *run, const char *output, double time, fram_result *result,
                                 fram_error *error, size_t size)
{
    export_report report;
    fram_status status = REFUSE_NULL(error, {"context", c}, {"run", run});
    if (status == FRAM_OK)
        status = RESULT_CHECK(result, size, fram_result, error);
    if (status == FRAM_OK)
        status = number_check("time", time, -TIME_MOST, TIME_MOST, error);
    if (status != FRAM_OK)
        return status;
    return answer(export_geojson(&c->inner, run, output, time, &report, error), &report, result, size);
}

fram_status(fram_export_netcdf)(fram_context *c, const char *run, const char *output, fram_result *result,
                                fram_error *error, size_t size)
{
    export_report report;
    fram_status status = REFUSE_NULL(error, {"context", c}, {"run", run});
    if (status == FRAM_OK)
        status = RESULT_CHECK(result, size, fram_result, error);
    if (status != FRAM_OK)
        return status;
    return answer(export_netcdf(&c->inner, run, output, &report, error), &report, result, size);
}

fram_status(fram_report)(fram_context *c, const char *run, const char *output, bool with_paths, fram_result *result,
                         fram_error *error, size_t size)
{
    export_report report = {.frames = 0};
    fram_status status = REFUSE_NULL(error, {"context", c}, {"run", run});
    if (status == FRAM_OK)
        status = RESULT_CHECK(result, size, fram_result, error);
    if (status != FRAM_OK)
        return status;
    status = report_write(&c->inner, run, output, notes_take, with_paths, error);
    if (status == FRAM_OK)
        status = path_given_or(output, run, "report.html", report.path, error);
    return answer(status, &report, result, size);
}

bool fram_run_has_file(const char *run, const char *path) { return run && path && path_is_own(run, path); }

bool fram_path_is_stream(const char *path) { return path && fill_is_stream(path); }

fram_status fram_path_check_place(const char *path, bool folder, fram_error *error)
{
    fram_status status = REFUSE_NULL(error, {"path", path});
    return status == FRAM_OK ? folder_check_place(path, folder, error) : status;
}

fram_status fram_plot(fram_context *c, const char *run, const char *const *channels, int channel_count, double from,
                      double to, const char *output, fram_error *error)
{
    fram_status status = REFUSE_NULL(error, {"context", c}, {"run", run}, {"channels", channels}, {"output", output});
    if (status == FRAM_OK && (channel_count < 1 || channel_count > FRAM_PLOT_CHANNELS))
        status = error_set(error, FRAM_ERROR_USAGE, NULL, 0, "channel_count", "expected 1 to %d, found %d",
                           FRAM_PLOT_CHANNELS, channel_count);
    for (int i = 0; i < channel_count && status == FRAM_OK; i++)
        status = REFUSE_NULL(error, {"channels", channels[i]});
    if (status == FRAM_OK)
        status = path_take(run, output, error);
    if (status != FRAM_OK)
        return status;
    return plot_channels(&c->inner, run, channels, channel_count, from, to, output, error);
}

fram_status fram_channels(fram_context *c, const char *run, char **text, fram_error *error)
{
    text_buffer out = {0};
    fram_status status = REFUSE_NULL(error, {"context", c}, {"run", run}, {"text", text});
    if (status != FRAM_OK)
        return status;
    status = plot_list(&c->inner, run, &out, error);
    if (status == FRAM_OK)
        *text = out.data;
    else
        text_free(&c->inner, &out);
    return status;
}

/* ---- comparison ---- */

typedef struct comparison_inside {
    compare_result result;
    fram_comparison_row rows[COMPARE_ROWS_MOST];
} comparison_inside;

/* `inside` is to be freed: a struct that ends before it never was. */
static fram_status comparison_check(const fram_comparison *comparison, size_t size, fram_error *error)
{
    size_t least = offsetof(fram_comparison, inside) + sizeof comparison->inside;
    return RESULT_CHECK(comparison, size < least ? 0 : size, fram_comparison, error);
}

fram_status(fram_compare)(fram_context *c, const char *run_a, const char *run_b, const char *output,
                          fram_comparison *comparison, fram_error *error, size_t size)
{
    fram_status status =
        REFUSE_NULL(error, {"context", c}, {"run_a", run_a}, {"run_b", run_b}, {"comparison", comparison});
    if (status == FRAM_OK)
        status = comparison_check(comparison, size, error);
    if (status == FRAM_OK && output)
        status = path_take(run_a, output, error);
    if (status == FRAM_OK && output)
        status = path_take(run_b, output, error);
    if (status != FRAM_OK)
        return status;
    comparison_inside *in = memory_array(&c->inner, 1, sizeof *in);
    if (!in)
        return error_memory(error);
    status = compare_runs(&c->inner, run_a, run_b, output, &in->result, error);
    if (status != FRAM_OK) {
        memory_free(&c->inner, in);
        return status;
    }
    for (int32_t i = 0; i < in->result.count; i++) {
        const compare_row *row = &in->result.row[i];
        in->rows[i] = (fram_comparison_row){row->name, row->unit, row->a, row->b};
    }
    const fram_comparison full = {.rows = in->rows,
                                  .count = in->result.count,
                                  .same_scenario = in->result.same_scenario,
                                  .same_state = in->result.same_state,
                                  .inside = in,
                                  .only_files_differ = in->result.only_files_differ,
                                  .same_as_read = in->result.same_as_read,
                                  .changed_a = in->result.changed_a,
                                  .changed_b = in->result.changed_b,
                                  .told_a = in->result.told[0],
                                  .told_b = in->result.told[1],
                                  .only_told_differs = in->result.only_told_differs,
                                  .counted_from = in->result.counted_from,
                                  .no_time_shared = in->result.no_time_shared};
    result_give(comparison, size, &full);
    return FRAM_OK;
}

void(fram_comparison_free)(fram_context *c, fram_comparison *comparison, size_t size)
{
    if (!c || !comparison || comparison_check(comparison, size, NULL) != FRAM_OK)
        return;
    memory_free(&c->inner, comparison->inside);
    memset(comparison, 0, size);
}

/* ---- video ---- */

static void fram_video_fill(fram_video_definition *definition)
{
    *definition = (fram_video_definition){.size = sizeof *definition,
                                          .colour = "speed",
                                          .camera = "orbit",
                                          .frames_per_second = 25,
                                          .width = 1280,
                                          .height = 720};
}
DEFINITION_DEFAULT(fram_video, fram_video_definition)

static fram_status find_colour(const char *name, plan_colour *colour, fram_error *error)
{
    const char *names[PLAN_COLOUR_COUNT];
    int row;
    for (int i = 0; i < PLAN_COLOUR_COUNT; i++)
        names[i] = plan_colour_name((plan_colour)i);
    fram_status status = name_find("colour", name, names, PLAN_COLOUR_COUNT, &row, error);
    *colour = (plan_colour)row;
    return status;
}

static fram_status find_camera(const char *name, video_camera *camera, fram_error *error)
{
    const char *names[VIDEO_CAMERA_COUNT];
    int row;
    for (int i = 0; i < VIDEO_CAMERA_COUNT; i++)
        names[i] = video_camera_name((video_camera)i);
    fram_status status = name_find("camera", name, names, VIDEO_CAMERA_COUNT, &row, error);
    *camera = (video_camera)row;
    return status;
}

fram_status(fram_video)(fram_context *c, const char *run, const fram_video_definition *definition, fram_result *result,
                        fram_error *error, size_t size)
{
    fram_video_definition taken, *d = &taken;
    fram_video_fill(d);
    fram_status status = REFUSE_NULL(error, {"context", c}, {"run", run});
    if (status == FRAM_OK)
        status = RESULT_CHECK(result, size, fram_result, error);
    if (status == FRAM_OK)
        status = definition_take(d, definition, sizeof *d, DEFINITION_LEAST, "fram_video", error);
    if (status == FRAM_OK)
        status = number_check("speed", d->speed, -SPEED_MOST, SPEED_MOST, error);
    if (status == FRAM_OK)
        status = number_check("span", d->span, -SPAN_MOST, SPAN_MOST, error);
    if (status != FRAM_OK)
        return status;
    if (d->width < 320 || d->width > 7680 || d->width % 2)
        return error_set(error, FRAM_ERROR_USAGE, NULL, 0, "width",
                         "expected an even number of pixels from 320 to 7680");
    if (d->height < 320 || d->height > 4320 || d->height % 2)
        return error_set(error, FRAM_ERROR_USAGE, NULL, 0, "height",
                         "expected an even number of pixels from 320 to 4320");
    if (d->frames_per_second < 1 || d->frames_per_second > 120)
        return error_set(error, FRAM_ERROR_USAGE, NULL, 0, "frames_per_second", "expected 1 to 120");
    video_options options = {.output = d->output,
                             .speed = d->speed,
                             .span = d->span,
                             .frames_per_second = d->frames_per_second,
                             .width = d->width,
                             .height = d->height,
                             .pictures = d->pictures,
                             .force = d->force};
    export_report report = {.frames = 0};
    status = find_colour(d->colour, &options.colour, error);
    if (status == FRAM_OK)
        status = find_camera(d->camera, &options.camera, error);
    if (status == FRAM_OK && d->span > 0 && options.camera != VIDEO_PLAN)
        status = error_set(error, FRAM_ERROR_USAGE, NULL, 0, "span", "only a plan has a span; choose the camera plan");
    if (status == FRAM_OK)
        status = video_write(&c->inner, run, &options, &report.frames, report.path, error);
    return answer(status, &report, result, size);
}

/* ---- capability ---- */

/* Simulated seconds of a run that measures the ice load, unless others are asked for. */
static const double USUAL_MEASURE = 120;

static void fram_capability_fill(fram_capability_definition *definition)
{
    *definition = (fram_capability_definition){.size = sizeof *definition,
                                               .measure = USUAL_MEASURE,
                                               .directions = 36,
                                               .speed_step = 0.1,
                                               .speed_most = 1,
                                               .allowance = 1.25,
                                               .line_safety = 2,
                                               .line_safety_damaged = 1.43};
}
DEFINITION_DEFAULT(fram_capability, fram_capability_definition)

/* More unbroken ice than this is not left out: a field without it would be another ice. */
static const double UNBROKEN_MOST = 0.05;
enum { ICE_RUNS = 64 };

static fram_status check_ice_from(const fram_capability_definition *d, fram_error *error)
{
    if (d->ice_from_count < 0 || d->ice_from_count > ICE_RUNS || (d->ice_from_count > 0 && !d->ice_from))
        return error_set(error, FRAM_ERROR_USAGE, NULL, 0, "ice_from", "expected 1 to %d runs, found %d", (int)ICE_RUNS,
                         d->ice_from_count);
    if (d->ice_from_count == 0 && (d->ice_vessel || d->unbroken_as != 0 || d->window != 0))
        return error_set(error, FRAM_ERROR_USAGE, NULL, 0, "ice_from",
                         "expected runs, since something is asked of the ice from them, found none");
    fram_status status = number_check("unbroken_as", d->unbroken_as, 0, 1e4, error);
    return status == FRAM_OK ? number_check("window", d->window, 0, 1e5, error) : status;
}

/* With ice from runs it is the formula that does not belong there, as capability_write says. */
static fram_status check_measure(const fram_capability_definition *d, fram_error *error)
{
    if (!d->formula || d->ice_from_count > 0 || d->measure == USUAL_MEASURE)
        return FRAM_OK;
    return error_set(error, FRAM_ERROR_USAGE, NULL, 0, "measure",
                     "expected none with the formula, which takes the place of runs that measure, found %g s",
                     d->measure);
}

/* The ice that came to the vessel in all runs together. */
static fram_status read_met_ice(context *ctx, const scenario *s, const fram_capability_definition *d,
                                capability_met_ice *met, fram_error *error)
{
    double unit = scenario_size(s);
    managed_ice sum = {.windows = 0};
    fram_status status = FRAM_OK;
    for (int i = 0; i < d->ice_from_count && status == FRAM_OK; i++)
        status = REFUSE_NULL(error, {"ice_from", d->ice_from[i]});
    for (int i = 0; i < d->ice_from_count && status == FRAM_OK; i++)
        status = manage_met_ice(ctx, d->ice_from[i], d->ice_vessel ? d->ice_vessel : d->vessel, unit, &sum, error);
    *met = (capability_met_ice){.windows = sum.windows,
                                .sheet_as = d->unbroken_as > 0 ? d->unbroken_as : (double)NAN,
                                .side = d->window > 0 ? d->window : (double)NAN,
                                .runs = d->ice_from,
                                .run_count = d->ice_from_count};
    if (status == FRAM_OK)
        status = manage_met_law(&sum, unit, met->sheet_as, &met->law, error);
    /* Also where nothing else came, which is an error of the law. */
    if (met->law.sheet > UNBROKEN_MOST && !(d->unbroken_as > 0))
        status = error_set(error, FRAM_ERROR_INPUT, d->ice_from[0], 0, "unbroken_as",
                           "%.3g %% of the ice that came to the vessel was unbroken, of which a field of floes has "
                           "none: give the diameter of the floes that shall stand for it [m], or runs of better "
                           "management",
                           100 * met->law.sheet);
    return status;
}

/* Of the tables the one that a scenario can name. */
static fram_status check_tables(const fram_scenario *s, const char *folder, fram_error *error)
{
    char floes[PATH_ROOM];
    fram_status status = path_join(folder, CAPABILITY_FLOES, floes, error);
    return status == FRAM_OK ? list_refuse_read(&s->read, floes, "folder", error) : status;
}

fram_status(fram_capability)(const fram_scenario *from, const fram_capability_definition *definition,
                             fram_result *result, fram_error *error, size_t size)
{
    fram_capability_definition taken, *d = &taken;
    fram_capability_fill(d);
    fram_status status = REFUSE_NULL(error, {"scenario", from});
    if (status == FRAM_OK)
        status = RESULT_CHECK(result, size, fram_result, error);
    if (status == FRAM_OK)
        status = definition_take(d, definition, sizeof *d, DEFINITION_LEAST, "fram_capability", error);
    if (status == FRAM_OK)
        status = folder_check("folder", d->folder, error);
    if (status != FRAM_OK)
        return status;
    capability_met_ice met;
    status = check_tables(from, d->folder, error);
    if (status == FRAM_OK)
        status = check_ice_from(d, error);
    if (status == FRAM_OK)
        status = check_measure(d, error);
    if (status == FRAM_OK && d->ice_from_count > 0)
        status = read_met_ice(&from->context->inner, &from->inner, d, &met, error);
    if (status != FRAM_OK)
        return status;
    const capability_options options = {.folder = d->folder,
                                        .met = d->ice_from_count > 0 ? &met : NULL,
                                        .force = d->force,
                                        .formula = d->formula,
                                        .measure = d->measure,
                                        .directions = d->directions,
                                        .speed_step = d->speed_step,
                                        .speed_most = d->speed_most,
                                        .allowance = d->allowance,
                                        .line_safety = d->line_safety,
                                        .line_safety_damaged = d->line_safety_damaged,
                                        .vessel = d->vessel,
                                        .stop = d->stop};
    export_report report = {.frames = 0};
    status = capability_write(&from->context->inner, &from->inner, &options, report.path, error);
    return answer(status, &report, result, size);
}
