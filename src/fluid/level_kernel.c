#include "fluid/level_kernel.h"
#include "base/simd.h"

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

/* As many floes as one register holds: the batch is worked on in parts of that many. */
typedef v8_part real;
typedef v8_part_mask mask;
#define PART_LANES V8_PART_LANES

typedef struct real3 {
    real x, y, z;
} real3;

V8_INLINE real zero(void) { return (real){0}; }
V8_INLINE real set(double x) { return x - zero(); }
V8_INLINE real minimum(real a, real b) { return v8_part_min(a, b); }
V8_INLINE real maximum(real a, real b) { return v8_part_max(a, b); }
V8_INLINE real root(real a) { return v8_part_sqrt(a); }
V8_INLINE mask less(real a, real b) { return (mask)(a < b); }
V8_INLINE mask less_equal(real a, real b) { return (mask)(a <= b); }
V8_INLINE real choose(mask m, real a, real b) { return v8_part_select(m, a, b); }

/* The numbers of this part, which begins at lane `at`. */
V8_INLINE real load(const double *lanes, int at)
{
    real x;
    memcpy(&x, lanes + at, sizeof x);
    return x;
}

V8_INLINE void store(double *lanes, int at, real x) { memcpy(lanes + at, &x, sizeof x); }

/* What all passes need of the floes, body axes. */
typedef struct level_floes {
    int at;       /* first lane of the part */
    real r[3][3]; /* rotation, body to global */
    real half;
    mask sunken;
    real water0, waterx, watery; /* height of the water plane in the body's z: water0 + waterx x + watery y */
    real3 spin;
    real x[LEVEL_VERTICES + 1], y[LEVEL_VERTICES + 1]; /* outline */
} level_floes;

/* Force and moment in the body's axes. */
typedef struct level_sum {
    real3 force, moment;
} level_sum;

V8_INLINE real3 load_vec(const level_lane *p, int at)
{
    return (real3){load(p[0], at), load(p[1], at), load(p[2], at)};
}

/* Global to body axes. */
V8_INLINE real3 to_body(const level_floes *f, real3 v)
{
    return (real3){f->r[0][0] * v.x + f->r[1][0] * v.y + f->r[2][0] * v.z,
                   f->r[0][1] * v.x + f->r[1][1] * v.y + f->r[2][1] * v.z,
                   f->r[0][2] * v.x + f->r[1][2] * v.y + f->r[2][2] * v.z};
}

V8_INLINE void store_global(const level_floes *f, level_lane *out, real3 v)
{
    for (int i = 0; i < 3; i++)
        store(out[i], f->at, f->r[i][0] * v.x + f->r[i][1] * v.y + f->r[i][2] * v.z);
}

/* The same order for every floe: hydrostatics + (water + air). */
V8_INLINE void add_up(const level_batch *b, level_batch *out, int at)
{
    const real none = zero();
    for (int i = 0; i < 3; i++) {
        real water = b->wet ? load(b->water_drag.force[i], at) : none;
        real air = b->dry ? load(b->air_drag.force[i], at) : none;
        store(out->total.force[i], at, load(b->hydrostatic.force[i], at) + (water + air));
        water = b->wet ? load(b->water_drag.moment[i], at) : none;
        air = b->dry ? load(b->air_drag.moment[i], at) : none;
        store(out->total.moment[i], at, load(b->hydrostatic.moment[i], at) + (water + air));
    }
}

V8_INLINE void read_floes(const level_batch *b, level_floes *f)
{
    real w = load(b->turn[0], f->at), x = load(b->turn[1], f->at), y = load(b->turn[2], f->at),
         z = load(b->turn[3], f->at);
    real xx = x * x, yy = y * y, zz = z * z, xy = x * y, xz = x * z, yz = y * z, wx = w * x, wy = w * y, wz = w * z;
    f->r[0][0] = 1 - 2 * (yy + zz), f->r[0][1] = 2 * (xy - wz), f->r[0][2] = 2 * (xz + wy);
    f->r[1][0] = 2 * (xy + wz), f->r[1][1] = 1 - 2 * (xx + zz), f->r[1][2] = 2 * (yz - wx);
    f->r[2][0] = 2 * (xz - wy), f->r[2][1] = 2 * (yz + wx), f->r[2][2] = 1 - 2 * (xx + yy);
    f->half = load(b->half, f->at);
    f->spin = to_body(f, load_vec(b->spin, f->at));
    real scale = -1 / f->r[2][2];
    f->water0 = load(b->height, f->at) * scale;
    f->waterx = f->r[2][0] * scale;
    f->watery = f->r[2][1] * scale;
    for (int32_t k = 0; k <= b->sides; k++)
        v8_part_load_pairs(&b->corner[k][f->at].x, &f->x[k], &f->y[k]);
}

/* The waterline's height on each corner, and which floes are level: all corners between the caps, top side up. */
V8_INLINE unsigned find_waterline(const level_batch *b, const level_floes *f, real *line)
{
    real low = set(HUGE_VAL), high = set(-HUGE_VAL);
    for (int32_t k = 0; k <= b->sides; k++) {
        real z = f->water0 + (f->waterx * f->x[k] + f->watery * f->y[k]);
        line[k] = z;
        low = minimum(low, z);
        high = maximum(high, z);
    }
    mask between = less_equal(-f->half, low) & less_equal(high, f->half);
    return v8_part_bits(between & less(zero(), f->r[2][2]));
}

/* Which floes have their highest corner in the water, whichever side is up. */
V8_INLINE mask find_sunken(const level_batch *b, const level_floes *f)
{
    real high = set(-HUGE_VAL);
    for (int32_t k = 0; k <= b->sides; k++)
        high = maximum(high, f->r[2][0] * f->x[k] + f->r[2][1] * f->y[k]);
    real rise = f->half * maximum(f->r[2][2], -f->r[2][2]);
    return less_equal(load(b->height, f->at) + high + rise, b->level_only ? set(-HUGE_VAL) : zero());
}

/* ---- hydrostatics ---- */

/* Integrals over the outline, about the body's axis, of 1, x, y, x^2, y^2 and x y. */
typedef struct level_moments {
    real area, x, y, xx, yy, xy;
} level_moments;

V8_INLINE level_moments outline_moments(const level_batch *b, const level_floes *f)
{
    level_moments m = {zero(), zero(), zero(), zero(), zero(), zero()};
    real xa = f->x[0], ya = f->y[0];
    for (int32_t k = 1; k <= b->sides; k++) {
        real xb = f->x[k], yb = f->y[k];
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

/* Columns over the outline from the lower cap to the water plane: their lengths, and half the difference of the squares
   of their ends; from cap to cap of what is sunken. */
V8_INLINE void add_hydrostatics(const level_batch *b, const level_floes *f, const level_moments *m, level_batch *out)
{
    real depth = f->water0 + f->half, s = f->waterx, t = f->watery;
    real volume = m->area * depth + (s * m->x + t * m->y);
    real3 first = {m->x * depth + (s * m->xx + t * m->xy), m->y * depth + (s * m->xy + t * m->yy), zero()};
    real h = f->water0;
    real squares = m->area * (h * h - f->half * f->half) + 2 * h * (s * m->x + t * m->y) +
                   (s * s * m->xx + 2 * s * t * m->xy + t * t * m->yy);
    first.z = choose(f->sunken, zero(), 0.5 * squares);
    real thickness = 2 * f->half;
    volume = choose(f->sunken, thickness * m->area, volume);
    first.x = choose(f->sunken, thickness * m->x, first.x);
    first.y = choose(f->sunken, thickness * m->y, first.y);
    real gx = f->r[0][0] * first.x + f->r[0][1] * first.y + f->r[0][2] * first.z;
    real gy = f->r[1][0] * first.x + f->r[1][1] * first.y + f->r[1][2] * first.z;
    store(out->volume, f->at, volume);
    store(out->hydrostatic.force[0], f->at, zero());
    store(out->hydrostatic.force[1], f->at, zero());
    store(out->hydrostatic.force[2], f->at, b->weight * volume);
    store(out->hydrostatic.moment[0], f->at, b->weight * gy);
    store(out->hydrostatic.moment[1], f->at, -b->weight * gx);
    store(out->hydrostatic.moment[2], f->at, zero());
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

/* side: +1 for the top, -1 for the bottom.  Integrals over the part of the cap where the inflow f is positive, of f^2
   and f^2 r, by triangles from one point to the edges' parts with f > 0: from the axis while f > 0 everywhere, else
   from the point of the line f = 0 that is nearest to it, about which this line spans no triangle. */
V8_INLINE void add_cap_form(const level_batch *b, const level_floes *f, real3 velocity, real form, double side,
                            level_sum *sum)
{
    real level = side * velocity.z, gx = -side * f->spin.y, gy = side * f->spin.x;
    real low = set(HUGE_VAL), high = set(-HUGE_VAL), inflow[LEVEL_VERTICES + 1];
    for (int32_t k = 0; k <= b->sides; k++) {
        inflow[k] = level + (gx * f->x[k] + gy * f->y[k]);
        low = minimum(low, inflow[k]);
        high = maximum(high, inflow[k]);
    }
    mask into = less(zero(), high), parted = into & less(low, zero());
    if (!v8_part_bits(into))
        return;
    real g2 = gx * gx + gy * gy, away = choose(parted, -level / choose(less(zero(), g2), g2, set(1)), zero());
    real cx = away * gx, cy = away * gy, at_c = choose(parted, zero(), level), at_c2 = at_c * at_c;
    real square = zero(), x = zero(), y = zero();
    real xa = f->x[0] - cx, ya = f->y[0] - cy;
    for (int32_t k = 1; k <= b->sides; k++) {
        real xb = f->x[k] - cx, yb = f->y[k] - cy, ex = xb - xa, ey = yb - ya;
        part p = positive_part(inflow[k - 1], inflow[k]);
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
    }
    real push = choose(into, -side * form, zero());
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
V8_INLINE cap_skin turning_skin(const level_batch *b, const level_floes *f, real ux, real uy, real turn)
{
    cap_skin c = {zero(), zero(), zero()};
    real va = ux - turn * f->y[0], wa = uy + turn * f->x[0];
    for (int32_t k = 1; k <= b->sides; k++) {
        real vb = ux - turn * f->y[k], wb = uy + turn * f->x[k];
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
V8_INLINE cap_skin even_skin(const level_moments *m, real ux, real uy, real turn, real speed2)
{
    real speed = root(speed2), over = turn / choose(less(zero(), speed), speed, set(1));
    /* |v| = speed + over (u . z x r), and int of u . z x r times 1, x and y. */
    real along = uy * m->x - ux * m->y, along_x = uy * m->xx - ux * m->xy, along_y = uy * m->xy - ux * m->yy;
    real whole = speed * m->area + over * along, rate = speed * turn;
    return (cap_skin){whole * ux - rate * m->y, whole * uy + rate * m->x,
                      speed * along + (over * (uy * along_x - ux * along_y) + rate * (m->xx + m->yy))};
}

V8_INLINE void add_cap_skin(const level_batch *b, const level_floes *f, const level_moments *m, real3 velocity,
                            real skin, double side, level_sum *sum)
{
    real z = side * f->half;
    real ux = velocity.x + f->spin.y * z, uy = velocity.y - f->spin.x * z, turn = f->spin.z;
    real speed2 = ux * ux + uy * uy, turn2 = turn * turn;
    mask even = less_equal(turn2 * (m->xx + m->yy), EVEN * EVEN * (m->area * speed2));
    cap_skin c = turning_skin(b, f, ux, uy, turn), flat = even_skin(m, ux, uy, turn, speed2);
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
typedef struct level_side {
    real xa, ya, ex, ey, length2, inverse2; /* inverse2: 1/length^2 */
    real base_a, base_b, depth_a, depth_b;
} level_side;

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

V8_INLINE void add_side_form(const level_floes *f, real3 velocity, const level_side *e, level_sum *sum)
{
    /* Speed into the medium times the edge's length, at the middle plane, and its change with z. */
    real along_a = e->ex * e->xa + e->ey * e->ya;
    real ga = (e->ey * velocity.x - e->ex * velocity.y) - f->spin.z * along_a, gb = ga - f->spin.z * e->length2;
    real gz = e->ey * f->spin.y + e->ex * f->spin.x;
    real za = e->base_a + 0.5 * e->depth_a, zb = e->base_b + 0.5 * e->depth_b;
    side_form p = side_form_of(ga + gz * za, gb + gz * zb, gz, e->depth_a, e->depth_b);
    real p0 = e->inverse2 * p.zeroth;
    real pz = e->inverse2 * (za * p.zeroth + ((zb - za) * p.first + p.over_depth));
    sum->force.x -= e->ey * p0;
    sum->force.y += e->ex * p0;
    sum->moment.x -= e->ex * pz;
    sum->moment.y -= e->ey * pz;
    sum->moment.z += along_a * p0 + p.first;
}

V8_INLINE void add_side_skin(const level_floes *f, real3 velocity, const level_side *e, level_sum *sum)
{
    real cross = e->xa * e->ey - e->ya * e->ex; /* of the edge about the axis */
    /* Speed along the edge times its length, at z = 0, and its change with z; vertical speed at both ends. */
    real q0 = e->ex * velocity.x + e->ey * velocity.y + f->spin.z * cross;
    real qz = e->ex * f->spin.y - e->ey * f->spin.x;
    real wa = velocity.z + f->spin.x * e->ya - f->spin.y * e->xa, dw = f->spin.x * e->ey - f->spin.y * e->ex;
    real along = zero(), along_z = zero(), up = zero(), up_s = zero();
#pragma GCC unroll 2
    for (int i = 0; i < 2; i++) {
        double s = i ? GAUSS_FAR : GAUSS_NEAR;
        real depth = e->depth_a + s * (e->depth_b - e->depth_a), base = e->base_a + s * (e->base_b - e->base_a);
        real w = wa + s * dw, z = base + 0.5 * depth, q = q0 + z * qz;
        real speed = depth * root(q * q + e->length2 * (w * w)), push = speed * q, lift = speed * w;
        along += push;
        along_z += push * z;
        up += lift;
        up_s += s * lift;
    }
    real scale = 0.5 * e->inverse2;
    along *= scale;
    along_z *= scale;
    up *= 0.5;
    up_s *= 0.5;
    sum->force.x -= e->ex * along;
    sum->force.y -= e->ey * along;
    sum->force.z -= up;
    sum->moment.x += e->ey * along_z - (e->ya * up + e->ey * up_s);
    sum->moment.y += (e->xa * up + e->ex * up_s) - e->ex * along_z;
    sum->moment.z -= cross * along;
}

V8_INLINE void add_scaled(level_sum *to, const level_sum *add, real by)
{
    to->force.x += by * add->force.x, to->force.y += by * add->force.y, to->force.z += by * add->force.z;
    to->moment.x += by * add->moment.x, to->moment.y += by * add->moment.y, to->moment.z += by * add->moment.z;
}

/* side: -1 for the wet part between the bottom and the waterline, +1 for the dry one above it. */
V8_INLINE level_sum drag_of(const level_batch *b, const level_floes *f, const level_moments *m,
                            const level_stream *medium, const real *line, double side)
{
    level_sum sum = {{zero(), zero(), zero()}, {zero(), zero(), zero()}}, form_sum = sum, skin_sum = sum;
    real3 velocity = to_body(f, load_vec(medium->velocity, f->at));
    real form = load(medium->form, f->at), skin = load(medium->skin, f->at);
    real xa = f->x[0], ya = f->y[0], la = line[0];
    for (int32_t k = 1; k <= b->sides; k++) {
        real xb = f->x[k], yb = f->y[k], lb = line[k];
        level_side e = {.xa = xa, .ya = ya, .ex = xb - xa, .ey = yb - ya};
        e.length2 = e.ex * e.ex + e.ey * e.ey;
        e.inverse2 = 1 / maximum(e.length2, set(NO_LENGTH));
        e.base_a = side < 0 ? -f->half : la;
        e.base_b = side < 0 ? -f->half : lb;
        e.depth_a = f->half - side * la;
        e.depth_b = f->half - side * lb;
        add_side_form(f, velocity, &e, &form_sum);
        add_side_skin(f, velocity, &e, &skin_sum);
        xa = xb;
        ya = yb;
        la = lb;
    }
    add_scaled(&sum, &form_sum, form);
    add_scaled(&sum, &skin_sum, skin);
    add_cap_form(b, f, velocity, form, side, &sum);
    add_cap_skin(b, f, m, velocity, skin, side, &sum);
    return sum;
}

V8_INLINE real3 choose3(mask m, real3 a, real3 b)
{
    return (real3){choose(m, a.x, b.x), choose(m, a.y, b.y), choose(m, a.z, b.z)};
}

/* What the water does to the upper caps of sunken floes, added. */
V8_INLINE void add_sunken_caps(const level_batch *b, const level_floes *f, const level_moments *m, level_sum *water)
{
    level_sum whole = *water;
    real3 velocity = to_body(f, load_vec(b->water.velocity, f->at));
    add_cap_form(b, f, velocity, load(b->water.form, f->at), 1, &whole);
    add_cap_skin(b, f, m, velocity, load(b->water.skin, f->at), 1, &whole);
    water->force = choose3(f->sunken, whole.force, water->force);
    water->moment = choose3(f->sunken, whole.moment, water->moment);
}

V8_INLINE void store_vec(level_lane *out, int at, real3 v)
{
    store(out[0], at, v.x);
    store(out[1], at, v.y);
    store(out[2], at, v.z);
}

/* The drag of one medium that `sum` is, or none: as an answer, and as what may be held. */
V8_INLINE void store_drag(const level_floes *f, const level_sum *sum, level_wrench *answer, level_wrench *held)
{
    store_global(f, answer->force, sum->force);
    store_global(f, answer->moment, sum->moment);
    store_vec(held->force, f->at, sum->force);
    store_vec(held->moment, f->at, sum->moment);
}

V8_INLINE void store_state(const level_batch *b, const level_floes *f, const level_moments *m, level_state *out)
{
    const real moments[6] = {m->area, m->x, m->y, m->xx, m->yy, m->xy};
    const real3 none = {zero(), zero(), zero()};
    for (int i = 0; i < 6; i++)
        store(out->moments[i], f->at, moments[i]);
    store_vec(out->line, f->at, (real3){f->water0, f->waterx, f->watery});
    store_vec(out->spin, f->at, f->spin);
    store_vec(out->through_water, f->at, to_body(f, load_vec(b->water.velocity, f->at)));
    store_vec(out->through_air, f->at, b->dry ? to_body(f, load_vec(b->air.velocity, f->at)) : none);
}

/* The floes of one part. */
static void part_loads(level_batch *b, int at)
{
    level_floes f;
    f.at = at;
    read_floes(b, &f);
    real line[LEVEL_VERTICES + 1];
    unsigned level = find_waterline(b, &f, line);
    f.sunken = find_sunken(b, &f);
    unsigned sunken = v8_part_bits(f.sunken);
    level &= ~sunken;
    b->level |= level << at;
    b->sunken |= sunken << at;
    if ((level | sunken) == 0)
        return;
    for (int32_t k = 0; k <= b->sides && sunken; k++)
        line[k] = choose(f.sunken, f.half, line[k]);
    level_moments m = outline_moments(b, &f);
    add_hydrostatics(b, &f, &m, b);
    store_state(b, &f, &m, &b->state);
    const level_sum none = {{zero(), zero(), zero()}, {zero(), zero(), zero()}};
    level_sum water = b->wet ? drag_of(b, &f, &m, &b->water, line, -1) : none;
    if (b->wet && sunken)
        add_sunken_caps(b, &f, &m, &water);
    store_drag(&f, &water, &b->water_drag, &b->state.water_drag);
    level_sum air = b->dry && level ? drag_of(b, &f, &m, &b->air, line, 1) : none;
    air.force = choose3(f.sunken, none.force, air.force);
    air.moment = choose3(f.sunken, none.moment, air.moment);
    store_drag(&f, &air, &b->air_drag, &b->state.air_drag);
    add_up(b, b, at);
}

void KERNEL(level_loads)(level_batch *batch)
{
    batch->level = batch->sunken = 0;
    for (int at = 0; at < LEVEL_LANES; at += PART_LANES)
        part_loads(batch, at);
}
