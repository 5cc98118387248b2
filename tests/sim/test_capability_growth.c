/* Measured ice loads that were still building up are told, with by how much, at which speed, and what to do. */
#include "sim/capability.h"
#include "sim/capability_growth.h"
#include "testing.h"

#include <stdio.h>

static void keep(void *user, log_level level, const char *text)
{
    (void)level;
    snprintf(user, 500, "%s", text);
}

START_TEST(growth_is_told)
{
    static const struct {
        int32_t measured;
        double growth, most;
        const char *told;
    } rows[] = {{3, 1.2, 9, NULL},
                {3, 0.3, 9, NULL},
                {0, 5, 9, NULL},
                {3, 1.5, 2.5, "second half of what counts are 1.5 times as large (from 90 deg 2.5 times)"},
                {3, 1.5, HUGE_VAL, "second half of what counts are 1.5 times as large; "},
                {3, HUGE_VAL, HUGE_VAL, "second half of what counts are there alone; "},
                {1, 2, 2, "at 0.3 m/s, at which 36 m of ice came in 120 s"},
                {1, 2, 2, "(240 s)"}};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        context ctx;
        char told[500] = "";
        context_init(&ctx);
        ctx.log = keep;
        ctx.log_user = told;
        const capability c = {.options.measure = 120,
                              .loads = {.measured = rows[i].measured,
                                        .growth = rows[i].growth,
                                        .growth_speed = 0.3,
                                        .growth_most = rows[i].most,
                                        .growth_from = radians(90)}};
        capability_tell_growth(&ctx, &c);
        ck_assert_msg(rows[i].told ? strstr(told, rows[i].told) != NULL : told[0] == '\0', "%d: %s", (int)i, told);
        ck_assert(capability_builds_up(&c) == (rows[i].told != NULL));
    }
}
END_TEST

/* Two halves of a run that count, of so many values each, along a direction. */
static void check_halves(double first, double second, double expected_first, double expected_second)
{
    enum { COUNT = 90, AFTER = 30 };
    double time[COUNT], x[COUNT], y[COUNT];
    for (int i = 0; i < COUNT; i++) {
        double size = i < AFTER ? 1e9 : i < (AFTER + COUNT) / 2 ? first : second;
        time[i] = i + 1;
        x[i] = 0.6 * size;
        y[i] = -0.8 * size;
    }
    const load_halves half = load_halves_find(time, x, y, COUNT, AFTER);
    ck_assert_double_eq_tol(half.first, expected_first, 1e-9);
    ck_assert_double_eq_tol(half.second, expected_second, 1e-9);
}

/* Halves along two directions, of which only a little is left over together. */
static void check_turned(vec2 first, vec2 second, double expected_first, double expected_second)
{
    const double time[] = {1, 2, 3, 4}, x[] = {first.x, first.x, second.x, second.x},
                 y[] = {first.y, first.y, second.y, second.y};
    const load_halves half = load_halves_find(time, x, y, 4, 0);
    ck_assert_double_eq_tol(half.first, expected_first, 1e-4);
    ck_assert_double_eq_tol(half.second, expected_second, 1e-4);
}

START_TEST(halves_that_turn_have_sizes)
{
    check_turned(vec2_make(-3, 0), vec2_make(3, 0.01), 3, 3);
    check_turned(vec2_make(-3, 0), vec2_make(3, 0), 3, 3);
    check_turned(vec2_make(-100, 0), vec2_make(100, 1), 100, 100.005);
    check_turned(vec2_make(-3, 0.2), vec2_make(3, 0.5), 3.00666, 3.04138);
    check_turned(vec2_make(10, 0), vec2_make(0, 10), 10, 10);
}
END_TEST

/* A load that turned round was there: it has not grown from nothing. */
START_TEST(halves_have_sizes)
{
    check_halves(2, 3, 2, 3);
    check_halves(-2, 3, 2, 3);
    check_halves(-3, 2, 3, 2);
    check_halves(0, 5, 0, 5);
    check_halves(0, 0, 0, 0);
}
END_TEST

START_TEST(what_is_small_does_not_count)
{
    enum { SPEEDS = 2, DIRECTIONS = 3 };
    static const struct {
        load_halves half[DIRECTIONS * SPEEDS]; /* by direction, at both speeds */
        double growth, speed, most, from_deg;
    } rows[] = {
        /* The larger growth, and of its directions the one that grows most. */
        {{{50, 50}, {20, 40}, {50, 50}, {10, 60}, {50, 50}, {20, 20}}, 2.4, 1, 6, 120},
        /* A direction of under a tenth of the largest one's load does not count: one that only just touched. */
        {{{50, 50}, {40, 60}, {50, 50}, {0, 9}, {50, 50}, {40, 40}}, 109.0 / 80, 1, 1.5, 0},
        {{{50, 50}, {40, 60}, {50, 50}, {0, 11}, {50, 50}, {40, 40}}, 111.0 / 80, 1, HUGE_VAL, 120},
        /* Nor does a speed of under a tenth. */
        {{{1, 8}, {50, 50}, {1, 8}, {50, 50}, {1, 8}, {50, 50}}, 1, 1, 1, 0},
        {{{1, 10}, {50, 50}, {1, 10}, {50, 50}, {1, 10}, {50, 50}}, 10, 0.5, 10, 0},
        /* Halves of the others' mirrored loads are none. */
        {{{0, 9}, {0, 90}, {0, 0}, {0, 0}, {0, 0}, {0, 0}}, HUGE_VAL, 0.5, HUGE_VAL, 0},
        {{{0, 0}}, 1, 0.5, 1, 0},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        capability_loads l = {.measured = DIRECTIONS};
        load_growth_find(rows[i].half, DIRECTIONS, SPEEDS, 0.5, &l);
        ck_assert_msg(l.growth == rows[i].growth && l.growth_speed == rows[i].speed, "%d: %g at %g", (int)i, l.growth,
                      l.growth_speed);
        ck_assert_msg(l.growth_most == rows[i].most && fabs(degrees(l.growth_from) - rows[i].from_deg) < 1e-9,
                      "%d: most %g from %g", (int)i, l.growth_most, degrees(l.growth_from));
    }
}
END_TEST

TEST_MAIN("capability growth", growth_is_told, halves_have_sizes, halves_that_turn_have_sizes,
          what_is_small_does_not_count)
