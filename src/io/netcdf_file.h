/* NetCDF-4 files (which are HDF5 files): dimensions, variables with units, arrays.  Whole files or none.  Without
   NetCDF in the build, or its library where it runs, netcdf_begin returns FRAM_ERROR_UNSUPPORTED.  Knows nothing of
   what the arrays mean. */
#ifndef IO_NETCDF_FILE_H
#define IO_NETCDF_FILE_H

#include "base/context.h"

typedef struct netcdf_calls netcdf_calls; /* the functions of the library */

/* The first failure is kept and later calls do nothing, so that it is enough to look at netcdf_end. */
typedef struct netcdf_file {
    context *ctx;
    netcdf_calls *nc;
    char *path, *temporary; /* temporary NULL: made in memory */
    int id;
    int failed; /* NetCDF's code of the first failure, 0 */
    bool open;
} netcdf_file;

typedef enum netcdf_type { NETCDF_F64, NETCDF_F32, NETCDF_I32, NETCDF_TEXT } netcdf_type;

fram_status netcdf_begin(context *ctx, const char *path, netcdf_file *f, fram_error *error);
/* The same for a file that memory holds whole, of which nothing is written before netcdf_end.  HDF5 keeps what it
   cannot write to a full disk, and may die of it when the program ends. */
fram_status netcdf_begin_in_memory(context *ctx, const char *path, netcdf_file *f, fram_error *error);
/* Number of a new dimension. */
int netcdf_dimension(netcdf_file *f, const char *name, size_t length);
/* Number of a new variable over `count` dimensions (at most 2); compressed, but for text; rows of 2-D ones are
   written one by one. */
int netcdf_variable(netcdf_file *f, const char *name, netcdf_type type, const int *dimensions, int count,
                    const char *units, const char *meaning);
/* An attribute of the file. */
void netcdf_attribute(netcdf_file *f, const char *name, const char *text);
void netcdf_put_f64(netcdf_file *f, int variable, const double *values);
void netcdf_put_i32(netcdf_file *f, int variable, const int32_t *values);
void netcdf_put_text(netcdf_file *f, int variable, const char **values);
/* Row `row` of a variable over two dimensions, or number `row` of one over one: `count` values, rounded to its type. */
void netcdf_put_row(netcdf_file *f, int variable, size_t row, const double *values, size_t count);
/* Close, sync and give the file its name; or remove it and say what failed. */
fram_status netcdf_end(netcdf_file *f, fram_error *error);
void netcdf_abandon(netcdf_file *f);

#endif
