#include "vessel/holding.h"

#include <math.h>

/* The multiple of a load that thrusters balance is sought from one over this to this, to this part of itself. */
#define MOST_MULTIPLE 1e4
#define MULTIPLE_PRECISION 1e-4
/* A ship whose heading is held is kept there by a spring of this many times the load's force on its length. */
#define HEADING_STIFFNESS 1e4
/* Thrusters that hold a heading must do so this far to both sides too, since no ship lies quite still: a balance that
   any touch ends is held only by thrusters that can turn [deg], 0.5 to 3. */
#define BESIDE_DEG 1.0
/* What moment they must have to spare there, in parts of the load on half the length: 0.003, above ALLOCATION_NEAR, to
   0.1. */
#define MOMENT_TO_SPARE 0.01
/* Where the moment comes first, one that is missed weighs as on this part of half the length: 0.03 to 0.001. */
#define MOMENT_FIRST 0.01
/* How well the moment that is asked of them is found, in the same parts, and in parts of the lines' tensions. */
#define ASKED_PRECISION 1e-4
#define PULLS_PRECISION 1e-6

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
    vec3 demand, missed, thrust; /* of the thrusters: asked, not given and given, vessel frame */
    bool turns;                  /* nothing but the lines holds the heading */
    double stiffness;            /* that keeps a heading which is held [N m/rad] */
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

static double pulls_of(const holding_case *c)
{
    const line_table *l = c->lines;
    double pulls = 0;
    for (int32_t i = 0; i < l->count; i++)
        if (l->vessel[i] == c->vessel)
            pulls += l->tension[i];
    return pulls;
}

/* Where the lines hold the ship. */
static bool find_pose(const rest_load *rest, vec3 *position, quat *orientation)
{
    const holding_case *c = rest->c;
    rest_load held = *rest;
    vec3 steady = rest->load(rest->user, c->heading);
    held.stiffness = HEADING_STIFFNESS * (sqrt(steady.x * steady.x + steady.y * steady.y) + pulls_of(c)) * c->length;
    *position = c->position;
    *orientation = quat_from_roll_pitch_yaw(0, 0, c->heading);
    return (rest->turns ? mooring_rest : mooring_nearest_balance)(c->lines, c->vessel, c->length, rest_of, &held,
                                                                  position, orientation);
}

static holding hold_by_lines(const rest_load *rest)
{
    const holding_case *c = rest->c;
    vec3 position;
    quat orientation;
    holding out = {.number = -1};
    if (!find_pose(rest, &position, &orientation)) {
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

/* ---- heading ---- */

/* At the heading of `c`, before the lines' moment is known. */
static rest_load rest_at(const holding_case *c, steady_load load, const void *user)
{
    rest_load r = {.c = c, .load = load, .user = user};
    r.demand = plane_to_vessel(c->heading, vec3_neg(load(user, c->heading)));
    if (c->heading_alone)
        r.demand = vec3_make(0, 0, r.demand.z);
    return r;
}

/* The moment that may be missed because it has a price. */
static double may_be_missed(const rest_load *r)
{
    double lever = 0.5 * r->c->length;
    return ALLOCATION_NEAR * lever * vec3_length(vec3_make(r->demand.x, r->demand.y, r->demand.z / lever));
}

/* Where not all can be given, the moment comes first: lines take any force, but hardly turn a ship. */
static void push(rest_load *r)
{
    const holding_case *c = r->c;
    balances(c, r->demand, &r->missed);
    if (!c->heading_alone && fabs(r->missed.z) > may_be_missed(r)) {
        bool reached;
        vec3 missed = thruster_allocate(c->thrusters, c->vessel, MOMENT_FIRST * 0.5 * c->length, r->demand, &reached);
        if (fabs(missed.z) < fabs(r->missed.z))
            r->missed = missed;
    }
    /* What force comes with a moment alone is for the lines. */
    r->thrust = c->heading_alone ? thruster_ordered_effect(c->thrusters, c->vessel) : vec3_sub(r->demand, r->missed);
}

/* The load on half the length [N m]. */
static double moment_scale(const rest_load *r)
{
    double lever = 0.5 * r->c->length;
    vec3 steady = r->load(r->user, r->c->heading);
    steady.z /= lever;
    return lever * vec3_length(steady);
}

/* What load and lines ask of thrusters that keep the heading, beyond `asked` [N m]; a NaN where no lines hold it. */
static double asked_more(rest_load *r, double asked)
{
    const holding_case *c = r->c;
    vec3 position;
    quat orientation;
    r->demand.z = asked;
    push(r);
    if (!find_pose(r, &position, &orientation))
        return (double)NAN;
    wrench lines = mooring_pull(c->lines, c->vessel, position, orientation);
    return -r->load(r->user, c->heading).z - lines.moment.z - asked;
}

/* The moment that thrusters are asked for becomes what keeps the heading against load and lines.  The force that comes
   with it moves the ship, and the lines turn it otherwise: sought in the direction of what is asked more, as a
   controller finds it, then by false position (Illinois).  false: none. */
static bool ask_moment(rest_load *r)
{
    enum { MOST_DOUBLINGS = 30, MOST_STEPS = 60 };
    double enough = ASKED_PRECISION * moment_scale(r) + PULLS_PRECISION * 0.5 * r->c->length * pulls_of(r->c);
    double low = r->demand.z, more = asked_more(r, low), step = more;
    if (fabs(more) <= enough)
        return true;
    double high = low + step, less = asked_more(r, high);
    for (int i = 0; i < MOST_DOUBLINGS && less * more > 0 && fabs(less) > enough; i++) {
        low = high;
        more = less;
        step *= 2;
        high += step;
        less = asked_more(r, high);
    }
    for (int i = 0; i < MOST_STEPS && less * more < 0 && fabs(less) > enough; i++) {
        double next = (low * less - high * more) / (less - more), left = asked_more(r, next);
        if (left * less < 0) {
            low = high;
            more = less;
        } else {
            more *= 0.5;
        }
        high = next;
        less = left;
    }
    return fabs(less) <= enough;
}

/* Whether load, lines and thrusters together turn the ship back from beside its heading (side: 1 to port, -1). */
static bool turns_back(const rest_load *r, double side)
{
    holding_case beside = *r->c;
    beside.heading += side * radians(BESIDE_DEG);
    rest_load there = rest_at(&beside, r->load, r->user);
    if (!ask_moment(&there))
        return false;
    there.demand.z -= side * MOMENT_TO_SPARE * moment_scale(&there);
    push(&there);
    return side * there.missed.z >= -may_be_missed(&there);
}

/* Asks the thrusters for what keeps the heading; whether they do. */
static bool keeps_heading(rest_load *r)
{
    const rest_load by_load = *r;
    if (!ask_moment(r)) {
        *r = by_load;
        push(r);
        return false;
    }
    return fabs(r->missed.z) <= may_be_missed(r) && turns_back(r, 1) && turns_back(r, -1);
}

holding holding_find(const holding_case *c, steady_load load, const void *user)
{
    rest_load rest = rest_at(c, load, user);
    bool thrusters = has_thrusters(c);
    if (!has_lines(c) && c->heading_alone)
        return (holding){.use = HUGE_VAL, .item = HOLDING_NOTHING, .number = -1};
    if (!has_lines(c)) {
        double use = thrusters ? use_of_thrusters(c, rest.demand) : HUGE_VAL;
        return (holding){use, thrusters ? HOLDING_THRUSTER : HOLDING_NOTHING, nearest_to_limit(c), use, 0, 0, 0};
    }
    if (thrusters)
        push(&rest);
    rest.turns = !c->heading_given && !(thrusters && keeps_heading(&rest));
    holding out = hold_by_lines(&rest);
    /* Beyond what they can give, the thrusters are not at fault: the mooring is there. */
    out.thruster_use = thrusters ? fmin(use_of_thrusters(c, rest.demand), 1) : 0;
    return out;
}
