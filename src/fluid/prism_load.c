/* Pressure and drag on a prism without building its mesh: caps as signed fans about the outline's centroid, sides as
   quadrilaterals; buoyancy in closed form while the water plane cuts no corner. */
#include "fluid/facet.h"
#include "fluid/fluid.h"

/* How the water plane meets the prism. */
typedef enum immersion {
    IMMERSION_DRY,      /* above it */
    IMMERSION_FLOATING, /* it cuts the sides only: one cap wholly wet, the other wholly dry */
    IMMERSION_CUT,      /* it cuts a cap */
    IMMERSION_SUBMERGED /* below it */
} immersion;

typedef struct prism_walk {
    polygon outline;
    polygon_moments moments;
    mat3 rotation;
    double height;      /* of the centre of mass over still water [m] */
    double half_height; /* [m] */
    vec3 up;            /* from the middle plane to the top cap, global axes [m] */
    bool pressure;      /* sum pressure over the facets */
    bool wet, dry;      /* parts whose drag is wanted */
    stream water, air;
    pressure_sum pressure_sum;
    wrench water_drag, air_drag;
} prism_walk;

/* A point of the middle plane relative to the centre of mass, global axes. */
static vec3 middle(const prism_walk *w, vec2 p)
{
    const double(*r)[3] = w->rotation.m;
    return (vec3){r[0][0] * p.x + r[0][1] * p.y, r[1][0] * p.x + r[1][1] * p.y, r[2][0] * p.x + r[2][1] * p.y};
}

static immersion find_immersion(const prism_walk *w)
{
    double rise = fabs(w->up.z), lowest = HUGE_VAL, highest = -HUGE_VAL;
    for (int32_t i = 0; i < w->outline.count; i++) {
        double z = w->height + middle(w, w->outline.vertex[i]).z;
        lowest = fmin(lowest, z);
        highest = fmax(highest, z);
    }
    if (lowest - rise >= 0)
        return IMMERSION_DRY;
    if (highest + rise <= 0)
        return IMMERSION_SUBMERGED;
    return lowest + rise >= 0 && highest - rise <= 0 ? IMMERSION_FLOATING : IMMERSION_CUT;
}

/* Submerged volume and its first moments, body frame. */
typedef struct volume_moments {
    double volume; /* [m3] */
    vec3 first;    /* [m4] */
} volume_moments;

/* The columns over the outline reach from the wet cap to the water plane at h + s x + t y of the body's z, x and y from
   the centroid: integrals of their length, of x and y times it, and of half the difference of squares of their ends. */
static volume_moments floating_volume(const prism_walk *w)
{
    const polygon_moments *m = &w->moments;
    const double *row = w->rotation.m[2];
    double side = row[2] > 0 ? 1 : -1; /* which way the submerged part lies: below the plane, or above when capsized */
    double h = -(w->height + row[0] * m->centroid.x + row[1] * m->centroid.y) / row[2];
    double s = -row[0] / row[2], t = -row[1] / row[2];
    double volume = m->area * (w->half_height + side * h);
    double x = side * (s * m->yy + t * m->xy), y = side * (s * m->xy + t * m->xx);
    double squares =
        m->area * (h * h - w->half_height * w->half_height) + s * (s * m->yy + t * m->xy) + t * (s * m->xy + t * m->xx);
    return (volume_moments){volume, {m->centroid.x * volume + x, m->centroid.y * volume + y, 0.5 * side * squares}};
}

static volume_moments whole_volume(const prism_walk *w)
{
    double volume = 2 * w->half_height * w->moments.area;
    return (volume_moments){volume, {w->moments.centroid.x * volume, w->moments.centroid.y * volume, 0}};
}

/* Weight of the displaced water, upward through its centre. */
static pressure_sum pressure_of_volume(const prism_walk *w, volume_moments v)
{
    vec3 first = mat3_mul_vec(w->rotation, v.first);
    return (pressure_sum){{0, 0, v.volume}, {first.y, -first.x, 0}};
}

static void add_wet_part(prism_walk *w, const vec3 *part, int n, vec3 normal)
{
    if (w->pressure)
        facet_add_pressure(&w->pressure_sum, part, n, w->height);
    if (w->wet)
        facet_add_drag(&w->water_drag, &w->water, part, n, normal);
}

/* A triangle or quadrilateral of the surface, cut at the water plane. */
static void add_facet(prism_walk *w, const vec3 *vertex, int n, vec3 normal)
{
    double low = HUGE_VAL, high = -HUGE_VAL;
    for (int i = 0; i < n; i++) {
        low = fmin(low, vertex[i].z + w->height);
        high = fmax(high, vertex[i].z + w->height);
    }
    if (high <= 0) {
        add_wet_part(w, vertex, n, normal);
    } else if (low >= 0) {
        if (w->dry)
            facet_add_drag(&w->air_drag, &w->air, vertex, n, normal);
    } else {
        vec3 part[FACET_VERTICES];
        if (w->pressure || w->wet)
            add_wet_part(w, part, facet_clip(vertex, n, vec3_make(0, 0, 1), -w->height, part), normal);
        if (w->dry)
            facet_add_drag(&w->air_drag, &w->air, part, facet_clip(vertex, n, vec3_make(0, 0, -1), w->height, part),
                           normal);
    }
}

/* All faces; per edge of the outline its side and one triangle of each cap. */
static void walk_faces(prism_walk *w)
{
    vec3 axis = mat3_column(w->rotation, 2);
    vec3 centre = middle(w, w->moments.centroid);
    vec3 top_centre = vec3_add(centre, w->up), bottom_centre = vec3_sub(centre, w->up);
    vec2 from = w->outline.vertex[w->outline.count - 1];
    vec3 a = middle(w, from);
    for (int32_t i = 0; i < w->outline.count; i++) {
        vec2 to = w->outline.vertex[i], edge = vec2_sub(to, from);
        vec3 b = middle(w, to);
        const vec3 side[4] = {vec3_sub(a, w->up), vec3_sub(b, w->up), vec3_add(b, w->up), vec3_add(a, w->up)};
        const vec3 top[3] = {top_centre, side[3], side[2]}, bottom[3] = {bottom_centre, side[1], side[0]};
        add_facet(w, side, 4, vec3_unit(middle(w, vec2_make(edge.y, -edge.x))));
        add_facet(w, top, 3, axis);
        add_facet(w, bottom, 3, vec3_neg(axis));
        from = to;
        a = b;
    }
}

void fluid_load_prism(const media *m, const drag_coefficients *c, polygon outline, double half_height,
                      const fluid_motion *state, fluid_load *load)
{
    prism_walk w = {.outline = outline,
                    .moments = polygon_moments_of(outline),
                    .rotation = state->rotation,
                    .height = state->position.z,
                    .half_height = half_height,
                    .up = vec3_scale(mat3_column(state->rotation, 2), half_height),
                    .water =
                        stream_of_water(m, c, state->velocity, state->angular_velocity,
                                        prism_current_height(state->position.z, half_height * state->rotation.m[2][2])),
                    .air = stream_of_air(m, c, state->velocity, state->angular_velocity)};
    immersion kind = find_immersion(&w);
    w.pressure = kind == IMMERSION_CUT;
    w.wet = kind != IMMERSION_DRY && stream_acts(&w.water);
    w.dry = kind != IMMERSION_SUBMERGED && stream_acts(&w.air);
    if (w.pressure || w.wet || w.dry)
        walk_faces(&w);
    if (kind == IMMERSION_FLOATING)
        w.pressure_sum = pressure_of_volume(&w, floating_volume(&w));
    if (kind == IMMERSION_SUBMERGED)
        w.pressure_sum = pressure_of_volume(&w, whole_volume(&w));

    double weight = m->water_density * m->gravity;
    load->hydrostatic.force = vec3_scale(w.pressure_sum.force, weight);
    load->hydrostatic.moment = vec3_scale(w.pressure_sum.moment, weight);
    load->submerged_volume = w.pressure_sum.force.z;
    load->water_drag = w.water_drag;
    load->wind_drag = w.air_drag;
}
