/* The longer operations on matrices and quaternions; see vec.h for conventions. */
#include "base/vec.h"
#include "base/transcendental.h"

/* cos(pitch) under which roll and yaw are one rotation: far above rounding, far below any meaningful angle. */
#define GIMBAL_LOCK 1e-12

mat3 mat3_mul(mat3 a, mat3 b)
{
    mat3 c;
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++)
            c.m[i][j] = a.m[i][0] * b.m[0][j] + a.m[i][1] * b.m[1][j] + a.m[i][2] * b.m[2][j];
    }
    return c;
}

mat3 mat3_transpose(mat3 a)
{
    return (mat3){
        {{a.m[0][0], a.m[1][0], a.m[2][0]}, {a.m[0][1], a.m[1][1], a.m[2][1]}, {a.m[0][2], a.m[1][2], a.m[2][2]}}};
}

mat3 mat3_inverse(mat3 a)
{
    /* Rows of the inverse are cross products of columns over the determinant. */
    vec3 c0 = mat3_column(a, 0), c1 = mat3_column(a, 1), c2 = mat3_column(a, 2);
    vec3 r0 = vec3_cross(c1, c2), r1 = vec3_cross(c2, c0), r2 = vec3_cross(c0, c1);
    double s = 1 / vec3_dot(c0, r0);
    return (mat3){{{r0.x * s, r0.y * s, r0.z * s}, {r1.x * s, r1.y * s, r1.z * s}, {r2.x * s, r2.y * s, r2.z * s}}};
}

sym3 sym3_rotate(sym3 s, mat3 r)
{
    vec3 row[3], turned[3]; /* rows of R, and S times each */
    for (int i = 0; i < 3; i++) {
        row[i] = vec3_make(r.m[i][0], r.m[i][1], r.m[i][2]);
        turned[i] = sym3_mul_vec(s, row[i]);
    }
    return (sym3){.xx = vec3_dot(row[0], turned[0]),
                  .yy = vec3_dot(row[1], turned[1]),
                  .zz = vec3_dot(row[2], turned[2]),
                  .xy = vec3_dot(row[0], turned[1]),
                  .xz = vec3_dot(row[0], turned[2]),
                  .yz = vec3_dot(row[1], turned[2])};
}

sym3 sym3_inverse(sym3 s)
{
    double xx = s.yy * s.zz - s.yz * s.yz, xy = s.xz * s.yz - s.xy * s.zz, xz = s.xy * s.yz - s.xz * s.yy;
    double scale = 1 / (s.xx * xx + s.xy * xy + s.xz * xz);
    return (sym3){.xx = xx * scale,
                  .yy = (s.xx * s.zz - s.xz * s.xz) * scale,
                  .zz = (s.xx * s.yy - s.xy * s.xy) * scale,
                  .xy = xy * scale,
                  .xz = xz * scale,
                  .yz = (s.xy * s.xz - s.xx * s.yz) * scale};
}

vec3 quat_roll_pitch_yaw(quat q)
{
    mat3 r = quat_matrix(q);
    /* An arc tangent, not Fossen's arc sine, which loses half the digits near +-90 degrees. */
    double cosine = sqrt(r.m[0][0] * r.m[0][0] + r.m[1][0] * r.m[1][0]);
    double pitch = real_atan2(-r.m[2][0], cosine);
    if (cosine < GIMBAL_LOCK) /* only roll -+ yaw is defined: call it all yaw */
        return vec3_make(0, pitch, real_atan2(-r.m[0][1], r.m[1][1]));
    return vec3_make(real_atan2(r.m[2][1], r.m[2][2]), pitch, real_atan2(r.m[1][0], r.m[0][0]));
}

quat quat_from_roll_pitch_yaw(double roll, double pitch, double yaw)
{
    double cr = real_cos(roll / 2), sr = real_sin(roll / 2);
    double cp = real_cos(pitch / 2), sp = real_sin(pitch / 2);
    double cy = real_cos(yaw / 2), sy = real_sin(yaw / 2);
    return (quat){.w = cy * cp * cr + sy * sp * sr,
                  .x = cy * cp * sr - sy * sp * cr,
                  .y = cy * sp * cr + sy * cp * sr,
                  .z = sy * cp * cr - cy * sp * sr};
}

quat quat_from_matrix(mat3 r)
{
    double xx = r.m[0][0], yy = r.m[1][1], zz = r.m[2][2], trace = xx + yy + zz;
    quat q;
    /* The largest of w, x, y, z comes from the diagonal, the others by division with it (Shepperd 1978). */
    if (trace >= xx && trace >= yy && trace >= zz) {
        q = (quat){1 + trace, r.m[2][1] - r.m[1][2], r.m[0][2] - r.m[2][0], r.m[1][0] - r.m[0][1]};
    } else if (xx >= yy && xx >= zz) {
        q = (quat){r.m[2][1] - r.m[1][2], 1 + xx - yy - zz, r.m[1][0] + r.m[0][1], r.m[0][2] + r.m[2][0]};
    } else if (yy >= zz) {
        q = (quat){r.m[0][2] - r.m[2][0], r.m[1][0] + r.m[0][1], 1 + yy - zz - xx, r.m[2][1] + r.m[1][2]};
    } else {
        q = (quat){r.m[1][0] - r.m[0][1], r.m[0][2] + r.m[2][0], r.m[2][1] + r.m[1][2], 1 + zz - xx - yy};
    }
    return quat_unit(q); /* every branch is q times four times its largest component */
}
