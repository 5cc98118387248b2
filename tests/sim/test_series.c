/* Channels as recorded: each column holds what its name says, from tables that are filled by hand. */
#include "scene.h"

#include <stdio.h>

static const char moored[] =
    "run: {duration: 1, time_step: 0.1}\n"
    "vessel:\n  mode: free\n  hull: {length: 48, beam: 12, draught: 4, freeboard: 2}\n"
    "  mooring: {depth: 60, lines: [{count: 2, spacing_deg: 180, distance: 300, pretension: 2.0e5}]}\n"
    "  thrusters: [{x: 18, thrust: 1.0e5, power: 4.0e5}, {x: -18, thrust: 1.0e5, power: 4.0e5}]\n"
    "  positioning: {active: true}\n"
    "ice: {source: voronoi, concentration: 0.5, mean_floe_area: 200}\n"
    "domain: {x_min: -80, x_max: 80, y_min: -60, y_max: 60, boundary: feeding}\n";

static void assert_channels(const scene_row *r, const char *name, vec3 expected)
{
    const double v[3] = {expected.x, expected.y, expected.z};
    for (int i = 0; i < 3; i++) {
        char full[64];
        snprintf(full, sizeof full, "%s_%c", name, "xyz"[i]);
        ck_assert_msg(scene_channel(r, full) == v[i], "%s is %.17g, expected %.17g", full, scene_channel(r, full),
                      v[i]);
    }
}

START_TEST(station_as_recorded)
{
    scene k;
    scene_row r = {0};
    scene_open(&k, moored);
    station_table *s = &k.w.stations;
    s->mooring_load[0] = (wrench){{1, 2, 3}, {4, 5, 6}};
    s->thruster_load[0] = (wrench){{7, 8, 9}, {10, 11, 12}};
    s->demand[0] = vec3_make(13, 14, 15);
    s->estimate[0].bias = vec3_make(16, 17, 18);
    /* Of the end of the step, wherever the vessel was at its begin. */
    int32_t body = k.w.vessels.body[0];
    s->offset[0] = vec3_make(1, 2, 3);
    k.w.bodies.position[body] = vec3_add(k.w.bodies.position[body], vec3_make(19, 20, 0));
    scene_take(&k, &r);
    assert_channels(&r, "mooring_force", vec3_make(1, 2, 3));
    assert_channels(&r, "mooring_moment", vec3_make(4, 5, 6));
    assert_channels(&r, "thruster_force", vec3_make(7, 8, 9));
    assert_channels(&r, "thruster_moment", vec3_make(10, 11, 12));
    assert_channels(&r, "demanded_force", vec3_make(13, 14, 15));
    assert_channels(&r, "estimated_load", vec3_make(15, 15, 12)); /* without the lines */
    assert_absolute(scene_channel(&r, "offset_x"), 19, 1e-9);
    assert_absolute(scene_channel(&r, "offset_y"), 20, 1e-9);
    double yaw = quat_roll_pitch_yaw(k.w.bodies.orientation[body]).z;
    k.w.bodies.orientation[body] = quat_from_roll_pitch_yaw(0, 0, yaw + radians(21));
    scene_take(&k, &r);
    assert_absolute(scene_channel(&r, "heading_deviation"), 21, 1e-9);
    series_layout_free(&k.ctx, &r.layout);
    scene_close(&k);
}
END_TEST

/* The load of all lines as recorded is about the centre of mass, as the sum of the single lines is. */
START_TEST(mooring_moments_are_about_the_centre_of_mass)
{
    scene k;
    scene_row r = {0};
    scene_open(&k, moored);
    int32_t body = k.w.vessels.body[0];
    vec3 at = k.w.bodies.position[body];
    k.w.bodies.position[body] = vec3_make(at.x + 3, at.y - 5, at.z);
    k.w.bodies.orientation[body] = quat_from_roll_pitch_yaw(0.05, -0.02, 0.4);
    wrench expected = mooring_pull(&k.w.lines, 0, k.w.bodies.position[body], k.w.bodies.orientation[body]);
    scene_steps(&k, 1);
    scene_take(&k, &r);
    ck_assert(fabs(expected.moment.z) > 1e4);
    const double scale = vec3_length(expected.force) * 24;
    assert_absolute(scene_channel(&r, "mooring_force_x"), expected.force.x, 1e-9 * scale);
    assert_absolute(scene_channel(&r, "mooring_moment_x"), expected.moment.x, 1e-9 * scale);
    assert_absolute(scene_channel(&r, "mooring_moment_y"), expected.moment.y, 1e-9 * scale);
    assert_absolute(scene_channel(&r, "mooring_moment_z"), expected.moment.z, 1e-9 * scale);
    series_layout_free(&k.ctx, &r.layout);
    scene_close(&k);
}
END_TEST

START_TEST(counts_as_recorded)
{
    scene k;
    scene_row r = {0};
    scene_open(&k, moored);
    k.w.lines.tension[0] = 700;
    k.w.lines.tension[1] = 500;
    k.w.lines.broken[1] = 1;
    k.w.thrusters.failed[0] = 1;
    k.w.thrusters.thrust[0] = k.w.thrusters.thrust[1] = 1e5;
    k.w.feeding.entered[0] = 11;
    k.w.feeding.held_back[0] = 12;
    k.w.feeding.velocity[0] = vec2_make(13, 14);
    k.w.scratch.solver = (solver_report){.residual = 0.5, .mean_depth = 0.25, .max_depth = 0.75, .iterations = 17};
    scene_take(&k, &r);
    ck_assert(scene_channel(&r, "solver_residual") == 0.5 && scene_channel(&r, "solver_iterations") == 17);
    ck_assert(scene_channel(&r, "overlap_mean") == 0.25 && scene_channel(&r, "overlap_max") == 0.75);
    ck_assert(scene_channel(&r, "line_tension_max") == 700 && scene_channel(&r, "lines_parted") == 1);
    ck_assert(scene_channel(&r, "thrusters_failed") == 1);
    assert_relative(scene_channel(&r, "thruster_power"), 4e5, 1e-12);
    ck_assert(scene_channel(&r, "ice_mass_entered") == 11 && scene_channel(&r, "ice_mass_held_back") == 12);
    ck_assert(scene_channel(&r, "drift_x") == 13 && scene_channel(&r, "drift_y") == 14);
    double bodies = scene_channel(&r, "bodies"), floes = scene_channel(&r, "floes");
    floe_remove(&k.w.bodies, &k.w.shapes, &k.w.floes, 2);
    scene_take(&k, &r);
    ck_assert(scene_channel(&r, "bodies") == bodies - 1 && scene_channel(&r, "floes") == floes - 1);
    series_layout_free(&k.ctx, &r.layout);
    scene_close(&k);
}
END_TEST

/* Loads in the vessel's axes: a hull that heads along Y feels a push along Y from behind. */
START_TEST(loads_in_the_vessels_axes)
{
    scene k;
    scene_row r = {0};
    scene_open(&k, moored);
    int32_t body = k.w.vessels.body[0];
    k.w.bodies.orientation[body] = quat_from_roll_pitch_yaw(0, 0, PI / 2);
    ck_assert(array_resize(&k.ctx, &k.w.scratch.ice_loads, 1));
    k.w.scratch.ice_loads.data[0] = (ice_load){.total = {{0, 500, 0}, {0, 300, 40}}};
    ck_assert(array_resize(&k.ctx, &k.w.scratch.fluid, 1));
    k.w.scratch.fluid.data[0] = (fluid_load){.hydrostatic = {{0, 0, 100}, {0, 0, 0}},
                                             .water_drag = {{0, 20, 0}, {0, 0, 0}},
                                             .wind_drag = {{3, 0, 0}, {0, 0, 4}}};
    scene_take(&k, &r);
    assert_absolute(scene_channel(&r, "ice_force_body_x"), 500, 1e-9);
    assert_absolute(scene_channel(&r, "ice_force_body_y"), 0, 1e-9);
    assert_absolute(scene_channel(&r, "ice_moment_body_x"), 300, 1e-9);
    assert_absolute(scene_channel(&r, "ice_moment_body_z"), 40, 1e-9);
    assert_channels(&r, "fluid_force", vec3_make(3, 20, 100));
    assert_channels(&r, "fluid_moment", vec3_make(0, 0, 4));
    series_layout_free(&k.ctx, &r.layout);
    scene_close(&k);
}
END_TEST

static vec3 counted(double *next)
{
    *next += 3;
    return vec3_make(*next - 2, *next - 1, *next);
}

static void assert_channel(const scene_row *r, const char *name, double expected)
{
    ck_assert_msg(scene_channel(r, name) == expected, "%s is %.17g, expected %.17g", name, scene_channel(r, name),
                  expected);
}

/* Each part of the ice load is another number, in the order of the columns. */
START_TEST(parts_of_the_ice_load)
{
    static const char *const mechanisms[] = {"splitting",    "bending",    "crushing", "chain",
                                             "accumulation", "submersion", "impact",   "friction"};
    static const char *const zones[] = {[ZONE_BOW] = "bow",
                                        [ZONE_SHOULDER] = "shoulder",
                                        [ZONE_MIDBODY] = "midbody",
                                        [ZONE_STERN] = "stern",
                                        [ZONE_BOTTOM] = "bottom"};
    scene k;
    scene_row r = {0};
    char name[80];
    double next = 0, again = 0;
    scene_open(&k, moored);
    ck_assert(array_resize(&k.ctx, &k.w.scratch.ice_loads, 1));
    ice_load *load = &k.w.scratch.ice_loads.data[0];
    *load = (ice_load){.contacts = 5};
    load->capped.force = counted(&next);
    load->below_cap.force = counted(&next);
    load->friction.force = counted(&next);
    load->hulls.force = counted(&next);
    load->hulls.moment = counted(&next);
    for (size_t z = 0; z < sizeof zones / sizeof *zones; z++)
        load->zone[z].force = counted(&next);
    for (int m = 0; m < MECHANISM_COUNT; m++) {
        load->mechanism[m].force = counted(&next);
        load->mechanism[m].moment = counted(&next);
    }
    scene_take(&k, &r);
    assert_channel(&r, "vessel_contacts", 5);
    assert_channels(&r, "ice_force_capped", counted(&again));
    assert_channels(&r, "ice_force_below_cap", counted(&again));
    assert_channels(&r, "ice_force_friction", counted(&again));
    assert_channels(&r, "hull_contact_force", counted(&again));
    assert_channels(&r, "hull_contact_moment", counted(&again));
    for (size_t z = 0; z < sizeof zones / sizeof *zones; z++) {
        snprintf(name, sizeof name, "ice_force_%s", zones[z]);
        assert_channels(&r, name, counted(&again));
    }
    for (int m = 0; m < MECHANISM_COUNT; m++) {
        snprintf(name, sizeof name, "mechanism_%s", mechanisms[m]);
        assert_channels(&r, name, counted(&again));
        snprintf(name, sizeof name, "mechanism_%s_moment", mechanisms[m]);
        assert_channels(&r, name, counted(&again));
    }
    ck_assert(next == again);
    series_layout_free(&k.ctx, &r.layout);
    scene_close(&k);
}
END_TEST

/* A ship that drives itself beside a sheet that drifts: what each of them has a column of. */
START_TEST(propulsion_drift_and_books)
{
    scene k;
    scene_row r = {0};
    scene_open(&k, moored);
    world *w = &k.w;
    ck_assert(table_resize(&k.ctx, &w->propulsion, &propulsion_table_info, 1) &&
              table_resize(&k.ctx, &w->drift, &drift_table_info, 1));
    w->propulsion.vessel[0] = 0;
    w->propulsion.thrust[0] = 1;
    w->propulsion.steering[0] = radians(20);
    w->propulsion.besets[0] = 3;
    w->propulsion.rams[0] = 4;
    w->propulsion.rounds[0] = 5;
    w->propulsion.off[0] = 6;
    w->drift.entered[0] = 7;
    w->drift.velocity[0] = vec2_make(8, 9);
    w->drift.load[0] = vec2_make(10, 11);
    w->drift.drive[0] = vec2_make(12, 13);
    w->stations.estimate[0].place = vec3_make(14, 15, radians(16));
    ck_assert(array_resize(&k.ctx, &w->scratch.responses, 1) && array_resize(&k.ctx, &w->scratch.wash_force, 1));
    w->scratch.responses.data[0].force = vec3_make(17, 18, 19);
    w->scratch.wash_force.data[0] = vec3_make(20, 21, 22);
    ck_assert(table_resize(&k.ctx, &w->joints, &joint_table_info, 1));
    w->vessels.joint[0] = 0;
    w->joints.reaction_force[0] = vec3_make(41, 42, 43);
    w->joints.reaction_moment[0] = vec3_make(44, 45, 46);
    w->bodies.velocity[w->vessels.body[0]] = vec3_make(47, 48, 49);
    w->bodies.angular_velocity[w->vessels.body[0]] = vec3_make(50, 51, 52);
    double *const books[] = {w->clock.ice_left,    w->clock.ice_lost,   w->clock.ice_gained,
                             w->clock.ice_crushed, w->clock.brash_mass, w->clock.work_crushed};
    for (int i = 0; i < 6; i++)
        *books[i] = 30 + i;
    w->clock.brash_momentum[0] = vec3_make(36, 37, 38);
    w->clock.splits[0] = 39;
    w->clock.bendings[0] = 40;
    scene_take(&k, &r);
    static const struct {
        const char *name;
        double value;
    } told[] = {{"net_thrust", 1},
                {"besets", 3},
                {"rams", 4},
                {"pattern_rounds", 5},
                {"track_error", 6},
                {"drift_x", 8},
                {"drift_y", 9},
                {"ice_mass_entered", 7},
                {"sheet_load_x", 10},
                {"sheet_load_y", 11},
                {"sheet_drive_x", 12},
                {"sheet_drive_y", 13},
                {"estimated_x", 14},
                {"estimated_y", 15},
                {"wash_force_x", 20},
                {"wash_force_y", 21},
                {"ice_mass_left", 30},
                {"ice_mass_lost", 31},
                {"ice_mass_gained", 32},
                {"ice_mass_crushed", 33},
                {"brash_mass", 34},
                {"crushing_work", 35},
                {"splits", 39},
                {"bendings", 40}};
    for (size_t i = 0; i < sizeof told / sizeof *told; i++)
        assert_channel(&r, told[i].name, told[i].value);
    assert_absolute(scene_channel(&r, "steering_angle"), 20, 1e-12);
    assert_absolute(scene_channel(&r, "estimated_heading"), 16, 1e-12);
    assert_channels(&r, "hydrodynamic_force", vec3_make(17, 18, 19));
    assert_channels(&r, "brash_momentum", vec3_make(36, 37, 38));
    assert_channels(&r, "tow_force", vec3_make(41, 42, 43));
    assert_channels(&r, "tow_moment", vec3_make(44, 45, 46));
    assert_channels(&r, "velocity", vec3_make(47, 48, 49));
    assert_channels(&r, "angular_velocity", vec3_make(50, 51, 52));
    series_layout_free(&k.ctx, &r.layout);
    scene_close(&k);
}
END_TEST

/* fractures.csv, column by column. */
START_TEST(breaks_as_recorded)
{
    const fracture_event e = {.kind = 2,
                              .floe = 3,
                              .pieces = 4,
                              .first_piece = 5,
                              .place = {6, 7, 8},
                              .load = 9,
                              .crack_length = 10,
                              .loaded_radius = 11,
                              .stress_ratio = 12,
                              .parent_area = 13,
                              .piece_area = 14,
                              .area_lost = 15,
                              .area_gained = 16,
                              .mass_lost = 17,
                              .mass_gained = 18,
                              .momentum_lost = {19, 20, 21},
                              .angular_momentum_lost = {22, 23, 24}};
    static const char *const names[] = {"time",
                                        "kind",
                                        "floe",
                                        "pieces",
                                        "first_piece",
                                        "place_x",
                                        "place_y",
                                        "place_z",
                                        "load",
                                        "crack_length",
                                        "loaded_radius",
                                        "stress_over_strength",
                                        "floe_area",
                                        "pieces_area",
                                        "area_lost",
                                        "area_gained",
                                        "mass_lost",
                                        "mass_gained",
                                        "momentum_lost_x",
                                        "momentum_lost_y",
                                        "momentum_lost_z",
                                        "angular_momentum_lost_x",
                                        "angular_momentum_lost_y",
                                        "angular_momentum_lost_z"};
    int32_t count;
    const csv_column *columns = fracture_columns(&count);
    double value[FRACTURE_ROOM];
    ck_assert_int_eq(count, 24);
    fracture_row(1, &e, value);
    for (int i = 0; i < 24; i++) {
        ck_assert_str_eq(columns[i].name, names[i]);
        ck_assert_double_eq(value[i], i + 1);
    }
}
END_TEST

TEST_MAIN("series", station_as_recorded, mooring_moments_are_about_the_centre_of_mass, counts_as_recorded,
          loads_in_the_vessels_axes, parts_of_the_ice_load, propulsion_drift_and_books, breaks_as_recorded)
