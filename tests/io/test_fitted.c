/* Texts and charts on a page: what is too long ends in dots where its room does, and bands have gaps where there is
   nothing. */
#include "io/chart.h"
#include "io/chart_ticks.h"
#include "io/image.h"

#include "testing.h"

#include <math.h>

#ifdef FRAM_HAVE_CAIRO

enum { WIDTH = 600, HEIGHT = 40 };

/* The last column with ink, -1 on a white page; its columns are counted. */
static int last_ink(cairo_t *page, int *count)
{
    cairo_surface_t *surface = cairo_get_target(page);
    int last = -1;
    cairo_surface_flush(surface);
    *count = 0;
    for (int x = 0; x < WIDTH; x++) {
        bool ink = false;
        for (int y = 0; y < HEIGHT; y++)
            ink =
                ink || cairo_image_surface_get_data(surface)[y * cairo_image_surface_get_stride(surface) + 4 * x] < 128;
        *count += ink;
        last = ink ? x : last;
    }
    return last;
}

static int written(const char *text, double room, int *count)
{
    cairo_t *page = NULL;
    fram_error error;
    ck_assert_int_eq(image_begin(WIDTH, HEIGHT, &page, &error), FRAM_OK);
    image_set_colour(page, (image_colour){0, 0, 0});
    image_text_fitted(page, 10, 25, 17, true, room, text);
    int last = last_ink(page, count);
    cairo_destroy(page);
    return last;
}

START_TEST(texts_end_in_their_room)
{
    static const char text[] = "A title of a scenario that tells more than there is room for, \xc3\xa4\xc3\xb6\xc3\xbc";
    int all, some, none, whole = written(text, 1e4, &all);
    ck_assert_int_gt(whole, 400);
    for (double room = 60; room < 420; room += 7) {
        int last = written(text, room, &some);
        ck_assert_msg(last <= 10 + room && last > room - 25, "%g pixels: up to %d", room, last);
        ck_assert_int_lt(some, all);
    }
    /* What fits stays as it is; in no room stands nothing. */
    ck_assert_int_eq(written("short", 100, &some), written("short", 1e4, &all));
    ck_assert_int_eq(some, all);
    ck_assert_int_eq(written(text, 5, &none), -1);
    ck_assert_int_eq(written("", 100, &none), -1);
}
END_TEST

/* What is at the end, as a unit, is never cut off. */
START_TEST(ends_are_kept)
{
    static const char text[] = "a_vessel.a_channel_of_it [kN m]";
    const char *end = strchr(text, ' ');
    cairo_t *page = NULL;
    fram_error error;
    ck_assert_int_eq(image_begin(WIDTH, HEIGHT, &page, &error), FRAM_OK);
    const double all = image_text_width(page, 13, false, text), least = image_text_width(page, 13, false, end);
    for (double room = 0; room < all + 9; room += 9) {
        char part[IMAGE_FITTED_SIZE];
        const char *found = image_fit(page, 13, false, room, text, end, part);
        ck_assert_int_eq(found == text, room >= all);
        ck_assert_str_eq(found + strlen(found) - strlen(end), end);
        ck_assert(image_text_width(page, 13, false, found) <= fmax(room, least));
    }
    cairo_destroy(page);
}
END_TEST

/* Columns of a part of a page that have ink. */
static int inked(cairo_t *page, int left, int right, int top, int bottom)
{
    cairo_surface_t *surface = cairo_get_target(page);
    cairo_surface_flush(surface);
    const unsigned char *data = cairo_image_surface_get_data(surface);
    int columns = 0;
    for (int x = left; x < right; x++) {
        bool ink = false;
        for (int y = top; y < bottom; y++)
            ink = ink || data[y * cairo_image_surface_get_stride(surface) + 4 * x] < 200;
        columns += ink;
    }
    return columns;
}

/* Lines that are too long go on below, set in, from word to word. */
START_TEST(lines_are_broken_at_words)
{
    enum { LINES = 5, STEP = 19, LEFT = 10, ROOM = 240, HIGH = LINES * STEP + 10 };
    static const struct {
        const char *text;
        int lines, set_in; /* how many, and which one of them is */
    } rows[] = {{"one line\n  another\n\nend", 4, 1},
                {"a line with many words, of which one is the last\nend", 3, 1},
                {"a_word_that_is_longer_than_the_room_is_cut_off", 1, -1},
                {"", 0, -1}};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        cairo_t *page = NULL;
        fram_error error;
        int lines = 0;
        ck_assert_int_eq(image_begin(WIDTH, HIGH, &page, &error), FRAM_OK);
        image_set_colour(page, (image_colour){0, 0, 0});
        image_text_lines(page, LEFT, STEP, 13, ROOM, rows[i].text);
        for (int k = 0; k < LINES; k++) {
            int top = k * STEP + 6, bottom = top + STEP - 1;
            if (inked(page, 0, WIDTH, top, bottom) == 0)
                continue;
            lines = k + 1;
            ck_assert_int_eq(inked(page, LEFT, LEFT + 6, top, bottom) == 0, k == rows[i].set_in);
        }
        ck_assert_msg(lines == rows[i].lines, "%zu: %d lines", i, lines);
        ck_assert_int_eq(inked(page, LEFT + ROOM, WIDTH, 0, HIGH), 0);
        cairo_destroy(page);
    }
}
END_TEST

/* Whether the page has other than white on an upright line. */
static bool is_marked(cairo_t *page, int x, int top, int bottom)
{
    cairo_surface_t *surface = cairo_get_target(page);
    cairo_surface_flush(surface);
    for (int y = top; y < bottom; y++) {
        const unsigned char *p =
            cairo_image_surface_get_data(surface) + y * cairo_image_surface_get_stride(surface) + 4 * x;
        /* The grid is grey. */
        if (p[0] != p[2] && (p[0] < 200 || p[2] < 200))
            return true;
    }
    return false;
}

START_TEST(bands_have_gaps)
{
    enum { WIDE = 600, HIGH = 400, ROWS = 8 };
    /* At 6 stands a row alone. */
    const double none = (double)NAN, x[ROWS] = {0, 1, 2, 3, 4, 5, 6, 7};
    const double low[ROWS] = {1, 1, none, 1, 1, none, 1, none}, high[ROWS] = {4, 4, none, 4, 4, none, 4, none};
    const double ends[2] = {0, 7}, zero[2] = {0, 0};
    chart_line lines[3] = {chart_line_make("", x, low, ROWS, false), chart_line_make("", x, low, ROWS, true),
                           chart_line_make("", ends, zero, 2, false)};
    lines[0].style = CHART_BAND;
    lines[0].y2 = high;
    lines[0].solid = true;
    lines[0].colour = lines[1].colour = 3;
    /* The frame alone goes on to 7. */
    lines[2].colour = 1;
    for (int what = 0; what < 2; what++) { /* the band, the line */
        const chart_line shown[2] = {lines[what], lines[2]};
        const chart c = chart_make("", "", "", "", shown, 2);
        cairo_t *page = NULL;
        fram_error error;
        ck_assert_int_eq(image_begin(WIDE, HIGH, &page, &error), FRAM_OK);
        chart_draw(page, &c, WIDE, HIGH, false);
        /* The axis goes from 86 to 578 pixels. */
        for (int tenth = 1; tenth < 70; tenth++) {
            bool there = tenth < 10 || (tenth > 30 && tenth < 40) || tenth == 60;
            int column = (int)(86 + tenth * (578 - 86) / 70.0);
            if (tenth % 10 != 0 || tenth == 60)
                ck_assert_msg(is_marked(page, column, 60, 330) == there, "%d at x = %g", what, tenth / 10.0);
        }
        cairo_destroy(page);
    }
}
END_TEST

/* Neighbours are told apart wherever the axis lies, and as before where six digits are enough. */
START_TEST(ticks_have_the_digits_of_their_step)
{
    static const struct {
        double lo, hi;
        const char *first, *last;
    } rows[] = {{10800, 10800.5, "10800", "10800.5"},
                {10800.03, 10800.44, "10800.05", "10800.4"},
                {-6999990, -6999989.15, "-6999990", "-6999989.2"},
                {123456789, 123456790, "123456789", "123456790"},
                {1e9, 1e9 + 1.1e-4, "1000000000", "1000000000.0001"},
                {0, 1e6, "0", "1e+06"},
                {-0.00015, 0, "-0.00014", "0"},
                {-7e6, 0, "-7e+06", "0"}};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        char text[TICK_TEXT], before[TICK_TEXT] = "";
        const tick_row t = tick_row_of(rows[i].lo, rows[i].hi, 10, 0, false);
        for (int k = 0; k < t.count; k++) {
            tick_text(&t, k, text);
            ck_assert_str_ne(text, before);
            if (k == 0)
                ck_assert_str_eq(text, rows[i].first);
            strcpy(before, text);
        }
        ck_assert_str_eq(text, rows[i].last);
    }
}
END_TEST

/* Labels end before the title of their axis and before the edge of the page, and do not meet. */
START_TEST(labels_have_their_room)
{
    enum { WIDE = 620, HIGH = 400, GAP = 23, LABELS = 26 };
    const double at[2] = {10800, 10800.5}, y[2][2] = {{-6999990, -6999989.2}, {-0.00015, 0}};
    for (int what = 0; what < 2; what++) {
        const chart_line line = chart_line_make("", at, y[what], 2, false);
        chart c = chart_make("", "", "time [s]", "gap [m]", &line, 1);
        c.free_y = true;
        cairo_t *page = NULL;
        fram_error error;
        ck_assert_int_eq(image_begin(WIDE, HIGH, &page, &error), FRAM_OK);
        chart_draw(page, &c, WIDE, HIGH, false);
        ck_assert_int_gt(inked(page, 0, GAP, 0, HIGH), 8);
        ck_assert_int_eq(inked(page, GAP, LABELS, 0, HIGH), 0);
        ck_assert_int_gt(inked(page, LABELS, 80, 0, HIGH), 40);
        ck_assert_int_eq(inked(page, WIDE - 1, WIDE, 0, HIGH), 0);
        cairo_destroy(page);
    }
    /* Of ticks that stand closer than their labels are wide every second one is told, zero among them. */
    const tick_row t = tick_row_of(-3, 3, 10, 1, false);
    for (int i = 0; i < t.count; i++)
        ck_assert_int_eq(tick_is_told(&t, i, 2), i % 2 == 1);
}
END_TEST

/* A long title of an axis ends where its chart does, whatever stands beside that. */
START_TEST(titles_have_their_room)
{
    enum { WIDE = 300, HIGH = 240, BESIDE = 150 };
    static const char title[] = "a name of a vessel. and of a channel which are longer than the chart is wide [kN m]";
    const double at[2] = {0, 1};
    const chart_line line = chart_line_make("", at, at, 2, false);
    const chart c = chart_make("", "", title, title, &line, 1);
    cairo_t *page = NULL;
    fram_error error;
    ck_assert_int_eq(image_begin(WIDE + 2 * BESIDE, HIGH + 2 * BESIDE, &page, &error), FRAM_OK);
    cairo_translate(page, BESIDE, BESIDE);
    chart_draw(page, &c, WIDE, HIGH, false);
    for (int side = 0; side < 2; side++) {
        const int left = side * (WIDE + BESIDE), top = side * (HIGH + BESIDE);
        ck_assert_int_eq(inked(page, left, left + BESIDE, 0, HIGH + 2 * BESIDE), 0);
        ck_assert_int_eq(inked(page, 0, WIDE + 2 * BESIDE, top, top + BESIDE), 0);
    }
    ck_assert_int_gt(inked(page, BESIDE, BESIDE + 23, BESIDE, BESIDE + HIGH), 8);
    cairo_destroy(page);
}
END_TEST

/* Whether a page has ink between two columns and two rows. */
static bool has_ink(cairo_t *page, int left, int right, int top, int bottom)
{
    bool found = false;
    for (int x = left; x < right; x++)
        found = found || is_marked(page, x, top, bottom);
    return found;
}

/* What lies beyond an axis that ends before it runs out of the frame, up to its edge and no further. */
START_TEST(lines_run_out_of_the_frame)
{
    enum { WIDE = 620, HIGH = 400, TOP = 58 };
    const double x[3] = {0, 1, 2}, y[3] = {0, 9, 0};
    const chart_line line = chart_line_make("", x, y, 3, true);
    for (int cut = 0; cut < 2; cut++) {
        chart c = chart_make("", "", "", "", &line, 1);
        c.y_to = cut ? 2 : 0;
        cairo_t *page = NULL;
        fram_error error;
        ck_assert_int_eq(image_begin(WIDE, HIGH, &page, &error), FRAM_OK);
        chart_draw(page, &c, WIDE, HIGH, false);
        ck_assert_int_eq(has_ink(page, 90, 570, TOP, TOP + 3), cut);
        ck_assert(!has_ink(page, 90, 570, 0, TOP));
        cairo_destroy(page);
    }
}
END_TEST

/* Names that are wider than the plot together stand in rows above it, and a colour that comes again is dashed. */
START_TEST(legends_have_their_room)
{
    enum { WIDE = 620, HIGH = 400, LINES = 10, ROW = 16, SIGNS = 50 };
    static const double x[2] = {0, 1}, y[LINES][2] = {{10, 10}, {9, 9}, {8, 8}, {7, 7}, {6, 6},
                                                      {5, 5},   {4, 4}, {3, 3}, {2, 2}, {1, 1}};
    chart_line lines[LINES];
    for (int k = 0; k < LINES; k++)
        lines[k] = chart_line_make("a long name of a line", x, y[k], 2, true);
    for (int count = 2; count <= LINES; count += LINES - 2) {
        const chart c = chart_make("", "", "", "", lines, count);
        /* Three of them fit side by side. */
        int more = (count + 2) / 3 - 1, top = 58 + more * ROW;
        cairo_t *page = NULL;
        fram_error error;
        ck_assert_int_eq(image_begin(WIDE, HIGH, &page, &error), FRAM_OK);
        chart_draw(page, &c, WIDE, HIGH, false);
        for (int row = 0; row <= more; row++)
            ck_assert_msg(has_ink(page, 300, WIDE, SIGNS + row * ROW - 8, SIGNS + row * ROW), "row %d of %d", row,
                          count);
        ck_assert(!has_ink(page, 0, 86, 30, top - 4));
        /* Both ends of the first line, ten of 10.5 up, and where the second one of its colour has its first gap. */
        double up = (HIGH - 58 - top) / 10.5;
        int first = (int)(HIGH - 58 - 10 * up), ninth = (int)(HIGH - 58 - 2 * up);
        ck_assert(is_marked(page, 95, first - 2, first + 2));
        if (count == LINES)
            ck_assert(is_marked(page, 90, ninth - 2, ninth + 2) && !is_marked(page, 95, ninth - 2, ninth + 2));
        cairo_destroy(page);
    }
}
END_TEST

/* An axis of the least width that doubles have, and of one beside it, has a step and ends. */
START_TEST(the_narrowest_axis_has_ticks)
{
    const double widths[] = {5e-324, 1e-323, 1e-310, 2e-308};
    for (int i = 0; i < 4; i++) {
        for (int parts = 1; parts <= 10; parts += 3) {
            tick_row t = tick_row_of(0, widths[i], parts, 0, false);
            ck_assert(t.step > 0 && isfinite(t.first) && t.count >= 1 && t.count < 60);
        }
    }
}
END_TEST

TEST_MAIN("fitted", the_narrowest_axis_has_ticks, texts_end_in_their_room, ends_are_kept, lines_are_broken_at_words,
          bands_have_gaps, ticks_have_the_digits_of_their_step, labels_have_their_room, titles_have_their_room,
          lines_run_out_of_the_frame, legends_have_their_room)

#else

START_TEST(without_cairo) { ck_assert(!image_available()); }
END_TEST

TEST_MAIN("fitted", without_cairo)

#endif
