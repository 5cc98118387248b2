#include "sim/meeting_check.h"

#include "base/transcendental.h"
#include "sim/approach_watch.h"
#include "vessel/prescribed_path.h"

#include <math.h>

/* Parts of the run, in each of which velocities and headings are taken as constant. */
enum { LEGS = 256 };

static bool is_driven(const world *w, int32_t vessel) { return w->vessels.mode[vessel] != VESSEL_FREE; }

/* Centre of mass in the water plane [m] and heading [rad] of a vessel of given motion. */
static vec3 pose_at(const world *w, int32_t vessel, double time)
{
    vec3 place = path_place(&w->waypoints, vessel, time);
    if (!isnan(place.z))
        return plane_place_of_centre(w->vessels.centre[vessel], place);
    int32_t body = w->vessels.body[vessel];
    vec3 way = vec3_scale(w->vessels.tow_velocity[vessel], plane_ramped(time, w->vessels.tow_ramp[vessel]));
    vec3 at = w->bodies.position[body];
    return vec3_make(at.x + way.x, at.y + way.y, quat_roll_pitch_yaw(w->bodies.orientation[body]).z);
}

/* One of two vessels in a part of the run. */
typedef struct leg {
    vec2 from, velocity;
    double heading;
} leg;

static leg leg_of(const world *w, int32_t vessel, double from, double time)
{
    vec3 a = pose_at(w, vessel, from), b = pose_at(w, vessel, from + time);
    return (leg){vec2_make(a.x, a.y), vec2_make((b.x - a.x) / time, (b.y - a.y) / time), a.z};
}

static bool is_in_reach(const world *w, int32_t a, int32_t b, const leg legs[2], double time)
{
    vec2 off = vec2_sub(legs[1].from, legs[0].from), relative = vec2_sub(legs[1].velocity, legs[0].velocity);
    const double *radius = w->shapes.shapes.radius;
    double reach = radius[w->bodies.shape[w->vessels.body[a]]] + radius[w->bodies.shape[w->vessels.body[b]]];
    return vec2_length(off) < reach + time * vec2_length(relative);
}

/* When two vessels meet; infinity: never in the run, or no memory to tell. */
static double meeting_time(context *ctx, const model *m, const world *w, int32_t a, int32_t b, double duration)
{
    vec2_array plan[2] = {{0}, {0}};
    const int32_t vessel[2] = {a, b};
    double met = HUGE_VAL, time = duration / LEGS;
    for (int k = 0; k < LEGS && isinf(met); k++) {
        leg legs[2];
        approach_hull hull[2];
        bool good = true;
        for (int i = 0; i < 2; i++)
            legs[i] = leg_of(w, vessel[i], k * time, time);
        if (!is_in_reach(w, a, b, legs, time))
            continue;
        for (int i = 0; i < 2; i++) {
            vec2 ahead = vec2_make(real_cos(legs[i].heading), real_sin(legs[i].heading));
            good = good && approach_outline(ctx, m, vessel[i], legs[i].from, ahead, &plan[i]);
            hull[i] = (approach_hull){{plan[i].data, plan[i].count}, legs[i].velocity};
        }
        if (!good)
            break;
        approach_prediction p = approach_predict(&hull[0], &hull[1], time);
        met = p.gap > 0 ? HUGE_VAL : k * time + p.time;
    }
    array_free(ctx, &plan[0]);
    array_free(ctx, &plan[1]);
    return met;
}

void meeting_warnings(context *ctx, const scenario *s, const vessel_entry *entry, const model *m, const world *w,
                      int32_t row)
{
    for (int32_t v = 0; v < row && is_driven(w, row); v++) {
        if (!is_driven(w, v))
            continue;
        double time = meeting_time(ctx, m, w, v, row, s->run.duration);
        vessel_entry other = scenario_vessel_entry(s, v);
        if (!isinf(time))
            log_write(
                ctx, LOG_WARNING,
                "%s is driven through %s from t = %.4g s on: the motions of both are given, neither gives way, and "
                "forces between them mean nothing; shorten run.duration, or give other courses",
                vessel_title_of(entry).text, vessel_title_of(&other).text, time);
    }
}
