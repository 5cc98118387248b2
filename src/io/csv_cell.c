#include "io/csv_cell.h"

#include <string.h>

static bool ends_csv_text(const char *c, const char *end) { return c == end || !*c; }
static bool ends_csv_line(const char *c, const char *end) { return ends_csv_text(c, end) || *c == '\n' || *c == '\r'; }
static bool ends_csv_cell(const char *c, const char *end) { return ends_csv_line(c, end) || *c == ','; }
static bool is_cell_blank(char c) { return c == ' ' || c == '\t'; }

static const char *pass_cell_blanks(const char *c, const char *end)
{
    while (!ends_csv_text(c, end) && is_cell_blank(*c))
        c++;
    return c;
}

static const char *read_quoted(context *ctx, const char *c, const char *end, csv_cell *out)
{
    const char *begin = ++c;
    for (; !ends_csv_line(c, end); c++) {
        if (*c != '"')
            continue;
        text_add_bytes(ctx, &out->text, begin, (size_t)(c - begin));
        begin = ++c;
        /* Of two the second one is of the text. */
        if (!ends_csv_text(c, end) && *c == '"')
            continue;
        c = pass_cell_blanks(c, end);
        out->flaw = ends_csv_cell(c, end) ? CSV_CELL_SOUND : CSV_CELL_GOES_ON;
        return c;
    }
    text_add_bytes(ctx, &out->text, begin, (size_t)(c - begin));
    out->flaw = CSV_CELL_OPEN;
    return c;
}

const char *csv_cell_read(context *ctx, const char *c, const char *end, csv_cell *out)
{
    out->text.count = 0;
    out->flaw = CSV_CELL_SOUND;
    text_add(ctx, &out->text, "");
    c = pass_cell_blanks(c, end);
    if (!ends_csv_text(c, end) && *c == '"')
        c = read_quoted(ctx, c, end, out);
    const char *begin = c;
    while (!ends_csv_cell(c, end))
        c++;
    const char *last = c;
    while (last > begin && is_cell_blank(last[-1]))
        last--;
    text_add_bytes(ctx, &out->text, begin, (size_t)(last - begin));
    return c;
}

const char *csv_cell_next(context *ctx, const char *c, csv_cell *out)
{
    c = csv_cell_read(ctx, c, NULL, out);
    return *c == ',' ? c + 1 : NULL;
}

fram_status csv_cell_check(const char *path, int line, const char *key, int column, const csv_cell *c,
                           fram_error *error)
{
    if (c->text.failed)
        return error_memory(error);
    if (c->flaw == CSV_CELL_SOUND)
        return FRAM_OK;
    return error_set(error, FRAM_ERROR_INPUT, path, line, key, "column %d: %s", column + 1,
                     c->flaw == CSV_CELL_OPEN ? "the quotation mark that opens here is not closed in its line"
                                              : "expected a comma behind the quotation mark");
}

void csv_end_lines(char *text)
{
    for (char *c = strchr(text, '\r'); c; c = strchr(c + 1, '\r'))
        if (c[1] != '\n' && !(c[1] == '\r' && c[2] == '\n'))
            *c = '\n';
}
