/* The record in a run's folder, which is gone where a study kept the series of the run.  Must not know what is read
   from it. */
#ifndef RESULTS_RUN_RECORD_H
#define RESULTS_RUN_RECORD_H

#include "io/path.h"
#include "io/record.h"

/* What is told of such a run. */
#define RUN_WITHOUT_RECORD "the run has no record, as a study keeps with `series`"

/* Whether the folder has the series of a run and no record. */
bool run_lacks_record(const char *folder);
/* Opens it, and tells its path; where the run has none, how to make it again. */
fram_status run_record_open(context *ctx, const char *folder, char path[PATH_ROOM], record_reader *r,
                            fram_error *error);

#endif
