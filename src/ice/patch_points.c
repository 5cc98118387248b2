#include "ice/patch_points.h"

/* Patches narrower than this part of their length get two points instead of four. */
static const double NARROW_PATCH = 0.01;

/* Up to this |normal . z| the first axis of a patch is level: beyond it the level direction is lost in rounding. */
static const double STEEP_NORMAL = 0.9;

/* Unit vectors that span the plane of a patch, floe frame: the first one level as long as the patch is not, so that
   points keep their places while the normal wavers about any direction but one. */
static void patch_axes(vec3 normal, vec3 *t1, vec3 *t2)
{
    vec3 up = fabs(normal.z) < STEEP_NORMAL ? (vec3){0, 0, 1} : (vec3){1, 0, 0};
    *t1 = vec3_unit(vec3_cross(up, normal));
    *t2 = vec3_cross(normal, *t1);
}

static double spread_along(sym3 c, vec3 a, vec3 b) { return vec3_dot(a, sym3_mul_vec(c, b)); }

/* Squares of the lengths of gyration in the plane, and the axis of the larger one. */
typedef struct patch_ellipse {
    double longer, shorter;
    vec3 axis;
} patch_ellipse;

static patch_ellipse ellipse_of(double xx, double yy, double xy, vec3 t1, vec3 t2)
{
    double middle = 0.5 * (xx + yy), half = sqrt(0.25 * (xx - yy) * (xx - yy) + xy * xy);
    vec3 axis = xx >= yy ? vec3_mad(vec3_scale(t1, half + 0.5 * (xx - yy)), t2, xy)
                         : vec3_mad(vec3_scale(t2, half + 0.5 * (yy - xx)), t1, xy);
    return (patch_ellipse){middle + half, fmax(xx * yy - xy * xy, 0) / (middle + half), vec3_unit(axis)};
}

static int two_points(vec3 centre, vec3 along, vec3 out[PATCH_MOST_POINTS])
{
    out[0] = vec3_add(centre, along);
    out[1] = vec3_sub(centre, along);
    return 2;
}

int patch_points(const patch_component *c, vec3 normal, double small, vec3 out[PATCH_MOST_POINTS])
{
    vec3 t1, t2;
    patch_axes(normal, &t1, &t2);
    double xx = spread_along(c->spread, t1, t1), yy = spread_along(c->spread, t2, t2),
           xy = spread_along(c->spread, t1, t2);
    double root = sqrt(fmax(xx * yy - xy * xy, 0)), trace = sqrt(fmax(xx + yy + 2 * root, 0));
    out[0] = c->centre;
    if (!(trace > 0))
        return 1;
    patch_ellipse e = ellipse_of(xx, yy, xy, t1, t2);
    if (e.longer < small * small)
        return 1;
    vec3 s1 = vec3_add(vec3_scale(t1, (xx + root) / trace), vec3_scale(t2, xy / trace));
    vec3 s2 = vec3_add(vec3_scale(t1, xy / trace), vec3_scale(t2, (yy + root) / trace));
    if (root < NARROW_PATCH * (xx + yy)) {
        vec3 along = xx >= yy ? s1 : s2;
        along = vec3_scale(vec3_unit(along), sqrt(xx + yy));
        return two_points(c->centre, along, out);
    }
    if (e.shorter < small * small)
        return two_points(c->centre, vec3_scale(e.axis, sqrt(e.longer)), out);
    for (int i = 0; i < 4; i++)
        out[i] = vec3_add(c->centre, vec3_add(vec3_scale(s1, i & 1 ? -1 : 1), vec3_scale(s2, i & 2 ? -1 : 1)));
    return 4;
}
