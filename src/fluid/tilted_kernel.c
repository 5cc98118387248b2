#include "fluid/tilted_kernel.h"

#include "fluid/prism_lanes.h"

typedef struct tilted_floes {
    prism_pose pose;
    real height; /* of the centre of mass over still water */
    real up;     /* 1 where the top is the upper cap, -1 where the bottom is */
    prism_ring outline;
} tilted_floes;

/* Pressure over rho g, and drag of both media. */
typedef struct tilted_sums {
    prism_sum pressure, water, air;
} tilted_sums;

V8_INLINE prism_sum no_sum(void)
{
    const real3 none = {zero(), zero(), zero()};
    return (prism_sum){none, none};
}

/* Height over still water of a point of the body. */
V8_INLINE real height_at(const tilted_floes *f, real x, real y, real z)
{
    const prism_pose *p = &f->pose;
    return f->height + (p->r[2][0] * x + p->r[2][1] * y + p->r[2][2] * z);
}

/* ---- pressure ---- */

/* int h n dS and int r x h n dS, h the height over still water, over a part of a cap. */
V8_INLINE void add_cap_pressure(const tilted_floes *f, const prism_cap *c, const prism_moments *m, prism_sum *sum)
{
    const prism_pose *p = &f->pose;
    real h = height_at(f, zero(), zero(), c->side * c->half), s = p->r[2][0], t = p->r[2][1];
    sum->force.z += c->side * (h * m->area + (s * m->x + t * m->y));
    sum->moment.x += c->side * (h * m->y + (s * m->xy + t * m->yy));
    sum->moment.y -= c->side * (h * m->x + (s * m->xx + t * m->xy));
}

/* The same over a part of a side: over its depth d they are d and z d times the height in the middle, and d^3/12 times
   its change with z; along the edge two points are exact for all of that. */
V8_INLINE void add_side_pressure(const tilted_floes *f, const prism_side *e, prism_sum *sum)
{
    real along_a = e->ex * e->xa + e->ey * e->ya, change = f->pose.r[2][2] * (1.0 / 12);
    real push = zero(), push_z = zero(), push_s = zero();
#pragma GCC unroll 2
    for (int i = 0; i < 2; i++) {
        double s = i ? GAUSS_FAR : GAUSS_NEAR;
        real depth = e->depth_a + s * (e->depth_b - e->depth_a), base = e->base_a + s * (e->base_b - e->base_a);
        real z = base + 0.5 * depth, h = depth * height_at(f, e->xa + s * e->ex, e->ya + s * e->ey, z);
        push += h;
        push_z += z * h + change * (depth * depth * depth);
        push_s += s * h;
    }
    push *= 0.5;
    push_z *= 0.5;
    push_s *= 0.5;
    sum->force.x += e->ey * push;
    sum->force.y -= e->ex * push;
    sum->moment.x += e->ex * push_z;
    sum->moment.y += e->ey * push_z;
    sum->moment.z -= along_a * push + e->length2 * push_s;
}

/* ---- sides and caps ---- */

/* A side's part from the lower cap on, or the rest of it up to the upper one. */
V8_INLINE void set_depth(const tilted_floes *f, bool wet, real depth_a, real depth_b, prism_side *e)
{
    real half = f->pose.half, thickness = 2 * half;
    mask upright = less(zero(), f->up), from_bottom = wet ? upright : ~upright;
    e->depth_a = wet ? depth_a : thickness - depth_a;
    e->depth_b = wet ? depth_b : thickness - depth_b;
    e->base_a = choose(from_bottom, -half, half - e->depth_a);
    e->base_b = choose(from_bottom, -half, half - e->depth_b);
}

V8_INLINE void add_sides(const tilted_batch *b, const tilted_floes *f, const prism_stream *water,
                         const prism_stream *air, tilted_sums *sums)
{
    prism_sum water_form = no_sum(), water_skin = no_sum(), air_form = no_sum(), air_skin = no_sum();
    for (int32_t k = 1; k <= b->outline.sides; k++) {
        prism_side e = side_between(ring_x(&f->outline, k - 1), ring_y(&f->outline, k - 1), ring_x(&f->outline, k),
                                    ring_y(&f->outline, k));
        real depth_a = load(b->depth[k - 1] + f->pose.at), depth_b = load(b->depth[k] + f->pose.at);
        set_depth(f, true, depth_a, depth_b, &e);
        add_side_pressure(f, &e, &sums->pressure);
        if (b->floes.wet) {
            add_deep_side_form(water, &e, &water_form);
            add_deep_side_skin(water, &e, &water_skin);
        }
        if (b->floes.dry) {
            set_depth(f, false, depth_a, depth_b, &e);
            add_deep_side_form(air, &e, &air_form);
            add_deep_side_skin(air, &e, &air_skin);
        }
    }
    if (b->floes.wet) {
        add_scaled(&sums->water, &water_form, water->form);
        add_scaled(&sums->water, &water_skin, water->skin);
    }
    if (b->floes.dry) {
        add_scaled(&sums->air, &air_form, air->form);
        add_scaled(&sums->air, &air_skin, air->skin);
    }
}

static __attribute__((noinline)) void add_cap(const tilted_batch *b, const tilted_floes *f, int which,
                                              const prism_stream *stream, tilted_sums *sums)
{
    const tilted_ring *r = &b->cap[which];
    const bool wet = which == TILTED_WET_LOWER || which == TILTED_WET_UPPER;
    const bool upper = which == TILTED_WET_UPPER || which == TILTED_DRY_UPPER;
    const prism_cap cap = {read_ring(r->corner, r->sides, f->pose.at, b->own[1]), upper ? f->up : -f->up, f->pose.half};
    prism_moments m = moments_of(&cap.ring);
    if (wet)
        add_cap_pressure(f, &cap, &m, &sums->pressure);
    if (wet ? b->floes.wet : b->floes.dry) {
        prism_sum *drag = wet ? &sums->water : &sums->air;
        add_cap_form(&cap, stream, drag);
        add_cap_skin(&cap, &m, stream, drag);
    }
}

/* ---- results ---- */

/* Buoyancy acts upward, so that of the pressure's force and moment in global axes only three numbers are not zero. */
V8_INLINE void store_pressure(const tilted_floes *f, const prism_sum *p, prism_batch *out)
{
    const prism_pose *q = &f->pose;
    real volume = q->r[2][0] * p->force.x + q->r[2][1] * p->force.y + q->r[2][2] * p->force.z;
    real x = q->r[0][0] * p->moment.x + q->r[0][1] * p->moment.y + q->r[0][2] * p->moment.z;
    real y = q->r[1][0] * p->moment.x + q->r[1][1] * p->moment.y + q->r[1][2] * p->moment.z;
    store_hydrostatics(out, q->at, volume, -y, x);
}

static void part_loads(tilted_batch *b, int at)
{
    prism_batch *floes = &b->floes;
    tilted_floes f = {.pose = pose_of(floes, at), .height = load(floes->height + at)};
    f.up = choose(less(f.pose.r[2][2], zero()), set(-1), set(1));
    f.outline = read_ring(b->outline.corner, b->outline.sides, at, b->own[0]);
    prism_stream water = {0}, air = {0};
    if (floes->wet)
        water = stream_of(&f.pose, &floes->water);
    if (floes->dry)
        air = stream_of(&f.pose, &floes->air);
    tilted_sums sums = {no_sum(), no_sum(), no_sum()};
    add_sides(b, &f, &water, &air, &sums);
    for (int i = 0; i < TILTED_CAPS; i++)
        if (b->cap[i].sides > 0)
            add_cap(b, &f, i, i == TILTED_WET_LOWER || i == TILTED_WET_UPPER ? &water : &air, &sums);
    store_pressure(&f, &sums.pressure, floes);
    store_global(&f.pose, floes->water_drag.force, sums.water.force);
    store_global(&f.pose, floes->water_drag.moment, sums.water.moment);
    store_global(&f.pose, floes->air_drag.force, sums.air.force);
    store_global(&f.pose, floes->air_drag.moment, sums.air.moment);
    add_up(floes, at);
}

void KERNEL(tilted_loads)(tilted_batch *batch)
{
    for (int at = 0; at < PRISM_LANES; at += V8_PART_LANES)
        part_loads(batch, at);
}
