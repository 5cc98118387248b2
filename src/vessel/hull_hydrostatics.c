/* What floats of a closed mesh, by surface integrals over its wet part. */
#include "vessel/hull.h"

/* Largest difference of the three volume integrals, relative to the volume. */
#define CLOSED_TOLERANCE 1e-6
/* What rounding may leave of a volume, relative to the box around the mesh. */
#define VOLUME_ROUNDING 1e-12

/* Surface integrals over the wet part, n its unit normal, z counted from the level.  With the water plane as its lid
   the part is closed, and the lid adds nothing to those with a factor z. */
typedef struct wet_sums {
    vec3 volume;               /* int x n_x, y n_y, z n_z dS */
    double first_x, first_y;   /* int x z n_z, y z n_z dS: first moments of volume */
    double first_z;            /* int z^2/2 n_z dS */
    double plane;              /* -int n_z dS: area of the water plane */
    double plane_x, plane_y;   /* -int x n_z, y n_z dS */
    double plane_xx, plane_yy; /* -int x^2 n_z, y^2 n_z dS */
    double plane_xy;           /* -int x y n_z dS */
    double wetted;             /* int dS */
    box2 line;                 /* around the points on the level */
} wet_sums;

static double sum3(const double f[3]) { return f[0] + f[1] + f[2]; }

/* Twelve times the mean over a triangle of the product of two linear functions, by their values at the corners. */
static double product12(const double f[3], const double g[3])
{
    return f[0] * g[0] + f[1] * g[1] + f[2] * g[2] + sum3(f) * sum3(g);
}

static void add_triangle(wet_sums *s, vec3 a, vec3 b, vec3 c)
{
    vec3 area = vec3_scale(vec3_cross(vec3_sub(b, a), vec3_sub(c, a)), 0.5);
    const double x[3] = {a.x, b.x, c.x}, y[3] = {a.y, b.y, c.y}, z[3] = {a.z, b.z, c.z};
    double third = area.z / 3, twelfth = area.z / 12;
    s->volume.x += sum3(x) * area.x / 3;
    s->volume.y += sum3(y) * area.y / 3;
    s->volume.z += sum3(z) * third;
    s->first_x += product12(x, z) * twelfth;
    s->first_y += product12(y, z) * twelfth;
    s->first_z += 0.5 * product12(z, z) * twelfth;
    s->plane -= area.z;
    s->plane_x -= sum3(x) * third;
    s->plane_y -= sum3(y) * third;
    s->plane_xx -= product12(x, x) * twelfth;
    s->plane_yy -= product12(y, y) * twelfth;
    s->plane_xy -= product12(x, y) * twelfth;
    s->wetted += vec3_length(area);
}

static void add_line_point(wet_sums *s, vec3 p)
{
    if (p.z != 0)
        return;
    s->line.lo = vec2_make(fmin(s->line.lo.x, p.x), fmin(s->line.lo.y, p.y));
    s->line.hi = vec2_make(fmax(s->line.hi.x, p.x), fmax(s->line.hi.y, p.y));
}

static wet_sums sum_wet(const mesh *m, double level)
{
    wet_sums sums = {.line = {{HUGE_VAL, HUGE_VAL}, {-HUGE_VAL, -HUGE_VAL}}};
    for (int32_t i = 0; i < m->face.count; i++) {
        vec3 corner[3], part[4];
        for (int k = 0; k < 3; k++) {
            corner[k] = m->vertex.data[m->face.data[i].v[k]];
            corner[k].z -= level;
        }
        int n = triangle_clip_below(corner, 0, part);
        for (int k = 1; k + 1 < n; k++)
            add_triangle(&sums, part[0], part[k], part[k + 1]);
        for (int k = 0; k < n && n > 2; k++)
            add_line_point(&sums, part[k]);
    }
    return sums;
}

static fram_status check_closed(const mesh *m, const wet_sums *s, double level, fram_error *error)
{
    box3 box = mesh_bounds(m);
    vec3 size = vec3_sub(box.hi, box.lo), v = s->volume;
    double most = fmax(v.x, fmax(v.y, v.z)), least = fmin(v.x, fmin(v.y, v.z));
    double scale = fmax(fabs(most), fabs(least));
    if (most - least <= CLOSED_TOLERANCE * scale + VOLUME_ROUNDING * size.x * size.y * size.z)
        return FRAM_OK;
    return error_set(
        error, FRAM_ERROR_INPUT, NULL, 0, "mesh",
        "the surface is not closed below z = %g m: its volume integrals along x, y and z are %.9g, %.9g and %.9g "
        "m3; close or weld the mesh",
        level, v.x, v.y, v.z);
}

fram_status hull_hydrostatics_at(context *ctx, const mesh *surface, double level, hull_hydrostatics *out,
                                 fram_error *error)
{
    (void)ctx;
    wet_sums s = sum_wet(surface, level);
    fram_status status = check_closed(surface, &s, level, error);
    if (status != FRAM_OK)
        return status;
    *out = (hull_hydrostatics){0};
    if (s.volume.z > 0) {
        out->volume = s.volume.z;
        out->centre_of_buoyancy = vec3_scale(vec3_make(s.first_x, s.first_y, s.first_z), 1 / s.volume.z);
        out->centre_of_buoyancy.z += level;
        out->wetted_area = s.wetted;
        out->volume_integrals = s.volume;
    }
    /* A hull wholly under the level has no water plane but for rounding. */
    if (s.plane > 0 && mesh_bounds(surface).hi.z > level) {
        double x = s.plane_x / s.plane, y = s.plane_y / s.plane;
        out->waterplane_area = s.plane;
        out->centre_of_flotation = vec2_make(x, y);
        out->waterplane_xx = s.plane_yy - s.plane * y * y;
        out->waterplane_yy = s.plane_xx - s.plane * x * x;
        out->waterplane_xy = s.plane_xy - s.plane * x * y;
        out->waterline = s.line;
    }
    return FRAM_OK;
}
