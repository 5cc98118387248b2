/* Convex pieces of a simple polygon: Delaunay triangles, merged. */
#include "geometry/overlay.h"
#include "geometry/polygon_pieces.h"

/* The triangles in `list` by the numbers of their vertices, and merge them.  false when there is no memory. */
static bool merge_triangles(context *ctx, const polygon_list *list, int32_t most, polygon_list *pieces)
{
    int32_t n = list->vertex.count;
    index_array t = {0};
    vec2 *place = memory_array(ctx, (size_t)n, sizeof *place);
    bool done = place && array_resize(ctx, &t, n);
    if (done) {
        int32_t places = vertex_places(ctx, list->vertex.data, n, place, t.data);
        done = places >= 0 && triangles_merge(ctx, place, places, &t, MERGE_CONVEX, most, pieces);
    }
    array_free(ctx, &t);
    memory_free(ctx, place);
    return done;
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
    context *ctx = overlay_context(o);
    double lost = 0;
    if (polygon_is_convex(p) && polygon_area(p) > 0) {
        if (!polygon_list_push(ctx, out, p))
            return error_memory(error);
    } else {
        polygon_list triangles = {0}, pieces = {0};
        fram_status status = overlay_triangulate(o, p, &triangles, error);
        if (status == FRAM_OK &&
            (!merge_triangles(ctx, &triangles, most, &pieces) || !take_large(ctx, &pieces, smallest, out, &lost)))
            status = error_memory(error);
        polygon_list_free(ctx, &triangles);
        polygon_list_free(ctx, &pieces);
        if (status != FRAM_OK)
            return status;
    }
    if (lost_area)
        *lost_area = lost;
    return FRAM_OK;
}
