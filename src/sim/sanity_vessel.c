#include "base/load_unit.h"
#include "base/number_text.h"
#include "sim/ice_kinds.h"
#include "sim/sanity_parts.h"
#include "sim/vessel_speed.h"
#include "vessel/plane_motion.h"

#include <math.h>

/* ---- the ship ---- */

/* Radii of gyration over beam and length: 0.3 to 0.45 and 0.2 to 0.3 are usual (Lewis 1989, Principles of Naval
   Architecture III); under and over these a part of the length was given for metres, or metres of another ship.  What
   stands deeper than it is long and wide, as a spar, has its mass spread over its height. */
#define ROLL_LEAST 0.15
#define ROLL_MOST 0.7
#define YAW_LEAST 0.1
#define YAW_MOST 0.6

static void tell_gyration(const teller *t, const char *key, double radius, const char *of, double size, double least,
                          double most)
{
    if (is_automatic(radius) || (radius >= least * size && radius <= most * size))
        return;
    sanity_say(t->tell, t->to, "%s.%s: %.4g m is %.3g of the %s, %.4g m, outside of %.2g to %.2g: give metres",
               t->e->path, key, radius, radius / size, of, size, least, most);
}

static void tell_inertia(const teller *t)
{
    const scenario_vessel *v = t->e->keys;
    if (!sanity_own_hull(v) || v->mode == VESSEL_PRESCRIBED)
        return;
    double height = v->hull.draught + scenario_freeboard(t->s, &v->hull);
    tell_gyration(t, "gyration_roll", v->gyration_roll, height > v->hull.beam ? "height" : "beam",
                  fmax(v->hull.beam, height), ROLL_LEAST, ROLL_MOST);
    tell_gyration(t, "gyration_pitch", v->gyration_pitch, height > v->hull.length ? "height" : "length",
                  fmax(v->hull.length, height), YAW_LEAST, YAW_MOST);
    bool wide = v->hull.beam > v->hull.length;
    tell_gyration(t, "gyration_yaw", v->gyration_yaw, wide ? "beam" : "length", fmax(v->hull.length, v->hull.beam),
                  YAW_LEAST, YAW_MOST);
}

/* ---- what stands on it ---- */

/* Parts of the half length and beam beyond which nothing stands: the hull's ends overhang the waterline. */
#define OVERHANG 1.3

static void tell_thrusters(const teller *t)
{
    const scenario_vessel *v = t->e->keys;
    for (int32_t i = 0; i < v->thrusters.count; i++) {
        const scenario_thruster *p = &v->thrusters.data[i];
        bool off = fabs(p->x) > OVERHANG * v->hull.length / 2 || fabs(p->y) > OVERHANG * v->hull.beam / 2;
        if (sanity_own_hull(v) && off)
            sanity_say(t->tell, t->to, "%s.thrusters[%d]: (%.4g, %.4g) m is outside of a hull of %.4g m by %.4g m",
                       t->e->path, (int)i, p->x, p->y, v->hull.length, v->hull.beam);
        if (!is_automatic(p->failure_time) && p->failure_time > t->s->run.duration)
            sanity_say(t->tell, t->to, "%s.thrusters[%d].failure_time: %g s is after the end of the run, %g s",
                       t->e->path, (int)i, p->failure_time, t->s->run.duration);
        if (sanity_own_hull(v) && !is_automatic(p->diameter) && p->diameter > v->hull.draught)
            sanity_say(t->tell, t->to, "%s.thrusters[%d].diameter: %.4g m is more than the draught, %.4g m", t->e->path,
                       (int)i, p->diameter, v->hull.draught);
    }
}

static void tell_vessel_propulsion(const teller *t)
{
    const scenario_vessel *v = t->e->keys;
    const scenario_propulsion *p = &v->propulsion;
    if (!vessel_drives_itself(v))
        return;
    double most = vessel_open_water_speed(p);
    if (!is_automatic(p->speed) && p->speed > most)
        sanity_say(t->tell, t->to,
                   "%s.propulsion.speed: %.4g m/s is more than the ship makes in open water at that power, %.4g m/s",
                   t->e->path, p->speed, most);
    if (sanity_own_hull(v) && !is_automatic(p->propeller_diameter) && p->propeller_diameter > v->hull.draught)
        sanity_say(t->tell, t->to, "%s.propulsion.propeller_diameter: %.4g m is more than the draught, %.4g m",
                   t->e->path, p->propeller_diameter, v->hull.draught);
    const scenario_domain *d = &t->s->domain;
    for (int32_t i = 0; i < p->waypoints.count && d->boundary == DOMAIN_OPEN && t->s->ice.source != ICE_NONE; i++) {
        const scenario_course_point *w = &p->waypoints.data[i];
        double way = sqrt((w->x - v->x) * (w->x - v->x) + (w->y - v->y) * (w->y - v->y));
        /* A point far ahead gives a course. */
        if (way > vessel_fastest(v) * t->s->run.duration)
            return;
        if (domain_has(d, w->x, w->y))
            continue;
        sanity_say(t->tell, t->to,
                   "%s.propulsion.waypoints[%d]: (%s, %s) m lies outside of the domain, where there is no ice",
                   t->e->path, (int)i, coordinate_text_of(w->x).text, coordinate_text_of(w->y).text);
        return;
    }
}

/* ---- its mooring ---- */

/* Axial stiffness over breaking load, which is one over the strain at which a line would part if it stayed linear: 60
   to 130 of chain and wire, 5 to 30 of polyester, 3 of nylon (API RP 2SK 2005; Flory et al. 2007). */
#define STIFFNESS_LEAST 1.0
#define STIFFNESS_MOST 2000.0
/* Horizontal distance to the anchor over the way down to it: chains and wires have several, taut legs of rope 1 to 1.5
   (API RP 2SK 2005), in deep water a little less.  Under it a line pulls more down than aside, and up on its anchor;
   what is to pull straight down, as a tension leg, stretches alone and hangs in no bow: a spring. */
#define SCOPE_LEAST 0.7
/* Length of line that the breaking load carries at full size [m]: 5 km of chain, 15 km of wire. */
#define OWN_WEIGHT 1e3
/* Freeboards to which fairleads go up, and draughts to which they go down: chains leave the bottom of a turret. */
#define MOST_HEIGHT 2.0
#define MOST_SINKING 2.0
/* A full turn with what rounding leaves of a spacing [deg]. */
#define FULL_CIRCLE 360.5

static void tell_line(const teller *t, int32_t i)
{
    const scenario_vessel *v = t->e->keys;
    const scenario_mooring_line *l = &v->mooring.lines.data[i];
    const scenario_run *r = &t->s->run;
    double ratio = l->stiffness / automatic_or(l->breaking_load, (double)NAN);
    if (l->kind == LINE_CATENARY && (ratio < STIFFNESS_LEAST || ratio > STIFFNESS_MOST))
        sanity_say(t->tell, t->to,
                   "%s.mooring.lines[%d].stiffness: EA of %s is %.3g breaking loads, chain and wire have 60 to 130, "
                   "ropes 3 to 30: give newtons",
                   t->e->path, (int)i, load_text_of(l->stiffness, 4).text, ratio);
    double down = v->mooring.depth + v->mooring.z, straight = sqrt(l->distance * l->distance + down * down);
    if (l->kind == LINE_CATENARY && l->distance < SCOPE_LEAST * down)
        sanity_say(
            t->tell, t->to,
            "%s.mooring.lines[%d].distance: an anchor %.4g m off and %.4g m down: the line pulls more down than "
            "aside, and up on its anchor; anchors of chains lie several depths off, of taut legs about one depth: give "
            "metres, or for a leg that pulls straight down kind: spring with stiffness EA over length, %.3g N/m",
            t->e->path, (int)i, l->distance, down, l->stiffness / automatic_or(l->length, straight));
    if (l->count > 1 && (double)l->count * fabs(l->spacing_deg) > FULL_CIRCLE)
        sanity_say(t->tell, t->to,
                   "%s.mooring.lines[%d].spacing_deg: %d lines at %g degrees go round more than once: give the angle "
                   "between neighbours",
                   t->e->path, (int)i, (int)l->count, l->spacing_deg);
    if (l->count > 1 && fabs(l->spacing_deg) < 1e-9)
        sanity_say(t->tell, t->to, "%s.mooring.lines[%d].spacing_deg: %d lines lie one upon another at 0 degrees apart",
                   t->e->path, (int)i, (int)l->count);
    double own_weight = OWN_WEIGHT * fmin(1, usual_at_scale(t->s, 1)) * l->weight;
    if (l->kind == LINE_CATENARY && automatic_or(l->breaking_load, HUGE_VAL) < own_weight)
        sanity_say(t->tell, t->to,
                   "%s.mooring.lines[%d].weight: a line of %.4g N/m parts under %.3g m of itself: give N/m", t->e->path,
                   (int)i, l->weight, l->breaking_load / l->weight);
    if (!is_automatic(l->release_time) && l->release_time > 0 && l->release_time < r->transient)
        sanity_say(t->tell, t->to,
                   "%s.mooring.lines[%d].release_time: it is let go at %g s, in the transient of %g s that statistics "
                   "leave out: give seconds, or leave the line out",
                   t->e->path, (int)i, l->release_time, r->transient);
    if (!is_automatic(l->release_time) && l->release_time > r->duration)
        sanity_say(t->tell, t->to, "%s.mooring.lines[%d].release_time: %g s is after the end of the run, %g s",
                   t->e->path, (int)i, l->release_time, r->duration);
}

/* How far to the side the lines of an item come aboard, anywhere on the circle of a turret that turns [m]. */
static double fairlead_aside(const scenario_vessel *v, const scenario_mooring_line *l)
{
    const scenario_mooring *m = &v->mooring;
    double most = m->turret ? fabs(m->y) + l->fairlead_distance : 0;
    for (int64_t k = 0; k < l->count && !m->turret; k++) {
        double angle = radians(l->direction_deg + (double)k * l->spacing_deg - v->heading_deg);
        most = fmax(most, fabs(m->y + l->fairlead_distance * real_sin(angle)));
    }
    return most;
}

/* Where the lines come aboard, told once for all of them. */
static void tell_fairleads(const teller *t)
{
    const scenario_vessel *v = t->e->keys;
    const scenario_mooring *m = &v->mooring;
    if (m->lines.count == 0 || !sanity_own_hull(v))
        return;
    double farthest = 0, aside = 0;
    for (int32_t i = 0; i < m->lines.count; i++) {
        farthest = fmax(farthest, fabs(m->x) + m->lines.data[i].fairlead_distance);
        aside = fmax(aside, fairlead_aside(v, &m->lines.data[i]));
    }
    if (farthest > OVERHANG * v->hull.length)
        sanity_say(t->tell, t->to, "%s.mooring: fairleads %.4g m from amidships are outside of a hull of %.4g m",
                   t->e->path, farthest, v->hull.length);
    if (aside > OVERHANG * v->hull.beam / 2)
        sanity_say(t->tell, t->to,
                   "%s.mooring: fairleads %.4g m to the side are outside of a hull of %.4g m beam: see mooring.y and "
                   "fairlead_distance",
                   t->e->path, aside, v->hull.beam);
    if (m->z > MOST_HEIGHT * scenario_freeboard(t->s, &v->hull))
        sanity_say(t->tell, t->to,
                   "%s.mooring.z: fairleads %.4g m above the design waterline, over a deck at %.4g m: give metres, "
                   "negative under water",
                   t->e->path, m->z, scenario_freeboard(t->s, &v->hull));
    if (-m->z > MOST_SINKING * v->hull.draught)
        sanity_say(t->tell, t->to,
                   "%s.mooring.z: fairleads %.4g m under the design waterline, far under a keel at %.4g m: give metres "
                   "from the waterline, not from the bottom or the deck",
                   t->e->path, -m->z, v->hull.draught);
}

/* ---- its way ---- */

/* Angle of drift from which on a ship is rather turned the wrong way [deg]. */
#define MOST_DRIFT 60
/* Fastest way between two points at full size [m/s]. */
#define FASTEST_LEG 12.0
/* Fastest turn between them at full size [deg/s]. */
#define FASTEST_TURN 10.0
/* Runs that a path is long. */
#define MOST_PATH 10

/* Whether the leg that ends at a point is too fast. */
static bool tell_leg(const teller *t, int32_t i)
{
    const scenario_path_point *to = &t->e->keys->path.data[i], *from = to - 1;
    double x = to->x - from->x, y = to->y - from->y, time = to->time - from->time;
    double speed = sqrt(x * x + y * y) / time;
    double most = FASTEST_LEG * fmax(1, usual_at_scale(t->s, 0.5));
    double turn = fabs(to->heading_deg - from->heading_deg) / time;
    double fastest = FASTEST_TURN * fmax(1, usual_at_scale(t->s, -0.5));
    if (time > 0 && speed <= most && turn > fastest)
        sanity_say(
            t->tell, t->to,
            "%s.path[%d].heading_deg: from %g to %g degrees it turns with %.4g deg/s, faster than vessels do: give "
            "the point a later time or a nearer heading, in degrees",
            t->e->path, (int)i, from->heading_deg, to->heading_deg, turn);
    if (!(time > 0) || speed <= most)
        return turn > fastest;
    sanity_say(t->tell, t->to, "%s.path[%d]: (%s, %s) m is reached with %.4g m/s: give seconds and metres", t->e->path,
               (int)i, coordinate_text_of(to->x).text, coordinate_text_of(to->y).text, speed);
    return true;
}

/* The first point of a path that a vessel comes to in the run and that lies beyond an edge that is no wall. */
static void tell_path_outside(const teller *t)
{
    const scenario_vessel *v = t->e->keys;
    const scenario_domain *d = &t->s->domain;
    bool ends = d->boundary != DOMAIN_WALLS && t->s->ice.source != ICE_NONE && v->mode != VESSEL_FREE;
    for (int32_t i = 0; ends && i < v->path.count; i++) {
        const scenario_path_point *p = &v->path.data[i];
        if (domain_has(d, p->x, p->y) || p->time > t->s->run.duration)
            continue;
        sanity_say(t->tell, t->to,
                   "%s.path[%d]: (%s, %s) m, at t = %.4g s, lies outside of the domain, where there is no ice",
                   t->e->path, (int)i, coordinate_text_of(p->x).text, coordinate_text_of(p->y).text, p->time);
        return;
    }
}

static void tell_motion(const teller *t)
{
    const scenario_vessel *v = t->e->keys;
    const scenario_run *r = &t->s->run;
    double drift = sanity_degrees_apart(automatic_or(v->course_deg, v->heading_deg), v->heading_deg);
    if (v->mode != VESSEL_FREE && v->speed > 0 && v->path.count == 0 && v->hull.form != HULL_CONE && drift > MOST_DRIFT)
        sanity_say(t->tell, t->to,
                   "%s.course_deg: the vessel is moved at %.4g degrees to its bow, towards %.4g with its heading at "
                   "%.4g: both are counter-clockwise from X",
                   t->e->path, drift, automatic_or(v->course_deg, v->heading_deg), v->heading_deg);
    double way = vessel_way(v, r->duration), thinnest = ice_range_made(&t->s->ice, t->made).thinnest.thickness;
    if (v->mode != VESSEL_FREE && v->speed > 0 && v->path.count == 0 && way < thinnest &&
        t->s->ice.source != ICE_NONE && t->s->domain.boundary != DOMAIN_FEEDING)
        sanity_say(t->tell, t->to, "%s.speed: the vessel moves %.3g m in the run, less than the ice is thick: give m/s",
                   t->e->path, way);
    for (int32_t i = 1; v->mode != VESSEL_FREE && i < v->path.count; i++)
        if (tell_leg(t, i))
            break;
    if (v->mode != VESSEL_FREE && v->path.count > 1 && v->path.data[v->path.count - 1].time > MOST_PATH * r->duration)
        sanity_say(t->tell, t->to, "%s.path: it goes on to %.4g s, and the run ends at %.4g s: give seconds",
                   t->e->path, v->path.data[v->path.count - 1].time, r->duration);
    if (v->mode != VESSEL_FREE && v->speed > 0 && v->path.count == 0 && v->ramp >= r->duration)
        sanity_say(t->tell, t->to, "%s.ramp: %g s is not over when the run ends, at %g s", t->e->path, v->ramp,
                   r->duration);
    tell_path_outside(t);
    const scenario_domain *d = &t->s->domain;
    const scenario_positioning *p = &v->positioning;
    bool goes = p->active && p->control != CONTROL_HEADING && d->boundary != DOMAIN_WALLS;
    for (int32_t i = 0; goes && i < p->waypoints.count; i++) {
        const scenario_waypoint *w = &p->waypoints.data[i];
        if (domain_has(d, w->x, w->y))
            continue;
        sanity_say(t->tell, t->to, "%s.positioning.waypoints[%d]: (%s, %s) m lies outside of the domain", t->e->path,
                   (int)i, coordinate_text_of(w->x).text, coordinate_text_of(w->y).text);
        return;
    }
}

/* Without water a free vessel floats on nothing; that is of use while nothing but contacts acts on it. */
static void tell_dry(const teller *t)
{
    const scenario_vessel *v = t->e->keys;
    bool pulled =
        v->mooring.lines.count > 0 || sanity_has_settings(v) || sanity_is_positioned(v) || vessel_drives_itself(v);
    if (v->mode == VESSEL_FREE && pulled && !t->s->environment.water)
        sanity_say(t->tell, t->to,
                   "%s: without water (environment.water: false) nothing holds it upright and afloat: its lines, "
                   "thrusters or propulsion pull it over and down; take %s.mode: towed, or environment.water: true",
                   t->e->path, t->e->path);
}

/* ---- areas of the wind and the current ---- */

/* Over length or beam times draught or freeboard. */
#define AREA_LEAST 0.1
#define AREA_MOST 30.0

static void tell_area(const teller *t, const char *key, double area, double own)
{
    if (!is_automatic(area) && (area < AREA_LEAST * own || area > AREA_MOST * own))
        sanity_say(t->tell, t->to, "%s.%s: %.4g m2 is %.3g of what the hull shows, %.4g m2: give square metres",
                   t->e->path, key, area, area / own, own);
}

/* A current across the hull that matters to its station, at full size [m/s]. */
#define ACROSS_LEAST 0.2
/* Form drag under which a hull is rather one that goes ahead; bluff sides in cross flow have 0.6 to 1.2 (Hoerner 1965,
   Fluid-Dynamic Drag). */
#define SIDE_LEAST 0.4

/* Given damping acts on the water's motion past the hull: with such in sway its side has drag whatever its form. */
static bool is_damped_in_sway(const scenario_hydrodynamics *h)
{
    return h->source == HYDRODYNAMICS_GIVEN && h->damping.count > 1 && h->damping.data[1].sway > 0;
}

bool sanity_drags_as_ahead(const scenario *s, const scenario_vessel *v, double across)
{
    const scenario_environment *n = &s->environment;
    bool faces = v->current_coefficients.table.count == 0 && v->current_coefficients.table_file[0] == '\0';
    return faces && n->water && v->hull.form != HULL_CONE && !is_damped_in_sway(&v->hydrodynamics) &&
           n->hull_drag.water_form < SIDE_LEAST && across >= ACROSS_LEAST * usual_at_scale(s, 0.5);
}

vec3 sanity_start(const scenario *s, int32_t vessel, const world *made)
{
    const scenario_vessel *v = scenario_vessel_entry(s, vessel).keys;
    if (!made || !vessel_begins_at_equilibrium(v))
        return vec3_make(v->x, v->y, v->path.count > 0 ? v->path.data[0].heading_deg : v->heading_deg);
    int32_t body = made->vessels.body[vessel];
    vec3 at = body_to_global(&made->bodies, body, vec3_scale(made->vessels.centre[vessel], -1));
    return vec3_make(at.x, at.y, degrees(quat_roll_pitch_yaw(made->bodies.orientation[body]).z));
}

/* The current that the hull as a whole meets at the start, towards port at that heading [m/s]; 0 where a file has it
   that nobody has read. */
static double current_aside(const teller *t, int32_t vessel, double heading)
{
    const scenario_environment *n = &t->s->environment;
    if (t->model) {
        const media begins = media_at(&t->model->media, &t->model->history, 0);
        const vec3 met = media_hull_current(&begins, t->model->vessels.data[vessel].hydrodynamics.depth);
        return plane_to_vessel(heading, met).y;
    }
    bool unread = n->current_file[0] != '\0' || n->current_profile_file[0] != '\0';
    return unread ? 0 : n->current_speed * real_sin(radians(n->current_direction_deg) - heading);
}

/* A vessel kept on station in a beam current with the drag of a hull that goes ahead: where it is known how it lies. */
static void tell_current_across(const teller *t, int32_t vessel)
{
    const scenario_vessel *v = t->e->keys;
    const scenario_environment *n = &t->s->environment;
    bool kept = v->mode == VESSEL_FREE && (v->mooring.lines.count > 0 || v->positioning.active) &&
                (t->made || !vessel_begins_at_equilibrium(v));
    double across = fabs(current_aside(t, vessel, radians(sanity_start(t->s, vessel, t->made).z)));
    if (!kept || !sanity_drags_as_ahead(t->s, v, across))
        return;
    sanity_say(
        t->tell, t->to,
        "%s: a current of %.3g m/s comes across the hull, and environment.hull_drag.water_form is %.3g, of a hull "
        "that goes ahead: a ship's side has about 1; give that, or %s.current_coefficients",
        t->e->path, across, n->hull_drag.water_form, t->e->path);
}

/* A ship that is to turn as its track does: without the drag of its side it slides outward, and swings about it. */
static void tell_drag_of_turns(const teller *t)
{
    const scenario_vessel *v = t->e->keys;
    const scenario_propulsion *p = &v->propulsion;
    bool bends = p->waypoints.count > 1 || (p->pattern.kind != PATTERN_NONE && p->pattern.kind != PATTERN_AHEAD);
    if (v->mode != VESSEL_FREE || !vessel_drives_itself(v) || !bends)
        return;
    double speed = fmin(p->open_water_speed, automatic_or(p->speed, HUGE_VAL));
    if (sanity_drags_as_ahead(t->s, v, speed))
        sanity_say(t->tell, t->to,
                   "%s.propulsion: its track has turns, and environment.hull_drag.water_form is %.3g, of a hull that "
                   "goes ahead: one that turns slides aside, and a ship's side has about 1; give that, or "
                   "%s.current_coefficients, else it may swing about its track",
                   t->e->path, t->s->environment.hull_drag.water_form, t->e->path);
}

static void tell_flows(const teller *t)
{
    const scenario_vessel *v = t->e->keys;
    const scenario_hull *h = &v->hull;
    if (!sanity_own_hull(v))
        return;
    tell_area(t, "current_coefficients.frontal_area", v->current_coefficients.frontal_area, h->beam * h->draught);
    tell_area(t, "current_coefficients.lateral_area", v->current_coefficients.lateral_area, h->length * h->draught);
    const double freeboard = scenario_freeboard(t->s, h);
    tell_area(t, "wind_coefficients.frontal_area", v->wind_coefficients.frontal_area, h->beam * freeboard);
    tell_area(t, "wind_coefficients.lateral_area", v->wind_coefficients.lateral_area, h->length * freeboard);
}

void sanity_tell_vessel(const scenario *s, int32_t vessel, sanity_built built, sanity_teller tell, const void *to)
{
    const vessel_entry entry = scenario_vessel_entry(s, vessel), *e = &entry;
    const teller t = {s, tell, to, e, built.made, built.model, built.read};
    tell_inertia(&t);
    tell_thrusters(&t);
    tell_vessel_propulsion(&t);
    for (int32_t i = 0; i < e->keys->mooring.lines.count; i++)
        tell_line(&t, i);
    tell_fairleads(&t);
    tell_motion(&t);
    tell_dry(&t);
    tell_current_across(&t, vessel);
    tell_drag_of_turns(&t);
    tell_flows(&t);
}
