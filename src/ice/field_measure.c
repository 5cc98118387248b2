/* Measures of a field; see field_measure.h. */
#include "ice/field_measure.h"

#include <stdlib.h>

enum { PIECE_VERTICES = 24 };

/* A convex piece and the outline it is of; outlines of the second list are counted from -1 down. */
typedef struct measured_piece {
    box2 box;
    int32_t piece, owner;
} measured_piece;
typedef ARRAY(measured_piece) measured_array;

static int by_left_edge(const void *a, const void *b)
{
    const measured_piece *p = a, *q = b;
    if (p->box.lo.x != q->box.lo.x)
        return p->box.lo.x < q->box.lo.x ? -1 : 1;
    return (p->piece > q->piece) - (p->piece < q->piece);
}

static fram_status add_pieces(context *ctx, overlay *o, const polygon_list *list, bool second, polygon_list *pieces,
                              measured_array *index, fram_error *error)
{
    for (int32_t i = 0; list && i < polygon_list_count(list); i++) {
        polygon p = polygon_list_get(list, i);
        int32_t first = polygon_list_count(pieces);
        if (polygon_is_convex(p)) {
            if (!polygon_list_push(ctx, pieces, p))
                return error_memory(error);
        } else {
            fram_status status = overlay_convex_pieces(o, p, 0, PIECE_VERTICES, pieces, NULL, error);
            if (status != FRAM_OK)
                return status;
        }
        for (int32_t k = first; k < polygon_list_count(pieces); k++)
            if (!array_push(ctx, index,
                            (measured_piece){polygon_bounds(polygon_list_get(pieces, k)), k, second ? -1 - i : i}))
                return error_memory(error);
    }
    return FRAM_OK;
}

static double deepest_pair(const polygon_list *pieces, const measured_array *index)
{
    double deepest = 0;
    for (int32_t i = 0; i < index->count; i++) {
        const measured_piece *a = &index->data[i];
        for (int32_t k = i + 1; k < index->count && index->data[k].box.lo.x < a->box.hi.x; k++) {
            const measured_piece *b = &index->data[k];
            bool same = a->owner == b->owner || (a->owner < 0 && b->owner < 0);
            if (same || b->box.lo.y >= a->box.hi.y || a->box.lo.y >= b->box.hi.y)
                continue;
            double depth =
                polygon_convex_depth(polygon_list_get(pieces, a->piece), polygon_list_get(pieces, b->piece), NULL);
            deepest = depth > deepest ? depth : deepest;
        }
    }
    return deepest;
}

fram_status field_largest_overlap(context *ctx, overlay *o, const polygon_list *floes, const polygon_list *others,
                                  double *overlap, fram_error *error)
{
    polygon_list pieces = {0};
    measured_array index = {0};
    fram_status status = add_pieces(ctx, o, floes, false, &pieces, &index, error);
    if (status == FRAM_OK)
        status = add_pieces(ctx, o, others, true, &pieces, &index, error);
    if (status == FRAM_OK) {
        if (index.count > 0)
            qsort(index.data, (size_t)index.count, sizeof *index.data, by_left_edge);
        *overlap = deepest_pair(&pieces, &index);
    }
    polygon_list_free(ctx, &pieces);
    array_free(ctx, &index);
    return status;
}

static double common_area(polygon p, box2 b)
{
    const vec2 corner[4] = {b.lo, {b.hi.x, b.lo.y}, b.hi, {b.lo.x, b.hi.y}};
    return polygon_overlap_area(p, (polygon){corner, 4});
}

double field_concentration(const polygon_list *floes, box2 window)
{
    double cover;
    field_cover_map(floes, window, 1, 1, &cover);
    return cover;
}

/* Cells from `first` on that [lo, hi] meets; none: first > last. */
static void cell_range(double lo, double hi, double origin, double width, int32_t count, int32_t *first, int32_t *last)
{
    double a = floor((lo - origin) / width), b = floor((hi - origin) / width);
    *first = a < 0 ? 0 : a >= count ? count : (int32_t)a;
    *last = b < 0 ? -1 : b >= count ? count - 1 : (int32_t)b;
}

void field_cover_map(const polygon_list *floes, box2 box, int32_t nx, int32_t ny, double *cover)
{
    vec2 width = {(box.hi.x - box.lo.x) / nx, (box.hi.y - box.lo.y) / ny};
    for (int32_t i = 0; i < nx * ny; i++)
        cover[i] = 0;
    for (int32_t i = 0; i < polygon_list_count(floes); i++) {
        polygon p = polygon_list_get(floes, i);
        box2 b = polygon_bounds(p);
        int32_t x0, x1, y0, y1;
        cell_range(b.lo.x, b.hi.x, box.lo.x, width.x, nx, &x0, &x1);
        cell_range(b.lo.y, b.hi.y, box.lo.y, width.y, ny, &y0, &y1);
        for (int32_t y = y0; y <= y1; y++)
            for (int32_t x = x0; x <= x1; x++) {
                vec2 lo = {box.lo.x + x * width.x, box.lo.y + y * width.y};
                cover[y * nx + x] += common_area(p, (box2){lo, vec2_add(lo, width)});
            }
    }
    for (int32_t i = 0; i < nx * ny; i++)
        cover[i] /= width.x * width.y;
}
