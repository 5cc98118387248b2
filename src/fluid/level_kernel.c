#include "fluid/level_kernel.h"
#include "fluid/prism_lanes.h"

/* What all passes need of the floes, body axes. */
typedef struct level_floes {
    prism_pose pose;
    real water0, waterx, watery; /* height of the water plane in the body's z: water0 + waterx x + watery y */
    prism_ring ring;             /* outline */
} level_floes;

V8_INLINE void read_floes(const level_batch *b, level_floes *f)
{
    const prism_pose *p = &f->pose;
    real scale = -1 / p->r[2][2];
    f->water0 = load(b->floes.height + p->at) * scale;
    f->waterx = p->r[2][0] * scale;
    f->watery = p->r[2][1] * scale;
    f->ring = read_ring(b->corner, b->sides, p->at, b->own);
}

/* Height of the water on a corner: of the waterline, and of what is sunken its upper cap. */
V8_INLINE real line_at(const level_batch *b, const level_floes *f, real x, real y)
{
    return b->sunken ? f->pose.half : f->water0 + (f->waterx * x + f->watery * y);
}

/* The submerged volume and its first moments. */
typedef struct level_volume {
    real volume;
    real3 first;
} level_volume;

/* Columns over the outline from the lower cap to the water plane: their lengths, and half the difference of the squares
   of their ends. */
V8_INLINE level_volume volume_of(const level_floes *f, const prism_moments *m)
{
    real half = f->pose.half, depth = f->water0 + half, s = f->waterx, t = f->watery, h = f->water0;
    real volume = m->area * depth + (s * m->x + t * m->y);
    real squares = m->area * (h * h - half * half) + 2 * h * (s * m->x + t * m->y) +
                   (s * s * m->xx + 2 * s * t * m->xy + t * t * m->yy);
    return (level_volume){
        volume, {m->x * depth + (s * m->xx + t * m->xy), m->y * depth + (s * m->xy + t * m->yy), 0.5 * squares}};
}

/* From cap to cap. */
V8_INLINE level_volume whole_volume(const level_floes *f, const prism_moments *m)
{
    real thickness = 2 * f->pose.half;
    return (level_volume){thickness * m->area, {thickness * m->x, thickness * m->y, zero()}};
}

V8_INLINE void add_hydrostatics(const level_floes *f, const level_volume *v, prism_batch *out)
{
    const prism_pose *p = &f->pose;
    real gx = p->r[0][0] * v->first.x + p->r[0][1] * v->first.y + p->r[0][2] * v->first.z;
    real gy = p->r[1][0] * v->first.x + p->r[1][1] * v->first.y + p->r[1][2] * v->first.z;
    store_hydrostatics(out, p->at, v->volume, gx, gy);
}

V8_INLINE prism_cap cap_of(const level_floes *f, double side) { return (prism_cap){f->ring, set(side), f->pose.half}; }

/* side: -1 for the wet part between the bottom and the waterline, +1 for the dry one above it. */
V8_INLINE prism_sum drag_of(const level_batch *b, const level_floes *f, const prism_moments *m,
                            const prism_medium *medium, double side)
{
    prism_sum sum = {{zero(), zero(), zero()}, {zero(), zero(), zero()}}, form_sum = sum, skin_sum = sum;
    const prism_stream stream = stream_of(&f->pose, medium);
    const prism_cap cap = cap_of(f, side);
    real half = f->pose.half, xa = ring_x(&f->ring, 0), ya = ring_y(&f->ring, 0), la = line_at(b, f, xa, ya);
    for (int32_t k = 1; k <= b->sides; k++) {
        real xb = ring_x(&f->ring, k), yb = ring_y(&f->ring, k), lb = line_at(b, f, xb, yb);
        prism_side e = side_between(xa, ya, xb, yb);
        e.base_a = side < 0 ? -half : la;
        e.base_b = side < 0 ? -half : lb;
        e.depth_a = half - side * la;
        e.depth_b = half - side * lb;
        add_side_form(&stream, &e, &form_sum);
        add_side_skin(&stream, &e, &skin_sum);
        xa = xb;
        ya = yb;
        la = lb;
    }
    add_scaled(&sum, &form_sum, stream.form);
    add_scaled(&sum, &skin_sum, stream.skin);
    add_cap_form(&cap, &stream, &sum);
    add_cap_skin(&cap, m, &stream, &sum);
    return sum;
}

/* What the water does to the upper caps of sunken floes, added. */
V8_INLINE void add_upper_caps(const level_batch *b, const level_floes *f, const prism_moments *m, prism_sum *water)
{
    const prism_stream stream = stream_of(&f->pose, &b->floes.water);
    const prism_cap cap = cap_of(f, 1);
    add_cap_form(&cap, &stream, water);
    add_cap_skin(&cap, m, &stream, water);
}

/* The drag of one medium that `sum` is, or none: as an answer, and as what may be held. */
V8_INLINE void store_drag(const prism_pose *p, const prism_sum *sum, prism_wrench *answer, prism_wrench *held)
{
    store_global(p, answer->force, sum->force);
    store_global(p, answer->moment, sum->moment);
    store_vec(held->force, p->at, sum->force);
    store_vec(held->moment, p->at, sum->moment);
}

V8_INLINE void store_state(const prism_batch *b, const level_floes *f, const prism_moments *m, level_state *out)
{
    const prism_pose *p = &f->pose;
    const real moments[6] = {m->area, m->x, m->y, m->xx, m->yy, m->xy};
    const real3 none = {zero(), zero(), zero()};
    for (int i = 0; i < 6; i++)
        store(out->moments[i] + p->at, moments[i]);
    store_vec(out->line, p->at, (real3){f->water0, f->waterx, f->watery});
    store_vec(out->spin, p->at, p->spin);
    store_vec(out->through_water, p->at, to_body(p, load_vec(b->water.velocity, p->at)));
    store_vec(out->through_air, p->at, b->dry ? to_body(p, load_vec(b->air.velocity, p->at)) : none);
}

/* The floes of one part. */
static void part_loads(level_batch *b, int at)
{
    prism_batch *floes = &b->floes;
    level_floes f = {.pose = pose_of(floes, at)};
    read_floes(b, &f);
    prism_moments m = moments_of(&f.ring);
    const level_volume v = b->sunken ? whole_volume(&f, &m) : volume_of(&f, &m);
    add_hydrostatics(&f, &v, floes);
    store_state(floes, &f, &m, &b->state);
    const prism_sum none = {{zero(), zero(), zero()}, {zero(), zero(), zero()}};
    prism_sum water = floes->wet ? drag_of(b, &f, &m, &floes->water, -1) : none;
    if (floes->wet && b->sunken)
        add_upper_caps(b, &f, &m, &water);
    store_drag(&f.pose, &water, &floes->water_drag, &b->state.water_drag);
    prism_sum air = floes->dry && !b->sunken ? drag_of(b, &f, &m, &floes->air, 1) : none;
    store_drag(&f.pose, &air, &floes->air_drag, &b->state.air_drag);
    add_up(floes, at);
}

void KERNEL(level_loads)(level_batch *batch)
{
    for (int at = 0; at < PRISM_LANES; at += V8_PART_LANES)
        part_loads(batch, at);
}
