#include "io/csv_read.h"

#include "io/file.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { NAMES_MOST = 32 };

/* Column number of each name in the header row. */
static fram_status find_columns(const char *path, const char *header, const char *const *names, int32_t count,
                                int32_t *at, fram_error *error)
{
    for (int32_t k = 0; k < count; k++) {
        at[k] = -1;
        int32_t column = 0;
        for (const char *c = header;; c++, column++) {
            size_t length = strcspn(c, ",["), whole = strcspn(c, ",");
            while (length > 0 && c[length - 1] == ' ')
                length--;
            if (length == strlen(names[k]) && strncmp(c, names[k], length) == 0)
                at[k] = column;
            c += whole;
            if (!*c)
                break;
        }
        if (at[k] < 0)
            return error_set(error, FRAM_ERROR_INPUT, path, 1, names[k], "the file has no column of this name");
    }
    return FRAM_OK;
}

static fram_status read_row(context *ctx, const char *path, int line, const char *row, const int32_t *at, int32_t count,
                            double_array *columns, fram_error *error)
{
    int32_t column = 0;
    for (const char *c = row; *c; column++) {
        char *end;
        double value = strtod(c, &end);
        if (end == c || (*end != ',' && *end != '\0'))
            return error_set(error, FRAM_ERROR_INPUT, path, line, NULL, "column %d: expected a number",
                             (int)column + 1);
        for (int32_t k = 0; k < count; k++) {
            if (at[k] == column && !array_push(ctx, &columns[k], value))
                return error_memory(error);
        }
        c = *end ? end + 1 : end;
    }
    for (int32_t k = 0; k < count; k++) {
        if (at[k] >= column)
            return error_set(error, FRAM_ERROR_INPUT, path, line, NULL,
                             "the row has %d values; the header names a column %d that is asked for", (int)column,
                             (int)at[k] + 1);
    }
    return FRAM_OK;
}

fram_status csv_read(context *ctx, const char *path, const char *const *names, int32_t count, double_array *columns,
                     fram_error *error)
{
    int32_t at[NAMES_MOST] = {0};
    if (count > NAMES_MOST)
        return error_set(error, FRAM_ERROR_INTERNAL, path, 0, NULL, "too many columns are asked for");
    FILE *file = fopen(path, "r");
    if (!file)
        return file_error(error, path, "open", errno);
    char *line = NULL;
    size_t room = 0;
    int number = 0;
    fram_status status = FRAM_OK;
    for (ssize_t length; status == FRAM_OK && (length = getline(&line, &room, file)) > 0;) {
        if (line[length - 1] != '\n')
            break; /* cut short */
        line[length - 1] = '\0';
        number++;
        if (strlen(line) + 1 != (size_t)length) {
            status = error_set(error, FRAM_ERROR_INPUT, path, number, NULL, "expected text, found a NUL byte");
            break;
        }
        status = number == 1 ? find_columns(path, line, names, count, at, error)
                             : read_row(ctx, path, number, line, at, count, columns, error);
    }
    if (status == FRAM_OK && number == 0)
        status = error_set(error, FRAM_ERROR_INPUT, path, 1, NULL, "the file has no header row");
    free(line);
    fclose(file);
    return status;
}
