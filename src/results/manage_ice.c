#include "results/manage_ice.h"

#include "base/transcendental.h"

#include <math.h>

const double manage_class_size[MANAGE_CLASSES] = {1, 2, 5, 10, 20, 50, 100, 200, 500, 1000};

double manage_size(double area) { return sqrt(4 / PI * fabs(area)); }

/* Rings that a clip goes through. */
typedef struct clip_room {
    vec2_array ring[2];
} clip_room;

static void clip_free(context *ctx, clip_room *room)
{
    array_free(ctx, &room->ring[0]);
    array_free(ctx, &room->ring[1]);
}

/* The part of a floe in a window, by its four sides; parts of a concave one stay joined along them, which no area
   notices.  false: no memory. */
static bool clip(context *ctx, const manage_floe *floe, const manage_window *window, clip_room *room, polygon *out)
{
    const vec2 side[4] = {window->along, vec2_scale(window->along, -1), vec2_perp(window->along),
                          vec2_scale(vec2_perp(window->along), -1)};
    *out = floe->outline;
    for (int i = 0; i < 4 && out->count > 0; i++) {
        vec2_array *to = &room->ring[i % 2];
        double reach = vec2_dot(side[i], window->centre) + 0.5 * (i < 2 ? window->length : window->width);
        if (!polygon_clip_half_plane(ctx, *out, side[i], reach, to))
            return false;
        *out = (polygon){to->data, to->count};
    }
    return true;
}

/* Whether the box around a floe may meet a window: it does not where it lies beyond the window's circle. */
static bool near(const manage_floe *floe, const manage_window *window)
{
    double half = 0.5 * sqrt(window->length * window->length + window->width * window->width);
    return floe->box.lo.x <= window->centre.x + half && floe->box.hi.x >= window->centre.x - half &&
           floe->box.lo.y <= window->centre.y + half && floe->box.hi.y >= window->centre.y - half;
}

static void count_in(manage_cover *out, managed_cover *fine, const manage_floe *floe, double part, double limit,
                     double unit)
{
    double size = manage_size(floe->area);
    int k = 0;
    out->ice += part;
    fine->volume += part * floe->thickness;
    if (floe->sheet) {
        out->sheet += part;
        fine->sheet += part;
        return;
    }
    while (k < MANAGE_CLASSES && size > unit * manage_class_size[k])
        k++;
    out->of_class[k] += part;
    managed_cover_add(fine, size / unit, part);
    out->size_area += part * size;
    out->managed += size <= limit ? part : 0;
    out->largest = fmax(out->largest, size);
}

fram_status manage_measure(context *ctx, const manage_floe *floes, int32_t count, const manage_window *window,
                           double limit, double unit, manage_cover *out, managed_cover *fine, fram_error *error)
{
    managed_cover unasked, *bins = fine ? fine : &unasked;
    clip_room room = {{{0}, {0}}};
    double whole = window->length * window->width;
    bool good = true;
    *out = (manage_cover){0};
    *bins = (managed_cover){0};
    for (int32_t i = 0; i < count && good; i++) {
        polygon part;
        if (!near(&floes[i], window))
            continue;
        good = clip(ctx, &floes[i], window, &room, &part);
        double area = good ? fabs(polygon_area(part)) : 0;
        if (area > 0)
            count_in(out, bins, &floes[i], area / whole, limit, unit);
    }
    clip_free(ctx, &room);
    return good ? FRAM_OK : error_memory(error);
}

/* Part of a strip's length, and of its place, that rounding may put ice at its near end beyond it. */
#define WAY_ROUNDING 1e-12

/* Way from the near end of a strip to the nearest point of a ring, which was cut at that end. */
static double way_to(const manage_window *strip, polygon ring)
{
    double least = HUGE_VAL, begin = vec2_dot(strip->along, strip->centre) - 0.5 * strip->length;
    for (int32_t i = 0; i < ring.count; i++)
        least = fmin(least, vec2_dot(strip->along, ring.vertex[i]) - begin);
    return least > WAY_ROUNDING * (fabs(begin) + strip->length) ? least : 0;
}

fram_status manage_threat_in(context *ctx, const manage_floe *floes, int32_t count, const manage_window *strip,
                             double limit, manage_threat *out, fram_error *error)
{
    clip_room room = {{{0}, {0}}};
    bool good = true;
    *out = (manage_threat){HUGE_VAL, HUGE_VAL, 0};
    for (int32_t i = 0; i < count && good; i++) {
        polygon part;
        double size = floes[i].sheet ? HUGE_VAL : manage_size(floes[i].area);
        if (size <= limit || !near(&floes[i], strip))
            continue;
        good = clip(ctx, &floes[i], strip, &room, &part);
        if (!good || part.count == 0)
            continue;
        double way = way_to(strip, part);
        out->nearest = fmin(out->nearest, way);
        if (size > out->size || (size == out->size && way < out->largest)) {
            out->size = size;
            out->largest = way;
        }
    }
    clip_free(ctx, &room);
    return good ? FRAM_OK : error_memory(error);
}
