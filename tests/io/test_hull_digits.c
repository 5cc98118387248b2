/* io/hull_digits: whether a triangle, or two of them, are as the rounding of a file's coordinates leaves them. */
#include "io/hull_digits.h"
#include "testing.h"

#include <stdio.h>

enum { ADVICE = 200 };

/* Six corners, of which the first triangle has the first three; the second has the last three, or (shared) instead of
   its last one the second one of the first. */
static bool lacks(const vec3 corner[6], bool shared, bool single, double scale, char advice[ADVICE])
{
    context ctx;
    context_init(&ctx);
    mesh file = {0}, made = {0};
    for (int i = 0; i < 6; i++)
        ck_assert(array_push(&ctx, &file.vertex, corner[i]) &&
                  array_push(&ctx, &made.vertex, vec3_scale(corner[i], scale)));
    const triangle faces[] = {{{0, 1, 2}}, {{3, 4, shared ? 1 : 5}}};
    for (int i = 0; i < 2; i++)
        ck_assert(array_push(&ctx, &file.face, faces[i]) && array_push(&ctx, &made.face, faces[i]));
    const int32_t asked[2] = {0, single ? -1 : 1};
    advice[0] = '\0';
    bool found = hull_lacks_digits(&file, scale, &made, asked, advice, ADVICE);
    mesh_free(&ctx, &file);
    mesh_free(&ctx, &made);
    return found;
}

/* Two triangles of 4 m, the first one of that height; the second is none that rounding flattens. */
static bool pair_lacks(double height, bool shared, double scale, char advice[ADVICE])
{
    const vec3 corner[6] = {{0, 0, 0}, {4, 0, 0}, {2, height, 0}, {4, 3, 0}, {7, 3, 0}, {7, 0, 0}};
    return lacks(corner, shared, false, scale, advice);
}

START_TEST(two_that_share_a_corner)
{
    char advice[ADVICE];
    ck_assert(pair_lacks(0.01, true, 1, advice));
    ck_assert_ptr_nonnull(strstr(advice, "multiples of 0.01, have too few digits"));
    ck_assert(!pair_lacks(0.03, true, 1, advice));
    ck_assert_str_eq(advice, "");
    ck_assert(!pair_lacks(0.01, false, 1, advice));
    /* As in a file of millimetres. */
    ck_assert(pair_lacks(0.01, true, 1000, advice));
    ck_assert_ptr_nonnull(strstr(advice, "multiples of 0.01,"));
    ck_assert(!pair_lacks(0.03, true, 1000, advice));
    /* Six digits are told, seven are enough. */
    ck_assert(pair_lacks(1e-6, true, 1, advice));
    ck_assert_ptr_nonnull(strstr(advice, "multiples of 1e-06,"));
    ck_assert(!pair_lacks(1e-7, true, 1, advice));
}
END_TEST

START_TEST(one_alone)
{
    char advice[ADVICE];
    for (int longer = 0; longer < 2; longer++) {
        const vec3 corner[6] = {{0, 0, 0}, {longer ? 1.01 : 0.99, 0, 0}, {2.5, 0, 0}, {4, 0, 0}, {4, 3, 0}, {7, 0, 0}};
        ck_assert_int_eq(lacks(corner, false, true, 1, advice), !longer);
    }
    /* Metres of a hull of a hundred and of one of less. */
    for (int hull = 0; hull < 2; hull++) {
        double size = hull ? 101 : 99;
        const vec3 corner[6] = {{0, 0, 0}, {2, 0, 0}, {5, 0, 0}, {size, 0, 0}, {size, 3, 0}, {9, 9, 0}};
        ck_assert_int_eq(lacks(corner, false, true, 1, advice), hull);
    }
}
END_TEST

TEST_MAIN("hull_digits", two_that_share_a_corner, one_alone)
