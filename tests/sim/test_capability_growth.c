/* Measured ice loads that were still building up are told, with by how much, at which speed, and what to do. */
#include "sim/capability.h"
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

TEST_MAIN("capability growth", growth_is_told)
