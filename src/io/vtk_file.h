/* VTK's XML formats for ParaView: one set of points and cells as .vtp (appended, zlib-compressed arrays), and a .pvd
   that strings files together in time.  Whole files or none.  Knows the format; must not know what the arrays mean. */
#ifndef IO_VTK_FILE_H
#define IO_VTK_FILE_H

#include "base/array.h"
#include "base/vec.h"

typedef ARRAY(float) float_array;

/* One number or vector per cell. */
typedef struct vtk_field {
    const char *name; /* "velocity [m/s]" is fine */
    int components;   /* 1 or 3 */
    const float *value;
} vtk_field;

typedef enum vtk_cells { VTK_VERTICES, VTK_POLYGONS } vtk_cells;

typedef struct vtk_data {
    const vec3 *point; /* written as doubles: floats have no millimetres in coordinates of a map */
    int32_t point_count;
    vtk_cells kind;
    /* Points of cell i: connectivity[i ? offset[i - 1] : 0 .. offset[i]). */
    const int32_t *connectivity, *offset;
    int32_t cell_count;
    const vtk_field *fields;
    int32_t field_count;
    double time; /* [s] */
} vtk_data;

/* Without waiting for the disk: a series has thousands of these, and is written again at any time. */
fram_status vtk_write(context *ctx, const char *path, const vtk_data *data, fram_error *error);

/* A file of a series; name: relative to the .pvd. */
typedef struct vtk_step {
    double time;
    int32_t part; /* files of one time are the parts of one data set */
    char name[48];
} vtk_step;
typedef ARRAY(vtk_step) vtk_step_array;

fram_status vtk_series_write(context *ctx, const char *path, const vtk_step *steps, int32_t count, fram_error *error);

#endif
