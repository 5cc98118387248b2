#include "vessel/propulsion.h"

#include "vessel/plane_motion.h"

#include <math.h>

#define TABLE_SELF propulsion_table
TABLE_DEFINE(propulsion, PROPULSION_FIELDS)
#undef TABLE_SELF
#define TABLE_SELF course_table
TABLE_DEFINE(course, COURSE_FIELDS)
#undef TABLE_SELF

/* Full thrust is given when the speed is wrong by this part of the open-water speed. */
static const double SPEED_BAND = 0.05;
/* A ship counts as stopped by ice only under this part of its bollard pull. */
static const double PUSHING = 0.5;
/* A ship is on its track once it was within this part of its length of it. */
static const double JOINED = 0.5;
/* It is back on it within this part of the limit beyond which it is off it. */
static const double BACK_ON_TRACK = 0.5;

double propulsion_net_thrust(double bollard_pull, double open_water_speed, double speed)
{
    double r = fmax(speed, 0) / open_water_speed;
    return bollard_pull * (1 - r / 3 - 2 * r * r / 3);
}

double propulsion_push(double open_water_speed, double lacks)
{
    return fmin(fmax(lacks, 0) / (SPEED_BAND * open_water_speed), 1);
}

double propulsion_least_lack(double open_water_speed) { return PUSHING * SPEED_BAND * open_water_speed; }

fram_status propulsion_add(context *ctx, const propulsion_settings *settings, pattern_kind pattern, bool forecast,
                           int32_t vessel, const vessel_table *vessels, const body_table *bodies, propulsion_table *out,
                           fram_error *error)
{
    int32_t row = out->count, body = vessels->body[vessel];
    if (!table_resize(ctx, out, &propulsion_table_info, row + 1))
        return error_memory(error);
    out->vessel[row] = vessel;
    out->settings[row] = *settings;
    out->pattern[row] = (uint8_t)pattern;
    out->forecast[row] = forecast;
    out->axis[row] = quat_roll_pitch_yaw(bodies->orientation[body]).z;
    out->from[row] = vec2_make(bodies->position[body].x, bodies->position[body].y);
    out->way[row] = -1;
    out->seen[row].rate = bodies->angular_velocity[body].z;
    return FRAM_OK;
}

/* One vessel's step. */
typedef struct pilot {
    propulsion_table *table;
    int32_t row;
    const propulsion_settings *s;
    const propulsion_moment *now;
    vec2 place, speed, bow; /* of the centre of mass; over the ground; unit */
    double heading, turn;
    double over_ground, through_water, in_ice; /* speeds along the bow [m/s] */
    double aside;                              /* through the water, to port [m/s] */
    double length;                             /* of the ship [m] */
} pilot;

static pilot pilot_of(propulsion_table *t, int32_t row, const propulsion_moment *now, const vessel_table *vessels,
                      const body_table *bodies)
{
    pilot p = {.table = t, .row = row, .s = &t->settings[row], .now = now};
    int32_t body = vessels->body[t->vessel[row]];
    p.length = vessels->length[t->vessel[row]];
    vec3 r = bodies->position[body], v = bodies->velocity[body];
    p.place = vec2_make(r.x, r.y);
    p.heading = quat_roll_pitch_yaw(bodies->orientation[body]).z;
    p.bow = vec2_make(real_cos(p.heading), real_sin(p.heading));
    p.turn = bodies->angular_velocity[body].z;
    p.speed = vec2_make(v.x, v.y);
    p.over_ground = vec2_dot(p.speed, p.bow);
    p.through_water = vec2_dot(vec2_sub(p.speed, now->water), p.bow);
    p.aside = vec2_dot(vec2_sub(p.speed, now->water), vec2_make(-p.bow.y, p.bow.x));
    p.in_ice = vec2_dot(vec2_sub(p.speed, now->drift), p.bow);
    return p;
}

/* ---- where to ---- */

/* The pattern's axis turns with the drift; returns how fast [rad/s].  A drift that turns about at once takes the
   pattern with it, faster than a ship could follow: such a turn is no rate, and *about is set. */
static double turn_axis(const pilot *p, bool *about)
{
    propulsion_table *t = p->table;
    vec2 comes = p->now->comes.at;
    if (!(vec2_length(comes) > 0))
        return 0;
    double axis = real_atan2(comes.y, comes.x);
    double turn = plane_angle(axis - t->axis[p->row]) / p->now->dt;
    t->axis[p->row] = axis;
    double way = vec2_length(vec2_sub(p->place, vec2_make(p->s->x, p->s->y)));
    *about = t->way[p->row] >= 0 && fabs(turn) * way >= p->s->turning.speed;
    return t->way[p->row] >= 0 && !*about ? turn : 0;
}

static vec2 turned(vec2 v, double angle)
{
    double c = real_cos(angle), s = real_sin(angle);
    return vec2_make(c * v.x - s * v.y, s * v.x + c * v.y);
}

/* In which the ship is told to turn: what is told once a step takes one at least.  A ship without helm has no lag. */
static double lag_of(const pilot *p)
{
    const propulsion_settings *s = p->s;
    double lag = autopilot_lag(&s->turning, p->length, p->through_water, s->steering_most, s->steering_rate);
    return fmax(lag, p->now->dt);
}

static autopilot_view view_of(const pilot *p, vec2 origin, double axis, double frame_turn, double thrust)
{
    const wrench *drag = &p->now->drag;
    vec2 from = vec2_sub(p->place, origin), port = vec2_perp(p->bow);
    return (autopilot_view){.place = turned(from, -axis),
                            .velocity = turned(vec2_sub(p->speed, vec2_scale(vec2_perp(from), frame_turn)), -axis),
                            .current = turned(vec2_make(p->now->water.x, p->now->water.y), -axis),
                            .heading = p->heading - axis,
                            .turn = p->turn,
                            .frame_turn = frame_turn,
                            .ahead = p->through_water,
                            .aside = p->aside,
                            .drag_aside = drag->force.x * port.x + drag->force.y * port.y,
                            .drag_moment = drag->moment.z,
                            .thrust = thrust,
                            .lookahead = p->s->lookahead,
                            .lag = lag_of(p),
                            .course_speed = p->now->course_speed};
}

/* How far a place on a closed track is from where the ship joined it, as it goes. */
static double since_joined(double way, double joined, double length)
{
    return way < joined ? way - joined + length : way - joined;
}

/* Over the place where it joined, forward or back, as the foot goes from one place to the next.  A ship that goes back
   over it with no round done, as it turns to its track, has joined farther back. */
static void count_rounds(propulsion_table *t, int32_t row, double before, double length)
{
    double from = since_joined(before, t->joined[row], length), to = since_joined(t->way[row], t->joined[row], length);
    if (to < from - 0.5 * length)
        t->rounds[row]++;
    else if (to > from + 0.5 * length && t->rounds[row] > 0)
        t->rounds[row]--;
    else if (to > from + 0.5 * length)
        t->joined[row] = t->way[row];
}

/* Brings the foot of the ship on a track up to date, and its error, which counts after the transient, from when the
   ship first is near its track and heads along it, and not where the track turns about.  about: the track was turned
   about at once, which is no way that the ship went: it joined as much earlier as it had gone. */
static void follow_track(const pilot *p, const autopilot_view *v, const track *path, bool about)
{
    propulsion_table *t = p->table;
    int32_t row = p->row;
    double before = t->way[row];
    t->way[row] = before < 0 && path->closed ? track_join(path, v->place, v->heading, 2 * p->s->turning.radius)
                                             : track_foot(path, before, v->place);
    if (before < 0)
        t->joined[row] = t->way[row];
    else if (path->closed && about)
        t->joined[row] = since_joined(t->way[row], since_joined(before, t->joined[row], path->length), path->length);
    else if (path->closed)
        count_rounds(t, row, before, path->length);
    track_place foot = track_at(path, t->way[row]);
    double off = t->off[row] = track_off(&foot, v->place);
    bool joins = fabs(off) <= JOINED * p->length && real_cos(v->heading - foot.heading) > 0;
    if (foot.turning || p->now->time < p->s->transient || (t->off_time[row] == 0 && !joins))
        return;
    t->off_most[row] = fmax(t->off_most[row], fabs(off));
    t->off_square[row] += off * off * p->now->dt;
    t->off_time[row] += p->now->dt;
}

/* The way points about the leg that is sailed, with the place where the ship began before the first; *at: where the leg
   begins among them.  Returns how many; *at + 1 where none is left to go to. */
static int32_t points_about(const pilot *p, const course_table *course, vec2 point[TRACK_POINTS], int32_t *at)
{
    const propulsion_table *t = p->table;
    int32_t row = p->row, vessel = t->vessel[row], begins = t->leg[row] - 1, first = 0, count = 0;
    while (first < course->count && course->vessel[first] != vessel)
        first++;
    int32_t n = begins > 1 ? begins - 2 : -1;
    *at = begins - n;
    for (; count < TRACK_POINTS; n++) {
        if (n >= 0 && (n >= course->count - first || course->vessel[first + n] != vessel))
            break;
        point[count++] = n < 0 ? t->from[row] : course->place[first + n];
    }
    return count;
}

/* The leg that is sailed and those after it, with their corners; goes on to the next when the corner is behind the
   ship. false: no way points. */
static bool leg_track(const pilot *p, const course_table *course, track *out)
{
    propulsion_table *t = p->table;
    const turning_ability *turning = &p->s->turning;
    /* The bend is straightened out on the leg after it. */
    double bend = 0.5 * turning->reach * turning->reach / turning->corner;
    while (true) {
        vec2 point[TRACK_POINTS];
        int32_t at, count = points_about(p, course, point, &at);
        if (count <= at + 1)
            return false;
        double corner;
        *out = track_of_legs(point, count, at, turning->corner, &corner);
        double foot = track_foot(out, t->way[p->row], p->place);
        if (foot < corner + bend)
            return true;
        t->way[p->row] = foot - corner;
        t->leg[p->row]++;
    }
}

/* On the way on which the ice comes, past the ice: the ship heads where it goes through it.  Without a drift it goes
   straight on as the axis of its pattern points. */
static void look_ahead(const pilot *p, double thrust, autopilot_view *v, track *sailed)
{
    const propulsion_settings *s = p->s;
    track_place way = p->now->comes;
    vec2 place = vec2_make(s->x, s->y);
    if (vec2_length(way.at) > 0)
        p->table->axis[p->row] = real_atan2(way.at.y, way.at.x);
    else
        way.heading = p->table->axis[p->row];
    vec2 port = vec2_make(-real_sin(way.heading), real_cos(way.heading));
    *sailed = track_of_bend(vec2_add(vec2_add(place, way.at), vec2_scale(port, s->aside)), way.heading, way.curvature,
                            &p->table->way[p->row]);
    *v = view_of(p, vec2_make(0, 0), 0, 0, thrust);
    v->velocity = vec2_sub(v->velocity, p->now->drift);
    v->current = vec2_sub(v->current, p->now->drift);
}

static void look_round(const pilot *p, double thrust, autopilot_view *v, track *sailed, bool *about)
{
    const propulsion_settings *s = p->s;
    pattern_shape shape = {(pattern_kind)p->table->pattern[p->row], s->distance, s->width, s->aside};
    double turn = turn_axis(p, about);
    *sailed = track_of_pattern(&shape, s->turning.corner);
    *v = view_of(p, vec2_make(s->x, s->y), p->table->axis[p->row], turn, thrust);
}

/* What the autopilot sees, and the track that it follows; false: it keeps a heading. */
static bool look(const pilot *p, const course_table *course, double thrust, autopilot_view *v, track *sailed)
{
    propulsion_table *t = p->table;
    bool about = false;
    if (t->pattern[p->row] == PATTERN_AHEAD) {
        look_ahead(p, thrust, v, sailed);
    } else if (t->pattern[p->row] != PATTERN_NONE) {
        look_round(p, thrust, v, sailed, &about);
    } else {
        *v = view_of(p, vec2_make(0, 0), 0, 0, thrust);
        t->way[p->row] = fmax(t->way[p->row], 0);
        if (!leg_track(p, course, sailed))
            return false;
    }
    follow_track(p, v, sailed, about);
    return true;
}

static void steer(const pilot *p, const course_table *course, double gross)
{
    propulsion_table *t = p->table;
    int32_t row = p->row;
    const propulsion_settings *s = p->s;
    motion_observer *seen = &t->seen[row];
    const steering_gear gear = {&s->ship, &s->rudder, s->steering_x, t->steering[row]};
    autopilot_view v;
    track sailed;
    bool follows = look(p, course, gross, &v, &sailed);
    double most = s->steering_most, wanted = 0;
    if (t->phase[row] == PROPULSION_ASTERN) {
        *seen = (motion_observer){.rate = p->turn};
    } else {
        autopilot_observe(&v, &s->turning, &gear, p->now->dt, seen);
        double rate = follows ? autopilot_rate(&v, &s->turning, seen, &sailed, t->way[row])
                              : autopilot_rate_to(&v, &s->turning, t->axis[row]);
        wanted = autopilot_angle(&v, &gear, seen, rate);
        wanted = fmin(fmax(wanted, -most), most);
    }
    double step = s->steering_rate * p->now->dt, change = wanted - t->steering[row];
    t->steering[row] += fmin(fmax(change, -step), step);
}

/* ---- how hard ---- */

/* Where the ship pushes against its way the bound is that of the propellers, and the water's resistance adds to it: to
   hold the net thrust there would take from what they give. */
static double net_thrust(const pilot *p)
{
    const propulsion_settings *s = p->s;
    double back = -s->astern * propulsion_net_thrust(s->bollard_pull, s->open_water_speed, -p->through_water);
    back -= fmax(p->now->resistance, 0);
    if (p->table->phase[p->row] == PROPULSION_ASTERN)
        return back;
    double full = propulsion_net_thrust(s->bollard_pull, s->open_water_speed, p->through_water);
    full -= fmin(p->now->resistance, 0);
    if (!isfinite(s->speed))
        return full;
    double wanted = (s->speed - p->over_ground) * s->bollard_pull / (SPEED_BAND * s->open_water_speed);
    return fmin(fmax(wanted, back), full);
}

static bool tell(context *ctx, const pilot *p, station_event kind, double value, event_table *events)
{
    return event_add(ctx, events, kind, p->now->time, p->table->vessel[p->row], -1, value);
}

/* Whether the track error, where it counts, has passed its limit. */
static bool tell_track(context *ctx, const pilot *p, event_table *events)
{
    propulsion_table *t = p->table;
    int32_t row = p->row;
    double off = fabs(t->off[row]), most = t->astray[row];
    if (most == 0 && off > p->s->track_limit) {
        t->astray[row] = off;
        return tell(ctx, p, EVENT_OFF_TRACK, off, events);
    }
    if (most == 0)
        return true;
    if (off > BACK_ON_TRACK * p->s->track_limit) {
        t->astray[row] = fmax(most, off);
        return true;
    }
    t->astray[row] = 0;
    return tell(ctx, p, EVENT_ON_TRACK, most, events);
}

/* For how long ice has held the ship under thrust: hulls, lines and walls stop one too, and are nothing to ram.  Astern
   all of them count, since a ship that cannot go farther back comes again.  Ice that lets go for a step, as it breaks,
   does not begin the time anew. */
static void count_slow_time(const pilot *p, bool astern, double speed)
{
    propulsion_table *t = p->table;
    int32_t row = p->row;
    double pull = (astern ? p->s->astern : 1) * p->s->bollard_pull, push = vec2_dot(p->now->ice, p->bow);
    double thrust = astern ? -t->thrust[row] : t->thrust[row];
    if (!(fabs(speed) < p->s->beset_speed && thrust >= PUSHING * pull))
        t->slow_time[row] = 0;
    else if (astern || push < 0)
        t->slow_time[row] += p->now->dt;
}

/* Beset: backs; backed far enough, or stopped astern by whatever it is: rams. */
static bool change_phase(context *ctx, const pilot *p, event_table *events)
{
    propulsion_table *t = p->table;
    int32_t row = p->row;
    bool astern = t->phase[row] == PROPULSION_ASTERN;
    double speed = astern ? -p->in_ice : p->in_ice;
    count_slow_time(p, astern, speed);
    bool beset = t->slow_time[row] >= p->s->beset_time;
    if (astern) {
        t->backed[row] += fmax(speed, 0) * p->now->dt;
        if (!beset && t->backed[row] < p->s->ram_distance)
            return true;
        t->phase[row] = PROPULSION_AHEAD;
        t->rams[row]++;
    } else if (beset) {
        t->phase[row] = PROPULSION_ASTERN;
        t->backed[row] = 0;
        t->besets[row]++;
    } else {
        return true;
    }
    t->slow_time[row] = 0;
    return tell(ctx, p, astern ? EVENT_RAM : EVENT_BESET, astern ? t->backed[row] : t->thrust[row], events);
}

fram_status propulsion_step(context *ctx, propulsion_table *propulsion, int32_t row, const propulsion_moment *now,
                            const vessel_table *vessels, const body_table *bodies, const course_table *course,
                            wrench *load, event_table *events, fram_error *error)
{
    pilot p = pilot_of(propulsion, row, now, vessels, bodies);
    if (!change_phase(ctx, &p, events))
        return error_memory(error);
    double net = net_thrust(&p), gross = net + now->resistance, u = fmax(p.through_water, 0);
    double counted = propulsion->off_time[row];
    steer(&p, course, gross);
    if (propulsion->off_time[row] > counted && !tell_track(ctx, &p, events))
        return error_memory(error);
    propulsion->thrust[row] = net;
    /* Astern nothing turns the ship. */
    double angle = propulsion->phase[row] == PROPULSION_ASTERN ? 0 : propulsion->steering[row];
    double at_stern = p.aside + p.s->steering_x * p.turn;
    steering_force f = rudder_force(&p.s->rudder, p.through_water, at_stern, gross, angle);
    hull_lift l = manoeuvring_lift(&p.s->ship);
    double lift = u * (l.y_v * p.aside + l.y_r * p.turn), aside = lift + f.aside;
    /* What takes Kirchhoff's -a11 u r back acts where that does, and leans the ship no more than it held. */
    double held = u * p.s->ship.a11 * p.turn;
    double heel = -now->lift_z * (lift - held) - now->surge_z * held - now->steering_z * f.aside;
    vec2 port = vec2_perp(p.bow);
    load->force.x += f.ahead * p.bow.x + aside * port.x;
    load->force.y += f.ahead * p.bow.y + aside * port.y;
    load->moment.x += heel * p.bow.x;
    load->moment.y += heel * p.bow.y;
    load->moment.z += u * (l.n_v * p.aside + l.n_r * p.turn) + p.s->steering_x * f.aside;
    return FRAM_OK;
}
