#include "fluid/prism_pack.h"

#include "fluid/facet.h"

static drag_coefficients half_of(const media *m, const drag_coefficients *c)
{
    double water = 0.5 * m->water_density, air = 0.5 * m->air_density;
    return (drag_coefficients){water * c->water_form, water * c->water_skin, air * c->air_form, air * c->air_skin};
}

prism_work prism_work_of(const media *m, const drag_coefficients coefficients[MATERIAL_COUNT], const body_table *bodies,
                         const shape_store *shapes)
{
    prism_work w = {.media = m, .bodies = bodies, .shapes = shapes};
    for (int i = 0; i < MATERIAL_COUNT; i++) {
        const drag_coefficients *c = &w.half[i];
        w.half[i] = half_of(m, &coefficients[i]);
        w.wet = w.wet || c->water_form > 0 || c->water_skin > 0;
        w.dry = w.dry || c->air_form > 0 || c->air_skin > 0;
    }
    return w;
}

int32_t prism_points(int32_t vertices) { return vertices <= PRISM_FEW_VERTICES ? 2 * vertices : vertices; }

const vec2 *prism_outline(const vec2 *vertex, int32_t n, vec2 *room)
{
    if (n > PRISM_FEW_VERTICES)
        return vertex;
    for (int32_t k = 0; k < n; k++) {
        room[2 * k] = vertex[k];
        room[2 * k + 1] = vec2_scale(vec2_add(vertex[k], vertex[k + 1 < n ? k + 1 : 0]), 0.5);
    }
    return room;
}

static void set_lane(prism_lane *to, int lane, vec3 v)
{
    to[0][lane] = v.x;
    to[1][lane] = v.y;
    to[2][lane] = v.z;
}

static vec3 get_lane(const prism_lane *from, int lane) { return (vec3){from[0][lane], from[1][lane], from[2][lane]}; }

void prism_pack(const prism_work *w, prism_batch *b, int lane, int32_t slot)
{
    const body_table *t = w->bodies;
    const drag_coefficients *c = &w->half[t->material[slot]];
    quat q = t->orientation[slot];
    b->height[lane] = t->position[slot].z;
    b->turn[0][lane] = q.w;
    b->turn[1][lane] = q.x;
    b->turn[2][lane] = q.y;
    b->turn[3][lane] = q.z;
    b->half[lane] = w->shapes->shapes.half_height[t->shape[slot]];
    set_lane(b->spin, lane, t->angular_velocity[slot]);
    set_lane(b->water.velocity, lane, vec3_sub(t->velocity[slot], prism_current(w->media, t, w->shapes, slot)));
    b->water.form[lane] = c->water_form;
    b->water.skin[lane] = c->water_skin;
    if (w->dry) {
        set_lane(b->air.velocity, lane, vec3_sub(t->velocity[slot], w->media->wind));
        b->air.form[lane] = c->air_form;
        b->air.skin[lane] = c->air_skin;
    }
}

static wrench wrench_of(const prism_wrench *from, int lane)
{
    return (wrench){get_lane(from->force, lane), get_lane(from->moment, lane)};
}

void prism_unpack(const prism_batch *b, int lane, const prism_output *out, int32_t to)
{
    static const wrench none = {{0, 0, 0}, {0, 0, 0}};
    out->total[to] = wrench_of(&b->total, lane);
    out->volume[to] = b->volume[lane];
    if (!out->load)
        return;
    fluid_load *load = &out->load[to];
    load->hydrostatic = wrench_of(&b->hydrostatic, lane);
    load->submerged_volume = b->volume[lane];
    load->water_drag = b->wet ? wrench_of(&b->water_drag, lane) : none;
    load->wind_drag = b->dry ? wrench_of(&b->air_drag, lane) : none;
}
