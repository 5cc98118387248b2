#include "vessel/mooring.h"

#include "base/transcendental.h"

/* A step of the search for the heading at which a vessel comes to rest [deg], 0.5 to 5: equilibria that are nearer to
   each other may be passed over. */
#define SEARCH_STEP_DEG 2.0
/* Equilibria within this turn of where the vessel is put are taken for where it was meant to be [deg], 0.01 to 1. */
#define MEANT_DEG 0.1
/* How far beside an equilibrium the moment must turn a vessel back to it [rad], 1e-5 to 1e-3. */
#define BESIDE 1e-4
/* Parts of the lines' tensions.  Forces left with which an equilibrium is found; which Newton's method goes on to; and,
   with the heading held, so that the sign of the moment tells which way the vessel turns, however flat the moment is at
   the equilibrium (that of a current on a bow goes with the square of the angle).  The last is above rounding. */
#define FOUND 1e-6
#define BALANCED 1e-9
#define HELD_BALANCED 1e-12
/* Steps of differences, in lengths of the vessel.  A hawser that hardly pulls is slack a finger's breadth away. */
#define SLOPE_STEP 1e-4
#define FINE_STEP 1e-7
/* What a vessel drifts at most on slack lines in a step of the search, in its lengths. */
#define FARTHEST_STEP 100.0
/* Part of their stiffness in two directions which lines have in every one, if they hold the vessel. */
#define HOLDS 1e-12
/* A moment over the length that may be rounding, ten times the force that is left. */
#define NO_MOMENT 1e-11

typedef struct balance {
    const line_table *lines;
    int32_t vessel;
    double length; /* of the vessel: what a moment is divided and a turn multiplied by */
    steady_load load;
    const void *user;
    double z, roll, pitch;
    double pulls; /* the lines' tensions together, or the load if it is more [N] */
    bool held;    /* the heading is, where the steady load is this: forces alone are balanced */
    vec3 steady;
} balance;

static vec3 steady_at(const balance *b, double yaw) { return b->load ? b->load(b->user, yaw) : vec3_make(0, 0, 0); }

/* Force left at (x, y, length * yaw), the moment over the length. */
static vec3 balance_left(const balance *b, vec3 at)
{
    double yaw = at.z / b->length;
    wrench pull = mooring_pull(b->lines, b->vessel, vec3_make(at.x, at.y, b->z),
                               quat_from_roll_pitch_yaw(b->roll, b->pitch, yaw));
    vec3 steady = b->held ? b->steady : steady_at(b, yaw);
    return vec3_make(pull.force.x + steady.x, pull.force.y + steady.y, (pull.moment.z + steady.z) / b->length);
}

/* What of it is to vanish. */
static vec3 balance_miss(const balance *b, vec3 at)
{
    vec3 left = balance_left(b, at);
    return vec3_make(left.x, left.y, b->held ? 0 : left.z);
}

/* By differences over 2 `step`. */
static mat3 balance_slope(const balance *b, vec3 at, double step)
{
    mat3 slope = {{{0}}};
    for (int c = 0; c < (b->held ? 2 : 3); c++) {
        vec3 by = vec3_make(c == 0 ? step : 0, c == 1 ? step : 0, c == 2 ? step : 0);
        vec3 d = vec3_sub(balance_miss(b, vec3_add(at, by)), balance_miss(b, vec3_sub(at, by)));
        slope.m[0][c] = d.x / (2 * step);
        slope.m[1][c] = d.y / (2 * step);
        slope.m[2][c] = d.z / (2 * step);
    }
    return slope;
}

/* Solves (J'J + damping I) x = -J' miss (Levenberg 1944). */
static vec3 balance_step(mat3 slope, vec3 miss, double damping)
{
    mat3 normal = mat3_mul(mat3_transpose(slope), slope);
    for (int i = 0; i < 3; i++)
        normal.m[i][i] += damping;
    return vec3_neg(mat3_mul_vec(mat3_inverse(normal), mat3_tmul_vec(slope, miss)));
}

/* The pose at which no more than this is missed, from `at` on, or the best on the way there: damped Newton with a
   numerical Jacobian.  It goes to any equilibrium, stable or not, and creeps where the moment has no slope. */
static vec3 balance_solve(const balance *b, vec3 at, double precision)
{
    enum { MOST_STEPS = 200 };
    vec3 miss = balance_miss(b, at);
    double damping = 1e-3;
    for (int i = 0; i < MOST_STEPS && vec3_length(miss) > precision * b->pulls; i++) {
        mat3 slope = balance_slope(b, at, SLOPE_STEP * b->length);
        double scale = 0;
        for (int k = 0; k < 9; k++)
            scale = fmax(scale, fabs(slope.m[k / 3][k % 3]));
        if (!(scale > 0))
            break;
        vec3 step = balance_step(slope, miss, damping * scale * scale);
        double reach = vec3_length(step);
        if (reach > 0.1 * b->length)
            step = vec3_scale(step, 0.1 * b->length / reach);
        vec3 next = vec3_add(at, step), next_miss = balance_miss(b, next);
        if (vec3_length(next_miss) < vec3_length(miss)) {
            at = next;
            miss = next_miss;
            damping = fmax(damping / 8, 1e-15);
        } else if (damping < 1e6) {
            damping *= 4;
        } else {
            break;
        }
    }
    return at;
}

/* A step with the heading held, at most `reach` long, along which the lines' potential falls: Newton's where the lines
   hold in every direction, else with the load that is left, as a vessel drifts on slack lines. */
static vec3 descent_step(mat3 slope, vec3 miss, double reach)
{
    double a = -slope.m[0][0], d = -slope.m[1][1], c = -0.5 * (slope.m[0][1] + slope.m[1][0]), det = a * d - c * c;
    vec3 step = miss;
    if (a > 0 && d > 0 && det > HOLDS * a * d)
        step = vec3_make((d * miss.x - c * miss.y) / det, (a * miss.y - c * miss.x) / det, 0);
    double length = vec3_length(step);
    return length > reach || !(det > HOLDS * a * d) ? vec3_scale(step, reach / length) : step;
}

/* As much of a step as leaves no more than half of its downhill force behind it. */
static double descent_part(const balance *b, vec3 at, vec3 step, double downhill)
{
    enum { MOST_HALVES = 60 };
    double low = 0, high = 1, part = 1;
    for (int i = 0; i < MOST_HALVES; i++) {
        double force = vec3_dot(balance_miss(b, vec3_mad(at, step, part)), step);
        if (fabs(force) <= 0.5 * downhill || (part == 1 && force > 0))
            break;
        if (force > 0)
            low = part;
        else
            high = part;
        part = 0.5 * (low + high);
    }
    return part;
}

/* As balance_solve with the heading held, for lines that may hang slack: there what is missed has no slope, and is less
   than where lines pull too hard, so that a search for the least miss ends there.  A line pulls the harder the longer
   it is, so that the potential of lines and load is convex, and any way down leads to its bottom. */
static vec3 balance_descend(const balance *b, vec3 at, double precision)
{
    enum { MOST_STEPS = 400 };
    double least = 0.1 * b->length, reach = least;
    for (int i = 0; i < MOST_STEPS; i++) {
        vec3 miss = balance_miss(b, at);
        if (vec3_length(miss) <= precision * b->pulls)
            break;
        vec3 step = descent_step(balance_slope(b, at, FINE_STEP * b->length), miss, reach);
        double part = descent_part(b, at, step, vec3_dot(miss, step));
        vec3 next = vec3_mad(at, step, part);
        if (next.x == at.x && next.y == at.y)
            break;
        /* A boat or a buoy may have hundreds of its lengths to drift. */
        reach = part < 1 ? least : fmin(2 * reach, FARTHEST_STEP * b->length);
        at = next;
    }
    return at;
}

static bool misses_no_more(const balance *b, vec3 at, double precision)
{
    return vec3_length(balance_miss(b, at)) <= precision * b->pulls;
}

/* ---- the heading at which a vessel comes to rest ---- */

/* The same vessel with its heading held. */
static balance balance_held(const balance *b, double yaw)
{
    balance still = *b;
    still.held = true;
    still.steady = steady_at(b, yaw);
    return still;
}

/* Where it then lies. */
static vec3 balance_hold(const balance *still, vec3 at)
{
    vec3 found = balance_solve(still, at, HELD_BALANCED);
    if (misses_no_more(still, found, FOUND))
        return found;
    at = balance_descend(still, at, HELD_BALANCED);
    return misses_no_more(still, at, FOUND) ? at : found;
}

/* The balance nearest to a pose, or the best on the way there. */
static vec3 balance_near(const balance *b, vec3 at)
{
    vec3 found = balance_solve(b, at, BALANCED);
    if (misses_no_more(b, found, BALANCED))
        return found;
    const balance still = balance_held(b, at.z / b->length);
    vec3 other = balance_solve(b, balance_hold(&still, at), BALANCED);
    return misses_no_more(b, other, BALANCED) ? other : found;
}

/* Moment over the length that is left where the vessel, turned by `by` (times the length) from `at`, lies when its
   heading is held; `at` moves there. */
static double turn_to(const balance *b, double by, vec3 *at)
{
    at->z += by;
    const balance still = balance_held(b, at->z / b->length);
    *at = balance_hold(&still, *at);
    return balance_left(&still, *at).z;
}

/* Turns the vessel from `at` the way the moment does, to the first heading from which it is turned back: between low
   and high, in ascending order.  One that lies at rest stays, and one in a balance that any touch ends turns to port
   where it can.  false: no such heading. */
static bool find_rest(const balance *b, vec3 at, vec3 *low, vec3 *high)
{
    double step = radians(SEARCH_STEP_DEG) * b->length, least = BALANCED * b->pulls, moment = turn_to(b, 0, &at);
    double way = moment > 0 ? step : -step;
    *low = *high = at;
    if (fabs(moment) <= least) {
        double port = turn_to(b, step, high), starboard = turn_to(b, -step, low);
        if (port <= least && starboard >= -least)
            return true;
        way = port > least ? step : -step;
    }
    const int turns = (int)(360 / SEARCH_STEP_DEG);
    for (int i = 0; i < turns; i++) {
        vec3 next = at;
        moment = turn_to(b, way, &next);
        *low = way > 0 ? at : next;
        *high = way > 0 ? next : at;
        if (moment * way <= 0)
            return true;
        at = next;
    }
    return false;
}

/* Whether a pose is a balance to which the vessel comes back, between these headings. */
static bool is_rest(const balance *b, vec3 at, vec3 low, vec3 high)
{
    double none = NO_MOMENT * b->pulls, by = BESIDE * b->length;
    vec3 port = at, starboard = at;
    return misses_no_more(b, at, BALANCED) && at.z >= low.z && at.z <= high.z && turn_to(b, by, &port) <= none &&
           turn_to(b, -by, &starboard) >= -none;
}

/* By halves, which a moment without a slope does not disturb. */
static vec3 narrow_rest(const balance *b, vec3 low, vec3 high)
{
    enum { MOST_HALVES = 50 };
    vec3 at = low;
    for (int i = 0; i < MOST_HALVES; i++) {
        at = low;
        double moment = turn_to(b, 0.5 * (high.z - low.z), &at);
        if (fabs(moment) <= NO_MOMENT * b->pulls)
            break;
        if (moment > 0)
            low = at;
        else
            high = at;
    }
    return at;
}

/* From a pose on, which is `start` to it. */
static balance balance_of(const line_table *lines, int32_t vessel, double length, steady_load load, const void *user,
                          const vec3 *position, const quat *orientation, vec3 *start)
{
    vec3 attitude = quat_roll_pitch_yaw(*orientation);
    balance b = {.lines = lines, .vessel = vessel, .length = length, .load = load, .user = user};
    b.z = position->z, b.roll = attitude.x, b.pitch = attitude.y;
    *start = vec3_make(position->x, position->y, length * attitude.z);
    for (int32_t i = 0; i < lines->count; i++)
        b.pulls += lines->vessel[i] == vessel ? lines->tension[i] : 0;
    /* Slack lines come to pull as the load asks. */
    vec3 steady = steady_at(&b, attitude.z);
    b.pulls = fmax(b.pulls, sqrt(steady.x * steady.x + steady.y * steady.y));
    return b;
}

/* The pose becomes this; whether it is an equilibrium. */
static bool take_pose(const balance *b, vec3 at, vec3 *position, quat *orientation, double *residual)
{
    position->x = at.x;
    position->y = at.y;
    *orientation = quat_from_roll_pitch_yaw(b->roll, b->pitch, at.z / b->length);
    *residual = vec3_length(balance_miss(b, at));
    return *residual <= FOUND * b->pulls;
}

bool mooring_nearest_balance(const line_table *lines, int32_t vessel, double length, steady_load load, const void *user,
                             vec3 *position, quat *orientation)
{
    vec3 start;
    double residual;
    balance b = balance_of(lines, vessel, length, load, user, position, orientation, &start);
    return take_pose(&b, balance_near(&b, start), position, orientation, &residual);
}

/* Where a vessel that is put at `start` comes to rest; near: Newton's pose, which is as good as any where it is that
   rest, and is taken where there is none. */
static vec3 rest_from(const balance *b, vec3 start, vec3 near)
{
    vec3 low, high;
    return find_rest(b, start, &low, &high) && !is_rest(b, near, low, high) ? narrow_rest(b, low, high) : near;
}

bool mooring_rest(const line_table *lines, int32_t vessel, double length, steady_load load, const void *user,
                  vec3 *position, quat *orientation)
{
    vec3 start;
    double residual;
    balance b = balance_of(lines, vessel, length, load, user, position, orientation, &start);
    return take_pose(&b, rest_from(&b, start, balance_near(&b, start)), position, orientation, &residual);
}

bool mooring_equilibrium(const line_table *lines, int32_t vessel, double length, steady_load load, const void *user,
                         vec3 *position, quat *orientation, mooring_balance *out)
{
    vec3 start;
    balance b = balance_of(lines, vessel, length, load, user, position, orientation, &start);
    vec3 at = balance_near(&b, start), rest = rest_from(&b, start, at);
    bool meant = misses_no_more(&b, at, BALANCED) && fabs(at.z - start.z) <= radians(MEANT_DEG) * length;
    if (!meant)
        at = rest;
    out->turn_left = (rest.z - at.z) / length;
    return take_pose(&b, at, position, orientation, &out->residual);
}
