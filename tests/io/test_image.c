/* Texts of pictures: what is no UTF-8 is shown as far as it is. */
#include "io/chart.h"
#include "io/image.h"

#include "testing.h"

static void draw(context *ctx, const char *title, const char *label, text_buffer *out)
{
    fram_error e;
    const double x[] = {0, 1}, y[] = {0, 2};
    const chart_line line = chart_line_make("a line", x, y, 2, false);
    chart c = chart_make(title, title, "time [s]", label, &line, 1);
    assert_ok(chart_svg(ctx, &c, 400, 300, out, &e), e);
}

/* Cairo numbers the pages that it draws. */
static void forget_number(char *svg)
{
    static const char before[] = "<g id=\"surface";
    char *number = strstr(svg, before);
    if (number) {
        number += strlen(before);
        const char *after = number + strspn(number, "0123456789");
        memmove(number, after, strlen(after) + 1);
    }
}

/* Of what a picture is called, where such bytes are told in another way than they are drawn. */
static void forget_title(char *svg)
{
    char *begin = strstr(svg, "<title>"), *end = strstr(svg, "</title>");
    ck_assert(begin && end > begin);
    memmove(begin, end, strlen(end) + 1);
}

/* Names of files may be of any bytes, and a buffer may end in the middle of a character. */
START_TEST(bytes_that_are_no_text)
{
    static const char *const texts[][2] = {
        {"f\xfc\xdf.stl", "f??.stl"}, {"cut \xc3", "cut ?"}, {"\xff", "?"}, {"\xc3\xbc", "\xc3\xbc"}, {"", ""}};
    context ctx;
    context_init(&ctx);
    for (size_t i = 0; i < sizeof texts / sizeof *texts && image_available(); i++) {
        text_buffer found = {0}, expected = {0};
        draw(&ctx, texts[i][0], texts[i][0], &found);
        draw(&ctx, texts[i][1], texts[i][1], &expected);
        ck_assert_int_gt(found.count, 1000);
        forget_number(found.data);
        forget_number(expected.data);
        forget_title(found.data);
        forget_title(expected.data);
        ck_assert_str_eq(found.data, expected.data);
        text_free(&ctx, &found);
        text_free(&ctx, &expected);
    }
}
END_TEST

/* Who cannot see a picture is told what it is: a title, first in it, and escaped. */
START_TEST(pictures_have_titles)
{
    context ctx;
    text_buffer svg = {0};
    context_init(&ctx);
    if (!image_available())
        return;
    draw(&ctx, "a <b> & \"c\" \xff\x1b", "load [kN]", &svg);
    const char *role = strstr(svg.data, "role=\"img\""), *inside = strchr(strstr(svg.data, "<svg "), '>');
    static const char title[] =
        ">\n<title>a &lt;b&gt; &amp; &quot;c&quot; \xef\xbf\xbd\xef\xbf\xbd: load [kN] over time "
        "[s]</title>";
    ck_assert(role && role < inside);
    ck_assert_int_eq(strncmp(inside, title, sizeof title - 1), 0);
    text_free(&ctx, &svg);
}
END_TEST

/* A text longer than any line is cut at a character's end. */
START_TEST(long_texts_are_cut)
{
    char text[3000] = "x";
    context ctx;
    text_buffer svg = {0};
    context_init(&ctx);
    for (size_t i = 1; i + 2 < sizeof text; i += 2)
        memcpy(text + i, "\xc3\xa4", 3);
    if (image_available())
        draw(&ctx, text, "y", &svg);
    text_free(&ctx, &svg);
}
END_TEST

/* A line over 0 to 3 s; hold_zero: on an axis that begins at zero. */
static void draw_line(context *ctx, const double y[4], bool hold_zero, text_buffer *out)
{
    fram_error e;
    const double x[] = {0, 1, 2, 3};
    const chart_line line = chart_line_make("a line", x, y, 4, false);
    chart c = chart_make("", "", "time [s]", "sway [m]", &line, 1);
    c.free_y = !hold_zero;
    assert_ok(chart_svg(ctx, &c, 400, 300, out, &e), e);
    forget_number(out->data);
}

/* A motion that is held moves by rounding: its line is straight, not noise as high as the chart; a small one is seen.
 */
START_TEST(rounding_is_no_signal)
{
    static const struct {
        double flat[4], line[4];
        bool hold_zero, alike;
    } rows[] = {
        {{0, 0, 0, 0}, {0, 3e-23, -2e-23, 1e-23}, true, true},
        {{180, 180, 180, 180}, {180, 180 + 3e-11, 180 - 3e-11, 180}, false, true},
        {{0, 0, 0, 0}, {0, 3e-9, -2e-9, 1e-9}, true, false},
        {{180, 180, 180, 180}, {180, 180 + 1e-6, 180 - 1e-6, 180}, false, false},
    };
    context ctx;
    context_init(&ctx);
    for (size_t i = 0; i < sizeof rows / sizeof *rows && image_available(); i++) {
        text_buffer flat = {0}, line = {0};
        draw_line(&ctx, rows[i].flat, rows[i].hold_zero, &flat);
        draw_line(&ctx, rows[i].line, rows[i].hold_zero, &line);
        ck_assert_msg((strcmp(flat.data, line.data) == 0) == rows[i].alike, "row %zu", i);
        text_free(&ctx, &flat);
        text_free(&ctx, &line);
    }
}
END_TEST

static void keep_line(void *user, log_level level, const char *text)
{
    ck_assert_int_eq(level, LOG_WARNING);
    snprintf(user, 80, "%s", text);
}

/* Whether the build draws or not. */
START_TEST(pictures_that_cannot_be_drawn_are_skipped)
{
    char line[80] = "";
    context ctx;
    fram_error e = {0};
    context_init(&ctx);
    ctx.log = keep_line;
    ctx.log_user = line;
    fram_error reason = {.status = FRAM_ERROR_UNSUPPORTED, .message = "no cairo"};
    ck_assert_int_eq(image_or_skip(&ctx, "plan.png", FRAM_ERROR_UNSUPPORTED, &reason, &e), FRAM_OK);
    ck_assert_str_eq(line, "plan.png is skipped: no cairo");
    ck_assert_int_eq(e.status, FRAM_OK);
    line[0] = '\0';
    reason = (fram_error){.status = FRAM_ERROR_IO, .message = "no room"};
    ck_assert_int_eq(image_or_skip(&ctx, "plan.png", FRAM_ERROR_IO, &reason, NULL), FRAM_ERROR_IO);
    ck_assert_int_eq(image_or_skip(&ctx, "plan.png", FRAM_ERROR_IO, &reason, &e), FRAM_ERROR_IO);
    ck_assert_str_eq(e.message, "no room");
    ck_assert_int_eq(image_or_skip(&ctx, "plan.png", FRAM_OK, &reason, &e), FRAM_OK);
    ck_assert_str_eq(line, "");
}
END_TEST

TEST_MAIN("image", bytes_that_are_no_text, pictures_have_titles, long_texts_are_cut, rounding_is_no_signal,
          pictures_that_cannot_be_drawn_are_skipped)
