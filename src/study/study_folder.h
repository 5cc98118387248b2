/* Names and files in the folder of a study (study/study_run.h has its layout). */
#ifndef STUDY_STUDY_FOLDER_H
#define STUDY_STUDY_FOLDER_H

#include "base/hash.h"
#include "model/scenario.h"
#include "study/run_row.h"
#include "study/study.h"

enum { CONDITION_ID = 13 };
typedef struct study_folder {
    context *ctx;
    const study *s;
    const char *path;
    char (*id)[CONDITION_ID]; /* of each condition */
    char **files;             /* of each condition that names some: its list (sim/run_inputs.h) */
    int lock;                 /* -1 */
    text_buffer index;        /* of index.csv, while the folder is opened */
    text_buffer inputs;       /* files of the conditions that were looked at so far (sim/run_inputs.h), as long */
    double run_bytes;         /* of memory that a run takes, about: the largest of all conditions */
} study_folder;

/* What a condition is called by, so that others of this name have the same runs. */
typedef struct condition_name {
    char id[CONDITION_ID], scenario_hash[SHA256_TEXT_SIZE];
    text_buffer files; /* that its scenario names (sim/run_inputs.h) */
} condition_name;
/* By all that decides the result of a run but for its seed, the contents of the files too; `known` as for
   run_inputs_list.  Free name->files, after an error too. */
fram_status condition_name_find(context *ctx, const scenario *one, text_buffer *known, condition_name *name,
                                fram_error *error);

/* Makes the folder with what does not depend on runs, and locks it: FRAM_ERROR_USAGE while another program runs a study
   in it, when it holds something else, or a file that the study reads in the place of one that it writes.  dry: what a
   study there tells of itself stays. */
fram_status study_folder_open(context *ctx, const study *s, const char *path, bool dry, study_folder *f,
                              fram_error *error);
void study_folder_close(study_folder *f);
/* FRAM_INTERRUPTED, of a study that was asked to stop: its folder goes on from what ended. */
fram_status study_interrupted(fram_error *error);

/* Before that, in study_folder_check.c: whether the folder is empty or a study's, and no file stands in the place of
   one that is to be written which the study names; FRAM_ERROR_USAGE otherwise, and nothing is touched. */
fram_status study_folder_check(context *ctx, const study *s, const char *path, fram_error *error);
/* The same of the files that the scenarios of its conditions name, when all of them were looked at. */
fram_status study_folder_check_inputs(const study_folder *f, fram_error *error);

/* Processes at a time: `jobs` where that is not 0, else the cores of this machine, or as many as its memory holds. */
int study_folder_jobs(const study_folder *f, int jobs);

/* One of the study's own folders is made, or is there and swept of what programs that were killed left.
   FRAM_ERROR_INPUT where it is a link, or holds one to a folder, which may lead anywhere (io/folder.h). */
fram_status study_folder_make(context *ctx, const char *path, fram_error *error);
/* "DIR/runs/ID/SEED" and an ending, to be freed; NULL without memory. */
char *study_run_path(const study_folder *f, int32_t condition, int64_t seed, const char *ending);
/* "DIR/conditions/ID.yaml", to be freed. */
char *study_scenario_path(const study_folder *f, int32_t condition);
/* How long the runs of each condition are after their transient [s], by its scenario in the folder; to be freed with
   memory_free. */
fram_status study_blocks(const study_folder *f, double **out, fram_error *error);
/* Of a run that ended well and has its row: what is not kept of its folder goes, and at last its log.  Where there is
   no log all this was done before. */
void study_run_finish(const study_folder *f, int32_t condition, int64_t seed, study_keep keep);
/* Of a run that a task of Slurm is to make again, "DIR/runs/ID/SEED" or "DIR/worst/ID-SEED": its row and code go, since
   a task passes over what has one; `anew`: so does its folder, from whose checkpoints a task would go on.  *busy: a
   program still writes into that, and all stays until it has ended. */
fram_status study_run_forget(context *ctx, const char *folder, bool anew, bool *busy, fram_error *error);
/* Whether there is of a run that ended well what `keep` keeps. */
bool study_run_has_kept(const study_folder *f, int32_t condition, int64_t seed, study_keep keep);
/* FRAM_ERROR_INPUT, naming the file, when a run was made of other files than the condition is named after: somebody
   changed one while the study ran.  What failed before it had a run.json is not told of. */
fram_status study_run_check_files(const study_folder *f, int32_t condition, const char *folder, fram_error *error);
/* Whether a program still writes into the folder of a run: one whose study was killed goes on to its end.  The error is
   that of a folder which is there and cannot be opened: no program's end changes that. */
fram_status study_folder_busy(const char *folder, bool *busy, fram_error *error);
/* Whether a run that failed met such a program, which had been started and had not yet locked the folder: no answer of
   its scenario. */
fram_status study_run_met_another(context *ctx, const char *folder, const char *log, bool *met, fram_error *error);

/* The results of a condition, by seed from the first. */
typedef struct condition_rows {
    ARRAY(run_row) rows; /* of the first seeds without a gap */
} condition_rows;
/* DIR/summary.csv and DIR/conditions.csv of the seeds that each condition takes, and all that follows from them;
   without `replace` where there are none yet. */
fram_status study_tables_write(const study_folder *f, const condition_rows *conditions, bool replace,
                               fram_error *error);
/* DIR/NAME with a text that has been put together, as a whole or not at all. */
fram_status study_table_write(const study_folder *f, const char *name, const text_buffer *b, fram_error *error);
/* A table of the study before it was changed, which this one does not ask for. */
void study_table_remove(const study_folder *f, const char *name);

#endif
