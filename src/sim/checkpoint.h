/* Checkpoints: the whole state, the lengths of the streams at that moment, and what the run was made of.  Two are kept.
 */
#ifndef SIM_CHECKPOINT_H
#define SIM_CHECKPOINT_H

#include "base/hash.h"
#include "io/late_commit.h"
#include "io/text_buffer.h"
#include "model/world.h"
#include "sim/peak_state.h"

/* What stands beside the state. */
typedef struct checkpoint_note {
    uint64_t series_length, record_length, fractures_length; /* bytes of the streams that belong to this state */
    char scenario_hash[SHA256_TEXT_SIZE];
    const char *inputs; /* of a run: the list of run_inputs_list; of a state alone: its run_inputs_digest */
    byte_array *peaks;  /* of peak_state_save, filled by reading; NULL: none, not asked for */
    bool failed;        /* of a step that failed; filled by reading */
    bool differs;       /* reading: the last one looked at is sound, but of another layout of tables */
} checkpoint_note;

/* Write FOLDER/checkpoint-STEP.fram, in two parts: the state is taken now, and brought to the disk after the streams
   that it speaks of while the run goes on; checkpoint_end waits for that and removes all but the newest two.  Nothing
   happens in checkpoint_end without a checkpoint under way. */
fram_status checkpoint_begin(context *ctx, const char *folder, const world *w, const checkpoint_note *note,
                             file_writer *const *streams, int stream_count, late_commit *commit, fram_error *error);
fram_status checkpoint_end(context *ctx, const char *folder, late_commit *commit, fram_error *error);
/* The state of a run that went wrong, for a look at it: FOLDER/failed.fram.  Never resumed from. */
fram_status checkpoint_write_failed(context *ctx, const char *folder, const world *w, const checkpoint_note *note,
                                    fram_error *error);
/* The state alone, without what a record knows of it, as bytes of ctx's memory, and back into an empty world of the
   model; `name` stands for a file in errors.  note says what it belongs to; its lengths are not looked at; *failed: the
   state is of a step that failed.  A run's checkpoint is taken too, wherever the files of its list lay. */
fram_status state_encode(context *ctx, const world *w, const checkpoint_note *note, char **data, size_t *size,
                         fram_error *error);
fram_status state_decode(context *ctx, const char *name, const void *data, size_t size, const model *m, world *w,
                         const checkpoint_note *note, bool *failed, fram_error *error);
/* Read the newest good checkpoint of a folder into an empty world of the run's model.  A damaged one is passed over
   with a warning in the log.  FRAM_ERROR_INPUT when there is none, or when it belongs to another scenario or to other
   inputs, is a state alone, to which no stream belongs, or of a step that failed.  note->scenario_hash and inputs say
   what is expected; the lengths are filled. */
fram_status checkpoint_read_newest(context *ctx, const char *folder, const model *m, world *w, checkpoint_note *note,
                                   fram_error *error);
/* The same of a checkpoint that is not after a time [s]; found: false when there is none that is sound, and the world
   is then to be freed. */
fram_status checkpoint_read_before(context *ctx, const char *folder, double time, const model *m, world *w,
                                   checkpoint_note *note, bool *found, fram_error *error);
/* Whether a file of this name, without its folder, is a checkpoint. */
bool checkpoint_is_name(const char *name);
/* Remove every checkpoint of a folder. */
void checkpoint_remove_all(context *ctx, const char *folder);

#endif
