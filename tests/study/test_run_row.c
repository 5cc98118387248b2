/* Rows of a study as small files and as lines of summary.csv, and runs as processes. */
#include "scratch.h"
#include "study/processes.h"
#include "study/run_row.h"

#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

static run_row sample(void)
{
    run_row row = {.failed = true, .reason = "a \"floe\", lost", .state_hash = "0123456789abcdef"};
    for (int i = 0; i < ROW_FIGURES; i++)
        row.figure[i] = i == 3 ? (double)NAN : 1.0 / (i + 3);
    return row;
}

START_TEST(a_row_comes_back_whole_or_not_at_all)
{
    context ctx;
    context_init(&ctx);
    fram_error error = {0};
    scratch s = scratch_make();
    const char *path = scratch_path(&s, "1.row");
    for (int failed = 0; failed < 2; failed++) {
        run_row row[2] = {sample(), sample()};
        run_rows rows = {row, 2, 2}, back;
        row_file found;
        row[0].failed = row[1].failed = failed;
        snprintf(row[1].vessel, sizeof row[1].vessel, "tanker");
        row[1].figure[1] = 7;
        assert_ok(run_rows_write(&ctx, path, &rows, &error), error);
        assert_ok(run_rows_read(&ctx, path, &back, &found, &error), error);
        ck_assert_int_eq(found, ROWS_WHOLE);
        ck_assert_int_eq(back.count, 2);
        for (int k = 0; k < 2; k++) {
            ck_assert_int_eq(back.data[k].failed, failed);
            ck_assert_str_eq(back.data[k].vessel, row[k].vessel);
            ck_assert_str_eq(back.data[k].reason, row[k].reason);
            ck_assert_str_eq(back.data[k].state_hash, row[k].state_hash);
            for (int i = 0; i < ROW_FIGURES; i++)
                ck_assert(back.data[k].figure[i] == row[k].figure[i] ||
                          (isnan(back.data[k].figure[i]) && isnan(row[k].figure[i])));
        }
        ck_assert_ptr_eq(run_rows_find(&back, NULL), &back.data[0]);
        ck_assert_ptr_eq(run_rows_find(&back, "tanker"), &back.data[failed ? 0 : 1]);
        ck_assert_ptr_eq(run_rows_find(&back, "tug"), failed ? &back.data[0] : NULL);
        array_free(&ctx, &back);
    }
    /* Cut behind any of its lines, it is none. */
    size_t size;
    char *text = scratch_read(path, &size);
    for (size_t cut = 1; cut < size; cut++) {
        if (text[cut - 1] != '\n' && cut % 7)
            continue;
        run_rows back;
        row_file found = ROWS_WHOLE;
        scratch_write(path, text, cut);
        assert_ok(run_rows_read(&ctx, path, &back, &found, &error), error);
        ck_assert_msg(found == ROWS_CUT, "the first %zu of %zu bytes are taken for a row", cut, size);
    }
    /* And in no other state than these. */
    run_rows back;
    row_file found = ROWS_WHOLE;
    char *state = memchr(text, '\n', size); /* behind the mark */
    ck_assert_ptr_nonnull(state);
    state[1] = 'w';
    scratch_write(path, text, size);
    free(text);
    assert_ok(run_rows_read(&ctx, path, &back, &found, &error), error);
    ck_assert_int_eq(found, ROWS_CUT);
    remove(path);
    assert_ok(run_rows_read(&ctx, path, &back, &found, &error), error);
    ck_assert_int_eq(found, ROWS_NONE);
    /* What is no file is none either, and nobody's reader is waited for. */
    ck_assert_int_eq(mkfifo(path, 0600), 0);
    assert_fails(run_rows_read(&ctx, path, &back, &found, &error), error, FRAM_ERROR_INPUT, "found a pipe");
    ck_assert_int_eq(found, ROWS_NONE);
    scratch_remove(&s, "1.row");
}
END_TEST

/* Rows whose columns are others, or mean something else, are none of this Fram. */
START_TEST(a_row_of_another_fram_is_told_apart)
{
    static const char *const heads[] = {"fram study row 7", "fram study row 99, mechanisms 1",
                                        "fram study row 8, mechanisms 0", "fram study row 8"};
    context ctx;
    context_init(&ctx);
    fram_error error = {0};
    scratch s = scratch_make();
    run_row row = sample();
    run_rows rows = {&row, 1, 1};
    text_buffer text = {0};
    run_rows_text(&ctx, &rows, &text);
    const char *behind = strchr(text.data, '\n');
    ck_assert_ptr_nonnull(behind);
    for (size_t i = 0; i < sizeof heads / sizeof *heads; i++) {
        run_rows back;
        row_file found = ROWS_WHOLE;
        char all[4096];
        ck_assert_int_lt(snprintf(all, sizeof all, "%s%s", heads[i], behind), (int)sizeof all);
        scratch_put(s.folder, "1.row", all);
        assert_ok(run_rows_read(&ctx, scratch_path(&s, "1.row"), &back, &found, &error), error);
        ck_assert_msg(found == ROWS_OTHER, "%s", heads[i]);
    }
    text_free(&ctx, &text);
    scratch_remove(&s, "1.row");
}
END_TEST

START_TEST(quotation_marks_are_doubled_in_a_line)
{
    context ctx;
    context_init(&ctx);
    run_row row = sample();
    text_buffer line = {0};
    run_row_line(&ctx, &row, &line);
    ck_assert_msg(strncmp(line.data, ",failed,0.333", 13) == 0, "%s", line.data);
    ck_assert_ptr_nonnull(strstr(line.data, ",0123456789abcdef,\"a \"\"floe\"\", lost\"\n"));
    text_free(&ctx, &line);
}
END_TEST

static void assert_log(const char *path, const char *first_line)
{
    char line[64] = "";
    FILE *file = fopen(path, "r");
    ck_assert_ptr_nonnull(file);
    ck_assert_ptr_nonnull(fgets(line, sizeof line, file));
    ck_assert_str_eq(line, first_line);
    fclose(file);
}

static void wait_for(process_pool *all, int32_t *task, int *code)
{
    while (!processes_ended(all, task, code))
        nanosleep(&(struct timespec){.tv_nsec = 1000000}, NULL);
}

/* How a process ended: by its own code, or by a signal; what it said is in its log. */
START_TEST(processes_tell_how_they_ended)
{
    static const struct {
        const char *script;
        int code;
    } cases[] = {{"exit 0", 0}, {"echo the reason >&2; exit 7", 7}, {"kill -9 $$", 128 + 9}, {"kill -15 $$", 128 + 15}};
    context ctx;
    context_init(&ctx);
    scratch s = scratch_make();
    const char *log = scratch_path(&s, "1.log");
    for (int32_t i = 0; i < 4; i++) {
        process_pool all = {0};
        fram_error error = {0};
        const char *const words[] = {"/bin/sh", "-c", cases[i].script, NULL};
        int32_t task = -1;
        int code = -1;
        assert_ok(processes_start(&ctx, &all, words, log, 10 + i, &error), error);
        wait_for(&all, &task, &code);
        ck_assert_int_eq(task, 10 + i);
        ck_assert_int_eq(code, cases[i].code);
        ck_assert_int_eq(all.running.count, 0);
        if (cases[i].code == 7)
            assert_log(log, "the reason\n");
        processes_free(&ctx, &all);
    }
    scratch_remove(&s, "1.log");
}
END_TEST

/* A log that cannot be written is told as that, not as a program that does not start; and a log has its text where who
   started the study has closed standard input. */
START_TEST(a_log_is_opened_by_its_own_name)
{
    static const char *const words[] = {"/bin/sh", "-c", "echo the reason >&2", NULL};
    context ctx;
    context_init(&ctx);
    process_pool all = {0};
    fram_error error = {0};
    scratch s = scratch_make();
    const char *log = scratch_path(&s, "1.log");
    ck_assert_int_ne(processes_start(&ctx, &all, words, "/nonexistent/log", 0, &error), FRAM_OK);
    ck_assert_str_eq(error.file, "/nonexistent/log");
    ck_assert_int_eq(all.running.count, 0);
    int kept = dup(STDIN_FILENO), code = -1;
    int32_t task = -1;
    close(STDIN_FILENO);
    assert_ok(processes_start(&ctx, &all, words, log, 0, &error), error);
    if (kept >= 0) {
        ck_assert_int_eq(dup2(kept, STDIN_FILENO), STDIN_FILENO);
        close(kept);
    }
    wait_for(&all, &task, &code);
    assert_log(log, "the reason\n");
    processes_free(&ctx, &all);
    scratch_remove(&s, "1.log");
}
END_TEST

/* One split, two that bent, and a part of a sheet that came loose, which is no floe that broke. */
START_TEST(parts_that_came_loose_are_no_floes_that_broke)
{
    static const char *const files[][2] = {{"run.json", "{\"status\": \"finished\", \"steps\": 400, \"time_s\": 4}\n"},
                                           {"scenario.yaml", "vessel: {present: false}\n"},
                                           {"series.csv", "time[s]\n4\n"},
                                           {"fractures.csv", "time[s],kind[1]\n1,2\n2,1\n3,3\n4,2\n"}};
    context ctx;
    context_init(&ctx);
    char folder[SCRATCH_FOLDER];
    run_rows rows = {0};
    fram_error error = {0};
    scratch_folder(folder);
    for (int i = 0; i < 4; i++)
        scratch_put(folder, files[i][0], files[i][1]);
    /* It has ended, and counts though the program asks to stop. */
    static const int stop = 1;
    ctx.stop = &stop;
    assert_ok(run_rows_of(&ctx, folder, &rows, &error), error);
    ck_assert(ctx.stop == &stop);
    ck_assert_int_eq(rows.count, 1);
    ck_assert_double_eq(rows.data[0].figure[ROW_fractures], 3);
    array_free(&ctx, &rows);
    scratch_remove_folder(folder);
}
END_TEST

/* A signal, and a stop, are told as what they are; there is no run.json that would say more. */
START_TEST(failures_without_a_word_tell_how_they_ended)
{
    static const struct {
        int code;
        const char *reason;
    } cases[] = {{7, "it ended with exit code 7"},
                 {130, "it was stopped before its end, as by a limit of time"},
                 {137, "it was killed by signal 9, as where memory runs out or a task is lost"}};
    context ctx;
    context_init(&ctx);
    for (int i = 0; i < 3; i++) {
        run_rows rows = {0};
        fram_error error;
        assert_ok(run_rows_failed(&ctx, "/nonexistent", cases[i].code, &rows, &error), error);
        ck_assert(rows.data[0].failed);
        ck_assert_str_eq(rows.data[0].reason, cases[i].reason);
        array_free(&ctx, &rows);
    }
}
END_TEST

/* As many at a time as memory holds, where that is known; one always. */
START_TEST(processes_fit_the_memory)
{
    ck_assert_int_eq(processes_that_fit(8, 32e9, 10e9), 3);
    ck_assert_int_eq(processes_that_fit(8, 32e9, 4e9), 8);
    ck_assert_int_eq(processes_that_fit(8, 32e9, 1e6), 8);
    ck_assert_int_eq(processes_that_fit(8, 1e9, 10e9), 1);
    ck_assert_int_eq(processes_that_fit(8, 0, 10e9), 8);
    ck_assert_int_eq(processes_that_fit(8, 32e9, 0), 8);
    ck_assert_double_gt(processes_memory(), 1e7);
    ck_assert_double_lt(processes_memory(), 1e15);
}
END_TEST

TEST_MAIN("run row", a_row_comes_back_whole_or_not_at_all, a_row_of_another_fram_is_told_apart,
          quotation_marks_are_doubled_in_a_line, processes_tell_how_they_ended, a_log_is_opened_by_its_own_name,
          failures_without_a_word_tell_how_they_ended, parts_that_came_loose_are_no_floes_that_broke,
          processes_fit_the_memory)
