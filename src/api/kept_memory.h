/* Memory of bodies that a program was shown: it may be read as long as the world lives, though it tells the state
   before once the bodies have moved to a larger block.  Knows nothing of what is in it. */
#ifndef API_KEPT_MEMORY_H
#define API_KEPT_MEMORY_H

#include "bodies/body.h"

/* What a world keeps.  Tables grow by half at least, so that all old blocks together take at most twice the last one.
 */
typedef struct kept_memory {
    bool shown;          /* a view was given */
    context through;     /* the world's, but for memory: the block that was shown is not freed */
    memory_function own; /* the world's memory ... */
    void *own_user;      /* ... and its user */
    void *block;         /* of the bodies, while what may move them goes on; NULL: none, or it is kept already */
    void *oldest;        /* the first of the old blocks, each of which begins with the address of the next */
} kept_memory;

/* The context for what may move the bodies: `ctx` itself as long as nothing was shown. */
context *kept_context(kept_memory *kept, context *ctx, const body_table *bodies);
/* `bodies` become `loaded`, which is then empty.  What was shown keeps its place if it has the room. */
void kept_replace(kept_memory *kept, context *ctx, body_table *bodies, body_table *loaded);
void kept_free(kept_memory *kept, context *ctx);

#endif
