#include "sim/series.h"

#include "base/transcendental.h"
#include "sim/ice_loads.h"

#include <stdio.h>
#include <string.h>

/* The vessel's part of a row: zero without a vessel. */
typedef struct vessel_channels {
    vec3 position, velocity, angular_velocity, attitude_deg;
    ice_load ice;
    vec3 ice_force_body, ice_moment_body;
    wrench averaged;
    vec3 joint_force, joint_moment;
    wrench fluid, mooring, thrust;
    vec3 response;
    vec3 offset, estimate, bias, demand;
    double thruster_power, line_tension_max;
    int32_t lines_parted, thrusters_failed, saturated;
} vessel_channels;

/* What keeps the first vessel on station. */
static void add_station(const world *w, vessel_channels *c)
{
    if (w->stations.count == 0)
        return;
    const station_table *s = &w->stations;
    c->mooring = s->mooring_load[0];
    c->thrust = s->thruster_load[0];
    c->offset = vec3_make(s->offset[0].x, s->offset[0].y, degrees(s->offset[0].z));
    c->estimate = s->estimate[0].place;
    c->estimate.z = degrees(plane_angle(c->estimate.z));
    c->bias = s->estimate[0].bias;
    c->demand = s->demand[0];
    c->saturated = s->saturated[0];
    for (int32_t i = 0; i < w->thrusters.count; i++) {
        c->thruster_power += w->thrusters.failed[i] ? 0 : thruster_power(&w->thrusters, i);
        c->thrusters_failed += w->thrusters.failed[i];
    }
    for (int32_t i = 0; i < w->lines.count; i++) {
        c->line_tension_max = fmax(c->line_tension_max, w->lines.tension[i]);
        c->lines_parted += w->lines.broken[i];
    }
}

static vessel_channels vessel_channels_of(const world *w)
{
    vessel_channels c = {0};
    if (w->vessels.count == 0)
        return c;
    int32_t body = w->vessels.body[0], joint = w->vessels.joint[0];
    vec3 rpy = quat_roll_pitch_yaw(w->bodies.orientation[body]);
    mat3 r = quat_matrix(w->bodies.orientation[body]);
    c.position = w->bodies.position[body];
    c.velocity = w->bodies.velocity[body];
    c.angular_velocity = w->bodies.angular_velocity[body];
    c.attitude_deg = vec3_make(degrees(rpy.x), degrees(rpy.y), degrees(rpy.z));
    if (w->scratch.ice_loads.count > 0)
        c.ice = w->scratch.ice_loads.data[0];
    c.ice_force_body = mat3_tmul_vec(r, c.ice.total.force);
    c.ice_moment_body = mat3_tmul_vec(r, c.ice.total.moment);
    c.averaged = load_window_average(w, 0);
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
    if (w->scratch.responses.count > 0)
        c.response = w->scratch.responses.data[0].force;
    add_station(w, &c);
    return c;
}

typedef struct count_channels {
    int32_t bodies, floes;
    double entered, held_back; /* with feeding, otherwise 0 */
    vec2 drift;
} count_channels;

static count_channels counts_of(const world *w)
{
    count_channels n = {0};
    for (int32_t i = 0; i < w->bodies.count; i++)
        n.bodies += body_is_alive(&w->bodies, i);
    for (int32_t i = 0; i < w->floes.count; i++)
        n.floes += w->floes.body[i] >= 0;
    if (w->feeding.count > 0) {
        n.entered = w->feeding.entered[0];
        n.held_back = w->feeding.held_back[0];
        n.drift = w->feeding.velocity[0];
    }
    return n;
}

/* Every column once: name, unit, value.  Forces are on the vessel, global frame unless the name says body; moments are
   about its centre of mass. */
#define V3(X, name, unit, v) X(name "_x", unit, (v).x) X(name "_y", unit, (v).y) X(name "_z", unit, (v).z)
#define MECHANISM(X, name, id)                                           \
    V3(X, "mechanism_" name, "N", c.ice.mechanism[MECHANISM_##id].force) \
    V3(X, "mechanism_" name "_moment", "N m", c.ice.mechanism[MECHANISM_##id].moment)
#define MECHANISMS(X)                          \
    MECHANISM(X, "splitting", SPLITTING)       \
    MECHANISM(X, "bending", BENDING)           \
    MECHANISM(X, "crushing", CRUSHING)         \
    MECHANISM(X, "chain", CHAIN)               \
    MECHANISM(X, "accumulation", ACCUMULATION) \
    MECHANISM(X, "submersion", SUBMERSION)     \
    MECHANISM(X, "impact", IMPACT)             \
    MECHANISM(X, "friction", FRICTION)
#define SERIES(X)                                                     \
    X("time", "s", w->clock.time[0])                                  \
    V3(X, "position", "m", c.position)                                \
    X("roll", "deg", c.attitude_deg.x)                                \
    X("pitch", "deg", c.attitude_deg.y)                               \
    X("yaw", "deg", c.attitude_deg.z)                                 \
    V3(X, "velocity", "m/s", c.velocity)                              \
    V3(X, "angular_velocity", "rad/s", c.angular_velocity)            \
    V3(X, "ice_force", "N", c.ice.total.force)                        \
    V3(X, "ice_moment", "N m", c.ice.total.moment)                    \
    V3(X, "ice_force_body", "N", c.ice_force_body)                    \
    V3(X, "ice_moment_body", "N m", c.ice_moment_body)                \
    V3(X, "ice_force_averaged", "N", c.averaged.force)                \
    V3(X, "ice_moment_averaged", "N m", c.averaged.moment)            \
    V3(X, "ice_force_capped", "N", c.ice.capped.force)                \
    V3(X, "ice_force_below_cap", "N", c.ice.below_cap.force)          \
    V3(X, "ice_force_friction", "N", c.ice.friction.force)            \
    V3(X, "ice_force_bow", "N", c.ice.zone[ZONE_BOW].force)           \
    V3(X, "ice_force_shoulder", "N", c.ice.zone[ZONE_SHOULDER].force) \
    V3(X, "ice_force_midbody", "N", c.ice.zone[ZONE_MIDBODY].force)   \
    V3(X, "ice_force_stern", "N", c.ice.zone[ZONE_STERN].force)       \
    V3(X, "ice_force_bottom", "N", c.ice.zone[ZONE_BOTTOM].force)     \
    MECHANISMS(X)                                                     \
    V3(X, "tow_force", "N", c.joint_force)                            \
    V3(X, "tow_moment", "N m", c.joint_moment)                        \
    V3(X, "fluid_force", "N", c.fluid.force)                          \
    V3(X, "fluid_moment", "N m", c.fluid.moment)                      \
    V3(X, "hydrodynamic_force", "N", c.response)                      \
    V3(X, "mooring_force", "N", c.mooring.force)                      \
    V3(X, "mooring_moment", "N m", c.mooring.moment)                  \
    V3(X, "thruster_force", "N", c.thrust.force)                      \
    V3(X, "thruster_moment", "N m", c.thrust.moment)                  \
    X("thruster_power", "W", c.thruster_power)                        \
    X("thrusters_failed", "1", c.thrusters_failed)                    \
    X("thrusters_saturated", "1", c.saturated)                        \
    X("line_tension_max", "N", c.line_tension_max)                    \
    X("lines_parted", "1", c.lines_parted)                            \
    X("offset_x", "m", c.offset.x)                                    \
    X("offset_y", "m", c.offset.y)                                    \
    X("heading_deviation", "deg", c.offset.z)                         \
    X("estimated_x", "m", c.estimate.x)                               \
    X("estimated_y", "m", c.estimate.y)                               \
    X("estimated_heading", "deg", c.estimate.z)                       \
    V3(X, "estimated_load", "N", c.bias)                              \
    V3(X, "demanded_force", "N", c.demand)                            \
    X("bodies", "1", n.bodies)                                        \
    X("floes", "1", n.floes)                                          \
    X("contacts", "1", w->scratch.contacts.count)                     \
    X("vessel_contacts", "1", c.ice.contacts)                         \
    X("crushing_patches", "1", w->scratch.patches.count)              \
    X("ice_mass_left", "kg", w->clock.ice_left[0])                    \
    X("ice_mass_entered", "kg", n.entered)                            \
    X("ice_mass_held_back", "kg", n.held_back)                        \
    X("ice_mass_lost", "kg", w->clock.ice_lost[0])                    \
    X("drift_x", "m/s", n.drift.x)                                    \
    X("drift_y", "m/s", n.drift.y)                                    \
    X("ice_mass_gained", "kg", w->clock.ice_gained[0])                \
    X("ice_mass_crushed", "kg", w->clock.ice_crushed[0])              \
    X("brash_mass", "kg", w->clock.brash_mass[0])                     \
    V3(X, "brash_momentum", "N s", w->clock.brash_momentum[0])        \
    X("splits", "1", (double)w->clock.splits[0])                      \
    X("bendings", "1", (double)w->clock.bendings[0])                  \
    X("crushing_work", "J", w->clock.work_crushed[0])                 \
    X("kinetic_energy", "J", body_kinetic_energy(&w->bodies))         \
    X("solver_residual", "m/s", w->scratch.solver.residual)           \
    X("overlap_mean", "m", w->scratch.solver.mean_depth)              \
    X("overlap_max", "m", w->scratch.solver.max_depth)                \
    X("step_wall_time", "s", wall)

#define COLUMN(name, unit, value) {name, unit},
static const csv_column columns[] = {SERIES(COLUMN)};
enum { COLUMN_COUNT = sizeof columns / sizeof *columns };
_Static_assert((int)COLUMN_COUNT <= (int)SERIES_ROOM, "a row has room for every column");

static void add_numbered(series_layout *out, const char *format, int32_t number, const char *unit)
{
    if (out->count == SERIES_ROOM)
        return;
    snprintf(out->name[out->count], sizeof *out->name, format, (int)number);
    out->column[out->count] = (csv_column){out->name[out->count], unit};
    out->count++;
}

void series_columns(const scenario *s, series_layout *out)
{
    out->count = COLUMN_COUNT;
    memcpy(out->column, columns, sizeof columns);
    if (!s->vessel.present || s->vessel.mode != VESSEL_FREE)
        return;
    int32_t line = 0;
    for (int32_t i = 0; i < s->vessel.mooring.lines.count; i++)
        for (int64_t k = 0; k < s->vessel.mooring.lines.data[i].count; k++)
            add_numbered(out, "line_%d_tension", ++line, "N");
    for (int32_t i = 1; i <= s->vessel.thrusters.count; i++) {
        add_numbered(out, "thruster_%d_thrust", i, "N");
        add_numbered(out, "thruster_%d_angle", i, "deg");
    }
}

void series_row(const world *w, double wall, double out[SERIES_ROOM])
{
    vessel_channels c = vessel_channels_of(w);
    count_channels n = counts_of(w);
    int k = 0;
#define VALUE(name, unit, value) out[k++] = (value);
    SERIES(VALUE)
#undef VALUE
    for (int32_t i = 0; i < w->lines.count && k < SERIES_ROOM; i++)
        out[k++] = w->lines.tension[i];
    for (int32_t i = 0; i < w->thrusters.count && k + 1 < SERIES_ROOM; i++) {
        out[k++] = w->thrusters.thrust[i];
        out[k++] = degrees(w->thrusters.angle[i]);
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

static const csv_column broken_columns[] = {FRACTURE(COLUMN)};
enum { BROKEN_COUNT = sizeof broken_columns / sizeof *broken_columns };
_Static_assert((int)BROKEN_COUNT <= (int)SERIES_ROOM, "a row has room for every column");

const csv_column *fracture_columns(int32_t *count)
{
    *count = BROKEN_COUNT;
    return broken_columns;
}

void fracture_row(double time, const fracture_event *e, double out[SERIES_ROOM])
{
    int k = 0;
#define VALUE(name, unit, value) out[k++] = (value);
    FRACTURE(VALUE)
#undef VALUE
}
