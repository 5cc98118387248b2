/* model/scenario and its schema: defaults, scaling, names, places, rules. */
#include "model/scenario_schema.h"
#include "testing.h"
#include <stdio.h>

static fram_error error;

static void set_text(char *out, size_t size, const char *text) { snprintf(out, size, "%s", text); }

/* A default scenario, which passes all checks. */
static scenario good(void)
{
    scenario s;
    scenario_defaults(&s, scenario_default_scale());
    return s;
}

/* A floe with every key at its default. */
static scenario_floe a_floe(void)
{
    const scenario_section *ice = scenario_schema.keys[section_find(&scenario_schema, "ice")].section;
    scenario_floe floe = {0};
    section_defaults(ice->keys[section_find(ice, "floes")].section, &floe, 30);
    return floe;
}

START_TEST(defaults_pass_their_own_checks)
{
    const scenario_section *run = scenario_schema.keys[section_find(&scenario_schema, "run")].section;
    const scenario_key *scale = &run->keys[section_find(run, "scale")];
    const double scales[] = {scale->lo, 1, 30, 100, scale->hi};
    for (size_t i = 0; i < sizeof scales / sizeof *scales; i++) {
        scenario s;
        scenario_defaults(&s, scales[i]);
        assert_ok(scenario_check(&s, &error), error);
        assert_bits(s.run.scale, scales[i]);
    }
}
END_TEST

/* The paper's thresholds are tank lengths, areas go with the square of the scale. */
START_TEST(thresholds_follow_the_scale)
{
    scenario tank, full;
    scenario_defaults(&tank, 1);
    scenario_defaults(&full, 30);
    assert_bits(tank.ice.smallest_floe_area, 2e-4);
    assert_bits(tank.ice.smallest_piece_area, 1e-5);
    assert_bits(tank.ice.edge_threshold, 5e-3);
    assert_relative(full.ice.smallest_floe_area, 2e-4 * 900, 1e-15);
    assert_relative(full.ice.smallest_piece_area, 1e-5 * 900, 1e-15);
    assert_relative(full.ice.edge_threshold, 5e-3 * 30, 1e-15);
    assert_bits(full.output.averaging_window, 0.5);
    assert_relative(tank.output.averaging_window, 0.5 / sqrt(30), 1e-15);
    assert_bits(tank.ice.thickness, full.ice.thickness);
}
END_TEST

/* As asked where it is whole steps within rounding (0.3 is 3 of 0.1 s), else what they make; a step at least, and not
   more than a million. */
START_TEST(loads_are_averaged_over_whole_steps)
{
    static const struct {
        double step, asked, window;
        int64_t steps;
    } c[] = {{0.1, 0.3, 0.3, 3},  {0.02, 0.5, 0.5, 25}, {0.1, 0.25, 3 * 0.1, 3}, {0.1, 0, 0.1, 1},
             {0.1, 0.04, 0.1, 1}, {0.5, 0.7, 0.5, 1},   {0.2, 0.75, 0.8, 4},     {0.01, 1e5, 1e4, 1000000}};
    scenario s = good();
    for (size_t i = 0; i < sizeof c / sizeof *c; i++) {
        s.run.time_step = c[i].step;
        s.output.averaging_window = c[i].asked;
        ck_assert_int_eq(scenario_averaging_steps(&s), c[i].steps);
        assert_bits(scenario_averaging_window(&s), c[i].window);
    }
}
END_TEST

/* A window of 6 s has nothing of what was before the start from 6 s on, and little matters beside more than 60 s. */
START_TEST(averages_tell_of_the_time_before_the_start)
{
    scenario s = good();
    s.run.time_step = 0.1;
    s.output.averaging_window = 6;
    ck_assert(scenario_averages_begin_early(&s, 5.9, 59));
    ck_assert(!scenario_averages_begin_early(&s, 60 * 0.1, 59));
    ck_assert(!scenario_averages_begin_early(&s, 0.1, 61));
}
END_TEST

START_TEST(defaults_of_the_specification)
{
    scenario s = good();
    assert_bits(s.run.solver.correction_rate, 0.8);
    assert_bits(s.ice.friction.ice_hull_static, 0.1);
    assert_bits(s.ice.friction.ice_hull_kinetic, 0.1);
    assert_bits(s.ice.friction.ice_ice_static, 0.3);
    assert_bits(s.ice.friction.ice_ice_kinetic, 0.3);
    assert_bits(s.environment.ice_drag.water_form, 1.0);
    assert_bits(s.ice.crushing_exponent, 0.0);
    ck_assert_int_eq(s.run.solver.baumgarte, false);
    ck_assert_int_eq(s.run.solver.kind, SOLVER_FAST);
    ck_assert(is_automatic(s.vessel.mass));
    assert_bits(automatic_or(s.vessel.mass, 7), 7.0);
    assert_bits(automatic_or(3, 7), 3.0);
}
END_TEST

static int32_t section_keys(const scenario_section *section)
{
    int32_t count = 0;
    for (int32_t k = 0; k < section->key_count; k++)
        count += section->keys[k].section ? section_keys(section->keys[k].section) : 1;
    return count;
}

/* Every key has what a person needs to know, and a default inside its range. */
static void inspect_section(const scenario_section *section)
{
    for (int32_t k = 0; k < section->key_count; k++) {
        const scenario_key *key = &section->keys[k];
        ck_assert_msg(strlen(key->meaning) >= 4, "%s has no meaning", key->name);
        ck_assert_int_eq(section_find(section, key->name), k);
        ck_assert_str_eq(section_nearest(section, key->name), key->name);
        bool degrees_name = strlen(key->name) > 4 && strcmp(key->name + strlen(key->name) - 4, "_deg") == 0;
        ck_assert_msg(degrees_name == (strncmp(key->unit, "deg", 3) == 0), "%s [%s]", key->name, key->unit);
        if (key->kind == KEY_REAL || key->kind == KEY_INTEGER) {
            ck_assert_msg(*key->unit != '\0', "%s has no unit", key->name);
            ck_assert_msg(key->automatic || (key->value >= key->lo && key->value <= key->hi), "%s", key->name);
        }
        if (key->kind == KEY_CHOICE) {
            size_t size;
            ck_assert(choice_name(key, (int32_t)key->value, &size) != NULL);
            ck_assert(choice_name(key, 99, &size) == NULL);
            ck_assert(choice_name(key, -1, &size) == NULL);
            ck_assert_int_eq(choice_find(key, "no such name"), -1);
            ck_assert_int_eq(choice_find(key, ""), -1);
        }
        if (key->section)
            inspect_section(key->section);
    }
}

START_TEST(every_row_is_complete)
{
    inspect_section(&scenario_schema);
    ck_assert_int_gt(section_keys(&scenario_schema), 100);
}
END_TEST

START_TEST(choices_go_by_name)
{
    const scenario_section *vessel = scenario_schema.keys[section_find(&scenario_schema, "vessel")].section;
    const scenario_key *mode = &vessel->keys[section_find(vessel, "mode")];
    size_t size;
    ck_assert_int_eq(choice_find(mode, "prescribed"), VESSEL_PRESCRIBED);
    ck_assert_int_eq(choice_find(mode, "towed"), VESSEL_TOWED);
    ck_assert_int_eq(choice_find(mode, "free"), VESSEL_FREE);
    ck_assert_int_eq(choice_find(mode, "tow"), -1);
    ck_assert_str_eq(choice_name(mode, VESSEL_FREE, &size), "free");
    ck_assert_uint_eq(size, 4);
}
END_TEST

START_TEST(misspelt_names_find_their_neighbour)
{
    const scenario_section *ice = scenario_schema.keys[section_find(&scenario_schema, "ice")].section;
    const scenario_section *domain = scenario_schema.keys[section_find(&scenario_schema, "domain")].section;
    ck_assert_str_eq(section_nearest(ice, "thicknes"), "thickness");
    ck_assert_str_eq(section_nearest(ice, "thcikness"), "thickness");
    ck_assert_str_eq(section_nearest(ice, "Density"), "density");
    ck_assert_ptr_null(section_nearest(ice, "propeller"));
    ck_assert_ptr_null(section_nearest(ice, ""));
    ck_assert_ptr_null(section_nearest(ice, "_"));
    ck_assert_str_eq(section_nearest(domain, "x"), "x_min");
    ck_assert_str_eq(section_nearest(domain, "drift"), "drift_speed");
    ck_assert_ptr_null(section_nearest(domain, "dri"));
    ck_assert_ptr_null(section_nearest(ice, "a_name_that_is_much_longer_than_any_key_can_ever_be"));
    ck_assert_int_eq(section_find(ice, "thicknes"), -1);
}
END_TEST

static int visits;
static fram_status count_visit(void *user, const scenario_key *key, const void *member, const char *path, fram_error *e)
{
    (void)member;
    (void)e;
    ck_assert(key->kind != KEY_SECTION);
    visits++;
    return user && strcmp(path, user) == 0 ? FRAM_ERROR_INTERNAL : FRAM_OK;
}

START_TEST(walking_meets_every_key_once)
{
    context ctx;
    context_init(&ctx);
    scenario s = good();
    visits = 0;
    assert_ok(scenario_walk(&s, count_visit, NULL, &error), error);
    int without = visits;
    scenario_floe floe = a_floe();
    ck_assert(array_push(&ctx, &s.ice.floes, floe) && array_push(&ctx, &s.ice.floes, floe));
    visits = 0;
    assert_ok(scenario_walk(&s, count_visit, NULL, &error), error);
    const scenario_key *ice = &scenario_schema.keys[section_find(&scenario_schema, "ice")];
    const scenario_key *floes = &ice->section->keys[section_find(ice->section, "floes")];
    ck_assert_int_eq(visits, without + 2 * section_keys(floes->section));
    ck_assert_int_eq(scenario_walk(&s, count_visit, "ice.floes[1].yaw_deg", &error), FRAM_ERROR_INTERNAL);
    s.ice.source = ICE_FLOES;
    while (s.ice.floes.count < 1000)
        ck_assert(array_push(&ctx, &s.ice.floes, floe));
    assert_ok(scenario_check(&s, &error), error);
    ck_assert(array_push(&ctx, &s.ice.floes, floe));
    assert_fails(scenario_check(&s, &error), error, FRAM_ERROR_INPUT, "expected at most 1000 items, found 1001");
    ck_assert_str_eq(error.key, "ice.floes");
    scenario_free(&ctx, &s);
    ck_assert_int_eq(s.ice.floes.count, 0);
}
END_TEST

/* Ice goes with the current, but for an endless field that is told its own drift. */
START_TEST(ice_has_one_drift)
{
    static const struct {
        domain_boundary boundary;
        double own_speed, speed, towards;
        const char *own_file, *file;
        bool fed, own;
    } c[] = {
        {DOMAIN_OPEN, (double)NAN, 0.4, 20, "", "", false, false},
        {DOMAIN_FEEDING, (double)NAN, 0.4, 20, "", "", true, false},
        {DOMAIN_FEEDING, 0.3, 0.3, 90, "", "", true, true},
        {DOMAIN_FEEDING, 0, 0, 90, "", "", true, true},
        {DOMAIN_FEEDING, (double)NAN, 0, 90, "drift.csv", "drift.csv", true, true},
    };
    scenario s = good();
    s.environment.current_speed = 0.4;
    s.environment.current_direction_deg = 20;
    s.domain.drift_direction_deg = 90;
    for (size_t i = 0; i < sizeof c / sizeof *c; i++) {
        s.domain.boundary = c[i].boundary;
        s.domain.drift_speed = c[i].own_speed;
        set_text(s.domain.drift_file, sizeof s.domain.drift_file, c[i].own_file);
        ice_drift d = scenario_drift(&s);
        ck_assert(d.fed == c[i].fed && d.own == c[i].own);
        ck_assert_str_eq(d.file, c[i].file);
        assert_bits(d.speed, c[i].speed);
        assert_bits(d.towards_deg, c[i].towards);
    }
    set_text(s.environment.current_file, sizeof s.environment.current_file, "current.csv");
    s.domain.drift_file[0] = '\0';
    s.domain.drift_speed = 0.3;
    ck_assert_str_eq(scenario_drift(&s).file, "");
    s.domain.drift_speed = (double)NAN;
    ck_assert_str_eq(scenario_drift(&s).file, "current.csv");
    s.domain.drift_speed = 0.3;
    s.ice.source = ICE_NONE;
    ck_assert(!scenario_drift(&s).fed && !scenario_drift(&s).own);
    box2 box = domain_box(&s.domain);
    ck_assert(box.lo.x == s.domain.x_min && box.lo.y == s.domain.y_min);
    ck_assert(box.hi.x == s.domain.x_max && box.hi.y == s.domain.y_max);
}
END_TEST

/* ---- rules ---- */

#define REFUSED(change, bad_key, part)                                           \
    do {                                                                         \
        scenario s = good();                                                     \
        change;                                                                  \
        assert_fails(scenario_check(&s, &error), error, FRAM_ERROR_INPUT, part); \
        ck_assert_str_eq(error.key, bad_key);                                    \
    } while (0)

START_TEST(ranges_are_checked)
{
    REFUSED(s.ice.thickness = 0, "ice.thickness", "expected a number from 1e-06 to 100 m, found 0");
    REFUSED(s.ice.thickness = (double)NAN, "ice.thickness", "found nan");
    REFUSED(s.ice.thickness = (double)INFINITY, "ice.thickness", "found inf");
    REFUSED(s.vessel.mass = -1, "vessel.mass", "auto or a number");
    REFUSED(s.run.seed = -1, "run.seed", "an integer from 0");
    REFUSED(choice_set(&s.vessel.mode, 3), "vessel.mode", "one of prescribed towed free");
}
END_TEST

START_TEST(keys_must_go_together)
{
    REFUSED(s.run.time_step = 2; s.run.duration = 1, "run.time_step", "run.duration, which is 1");
    REFUSED(s.run.transient = 61, "run.transient", "run.duration");
    REFUSED(s.domain.x_min = 400, "domain.x_min", "domain.x_max");
    REFUSED(s.domain.y_min = s.domain.y_max, "domain.y_max", "same value");
    REFUSED(s.domain.x_min = s.domain.x_max, "domain.x_max", "same value");
    REFUSED(s.domain.y_min = 101, "domain.y_min", "domain.y_max");
    REFUSED(s.vessel.hull.form = HULL_MESH, "vessel.hull.file", "path of a mesh");
    REFUSED(set_text(s.vessel.hull.file, sizeof s.vessel.hull.file, "a.stl"), "vessel.hull.file", "a.stl");
    REFUSED(s.vessel.y = 101, "vessel.x", "inside the walls");
    REFUSED(s.ice.source = ICE_FLOES, "ice.floes", "at least one");
    REFUSED(s.ice.friction.ice_wall_kinetic = 0.4, "ice.friction.ice_wall_kinetic", "ice_wall_static");
    REFUSED(s.ice.friction.ice_ice_kinetic = 0.4, "ice.friction.ice_ice_kinetic", "ice_ice_static");
    REFUSED(s.ice.friction.ice_hull_kinetic = 0.4, "ice.friction.ice_hull_kinetic", "ice_hull_static");
    REFUSED(s.domain.boundary = DOMAIN_FEEDING; s.ice.source = ICE_NONE, "ice.source", "without end");
    REFUSED(s.domain.boundary = DOMAIN_FEEDING; s.ice.source = ICE_FLOES, "ice.source", "without end");
    REFUSED(s.ice.density = 1025, "ice.density", "floats");
    REFUSED(s.ice.concentration = 1, "ice.concentration", "expected less than 1");
    REFUSED(s.ice.mean_floe_area = 1e5, "ice.mean_floe_area", "80000");
    REFUSED(s.ice.smallest_floe_area = 500, "ice.smallest_floe_area", "ice.mean_floe_area");
}
END_TEST

/* The section of a list of the vessel, by the names on the way to it. */
static const scenario_section *vessel_section(const char *const *names, int count)
{
    const scenario_section *at = scenario_schema.keys[section_find(&scenario_schema, "vessel")].section;
    for (int i = 0; i < count; i++)
        at = at->keys[section_find(at, names[i])].section;
    return at;
}

/* What keeps a free vessel in place: positioning asks for thrusters, a line of a table for one table. */
START_TEST(stations_are_whole)
{
    context ctx;
    context_init(&ctx);
    scenario s = good();
    choice_set(&s.vessel.mode, VESSEL_FREE);
    s.vessel.positioning.active = true;
    assert_fails(scenario_check(&s, &error), error, FRAM_ERROR_INPUT, "expected thrusters");
    ck_assert_str_eq(error.key, "vessel.thrusters");
    scenario_thruster thruster;
    static const char *const thrusters[] = {"thrusters"}, *const table[] = {"mooring", "lines", "table"};
    section_defaults(vessel_section(thrusters, 1), &thruster, 30);
    ck_assert(array_push(&ctx, &s.vessel.thrusters, thruster));
    assert_ok(scenario_check(&s, &error), error);
    scenario_mooring_line line;
    section_defaults(vessel_section(table, 2), &line, 30);
    line.kind = LINE_TABLE;
    set_text(line.table_file, sizeof line.table_file, "tensions.csv");
    ck_assert(array_push(&ctx, &s.vessel.mooring.lines, line));
    assert_ok(scenario_check(&s, &error), error);
    scenario_line_point point;
    section_defaults(vessel_section(table, 3), &point, 30);
    ck_assert(array_push(&ctx, &s.vessel.mooring.lines.data[0].table, point));
    assert_fails(scenario_check(&s, &error), error, FRAM_ERROR_INPUT, "points or a table_file, found both");
    ck_assert_str_eq(error.key, "vessel.mooring.lines[0].table");
    scenario_free(&ctx, &s);
}
END_TEST

START_TEST(what_is_absent_is_not_checked)
{
    scenario s = good();
    s.vessel.present = false;
    s.vessel.x = 1e6;
    s.vessel.hull.form = HULL_MESH;
    s.ice.source = ICE_NONE;
    s.ice.concentration = 1;
    s.ice.mean_floe_area = 1e8;
    s.ice.density = 1500;
    assert_ok(scenario_check(&s, &error), error);
    s = good();
    s.domain.boundary = DOMAIN_OPEN;
    s.vessel.x = 1e6;
    assert_ok(scenario_check(&s, &error), error);
    s = good();
    s.environment.water = false;
    s.ice.density = 1500;
    assert_ok(scenario_check(&s, &error), error);
    /* Cells of populations are as large as those say. */
    const scenario_section *ice = scenario_schema.keys[section_find(&scenario_schema, "ice")].section;
    scenario_population population;
    section_defaults(ice->keys[section_find(ice, "populations")].section, &population, 30);
    s = good();
    s.ice.mean_floe_area = 1e8;
    s.ice.populations = (scenario_population_list){.data = &population, .count = 1};
    assert_ok(scenario_check(&s, &error), error);
}
END_TEST

START_TEST(floes_stay_in_the_domain)
{
    context ctx;
    context_init(&ctx);
    scenario s = good();
    scenario_floe floe = a_floe();
    ck_assert(array_push(&ctx, &s.ice.floes, floe));
    assert_fails(scenario_check(&s, &error), error, FRAM_ERROR_INPUT, "expected no floes");
    s.ice.source = ICE_FLOES;
    assert_ok(scenario_check(&s, &error), error);
    floe.y = -101;
    ck_assert(array_push(&ctx, &s.ice.floes, floe));
    assert_fails(scenario_check(&s, &error), error, FRAM_ERROR_INPUT, "inside the domain");
    ck_assert_str_eq(error.key, "ice.floes[1].x");
    scenario_free(&ctx, &s);
}
END_TEST

/* ---- places and paths ---- */

static void put(context *ctx, scenario *s, const char *key, int line, bool override)
{
    scenario_place place = {.line = line, .column = 5, .override = override};
    set_text(place.key, sizeof place.key, key);
    ck_assert(array_push(ctx, &s->places, place));
}

START_TEST(errors_find_their_place)
{
    context ctx;
    context_init(&ctx);
    scenario s = good();
    set_text(s.file, sizeof s.file, "dir/a.yaml");
    put(&ctx, &s, "vessel", 3, false);
    put(&ctx, &s, "vessel.hull", 4, false);
    put(&ctx, &s, "vessel.hull.beam", 6, false);
    error_set(&error, FRAM_ERROR_INPUT, NULL, 0, "vessel.hull.beam", "too wide");
    scenario_locate(&s, &error);
    ck_assert_str_eq(error.file, "dir/a.yaml");
    ck_assert_int_eq(error.line, 6);
    ck_assert_int_eq(error.column, 5);
    error_set(&error, FRAM_ERROR_INPUT, NULL, 0, "vessel.hull.length", "not given: the section stands for it");
    scenario_locate(&s, &error);
    ck_assert_int_eq(error.line, 4);
    ck_assert_str_eq(error.key, "vessel.hull.length");
    error_set(&error, FRAM_ERROR_INPUT, NULL, 0, "ice.thickness", "not given at all");
    scenario_locate(&s, &error);
    ck_assert_str_eq(error.file, "dir/a.yaml");
    ck_assert_int_eq(error.line, 0);
    put(&ctx, &s, "vessel.hull.beam", 0, true);
    error_set(&error, FRAM_ERROR_INPUT, NULL, 0, "vessel.hull.beam", "overridden");
    scenario_locate(&s, &error);
    ck_assert_str_eq(error.file, SCENARIO_OVERRIDE);
    scenario_locate(&s, NULL);
    scenario_free(&ctx, &s);
}
END_TEST

START_TEST(paths_are_relative_to_the_scenario)
{
    scenario s = good();
    char out[64];
    set_text(s.file, sizeof s.file, "scenes/ship/a.yaml");
    ck_assert(scenario_resolve_path(&s, "hull.stl", out, sizeof out));
    ck_assert_str_eq(out, "scenes/ship/hull.stl");
    ck_assert(scenario_resolve_path(&s, "/data/hull.stl", out, sizeof out));
    ck_assert_str_eq(out, "/data/hull.stl");
    set_text(s.file, sizeof s.file, "a.yaml");
    ck_assert(scenario_resolve_path(&s, "../hull.stl", out, sizeof out));
    ck_assert_str_eq(out, "../hull.stl");
    ck_assert(!scenario_resolve_path(&s, "hull.stl", out, 4));
}
END_TEST

/* By its key, or by its name where the caller has none. */
START_TEST(paths_that_are_too_long_are_refused)
{
    scenario s = good();
    char out[SCENARIO_PATH_ROOM], file[SCENARIO_PATH_ROOM + 1];
    set_text(s.file, sizeof s.file, "scenes/a.yaml");
    assert_ok(scenario_file_path(&s, NULL, "wind.csv", out, &error), error);
    ck_assert_str_eq(out, "scenes/wind.csv");
    memset(file, 'w', sizeof file);
    file[sizeof file - 1] = '\0';
    ck_assert_int_eq(scenario_file_path(&s, "ice.file", file, out, &error), FRAM_ERROR_INPUT);
    ck_assert_str_eq(error.key, "ice.file");
    ck_assert_str_eq(error.file, "");
    ck_assert_int_eq(scenario_file_path(&s, NULL, file, out, &error), FRAM_ERROR_INPUT);
    ck_assert_str_eq(error.key, "");
    ck_assert_int_eq(strncmp(error.file, "www", 3), 0);
    ck_assert_str_eq(error.message, "the path is too long");
}
END_TEST

TEST_MAIN("scenario", defaults_pass_their_own_checks, thresholds_follow_the_scale, loads_are_averaged_over_whole_steps,
          averages_tell_of_the_time_before_the_start, defaults_of_the_specification, ice_has_one_drift,
          every_row_is_complete, choices_go_by_name, misspelt_names_find_their_neighbour, walking_meets_every_key_once,
          ranges_are_checked, keys_must_go_together, stations_are_whole, what_is_absent_is_not_checked,
          floes_stay_in_the_domain, errors_find_their_place, paths_are_relative_to_the_scenario,
          paths_that_are_too_long_are_refused)
