#include "vessel/hull_cone.h"

#include "base/transcendental.h"

/* The bottom keeps at least this share of the waterline's diameter: a point is no bottom. */
#define LEAST_BOTTOM 0.01

static double radius_at(const hull_particulars *p, double z) { return 0.5 * p->length + real_tan(p->flare_angle) * z; }

fram_status hull_cone_check(const hull_particulars *p, fram_error *error)
{
    if (!(fabs(p->beam - p->length) <= 1e-9 * p->length))
        return error_set(error, FRAM_ERROR_INPUT, NULL, 0, "beam",
                         "the beam of a cone must be its length, %g m, found %g m", p->length, p->beam);
    if (!(p->flare_angle >= 0 && p->flare_angle < radians(89)))
        return error_value(error, "flare_angle", "an angle from 0 to less than 89 degrees", degrees(p->flare_angle));
    double bottom = radius_at(p, -p->draught);
    if (bottom >= 0.5 * LEAST_BOTTOM * p->length)
        return FRAM_OK;
    return error_set(error, FRAM_ERROR_INPUT, NULL, 0, "flare_angle",
                     "no bottom is left: the sides meet above the draught of %g m; reduce flare_angle (%g degrees) or "
                     "draught",
                     p->draught, degrees(p->flare_angle));
}

/* Corners by symmetry, so that the hull mirrors itself to the bit. */
static bool add_cone_ring(context *ctx, mesh *m, double radius, double z)
{
    enum { QUARTER = CONE_FACETS / 4 };
    for (int i = 0; i < CONE_FACETS; i++) {
        int within = i % QUARTER;
        double a = 0.5 * PI * within / QUARTER, b = 0.5 * PI * (QUARTER - within) / QUARTER;
        double c = within == 0 ? 1 : real_cos(a), s = within == 0 ? 0 : real_cos(b);
        const vec2 turned[4] = {{c, s}, {-s, c}, {-c, -s}, {s, -c}};
        vec2 at = vec2_scale(turned[i / QUARTER], radius);
        if (!mesh_add_vertex(ctx, m, vec3_make(at.x, at.y, z)))
            return false;
    }
    return true;
}

bool hull_cone_make(context *ctx, const hull_particulars *p, mesh *m)
{
    if (!add_cone_ring(ctx, m, radius_at(p, -p->draught), -p->draught) ||
        !add_cone_ring(ctx, m, radius_at(p, p->freeboard), p->freeboard))
        return false;
    for (int32_t i = 0; i < CONE_FACETS; i++) {
        int32_t j = (i + 1) % CONE_FACETS;
        if (!mesh_add_triangle(ctx, m, i, j, CONE_FACETS + j) ||
            !mesh_add_triangle(ctx, m, i, CONE_FACETS + j, CONE_FACETS + i))
            return false;
    }
    for (int32_t i = 1; i + 1 < CONE_FACETS; i++)
        if (!mesh_add_triangle(ctx, m, 0, i + 1, i) ||
            !mesh_add_triangle(ctx, m, CONE_FACETS, CONE_FACETS + i, CONE_FACETS + i + 1))
            return false;
    return true;
}
