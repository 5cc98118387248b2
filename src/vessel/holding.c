#include "vessel/holding.h"

#include <math.h>

/* The multiple of a load that thrusters balance is sought from one over this to this, to this part of itself. */
#define MOST_MULTIPLE 1e4
#define MULTIPLE_PRECISION 1e-4
/* A ship whose heading is held is kept there by a spring of this many times the load's force on its length. */
#define HEADING_STIFFNESS 1e4

const char *holding_item_name(holding_item item)
{
    static const char *const names[HOLDING_ITEM_COUNT] = {"nothing", "thruster", "line", "offset", "heading"};
    return item >= 0 && item < HOLDING_ITEM_COUNT ? names[item] : "nothing";
}

/* ---- thrusters ---- */

static bool has_thrusters(const holding_case *c)
{
    for (int32_t i = 0; i < c->thrusters->count; i++)
        if (c->thrusters->vessel[i] == c->vessel && !c->thrusters->failed[i])
            return true;
    return false;
}

static bool balances(const holding_case *c, vec3 demand, vec3 *missed)
{
    bool reached;
    double lever = 0.5 * c->length;
    if (c->heading_alone)
        *missed = vec3_make(0, 0, thruster_allocate_turn(c->thrusters, c->vessel, lever, demand.z, &reached));
    else
        *missed = thruster_allocate(c->thrusters, c->vessel, lever, demand, &reached);
    return reached;
}

/* Whether what thrusters miss of a demand leaves them the heading: no moment, but for what that has a price. */
static bool holds_turn(const holding_case *c, vec3 demand, vec3 missed)
{
    double lever = 0.5 * c->length;
    demand.z /= lever;
    return fabs(missed.z) <= ALLOCATION_NEAR * lever * vec3_length(demand);
}

/* The thruster nearest to its limit, by the orders. */
static int32_t nearest_to_limit(const holding_case *c)
{
    const thruster_table *t = c->thrusters;
    int32_t best = -1;
    double most = -1;
    for (int32_t i = 0; i < t->count; i++) {
        if (t->vessel[i] != c->vessel || t->failed[i])
            continue;
        double limit = t->order[i] >= 0 ? t->ahead[i] : t->astern[i];
        double share = limit > 0 ? fabs(t->order[i]) / limit : 0;
        if (share > most * (1 + 1e-9)) {
            most = share;
            best = i;
        }
    }
    return best;
}

/* One over the largest multiple of the demand that is balanced; the orders are those for it. */
static double use_of_thrusters(const holding_case *c, vec3 demand)
{
    vec3 missed;
    double low = 0, high = 1;
    if (balances(c, demand, &missed)) {
        for (low = 1, high = 2; high < MOST_MULTIPLE && balances(c, vec3_scale(demand, high), &missed); high *= 2)
            low = high;
        if (high >= MOST_MULTIPLE)
            return 1 / MOST_MULTIPLE;
    }
    while (high - low > MULTIPLE_PRECISION * high && high > 1 / MOST_MULTIPLE) {
        double middle = 0.5 * (low + high);
        if (balances(c, vec3_scale(demand, middle), &missed))
            low = middle;
        else
            high = middle;
    }
    balances(c, vec3_scale(demand, low > 0 ? low : high), &missed);
    return low > 0 ? 1 / low : HUGE_VAL;
}

/* ---- mooring ---- */

/* What the mooring has to balance. */
typedef struct rest_load {
    const holding_case *c;
    steady_load load;
    const void *user;
    vec3 thrust;      /* that the thrusters give, vessel frame */
    bool turns;       /* nothing but the lines holds the heading */
    double stiffness; /* that keeps a heading which is held [N m/rad] */
} rest_load;

static vec3 rest_of(const void *user, double heading)
{
    const rest_load *r = user;
    vec3 sum = r->load(r->user, heading);
    sum = vec3_add(sum, plane_to_global(heading, r->thrust));
    if (!r->turns)
        sum.z = -r->stiffness * plane_angle(heading - r->c->heading);
    return sum;
}

static void count_line_tensions(const holding_case *c, vec3 position, quat orientation, holding *out)
{
    const line_table *l = c->lines;
    for (int32_t i = 0; i < l->count; i++) {
        if (l->vessel[i] != c->vessel || l->broken[i])
            continue;
        double share = mooring_line_pull(l, i, position, orientation).tension * c->line_safety / l->breaking_load[i];
        if (share > out->line_use) {
            out->line_use = share;
            out->number = i;
        }
    }
}

static void count(holding *out, double share, holding_item item, int32_t number)
{
    if (!(share > out->use))
        return;
    out->use = share;
    out->item = item;
    out->number = number;
}

static holding hold_by_lines(const holding_case *c, const rest_load *rest, double force)
{
    rest_load held = *rest;
    double pulls = 0;
    for (int32_t i = 0; i < c->lines->count; i++)
        pulls += c->lines->tension[i];
    held.stiffness = HEADING_STIFFNESS * (force + pulls) * c->length;
    vec3 position = c->position;
    quat orientation = quat_from_roll_pitch_yaw(0, 0, c->heading);
    holding out = {.number = -1};
    bool found = (rest->turns ? mooring_rest : mooring_nearest_balance)(c->lines, c->vessel, c->length, rest_of, &held,
                                                                        &position, &orientation);
    if (!found) {
        out.use = HUGE_VAL;
        return out;
    }
    quat home = quat_from_roll_pitch_yaw(0, 0, c->heading);
    vec3 at = vec3_add(position, mat3_mul_vec(quat_matrix(orientation), c->watched));
    vec3 wanted = vec3_add(c->position, mat3_mul_vec(quat_matrix(home), c->watched));
    out.offset = sqrt((at.x - wanted.x) * (at.x - wanted.x) + (at.y - wanted.y) * (at.y - wanted.y));
    out.turn = fabs(plane_angle(quat_roll_pitch_yaw(orientation).z - c->heading));
    count_line_tensions(c, position, orientation, &out);
    count(&out, out.line_use, HOLDING_LINE, out.number);
    count(&out, out.offset / c->offset_limit, HOLDING_OFFSET, -1);
    count(&out, out.turn / c->heading_limit, HOLDING_HEADING, -1);
    return out;
}

static bool has_lines(const holding_case *c)
{
    for (int32_t i = 0; i < c->lines->count; i++)
        if (c->lines->vessel[i] == c->vessel && !c->lines->broken[i])
            return true;
    return false;
}

holding holding_find(const holding_case *c, steady_load load, const void *user)
{
    vec3 steady = load(user, c->heading), demand = plane_to_vessel(c->heading, vec3_neg(steady)), missed = demand;
    bool thrusters = has_thrusters(c);
    if (c->heading_alone)
        missed = demand = vec3_make(0, 0, demand.z);
    double use = thrusters ? use_of_thrusters(c, demand) : HUGE_VAL;
    int32_t busiest = nearest_to_limit(c);
    if (!has_lines(c) && c->heading_alone)
        return (holding){.use = HUGE_VAL, .item = HOLDING_NOTHING, .number = -1};
    if (!has_lines(c))
        return (holding){use, thrusters ? HOLDING_THRUSTER : HOLDING_NOTHING, busiest, use, 0, 0, 0};
    if (thrusters)
        balances(c, demand, &missed);
    bool turns = !c->heading_given && !(thrusters && holds_turn(c, demand, missed));
    rest_load rest = {c, load, user, vec3_sub(demand, missed), turns, 0};
    if (thrusters && c->heading_alone) /* what force comes with the moment is for the lines */
        rest.thrust = thruster_ordered_effect(c->thrusters, c->vessel);
    holding out = hold_by_lines(c, &rest, sqrt(steady.x * steady.x + steady.y * steady.y));
    /* Beyond what they can give, the thrusters are not at fault: the mooring is there. */
    out.thruster_use = thrusters ? fmin(use, 1) : 0;
    return out;
}
