/* The folder of a run: scenario.yaml (the effective scenario), run.json (what ran, and how it ended), series.csv,
   record.fram, checkpoints and pictures. */
#ifndef SIM_RUN_FOLDER_H
#define SIM_RUN_FOLDER_H

#include "base/context.h"

#include <stdbool.h>

/* The folder and those above it, where they are not there. */
fram_status run_folder_make(const char *folder, fram_error *error);
/* FRAM_ERROR_USAGE for a folder that is not empty, without `force`; nothing is touched. */
fram_status run_folder_check(const char *folder, bool force, fram_error *error);
/* What the error of run_folder_lock begins with while another run writes there. */
#define RUN_FOLDER_TAKEN "another run is writing into this folder"
/* That no other run writes into the folder: FRAM_ERROR_USAGE while one does.  *lock is for run_folder_unlock; the lock
   ends with the process too, and a file system without locks gives none.  What a run that was killed left half-written
   goes. */
fram_status run_folder_lock(const char *folder, int *lock, fram_error *error);
/* lock -1: nothing. */
void run_folder_unlock(int lock);
/* FRAM_ERROR_USAGE for a folder in which a run would write over one of its inputs (run_inputs_list). */
fram_status run_folder_refuse_inputs(const char *folder, const char *inputs, fram_error *error);
/* FRAM_ERROR_INPUT for a folder in which a pipe has the name of a file that a run writes, whose reader a run that goes
   on would wait for. */
fram_status run_folder_refuse_pipes(const char *folder, fram_error *error);
/* Make the folder and those above it and lock it, after the same check.  Where it holds an earlier run, checkpoints and
   all that was made from that are removed, so that they are never mixed with the new one's; not what is one of the new
   run's inputs (run_inputs_list; NULL: none). */
fram_status run_folder_prepare(context *ctx, const char *folder, bool force, const char *inputs, int *lock,
                               fram_error *error);

/* Whether the run was made of this scenario (its hash) and these inputs (run_inputs_list), by its run.json;
   FRAM_ERROR_INPUT names what was changed. */
fram_status run_folder_unchanged(context *ctx, const char *folder, const char *scenario_hash, const char *inputs,
                                 fram_error *error);

/* When its recording began, by its run.json [s]; -1: that does not tell. */
fram_status run_folder_recorded_from(context *ctx, const char *folder, double *time, fram_error *error);

#endif
