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

TEST_MAIN("folder", names_are_listed_without_dots, a_failure_is_not_the_end)
