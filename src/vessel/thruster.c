#include "vessel/thruster.h"

#include "vessel/plane_motion.h"

#include <float.h>
#include <stdio.h>

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

/* How a thruster takes part in one pass of the allocation. */
typedef struct thruster_part {
    int32_t row;
    int column; /* its first */
    bool free;  /* two thrusts, along and across; otherwise one along `angle` */
    double angle, lo, hi;
} thruster_part;

static bool turns(const thruster_table *t, int32_t row)
{
    return t->kind[row] == THRUSTER_AZIMUTH || (t->kind[row] == THRUSTER_MAIN && t->rudder[row] > 0);
}

static vec3 effect_along(const thruster_table *t, int32_t row, double angle)
{
    double c = real_cos(angle), s = real_sin(angle);
    return vec3_make(c, s, t->place[row].x * s - t->place[row].y * c);
}

static int gather_parts(const thruster_table *t, int32_t vessel, thruster_part *parts)
{
    int count = 0;
    for (int32_t i = 0; i < t->count && 2 * count + 2 <= ALLOCATION_MOST; i++) {
        if (t->vessel[i] != vessel || t->failed[i])
            continue;
        double angle = t->kind[i] == THRUSTER_TUNNEL ? 0.5 * PI : 0;
        parts[count++] = (thruster_part){i, 0, turns(t, i), angle, -t->astern[i], t->ahead[i]};
    }
    return count;
}

static int columns_of(const thruster_table *t, thruster_part *parts, int count, allocation_column *columns)
{
    int n = 0;
    for (int k = 0; k < count; k++) {
        thruster_part *p = &parts[k];
        p->column = n;
        double cost = t->cost[p->row], most = t->ahead[p->row];
        if (p->free) {
            double back = t->kind[p->row] == THRUSTER_MAIN ? t->astern[p->row] : most;
            columns[n++] = (allocation_column){effect_along(t, p->row, 0), cost, -back, most};
            columns[n++] = (allocation_column){effect_along(t, p->row, 0.5 * PI), cost, -most, most};
        } else {
            columns[n++] = (allocation_column){effect_along(t, p->row, p->angle), cost, p->lo, p->hi};
        }
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

/* A turning thruster whose pair of thrusts is not allowed is held to one direction; false: it is fine as it is. */
static bool hold_direction(const thruster_table *t, thruster_part *p, const double *u)
{
    double x = u[p->column], y = u[p->column + 1], thrust = sqrt(x * x + y * y), most = t->ahead[p->row];
    if (!(thrust > 1e-9 * most))
        return false;
    double angle = real_atan2(y, x);
    bool astern = t->kind[p->row] == THRUSTER_MAIN && x < 0;
    double allowed = astern ? 0 : thruster_allowed_angle(t, p->row, angle);
    bool fits = !astern && allowed == angle && thrust <= most * (1 + 1e-12);
    if (fits)
        return false;
    p->free = false;
    p->angle = allowed;
    p->lo = astern ? -t->astern[p->row] : 0;
    p->hi = astern ? 0 : most;
    return true;
}

static void give_order(thruster_table *t, const thruster_part *p, const double *u)
{
    int32_t row = p->row;
    if (!p->free) {
        t->order[row] = u[p->column];
        t->order_angle[row] = p->angle;
        return;
    }
    double x = u[p->column], y = u[p->column + 1];
    t->order[row] = sqrt(x * x + y * y);
    if (t->order[row] > 1e-3 * t->ahead[row]) /* an idle thruster need not turn */
        t->order_angle[row] = real_atan2(y, x);
}

vec3 thruster_allocate(thruster_table *t, int32_t vessel, double lever, vec3 tau, bool *reached)
{
    thruster_part parts[ALLOCATION_MOST / 2] = {0};
    allocation_column columns[ALLOCATION_MOST] = {0};
    double u[ALLOCATION_MOST] = {0};
    int count = gather_parts(t, vessel, parts);
    vec3 miss = tau;
    *reached = false;
    for (bool settled = false; !settled;) {
        int n = columns_of(t, parts, count, columns);
        miss = allocation_solve(columns, n, lever, tau, u, reached);
        settled = true;
        for (int k = 0; k < count; k++)
            if (parts[k].free && hold_direction(t, &parts[k], u))
                settled = false;
    }
    for (int k = 0; k < count; k++)
        give_order(t, &parts[k], u);
    return miss;
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
