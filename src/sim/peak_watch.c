#include "sim/peak_watch.h"

#include "io/path.h"
#include "io/record_layout.h"
#include "sim/ice_loads.h"
#include "sim/peak_chain.h"

#include <stdlib.h>
#include <string.h>

_Static_assert((int)PEAK_ZONES == (int)ZONE_COUNT, "a peak tells all zones");

/* Rows of contacts that are kept: a window of more steps has sums of several in each. */
enum { WINDOW_ROWS_MOST = 1000 };

void peak_watch_init(context *ctx, double time_step, double from, peak_watch *p)
{
    *p = (peak_watch){.ctx = ctx, .time_step = time_step, .from = from};
}

static void free_vessels(peak_watch *p)
{
    for (int32_t v = 0; v < p->vessels.count; v++) {
        peak_picker_free(p->ctx, &p->vessels.data[v].picker);
        array_free(p->ctx, &p->vessels.data[v].detail);
    }
    array_free(p->ctx, &p->vessels);
}

void peak_watch_free(peak_watch *p)
{
    for (int32_t i = 0; i < p->ring.count; i++)
        array_free(p->ctx, &p->ring.data[i]);
    array_free(p->ctx, &p->ring);
    array_free(p->ctx, &p->trims);
    free_vessels(p);
}

/* The fewest steps a row that so many rows hold a window of, wherever in the newest one it ends. */
static int32_t block_of(int64_t steps)
{
    int64_t least = (steps - 1 + WINDOW_ROWS_MOST - 2) / (WINDOW_ROWS_MOST - 1);
    return least > 1 ? (int32_t)least : 1;
}

/* The newest row may be of one step. */
static int32_t ring_rows(int64_t steps, int32_t block)
{
    return steps > 0 ? (int32_t)(1 + (steps - 1 + block - 1) / block) : 0;
}

/* Steps in the ring; up to two rows' more than the window has. */
static int64_t known_steps(const peak_watch *p)
{
    return p->filled > 0 ? (int64_t)(p->filled - 1) * p->block + p->within : 0;
}

static bool begin_vessels(peak_watch *p, int32_t vessels)
{
    free_vessels(p);
    for (int32_t v = 0; v < vessels; v++) {
        vessel_peaks fresh = {0};
        if (!peak_picker_init(p->ctx, PEAK_SEPARATION * p->window, p->from, (int32_t)p->steps, &fresh.picker) ||
            !array_push(p->ctx, &p->vessels, fresh)) {
            peak_picker_free(p->ctx, &fresh.picker);
            return false;
        }
    }
    return true;
}

bool peak_watch_begin(peak_watch *p, const world *w)
{
    int64_t steps = load_window_length(w);
    if (p->vessels.count == w->vessels.count && p->steps == steps)
        return true;
    p->block = block_of(steps);
    p->window = (double)steps * p->time_step;
    p->steps = steps;
    int32_t had = p->ring.count;
    if (!array_resize(p->ctx, &p->ring, ring_rows(steps, p->block)))
        return false;
    for (int32_t i = had; i < p->ring.count; i++)
        p->ring.data[i] = (ice_share_array){0};
    return begin_vessels(p, w->vessels.count);
}

bool peak_watch_await(peak_watch *p, const world *w)
{
    if (!peak_watch_begin(p, w))
        return false;
    int64_t unknown = p->steps - known_steps(p);
    if (unknown <= 0 || known_steps(p) >= w->clock.step[0])
        return true;
    /* Half a step less: rounding must not move it by one. */
    p->from = fmax(p->from, w->clock.time[0] + ((double)unknown - 0.5) * p->time_step);
    for (int32_t v = 0; v < p->vessels.count; v++)
        p->vessels.data[v].picker.from = p->from;
    return true;
}

void peak_watch_forget(peak_watch *p) { p->filled = 0; }

/* ---- contacts of steps ---- */

static vec3 share_force(const ice_share *s) { return vec3_add(s->normal, s->friction); }

static bool are_summed(const ice_share *a, const ice_share *b)
{
    return a->body == b->body && a->floe == b->floe && a->vessel == b->vessel && a->mechanism == b->mechanism &&
           a->zone == b->zone;
}

/* At the mean of the two places, by the sizes of their forces. */
static void sum_share(ice_share *sum, const ice_share *s)
{
    double had = vec3_length(share_force(sum)), more = vec3_length(share_force(s));
    if (had + more > 0)
        sum->point = vec3_mad(sum->point, vec3_sub(s->point, sum->point), more / (had + more));
    sum->normal = vec3_add(sum->normal, s->normal);
    sum->friction = vec3_add(sum->friction, s->friction);
}

/* Looked for from the last one found on, beside which the next one mostly stands. */
static bool add_to_row(context *ctx, ice_share_array *row, const ice_share *s, int32_t *last)
{
    for (int32_t k = 0; k < row->count; k++) {
        int32_t i = (*last + k) % row->count;
        if (are_summed(&row->data[i], s)) {
            sum_share(&row->data[i], s);
            *last = i;
            return true;
        }
    }
    *last = row->count;
    return array_push(ctx, row, *s);
}

static bool sum_step(context *ctx, ice_share_array *row, const world *w)
{
    int32_t last = 0;
    bool good = true;
    for (int32_t i = 0; i < w->scratch.shares.count && good; i++)
        good = add_to_row(ctx, row, &w->scratch.shares.data[i], &last);
    return good;
}

static bool copy_step(context *ctx, ice_share_array *row, const world *w)
{
    int32_t count = w->scratch.shares.count;
    if (!array_resize(ctx, row, count))
        return false;
    if (count > 0)
        memcpy(row->data, w->scratch.shares.data, (size_t)count * sizeof *row->data);
    return true;
}

/* The row of the step that was just done; NULL: the ring has none. */
static ice_share_array *row_of_step(peak_watch *p)
{
    if (p->ring.count == 0)
        return NULL;
    if (p->filled == 0 || p->within >= p->block) {
        array_clear(&p->ring.data[p->next]);
        p->next = (p->next + 1) % p->ring.count;
        p->filled += p->filled < p->ring.count;
        p->within = 0;
    }
    p->within++;
    return &p->ring.data[(p->next + p->ring.count - 1) % p->ring.count];
}

/* Trims of steps that the ring tells no more of go. */
static bool keep_trims(peak_watch *p, const world *w)
{
    int64_t first = w->clock.step[0] - (p->steps + 2 * (int64_t)p->block);
    int32_t old = 0, kept = 0;
    if (p->filled == 0)
        array_clear(&p->trims);
    while (old < p->trims.count && p->trims.data[old].step < first)
        old++;
    for (; old > 0 && old + kept < p->trims.count; kept++)
        p->trims.data[kept] = p->trims.data[old + kept];
    p->trims.count -= old;
    return floe_trims_note(p->ctx, w, &p->trims);
}

fram_status peak_watch_keep(peak_watch *p, const world *w, fram_error *error)
{
    if (!peak_watch_begin(p, w))
        return error_memory(error);
    if (!keep_trims(p, w))
        return error_memory(error);
    ice_share_array *row = row_of_step(p);
    if (!row)
        return FRAM_OK;
    bool good = p->block > 1 ? sum_step(p->ctx, row, w) : copy_step(p->ctx, row, w);
    return good ? FRAM_OK : error_memory(error);
}

/* ---- sums over the window ---- */

/* What one body does to the vessel in the window. */
typedef struct body_sum {
    peak_floe floe;
    double weight, zone[PEAK_ZONES];
} body_sum;
typedef ARRAY(body_sum) body_sum_array;

/* Bodies in the order of their first contact; looked for from the last one found, which most contacts are of. */
static body_sum *sum_of(context *ctx, body_sum_array *sums, const ice_share *s, int32_t *last)
{
    for (int32_t k = 0; k < sums->count; k++) {
        int32_t i = (*last + k) % sums->count;
        const peak_floe *f = &sums->data[i].floe;
        if (f->number == s->floe && (s->floe >= 0 || f->slot == s->body)) {
            *last = i;
            return &sums->data[i];
        }
    }
    const body_sum fresh = {.floe = {.number = s->floe, .slot = s->body, .end_vessel = -1}};
    if (!array_push(ctx, sums, fresh))
        return NULL;
    *last = sums->count - 1;
    return &sums->data[*last];
}

/* The sum of a floe; NULL: none. */
static body_sum *find_sum(const body_sum_array *sums, int32_t number)
{
    for (int32_t i = 0; i < sums->count; i++)
        if (sums->data[i].floe.number == number)
            return &sums->data[i];
    return NULL;
}

static void add_sum(body_sum *to, const body_sum *from)
{
    to->floe.force = vec3_add(to->floe.force, from->floe.force);
    to->floe.point = vec3_add(to->floe.point, from->floe.point);
    to->weight += from->weight;
    for (int i = 0; i < MECHANISM_COUNT; i++)
        to->floe.part[i] += from->floe.part[i];
    for (int i = 0; i < PEAK_ZONES; i++)
        to->zone[i] += from->zone[i];
}

/* A floe that only lost crushed ice is the same one, whatever its number; it has the last one. */
static void join_trimmed(const peak_watch *p, body_sum_array *sums)
{
    for (int32_t i = 0; i < p->trims.count; i++) {
        const floe_trim *t = &p->trims.data[i];
        body_sum *from = find_sum(sums, t->from), *to = find_sum(sums, t->to);
        if (from && to) {
            add_sum(to, from);
            *from = sums->data[--sums->count];
        } else if (from) {
            from->floe.number = t->to;
            from->floe.slot = t->slot;
        }
    }
}

static void add_share(body_sum *b, const ice_share *s, vec3 along, double scale, peak_detail *d)
{
    vec3 normal = vec3_scale(s->normal, scale), friction = vec3_scale(s->friction, scale);
    vec3 force = vec3_add(normal, friction);
    double size = vec3_length(force), of_normal = vec3_dot(normal, along), of_friction = vec3_dot(friction, along);
    b->floe.slot = s->body;
    b->floe.force = vec3_add(b->floe.force, force);
    b->floe.point = vec3_mad(b->floe.point, s->point, size);
    b->weight += size;
    b->floe.part[s->mechanism] += of_normal;
    b->floe.part[MECHANISM_FRICTION] += of_friction;
    b->zone[s->zone] += of_normal + of_friction;
    d->mechanism[s->mechanism] += of_normal;
    d->mechanism[MECHANISM_FRICTION] += of_friction;
    d->zone[s->zone][s->mechanism] += of_normal;
    d->zone[s->zone][MECHANISM_FRICTION] += of_friction;
}

/* The largest in the direction of their sum: a floe may push against the load. */
static int32_t largest(const double *value, int32_t count)
{
    double sum = 0;
    for (int32_t i = 0; i < count; i++)
        sum += value[i];
    double sign = sum < 0 ? -1 : 1;
    int32_t best = 0;
    for (int32_t i = 1; i < count; i++)
        best = sign * value[i] > sign * value[best] ? i : best;
    return best;
}

static double part_of(const peak_floe *f)
{
    double sum = 0;
    for (int i = 0; i < MECHANISM_COUNT; i++)
        sum += f->part[i];
    return sum;
}

static int compare_sums(const void *a, const void *b)
{
    const peak_floe *x = &((const body_sum *)a)->floe, *y = &((const body_sum *)b)->floe;
    double p = part_of(x), q = part_of(y);
    return p != q ? (p > q ? -1 : 1) : x->number != y->number ? (x->number < y->number ? -1 : 1) : x->slot - y->slot;
}

static void list_floes(body_sum_array *sums, peak_detail *d)
{
    if (sums->count > 1)
        qsort(sums->data, (size_t)sums->count, sizeof *sums->data, compare_sums);
    d->bodies = sums->count;
    for (int32_t i = 0; i < sums->count && i < PEAK_FLOES; i++) {
        body_sum *b = &sums->data[i];
        b->floe.mechanism = (uint8_t)largest(b->floe.part, MECHANISM_COUNT);
        b->floe.zone = (uint8_t)largest(b->zone, PEAK_ZONES);
        b->floe.point = b->weight > 0 ? vec3_scale(b->floe.point, 1 / b->weight) : b->floe.point;
        d->floe[d->floe_count++] = b->floe;
    }
}

/* The part of a row's shares that its last `left` steps have, which are the window's first: as much as these carry of
   the load, so that the parts of a peak add up to it. */
static double part_inside(const world *w, const ice_share_array *row, int64_t left, int32_t vessel, vec3 along)
{
    double whole = 0, inside = 0;
    for (int32_t i = 0; i < row->count; i++)
        whole += row->data[i].vessel == vessel ? vec3_dot(share_force(&row->data[i]), along) : 0;
    for (int64_t i = 0; i < left; i++) /* the window's first step stands where the next one will */
        inside += vec3_dot(w->load_window.force[load_window_row(w, w->clock.step[0] + i, vessel)], along);
    return whole != 0 ? fmin(fmax(inside / whole, 0), 1) : 0; /* of loads both ways this may miss a row's */
}

/* From the oldest row on, each with the mean over the window. */
static bool sum_window(const peak_watch *p, const world *w, int32_t vessel, vec3 along, body_sum_array *sums,
                       peak_detail *d)
{
    int64_t known = known_steps(p), out = known > p->steps ? known - p->steps : 0;
    int32_t last = 0;
    for (int32_t k = 0; k < p->filled; k++) {
        const ice_share_array *row = &p->ring.data[(p->next + p->ring.count - p->filled + k) % p->ring.count];
        int64_t left = p->block - out;
        double part = out == 0 ? 1 : left > 0 ? part_inside(w, row, left, vessel, along) : 0;
        out = left > 0 ? 0 : -left;
        for (int32_t i = 0; i < row->count && part > 0; i++) {
            if (row->data[i].vessel != vessel)
                continue;
            body_sum *b = sum_of(p->ctx, sums, &row->data[i], &last);
            if (!b)
                return false;
            add_share(b, &row->data[i], along, part / (double)p->steps, d);
        }
    }
    return true;
}

fram_status peak_watch_explain(peak_watch *p, world *w, int32_t vessel, peak_detail *d, fram_error *error)
{
    memset(d, 0, sizeof *d);
    vec3 force = load_window_average(w, vessel).force;
    d->time = w->clock.time[0];
    d->load = sqrt(force.x * force.x + force.y * force.y);
    d->window = p->window;
    d->vessel = vessel;
    d->force = force;
    vec3 along = d->load > 0 ? vec3_make(force.x / d->load, force.y / d->load, 0) : vec3_make(0, 0, 0);
    body_sum_array sums = {0};
    bool good = sum_window(p, w, vessel, along, &sums, d);
    join_trimmed(p, &sums);
    if (good)
        list_floes(&sums, d);
    array_free(p->ctx, &sums);
    if (!good || !contact_web_make(p->ctx, w))
        return error_memory(error);
    force_chain *chain = memory_array(p->ctx, 1, sizeof *chain);
    if (!chain)
        return error_memory(error);
    for (int32_t i = 0; i < d->floe_count && i < PEAK_CHAINS; i++)
        peak_chain_add(w, p->time_step, &p->trims, chain, &d->floe[i], d);
    memory_free(p->ctx, chain);
    return FRAM_OK;
}

/* ---- the largest ones ---- */

/* The room of the candidate. */
static bool has_room(peak_watch *p, vessel_peaks *v)
{
    bool good = true;
    while (good && v->detail.count <= v->picker.candidate.room)
        good = array_push(p->ctx, &v->detail, (peak_detail){0});
    return good;
}

/* What is not explained as it rises is not among the largest, and never will be. */
fram_status peak_watch_step(peak_watch *p, world *w, fram_error *error)
{
    fram_status status = peak_watch_keep(p, w, error);
    double time = w->clock.time[0];
    for (int32_t v = 0; v < p->vessels.count && status == FRAM_OK; v++) {
        vessel_peaks *peaks = &p->vessels.data[v];
        vec3 force = load_window_average(w, v).force;
        if (!peak_picker_rises(&peaks->picker, time, sqrt(force.x * force.x + force.y * force.y)))
            continue;
        if (!has_room(p, peaks))
            return error_memory(error);
        status = peak_watch_explain(p, w, v, &peaks->detail.data[peaks->picker.candidate.room], error);
    }
    return status;
}

/* ---- the file ---- */

static fram_status append_peak(record_writer *file, unsigned char *room, vec2 origin, const peak_detail *d,
                               fram_error *error)
{
    record_part part = {room, peak_block_pack(d, origin, room)};
    return record_append(file, BLOCK_PEAK, &part, 1, error);
}

/* As if the load ended now. */
static fram_status append_vessel(record_writer *file, unsigned char *room, vec2 origin, const vessel_peaks *v,
                                 fram_error *error)
{
    fram_status status = FRAM_OK;
    peak_picker end = v->picker;
    peak_picker_ends(&end);
    for (int32_t i = 0; i < end.count && status == FRAM_OK; i++)
        status = append_peak(file, room, origin, &v->detail.data[end.kept[i].room], error);
    return status;
}

fram_status peak_watch_write(peak_watch *p, const char *folder, fram_error *error)
{
    char path[PATH_ROOM];
    fram_status status = path_join(folder, "peaks.fram", path, error);
    record_writer file;
    if (status == FRAM_OK)
        status = record_create_beside(p->ctx, path, &file, error);
    if (status != FRAM_OK)
        return status;
    unsigned char *room = memory_array(p->ctx, PEAK_BLOCK_ROOM, 1);
    if (!room)
        status = error_memory(error);
    if (status == FRAM_OK)
        status = record_append_origin(&file, p->origin, error);
    for (int32_t v = 0; v < p->vessels.count && status == FRAM_OK; v++)
        status = append_vessel(&file, room, p->origin, &p->vessels.data[v], error);
    memory_free(p->ctx, room);
    return record_place(&file, status, error);
}
