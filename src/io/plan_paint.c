#include "io/plan_paint.h"

#ifdef FRAM_HAVE_CAIRO

const plan_look plan_looks[PLAN_STYLE_COUNT] = {
    [PLAN_FLOE] = {{0.95, 0.97, 0.99}, {0.36, 0.48, 0.60}, "floe"},
    [PLAN_LEVEL_ICE] = {{0.82, 0.89, 0.95}, {0.82, 0.89, 0.95}, "level ice"},
    [PLAN_FIXED_ICE] = {{0.82, 0.89, 0.95}, {0.30, 0.42, 0.55}, "fixed ice"},
    [PLAN_WALL] = {{0.45, 0.42, 0.40}, {0.30, 0.28, 0.26}, "wall"},
    [PLAN_DECK] = {{0.80, 0.28, 0.18}, {0.35, 0.08, 0.05}, "vessel"},
    [PLAN_WATERLINE] = {{0.93, 0.55, 0.42}, {0.35, 0.08, 0.05}, "vessel at the waterline"},
};

double plan_map_x(const plan_map *m, vec2 p) { return m->left + (p.x - m->window.lo.x) * m->scale; }
double plan_map_y(const plan_map *m, vec2 p) { return m->top + (m->window.hi.y - p.y) * m->scale; }

void plan_line_to(cairo_t *page, const plan_map *m, vec2 p) { cairo_line_to(page, plan_map_x(m, p), plan_map_y(m, p)); }

static image_colour fill_of(const plan_shape *s)
{
    double rgb[3];
    if (!s->has_value)
        return plan_looks[s->style].fill;
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
    image_set_colour(page, plan_looks[s->style].line);
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
static void trace_moved(cairo_t *page, const plan_map *m, polygon p, vec2 origin, double distance)
{
    vec2 before = edge_normal(p.vertex[p.count - 1], p.vertex[0]);
    for (int32_t i = 0; i < p.count; i++) {
        vec2 after = edge_normal(p.vertex[i], p.vertex[i + 1 < p.count ? i + 1 : 0]);
        double turn = fmax(1 + vec2_dot(before, after), SHARPEST);
        vec2 away = vec2_scale(vec2_add(before, after), distance / turn);
        plan_line_to(page, m, vec2_add(vec2_add(p.vertex[i], origin), away));
        before = after;
    }
    cairo_close_path(page);
}

/* A floe: its line is what an area half a line larger shows around one half a line smaller, for two areas take a third
   of the time of an area and its outline. */
static void paint_floe(cairo_t *page, const plan_map *m, const plan_shape *s, vec2 origin)
{
    double half = FLOE_LINE / 2 / m->scale * (polygon_area(s->outline) < 0 ? -1 : 1);
    trace_moved(page, m, s->outline, origin, half);
    image_set_colour(page, plan_looks[s->style].line);
    cairo_fill(page);
    trace_moved(page, m, s->outline, origin, -half);
    image_set_colour(page, fill_of(s));
    cairo_fill(page);
}

/* Floes of a few pixels get no lines, which cost most of a picture's time, but a gap: that much smaller [pixels]. */
#define SMALL_FLOE 8
#define SMALL_FLOE_GAP 0.3

/* Draws a floe of a few pixels, about the middle of its corners; false for any other shape. */
static bool draw_small(cairo_t *page, const plan_map *m, const plan_shape *s)
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
        plan_line_to(page, m, at);
    }
    cairo_close_path(page);
    image_set_colour(page, fill_of(s));
    cairo_fill(page);
    return true;
}

/* Sides of a prism that tilts by less than this are not told apart from the edge of its face [pixels]. */
static const double LEAST_SIDE = 1;

/* Those of its sides that face the eye, and its upper face over them. */
static void draw_shape(cairo_t *page, const plan_map *m, const plan_shape *s)
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
        plan_line_to(page, m, vec2_add(a, up));
        plan_line_to(page, m, vec2_add(b, up));
        plan_line_to(page, m, vec2_sub(b, up));
        plan_line_to(page, m, vec2_sub(a, up));
        paint_shape(page, s);
    }
    if (s->outline.count > 0 && (s->style == PLAN_FLOE || s->style == PLAN_FIXED_ICE)) {
        paint_floe(page, m, s, up);
        return;
    }
    for (int32_t i = 0; i < s->outline.count; i++)
        plan_line_to(page, m, vec2_add(s->outline.vertex[i], up));
    paint_shape(page, s);
}

static bool same_colour(const plan_shape *a, const plan_shape *b)
{
    return a->has_value == b->has_value && (!a->has_value || !(a->value < b->value || a->value > b->value));
}

static void trace_tile(cairo_t *page, const plan_map *m, const plan_shape *s)
{
    cairo_new_sub_path(page);
    for (int32_t i = 0; i < s->outline.count; i++)
        plan_line_to(page, m, s->outline.vertex[i]);
    cairo_close_path(page);
}

/* Tiles of level ice of one colour that follow each other, from the first shape on: how many.  They are one area
   without lines, for their seams are neither boundary nor crack; filled one by one, pixels on a seam would be of both
   and let what is below shine through. */
static int32_t count_alike(const plan_shape *shapes, int32_t count)
{
    int32_t n = 0;
    while (n < count && shapes[n].style == PLAN_LEVEL_ICE && same_colour(&shapes[n], &shapes[0]))
        n++;
    return n;
}

/* What is level ice among the shapes as one area. */
static void fill_level_ice(cairo_t *page, const plan_map *m, const plan_shape *shapes, int32_t count,
                           image_colour colour)
{
    for (int32_t i = 0; i < count; i++)
        if (shapes[i].style == PLAN_LEVEL_ICE)
            trace_tile(page, m, &shapes[i]);
    image_set_colour(page, colour);
    cairo_fill(page);
}

static bool has_level_ice(const plan_shape *shapes, int32_t count)
{
    int32_t i = 0;
    while (i < count && shapes[i].style != PLAN_LEVEL_ICE)
        i++;
    return i < count;
}

void plan_paint_shapes(cairo_t *page, const plan_map *m, const plan_shape *shapes, int32_t count)
{
    bool first = true;
    for (int32_t i = 0; i < count;) {
        const plan_shape *s = &shapes[i];
        int32_t alike = count_alike(s, count - i);
        /* Where there is more of it, of another colour or behind other shapes, all of it is one area first: what
           shines through at the seams is level ice then. */
        if (alike > 0 && first && has_level_ice(s + alike, count - i - alike))
            fill_level_ice(page, m, s, count - i, plan_looks[PLAN_LEVEL_ICE].fill);
        first = first && alike == 0;
        if (alike > 0)
            fill_level_ice(page, m, s, alike, fill_of(s));
        else
            draw_shape(page, m, s);
        i += alike > 0 ? alike : 1;
    }
}

#endif
