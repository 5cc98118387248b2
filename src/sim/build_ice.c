#include "sim/build_ice.h"

#include "base/transcendental.h"
#include "geometry/space_curve.h"
#include "ice/import.h"
#include "ice/tiles.h"
#include "io/outline_file.h"
#include "sim/build_keep_out.h"
#include "sim/build_packed.h"

#include <math.h>
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
    const mesh *m = &w->shapes.solids.data[w->shapes.shapes.solid[w->bodies.shape[body]]].surface;
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

/* traits: of each outline; NULL for those of the scenario. */
static fram_status add_field_floes(context *ctx, const scenario *s, world *w, const polygon_list *outlines,
                                   const floe_traits *traits, fram_error *error)
{
    floe_definition d = {.material = material_of(s), .motion = MOTION_DYNAMIC, .parent = -1};
    int32_t *order = memory_order(ctx, outlines);
    fram_status status = order ? FRAM_OK : error_memory(error);
    for (int32_t i = 0; i < polygon_list_count(outlines) && status == FRAM_OK; i++) {
        int32_t row;
        floe_traits t = traits ? traits[order[i]] : scenario_traits(s, NAN);
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

static box2 domain_of(const scenario *s)
{
    return (box2){{s->domain.x_min, s->domain.y_min}, {s->domain.x_max, s->domain.y_max}};
}

/* Zones that the field is made without: an endless field is made whole, and cut where it is first seen. */
static fram_status find_keep_out(context *ctx, const scenario *s, const world *w, polygon_list *out, fram_error *error)
{
    return s->domain.boundary == DOMAIN_FEEDING ? FRAM_OK : build_keep_out(ctx, s, w, out, error);
}

static fram_status build_voronoi(context *ctx, const scenario *s, world *w, field_report *report, fram_error *error)
{
    polygon_list keep_out = {0}, outlines = {0};
    fram_status status = find_keep_out(ctx, s, w, &keep_out, error);
    field_request request = {.domain = domain_of(s),
                             .concentration = s->ice.concentration,
                             .mean_area = s->ice.mean_floe_area,
                             .size_deviation = s->ice.size_deviation,
                             .roundness = s->ice.roundness,
                             .seed = (uint64_t)s->run.seed,
                             .smallest_area = s->ice.smallest_floe_area,
                             .keep_out = &keep_out,
                             .periodic = s->domain.boundary == DOMAIN_FEEDING};
    if (status == FRAM_OK)
        status = field_voronoi(ctx, w->scratch.plane, &request, &outlines, report, error);
    if (status == FRAM_OK)
        status = add_field_floes(ctx, s, w, &outlines, NULL, error);
    polygon_list_free(ctx, &keep_out);
    polygon_list_free(ctx, &outlines);
    return status;
}

static fram_status build_packed(context *ctx, const scenario *s, world *w, field_report *report, fram_error *error)
{
    polygon_list keep_out = {0}, outlines = {0};
    floe_traits_array traits = {0};
    fram_status status = find_keep_out(ctx, s, w, &keep_out, error);
    if (status == FRAM_OK)
        status = draw_populations(ctx, s, w, &keep_out, &outlines, &traits, report, error);
    if (status == FRAM_OK)
        status = add_field_floes(ctx, s, w, &outlines, traits.data, error);
    polygon_list_free(ctx, &keep_out);
    polygon_list_free(ctx, &outlines);
    array_free(ctx, &traits);
    return status;
}

/* ---- observed floes ---- */

static void log_notes(context *ctx, const import_rings *rings, const import_field *field)
{
    for (int32_t i = 0; i < field->notes.count; i++) {
        const import_note *n = &field->notes.data[i];
        char name[IMPORT_NAME_SIZE];
        import_place_name(&rings->place.data[n->ring], name);
        log_write(ctx, LOG_DEBUG, "%s (%.6g, %.6g): %s; %s", name, n->at.x, n->at.y, import_event_text(n->event),
                  n->dropped ? "left out" : "mended");
    }
}

/* What became of the file: counts of what was left out and mended, overlaps, concentration. */
static fram_status report_import(context *ctx, const scenario *s, world *w, const polygon_list *keep_out,
                                 const import_field *field, field_report *report, fram_error *error)
{
    import_measure m;
    fram_status status = import_field_measure(ctx, w->scratch.plane, &field->outlines, &m, error);
    if (status != FRAM_OK)
        return status;
    box2 d = domain_of(s);
    const vec2 corner[4] = {d.lo, {d.hi.x, d.lo.y}, d.hi, {d.lo.x, d.hi.y}};
    double free_area = polygon_area((polygon){corner, 4});
    for (int32_t i = 0; i < polygon_list_count(keep_out); i++)
        free_area -= polygon_overlap_area(polygon_list_get(keep_out, i), (polygon){corner, 4});
    *report = (field_report){.floes = m.floes,
                             .concentration = m.area / free_area,
                             .free_area = free_area,
                             .largest_overlap = m.overlap_width};
    int32_t dropped = 0;
    for (int32_t i = 0; i < field->notes.count; i++)
        dropped += field->notes.data[i].dropped;
    log_write(ctx, LOG_INFO, "%d floes from %.200s, %d of them concave; %d rings or pieces left out, %d mended",
              (int)m.floes, s->ice.file, (int)m.concave, (int)dropped, (int)(field->notes.count - dropped));
    if (m.overlaps)
        log_write(
            ctx, LOG_WARNING,
            "%d pairs of floes overlap, by %.3g m at most: they will push each other apart; ice.bad_rings: repair "
            "cuts them apart",
            (int)m.overlaps, m.overlap_width);
    return FRAM_OK;
}

static fram_status build_file(context *ctx, const scenario *s, world *w, field_report *report, fram_error *error)
{
    char path[2 * SCENARIO_TEXT_SIZE];
    if (!scenario_resolve_path(s, s->ice.file, path, sizeof path))
        return error_set(error, FRAM_ERROR_INPUT, NULL, 0, "ice.file", "the path of the floes is too long");
    polygon_list keep_out = {0};
    import_rings rings = {0};
    import_field field = {0};
    floe_traits_array traits = {0};
    const import_options options = {.name = path,
                                    .scale = s->ice.file_scale,
                                    .centre = s->ice.file_centre,
                                    .offset = {s->ice.file_x, s->ice.file_y},
                                    .crop = true,
                                    .domain = domain_of(s),
                                    .simplify = s->ice.simplify,
                                    .bad = s->ice.bad_rings,
                                    .smallest_area = s->ice.smallest_floe_area,
                                    .keep_out = &keep_out};
    fram_status status = find_keep_out(ctx, s, w, &keep_out, error);
    if (status == FRAM_OK)
        status = outline_file_read(ctx, path, &rings, error);
    if (status == FRAM_OK)
        status = import_field_make(ctx, w->scratch.plane, &rings, &options, &field, error);
    if (status == FRAM_OK) {
        log_notes(ctx, &rings, &field);
        status = report_import(ctx, s, w, &keep_out, &field, report, error);
    }
    for (int32_t i = 0; status == FRAM_OK && i < field.thickness.count; i++)
        if (!array_push(ctx, &traits, scenario_traits(s, field.thickness.data[i])))
            status = error_memory(error);
    if (status == FRAM_OK && s->ice.populations.count > 0)
        status = draw_populations(ctx, s, w, &keep_out, &field.outlines, &traits, report, error);
    if (status == FRAM_OK)
        status = add_field_floes(ctx, s, w, &field.outlines, traits.data, error);
    array_free(ctx, &traits);
    import_rings_free(ctx, &rings);
    import_field_free(ctx, &field);
    polygon_list_free(ctx, &keep_out);
    return status;
}

/* ---- level ice ---- */

/* Tiles of about four breaking radii: R_bending is about half the characteristic length under the loads that break
   (oracles section 1, a/l near 0.1). */
static const double TILE_LENGTHS = 2;

tile_grid build_tiles(const scenario *s)
{
    const scenario_level *l = &s->ice.level;
    if (s->ice.source != ICE_LEVEL)
        return (tile_grid){.columns = 0};
    box2 plan = {{automatic_or(l->x_min, s->domain.x_min), automatic_or(l->y_min, s->domain.y_min)},
                 {automatic_or(l->x_max, s->domain.x_max), automatic_or(l->y_max, s->domain.y_max)}};
    ice_material ice = material_of(s);
    double length =
        ice_characteristic_length(&ice, s->ice.thickness, s->environment.water_density, s->environment.gravity);
    tile_grid g = tile_grid_over(plan, automatic_or(l->tile_size, TILE_LENGTHS * length));
    g.anchored[SHEET_X_MIN] = l->anchored_x_min;
    g.anchored[SHEET_X_MAX] = l->anchored_x_max;
    g.anchored[SHEET_Y_MIN] = l->anchored_y_min;
    g.anchored[SHEET_Y_MAX] = l->anchored_y_max;
    g.least_seam = s->ice.edge_threshold;
    return g;
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
    for (int32_t i = 0; i < s->ice.level.openings.count && status == FRAM_OK; i++) {
        const scenario_opening *o = &s->ice.level.openings.data[i];
        double x = o->length / 2, y = o->width / 2, angle = radians(o->angle_deg);
        vec2 corner[4] = {{-x, -y}, {x, -y}, {x, y}, {-x, y}};
        for (int k = 0; k < 4; k++)
            corner[k] = (vec2){o->x + real_cos(angle) * corner[k].x - real_sin(angle) * corner[k].y,
                               o->y + real_sin(angle) * corner[k].x + real_cos(angle) * corner[k].y};
        if (!polygon_list_push(ctx, out, (polygon){corner, 4}))
            status = error_memory(error);
    }
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

static fram_status build_level(context *ctx, const scenario *s, world *w, field_report *report, fram_error *error)
{
    tile_grid g = build_tiles(s);
    polygon_list openings = {0}, outlines = {0};
    int32_array cells = {0};
    floe_definition d = {.material = material_of(s),
                         .breakable = s->ice.breakable,
                         .motion = MOTION_STATIC,
                         .thickness = s->ice.thickness,
                         .elevation = floating_elevation(s, s->ice.thickness),
                         .parent = -1};
    fram_status status = find_openings(ctx, s, w, &openings, error);
    if (status == FRAM_OK)
        status = tile_sheet(ctx, &g, w->scratch.plane, &openings, s->ice.smallest_floe_area, &outlines, &cells, error);
    double area = 0;
    for (int32_t i = 0; i < polygon_list_count(&outlines) && status == FRAM_OK; i++) {
        int32_t row;
        d.outline = polygon_list_get(&outlines, i);
        d.tile = cells.data[i] + 1;
        area += polygon_area(d.outline);
        status = floe_create(ctx, &d, s->ice.smallest_piece_area, w->scratch.plane, &w->bodies, &w->shapes, &w->floes,
                             &w->clock.next_floe[0], &row, error);
    }
    if (status == FRAM_OK)
        status = mark_seams(ctx, &g, w, error);
    double whole = (g.plan.hi.x - g.plan.lo.x) * (g.plan.hi.y - g.plan.lo.y);
    *report = (field_report){.floes = polygon_list_count(&outlines), .concentration = area / whole, .free_area = whole};
    polygon_list_free(ctx, &openings);
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

fram_status build_ice(context *ctx, const scenario *s, world *w, field_report *report, fram_error *error)
{
    if (s->ice.source == ICE_VORONOI)
        return build_voronoi(ctx, s, w, report, error);
    if (s->ice.source == ICE_FILE)
        return build_file(ctx, s, w, report, error);
    if (s->ice.source == ICE_PACKED)
        return build_packed(ctx, s, w, report, error);
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
    return FRAM_OK;
}
