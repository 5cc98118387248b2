/* Level ice of a scenario, held or drifting; see build_level.h. */
#include "sim/build_level.h"

#include "base/transcendental.h"
#include "ice/tiles.h"
#include "sim/build_ice.h"
#include "sim/build_keep_out.h"

#include <math.h>

/* Tiles of five to ten breaking radii: R_bending is 0.2 to 0.4 of the characteristic length under the loads that break
   (a/l of 0.01 to 0.05; docs/theory.md). */
static const double TILE_LENGTHS = 2;

static box2 sheet_plan(const scenario *s)
{
    const scenario_level *l = &s->ice.level;
    return (box2){{automatic_or(l->x_min, s->domain.x_min), automatic_or(l->y_min, s->domain.y_min)},
                  {automatic_or(l->x_max, s->domain.x_max), automatic_or(l->y_max, s->domain.y_max)}};
}

static double tile_size(const scenario *s)
{
    ice_material ice = build_ice_material(s);
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
        tile_grid drifting = drift_grid_over(domain_box(&s->domain), tile_size(s));
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

void build_opening_corners(const scenario_opening *o, vec2 corner[4])
{
    double x = o->length / 2, y = o->width / 2, angle = radians(o->angle_deg);
    const vec2 own[4] = {{-x, -y}, {x, -y}, {x, y}, {-x, y}};
    for (int k = 0; k < 4; k++)
        corner[k] = (vec2){o->x + real_cos(angle) * own[k].x - real_sin(angle) * own[k].y,
                           o->y + real_sin(angle) * own[k].x + real_cos(angle) * own[k].y};
}

static bool push_openings(context *ctx, const scenario *s, polygon_list *out)
{
    for (int32_t i = 0; i < s->ice.level.openings.count; i++) {
        vec2 corner[4];
        build_opening_corners(&s->ice.level.openings.data[i], corner);
        if (!polygon_list_push(ctx, out, (polygon){corner, 4}))
            return false;
    }
    return true;
}

/* The vessels' footprints with their margin, and what the scenario opens. */
static fram_status find_openings(context *ctx, const scenario *s, const world *w, polygon_list *out, fram_error *error)
{
    fram_status status = build_wide_footprints(ctx, s, w, s->ice.thickness, out, error);
    if (status == FRAM_OK && !push_openings(ctx, s, out))
        status = error_memory(error);
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
    return (floe_definition){.material = build_ice_material(s),
                             .breakable = s->ice.breakable,
                             .motion = kind,
                             .thickness = s->ice.thickness,
                             .elevation = build_ice_elevation(s, s->ice.thickness),
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

static double box_area(box2 b) { return fmax(0, b.hi.x - b.lo.x) * fmax(0, b.hi.y - b.lo.y); }

static double area_inside(polygon p, box2 b)
{
    const vec2 corner[4] = {b.lo, {b.hi.x, b.lo.y}, b.hi, {b.lo.x, b.hi.y}};
    return polygon_overlap_area(p, (polygon){corner, 4});
}

/* Of the ice inside `plan`: tiles of a sheet that drifts reach out of the domain. */
static field_report level_report(const polygon_list *outlines, box2 plan)
{
    double area = 0, whole = box_area(plan);
    for (int32_t i = 0; i < polygon_list_count(outlines); i++)
        area += area_inside(polygon_list_get(outlines, i), plan);
    return (field_report){.floes = polygon_list_count(outlines), .concentration = area / whole, .free_area = whole};
}

/* Openings beside the ice open nothing; ice that they leave nothing of is a slip. */
static fram_status check_openings(context *ctx, const scenario *s, box2 plan, const polygon_list *openings,
                                  const polygon_list *outlines, fram_error *error)
{
    int32_t count = s->ice.level.openings.count, others = polygon_list_count(openings) - count;
    for (int32_t i = 0; i < count; i++)
        if (!(area_inside(polygon_list_get(openings, others + i), plan) > 0))
            log_write(ctx, LOG_WARNING, "ice.level.openings[%d]: it lies beside the ice and opens nothing", (int)i);
    if (polygon_list_count(outlines) > 0)
        return FRAM_OK;
    return error_set(error, FRAM_ERROR_INPUT, NULL, 0, count > 0 ? "ice.level.openings" : "ice.level",
                     "nothing is left of the sheet of %.4g m by %.4g m beside %s", plan.hi.x - plan.lo.x,
                     plan.hi.y - plan.lo.y, count > 0 ? "its openings and the vessels" : "the vessels");
}

fram_status build_level(context *ctx, const scenario *s, world *w, field_report *report, fram_error *error)
{
    tile_grid g = build_tiles(s);
    polygon_list openings = {0}, outlines = {0};
    int32_array cells = {0};
    fram_status status = find_openings(ctx, s, w, &openings, error);
    if (status == FRAM_OK)
        status = tile_sheet(ctx, &g, w->scratch.plane, &openings, s->ice.smallest_floe_area, &outlines, &cells, error);
    if (status == FRAM_OK)
        status = check_openings(ctx, s, g.plan, &openings, &outlines, error);
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

/* What openings leave of a sheet. */
static fram_status ice_area(context *ctx, box2 extent, const polygon_list *openings, double *area, fram_error *error)
{
    const tile_grid one_cell = tile_grid_over(extent, HUGE_VAL);
    polygon_list left = {0};
    int32_array cells = {0};
    overlay *plane = overlay_create(ctx);
    if (!plane)
        return error_memory(error);
    fram_status status = tile_sheet(ctx, &one_cell, plane, openings, 0, &left, &cells, error);
    *area = 0;
    for (int32_t i = 0; i < polygon_list_count(&left); i++)
        *area += polygon_area(polygon_list_get(&left, i));
    polygon_list_free(ctx, &left);
    array_free(ctx, &cells);
    overlay_free(plane);
    return status;
}

box2 build_sheet_extent(const scenario *s)
{
    const scenario_level *l = &s->ice.level;
    return (box2){{automatic_or(l->x_min, -HUGE_VAL), automatic_or(l->y_min, -HUGE_VAL)},
                  {automatic_or(l->x_max, HUGE_VAL), automatic_or(l->y_max, HUGE_VAL)}};
}

static box2 box_common(box2 a, box2 b)
{
    return (box2){{fmax(a.lo.x, b.lo.x), fmax(a.lo.y, b.lo.y)}, {fmin(a.hi.x, b.hi.x), fmin(a.hi.y, b.hi.y)}};
}

double build_ice_in_domain(const scenario *s)
{
    box2 domain = domain_box(&s->domain), extent = build_sheet_extent(s), part = box_common(extent, domain);
    bool there = box_area(part) > 0;
    double area = there ? box_area(part) : fmin(box_area(domain), box_area(extent));
    for (int32_t i = 0; there && i < s->ice.level.openings.count; i++) {
        vec2 corner[4];
        build_opening_corners(&s->ice.level.openings.data[i], corner);
        area -= area_inside((polygon){corner, 4}, part);
    }
    return fmax(area, 0) * s->ice.thickness * s->ice.density;
}

/* Area of a floe with four edges, less its openings; of a sheet that lacks one, that of a domain full of ice: more of
   it comes in, and the first contact would throw back a strip that is in the domain at the start. */
static fram_status find_sheet_area(context *ctx, const scenario *s, box2 extent, const polygon_list *openings,
                                   double *area, fram_error *error)
{
    *area = box_area(extent);
    if (!isfinite(*area)) {
        *area = box_area(domain_box(&s->domain));
        return FRAM_OK;
    }
    if (*area > 0 && polygon_list_count(openings) > 0) {
        fram_status status = ice_area(ctx, extent, openings, area, error);
        if (status != FRAM_OK)
            return status;
    }
    if (!(*area > 0))
        return error_set(error, FRAM_ERROR_INPUT, NULL, 0, "ice.level.openings",
                         "nothing is left of the sheet of %.4g m by %.4g m beside its openings",
                         extent.hi.x - extent.lo.x, extent.hi.y - extent.lo.y);
    return FRAM_OK;
}

/* 0: nothing asks for it, since the sheet drifts whatever it meets and has no end. */
static fram_status find_sheet_mass(context *ctx, const scenario *s, box2 extent, const polygon_list *openings,
                                   double *mass, fram_error *error)
{
    double area = 0;
    fram_status status = FRAM_OK;
    bool floe = isfinite(box_area(extent)), asked = !is_automatic(s->ice.level.line_load);
    if (is_automatic(s->ice.level.mass) && (floe || asked))
        status = find_sheet_area(ctx, s, extent, openings, &area, error);
    *mass = automatic_or(s->ice.level.mass, area * s->ice.thickness * s->ice.density);
    return status;
}

fram_status build_sheet(context *ctx, const scenario *s, drift_definition *out, fram_error *error)
{
    if (s->ice.source != ICE_LEVEL || s->domain.boundary != DOMAIN_FEEDING)
        return FRAM_OK;
    box2 extent = build_sheet_extent(s);
    *out = (drift_definition){.drifts = true,
                              .window = domain_box(&s->domain),
                              .extent = extent,
                              .ice = tile_definition(s, MOTION_CARRIED),
                              .smallest = s->ice.smallest_floe_area,
                              .smallest_piece = s->ice.smallest_piece_area,
                              .line_load = automatic_or(s->ice.level.line_load, HUGE_VAL)};
    if (!push_openings(ctx, s, &out->openings))
        return error_memory(error);
    fram_status status = find_sheet_mass(ctx, s, extent, &out->openings, &out->mass, error);
    out->bounded = isfinite(box_area(extent));
    return status;
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
    *report = level_report(&outlines, m->sheet.window);
    polygon_list_free(ctx, &first.openings);
    polygon_list_free(ctx, &outlines);
    array_free(ctx, &cells);
    return status;
}
