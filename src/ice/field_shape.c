/* Shapes of floes; see field_shape.h. */
#include "ice/field_shape.h"

#include "base/transcendental.h"

/* How far a corner may lie from its even place, in steps of the angle: under half, so that the order stays. */
static const double UNEVEN = 0.3;

static bool draw_convex(context *ctx, const shape_law *law, random_stream *r, vec2_array *out)
{
    int32_t span = law->most_vertices - law->least_vertices + 1;
    int32_t count = law->least_vertices + (int32_t)(random_unit(r) * span);
    double axis = 1 + (law->elongation - 1) * random_unit(r);
    for (int32_t i = 0; i < count; i++) {
        double angle = 2 * PI * (i + UNEVEN * (2 * random_unit(r) - 1)) / count;
        if (!array_push(ctx, out, (vec2){axis * real_cos(angle), real_sin(angle)}))
            return false;
    }
    return true;
}

static bool draw_template(context *ctx, const polygon_list *templates, random_stream *r, vec2_array *out)
{
    polygon p = polygon_list_get(templates, (int32_t)(random_unit(r) * polygon_list_count(templates)));
    for (int32_t i = 0; i < p.count; i++)
        if (!array_push(ctx, out, p.vertex[i]))
            return false;
    return true;
}

bool shape_draw(context *ctx, const shape_law *law, double diameter, random_stream *r, vec2_array *out)
{
    array_clear(out);
    if (law->templates ? !draw_template(ctx, law->templates, r, out) : !draw_convex(ctx, law, r, out))
        return false;
    polygon_moments m = polygon_moments_of((polygon){out->data, out->count});
    double scale = sqrt(PI / 4 / m.area) * diameter;
    for (int32_t i = 0; i < out->count; i++)
        out->data[i] = vec2_scale(vec2_sub(out->data[i], m.centroid), scale);
    return true;
}
