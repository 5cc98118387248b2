/* Upright structures in breakable level ice: every face that meets it carries what crushes, whichever way it stands. */
#include "scene.h"

#include "base/transcendental.h"

/* 1 m of ice that crushes at 2 MPa drifts past a structure of 10 m, without friction. */
static const char *const PILE =
    "run: {duration: 40, time_step: 0.02}\n"
    "vessel:\n  mode: prescribed\n"
    "  hull: {form: cone, length: 10, beam: 10, draught: 5, freeboard: 3, flare_angle_deg: 0}\n"
    "ice:\n  source: level\n  thickness: 1\n  breakable: true\n  level: {x_max: -8}\n"
    "  friction: {ice_hull_static: 0, ice_hull_kinetic: 0}\n"
    "domain: {x_min: -60, x_max: 40, y_min: -40, y_max: 40, boundary: feeding, drift_speed: 0.5}\n";
static const double CRUSHING = 2e6 * 10;

static vec3 mean_load(const char *const *options, int count, int64_t before, int64_t steps)
{
    scene k;
    vec3 sum = {0, 0, 0};
    scene_open_with(&k, PILE, options, count);
    scene_steps(&k, before);
    for (int64_t i = 0; i < steps; i++) {
        scene_steps(&k, 1);
        sum = vec3_add(sum, k.w.scratch.ice_loads.data[0].total.force);
    }
    scene_close(&k);
    return vec3_scale(sum, 1.0 / (double)steps);
}

/* A cylinder that the ice has closed half round carries pressure times its width along the drift and nothing across it,
   with large tiles and small ones, whatever edges are cleaned away, and with crushed ice left where it was. */
START_TEST(cylinder)
{
    const char *const options[][1] = {{"ice.level.tile_size=auto"},
                                      {"ice.level.tile_size=200"},
                                      {"ice.edge_threshold=0.3"},
                                      {"ice.crush_trims=false"},
                                      {"ice.fracture.edge_compliance=false"}};
    for (int i = 0; i < (getenv("FRAM_TEST_SHORT") ? 2 : 5); i++) {
        vec3 load = mean_load(options[i], 1, 800, 100);
        assert_relative(load.x, CRUSHING, 1e-3);
        assert_absolute(load.y, 0, 1e-3 * CRUSHING);
        assert_absolute(load.z, 0, 1e-3 * CRUSHING);
    }
}
END_TEST

/* A box that is turned by a degree carries what it carries square to the drift; turned by 30 degrees two of its faces
   crush. */
START_TEST(turned_box)
{
    const char *const square[] = {"vessel.hull.form=box"};
    const char *const askew[] = {"vessel.hull.form=box", "vessel.heading_deg=1"};
    const char *const corner[] = {"vessel.hull.form=box", "vessel.heading_deg=30"};
    const char *const rigid[] = {"vessel.hull.form=box", "vessel.heading_deg=30", "ice.fracture.edge_compliance=false"};
    vec3 load = mean_load(square, 1, 400, 100), turned = mean_load(askew, 2, 400, 100);
    assert_relative(load.x, CRUSHING, 1e-3);
    assert_relative(vec3_length(turned), CRUSHING, 0.02);
    load = mean_load(corner, 2, 700, 100);
    turned = mean_load(rigid, 3, 700, 100);
    ck_assert(load.x > 1.2 * CRUSHING);
    assert_relative(load.x, turned.x, 1e-9);
    assert_absolute(load.y, turned.y, 1e-9 * CRUSHING);
}
END_TEST

/* A face of 40 m carries the same while rows of tiles pass it: what the hull has come through leaves nothing in it. */
START_TEST(wide_face)
{
    const char *const options[] = {"vessel.hull.form=box", "vessel.hull.beam=40", "ice.level.tile_size=8",
                                   "domain.drift_speed=1"};
    scene k;
    scene_open_with(&k, PILE, options, 4);
    scene_steps(&k, 200);
    for (int i = 0; i < 900; i++) {
        scene_steps(&k, 1);
        vec3 load = k.w.scratch.ice_loads.data[0].total.force;
        assert_relative(load.x, 4 * CRUSHING, 1e-9);
        assert_absolute(load.y, 0, 1e-6 * CRUSHING);
    }
    ck_assert_double_gt(k.w.clock.ice_crushed[0], 0.9 * 920 * 40 * 18);
    scene_close(&k);
}
END_TEST

/* Friction holds the ice on a face that leans by a tenth of a degree, and breaks none: the load is that without. */
START_TEST(friction_breaks_nothing)
{
    const char *const options[] = {"vessel.hull.flare_angle_deg=0.1", "ice.friction.ice_hull_static=0.3",
                                   "ice.friction.ice_hull_kinetic=0.3"};
    scene k;
    scene_open_with(&k, PILE, options, 3);
    for (int i = 0; i < 900; i++) {
        scene_steps(&k, 1);
        ck_assert_int_eq(k.w.scratch.fractures.count, 0);
    }
    ck_assert_double_gt(k.w.scratch.ice_loads.data[0].total.force.x, 0.95 * CRUSHING);
    scene_close(&k);
}
END_TEST

/* A floe of 500 m that is pressed on the end of a box splits when the push in its plane has reached what opens a crack
   at its mouth, 0.1869 h K_IC sqrt(L) (docs/oracles.md, section 3), although nothing bends it. */
START_TEST(a_large_floe_splits_on_a_box)
{
    static const char *const SCENE =
        "run: {duration: 3}\n"
        "vessel: {mode: prescribed, x: -10.03, speed: 0.05, hull: {form: box, length: 20, beam: 4, draught: 5}}\n"
        "ice:\n  source: floes\n  thickness: 1\n  breakable: true\n  fracture: {splitting: toughness}\n"
        "  floes: [{length: 500, width: 500, x: 250, yaw_deg: 0.5}]\n"
        "domain: {x_min: -60, x_max: 600, y_min: -280, y_max: 280, boundary: open}\n";
    double needed = 0.1869 * 150e3 * sqrt(500.0);
    for (int turn = 0; turn < 4; turn++) {
        bool fixed = turn % 2, fine = turn >= 2;
        const char *const options[] = {fixed ? "ice.floes[0].fixed=true" : "ice.floes[0].fixed=false",
                                       fine ? "run.time_step=0.0005" : "run.time_step=0.001"};
        scene k;
        scene_open_with(&k, SCENE, options, 2);
        double before = 0;
        for (int i = 0; i < 4000 && k.w.scratch.fractures.count == 0; i++) {
            before = k.w.scratch.ice_loads.count > 0 ? -k.w.scratch.ice_loads.data[0].total.force.x : 0;
            scene_steps(&k, 1);
        }
        ck_assert_int_eq(k.w.scratch.fractures.count, 1);
        const fracture_event *e = &k.w.scratch.fractures.data[0];
        ck_assert_int_eq(e->pieces, 2);
        assert_relative(e->crack_length, 500, 1e-3);
        /* What floats breaks by its load over the time in which it responds. */
        if (fixed)
            ck_assert_double_lt(before, 1.002 * needed);
        assert_relative(e->load, needed, fine ? 0.015 : 0.03); /* grows by 1 and 2 % in a step */
        scene_close(&k);
    }
}
END_TEST

TEST_MAIN("upright", cylinder, turned_box, wide_face, friction_breaks_nothing, a_large_floe_splits_on_a_box)
