#include "base/random.h"
#include "geometry/predicate3.h"
#include "testing.h"

/* The sign by long integers, for coordinates that are small whole numbers. */
static int integer_sign(const int64_t p[4][3])
{
    int64_t a[3], b[3], c[3];
    for (int k = 0; k < 3; k++) {
        a[k] = p[1][k] - p[0][k];
        b[k] = p[2][k] - p[0][k];
        c[k] = p[3][k] - p[0][k];
    }
    int64_t det =
        c[0] * (a[1] * b[2] - a[2] * b[1]) + c[1] * (a[2] * b[0] - a[0] * b[2]) + c[2] * (a[0] * b[1] - a[1] * b[0]);
    return (det > 0) - (det < 0);
}

START_TEST(above_below_and_on)
{
    vec3 a = {0, 0, 0}, b = {1, 0, 0}, c = {0, 1, 0};
    ck_assert_int_eq(orientation3(a, b, c, (vec3){0.3, 0.3, 1e-300}), 1);
    ck_assert_int_eq(orientation3(a, b, c, (vec3){0.3, 0.3, -1e-300}), -1);
    ck_assert_int_eq(orientation3(a, b, c, (vec3){5, 7, 0}), 0);
    ck_assert_int_eq(orientation3(a, c, b, (vec3){0.3, 0.3, 1}), -1);
}
END_TEST

/* Whole numbers moved by a common large number, so that plain differences stay exact. */
START_TEST(whole_numbers)
{
    random_stream r = random_begin(3, 1, 0);
    int zeros = 0;
    for (int i = 0; i < 20000; i++) {
        int64_t p[4][3];
        vec3 q[4];
        for (int j = 0; j < 4; j++) {
            for (int k = 0; k < 3; k++)
                p[j][k] = (int64_t)random_uniform(&r, -4, 4);
            q[j] = (vec3){(double)p[j][0] + 1e6, (double)p[j][1] * 0x1p-20, (double)p[j][2] * 0x1p30};
        }
        int expected = integer_sign((const int64_t(*)[3])p);
        zeros += expected == 0;
        ck_assert_int_eq(orientation3(q[0], q[1], q[2], q[3]), expected);
    }
    ck_assert_int_gt(zeros, 1000);
}
END_TEST

static double digits(random_stream *r) { return floor(random_uniform(r, -0x1p44, 0x1p44)) * 0x1p-44; }

/* Four points of one plane: whole multiples of u and of a far smaller v, exact themselves while their differences are
 * not. */
START_TEST(differences_that_round)
{
    random_stream r = random_begin(4, 1, 0);
    for (int i = 0; i < 20000; i++) {
        vec3 u = {digits(&r), digits(&r), digits(&r)}, v = {digits(&r), digits(&r), digits(&r)};
        v = vec3_scale(v, i % 2 ? 0x1p-30 : 0x1p-5);
        vec3 p[4] = {vec3_scale(u, 3), vec3_scale(v, 5), vec3_scale(u, -7), vec3_scale(v, 1 + i % 50)};
        if (i % 50 == 4)
            continue; /* p[3] is p[1] */
        ck_assert_int_eq(orientation3(p[0], p[1], p[2], p[3]), 0);
        vec3 n = vec3_cross(vec3_sub(p[1], p[0]), vec3_sub(p[2], p[0]));
        vec3 up = p[3], back = p[3];
        up.z = nextafter(up.z, HUGE_VAL);
        back.x = nextafter(back.x, -HUGE_VAL);
        ck_assert_int_eq(orientation3(p[0], p[1], p[2], up), n.z > 0 ? 1 : -1);
        ck_assert_int_eq(orientation3(p[0], p[1], p[2], back), n.x > 0 ? -1 : 1);
    }
}
END_TEST

/* An odd permutation turns the sign, whatever the rounding: nearly flat tetrahedra of thirds. */
START_TEST(permutations)
{
    static const int order[6][4] = {{0, 1, 2, 3}, {1, 0, 2, 3}, {0, 1, 3, 2}, {3, 0, 1, 2}, {1, 2, 0, 3}, {3, 2, 1, 0}};
    static const int parity[6] = {1, -1, -1, -1, 1, 1};
    random_stream r = random_begin(5, 1, 0);
    int zeros = 0, others = 0;
    for (int i = 0; i < 5000; i++) {
        vec3 p[4];
        vec3 u = {random_uniform(&r, -1, 1), random_uniform(&r, -1, 1) / 3, random_uniform(&r, -1, 1) * 5};
        vec3 v = {random_uniform(&r, -1, 1) * 7, random_uniform(&r, -1, 1), random_uniform(&r, -1, 1)};
        for (int j = 0; j < 4; j++)
            p[j] = vec3_mad(vec3_scale(u, random_uniform(&r, 0, 1)), v, random_uniform(&r, 0, 1));
        int sign = orientation3(p[0], p[1], p[2], p[3]);
        zeros += sign == 0;
        others += sign != 0;
        for (int k = 0; k < 6; k++) {
            const int *o = order[k];
            ck_assert_int_eq(orientation3(p[o[0]], p[o[1]], p[o[2]], p[o[3]]), parity[k] * sign);
        }
    }
    ck_assert_int_gt(others, 100);
    ck_assert_int_lt(zeros, 4900);
}
END_TEST

TEST_MAIN("predicate3", above_below_and_on, whole_numbers, differences_that_round, permutations)
