/* Rows of numbers as text. */
#include "io/csv.h"
#include "base/number_text.h"
#include <math.h>
#include <string.h>

void csv_text_header(context *ctx, const csv_column *columns, int32_t count, text_buffer *out)
{
    for (int32_t c = 0; c < count; c++) {
        const char *unit = columns[c].unit;
        bool bare = !unit || !*unit;
        text_format(ctx, out, "%s%s%s%s%s", columns[c].name, bare ? "" : "[", bare ? "" : unit, bare ? "" : "]",
                    c + 1 < count ? "," : "\n");
    }
}

fram_status csv_create(context *ctx, const char *path, const csv_column *columns, int32_t count, csv_writer *w,
                       fram_error *error)
{
    memset(w, 0, sizeof *w);
    text_buffer header = {0};
    csv_text_header(ctx, columns, count, &header);
    fram_status status = header.failed ? error_memory(error) : file_create(ctx, path, &w->file, error);
    if (status == FRAM_OK) {
        w->column_count = count;
        status = file_write(&w->file, header.data, (size_t)header.count, error);
        if (status != FRAM_OK)
            file_abandon(&w->file);
    }
    text_free(ctx, &header);
    return status;
}

/* That the open file begins with this header and has the end of a row before `length`. */
static fram_status check_file(csv_writer *w, const text_buffer *header, uint64_t length, fram_error *error)
{
    file_writer *file = &w->file;
    size_t size = (size_t)header->count;
    const char *expected = header->data ? header->data : "";
    if (length > file->length)
        return error_set(error, FRAM_ERROR_INPUT, file->path, 0, NULL, "expected at least %llu bytes, found %llu",
                         (unsigned long long)length, (unsigned long long)file->length);
    if (length < size)
        return error_set(error, FRAM_ERROR_INPUT, file->path, 0, NULL,
                         "expected a place after the %zu bytes of the header to continue at, found byte %llu", size,
                         (unsigned long long)length);
    char *found = memory_resize(file->ctx, NULL, size);
    if (!found)
        return error_memory(error);
    fram_status status = file_read_at(file->descriptor, file->path, 0, found, size, error);
    if (status == FRAM_OK && memcmp(found, expected, size) != 0)
        status = error_set(error, FRAM_ERROR_INPUT, file->path, 1, NULL,
                           "expected the columns that this run writes, found others");
    char last = 0;
    if (status == FRAM_OK)
        status = file_read_at(file->descriptor, file->path, length - 1, &last, 1, error);
    if (status == FRAM_OK && last != '\n')
        status = error_set(error, FRAM_ERROR_INPUT, file->path, 0, NULL,
                           "expected the end of a row at byte %llu, found its middle", (unsigned long long)length);
    memory_free(file->ctx, found);
    return status;
}

fram_status csv_continue(context *ctx, const char *path, uint64_t length, const csv_column *columns, int32_t count,
                         csv_writer *w, fram_error *error)
{
    memset(w, 0, sizeof *w);
    text_buffer header = {0};
    csv_text_header(ctx, columns, count, &header);
    fram_status status = header.failed ? error_memory(error) : file_open(ctx, path, &w->file, error);
    if (status == FRAM_OK) {
        w->column_count = count;
        status = check_file(w, &header, length, error);
        if (status != FRAM_OK)
            file_abandon(&w->file);
    }
    text_free(ctx, &header);
    return status;
}

/* Numbers that are put together before they go to the file, whose every call costs as much as a number's text. */
enum { NUMBERS_AT_ONCE = 64, NUMBERS_ROOM = NUMBERS_AT_ONCE * (NUMBER_TEXT_SIZE + 1) };

/* Numbers of a row from *next on, as many as go at once; the bytes of their text. */
static size_t numbers_text(const double *row, int32_t count, int32_t *next, char text[NUMBERS_ROOM])
{
    char *at = text;
    for (int n = 0; n < NUMBERS_AT_ONCE && *next < count; n++, ++*next) {
        if (row[*next] == 0 && !signbit(row[*next]))
            *at++ = '0'; /* half of a series, or more */
        else
            at += real_to_digits(row[*next], CSV_DIGITS, at);
        *at++ = *next + 1 < count ? ',' : '\n';
    }
    return (size_t)(at - text);
}

fram_status csv_append(csv_writer *w, const double *row, fram_error *error)
{
    char text[NUMBERS_ROOM];
    fram_status status = FRAM_OK;
    for (int32_t next = 0; next < w->column_count && status == FRAM_OK;) {
        size_t size = numbers_text(row, w->column_count, &next, text);
        status = file_write(&w->file, text, size, error);
    }
    return status;
}

void csv_text_row(context *ctx, const double *row, int32_t count, text_buffer *out)
{
    char text[NUMBERS_ROOM];
    for (int32_t next = 0; next < count;) {
        size_t size = numbers_text(row, count, &next, text);
        text_add_bytes(ctx, out, text, size);
    }
}

fram_status csv_flush(csv_writer *w, bool sync, fram_error *error) { return file_flush(&w->file, sync, error); }

uint64_t csv_length(const csv_writer *w) { return w->file.length; }

fram_status csv_close(csv_writer *w, fram_error *error) { return file_close(&w->file, error); }
