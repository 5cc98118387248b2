#include "fluid/level_kernel.h"
#include "base/simd.h"

/* Two Gauss points on [0, 1], each of weight 1/2. */
#define GAUSS_NEAR 0.21132486540518713
#define GAUSS_FAR 0.78867513459481287
/* Two points on [0, 1] for the weight rho (Gauss-Jacobi), exact to degree 3: (6 -+ sqrt 6)/10, and weights. */
#define RADIAL_NEAR 0.35505102572168219
#define RADIAL_FAR 0.84494897427831781
#define RADIAL_NEAR_WEIGHT 0.18195861825602283
#define RADIAL_FAR_WEIGHT 0.31804138174397717
/* Where the least inflow of a cap is more than this part of the largest, int p^2 over |g|^2 loses digits and the
   moments of the outline take over; below it both are good to a few roundings, and few caps need another pass. */
#define NEARLY_EVEN 0.875
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
   of their ends. */
V8_INLINE void add_hydrostatics(const level_batch *b, const level_floes *f, level_batch *out)
{
    level_moments m = outline_moments(b, f);
    real depth = f->water0 + f->half, s = f->waterx, t = f->watery;
    real volume = m.area * depth + (s * m.x + t * m.y);
    real3 first = {m.x * depth + (s * m.xx + t * m.xy), m.y * depth + (s * m.xy + t * m.yy), zero()};
    real h = f->water0;
    real squares = m.area * (h * h - f->half * f->half) + 2 * h * (s * m.x + t * m.y) +
                   (s * s * m.xx + 2 * s * t * m.xy + t * t * m.yy);
    first.z = 0.5 * squares;
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

/* Integrals over the part of a cap that moves into the medium of f^2, x f^2 and y f^2. */
typedef struct cap_form {
    real square, x, y;
} cap_form;

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

/* f of one sign and nearly even: by the moments of the outline up to the third. */
V8_INLINE cap_form whole_cap(const level_batch *b, const level_floes *f, real level, real gx, real gy)
{
    cap_form sum = {zero(), zero(), zero()};
    real xa = f->x[0], ya = f->y[0], fa = level + (gx * xa + gy * ya);
    for (int32_t k = 1; k <= b->sides; k++) {
        real xb = f->x[k], yb = f->y[k], fb = level + (gx * xb + gy * yb);
        /* The triangle from the origin, with f = level there: oracles' rule for int f^2 and int f^2 r. */
        real cross = xa * yb - xb * ya, s = level + (fa + fb), q = level * level + (fa * fa + fb * fb),
             both = s * s + q;
        real at_a = both + 2 * fa * (s + fa), at_b = both + 2 * fb * (s + fb);
        sum.square += cross * both;
        sum.x += cross * (xa * at_a + xb * at_b);
        sum.y += cross * (ya * at_a + yb * at_b);
        xa = xb;
        ya = yb;
        fa = fb;
    }
    return (cap_form){sum.square * (1.0 / 24), sum.x * (1.0 / 120), sum.y * (1.0 / 120)};
}

/* f of both signs, or of one that differs over the cap.  With p = f where it is positive: p^2 = div(p^3 g / 3) / |g|^2,
   and p^2 r = [div(p^3 r g / 3) - p^3 g / 3] / |g|^2, int p^3 / 3 the same way from p^4 / 12. */
V8_INLINE cap_form parted_cap(const level_batch *b, const level_floes *f, real level, real gx, real gy)
{
    real cubes = zero(), cubes_x = zero(), cubes_y = zero(), fourths = zero();
    real xa = f->x[0], ya = f->y[0], fa = level + (gx * xa + gy * ya);
    for (int32_t k = 1; k <= b->sides; k++) {
        real xb = f->x[k], yb = f->y[k], fb = level + (gx * xb + gy * yb);
        real ex = xb - xa, ey = yb - ya;
        part p = positive_part(fa, fb);
        real flux = (gx * ey - gy * ex) * (p.to - p.from);
        real aa = p.a * p.a, bb = p.b * p.b, ab = p.a * p.b, aaa = aa * p.a, bbb = bb * p.b, aab = aa * p.b,
             abb = ab * p.b;
        real near_a = flux * (4 * aaa + 3 * aab + (2 * abb + bbb)),
             near_b = flux * (aaa + 2 * aab + (3 * abb + 4 * bbb));
        cubes += flux * (aaa + aab + (abb + bbb));
        fourths += flux * (aaa * (p.a + p.b) + aa * bb + bbb * (p.a + p.b));
        cubes_x += near_a * (xa + p.from * ex) + near_b * (xa + p.to * ex);
        cubes_y += near_a * (ya + p.from * ey) + near_b * (ya + p.to * ey);
        xa = xb;
        ya = yb;
        fa = fb;
    }
    real g2 = gx * gx + gy * gy, inverse = 1 / choose(less(zero(), g2), g2, set(1));
    real third = fourths * (inverse * (1.0 / 60));
    return (cap_form){cubes * (inverse * (1.0 / 12)), inverse * (cubes_x * (1.0 / 60) - gx * third),
                      inverse * (cubes_y * (1.0 / 60) - gy * third)};
}

/* side: +1 for the top, -1 for the bottom. */
V8_INLINE void add_cap_form(const level_batch *b, const level_floes *f, real3 velocity, real form, double side,
                            level_sum *sum)
{
    real level = side * velocity.z, gx = -side * f->spin.y, gy = side * f->spin.x;
    real low = set(HUGE_VAL), high = set(-HUGE_VAL);
    for (int32_t k = 0; k < b->sides; k++) {
        real inflow = level + (gx * f->x[k] + gy * f->y[k]);
        low = minimum(low, inflow);
        high = maximum(high, inflow);
    }
    mask into = less(zero(), high), parted = into & less(low, NEARLY_EVEN * high);
    cap_form c = {zero(), zero(), zero()};
    if (v8_part_bits(parted))
        c = parted_cap(b, f, level, gx, gy);
    if (v8_part_bits(into & ~parted)) {
        cap_form whole = whole_cap(b, f, level, gx, gy);
        c = (cap_form){choose(parted, c.square, whole.square), choose(parted, c.x, whole.x),
                       choose(parted, c.y, whole.y)};
    }
    real push = choose(into, -side * form, zero());
    sum->force.z += push * c.square;
    sum->moment.x += push * c.y;
    sum->moment.y -= push * c.x;
}

/* ---- skin drag of a cap ---- */

/* Points on rays to points of the rim: at rho of the rim point (x, y) the square of the speed is a polynomial of rho.
   Sums of weight * speed, times 1, x, y and x^2 + y^2. */
typedef struct cap_skin {
    real one, x, y, square;
} cap_skin;

/* cross: twice the area of the edge's triangle. */
V8_INLINE void add_ray(cap_skin *sum, real x, real y, real cross, real u2, real bx, real by, real spin2)
{
    real r2 = x * x + y * y, linear = bx * x + by * y, square = spin2 * r2;
    real near2 = u2 + RADIAL_NEAR * (linear + RADIAL_NEAR * square);
    real far2 = u2 + RADIAL_FAR * (linear + RADIAL_FAR * square);
    real near = (0.5 * RADIAL_NEAR_WEIGHT) * cross * root(maximum(near2, zero()));
    real far = (0.5 * RADIAL_FAR_WEIGHT) * cross * root(maximum(far2, zero()));
    real first = RADIAL_NEAR * near + RADIAL_FAR * far;
    real second = (RADIAL_NEAR * RADIAL_NEAR) * near + (RADIAL_FAR * RADIAL_FAR) * far;
    sum->one += near + far;
    sum->x += first * x;
    sum->y += first * y;
    sum->square += second * r2;
}

V8_INLINE void add_cap_skin(const level_batch *b, const level_floes *f, real3 velocity, real skin, double side,
                            level_sum *sum)
{
    real z = side * f->half;
    real ux = velocity.x + f->spin.y * z, uy = velocity.y - f->spin.x * z, turn = f->spin.z;
    real u2 = ux * ux + uy * uy, bx = 2 * turn * uy, by = -2 * turn * ux, spin2 = turn * turn;
    cap_skin c = {zero(), zero(), zero(), zero()};
    real xa = f->x[0], ya = f->y[0];
    for (int32_t k = 1; k <= b->sides; k++) {
        real xb = f->x[k], yb = f->y[k], cross = xa * yb - xb * ya;
        real ex = GAUSS_NEAR * (xb - xa), ey = GAUSS_NEAR * (yb - ya);
        add_ray(&c, xa + ex, ya + ey, cross, u2, bx, by, spin2);
        add_ray(&c, xb - ex, yb - ey, cross, u2, bx, by, spin2);
        xa = xb;
        ya = yb;
    }
    real fx = -skin * (ux * c.one - turn * c.y), fy = -skin * (uy * c.one + turn * c.x);
    sum->force.x += fx;
    sum->force.y += fy;
    sum->moment.x -= z * fy;
    sum->moment.y += z * fx;
    sum->moment.z -= skin * (uy * c.x - ux * c.y + turn * c.square);
}

/* ---- sides ---- */

/* One edge of the outline, from a to b, and the part of its side in the medium: from height `base` up by `depth`, both
   linear along the edge. */
typedef struct level_side {
    real xa, ya, ex, ey, length2, inverse2; /* inverse2: 1/length^2 */
    real base_a, base_b, depth_a, depth_b;
} level_side;

/* int p^2 d and int s p^2 d over s in [0, 1], p the positive part of the linear function from ga to gb. */
V8_INLINE void add_form_line(real ga, real gb, real da, real db, real *sum0, real *sum1)
{
    part p = positive_part(ga, gb);
    real length = p.to - p.from, slope = db - da, d0 = da + p.from * slope, d1 = da + p.to * slope;
    real aa = p.a * p.a, bb = p.b * p.b, ab2 = 2 * p.a * p.b;
    /* Coefficients of (1 - t)^3, (1 - t)^2 t, ... */
    real c0 = aa * d0, c1 = aa * d1 + ab2 * d0, c2 = bb * d0 + ab2 * d1, c3 = bb * d1;
    real zeroth = length * ((c0 + c3) * 0.25 + (c1 + c2) * (1.0 / 12));
    real first = length * (c0 * 0.05 + c1 * (1.0 / 30) + c2 * 0.05 + c3 * 0.2);
    *sum0 = zeroth;
    *sum1 = p.from * zeroth + length * first;
}

/* lines: Gauss points over the depth, 1 or 2. */
V8_INLINE void add_side_form(const level_floes *f, real3 velocity, const level_side *e, int lines, level_sum *sum)
{
    static const double point[2][2] = {{0.5, 0}, {GAUSS_NEAR, GAUSS_FAR}};
    /* Speed into the medium times the edge's length, at the middle plane, and its change with z. */
    real along_a = e->ex * e->xa + e->ey * e->ya;
    real ga = (e->ey * velocity.x - e->ex * velocity.y) - f->spin.z * along_a, gb = ga - f->spin.z * e->length2;
    real gz = e->ey * f->spin.y + e->ex * f->spin.x;
    real p0 = zero(), p1 = zero(), pz = zero();
#pragma GCC unroll 2
    for (int i = 0; i < lines; i++) {
        double at = point[lines - 1][i];
        real za = e->base_a + at * e->depth_a, zb = e->base_b + at * e->depth_b, s0, s1;
        add_form_line(ga + gz * za, gb + gz * zb, e->depth_a, e->depth_b, &s0, &s1);
        p0 += s0;
        p1 += s1;
        pz += za * s0 + (zb - za) * s1;
    }
    real share = e->inverse2 * (1.0 / lines);
    p0 *= share;
    pz *= share;
    sum->force.x -= e->ey * p0;
    sum->force.y += e->ex * p0;
    sum->moment.x -= e->ex * pz;
    sum->moment.y -= e->ey * pz;
    sum->moment.z += along_a * p0 + (1.0 / lines) * p1;
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

/* side: -1 for the wet part between the bottom and the waterline, +1 for the dry one above it; lines: of form drag. */
V8_INLINE level_sum drag_of(const level_batch *b, const level_floes *f, const level_stream *medium, const real *line,
                            double side, int lines)
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
        add_side_form(f, velocity, &e, lines, &form_sum);
        add_side_skin(f, velocity, &e, &skin_sum);
        xa = xb;
        ya = yb;
        la = lb;
    }
    add_scaled(&sum, &form_sum, form);
    add_scaled(&sum, &skin_sum, skin);
    add_cap_form(b, f, velocity, form, side, &sum);
    add_cap_skin(b, f, velocity, skin, side, &sum);
    return sum;
}

/* The floes of one part; bit i of the result: floe at + i is level. */
static unsigned part_loads(level_batch *b, int at)
{
    level_floes f;
    f.at = at;
    read_floes(b, &f);
    real line[LEVEL_VERTICES + 1];
    unsigned level = find_waterline(b, &f, line);
    if (level == 0)
        return 0;
    add_hydrostatics(b, &f, b);
    if (b->wet) {
        level_sum water = drag_of(b, &f, &b->water, line, -1, 2);
        store_global(&f, b->water_drag.force, water.force);
        store_global(&f, b->water_drag.moment, water.moment);
    }
    if (b->dry) {
        level_sum air = drag_of(b, &f, &b->air, line, 1, 1);
        store_global(&f, b->air_drag.force, air.force);
        store_global(&f, b->air_drag.moment, air.moment);
    }
    add_up(b, b, at);
    return level;
}

void KERNEL(level_loads)(level_batch *batch)
{
    batch->level = 0;
    for (int at = 0; at < LEVEL_LANES; at += PART_LANES)
        batch->level |= part_loads(batch, at) << at;
}
