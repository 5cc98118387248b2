#include "sim/controls.h"

#include "base/transcendental.h"
#include "sim/feed.h"
#include "sim/media_now.h"
#include "vessel/prescribed_path.h"

#include <stdio.h>

/* Beyond all that can be meant: speeds [m/s], lengths [m], angles [deg]; forces [N] and moments [N m]. */
#define SPEED_MOST 1e3
#define PLACE_MOST 1e9
#define ANGLE_MOST 1e6
#define FORCE_MOST 1e18

/* ---- the list ---- */

typedef struct lister {
    context *ctx;
    const scenario *s;
    control_array *out;
    bool good;
} lister;

/* vessel -1: of the world; `number` counts from 1, 0: none. */
static void add(lister *l, control_role role, int32_t vessel, int32_t which, int32_t axis, const char *format,
                int32_t number, const char *unit, const char *meaning)
{
    control c = {.unit = unit, .meaning = meaning, .role = role, .which = which, .axis = axis};
    char text[40];
    snprintf(text, sizeof text, format, (int)number);
    snprintf(c.name, sizeof c.name, "%s", vessel < 0 ? text : vessel_channel_name(l->s, vessel, text).text);
    l->good = l->good && array_push(l->ctx, l->out, c);
}

static void add_vector(lister *l, control_role role, int32_t vessel, int32_t axes, const char *name, const char *unit,
                       const char *meaning)
{
    static const char *const ends[] = {"x", "y", "z"};
    for (int32_t axis = 0; axis < axes; axis++) {
        char format[32];
        snprintf(format, sizeof format, "%s_%s", name, ends[axis]);
        add(l, role, vessel, vessel > 0 ? vessel : 0, axis, format, 0, unit, meaning);
    }
}

static int32_t thrusters_of(const world *w, int32_t vessel)
{
    int32_t count = 0;
    for (int32_t i = 0; i < w->thrusters.count; i++)
        count += w->thrusters.vessel[i] == vessel;
    return count;
}

/* Of a ship that drives itself and has no thrusters nothing follows a set point: its autopilot goes by its track. */
static bool goes_by_track(const world *w, int32_t v)
{
    bool drives = false;
    for (int32_t i = 0; i < w->propulsion.count && !drives; i++)
        drives = w->propulsion.vessel[i] == v;
    return drives && thrusters_of(w, v) == 0;
}

/* Of a ship whose bow turns against the ice the heading that is wanted is its own. */
static bool finds_its_heading(const world *w, int32_t v) { return w->stations.heading_rule[v] == HEADING_VANING; }

static void list_station(lister *l, const world *w, int32_t v)
{
    if (!station_is_kept(&w->stations, &w->vessels, v) || goes_by_track(w, v))
        return;
    if (!station_is_of_heading_alone(&w->stations, v))
        add_vector(l, CONTROL_SET_POINT, v, 2, "set_point", "m", "where the ship's origin shall be, global frame");
    if (!finds_its_heading(w, v))
        add(l, CONTROL_SET_POINT, v, v, 2, "set_point_heading", 0, "deg", "heading that is wanted");
    if (thrusters_of(w, v) > 0)
        add(l, CONTROL_POSITIONING, v, v, 0, "positioning", 0, "1",
            "1: the vessel's own controller gives the orders to the thrusters; 0: whoever steps the world does");
}

static void list_vessel(lister *l, const world *w, int32_t v)
{
    vessel_mode mode = (vessel_mode)w->vessels.mode[v];
    if (mode != VESSEL_FREE)
        add_vector(l, CONTROL_TOW, v, 2, "tow_velocity", "m/s",
                   "velocity of the carriage or driven hull, global frame");
    if (mode != VESSEL_PRESCRIBED) {
        add_vector(l, CONTROL_FORCE, v, 3, "outside_force", "N", "force on the vessel in every step, global frame");
        add_vector(l, CONTROL_MOMENT, v, 3, "outside_moment", "N m",
                   "moment about the centre of mass in every step, global frame");
    }
    list_station(l, w, v);
}

/* Those of each thruster and line, counted for each vessel. */
static void list_equipment(lister *l, const world *w, int32_t v)
{
    int32_t thruster = 0, line = 0;
    for (int32_t i = 0; i < w->thrusters.count; i++) {
        if (w->thrusters.vessel[i] != v)
            continue;
        add(l, CONTROL_THRUST, v, i, 0, "thruster_%d_order", ++thruster, "N",
            "thrust ordered, within what the thruster can give; negative: astern");
        if (w->thrusters.kind[i] == THRUSTER_AZIMUTH || w->thrusters.rudder[i] > 0)
            add(l, CONTROL_ANGLE, v, i, 0, "thruster_%d_order_angle", thruster, "deg",
                w->thrusters.kind[i] == THRUSTER_MAIN
                    ? "direction ordered of the thrust behind the rudder, vessel frame"
                    : "direction ordered, vessel frame");
    }
    for (int32_t i = 0; i < w->lines.count; i++) {
        if (w->lines.vessel[i] == v)
            add(l, CONTROL_RELEASE, v, i, 0, "line_%d_release", ++line, "1", "1: the line is let go in the next step");
    }
}

bool controls_list(context *ctx, const scenario *s, const model *m, const world *w, control_array *out)
{
    lister l = {ctx, s, out, true};
    if (m->forces == FORCES_FLUID) {
        add_vector(&l, CONTROL_WIND, -1, 2, "wind", "m/s", "velocity of the wind, towards, global frame");
        add_vector(&l, CONTROL_CURRENT, -1, 2, "current", "m/s",
                   "velocity of the current at the surface, towards, global frame");
    }
    if (w->feeding.count > 0 || w->drift.count > 0)
        add_vector(&l, CONTROL_DRIFT, -1, 2, "ice_drift", "m/s", "velocity of the ice far away, global frame");
    for (int32_t v = 0; v < w->vessels.count; v++) {
        list_vessel(&l, w, v);
        list_equipment(&l, w, v);
    }
    return l.good;
}

/* ---- values ---- */

static double *axis_of(vec3 *v, int32_t axis) { return axis == 0 ? &v->x : axis == 1 ? &v->y : &v->z; }

static double axis_value(vec3 v, int32_t axis) { return *axis_of(&v, axis); }

static vec3 target_of(const world *w, int32_t v)
{
    return reference_target(&w->waypoints, v, w->stations.home[v], w->clock.time[0]);
}

/* What was told of a medium, or what holds without. */
static vec3 medium_now(const model *m, const world *w, const control *c)
{
    double time = w->clock.time[0];
    media now = media_now(m, &w->inputs, time);
    vec2 drift = c->role == CONTROL_DRIFT ? feed_drift(m, &w->inputs, time) : vec2_make(0, 0);
    return c->role == CONTROL_WIND      ? now.wind
           : c->role == CONTROL_CURRENT ? now.current
                                        : vec3_make(drift.x, drift.y, 0);
}

static vec3 force_told(const world *w, const control *c)
{
    int32_t row = input_find(&w->inputs, INPUT_FORCE, c->which);
    if (row < 0)
        return vec3_make(0, 0, 0);
    return c->role == CONTROL_FORCE ? w->inputs.first[row] : w->inputs.second[row];
}

static bool goes_along_path(const world *w, int32_t vessel) { return !isnan(path_place(&w->waypoints, vessel, 0).z); }

/* What a carriage or driven hull goes by: its path, while it has one, else the velocity that its ramp leads to. */
static vec3 tow_velocity(const world *w, int32_t vessel)
{
    if (!goes_along_path(w, vessel))
        return w->vessels.tow_velocity[vessel];
    vec3 along = path_velocity(&w->waypoints, vessel, w->clock.time[0]);
    return vec3_make(along.x, along.y, 0);
}

double control_get(const model *m, const world *w, const control *c)
{
    switch (c->role) {
    case CONTROL_WIND:
    case CONTROL_CURRENT:
    case CONTROL_DRIFT:
        return axis_value(medium_now(m, w, c), c->axis);
    case CONTROL_FORCE:
    case CONTROL_MOMENT:
        return axis_value(force_told(w, c), c->axis);
    case CONTROL_TOW:
        return axis_value(tow_velocity(w, c->which), c->axis);
    case CONTROL_SET_POINT:
        return c->axis == 2 ? degrees(target_of(w, c->which).z) : axis_value(target_of(w, c->which), c->axis);
    case CONTROL_POSITIONING:
        return w->stations.positioning[c->which];
    case CONTROL_THRUST:
        return w->thrusters.order[c->which];
    case CONTROL_ANGLE:
        return degrees(w->thrusters.order_angle[c->which]);
    case CONTROL_RELEASE:
        return w->lines.broken[c->which] || w->lines.release_time[c->which] <= w->clock.time[0];
    }
    return 0;
}

/* ---- telling ---- */

static fram_status set_medium(context *ctx, world *w, const control *c, double value, fram_error *error)
{
    const input_kind kind = c->role == CONTROL_WIND      ? INPUT_WIND
                            : c->role == CONTROL_CURRENT ? INPUT_CURRENT
                                                         : INPUT_DRIFT;
    return input_tell(ctx, &w->inputs, kind, c->axis, value) ? FRAM_OK : error_memory(error);
}

static fram_status set_force(context *ctx, world *w, const control *c, double value, fram_error *error)
{
    int32_t row = input_row(ctx, &w->inputs, INPUT_FORCE, c->which);
    if (row < 0)
        return error_memory(error);
    *axis_of(c->role == CONTROL_FORCE ? &w->inputs.first[row] : &w->inputs.second[row], c->axis) = value;
    return FRAM_OK;
}

static void drop_path(world *w, int32_t vessel)
{
    int32_t kept = 0;
    for (int32_t i = 0; i < w->waypoints.count; i++) {
        if (w->waypoints.vessel[i] == vessel)
            continue;
        if (kept < i)
            table_move_row(&w->waypoints, &waypoint_table_info, kept, i);
        kept++;
    }
    w->waypoints.count = kept;
}

/* A carriage or driven hull goes on as fast as its path has it now, or at what its ramp leads to: at once. */
static void go_on(world *w, int32_t vessel)
{
    w->vessels.tow_velocity[vessel] = tow_velocity(w, vessel);
    w->vessels.tow_ramp[vessel] = 0;
    drop_path(w, vessel);
}

/* The point whose offset counts goes with the set point, as it does with way points. */
static void move_home(world *w, int32_t v, vec3 home)
{
    station_table *s = &w->stations;
    vec2 place = station_watched_place(s, v, &w->vessels, home);
    s->watched_home[v].x = place.x;
    s->watched_home[v].y = place.y;
    s->home[v] = home;
}

static void set_point(world *w, const control *c, double value)
{
    vec3 home = target_of(w, c->which);
    *axis_of(&home, c->axis) = c->axis == 2 ? radians(value) : value;
    move_home(w, c->which, home);
    drop_path(w, c->which);
}

/* Taken up without a jump: what the controller remembers begins at the vessel as it is; off, it demands nothing.  The
   point whose offset counts stays where it shall be, whoever turns the vessel from here on. */
static void set_positioning(world *w, int32_t v, bool on)
{
    station_table *s = &w->stations;
    bool was = s->positioning[v] != 0;
    if (was != on)
        move_home(w, v, target_of(w, v));
    if (was && !on) /* lines are known to a controller that works: the load stays as it was last believed */
        s->estimate[v].bias = station_load(s, v);
    s->positioning[v] = on;
    if (was == on)
        return;
    s->demand[v] = s->missed[v] = vec3_make(0, 0, 0);
    s->saturated[v] = 0;
    if (!on)
        return;
    station_believe(s, v, &w->vessels, &w->bodies);
    s->integral[v] = s->load[v] = vec3_make(0, 0, 0);
}

static fram_status refuse(const control *c, double value, double least, double most, fram_error *error)
{
    return error_set(error, FRAM_ERROR_INPUT, NULL, 0, c->name, "expected %g to %g %s, found %g", least, most, c->unit,
                     value);
}

/* As a scenario's speed, under the one at which a world is taken to have gone wrong: that of both axes. */
static fram_status check_tow(const model *m, const world *w, const control *c, double value, fram_error *error)
{
    vec3 told = tow_velocity(w, c->which);
    *axis_of(&told, c->axis) = value;
    double speed = sqrt(told.x * told.x + told.y * told.y);
    if (speed < m->speed_limit)
        return FRAM_OK;
    return error_set(error, FRAM_ERROR_INPUT, NULL, 0, c->name,
                     "expected less than run.speed_limit, %g m/s, together with the other axis: (%g, %g) is %g m/s",
                     m->speed_limit, told.x, told.y, speed);
}

static fram_status set_order(world *w, const control *c, double value, fram_error *error)
{
    thruster_table *t = &w->thrusters;
    int32_t row = c->which, v = t->vessel[row];
    if (v < w->stations.count && w->stations.positioning[v])
        return error_set(error, FRAM_ERROR_USAGE, NULL, 0, c->name,
                         "the vessel's own controller gives the orders; set its input positioning to 0 before");
    if (c->role == CONTROL_THRUST) {
        t->order[row] = fmin(fmax(value, -t->astern[row]), t->ahead[row]);
        /* It may stand in the forbidden sector as long as nobody asks it to push. */
        if (t->order[row] > 0)
            t->order_angle[row] = thruster_allowed_angle(t, row, t->order_angle[row]);
    } else {
        t->order_angle[row] = plane_angle(thruster_allowed_angle(t, row, plane_angle(radians(value))));
    }
    return FRAM_OK;
}

static double most_of(control_role role)
{
    switch (role) {
    case CONTROL_WIND:
    case CONTROL_CURRENT:
    case CONTROL_DRIFT:
    case CONTROL_TOW:
        return SPEED_MOST;
    case CONTROL_SET_POINT:
        return PLACE_MOST;
    case CONTROL_ANGLE:
        return ANGLE_MOST;
    case CONTROL_POSITIONING:
    case CONTROL_RELEASE:
        return 1;
    case CONTROL_FORCE:
    case CONTROL_MOMENT:
    case CONTROL_THRUST:
        break;
    }
    return FORCE_MOST;
}

fram_status control_set(context *ctx, const model *m, world *w, const control *c, double value, fram_error *error)
{
    bool flag = c->role == CONTROL_POSITIONING || c->role == CONTROL_RELEASE;
    double most = c->role == CONTROL_SET_POINT && c->axis == 2 ? ANGLE_MOST : most_of(c->role);
    if (flag && value != 0 && value != 1)
        return error_set(error, FRAM_ERROR_INPUT, NULL, 0, c->name, "expected 0 or 1, found %g", value);
    if (!(fabs(value) <= most))
        return refuse(c, value, -most, most, error);
    switch (c->role) {
    case CONTROL_WIND:
    case CONTROL_CURRENT:
    case CONTROL_DRIFT:
        return set_medium(ctx, w, c, value, error);
    case CONTROL_FORCE:
    case CONTROL_MOMENT:
        return set_force(ctx, w, c, value, error);
    case CONTROL_TOW:
        if (check_tow(m, w, c, value, error) != FRAM_OK)
            return FRAM_ERROR_INPUT;
        go_on(w, c->which);
        *axis_of(&w->vessels.tow_velocity[c->which], c->axis) = value;
        return FRAM_OK;
    case CONTROL_SET_POINT:
        set_point(w, c, value);
        return FRAM_OK;
    case CONTROL_POSITIONING:
        set_positioning(w, c->which, value != 0);
        return FRAM_OK;
    case CONTROL_THRUST:
    case CONTROL_ANGLE:
        return set_order(w, c, value, error);
    case CONTROL_RELEASE:
        /* 0 takes back nothing: a line that is gone stays so. */
        if (value != 0)
            w->lines.release_time[c->which] = fmin(w->lines.release_time[c->which], w->clock.time[0]);
        return FRAM_OK;
    }
    return FRAM_OK;
}

/* ---- paths ---- */

static vec3 place_now(const world *w, int32_t vessel)
{
    int32_t body = w->vessels.body[vessel];
    double heading = quat_roll_pitch_yaw(w->bodies.orientation[body]).z;
    vec3 at = w->bodies.position[body];
    return plane_place_of_origin(w->vessels.centre[vessel], vec3_make(at.x, at.y, heading));
}

static fram_status check_path(const world *w, const double *times, const vec3 *places, int32_t count, fram_error *error)
{
    double before = w->clock.time[0];
    for (int32_t i = 0; i < count; i++) {
        bool finite =
            fabs(places[i].x) <= PLACE_MOST && fabs(places[i].y) <= PLACE_MOST && fabs(places[i].z) <= ANGLE_MOST;
        if (!(times[i] > before && times[i] < HUGE_VAL))
            return error_set(error, FRAM_ERROR_INPUT, NULL, 0, "times",
                             "expected times that ascend from now, %g s, on; found %g at number %d", w->clock.time[0],
                             times[i], (int)i);
        if (!finite)
            return error_set(error, FRAM_ERROR_INPUT, NULL, 0, "places",
                             "expected finite places within 1e9 m, found (%g, %g, %g) at number %d", places[i].x,
                             places[i].y, places[i].z, (int)i);
        before = times[i];
    }
    return FRAM_OK;
}

/* What is moved along them goes from place to place, and its rim around, under the speed at which a world is taken to
   have gone wrong. */
static fram_status check_legs(const model *m, const world *w, int32_t vessel, vec3 from, const double *times,
                              const vec3 *places, int32_t count, fram_error *error)
{
    double before = w->clock.time[0], reach = world_reach_about(w, w->vessels.body[vessel], vec3_make(0, 0, 1));
    for (int32_t i = 0; i < count; i++) {
        vec3 way = vec3_sub(places[i], from);
        double time = times[i] - before, speed = sqrt(way.x * way.x + way.y * way.y) / time;
        double turn = fabs(way.z) / time;
        if (!(speed < m->speed_limit))
            return error_set(error, FRAM_ERROR_INPUT, NULL, 0, "times",
                             "expected less than run.speed_limit, %g m/s, on the way to number %d, found %g m/s",
                             m->speed_limit, (int)i, speed);
        if (!(turn * reach < m->speed_limit))
            return error_set(error, FRAM_ERROR_INPUT, NULL, 0, "times",
                             "expected less than run.speed_limit, %g m/s, on the way to number %d, found a turn of %g "
                             "rad/s, which is %g m/s at %g m from the centre of mass; headings are in radians",
                             m->speed_limit, (int)i, turn, turn * reach, reach);
        from = places[i];
        before = times[i];
    }
    return FRAM_OK;
}

static void put_waypoint(waypoint_table *t, int32_t row, int32_t vessel, double time, vec3 place)
{
    t->vessel[row] = vessel;
    t->time[row] = time;
    t->place[row] = place;
}

/* Neither of a place nor of a heading. */
static bool follows_nothing(const world *w, int32_t vessel)
{
    return station_is_kept(&w->stations, &w->vessels, vessel) && station_is_of_heading_alone(&w->stations, vessel) &&
           finds_its_heading(w, vessel);
}

fram_status control_path(context *ctx, const model *m, world *w, int32_t vessel, const double *times,
                         const vec3 *places, int32_t count, fram_error *error)
{
    if (count > 0 && goes_by_track(w, vessel))
        return error_set(error, FRAM_ERROR_USAGE, NULL, 0, "vessel",
                         "expected one that is towed or driven or has a set point; number %d drives itself without "
                         "thrusters: its autopilot goes by propulsion.waypoints or propulsion.pattern",
                         (int)vessel);
    if (count > 0 && follows_nothing(w, vessel))
        return error_set(error, FRAM_ERROR_USAGE, NULL, 0, "vessel",
                         "expected one that is towed or driven or has a set point; lines hold the place of number %d "
                         "(positioning.control: heading), and its bow turns against the ice (heading: vaning)",
                         (int)vessel);
    fram_status status = check_path(w, times, places, count, error);
    if (status != FRAM_OK)
        return status;
    waypoint_table *t = &w->waypoints;
    bool free = w->vessels.mode[vessel] == VESSEL_FREE;
    vec3 from = free && vessel < w->stations.count ? target_of(w, vessel) : place_now(w, vessel);
    /* Where it heads now is known but for whole turns: it takes the shorter way to the first place. */
    if (!free && count > 0)
        from.z = places[0].z + plane_angle(from.z - places[0].z);
    if (!free)
        status = check_legs(m, w, vessel, from, times, places, count, error);
    if (status != FRAM_OK)
        return status;
    if (count > 0 && !table_reserve(ctx, t, &waypoint_table_info, t->count + count + 1))
        return error_memory(error);
    if (count == 0 && !free && goes_along_path(w, vessel))
        go_on(w, vessel);
    drop_path(w, vessel);
    if (count > 0) {
        int32_t row = t->count;
        if (!table_resize(ctx, t, &waypoint_table_info, row + count + 1))
            return error_memory(error);
        put_waypoint(t, row, vessel, w->clock.time[0], from);
        for (int32_t i = 0; i < count; i++)
            put_waypoint(t, row + 1 + i, vessel, times[i], places[i]);
    }
    if (free && vessel < w->stations.count)
        move_home(w, vessel, from);
    return FRAM_OK;
}
