/* Current and wind that change with time and depth. */
#include "samples.h"

START_TEST(series)
{
    double time[] = {10, 20, 40};
    vec3 velocity[] = {{1, 0, 0}, {0, 2, 0}, {-1, 2, 0}};
    velocity_series s = {3, time, velocity};
    assert_vec3_close(velocity_series_at(&s, -5), velocity[0], 0);
    assert_vec3_close(velocity_series_at(&s, 10), velocity[0], 0);
    assert_vec3_close(velocity_series_at(&s, 12.5), vec3_make(0.75, 0.5, 0), 1e-15);
    assert_vec3_close(velocity_series_at(&s, 20), velocity[1], 0);
    assert_vec3_close(velocity_series_at(&s, 35), vec3_make(-0.75, 2, 0), 1e-15);
    assert_vec3_close(velocity_series_at(&s, 40), velocity[2], 0);
    assert_vec3_close(velocity_series_at(&s, 1e9), velocity[2], 0);
    s.count = 1;
    assert_vec3_close(velocity_series_at(&s, 0), velocity[0], 0);
    assert_vec3_close(velocity_series_at(&s, 99), velocity[0], 0);
}
END_TEST

START_TEST(media_of_an_instant)
{
    media still = still_water;
    still.current = vec3_make(0.5, 0, 0);
    media_history h = {0};
    media m = media_at(&still, &h, 3);
    assert_vec3_close(m.current, still.current, 0);
    ck_assert_int_eq(m.profile.count, 0);
    double time[] = {0, 10};
    vec3 velocity[] = {{0, 0, 0}, {0, 4, 0}};
    h.wind = (velocity_series){2, time, velocity};
    h.profile = (current_profile){2, {0, 2}, {{1, 0, 0}, {0, 0, 0}}};
    m = media_at(&still, &h, 5);
    assert_vec3_close(m.wind, vec3_make(0, 2, 0), 0);
    assert_vec3_close(media_current(&m, -1), vec3_make(1, 0, 0), 1e-15);
    ck_assert(m.water_density == still.water_density && m.gravity == still.gravity);
}
END_TEST

/* A floe feels the current in the middle of its wet part, on either way of reckoning. */
START_TEST(floe_in_a_profile)
{
    media m = still_water, there = still_water;
    m.profile = (current_profile){2, {0, 2}, {{1, 0.4, 0}, {0, 0, 0}}};
    static const drag_coefficients c[MATERIAL_COUNT] = {{1, 0.01, 0, 0}};
    for (int k = 0; k < 3; k++) {
        fluid_motion state = motion_at(vec3_make(0, 0, k == 1 ? -0.8 : -0.1), k == 2 ? 0.15 : 0, 0, 0);
        double half = 0.5, rise = half * state.rotation.m[2][2], height = state.position.z;
        double middle = height + rise <= 0 ? height : 0.5 * (height - rise);
        there.current = media_current(&m, middle);
        fluid_load got, expected;
        fluid_load_prism(&m, &c[0], OUTLINE(square_outline), half, &state, &got);
        fluid_load_prism(&there, &c[0], OUTLINE(square_outline), half, &state, &expected);
        assert_vec3_close(got.water_drag.force, expected.water_drag.force, 1e-9);
        ck_assert(got.water_drag.force.x > 0);
        context ctx;
        context_init(&ctx);
        body_table bodies = {0};
        shape_store shapes = {0};
        fram_error error = {0};
        int32_t shape;
        assert_ok(shape_add_prism(&ctx, &shapes, NULL, OUTLINE(square_outline), half, 0, &shape, &error), error);
        int32_t slot = body_create(&ctx, &bodies, MOTION_DYNAMIC, MATERIAL_ICE);
        bodies.position[slot] = state.position;
        bodies.orientation[slot] = quat_from_roll_pitch_yaw(k == 2 ? 0.15 : 0, 0, 0);
        bodies.shape[slot] = shape;
        bodies.mass[slot] = 1;
        wrench load;
        fluid_load detail;
        assert_ok(fluid_apply(&ctx, &m, c, &bodies, &shapes, NULL, &load, &(fluid_details){.all = &detail}, &error),
                  error);
        assert_vec3_close(detail.water_drag.force, expected.water_drag.force, 1e-9);
        table_free(&ctx, &bodies, &body_table_info);
        shape_store_free(&ctx, &shapes);
    }
}
END_TEST

TEST_MAIN("media", series, media_of_an_instant, floe_in_a_profile)
