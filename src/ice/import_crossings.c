/* How a ring meets itself, and when that is so often that its outlines would never come: GEOS, which finds them, gives
   up to one for each place where the ring meets itself, each of which is united with all that came before, and hears no
   request to stop. */
#include "ice/import_parts.h"

#include "geometry/box_pairs.h"
#include "geometry/predicate.h"

#include <math.h>

/* Seconds that a repair may take, and that it takes for each corner of a ring and each other meeting, by which an
   outline grows, at each place where the ring meets itself: a round floe of 90,000 corners with 130 loops took 3 s, two
   zigzags across each other by 1,000 crossings 6 s, a staircase of 1,000 cells 4 s. */
#define REPAIR_MOST 10
#define REPAIR_CORNER 2e-7
#define REPAIR_MEETING 3.6e-6
/* Boxes are wider by this part of the ring's size, for those of edges along an axis have no area. */
#define WIDER 1e-9

bool import_meets_too_often(polygon p, const import_meetings *met)
{
    double places = (double)met->corners + (double)met->elsewhere;
    return places * (REPAIR_CORNER * p.count + REPAIR_MEETING * places) > REPAIR_MOST;
}

static bool segments_cross(vec2 a, vec2 b, vec2 c, vec2 d)
{
    return orientation(a, b, c) * orientation(a, b, d) < 0 && orientation(c, d, a) * orientation(c, d, b) < 0;
}

static bool is_within(vec2 a, vec2 b, vec2 point)
{
    return !vec2_equal(point, a) && !vec2_equal(point, b) && segment_contains(a, b, point);
}

typedef struct meeting_count {
    polygon p;
    import_meetings *met;
} meeting_count;

/* Of corners only the first one of each edge, for the second is the next edge's. */
static fram_status count_meeting(void *user, int32_t a, int32_t b, fram_error *error)
{
    (void)error; /* the caller knows the ring's place */
    meeting_count *c = user;
    int32_t n = c->p.count;
    const vec2 *v = c->p.vertex;
    vec2 from_a = v[a], to_a = v[(a + 1) % n], from_b = v[b], to_b = v[(b + 1) % n];
    c->met->corners += vec2_equal(from_a, from_b);
    c->met->elsewhere +=
        segments_cross(from_a, to_a, from_b, to_b) + is_within(from_a, to_a, from_b) + is_within(from_b, to_b, from_a);
    /* A ring with common corners alone may be cut there, however many they are. */
    return c->met->elsewhere > 0 && import_meets_too_often(c->p, c->met) ? FRAM_ERROR_INPUT : FRAM_OK;
}

fram_status import_count_meetings(context *ctx, polygon p, import_meetings *out, fram_error *error)
{
    box2 all = polygon_bounds(p), *box = memory_array(ctx, (size_t)p.count, sizeof *box);
    double margin = WIDER * fmax(all.hi.x - all.lo.x, all.hi.y - all.lo.y);
    *out = (import_meetings){0};
    if (!box)
        return error_memory(error);
    for (int32_t i = 0; i < p.count; i++) {
        const vec2 edge[2] = {p.vertex[i], p.vertex[(i + 1) % p.count]};
        box[i] = polygon_bounds((polygon){edge, 2});
        box[i].lo = vec2_sub(box[i].lo, vec2_make(margin, margin));
        box[i].hi = vec2_add(box[i].hi, vec2_make(margin, margin));
    }
    meeting_count count = {p, out};
    fram_status status = box_pairs(ctx, box, p.count, "looking at a crossed ring", count_meeting, &count, error);
    memory_free(ctx, box);
    return status == FRAM_ERROR_INPUT ? FRAM_OK : status;
}
