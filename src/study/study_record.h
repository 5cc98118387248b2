/* What a study was, beside its results, and how it stands: DIR/effective.yaml is the study with every key, its
   conditions one by one (of a design of sensitivity the design itself) and the versions and hashes it was made from,
   itself a study file; DIR/index.csv the names and hashes of the conditions.  Both are written when a study begins, and
   nothing of a run is in them.  One module with study_folder, which opens the folder. */
#ifndef STUDY_STUDY_RECORD_H
#define STUDY_STUDY_RECORD_H

#include "study/study_folder.h"

/* Lines of index.csv, into f->index.  inputs: "sha256  path" of each file that the scenario names, a line each. */
void study_index_heads(study_folder *f);
void study_index_row(study_folder *f, int32_t condition, const char *scenario_hash, const char *inputs);
/* Whether all conditions of the index.csv that is in the folder are among those of this study; false without one. */
bool study_index_is_within(const study_folder *f);
/* The scenario with its whole path as a record has it, in UTF-8, for memory_free; NULL: no memory. */
char *study_scenario_whole(context *ctx, const study *s);
/* Both files, of a folder whose conditions all have their names. */
fram_status study_record_write(const study_folder *f, fram_error *error);
/* Whether a folder has one of them, as Fram writes it, beside a study.yaml: it is a study's then. */
bool study_record_is_there(const char *folder);

/* How a condition stands, by the rows of runs that are there. */
typedef struct condition_standing {
    int32_t condition; /* from 1 */
    const char *keys;  /* "ice.thickness=0.6 vessel.speed=1" */
    const char *id;    /* of DIR/conditions/ID.yaml and DIR/runs/ID */
    int32_t runs, failed, wanted;
    double load_mean, load_mean_half, load_largest; /* of runs that ended well [N]; NaN: none */
} condition_standing;
typedef void (*standing_function)(void *user, const condition_standing *c);

/* Calls `tell` for each condition of the study in the folder, in their order.  Reads two files and the rows of runs,
   and neither scenarios nor the files they name: nothing is locked, written or begun. */
fram_status study_list(context *ctx, const char *folder, standing_function tell, void *user, fram_error *error);

#endif
