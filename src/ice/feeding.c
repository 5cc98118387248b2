/* Feeding, step by step; see feeding.h. */
#include "ice/feeding_parts.h"

#include <math.h>

#define TABLE_SELF feeding_table
TABLE_DEFINE(feeding, FEEDING_FIELDS)
#undef TABLE_SELF
#define TABLE_SELF pattern_table
TABLE_DEFINE(pattern, PATTERN_FIELDS)
#undef TABLE_SELF
#define TABLE_SELF pattern_copy_table
TABLE_DEFINE(pattern_copy, PATTERN_COPY_FIELDS)
#undef TABLE_SELF
#define TABLE_SELF pattern_vertex_table
TABLE_DEFINE(pattern_vertex, PATTERN_VERTEX_FIELDS)
#undef TABLE_SELF

/* A floe leaves the window when it is clear of it by this part of the band, so that none goes to and fro with every
   shake of the drift. */
#define CLEAR_SHARE 0.05
/* What a floe may overlap others by as it enters, as a part of its radius: what packed floes may overlap in the pattern
   itself (under 1 mm for floes of 10 m). */
#define ENTRY_OVERLAP 1e-4

double feeding_clearance(double band) { return CLEAR_SHARE * band; }

static double clear_distance(const feeding_world *w) { return feeding_clearance(w->feeding->band[0]); }

/* ---- places ---- */

double feeding_periods(double x, double period)
{
    /* Nearly all are plain: no division, and no call of floor. */
    double size = fabs(x);
    if (size < 0.499 * period)
        return 0;
    if (size > 0.501 * period && size < 1.499 * period)
        return x > 0 ? 1 : -1;
    return floor(x / period + 0.5);
}

/* x less whole periods, in -period/2 .. period/2. */
static double wrap(double x, double period) { return x - period * feeding_periods(x, period); }

vec2 feeding_place_at(const feeding_world *w, int32_t row, vec2 displacement)
{
    const feeding_table *f = w->feeding;
    vec2 middle = vec2_scale(vec2_add(f->lo[0], f->hi[0]), 0.5);
    vec2 from = vec2_sub(vec2_add(w->pattern->place[row], displacement), middle);
    return vec2_add(middle, vec2_make(wrap(from.x, f->tile[0].x), wrap(from.y, f->tile[0].y)));
}

vec2 feeding_place(const feeding_world *w, int32_t row)
{
    return feeding_place_at(w, row, w->feeding->displacement[0]);
}

/* Least distance of a point inside the window from its edge; negative outside [m].  Without fmin, which is a call. */
static double depth_inside(const feeding_table *f, vec2 p)
{
    double left = p.x - f->lo[0].x, right = f->hi[0].x - p.x, low = p.y - f->lo[0].y, high = f->hi[0].y - p.y;
    double x = left < right ? left : right, y = low < high ? low : high;
    return x < y ? x : y;
}

static bool depth_reaches(double depth, double radius, double margin) { return depth + radius + margin >= 0; }

bool feeding_reaches(const feeding_world *w, vec2 place, double radius, double margin)
{
    return depth_reaches(depth_inside(w->feeding, place), radius, margin);
}

polygon feeding_outline(const feeding_world *w, int32_t row)
{
    return (polygon){w->vertices->point + w->pattern->first[row], w->pattern->size[row]};
}

/* ---- floes ---- */

static double depth_of(const feeding_world *w, int32_t body)
{
    vec3 r = w->bodies->position[body];
    return depth_inside(w->feeding, vec2_make(r.x, r.y));
}

static bool in_band(const feeding_table *f, double depth) { return depth < f->band[0]; }

static void go_with_sheet(const feeding_world *w, int32_t body)
{
    vec2 v = w->feeding->velocity[0];
    w->bodies->velocity[body] = vec3_make(v.x, v.y, 0);
    w->bodies->angular_velocity[body] = vec3_make(0, 0, 0);
}

fram_status feeding_make_floe(context *ctx, overlay *o, const feeding_world *w, int32_t row, polygon outline,
                              fram_error *error)
{
    const pattern_table *p = w->pattern;
    vec2 place = feeding_place(w, row);
    vec2_array global = {0};
    if (!array_resize(ctx, &global, outline.count))
        return error_memory(error);
    for (int32_t i = 0; i < outline.count; i++)
        global.data[i] = vec2_add(outline.vertex[i], place);
    floe_definition d = {.outline = {global.data, global.count},
                         .thickness = p->thickness[row],
                         .material = p->material[row],
                         .breakable = p->breakable[row] != 0,
                         .motion = MOTION_PRESCRIBED,
                         .elevation = p->elevation[row],
                         .parent = -1,
                         .ice_origin = vec2_sub(p->place[row], place)};
    int32_t floe = -1;
    fram_status status = floe_create(ctx, &d, w->feeding->piece_area_limit[0], o, w->bodies, w->shapes, w->floes,
                                     w->next_number, &floe, error);
    array_free(ctx, &global);
    if (status != FRAM_OK)
        return status;
    int32_t body = w->floes->body[floe];
    if (!in_band(w->feeding, depth_of(w, body)))
        w->bodies->motion[body] = MOTION_DYNAMIC;
    go_with_sheet(w, body);
    w->pattern->body[row] = body;
    w->pattern->generation[row] = w->bodies->generation[body];
    return FRAM_OK;
}

/* ---- is there room? ---- */

/* The outline of a body in the plane, global. */
static bool plan_outline(context *ctx, const feeding_world *w, int32_t body, vec2_array *out)
{
    polygon p = shape_outline(w->shapes, w->bodies->shape[body]);
    if (!array_resize(ctx, out, p.count))
        return false;
    for (int32_t i = 0; i < p.count; i++) {
        vec3 g = body_to_global(w->bodies, body, vec3_make(p.vertex[i].x, p.vertex[i].y, 0));
        out->data[i] = vec2_make(g.x, g.y);
    }
    return true;
}

static bool overlap(polygon a, polygon b, double allowed)
{
    if (polygon_is_convex(a) && polygon_is_convex(b))
        return polygon_convex_depth(a, b, NULL) > allowed;
    /* Twice the allowed depth along a width of as much again. */
    return polygon_overlap_area(a, b) > 4 * allowed * allowed;
}

/* A hull takes up its box. */
static bool box_taken(const feeding_world *w, int32_t body, vec2 place, double radius)
{
    if (body >= w->boxes->count || w->boxes->generation[body] != w->bodies->generation[body])
        return false;
    vec3 lo = w->boxes->lo[body], hi = w->boxes->hi[body];
    return place.x + radius > lo.x && place.x - radius < hi.x && place.y + radius > lo.y && place.y - radius < hi.y;
}

/* The floe of the pattern, where it is now, would overlap a body.  false: no memory. */
static bool is_taken(context *ctx, const feeding_world *w, int32_t row, vec2_array scratch[2], bool *taken)
{
    const body_table *b = w->bodies;
    vec2 place = feeding_place(w, row);
    double radius = w->pattern->radius[row];
    polygon own = feeding_outline(w, row);
    if (!array_resize(ctx, &scratch[0], own.count))
        return false;
    for (int32_t i = 0; i < own.count; i++)
        scratch[0].data[i] = vec2_add(own.vertex[i], place);
    *taken = false;
    for (int32_t i = 0; i < b->count && !*taken; i++) {
        int32_t shape = b->shape[i];
        if (!body_is_alive(b, i) || shape < 0)
            continue;
        if (w->shapes->shapes.kind[shape] != SHAPE_PRISM) {
            *taken = box_taken(w, i, place, radius);
            continue;
        }
        double reach = radius + w->shapes->shapes.radius[shape];
        vec2 apart = vec2_sub(vec2_make(b->position[i].x, b->position[i].y), place);
        if (vec2_dot(apart, apart) >= reach * reach)
            continue;
        if (!plan_outline(ctx, w, i, &scratch[1]))
            return false;
        *taken = overlap((polygon){scratch[0].data, scratch[0].count}, (polygon){scratch[1].data, scratch[1].count},
                         ENTRY_OVERLAP * radius);
    }
    return true;
}

/* ---- a step ---- */

void feeding_drive(const feeding_world *w, vec2 velocity)
{
    if (w->feeding->count == 0)
        return;
    w->feeding->velocity[0] = velocity;
    for (int32_t i = 0; i < w->floes->count; i++) {
        int32_t body = w->floes->body[i];
        if (body >= 0 && w->bodies->motion[body] == MOTION_PRESCRIBED)
            go_with_sheet(w, body);
    }
}

/* Floes that have left are taken out; others are of the band or inside. */
static void sort_floes(const feeding_world *w)
{
    body_table *b = w->bodies;
    for (int32_t i = 0; i < w->floes->count; i++) {
        int32_t body = w->floes->body[i];
        if (body < 0 || b->motion[body] == MOTION_STATIC)
            continue;
        double depth = depth_of(w, body), reach = w->shapes->shapes.radius[b->shape[body]];
        if (!depth_reaches(depth, reach, clear_distance(w))) {
            *w->left += b->mass[body];
            floe_remove(b, w->shapes, w->floes, i);
            continue;
        }
        bool held = in_band(w->feeding, depth);
        if (held && b->motion[body] == MOTION_DYNAMIC)
            go_with_sheet(w, body);
        b->motion[body] = held ? MOTION_PRESCRIBED : MOTION_DYNAMIC;
    }
}

static fram_status try_to_enter(context *ctx, overlay *o, const feeding_world *w, int32_t row, vec2_array scratch[2],
                                fram_error *error)
{
    pattern_table *p = w->pattern;
    bool taken;
    if (!is_taken(ctx, w, row, scratch, &taken))
        return error_memory(error);
    p->state[row] = PATTERN_WAITING;
    if (taken)
        return FRAM_OK;
    fram_status status = feeding_make_floe(ctx, o, w, row, feeding_outline(w, row), error);
    if (status != FRAM_OK)
        return status;
    p->state[row] = PATTERN_INSIDE;
    w->feeding->entered[0] += w->bodies->mass[p->body[row]];
    w->feeding->entered_area[0] += p->area[row];
    w->feeding->entered_floes[0]++;
    return FRAM_OK;
}

static void hold_back(const feeding_world *w, int32_t row, pattern_state state)
{
    const pattern_table *p = w->pattern;
    w->feeding->held_back[0] += p->material[row].density * p->area[row] * p->thickness[row];
    w->feeding->held_back_floes[0]++;
    p->state[row] = (uint8_t)state;
}

/* What becomes of a floe of the pattern as the sheet carries it over the edge of the window, either way. */
static fram_status look_at_row(context *ctx, overlay *o, const feeding_world *w, int32_t row, vec2_array scratch[2],
                               fram_error *error)
{
    pattern_table *p = w->pattern;
    vec2 place = feeding_place(w, row);
    double radius = p->radius[row];
    bool reaches = feeding_reaches(w, place, radius, 0);
    switch ((pattern_state)p->state[row]) {
    case PATTERN_OUTSIDE:
        if (!reaches)
            return FRAM_OK;
        if (feeding_lives(w, row)) {
            p->state[row] = PATTERN_INSIDE; /* it was pushed farther in than the sheet went out */
            return FRAM_OK;
        }
        return try_to_enter(ctx, o, w, row, scratch, error);
    case PATTERN_WAITING:
        if (!reaches)
            hold_back(w, row, PATTERN_OUTSIDE);
        else if (depth_inside(w->feeding, place) >= radius)
            hold_back(w, row, PATTERN_HELD_BACK); /* ice does not appear in the middle of the window */
        else
            return try_to_enter(ctx, o, w, row, scratch, error);
        return FRAM_OK;
    case PATTERN_INSIDE:
    case PATTERN_HELD_BACK:
        if (!feeding_reaches(w, place, radius, clear_distance(w)))
            p->state[row] = PATTERN_OUTSIDE;
        return FRAM_OK;
    }
    return FRAM_OK;
}

/* What places may be off by for rounding, as a part of the tile. */
static const double PLACE_ROUNDING = 1e-6;

/* The list is made anew when the sheet has moved on by the width of the band, so that the whole pattern is walked once
   in so many steps.  Where a floe changes to the other side of the window it is as far from it there. */
static bool list_near(context *ctx, const feeding_world *w, vec2 by)
{
    const feeding_table *f = w->feeding;
    feeding_near *near = w->near;
    near->way += fabs(by.x) + fabs(by.y);
    if (near->is_known && near->way <= f->band[0])
        return true;
    near->is_known = false;
    array_clear(&near->row);
    double margin = f->band[0] + PLACE_ROUNDING * (f->tile[0].x + f->tile[0].y);
    for (int32_t row = 0; row < w->pattern->count; row++) {
        bool concerned = w->pattern->state[row] != PATTERN_OUTSIDE || feeding_lives(w, row) ||
                         feeding_reaches(w, feeding_place(w, row), w->pattern->radius[row], margin);
        if (concerned && !array_push(ctx, &near->row, row))
            return false;
    }
    near->way = 0;
    near->is_known = true;
    return true;
}

fram_status feeding_step(context *ctx, overlay *o, const feeding_world *w, double dt, fram_error *error)
{
    if (w->feeding->count == 0)
        return FRAM_OK;
    feeding_table *f = w->feeding;
    vec2 before = f->displacement[0], by = vec2_scale(f->velocity[0], dt), moved = vec2_add(before, by);
    f->displacement[0] = vec2_make(wrap(moved.x, f->tile[0].x), wrap(moved.y, f->tile[0].y));
    sort_floes(w);
    if (!list_near(ctx, w, by))
        return error_memory(error);
    vec2_array scratch[2] = {{0}, {0}};
    fram_status status = feeding_copies_step(ctx, w, before, by, error);
    for (int32_t i = 0; i < w->near->row.count && status == FRAM_OK; i++)
        status = look_at_row(ctx, o, w, w->near->row.data[i], scratch, error);
    array_free(ctx, &scratch[0]);
    array_free(ctx, &scratch[1]);
    return status;
}
