/* Free decay of vessels in heave, roll and pitch against the theory of small motions, with and without added mass. */
#include "decay.h"
#include "testing.h"

#include <stdio.h>

#define SCENE                                                                 \
    "run: {time_step: 0.01}\nice: {source: none}\ndomain: {boundary: open}\n" \
    "environment: {hull_drag: {water_form: 0, water_skin: 0, air_form: 0, air_skin: 0}}\n"

static const char box[] = "vessel: {mode: free, centre_of_gravity_z: 1, "
                          "hull: {form: box, length: 60, beam: 18, draught: 4, freeboard: 6}%s}\n";
static const char ship[] =
    "vessel: {mode: free, centre_of_gravity_z: 0, hull: {form: icebreaker, length: 200, beam: 44, draught: 12, "
    "freeboard: 10, flare_angle_deg: 0, stem_angle_deg: 60, entrance_angle_deg: 50, parallel_midbody: 0.7}%s}\n";
static const char estimate[] =
    ", hydrodynamics: {source: estimate, heave_damping: 0, roll_damping: 0, pitch_damping: 0}";

static void open_vessel(decay *d, const char *vessel, const char *more)
{
    char text[1500];
    fram_error error = {0};
    int size = snprintf(text, sizeof text, SCENE);
    snprintf(text + size, sizeof text - (size_t)size, vessel, more);
    assert_ok(decay_open(d, text, &error), error);
}

static void check_mode(const char *vessel, const char *more, int mode, double amplitude, double tolerance)
{
    decay d;
    fram_error error = {0};
    open_vessel(&d, vessel, more);
    double theory = d.period[mode], dt = d.m.time_step;
    double measured = decay_run(&d, mode, amplitude, (int)(4.2 * theory / dt), NULL, &error);
    ck_assert_msg(measured > 0, "%s", error.message);
    ck_assert_msg(fabs(measured / theory - 1) < tolerance, "mode %d%s: %.5f s, by theory %.5f s", mode, more, measured,
                  theory);
    decay_close(&d);
}

/* Walls stand upright at the waterline, so heave is exactly linear; of roll and pitch small angles are. */
START_TEST(box_periods)
{
    for (int k = 0; k < 2; k++) {
        check_mode(box, k ? estimate : "", DECAY_HEAVE, 0.05, 2e-5);
        check_mode(box, k ? estimate : "", DECAY_ROLL, 1e-3, 1e-4);
        check_mode(box, k ? estimate : "", DECAY_PITCH, 1e-3, 1e-4);
    }
}
END_TEST

START_TEST(ship_periods)
{
    for (int k = 0; k < 2; k++) {
        check_mode(ship, k ? estimate : "", DECAY_HEAVE, 0.02, 5e-4);
        check_mode(ship, k ? estimate : "", DECAY_ROLL, 1e-3, 5e-4);
        check_mode(ship, k ? estimate : "", DECAY_PITCH, 2e-4, 5e-4);
    }
}
END_TEST

static void check_file(const char *path)
{
    char vessel[200];
    snprintf(vessel, sizeof vessel,
             "vessel: {mode: free, centre_of_gravity_z: 0, hull: {form: file, file: %s, freeboard: 10}%%s}\n", path);
    for (int k = 0; k < 2; k++) {
        check_mode(vessel, k ? estimate : "", DECAY_HEAVE, 0.02, 5e-4);
        check_mode(vessel, k ? estimate : "", DECAY_ROLL, 1e-3, 5e-4);
        check_mode(vessel, k ? estimate : "", DECAY_PITCH, 2e-4, 5e-4);
    }
}

/* A hull of panels with cracks, and the FPSO of the Marine Systems Simulator where its file is there. */
#define FPSO "../shared/data/hulls/fpso_low.gdf"
START_TEST(panel_periods)
{
    check_file("tests/data/cracked_panels.gdf");
    FILE *file = fopen(FPSO, "rb");
    if (!file) {
        puts("skipped: sim/decay, " FPSO " is not there");
        return;
    }
    fclose(file);
    check_file(FPSO);
}
END_TEST

/* A given matrix, about midships with z down, is that of the estimate when it holds the same numbers. */
START_TEST(given_matrices_are_moved)
{
    decay a, b;
    open_vessel(&a, ship, estimate);
    const matrix6 *m = &a.m.vessels.data[0].hydrodynamics.added_mass;
    /* Back to the point amidships in the water line. */
    vec3 centre = a.w.vessels.centre[0];
    matrix6 about = matrix6_moved(m, centre), down = matrix6_turned_over(&about);
    char more[1200];
    int size = snprintf(more, sizeof more, ", hydrodynamics: {source: given, axes: down, added_mass: [");
    for (int i = 0; i < 6; i++)
        size +=
            snprintf(more + size, sizeof more - (size_t)size,
                     "%s{surge: %.17g, sway: %.17g, heave: %.17g, roll: %.17g, pitch: %.17g, yaw: %.17g}",
                     i ? ", " : "", down.m[i][0], down.m[i][1], down.m[i][2], down.m[i][3], down.m[i][4], down.m[i][5]);
    snprintf(more + size, sizeof more - (size_t)size, "]}");
    open_vessel(&b, ship, more);
    for (int i = 0; i < 6; i++)
        for (int j = 0; j < 6; j++)
            assert_absolute(b.m.vessels.data[0].hydrodynamics.added_mass.m[i][j], m->m[i][j],
                            1e-12 * sqrt(m->m[i][i] * m->m[j][j]) + 1e-6);
    ck_assert(b.w.bodies.added_mass[b.w.vessels.body[0]].z > 0);
    decay_close(&b);
    decay_close(&a);
}
END_TEST

/* The vessel of a shipped scene, without its ice. */
static void open_scene(decay *d, const char *path)
{
    static char text[20000];
    fram_error error = {0};
    FILE *file = fopen(path, "r");
    ck_assert_msg(file != NULL, "%s is not there", path);
    size_t size = fread(text, 1, sizeof text - 1, file);
    fclose(file);
    text[size] = 0;
    char *ice = strstr(text, "\nice:");
    ck_assert_ptr_nonnull(ice);
    snprintf(ice, sizeof text - (size_t)(ice - text), "\nice: {source: none}\ndomain: {boundary: open}\n");
    assert_ok(decay_open_as(d, path, text, &error), error);
}

/* The shipped supply ship, about amidships with z down, has the published matrices of surge, sway and yaw
   (docs/oracles.md, section 7), its own mass included. */
START_TEST(supply_ship_of_the_scene)
{
    static const double mass[3][3] = {{6.7644e6, 0, 0}, {0, 1.13412e7, -3.401568e7}, {0, -3.401568e7, 4.452378e9}};
    static const double damping[3][3] = {
        {7.707105e4, 0, 0}, {0, 2.546789e5, -2.034159e6}, {0, -6.725849e5, 3.850073e8}};
    static const int place[3] = {0, 1, 5};
    decay d;
    open_scene(&d, "scenes/supply_ship.yaml");
    vec3 arm = d.w.vessels.centre[0];
    arm.z = 0;
    matrix6 m = matrix6_moved(&d.mass, arm), c = matrix6_moved(&d.m.vessels.data[0].hydrodynamics.damping, arm);
    m = matrix6_turned_over(&m);
    c = matrix6_turned_over(&c);
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) {
            int a = place[i], b = place[j];
            double scale = sqrt(mass[i][i] * mass[j][j]), part = sqrt(damping[i][i] * damping[j][j]);
            assert_absolute(m.m[a][b], mass[i][j], 1e-4 * scale);
            assert_absolute(c.m[a][b], damping[i][j], 1e-9 * part);
        }
    }
    decay_close(&d);
}
END_TEST

START_TEST(wrong_matrices)
{
    static const struct {
        const char *more, *message, *key;
    } cases[] = {
        {", hydrodynamics: {source: given, damping: [{surge: 1}]}", "6 rows", "vessel.hydrodynamics.damping"},
        {", hydrodynamics: {source: given, added_mass: [{surge: -1}, {}, {}, {}, {}, {}]}", "negative",
         "vessel.hydrodynamics.added_mass"},
        {", hydrodynamics: {source: given, added_mass: [{surge: 1, sway: 0.5}, {sway: 1}, {}, {}, {}, {}]}",
         "symmetric", "vessel.hydrodynamics.added_mass"},
        /* Each two of them could be: all three have a motion of mass 1 - 2 x 0.9. */
        {", hydrodynamics: {source: given, added_mass: [{surge: 1, sway: 0.9, heave: -0.9}, "
         "{surge: 0.9, sway: 1, heave: 0.9}, {surge: -0.9, sway: 0.9, heave: 1}, {}, {}, {}]}",
         "in row 3 couplings", "vessel.hydrodynamics.added_mass"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        decay d;
        char text[1500];
        fram_error error = {0};
        int size = snprintf(text, sizeof text, SCENE);
        snprintf(text + size, sizeof text - (size_t)size, ship, cases[i].more);
        assert_fails(decay_open(&d, text, &error), error, FRAM_ERROR_INPUT, cases[i].message);
        ck_assert_str_eq(error.key, cases[i].key);
        scenario_free(&d.ctx, &d.s);
    }
}
END_TEST

/* Damping over the critical one: the height after a period falls by exp(-2 pi z / sqrt(1 - z^2)). */
START_TEST(estimated_damping)
{
    decay d;
    fram_error error = {0};
    open_vessel(&d, box, ", hydrodynamics: {source: estimate, heave_damping: 0.1}");
    double undamped = d.period[DECAY_HEAVE], dt = d.m.time_step;
    int steps = (int)(undamped / sqrt(1 - 0.01) / dt + 0.5);
    double *value = malloc((size_t)(steps + 1) * sizeof *value);
    decay_run(&d, DECAY_HEAVE, 0.05, steps, value, &error);
    assert_relative(value[steps] / 0.05, real_exp(-2 * PI * 0.1 / sqrt(1 - 0.01)), 0.02);
    free(value);
    decay_close(&d);
}
END_TEST

/* By hand for the box with 1.5 and 0.6 times the mass that it displaces at its draught of 4 m. */
START_TEST(damping_is_of_the_hull_as_it_floats)
{
    static const double height[2] = {1, 3.5}, part[2] = {1.5, 0.6};
    for (int i = 0; i < 2; i++) {
        char vessel[400];
        decay d;
        snprintf(vessel, sizeof vessel,
                 "vessel: {mode: free, centre_of_gravity_z: %g, mass: %.9g, "
                 "hull: {form: box, length: 60, beam: 18, draught: 4, freeboard: 6}%%s}\n",
                 height[i], part[i] * 1025 * 60 * 18 * 4);
        open_vessel(&d, vessel, ", hydrodynamics: {source: estimate, roll_damping: 0.1, pitch_damping: 0.3}");
        const hydrodynamics *h = &d.m.vessels.data[0].hydrodynamics;
        double weight = 1025 * 9.81, draught = part[i] * 4, volume = 60 * 18 * draught;
        double lift = 0.5 * draught - 4 - height[i];
        double roll = weight * (60 * 18 * 18 * 18 / 12.0 + volume * lift);
        double pitch = weight * (18 * 60 * 60 * 60 / 12.0 + volume * lift);
        assert_relative(h->damping.m[3][3], 0.2 * sqrt(roll * d.mass.m[3][3]), 1e-4);
        assert_relative(h->damping.m[4][4], 0.6 * sqrt(pitch * d.mass.m[4][4]), 1e-4);
        decay_close(&d);
    }
}
END_TEST

TEST_MAIN("decay", box_periods, ship_periods, panel_periods, given_matrices_are_moved, supply_ship_of_the_scene,
          wrong_matrices, estimated_damping, damping_is_of_the_hull_as_it_floats)
