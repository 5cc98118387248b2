#include "io/record_layout.h"

#include <string.h>

fram_status record_check_block(const char *path, uint32_t type, fram_error *error)
{
    if (type != BLOCK_EARLIER_BIRTHS && type != BLOCK_EARLIER_FRAME && type != BLOCK_TOUCHED_FRAME)
        return FRAM_OK;
    return error_set(error, FRAM_ERROR_INPUT, path, 0, NULL,
                     "an earlier version of Fram wrote this record; run the scenario again");
}

fram_status record_append_origin(record_writer *w, vec2 origin, fram_error *error)
{
    const double place[2] = {origin.x, origin.y};
    const record_part part = {place, sizeof place};
    return origin.x == 0 && origin.y == 0 ? FRAM_OK : record_append(w, BLOCK_ORIGIN, &part, 1, error);
}

fram_status record_take_origin(const char *path, const record_block *block, vec2 *origin, fram_error *error)
{
    double place[2] = {0};
    if (block->size == sizeof place)
        memcpy(place, block->data, sizeof place);
    *origin = vec2_make(place[0], place[1]);
    if (block->size == sizeof place && isfinite(place[0]) && isfinite(place[1]))
        return FRAM_OK;
    return error_set(error, FRAM_ERROR_INPUT, path, 0, NULL, "the origin of its places is none");
}

fram_status record_check_layout(context *ctx, const char *path, uint64_t length, vec2 *origin, bool *lost,
                                fram_error *error)
{
    record_reader reader;
    *lost = false;
    fram_status status = record_open(ctx, path, &reader, error);
    if (status != FRAM_OK)
        return status;
    record_block block = {0};
    bool found = true;
    *origin = vec2_make(0, 0);
    const uint64_t first = reader.position;
    while (status == FRAM_OK && found && reader.position < length) {
        status = record_next(&reader, &block, &found, error);
        if (status == FRAM_OK && found)
            status = record_check_block(path, block.type, error);
        if (status == FRAM_OK && found && block.type == BLOCK_ORIGIN)
            status = record_take_origin(path, &block, origin, error);
    }
    *lost = status == FRAM_OK && !found && reader.position == first;
    if (status == FRAM_OK && !found)
        record_tell_damage(&reader, "the run can go on, but pages and reports of it end there: better start it again");
    record_reader_close(&reader);
    return status;
}
