#include "sim/wall_check.h"

#include "base/number_text.h"
#include "base/transcendental.h"
#include "sim/events_tell.h"
#include "sim/vessel_speed.h"
#include "vessel/plane_motion.h"

#include <math.h>

/* ---- before a run ---- */

/* Reach of the hull from its centre of mass along global X and Y, at a heading. */
static box2 plan_reach(const vessel_model *hull, double heading)
{
    double c = real_cos(heading), d = real_sin(heading);
    box2 out = {{0, 0}, {0, 0}};
    for (int32_t i = 0; i < hull->plan.count; i++) {
        vec2 v = hull->plan.data[i];
        double x = c * v.x - d * v.y, y = d * v.x + c * v.y;
        out.lo.x = fmin(out.lo.x, x), out.hi.x = fmax(out.hi.x, x);
        out.lo.y = fmin(out.lo.y, y), out.hi.y = fmax(out.hi.y, y);
    }
    return out;
}

/* The same from the ship's origin, by which places are given. */
static box2 reach_about_origin(const vessel_model *hull, double heading)
{
    vec3 off = plane_to_global(heading, vec3_make(hull->centre.x, hull->centre.y, 0));
    box2 reach = plan_reach(hull, heading);
    return (box2){{reach.lo.x + off.x, reach.lo.y + off.y}, {reach.hi.x + off.x, reach.hi.y + off.y}};
}

static bool is_clear(box2 domain, vec2 centre, box2 reach)
{
    return centre.x + reach.lo.x >= domain.lo.x && centre.x + reach.hi.x <= domain.hi.x &&
           centre.y + reach.lo.y >= domain.lo.y && centre.y + reach.hi.y <= domain.hi.y;
}

/* Way that is left along one axis before the hull is at a wall. */
static double way_left(double lo, double hi, double least, double most, double direction)
{
    if (direction > 0)
        return (most - hi) / direction;
    return direction < 0 ? (least - lo) / direction : HUGE_VAL;
}

/* For a vessel whose motion is given: what to do about it. */
#define DRIVEN_ON                                                                                                  \
    "; no wall stops a vessel whose motion is given, and loads are then those of the wall: shorten run.duration, " \
    "enlarge the domain, or give another course"

static void warn_of_course(context *ctx, const scenario *s, const vessel_entry *e, vec3 at, const vessel_model *hull)
{
    const scenario_vessel *v = e->keys;
    const scenario_domain *d = &s->domain;
    bool is_free = v->mode == VESSEL_FREE;
    double speed = vessel_fastest(v);
    if (!vessel_keeps_course(v) || !(speed > 0))
        return;
    double course = radians(is_free ? v->heading_deg : automatic_or(v->course_deg, v->heading_deg));
    box2 reach = plan_reach(hull, radians(v->heading_deg));
    double way = fmin(way_left(at.x + reach.lo.x, at.x + reach.hi.x, d->x_min, d->x_max, real_cos(course)),
                      way_left(at.y + reach.lo.y, at.y + reach.hi.y, d->y_min, d->y_max, real_sin(course)));
    /* A speed that grows evenly over the ramp. */
    double ramp = is_free ? 0 : v->ramp;
    double time = way < 0.5 * speed * ramp ? sqrt(2 * way * ramp / speed) : way / speed + 0.5 * ramp;
    if (time >= s->run.duration)
        return;
    if (is_free)
        log_write(ctx, LOG_WARNING,
                  "%s can reach a wall of the domain, %.4g m ahead of the hull, at t = %.4g s if it makes %.3g m/s: "
                  "shorten run.duration, enlarge the domain, or give propulsion.waypoints",
                  vessel_title_of(e).text, way, time, speed);
    else
        log_write(ctx, LOG_WARNING,
                  "%s.speed: the hull reaches a wall of the domain at t = %.4g s, after %.4g m" DRIVEN_ON, e->path,
                  time, way);
}

/* ---- a path ---- */

/* Steps of a leg at which it is asked where the hull is; halvings of the one in which it reaches a wall. */
enum { LEG_STEPS = 64, LEG_HALVINGS = 40 };

static bool is_clear_on(const scenario *s, const vessel_model *hull, const scenario_path_point *from,
                        const scenario_path_point *to, double share)
{
    double heading = radians(from->heading_deg + share * (to->heading_deg - from->heading_deg));
    double c = real_cos(heading), r = real_sin(heading);
    vec2 centre = {from->x + share * (to->x - from->x) + c * hull->centre.x - r * hull->centre.y,
                   from->y + share * (to->y - from->y) + r * hull->centre.x + c * hull->centre.y};
    return is_clear(domain_box(&s->domain), centre, plan_reach(hull, heading));
}

/* Share of a leg at which the hull reaches a wall; over 1: it does not. */
static double leg_reaches(const scenario *s, const vessel_model *hull, const scenario_path_point *from,
                          const scenario_path_point *to)
{
    for (int k = 0; k <= LEG_STEPS; k++) {
        double high = (double)k / LEG_STEPS, low = (double)(k > 0 ? k - 1 : 0) / LEG_STEPS;
        if (is_clear_on(s, hull, from, to, high))
            continue;
        for (int i = 0; i < LEG_HALVINGS; i++) {
            double middle = 0.5 * (low + high);
            if (is_clear_on(s, hull, from, to, middle))
                low = middle;
            else
                high = middle;
        }
        return high;
    }
    return 2;
}

/* Motion that is given by points: the first moment at which the hull reaches a wall on its way between them. */
static void warn_of_path(context *ctx, const scenario *s, const vessel_entry *e, const vessel_model *hull)
{
    const scenario_vessel *v = e->keys;
    for (int32_t i = 0; v->mode != VESSEL_FREE && i < v->path.count; i++) {
        const scenario_path_point *to = &v->path.data[i], *from = i > 0 ? to - 1 : to;
        double share = leg_reaches(s, hull, from, to), time = from->time + share * (to->time - from->time);
        if (from->time >= s->run.duration)
            return;
        if (share > 1 || time >= s->run.duration)
            continue;
        log_write(
            ctx, LOG_WARNING,
            "%s.path[%d]: the hull reaches a wall of the domain at t = %.4g s, on its way to (%s, %s) m" DRIVEN_ON,
            e->path, (int)i, time, coordinate_text_of(to->x).text, coordinate_text_of(to->y).text);
        return;
    }
}

/* ---- points to steer for ---- */

/* The first of some points where the hull, with its bow that way, would stand in a wall. */
typedef struct place_list {
    const char *key;
    int32_t count;
} place_list;

static bool told_of_place(context *ctx, const scenario *s, const vessel_entry *e, const place_list *list, int32_t i,
                          vec2 place, box2 reach)
{
    bool clear = is_clear(domain_box(&s->domain), place, reach);
    if (!clear)
        log_write(ctx, LOG_WARNING, "%s.%s[%d]: at (%s, %s) m the hull stands in a wall of the domain", e->path,
                  list->key, (int)i, coordinate_text_of(place.x).text, coordinate_text_of(place.y).text);
    return !clear;
}

/* To the micrometre, so that 0 is told as such. */
static double rounded(double x) { return floor(1e6 * x + 0.5) / 1e6; }

/* Where lines hold the place the vessel turns there: about amidships, or its turret. */
static vec2 turned_place(const scenario_vessel *v, double heading)
{
    bool turret = v->mooring.turret && v->mooring.lines.count > 0;
    double x = turret ? v->mooring.x : 0, y = turret ? v->mooring.y : 0;
    vec3 from = plane_to_global(radians(v->heading_deg), vec3_make(x, y, 0));
    vec3 to = plane_to_global(heading, vec3_make(x, y, 0));
    return vec2_make(rounded(v->x + from.x - to.x), rounded(v->y + from.y - to.y));
}

static void warn_of_places(context *ctx, const scenario *s, const vessel_entry *e, const vessel_model *hull)
{
    const scenario_vessel *v = e->keys;
    place_list stations = {"positioning.waypoints", v->positioning.waypoints.count};
    place_list course = {"propulsion.waypoints", v->propulsion.waypoints.count};
    for (int32_t i = 0; v->positioning.active && i < stations.count; i++) {
        const scenario_waypoint *p = &v->positioning.waypoints.data[i];
        double heading = radians(p->heading_deg);
        box2 reach = reach_about_origin(hull, heading);
        bool turns = v->positioning.control == CONTROL_HEADING;
        vec2 place = turns ? turned_place(v, heading) : vec2_make(p->x, p->y);
        if (p->time < s->run.duration && told_of_place(ctx, s, e, &stations, i, place, reach))
            return;
    }
    /* A ship that steers for a point turns before it stands there: the point itself lies in the basin.  Loops beyond
       one are looked at with what is told of turns (turning_tell.c). */
    const box2 none = {{0, 0}, {0, 0}};
    for (int32_t i = 0; vessel_drives_itself(v) && i < course.count; i++) {
        const scenario_course_point *p = &v->propulsion.waypoints.data[i];
        if (told_of_place(ctx, s, e, &course, i, (vec2){p->x, p->y}, none))
            return;
    }
}

void wall_warnings(context *ctx, const scenario *s, const vessel_entry *entry, const model *m, const world *w,
                   int32_t row)
{
    if (s->domain.boundary != DOMAIN_WALLS)
        return;
    const vessel_model *hull = &m->vessels.data[row];
    warn_of_course(ctx, s, entry, w->bodies.position[w->vessels.body[row]], hull);
    warn_of_path(ctx, s, entry, hull);
    warn_of_places(ctx, s, entry, hull);
}

/* ---- while it runs ---- */

static bool is_told(const event_table *e, station_event kind, int32_t vessel)
{
    for (int32_t i = 0; i < e->count; i++)
        if (e->kind[i] == (int32_t)kind && e->vessel[i] == vessel)
            return true;
    return false;
}

static bool is_wall(const body_table *bodies, int32_t body) { return bodies->material[body] == MATERIAL_WALL; }

/* In an endless field those of its band are driven. */
static bool is_driven_ice(const body_table *bodies, int32_t body)
{
    return bodies->material[body] == MATERIAL_ICE && bodies->motion[body] == MOTION_PRESCRIBED;
}

/* Sum of the normal forces of some bodies on a hull in this step [N]. */
static double force_of(const model *m, const world *w, int32_t body, bool (*counts)(const body_table *, int32_t))
{
    double impulse = 0;
    for (int32_t i = 0; i < w->scratch.contacts.count; i++) {
        const contact *c = &w->scratch.contacts.data[i];
        int32_t other = c->a == body ? c->b : c->a;
        if ((c->a == body || c->b == body) && counts(&w->bodies, other))
            impulse += c->impulse[0];
    }
    return impulse / m->time_step;
}

/* Between the hull and the edge of the domain [m]. */
static double room_of(const model *m, const world *w, int32_t vessel)
{
    int32_t body = w->vessels.body[vessel];
    vec3 at = w->bodies.position[body];
    box2 reach = plan_reach(&m->vessels.data[vessel], quat_roll_pitch_yaw(w->bodies.orientation[body]).z);
    return fmin(fmin(at.x + reach.lo.x - m->domain.lo.x, m->domain.hi.x - (at.x + reach.hi.x)),
                fmin(at.y + reach.lo.y - m->domain.lo.y, m->domain.hi.y - (at.y + reach.hi.y)));
}

/* A hull whose motion is given stands in a wall without a force that could tell: where it is tells. */
static bool meets_wall(const model *m, const world *w, int32_t vessel, double *force)
{
    if (w->vessels.mode[vessel] != VESSEL_FREE)
        return room_of(m, w, vessel) < 0;
    *force = force_of(m, w, w->vessels.body[vessel], is_wall);
    return *force > 0;
}

/* Floes of the band reach out of it, by less than it is wide. */
static bool meets_band(const model *m, const world *w, int32_t vessel, double *force)
{
    double band = w->feeding.band[0], room = room_of(m, w, vessel);
    if (room > 2 * band)
        return false;
    *force = force_of(m, w, w->vessels.body[vessel], is_driven_ice);
    return *force > 0 || room < band;
}

bool wall_watch(context *ctx, const model *m, world *w)
{
    bool walls = m->boundary == DOMAIN_WALLS;
    station_event kind = walls ? EVENT_WALL : EVENT_BAND;
    for (int32_t v = 0; v < w->vessels.count && (walls || w->feeding.count > 0); v++) {
        if (is_told(&w->events, kind, v))
            continue;
        double force = 0;
        int32_t told = w->events.count;
        if (!(walls ? meets_wall(m, w, v, &force) : meets_band(m, w, v, &force)))
            continue;
        if (!event_add(ctx, &w->events, kind, w->clock.time[0], v, -1, force))
            return false;
        events_tell(ctx, m, w, told);
    }
    return true;
}

/* Beyond an edge that is no wall there is no ice, and nothing else tells so. */
static void outside_remind(context *ctx, const scenario *s, const model *m, const world *w)
{
    for (int32_t v = 0; v < w->vessels.count && s->ice.source != ICE_NONE && m->boundary != DOMAIN_WALLS; v++) {
        vec3 at = w->bodies.position[w->vessels.body[v]];
        const char *name = m->vessels.data[v].name;
        if (!domain_has(&s->domain, at.x, at.y))
            log_write(ctx, LOG_WARNING,
                      "%s%s lies outside of the domain in the end, at (%s, %s) m, where there is no ice: means "
                      "hold its time there too",
                      name[0] ? "vessel " : "the vessel", name, coordinate_text_of(at.x).text,
                      coordinate_text_of(at.y).text);
    }
}

void wall_remind(context *ctx, const scenario *s, const model *m, const world *w)
{
    outside_remind(ctx, s, m, w);
    for (int32_t i = 0; i < w->events.count; i++) {
        bool band = w->events.kind[i] == EVENT_BAND;
        if (w->events.kind[i] != EVENT_WALL && !band)
            continue;
        const char *name = m->vessels.data[w->events.vessel[i]].name;
        log_write(ctx, LOG_WARNING, "%s%s reached %s at t = %.4g s: loads and motion after that are not those of %s",
                  name[0] ? "vessel " : "the vessel", name,
                  band ? "the band of the field, whose floes nothing pushes aside," : "a wall of the domain",
                  w->events.time[i], band ? "ice that gives way; make the domain larger" : "ice");
    }
}
