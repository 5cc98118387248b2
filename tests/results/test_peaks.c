/* Peaks in words. */
#include "results/peaks.h"
#include "testing.h"

START_TEST(breaks_are_one_or_many)
{
    static const struct {
        int32_t bendings, splits;
        const char *words;
    } cases[] = {{0, 2, "0 breaks in bending and 2 splits"},
                 {1, 0, "1 break in bending and 0 splits"},
                 {7, 1, "7 breaks in bending and 1 split"}};
    context ctx;
    context_init(&ctx);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        text_buffer out = {0};
        peak_tell_breaks(&ctx, &(peak_breaks){.bendings = cases[i].bendings, .splits = cases[i].splits}, &out);
        ck_assert_str_eq(out.data, cases[i].words);
        text_free(&ctx, &out);
    }
}
END_TEST

TEST_MAIN("peaks", breaks_are_one_or_many)
