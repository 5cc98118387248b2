/* Assertions about what the solver is given stop a build that has them: contact frames, bodies, joints. */
#include "rig.h"

static void solve(void *user) { rig_solve(user); }

/* A box that stands on another, as the narrow phase finds it. */
static rig standing(void)
{
    rig r = rig_make(0.01);
    rig_box(&r, MOTION_STATIC, (vec3){10, 10, 1}, 900, (vec3){0, 0, 0});
    rig_box(&r, MOTION_DYNAMIC, (vec3){2, 2, 1}, 900, (vec3){0, 0, 0.999});
    rig_friction(&r, 0.3, 0.2);
    rig_detect(&r);
    ck_assert_int_ge(r.contacts.count, 4);
    return r;
}

/* One number changed, noticed, and put back. */
#define STOPS(r, member, value)              \
    do {                                     \
        __typeof__(member) kept_ = (member); \
        (member) = (value);                  \
        assert_aborts(solve, &(r));          \
        (member) = kept_;                    \
    } while (0)

START_TEST(contacts_that_cannot_be_stop_the_program)
{
    rig r = standing();
    contact *c = &r.contacts.data[1];
    ck_assert(!testing_aborts(solve, &r));
    STOPS(r, c->normal.z, 1.001 * c->normal.z);
    STOPS(r, c->normal.x, 0.1);
    STOPS(r, c->normal.y, (double)NAN);
    STOPS(r, c->a, c->b);
    STOPS(r, c->a, -1);
    STOPS(r, c->b, r.bodies.count);
    STOPS(r, c->impulse_limit, -1);
    STOPS(r, c->impulse_limit, (double)NAN);
    STOPS(r, c->friction_static, -0.1);
    STOPS(r, c->friction_kinetic, (double)NAN);
    STOPS(r, c->depth, (double)INFINITY);
    ck_assert(!testing_aborts(solve, &r));
    rig_free(&r);
}
END_TEST

START_TEST(bodies_that_cannot_be_stop_the_program)
{
    rig r = standing();
    STOPS(r, r.bodies.orientation[1].w, 1.001);
    STOPS(r, r.bodies.orientation[0].x, (double)NAN);
    STOPS(r, r.bodies.motion[1], MOTION_NONE); /* its contacts are still there */
    joint_create(&r.ctx, &r.joints, &r.bodies, 0, 1, JOINT_PRISMATIC_Z, (vec3){0, 0, 0}, quat_identity());
    ck_assert_int_eq(r.joints.count, 1);
    ck_assert(!testing_aborts(solve, &r));
    STOPS(r, r.joints.a[0], -2);
    STOPS(r, r.joints.b[0], r.bodies.count);
    rig_free(&r);
}
END_TEST

TEST_MAIN_OF_ASSERTIONS("assertions", contacts_that_cannot_be_stop_the_program, bodies_that_cannot_be_stop_the_program)
