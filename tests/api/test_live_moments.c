/* What a world tells is of the moment that it says: bodies that touched in a step are those that were there then, a
   view shows no body that is gone, a path begins where the vessel is, and a controller that is off demands nothing. */
#include "fram/live.h"
#include "testing.h"

#include <stdlib.h>

static const char scene[] = "run: {duration: 9, time_step: 0.02, seed: 5}\n"
                            "vessel:\n  mode: towed\n  speed: 4\n"
                            "  hull: {form: icebreaker, length: 48, beam: 12, draught: 4, freeboard: 2}\n"
                            "ice: {concentration: 0.8, mean_floe_area: 64, thickness: 0.4, breakable: true}\n"
                            "domain: {x_min: -80, x_max: 80, y_min: -40, y_max: 40}\n";
/* Several breaks in a step: a piece of one is broken by the next, and its slot filled again. */
static const char sheet[] = "run: {duration: 9, time_step: 0.02}\n"
                            "vessel:\n  mode: towed\n  speed: 4\n"
                            "  hull: {form: icebreaker, length: 48, beam: 12, draught: 4, freeboard: 2}\n"
                            "ice: {source: level, thickness: 0.6, breakable: true}\n"
                            "domain: {x_min: -80, x_max: 80, y_min: -40, y_max: 40}\n";
static const char kept[] = "run: {duration: 9, time_step: 0.05}\n"
                           "vessel:\n  mode: free\n  hull: {length: 48, beam: 12, draught: 4, freeboard: 2}\n"
                           "  thrusters: [{x: 18}, {x: -18}]\n  positioning: {active: true}\n"
                           "ice: {source: none}\n";
/* Headed a little beyond half a turn; on the way along x, then along y. */
static const char driven[] = "run: {duration: 20, time_step: 0.02}\n"
                             "vessel:\n  mode: %s\n  heading_deg: 190\n  hull: {length: 48, beam: 12, draught: 4}\n%s"
                             "ice: {source: none}\n";
static const char corner[] = "  path: [{time: 0, x: 0, y: 0}, {time: 1, x: 4, y: 0}, {time: 2, x: 4, y: 3}]\n";

static fram_error e;
static fram_context *ctx;
static fram_scenario *scenario;

static fram_world *open_text(const char *text)
{
    fram_world *w;
    fram_context_definition d;
    fram_context_default(&d);
    assert_ok(fram_context_create(&d, &ctx, &e), e);
    assert_ok(fram_scenario_parse(ctx, text, NULL, NULL, 0, &scenario, &e), e);
    assert_ok(fram_world_create(scenario, &w, &e), e);
    return w;
}

static fram_world *open_driven(const char *mode, const char *path)
{
    char text[600];
    snprintf(text, sizeof text, driven, mode, path);
    return open_text(text);
}

static void close_world(fram_world *w)
{
    fram_world_destroy(w);
    fram_scenario_destroy(scenario);
    fram_context_destroy(ctx);
}

static double input(const fram_world *w, const char *name)
{
    return fram_world_input_value(w, fram_world_find_input(w, name));
}

static double value(const fram_world *w, const char *name)
{
    return fram_world_value(w, fram_world_find_channel(w, name));
}

static void step(fram_world *w, int count)
{
    for (int i = 0; i < count; i++)
        assert_ok(fram_world_step(w, &e), e);
}

enum { BODIES = 2000, CONTACTS = 8000 };

static bool was_there(fram_body_id id, const fram_body_id *before, int count)
{
    for (int i = 0; i < count; i++)
        if (before[i].slot == id.slot && before[i].generation == id.generation)
            return true;
    return false;
}

enum { LOADS = 5 };

/* What the ice does to the vessel is what the series tells of it, and the sum of its parts; adds up how much of each
   there was. */
static void assert_load_is_in_the_series(const fram_world *w, double seen[LOADS])
{
    static const char *const NAMES[LOADS] = {"ice_force", "ice_moment", "ice_force_capped", "ice_force_below_cap",
                                             "ice_force_friction"};
    fram_body_id vessel;
    fram_ice_load load;
    ck_assert(fram_world_vessel(w, &vessel));
    assert_ok(fram_world_ice_load(w, vessel, &load, &e), e);
    const double *const told[LOADS] = {load.force, load.moment, load.capped, load.below_cap, load.friction};
    for (int axis = 0; axis < 3; axis++) {
        for (int i = 0; i < LOADS; i++) {
            char name[32];
            snprintf(name, sizeof name, "%s_%c", NAMES[i], "xyz"[axis]);
            assert_bits(told[i][axis], value(w, name));
            seen[i] += fabs(told[i][axis]);
        }
        assert_absolute(load.capped[axis] + load.below_cap[axis] + load.friction[axis], load.force[axis],
                        1e-9 * (1 + fabs(load.capped[axis]) + fabs(load.below_cap[axis])));
    }
}

/* Returns the world after so many steps. */
static fram_world *assert_contacts_were_there(const char *text, int steps)
{
    static fram_body_id before[BODIES];
    static fram_contact contacts[CONTACTS];
    fram_world *w = open_text(text);
    fram_body_state state;
    double seen[LOADS] = {0};
    int gone = 0;
    for (int i = 0; i < steps; i++) {
        int count = fram_world_bodies(w, 0, &(fram_body_arrays){.room = BODIES, .id = before});
        assert_ok(fram_world_step(w, &e), e);
        int touched = fram_world_contacts(w, contacts, CONTACTS);
        ck_assert(count <= BODIES && touched <= CONTACTS);
        for (int k = 0; k < touched; k++) {
            const fram_body_id id[2] = {contacts[k].a, contacts[k].b};
            for (int end = 0; end < 2; end++) {
                ck_assert(was_there(id[end], before, count));
                gone += fram_body_state_get(w, id[end], &state, &e) != FRAM_OK;
            }
        }
        assert_load_is_in_the_series(w, seen);
    }
    ck_assert_int_gt(gone, 0);
    for (int i = 0; i < LOADS; i++)
        ck_assert_double_gt(seen[i], 1e3);
    return w;
}

/* A piece may stand in the slot of the floe that it broke from: it touched nothing in the step that made it. */
START_TEST(contacts_name_those_that_touched)
{
    close_world(assert_contacts_were_there(sheet, 90));
    static fram_contact contacts[CONTACTS], again[CONTACTS];
    fram_world *copy, *w = assert_contacts_were_there(scene, 200);
    assert_ok(fram_world_copy(w, &copy, &e), e);
    int touched = fram_world_contacts(w, contacts, CONTACTS);
    ck_assert_int_eq(fram_world_contacts(copy, again, CONTACTS), touched);
    ck_assert(memcmp(contacts, again, (size_t)touched * sizeof *again) == 0);
    fram_world_destroy(copy);
    close_world(w);
}
END_TEST

static int living(const fram_body_view *view)
{
    int count = 0;
    for (int i = 0; i < view->slots; i++)
        count += view->lives[i] != 0;
    return count;
}

START_TEST(a_view_shows_none_that_a_loaded_state_has_not)
{
    fram_world *w = open_text(scene);
    fram_body_view view, held;
    void *state;
    size_t size;
    assert_ok(fram_world_save_memory(w, &state, &size, &e), e);
    assert_ok(fram_world_view(w, &view, &e), e);
    step(w, 200);
    assert_ok(fram_world_view(w, &held, &e), e);
    int bodies = fram_world_bodies(w, 0, NULL);
    ck_assert_int_eq(living(&held), bodies);
    assert_ok(fram_world_load_memory(w, state, size, &e), e);
    ck_assert_int_lt(fram_world_bodies(w, 0, NULL), bodies);
    ck_assert_int_eq(living(&held), fram_world_bodies(w, 0, NULL));
    fram_data_free(ctx, state);
    close_world(w);
}
END_TEST

/* Heading is known but for whole turns: from 190 to 200 degrees it is ten, whatever a path is given in. */
START_TEST(a_path_turns_the_shorter_way)
{
    static const char *const MODES[2] = {"prescribed", "towed"};
    for (int mode = 0; mode < 2; mode++) {
        fram_world *w = open_driven(MODES[mode], "  speed: 0\n");
        const double time = 2, place[3] = {0, 0, 200 * 3.14159265358979 / 180};
        assert_ok(fram_world_set_path(w, 0, &time, place, 1, &e), e);
        step(w, 50);
        assert_absolute(value(w, "angular_velocity_z"), 5 * 3.14159265358979 / 180, 2e-3);
        assert_absolute(value(w, "yaw"), -165, 0.1);
        close_world(w);
    }
}
END_TEST

/* What holds on a path is how fast it goes there, and telling one axis leaves the other. */
START_TEST(a_path_tells_its_velocity)
{
    fram_world *w = open_driven("prescribed", corner);
    for (int leg = 0; leg < 3; leg++) {
        const double along[3][2] = {{4, 0}, {0, 3}, {0, 0}};
        assert_absolute(input(w, "tow_velocity_x"), along[leg][0], 1e-12);
        assert_absolute(input(w, "tow_velocity_y"), along[leg][1], 1e-12);
        step(w, leg < 2 ? 50 : 0);
    }
    assert_ok(fram_world_set_input(w, fram_world_find_input(w, "tow_velocity_y"), 0.5, &e), e);
    assert_ok(fram_world_step(w, &e), e);
    assert_absolute(value(w, "velocity_x"), 0, 1e-9);
    assert_absolute(value(w, "velocity_y"), 0.5, 1e-9);
    close_world(w);
}
END_TEST

/* A speed that is told on the ramp is the speed from the next step on, whatever of the ramp is left. */
START_TEST(a_ramp_ends_where_a_speed_is_told)
{
    for (int with_path = 0; with_path < 2; with_path++) {
        fram_world *w = open_driven("towed", "  speed: 1\n  course_deg: 0\n  ramp: 0.4\n");
        const double time = 1, place[3] = {2, 0, 3.3};
        step(w, 10);
        assert_absolute(input(w, "tow_velocity_x"), 1, 1e-12);
        assert_absolute(value(w, "velocity_x"), 0.5, 1e-9);
        if (with_path)
            assert_ok(fram_world_set_path(w, 0, &time, place, 1, &e), e);
        assert_ok(fram_world_set_input(w, fram_world_find_input(w, "tow_velocity_x"), 0.8, &e), e);
        for (int i = 0; i < 2; i++) {
            step(w, 1);
            assert_absolute(input(w, "tow_velocity_x"), 0.8, 1e-12);
            assert_absolute(value(w, "velocity_x"), 0.8, 1e-9);
        }
        close_world(w);
    }
}
END_TEST

/* Without its path a hull goes on as fast as it went along it, and stands where it stood. */
START_TEST(a_hull_goes_on_without_its_path)
{
    const double along[3][2] = {{4, 0}, {0, 3}, {0, 0}};
    for (int leg = 0; leg < 3; leg++) {
        fram_world *w = open_driven("prescribed", corner);
        step(w, 25 + 50 * leg);
        assert_ok(fram_world_set_path(w, 0, NULL, NULL, 0, &e), e);
        assert_absolute(input(w, "tow_velocity_x"), along[leg][0], 1e-12);
        step(w, 50);
        assert_absolute(value(w, "velocity_x"), along[leg][0], 1e-9);
        assert_absolute(value(w, "velocity_y"), along[leg][1], 1e-9);
        close_world(w);
    }
}
END_TEST

START_TEST(a_controller_that_is_off_demands_nothing)
{
    fram_world *w = open_text(kept);
    static const char *const CHANNELS[] = {"thrusters_saturated", "demanded_force_x", "demanded_force_y",
                                           "demanded_force_z"};
    assert_ok(fram_world_set_input(w, fram_world_find_input(w, "outside_force_x"), 5e6, &e), e);
    for (int i = 0; i < 100; i++)
        assert_ok(fram_world_step(w, &e), e);
    ck_assert(value(w, CHANNELS[0]) == 1 && value(w, CHANNELS[1]) < 0);
    assert_ok(fram_world_set_input(w, fram_world_find_input(w, "positioning"), 0, &e), e);
    assert_ok(fram_world_step(w, &e), e);
    for (size_t i = 0; i < sizeof CHANNELS / sizeof *CHANNELS; i++)
        assert_bits(value(w, CHANNELS[i]), 0);
    close_world(w);
}
END_TEST

TEST_MAIN("live_moments", contacts_name_those_that_touched, a_view_shows_none_that_a_loaded_state_has_not,
          a_path_turns_the_shorter_way, a_path_tells_its_velocity, a_ramp_ends_where_a_speed_is_told,
          a_hull_goes_on_without_its_path, a_controller_that_is_off_demands_nothing)
