/* What is asked of Slurm, and the script of an array of a study.  Knows the words of sbatch; must not know who submits
 * it. */
#ifndef STUDY_SLURM_SCRIPT_H
#define STUDY_SLURM_SCRIPT_H

#include "io/text_buffer.h"

typedef struct slurm_options {
    const char *partition;      /* NULL: the cluster's default */
    const char *time;           /* limit of a task as sbatch takes it, NULL: the partition's */
    const char *const *options; /* further ones of sbatch, as "--account=ice" */
    int option_count;
    int runs_per_task; /* 0: such that there are 200 tasks at most */
    double poll;       /* between questions to the scheduler [s]; 0: 30 */
    bool dry_run;      /* the script is printed on standard output, and nothing submitted */
    int jobs;          /* tasks of an array at a time; 0: as many as Slurm has room for */
} slurm_options;

typedef struct slurm_script_facts {
    const slurm_options *options;
    const char *folder, *program; /* absolute */
    const char *exclude;          /* nodes that it is not for, an option of sbatch; NULL: none but those of `options` */
    int32_t number, runs, each;   /* of the array; its runs; runs of a task */
} slurm_script_facts;

void slurm_script(context *ctx, const slurm_script_facts *f, text_buffer *out);

/* The tasks of the array as sbatch takes them: "0-LAST", or "0-LAST%JOBS". */
enum { SLURM_ARRAY_SIZE = 32 };
void slurm_script_array(const slurm_script_facts *f, char out[SLURM_ARRAY_SIZE]);

/* The option by which sbatch leaves out these nodes, divided by commas, and those that `options` name, in place of what
   they say of it. */
void slurm_script_exclusion(context *ctx, const slurm_options *options, const char *nodes, text_buffer *out);

/* The command that submits the script `path`, to be freed; NULL without memory.  array: its tasks. */
const char **slurm_submission(context *ctx, const slurm_script_facts *f, const char *array, const char *path);

#endif
