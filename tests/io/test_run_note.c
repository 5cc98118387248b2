/* io/run_note: what is written of a run is what is read, however long the file is. */
#include "io/run_note.h"
#include "scratch.h"

#include "io/file.h"
#include "testing.h"

static context ctx;
static fram_error error;

static run_note full(void)
{
    run_note n;
    run_note_init(&n);
    n.threads = 3;
    n.seed = 9007199254740991;
    n.steps = 1e15;
    n.time = 12.1;
    n.recorded_from = 0;
    n.good_until = 12;
    n.wall = 1.5;
    n.step_median = n.step_p99 = n.step_p999 = n.step_longest = 0.25;
    snprintf(n.title, sizeof n.title, "tow \"A\" \\ B");
    snprintf(n.status, sizeof n.status, "failed");
    memset(n.message, 'm', sizeof n.message - 1);
    snprintf(n.state_hash, sizeof n.state_hash, "0123456789abcdef");
    const run_note_file file = {.digest = "f00d", .path = "/data/wind.csv"};
    const run_event event = {.time = 0.1,
                             .value = (double)NAN,
                             .ahead = 7,
                             .vessel = "a",
                             .other = "b",
                             .kind = "ram",
                             .text = "it \"rams\""};
    const run_track track = {.limit = 50, .rounds = 3};
    ck_assert(array_push(&ctx, &n.files, file) && array_push(&ctx, &n.files, file));
    ck_assert(array_push(&ctx, &n.events, event) && array_push(&ctx, &n.tracks, track));
    text_add(&ctx, &n.told, "wind_x\na.path\n");
    return n;
}

static void check(const run_note *n)
{
    run_note expected = full();
    ck_assert_str_eq(n->title, expected.title);
    ck_assert_str_eq(n->status, "failed");
    ck_assert_str_eq(n->message, expected.message);
    ck_assert_str_eq(n->state_hash, expected.state_hash);
    assert_bits(n->seed, expected.seed);
    assert_bits(n->steps, expected.steps);
    assert_bits(n->time, 12.1);
    assert_bits(n->recorded_from, 0);
    assert_bits(n->good_until, 12);
    assert_bits(n->step_longest, 0.25);
    ck_assert_int_eq(n->files.count, 2);
    ck_assert_str_eq(n->files.data[1].digest, "f00d");
    ck_assert_str_eq(n->files.data[1].path, "/data/wind.csv");
    ck_assert_int_eq(n->events.count, 1);
    ck_assert(n->events.data[0].time == 0.1 && isnan(n->events.data[0].value) && n->events.data[0].ahead == 7);
    ck_assert_str_eq(n->events.data[0].other, "b");
    ck_assert_str_eq(n->events.data[0].text, "it \"rams\"");
    ck_assert_int_eq(n->tracks.count, 1);
    ck_assert(n->tracks.data[0].limit == 50 && n->tracks.data[0].rounds == 3 && !n->tracks.data[0].vessel[0]);
    ck_assert_str_eq(n->told.data, "wind_x\na.path\n");
    assert_ok(run_note_check(n, "run", &error), error);
    run_note_free(&ctx, &expected);
}

START_TEST(what_is_written_is_read)
{
    scratch s = scratch_make();
    context_init(&ctx);
    run_note n = full(), back;
    char *text = NULL;
    assert_ok(run_note_write(&ctx, s.folder, &n, &error), error);
    assert_ok(run_note_read(&ctx, s.folder, &back, &error), error);
    check(&back);
    run_note_free(&ctx, &back);
    /* Larger than any that a run writes, but no larger than who goes on with a run reads. */
    assert_ok(run_note_load(&ctx, s.folder, &text, &error), error);
    ck_assert(run_note_mentions(text, "f00d") && !run_note_mentions(text, "beef"));
    size_t size = strlen(text), more = 1200000;
    FILE *file = fopen(scratch_path(&s, "run.json"), "w");
    ck_assert_ptr_nonnull(file);
    fwrite(text, 1, size - 2, file);
    fputs(",\n  \"of_a_later_version\": [\"", file);
    for (size_t i = 0; i < more; i++)
        fputc('x', file);
    fputs("\"]\n}\n", file);
    fclose(file);
    memory_free(&ctx, text);
    assert_ok(run_note_read(&ctx, s.folder, &back, &error), error);
    check(&back);
    run_note_free(&ctx, &back);
    run_note_free(&ctx, &n);
    scratch_remove(&s, "run.json");
}
END_TEST

/* Two bytes of a text become hundreds in memory. */
START_TEST(long_lists_are_refused)
{
    static const char *const lists[] = {"inputs", "events", "tracks"};
    scratch s = scratch_make();
    context_init(&ctx);
    for (int k = 0; k < 3; k++) {
        run_note n;
        FILE *file = fopen(scratch_path(&s, "run.json"), "w");
        ck_assert_ptr_nonnull(file);
        fprintf(file, "{\"%s\": [{}", lists[k]);
        for (int i = 0; i < RUN_NOTE_ITEMS_MOST; i++)
            fputs(",{}", file);
        fputs("]}\n", file);
        fclose(file);
        ck_assert_int_eq(run_note_read(&ctx, s.folder, &n, &error), FRAM_ERROR_INPUT);
        ck_assert_ptr_nonnull(strstr(error.message, "a list of 10000 at most"));
        run_note_free(&ctx, &n);
    }
    scratch_remove(&s, "run.json");
}
END_TEST

/* As by an editor of JSON that has none for an empty text. */
START_TEST(null_is_no_text)
{
    static const char text[] =
        "{\"title\": null, \"events\": [{\"kind\": \"ram\", \"vessel\": null, \"text\": null}], \"steps\": 3}\n";
    scratch s = scratch_make();
    run_note n;
    context_init(&ctx);
    scratch_write(scratch_path(&s, "run.json"), text, strlen(text));
    assert_ok(run_note_read(&ctx, s.folder, &n, &error), error);
    ck_assert_str_eq(n.title, "");
    ck_assert_int_eq(n.events.count, 1);
    ck_assert_str_eq(n.events.data[0].vessel, "");
    ck_assert_str_eq(n.events.data[0].text, "");
    assert_bits(n.steps, 3);
    run_note_free(&ctx, &n);
    scratch_remove(&s, "run.json");
}
END_TEST

/* What every run has, and what runs are told apart by. */
START_TEST(null_is_no_hash)
{
    static const char *const texts[] = {"{\"state_hash\": null}",
                                        "{\"scenario_hash\": null}",
                                        "{\"status\": null}",
                                        "{\"fram_version\": null}",
                                        "{\"inputs\": [{\"sha256\": null, \"file\": \"a\"}]}",
                                        "{\"inputs\": [{\"sha256\": \"f00d\", \"file\": null}]}",
                                        "{\"events\": [{\"kind\": null}]}"};
    scratch s = scratch_make();
    context_init(&ctx);
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        run_note n;
        scratch_write(scratch_path(&s, "run.json"), texts[i], strlen(texts[i]));
        ck_assert_msg(run_note_read(&ctx, s.folder, &n, &error) == FRAM_ERROR_INPUT, "%s", texts[i]);
        run_note_free(&ctx, &n);
    }
    scratch_remove(&s, "run.json");
}
END_TEST

TEST_MAIN("run_note", what_is_written_is_read, long_lists_are_refused, null_is_no_text, null_is_no_hash)
