/* Reading columns of a CSV file that io/csv.h wrote (or any file of numbers with one header row). */
#ifndef IO_CSV_READ_H
#define IO_CSV_READ_H

#include "base/array.h"

typedef ARRAY(double) double_array;

/* The columns of the given names ("name", the unit in brackets left out) appended to columns[0..count); a row that is
   cut short at the end of the file ends the reading.  FRAM_ERROR_INPUT for a missing column or a value that is no
   number, with its line. */
fram_status csv_read(context *ctx, const char *path, const char *const *names, int32_t count, double_array *columns,
                     fram_error *error);

#endif
