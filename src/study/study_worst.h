/* The worst runs of a study, and what is kept of them beside the others: when all runs have ended, the worst are made
   again with a record, and their playback with it.  Runs are deterministic: the row of the second time must be that of
   the first to the byte.

     DIR/worst/ID-SEED/       the run with its record and playback.html
     DIR/worst/ID-SEED.row    its figures: it is whole, and they are those of runs/ID/SEED.row
     DIR/worst/ID-SEED.log    while it is made

   What is no longer among the worst, as a study is widened, goes; what somebody else put there, which has none of these
   files, stays.  One module with study_run. */
#ifndef STUDY_STUDY_WORST_H
#define STUDY_STUDY_WORST_H

#include "model/scenario.h"
#include "study/study_folder.h"
#include "study/study_run.h"

typedef struct worst_run {
    int32_t condition, index; /* of the seed, from the first */
    double value;
} worst_run;

/* Runs that ended well with the largest values of a figure, in falling order; of equal ones the first.  A run of
   several conditions counts for the first of them.  Returns their number, at most `most`, the room in out. */
int32_t study_worst_find(const study_folder *f, const condition_rows *conditions, run_figure figure, int32_t most,
                         worst_run *out);
/* Whether a run's record, its playback are there, whoever made them. */
bool study_worst_has_record(const study_folder *f, const worst_run *run);
bool study_worst_has_playback(const study_folder *f, const worst_run *run);

/* Between frames of a record of the scenario [s]: its own interval, or 1 s. */
double study_worst_frames(const scenario *s);

/* Makes what the study asks for (keep: record_of_worst) and is not there.  *changed: the page of the study has become
   untrue. */
fram_status study_worst_record(const study_folder *f, const condition_rows *conditions, const study_options *options,
                               bool *changed, fram_error *error);

#endif
