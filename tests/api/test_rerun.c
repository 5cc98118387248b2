/* fram_pressure and fram_why compute a recorded run again: one that a program steered on the way is refused from there
   on, before that it is told; rows far apart, rows that are not there, and states at the end tell as well.  Parts of a
   load by mechanism decide nothing. */
#include "fram/live.h"
#include "fram/results.h"
#include "scratch.h"

static fram_error e;
static fram_context *ctx;
static char folder[SCRATCH_FOLDER], run[240], map[240];

/* A tow that presses a floe on a fixed one from the first second on. */
static const char tow[] = "run: {duration: 3, time_step: 0.02}\n"
                          "vessel:\n  mode: towed\n  x: -22\n  speed: 1\n  ramp: 0.1\n"
                          "  hull: {form: box, length: 40, beam: 10, draught: 4, freeboard: 2}\n"
                          "ice:\n  source: floes\n  thickness: 0.5\n  floes:\n"
                          "    - {length: 20, width: 20, x: 8.5}\n    - {length: 20, width: 20, x: 28.6, fixed: true}\n"
                          "domain: {x_min: -64, x_max: 64, y_min: -40, y_max: 40}\n";

static void open_all(void)
{
    scratch_folder(folder);
    snprintf(run, sizeof run, "%s/run", folder);
    snprintf(map, sizeof map, "%s/map", folder);
    assert_ok(fram_context_create(NULL, &ctx, &e), e);
}

static void close_all(void)
{
    fram_context_destroy(ctx);
    scratch_remove_folder(folder);
}

/* The other speed of the tow that a run is told. */
static double told_speed = 1.5;

/* The steps that are made at all, and those of them before the recording begins. */
static int steps = 150, unrecorded;

/* The run, told another speed of the tow after `told` of its steps. */
static void record(const char *const *overrides, int count, int told)
{
    fram_scenario *s;
    fram_world *w;
    fram_record_definition d;
    fram_run_result result;
    assert_ok(fram_scenario_parse(ctx, tow, NULL, overrides, count, &s, &e), e);
    assert_ok(fram_world_create(s, &w, &e), e);
    fram_record_default(&d);
    d.folder = run;
    d.force = true;
    for (int i = 0; i < unrecorded; i++)
        assert_ok(fram_world_step(w, &e), e);
    assert_ok(fram_world_record(w, &d, &e), e);
    for (int i = unrecorded; i < steps; i++) {
        if (i == told) {
            assert_ok(fram_world_set_input(w, fram_world_find_input(w, "tow_velocity_x"), told_speed, &e), e);
            assert_ok(fram_world_set_input(w, fram_world_find_input(w, "wind_x"), 0, &e), e);
            assert_ok(fram_world_set_input(w, fram_world_find_input(w, "wind_y"), 0, &e), e);
        }
        assert_ok(fram_world_step(w, &e), e);
    }
    assert_ok(fram_world_record_end(w, &result, &e), e);
    fram_world_destroy(w);
    fram_scenario_destroy(s);
}

/* Whether a file of the run has a text. */
static bool run_file_has(const char *name, const char *text)
{
    char path[300], buffer[1 << 18];
    snprintf(path, sizeof path, "%s/%s", run, name);
    FILE *file = fopen(path, "r");
    ck_assert_ptr_nonnull(file);
    buffer[fread(buffer, 1, sizeof buffer - 1, file)] = '\0';
    fclose(file);
    return strstr(buffer, text);
}

static fram_status pressure(double from, double to)
{
    fram_pressure_definition d;
    fram_pressure_default(&d);
    d.output = map;
    d.force = true;
    d.panel = 2;
    d.from = from;
    d.to = to;
    return fram_pressure(ctx, run, &d, &e);
}

static bool as_json;
static char answer[1 << 14]; /* of why */

static fram_status why(double time, int peak)
{
    fram_why_definition d;
    char *text = NULL;
    fram_why_default(&d);
    d.time = time;
    d.peak = peak;
    d.json = as_json;
    fram_status status = fram_why(ctx, run, &d, &text, &e);
    snprintf(answer, sizeof answer, "%s", text ? text : "");
    fram_text_free(ctx, text);
    return status;
}

static void assert_told(const char *words) { ck_assert_msg(strstr(answer, words), "no \"%s\" in %s", words, answer); }

/* As a run that was killed leaves it. */
static void forget_end(void)
{
    char path[300], buffer[1 << 15];
    snprintf(path, sizeof path, "%s/run.json", run);
    FILE *file = fopen(path, "r+");
    ck_assert_ptr_nonnull(file);
    buffer[fread(buffer, 1, sizeof buffer - 1, file)] = '\0';
    const char *found = strstr(buffer, "\"finished\",");
    ck_assert_ptr_nonnull(found);
    ck_assert_int_eq(fseek(file, found - buffer, SEEK_SET), 0);
    fputs("\"running\", ", file);
    ck_assert_int_eq(fclose(file), 0);
}

static void remove_rows(void)
{
    char path[300];
    snprintf(path, sizeof path, "%s/series.csv", run);
    ck_assert_int_eq(unlink(path), 0);
}

static const char *const no_checkpoints[] = {"output.checkpoint_interval=0"};

/* Words of the run's own scenario.yaml become others, of as many letters. */
static void change_scenario(const char *from, const char *to)
{
    char path[400], text[20000];
    snprintf(path, sizeof path, "%s/scenario.yaml", run);
    FILE *file = fopen(path, "r+");
    ck_assert_ptr_nonnull(file);
    text[fread(text, 1, sizeof text - 1, file)] = '\0';
    const char *at = strstr(text, from);
    ck_assert_ptr_nonnull(at);
    ck_assert_int_eq(fseek(file, at - text, SEEK_SET), 0);
    fputs(to, file);
    fclose(file);
}

START_TEST(steered)
{
    open_all();
    record(no_checkpoints, 1, 75);
    assert_fails(pressure(0, 0), e, FRAM_ERROR_INPUT, "at t = 1.52 s");
    assert_fails(pressure(2, 0), e, FRAM_ERROR_INPUT, "up to t = 1.5 s it is the same");
    ck_assert_str_eq(e.key, "position_x");
    ck_assert_int_eq(access(map, F_OK), -1);
    assert_ok(pressure(0, 1.5), e);
    assert_fails(why(2.5, 0), e, FRAM_ERROR_INPUT, "at t = 1.52 s");
    /* A peak that is kept is told, with why its moment is not computed again. */
    assert_ok(why(0, 1), e);
    assert_told("Peak 1 of ");
    assert_told("\nA program steered the run: at t = 1.52 s");
    assert_told("\nNot recomputed: ");
    as_json = true;
    assert_ok(why(0, 1), e);
    assert_told("\"computed_again\": null, \"hindrance\": \"at t = 1.52 s");
    as_json = false;
    assert_ok(why(1, 0), e);
    /* What else stands in the way is no word of the program. */
    change_scenario("seed: 1", "seed: 2");
    assert_fails(why(2.5, 0), e, FRAM_ERROR_INPUT, "was changed since the run was made");
    assert_ok(why(0, 1), e);
    assert_told("Peak 1 of ");
    assert_told("\nNot computed again: ");
    assert_told("was changed since the run was made");
    ck_assert_ptr_null(strstr(answer, "A program steered"));
    close_all();
}
END_TEST

/* Two numbers that differ in their tenth digit are not shown as one. */
START_TEST(steered_a_little)
{
    double was = 0, is = 0;
    open_all();
    told_speed = 1 + 1e-6;
    record(no_checkpoints, 1, 75);
    told_speed = 1.5;
    assert_fails(pressure(0, 0), e, FRAM_ERROR_INPUT, "at t = 1.52 s");
    ck_assert_int_eq(sscanf(e.message, "at t = 1.52 s it was %lf in the run and is %lf", &was, &is), 2);
    ck_assert_double_ne(was, is);
    close_all();
}
END_TEST

/* What was told in place of the scenario stands in run.json and in the report. */
START_TEST(what_was_told_is_named)
{
    fram_result report;
    open_all();
    for (int told = -1; told < 3; told += 3) {
        record(no_checkpoints, 1, told);
        assert_ok(fram_report(ctx, run, NULL, false, &report, &e), e);
        ck_assert(run_file_has("run.json",
                               told < 0 ? "\"told\": []," : "\"told\": [\"wind_x\", \"wind_y\", \"tow_velocity\"],"));
        ck_assert(run_file_has("report.html", "in place of which were wind_x, wind_y, tow_velocity") == (told >= 0));
    }
    close_all();
}
END_TEST

/* A set point in place of way points, a path in place of them, and a set point where there were none. */
START_TEST(set_points_that_end_way_points_are_named)
{
    static const char ship[] = "run: {duration: 1, time_step: 0.05}\n"
                               "vessels:\n  - {name: a, mode: free, hull: {length: 40, beam: 10, draught: 4}%s}\n"
                               "ice: {source: none}\ndomain: {boundary: open}\n";
    static const char *const points[] = {", positioning: {waypoints: [{time: 0.5, x: 1}]}", ""};
    static const char *const told[] = {"\"told\": [\"a.set_point\"],", "\"told\": [],", "\"told\": [\"a.path\"],"};
    const double time = 1, place[] = {9, 9, 0};
    open_all();
    for (int i = 0; i < 3; i++) {
        char text[400];
        fram_scenario *s;
        fram_world *w;
        fram_record_definition d;
        snprintf(text, sizeof text, ship, points[i % 2]);
        assert_ok(fram_scenario_parse(ctx, text, NULL, NULL, 0, &s, &e), e);
        assert_ok(fram_world_create(s, &w, &e), e);
        fram_record_default(&d);
        d.folder = run;
        d.force = true;
        assert_ok(fram_world_record(w, &d, &e), e);
        if (i < 2)
            assert_ok(fram_world_set_input(w, fram_world_find_input(w, "a.set_point_heading"), 9, &e), e);
        else
            assert_ok(fram_world_set_path(w, 0, &time, place, 1, &e), e);
        assert_ok(fram_world_step(w, &e), e);
        assert_ok(fram_world_record_end(w, NULL, &e), e);
        ck_assert_msg(run_file_has("run.json", told[i]), "%s", told[i]);
        fram_world_destroy(w);
        fram_scenario_destroy(s);
    }
    close_all();
}
END_TEST

/* The last warning that was told. */
static char warned[400];
static int warnings;

static void keep_warning(void *user, fram_log_level level, const char *text)
{
    (void)user;
    if (level > FRAM_LOG_WARNING)
        return;
    snprintf(warned, sizeof warned, "%s", text);
    warnings++;
}

/* The cells of a column become others, as of a build in which it meant something else. */
static void change_column(const char *name)
{
    char path[300], other[300], line[8192];
    int column = -1;
    snprintf(path, sizeof path, "%s/series.csv", run);
    snprintf(other, sizeof other, "%s/other.csv", run);
    FILE *from = fopen(path, "r"), *to = fopen(other, "w");
    ck_assert(from && to);
    while (fgets(line, sizeof line, from)) {
        const bool is_head = column < 0;
        char *cell = line;
        for (int k = 0; cell; k++) {
            char *next = strpbrk(cell, ",\n");
            const char end = *next;
            *next = '\0';
            if (is_head && strncmp(cell, name, strlen(name)) == 0 && cell[strlen(name)] == '[')
                column = k;
            fprintf(to, "%s%c", !is_head && k == column ? "12345" : cell, end);
            cell = end == ',' ? next + 1 : NULL;
        }
        ck_assert_int_ge(column, 0);
    }
    fclose(from);
    ck_assert_int_eq(fclose(to), 0);
    ck_assert_int_eq(rename(other, path), 0);
}

/* By which mechanism a contact loads is no matter of the motion: where another Fram tells that otherwise it is said
   once, and the run is computed again; all else decides, and what is kept of a peak is told all the same. */
START_TEST(other_shares_of_mechanisms)
{
    fram_context_definition d;
    open_all();
    record(no_checkpoints, 1, -1);
    fram_context_destroy(ctx);
    fram_context_default(&d);
    d.log = keep_warning;
    d.verbosity = FRAM_LOG_WARNING;
    assert_ok(fram_context_create(&d, &ctx, &e), e);
    warnings = 0;
    assert_ok(pressure(0, 0), e);
    assert_ok(why(0, 1), e);
    ck_assert_int_eq(warnings, 0);
    change_column("mechanism_chain_x");
    change_column("mechanism_friction_moment_z");
    assert_ok(pressure(0, 0), e);
    ck_assert_int_eq(warnings, 1);
    ck_assert_msg(strstr(warned, "mechanism_chain_x") && strstr(warned, "another Fram"), "%s", warned);
    for (int peak = 0; peak < 2; peak++) {
        assert_ok(why(2.5, peak), e);
        assert_told("\nRecomputed from ");
        ck_assert_int_eq(warnings, 2 + peak);
    }
    change_column("ice_force_bow_y");
    assert_fails(pressure(0, 0), e, FRAM_ERROR_INPUT, "another Fram made it");
    ck_assert_str_eq(e.key, "ice_force_bow_y");
    assert_fails(why(2.5, 0), e, FRAM_ERROR_INPUT, "another Fram made it");
    assert_ok(why(0, 1), e);
    assert_told("\nNot computed again: ice_force_bow_y: at t = ");
    assert_told("\nNot recomputed: ");
    as_json = true;
    assert_ok(why(0, 1), e);
    as_json = false;
    assert_told("\"computed_again\": null, \"hindrance\": \"ice_force_bow_y: at t = ");
    close_all();
}
END_TEST

/* From a checkpoint behind the input it is the run again; the one at the scenario's end is there, though the program
   goes on. */
START_TEST(from_a_checkpoint)
{
    static const char *const each_second[] = {"output.checkpoint_interval=1", "run.duration=2"};
    open_all();
    record(each_second, 2, 75);
    assert_fails(pressure(1.2, 0), e, FRAM_ERROR_INPUT, "at t = 1.52 s");
    assert_ok(pressure(2, 0), e);
    close_all();
}
END_TEST

/* A row each second: what was told at 2.2 s shows in the row of 3 s alone. */
START_TEST(rows_far_apart)
{
    static const char *const words[] = {"output.checkpoint_interval=0", "output.csv_interval=1"};
    open_all();
    record(words, 2, 110);
    assert_fails(pressure(0, 2.5), e, FRAM_ERROR_INPUT, "at t = 3 s");
    assert_ok(pressure(0, 2), e);
    record(words, 2, -1);
    assert_ok(pressure(0, 2.5), e);
    assert_ok(why(2.2, 0), e);
    close_all();
}
END_TEST

/* Without a row behind the input the state at the end tells. */
START_TEST(no_row_behind)
{
    static const char *const words[] = {"output.checkpoint_interval=0", "output.csv_interval=2"};
    static const char *const no_row[] = {"output.checkpoint_interval=0", "output.csv_interval=2", "run.duration=0.3"};
    open_all();
    record(words, 2, 125);
    assert_fails(pressure(0, 0), e, FRAM_ERROR_INPUT, "ended in another state");
    record(words, 2, -1);
    assert_ok(pressure(0, 0), e);
    remove_rows();
    assert_ok(pressure(0, 0), e);
    /* Without a row at all and without an end it may have gone as far as its scenario. */
    steps = 15;
    record(no_row, 3, -1);
    steps = 150;
    forget_end();
    assert_ok(pressure(0, 0), e);
    close_all();
}
END_TEST

/* The last step ends after the duration, which is no multiple of the time step. */
START_TEST(last_step)
{
    static const char *const words[] = {"output.checkpoint_interval=0", "run.duration=2.993"};
    open_all();
    record(words, 2, -1);
    assert_ok(why(3, 0), e);
    assert_fails(why(3.02, 0), e, FRAM_ERROR_INPUT, "to 3 s, found 3.02");
    close_all();
}
END_TEST

/* A program goes on beyond the scenario's end: to there it is explained, kept by checkpoints, and ended by a resume. */
START_TEST(beyond_the_end)
{
    static const char *const words[] = {"output.checkpoint_interval=0.2", "run.duration=2"};
    char path[300];
    fram_run_definition d;
    fram_run_result result;
    open_all();
    record(words, 2, 135);
    assert_ok(why(2.2, 0), e);
    assert_fails(pressure(0, 0), e, FRAM_ERROR_INPUT, "at t = 2.72 s");
    snprintf(path, sizeof path, "%s/checkpoint-000000000140.fram", run);
    ck_assert_int_eq(access(path, F_OK), 0);
    fram_run_default(&d);
    d.folder = run;
    d.until = 2.9;
    assert_fails(fram_resume(ctx, &d, &result, &e), e, FRAM_ERROR_USAGE, "from 3 s on");
    d.until = 0;
    assert_ok(fram_resume(ctx, &d, &result, &e), e);
    ck_assert(result.finished);
    ck_assert_int_eq(result.steps, 150);
    ck_assert(run_file_has("run.json", "\"recorded_from_s\": 0,"));
    close_all();
}
END_TEST

/* A number in what fram_why tells of a moment as JSON. */
static double told_number(const char *text, const char *name)
{
    char key[40];
    snprintf(key, sizeof key, "\"%s\": ", name);
    const char *found = strstr(text, key);
    ck_assert_msg(found != NULL, "no %s in %s", name, text);
    return strtod(found + strlen(key), NULL);
}

/* A moment sooner after the start than the averaging window is long: each method has a load there, too, and the run's
   own has that of the moment. */
START_TEST(before_a_window_has_passed)
{
    static const char *const words[] = {"output.checkpoint_interval=0", "vessel.x=-21.5"};
    fram_why_definition d;
    char *text = NULL;
    open_all();
    record(words, 2, -1);
    fram_why_default(&d);
    d.time = 0.2;
    d.json = true;
    assert_ok(fram_why(ctx, run, &d, &text, &e), e);
    double load = told_number(text, "load");
    ck_assert_double_gt(load, 0);
    ck_assert_double_ge(told_number(text, "same"), load * (1 - 1e-9));
    ck_assert_double_gt(told_number(text, "half_step"), 0.5 * load);
    ck_assert_double_gt(told_number(text, "accurate"), 0.5 * load);
    fram_text_free(ctx, text);
    char own[300]; /* no picture is drawn over what the run is made of */
    snprintf(own, sizeof own, "%s/series.csv", run);
    d.picture = own;
    assert_fails(fram_why(ctx, run, &d, &text, &e), e, FRAM_ERROR_USAGE, "found one that is read");
    ck_assert_str_eq(e.key, "picture");
    close_all();
}
END_TEST

/* A ship that is faster than it may be when it has met a floe. */
static void run_until_it_fails(const char *const *overrides, int count)
{
    static const char ship[] = "run: {duration: 20, time_step: 0.02, transient: 0}\n"
                               "vessel:\n  mode: free\n  x: -30\n  speed: 1\n"
                               "  hull: {length: 50, beam: 12, draught: 4, freeboard: 3}\n"
                               "  hydrodynamics: {source: estimate}\n"
                               "  propulsion: {bollard_pull: 4.0e5, open_water_speed: 8, speed: 3}\n"
                               "ice: {source: floes, thickness: 0.3, floes: [{length: 4, width: 10, x: -0.6}]}\n"
                               "domain: {x_min: -90, x_max: 100, y_min: -50, y_max: 50, boundary: open}\n";
    fram_scenario *s;
    fram_run_definition d;
    fram_run_result result;
    assert_ok(fram_scenario_parse(ctx, ship, NULL, overrides, count, &s, &e), e);
    fram_run_default(&d);
    d.folder = run;
    d.force = true;
    assert_fails(fram_run(s, &d, &result, &e), e, FRAM_ERROR_SIMULATION, "went wrong in step");
    fram_scenario_destroy(s);
}

/* The last moments before a run failed are explained, up to the last step that it made; another method may go wrong
   sooner. */
START_TEST(up_to_a_failure)
{
    static const char *const sooner[] = {"run.speed_limit=1.5"};
    static const char *const later[] = {"run.speed_limit=1.9", "vessel.speed=1.5", "output.csv_interval=5"};
    open_all();
    run_until_it_fails(sooner, 1);
    assert_ok(why(0, 1), e);
    assert_told("Peak 1 of 1: t = 1.92 s");
    assert_ok(why(1.9, 0), e);
    assert_fails(why(1.94, 0), e, FRAM_ERROR_INPUT, "up to 1.92 s");
    run_until_it_fails(later, 2);
    assert_ok(why(0, 1), e);
    assert_told("half the time step       went wrong at t = 1.6 s\n");
    as_json = true;
    assert_ok(why(0, 1), e);
    assert_told("\"half_step\": null, \"half_step_went_wrong_at\": 1.6, \"accurate\": ");
    as_json = false;
    /* Without a row too. */
    run_until_it_fails(later, 3);
    assert_ok(pressure(0, 0), e);
    assert_fails(why(1.62, 0), e, FRAM_ERROR_INPUT, "up to 1.6 s");
    assert_fails(pressure(1.61, 0), e, FRAM_ERROR_INPUT, "no step ends after 1.61 s and up to 1.6 s");
    close_all();
}
END_TEST

/* Nothing of a run or recording goes over the scenario that it is made of. */
static void assert_scenario_stays(void)
{
    static const char *const faster[] = {"vessel.speed=2"};
    fram_run_definition d;
    fram_record_definition r;
    fram_scenario *s;
    fram_world *w;
    char own[300];
    snprintf(own, sizeof own, "%s/scenario.yaml", run);
    assert_ok(fram_scenario_load(ctx, own, faster, 1, &s, &e), e);
    fram_run_default(&d);
    d.folder = run;
    d.force = true;
    assert_fails(fram_run(s, &d, NULL, &e), e, FRAM_ERROR_USAGE, "the scenario that it reads");
    assert_ok(fram_world_create(s, &w, &e), e);
    fram_record_default(&r);
    r.folder = run;
    r.force = true;
    assert_fails(fram_world_record(w, &r, &e), e, FRAM_ERROR_USAGE, "the scenario that it reads");
    fram_world_destroy(w);
    fram_scenario_destroy(s);
}

/* A run that a program ended before its first step has nothing to be computed again. */
START_TEST(no_step)
{
    open_all();
    steps = 0;
    record(no_checkpoints, 1, -1);
    steps = 150;
    assert_fails(pressure(0, 0), e, FRAM_ERROR_INPUT, "no step ends after 0 s and up to 0 s");
    assert_fails(why(1, 0), e, FRAM_ERROR_INPUT, "up to 0 s");
    assert_scenario_stays();
    close_all();
}
END_TEST

/* What is not known of the time before a recording is told as that, and what rows leave out. */
START_TEST(recorded_from_later_on)
{
    static const char *const far_apart[] = {"output.checkpoint_interval=0", "output.csv_interval=1"};
    open_all();
    unrecorded = 75;
    record(no_checkpoints, 1, -1);
    assert_ok(why(2.9, 0), e);
    assert_told("\nSince the recording began, 1.4 s before, in all of the ice: 0 breaks");
    as_json = true;
    assert_ok(why(2.9, 0), e);
    ck_assert_double_eq_tol(told_number(answer, "span_before"), 1.4, 1e-9);
    as_json = false;
    unrecorded = 60; /* 1.2 s, with the first row at 2 s */
    record(far_apart, 2, -1);
    assert_ok(why(2.9, 0), e);
    assert_told("\nSince the recording began, 1.7 s before, in all of the ice: 0 breaks");
    unrecorded = 130;
    record(no_checkpoints, 1, -1);
    assert_fails(why(0, 1), e, FRAM_ERROR_INPUT, "recorded from 2.6 s to 3 s, and a peak is told of a whole averaging");
    unrecorded = 0;
    record(far_apart, 2, -1);
    assert_ok(why(2.9, 0), e);
    assert_told("\nIn the 5 s before, in all of the ice: 0 breaks");
    assert_told(" m/s in the 2 rows that series.csv has of it\n");
    close_all();
}
END_TEST

/* A peak of a run that was told something and recorded late is told, and nothing is computed up to where it began. */
START_TEST(steered_and_recorded_from_later_on)
{
    open_all();
    unrecorded = 75;
    record(no_checkpoints, 1, 76);
    unrecorded = 0;
    assert_ok(why(0, 1), e);
    assert_told("\nA program steered the run: it was recorded from 1.5 s on, ");
    close_all();
}
END_TEST

static double row_of(const fram_comparison *c, const char *name, bool second)
{
    int i = 0;
    while (i < c->count && strcmp(c->rows[i].name, name) != 0)
        i++;
    ck_assert_msg(i < c->count, "no row %s", name);
    return second ? c->rows[i].b : c->rows[i].a;
}

/* The same motion, recorded from 1.5 s on, has the same numbers from there on; a run that was told is not the same. */
START_TEST(compared_from_where_both_are_recorded)
{
    static const char *const numbers[] = {"ice load along X, mean", "ice load along X, maximum",
                                          "contact points, mean"};
    char whole[300], page[300];
    open_all();
    record(no_checkpoints, 1, -1);
    snprintf(whole, sizeof whole, "%s/whole", folder);
    snprintf(page, sizeof page, "%s/page.html", run);
    ck_assert_int_eq(rename(run, whole), 0);
    unrecorded = 75;
    for (int told = -1; told < 100; told += 91) {
        fram_comparison c;
        record(no_checkpoints, 1, told);
        assert_ok(fram_compare(ctx, whole, run, page, &c, &e), e);
        ck_assert_double_eq_tol(c.counted_from, 1.5, 1e-9);
        ck_assert_str_eq(c.told_a, "");
        ck_assert_str_eq(c.told_b, told < 0 ? "" : "wind_x, wind_y, tow_velocity");
        ck_assert(c.same_scenario == (told < 0) && c.only_told_differs == (told >= 0));
        ck_assert(!c.same_as_read && !c.only_files_differ);
        for (int i = 0; i < c.count; i++) /* of no lines, thrusters and station nothing is told */
            ck_assert(!strstr(c.rows[i].name, "tension") && !strstr(c.rows[i].name, "thruster") &&
                      !strstr(c.rows[i].name, "offset"));
        ck_assert(run_file_has("page.html", "after 1.5 s, of what both recorded"));
        ck_assert(run_file_has("page.html", "told B by a program") == (told >= 0));
        for (size_t i = 0; i < sizeof numbers / sizeof *numbers && told < 0; i++)
            ck_assert_double_eq(row_of(&c, numbers[i], false), row_of(&c, numbers[i], true));
        ck_assert((row_of(&c, "x at the end", false) == row_of(&c, "x at the end", true)) == (told < 0));
        fram_comparison_free(ctx, &c);
        assert_ok(fram_compare(ctx, run, run, NULL, &c, &e), e);
        ck_assert(c.same_scenario && !c.only_told_differs); /* with itself it is the same, told or not */
        fram_comparison_free(ctx, &c);
    }
    unrecorded = 0;
    record(no_checkpoints, 1, -1);
    fram_comparison c;
    assert_ok(fram_compare(ctx, whole, run, NULL, &c, &e), e);
    ck_assert(c.counted_from == 0 && c.same_scenario && c.same_state && !c.no_time_shared);
    fram_comparison_free(ctx, &c);
    /* One that ended before the other was recorded. */
    steps = 50;
    record(no_checkpoints, 1, -1);
    ck_assert_int_eq(rename(run, map), 0);
    steps = 150;
    unrecorded = 75;
    record(no_checkpoints, 1, -1);
    unrecorded = 0;
    assert_ok(fram_compare(ctx, map, run, page, &c, &e), e);
    ck_assert(c.no_time_shared);
    ck_assert(run_file_has("page.html", "Nothing is of both after their transients and the beginnings of their "
                                        "recordings (from 1.5 s on)."));
    fram_comparison_free(ctx, &c);
    close_all();
}
END_TEST

START_TEST(memory_runs_out)
{
    open_all();
    record(no_checkpoints, 1, -1);
    for (failing_turn turn = {0}; failing_next(&turn);) {
        turn.stride = 1 + turn.n / 4;
        fram_context_definition d;
        fram_context *scarce = NULL;
        fram_pressure_definition p;
        fram_context_default(&d);
        d.memory = failing_memory_resize;
        d.memory_user = &turn.memory;
        fram_pressure_default(&p);
        p.output = map;
        p.force = true;
        p.panel = 4;
        p.to = 0.2;
        turn.status = fram_context_create(&d, &scarce, &e);
        if (turn.status == FRAM_OK)
            turn.status = fram_pressure(scarce, run, &p, &e);
        fram_context_destroy(scarce);
    }
    close_all();
}
END_TEST

TEST_MAIN("rerun", what_was_told_is_named, set_points_that_end_way_points_are_named, steered, steered_a_little,
          other_shares_of_mechanisms, from_a_checkpoint, rows_far_apart, no_row_behind, last_step, beyond_the_end,
          before_a_window_has_passed, up_to_a_failure, no_step, recorded_from_later_on,
          steered_and_recorded_from_later_on, compared_from_where_both_are_recorded, memory_runs_out)
