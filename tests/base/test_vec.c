/* Vectors, matrices and quaternions. */
#include "base/random.h"
#include "base/transcendental.h"
#include "base/vec.h"
#include "testing.h"

static double draw(random_stream *r) { return random_uniform(r, -2, 2); }

static vec3 vec3_draw(random_stream *r)
{
    double x = draw(r), y = draw(r);
    return vec3_make(x, y, draw(r));
}

static quat quat_draw(random_stream *r)
{
    double w = draw(r), x = draw(r), y = draw(r);
    return quat_unit((quat){w, x, y, draw(r)});
}

static mat3 mat3_draw(random_stream *r)
{
    mat3 a;
    for (int i = 0; i < 9; i++)
        a.m[i / 3][i % 3] = draw(r);
    return a;
}

/* The matrix of a symmetric one. */
static mat3 sym3_matrix(sym3 s) { return (mat3){{{s.xx, s.xy, s.xz}, {s.xy, s.yy, s.yz}, {s.xz, s.yz, s.zz}}}; }

static const mat3 identity = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};

START_TEST(plane_vectors)
{
    vec2 a = vec2_make(3, 4), b = vec2_make(-1, 2);
    assert_vec2_close(vec2_add(a, b), vec2_make(2, 6), 0);
    assert_vec2_close(vec2_sub(a, b), vec2_make(4, 2), 0);
    assert_vec2_close(vec2_scale(a, 2), vec2_make(6, 8), 0);
    assert_bits(vec2_dot(a, b), 5);
    assert_bits(vec2_cross(a, b), 10);
    assert_bits(vec2_length(a), 5);
    assert_vec2_close(vec2_perp(a), vec2_make(-4, 3), 0);
}
END_TEST

START_TEST(space_vectors)
{
    vec3 a = vec3_make(1, 2, 3), b = vec3_make(-4, 5, 0.5);
    assert_vec3_close(vec3_cross(a, b), vec3_make(-14, -12.5, 13), 0);
    assert_bits(vec3_dot(a, vec3_cross(a, b)), 0);
    assert_vec3_close(vec3_mad(a, b, 2), vec3_make(-7, 12, 4), 0);
    assert_vec3_close(vec3_neg(vec3_sub(a, b)), vec3_sub(b, a), 0);
    assert_vec3_close(vec3_add(a, vec3_scale(a, -1)), vec3_make(0, 0, 0), 0);
    assert_bits(vec3_length(vec3_make(2, 3, 6)), 7);
    assert_vec3_close(vec3_unit(vec3_make(0, 0, -5)), vec3_make(0, 0, -1), 0);
    assert_vec3_close(vec3_unit(vec3_make(0, 0, 0)), vec3_make(0, 0, 0), 0);
}
END_TEST

START_TEST(matrices_multiply_transpose_and_invert)
{
    mat3 a = {{{1, 2, 3}, {4, 5, 6}, {7, 8, 10}}}, b = {{{0, 1, 0}, {0, 0, 1}, {1, 0, 0}}};
    mat3 ab = {{{3, 1, 2}, {6, 4, 5}, {10, 7, 8}}}, product = mat3_mul(a, b), turned = mat3_transpose(a);
    assert_array_bits(&product.m[0][0], &ab.m[0][0], 9);
    vec3 v = vec3_make(1, -1, 2);
    assert_vec3_close(mat3_mul_vec(a, v), vec3_make(5, 11, 19), 0);
    assert_vec3_close(mat3_tmul_vec(a, v), mat3_mul_vec(turned, v), 0);
    assert_vec3_close(mat3_column(a, 1), vec3_make(2, 5, 8), 0);
    mat3 inverse = {{{-2.0 / 3, -4.0 / 3, 1}, {-2.0 / 3, 11.0 / 3, -2}, {1, -2, 1}}}, found = mat3_inverse(a);
    assert_array_absolute(&found.m[0][0], &inverse.m[0][0], 9, 1e-14);
    random_stream r = random_begin(1, 0, 0);
    for (int i = 0; i < 100; i++) {
        mat3 m = mat3_draw(&r);
        if (fabs(vec3_dot(mat3_column(m, 0), vec3_cross(mat3_column(m, 1), mat3_column(m, 2)))) < 0.1)
            continue;
        product = mat3_mul(m, mat3_inverse(m));
        assert_array_absolute(&product.m[0][0], &identity.m[0][0], 9, 1e-13);
    }
}
END_TEST

START_TEST(symmetric_matrices_are_matrices)
{
    random_stream r = random_begin(2, 0, 0);
    for (int i = 0; i < 100; i++) {
        mat3 a = mat3_draw(&r), square = mat3_mul(a, mat3_transpose(a)); /* positive definite with the 1 below */
        sym3 s = {1 + square.m[0][0], 1 + square.m[1][1], 1 + square.m[2][2],
                  square.m[0][1],     square.m[0][2],     square.m[1][2]};
        vec3 v = vec3_draw(&r);
        assert_vec3_close(sym3_mul_vec(s, v), mat3_mul_vec(sym3_matrix(s), v), 1e-14);
        mat3 product = mat3_mul(sym3_matrix(s), sym3_matrix(sym3_inverse(s)));
        assert_array_absolute(&product.m[0][0], &identity.m[0][0], 9, 1e-13);
        mat3 turn = quat_matrix(quat_draw(&r));
        mat3 expected = mat3_mul(mat3_mul(turn, sym3_matrix(s)), mat3_transpose(turn));
        mat3 rotated = sym3_matrix(sym3_rotate(s, turn));
        assert_array_absolute(&rotated.m[0][0], &expected.m[0][0], 9, 1e-13);
    }
}
END_TEST

START_TEST(quaternions_turn_like_their_matrices)
{
    double h = sqrt(0.5); /* a quarter turn about z takes x to y */
    assert_vec3_close(mat3_mul_vec(quat_matrix((quat){h, 0, 0, h}), vec3_make(1, 0, 0)), vec3_make(0, 1, 0), 1e-15);
    random_stream r = random_begin(3, 0, 0);
    for (int i = 0; i < 100; i++) {
        quat a = quat_draw(&r), b = quat_draw(&r);
        mat3 both = quat_matrix(quat_mul(a, b)), product = mat3_mul(quat_matrix(a), quat_matrix(b));
        assert_array_absolute(&both.m[0][0], &product.m[0][0], 9, 1e-14);
        mat3 m = quat_matrix(a), round = mat3_mul(m, mat3_transpose(m));
        assert_array_absolute(&round.m[0][0], &identity.m[0][0], 9, 1e-14);
        assert_absolute(vec3_dot(mat3_column(m, 0), vec3_cross(mat3_column(m, 1), mat3_column(m, 2))), 1, 1e-14);
    }
    quat q = {0.5, 0.5, -0.5, 0.5}, same = quat_mul(quat_identity(), q);
    assert_array_bits(&same.w, &q.w, 4);
}
END_TEST

START_TEST(matrices_give_their_quaternions_back)
{
    /* One in each of Shepperd's branches, and any. */
    quat cases[] = {{0.9, 0.1, -0.2, 0.3}, {0.1, -0.9, 0.2, 0.3}, {-0.1, 0.3, 0.9, 0.2}, {0.1, 0.2, -0.3, 0.9},
                    {0, 1, 0, 0},          {0, 0, 1, 0},          {0, 0, 0, 1},          {1, 0, 0, 0}};
    random_stream r = random_begin(4, 0, 0);
    for (size_t i = 0; i < 200; i++) {
        quat q = i < sizeof cases / sizeof *cases ? quat_unit(cases[i]) : quat_draw(&r);
        quat back = quat_from_matrix(quat_matrix(q));
        double same = q.w * back.w + q.x * back.x + q.y * back.y + q.z * back.z;
        assert_absolute(fabs(same), 1, 1e-14);
    }
}
END_TEST

START_TEST(angles_follow_yaw_pitch_roll)
{
    /* Fossen 2011, eq. 2.18: R = Rz(yaw) Ry(pitch) Rx(roll). */
    double roll = 0.3, pitch = -0.7, yaw = 2.1;
    mat3 rx = {{{1, 0, 0}, {0, cos(roll), -sin(roll)}, {0, sin(roll), cos(roll)}}};
    mat3 ry = {{{cos(pitch), 0, sin(pitch)}, {0, 1, 0}, {-sin(pitch), 0, cos(pitch)}}};
    mat3 rz = {{{cos(yaw), -sin(yaw), 0}, {sin(yaw), cos(yaw), 0}, {0, 0, 1}}};
    mat3 expected = mat3_mul(rz, mat3_mul(ry, rx));
    mat3 found = quat_matrix(quat_from_roll_pitch_yaw(roll, pitch, yaw));
    assert_array_absolute(&found.m[0][0], &expected.m[0][0], 9, 1e-15);
    for (double p = -1.5; p < 1.6; p += 0.25) {
        for (double y = -3; y < 3.2; y += 0.5) {
            vec3 angles = vec3_make(y / 2 + 1, p, y);
            quat q = quat_from_roll_pitch_yaw(angles.x, angles.y, angles.z);
            assert_vec3_close(quat_roll_pitch_yaw(q), angles, 1e-13);
        }
    }
}
END_TEST

START_TEST(upright_and_head_down_have_angles_too)
{
    for (int side = -1; side <= 1; side += 2) {
        quat q = quat_from_roll_pitch_yaw(0.4, side * PI / 2, 1.1);
        vec3 angles = quat_roll_pitch_yaw(q);
        assert_bits(angles.x, 0);
        assert_absolute(angles.y, side * PI / 2, 1e-7); /* the rounding of q tilts by sqrt(eps) */
        quat back = quat_from_roll_pitch_yaw(angles.x, angles.y, angles.z);
        assert_absolute(fabs(q.w * back.w + q.x * back.x + q.y * back.y + q.z * back.z), 1, 1e-14);
    }
}
END_TEST

/* What the tests compare by (tests/testing.h). */
START_TEST(the_worst_of_many_keeps_a_nan)
{
    const double none = (double)NAN;
    ck_assert(isnan(testing_larger(none, 1)) && isnan(testing_larger(1, none)));
    ck_assert(isnan(testing_smaller(none, 1)) && isnan(testing_smaller(1, none)));
    ck_assert(testing_larger(-2, 1) == 1 && testing_larger(1, -2) == 1 && testing_larger(1, HUGE_VAL) == HUGE_VAL);
    ck_assert(testing_smaller(-2, 1) == -2 && testing_smaller(1, -2) == -2);
}
END_TEST

START_TEST(infinity_is_close_to_itself_alone)
{
    const double all = HUGE_VAL, other[] = {1, -HUGE_VAL, (double)NAN};
    for (int kind = TESTING_ABSOLUTE; kind <= TESTING_BITS; kind++) {
        ck_assert_int_eq(testing_first_apart(&all, &all, 1, kind, 1e-3), -1);
        for (int i = 0; i < 3; i++) {
            ck_assert_int_eq(testing_first_apart(&other[i], &all, 1, kind, 1e-3), 0);
            ck_assert_int_eq(testing_first_apart(&all, &other[i], 1, kind, 1e-3), 0);
        }
    }
}
END_TEST

TEST_MAIN("vec", plane_vectors, space_vectors, matrices_multiply_transpose_and_invert, symmetric_matrices_are_matrices,
          quaternions_turn_like_their_matrices, matrices_give_their_quaternions_back, angles_follow_yaw_pitch_roll,
          upright_and_head_down_have_angles_too, the_worst_of_many_keeps_a_nan, infinity_is_close_to_itself_alone)
