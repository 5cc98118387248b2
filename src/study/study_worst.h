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
/* Folders in that of the study in which a run may have its record: made again, and where it was made first, which has
   one with `keep: all`. */
typedef enum worst_place { WORST_AGAIN = 0, WORST_FIRST, WORST_PLACES } worst_place;
enum { WORST_FOLDER = CONDITION_ID + 32 };
void study_worst_folder(const study_folder *f, const worst_run *run, worst_place place, char out[WORST_FOLDER]);
/* Whether a file, "record.fram" or "playback.html", is there, whoever made it. */
bool study_worst_has(const study_folder *f, const worst_run *run, worst_place place, const char *file);

/* Between frames of a record of the scenario [s]: its own interval, or 1 s. */
double study_worst_frames(const scenario *s);
/* The same of a run of a condition; *own: it is the scenario's, so that the run's first record has frames. */
fram_status study_worst_frames_of(const study_folder *f, const worst_run *run, double *out, bool *own,
                                  fram_error *error);

/* Makes what the study asks for (keep: record_of_worst) and is not there.  *changed: the page of the study has become
   untrue. */
fram_status study_worst_record(const study_folder *f, const condition_rows *conditions, const study_options *options,
                               bool *changed, fram_error *error);

#endif
