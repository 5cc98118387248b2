/* Outlines extruded along z.  Knows nothing of floes. */
#include "geometry/ear_clip.h"
#include "geometry/mesh.h"
#include "geometry/predicate.h"

/* Both levels of the outline's vertices, repeated ones once; returns how many are left. */
static int32_t add_levels(polygon outline, double bottom, double top, mesh *out)
{
    int32_t n = 0;
    for (int32_t i = 0; i < outline.count; i++) {
        vec2 p = outline.vertex[i], before = outline.vertex[i > 0 ? i - 1 : outline.count - 1];
        if (!vec2_equal(p, before))
            out->vertex.data[n++] = (vec3){p.x, p.y, bottom};
    }
    for (int32_t i = 0; i < n; i++)
        out->vertex.data[n + i] = (vec3){out->vertex.data[i].x, out->vertex.data[i].y, top};
    out->vertex.count = 2 * n;
    return n;
}

/* Every vertex sees the first one: then the fan about it is a triangulation. */
static bool is_fan(const vec2 *vertex, int32_t n)
{
    for (int32_t i = 2; i < n; i++)
        if (orientation(vertex[0], vertex[i - 1], vertex[i]) <= 0)
            return false;
    return true;
}

/* Triangles of the lid (three vertex numbers each), counter-clockwise seen from above. */
static fram_status triangulate_lid(context *ctx, const vec2 *vertex, int32_t n, index_array *lid)
{
    if (!is_fan(vertex, n))
        return polygon_triangulate_ears(ctx, (polygon){vertex, n}, lid);
    if (!array_resize(ctx, lid, 3 * (n - 2)))
        return FRAM_ERROR_MEMORY;
    for (int32_t i = 2, k = 0; i < n; i++) {
        lid->data[k++] = 0;
        lid->data[k++] = i - 1;
        lid->data[k++] = i;
    }
    return FRAM_OK;
}

/* Faces over room for 4 n - 4 of them. */
static void add_faces(const index_array *lid, int32_t n, mesh *out)
{
    triangle *face = out->face.data;
    for (int32_t k = 0; k < lid->count; k += 3) {
        const int32_t *v = &lid->data[k];
        *face++ = (triangle){{v[0], v[2], v[1]}};
        *face++ = (triangle){{n + v[0], n + v[1], n + v[2]}};
    }
    for (int32_t i = 0; i < n; i++) {
        int32_t j = i + 1 < n ? i + 1 : 0;
        *face++ = (triangle){{i, j, n + j}};
        *face++ = (triangle){{i, n + j, n + i}};
    }
    out->face.count = (int32_t)(face - out->face.data);
}

static fram_status make(context *ctx, polygon outline, double bottom, double top, mesh *out, vec2_array *plan,
                        index_array *lid)
{
    if (!array_reserve(ctx, &out->vertex, 2 * outline.count) || !array_reserve(ctx, &out->face, 4 * outline.count))
        return FRAM_ERROR_MEMORY;
    int32_t n = add_levels(outline, bottom, top, out);
    if (n < 3)
        return FRAM_ERROR_INPUT;
    if (!array_resize(ctx, plan, n))
        return FRAM_ERROR_MEMORY;
    for (int32_t i = 0; i < n; i++)
        plan->data[i] = (vec2){out->vertex.data[i].x, out->vertex.data[i].y};
    fram_status status = triangulate_lid(ctx, plan->data, n, lid);
    if (status == FRAM_OK)
        add_faces(lid, n, out);
    return status;
}

fram_status mesh_make_prism(context *ctx, polygon outline, double bottom, double top, mesh *out, fram_error *error)
{
    mesh_clear(out);
    if (!(bottom < top))
        return error_set(error, FRAM_ERROR_INPUT, NULL, 0, NULL, "a prism from z = %g to %g m has no height", bottom,
                         top);
    if (outline.count > INT32_MAX / 4)
        return error_memory(error);
    vec2_array plan = {0};
    index_array lid = {0};
    fram_status status = make(ctx, outline, bottom, top, out, &plan, &lid);
    array_free(ctx, &plan);
    array_free(ctx, &lid);
    if (status != FRAM_OK)
        mesh_clear(out);
    if (status == FRAM_ERROR_INPUT)
        error_set(error, status, NULL, 0, NULL,
                  "the outline of a prism (%d vertices) is not a simple counter-clockwise ring", outline.count);
    return status == FRAM_ERROR_MEMORY ? error_memory(error) : status;
}
