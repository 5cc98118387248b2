/* Runs whose series are taken together, as realizations of one condition: whether they are.  One module with
   series_file.  Knows scenarios and notes of runs; must not know series. */
#ifndef STUDY_SERIES_RUNS_H
#define STUDY_SERIES_RUNS_H

#include "results/run_data.h"

typedef struct series_run {
    const char *folder;
    char scenario_hash[SHA256_TEXT_SIZE], state_hash[17];
} series_run;

/* {0} before the first one; free with series_runs_free. */
typedef struct series_runs {
    ARRAY(series_run) run;
    text_buffer keys; /* of the first one's condition, "key: value" a line */
    bool told;        /* that one is of another condition */
    int32_t changed;  /* whose scenario is not the one that they were made of */
    const char *first_changed;
} series_runs;

/* Adds a run, whose folder's name must stay.  FRAM_ERROR_INPUT where it is a copy of one before: the same scenario and
   seed that came to the same state.  Warns of the first that is of another condition. */
fram_status series_runs_add(context *ctx, series_runs *r, const run_data *d, const char *folder, fram_error *error);
void series_runs_free(context *ctx, series_runs *r);

/* FRAM_ERROR_INPUT: a realization that counts twice makes every interval too narrow. */
fram_status series_refuse_twice(const char *file, const char *same, fram_error *error);

#endif
