/* Reading columns of a CSV file that io/csv.h wrote (or any file with one header row). */
#ifndef IO_CSV_READ_H
#define IO_CSV_READ_H

#include "base/array.h"

typedef ARRAY(double) double_array;

/* Refused: larger files, longer lines.  A series of 160 channels over 4 million steps is 8 GB. */
#define CSV_BYTES_MOST ((uint64_t)16 << 30)
enum { CSV_LINE_MOST = 1 << 20 };

/* The columns of the given names appended to columns[0..count).  A name may have a unit ("tension[N]"): the file may
   leave it out, but not name another one.  Other columns are passed over, whatever is in them.  FRAM_ERROR_INPUT for a
   missing column, two of one name, another unit, a value that is no decimal number (nan and inf are for who asks), and
   a row of more cells than the header, with its line. */
fram_status csv_read(context *ctx, const char *path, const char *const *names, int32_t count, double_array *columns,
                     fram_error *error);

/* The line on which row `row` of csv_read, from 0, stands: empty lines are no rows.  0: there is none. */
int csv_line_of(context *ctx, const char *path, int32_t row);

/* That a file's header has a name that is asked for twice: in columns first and second, from 0. */
fram_status csv_refuse_twice(const char *path, const char *name, int32_t first, int32_t second, fram_error *error);

/* Bytes of the text of a unit, and of a column's name: a vessel's, and what is told of it. */
enum { UNIT_SIZE = 16, COLUMN_NAME_SIZE = 80 };

/* A whole file: every column with its name and unit. */
typedef struct csv_table_column {
    char name[COLUMN_NAME_SIZE], unit[UNIT_SIZE];
    double_array value;
    bool left_out; /* nobody wished for it: it has no values, though the file's were looked at */
} csv_table_column;
typedef struct csv_table {
    ARRAY(csv_table_column) columns;
    int32_t rows;
} csv_table;

/* Columns whose values are wished for: the names as they are, and behind that of a vessel (yaw: tug.yaw too). */
typedef struct csv_wish {
    const char *const *names;
    int32_t count;
} csv_wish;

/* wish NULL: all columns.  A row without its end, cut short while a run writes the file, ends the reading.
   FRAM_ERROR_INPUT as csv_read, and for a number that is not finite, which no run writes into its tables, and a name
   that is too long; FRAM_INTERRUPTED where the context is asked to stop, which csv_read does not hear: a run that was
   stopped reads its own series for its results.  On failure the table is empty. */
fram_status csv_table_read(context *ctx, const char *path, const csv_wish *wish, csv_table *out, fram_error *error);
void csv_table_free(context *ctx, csv_table *t);
/* NULL when there is none of this name, or it was left out. */
const csv_table_column *csv_table_find(const csv_table *t, const char *name);

#endif
