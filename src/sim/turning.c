#include "sim/turning.h"

#include "base/transcendental.h"
#include "fluid/flow_apply.h"
#include "fluid/hull_load.h"
#include "sim/propulsion_forces.h"

#include <math.h>

/* Rates of turn that are tried, in speeds over lengths: up to circles of a third of the length. */
static const double FASTEST = 3;
enum { RATES = 30, HALVINGS = 20, SWAY_STEPS = 25 };
/* Turns, each at the most helm that was of use in the one before, by which the most that is of use is found. */
enum { HELM_TURNS = 6 };
/* A turn that begins is followed in steps of this part of the time for a length. */
static const double TURN_STEP = 0.05;
enum { TURN_STEPS = 400 };
/* Corners and loops are sailed with this part of the helm, and are so wide that a ship which takes up their curvature
   evenly, from before them to within them, cuts them by this part of its beam. */
static const double EASED = 2.0 / 3, CUT = 0.25;
/* No arc is tighter than this times the way in which the ship is to turn as it is told: on one that is, it has turned
   by half a radian before its helm has answered, and a helm that is slow swings to and fro. */
static const double FORESEEN = 2;
/* In a corner helm to the other side keeps this part of the moment that it has on a straight course: where it has less,
   a hull that is unstable in yaw turns on before it is stopped.  With 0.5 one of 93 by 25 m went past a corner by 1.15
   of its breadth, with 0.55 none of eight by more than 0.79; with 0.7 some have no such corner under WIDEST
   (docs/decisions/0380). */
static const double CHECKED = 0.55;
/* No corner is made wider than so many lengths for that. */
static const double WIDEST = 10;
/* Coefficients of a table of the current that differ by less between its sides are alike. */
static const double ALIKE = 1e-6;

typedef struct turning_search {
    context *ctx;
    const model *m;
    const vessel_model *hull;
    const propulsion_settings *s;
    media water; /* at rest */
    double speed, angle;
    double most_thrust; /* [N] */
    double side;        /* 1: it turns to port; -1: to starboard, of which all is told as if to port */
    bool against;       /* it steers to the other side, by no more than that angle and than the rudders stall at */
} turning_search;

/* Drag of the water on the hull without its lift, and linear damping; ship's axes.  All else that turns a ship has
   equal sides. */
static wrench drag_of(const turning_search *t, double sway, double rate)
{
    if (t->m->forces != FORCES_FLUID || t->hull->solid < 0)
        return (wrench){{0, 0, 0}, {0, 0, 0}};
    const mat3 upright = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    fluid_motion moving = {t->hull->centre, upright, {t->speed, t->side * sway, 0}, {0, 0, t->side * rate}};
    media panels = flows_media(&t->water, &t->hull->flows, moving.velocity);
    fluid_load load;
    fluid_load_solid(t->ctx, &panels, &t->m->drag[MATERIAL_HULL], &t->m->solids.data[t->hull->solid], &moving, &load);
    flows_add(&t->water, &t->hull->flows, upright, moving.velocity, &load);
    wrench out = load.water_drag;
    vec3 damping = propulsion_damping(t->hull, vec3_make(t->speed, t->side * sway, t->side * rate));
    out.force.x += damping.x;
    out.force.y += damping.y;
    out.moment.z += damping.z;
    out.force.y *= t->side;
    out.moment.z *= t->side;
    return out;
}

typedef struct turning_forces {
    double aside, moment; /* [N, N m] */
    double thrust;        /* gross [N] */
} turning_forces;

/* The helm of a ship whose stern moves so [m/s].  Drift has the rudders stall at less helm to the other side, and the
   autopilot asks for no more than that. */
static double helm_at(const turning_search *t, double stern, double thrust)
{
    if (!t->against)
        return t->angle;
    return -fmax(fmin(t->angle, rudder_most_angle(&t->s->rudder, t->speed, -stern, thrust)), -t->angle);
}

/* Of a ship that keeps its speed at a sway and a rate of turn. */
static turning_forces forces_of(const turning_search *t, double sway, double rate)
{
    const propulsion_settings *s = t->s;
    const hull_lift *l = &s->ship.whole;
    double u = t->speed, stern = sway + s->steering_x * rate;
    wrench drag = drag_of(t, sway, rate);
    /* What keeps it going through the turn: drag, and the part of the centripetal force that is along the ship. */
    double asked = -drag.force.x - (s->ship.mass + s->ship.a22) * sway * rate - s->ship.a26 * rate * rate;
    double most = propulsion_net_thrust(s->bollard_pull, s->open_water_speed, u) - drag.force.x;
    most = fmin(most, t->most_thrust);
    double thrust = fmin(fmax(asked, 0), most);
    steering_force f = rudder_force(&s->rudder, u, stern, thrust, helm_at(t, stern, thrust));
    thrust = fmin(fmax(asked + thrust - f.ahead, 0), most);
    f = rudder_force(&s->rudder, u, stern, thrust, helm_at(t, stern, thrust));
    return (turning_forces){u * (l->y_v * sway + l->y_r * rate) + drag.force.y + f.aside - s->ship.mass * u * rate,
                            u * (l->n_v * sway + l->n_r * rate) + drag.moment.z + s->steering_x * f.aside, thrust};
}

/* The moment at a rate of turn, with the sway at which nothing pushes the ship aside any more. */
static double moment_at(const turning_search *t, double rate, double *sway_there)
{
    double low = -2 * t->speed, high = 2 * t->speed, sway = 0;
    for (int i = 0; i < SWAY_STEPS; i++) {
        sway = 0.5 * (low + high);
        if (forces_of(t, sway, rate).aside > 0)
            low = sway;
        else
            high = sway;
    }
    *sway_there = sway;
    return forces_of(t, sway, rate).moment;
}

/* Rate of the steady turn, and its sway; 0: none. */
static double steady_rate(const turning_search *t, double *sway)
{
    double step = FASTEST * t->speed / t->hull->particulars.length / RATES, low = 0;
    if (!(moment_at(t, 0, sway) > 0))
        return 0;
    for (int i = 1; i <= RATES; i++, low += step) {
        if (moment_at(t, i * step, sway) > 0)
            continue;
        double high = low + step;
        for (int k = 0; k < HALVINGS; k++) {
            double middle = 0.5 * (low + high);
            if (moment_at(t, middle, sway) > 0)
                low = middle;
            else
                high = middle;
        }
        return low;
    }
    return low;
}

/* The moment of the helm of most use to the other side in a turn, with the thrust of a straight course: it comes at
   once. */
static double moment_against(turning_search t, double rate)
{
    double sway;
    t.angle = 0;
    t.most_thrust = forces_of(&t, 0, 0).thrust;
    t.angle = t.s->steering_most;
    t.against = true;
    return moment_at(&t, rate, &sway);
}

/* The largest rate of turn, up to one, that helm to the other side checks. */
static double checked_rate(const turning_search *t, double most)
{
    double step = FASTEST * t->speed / t->hull->particulars.length / RATES, low = 0, high = 0;
    double wanted = CHECKED * moment_against(*t, 0);
    while (moment_against(*t, high) <= wanted) {
        if (high >= most)
            return most;
        low = high;
        high = fmin(high + step, most);
    }
    for (int k = 0; k < HALVINGS; k++) {
        double middle = 0.5 * (low + high);
        if (moment_against(*t, middle) <= wanted)
            low = middle;
        else
            high = middle;
    }
    return low;
}

/* Mean yaw acceleration from a straight course, as the helm comes over, to half the rate of the steady turn: the ship
   turns as fast as its steering gear and its sway let it. */
static double yaw_acceleration(const turning_search *t, double rate)
{
    const manoeuvring *ship = &t->s->ship;
    turning_search now = *t;
    double step = TURN_STEP * t->hull->particulars.length / t->speed, sway = 0, r = 0, time = 0;
    for (int i = 0; i < TURN_STEPS && r < 0.5 * rate; i++, time += step) {
        now.angle = fmin(t->s->steering_rate * (time + 0.5 * step), t->angle);
        turning_forces f = forces_of(&now, sway, r);
        double turn = (f.moment - manoeuvring_lever(ship) * f.aside) / manoeuvring_inertia(ship);
        sway += step * (f.aside - ship->a26 * turn) / (ship->mass + ship->a22);
        r += step * turn;
    }
    return r / time;
}

/* To port at full helm, in water at rest. */
static turning_search search_of(context *ctx, const model *m, int32_t vessel, const propulsion_settings *s,
                                double speed)
{
    turning_search t = {ctx, m, &m->vessels.data[vessel], s, m->media, speed, s->steering_most, HUGE_VAL, 1, false};
    t.water.current = t.water.wind = (vec3){0, 0, 0};
    t.water.profile.count = 0;
    return t;
}

/* The helm to the side of t past which its rudders turn it no more tightly: that of a turn changes with the turn. */
static double helm_to(turning_search t)
{
    const propulsion_settings *s = t.s;
    for (int i = 0; i < HELM_TURNS; i++) {
        double sway, rate = steady_rate(&t, &sway), thrust = forces_of(&t, sway, rate).thrust;
        double most = rudder_most_angle(&s->rudder, t.speed, sway + s->steering_x * rate, thrust);
        t.angle = fmin(s->steering_most, most);
    }
    return t.angle;
}

double turning_helm_of(context *ctx, const model *m, int32_t vessel, const propulsion_settings *s, double speed)
{
    turning_search t = search_of(ctx, m, vessel, s, speed);
    double straight = rudder_most_angle(&s->rudder, speed, 0, 0);
    if (!(speed > 0 && s->rudder.area > 0) || s->steering_most <= straight)
        return s->steering_most;
    double helm = fmax(straight, helm_to(t));
    if (!turning_sides_differ(t.hull))
        return helm;
    t.side = -1;
    return fmax(helm, helm_to(t));
}

bool turning_sides_differ(const vessel_model *hull)
{
    const flow_table *f = &hull->flows.water;
    for (int32_t i = 0; i < f->count; i++) {
        vec3 one = f->coefficient[i], other = flow_coefficients(f, 2 * PI - f->angle[i]);
        if (fabs(one.x - other.x) > ALIKE || fabs(one.y + other.y) > ALIKE || fabs(one.z + other.z) > ALIKE)
            return true;
    }
    return false;
}

/* How it turns to the side of t. */
static turning_ability ability_to(turning_search t)
{
    const vessel_model *hull = t.hull;
    const propulsion_settings *s = t.s;
    double length = hull->particulars.length, speed = t.speed;
    turning_ability out = {length, length, length, 0, speed};
    double sway, full = steady_rate(&t, &sway);
    t.angle = EASED * s->steering_most;
    double eased = steady_rate(&t, &sway);
    if (!(full > 0) || !(eased > 0))
        return out;
    /* Odd data may have it turn the other way at first: of such a ship nothing is known. */
    double begins = yaw_acceleration(&t, eased);
    if (!(begins > 0 && isfinite(begins)))
        return out;
    out.radius = speed / full;
    out.drift = -sway / eased;
    /* Taken up over a way w = reach^2 / R a bend is cut by w^2 / (24 R). */
    out.reach = speed / sqrt(begins);
    double square = out.reach * out.reach, eased_radius = speed / eased;
    double uncut = real_cbrt(square * square / (24 * CUT * hull->particulars.beam));
    double lag = autopilot_lag(&out, length, speed, s->steering_most, s->steering_rate);
    out.corner = fmax(fmax(eased_radius, uncut), FORESEEN * speed * lag);
    out.corner = fmax(out.corner, fmin(speed / checked_rate(&t, eased), WIDEST * length));
    return out;
}

turning_ability turning_ability_of(context *ctx, const model *m, int32_t vessel, const propulsion_settings *s,
                                   double speed)
{
    turning_search t = search_of(ctx, m, vessel, s, speed);
    const vessel_model *hull = t.hull;
    double length = hull->particulars.length;
    /* Of a helm that does not move rounding alone would be followed. */
    if (!(speed > 0 && s->steering_most > 0))
        return (turning_ability){length, length, length, 0, speed};
    turning_ability port = ability_to(t);
    if (!turning_is_found(&port) || !turning_sides_differ(hull))
        return port;
    t.side = -1;
    turning_ability starboard = ability_to(t), out = port;
    if (!turning_is_found(&starboard) || starboard.radius > port.radius)
        out = starboard;
    if (turning_is_found(&out))
        out.corner = fmax(port.corner, starboard.corner);
    return out;
}

double turning_checked_radius(context *ctx, const model *m, int32_t vessel, const propulsion_settings *s)
{
    turning_search t = search_of(ctx, m, vessel, s, s->turning.speed);
    double most = FASTEST * t.speed / t.hull->particulars.length, rate = checked_rate(&t, most);
    t.side = -1;
    return t.speed / fmin(rate, turning_sides_differ(t.hull) ? checked_rate(&t, most) : rate);
}

bool turning_is_found(const turning_ability *t) { return t->drift != 0; }

bool turning_is_sought_no_further(const turning_ability *t, const vessel_model *hull)
{
    const double rounding = 1e-9;
    return t->radius * FASTEST < (1 + rounding) * hull->particulars.length;
}

bool turning_goes_on(context *ctx, const model *m, int32_t vessel, const propulsion_settings *s)
{
    turning_search t = search_of(ctx, m, vessel, s, s->turning.speed);
    double sway;
    t.angle = 0;
    return moment_at(&t, FASTEST * t.speed / t.hull->particulars.length, &sway) > 0;
}
