/* Which conditions are compared, and intervals of differences against scipy's of the sleep data of Student (1908). */
#include "testing.h"

#include "study/differences.h"
#include "study/study_page_parts.h"

/* Hours of sleep that each of ten patients gained by either drug (Cushny and Peebles 1905). */
static const double left[10] = {0.7, -1.6, -0.2, -1.2, -0.1, 3.4, 3.7, 0.8, 0.0, 2.0};
static const double right[10] = {1.9, 0.8, 1.1, 0.1, -0.1, 4.4, 5.5, 1.6, 4.6, 3.4};

/* scipy.stats.ttest_rel(right, left).confidence_interval(): 0.7001142367452712 to 2.459885763254729. */
START_TEST(pairs_are_compared_one_by_one)
{
    int32_t pairs = 0;
    seed_interval of = difference_of_pairs(right, left, 10, 0.95, &pairs);
    ck_assert_int_eq(pairs, 10);
    assert_relative(of.mean, 1.58, 1e-12);
    assert_relative(of.half, 0.8798857632547289, 1e-9);
    /* A run that failed takes its pair with it. */
    double holes[10];
    memcpy(holes, left, sizeof holes);
    holes[4] = (double)NAN;
    of = difference_of_pairs(right, holes, 10, 0.95, &pairs);
    ck_assert_int_eq(pairs, 9);
    assert_relative(of.mean, 15.8 / 9, 1e-12);
    ck_assert(isnan(difference_of_pairs(right, left, 1, 0.95, &pairs).half));
    ck_assert(isnan(difference_of_pairs(right, left, 0, 0.95, &pairs).mean));
}
END_TEST

/* scipy.stats.ttest_ind(right, left, equal_var=False): t 1.8608134674868526 = 1.58/0.849091017238762, by 17.776473516
   degrees; of the first six of the right t is 0.7007123349443485, by 11.385451556; Student's of 17 and 11 by
   scipy.stats.t. */
START_TEST(means_without_pairs_are_compared_by_welch)
{
    int32_t freedom = 0;
    seed_interval of = difference_of_means(right, 10, left, 10, 0.95, &freedom);
    ck_assert_int_eq(freedom, 17);
    assert_relative(of.mean, 1.58, 1e-12);
    assert_relative(of.half, 1.7914254551685618, 1e-9);
    of = difference_of_means(right, 6, left, 10, 0.95, &freedom);
    ck_assert_int_eq(freedom, 11);
    assert_relative(of.mean, 0.6166666666666669, 1e-12);
    assert_relative(of.half, 1.936991992811071, 1e-9);
    const double equal[3] = {2, 2, 2}, other[2] = {1, 1};
    of = difference_of_means(equal, 3, other, 2, 0.95, &freedom);
    ck_assert_int_eq(freedom, 3);
    ck_assert(of.mean == 1 && of.half == 0);
    double row[94];
    for (int i = 0; i < 94; i++)
        row[i] = i % 2;
    of = difference_of_means(row, 94, other, 2, 0.95, &freedom);
    ck_assert_int_eq(freedom, 93);
    const double small[2] = {1e-90, 3e-90}, still[2] = {0, 0};
    of = difference_of_means(small, 2, still, 2, 0.95, &freedom);
    ck_assert_int_eq(freedom, 1);
    ck_assert(isfinite(of.half));
    ck_assert(isnan(difference_of_means(right, 1, left, 10, 0.95, &freedom).half));
    /* Their squares are no numbers. */
    const double large[2] = {1e160, 3e160};
    of = difference_of_means(large, 2, other, 2, 0.95, &freedom);
    ck_assert(isnan(of.half) && freedom == 0);
    assert_relative(of.mean, 2e160, 1e-12);
    ck_assert(isnan(difference_of_pairs(large, other, 2, 0.95, &freedom).half));
}
END_TEST

static void assert_pairs(char **values, int32_t keys, int32_t conditions, const condition_pair *expected, int32_t count)
{
    static char *names[] = {"a", "b", "c"};
    const study s = {.conditions = conditions,
                     .keys = {.data = names, .count = keys},
                     .values = {.data = values, .count = keys * conditions}};
    context ctx;
    context_init(&ctx);
    condition_pairs found = {0};
    ck_assert(study_pairs(&ctx, &s, &found));
    ck_assert_int_eq(found.count, count);
    for (int32_t i = 0; i < count; i++) {
        ck_assert_int_eq(found.data[i].condition, expected[i].condition);
        ck_assert_int_eq(found.data[i].reference, expected[i].reference);
        ck_assert_int_eq(found.data[i].key, expected[i].key);
    }
    array_free(&ctx, &found);
}

START_TEST(conditions_that_differ_in_one_key_are_compared)
{
    char *grid[] = {"1", "x", "1", "y", "2", "x", "2", "y"};
    const condition_pair of_grid[] = {{1, 0, 1}, {2, 0, 0}, {3, 1, 0}, {3, 2, 1}};
    assert_pairs(grid, 2, 4, of_grid, 4);
    /* The first that is alike, not the one before. */
    char *row[] = {"1", "2", "3"};
    const condition_pair of_row[] = {{1, 0, 0}, {2, 0, 0}};
    assert_pairs(row, 1, 3, of_row, 2);
    char *two[] = {"1", "x", "2", "y"};
    const condition_pair of_two[] = {{1, 0, -1}};
    assert_pairs(two, 2, 2, of_two, 1);
    char *cube[] = {"1", "x", "2", "y", "3", "z"};
    const condition_pair of_cube[] = {{1, 0, -1}, {2, 0, -1}, {2, 1, -1}};
    assert_pairs(cube, 2, 3, of_cube, 3);
    /* One icebreaker, two others, none: one of them hangs together with none by one key. */
    char *fleet[] = {"yes", "no", "no", "no", "yes", "yes", "no", "no", "no"};
    const condition_pair of_fleet[] = {{1, 0, -1}, {2, 0, 0}, {2, 1, -1}};
    assert_pairs(fleet, 3, 3, of_fleet, 3);
    char *many[] = {"1", "a", "2", "b", "3", "c", "4", "d", "5", "e", "6", "f", "7", "g"};
    assert_pairs(many, 2, 7, NULL, 0);
    /* Numbers are what they are, however they are written; words are not. */
    char *written[] = {"3.2", "0.5", "100", "0.50", "1e2", "0.7"};
    const condition_pair of_written[] = {{1, 0, 0}, {2, 1, 1}};
    assert_pairs(written, 2, 3, of_written, 2);
    char *names_alike[] = {"1", "x0.5", "2", "x0.50"};
    assert_pairs(names_alike, 2, 2, of_two, 1);
    char *same[] = {"1", "x", "1", "x"};
    assert_pairs(same, 2, 2, NULL, 0);
}
END_TEST

START_TEST(a_grid_is_one_however_its_numbers_are_written)
{
    char *names[] = {"a", "b"}, *values[] = {"0.5", "1", "0.50", "2", "5e-1", "3", "2", "1.0", "2", "2.0", "2", "3.0"};
    const study s = {.conditions = 6, .keys = {.data = names, .count = 2}, .values = {.data = values, .count = 12}};
    page_heat heat;
    ck_assert(page_heat_find(&s, &heat));
    ck_assert(heat.rows == 2 && heat.columns == 3);
    values[9] = "2x";
    ck_assert(!page_heat_find(&s, &heat));
}
END_TEST

TEST_MAIN("differences", pairs_are_compared_one_by_one, means_without_pairs_are_compared_by_welch,
          conditions_that_differ_in_one_key_are_compared, a_grid_is_one_however_its_numbers_are_written)
