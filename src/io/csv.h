/* Comma-separated columns: one header row `name[unit]`, then rows of numbers to CSV_DIGITS significant digits.  Lines
   end in a newline.  Knows nothing of what the columns mean. */
#ifndef IO_CSV_H
#define IO_CSV_H

#include "io/file.h"
#include "io/text_buffer.h"

/* Far beyond what a load is known to; digits that read back as the same double cost a tenth of a small run. */
enum { CSV_DIGITS = 12 };

typedef struct csv_column {
    const char *name;
    const char *unit; /* "" or NULL: header without brackets */
} csv_column;

typedef struct csv_writer {
    file_writer file;
    int32_t column_count;
} csv_writer;

/* A table as text, for a file that is there whole or not at all (io/atomic_file.h): its header row, "time[s],x[m]", and
   the rows.  What fails shows in the buffer. */
void csv_text_header(context *ctx, const csv_column *columns, int32_t count, text_buffer *out);
void csv_text_row(context *ctx, const double *row, int32_t count, text_buffer *out);

/* For tables that grow while others look on: a new file with its header row. */
fram_status csv_create(context *ctx, const char *path, const csv_column *columns, int32_t count, csv_writer *w,
                       fram_error *error);
/* Open a file to be continued at `length` (a csv_length of before), once the caller has cut it there by file_cut.
   FRAM_ERROR_INPUT when it is shorter, its header row is another or the cut is not after the end of a row. */
fram_status csv_continue(context *ctx, const char *path, uint64_t length, const csv_column *columns, int32_t count,
                         csv_writer *w, fram_error *error);
/* One value per column. */
fram_status csv_append(csv_writer *w, const double *row, fram_error *error);
fram_status csv_flush(csv_writer *w, bool sync, fram_error *error);
/* Bytes so far, the unwritten ones included. */
uint64_t csv_length(const csv_writer *w);
fram_status csv_close(csv_writer *w, fram_error *error);

#endif
