/* A column of anybody's CSV file, in which some cells are texts. One module with series_file, one of whose sources it
   is. Knows the file; must not know runs, nor what the steps between its rows have to be. */
#ifndef STUDY_SERIES_CSV_H
#define STUDY_SERIES_CSV_H

#include "study/series_file.h"

/* What is read of a file. */
typedef struct series_rows {
    double_array time;
    int32_array line; /* of each row; none of a run's, whose rows follow each other */
} series_rows;

/* The line of the file that a row stands in. */
int series_line(const series_rows *rows, int32_t row);
/* Appends the column `source->channel`, with the times where no step is given.  FRAM_ERROR_INPUT with file, line and
   channel, FRAM_ERROR_USAGE without a channel; what was appended before stays. */
fram_status series_read_csv(context *ctx, const char *path, const series_source *source, series_rows *rows,
                            double_array *value, char unit[UNIT_SIZE], fram_error *error);
/* FRAM_ERROR_INPUT: times are told, and a step was given. */
fram_status series_refuse_step(const char *path, fram_error *error);

#endif
