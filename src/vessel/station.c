#include "vessel/station.h"

#include "base/random.h"

#define TABLE_SELF station_table
TABLE_DEFINE(station, STATION_FIELDS)
#undef TABLE_SELF

/* What the numbers of a station are drawn for. */
enum { STREAM_SENSOR = 0x5e05 };
/* Position counts as regained below this share of the limit, so that it is not lost and regained with every wave. */
#define REGAINED 0.9

static vec3 place_of(const body_table *bodies, int32_t body)
{
    vec3 r = bodies->position[body];
    return vec3_make(r.x, r.y, quat_roll_pitch_yaw(bodies->orientation[body]).z);
}

static vec3 yaw_of(vec3 v) { return vec3_make(0, 0, v.z); }

static pid_gains of_heading_alone(pid_gains g)
{
    return (pid_gains){yaw_of(g.proportional), yaw_of(g.derivative), yaw_of(g.integral)};
}

bool station_is_of_heading_alone(const station_table *stations, int32_t vessel)
{
    const pid_gains *g = &stations->gains[vessel];
    return !(g->proportional.x > 0 || g->proportional.y > 0);
}

bool station_is_kept(const station_table *stations, const vessel_table *vessels, int32_t vessel)
{
    return vessel < stations->count && vessels->mode[vessel] == VESSEL_FREE;
}

void station_believe(station_table *s, int32_t row, const vessel_table *vessels, const body_table *bodies)
{
    int32_t body = vessels->body[row];
    vec3 place = place_of(bodies, body);
    s->reference[row] = (reference_state){.place = place};
    s->measured[row] = place;
    s->estimate[row] = (motion_estimate){.place = place, .velocity = plane_to_vessel(place.z, bodies->velocity[body])};
    s->estimate[row].velocity.z = bodies->angular_velocity[body].z;
    s->vane_heading[row] = place.z;
}

void station_begin(station_table *s, const station_definition *d, int32_t row, const vessel_table *vessels,
                   const body_table *bodies)
{
    station_believe(s, row, vessels, bodies);
    s->covariance[row] = kalman_begin(&d->kalman, s->estimate[row].place.z, d->first_speed, d->first_bias);
}

fram_status station_add(context *ctx, const station_definition *d, int32_t vessel, const vessel_table *vessels,
                        const body_table *bodies, station_table *s, fram_error *error)
{
    int32_t row = vessel, body = vessels->body[vessel];
    if (!table_resize(ctx, s, &station_table_info, row + 1))
        return error_memory(error);
    vec3 centre = vessels->centre[row], place = place_of(bodies, body);
    vec3 back = plane_to_global(place.z, vec3_make(centre.x, centre.y, 0));
    s->positioning[row] = d->positioning;
    s->observer[row] = (uint8_t)d->observer;
    s->feed[row] = (uint8_t)d->feed;
    s->heading_rule[row] = (uint8_t)d->heading;
    s->control_every[row] = d->control_every;
    s->sample_every[row] = d->sample_every;
    s->home[row] = vec3_make(place.x - back.x, place.y - back.y, place.z);
    s->watched[row] = vec3_sub(d->watched, centre);
    s->watched_home[row] = body_to_global(bodies, body, s->watched[row]);
    s->offset_limit[row] = d->offset_limit;
    s->heading_limit[row] = d->heading_limit;
    s->lever[row] = 0.5 * vessels->length[row];
    s->model[row] = d->model;
    s->gains[row] = pid_gains_for(d->model.mass, d->control_frequency, d->control_damping);
    if (d->control == CONTROL_HEADING)
        s->gains[row] = of_heading_alone(s->gains[row]);
    s->filter[row] = d->filter;
    s->passive[row] = d->passive;
    s->kalman[row] = d->kalman;
    s->vaning[row] = d->vaning;
    s->feed_gain[row] = d->feed_gain;
    s->feed_time[row] = d->feed_time;
    s->noise[row] = d->noise;
    s->seed[row] = d->seed;
    station_begin(s, d, row, vessels, bodies);
    return FRAM_OK;
}

/* ---- deviation ---- */

/* What is watched of a limit, and how its flag stands in `lost` of the station. */
typedef struct limit_watch {
    int bit;
    station_event lost, regained;
    double leave, back; /* lost beyond the one, regained within the other, which is less */
} limit_watch;

static limit_watch limit_watch_of(int bit, station_event lost, station_event regained, double limit)
{
    return (limit_watch){bit, lost, regained, limit, REGAINED * limit};
}

/* Books what came to pass of a limit.  value: what is told, whose size is held against it.  false: no memory. */
static bool book(context *ctx, event_table *events, const limit_watch *l, double value, const station_moment *now,
                 station_table *s, int32_t row)
{
    double size = fabs(value);
    uint8_t flag = (uint8_t)(1u << l->bit);
    bool is_lost = (s->lost[row] & flag) != 0;
    if (is_lost ? !(size < l->back) : !(size > l->leave))
        return true;
    s->lost[row] ^= flag;
    return event_add(ctx, events, is_lost ? l->regained : l->lost, now->time, row, -1, value);
}

/* Whether the vessel's own controller turns it about its origin: on lines alone, or with the bow against the ice, what
   is watched stays at its place as the vessel turns. */
static bool turns_as_told(const station_table *s, int32_t row)
{
    return s->positioning[row] && s->heading_rule[row] == HEADING_FIXED && !station_is_of_heading_alone(s, row);
}

vec2 station_watched_place(const station_table *s, int32_t row, const vessel_table *vessels, vec3 target)
{
    vec3 home = s->home[row], off = vec3_add(s->watched[row], vessels->centre[row]);
    vec3 moved = station_is_of_heading_alone(s, row) ? vec3_make(0, 0, 0) : vec3_sub(target, home);
    if (turns_as_told(s, row) && target.z != home.z)
        moved = vec3_add(moved, vec3_sub(plane_to_global(target.z, off), plane_to_global(home.z, off)));
    return vec2_make(s->watched_home[row].x + moved.x, s->watched_home[row].y + moved.y);
}

vec3 station_deviation(const station_table *s, int32_t row, double time, const vessel_table *vessels,
                       const body_table *bodies, const waypoint_table *path)
{
    int32_t body = vessels->body[row];
    vec3 target = reference_target(path, row, s->home[row], time);
    vec2 wanted = station_watched_place(s, row, vessels, target);
    vec3 at = body_to_global(bodies, body, s->watched[row]);
    bool vanes = s->heading_rule[row] == HEADING_VANING;
    double heading = vanes ? s->vane_heading[row] : target.z;
    return vec3_make(at.x - wanted.x, at.y - wanted.y, plane_angle(place_of(bodies, body).z - heading));
}

static bool watch(context *ctx, station_table *s, int32_t row, const station_moment *now, const vessel_table *vessels,
                  const body_table *bodies, const waypoint_table *path, event_table *events)
{
    s->offset[row] = station_deviation(s, row, now->time, vessels, bodies, path);
    double offset = sqrt(s->offset[row].x * s->offset[row].x + s->offset[row].y * s->offset[row].y);
    const limit_watch position = limit_watch_of(0, EVENT_POSITION_LOST, EVENT_POSITION_REGAINED, s->offset_limit[row]);
    const limit_watch heading = limit_watch_of(1, EVENT_HEADING_LOST, EVENT_HEADING_REGAINED, s->heading_limit[row]);
    return book(ctx, events, &position, offset, now, s, row) &&
           book(ctx, events, &heading, s->offset[row].z, now, s, row);
}

/* ---- control ---- */

/* Noise is a pure function of the station's seed and the moment's number. */
static void measure(station_table *s, int32_t row, const station_moment *now, vec3 place)
{
    random_stream r = random_begin(s->seed[row], STREAM_SENSOR, 0);
    r.counter = 3 * (uint64_t)now->draw;
    vec3 noise = s->noise[row];
    double x = random_normal(&r), y = random_normal(&r), z = random_normal(&r);
    s->measured[row] = vec3_make(place.x + noise.x * x, place.y + noise.y * y, place.z + noise.z * z);
}

static void observe(station_table *s, int32_t row, vec3 thrust, bool fresh, double dt)
{
    motion_estimate *e = &s->estimate[row];
    if (s->observer[row] == OBSERVER_PASSIVE) {
        passive_observer_step(&s->model[row], &s->passive[row], e, thrust, s->measured[row], dt);
        return;
    }
    kalman_predict(&s->model[row], &s->kalman[row], e, &s->covariance[row], thrust, dt);
    if (fresh)
        kalman_correct(&s->kalman[row], e, &s->covariance[row], s->measured[row]);
}

vec3 station_load(const station_table *s, int32_t row)
{
    const wrench *lines = &s->mooring_load[row];
    if (!s->positioning[row])
        return s->estimate[row].bias;
    return vec3_sub(s->estimate[row].bias, vec3_make(lines->force.x, lines->force.y, lines->moment.z));
}

/* The load that is fed forward, global: of the bias what the lines leave to the thrusters. */
static vec3 fed_load(const station_table *s, int32_t row)
{
    switch ((feed_source)s->feed[row]) {
    case FEED_MEASURED:
        return s->load[row];
    case FEED_OBSERVED:
        return s->estimate[row].bias;
    case FEED_NONE:
        break;
    }
    return vec3_make(0, 0, 0);
}

static void control(station_table *s, int32_t row, const station_moment *now, vec3 centre, const waypoint_table *path,
                    thruster_table *thrusters)
{
    double dt = now->dt * (double)s->control_every[row];
    vec3 target = reference_target(path, row, s->home[row], now->time);
    if (s->heading_rule[row] == HEADING_VANING) {
        vec3 load = s->feed[row] == FEED_MEASURED ? s->load[row] : station_load(s, row);
        s->vane_heading[row] = vaning_step(&s->vaning[row], s->vane_heading[row], load, dt);
        target.z = s->vane_heading[row];
    }
    reference_step(&s->filter[row], &s->reference[row], plane_place_of_centre(centre, target), dt);
    const motion_estimate *e = &s->estimate[row];
    vec3 feed = plane_to_vessel(e->place.z, vec3_scale(fed_load(s, row), -s->feed_gain[row]));
    const reference_state *r = &s->reference[row];
    if (station_is_of_heading_alone(s, row))
        feed = yaw_of(feed); /* the mooring takes the forces, those of the ice too */
    s->demand[row] = pid_step(&s->gains[row], e->place, e->velocity, r->place, r->velocity, feed,
                              s->saturated[row] != 0, &s->integral[row], dt);
    bool reached;
    if (station_is_of_heading_alone(s, row)) /* and the forces that come with a moment */
        s->missed[row] =
            vec3_make(0, 0, thruster_allocate_turn(thrusters, row, s->lever[row], s->demand[row].z, &reached));
    else
        s->missed[row] = thruster_allocate(thrusters, row, s->lever[row], s->demand[row], &reached);
    s->saturated[row] = !reached;
}

static void smooth_load(station_table *s, int32_t row, const station_moment *now)
{
    double share = s->feed_time[row] > now->dt ? now->dt / s->feed_time[row] : 1;
    vec3 load = vec3_make(now->ice.force.x, now->ice.force.y, now->ice.moment.z);
    s->load[row] = vec3_mad(s->load[row], vec3_sub(load, s->load[row]), share);
}

fram_status station_step(context *ctx, station_table *s, int32_t row, const station_moment *now,
                         const vessel_table *vessels, const body_table *bodies, const waypoint_table *path,
                         thruster_table *thrusters, event_table *events, fram_error *error)
{
    if (!watch(ctx, s, row, now, vessels, bodies, path, events))
        return error_memory(error);
    if (!s->positioning[row])
        return FRAM_OK;
    smooth_load(s, row, now);
    bool fresh = now->step % s->sample_every[row] == 0;
    if (fresh)
        measure(s, row, now, place_of(bodies, vessels->body[row]));
    if (now->step % s->control_every[row] != 0)
        return FRAM_OK;
    observe(s, row, thruster_effect(thrusters, row), fresh, now->dt * (double)s->control_every[row]);
    control(s, row, now, vessels->centre[row], path, thrusters);
    return FRAM_OK;
}
