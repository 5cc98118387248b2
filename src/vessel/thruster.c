#include "vessel/thruster.h"

#include "vessel/allocation_set.h"
#include "vessel/plane_motion.h"

#include <float.h>
#include <stdio.h>
#include <string.h>

#define TABLE_SELF thruster_table
TABLE_DEFINE(thruster, THRUSTER_FIELDS)
#undef TABLE_SELF

/* An order from the start is one that the thruster can follow. */
static fram_status check_order(const thruster_definition *d, fram_error *error)
{
    char expected[120];
    if (d->kind == THRUSTER_MAIN && fabs(d->order_angle) > d->rudder * (1 + 1e-9)) {
        double most = degrees(d->rudder);
        snprintf(expected, sizeof expected,
                 most > 0 ? "-%g to %g, as far as its rudder_deg turns" : "0 without rudder_deg", most, most);
        return error_value(error, "direction_deg", expected, degrees(d->order_angle));
    }
    if (d->kind == THRUSTER_AZIMUTH && d->order < 0)
        return error_value(error, "setting", "0 to 1: a unit that turns pushes the other way by its direction_deg",
                           d->order / fmax(d->astern, DBL_MIN));
    if (d->kind == THRUSTER_AZIMUTH && d->order > 0 &&
        fabs(plane_angle(d->order_angle - d->forbidden_centre)) < d->forbidden_half * (1 - 1e-9))
        return error_value(error, "direction_deg", "a direction outside of forbidden_deg and its width",
                           degrees(d->order_angle));
    return FRAM_OK;
}

static fram_status check_thruster(const thruster_definition *d, fram_error *error)
{
    if (!(d->ahead > 0))
        return error_value(error, "thrust", "a positive number of newtons", d->ahead);
    if (!(d->astern >= 0))
        return error_value(error, "thrust_astern", "a number of newtons, 0 or more", d->astern);
    if (!(d->time_constant >= 0))
        return error_value(error, "time_constant", "a number of seconds, 0 or more", d->time_constant);
    if (!(d->speed_rate > 0))
        return error_value(error, "speed_rate", "a positive rate", d->speed_rate);
    if (!(d->turn_rate > 0))
        return error_value(error, "turn_rate_deg", "a positive rate", degrees(d->turn_rate));
    if (!(d->cost > 0))
        return error_value(error, "cost", "a positive number", d->cost);
    if (!(d->forbidden_half >= 0 && d->forbidden_half < 0.5 * PI))
        return error_value(error, "forbidden_width_deg", "an angle from 0 to less than 180",
                           degrees(2 * d->forbidden_half));
    return check_order(d, error);
}

fram_status thruster_add(context *ctx, const thruster_definition *d, const vessel_table *vessels, thruster_table *t,
                         fram_error *error)
{
    fram_status status = check_thruster(d, error);
    if (status != FRAM_OK)
        return status;
    int32_t row = t->count;
    if (!table_resize(ctx, t, &thruster_table_info, row + 1))
        return error_memory(error);
    t->vessel[row] = d->vessel;
    t->kind[row] = (uint8_t)d->kind;
    t->place[row] = vec3_sub(d->place, vessels->centre[d->vessel]);
    t->ahead[row] = d->ahead;
    t->astern[row] = d->kind == THRUSTER_AZIMUTH ? 0 : d->astern;
    t->time_constant[row] = d->time_constant;
    t->speed_rate[row] = d->speed_rate;
    t->turn_rate[row] = d->turn_rate;
    t->rudder[row] = d->kind == THRUSTER_MAIN ? d->rudder : 0;
    t->forbidden_centre[row] = d->forbidden_centre;
    t->forbidden_half[row] = d->kind == THRUSTER_AZIMUTH ? d->forbidden_half : 0;
    t->cost[row] = d->cost;
    t->full_power[row] = d->full_power;
    t->failure_time[row] = d->failure_time;
    t->order[row] = d->order;
    t->angle[row] = t->order_angle[row] = d->kind == THRUSTER_TUNNEL ? 0.5 * PI : d->order_angle;
    return FRAM_OK;
}

double thruster_power(const thruster_table *t, int32_t row)
{
    double share = fabs(t->thrust[row]) / fmax(t->ahead[row], t->astern[row]);
    return t->full_power[row] * share * sqrt(share);
}

/* ---- allocation ---- */

/* Solutions looked at for one demand before the first choices that lead to an answer count. */
#define SOLUTIONS_MOST 64
/* Of two ways to divide the thrust the second has to be cheaper by this part. */
#define CHEAPER 1e-9
/* Larger demands [N] are not shared out, since costs, their squares, would be no numbers. */
#define DEMAND_MOST 1e100
/* A thrust lies where it may, to this part of the largest. */
#define ALLOWED 1e-9

/* A thruster that takes part, and its first column where thrusts are bounded by single limits. */
typedef struct thruster_part {
    int32_t row;
    int column;
} thruster_part;

/* What a thruster can give need not be convex: a ruddered propeller gives a sector ahead and a line astern, an azimuth
   all but its forbidden sector.  Either is two convex sets in one that holds both. */
typedef enum thruster_mode {
    MODE_BOTH = 0,
    MODE_FIRST, /* ahead; the half circle on from the sector's counter-clockwise edge */
    MODE_SECOND /* astern; the half circle back from its other edge */
} thruster_mode;

typedef struct thruster_search {
    const thruster_table *t;
    const thruster_part *parts;
    int count, left; /* of the parts; solutions still looked at */
    double lever;
    vec3 tau;
    bool turn_alone; /* forces do not count */
    thruster_mode mode[ALLOCATION_MOST / 2], best_mode[ALLOCATION_MOST / 2];
    vec2 best[ALLOCATION_MOST / 2]; /* thrusts along and across the middles of their sets */
    double cost;                    /* of the best */
    vec3 miss;
    bool found, reached;
} thruster_search;

static bool turns(const thruster_table *t, int32_t row)
{
    return t->kind[row] == THRUSTER_AZIMUTH || (t->kind[row] == THRUSTER_MAIN && t->rudder[row] > 0);
}

static vec3 effect_along(const thruster_table *t, int32_t row, double angle)
{
    double c = real_cos(angle), s = real_sin(angle);
    return vec3_make(c, s, t->place[row].x * s - t->place[row].y * c);
}

static vec3 counted(vec3 effect, bool turn_alone) { return turn_alone ? vec3_make(0, 0, effect.z) : effect; }

static int gather_parts(const thruster_table *t, int32_t vessel, thruster_part *parts)
{
    int count = 0;
    for (int32_t i = 0; i < t->count && 2 * count + 2 <= ALLOCATION_MOST; i++)
        if (t->vessel[i] == vessel && !t->failed[i])
            parts[count++] = (thruster_part){i, 0};
    return count;
}

static double middle_of(const thruster_table *t, int32_t row, thruster_mode mode)
{
    if (t->kind[row] == THRUSTER_TUNNEL)
        return 0.5 * PI;
    if (t->kind[row] == THRUSTER_MAIN || mode == MODE_BOTH)
        return 0;
    double off = t->forbidden_half[row] + 0.5 * PI;
    return t->forbidden_centre[row] + (mode == MODE_FIRST ? off : -off);
}

static int columns_of(const thruster_table *t, thruster_part *parts, int count, allocation_column *columns)
{
    int n = 0;
    for (int k = 0; k < count; k++) {
        int32_t row = parts[k].row;
        parts[k].column = n;
        double cost = t->cost[row], most = t->ahead[row];
        double back = t->kind[row] == THRUSTER_AZIMUTH ? most : t->astern[row];
        double angle = middle_of(t, row, MODE_BOTH);
        columns[n++] = (allocation_column){effect_along(t, row, angle), cost, -back, most};
        if (turns(t, row))
            columns[n++] = (allocation_column){effect_along(t, row, 0.5 * PI), cost, -most, most};
    }
    return n;
}

double thruster_allowed_angle(const thruster_table *t, int32_t row, double angle)
{
    if (t->kind[row] == THRUSTER_MAIN) {
        double most = t->rudder[row], a = plane_angle(angle);
        return fmin(fmax(a, -most), most);
    }
    double off = plane_angle(angle - t->forbidden_centre[row]), half = t->forbidden_half[row];
    if (fabs(off) >= half)
        return angle;
    return t->forbidden_centre[row] + (off < 0 ? -half : half);
}

/* Whether all thrusts that turn lie in their circles and where they may, if only their columns are limited. */
static bool all_fit(const thruster_table *t, const thruster_part *parts, int count, const double *u)
{
    for (int k = 0; k < count; k++) {
        int32_t row = parts[k].row;
        if (!turns(t, row))
            continue;
        double x = u[parts[k].column], y = u[parts[k].column + 1];
        double thrust = sqrt(x * x + y * y), most = t->ahead[row], angle = real_atan2(y, x);
        bool astern = t->kind[row] == THRUSTER_MAIN && x < 0;
        bool fits = !astern && thruster_allowed_angle(t, row, angle) == angle && thrust <= most * (1 + 1e-12);
        if (thrust > ALLOWED * most && !fits)
            return false;
    }
    return true;
}

static allocation_set set_of(const thruster_table *t, int32_t row, thruster_mode mode)
{
    double middle = middle_of(t, row, mode), most = t->ahead[row];
    allocation_set s = {.along = effect_along(t, row, middle),
                        .weight = t->cost[row],
                        .most = most,
                        .back = t->kind[row] == THRUSTER_AZIMUTH ? 0 : t->astern[row],
                        .cosine = 1};
    if (!turns(t, row))
        return s;
    if (t->kind[row] == THRUSTER_MAIN && mode == MODE_SECOND) {
        s.most = 0;
        return s;
    }
    s.across = effect_along(t, row, middle + 0.5 * PI);
    if (t->kind[row] == THRUSTER_MAIN) {
        s.cosine = real_cos(t->rudder[row]);
        s.sine = real_sin(t->rudder[row]);
        s.back = mode == MODE_BOTH ? s.back : 0;
    } else {
        s.cosine = mode == MODE_BOTH ? -1 : 0;
        s.sine = mode == MODE_BOTH ? 0 : 1;
    }
    return s;
}

/* How far a thrust lies from what the thruster can give, and the set that is nearer: of a rudder. */
static double off_rudder(const thruster_table *t, int32_t row, vec2 f, thruster_mode *nearer)
{
    double c = real_cos(t->rudder[row]), s = real_sin(t->rudder[row]), y = fabs(f.y), thrust = vec2_length(f);
    double ahead = f.x * c + y * s > 0 ? fmax(y * c - f.x * s, 0) : thrust, astern = f.x < 0 ? y : thrust;
    *nearer = astern < ahead ? MODE_SECOND : MODE_FIRST;
    return fmin(ahead, astern);
}

/* The same of a forbidden sector. */
static double off_sector(const thruster_table *t, int32_t row, vec2 f, thruster_mode *nearer)
{
    double off = plane_angle(real_atan2(f.y, f.x) - t->forbidden_centre[row]);
    *nearer = off < 0 ? MODE_SECOND : MODE_FIRST;
    return vec2_length(f) * real_sin(fmax(t->forbidden_half[row] - fabs(off), 0));
}

/* The part whose thrust lies farthest from what it can give; -1: none. */
static int worst_part(const thruster_search *s, const vec2 *thrust, thruster_mode *nearer)
{
    int worst = -1;
    double most = 0;
    for (int k = 0; k < s->count; k++) {
        int32_t row = s->parts[k].row;
        if (s->mode[k] != MODE_BOTH || !turns(s->t, row))
            continue;
        thruster_mode side;
        bool main = s->t->kind[row] == THRUSTER_MAIN;
        double off = main ? off_rudder(s->t, row, thrust[k], &side) : off_sector(s->t, row, thrust[k], &side);
        if (off > fmax(most, ALLOWED * s->t->ahead[row])) {
            most = off;
            worst = k;
            *nearer = side;
        }
    }
    return worst;
}

/* The best thrusts for the modes of the search, and of those that follow where one is not settled: what the sets that
   hold both miss or cost is the least that either of them can. */
static void look_further(thruster_search *s)
{
    allocation_set sets[ALLOCATION_MOST / 2];
    vec2 thrust[ALLOCATION_MOST / 2];
    vec3 miss;
    bool reached;
    for (int k = 0; k < s->count; k++) {
        sets[k] = set_of(s->t, s->parts[k].row, s->mode[k]);
        sets[k].along = counted(sets[k].along, s->turn_alone);
        sets[k].across = counted(sets[k].across, s->turn_alone);
    }
    double cost = allocation_solve_sets(sets, s->count, s->lever, s->tau, thrust, &miss, &reached);
    s->left--;
    bool better = reached == s->reached ? cost < s->cost * (1 - CHEAPER) : reached;
    if (s->found && !better)
        return;
    thruster_mode nearer = MODE_FIRST;
    int worst = worst_part(s, thrust, &nearer);
    if (worst < 0) {
        memcpy(s->best, thrust, sizeof thrust);
        memcpy(s->best_mode, s->mode, sizeof s->mode);
        s->cost = cost;
        s->miss = miss;
        s->reached = reached;
        s->found = true;
        return;
    }
    for (int k = 0; k < 2 && (s->left > 0 || !s->found); k++) {
        s->mode[worst] = k == 0 ? nearer : nearer == MODE_FIRST ? MODE_SECOND : MODE_FIRST;
        look_further(s);
    }
    s->mode[worst] = MODE_BOTH;
}

/* f: along and across the middle of the set of that mode. */
static void give_order(thruster_table *t, int32_t row, thruster_mode mode, vec2 f)
{
    bool astern = t->kind[row] == THRUSTER_MAIN && f.x < 0 && vec2_length(f) > ALLOWED * t->ahead[row];
    if (!turns(t, row) || astern) {
        t->order[row] = f.x;
        t->order_angle[row] = middle_of(t, row, MODE_BOTH);
        return;
    }
    t->order[row] = vec2_length(f);
    /* An idle thruster need not turn, if it is not at the edge of a sector. */
    if (t->order[row] > (mode == MODE_BOTH ? 1e-3 : ALLOWED) * t->ahead[row]) {
        double middle = middle_of(t, row, mode), angle = real_atan2(f.y, f.x);
        t->order_angle[row] = thruster_allowed_angle(t, row, middle != 0 ? plane_angle(middle + angle) : angle);
    }
}

static double length_over(vec3 tau, double lever) { return vec3_length(vec3_make(tau.x, tau.y, tau.z / lever)); }

static vec3 allocate(thruster_table *t, int32_t vessel, double lever, vec3 tau, bool turn_alone, bool *reached)
{
    thruster_part parts[ALLOCATION_MOST / 2] = {0};
    allocation_column columns[ALLOCATION_MOST] = {0};
    double u[ALLOCATION_MOST] = {0};
    *reached = false;
    if (!(length_over(tau, lever) <= DEMAND_MOST))
        return tau;
    int count = gather_parts(t, vessel, parts);
    int columns_count = columns_of(t, parts, count, columns);
    for (int i = 0; i < columns_count; i++)
        columns[i].effect = counted(columns[i].effect, turn_alone);
    vec3 miss = allocation_solve(columns, columns_count, lever, tau, u, reached);
    /* A little may be missed within reach, by the price of a miss alone. */
    bool settled = *reached || length_over(miss, lever) >= ALLOCATION_NEAR * length_over(tau, lever);
    if (settled && all_fit(t, parts, count, u)) {
        for (int k = 0; k < count; k++) {
            vec2 f = {u[parts[k].column], turns(t, parts[k].row) ? u[parts[k].column + 1] : 0};
            give_order(t, parts[k].row, MODE_BOTH, f);
        }
        return miss;
    }
    thruster_search s = {.t = t, .parts = parts, .count = count, .left = SOLUTIONS_MOST, .lever = lever, .tau = tau};
    s.turn_alone = turn_alone;
    look_further(&s);
    for (int k = 0; k < count; k++)
        give_order(t, parts[k].row, s.best_mode[k], s.best[k]);
    *reached = s.reached;
    return s.miss;
}

vec3 thruster_allocate(thruster_table *t, int32_t vessel, double lever, vec3 tau, bool *reached)
{
    return allocate(t, vessel, lever, tau, false, reached);
}

double thruster_allocate_turn(thruster_table *t, int32_t vessel, double lever, double moment, bool *reached)
{
    return allocate(t, vessel, lever, vec3_make(0, 0, moment), true, reached).z;
}

/* ---- motion ---- */

static double limited(double value, double most) { return fmin(fmax(value, -most), most); }

static double speed_of_thrust(double thrust, double ahead, double astern)
{
    if (thrust >= 0)
        return sqrt(fmin(thrust / ahead, 1));
    return astern > 0 ? -sqrt(fmin(-thrust / astern, 1)) : 0;
}

/* Shaft and angle over one step. */
static void follow_order(thruster_table *t, int32_t row, double dt)
{
    double turn = plane_angle(t->order_angle[row] - t->angle[row]);
    /* While it still turns, it gives only what helps: the order times the cosine of the angle left. */
    double order = turns(t, row) && t->order[row] > 0 ? t->order[row] * fmax(real_cos(turn), 0) : t->order[row];
    double wanted = speed_of_thrust(order, t->ahead[row], t->astern[row]);
    double share = t->time_constant[row] > 0 ? 1 - real_exp(-dt / t->time_constant[row]) : 1;
    t->speed[row] += limited((wanted - t->speed[row]) * share, t->speed_rate[row] * dt);
    t->angle[row] = plane_angle(t->angle[row] + limited(turn, t->turn_rate[row] * dt));
    double n = t->speed[row];
    t->thrust[row] = (n >= 0 ? t->ahead[row] : t->astern[row]) * n * fabs(n);
}

double thruster_push_angle(const thruster_table *t, int32_t row)
{
    if (t->kind[row] == THRUSTER_MAIN && t->thrust[row] < 0)
        return 0;
    return t->angle[row];
}

static bool fail(context *ctx, thruster_table *t, int32_t row, double time, event_table *events)
{
    int32_t number = 0;
    for (int32_t i = 0; i < row; i++)
        number += t->vessel[i] == t->vessel[row];
    bool good = event_add(ctx, events, EVENT_THRUSTER_FAILURE, time, t->vessel[row], number, t->thrust[row]);
    t->failed[row] = 1;
    t->order[row] = t->speed[row] = t->thrust[row] = 0;
    return good;
}

fram_status thruster_step(context *ctx, thruster_table *t, const vessel_table *vessels, const body_table *bodies,
                          double time, double dt, wrench *loads, wrench *sum, event_table *events, fram_error *error)
{
    for (int32_t i = 0; i < t->count; i++) {
        if (!t->failed[i] && time >= t->failure_time[i] && !fail(ctx, t, i, time, events))
            return error_memory(error);
        if (t->failed[i])
            continue;
        follow_order(t, i, dt);
        int32_t body = vessels->body[t->vessel[i]];
        double angle = thruster_push_angle(t, i);
        mat3 r = quat_matrix(bodies->orientation[body]);
        vec3 push = vec3_make(t->thrust[i] * real_cos(angle), t->thrust[i] * real_sin(angle), 0);
        vec3 force = mat3_mul_vec(r, push), arm = mat3_mul_vec(r, t->place[i]);
        wrench_add(&loads[body], vec3_make(0, 0, 0), force, arm);
        wrench_add(&sum[t->vessel[i]], vec3_make(0, 0, 0), force, arm);
    }
    return FRAM_OK;
}

vec3 thruster_effect(const thruster_table *t, int32_t vessel)
{
    vec3 sum = {0};
    for (int32_t i = 0; i < t->count; i++)
        if (t->vessel[i] == vessel && !t->failed[i])
            sum = vec3_mad(sum, effect_along(t, i, thruster_push_angle(t, i)), t->thrust[i]);
    return sum;
}

vec3 thruster_ordered_effect(const thruster_table *t, int32_t vessel)
{
    vec3 sum = {0};
    for (int32_t i = 0; i < t->count; i++)
        if (t->vessel[i] == vessel && !t->failed[i])
            sum = vec3_mad(sum, effect_along(t, i, t->order_angle[i]), t->order[i]);
    return sum;
}
