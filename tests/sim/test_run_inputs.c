/* What a list of files says of their contents, and what a run does with files that have the names of its own. */
#include "io/path.h"
#include "io/run_files.h"
#include "io/scenario_file.h"
#include "scratch.h"
#include "sim/run_folder.h"
#include "sim/run_inputs.h"
#include <stdio.h>
#include <unistd.h>

#define ONE "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad" /* of "abc": FIPS 180-4, B.1 */
#define TWO "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1" /* B.2 */

static fram_status digest_of(context *ctx, const char *text, char out[SHA256_TEXT_SIZE], fram_error *error)
{
    return run_inputs_digest(ctx, text, strlen(text), out, error);
}

START_TEST(contents_count_and_places_do_not)
{
    context ctx;
    context_init(&ctx);
    fram_error error = {0};
    char expected[SHA256_TEXT_SIZE], found[SHA256_TEXT_SIZE];
    sha256_text(ONE TWO, strlen(ONE TWO), expected);
    assert_ok(digest_of(&ctx, ONE "  /here/hull.obj\n" TWO "  /here/floes.geojson\n", found, &error), error);
    ck_assert_str_eq(found, expected);
    assert_ok(digest_of(&ctx, ONE "  /a place/\xc3\xb8.obj\n" TWO "  x\n", found, &error), error);
    ck_assert_str_eq(found, expected);
    assert_ok(digest_of(&ctx, TWO "  /here/hull.obj\n" ONE "  /here/floes.geojson\n", found, &error), error);
    ck_assert_str_ne(found, expected);
    assert_ok(digest_of(&ctx, expected, found, &error), error);
    ck_assert_str_eq(found, expected);
    /* Of no file: SHA-256 of nothing. */
    assert_ok(run_inputs_digest(&ctx, NULL, 0, found, &error), error);
    ck_assert_str_eq(found, "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
}
END_TEST

START_TEST(other_texts_are_refused)
{
    context ctx;
    context_init(&ctx);
    static const char *const bad[] = {"\n",
                                      "x",
                                      ONE "\n",
                                      ONE "  ",
                                      ONE "  \n",
                                      ONE "  /hull.obj",
                                      ONE " \t/hull.obj\n",
                                      ONE "  /hull.obj\n\n",
                                      ONE "  /hull.obj\n" ONE,
                                      "BA7816BF8F01CFEA414140DE5DAE2223B00361A396177A9CB410FF61F20015AD",
                                      "ga7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad  /hull.obj\n"};
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        fram_error error = {0};
        char found[SHA256_TEXT_SIZE] = "";
        assert_fails(digest_of(&ctx, bad[i], found, &error), error, FRAM_ERROR_INPUT, "expected a list of files");
        ck_assert_str_eq(found, "");
    }
}
END_TEST

START_TEST(memory_runs_out)
{
    for (failing_turn turn = {0}; failing_next(&turn);) {
        char found[SHA256_TEXT_SIZE];
        turn.status = digest_of(&turn.ctx, ONE "  /hull.obj\n" TWO "  /floes.geojson\n", found, &turn.error);
        if (turn.status == FRAM_OK)
            ck_assert_int_gt(turn.n, 1);
    }
}
END_TEST

/* A file that was looked at is not read again: it may be gone. */
START_TEST(files_that_are_known_are_not_read)
{
    context ctx;
    context_init(&ctx);
    fram_error error = {0};
    char name[] = "/tmp/fram_test_XXXXXX", text[200], expected[200];
    int file = mkstemp(name);
    ck_assert_int_ge(file, 0);
    ck_assert_int_eq(write(file, "abc", 3), 3);
    ck_assert_int_eq(close(file), 0);
    snprintf(text, sizeof text, "ice: {source: file, file: %s}\n", name);
    snprintf(expected, sizeof expected, ONE "  %s\n", name);
    scenario s;
    text_buffer known = {0}, first = {0}, again = {0}, alone = {0};
    assert_ok(scenario_parse(&ctx, "s.yaml", text, strlen(text), NULL, &s, &error), error);
    assert_ok(run_inputs_list(&ctx, &s, &known, &first, &error), error);
    ck_assert_int_eq(unlink(name), 0);
    assert_ok(run_inputs_list(&ctx, &s, &known, &again, &error), error);
    ck_assert_str_eq(first.data, expected);
    ck_assert_str_eq(again.data, expected);
    ck_assert_str_eq(known.data, expected);
    ck_assert_int_eq(run_inputs_list(&ctx, &s, NULL, &alone, &error), FRAM_ERROR_INPUT);
    text_free(&ctx, &known);
    text_free(&ctx, &first);
    text_free(&ctx, &again);
    text_free(&ctx, &alone);
    scenario_free(&ctx, &s);
}
END_TEST

static void write_file(const char *folder, const char *name, const char *ending, char path[PATH_ROOM])
{
    snprintf(path, PATH_ROOM, "%s/%s%s", folder, name, ending);
    scratch_text(path, "{\n  \"fram_version\": ");
}

/* Whether it was there; it no longer is. */
static bool take_away(const char *folder, const char *name, const char *ending)
{
    char path[PATH_ROOM];
    snprintf(path, PATH_ROOM, "%s/%s%s", folder, name, ending);
    return unlink(path) == 0;
}

START_TEST(files_of_a_run_are_those_of_one_table)
{
    static const char half[] = ".0123456789abcdef.new", old[] = "peaks.fram.new", other[] = "mine.csv";
    context ctx;
    context_init(&ctx);
    fram_error error = {0};
    char folder[SCRATCH_FOLDER], path[PATH_ROOM], line[PATH_ROOM + 80];
    const run_file *f;
    int lock = -1, rows = 0;
    scratch_folder(folder);
    for (; (f = run_file_at(rows)) != NULL; rows++) {
        ck_assert_ptr_eq(run_file_find(f->name), f);
        write_file(folder, f->name, half, path);
        write_file(folder, f->name, "", path);
        snprintf(line, sizeof line, ONE "  %s\n", path);
        ck_assert_int_eq(run_folder_refuse_inputs(folder, line, &error), f->written ? FRAM_ERROR_USAGE : FRAM_OK);
        ck_assert_int_eq(path_is_own(folder, path), f->source);
    }
    ck_assert_int_gt(rows, 15);
    ck_assert_ptr_null(run_file_find(other));
    write_file(folder, old, "", path);
    write_file(folder, other, "", path);
    assert_ok(run_folder_prepare(&ctx, folder, true, NULL, &lock, &error), error);
    run_folder_unlock(lock);
    for (rows = 0; (f = run_file_at(rows)) != NULL; rows++) {
        ck_assert_msg(take_away(folder, f->name, "") == (f->end == RUN_FILE_STAYS), "%s", f->name);
        ck_assert_msg(take_away(folder, f->name, half) == !f->in_one_go, "%s%s", f->name, half);
    }
    ck_assert(!take_away(folder, old, "") && take_away(folder, other, ""));
    ck_assert_int_eq(rmdir(folder), 0);
}
END_TEST

TEST_MAIN("run_inputs", contents_count_and_places_do_not, other_texts_are_refused, memory_runs_out,
          files_that_are_known_are_not_read, files_of_a_run_are_those_of_one_table)
