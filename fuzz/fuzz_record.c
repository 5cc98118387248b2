/* The reader of records on any bytes.
   Promises: reading ends; a block lies inside the file; going back to a block gives the same block. */
#include "fuzzing.h"
#include "fuzzing_record.h"
#include "io/record.h"

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
    memory_file file = record_file(data, size);
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
