/* The plan of the field at one moment of a run, between frames by interpolation; what the later frame lacks goes on
   with its velocity. */
#ifndef RESULTS_REPLAY_MOMENT_H
#define RESULTS_REPLAY_MOMENT_H

#include "results/replay.h"

/* Outlines in global plan coordinates; row i of all arrays belongs to outline i.  Prisms as their plan, solids as the
   convex hull of theirs.  Behind them stand the parts of solids that leave water open within that. */
typedef struct replay_moment {
    double time; /* [s] */
    polygon_list outlines;
    ARRAY(replay_pose) poses;
    int32_array part_of; /* outline poses.count + k is a part of the solid in row part_of[k] */
} replay_moment;

/* Go to the last frame whose time is not after `time` and find the plan then; the replay goes forwards only.
   FRAM_ERROR_INPUT when `time` is outside the record. */
fram_status replay_moment_at(replay *r, double time, replay_moment *out, fram_error *error);
/* The same, where the last frame stands for what follows it: runs end between frames, and series go on behind the last
   one. */
fram_status replay_moment_until(replay *r, double time, replay_moment *out, fram_error *error);
/* The plan of the current frame. */
fram_status replay_moment_now(replay *r, replay_moment *out, fram_error *error);
/* The row of an outline; -1 where parts stand for it. */
int32_t replay_moment_row(const replay_moment *m, int32_t outline);
void replay_moment_free(context *ctx, replay_moment *m);

#endif
