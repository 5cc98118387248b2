/* A world that is recorded: the folder of its run with time series, record, checkpoints, pictures and run.json, whoever
   steps it: the loop of sim/run.h, or a program through the public interface.  What stands in the folder after the same
   steps is the same, but for wall times.  A recording has a recorder (sim/recorder.h) for the streams, of which one is
   the record (io/record.h). */
#ifndef SIM_RECORDING_H
#define SIM_RECORDING_H

#include "base/hash.h"
#include "base/time_ranks.h"
#include "io/late_commit.h"
#include "io/path.h"
#include "io/text_buffer.h"
#include "model/scenario.h"
#include "model/world.h"
#include "sim/checkpoint.h"
#include "sim/recorder.h"
#include "vessel/outcome.h"

/* Makes what people read from the finished time series in the folder. */
typedef fram_status (*recording_finish)(context *ctx, const scenario *s, const station_outcome *station,
                                        const char *folder, fram_error *error);

typedef struct recording_options {
    bool force;              /* write into a folder that is not empty */
    bool with_paths;         /* the record tells where input files lie; otherwise their names alone */
    recording_finish finish; /* may be NULL */
} recording_options;

/* Stays where it is in memory between recording_prepare and recording_free. */
typedef struct recording {
    context *ctx;
    const scenario *s;
    world *w; /* from recording_begin or recording_read_state on */
    char folder[PATH_ROOM];
    recording_options options;
    recorder recorder;
    late_commit checkpoint; /* under way */
    text_buffer inputs;
    byte_array peaks; /* of the checkpoint that was read or written last */
    char hash[SHA256_TEXT_SIZE];
    double started;       /* wall clock [s] */
    double began_at;      /* simulated time at which this call began [s] */
    double recorded_from; /* at which the recording began, before any resume [s]; -1: not known */
    double good_until;    /* simulated time of the last step that was made whole [s] */
    double record_time;   /* for all that was written so far [s] */
    double end_time;      /* of it at the end [s] */
    time_ranks steps;     /* wall times of the steps of this call, recording apart */
    int64_t end_step;     /* of the scenario */
    int64_t stop_step;    /* at which its maker ends it: a checkpoint that is due then is that of the end; -1: none */
    int64_t checkpoint_every, picture_every;
    bool open;
    int lock; /* on the folder, -1 */
} recording;

/* How far the world came, and what this call took. */
typedef struct run_result {
    uint64_t state_hash;
    int64_t steps;
    double time, wall, real_time_factor;
    int32_t bodies, floes;
    bool finished;
} run_result;

/* The names, and the schedule that follows from the scenario; nothing is opened or allocated.  FRAM_ERROR_INPUT for a
   folder whose name is too long. */
fram_status recording_init(context *ctx, const scenario *s, const char *folder, const recording_options *options,
                           recording *r, fram_error *error);

/* ---- one that starts: recording_prepare, then recording_begin ---- */

/* What can be told before the world is made: that the folder may be written (a USAGE error when it is not empty,
   without `force`), and what the inputs are.  Nothing is touched. */
fram_status recording_prepare(recording *r, fram_error *error);
/* Folder and streams of a world that stands where its recording begins, and the first frame where one is due. */
fram_status recording_begin(recording *r, world *w, fram_error *error);

/* ---- one that resumes: recording_prepare_resume, recording_read_state, then recording_resume ---- */

/* The folder's lock and the inputs, to continue what stands in it. */
fram_status recording_prepare_resume(recording *r, fram_error *error);
/* The newest good checkpoint into an empty world, and how long the streams were then. */
fram_status recording_read_state(recording *r, const model *m, world *w, recorder_lengths *lengths, fram_error *error);
/* The streams are cut to those lengths, the peaks are those of then, run.json says that it is running, and the state as
   it once went wrong is gone. */
fram_status recording_resume(recording *r, const recorder_lengths *lengths, fram_error *error);

/* ---- both ---- */

/* After each step: streams, pictures and checkpoints when due.  step_wall_time: time that the step took [s]. */
fram_status recording_step(recording *r, double step_wall_time, fram_error *error);
/* A checkpoint of now, on the disk when this returns; those that are due come there while the run goes on. */
fram_status recording_checkpoint(recording *r, fram_error *error);
/* Of now. */
void recording_result(const recording *r, run_result *out);
/* The end: the last checkpoint, pictures, results, run.json.  state: "finished", "stopped", "interrupted".  Whatever is
   returned, the streams are closed; what could not be written is FRAM_ERROR_IO. */
fram_status recording_end(recording *r, const char *state, fram_error *error);
/* The end of a world that went wrong: its state as failed.fram, the last good checkpoint stays, run.json tells the
   reason. */
void recording_fail(recording *r, const fram_error *reason);
void recording_free(recording *r);

#endif
