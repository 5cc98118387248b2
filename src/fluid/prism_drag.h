/* Drag on prisms, one in each lane of a register, in the axes of each: on caps or parts of them, which are outlines,
   and on sides or parts of them, which are trapezia along the prism's axis.  For kernels (base/kernel.h) inside fluid;
   knows no batches.

   Form drag of a cap is exact for any motion: the inflow f = L + g . r is linear, and where it changes its sign the
   part with f > 0 is made of triangles from a point of the line f = 0. Form drag of a side is exact along the edge and,
   unless its motion changes its sign over the depth, over the depth. Skin drag is a quadrature: two Gauss points along
   each edge.  On caps it is exact along rays from the point that rests; on sides it is taken at the middle of the
   depth. Floes whose sides may be as deep as they are long get "deep" sides: form drag is exact there, and skin drag
   has two points over the depth too. */
#ifndef FLUID_PRISM_DRAG_H
#define FLUID_PRISM_DRAG_H

#include "base/parts.h"

/* Two Gauss points on [0, 1], each of weight 1/2. */
#define GAUSS_NEAR 0.21132486540518713
#define GAUSS_FAR 0.78867513459481287
/* A cap turns less than this: the speed of turning at the outline's radius of gyration over that of going.  The first
   power of it is then good to its square, and the exact way has lost as many digits as that. */
#define EVEN 1e-4
/* Square of an angular velocity below which it is none [rad2/s2]. */
#define NO_TURN 1e-200
/* Squared length of an edge below which it is none: a padded one [m2]. */
#define NO_LENGTH 1e-300

V8_INLINE real zero(void) { return (real){0}; }
V8_INLINE real set(double x) { return x - zero(); }
V8_INLINE real minimum(real a, real b) { return v8_part_min(a, b); }
V8_INLINE real maximum(real a, real b) { return v8_part_max(a, b); }
V8_INLINE real root(real a) { return v8_part_sqrt(a); }

/* How the prisms go through a medium, body axes. */
typedef struct prism_stream {
    real3 velocity, spin;
    real form, skin; /* 1/2 rho Cd, 1/2 rho Cf [kg/m3] */
} prism_stream;

/* Force and moment in the body's axes. */
typedef struct prism_sum {
    real3 force, moment;
} prism_sum;

/* Closed outlines, counter-clockwise; an edge without length adds nothing. */
typedef struct prism_ring {
    int32_t sides;
    const double *x, *y; /* sides + 1 points, the last of them the first, register by register */
} prism_ring;

V8_INLINE real ring_x(const prism_ring *f, int32_t k) { return load(f->x + (ptrdiff_t)k * V8_PART_LANES); }
V8_INLINE real ring_y(const prism_ring *f, int32_t k) { return load(f->y + (ptrdiff_t)k * V8_PART_LANES); }

/* A cap or a part of one. */
typedef struct prism_cap {
    prism_ring ring;
    real side; /* 1: of the top, -1: of the bottom */
    real half; /* half the thickness */
} prism_cap;

/* Integrals over the outline, about the body's axis, of 1, x, y, x^2, y^2 and x y. */
typedef struct prism_moments {
    real area, x, y, xx, yy, xy;
} prism_moments;

V8_INLINE prism_moments moments_of(const prism_ring *f)
{
    prism_moments m = {zero(), zero(), zero(), zero(), zero(), zero()};
    real xa = ring_x(f, 0), ya = ring_y(f, 0);
    for (int32_t k = 1; k <= f->sides; k++) {
        real xb = ring_x(f, k), yb = ring_y(f, k);
        real cross = xa * yb - xb * ya, x = xa + xb, y = ya + yb;
        m.area += cross;
        m.x += cross * x;
        m.y += cross * y;
        m.xx += cross * (x * x - xa * xb);
        m.yy += cross * (y * y - ya * yb);
        m.xy += cross * (x * y + (xa * ya + xb * yb));
        xa = xb;
        ya = yb;
    }
    m.area *= 0.5;
    m.x *= 1.0 / 6;
    m.y *= 1.0 / 6;
    m.xx *= 1.0 / 12;
    m.yy *= 1.0 / 12;
    m.xy *= 1.0 / 24;
    return m;
}

/* ---- form drag of a cap ---- */

/* The part of [0, 1] where the linear function from a to b is positive. */
typedef struct part {
    real from, to;
    real a, b; /* the function at its ends */
} part;

V8_INLINE part positive_part(real a, real b)
{
    mask below_a = less(a, zero()), below_b = less(b, zero());
    real cross = a / choose(below_a ^ below_b, a - b, set(1));
    return (part){choose(below_a & ~below_b, cross, zero()), choose(below_b & ~below_a, cross, set(1)),
                  maximum(a, zero()), maximum(b, zero())};
}

/* Integrals over the part of the cap where the inflow f is positive, of f^2 and f^2 r, by triangles from one point to
   the edges' parts with f > 0: from the axis while f > 0 everywhere, else from the point of the line f = 0 that is
   nearest to it, about which this line spans no triangle. */
V8_INLINE void add_cap_form(const prism_cap *c, const prism_stream *s, prism_sum *sum)
{
    const prism_ring *f = &c->ring;
    const real side = c->side;
    real level = side * s->velocity.z, gx = -side * s->spin.y, gy = side * s->spin.x;
    real low = set(HUGE_VAL), high = set(-HUGE_VAL);
    for (int32_t k = 0; k <= f->sides; k++) {
        real inflow = level + (gx * ring_x(f, k) + gy * ring_y(f, k));
        low = minimum(low, inflow);
        high = maximum(high, inflow);
    }
    mask into = less(zero(), high), parted = into & less(low, zero());
    if (!v8_part_bits(into))
        return;
    real g2 = gx * gx + gy * gy, away = choose(parted, -level / choose(less(zero(), g2), g2, set(1)), zero());
    real cx = away * gx, cy = away * gy, at_c = choose(parted, zero(), level), at_c2 = at_c * at_c;
    real square = zero(), x = zero(), y = zero();
    real x0 = ring_x(f, 0), y0 = ring_y(f, 0), from = level + (gx * x0 + gy * y0), xa = x0 - cx, ya = y0 - cy;
    for (int32_t k = 1; k <= f->sides; k++) {
        real xk = ring_x(f, k), yk = ring_y(f, k), to = level + (gx * xk + gy * yk);
        real xb = xk - cx, yb = yk - cy, ex = xb - xa, ey = yb - ya;
        part p = positive_part(from, to);
        real ax = xa + p.from * ex, ay = ya + p.from * ey, bx = xa + p.to * ex, by = ya + p.to * ey;
        /* The triangle's rule for int f^2 and int f^2 r (24 and 120 times), where r = 0 at its third corner. */
        real cross = ax * by - bx * ay, all = at_c + (p.a + p.b);
        real both = all * all + (at_c2 + (p.a * p.a + p.b * p.b));
        real at_a = cross * (both + 2 * p.a * (all + p.a)), at_b = cross * (both + 2 * p.b * (all + p.b));
        square += cross * both;
        x += ax * at_a + bx * at_b;
        y += ay * at_a + by * at_b;
        xa = xb;
        ya = yb;
        from = to;
    }
    real push = choose(into, -side * s->form, zero());
    square *= 1.0 / 24;
    sum->force.z += push * square;
    sum->moment.x += push * (y * (1.0 / 120) + cy * square);
    sum->moment.y -= push * (x * (1.0 / 120) + cx * square);
}

/* ---- skin drag of a cap ---- */

/* int |v| v and int r x |v| v over a cap, v = u + turn z x r. */
typedef struct cap_skin {
    real x, y, turn;
} cap_skin;

/* About the point r0 that rests, v = turn z x (r - r0): along a ray from there to the rim |v| v grows with the square
   of the way, which integrates exactly, and what is left is a quadrature along the edges.  The rays' triangles are
   summed with their signs, so r0 may lie outside. */
V8_INLINE cap_skin turning_skin(const prism_ring *f, real ux, real uy, real turn)
{
    cap_skin c = {zero(), zero(), zero()};
    real va = ux - turn * ring_y(f, 0), wa = uy + turn * ring_x(f, 0);
    for (int32_t k = 1; k <= f->sides; k++) {
        real vb = ux - turn * ring_y(f, k), wb = uy + turn * ring_x(f, k);
        real cross = va * wb - vb * wa; /* turn^2 times that of the triangle */
        real dv = GAUSS_NEAR * (vb - va), dw = GAUSS_NEAR * (wb - wa);
        real v0 = va + dv, w0 = wa + dw, v1 = vb - dv, w1 = wb - dw;
        real square0 = v0 * v0 + w0 * w0, square1 = v1 * v1 + w1 * w1;
        real speed0 = cross * root(square0), speed1 = cross * root(square1);
        c.x += speed0 * v0 + speed1 * v1;
        c.y += speed0 * w0 + speed1 * w1;
        c.turn += speed0 * square0 + speed1 * square1;
        va = vb;
        wa = wb;
    }
    real inverse = 1 / choose(less(set(NO_TURN), turn * turn), turn, set(1)), inverse2 = inverse * inverse;
    c.x *= inverse2 * (1.0 / 8);
    c.y *= inverse2 * (1.0 / 8);
    c.turn = inverse * (c.turn * (inverse2 * (1.0 / 10)) - (ux * c.x + uy * c.y));
    return c;
}

/* The same where the floe hardly turns, to the first power of turn: by the moments of the outline. */
V8_INLINE cap_skin even_skin(const prism_moments *m, real ux, real uy, real turn, real speed2)
{
    real speed = root(speed2), over = turn / choose(less(zero(), speed), speed, set(1));
    /* |v| = speed + over (u . z x r), and int of u . z x r times 1, x and y. */
    real along = uy * m->x - ux * m->y, along_x = uy * m->xx - ux * m->xy, along_y = uy * m->xy - ux * m->yy;
    real whole = speed * m->area + over * along, rate = speed * turn;
    return (cap_skin){whole * ux - rate * m->y, whole * uy + rate * m->x,
                      speed * along + (over * (uy * along_x - ux * along_y) + rate * (m->xx + m->yy))};
}

V8_INLINE void add_cap_skin(const prism_cap *p, const prism_moments *m, const prism_stream *s, prism_sum *sum)
{
    real z = p->side * p->half, skin = s->skin;
    real ux = s->velocity.x + s->spin.y * z, uy = s->velocity.y - s->spin.x * z, turn = s->spin.z;
    real speed2 = ux * ux + uy * uy, turn2 = turn * turn;
    mask even = less_equal(turn2 * (m->xx + m->yy), EVEN * EVEN * (m->area * speed2));
    cap_skin c = turning_skin(&p->ring, ux, uy, turn), flat = even_skin(m, ux, uy, turn, speed2);
    real fx = -skin * choose(even, flat.x, c.x), fy = -skin * choose(even, flat.y, c.y);
    sum->force.x += fx;
    sum->force.y += fy;
    sum->moment.x -= z * fy;
    sum->moment.y += z * fx;
    sum->moment.z -= skin * choose(even, flat.turn, c.turn);
}

/* ---- sides ---- */

/* One edge of the outline, from a to b, and the part of its side in the medium: from height `base` up by `depth`, both
   linear along the edge. */
typedef struct prism_side {
    real xa, ya, ex, ey, length2, inverse2; /* inverse2: 1/length^2 */
    real base_a, base_b, depth_a, depth_b;
} prism_side;

/* Of an edge between two points; nothing of it is in the medium yet. */
V8_INLINE prism_side side_between(real xa, real ya, real xb, real yb)
{
    prism_side e = {.xa = xa, .ya = ya, .ex = xb - xa, .ey = yb - ya};
    e.length2 = e.ex * e.ex + e.ey * e.ey;
    e.inverse2 = 1 / maximum(e.length2, set(NO_LENGTH));
    return e;
}

/* Over the part of the side that moves into the medium at the middle of its depth d, with p the inflow there times the
   edge's length and slope its change with z: integrals over the depth of p^2, s p^2 and (z - middle) p^2, along the
   edge's s in [0, 1].  All are means of polynomials over that part, about its middle. */
typedef struct side_form {
    real zeroth, first, over_depth;
} side_form;

V8_INLINE side_form side_form_of(real ga, real gb, real slope, real depth_a, real depth_b)
{
    part p = positive_part(ga, gb);
    real length = p.to - p.from, half = 0.5 * length, middle = 0.5 * (p.from + p.to), change = depth_b - depth_a;
    real pc = 0.5 * (p.a + p.b), ph = 0.5 * (p.b - p.a), dc = depth_a + middle * change, dh = half * change;
    real pcc = pc * pc, phh = ph * ph, twice = (2.0 / 3) * (pc * ph), dcc = dc * dc, dhh = dh * dh;
    mask never = less(ga, zero()) & less(gb, zero());
    real curved = choose(never, zero(), slope * slope * (1.0 / 12));
    real cubes = dc * (dcc + dhh), cubes_t = dh * (dcc + 0.2 * dhh);
    real squares = (dc * (pcc + (1.0 / 3) * phh) + dh * twice) + curved * cubes;
    real squares_t = (dc * twice + dh * ((1.0 / 3) * pcc + 0.2 * phh)) + curved * cubes_t;
    real zeroth = length * squares;
    return (side_form){zeroth, middle * zeroth + half * (length * squares_t),
                       (length * (1.0 / 6)) * (slope * (pc * cubes + ph * cubes_t))};
}

/* The force of form drag on a side: p0 and pz are the integrals of p^2 and z p^2 over it by the square of its length,
   p1 that of s p^2. */
V8_INLINE void add_side_push(const prism_side *e, real along_a, real p0, real p1, real pz, prism_sum *sum)
{
    sum->force.x -= e->ey * p0;
    sum->force.y += e->ex * p0;
    sum->moment.x -= e->ex * pz;
    sum->moment.y -= e->ey * pz;
    sum->moment.z += along_a * p0 + p1;
}

V8_INLINE void add_side_form(const prism_stream *v, const prism_side *e, prism_sum *sum)
{
    /* Speed into the medium times the edge's length, at the middle plane, and its change with z. */
    real along_a = e->ex * e->xa + e->ey * e->ya;
    real ga = (e->ey * v->velocity.x - e->ex * v->velocity.y) - v->spin.z * along_a, gb = ga - v->spin.z * e->length2;
    real gz = e->ey * v->spin.y + e->ex * v->spin.x;
    real za = e->base_a + 0.5 * e->depth_a, zb = e->base_b + 0.5 * e->depth_b;
    side_form p = side_form_of(ga + gz * za, gb + gz * zb, gz, e->depth_a, e->depth_b);
    real p0 = e->inverse2 * p.zeroth;
    real pz = e->inverse2 * (za * p.zeroth + ((zb - za) * p.first + p.over_depth));
    add_side_push(e, along_a, p0, p.first, pz, sum);
}

/* With two Gauss points along the edge, and `layers` over its depth, one in the middle or two. */
V8_INLINE void add_layered_skin(const prism_stream *v, const prism_side *e, int layers, prism_sum *sum)
{
    real cross = e->xa * e->ey - e->ya * e->ex; /* of the edge about the axis */
    /* Speed along the edge times its length, at z = 0, and its change with z; vertical speed at both ends. */
    real q0 = e->ex * v->velocity.x + e->ey * v->velocity.y + v->spin.z * cross;
    real qz = e->ex * v->spin.y - e->ey * v->spin.x;
    real wa = v->velocity.z + v->spin.x * e->ya - v->spin.y * e->xa, dw = v->spin.x * e->ey - v->spin.y * e->ex;
    real along = zero(), along_z = zero(), up = zero(), up_s = zero();
#pragma GCC unroll 4
    for (int i = 0; i < 2 * layers; i++) {
        double s = i & 1 ? GAUSS_FAR : GAUSS_NEAR, t = layers == 1 ? 0.5 : i & 2 ? GAUSS_FAR : GAUSS_NEAR;
        real depth = e->depth_a + s * (e->depth_b - e->depth_a), base = e->base_a + s * (e->base_b - e->base_a);
        real w = wa + s * dw, z = base + t * depth, q = q0 + z * qz;
        real speed = depth * root(q * q + e->length2 * (w * w)), push = speed * q, lift = speed * w;
        along += push;
        along_z += push * z;
        up += lift;
        up_s += s * lift;
    }
    double weight = 0.5 / layers;
    real scale = weight * e->inverse2;
    along *= scale;
    along_z *= scale;
    up *= weight;
    up_s *= weight;
    sum->force.x -= e->ex * along;
    sum->force.y -= e->ey * along;
    sum->force.z -= up;
    sum->moment.x += e->ey * along_z - (e->ya * up + e->ey * up_s);
    sum->moment.y += (e->xa * up + e->ex * up_s) - e->ex * along_z;
    sum->moment.z -= cross * along;
}

V8_INLINE void add_side_skin(const prism_stream *v, const prism_side *e, prism_sum *sum)
{
    add_layered_skin(v, e, 1, sum);
}

/* ---- sides, over all of their depth ---- */

/* A side turns so slowly against how it goes that its depth does not matter: what differs in speed over the depth, over
   the largest speed.  What that leaves is of its third power; the exact way has lost twice as many digits. */
#define FLAT 1e-3

/* Integrals along an edge, s in [0, 1], of f^3, s f^3 and f^4, where f, linear along it, is positive. */
typedef struct edge_cubes {
    real cube, first, fourth;
} edge_cubes;

V8_INLINE edge_cubes edge_cubes_of(real fa, real fb)
{
    part p = positive_part(fa, fb);
    mask never = less(fa, zero()) & less(fb, zero());
    real length = choose(never, zero(), p.to - p.from);
    real a = p.a, b = p.b, aa = a * a, bb = b * b, ab = a * b, both = aa + bb;
    real cube = length * ((a + b) * both) * (1.0 / 4);
    real inner = a * aa + ab * (2 * a + 3 * b) + 4 * (b * bb);
    real fourth = length * (both * both + ab * (both - ab)) * (1.0 / 5);
    return (edge_cubes){cube, p.from * cube + (length * length) * inner * (1.0 / 20), fourth};
}

/* Integrals over a side's part of p^2, s p^2 and z p^2, p the inflow times the edge's length, where it is positive. */
typedef struct side_squares {
    real zeroth, first, height;
} side_squares;

/* Where the motion changes its sign over the side.  Over the depth p^2 dz integrates to p^3 / 3 p', which is linear
   along both borders of the side, p' the change with z. */
V8_INLINE side_squares parted_squares(const prism_side *e, real slope, real low_a, real low_b, real high_a, real high_b)
{
    edge_cubes low = edge_cubes_of(low_a, low_b), high = edge_cubes_of(high_a, high_b);
    real over = (1.0 / 3) / slope, top_a = e->base_a + e->depth_a, top_b = e->base_b + e->depth_b;
    real lifted = (top_a * high.cube + (top_b - top_a) * high.first) -
                  (e->base_a * low.cube + (e->base_b - e->base_a) * low.first);
    return (side_squares){over * (high.cube - low.cube), over * (high.first - low.first),
                          over * (lifted - 0.75 * over * (high.fourth - low.fourth))};
}

/* As add_side_form, exact also where the motion changes its sign over the depth. */
V8_INLINE void add_deep_side_form(const prism_stream *v, const prism_side *e, prism_sum *sum)
{
    real along_a = e->ex * e->xa + e->ey * e->ya;
    real ga = (e->ey * v->velocity.x - e->ex * v->velocity.y) - v->spin.z * along_a, gb = ga - v->spin.z * e->length2;
    real gz = e->ey * v->spin.y + e->ex * v->spin.x;
    real za = e->base_a + 0.5 * e->depth_a, zb = e->base_b + 0.5 * e->depth_b;
    side_form mean = side_form_of(ga + gz * za, gb + gz * zb, gz, e->depth_a, e->depth_b);
    side_squares p = {mean.zeroth, mean.first, za * mean.zeroth + ((zb - za) * mean.first + mean.over_depth)};
    real low_a = ga + gz * e->base_a, low_b = gb + gz * e->base_b;
    real high_a = low_a + gz * e->depth_a, high_b = low_b + gz * e->depth_b;
    real least = minimum(minimum(low_a, low_b), minimum(high_a, high_b));
    real most = maximum(maximum(low_a, low_b), maximum(high_a, high_b));
    real change = gz * maximum(e->depth_a, e->depth_b), size = FLAT * maximum(most, -least);
    mask parted = less(least, zero()) & less(zero(), most) & less(size * size, change * change);
    if (v8_part_bits(parted)) {
        side_squares exact = parted_squares(e, choose(parted, gz, set(1)), low_a, low_b, high_a, high_b);
        p.zeroth = choose(parted, exact.zeroth, p.zeroth);
        p.first = choose(parted, exact.first, p.first);
        p.height = choose(parted, exact.height, p.height);
    }
    real p0 = e->inverse2 * p.zeroth, pz = e->inverse2 * p.height;
    add_side_push(e, along_a, p0, p.first, pz, sum);
}

/* As add_side_skin, with two Gauss points over the depth too. */
V8_INLINE void add_deep_side_skin(const prism_stream *v, const prism_side *e, prism_sum *sum)
{
    add_layered_skin(v, e, 2, sum);
}

V8_INLINE void add_scaled(prism_sum *to, const prism_sum *add, real by)
{
    to->force.x += by * add->force.x, to->force.y += by * add->force.y, to->force.z += by * add->force.z;
    to->moment.x += by * add->moment.x, to->moment.y += by * add->moment.y, to->moment.z += by * add->moment.z;
}

#endif
