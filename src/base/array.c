/* Growth of arrays.  Knows bytes only. */
#include "base/array.h"
#include <string.h>

/* Elements of the first allocation: fewer would only mean more of them. */
enum { ARRAY_LEAST = 8 };

bool array_reserve_raw(context *ctx, void **data, int32_t *capacity, int32_t wanted, size_t size)
{
    if (wanted <= *capacity)
        return true;
    int64_t grown = (int64_t)*capacity + *capacity / 2;
    if (grown < wanted)
        grown = wanted;
    if (grown < ARRAY_LEAST)
        grown = ARRAY_LEAST;
    if (grown > INT32_MAX)
        grown = INT32_MAX;
    if (size != 0 && (size_t)grown > SIZE_MAX / size)
        return false;
    /* *data is a T * seen as a void *: moved as bytes, so that no rule of aliasing is bent. */
    void *block;
    memcpy(&block, data, sizeof block);
    block = memory_resize(ctx, block, (size_t)grown * size);
    if (!block)
        return false;
    memcpy(data, &block, sizeof block);
    *capacity = (int32_t)grown;
    return true;
}
