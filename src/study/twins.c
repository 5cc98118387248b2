#include "study/twins.h"

#include <stdlib.h>
#include <string.h>

typedef struct named {
    char id[CONDITION_ID];
    int32_t condition;
} named;

static int by_name(const void *a, const void *b)
{
    const named *x = a, *y = b;
    int order = memcmp(x->id, y->id, sizeof x->id);
    return order != 0 ? order : (x->condition > y->condition) - (x->condition < y->condition);
}

int32_t *twins_find(context *ctx, char (*id)[CONDITION_ID], int32_t count)
{
    named *list = memory_array(ctx, (size_t)count, sizeof *list);
    int32_t *first = memory_array(ctx, (size_t)count, sizeof *first);
    if (!list || !first) {
        memory_free(ctx, list);
        memory_free(ctx, first);
        return NULL;
    }
    for (int32_t c = 0; c < count; c++) {
        memcpy(list[c].id, id[c], sizeof list[c].id);
        list[c].condition = c;
    }
    qsort(list, (size_t)count, sizeof *list, by_name);
    for (int32_t i = 0; i < count; i++) {
        bool again = i > 0 && memcmp(list[i].id, list[i - 1].id, sizeof list[i].id) == 0;
        first[list[i].condition] = again ? first[list[i - 1].condition] : list[i].condition;
    }
    memory_free(ctx, list);
    return first;
}
