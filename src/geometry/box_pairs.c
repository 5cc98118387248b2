#include "geometry/box_pairs.h"

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

fram_status box_pairs(context *ctx, const box2 *box, int32_t count, const char *what, box_pair_function function,
                      void *user, fram_error *error)
{
    sweep_entry *entry = memory_array(ctx, (size_t)count, sizeof *entry);
    if (!entry)
        return error_memory(error);
    int32_t used = 0;
    for (int32_t i = 0; i < count; i++)
        if (box[i].lo.x < box[i].hi.x && box[i].lo.y < box[i].hi.y)
            entry[used++] = (sweep_entry){box[i], i};
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
