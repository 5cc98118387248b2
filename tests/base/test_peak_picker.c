/* Which local maxima of a series are its largest peaks. */
#include "testing.h"

#include "base/peak_picker.h"

static context ctx;

static void start(peak_picker *p, double separation, double from)
{
    context_init(&ctx);
    ck_assert(peak_picker_init(&ctx, separation, from, 20, p));
}

static void feed(peak_picker *p, const double *value, int count)
{
    for (int i = 0; i < count; i++)
        (void)peak_picker_rises(p, i, value[i]);
    peak_picker_ends(p);
    peak_picker_free(&ctx, p);
}

START_TEST(peaks_stand_apart)
{
    /* 5 at 2; 7 at 10, which a 9 at 11 overtakes; 4 at 20: three peaks, by falling value. */
    static const double value[24] = {0, 1, 5, 2, 1, 1, 1, 1, 1, 1, 7, 9, 3, 2, 1, 0, 0, 0, 0, 1, 4, 1, 0, 0};
    peak_picker p;
    start(&p, 4, 0);
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
    start(&p, 3, 0);
    feed(&p, value, 40);
    ck_assert_int_eq(p.count, 1);
    ck_assert(p.kept[0].time == 1);
    start(&p, 3, 2);
    feed(&p, value, 40);
    ck_assert_int_eq(p.count, 0);
}
END_TEST

/* The ten largest of many, whatever their order; which of them may be kept is known as they rise, and each has a room
   of its own. */
START_TEST(ten_of_many)
{
    peak_picker p;
    start(&p, 2, 0);
    for (int i = 0; i < 50; i++) {
        double height = (i * 17) % 50 + 1;
        bool keeps = peak_picker_rises(&p, 10 * i, height);
        ck_assert(keeps == (p.count < PEAKS_KEPT || height > p.kept[9].value));
        ck_assert_int_le(p.candidate.room, PEAKS_KEPT + 1);
        for (int k = 0; k < p.count; k++)
            ck_assert_int_ne(p.candidate.room, p.kept[k].room);
        ck_assert(!peak_picker_rises(&p, 10 * i + 2, 0));
    }
    peak_picker_ends(&p);
    ck_assert_int_eq(p.count, PEAKS_KEPT);
    for (int i = 0; i < PEAKS_KEPT; i++)
        ck_assert(p.kept[i].value == 50 - i);
    peak_picker_free(&ctx, &p);
}
END_TEST

/* A larger maximum from before the start, 51 at 18, leaves the one at 21 a peak; 35 at 23 belongs to that. */
START_TEST(a_peak_beside_an_earlier_one)
{
    static const double value[30] = {[17] = 45, 51, 44, 39, 40, 30, 35, 10, 5, 20, 10};
    peak_picker p;
    start(&p, 4, 20);
    feed(&p, value, 30);
    ck_assert_int_eq(p.count, 2);
    ck_assert(p.kept[0].value == 40 && p.kept[0].time == 21);
    ck_assert(p.kept[1].value == 20 && p.kept[1].time == 26);
    start(&p, 4, 20);
    ck_assert(!peak_picker_rises(&p, 19, 5) && !peak_picker_keeps(&p));
    ck_assert(!peak_picker_rises(&p, 20, 6) && peak_picker_rises(&p, 21, 7)); /* larger: the peak is after the start */
    peak_picker_ends(&p);
    ck_assert(p.count == 1 && p.kept[0].time == 21);
    ck_assert(!peak_picker_keeps(&p));
    peak_picker_free(&ctx, &p);
}
END_TEST

/* ---- all peaks of a series at once ---- */

enum { SERIES = 600 };
typedef struct whole_series {
    int count, window;
    double value[SERIES];
} whole_series;

/* Larger than all within a window and than its neighbours. */
static bool is_maximum(const whole_series *s, int at)
{
    int reach = s->window > 0 ? s->window : 1;
    for (int i = at - reach; i <= at + reach; i++)
        if (i >= 0 && i < s->count && i != at && s->value[i] >= s->value[at])
            return false;
    return true;
}

/* By falling value, of the maxima after `from` those that stand apart from all before. */
static int choose_from_all(const whole_series *s, int from, int out[PEAKS_KEPT])
{
    int count = 0;
    for (;;) {
        int best = -1;
        for (int i = from > 0 ? from + 1 : 0; i < s->count; i++) {
            bool apart = is_maximum(s, i) && (best < 0 || s->value[i] > s->value[best]);
            for (int k = 0; k < count && apart; k++)
                apart = abs(i - out[k]) >= PEAK_SEPARATION * s->window;
            best = apart ? i : best;
        }
        if (best < 0 || count == PEAKS_KEPT)
            return count;
        out[count++] = best;
    }
}

static void check_series(const whole_series *s, int from)
{
    peak_picker p;
    int chosen[PEAKS_KEPT], count = choose_from_all(s, from, chosen);
    start(&p, PEAK_SEPARATION * s->window, from);
    feed(&p, s->value, s->count);
    ck_assert_int_eq(p.count, count);
    for (int i = 0; i < count; i++)
        ck_assert(p.kept[i].time == chosen[i] && p.kept[i].value == s->value[chosen[i]]);
}

/* Both ways. */
static void check_ways(whole_series *s)
{
    for (int way = 0; way < 2; way++) {
        check_series(s, 0);
        check_series(s, s->count / 3);
        for (int i = 0; i < s->count / 2; i++) {
            double first = s->value[i];
            s->value[i] = s->value[s->count - 1 - i];
            s->value[s->count - 1 - i] = first;
        }
    }
}

/* Series that go up and down at random, and rise or fall in the mean, so that many maxima wait for long. */
START_TEST(peaks_are_those_of_the_whole_series)
{
    static whole_series s;
    uint64_t state = 7;
    for (int round = 0; round < 60; round++) {
        s.count = 100 + round * 8;
        s.window = round % 5 + 1;
        double trend = (round % 7 - 3) * 0.3, level = 1000;
        for (int i = 0; i < s.count; i++) {
            state = state * 6364136223846793005u + 1442695040888963407u;
            double noise = (double)(state >> 40) / (1 << 24) - 0.5;
            level += noise + trend * 0.1;
            s.value[i] = (round % 2 ? level : 1000 + trend * i) + 5 * noise;
        }
        check_ways(&s);
    }
}
END_TEST

/* A load that grows, one maximum each 3 of 4 steps: each second one is a peak, counted from the largest. */
START_TEST(peaks_of_a_load_that_grows)
{
    static whole_series s;
    s.window = 1;
    s.count = 1 + 3 * 12;
    for (int i = 0; i < s.count; i++)
        s.value[i] = i % 3 == 1 ? 400 * (i / 3 + 1) : 0;
    int chosen[PEAKS_KEPT];
    ck_assert_int_eq(choose_from_all(&s, 0, chosen), 6);
    check_ways(&s);
    /* For ever, and as near to each other as can be: what was long ago is given up, and the ten largest are right. */
    peak_picker p;
    start(&p, 40, 0);
    for (int i = 0; i < 11 * 900; i++)
        (void)peak_picker_rises(&p, i, i % 11 == 1 ? 400 * (i / 11 + 1) : 0);
    ck_assert_int_eq(p.awaited_count, PEAKS_AWAITED);
    feed(&p, NULL, 0);
    ck_assert_int_eq(p.count, PEAKS_KEPT);
    for (int i = 0; i < PEAKS_KEPT; i++)
        ck_assert(p.kept[i].value == 400 * (900 - 4 * i));
}
END_TEST

TEST_MAIN("peak_picker", peaks_stand_apart, flanks_and_starts, ten_of_many, a_peak_beside_an_earlier_one,
          peaks_are_those_of_the_whole_series, peaks_of_a_load_that_grows)
