/* Overlay, repair, triangulation and convex pieces on two rings of any vertices.  The first byte tells how the rest
   makes coordinates: by a coarse grid, where everything degenerate happens, by a fine one, or as the doubles they are;
   and how many of the vertices are the first ring's. Promises: results are valid rings; areas of valid rings add up;
   what is not valid is refused or repaired. */
#include "fuzzing.h"
#include "geometry/overlay.h"
#include <string.h>

enum { MOST_VERTICES = 64 };

static int32_t read_vertices(const uint8_t *data, size_t size, int kind, vec2 *out)
{
    static const size_t bytes[] = {1, 2, 8};
    size_t each = bytes[kind];
    int32_t count = 0;
    for (; count < MOST_VERTICES && size >= 2 * each; count++, data += 2 * each, size -= 2 * each) {
        double c[2];
        for (int k = 0; k < 2; k++) {
            int16_t fine;
            const uint8_t *at = data + (size_t)k * each;
            if (kind == 0) {
                c[k] = 0.25 * (double)(int8_t)*at;
            } else if (kind == 1) {
                memcpy(&fine, at, sizeof fine);
                c[k] = 1e-3 * (double)fine;
            } else {
                memcpy(&c[k], at, sizeof c[k]);
                /* Metres of an ice field: not so small or large that an area leaves the range of doubles. */
                if (!(fabs(c[k]) > 1e-6 && fabs(c[k]) < 1e7))
                    c[k] = 0;
            }
        }
        out[count] = (vec2){c[0], c[1]};
    }
    return count;
}

/* What rounding may do to the areas of pieces of rings with these vertices: places are rounded to some 1e-16 of the
   largest coordinate, and GEOS may snap vertices nearer than some 1e-12 of it. */
static double area_slack(polygon p)
{
    double largest = 0;
    for (int32_t i = 0; i < p.count; i++)
        largest = fmax(largest, fmax(fabs(p.vertex[i].x), fabs(p.vertex[i].y)));
    return 1e-6 * fabs(polygon_area(p)) + 1e-9 * largest * largest;
}

/* Sum of the areas from ring `first` on, each of which must be valid. */
static double area_of(overlay *o, const polygon_list *list, int32_t first)
{
    double area = 0;
    for (int32_t i = first; i < polygon_list_count(list); i++) {
        polygon ring = polygon_list_get(list, i);
        PROMISE(overlay_is_valid(o, ring, NULL, NULL));
        area += polygon_area(ring);
    }
    return area;
}

static void check_one(context *ctx, overlay *o, polygon p)
{
    polygon_list out = {0};
    fram_error error = {0};
    double area = polygon_area(p), lost = 0;
    fram_status status = overlay_triangulate(o, p, &out, &error);
    if (status == FRAM_OK)
        PROMISE(fabs(area_of(o, &out, 0) - area) <= area_slack(p));
    polygon_list_clear(&out);
    status = overlay_convex_pieces(o, p, 0, 8, &out, &lost, &error);
    if (status == FRAM_OK)
        PROMISE(fabs(area_of(o, &out, 0) + lost - area) <= area_slack(p));
    polygon_list_free(ctx, &out);
}

static void check_two(context *ctx, overlay *o, polygon a, polygon b)
{
    polygon_list out = {0};
    fram_error error = {0};
    double area = polygon_area(a), slack = area_slack(a) + area_slack(b);
    if (overlay_difference(o, a, b, &out, &error) == FRAM_OK) {
        double outside = area_of(o, &out, 0);
        int32_t first = polygon_list_count(&out);
        if (overlay_intersection(o, a, b, &out, &error) == FRAM_OK)
            PROMISE(fabs(outside + area_of(o, &out, first) - area) <= slack);
    }
    polygon_list_free(ctx, &out);
}

static void check_repair(context *ctx, overlay *o, polygon p)
{
    polygon_list out = {0};
    vec2_array ring = {0};
    fram_error error = {0};
    if (overlay_make_valid(o, p, &out, &error) == FRAM_OK)
        PROMISE(area_of(o, &out, 0) >= 0);
    if (overlay_simplify(o, p, 0.5, &ring, &error) == FRAM_OK)
        PROMISE(overlay_is_valid(o, (polygon){ring.data, ring.count}, NULL, NULL));
    array_free(ctx, &ring);
    polygon_list_free(ctx, &out);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    if (size < 2)
        return 0;
    context ctx;
    context_init(&ctx);
    overlay *o = overlay_create(&ctx);
    if (!o)
        return 0;
    vec2 vertex[MOST_VERTICES];
    int32_t count = read_vertices(data + 2, size - 2, data[0] % 3, vertex);
    int32_t split = count > 0 ? data[1] % (count + 1) : 0;
    polygon a = {vertex, split}, b = {vertex + split, count - split};
    bool good_a = overlay_is_valid(o, a, NULL, NULL), good_b = overlay_is_valid(o, b, NULL, NULL);
    if (good_a)
        check_one(&ctx, o, a);
    check_repair(&ctx, o, a);
    if (good_a && good_b)
        check_two(&ctx, o, a, b);
    overlay_free(o);
    return 0;
}
