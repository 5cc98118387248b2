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
    scene_open_with(&k, SHIP, (const char *const[]){"vessel.positioning.active=false"}, 1);
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
    /* The controller has not called yet, and what it is not told does not count. */
    assert_absolute(k.w.thrusters.order[0], 0, 0);
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

START_TEST(the_controller_is_as_its_keys_say)
{
    static const char *const keys[] = {"vessel.positioning.mass_surge=2e6",
                                       "vessel.positioning.mass_sway=3e6",
                                       "vessel.positioning.mass_yaw=4e9",
                                       "vessel.positioning.damping_surge=5e4",
                                       "vessel.positioning.damping_sway=6e4",
                                       "vessel.positioning.damping_yaw=7e7",
                                       "vessel.positioning.reference_frequency=0.2",
                                       "vessel.positioning.reference_speed=0.7",
                                       "vessel.positioning.reference_turn_rate_deg=3",
                                       "vessel.positioning.bias_rate=0.002",
                                       "vessel.positioning.force_noise=0.05",
                                       "vessel.positioning.bias_time=800"};
    scene k;
    scene_open_with(&k, SHIP, keys, sizeof keys / sizeof *keys);
    const station_table *s = &k.w.stations;
    const double lever = 0.25 * 80;
    const vec3 mass = {2e6, 3e6, 4e9}, damping = {5e4, 6e4, 7e7}, per_mass = {2e6, 3e6, 4e9 / lever};
    assert_vec3_close(plane_diagonal(s->model[0].mass), mass, 0);
    assert_vec3_close(plane_diagonal(s->model[0].damping), damping, 0);
    assert_absolute(s->filter[0].frequency, 0.2, 0);
    assert_absolute(s->filter[0].speed, 0.7, 0);
    assert_relative(s->filter[0].turn, 3 * PI / 180, 1e-12);
    assert_vec3_close(s->kalman[0].force, vec3_scale(per_mass, 0.05), 1e-3);
    assert_vec3_close(s->kalman[0].bias, vec3_scale(per_mass, 0.002), 1e-3);
    assert_absolute(s->kalman[0].bias_time, 800, 0);
    scene_close(&k);
}
END_TEST

/* Water that is not there moves with nothing. */
START_TEST(without_water_no_added_mass)
{
    scene k;
    scene_open_with(&k, SHIP, (const char *const[]){"environment.water=false"}, 1);
    int32_t body = k.w.vessels.body[0];
    const vec3 none = {0, 0, 0};
    assert_vec3_close(k.w.bodies.added_mass[body], none, 0);
    assert_vec3_close(k.w.bodies.added_inertia[body], none, 0);
    assert_absolute(plane_diagonal(k.w.stations.model[0].mass).x, k.w.bodies.mass[body], 0);
    scene_close(&k);
}
END_TEST

/* A moored ship on positioning, which the current turns about its turret. */
static const char *const MOORED =
    "run: {duration: 10, time_step: 0.1, scale: 30}\n"
    "vessel:\n  mode: free\n  heading_deg: 60\n"
    "  hull: {form: box, length: 100, beam: 20, draught: 7, freeboard: 4}\n"
    "  hydrodynamics: {source: estimate}\n"
    "  mooring:\n    depth: 100\n    turret: true\n    x: 30\n"
    "    lines:\n      - {count: 4, spacing_deg: 90, direction_deg: 10, distance: 600, pretension: 5e5, weight: 1000}\n"
    "  thrusters:\n"
    "    - {kind: tunnel, x: 40, z: -5, thrust: 3.0e5}\n"
    "    - {kind: tunnel, x: -40, z: -5, thrust: 3.0e5}\n"
    "  positioning: {active: true, control: heading, heading: vaning, observer: kalman, noise_position: 0,\n"
    "                noise_heading_deg: 0}\n"
    "ice: {source: none}\ndomain: {boundary: open}\n"
    "environment: {current_speed: 0.8, current_direction_deg: 180}\n";

/* One that begins at the equilibrium believes and wants what is so, and is watched from where it was put. */
START_TEST(a_ship_believes_that_it_lies_at_its_equilibrium)
{
    scene k;
    scene_open(&k, MOORED);
    const station_table *s = &k.w.stations;
    int32_t body = k.w.vessels.body[0];
    double heading = quat_roll_pitch_yaw(k.w.bodies.orientation[body]).z;
    vec3 r = k.w.bodies.position[body], place = {r.x, r.y, heading};
    ck_assert_msg(fabs(degrees(heading) - 60) > 10, "begins at heading %g", degrees(heading));
    assert_vec3_close(s->estimate[0].place, place, 0);
    assert_vec3_close(s->reference[0].place, place, 0);
    assert_vec3_close(s->measured[0], place, 0);
    assert_absolute(s->vane_heading[0], heading, 0);
    assert_absolute(degrees(s->home[0].z), 60, 1e-9);
    /* The noise of the bias is along and across the ship as it lies. */
    ck_assert(fabs(s->covariance[0].of[9 * 6 + 7]) < 0.1 * s->covariance[0].of[9 * 6 + 6]);
    scene_steps(&k, 50);
    assert_absolute(s->vane_heading[0], heading, radians(1));
    ck_assert(fabs(k.w.bodies.angular_velocity[body].z) < radians(0.01));
    scene_close(&k);
}
END_TEST

TEST_MAIN("build_station", without_water_no_added_mass, a_ship_believes_that_it_lies_at_its_equilibrium,
          thrusters_are_as_their_keys_say, intervals_are_whole_steps_and_samples_fall_on_calls,
          the_controller_s_mass_is_the_vessel_s_with_its_added_mass, the_controller_is_as_its_keys_say)
