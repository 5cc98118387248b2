/* io/folder: all names of a folder but its two dots; a folder that cannot be read further is no empty folder. */
#include "io/folder.h"

#include <errno.h>
#include <unistd.h>

#include "scratch.h"
#include "testing.h"

START_TEST(names_are_listed_without_dots)
{
    const char *const names[] = {"a", ".b", "..c"};
    scratch s = scratch_make();
    for (int i = 0; i < 3; i++)
        scratch_write(scratch_path(&s, names[i]), "", 0);
    DIR *dir = opendir(s.folder);
    int seen = 0, failure = -1;
    for (const char *name = folder_next(dir, &failure); name; name = folder_next(dir, &failure)) {
        for (int i = 0; i < 3; i++)
            seen += strcmp(name, names[i]) == 0 ? 1 << i : 0;
        ck_assert_str_ne(name, ".");
        ck_assert_str_ne(name, "..");
    }
    closedir(dir);
    ck_assert_int_eq(failure, 0);
    ck_assert_int_eq(seen, 7);
    for (int i = 1; i < 3; i++)
        ck_assert_int_eq(unlink(scratch_path(&s, names[i])), 0);
    scratch_remove(&s, names[0]);
}
END_TEST

START_TEST(a_failure_is_not_the_end)
{
    DIR *here = opendir(".");
    close(dirfd(here));
    int failure = 0;
    ck_assert_ptr_null(folder_next(here, &failure));
    ck_assert_int_eq(failure, EBADF);
    closedir(here);
}
END_TEST

/* Where a link leads a file can be made, but no folder; one that leads nowhere is told as who writes would. */
START_TEST(links_are_followed_to_their_place)
{
    static const struct {
        const char *name, *target, *said; /* NULL: a file can be made */
    } rows[] = {{"near", "file", NULL},
                {"next", "near", NULL},
                {"far", "none/file", "the link %s leads nowhere"},
                {"farther", "far", "the link %s leads nowhere"},
                {"round", "round", "Too many levels of symbolic links"},
                {"device", "/dev/null", NULL}};
    enum { ROWS = sizeof rows / sizeof *rows };
    fram_error error;
    scratch s = scratch_make();
    for (size_t i = 0; i < ROWS; i++)
        ck_assert_int_eq(symlink(rows[i].target, scratch_path(&s, rows[i].name)), 0);
    for (size_t i = 0; i < ROWS; i++) {
        const char *path = scratch_path(&s, rows[i].name);
        char said[512], slashed[512];
        snprintf(said, sizeof said, rows[i].said ? rows[i].said : "the link %s leads nowhere", path);
        if (rows[i].said)
            assert_fails(folder_check_place(path, false, &error), error, FRAM_ERROR_INPUT, said);
        else
            assert_ok(folder_check_place(path, false, &error), error);
        snprintf(slashed, sizeof slashed, "%s//", path);
        if (i + 1 < ROWS)
            assert_fails(folder_check_place(slashed, true, &error), error, FRAM_ERROR_INPUT,
                         "cannot make the folder: ");
    }
    for (size_t i = 1; i < ROWS; i++)
        ck_assert_int_eq(unlink(scratch_path(&s, rows[i].name)), 0);
    scratch_remove(&s, rows[0].name);
}
END_TEST

TEST_MAIN("folder", links_are_followed_to_their_place, names_are_listed_without_dots, a_failure_is_not_the_end)
