#include "study/condition_table.h"

#include "base/number_text.h"
#include "io/csv_cell.h"
#include "io/file.h"
#include "io/utf8.h"
#include "study/key_names.h"

#include <stdlib.h>
#include <string.h>

/* Far beyond a table of the most conditions with ten keys each. */
enum { TABLE_BYTES_MOST = 1 << 26, KEYS_MOST = 1000 };

typedef struct table_reader {
    context *ctx;
    const char *name, *at, *end;
    int32_t line;
    condition_table *out;
    fram_error *error;
    csv_cell cell;
} table_reader;

static const char hours_head[] = "hours";

static fram_status refuse(const table_reader *r, const char *head, const char *message)
{
    return error_set(r->error, FRAM_ERROR_INPUT, r->name, r->line, head, "%s", message);
}

static bool at_line_end(const table_reader *r) { return r->at == r->end || *r->at == '\n' || *r->at == '\r'; }
static bool is_blank(char c) { return c == ' ' || c == '\t'; }

/* ---- lines ---- */

/* One cell, to its comma or the end of its line. */
static fram_status read_cell(table_reader *r, const char *head, int32_t column)
{
    r->at = csv_cell_read(r->ctx, r->at, r->end, &r->cell);
    return csv_cell_check(r->name, r->line, head, column, &r->cell, r->error);
}

/* Behind a line; false at the end of the file. */
static bool next_line(table_reader *r)
{
    if (r->at < r->end && *r->at == '\r')
        r->at++;
    if (r->at < r->end && *r->at == '\n')
        r->at++;
    r->line++;
    return r->at < r->end;
}

/* The next line that has something on it but a comment, which begins with "#". */
static bool find_line(table_reader *r)
{
    for (bool more = r->at < r->end; more; more = next_line(r)) {
        const char *begin = r->at;
        while (r->at < r->end && is_blank(*r->at))
            r->at++;
        if (!at_line_end(r) && *r->at != '#') {
            r->at = begin;
            return true;
        }
        while (!at_line_end(r))
            r->at++;
    }
    return false;
}

/* ---- heads ---- */

/* Takes "[unit]" off a head, with blanks before it, and refuses a unit that is not the key's; a number may be that of a
 * list's element. */
static fram_status take_unit(table_reader *r, char *head)
{
    char *open = strrchr(head, '['), *close = head + strlen(head) - 1;
    if (!open || open == head || *close != ']')
        return FRAM_OK;
    bool number = strspn(open + 1, "0123456789") == (size_t)(close - open - 1);
    char *name_end = open;
    while (name_end > head && is_blank(name_end[-1]))
        name_end--;
    bool blank = name_end < open;
    *name_end = *open = '\0';
    const scenario_key *key = key_of_path(head);
    if (number && (!key || key->kind == KEY_LIST)) {
        *name_end = blank ? ' ' : '[';
        *open = '[';
        return FRAM_OK;
    }
    *close = '\0';
    bool hours = strcmp(head, hours_head) == 0;
    const char *wanted = hours ? "h" : key && *key->unit ? key->unit : "1";
    if ((!key && !hours) || strcmp(wanted, open + 1) == 0)
        return FRAM_OK;
    return error_set(r->error, FRAM_ERROR_INPUT, r->name, r->line, head, "expected the unit %s, found %.40s", wanted,
                     open + 1);
}

static fram_status add_table_head(table_reader *r)
{
    char *head = r->cell.text.data;
    if (!*head)
        return refuse(r, "", "expected a scenario key at the head of each column, found an empty one");
    if (strpbrk(head, ";\t"))
        return refuse(r, head, "expected columns divided by commas");
    fram_status status = take_unit(r, head);
    for (int32_t k = 0; k < r->out->heads.count && status == FRAM_OK; k++)
        if (strcmp(r->out->heads.data[k], head) == 0)
            status = refuse(r, head, "expected each key once, found it at the head of two columns");
    if (status == FRAM_OK && r->out->heads.count == KEYS_MOST)
        status = refuse(r, head, "the table has too many columns");
    if (status == FRAM_OK && !text_list_add(r->ctx, &r->out->heads, head))
        status = error_memory(r->error);
    return status;
}

static fram_status read_heads(table_reader *r)
{
    if (!find_line(r))
        return refuse(r, NULL, "the file has no head row");
    for (int32_t column = 0;; column++, r->at++) {
        fram_status status = read_cell(r, NULL, column);
        if (status == FRAM_OK)
            status = add_table_head(r);
        if (status != FRAM_OK || at_line_end(r))
            return status;
    }
}

/* ---- rows ---- */

static fram_status read_row(table_reader *r)
{
    const text_list *heads = &r->out->heads;
    for (int32_t k = 0;; k++, r->at++) {
        if (k == heads->count)
            return error_set(r->error, FRAM_ERROR_INPUT, r->name, r->line, NULL,
                             "expected %d cells, a value for each key, found more", (int)heads->count);
        fram_status status = read_cell(r, heads->data[k], k);
        if (status == FRAM_OK && !*r->cell.text.data)
            status = refuse(r, heads->data[k], "expected a value, found an empty cell");
        if (status == FRAM_OK && !text_list_add(r->ctx, &r->out->cells, r->cell.text.data))
            status = error_memory(r->error);
        if (status != FRAM_OK)
            return status;
        if (!at_line_end(r))
            continue;
        if (k + 1 < heads->count)
            return error_set(r->error, FRAM_ERROR_INPUT, r->name, r->line, heads->data[k + 1],
                             "expected %d cells, a value for each key, found %d", (int)heads->count, (int)k + 1);
        return array_push(r->ctx, &r->out->line, r->line) ? FRAM_OK : error_memory(r->error);
    }
}

/* UTF-8 without a NUL byte: what is told of a table is text too. */
static fram_status check_text(table_reader *r)
{
    for (const char *c = r->at; c < r->end;) {
        int32_t code = utf8_next(&c, r->end);
        if (code <= 0)
            return refuse(r, NULL,
                          code < 0 ? "expected UTF-8 text, found other bytes" : "expected text, found a NUL byte");
        r->line += code == '\n';
    }
    r->line = 1;
    return FRAM_OK;
}

/* The column of hours goes out of heads and cells. */
static fram_status take_hours(table_reader *r)
{
    condition_table *t = r->out;
    int32_t at = 0, heads = t->heads.count, kept = 0;
    while (at < heads && strcmp(t->heads.data[at], hours_head) != 0)
        at++;
    if (at == heads)
        return FRAM_OK;
    for (int32_t i = 0; i < t->line.count; i++) {
        double hours = 0;
        r->line = t->line.data[i];
        if (real_from_text(t->cells.data[i * heads + at], &hours) != NUMBER_GOOD || !(hours >= 0))
            return refuse(r, hours_head, "expected how long a year the condition lasts, in hours from 0 on");
        if (!array_push(r->ctx, &t->hours, hours))
            return error_memory(r->error);
    }
    r->line = 1;
    if (heads == 1)
        return refuse(r, hours_head, "expected a scenario key at the head of another column");
    for (int32_t i = 0; i < t->cells.count; i++) {
        if (i % heads == at)
            memory_free(r->ctx, t->cells.data[i]);
        else
            t->cells.data[kept++] = t->cells.data[i];
    }
    t->cells.count = kept;
    memory_free(r->ctx, t->heads.data[at]);
    for (t->heads.count--; at < t->heads.count; at++)
        t->heads.data[at] = t->heads.data[at + 1];
    return FRAM_OK;
}

static fram_status read_all(table_reader *r)
{
    r->at += utf8_mark(r->at, (size_t)(r->end - r->at));
    fram_status status = check_text(r);
    if (status == FRAM_OK)
        status = read_heads(r);
    while (status == FRAM_OK && next_line(r) && find_line(r)) {
        if (r->out->line.count == STUDY_CONDITIONS_MOST)
            return error_set(r->error, FRAM_ERROR_INPUT, r->name, r->line, NULL,
                             "expected at most %d conditions, found more", STUDY_CONDITIONS_MOST);
        status = read_row(r);
    }
    if (status == FRAM_OK && r->out->line.count == 0)
        return refuse(r, NULL, "the table has no rows");
    return status == FRAM_OK ? take_hours(r) : status;
}

fram_status condition_table_parse(context *ctx, const char *name, const char *data, size_t size, condition_table *out,
                                  fram_error *error)
{
    *out = (condition_table){0};
    table_reader r = {.ctx = ctx, .name = name, .at = data, .end = data + size, .line = 1, .out = out, .error = error};
    fram_status status = read_all(&r);
    text_free(ctx, &r.cell.text);
    if (status != FRAM_OK)
        condition_table_free(ctx, out);
    return status;
}

fram_status condition_table_read(context *ctx, const char *path, condition_table *out, fram_error *error)
{
    char *data = NULL;
    size_t size = 0;
    *out = (condition_table){0};
    fram_status status = file_read(ctx, path, TABLE_BYTES_MOST, &data, &size, error);
    if (status == FRAM_OK)
        status = condition_table_parse(ctx, path, data, size, out, error);
    memory_free(ctx, data);
    return status;
}

void condition_table_free(context *ctx, condition_table *t)
{
    text_list_free(ctx, &t->heads);
    text_list_free(ctx, &t->cells);
    array_free(ctx, &t->line);
    array_free(ctx, &t->hours);
}
