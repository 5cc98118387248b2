#include "ice/patch_kernel.h"

#include "base/parts.h"

#include <assert.h>

enum { LANES = V8_PART_LANES, KEPT_PIECES = 16 };

/* ---- sides ---- */

void KERNEL(patch_codes)(const piece_sides *piece, double margin, const vec3 *point, int32_t count, uint32_t *code)
{
    assert(piece->count <= PATCH_INSIDE);
    for (int32_t i = 0; i < count; i++)
        code[i] = PATCH_OUTSIDE_BITS << PATCH_INSIDE;
    const real outside = v8_part_set(margin), inside = v8_part_set(-margin);
    for (int32_t first = 0; first < piece->count; first += LANES) {
        real x, y, nx, ny;
        load_points(piece->vertex, piece->count, piece->readable, first, &x, &y);
        load_points(piece->normal, piece->count, piece->readable, first, &nx, &ny);
        const real offset = nx * x + ny * y;
        const unsigned real_sides = v8_part_bits((mask)(PART_NUMBERS < v8_part_set(piece->count - first)));
        for (int32_t i = 0; i < count; i++) {
            real d = (nx * point[i].x + ny * point[i].y) - offset;
            unsigned out = v8_part_bits((mask)(d > outside)), in = v8_part_bits((mask)(d < inside));
            code[i] |= (out & real_sides) << first;
            code[i] &= ~(((~in & real_sides) << first) << PATCH_INSIDE);
        }
    }
}

/* ---- rays ---- */

typedef struct ray_batch {
    real x, y, z, dx, dy, dz;
} ray_batch;

/* The part of each ray inside something: empty when lo > hi. */
typedef struct ray_span {
    real lo, hi;
} ray_span;

/* Cuts each ray down to one half space: `room` is left of it at the start, `rate` of it goes per metre. */
V8_INLINE void span_cut(real room, real rate, ray_span *s)
{
    const real zero = {0}, one = zero + 1.0;
    mask leaves = (mask)(rate > zero), enters = (mask)(rate < zero);
    real t = room / choose(leaves | enters, rate, one);
    mask shut = ~(leaves | enters) & (mask)(room < zero);
    s->hi = choose(leaves, v8_part_min(t, s->hi), choose(shut, v8_part_set(-HUGE_VAL), s->hi));
    s->lo = choose(enters, v8_part_max(t, s->lo), s->lo);
}

V8_INLINE ray_span span_of_slab(const ray_batch *r, double half_height)
{
    ray_span s = {v8_part_set(-HUGE_VAL), v8_part_set(HUGE_VAL)};
    span_cut(half_height - r->z, r->dz, &s);
    span_cut(half_height + r->z, -r->dz, &s);
    return s;
}

V8_INLINE ray_span span_in_piece(const ray_batch *r, const ray_span *slab, const piece_sides *piece)
{
    ray_span s = *slab;
    for (int32_t k = 0; k < piece->count; k++) {
        vec2 n = piece->normal[k], v = piece->vertex[k];
        span_cut(n.x * (v.x - r->x) + n.y * (v.y - r->y), n.x * r->dx + n.y * r->dy, &s);
    }
    return s;
}

/* Goes on along the rays that are in this span. */
V8_INLINE bool go_on(const ray_span *s, real tolerance, real *way)
{
    real reach = *way + tolerance;
    mask further = (mask)(s->lo <= reach) & (mask)(s->hi > reach);
    *way = choose(further, s->hi, *way);
    return v8_part_bits(further) != 0;
}

/* Pieces are walked through in their order until no ray gets further. */
V8_INLINE real ways_of(const ray_batch *r, const piece_sides *piece, int32_t pieces, double half_height, real tolerance)
{
    const ray_span slab = span_of_slab(r, half_height);
    ray_span kept[KEPT_PIECES];
    real way = {0};
    bool further = false;
    for (int32_t p = 0; p < pieces; p++) {
        ray_span s = span_in_piece(r, &slab, &piece[p]);
        if (p < KEPT_PIECES)
            kept[p] = s;
        further |= go_on(&s, tolerance, &way);
    }
    while (further && pieces > 1) {
        further = false;
        for (int32_t p = 0; p < pieces; p++) {
            ray_span s = p < KEPT_PIECES ? kept[p] : span_in_piece(r, &slab, &piece[p]);
            further |= go_on(&s, tolerance, &way);
        }
    }
    return way;
}

void KERNEL(patch_ways)(const piece_sides *piece, int32_t pieces, double half_height, double tolerance,
                        const patch_rays *rays, double *way)
{
    for (int32_t i = 0; i < rays->stride; i += LANES) {
        const double *at = rays->data + i;
        const ptrdiff_t row = rays->stride;
        const ray_batch r = {load(at),           load(at + row),     load(at + 2 * row),
                             load(at + 3 * row), load(at + 4 * row), load(at + 5 * row)};
        store(way + i, ways_of(&r, piece, pieces, half_height, v8_part_set(tolerance)));
    }
}
