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

/* Rows beyond those that are loaded become those of no body: a view that was given before still shows them. */
static void replace_rows(char *rows, const char *loaded, size_t size, int32_t count, int32_t loaded_count)
{
    if (loaded_count > 0)
        memcpy(rows, loaded, (size_t)loaded_count * size);
    if (count > loaded_count)
        memset(rows + (size_t)loaded_count * size, 0, (size_t)(count - loaded_count) * size);
}

void kept_replace(kept_memory *kept, context *ctx, body_table *bodies, body_table *loaded)
{
    context *through = kept_context(kept, ctx, bodies);
    if (kept->shown && loaded->count <= bodies->capacity) {
        for (int f = 0; f < body_table_info.field_count; f++) {
            const field_info *field = &body_table_info.fields[f];
            replace_rows(table_field(bodies, field), table_field(loaded, field), field->size, bodies->count,
                         loaded->count);
        }
        bodies->count = loaded->count;
        bodies->taken = loaded->taken;
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
