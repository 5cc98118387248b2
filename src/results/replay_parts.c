#include "results/replay_parts.h"

#include "geometry/overlay.h"

/* Part of its convex outline that a solid must leave open: as in the picture of the plan (sim/build_ice.c). */
#define OPEN_SHARE 0.01

/* Triangles that look upwards, seen from above: of a closed surface they cover all that it covers. */
static bool list_upper(const replay *r, const replay_body *b, mat3 turn, polygon_list *out)
{
    bool good = true;
    for (int32_t f = 0; f < b->face_count && good; f++) {
        vec2 corner[3];
        for (int k = 0; k < 3; k++) {
            int32_t at = b->vertex_first + r->faces.data[3 * (b->face_first + f) + k];
            vec3 g = mat3_mul_vec(turn, r->points.data[at]);
            corner[k] = vec2_make(g.x, g.y);
        }
        polygon triangle = {corner, 3};
        if (polygon_orientation(triangle) > 0 && polygon_area(triangle) > 0)
            good = polygon_list_push(r->ctx, out, triangle);
    }
    return good;
}

/* What the solid covers, about its centre of mass; nothing where GEOS finds no union that is right. */
static fram_status unite_upper(const replay *r, const replay_body *b, mat3 turn, polygon_list *out, fram_error *error)
{
    polygon_list triangles = {0};
    overlay *plane = overlay_create(r->ctx);
    fram_status status = plane && list_upper(r, b, turn, &triangles) ? FRAM_OK : error_memory(error);
    if (status == FRAM_OK)
        status = overlay_union(plane, &triangles, out, error);
    polygon_list_free(r->ctx, &triangles);
    overlay_free(plane);
    return status == FRAM_ERROR_MEMORY ? status : FRAM_OK;
}

/* Upright: a hull that rolls does not become another one. */
static fram_status look_for_openness(const replay *r, replay_body *b, fram_error *error)
{
    const mat3 upright = quat_matrix((quat){1, 0, 0, 0});
    vec2_array points = {0}, around = {0};
    polygon_list parts = {0};
    double area = 0;
    bool good = true;
    for (int32_t i = 0; i < b->vertex_count && good; i++) {
        vec3 v = r->points.data[b->vertex_first + i];
        good = array_push(r->ctx, &points, vec2_make(v.x, v.y));
    }
    good = good && polygon_convex_hull(r->ctx, (polygon){points.data, points.count}, &around);
    fram_status status = good ? unite_upper(r, b, upright, &parts, error) : error_memory(error);
    for (int32_t i = 0; i < polygon_list_count(&parts); i++)
        area += polygon_area(polygon_list_get(&parts, i));
    bool open = area > 0 && area < (1 - OPEN_SHARE) * polygon_area((polygon){around.data, around.count});
    b->openness = open ? OPENNESS_OPEN : OPENNESS_CLOSED;
    array_free(r->ctx, &points);
    array_free(r->ctx, &around);
    polygon_list_free(r->ctx, &parts);
    return status;
}

/* Appends the rings of `from`, moved. */
static bool append_moved(context *ctx, const polygon_list *from, vec3 by, vec2_array *ring, polygon_list *out)
{
    bool good = true;
    for (int32_t i = 0; i < polygon_list_count(from) && good; i++) {
        polygon part = polygon_list_get(from, i);
        array_clear(ring);
        for (int32_t k = 0; k < part.count && good; k++)
            good = array_push(ctx, ring, vec2_make(part.vertex[k].x + by.x, part.vertex[k].y + by.y));
        good = good && polygon_list_push(ctx, out, (polygon){ring->data, ring->count});
    }
    return good;
}

fram_status replay_parts_add(replay *r, const replay_pose *p, polygon_list *out, fram_error *error)
{
    replay_body *b = &r->bodies.data[p->body];
    fram_status status = FRAM_OK;
    if (b->solid && b->openness == OPENNESS_UNKNOWN)
        status = look_for_openness(r, b, error);
    if (status != FRAM_OK || !b->solid || b->openness != OPENNESS_OPEN)
        return status;
    polygon_list parts = {0};
    vec2_array ring = {0};
    status = unite_upper(r, b, quat_matrix(p->orientation), &parts, error);
    if (status == FRAM_OK && !append_moved(r->ctx, &parts, p->position, &ring, out))
        status = error_memory(error);
    array_free(r->ctx, &ring);
    polygon_list_free(r->ctx, &parts);
    return status;
}
