/* include/fram/live.h with arguments that cannot be: refused with a word for it, or nothing done; never undefined. */
#include "fram/live.h"
#include "scratch.h"

#include <limits.h>
#include <stdio.h>
#include <sys/stat.h>

static fram_error e;
static fram_context *ctx;
static fram_scenario *s;
static fram_world *w;

static const char text[] = "run: {duration: 1, time_step: 0.05}\n"
                           "vessel:\n  mode: free\n  hull: {length: 48, beam: 12, draught: 4, freeboard: 2}\n"
                           "  thrusters: [{x: 18}]\n"
                           "ice: {source: none}\n";

static void open_all(void)
{
    assert_ok(fram_context_create(NULL, &ctx, &e), e);
    assert_ok(fram_scenario_parse(ctx, text, NULL, NULL, 0, &s, &e), e);
    assert_ok(fram_world_create(s, &w, &e), e);
}

static void close_all(void)
{
    fram_world_destroy(w);
    fram_scenario_destroy(s);
    fram_context_destroy(ctx);
}

static void assert_refused(fram_status status, const char *call)
{
    ck_assert_msg(status == FRAM_ERROR_USAGE || status == FRAM_ERROR_INPUT, "%s: status %s", call,
                  fram_status_name(status));
    ck_assert_msg(e.status == status && e.message[0] && (e.key[0] || e.file[0]), "%s: no words", call);
    e = (fram_error){0};
}
#define REFUSED(call) assert_refused((call), #call)

START_TEST(scenarios_and_states)
{
    open_all();
    fram_scenario *other;
    fram_world *copy;
    void *data;
    size_t size;
    char longest[2000];
    memset(longest, 'a', sizeof longest);
    longest[sizeof longest - 1] = '\0';
    REFUSED(fram_scenario_parse(NULL, text, NULL, NULL, 0, &other, &e));
    REFUSED(fram_scenario_parse(ctx, NULL, NULL, NULL, 0, &other, &e));
    REFUSED(fram_scenario_parse(ctx, text, NULL, NULL, 0, NULL, &e));
    REFUSED(fram_scenario_parse(ctx, text, NULL, NULL, 2, &other, &e));
    REFUSED(fram_scenario_parse(ctx, text, longest, NULL, 0, &other, &e));
    REFUSED(fram_scenario_parse(ctx, "run: [", NULL, NULL, 0, &other, &e));
    ck_assert_ptr_null(fram_scenario_file(NULL, 0));
    ck_assert_ptr_null(fram_scenario_file_key(NULL, 0));
    ck_assert_ptr_null(fram_scenario_file(s, 0));
    REFUSED(fram_world_copy(NULL, &copy, &e));
    REFUSED(fram_world_copy(w, NULL, &e));
    REFUSED(fram_world_save_memory(NULL, &data, &size, &e));
    REFUSED(fram_world_save_memory(w, NULL, &size, &e));
    REFUSED(fram_world_save_memory(w, &data, NULL, &e));
    REFUSED(fram_world_load_memory(NULL, text, 3, &e));
    REFUSED(fram_world_load_memory(w, NULL, 3, &e));
    REFUSED(fram_world_load_memory(w, text, sizeof text, &e));
    REFUSED(fram_world_save(NULL, "x", &e));
    REFUSED(fram_world_save(w, NULL, &e));
    ck_assert_int_ne(fram_world_save(w, "/no/such/folder/state", &e), FRAM_OK);
    REFUSED(fram_world_load(NULL, "x", &e));
    REFUSED(fram_world_load(w, NULL, &e));
    fram_data_free(NULL, NULL);
    fram_data_free(ctx, NULL);
    close_all();
}
END_TEST

START_TEST(channels_and_inputs)
{
    open_all();
    fram_channel c;
    static const double wild[] = {(double)NAN, (double)INFINITY, -(double)INFINITY, 1e300, -1e300};
    static const int numbers[] = {-1, INT_MAX, INT_MIN};
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++) {
        REFUSED(fram_world_channel(w, numbers[i], &c, &e));
        REFUSED(fram_world_input(w, numbers[i], &c, &e));
        REFUSED(fram_world_set_input(w, numbers[i], 0, &e));
        ck_assert(isnan(fram_world_value(w, numbers[i])) && isnan(fram_world_input_value(w, numbers[i])));
    }
    REFUSED(fram_world_channel(NULL, 0, &c, &e));
    REFUSED(fram_world_channel(w, 0, NULL, &e));
    REFUSED(fram_world_input(NULL, 0, &c, &e));
    REFUSED(fram_world_input(w, 0, NULL, &e));
    REFUSED(fram_world_set_input(NULL, 0, 0, &e));
    ck_assert(fram_world_channels(NULL) == 0 && fram_world_inputs(NULL) == 0 && fram_world_values(NULL, NULL, 0) == 0);
    ck_assert(fram_world_find_channel(NULL, "time") == -1 && fram_world_find_channel(w, NULL) == -1 &&
              fram_world_find_channel(w, "") == -1 && fram_world_find_channel(w, "Time") == -1);
    ck_assert(fram_world_find_input(NULL, "wind_x") == -1 && fram_world_find_input(w, NULL) == -1 &&
              fram_world_find_input(w, "ice_drift_x") == -1);
    ck_assert_int_eq(fram_world_values(w, NULL, 5), fram_world_channels(w));
    uint64_t hash = fram_world_hash(w);
    for (int i = 0; i < fram_world_inputs(w); i++) {
        for (size_t k = 0; k < sizeof wild / sizeof *wild; k++)
            REFUSED(fram_world_set_input(w, i, wild[k], &e));
        ck_assert_int_ne(fram_world_set_input(w, i, (double)NAN, NULL), FRAM_OK);
    }
    REFUSED(fram_world_set_input(w, fram_world_find_input(w, "positioning"), 0.5, &e));
    const double times[] = {1, 2}, places[] = {0, 0, 0, 1, 1, 1}, bad_places[] = {0, 0, (double)NAN, 1, 1, 1},
                 bad_times[] = {1, (double)NAN};
    REFUSED(fram_world_set_path(NULL, 0, times, places, 2, &e));
    REFUSED(fram_world_set_path(w, 1, times, places, 2, &e));
    REFUSED(fram_world_set_path(w, -1, times, places, 2, &e));
    REFUSED(fram_world_set_path(w, 0, NULL, places, 2, &e));
    REFUSED(fram_world_set_path(w, 0, times, NULL, 2, &e));
    REFUSED(fram_world_set_path(w, 0, times, places, -1, &e));
    REFUSED(fram_world_set_path(w, 0, times, places, INT_MAX, &e));
    REFUSED(fram_world_set_path(w, 0, times, bad_places, 2, &e));
    REFUSED(fram_world_set_path(w, 0, bad_times, places, 2, &e));
    ck_assert(fram_world_hash(w) == hash);
    close_all();
}
END_TEST

/* What is driven or towed keeps under run.speed_limit, 100 m/s, on every way that it is told. */
START_TEST(speeds_that_end_a_world)
{
    static const char driven[] = "run: {duration: 1, time_step: 0.05}\n"
                                 "vessel: {mode: towed, ramp: 0, hull: {length: 48, beam: 12, draught: 4}}\n"
                                 "ice: {source: none}\n";
    static const char *const modes[] = {"vessel.mode=prescribed", "vessel.mode=towed"};
    const double times[] = {1, 2}, first[] = {150, 0, 0, 160, 0, 0}, second[] = {50, 0, 0, 50, 100, 0},
                 degrees[] = {9, 0, 0, 9, 9, 90}, under[] = {99, 0, 200, 99, 99, 203};
    assert_ok(fram_context_create(NULL, &ctx, &e), e);
    for (size_t i = 0; i < 2; i++) {
        assert_ok(fram_scenario_parse(ctx, driven, NULL, &modes[i], 1, &s, &e), e);
        assert_ok(fram_world_create(s, &w, &e), e);
        int x = fram_world_find_input(w, "tow_velocity_x"), y = fram_world_find_input(w, "tow_velocity_y");
        assert_ok(fram_world_set_input(w, x, 80, &e), e);
        uint64_t hash = fram_world_hash(w);
        assert_fails(fram_world_set_input(w, y, 80, &e), e, FRAM_ERROR_INPUT, "run.speed_limit");
        ck_assert_str_eq(e.key, "tow_velocity_y");
        assert_fails(fram_world_set_path(w, 0, times, first, 2, &e), e, FRAM_ERROR_INPUT, "to number 0, found 150 m/s");
        assert_fails(fram_world_set_path(w, 0, times, second, 2, &e), e, FRAM_ERROR_INPUT,
                     "to number 1, found 100 m/s");
        ck_assert_str_eq(e.key, "times");
        assert_fails(fram_world_set_path(w, 0, times, degrees, 2, &e), e, FRAM_ERROR_INPUT,
                     "to number 1, found a turn of 90 rad/s");
        ck_assert_str_eq(e.key, "times");
        ck_assert(fram_world_hash(w) == hash);
        assert_ok(fram_world_set_path(w, 0, times, under, 2, &e), e);
        for (int k = 0; k < 20 && i == 0; k++)
            assert_ok(fram_world_step(w, &e), e);
        if (i == 0) /* way and turn together are too much for the centre of mass, 1.6 m before the ship's origin */
            assert_fails(fram_world_step(w, &e), e, FRAM_ERROR_SIMULATION, "as the scenario, or a program, told it");
        fram_world_destroy(w);
        fram_scenario_destroy(s);
    }
    static const char *const turns[] = {"vessel.path[1].heading_deg=90", "vessel.path[1].heading_deg=360"};
    static const char along[] = "vessel: {mode: prescribed, path: [{time: 0}, {time: 1}],\n"
                                "         hull: {length: 48, beam: 12, draught: 4}}\nice: {source: none}\n";
    for (size_t i = 0; i < 2; i++) {
        assert_ok(fram_scenario_parse(ctx, along, NULL, &turns[i], 1, &s, &e), e);
        fram_status status = fram_world_create(s, &w, &e);
        ck_assert_int_eq(status, i == 0 ? FRAM_OK : FRAM_ERROR_INPUT);
        if (i == 0)
            fram_world_destroy(w);
        fram_scenario_destroy(s);
    }
    ck_assert_str_eq(e.key, "vessel.path[1].heading_deg");
    fram_context_destroy(ctx);
}
END_TEST

/* What a program told is looked at first where it threw the vessel; what it told to be nothing is not. */
START_TEST(a_vessel_is_thrown_by_what_was_told)
{
    static const struct {
        const char *input; /* NULL: a wrench */
        double value;
        bool told;
    } ways[] = {{"outside_force_z", 1e12, true},
                {"outside_moment_z", 1e16, true},
                {NULL, 1e12, true},
                {"current_x", 900, true},
                {"wind_x", 0, false},
                {"outside_force_x", 0, false}};
    static const char *const driven[] = {"vessel.thrusters[0].setting=1", "run.speed_limit=0.001"};
    for (size_t i = 0; i < sizeof ways / sizeof *ways; i++) {
        assert_ok(fram_context_create(NULL, &ctx, &e), e);
        assert_ok(fram_scenario_parse(ctx, text, NULL, driven, ways[i].told ? 0 : 2, &s, &e), e);
        assert_ok(fram_world_create(s, &w, &e), e);
        fram_body_id vessel;
        const double force[] = {ways[i].value, 0, 0}, none[] = {0, 0, 0};
        ck_assert(fram_world_vessel(w, &vessel));
        if (ways[i].input)
            assert_ok(fram_world_set_input(w, fram_world_find_input(w, ways[i].input), ways[i].value, &e), e);
        else
            assert_ok(fram_body_apply_wrench(w, vessel, force, none, &e), e);
        fram_status status = FRAM_OK;
        for (int k = 0; k < 20 && status == FRAM_OK; k++)
            status = fram_world_step(w, &e);
        ck_assert_int_eq(status, FRAM_ERROR_SIMULATION);
        ck_assert_msg(strstr(e.message, "nothing touches it") != NULL, "%d: %s", (int)i, e.message);
        ck_assert_msg((strstr(e.message, "look at the forces that a program told it") != NULL) == ways[i].told,
                      "%d: %s", (int)i, e.message);
        ck_assert_msg(strstr(e.message, ways[i].told ? "and coefficients" : "notes of the scenario give"), "%s",
                      e.message);
        close_all();
    }
}
END_TEST

/* A ship that drives itself goes by its track, one whose thrusters turn it about its mooring stays there, and one whose
   bow turns against the ice has its heading from there: of what nothing of it follows there is no set point. */
START_TEST(no_set_point_that_nothing_follows)
{
#define DRIVES "propulsion: {bollard_pull: 4.0e5, waypoints: [{x: 99}]}\n"
#define LINES "mooring: {depth: 60, lines: [{count: 4, spacing_deg: 90, distance: 300, pretension: 2.0e5}]}\n"
    static const struct {
        const char *gear;
        bool place, heading;
        const char *why; /* there is no path */
    } ships[] = {
        {"  " DRIVES, false, false, "propulsion.waypoints"},
        {"  " DRIVES "  thrusters: [{x: 18}]\n", true, true, NULL},
        {"  thrusters: [{x: 18}]\n  " LINES "  positioning: {active: true, control: heading}\n", false, true, NULL},
        {"  " LINES "  positioning: {control: heading}\n", false, true, NULL},
        {"  thrusters: [{x: 18}, {x: -18, kind: main}]\n  positioning: {active: true, heading: vaning}\n", true, false,
         NULL},
        {"  thrusters: [{x: 18}]\n  " LINES "  positioning: {active: true, control: heading, heading: vaning}\n", false,
         false, "vaning"}};
    static const char ship[] = "run: {duration: 1, time_step: 0.05}\n"
                               "vessel:\n  mode: free\n  hull: {length: 48, beam: 12, draught: 4, freeboard: 2}\n"
                               "%sice: {source: none}\n";
    char text_of_ship[500];
    const double time = 1, place[] = {99, 9, 0};
    assert_ok(fram_context_create(NULL, &ctx, &e), e);
    for (size_t i = 0; i < sizeof ships / sizeof *ships; i++) {
        snprintf(text_of_ship, sizeof text_of_ship, ship, ships[i].gear);
        assert_ok(fram_scenario_parse(ctx, text_of_ship, NULL, NULL, 0, &s, &e), e);
        assert_ok(fram_world_create(s, &w, &e), e);
        ck_assert_int_eq(fram_world_find_input(w, "set_point_x") >= 0, ships[i].place);
        ck_assert_int_eq(fram_world_find_input(w, "set_point_y") >= 0, ships[i].place);
        ck_assert_int_eq(fram_world_find_input(w, "set_point_heading") >= 0, ships[i].heading);
        bool main = strstr(ships[i].gear, "kind: main") != NULL; /* without a rudder it has no angle */
        ck_assert_int_eq(fram_world_find_input(w, "thruster_2_order") >= 0, main);
        ck_assert_int_eq(fram_world_find_input(w, "thruster_1_order_angle") >= 0,
                         strstr(ships[i].gear, "{x: 18}") != NULL);
        ck_assert_int_eq(fram_world_find_input(w, "thruster_2_order_angle"), -1);
        fram_status status = fram_world_set_path(w, 0, &time, place, 1, &e);
        ck_assert_int_eq(status, ships[i].why ? FRAM_ERROR_USAGE : FRAM_OK);
        ck_assert(!ships[i].why || (strcmp(e.key, "vessel") == 0 && strstr(e.message, ships[i].why)));
        assert_ok(fram_world_set_path(w, 0, NULL, NULL, 0, &e), e);
        fram_world_destroy(w);
        fram_scenario_destroy(s);
    }
    fram_context_destroy(ctx);
}
END_TEST

START_TEST(arrays)
{
    open_all();
    fram_body_view view = {0};
    REFUSED(fram_world_view(NULL, &view, &e));
    REFUSED(fram_world_view(w, NULL, &e));
    fram_body_arrays none = {0}, negative = {.room = INT_MIN};
    ck_assert_int_eq(fram_world_bodies(NULL, 0, NULL), 0);
    ck_assert_int_eq(fram_world_bodies(w, 0, &none), fram_world_bodies(w, 0, &negative));
    ck_assert_int_eq(fram_world_bodies(w, 1u << 31, NULL), 0);
    int bodies = -1;
    double xy[2];
    ck_assert_int_eq(fram_world_outlines(NULL, 0, NULL, 0, NULL, 0, &bodies), 0);
    ck_assert_int_eq(bodies, 0);
    ck_assert_int_ge(fram_world_outlines(w, 0, NULL, 5, xy, INT_MIN, NULL), 0);
    ck_assert_int_eq(fram_world_contacts(NULL, NULL, 0), 0);
    ck_assert_int_eq(fram_world_contacts(w, NULL, INT_MAX), 0);
    ck_assert_int_eq(fram_world_fractures(NULL, NULL, 0), 0);
    ck_assert_int_eq(fram_world_fractures(w, NULL, INT_MAX), 0);
    close_all();
}
END_TEST

START_TEST(recordings)
{
    open_all();
    fram_record_definition d = {0};
    (fram_record_default)(NULL, sizeof(size_t));
    REFUSED(fram_world_record(w, NULL, &e));
    REFUSED(fram_world_record(w, &d, &e));
    fram_record_default(&d);
    REFUSED(fram_world_record(w, &d, &e));
    d.folder = "";
    REFUSED(fram_world_record(w, &d, &e));
    d.folder = "/proc/nowhere/at/all";
    REFUSED(fram_world_record(NULL, &d, &e));
    ck_assert_int_ne(fram_world_record(w, &d, &e), FRAM_OK);
    d.size = sizeof d + 8;
    REFUSED(fram_world_record(w, &d, &e));
    ck_assert(!fram_world_is_recorded(NULL) && !fram_world_is_recorded(w));
    REFUSED(fram_world_checkpoint(NULL, &e));
    REFUSED(fram_world_checkpoint(w, &e));
    REFUSED(fram_world_record_end(NULL, NULL, &e));
    REFUSED(fram_world_record_end(w, NULL, &e));
    close_all();
}
END_TEST

/* Every allocation of a life fails once: an error, nothing leaked, and the world as good as before. */
START_TEST(memory_runs_out)
{
    for (failing_turn turn = {0}; failing_next(&turn);) {
        turn.memory.fail_at = 0; /* the world is made with all the memory there is */
        fram_context_definition d;
        fram_context_default(&d);
        d.memory = failing_memory_resize;
        d.memory_user = &turn.memory;
        fram_world *copy = NULL;
        void *data = NULL;
        size_t size;
        assert_ok(fram_context_create(&d, &ctx, &e), e);
        assert_ok(fram_scenario_parse(ctx, text, NULL, NULL, 0, &s, &e), e);
        assert_ok(fram_world_create(s, &w, &e), e);
        uint64_t hash = fram_world_hash(w);
        turn.memory.requests = 0;
        turn.memory.fail_at = turn.n;
        turn.status = fram_world_copy(w, &copy, &e);
        if (turn.status == FRAM_OK)
            turn.status = fram_world_save_memory(w, &data, &size, &e);
        if (turn.status == FRAM_OK)
            turn.status = fram_world_load_memory(w, data, size, &e);
        ck_assert(fram_world_hash(w) == hash);
        if (turn.status == FRAM_OK)
            turn.status = fram_world_set_input(w, fram_world_find_input(w, "wind_x"), 1, &e);
        turn.memory.fail_at = 0;
        fram_world_destroy(copy);
        fram_data_free(ctx, data);
        close_all();
    }
}
END_TEST

/* A program that was built when the definitions ended earlier. */
START_TEST(older_definitions_are_taken)
{
    fram_context_definition d = {
        .size = offsetof(fram_context_definition, isa), .threads = 2, .isa = "what stands behind"};
    assert_ok(fram_context_create(&d, &ctx, &e), e);
    fram_context_destroy(ctx);
    open_all();
    char folder[SCRATCH_FOLDER];
    scratch_folder(folder);
    fram_record_definition r = {.size = offsetof(fram_record_definition, force), .folder = folder, .force = true};
    assert_ok(fram_world_record(w, &r, &e), e);
    assert_ok(fram_world_step(w, &e), e);
    assert_ok(fram_world_record_end(w, NULL, &e), e);
    REFUSED(fram_world_record(w, &r, &e)); /* force is behind its end: the folder is not empty */
    fram_run_definition run = {.size = offsetof(fram_run_definition, force), .folder = folder, .force = true};
    REFUSED(fram_run(s, &run, NULL, &e));
    close_all();
    scratch_remove_folder(folder);
}
END_TEST

/* A relative folder is that of when the recording began; a folder that cannot be told is refused. */
START_TEST(the_working_folder_changes)
{
    char folder[SCRATCH_FOLDER], before[4096];
    open_all();
    scratch_folder(folder);
    ck_assert(getcwd(before, sizeof before) && chdir(folder) == 0);
    fram_record_definition d;
    fram_record_default(&d);
    d.folder = "run";
    assert_ok(fram_world_record(w, &d, &e), e);
    ck_assert_int_eq(mkdir("other", 0777), 0);
    ck_assert_int_eq(chdir("other"), 0);
    assert_ok(fram_world_step(w, &e), e);
    assert_ok(fram_world_checkpoint(w, &e), e);
    ck_assert(access("run", F_OK) != 0 && access("../run/checkpoint-000000000001.fram", F_OK) == 0);
    /* One that cannot come to its place is told of by the call that asked for it. */
    assert_ok(fram_world_step(w, &e), e);
    ck_assert_int_eq(mkdir("../run/checkpoint-000000000002.fram", 0777), 0);
    ck_assert_int_eq(fram_world_checkpoint(w, &e), FRAM_ERROR_IO);
    ck_assert_int_eq(rmdir("../run/checkpoint-000000000002.fram"), 0);
    assert_ok(fram_world_record_end(w, NULL, &e), e);
    ck_assert_int_eq(rmdir("../other"), 0);
    REFUSED(fram_world_record(w, &d, &e));
    ck_assert_int_eq(chdir(before), 0);
    scratch_remove_folder(folder);
    close_all();
}
END_TEST

TEST_MAIN("live_misuse", scenarios_and_states, channels_and_inputs, speeds_that_end_a_world,
          a_vessel_is_thrown_by_what_was_told, no_set_point_that_nothing_follows, arrays, recordings, memory_runs_out,
          older_definitions_are_taken, the_working_folder_changes)
