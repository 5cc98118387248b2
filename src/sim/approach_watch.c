#include "sim/approach_watch.h"

#include <stdio.h>

fram_status approach_watch_model(context *ctx, const scenario *s, const vessel_entry *entry, const model *m,
                                 vessel_model *out, fram_error *error)
{
    const scenario_approach *keys = &entry->keys->approach;
    const mesh *hull = &m->solids.data[out->solid].surface;
    vec2_array points = {0};
    out->approach = (approach_settings){automatic_or(keys->limit, HUGE_VAL), keys->look_ahead};
    snprintf(out->name, sizeof out->name, "%.*s", (int)VESSEL_NAME_MOST,
             scenario_names_vessels(s) ? entry->keys->name : "");
    bool good = array_resize(ctx, &points, hull->vertex.count);
    for (int32_t i = 0; i < points.count; i++)
        points.data[i] = vec2_make(hull->vertex.data[i].x, hull->vertex.data[i].y);
    good = good && polygon_convex_hull(ctx, (polygon){points.data, points.count}, &out->plan);
    array_free(ctx, &points);
    return good ? FRAM_OK : error_memory(error);
}

static bool watches(const model *m, int32_t vessel) { return isfinite(m->vessels.data[vessel].approach.limit); }

fram_status approach_watch_begin(context *ctx, const model *m, world *w, fram_error *error)
{
    for (int32_t v = 0; v < w->vessels.count; v++) {
        for (int32_t other = 0; other < w->vessels.count && watches(m, v); other++) {
            int32_t row = w->approaches.count;
            if (other == v)
                continue;
            if (!table_resize(ctx, &w->approaches, &approach_table_info, row + 1))
                return error_memory(error);
            w->approaches.vessel[row] = v;
            w->approaches.other[row] = other;
        }
    }
    return FRAM_OK;
}

/* Steps between looks. */
static int64_t interval_of(const model *m, int32_t vessel)
{
    double steps = m->vessels.data[vessel].approach.look_ahead / APPROACH_LOOKS / m->time_step;
    return steps < 1 ? 1 : (int64_t)steps;
}

bool approach_outline(context *ctx, const model *m, int32_t vessel, vec2 at, vec2 ahead, vec2_array *out)
{
    const vec2_array *own = &m->vessels.data[vessel].plan;
    if (!array_resize(ctx, out, own->count))
        return false;
    for (int32_t i = 0; i < own->count; i++) {
        vec2 p = own->data[i];
        out->data[i] = vec2_make(at.x + p.x * ahead.x - p.y * ahead.y, at.y + p.x * ahead.y + p.y * ahead.x);
    }
    return true;
}

/* Where it is now, as it is upright. */
static bool hull_now(context *ctx, const model *m, const world *w, int32_t vessel, vec2_array *plan, approach_hull *out)
{
    int32_t body = w->vessels.body[vessel];
    vec3 at = w->bodies.position[body], v = w->bodies.velocity[body];
    vec3 bow = mat3_mul_vec(quat_matrix(w->bodies.orientation[body]), vec3_make(1, 0, 0));
    double level = sqrt(bow.x * bow.x + bow.y * bow.y);
    vec2 ahead = level > 0 ? vec2_make(bow.x / level, bow.y / level) : vec2_make(1, 0);
    bool good = approach_outline(ctx, m, vessel, vec2_make(at.x, at.y), ahead, plan);
    *out = (approach_hull){{plan->data, plan->count}, vec2_make(v.x, v.y)};
    return good;
}

/* Whether two vessels can come closer than a limit at all: their hulls lie within circles about the centres of mass. */
static bool in_reach(const world *w, int32_t a, int32_t b, const approach_settings *settings)
{
    int32_t body_a = w->vessels.body[a], body_b = w->vessels.body[b];
    vec3 off = vec3_sub(w->bodies.position[body_b], w->bodies.position[body_a]);
    vec3 relative = vec3_sub(w->bodies.velocity[body_b], w->bodies.velocity[body_a]);
    double reach = w->shapes.shapes.radius[w->bodies.shape[body_a]] + w->shapes.shapes.radius[w->bodies.shape[body_b]];
    reach += settings->limit + settings->look_ahead * sqrt(relative.x * relative.x + relative.y * relative.y);
    return off.x * off.x + off.y * off.y < reach * reach;
}

static bool look_at_pair(context *ctx, const model *m, world *w, int32_t row, vec2_array plan[2])
{
    int32_t vessel = w->approaches.vessel[row], other = w->approaches.other[row];
    const approach_settings *settings = &m->vessels.data[vessel].approach;
    approach_prediction predicted = {HUGE_VAL, 0, HUGE_VAL};
    if (in_reach(w, vessel, other, settings)) {
        approach_hull a, b;
        if (!hull_now(ctx, m, w, vessel, &plan[0], &a) || !hull_now(ctx, m, w, other, &plan[1], &b))
            return false;
        predicted = approach_predict(&a, &b, settings->look_ahead);
    }
    double since = m->time_step * (double)interval_of(m, vessel);
    return approach_book(ctx, &w->approaches, row, settings, &predicted, w->clock.time[0], since, &w->events);
}

fram_status approach_watch(context *ctx, const model *m, world *w, fram_error *error)
{
    vec2_array plan[2] = {{0}, {0}};
    bool good = true;
    for (int32_t row = 0; row < w->approaches.count && good; row++) {
        if (w->clock.step[0] % interval_of(m, w->approaches.vessel[row]) == 0)
            good = look_at_pair(ctx, m, w, row, plan);
    }
    array_free(ctx, &plan[0]);
    array_free(ctx, &plan[1]);
    return good ? FRAM_OK : error_memory(error);
}
