/* Symmetries of docs/oracles.md, 6: a scaled, moving, mirrored or turned scene gives the scaled, moved, mirrored or
   turned result.  They find every hidden dimensional constant, frame and sign. */
#include "scene.h"

#include <stdio.h>

enum { TEXT_SIZE = 4096 };

static vec3 load_on(const scene *k) { return k->w.scratch.ice_loads.data[0].total.force; }

/* ---- scaling ---- */

/* A towed hull in a managed field with crushing, friction, current and wind, all lengths times lambda (Froude). */
static void scaled_text(char out[TEXT_SIZE], double lambda, double root)
{
    snprintf(out, TEXT_SIZE,
             "run:\n  duration: %.17g\n  time_step: %.17g\n  seed: 5\n  scale: %.17g\n"
             "vessel:\n  mode: towed\n  x: %.17g\n  speed: %.17g\n"
             "  hull:\n    length: %.17g\n    beam: %.17g\n    draught: %.17g\n    freeboard: %.17g\n"
             "ice:\n  concentration: 0.85\n  mean_floe_area: %.17g\n  thickness: %.17g\n"
             "  crushing_strength: %.17g\n  elastic_modulus: %.17g\n  flexural_strength: %.17g\n"
             "domain:\n  x_min: %.17g\n  x_max: %.17g\n  y_min: %.17g\n  y_max: %.17g\n"
             "environment:\n  current_speed: %.17g\n  current_direction_deg: 90\n  wind_speed: %.17g\n",
             100 * root, 0.015625 * root, 30 * lambda, -30 * lambda, 2 * root, 48 * lambda, 12 * lambda, 4 * lambda,
             2 * lambda, 64 * lambda * lambda, 1 * lambda, 2e6 * lambda, 5e9 * lambda, 5e5 * lambda, -64 * lambda,
             64 * lambda, -40 * lambda, 40 * lambda, 0.25 * root, 8 * root);
}

static void check_scaled(double lambda, double root)
{
    scene small, large;
    char text[TEXT_SIZE];
    scaled_text(text, 1, 1);
    scene_open(&small, text);
    scaled_text(text, lambda, root);
    scene_open(&large, text);
    ck_assert_int_eq(small.w.bodies.count, large.w.bodies.count);
    ck_assert_int_gt(small.w.floes.count, 50);
    double load = 0;
    for (int i = 0; i < 300; i++) {
        scene_steps(&small, 1);
        scene_steps(&large, 1);
        load = fmax(load, vec3_length(small.w.scratch.ice_loads.data[0].total.force));
    }
    ck_assert_msg(load > 1e3, "the hull met no ice (%g N)", load);
    for (int32_t b = 0; b < small.w.bodies.count; b++) {
        assert_vec3_close(vec3_scale(large.w.bodies.position[b], 1 / lambda), small.w.bodies.position[b], 1e-12 * 64);
        assert_vec3_close(vec3_scale(large.w.bodies.velocity[b], 1 / root), small.w.bodies.velocity[b], 1e-12);
    }
    assert_vec3_close(vec3_scale(large.w.scratch.ice_loads.data[0].total.force, 1 / (lambda * lambda * lambda)),
                      small.w.scratch.ice_loads.data[0].total.force, 1e-12 * load);
    scene_close(&small);
    scene_close(&large);
}

START_TEST(scaling_by_four) { check_scaled(4, 2); }
END_TEST
START_TEST(scaling_by_sixteen) { check_scaled(16, 4); }
END_TEST

/* A box that turns against fixed ice, all lengths times lambda, so slowly that about a third of its side rests there:
   by what it goes past the ice, not by lengths. */
static void turning_text(char out[TEXT_SIZE], double lambda, double root)
{
    snprintf(out, TEXT_SIZE,
             "run: {duration: %.17g, time_step: %.17g, scale: %.17g}\n"
             "vessel:\n  mode: prescribed\n  path: [{}, {time: %.17g, heading_deg: 0.1}]\n"
             "  hull: {form: box, length: %.17g, beam: %.17g, draught: %.17g, freeboard: %.17g}\n"
             "ice:\n  source: floes\n  crushing_strength: %.17g\n"
             "  floes: [{length: %.17g, width: %.17g, x: %.17g, y: %.17g, thickness: %.17g, fixed: true}]\n"
             "domain: {x_min: %.17g, x_max: %.17g, y_min: %.17g, y_max: %.17g, boundary: open}\n",
             20 * root, 0.02 * root, 30 * lambda, 20 * root, 40 * lambda, 12 * lambda, 4 * lambda, 2 * lambda,
             2e6 * lambda, 30 * lambda, 12 * lambda, 2 * lambda, 11.99 * lambda, lambda, -100 * lambda, 100 * lambda,
             -100 * lambda, 100 * lambda);
}

START_TEST(a_hull_that_turns_slowly_scaled)
{
    scene small, large;
    char text[TEXT_SIZE];
    turning_text(text, 1, 1);
    scene_open(&small, text);
    turning_text(text, 4, 2);
    scene_open(&large, text);
    double most = 0, apart = 0;
    for (int i = 0; i < 500; i++) {
        scene_steps(&small, 1);
        scene_steps(&large, 1);
        vec3 a = load_on(&small), b = vec3_scale(load_on(&large), 1.0 / 64);
        most = fmax(most, vec3_length(a));
        apart = testing_larger(apart, vec3_length(vec3_sub(a, b)));
    }
    ck_assert_msg(most > 1e6, "the hull met no ice (%g N)", most);
    ck_assert_msg(apart <= 1e-12 * most, "loads differ by %g of %g N", apart, most);
    scene_close(&small);
    scene_close(&large);
}
END_TEST

/* ---- Galileo ---- */

/* A driven hull meets four floes; everything also moves with (shift, 0) m/s.  Floes that crush each other stand a
   little apart at first: where they overlap for good (without crushing, a step or two), level faces of one height may
   be met in three points or in four by a rounding. */
static void moving_text(char out[TEXT_SIZE], bool crushes, double hull_speed, double shift)
{
    int n = snprintf(out, TEXT_SIZE,
                     "run:\n  duration: 10\n  time_step: 0.02\n"
                     "vessel:\n  mode: prescribed\n  x: 0\n  speed: %.17g\n  course_deg: %d\n"
                     "  hull:\n    length: 60\n    beam: 14\n    draught: 5\n    freeboard: 3\n"
                     "ice:\n  source: floes\n  crushing_strength: 1e6\n  cap_ice_ice: %s\n  floes:\n",
                     fabs(hull_speed), hull_speed < 0 ? 180 : 0, crushes ? "true" : "false");
    double length = crushes ? 10 : 9.5, width = crushes ? 10.1 : 9.9;
    for (int i = 0; i < 4; i++)
        n += snprintf(out + n, (size_t)(TEXT_SIZE - n),
                      "    - shape: regular\n      sides: %d\n      radius: 5\n      x: %.17g\n      y: %.17g\n"
                      "      yaw_deg: %d\n      velocity_x: %.17g\n",
                      5 + i, (crushes ? 33 : 34) + length * (i / 2), -4.9 + width * (i % 2), 7 * i, shift);
    snprintf(out + n, (size_t)(TEXT_SIZE - n),
             "domain:\n  x_min: -500\n  x_max: 500\n  boundary: open\n"
             "environment:\n  current_speed: %.17g\n  current_direction_deg: %d\n"
             "  wind_speed: %.17g\n  wind_direction_deg: %d\n",
             fabs(shift), shift < 0 ? 180 : 0, fabs(shift), shift < 0 ? 180 : 0);
}

static void check_moving(bool crushes)
{
    scene still, moving;
    char text[TEXT_SIZE];
    moving_text(text, crushes, 3, 0);
    scene_open(&still, text);
    moving_text(text, crushes, 0, -3);
    scene_open(&moving, text);
    double peak = 0, apart = 0;
    for (int i = 0; i < 50; i++) {
        scene_steps(&still, 1);
        scene_steps(&moving, 1);
        vec3 a = still.w.scratch.ice_loads.data[0].total.force, b = moving.w.scratch.ice_loads.data[0].total.force;
        peak = fmax(peak, vec3_length(a));
        apart = testing_larger(apart, vec3_length(vec3_sub(a, b)));
    }
    ck_assert_msg(peak > 1e4, "the hull met no ice (%g N)", peak);
    ck_assert_msg(apart <= 1e-9 * peak, "loads differ by %g of %g N", apart, peak);
    scene_close(&still);
    scene_close(&moving);
}

START_TEST(moving_hull_equals_moving_ice)
{
    check_moving(false);
    check_moving(true);
}
END_TEST

/* ---- mirror and turn ---- */

/* One hull, two floes off the centre line, in a frame turned by `turn` degrees and mirrored in the hull's own plane. */
static void placed_text(char out[TEXT_SIZE], int turn, int mirror)
{
    double c = turn == 90 ? 0 : 1, s = turn == 90 ? 1 : 0;
    const double floe[2][3] = {{36, 3.5, 20}, {37.5, -6.5, -35}};
    int n = snprintf(out, TEXT_SIZE,
                     "run:\n  duration: 10\n  time_step: 0.02\n  solver:\n    kind: accurate\n    tolerance: 1e-13\n"
                     "vessel:\n  mode: prescribed\n  heading_deg: %d\n  speed: 1.5\n"
                     "  hull:\n    length: 60\n    beam: 14\n    draught: 5\n    freeboard: 3\n"
                     "ice:\n  source: floes\n  floes:\n",
                     turn);
    for (int i = 0; i < 2; i++) {
        double x = floe[i][0], y = mirror * floe[i][1];
        n += snprintf(out + n, (size_t)(TEXT_SIZE - n),
                      "    - shape: rectangle\n      length: 12\n      width: 6\n"
                      "      x: %.17g\n      y: %.17g\n      yaw_deg: %.17g\n",
                      c * x - s * y, s * x + c * y, turn + mirror * floe[i][2]);
    }
    snprintf(out + n, (size_t)(TEXT_SIZE - n),
             "domain:\n  x_min: -500\n  x_max: 500\n  y_min: -500\n  y_max: 500\n  boundary: open\n");
}

static void check_placed(int turn, int mirror)
{
    scene plain, placed;
    char text[TEXT_SIZE];
    placed_text(text, 0, 1);
    scene_open(&plain, text);
    placed_text(text, turn, mirror);
    scene_open(&placed, text);
    double peak = 0;
    for (int i = 0; i < 150; i++) {
        scene_steps(&plain, 1);
        scene_steps(&placed, 1);
        vec3 a = plain.w.scratch.ice_loads.data[0].total.force, b = placed.w.scratch.ice_loads.data[0].total.force;
        vec3 back = turn == 90 ? vec3_make(b.y, -b.x, b.z) : vec3_make(b.x, mirror * b.y, b.z);
        peak = fmax(peak, vec3_length(a));
        assert_vec3_close(back, a, 1e-6 * peak + 1e-6);
    }
    ck_assert_msg(peak > 1e4, "the hull met no ice (%g N)", peak);
    scene_close(&plain);
    scene_close(&placed);
}

START_TEST(mirrored_scene) { check_placed(0, -1); }
END_TEST
START_TEST(turned_scene) { check_placed(90, 1); }
END_TEST

/* ---- stations ---- */

/* A ship on dynamic positioning that moves to a way point across current and wind: all of it turned by `turn` degrees
   about the origin, and lengths times lambda.  Tunings are the defaults. */
static void station_text(char out[TEXT_SIZE], const char *observer, double turn, double lambda, double root)
{
    const double place[2][2] = {{3, -2}, {9, 4}};
    double c = real_cos(radians(turn)), s = real_sin(radians(turn)), at[2][2], force = lambda * lambda * lambda;
    for (int i = 0; i < 2; i++) {
        at[i][0] = lambda * (c * place[i][0] - s * place[i][1]);
        at[i][1] = lambda * (s * place[i][0] + c * place[i][1]);
    }
    snprintf(
        out, TEXT_SIZE,
        "run: {duration: 100, time_step: %.17g, scale: %.17g}\n"
        "vessel:\n  mode: free\n  x: %.17g\n  y: %.17g\n  heading_deg: %.17g\n  hydrodynamics: {source: estimate}\n"
        "  hull: {length: %.17g, beam: %.17g, draught: %.17g, freeboard: %.17g}\n"
        "  thrusters:\n    - {kind: tunnel, x: %.17g, thrust: %.17g}\n    - {x: %.17g, thrust: %.17g}\n"
        "  positioning:\n    active: true\n    observer: %s\n    feed_forward: observed\n"
        "    noise_position: 0\n    noise_heading_deg: 0\n"
        "    waypoints: [{time: 0, x: %.17g, y: %.17g, heading_deg: %.17g}]\n"
        "ice: {source: none}\ndomain: {boundary: open, x_min: -1e3, x_max: 1e3, y_min: -1e3, y_max: 1e3}\n"
        "environment:\n  current_speed: %.17g\n  current_direction_deg: %.17g\n"
        "  wind_speed: %.17g\n  wind_direction_deg: %.17g\n",
        0.125 * root, 30 * lambda, at[0][0], at[0][1], turn + 20, 60 * lambda, 14 * lambda, 5 * lambda, 3 * lambda,
        20 * lambda, 1e5 * force, -24 * lambda, 2e5 * force, observer, at[1][0], at[1][1], turn + 35, 0.5 * root,
        turn + 80, 10 * root, turn + 150);
}

static void check_station(const char *observer, double turn, double lambda, double root)
{
    scene plain, other;
    char text[TEXT_SIZE];
    station_text(text, observer, 0, 1, 1);
    scene_open(&plain, text);
    station_text(text, observer, turn, lambda, root);
    scene_open(&other, text);
    double moved = 0, load = 0, apart = 0;
    for (int i = 0; i < 300; i++) {
        scene_steps(&plain, 1);
        scene_steps(&other, 1);
        vec3 a = plain.w.stations.estimate[0].bias, b = other.w.stations.estimate[0].bias;
        a = plane_to_global(radians(turn), a);
        b = vec3_scale(vec3_make(b.x, b.y, b.z / lambda), 1 / (lambda * lambda * lambda));
        load = fmax(load, hypot(a.x, a.y));
        apart = testing_larger(apart, hypot(a.x - b.x, a.y - b.y));
        vec3 p = plane_to_global(radians(turn), plain.w.bodies.position[0]), q = other.w.bodies.position[0];
        assert_vec3_close(vec3_scale(q, 1 / lambda), p, 1e-7);
        moved = fmax(moved, vec3_length(vec3_sub(plain.w.bodies.position[0], vec3_make(3, -2, 0))));
    }
    ck_assert_msg(moved > 3 && load > 5e3, "it moved by %g m, and took %g N for a load", moved, load);
    ck_assert_msg(apart <= 1e-7 * load, "%s, turned by %g, scaled by %g: loads told apart by %g of %g N", observer,
                  turn, lambda, apart, load);
    scene_close(&plain);
    scene_close(&other);
}

/* What a ship on station believes and does goes by neither where north is nor how large it is. */
START_TEST(stations_turned_and_scaled)
{
    check_station("passive", 40, 1, 1);
    check_station("passive", 0, 4, 2);
    check_station("kalman", 40, 1, 1);
    check_station("kalman", 0, 4, 2);
}
END_TEST

/* A ship that drives itself round a corner, all lengths times lambda: rudders and autopilot are the defaults. */
static void propelled_text(char out[TEXT_SIZE], double lambda, double root)
{
    double force = lambda * lambda * lambda;
    snprintf(out, TEXT_SIZE,
             "run: {duration: 200, time_step: %.17g, scale: %.17g}\n"
             "vessel:\n  mode: free\n  speed: %.17g\n  hydrodynamics: {source: estimate}\n"
             "  hull: {length: %.17g, beam: %.17g, draught: %.17g, freeboard: %.17g}\n"
             "  propulsion:\n    bollard_pull: %.17g\n    open_water_speed: %.17g\n    propeller_diameter: %.17g\n"
             "    waypoints: [{x: %.17g, y: %.17g}, {x: %.17g, y: %.17g}]\n"
             "ice: {source: none}\ndomain: {boundary: open, x_min: -1e4, x_max: 1e4, y_min: -1e4, y_max: 1e4}\n",
             0.25 * root, 30 * lambda, 2 * root, 60 * lambda, 14 * lambda, 5 * lambda, 3 * lambda, 6e5 * force,
             7 * root, 3 * lambda, 60 * lambda, 20 * lambda, 100 * lambda, 200 * lambda);
}

START_TEST(a_ship_under_way_scaled)
{
    scene small, large;
    char text[TEXT_SIZE];
    propelled_text(text, 1, 1);
    scene_open(&small, text);
    propelled_text(text, 4, 2);
    scene_open(&large, text);
    double most = 0;
    for (int i = 0; i < 200; i++) {
        scene_steps(&small, 1);
        scene_steps(&large, 1);
        most = fmax(most, fabs(small.w.propulsion.steering[0]));
        assert_absolute(large.w.propulsion.steering[0], small.w.propulsion.steering[0], 1e-9);
        assert_vec3_close(vec3_scale(large.w.bodies.position[0], 0.25), small.w.bodies.position[0], 1e-7);
    }
    ck_assert_msg(most > radians(10), "the rudder turned by %g degrees", degrees(most));
    scene_close(&small);
    scene_close(&large);
}
END_TEST

/* ---- ice that breaks ---- */

/* A bow `side` metres beside the middle of a sheet and turned by as many degrees cuts into it, by the accurate solver.
 */
static void breaking_text(char out[TEXT_SIZE], double side, bool inertia)
{
    snprintf(out, TEXT_SIZE,
             "run: {duration: 10, time_step: 0.02, solver: {kind: accurate}}\n"
             "vessel:\n  mode: towed\n  x: -32\n  y: %.17g\n  heading_deg: %.17g\n  course_deg: 0\n  speed: 2\n"
             "  hull: {form: icebreaker, length: 60, beam: 14, draught: 5, freeboard: 3, stem_angle_deg: 30,\n"
             "         entrance_angle_deg: 32, flare_angle_deg: 10, stern_angle_deg: 30, parallel_midbody: 0.45}\n"
             "ice: {source: level, thickness: 0.7, breakable: true, level: {x_min: 0}, fracture: {edge_inertia: %s}}\n"
             "domain: {x_min: -80, x_max: 60, y_min: -30, y_max: 30, boundary: open}\n",
             side, side, inertia ? "true" : "false");
}

/* Through the first break and the steps after it a bow beside the middle is pushed as its mirror image.  One on the
   middle line is pushed to neither side until it breaks; then pieces that lie on more points than hold them share a
   load as the order of the sweeps has it, which no symmetry decides (docs/limits.md): a little, where an edge
   without inertia lets them go gently.  With it they knock about, and mirror images part after some steps. */
static void check_breaking(bool inertia, int steps_after)
{
    char text[TEXT_SIZE];
    double most = 0, aside = 0, apart = 0;
    scene k[3];
    for (int i = 0; i < 3; i++) {
        breaking_text(text, i - 1, inertia);
        scene_open(&k[i], text);
    }
    for (int after = 0, steps = 0; after < steps_after && steps < 400; steps++) {
        bool broken = after > 0;
        for (int i = 0; i < 3; i++) {
            scene_steps(&k[i], 1);
            broken = broken || k[i].w.scratch.fractures.count > 0;
        }
        vec3 port = load_on(&k[2]), starboard = load_on(&k[0]), middle = load_on(&k[1]);
        after += broken;
        most = fmax(most, fabs(middle.x));
        aside = testing_larger(aside, fabs(middle.y));
        if (after <= 1)
            assert_absolute(middle.y, 0, 1e-9 * most);
        apart = testing_larger(apart, testing_larger(fabs(port.x - starboard.x), fabs(port.y + starboard.y)));
    }
    ck_assert(most > 1e5);
    ck_assert(inertia || aside < 0.05 * most);
    ck_assert_double_lt(apart, 0.02 * most);
    for (int i = 0; i < 3; i++)
        scene_close(&k[i]);
}

START_TEST(breaking_ice_is_mirrored)
{
    check_breaking(false, 10);
    check_breaking(true, 4);
}
END_TEST

/* A ship towed along x, or along y, into a sheet whose small pieces join others. */
static void coarse_text(char out[TEXT_SIZE], double side, bool turned)
{
    double x = 0, y = side;
    snprintf(out, TEXT_SIZE,
             "run: {duration: 10, time_step: 0.02, scale: 20}\n"
             "vessel:\n  mode: towed\n  x: %.17g\n  y: %.17g\n  heading_deg: %d\n  speed: 1.3\n"
             "  hull: {form: icebreaker, length: 45, beam: 11, draught: 4}\n"
             "ice: {source: level, thickness: 0.4, breakable: true, smallest_floe_area: 1, level: {%c_min: 32}}\n"
             "domain: {x_min: %d, x_max: %d, y_min: %d, y_max: %d, boundary: open}\n",
             turned ? -y : x, turned ? x : y, turned ? 90 : 0, turned ? 'y' : 'x', turned ? -50 : -60, turned ? 50 : 80,
             turned ? -60 : -50, turned ? 80 : 50);
}

static int steps_to_break(const char *text, int *pieces)
{
    scene k;
    int steps = 0;
    scene_open(&k, text);
    for (; steps < 400 && k.w.scratch.fractures.count == 0; steps++)
        scene_steps(&k, 1);
    ck_assert_int_eq(k.w.scratch.fractures.count, 1);
    *pieces = k.w.scratch.fractures.data[0].pieces;
    scene_close(&k);
    return steps;
}

/* Pieces that are cut one by one from a sheet that lies along x or along y differ by other roundings, and so break and
   join as they do there. */
START_TEST(a_turned_sheet_breaks_in_the_same_step)
{
    char text[TEXT_SIZE];
    for (int i = 0; i < 12; i++) {
        int pieces, turned_pieces;
        coarse_text(text, 1 + 0.5 * i, false);
        int steps = steps_to_break(text, &pieces);
        coarse_text(text, 1 + 0.5 * i, true);
        ck_assert_int_eq(steps_to_break(text, &turned_pieces), steps);
        ck_assert_int_eq(turned_pieces, pieces);
    }
}
END_TEST

/* ---- ice that melts ---- */

/* A ship whose sides melt level ice that they have bent, all lengths times lambda; heat: that of melting; exponent: of
   the crushing pressure, with which the strength goes with a power of its own. */
static void melting_text(char out[TEXT_SIZE], double lambda, double root, double heat, double exponent)
{
    snprintf(out, TEXT_SIZE,
             "run: {duration: %.17g, time_step: %.17g, scale: %.17g}\n"
             "vessel:\n  mode: towed\n  x: %.17g\n  speed: %.17g\n"
             "  hull: {form: icebreaker, length: %.17g, beam: %.17g, draught: %.17g, freeboard: %.17g}\n"
             "ice:\n  source: level\n  breakable: true\n  thickness: %.17g\n  level: {x_min: 0}\n"
             "  crushing_strength: %.17g\n  crushing_exponent: %.17g\n  elastic_modulus: %.17g\n"
             "  flexural_strength: %.17g\n  fracture: {latent_heat: %.17g}\n"
             "domain: {x_min: %.17g, x_max: %.17g, y_min: %.17g, y_max: %.17g, boundary: open}\n",
             100 * root, 0.02 * root, 30 * lambda, -32 * lambda, 2 * root, 60 * lambda, 14 * lambda, 5 * lambda,
             3 * lambda, 0.7 * lambda, 2e6 * lambda / pow(lambda, 2 * exponent), exponent, 5e9 * lambda, 5e5 * lambda,
             heat, -80 * lambda, 60 * lambda, -30 * lambda, 30 * lambda);
}

/* Of so many steps those in which loads are not those of the other scene, times lambda^3, to the bit. */
static int steps_apart(double lambda, double root, double heat, double exponent, int steps)
{
    scene small, large;
    char text[TEXT_SIZE];
    melting_text(text, 1, 1, 334e3, exponent);
    scene_open(&small, text);
    melting_text(text, lambda, root, heat, exponent);
    scene_open(&large, text);
    int apart = 0;
    for (int i = 0; i < steps; i++) {
        scene_steps(&small, 1);
        scene_steps(&large, 1);
        vec3 a = load_on(&small), b = vec3_scale(load_on(&large), 1 / (lambda * lambda * lambda));
        apart += a.x != b.x || a.y != b.y || a.z != b.z;
    }
    ck_assert_int_ge(small.w.clock.bendings[0], steps / 100);
    if (apart == 0)
        ck_assert_int_eq(small.w.bodies.count, large.w.bodies.count);
    scene_close(&small);
    scene_close(&large);
    return apart;
}

START_TEST(melting_ice_scaled)
{
    ck_assert_int_eq(steps_apart(4, 2, 4 * 334e3, 0, 300), 0);
    ck_assert_int_gt(steps_apart(4, 2, 334e3, 0, 300), 50);
    ck_assert_int_eq(steps_apart(4, 2, 4 * 334e3, -0.5, 250), 0);
}
END_TEST

TEST_MAIN("symmetry", scaling_by_four, scaling_by_sixteen, a_hull_that_turns_slowly_scaled,
          moving_hull_equals_moving_ice, mirrored_scene, turned_scene, stations_turned_and_scaled,
          a_ship_under_way_scaled, breaking_ice_is_mirrored, a_turned_sheet_breaks_in_the_same_step, melting_ice_scaled)
