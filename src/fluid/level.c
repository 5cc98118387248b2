/* Packs floes of like numbers of vertices into batches for the kernel, and hands their loads back. */
#include "fluid/level.h"

#include "fluid/facet.h"
#include "fluid/held_kernel.h"
#include "fluid/level_kernel.h"

#include <assert.h>
#include <string.h>

/* Outlines of few vertices have long edges, on which the quadrature of skin drag is coarse: they are cut in half. */
enum { FEW_VERTICES = 4 };
/* Corners in a line of the cache of 64 bytes. */
enum { CORNERS_IN_A_LINE = 4 };

static int32_t points_of(int32_t vertices) { return vertices <= FEW_VERTICES ? 2 * vertices : vertices; }

typedef struct level_work {
    const media *media;
    drag_coefficients half[MATERIAL_COUNT]; /* 1/2 rho C [kg/m3] */
    bool wet, dry;                          /* media whose drag is wanted by any material */
    const body_table *bodies;
    const shape_store *shapes;
    held_drag_table *held; /* may be NULL */
} level_work;

static void set_lane(level_lane *to, int lane, vec3 v)
{
    to[0][lane] = v.x;
    to[1][lane] = v.y;
    to[2][lane] = v.z;
}

static vec3 get_lane(const level_lane *from, int lane) { return (vec3){from[0][lane], from[1][lane], from[2][lane]}; }

/* The outline, its first vertex again, and that as often as the longest outline of the batch asks for: edges without
   length add nothing. */
static void pack_outline(level_batch *b, int lane, const vec2 *vertex, int32_t n)
{
    int32_t points = points_of(n);
    if (points == n) {
        for (int32_t k = 0; k < n; k++)
            b->corner[k][lane] = vertex[k];
    } else {
        for (int32_t k = 0; k < n; k++) {
            b->corner[2 * k][lane] = vertex[k];
            b->corner[2 * k + 1][lane] = vec2_scale(vec2_add(vertex[k], vertex[k + 1 < n ? k + 1 : 0]), 0.5);
        }
    }
    for (int32_t k = points; k <= b->sides; k++)
        b->corner[k][lane] = vertex[0];
}

static void pack(const level_work *w, level_batch *b, int lane, int32_t slot)
{
    const body_table *t = w->bodies;
    const shape_table *s = &w->shapes->shapes;
    const drag_coefficients *c = &w->half[t->material[slot]];
    int32_t shape = t->shape[slot];
    quat q = t->orientation[slot];
    b->height[lane] = t->position[slot].z;
    b->turn[0][lane] = q.w;
    b->turn[1][lane] = q.x;
    b->turn[2][lane] = q.y;
    b->turn[3][lane] = q.z;
    b->half[lane] = s->half_height[shape];
    set_lane(b->spin, lane, t->angular_velocity[slot]);
    set_lane(b->water.velocity, lane, vec3_sub(t->velocity[slot], prism_current(w->media, t, w->shapes, slot)));
    b->water.form[lane] = c->water_form;
    b->water.skin[lane] = c->water_skin;
    if (w->dry) {
        set_lane(b->air.velocity, lane, vec3_sub(t->velocity[slot], w->media->wind));
        b->air.form[lane] = c->air_form;
        b->air.skin[lane] = c->air_skin;
    }
    pack_outline(b, lane, w->shapes->vertices.point + s->outline_first[shape], s->outline_count[shape]);
}

static wrench unpack_wrench(const level_wrench *from, int lane)
{
    return (wrench){get_lane(from->force, lane), get_lane(from->moment, lane)};
}

static void unpack(const level_batch *b, int lane, const level_output *out, int32_t to)
{
    static const wrench none = {{0, 0, 0}, {0, 0, 0}};
    out->total[to] = unpack_wrench(&b->total, lane);
    out->volume[to] = b->volume[lane];
    if (!out->load)
        return;
    fluid_load *load = &out->load[to];
    load->hydrostatic = unpack_wrench(&b->hydrostatic, lane);
    load->submerged_volume = b->volume[lane];
    load->water_drag = b->wet ? unpack_wrench(&b->water_drag, lane) : none;
    load->wind_drag = b->dry ? unpack_wrench(&b->air_drag, lane) : none;
}

static void hold_vectors(held_vectors *to, int32_t at, const level_lane *from, int lane)
{
    to->x[at] = from[0][lane];
    to->y[at] = from[1][lane];
    to->z[at] = from[2][lane];
}

/* Keeps what a lane of the batch is for the steps to come. */
static void hold(const level_work *w, const level_batch *b, int lane, int32_t slot)
{
    held_drag_table *h = w->held;
    const level_state *s = &b->state;
    int32_t row = slot / HELD_LANES, at = slot % HELD_LANES;
    h->generation[row].lane[at] = w->bodies->generation[slot];
    h->half[row].lane[at] = b->half[lane];
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

static void forget(const level_work *w, int32_t slot)
{
    if (w->held)
        w->held->generation[slot / HELD_LANES].lane[slot % HELD_LANES] = 0;
}

/* The current that each body of a row meets. */
static held_vectors currents(const level_work *w, int32_t row)
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
static void serve_held(context *ctx, const level_work *w, int32_t first, int32_t end, const level_output *out,
                       uint8_t served[LEVEL_BLOCK / HELD_LANES])
{
    memset(served, 0, LEVEL_BLOCK / HELD_LANES);
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

/* The floes of a block by their number of points, each number in ascending order of slots. */
typedef struct level_list {
    int32_t count;
    int32_t slot[LEVEL_BLOCK];
    uint8_t points[LEVEL_BLOCK];
} level_list;

/* Those that are served have their loads.  Other dynamic bodies go to rest; returns how many they are. */
static int32_t find_floes(const level_work *w, const uint8_t *served, int32_t first, int32_t end, level_list *out,
                          int32_t *rest)
{
    const body_table *t = w->bodies;
    const shape_table *s = &w->shapes->shapes;
    uint8_t points[LEVEL_BLOCK];
    int32_t begin[LEVEL_VERTICES + 2] = {0}, left = 0;
    for (int32_t slot = first; slot < end; slot++) {
        int32_t shape = t->shape[slot], n = 0, at = slot - first;
        bool has_load = served[at / HELD_LANES] >> at % HELD_LANES & 1;
        if (!has_load && body_is_dynamic(t, slot)) {
            if (shape >= 0 && s->kind[shape] == SHAPE_PRISM && s->outline_count[shape] <= LEVEL_VERTICES) {
                n = points_of(s->outline_count[shape]);
                /* Outlines lie in the order in which floes were made: waiting for them took a tenth of the time. */
                const vec2 *outline = w->shapes->vertices.point + s->outline_first[shape];
                __builtin_prefetch(outline);
                __builtin_prefetch(outline + CORNERS_IN_A_LINE);
            } else {
                rest[left++] = slot;
            }
        }
        points[slot - first] = (uint8_t)n;
        begin[n + 1]++;
    }
    int32_t others = begin[1];
    begin[1] = 0;
    for (int n = 1; n <= LEVEL_VERTICES; n++)
        begin[n + 1] += begin[n];
    for (int32_t slot = first; slot < end; slot++) {
        int32_t n = points[slot - first];
        if (n > 0) {
            out->points[begin[n]] = (uint8_t)n;
            out->slot[begin[n]++] = slot;
        }
    }
    out->count = end - first - others;
    return left;
}

static drag_coefficients half_of(const media *m, const drag_coefficients *c)
{
    double water = 0.5 * m->water_density, air = 0.5 * m->air_density;
    return (drag_coefficients){water * c->water_form, water * c->water_skin, air * c->air_form, air * c->air_skin};
}

/* The floes `from` and on.  Sorted: the last one has the most points.  Lanes beyond the last floe repeat it. */
static void pack_batch(const level_work *w, const level_list *list, int32_t from, level_batch *b)
{
    int32_t last = (from + LEVEL_LANES < list->count ? from + LEVEL_LANES : list->count) - 1;
    b->sides = list->points[last];
    b->wet = w->wet;
    b->dry = w->dry;
    for (int lane = 0; lane < LEVEL_LANES; lane++)
        pack(w, b, lane, list->slot[from + lane < last ? from + lane : last]);
}

/* Floes that are neither level nor sunken go to rest. */
static int32_t run_batch(context *ctx, const level_work *w, const level_list *list, int32_t from, level_batch *b,
                         int32_t first, const level_output *out, int32_t *rest, int32_t left)
{
    KERNEL_PICK(ctx, level_loads)(b);
    for (int32_t k = from; k < list->count && k < from + LEVEL_LANES; k++) {
        int32_t slot = list->slot[k];
        bool level = b->level >> (k - from) & 1;
        if (level || b->sunken >> (k - from) & 1)
            unpack(b, (int)(k - from), out, slot - first);
        else
            rest[left++] = slot;
        if (!level)
            forget(w, slot);
        else if (w->held)
            hold(w, b, (int)(k - from), slot);
    }
    return left;
}

int32_t level_block(context *ctx, const media *m, const drag_coefficients coefficients[MATERIAL_COUNT],
                    const body_table *bodies, const shape_store *shapes, held_drag_table *held, int32_t first,
                    int32_t end, const level_output *out, int32_t rest[LEVEL_BLOCK])
{
    assert(!held || !out->load);
    level_work w = {.media = m, .bodies = bodies, .shapes = shapes, .held = held};
    for (int i = 0; i < MATERIAL_COUNT; i++) {
        const drag_coefficients *c = &w.half[i];
        w.half[i] = half_of(m, &coefficients[i]);
        w.wet = w.wet || c->water_form > 0 || c->water_skin > 0;
        w.dry = w.dry || c->air_form > 0 || c->air_skin > 0;
    }
    uint8_t served[LEVEL_BLOCK / HELD_LANES];
    serve_held(ctx, &w, first, end, out, served);
    level_list list;
    int32_t left = find_floes(&w, served, first, end, &list, rest);
    level_batch batch;
    batch.weight = m->water_density * m->gravity;
    batch.level_only = out->level_only;
    for (int32_t i = 0; i < list.count; i += LEVEL_LANES) {
        pack_batch(&w, &list, i, &batch);
        left = run_batch(ctx, &w, &list, i, &batch, first, out, rest, left);
    }
    return left;
}
