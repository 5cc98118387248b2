/* What a study leaves beside its two tables: extremes.csv, annual.csv, sensitivity.csv, study.nc, study.html.  No
   wall-clock times. */
#ifndef STUDY_STUDY_ANSWERS_H
#define STUDY_STUDY_ANSWERS_H

#include "study/study_folder.h"

/* study.nc, NetCDF-4 with the dimensions condition and seed; nothing in a build without NetCDF. */
fram_status study_netcdf_write(const study_folder *f, const condition_rows *conditions, fram_error *error);
/* study.html, the page of the study. */
fram_status study_page_write(const study_folder *f, const condition_rows *conditions, fram_error *error);

/* The other tables, as far as the study asks for them. */
fram_status study_answers_write(const study_folder *f, const condition_rows *conditions, fram_error *error);

#endif
