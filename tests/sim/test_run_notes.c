/* sim/run_summary: run.json is JSON whatever a run comes to, and its texts read back as they were. */
#include "sim/run_summary.h"

#include "io/file.h"
#include "io/json_walk.h"
#include "scratch.h"

#include <math.h>
#include <string.h>
#include <unistd.h>

/* The member of an object, however deep; the walk is then at its value. */
static void find(json_walk *w, const char *name, fram_error *error)
{
    char key[64] = "", text[64];
    snprintf(text, sizeof text, "no member %s", name);
    json_loop loop = json_walk_into(w, JSON_OBJECT, error);
    while (json_walk_next_member(w, &loop, key, sizeof key, error) && strcmp(key, name) != 0)
        loop.status = json_walk_skip(w, error);
    assert_ok(loop.status, *error);
    ck_assert_msg(strcmp(key, name) == 0, "%s", text);
}

START_TEST(what_is_no_number_is_null)
{
    static const char title[] = "tow \"A\" \\ B", message[] = "body 3 is at (nan, 1)\nin \"ice\"";
    context ctx;
    fram_error error = {0};
    context_init(&ctx);
    scenario s;
    scenario_defaults(&s, 30);
    snprintf(s.title, sizeof s.title, "%s", title);
    static world w;
    ck_assert(event_add(&ctx, &w.events, EVENT_BESET, 1.5, 0, 0, (double)NAN));
    w.events.ahead[0] = HUGE_VAL;
    ck_assert(table_resize(&ctx, &w.clock, &clock_table_info, 1));
    w.clock.time[0] = (double)NAN;
    const time_ranks times = {0};
    const run_summary summary = {.status = "failed",
                                 .message = message,
                                 .recorded_from = -1,
                                 .good_until = (double)NAN,
                                 .inputs = "",
                                 .step_times = &times};
    char folder[SCRATCH_FOLDER], path[SCRATCH_PATH], text[64], *data = NULL;
    scratch_folder(folder);
    snprintf(path, sizeof path, "%s/run.json", folder);
    assert_ok(run_summary_write(&ctx, folder, &s, &w, &summary, &error), error);
    size_t size = 0;
    assert_ok(file_read(&ctx, path, 1 << 20, &data, &size, &error), error);
    const json_walk begin = json_walk_begin(path, data, size, 8);
    json_walk at = begin;
    assert_ok(json_walk_skip(&at, &error), error); /* all of it is JSON */
    assert_ok(json_walk_end(&at, &error), error);
    at = begin;
    find(&at, "title", &error);
    assert_ok(json_walk_text(&at, text, sizeof text, &error), error);
    ck_assert_str_eq(text, title);
    at = begin;
    find(&at, "message", &error);
    assert_ok(json_walk_text(&at, text, sizeof text, &error), error);
    ck_assert_str_eq(text, message);
    static const char *const missing[] = {"good_until_s", "time_s"};
    for (int i = 0; i < 2; i++) {
        double value = 7;
        at = begin;
        find(&at, missing[i], &error);
        assert_ok(json_walk_number_or_null(&at, &value, &error), error);
        ck_assert(isnan(value));
    }
    memory_free(&ctx, data);
    table_free(&ctx, &w.clock, &clock_table_info);
    table_free(&ctx, &w.events, &event_table_info);
    ck_assert_int_eq(unlink(path), 0);
    ck_assert_int_eq(rmdir(folder), 0);
}
END_TEST

TEST_MAIN("run_notes", what_is_no_number_is_null)
