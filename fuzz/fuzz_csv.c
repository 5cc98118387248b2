/* csv_read on any bytes, asked for two columns.
   Promises: a refusal says why; all columns come back equally long. */
#include "fuzzing.h"
#include "io/csv_read.h"
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static const char *const names[] = {"time", "force"};
    enum { COLUMNS = sizeof names / sizeof *names };
    context ctx;
    context_init(&ctx);
    memory_file file = memory_file_make(data, size);
    if (file.descriptor < 0)
        return 0;
    double_array columns[COLUMNS] = {0};
    fram_error error = {0};
    fram_status status = csv_read(&ctx, file.path, names, COLUMNS, columns, &error);
    if (status == FRAM_OK)
        PROMISE(columns[0].count == columns[1].count);
    else
        PROMISE(error.status == status && error.message[0] != '\0');
    for (int i = 0; i < COLUMNS; i++)
        array_free(&ctx, &columns[i]);
    memory_file_close(&file);
    return 0;
}
