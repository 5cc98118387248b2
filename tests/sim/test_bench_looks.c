/* Looks at a run on its way are bounded by processor time, in their order, and end where the run does. */
#include "base/clock.h"
#include "io/scenario_file.h"
#include "sim/bench_looks.h"
#include "testing.h"

static void look_at(const char *duration, const double after[3], bench_look out[3], double *build)
{
    context ctx;
    context_init(&ctx);
    scenario s = {0};
    fram_error error = {0};
    const char *const items[] = {duration, "run.transient=0"};
    const scenario_overrides overrides = {items, 2};
    assert_ok(scenario_read(&ctx, "scenes/demo.yaml", &overrides, &s, &error), error);
    assert_ok(bench_looks(&ctx, &s, NULL, after, 3, out, build, &error), error);
    scenario_free(&ctx, &s);
}

/* However dear a step becomes, all takes what was asked for and the last look, of half a second at most. */
START_TEST(time_bounds_the_way)
{
    const double after[3] = {0, 0.8, 1.5};
    bench_look found[3];
    double build = 0, began = clock_processor();
    look_at("run.duration=75", after, found, &build);
    double took = clock_processor() - began - build;
    ck_assert_msg(took >= after[2] && took < after[2] + 1.2, "%g s", took);
    for (int i = 0; i < 3; i++) {
        ck_assert_msg(found[i].time > 0 && found[i].floes > 0, "look %d", i);
        ck_assert(found[i].steps >= 3 && found[i].steps <= 60);
        ck_assert(i == 0 || found[i].at >= found[i - 1].at + found[i - 1].steps);
    }
    /* The looks are on the way: their steps are made once. */
    ck_assert(found[0].at >= 1 && found[0].at <= 10);
    ck_assert(found[1].at > found[0].at + found[0].steps && found[2].at > found[1].at + found[1].steps);
}
END_TEST

START_TEST(a_run_that_ends_before_has_its_last_look_again)
{
    const double after[3] = {0, 20, 40};
    bench_look found[3];
    double build = 0, began = clock_processor();
    look_at("run.duration=0.9", after, found, &build);
    ck_assert_double_lt(clock_processor() - began, 10);
    ck_assert_int_eq(found[0].at, 10);
    ck_assert_int_eq(found[2].at, found[1].at);
    ck_assert_double_eq(found[2].time, found[1].time);
    ck_assert_int_eq(found[2].floes, found[1].floes);
    ck_assert_int_gt(found[1].at, 0);
    ck_assert_int_le(found[1].at + found[1].steps, 90 + 60);
}
END_TEST

/* What is left behind the first look is looked at, however little. */
START_TEST(a_short_run_is_seen_to_its_end)
{
    static const struct {
        const char *duration;
        int64_t steps;
    } runs[] = {{"run.duration=0.05", 5},
                {"run.duration=0.6", 60},
                {"run.duration=0.8", 80},
                {"run.duration=1.2", 120},
                {"run.duration=1.5", 150}};
    const double after[3] = {0, 20, 40};
    for (size_t i = 0; i < sizeof runs / sizeof *runs; i++) {
        bench_look found[3];
        double build = 0;
        look_at(runs[i].duration, after, found, &build);
        ck_assert_int_eq(found[2].at + found[2].steps, runs[i].steps);
        ck_assert(found[0].steps > 0 && found[0].steps <= 60 && found[2].time > 0);
    }
}
END_TEST

TEST_MAIN("looks at a run", time_bounds_the_way, a_run_that_ends_before_has_its_last_look_again,
          a_short_run_is_seen_to_its_end)
