#include "sim/series.h"

#include "base/transcendental.h"
#include "bodies/energy.h"
#include "model/scenario_vessel.h"
#include "sim/ice_loads.h"

#include <stdio.h>
#include <string.h>

/* A vessel's part of a row: zero without one. */
typedef struct vessel_channels {
    vec3 position, velocity, angular_velocity, attitude_deg;
    ice_load ice;
    vec3 ice_force_body, ice_moment_body;
    wrench averaged;
    vec3 joint_force, joint_moment;
    wrench fluid, mooring, thrust;
    vec3 response;
    vec3 offset, estimate, load, demand;
    double thruster_power, line_tension_max;
    int32_t lines_parted, thrusters_failed, saturated;
    vec3 wash;
    double net_thrust, steering_deg, besets, rams, rounds, off; /* of a ship that drives itself */
} vessel_channels;

/* What keeps a vessel on station. */
static void add_station(const world *w, int32_t v, vessel_channels *c)
{
    const station_table *s = &w->stations;
    if (v < s->count) {
        c->mooring = s->mooring_load[v];
        c->thrust = s->thruster_load[v];
        if (station_is_kept(s, &w->vessels, v))
            c->offset = station_deviation(s, v, w->clock.time[0], &w->vessels, &w->bodies, &w->waypoints);
        c->offset.z = degrees(c->offset.z);
        c->estimate = s->estimate[v].place;
        c->estimate.z = degrees(plane_angle(c->estimate.z));
        c->load = station_load(s, v);
        c->demand = s->demand[v];
        c->saturated = s->saturated[v];
    }
    for (int32_t i = 0; i < w->thrusters.count; i++) {
        if (w->thrusters.vessel[i] != v)
            continue;
        c->thruster_power += w->thrusters.failed[i] ? 0 : thruster_power(&w->thrusters, i);
        c->thrusters_failed += w->thrusters.failed[i];
    }
    for (int32_t i = 0; i < w->lines.count; i++) {
        if (w->lines.vessel[i] != v)
            continue;
        c->line_tension_max = fmax(c->line_tension_max, w->lines.tension[i]);
        c->lines_parted += w->lines.broken[i];
    }
}

/* How a ship drives itself. */
static void add_propulsion(const world *w, int32_t v, vessel_channels *c)
{
    const propulsion_table *p = &w->propulsion;
    for (int32_t i = 0; i < p->count; i++) {
        if (p->vessel[i] != v)
            continue;
        c->net_thrust = p->thrust[i];
        c->steering_deg = degrees(p->steering[i]);
        c->besets = (double)p->besets[i];
        c->rams = (double)p->rams[i];
        c->rounds = (double)p->rounds[i];
        c->off = p->off[i];
    }
}

static vessel_channels vessel_channels_of(const world *w, int32_t v)
{
    vessel_channels c = {0};
    if (v >= w->vessels.count)
        return c;
    add_propulsion(w, v, &c);
    int32_t body = w->vessels.body[v], joint = w->vessels.joint[v];
    vec3 rpy = quat_roll_pitch_yaw(w->bodies.orientation[body]);
    mat3 r = quat_matrix(w->bodies.orientation[body]);
    c.position = w->bodies.position[body];
    c.velocity = w->bodies.velocity[body];
    c.angular_velocity = w->bodies.angular_velocity[body];
    c.attitude_deg = vec3_make(degrees(rpy.x), degrees(rpy.y), degrees(rpy.z));
    if (w->scratch.ice_loads.count > v)
        c.ice = w->scratch.ice_loads.data[v];
    c.ice_force_body = mat3_tmul_vec(r, c.ice.total.force);
    c.ice_moment_body = mat3_tmul_vec(r, c.ice.total.moment);
    c.averaged = load_window_average(w, v);
    if (joint >= 0) {
        c.joint_force = w->joints.reaction_force[joint];
        c.joint_moment = w->joints.reaction_moment[joint];
    }
    int32_t shape = w->bodies.shape[body], row = shape >= 0 ? w->shapes.shapes.solid[shape] : -1;
    if (row >= 0 && w->scratch.fluid.count > row && body_is_dynamic(&w->bodies, body)) {
        const fluid_load *f = &w->scratch.fluid.data[row];
        c.fluid.force = vec3_add(vec3_add(f->hydrostatic.force, f->water_drag.force), f->wind_drag.force);
        c.fluid.moment = vec3_add(vec3_add(f->hydrostatic.moment, f->water_drag.moment), f->wind_drag.moment);
    }
    if (w->scratch.responses.count > v)
        c.response = w->scratch.responses.data[v].force;
    if (w->scratch.wash_force.count > v)
        c.wash = w->scratch.wash_force.data[v];
    add_station(w, v, &c);
    return c;
}

typedef struct count_channels {
    int32_t bodies, floes;
    double entered, held_back; /* with feeding, otherwise 0 */
    vec2 drift, sheet_load, sheet_drive;
} count_channels;

static count_channels counts_of(const world *w)
{
    count_channels n = {0};
    for (int32_t i = 0; i < w->bodies.count; i++)
        n.bodies += body_is_alive(&w->bodies, i);
    n.floes = world_floe_count(w);
    if (w->feeding.count > 0) {
        n.entered = w->feeding.entered[0];
        n.held_back = w->feeding.held_back[0];
        n.drift = w->feeding.velocity[0];
    }
    if (w->drift.count > 0) {
        n.entered = w->drift.entered[0];
        n.drift = w->drift.velocity[0];
        n.sheet_load = w->drift.load[0];
        n.sheet_drive = w->drift.drive[0];
    }
    return n;
}

/* Every column once, W of the world, V of a vessel: name, unit, value.  Forces are on the vessel, global frame unless
   the name says body; moments are about its centre of mass. */
#define V3(X, name, unit, v) X(name "_x", unit, (v).x) X(name "_y", unit, (v).y) X(name "_z", unit, (v).z)
/* Forces in the horizontal plane, and the yaw moment in z. */
#define PLANE(X, name, v) X(name "_x", "N", (v).x) X(name "_y", "N", (v).y) X(name "_z", "N m", (v).z)
#define OF_MECHANISM "mechanism_"
#define MECHANISM(X, name, id)                                           \
    V3(X, OF_MECHANISM name, "N", c.ice.mechanism[MECHANISM_##id].force) \
    V3(X, OF_MECHANISM name "_moment", "N m", c.ice.mechanism[MECHANISM_##id].moment)
#define MECHANISMS(X)                          \
    MECHANISM(X, "splitting", SPLITTING)       \
    MECHANISM(X, "bending", BENDING)           \
    MECHANISM(X, "crushing", CRUSHING)         \
    MECHANISM(X, "chain", CHAIN)               \
    MECHANISM(X, "accumulation", ACCUMULATION) \
    MECHANISM(X, "submersion", SUBMERSION)     \
    MECHANISM(X, "impact", IMPACT)             \
    MECHANISM(X, "friction", FRICTION)
#define SERIES(W, V)                                                  \
    W("time", "s", w->clock.time[0])                                  \
    V3(V, "position", "m", c.position)                                \
    V("roll", "deg", c.attitude_deg.x)                                \
    V("pitch", "deg", c.attitude_deg.y)                               \
    V("yaw", "deg", c.attitude_deg.z)                                 \
    V3(V, "velocity", "m/s", c.velocity)                              \
    V3(V, "angular_velocity", "rad/s", c.angular_velocity)            \
    V3(V, "ice_force", "N", c.ice.total.force)                        \
    V3(V, "ice_moment", "N m", c.ice.total.moment)                    \
    V3(V, "ice_force_body", "N", c.ice_force_body)                    \
    V3(V, "ice_moment_body", "N m", c.ice_moment_body)                \
    V3(V, "ice_force_averaged", "N", c.averaged.force)                \
    V3(V, "ice_moment_averaged", "N m", c.averaged.moment)            \
    V3(V, "ice_force_capped", "N", c.ice.capped.force)                \
    V3(V, "ice_force_below_cap", "N", c.ice.below_cap.force)          \
    V3(V, "ice_force_friction", "N", c.ice.friction.force)            \
    V3(V, "ice_force_bow", "N", c.ice.zone[ZONE_BOW].force)           \
    V3(V, "ice_force_shoulder", "N", c.ice.zone[ZONE_SHOULDER].force) \
    V3(V, "ice_force_midbody", "N", c.ice.zone[ZONE_MIDBODY].force)   \
    V3(V, "ice_force_stern", "N", c.ice.zone[ZONE_STERN].force)       \
    V3(V, "ice_force_bottom", "N", c.ice.zone[ZONE_BOTTOM].force)     \
    MECHANISMS(V)                                                     \
    V3(V, "hull_contact_force", "N", c.ice.hulls.force)               \
    V3(V, "hull_contact_moment", "N m", c.ice.hulls.moment)           \
    V3(V, "tow_force", "N", c.joint_force)                            \
    V3(V, "tow_moment", "N m", c.joint_moment)                        \
    V3(V, "fluid_force", "N", c.fluid.force)                          \
    V3(V, "fluid_moment", "N m", c.fluid.moment)                      \
    V3(V, "hydrodynamic_force", "N", c.response)                      \
    V3(V, "mooring_force", "N", c.mooring.force)                      \
    V3(V, "mooring_moment", "N m", c.mooring.moment)                  \
    V3(V, "thruster_force", "N", c.thrust.force)                      \
    V3(V, "thruster_moment", "N m", c.thrust.moment)                  \
    V("thruster_power", "W", c.thruster_power)                        \
    V("thrusters_failed", "1", c.thrusters_failed)                    \
    V("thrusters_saturated", "1", c.saturated)                        \
    V("line_tension_max", "N", c.line_tension_max)                    \
    V("lines_parted", "1", c.lines_parted)                            \
    V("offset_x", "m", c.offset.x)                                    \
    V("offset_y", "m", c.offset.y)                                    \
    V("heading_deviation", "deg", c.offset.z)                         \
    V("estimated_x", "m", c.estimate.x)                               \
    V("estimated_y", "m", c.estimate.y)                               \
    V("estimated_heading", "deg", c.estimate.z)                       \
    PLANE(V, "estimated_load", c.load)                                \
    PLANE(V, "demanded_force", c.demand)                              \
    V("net_thrust", "N", c.net_thrust)                                \
    V("steering_angle", "deg", c.steering_deg)                        \
    V("besets", "1", c.besets)                                        \
    V("rams", "1", c.rams)                                            \
    V("pattern_rounds", "1", c.rounds)                                \
    V("track_error", "m", c.off)                                      \
    V("wash_force_x", "N", c.wash.x)                                  \
    V("wash_force_y", "N", c.wash.y)                                  \
    W("bodies", "1", n.bodies)                                        \
    W("floes", "1", n.floes)                                          \
    W("contacts", "1", w->scratch.contacts.count)                     \
    V("vessel_contacts", "1", c.ice.contacts)                         \
    W("crushing_patches", "1", w->scratch.patches.count)              \
    W("ice_mass_left", "kg", w->clock.ice_left[0])                    \
    W("ice_mass_entered", "kg", n.entered)                            \
    W("ice_mass_held_back", "kg", n.held_back)                        \
    W("ice_mass_lost", "kg", w->clock.ice_lost[0])                    \
    W("drift_x", "m/s", n.drift.x)                                    \
    W("drift_y", "m/s", n.drift.y)                                    \
    W("sheet_load_x", "N", n.sheet_load.x)                            \
    W("sheet_load_y", "N", n.sheet_load.y)                            \
    W("sheet_drive_x", "N", n.sheet_drive.x)                          \
    W("sheet_drive_y", "N", n.sheet_drive.y)                          \
    W("ice_mass_gained", "kg", w->clock.ice_gained[0])                \
    W("ice_mass_crushed", "kg", w->clock.ice_crushed[0])              \
    W("brash_mass", "kg", w->clock.brash_mass[0])                     \
    V3(W, "brash_momentum", "N s", w->clock.brash_momentum[0])        \
    W("splits", "1", (double)w->clock.splits[0])                      \
    W("bendings", "1", (double)w->clock.bendings[0])                  \
    W("crushing_work", "J", w->clock.work_crushed[0])                 \
    W("kinetic_energy", "J", body_kinetic_energy(ctx, &w->bodies))    \
    W("solver_residual", "m/s", w->scratch.solver.residual)           \
    W("solver_iterations", "1", w->scratch.solver.iterations)         \
    W("overlap_mean", "m", w->scratch.solver.mean_depth)              \
    W("overlap_max", "m", w->scratch.solver.max_depth)                \
    W("step_wall_time", "s", wall_time)

/* In the order of one vessel's run; several vessels come one after the other behind what is the world's. */
typedef struct series_column {
    const char *name, *unit;
    bool of_vessel;
} series_column;
#define OF_WORLD(name, unit, value) {name, unit, false},
#define OF_VESSEL(name, unit, value) {name, unit, true},
static const series_column columns[] = {SERIES(OF_WORLD, OF_VESSEL)};
enum { COLUMN_COUNT = sizeof columns / sizeof *columns };

/* ---- layout ---- */

static bool add_name(context *ctx, series_layout *out, const char *name, const char *unit, bool of_mechanism)
{
    series_name column = {.unit = unit, .of_mechanism = of_mechanism};
    snprintf(column.text, sizeof column.text, "%s", name);
    return array_push(ctx, &out->names, column);
}

/* The columns of the world, of a vessel, or of both. */
static bool add_columns(context *ctx, const scenario *s, bool of_world, int32_t vessel, series_layout *out)
{
    bool good = true;
    for (int32_t i = 0; i < COLUMN_COUNT && good; i++) {
        const series_column *c = &columns[i];
        const bool of_mechanism = strncmp(c->name, OF_MECHANISM, sizeof OF_MECHANISM - 1) == 0;
        if (c->of_vessel && vessel >= 0)
            good = add_name(ctx, out, vessel_channel_name(s, vessel, c->name).text, c->unit, of_mechanism);
        else if (!c->of_vessel && of_world)
            good = add_name(ctx, out, c->name, c->unit, of_mechanism);
    }
    return good;
}

static bool add_numbered(context *ctx, const scenario *s, int32_t vessel, const char *what, int32_t number,
                         const char *quantity, const char *unit, series_layout *out)
{
    char name[40];
    snprintf(name, sizeof name, "%s_%d_%s", what, (int)number, quantity);
    return add_name(ctx, out, vessel_channel_name(s, vessel, name).text, unit, false);
}

/* Those of each line and thruster. */
static bool add_equipment(context *ctx, const scenario *s, int32_t vessel, series_layout *out)
{
    const scenario_vessel *v = scenario_vessel_entry(s, vessel).keys;
    int32_t line = 0;
    bool good = true;
    if (v->mode != VESSEL_FREE)
        return true;
    for (int32_t i = 0; i < v->mooring.lines.count; i++)
        for (int64_t k = 0; k < v->mooring.lines.data[i].count && good; k++)
            good = add_numbered(ctx, s, vessel, "line", ++line, "tension", "N", out);
    for (int32_t i = 1; i <= v->thrusters.count && good; i++)
        good = add_numbered(ctx, s, vessel, "thruster", i, "thrust", "N", out) &&
               add_numbered(ctx, s, vessel, "thruster", i, "angle", "deg", out);
    return good;
}

fram_status series_columns(context *ctx, const scenario *s, series_layout *out, fram_error *error)
{
    int32_t vessels = scenario_vessel_count(s);
    bool named = scenario_names_vessels(s);
    *out = (series_layout){.named = named};
    bool good = add_columns(ctx, s, true, named ? -1 : 0, out);
    for (int32_t v = 0; v < vessels && good; v++)
        good = (!named || add_columns(ctx, s, false, v, out)) && add_equipment(ctx, s, v, out);
    good = good && array_resize(ctx, &out->columns, out->names.count);
    for (int32_t i = 0; i < out->names.count && good; i++)
        out->columns.data[i] = (csv_column){out->names.data[i].text, out->names.data[i].unit};
    if (good)
        return FRAM_OK;
    series_layout_free(ctx, out);
    return error_memory(error);
}

double series_column_number(const scenario *s)
{
    int32_t vessels = scenario_vessel_count(s), own = 0;
    for (int32_t i = 0; i < COLUMN_COUNT; i++)
        own += columns[i].of_vessel;
    double number = COLUMN_COUNT - own + (double)own * (vessels > 1 ? vessels : 1);
    for (int32_t v = 0; v < vessels; v++) {
        const scenario_vessel *keys = scenario_vessel_entry(s, v).keys;
        if (keys->mode != VESSEL_FREE)
            continue;
        for (int32_t i = 0; i < keys->mooring.lines.count; i++)
            number += (double)keys->mooring.lines.data[i].count;
        number += 2 * (double)keys->thrusters.count;
    }
    return number;
}

void series_layout_free(context *ctx, series_layout *l)
{
    array_free(ctx, &l->names);
    array_free(ctx, &l->columns);
}

/* ---- values ---- */

#define VALUE(name, unit, value) out[k++] = (value);
#define NO_VALUE(name, unit, value)

/* Of the world, and with it of the first vessel where vessels have no names. */
static int32_t put_world(const context *ctx, const world *w, double wall_time, bool with_vessel, double *out)
{
    count_channels n = counts_of(w);
    int32_t k = 0;
    if (with_vessel) {
        vessel_channels c = vessel_channels_of(w, 0);
        SERIES(VALUE, VALUE)
        return k;
    }
    SERIES(VALUE, NO_VALUE)
    return k;
}

static int32_t put_vessel(const world *w, int32_t vessel, double *out)
{
    vessel_channels c = vessel_channels_of(w, vessel);
    int32_t k = 0;
    SERIES(NO_VALUE, VALUE)
    return k;
}

static int32_t put_equipment(const world *w, int32_t vessel, double *out)
{
    int32_t k = 0;
    for (int32_t i = 0; i < w->lines.count; i++)
        if (w->lines.vessel[i] == vessel)
            out[k++] = w->lines.tension[i];
    for (int32_t i = 0; i < w->thrusters.count; i++) {
        if (w->thrusters.vessel[i] != vessel)
            continue;
        out[k++] = w->thrusters.thrust[i];
        out[k++] = degrees(w->thrusters.angle[i]);
    }
    return k;
}

void series_row(const context *ctx, const series_layout *l, const world *w, double wall_time, double *out)
{
    int32_t k = put_world(ctx, w, wall_time, !l->named, out);
    for (int32_t v = 0; v < w->vessels.count; v++) {
        if (l->named)
            k += put_vessel(w, v, out + k);
        k += put_equipment(w, v, out + k);
    }
}

/* ---- broken floes ---- */

/* kind: 1 split, 2 bending, 3 release of a part of a level sheet.  Numbers of floes are never used twice; the pieces
 * have first_piece and those after it. */
#define FRACTURE(X)                                 \
    X("time", "s", time)                            \
    X("kind", "1", e->kind)                         \
    X("floe", "1", e->floe)                         \
    X("pieces", "1", e->pieces)                     \
    X("first_piece", "1", e->first_piece)           \
    V3(X, "place", "m", e->place)                   \
    X("load", "N", e->load)                         \
    X("crack_length", "m", e->crack_length)         \
    X("loaded_radius", "m", e->loaded_radius)       \
    X("stress_over_strength", "1", e->stress_ratio) \
    X("floe_area", "m2", e->parent_area)            \
    X("pieces_area", "m2", e->piece_area)           \
    X("area_lost", "m2", e->area_lost)              \
    X("area_gained", "m2", e->area_gained)          \
    X("mass_lost", "kg", e->mass_lost)              \
    X("mass_gained", "kg", e->mass_gained)          \
    V3(X, "momentum_lost", "N s", e->momentum_lost) \
    V3(X, "angular_momentum_lost", "N m s", e->angular_momentum_lost)

#define COLUMN(name, unit, value) {name, unit},
static const csv_column broken_columns[] = {FRACTURE(COLUMN)};
enum { BROKEN_COUNT = sizeof broken_columns / sizeof *broken_columns };
_Static_assert((int)BROKEN_COUNT <= (int)FRACTURE_ROOM, "a row has room for every column");

const csv_column *fracture_columns(int32_t *count)
{
    *count = BROKEN_COUNT;
    return broken_columns;
}

void fracture_row(double time, const fracture_event *e, double out[FRACTURE_ROOM])
{
    int k = 0;
    FRACTURE(VALUE)
}
