/* table_file_decode on any bytes, into the tables of a world.  Its checksums and its length are set right first, or
   they would stop nearly every input at the door. Promises: a refusal says why and changes no table; what is accepted
   can be hashed and freed. */
#include "fuzzing.h"
#include "io/table_file.h"
#include "model/world_check.h"
#include <string.h>
#include <zlib.h>

enum { HEAD_SIZE = 32, LENGTH_AT = 16, BODY_SUM_AT = 24, HEAD_SUM_AT = 28 };

static void set_sums_right(uint8_t *data, size_t size)
{
    if (size < HEAD_SIZE)
        return;
    uint64_t length = size;
    memcpy(data + LENGTH_AT, &length, sizeof length);
    uint32_t sum = (uint32_t)crc32_z(0, data + HEAD_SIZE, size - HEAD_SIZE);
    memcpy(data + BODY_SUM_AT, &sum, sizeof sum);
    sum = (uint32_t)crc32_z(0, data, HEAD_SUM_AT);
    memcpy(data + HEAD_SUM_AT, &sum, sizeof sum);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    context ctx;
    context_init(&ctx);
    fram_error error = {0};
    const model m = {0};
    world w;
    uint8_t *copy = malloc(size + 1);
    if (!copy || world_init(&ctx, &m, &w, &error)) {
        free(copy);
        return 0;
    }
    if (size > 0)
        memcpy(copy, data, size);
    set_sums_right(copy, size);

    world_table tables[WORLD_TABLE_COUNT];
    world_tables(&w, tables);
    table_file_number number = {.name = "number"};
    table_file_bytes bytes = {.name = "bytes"};
    table_file content = {tables, WORLD_TABLE_COUNT, &number, 1, &bytes, 1, false};
    uint64_t before = world_hash(&w);
    fram_status status = table_file_decode(&ctx, "fuzz.fram", copy, size, &content, &error);
    if (status == FRAM_OK) {
        world_hash(&w);
        status = world_check(&m, &w, &error);
        PROMISE(status == FRAM_OK || (error.status == status && error.message[0] != '\0'));
        table_file_free_bytes(&ctx, &content);
    } else {
        PROMISE(error.status == status && error.message[0] != '\0');
        PROMISE(status == FRAM_ERROR_MEMORY || world_hash(&w) == before);
    }
    world_free(&ctx, &w);
    free(copy);
    return 0;
}
