/* Pressure and drag on a closed mesh, triangle by triangle. */
#include "fluid/facet.h"
#include "fluid/fluid.h"

/* What is asked of one walk over the triangles. */
typedef struct mesh_walk {
    const media *media;
    const mesh *surface;
    const fluid_motion *state;
    stream water, air;
} mesh_walk;

typedef struct mesh_sums {
    pressure_sum pressure;
    wrench water, air;
} mesh_sums;

static void add_wet(const mesh_walk *w, mesh_sums *sums, const vec3 *part, int n, vec3 normal)
{
    facet_add_pressure(&sums->pressure, part, n, w->state->position.z);
    if (stream_acts(&w->water))
        facet_add_water_drag(&sums->water, &w->water, w->media, w->state->position.z, part, n, normal);
}

static void add_triangle(const mesh_walk *w, mesh_sums *sums, int32_t face)
{
    double height = w->state->position.z;
    const int32_t *v = w->surface->face.data[face].v;
    vec3 corner[3];
    for (int k = 0; k < 3; k++)
        corner[k] = mat3_mul_vec(w->state->rotation, w->surface->vertex.data[v[k]]);
    double low = fmin(corner[0].z, fmin(corner[1].z, corner[2].z)) + height;
    double high = fmax(corner[0].z, fmax(corner[1].z, corner[2].z)) + height;
    bool drags = stream_acts(&w->water) || stream_acts(&w->air);
    if (low >= 0 && !stream_acts(&w->air))
        return;
    vec3 normal = {0, 0, 0};
    if (drags)
        normal = vec3_unit(vec3_cross(vec3_sub(corner[1], corner[0]), vec3_sub(corner[2], corner[0])));
    if (high <= 0) {
        add_wet(w, sums, corner, 3, normal);
        return;
    }
    vec3 part[4];
    if (low < 0)
        add_wet(w, sums, part, triangle_clip_below(corner, -height, part), normal);
    if (stream_acts(&w->air))
        facet_add_drag(&sums->air, &w->air, part, facet_clip(corner, 3, vec3_make(0, 0, -1), height, part), normal);
}

static mesh_sums walk_mesh(const mesh_walk *w)
{
    mesh_sums sums = {0};
    for (int32_t i = 0; i < w->surface->face.count; i++)
        add_triangle(w, &sums, i);
    return sums;
}

static void take_pressure(const media *m, const pressure_sum *sum, fluid_load *load)
{
    double weight = m->water_density * m->gravity;
    load->hydrostatic.force = vec3_scale(sum->force, weight);
    load->hydrostatic.moment = vec3_scale(sum->moment, weight);
    /* The volume integral of z n_z; the lid at z = 0 adds nothing. */
    load->submerged_volume = sum->force.z;
}

void fluid_load_mesh(const media *m, const drag_coefficients *c, const mesh *surface, const fluid_motion *state,
                     fluid_load *load)
{
    mesh_sums sums = walk_mesh(&(mesh_walk){.media = m,
                                            .surface = surface,
                                            .state = state,
                                            .water = stream_of_water(m, c, state->velocity, state->angular_velocity, 0),
                                            .air = stream_of_air(m, c, state->velocity, state->angular_velocity)});
    take_pressure(m, &sums.pressure, load);
    load->water_drag = sums.water;
    load->wind_drag = sums.air;
}
