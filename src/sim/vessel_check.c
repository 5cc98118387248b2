#include "sim/vessel_check.h"

#include "base/transcendental.h"
#include "sim/build_vessel.h"
#include "sim/wall_check.h"

#include <math.h>
#include <stdio.h>

/* ---- what cannot be ---- */

/* Bounds of what is taken for a vessel.  A hull without machinery, stores and cargo still weighs a fifth to a third of
   the laden one; a twentieth is a slip of the pen. */
#define LEAST_MASS 0.05
/* Of the largest distance of the hull from the axis: masts and cranes reach beyond the hull, and no mass lies in the
   axis alone. */
#define LEAST_GYRATION 0.02
#define MOST_GYRATION 1.5

static fram_status fault(const scenario *s, const vessel_entry *e, const char *member, const char *expected,
                         double found, const char *unit, fram_error *error)
{
    return vessel_fault(s, e, member, error, "%s, found %.6g %s", expected, found, unit);
}

static double mass_of(const vessel_entry *e, const vessel_model *hull)
{
    return automatic_or(e->keys->mass, hull->displaced_mass);
}

static fram_status check_mass(const scenario *s, const vessel_entry *e, const vessel_model *hull, const solid *body,
                              fram_error *error)
{
    char expected[160];
    double most = mesh_solid_properties(&body->surface).volume * s->environment.water_density;
    double mass = mass_of(e, hull), least = LEAST_MASS * hull->displaced_mass;
    if (e->keys->mode == VESSEL_PRESCRIBED || !s->environment.water || (mass >= least && mass <= most))
        return FRAM_OK;
    snprintf(expected, sizeof expected, "expected %.4g to %.4g kg, %s", least, most,
             mass > most ? "all that the hull can displace: it sinks"
                         : "a twentieth of what it displaces at its draught: it would be thrown out of the water");
    return fault(s, e, "mass", expected, mass, "kg", error);
}

/* The centre of gravity in the box around the hull, above it by its depth at most. */
static fram_status check_centre(const scenario *s, const vessel_entry *e, const vessel_model *hull, const solid *body,
                                fram_error *error)
{
    static const char *const keys[3] = {"centre_of_gravity_x", "centre_of_gravity_y", "centre_of_gravity_z"};
    box3 box = mesh_bounds(&body->surface); /* about the centre of gravity */
    const double lo[3] = {box.lo.x, box.lo.y, box.lo.z}, hi[3] = {box.hi.x, box.hi.y, 2 * box.hi.z - box.lo.z};
    const double centre[3] = {hull->centre.x, hull->centre.y, hull->centre.z};
    for (int k = 0; k < 3; k++) {
        if (lo[k] <= 0 && hi[k] >= 0)
            continue;
        char expected[160];
        snprintf(expected, sizeof expected, "expected a place %s, from %.4g to %.4g m",
                 k < 2 ? "inside the hull" : "between the bottom and the hull's depth above its top", centre[k] + lo[k],
                 centre[k] + hi[k]);
        return fault(s, e, keys[k], expected, centre[k], "m", error);
    }
    return FRAM_OK;
}

/* Largest distances of the hull from the three axes through the centre of gravity. */
static vec3 reach_of(const mesh *surface)
{
    vec3 most = {0, 0, 0};
    for (int32_t i = 0; i < surface->vertex.count; i++) {
        vec3 v = surface->vertex.data[i];
        most.x = fmax(most.x, v.y * v.y + v.z * v.z);
        most.y = fmax(most.y, v.x * v.x + v.z * v.z);
        most.z = fmax(most.z, v.x * v.x + v.y * v.y);
    }
    return vec3_make(sqrt(most.x), sqrt(most.y), sqrt(most.z));
}

static fram_status check_gyration(const scenario *s, const vessel_entry *e, const vessel_model *hull, const solid *body,
                                  fram_error *error)
{
    static const char *const keys[3] = {"gyration_roll", "gyration_pitch", "gyration_yaw"};
    const scenario_vessel *v = e->keys;
    const double given[3] = {v->gyration_roll, v->gyration_pitch, v->gyration_yaw};
    const vec3 radii = build_gyration(v, &hull->particulars);
    const double k[3] = {radii.x, radii.y, radii.z};
    vec3 reach = reach_of(&body->surface);
    const double far[3] = {reach.x, reach.y, reach.z};
    if (v->mode != VESSEL_FREE)
        return FRAM_OK;
    for (int i = 0; i < 3; i++) {
        char expected[160];
        double others = k[(i + 1) % 3] * k[(i + 1) % 3] + k[(i + 2) % 3] * k[(i + 2) % 3];
        if (is_automatic(given[i]))
            continue;
        snprintf(expected, sizeof expected, "expected %.4g to %.4g m, for the hull reaches %.4g m from the axis",
                 LEAST_GYRATION * far[i], MOST_GYRATION * far[i], far[i]);
        if (!(k[i] >= LEAST_GYRATION * far[i] && k[i] <= MOST_GYRATION * far[i]))
            return fault(s, e, keys[i], expected, k[i], "m", error);
        snprintf(expected, sizeof expected,
                 "expected %.6g m at most, the root of the sum of the squares of the other two, as of every body",
                 sqrt(others));
        if (k[i] * k[i] > others * (1 + 1e-9))
            return fault(s, e, keys[i], expected, k[i], "m", error);
    }
    return FRAM_OK;
}

fram_status vessel_check(const scenario *s, const vessel_entry *e, const model *m, int32_t row, fram_error *error)
{
    const vessel_model *hull = &m->vessels.data[row];
    const solid *body = &m->solids.data[hull->solid];
    fram_status status = check_mass(s, e, hull, body, error);
    if (status == FRAM_OK)
        status = check_centre(s, e, hull, body, error);
    return status == FRAM_OK ? check_gyration(s, e, hull, body, error) : status;
}

/* ---- what a reader is told ---- */

/* Angles and masses from which on a start is no rest [deg, 1]. */
#define TOLD_ANGLE 5.0
#define TOLD_MASS 0.1

/* Small angles about the start; a list of metacentric height 0 is infinite. */
static void warn_of_angle(context *ctx, const vessel_entry *e, const char *key, const char *what, double arm, double gm)
{
    double angle = gm > 0 ? degrees(real_atan2(fabs(arm), gm)) : 90;
    if (fabs(arm) > 0 && angle > TOLD_ANGLE)
        log_write(ctx, LOG_WARNING,
                  "%s.%s: the vessel %s by about %.0f degrees, since its centre of gravity is %.4g m off", e->path, key,
                  what, angle, fabs(arm));
}

static void warn_of_stability(context *ctx, const scenario *s, const vessel_entry *e, const vessel_model *hull)
{
    const hull_hydrostatics *f = &hull->floats;
    if (e->keys->mode != VESSEL_FREE || !s->environment.water || !(f->volume > 0))
        return;
    double lift = f->centre_of_buoyancy.z - hull->centre.z;
    double gm = f->waterplane_xx / f->volume + lift, gm_long = f->waterplane_yy / f->volume + lift;
    if (!(gm > 0) || !(gm_long > 0)) {
        log_write(ctx, LOG_WARNING,
                  "the vessel capsizes: its %s metacentric height is %.4g m at the draught; lower "
                  "%s.centre_of_gravity_z, %.4g m, by more than that",
                  gm > 0 ? "longitudinal" : "transverse", gm > 0 ? gm_long : gm, e->path, hull->centre.z);
    } else {
        warn_of_angle(ctx, e, "centre_of_gravity_y", "heels", hull->centre.y - f->centre_of_buoyancy.y, gm);
        warn_of_angle(ctx, e, "centre_of_gravity_x", "trims", hull->centre.x - f->centre_of_buoyancy.x, gm_long);
    }
    double ratio = mass_of(e, hull) / hull->displaced_mass;
    if (fabs(ratio - 1) > TOLD_MASS)
        log_write(ctx, LOG_WARNING,
                  "%s.mass is %.3g of what the hull displaces at its draught: it begins by moving up or down to its "
                  "own waterline",
                  e->path, ratio);
}

/* Of a given matrix: a negative number on its diagonal drives the motion that it should damp. */
static void warn_of_damping(context *ctx, const vessel_entry *e, const vessel_model *hull)
{
    static const char *const motions[6] = {"surge", "sway", "heave", "roll", "pitch", "yaw"};
    if (e->keys->hydrodynamics.source != HYDRODYNAMICS_GIVEN)
        return;
    for (int i = 0; i < 6; i++) {
        double c = hull->hydrodynamics.damping.m[i][i];
        if (c < 0)
            log_write(ctx, LOG_WARNING,
                      "%s.hydrodynamics.damping is negative in %s, %.4g about the centre of mass: it drives that "
                      "motion instead of damping it",
                      e->path, motions[i], c);
    }
}

/* Forces that follow from the place at the beginning of a step let a body swing up when its natural frequency times the
   step exceeds 2 (symplectic Euler; Hairer, Lubich and Wanner 2006, I.1); from 1 on the motion is no longer that of the
   spring, and at a half it is within a percent or two. */
#define TOLD_FREQUENCY 1.0
#define GOOD_FREQUENCY 0.5

static void warn_of_stiffness(context *ctx, const scenario *s, const char *what, double stiffness, double mass)
{
    double frequency = stiffness > 0 && mass > 0 ? sqrt(stiffness / mass) : 0;
    if (frequency * s->run.time_step > TOLD_FREQUENCY)
        log_write(ctx, LOG_WARNING,
                  "%s is too stiff for the step: %.4g rad/s with the vessel's mass; take run.time_step under %.3g s",
                  what, frequency, GOOD_FREQUENCY / frequency);
}

/* Steepest rise of a line's tension with the distance of its ends [N/m]. */
static double line_stiffness(const line_table *l, int32_t row)
{
    if (l->kind[row] == LINE_SPRING)
        return l->stiffness[row];
    if (l->kind[row] == LINE_CATENARY)
        return l->stiffness[row] / l->length[row];
    double most = 0;
    const line_curve *c = &l->curve[row];
    for (int32_t i = 1; i < l->points[row]; i++)
        most = fmax(most, (c->tension[i] - c->tension[i - 1]) / (c->offset[i] - c->offset[i - 1]));
    return most;
}

/* All lines taut, in the direction in which they are stiffest together. */
static void warn_of_lines(context *ctx, const scenario *s, const vessel_entry *e, const world *w, int32_t row)
{
    int32_t body = w->vessels.body[row];
    double xx = 0, xy = 0, yy = 0;
    for (int32_t i = 0; i < w->lines.count; i++) {
        vec3 from = body_to_global(&w->bodies, body, w->lines.fairlead[i]);
        vec2 way = {w->lines.anchor[i].x - from.x, w->lines.anchor[i].y - from.y};
        double square = way.x * way.x + way.y * way.y, k = line_stiffness(&w->lines, i);
        if (w->lines.vessel[i] != row || !(square > 0))
            continue;
        xx += k * way.x * way.x / square, xy += k * way.x * way.y / square, yy += k * way.y * way.y / square;
    }
    char name[48];
    snprintf(name, sizeof name, "%s.mooring.lines", e->path);
    double mean = 0.5 * (xx + yy), half = 0.5 * (xx - yy);
    vec3 added = w->bodies.added_mass[body];
    warn_of_stiffness(ctx, s, name, mean + sqrt(half * half + xy * xy), w->bodies.mass[body] + fmin(added.x, added.y));
}

static void warn_of_springs(context *ctx, const scenario *s, const vessel_entry *e, const vessel_model *hull,
                            const world *w, int32_t row)
{
    if (e->keys->mode == VESSEL_PRESCRIBED)
        return;
    int32_t body = w->vessels.body[row];
    double weight = s->environment.water_density * s->environment.gravity;
    if (s->environment.water)
        warn_of_stiffness(ctx, s, "the buoyancy of the hull", weight * hull->floats.waterplane_area,
                          w->bodies.mass[body] + w->bodies.added_mass[body].z);
    warn_of_lines(ctx, s, e, w, row);
}

void vessel_warnings(context *ctx, const scenario *s, const vessel_entry *e, const model *m, const world *w,
                     int32_t row)
{
    const vessel_model *hull = &m->vessels.data[row];
    warn_of_stability(ctx, s, e, hull);
    warn_of_damping(ctx, e, hull);
    warn_of_springs(ctx, s, e, hull, w, row);
    wall_warnings(ctx, s, e, m, w, row);
}
