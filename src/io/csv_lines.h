/* Inner header of the readers of CSV files: lines and numbers.  One module with csv_read, which reads some columns, and
   csv_table, which reads tables. */
#ifndef IO_CSV_LINES_H
#define IO_CSV_LINES_H

#include "io/csv_read.h"

/* What becomes of the lines of a file. */
typedef struct csv_line_reader {
    fram_status (*read)(void *user, const char *path, int line, const char *text, fram_error *error);
    void *user;
    bool open_end; /* the last line counts without its end; otherwise it is taken for one that was cut short */
    bool stops;    /* who asks to stop is heard */
} csv_line_reader;
fram_status csv_read_lines(context *ctx, const char *path, const csv_line_reader *reader, fram_error *error);

/* A number in a cell, and its end; false where it has none: 0x10 is one to the C library alone. */
bool csv_number(const char *c, double *value, char **end);
/* Columns from 0. */
fram_status csv_refuse_number(const char *path, int line, const char *name, int32_t column, const char *cell,
                              fram_error *error);

#endif
