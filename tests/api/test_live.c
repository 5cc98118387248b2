/* include/fram/live.h: a world inside another program is recorded, saved, copied, read and steered as `fram run` would.
 */
#include "fram/live.h"
#include "fram/results.h"
#include "scratch.h"

#include <pthread.h>
#include <sched.h>
#include <stdio.h>
#include <sys/wait.h>

enum { PATH = 600 };

static fram_error e;
static failing_memory memory_of_test;
static fram_context *ctx;
static fram_scenario *scenario_of_test;
static char folder[SCRATCH_FOLDER];

/* All at once: lines, thrusters, positioning, an open domain with a current, floes that break under the hull. */
static const char busy[] =
    "run: {duration: 2, time_step: 0.02, seed: 5}\n"
    "vessel:\n  mode: free\n  hull: {length: 48, beam: 12, draught: 4, freeboard: 2}\n"
    "  mooring:\n    depth: 60\n    lines:\n      - {count: 4, spacing_deg: 90, distance: 300, pretension: 2.0e5}\n"
    "  thrusters:\n    - {x: 18}\n    - {x: -18, kind: main, rudder_deg: 25}\n    - {x: -15, kind: tunnel}\n"
    "  positioning: {active: true, observer: kalman, feed_forward: measured}\n"
    "ice: {concentration: 0.8, mean_floe_area: 64, thickness: 0.3, breakable: true}\n"
    "domain: {x_min: -64, x_max: 64, y_min: -40, y_max: 40, boundary: open}\n"
    "environment: {current_speed: 3, current_direction_deg: 180}\n"
    "output: {frame_interval: 0.3, checkpoint_interval: 0.5, picture_interval: 0.8}\n";
static const char towed[] = "run: {duration: 2, time_step: 0.02}\n"
                            "vessel:\n  mode: towed\n  x: -26\n  speed: 3\n  ramp: 0.1\n"
                            "  hull: {length: 48, beam: 12, draught: 4, freeboard: 2}\n"
                            "ice:\n  source: floes\n  thickness: 0.5\n  breakable: true\n  floes:\n"
                            "    - {length: 40, width: 40, x: 20.5, y: 20.5, fixed: true}\n"
                            "    - {length: 40, width: 20, x: 20.5, y: -11}\n"
                            "domain: {x_min: -64, x_max: 64, y_min: -40, y_max: 44}\n";
static const char fed[] = "run: {duration: 2, time_step: 0.02, seed: 4}\n"
                          "vessel:\n  mode: free\n  hull: {length: 48, beam: 12, draught: 4, freeboard: 2}\n"
                          "ice: {concentration: 0.6, mean_floe_area: 64}\n"
                          "domain: {x_min: -64, x_max: 64, y_min: -40, y_max: 40, boundary: feeding, drift_speed: 3}\n";
static const char still[] = "run: {duration: 2, time_step: 0.02}\n"
                            "vessel:\n  mode: free\n  hull: {length: 48, beam: 12, draught: 4, freeboard: 2}\n"
                            "  thrusters:\n    - {x: 18, forbidden_deg: 10, forbidden_width_deg: 40}\n"
                            "    - {x: -18, kind: main, rudder_deg: 25}\n"
                            "ice: {source: none}\n";

static void open_text(const char *text)
{
    scratch_folder(folder);
    fram_context_definition d;
    fram_context_default(&d);
    (void)failing_context(&memory_of_test, 0);
    d.memory = failing_memory_resize;
    d.memory_user = &memory_of_test;
    assert_ok(fram_context_create(&d, &ctx, &e), e);
    assert_ok(fram_scenario_parse(ctx, text, NULL, NULL, 0, &scenario_of_test, &e), e);
}

static void close_all(void)
{
    fram_scenario_destroy(scenario_of_test);
    fram_context_destroy(ctx);
    ck_assert_int_eq(memory_of_test.live, 0);
    scratch_remove_folder(folder);
}

static fram_world *create(void)
{
    fram_world *w;
    assert_ok(fram_world_create(scenario_of_test, &w, &e), e);
    return w;
}

static fram_world *open_world(const char *text)
{
    open_text(text);
    return create();
}

static void close_world(fram_world *w)
{
    fram_world_destroy(w);
    close_all();
}

static void step(fram_world *w, int count)
{
    for (int i = 0; i < count; i++)
        assert_ok(fram_world_step(w, &e), e);
}

static void set(fram_world *w, const char *name, double value)
{
    int index = fram_world_find_input(w, name);
    ck_assert_msg(index >= 0, "no input %s", name);
    assert_ok(fram_world_set_input(w, index, value, &e), e);
}

static double input(const fram_world *w, const char *name)
{
    return fram_world_input_value(w, fram_world_find_input(w, name));
}

static double value(const fram_world *w, const char *name)
{
    int index = fram_world_find_channel(w, name);
    ck_assert_msg(index >= 0, "no channel %s", name);
    return fram_world_value(w, index);
}

/* ---- recording ---- */

static void shell(const char *format, const char *a, const char *b)
{
    char command[2 * PATH];
    snprintf(command, sizeof command, format, a, b);
    ck_assert_msg(system(command) == 0, "%s", command); /* NOLINT(cert-env33-c): folders of mkdtemp */
}

/* The same bytes but for wall times: a column of the series, members of run.json that end in _s or name the wall, and
   the lengths and checksums of series that checkpoints hold. */
static void assert_same_run(const char *a, const char *b)
{
    shell("(cd %s && ls -R) >%s.list", a, a);
    shell("(cd %s && ls -R) >%s.list", b, b);
    shell("cmp %s.list %s.list", a, b);
    static const char *const files[] = {
        "record.fram",
        "fractures.csv",
        "scenario.yaml",
#ifdef FRAM_HAVE_CAIRO
        "plan.png",
#endif
    };
    for (size_t i = 0; i < sizeof files / sizeof *files; i++) {
        char from[PATH + 20], to[PATH + 20];
        snprintf(from, sizeof from, "%s/%s", a, files[i]);
        snprintf(to, sizeof to, "%s/%s", b, files[i]);
        shell("cmp %s %s", from, to);
    }
    shell("for f in %s %s; do sed 's/,[^,]*$//' $f/series.csv | cut -d, -f1-105 >$f.cut; done", a, b);
    shell("cmp %s.cut %s.cut", a, b);
    shell("for f in %s %s; do grep -v '_s\"\\|wall' $f/run.json >$f.cut; done", a, b);
    shell("cmp %s.cut %s.cut", a, b);
}

START_TEST(a_recorded_world_leaves_what_a_run_leaves)
{
    open_text(busy);
    char run[PATH], live[PATH];
    snprintf(run, sizeof run, "%s/run", folder);
    snprintf(live, sizeof live, "%s/live", folder);
    fram_run_definition rd;
    fram_run_default(&rd);
    rd.folder = run;
    fram_run_result by_run = {0}, by_hand = {0};
    assert_ok(fram_run(scenario_of_test, &rd, &by_run, &e), e);
    fram_world *w = create();
    fram_record_definition d;
    fram_record_default(&d);
    d.folder = live;
    ck_assert(!fram_world_is_recorded(w));
    assert_ok(fram_world_record(w, &d, &e), e);
    ck_assert(fram_world_is_recorded(w));
    assert_fails(fram_world_record(w, &d, &e), e, FRAM_ERROR_USAGE, "recorded already");
    step(w, 100);
    /* What is recorded is no part of the state. */
    fram_world *bare = create();
    step(bare, 100);
    ck_assert(fram_world_hash(w) == fram_world_hash(bare));
    fram_world_destroy(bare);
    assert_ok(fram_world_record_end(w, &by_hand, &e), e);
    ck_assert(by_hand.state_hash == by_run.state_hash && by_hand.finished && by_run.finished);
    ck_assert_int_eq(by_hand.floes, by_run.floes);
    ck_assert_int_eq(by_hand.bodies, by_run.bodies);
    ck_assert(by_hand.steps == 100 && by_hand.wall > 0 && by_hand.real_time_factor > 0);
    assert_same_run(run, live);
    fram_world_destroy(w);
    fram_result report;
    assert_ok(fram_report(ctx, live, NULL, false, &report, &e), e);
    close_all();
}
END_TEST

START_TEST(a_recording_can_be_resumed_and_ends_with_its_world)
{
    open_text(busy);
    char live[PATH];
    snprintf(live, sizeof live, "%s/live", folder);
    fram_record_definition d;
    fram_record_default(&d);
    d.folder = live;
    fram_world *w = create();
    assert_ok(fram_world_record(w, &d, &e), e);
    step(w, 10);
    assert_ok(fram_world_checkpoint(w, &e), e);
    fram_world *copy;
    assert_ok(fram_world_copy(w, &copy, &e), e);
    ck_assert(!fram_world_is_recorded(copy));
    assert_fails(fram_world_checkpoint(copy, &e), e, FRAM_ERROR_USAGE, "not recorded");
    assert_fails(fram_world_record_end(copy, NULL, &e), e, FRAM_ERROR_USAGE, "not recorded");
    void *data;
    size_t size;
    assert_ok(fram_world_save_memory(w, &data, &size, &e), e);
    assert_fails(fram_world_load_memory(w, data, size, &e), e, FRAM_ERROR_USAGE, "recorded");
    fram_data_free(ctx, data);
    fram_world_destroy(w);
    step(copy, 90);
    fram_run_definition rd;
    fram_run_default(&rd);
    rd.folder = live;
    fram_run_result result;
    assert_ok(fram_resume(ctx, &rd, &result, &e), e);
    ck_assert(result.finished && result.state_hash == fram_world_hash(copy));
    /* A recording that begins later, and into a folder that is not empty. */
    assert_fails(fram_world_record(copy, &d, &e), e, FRAM_ERROR_USAGE, "not empty");
    ck_assert(!fram_world_is_recorded(copy));
    d.force = true;
    assert_ok(fram_world_record(copy, &d, &e), e);
    step(copy, 30);
    assert_ok(fram_world_record_end(copy, NULL, &e), e);
    fram_result report;
    assert_ok(fram_report(ctx, live, NULL, false, &report, &e), e);
    close_world(copy);
}
END_TEST

/* ---- states ---- */

static void assert_same_world(fram_world *a, fram_world *b)
{
    ck_assert(fram_world_hash(a) == fram_world_hash(b));
    void *da, *db;
    size_t sa, sb;
    assert_ok(fram_world_save_memory(a, &da, &sa, &e), e);
    assert_ok(fram_world_save_memory(b, &db, &sb, &e), e);
    ck_assert(sa == sb && memcmp(da, db, sa) == 0);
    fram_data_free(ctx, da);
    fram_data_free(ctx, db);
}

static unsigned dice(unsigned *state)
{
    *state = *state * 1664525u + 1013904223u;
    return *state >> 16;
}

/* What a controller of the test would do; some of it is refused while positioning is on. */
static void steer(fram_world *w, unsigned *state)
{
    int index = (int)(dice(state) % (unsigned)fram_world_inputs(w));
    fram_channel channel;
    assert_ok(fram_world_input(w, index, &channel, &e), e);
    bool flag = strcmp(channel.unit, "1") == 0;
    double most = strcmp(channel.unit, "m/s") == 0 ? 2 : strcmp(channel.unit, "deg") == 0 ? 90 : 1e5;
    if (strncmp(channel.name, "set_point_", 10) == 0)
        most = 5;
    double told = flag ? dice(state) % 2 : most * ((double)(dice(state) % 2001) / 1000 - 1);
    if (strcmp(channel.name, "tow_velocity_x") == 0)
        told = 2 + fabs(told); /* on into the ice */
    fram_status status = fram_world_set_input(w, index, told, &e);
    ck_assert_msg(status == FRAM_OK || (status == FRAM_ERROR_USAGE && strstr(channel.name, "order")), "%s: %s",
                  channel.name, e.message);
}

/* Random cycles of step, save, load, copy and steering: what went another way round has the same state. */
static long run_cycles(const char *text, int cycles, int before, unsigned state)
{
    fram_world *w = open_world(text);
    long fractures = 0;
    step(w, before);
    for (int i = 0; i < cycles; i++) {
        if (fram_world_steps(w) > 300) {
            fram_world_destroy(w);
            w = create();
            step(w, before);
        }
        fram_world *other;
        void *data;
        size_t size;
        char path[PATH];
        snprintf(path, sizeof path, "%s/state.fram", folder);
        steer(w, &state);
        bool by_copy = dice(&state) % 2 == 0, by_file = dice(&state) % 2 == 0;
        assert_ok(fram_world_save_memory(w, &data, &size, &e), e);
        assert_ok(fram_world_save(w, path, &e), e);
        if (by_copy)
            assert_ok(fram_world_copy(w, &other, &e), e);
        else
            other = create();
        if (!by_copy && by_file)
            assert_ok(fram_world_load(other, path, &e), e);
        if (!by_copy && !by_file)
            assert_ok(fram_world_load_memory(other, data, size, &e), e);
        assert_same_world(w, other);
        int steps = (int)(dice(&state) % 6);
        for (int k = 0; k < steps; k++) {
            unsigned same = state;
            steer(w, &state);
            steer(other, &same);
            step(w, 1);
            step(other, 1);
            fractures += fram_world_fractures(w, NULL, 0);
        }
        assert_same_world(w, other);
        /* Back, and forth again without the steering: another way, unless nothing was told. */
        if (dice(&state) % 4 == 0) {
            assert_ok(fram_world_load_memory(w, data, size, &e), e);
            fram_world *from = create();
            assert_ok(fram_world_load(from, path, &e), e);
            step(w, 2);
            step(from, 2);
            assert_same_world(w, from);
            fram_world_destroy(from);
        }
        fram_data_free(ctx, data);
        fram_world_destroy(other);
    }
    close_world(w); /* nothing leaked */
    return fractures;
}

START_TEST(random_cycles_leave_equal_states)
{
    enum { ENOUGH = 60 }; /* to break a floe; `make test-cycles` may ask for fewer */
    const char *asked = getenv("FRAM_CYCLES");
    int cycles = asked ? atoi(asked) : getenv("FRAM_TEST_SHORT") ? 10 : ENOUGH;
    long fractures = run_cycles(busy, cycles, 1, 7);
    fractures += run_cycles(towed, cycles, 45, 11) /* the hull meets the ice */;
    ck_assert_msg(cycles < ENOUGH || fractures > 0, "nothing broke");
}
END_TEST

START_TEST(foreign_and_damaged_states_are_refused)
{
    fram_world *w = open_world(busy);
    step(w, 2);
    void *data;
    size_t size;
    assert_ok(fram_world_save_memory(w, &data, &size, &e), e);
    uint64_t hash = fram_world_hash(w);
    unsigned char *bytes = data;
    for (size_t at = 0; at < size; at += 1 + size / 97) {
        bytes[at] ^= 0x40;
        ck_assert_int_eq(fram_world_load_memory(w, data, size, &e), FRAM_ERROR_INPUT);
        bytes[at] ^= 0x40;
    }
    ck_assert_int_eq(fram_world_load_memory(w, data, size / 2, &e), FRAM_ERROR_INPUT);
    ck_assert_int_eq(fram_world_load_memory(w, data, 0, &e), FRAM_ERROR_INPUT);
    ck_assert_int_eq(fram_world_load(w, "/no/such/state", &e), FRAM_ERROR_INPUT);
    fram_scenario *other;
    fram_world *stranger;
    assert_ok(fram_scenario_parse(ctx, towed, NULL, NULL, 0, &other, &e), e);
    assert_ok(fram_world_create(other, &stranger, &e), e);
    assert_fails(fram_world_load_memory(stranger, data, size, &e), e, FRAM_ERROR_INPUT, "another scenario");
    ck_assert(fram_world_hash(w) == hash);
    fram_world_destroy(stranger);
    fram_scenario_destroy(other);
    fram_data_free(ctx, data);
    close_world(w);
}
END_TEST

START_TEST(a_world_that_failed_is_not_stepped_on)
{
    fram_world *w = open_world(towed);
    void *data;
    size_t size;
    step(w, 3);
    assert_ok(fram_world_save_memory(w, &data, &size, &e), e);
    char live[PATH];
    snprintf(live, sizeof live, "%s/live", folder);
    fram_record_definition d;
    fram_record_default(&d);
    d.folder = live;
    assert_ok(fram_world_record(w, &d, &e), e);
    fram_body_id ids[20];
    fram_body_arrays arrays = {.room = 20, .id = ids};
    ck_assert_int_gt(fram_world_bodies(w, FRAM_SELECT_FLOES, &arrays), 1);
    const double push[3] = {1e30, 0, 0}, none[3] = {0, 0, 0};
    for (int i = 0; i < 2; i++) {
        fram_body_state state;
        assert_ok(fram_body_state_get(w, ids[i], &state, &e), e);
        if (state.dynamic)
            assert_ok(fram_body_apply_wrench(w, ids[i], push, none, &e), e);
    }
    assert_fails(fram_world_step(w, &e), e, FRAM_ERROR_SIMULATION, "went wrong");
    ck_assert(!fram_world_is_recorded(w));
    shell("grep -q '\"status\": \"failed\"' %s/run.json && test -f %s/failed.fram", live, live);
    assert_fails(fram_world_step(w, &e), e, FRAM_ERROR_USAGE, "failed");
    assert_fails(fram_world_record(w, &d, &e), e, FRAM_ERROR_USAGE, "failed");
    fram_world *copy;
    assert_ok(fram_world_copy(w, &copy, &e), e);
    ck_assert(fram_world_hash(copy) == fram_world_hash(w));
    assert_fails(fram_world_step(copy, &e), e, FRAM_ERROR_USAGE, "failed");
    fram_world_destroy(copy);
    assert_ok(fram_world_load_memory(w, data, size, &e), e);
    step(w, 3);
    fram_data_free(ctx, data);
    close_world(w);
}
END_TEST

/* ---- reading ---- */

START_TEST(channels_are_the_columns_of_the_series)
{
    open_text(busy);
    char run[PATH], head[20000] = "", line[20000];
    snprintf(run, sizeof run, "%s/run", folder);
    fram_run_definition rd;
    fram_run_default(&rd);
    rd.folder = run;
    rd.until = 0.2;
    assert_ok(fram_run(scenario_of_test, &rd, NULL, &e), e);
    fram_world *w = create();
    step(w, 10);
    int count = fram_world_channels(w);
    for (int i = 0; i < count; i++) {
        fram_channel c;
        assert_ok(fram_world_channel(w, i, &c, &e), e);
        ck_assert(c.index == i && fram_world_find_channel(w, c.name) == i);
        ck_assert_msg(c.meaning[0] != '\0', "%s has no meaning: add it in src/api/channels.c", c.name);
        snprintf(head + strlen(head), sizeof head - strlen(head), "%s%s[%s]", i ? "," : "", c.name, c.unit);
    }
    strcat(head, "\n");
    char path[PATH + 20];
    snprintf(path, sizeof path, "%s/series.csv", run);
    FILE *file = fopen(path, "r");
    ck_assert_ptr_nonnull(file);
    ck_assert_ptr_nonnull(fgets(line, sizeof line, file));
    ck_assert_str_eq(line, head);
    while (fgets(line, sizeof line, file))
        ;
    fclose(file);
    double values[400];
    ck_assert_int_eq(fram_world_values(w, values, 400), count);
    const char *at = line;
    for (int i = 0; i < count; i++) {
        double told = strtod(at, (char **)&at);
        at++;
        if (i != fram_world_find_channel(w, "step_wall_time"))
            assert_relative(values[i], told, 1e-11);
        assert_bits(fram_world_value(w, i), values[i]);
    }
    ck_assert(value(w, "step_wall_time") > 0);
    ck_assert(isnan(fram_world_value(w, count)) && isnan(fram_world_value(w, -1)));
    close_world(w);
}
END_TEST

START_TEST(arrays_tell_what_single_calls_tell)
{
    enum { ROOM = 400, POINTS = 8000 };
    fram_world *w = open_world(busy);
    step(w, 20);
    static fram_body_id id[ROOM];
    static int32_t kind[ROOM], number[ROOM], parent[ROOM], offset[ROOM + 1];
    static double mass[ROOM], thickness[ROOM], position[3 * ROOM], orientation[4 * ROOM], velocity[3 * ROOM],
        turn[3 * ROOM], xy[2 * POINTS], outline[2 * POINTS];
    const fram_body_arrays a = {ROOM, id, kind, number, parent, mass, thickness, position, orientation, velocity, turn};
    int count = fram_world_bodies(w, 0, &a), bodies;
    ck_assert(count > 40 && count < ROOM);
    int points = fram_world_outlines(w, 0, offset, ROOM + 1, xy, POINTS, &bodies);
    ck_assert(bodies == count && points < POINTS && offset[count] == points && offset[0] == 0);
    fram_body_view view;
    assert_ok(fram_world_view(w, &view, &e), e);
    int floes = 0;
    for (int i = 0; i < count; i++) {
        fram_body_state s;
        assert_ok(fram_body_state_get(w, id[i], &s, &e), e);
        ck_assert_int_eq(s.kind, kind[i]);
        assert_bits(mass[i], s.mass);
        assert_array_bits(&position[3 * i], s.position, 3);
        assert_array_bits(&orientation[4 * i], s.orientation, 4);
        assert_array_bits(&velocity[3 * i], s.velocity, 3);
        assert_array_bits(&turn[3 * i], s.angular_velocity, 3);
        assert_array_bits(&view.position[3 * id[i].slot], s.position, 3);
        assert_array_bits(&view.orientation[4 * id[i].slot], s.orientation, 4);
        ck_assert(view.lives[id[i].slot] && view.generation[id[i].slot] == id[i].generation);
        int n = fram_body_outline(w, id[i], outline, POINTS);
        ck_assert_int_eq(n, offset[i + 1] - offset[i]);
        assert_array_absolute(&xy[2 * offset[i]], outline, 2 * n, 1e-12);
        ck_assert((kind[i] == FRAM_BODY_FLOE) == (number[i] >= 0));
        if (kind[i] == FRAM_BODY_FLOE)
            assert_absolute(thickness[i], 0.3, 1e-12);
        floes += kind[i] == FRAM_BODY_FLOE;
    }
    ck_assert_int_eq(fram_world_bodies(w, FRAM_SELECT_FLOES, NULL), floes);
    ck_assert_int_eq(fram_world_bodies(w, FRAM_SELECT_VESSELS, NULL), 1);
    ck_assert_int_eq(floes, (int)value(w, "floes"));
    /* Rooms that are too small: the rest is left out, nothing else is written. */
    const fram_body_arrays small = {.room = 2, .kind = kind};
    kind[2] = -77;
    ck_assert_int_eq(fram_world_bodies(w, 0, &small), count);
    ck_assert_int_eq(kind[2], -77);
    xy[20] = -77;
    ck_assert_int_eq(fram_world_outlines(w, 0, NULL, 0, xy, 10, NULL), points);
    assert_bits(xy[20], -77);
    close_world(w);
}
END_TEST

START_TEST(contacts_sum_to_the_load_and_fractures_are_told)
{
    enum { ROOM = 3000 };
    static fram_contact contacts[ROOM];
    fram_world *w = open_world(towed);
    fram_body_id vessel;
    ck_assert(fram_world_vessel(w, &vessel));
    int broke = 0, capped = 0;
    for (int i = 0; i < 100; i++) {
        step(w, 1);
        int count = fram_world_contacts(w, contacts, ROOM);
        ck_assert_int_le(count, ROOM);
        double sum[3] = {0};
        for (int k = 0; k < count; k++) {
            const fram_contact *c = &contacts[k];
            double sign = c->a.slot == vessel.slot ? 1 : c->b.slot == vessel.slot ? -1 : 0;
            for (int axis = 0; axis < 3; axis++)
                sum[axis] += sign * c->impulse[axis] / 0.02;
            ck_assert(c->normal_impulse >= 0 && c->normal_impulse <= c->limit);
            bool at_limit = c->normal_impulse > 0 && c->normal_impulse >= c->limit;
            ck_assert_int_eq(c->capped, at_limit ? FRAM_CONTACT_CRUSHING : FRAM_CONTACT_BELOW);
            capped += sign != 0 && c->capped == FRAM_CONTACT_CRUSHING;
        }
        fram_ice_load load;
        assert_ok(fram_world_ice_load(w, vessel, &load, &e), e);
        assert_array_absolute(sum, load.force, 3, 1e-6 * (1 + fabs(load.force[0]) + fabs(load.force[1])));
        fram_fracture fractures[8];
        int events = fram_world_fractures(w, fractures, 8);
        for (int k = 0; k < events && k < 8; k++) {
            assert_relative(fractures[k].pieces_area + fractures[k].area_lost - fractures[k].area_gained,
                            fractures[k].floe_area, 1e-9);
            ck_assert(fractures[k].pieces >= 1 && fractures[k].kind >= FRAM_FRACTURE_SPLIT);
        }
        broke += events;
    }
    ck_assert_int_gt(broke, 0);
    ck_assert_int_gt(capped, 0);
    assert_absolute(value(w, "splits") + value(w, "bendings"), broke, 0);
    close_world(w);
}
END_TEST

/* ---- inputs ---- */

START_TEST(a_component_that_nobody_told_goes_on)
{
    open_text(fed);
    shell("printf 'time,x,y\n0,1,0\n100,2,50\n' >%s/flow.csv%s", folder, "");
    static const char *const media[] = {"wind", "current", "ice_drift"};
    static const char *const files[] = {"environment.wind_file=flow.csv", "environment.current_file=flow.csv",
                                        "domain.drift_file=flow.csv", "domain.drift_speed=auto"};
    fram_scenario *s;
    assert_ok(fram_scenario_parse(ctx, fed, folder, files, 4, &s, &e), e);
    for (size_t i = 0; i < 3; i++) {
        fram_world *w;
        char x[24], y[24];
        snprintf(x, sizeof x, "%s_x", media[i]);
        snprintf(y, sizeof y, "%s_y", media[i]);
        assert_ok(fram_world_create(s, &w, &e), e);
        assert_bits(input(w, x), 1);
        set(w, x, 3);
        step(w, 10);
        assert_bits(input(w, x), 3);
        assert_absolute(input(w, y), 0.5 * fram_world_time(w), 1e-12);
        set(w, y, -1);
        step(w, 1);
        assert_bits(input(w, y), -1);
        fram_world_destroy(w);
    }
    fram_scenario_destroy(s);
    close_all();
}
END_TEST

START_TEST(every_input_is_state_and_has_its_effect)
{
    fram_world *a = open_world(still), *b;
    fram_body_id vessel;
    ck_assert(fram_world_vessel(a, &vessel));
    /* A steady force does what the same wrench in every step does. */
    assert_ok(fram_world_copy(a, &b, &e), e);
    set(a, "outside_force_x", 1e6);
    set(a, "outside_moment_z", 2e6);
    assert_bits(input(a, "outside_force_x"), 1e6);
    ck_assert(fram_world_hash(a) != fram_world_hash(b));
    const double force[3] = {1e6, 0, 0}, moment[3] = {0, 0, 2e6};
    for (int i = 0; i < 20; i++) {
        assert_ok(fram_body_apply_wrench(b, vessel, force, moment, &e), e);
        step(a, 1);
        step(b, 1);
    }
    assert_bits(value(a, "velocity_x"), value(b, "velocity_x"));
    assert_bits(value(a, "yaw"), value(b, "yaw"));
    ck_assert(value(a, "velocity_x") > 0.01);
    fram_world_destroy(b);
    /* A wrench that is told and not yet used is copied and saved. */
    assert_ok(fram_body_apply_wrench(a, vessel, force, moment, &e), e);
    assert_ok(fram_world_copy(a, &b, &e), e);
    step(a, 1);
    step(b, 1);
    assert_same_world(a, b);
    fram_world_destroy(b);
    fram_world_destroy(a);
    /* Current and wind carry the vessel their way; the scenario has none. */
    a = create();
    set(a, "current_y", 2);
    assert_bits(input(a, "current_y"), 2);
    assert_bits(input(a, "current_x"), 0);
    step(a, 50);
    ck_assert(value(a, "velocity_y") > 1e-4);
    fram_world_destroy(a);
    a = create();
    set(a, "wind_x", -30);
    step(a, 50);
    ck_assert(value(a, "velocity_x") < -1e-5);
    /* Thrusters: orders are followed, within what they can give. */
    set(a, "wind_x", 0);
    assert_bits(input(a, "thruster_1_order_angle"), 0);
    set(a, "thruster_1_order", 1e3);
    assert_absolute(input(a, "thruster_1_order_angle"), -10, 1e-9);
    set(a, "thruster_1_order", 0);
    set(a, "thruster_2_order", 1e12);
    double most = input(a, "thruster_2_order");
    ck_assert(most > 0 && most < 1e9);
    set(a, "thruster_2_order_angle", 80);
    assert_absolute(input(a, "thruster_2_order_angle"), 25, 1e-9);
    set(a, "thruster_1_order_angle", 80);
    assert_absolute(input(a, "thruster_1_order_angle"), 80, 1e-9);
    set(a, "thruster_1_order_angle", 15);
    assert_absolute(input(a, "thruster_1_order_angle"), 30, 1e-9);
    step(a, 50);
    ck_assert(value(a, "thruster_2_thrust") > 0 && value(a, "thruster_2_angle") > 0);
    close_world(a);
}
END_TEST

START_TEST(positioning_set_points_and_lines_are_steered)
{
    fram_world *w = open_world(busy);
    assert_bits(input(w, "positioning"), 1);
    int order = fram_world_find_input(w, "thruster_1_order");
    assert_fails(fram_world_set_input(w, order, 1e4, &e), e, FRAM_ERROR_USAGE, "positioning");
    ck_assert_str_eq(e.key, "thruster_1_order");
    set(w, "set_point_x", 12);
    set(w, "set_point_heading", 30);
    assert_absolute(input(w, "set_point_x"), 12, 0);
    assert_absolute(input(w, "set_point_heading"), 30, 1e-12);
    step(w, 1);
    assert_absolute(value(w, "offset_x"), -12, 0.5);
    assert_absolute(value(w, "heading_deviation"), -30, 1);
    step(w, 400);
    ck_assert(value(w, "demanded_force_x") > 1e4);
    set(w, "positioning", 0);
    set(w, "thruster_1_order", 1e4);
    step(w, 5);
    assert_bits(input(w, "thruster_1_order"), 1e4);
    assert_bits(value(w, "demanded_force_x"), 0);
    set(w, "positioning", 1);
    step(w, 60);
    ck_assert(input(w, "thruster_1_order") != 1e4);
    set(w, "line_2_release", 1);
    assert_bits(value(w, "lines_parted"), 0);
    step(w, 2);
    assert_bits(value(w, "lines_parted"), 1);
    assert_bits(value(w, "line_2_tension"), 0);
    assert_bits(input(w, "line_2_release"), 1);
    close_world(w);
}
END_TEST

START_TEST(towing_drift_and_paths_are_steered)
{
    fram_world *w = open_world(towed);
    assert_bits(input(w, "tow_velocity_x"), 3);  /* what its ramp leads to */
    double centre = value(w, "position_x") + 26; /* of mass, ahead of the ship's origin, which the scenario places */
    step(w, 10);
    set(w, "tow_velocity_x", 0.5);
    step(w, 2);
    assert_absolute(value(w, "velocity_x"), 0.5, 1e-6);
    double x = value(w, "position_x") - centre, now = fram_world_time(w);
    const double times[2] = {now + 0.4, now + 0.8}, places[6] = {x + 0.4, 0.2, 0, x + 0.4, 0.4, 0.1};
    assert_ok(fram_world_set_path(w, 0, times, places, 2, &e), e);
    step(w, 20);
    assert_absolute(value(w, "position_x") - centre - x, 0.4, 0.05);
    assert_absolute(value(w, "velocity_x"), 1, 0.2);
    step(w, 20);
    assert_absolute(value(w, "position_y"), 0.4 + centre * sin(0.1), 0.02);
    assert_absolute(value(w, "yaw"), 0.1 * 180 / 3.14159265358979, 0.1);
    assert_ok(fram_world_set_path(w, 0, NULL, NULL, 0, &e), e);
    step(w, 2);
    assert_absolute(value(w, "velocity_x"), 0, 1e-6);
    const double back[2] = {now, now};
    assert_fails(fram_world_set_path(w, 0, back, places, 2, &e), e, FRAM_ERROR_INPUT, "ascend");
    ck_assert_str_eq(e.key, "times");
    int tow = fram_world_find_input(w, "tow_velocity_y");
    assert_fails(fram_world_set_input(w, tow, 900, &e), e, FRAM_ERROR_INPUT, "expected");
    close_world(w);
    w = open_world(fed);
    assert_absolute(input(w, "ice_drift_x"), 3, 1e-12);
    set(w, "ice_drift_x", -1);
    set(w, "ice_drift_y", 0.5);
    step(w, 2);
    assert_absolute(value(w, "drift_x"), -1, 1e-12);
    assert_absolute(value(w, "drift_y"), 0.5, 1e-12);
    close_world(w);
}
END_TEST

/* ---- scenarios, stop flag ---- */

START_TEST(a_text_finds_its_files_from_its_folder)
{
    open_text(still);
    char base[PATH], path[PATH + 20];
    snprintf(base, sizeof base, "%s/input", folder);
    shell("mkdir -p %s && printf '0 0\\n8 0\\n8 8\\n0 8\\n\\n' >%s/floes.txt", base, base);
    fram_scenario *s;
    static const char text[] = "vessel: {present: false}\nice: {source: file, file: floes.txt}\n"
                               "domain: {x_min: -20, x_max: 20, y_min: -20, y_max: 20, boundary: open}\n";
    assert_ok(fram_scenario_parse(ctx, text, base, NULL, 0, &s, &e), e);
    snprintf(path, sizeof path, "%s/floes.txt", base);
    ck_assert_str_eq(fram_scenario_file(s, 0), path);
    ck_assert_str_eq(fram_scenario_file_key(s, 0), "ice.file");
    ck_assert_ptr_null(fram_scenario_file(s, 1));
    ck_assert_ptr_null(fram_scenario_file_key(s, -1));
    fram_world *w;
    assert_ok(fram_world_create(s, &w, &e), e);
    ck_assert_int_eq(fram_world_bodies(w, FRAM_SELECT_FLOES, NULL), 1);
    fram_world_destroy(w);
    fram_scenario_destroy(s);
    assert_fails(fram_scenario_parse(ctx, text, "/no/such", NULL, 0, &s, &e), e, FRAM_ERROR_INPUT, "");
    ck_assert_str_eq(e.file, "/no/such/(text)");
    ck_assert(e.line == 2 && strcmp(e.key, "ice.file") == 0);
    static const char *const overrides[] = {"run.time_step=-1"};
    ck_assert_int_eq(fram_scenario_parse(ctx, still, NULL, overrides, 1, &s, &e), FRAM_ERROR_INPUT);
    ck_assert_str_eq(e.key, "run.time_step");
    close_all();
}
END_TEST

/* Told from a thread of its own as soon as the run has begun: TSan looks on. */
static atomic_int begun;

static void tell_begun(void *user, const fram_progress *progress)
{
    (void)user;
    (void)progress;
    atomic_store(&begun, 1);
}

static void *stop_it(void *flag)
{
    while (!atomic_load(&begun))
        sched_yield();
    fram_stop_set(flag, 1);
    return NULL;
}

START_TEST(a_stop_flag_is_set_from_another_thread)
{
    static int flag;
    fram_stop_set(NULL, 1);
    open_text(busy);
    static const char *const overrides[] = {"run.duration=10000"};
    fram_scenario_destroy(scenario_of_test);
    assert_ok(fram_scenario_parse(ctx, busy, NULL, overrides, 1, &scenario_of_test, &e), e);
    pthread_t thread;
    ck_assert_int_eq(pthread_create(&thread, NULL, stop_it, &flag), 0);
    char run[PATH];
    snprintf(run, sizeof run, "%s/run", folder);
    fram_run_definition rd;
    fram_run_default(&rd);
    rd.folder = run;
    rd.stop = &flag;
    rd.progress = tell_begun;
    fram_run_result result = {0};
    ck_assert_int_eq(fram_run(scenario_of_test, &rd, &result, &e), FRAM_INTERRUPTED);
    ck_assert_int_eq(pthread_join(thread, NULL), 0);
    ck_assert(result.steps > 0 && !result.finished);
    close_all();
}
END_TEST

TEST_MAIN("live", a_recorded_world_leaves_what_a_run_leaves, a_recording_can_be_resumed_and_ends_with_its_world,
          random_cycles_leave_equal_states, foreign_and_damaged_states_are_refused,
          a_world_that_failed_is_not_stepped_on, channels_are_the_columns_of_the_series,
          arrays_tell_what_single_calls_tell, a_component_that_nobody_told_goes_on,
          contacts_sum_to_the_load_and_fractures_are_told, every_input_is_state_and_has_its_effect,
          positioning_set_points_and_lines_are_steered, towing_drift_and_paths_are_steered,
          a_text_finds_its_files_from_its_folder, a_stop_flag_is_set_from_another_thread)
