#include "vessel/allocation.h"

#include <math.h>

/* Pivots under this share of the diagonal mean that a direction is not served at all. */
#define SINGULAR 1e-10
/* A limit is released when the cost falls by more than rounding. */
#define RELEASE 1e-12

typedef enum limit_state { FREE = 0, AT_LOW, AT_HIGH } limit_state;

typedef struct allocation_problem {
    const allocation_column *columns;
    int32_t count;
    double lever;
    vec3 tau; /* moment over lever */
} allocation_problem;

static vec3 effect_of(const allocation_problem *p, int32_t i)
{
    vec3 e = p->columns[i].effect;
    return vec3_make(e.x, e.y, e.z / p->lever);
}

static vec3 missed(const allocation_problem *p, const double *u)
{
    vec3 miss = p->tau;
    for (int32_t i = 0; i < p->count; i++)
        miss = vec3_mad(miss, effect_of(p, i), -u[i]);
    return miss;
}

/* B W^-1 B' of the free columns. */
static sym3 reach_of(const allocation_problem *p, const limit_state *state)
{
    sym3 a = {0};
    for (int32_t i = 0; i < p->count; i++) {
        if (state[i] != FREE)
            continue;
        vec3 e = effect_of(p, i);
        double s = 1 / p->columns[i].weight;
        a.xx += s * e.x * e.x, a.yy += s * e.y * e.y, a.zz += s * e.z * e.z;
        a.xy += s * e.x * e.y, a.xz += s * e.x * e.z, a.yz += s * e.y * e.z;
    }
    return a;
}

/* Whether all three directions are served: pivots of the elimination. */
static bool is_regular(sym3 a)
{
    if (!(a.xx > 0 && a.yy > 0 && a.zz > 0))
        return false;
    double yy = a.yy - a.xy * a.xy / a.xx, yz = a.yz - a.xy * a.xz / a.xx, zz = a.zz - a.xz * a.xz / a.xx;
    return yy > SINGULAR * a.yy && zz - yz * yz / yy > SINGULAR * a.zz;
}

/* By Cholesky's elimination: where few columns are free the matrix is nearly singular, and an inverse by cofactors
   would lose the small pivots in rounding. */
vec3 allocation_multiplier(sym3 reach, double softness, vec3 want)
{
    double xx = reach.xx + softness, yx = reach.xy / xx, zx = reach.xz / xx;
    double yy = reach.yy - yx * reach.xy + softness, rest = reach.yz - yx * reach.xz, zy = rest / yy;
    double zz = reach.zz - zx * reach.xz - zy * rest + softness;
    double y = want.y - yx * want.x, z = (want.z - zx * want.x - zy * y) / zz;
    y = y / yy - zy * z;
    return vec3_make(want.x / xx - yx * y - zx * z, y, z);
}

/* Minimum-cost thrusts without limits; refined once, so that the residual is of rounding. */
static bool solve_free(const allocation_problem *p, double *u)
{
    limit_state all[ALLOCATION_MOST] = {FREE};
    sym3 reach = reach_of(p, all);
    if (!is_regular(reach))
        return false;
    for (int32_t i = 0; i < p->count; i++)
        u[i] = 0;
    for (int pass = 0; pass < 3; pass++) {
        vec3 y = sym3_mul_vec(sym3_inverse(reach), missed(p, u));
        for (int32_t i = 0; i < p->count; i++)
            u[i] += vec3_dot(effect_of(p, i), y) / p->columns[i].weight;
    }
    return true;
}

static bool within(const allocation_problem *p, const double *u)
{
    for (int32_t i = 0; i < p->count; i++)
        if (u[i] < p->columns[i].lo || u[i] > p->columns[i].hi)
            return false;
    return true;
}

/* One pass: from u to the best point of the free columns, as far as the limits allow.  False: a limit was met. */
static bool descend(const allocation_problem *p, limit_state *state, double softness, double *u, vec3 *y)
{
    double target[ALLOCATION_MOST], share = 1;
    int32_t first = -1;
    vec3 want = p->tau;
    for (int32_t i = 0; i < p->count; i++)
        if (state[i] != FREE)
            want = vec3_mad(want, effect_of(p, i), -u[i]);
    *y = allocation_multiplier(reach_of(p, state), softness, want);
    for (int32_t i = 0; i < p->count; i++) {
        if (state[i] != FREE)
            continue;
        target[i] = vec3_dot(effect_of(p, i), *y) / p->columns[i].weight;
        double limit = target[i] > u[i] ? p->columns[i].hi : p->columns[i].lo;
        bool beyond = target[i] > p->columns[i].hi || target[i] < p->columns[i].lo;
        double part = beyond ? (limit - u[i]) / (target[i] - u[i]) : 1;
        if (beyond && part <= share) {
            share = fmax(part, 0);
            first = i;
        }
    }
    for (int32_t i = 0; i < p->count; i++)
        if (state[i] == FREE)
            u[i] += share * (target[i] - u[i]);
    if (first < 0)
        return true;
    bool high = target[first] > p->columns[first].hi;
    state[first] = high ? AT_HIGH : AT_LOW;
    u[first] = high ? p->columns[first].hi : p->columns[first].lo;
    return false;
}

/* The column whose release lowers the cost most, freed; false: none. */
static bool release(const allocation_problem *p, limit_state *state, const double *u, vec3 y)
{
    int32_t best = -1;
    double most = 0;
    for (int32_t i = 0; i < p->count; i++) {
        if (state[i] == FREE || !(p->columns[i].hi > p->columns[i].lo))
            continue;
        double pull = vec3_dot(effect_of(p, i), y) - p->columns[i].weight * u[i];
        double gain = state[i] == AT_HIGH ? -pull : pull;
        if (gain > most) {
            most = gain;
            best = i;
        }
    }
    if (best < 0 || most <= RELEASE * (vec3_length(y) + p->columns[best].weight * fabs(u[best])))
        return false;
    state[best] = FREE;
    return true;
}

vec3 allocation_solve(const allocation_column *columns, int32_t count, double lever, vec3 tau, double *u, bool *reached)
{
    const allocation_problem p = {columns, count, lever, {tau.x, tau.y, tau.z / lever}};
    *reached = solve_free(&p, u) && within(&p, u);
    if (!*reached) {
        limit_state state[ALLOCATION_MOST] = {FREE};
        double dearest = 0;
        for (int32_t i = 0; i < count; i++) {
            u[i] = fmin(fmax(0, columns[i].lo), columns[i].hi);
            dearest = fmax(dearest, columns[i].weight);
        }
        /* Each change of the active set lowers the cost, so that none comes back; the bound is against rounding. */
        vec3 y = {0};
        for (int pass = 0; pass < 8 * ALLOCATION_MOST; pass++) {
            bool settled = descend(&p, state, dearest > 0 ? 1 / (ALLOCATION_MISS_COST * dearest) : 1, u, &y);
            if (settled && !release(&p, state, u, y))
                break;
        }
    }
    vec3 miss = missed(&p, u);
    double demand = vec3_length(p.tau);
    if (!*reached && count > 0)
        *reached = vec3_length(miss) <= ALLOCATION_REACHED * demand;
    return vec3_make(miss.x, miss.y, miss.z * lever);
}
