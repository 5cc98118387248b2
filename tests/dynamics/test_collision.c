/* Broad phase against all pairs, narrow phase against plan-view geometry and against itself in other frames. */
#include "base/hash.h"
#include "base/pool.h"
#include "base/random.h"
#include "base/transcendental.h"
#include "rig.h"
#include "sizes.h"

static int32_t regular(rig *r, motion kind, int sides, double radius, double turn, vec3 position)
{
    vec2 corner[12];
    for (int k = 0; k < sides; k++) {
        double angle = turn + 2 * PI * k / sides;
        corner[k] = vec2_make(radius * real_cos(angle), radius * real_sin(angle));
    }
    return rig_prism(r, kind, (polygon){corner, sides}, 1, 900, position);
}

/* ---- broad phase ---- */

static bool is_fixed(const rig *r, int32_t slot)
{
    return r->bodies.motion[slot] == MOTION_STATIC || r->bodies.motion[slot] == MOTION_ASLEEP;
}

static bool boxes_meet(const rig *r, int32_t a, int32_t b)
{
    box3 x = {r->boxes.lo[a], r->boxes.hi[a]}, y = {r->boxes.lo[b], r->boxes.hi[b]};
    bool fixed = is_fixed(r, a) && is_fixed(r, b);
    return body_is_alive(&r->bodies, a) && body_is_alive(&r->bodies, b) && !fixed && box3_meet(x, y);
}

static void assert_all_pairs(const rig *r)
{
    int32_t at = 0;
    for (int32_t a = 0; a < r->bodies.count; a++) {
        for (int32_t b = a + 1; b < r->bodies.count; b++) {
            if (!boxes_meet(r, a, b))
                continue;
            ck_assert_msg(at < r->pairs.count && r->pairs.a[at] == a && r->pairs.b[at] == b, "pair %d, %d is missing",
                          a, b);
            at++;
        }
    }
    ck_assert_int_eq(at, r->pairs.count);
}

START_TEST(broad_phase_finds_all_pairs)
{
    rig r = rig_make(0.1);
    r.gravity = vec3_make(0, 0, 0);
    random_stream draw = random_begin(7, 0, 0);
    rig_box(&r, MOTION_STATIC, vec3_make(1000, 5, 4), 1, vec3_make(0, -60, 0));
    rig_box(&r, MOTION_STATIC, vec3_make(5, 1000, 4), 1, vec3_make(-60, 0, 0));
    rig_box(&r, MOTION_PRESCRIBED, vec3_make(200, 30, 10), 1, vec3_make(0, 0, 0));
    for (int i = 0; i < 250; i++) {
        double size = random_power_law(&draw, 0.5, 40, 1.5);
        vec3 p = {random_uniform(&draw, -60, 60), random_uniform(&draw, -60, 60), 0};
        int32_t slot = regular(&r, MOTION_DYNAMIC, 3 + i % 6, size, 0.1 * i, p);
        r.bodies.velocity[slot] = vec3_make(random_normal(&draw), random_normal(&draw), 0.01 * random_normal(&draw));
        r.bodies.angular_velocity[slot].z = 0.3 * random_normal(&draw);
    }
    fram_error e = {0};
    for (int k = 0; k < 40; k++) {
        assert_ok(broad_phase_update(&r.ctx, &r.bodies, &r.shapes, &r.collision, &r.boxes, &r.pairs, r.scratch, &e), e);
        assert_all_pairs(&r);
        integrate_poses(&r.ctx, &r.bodies, r.dt);
        if (k % 7 == 3) { /* a death and a birth in its slot */
            body_remove(&r.bodies, 10 + k);
            shape_remove(&r.shapes, 10 + k);
            if (k % 2)
                regular(&r, MOTION_DYNAMIC, 5, 3, 0, vec3_make(k, -k, 0));
        }
        if (k == 20)
            r.bodies.motion[1] = MOTION_DYNAMIC; /* a wall breaks loose */
    }
    rig_free(&r);
}
END_TEST

static void update_pairs(rig *r)
{
    fram_error e = {0};
    assert_ok(broad_phase_update(&r->ctx, &r->bodies, &r->shapes, &r->collision, &r->boxes, &r->pairs, r->scratch, &e),
              e);
    assert_all_pairs(r);
}

/* What the scratch remembers of a later time is no use for an earlier state, and does no harm: the box that body 1 has
   in the state, and keeps, is not where the scratch has seen it last, when body 0 comes near. */
START_TEST(a_state_of_another_time_finds_its_pairs)
{
    rig r = rig_make(0.1);
    const double margin = r.collision.margin;
    regular(&r, MOTION_DYNAMIC, 4, 1, 0, vec3_make(0, 0, 0));
    regular(&r, MOTION_DYNAMIC, 4, 1, 0, vec3_make(2 + 3 * margin, 0, 0));
    update_pairs(&r);
    ck_assert_int_eq(r.pairs.count, 0);
    broad_table boxes = {0};
    pair_table pairs = {0};
    ck_assert(table_copy(&r.ctx, &boxes, &r.boxes, &broad_table_info) &&
              table_copy(&r.ctx, &pairs, &r.pairs, &pair_table_info));
    r.bodies.position[1].y += 100;
    update_pairs(&r);
    r.bodies.position[1].y -= 100;
    ck_assert(table_copy(&r.ctx, &r.boxes, &boxes, &broad_table_info) &&
              table_copy(&r.ctx, &r.pairs, &pairs, &pair_table_info));
    r.bodies.position[0].x += 1.5 * margin;
    update_pairs(&r);
    ck_assert_int_eq(r.pairs.count, 1);
    table_free(&r.ctx, &boxes, &broad_table_info);
    table_free(&r.ctx, &pairs, &pair_table_info);
    rig_free(&r);
}
END_TEST

/* A crowd that drifts apart, through many renewals of some of its boxes. */
START_TEST(pairs_of_a_crowd_adrift_are_found)
{
    rig r = rig_make(0.1);
    r.gravity = vec3_make(0, 0, 0);
    random_stream draw = random_begin(8, 0, 0);
    for (int i = 0; i < 120; i++) {
        vec3 p = {random_uniform(&draw, -25, 25), random_uniform(&draw, -25, 25), 0};
        int32_t slot = regular(&r, MOTION_DYNAMIC, 3 + i % 6, 1, 0.1 * i, p);
        r.bodies.velocity[slot] = vec3_make(2 * random_normal(&draw), 2 * random_normal(&draw), 0);
    }
    for (int k = 0; k < 150; k++) {
        integrate_poses(&r.ctx, &r.bodies, r.dt);
        update_pairs(&r);
    }
    rig_free(&r);
}
END_TEST

/* Enough bodies for several blocks of each thread, of sizes from grid to grid; some renew their boxes among many that
   do not. */
START_TEST(pairs_of_many_are_found_on_any_threads)
{
    enum { MANY = 1300 };
    for (int threads = 1; threads <= 3; threads += 2) {
        rig r = rig_make(0.1);
        r.gravity = vec3_make(0, 0, 0);
        r.ctx.threads = threads > 1 ? pool_create(&r.ctx, threads) : NULL;
        random_stream draw = random_begin(9, 0, 0);
        for (int i = 0; i < MANY; i++) {
            double size = random_power_law(&draw, 0.5, 8, 1.5);
            vec3 p = {random_uniform(&draw, -60, 60), random_uniform(&draw, -60, 60), 0};
            int32_t slot = regular(&r, MOTION_DYNAMIC, 3 + i % 6, size, 0.1 * i, p);
            double speed = i % 4 == 0 ? 2 : 0.05;
            r.bodies.velocity[slot] = vec3_make(speed * random_normal(&draw), speed * random_normal(&draw), 0);
        }
        for (int k = 0; k < 30; k++) {
            integrate_poses(&r.ctx, &r.bodies, r.dt);
            update_pairs(&r);
        }
        pool_free(&r.ctx, r.ctx.threads);
        r.ctx.threads = NULL;
        rig_free(&r);
    }
}
END_TEST

/* Every living body is where its fat box says. */
static void assert_boxes_hold(const rig *r)
{
    for (int32_t i = 0; i < r->bodies.count; i++) {
        bool lives = body_is_alive(&r->bodies, i);
        ck_assert_uint_eq(r->boxes.generation[i], lives ? r->bodies.generation[i] : 0);
        vec3 p = r->bodies.position[i], reach = {0.4, 0.4, 0.4}; /* less than any of them is wide */
        box3 inside = {vec3_sub(p, reach), vec3_add(p, reach)}, box = {r->boxes.lo[i], r->boxes.hi[i]};
        ck_assert(!lives || (box.lo.x <= inside.lo.x && box.lo.y <= inside.lo.y && box.hi.x >= inside.hi.x &&
                             box.hi.y >= inside.hi.y));
    }
}

/* Some move among many that stand; of these some wake, fall asleep, are carried off or replaced meanwhile. */
START_TEST(pairs_with_a_crowd_that_stands_are_found)
{
    enum { ROWS = 24, SLOTS = ROWS * ROWS };
    rig r = rig_make(0.1);
    r.gravity = vec3_make(0, 0, 0);
    random_stream draw = random_begin(10, 0, 0);
    for (int i = 0; i < SLOTS; i++) {
        vec3 p = {2.2 * (i % ROWS), 2.2 * floor(1.0 * i / ROWS), 0};
        int32_t slot = regular(&r, i % 3 ? MOTION_ASLEEP : MOTION_STATIC, 3 + i % 6, 1.2, 0.1 * i, p);
        if (i % 149 == 7) {
            r.bodies.motion[slot] = MOTION_DYNAMIC;
            r.bodies.velocity[slot] = vec3_make(3 * random_normal(&draw), 3 * random_normal(&draw), 0);
        }
    }
    for (int k = 0; k < 120; k++) {
        int32_t slot = (int32_t)random_uniform(&draw, 0, SLOTS - 0.001);
        if (k % 6 == 1 && r.bodies.motion[slot] == MOTION_ASLEEP) {
            r.bodies.motion[slot] = MOTION_DYNAMIC;
            r.bodies.velocity[slot] = vec3_make(0, 1, 0);
        } else if (k % 6 == 3 && r.bodies.motion[slot] == MOTION_DYNAMIC) {
            r.bodies.motion[slot] = MOTION_ASLEEP;
            r.bodies.velocity[slot] = vec3_make(0, 0, 0);
        } else if (k % 6 == 5) {
            vec3 p = r.bodies.position[slot];
            body_remove(&r.bodies, slot);
            shape_remove(&r.shapes, slot);
            if (k % 4 == 3)
                regular(&r, MOTION_ASLEEP, 5, 1.5, 0, p);
        }
        update_pairs(&r);
        assert_boxes_hold(&r);
        integrate_poses(&r.ctx, &r.bodies, r.dt);
    }
    /* Sleepers that drift with their ice are followed. */
    for (int32_t i = 0; i < r.bodies.count; i++) {
        if (!body_is_alive(&r.bodies, i))
            ck_assert_int_eq(regular(&r, MOTION_ASLEEP, 4, 1, 0, vec3_make(0, -3, 0)), i);
        if (r.bodies.motion[i] == MOTION_DYNAMIC)
            r.bodies.motion[i] = MOTION_ASLEEP;
    }
    update_pairs(&r);
    for (int32_t i = 0; i < r.bodies.count; i++)
        r.bodies.velocity[i] = vec3_scale(vec3_make(1, 0.5, 0), r.bodies.motion[i] == MOTION_ASLEEP);
    for (int k = 0; k < 40; k++) {
        integrate_poses(&r.ctx, &r.bodies, r.dt);
        update_pairs(&r);
        assert_boxes_hold(&r);
    }
    rig_free(&r);
}
END_TEST

/* It stands where another one stood, in the same slot, and is larger. */
START_TEST(a_new_body_among_what_stands_has_its_own_box)
{
    rig r = rig_make(0.1);
    for (int i = 0; i < 80; i++)
        regular(&r, MOTION_ASLEEP, 4, 1, 0, vec3_make(6 * i, 0, 0));
    regular(&r, MOTION_DYNAMIC, 4, 1, 0, vec3_make(60, 3, 0));
    update_pairs(&r);
    update_pairs(&r);
    ck_assert_int_eq(r.pairs.count, 0);
    body_remove(&r.bodies, 10);
    shape_remove(&r.shapes, 10);
    ck_assert_int_eq(regular(&r, MOTION_ASLEEP, 4, 2.5, 0, vec3_make(60, 0, 0)), 10);
    update_pairs(&r);
    ck_assert_int_eq(r.pairs.count, 1);
    ck_assert_uint_eq(r.boxes.generation[10], r.bodies.generation[10]);
    rig_free(&r);
}
END_TEST

/* A state whose boxes are others than those of the scratch, though nothing has moved since: the scratch was told. */
START_TEST(another_state_of_what_stands_finds_its_pairs)
{
    rig r = rig_make(0.1);
    for (int i = 0; i < 80; i++)
        regular(&r, MOTION_ASLEEP, 4, 1, 0, vec3_make(3 * i, 0, 0));
    regular(&r, MOTION_DYNAMIC, 4, 1, 0, vec3_make(30, 20, 0));
    broad_table boxes = {0};
    pair_table pairs = {0};
    for (int32_t i = 0; i < 80; i++)
        r.bodies.position[i].y = 50;
    update_pairs(&r);
    ck_assert(table_copy(&r.ctx, &boxes, &r.boxes, &broad_table_info) &&
              table_copy(&r.ctx, &pairs, &r.pairs, &pair_table_info));
    for (int32_t i = 0; i < 80; i++)
        r.bodies.position[i].y = 0;
    update_pairs(&r);
    update_pairs(&r);
    ck_assert(table_copy(&r.ctx, &r.boxes, &boxes, &broad_table_info) &&
              table_copy(&r.ctx, &r.pairs, &pairs, &pair_table_info));
    for (int32_t i = 0; i < 80; i++)
        r.bodies.position[i].y = 50;
    collision_scratch_forget(r.scratch);
    r.bodies.position[80].y = 49;
    update_pairs(&r);
    ck_assert_int_gt(r.pairs.count, 0);
    table_free(&r.ctx, &boxes, &broad_table_info);
    table_free(&r.ctx, &pairs, &pair_table_info);
    rig_free(&r);
}
END_TEST

static uint64_t fat_boxes_hash(const rig *r)
{
    size_t size = (size_t)r->boxes.count * sizeof(vec3);
    return hash_bytes(r->boxes.hi, size, hash_bytes(r->boxes.lo, size, 0));
}

START_TEST(unmoved_boxes_are_kept)
{
    rig r = rig_make(0.1);
    for (int i = 0; i < 30; i++)
        regular(&r, MOTION_DYNAMIC, 6, 2, 0, vec3_make(3.5 * (i % 6), 3.5 * floor(i / 6.0), 0));
    rig_detect(&r);
    uint64_t boxes = fat_boxes_hash(&r);
    for (int32_t i = 0; i < r.bodies.count; i++)
        r.bodies.position[i].x += 0.2;
    rig_detect(&r);
    ck_assert(fat_boxes_hash(&r) == boxes);
    r.bodies.position[4].x += 0.2;
    rig_detect(&r);
    ck_assert(fat_boxes_hash(&r) != boxes);
    assert_all_pairs(&r);
    rig_free(&r);
}
END_TEST

/* Of more pairs than a block holds each keeps what was remembered of it while some others come and go. */
START_TEST(pairs_keep_their_axes)
{
    enum { SIDE = 40 };
    rig r = rig_make(0.1);
    random_stream draw = random_begin(3, 0, 0);
    for (int i = 0; i < SIDE * SIDE; i++)
        regular(&r, MOTION_DYNAMIC, 5, 3, 0.1 * i, vec3_make(5.5 * (i % SIDE), 5.5 * (i / SIDE), 0));
    update_pairs(&r);
    ck_assert_int_gt(r.pairs.count, 3 * 2048); /* several blocks */
    int32_t fresh = 0;
    for (int k = 0; k < 10; k++) {
        for (int32_t i = 0; i < r.pairs.count; i++) {
            r.pairs.axis[i] = vec3_make(r.pairs.a[i], r.pairs.b[i], 1);
            r.pairs.clear[i] = r.pairs.a[i];
        }
        int32_t moved = (int32_t)(random_unit(&draw) * SIDE * SIDE);
        r.bodies.position[moved].x += 9;
        update_pairs(&r);
        for (int32_t i = 0; i < r.pairs.count; i++) {
            bool kept = r.pairs.axis[i].z == 1;
            ck_assert(kept || r.pairs.a[i] == moved || r.pairs.b[i] == moved);
            fresh += !kept;
            if (kept) {
                assert_vec3_close(r.pairs.axis[i], vec3_make(r.pairs.a[i], r.pairs.b[i], 1), 0);
                ck_assert(r.pairs.clear[i] == r.pairs.a[i]);
            }
        }
    }
    ck_assert_int_gt(fresh, 10);
    rig_free(&r);
}
END_TEST

START_TEST(lost_bodies_are_named)
{
    rig r = rig_make(0.1);
    regular(&r, MOTION_DYNAMIC, 6, 2, 0, vec3_make(0, 0, 0));
    r.bodies.position[0].y = NAN;
    fram_error e = {0};
    assert_fails(broad_phase_update(&r.ctx, &r.bodies, &r.shapes, &r.collision, &r.boxes, &r.pairs, r.scratch, &e), e,
                 FRAM_ERROR_SIMULATION, "body 0");
    rig_free(&r);
}
END_TEST

/* ---- narrow phase ---- */

/* The outline of a body in the global plan view. */
static polygon plan_of(const rig *r, int32_t slot, vec2 *out)
{
    polygon p = shape_outline(&r->shapes, r->bodies.shape[slot]);
    for (int32_t i = 0; i < p.count; i++) {
        vec3 g = body_to_global(&r->bodies, slot, vec3_make(p.vertex[i].x, p.vertex[i].y, 0));
        out[i] = vec2_make(g.x, g.y);
    }
    return (polygon){out, p.count};
}

START_TEST(level_prisms_touch_as_their_outlines_do)
{
    random_stream draw = random_begin(3, 0, 0);
    int touching = 0, apart = 0;
    for (int k = 0; k < 400; k++) {
        rig r = rig_make(0.1);
        regular(&r, MOTION_DYNAMIC, 3 + k % 6, 2, random_uniform(&draw, 0, 6), vec3_make(100, -50, 0));
        double angle = random_uniform(&draw, 0, 6), far = random_uniform(&draw, 3, 4.1);
        vec3 p = {100 + far * real_cos(angle), -50 + far * real_sin(angle), random_uniform(&draw, -0.2, 0.2)};
        regular(&r, MOTION_DYNAMIC, 3 + k % 5, 2, random_uniform(&draw, 0, 6), p);
        rig_detect(&r);
        vec2 room[2][12], axis;
        double depth = polygon_convex_depth(plan_of(&r, 0, room[0]), plan_of(&r, 1, room[1]), &axis);
        if (depth > 0 && depth < 0.5) {
            touching++;
            ck_assert_msg(r.contacts.count >= 2, "pair %d: depth %g, %d contacts", k, depth, r.contacts.count);
            assert_absolute(rig_deepest(&r), depth,
                            0.06 * depth + 1e-12); /* either side, when both are nearly as near */
            vec3 n = r.contacts.data[0].normal;
            assert_absolute(n.z, 0, 1e-12);
            ck_assert(n.x * axis.x + n.y * axis.y < 0); /* from b to a */
        } else if (depth < -0.01) {
            apart++;
            ck_assert_msg(r.contacts.count == 0, "pair %d: gap %g, %d contacts", k, -depth, r.contacts.count);
            if (r.pairs.count == 1)
                assert_absolute(vec3_length(r.pairs.axis[0]), 1, 1e-12);
        }
        rig_free(&r);
    }
    ck_assert(touching > 50 && apart > 50);
}
END_TEST

/* Contacts of two prisms, the whole turned by q. */
static contact_array turned(rig *r, quat q, vec3 shift)
{
    *r = rig_make(0.1);
    int32_t a = regular(r, MOTION_DYNAMIC, 5, 2, 0.3, vec3_make(0, 0, 0));
    int32_t b = regular(r, MOTION_DYNAMIC, 6, 2, 0.1, vec3_make(3.55, 0.4, 0.1));
    r->bodies.orientation[a] = quat_mul(q, quat_from_roll_pitch_yaw(0.03, -0.02, 0));
    r->bodies.orientation[b] = q;
    mat3 m = quat_matrix(q);
    for (int32_t i = 0; i < 2; i++)
        r->bodies.position[i] = vec3_add(shift, mat3_mul_vec(m, r->bodies.position[i]));
    rig_detect(r);
    return r->contacts;
}

START_TEST(contacts_turn_with_the_bodies)
{
    rig r, s;
    contact_array first = turned(&r, quat_identity(), vec3_make(0, 0, 0));
    ck_assert_int_ge(first.count, 2);
    for (int k = 1; k < 6; k++) {
        quat q = quat_from_roll_pitch_yaw(0.5 * k, 0.2 * k, 0.7 * k);
        mat3 m = quat_matrix(q);
        vec3 shift = vec3_make(10 * k, -7 * k, k);
        contact_array other = turned(&s, q, shift);
        ck_assert_int_eq(other.count, first.count);
        for (int32_t i = 0; i < first.count; i++) {
            ck_assert(other.data[i].key == first.data[i].key);
            assert_absolute(other.data[i].depth, first.data[i].depth, 1e-12);
            assert_vec3_close(other.data[i].normal, mat3_mul_vec(m, first.data[i].normal), 1e-12);
            assert_vec3_close(other.data[i].point, vec3_add(shift, mat3_mul_vec(m, first.data[i].point)), 1e-11);
        }
        rig_free(&s);
    }
    rig_free(&r);
}
END_TEST

START_TEST(order_of_the_bodies_does_not_matter)
{
    /* b on a, a on b: the same points, opposite normals. */
    for (int k = 0; k < 2; k++) {
        rig r = rig_make(0.1);
        vec3 low = {0, 0, 0}, high = {0.5, 0.3, 0.99};
        regular(&r, MOTION_DYNAMIC, 6, k ? 1 : 3, 0, k ? high : low);
        regular(&r, MOTION_DYNAMIC, 6, k ? 3 : 1, 0, k ? low : high);
        rig_detect(&r);
        ck_assert_int_eq(r.contacts.count, 4);
        for (int32_t i = 0; i < 4; i++) {
            assert_absolute(r.contacts.data[i].depth, 0.01, 1e-12);
            assert_vec3_close(r.contacts.data[i].normal, vec3_make(0, 0, k ? 1 : -1), 1e-12);
            assert_absolute(r.contacts.data[i].point.z, 0.495, 1e-12);
        }
        rig_free(&r);
    }
}
END_TEST

START_TEST(crossed_edges_meet_in_a_point)
{
    /* Two bars standing on edge, crossed: their edges touch. */
    rig r = rig_make(0.1);
    int32_t a = rig_box(&r, MOTION_DYNAMIC, vec3_make(6, 1, 1), 900, vec3_make(0, 0, 0));
    int32_t b = rig_box(&r, MOTION_DYNAMIC, vec3_make(6, 1, 1), 900, vec3_make(0.7, 0.2, sqrt(2) - 0.02));
    r.bodies.orientation[a] = quat_from_roll_pitch_yaw(PI / 4, 0, 0);
    r.bodies.orientation[b] = quat_mul(quat_from_roll_pitch_yaw(0, 0, PI / 2), quat_from_roll_pitch_yaw(PI / 4, 0, 0));
    rig_detect(&r);
    ck_assert_int_eq(r.contacts.count, 1);
    assert_absolute(r.contacts.data[0].depth, 0.02, 1e-12);
    assert_vec3_close(r.contacts.data[0].normal, vec3_make(0, 0, -1), 1e-12);
    assert_vec3_close(r.contacts.data[0].point, vec3_make(0.7, 0, sqrt(2) / 2 - 0.01), 1e-12);
    rig_free(&r);
}
END_TEST

START_TEST(keys_are_unique_and_die_with_their_bodies)
{
    rig r = rig_make(0.1);
    regular(&r, MOTION_DYNAMIC, 6, 3, 0, vec3_make(0, 0, 0));
    regular(&r, MOTION_DYNAMIC, 6, 3, 0, vec3_make(0.4, 0.2, 0.99));
    rig_detect(&r);
    ck_assert_int_eq(r.contacts.count, 4);
    uint64_t key[4];
    for (int i = 0; i < 4; i++) {
        key[i] = r.contacts.data[i].key;
        for (int k = 0; k < i; k++)
            ck_assert(key[i] != key[k]);
    }
    r.bodies.position[1].x += 0.01;
    rig_detect(&r);
    for (int i = 0; i < 4; i++)
        ck_assert(r.contacts.data[i].key == key[i]);
    body_remove(&r.bodies, 1);
    ck_assert_int_eq(regular(&r, MOTION_DYNAMIC, 6, 3, 0, vec3_make(0.4, 0.2, 0.99)), 1);
    rig_detect(&r);
    for (int i = 0; i < 4; i++)
        ck_assert(r.contacts.data[i].key != key[i]);
    contact same[5] = {{.key = 7}, {.key = 7}, {.key = 8}, {.key = 7}, {.key = 9}};
    contact_keys_part(same, 5);
    for (int i = 0; i < 5; i++)
        for (int k = 0; k < i; k++)
            ck_assert(same[i].key != same[k].key);
    rig_free(&r);
}
END_TEST

START_TEST(tangents_are_orthonormal)
{
    random_stream draw = random_begin(1, 0, 0);
    for (int i = 0; i < 200; i++) {
        vec3 n = vec3_unit(vec3_make(random_normal(&draw), random_normal(&draw), i % 3 ? random_normal(&draw) : 0)), t,
             u;
        if (i == 0)
            n = vec3_make(0, 0, -1);
        contact_tangents(n, &t, &u);
        assert_vec3_close(vec3_cross(n, t), u, 1e-15);
        assert_absolute(vec3_length(t), 1, 1e-15);
        assert_absolute(vec3_dot(n, t), 0, 1e-15);
    }
}
END_TEST

START_TEST(patch_pairs_are_left_to_others)
{
    rig r = rig_make(0.1);
    regular(&r, MOTION_DYNAMIC, 6, 3, 0, vec3_make(0, 0, 0));
    regular(&r, MOTION_DYNAMIC, 6, 3, 0, vec3_make(0.4, 0.2, 0.99));
    regular(&r, MOTION_DYNAMIC, 6, 3, 0, vec3_make(0.4, 0.2, -0.99));
    r.bodies.material[2] = MATERIAL_HULL;
    r.policies.of[MATERIAL_ICE][MATERIAL_HULL].patch = r.policies.of[MATERIAL_HULL][MATERIAL_ICE].patch = true;
    rig_detect(&r);
    ck_assert_int_eq(r.patch_pairs.count, 1);
    ck_assert_int_eq(r.pairs.a[r.patch_pairs.data[0]], 0);
    ck_assert_int_eq(r.pairs.b[r.patch_pairs.data[0]], 2);
    ck_assert_int_eq(r.contacts.count, 4);
    rig_free(&r);
}
END_TEST

/* ---- compounds ---- */

/* An L of two arms of 10 m, 4 m wide, about its corner; cut into convex pieces. */
static int32_t corner_floe(rig *r, overlay *o)
{
    vec2 l[6] = {{0, 0}, {10, 0}, {10, 4}, {4, 4}, {4, 10}, {0, 10}};
    int32_t slot = body_create(&r->ctx, &r->bodies, MOTION_STATIC, MATERIAL_ICE), row;
    fram_error e = {0};
    assert_ok(shape_add_prism(&r->ctx, &r->shapes, o, (polygon){l, 6}, 0.5, 0, &row, &e), e);
    ck_assert_int_gt(r->shapes.shapes.piece_count[row], 1);
    r->bodies.shape[slot] = row;
    ck_assert(array_resize(&r->ctx, &r->loads, r->bodies.count));
    return slot;
}

START_TEST(no_contact_takes_the_normal_of_a_seam)
{
    /* A sharp corner pressed 5 cm into the bottom side, all along it, seams included: always pushed straight down. */
    for (int k = 1; k < 80; k++) {
        rig r = rig_make(0.1);
        overlay *o = overlay_create(&r.ctx);
        corner_floe(&r, o);
        vec2 tip[3] = {{0, 0}, {-1, -4}, {1, -4}};
        rig_prism(&r, MOTION_DYNAMIC, (polygon){tip, 3}, 1, 900, vec3_make(0.125 * k, 0.05, 0));
        rig_detect(&r);
        ck_assert_msg(r.contacts.count > 0, "tip at %g is not seen", 0.125 * k);
        for (int32_t i = 0; i < r.contacts.count; i++) {
            assert_vec3_close(r.contacts.data[i].normal, vec3_make(0, 1, 0), 1e-9);
            if (r.contacts.data[i].depth > 0)
                ck_assert(r.contacts.data[i].depth < 0.0501);
        }
        assert_absolute(rig_deepest(&r), 0.05, 1e-9);
        overlay_free(o);
        rig_free(&r);
    }
}
END_TEST

/* A channel of 6 by 8 m, open at one end, with walls of 2 m. */
static int32_t bay(rig *r, overlay *o, vec3 position)
{
    vec2 corner[] = {{-5, -5}, {5, -5}, {5, 5}, {3, 5}, {3, -3}, {-3, -3}, {-3, 5}, {-5, 5}};
    int32_t slot = rig_box(r, MOTION_DYNAMIC, vec3_make(10, 10, 1), 900, position);
    fram_error e = {0};
    polygon outline = {corner, sizeof corner / sizeof *corner};
    assert_ok(shape_add_prism(&r->ctx, &r->shapes, o, outline, 0.5, 0, &r->bodies.shape[slot], &e), e);
    return slot;
}

static int32_t count_waiting(const rig *r)
{
    int32_t count = 0;
    for (int32_t i = 0; i < r->pairs.count; i++)
        count += r->boxes.travel[r->pairs.a[i]] + r->boxes.travel[r->pairs.b[i]] < r->pairs.clear[i];
    return count;
}

/* No plane parts a body in a bay from the other one, which is remembered all the same. */
START_TEST(a_body_in_a_bay_is_not_tested_again_and_again)
{
    rig r = rig_make(0.1);
    overlay *o = overlay_create(&r.ctx);
    bay(&r, o, vec3_make(0, 0, 0));
    regular(&r, MOTION_DYNAMIC, 8, 2.5, 0.1, vec3_make(0, 1, 0));
    rig_detect(&r);
    ck_assert_int_eq(r.pairs.count, 1);
    ck_assert_int_eq(r.contacts.count, 0);
    ck_assert_int_eq(count_waiting(&r), 1);
    ck_assert_double_gt(r.pairs.clear[0], 0.3); /* 0.5 m to the walls, less the reach */
    ck_assert_double_lt(r.pairs.clear[0], 0.7);
    overlay_free(o);
    rig_free(&r);
}
END_TEST

static uint64_t contacts_hash(const rig *r)
{
    uint64_t hash = 0;
    for (int32_t i = 0; i < r->contacts.count; i++) {
        const contact *c = &r->contacts.data[i];
        const double numbers[] = {c->point.x, c->point.y, c->point.z, c->normal.x, c->normal.y, c->normal.z, c->depth};
        hash = hash_bytes(numbers, sizeof numbers, hash_bytes(&c->key, sizeof c->key, hash));
    }
    return hash;
}

/* Bodies with bays and round ones pass through each other: what is remembered of a pair leaves no contact out. */
START_TEST(what_is_remembered_of_compounds_leaves_nothing_out)
{
    rig r = rig_make(0.02);
    random_stream draw = random_begin(12, 0, 0);
    overlay *o = overlay_create(&r.ctx);
    for (int i = 0; i < 24; i++) {
        vec3 p = {random_uniform(&draw, -12, 12), random_uniform(&draw, -12, 12), random_uniform(&draw, -0.3, 0.3)};
        int32_t slot = i % 2 ? bay(&r, o, p) : regular(&r, MOTION_DYNAMIC, 6, 1.5, 0.1 * i, p);
        r.bodies.velocity[slot] = vec3_make(0.5 * random_normal(&draw), 0.5 * random_normal(&draw), 0);
        r.bodies.angular_velocity[slot] = vec3_make(0.02 * random_normal(&draw), 0, 0.1 * random_normal(&draw));
    }
    int32_t waiting = 0, touching = 0;
    for (int k = 0; k < 300; k++) {
        rig_detect(&r);
        waiting += count_waiting(&r);
        touching += r.contacts.count;
        uint64_t remembered = contacts_hash(&r);
        pair_table kept = {0};
        ck_assert(table_copy(&r.ctx, &kept, &r.pairs, &pair_table_info));
        for (int32_t i = 0; i < r.pairs.count; i++) {
            r.pairs.axis[i] = vec3_make(0, 0, 0);
            r.pairs.clear[i] = 0;
        }
        rig_detect(&r);
        ck_assert_uint_eq(contacts_hash(&r), remembered);
        ck_assert(table_copy(&r.ctx, &r.pairs, &kept, &pair_table_info));
        table_free(&r.ctx, &kept, &pair_table_info);
        integrate_poses(&r.ctx, &r.bodies, r.dt);
    }
    ck_assert_int_gt(waiting, 3000);
    ck_assert_int_gt(touching, 3000);
    overlay_free(o);
    rig_free(&r);
}
END_TEST

START_TEST(memory_runs_out)
{
    for (failing_turn turn = {0}; failing_next(&turn);) {
        rig r = rig_make(0.1);
        for (int i = 0; i < 12; i++)
            regular(&r, MOTION_DYNAMIC, 6, 2, 0, vec3_make(3.4 * (i % 4), 3.4 * floor(i / 4.0), 0));
        collision_scratch *s = collision_scratch_create(&turn.ctx);
        broad_table boxes = {0};
        pair_table pairs = {0};
        contact_array contacts = {0};
        index_array patches = {0};
        turn.status =
            s ? broad_phase_update(&turn.ctx, &r.bodies, &r.shapes, &r.collision, &boxes, &pairs, s, &turn.error)
              : FRAM_ERROR_MEMORY;
        if (turn.status == FRAM_OK)
            turn.status = narrow_phase_run(&turn.ctx, &r.bodies, &r.shapes, &r.policies, &boxes, &pairs, &contacts,
                                           &patches, s, &turn.error);
        table_free(&turn.ctx, &boxes, &broad_table_info);
        table_free(&turn.ctx, &pairs, &pair_table_info);
        array_free(&turn.ctx, &contacts);
        array_free(&turn.ctx, &patches);
        collision_scratch_free(&turn.ctx, s);
        rig_free(&r);
        if (!turn.memory.failed)
            ck_assert(turn.n > 6);
    }
}
END_TEST

TEST_MAIN("collision", broad_phase_finds_all_pairs, pairs_keep_their_axes, a_state_of_another_time_finds_its_pairs,
          pairs_of_a_crowd_adrift_are_found, pairs_of_many_are_found_on_any_threads,
          pairs_with_a_crowd_that_stands_are_found, a_new_body_among_what_stands_has_its_own_box,
          another_state_of_what_stands_finds_its_pairs, unmoved_boxes_are_kept, lost_bodies_are_named,
          level_prisms_touch_as_their_outlines_do, contacts_turn_with_the_bodies, order_of_the_bodies_does_not_matter,
          crossed_edges_meet_in_a_point, a_body_in_a_bay_is_not_tested_again_and_again,
          what_is_remembered_of_compounds_leaves_nothing_out, keys_are_unique_and_die_with_their_bodies,
          tangents_are_orthonormal, patch_pairs_are_left_to_others, no_contact_takes_the_normal_of_a_seam,
          memory_runs_out)
