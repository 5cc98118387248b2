#include "results/replay_moment.h"

#include "results/replay_parts.h"

/* Positions on a straight line; quaternions on the shorter way, normalised. */
static void blend(replay_pose *p, const replay_pose *later, double part)
{
    quat a = p->orientation, b = later->orientation;
    double sign = a.w * b.w + a.x * b.x + a.y * b.y + a.z * b.z < 0 ? -1 : 1;
    p->position = vec3_mad(vec3_scale(p->position, 1 - part), later->position, part);
    p->orientation = quat_unit((quat){a.w + part * (sign * b.w - a.w), a.x + part * (sign * b.x - a.x),
                                      a.y + part * (sign * b.y - a.y), a.z + part * (sign * b.z - a.z)});
    p->contact_force += part * (later->contact_force - p->contact_force);
}

static bool add_outline(replay *r, const replay_pose *p, replay_moment *out)
{
    const replay_body *b = &r->bodies.data[p->body];
    mat3 turn = quat_matrix(p->orientation);
    vec2_array plan = {0}, around = {0};
    bool good = true;
    for (int32_t i = 0; i < b->vertex_count && good; i++) {
        vec3 local =
            b->solid ? r->points.data[b->vertex_first + i]
                     : vec3_make(r->outlines.data[b->vertex_first + i].x, r->outlines.data[b->vertex_first + i].y, 0);
        vec3 g = vec3_add(p->position, mat3_mul_vec(turn, local));
        good = array_push(r->ctx, &plan, vec2_make(g.x, g.y));
    }
    polygon ring = {plan.data, plan.count};
    if (good && b->solid) {
        good = polygon_convex_hull(r->ctx, ring, &around);
        ring = (polygon){around.data, around.count};
    }
    good = good && polygon_list_push(r->ctx, &out->outlines, ring) && array_push(r->ctx, &out->poses, *p);
    array_free(r->ctx, &plan);
    array_free(r->ctx, &around);
    return good;
}

static fram_status add_parts(replay *r, replay_moment *out, fram_error *error)
{
    fram_status status = FRAM_OK;
    for (int32_t row = 0; row < out->poses.count && status == FRAM_OK; row++) {
        int32_t before = polygon_list_count(&out->outlines);
        status = replay_parts_add(r, &out->poses.data[row], &out->outlines, error);
        for (int32_t n = polygon_list_count(&out->outlines) - before; n > 0 && status == FRAM_OK; n--)
            status = array_push(r->ctx, &out->part_of, row) ? FRAM_OK : error_memory(error);
    }
    return status;
}

int32_t replay_moment_row(const replay_moment *m, int32_t outline)
{
    if (outline >= m->poses.count)
        return m->part_of.data[outline - m->poses.count];
    for (int32_t k = 0; k < m->part_of.count; k++)
        if (m->part_of.data[k] == outline)
            return -1;
    return outline;
}

static fram_status find_plan(replay *r, double part, replay_moment *out, fram_error *error)
{
    double since = r->has_next ? part * (r->next.time - r->frame.time) : 0;
    out->time = r->frame.time + since;
    polygon_list_clear(&out->outlines);
    array_clear(&out->poses);
    array_clear(&out->part_of);
    for (int32_t i = 0; i < r->frame.poses.count; i++) {
        replay_pose p = r->frame.poses.data[i];
        int32_t later = p.body < r->next_row.count && r->has_next ? r->next_row.data[p.body] : -1;
        if (later >= 0 && part > 0)
            blend(&p, &r->next.poses.data[later], part);
        else if (part > 0)
            p.position = vec3_mad(p.position, p.velocity, since);
        if (!add_outline(r, &p, out))
            return error_memory(error);
    }
    return add_parts(r, out, error);
}

fram_status replay_moment_now(replay *r, replay_moment *out, fram_error *error) { return find_plan(r, 0, out, error); }

/* Times are told in decimals and kept in binary. */
static double time_slack(double time) { return 1e-9 * (1 + fabs(time)); }

fram_status replay_moment_until(replay *r, double time, replay_moment *out, fram_error *error)
{
    double slack = time_slack(time);
    bool found = true;
    fram_status status = FRAM_OK;
    if (r->has_next && r->frame.poses.count == 0 && time < r->next.time - slack)
        return error_set(error, FRAM_ERROR_INPUT, r->reader.path, 0, "time", "the record begins at %g s", r->next.time);
    while (status == FRAM_OK && r->has_next && r->next.time <= time + slack)
        status = replay_next(r, &found, error);
    if (status != FRAM_OK)
        return status;
    double span = r->has_next ? r->next.time - r->frame.time : 0;
    return find_plan(r, span > 0 ? fmin(fmax((time - r->frame.time) / span, 0), 1) : 0, out, error);
}

fram_status replay_moment_at(replay *r, double time, replay_moment *out, fram_error *error)
{
    fram_status status = replay_moment_until(r, time, out, error);
    if (status == FRAM_OK && !r->has_next && !(time <= r->frame.time + time_slack(time)))
        return error_set(error, FRAM_ERROR_INPUT, r->reader.path, 0, "time", "the record ends at %g s", r->frame.time);
    return status;
}

void replay_moment_free(context *ctx, replay_moment *m)
{
    polygon_list_free(ctx, &m->outlines);
    array_free(ctx, &m->poses);
    array_free(ctx, &m->part_of);
}
