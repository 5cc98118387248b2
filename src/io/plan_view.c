#include "io/plan_view.h"

#include "base/load_unit.h"
#include "base/transcendental.h"
#include "io/image.h"

#include <math.h>
#include <stdio.h>

#ifdef FRAM_HAVE_CAIRO

typedef struct plan_look {
    image_colour fill, line;
    const char *name;
} plan_look;

static const plan_look looks[PLAN_STYLE_COUNT] = {
    [PLAN_FLOE] = {{0.95, 0.97, 0.99}, {0.36, 0.48, 0.60}, "floe"},
    [PLAN_LEVEL_ICE] = {{0.82, 0.89, 0.95}, {0.82, 0.89, 0.95}, "level ice"},
    [PLAN_FIXED_ICE] = {{0.82, 0.89, 0.95}, {0.30, 0.42, 0.55}, "fixed ice"},
    [PLAN_WALL] = {{0.45, 0.42, 0.40}, {0.30, 0.28, 0.26}, "wall"},
    [PLAN_DECK] = {{0.80, 0.28, 0.18}, {0.35, 0.08, 0.05}, "vessel"},
    [PLAN_WATERLINE] = {{0.93, 0.55, 0.42}, {0.35, 0.08, 0.05}, "vessel at the waterline"},
};
static const image_colour water = {0.16, 0.36, 0.52}, plan_ink = {0.1, 0.1, 0.1};

typedef struct map {
    double left, top, scale; /* pixels; pixels per metre */
    box2 window;
} map;

static double map_x(const map *m, vec2 p) { return m->left + (p.x - m->window.lo.x) * m->scale; }
static double map_y(const map *m, vec2 p) { return m->top + (m->window.hi.y - p.y) * m->scale; }

static void line_to(cairo_t *page, const map *m, vec2 p) { cairo_line_to(page, map_x(m, p), map_y(m, p)); }

static image_colour fill_of(const plan_shape *s)
{
    double rgb[3];
    if (!s->has_value)
        return looks[s->style].fill;
    image_ramp((double)s->value, rgb);
    return (image_colour){rgb[0], rgb[1], rgb[2]};
}

/* Width of lines but those of a hull [pixels]. */
#define FLOE_LINE 0.7

static void paint_shape(cairo_t *page, const plan_shape *s)
{
    cairo_close_path(page);
    image_set_colour(page, fill_of(s));
    cairo_fill_preserve(page);
    image_set_colour(page, looks[s->style].line);
    cairo_set_line_width(page, s->style == PLAN_DECK || s->style == PLAN_WATERLINE ? 1.5 : FLOE_LINE);
    cairo_stroke(page);
}

/* The least 1 + cos of the turn at a corner that a line follows to its tip. */
#define SHARPEST 0.1

/* To the right of a way along an edge; zero for none. */
static vec2 edge_normal(vec2 from, vec2 to)
{
    vec2 along = vec2_sub(to, from);
    double length = vec2_length(along);
    return length > 0 ? vec2_scale(vec2_make(along.y, -along.x), 1 / length) : vec2_make(0, 0);
}

/* The outline, each edge moved by so many metres to its right. */
static void trace_moved(cairo_t *page, const map *m, polygon p, vec2 origin, double distance)
{
    vec2 before = edge_normal(p.vertex[p.count - 1], p.vertex[0]);
    for (int32_t i = 0; i < p.count; i++) {
        vec2 after = edge_normal(p.vertex[i], p.vertex[i + 1 < p.count ? i + 1 : 0]);
        double turn = fmax(1 + vec2_dot(before, after), SHARPEST);
        vec2 away = vec2_scale(vec2_add(before, after), distance / turn);
        line_to(page, m, vec2_add(vec2_add(p.vertex[i], origin), away));
        before = after;
    }
    cairo_close_path(page);
}

/* A floe: its line is what an area half a line larger shows around one half a line smaller, for two areas take a third
   of the time of an area and its outline. */
static void paint_floe(cairo_t *page, const map *m, const plan_shape *s, vec2 origin)
{
    double half = FLOE_LINE / 2 / m->scale * (polygon_area(s->outline) < 0 ? -1 : 1);
    trace_moved(page, m, s->outline, origin, half);
    image_set_colour(page, looks[s->style].line);
    cairo_fill(page);
    trace_moved(page, m, s->outline, origin, -half);
    image_set_colour(page, fill_of(s));
    cairo_fill(page);
}

/* Floes of a few pixels get no lines, which cost most of a picture's time, but a gap: that much smaller [pixels]. */
#define SMALL_FLOE 8
#define SMALL_FLOE_GAP 0.3

/* Draws a floe of a few pixels, about the middle of its corners; false for any other shape. */
static bool draw_small(cairo_t *page, const map *m, const plan_shape *s)
{
    polygon p = s->outline;
    vec2 middle = {0, 0};
    double farthest = 0;
    for (int32_t i = 0; i < p.count; i++)
        middle = vec2_add(middle, vec2_scale(p.vertex[i], 1.0 / p.count));
    for (int32_t i = 0; i < p.count; i++)
        farthest = fmax(farthest, vec2_length(vec2_sub(p.vertex[i], middle)) * m->scale);
    if (s->style != PLAN_FLOE || farthest > SMALL_FLOE || farthest <= SMALL_FLOE_GAP)
        return false;
    for (int32_t i = 0; i < p.count; i++) {
        vec2 at = vec2_add(middle, vec2_scale(vec2_sub(p.vertex[i], middle), 1 - SMALL_FLOE_GAP / farthest));
        line_to(page, m, at);
    }
    cairo_close_path(page);
    image_set_colour(page, fill_of(s));
    cairo_fill(page);
    return true;
}

/* Sides of a prism that tilts by less than this are not told apart from the edge of its face [pixels]. */
static const double LEAST_SIDE = 1;

/* Those of its sides that face the eye, and its upper face over them. */
static void draw_shape(cairo_t *page, const map *m, const plan_shape *s)
{
    bool tilts = vec2_length(s->drop) * m->scale >= LEAST_SIDE;
    if (!tilts && draw_small(page, m, s))
        return;
    vec2 up = tilts ? vec2_scale(s->drop, -0.5) : vec2_make(0, 0);
    double turn = polygon_area(s->outline) < 0 ? -1 : 1;
    for (int32_t i = 0; tilts && i < s->outline.count; i++) {
        vec2 a = s->outline.vertex[i], b = s->outline.vertex[i + 1 < s->outline.count ? i + 1 : 0];
        if (!(turn * vec2_cross(s->drop, vec2_sub(b, a)) > 0))
            continue;
        line_to(page, m, vec2_add(a, up));
        line_to(page, m, vec2_add(b, up));
        line_to(page, m, vec2_sub(b, up));
        line_to(page, m, vec2_sub(a, up));
        paint_shape(page, s);
    }
    if (s->outline.count > 0 && (s->style == PLAN_FLOE || s->style == PLAN_FIXED_ICE)) {
        paint_floe(page, m, s, up);
        return;
    }
    for (int32_t i = 0; i < s->outline.count; i++)
        line_to(page, m, vec2_add(s->outline.vertex[i], up));
    paint_shape(page, s);
}

static bool same_colour(const plan_shape *a, const plan_shape *b)
{
    return a->has_value == b->has_value && (!a->has_value || !(a->value < b->value || a->value > b->value));
}

/* Tiles of level ice of one colour that follow each other, from the first shape on: how many.  They are one area
   without lines, for their seams are neither boundary nor crack; filled one by one, pixels on a seam would be of both
   and let what is below shine through. */
static int32_t draw_level_ice(cairo_t *page, const map *m, const plan_shape *shapes, int32_t count)
{
    int32_t n = 0;
    for (; n < count && shapes[n].style == PLAN_LEVEL_ICE && same_colour(&shapes[n], &shapes[0]); n++) {
        cairo_new_sub_path(page);
        for (int32_t i = 0; i < shapes[n].outline.count; i++)
            line_to(page, m, shapes[n].outline.vertex[i]);
        cairo_close_path(page);
    }
    image_set_colour(page, fill_of(&shapes[0]));
    cairo_fill(page);
    return n;
}

static void draw_shapes(cairo_t *page, const map *m, const plan_view *view)
{
    for (int32_t i = 0; i < view->shape_count;) {
        const plan_shape *s = &view->shapes[i];
        if (s->style == PLAN_LEVEL_ICE) {
            i += draw_level_ice(page, m, s, view->shape_count - i);
        } else {
            draw_shape(page, m, s);
            i++;
        }
    }
    if (view->track_count < 2)
        return;
    for (int32_t i = 0; i < view->track_count; i++)
        cairo_line_to(page, map_x(m, view->track[i]), map_y(m, view->track[i]));
    cairo_set_source_rgba(page, 0.85, 0.1, 0.1, 0.8);
    cairo_set_line_width(page, 1.2);
    cairo_stroke(page);
}

static void draw_marks(cairo_t *page, const map *m, const plan_view *view)
{
    cairo_set_source_rgb(page, 0.90, 0.45, 0.0);
    cairo_set_line_width(page, 1.6);
    for (int32_t i = 0; i < view->mark_count; i++) {
        double x = map_x(m, view->marks[i]), y = map_y(m, view->marks[i]), r = 3.5;
        cairo_move_to(page, x - r, y - r);
        cairo_line_to(page, x + r, y + r);
        cairo_move_to(page, x - r, y + r);
        cairo_line_to(page, x + r, y - r);
    }
    cairo_stroke(page);
}

/* Of labels [pixels]. */
#define LABEL_RADIUS 6.0
#define LABEL_SIZE 12.0

static const image_colour chain = {0.20, 0.20, 0.22};

/* Over floes and hull, so that the fairleads are seen too; anchors outside the window are cut off with it. */
static void draw_lines(cairo_t *page, const map *m, const plan_view *view)
{
    const double anchor = 4;
    image_set_colour(page, chain);
    cairo_set_line_width(page, 1.6);
    for (int32_t i = 0; i < view->line_count; i++) {
        const plan_line *l = &view->lines[i];
        cairo_move_to(page, map_x(m, l->upper), map_y(m, l->upper));
        line_to(page, m, l->anchor);
        cairo_stroke(page);
        cairo_rectangle(page, map_x(m, l->anchor) - anchor, map_y(m, l->anchor) - anchor, 2 * anchor, 2 * anchor);
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

static void draw_arrows(cairo_t *page, const map *m, const plan_view *view)
{
    cairo_set_source_rgb(page, 0.75, 0.05, 0.25);
    for (int32_t i = 0; i < view->arrow_count; i++) {
        const plan_arrow *a = &view->arrows[i];
        image_arrow(page, map_x(m, a->from), map_y(m, a->from), map_x(m, a->to), map_y(m, a->to), 2, 9);
    }
}

/* Ground of a label's name [pixels]. */
static box2 label_box(cairo_t *page, const map *m, const plan_label *l)
{
    double left = map_x(m, l->at) + LABEL_RADIUS + 3, y = map_y(m, l->at);
    return (box2){{left, y - 9}, {left + image_text_width(page, LABEL_SIZE, true, l->text) + 6, y + 7}};
}

/* One of the names before it stands there. */
static bool is_covered(cairo_t *page, const map *m, const plan_view *view, int32_t label)
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
static void draw_labels(cairo_t *page, const map *m, const plan_view *view)
{
    for (int32_t i = view->label_count - 1; i >= 0; i--) {
        const plan_label *l = &view->labels[i];
        double rgb[3];
        if (l->bare)
            continue;
        image_ramp((double)l->value, rgb);
        cairo_new_path(page);
        cairo_arc(page, map_x(m, l->at), map_y(m, l->at), LABEL_RADIUS, 0, 2 * PI);
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
static double draw_scale_bar(cairo_t *page, const map *m, double arrow, double x, double y)
{
    double length = image_round_step(m->window.hi.x - m->window.lo.x, 6), px = length * m->scale;
    char text[80];
    snprintf(text, sizeof text, "%g m", length);
    image_set_colour(page, plan_ink);
    cairo_rectangle(page, x, y - 6, px, 6);
    cairo_fill(page);
    image_set_colour(page, (image_colour){1, 1, 1});
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
        right -= image_text_width(page, 12, false, looks[s].name);
        image_set_colour(page, plan_ink);
        image_text(page, right, y, 12, ALIGN_LEFT, false, looks[s].name);
        cairo_rectangle(page, right - 20, y - 11, 14, 12);
        image_set_colour(page, looks[s].fill);
        cairo_fill_preserve(page);
        image_set_colour(page, looks[s].line);
        cairo_set_line_width(page, 1);
        cairo_stroke(page);
        right -= 36;
    }
}

/* AXES: from the right end of a page to their origin. */
enum { PLAN_MARGIN = 14, ABOVE = 64, BELOW = 44, LEAST_WIDTH = 720, TEXTS = LEAST_WIDTH - 2 * PLAN_MARGIN, AXES = 60 };

void plan_view_draw(cairo_t *page, const plan_view *view, int width, int height)
{
    double w = view->window.hi.x - view->window.lo.x, h = view->window.hi.y - view->window.lo.y;
    map m = {.top = ABOVE, .window = view->window};
    m.scale = fmin((width - 2 * PLAN_MARGIN) / w, (height - ABOVE - BELOW) / h);
    m.left = (width - w * m.scale) / 2;
    cairo_save(page);
    cairo_rectangle(page, m.left, m.top, w * m.scale, h * m.scale);
    cairo_clip(page);
    image_set_colour(page, water);
    cairo_paint(page);
    cairo_set_antialias(page, CAIRO_ANTIALIAS_FAST);
    draw_shapes(page, &m, view);
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
        plan_view_colour_scale(page, view->scale_name, view->scale_lo, view->scale_hi, end + 16, right, below);
    else
        draw_plan_legend(page, view, right, below);
}

/* Windows of one proportion have pages of one size: rounding takes no pixel away [pixels]. */
#define PIXEL_SLACK 1e-6

/* How large a page is whose plan has `longest` pixels along its longer side. */
static fram_status size_page(const plan_view *view, int longest, int *width, int *height, fram_error *error)
{
    double w = view->window.hi.x - view->window.lo.x, h = view->window.hi.y - view->window.lo.y;
    if (!(w > 0 && h > 0))
        return error_set(error, FRAM_ERROR_INTERNAL, NULL, 0, NULL, "the plan view's window is empty");
    double scale = longest / fmax(w, h);
    *width = (int)fmax(w * scale + PIXEL_SLACK + 2 * PLAN_MARGIN, LEAST_WIDTH);
    *height = (int)(h * scale + PIXEL_SLACK + ABOVE + BELOW);
    return FRAM_OK;
}

fram_status plan_view_write(context *ctx, const plan_view *view, const char *path, int longest, fram_error *error)
{
    image_page page;
    int width = 0, height = 0;
    fram_status status = size_page(view, longest, &width, &height, error);
    if (status == FRAM_OK)
        status = image_page_begin(ctx, path, width, height, &page, error);
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
