/* What ice management comes to over a run: warning times and the tired line, also where memory runs out. */
#include "testing.h"

#include "results/manage_parts.h"

#include <math.h>

enum { ROWS = 6, MOMENTS = 4 };

/* Two lines, of which the second swings further, and four frames in which ice comes in 10 to 40 s, the largest of it in
   twice that. */
static fram_status sum_up(context *ctx, manage_summary *out, fram_error *error)
{
    static double time[ROWS] = {0, 1, 2, 3, 4, 5};
    static double first[ROWS] = {0, 1, 0, 1, 0, 1}, second[ROWS] = {0, 3, 0, 3, 0, 3};
    static double three[ROWS] = {3, 3, 3, 3, 3, 3}, four[ROWS] = {4, 4, 4, 4, 4, -8};
    csv_table_column column[] = {{.name = "time", .value = {time, ROWS, ROWS}},
                                 {.name = "line_1_tension", .value = {first, ROWS, ROWS}},
                                 {.name = "line_2_tension", .value = {second, ROWS, ROWS}},
                                 {.name = "line_tension_max", .value = {second, ROWS, ROWS}},
                                 {.name = "ice_force_averaged_x", .value = {three, ROWS, ROWS}},
                                 {.name = "ice_force_averaged_y", .value = {four, ROWS, ROWS}}};
    const int32_t columns = sizeof column / sizeof *column;
    manage_moment moment[MOMENTS] = {{.time = 0}};
    scenario_mooring_line lines = {.count = 2};
    manage_run m = {.ctx = ctx, .d = {.series = {.columns = {column, columns, columns}, .rows = ROWS}}};
    scenario_defaults(&m.d.s, 30);
    m.d.s.vessel.mooring.lines.data = &lines;
    m.d.s.vessel.mooring.lines.count = 1;
    for (int i = 0; i < MOMENTS; i++) {
        moment[i].time = i;
        moment[i].speed = 1;
        moment[i].cover[MANAGE_AT] =
            (manage_cover){.ice = 0.8, .managed = 0.3, .sheet = 0.2, .size_area = 3, .largest = i};
        moment[i].threat = (manage_threat){.nearest = 10.0 * (i + 1), .largest = 20.0 * (i + 1)};
    }
    m.moments.data = moment;
    m.moments.count = m.moments.capacity = MOMENTS;
    return manage_sum_up(&m, out, error);
}

/* Shares are of the ice, the mean size is of its floes, and a tension is no magnitude of two. */
static void check_by_hand(const manage_summary *sums)
{
    assert_relative(sums->place[MANAGE_AT].concentration, 0.8, 1e-12);
    assert_relative(sums->place[MANAGE_AT].managed, 0.375, 1e-12);
    assert_relative(sums->place[MANAGE_AT].sheet, 0.25, 1e-12);
    assert_relative(sums->place[MANAGE_AT].mean, 5, 1e-12);
    ck_assert_double_eq(sums->place[MANAGE_AT].largest, MOMENTS - 1);
    ck_assert_double_eq(sums->largest_time, MOMENTS - 1);
    ck_assert_double_eq(sums->tension_most, 3);
    ck_assert_double_eq(sums->alarm_least, 10);
    ck_assert_double_eq(sums->alarm_median, 25); /* of an even number */
    ck_assert_double_eq(sums->warning_median, 50);
    /* Five half cycles of 3 N in six steps of a second. */
    assert_relative(sums->tension_range, cbrt(2.5 * 27 / 6), 1e-12);
    assert_relative(sums->load_mean, (5 * 5 + sqrt(73.0)) / ROWS, 1e-12);
    assert_relative(sums->load_most, sqrt(73.0), 1e-12);
}

START_TEST(memory_runs_out)
{
    for (failing_turn turn = {0}; failing_next(&turn);) {
        manage_summary sums;
        turn.status = sum_up(&turn.ctx, &sums, &turn.error);
        if (!turn.memory.failed) {
            ck_assert_int_eq(sums.tension_line, 2);
            ck_assert(sums.tension_range > 0 && sums.alarm_least < sums.alarm_median);
            ck_assert(sums.warning_least > sums.alarm_least && sums.warning_median > sums.alarm_median);
            ck_assert_int_gt(turn.n, 3);
            check_by_hand(&sums);
        }
    }
}
END_TEST

TEST_MAIN("manage_sums", memory_runs_out)
