/* Reads a run for the results of ice management: first the ways of ice and vessels, then the ice in its windows. */
#include "results/manage_parts.h"

#include "bodies/body.h"
#include "model/scenario_vessel.h"
#include "results/replay_moment.h"

#include <string.h>

/* Slower than this in full size, ice comes from nowhere [m/s]. */
static const double STILL = 0.01;
/* Over which a vessel's own way is taken in full size [s], so that it does not swing with surge and sway. */
static const double WAY_TIME = 60;

/* ---- which vessel ---- */

/* The unit alone is mostly written without a name. */
static bool has_no_name(const scenario *s)
{
    return scenario_vessel_count(s) == 1 && !*scenario_vessel_entry(s, 0).keys->name;
}

static fram_status choose_vessel(manage_run *m, const manage_options *options, fram_error *error)
{
    const scenario *s = &m->d.s;
    const char *name = options->compared && has_no_name(s) ? NULL : options->vessel;
    if (options->compared && scenario_vessel_count(s) == 0)
        return error_set(error, FRAM_ERROR_INPUT, m->d.folder, 0, "beside",
                         "expected a run with the vessel that is protected, found one without any vessel");
    if (options->compared && name && scenario_find_vessel(s, name) < 0)
        return error_set(error, FRAM_ERROR_INPUT, m->d.folder, 0, "beside",
                         "expected a run with the vessel that is protected, \"%.60s\", found one without it", name);
    fram_status status = scenario_choose_vessel(s, m->d.folder, name, &m->vessel, error);
    if (name || status != FRAM_OK)
        return status;
    int32_t count = scenario_vessel_count(s), candidates = 0;
    for (int32_t v = count - 1; v >= 0; v--) {
        if (count > 1 && vessel_drives_itself(scenario_vessel_entry(s, v).keys))
            continue;
        candidates++;
        m->vessel = v;
    }
    if (candidates == 1)
        return FRAM_OK;
    return error_set(error, FRAM_ERROR_INPUT, m->d.folder, 0, options->compared ? "beside" : "vessel",
                     "%s: name the one that is protected (the first is \"%s\")",
                     candidates == 0 ? "all vessels drive themselves" : "several vessels do not drive themselves",
                     scenario_vessel_entry(s, 0).keys->name);
}

/* ---- first reading: ways ---- */

static const replay_pose *pose_of(const replay *r, int32_t body)
{
    for (int32_t i = 0; i < r->frame.poses.count; i++) {
        if (r->frame.poses.data[i].body == body)
            return &r->frame.poses.data[i];
    }
    return NULL;
}

/* Of the hull along a direction, from its centre of mass [m]. */
static void extents(const replay *r, const replay_pose *pose, vec2 along, double *lo, double *hi)
{
    const replay_body *b = &r->bodies.data[pose->body];
    mat3 turn = quat_matrix(pose->orientation);
    *lo = HUGE_VAL;
    *hi = -HUGE_VAL;
    for (int32_t i = 0; i < b->vertex_count; i++) {
        vec3 p = mat3_mul_vec(turn, r->points.data[b->vertex_first + i]);
        double x = vec2_dot(along, vec2_make(p.x, p.y));
        *lo = fmin(*lo, x);
        *hi = fmax(*hi, x);
    }
}

/* A channel at a time, between rows by a straight line; 0 where the run does not have it. */
static double channel_at(const run_data *d, const double *v, double time)
{
    const double *t = run_channel(d, "time");
    int32_t n = d->series.rows, i = 0, end = n;
    if (!t || !v || n == 0)
        return 0;
    /* The last row that is earlier: i, or the first one. */
    while (end - i > 1) {
        int32_t middle = i + (end - i) / 2;
        if (t[middle] < time)
            i = middle;
        else
            end = middle;
    }
    if (i + 1 >= n || time <= t[i])
        return v[i];
    return v[i] + (v[i + 1] - v[i]) * (time - t[i]) / (t[i + 1] - t[i]);
}

/* Of an endless field that which it is given, else the mean of all floes by area. */
static vec2 ice_velocity(const manage_run *m, const replay *r)
{
    vec2 sum = {0, 0};
    double area = 0;
    if (m->d.s.domain.boundary == DOMAIN_FEEDING)
        return vec2_make(channel_at(&m->d, run_channel(&m->d, "drift_x"), r->frame.time),
                         channel_at(&m->d, run_channel(&m->d, "drift_y"), r->frame.time));
    for (int32_t i = 0; i < r->frame.poses.count; i++) {
        const replay_pose *p = &r->frame.poses.data[i];
        const replay_body *b = &r->bodies.data[p->body];
        if (b->material != MATERIAL_ICE)
            continue;
        area += b->area;
        sum = vec2_add(sum, vec2_scale(vec2_make(p->velocity.x, p->velocity.y), b->area));
    }
    return area > 0 ? vec2_scale(sum, 1 / area) : sum;
}

/* Of the protected vessel [m]; a hull from a file has its own, whatever the keys say. */
static double beam_of(const manage_run *m, const replay *r)
{
    const scenario_hull *hull = &scenario_vessel_entry(&m->d.s, m->vessel).keys->hull;
    return hull->form == HULL_MESH ? replay_hull_size(r, m->vessel).y : hull->beam;
}

static bool is_positioned(const scenario_vessel *v)
{
    return v->positioning.active && v->positioning.waypoints.count == 0;
}

/* Who does that manages no ice, however near the ice passes. */
static bool keeps_station(const scenario_vessel *v)
{
    return v->mode == VESSEL_FREE && (v->mooring.lines.count > 0 || is_positioned(v));
}

static bool is_helper(const manage_run *m, int32_t v)
{
    return v != m->vessel && !keeps_station(scenario_vessel_entry(&m->d.s, v).keys);
}

/* Places and velocities; what follows from those of other moments comes later. */
static fram_status add_moment(manage_run *m, const replay *r, fram_error *error)
{
    manage_moment now = {.time = r->frame.time, .velocity = ice_velocity(m, r)};
    const replay_pose *own = pose_of(r, replay_hull(r, m->vessel));
    if (!own)
        return FRAM_OK;
    now.place = vec2_make(own->position.x, own->position.y);
    if (is_automatic(m->limit))
        m->limit = beam_of(m, r);
    for (int32_t v = 0, k = 0; k < m->helpers; v++) {
        if (!is_helper(m, v))
            continue;
        const replay_pose *p = pose_of(r, replay_hull(r, v));
        double lo = 0, hi = 0;
        now.helper[k] = p ? vec2_make(p->position.x, p->position.y) : vec2_make(1e12, 1e12);
        if (p && !(m->helper_reach[k] > 0)) {
            vec3 bow = mat3_mul_vec(quat_matrix(p->orientation), vec3_make(1, 0, 0));
            extents(r, p, vec2_make(bow.x, bow.y), &lo, &hi);
            m->helper_reach[k] = 0.5 * (hi - lo);
        }
        k++;
    }
    if (m->moments.count > 0) {
        const manage_moment *last = &m->moments.data[m->moments.count - 1];
        now.ice =
            vec2_add(last->ice, vec2_scale(vec2_add(last->velocity, now.velocity), 0.5 * (now.time - last->time)));
    }
    return array_push(m->ctx, &m->moments, now) ? FRAM_OK : error_memory(error);
}

/* Whether the protected vessel is held at a time: by positioning that leads it nowhere, or lines that are left. */
static bool is_held(const manage_run *m, double time)
{
    const scenario_vessel *v = scenario_vessel_entry(&m->d.s, m->vessel).keys;
    if (!keeps_station(v) || is_positioned(v))
        return keeps_station(v);
    return channel_at(&m->d, run_vessel_channel(&m->d, m->vessel, "lines_parted"), time) < manage_line_count(v);
}

/* Mean velocity of the vessel about a moment. */
static vec2 steady_velocity(const manage_run *m, int32_t i)
{
    int32_t a = i, b = i;
    const manage_moment *all = m->moments.data;
    double half = 0.5 * WAY_TIME * sqrt(scenario_size(&m->d.s));
    while (a > 0 && all[i].time - all[a - 1].time <= half)
        a--;
    while (b + 1 < m->moments.count && all[b + 1].time - all[i].time <= half)
        b++;
    double time = all[b].time - all[a].time;
    return time > 0 ? vec2_scale(vec2_sub(all[b].place, all[a].place), 1 / time) : vec2_make(0, 0);
}

/* Whether ice that comes so fast comes at all. */
static bool drifts(const manage_run *m, double speed) { return speed > STILL * sqrt(scenario_size(&m->d.s)); }

static void find_updrift(manage_run *m)
{
    for (int32_t i = 0; i < m->moments.count; i++) {
        manage_moment *now = &m->moments.data[i];
        vec2 come = is_held(m, now->time) ? now->velocity : vec2_sub(now->velocity, steady_velocity(m, i));
        now->speed = vec2_length(come);
        if (drifts(m, now->speed))
            now->updrift = vec2_scale(come, -1 / now->speed);
    }
}

static fram_status read_ways(manage_run *m, fram_error *error)
{
    replay r;
    bool found = true;
    fram_status status = replay_open(m->ctx, m->d.folder, &r, error);
    if (status != FRAM_OK)
        return status;
    while (status == FRAM_OK && found) {
        status = replay_next(&r, &found, error);
        if (status == FRAM_OK && found)
            status = add_moment(m, &r, error);
    }
    replay_close(&r);
    find_updrift(m);
    return status;
}

/* ---- windows ---- */

static double depth_of(const manage_run *m, const manage_moment *at)
{
    return is_automatic(m->depth) ? at->width : m->depth;
}

/* The middle of what lies before the whole breadth of the hull, so deep. */
static vec2 middle_before(const manage_moment *at, double depth)
{
    vec2 centre = vec2_add(at->place, vec2_scale(vec2_perp(at->updrift), at->middle));
    return vec2_add(centre, vec2_scale(at->updrift, at->reach + 0.5 * depth));
}

/* The window that is at the vessel at moment k, where its ice was at moment i. */
static manage_window window_at(const manage_run *m, int32_t k, int32_t i)
{
    const manage_moment *at = &m->moments.data[k];
    double depth = depth_of(m, at);
    vec2 back = vec2_sub(at->ice, m->moments.data[i].ice);
    return (manage_window){vec2_sub(middle_before(at, depth), back), at->updrift, depth, at->width};
}

static bool in_domain(const manage_run *m, const manage_window *w)
{
    const scenario_domain *d = &m->d.s.domain;
    double half = 0.5 * sqrt(w->length * w->length + w->width * w->width);
    return w->centre.x - half >= d->x_min && w->centre.x + half <= d->x_max && w->centre.y - half >= d->y_min &&
           w->centre.y + half <= d->y_max;
}

static bool is_worked_on(const manage_run *m, const manage_window *w, int32_t i)
{
    double half = 0.5 * sqrt(w->length * w->length + w->width * w->width);
    for (int32_t h = 0; h < m->helpers; h++) {
        vec2 off = vec2_sub(m->moments.data[i].helper[h], w->centre);
        if (vec2_length(off) < half + m->helper_reach[h])
            return true;
    }
    return false;
}

/* When the window that arrives at moment k was upstream, and behind the icebreakers. */
static void schedule(manage_run *m, int32_t k)
{
    manage_moment *at = &m->moments.data[k];
    int32_t first = -1, last = -1, seen = k;
    for (int p = 0; p < MANAGE_PLACES; p++)
        at->looked[p] = -1;
    if (!drifts(m, at->speed) || !(at->width > 0))
        return;
    at->looked[MANAGE_AT] = k;
    for (int32_t i = k; i >= 0; i--) {
        manage_window w = window_at(m, k, i);
        if (!in_domain(m, &w))
            break;
        seen = i;
        if (!is_worked_on(m, &w, i))
            continue;
        first = i;
        last = last < 0 ? i : last;
    }
    int32_t before = first >= 0 ? first - 1 : seen;
    if (before >= seen && before < k)
        at->looked[MANAGE_UPSTREAM] = before;
    if (last >= 0 && last < k)
        at->looked[MANAGE_BEHIND] = last + 1;
}

/* ---- second reading: ice ---- */

typedef struct ice_now {
    replay_moment plan;
    ARRAY(manage_floe) floes;
} ice_now;

static fram_status list_floes(manage_run *m, replay *r, ice_now *ice, fram_error *error)
{
    fram_status status = replay_moment_now(r, &ice->plan, error);
    array_clear(&ice->floes);
    for (int32_t i = 0; i < ice->plan.poses.count && status == FRAM_OK; i++) {
        const replay_body *b = &r->bodies.data[ice->plan.poses.data[i].body];
        polygon ring = polygon_list_get(&ice->plan.outlines, i);
        if (b->material == MATERIAL_ICE &&
            !array_push(m->ctx, &ice->floes,
                        ((manage_floe){ring, polygon_bounds(ring), b->area, b->level, b->thickness})))
            status = error_memory(error);
    }
    return status;
}

/* Which windows are looked at in the ice of each moment, one after the other: MANAGE_PLACES k + p is that of moment k
   at place p; -1: no more. */
typedef struct look_list {
    int32_array first, next; /* of each moment; after each window */
} look_list;

static bool list_looks(const manage_run *m, look_list *looks)
{
    int32_t count = m->moments.count;
    if (!array_resize(m->ctx, &looks->first, count) || !array_resize(m->ctx, &looks->next, MANAGE_PLACES * count))
        return false;
    for (int32_t i = 0; i < count; i++)
        looks->first.data[i] = -1;
    for (int32_t w = MANAGE_PLACES * count - 1; w >= 0; w--) {
        int32_t i = m->moments.data[w / MANAGE_PLACES].looked[w % MANAGE_PLACES];
        if (i < 0)
            continue;
        looks->next.data[w] = looks->first.data[i];
        looks->first.data[i] = w;
    }
    return true;
}

/* Everything that is to be looked at in the ice of moment i. */
static fram_status look_at(manage_run *m, const look_list *looks, const ice_now *ice, int32_t i, fram_error *error)
{
    const scenario_domain *d = &m->d.s.domain;
    manage_moment *now = &m->moments.data[i];
    double x = d->x_max - d->x_min, y = d->y_max - d->y_min, far = sqrt(x * x + y * y);
    fram_status status = FRAM_OK;
    now->threat = (manage_threat){HUGE_VAL, HUGE_VAL, 0};
    if (now->looked[MANAGE_AT] >= 0) {
        manage_window strip = {middle_before(now, far), now->updrift, far, now->width};
        status = manage_threat_in(m->ctx, ice->floes.data, ice->floes.count, &strip, m->limit, &now->threat, error);
    }
    for (int32_t w = looks->first.data[i]; w >= 0 && status == FRAM_OK; w = looks->next.data[w]) {
        int32_t k = w / MANAGE_PLACES, place = w % MANAGE_PLACES;
        manage_moment *at = &m->moments.data[k];
        manage_window window = window_at(m, k, i);
        managed_cover *met = m->met.count > 0 && place == manage_came_from(at) ? &m->met.data[k] : NULL;
        status = manage_measure(m->ctx, ice->floes.data, ice->floes.count, &window, m->limit, m->unit,
                                &at->cover[place], met, error);
    }
    return status;
}

/* Sizes of the hull along and across the drift, then windows. */
static void plan_windows(manage_run *m, const replay *r, int32_t i)
{
    manage_moment *now = &m->moments.data[i];
    const replay_pose *own = pose_of(r, replay_hull(r, m->vessel));
    double lo, hi;
    if (!own || !drifts(m, now->speed))
        return;
    extents(r, own, now->updrift, &lo, &now->reach);
    extents(r, own, vec2_perp(now->updrift), &lo, &hi);
    now->width = hi - lo;
    now->middle = 0.5 * (lo + hi);
}

/* Goes through the record; looks: at the ice; NULL: at the hull. */
static fram_status read_frames(manage_run *m, const look_list *looks, fram_error *error)
{
    replay r;
    ice_now ice = {0};
    bool found = true;
    int32_t i = 0;
    fram_status status = replay_open(m->ctx, m->d.folder, &r, error);
    if (status != FRAM_OK)
        return status;
    while (status == FRAM_OK && i < m->moments.count) {
        status = replay_next(&r, &found, error);
        if (status != FRAM_OK || !found)
            break;
        if (!(r.frame.time >= m->moments.data[i].time))
            continue;
        if (!looks)
            plan_windows(m, &r, i);
        else if ((status = list_floes(m, &r, &ice, error)) == FRAM_OK)
            status = look_at(m, looks, &ice, i, error);
        i++;
    }
    replay_moment_free(m->ctx, &ice.plan);
    array_free(m->ctx, &ice.floes);
    replay_close(&r);
    return status;
}

/* ---- all ---- */

void manage_free(manage_run *m)
{
    array_free(m->ctx, &m->moments);
    array_free(m->ctx, &m->met);
    run_data_free(m->ctx, &m->d);
}

static fram_status read_all(manage_run *m, const manage_options *options, fram_error *error)
{
    fram_status status = choose_vessel(m, options, error);
    if (status != FRAM_OK)
        return status;
    for (int32_t v = 0; v < scenario_vessel_count(&m->d.s) && m->helpers < MANAGE_HELPERS; v++)
        m->helpers += is_helper(m, v);
    m->limit = options->limit;
    m->depth = options->depth;
    m->unit = options->unit > 0 ? options->unit : scenario_size(&m->d.s);
    status = read_ways(m, error);
    if (status == FRAM_OK && m->moments.count == 0)
        status = error_set(error, FRAM_ERROR_INPUT, m->d.folder, 0, NULL, "the record shows no vessel");
    if (status == FRAM_OK)
        status = read_frames(m, NULL, error);
    for (int32_t k = 0; k < m->moments.count && status == FRAM_OK; k++)
        schedule(m, k);
    look_list looks = {{0}, {0}};
    for (int32_t k = 0; k < m->moments.count && status == FRAM_OK && options->met; k++) {
        if (!array_push(m->ctx, &m->met, (managed_cover){.sized = 0}))
            status = error_memory(error);
    }
    if (status == FRAM_OK)
        status = list_looks(m, &looks) ? read_frames(m, &looks, error) : error_memory(error);
    array_free(m->ctx, &looks.first);
    array_free(m->ctx, &looks.next);
    return status;
}

fram_status manage_read(context *ctx, const char *folder, const manage_options *options, manage_run *m,
                        fram_error *error)
{
    *m = (manage_run){.ctx = ctx};
    fram_status status = run_data_read(ctx, folder, false, NULL, &m->d, error);
    if (status != FRAM_OK)
        return status;
    run_warn_change(ctx, &m->d);
    status = read_all(m, options, error);
    if (status != FRAM_OK)
        manage_free(m);
    return status;
}
