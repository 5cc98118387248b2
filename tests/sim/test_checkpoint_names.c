/* Which files of a folder are checkpoints: those that a run has named. */
#include "sim/checkpoint.h"
#include "testing.h"

START_TEST(names_as_they_are_written)
{
    static const char *const names[] = {"checkpoint-000000000000.fram", "checkpoint-000000001234.fram",
                                        "checkpoint-999999999999.fram", "checkpoint-1000000000000.fram",
                                        "checkpoint-9223372036854775807.fram"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        ck_assert_msg(checkpoint_is_name(names[i]), "%s", names[i]);
}
END_TEST

START_TEST(names_of_others)
{
    static const char *const names[] = {"checkpoint-12.fram",
                                        "checkpoint-99999999999.fram",
                                        "checkpoint- 12.fram",
                                        "checkpoint-          12.fram",
                                        "checkpoint-+00000000012.fram",
                                        "checkpoint--00000000012.fram",
                                        "checkpoint-0000000000012.fram",
                                        "checkpoint-9223372036854775808.fram",
                                        "checkpoint-99999999999999999999999.fram",
                                        "checkpoint-000000001234.fram.new",
                                        "checkpoint-000000001234",
                                        "checkpoint-.fram",
                                        " checkpoint-000000001234.fram",
                                        ""};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        ck_assert_msg(!checkpoint_is_name(names[i]), "%s", names[i]);
}
END_TEST

TEST_MAIN("names of checkpoints", names_as_they_are_written, names_of_others)
