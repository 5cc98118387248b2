/* Series for statistics, from the folders of runs and from CSV files of anybody's: values of one channel at equal
   distances in time.  Knows files; must not know what is made of the values. */
#ifndef STUDY_SERIES_FILE_H
#define STUDY_SERIES_FILE_H

#include "study/series_set.h"

enum { SERIES_FILES_MOST = 4096 };
#define SERIES_BYTES_MOST ((uint64_t)4 << 30)

typedef struct series_source {
    const char *const *files; /* folders of runs, or CSV files with a row of heads, "name" or "name[unit]" */
    int32_t count;
    const char *channel; /* NULL: of runs "load", the magnitude of the horizontal averaged ice force */
    double from;         /* leave out what is before [s]; NaN: the transient of a run, nothing of a CSV file */
    double step;         /* between rows [s]; 0: from the column `time` */
    bool minima;         /* of the negative values: what is asked is the least value */
    bool maxima;         /* the values are maxima, not a series: no time is read, and empty cells are left out */
} series_source;

typedef struct series_data {
    series_set set;
    series_part *parts; /* a file each; owned, as the values */
    double_array *values;
    int32_t count;
    /* Runs of a channel of line tension or offset in which lines parted, but for those that are let go. */
    int32_t parted;
    int32_t fewer; /* those, and such in which lines were let go */
    bool offset;   /* of such a run's channel */
    double held;   /* the least of the largest tensions of those; infinite: none, or minima are asked [N] */
    char unit[UNIT_SIZE];
} series_data;

/* FRAM_ERROR_INPUT with file, line and channel: no such column (with the nearest one), a cell that is no number, times
   that are not evenly spaced or differ between files, a file or run that is given twice, maxima of several conditions.
   Warns of runs of several conditions.  On success free with series_free. */
fram_status series_read(context *ctx, const series_source *source, series_data *out, fram_error *error);
void series_free(context *ctx, series_data *s);

#endif
