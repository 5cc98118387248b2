/* The recorder reads the world and writes the streams of a run, as the part of a recording (sim/recording.h) that does
   so in each step: series.csv (one row a step, or every csv_interval) and record.fram (the record: frames for playback,
   a file of io/record.h), and fractures.csv (one row a broken floe).  It never changes what moves.  The blocks of the
   record are those of io/record_layout.h. */
#ifndef SIM_RECORDER_H
#define SIM_RECORDER_H

#include "io/csv.h"
#include "io/record_layout.h"
#include "model/scenario.h"
#include "model/world.h"
#include "sim/contact_sums.h"
#include "sim/peak_watch.h"
#include "sim/series.h"

typedef struct recorder {
    context *ctx;
    series_layout layout;
    csv_writer series, fractures;
    record_writer record;
    vec2 origin;                       /* of the record's places [m] */
    int64_t series_every, frame_every; /* steps; 0: no frames */
    double time_step;                  /* [s] */
    double frames_most;                /* of the whole run, one every frame_every */
    double record_limit;               /* [bytes]; 0: none */
    byte_array block;                  /* scratch */
    contact_sum_array sums;            /* scratch, per body slot */
    ARRAY(double) row;                 /* scratch, per column */
    peak_watch peaks;                  /* written with checkpoints */
} recorder;

/* New files in folder. */
fram_status recorder_create(context *ctx, const scenario *s, const char *folder, const char *text, recorder *r,
                            fram_error *error);
/* Bytes of the streams, the unwritten ones included. */
typedef struct recorder_lengths {
    uint64_t series, record, fractures;
} recorder_lengths;
recorder_lengths recorder_lengths_of(const recorder *r);
/* Continue files cut to the lengths that a checkpoint holds.  A failure before all of them are found sound changes
   none; FRAM_ERROR_INPUT as record_continue, and for a record that an earlier Fram wrote. */
fram_status recorder_continue(context *ctx, const scenario *s, const char *folder, const recorder_lengths *lengths,
                              recorder *r, fram_error *error);
/* What is due after a step (or, at step 0, the first frame).  Frames come every frame_interval, or every second,
   fourth, eighth ... time when as many bodies, lines and thrusters as there are now would else fill the record beyond
   nine tenths of its limit over the run (sim/frame_size.h); the rest is for what stands between frames.  This depends
   on the state alone, so a resumed run records the same frames. */
fram_status recorder_step(recorder *r, world *w, double wall_time, fram_error *error);
/* The files of the streams. */
enum { RECORDER_STREAMS = 3 };
void recorder_streams(recorder *r, file_writer *out[RECORDER_STREAMS]);
/* Everything to the disk. */
fram_status recorder_flush(recorder *r, fram_error *error);
fram_status recorder_close(recorder *r, fram_error *error);

#endif
