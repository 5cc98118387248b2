#include "sim/build_model.h"

#include "base/transcendental.h"
#include "sim/approach_watch.h"
#include "sim/build_flows.h"
#include "sim/build_hydrodynamics.h"
#include "sim/build_level.h"
#include "sim/build_media.h"
#include "sim/build_wash.h"
#include "sim/ice_kinds.h"

#include <math.h>

static void set_pair(pair_policies *p, material a, material b, double mu_static, double mu_kinetic, bool patch)
{
    p->of[a][b] = p->of[b][a] =
        (pair_policy){.friction_static = mu_static, .friction_kinetic = mu_kinetic, .patch = patch};
}

/* Boxes of moving bodies reach ahead by this many steps: they are then renewed about as often as those of slow ones. */
#define LOOKAHEAD_STEPS 25

/* A ship slower than this over the ground has a heading and no course, in full size [m/s]. */
static const double COURSE_SPEED = 0.3;

/* A hull that goes by slower than this past a floe rests on it, in full size: the solver leaves such velocities behind,
   and they have no direction [m/s].  Range 1e-4 to 0.01. */
static const double REST_SPEED = 1e-3;

static strength_field strength_of(const scenario *s)
{
    const scenario_strength *k = &s->ice.strength;
    return (strength_field){.seed = (uint64_t)s->run.seed,
                            .flexural_variation = k->flexural_variation,
                            .crushing_variation = k->crushing_variation,
                            .length = k->correlation_length,
                            .common = k->common};
}

/* Edges are rigid under the area of the hull's section: that of ice which gave is another one. */
static bool edges_give(const scenario *s) { return s->ice.fracture.edge_compliance && !s->ice.top_plane_area; }

fracture_settings build_fracture_settings(const scenario *s)
{
    const scenario_environment *e = &s->environment;
    return (fracture_settings){.time_step = s->run.time_step,
                               .water_density = e->water_density,
                               .gravity = e->gravity,
                               .wedges = (int32_t)s->ice.fracture.wedges,
                               .sharing = s->ice.fracture.sharing,
                               .radius_along = s->ice.fracture.radius_along,
                               .splitting = s->ice.fracture.splitting,
                               .load_rule = s->ice.fracture.load_over,
                               .splitting_factor = s->ice.fracture.splitting_factor,
                               .toughness = s->ice.fracture.toughness,
                               .narrowness = s->ice.fracture.narrowness,
                               .smallest_floe_area = s->ice.smallest_floe_area,
                               .smallest_piece_area = s->ice.smallest_piece_area,
                               .edge_threshold = s->ice.edge_threshold,
                               .thick_plate_radius = s->ice.fracture.thick_plate_radius,
                               .wide_contacts = s->ice.fracture.wide_contacts,
                               .joint_loads = s->ice.fracture.joint_loads,
                               .wedge_room = s->ice.fracture.wedge_room,
                               .under_pieces = s->ice.fracture.under_pieces,
                               .under_ice_contacts = s->ice.fracture.under_ice_contacts,
                               .tiles = build_tiles(s),
                               .strength = strength_of(s),
                               .edges_give = edges_give(s),
                               .edge_inertia = s->ice.fracture.edge_inertia,
                               .edge_gaps = s->ice.fracture.edge_gaps,
                               .edge_melts = s->ice.fracture.edge_melts,
                               .latent_heat = s->ice.fracture.latent_heat,
                               .crush_notches = s->ice.crush_notches,
                               .crush_trims = s->ice.crush_trims};
}

double build_wedge_area(const scenario *s, const ice_kind *k)
{
    const ice_material m = ice_kind_material(&s->ice, k);
    fracture_settings f = build_fracture_settings(s);
    double radius =
        fracture_edge_stress(&f, &m, k->thickness, 1, k->thickness * k->thickness, EDGE_STRAIGHT).breaking_radius;
    double side = fracture_wedge_side(&f, radius);
    return 0.5 * side * side * real_sin(PI / (double)f.wedges);
}

static edge_compliance compliance_of(const scenario *s)
{
    return (edge_compliance){.gives = edges_give(s),
                             .inertia = s->ice.fracture.edge_inertia,
                             .water_density = s->environment.water_density,
                             .gravity = s->environment.gravity,
                             .wedges = (int32_t)s->ice.fracture.wedges,
                             .thick_plate_radius = s->ice.fracture.thick_plate_radius,
                             .elastic = edges_give(s) && s->ice.fracture.edge_elastic};
}

static model settings_of(const scenario *s)
{
    const scenario_environment *e = &s->environment;
    const scenario_solver *v = &s->run.solver;
    const scenario_friction *f = &s->ice.friction;
    model out = {
        .time_step = s->run.time_step,
        .step_parts = 1,
        .forces = e->water ? FORCES_FLUID : FORCES_NONE,
        .media = {.gravity = e->gravity,
                  .water_density = e->water_density,
                  .air_density = e->air_density,
                  .current = scenario_velocity(e->current_speed, e->current_direction_deg),
                  .wind = scenario_velocity(e->wind_speed, e->wind_direction_deg)},
        .floe_response = {e->floe_added_mass, e->floe_damping},
        .ventilation = e->floe_ventilation,
        .collision = {.margin = s->run.collision_margin, .lookahead = LOOKAHEAD_STEPS * s->run.time_step},
        .crushing = {.time_step = s->run.time_step,
                     .skin = v->contact_skin,
                     .rest_speed = REST_SPEED * sqrt(scenario_size(s)),
                     .pack = {.ridging = s->ice.ridging_resistance,
                              .edge_slope = real_tan(radians(s->ice.rafting_edge_angle_deg)),
                              .water_weight = e->water_density * e->gravity},
                     .strength = strength_of(s),
                     .small_patch = s->ice.small_patch,
                     .edges = compliance_of(s),
                     .correct_unbreakable = s->ice.correct_unbreakable,
                     .parts_by_motion = s->ice.parts_by_motion,
                     .top_plane_area = s->ice.top_plane_area},
        .fracture = build_fracture_settings(s),
        .brash = s->ice.fracture.brash,
        .solver = {v->kind, (int32_t)v->iterations, (int32_t)v->position_iterations, v->warm_start, v->correction_rate,
                   v->contact_skin, v->baumgarte, v->tolerance, (int32_t)v->most_iterations},
        .rest = {s->ice.sleep_speed, s->ice.sleep_time},
        .boundary = s->domain.boundary,
        .domain = domain_box(&s->domain),
        .drift_given = !is_automatic(s->domain.drift_speed),
        .speed_limit = s->run.speed_limit,
        .course_speed = COURSE_SPEED * sqrt(scenario_size(s)),
    };
    if (out.drift_given) {
        vec3 drift = scenario_velocity(s->domain.drift_speed, s->domain.drift_direction_deg);
        out.drift = vec2_make(drift.x, drift.y);
    }
    const scenario_ice_drag *di = &e->ice_drag;
    const scenario_hull_drag *dh = &e->hull_drag;
    out.drag[MATERIAL_ICE] = (drag_coefficients){di->water_form, di->water_skin, di->air_form, di->air_skin};
    out.drag[MATERIAL_HULL] = (drag_coefficients){dh->water_form, dh->water_skin, dh->air_form, dh->air_skin};
    set_pair(&out.policies, MATERIAL_ICE, MATERIAL_ICE, f->ice_ice_static, f->ice_ice_kinetic, s->ice.cap_ice_ice);
    /* Floes that break under other floes need the patch of every contact. */
    out.policies.of[MATERIAL_ICE][MATERIAL_ICE].sides =
        s->ice.cap_ice_ice && !(s->ice.fracture.under_ice_contacts && ice_may_break(&s->ice));
    set_pair(&out.policies, MATERIAL_ICE, MATERIAL_HULL, f->ice_hull_static, f->ice_hull_kinetic, true);
    set_pair(&out.policies, MATERIAL_ICE, MATERIAL_WALL, f->ice_wall_static, f->ice_wall_kinetic, s->ice.cap_ice_wall);
    set_pair(&out.policies, MATERIAL_HULL, MATERIAL_HULL, f->hull_hull_static, f->hull_hull_kinetic, false);
    set_pair(&out.policies, MATERIAL_HULL, MATERIAL_WALL, f->hull_wall_static, f->hull_wall_kinetic, false);
    return out;
}

fram_status build_vessel_model(context *ctx, const scenario *s, const vessel_entry *entry, hull_store *store, model *m,
                               fram_error *error)
{
    vessel_model v = {.yielding = is_automatic(entry->keys->fender_stiffness) ? 0 : 1 / entry->keys->fender_stiffness};
    fram_status status = build_hull(ctx, s, entry, store, &m->solids, &v, error);
    if (status == FRAM_OK)
        status = approach_watch_model(ctx, s, entry, m, &v, error);
    if (status == FRAM_OK)
        status = build_hydrodynamics(ctx, s, entry, &m->solids.data[v.solid], &v, error);
    if (status == FRAM_OK)
        status = build_flows(ctx, s, entry, &v, error);
    v.hydrodynamics.measured = v.flows.water.count > 0;
    v.hydrodynamics.depth = v.flows.depth;
    v.wash = build_wash(s, entry->keys, &v);
    if (status == FRAM_OK && !array_push(ctx, &m->vessels, v))
        status = error_memory(error);
    if (status != FRAM_OK)
        array_free(ctx, &v.plan);
    return status;
}

fram_status build_method(context *ctx, const scenario *s, model *m, fram_error *error)
{
    *m = settings_of(s);
    fram_status status = build_media(ctx, s, &m->history, error);
    if (status == FRAM_OK)
        history_warnings(ctx, s, &m->history);
    if (status == FRAM_OK)
        status = build_sheet(ctx, s, &m->sheet, error);
    if (status != FRAM_OK)
        model_free(ctx, m);
    return status;
}

fram_status build_model_of(context *ctx, const scenario *s, hull_store *store, model *m, fram_error *error)
{
    fram_status status = build_method(ctx, s, m, error);
    if (status != FRAM_OK)
        return status;
    for (int32_t i = 0; i < scenario_vessel_count(s) && status == FRAM_OK; i++) {
        vessel_entry entry = scenario_vessel_entry(s, i);
        status = build_vessel_model(ctx, s, &entry, store, m, error);
    }
    if (status != FRAM_OK)
        model_free(ctx, m);
    return status;
}

fram_status build_model(context *ctx, const scenario *s, model *m, fram_error *error)
{
    return build_model_of(ctx, s, NULL, m, error);
}
