/* Values of a whole run in bounded memory: the end counts as the beginning does. */
#include "results/thinned.h"
#include "testing.h"

START_TEST(few_are_all_there)
{
    context ctx;
    thinned t = {0};
    context_init(&ctx);
    assert_bits(thinned_percentile(&t, 50), 0);
    for (int i = 100; i >= 0; i--)
        ck_assert(thinned_add(&ctx, &t, i));
    assert_bits(thinned_percentile(&t, 0), 0);
    assert_bits(thinned_percentile(&t, 98), 98);
    assert_bits(thinned_percentile(&t, 100), 100);
    array_free(&ctx, &t.value);
}
END_TEST

/* Loads that rise through a run: a bound on the first values would tell of its beginning only. */
START_TEST(many_are_thinned_evenly)
{
    enum { MANY = 5 * THINNED_MOST / 2 + 7, STEP = 4 };
    context ctx;
    thinned t = {0};
    context_init(&ctx);
    for (int i = 0; i < MANY; i++)
        ck_assert(thinned_add(&ctx, &t, i));
    ck_assert_int_eq(t.value.count, (MANY + STEP - 1) / STEP);
    int others = 0;
    for (int i = 0; i < t.value.count; i++)
        others += t.value.data[i] != STEP * i;
    ck_assert_int_eq(others, 0);
    for (int percent = 0; percent <= 100; percent += 50)
        assert_absolute(thinned_percentile(&t, percent), MANY * (percent / 100.0), 2 * STEP);
    array_free(&ctx, &t.value);
}
END_TEST

START_TEST(memory_runs_out)
{
    for (failing_turn turn = {0}; failing_next(&turn);) {
        thinned t = {0};
        bool good = true;
        for (int i = 0; i < 1000 && good; i++)
            good = thinned_add(&turn.ctx, &t, i);
        array_free(&turn.ctx, &t.value);
        turn.status = good ? FRAM_OK : FRAM_ERROR_MEMORY;
    }
}
END_TEST

TEST_MAIN("thinned", few_are_all_there, many_are_thinned_evenly, memory_runs_out)
