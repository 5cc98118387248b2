/* Floes that overlap: which do, and cutting them apart. */
#include "ice/import_parts.h"

#include "geometry/box_pairs.h"
#include "ice/crowd.h"
#include "ice/field_measure.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

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
    ARRAY(box2) box;    /* of each floe, as it was */
    polygon_list pieces, rest;
    polygon_list pile; /* parts of one floe that are to be cut */
    int32_array next;  /* of each of them: who cuts it first, as in `by` */
    vec2_array part;   /* the one at work */
    fram_error *error;
} cutting;

static const char cutting_work[] = "cutting floes that overlap";

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

static bool are_apart(box2 a, box2 b)
{
    return a.hi.x < b.lo.x || b.hi.x < a.lo.x || a.hi.y < b.lo.y || b.hi.y < a.lo.y;
}

/* The next of those that cut a floe, from `from` to before `end`, that may meet a part of it with this box; `end`: none
   does. */
static int32_t next_cut(const cutting *c, box2 box, int32_t from, int32_t end)
{
    while (from < end && are_apart(box, c->box.data[c->by.data[from]]))
        from++;
    return from;
}

/* A part on the pile, and who cuts it first. */
static bool pile_up(cutting *c, polygon p, int32_t next)
{
    return polygon_list_push(c->ctx, &c->pile, p) && array_push(c->ctx, &c->next, next);
}

/* The uppermost part into c->part. */
static bool take_uppermost(cutting *c, int32_t *next)
{
    polygon top = polygon_list_get(&c->pile, polygon_list_count(&c->pile) - 1);
    if (!array_resize(c->ctx, &c->part, top.count))
        return false;
    memcpy(c->part.data, top.vertex, (size_t)top.count * sizeof *top.vertex);
    c->pile.vertex.count -= top.count;
    c->pile.start.count--;
    *next = c->next.data[--c->next.count];
    return true;
}

/* The part without what it shares with one other floe, onto the pile, the first of what is left uppermost. */
static fram_status cut_part(cutting *c, polygon part, int32_t next, int32_t end)
{
    polygon_list_clear(&c->rest);
    polygon by = polygon_list_get(&c->was->outlines, c->by.data[next]);
    fram_status status = overlay_difference(c->plane, part, by, &c->rest, c->error);
    for (int32_t i = polygon_list_count(&c->rest) - 1; status == FRAM_OK && i >= 0; i--) {
        polygon p = polygon_list_get(&c->rest, i);
        if (!pile_up(c, p, next_cut(c, polygon_bounds(p), next + 1, end)))
            status = error_memory(c->error);
    }
    return status;
}

/* c->pieces of the floe.  A part is cut to its end before its neighbour is, so that each looks only at those that cut
   it: where one floe lies under ten thousand others, thousands of its parts are far from any one of them. */
static fram_status cut_overlaps(cutting *c, int32_t floe, bool *touched)
{
    int32_t next = c->first.data[floe], end = c->first.data[floe + 1];
    *touched = next < end;
    polygon_list_clear(&c->pieces);
    polygon_list_clear(&c->pile);
    array_clear(&c->next);
    /* The first cut is made whatever the boxes: it brings the outline into the form that its parts have. */
    bool there = pile_up(c, polygon_list_get(&c->was->outlines, floe), next);
    fram_status status = FRAM_OK;
    while (there && status == FRAM_OK && c->next.count > 0) {
        there = take_uppermost(c, &next);
        polygon part = {c->part.data, c->part.count};
        if (there && next < end)
            status = work_continue(c->ctx, cutting_work, floe, polygon_list_count(&c->was->outlines), c->error);
        if (there && status == FRAM_OK && next < end)
            status = cut_part(c, part, next, end);
        else if (there && status == FRAM_OK)
            there = polygon_list_push(c->ctx, &c->pieces, part);
    }
    return there ? status : error_memory(c->error);
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
    if (!array_resize(c->ctx, &c->first, count + 1) || !array_resize(c->ctx, &c->by, c->pairs.count) ||
        !array_resize(c->ctx, &c->box, count))
        return false;
    for (int32_t i = 0; i < count; i++)
        c->box.data[i] = polygon_bounds(polygon_list_get(&c->was->outlines, i));
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
        status = work_continue(c->ctx, cutting_work, i, count, c->error);
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
    array_free(ctx, &c.box);
    polygon_list_free(ctx, &c.pile);
    array_free(ctx, &c.next);
    array_free(ctx, &c.part);
    return status;
}
