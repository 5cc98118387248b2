/* Tables of runs: every column with its name, and the values of those that are wished for. */
#include "io/csv_lines.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct table_reader {
    context *ctx;
    csv_table *out;
    const csv_wish *wish; /* NULL: all columns */
} table_reader;

/* A name that is wished for as a whole, or behind that of a vessel: yaw and tug.yaw. */
static bool is_wished(const csv_wish *wish, const char *name)
{
    const char *dot = strrchr(name, '.'), *own = dot ? dot + 1 : name;
    bool found = !wish;
    for (int32_t i = 0; wish && i < wish->count && !found; i++)
        found = strcmp(wish->names[i], name) == 0 || strcmp(wish->names[i], own) == 0;
    return found;
}

static int compare_columns(const void *a, const void *b)
{
    const csv_table_column *first = *(const csv_table_column *const *)a, *second = *(const csv_table_column *const *)b;
    int order = strcmp(first->name, second->name);
    return order != 0 ? order : (first > second) - (first < second);
}

/* Of columns that have the name of one before them the first is told. */
static fram_status refuse_double_columns(const table_reader *r, const char *path, fram_error *error)
{
    const csv_table_column *all = r->out->columns.data, *first = NULL, *second = NULL;
    int32_t count = r->out->columns.count;
    const csv_table_column **sorted = memory_array(r->ctx, (size_t)count, sizeof *sorted);
    if (!sorted)
        return error_memory(error);
    for (int32_t k = 0; k < count; k++)
        sorted[k] = all + k;
    qsort(sorted, (size_t)count, sizeof *sorted, compare_columns);
    for (int32_t k = 1; k < count; k++) {
        if (strcmp(sorted[k - 1]->name, sorted[k]->name) == 0 && (!second || sorted[k] < second)) {
            first = sorted[k - 1];
            second = sorted[k];
        }
    }
    memory_free(r->ctx, sorted);
    return second ? csv_refuse_twice(path, second->name, (int32_t)(first - all), (int32_t)(second - all), error)
                  : FRAM_OK;
}

/* "name[unit]" */
static fram_status read_header(const table_reader *r, const char *path, const char *text, fram_error *error)
{
    for (const char *c = text;; c++) {
        size_t whole = strcspn(c, ","), name = strcspn(c, ",["), unit = 0;
        const char *unit_at = c + name;
        if (*unit_at == '[') {
            unit_at++;
            unit = strcspn(unit_at, "],");
        }
        while (name > 0 && c[name - 1] == ' ')
            name--;
        csv_table_column column = {.name = ""};
        if (name >= sizeof column.name || unit >= sizeof column.unit)
            return error_set(error, FRAM_ERROR_INPUT, path, 1, NULL, "column %d: its name or unit is too long",
                             (int)r->out->columns.count + 1);
        memcpy(column.name, c, name);
        memcpy(column.unit, unit_at, unit);
        column.left_out = !is_wished(r->wish, column.name);
        if (!array_push(r->ctx, &r->out->columns, column))
            return error_memory(error);
        c += whole;
        if (!*c)
            return refuse_double_columns(r, path, error);
    }
}

static fram_status read_values(const table_reader *r, const char *path, int line, const char *text, fram_error *error)
{
    const char *c = text;
    for (int32_t k = 0; k < r->out->columns.count; k++) {
        bool last = k + 1 == r->out->columns.count;
        char *end;
        double value;
        bool number = csv_number(c, &value, &end);
        if (end > c && (!number || !isfinite(value)))
            return csv_refuse_number(path, line, r->out->columns.data[k].name, k, c, error);
        if (end == c || *end != (last ? '\0' : ','))
            return error_set(error, FRAM_ERROR_INPUT, path, line, r->out->columns.data[k].name,
                             "expected a number and then %s", last ? "the end of the row" : "a comma");
        if (!r->out->columns.data[k].left_out && !array_push(r->ctx, &r->out->columns.data[k].value, value))
            return error_memory(error);
        c = end + 1;
    }
    r->out->rows++;
    return FRAM_OK;
}

static fram_status read_table_line(void *user, const char *path, int line, const char *text, fram_error *error)
{
    const table_reader *r = user;
    return line == 1 ? read_header(r, path, text, error) : read_values(r, path, line, text, error);
}

fram_status csv_table_read(context *ctx, const char *path, const csv_wish *wish, csv_table *out, fram_error *error)
{
    *out = (csv_table){0};
    table_reader r = {ctx, out, wish};
    const csv_line_reader reader = {read_table_line, &r, false, true};
    fram_status status = csv_read_lines(ctx, path, &reader, error);
    if (status != FRAM_OK)
        csv_table_free(ctx, out);
    return status;
}

void csv_table_free(context *ctx, csv_table *t)
{
    for (int32_t k = 0; k < t->columns.count; k++)
        array_free(ctx, &t->columns.data[k].value);
    array_free(ctx, &t->columns);
    t->rows = 0;
}

const csv_table_column *csv_table_find(const csv_table *t, const char *name)
{
    for (int32_t k = 0; k < t->columns.count; k++) {
        if (!t->columns.data[k].left_out && strcmp(t->columns.data[k].name, name) == 0)
            return &t->columns.data[k];
    }
    return NULL;
}
