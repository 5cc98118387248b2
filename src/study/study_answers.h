/* What a study leaves beside its two tables: differences.csv, station.csv, extremes.csv, annual.csv, sensitivity.csv,
   study.nc, study.html.  No wall-clock times. */
#ifndef STUDY_STUDY_ANSWERS_H
#define STUDY_STUDY_ANSWERS_H

#include "study/extremes.h"
#include "study/study_folder.h"

/* study.nc, NetCDF-4 with the dimensions condition and seed; nothing in a build without NetCDF. */
fram_status study_netcdf_write(const study_folder *f, const condition_rows *conditions, fram_error *error);
/* study.html, the page of the study. */
fram_status study_page_write(const study_folder *f, const condition_rows *conditions, fram_error *error);

/* What the largest values of the runs of conditions say of rare loads. */
enum { STUDY_RARE = 3 };
extern const run_figure study_rare[STUDY_RARE]; /* figures that have extremes */
/* Of one condition; `block` from study_blocks. */
fram_status study_extreme(const study_folder *f, const condition_rows *conditions, int32_t condition, run_figure figure,
                          double block, extreme_result *out, fram_error *error);

/* Whether no run of a condition met ice. */
bool study_met_no_ice(const condition_rows *of);
/* Values of a figure of the runs of a condition, without those that have none. */
fram_status study_values(const study_folder *f, const condition_rows *conditions, int32_t condition, run_figure figure,
                         double_array *out, fram_error *error);
/* A level that is exceeded with a probability in a year: NaN where `why` says why there is none; else `why` says what
   speaks against it, if anything does. */
typedef struct annual_answer {
    level_interval level;
    char why[EXTREME_NOTE];
} annual_answer;
/* Of a figure, for each of the probabilities that are asked. */
fram_status study_annual(const study_folder *f, const condition_rows *conditions, run_figure figure,
                         const double *block, annual_answer out[STUDY_LEVELS_MOST], fram_error *error);

/* differences.csv, where conditions can be compared (study/differences.h). */
fram_status study_differences_write(const study_folder *f, const condition_rows *conditions, fram_error *error);
/* Runs of a condition in which lines parted, but for those that are let go, and the least of the largest tensions of
   such runs: up to that one the tensions are known [N]. */
typedef struct parted_lines {
    int32_t runs;
    double least; /* HUGE_VAL without such a run */
} parted_lines;
parted_lines study_parted_lines(const condition_rows *of);
/* station.csv, where a vessel is on a station and something is required of that. */
fram_status study_station_write(const study_folder *f, const condition_rows *conditions, fram_error *error);
/* sensitivity.csv, of a study whose conditions are a design for it (study/sensitivity.h). */
fram_status study_sensitivity_write(const study_folder *f, const condition_rows *conditions, fram_error *error);
/* The other tables, as far as the study asks for them. */
fram_status study_answers_write(const study_folder *f, const condition_rows *conditions, fram_error *error);

#endif
