#include "sim/build_ice.h"

#include "base/transcendental.h"
#include "geometry/box_pairs.h"
#include "geometry/space_curve.h"
#include "ice/crowd.h"
#include "sim/build_level.h"
#include "sim/draw_ice.h"
#include "vessel/hull_plan.h"

#include <math.h>
#include <stdio.h>

ice_material build_ice_material(const scenario *s)
{
    const scenario_ice *i = &s->ice;
    return (ice_material){.density = i->density,
                          .elastic_modulus = i->elastic_modulus,
                          .poisson_ratio = i->poisson_ratio,
                          .flexural_strength = i->flexural_strength,
                          .crushing_strength = i->crushing_strength,
                          .crushing_exponent = i->crushing_exponent};
}

double build_ice_elevation(const scenario *s, double thickness)
{
    return s->environment.water ? floe_floating_elevation(thickness, s->ice.density, s->environment.water_density) : 0;
}

build_slab build_slab_of_ice(const scenario *s, double thickness)
{
    double middle = build_ice_elevation(s, thickness);
    return (build_slab){middle - 0.5 * thickness, middle + 0.5 * thickness};
}

/* Plan points of the part of one triangle in a slab. */
static bool add_triangle(context *ctx, const vec3 corner[3], build_slab slab, vec2_array *points)
{
    vec3 low[4], part[5];
    int count = triangle_clip_below(corner, slab.high, low);
    count = facet_clip(low, count, vec3_make(0, 0, -1), -slab.low, part);
    bool good = true;
    for (int i = 0; i < count && good; i++)
        good = array_push(ctx, points, vec2_make(part[i].x, part[i].y));
    return good;
}

static fram_status footprint_in(context *ctx, const world *w, int32_t body, build_slab slab, vec2_array *out,
                                fram_error *error)
{
    const mesh *m = &shape_solid(&w->shapes, w->bodies.shape[body])->surface;
    vec2_array points = {0};
    bool good = true;
    for (int32_t i = 0; good && i < m->face.count; i++) {
        vec3 corner[3];
        for (int k = 0; k < 3; k++)
            corner[k] = body_to_global(&w->bodies, body, m->vertex.data[m->face.data[i].v[k]]);
        good = add_triangle(ctx, corner, slab, &points);
    }
    good = good && polygon_convex_hull(ctx, (polygon){points.data, points.count}, out);
    array_free(ctx, &points);
    return good ? FRAM_OK : error_memory(error);
}

fram_status build_footprint(context *ctx, const world *w, int32_t body, bool below_water, vec2_array *out,
                            fram_error *error)
{
    return footprint_in(ctx, w, body, below_water ? (build_slab){-HUGE_VAL, 0} : build_slab_all(), out, error);
}

/* Part of a footprint that its pieces must leave open for them to be told apart. */
#define OPEN_PART 0.01

/* Plan points of the part of a convex piece of a hull in a slab. */
static bool add_hull_piece(context *ctx, const world *w, int32_t body, const polyhedron *p, build_slab slab,
                           vec2_array *points)
{
    bool good = true;
    for (int32_t f = 0; f < p->face.count; f++) {
        const int32_t *loop = &p->loop.data[p->face.data[f].first];
        for (int32_t k = 2; good && k < p->face.data[f].count; k++) {
            vec3 corner[3] = {p->vertex.data[loop[0]], p->vertex.data[loop[k - 1]], p->vertex.data[loop[k]]};
            for (int i = 0; i < 3; i++)
                corner[i] = body_to_global(&w->bodies, body, corner[i]);
            good = add_triangle(ctx, corner, slab, points);
        }
    }
    return good;
}

/* Plan outlines of all convex pieces, those one above the other too. */
static bool add_pieces(context *ctx, const world *w, int32_t body, build_slab slab, polygon_list *out)
{
    const polyhedron_array *pieces = &shape_solid(&w->shapes, w->bodies.shape[body])->pieces;
    vec2_array points = {0}, outline = {0};
    bool good = true;
    for (int32_t i = 0; good && i < pieces->count; i++) {
        points.count = 0;
        good = add_hull_piece(ctx, w, body, &pieces->data[i], slab, &points) &&
               polygon_convex_hull(ctx, (polygon){points.data, points.count}, &outline);
        polygon part = {outline.data, outline.count};
        if (good && part.count >= 3 && overlay_is_valid(w->scratch.plane, part, NULL, NULL))
            good = polygon_list_push(ctx, out, part);
    }
    array_free(ctx, &points);
    array_free(ctx, &outline);
    return good;
}

fram_status build_plan(context *ctx, const world *w, int32_t body, build_slab slab, polygon_list *out,
                       fram_error *error)
{
    vec2_array footprint = {0};
    polygon_list parts = {0}, together = {0};
    fram_error unused;
    fram_status status = footprint_in(ctx, w, body, slab, &footprint, error);
    polygon whole = {footprint.data, footprint.count};
    if (status == FRAM_OK && whole.count >= 3 && !add_pieces(ctx, w, body, slab, &parts))
        status = error_memory(error);
    /* Where no union is found, the outline alone is right, if larger. */
    if (status == FRAM_OK && polygon_list_count(&parts) > 1 &&
        hull_plan_unite(ctx, w->scratch.plane, &parts, &together, &unused) == FRAM_ERROR_MEMORY)
        status = error_memory(error);
    double area = build_plan_area(&together);
    bool apart = area > 0 && area < (1 - OPEN_PART) * polygon_area(whole), good = status == FRAM_OK;
    for (int32_t i = 0; good && apart && i < polygon_list_count(&together); i++)
        good = polygon_list_push(ctx, out, polygon_list_get(&together, i));
    if (good && !apart && whole.count >= 3)
        good = polygon_list_push(ctx, out, whole);
    array_free(ctx, &footprint);
    polygon_list_free(ctx, &parts);
    polygon_list_free(ctx, &together);
    return status == FRAM_OK && !good ? error_memory(error) : status;
}

double build_plan_area(const polygon_list *plan)
{
    double area = 0;
    for (int32_t i = 0; i < polygon_list_count(plan); i++)
        area += polygon_area(polygon_list_get(plan, i));
    return area;
}

double build_plan_overlap(const polygon_list *plan, polygon outline)
{
    double common = 0;
    for (int32_t i = 0; i < polygon_list_count(plan); i++)
        common += polygon_overlap_area(polygon_list_get(plan, i), outline);
    return common;
}

/* Outlines along a space-filling curve: neighbours in the water become neighbours in memory.  NULL: no memory. */
static int32_t *memory_order(context *ctx, const polygon_list *outlines)
{
    int32_t count = polygon_list_count(outlines);
    vec2 *place = memory_array(ctx, (size_t)count + 1, sizeof *place);
    int32_t *order = memory_array(ctx, (size_t)count + 1, sizeof *order);
    for (int32_t i = 0; place && i < count; i++)
        place[i] = polygon_list_get(outlines, i).vertex[0];
    if (!place || !order || !space_curve_order(ctx, place, count, order)) {
        memory_free(ctx, order);
        order = NULL;
    }
    memory_free(ctx, place);
    return order;
}

static fram_status add_drawn_floes(context *ctx, const scenario *s, world *w, const drawn_ice *drawn, fram_error *error)
{
    const polygon_list *outlines = &drawn->outlines;
    floe_definition d = {.material = build_ice_material(s), .motion = MOTION_DYNAMIC, .parent = -1};
    int32_t *order = memory_order(ctx, outlines);
    fram_status status = order ? FRAM_OK : error_memory(error);
    for (int32_t i = 0; i < polygon_list_count(outlines) && status == FRAM_OK; i++) {
        int32_t row;
        status = work_continue(ctx, "making the floes", i, polygon_list_count(outlines), error);
        if (status != FRAM_OK)
            break;
        floe_traits t = drawn->traits.data[order[i]];
        d.outline = polygon_list_get(outlines, order[i]);
        d.thickness = t.thickness;
        d.material.flexural_strength = t.flexural_strength;
        d.material.crushing_strength = t.crushing_strength;
        d.breakable = t.breakable;
        d.elevation = build_ice_elevation(s, d.thickness);
        status = floe_create(ctx, &d, s->ice.smallest_piece_area, w->scratch.plane, &w->bodies, &w->shapes, &w->floes,
                             &w->clock.next_floe[0], &row, error);
    }
    memory_free(ctx, order);
    return status;
}

static fram_status build_drawn(context *ctx, const scenario *s, world *w, field_report *report, fram_error *error)
{
    drawn_ice drawn = {0};
    fram_status status = draw_ice(ctx, s, w, &drawn, error);
    if (status == FRAM_OK)
        status = add_drawn_floes(ctx, s, w, &drawn, error);
    *report = drawn.report;
    drawn_ice_free(ctx, &drawn);
    return status;
}

/* ---- single floes ---- */

enum { SINGLE_FLOE_VERTICES = 64 };

/* Outline about the origin, unturned. */
static int32_t single_outline(const scenario_floe *f, vec2 out[SINGLE_FLOE_VERTICES])
{
    if (f->shape == FLOE_RECTANGLE) {
        double x = f->length / 2, y = f->width / 2;
        out[0] = vec2_make(-x, -y), out[1] = vec2_make(x, -y), out[2] = vec2_make(x, y), out[3] = vec2_make(-x, y);
        return 4;
    }
    for (int64_t i = 0; i < f->sides; i++) {
        double angle = 2 * PI * (double)i / (double)f->sides;
        out[i] = vec2_make(f->radius * real_cos(angle), f->radius * real_sin(angle));
    }
    return (int32_t)f->sides;
}

static fram_status add_single_floe(context *ctx, const scenario *s, world *w, const scenario_floe *f, fram_error *error)
{
    vec2 outline[SINGLE_FLOE_VERTICES];
    int32_t count = single_outline(f, outline), row = -1;
    double yaw = radians(f->yaw_deg), c = real_cos(yaw), sn = real_sin(yaw);
    for (int32_t i = 0; i < count; i++) {
        vec2 p = outline[i];
        outline[i] = vec2_make(f->x + c * p.x - sn * p.y, f->y + sn * p.x + c * p.y);
    }
    double thickness = automatic_or(f->thickness, s->ice.thickness);
    floe_definition d = {.outline = {outline, count},
                         .thickness = thickness,
                         .material = build_ice_material(s),
                         .breakable = s->ice.breakable,
                         .motion = f->fixed ? MOTION_STATIC : MOTION_DYNAMIC,
                         .elevation = automatic_or(f->elevation, build_ice_elevation(s, thickness)),
                         .yaw = yaw,
                         .parent = -1};
    fram_status status = floe_create(ctx, &d, s->ice.smallest_piece_area, w->scratch.plane, &w->bodies, &w->shapes,
                                     &w->floes, &w->clock.next_floe[0], &row, error);
    if (status != FRAM_OK)
        return status;
    int32_t body = w->floes.body[row];
    w->bodies.orientation[body] = quat_from_roll_pitch_yaw(radians(f->roll_deg), radians(f->pitch_deg), yaw);
    if (f->fixed)
        return FRAM_OK;
    w->bodies.velocity[body] = vec3_make(f->velocity_x, f->velocity_y, f->velocity_z);
    w->bodies.angular_velocity[body] = vec3_make(0, 0, f->spin);
    return FRAM_OK;
}

/* Part of the smaller floe that lies in another one from which on a reader is told. */
#define OVERLAP_TOLD 1e-3

/* Pairs that were found so far, and the first of those that overlap. */
typedef struct crowd_search {
    const world *w;
    int64_t pairs, overlaps;
    int32_t first, second;
    double area; /* of those two in common [m2] */
} crowd_search;

/* Outline of a listed floe in the global plan, as it lies. */
static polygon plan_of_floe(const world *w, int32_t floe, vec2 out[SINGLE_FLOE_VERTICES])
{
    int32_t body = w->floes.body[floe];
    polygon p = shape_outline(&w->shapes, w->bodies.shape[body]);
    for (int32_t k = 0; k < p.count; k++) {
        vec3 at = body_to_global(&w->bodies, body, vec3_make(p.vertex[k].x, p.vertex[k].y, 0));
        out[k] = (vec2){at.x, at.y};
    }
    return (polygon){out, p.count};
}

static void note_overlap(crowd_search *c, int32_t a, int32_t b)
{
    const floe_table *f = &c->w->floes;
    vec2 corner[2][SINGLE_FLOE_VERTICES];
    double area = polygon_overlap_area(plan_of_floe(c->w, a, corner[0]), plan_of_floe(c->w, b, corner[1]));
    if (!(area > OVERLAP_TOLD * fmin(f->area[a], f->area[b])))
        return;
    if (c->overlaps++ == 0) {
        c->first = a < b ? a : b;
        c->second = a < b ? b : a;
        c->area = area;
    }
}

static void tell_overlaps(context *ctx, const crowd_search *c)
{
    if (c->overlaps > 0)
        log_write(ctx, LOG_WARNING,
                  "%lld pairs of floes overlap at the start, as ice.floes[%d] and ice.floes[%d], by %.4g m2: what "
                  "crushes stays in one another, the rest is pushed apart",
                  (long long)c->overlaps, (int)c->first, (int)c->second, c->area);
}

/* A listed floe that reaches over a wall. */
static void tell_walls(context *ctx, const scenario *s, const box2 *box, int32_t count)
{
    const scenario_domain *d = &s->domain;
    for (int32_t i = 0; i < count && d->boundary == DOMAIN_WALLS; i++)
        if (box[i].lo.x < d->x_min || box[i].lo.y < d->y_min || box[i].hi.x > d->x_max || box[i].hi.y > d->y_max) {
            log_write(ctx, LOG_WARNING, "ice.floes[%d] reaches into a wall of the domain at the start", (int)i);
            return;
        }
}

static fram_status count_pair(void *user, int32_t a, int32_t b, fram_error *error)
{
    crowd_search *c = user;
    const floe_table *f = &c->w->floes;
    double rise = fabs(c->w->bodies.position[f->body[a]].z - c->w->bodies.position[f->body[b]].z);
    if (rise >= 0.5 * (f->thickness[a] + f->thickness[b]))
        return FRAM_OK; /* one above the other */
    note_overlap(c, a, b);
    return ++c->pairs > crowd_most_pairs(f->count) ? crowd_refuse(NULL, f->count, error) : FRAM_OK;
}

/* Floes that all lie in one place end here, and not by memory and time in the first step. */
static fram_status check_crowd(context *ctx, const scenario *s, const world *w, fram_error *error)
{
    crowd_search c = {.w = w};
    int32_t count = w->floes.count;
    box2 *box = memory_array(ctx, (size_t)count, sizeof *box);
    if (!box)
        return error_memory(error);
    for (int32_t i = 0; i < count; i++) {
        vec2 corner[SINGLE_FLOE_VERTICES];
        box[i] = polygon_bounds(plan_of_floe(w, i, corner));
    }
    fram_status status = box_pairs(ctx, box, count, "looking for overlaps", count_pair, &c, error);
    if (status == FRAM_OK) {
        tell_overlaps(ctx, &c);
        tell_walls(ctx, s, box, count);
    }
    memory_free(ctx, box);
    if (status == FRAM_ERROR_INPUT && error) {
        snprintf(error->key, sizeof error->key, "ice.floes");
        scenario_locate(s, error);
    }
    return status;
}

fram_status build_ice(context *ctx, const scenario *s, world *w, field_report *report, fram_error *error)
{
    if (scenario_ice_is_field(&s->ice))
        return build_drawn(ctx, s, w, report, error);
    if (s->ice.source == ICE_LEVEL)
        return build_level(ctx, s, w, report, error);
    if (s->ice.source == ICE_NONE)
        return FRAM_OK;
    for (int32_t i = 0; i < s->ice.floes.count; i++) {
        fram_status status = add_single_floe(ctx, s, w, &s->ice.floes.data[i], error);
        if (status != FRAM_OK)
            return status;
    }
    report->floes = s->ice.floes.count;
    return check_crowd(ctx, s, w, error);
}
