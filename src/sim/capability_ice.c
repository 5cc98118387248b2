/* The ice load of a capability plot: Zuev's formula on the breadth that faces the drift, or short runs of the
   scenario's own field past the hull held fast. */
#include "sim/capability.h"

#include "base/channel_statistics.h"
#include "base/load_unit.h"
#include "base/number_text.h"
#include "base/transcendental.h"
#include "io/csv_read.h"
#include "sim/build.h"
#include "sim/build_ice.h"
#include "sim/capability_growth.h"
#include "sim/capability_mirror.h"
#include "sim/ice_loads.h"
#include "sim/step.h"

#include <stdio.h>
#include <string.h>

/* ---- by formula ---- */

/* Breadth across the drift, and how far to the left of the centre of mass its middle lies, seen along the drift. */
static double breadth_across(const vec2_array *waterline, vec3 centre, vec2 along, double *middle)
{
    double lo = HUGE_VAL, hi = -HUGE_VAL;
    for (int32_t i = 0; i < waterline->count; i++) {
        vec2 r = {waterline->data[i].x - centre.x, waterline->data[i].y - centre.y};
        double across = along.x * r.y - along.y * r.x;
        lo = fmin(lo, across);
        hi = fmax(hi, across);
    }
    *middle = 0.5 * (lo + hi);
    return hi - lo;
}

/* The formula knows one thickness and one concentration, those of the scenario. */
static fram_status check_formula(const scenario *s, fram_error *error)
{
    const char *key = NULL, *rule = NULL;
    if (s->ice.source != ICE_VORONOI && s->ice.source != ICE_PACKED)
        key = "ice.source",
        rule = "expected voronoi or packed, broken ice of a concentration that the formula can take";
    else if (s->ice.populations.count > 0)
        key = "ice.populations", rule = "expected none, since the formula knows one thickness only (ice.thickness)";
    if (!key)
        return FRAM_OK;
    return scenario_fault(s, error, key, "%s; without the formula the load is measured", rule);
}

fram_status capability_ice_formula(context *ctx, const scenario *s, const world *w, capability *c, fram_error *error)
{
    fram_status status = check_formula(s, error);
    if (status != FRAM_OK)
        return status;
    c->thickness = s->ice.thickness;
    c->concentration = s->ice.concentration;
    int32_t body = w->vessels.body[0];
    vec2_array waterline = {0};
    status = build_footprint(ctx, w, body, true, &waterline, error);
    double heading = quat_roll_pitch_yaw(w->bodies.orientation[body]).z;
    capability_loads *l = &c->loads;
    for (int32_t i = 0; i < l->rows && status == FRAM_OK; i++) {
        double from = 2 * PI * i / l->rows, middle;
        vec3 drift = plane_to_global(heading, vec3_make(-real_cos(from), real_sin(from), 0));
        vec2 along = {drift.x, drift.y};
        double breadth = breadth_across(&waterline, w->bodies.position[body], along, &middle);
        for (int32_t k = 0; k < l->speeds; k++) {
            double force = broken_ice_resistance(s->ice.density, s->environment.gravity, breadth, s->ice.thickness,
                                                 s->ice.concentration, (k + 1) * l->speed_step);
            /* A push along the drift through a point to its left turns the ship clockwise. */
            vec3 push = vec3_make(force * along.x, force * along.y, -force * middle);
            l->ice[i * l->speeds + k] = plane_to_vessel(heading, push);
        }
    }
    array_free(ctx, &waterline);
    return status;
}

/* ---- by runs ---- */

/* Ice goes past for a third of each run before it counts. */
#define UNCOUNTED (1.0 / 3)
/* A sheet may take so many times as long before it comes. */
enum { MOST_WAIT = 20 };

typedef struct load_history {
    double_array time, force[3]; /* averaged over the window, ship's frame */
} load_history;

static void history_free(context *ctx, load_history *h)
{
    array_free(ctx, &h->time);
    for (int i = 0; i < 3; i++)
        array_free(ctx, &h->force[i]);
}

/* The scenario with its hull held fast and its field driven in one direction; what it points to is only read.  A hull
   that is held neither drives itself, which would have it back and ram as one that is beset, nor washes ice away: what
   its propellers do is on the other side of the balance. */
static scenario driven(const scenario *s, double from, double speed)
{
    scenario d = *s;
    double towards = s->vessel.heading_deg + 180 - degrees(from);
    towards -= 360 * floor(towards / 360);
    d.vessel.mode = VESSEL_PRESCRIBED;
    d.vessel.speed = 0;
    d.vessel.propulsion.bollard_pull = (double)NAN;
    d.vessel.wash.active = false;
    d.domain.drift_speed = speed;
    d.domain.drift_direction_deg = towards;
    d.domain.drift_file[0] = '\0';
    d.environment.current_speed = speed;
    d.environment.current_direction_deg = towards;
    d.environment.current_file[0] = '\0';
    d.environment.current_profile_file[0] = '\0'; /* of one direction, as the balance has none */
    d.environment.wind_speed = 0;
    d.environment.wind_file[0] = '\0';
    return d;
}

/* What ice the load is of, as the first run has made it. */
static void describe_ice(const world *w, const field_report *report, capability *c)
{
    double area = 0, volume = 0;
    for (int32_t i = 0; i < w->floes.count; i++) {
        area += w->floes.area[i];
        volume += w->floes.area[i] * w->floes.thickness[i];
    }
    c->thickness = area > 0 ? volume / area : 0;
    c->concentration = report->concentration;
}

/* A sheet has come to the hull; what counts of other fields counts from the start, open water included. */
static bool has_come(const scenario *s, const world *w)
{
    vec3 force = w->scratch.ice_loads.data[0].total.force;
    return s->ice.source != ICE_LEVEL || vec3_dot(force, force) > 0;
}

static fram_status refuse_wait(const scenario *s, double time, fram_error *error)
{
    return scenario_fault(
        s, error, "ice.level.openings",
        "no ice came to the hull in %g s, so that there is no load to measure: take openings away or make them "
        "smaller, or measure longer",
        time);
}

static fram_status record(context *ctx, const scenario *s, const model *m, capability *c, load_history *h,
                          fram_error *error)
{
    world w;
    field_report report;
    fram_status status = build_world(ctx, s, m, &w, &report, error);
    if (status != FRAM_OK)
        return status;
    if (!(c->thickness > 0))
        describe_ice(&w, &report, c);
    double heading = radians(s->vessel.heading_deg);
    int64_t steps = (int64_t)ceil(c->options.measure / s->run.time_step), waited = 0;
    bool met = false;
    for (int64_t i = 0; i < steps && status == FRAM_OK;) {
        status = capability_go_on(c, error);
        if (status == FRAM_OK)
            status = work_continue(ctx, "measuring ice loads", c->loads.runs_done + (double)i / (double)steps,
                                   c->loads.runs, error);
        if (status != FRAM_OK)
            break;
        status = world_step(ctx, m, &w, error);
        met = met || status != FRAM_OK || has_come(s, &w);
        if (!met && ++waited > MOST_WAIT * steps)
            status = refuse_wait(s, w.clock.time[0], error);
        if (!met)
            continue;
        i++;
        wrench mean = load_window_average(&w, 0);
        vec3 load = plane_to_vessel(heading, vec3_make(mean.force.x, mean.force.y, mean.moment.z));
        double time = w.clock.time[0] - (double)waited * s->run.time_step;
        bool good = array_push(ctx, &h->time, time) && array_push(ctx, &h->force[0], load.x) &&
                    array_push(ctx, &h->force[1], load.y) && array_push(ctx, &h->force[2], load.z);
        if (status == FRAM_OK && !good)
            status = error_memory(error);
    }
    world_free(ctx, &w);
    return status;
}

/* The mean load, made so much larger as the significant value of its component along itself is over its mean. */
static vec3 significant_load(const load_history *h, double after)
{
    int32_t count = h->time.count;
    vec3 mean = {channel_statistics_of(h->time.data, h->force[0].data, count, after).mean,
                 channel_statistics_of(h->time.data, h->force[1].data, count, after).mean,
                 channel_statistics_of(h->time.data, h->force[2].data, count, after).mean};
    double size = sqrt(mean.x * mean.x + mean.y * mean.y);
    if (!(size > 0))
        return mean;
    double *along = h->force[0].data;
    for (int32_t i = 0; i < count; i++)
        along[i] = (along[i] * mean.x + h->force[1].data[i] * mean.y) / size;
    double significant = channel_statistics_of(h->time.data, along, count, after).significant_above;
    return vec3_scale(mean, fmax(significant, size) / size);
}

/* Which of the runs failed, before why. */
static void name_run(double from, double speed, fram_error *error)
{
    char why[sizeof error->message];
    memcpy(why, error->message, sizeof why);
    int n = snprintf(error->message, sizeof error->message, "ice from %.0f deg at %g m/s: ", degrees(from), speed);
    snprintf(error->message + n, sizeof error->message - (size_t)n, "%s", why);
}

static fram_status measure(context *ctx, const scenario *s, double from, double speed, capability *c, vec3 *load,
                           load_halves *half, fram_error *error)
{
    const scenario d = driven(s, from, speed);
    load_history h = {0};
    model m;
    fram_status status = capability_go_on(c, error);
    if (status == FRAM_OK)
        status = build_model(ctx, &d, &m, error);
    if (status == FRAM_OK) {
        status = record(ctx, &d, &m, c, &h, error);
        model_free(ctx, &m);
    }
    if (status == FRAM_OK) {
        /* first: what follows turns the history */
        *half = load_halves_find(h.time.data, h.force[0].data, h.force[1].data, h.time.count,
                                 UNCOUNTED * c->options.measure);
        *load = significant_load(&h, UNCOUNTED * c->options.measure);
    } else if (status != FRAM_INTERRUPTED && error)
        name_run(from, speed, error);
    history_free(ctx, &h);
    return status;
}

/* Loads are measured at this many speeds at most, evenly over those that are asked for, and are linear between them, as
   they are between directions. */
enum { MEASURED_SPEEDS = 4 };

typedef struct measured_loads {
    bool mirrored; /* loads from port are those from starboard */
    int32_t directions, speeds;
    double speed_step;
    vec3 load[CAPABILITY_MEASURED * MEASURED_SPEEDS]; /* [direction * speeds + k] at the speed (k + 1) speed_step */
    load_halves half[CAPABILITY_MEASURED * MEASURED_SPEEDS]; /* 0 where a load is another's mirrored */
} measured_loads;

static vec3 mirrored_load(vec3 load) { return vec3_make(load.x, -load.y, -load.z); }

static fram_status measure_all(context *ctx, const scenario *s, capability *c, measured_loads *m, fram_error *error)
{
    /* In a scene with equal sides a vessel meets from port what it meets from starboard, seen from the middle. */
    const char *one_sided = capability_one_sided(s);
    const bool mirrored = m->mirrored = !one_sided;
    if (one_sided)
        log_write(ctx, LOG_INFO,
                  "ice is measured from all %d directions, and not from half of them: the %s is not known to be the "
                  "same to port and to starboard",
                  (int)m->directions, one_sided);
    c->loads.runs_done = 0;
    c->loads.runs = (mirrored ? m->directions / 2 + 1 : m->directions) * m->speeds;
    for (int32_t i = 0; i < m->directions; i++) {
        double from = 2 * PI * i / m->directions;
        for (int32_t k = 0; k < m->speeds; k++) {
            vec3 *load = &m->load[i * m->speeds + k];
            double speed = (k + 1) * m->speed_step;
            if (mirrored && 2 * i > m->directions) {
                *load = mirrored_load(m->load[(m->directions - i) * m->speeds + k]);
                continue;
            }
            fram_status status = measure(ctx, s, from, speed, c, load, &m->half[i * m->speeds + k], error);
            if (status != FRAM_OK)
                return status;
            c->loads.runs_done++;
            log_write(ctx, LOG_INFO, "ice from %3.0f deg at %.2f m/s: surge %s, sway %s, yaw %s MN m", degrees(from),
                      speed, load_text_of(load->x, 4).text, load_text_of(load->y, 4).text,
                      plain_text_of(load->z * 1e-6, 4).text);
        }
    }
    return FRAM_OK;
}

/* Loads from port are those from starboard between measured directions too: the sway of a run from ahead or astern is
   chance, and might as well have gone to the other side. */
static vec3 load_in_row(const measured_loads *m, const capability_loads *l, int32_t i, int32_t k)
{
    if (m->mirrored && 2 * i > l->rows)
        return mirrored_load(load_in_row(m, l, l->rows - i, k));
    return capability_ice_between(m->load, m->directions, m->speeds, m->speed_step, 2 * PI * i / l->rows,
                                  (k + 1) * l->speed_step);
}

fram_status capability_ice_measured(context *ctx, const scenario *s, capability *c, fram_error *error)
{
    if (s->domain.boundary != DOMAIN_FEEDING)
        return scenario_fault(
            s, error, "domain.boundary",
            "expected feeding, so that ice can be driven past the hull and its load measured; otherwise the load "
            "can be had by the formula");
    capability_loads *l = &c->loads;
    measured_loads m = {.directions = l->directions < CAPABILITY_MEASURED ? l->directions : CAPABILITY_MEASURED,
                        .speeds = l->speeds < MEASURED_SPEEDS ? l->speeds : MEASURED_SPEEDS};
    m.speed_step = l->speed_step * l->speeds / m.speeds;
    l->measured = m.directions;
    fram_status status = measure_all(ctx, s, c, &m, error);
    load_growth_find(m.half, m.directions, m.speeds, m.speed_step, l);
    for (int32_t i = 0; i < l->rows && status == FRAM_OK; i++)
        for (int32_t k = 0; k < l->speeds; k++)
            l->ice[i * l->speeds + k] = load_in_row(&m, l, i, k);
    return status;
}
