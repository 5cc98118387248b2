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

TEST_MAIN("upright", cylinder, turned_box)
