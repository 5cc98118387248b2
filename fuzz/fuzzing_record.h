/* Records of any bytes with their checksums set right as far as the blocks can be followed: sums would stop nearly
   every input at the door. */
#ifndef FUZZING_RECORD_H
#define FUZZING_RECORD_H

#include "fuzzing.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <zlib.h>

enum { HEAD_SIZE = 24, BLOCK_HEAD_SIZE = 24, CHECKED = 20, LENGTH_AT = 8, PAYLOAD_SUM_AT = 16 };

static void put_sum(uint8_t *at, const uint8_t *data, size_t size)
{
    uint32_t sum = (uint32_t)crc32_z(0, data, size);
    memcpy(at, &sum, sizeof sum);
}

static void record_sums_right(uint8_t *data, size_t size)
{
    if (size < HEAD_SIZE)
        return;
    put_sum(data + CHECKED, data, CHECKED);
    for (size_t at = HEAD_SIZE; size - at >= BLOCK_HEAD_SIZE;) {
        uint64_t length;
        memcpy(&length, data + at + LENGTH_AT, sizeof length);
        if (length <= size - at - BLOCK_HEAD_SIZE)
            put_sum(data + at + PAYLOAD_SUM_AT, data + at + BLOCK_HEAD_SIZE, (size_t)length);
        put_sum(data + at + CHECKED, data + at, CHECKED);
        if (length > size - at - BLOCK_HEAD_SIZE)
            return;
        at += BLOCK_HEAD_SIZE + (size_t)((length + 7) / 8 * 8);
        if (at > size)
            return;
    }
}

/* A file of these bytes with its sums set right; its descriptor is negative where there is none to be had. */
static memory_file record_file(const uint8_t *data, size_t size)
{
    uint8_t *copy = malloc(size + 1);
    if (!copy)
        return (memory_file){.descriptor = -1};
    if (size > 0)
        memcpy(copy, data, size);
    record_sums_right(copy, size);
    memory_file file = memory_file_make(copy, size);
    free(copy);
    return file;
}

#endif
