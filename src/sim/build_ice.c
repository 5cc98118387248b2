#include "sim/build_ice.h"

#include "base/transcendental.h"
#include "geometry/box_pairs.h"
#include "geometry/space_curve.h"
#include "ice/crowd.h"
#include "ice/tiles.h"
#include "sim/build_keep_out.h"
#include "sim/draw_ice.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static ice_material material_of(const scenario *s)
{
    const scenario_ice *i = &s->ice;
    return (ice_material){.density = i->density,
                          .elastic_modulus = i->elastic_modulus,
                          .poisson_ratio = i->poisson_ratio,
                          .flexural_strength = i->flexural_strength,
                          .crushing_strength = i->crushing_strength,
                          .crushing_exponent = i->crushing_exponent};
}

static double floating_elevation(const scenario *s, double thickness)
{
    return s->environment.water ? floe_floating_elevation(thickness, s->ice.density, s->environment.water_density) : 0;
}

/* Plan points of one triangle, or of its part below still water. */
static bool add_triangle(context *ctx, const vec3 corner[3], bool below_water, vec2_array *points)
{
    vec3 part[4];
    int count = 3;
    if (below_water)
        count = triangle_clip_below(corner, 0, part);
    else
        memcpy(part, corner, 3 * sizeof *part);
    bool good = true;
    for (int i = 0; i < count && good; i++)
        good = array_push(ctx, points, vec2_make(part[i].x, part[i].y));
    return good;
}

fram_status build_footprint(context *ctx, const world *w, int32_t body, bool below_water, vec2_array *out,
                            fram_error *error)
{
    const mesh *m = &shape_solid(&w->shapes, w->bodies.shape[body])->surface;
    vec2_array points = {0};
    bool good = true;
    for (int32_t i = 0; good && i < m->face.count; i++) {
        vec3 corner[3];
        for (int k = 0; k < 3; k++)
            corner[k] = body_to_global(&w->bodies, body, m->vertex.data[m->face.data[i].v[k]]);
        good = add_triangle(ctx, corner, below_water, &points);
    }
    good = good && polygon_convex_hull(ctx, (polygon){points.data, points.count}, out);
    array_free(ctx, &points);
    return good ? FRAM_OK : error_memory(error);
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
    floe_definition d = {.material = material_of(s), .motion = MOTION_DYNAMIC, .parent = -1};
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
        d.elevation = floating_elevation(s, d.thickness);
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

/* ---- level ice ---- */

/* Tiles of about four breaking radii: R_bending is about half the characteristic length under the loads that break
   (a/l near 0.1; docs/theory.md). */
static const double TILE_LENGTHS = 2;

static box2 sheet_plan(const scenario *s)
{
    const scenario_level *l = &s->ice.level;
    return (box2){{automatic_or(l->x_min, s->domain.x_min), automatic_or(l->y_min, s->domain.y_min)},
                  {automatic_or(l->x_max, s->domain.x_max), automatic_or(l->y_max, s->domain.y_max)}};
}

static double tile_size(const scenario *s)
{
    ice_material ice = material_of(s);
    double length =
        ice_characteristic_length(&ice, s->ice.thickness, s->environment.water_density, s->environment.gravity);
    return automatic_or(s->ice.level.tile_size, TILE_LENGTHS * length);
}

double build_tile_number(const scenario *s)
{
    if (s->domain.boundary == DOMAIN_FEEDING) {
        tile_grid g = build_tiles(s);
        return (double)g.columns * g.rows;
    }
    box2 plan = sheet_plan(s);
    double size = tile_size(s);
    return fmax((plan.hi.x - plan.lo.x) / size, 1) * fmax((plan.hi.y - plan.lo.y) / size, 1);
}

tile_grid build_tiles(const scenario *s)
{
    const scenario_level *l = &s->ice.level;
    if (s->ice.source != ICE_LEVEL)
        return (tile_grid){.columns = 0};
    if (s->domain.boundary == DOMAIN_FEEDING) {
        tile_grid drifting = drift_grid_over(
            (box2){{s->domain.x_min, s->domain.y_min}, {s->domain.x_max, s->domain.y_max}}, tile_size(s));
        drifting.least_seam = s->ice.edge_threshold;
        return drifting;
    }
    tile_grid g = tile_grid_over(sheet_plan(s), tile_size(s));
    g.anchored[SHEET_X_MIN] = l->anchored_x_min;
    g.anchored[SHEET_X_MAX] = l->anchored_x_max;
    g.anchored[SHEET_Y_MIN] = l->anchored_y_min;
    g.anchored[SHEET_Y_MAX] = l->anchored_y_max;
    g.least_seam = s->ice.edge_threshold;
    return g;
}

static bool push_openings(context *ctx, const scenario *s, polygon_list *out)
{
    for (int32_t i = 0; i < s->ice.level.openings.count; i++) {
        const scenario_opening *o = &s->ice.level.openings.data[i];
        double x = o->length / 2, y = o->width / 2, angle = radians(o->angle_deg);
        vec2 corner[4] = {{-x, -y}, {x, -y}, {x, y}, {-x, y}};
        for (int k = 0; k < 4; k++)
            corner[k] = (vec2){o->x + real_cos(angle) * corner[k].x - real_sin(angle) * corner[k].y,
                               o->y + real_sin(angle) * corner[k].x + real_cos(angle) * corner[k].y};
        if (!polygon_list_push(ctx, out, (polygon){corner, 4}))
            return false;
    }
    return true;
}

/* The vessels' footprints with their margin, and what the scenario opens. */
static fram_status find_openings(context *ctx, const scenario *s, const world *w, polygon_list *out, fram_error *error)
{
    polygon_list footprints = {0};
    vec2_array wide = {0};
    fram_status status = build_footprints(ctx, w, &footprints, error);
    for (int32_t i = 0; i < polygon_list_count(&footprints) && status == FRAM_OK; i++) {
        vec2_array corners = {0};
        polygon p = polygon_list_get(&footprints, i);
        double m = s->ice.keep_out_margin;
        const vec2 shift[4] = {{-m, -m}, {m, -m}, {m, m}, {-m, m}};
        bool good = true;
        for (int32_t k = 0; k < p.count && good; k++)
            for (int n = 0; n < 4 && good; n++)
                good = array_push(ctx, &corners, vec2_add(p.vertex[k], shift[n]));
        good = good && polygon_convex_hull(ctx, (polygon){corners.data, corners.count}, &wide) &&
               polygon_list_push(ctx, out, (polygon){wide.data, wide.count});
        array_free(ctx, &corners);
        status = good ? FRAM_OK : error_memory(error);
    }
    if (status == FRAM_OK && !push_openings(ctx, s, out))
        status = error_memory(error);
    polygon_list_free(ctx, &footprints);
    array_free(ctx, &wide);
    return status;
}

static fram_status mark_seams(context *ctx, const tile_grid *g, world *w, fram_error *error)
{
    tile_index index = {0};
    bool good = tile_index_build(ctx, &index, g, &w->floes);
    tile_sheet_view v = {g, &index, &w->bodies, &w->shapes, &w->floes};
    if (good)
        tile_mark_seams(&v, &w->shapes, (tile_range){0, g->columns - 1, 0, g->rows - 1});
    tile_index_free(ctx, &index);
    return good ? FRAM_OK : error_memory(error);
}

static floe_definition tile_definition(const scenario *s, motion kind)
{
    return (floe_definition){.material = material_of(s),
                             .breakable = s->ice.breakable,
                             .motion = kind,
                             .thickness = s->ice.thickness,
                             .elevation = floating_elevation(s, s->ice.thickness),
                             .parent = -1};
}

static fram_status make_tiles(context *ctx, const scenario *s, floe_definition d, const polygon_list *outlines,
                              const int32_array *cells, world *w, fram_error *error)
{
    fram_status status = FRAM_OK;
    for (int32_t i = 0; i < polygon_list_count(outlines) && status == FRAM_OK; i++) {
        int32_t row;
        status = work_continue(ctx, "making the floes of the sheet", i, polygon_list_count(outlines), error);
        if (status != FRAM_OK)
            break;
        d.outline = polygon_list_get(outlines, i);
        d.tile = cells->data[i] + 1;
        status = floe_create(ctx, &d, s->ice.smallest_piece_area, w->scratch.plane, &w->bodies, &w->shapes, &w->floes,
                             &w->clock.next_floe[0], &row, error);
    }
    return status;
}

static field_report level_report(const polygon_list *outlines, box2 plan)
{
    double area = 0, whole = (plan.hi.x - plan.lo.x) * (plan.hi.y - plan.lo.y);
    for (int32_t i = 0; i < polygon_list_count(outlines); i++)
        area += polygon_area(polygon_list_get(outlines, i));
    return (field_report){.floes = polygon_list_count(outlines), .concentration = area / whole, .free_area = whole};
}

static fram_status build_level(context *ctx, const scenario *s, world *w, field_report *report, fram_error *error)
{
    tile_grid g = build_tiles(s);
    polygon_list openings = {0}, outlines = {0};
    int32_array cells = {0};
    fram_status status = find_openings(ctx, s, w, &openings, error);
    if (status == FRAM_OK)
        status = tile_sheet(ctx, &g, w->scratch.plane, &openings, s->ice.smallest_floe_area, &outlines, &cells, error);
    if (status == FRAM_OK)
        status = make_tiles(ctx, s, tile_definition(s, MOTION_STATIC), &outlines, &cells, w, error);
    if (status == FRAM_OK)
        status = mark_seams(ctx, &g, w, error);
    *report = level_report(&outlines, g.plan);
    polygon_list_free(ctx, &openings);
    polygon_list_free(ctx, &outlines);
    array_free(ctx, &cells);
    return status;
}

/* ---- level ice that drifts ---- */

static double sheet_mass(const scenario *s, box2 extent)
{
    double area = (extent.hi.x - extent.lo.x) * (extent.hi.y - extent.lo.y);
    return automatic_or(s->ice.level.mass, isfinite(area) ? area * s->ice.thickness * s->ice.density : 0);
}

fram_status build_sheet(context *ctx, const scenario *s, drift_definition *out, fram_error *error)
{
    const scenario_level *l = &s->ice.level;
    if (s->ice.source != ICE_LEVEL || s->domain.boundary != DOMAIN_FEEDING)
        return FRAM_OK;
    box2 extent = {{automatic_or(l->x_min, -HUGE_VAL), automatic_or(l->y_min, -HUGE_VAL)},
                   {automatic_or(l->x_max, HUGE_VAL), automatic_or(l->y_max, HUGE_VAL)}};
    double mass = sheet_mass(s, extent);
    *out = (drift_definition){.drifts = true,
                              .window = {{s->domain.x_min, s->domain.y_min}, {s->domain.x_max, s->domain.y_max}},
                              .extent = extent,
                              .ice = tile_definition(s, MOTION_CARRIED),
                              .smallest = s->ice.smallest_floe_area,
                              .smallest_piece = s->ice.smallest_piece_area,
                              .line_load = automatic_or(l->line_load, HUGE_VAL),
                              .mass = mass,
                              .bounded = mass > 0};
    return push_openings(ctx, s, &out->openings) ? FRAM_OK : error_memory(error);
}

fram_status build_drifting(context *ctx, const scenario *s, const model *m, world *w, field_report *report,
                           fram_error *error)
{
    const tile_grid *g = &m->fracture.tiles;
    polygon_list outlines = {0};
    int32_array cells = {0};
    drift_definition first = m->sheet; /* with the water that the vessels lie in */
    first.openings = (polygon_list){0};
    fram_status status = find_openings(ctx, s, w, &first.openings, error);
    for (int32_t cell = 0; cell < g->columns * g->rows && status == FRAM_OK; cell++) {
        status = work_continue(ctx, "making the tiles of the sheet", cell, g->columns * g->rows, error);
        if (status == FRAM_OK)
            status = drift_cell_rings(ctx, &first, g, cell, w->scratch.plane, &outlines, &cells, error);
    }
    if (status == FRAM_OK)
        status = make_tiles(ctx, s, m->sheet.ice, &outlines, &cells, w, error);
    if (status == FRAM_OK)
        status = mark_seams(ctx, g, w, error);
    *report = level_report(&outlines, g->plan);
    polygon_list_free(ctx, &first.openings);
    polygon_list_free(ctx, &outlines);
    array_free(ctx, &cells);
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
                         .material = material_of(s),
                         .breakable = s->ice.breakable,
                         .motion = f->fixed ? MOTION_STATIC : MOTION_DYNAMIC,
                         .elevation = automatic_or(f->elevation, floating_elevation(s, thickness)),
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

/* Pairs that were found so far. */
typedef struct crowd_search {
    const world *w;
    int64_t pairs;
} crowd_search;

static fram_status count_pair(void *user, int32_t a, int32_t b, fram_error *error)
{
    crowd_search *c = user;
    const floe_table *f = &c->w->floes;
    double rise = fabs(c->w->bodies.position[f->body[a]].z - c->w->bodies.position[f->body[b]].z);
    if (rise >= 0.5 * (f->thickness[a] + f->thickness[b]))
        return FRAM_OK; /* one above the other */
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
        int32_t body = w->floes.body[i];
        polygon p = shape_outline(&w->shapes, w->bodies.shape[body]);
        box[i] = (box2){{HUGE_VAL, HUGE_VAL}, {-HUGE_VAL, -HUGE_VAL}};
        for (int32_t k = 0; k < p.count; k++) {
            vec3 at = body_to_global(&w->bodies, body, vec3_make(p.vertex[k].x, p.vertex[k].y, 0));
            box[i] = (box2){{fmin(box[i].lo.x, at.x), fmin(box[i].lo.y, at.y)},
                            {fmax(box[i].hi.x, at.x), fmax(box[i].hi.y, at.y)}};
        }
    }
    fram_status status = box_pairs(ctx, box, count, "looking for overlaps", count_pair, &c, error);
    memory_free(ctx, box);
    if (status == FRAM_ERROR_INPUT && error) {
        snprintf(error->key, sizeof error->key, "ice.floes");
        scenario_locate(s, error);
    }
    return status;
}

fram_status build_ice(context *ctx, const scenario *s, world *w, field_report *report, fram_error *error)
{
    if (s->ice.source == ICE_VORONOI || s->ice.source == ICE_FILE || s->ice.source == ICE_PACKED)
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
