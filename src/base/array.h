/* Growing arrays of one type:  typedef ARRAY(vec2) vec2_array;  start as {0}, free with array_free.
   The element count is int32_t: a field of 100,000 floes has about a million vertices. */
#ifndef BASE_ARRAY_H
#define BASE_ARRAY_H

#include "base/context.h"

#define ARRAY(T)                 \
    struct {                     \
        T *data;                 \
        int32_t count, capacity; \
    }

/* The one array of indices, and that of bytes, named here so that rooms can hand them to one another. */
typedef ARRAY(int32_t) int32_array;
typedef ARRAY(unsigned char) byte_array;

/* Room for at least `wanted` elements; false when there is no memory (the array is then unchanged). */
#define array_reserve(ctx, a, wanted) \
    array_reserve_raw((ctx), (void **)&(a)->data, &(a)->capacity, (wanted), sizeof *(a)->data)
/* Append one element; false when there is no memory. */
#define array_push(ctx, a, ...)                                                                              \
    ((((a)->count < (a)->capacity) || ((a)->count < INT32_MAX && array_reserve((ctx), (a), (a)->count + 1))) \
         ? ((a)->data[(a)->count++] = (__VA_ARGS__), true)                                                   \
         : false)
/* Set the count, new elements undefined; false when there is no memory. */
#define array_resize(ctx, a, n) (array_reserve((ctx), (a), (n)) ? ((a)->count = (n), true) : false)
#define array_clear(a) ((a)->count = 0)
#define array_free(ctx, a) (memory_free((ctx), (a)->data), (a)->data = NULL, (a)->count = (a)->capacity = 0)

/* Grows by half at least, so that pushing stays linear.  The block is aligned as the context's memory function aligns,
   16 bytes with the C library's: enough for v8_load, not for a dereferenced v8 (simd.h). */
bool array_reserve_raw(context *ctx, void **data, int32_t *capacity, int32_t wanted, size_t size);

#endif
