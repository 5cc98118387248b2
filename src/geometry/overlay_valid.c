/* Is a ring a valid polygon, and if not, why and where? */
#include "geometry/overlay_geos.h"
#include "geometry/predicate.h"
#include <stdio.h>

/* A point that the edges i and j of p, which touch, have in common (to rounding). */
static vec2 common_point(polygon p, int32_t i, int32_t j)
{
    vec2 a = p.vertex[i], b = p.vertex[(i + 1) % p.count], c = p.vertex[j], d = p.vertex[(j + 1) % p.count];
    if (segment_contains(c, d, a))
        return a;
    if (segment_contains(c, d, b))
        return b;
    if (segment_contains(a, b, c))
        return c;
    double side_a = vec2_cross(vec2_sub(d, c), vec2_sub(a, c)), side_b = vec2_cross(vec2_sub(d, c), vec2_sub(b, c));
    return side_a == side_b ? d : vec2_add(a, vec2_scale(vec2_sub(b, a), side_a / (side_a - side_b)));
}

static bool refuse(char reason[OVERLAY_REASON_SIZE], vec2 *place, vec2 where, const char *why)
{
    if (reason)
        snprintf(reason, OVERLAY_REASON_SIZE, "%s", why);
    if (place)
        *place = where;
    return false;
}

bool overlay_is_valid(overlay *o, polygon p, char reason[OVERLAY_REASON_SIZE], vec2 *place)
{
    char text[OVERLAY_REASON_SIZE];
    int32_t a, b;
    for (int32_t i = 0; i < p.count; i++)
        if (!isfinite(p.vertex[i].x) || !isfinite(p.vertex[i].y)) {
            snprintf(text, sizeof text, "vertex %d is not finite", (int)i);
            return refuse(reason, place, p.vertex[i], text);
        }
    if (p.count < 3)
        return refuse(reason, place, p.count > 0 ? p.vertex[0] : vec2_make(0, 0), "fewer than 3 vertices");
    if (polygon_self_intersects(o->ctx, p, &a, &b)) {
        vec2 where = common_point(p, a, b);
        snprintf(text, sizeof text, "edges %d and %d meet at (%.9g, %.9g)", (int)a, (int)b, where.x, where.y);
        return refuse(reason, place, where, text);
    }
    int turn = polygon_orientation(p);
    if (turn <= 0)
        return refuse(reason, place, p.vertex[0], turn < 0 ? "the vertices run clockwise" : "no area");
    return true;
}

fram_status overlay_check(overlay *o, polygon p, const char *role, fram_error *error)
{
    char reason[OVERLAY_REASON_SIZE];
    if (overlay_is_valid(o, p, reason, NULL))
        return FRAM_OK;
    return error_set(error, FRAM_ERROR_INPUT, NULL, 0, NULL, "%s is no valid polygon: %s", role, reason);
}
