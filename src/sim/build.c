#include "sim/build.h"

#include "sim/approach_watch.h"
#include "sim/build_feeding.h"
#include "sim/build_keep_out.h"
#include "sim/build_vessel.h"
#include "sim/scene_size.h"

#include <string.h>

/* ---- walls ---- */

static fram_status add_wall(context *ctx, const scenario *s, world *w, box2 plan, fram_error *error)
{
    vec2 centre = vec2_scale(vec2_add(plan.lo, plan.hi), 0.5), half = vec2_scale(vec2_sub(plan.hi, plan.lo), 0.5);
    vec2 corner[4] = {{-half.x, -half.y}, {half.x, -half.y}, {half.x, half.y}, {-half.x, half.y}};
    int32_t shape = -1;
    fram_status status =
        shape_add_prism(ctx, &w->shapes, NULL, (polygon){corner, 4}, s->domain.wall_height / 2, 0, &shape, error);
    if (status != FRAM_OK)
        return status;
    int32_t slot = body_create(ctx, &w->bodies, MOTION_STATIC, MATERIAL_WALL);
    if (slot < 0)
        return error_memory(error);
    w->bodies.position[slot] = vec3_make(centre.x, centre.y, 0);
    w->bodies.shape[slot] = shape;
    return FRAM_OK;
}

static fram_status add_walls(context *ctx, const scenario *s, world *w, fram_error *error)
{
    if (s->domain.boundary != DOMAIN_WALLS)
        return FRAM_OK;
    const scenario_domain *d = &s->domain;
    double t = d->wall_thickness;
    const box2 plans[4] = {{{d->x_min - t, d->y_min - t}, {d->x_min, d->y_max + t}},
                           {{d->x_max, d->y_min - t}, {d->x_max + t, d->y_max + t}},
                           {{d->x_min, d->y_min - t}, {d->x_max, d->y_min}},
                           {{d->x_min, d->y_max}, {d->x_max, d->y_max + t}}};
    for (int i = 0; i < 4; i++) {
        fram_status status = add_wall(ctx, s, w, plans[i], error);
        if (status != FRAM_OK)
            return status;
    }
    return FRAM_OK;
}

/* ---- world ---- */

static fram_status name_ice(const scenario *s, fram_status status, fram_error *error)
{
    /* A fault in another file has its place already. */
    if (status == FRAM_ERROR_INPUT && error && !error->file[0]) {
        if (!error->key[0])
            memcpy(error->key, "ice", sizeof "ice");
        scenario_locate(s, error);
    }
    return status;
}

fram_status build_load_window(context *ctx, const scenario *s, int32_t vessels, world *w, fram_error *error)
{
    int32_t window = (int32_t)scenario_averaging_steps(s);
    if (!table_resize(ctx, &w->load_window, &load_window_table_info, window * vessels))
        return error_memory(error);
    return FRAM_OK;
}

/* Everything that the ice keeps clear of: vessels on station.  w is freed on failure. */
static fram_status build_before_ice(context *ctx, const scenario *s, const model *m, world *w, fram_error *error)
{
    fram_status status = scene_size_check(s, error);
    if (status == FRAM_OK)
        status = world_init(ctx, m, w, error);
    if (status != FRAM_OK)
        return status;
    int32_t vessels = scenario_vessel_count(s);
    vessel_pose_array put = {0};
    status = build_load_window(ctx, s, vessels, w, error);
    for (int32_t i = 0; i < vessels && status == FRAM_OK; i++) {
        vessel_entry entry = scenario_vessel_entry(s, i);
        status = build_vessel(ctx, s, &entry, m, w, &put, error);
    }
    array_free(ctx, &put);
    if (status == FRAM_OK)
        status = approach_watch_begin(ctx, m, w, error);
    if (status != FRAM_OK)
        world_free(ctx, w);
    return status;
}

fram_status build_world_begin(context *ctx, const scenario *s, const model *m, world *w, fram_error *error)
{
    fram_status status = build_before_ice(ctx, s, m, w, error);
    if (status != FRAM_OK)
        return status;
    status = add_walls(ctx, s, w, error);
    if (status != FRAM_OK)
        world_free(ctx, w);
    return status;
}

fram_status build_world_ice(context *ctx, const scenario *s, const model *m, world *w, field_report *report,
                            fram_error *error)
{
    *report = (field_report){0};
    fram_status status = name_ice(s, build_field(ctx, s, m, w, report, error), error);
    if (status != FRAM_OK)
        world_free(ctx, w);
    return status;
}

fram_status build_world(context *ctx, const scenario *s, const model *m, world *w, field_report *report,
                        fram_error *error)
{
    *report = (field_report){0};
    fram_status status = build_world_begin(ctx, s, m, w, error);
    return status == FRAM_OK ? build_world_ice(ctx, s, m, w, report, error) : status;
}

/* Floes of a list are a thousand at most and made at once: what is wrong with their places is known without a run. */
static fram_status check_listed(context *ctx, const scenario *s, const model *m, world *w, fram_error *error)
{
    field_report report = {0};
    return s->ice.source == ICE_FLOES ? name_ice(s, build_field(ctx, s, m, w, &report, error), error) : FRAM_OK;
}

fram_status build_check(context *ctx, const scenario *s, hull_store *store, build_look look, fram_error *error)
{
    model m;
    world w;
    fram_status status = build_model_of(ctx, s, store, &m, error);
    if (status != FRAM_OK)
        return status;
    status = build_before_ice(ctx, s, &m, &w, error);
    if (status == FRAM_OK) {
        w.without_ice = s->ice.source != ICE_FLOES;
        status = feeding_place_check(ctx, s, &m, &w, error);
        if (status == FRAM_OK)
            status = check_listed(ctx, s, &m, &w, error);
        if (status == FRAM_OK && look)
            look(ctx, s, &m, &w);
        world_free(ctx, &w);
    }
    model_free(ctx, &m);
    return status;
}

/* An endless field is cut where it is first seen: what keeps ice away there is only looked at. */
static fram_status look_at_zones(context *ctx, const scenario *s, const world *w, fram_error *error)
{
    polygon_list zones = {0};
    fram_status status = build_keep_out(ctx, s, w, HUGE_VAL, &zones, error);
    polygon_list_free(ctx, &zones);
    return status;
}

static fram_status outlines_of(context *ctx, const scenario *s, const model *m, drawn_ice *out, box2 *domain,
                               fram_error *error)
{
    world w;
    fram_status status = build_before_ice(ctx, s, m, &w, error);
    if (status != FRAM_OK)
        return status;
    scenario larger = *s;
    double floe_area = 0;
    bool fed = s->domain.boundary == DOMAIN_FEEDING;
    if (fed) {
        status = feeding_floe_area(ctx, s, &floe_area, error);
        larger = feeding_scenario(s, floe_area);
        if (status == FRAM_OK)
            status = look_at_zones(ctx, s, &w, error);
    }
    *domain = domain_box(&larger.domain);
    if (status == FRAM_OK)
        status = draw_ice(ctx, &larger, &w, out, error);
    if (status == FRAM_OK && fed)
        status = feeding_outlines_check(ctx, s, m, &w, floe_area, &out->outlines, error);
    status = name_ice(s, status, error);
    world_free(ctx, &w);
    return status;
}

fram_status build_outlines(context *ctx, const scenario *s, drawn_ice *out, box2 *domain, fram_error *error)
{
    if (!scenario_ice_is_field(&s->ice))
        return scenario_fault(s, error, "ice.source",
                              "the scenario has no field of floes: expected source voronoi, packed or file");
    model m;
    fram_status status = build_model(ctx, s, &m, error);
    if (status != FRAM_OK)
        return status;
    status = outlines_of(ctx, s, &m, out, domain, error);
    model_free(ctx, &m);
    return status;
}
