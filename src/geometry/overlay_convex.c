/* Triangulation and convex pieces of a simple polygon; see overlay.h.

   Ears, flipped until they are Delaunay, and merged again: all with exact orientations, so that every vertex is kept.
   GEOS's own triangulation leaves out vertices that are straight but for rounding, and takes five times as long. */
#include "geometry/overlay_geos.h"
#include "geometry/polygon_pieces.h"

/* Numbers of the vertices of constrained Delaunay triangles of p, three per triangle. */
static fram_status number_triangles(overlay *o, polygon p, index_array *t, fram_error *error)
{
    fram_status status = overlay_check(o, p, "the polygon", error);
    if (status != FRAM_OK)
        return status;
    status = polygon_triangulate_ears(o->ctx, p, t);
    if (status == FRAM_ERROR_MEMORY || (status == FRAM_OK && !triangles_make_delaunay(o->ctx, p.vertex, p.count, t)))
        return error_memory(error);
    if (status != FRAM_OK)
        return error_set(error, FRAM_ERROR_INTERNAL, NULL, 0, NULL, "a valid polygon has no ears");
    return FRAM_OK;
}

fram_status overlay_triangulate(overlay *o, polygon p, polygon_list *out, fram_error *error)
{
    index_array t = {0};
    fram_status status = number_triangles(o, p, &t, error);
    polygon_list_clear(&o->found);
    for (int32_t i = 0; status == FRAM_OK && i < t.count; i += 3) {
        vec2 ring[3] = {p.vertex[t.data[i]], p.vertex[t.data[i + 1]], p.vertex[t.data[i + 2]]};
        if (!polygon_list_push(o->ctx, &o->found, (polygon){ring, ring_normal_form(ring, 3)}))
            status = error_memory(error);
    }
    array_free(o->ctx, &t);
    return status == FRAM_OK ? append_found(o, out, error) : status;
}

/* Append the pieces of at least `smallest` area, in order; the area of the others goes to *lost. */
static bool take_large(context *ctx, const polygon_list *pieces, double smallest, polygon_list *out, double *lost)
{
    polygon_list kept = {0};
    bool done = true;
    *lost = 0;
    for (int32_t i = 0; done && i < polygon_list_count(pieces); i++) {
        polygon piece = polygon_list_get(pieces, i);
        double area = polygon_area(piece);
        if (area < smallest)
            *lost += area;
        else
            done = polygon_list_push(ctx, &kept, piece);
    }
    done = done && polygon_list_append_sorted(ctx, out, &kept);
    polygon_list_free(ctx, &kept);
    return done;
}

fram_status overlay_convex_pieces(overlay *o, polygon p, double smallest, int32_t most, polygon_list *out,
                                  double *lost_area, fram_error *error)
{
    double lost = 0;
    if (polygon_is_convex(p) && polygon_area(p) > 0) {
        if (!polygon_list_push(o->ctx, out, p))
            return error_memory(error);
    } else {
        polygon_list pieces = {0};
        index_array t = {0};
        fram_status status = number_triangles(o, p, &t, error);
        if (status == FRAM_OK && (!triangles_merge(o->ctx, p.vertex, p.count, &t, MERGE_CONVEX, most, &pieces) ||
                                  !take_large(o->ctx, &pieces, smallest, out, &lost)))
            status = error_memory(error);
        polygon_list_free(o->ctx, &pieces);
        array_free(o->ctx, &t);
        if (status != FRAM_OK)
            return status;
    }
    if (lost_area)
        *lost_area = lost;
    return FRAM_OK;
}
