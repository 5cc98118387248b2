#include "base/number_text.h"
#include "base/transcendental.h"
#include "sim/build_station.h"
#include "sim/sanity_parts.h"
#include "sim/vessel_speed.h"
#include "vessel/propulsion.h"

#include <math.h>

/* ---- dynamic positioning ---- */

/* Of 1 over the frequency: a controller that acts or measures less often swings to and fro or loses the vessel.  A box
   of 100 m with three azimuth thrusters in a current does from 0.8 on, with samples from 0.7 on where the passive
   observer takes the last one for what is so now. */
#define SLOWEST_CALL 0.7
#define SLOWEST_SAMPLE_PASSIVE 0.6
#define SLOWEST_SAMPLE_KALMAN 1.0
/* The faster the observer the sooner: at a frequency of 0.02 rad/s, and no damping in the model, that box is lost from
   0.52, 0.38, 0.29 and 0.24 on with an observer 2, 5, 10 and 30 times as fast: about this part of 1 over the frequency
   and that of 1 over the observer's bandwidth together.  Samples that a passive observer holds for longer than it takes
   to follow them tell it that the vessel stands still. */
#define SLOWEST_CALL_FAST 0.2
#define SLOWEST_CALL_OBSERVER 0.9
#define SLOWEST_SAMPLE_OBSERVER 2.0

/* Of a Kalman filter that is called so often: of three poles alike, as where its bias alone is unsure. */
double sanity_observer_bandwidth(const scenario *s, const scenario_positioning *p, double interval)
{
    double noise = fmax(p->noise_position, 0.01 * scenario_size(s));
    if (p->observer == OBSERVER_PASSIVE)
        return p->observer_bandwidth;
    return real_cbrt(p->bias_rate / (noise * sqrt(fmax(interval, s->run.time_step))));
}

static double slowest_call(const teller *t)
{
    const scenario_positioning *p = &t->e->keys->positioning;
    double bandwidth = sanity_observer_bandwidth(t->s, p, p->interval), slowest = SLOWEST_CALL / p->frequency;
    if (!(bandwidth > 0)) /* a filter that takes its bias for known follows none, however often it is called */
        return slowest;
    return fmin(slowest, SLOWEST_CALL_FAST / p->frequency + SLOWEST_CALL_OBSERVER / bandwidth);
}

static double slowest_sample(const teller *t)
{
    const scenario_positioning *p = &t->e->keys->positioning;
    if (p->observer != OBSERVER_PASSIVE)
        return SLOWEST_SAMPLE_KALMAN / p->frequency;
    double held = p->sample_interval > p->interval ? SLOWEST_SAMPLE_OBSERVER / p->observer_bandwidth : HUGE_VAL;
    return fmin(SLOWEST_SAMPLE_PASSIVE / p->frequency, held);
}

/* More than `slowest` [s] is too seldom. */
static void tell_interval(const teller *t, const char *key, double interval, double slowest)
{
    const scenario_positioning *p = &t->e->keys->positioning;
    double frequency = p->frequency, period = 2 * PI / frequency;
    if (interval > t->s->run.duration)
        sanity_say(t->tell, t->to, "%s.positioning.%s: %.4g s is longer than the run, %.4g s: give seconds", t->e->path,
                   key, interval, t->s->run.duration);
    else if (interval > slowest)
        sanity_say(t->tell, t->to,
                   "%s.positioning.%s: once in %.4g s is too seldom for a controlled period of %.3g s "
                   "(positioning.frequency %.3g rad/s) and an observer of %.2g rad/s: take %.2g s or less",
                   t->e->path, key, interval, period, frequency, sanity_observer_bandwidth(t->s, p, interval),
                   fmin(0.1 / frequency, 0.5 * slowest));
    else if (interval > 0 && interval < t->s->run.time_step * (1 - 1e-9))
        sanity_say(t->tell, t->to, "%s.positioning.%s: %.4g s is shorter than run.time_step, %.4g s: it is a step",
                   t->e->path, key, interval, t->s->run.time_step);
}

/* Masses of the controller's model over those of the vessel and its water. */
#define MODEL_MASS_LEAST 0.3
#define MODEL_MASS_MOST 5.0

static void tell_model_mass(const teller *t, const char *key, double mass)
{
    double own = sanity_about_mass(t->s, t->e->keys);
    if (!is_automatic(mass) && own > 0 && (mass < MODEL_MASS_LEAST * own || mass > MODEL_MASS_MOST * own))
        sanity_say(t->tell, t->to,
                   "%s.positioning.%s: %.4g kg is %.3g of the vessel's mass, about %.3g kg: give kilograms with the "
                   "added mass",
                   t->e->path, key, mass, mass / own, own);
}

/* Levers, in lengths of the ship, under which thrusters do not turn it. */
#define LEAST_LEVER 1e-3

/* What no thruster gives whatever the others do: a controller that asks for it gets nothing.  Lines hold what thrusters
   that assist them do not. */
static void tell_reach(const teller *t)
{
    const scenario_vessel *v = t->e->keys;
    bool all = v->positioning.control != CONTROL_HEADING, ahead = false, aside = false, turns = false;
    if (all && v->mooring.lines.count > 0)
        return;
    for (int32_t i = 0; i < v->thrusters.count; i++) {
        const scenario_thruster *p = &v->thrusters.data[i], *first = v->thrusters.data;
        bool along = p->kind != THRUSTER_TUNNEL, across = p->kind != THRUSTER_MAIN || p->rudder_deg > 0;
        /* Where position is held too, turning takes two of them apart; one alone that pushes aside turns no less. */
        double x = all ? p->x - first->x : p->x, y = all ? p->y - first->y : p->y;
        double lever = fmax(along ? fabs(y) : 0, across ? fabs(x) : 0);
        ahead = ahead || along;
        aside = aside || across;
        turns = turns || lever > LEAST_LEVER * v->hull.length;
    }
    const char *lacks = all && !ahead ? "ahead" : all && !aside ? "aside" : NULL;
    if (lacks)
        sanity_say(t->tell, t->to,
                   "%s.positioning: no thruster pushes the vessel %s: its position is not held that way", t->e->path,
                   lacks);
    else if (!turns)
        sanity_say(t->tell, t->to, "%s.positioning: the thrusters do not turn the vessel, %s: its heading is not held",
                   t->e->path, all ? "for all of them are at one place" : "for they push through amidships");
}

/* The first way point that is not asked for in the run. */
static void tell_late(const teller *t)
{
    const scenario_positioning *p = &t->e->keys->positioning;
    for (int32_t i = 0; i < p->waypoints.count; i++) {
        if (p->waypoints.data[i].time <= t->s->run.duration)
            continue;
        sanity_say(t->tell, t->to,
                   "%s.positioning.waypoints[%d].time: %g s is after the end of the run, %g s: the vessel does not go "
                   "there",
                   t->e->path, (int)i, p->waypoints.data[i].time, t->s->run.duration);
        return;
    }
}

/* Way points that no controller follows move the place that limits and offsets count from. */
static void tell_unsteered(const teller *t)
{
    if (t->e->keys->mode == VESSEL_FREE && t->e->keys->positioning.waypoints.count > 0)
        sanity_say(t->tell, t->to,
                   "%s.positioning.waypoints: the vessel is not steered there, since positioning.active is false, but "
                   "its %s counts from them",
                   t->e->path, t->e->keys->positioning.control == CONTROL_HEADING ? "heading's deviation" : "offset");
}

static void tell_positioning(const teller *t)
{
    const scenario_positioning *p = &t->e->keys->positioning;
    if (!p->active) {
        tell_unsteered(t);
        return;
    }
    tell_reach(t);
    tell_late(t);
    tell_interval(t, "interval", p->interval, slowest_call(t));
    tell_interval(t, "sample_interval", p->sample_interval, slowest_sample(t));
    tell_model_mass(t, "mass_surge", p->mass_surge);
    tell_model_mass(t, "mass_sway", p->mass_sway);
    if (!(p->damping > 0))
        sanity_say(t->tell, t->to,
                   "%s.positioning.damping: a controlled vessel of relative damping 0 swings to and fro for ever: "
                   "take 0.7 to 1",
                   t->e->path);
    double limit = t->e->keys->station.offset_limit;
    if (p->control != CONTROL_HEADING && p->noise_position > automatic_or(limit, HUGE_VAL))
        sanity_say(t->tell, t->to,
                   "%s.positioning.noise_position: a standard deviation of %.4g m is more than station.offset_limit, "
                   "%.4g m: give metres",
                   t->e->path, p->noise_position, limit);
    double period = 2 * PI / p->frequency;
    if (t->s->run.duration < period)
        sanity_say(t->tell, t->to,
                   "run.duration: %.4g s is less than one period of the controlled vessel, %.3g s "
                   "(%s.positioning.frequency %.3g rad/s)",
                   t->s->run.duration, period, t->e->path, p->frequency);
}

/* ---- thrusters ---- */

/* Power over thrust of a propeller at bollard condition, full size [W/N]: 4 to 8 of thrusters (Dang and Laheij 2004,
   Hydrodynamic aspects of steerable thrusters); it goes with the speed of the jet. */
#define POWER_LEAST 1.0
#define POWER_MOST 50.0
/* Draughts under the waterline at which a propeller still belongs to the hull. */
#define DEEPEST 2.0

static void tell_thruster(const teller *t, int32_t i)
{
    const scenario_vessel *v = t->e->keys;
    const scenario_thruster *p = &v->thrusters.data[i];
    const usual_range usual = usual_range_at_scale(t->s, POWER_LEAST, POWER_MOST, 0.5);
    double ratio = automatic_or(p->power, (double)NAN) / thruster_largest_thrust(p);
    if (ratio < usual.least || ratio > usual.most)
        sanity_say(t->tell, t->to,
                   "%s.thrusters[%d].power: %.4g W is %.3g W for each newton of thrust, %.3g to %.3g are usual: give "
                   "watts, not kW or MW",
                   t->e->path, (int)i, p->power, ratio, usual.least, usual.most);
    if (sanity_own_hull(v) && (p->z > 0 || p->z < -DEEPEST * v->hull.draught))
        sanity_say(t->tell, t->to,
                   "%s.thrusters[%d].z: %.4g m %s: give metres above the design waterline, negative under it",
                   t->e->path, (int)i, p->z, p->z > 0 ? "is above the water" : "is far below the hull");
    double early = t->s->run.transient;
    if (!is_automatic(p->failure_time) && p->failure_time > 0 && p->failure_time < early)
        sanity_say(t->tell, t->to,
                   "%s.thrusters[%d].failure_time: it fails at %g s, in the transient of %g s that statistics leave "
                   "out: give seconds, or 0 for a thruster that is out of order from the start",
                   t->e->path, (int)i, p->failure_time, early);
}

/* ---- propulsion ---- */

/* Bollard pull on the discs of the propellers [Pa], full size: 20 to 100 kPa; tens of times more is a diameter in
   another unit. */
#define DISC_MOST 1e6
#define DISC_LEAST 2e3
/* In lengths of the ship. */
#define LOOKAHEAD_LEAST 0.2
#define LOOKAHEAD_MOST 50.0
#define STEERING_MOST 0.75 /* overhang and all */
#define RAM_LEAST 0.05
#define RAM_MOST 20.0

static void tell_in_lengths(const teller *t, const char *key, double value, double least, double most)
{
    double length = t->e->keys->hull.length;
    if (!is_automatic(value) && (value < least * length || value > most * length))
        sanity_say(t->tell, t->to,
                   "%s.propulsion.%s: %.4g m is %.3g lengths of the ship, outside of %.3g to %.3g: give "
                   "metres",
                   t->e->path, key, value, value / length, least, most);
}

static void tell_helm(const teller *t)
{
    const scenario_propulsion *p = &t->e->keys->propulsion;
    if (p->steering_angle_deg == 0 && (p->waypoints.count > 0 || p->pattern.kind != PATTERN_NONE))
        sanity_say(t->tell, t->to,
                   "%s.propulsion.steering_angle_deg: 0 steers no ship: it does not keep its %s; give an angle, 35 of "
                   "rudders",
                   t->e->path, p->waypoints.count > 0 ? "way points" : "pattern");
}

/* Ships so slow that ice stops them for good, or again and again. */
static void tell_slow(const teller *t)
{
    const scenario_vessel *v = t->e->keys;
    const scenario_propulsion *p = &v->propulsion;
    double most = vessel_open_water_speed(p), least = propulsion_least_lack(most);
    double wanted = automatic_or(p->speed, HUGE_VAL), lacks = vessel_speed_lost_in_ice(t->s, t->read, wanted);
    if (lacks >= least && p->beset_speed >= vessel_fastest(v))
        sanity_say(t->tell, t->to,
                   "%s.propulsion.beset_speed: the ship never makes more than %.3g m/s and counts as beset under %.3g: "
                   "it backs again and again",
                   t->e->path, vessel_fastest(v), p->beset_speed);
    if (lacks < least && wanted > 0 && is_automatic(p->pattern.period) && t->s->ice.source != ICE_NONE)
        sanity_say(t->tell, t->to,
                   "%s.propulsion.speed: at %.3g m/s the ship, stopped by ice, pushes with %.2g %% of its pull: it "
                   "never counts as beset and waits; take %s m/s or more",
                   t->e->path, wanted, 100 * propulsion_push(most, lacks), least_text_of(least, 3).text);
}

static void tell_propulsion(const teller *t)
{
    const scenario_vessel *v = t->e->keys;
    const scenario_propulsion *p = &v->propulsion;
    if (!vessel_drives_itself(v))
        return;
    if (sanity_own_hull(v)) {
        tell_in_lengths(t, "lookahead", p->lookahead, LOOKAHEAD_LEAST, LOOKAHEAD_MOST);
        tell_in_lengths(t, "ram_distance", p->ram_distance, RAM_LEAST, RAM_MOST);
        if (automatic_or(p->propeller_z, 0) < -DEEPEST * v->hull.draught)
            sanity_say(t->tell, t->to, "%s.propulsion.propeller_z: %.4g m is far below the hull of draught %.4g m",
                       t->e->path, p->propeller_z, v->hull.draught);
        if (automatic_or(p->propeller_spacing, 0) > v->hull.beam)
            sanity_say(t->tell, t->to, "%s.propulsion.propeller_spacing: %.4g m is more than the beam, %.4g m",
                       t->e->path, p->propeller_spacing, v->hull.beam);
    }
    if (automatic_or(p->steering_x, -1) >= 0)
        sanity_say(t->tell, t->to,
                   "%s.propulsion.steering_x: %.4g m is ahead of the centre of mass, so that the ship turns the wrong "
                   "way: give a negative number",
                   t->e->path, p->steering_x);
    if (sanity_own_hull(v) && fabs(automatic_or(p->steering_x, 0)) > STEERING_MOST * v->hull.length)
        sanity_say(t->tell, t->to, "%s.propulsion.steering_x: %.4g m is outside of a hull of %.4g m: give metres",
                   t->e->path, p->steering_x, v->hull.length);
    tell_helm(t);
    double d = p->propeller_diameter, disc = p->bollard_pull / ((double)p->propellers * PI / 4 * d * d);
    const usual_range usual = usual_range_at_scale(t->s, DISC_LEAST, DISC_MOST, 1);
    if (!is_automatic(d) && (disc > usual.most || disc < usual.least))
        sanity_say(t->tell, t->to,
                   "%s.propulsion.propeller_diameter: %.4g m leaves %.3g kPa of bollard pull on the disc, 20 to 100 "
                   "are usual: give metres",
                   t->e->path, d, disc * 1e-3);
    tell_slow(t);
}

/* ---- what counts as being on station ---- */

/* Speed at the start with which nobody comes to rest on a mooring, full size [m/s]. */
#define STARTING_SPEED 0.5

static void tell_station(const teller *t)
{
    const scenario_vessel *v = t->e->keys;
    double x = automatic_or(v->station.watch_x, 0), y = automatic_or(v->station.watch_y, 0);
    bool ahead = fabs(x) > v->hull.length, aside = fabs(y) > v->hull.beam;
    if (sanity_own_hull(v) && (ahead || aside))
        sanity_say(t->tell, t->to, "%s.station.watch_%s: (%.4g, %.4g) m is outside of a hull of %.4g m by %.4g m",
                   t->e->path, ahead ? "x" : "y", x, y, v->hull.length, v->hull.beam);
    bool lines = v->mooring.lines.count > 0;
    if ((lines || v->positioning.active) && v->speed > STARTING_SPEED * fmax(1, usual_at_scale(t->s, 0.5)))
        sanity_say(t->tell, t->to,
                   "%s.speed: a vessel on station begins with %.4g m/s: speed is that of the start, of a drift give "
                   "environment.current_speed or domain.drift_speed",
                   t->e->path, v->speed);
    if (lines && automatic_or(v->station.offset_limit, 0) > v->mooring.depth)
        sanity_say(t->tell, t->to,
                   "%s.station.offset_limit: %.4g m is more than the depth, %.4g m: give metres, not a percentage",
                   t->e->path, v->station.offset_limit, v->mooring.depth);
}

void sanity_tell_control(const scenario *s, const vessel_entry *e, sanity_built built, sanity_teller tell,
                         const void *to)
{
    const teller t = {s, tell, to, e, NULL, NULL, built.read};
    tell_positioning(&t);
    for (int32_t i = 0; i < e->keys->thrusters.count; i++)
        tell_thruster(&t, i);
    tell_propulsion(&t);
    tell_station(&t);
}
