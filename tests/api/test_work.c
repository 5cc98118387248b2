/* Whatever may take long says how far it is: each function on a finished run, a series or a scenario calls the
   context's work function, from the rows that it reads or the steps that it computes again.  The command makes lines of
   that, one in five seconds at least, so that no clock is needed here. */
#include "fram/results.h"
#include "fram/statistics.h"
#include "scratch.h"

#include <stdio.h>
#include <unistd.h>

enum { LEAST_CALLS = 3 };

static char folder[SCRATCH_FOLDER], run[260], other[260], output[300];

typedef struct told {
    int calls;
    bool good; /* parts never exceed the whole */
} told;

static void tell(void *user, const char *what, double done, double total)
{
    told *t = user;
    t->calls++;
    t->good = t->good && what[0] != '\0' && done >= 0 && (total <= 0 || done <= 1.001 * total);
}

static fram_context *context_telling(told *t)
{
    fram_context_definition d;
    fram_context_default(&d);
    d.work = tell;
    d.work_user = t;
    fram_context *c = NULL;
    ck_assert_int_eq(fram_context_create(&d, &c, NULL), FRAM_OK);
    return c;
}

/* A vessel that a second one drives past, for a thousand rows. */
static void make_run(fram_context *c, const char *to)
{
    static const char text[] =
        "run: {duration: 20, time_step: 0.02}\n"
        "vessels:\n"
        "  - {name: still, mode: free, x: 30, hull: {form: box, length: 20, beam: 8, draught: 2}}\n"
        "  - {name: tug, mode: free, x: -20, speed: 1,\n"
        "     hull: {form: box, length: 20, beam: 8, draught: 2},\n"
        "     propulsion: {bollard_pull: 1.0e5, open_water_speed: 4}}\n"
        "ice: {source: floes, floes: [{x: -6, y: 1, length: 4, width: 4}]}\n"
        "domain: {x_min: -60, x_max: 60, y_min: -40, y_max: 40, boundary: open}\n"
        "output: {frame_interval: 1}\n";
    fram_scenario *s = NULL;
    fram_error e = {0};
    char scene[300];
    snprintf(scene, sizeof scene, "%s/scene.yaml", folder);
    scratch_text(scene, text);
    ck_assert_msg(fram_scenario_load(c, scene, NULL, 0, &s, &e) == FRAM_OK, "%s", e.message);
    fram_run_definition d;
    fram_run_default(&d);
    d.folder = to;
    ck_assert_msg(fram_run(s, &d, NULL, &e) == FRAM_OK, "%s", e.message);
    fram_scenario_destroy(s);
}

static void begin(fram_context *c)
{
    scratch_folder(folder);
    snprintf(run, sizeof run, "%s/run", folder);
    snprintf(other, sizeof other, "%s/other", folder);
    snprintf(output, sizeof output, "%s/output", folder);
    make_run(c, run);
    make_run(c, other);
}

static void end(void) { scratch_remove_folder(folder); }

/* A build without an optional library answers that, and has nothing to tell. */
static void check_told(told *t, fram_status status, const fram_error *e, const char *call)
{
    if (status != FRAM_ERROR_UNSUPPORTED) {
        ck_assert_msg(status == FRAM_OK, "%s: %s", call, e->message);
        ck_assert_msg(t->calls >= LEAST_CALLS && t->good, "%s tells %d times how far it is", call, t->calls);
    }
    *t = (told){.good = true};
}
#define TOLD(call) check_told(&t, (call), &e, #call)

/* ---- asked to stop ---- */

static fram_context *context_stopped(void)
{
    static const int stop = 1;
    fram_context_definition d;
    fram_context_default(&d);
    d.stop = &stop;
    fram_context *c = NULL;
    ck_assert_int_eq(fram_context_create(&d, &c, NULL), FRAM_OK);
    return c;
}

/* Before anything is made of the series: they may be large. */
static void check_stopped(fram_status status, const fram_error *e, const char *call)
{
    if (status == FRAM_ERROR_UNSUPPORTED)
        return;
    ck_assert_msg(status == FRAM_INTERRUPTED, "%s is not interrupted", call);
    ck_assert_msg(strstr(e->message, "reading rows") != NULL, "%s is interrupted late: %s", call, e->message);
    ck_assert_msg(access(output, F_OK) != 0, "%s has written %s", call, output);
}
#define STOPPED(call) check_stopped((call), &e, #call)

START_TEST(what_is_stopped_writes_no_file)
{
    told t = {.good = true};
    fram_context *whole = context_telling(&t), *c = context_stopped();
    begin(whole);
    fram_error e = {0};
    snprintf(output, sizeof output, "%s/stopped.svg", folder);
    const char *const channels[] = {"still.ice_force_x"};
    STOPPED(fram_plot(c, run, channels, 1, (double)NAN, (double)NAN, output, &e));
    snprintf(output, sizeof output, "%s/stopped.html", folder);
    STOPPED(fram_report(c, run, output, false, NULL, &e));
    fram_comparison *comparison = calloc(1, sizeof *comparison);
    STOPPED(fram_compare(c, run, other, output, comparison, &e));
    free(comparison);
    snprintf(output, sizeof output, "%s/stopped.csv", folder);
    const char *const runs[] = {run};
    fram_fatigue_definition f;
    fram_fatigue cycles;
    fram_fatigue_default(&f);
    f.source =
        (fram_series_source){.files = runs, .file_count = 1, .channel = "still.ice_force_x", .from = (double)NAN};
    f.cycles = output;
    STOPPED(fram_fatigue_find(c, &f, &cycles, &e));
    char series[300];
    snprintf(series, sizeof series, "%s/series.csv", run);
    const char *const files[] = {series};
    f.source.files = files;
    STOPPED(fram_fatigue_find(c, &f, &cycles, &e));
    fram_context_destroy(c);
    fram_context_destroy(whole);
    end();
}
END_TEST

START_TEST(what_reads_a_run_tells_how_far_it_is)
{
    told t = {.good = true};
    fram_context *c = context_telling(&t);
    begin(c);
    t = (told){.good = true};
    fram_error e = {0};
    fram_result result;
    char *text = NULL;
    TOLD(fram_export_vtk(c, run, output, 1, &result, &e));
    snprintf(output, sizeof output, "%s/o.geojson", folder);
    TOLD(fram_export_geojson(c, run, output, 10, &result, &e));
    snprintf(output, sizeof output, "%s/o.nc", folder);
    TOLD(fram_export_netcdf(c, run, output, &result, &e));
    snprintf(output, sizeof output, "%s/o.html", folder);
    TOLD(fram_report(c, run, output, false, &result, &e));
    const char *const channels[] = {"still.ice_force_x"};
    snprintf(output, sizeof output, "%s/o.svg", folder);
    TOLD(fram_plot(c, run, channels, 1, (double)NAN, (double)NAN, output, &e));
    snprintf(output, sizeof output, "%s/compare.html", folder);
    fram_comparison *comparison = calloc(1, sizeof *comparison);
    TOLD(fram_compare(c, run, other, output, comparison, &e));
    fram_comparison_free(c, comparison);
    free(comparison);
    fram_manage_definition manage;
    fram_manage_default(&manage);
    manage.beside = other;
    TOLD(fram_manage(c, run, &manage, &result, &text, &e));
    fram_text_free(c, text);
    fram_context_destroy(c);
    end();
}
END_TEST

START_TEST(what_computes_a_run_again_tells_how_far_it_is)
{
    told t = {.good = true};
    fram_context *c = context_telling(&t);
    begin(c);
    t = (told){.good = true};
    fram_error e = {0};
    char *text = NULL;
    fram_why_definition why;
    fram_why_default(&why);
    why.time = 15;
    TOLD(fram_why(c, run, &why, &text, &e));
    fram_text_free(c, text);
    fram_pressure_definition pressure;
    fram_pressure_default(&pressure);
    pressure.output = output;
    pressure.vessel = "tug";
    TOLD(fram_pressure(c, run, &pressure, &e));
    fram_video_definition video;
    fram_video_default(&video);
    video.pictures = true;
    video.speed = 40;
    video.width = video.height = 320;
    video.width = 640;
    video.height = 360;
    fram_result result;
    snprintf(output, sizeof output, "%s/pictures", folder);
    video.output = output;
    TOLD(fram_video(c, run, &video, &result, &e));
    fram_context_destroy(c);
    end();
}
END_TEST

START_TEST(statistics_tell_how_far_they_are)
{
    told t = {.good = true};
    fram_context *c = context_telling(&t);
    fram_error e = {0};
    char path[] = "/tmp/fram_work_series_XXXXXX";
    int descriptor = mkstemp(path);
    ck_assert_int_ge(descriptor, 0);
    FILE *file = fdopen(descriptor, "w");
    fputs("time,x\n", file);
    for (int i = 0; i < 1200; i++)
        fprintf(file, "%d,%d\n", i, i * 7919 % 4001 * (i * 104729 % 4003) % 1009);
    fclose(file);
    const char *const files[] = {path};
    fram_extremes *r = calloc(1, sizeof *r);
    fram_extremes_definition d;
    fram_extremes_default(&d);
    d.source = (fram_series_source){.files = files, .file_count = 1, .channel = "x", .from = (double)NAN};
    /* Reading is five words of it; intervals are the rest. */
    static const char *const methods[] = {"acer", "gev", "pot", "weibull"};
    for (int i = 0; i < 4; i++) {
        d.method = methods[i];
        fram_status status = fram_extremes_find(c, &d, r, &e);
        ck_assert_msg(status == FRAM_OK && t.calls > 20, "%s tells %d times how far it is", methods[i], t.calls);
        TOLD(status);
    }
    d.method = "gev";
    d.moments = true;
    ck_assert_int_eq(fram_extremes_find(c, &d, r, &e), FRAM_OK);
    ck_assert_int_gt(t.calls, 200);
    t = (told){.good = true};
    free(r);
    fram_fatigue_definition f;
    fram_fatigue cycles;
    fram_fatigue_default(&f);
    f.source = d.source;
    TOLD(fram_fatigue_find(c, &f, &cycles, &e));
    fram_fatigue_free(c, &cycles);
    fram_context_destroy(c);
    unlink(path);
}
END_TEST

TEST_MAIN("work", what_reads_a_run_tells_how_far_it_is, what_computes_a_run_again_tells_how_far_it_is,
          statistics_tell_how_far_they_are, what_is_stopped_writes_no_file)
