#include "sim/vessel_speed.h"

#include "base/transcendental.h"
#include "sim/known_flow.h"
#include "vessel/plane_motion.h"

#include <math.h>

/* Between the points of a path: 0 without one. */
static double fastest_on_path(const scenario_vessel *v)
{
    double most = 0;
    for (int32_t i = 1; i < v->path.count; i++) {
        const scenario_path_point *a = &v->path.data[i - 1], *b = &v->path.data[i];
        double x = b->x - a->x, y = b->y - a->y;
        most = fmax(most, sqrt(x * x + y * y) / (b->time - a->time));
    }
    return most;
}

/* As the key of the power says. */
double vessel_open_water_speed(const scenario_propulsion *p)
{
    return p->open_water_speed * real_pow(p->power, 1.0 / 3);
}

double vessel_speed_lost_in_ice(const scenario *s, const media_history *read, double wanted)
{
    if (s->domain.boundary != DOMAIN_FEEDING)
        return wanted;
    const known_flow drift = known_drift(s, read);
    return drift.known ? wanted + drift.fastest : HUGE_VAL;
}

double vessel_own_speed(const scenario_vessel *v, double part)
{
    const scenario_propulsion *p = &v->propulsion;
    if (v->mode != VESSEL_FREE || !vessel_drives_itself(v))
        return fmax(v->speed, fastest_on_path(v));
    return fmax(v->speed, fmin(part * vessel_open_water_speed(p), automatic_or(p->speed, HUGE_VAL)));
}

double vessel_fastest(const scenario_vessel *v) { return vessel_own_speed(v, 1); }

double vessel_way(const scenario_vessel *v, double time)
{
    double ramp = v->mode == VESSEL_FREE || v->path.count > 0 ? 0 : v->ramp;
    return vessel_fastest(v) * plane_ramped(time, ramp);
}

bool vessel_keeps_course(const scenario_vessel *v)
{
    const scenario_propulsion *p = &v->propulsion;
    if (v->path.count > 0)
        return false;
    return v->mode != VESSEL_FREE ||
           (vessel_drives_itself(v) && p->waypoints.count == 0 && p->pattern.kind == PATTERN_NONE);
}
