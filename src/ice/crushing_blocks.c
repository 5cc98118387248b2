#include "ice/crushing_blocks.h"

#include "base/pool.h"

void crushing_blocks_free(context *ctx, crushing_blocks *b)
{
    for (int32_t i = 0; i < b->made; i++) {
        array_free(ctx, &b->block.data[i].patches);
        array_free(ctx, &b->block.data[i].contacts);
    }
    array_free(ctx, &b->block);
    b->made = 0;
}

bool crushing_blocks_make(context *ctx, crushing_blocks *b, int32_t count)
{
    if (!array_reserve(ctx, &b->block, count))
        return false;
    for (; b->made < count; b->made++)
        b->block.data[b->made] = (crushing_block){.status = FRAM_OK};
    b->block.count = count;
    for (int32_t i = 0; i < count; i++) {
        array_clear(&b->block.data[i].patches);
        array_clear(&b->block.data[i].contacts);
        b->block.data[i].status = FRAM_OK;
    }
    return true;
}

typedef struct join_work {
    const crushing_blocks *blocks;
    crushing_patch_array *patches;
    contact_array *contacts;
} join_work;

/* A block's patches and contacts to their places, with the numbers that they have there. */
static void place_block(void *arg, int32_t block, int32_t thread)
{
    const join_work *w = arg;
    const crushing_block *b = &w->blocks->block.data[block];
    crushing_patch_array *patches = w->patches;
    contact_array *contacts = w->contacts;
    (void)thread;
    for (int32_t i = 0; i < b->patches.count; i++) {
        crushing_patch *to = &patches->data[b->first_patch + i];
        *to = b->patches.data[i];
        to->contact_first += b->first_contact;
    }
    for (int32_t i = 0; i < b->contacts.count; i++) {
        contact *to = &contacts->data[b->first_contact + i];
        *to = b->contacts.data[i];
        to->patch += b->first_patch;
    }
}

fram_status crushing_blocks_join(context *ctx, crushing_blocks *b, crushing_patch_array *patches,
                                 contact_array *contacts, fram_error *error)
{
    int32_t all_patches = patches->count, all_contacts = contacts->count;
    for (int32_t i = 0; i < b->block.count; i++) {
        crushing_block *from = &b->block.data[i];
        if (from->status != FRAM_OK) {
            if (error)
                *error = from->error;
            return from->status;
        }
        from->first_patch = all_patches;
        from->first_contact = all_contacts;
        all_patches += from->patches.count;
        all_contacts += from->contacts.count;
    }
    if (!array_resize(ctx, patches, all_patches) || !array_resize(ctx, contacts, all_contacts))
        return error_memory(error);
    join_work work = {b, patches, contacts};
    pool_run(ctx, place_block, &work, b->block.count);
    return FRAM_OK;
}
