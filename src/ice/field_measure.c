/* Measures of a field; see field_measure.h. */
#include "ice/field_measure.h"

#include "geometry/box_pairs.h"

#include <math.h>

enum { MEASURED_VERTICES = 24 };

/* Common area under this part of the areas of both outlines is rounding (polygon_overlap_area: about 1e-15). */
#define COMMON_ROUNDING 1e-12

/* Convex pieces, and the outline that each is of; outlines of the second list are counted from -1 down. */
typedef struct measured_pieces {
    polygon_list pieces;
    int32_array owner;
    ARRAY(box2) box;
    double deepest;
} measured_pieces;

static fram_status add_pieces(context *ctx, overlay *o, const polygon_list *list, bool second, measured_pieces *m,
                              fram_error *error)
{
    for (int32_t i = 0; list && i < polygon_list_count(list); i++) {
        polygon p = polygon_list_get(list, i);
        fram_status status = work_continue(ctx, "cutting floes into convex pieces", i, polygon_list_count(list), error);
        if (status == FRAM_OK && (!o || polygon_is_convex(p)))
            status = polygon_list_push(ctx, &m->pieces, p) ? FRAM_OK : error_memory(error);
        else if (status == FRAM_OK)
            status = overlay_convex_pieces(o, p, 0, MEASURED_VERTICES, &m->pieces, NULL, error);
        if (status != FRAM_OK)
            return status;
        for (int32_t k = m->box.count; k < polygon_list_count(&m->pieces); k++)
            if (!array_push(ctx, &m->box, polygon_bounds(polygon_list_get(&m->pieces, k))) ||
                !array_push(ctx, &m->owner, second ? -1 - i : i))
                return error_memory(error);
    }
    return FRAM_OK;
}

static fram_status measure_pair(void *user, int32_t a, int32_t b, fram_error *error)
{
    (void)error;
    measured_pieces *m = user;
    int32_t of_a = m->owner.data[a], of_b = m->owner.data[b];
    if (of_a == of_b || (of_a < 0 && of_b < 0))
        return FRAM_OK;
    double depth = polygon_convex_depth(polygon_list_get(&m->pieces, a), polygon_list_get(&m->pieces, b), NULL);
    m->deepest = depth > m->deepest ? depth : m->deepest;
    return FRAM_OK;
}

fram_status field_largest_overlap(context *ctx, overlay *o, const polygon_list *floes, const polygon_list *others,
                                  double *overlap, fram_error *error)
{
    measured_pieces m = {.deepest = 0};
    fram_status status = add_pieces(ctx, o, floes, false, &m, error);
    if (status == FRAM_OK)
        status = add_pieces(ctx, o, others, true, &m, error);
    if (status == FRAM_OK)
        status = box_pairs(ctx, m.box.data, m.box.count, "looking for overlaps", measure_pair, &m, error);
    if (status == FRAM_OK)
        *overlap = m.deepest;
    polygon_list_free(ctx, &m.pieces);
    array_free(ctx, &m.owner);
    array_free(ctx, &m.box);
    return status;
}

double field_common_area(polygon a, polygon b)
{
    double area = polygon_overlap_area(a, b);
    return area > 0 && area > COMMON_ROUNDING * (polygon_area(a) + polygon_area(b)) ? area : 0;
}

/* Rounding makes a little less than nothing of a floe beside the box. */
static double common_area(polygon p, box2 b)
{
    const vec2 corner[4] = {b.lo, {b.hi.x, b.lo.y}, b.hi, {b.lo.x, b.hi.y}};
    return fmax(0, polygon_overlap_area(p, (polygon){corner, 4}));
}

/* Cells from `first` on that [lo, hi] meets; none: first > last. */
static void cell_range(double lo, double hi, double origin, double width, int32_t count, int32_t *first, int32_t *last)
{
    double a = floor((lo - origin) / width), b = floor((hi - origin) / width);
    *first = a < 0 ? 0 : a >= count ? count : (int32_t)a;
    *last = b < 0 ? -1 : b >= count ? count - 1 : (int32_t)b;
}

/* Adds the area of an outline, moved by a vector, to the cells. */
static void add_area(polygon p, vec2 by, box2 box, int32_t nx, int32_t ny, double *cover)
{
    vec2 width = {(box.hi.x - box.lo.x) / nx, (box.hi.y - box.lo.y) / ny}, origin = vec2_sub(box.lo, by);
    box2 b = polygon_bounds(p);
    int32_t x0, x1, y0, y1;
    cell_range(b.lo.x, b.hi.x, origin.x, width.x, nx, &x0, &x1);
    cell_range(b.lo.y, b.hi.y, origin.y, width.y, ny, &y0, &y1);
    for (int32_t y = y0; y <= y1; y++)
        for (int32_t x = x0; x <= x1; x++) {
            vec2 lo = {origin.x + x * width.x, origin.y + y * width.y};
            cover[y * nx + x] += common_area(p, (box2){lo, vec2_add(lo, width)});
        }
}

/* Copies of [lo, hi] that meet [from, to]: moved by `first` periods and the next ones, of which it returns how many. */
static int32_t copy_range(double lo, double hi, double from, double to, double period, double *first)
{
    *first = period > 0 ? ceil((from - hi) / period) : 0;
    double last = period > 0 ? floor((to - lo) / period) : 0;
    return (int32_t)fmax(last - *first + 1, 0);
}

void field_cover_map(const polygon_list *floes, vec2 period, box2 box, int32_t nx, int32_t ny, double *cover)
{
    for (int32_t i = 0; i < nx * ny; i++)
        cover[i] = 0;
    for (int32_t f = 0; f < polygon_list_count(floes); f++) {
        polygon p = polygon_list_get(floes, f);
        box2 b = polygon_bounds(p);
        double x, y;
        int32_t columns = copy_range(b.lo.x, b.hi.x, box.lo.x, box.hi.x, period.x, &x);
        int32_t rows = copy_range(b.lo.y, b.hi.y, box.lo.y, box.hi.y, period.y, &y);
        for (int32_t k = 0; k < rows; k++)
            for (int32_t i = 0; i < columns; i++)
                add_area(p, vec2_make((x + i) * period.x, (y + k) * period.y), box, nx, ny, cover);
    }
    vec2 width = {(box.hi.x - box.lo.x) / nx, (box.hi.y - box.lo.y) / ny};
    for (int32_t i = 0; i < nx * ny; i++)
        cover[i] /= width.x * width.y;
}

/* Ice area in a box. */
static double ice_in(const polygon_list *floes, vec2 period, vec2 lo, vec2 size)
{
    double cover, area = size.x * size.y;
    if (!(area > 0))
        return 0;
    field_cover_map(floes, period, (box2){lo, vec2_add(lo, size)}, 1, 1, &cover);
    return cover * area;
}

double field_concentration(const polygon_list *floes, vec2 period, box2 window)
{
    double cover;
    if (!(period.x > 0 && period.y > 0)) {
        field_cover_map(floes, period, window, 1, 1, &cover);
        return cover;
    }
    /* However large the window and wherever it lies: each whole period holds what the first one does. */
    vec2 size = vec2_sub(window.hi, window.lo), rest = {fmod(size.x, period.x), fmod(size.y, period.y)};
    vec2 lo = {fmod(window.lo.x, period.x), fmod(window.lo.y, period.y)};
    double nx = (size.x - rest.x) / period.x, ny = (size.y - rest.y) / period.y;
    double ice = nx * ny * ice_in(floes, period, lo, period) + ice_in(floes, period, lo, rest) +
                 nx * ice_in(floes, period, lo, vec2_make(period.x, rest.y)) +
                 ny * ice_in(floes, period, lo, vec2_make(rest.x, period.y));
    return ice / (size.x * size.y);
}
