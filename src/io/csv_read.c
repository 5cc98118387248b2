#include "io/csv_lines.h"

#include "base/number_text.h"
#include "io/file.h"
#include "io/utf8.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <unistd.h>

/* What may stand about a number, and alone in a line that counts for none. */
#define BLANKS " \t"

/* Characters of a cell that an error shows. */
enum { CELL_TOLD = 40 };

/* Whether a cell of the header is the name in other letters, "CX" for "cx". */
static bool has_other_letters(const char *header, const char *name)
{
    size_t length = strcspn(name, "[");
    for (const char *c = header; *c; c += *c == ',') {
        c += strspn(c, BLANKS);
        if (strncasecmp(c, name, length) == 0 && strchr(",[ ", c[length]))
            return true;
        c += strcspn(c, ",");
    }
    return false;
}

/* Behind a cell that is not asked for, whatever it holds: at the comma or the end of the line.  In quotation marks it
   may have commas; NULL where these marks do not end with the cell, so that nobody knows which column is which. */
static const char *pass_cell(const char *c)
{
    const char *text = c;
    while (*text == ' ' || *text == '\t')
        text++;
    if (*text != '"') {
        while (*c && *c != ',')
            c++;
        return c;
    }
    do {
        text = strchr(text + 1, '"');
        text = text ? text + 1 : NULL;
    } while (text && *text == '"');
    text = text ? text + strspn(text, BLANKS) : NULL;
    return text && (*text == ',' || *text == '\0') ? text : NULL;
}

/* What a header that lacks a name may have instead. */
static const char *header_hint(const char *header)
{
    return strchr(header, '"')      ? "; names stand without quotation marks"
           : strpbrk(header, ";\t") ? "; columns are divided by commas"
           : strchr(header, '\r')   ? "; lines end with line feeds, not with carriage returns alone"
           : header[0] == '#'       ? "; comments are not read"
                                    : "";
}

/* A header cell is the name, or "name[unit]" in the unit that is asked for, if one is: no other unit is taken for it.
 */
static fram_status check_unit(const char *path, const char *header, const char *cell, const char *wanted,
                              fram_error *error)
{
    const char *unit = strchr(wanted, '[');
    size_t name = strcspn(cell, ",["), length = strcspn(cell + name, ",");
    if (!unit || length == 0 || strcmp(unit, "[1]") == 0)
        return FRAM_OK;
    while (length > 0 && cell[name + length - 1] == ' ')
        length--;
    if (length == strlen(unit) && strncmp(cell + name, unit, length) == 0)
        return FRAM_OK;
    return error_set(error, FRAM_ERROR_INPUT, path, 1, wanted, "expected the unit %s, found %.*s%s", unit, (int)length,
                     cell + name, header_hint(header));
}

fram_status csv_refuse_twice(const char *path, const char *name, int32_t first, int32_t second, fram_error *error)
{
    return error_set(error, FRAM_ERROR_INPUT, path, 1, name,
                     "expected one column of this name, found columns %d and %d: rename the one that is not meant",
                     (int)first + 1, (int)second + 1);
}

/* Column number of each name in the header row, and how many it has. */
static fram_status find_columns(const char *path, const char *header, const char *const *names, int32_t count,
                                int32_t *at, int32_t *width, fram_error *error)
{
    for (int32_t k = 0; k < count; k++) {
        at[k] = -1;
        int32_t column = 0;
        for (const char *c = header;; c++, column++) {
            c += strspn(c, BLANKS);
            size_t length = strcspn(c, ",[");
            while (length > 0 && c[length - 1] == ' ')
                length--;
            if (length == strcspn(names[k], "[") && strncmp(c, names[k], length) == 0) {
                if (at[k] >= 0)
                    return csv_refuse_twice(path, names[k], at[k], column, error);
                at[k] = column;
                if (check_unit(path, header, c, names[k], error) != FRAM_OK)
                    return FRAM_ERROR_INPUT;
            }
            const char *next = pass_cell(c);
            c = next ? next : c + strcspn(c, ",");
            if (!*c)
                break;
        }
        *width = column + 1;
        if (at[k] < 0)
            return error_set(error, FRAM_ERROR_INPUT, path, 1, names[k], "the file has no column of this name%s",
                             has_other_letters(header, names[k]) ? "; capital and small letters are not the same"
                                                                 : header_hint(header));
    }
    return FRAM_OK;
}

/* Which of the columns that are asked for comes next, from `column` on; INT32_MAX: none. */
static int32_t next_asked(const int32_t *at, int32_t count, int32_t column)
{
    int32_t next = INT32_MAX;
    for (int32_t k = 0; k < count; k++)
        next = at[k] >= column && at[k] < next ? at[k] : next;
    return next;
}

static bool push_value(context *ctx, const int32_t *at, int32_t count, int32_t column, double value,
                       double_array *columns)
{
    bool good = true;
    for (int32_t k = 0; k < count && good; k++)
        good = at[k] != column || array_push(ctx, &columns[k], value);
    return good;
}

bool csv_number(const char *c, double *value, char **end)
{
    *value = real_read(c, end);
    const char *first = c + (*c == ' ' || *c == '\t' ? strspn(c, BLANKS) : 0);
    first += *first == '-' || *first == '+';
    return *end > c && !(first[0] == '0' && (first[1] == 'x' || first[1] == 'X'));
}

fram_status csv_refuse_number(const char *path, int line, const char *name, int32_t column, const char *cell,
                              fram_error *error)
{
    int length = (int)strcspn(cell, ",");
    return error_set(error, FRAM_ERROR_INPUT, path, line, name, "column %d: expected a number, found \"%.*s\"",
                     (int)column + 1, length < CELL_TOLD ? length : CELL_TOLD, cell);
}

typedef struct column_reader {
    context *ctx;
    const char *const *names;
    int32_t count, width; /* names, columns of the file */
    int32_t *at;          /* column of each name */
    double_array *columns;
} column_reader;

/* `asked` is a column that is asked for. */
static fram_status refuse_cell(const column_reader *r, const char *path, int line, int32_t asked, const char *cell,
                               fram_error *error)
{
    int32_t k = 0;
    while (r->at[k] != asked)
        k++;
    return csv_refuse_number(path, line, r->names[k], asked, cell, error);
}

static fram_status read_row(const column_reader *r, const char *path, int line, const char *row, fram_error *error)
{
    const int32_t *at = r->at;
    int32_t count = r->count, column = 0, asked = next_asked(at, count, 0);
    for (const char *c = row; *c; column++) {
        if (column != asked) {
            c = pass_cell(c);
            if (!c)
                return error_set(error, FRAM_ERROR_INPUT, path, line, NULL,
                                 "column %d: expected a quotation mark at the end of the cell, as at its beginning",
                                 (int)column + 1);
            c += *c == ',';
            continue;
        }
        char *end;
        double value;
        bool number = csv_number(c, &value, &end);
        end += strspn(end, BLANKS);
        if (!number || (*end != ',' && *end != '\0'))
            return refuse_cell(r, path, line, asked, c, error);
        if (!push_value(r->ctx, at, count, column, value, r->columns))
            return error_memory(error);
        asked = next_asked(at, count, column + 1);
        c = *end ? end + 1 : end;
    }
    for (int32_t k = 0; k < count; k++) {
        if (at[k] >= column)
            return error_set(error, FRAM_ERROR_INPUT, path, line, NULL,
                             "the row has %d values; the header names a column %d that is asked for", (int)column,
                             (int)at[k] + 1);
    }
    if (column > r->width)
        return error_set(error, FRAM_ERROR_INPUT, path, line, NULL,
                         "the row has %d values, the header %d columns: is one of the commas a decimal or a thousands "
                         "mark?",
                         (int)column, (int)r->width);
    return FRAM_OK;
}

/* Without its end, be it of one character or two. */
static void trim_end(char *line, size_t length)
{
    if (length > 0 && line[length - 1] == '\n')
        line[--length] = '\0';
    if (length > 0 && line[length - 1] == '\r')
        line[--length] = '\0';
}

/* A part of the file: what stands from `at` to `end` has been read and not yet given out.  A NUL fits behind it. */
typedef struct line_buffer {
    FILE *file;
    char *text;
    size_t at, end;
} line_buffer;
enum { READ_AT_ONCE = 1 << 16, BUFFER_ROOM = CSV_LINE_MOST + READ_AT_ONCE };

/* More of the file behind what is there, which moves to the front: at most a line.  False at the file's end. */
static bool read_part(line_buffer *b)
{
    b->end -= b->at;
    memmove(b->text, b->text + b->at, b->end);
    b->at = 0;
    size_t got = fread(b->text + b->end, 1, READ_AT_ONCE, b->file);
    b->end += got;
    return got > 0;
}

/* The next line with its end, if it has one; otherwise a NUL follows.  *length 0: there is none. */
static fram_status next_line(line_buffer *b, const char *path, int number, char **line, size_t *length,
                             fram_error *error)
{
    const char *end;
    size_t seen = 0;
    do {
        end = memchr(b->text + b->at + seen, '\n', b->end - b->at - seen);
        seen = b->end - b->at;
    } while (!end && seen < CSV_LINE_MOST && read_part(b));
    if (ferror(b->file))
        return file_error(error, path, "read", errno);
    size_t n = end ? (size_t)(end - b->text) + 1 - b->at : seen;
    if (n >= CSV_LINE_MOST)
        return error_set(error, FRAM_ERROR_INPUT, path, number, NULL,
                         "expected at most %d characters in a line, found more", (int)CSV_LINE_MOST);
    *line = b->text + b->at;
    if (!end)
        (*line)[n] = '\0';
    b->at += n;
    *length = n;
    if (memchr(*line, '\0', n))
        return error_set(error, FRAM_ERROR_INPUT, path, number, NULL, "expected text, found a NUL byte");
    return FRAM_OK;
}

/* Rows between two words about how far the reading is. */
enum { ROWS_TOLD = 256 };

static fram_status tell_rows(context *ctx, const csv_line_reader *reader, double done, double size, fram_error *error)
{
    static const char what[] = "reading rows";
    if (reader->stops)
        return work_continue(ctx, what, done, size, error);
    work_tell(ctx, what, done, size);
    return FRAM_OK;
}

static fram_status read_stream(context *ctx, line_buffer *b, uint64_t size, const char *path,
                               const csv_line_reader *reader, fram_error *error)
{
    int number = 0;
    char *line = NULL;
    size_t length = 0;
    double done = 0;
    while (true) {
        fram_status status = next_line(b, path, number + 1, &line, &length, error);
        if (status != FRAM_OK)
            return status;
        if (length == 0 || (line[length - 1] != '\n' && !reader->open_end))
            break;
        if (number++ % ROWS_TOLD == 0)
            status = tell_rows(ctx, reader, done, (double)size, error);
        if (status != FRAM_OK)
            return status;
        done += (double)length;
        trim_end(line, length);
        const char *text = number == 1 ? line + utf8_mark(line, strlen(line)) : line;
        status = reader->read(reader->user, path, number, text, error);
        if (status != FRAM_OK)
            return status;
    }
    return number > 0 ? FRAM_OK : error_set(error, FRAM_ERROR_INPUT, path, 1, NULL, "the file has no header row");
}

fram_status csv_read_lines(context *ctx, const char *path, const csv_line_reader *reader, fram_error *error)
{
    int descriptor;
    uint64_t size;
    fram_status status = file_open_regular(path, CSV_BYTES_MOST, &descriptor, &size, error);
    if (status != FRAM_OK)
        return status;
    line_buffer b = {.text = memory_resize(ctx, NULL, BUFFER_ROOM + 1)};
    b.file = b.text ? fdopen(descriptor, "r") : NULL;
    if (!b.file) {
        status = b.text ? file_error(error, path, "open", errno) : error_memory(error);
        close(descriptor);
    } else {
        status = read_stream(ctx, &b, size, path, reader, error);
        fclose(b.file);
    }
    memory_free(ctx, b.text);
    return status;
}

/* ---- some columns ---- */

static bool is_row(int line, const char *text) { return line > 1 && text[strspn(text, BLANKS)] != '\0'; }

static fram_status read_columns(void *user, const char *path, int line, const char *text, fram_error *error)
{
    column_reader *r = user;
    if (line > 1 && !is_row(line, text))
        return FRAM_OK;
    return line == 1 ? find_columns(path, text, r->names, r->count, r->at, &r->width, error)
                     : read_row(r, path, line, text, error);
}

fram_status csv_read(context *ctx, const char *path, const char *const *names, int32_t count, double_array *columns,
                     fram_error *error)
{
    int32_t *at = memory_array(ctx, (size_t)count, sizeof *at);
    if (!at)
        return error_memory(error);
    column_reader r = {.ctx = ctx, .names = names, .count = count, .at = at, .columns = columns};
    const csv_line_reader reader = {read_columns, &r, true, false};
    fram_status status = csv_read_lines(ctx, path, &reader, error);
    memory_free(ctx, at);
    return status;
}

typedef struct row_finder {
    int32_t left; /* rows before it */
    int line;
} row_finder;

static fram_status find_row(void *user, const char *path, int line, const char *text, fram_error *error)
{
    row_finder *f = user;
    (void)path, (void)error;
    if (is_row(line, text) && f->left-- == 0)
        f->line = line;
    return FRAM_OK;
}

int csv_line_of(context *ctx, const char *path, int32_t row)
{
    row_finder f = {.left = row};
    const csv_line_reader reader = {find_row, &f, true, false};
    return csv_read_lines(ctx, path, &reader, NULL) == FRAM_OK ? f.line : 0;
}
