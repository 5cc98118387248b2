/* Vectors and tensors of eight bodies at once, one in each lane: the operations of vec.h in the same order, so that a
   lane holds the bits that the scalar form gives.  For kernels (kernel.h, simd.h). */
#ifndef BASE_LANES_H
#define BASE_LANES_H

#include "base/simd.h"
#include "base/vec.h"

typedef struct lanes3 {
    v8 x, y, z;
} lanes3;

/* Row-major, m[row][column]. */
typedef struct lanes33 {
    v8 m[3][3];
} lanes33;

V8_INLINE lanes3 lanes3_add(lanes3 a, lanes3 b) { return (lanes3){a.x + b.x, a.y + b.y, a.z + b.z}; }
V8_INLINE lanes3 lanes3_sub(lanes3 a, lanes3 b) { return (lanes3){a.x - b.x, a.y - b.y, a.z - b.z}; }
V8_INLINE lanes3 lanes3_scale(lanes3 a, v8 s) { return (lanes3){a.x * s, a.y * s, a.z * s}; }
/* a + s b */
V8_INLINE lanes3 lanes3_mad(lanes3 a, lanes3 b, v8 s) { return (lanes3){a.x + b.x * s, a.y + b.y * s, a.z + b.z * s}; }
V8_INLINE v8 lanes3_dot(lanes3 a, lanes3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
V8_INLINE lanes3 lanes3_cross(lanes3 a, lanes3 b)
{
    return (lanes3){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
V8_INLINE lanes3 lanes3_select(v8_mask mask, lanes3 a, lanes3 b)
{
    return (lanes3){v8_select(mask, a.x, b.x), v8_select(mask, a.y, b.y), v8_select(mask, a.z, b.z)};
}

/* Symmetric tensors as xx yy zz xy xz yz. */
V8_INLINE lanes3 lanes_sym3_mul(const v8 s[6], lanes3 a)
{
    return (lanes3){s[0] * a.x + s[3] * a.y + s[4] * a.z, s[3] * a.x + s[1] * a.y + s[5] * a.z,
                    s[4] * a.x + s[5] * a.y + s[2] * a.z};
}

V8_INLINE void lanes_sym3_inverse(const v8 s[6], v8 out[6])
{
    v8 xx = s[1] * s[2] - s[5] * s[5], xy = s[4] * s[5] - s[3] * s[2], xz = s[3] * s[5] - s[4] * s[1];
    v8 scale = 1 / (s[0] * xx + s[3] * xy + s[4] * xz);
    out[0] = xx * scale;
    out[1] = (s[0] * s[2] - s[4] * s[4]) * scale;
    out[2] = (s[0] * s[1] - s[3] * s[3]) * scale;
    out[3] = xy * scale;
    out[4] = xz * scale;
    out[5] = (s[3] * s[4] - s[0] * s[5]) * scale;
}

/* R S R^T: a body-frame tensor in the global frame. */
V8_INLINE void lanes_sym3_rotate(const v8 s[6], const lanes33 *r, v8 out[6])
{
    lanes3 row[3], turned[3];
    for (int i = 0; i < 3; i++) {
        row[i] = (lanes3){r->m[i][0], r->m[i][1], r->m[i][2]};
        turned[i] = lanes_sym3_mul(s, row[i]);
    }
    for (int i = 0; i < 3; i++)
        out[i] = lanes3_dot(row[i], turned[i]);
    out[3] = lanes3_dot(row[0], turned[1]);
    out[4] = lanes3_dot(row[0], turned[2]);
    out[5] = lanes3_dot(row[1], turned[2]);
}

V8_INLINE lanes3 lanes33_mul(const lanes33 *a, lanes3 v)
{
    return (lanes3){a->m[0][0] * v.x + a->m[0][1] * v.y + a->m[0][2] * v.z,
                    a->m[1][0] * v.x + a->m[1][1] * v.y + a->m[1][2] * v.z,
                    a->m[2][0] * v.x + a->m[2][1] * v.y + a->m[2][2] * v.z};
}

/* transpose(a) v */
V8_INLINE lanes3 lanes33_tmul(const lanes33 *a, lanes3 v)
{
    return (lanes3){a->m[0][0] * v.x + a->m[1][0] * v.y + a->m[2][0] * v.z,
                    a->m[0][1] * v.x + a->m[1][1] * v.y + a->m[2][1] * v.z,
                    a->m[0][2] * v.x + a->m[1][2] * v.y + a->m[2][2] * v.z};
}

/* inverse(a) v */
V8_INLINE lanes3 lanes33_solve(const lanes33 *a, lanes3 v)
{
    lanes3 c[3], r[3];
    for (int i = 0; i < 3; i++)
        c[i] = (lanes3){a->m[0][i], a->m[1][i], a->m[2][i]};
    for (int i = 0; i < 3; i++)
        r[i] = lanes3_cross(c[(i + 1) % 3], c[(i + 2) % 3]);
    v8 s = 1 / lanes3_dot(c[0], r[0]);
    return (lanes3){lanes3_dot(lanes3_scale(r[0], s), v), lanes3_dot(lanes3_scale(r[1], s), v),
                    lanes3_dot(lanes3_scale(r[2], s), v)};
}

typedef struct lanes_quat {
    v8 w, x, y, z;
} lanes_quat;

V8_INLINE lanes33 lanes_quat_matrix(lanes_quat q)
{
    v8 xx = q.x * q.x, yy = q.y * q.y, zz = q.z * q.z;
    v8 xy = q.x * q.y, xz = q.x * q.z, yz = q.y * q.z, wx = q.w * q.x, wy = q.w * q.y, wz = q.w * q.z;
    return (lanes33){{{1 - 2 * (yy + zz), 2 * (xy - wz), 2 * (xz + wy)},
                      {2 * (xy + wz), 1 - 2 * (xx + zz), 2 * (yz - wx)},
                      {2 * (xz - wy), 2 * (yz + wx), 1 - 2 * (xx + yy)}}};
}

/* ---- eight rows of a table ---- */

/* Component `at` of eight rows of `stride` doubles. */
V8_INLINE v8 lanes_pick(const double *p, int stride, int at)
{
    p += at;
    return (v8){p[0],          p[stride],     p[2 * stride], p[3 * stride],
                p[4 * stride], p[5 * stride], p[6 * stride], p[7 * stride]};
}

V8_INLINE lanes3 lanes3_pick(const vec3 *p)
{
    return (lanes3){lanes_pick(&p->x, 3, 0), lanes_pick(&p->x, 3, 1), lanes_pick(&p->x, 3, 2)};
}

V8_INLINE lanes_quat lanes_quat_pick(const quat *q)
{
    return (lanes_quat){lanes_pick(&q->w, 4, 0), lanes_pick(&q->w, 4, 1), lanes_pick(&q->w, 4, 2),
                        lanes_pick(&q->w, 4, 3)};
}

V8_INLINE void lanes_sym3_pick(const sym3 *s, v8 out[6])
{
    for (int i = 0; i < 6; i++)
        out[i] = lanes_pick(&s->xx, 6, i);
}

/* Row i gets lane i where bit i of `lanes` is set. */
V8_INLINE void lanes3_put(vec3 *rows, lanes3 v, unsigned lanes)
{
    double x[V8_LANES], y[V8_LANES], z[V8_LANES];
    v8_store(x, v.x);
    v8_store(y, v.y);
    v8_store(z, v.z);
    for (int i = 0; i < V8_LANES; i++)
        if (lanes >> i & 1u)
            rows[i] = vec3_make(x[i], y[i], z[i]);
}

V8_INLINE void lanes_quat_put(quat *rows, lanes_quat q, unsigned lanes)
{
    double w[V8_LANES], x[V8_LANES], y[V8_LANES], z[V8_LANES];
    v8_store(w, q.w);
    v8_store(x, q.x);
    v8_store(y, q.y);
    v8_store(z, q.z);
    for (int i = 0; i < V8_LANES; i++)
        if (lanes >> i & 1u)
            rows[i] = (quat){w[i], x[i], y[i], z[i]};
}

#endif
