#include "io/polar.h"

#include "base/transcendental.h"
#include "io/image.h"
#include "io/palette.h"

#include <math.h>
#include <stdio.h>

#ifdef FRAM_HAVE_CAIRO

enum {
    POLAR_WIDTH = 1300,
    POLAR_HEIGHT = 860,
    MIDDLE_X = 470,
    MIDDLE_Y = 470,
    RADIUS = 330,
    TEXT_X = 950,
    HEAD_X = 40
};

static const image_colour polar_ink = {0.2, 0.2, 0.2}, polar_grid = {0.55, 0.57, 0.60}, beyond = {0.62, 0.62, 0.64};

static double reach_of(const polar_chart *p) { return p->rings * p->ring_step; }

/* Cairo's angles: clockwise from x on the page, which points up here. */
static double page_angle(const polar_chart *p, double direction) { return 2 * PI * direction / p->directions - PI / 2; }

static void to_page(const polar_chart *p, double direction, double radius, double *x, double *y)
{
    double a = page_angle(p, direction), r = radius / reach_of(p) * RADIUS;
    *x = MIDDLE_X + r * real_cos(a);
    *y = MIDDLE_Y + r * real_sin(a);
}

static void set_value_colour(cairo_t *page, double value)
{
    double rgb[3];
    if (!(value <= 1)) {
        image_set_colour(page, beyond);
        return;
    }
    image_ramp(value, rgb);
    image_set_colour(page, (image_colour){rgb[0], rgb[1], rgb[2]});
}

static void draw_cells(cairo_t *page, const polar_chart *p)
{
    cairo_set_antialias(page, CAIRO_ANTIALIAS_NONE);
    for (int32_t i = 0; i < p->directions; i++) {
        double from = page_angle(p, i - 0.5), to = page_angle(p, i + 0.5);
        for (int32_t k = 0; k < p->rings; k++) {
            double inner = (double)RADIUS * k / p->rings, outer = (double)RADIUS * (k + 1) / p->rings;
            set_value_colour(page, p->value[i * p->rings + k]);
            cairo_new_path(page);
            cairo_arc(page, MIDDLE_X, MIDDLE_Y, outer, from, to);
            cairo_arc_negative(page, MIDDLE_X, MIDDLE_Y, inner, to, from);
            cairo_fill(page);
        }
    }
    cairo_set_antialias(page, CAIRO_ANTIALIAS_DEFAULT);
}

static void draw_rings(cairo_t *page, const polar_chart *p)
{
    char text[32];
    double step = image_round_step(reach_of(p), 5);
    cairo_set_line_width(page, 0.8);
    int rings = (int)floor(reach_of(p) / step + 1e-9);
    for (int i = 1; i <= rings; i++) {
        double r = i * step, pixels = r / reach_of(p) * RADIUS;
        image_set_colour(page, polar_grid);
        cairo_new_path(page);
        cairo_arc(page, MIDDLE_X, MIDDLE_Y, pixels, 0, 2 * PI);
        cairo_stroke(page);
        image_set_colour(page, polar_ink);
        snprintf(text, sizeof text, "%.3g", r);
        image_text(page, MIDDLE_X + 3, MIDDLE_Y - pixels + 13, 11, ALIGN_LEFT, false, text);
    }
}

static void draw_spokes(cairo_t *page)
{
    char text[32];
    for (int degrees = 0; degrees < 360; degrees += 30) {
        double a = degrees * PI / 180 - PI / 2, c = real_cos(a), s = real_sin(a);
        image_set_colour(page, polar_grid);
        cairo_move_to(page, MIDDLE_X, MIDDLE_Y);
        cairo_line_to(page, MIDDLE_X + RADIUS * c, MIDDLE_Y + RADIUS * s);
        cairo_stroke(page);
        image_set_colour(page, polar_ink);
        snprintf(text, sizeof text, degrees == 0 ? "0 (bow)" : "%d", degrees);
        image_text(page, MIDDLE_X + (RADIUS + 18) * c, MIDDLE_Y + (RADIUS + 18) * s + 4, 12, ALIGN_CENTRE, true, text);
    }
}

/* Words outside, at about every thirtieth degree, so that they do not meet. */
static void draw_outer(cairo_t *page, const polar_chart *p)
{
    int32_t every = p->directions / 12 > 0 ? p->directions / 12 : 1;
    for (int32_t i = 0; p->outer && i < p->directions; i += every) {
        double a = page_angle(p, i), c = real_cos(a), s = real_sin(a);
        image_align align = c > 0.3 ? ALIGN_LEFT : c < -0.3 ? ALIGN_RIGHT : ALIGN_CENTRE;
        double shift = align == ALIGN_CENTRE ? (s > 0 ? 20 : -16) : 0;
        double aside = align == ALIGN_LEFT ? 20 : align == ALIGN_RIGHT ? -20 : 0;
        image_text(page, MIDDLE_X + (RADIUS + 18) * c + aside, MIDDLE_Y + (RADIUS + 26) * s + 4 + shift, 11, align,
                   false, p->outer[i]);
    }
}

static void draw_curve(cairo_t *page, const polar_chart *p, int32_t number)
{
    const double dash[2] = {9, 6};
    const polar_curve *curve = &p->curves[number];
    const double *colour = palette_curves[number % PALETTE_CURVES];
    image_set_colour(page, (image_colour){colour[0], colour[1], colour[2]});
    cairo_set_line_width(page, 2.6);
    cairo_set_dash(page, dash, curve->dashed ? 2 : 0, 0);
    cairo_new_path(page);
    for (int32_t i = 0; i < p->directions; i++) {
        double x, y;
        to_page(p, i, curve->radius[i], &x, &y);
        cairo_line_to(page, x, y);
    }
    cairo_close_path(page);
    cairo_stroke(page);
    int y = 118 + number * 22;
    cairo_move_to(page, TEXT_X, y);
    cairo_line_to(page, TEXT_X + 40, y);
    cairo_stroke(page);
    cairo_set_dash(page, dash, 0, 0);
    image_set_colour(page, polar_ink);
    image_text(page, TEXT_X + 50, y + 4, 13, ALIGN_LEFT, false, curve->name);
}

static void draw_value_scale(cairo_t *page, const polar_chart *p)
{
    enum { STEPS = 50, LEFT = TEXT_X, TOP = 200, WIDTH = 200, HEIGHT = 14 };
    image_set_colour(page, polar_ink);
    image_text(page, LEFT, TOP - 8, 12, ALIGN_LEFT, false, p->value_label);
    for (int i = 0; i < STEPS; i++) {
        set_value_colour(page, (i + 0.5) / STEPS);
        cairo_rectangle(page, LEFT + (double)i * WIDTH / STEPS, TOP, (double)WIDTH / STEPS + 0.5, HEIGHT);
        cairo_fill(page);
    }
    image_set_colour(page, beyond);
    cairo_rectangle(page, LEFT + WIDTH + 8, TOP, 30, HEIGHT);
    cairo_fill(page);
    image_set_colour(page, polar_ink);
    image_text(page, LEFT, TOP + 28, 11, ALIGN_LEFT, false, "0");
    image_text(page, LEFT + WIDTH, TOP + 28, 11, ALIGN_RIGHT, false, "1");
    image_text(page, LEFT + WIDTH + 8, TOP + 28, 11, ALIGN_LEFT, false, "not held");
}

static void draw(cairo_t *page, const polar_chart *p)
{
    image_set_colour(page, polar_ink);
    image_text_fitted(page, HEAD_X, 38, 20, true, POLAR_WIDTH - 2 * HEAD_X, p->title);
    image_text_fitted(page, HEAD_X, 60, 13, false, POLAR_WIDTH - 2 * HEAD_X, p->subtitle);
    draw_cells(page, p);
    draw_rings(page, p);
    draw_spokes(page);
    image_text(page, MIDDLE_X + RADIUS - 20, MIDDLE_Y + RADIUS, 12, ALIGN_LEFT, false, p->radius_label);
    draw_outer(page, p);
    for (int32_t i = 0; i < p->curve_count; i++)
        draw_curve(page, p, i);
    draw_value_scale(page, p);
    image_text_lines(page, TEXT_X, 262, 12, POLAR_WIDTH - TEXT_X - 10, p->text);
}

fram_status polar_write(context *ctx, const polar_chart *p, const char *path, fram_error *error)
{
    image_page page;
    fram_status status = image_page_begin(ctx, path, p->title, POLAR_WIDTH, POLAR_HEIGHT, &page, error);
    if (status != FRAM_OK)
        return status;
    draw(page.pen, p);
    return image_page_end(ctx, &page, path, error);
}

#else

fram_status polar_write(context *ctx, const polar_chart *p, const char *path, fram_error *error)
{
    (void)ctx, (void)p;
    return error_set(error, FRAM_ERROR_UNSUPPORTED, path, 0, NULL, "this build has no cairo, so it draws no charts");
}

#endif
