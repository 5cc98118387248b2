/* Rings that cross themselves so often that their outlines would never come: what crosses n times has up to n^2 faces,
   and GEOS, which finds them, hears no request to stop. */
#include "ice/import_parts.h"

#include "geometry/box_pairs.h"
#include "geometry/predicate.h"

#include <math.h>

/* A star of 301 corners, 45,000 crossings, took 1.3 s; a zigzag across another one, 160,000, more than four minutes. */
enum { CROSSINGS_MOST = 50000 };
/* Boxes are wider by this part of the ring's size, for those of edges along an axis have no area. */
#define WIDER 1e-9

typedef struct crossing_count {
    polygon p;
    int64_t found;
} crossing_count;

/* Where a ring only touches itself, as at the corners of cells of a raster, nothing multiplies. */
static bool segments_cross(vec2 a, vec2 b, vec2 c, vec2 d)
{
    return orientation(a, b, c) * orientation(a, b, d) < 0 && orientation(c, d, a) * orientation(c, d, b) < 0;
}

static fram_status count_crossing(void *user, int32_t a, int32_t b, fram_error *error)
{
    (void)error; /* the caller knows the ring's place */
    crossing_count *c = user;
    int32_t n = c->p.count, after_a = (a + 1) % n, after_b = (b + 1) % n;
    const vec2 *v = c->p.vertex;
    c->found += segments_cross(v[a], v[after_a], v[b], v[after_b]);
    return c->found > CROSSINGS_MOST ? FRAM_ERROR_INPUT : FRAM_OK;
}

fram_status import_crosses_too_often(context *ctx, polygon p, bool *too_often, fram_error *error)
{
    box2 all = polygon_bounds(p), *box = memory_array(ctx, (size_t)p.count, sizeof *box);
    double margin = WIDER * fmax(all.hi.x - all.lo.x, all.hi.y - all.lo.y);
    if (!box)
        return error_memory(error);
    for (int32_t i = 0; i < p.count; i++) {
        const vec2 edge[2] = {p.vertex[i], p.vertex[(i + 1) % p.count]};
        box[i] = polygon_bounds((polygon){edge, 2});
        box[i].lo = vec2_sub(box[i].lo, vec2_make(margin, margin));
        box[i].hi = vec2_add(box[i].hi, vec2_make(margin, margin));
    }
    crossing_count count = {.p = p};
    fram_status status = box_pairs(ctx, box, p.count, "looking at a crossed ring", count_crossing, &count, error);
    memory_free(ctx, box);
    *too_often = count.found > CROSSINGS_MOST;
    return *too_often ? FRAM_OK : status;
}
