/* See solver_sweep_kernel.h.  A point's impulse changes the velocity at the point by K, a symmetric 3 x 3 matrix; along
   normal and tangents its parts are the normal's mass, the coupling of normal and tangents, and the tangent block.  The
   normal is solved first and the tangents with what it leaves of their velocity, so that one application to the bodies
   serves all three.

   The lanes of a batch are worked one register of them after the other, since they know nothing of each other: where
   eight are several registers, gcc 12 keeps what is written for all eight in memory between operations.  All bodies of
   a batch are read before any is written, so that a body which nothing moves is the same in all lanes that it is in. */
#include "dynamics/solver_sweep_kernel.h"

#include "base/parts.h"

enum { LANES = V8_PART_LANES, PARTS = V8_PARTS };

/* A body in each lane. */
typedef struct lanes_body {
    real3 velocity, spin;
    real inertia[6]; /* inverse, xx yy zz xy xz yz */
    real mass[6];    /* inverse; only [0] unless it depends on the direction */
    real give;       /* of guided bodies, where the mass depends on the direction */
} lanes_body;

typedef struct lanes_frame {
    real3 normal, tangent[2];
} lanes_frame;

/* ---- rows in and out ---- */

/* The view of the lanes from LANES part on; body rows are not lanes, and stay. */
V8_INLINE batch_view part_view(const batch_view *view, int part)
{
    batch_view shifted = *view;
    shifted.frame += LANES * part;
    shifted.point += LANES * part;
    shifted.impulse += LANES * part;
    return shifted;
}

V8_INLINE real row(const double *rows, int i) { return load(rows + (ptrdiff_t)BATCH_LANES * i); }
V8_INLINE real3 row3(const double *rows, int i) { return (real3){row(rows, i), row(rows, i + 1), row(rows, i + 2)}; }
V8_INLINE void put(double *rows, int i, real x) { store(rows + (ptrdiff_t)BATCH_LANES * i, x); }

V8_INLINE lanes_body body_load(const batch_view *view, const int32_t *rows, bool general)
{
    lanes_body body;
    real c[BODY_ROW];
    v8_part_gather_rows(view->velocity, rows, c);
    body.velocity = (real3){c[BODY_VELOCITY], c[BODY_VELOCITY + 1], c[BODY_VELOCITY + 2]};
    body.spin = (real3){c[BODY_SPIN], c[BODY_SPIN + 1], c[BODY_SPIN + 2]};
    v8_part_gather_rows(view->inverse, rows, c);
    body.inertia[0] = c[INVERSE_INERTIA];
    body.inertia[1] = c[INVERSE_INERTIA + 1];
    body.inertia[2] = c[INVERSE_INERTIA + 2];
    body.inertia[3] = c[INVERSE_INERTIA + 3];
    body.inertia[4] = c[INVERSE_INERTIA + 4];
    body.inertia[5] = c[INVERSE_INERTIA + 5];
    body.mass[0] = c[INVERSE_MASS];
    if (general) {
        v8_part_gather_rows(view->tensor, rows, c);
        body.mass[0] = c[0];
        body.mass[1] = c[1];
        body.mass[2] = c[2];
        body.mass[3] = c[3];
        body.mass[4] = c[4];
        body.mass[5] = c[5];
        body.give = c[TENSOR_GIVE];
    }
    return body;
}

/* What a batch does to both bodies of its lanes, until all parts are done. */
typedef struct lanes_motion {
    real3 velocity, spin;
} lanes_motion;
typedef struct batch_motion {
    lanes_motion a[PARTS], b[PARTS];
} batch_motion;

V8_INLINE void motion_keep(batch_motion *after, int part, const lanes_body *a, const lanes_body *b)
{
    after->a[part] = (lanes_motion){a->velocity, a->spin};
    after->b[part] = (lanes_motion){b->velocity, b->spin};
}

V8_INLINE void motion_put(const batch_view *view, const int32_t *rows, const lanes_motion *m)
{
    real zero = v8_part_set(0);
    real c[BODY_ROW] = {m->velocity.x, m->velocity.y, m->velocity.z, m->spin.x, m->spin.y, m->spin.z, zero, zero};
    v8_part_scatter_rows(view->velocity, rows, c);
}

V8_INLINE void motion_store(const batch_view *view, const contact_batch *batch, const batch_motion *after)
{
    for (int h = 0; h < PARTS; h++)
        motion_put(view, batch->a + LANES * h, &after->a[h]);
    for (int h = 0; h < PARTS; h++)
        motion_put(view, batch->b + LANES * h, &after->b[h]);
}

V8_INLINE lanes_body first_body(const batch_view *view, const contact_batch *batch, int part, bool general)
{
    return body_load(view, batch->a + LANES * part, general);
}

V8_INLINE lanes_body second_body(const batch_view *view, const contact_batch *batch, int part, bool general)
{
    return body_load(view, batch->b + LANES * part, general);
}

/* Tangents as contact_tangents makes them, to the bit. */
V8_INLINE lanes_frame frame_load(const batch_view *view, int32_t number)
{
    const double *rows = view->frame + (ptrdiff_t)FRAME_ROWS * BATCH_LANES * number;
    lanes_frame f = {.normal = row3(rows, FRAME_NORMAL)};
    real3 n = f.normal;
    real one = v8_part_set(1), minus_zero = v8_part_set(-0.0);
    real sign = (real)((mask)one | ((mask)n.z & (mask)minus_zero));
    real a = -1 / (sign + n.z), b = n.x * n.y * a;
    f.tangent[0] = (real3){1 + sign * n.x * n.x * a, sign * b, -sign * n.x};
    f.tangent[1] = (real3){b, sign + n.y * n.y * a, -n.y};
    return f;
}

V8_INLINE double *point_rows(const batch_view *view, int32_t point)
{
    return view->point + (ptrdiff_t)POINT_ROWS * BATCH_LANES * point;
}

V8_INLINE double *impulse_rows(const batch_view *view, int32_t point)
{
    return view->impulse + (ptrdiff_t)IMPULSE_ROWS * BATCH_LANES * point;
}

/* Every copy of a hub starts with its velocity; afterwards the hub has their mean. */
static void hub_spread(const batch_view *view, const contact_batch *batch)
{
    for (int i = 0; batch->hub >= 0 && i < BATCH_LANES; i++)
        memcpy(view->velocity + (ptrdiff_t)BODY_ROW * (batch->copies + i),
               view->velocity + (ptrdiff_t)BODY_ROW * batch->hub, BODY_ROW * sizeof(double));
}

static void hub_collect(const batch_view *view, const contact_batch *batch)
{
    if (batch->hub < 0)
        return;
    double *hub = view->velocity + (ptrdiff_t)BODY_ROW * batch->hub;
    const double *copy = view->velocity + (ptrdiff_t)BODY_ROW * batch->copies;
    for (int k = 0; k < BODY_ROW; k++) {
        double sum = 0;
        for (int i = 0; i < BATCH_LANES; i++)
            sum += copy[BODY_ROW * i + k] - hub[k];
        hub[k] += sum / BATCH_LANES;
    }
}

/* ---- one point ---- */

V8_INLINE real3 velocity_at(const lanes_body *a, const lanes_body *b, real3 arm_a, real3 arm_b)
{
    return sub(add(a->velocity, cross(a->spin, arm_a)), add(b->velocity, cross(b->spin, arm_b)));
}

V8_INLINE real3 pushed(const lanes_body *body, real3 impulse, bool general)
{
    return general ? sym3_times(body->mass, impulse) : scale(impulse, body->mass[0]);
}

V8_INLINE void apply(lanes_body *a, lanes_body *b, real3 arm_a, real3 arm_b, real3 impulse, bool general)
{
    a->velocity = add(a->velocity, pushed(a, impulse, general));
    a->spin = add(a->spin, sym3_times(a->inertia, cross(arm_a, impulse)));
    b->velocity = sub(b->velocity, pushed(b, impulse, general));
    b->spin = sub(b->spin, sym3_times(b->inertia, cross(arm_b, impulse)));
}

/* K times a direction. */
V8_INLINE real3 response(const lanes_body *a, const lanes_body *b, real3 arm_a, real3 arm_b, real3 d, bool general)
{
    real3 angular_a = sym3_times(a->inertia, cross(arm_a, d)), angular_b = sym3_times(b->inertia, cross(arm_b, d));
    return add(add(pushed(a, d, general), cross(angular_a, arm_a)),
               add(pushed(b, d, general), cross(angular_b, arm_b)));
}

V8_INLINE real3 composed(const lanes_frame *f, real p0, real p1, real p2)
{
    return add(add(scale(f->normal, p0), scale(f->tangent[0], p1)), scale(f->tangent[1], p2));
}

/* 1 / x where x > 0, else 0: lanes without a contact. */
V8_INLINE real inverse_or_zero(real x)
{
    real zero = v8_part_set(0), one = v8_part_set(1);
    mask positive = less(zero, x);
    return choose(positive, 1 / choose(positive, x, one), zero);
}

/* ---- solver_prepare ---- */

V8_INLINE void prepare_part(const batch_view *view, int32_t number, int part, bool general)
{
    const contact_batch *batch = &view->batch[number];
    lanes_body a = first_body(view, batch, part, general), b = second_body(view, batch, part, general);
    lanes_frame f = frame_load(view, number);
    for (int32_t k = 0; k < batch->points; k++) {
        double *p = point_rows(view, batch->first + k);
        real3 arm_a = row3(p, POINT_ARM_A), arm_b = row3(p, POINT_ARM_B);
        real3 n = response(&a, &b, arm_a, arm_b, f.normal, general);
        real3 t1 = response(&a, &b, arm_a, arm_b, f.tangent[0], general);
        real3 t2 = response(&a, &b, arm_a, arm_b, f.tangent[1], general);
        real k00 = dot(f.normal, n), k11 = dot(f.tangent[0], t1), k12 = dot(f.tangent[1], t1);
        real k22 = dot(f.tangent[1], t2);
        if (general) {
            real give = a.give + b.give;
            k00 = k00 + give;
            k11 = k11 + give;
            k22 = k22 + give;
        }
        real share = inverse_or_zero(k11 * k22 - k12 * k12), slide = 2 * inverse_or_zero(k11 + k22);
        real3 u = velocity_at(&a, &b, arm_a, arm_b);
        real u1 = dot(f.tangent[0], u), u2 = dot(f.tangent[1], u);
        put(p, POINT_MASS, inverse_or_zero(k00));
        put(p, POINT_COUPLING, dot(f.tangent[0], n));
        put(p, POINT_COUPLING + 1, dot(f.tangent[1], n));
        put(p, POINT_STICK, k22 * share);
        put(p, POINT_STICK + 1, -k12 * share);
        put(p, POINT_STICK + 2, k11 * share);
        put(p, POINT_SLIDE, slide);
        put(p, POINT_SLIP, v8_part_sqrt(u1 * u1 + u2 * u2) * slide);
    }
}

void KERNEL(solver_prepare)(const batch_view *view, int32_t first, int32_t end)
{
    for (int32_t i = first; i < end; i++) {
        hub_spread(view, &view->batch[i]);
        for (int h = 0; h < PARTS; h++) {
            batch_view part = part_view(view, h);
            if (view->batch[i].general)
                prepare_part(&part, i, h, true);
            else
                prepare_part(&part, i, h, false);
        }
    }
}

/* ---- friction ---- */

typedef struct friction_lanes {
    real at_rest, sliding;
} friction_lanes;

V8_INLINE friction_lanes friction_load(const batch_view *view, int32_t number)
{
    const double *rows = view->frame + (ptrdiff_t)FRAME_ROWS * BATCH_LANES * number;
    return (friction_lanes){row(rows, FRAME_STATIC), row(rows, FRAME_KINETIC)};
}

/* As friction_radius of solver_contacts.c. */
V8_INLINE real radius_of(const friction_lanes *mu, real slip, real normal)
{
    real kinetic = mu->sliding * normal;
    return choose(less(kinetic, slip), kinetic, mu->at_rest * normal);
}

/* Draws (p1, p2) back to the circle. */
V8_INLINE void project(real radius, real *p1, real *p2)
{
    real square = *p1 * *p1 + *p2 * *p2, one = v8_part_set(1);
    mask outside = less(radius * radius, square);
    real share = choose(outside, radius / v8_part_sqrt(choose(outside, square, one)), one);
    *p1 = *p1 * share;
    *p2 = *p2 * share;
}

/* ---- solver_recall ---- */

V8_INLINE void recall_part(const batch_view *view, int32_t number)
{
    real zero = v8_part_set(0);
    const contact_batch *batch = &view->batch[number];
    lanes_frame f = frame_load(view, number);
    friction_lanes mu = friction_load(view, number);
    for (int32_t k = 0; k < batch->points; k++) {
        const double *p = point_rows(view, batch->first + k);
        double *impulse = impulse_rows(view, batch->first + k);
        real3 global = row3(impulse, 0);
        real p0 = v8_part_min(v8_part_max(dot(f.normal, global), zero), row(p, POINT_LIMIT));
        real p1 = dot(f.tangent[0], global), p2 = dot(f.tangent[1], global);
        project(radius_of(&mu, row(p, POINT_SLIP), p0), &p1, &p2);
        put(impulse, 0, p0);
        put(impulse, 1, p1);
        put(impulse, 2, p2);
    }
}

void KERNEL(solver_recall)(const batch_view *view, int32_t first, int32_t end)
{
    for (int32_t i = first; i < end; i++) {
        for (int h = 0; h < PARTS; h++) {
            batch_view part = part_view(view, h);
            recall_part(&part, i);
        }
    }
}

/* ---- solver_work, solver_push, solver_residual ---- */

V8_INLINE real work_part(const batch_view *view, int32_t number, int part)
{
    const contact_batch *batch = &view->batch[number];
    lanes_body a = first_body(view, batch, part, false), b = second_body(view, batch, part, false);
    lanes_frame f = frame_load(view, number);
    real sum = v8_part_set(0);
    for (int32_t k = 0; k < batch->points; k++) {
        const double *p = point_rows(view, batch->first + k), *impulse = impulse_rows(view, batch->first + k);
        real3 u = velocity_at(&a, &b, row3(p, POINT_ARM_A), row3(p, POINT_ARM_B));
        real3 all = composed(&f, row(impulse, 0), row(impulse, 1), row(impulse, 2));
        sum = sum + (dot(all, u) - row(impulse, 0) * row(p, POINT_BIAS));
    }
    return sum;
}

void KERNEL(solver_work)(const batch_view *view, int32_t first, int32_t end, double *work)
{
    for (int32_t i = first; i < end; i++) {
        hub_spread(view, &view->batch[i]);
        for (int h = 0; h < PARTS; h++) {
            batch_view part = part_view(view, h);
            put(work + LANES * h, i, work_part(&part, i, h));
        }
    }
}

/* share: of the lanes of the first part. */
V8_INLINE void push_batch(const batch_view *view, int32_t number, const double *share, bool general)
{
    const contact_batch *batch = &view->batch[number];
    batch_motion after;
    hub_spread(view, batch);
    for (int h = 0; h < PARTS; h++) {
        batch_view part = part_view(view, h);
        lanes_frame f = frame_load(&part, number);
        lanes_body a = first_body(view, batch, h, general), b = second_body(view, batch, h, general);
        real of_all = share ? load(share + LANES * h) : v8_part_set(1);
        for (int32_t k = 0; k < batch->points; k++) {
            const double *p = point_rows(&part, batch->first + k), *impulse = impulse_rows(&part, batch->first + k);
            real3 all = scale(composed(&f, row(impulse, 0), row(impulse, 1), row(impulse, 2)), of_all);
            apply(&a, &b, row3(p, POINT_ARM_A), row3(p, POINT_ARM_B), all, general);
        }
        motion_keep(&after, h, &a, &b);
    }
    motion_store(view, batch, &after);
    hub_collect(view, batch);
}

void KERNEL(solver_push)(const batch_view *view, int32_t first, int32_t end, const double *share)
{
    for (int32_t i = first; i < end; i++) {
        const double *of_all = share ? share + (ptrdiff_t)BATCH_LANES * i : NULL;
        if (view->batch[i].general)
            push_batch(view, i, of_all, true);
        else
            push_batch(view, i, of_all, false);
    }
}

V8_INLINE real residual_part(const batch_view *view, int32_t number, int part)
{
    const contact_batch *batch = &view->batch[number];
    real largest = v8_part_set(0), zero = v8_part_set(0);
    lanes_body a = first_body(view, batch, part, false), b = second_body(view, batch, part, false);
    real3 normal = row3(view->frame + (ptrdiff_t)FRAME_ROWS * BATCH_LANES * number, FRAME_NORMAL);
    for (int32_t k = 0; k < batch->points; k++) {
        const double *p = point_rows(view, batch->first + k);
        real carried = row(impulse_rows(view, batch->first + k), 0), limit = row(p, POINT_LIMIT);
        real u = dot(normal, velocity_at(&a, &b, row3(p, POINT_ARM_A), row3(p, POINT_ARM_B))) - row(p, POINT_BIAS);
        real residual = magnitude(u);
        residual = choose(less_equal(carried, zero), v8_part_max(-u, zero), residual);
        mask full = less_equal(limit, carried), usable = less(zero, limit);
        residual = choose(full, choose(usable, v8_part_max(u, zero), zero), residual);
        largest = v8_part_max(residual, largest);
    }
    return largest;
}

double KERNEL(solver_residual)(const batch_view *view, int32_t first, int32_t end)
{
    real largest = v8_part_set(0);
    for (int32_t i = first; i < end; i++) {
        hub_spread(view, &view->batch[i]);
        for (int h = 0; h < PARTS; h++) {
            batch_view part = part_view(view, h);
            largest = v8_part_max(residual_part(&part, i, h), largest);
        }
    }
    double most = 0;
    for (int i = 0; i < LANES; i++)
        most = largest[i] > most ? largest[i] : most;
    return most;
}

/* ---- solver_sweep, solver_correct ---- */

/* Sticking impulse by the exact 2 x 2 block; where that leaves the cone, a projected step (see solver_contacts.c).  u1,
   u2: velocities along the tangents. */
V8_INLINE void solve_friction(const double *p, real radius, real u1, real u2, real *p1, real *p2)
{
    real s11 = row(p, POINT_STICK), s12 = row(p, POINT_STICK + 1), s22 = row(p, POINT_STICK + 2);
    real stick1 = *p1 - (s11 * u1 + s12 * u2), stick2 = *p2 - (s12 * u1 + s22 * u2);
    mask outside = less(radius * radius, stick1 * stick1 + stick2 * stick2);
    if (any(outside)) {
        real slide = row(p, POINT_SLIDE), slide1 = *p1 - slide * u1, slide2 = *p2 - slide * u2;
        project(radius, &slide1, &slide2);
        stick1 = choose(outside, slide1, stick1);
        stick2 = choose(outside, slide2, stick2);
    }
    *p1 = stick1;
    *p2 = stick2;
}

/* Lane by lane. */
typedef struct lanes_sums {
    real energy[PARTS], wanted[PARTS];
} lanes_sums;

V8_INLINE void sums_clear(lanes_sums *sums)
{
    for (int h = 0; h < PARTS; h++)
        sums->energy[h] = sums->wanted[h] = v8_part_set(0);
}

/* Bodies with the part of their velocities that no impulse changes. */
V8_INLINE lanes_body driven_load(const batch_view *view, const int32_t *rows)
{
    lanes_body body;
    real c[BODY_ROW];
    v8_part_gather_rows(view->driven, rows, c);
    body.velocity = (real3){c[BODY_VELOCITY], c[BODY_VELOCITY + 1], c[BODY_VELOCITY + 2]};
    body.spin = (real3){c[BODY_SPIN], c[BODY_SPIN + 1], c[BODY_SPIN + 2]};
    return body;
}

/* What the impulses of a batch do at velocities that no impulse changes. */
static void take_driven_work(const batch_view *view, int32_t number, real sum[PARTS])
{
    const contact_batch *batch = &view->batch[number];
    for (int h = 0; h < PARTS; h++) {
        batch_view part = part_view(view, h);
        lanes_body a = driven_load(view, batch->a + LANES * h), b = driven_load(view, batch->b + LANES * h);
        lanes_frame f = frame_load(&part, number);
        real work = v8_part_set(0);
        for (int32_t point = batch->first; point < batch->first + batch->points; point++) {
            const double *p = point_rows(&part, point), *impulse = impulse_rows(&part, point);
            real3 u = velocity_at(&a, &b, row3(p, POINT_ARM_A), row3(p, POINT_ARM_B));
            work = work + dot(u, composed(&f, row(impulse, 0), row(impulse, 1), row(impulse, 2)));
        }
        sum[h] = sum[h] - work;
    }
}

double KERNEL(solver_wanted)(const batch_view *view, int32_t first, int32_t end)
{
    lanes_sums sums;
    sums_clear(&sums);
    for (int32_t i = first; i < end; i++) {
        const contact_batch *batch = &view->batch[i];
        for (int h = 0; h < PARTS; h++) {
            batch_view part = part_view(view, h);
            for (int32_t point = batch->first; point < batch->first + batch->points; point++)
                sums.wanted[h] =
                    sums.wanted[h] + row(impulse_rows(&part, point), 0) * row(point_rows(&part, point), POINT_BIAS);
        }
        if (batch->driven)
            take_driven_work(view, i, sums.wanted);
    }
    return parts_sum(sums.wanted);
}

V8_INLINE void sweep_part(const batch_view *view, int32_t number, bool general, batch_motion *after, int part,
                          lanes_sums *sums)
{
    const contact_batch *batch = &view->batch[number];
    lanes_body a = first_body(view, batch, part, general), b = second_body(view, batch, part, general);
    lanes_frame f = frame_load(view, number);
    friction_lanes mu = friction_load(view, number);
    real zero = v8_part_set(0), energy = sums->energy[part], wanted = sums->wanted[part];
    for (int32_t k = 0; k < batch->points; k++) {
        const double *p = point_rows(view, batch->first + k);
        double *impulse = impulse_rows(view, batch->first + k);
        real3 arm_a = row3(p, POINT_ARM_A), arm_b = row3(p, POINT_ARM_B);
        real3 u = velocity_at(&a, &b, arm_a, arm_b);
        real old0 = row(impulse, 0), old1 = row(impulse, 1), old2 = row(impulse, 2), mass = row(p, POINT_MASS);
        real bias = row(p, POINT_BIAS), u0 = dot(f.normal, u) - bias, limit = row(p, POINT_LIMIT);
        real p0 = v8_part_min(v8_part_max(old0 - u0 * mass, zero), limit), change0 = p0 - old0;
        real u1 = dot(f.tangent[0], u) + row(p, POINT_COUPLING) * change0;
        real u2 = dot(f.tangent[1], u) + row(p, POINT_COUPLING + 1) * change0;
        real p1 = old1, p2 = old2;
        solve_friction(p, radius_of(&mu, row(p, POINT_SLIP), p0), u1, u2, &p1, &p2);
        real change1 = p1 - old1, change2 = p2 - old2;
        apply(&a, &b, arm_a, arm_b, composed(&f, change0, change1, change2), general);
        put(impulse, 0, p0);
        put(impulse, 1, p1);
        put(impulse, 2, p2);
        /* What is only drawn back asks for nothing: a normal impulse from beyond its cap while the bodies approach, and
           friction that follows the normal impulse against the sliding. */
        real taken = -(change0 * u0);
        taken = choose(less(limit, old0), v8_part_max(taken, zero), taken);
        energy = energy + taken + v8_part_max(-(change1 * u1 + change2 * u2), zero);
        wanted = wanted + p0 * bias;
    }
    motion_keep(after, part, &a, &b);
    sums->energy[part] = energy;
    sums->wanted[part] = wanted;
}

V8_INLINE void sweep_batch(const batch_view *view, int32_t number, bool general, lanes_sums *sums)
{
    const contact_batch *batch = &view->batch[number];
    batch_motion after;
    hub_spread(view, batch);
    for (int h = 0; h < PARTS; h++) {
        batch_view part = part_view(view, h);
        sweep_part(&part, number, general, &after, h, sums);
    }
    motion_store(view, batch, &after);
    hub_collect(view, batch);
}

sweep_sums KERNEL(solver_sweep)(const batch_view *view, int32_t first, int32_t end, bool weigh)
{
    lanes_sums sums;
    sums_clear(&sums);
    for (int32_t i = first; i < end; i++) {
        if (view->batch[i].general)
            sweep_batch(view, i, true, &sums);
        else
            sweep_batch(view, i, false, &sums);
        if (weigh && view->batch[i].driven)
            take_driven_work(view, i, sums.wanted);
    }
    return (sweep_sums){parts_sum(sums.energy), weigh ? parts_sum(sums.wanted) : 0};
}

V8_INLINE void correct_part(const batch_view *view, int32_t number, const double *bias, double *impulse, bool general,
                            batch_motion *after, int part, lanes_sums *sums)
{
    const contact_batch *batch = &view->batch[number];
    lanes_body a = first_body(view, batch, part, general), b = second_body(view, batch, part, general);
    real3 normal = row3(view->frame + (ptrdiff_t)FRAME_ROWS * BATCH_LANES * number, FRAME_NORMAL);
    real zero = v8_part_set(0);
    for (int32_t k = 0; k < batch->points; k++) {
        const double *p = point_rows(view, batch->first + k);
        real3 arm_a = row3(p, POINT_ARM_A), arm_b = row3(p, POINT_ARM_B);
        real old = row(impulse, batch->first + k), mass = row(p, POINT_MASS);
        real want = row(bias, batch->first + k), u = dot(normal, velocity_at(&a, &b, arm_a, arm_b)) - want;
        real carried = v8_part_max(old - u * mass, zero), change = carried - old;
        apply(&a, &b, arm_a, arm_b, scale(normal, change), general);
        put(impulse, batch->first + k, carried);
        sums->energy[part] = sums->energy[part] - change * u;
        sums->wanted[part] = sums->wanted[part] + carried * want;
    }
    motion_keep(after, part, &a, &b);
}

V8_INLINE void correct_batch(const batch_view *view, int32_t number, const double *bias, double *impulse, bool general,
                             lanes_sums *sums)
{
    const contact_batch *batch = &view->batch[number];
    batch_motion after;
    hub_spread(view, batch);
    for (int h = 0; h < PARTS; h++) {
        batch_view part = part_view(view, h);
        correct_part(&part, number, bias + LANES * h, impulse + LANES * h, general, &after, h, sums);
    }
    motion_store(view, batch, &after);
    hub_collect(view, batch);
}

/* Whether a sweep of the position correction would change nothing: no overlap, no impulse, no body that moves. */
V8_INLINE bool correct_passes(const batch_view *view, const contact_batch *batch, const double *impulse)
{
    if (batch->overlaps || batch->hub >= 0)
        return false;
    v8 zero = v8_set(0);
    v8_mask moves = v8_less(zero, zero);
    for (int32_t k = 0; k < batch->points; k++)
        moves = moves | v8_less(zero, v8_load(impulse + (ptrdiff_t)BATCH_LANES * (batch->first + k)));
    for (int i = 0; i < BATCH_LANES; i++) {
        const double *a = view->velocity + (ptrdiff_t)BODY_ROW * batch->a[i];
        const double *b = view->velocity + (ptrdiff_t)BODY_ROW * batch->b[i];
        moves = moves | ~v8_less_equal(v8_abs(v8_load(a)), zero);
        moves = moves | ~v8_less_equal(v8_abs(v8_load(b)), zero);
    }
    return !v8_any(moves);
}

sweep_sums KERNEL(solver_correct)(const batch_view *view, int32_t first, int32_t end, const double *bias,
                                  double *impulse)
{
    lanes_sums sums;
    sums_clear(&sums);
    for (int32_t i = first; i < end; i++) {
        if (correct_passes(view, &view->batch[i], impulse))
            continue;
        if (view->batch[i].general)
            correct_batch(view, i, bias, impulse, true, &sums);
        else
            correct_batch(view, i, bias, impulse, false, &sums);
    }
    return (sweep_sums){parts_sum(sums.energy), parts_sum(sums.wanted)};
}

/* ---- solver_slide ---- */

/* On the cone but for rounding. */
#define ON_CONE (1 - 1e-9)

V8_INLINE mask capped_of(const batch_view *view, int32_t point)
{
    real limit = row(point_rows(view, point), POINT_LIMIT);
    return less_equal(limit, row(impulse_rows(view, point), 0)) & less(v8_part_set(0), limit);
}

V8_INLINE mask slides_of(const batch_view *view, const friction_lanes *mu, int32_t point)
{
    const double *impulse = impulse_rows(view, point);
    real radius = radius_of(mu, row(point_rows(view, point), POINT_SLIP), row(impulse, 0));
    real p1 = row(impulse, 1), p2 = row(impulse, 2);
    return less(ON_CONE * radius * radius, p1 * p1 + p2 * p2);
}

/* Sums of the lanes of one part. */
typedef struct slide_sums {
    real along[SEARCH_DIRECTIONS][PARTS];
} slide_sums;

V8_INLINE void slide_part(const batch_view *view, int32_t number, int part, const friction_lanes *mu,
                          const double *start, double *const *direction, int32_t directions, slide_sums *sums)
{
    const contact_batch *batch = &view->batch[number];
    lanes_body a = first_body(view, batch, part, false), b = second_body(view, batch, part, false);
    lanes_frame f = frame_load(view, number);
    real zero = v8_part_set(0);
    for (int32_t point = batch->first; point < batch->first + batch->points; point++) {
        mask slides = slides_of(view, mu, point), capped = capped_of(view, point);
        const double *p = point_rows(view, point), *impulse = impulse_rows(view, point);
        const ptrdiff_t at = (ptrdiff_t)IMPULSE_ROWS * BATCH_LANES * point + LANES * part;
        real3 u = velocity_at(&a, &b, row3(p, POINT_ARM_A), row3(p, POINT_ARM_B));
        real u0 = choose(capped, v8_part_min(dot(f.normal, u) - row(p, POINT_BIAS), zero), zero);
        real u1 = choose(slides, dot(f.tangent[0], u), zero), u2 = choose(slides, dot(f.tangent[1], u), zero);
        real step0 = row(impulse, 0) - row(start + at, 0);
        real step1 = row(impulse, 1) - row(start + at, 1), step2 = row(impulse, 2) - row(start + at, 2);
        sums->along[0][part] = sums->along[0][part] + (u0 * step0 + (u1 * step1 + u2 * step2));
        for (int32_t w = 1; w < directions; w++)
            sums->along[w][part] =
                sums->along[w][part] +
                (u0 * row(direction[w] + at, 0) + (u1 * row(direction[w] + at, 1) + u2 * row(direction[w] + at, 2)));
    }
}

void KERNEL(solver_slide)(const batch_view *view, int32_t first, int32_t end, const double *start,
                          double *const *direction, int32_t directions, double sum[SEARCH_DIRECTIONS])
{
    slide_sums sums;
    for (int w = 0; w < SEARCH_DIRECTIONS; w++)
        for (int h = 0; h < PARTS; h++)
            sums.along[w][h] = v8_part_set(0);
    for (int32_t i = first; i < end; i++) {
        const contact_batch *batch = &view->batch[i];
        bool spread = false;
        for (int h = 0; h < PARTS; h++) {
            batch_view part = part_view(view, h);
            friction_lanes mu = friction_load(&part, i);
            mask some = less(v8_part_set(0), v8_part_set(0));
            for (int32_t k = 0; k < batch->points; k++)
                some = some | slides_of(&part, &mu, batch->first + k) | capped_of(&part, batch->first + k);
            if (!any(some))
                continue; /* it would add zeros */
            if (!spread)
                hub_spread(view, batch);
            spread = true;
            slide_part(&part, i, h, &mu, start, direction, directions, &sums);
        }
    }
    for (int w = 0; w < SEARCH_DIRECTIONS; w++)
        sum[w] = parts_sum(sums.along[w]);
}
