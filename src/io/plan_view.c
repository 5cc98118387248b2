#include "io/plan_paint.h"

#include "base/load_unit.h"
#include "base/transcendental.h"

#include <math.h>
#include <stdio.h>

#ifdef FRAM_HAVE_CAIRO

static const image_colour water = {0.16, 0.36, 0.52}, plan_ink = {0.1, 0.1, 0.1}, white = {1, 1, 1};
static const image_colour force_arrow = {0.75, 0.05, 0.25}, crack_mark = {0.90, 0.45, 0.0},
                          track_line = {0.85, 0.1, 0.1};

/* The path as a line with white on both sides, so that it is seen on water, ice and hull alike. */
static void stroke_with_halo(cairo_t *page, image_colour colour, double width, double halo)
{
    image_set_colour(page, white);
    cairo_set_line_width(page, width + 2 * halo);
    cairo_stroke_preserve(page);
    image_set_colour(page, colour);
    cairo_set_line_width(page, width);
    cairo_stroke(page);
}

static void draw_plan_track(cairo_t *page, const plan_map *m, const plan_view *view)
{
    if (view->track_count < 2)
        return;
    for (int32_t i = 0; i < view->track_count; i++)
        cairo_line_to(page, plan_map_x(m, view->track[i]), plan_map_y(m, view->track[i]));
    stroke_with_halo(page, track_line, 1.2, 1.5);
}

static void draw_marks(cairo_t *page, const plan_map *m, const plan_view *view)
{
    for (int32_t i = 0; i < view->mark_count; i++) {
        double x = plan_map_x(m, view->marks[i]), y = plan_map_y(m, view->marks[i]), r = 3.5;
        cairo_move_to(page, x - r, y - r);
        cairo_line_to(page, x + r, y + r);
        cairo_move_to(page, x - r, y + r);
        cairo_line_to(page, x + r, y - r);
    }
    stroke_with_halo(page, crack_mark, 1.6, 1.5);
}

/* Of labels [pixels]. */
#define LABEL_RADIUS 6.0
#define LABEL_SIZE 12.0

static const image_colour chain = {0.20, 0.20, 0.22};

/* Over floes and hull, so that the fairleads are seen too; anchors outside the window are cut off with it. */
static void draw_lines(cairo_t *page, const plan_map *m, const plan_view *view)
{
    const double anchor = 4;
    image_set_colour(page, chain);
    cairo_set_line_width(page, 1.6);
    for (int32_t i = 0; i < view->line_count; i++) {
        const plan_line *l = &view->lines[i];
        cairo_move_to(page, plan_map_x(m, l->upper), plan_map_y(m, l->upper));
        plan_line_to(page, m, l->anchor);
        cairo_stroke(page);
        double x = plan_map_x(m, l->anchor) - anchor, y = plan_map_y(m, l->anchor) - anchor;
        cairo_rectangle(page, x, y, 2 * anchor, 2 * anchor);
        cairo_fill(page);
    }
}

/* From the right to the left, on the line of the caption: an arrow of fixed length, and what it is of.  Returns where
   the last one begins. */
static double draw_flows(cairo_t *page, const plan_view *view, double right, double y)
{
    const double half = 13;
    for (int32_t i = view->flow_count - 1; i >= 0; i--) {
        const plan_flow *f = &view->flows[i];
        char text[64];
        double speed = vec2_length(f->velocity), x = right - half;
        if (!(speed > 0))
            continue;
        snprintf(text, sizeof text, "%s %.3g m/s", f->name, speed);
        vec2 way = vec2_scale(f->velocity, half / speed);
        cairo_set_source_rgb(page, 0.10, 0.35, 0.60);
        image_arrow(page, x - way.x, y - 4 + way.y, x + way.x, y - 4 - way.y, 2.2, 9);
        image_set_colour(page, plan_ink);
        image_text(page, right - 2 * half - 6, y, 12, ALIGN_RIGHT, false, text);
        right -= 2 * half + 24 + image_text_width(page, 12, false, text);
    }
    return right;
}

/* The white round all of them first, so that none cuts another. */
static void draw_arrows(cairo_t *page, const plan_map *m, const plan_view *view)
{
    const double width = 2, head = 9;
    for (int32_t i = 0; i < 2 * view->arrow_count; i++) {
        bool halo = i < view->arrow_count;
        const plan_arrow *a = &view->arrows[halo ? i : i - view->arrow_count];
        image_set_colour(page, force_arrow);
        (halo ? image_arrow_halo : image_arrow)(page, plan_map_x(m, a->from), plan_map_y(m, a->from),
                                                plan_map_x(m, a->to), plan_map_y(m, a->to), width, head);
    }
}

/* Ground of a label's name [pixels]. */
static box2 label_box(cairo_t *page, const plan_map *m, const plan_label *l)
{
    double left = plan_map_x(m, l->at) + LABEL_RADIUS + 3, y = plan_map_y(m, l->at);
    return (box2){{left, y - 9}, {left + image_text_width(page, LABEL_SIZE, true, l->text) + 6, y + 7}};
}

/* One of the names before it stands there. */
static bool is_covered(cairo_t *page, const plan_map *m, const plan_view *view, int32_t label)
{
    box2 own = label_box(page, m, &view->labels[label]);
    for (int32_t i = 0; i < label; i++) {
        box2 b = label_box(page, m, &view->labels[i]);
        if (b.lo.x < own.hi.x && own.lo.x < b.hi.x && b.lo.y < own.hi.y && own.lo.y < b.hi.y)
            return true;
    }
    return false;
}

/* Discs, then names on a ground of their own; where names would cover each other, the first one stands. */
static void draw_labels(cairo_t *page, const plan_map *m, const plan_view *view)
{
    for (int32_t i = view->label_count - 1; i >= 0; i--) {
        const plan_label *l = &view->labels[i];
        double rgb[3];
        if (l->bare)
            continue;
        image_ramp((double)l->value, rgb);
        cairo_new_path(page);
        cairo_arc(page, plan_map_x(m, l->at), plan_map_y(m, l->at), LABEL_RADIUS, 0, 2 * PI);
        cairo_set_source_rgb(page, rgb[0], rgb[1], rgb[2]);
        cairo_fill_preserve(page);
        image_set_colour(page, plan_ink);
        cairo_set_line_width(page, 1.5);
        cairo_stroke(page);
    }
    for (int32_t i = 0; i < view->label_count; i++) {
        box2 box = label_box(page, m, &view->labels[i]);
        if (is_covered(page, m, view, i))
            continue;
        cairo_rectangle(page, box.lo.x, box.lo.y, box.hi.x - box.lo.x, box.hi.y - box.lo.y);
        cairo_set_source_rgba(page, 1, 1, 1, 0.85);
        cairo_fill(page);
        image_set_colour(page, plan_ink);
        image_text(page, box.lo.x + 3, box.hi.y - 3, LABEL_SIZE, ALIGN_LEFT, true, view->labels[i].text);
    }
    cairo_new_path(page);
}

void plan_view_colour_scale(cairo_t *page, const char *name, double lo, double hi, double left, double right, double y)
{
    enum { BAR = 150, LEAST_BAR = 50, STEPS = 50, GAP_BAR = 8, NEXT_LINE = 14 };
    char low[32], high[32];
    snprintf(low, sizeof low, "%.3g", lo);
    snprintf(high, sizeof high, "%.3g", hi);
    image_set_colour(page, plan_ink);
    double title = image_text_width(page, 12, false, name) + GAP_BAR, end = right;
    double room =
        right - left - image_text_width(page, 12, false, low) - image_text_width(page, 12, false, high) - 2 * GAP_BAR;
    bool beside = room - title >= LEAST_BAR;
    double bar = fmin(fmax(beside ? room - title : room, LEAST_BAR), BAR);
    right -= image_text_width(page, 12, false, high);
    image_text(page, right, y, 12, ALIGN_LEFT, false, high);
    right -= bar + GAP_BAR;
    for (int i = 0; i < STEPS; i++) {
        double rgb[3];
        image_ramp((i + 0.5) / STEPS, rgb);
        cairo_set_source_rgb(page, rgb[0], rgb[1], rgb[2]);
        cairo_rectangle(page, right + i * bar / STEPS, y - 11, bar / STEPS + 0.5, 12);
        cairo_fill(page);
    }
    image_set_colour(page, plan_ink);
    image_text(page, right - GAP_BAR, y, 12, ALIGN_RIGHT, false, low);
    double before = right - 2 * GAP_BAR - image_text_width(page, 12, false, low);
    image_text(page, beside ? before : end, beside ? y : y + NEXT_LINE, 12, ALIGN_RIGHT, false, name);
}

/* Returns where it ends on its line. */
static double draw_scale_bar(cairo_t *page, const plan_map *m, double arrow, double x, double y)
{
    double length = image_round_step(m->window.hi.x - m->window.lo.x, 6), px = length * m->scale;
    char text[80];
    snprintf(text, sizeof text, "%g m", length);
    image_set_colour(page, plan_ink);
    cairo_rectangle(page, x, y - 6, px, 6);
    cairo_fill(page);
    image_set_colour(page, white);
    cairo_rectangle(page, x + px / 2, y - 5, px / 2 - 1, 4);
    cairo_fill(page);
    image_set_colour(page, plan_ink);
    image_text(page, x + px + 8, y, 12, ALIGN_LEFT, false, text);
    double end = x + px + 8 + image_text_width(page, 12, false, text);
    if (!(arrow > 0))
        return end;
    snprintf(text, sizeof text, "as an arrow %s", load_text_of(length / arrow, 3).text);
    image_text(page, x, y + 14, 12, ALIGN_LEFT, false, text);
    return end;
}

/* The axes of the global frame, for there is no north in a scenario. */
static void draw_global_axes(cairo_t *page, double x, double y)
{
    image_set_colour(page, plan_ink);
    cairo_set_line_width(page, 1.5);
    cairo_move_to(page, x, y - 26);
    cairo_line_to(page, x, y);
    cairo_line_to(page, x + 26, y);
    cairo_stroke(page);
    image_text(page, x + 29, y + 4, 12, ALIGN_LEFT, true, "X");
    image_text(page, x - 4, y - 29, 12, ALIGN_LEFT, true, "Y");
}

/* What a style looks like, 14 pixels wide. */
static void draw_swatch(cairo_t *page, plan_style style, double left, double y)
{
    cairo_rectangle(page, left, y - 11, 14, 12);
    image_set_colour(page, plan_looks[style].fill);
    cairo_fill_preserve(page);
    image_set_colour(page, plan_looks[style].line);
    cairo_set_line_width(page, 1);
    cairo_stroke(page);
}

static void draw_plan_scale(cairo_t *page, const plan_view *view, double left, double right, double y)
{
    if (view->unscaled_name) {
        draw_swatch(page, PLAN_LEVEL_ICE, left, y);
        image_set_colour(page, plan_ink);
        image_text(page, left + 20, y, 12, ALIGN_LEFT, false, view->unscaled_name);
        left += 36 + image_text_width(page, 12, false, view->unscaled_name);
    }
    plan_view_colour_scale(page, view->scale_name, view->scale_lo, view->scale_hi, left, right, y);
}

static void draw_plan_legend(cairo_t *page, const plan_view *view, double right, double y)
{
    plan_used seen = plan_find_used(view);
    if (seen.line) {
        static const char name[] = "mooring line";
        right -= image_text_width(page, 12, false, name);
        image_set_colour(page, plan_ink);
        image_text(page, right, y, 12, ALIGN_LEFT, false, name);
        image_set_colour(page, chain);
        cairo_set_line_width(page, 1.6);
        cairo_move_to(page, right - 20, y - 5);
        cairo_line_to(page, right - 6, y - 5);
        cairo_stroke(page);
        right -= 36;
    }
    for (int s = PLAN_STYLE_COUNT - 1; s >= 0; s--) {
        if (!seen.style[s])
            continue;
        right -= image_text_width(page, 12, false, plan_looks[s].name);
        image_set_colour(page, plan_ink);
        image_text(page, right, y, 12, ALIGN_LEFT, false, plan_looks[s].name);
        draw_swatch(page, (plan_style)s, right - 20, y);
        right -= 36;
    }
}

/* AXES: from the right end of a page to their origin. */
enum { PLAN_MARGIN = 14, ABOVE = 64, BELOW = 44, LEAST_WIDTH = 720, TEXTS = LEAST_WIDTH - 2 * PLAN_MARGIN, AXES = 60 };

void plan_view_draw(cairo_t *page, const plan_view *view, int width, int height)
{
    double w = view->window.hi.x - view->window.lo.x, h = view->window.hi.y - view->window.lo.y;
    plan_map m = {.top = ABOVE, .window = view->window};
    m.scale = fmin((width - 2 * PLAN_MARGIN) / w, (height - ABOVE - BELOW) / h);
    m.left = (width - w * m.scale) / 2;
    cairo_save(page);
    /* A pixel at least of a strip that is thinner. */
    cairo_rectangle(page, m.left, m.top, fmax(w * m.scale, 1), fmax(h * m.scale, 1));
    cairo_clip(page);
    image_set_colour(page, water);
    cairo_paint(page);
    cairo_set_antialias(page, CAIRO_ANTIALIAS_FAST);
    plan_paint_shapes(page, &m, view->shapes, view->shape_count);
    draw_plan_track(page, &m, view);
    draw_lines(page, &m, view);
    draw_marks(page, &m, view);
    draw_arrows(page, &m, view);
    draw_labels(page, &m, view);
    cairo_restore(page);

    /* What is written needs its room beside a narrow plan too. */
    double beside = fmax(0, fmin(TEXTS, width - 2 * PLAN_MARGIN) - w * m.scale) / 2;
    double left = m.left - beside, right = m.left + w * m.scale + beside, below = m.top + h * m.scale + 28;
    image_set_colour(page, plan_ink);
    if (!view->no_axes)
        draw_global_axes(page, width - AXES, 44);
    double end = draw_flows(page, view, width - AXES - 24, 50);
    image_text_fitted(page, left, 26, 17, true, width - AXES - 16 - left, view->title);
    image_text_fitted(page, left, 48, 12.5, false, end - 12 - left, view->caption);
    end = draw_scale_bar(page, &m, view->arrow_scale, left, below);
    if (view->scale_name)
        draw_plan_scale(page, view, end + 16, right, below);
    else
        draw_plan_legend(page, view, right, below);
}

/* Windows of one proportion have pages of one size: rounding adds no pixel [pixels]. */
#define PIXEL_SLACK 1e-6

/* What holds all of a side, however short: the page leaves the plan the scale that the longer side has. */
static int whole_pixels(double length) { return (int)fmax(ceil(length - PIXEL_SLACK), 1); }

/* How large a page is whose plan has `longest` pixels along its longer side. */
static fram_status size_page(const plan_view *view, int longest, int *width, int *height, fram_error *error)
{
    double w = view->window.hi.x - view->window.lo.x, h = view->window.hi.y - view->window.lo.y;
    if (!(w > 0 && h > 0))
        return error_set(error, FRAM_ERROR_INTERNAL, NULL, 0, NULL, "the plan view's window is empty");
    double scale = longest / fmax(w, h);
    int wide = whole_pixels(w * scale) + 2 * PLAN_MARGIN;
    *width = wide > LEAST_WIDTH ? wide : LEAST_WIDTH;
    *height = whole_pixels(h * scale) + ABOVE + BELOW;
    return FRAM_OK;
}

fram_status plan_view_write(context *ctx, const plan_view *view, const char *path, int longest, fram_error *error)
{
    image_page page;
    int width = 0, height = 0;
    fram_status status = size_page(view, longest, &width, &height, error);
    if (status == FRAM_OK)
        status = image_page_begin(ctx, path, view->title, width, height, &page, error);
    if (status != FRAM_OK)
        return status;
    plan_view_draw(page.pen, view, width, height);
    return image_page_end(ctx, &page, path, error);
}

fram_status plan_view_png(context *ctx, const plan_view *view, int longest, text_buffer *out, fram_error *error)
{
    cairo_t *page = NULL;
    int width = 0, height = 0;
    fram_status status = size_page(view, longest, &width, &height, error);
    if (status == FRAM_OK)
        status = image_begin(width, height, &page, error);
    if (status != FRAM_OK)
        return status;
    plan_view_draw(page, view, width, height);
    return image_png(ctx, page, out, error);
}

#else

fram_status plan_view_write(context *ctx, const plan_view *view, const char *path, int longest, fram_error *error)
{
    (void)ctx, (void)view, (void)longest;
    return error_set(error, FRAM_ERROR_UNSUPPORTED, path, 0, NULL,
                     "this build has no cairo, so it draws no plan views");
}

fram_status plan_view_png(context *ctx, const plan_view *view, int longest, text_buffer *out, fram_error *error)
{
    (void)out;
    return plan_view_write(ctx, view, "picture", longest, error);
}

#endif
