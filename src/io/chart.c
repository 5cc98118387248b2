#include "io/chart.h"

#include "io/image.h"

#include <float.h>
#include <math.h>
#include <stdio.h>

#ifdef FRAM_HAVE_CAIRO

/* Colour-blind safe (Okabe and Ito 2008). */
static const image_colour palette[] = {{0.60, 0.70, 0.80}, {0.00, 0.27, 0.55}, {0.84, 0.37, 0.00},
                                       {0.00, 0.62, 0.45}, {0.80, 0.47, 0.65}, {0.90, 0.62, 0.00}};
enum { PALETTE_SIZE = sizeof palette / sizeof *palette };
/* More ticks than any axis needs: a bound for data at the end of the range of doubles. */
enum { MOST_TICKS = 50 };

typedef struct frame {
    double left, right, top, bottom; /* pixels */
    double x0, x1, y0, y1;           /* data */
} frame;

static double to_px(const frame *f, double x) { return f->left + (x - f->x0) / (f->x1 - f->x0) * (f->right - f->left); }
static double to_py(const frame *f, double y)
{
    return f->bottom - (y - f->y0) / (f->y1 - f->y0) * (f->bottom - f->top);
}

/* Data range of all lines, never empty, zero included on the y axis. */
static void find_range(const chart *c, frame *f)
{
    f->x0 = DBL_MAX, f->x1 = -DBL_MAX, f->y0 = 0, f->y1 = 0;
    for (int32_t k = 0; k < c->line_count; k++) {
        for (int32_t i = 0; i < c->lines[k].count; i++) {
            double x = c->lines[k].x[i], y = c->lines[k].y[i];
            if (!isfinite(x) || !isfinite(y))
                continue;
            f->x0 = fmin(f->x0, x), f->x1 = fmax(f->x1, x);
            f->y0 = fmin(f->y0, y), f->y1 = fmax(f->y1, y);
        }
    }
    if (!(f->x1 > f->x0))
        f->x0 = f->x0 > DBL_MAX / 2 ? 0 : f->x0 - 0.5, f->x1 = f->x0 + 1;
    if (!(f->y1 > f->y0))
        f->y1 = f->y0 + 1;
    double pad = 0.05 * (f->y1 - f->y0);
    f->y1 += pad;
    if (f->y0 < 0)
        f->y0 -= pad;
}

static void format_tick(char text[32], double value, double step)
{
    snprintf(text, 32, "%.6g", fabs(value) < step * 1e-6 ? 0.0 : value);
}

static void draw_axes(cairo_t *page, const chart *c, const frame *f)
{
    char text[32];
    cairo_set_line_width(page, 1);
    double step = image_round_step(f->y1 - f->y0, 6);
    double first = ceil(f->y0 / step) * step;
    int more = (int)fmin(floor((f->y1 - first) / step), MOST_TICKS);
    for (int i = 0; i <= more; i++) {
        double y = first + i * step, py = floor(to_py(f, y)) + 0.5;
        image_set_colour(page, (image_colour){0.88, 0.88, 0.88});
        cairo_move_to(page, f->left, py);
        cairo_line_to(page, f->right, py);
        cairo_stroke(page);
        image_set_colour(page, (image_colour){0.2, 0.2, 0.2});
        format_tick(text, y, step);
        image_text(page, f->left - 6, py + 4, 12, ALIGN_RIGHT, false, text);
    }
    step = image_round_step(f->x1 - f->x0, 10);
    first = ceil(f->x0 / step) * step;
    more = (int)fmin(floor((f->x1 - first) / step), MOST_TICKS);
    for (int i = 0; i <= more; i++) {
        double x = first + i * step, px = floor(to_px(f, x)) + 0.5;
        cairo_move_to(page, px, f->bottom);
        cairo_line_to(page, px, f->bottom + 5);
        cairo_stroke(page);
        format_tick(text, x, step);
        image_text(page, px, f->bottom + 19, 12, ALIGN_CENTRE, false, text);
    }
    cairo_rectangle(page, floor(f->left) + 0.5, floor(f->top) + 0.5, floor(f->right - f->left),
                    floor(f->bottom - f->top));
    cairo_stroke(page);
    image_text(page, (f->left + f->right) / 2, f->bottom + 40, 13, ALIGN_CENTRE, false, c->x_label);
    cairo_save(page);
    cairo_move_to(page, 18, (f->top + f->bottom) / 2);
    cairo_rotate(page, -1.5707963267948966);
    cairo_rel_move_to(page, -image_text_width(page, 13, false, c->y_label) / 2, 0);
    cairo_show_text(page, c->y_label);
    cairo_restore(page);
}

/* Each pixel column gets the first, least, greatest and last value in it. */
static void draw_line(cairo_t *page, const frame *f, const chart_line *line, image_colour colour)
{
    image_set_colour(page, colour);
    cairo_set_line_width(page, line->thick ? 2 : 1);
    bool pen_down = false;
    for (int32_t i = 0; i < line->count;) {
        if (!isfinite(line->x[i]) || !isfinite(line->y[i])) {
            pen_down = false;
            i++;
            continue;
        }
        double px = to_px(f, line->x[i]), column = floor(px);
        double first = line->y[i], least = first, greatest = first, last = first;
        for (; i < line->count && isfinite(line->x[i]) && isfinite(line->y[i]) && floor(to_px(f, line->x[i])) == column;
             i++) {
            last = line->y[i];
            least = fmin(least, last), greatest = fmax(greatest, last);
        }
        if (pen_down)
            cairo_line_to(page, px, to_py(f, first));
        else
            cairo_move_to(page, px, to_py(f, first));
        if (greatest > least) {
            cairo_line_to(page, px, to_py(f, least));
            cairo_line_to(page, px, to_py(f, greatest));
            cairo_line_to(page, px, to_py(f, last));
        }
        pen_down = true;
    }
    cairo_stroke(page);
}

static void draw_legend(cairo_t *page, const chart *c, const frame *f)
{
    double x = f->right;
    for (int32_t k = c->line_count - 1; k >= 0; k--) {
        x -= image_text_width(page, 12, false, c->lines[k].name);
        image_set_colour(page, (image_colour){0.2, 0.2, 0.2});
        image_text(page, x, f->top - 8, 12, ALIGN_LEFT, false, c->lines[k].name);
        image_set_colour(page, palette[k % PALETTE_SIZE]);
        cairo_set_line_width(page, 3);
        cairo_move_to(page, x - 26, f->top - 12);
        cairo_line_to(page, x - 6, f->top - 12);
        cairo_stroke(page);
        x -= 44;
    }
}

/* Widen one axis so that both have the same scale, about the middle. */
static void equalise(frame *f)
{
    double across = (f->x1 - f->x0) / (f->right - f->left), upwards = (f->y1 - f->y0) / (f->bottom - f->top);
    double scale = fmax(across, upwards);
    double half_x = 0.5 * scale * (f->right - f->left), half_y = 0.5 * scale * (f->bottom - f->top);
    double x = 0.5 * (f->x0 + f->x1), y = 0.5 * (f->y0 + f->y1);
    f->x0 = x - half_x, f->x1 = x + half_x;
    f->y0 = y - half_y, f->y1 = y + half_y;
}

/* A track turns back: it is drawn point by point. */
static void draw_track(cairo_t *page, const frame *f, const chart_line *line, image_colour colour)
{
    image_set_colour(page, colour);
    cairo_set_line_width(page, line->thick ? 2 : 1);
    for (int32_t i = 0; i < line->count; i++)
        if (isfinite(line->x[i]) && isfinite(line->y[i]))
            cairo_line_to(page, to_px(f, line->x[i]), to_py(f, line->y[i]));
    cairo_stroke(page);
}

void chart_draw(cairo_t *page, const chart *c, int width, int height, bool equal)
{
    frame f = {.left = 86, .right = width - 22, .top = 78, .bottom = height - 58};
    find_range(c, &f);
    if (equal)
        equalise(&f);
    image_set_colour(page, (image_colour){0.1, 0.1, 0.1});
    image_text(page, f.left, 28, 17, ALIGN_LEFT, true, c->title);
    image_text(page, f.left, 48, 12, ALIGN_LEFT, false, c->subtitle);
    draw_axes(page, c, &f);
    cairo_save(page);
    cairo_rectangle(page, f.left, f.top, f.right - f.left, f.bottom - f.top);
    cairo_clip(page);
    cairo_set_line_join(page, CAIRO_LINE_JOIN_ROUND);
    for (int32_t k = 0; k < c->line_count; k++)
        (equal ? draw_track : draw_line)(page, &f, &c->lines[k], palette[k % PALETTE_SIZE]);
    cairo_restore(page);
    draw_legend(page, c, &f);
}

fram_status chart_write(context *ctx, const chart *c, const char *path, int width, int height, fram_error *error)
{
    cairo_t *page = NULL;
    fram_status status = image_begin(width, height, &page, error);
    if (status != FRAM_OK)
        return status;
    chart_draw(page, c, width, height, false);
    return image_write(ctx, page, path, error);
}

#else

fram_status chart_write(context *ctx, const chart *c, const char *path, int width, int height, fram_error *error)
{
    (void)ctx, (void)c, (void)width, (void)height;
    return error_set(error, FRAM_ERROR_UNSUPPORTED, path, 0, NULL, "this build has no cairo, so it draws no charts");
}

#endif
