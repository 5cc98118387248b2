#include "sim/run_told.h"

#include "base/transcendental.h"
#include "model/scenario_vessel.h"

#include <stdio.h>

typedef struct told_list {
    context *ctx;
    text_buffer *out;
} told_list;

static void add_told(told_list *l, const char *name) { text_format(l->ctx, l->out, "%s\n", name); }

static void add_flow(told_list *l, const world *w, input_kind kind, const char *name)
{
    int32_t row = input_find(&w->inputs, kind, 0);
    if (row < 0)
        return;
    const vec3 *is = &w->inputs.second[row];
    const double told[] = {is->x, is->y, is->z};
    for (int axis = 0; axis < 3; axis++) {
        char full[32];
        snprintf(full, sizeof full, "%s_%c", name, "xyz"[axis]);
        if (told[axis] != 0)
            add_told(l, full);
    }
}

/* Place of a vessel's path in the scenario, or of its set point; false: there are fewer. */
static bool given_place(const scenario_vessel *v, int32_t at, double *time, vec3 *place)
{
    const scenario_positioning *p = &v->positioning;
    if (v->mode == VESSEL_FREE && at < p->waypoints.count) {
        const scenario_waypoint *g = &p->waypoints.data[at];
        *time = g->time;
        *place = vec3_make(g->x, g->y, radians(g->heading_deg));
        return true;
    }
    if (v->mode != VESSEL_FREE && at < v->path.count) {
        const scenario_path_point *g = &v->path.data[at];
        *time = g->time;
        *place = vec3_make(g->x, g->y, radians(g->heading_deg));
        return true;
    }
    return false;
}

static bool path_is_given(const scenario_vessel *v, const world *w, int32_t vessel)
{
    const waypoint_table *t = &w->waypoints;
    int32_t count = 0;
    double time;
    vec3 place;
    for (int32_t i = 0; i < t->count; i++) {
        if (t->vessel[i] != vessel)
            continue;
        if (!given_place(v, count++, &time, &place) || t->time[i] != time || t->place[i].x != place.x ||
            t->place[i].y != place.y || t->place[i].z != place.z)
            return false;
    }
    return !given_place(v, count, &time, &place);
}

/* A path of a free vessel is its way points; a set point that is told ends them. */
static const char *path_name(const scenario_vessel *v, const world *w, int32_t vessel)
{
    bool there = false;
    for (int32_t i = 0; i < w->waypoints.count && !there; i++)
        there = w->waypoints.vessel[i] == vessel;
    return v->mode == VESSEL_FREE && !there ? "set_point" : "path";
}

/* Of a carriage that goes straight on; on a path the velocity is that of the step. */
static bool velocity_is_given(const scenario_vessel *v, const world *w, int32_t vessel)
{
    vec3 given = scenario_velocity(v->speed, automatic_or(v->course_deg, v->heading_deg));
    vec3 now = w->vessels.tow_velocity[vessel];
    return v->mode == VESSEL_FREE || v->path.count > 0 || (now.x == given.x && now.y == given.y);
}

void run_told_list(context *ctx, const scenario *s, const world *w, text_buffer *out)
{
    told_list l = {ctx, out};
    add_flow(&l, w, INPUT_WIND, "wind");
    add_flow(&l, w, INPUT_CURRENT, "current");
    add_flow(&l, w, INPUT_DRIFT, "ice_drift");
    for (int32_t v = 0; v < scenario_vessel_count(s) && v < w->vessels.count; v++) {
        const scenario_vessel *keys = scenario_vessel_entry(s, v).keys;
        if (input_find(&w->inputs, INPUT_FORCE, v) >= 0)
            add_told(&l, vessel_channel_name(s, v, "outside_force").text);
        if (!path_is_given(keys, w, v))
            add_told(&l, vessel_channel_name(s, v, path_name(keys, w, v)).text);
        else if (!velocity_is_given(keys, w, v))
            add_told(&l, vessel_channel_name(s, v, "tow_velocity").text);
    }
}
