#include "study/series_csv.h"

#include "base/name_search.h"
#include "base/number_text.h"
#include "io/csv_cell.h"
#include "io/csv_read.h"
#include "io/file.h"
#include "io/utf8.h"

#include <stdio.h>
#include <string.h>

#define BLANKS " \t"

/* Name and unit of "name[unit]" or "name [unit]", blanks about them or not. */
static void split_head(char *head, char unit[UNIT_SIZE])
{
    char *open = strchr(head, '['), *close = open ? strchr(open, ']') : NULL;
    unit[0] = '\0';
    if (open && close) {
        snprintf(unit, UNIT_SIZE, "%.*s", (int)(close - open - 1), open + 1);
        *open = '\0';
    }
    size_t before = strspn(head, BLANKS), length = strlen(head);
    while (length > before && strchr(BLANKS, head[length - 1]))
        length--;
    memmove(head, head + before, length - before);
    head[length - before] = '\0';
}

enum { NO_HEAD = -1, TWO_HEADS = -2 };
#define CONDITION_HEAD "condition"

typedef struct csv_want {
    const char *path;
    int time, value; /* columns; time -1: not read */
    int condition;   /* column of maxima; -1: none */
    int width;       /* columns of the file */
    bool maxima;
    context *ctx;
    csv_cell *cell; /* room for one at a time */
    /* In the column of the condition: of the row that was read, and of those before it that have a maximum. */
    text_buffer own, first;
} csv_want;

/* Sets the width.  Behind it all cells of the head have room. */
static fram_status check_heads(csv_want *want, const char *line, fram_error *error)
{
    fram_status status = FRAM_OK;
    want->width = 0;
    for (const char *c = line + utf8_mark(line, strlen(line)); c && status == FRAM_OK; want->width++) {
        c = csv_cell_next(want->ctx, c, want->cell);
        status = csv_cell_check(want->path, 1, NULL, want->width, want->cell, error);
    }
    return status;
}

/* Number of the column; NO_HEAD without one, with the error set if it must be there; TWO_HEADS with the error set. */
static int find_head(const csv_want *head, const char *line, const char *name, bool must, char unit[UNIT_SIZE],
                     fram_error *error)
{
    char near[NAME_LENGTH_MOST + 1] = "", own[UNIT_SIZE];
    name_search search = name_search_begin(name);
    int at = 0, found = NO_HEAD;
    unit[0] = '\0';
    const char *header = line + utf8_mark(line, strlen(line));
    if (must && *header == '#') {
        error_set(error, FRAM_ERROR_INPUT, head->path, 1, name,
                  "expected the names of the columns, found a comment: comments stand behind the header");
        return NO_HEAD;
    }
    for (const char *c = header; c; at++) {
        c = csv_cell_next(head->ctx, c, head->cell);
        char *text = head->cell->text.data;
        split_head(text, own);
        if (strcmp(text, name) == 0 && found >= 0) {
            csv_refuse_twice(head->path, name, found, at, error);
            return TWO_HEADS;
        }
        if (strcmp(text, name) == 0) {
            found = at;
            memcpy(unit, own, sizeof own);
        }
        name_try(&search, text);
        if (search.found == text) {
            snprintf(near, sizeof near, "%s", text);
            search.found = near; /* the next cell takes the place of the text */
        }
    }
    bool other_marks = strcspn(line, ";\t") < strcspn(line, "\n"), guess = search.found && !other_marks;
    if (must && found < 0)
        error_set(error, FRAM_ERROR_INPUT, head->path, 1, name, "the file has no column of this name%s%s%s",
                  other_marks ? "; columns are divided by commas"
                  : guess     ? "; did you mean "
                              : "",
                  guess ? near : "", guess ? "?" : "");
    return found;
}

/* Numbers of a line; *found false for an empty cell of maxima. */
static fram_status read_line(csv_want *want, const char *line, int number, double *time, double *value, bool *found,
                             fram_error *error)
{
    csv_cell *own = want->cell;
    int column = 0, seen = 0;
    *found = true;
    want->own.count = 0;
    for (const char *c = line; c; column++) {
        c = csv_cell_next(want->ctx, c, own);
        fram_status status = csv_cell_check(want->path, number, NULL, column, own, error);
        if (status != FRAM_OK)
            return status;
        if (column >= want->width && *own->text.data)
            return error_set(error, FRAM_ERROR_INPUT, want->path, number, NULL,
                             "the row has more cells than the header has columns, %d: is one of the commas a decimal "
                             "or a thousands mark?",
                             want->width);
        if (column == want->condition)
            text_add(want->ctx, &want->own, own->text.data);
        if (column != want->time && column != want->value)
            continue;
        if (!*own->text.data && want->maxima) {
            *found = false;
            seen++;
            continue;
        }
        double x = 0;
        /* In quotation marks, too, blanks around a number are none of it. */
        char *begin = own->text.data + strspn(own->text.data, " "), *end = own->text.data + own->text.count;
        while (end > begin && end[-1] == ' ')
            *--end = '\0';
        if (real_from_text(begin, &x) != NUMBER_GOOD)
            return error_set(error, FRAM_ERROR_INPUT, want->path, number, NULL,
                             "column %d: expected a number, found \"%.40s\"", column + 1, begin);
        seen++;
        if (column == want->time)
            *time = x;
        if (column == want->value)
            *value = x;
    }
    if (seen < 1 + (want->time >= 0))
        return error_set(error, FRAM_ERROR_INPUT, want->path, number, NULL, "the row has %d cells, too few", column);
    return FRAM_OK;
}

/* As in the table of all runs of a study.  Maxima of several conditions follow no law that a fit knows. */
static fram_status check_condition(csv_want *want, int number, fram_error *error)
{
    if (want->first.count == 0 && want->own.count > 0)
        text_add(want->ctx, &want->first, want->own.data);
    if (want->own.failed || want->first.failed)
        return error_memory(error);
    if (want->own.count == 0 || strcmp(want->own.data, want->first.data) == 0)
        return FRAM_OK;
    return error_set(
        error, FRAM_ERROR_INPUT, want->path, number, CONDITION_HEAD,
        "holds maxima of conditions %.40s and %.40s, which are no sample of one law: give the rows of one, "
        "or `extremes` in the study",
        want->first.data, want->own.data);
}

/* Rows between two words about how far the reading is. */
enum { ROWS_TOLD = 256 };

int series_line(const series_rows *rows, int32_t row)
{
    return row < rows->line.count ? rows->line.data[row] : row + 2;
}

static fram_status read_lines(context *ctx, csv_want *want, const char *text, series_rows *rows, double_array *value,
                              fram_error *error)
{
    const double size = (double)strlen(text);
    int number = 1;
    for (const char *line = strchr(text, '\n'); line && line[1]; line = strchr(line + 1, '\n')) {
        double t = 0, x = 0;
        bool found = true;
        fram_status status = FRAM_OK;
        if (number++ % ROWS_TOLD == 0)
            status = work_continue(ctx, "reading rows", (double)(line - text), size, error);
        if (status != FRAM_OK)
            return status;
        if (line[1] == '\n' || line[1] == '\r' || line[1] == '#')
            continue;
        status = read_line(want, line + 1, number, &t, &x, &found, error);
        if (status == FRAM_OK && found)
            status = check_condition(want, number, error);
        if (status != FRAM_OK)
            return status;
        if (found && (!array_push(ctx, value, x) || !array_push(ctx, &rows->line, number) ||
                      (want->time >= 0 && !array_push(ctx, &rows->time, t))))
            return error_memory(error);
    }
    return FRAM_OK;
}

fram_status series_refuse_step(const char *path, fram_error *error)
{
    return error_set(error, FRAM_ERROR_INPUT, path, 0, "step",
                     "there is a column `time`, which tells the step: leave the step out");
}

fram_status series_read_csv(context *ctx, const char *path, const series_source *source, series_rows *rows,
                            double_array *value, char unit[UNIT_SIZE], fram_error *error)
{
    char *text = NULL, time_unit[UNIT_SIZE];
    size_t size = 0;
    csv_cell cell = {.flaw = CSV_CELL_SOUND};
    csv_want want = {.path = path, .time = -1, .condition = -1, .maxima = source->maxima, .ctx = ctx, .cell = &cell};
    fram_status readable = file_check(path, error);
    if (readable != FRAM_OK)
        return readable;
    if (!source->channel)
        return error_set(error, FRAM_ERROR_USAGE, NULL, 0, "channel", "is missing: name the column of %s", path);
    fram_status status = file_read(ctx, path, SERIES_BYTES_MOST, &text, &size, error);
    if (status == FRAM_OK && strlen(text) != size)
        status = error_set(error, FRAM_ERROR_INPUT, path, 1, NULL, "expected text, found a NUL byte");
    if (status == FRAM_OK) {
        csv_end_lines(text);
        status = check_heads(&want, text, error);
    }
    if (status == FRAM_OK) {
        want.value = find_head(&want, text, source->channel, true, unit, error);
        status = want.value >= 0 ? FRAM_OK : FRAM_ERROR_INPUT;
    }
    if (status == FRAM_OK && source->maxima) {
        want.condition = find_head(&want, text, CONDITION_HEAD, false, time_unit, error);
        status = want.condition == TWO_HEADS ? FRAM_ERROR_INPUT : FRAM_OK;
    }
    if (status == FRAM_OK && !source->maxima && source->step > 0 &&
        find_head(&want, text, "time", false, time_unit, error) != NO_HEAD)
        status = series_refuse_step(path, error);
    if (status == FRAM_OK && !source->maxima && !(source->step > 0)) {
        want.time = find_head(&want, text, "time", false, time_unit, error);
        if (want.time == TWO_HEADS)
            status = FRAM_ERROR_INPUT;
        else if (*time_unit && strcmp(time_unit, "s") != 0)
            status =
                error_set(error, FRAM_ERROR_INPUT, path, 1, "time", "expected the unit [s], found [%s]", time_unit);
        else if (want.time < 0)
            status = error_set(error, FRAM_ERROR_INPUT, path, 0, "step",
                               "is missing: there is no column `time`, so give the time between rows");
    }
    if (status == FRAM_OK)
        status = read_lines(ctx, &want, text, rows, value, error);
    text_free(ctx, &cell.text);
    text_free(ctx, &want.own);
    text_free(ctx, &want.first);
    memory_free(ctx, text);
    return status;
}
