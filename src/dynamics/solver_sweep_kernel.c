/* See solver_sweep_kernel.h.  A point's impulse changes the velocity at the point by K, a symmetric 3 x 3 matrix; along
   normal and tangents its parts are the normal's mass, the coupling of normal and tangents, and the tangent block.  The
   normal is solved first and the tangents with what it leaves of their velocity, so that one application to the bodies
   serves all three. */
#include "dynamics/solver_sweep_kernel.h"

#include "base/lanes.h"

/* A body in each lane. */
typedef struct lanes_body {
    lanes3 velocity, spin;
    v8 inertia[6]; /* inverse, xx yy zz xy xz yz */
    v8 mass[6];    /* inverse; only [0] unless it depends on the direction */
    v8 give;       /* of guided bodies, where the mass depends on the direction */
} lanes_body;

typedef struct lanes_frame {
    lanes3 normal, tangent[2];
} lanes_frame;

/* ---- rows in and out ---- */

V8_INLINE v8 row(const double *rows, int i) { return v8_load(rows + (ptrdiff_t)BATCH_LANES * i); }
V8_INLINE lanes3 row3(const double *rows, int i) { return (lanes3){row(rows, i), row(rows, i + 1), row(rows, i + 2)}; }
V8_INLINE void put(double *rows, int i, v8 x) { v8_store(rows + (ptrdiff_t)BATCH_LANES * i, x); }

V8_INLINE lanes_body body_load(const batch_view *view, const int32_t *rows, bool general)
{
    lanes_body body;
    v8 c[BODY_ROW];
    v8_gather_rows(view->velocity, rows, c);
    body.velocity = (lanes3){c[BODY_VELOCITY], c[BODY_VELOCITY + 1], c[BODY_VELOCITY + 2]};
    body.spin = (lanes3){c[BODY_SPIN], c[BODY_SPIN + 1], c[BODY_SPIN + 2]};
    v8_gather_rows(view->inverse, rows, c);
    for (int i = 0; i < 6; i++)
        body.inertia[i] = c[INVERSE_INERTIA + i];
    body.mass[0] = c[INVERSE_MASS];
    if (general) {
        v8_gather_rows(view->tensor, rows, c);
        for (int i = 0; i < 6; i++)
            body.mass[i] = c[i];
        body.give = c[TENSOR_GIVE];
    }
    return body;
}

V8_INLINE void body_store(const batch_view *view, const int32_t *rows, const lanes_body *body)
{
    v8 zero = v8_set(0);
    v8 c[BODY_ROW] = {
        body->velocity.x, body->velocity.y, body->velocity.z, body->spin.x, body->spin.y, body->spin.z, zero, zero};
    v8_scatter_rows(view->velocity, rows, c);
}

/* Tangents as contact_tangents makes them, to the bit. */
V8_INLINE lanes_frame frame_load(const batch_view *view, int32_t number)
{
    const double *rows = view->frame + (ptrdiff_t)FRAME_ROWS * BATCH_LANES * number;
    lanes_frame f = {.normal = row3(rows, FRAME_NORMAL)};
    lanes3 n = f.normal;
    v8 one = v8_set(1), minus_zero = v8_set(-0.0);
    v8 sign = (v8)((v8_mask)one | ((v8_mask)n.z & (v8_mask)minus_zero));
    v8 a = -1 / (sign + n.z), b = n.x * n.y * a;
    f.tangent[0] = (lanes3){1 + sign * n.x * n.x * a, sign * b, -sign * n.x};
    f.tangent[1] = (lanes3){b, sign + n.y * n.y * a, -n.y};
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

V8_INLINE lanes3 velocity_at(const lanes_body *a, const lanes_body *b, lanes3 arm_a, lanes3 arm_b)
{
    return lanes3_sub(lanes3_add(a->velocity, lanes3_cross(a->spin, arm_a)),
                      lanes3_add(b->velocity, lanes3_cross(b->spin, arm_b)));
}

V8_INLINE lanes3 pushed(const lanes_body *body, lanes3 impulse, bool general)
{
    return general ? lanes_sym3_mul(body->mass, impulse) : lanes3_scale(impulse, body->mass[0]);
}

V8_INLINE void apply(lanes_body *a, lanes_body *b, lanes3 arm_a, lanes3 arm_b, lanes3 impulse, bool general)
{
    a->velocity = lanes3_add(a->velocity, pushed(a, impulse, general));
    a->spin = lanes3_add(a->spin, lanes_sym3_mul(a->inertia, lanes3_cross(arm_a, impulse)));
    b->velocity = lanes3_sub(b->velocity, pushed(b, impulse, general));
    b->spin = lanes3_sub(b->spin, lanes_sym3_mul(b->inertia, lanes3_cross(arm_b, impulse)));
}

/* K times a direction. */
V8_INLINE lanes3 response(const lanes_body *a, const lanes_body *b, lanes3 arm_a, lanes3 arm_b, lanes3 d, bool general)
{
    lanes3 angular_a = lanes_sym3_mul(a->inertia, lanes3_cross(arm_a, d)),
           angular_b = lanes_sym3_mul(b->inertia, lanes3_cross(arm_b, d));
    return lanes3_add(lanes3_add(pushed(a, d, general), lanes3_cross(angular_a, arm_a)),
                      lanes3_add(pushed(b, d, general), lanes3_cross(angular_b, arm_b)));
}

V8_INLINE lanes3 composed(const lanes_frame *f, v8 p0, v8 p1, v8 p2)
{
    return lanes3_add(lanes3_add(lanes3_scale(f->normal, p0), lanes3_scale(f->tangent[0], p1)),
                      lanes3_scale(f->tangent[1], p2));
}

/* 1 / x where x > 0, else 0: lanes without a contact. */
V8_INLINE v8 inverse_or_zero(v8 x)
{
    v8 zero = v8_set(0), one = v8_set(1);
    v8_mask positive = v8_less(zero, x);
    return v8_select(positive, 1 / v8_select(positive, x, one), zero);
}

/* ---- solver_prepare ---- */

V8_INLINE void prepare_batch(const batch_view *view, int32_t number, bool general)
{
    const contact_batch *batch = &view->batch[number];
    hub_spread(view, batch);
    lanes_body a = body_load(view, batch->a, general), b = body_load(view, batch->b, general);
    lanes_frame f = frame_load(view, number);
    for (int32_t k = 0; k < batch->points; k++) {
        double *p = point_rows(view, batch->first + k);
        lanes3 arm_a = row3(p, POINT_ARM_A), arm_b = row3(p, POINT_ARM_B);
        lanes3 n = response(&a, &b, arm_a, arm_b, f.normal, general);
        lanes3 t1 = response(&a, &b, arm_a, arm_b, f.tangent[0], general);
        lanes3 t2 = response(&a, &b, arm_a, arm_b, f.tangent[1], general);
        v8 k00 = lanes3_dot(f.normal, n), k11 = lanes3_dot(f.tangent[0], t1), k12 = lanes3_dot(f.tangent[1], t1);
        v8 k22 = lanes3_dot(f.tangent[1], t2);
        if (general) {
            v8 give = a.give + b.give;
            k00 = k00 + give;
            k11 = k11 + give;
            k22 = k22 + give;
        }
        v8 share = inverse_or_zero(k11 * k22 - k12 * k12), slide = 2 * inverse_or_zero(k11 + k22);
        lanes3 u = velocity_at(&a, &b, arm_a, arm_b);
        v8 u1 = lanes3_dot(f.tangent[0], u), u2 = lanes3_dot(f.tangent[1], u);
        put(p, POINT_MASS, inverse_or_zero(k00));
        put(p, POINT_COUPLING, lanes3_dot(f.tangent[0], n));
        put(p, POINT_COUPLING + 1, lanes3_dot(f.tangent[1], n));
        put(p, POINT_STICK, k22 * share);
        put(p, POINT_STICK + 1, -k12 * share);
        put(p, POINT_STICK + 2, k11 * share);
        put(p, POINT_SLIDE, slide);
        put(p, POINT_SLIP, v8_sqrt(u1 * u1 + u2 * u2) * slide);
    }
}

void KERNEL(solver_prepare)(const batch_view *view, int32_t first, int32_t end)
{
    for (int32_t i = first; i < end; i++) {
        if (view->batch[i].general)
            prepare_batch(view, i, true);
        else
            prepare_batch(view, i, false);
    }
}

/* ---- friction ---- */

typedef struct friction_lanes {
    v8 at_rest, sliding;
} friction_lanes;

V8_INLINE friction_lanes friction_load(const batch_view *view, int32_t number)
{
    const double *rows = view->frame + (ptrdiff_t)FRAME_ROWS * BATCH_LANES * number;
    return (friction_lanes){row(rows, FRAME_STATIC), row(rows, FRAME_KINETIC)};
}

/* As friction_radius of solver_contacts.c. */
V8_INLINE v8 radius_of(const friction_lanes *mu, v8 slip, v8 normal)
{
    v8 kinetic = mu->sliding * normal;
    return v8_select(v8_less(kinetic, slip), kinetic, mu->at_rest * normal);
}

/* Draws (p1, p2) back to the circle. */
V8_INLINE void project(v8 radius, v8 *p1, v8 *p2)
{
    v8 square = *p1 * *p1 + *p2 * *p2, one = v8_set(1);
    v8_mask outside = v8_less(radius * radius, square);
    v8 share = v8_select(outside, radius / v8_sqrt(v8_select(outside, square, one)), one);
    *p1 = *p1 * share;
    *p2 = *p2 * share;
}

/* ---- solver_recall ---- */

void KERNEL(solver_recall)(const batch_view *view, int32_t first, int32_t end)
{
    v8 zero = v8_set(0);
    for (int32_t i = first; i < end; i++) {
        const contact_batch *batch = &view->batch[i];
        lanes_frame f = frame_load(view, i);
        friction_lanes mu = friction_load(view, i);
        for (int32_t k = 0; k < batch->points; k++) {
            const double *p = point_rows(view, batch->first + k);
            double *impulse = impulse_rows(view, batch->first + k);
            lanes3 global = row3(impulse, 0);
            v8 p0 = v8_min(v8_max(lanes3_dot(f.normal, global), zero), row(p, POINT_LIMIT));
            v8 p1 = lanes3_dot(f.tangent[0], global), p2 = lanes3_dot(f.tangent[1], global);
            project(radius_of(&mu, row(p, POINT_SLIP), p0), &p1, &p2);
            put(impulse, 0, p0);
            put(impulse, 1, p1);
            put(impulse, 2, p2);
        }
    }
}

/* ---- solver_work, solver_push, solver_residual ---- */

void KERNEL(solver_work)(const batch_view *view, int32_t first, int32_t end, double *work)
{
    for (int32_t i = first; i < end; i++) {
        const contact_batch *batch = &view->batch[i];
        hub_spread(view, batch);
        lanes_body a = body_load(view, batch->a, false), b = body_load(view, batch->b, false);
        lanes_frame f = frame_load(view, i);
        v8 sum = v8_set(0);
        for (int32_t k = 0; k < batch->points; k++) {
            const double *p = point_rows(view, batch->first + k), *impulse = impulse_rows(view, batch->first + k);
            lanes3 u = velocity_at(&a, &b, row3(p, POINT_ARM_A), row3(p, POINT_ARM_B));
            lanes3 all = composed(&f, row(impulse, 0), row(impulse, 1), row(impulse, 2));
            sum = sum + (lanes3_dot(all, u) - row(impulse, 0) * row(p, POINT_BIAS));
        }
        v8_store(work + (ptrdiff_t)BATCH_LANES * i, sum);
    }
}

V8_INLINE void push_batch(const batch_view *view, int32_t number, v8 share, bool general)
{
    const contact_batch *batch = &view->batch[number];
    hub_spread(view, batch);
    lanes_body a = body_load(view, batch->a, general), b = body_load(view, batch->b, general);
    lanes_frame f = frame_load(view, number);
    for (int32_t k = 0; k < batch->points; k++) {
        const double *p = point_rows(view, batch->first + k), *impulse = impulse_rows(view, batch->first + k);
        lanes3 all = lanes3_scale(composed(&f, row(impulse, 0), row(impulse, 1), row(impulse, 2)), share);
        apply(&a, &b, row3(p, POINT_ARM_A), row3(p, POINT_ARM_B), all, general);
    }
    body_store(view, batch->a, &a);
    body_store(view, batch->b, &b);
    hub_collect(view, batch);
}

void KERNEL(solver_push)(const batch_view *view, int32_t first, int32_t end, const double *share)
{
    for (int32_t i = first; i < end; i++) {
        v8 part = share ? v8_load(share + (ptrdiff_t)BATCH_LANES * i) : v8_set(1);
        if (view->batch[i].general)
            push_batch(view, i, part, true);
        else
            push_batch(view, i, part, false);
    }
}

double KERNEL(solver_residual)(const batch_view *view, int32_t first, int32_t end)
{
    v8 largest = v8_set(0), zero = v8_set(0);
    for (int32_t i = first; i < end; i++) {
        const contact_batch *batch = &view->batch[i];
        hub_spread(view, batch);
        lanes_body a = body_load(view, batch->a, false), b = body_load(view, batch->b, false);
        lanes3 normal = row3(view->frame + (ptrdiff_t)FRAME_ROWS * BATCH_LANES * i, FRAME_NORMAL);
        for (int32_t k = 0; k < batch->points; k++) {
            const double *p = point_rows(view, batch->first + k);
            v8 carried = row(impulse_rows(view, batch->first + k), 0), limit = row(p, POINT_LIMIT);
            v8 u = lanes3_dot(normal, velocity_at(&a, &b, row3(p, POINT_ARM_A), row3(p, POINT_ARM_B))) -
                   row(p, POINT_BIAS);
            v8 residual = v8_abs(u);
            residual = v8_select(v8_less_equal(carried, zero), v8_max(-u, zero), residual);
            v8_mask full = v8_less_equal(limit, carried), usable = v8_less(zero, limit);
            residual = v8_select(full, v8_select(usable, v8_max(u, zero), zero), residual);
            largest = v8_max(residual, largest);
        }
    }
    double most = 0;
    for (int i = 0; i < BATCH_LANES; i++)
        most = largest[i] > most ? largest[i] : most;
    return most;
}

/* ---- solver_sweep, solver_correct ---- */

/* Sticking impulse by the exact 2 x 2 block; where that leaves the cone, a projected step (see solver_contacts.c).  u1,
   u2: velocities along the tangents. */
V8_INLINE void solve_friction(const double *p, v8 radius, v8 u1, v8 u2, v8 *p1, v8 *p2)
{
    v8 s11 = row(p, POINT_STICK), s12 = row(p, POINT_STICK + 1), s22 = row(p, POINT_STICK + 2);
    v8 stick1 = *p1 - (s11 * u1 + s12 * u2), stick2 = *p2 - (s12 * u1 + s22 * u2);
    v8_mask outside = v8_less(radius * radius, stick1 * stick1 + stick2 * stick2);
    if (v8_any(outside)) {
        v8 slide = row(p, POINT_SLIDE), slide1 = *p1 - slide * u1, slide2 = *p2 - slide * u2;
        project(radius, &slide1, &slide2);
        stick1 = v8_select(outside, slide1, stick1);
        stick2 = v8_select(outside, slide2, stick2);
    }
    *p1 = stick1;
    *p2 = stick2;
}

/* Lane by lane. */
typedef struct lanes_sums {
    v8 energy, wanted;
} lanes_sums;

/* Bodies with the part of their velocities that no impulse changes. */
V8_INLINE lanes_body driven_load(const batch_view *view, const int32_t *rows)
{
    lanes_body body;
    v8 c[BODY_ROW];
    v8_gather_rows(view->driven, rows, c);
    body.velocity = (lanes3){c[BODY_VELOCITY], c[BODY_VELOCITY + 1], c[BODY_VELOCITY + 2]};
    body.spin = (lanes3){c[BODY_SPIN], c[BODY_SPIN + 1], c[BODY_SPIN + 2]};
    return body;
}

/* What the impulses of a batch do at velocities that no impulse changes. */
static v8 driven_work(const batch_view *view, int32_t number)
{
    const contact_batch *batch = &view->batch[number];
    lanes_body a = driven_load(view, batch->a), b = driven_load(view, batch->b);
    lanes_frame f = frame_load(view, number);
    v8 sum = v8_set(0);
    for (int32_t point = batch->first; point < batch->first + batch->points; point++) {
        const double *p = point_rows(view, point), *impulse = impulse_rows(view, point);
        lanes3 u = velocity_at(&a, &b, row3(p, POINT_ARM_A), row3(p, POINT_ARM_B));
        sum = sum + lanes3_dot(u, composed(&f, row(impulse, 0), row(impulse, 1), row(impulse, 2)));
    }
    return sum;
}

double KERNEL(solver_wanted)(const batch_view *view, int32_t first, int32_t end)
{
    v8 sum = v8_set(0);
    for (int32_t i = first; i < end; i++) {
        const contact_batch *batch = &view->batch[i];
        for (int32_t point = batch->first; point < batch->first + batch->points; point++)
            sum = sum + row(impulse_rows(view, point), 0) * row(point_rows(view, point), POINT_BIAS);
        if (batch->driven)
            sum = sum - driven_work(view, i);
    }
    return v8_sum(sum);
}

V8_INLINE void sweep_batch(const batch_view *view, int32_t number, bool general, lanes_sums *sums)
{
    const contact_batch *batch = &view->batch[number];
    hub_spread(view, batch);
    lanes_body a = body_load(view, batch->a, general), b = body_load(view, batch->b, general);
    lanes_frame f = frame_load(view, number);
    friction_lanes mu = friction_load(view, number);
    v8 zero = v8_set(0);
    for (int32_t k = 0; k < batch->points; k++) {
        const double *p = point_rows(view, batch->first + k);
        double *impulse = impulse_rows(view, batch->first + k);
        lanes3 arm_a = row3(p, POINT_ARM_A), arm_b = row3(p, POINT_ARM_B);
        lanes3 u = velocity_at(&a, &b, arm_a, arm_b);
        v8 old0 = row(impulse, 0), old1 = row(impulse, 1), old2 = row(impulse, 2), mass = row(p, POINT_MASS);
        v8 bias = row(p, POINT_BIAS), u0 = lanes3_dot(f.normal, u) - bias;
        v8 limit = row(p, POINT_LIMIT), p0 = v8_min(v8_max(old0 - u0 * mass, zero), limit), change0 = p0 - old0;
        v8 u1 = lanes3_dot(f.tangent[0], u) + row(p, POINT_COUPLING) * change0;
        v8 u2 = lanes3_dot(f.tangent[1], u) + row(p, POINT_COUPLING + 1) * change0;
        v8 p1 = old1, p2 = old2;
        solve_friction(p, radius_of(&mu, row(p, POINT_SLIP), p0), u1, u2, &p1, &p2);
        v8 change1 = p1 - old1, change2 = p2 - old2;
        apply(&a, &b, arm_a, arm_b, composed(&f, change0, change1, change2), general);
        put(impulse, 0, p0);
        put(impulse, 1, p1);
        put(impulse, 2, p2);
        /* What is only drawn back asks for nothing: a normal impulse from beyond its cap while the bodies approach, and
           friction that follows the normal impulse against the sliding. */
        v8 taken = -(change0 * u0);
        taken = v8_select(v8_less(limit, old0), v8_max(taken, zero), taken);
        sums->energy = sums->energy + taken + v8_max(-(change1 * u1 + change2 * u2), zero);
        sums->wanted = sums->wanted + p0 * bias;
    }
    body_store(view, batch->a, &a);
    body_store(view, batch->b, &b);
    hub_collect(view, batch);
}

sweep_sums KERNEL(solver_sweep)(const batch_view *view, int32_t first, int32_t end, bool weigh)
{
    lanes_sums sums = {v8_set(0), v8_set(0)};
    for (int32_t i = first; i < end; i++) {
        if (view->batch[i].general)
            sweep_batch(view, i, true, &sums);
        else
            sweep_batch(view, i, false, &sums);
        if (weigh && view->batch[i].driven)
            sums.wanted = sums.wanted - driven_work(view, i);
    }
    return (sweep_sums){v8_sum(sums.energy), weigh ? v8_sum(sums.wanted) : 0};
}

V8_INLINE void correct_batch(const batch_view *view, int32_t number, const double *bias, double *impulse, bool general,
                             lanes_sums *sums)
{
    const contact_batch *batch = &view->batch[number];
    hub_spread(view, batch);
    lanes_body a = body_load(view, batch->a, general), b = body_load(view, batch->b, general);
    lanes3 normal = row3(view->frame + (ptrdiff_t)FRAME_ROWS * BATCH_LANES * number, FRAME_NORMAL);
    v8 zero = v8_set(0);
    for (int32_t k = 0; k < batch->points; k++) {
        const double *p = point_rows(view, batch->first + k);
        lanes3 arm_a = row3(p, POINT_ARM_A), arm_b = row3(p, POINT_ARM_B);
        v8 old = row(impulse, batch->first + k), mass = row(p, POINT_MASS);
        v8 want = row(bias, batch->first + k), u = lanes3_dot(normal, velocity_at(&a, &b, arm_a, arm_b)) - want;
        v8 carried = v8_max(old - u * mass, zero), change = carried - old;
        apply(&a, &b, arm_a, arm_b, lanes3_scale(normal, change), general);
        put(impulse, batch->first + k, carried);
        sums->energy = sums->energy - change * u;
        sums->wanted = sums->wanted + carried * want;
    }
    body_store(view, batch->a, &a);
    body_store(view, batch->b, &b);
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
        moves = moves | v8_less(zero, row(impulse, batch->first + k));
    for (int i = 0; i < BATCH_LANES; i++) {
        moves = moves | ~v8_less_equal(v8_abs(row(view->velocity, batch->a[i])), zero);
        moves = moves | ~v8_less_equal(v8_abs(row(view->velocity, batch->b[i])), zero);
    }
    return !v8_any(moves);
}

sweep_sums KERNEL(solver_correct)(const batch_view *view, int32_t first, int32_t end, const double *bias,
                                  double *impulse)
{
    lanes_sums sums = {v8_set(0), v8_set(0)};
    for (int32_t i = first; i < end; i++) {
        if (correct_passes(view, &view->batch[i], impulse))
            continue;
        if (view->batch[i].general)
            correct_batch(view, i, bias, impulse, true, &sums);
        else
            correct_batch(view, i, bias, impulse, false, &sums);
    }
    return (sweep_sums){v8_sum(sums.energy), v8_sum(sums.wanted)};
}

/* ---- solver_slide ---- */

/* On the cone but for rounding. */
#define ON_CONE (1 - 1e-9)

V8_INLINE v8_mask capped_of(const batch_view *view, int32_t point)
{
    v8 limit = row(point_rows(view, point), POINT_LIMIT);
    return v8_less_equal(limit, row(impulse_rows(view, point), 0)) & v8_less(v8_set(0), limit);
}

V8_INLINE v8_mask slides_of(const batch_view *view, const friction_lanes *mu, int32_t point)
{
    const double *impulse = impulse_rows(view, point);
    v8 radius = radius_of(mu, row(point_rows(view, point), POINT_SLIP), row(impulse, 0));
    v8 p1 = row(impulse, 1), p2 = row(impulse, 2);
    return v8_less(ON_CONE * radius * radius, p1 * p1 + p2 * p2);
}

V8_INLINE void slide_batch(const batch_view *view, int32_t number, const friction_lanes *mu, const double *start,
                           double *const *direction, v8 sum[SEARCH_DIRECTIONS])
{
    const contact_batch *batch = &view->batch[number];
    hub_spread(view, batch);
    lanes_body a = body_load(view, batch->a, false), b = body_load(view, batch->b, false);
    lanes_frame f = frame_load(view, number);
    v8 zero = v8_set(0);
    for (int32_t point = batch->first; point < batch->first + batch->points; point++) {
        v8_mask slides = slides_of(view, mu, point), capped = capped_of(view, point);
        const double *p = point_rows(view, point), *impulse = impulse_rows(view, point);
        const ptrdiff_t at = (ptrdiff_t)IMPULSE_ROWS * BATCH_LANES * point;
        lanes3 u = velocity_at(&a, &b, row3(p, POINT_ARM_A), row3(p, POINT_ARM_B));
        v8 u0 = v8_select(capped, v8_min(lanes3_dot(f.normal, u) - row(p, POINT_BIAS), zero), zero);
        v8 u1 = v8_select(slides, lanes3_dot(f.tangent[0], u), zero),
           u2 = v8_select(slides, lanes3_dot(f.tangent[1], u), zero);
        v8 step0 = row(impulse, 0) - row(start + at, 0);
        v8 step1 = row(impulse, 1) - row(start + at, 1), step2 = row(impulse, 2) - row(start + at, 2);
        sum[0] = sum[0] + (u0 * step0 + (u1 * step1 + u2 * step2));
        for (int w = 1; w < SEARCH_DIRECTIONS; w++)
            sum[w] = sum[w] + (u0 * row(direction[w] + at, 0) +
                               (u1 * row(direction[w] + at, 1) + u2 * row(direction[w] + at, 2)));
    }
}

void KERNEL(solver_slide)(const batch_view *view, int32_t first, int32_t end, const double *start,
                          double *const *direction, double sum[SEARCH_DIRECTIONS])
{
    v8 zero = v8_set(0), lanes[SEARCH_DIRECTIONS] = {zero, zero, zero, zero};
    for (int32_t i = first; i < end; i++) {
        const contact_batch *batch = &view->batch[i];
        friction_lanes mu = friction_load(view, i);
        bool slides = false;
        for (int32_t k = 0; k < batch->points; k++)
            slides = slides || v8_any(slides_of(view, &mu, batch->first + k) | capped_of(view, batch->first + k));
        if (slides)
            slide_batch(view, i, &mu, start, direction, lanes);
    }
    for (int w = 0; w < SEARCH_DIRECTIONS; w++)
        sum[w] = v8_sum(lanes[w]);
}

/* ---- solver_products ---- */

/* Eight bodies' rows, one column per number. */
typedef struct lanes_rows {
    v8 column[BODY_ROW];
} lanes_rows;

V8_INLINE lanes_rows rows_load(const double *rows, int32_t first)
{
    lanes_rows r;
    for (int i = 0; i < BATCH_LANES; i++)
        r.column[i] = v8_load(rows + (ptrdiff_t)BODY_ROW * (first + i));
    v8_transpose(r.column);
    return r;
}

V8_INLINE lanes_rows rows_subtract(lanes_rows a, lanes_rows b)
{
    for (int i = 0; i < 6; i++)
        a.column[i] = a.column[i] - b.column[i];
    return a;
}

/* Momentum and spin momentum of velocities. */
V8_INLINE lanes_rows weighted(const lanes_rows *mass, const lanes_rows *inertia, const lanes_rows *v)
{
    lanes3 linear = lanes_sym3_mul(mass->column, (lanes3){v->column[0], v->column[1], v->column[2]});
    lanes3 angular = lanes_sym3_mul(inertia->column, (lanes3){v->column[3], v->column[4], v->column[5]});
    return (lanes_rows){{linear.x, linear.y, linear.z, angular.x, angular.y, angular.z}};
}

V8_INLINE v8 rows_dot(const lanes_rows *a, const lanes_rows *b)
{
    v8 sum = a->column[0] * b->column[0];
    for (int i = 1; i < 6; i++)
        sum = sum + a->column[i] * b->column[i];
    return sum;
}

direction_products KERNEL(solver_products)(const double *velocity, const double *start, double *const *direction,
                                           const double *mass, const double *inertia, int32_t first, int32_t end)
{
    v8 with_direction[SEARCH_DIRECTIONS], with_velocity[SEARCH_DIRECTIONS], square = v8_set(0);
    for (int w = 0; w < SEARCH_DIRECTIONS; w++)
        with_direction[w] = with_velocity[w] = square;
    for (int32_t i = first; i < end; i += V8_LANES) {
        lanes_rows m = rows_load(mass, i), j = rows_load(inertia, i), v = rows_load(velocity, i);
        lanes_rows now = rows_subtract(v, rows_load(start, i));
        lanes_rows momentum = weighted(&m, &j, &v), change = weighted(&m, &j, &now);
        square = square + rows_dot(&momentum, &v);
        with_direction[0] = with_direction[0] + rows_dot(&change, &now);
        with_velocity[0] = with_velocity[0] + rows_dot(&momentum, &now);
        for (int w = 1; w < SEARCH_DIRECTIONS; w++) {
            lanes_rows d = rows_load(direction[w], i);
            with_direction[w] = with_direction[w] + rows_dot(&change, &d);
            with_velocity[w] = with_velocity[w] + rows_dot(&momentum, &d);
        }
    }
    direction_products sums = {.square = v8_sum(square)};
    for (int w = 0; w < SEARCH_DIRECTIONS; w++) {
        sums.direction[w] = v8_sum(with_direction[w]);
        sums.velocity[w] = v8_sum(with_velocity[w]);
    }
    return sums;
}

/* ---- solver_combine ---- */

void KERNEL(solver_combine)(double *x, double *start, double *kept, double *const *direction,
                            const double share[SEARCH_DIRECTIONS], int64_t first, int64_t end)
{
    for (int64_t i = first; i < end; i += V8_LANES) {
        v8 old = v8_load(x + i), began = v8_load(start + i), next = old + share[0] * (old - began);
        for (int w = 1; w < SEARCH_DIRECTIONS; w++)
            next = next + share[w] * v8_load(direction[w] + i);
        v8_store(kept + i, old);
        v8_store(direction[SEARCH_DIRECTIONS - 1] + i, next - began);
        v8_store(start + i, next);
        v8_store(x + i, next);
    }
}
