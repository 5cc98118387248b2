/* Cells of a CSV file that other programs wrote, some of them texts.  Knows lines and marks; not what a cell means. */
#ifndef IO_CSV_CELL_H
#define IO_CSV_CELL_H

#include "io/text_buffer.h"

typedef enum csv_cell_flaw {
    CSV_CELL_SOUND,
    CSV_CELL_OPEN,   /* a quotation mark that its line does not close */
    CSV_CELL_GOES_ON /* text behind the quotation mark that closes it */
} csv_cell_flaw;

/* {0} before the first one; its room goes on to the next, and is freed with text_free(ctx, &cell.text). */
typedef struct csv_cell {
    text_buffer text; /* without quotation marks; of a plain cell without blanks around it */
    csv_cell_flaw flaw;
} csv_cell;

/* The cell that begins at c, blanks before it too; returns where it ends, at its comma or the end of its line, which a
   carriage return is as well.  end: of the text; NULL: a NUL ends it. */
const char *csv_cell_read(context *ctx, const char *c, const char *end, csv_cell *out);
/* The same of a text that a NUL ends; returns where the cell after it begins, NULL at the end of the line. */
const char *csv_cell_next(context *ctx, const char *c, csv_cell *out);

/* FRAM_ERROR_INPUT for a flaw of quotation marks, behind which nobody knows which column is which, or no memory for the
   cell; columns from 0, key may be NULL. */
fram_status csv_cell_check(const char *path, int line, const char *key, int column, const csv_cell *c,
                           fram_error *error);

/* Line feeds for carriage returns that end lines on their own: of a spreadsheet for old Macs, or in a mixture. */
void csv_end_lines(char *text);

#endif
