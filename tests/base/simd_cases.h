/* The tests of simd.h, against plain loops over lanes; included by one program per instruction set. */
#include "base/random.h"
#include "base/simd.h"
#include "testing.h"

/* Awkward numbers first, then any. */
static void lanes_draw(random_stream *r, double lane[8])
{
    static const double awkward[] = {0.0, -0.0, HUGE_VAL, -HUGE_VAL, (double)NAN, 0x1p-1074, 1, -1, 1e308};
    for (int i = 0; i < 8; i++) {
        uint64_t which = random_bits(r) % 18;
        lane[i] = which < 9 ? awkward[which] : random_uniform(r, -10, 10);
    }
}

/* NaN made by an operation may have either sign: only that it is one counts. */
#define ASSERT_LANES(vector, expression)                                                \
    do {                                                                                \
        double found_lanes_[8];                                                         \
        v8_store(found_lanes_, (vector));                                               \
        for (int i = 0; i < 8; i++) {                                                   \
            double expected_lane_ = (expression);                                       \
            if (found_lanes_[i] == found_lanes_[i] || expected_lane_ == expected_lane_) \
                assert_bits(found_lanes_[i], expected_lane_);                           \
        }                                                                               \
    } while (0)

/* Zeros are among the lanes, and the quotient by zero is compared too: the sanitizer need not warn of it. */
__attribute__((no_sanitize("float-divide-by-zero"))) static double quotient(double a, double b) { return a / b; }

START_TEST(arithmetic_is_that_of_single_lanes)
{
    random_stream r = random_begin(1, 0, 0);
    for (int n = 0; n < 1000; n++) {
        double x[8], y[8], lo[8];
        lanes_draw(&r, x);
        lanes_draw(&r, y);
        for (int i = 0; i < 8; i++)
            lo[i] = random_uniform(&r, -3, 3);
        v8 a = v8_load(x), b = v8_load(y);
        ASSERT_LANES(a + b, x[i] + y[i]);
        ASSERT_LANES(a - b, x[i] - y[i]);
        ASSERT_LANES(a * b, x[i] * y[i]);
        ASSERT_LANES(a / b, quotient(x[i], y[i]));
        ASSERT_LANES(2 * a, 2 * x[i]);
        ASSERT_LANES(-a, -x[i]);
        ASSERT_LANES(a * b + a, x[i] * y[i] + x[i]);
        ASSERT_LANES(v8_min(a, b), x[i] < y[i] ? x[i] : y[i]);
        ASSERT_LANES(v8_max(a, b), x[i] > y[i] ? x[i] : y[i]);
        ASSERT_LANES(v8_abs(a), fabs(x[i]));
        ASSERT_LANES(v8_sqrt(a), sqrt(x[i]));
        ASSERT_LANES(v8_set(x[3]), x[3]);
        double sum = ((lo[0] + lo[1]) + (lo[2] + lo[3])) + ((lo[4] + lo[5]) + (lo[6] + lo[7]));
        assert_bits(v8_sum(v8_load(lo)), sum);
    }
}
END_TEST

START_TEST(masks_choose_and_count)
{
    random_stream r = random_begin(2, 0, 0);
    for (int n = 0; n < 1000; n++) {
        double x[8], y[8];
        lanes_draw(&r, x);
        lanes_draw(&r, y);
        v8 a = v8_load(x), b = v8_load(y);
        v8_mask less = v8_less(a, b), at_most = v8_less_equal(a, b);
        ASSERT_LANES(v8_select(less, a, b), x[i] < y[i] ? x[i] : y[i]);
        ASSERT_LANES(v8_select(at_most & ~less, v8_set(1), a), x[i] == y[i] ? 1 : x[i]);
        unsigned bits = 0, equal_bits = 0;
        for (int i = 0; i < 8; i++) {
            bits |= (x[i] < y[i] ? 1u : 0u) << i;
            equal_bits |= (x[i] <= y[i] ? 1u : 0u) << i;
        }
        ck_assert_uint_eq(v8_bits(less), bits);
        ck_assert_uint_eq(v8_bits(at_most), equal_bits);
        ck_assert_int_eq(v8_any(less), bits != 0);
        ck_assert_int_eq(v8_all(at_most), equal_bits == 255);
    }
    v8 zero = v8_set(0);
    ck_assert(v8_all(v8_less_equal(zero, zero)) && !v8_any(v8_less(zero, zero)));
}
END_TEST

START_TEST(memory_needs_no_alignment)
{
    double from[24], to[24];
    for (int shift = 0; shift < 8; shift++) {
        for (int i = 0; i < 24; i++) {
            from[i] = i;
            to[i] = -1;
        }
        double even[8], odd[8];
        for (int i = 0; i < V8_PARTS; i++) {
            v8_part e, o;
            v8_part_load_pairs(from + shift + 2 * V8_PART_LANES * i, &e, &o);
            memcpy(even + V8_PART_LANES * i, &e, sizeof e);
            memcpy(odd + V8_PART_LANES * i, &o, sizeof o);
        }
        for (int i = 0; i < 8; i++) {
            assert_bits(even[i], shift + 2 * i);
            assert_bits(odd[i], shift + 2 * i + 1);
        }
        v8_store(to + shift, v8_load(from + 8 - shift));
        for (int i = 0; i < 24; i++)
            assert_bits(to[i], i >= shift && i < shift + 8 ? 8 - shift + (i - shift) : -1.0);
    }
}
END_TEST

START_TEST(gather_follows_its_indices)
{
    double memory[100];
    for (int i = 0; i < 100; i++)
        memory[i] = i;
    int32_t index[8] = {7, 99, 0, 50, 51, 3, 98, 1};
    v8 a = v8_gather(memory, index);
    ASSERT_LANES(a, index[i]);
}
END_TEST

START_TEST(rows_become_columns_and_back)
{
    double memory[160], before[160];
    for (int i = 0; i < 160; i++)
        before[i] = memory[i] = i;
    int32_t index[8] = {3, 19, 0, 7, 12, 18, 1, 5};
    v8 column[8];
    v8_gather_rows(memory, index, column);
    for (int j = 0; j < 8; j++)
        ASSERT_LANES(column[j], 8 * index[i] + j);
    for (int j = 0; j < 8; j++)
        column[j] += 1000.0;
    v8_scatter_rows(memory, index, column);
    for (int row = 0; row < 20; row++) {
        bool listed = false;
        for (int i = 0; i < 8; i++)
            listed = listed || index[i] == row;
        for (int j = 0; j < 8; j++)
            assert_bits(memory[8 * row + j], before[8 * row + j] + (listed ? 1000 : 0));
    }
    int32_t same[8] = {2, 2, 2, 2, 2, 2, 2, 2};
    for (int j = 0; j < 8; j++)
        column[j] = (v8){0, 1, 2, 3, 4, 5, 6, 7};
    v8_scatter_rows(memory, same, column);
    for (int j = 0; j < 8; j++)
        assert_bits(memory[16 + j], 7);
}
END_TEST

#define SIMD_TESTS                                                                                                     \
    arithmetic_is_that_of_single_lanes, masks_choose_and_count, memory_needs_no_alignment, gather_follows_its_indices, \
        rows_become_columns_and_back
