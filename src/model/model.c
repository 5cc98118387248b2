#include "model/model.h"

#include <string.h>

void model_free(context *ctx, model *m)
{
    media_history_free(ctx, &m->history);
    solid_array_free(ctx, &m->solids);
    for (int32_t i = 0; i < m->vessels.count; i++)
        array_free(ctx, &m->vessels.data[i].plan);
    array_free(ctx, &m->vessels);
    polygon_list_free(ctx, &m->sheet.openings);
    memset(m, 0, sizeof *m);
}
