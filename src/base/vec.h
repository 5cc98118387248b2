/* Vectors, matrices and quaternions, all double, by value.  Only + - * / sqrt: results are the same
   to the bit on every processor and compiler (no fused multiply-add, see docs/decisions).
   Frames: a quat turns body coordinates into global ones, r_global = R(q) r_body. */
#ifndef BASE_VEC_H
#define BASE_VEC_H

#include <math.h>

typedef struct vec2 {
    double x, y;
} vec2;
typedef struct vec3 {
    double x, y, z;
} vec3;
/* Unit quaternion, w + xi + yj + zk. */
typedef struct quat {
    double w, x, y, z;
} quat;
/* Row-major 3 x 3 matrix, m[row][column]. */
typedef struct mat3 {
    double m[3][3];
} mat3;
/* Symmetric 3 x 3 matrix. */
typedef struct sym3 {
    double xx, yy, zz, xy, xz, yz;
} sym3;

static inline vec2 vec2_make(double x, double y) { return (vec2){x, y}; }
static inline vec2 vec2_add(vec2 a, vec2 b) { return (vec2){a.x + b.x, a.y + b.y}; }
static inline vec2 vec2_sub(vec2 a, vec2 b) { return (vec2){a.x - b.x, a.y - b.y}; }
static inline vec2 vec2_scale(vec2 a, double s) { return (vec2){a.x * s, a.y * s}; }
static inline double vec2_dot(vec2 a, vec2 b) { return a.x * b.x + a.y * b.y; }
/* z component of a x b: positive when b is counter-clockwise of a. */
static inline double vec2_cross(vec2 a, vec2 b) { return a.x * b.y - a.y * b.x; }
static inline double vec2_length(vec2 a) { return sqrt(vec2_dot(a, a)); }
/* a turned by +90 degrees. */
static inline vec2 vec2_perp(vec2 a) { return (vec2){-a.y, a.x}; }

static inline vec3 vec3_make(double x, double y, double z) { return (vec3){x, y, z}; }
static inline vec3 vec3_add(vec3 a, vec3 b) { return (vec3){a.x + b.x, a.y + b.y, a.z + b.z}; }
static inline vec3 vec3_sub(vec3 a, vec3 b) { return (vec3){a.x - b.x, a.y - b.y, a.z - b.z}; }
static inline vec3 vec3_scale(vec3 a, double s) { return (vec3){a.x * s, a.y * s, a.z * s}; }
static inline vec3 vec3_neg(vec3 a) { return (vec3){-a.x, -a.y, -a.z}; }
/* a + s b */
static inline vec3 vec3_mad(vec3 a, vec3 b, double s) { return (vec3){a.x + b.x * s, a.y + b.y * s, a.z + b.z * s}; }
static inline double vec3_dot(vec3 a, vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
static inline vec3 vec3_cross(vec3 a, vec3 b)
{
    return (vec3){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
static inline double vec3_length(vec3 a) { return sqrt(vec3_dot(a, a)); }
/* a / |a|, or (0,0,0) when a is zero. */
static inline vec3 vec3_unit(vec3 a)
{
    double l = vec3_length(a);
    return l > 0 ? vec3_scale(a, 1 / l) : (vec3){0, 0, 0};
}

static inline vec3 mat3_mul_vec(mat3 a, vec3 v)
{
    return (vec3){a.m[0][0] * v.x + a.m[0][1] * v.y + a.m[0][2] * v.z,
                  a.m[1][0] * v.x + a.m[1][1] * v.y + a.m[1][2] * v.z,
                  a.m[2][0] * v.x + a.m[2][1] * v.y + a.m[2][2] * v.z};
}
/* transpose(a) v */
static inline vec3 mat3_tmul_vec(mat3 a, vec3 v)
{
    return (vec3){a.m[0][0] * v.x + a.m[1][0] * v.y + a.m[2][0] * v.z,
                  a.m[0][1] * v.x + a.m[1][1] * v.y + a.m[2][1] * v.z,
                  a.m[0][2] * v.x + a.m[1][2] * v.y + a.m[2][2] * v.z};
}
static inline vec3 mat3_column(mat3 a, int c) { return (vec3){a.m[0][c], a.m[1][c], a.m[2][c]}; }

static inline vec3 sym3_mul_vec(sym3 s, vec3 v)
{
    return (vec3){s.xx * v.x + s.xy * v.y + s.xz * v.z, s.xy * v.x + s.yy * v.y + s.yz * v.z,
                  s.xz * v.x + s.yz * v.y + s.zz * v.z};
}

static inline quat quat_identity(void) { return (quat){1, 0, 0, 0}; }
static inline quat quat_mul(quat a, quat b)
{
    return (quat){a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z, a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
                  a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x, a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w};
}
static inline quat quat_unit(quat q)
{
    double l = sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z), s = 1 / l;
    return (quat){q.w * s, q.x * s, q.y * s, q.z * s};
}
/* Rotation matrix of a unit quaternion. */
static inline mat3 quat_matrix(quat q)
{
    double xx = q.x * q.x, yy = q.y * q.y, zz = q.z * q.z;
    double xy = q.x * q.y, xz = q.x * q.z, yz = q.y * q.z, wx = q.w * q.x, wy = q.w * q.y, wz = q.w * q.z;
    return (mat3){{{1 - 2 * (yy + zz), 2 * (xy - wz), 2 * (xz + wy)},
                   {2 * (xy + wz), 1 - 2 * (xx + zz), 2 * (yz - wx)},
                   {2 * (xz - wy), 2 * (yz + wx), 1 - 2 * (xx + yy)}}};
}

/* Operations too long to inline; vec.c. */
mat3 mat3_mul(mat3 a, mat3 b);
mat3 mat3_transpose(mat3 a);
/* Inverse of a regular matrix; the caller guarantees a non-zero determinant. */
mat3 mat3_inverse(mat3 a);
/* R S R^T: a body-frame symmetric tensor in the global frame. */
sym3 sym3_rotate(sym3 s, mat3 r);
/* Inverse of a positive definite symmetric matrix. */
sym3 sym3_inverse(sym3 s);
/* Roll, pitch, yaw [rad] of q, rotation order yaw (z), pitch (y), roll (x) as in Fossen 2011, eq. 2.18. */
vec3 quat_roll_pitch_yaw(quat q);
/* The unit quaternion of roll, pitch, yaw [rad], same order. */
quat quat_from_roll_pitch_yaw(double roll, double pitch, double yaw);
/* The unit quaternion of a rotation matrix (Shepperd's branches). */
quat quat_from_matrix(mat3 r);

#endif
