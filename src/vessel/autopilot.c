#include "vessel/autopilot.h"

#include "vessel/plane_motion.h"

/* The lag is the time for half the helm and this part of the time for a length; for that at most as long as for the
   helm: of a slow ship it is the thrust, not its way, that turns it. */
static const double LENGTHS = 0.1;
/* A ship comes back on its course within so many lags. */
static const double COURSE_LAGS = 3;
/* Least lookahead in ways of that time: the track error then has the damping 0.7. */
static const double LEAST_LOOKAHEAD = 2;
/* A ship slower than this part of the speed that its data are for is taken to have it: stopped in ice it has no lag. */
static const double SLOWEST = 0.25;
/* The mean of the drift that is not the turn's goes over the time in which the ship goes so many reaches. */
static const double DRIFT_REACHES = 2;
/* Within an arc the nearer its centre the faster a ship goes round; up to so much. */
static const double LEAST_NEARNESS = 0.5;

/* A ship that is to stand still is taken to go this fast [m/s]: lags and lookaheads are over speeds. */
static const double LEAST_SPEED = 1e-9;

static double speed_of(const turning_ability *t, double ahead)
{
    return fmax(fmax(ahead, SLOWEST * t->speed), LEAST_SPEED);
}

double autopilot_lag(const turning_ability *t, double length, double ahead, double steering_most, double steering_rate)
{
    double helm = 0.5 * steering_most / steering_rate;
    return helm + fmin(LENGTHS * length / speed_of(t, ahead), helm);
}

/* Past the rate of the steady turn at full helm a ship is told to turn by so much at most. */
static const double FASTER = 1.2;

static double limited_rate(const autopilot_view *v, const turning_ability *t, double rate)
{
    double most = FASTER * speed_of(t, v->ahead) / t->radius;
    return fmin(fmax(rate, -most), most);
}

/* The rate of turn by which a course error is taken out: in proportion where it is small, and no faster than the ship
   can stop turning again where it is large. */
static double rate_back(const autopilot_view *v, const turning_ability *t, double error)
{
    double u = speed_of(t, v->ahead), braking = u * u / (t->reach * t->reach), time = COURSE_LAGS * v->lag;
    double size = braking * time * (sqrt(1 + 2 * fabs(error) / (braking * time * time)) - 1);
    return error > 0 ? size : -size;
}

/* A heading is against the track from here on; from the second on it takes about as long to come about either way. */
static const double AGAINST = 0.5 * PI, EITHER_WAY = 2 * PI / 3;

/* Of a ship that heads against a bend.  By the shorter way, and with the bend where both are about as long: turning
   against it, or with the bend's own rate on top, a ship may go round it against its sense for good. */
static double rate_about(const autopilot_view *v, const turning_ability *t, double error, double curvature)
{
    if (fabs(error) > EITHER_WAY && error * curvature > 0)
        error -= curvature > 0 ? 2 * PI : -2 * PI;
    return limited_rate(v, t, -rate_back(v, t, error));
}

/* Over the ground, in the track's frame. */
static vec2 ground_velocity(const autopilot_view *v, vec2 place, vec2 past)
{
    return vec2_add(past, vec2_scale(vec2_perp(place), v->frame_turn));
}

static bool has_course(const autopilot_view *v)
{
    return vec2_length(ground_velocity(v, v->place, v->velocity)) > v->course_speed && v->ahead > 0;
}

static vec2 heading_vector(double angle) { return vec2_make(real_cos(angle), real_sin(angle)); }

/* No more of a ship's speed through the water goes against a current aside. */
static const double MOST_AGAINST = 0.9;

/* A ship that hardly makes way against a current comes back to its track as if it made so much. */
static const double LEAST_WAY = 0.1;

/* How a ship that goes a way over the ground lies to it in a current: its heading is by `angle` to port of its course,
   and turns so many times as fast as that; `bends` is how much more its way through the water is curved than that over
   the ground, and `way` how much shorter. */
typedef struct crab {
    double angle, turns, bends, way;
} crab;

static crab crab_of(const autopilot_view *v, const turning_ability *t, vec2 over)
{
    double speed = vec2_length(over), u = speed_of(t, v->ahead);
    if (!(speed > 0))
        return (crab){0, 1, 1, 1};
    double aside = vec2_cross(over, v->current) / (speed * u), along = vec2_dot(over, v->current) / (speed * u);
    double sine = fmin(fmax(-aside, -MOST_AGAINST), MOST_AGAINST), cosine = sqrt(1 - sine * sine);
    double turns = 1 + along / cosine;
    return (crab){real_atan2(sine, cosine), turns, turns * turns * cosine, fmax(cosine + along, LEAST_WAY)};
}

/* How fast the velocity over the ground turns in the track's frame, of a ship that follows the track and turns with it
   at this rate. */
static double turn_over_ground(const autopilot_view *v, vec2 place, const track_place *foot, double speed, double rate)
{
    vec2 along = vec2_scale(heading_vector(foot->heading), fmax(speed, v->course_speed)),
         over = ground_velocity(v, place, along);
    return (rate + v->frame_turn) * vec2_dot(over, along) / vec2_dot(over, over);
}

/* How far a ship heads into a bend from its course, no more than in the tightest turn that it can make: told to head
   across a bend that it cannot follow it sails off straight. */
static double askew(const turning_ability *t, double bends, double curvature)
{
    double most = fabs(t->drift) / t->radius;
    return fmin(fmax(t->drift * bends * curvature, -most), most);
}

/* A ship is far outside of a bend where its foot goes with less than this part of its speed. */
static const double FAR_OUTSIDE = 0.5;

/* How far the foot of a ship comes as it goes, in parts of its way.  Far outside of a narrow bend it hardly moves:
   looked for as far on as the ship comes it would be on the next bend, or the one after, and a ship between the two
   sails away for good.  Closed tracks and single bends have no such bends side by side. */
static double part_of_way(const autopilot_view *v, const track *path, double way)
{
    track_place foot = track_at(path, way);
    double part = 1 / fmax(1 - foot.curvature * track_off(&foot, v->place), 1);
    return part < FAR_OUTSIDE && !path->closed && path->count > 1 ? part : 1;
}

double autopilot_rate(const autopilot_view *v, const turning_ability *t, const motion_observer *seen, const track *path,
                      double way)
{
    double speed = vec2_length(v->velocity), turn = v->turn - v->frame_turn, u = speed_of(t, v->ahead);
    double course = has_course(v) ? real_atan2(v->velocity.y, v->velocity.x) : v->heading;
    double part = part_of_way(v, path, way);
    /* Where the ship is going to be when it turns as it is told now. */
    vec2 there = vec2_add(v->place, vec2_scale(heading_vector(course + 0.5 * turn * v->lag), speed * v->lag));
    double ahead = track_foot(path, way + part * speed * v->lag, there);
    track_place foot = track_at(path, ahead);
    double off = track_off(&foot, there);
    /* A bend is begun before it comes, as early as the ship takes to turn as the bend asks. */
    double bend = part * t->reach * t->reach / t->corner, from = ahead - 0.5 * bend, to = ahead + 0.5 * bend;
    double curvature = (track_turned(path, to) - track_turned(path, from)) / bend;
    double change = (track_at(path, to).curvature - track_at(path, from).curvature) / bend;
    /* Back to the track, with the frame, and askew as the ship is in a turn; in as long as in still water. */
    double least = fmax(speed, v->course_speed);
    double reach = fmax(v->lookahead, fmax(t->reach, LEAST_LOOKAHEAD * u * COURSE_LAGS * v->lag));
    reach *= crab_of(v, t, ground_velocity(v, there, vec2_scale(heading_vector(foot.heading), least))).way;
    vec2 over = ground_velocity(v, there, vec2_scale(heading_vector(foot.heading - real_atan2(off, reach)), least));
    crab lies = crab_of(v, t, over);
    double wanted = real_atan2(over.y, over.x) + lies.angle + askew(t, lies.bends, curvature) - seen->drift;
    double error = plane_angle(v->heading + turn * v->lag - wanted);
    if (fabs(error) > AGAINST && curvature != 0)
        return rate_about(v, t, error, curvature);
    double round = speed * curvature / fmax(1 - curvature * off, LEAST_NEARNESS);
    double over_ground = v->frame_turn + turn_over_ground(v, there, &foot, speed, round);
    double rate = lies.turns * over_ground + speed * t->drift * change;
    return limited_rate(v, t, rate - rate_back(v, t, error));
}

double autopilot_rate_to(const autopilot_view *v, const turning_ability *t, double heading)
{
    return limited_rate(v, t, rate_back(v, t, plane_angle(heading - v->heading - v->turn * v->lag)));
}

/* Force to port and moment, but for that of the rudders and what is left over. */
static double hull_force(const autopilot_view *v, const manoeuvring *ship)
{
    const hull_lift *l = &ship->whole;
    double u = fmax(v->ahead, 0), r = v->turn;
    return u * (l->y_v * v->aside + l->y_r * r) + v->drag_aside - ship->mass * v->ahead * r;
}

static double hull_moment(const autopilot_view *v, const manoeuvring *ship)
{
    const hull_lift *l = &ship->whole;
    double u = fmax(v->ahead, 0);
    return u * (l->n_v * v->aside + l->n_r * v->turn) + v->drag_moment;
}

static double rudder_now(const autopilot_view *v, const steering_gear *g)
{
    return rudder_force(g->rudder, v->ahead, v->aside + g->x * v->turn, v->thrust, g->angle).aside;
}

double autopilot_angle(const autopilot_view *v, const steering_gear *g, const motion_observer *seen, double rate)
{
    const manoeuvring *ship = g->ship;
    double lever = manoeuvring_lever(ship), arm = g->x - lever;
    if (arm == 0)
        return 0;
    double wanted = manoeuvring_inertia(ship) * (rate - v->turn) / v->lag;
    double acts = hull_moment(v, ship) + seen->moment - lever * hull_force(v, ship);
    return rudder_angle_for(g->rudder, v->ahead, v->aside + g->x * v->turn, v->thrust, (wanted - acts) / arm, g->angle);
}

void autopilot_observe(const autopilot_view *v, const turning_ability *t, const steering_gear *g, double dt,
                       motion_observer *seen)
{
    const manoeuvring *ship = g->ship;
    double inertia = manoeuvring_inertia(ship), aside = rudder_now(v, g), miss = v->turn - seen->rate;
    double moment = hull_moment(v, ship) + g->x * aside + seen->moment;
    moment -= manoeuvring_lever(ship) * (hull_force(v, ship) + aside);
    /* Both poles at the lag. */
    seen->rate += dt * (moment / inertia + 2 / v->lag * miss);
    seen->moment += dt * inertia / (v->lag * v->lag) * miss;
    if (!has_course(v))
        return;
    vec2 over = ground_velocity(v, v->place, v->velocity);
    double u = speed_of(t, v->ahead), drift = plane_angle(real_atan2(over.y, over.x) - v->heading);
    double of_turn = -t->drift * v->turn / u - crab_of(v, t, over).angle;
    seen->drift += dt * u / (DRIFT_REACHES * t->reach) * (drift - of_turn - seen->drift);
}
