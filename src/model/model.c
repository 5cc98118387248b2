#include "model/model.h"

#include <string.h>

void model_free(context *ctx, model *m)
{
    media_history_free(ctx, &m->history);
    solid_array_free(ctx, &m->solids);
    array_free(ctx, &m->vessels);
    polygon_list_free(ctx, &m->sheet.openings);
    memset(m, 0, sizeof *m);
}
