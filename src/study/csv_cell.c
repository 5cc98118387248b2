#include "study/csv_cell.h"

#include <string.h>

static void add_character(csv_cell *out, char c)
{
    if (out->length + 1 < CSV_CELL_ROOM)
        out->text[out->length++] = c;
    else
        out->flaw = CSV_CELL_CUT;
}

static bool ends_cell(char c) { return c == ',' || c == '\n' || c == '\0'; }

static const char *read_quoted(const char *c, csv_cell *out)
{
    for (c++; *c && *c != '\n'; c++) {
        if (*c == '"' && *++c != '"') {
            c += strspn(c, " \t\r");
            if (!ends_cell(*c))
                out->flaw = CSV_CELL_GOES_ON;
            return c + strcspn(c, ",\n");
        }
        add_character(out, *c);
    }
    out->flaw = CSV_CELL_OPEN;
    return c;
}

const char *csv_cell_next(const char *c, csv_cell *out)
{
    out->length = 0;
    out->flaw = CSV_CELL_SOUND;
    if (*c == '"')
        c = read_quoted(c, out);
    for (; !ends_cell(*c); c++)
        if (*c != '\r')
            add_character(out, *c);
    out->text[out->length] = '\0';
    return *c == ',' ? c + 1 : NULL;
}

fram_status csv_cell_check(const char *path, int line, int column, const csv_cell *c, fram_error *error)
{
    if (c->flaw != CSV_CELL_OPEN && c->flaw != CSV_CELL_GOES_ON)
        return FRAM_OK;
    return error_set(error, FRAM_ERROR_INPUT, path, line, NULL, "column %d: %s", column + 1,
                     c->flaw == CSV_CELL_OPEN ? "the quotation mark that opens here is not closed in its line"
                                              : "expected a comma behind the quotation mark");
}

void csv_end_lines(char *text)
{
    for (char *c = strchr(text, '\r'); c; c = strchr(c + 1, '\r'))
        if (c[1] != '\n' && !(c[1] == '\r' && c[2] == '\n'))
            *c = '\n';
}
