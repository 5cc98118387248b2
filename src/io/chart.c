#include "io/chart.h"

#include "base/transcendental.h"
#include "io/chart_legend.h"
#include "io/chart_ticks.h"
#include "io/image.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#ifdef FRAM_HAVE_CAIRO

static const image_colour chart_grid = {0.90, 0.91, 0.92};
static const double log_of_ten = 2.302585092994045684;

typedef struct chart_frame {
    double width, height;            /* of the chart with all that stands beside its axes [pixels] */
    double left, right, top, bottom; /* pixels */
    double x0, x1, y0, y1;           /* data; decades on a logarithmic axis */
    double step;                     /* of the ticks of both axes, where they have one scale; 0: each has its own */
    bool log_x, log_y;
} chart_frame;

/* A value as its axis counts it; a NaN cannot be shown. */
static double on_axis(double value, bool logarithmic)
{
    if (!logarithmic)
        return isfinite(value) ? value : (double)NAN;
    return value > 0 && value <= DBL_MAX ? real_log(value) / log_of_ten : (double)NAN;
}

static double axis_to_px(const chart_frame *f, double x)
{
    return f->left + (x - f->x0) / (f->x1 - f->x0) * (f->right - f->left);
}
static double axis_to_py(const chart_frame *f, double y)
{
    return f->bottom - (y - f->y0) / (f->y1 - f->y0) * (f->bottom - f->top);
}
static double to_px(const chart_frame *f, double x) { return axis_to_px(f, on_axis(x, f->log_x)); }
static double to_py(const chart_frame *f, double y) { return axis_to_py(f, on_axis(y, f->log_y)); }

static bool can_show(const chart_frame *f, double x, double y)
{
    double a = on_axis(x, f->log_x), b = on_axis(y, f->log_y);
    return a == a && b == b;
}

static void widen(double *lo, double *hi, double value)
{
    if (value != value)
        return;
    *lo = fmin(*lo, value);
    *hi = fmax(*hi, value);
}

/* Values that differ by less than this part of the largest, or of one unit, are the same but for rounding, as those of
   a motion that is held: an axis over them alone would show noise as if it were a signal. */
#define SAME_VALUE 1e-12

static bool is_flat(double lo, double hi) { return !(hi - lo > SAME_VALUE * fmax(fmax(fabs(lo), fabs(hi)), 1)); }

/* Never empty; a plain y axis holds zero unless it is free. */
static void settle(double *lo, double *hi, bool logarithmic)
{
    if (*lo > *hi)
        *lo = 0, *hi = 1;
    if (logarithmic) {
        *lo = floor(*lo + 1e-9), *hi = ceil(*hi - 1e-9);
        if (!(*hi > *lo))
            *hi = *lo + 1;
    } else if (is_flat(*lo, *hi)) {
        *lo -= 0.5, *hi = *lo + 1;
    }
}

static bool has_points(const chart *c)
{
    for (int32_t k = 0; k < c->line_count; k++)
        if (c->lines[k].style == CHART_POINTS && c->lines[k].count > 0)
            return true;
    return false;
}

static void find_range(const chart *c, chart_frame *f)
{
    f->log_x = c->log_x, f->log_y = c->log_y;
    f->x0 = f->y0 = DBL_MAX, f->x1 = f->y1 = -DBL_MAX;
    if (!c->log_y && !c->free_y)
        f->y0 = f->y1 = 0;
    for (int32_t k = 0; k < c->line_count; k++) {
        const chart_line *l = &c->lines[k];
        for (int32_t i = 0; i < l->count; i++) {
            if (!can_show(f, l->x[i], l->y[i]))
                continue;
            widen(&f->x0, &f->x1, on_axis(l->x[i], c->log_x));
            widen(&f->y0, &f->y1, on_axis(l->y[i], c->log_y));
            if (l->style == CHART_BAND)
                widen(&f->y0, &f->y1, on_axis(l->y2[i], c->log_y));
        }
    }
    settle(&f->x0, &f->x1, c->log_x);
    /* The frame would cut the first and the last dot. */
    double side = has_points(c) && !c->log_x ? 0.02 * (f->x1 - f->x0) : 0;
    f->x0 -= side;
    f->x1 += side;
    settle(&f->y0, &f->y1, c->log_y);
    double pad = c->log_y ? 0 : CHART_PAD * (f->y1 - f->y0);
    f->y1 += f->y1 > 0 || c->free_y ? pad : 0;
    f->y0 -= f->y0 < 0 || c->free_y ? pad : 0;
    if (c->y_to > c->y_from)
        f->y0 = c->y_from, f->y1 = c->y_to;
}

/* ---- axes ---- */

/* [pixels] What stands beside the axes: least margins, the title and its gap to the labels, and that between two labels
   of the x axis; TITLE_EDGE: from a long title to the chart's edge. */
enum {
    MARGIN_LEFT = 86,
    MARGIN_RIGHT = 22,
    TITLE_ROOM = 26,
    LABEL_GAP = 7,
    BETWEEN_LABELS = 5,
    PAGE_EDGE = 1,
    TITLE_EDGE = 4,
    TICK_SIZE = 12
};

static tick_row x_ticks(const chart_frame *f) { return tick_row_of(f->x0, f->x1, 10, f->step, f->log_x); }
static tick_row y_ticks(const chart_frame *f) { return tick_row_of(f->y0, f->y1, 6, f->step, f->log_y); }

static double width_of_tick(cairo_t *page, const tick_row *t, int i)
{
    char text[TICK_TEXT];
    tick_text(t, i, text);
    return image_text_width(page, TICK_SIZE, false, text);
}

static double widest_tick(cairo_t *page, const tick_row *t)
{
    double most = 0;
    for (int i = 0; i < t->count; i++)
        most = fmax(most, width_of_tick(page, t, i));
    return most;
}

static void draw_y_axis(cairo_t *page, const chart_frame *f)
{
    char text[TICK_TEXT];
    tick_row t = y_ticks(f);
    for (int i = 0; i < t.count; i++) {
        double py = floor(axis_to_py(f, tick_at(&t, i))) + 0.5;
        image_set_colour(page, chart_grid);
        cairo_move_to(page, f->left, py);
        cairo_line_to(page, f->right, py);
        cairo_stroke(page);
        image_set_colour(page, CHART_INK);
        tick_text(&t, i, text);
        image_text(page, f->left - LABEL_GAP, py + 4, TICK_SIZE, ALIGN_RIGHT, false, text);
    }
}

static void draw_x_axis(cairo_t *page, const chart_frame *f)
{
    char text[TICK_TEXT];
    tick_row t = x_ticks(f);
    double apart = axis_to_px(f, t.first + t.step) - axis_to_px(f, t.first);
    int every = apart > 0 ? (int)fmin(ceil((widest_tick(page, &t) + BETWEEN_LABELS) / apart), t.count) : 1;
    for (int i = 0; i < t.count; i++) {
        double px = floor(axis_to_px(f, tick_at(&t, i))) + 0.5;
        image_set_colour(page, chart_grid);
        cairo_move_to(page, px, f->top);
        cairo_line_to(page, px, f->bottom);
        cairo_stroke(page);
        image_set_colour(page, CHART_INK);
        cairo_move_to(page, px, f->bottom);
        cairo_line_to(page, px, f->bottom + 5);
        cairo_stroke(page);
        if (!tick_is_told(&t, i, every))
            continue;
        tick_text(&t, i, text);
        image_text(page, px, f->bottom + 19, TICK_SIZE, ALIGN_CENTRE, false, text);
    }
}

/* About `middle` of a chart that is so long; a name that is too long loses its end, never its unit. */
static void draw_title(cairo_t *page, double x, double y, double middle, double length, const char *title)
{
    char part[IMAGE_FITTED_SIZE];
    const char *unit = strrchr(title, '['), *end = unit ? unit : title + strlen(title);
    double room = 2 * (fmin(middle, length - middle) - TITLE_EDGE);
    end -= unit > title && unit[-1] == ' ';
    image_text(page, x, y, 13, ALIGN_CENTRE, false, image_fit(page, 13, false, room, title, end, part));
}

static void draw_axes(cairo_t *page, const chart *c, const chart_frame *f)
{
    cairo_set_line_width(page, 1);
    draw_y_axis(page, f);
    draw_x_axis(page, f);
    image_set_colour(page, (image_colour){0.55, 0.57, 0.6});
    cairo_move_to(page, floor(f->left) + 0.5, f->top);
    cairo_line_to(page, floor(f->left) + 0.5, floor(f->bottom) + 0.5);
    cairo_line_to(page, f->right, floor(f->bottom) + 0.5);
    cairo_stroke(page);
    image_set_colour(page, CHART_INK);
    double across = (f->left + f->right) / 2, down = (f->top + f->bottom) / 2;
    draw_title(page, across, f->bottom + 40, across, f->width, c->x_label);
    cairo_save(page);
    cairo_translate(page, 18, down);
    cairo_rotate(page, -PI / 2);
    draw_title(page, 0, 0, down, f->height, c->y_label);
    cairo_restore(page);
}

/* ---- lines ---- */

/* Each pixel column gets the first, least, greatest and last value in it. */
static void draw_line(cairo_t *page, const chart_frame *f, const chart_line *line)
{
    cairo_set_line_width(page, line->thick ? 2 : 1);
    bool pen_down = false;
    for (int32_t i = 0; i < line->count;) {
        if (!can_show(f, line->x[i], line->y[i])) {
            pen_down = false;
            i++;
            continue;
        }
        double px = to_px(f, line->x[i]), column = floor(px);
        double first = to_py(f, line->y[i]), least = first, greatest = first, last = first;
        for (; i < line->count && can_show(f, line->x[i], line->y[i]) && floor(to_px(f, line->x[i])) == column; i++) {
            last = to_py(f, line->y[i]);
            least = fmin(least, last), greatest = fmax(greatest, last);
        }
        if (pen_down)
            cairo_line_to(page, px, first);
        else
            cairo_move_to(page, px, first);
        if (greatest > least) {
            cairo_line_to(page, px, least);
            cairo_line_to(page, px, greatest);
            cairo_line_to(page, px, last);
        }
        pen_down = true;
    }
    cairo_stroke(page);
}

/* Rows that stand alone between such as have no value: a line of one point is not seen. */
static void draw_lone(cairo_t *page, const chart_frame *f, const chart_line *line)
{
    for (int32_t i = 0; i < line->count; i++) {
        bool before = i > 0 && can_show(f, line->x[i - 1], line->y[i - 1]);
        bool after = i + 1 < line->count && can_show(f, line->x[i + 1], line->y[i + 1]);
        if (before || after || !can_show(f, line->x[i], line->y[i]))
            continue;
        cairo_arc(page, to_px(f, line->x[i]), to_py(f, line->y[i]), line->thick ? 3 : 2, 0, 2 * PI);
        cairo_fill(page);
    }
}

/* A track turns back: it is drawn point by point. */
static void draw_track(cairo_t *page, const chart_frame *f, const chart_line *line)
{
    cairo_set_line_width(page, line->thick ? 2 : 1);
    for (int32_t i = 0; i < line->count; i++) {
        if (can_show(f, line->x[i], line->y[i]))
            cairo_line_to(page, to_px(f, line->x[i]), to_py(f, line->y[i]));
    }
    cairo_stroke(page);
}

/* A bound that a logarithmic axis cannot show lies at its end. */
static double bound_py(const chart_frame *f, double y)
{
    double at = on_axis(y, f->log_y);
    return at == at ? axis_to_py(f, at) : f->bottom;
}

/* Rows without a value (NaN) part it; one that stands alone is as wide [pixels]. */
#define LONE_BAND 6.0

static void draw_band(cairo_t *page, const chart_frame *f, const chart_line *line, image_colour colour)
{
    for (int32_t first = 0, end; first < line->count; first = end + 1) {
        for (end = first; end < line->count && !isnan(line->y[end]) && !isnan(line->y2[end]);)
            end++;
        if (end == first)
            continue;
        double side = end == first + 1 ? LONE_BAND / 2 : 0;
        cairo_new_sub_path(page);
        for (int32_t i = first; i < end; i++)
            cairo_line_to(page, to_px(f, line->x[i]) - side, bound_py(f, line->y[i]));
        for (int32_t i = end - 1; i >= first; i--)
            cairo_line_to(page, to_px(f, line->x[i]) - side, bound_py(f, line->y2[i]));
        for (int32_t i = first; i < end && side > 0; i++) {
            cairo_line_to(page, to_px(f, line->x[i]) + side, bound_py(f, line->y2[i]));
            cairo_line_to(page, to_px(f, line->x[i]) + side, bound_py(f, line->y[i]));
        }
        cairo_close_path(page);
    }
    cairo_set_source_rgba(page, colour.r, colour.g, colour.b, line->solid ? 1 : CHART_BAND_OPACITY);
    cairo_fill(page);
}

static void draw_bars(cairo_t *page, const chart_frame *f, const chart_line *line)
{
    double base = f->log_y ? f->bottom : axis_to_py(f, fmax(f->y0, fmin(0, f->y1)));
    for (int32_t i = 0; i + 1 < line->count; i++) {
        if (!can_show(f, line->x[i], line->y[i]))
            continue;
        double left = to_px(f, line->x[i]), right = to_px(f, line->x[i + 1]), top = to_py(f, line->y[i]);
        cairo_rectangle(page, left + 0.5, fmin(top, base), fmax(right - left - 1, 0.5), fabs(base - top));
    }
    cairo_fill(page);
}

static void draw_points(cairo_t *page, const chart_frame *f, const chart_line *line)
{
    for (int32_t i = 0; i < line->count; i++) {
        if (!can_show(f, line->x[i], line->y[i]))
            continue;
        cairo_new_sub_path(page);
        cairo_arc(page, to_px(f, line->x[i]), to_py(f, line->y[i]), line->thick ? 3.5 : 2.2, 0, 2 * PI);
    }
    cairo_fill(page);
}

static void draw_one(cairo_t *page, const chart_frame *f, const chart_line *line, int32_t place, bool track)
{
    image_colour colour = chart_colour_of(line, place);
    image_set_colour(page, colour);
    switch (line->style) {
    case CHART_LINE:
        chart_set_dashes(page, line, place);
        (track ? draw_track : draw_line)(page, f, line);
        cairo_set_dash(page, NULL, 0, 0);
        draw_lone(page, f, line);
        break;
    case CHART_BAND:
        draw_band(page, f, line, colour);
        break;
    case CHART_BARS:
        draw_bars(page, f, line);
        break;
    case CHART_POINTS:
        draw_points(page, f, line);
        break;
    }
}

/* Widen one axis so that both have the same scale, about the middle, and the same ticks, so that it shows. */
static void equalise(chart_frame *f)
{
    double across = (f->x1 - f->x0) / (f->right - f->left), upwards = (f->y1 - f->y0) / (f->bottom - f->top);
    double scale = fmax(across, upwards);
    double half_x = 0.5 * scale * (f->right - f->left), half_y = 0.5 * scale * (f->bottom - f->top);
    double x = 0.5 * (f->x0 + f->x1), y = 0.5 * (f->y0 + f->y1);
    f->x0 = x - half_x, f->x1 = x + half_x;
    f->y0 = y - half_y, f->y1 = y + half_y;
    f->step = image_round_step(fmax(f->x1 - f->x0, f->y1 - f->y0), 8);
}

/* [pixels] from the edges of the page */
typedef struct chart_margins {
    double left, right;
} chart_margins;

static chart_frame frame_of(cairo_t *page, const chart *c, int width, int height, bool equal, chart_margins m)
{
    chart_frame f = {.width = width,
                     .height = height,
                     .left = m.left,
                     .right = width - m.right,
                     .top = c->subtitle[0] ? 78 : 58,
                     .bottom = height - 58};
    f.top += chart_legend_more(page, c, f.right - f.left, f.bottom - f.top);
    find_range(c, &f);
    if (equal)
        equalise(&f);
    return f;
}

/* Room for the labels of this chart too: of the y axis beside its title, and of the last tick below. */
static void widen_margins(cairo_t *page, const chart *c, int width, int height, bool equal, chart_margins *m)
{
    chart_frame f = frame_of(page, c, width, height, equal, *m);
    tick_row y = y_ticks(&f), x = x_ticks(&f);
    m->left = fmax(m->left, ceil(widest_tick(page, &y)) + LABEL_GAP + TITLE_ROOM);
    double end = axis_to_px(&f, tick_at(&x, x.count - 1)) + 0.5 * width_of_tick(page, &x, x.count - 1);
    m->right = fmax(m->right, m->right + ceil(end + PAGE_EDGE - width));
}

static void draw_within(cairo_t *page, const chart *c, int width, int height, bool equal, chart_margins m)
{
    chart_frame f = frame_of(page, c, width, height, equal, m);
    image_set_colour(page, (image_colour){0.1, 0.1, 0.1});
    image_text_fitted(page, f.left, 28, 17, true, f.right - f.left, c->title);
    image_text_fitted(page, f.left, 48, 12, false, f.right - f.left, c->subtitle);
    draw_axes(page, c, &f);
    cairo_save(page);
    cairo_rectangle(page, f.left, f.top, f.right - f.left, f.bottom - f.top);
    cairo_clip(page);
    cairo_set_line_join(page, CAIRO_LINE_JOIN_ROUND);
    cairo_set_antialias(page, CAIRO_ANTIALIAS_FAST);
    for (int32_t k = 0; k < c->line_count; k++)
        draw_one(page, &f, &c->lines[k], k, equal);
    cairo_restore(page);
    chart_draw_legend(page, c, f.left, f.right, f.top);
}

void chart_draw(cairo_t *page, const chart *c, int width, int height, bool equal)
{
    chart_margins m = {MARGIN_LEFT, MARGIN_RIGHT};
    widen_margins(page, c, width, height, equal, &m);
    draw_within(page, c, width, height, equal, m);
}

/* With the same margins, so that what is of one time stands above each other. */
static void draw_stack(cairo_t *page, const chart *charts, int32_t count, int width, int height)
{
    chart_margins m = {MARGIN_LEFT, MARGIN_RIGHT};
    for (int32_t i = 0; i < count; i++)
        widen_margins(page, &charts[i], width, height, false, &m);
    for (int32_t i = 0; i < count; i++) {
        cairo_save(page);
        cairo_translate(page, 0, (double)i * height);
        draw_within(page, &charts[i], width, height, false, m);
        cairo_restore(page);
    }
}

fram_status chart_svg(context *ctx, const chart *c, int width, int height, text_buffer *out, fram_error *error)
{
    image_vector v;
    char title[CHART_WORDS];
    chart_stack_words(c, 1, title);
    fram_status status = image_vector_begin(ctx, title, width, height, &v, error);
    if (status != FRAM_OK)
        return status;
    cairo_set_source_rgb(v.page, 1, 1, 1);
    cairo_paint(v.page);
    draw_stack(v.page, c, 1, width, height);
    return image_vector_end(&v, out, error);
}

fram_status chart_stack_write(context *ctx, const chart *charts, int32_t count, const char *path, int width, int height,
                              fram_error *error)
{
    image_page page;
    char title[CHART_WORDS];
    chart_stack_words(charts, count, title);
    fram_status status = image_page_begin(ctx, path, title, width, height * count, &page, error);
    if (status != FRAM_OK)
        return status;
    draw_stack(page.pen, charts, count, width, height);
    return image_page_end(ctx, &page, path, error);
}

#else

static fram_status no_charts(const char *path, fram_error *error)
{
    return error_set(error, FRAM_ERROR_UNSUPPORTED, path, 0, NULL, "this build has no cairo, so it draws no charts");
}
fram_status chart_stack_write(context *ctx, const chart *charts, int32_t count, const char *path, int width, int height,
                              fram_error *error)
{
    (void)ctx, (void)charts, (void)count, (void)width, (void)height;
    return no_charts(path, error);
}
fram_status chart_svg(context *ctx, const chart *c, int width, int height, text_buffer *out, fram_error *error)
{
    (void)ctx, (void)c, (void)width, (void)height, (void)out;
    return no_charts(NULL, error);
}

#endif

fram_status chart_write(context *ctx, const chart *c, const char *path, int width, int height, fram_error *error)
{
    return chart_stack_write(ctx, c, 1, path, width, height, error);
}
