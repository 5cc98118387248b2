#include "io/record_layout.h"

fram_status record_check_block(const char *path, uint32_t type, fram_error *error)
{
    if (type != BLOCK_EARLIER_BIRTHS && type != BLOCK_EARLIER_FRAME && type != BLOCK_TOUCHED_FRAME)
        return FRAM_OK;
    return error_set(error, FRAM_ERROR_INPUT, path, 0, NULL,
                     "an earlier version of Fram wrote this record; run the scenario again");
}
