/* Packs floes of like numbers of vertices into batches for the kernel, and hands their loads back. */
#include "fluid/level.h"

#include "fluid/facet.h"
#include "fluid/held_kernel.h"
#include "fluid/level_kernel.h"

#include <assert.h>
#include <string.h>

/* Corners in a line of the cache of 64 bytes. */
enum { CORNERS_IN_A_LINE = 4 };

/* The outline, its first vertex again, and that as often as the longest outline of the batch asks for: edges without
   length add nothing. */
static void pack_outline(level_batch *b, int lane, const vec2 *vertex, int32_t n)
{
    vec2 room[2 * PRISM_FEW_VERTICES];
    const vec2 *point = prism_outline(vertex, n, room);
    int32_t points = prism_points(n);
    for (int32_t k = 0; k < points; k++)
        b->corner[k][lane] = point[k];
    for (int32_t k = points; k <= b->sides; k++)
        b->corner[k][lane] = vertex[0];
}

static void pack(const prism_work *w, level_batch *b, int lane, int32_t slot)
{
    const shape_table *s = &w->shapes->shapes;
    int32_t shape = w->bodies->shape[slot];
    prism_pack(w, &b->floes, lane, slot);
    pack_outline(b, lane, w->shapes->vertices.point + s->outline_first[shape], s->outline_count[shape]);
}

static void hold_vectors(held_vectors *to, int32_t at, const prism_lane *from, int lane)
{
    to->x[at] = from[0][lane];
    to->y[at] = from[1][lane];
    to->z[at] = from[2][lane];
}

/* Keeps what a lane of the batch is for the steps to come. */
static void hold(const prism_work *w, const level_batch *b, int lane, int32_t slot)
{
    held_drag_table *h = w->held;
    const level_state *s = &b->state;
    int32_t row = slot / HELD_LANES, at = slot % HELD_LANES;
    h->generation[row].lane[at] = w->bodies->generation[slot];
    h->half[row].lane[at] = b->floes.half[lane];
    h->reach[row].lane[at] = w->shapes->shapes.plan_radius[w->bodies->shape[slot]];
    held_moments *m = &h->moments[row];
    double *const moments[6] = {m->area, m->x, m->y, m->xx, m->yy, m->xy};
    for (int i = 0; i < 6; i++)
        moments[i][at] = s->moments[i][lane];
    hold_vectors(&h->line[row], at, s->line, lane);
    hold_vectors(&h->spin[row], at, s->spin, lane);
    hold_vectors(&h->through_water[row], at, s->through_water, lane);
    hold_vectors(&h->through_air[row], at, s->through_air, lane);
    hold_vectors(&h->water_force[row], at, s->water_drag.force, lane);
    hold_vectors(&h->water_moment[row], at, s->water_drag.moment, lane);
    hold_vectors(&h->air_force[row], at, s->air_drag.force, lane);
    hold_vectors(&h->air_moment[row], at, s->air_drag.moment, lane);
}

static void forget(const prism_work *w, int32_t slot)
{
    if (w->held)
        w->held->generation[slot / HELD_LANES].lane[slot % HELD_LANES] = 0;
}

/* The current that each body of a row meets. */
static held_vectors currents(const prism_work *w, int32_t row)
{
    held_vectors current = {{0}, {0}, {0}};
    for (int32_t i = 0; i < HELD_LANES; i++) {
        int32_t slot = HELD_LANES * row + i, shape = slot < w->bodies->count ? w->bodies->shape[slot] : -1;
        vec3 v = shape >= 0 ? prism_current(w->media, w->bodies, w->shapes, slot) : w->media->current;
        current.x[i] = v.x;
        current.y[i] = v.y;
        current.z[i] = v.z;
    }
    return current;
}

/* Floes whose drag is held: bit i of out[k] for the slot first + 8 k + i. */
static void serve_held(context *ctx, const prism_work *w, int32_t first, int32_t end, const prism_output *out,
                       uint8_t served[PRISM_BLOCK / HELD_LANES])
{
    memset(served, 0, PRISM_BLOCK / HELD_LANES);
    if (!w->held)
        return;
    held_media m = {.wind = w->media->wind,
                    .wet = w->wet,
                    .dry = w->dry,
                    .weight = w->media->water_density * w->media->gravity,
                    .gravity = w->media->gravity};
    bool layered = w->media->profile.count > 0;
    if (!layered)
        m.current = currents(w, 0);
    for (int32_t slot = first; slot < end; slot += HELD_LANES) {
        int32_t row = slot / HELD_LANES, at = slot - first;
        if (layered)
            m.current = currents(w, row);
        served[at / HELD_LANES] =
            (uint8_t)KERNEL_PICK(ctx, held_loads)(&m, w->bodies, w->held, row, out->total + at, out->volume + at);
    }
}

typedef enum floe_lie { LIE_LEVEL, LIE_SUNKEN, LIE_OTHER, LIES } floe_lie;

static floe_lie lie_between(double lowest, double highest, double rise, bool upright)
{
    if (highest + rise <= 0)
        return LIE_SUNKEN;
    return upright && lowest + rise >= 0 && highest - rise <= 0 ? LIE_LEVEL : LIE_OTHER;
}

/* Floes thicker than this part of the outline's radius: sides that are taken at the middle of their depth, as the
   kernel of level floes does, are too coarse for such that roll, and level floes do not roll (docs/decisions/0520). */
static const double DEEP = 0.5;

/* By the outline's radius where that is enough: outlines lie in the order in which floes were made, and waiting for
   them took a tenth of the time; the kernel needs them a moment later. */
static floe_lie lie_of(const prism_work *w, int32_t slot)
{
    const shape_table *s = &w->shapes->shapes;
    int32_t shape = w->bodies->shape[slot];
    const vec2 *outline = w->shapes->vertices.point + s->outline_first[shape];
    __builtin_prefetch(outline);
    __builtin_prefetch(outline + CORNERS_IN_A_LINE);
    mat3 r = quat_matrix(w->bodies->orientation[slot]);
    vec3 up = {r.m[2][0], r.m[2][1], r.m[2][2]};
    double height = w->bodies->position[slot].z, rise = s->half_height[shape] * fabs(up.z);
    double reach = s->plan_radius[shape] * (fabs(up.x) + fabs(up.y));
    floe_lie lie = lie_between(height - reach, height + reach, rise, up.z > 0);
    if (lie != LIE_OTHER)
        return lie;
    double lowest = HUGE_VAL, highest = -HUGE_VAL;
    for (int32_t k = 0; k < s->outline_count[shape]; k++) {
        double z = height + (up.x * outline[k].x + up.y * outline[k].y);
        lowest = fmin(lowest, z);
        highest = fmax(highest, z);
    }
    return lie_between(lowest, highest, rise, up.z > 0);
}

/* How it is worked on. */
static floe_lie treated_as(const prism_work *w, int32_t slot)
{
    const shape_table *s = &w->shapes->shapes;
    int32_t shape = w->bodies->shape[slot];
    floe_lie lie = lie_of(w, slot);
    bool deep = 2 * s->half_height[shape] > DEEP * s->plan_radius[shape];
    return lie == LIE_SUNKEN && (deep || w->level_only) ? LIE_OTHER : lie;
}

/* The floes of a block by how they lie and about how many points they have, each kind in ascending order of slots. */
typedef struct level_list {
    int32_t end[LIES];
    int32_t slot[PRISM_BLOCK];
} level_list;

/* Outlines of as many points are one kind; of longer ones those within a quarter of an octave. */
enum { ALONE = 24, OCTAVES = 8, KINDS = ALONE + 1 + 4 * OCTAVES };
_Static_assert(PRISM_MOST_POINTS <= 16 << OCTAVES, "kinds for outlines of all lengths");
_Static_assert(ALONE >= 16 && ALONE < 32, "the first octave of the longer ones is from 16 to 31");

static int kind_of_points(int32_t points)
{
    if (points <= ALONE)
        return points;
    int octave = 0;
    for (int32_t rest = points >> 5; rest > 0; rest >>= 1)
        octave++;
    return ALONE + 1 + 4 * octave + (int)(points >> (octave + 2) & 3);
}

/* Those that are served have their loads.  Dynamic bodies that are no prisms go to rest; returns how many they are. */
static int32_t find_floes(const prism_work *w, const uint8_t *served, int32_t first, int32_t end, level_list *out,
                          int32_t *rest)
{
    const body_table *t = w->bodies;
    const shape_table *s = &w->shapes->shapes;
    int16_t kind[PRISM_BLOCK];
    int32_t begin[LIES * KINDS + 1] = {0}, left = 0;
    for (int32_t slot = first; slot < end; slot++) {
        int32_t shape = t->shape[slot], at = slot - first;
        bool has_load = served[at / HELD_LANES] >> at % HELD_LANES & 1;
        kind[at] = -1;
        if (has_load || !body_is_dynamic(t, slot))
            continue;
        if (shape < 0 || s->kind[shape] != SHAPE_PRISM || s->outline_count[shape] > PRISM_MOST_POINTS) {
            rest[left++] = slot;
            continue;
        }
        kind[at] = (int16_t)((int)treated_as(w, slot) * KINDS + kind_of_points(prism_points(s->outline_count[shape])));
        begin[kind[at] + 1]++;
    }
    for (int k = 0; k < LIES * KINDS; k++)
        begin[k + 1] += begin[k];
    for (int i = 0; i < LIES; i++)
        out->end[i] = begin[(i + 1) * KINDS];
    for (int32_t slot = first; slot < end; slot++) {
        int k = kind[slot - first];
        if (k >= 0)
            out->slot[begin[k]++] = slot;
    }
    return left;
}

/* The floes from..end-1, at most as many as there are lanes.  Lanes beyond the last one repeat it. */
static void pack_batch(const prism_work *w, const level_list *list, int32_t from, int32_t end, level_batch *b)
{
    b->sides = 0;
    for (int32_t k = from; k < end; k++) {
        int32_t points = prism_points(w->shapes->shapes.outline_count[w->bodies->shape[list->slot[k]]]);
        b->sides = points > b->sides ? points : b->sides;
    }
    b->floes.wet = w->wet;
    b->floes.dry = w->dry;
    for (int lane = 0; lane < PRISM_LANES; lane++)
        pack(w, b, lane, list->slot[from + lane < end ? from + lane : end - 1]);
}

static void run_level_batch(context *ctx, const prism_work *w, const level_list *list, int32_t from, int32_t end,
                            level_batch *b, int32_t first, const prism_output *out)
{
    KERNEL_PICK(ctx, level_loads)(b);
    for (int32_t k = from; k < end; k++) {
        int32_t slot = list->slot[k];
        prism_unpack(&b->floes, (int)(k - from), out, slot - first);
        if (b->sunken)
            forget(w, slot);
        else if (w->held)
            hold(w, b, (int)(k - from), slot);
    }
}

/* Floes that lie in one of both ways that the kernel knows. */
static void run_list(context *ctx, const prism_work *w, const level_list *list, floe_lie lie, int32_t first,
                     const prism_room *room, const prism_output *out)
{
    level_batch batch;
    batch.corner = room->ring[0];
    batch.own = room->own[0];
    batch.floes.weight = w->media->water_density * w->media->gravity;
    batch.sunken = lie == LIE_SUNKEN;
    for (int32_t i = lie > 0 ? list->end[lie - 1] : 0; i < list->end[lie]; i += PRISM_LANES) {
        int32_t end = i + PRISM_LANES < list->end[lie] ? i + PRISM_LANES : list->end[lie];
        pack_batch(w, list, i, end, &batch);
        run_level_batch(ctx, w, list, i, end, &batch, first, out);
    }
}

int32_t level_block(context *ctx, const prism_work *w, int32_t first, int32_t end, const prism_room *room,
                    const prism_output *out, int32_t rest[PRISM_BLOCK])
{
    assert(!w->held || !out->load);
    uint8_t served[PRISM_BLOCK / HELD_LANES];
    serve_held(ctx, w, first, end, out, served);
    level_list list;
    int32_t left = find_floes(w, served, first, end, &list, rest);
    run_list(ctx, w, &list, LIE_LEVEL, first, room, out);
    run_list(ctx, w, &list, LIE_SUNKEN, first, room, out);
    for (int32_t k = list.end[LIE_SUNKEN]; k < list.end[LIE_OTHER]; k++) {
        forget(w, list.slot[k]);
        rest[left++] = list.slot[k];
    }
    return left;
}
