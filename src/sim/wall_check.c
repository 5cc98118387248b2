#include "sim/wall_check.h"

#include "base/transcendental.h"
#include "sim/events_tell.h"

#include <math.h>

/* ---- before a run ---- */

/* Reach of the hull from its centre of mass along global X and Y, at a heading. */
static box2 reach_of(const mesh *surface, double heading)
{
    double c = real_cos(heading), d = real_sin(heading);
    box2 out = {{0, 0}, {0, 0}};
    for (int32_t i = 0; i < surface->vertex.count; i++) {
        vec3 v = surface->vertex.data[i];
        double x = c * v.x - d * v.y, y = d * v.x + c * v.y;
        out.lo.x = fmin(out.lo.x, x), out.hi.x = fmax(out.hi.x, x);
        out.lo.y = fmin(out.lo.y, y), out.hi.y = fmax(out.hi.y, y);
    }
    return out;
}

/* Way that is left along one axis before the hull is at a wall. */
static double way_left(double lo, double hi, double least, double most, double direction)
{
    if (direction > 0)
        return (most - hi) / direction;
    return direction < 0 ? (least - lo) / direction : HUGE_VAL;
}

double vessel_fastest(const scenario_vessel *v)
{
    const scenario_propulsion *p = &v->propulsion;
    if (v->mode != VESSEL_FREE || is_automatic(p->bollard_pull))
        return v->speed;
    /* As the key of the power says. */
    double most = p->open_water_speed * real_pow(p->power, 1.0 / 3);
    return fmax(v->speed, fmin(most, automatic_or(p->speed, HUGE_VAL)));
}

bool vessel_keeps_course(const scenario_vessel *v)
{
    const scenario_propulsion *p = &v->propulsion;
    if (v->path.count > 0)
        return false;
    return v->mode != VESSEL_FREE ||
           (!is_automatic(p->bollard_pull) && p->waypoints.count == 0 && p->pattern.kind == PATTERN_NONE);
}

static void warn_of_course(context *ctx, const scenario *s, const vessel_entry *e, vec3 at, const mesh *surface)
{
    const scenario_vessel *v = e->keys;
    const scenario_domain *d = &s->domain;
    bool is_free = v->mode == VESSEL_FREE;
    double speed = vessel_fastest(v);
    if (!vessel_keeps_course(v) || !(speed > 0))
        return;
    double course = radians(is_free ? v->heading_deg : automatic_or(v->course_deg, v->heading_deg));
    box2 reach = reach_of(surface, radians(v->heading_deg));
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
        log_write(ctx, LOG_WARNING, "the hull reaches a wall of the domain at t = %.4g s, after %.4g m", time, way);
}

/* The first of some points where the hull, with its bow that way, would stand in a wall. */
typedef struct place_list {
    const char *key;
    int32_t count;
} place_list;

static bool told_of_place(context *ctx, const scenario *s, const vessel_entry *e, const place_list *list, int32_t i,
                          vec3 place, const box2 *reach)
{
    const scenario_domain *d = &s->domain;
    bool clear = place.x + reach->lo.x >= d->x_min && place.x + reach->hi.x <= d->x_max &&
                 place.y + reach->lo.y >= d->y_min && place.y + reach->hi.y <= d->y_max;
    if (!clear)
        log_write(ctx, LOG_WARNING, "%s.%s[%d]: at (%.5g, %.5g) m the hull stands in a wall of the domain", e->path,
                  list->key, (int)i, place.x, place.y);
    return !clear;
}

static void warn_of_places(context *ctx, const scenario *s, const vessel_entry *e, const mesh *surface)
{
    const scenario_vessel *v = e->keys;
    place_list path = {"path", v->path.count}, stations = {"positioning.waypoints", v->positioning.waypoints.count};
    place_list course = {"propulsion.waypoints", v->propulsion.waypoints.count};
    for (int32_t i = 0; v->mode != VESSEL_FREE && i < path.count; i++) {
        box2 reach = reach_of(surface, radians(v->path.data[i].heading_deg));
        bool late = i > 0 && v->path.data[i - 1].time >= s->run.duration;
        if (!late && told_of_place(ctx, s, e, &path, i, vec3_make(v->path.data[i].x, v->path.data[i].y, 0), &reach))
            return;
    }
    for (int32_t i = 0; v->positioning.active && i < stations.count; i++) {
        const scenario_waypoint *p = &v->positioning.waypoints.data[i];
        box2 reach = reach_of(surface, radians(p->heading_deg));
        if (p->time < s->run.duration && told_of_place(ctx, s, e, &stations, i, vec3_make(p->x, p->y, 0), &reach))
            return;
    }
    /* A ship that steers for a point turns before it stands there: the point itself lies in the basin. */
    const box2 none = {{0, 0}, {0, 0}};
    for (int32_t i = 0; !is_automatic(v->propulsion.bollard_pull) && i < course.count; i++) {
        const scenario_course_point *p = &v->propulsion.waypoints.data[i];
        if (told_of_place(ctx, s, e, &course, i, vec3_make(p->x, p->y, 0), &none))
            return;
    }
}

void wall_warnings(context *ctx, const scenario *s, const vessel_entry *entry, const model *m, const world *w,
                   int32_t row)
{
    if (s->domain.boundary != DOMAIN_WALLS)
        return;
    const mesh *surface = &w->shapes.solids->data[m->vessels.data[row].solid].surface;
    warn_of_course(ctx, s, entry, w->bodies.position[w->vessels.body[row]], surface);
    warn_of_places(ctx, s, entry, surface);
}

/* ---- while it runs ---- */

static bool is_told(const event_table *e, int32_t vessel)
{
    for (int32_t i = 0; i < e->count; i++)
        if (e->kind[i] == EVENT_WALL && e->vessel[i] == vessel)
            return true;
    return false;
}

/* Sum of the normal forces of walls on a hull in this step [N]. */
static double force_of_walls(const model *m, const world *w, int32_t body)
{
    double impulse = 0;
    for (int32_t i = 0; i < w->scratch.contacts.count; i++) {
        const contact *c = &w->scratch.contacts.data[i];
        int32_t other = c->a == body ? c->b : c->a;
        if ((c->a == body || c->b == body) && w->bodies.material[other] == MATERIAL_WALL)
            impulse += c->impulse[0];
    }
    return impulse / m->time_step;
}

bool wall_watch(context *ctx, const model *m, world *w)
{
    for (int32_t v = 0; v < w->vessels.count && m->boundary == DOMAIN_WALLS; v++) {
        double force = is_told(&w->events, v) ? 0 : force_of_walls(m, w, w->vessels.body[v]);
        int32_t told = w->events.count;
        if (!(force > 0))
            continue;
        if (!event_add(ctx, &w->events, EVENT_WALL, w->clock.time[0], v, -1, force))
            return false;
        events_tell(ctx, m, w, told);
    }
    return true;
}
