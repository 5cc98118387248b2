#include "sim/capability.h"

#include "base/transcendental.h"
#include "model/scenario_vessel.h"
#include "sim/build.h"
#include "sim/build_feeding.h"
#include "sim/steady_load.h"

#include <stdio.h>
#include <string.h>

/* A limit is found to this part of a step of speed: 2^-10. */
enum { SPEED_HALVINGS = 10 };

/* Loads stand a degree apart or less and are linear between, 1 to 2.5: a load that goes with the sine of the direction
   is then 4e-5 of its greatest off, at 2.5 degrees 2.4e-4. */
enum { LOAD_ROWS = 360 };
/* Of a hull from a file, which may have 1e5 faces to be summed over for each: at most 2.5 degrees apart. */
enum { LOAD_ROWS_OF_FILE = 144 };

static double direction_of(const capability *c, int32_t row) { return 2 * PI * row / c->loads.directions; }

/* ---- loads ---- */

/* In the ship's frame, for one that lies along X. */
static vec3 towards(double from, double speed) { return vec3_make(-speed * real_cos(from), speed * real_sin(from), 0); }

/* The vessel whose capability is asked for. */
enum { VESSEL = 0 };

fram_status capability_go_on(const capability *c, fram_error *error)
{
    if (!stop_is_asked(c->options.stop))
        return FRAM_OK;
    return error_set(error, FRAM_INTERRUPTED, NULL, 0, NULL, "interrupted; nothing was written");
}

static void find_media_load(const model *m, const world *w, capability *c, int32_t i)
{
    double from = 2 * PI * i / c->loads.rows;
    media still = m->media;
    still.profile.count = 0;
    still.current = still.wind = vec3_make(0, 0, 0);
    media blows = still, flows = still;
    blows.wind = towards(from, c->wind_speed);
    flows.current = towards(from, 1);
    if (c->wind_speed > 0)
        c->loads.wind[i] = steady_drag_load(m, w, VESSEL, &blows, 0);
    c->loads.drag[i] = steady_drag_load(m, w, VESSEL, &flows, 0);
    c->loads.damping[i] = steady_damping_load(m, w, VESSEL, &flows, 0);
}

/* Each is a sum over all faces of the hull. */
static fram_status find_media_loads(context *ctx, const model *m, const world *w, capability *c, fram_error *error)
{
    fram_status status = FRAM_OK;
    if (m->forces != FORCES_FLUID)
        return FRAM_OK; /* none, as in a run */
    for (int32_t i = 0; i < c->loads.rows && status == FRAM_OK; i++) {
        status = capability_go_on(c, error);
        if (status == FRAM_OK)
            status = work_continue(ctx, "summing loads", i, c->loads.rows, error);
        if (status == FRAM_OK)
            find_media_load(m, w, c, i);
    }
    return status;
}

static vec3 between(const vec3 *row, int32_t directions, int32_t stride, double from)
{
    double at = from / (2 * PI) * directions, below = floor(at);
    int32_t i = (int32_t)below % directions, j;
    if (i < 0)
        i += directions;
    j = (i + 1) % directions;
    return vec3_mad(vec3_scale(row[i * stride], 1 - (at - below)), row[j * stride], at - below);
}

vec3 capability_ice_between(const vec3 *load, int32_t directions, int32_t speeds, double speed_step, double from,
                            double speed)
{
    double at = fmin(fmax(speed / speed_step - 1, 0), speeds - 1);
    int32_t k = (int32_t)at, next = k + 1 < speeds ? k + 1 : k;
    vec3 a = between(load + k, directions, speeds, from), b = between(load + next, directions, speeds, from);
    return vec3_mad(vec3_scale(a, 1 - (at - k)), b, at - k);
}

int32_t capability_row(const capability *c, int32_t i) { return i * (c->loads.rows / c->loads.directions); }

vec3 capability_load_at(const capability *c, double from, double speed)
{
    const capability_loads *l = &c->loads;
    vec3 sum = between(l->wind, l->rows, 1, from);
    sum = vec3_mad(sum, between(l->damping, l->rows, 1, from), speed);
    sum = vec3_scale(vec3_mad(sum, between(l->drag, l->rows, 1, from), speed * speed), c->options.allowance);
    double share = l->measured ? 1 : c->options.allowance;
    if (!(speed > 0))
        return sum;
    vec3 ice = capability_ice_between(l->ice, l->rows, l->speeds, l->speed_step, from, speed);
    return vec3_mad(sum, ice, share);
}

double broken_ice_resistance(double density, double gravity, double breadth, double thickness, double concentration,
                             double speed)
{
    double f = speed / sqrt(gravity * thickness);
    return density * gravity * breadth * thickness * thickness * (0.13 * breadth / thickness + 1.3 * f + 0.5 * f * f) *
           (2 - concentration) * concentration * concentration;
}

/* ---- balance ---- */

/* A direction and speed as the balance asks for it. */
typedef struct asked_load {
    const capability *c;
    double home, from, speed;
} asked_load;

static vec3 load_at_heading(const void *user, double heading)
{
    const asked_load *a = user;
    /* A bow that turns to port sees the drift come from farther to starboard. */
    double from = a->from + heading - a->home;
    return plane_to_global(heading, capability_load_at(a->c, from, a->speed));
}

static holding hold_at(const capability *c, const holding_case *h, double from, double speed)
{
    const asked_load asked = {c, h->heading, from, speed};
    return holding_find(h, load_at_heading, &asked);
}

/* The first speed that is not held, from below; looked for no farther than up to `enough`, where that is held.
   row: what was found at the steps of speed, NULL: not yet. */
static capability_limit find_limit(const capability *c, const holding_case *h, double from, const holding *row,
                                   double enough)
{
    capability_limit limit = {.failure = -1};
    double step = c->loads.speed_step, held = 0, lost = 0;
    limit.at = hold_at(c, h, from, 0);
    if (limit.at.use > 1)
        return limit;
    for (int32_t k = 0; k < c->loads.speeds && limit.at.use <= 1 && lost < enough; k++) {
        held = lost;
        lost = (k + 1) * step;
        limit.at = row ? row[k] : hold_at(c, h, from, lost);
        if (limit.at.use <= 1)
            limit.turn = fmax(limit.turn, limit.at.turn);
    }
    limit.beyond = limit.at.use <= 1;
    for (int i = 0; i < SPEED_HALVINGS && !limit.beyond && held < enough; i++) {
        double middle = 0.5 * (held + lost);
        holding at = hold_at(c, h, from, middle);
        if (at.use > 1) {
            lost = middle;
            limit.at = at;
        } else {
            held = middle;
            limit.turn = fmax(limit.turn, at.turn);
        }
    }
    limit.speed = limit.beyond ? lost : held;
    return limit;
}

static void fail(world *w, const capability_failure *f, bool failed)
{
    if (f->line)
        w->lines.broken[f->number] = failed;
    else
        w->thrusters.failed[f->number] = failed;
}

/* What is out of order from the start holds nothing, as in the first step of a run. */
static void leave_out_failed(world *w)
{
    for (int32_t i = 0; i < w->thrusters.count; i++)
        w->thrusters.failed[i] = w->thrusters.failure_time[i] <= 0;
    for (int32_t i = 0; i < w->lines.count; i++)
        w->lines.broken[i] = w->lines.release_time[i] <= 0;
}

static void list_failures(const world *w, capability *c)
{
    int32_t most = sizeof c->failure / sizeof *c->failure;
    for (int32_t i = 0; i < w->thrusters.count && c->failures < most; i++)
        if (!w->thrusters.failed[i])
            c->failure[c->failures++] = (capability_failure){false, i};
    for (int32_t i = 0; i < w->lines.count && c->failures < most; i++)
        if (!w->lines.broken[i])
            c->failure[c->failures++] = (capability_failure){true, i};
}

/* Lines take a search for the heading at which the vessel comes to rest, seconds a direction: asked before each one of
   them, intact and after each failure. */
static fram_status balance_goes_on(context *ctx, const capability *c, int32_t direction, int32_t failure,
                                   fram_error *error)
{
    fram_status status = capability_go_on(c, error);
    double each = c->failures + 1;
    if (status == FRAM_OK)
        status = work_continue(ctx, "balancing", direction * each + failure + 1, c->loads.directions * each, error);
    return status;
}

static void find_intact(holding_case *h, capability *c, int32_t i)
{
    holding *row = c->use + i * c->loads.speeds;
    double from = direction_of(c, i);
    h->line_safety = c->options.line_safety;
    for (int32_t k = 0; k < c->loads.speeds; k++)
        row[k] = hold_at(c, h, from, (k + 1) * c->loads.speed_step);
    c->intact[i] = find_limit(c, h, from, row, HUGE_VAL);
}

/* The first of those that hold least; of the others it is enough that they hold as much. */
static fram_status find_damaged(context *ctx, world *w, holding_case *h, capability *c, int32_t i, fram_error *error)
{
    capability_limit *worst = &c->damaged[i];
    fram_status status = FRAM_OK;
    h->line_safety = c->options.line_safety_damaged;
    for (int32_t f = 0; f < c->failures; f++) {
        double enough = f == 0 || worst->beyond ? HUGE_VAL : worst->speed;
        if (!(enough > 0))
            break;
        status = balance_goes_on(ctx, c, i, f, error);
        if (status != FRAM_OK)
            break;
        fail(w, &c->failure[f], true);
        capability_limit limit = find_limit(c, h, direction_of(c, i), NULL, enough);
        fail(w, &c->failure[f], false);
        limit.failure = f;
        if (f == 0 || limit.speed < worst->speed || (worst->beyond && !limit.beyond))
            *worst = limit;
    }
    return status;
}

static fram_status find_limits(context *ctx, world *w, holding_case *h, capability *c, fram_error *error)
{
    fram_status status = FRAM_OK;
    for (int32_t i = 0; i < c->loads.directions && status == FRAM_OK; i++) {
        status = balance_goes_on(ctx, c, i, -1, error);
        if (status == FRAM_OK)
            find_intact(h, c, i);
        if (status == FRAM_OK)
            status = find_damaged(ctx, w, h, c, i, error);
    }
    return status;
}

/* ---- all of it ---- */

static fram_status allocate(context *ctx, capability *c, fram_error *error)
{
    size_t directions = (size_t)c->loads.directions, cells = directions * (size_t)c->loads.speeds;
    size_t rows = (size_t)c->loads.rows;
    c->loads.wind = memory_array(ctx, rows, sizeof(vec3));
    c->loads.damping = memory_array(ctx, rows, sizeof(vec3));
    c->loads.drag = memory_array(ctx, rows, sizeof(vec3));
    c->loads.ice = memory_array(ctx, rows * (size_t)c->loads.speeds, sizeof(vec3));
    c->intact = memory_array(ctx, directions, sizeof *c->intact);
    c->damaged = memory_array(ctx, directions, sizeof *c->damaged);
    c->use = memory_array(ctx, cells, sizeof *c->use);
    bool good = c->loads.wind && c->loads.damping && c->loads.drag && c->loads.ice && c->intact && c->damaged && c->use;
    return good ? FRAM_OK : error_memory(error);
}

void capability_free(context *ctx, capability *c)
{
    memory_free(ctx, c->loads.wind);
    memory_free(ctx, c->loads.damping);
    memory_free(ctx, c->loads.drag);
    memory_free(ctx, c->loads.ice);
    memory_free(ctx, c->intact);
    memory_free(ctx, c->damaged);
    memory_free(ctx, c->use);
    *c = (capability){0};
}

/* What loads are multiplied and breaking loads divided by. */
static fram_status check_factors(const capability_options *o, fram_error *error)
{
    const struct {
        const char *key;
        double value;
    } factor[] = {
        {"allowance", o->allowance}, {"line_safety", o->line_safety}, {"line_safety_damaged", o->line_safety_damaged}};
    for (size_t i = 0; i < sizeof factor / sizeof *factor; i++)
        if (!(factor[i].value >= 1 && factor[i].value < 100))
            return error_set(error, FRAM_ERROR_USAGE, NULL, 0, factor[i].key,
                             "expected a factor from 1 to 100, found %g", factor[i].value);
    return FRAM_OK;
}

static fram_status check(const scenario *s, const capability_options *o, fram_error *error)
{
    const scenario_vessel *v = &s->vessel;
    if (!v->present || v->mode != VESSEL_FREE || (v->thrusters.count == 0 && v->mooring.lines.count == 0)) {
        const vessel_entry entry = scenario_vessel_entry(s, 0);
        return vessel_fault(
            s, &entry, "", error,
            "expected a vessel of mode free with thrusters or mooring lines, found none to find the capability of");
    }
    double speeds = o->speed_step > 0 ? o->speed_most / o->speed_step : 0;
    if (o->directions < 4 || o->directions > CAPABILITY_DIRECTIONS)
        return error_set(error, FRAM_ERROR_USAGE, NULL, 0, "directions", "expected 4 to %d, found %d",
                         (int)CAPABILITY_DIRECTIONS, (int)o->directions);
    if (!(o->speed_step > 0 && speeds >= 0.999 && speeds < CAPABILITY_SPEEDS + 0.5 &&
          fabs(speeds - floor(speeds + 0.5)) < 1e-6 * speeds))
        return error_set(
            error, FRAM_ERROR_USAGE, NULL, 0, "speed_step",
            "expected a positive step that divides the largest speed into 1 to %d speeds, found %g and %g m/s",
            (int)CAPABILITY_SPEEDS, o->speed_step, o->speed_most);
    fram_status status = check_factors(o, error);
    if (status != FRAM_OK)
        return status;
    if (!(o->measure >= s->run.time_step && o->measure <= 1e6))
        return error_set(error, FRAM_ERROR_USAGE, NULL, 0, "measure", "expected a time step to 1e6 seconds, found %g",
                         o->measure);
    if (o->met && o->formula)
        return error_set(error, FRAM_ERROR_USAGE, NULL, 0, "formula",
                         "expected the formula or ice from runs: the formula knows no sizes of floes");
    if (s->environment.wind_file[0])
        return scenario_fault(
            s, error, "environment.wind_file",
            "expected none, since the wind of a capability plot does not change: leave the file out (an empty "
            "environment.wind_file) and give environment.wind_speed");
    return FRAM_OK;
}

/* The vessel where it shall be: not moved to the equilibrium of today's current, and without ice. */
static fram_status build_still_world(context *ctx, const scenario *s, const model *m, world *w, fram_error *error)
{
    scenario still = *s;
    still.vessel.speed = 0;
    still.vessel.mooring.equilibrium = false;
    still.ice.source = ICE_NONE;
    still.domain.boundary = DOMAIN_OPEN;
    field_report report;
    return build_world(ctx, &still, m, w, &report, error);
}

static fram_status sweep(context *ctx, const scenario *s, world *w, capability *c, fram_error *error)
{
    int32_t body = w->vessels.body[VESSEL];
    const station_table *station = &w->stations;
    holding_case h = {.thrusters = &w->thrusters,
                      .lines = &w->lines,
                      .vessel = VESSEL,
                      .length = w->vessels.length[VESSEL],
                      .position = w->bodies.position[body],
                      .heading = quat_roll_pitch_yaw(w->bodies.orientation[body]).z,
                      .watched = station->watched[VESSEL],
                      .heading_alone = s->vessel.positioning.control == CONTROL_HEADING,
                      .heading_given = s->vessel.mooring.turret,
                      .line_safety = c->options.line_safety,
                      .offset_limit = station->offset_limit[VESSEL],
                      .heading_limit = station->heading_limit[VESSEL]};
    leave_out_failed(w);
    list_failures(w, c);
    return find_limits(ctx, w, &h, c, error);
}

/* Floes that are drawn have water between them, and their areas add up to what is asked for to half a floe. */
static const double DENSEST = 0.999, HALF_A_FLOE = 0.51;

static fram_status limit_concentration(context *ctx, scenario *met, fram_error *error)
{
    double floe, asked = met->ice.concentration;
    fram_status status = feeding_floe_area(ctx, met, &floe, error);
    if (status != FRAM_OK)
        return status;
    const scenario tile = feeding_scenario(met, floe);
    const scenario_domain *d = &tile.domain;
    double area = (d->x_max - d->x_min) * (d->y_max - d->y_min);
    met->ice.concentration = fmin(asked, fmin(DENSEST, 1 - HALF_A_FLOE * floe / area));
    if (met->ice.concentration < asked)
        log_write(ctx, LOG_WARNING,
                  "the ice that came covers %.4g of the water, and fields of floes have some between them: loads are "
                  "measured in one of %.4g",
                  asked, met->ice.concentration);
    return FRAM_OK;
}

/* The domain is the window's, not the scenario's, and so is what to do. */
static void blame_window(fram_error *error)
{
    static const char *const remedies[] = {": give such a band", "; make the domain larger", ": make it larger"};
    if (strcmp(error->key, "domain") != 0 && strcmp(error->key, "domain.band") != 0 &&
        strncmp(error->key, "domain.tile", 11) != 0)
        return;
    snprintf(error->key, sizeof error->key, "window");
    error->file[0] = '\0';
    error->line = error->column = 0;
    for (size_t i = 0; i < sizeof remedies / sizeof *remedies; i++) {
        char *at = strstr(error->message, remedies[i]);
        if (at)
            snprintf(at, sizeof error->message - (size_t)(at - error->message), ": take a larger window");
    }
}

static fram_status measure_met(context *ctx, const scenario *s, const world *w, capability *c, fram_error *error)
{
    const size_law sizes = managed_size_law(&c->options.met->law);
    scenario_population population;
    scenario met;
    c->side = automatic_or(c->options.met->side, CAPABILITY_LENGTHS * w->vessels.length[VESSEL]);
    fram_status status = capability_met_scenario(s, c->options.met, c->side, &population, &sizes, &met, error);
    if (status != FRAM_OK)
        return status;
    status = limit_concentration(ctx, &met, error);
    if (status == FRAM_OK)
        status = capability_ice_measured(ctx, &met, c, error);
    if (status == FRAM_ERROR_INPUT && error)
        blame_window(error);
    return status;
}

static fram_status find_ice_loads(context *ctx, const scenario *s, const world *w, capability *c, fram_error *error)
{
    if (c->options.met)
        return measure_met(ctx, s, w, c, error);
    if (s->ice.source == ICE_NONE)
        return FRAM_OK;
    return c->options.formula ? capability_ice_formula(ctx, s, w, c, error) : capability_ice_measured(ctx, s, c, error);
}

static fram_status find_with_model(context *ctx, const scenario *s, const model *m, capability *c, fram_error *error)
{
    world w;
    fram_status status = build_still_world(ctx, s, m, &w, error);
    if (status != FRAM_OK)
        return status;
    status = allocate(ctx, c, error);
    if (status == FRAM_OK) {
        status = find_media_loads(ctx, m, &w, c, error);
        if (status == FRAM_OK)
            status = find_ice_loads(ctx, s, &w, c, error);
    }
    if (status == FRAM_OK)
        status = sweep(ctx, s, &w, c, error);
    if (status == FRAM_OK) {
        capability_tell_growth(ctx, c);
        capability_tell_turns(ctx, c);
    }
    world_free(ctx, &w);
    if (status != FRAM_OK)
        capability_free(ctx, c);
    return status;
}

/* The vessel that is asked for. */
static fram_status choose_vessel(const scenario *s, const char *name, int32_t *row, fram_error *error)
{
    *row = 0;
    if (name)
        return scenario_choose_vessel(s, NULL, name, row, error);
    if (scenario_vessel_count(s) > 1)
        return error_set(error, FRAM_ERROR_USAGE, NULL, 0, "vessel",
                         "the scenario has %d vessels: name the one whose capability is asked for",
                         (int)scenario_vessel_count(s));
    return FRAM_OK;
}

/* Of the scenario's single vessel. */
static fram_status find_alone(context *ctx, const scenario *s, const capability_options *o, capability *c,
                              fram_error *error)
{
    fram_status status = check(s, o, error);
    if (status != FRAM_OK)
        return status;
    capability_tell_scenario(ctx, s, o);
    c->loads.directions = o->directions;
    int32_t least = s->vessel.hull.form == HULL_MESH ? LOAD_ROWS_OF_FILE : LOAD_ROWS;
    c->loads.rows = (least + o->directions - 1) / o->directions * o->directions;
    c->loads.speeds = (int32_t)floor(o->speed_most / o->speed_step + 0.5);
    c->loads.speed_step = o->speed_step;
    model m;
    status = build_model(ctx, s, &m, error);
    if (status != FRAM_OK)
        return status;
    status = find_with_model(ctx, s, &m, c, error);
    model_free(ctx, &m);
    return status;
}

fram_status capability_find(context *ctx, const scenario *s, const capability_options *o, capability *c,
                            fram_error *error)
{
    int32_t row;
    *c = (capability){.options = *o, .wind_speed = s->environment.wind_speed};
    fram_status status = choose_vessel(s, o->vessel, &row, error);
    if (status != FRAM_OK)
        return status;
    const scenario alone = scenario_of_vessel(s, row);
    return find_alone(ctx, &alone, o, c, error);
}
