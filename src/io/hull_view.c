#include "io/hull_view.h"

#include "base/transcendental.h"
#include "io/image.h"
#include "io/palette.h"

#include <stdio.h>
#include <stdlib.h>

#ifdef FRAM_HAVE_CAIRO

enum {
    PAGE_WIDTH = 1500,
    MARGIN = 40,
    HEAD = 84,
    GAP = 48,
    TALLEST_PROFILE = 260,
    TALLEST_PLAN = 360,
    LOW_ROW = 420, /* height of body plan, solids and table */
    BODY_WIDTH = 430,
    TABLE_WIDTH = 330,
    STATIONS = 20,
    WATERLINES = 8,
    BUTTOCKS = 4,
    NAME_OVER = -5,
    NAME_UNDER = 14 /* a point [pixels] */
};
/* Sections begin and end this part of the length inside the ends, where there is something to cut. */
#define END_MARGIN 0.004

static const image_colour hull_ink = {0.13, 0.14, 0.16}, faint = {0.70, 0.72, 0.75}, hull_fill = {0.955, 0.955, 0.945},
                          wet_fill = {0.80, 0.89, 0.96}, water_line = {0.05, 0.36, 0.68},
                          fore_line = {0.72, 0.25, 0.12}, aft_line = {0.16, 0.38, 0.30}, mark = {0.75, 0.10, 0.10};

/* A drawing in a plane: u to the right, v up. */
typedef struct plane_frame {
    double left, base; /* pixels of the origin of u and v */
    double scale;      /* pixels per metre */
} plane_frame;

static double at_u(const plane_frame *f, double u) { return f->left + u * f->scale; }
static double at_v(const plane_frame *f, double v) { return f->base - v * f->scale; }

typedef struct drawing {
    context *ctx;
    cairo_t *page;
    const hull_view *view;
    box3 box;
    vec3 up; /* normal of the water in the hull's frame */
    fram_error *error;
} drawing;

static void trace(cairo_t *page, const plane_frame *f, polygon p)
{
    cairo_new_sub_path(page); /* closing one leaves the pen at its start */
    for (int32_t i = 0; i < p.count; i++)
        cairo_line_to(page, at_u(f, p.vertex[i].x), at_v(f, p.vertex[i].y));
    cairo_close_path(page);
}

static void stroke(cairo_t *page, image_colour c, double width)
{
    image_set_colour(page, c);
    cairo_set_line_width(page, width);
    cairo_stroke(page);
}

/* ---- outlines: every triangle that faces the eye, seen along x (axis 0: from ahead), y or z ---- */

static vec2 seen(vec3 p, int axis)
{
    return axis == 0 ? vec2_make(p.y, p.z) : axis == 1 ? vec2_make(p.x, p.z) : vec2_make(p.x, p.y);
}

static void trace_silhouette(const drawing *d, const plane_frame *f, int axis)
{
    const mesh *m = d->view->surface;
    for (int32_t i = 0; i < m->face.count; i++) {
        vec3 p[3];
        mesh_face_points(m, i, p);
        vec2 a = seen(p[0], axis), b = seen(p[1], axis), c = seen(p[2], axis);
        if (vec2_cross(vec2_sub(b, a), vec2_sub(c, a)) <= 0)
            continue;
        const vec2 corner[3] = {a, b, c};
        trace(d->page, f, (polygon){corner, 3});
    }
}

/* Fill the silhouette, wet on the side of the line through (u, level of u) where the water is: over it in the hull's
   frame where she floats keel up. */
static void draw_silhouette(const drawing *d, const plane_frame *f, int axis, box2 window)
{
    cairo_t *page = d->page;
    cairo_set_antialias(page, CAIRO_ANTIALIAS_GOOD);
    cairo_new_path(page); /* text leaves a point behind */
    trace_silhouette(d, f, axis);
    image_set_colour(page, hull_fill);
    cairo_fill_preserve(page);
    cairo_save(page);
    cairo_clip(page);
    if (axis != 2) {
        double along = axis == 0 ? d->up.y : d->up.x, level = d->view->attitude.level;
        double v0 = (level - along * window.lo.x) / d->up.z, v1 = (level - along * window.hi.x) / d->up.z;
        cairo_move_to(page, at_u(f, window.lo.x), at_v(f, v0));
        cairo_line_to(page, at_u(f, window.hi.x), at_v(f, v1));
        double far = d->up.z > 0 ? window.lo.y - 1 : window.hi.y + 1;
        cairo_line_to(page, at_u(f, window.hi.x), at_v(f, far));
        cairo_line_to(page, at_u(f, window.lo.x), at_v(f, far));
        cairo_close_path(page);
        image_set_colour(page, wet_fill);
        cairo_fill(page);
    }
    cairo_restore(page);
}

static void draw_water(const drawing *d, const plane_frame *f, int axis, double u0, double u1)
{
    double along = axis == 0 ? d->up.y : d->up.x, level = d->view->attitude.level;
    cairo_move_to(d->page, at_u(f, u0), at_v(f, (level - along * u0) / d->up.z));
    cairo_line_to(d->page, at_u(f, u1), at_v(f, (level - along * u1) / d->up.z));
    stroke(d->page, water_line, 1.6);
}

/* ---- lines ---- */

/* Where a family of sections is drawn: coordinates of rings are exchanged (buttocks come as z, x). */
typedef struct family {
    hull_slicer slicer;
    bool exchange;
    double half; /* +1, -1: only that side of the first coordinate; 0: all */
} family;

static fram_status draw_section(const drawing *d, family *s, const plane_frame *f, double at, image_colour colour,
                                double width)
{
    polygon_list rings = {0};
    fram_status status = hull_slice(d->ctx, &s->slicer, at, &rings, d->error);
    for (int32_t i = 0; i < polygon_list_count(&rings) && status == FRAM_OK; i++) {
        polygon ring = polygon_list_get(&rings, i);
        cairo_new_sub_path(d->page);
        for (int32_t k = 0; k < ring.count; k++) {
            vec2 p = ring.vertex[k];
            p = s->exchange ? vec2_make(p.y, p.x) : p;
            cairo_line_to(d->page, at_u(f, p.x), at_v(f, p.y));
        }
        cairo_close_path(d->page);
    }
    cairo_save(d->page);
    cairo_set_line_join(d->page, CAIRO_LINE_JOIN_ROUND);
    stroke(d->page, colour, width);
    cairo_restore(d->page);
    polygon_list_free(d->ctx, &rings);
    return status;
}

static double lerp(double a, double b, double t) { return a + (b - a) * t; }

static void label(const drawing *d, double x, double y, const char *text)
{
    image_set_colour(d->page, hull_ink);
    image_text(d->page, x, y, 13, ALIGN_LEFT, true, text);
}

/* With its name `below` it [pixels]: two names near each other stand over and under. */
static void dot(const drawing *d, const plane_frame *f, vec2 p, double below, const char *name)
{
    double x = at_u(f, p.x), y = at_v(f, p.y);
    cairo_arc(d->page, x, y, 3.2, 0, 2 * PI);
    image_set_colour(d->page, mark);
    cairo_fill(d->page);
    image_text(d->page, x + 6, y + below, 12, ALIGN_LEFT, true, name);
    cairo_new_path(d->page);
}

static void draw_length_scale(const drawing *d, double x, double y, double scale, double span)
{
    double length = image_round_step(span, 12);
    char text[40];
    snprintf(text, sizeof text, "%g m", length);
    image_set_colour(d->page, hull_ink);
    cairo_rectangle(d->page, x, y - 5, length * scale, 5);
    cairo_fill(d->page);
    image_text(d->page, x + length * scale + 7, y, 12, ALIGN_LEFT, false, text);
}

static fram_status draw_profile(const drawing *d, const plane_frame *f)
{
    const hull_stability *s = d->view->stability;
    box2 window = {{d->box.lo.x, d->box.lo.z}, {d->box.hi.x, d->box.hi.z}};
    double breadth = d->box.hi.y - d->box.lo.y, middle = 0.5 * (d->box.lo.y + d->box.hi.y);
    draw_silhouette(d, f, 1, window);
    family buttocks = {.exchange = true};
    fram_status status = hull_slicer_make(d->ctx, d->view->surface, 1, &buttocks.slicer, d->error);
    for (int i = 0; i < BUTTOCKS && status == FRAM_OK; i++)
        status =
            draw_section(d, &buttocks, f, middle + 0.5 * breadth * i / BUTTOCKS, i ? faint : hull_ink, i ? 0.8 : 1.5);
    hull_slicer_free(d->ctx, &buttocks.slicer);
    double past = 0.02 * (d->box.hi.x - d->box.lo.x);
    draw_water(d, f, 1, d->box.lo.x - past, d->box.hi.x + past);
    bool over = s->centre_of_buoyancy.z > s->centre.z;
    dot(d, f, vec2_make(s->centre_of_buoyancy.x, s->centre_of_buoyancy.z), over ? NAME_OVER : NAME_UNDER, "B");
    dot(d, f, vec2_make(s->centre.x, s->centre.z), over ? NAME_UNDER : NAME_OVER, "G");
    label(d, MARGIN, at_v(f, d->box.hi.z) - 12, "Profile");
    image_text(d->page, MARGIN + 56, at_v(f, d->box.hi.z) - 12, 12, ALIGN_LEFT, false,
               "bow to the right; centre line bold, buttocks at each eighth of the breadth");
    return status;
}

static fram_status draw_waterlines(const drawing *d, const plane_frame *f)
{
    box2 window = {{d->box.lo.x, d->box.lo.y}, {d->box.hi.x, d->box.hi.y}};
    draw_silhouette(d, f, 2, window);
    family lines = {0};
    double keel = d->box.lo.z, level = fmin(fmax(d->view->attitude.level / d->up.z, keel), d->box.hi.z);
    bool upright = d->up.z == 1;
    fram_status status = hull_slicer_make(d->ctx, d->view->surface, 2, &lines.slicer, d->error);
    for (int i = 1; i < WATERLINES && status == FRAM_OK; i++)
        status = draw_section(d, &lines, f, lerp(keel, level, (double)i / WATERLINES), faint, 0.9);
    for (int i = 1; i <= 2 && status == FRAM_OK; i++)
        status = draw_section(d, &lines, f, lerp(level, d->box.hi.z, 0.5 * i), hull_ink, i == 2 ? 1.3 : 0.6);
    if (status == FRAM_OK && upright)
        status = draw_section(d, &lines, f, level, water_line, 1.8);
    hull_slicer_free(d->ctx, &lines.slicer);
    dot(d, f, vec2_make(d->view->stability->centre_of_flotation.x, d->view->stability->centre_of_flotation.y),
        NAME_OVER, "F");
    label(d, MARGIN, at_v(f, d->box.hi.y) - 12, "Waterlines");
    image_text(d->page, MARGIN + 84, at_v(f, d->box.hi.y) - 12, 12, ALIGN_LEFT, false,
               upright ? "port up; blue where it floats, grey at each eighth of the draught, black at half freeboard "
                         "and deck"
               : d->up.z > 0 ? "port up; grey under the water amidships, black above it"
                             : "port up; she floats keel up: black under the water amidships, grey above it");
    return status;
}

/* Stations: the fore half of the ship to the right, the after half to the left. */
static fram_status draw_body_plan(const drawing *d, double left, double top)
{
    double breadth = d->box.hi.y - d->box.lo.y, depth = d->box.hi.z - d->box.lo.z, length = d->box.hi.x - d->box.lo.x;
    double scale = fmin(BODY_WIDTH / (1.1 * breadth), (LOW_ROW - 60) / depth),
           middle = 0.5 * (d->box.lo.y + d->box.hi.y);
    plane_frame f = {left + BODY_WIDTH / 2.0 - middle * scale, top + 40 + d->box.hi.z * scale, scale};
    box2 window = {{d->box.lo.y, d->box.lo.z}, {d->box.hi.y, d->box.hi.z}};
    draw_silhouette(d, &f, 0, window);
    family stations = {0};
    fram_status status = hull_slicer_make(d->ctx, d->view->surface, 0, &stations.slicer, d->error);
    for (int fore = 0; fore < 2; fore++) {
        double u = at_u(&f, middle);
        cairo_save(d->page);
        cairo_rectangle(d->page, fore ? u : u - BODY_WIDTH, top, BODY_WIDTH, LOW_ROW);
        cairo_clip(d->page);
        for (int i = 0; i <= STATIONS / 2 && status == FRAM_OK; i++) {
            double t = fmin(fmax((double)(fore ? STATIONS - i : i) / STATIONS, END_MARGIN), 1 - END_MARGIN);
            status = draw_section(d, &stations, &f, d->box.lo.x + t * length, fore ? fore_line : aft_line, 1.0);
        }
        cairo_restore(d->page);
    }
    hull_slicer_free(d->ctx, &stations.slicer);
    cairo_move_to(d->page, at_u(&f, middle), at_v(&f, d->box.lo.z) + 8);
    cairo_line_to(d->page, at_u(&f, middle), at_v(&f, d->box.hi.z) - 8);
    stroke(d->page, faint, 0.8);
    draw_water(d, &f, 0, d->box.lo.y - 0.05 * breadth, d->box.hi.y + 0.05 * breadth);
    label(d, left, top + 12, "Body plan");
    image_text(d->page, left + 78, top + 12, 12, ALIGN_LEFT, false, "after stations left, fore stations right");
    draw_length_scale(d, left, fmin(at_v(&f, d->box.lo.z) + 34, top + LOW_ROW), scale, breadth);
    return status;
}

/* ---- solids in parallel projection, from below and ahead to port ---- */

typedef struct facet {
    double depth; /* towards the eye */
    vec3 normal;
    int32_t first, count; /* corners */
    int32_t piece;        /* -1: the surface */
} facet;

typedef struct facet_view {
    ARRAY(vec3) corner;
    ARRAY(facet) facet;
} facet_view;

static int compare_facets(const void *left, const void *right)
{
    const facet *a = left, *b = right;
    if (a->depth != b->depth)
        return a->depth < b->depth ? -1 : 1;
    return (a->first > b->first) - (a->first < b->first);
}

/* Axes of the picture: right, up, towards the eye. */
static const vec3 eye_right = {-0.57357644, 0.81915204, 0}, eye_up = {0.24520, 0.17169, 0.95419},
                  eye = {0.78163, 0.54730, -0.29930};

static bool add_facet(const drawing *d, facet_view *v, const vec3 *p, int32_t n, vec3 normal, vec3 shift, int32_t piece)
{
    if (vec3_dot(normal, eye) <= 0)
        return true;
    facet f = {-HUGE_VAL, normal, v->corner.count, n, piece};
    double sum = 0;
    for (int32_t i = 0; i < n; i++) {
        vec3 q = vec3_add(p[i], shift);
        sum += vec3_dot(q, eye);
        if (!array_push(d->ctx, &v->corner, q))
            return false;
    }
    f.depth = sum / n;
    return array_push(d->ctx, &v->facet, f);
}

static bool add_surface(const drawing *d, facet_view *v)
{
    const mesh *m = d->view->surface;
    for (int32_t i = 0; i < m->face.count; i++) {
        vec3 p[3];
        mesh_face_points(m, i, p);
        if (!add_facet(d, v, p, 3, vec3_unit(mesh_area_vector(m, i)), (vec3){0, 0, 0}, -1))
            return false;
    }
    return true;
}

/* Pieces move apart from the middle, so that each can be seen. */
static bool add_pieces(const drawing *d, facet_view *v)
{
    const polyhedron_array *pieces = d->view->pieces;
    vec3 middle = vec3_scale(vec3_add(d->box.lo, d->box.hi), 0.5);
    double apart = pieces->count > 1 ? 0.22 : 0;
    vec3 corner[64];
    for (int32_t k = 0; k < pieces->count; k++) {
        const polyhedron *p = &pieces->data[k];
        vec3 shift = vec3_scale(vec3_sub(p->centre, middle), apart);
        for (int32_t i = 0; i < p->face.count; i++) {
            const polyhedron_face *face = &p->face.data[i];
            /* Long loops are drawn as fans of at most 64 corners. */
            for (int32_t at = 1; at + 1 < face->count; at += 62) {
                int32_t n = 0;
                corner[n++] = p->vertex.data[p->loop.data[face->first]];
                for (int32_t c = at; c < face->count && n < 64; c++)
                    corner[n++] = p->vertex.data[p->loop.data[face->first + c]];
                if (!add_facet(d, v, corner, n, face->normal, shift, k))
                    return false;
            }
        }
    }
    return true;
}

static image_colour piece_colour(int32_t piece, vec3 normal)
{
    static const double surface[3] = {0.74, 0.77, 0.80};
    const double *c = piece < 0 ? surface : palette_pieces[piece % PALETTE_PIECES];
    double light = 0.58 + 0.26 * vec3_dot(normal, eye) + 0.22 * normal.z + 0.16 * normal.y;
    light = fmin(fmax(light, 0.35), 1.18);
    return (image_colour){fmin(c[0] * light, 1), fmin(c[1] * light, 1), fmin(c[2] * light, 1)};
}

static void paint_solid(const drawing *d, const facet_view *v, double left, double top, double width, double height)
{
    box2 box = {{HUGE_VAL, HUGE_VAL}, {-HUGE_VAL, -HUGE_VAL}};
    for (int32_t i = 0; i < v->corner.count; i++) {
        double x = vec3_dot(v->corner.data[i], eye_right), y = vec3_dot(v->corner.data[i], eye_up);
        box.lo = vec2_make(fmin(box.lo.x, x), fmin(box.lo.y, y));
        box.hi = vec2_make(fmax(box.hi.x, x), fmax(box.hi.y, y));
    }
    double w = box.hi.x - box.lo.x, h = box.hi.y - box.lo.y;
    if (!(w > 0 && h > 0))
        return;
    double scale = fmin(width / w, height / h);
    plane_frame f = {left + 0.5 * (width - w * scale) - box.lo.x * scale,
                     top + 0.5 * (height + h * scale) + box.lo.y * scale, scale};
    cairo_set_line_join(d->page, CAIRO_LINE_JOIN_ROUND);
    for (int32_t i = 0; i < v->facet.count; i++) {
        const facet *t = &v->facet.data[i];
        cairo_new_path(d->page);
        for (int32_t k = t->first; k < t->first + t->count; k++)
            cairo_line_to(d->page, at_u(&f, vec3_dot(v->corner.data[k], eye_right)),
                          at_v(&f, vec3_dot(v->corner.data[k], eye_up)));
        cairo_close_path(d->page);
        image_set_colour(d->page, piece_colour(t->piece, t->normal));
        cairo_fill_preserve(d->page);
        /* Triangles in their own colour: a line that hides the seams. */
        if (t->piece >= 0)
            cairo_set_source_rgba(d->page, 0.1, 0.12, 0.15, 0.5);
        cairo_set_line_width(d->page, t->piece >= 0 ? 0.6 : 0.8);
        cairo_stroke(d->page);
    }
}

static fram_status draw_solid(const drawing *d, bool pieces, double left, double top, double width, double height)
{
    facet_view v = {0};
    bool done = pieces ? add_pieces(d, &v) : add_surface(d, &v);
    if (done && v.facet.count)
        qsort(v.facet.data, (size_t)v.facet.count, sizeof *v.facet.data, compare_facets);
    if (done)
        paint_solid(d, &v, left, top, width, height);
    array_free(d->ctx, &v.corner);
    array_free(d->ctx, &v.facet);
    return done ? FRAM_OK : error_memory(d->error);
}

static fram_status draw_solids(const drawing *d, double left, double top, double width)
{
    double half = (LOW_ROW - 50) / 2.0;
    int32_t count = d->view->pieces->count;
    char text[96];
    label(d, left, top + 12, "Surface from below, bow near");
    fram_status status = draw_solid(d, false, left, top + 18, width, half - 6);
    if (count == 0 || status != FRAM_OK)
        return status;
    snprintf(text, sizeof text, count == 1 ? "Its one convex piece" : "Its %d convex pieces, drawn apart", (int)count);
    label(d, left, top + 12 + half + 22, text);
    return draw_solid(d, true, left, top + half + 42, width, half - 6);
}

static void draw_table(const drawing *d, double left, double top)
{
    for (int i = 0; i < d->view->lines; i++) {
        double y = top + 12 + 17.5 * i;
        image_set_colour(d->page, hull_ink);
        image_text(d->page, left, y, 12.5, ALIGN_LEFT, false, d->view->names[i]);
        image_text(d->page, left + TABLE_WIDTH, y, 12.5, ALIGN_RIGHT, true, d->view->values[i]);
    }
}

/* ---- the page ---- */

static fram_status draw_page(drawing *d, double scale, double profile, double plan)
{
    double length = d->box.hi.x - d->box.lo.x, left = (PAGE_WIDTH - length * scale) / 2 - d->box.lo.x * scale;
    image_set_colour(d->page, hull_ink);
    double bar = PAGE_WIDTH - MARGIN - 70 - image_round_step(length, 12) * scale;
    image_text_fitted(d->page, MARGIN, 34, 19, true, bar - 20 - MARGIN, d->view->title);
    image_text_fitted(d->page, MARGIN, 56, 13, false, PAGE_WIDTH - 2 * MARGIN, d->view->caption);
    plane_frame side = {left, HEAD + 20 + d->box.hi.z * scale, scale};
    double below = HEAD + 20 + profile + GAP;
    plane_frame above = {left, below + d->box.hi.y * scale, scale};
    double low = below + plan + GAP;
    draw_length_scale(d, bar, 38, scale, length);
    fram_status status = draw_profile(d, &side);
    if (status == FRAM_OK)
        status = draw_waterlines(d, &above);
    if (status == FRAM_OK)
        status = draw_body_plan(d, MARGIN, low);
    double solids = MARGIN + BODY_WIDTH + 40, table = PAGE_WIDTH - MARGIN - TABLE_WIDTH;
    if (status == FRAM_OK)
        status = draw_solids(d, solids, low, table - 50 - solids);
    draw_table(d, table, low);
    return status;
}

fram_status hull_view_write(context *ctx, const hull_view *view, const char *path, fram_error *error)
{
    drawing d = {.ctx = ctx, .view = view, .box = mesh_bounds(view->surface), .error = error};
    mat3 r = hull_rotation(&view->attitude);
    d.up = vec3_make(r.m[2][0], r.m[2][1], r.m[2][2]);
    vec3 size = vec3_sub(d.box.hi, d.box.lo);
    double scale = fmin((PAGE_WIDTH - 3 * MARGIN) / size.x, fmin(TALLEST_PROFILE / size.z, TALLEST_PLAN / size.y));
    double profile = size.z * scale, plan = size.y * scale;
    int height = (int)(HEAD + 20 + profile + plan + 2 * GAP + LOW_ROW + MARGIN);
    image_page page;
    fram_status status = image_page_begin(ctx, path, view->title, PAGE_WIDTH, height, &page, error);
    if (status != FRAM_OK)
        return status;
    d.page = page.pen;
    status = draw_page(&d, scale, profile, plan);
    if (status == FRAM_OK)
        return image_page_end(ctx, &page, path, error);
    image_page_drop(&page);
    return status;
}

#else

fram_status hull_view_write(context *ctx, const hull_view *view, const char *path, fram_error *error)
{
    (void)ctx, (void)view;
    return error_set(error, FRAM_ERROR_UNSUPPORTED, path, 0, NULL, "this build has no cairo, so it draws no hulls");
}

#endif
