/* What a field of outlines is: sizes, overlaps, histogram. */
#include "ice/import_parts.h"

#include "base/transcendental.h"

#include <math.h>

/* The shorter side of the box around it. */
static fram_status box_width(context *ctx, polygon p, double *width, fram_error *error)
{
    oriented_box box;
    if (polygon_oriented_box(ctx, p, &box) != FRAM_OK)
        return error_memory(error);
    *width = box.sides[1];
    return FRAM_OK;
}

/* The shorter side of the rectangle of its area and perimeter. */
static double strip_width(polygon p)
{
    double area = polygon_area(p), perimeter = polygon_perimeter(p);
    return 4 * area / (perimeter + sqrt(fmax(0, perimeter * perimeter - 16 * area)));
}

/* That of the widest of its convex pieces, as of a tooth on a sliver that goes round a corner; of all of it where that
   is more: pieces of one with hollow sides are narrow. */
static fram_status part_width(context *ctx, overlay *o, polygon p, double *width, fram_error *error)
{
    polygon_list pieces = {0};
    fram_status status = box_width(ctx, p, width, error);
    *width = fmin(*width, strip_width(p));
    if (status == FRAM_OK)
        status = overlay_convex_pieces(o, p, 0, p.count, &pieces, NULL, error);
    for (int32_t i = 0; status == FRAM_OK && i < polygon_list_count(&pieces); i++) {
        double piece = 0;
        status = box_width(ctx, polygon_list_get(&pieces, i), &piece, error);
        *width = fmax(*width, piece);
    }
    polygon_list_free(ctx, &pieces);
    return status;
}

/* The largest width of the parts that two outlines have in common. */
static fram_status common_width(context *ctx, overlay *o, polygon a, polygon b, double *width, fram_error *error)
{
    polygon_list common = {0};
    fram_status status = overlay_intersection(o, a, b, &common, error);
    for (int32_t i = 0; status == FRAM_OK && i < polygon_list_count(&common); i++) {
        double part = 0;
        status = part_width(ctx, o, polygon_list_get(&common, i), &part, error);
        *width = fmax(*width, part);
    }
    polygon_list_free(ctx, &common);
    return status;
}

static fram_status measure_overlaps(context *ctx, overlay *o, const char *name, const polygon_list *outlines,
                                    import_measure *out, fram_error *error)
{
    import_pair_array pairs = {0};
    fram_status status = import_pairs(ctx, name, outlines, &pairs, error);
    out->overlaps = pairs.count;
    for (int32_t i = 0; status == FRAM_OK && i < pairs.count; i++) {
        const import_pair *p = &pairs.data[i];
        status = work_continue(ctx, "measuring overlaps", i, pairs.count, error);
        if (status != FRAM_OK)
            break;
        out->overlap_area += p->area;
        if (p->area > out->largest_overlap) {
            out->largest_overlap = p->area;
            out->overlap_pair[0] = p->a;
            out->overlap_pair[1] = p->b;
        }
        status = common_width(ctx, o, polygon_list_get(outlines, p->a), polygon_list_get(outlines, p->b),
                              &out->overlap_width, error);
    }
    array_free(ctx, &pairs);
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

fram_status import_field_measure(context *ctx, overlay *o, const char *name, const polygon_list *outlines,
                                 import_measure *out, fram_error *error)
{
    *out = (import_measure){
        .floes = polygon_list_count(outlines), .vertices = outlines->vertex.count, .overlap_pair = {-1, -1}};
    if (out->floes == 0)
        return FRAM_OK;
    out->bounds = polygon_bounds((polygon){outlines->vertex.data, outlines->vertex.count});
    out->smallest_area = HUGE_VAL;
    for (int32_t i = 0; i < out->floes; i++) {
        polygon p = polygon_list_get(outlines, i);
        double area = polygon_area(p), diameter;
        if (!polygon_farthest_apart(ctx, p, &diameter))
            return error_memory(error);
        out->area += area;
        out->smallest_area = fmin(out->smallest_area, area);
        out->largest_area = fmax(out->largest_area, area);
        out->largest_diameter = fmax(out->largest_diameter, diameter);
        out->concave += !polygon_is_convex(p);
    }
    count_sizes(outlines, out);
    return measure_overlaps(ctx, o, name, outlines, out, error);
}
