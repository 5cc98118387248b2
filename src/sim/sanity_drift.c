/* Ice that drifts where nothing feeds it: a basin gathers it at a wall, and from an open domain it leaves.  See
   sim/sanity.h. */
#include "sim/known_flow.h"
#include "sim/sanity_parts.h"

#include <math.h>

/* ---- walls ---- */

/* Ice in a basin does not drift past a vessel on station: it gathers at a wall. */
static bool tell_basin(const teller *t)
{
    const scenario_vessel *v = t->e->keys;
    const known_flow current = known_current(t->s, t->read);
    char speed[32] = "";
    if (!vessel_is_held(v) || (current.known && !(current.fastest > 0)))
        return false;
    if (current.steady)
        snprintf(speed, sizeof speed, " of %.4g m/s", current.fastest);
    sanity_say(t->tell, t->to,
               "domain.boundary: walls keep the ice in a basin, where the current%s drives it against one of them: for "
               "ice that drifts past %s take feeding",
               speed, vessel_title_of(t->e).text);
    return true;
}

/* ---- an open domain ---- */

/* Moments at which it is asked how far the ice has come. */
enum { DRIFT_STEPS = 2000 };

/* Where a vessel on station that is at a place goes in a step: to the way point of now, as fast as it is led there. */
static vec2 station_after(const scenario_vessel *v, vec2 at, double time, double step)
{
    const scenario_positioning *p = &v->positioning;
    bool goes = sanity_is_positioned(v) && p->control != CONTROL_HEADING;
    vec2 to = at;
    for (int32_t i = 0; goes && i < p->waypoints.count; i++)
        if (p->waypoints.data[i].time <= time)
            to = vec2_make(p->waypoints.data[i].x, p->waypoints.data[i].y);
    double x = to.x - at.x, y = to.y - at.y, far = sqrt(x * x + y * y);
    double part = fmin(1, p->reference_speed * step / fmax(far, 1e-9));
    return vec2_make(at.x + part * x, at.y + part * y);
}

/* When the last ice has gone past a vessel for good at the earliest [s]; HUGE_VAL: not in the run, or nobody can tell.
   Floes are taken to go with the surface current from the start on, and no wind drives them: seen from them the vessel
   goes against the current until all of its hull is out of what was the domain.  A tide may bring them back. */
static double ice_is_past(const teller *t, int32_t vessel, double reach)
{
    const scenario *s = t->s;
    const ice_drift current = scenario_current(s);
    const media still = {.current = scenario_velocity(current.speed, current.towards_deg)};
    const media_history none = {0}, *history = t->read ? t->read : &none;
    double step = s->run.duration / DRIFT_STEPS, past = HUGE_VAL;
    const vec3 start = sanity_start(s, vessel, t->made);
    vec2 way = {0, 0}, at = {start.x, start.y};
    if (!ice_drift_is_of_keys(&current) && !t->read)
        return HUGE_VAL;
    for (int i = 0; i <= DRIFT_STEPS; i++) {
        at = i > 0 ? station_after(t->e->keys, at, i * step, step) : at;
        vec2 room = domain_edges_from(&s->domain, vec2_make(at.x - way.x, at.y - way.y));
        bool gone = fmin(room.x, room.y) < -reach;
        past = !gone ? HUGE_VAL : fmin(past, i * step);
        const media now = media_at(&still, history, (i + 0.5) * step);
        vec3 velocity = media_current(&now, 0);
        way = vec2_make(way.x + velocity.x * step, way.y + velocity.y * step);
    }
    return past;
}

/* Tiles of level ice do not drift, and listed floes were put where they are on purpose.  Still water takes no ice. */
static bool tell_open(const teller *t, int32_t vessel)
{
    const scenario *s = t->s;
    const vessel_model *hull = t->model ? &t->model->vessels.data[vessel] : NULL;
    const known_flow current = known_current(s, t->read);
    if (!scenario_ice_is_field(&s->ice) || !vessel_is_held(t->e->keys) || scenario_vessel_leaves(s, t->e->keys) ||
        sanity_lies_outside(s, vessel, t->model) || (current.known && !(current.fastest > 0)))
        return false;
    double past = ice_is_past(t, vessel, sanity_hull_reach(t->e->keys, hull));
    if (!(past < s->run.duration))
        return false;
    sanity_say(t->tell, t->to,
               "domain.boundary: no ice comes into an open domain, and the current can take the last of it past "
               "%s by t = %.3g s, of %.4g s: means are then of open water too; for ice that drifts past it take "
               "feeding, else enlarge the domain or shorten run.duration",
               vessel_title_of(t->e).text, past, s->run.duration);
    return true;
}

void sanity_tell_drift(const scenario *s, sanity_built built, sanity_teller tell, const void *to)
{
    bool told = !s->environment.water || s->ice.source == ICE_NONE;
    for (int32_t i = 0; i < scenario_vessel_count(s) && !told; i++) {
        const vessel_entry e = scenario_vessel_entry(s, i);
        const teller t = {s, tell, to, &e, built.made, built.model, built.read};
        told =
            s->domain.boundary == DOMAIN_WALLS ? tell_basin(&t) : s->domain.boundary == DOMAIN_OPEN && tell_open(&t, i);
    }
}
