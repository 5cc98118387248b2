/* Circumferential cracks: the stencil of 2 N wedges around the load, what it leaves of the floe, and the wedges
   (Metrikin 2014, 5.5.3). */
#include "ice/fracture_parts.h"

#include "base/transcendental.h"

double fracture_wedge_side(const fracture_settings *f, double radius)
{
    return f->radius_along == RADIUS_ALONG_AXES ? radius / real_cos(PI / (2.0 * f->wedges)) : radius;
}

int fracture_stencil(int32_t wedges, double side, const crack_start *start, vec2 out[MOST_STENCIL])
{
    int count = 2 * wedges;
    for (int i = 0; i < count; i++) {
        double angle = PI * i / wedges, c = side * real_cos(angle), s = side * real_sin(angle);
        vec2 d = start->direction;
        out[i] = (vec2){start->point.x + c * d.x - s * d.y, start->point.y + c * d.y + s * d.x};
    }
    return count;
}

/* The stencil of a narrow load moved apart by the width of the contact, half of the wedges to either side, and the
   strip between them. */
static void make_wide(int32_t wedges, const crack_start *start, const break_size *size, break_shape *out)
{
    vec2 d = start->direction, aside = vec2_scale((vec2){-d.y, d.x}, size->width / 2), narrow[MOST_STENCIL] = {{0, 0}};
    int count = fracture_stencil(wedges, size->side, start, narrow);
    vec2 end = vec2_scale(d, size->strip_length), back = vec2_scale(d, -size->side), s = start->point;
    vec2 left = vec2_add(s, aside), right = vec2_sub(s, aside);
    out->count = out->parts = 0;
    out->outline[out->count++] = vec2_add(left, end);
    for (int i = 0; i <= wedges; i++)
        out->outline[out->count++] = vec2_add(narrow[i], aside);
    for (int i = wedges; i <= count; i++)
        out->outline[out->count++] = vec2_sub(narrow[i < count ? i : 0], aside);
    out->outline[out->count++] = vec2_add(right, end);
    for (int i = 0; i < count; i++) {
        bool is_left = i < wedges;
        vec2 shift = is_left ? aside : vec2_scale(aside, -1);
        vec2 *at = out->part[out->parts];
        at[0] = is_left ? left : right;
        at[1] = vec2_add(narrow[i], shift);
        at[2] = vec2_add(narrow[i + 1 < count ? i + 1 : 0], shift);
        out->corners[out->parts++] = 3;
    }
    vec2 *at = out->part[out->parts];
    at[0] = vec2_add(right, back);
    at[1] = vec2_add(right, end);
    at[2] = vec2_add(left, end);
    at[3] = vec2_add(left, back);
    out->corners[out->parts++] = 4;
}

void fracture_shape(int32_t wedges, const crack_start *start, const break_size *size, break_shape *out)
{
    if (size->width > 0) {
        make_wide(wedges, start, size, out);
        return;
    }
    out->count = out->parts = fracture_stencil(wedges, size->side, start, out->outline);
    for (int i = 0; i < out->count; i++) {
        out->part[i][0] = start->point;
        out->part[i][1] = out->outline[i];
        out->part[i][2] = out->outline[i + 1 < out->count ? i + 1 : 0];
        out->corners[i] = 3;
    }
}

/* A wedge that has no more than this part of it inside the ring, or outside, is not cut at all: most are not. */
static const double NOTHING = 1e-13;

fram_status fracture_cut_wedge(context *ctx, overlay *plane, polygon ring, bool convex, polygon corner,
                               polygon_list *wedges, fram_error *error)
{
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

fram_status fracture_bend(context *ctx, overlay *plane, const break_shape *shape, polygon ring, polygon_list *remnants,
                          polygon_list *wedges, fram_error *error)
{
    bool convex = polygon_is_convex(ring);
    fram_status status = overlay_difference(plane, ring, (polygon){shape->outline, shape->count}, remnants, error);
    for (int i = 0; i < shape->parts && status == FRAM_OK; i++)
        status =
            fracture_cut_wedge(ctx, plane, ring, convex, (polygon){shape->part[i], shape->corners[i]}, wedges, error);
    return status;
}
