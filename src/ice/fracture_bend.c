/* Circumferential cracks: the stencil of 2 N wedges around the load, what it leaves of the floe, and the wedges
   (Metrikin 2014, 5.5.3). */
#include "ice/fracture_parts.h"

#include "base/transcendental.h"

int fracture_stencil(int32_t wedges, double radius, const crack_start *start, vec2 out[MOST_STENCIL])
{
    int count = 2 * wedges;
    for (int i = 0; i < count; i++) {
        double angle = PI * i / wedges, c = radius * real_cos(angle), s = radius * real_sin(angle);
        vec2 d = start->direction;
        out[i] = (vec2){start->point.x + c * d.x - s * d.y, start->point.y + c * d.y + s * d.x};
    }
    return count;
}

/* A wedge that has no more than this part of it inside the ring, or outside, is not cut at all: most are not. */
static const double NOTHING = 1e-13;

fram_status fracture_cut_wedge(context *ctx, overlay *plane, polygon ring, bool convex, const vec2 tip[3],
                               polygon_list *wedges, fram_error *error)
{
    polygon corner = {tip, 3};
    if (!convex) {
        double area = polygon_area(corner), common = polygon_overlap_area(ring, corner);
        if (common <= NOTHING * area)
            return FRAM_OK;
        if (area - common <= NOTHING * area)
            return polygon_list_push(ctx, wedges, corner) ? FRAM_OK : error_memory(error);
        return overlay_intersection(plane, ring, corner, wedges, error);
    }
    vec2_array part = {0};
    bool good = polygon_clip_convex(ctx, ring, corner, &part);
    if (good && part.count >= 3)
        good = polygon_list_push(ctx, wedges, (polygon){part.data, part.count});
    array_free(ctx, &part);
    return good ? FRAM_OK : error_memory(error);
}

fram_status fracture_bend(context *ctx, overlay *plane, const fracture_settings *settings, double radius, polygon ring,
                          const crack_start *start, polygon_list *remnants, polygon_list *wedges, fram_error *error)
{
    vec2 stencil[MOST_STENCIL];
    int count = fracture_stencil(settings->wedges, radius, start, stencil);
    bool convex = polygon_is_convex(ring);
    fram_status status = overlay_difference(plane, ring, (polygon){stencil, count}, remnants, error);
    for (int i = 0; i < count && status == FRAM_OK; i++) {
        const vec2 tip[3] = {start->point, stencil[i], stencil[i + 1 < count ? i + 1 : 0]};
        status = fracture_cut_wedge(ctx, plane, ring, convex, tip, wedges, error);
    }
    return status;
}
