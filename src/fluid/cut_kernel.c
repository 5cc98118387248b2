#include "fluid/cut_kernel.h"
#include "base/parts.h"

/* 1/a, and 0 for what is not above 0 */
V8_INLINE real over(real a)
{
    const real zero = {0}, one = zero + 1.0;
    mask some = (mask)(a > zero);
    return choose(some, one / choose(some, a, one), zero);
}

/* A triangle with heights over the water. */
typedef struct triangle {
    real3 r[3];
    real h[3];
} triangle;

/* With the corner that is alone on its side of the plane first, orientation kept. */
typedef struct cut {
    triangle t;
    mask lone_wet;       /* one corner is under water */
    mask lone_dry;       /* two are */
    mask whole_wet;      /* all are */
    real share;          /* area of the lone corner's part over the whole */
    real3 first, second; /* where the plane cuts the sides from the lone corner */
} cut;

V8_INLINE triangle load_triangle(const water_plane *plane, const cut_batch *b, int at)
{
    triangle t;
    for (int i = 0; i < 3; i++) {
        t.r[i] = (real3){load(&b->corner[i][0][at]), load(&b->corner[i][1][at]), load(&b->corner[i][2][at])};
        t.h[i] = plane->height + (plane->up.x * t.r[i].x + plane->up.y * t.r[i].y + plane->up.z * t.r[i].z);
    }
    return t;
}

V8_INLINE triangle turn(const triangle *t, mask to_second, mask to_third)
{
    triangle out;
    for (int i = 0; i < 3; i++) {
        int j = (i + 1) % 3, k = (i + 2) % 3;
        out.r[i] = choose3(to_third, t->r[k], choose3(to_second, t->r[j], t->r[i]));
        out.h[i] = choose(to_third, t->h[k], choose(to_second, t->h[j], t->h[i]));
    }
    return out;
}

/* Where the side from the lone corner to corner k meets the plane, over its length; 1 where nothing is cut. */
V8_INLINE real part_of_side(const cut *c, int k)
{
    const real one = (real){0} + 1.0;
    mask is_cut = c->lone_wet | c->lone_dry;
    return choose(is_cut, c->t.h[0] / choose(is_cut, c->t.h[0] - c->t.h[k], one), one);
}

V8_INLINE cut make_cut(const triangle *t)
{
    const real zero = {0};
    mask wet[3];
    for (int i = 0; i < 3; i++)
        wet[i] = (mask)(t->h[i] < zero);
    mask odd = wet[0] ^ wet[1] ^ wet[2], all = wet[0] & wet[1] & wet[2], any = wet[0] | wet[1] | wet[2];
    cut c = {.lone_wet = odd & ~all, .lone_dry = any & ~odd, .whole_wet = all};
    mask is_cut = c.lone_wet | c.lone_dry;
    c.t = turn(t, is_cut & ~(wet[0] ^ wet[2]), is_cut & ~(wet[0] ^ wet[1]));
    real a = part_of_side(&c, 1), b = part_of_side(&c, 2);
    c.share = a * b;
    c.first = add(c.t.r[0], scale(sub(c.t.r[1], c.t.r[0]), a));
    c.second = add(c.t.r[0], scale(sub(c.t.r[2], c.t.r[0]), b));
    return c;
}

/* Twelve times the integrals of h and of r h over a triangle of unit area: heights h of its corners r. */
V8_INLINE void pressure_of(const real3 r[3], const real h[3], real *flat, real3 *weighted)
{
    real sum = (h[0] + h[1]) + h[2];
    real3 all = add(add(r[0], r[1]), r[2]);
    *flat = 4.0 * sum;
    *weighted = scale(all, sum);
    for (int i = 0; i < 3; i++)
        *weighted = add(*weighted, scale(r[i], h[i]));
}

/* Pressure on the wet part; area: the triangle's area vector. */
V8_INLINE void add_pressure(const cut *c, real3 area, real sum[6])
{
    const real zero = {0}, one = zero + 1.0;
    const real3 tip[3] = {c->t.r[0], c->first, c->second};
    const real tip_height[3] = {c->t.h[0], zero, zero};
    real flat, tip_flat;
    real3 weighted, tip_weighted;
    pressure_of(c->t.r, c->t.h, &flat, &weighted);
    pressure_of(tip, tip_height, &tip_flat, &tip_weighted);
    real of_whole = choose(c->whole_wet | c->lone_dry, one, zero);
    real of_tip = choose(c->lone_wet, c->share, choose(c->lone_dry, -c->share, zero));
    real force = (of_whole * flat + of_tip * tip_flat) * (1.0 / 12);
    real3 lever = scale(add(scale(weighted, of_whole), scale(tip_weighted, of_tip)), zero + 1.0 / 12);
    real3 moment = cross(lever, area);
    sum[0] += force * area.x;
    sum[1] += force * area.y;
    sum[2] += force * area.z;
    sum[3] += moment.x;
    sum[4] += moment.y;
    sum[5] += moment.z;
}

V8_INLINE void write_point(cut_points *p, int at, real3 middle, real3 normal, real area)
{
    store(p->x + at, middle.x);
    store(p->y + at, middle.y);
    store(p->z + at, middle.z);
    store(p->nx + at, normal.x);
    store(p->ny + at, normal.y);
    store(p->nz + at, normal.z);
    store(p->area + at, area);
}

/* The lone corner's part is all of a triangle that is not cut. */
V8_INLINE void write_points(const cut *c, real3 area, real drag, int at, cut_points *wet, cut_points *dry)
{
    const real zero = {0}, third = zero + 1.0 / 3;
    mask wet_tip = c->lone_wet | c->whole_wet;
    real length = v8_part_sqrt(area.x * area.x + area.y * area.y + area.z * area.z), size = length * drag;
    real3 normal = scale(area, over(length));
    real3 middle = scale(add(add(c->t.r[0], c->t.r[1]), c->t.r[2]), third);
    real3 of_tip = scale(add(add(c->t.r[0], c->first), c->second), third);
    real left = 1.0 - c->share;
    real3 of_rest = scale(sub(middle, scale(of_tip, c->share)), over(left));
    write_point(wet, at, choose3(wet_tip, of_tip, of_rest), normal, size * choose(wet_tip, c->share, left));
    write_point(dry, at, choose3(wet_tip, of_rest, of_tip), normal, size * choose(wet_tip, left, c->share));
}

/* Triangles without area, so that the batch ends with a whole register. */
static int fill_up(cut_batch *b)
{
    int count = (b->count + V8_LANES - 1) / V8_LANES * V8_LANES;
    for (int at = b->count; at < count; at++) {
        for (int i = 0; i < 9; i++)
            b->corner[i / 3][i % 3][at] = 0;
        b->drag[at] = 0;
    }
    return count;
}

void KERNEL(cut_triangles)(const water_plane *plane, cut_batch *batch, point_sums *pressure, cut_points *wet,
                           cut_points *dry)
{
    int count = fill_up(batch);
    for (int at = 0; at < count; at += V8_PART_LANES) {
        int lane = at % V8_LANES;
        triangle t = load_triangle(plane, batch, at);
        cut c = make_cut(&t);
        real3 area = scale(cross(sub(t.r[1], t.r[0]), sub(t.r[2], t.r[0])), (real){0} + 0.5);
        real sum[6];
        for (int i = 0; i < 6; i++)
            sum[i] = load(&pressure->lane[i][lane]);
        add_pressure(&c, area, sum);
        for (int i = 0; i < 6; i++)
            store(&pressure->lane[i][lane], sum[i]);
        write_points(&c, area, load(&batch->drag[at]), at, wet, dry);
    }
}
