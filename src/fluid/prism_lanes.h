/* The prisms of a batch in the lanes of a register: poses, motions and loads.  For kernels (base/kernel.h) inside
   fluid; knows no outlines. */
#ifndef FLUID_PRISM_LANES_H
#define FLUID_PRISM_LANES_H

#include "fluid/prism_batch.h"
#include "fluid/prism_drag.h"

typedef struct prism_pose {
    int at;       /* first lane of the part */
    real r[3][3]; /* rotation, body to global */
    real half;    /* half the thickness */
    real3 spin;   /* body axes */
} prism_pose;

V8_INLINE real3 load_vec(const prism_lane *p, int at)
{
    return (real3){load(p[0] + at), load(p[1] + at), load(p[2] + at)};
}

V8_INLINE void store_vec(prism_lane *out, int at, real3 v)
{
    store(out[0] + at, v.x);
    store(out[1] + at, v.y);
    store(out[2] + at, v.z);
}

/* Global to body axes. */
V8_INLINE real3 to_body(const prism_pose *p, real3 v)
{
    return (real3){p->r[0][0] * v.x + p->r[1][0] * v.y + p->r[2][0] * v.z,
                   p->r[0][1] * v.x + p->r[1][1] * v.y + p->r[2][1] * v.z,
                   p->r[0][2] * v.x + p->r[1][2] * v.y + p->r[2][2] * v.z};
}

V8_INLINE void store_global(const prism_pose *p, prism_lane *out, real3 v)
{
    for (int i = 0; i < 3; i++)
        store(out[i] + p->at, p->r[i][0] * v.x + p->r[i][1] * v.y + p->r[i][2] * v.z);
}

V8_INLINE prism_pose pose_of(const prism_batch *b, int at)
{
    prism_pose p = {.at = at};
    real w = load(b->turn[0] + at), x = load(b->turn[1] + at), y = load(b->turn[2] + at), z = load(b->turn[3] + at);
    real xx = x * x, yy = y * y, zz = z * z, xy = x * y, xz = x * z, yz = y * z, wx = w * x, wy = w * y, wz = w * z;
    p.r[0][0] = 1 - 2 * (yy + zz), p.r[0][1] = 2 * (xy - wz), p.r[0][2] = 2 * (xz + wy);
    p.r[1][0] = 2 * (xy + wz), p.r[1][1] = 1 - 2 * (xx + zz), p.r[1][2] = 2 * (yz - wx);
    p.r[2][0] = 2 * (xz - wy), p.r[2][1] = 2 * (yz + wx), p.r[2][2] = 1 - 2 * (xx + yy);
    p.half = load(b->half + at);
    p.spin = to_body(&p, load_vec(b->spin, at));
    return p;
}

/* The lanes of a part, closed outlines of so many sides, into room of two lanes of numbers for each point. */
V8_INLINE prism_ring read_ring(prism_corner *corner, int32_t sides, int at, double *room)
{
    double *x = room, *y = room + (ptrdiff_t)(sides + 1) * V8_PART_LANES;
    for (int32_t k = 0; k <= sides; k++) {
        real xk, yk;
        v8_part_load_pairs(&corner[k][at].x, &xk, &yk);
        store(x + (ptrdiff_t)k * V8_PART_LANES, xk);
        store(y + (ptrdiff_t)k * V8_PART_LANES, yk);
    }
    return (prism_ring){sides, x, y};
}

V8_INLINE prism_stream stream_of(const prism_pose *p, const prism_medium *m)
{
    return (prism_stream){to_body(p, load_vec(m->velocity, p->at)), p->spin, load(m->form + p->at),
                          load(m->skin + p->at)};
}

/* Buoyancy of a volume with that first moment along the global x and y. */
V8_INLINE void store_hydrostatics(prism_batch *b, int at, real volume, real x, real y)
{
    store(b->volume + at, volume);
    store(b->hydrostatic.force[0] + at, zero());
    store(b->hydrostatic.force[1] + at, zero());
    store(b->hydrostatic.force[2] + at, b->weight * volume);
    store(b->hydrostatic.moment[0] + at, b->weight * y);
    store(b->hydrostatic.moment[1] + at, -b->weight * x);
    store(b->hydrostatic.moment[2] + at, zero());
}

/* The sum of a batch's loads, in the same order for every prism: hydrostatics + (water + air). */
V8_INLINE void add_up(prism_batch *b, int at)
{
    const real none = zero();
    for (int i = 0; i < 3; i++) {
        real water = b->wet ? load(b->water_drag.force[i] + at) : none;
        real air = b->dry ? load(b->air_drag.force[i] + at) : none;
        store(b->total.force[i] + at, load(b->hydrostatic.force[i] + at) + (water + air));
        water = b->wet ? load(b->water_drag.moment[i] + at) : none;
        air = b->dry ? load(b->air_drag.moment[i] + at) : none;
        store(b->total.moment[i] + at, load(b->hydrostatic.moment[i] + at) + (water + air));
    }
}

#endif
