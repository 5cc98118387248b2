#include "sim/build.h"

#include "base/transcendental.h"
#include "sim/build_feeding.h"
#include "sim/build_flows.h"
#include "sim/build_hull.h"
#include "sim/build_hydrodynamics.h"
#include "sim/build_ice.h"
#include "sim/build_media.h"
#include "sim/build_station.h"
#include "sim/scene_size.h"
#include "vessel/path.h"

#include <string.h>

static void set_pair(pair_policies *p, material a, material b, double mu_static, double mu_kinetic, bool patch)
{
    p->of[a][b] = p->of[b][a] = (pair_policy){mu_static, mu_kinetic, patch};
}

static vec3 horizontal(double speed, double direction_deg)
{
    double angle = radians(direction_deg);
    return vec3_make(speed * real_cos(angle), speed * real_sin(angle), 0);
}

/* Boxes of moving bodies reach ahead by this many steps: they are then renewed about as often as those of slow ones. */
#define LOOKAHEAD_STEPS 25

step_settings build_settings(const scenario *s)
{
    const scenario_environment *e = &s->environment;
    const scenario_solver *v = &s->run.solver;
    const scenario_friction *f = &s->ice.friction;
    step_settings out = {
        .time_step = s->run.time_step,
        .forces = e->water ? FORCES_FLUID : FORCES_NONE,
        .media = {.gravity = e->gravity,
                  .water_density = e->water_density,
                  .air_density = e->air_density,
                  .current = horizontal(e->current_speed, e->current_direction_deg),
                  .wind = horizontal(e->wind_speed, e->wind_direction_deg)},
        .floe_response = {e->floe_added_mass, e->floe_damping},
        .collision = {.margin = s->run.collision_margin, .lookahead = LOOKAHEAD_STEPS * s->run.time_step},
        .crushing = {s->run.time_step, 0, s->ice.top_plane_area},
        .fracture = {.time_step = s->run.time_step,
                     .water_density = e->water_density,
                     .gravity = e->gravity,
                     .wedges = (int32_t)s->ice.fracture.wedges,
                     .splitting = s->ice.fracture.splitting,
                     .splitting_factor = s->ice.fracture.splitting_factor,
                     .toughness = s->ice.fracture.toughness,
                     .narrowness = s->ice.fracture.narrowness,
                     .smallest_floe_area = s->ice.smallest_floe_area,
                     .smallest_piece_area = s->ice.smallest_piece_area,
                     .edge_threshold = s->ice.edge_threshold,
                     .thick_plate_radius = s->ice.fracture.thick_plate_radius,
                     .wedge_room = s->ice.fracture.wedge_room,
                     .under_ice_contacts = s->ice.fracture.under_ice_contacts},
        .brash = s->ice.fracture.brash,
        .solver = {v->kind, (int32_t)v->iterations, (int32_t)v->position_iterations, v->warm_start, v->correction_rate,
                   v->contact_skin, v->baumgarte, v->tolerance, (int32_t)v->most_iterations},
        .boundary = s->domain.boundary,
        .domain = {{s->domain.x_min, s->domain.y_min}, {s->domain.x_max, s->domain.y_max}},
        .drift_given = !is_automatic(s->domain.drift_speed),
        .speed_limit = s->run.speed_limit,
    };
    if (out.drift_given) {
        vec3 drift = horizontal(s->domain.drift_speed, s->domain.drift_direction_deg);
        out.drift = vec2_make(drift.x, drift.y);
    }
    out.fracture.tiles = build_tiles(s);
    out.fracture.crush_trims = s->ice.crush_trims;
    const scenario_ice_drag *di = &e->ice_drag;
    const scenario_hull_drag *dh = &e->hull_drag;
    out.drag[MATERIAL_ICE] = (drag_coefficients){di->water_form, di->water_skin, di->air_form, di->air_skin};
    out.drag[MATERIAL_HULL] = (drag_coefficients){dh->water_form, dh->water_skin, dh->air_form, dh->air_skin};
    set_pair(&out.policies, MATERIAL_ICE, MATERIAL_ICE, f->ice_ice_static, f->ice_ice_kinetic, s->ice.cap_ice_ice);
    set_pair(&out.policies, MATERIAL_ICE, MATERIAL_HULL, f->ice_hull_static, f->ice_hull_kinetic, true);
    set_pair(&out.policies, MATERIAL_ICE, MATERIAL_WALL, f->ice_wall_static, f->ice_wall_kinetic, s->ice.cap_ice_wall);
    return out;
}

/* ------------------------------------------------------------------------------------------------------------ vessel
 */

static fram_status name_key(const scenario *s, fram_status status, const char *key, fram_error *error)
{
    /* A fault in another file has its place already. */
    if (status == FRAM_ERROR_INPUT && error && !error->key[0] && !error->file[0]) {
        memcpy(error->key, key, strlen(key) + 1);
        scenario_locate(s, error);
    }
    return status;
}

/* Where the path begins, and the velocity of its first step. */
static fram_status begin_path(context *ctx, const scenario *s, world *w, vessel_definition *d, fram_error *error)
{
    const scenario_vessel *v = &s->vessel;
    if (v->path.count == 0)
        return FRAM_OK;
    if (!table_resize(ctx, &w->waypoints, &waypoint_table_info, v->path.count))
        return error_memory(error);
    for (int32_t i = 0; i < v->path.count; i++) {
        const scenario_path_point *p = &v->path.data[i];
        w->waypoints.vessel[i] = 0;
        w->waypoints.time[i] = p->time;
        w->waypoints.place[i] = vec3_make(p->x, p->y, radians(p->heading_deg));
    }
    double dt = s->run.time_step;
    vec3 begin = path_place(&w->waypoints, 0, 0), next = path_place(&w->waypoints, 0, dt);
    d->position = vec3_make(begin.x, begin.y, 0);
    d->heading = begin.z;
    d->tow_velocity = vec3_make((next.x - begin.x) / dt, (next.y - begin.y) / dt, 0);
    d->tow_ramp = 0;
    return FRAM_OK;
}

static fram_status add_vessel(context *ctx, const scenario *s, world *w, const made_hull *hull, fram_error *error)
{
    const scenario_vessel *v = &s->vessel;
    vessel_definition d = {
        .solid = hull->solid,
        .centre = hull->centre,
        .mass = automatic_or(v->mass, hull->displaced_mass),
        .gyration = {automatic_or(v->gyration_roll, 0.35 * hull->particulars.beam),
                     automatic_or(v->gyration_pitch, 0.25 * hull->particulars.length),
                     automatic_or(v->gyration_yaw, 0.25 * hull->particulars.length)},
        .particulars = hull->particulars,
        .mode = v->mode,
        .position = {v->x, v->y, 0},
        .heading = radians(v->heading_deg),
        .tow_velocity = horizontal(v->speed, automatic_or(v->course_deg, v->heading_deg)),
        .tow_ramp = v->ramp,
    };
    int32_t row = -1;
    fram_status status = begin_path(ctx, s, w, &d, error);
    if (status != FRAM_OK)
        return status;
    status = vessel_create(ctx, &d, &w->bodies, &w->shapes, &w->joints, &w->vessels, &row, error);
    if (status == FRAM_OK)
        build_added_mass(w);
    return status;
}

/* ------------------------------------------------------------------------------------------------------------- walls
 */

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

/* A hull inside a wall would be thrown out of it by the first step. */
static fram_status check_clear_of_walls(context *ctx, const scenario *s, const world *w, fram_error *error)
{
    if (s->domain.boundary != DOMAIN_WALLS)
        return FRAM_OK;
    const scenario_domain *d = &s->domain;
    vec2_array plan = {0};
    fram_status status = build_footprint(ctx, w, w->vessels.body[0], false, &plan, error);
    if (status != FRAM_OK)
        return status;
    box2 hull = polygon_bounds((polygon){plan.data, plan.count});
    array_free(ctx, &plan);
    bool inside_x = hull.lo.x >= d->x_min && hull.hi.x <= d->x_max;
    bool inside_y = hull.lo.y >= d->y_min && hull.hi.y <= d->y_max;
    if (inside_x && inside_y)
        return FRAM_OK;
    error_set(error, FRAM_ERROR_INPUT, NULL, 0, inside_x ? "vessel.y" : "vessel.x",
              "the hull covers x from %.5g to %.5g m, y from %.5g to %.5g m, and so reaches into the walls of the "
              "domain: move it or the walls, or choose domain.boundary: open",
              hull.lo.x, hull.hi.x, hull.lo.y, hull.hi.y);
    scenario_locate(s, error);
    return FRAM_ERROR_INPUT;
}

/* ------------------------------------------------------------------------------------------------------------- world
 */

static fram_status start_load_window(context *ctx, const scenario *s, world *w, fram_error *error)
{
    double steps = floor(s->output.averaging_window / s->run.time_step + 0.5);
    int32_t window = steps < 1 ? 1 : steps > 1e6 ? 1000000 : (int32_t)steps;
    if (!table_resize(ctx, &w->load_window, &load_window_table_info, s->vessel.present ? window : 0))
        return error_memory(error);
    return FRAM_OK;
}

/* Everything that the ice keeps clear of: media, vessel and station.  w is freed on failure. */
static fram_status build_before_ice(context *ctx, const scenario *s, const step_settings *settings, world *w,
                                    build_report *report, fram_error *error)
{
    *report = (build_report){0};
    fram_status status = scene_size_check(s, error);
    if (status == FRAM_OK)
        status = world_init(ctx, w, error);
    if (status != FRAM_OK)
        return status;
    status = start_load_window(ctx, s, w, error);
    if (status == FRAM_OK)
        status = build_media(ctx, s, &w->media, error);
    made_hull hull = {0};
    if (status == FRAM_OK && s->vessel.present) {
        status = build_hull(ctx, s, w, &hull, error);
        if (status == FRAM_OK)
            status = build_hydrodynamics(s, &hull, w, error);
        if (status == FRAM_OK)
            status = build_flows(ctx, s, &hull, w, error);
        if (status == FRAM_OK)
            status = add_vessel(ctx, s, w, &hull, error);
        if (status == FRAM_OK)
            status = build_station(ctx, s, settings, w, error);
        if (status == FRAM_OK)
            status = check_clear_of_walls(ctx, s, w, error);
        report->displaced_mass = hull.displaced_mass;
    }
    if (status != FRAM_OK)
        world_free(ctx, w);
    return status;
}

fram_status build_world(context *ctx, const scenario *s, world *w, build_report *report, fram_error *error)
{
    const step_settings settings = build_settings(s);
    fram_status status = build_before_ice(ctx, s, &settings, w, report, error);
    if (status != FRAM_OK)
        return status;
    status = add_walls(ctx, s, w, error);
    if (status == FRAM_OK)
        status = name_key(s, build_field(ctx, s, &settings, w, &report->field, error), "ice", error);
    if (status != FRAM_OK)
        world_free(ctx, w);
    return status;
}

fram_status build_outlines(context *ctx, const scenario *s, drawn_ice *out, box2 *domain, fram_error *error)
{
    if (s->ice.source != ICE_VORONOI && s->ice.source != ICE_FILE && s->ice.source != ICE_PACKED) {
        error_set(error, FRAM_ERROR_INPUT, NULL, 0, "ice.source",
                  "the scenario has no field of floes: expected source voronoi, packed or file");
        scenario_locate(s, error);
        return FRAM_ERROR_INPUT;
    }
    const step_settings settings = build_settings(s);
    world w;
    build_report report;
    fram_status status = build_before_ice(ctx, s, &settings, &w, &report, error);
    if (status != FRAM_OK)
        return status;
    scenario larger = *s;
    if (s->domain.boundary == DOMAIN_FEEDING)
        larger = feeding_scenario(s, &settings);
    *domain = (box2){{larger.domain.x_min, larger.domain.y_min}, {larger.domain.x_max, larger.domain.y_max}};
    status = name_key(s, draw_ice(ctx, &larger, &w, out, error), "ice", error);
    world_free(ctx, &w);
    return status;
}

fram_status build_empty_world(context *ctx, const scenario *s, world *w, fram_error *error)
{
    fram_status status = world_init(ctx, w, error);
    if (status != FRAM_OK)
        return status;
    status = build_media(ctx, s, &w->media, error);
    made_hull hull;
    if (status == FRAM_OK && s->vessel.present)
        status = build_hull(ctx, s, w, &hull, error);
    if (status == FRAM_OK && s->vessel.present)
        status = build_hydrodynamics(s, &hull, w, error);
    if (status == FRAM_OK && s->vessel.present)
        status = build_flows(ctx, s, &hull, w, error);
    if (status != FRAM_OK)
        world_free(ctx, w);
    return status;
}
