/* Floes that overlap: which do, and cutting them apart. */
#include "ice/import_parts.h"

#include "geometry/box_pairs.h"
#include "ice/crowd.h"
#include "ice/field_measure.h"

#include <math.h>
#include <stdlib.h>

/* A cut piece whose hydraulic diameter, 4 area / perimeter, is under this part of the side of a square as large as its
   floe is a sliver of two digitised edges, no floe: a strip as long as that side goes under a thousandth of the floe.
 */
#define SLIVER 2e-3

/* ---- pairs ---- */

static int by_outlines(const void *a, const void *b)
{
    const import_pair *p = a, *q = b;
    if (p->a != q->a)
        return p->a < q->a ? -1 : 1;
    return (p->b > q->b) - (p->b < q->b);
}

typedef struct pair_search {
    context *ctx;
    const char *name; /* of their file, or NULL */
    const polygon_list *outlines;
    int64_t met; /* boxes that overlap */
    import_pair_array *out;
} pair_search;

static fram_status add_if_common(void *user, int32_t i, int32_t k, fram_error *error)
{
    pair_search *s = user;
    int32_t count = polygon_list_count(s->outlines);
    if (++s->met > crowd_most_pairs(count))
        return crowd_refuse(s->name, count, error);
    import_pair pair = {i < k ? i : k, i < k ? k : i, 0};
    polygon a = polygon_list_get(s->outlines, pair.a), b = polygon_list_get(s->outlines, pair.b);
    pair.area = field_common_area(a, b);
    return !(pair.area > 0) || array_push(s->ctx, s->out, pair) ? FRAM_OK : error_memory(error);
}

fram_status import_pairs(context *ctx, const char *name, const polygon_list *outlines, import_pair_array *out,
                         fram_error *error)
{
    int32_t count = polygon_list_count(outlines);
    pair_search s = {.ctx = ctx, .name = name, .outlines = outlines, .out = out};
    box2 *box = memory_array(ctx, (size_t)count, sizeof *box);
    array_clear(out);
    if (!box)
        return error_memory(error);
    for (int32_t i = 0; i < count; i++)
        box[i] = polygon_bounds(polygon_list_get(outlines, i));
    fram_status status = box_pairs(ctx, box, count, "looking for overlaps", add_if_common, &s, error);
    memory_free(ctx, box);
    if (status == FRAM_OK && out->count > 0)
        qsort(out->data, (size_t)out->count, sizeof *out->data, by_outlines);
    return status;
}

/* ---- cutting ---- */

/* One round of cutting: the field as it was, and as it becomes. */
typedef struct cutting {
    context *ctx;
    overlay *plane;
    const import_options *options;
    import_field *was, now;
    import_pair_array pairs;
    int32_array larger; /* of each pair: the floe that is cut */
    int32_array first;  /* of each floe: it is cut by by[first[i]] to before by[first[i + 1]], */
    int32_array by;     /* in the order of the pairs */
    polygon_list pieces, rest;
    fram_error *error;
} cutting;

static fram_status add_floe_note(cutting *c, int32_t floe, import_event event, bool dropped, vec2 at)
{
    const import_note note = {c->was->ring.data[floe], event, dropped, at};
    return array_push(c->ctx, &c->was->notes, note) ? FRAM_OK : error_memory(c->error);
}

static bool keep(cutting *c, int32_t floe, polygon p)
{
    return polygon_list_push(c->ctx, &c->now.outlines, p) &&
           array_push(c->ctx, &c->now.ring, c->was->ring.data[floe]) &&
           array_push(c->ctx, &c->now.thickness, c->was->thickness.data[floe]);
}

/* c->pieces without what they share with p. */
static fram_status subtract(cutting *c, polygon p)
{
    fram_status status = FRAM_OK;
    polygon_list_clear(&c->rest);
    for (int32_t i = 0; status == FRAM_OK && i < polygon_list_count(&c->pieces); i++)
        status = overlay_difference(c->plane, polygon_list_get(&c->pieces, i), p, &c->rest, c->error);
    polygon_list swap = c->pieces;
    c->pieces = c->rest;
    c->rest = swap;
    return status;
}

static fram_status cut_overlaps(cutting *c, int32_t floe, bool *touched)
{
    polygon whole = polygon_list_get(&c->was->outlines, floe);
    fram_status status = FRAM_OK;
    *touched = false;
    polygon_list_clear(&c->pieces);
    if (!polygon_list_push(c->ctx, &c->pieces, whole))
        return error_memory(c->error);
    for (int32_t i = c->first.data[floe]; status == FRAM_OK && i < c->first.data[floe + 1]; i++) {
        *touched = true;
        status = subtract(c, polygon_list_get(&c->was->outlines, c->by.data[i]));
    }
    return status;
}

static bool is_sliver(polygon p, polygon whole)
{
    return 4 * polygon_area(p) < SLIVER * sqrt(polygon_area(whole)) * polygon_perimeter(p);
}

/* A piece of the floe, if it may stay. */
static fram_status add_cut_piece(cutting *c, int32_t floe, polygon whole, polygon p)
{
    if (polygon_area(p) < c->options->smallest_area)
        return add_floe_note(c, floe, IMPORT_NOTE_SMALL, true, p.vertex[0]);
    if (is_sliver(p, whole))
        return add_floe_note(c, floe, IMPORT_NOTE_SLIVER, true, p.vertex[0]);
    return keep(c, floe, p) ? FRAM_OK : error_memory(c->error);
}

static fram_status replace_floe(cutting *c, int32_t floe)
{
    polygon whole = polygon_list_get(&c->was->outlines, floe);
    bool touched;
    fram_status status = cut_overlaps(c, floe, &touched);
    if (status != FRAM_OK || !touched)
        return status != FRAM_OK ? status : keep(c, floe, whole) ? FRAM_OK : error_memory(c->error);
    status = add_floe_note(c, floe, IMPORT_NOTE_OVERLAP, polygon_list_count(&c->pieces) == 0, whole.vertex[0]);
    for (int32_t i = 0; status == FRAM_OK && i < polygon_list_count(&c->pieces); i++)
        status = add_cut_piece(c, floe, whole, polygon_list_get(&c->pieces, i));
    return status;
}

/* Who cuts whom, by the floe that is cut; a counting sort, which keeps the order of the pairs. */
static bool list_cuts(cutting *c, int32_t count)
{
    if (!array_resize(c->ctx, &c->first, count + 1) || !array_resize(c->ctx, &c->by, c->pairs.count))
        return false;
    int32_t *first = c->first.data;
    for (int32_t i = 0; i <= count; i++)
        first[i] = 0;
    for (int32_t i = 0; i < c->pairs.count; i++)
        first[c->larger.data[i]]++;
    for (int32_t i = 1; i <= count; i++)
        first[i] += first[i - 1];
    for (int32_t i = c->pairs.count - 1; i >= 0; i--) {
        const import_pair *p = &c->pairs.data[i];
        int32_t cut = c->larger.data[i];
        c->by.data[--first[cut]] = p->a == cut ? p->b : p->a;
    }
    return true;
}

static fram_status cut_all(cutting *c)
{
    fram_status status = import_pairs(c->ctx, c->options->name, &c->was->outlines, &c->pairs, c->error);
    for (int32_t i = 0; status == FRAM_OK && i < c->pairs.count; i++) {
        const import_pair *p = &c->pairs.data[i];
        double a = polygon_area(polygon_list_get(&c->was->outlines, p->a));
        double b = polygon_area(polygon_list_get(&c->was->outlines, p->b));
        if (!array_push(c->ctx, &c->larger, a > b ? p->a : p->b))
            status = error_memory(c->error);
    }
    int32_t count = c->pairs.count > 0 ? polygon_list_count(&c->was->outlines) : 0;
    if (status == FRAM_OK && !list_cuts(c, count))
        status = error_memory(c->error);
    for (int32_t i = 0; status == FRAM_OK && i < count; i++) {
        status = work_continue(c->ctx, "cutting floes that overlap", i, count, c->error);
        if (status == FRAM_OK)
            status = replace_floe(c, i);
    }
    return status;
}

/* The new floes take the place of the old ones; the notes stay. */
static void exchange(cutting *c)
{
    import_field old = *c->was;
    *c->was = c->now;
    c->was->notes = old.notes;
    c->now = old;
    c->now.notes.data = NULL;
    c->now.notes.count = c->now.notes.capacity = 0;
}

fram_status import_cut_overlaps(context *ctx, overlay *o, const import_options *options, import_field *field,
                                fram_error *error)
{
    cutting c = {.ctx = ctx, .plane = o, .options = options, .was = field, .error = error};
    fram_status status = cut_all(&c);
    if (status == FRAM_OK && c.pairs.count > 0)
        exchange(&c);
    import_field_free(ctx, &c.now);
    array_free(ctx, &c.pairs);
    array_free(ctx, &c.larger);
    array_free(ctx, &c.first);
    array_free(ctx, &c.by);
    polygon_list_free(ctx, &c.pieces);
    polygon_list_free(ctx, &c.rest);
    return status;
}
