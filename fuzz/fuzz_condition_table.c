/* condition_table_parse on any bytes.
   Promises: a refusal says where and why and leaves nothing behind; what is accepted has a value for every key of every
   row, and no key twice. */
#include "fuzzing.h"
#include "study/condition_table.h"

#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    context ctx;
    context_init(&ctx);
    condition_table t;
    fram_error error = {0};
    fram_status status = condition_table_parse(&ctx, "fuzz.csv", (const char *)data, size, &t, &error);
    if (status == FRAM_OK) {
        PROMISE(t.heads.count > 0 && t.line.count > 0);
        PROMISE((int64_t)t.cells.count == (int64_t)t.heads.count * t.line.count);
        for (int32_t i = 0; i < t.cells.count; i++)
            PROMISE(t.cells.data[i][0] != '\0');
        for (int32_t i = 1; i < t.heads.count; i++)
            PROMISE(strcmp(t.heads.data[i], t.heads.data[i - 1]) != 0);
        condition_table_free(&ctx, &t);
    } else {
        PROMISE(status == FRAM_ERROR_INPUT && error.status == status);
        PROMISE(error.line > 0 && error.message[0] != '\0');
        PROMISE(!t.heads.data && !t.cells.data && !t.line.data);
    }
    return 0;
}
