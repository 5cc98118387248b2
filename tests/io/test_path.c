/* io/path: a path is whole or refused, to the byte, and no output is what a run is made of. */
#include "io/path.h"
#include "scratch.h"

START_TEST(a_path_is_whole_or_refused)
{
    static char folder[PATH_ROOM], out[PATH_ROOM];
    fram_error error = {0};
    assert_ok(path_join("out/run", "run.json", out, &error), error);
    ck_assert_str_eq(out, "out/run/run.json");
    /* folder, slash, one letter and the NUL: PATH_ROOM bytes are the most. */
    memset(folder, 'a', PATH_ROOM - 3);
    assert_ok(path_join(folder, "b", out, &error), error);
    ck_assert_uint_eq(strlen(out), PATH_ROOM - 1);
    assert_fails(path_join(folder, "bc", out, &error), error, FRAM_ERROR_INPUT, "4096");
    assert_ok(path_given_or("there", folder, "bc", out, &error), error);
    ck_assert_str_eq(out, "there");
    assert_ok(path_given_or(NULL, "here", "b", out, &error), error);
    ck_assert_str_eq(out, "here/b");
    ck_assert_int_eq(path_join(folder, "bc", out, NULL), FRAM_ERROR_INPUT);
}
END_TEST

START_TEST(files_that_a_run_is_made_of_are_no_output)
{
    static char out[PATH_ROOM], around[PATH_ROOM];
    fram_error error = {0};
    scratch s = scratch_make();
    const char *own = scratch_path(&s, "series.csv");
    assert_ok(path_refuse_own(s.folder, own, &error), error); /* it is not there yet */
    scratch_write(own, "1", 1);
    assert_fails(path_given_or(own, s.folder, "run.nc", out, &error), error, FRAM_ERROR_USAGE, "made of");
    ck_assert_str_eq(error.key, "output");
    snprintf(around, sizeof around, "%s/./series.csv", s.folder);
    assert_fails(path_refuse_own(s.folder, around, &error), error, FRAM_ERROR_USAGE, "made of");
    assert_ok(path_refuse_own("/usr", own, &error), error);
    assert_ok(path_given_or(s.folder, NULL, NULL, out, &error), error);
    scratch_remove(&s, "series.csv");
}
END_TEST

START_TEST(a_path_from_the_root_is_whole_or_empty)
{
    static char before[PATH_ROOM], out[PATH_ROOM];
    ck_assert_ptr_nonnull(getcwd(before, sizeof before));
    ck_assert(path_absolute("/a/b", out, 5) && strcmp(out, "/a/b") == 0);
    ck_assert(!path_absolute("/a/b", out, 4) && !*out);
    ck_assert(chdir("/") == 0);
    ck_assert(path_absolute("a", out, 3) && strcmp(out, "/a") == 0);
    ck_assert(!path_absolute("a", out, 2) && !*out);
    ck_assert(chdir("/usr") == 0);
    ck_assert(path_absolute("a", out, 7) && strcmp(out, "/usr/a") == 0);
    ck_assert(!path_absolute("a", out, 6) && !*out);
    ck_assert(!path_absolute("a", out, 4) && !*out); /* not even the folder */
    ck_assert(chdir(before) == 0);
}
END_TEST

TEST_MAIN("path", a_path_is_whole_or_refused, files_that_a_run_is_made_of_are_no_output,
          a_path_from_the_root_is_whole_or_empty)
