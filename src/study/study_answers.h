/* Tables of what a study was asked beyond means: extremes.csv, annual.csv, sensitivity.csv.  No wall-clock times. */
#ifndef STUDY_STUDY_ANSWERS_H
#define STUDY_STUDY_ANSWERS_H

#include "study/study_folder.h"

fram_status study_answers_write(const study_folder *f, const condition_rows *conditions, fram_error *error);

#endif
