#include "base/sort.h"

#include "base/random.h"
#include "testing.h"

START_TEST(numbers_come_in_order_and_none_is_lost)
{
    enum { MOST = 200 };
    random_stream draw = random_begin(3, 0, 0);
    for (int count = 0; count <= MOST; count++) {
        double value[MOST + 1], sum = 0, sorted = 0;
        for (int i = 0; i < count; i++) { /* many of them equal */
            value[i] = floor(random_uniform(&draw, -20, 20));
            sum += value[i];
        }
        numbers_sort(value, count);
        for (int i = 0; i < count; i++) {
            ck_assert(i == 0 || value[i - 1] <= value[i]);
            sorted += value[i];
        }
        assert_bits(sorted, sum);
    }
    double far[] = {1, HUGE_VAL, -HUGE_VAL, 1e-300, -1e300};
    numbers_sort(far, 5);
    assert_bits(far[0], -HUGE_VAL);
    assert_bits(far[1], -1e300);
    assert_bits(far[4], HUGE_VAL);
    numbers_sort(NULL, 0);
}
END_TEST

START_TEST(the_median_lies_between_the_two_in_the_middle)
{
    const double value[] = {1, 2, 4, 9, HUGE_VAL, HUGE_VAL};
    ck_assert(isnan(numbers_median(value, 0)));
    assert_bits(numbers_median(value, 1), 1);
    assert_bits(numbers_median(value, 2), 1.5);
    assert_bits(numbers_median(value, 3), 2);
    assert_bits(numbers_median(value, 4), 3);
    assert_bits(numbers_median(value + 3, 2), HUGE_VAL);
    assert_bits(numbers_median(value + 4, 2), HUGE_VAL);
}
END_TEST

TEST_MAIN("sort", numbers_come_in_order_and_none_is_lost, the_median_lies_between_the_two_in_the_middle)
