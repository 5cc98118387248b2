/* Where the water plane crosses a floe's rims: corners for the kernel, and the wet and dry parts of its caps. */
#include "fluid/tilted.h"

#include "fluid/tilted_kernel.h"

/* A point of the outline as the water plane lies there. */
typedef struct rim_point {
    vec2 place;
    double lower, upper; /* height of the caps over still water; 0 where the plane crosses that rim [m] */
    double depth;        /* of water over the lower cap, up to the thickness [m] */
} rim_point;

typedef struct water_line {
    double height, x, y; /* of the middle plane over still water: height + x r.x + y r.y */
    double rise;         /* of the upper cap over the middle plane [m] */
    double thickness;    /* of the floe [m] */
    double steep;        /* rise over half of that: the cosine of the tilt */
} water_line;

static rim_point point_at(const water_line *w, vec2 place)
{
    double middle = w->height + (w->x * place.x + w->y * place.y);
    rim_point p = {place, middle - w->rise, middle + w->rise, 0};
    if (p.upper <= 0)
        p.depth = w->thickness;
    else if (p.lower < 0)
        p.depth = fmin(-p.lower / w->steep, w->thickness);
    return p;
}

static bool crosses(double a, double b) { return (a < 0 && b > 0) || (a > 0 && b < 0); }

/* Where the upper or the lower rim crosses the water plane between two points. */
static rim_point crossing(const water_line *w, const rim_point *a, const rim_point *b, bool upper)
{
    double from = upper ? a->upper : a->lower, to = upper ? b->upper : b->lower, part = from / (from - to);
    rim_point p = {vec2_add(a->place, vec2_scale(vec2_sub(b->place, a->place), part)), 0, 0, 0};
    if (upper) {
        p.lower = -2 * w->rise;
        p.depth = w->thickness;
    } else {
        p.upper = 2 * w->rise;
    }
    return p;
}

/* The corners of one lane of a part of a cap. */
typedef struct ring_lane {
    tilted_ring *ring;
    int32_t count;
    bool inside; /* not all of them lie on its border */
} ring_lane;

/* The points of a floe, as they are found, into a lane of a batch. */
typedef struct rim {
    tilted_batch *batch;
    int lane;
    int32_t count;
    ring_lane cap[TILTED_CAPS];
} rim;

/* A point of a cap, `into` the medium by that much. */
static void add_corner(rim *r, int cap, vec2 place, double into)
{
    if (into < 0)
        return;
    ring_lane *to = &r->cap[cap];
    to->ring->corner[to->count++][r->lane] = place;
    to->inside = to->inside || into > 0;
}

/* A cap that lies in the water plane is wet. */
static void add_rim_point(rim *r, const rim_point *p)
{
    r->batch->outline.corner[r->count][r->lane] = p->place;
    r->batch->depth[r->count][r->lane] = p->depth;
    r->count++;
    add_corner(r, TILTED_WET_LOWER, p->place, -p->lower);
    add_corner(r, TILTED_WET_UPPER, p->place, -p->upper);
    add_corner(r, TILTED_DRY_LOWER, p->place, p->lower);
    add_corner(r, TILTED_DRY_UPPER, p->place, p->upper);
}

static rim rim_begin(tilted_batch *b, int lane)
{
    rim r = {.batch = b, .lane = lane};
    for (int i = 0; i < TILTED_CAPS; i++)
        r.cap[i] = (ring_lane){&b->cap[i], 0, i == TILTED_WET_LOWER || i == TILTED_WET_UPPER};
    return r;
}

/* The outline with a point wherever the water plane crosses a rim.  On the way out of the water the upper rim crosses
   first, however near to each other the two do.  false: too many points. */
static bool make_rim(const water_line *w, const vec2 *vertex, int32_t n, rim *out)
{
    rim_point a = point_at(w, vertex[n - 1]);
    for (int32_t k = 0; k < n; k++) {
        rim_point b = point_at(w, vertex[k]);
        if (out->count + 3 > prism_most_crossed(n))
            return false;
        bool rising = a.lower < b.lower;
        for (int i = 0; i < 2; i++) {
            bool upper = rising == (i == 0);
            if (upper ? crosses(a.upper, b.upper) : crosses(a.lower, b.lower)) {
                rim_point p = crossing(w, &a, &b, upper);
                add_rim_point(out, &p);
            }
        }
        add_rim_point(out, &b);
        a = b;
    }
    return true;
}

/* Closes the ring of a lane, and repeats its first point to the longest one's end. */
static void pad_ring(tilted_ring *r, int lane, int32_t count)
{
    vec2 first = count > 0 ? r->corner[0][lane] : (vec2){0, 0};
    for (int32_t k = count; k <= r->sides; k++)
        r->corner[k][lane] = first;
}

/* Floes of a batch, and the counts of their outlines. */
typedef struct tilted_lanes {
    int32_t slot[PRISM_LANES];
    int32_t outline[PRISM_LANES], cap[PRISM_LANES][TILTED_CAPS];
    int count;
} tilted_lanes;

static bool is_prism(const prism_work *w, int32_t slot)
{
    int32_t shape = w->bodies->shape[slot];
    return shape >= 0 && w->shapes->shapes.kind[shape] == SHAPE_PRISM;
}

static water_line line_of(const prism_work *w, int32_t slot)
{
    mat3 r = quat_matrix(w->bodies->orientation[slot]);
    double half = w->shapes->shapes.half_height[w->bodies->shape[slot]], steep = fabs(r.m[2][2]);
    return (water_line){w->bodies->position[slot].z, r.m[2][0], r.m[2][1], half * steep, 2 * half, steep};
}

/* false: it has too many points. */
static bool add_floe(const prism_work *w, int32_t slot, tilted_batch *b, tilted_lanes *l)
{
    polygon outline = shape_outline(w->shapes, w->bodies->shape[slot]);
    vec2 room[2 * PRISM_FEW_VERTICES];
    if (outline.count > PRISM_MOST_POINTS)
        return false;
    water_line line = line_of(w, slot);
    rim r = rim_begin(b, l->count);
    if (!make_rim(&line, prism_outline(outline.vertex, outline.count, room), prism_points(outline.count), &r))
        return false;
    prism_pack(w, &b->floes, l->count, slot);
    l->outline[l->count] = r.count;
    for (int i = 0; i < TILTED_CAPS; i++)
        l->cap[l->count][i] = r.cap[i].inside && r.cap[i].count > 2 ? r.cap[i].count : 0;
    l->slot[l->count++] = slot;
    return true;
}

/* Lanes beyond the last floe have its pose and no outline. */
static void clear_lanes(const prism_work *w, tilted_batch *b, tilted_lanes *l)
{
    for (int lane = l->count; lane < PRISM_LANES; lane++) {
        prism_pack(w, &b->floes, lane, l->slot[l->count - 1]);
        l->outline[lane] = 0;
        for (int i = 0; i < TILTED_CAPS; i++)
            l->cap[lane][i] = 0;
    }
}

static int32_t most(const int32_t *count, ptrdiff_t apart)
{
    int32_t n = 0;
    for (int lane = 0; lane < PRISM_LANES; lane++)
        n = count[apart * lane] > n ? count[apart * lane] : n;
    return n;
}

static void pad_lanes(tilted_batch *b, const tilted_lanes *l)
{
    b->outline.sides = most(l->outline, 1);
    for (int i = 0; i < TILTED_CAPS; i++)
        b->cap[i].sides = most(&l->cap[0][i], TILTED_CAPS);
    for (int lane = 0; lane < PRISM_LANES; lane++) {
        int32_t count = l->outline[lane];
        pad_ring(&b->outline, lane, count);
        for (int32_t k = count; k <= b->outline.sides; k++)
            b->depth[k][lane] = count > 0 ? b->depth[0][lane] : 0;
        for (int i = 0; i < TILTED_CAPS; i++)
            pad_ring(&b->cap[i], lane, l->cap[lane][i]);
    }
}

static void run_tilted_batch(context *ctx, const prism_work *w, int32_t first, tilted_batch *b, tilted_lanes *l,
                             const prism_output *out)
{
    clear_lanes(w, b, l);
    pad_lanes(b, l);
    KERNEL_PICK(ctx, tilted_loads)(b);
    for (int lane = 0; lane < l->count; lane++)
        prism_unpack(&b->floes, lane, out, l->slot[lane] - first);
    l->count = 0;
}

int32_t tilted_block(context *ctx, const prism_work *w, int32_t first, const int32_t *slots, int32_t count,
                     const prism_room *room, const prism_output *out, int32_t rest[PRISM_BLOCK])
{
    tilted_batch batch;
    batch.outline.corner = room->ring[0];
    for (int i = 0; i < TILTED_CAPS; i++)
        batch.cap[i].corner = room->ring[1 + i];
    batch.depth = room->depth;
    for (int i = 0; i < 2; i++)
        batch.own[i] = room->own[i];
    tilted_lanes lanes = {.count = 0};
    int32_t left = 0;
    batch.floes.wet = w->wet;
    batch.floes.dry = w->dry;
    batch.floes.weight = w->media->water_density * w->media->gravity;
    for (int32_t i = 0; i < count; i++) {
        if (!is_prism(w, slots[i]) || !add_floe(w, slots[i], &batch, &lanes))
            rest[left++] = slots[i];
        else if (lanes.count == PRISM_LANES)
            run_tilted_batch(ctx, w, first, &batch, &lanes, out);
    }
    if (lanes.count > 0)
        run_tilted_batch(ctx, w, first, &batch, &lanes, out);
    return left;
}
