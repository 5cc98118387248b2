/* How many seeds a condition takes, and the interval of a mean. */
#include "testing.h"

#include "base/random.h"
#include "base/transcendental.h"
#include "study/extremes.h"
#include "study/seeds.h"

START_TEST(the_interval_is_students)
{
    const double value[] = {1, 2, 3, 4, (double)NAN};
    seed_interval i = seed_interval_of(value, 5, 0.95);
    assert_relative(i.mean, 2.5, 1e-15);
    assert_relative(i.half, 3.182446305284263 * sqrt(5.0 / 3 / 4), 1e-12);
    ck_assert(isnan(seed_interval_of(value, 1, 0.95).half));
    const double large[] = {1e200, 3e200};
    ck_assert(isnan(seed_interval_of(large, 2, 0.95).half));
}
END_TEST

/* Of 2,000 samples of 6 from a normal law, 95 % of the intervals hold the mean, within three standard errors. */
START_TEST(intervals_cover_the_mean_as_often_as_they_say)
{
    int held = 0;
    for (uint32_t trial = 0; trial < 2000; trial++) {
        random_stream r = random_begin(5, 3, trial);
        double value[6];
        for (int i = 0; i < 6; i++)
            value[i] = 10 + 3 * random_normal(&r);
        seed_interval i = seed_interval_of(value, 6, 0.95);
        held += fabs(i.mean - 10) <= i.half;
    }
    ck_assert_int_ge(held, 1900 - 30);
    ck_assert_int_le(held, 1900 + 30);
}
END_TEST

START_TEST(seeds_go_on_until_the_interval_is_narrow)
{
    study_seeds rule = {.first = 1, .least = 4, .most = 40, .mean_within = 0.1, .confidence = 0.95};
    double wide[40], calm[40];
    for (int i = 0; i < 40; i++) {
        wide[i] = i % 2 ? 1 : 100;
        calm[i] = 100 + i % 2;
    }
    ck_assert_int_eq(seeds_wanted(&rule, wide, wide, NULL, 0), 4);
    ck_assert_int_eq(seeds_wanted(&rule, wide, wide, NULL, 3), 4);
    ck_assert_int_eq(seeds_wanted(&rule, wide, wide, NULL, 4), 5);
    ck_assert_int_eq(seeds_wanted(&rule, wide, wide, NULL, 40), 40);
    ck_assert_int_eq(seeds_wanted(&rule, calm, wide, NULL, 40), 4);
    rule.largest_within = 0.1;
    ck_assert_int_eq(seeds_wanted(&rule, calm, wide, NULL, 40), 40);
    /* One of both is not enough, and of means below nothing their size counts. */
    rule.mean_within = 0.1;
    ck_assert_int_eq(seeds_wanted(&rule, wide, calm, NULL, 40), 40);
    double below[40];
    for (int i = 0; i < 40; i++)
        below[i] = -100 - i % 2;
    ck_assert_int_eq(seeds_wanted(&rule, below, calm, NULL, 40), 4);
    /* A quarter more at a time from eight on, and never more than the most: 4 5 6 7 8 10 12 15 18 22 27 33 40. */
    ck_assert_int_eq(seeds_wanted(&rule, wide, wide, NULL, 8), 10);
    ck_assert_int_eq(seeds_wanted(&rule, wide, wide, NULL, 27), 33);
    ck_assert_int_eq(seeds_wanted(&rule, wide, wide, NULL, 33), 40);
    rule.most = 37;
    ck_assert_int_eq(seeds_wanted(&rule, wide, wide, NULL, 33), 37);
    rule.most = 40;
    /* What later seeds say changes nothing that was decided before them. */
    calm[20] = 1e9;
    ck_assert_int_eq(seeds_wanted(&rule, calm, calm, NULL, 40), 4);
    /* Where all failed no other would tell more; one that ended well is asked on. */
    double failed[40];
    for (int i = 0; i < 40; i++)
        failed[i] = (double)NAN;
    ck_assert_int_eq(seeds_wanted(&rule, failed, failed, NULL, 40), 4);
    failed[2] = 1;
    ck_assert_int_gt(seeds_wanted(&rule, failed, failed, NULL, 4), 4);
    const study_seeds fixed = {.first = 1, .least = 7, .most = 7, .confidence = 0.95};
    ck_assert_int_eq(seeds_wanted(&fixed, wide, wide, NULL, 40), 7);
}
END_TEST

/* Of Gumbel's maxima with a scale of a tenth of the location the interval of what 20 of them reach narrows slowly; ten
   runs carry a law. */
START_TEST(seeds_go_on_until_the_rare_load_is_known)
{
    study_seeds rule = {.first = 1, .least = 4, .most = 200, .extreme_within = 0.1, .confidence = 0.95};
    double largest[200];
    context ctx;
    context_init(&ctx);
    seeds_extreme rare = {&ctx, 20, 0.95, false};
    random_stream r = random_begin(8, 3, 0);
    for (int i = 0; i < 200; i++)
        largest[i] = 10 - real_log(-real_log(1 - random_unit(&r)));
    int32_t wanted = seeds_wanted(&rule, largest, largest, &rare, 200);
    ck_assert_int_gt(wanted, 10);
    ck_assert_int_lt(wanted, 200);
    /* Half the interval of so many is a tenth of the level, and of a quarter fewer it is more. */
    for (int k = 0; k < 2; k++) {
        extreme_request ask;
        extreme_result told;
        extreme_request_default(&ask);
        ask.duration = 20;
        int32_t count = k == 0 ? wanted : (int32_t)(0.75 * wanted);
        assert_ok(extremes_of_maxima(&ctx, largest, count, 1, EXTREME_GUMBEL, &ask, &told, NULL), (fram_error){0});
        double half = 0.5 * (told.most_probable.high - told.most_probable.low);
        ck_assert_int_eq(half <= 0.1 * told.most_probable.level, k == 0);
    }
    rule.extreme_within = 0.03;
    ck_assert_int_gt(seeds_wanted(&rule, largest, largest, &rare, 200), wanted);
    rule.extreme_within = 10;
    ck_assert_int_ge(seeds_wanted(&rule, largest, largest, &rare, 200), 10);
    /* Runs that are all alike, and a rule that does not ask. */
    for (int i = 0; i < 200; i++)
        largest[i] = 0;
    ck_assert_int_eq(seeds_wanted(&rule, largest, largest, &rare, 200), 4);
    rule.extreme_within = 0;
    ck_assert_int_eq(seeds_wanted(&rule, largest, largest, &rare, 200), 4);
}
END_TEST

TEST_MAIN("seeds", the_interval_is_students, intervals_cover_the_mean_as_often_as_they_say,
          seeds_go_on_until_the_interval_is_narrow, seeds_go_on_until_the_rare_load_is_known)
