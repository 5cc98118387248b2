/* Which conditions are series over one key. */
#include "testing.h"

#include "study/study_series.h"

/* A study of these values, conditions one after the other. */
static bool find(char **values, int32_t keys, int32_t conditions, study_series *out, study *s)
{
    static char *names[] = {"a", "b", "c"};
    *s = (study){.conditions = conditions,
                 .keys = {.data = names, .count = keys},
                 .values = {.data = values, .count = keys * conditions}};
    return study_series_find(s, out);
}

START_TEST(a_rising_key_is_a_series)
{
    study s;
    study_series of;
    char *rises[] = {"0.5", "1", "10"}, *falls[] = {"1", "3", "2"}, *words[] = {"open", "closed"}, *one[] = {"1"};
    ck_assert(find(rises, 1, 3, &of, &s));
    ck_assert(of.key == 0 && of.groups == 1 && of.length == 3);
    ck_assert(!find(falls, 1, 3, &of, &s));
    ck_assert(!find(words, 1, 2, &of, &s));
    ck_assert(!find(one, 1, 1, &of, &s));
}
END_TEST

START_TEST(a_grid_is_series_over_its_last_key)
{
    study s;
    study_series of;
    char *grid[] = {"thin", "1", "thin", "2", "thin", "3", "thick", "1", "thick", "2", "thick", "3"};
    ck_assert(find(grid, 2, 6, &of, &s));
    ck_assert(of.key == 1 && of.groups == 2 && of.length == 3);
    ck_assert(study_series_is_group_key(&s, &of, 0) && !study_series_is_group_key(&s, &of, 1));
    grid[9] = "2.0";
    ck_assert(find(grid, 2, 6, &of, &s));
    /* Of other speeds in the second group. */
    grid[9] = "2.5";
    ck_assert(!find(grid, 2, 6, &of, &s));
}
END_TEST

/* The faster, the shorter the run. */
START_TEST(a_key_that_goes_with_another_divides_nothing)
{
    study s;
    study_series of;
    char *table[] = {"1", "0.5", "90", "1", "0.7", "60", "2", "0.5", "90", "2", "0.7", "60"};
    ck_assert(find(table, 3, 4, &of, &s));
    ck_assert(of.key == 1 && of.groups == 2 && of.length == 2);
    ck_assert(study_series_is_group_key(&s, &of, 0) && !study_series_is_group_key(&s, &of, 2));
    /* A hypercube: each key goes its own way. */
    table[5] = "70";
    ck_assert(!find(table, 3, 4, &of, &s));
}
END_TEST

TEST_MAIN("study_series", a_rising_key_is_a_series, a_grid_is_series_over_its_last_key,
          a_key_that_goes_with_another_divides_nothing)
