/* Cells of a CSV file that other programs wrote, some of them texts. */
#ifndef STUDY_CSV_CELL_H
#define STUDY_CSV_CELL_H

#include "base/context.h"

#include <stddef.h>

enum { CSV_CELL_ROOM = 128 };

typedef enum csv_cell_flaw {
    CSV_CELL_SOUND,
    CSV_CELL_CUT,    /* longer than there is room */
    CSV_CELL_OPEN,   /* a quotation mark that its line does not close */
    CSV_CELL_GOES_ON /* text behind the quotation mark that closes it */
} csv_cell_flaw;

typedef struct csv_cell {
    char text[CSV_CELL_ROOM]; /* without quotation marks */
    size_t length;
    csv_cell_flaw flaw;
} csv_cell;

/* The next cell of a line; returns where the cell after it begins, NULL at the end of the line. */
const char *csv_cell_next(const char *c, csv_cell *out);

/* FRAM_ERROR_INPUT for a flaw of quotation marks, behind which nobody knows which column is which; columns from 0. */
fram_status csv_cell_check(const char *path, int line, int column, const csv_cell *c, fram_error *error);

/* Line feeds for carriage returns that end lines on their own: of a spreadsheet for old Macs, or in a mixture. */
void csv_end_lines(char *text);

#endif
