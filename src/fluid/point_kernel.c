#include "fluid/point_kernel.h"
#include "base/parts.h"

V8_INLINE void add_points(const point_stream *s, const point_rows *p, ptrdiff_t at, real sum[6])
{
    const real zero = {0};
    real x = load(p->x + at), y = load(p->y + at), z = load(p->z + at);
    real nx = load(p->nx + at), ny = load(p->ny + at), nz = load(p->nz + at), area = load(p->area + at);
    real3 v = {s->velocity.x + (s->spin.y * z - s->spin.z * y), s->velocity.y + (s->spin.z * x - s->spin.x * z),
               s->velocity.z + (s->spin.x * y - s->spin.y * x)};
    real depth = s->depth + (s->down.x * x + s->down.y * y + s->down.z * z);
    for (int32_t k = 0; k < s->layers; k++) {
        real into = v8_part_min(v8_part_max(depth - s->top[k], zero), zero + s->thick[k]);
        v.x -= s->slope[k].x * into;
        v.y -= s->slope[k].y * into;
        v.z -= s->slope[k].z * into;
    }
    real into = nx * v.x + ny * v.y + nz * v.z;
    real3 t = {v.x - into * nx, v.y - into * ny, v.z - into * nz};
    real positive = v8_part_max(into, zero);
    real push = s->form * (area * (positive * positive));
    real rub = s->skin * (area * v8_part_sqrt(t.x * t.x + t.y * t.y + t.z * t.z));
    real3 f = {push * nx + rub * t.x, push * ny + rub * t.y, push * nz + rub * t.z};
    sum[0] -= f.x;
    sum[1] -= f.y;
    sum[2] -= f.z;
    sum[3] -= y * f.z - z * f.y;
    sum[4] -= z * f.x - x * f.z;
    sum[5] -= x * f.y - y * f.x;
}

static void add_rows(const point_stream *s, const point_rows *p, int32_t eights, point_sums *sums)
{
    for (int lane = 0; lane < V8_LANES; lane += V8_PART_LANES) {
        real sum[6];
        for (int i = 0; i < 6; i++)
            sum[i] = load(&sums->lane[i][lane]);
        for (int32_t k = 0; k < eights; k++)
            add_points(s, p, (ptrdiff_t)V8_LANES * k + lane, sum);
        for (int i = 0; i < 6; i++)
            store(&sums->lane[i][lane], sum[i]);
    }
}

void KERNEL(point_drag)(const point_stream *stream, const point_rows *p, int32_t count, point_sums *sums)
{
    int32_t eights = count / V8_LANES, done = V8_LANES * eights, left = count - done;
    add_rows(stream, p, eights, sums);
    if (left == 0)
        return;
    /* The rest among points without area. */
    double rest[7][V8_LANES] = {{0}};
    const double *const from[7] = {p->x, p->y, p->z, p->nx, p->ny, p->nz, p->area};
    for (int i = 0; i < 7; i++)
        memcpy(rest[i], from[i] + done, (size_t)left * sizeof(double));
    add_rows(stream, &(point_rows){rest[0], rest[1], rest[2], rest[3], rest[4], rest[5], rest[6]}, 1, sums);
}
