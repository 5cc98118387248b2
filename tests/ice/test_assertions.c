/* Assertions about patches and their limits stop a build that has them. */
#include "ice_rig.h"

static void crush(void *user) { ice_rig_crush(user); }

static void limit(void *user)
{
    ice_rig *r = user;
    crushing_limit_sides(&r->ctx, &r->settings, &r->bodies, &r->shapes, &r->floes, &r->policies, &r->contacts);
}

/* Points of a patch on a body that is no rigid turn, or of ice of no strength that there is. */
START_TEST(patches_that_cannot_be_stop_the_program)
{
    ice_rig r;
    ice_rig_make(&r, 0.01);
    int32_t row = ice_rig_plate(&r, 10, 10, 1, MOTION_DYNAMIC), body = r.floes.body[row];
    int32_t wall = ice_rig_box(&r, (vec3){0, -40, -30}, (vec3){20, 40, 30}, MOTION_STATIC, MATERIAL_HULL);
    ice_rig_place(&r, wall, (vec3){4.8, 0, 0}, 0, 0, 0);
    ice_rig_pair(&r, body, wall);
    ck_assert(!testing_aborts(crush, &r));
    r.bodies.orientation[body].z = 0.1; /* no turn, since w is 1 */
    assert_aborts(crush, &r);
    r.bodies.orientation[body].z = 0;
    ice_rig_free(&r);
}
END_TEST

/* Limits of floes side to side. */
START_TEST(limits_that_cannot_be_stop_the_program)
{
    ice_rig r;
    ice_rig_make(&r, 0.01);
    r.policies.of[MATERIAL_ICE][MATERIAL_ICE].sides = true;
    for (int i = 0; i < 2; i++)
        ck_assert_int_eq(ice_rig_plate(&r, 10, 10, 1, MOTION_DYNAMIC), i);
    ice_rig_place(&r, r.floes.body[1], (vec3){9.9, 0, 0}, 0, 0, 0);
    for (int i = 0; i < 2; i++) {
        contact c = {.a = 0, .b = 1, .point = {5, 10.0 * i - 5, 0}, .normal = {1, 0, 0}, .depth = 0.1, .patch = -1};
        ck_assert(array_push(&r.ctx, &r.contacts, c));
    }
    limit(&r);
    assert_relative(r.contacts.data[0].impulse_limit + r.contacts.data[1].impulse_limit, 2e6 * 10 * 0.01, 1e-7);
    r.floes.material[0].crushing_strength = -1;
    assert_aborts(limit, &r);
    r.floes.material[0].crushing_strength = r.floes.material[1].crushing_strength = (double)INFINITY;
    assert_aborts(limit, &r);
    ice_rig_free(&r);
}
END_TEST

TEST_MAIN_OF_ASSERTIONS("assertions", patches_that_cannot_be_stop_the_program, limits_that_cannot_be_stop_the_program)
