/* Poses as the record packs them, to the precision that is stated. */
#include "testing.h"

#include "io/record_pose.h"

#include <math.h>

START_TEST(half_floats_are_those_of_the_standard)
{
    static const struct {
        double value;
        uint16_t half;
    } known[] = {{0, 0x0000},     {1, 0x3c00},       {-2, 0xc000},
                 {65504, 0x7bff}, {1e9, 0x7bff},     {-1e9, 0xfbff},
                 {0.5, 0x3800},   {1.0 / 3, 0x3555}, {5.9604644775390625e-8, 0x0001},
                 {2049, 0x6800},  {2051, 0x6802},    {6.103515625e-5, 0x0400}};
    for (size_t i = 0; i < sizeof known / sizeof *known; i++)
        ck_assert_uint_eq(half_from_real(known[i].value), known[i].half);
    for (uint32_t h = 0; h < 0x7c00; h++)
        ck_assert_uint_eq(half_from_real(real_from_half((uint16_t)h)), h);
}
END_TEST

/* Of any size that a model or a structure can meet, in steps of 1 in 1024 to 2048, rounded to nearest even. */
START_TEST(forces_keep_their_precision)
{
    const double least = 1e3 * exp2(-40), most = 1e3 * 2047 * exp2(22);
    const struct {
        double newton;
        uint16_t packed;
    } known[] = {{0, 0},         {least, 1},        {0.5 * least, 0}, {1.5 * least, 2}, {1023 * least, 0x3ff},
                 {1e3, 0x7c00},  {2049e3, 0xa800},  {2051e3, 0xa802}, {most, 0xffff},   {0.9999 * most, 0xffff},
                 {1e20, 0xffff}, {HUGE_VAL, 0xffff}};
    for (size_t i = 0; i < sizeof known / sizeof *known; i++)
        ck_assert_uint_eq(record_force_pack(known[i].newton), known[i].packed);
    for (uint32_t packed = 0; packed <= 0xffff; packed++)
        ck_assert_uint_eq(record_force_pack(record_force_unpack((uint16_t)packed)), packed);
    for (double force = 1e-6; force < 8e12; force *= 1.37)
        ck_assert_double_le(fabs(record_force_unpack(record_force_pack(force)) / force - 1), 1.0 / 2048);
}
END_TEST

START_TEST(poses_keep_their_precision)
{
    for (int i = 0; i < 2000; i++) {
        double a = 0.37 * i, b = 0.11 * i * i;
        vec3 at = vec3_make(731.25 * (a - floor(a)), -412.0, 0.9 * (b - floor(b)));
        quat q = quat_from_roll_pitch_yaw(6 * (a - floor(a)) - 3, 3 * (b - floor(b)) - 1.5, 0.01 * i - 10);
        unsigned char packed[RECORD_POSE_SIZE];
        vec3 back;
        quat turned;
        record_pose_pack(at, q, packed);
        record_pose_unpack(packed, &back, &turned);
        ck_assert_double_le(fabs(back.x - at.x), 1e-4);
        ck_assert_double_le(fabs(back.z - at.z), 0.0005);
        double dot = fabs(q.w * turned.w + q.x * turned.x + q.y * turned.y + q.z * turned.z);
        ck_assert_double_le(2 * sqrt(testing_larger(0, 2 * (1 - dot))), 3e-4);
    }
    unsigned char packed[RECORD_POSE_SIZE];
    vec3 back;
    quat level;
    record_pose_pack(vec3_make(1, 2, 0), quat_identity(), packed);
    ck_assert(!record_pose_is_marked(packed));
    record_pose_mark(packed);
    ck_assert(record_pose_is_marked(packed));
    record_pose_unpack(packed, &back, &level);
    ck_assert(level.w == 1 && level.x == 0 && level.y == 0 && level.z == 0);
}
END_TEST

TEST_MAIN("record_pose", half_floats_are_those_of_the_standard, forces_keep_their_precision, poses_keep_their_precision)
