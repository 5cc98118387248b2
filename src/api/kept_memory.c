#include "api/kept_memory.h"

#include <string.h>

/* The block that was shown is kept when it would be freed; all else goes to the world's memory. */
static void *keep(void *user, void *ptr, size_t size)
{
    kept_memory *kept = user;
    if (!ptr || ptr != kept->block || size > 0)
        return kept->own(kept->own_user, ptr, size);
    memcpy(kept->block, &kept->oldest, sizeof kept->oldest);
    kept->oldest = kept->block;
    kept->block = NULL;
    return NULL;
}

context *kept_context(kept_memory *kept, context *ctx, const body_table *bodies)
{
    if (!kept->shown)
        return ctx;
    kept->through = *ctx;
    kept->own = ctx->memory;
    kept->own_user = ctx->memory_user;
    kept->through.memory = keep;
    kept->through.memory_user = kept;
    kept->block = table_block(bodies, &body_table_info);
    return &kept->through;
}

void kept_replace(kept_memory *kept, context *ctx, body_table *bodies, body_table *loaded)
{
    context *through = kept_context(kept, ctx, bodies);
    if (kept->shown && loaded->count <= bodies->capacity) {
        for (int f = 0; f < body_table_info.field_count && loaded->count > 0; f++) {
            const field_info *field = &body_table_info.fields[f];
            memcpy(table_field(bodies, field), table_field(loaded, field), (size_t)loaded->count * field->size);
        }
        bodies->count = loaded->count;
        table_free(through, loaded, &body_table_info);
        return;
    }
    table_free(through, bodies, &body_table_info);
    *bodies = *loaded;
    *loaded = (body_table){0};
}

void kept_free(kept_memory *kept, context *ctx)
{
    while (kept->oldest) {
        void *block = kept->oldest;
        memcpy(&kept->oldest, block, sizeof kept->oldest);
        memory_free(ctx, block);
    }
}
