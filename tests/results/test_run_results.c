/* What is told of a run as its figures are made. */
#include "scratch.h"

#include "io/scenario_file.h"
#include "results/run_results.h"

static const char text[] =
    "vessel: {mode: towed, x: 0, speed: 1, hull: {form: box, length: 60, beam: 12, draught: 4, freeboard: 2}}\n"
    "ice: {source: floes, floes: [{length: 9, width: 9, x: 80}]}\n";
static const char series[] =
    "time[s],ice_force_body_x[N],ice_force_body_y[N],ice_force_averaged_x[N],ice_force_averaged_y[N]\n"
    "1,0,0,0,0\n2,0,0,0,0\n";

static void keep(void *user, log_level level, const char *line)
{
    (void)level;
    if (strstr(line, "met no ice"))
        snprintf(user, 200, "%s", line);
}

/* A build without cairo left no picture to look at. */
START_TEST(loads_that_stay_zero_are_told_with_what_there_is_to_see)
{
    scratch f = scratch_make();
    context ctx;
    scenario s;
    fram_error error = {0};
    char told[200] = "";
    context_init(&ctx);
    ctx.log = keep, ctx.log_user = told, ctx.verbosity = LOG_WARNING;
    assert_ok(scenario_parse(&ctx, "a.yaml", text, strlen(text), NULL, &s, &error), error);
    scratch_write(scratch_path(&f, "series.csv"), series, strlen(series));
    const station_outcome none = {.time = 2};
    assert_ok(run_results_write(&ctx, &s, &none, f.folder, &error), error);
    ck_assert_str_eq(told, "the vessel met no ice until t = 2 s: `fram view` shows where both are");
    scratch_write(scratch_path(&f, "plan.png"), "a", 1);
    assert_ok(run_results_write(&ctx, &s, &none, f.folder, &error), error);
    ck_assert_str_eq(told, "the vessel met no ice until t = 2 s: plan.png shows where both are");
    scenario_free(&ctx, &s);
    unlink(scratch_path(&f, "loads.png"));
    unlink(scratch_path(&f, "plan.png"));
    scratch_remove(&f, "series.csv");
}
END_TEST

TEST_MAIN("run_results", loads_that_stay_zero_are_told_with_what_there_is_to_see)
