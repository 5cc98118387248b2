/* A checkpoint that a run wrote is a state that a world of the same scenario takes, wherever the files of the scenario
   lie, and goes on from as the resumed run does; a state that a program saved is no checkpoint of a run. */
#include "fram/live.h"
#include "fram/results.h"
#include "scratch.h"

#include <sys/stat.h>
#include <zlib.h>

enum { ROOM = 600, HEAD_SIZE = 32, BODY_SUM_AT = 24, HEAD_SUM_AT = 28 }; /* of a checkpoint: io/table_file.h */

/* Two files, so that their order and number count. */
static const char with_files[] = "run: {duration: 1.2, time_step: 0.02}\n"
                                 "vessel:\n  mode: towed\n  x: -9\n  speed: 3\n  ramp: 0.1\n"
                                 "  hull: {form: file, file: hull.obj, draught: 2}\n"
                                 "ice: {source: file, file: floes.geojson, thickness: 0.5, breakable: true}\n"
                                 "domain: {x_min: -30, x_max: 40, y_min: -20, y_max: 20}\n";
static const char without_files[] = "run: {duration: 1.2, time_step: 0.02}\n"
                                    "vessel:\n  mode: towed\n  speed: 3\n"
                                    "  hull: {length: 20, beam: 6, draught: 2, freeboard: 2}\n"
                                    "ice: {concentration: 0.5, mean_floe_area: 16}\n"
                                    "domain: {x_min: -30, x_max: 40, y_min: -20, y_max: 20}\n";
static const char hull[] = "v -8 -3 -2\nv 8 -3 -2\nv 8 3 -2\nv -8 3 -2\nv -8 -3 2\nv 8 -3 2\nv 8 3 2\nv -8 3 2\n"
                           "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";
/* %s: where the second floe ends. */
static const char floes[] =
    "{\"type\": \"FeatureCollection\", \"features\": [\n"
    "{\"type\": \"Feature\", \"properties\": {}, \"geometry\": {\"type\": \"Polygon\", \"coordinates\":\n"
    "[[[0, -8], [12, -8], [12, 6], [0, 6], [0, -8]]]}},\n"
    "{\"type\": \"Feature\", \"properties\": {}, \"geometry\": {\"type\": \"Polygon\", \"coordinates\":\n"
    "[[[13, -8], [%s, -8], [%s, 6], [13, 6], [13, -8]]]}}]}\n";

static fram_error e;
static fram_context *ctx;
static char top[SCRATCH_FOLDER], run[300], file[ROOM];

/* Folder of the scenario's files, made when it is not there. */
static const char *place(const char *name, const char *hull_text, const char *end)
{
    static char folder[ROOM];
    char text[2000];
    snprintf(folder, sizeof folder, "%s/%s", top, name);
    (void)mkdir(folder, 0777);
    snprintf(text, sizeof text, floes, end, end);
    scratch_put(folder, "floes.geojson", text);
    scratch_put(folder, "hull.obj", hull_text);
    return folder;
}

static fram_scenario *scenario_in(const char *text, const char *folder)
{
    fram_scenario *s;
    assert_ok(fram_scenario_parse(ctx, text, folder, NULL, 0, &s, &e), e);
    return s;
}

static fram_world *world_in(const char *text, const char *folder, fram_scenario **s)
{
    fram_world *w;
    *s = scenario_in(text, folder);
    assert_ok(fram_world_create(*s, &w, &e), e);
    return w;
}

static void close_world(fram_world *w, fram_scenario *s)
{
    fram_world_destroy(w);
    fram_scenario_destroy(s);
}

/* A run that ends half way; `file` is its checkpoint. */
static void run_half(const char *text)
{
    scratch_folder(top);
    assert_ok(fram_context_create(NULL, &ctx, &e), e);
    snprintf(run, sizeof run, "%s/run", top);
    snprintf(file, sizeof file, "%s/checkpoint-000000000030.fram", run);
    fram_scenario *s = scenario_in(text, place("first", hull, "20"));
    fram_run_definition d;
    fram_run_result result;
    fram_run_default(&d);
    d.folder = run;
    d.until = 0.6;
    assert_ok(fram_run(s, &d, &result, &e), e);
    ck_assert(!result.finished && result.steps == 30);
    fram_scenario_destroy(s);
}

static fram_status resume(fram_run_result *result)
{
    fram_run_definition d;
    fram_run_default(&d);
    d.folder = run;
    return fram_resume(ctx, &d, result, &e);
}

static void close_all(void)
{
    fram_context_destroy(ctx);
    scratch_remove_folder(top);
}

static char *read_all(const char *path, size_t *size)
{
    enum { MOST = 1 << 22 };
    FILE *f = fopen(path, "rb");
    char *data = malloc(MOST);
    ck_assert(f && data);
    *size = fread(data, 1, MOST, f);
    ck_assert(*size > HEAD_SIZE && *size < MOST && fclose(f) == 0);
    return data;
}

static void go_on_from(fram_world *w, uint64_t expected)
{
    ck_assert_int_eq(fram_world_steps(w), 30);
    for (int i = 0; i < 30; i++)
        assert_ok(fram_world_step(w, &e), e);
    ck_assert_uint_eq(fram_world_hash(w), expected);
}

/* Into worlds of the run's own scenario, and of one whose files lie elsewhere; from a file and from memory. */
static void assert_goes_on_as_the_run(const char *text)
{
    run_half(text);
    size_t size;
    char *data = read_all(file, &size), own[ROOM];
    fram_run_result result;
    assert_ok(resume(&result), e);
    ck_assert(result.finished && result.steps == 60);
    FILE *f = fopen(file, "wb"); /* the resumed run has newer ones */
    ck_assert(f && fwrite(data, 1, size, f) == size && fclose(f) == 0);

    fram_scenario *s;
    fram_world *w = world_in(text, place("second", hull, "20"), &s);
    assert_ok(fram_world_load(w, file, &e), e);
    go_on_from(w, result.state_hash);
    assert_ok(fram_world_load_memory(w, data, size, &e), e);
    go_on_from(w, result.state_hash);
    close_world(w, s);

    snprintf(own, sizeof own, "%s/scenario.yaml", run);
    assert_ok(fram_scenario_load(ctx, own, NULL, 0, &s, &e), e);
    assert_ok(fram_world_create(s, &w, &e), e);
    assert_ok(fram_world_load(w, file, &e), e);
    go_on_from(w, result.state_hash);
    close_world(w, s);
    free(data);
    close_all();
}

START_TEST(a_world_goes_on_from_a_checkpoint_as_the_resumed_run)
{
    assert_goes_on_as_the_run(with_files);
    assert_goes_on_as_the_run(without_files);
}
END_TEST

/* A file of other contents: the first or the second. */
START_TEST(states_of_other_files_are_refused)
{
    run_half(with_files);
    fram_scenario *s, *other;
    fram_world *w = world_in(with_files, place("second", hull, "20"), &s);
    void *saved;
    size_t size;
    assert_ok(fram_world_save_memory(w, &saved, &size, &e), e);
    close_world(w, s);
    for (int which = 0; which < 2; which++) {
        char longer[sizeof hull + 20];
        snprintf(longer, sizeof longer, "%s%s", hull, which ? "" : "# another\n");
        w = world_in(with_files, place("third", longer, which ? "21" : "20"), &other);
        uint64_t hash = fram_world_hash(w);
        assert_fails(fram_world_load(w, file, &e), e, FRAM_ERROR_INPUT, "changed since the state was saved; restore");
        assert_fails(fram_world_load_memory(w, saved, size, &e), e, FRAM_ERROR_INPUT,
                     "changed since the state was saved; restore");
        ck_assert_uint_eq(fram_world_hash(w), hash);
        /* Nor is a record begun that would name other files than those that the world was made of. */
        fram_record_definition d;
        fram_record_default(&d);
        d.folder = place("third", hull, "19");
        d.force = true;
        assert_fails(fram_world_record(w, &d, &e), e, FRAM_ERROR_INPUT, "changed since the world was made; restore");
        close_world(w, other);
        fram_run_result result;
        place("first", longer, which ? "21" : "20");
        assert_fails(resume(&result), e, FRAM_ERROR_INPUT, "the run was started with was changed since");
    }
    fram_data_free(ctx, saved);
    close_all();
}
END_TEST

START_TEST(a_run_does_not_go_on_from_a_state_of_a_program)
{
    run_half(with_files);
    fram_scenario *s;
    fram_world *w = world_in(with_files, place("first", hull, "20"), &s);
    assert_ok(fram_world_load(w, file, &e), e);
    assert_ok(fram_world_save(w, file, &e), e);
    assert_ok(fram_world_load(w, file, &e), e);
    close_world(w, s);
    fram_run_result result;
    assert_fails(resume(&result), e, FRAM_ERROR_INPUT, "found a state that a program saved from a world");
    close_all();
}
END_TEST

static void set_sums_right(char *data, size_t size)
{
    uint32_t sum = (uint32_t)crc32_z(0, (const unsigned char *)data + HEAD_SIZE, size - HEAD_SIZE);
    memcpy(data + BODY_SUM_AT, &sum, sizeof sum);
    sum = (uint32_t)crc32_z(0, (const unsigned char *)data, HEAD_SUM_AT);
    memcpy(data + HEAD_SUM_AT, &sum, sizeof sum);
}

/* The version is another one's: told as of a state, and as of a run. */
START_TEST(states_of_other_versions_are_refused)
{
    static const char name[] = {12, 0, 0, 0, 'f', 'r', 'a', 'm', '_', 'v', 'e', 'r', 's', 'i', 'o', 'n'};
    run_half(with_files);
    fram_scenario *s;
    fram_world *w = world_in(with_files, place("first", hull, "20"), &s);
    size_t size, at = HEAD_SIZE;
    char *data = read_all(file, &size);
    while (memcmp(data + at, name, sizeof name) != 0)
        ck_assert_uint_lt(++at, size - sizeof name);
    data[at + sizeof name + sizeof(uint64_t)] = '9';
    set_sums_right(data, size);
    assert_fails(fram_world_load_memory(w, data, size, &e), e, FRAM_ERROR_INPUT, "expected a state of Fram");
    ck_assert_msg(strstr(e.message, "load it with that version") && !strstr(e.message, "run"), "%s", e.message);
    free(data);
    close_world(w, s);
    close_all();
}
END_TEST

/* A state holds no loads of its last step, so that a record from there on has no row of it; the rows that it has are
   those of the whole run, by which a moment is computed again. */
START_TEST(a_record_of_a_loaded_world_begins_with_its_first_step)
{
    enum { LINE = 1 << 14 };
    run_half(without_files);
    fram_scenario *s;
    fram_world *w = world_in(without_files, top, &s);
    fram_record_definition d;
    char late[ROOM], path[ROOM], *line = malloc(LINE), *text = NULL;
    snprintf(late, sizeof late, "%s/late", top);
    snprintf(path, sizeof path, "%s/series.csv", late);
    assert_ok(fram_world_load(w, file, &e), e);
    fram_record_default(&d);
    d.folder = late;
    assert_ok(fram_world_record(w, &d, &e), e);
    for (int i = 0; i < 30; i++)
        assert_ok(fram_world_step(w, &e), e);
    assert_ok(fram_world_record_end(w, NULL, &e), e);
    close_world(w, s);
    FILE *f = fopen(path, "r");
    ck_assert(f && line && fgets(line, LINE, f) && fgets(line, LINE, f) && fclose(f) == 0);
    ck_assert_msg(strtod(line, NULL) == 0.62, "the first row is of %.20s s", line);
    free(line);
    fram_why_definition moment;
    fram_why_default(&moment);
    moment.time = 0.9;
    assert_ok(fram_why(ctx, late, &moment, &text, &e), e);
    fram_text_free(ctx, text);
    close_all();
}
END_TEST

/* A world that loads it is as failed as the one that saved it, until it loads a good one; no run goes on from it. */
START_TEST(what_a_failed_world_saves_is_no_good_state)
{
    run_half(without_files);
    fram_scenario *s;
    fram_world *w = world_in(without_files, place("first", hull, "20"), &s), *other;
    assert_ok(fram_world_create(s, &other, &e), e);
    assert_ok(fram_world_load(w, file, &e), e);
    fram_body_id id;
    fram_body_arrays arrays = {.room = 1, .id = &id};
    ck_assert_int_gt(fram_world_bodies(w, FRAM_SELECT_FLOES, &arrays), 0);
    const double push[3] = {1e30, 0, 0}, none[3] = {0, 0, 0};
    assert_ok(fram_body_apply_wrench(w, id, push, none, &e), e);
    assert_fails(fram_world_step(w, &e), e, FRAM_ERROR_SIMULATION, "went wrong");
    void *bad;
    size_t size;
    assert_ok(fram_world_save_memory(w, &bad, &size, &e), e);
    assert_ok(fram_world_load_memory(other, bad, size, &e), e);
    ck_assert_uint_eq(fram_world_hash(other), fram_world_hash(w));
    assert_fails(fram_world_step(other, &e), e, FRAM_ERROR_USAGE, "failed");
    fram_data_free(ctx, bad);
    assert_ok(fram_world_load(other, file, &e), e);
    assert_ok(fram_world_step(other, &e), e);
    assert_ok(fram_world_save(w, file, &e), e);
    fram_run_result result;
    assert_fails(resume(&result), e, FRAM_ERROR_INPUT, "");
    fram_world_destroy(other);
    close_world(w, s);
    close_all();
}
END_TEST

/* A world that was recorded, one that is, and one that is not. */
START_TEST(the_same_state_has_the_same_bytes)
{
    run_half(without_files);
    fram_scenario *s;
    fram_world *w = world_in(without_files, place("first", hull, "20"), &s), *other;
    assert_ok(fram_world_create(s, &other, &e), e);
    fram_record_definition d;
    fram_record_default(&d);
    d.folder = run;
    d.force = true;
    assert_ok(fram_world_record(w, &d, &e), e);
    for (int turn = 0; turn < 2; turn++) {
        void *a, *b;
        size_t size_a, size_b;
        assert_ok(fram_world_step(w, &e), e);
        assert_ok(fram_world_step(other, &e), e);
        if (turn == 1)
            assert_ok(fram_world_record_end(w, NULL, &e), e);
        assert_ok(fram_world_save_memory(w, &a, &size_a, &e), e);
        assert_ok(fram_world_save_memory(other, &b, &size_b, &e), e);
        ck_assert_uint_eq(size_a, size_b);
        ck_assert_mem_eq(a, b, size_a);
        assert_ok(fram_world_load_memory(other, a, size_a, &e), e);
        ck_assert_uint_eq(fram_world_hash(other), fram_world_hash(w));
        fram_data_free(ctx, a);
        fram_data_free(ctx, b);
    }
    fram_world_destroy(other);
    close_world(w, s);
    close_all();
}
END_TEST

/* Where the list of files stands in a checkpoint, behind its size. */
static char *list_in(char *data, size_t size)
{
    static const char name[] = {6, 0, 0, 0, 'i', 'n', 'p', 'u', 't', 's'};
    for (size_t at = HEAD_SIZE; at + sizeof name < size; at++) {
        if (memcmp(data + at, name, sizeof name) == 0)
            return data + at + sizeof name + sizeof(uint64_t);
    }
    ck_abort_msg("no list of files");
    return NULL;
}

/* Any byte of the list is changed to some that might lead astray, with the checksums set right: a path is not looked
   at; anything else is refused for one of two reasons, and the world stays as it is. */
START_TEST(damaged_lists_of_files_are_refused)
{
    run_half(with_files);
    fram_scenario *s;
    fram_world *w = world_in(with_files, place("first", hull, "20"), &s);
    size_t size, start_size;
    void *start;
    assert_ok(fram_world_save_memory(w, &start, &start_size, &e), e);
    char *data = read_all(file, &size), *list = list_in(data, size);
    uint64_t length, hash = fram_world_hash(w);
    memcpy(&length, list - sizeof length, sizeof length);
    size_t first = (size_t)((char *)memchr(list, '\n', length) + 1 - list);
    ck_assert(length > 2 * 66 && first > 66 && first < length);
    static const char bad[] = {'\0', '\n', 'A', 'g', '0', ' ', '\x80', '\xff'};
    int taken = 0, told = 0;
    for (size_t at = 0; at < length; at++) {
        size_t column = at < first ? at : at - first;
        for (size_t k = 0; k < sizeof bad; k++) {
            char before = list[at];
            if (before == bad[k])
                continue;
            list[at] = bad[k];
            set_sums_right(data, size);
            fram_status status = fram_world_load_memory(w, data, size, &e);
            bool in_path = column >= 66 && before != '\n' && bad[k] != '\n';
            ck_assert_msg(status == (in_path ? FRAM_OK : FRAM_ERROR_INPUT), "byte %zu, %d: %d %s", at, bad[k], status,
                          e.message);
            if (status == FRAM_OK)
                taken++;
            else if (strstr(e.message, "expected a list of files"))
                told++;
            else
                ck_assert_msg(strstr(e.message, "was changed since"), "byte %zu, %d: %s", at, bad[k], e.message);
            list[at] = before;
            if (status == FRAM_OK)
                assert_ok(fram_world_load_memory(w, start, start_size, &e), e);
            ck_assert_uint_eq(fram_world_hash(w), hash);
        }
    }
    ck_assert_msg(taken > 0 && told > 0, "%d taken, %d told", taken, told);
    free(data);
    fram_data_free(ctx, start);
    close_world(w, s);
    close_all();
}
END_TEST

TEST_MAIN("saved_states", a_world_goes_on_from_a_checkpoint_as_the_resumed_run, states_of_other_files_are_refused,
          a_run_does_not_go_on_from_a_state_of_a_program, states_of_other_versions_are_refused,
          a_record_of_a_loaded_world_begins_with_its_first_step, what_a_failed_world_saves_is_no_good_state,
          the_same_state_has_the_same_bytes, damaged_lists_of_files_are_refused)
