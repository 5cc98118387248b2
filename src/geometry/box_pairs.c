#include "geometry/box_pairs.h"

#include <math.h>
#include <stdlib.h>

typedef struct sweep_entry {
    box2 box;
    int32_t number;
} sweep_entry;

static int by_left_edge(const void *a, const void *b)
{
    const sweep_entry *p = a, *q = b;
    if (p->box.lo.x != q->box.lo.x)
        return p->box.lo.x < q->box.lo.x ? -1 : 1;
    return (p->number > q->number) - (p->number < q->number);
}

/* The sweep goes along the longer side of a field: across a strip all boxes would meet all others. */
static bool goes_along_y(const box2 *box, int32_t count)
{
    box2 all = {{HUGE_VAL, HUGE_VAL}, {-HUGE_VAL, -HUGE_VAL}};
    for (int32_t i = 0; i < count; i++) {
        all.lo = (vec2){fmin(all.lo.x, box[i].lo.x), fmin(all.lo.y, box[i].lo.y)};
        all.hi = (vec2){fmax(all.hi.x, box[i].hi.x), fmax(all.hi.y, box[i].hi.y)};
    }
    return all.hi.y - all.lo.y > all.hi.x - all.lo.x;
}

static box2 turned(box2 b) { return (box2){{b.lo.y, b.lo.x}, {b.hi.y, b.hi.x}}; }

fram_status box_pairs(context *ctx, const box2 *box, int32_t count, const char *what, box_pair_function function,
                      void *user, fram_error *error)
{
    sweep_entry *entry = memory_array(ctx, (size_t)count, sizeof *entry);
    if (!entry)
        return error_memory(error);
    bool along_y = goes_along_y(box, count);
    int32_t used = 0;
    for (int32_t i = 0; i < count; i++)
        if (box[i].lo.x < box[i].hi.x && box[i].lo.y < box[i].hi.y)
            entry[used++] = (sweep_entry){along_y ? turned(box[i]) : box[i], i};
    if (used > 0)
        qsort(entry, (size_t)used, sizeof *entry, by_left_edge);
    fram_status status = FRAM_OK;
    for (int32_t i = 0; i < used && status == FRAM_OK; i++) {
        const sweep_entry *a = &entry[i];
        status = work_continue(ctx, what, i, used, error);
        for (int32_t k = i + 1; k < used && entry[k].box.lo.x < a->box.hi.x && status == FRAM_OK; k++)
            if (entry[k].box.lo.y < a->box.hi.y && a->box.lo.y < entry[k].box.hi.y)
                status = function(user, a->number, entry[k].number, error);
    }
    memory_free(ctx, entry);
    return status;
}
