#include "sim/vessel_check.h"

#include "base/number_text.h"
#include "base/transcendental.h"
#include "geometry/polygon.h"
#include "sim/build_hull.h"
#include "sim/build_ice.h"
#include "sim/build_vessel.h"
#include "sim/matrix_check.h"
#include "sim/meeting_check.h"
#include "sim/munk_check.h"
#include "sim/rest_tell.h"
#include "sim/turning_tell.h"
#include "sim/usual.h"
#include "sim/wall_check.h"
#include "vessel/hull_axes.h"

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
/* By which part a place is known that was moved to the centre of gravity and back. */
#define PLACE_ROUNDED 1e-14

static fram_status entry_fault(const scenario *s, const vessel_entry *e, const char *member, const char *expected,
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
    const range_text range = range_text_of(least, most, 4);
    snprintf(expected, sizeof expected, "expected %s to %s kg, %s", range.least.text, range.most.text,
             mass > most ? "all that the hull can displace: it sinks"
                         : "a twentieth of what it displaces at its draught: it would be thrown out of the water");
    return entry_fault(s, e, "mass", expected, mass, "kg", error);
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
        double rounded = PLACE_ROUNDED * (fabs(centre[k]) + hi[k] - lo[k]);
        const range_text range = range_text_of(centre[k] + lo[k] - rounded, centre[k] + hi[k] + rounded, 4);
        snprintf(expected, sizeof expected, "expected a place %s, from %s to %s m",
                 k < 2 ? "inside the hull" : "between the bottom and the hull's depth above its top", range.least.text,
                 range.most.text);
        return entry_fault(s, e, keys[k], expected, centre[k], "m", error);
    }
    return FRAM_OK;
}

/* Largest distances of the hull from the three axes through the centre of gravity. */
static vec3 reach_about_axes(const mesh *surface)
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
    vec3 reach = reach_about_axes(&body->surface);
    const double far[3] = {reach.x, reach.y, reach.z};
    if (v->mode != VESSEL_FREE)
        return FRAM_OK;
    for (int i = 0; i < 3; i++) {
        char expected[160];
        double others = k[(i + 1) % 3] * k[(i + 1) % 3] + k[(i + 2) % 3] * k[(i + 2) % 3];
        if (is_automatic(given[i]))
            continue;
        const range_text range = range_text_of(LEAST_GYRATION * far[i], MOST_GYRATION * far[i], 4);
        snprintf(expected, sizeof expected, "expected %s to %s m, for the hull reaches %.4g m from the axis",
                 range.least.text, range.most.text, far[i]);
        if (!(k[i] >= LEAST_GYRATION * far[i] && k[i] <= MOST_GYRATION * far[i]))
            return entry_fault(s, e, keys[i], expected, k[i], "m", error);
        snprintf(expected, sizeof expected,
                 "expected %s m at most, the root of the sum of the squares of the other two, as of every body",
                 most_text_of(sqrt(others), 6).text);
        if (k[i] * k[i] > others * (1 + 1e-9))
            return entry_fault(s, e, keys[i], expected, k[i], "m", error);
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

/* Part of its diagonal by which a damping matrix may be beyond the edge of damping nothing: published ones have three
   digits. */
#define ROUNDED_DAMPING 1e-3

static const char *const motions[6] = {"surge", "sway", "heave", "roll", "pitch", "yaw"};

/* Beyond what the two motions damp: a motion of both gains.  Both halves of a coupling take power together, each force
   by the other one's motion. */
static double coupling_excess(const matrix6 *b, int i, int j)
{
    double coupling = fabs(matrix_coupling(b, i, j)), damped = sqrt(b->m[i][i] * b->m[j][j]);
    return damped > 0 ? coupling / damped - 1 : coupling > 0 ? HUGE_VAL : -1;
}

/* A diagonal of good numbers damps each motion by itself; what drives is the coupling of two, or of more. */
static void warn_of_couplings(context *ctx, const vessel_entry *e, const matrix6 *b)
{
    int first = 0, second = 0;
    double most = ROUNDED_DAMPING;
    for (int i = 0; i < 6; i++) {
        for (int j = i + 1; j < 6; j++) {
            double excess = coupling_excess(b, i, j);
            if (excess > most)
                most = excess, first = i, second = j;
        }
    }
    if (second > 0)
        log_write(ctx, LOG_WARNING,
                  "%s.hydrodynamics.damping is not positive between %s and %s, %.4g in the mean of both sides beside "
                  "%.4g and %.4g on the diagonal about the centre of mass: it drives a motion of both instead of "
                  "damping it",
                  e->path, motions[first], motions[second], matrix_coupling(b, first, second), b->m[first][first],
                  b->m[second][second]);
    else if (matrix_failing_row(b, ROUNDED_DAMPING) >= 0)
        log_write(ctx, LOG_WARNING,
                  "%s.hydrodynamics.damping is not positive, by its couplings of more than two motions: it drives a "
                  "motion of them instead of damping it",
                  e->path);
}

/* A carriage leaves heave alone to the water. */
static bool moves_freely(vessel_mode mode, int axis)
{
    return mode == VESSEL_FREE || (mode == VESSEL_TOWED && axis == 2);
}

/* Of a given matrix: a negative number on its diagonal drives the motion that it should damp. */
static void warn_of_damping(context *ctx, const scenario *s, const vessel_entry *e, const vessel_model *hull)
{
    bool damps_each = true;
    const matrix6 *b = &hull->hydrodynamics.damping;
    if (e->keys->hydrodynamics.source != HYDRODYNAMICS_GIVEN || !s->environment.water)
        return;
    for (int i = 0; i < 6; i++) {
        double c = b->m[i][i];
        damps_each = damps_each && c >= 0;
        if (c < 0 && moves_freely(e->keys->mode, i))
            log_write(ctx, LOG_WARNING,
                      "%s.hydrodynamics.damping is negative in %s, %.4g about the centre of mass: it drives that "
                      "motion instead of damping it",
                      e->path, motions[i], c);
    }
    if (damps_each && e->keys->mode == VESSEL_FREE)
        warn_of_couplings(ctx, e, b);
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

/* Steepest rise of a line's tension with the distance of its ends, of a table with the horizontal one [N/m]. */
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

static void warn_of_springs(context *ctx, const scenario *s, const vessel_entry *e, const hull_hydrostatics *upright,
                            const world *w, int32_t row)
{
    if (e->keys->mode == VESSEL_PRESCRIBED)
        return;
    int32_t body = w->vessels.body[row];
    double weight = s->environment.water_density * s->environment.gravity;
    char name[64];
    snprintf(name, sizeof name, "the buoyancy of %s", vessel_title_of(e).text);
    if (s->environment.water)
        warn_of_stiffness(ctx, s, name, weight * upright->waterplane_area,
                          w->bodies.mass[body] + w->bodies.added_mass[body].z);
    warn_of_lines(ctx, s, e, w, row);
}

/* ---- a hull from a file ---- */

/* Part of the length by which amidships may lie beside the middle of the waterline. */
#define OFF_AMIDSHIPS 0.2
/* Part of the beam by which the centre of buoyancy may lie beside the centre line. */
#define OFF_CENTRE 0.02
/* Part of its beam within which the side of half a hull stands in the centre line. */
#define ON_CENTRE 0.001
/* Beam over draught, as of hulls by particulars. */
#define SHALLOWEST 25.0

/* A file in other units than metres. */
static void mesh_size_warnings(context *ctx, const scenario *s, const vessel_entry *e, const hull_particulars *p)
{
    const usual_range usual = usual_range_of(s, "vessel.hull.length");
    const range_text range = range_text_of(usual.least, usual.most, 3);
    if (p->length > usual.most)
        log_write(ctx, LOG_WARNING,
                  "%s.hull.file: the waterline is %.4g m long, outside of %s to %s: a file in millimetres wants "
                  "hull.file_scale 0.001, in centimetres 0.01, in inches 0.0254, in feet 0.3048",
                  e->path, p->length, range.least.text, range.most.text);
    if (p->length < usual.least)
        log_write(ctx, LOG_WARNING,
                  "%s.hull.file: the waterline is %.4g m long, outside of %s to %s: hull.file_scale, now %g, is too "
                  "small, or give run.scale of a model",
                  e->path, p->length, range.least.text, range.most.text, e->keys->hull.file_scale);
}

/* Turned, or elsewhere in plan than where ships are told. */
static void mesh_place_warnings(context *ctx, const vessel_entry *e, const vessel_model *m, hull_axes axes)
{
    const hull_particulars *p = &m->particulars;
    if (axes == HULL_Y_FORWARD)
        log_write(ctx, LOG_WARNING,
                  "%s.hull.file: the hull is %.4g m wide along y and %.4g m long along x: x is to be forward: turn the "
                  "mesh",
                  e->path, p->beam, p->length);
    if (axes == HULL_Y_UP)
        log_write(ctx, LOG_WARNING,
                  "%s.hull.file: the two sides of the hull lie about z = 0, not about y = 0: z is to be up, and y to "
                  "port: turn the mesh",
                  e->path);
    /* To be turned first, and looked at again. */
    if (axes == HULL_AXES_OF_SHIPS && fabs(p->midships) > OFF_AMIDSHIPS * p->length)
        log_write(ctx, LOG_WARNING,
                  "%s.hull.file: the waterline of %.4g m lies about x = %.4g m, not about x = 0, amidships: all places "
                  "on the ship are counted from there; move the mesh",
                  e->path, p->length, p->midships);
    const vec3 buoyancy = m->floats.centre_of_buoyancy;
    const box2 line = m->floats.waterline;
    bool one_side = fmin(fabs(line.lo.y), fabs(line.hi.y)) < ON_CENTRE * p->beam;
    if (axes == HULL_AXES_OF_SHIPS && m->floats.volume > 0 && fabs(buoyancy.y) > OFF_CENTRE * p->beam)
        log_write(ctx, LOG_WARNING,
                  "%s.hull.file: the hull lies about y = %.4g m, not about y = 0, the centre line: all places on the "
                  "ship are counted from there; %s",
                  e->path, buoyancy.y, one_side ? "mirror the mesh if it is half a hull, or move it" : "move the mesh");
}

/* Elsewhere in height. */
static void mesh_height_warnings(context *ctx, const scenario *s, const vessel_entry *e, const hull_particulars *p)
{
    if (p->beam > SHALLOWEST * p->draught)
        log_write(ctx, LOG_WARNING,
                  "%s.hull.file: the mesh reaches %.3g m under its z = 0, the design waterline, with a beam of %.4g m: "
                  "move it down by the draught",
                  e->path, p->draught, p->beam);
    const usual_range deck = usual_range_of(s, "vessel.hull.freeboard");
    if (p->freeboard < deck.least)
        log_write(ctx, LOG_WARNING,
                  "%s.hull.file: the hull ends %.3g m above its z = 0, the design waterline, and no deck is lower than "
                  "%.3g m: move the mesh up or give it topsides; hull.freeboard raises an open top",
                  e->path, p->freeboard, deck.least);
    /* A file in millimetres is told as that. */
    if (p->freeboard > deck.most && p->length <= usual_range_of(s, "vessel.hull.length").most)
        log_write(ctx, LOG_WARNING,
                  "%s.hull.file: the hull ends %.4g m above its z = 0, the design waterline, and decks are no higher "
                  "than %.3g m: give hull.freeboard in metres, or move the mesh down",
                  e->path, p->freeboard, deck.most);
}

void vessel_mesh_warnings(context *ctx, const scenario *s, const vessel_entry *e, const model *of, int32_t row)
{
    const vessel_model *m = &of->vessels.data[row];
    const hull_particulars *p = &m->particulars;
    if (e->keys->hull.form != HULL_MESH)
        return;
    mesh_size_warnings(ctx, s, e, p);
    mesh_place_warnings(ctx, e, m,
                        hull_axes_of(&of->solids.data[m->solid].surface, vec3_neg(m->centre), p->length, p->beam));
    mesh_height_warnings(ctx, s, e, p);
}

/* ---- floes that are listed ---- */

/* Part of the smaller footprint within the other from which on one begins inside the other; a bow reaches over a floe
   that it only touches. */
#define INSIDE 0.5
/* As many as the key of a floe's sides allows. */
enum { FLOE_SIDES_MOST = 64 };

/* Outline of a floe as it is given, level. */
static int32_t floe_outline(const scenario_floe *f, vec2 out[FLOE_SIDES_MOST])
{
    int32_t n = f->shape == FLOE_REGULAR ? (int32_t)f->sides : 4;
    double c = real_cos(radians(f->yaw_deg)), d = real_sin(radians(f->yaw_deg));
    for (int32_t i = 0; i < n; i++) {
        double angle = 2 * PI * i / n;
        vec2 v = {f->radius * real_cos(angle), f->radius * real_sin(angle)};
        if (f->shape != FLOE_REGULAR)
            v = (vec2){(i == 0 || i == 3 ? 0.5 : -0.5) * f->length, (i < 2 ? 0.5 : -0.5) * f->width};
        out[i] = (vec2){f->x + c * v.x - d * v.y, f->y + d * v.x + c * v.y};
    }
    return n;
}

/* What of a hull is as high as ice of a thickness that floats. */
static fram_status plan_in_ice(context *ctx, const scenario *s, const world *w, int32_t row, double thickness,
                               polygon_list *out, fram_error *error)
{
    polygon_list_clear(out);
    return build_plan(ctx, w, w->vessels.body[row], build_slab_of_ice(s, thickness), out, error);
}

static fram_status warn_of_floes(context *ctx, const scenario *s, const vessel_entry *e, const world *w, int32_t row,
                                 fram_error *error)
{
    const scenario_ice *ice = &s->ice;
    polygon_list hull = {0};
    double looked_at = 0; /* thickness [m] */
    fram_status status = FRAM_OK;
    for (int32_t i = 0; i < ice->floes.count && ice->source == ICE_FLOES && status == FRAM_OK; i++) {
        const scenario_floe *f = &ice->floes.data[i];
        double thickness = automatic_or(f->thickness, ice->thickness);
        vec2 corner[FLOE_SIDES_MOST];
        polygon floe = {corner, floe_outline(f, corner)};
        if (thickness != looked_at)
            status = plan_in_ice(ctx, s, w, row, thickness, &hull, error);
        looked_at = thickness;
        double common = build_plan_overlap(&hull, floe), least = fmin(build_plan_area(&hull), polygon_area(floe));
        if (is_automatic(f->elevation) && common > INSIDE * least)
            log_write(ctx, LOG_WARNING,
                      "ice.floes[%d]: %.4g m2 of the floe at (%s, %s) m lie inside the hull of %s at the start: move "
                      "one of them",
                      (int)i, common, coordinate_text_of(f->x).text, coordinate_text_of(f->y).text,
                      vessel_title_of(e).text);
    }
    polygon_list_free(ctx, &hull);
    return status;
}

fram_status vessel_warnings(context *ctx, const scenario *s, const vessel_entry *e, const model *m, const world *w,
                            int32_t row, fram_error *error)
{
    const vessel_model *hull = &m->vessels.data[row];
    fram_status status = warn_of_floes(ctx, s, e, w, row, error);
    hull_hydrostatics upright = hull->floats;
    if (status == FRAM_OK)
        status = build_upright(ctx, s, e, hull, &m->solids.data[hull->solid], &upright, error);
    rest_tell(ctx, s, e, hull, &upright, w, row);
    warn_of_damping(ctx, s, e, hull);
    munk_warnings(ctx, s, e, m, row);
    warn_of_springs(ctx, s, e, &upright, w, row);
    wall_warnings(ctx, s, e, m, w, row);
    meeting_warnings(ctx, s, e, m, w, row);
    turning_tell(ctx, s, e, m, w, row);
    return status;
}
