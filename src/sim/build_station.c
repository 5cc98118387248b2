#include "sim/build_station.h"

#include "base/hash.h"
#include "base/load_unit.h"
#include "base/number_text.h"
#include "base/transcendental.h"
#include "sim/steady_load.h"

#include "io/csv_read.h"

#include <stdio.h>
#include <string.h>

/* An error of the rooms below names a member of a list's item. */
static fram_status name_item(const scenario *s, const vessel_entry *entry, fram_status status, const char *list,
                             int32_t item, fram_error *error)
{
    if (status != FRAM_ERROR_INPUT || !error)
        return status;
    char member[sizeof error->key];
    memcpy(member, error->key, sizeof member);
    snprintf(error->key, sizeof error->key, "%s[%d].%.60s", list, (int)item, member);
    vessel_name_error(s, entry, error);
    return status;
}

/* ---- mooring ---- */

/* As name_item; a point of a table that came from a file is a line of that file. */
static fram_status name_line(context *ctx, const scenario *s, const vessel_entry *entry, fram_status status,
                             int32_t item, fram_error *error)
{
    const char *file = entry->keys->mooring.lines.data[item].table_file;
    char path[SCENARIO_PATH_ROOM];
    int point;
    if (status != FRAM_ERROR_INPUT || !error || !file[0] || strncmp(error->key, "table", 5) != 0 ||
        !scenario_resolve_path(s, file, path, sizeof path))
        return name_item(s, entry, status, "mooring.lines", item, error);
    char why[sizeof error->message];
    memcpy(why, error->message, sizeof why);
    const char *column = strstr(error->key, "].tension") ? "tension" : "offset";
    bool row = sscanf(error->key, "table[%d]", &point) == 1;
    return error_set(error, FRAM_ERROR_INPUT, path, row ? csv_line_of(ctx, path, point) : 0, row ? column : NULL, "%s",
                     why);
}

/* Rules of the points stand in vessel/mooring.c; here only where they come from. */
static fram_status read_curve(context *ctx, const scenario *s, const char *file, line_definition *d, fram_error *error)
{
    static const char *const names[2] = {"offset[m]", "tension[N]"};
    double_array column[2] = {{0}, {0}};
    char path[SCENARIO_PATH_ROOM];
    fram_status status = scenario_file_path(s, NULL, file, path, error);
    if (status == FRAM_OK)
        status = csv_read(ctx, path, names, 2, column, error);
    if (status == FRAM_OK && column[0].count > LINE_POINTS)
        status = error_set(error, FRAM_ERROR_INPUT, path, csv_line_of(ctx, path, LINE_POINTS), NULL,
                           "expected at most %d rows, found %d", (int)LINE_POINTS, (int)column[0].count);
    for (int32_t i = 0; i < column[0].count && status == FRAM_OK; i++) {
        d->curve.offset[i] = column[0].data[i];
        d->curve.tension[i] = column[1].data[i];
        d->points = i + 1;
    }
    array_free(ctx, &column[0]);
    array_free(ctx, &column[1]);
    return status;
}

static fram_status find_curve(context *ctx, const scenario *s, const scenario_mooring_line *l, line_definition *d,
                              fram_error *error)
{
    if (l->table_file[0])
        return read_curve(ctx, s, l->table_file, d, error);
    for (int32_t i = 0; i < l->table.count; i++) {
        d->curve.offset[i] = l->table.data[i].offset;
        d->curve.tension[i] = l->table.data[i].tension;
    }
    d->points = l->table.count;
    return FRAM_OK;
}

/* Lines of full size carry 50 kN or more (usual.c); a table that goes up to less than this is one of kN [N]. */
#define TENSION_LEAST 1e4

static void warn_of_curve(context *ctx, const scenario *s, const vessel_entry *entry, int32_t item,
                          const line_definition *d)
{
    double least = TENSION_LEAST * real_pow(scenario_size(s), 3);
    if (d->kind == LINE_TABLE && d->curve.tension[d->points - 1] < least)
        log_write(ctx, LOG_WARNING,
                  "%s.mooring.lines[%d].table%s: the tension goes up to %s, less than %s: give newtons, not kN or "
                  "tonnes",
                  entry->path, (int)item, entry->keys->mooring.lines.data[item].table_file[0] ? "_file" : "",
                  load_text_of(d->curve.tension[d->points - 1], 4).text, load_text_of(least, 4).text);
}

/* The k-th line of an item of the list. */
static line_definition line_of(const scenario_mooring *m, const scenario_mooring_line *l, int64_t k, int32_t vessel)
{
    return (line_definition){
        .vessel = vessel,
        .kind = l->kind,
        .turret = m->turret,
        .centre = {m->x, m->y, m->z},
        .fairlead_distance = l->fairlead_distance,
        .direction = radians(l->direction_deg + (double)k * l->spacing_deg),
        .distance = l->distance,
        .depth = m->depth,
        .length = l->length,
        .pretension = l->pretension,
        .weight = l->weight,
        .stiffness = l->stiffness,
        .breaking_load = automatic_or(l->breaking_load, HUGE_VAL),
        .release_time = automatic_or(l->release_time, HUGE_VAL),
    };
}

static fram_status add_lines(context *ctx, const scenario *s, const vessel_entry *entry, int32_t vessel, world *w,
                             fram_error *error)
{
    const scenario_mooring *m = &entry->keys->mooring;
    for (int32_t i = 0; i < m->lines.count; i++) {
        const scenario_mooring_line *l = &m->lines.data[i];
        for (int64_t k = 0; k < l->count; k++) {
            line_definition d = line_of(m, l, k, vessel);
            fram_status status = find_curve(ctx, s, l, &d, error);
            if (status != FRAM_OK)
                return status;
            status = mooring_add_line(ctx, &d, &w->vessels, &w->bodies, &w->lines, error);
            if (status != FRAM_OK)
                return name_line(ctx, s, entry, status, i, error);
            if (k == 0)
                warn_of_curve(ctx, s, entry, i, &d);
        }
    }
    return FRAM_OK;
}

/* Current and wind on the hull as it lies still. */
typedef struct still_hull {
    const model *m;
    const world *w;
    int32_t vessel;
} still_hull;

static vec3 still_load(const void *user, double heading)
{
    const still_hull *h = user;
    media begin = media_at(&h->m->media, &h->m->history, 0);
    return steady_media_load(h->m, h->w, h->vessel, &begin, heading);
}

/* By one of the vessel's lines that holds. */
static bool is_moored(const world *w, int32_t vessel)
{
    bool moored = false;
    for (int32_t i = 0; i < w->lines.count; i++)
        moored = moored || (w->lines.vessel[i] == vessel && !w->lines.broken[i]);
    return moored;
}

/* Lines that the first step lets go: whether they hold nothing already. */
static void let_go(world *w, int32_t vessel, bool gone)
{
    for (int32_t i = 0; i < w->lines.count; i++)
        if (w->lines.vessel[i] == vessel && w->lines.release_time[i] <= 0)
            w->lines.broken[i] = gone;
}

/* From which on a turn is told [deg]. */
#define TOLD_TURN 0.1

/* "(-0.00689, 0) m off" */
enum { WAY_ROOM = 64 };
static void way_text(vec3 by, char out[WAY_ROOM])
{
    const double largest = fmax(fabs(by.x), fabs(by.y));
    snprintf(out, WAY_ROOM, "(%.3g, %.3g) m off", told_beside(by.x, largest, LEAST_TOLD),
             told_beside(by.y, largest, LEAST_TOLD));
}

/* left: what of the search is left at that pose. */
static void tell_equilibrium(context *ctx, const vessel_entry *entry, bool found, vec3 by, double turn, double heading,
                             const mooring_balance *left)
{
    char turned[64] = "", onward[96] = "", way[WAY_ROOM];
    way_text(by, way);
    if (fabs(degrees(turn)) >= TOLD_TURN)
        snprintf(turned, sizeof turned, " and turned by %.3g degrees, to heading %.4g", degrees(turn),
                 degrees(heading));
    if (fabs(degrees(left->turn_left)) >= TOLD_TURN)
        snprintf(onward, sizeof onward, "; it is not stable: any touch turns the vessel from it, to heading %.4g",
                 degrees(plane_angle(heading + left->turn_left)));
    vessel_title title = vessel_title_of(entry);
    if (found)
        log_write(ctx, LOG_INFO, "%s begins at the equilibrium of its mooring, %s%s%s", title.text, way, turned,
                  onward);
    else
        log_write(ctx, LOG_WARNING, "no equilibrium of the mooring of %s was found; %s are left %s%s", title.text,
                  load_text_of(left->residual, 4).text, way, turned);
}

static void find_equilibrium(context *ctx, const vessel_entry *entry, const model *m, int32_t vessel, world *w)
{
    if (!is_moored(w, vessel))
        return;
    int32_t body = w->vessels.body[vessel];
    const still_hull hull = {m, w, vessel};
    bool fluid = m->forces == FORCES_FLUID;
    vec3 position = w->bodies.position[body];
    quat orientation = w->bodies.orientation[body];
    mooring_balance left;
    bool found = mooring_equilibrium(&w->lines, vessel, w->vessels.length[vessel], fluid ? still_load : NULL, &hull,
                                     &position, &orientation, &left);
    /* Of the point whose offset counts: the origin of a ship that turns about its turret goes far. */
    vec3 watched = w->stations.watched[vessel];
    vec3 by =
        vec3_sub(vec3_add(position, mat3_mul_vec(quat_matrix(orientation), watched)),
                 vec3_add(w->bodies.position[body], mat3_mul_vec(quat_matrix(w->bodies.orientation[body]), watched)));
    double heading = quat_roll_pitch_yaw(orientation).z;
    double turn = plane_angle(heading - quat_roll_pitch_yaw(w->bodies.orientation[body]).z);
    tell_equilibrium(ctx, entry, found, by, turn, heading, &left);
    w->bodies.position[body] = position;
    w->bodies.orientation[body] = orientation;
}

/* ---- thrusters, way points ---- */

/* Power of an open propeller per newton at its largest thrust, at full scale [W/N]: a bollard pull of 160 N per
   kilowatt is usual for unducted azimuth and tunnel thrusters.  A speed, by its unit. */
#define POWER_PER_THRUST (1000.0 / 160)

/* An azimuth pushes one way alone. */
double thruster_largest_thrust(const scenario_thruster *t)
{
    return t->kind == THRUSTER_AZIMUTH ? t->thrust : fmax(t->thrust, automatic_or(t->thrust_astern, t->thrust));
}

static fram_status add_thrusters(context *ctx, const scenario *s, const vessel_entry *entry, int32_t vessel, world *w,
                                 fram_error *error)
{
    for (int32_t i = 0; i < entry->keys->thrusters.count; i++) {
        const scenario_thruster *t = &entry->keys->thrusters.data[i];
        double astern = automatic_or(t->thrust_astern, t->thrust);
        double setting = entry->keys->positioning.active ? 0 : t->setting;
        const thruster_definition d = {
            .vessel = vessel,
            .kind = t->kind,
            .place = {t->x, t->y, t->z},
            .ahead = t->thrust,
            .astern = astern,
            .time_constant = t->time_constant,
            .speed_rate = t->speed_rate,
            .turn_rate = radians(t->turn_rate_deg),
            .rudder = radians(t->rudder_deg),
            .forbidden_centre = radians(t->forbidden_deg),
            .forbidden_half = radians(0.5 * t->forbidden_width_deg),
            .cost = t->cost,
            .full_power =
                automatic_or(t->power, POWER_PER_THRUST * sqrt(scenario_size(s)) * thruster_largest_thrust(t)),
            .failure_time = automatic_or(t->failure_time, HUGE_VAL),
            .order = setting * (setting >= 0 ? t->thrust : astern),
            .order_angle = radians(t->direction_deg),
        };
        fram_status status = thruster_add(ctx, &d, &w->vessels, &w->thrusters, error);
        if (status != FRAM_OK)
            return name_item(s, entry, status, "thrusters", i, error);
    }
    return FRAM_OK;
}

static fram_status add_waypoints(context *ctx, const scenario_positioning *p, int32_t vessel, world *w,
                                 fram_error *error)
{
    int32_t had = w->waypoints.count;
    if (!table_resize(ctx, &w->waypoints, &waypoint_table_info, had + p->waypoints.count))
        return error_memory(error);
    for (int32_t i = 0; i < p->waypoints.count; i++) {
        const scenario_waypoint *from = &p->waypoints.data[i];
        w->waypoints.vessel[had + i] = vessel;
        w->waypoints.time[had + i] = from->time;
        w->waypoints.place[had + i] = vec3_make(from->x, from->y, radians(from->heading_deg));
    }
    return FRAM_OK;
}

/* ---- station ---- */

/* What a Kalman filter does not know at the start, as standard deviations at full scale: its speed, and its bias as
   what that may change in a time. */
#define FIRST_SPEED 0.1  /* [m/s] */
#define FIRST_TURN 0.002 /* [rad/s] */
#define FIRST_TIME 100.0 /* [s] */

static plane_model plane_model_of(const scenario *s, const scenario_positioning *p, int32_t vessel, const world *w)
{
    int32_t body = w->vessels.body[vessel];
    vec3 added = w->bodies.added_mass[body];
    double mass = w->bodies.mass[body], stretch = sqrt(scenario_size(s));
    vec3 m = {automatic_or(p->mass_surge, mass + added.x), automatic_or(p->mass_sway, mass + added.y),
              automatic_or(p->mass_yaw, w->bodies.inertia[body].zz + w->bodies.added_inertia[body].z)};
    vec3 d = {automatic_or(p->damping_surge, m.x / (100 * stretch)),
              automatic_or(p->damping_sway, m.y / (50 * stretch)), automatic_or(p->damping_yaw, m.z / (20 * stretch))};
    return (plane_model){{{{m.x, 0, 0}, {0, m.y, 0}, {0, 0, m.z}}}, {{{d.x, 0, 0}, {0, d.y, 0}, {0, 0, d.z}}}};
}

/* A vessel's moments are noisy with a lever of a quarter of its length. */
static vec3 noise_of(const plane_model *m, double per_mass, double length)
{
    vec3 mass = plane_diagonal(m->mass);
    return vec3_make(per_mass * mass.x, per_mass * mass.y, per_mass * mass.z / (0.25 * length));
}

/* A vessel's measurements are noisy in a way of its own, which goes by its name, not by its place in a list: in company
   it is what it is alone.  A vessel without a name has the run's seed itself. */
static uint64_t noise_seed(const scenario *s, const scenario_vessel *v)
{
    uint64_t seed = (uint64_t)s->run.seed;
    return v->name[0] ? hash_bytes(v->name, strlen(v->name), seed) : seed;
}

static station_definition definition_of(const scenario *s, const scenario_vessel *v, int32_t vessel, const world *w)
{
    const scenario_positioning *p = &v->positioning;
    const scenario_station *limits = &v->station;
    const scenario_mooring *m = &v->mooring;
    double dt = s->run.time_step, length = w->vessels.length[vessel];
    int64_t control_every = scenario_steps_of(p->interval, dt),
            sample_every = scenario_steps_of(p->sample_interval, dt);
    /* A measurement that falls between two calls would be missed: samples are taken at calls. */
    sample_every = (sample_every + control_every - 1) / control_every * control_every;
    double turn = radians(p->noise_heading_deg);
    station_definition d = {
        .positioning = p->active,
        .observer = p->observer,
        .control = p->control,
        .feed = p->feed_forward,
        .heading = p->heading,
        .control_every = control_every,
        .sample_every = sample_every,
        .watched = {automatic_or(limits->watch_x, m->x), automatic_or(limits->watch_y, m->y), m->z},
        .offset_limit = automatic_or(limits->offset_limit, HUGE_VAL),
        .heading_limit = radians(automatic_or(limits->heading_limit_deg, HUGE_VAL)),
        .model = plane_model_of(s, p, vessel, w),
        .control_frequency = p->frequency,
        .control_damping = p->damping,
        .filter = {p->reference_frequency, 1, p->reference_speed, radians(p->reference_turn_rate_deg)},
        .passive = {p->observer_bandwidth, p->bias_time},
        .vaning = {radians(p->vaning_rate_deg), p->vaning_time, p->vaning_load},
        .feed_gain = p->feed_forward_gain,
        .feed_time = p->feed_forward_time,
        .noise = {p->noise_position, p->noise_position, turn},
        .seed = noise_seed(s, v),
    };
    /* A filter that trusts its measurements wholly has no gain to compute: a hundredth of a metre at least, scaled. */
    double least = 0.01 * scenario_size(s);
    double position_noise = fmax(p->noise_position, least);
    d.kalman = (kalman_tuning){{position_noise, position_noise, fmax(turn, 1e-4)},
                               noise_of(&d.model, p->force_noise, length),
                               noise_of(&d.model, p->bias_rate, length),
                               p->bias_time};
    double stretch = sqrt(scenario_size(s));
    d.first_speed = vec3_make(FIRST_SPEED * stretch, FIRST_SPEED * stretch, FIRST_TURN / stretch);
    d.first_bias = vec3_scale(d.kalman.bias, sqrt(FIRST_TIME * stretch));
    return d;
}

fram_status build_station(context *ctx, const scenario *s, const vessel_entry *entry, const model *m, int32_t vessel,
                          world *w, fram_error *error)
{
    const scenario_vessel *v = entry->keys;
    if (v->mode != VESSEL_FREE)
        return FRAM_OK;
    fram_status status = add_lines(ctx, s, entry, vessel, w, error);
    if (status == FRAM_OK)
        status = add_thrusters(ctx, s, entry, vessel, w, error);
    if (status == FRAM_OK)
        status = add_waypoints(ctx, &v->positioning, vessel, w, error);
    if (status != FRAM_OK)
        return status;
    station_definition d = definition_of(s, v, vessel, w);
    status = station_add(ctx, &d, vessel, &w->vessels, &w->bodies, &w->stations, error);
    if (status != FRAM_OK)
        return status;
    if (v->mooring.equilibrium) {
        /* The first step books that they were let go. */
        let_go(w, vessel, true);
        find_equilibrium(ctx, entry, m, vessel, w);
        let_go(w, vessel, false);
    }
    /* Who is not on positioning believes nothing until it is switched on. */
    if (d.positioning)
        station_begin(&w->stations, &d, vessel, &w->vessels, &w->bodies);
    return FRAM_OK;
}
