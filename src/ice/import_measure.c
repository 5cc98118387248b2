/* What a field of outlines is: sizes, overlaps, histogram. */
#include "ice/import.h"

#include "base/transcendental.h"

#include <math.h>
#include <stdlib.h>

/* Common area under this part of the areas of both outlines is rounding (polygon_overlap_area: about 1e-15). */
#define OVERLAP_ROUNDING 1e-12

typedef struct sweep_entry {
    box2 box;
    int32_t outline;
} sweep_entry;

static int by_left_end(const void *a, const void *b)
{
    const sweep_entry *p = a, *q = b;
    if (p->box.lo.x != q->box.lo.x)
        return p->box.lo.x < q->box.lo.x ? -1 : 1;
    return (p->outline > q->outline) - (p->outline < q->outline);
}

/* The least width of what two outlines have in common. */
static fram_status common_width(context *ctx, overlay *o, polygon a, polygon b, double *width, fram_error *error)
{
    polygon_list common = {0};
    fram_status status = overlay_intersection(o, a, b, &common, error);
    for (int32_t i = 0; status == FRAM_OK && i < polygon_list_count(&common); i++) {
        oriented_box box;
        status = polygon_oriented_box(ctx, polygon_list_get(&common, i), &box);
        if (status == FRAM_OK)
            *width = fmax(*width, box.sides[1]);
        else
            error_memory(error);
    }
    polygon_list_free(ctx, &common);
    return status;
}

static fram_status measure_pair(context *ctx, overlay *o, const polygon_list *outlines, int32_t i, int32_t k,
                                import_measure *out, fram_error *error)
{
    polygon a = polygon_list_get(outlines, i < k ? i : k), b = polygon_list_get(outlines, i < k ? k : i);
    double area = polygon_overlap_area(a, b);
    if (!(area > OVERLAP_ROUNDING * (polygon_area(a) + polygon_area(b))))
        return FRAM_OK;
    out->overlaps++;
    out->overlap_area += area;
    if (area > out->largest_overlap) {
        out->largest_overlap = area;
        out->overlap_pair[0] = i < k ? i : k;
        out->overlap_pair[1] = i < k ? k : i;
    }
    return common_width(ctx, o, a, b, &out->overlap_width, error);
}

/* Pairs whose boxes meet, by a sweep along x. */
static fram_status measure_overlaps(context *ctx, overlay *o, const polygon_list *outlines, import_measure *out,
                                    fram_error *error)
{
    int32_t count = polygon_list_count(outlines);
    sweep_entry *entry = memory_array(ctx, (size_t)count, sizeof *entry);
    if (!entry)
        return error_memory(error);
    for (int32_t i = 0; i < count; i++)
        entry[i] = (sweep_entry){polygon_bounds(polygon_list_get(outlines, i)), i};
    qsort(entry, (size_t)count, sizeof *entry, by_left_end);
    fram_status status = FRAM_OK;
    for (int32_t i = 0; i < count; i++) {
        for (int32_t k = i + 1; status == FRAM_OK && k < count && entry[k].box.lo.x < entry[i].box.hi.x; k++) {
            if (entry[k].box.lo.y < entry[i].box.hi.y && entry[i].box.lo.y < entry[k].box.hi.y)
                status = measure_pair(ctx, o, outlines, entry[i].outline, entry[k].outline, out, error);
        }
    }
    memory_free(ctx, entry);
    return status;
}

static double equivalent_diameter(double area) { return sqrt(4 * area / PI); }

/* Octaves down from the first power of two that no floe exceeds; the first bin holds all that are smaller. */
static void count_sizes(const polygon_list *outlines, import_measure *out)
{
    double top = 1, largest = equivalent_diameter(out->largest_area);
    while (top < largest)
        top *= 2;
    while (top / 2 >= largest)
        top /= 2;
    for (int k = IMPORT_HISTOGRAM_BINS; k > 0; k--, top /= 2)
        out->edge[k] = top;
    out->edge[0] = 0;
    for (int32_t i = 0; i < out->floes; i++) {
        double diameter = equivalent_diameter(polygon_area(polygon_list_get(outlines, i)));
        int k = 0;
        while (k < IMPORT_HISTOGRAM_BINS - 1 && diameter > out->edge[k + 1])
            k++;
        out->bin[k]++;
    }
}

fram_status import_field_measure(context *ctx, overlay *o, const polygon_list *outlines, import_measure *out,
                                 fram_error *error)
{
    *out = (import_measure){
        .floes = polygon_list_count(outlines), .vertices = outlines->vertex.count, .overlap_pair = {-1, -1}};
    if (out->floes == 0)
        return FRAM_OK;
    out->bounds = polygon_bounds((polygon){outlines->vertex.data, outlines->vertex.count});
    out->smallest_area = HUGE_VAL;
    for (int32_t i = 0; i < out->floes; i++) {
        polygon p = polygon_list_get(outlines, i);
        double area = polygon_area(p);
        out->area += area;
        out->smallest_area = fmin(out->smallest_area, area);
        out->largest_area = fmax(out->largest_area, area);
        out->largest_diameter = fmax(out->largest_diameter, polygon_diameter(p));
        out->concave += !polygon_is_convex(p);
    }
    count_sizes(outlines, out);
    return measure_overlaps(ctx, o, outlines, out, error);
}
