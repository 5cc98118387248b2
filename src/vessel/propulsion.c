#include "vessel/propulsion.h"

#include "vessel/plane_motion.h"

#include <math.h>

#define TABLE_SELF propulsion_table
TABLE_DEFINE(propulsion, PROPULSION_FIELDS)
#undef TABLE_SELF
#define TABLE_SELF course_table
TABLE_DEFINE(course, COURSE_FIELDS)
#undef TABLE_SELF

/* The autopilot's steering angle per heading error, and its time of turn in lengths over open-water speed: a ship turns
   at about one length in the time of its own length; published course keepers have 0.5 to 2 (Fossen 2011, 12.2). */
static const double HEADING_GAIN = 1.5, TURN_LENGTHS = 1.5;
/* Full thrust is given when the speed is wrong by this part of the open-water speed. */
static const double SPEED_BAND = 0.05;
/* A ship counts as stopped by ice only under this part of its bollard pull. */
static const double PUSHING = 0.5;
/* The aim goes on along its track by this part of the way to it. */
static const double AIM_STEP = 0.02;

double propulsion_net_thrust(double bollard_pull, double open_water_speed, double speed)
{
    double r = fmax(speed, 0) / open_water_speed;
    return bollard_pull * (1 - r / 3 - 2 * r * r / 3);
}

hull_lift hull_lift_of(double length, double beam, double draught, double volume, double water_density)
{
    double flat = PI * (draught / length) * (draught / length), block = volume / (length * beam * draught);
    double square = 0.5 * water_density * length * length;
    return (hull_lift){
        .y_v = -square * flat * (1 + 0.4 * block * beam / draught),
        .y_r = -square * length * flat * (-0.5 + 2.2 * beam / length - 0.08 * beam / draught),
        .n_v = -square * length * flat * (0.5 + 2.4 * draught / length),
        .n_r = -square * length * length * flat * (0.25 + 0.039 * beam / draught - 0.56 * beam / length),
    };
}

fram_status propulsion_add(context *ctx, const propulsion_settings *settings, pattern_kind pattern, int32_t vessel,
                           const vessel_table *vessels, const body_table *bodies, propulsion_table *out,
                           fram_error *error)
{
    int32_t row = out->count, body = vessels->body[vessel];
    if (!table_resize(ctx, out, &propulsion_table_info, row + 1))
        return error_memory(error);
    out->vessel[row] = vessel;
    out->settings[row] = *settings;
    out->pattern[row] = (uint8_t)pattern;
    out->axis[row] = quat_roll_pitch_yaw(bodies->orientation[body]).z;
    out->from[row] = vec2_make(bodies->position[body].x, bodies->position[body].y);
    return FRAM_OK;
}

/* One vessel's step. */
typedef struct pilot {
    propulsion_table *table;
    int32_t row;
    const propulsion_settings *s;
    const propulsion_moment *now;
    vec2 place, bow; /* of the centre of mass; unit */
    double heading, turn;
    double over_ground, through_water, in_ice; /* speeds along the bow [m/s] */
    double aside;                              /* through the water, to port [m/s] */
} pilot;

static pilot pilot_of(propulsion_table *t, int32_t row, const propulsion_moment *now, const body_table *bodies,
                      int32_t body)
{
    pilot p = {.table = t, .row = row, .s = &t->settings[row], .now = now};
    vec3 r = bodies->position[body], v = bodies->velocity[body];
    p.place = vec2_make(r.x, r.y);
    p.heading = quat_roll_pitch_yaw(bodies->orientation[body]).z;
    p.bow = vec2_make(real_cos(p.heading), real_sin(p.heading));
    p.turn = bodies->angular_velocity[body].z;
    vec2 speed = {v.x, v.y};
    p.over_ground = vec2_dot(speed, p.bow);
    p.through_water = vec2_dot(vec2_sub(speed, now->water), p.bow);
    p.aside = vec2_dot(vec2_sub(speed, now->water), vec2_make(-p.bow.y, p.bow.x));
    p.in_ice = vec2_dot(vec2_sub(speed, now->drift), p.bow);
    return p;
}

/* ---- where to ---- */

static vec2 pattern_place(const pilot *p, double share)
{
    pattern_shape shape = {(pattern_kind)p->table->pattern[p->row], p->s->distance, p->s->width};
    vec2 at = pattern_point(&shape, share);
    double c = real_cos(p->table->axis[p->row]), s = real_sin(p->table->axis[p->row]);
    return vec2_make(p->s->x + c * at.x - s * at.y, p->s->y + s * at.x + c * at.y);
}

/* The aim runs ahead on the pattern until it is a lookahead away, a round at most in a step. */
static vec2 aim_on_pattern(const pilot *p)
{
    propulsion_table *t = p->table;
    pattern_shape shape = {(pattern_kind)t->pattern[p->row], p->s->distance, p->s->width};
    double step = AIM_STEP * p->s->lookahead / pattern_length(&shape), gone = 0;
    vec2 aim = pattern_place(p, t->share[p->row]);
    while (gone < 1 && vec2_length(vec2_sub(aim, p->place)) < p->s->lookahead) {
        t->share[p->row] += step;
        gone += step;
        if (t->share[p->row] >= 1) {
            t->share[p->row] -= 1;
            t->rounds[p->row]++;
        }
        aim = pattern_place(p, t->share[p->row]);
    }
    return aim;
}

/* The n-th way point of a vessel; false: it has no more. */
static bool way_point(const course_table *course, int32_t vessel, int32_t n, vec2 *place)
{
    for (int32_t i = 0; i < course->count; i++)
        if (course->vessel[i] == vessel && n-- == 0) {
            *place = course->place[i];
            return true;
        }
    return false;
}

/* Line of sight (Fossen 2011, 10.3): towards the point of the leg that lies a lookahead before the foot of the ship's
   perpendicular.  After the last way point the last leg goes on. */
static vec2 aim_on_legs(const pilot *p, const course_table *course)
{
    propulsion_table *t = p->table;
    int32_t vessel = t->vessel[p->row];
    vec2 to, next;
    if (!way_point(course, vessel, t->leg[p->row], &to))
        return vec2_add(p->place, vec2_make(real_cos(t->axis[p->row]), real_sin(t->axis[p->row])));
    while (way_point(course, vessel, t->leg[p->row] + 1, &next) &&
           vec2_length(vec2_sub(to, p->place)) < p->s->lookahead) {
        t->from[p->row] = to;
        t->leg[p->row]++;
        to = next;
    }
    vec2 leg = vec2_sub(to, t->from[p->row]);
    double length = vec2_length(leg);
    if (!(length > 0))
        return to;
    vec2 along = vec2_scale(leg, 1 / length);
    double foot = vec2_dot(vec2_sub(p->place, t->from[p->row]), along);
    return vec2_add(t->from[p->row], vec2_scale(along, foot + p->s->lookahead));
}

static void steer(const pilot *p, const course_table *course, double length)
{
    propulsion_table *t = p->table;
    if (t->pattern[p->row] != PATTERN_NONE && vec2_length(p->now->drift) > 0)
        t->axis[p->row] = real_atan2(-p->now->drift.y, -p->now->drift.x);
    vec2 aim = t->pattern[p->row] != PATTERN_NONE ? aim_on_pattern(p) : aim_on_legs(p, course);
    vec2 way = vec2_sub(aim, p->place);
    double error = plane_angle(real_atan2(way.y, way.x) - p->heading);
    double rate = TURN_LENGTHS * length / p->s->open_water_speed * p->turn;
    double most = p->s->steering_most, wanted = HEADING_GAIN * (error - rate);
    wanted = t->phase[p->row] == PROPULSION_ASTERN ? 0 : fmin(fmax(wanted, -most), most);
    double step = p->s->steering_rate * p->now->dt, change = wanted - t->steering[p->row];
    t->steering[p->row] += fmin(fmax(change, -step), step);
}

/* ---- how hard ---- */

static double net_thrust(const pilot *p)
{
    const propulsion_settings *s = p->s;
    double back = -s->astern * propulsion_net_thrust(s->bollard_pull, s->open_water_speed, -p->through_water);
    if (p->table->phase[p->row] == PROPULSION_ASTERN)
        return back;
    double full = propulsion_net_thrust(s->bollard_pull, s->open_water_speed, p->through_water);
    if (!isfinite(s->speed))
        return full;
    double wanted = (s->speed - p->over_ground) * s->bollard_pull / (SPEED_BAND * s->open_water_speed);
    return fmin(fmax(wanted, back), full);
}

static bool tell(context *ctx, const pilot *p, station_event kind, double value, event_table *events)
{
    return event_add(ctx, events, kind, p->now->time, p->table->vessel[p->row], -1, value);
}

/* Beset: backs; backed far enough, or stuck astern too: rams. */
static bool change_phase(context *ctx, const pilot *p, event_table *events)
{
    propulsion_table *t = p->table;
    int32_t row = p->row;
    bool astern = t->phase[row] == PROPULSION_ASTERN;
    double speed = astern ? -p->in_ice : p->in_ice, pull = (astern ? p->s->astern : 1) * p->s->bollard_pull;
    bool stopped = fabs(speed) < p->s->beset_speed && fabs(t->thrust[row]) >= PUSHING * pull;
    t->slow_time[row] = stopped ? t->slow_time[row] + p->now->dt : 0;
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
    int32_t vessel = propulsion->vessel[row];
    pilot p = pilot_of(propulsion, row, now, bodies, vessels->body[vessel]);
    if (!change_phase(ctx, &p, events))
        return error_memory(error);
    steer(&p, course, vessels->length[vessel]);
    double net = net_thrust(&p), gross = net + now->resistance, angle = propulsion->steering[row];
    propulsion->thrust[row] = net;
    /* Astern the units do not turn the ship. */
    double ahead = net < 0 ? gross : gross * real_cos(angle), aside = net < 0 ? 0 : gross * real_sin(angle);
    const hull_lift *l = &p.s->lift;
    double u = fmax(p.through_water, 0), lift = u * (l->y_v * p.aside + l->y_r * p.turn) - aside;
    vec2 port = {-p.bow.y, p.bow.x};
    load->force.x += ahead * p.bow.x + lift * port.x;
    load->force.y += ahead * p.bow.y + lift * port.y;
    load->moment.z += u * (l->n_v * p.aside + l->n_r * p.turn) - p.s->steering_x * aside;
    return FRAM_OK;
}
