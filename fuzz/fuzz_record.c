/* The reader of records on any bytes.  Checksums would stop nearly every input at the door, so those of the head and of
   the blocks are set right first, as far as the blocks can be followed.
   Promises: reading ends; a block lies inside the file; going back to a block gives the same block. */
#include "fuzzing.h"
#include "io/record.h"
#include <string.h>
#include <zlib.h>

enum { HEAD_SIZE = 24, BLOCK_HEAD_SIZE = 24, CHECKED = 20, LENGTH_AT = 8, PAYLOAD_SUM_AT = 16 };

static void put_sum(uint8_t *at, const uint8_t *data, size_t size)
{
    uint32_t sum = (uint32_t)crc32_z(0, data, size);
    memcpy(at, &sum, sizeof sum);
}

static void set_sums_right(uint8_t *data, size_t size)
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

static void read_all(record_reader *reader, size_t size)
{
    record_block block;
    bool found = true;
    fram_error error = {0};
    uint64_t before = 0;
    while (record_next(reader, &block, &found, &error) == FRAM_OK && found) {
        PROMISE(block.offset >= before && block.offset < size && block.size <= size - block.offset);
        PROMISE((uintptr_t)block.data % 8 == 0 || block.size == 0);
        uint32_t type = block.type;
        size_t block_size = block.size;
        uint64_t next = reader->position;
        record_seek(reader, block.offset);
        PROMISE(record_next(reader, &block, &found, &error) == FRAM_OK && found);
        PROMISE(block.type == type && block.size == block_size && reader->position == next);
        before = next;
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    context ctx;
    context_init(&ctx);
    uint8_t *copy = malloc(size + 1);
    if (!copy)
        return 0;
    if (size > 0)
        memcpy(copy, data, size);
    set_sums_right(copy, size);
    memory_file file = memory_file_make(copy, size);
    free(copy);
    if (file.descriptor < 0)
        return 0;
    record_reader reader;
    fram_error error = {0};
    fram_status status = record_open(&ctx, file.path, &reader, &error);
    if (status == FRAM_OK) {
        read_all(&reader, size);
        record_reader_close(&reader);
    } else {
        PROMISE(error.status == status && error.message[0] != '\0');
    }
    memory_file_close(&file);
    return 0;
}
