#include "results/replay_plan.h"

#include "model/scenario_vessel.h"

#include <math.h>

static const struct {
    const char *name, *title;
} looks[PLAN_COLOUR_COUNT] = {
    [PLAN_COLOUR_PLAIN] = {"plain", NULL},
    [PLAN_COLOUR_SPEED] = {"speed", "speed [m/s]"},
    [PLAN_COLOUR_FORCE] = {"force", "contact force [kN]"},
    [PLAN_COLOUR_THICKNESS] = {"thickness", "thickness [m]"},
    [PLAN_COLOUR_AGE] = {"age", "time since it broke off [s]"},
};

const char *plan_colour_name(plan_colour colour) { return looks[colour].name; }
const char *plan_colour_title(plan_colour colour) { return looks[colour].title; }

double plan_colour_value(plan_colour colour, const replay_body *b, const replay_pose *p, double time)
{
    const double nothing = (double)NAN;
    if (b->material != MATERIAL_ICE)
        return nothing;
    switch (colour) {
    case PLAN_COLOUR_SPEED:
        return vec3_length(p->velocity);
    case PLAN_COLOUR_FORCE:
        return p->contact_force * 1e-3;
    case PLAN_COLOUR_THICKNESS:
        return b->thickness;
    case PLAN_COLOUR_AGE:
        /* What is left of a tile that broke has not broken off. */
        return b->parent >= 0 && !b->level ? time - b->birth : nothing;
    default:
        return nothing;
    }
}

static bool add_shape(const replay *r, const replay_moment *m, int32_t outline, plan_colour colour, double lo,
                      double hi, replay_plan *out)
{
    int32_t row = replay_moment_row(m, outline);
    if (row < 0)
        return true;
    const replay_pose *p = &m->poses.data[row];
    const replay_body *b = &r->bodies.data[p->body];
    plan_shape shape = {.outline = polygon_list_get(&m->outlines, outline), .owner = b->vessel};
    shape.style = b->solid                       ? PLAN_DECK
                  : b->material == MATERIAL_WALL ? PLAN_WALL
                  : b->material == MATERIAL_HULL ? PLAN_DECK
                  : b->level                     ? PLAN_LEVEL_ICE /* also of a sheet that drifts */
                  : b->moves                     ? PLAN_FLOE
                                                 : PLAN_FIXED_ICE;
    if (b->solid)
        shape.height = HUGE_VAL;
    else
        plan_shape_stand(&shape, p->position, p->orientation, b->thickness);
    double value = plan_colour_value(colour, b, p, m->time);
    shape.has_value = value == value;
    if (shape.has_value)
        shape.value = (float)(hi > lo ? fmin(fmax((value - lo) / (hi - lo), 0), 1) : 0);
    return array_push(r->ctx, &out->shapes, shape);
}

static void find_vessel(const replay *r, const replay_moment *m, replay_plan *out)
{
    out->has_vessel = false;
    for (int32_t i = 0; i < m->poses.count && !out->has_vessel; i++) {
        const replay_pose *p = &m->poses.data[i];
        out->has_vessel = r->bodies.data[p->body].solid;
        out->vessel = vec2_make(p->position.x, p->position.y);
    }
}

/* Contacts push: their arrows end where they do; lines and thrusters pull: theirs begin there. */
static bool add_arrow(const replay *r, const replay_force *f, double length, replay_plan *out)
{
    vec2 at = vec2_make(f->point.x, f->point.y), way = vec2_make(f->force.x * length, f->force.y * length);
    plan_arrow arrow = {at, vec2_add(at, way)};
    if (record_force_pushes(f->kind))
        arrow = (plan_arrow){vec2_sub(at, way), at};
    return array_push(r->ctx, &out->arrows, arrow);
}

fram_status replay_plan_make(const replay *r, const replay_moment *m, plan_colour colour, double lo, double hi,
                             double arrow, double mark_time, replay_plan *out, fram_error *error)
{
    bool good = true;
    array_clear(&out->shapes);
    array_clear(&out->arrows);
    array_clear(&out->marks);
    find_vessel(r, m, out);
    for (int32_t i = 0; i < polygon_list_count(&m->outlines) && good; i++)
        good = add_shape(r, m, i, colour, lo, hi, out);
    plan_shapes_sort(out->shapes.data, out->shapes.count);
    for (int32_t i = 0; arrow > 0 && i < r->frame.forces.count && good; i++)
        good = add_arrow(r, &r->frame.forces.data[i], arrow, out);
    for (int32_t i = 0; i < r->fractures.count && good; i++) {
        const record_fracture *f = &r->fractures.data[i];
        if (f->time <= m->time && f->time > m->time - mark_time)
            good = array_push(r->ctx, &out->marks, vec2_make(f->place.x, f->place.y));
    }
    return good ? FRAM_OK : error_memory(error);
}

bool replay_plan_marks_in(const replay_plan *p, box2 window)
{
    for (int32_t i = 0; i < p->marks.count; i++) {
        vec2 at = p->marks.data[i];
        if (at.x >= window.lo.x && at.x <= window.hi.x && at.y >= window.lo.y && at.y <= window.hi.y)
            return true;
    }
    return false;
}

/* Horizontal distance of the anchor at the start of a vessel's line, by its number among those of the vessel, from 1
   [m]; 0: it has not so many. */
static double anchor_distance(const scenario *s, int32_t vessel, int32_t number)
{
    const scenario_mooring *m = &scenario_vessel_entry(s, vessel).keys->mooring;
    int64_t before = 0;
    for (int32_t i = 0; i < m->lines.count; i++) {
        before += m->lines.data[i].count;
        if (number <= before)
            return m->lines.data[i].distance;
    }
    return 0;
}

/* Of the nearest vessel that has such a line: a record numbers the lines of each vessel by themselves. */
static double anchor_distance_at(const replay *r, const scenario *s, const replay_force *f)
{
    double nearest = HUGE_VAL, distance = 0;
    for (int32_t i = 0, vessel = 0; i < r->bodies.count && vessel < scenario_vessel_count(s); i++) {
        if (r->bodies.data[i].material != MATERIAL_HULL)
            continue;
        double there = anchor_distance(s, vessel++, f->which);
        for (int32_t k = 0; k < r->frame.poses.count && there > 0; k++) {
            const replay_pose *p = &r->frame.poses.data[k];
            double off = vec3_length(vec3_sub(p->position, f->point));
            if (p->body == i && off < nearest) {
                nearest = off;
                distance = there;
            }
        }
    }
    return distance;
}

fram_status replay_plan_lines(const replay *r, const scenario *s, replay_plan *out, fram_error *error)
{
    array_clear(&out->lines);
    for (int32_t i = 0; i < r->frame.forces.count; i++) {
        const replay_force *f = &r->frame.forces.data[i];
        double level = sqrt(f->force.x * f->force.x + f->force.y * f->force.y);
        if (f->kind != RECORD_FORCE_LINE || !(level > 0))
            continue;
        double way = anchor_distance_at(r, s, f) / level;
        vec2 upper = vec2_make(f->point.x, f->point.y);
        plan_line line = {upper, vec2_add(upper, vec2_make(f->force.x * way, f->force.y * way))};
        if (!array_push(r->ctx, &out->lines, line))
            return error_memory(error);
    }
    return FRAM_OK;
}

void replay_plan_free(context *ctx, replay_plan *p)
{
    array_free(ctx, &p->shapes);
    array_free(ctx, &p->arrows);
    array_free(ctx, &p->lines);
    array_free(ctx, &p->marks);
}
