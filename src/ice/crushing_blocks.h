/* What blocks of pairs found, each written by one thread, joined in their order: crushing_blocks.c, one module with
   crushing.h.  Not for others. */
#ifndef ICE_CRUSHING_BLOCKS_H
#define ICE_CRUSHING_BLOCKS_H

#include "ice/crushing.h"

/* Patches and contacts of one block; numbers of both begin at 0. */
typedef struct crushing_block {
    crushing_patch_array patches;
    contact_array contacts;
    fram_status status;
    fram_error error;
    int32_t first_patch, first_contact; /* where they go */
} crushing_block;

typedef struct crushing_blocks {
    ARRAY(crushing_block) block; /* beyond count: empty, but with their memory */
    int32_t made;
} crushing_blocks;

void crushing_blocks_free(context *ctx, crushing_blocks *b);
/* So many empty blocks, with the memory that they had before.  false: no memory. */
bool crushing_blocks_make(context *ctx, crushing_blocks *b, int32_t count);
/* Appends what all found, in their order; the first that failed gives status and error. */
fram_status crushing_blocks_join(context *ctx, crushing_blocks *b, crushing_patch_array *patches,
                                 contact_array *contacts, fram_error *error);

#endif
