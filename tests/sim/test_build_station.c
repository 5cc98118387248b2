/* What the keys of a station become: angles in radians, halves of widths, whole numbers of steps, the controller's
 * model. */
#include "scene.h"

static const char *const SHIP = "run: {duration: 10, time_step: 0.05, scale: 30}\n"
                                "vessel:\n  mode: free\n"
                                "  hull: {form: box, length: 80, beam: 16, draught: 5, freeboard: 3}\n"
                                "  hydrodynamics: {source: estimate}\n"
                                "  thrusters:\n"
                                "    - {kind: azimuth, x: -30, z: -4, thrust: 4e5, setting: 0.5,\n"
                                "       direction_deg: 30, forbidden_deg: 90, forbidden_width_deg: 40}\n"
                                "    - {kind: tunnel, x: 30, z: -4, thrust: 4e5, thrust_astern: 1e5, setting: -0.5}\n"
                                "    - {kind: tunnel, x: 32, z: -4, thrust: 4e5, setting: -0.5}\n"
                                "  positioning: {active: true, interval: 0.4899999, sample_interval: 0.7}\n"
                                "  station: {offset_limit: 5, heading_limit_deg: 12}\n"
                                "ice: {source: none}\n";

START_TEST(thrusters_are_as_their_keys_say)
{
    scene k;
    scene_open(&k, SHIP);
    ck_assert_int_eq(k.w.thrusters.count, 3);
    assert_relative(k.w.thrusters.forbidden_centre[0], 0.5 * PI, 1e-12);
    assert_relative(k.w.thrusters.forbidden_half[0], PI / 9, 1e-12);
    assert_relative(k.w.thrusters.order_angle[0], PI / 6, 1e-12);
    /* Half of what it gives astern, which is that ahead where nothing else is said. */
    assert_relative(k.w.thrusters.order[0], 2e5, 1e-12);
    assert_relative(k.w.thrusters.order[1], -5e4, 1e-12);
    assert_relative(k.w.thrusters.order[2], -2e5, 1e-12);
    scene_close(&k);
}
END_TEST

START_TEST(intervals_are_whole_steps_and_samples_fall_on_calls)
{
    scene k;
    scene_open(&k, SHIP);
    /* 9.8 steps between calls are ten, and 14 between samples the next multiple of it. */
    ck_assert_int_eq(k.w.stations.control_every[0], 10);
    ck_assert_int_eq(k.w.stations.sample_every[0], 20);
    assert_relative(k.w.stations.heading_limit[0], radians(12), 1e-12);
    assert_absolute(k.w.stations.offset_limit[0], 5, 0);
    scene_close(&k);
}
END_TEST

START_TEST(the_controller_s_mass_is_the_vessel_s_with_its_added_mass)
{
    scene k;
    scene_open(&k, SHIP);
    int32_t body = k.w.vessels.body[0];
    vec3 added = k.w.bodies.added_mass[body], mass = plane_diagonal(k.w.stations.model[0].mass);
    ck_assert(added.y > 2 * added.x && added.x > 0);
    assert_relative(mass.x, k.w.bodies.mass[body] + added.x, 1e-12);
    assert_relative(mass.y, k.w.bodies.mass[body] + added.y, 1e-12);
    assert_relative(mass.z, k.w.bodies.inertia[body].zz + k.w.bodies.added_inertia[body].z, 1e-12);
    /* Time constants of 100, 50 and 20 s at full scale. */
    vec3 damping = plane_diagonal(k.w.stations.model[0].damping);
    assert_relative(mass.x / damping.x, 100, 1e-12);
    assert_relative(mass.y / damping.y, 50, 1e-12);
    assert_relative(mass.z / damping.z, 20, 1e-12);
    scene_close(&k);
}
END_TEST

TEST_MAIN("build_station", thrusters_are_as_their_keys_say, intervals_are_whole_steps_and_samples_fall_on_calls,
          the_controller_s_mass_is_the_vessel_s_with_its_added_mass)
