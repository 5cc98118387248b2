/* What a build says of itself. */
#include "base/build_parts.h"
#include "fram/version.h"
#include "testing.h"
#include <stdio.h>

START_TEST(parts_name_what_the_build_cannot_do_without)
{
    ck_assert_ptr_nonnull(strstr(build_parts(), "geos "));
    ck_assert_ptr_nonnull(strstr(build_parts(), "libfyaml "));
    ck_assert_ptr_nonnull(strstr(build_parts(), "libpng "));
    ck_assert_ptr_nonnull(strstr(build_parts(), "nettle "));
    ck_assert_ptr_nonnull(strstr(build_parts(), "zlib "));
    ck_assert_int_ne(build_parts()[0], ',');
    ck_assert_int_ne(build_parts()[0], ' ');
}
END_TEST

START_TEST(compiler_is_named)
{
    ck_assert(strncmp(build_compiler(), "gcc ", 4) == 0 || strncmp(build_compiler(), "clang ", 6) == 0);
}
END_TEST

START_TEST(version_is_its_three_numbers)
{
    char text[32];
    snprintf(text, sizeof text, "%d.%d.%d", FRAM_VERSION_MAJOR, FRAM_VERSION_MINOR, FRAM_VERSION_PATCH);
    ck_assert_str_eq(text, FRAM_VERSION);
}
END_TEST

TEST_MAIN("build_parts", parts_name_what_the_build_cannot_do_without, compiler_is_named, version_is_its_three_numbers)
