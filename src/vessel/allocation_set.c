#include "vessel/allocation_set.h"

#include <math.h>

/* Softness in units of one over the dearest thrust: each solution is a good start for the next. */
enum { SOFT_STAGES = 3 };
static const double softness_of_stage[SOFT_STAGES] = {1e6 / ALLOCATION_MISS_COST, 1e3 / ALLOCATION_MISS_COST,
                                                      1 / ALLOCATION_MISS_COST};
/* Steps of Newton's method in a stage, and points looked at along one of them: bounds against rounding; of random
   demands none needed more. */
#define NEWTON_MOST 40
#define ALONG_MOST 40
/* The equation is solved to this part of what it sums. */
#define SOLVED 1e-14
/* A step ends where the slope of the dual along it is this part of that at its start, and not beyond the largest value
   but for rounding: in parts of the slope. */
#define SLOPE_LEFT 0.1
#define SLOPE_PAST 1e-6
/* Where little of a demand is missed it is brought down to this part, in so many rounds. */
#define MISS_LEFT 1e-13
#define ROUNDS_MOST 4

/* By duality: the thrusts of a multiplier y are the points of the sets nearest to B'y / weight, and y solves
   sum B f(y) + softness (y - y0) = tau, the slope of a convex function of three unknowns. */
typedef struct set_problem {
    allocation_set sets[ALLOCATION_MOST / 2]; /* moments over the lever */
    int32_t count;
    vec3 tau, origin; /* y0 */
    double softness;
} set_problem;

/* How the nearest point of a set moves with the point: by `all` of its way, and `along` of that in a direction more. */
typedef struct set_slope {
    double all, along;
    vec2 direction;
} set_slope;

/* The point of a set nearest to g. */
static vec2 nearest_in(const allocation_set *s, vec2 g, set_slope *slope)
{
    double side = g.y < 0 ? -1 : 1, y = fabs(g.y), c = s->cosine, length = vec2_length(g);
    *slope = (set_slope){1, 0, {0, 0}};
    bool ahead = y * c <= g.x * s->sine && (g.x >= 0 || c < 0);
    if (ahead && length <= s->most)
        return g;
    if (ahead) { /* on the circle */
        double share = s->most / length;
        *slope = (set_slope){share, -share, vec2_scale(g, 1 / length)};
        return vec2_scale(g, share);
    }
    /* Beside the side from the end astern to the corner of the sector. */
    vec2 to = {s->most * c + s->back, s->most * s->sine}, from_end = {g.x + s->back, y};
    double size = vec2_length(to);
    vec2 e = vec2_scale(to, 1 / size);
    double t = vec2_dot(from_end, e);
    if (vec2_cross(e, from_end) <= 0 && t >= 0)
        return g;
    bool between = t > 0 && t < size;
    *slope = (set_slope){0, between ? 1 : 0, {e.x, side * e.y}};
    t = fmin(fmax(t, 0), size);
    return vec2_make(t * e.x - s->back, side * t * e.y);
}

static void add_square(sym3 *a, vec3 e, double s)
{
    a->xx += s * e.x * e.x, a->yy += s * e.y * e.y, a->zz += s * e.z * e.z;
    a->xy += s * e.x * e.y, a->xz += s * e.x * e.z, a->yz += s * e.y * e.z;
}

static vec3 effect_of_thrust(const allocation_set *s, vec2 f)
{
    return vec3_mad(vec3_scale(s->along, f.x), s->across, f.y);
}

/* tau less what the thrusts of y make and less the softness.  change: of what is taken off, with y; size: of what is
   summed, rounding of the thrusts included. */
static vec3 left_over(const set_problem *p, vec3 y, vec2 *thrust, double *size, sym3 *change)
{
    vec3 left = vec3_mad(p->tau, vec3_sub(y, p->origin), -p->softness);
    *size = vec3_length(p->tau);
    *change = (sym3){0};
    for (int32_t i = 0; i < p->count; i++) {
        const allocation_set *s = &p->sets[i];
        double ease = 1 / s->weight;
        set_slope slope;
        thrust[i] = nearest_in(s, vec2_make(vec3_dot(s->along, y) * ease, vec3_dot(s->across, y) * ease), &slope);
        vec3 effect = effect_of_thrust(s, thrust[i]);
        left = vec3_sub(left, effect);
        *size += vec3_length(effect);
        add_square(change, s->along, slope.all * ease);
        add_square(change, s->across, slope.all * ease);
        add_square(change, effect_of_thrust(s, slope.direction), slope.along * ease);
    }
    *size += 0.1 * (change->xx + change->yy + change->zz) * vec3_length(y);
    return left;
}

static vec3 missed_by(const set_problem *p, const vec2 *thrust)
{
    vec3 miss = p->tau;
    for (int32_t i = 0; i < p->count; i++)
        miss = vec3_sub(miss, effect_of_thrust(&p->sets[i], thrust[i]));
    return miss;
}

/* One step from y, as long as the slope of the dual along it says; what is left over then.  A slope that is shallow
   beside that of the start is needed where it changes at once, as between two corners of a set: a step that ends
   beyond the change would be undone by the next. */
static vec3 step_along(const set_problem *p, vec3 *y, vec3 step, double slope, vec2 *thrust, double *size, sym3 *change)
{
    double low = 0, high = 1, at_low = slope, at_high = 0, share = 1;
    vec3 left = {0};
    for (int k = 0; k < ALONG_MOST; k++) {
        left = left_over(p, vec3_mad(*y, step, share), thrust, size, change);
        double now = vec3_dot(left, step);
        if (now >= -SLOPE_PAST * slope && (now <= SLOPE_LEFT * slope || k == 0))
            break;
        if (now > 0) {
            low = share, at_low = now;
        } else {
            high = share, at_high = now;
        }
        /* By the secant, kept off the ends; every third time the middle. */
        double secant = low + (high - low) * at_low / (at_low - at_high), off = high - low;
        share = k % 3 == 2 ? 0.5 * (low + high) : fmin(fmax(secant, low + 1e-3 * off), high - 0.1 * off);
    }
    *y = vec3_mad(*y, step, share);
    return left;
}

static void solve_dual(const set_problem *p, vec3 *y, vec2 *thrust)
{
    double size;
    sym3 change;
    vec3 left = left_over(p, *y, thrust, &size, &change);
    for (int k = 0; k < NEWTON_MOST && vec3_length(left) > SOLVED * size; k++) {
        vec3 step = allocation_multiplier(change, p->softness, left);
        double slope = vec3_dot(left, step);
        if (!(slope > 0))
            break;
        left = step_along(p, y, step, slope, thrust, &size, &change);
    }
}

static double cost_of_thrusts(const set_problem *p, const vec2 *thrust)
{
    double cost = 0;
    for (int32_t i = 0; i < p->count; i++)
        cost += p->sets[i].weight * vec2_dot(thrust[i], thrust[i]);
    return cost;
}

double allocation_solve_sets(const allocation_set *sets, int32_t count, double lever, vec3 tau, vec2 *thrust,
                             vec3 *residual, bool *reached)
{
    set_problem p = {.count = count, .tau = {tau.x, tau.y, tau.z / lever}};
    double dearest = 0;
    for (int32_t i = 0; i < count; i++) {
        p.sets[i] = sets[i];
        p.sets[i].along.z /= lever;
        p.sets[i].across.z /= lever;
        dearest = fmax(dearest, sets[i].weight);
    }
    vec3 y = {0};
    for (int k = 0; k < SOFT_STAGES; k++) {
        p.softness = softness_of_stage[k] / dearest;
        solve_dual(&p, &y, thrust);
    }
    vec3 miss = missed_by(&p, thrust);
    /* About what was found, again: what softness misses falls to rounding, near the end of the reach and where
       thrusters push against each other slowly. */
    double demand = vec3_length(p.tau), left = vec3_length(miss);
    for (int k = 0; k < ROUNDS_MOST && left > MISS_LEFT * demand && left <= ALLOCATION_NEAR * demand; k++) {
        p.origin = y;
        solve_dual(&p, &y, thrust);
        miss = missed_by(&p, thrust);
        left = vec3_length(miss);
    }
    *reached = left <= ALLOCATION_REACHED * demand;
    *residual = vec3_make(miss.x, miss.y, miss.z * lever);
    return cost_of_thrusts(&p, thrust) + ALLOCATION_MISS_COST * dearest * vec3_dot(miss, miss);
}
