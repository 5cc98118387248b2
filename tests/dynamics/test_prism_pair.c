/* The kernel of two prisms against the plain loops, and skipped pairs against pairs tested afresh. */
#include "base/random.h"
#include "base/transcendental.h"
#include "dynamics/prism_pair_kernel.h"
#include "rig.h"

enum { MOST = PIECE_MOST_VERTICES };

/* A convex outline of n vertices on an ellipse, and the prism of it in a random pose. */
typedef struct sample {
    vec2 vertex[MOST + 8], side[MOST + 8];
    int32_t corner[MOST];
    prism p;
} sample;

static void sample_draw(random_stream *draw, int n, double tilt, vec3 centre, sample *s)
{
    double turn = random_uniform(draw, 0, 6), a = random_uniform(draw, 1, 3), b = random_uniform(draw, 1, 3);
    for (int k = 0; k < n; k++) {
        double angle = turn + 2 * PI * (k + random_uniform(draw, 0, 0.5)) / n;
        s->vertex[k] = vec2_make(a * real_cos(angle), b * real_sin(angle));
        s->corner[k] = k;
    }
    for (int k = n; k < MOST + 8; k++)
        s->vertex[k] = s->side[k] = vec2_make(random_uniform(draw, -9, 9), NAN); /* never to be looked at */
    for (int k = 0; k < n; k++) {
        vec2 e = vec2_sub(s->vertex[k + 1 < n ? k + 1 : 0], s->vertex[k]);
        s->side[k] = vec2_scale(vec2_make(e.y, -e.x), 1 / vec2_length(e));
    }
    quat q = quat_from_roll_pitch_yaw(tilt * random_normal(draw), tilt * random_normal(draw), 9 * random_normal(draw));
    s->p = (prism){.vertex = s->vertex,
                   .side = s->side,
                   .plan_radius = 3.0001,
                   .corner = s->corner,
                   .outline = {s->vertex, n},
                   .count = n,
                   .readable = n + (int32_t)random_uniform(draw, 0, 8.999),
                   .half_height = random_uniform(draw, 0.3, 1),
                   .rotation = quat_matrix(q),
                   .centre = centre};
}

/* How far a lies beyond b along an axis. */
static double gap_along(const prism *a, const prism *b, vec3 axis)
{
    double low = HUGE_VAL, high = -HUGE_VAL;
    for (int32_t i = 0; i < 2 * a->count; i++) {
        vec3 v = {a->vertex[i / 2].x, a->vertex[i / 2].y, i % 2 ? a->half_height : -a->half_height};
        low = fmin(low, vec3_dot(axis, vec3_add(a->centre, mat3_mul_vec(a->rotation, v))));
    }
    for (int32_t i = 0; i < 2 * b->count; i++) {
        vec3 v = {b->vertex[i / 2].x, b->vertex[i / 2].y, i % 2 ? b->half_height : -b->half_height};
        high = fmax(high, vec3_dot(axis, vec3_add(b->centre, mat3_mul_vec(b->rotation, v))));
    }
    return low - high;
}

typedef struct touch {
    int count;
    vec3 normal, axis;
    manifold_point point[4];
} touch;

static touch by_kernel(context *ctx, const prism *a, const prism *b, nearness near, vec3 axis, polyhedron room[2])
{
    touch t = {0};
    prism_meeting m;
    KERNEL_PICK(ctx, prism_pair_test)(a, b, near.slack, &axis, &m);
    t.axis = m.axis;
    if (m.kind != PRISMS_APART)
        t.count = prism_meeting_points(a, b, &m, near, &room[0], &room[1], &t.normal, t.point, &t.axis);
    else
        assert_absolute(m.gap, gap_along(a, b, m.axis), 1e-12);
    return t;
}

START_TEST(kernel_equals_the_plain_loops)
{
    context ctx;
    context_init(&ctx);
    random_stream draw = random_begin(21, 0, 0);
    polyhedron room[2] = {0};
    ck_assert(prism_polyhedron_reserve(&ctx, &room[0]) && prism_polyhedron_reserve(&ctx, &room[1]));
    const nearness near = {0.004, 0.04};
    int touching = 0, apart = 0;
    for (int k = 0; k < 4000; k++) {
        sample a, b;
        double tilt = k % 4 == 3 ? 0.5 : 0.02;
        sample_draw(&draw, 3 + k % 14, tilt, vec3_make(0, 0, 0), &a);
        double far = random_uniform(&draw, 2, 5), angle = random_uniform(&draw, 0, 6);
        vec3 place = {far * real_cos(angle), far * real_sin(angle), random_uniform(&draw, -0.5, 0.5)};
        sample_draw(&draw, 3 + k % 13, tilt, place, &b);
        touch plain = {0};
        plain.count = prism_manifold(&a.p, &b.p, near, &room[0], &room[1], &plain.normal, plain.point, &plain.axis);
        ctx.isa = (isa)(k % ((int)isa_best() + 1));
        touch found = by_kernel(&ctx, &a.p, &b.p, near, vec3_make(0, 0, 0), room);
        ck_assert_int_eq(found.count, plain.count);
        if (plain.count > 0) {
            touching++;
            assert_vec3_close(found.normal, plain.normal, 0);
            for (int i = 0; i < plain.count; i++) {
                ck_assert_uint_eq(found.point[i].feature, plain.point[i].feature);
                assert_bits(found.point[i].depth, plain.point[i].depth);
                assert_vec3_close(found.point[i].point, plain.point[i].point, 0);
            }
        }
        if (vec3_dot(plain.axis, plain.axis) == 0)
            continue;
        apart++;
        /* The kernel's axis is the widest of those that the loops may return; it is found again when remembered. */
        ck_assert(gap_along(&a.p, &b.p, found.axis) >= gap_along(&a.p, &b.p, plain.axis) - 1e-12);
        touch again = by_kernel(&ctx, &a.p, &b.p, near, found.axis, room);
        ck_assert_int_eq(again.count, 0);
        assert_vec3_close(again.axis, found.axis, 0);
    }
    ck_assert(touching > 400 && apart > 400);
    polyhedron_free(&ctx, &room[0]);
    polyhedron_free(&ctx, &room[1]);
}
END_TEST

START_TEST(every_isa_gives_the_same_bits)
{
    context ctx;
    context_init(&ctx);
    random_stream draw = random_begin(22, 0, 0);
    for (int k = 0; k < 2000; k++) {
        sample a, b;
        sample_draw(&draw, 3 + k % 14, 0.1, vec3_make(0, 0, 0), &a);
        sample_draw(&draw, 3 + k % 11, 0.1, vec3_make(random_uniform(&draw, -4, 4), random_uniform(&draw, -4, 4), 0),
                    &b);
        vec3 axis = {k % 3 == 0, 0, 0};
        prism_meeting first, other;
        memset(&first, 0, sizeof first);
        ctx.isa = ISA_BASELINE;
        KERNEL_PICK(&ctx, prism_pair_test)(&a.p, &b.p, 0.01, &axis, &first);
        for (int i = ISA_BASELINE; i <= (int)isa_best(); i++) {
            ctx.isa = (isa)i;
            KERNEL_PICK(&ctx, prism_pair_test)(&a.p, &b.p, 0.01, &axis, &other);
            ck_assert_int_eq(other.kind, first.kind);
            ck_assert_int_eq(other.swapped, first.swapped);
            ck_assert_int_eq(other.side, first.side);
            ck_assert_int_eq(other.opposed, first.opposed);
            assert_bits(other.gap, first.gap);
            assert_bits(other.normal.x, first.normal.x);
            assert_bits(other.axis.y, first.axis.y);
        }
    }
}
END_TEST

/* Floes of several sizes and one bar, drifting and turning through one another without a solver. */
static void scatter(rig *r, random_stream *draw)
{
    for (int i = 0; i < 60; i++) {
        vec2 corner[8];
        int sides = 3 + i % 6;
        double radius = random_uniform(draw, 1, 4);
        for (int k = 0; k < sides; k++)
            corner[k] = vec2_make(radius * real_cos(2 * PI * k / sides), radius * real_sin(2 * PI * k / sides));
        vec3 place = {random_uniform(draw, -15, 15), random_uniform(draw, -15, 15), random_uniform(draw, -0.3, 0.3)};
        int32_t slot = rig_prism(r, MOTION_DYNAMIC, (polygon){corner, sides}, 1, 900, place);
        r->bodies.velocity[slot] =
            vec3_make(0.5 * random_normal(draw), 0.5 * random_normal(draw), 0.05 * random_normal(draw));
        r->bodies.angular_velocity[slot] =
            vec3_make(0.05 * random_normal(draw), 0.05 * random_normal(draw), 0.4 * random_normal(draw));
    }
    int32_t bar = rig_box(r, MOTION_PRESCRIBED, vec3_make(30, 2, 3), 900, vec3_make(0, 0, 0));
    r->bodies.angular_velocity[bar] = vec3_make(0, 0, 0.2);
}

static void assert_same_contacts(const contact_array *a, const contact_array *b, int step)
{
    ck_assert_msg(a->count == b->count, "step %d: %d contacts, %d when tested afresh", step, a->count, b->count);
    for (int32_t i = 0; i < a->count; i++) {
        ck_assert(a->data[i].key == b->data[i].key);
        assert_bits(a->data[i].depth, b->data[i].depth);
        assert_vec3_close(a->data[i].point, b->data[i].point, 0);
    }
}

START_TEST(skipped_pairs_have_no_contacts)
{
    rig r = rig_make(0.02), fresh = rig_make(0.02);
    random_stream draw = random_begin(23, 0, 0), same = random_begin(23, 0, 0);
    scatter(&r, &draw);
    scatter(&fresh, &same);
    r.collision.lookahead = 0.3;
    int skipped = 0, contacts = 0;
    for (int step = 0; step < 300; step++) {
        for (int32_t i = 0; i < fresh.pairs.count; i++)
            fresh.pairs.clear[i] = 0;
        rig_detect(&r);
        for (int32_t i = 0; i < r.pairs.count; i++)
            skipped += r.boxes.travel[r.pairs.a[i]] + r.boxes.travel[r.pairs.b[i]] < r.pairs.clear[i];
        rig_detect(&fresh);
        assert_same_contacts(&r.contacts, &fresh.contacts, step);
        contacts += r.contacts.count;
        integrate_poses(&r.ctx, &r.bodies, r.dt);
        integrate_poses(&fresh.ctx, &fresh.bodies, fresh.dt);
    }
    ck_assert(skipped > 10000 && contacts > 10000);
    rig_free(&r);
    rig_free(&fresh);
}
END_TEST

START_TEST(a_jump_is_seen_whatever_the_velocity)
{
    rig r = rig_make(0.02);
    rig_box(&r, MOTION_DYNAMIC, vec3_make(2, 2, 1), 900, vec3_make(0, 0, 0));
    rig_box(&r, MOTION_DYNAMIC, vec3_make(2, 2, 1), 900, vec3_make(2.3, 0, 0));
    rig_detect(&r);
    ck_assert_int_eq(r.contacts.count, 0);
    ck_assert_int_eq(r.pairs.count, 1);
    r.bodies.position[1].x = 1.95;
    rig_detect(&r);
    ck_assert_int_eq(r.contacts.count, 4);
    r.bodies.position[1].x = 2.3;
    rig_detect(&r);
    ck_assert_int_eq(r.contacts.count, 0);
    r.bodies.orientation[1] = quat_from_roll_pitch_yaw(0, 0, PI / 4); /* a corner reaches over */
    rig_detect(&r);
    ck_assert_int_ge(r.contacts.count, 1);
    rig_free(&r);
}
END_TEST

/* Two tilted floes that touch are listed for their patch, and from then on without a look at them until somebody finds
   no patch and says so; level ones keep the contacts of their sides whatever is remembered. */
START_TEST(a_patch_is_expected_where_one_was)
{
    rig r = rig_make(0.02);
    rig_box(&r, MOTION_DYNAMIC, vec3_make(2, 2, 1), 900, vec3_make(0, 0, 0));
    rig_box(&r, MOTION_DYNAMIC, vec3_make(2, 2, 1), 900, vec3_make(1.95, 0, 0));
    pair_policy *ice = &r.policies.of[MATERIAL_ICE][MATERIAL_ICE];
    ice->patch = ice->sides = true;
    r.bodies.orientation[0] = quat_from_roll_pitch_yaw(0, 0.5, 0);
    rig_detect(&r);
    ck_assert_int_eq(r.patch_pairs.count, 1);
    ck_assert_int_eq(r.contacts.count, 0);
    assert_bits(r.pairs.clear[0], PAIR_HAS_PATCH);
    r.bodies.position[1].x = 2.5; /* apart: nobody looked */
    rig_detect(&r);
    ck_assert_int_eq(r.patch_pairs.count, 1);
    r.pairs.clear[0] = 0;
    rig_detect(&r);
    ck_assert_int_eq(r.patch_pairs.count, 0);
    ck_assert(r.pairs.clear[0] > 0 && vec3_length(r.pairs.axis[0]) > 0.99);
    r.bodies.position[1].x = 1.95;
    r.bodies.orientation[0] = quat_from_roll_pitch_yaw(0, 0, 0);
    r.pairs.clear[0] = PAIR_HAS_PATCH;
    rig_detect(&r);
    ck_assert_int_eq(r.patch_pairs.count, 0);
    ck_assert_int_eq(r.contacts.count, 4);
    assert_bits(r.pairs.clear[0], 0);
    rig_free(&r);
}
END_TEST

TEST_MAIN("prism_pair", kernel_equals_the_plain_loops, every_isa_gives_the_same_bits, skipped_pairs_have_no_contacts,
          a_jump_is_seen_whatever_the_velocity, a_patch_is_expected_where_one_was)
