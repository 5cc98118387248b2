#include "fluid/columns_kernel.h"

#include "base/lanes.h"

/* The steepest that a column is followed: sin of the angle of a floe's plane to the vertical. */
#define LEAST_COSINE 0.2

typedef struct eight_bodies {
    v8 z;      /* of the centres */
    lanes33 r; /* body to global */
    lanes3 v, w;
} eight_bodies;

V8_INLINE void load_bodies(const body_table *bodies, int32_t slot, eight_bodies *b)
{
    b->z = lanes_pick(&bodies->position[slot].x, 3, 2);
    b->r = lanes_quat_matrix(lanes_quat_pick(bodies->orientation + slot));
    b->v = lanes3_pick(bodies->velocity + slot);
    b->w = lanes3_pick(bodies->angular_velocity + slot);
}

void KERNEL(column_groups)(const column_water *w, const body_table *bodies, int32_t first, int32_t end, wrench *loads)
{
    const column_medium *m = &w->medium;
    v8 zero = v8_set(0), half_density = v8_set(0.5 * m->water_density);
    v8 lift = v8_set(m->water_density * m->gravity);
    for (int32_t group = first; group < end; group++) {
        int32_t slot = V8_LANES * group;
        eight_bodies b;
        load_bodies(bodies, slot, &b);
        v8 thickness = v8_load(w->thickness.data + slot), rim = v8_load(w->rim.data + slot);
        v8 sides = v8_load(w->sides.data + slot);
        v8 bottom = -0.5 * thickness, upright = v8_max(b.r.m[2][2], v8_set(LEAST_COSINE));
        v8 rim_drag = half_density * m->form_drag * rim;
        v8 f[3] = {zero, zero, zero}, t[3] = {zero, zero, zero};
        for (int32_t row = w->first.data[group]; row < w->first.data[group + 1]; row++) {
            v8 area = v8_load(w->area.data + V8_LANES * row);
            v8 x = v8_load(w->x.data + V8_LANES * row), y = v8_load(w->y.data + V8_LANES * row);
            v8 under = b.z + b.r.m[2][0] * x + b.r.m[2][1] * y + b.r.m[2][2] * bottom;
            v8 wet = v8_min(-under / upright, thickness);
            v8_mask acts = v8_less(zero, wet) & v8_less(v8_set(row - w->first.data[group]), sides);
            v8 z = bottom + 0.5 * wet;
            v8 r[3];
            for (int i = 0; i < 3; i++)
                r[i] = b.r.m[i][0] * x + b.r.m[i][1] * y + b.r.m[i][2] * z;
            v8 u = b.v.x + b.w.y * r[2] - b.w.z * r[1] - m->current.x;
            v8 v = b.v.y + b.w.z * r[0] - b.w.x * r[2] - m->current.y;
            v8 rise = b.v.z + b.w.x * r[1] - b.w.y * r[0];
            v8 speed = v8_sqrt(u * u + v * v), q = half_density * area;
            v8 drag = q * m->skin_drag * speed + rim_drag * wet * speed;
            v8 fx = v8_select(acts, -drag * u, zero), fy = v8_select(acts, -drag * v, zero);
            v8 fz = v8_select(acts, lift * area * wet - q * m->form_drag * (v8_abs(rise) + 1.0) * rise, zero);
            f[0] += fx;
            f[1] += fy;
            f[2] += fz;
            t[0] += v8_select(acts, r[1] * fz - r[2] * fy, zero);
            t[1] += v8_select(acts, r[2] * fx - r[0] * fz, zero);
            t[2] += v8_select(acts, r[0] * fy - r[1] * fx, zero);
        }
        v8_mask floats = v8_less(zero, sides);
        v8 weight = v8_load(bodies->mass + slot) * m->gravity;
        f[2] = v8_select(floats, f[2] - weight, zero);
        double out[6][V8_LANES];
        for (int i = 0; i < 3; i++) {
            v8_store(out[i], f[i]);
            v8_store(out[3 + i], t[i]);
        }
        for (int32_t i = 0; i < V8_LANES && slot + i < bodies->count; i++)
            loads[slot + i] = (wrench){{out[0][i], out[1][i], out[2][i]}, {out[3][i], out[4][i], out[5][i]}};
    }
}
