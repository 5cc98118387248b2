/* Which local maxima of a series are its largest peaks. */
#include "testing.h"

#include "base/peak_picker.h"

static void feed(peak_picker *p, const double *value, int count)
{
    for (int i = 0; i < count; i++) {
        (void)peak_picker_settles(p, i);
        (void)peak_picker_rises(p, i, value[i]);
    }
    (void)peak_picker_ends(p);
}

START_TEST(peaks_stand_apart)
{
    /* 5 at 2; 7 at 10, which a 9 at 11 overtakes; 4 at 20: three peaks, by falling value. */
    static const double value[24] = {0, 1, 5, 2, 1, 1, 1, 1, 1, 1, 7, 9, 3, 2, 1, 0, 0, 0, 0, 1, 4, 1, 0, 0};
    peak_picker p;
    peak_picker_init(&p, 4, 0);
    feed(&p, value, 24);
    ck_assert_int_eq(p.count, 3);
    ck_assert(p.kept[0].value == 9 && p.kept[0].time == 11);
    ck_assert(p.kept[1].value == 5 && p.kept[1].time == 2);
    ck_assert(p.kept[2].value == 4 && p.kept[2].time == 20);
}
END_TEST

/* Down a long flank, and before the start, nothing is a peak. */
START_TEST(flanks_and_starts)
{
    double value[40];
    for (int i = 0; i < 40; i++)
        value[i] = 100 - i;
    value[0] = 0;
    peak_picker p;
    peak_picker_init(&p, 3, 0);
    feed(&p, value, 40);
    ck_assert_int_eq(p.count, 1);
    ck_assert(p.kept[0].time == 1);
    peak_picker_init(&p, 3, 2);
    feed(&p, value, 40);
    ck_assert_int_eq(p.count, 0);
}
END_TEST

/* The ten largest of many, whatever their order; the index says where each went. */
START_TEST(ten_of_many)
{
    peak_picker p;
    peak_picker_init(&p, 2, 0);
    int kept = 0;
    for (int i = 0; i < 50; i++) {
        double height = (i * 17) % 50 + 1;
        ck_assert(peak_picker_rises(&p, 10 * i, height) == (p.count < PEAKS_KEPT || height > p.kept[9].value));
        int32_t at = peak_picker_settles(&p, 10 * i + 2);
        kept += at >= 0;
        ck_assert(at < 0 || p.kept[at].value == height);
        (void)peak_picker_rises(&p, 10 * i + 2, 0);
    }
    ck_assert(kept >= 10);
    ck_assert_int_eq(p.count, PEAKS_KEPT);
    for (int i = 0; i < PEAKS_KEPT; i++)
        ck_assert(p.kept[i].value == 50 - i);
}
END_TEST

/* What is left of a larger peak from before the start is none: 40 at 21 belongs to 51 at 18; 20 at 26 stands apart. */
START_TEST(the_rest_of_an_earlier_peak)
{
    static const double value[30] = {[17] = 45, 51, 44, 39, 40, 30, 20, 10, 5, 20, 10};
    peak_picker p;
    peak_picker_init(&p, 4, 20);
    feed(&p, value, 30);
    ck_assert_int_eq(p.count, 1);
    ck_assert(p.kept[0].value == 20 && p.kept[0].time == 26);
    peak_picker_init(&p, 4, 20);
    ck_assert(!peak_picker_rises(&p, 19, 5) && !peak_picker_keeps(&p));
    ck_assert(!peak_picker_rises(&p, 20, 6) && peak_picker_rises(&p, 21, 7)); /* larger: the peak is after the start */
    ck_assert_int_eq(peak_picker_ends(&p), 0);
    ck_assert(!peak_picker_keeps(&p));
}
END_TEST

TEST_MAIN("peak_picker", peaks_stand_apart, flanks_and_starts, ten_of_many, the_rest_of_an_earlier_peak)
