/* The recorder reads the world and writes the streams of a run: series.csv (one row a step, or every csv_interval) and
   record.fram (frames for playback), and fractures.csv (one row a broken floe).  It never changes what moves.

   Blocks of the record, numbers in the byte order of its head:
     1 scenario  the effective scenario, text
     2 solid     i32 slot, u32 generation, i32 vertices, i32 triangles; f32 x y z per vertex (body frame);
                 i32 a b c per triangle
     3 births    i32 count; per body: i32 slot, u32 generation, u8 material, u8 moves, u8 0, u8 0, f32 thickness,
                 i32 vertices; f32 x y per outline vertex (body frame); a body that does not move adds its pose (as in
                 a frame)
     4 deaths    i32 count; i32 slot each
     5 frame     i64 step, f64 time, f64 x 3 averaged ice force on the vessel [N], i32 count, i32 0; per moving body, by
                 ascending slot: f32 x y z, i16 x 4 orientation w x y z times 32767 (20 bytes)
     6 fractures i32 count, i32 0; per floe that broke since the block before: f64 time, i32 kind (1 split, 2 bending),
                 i32 number of the floe, i32 pieces, i32 0; f32 x y z of the crack's start, load [N], crack length [m],
                 area of the floe [m2]; before the first frame at or after the event
   Solids are announced by block 2 and take part in frames when they move. */
#ifndef SIM_RECORDER_H
#define SIM_RECORDER_H

#include "io/csv.h"
#include "io/record.h"
#include "model/scenario.h"
#include "model/world.h"

enum { BLOCK_SCENARIO = 1, BLOCK_SOLID, BLOCK_BIRTHS, BLOCK_DEATHS, BLOCK_FRAME, BLOCK_FRACTURES };

typedef struct recorder {
    context *ctx;
    csv_writer series, fractures;
    record_writer record;
    int64_t series_every, frame_every; /* steps; 0: no frames */
    ARRAY(unsigned char) block;        /* scratch */
} recorder;

/* New files in folder. */
fram_status recorder_create(context *ctx, const scenario *s, const char *folder, const char *text, recorder *r,
                            fram_error *error);
/* Bytes of the streams, the unwritten ones included. */
typedef struct recorder_lengths {
    uint64_t series, record, fractures;
} recorder_lengths;
recorder_lengths recorder_lengths_of(const recorder *r);
/* Continue files cut to the lengths that a checkpoint holds. */
fram_status recorder_continue(context *ctx, const scenario *s, const char *folder, const recorder_lengths *lengths,
                              recorder *r, fram_error *error);
/* What is due after a step (or, at step 0, the first frame). */
fram_status recorder_step(recorder *r, world *w, double wall, fram_error *error);
/* Everything to the disk. */
fram_status recorder_flush(recorder *r, fram_error *error);
fram_status recorder_close(recorder *r, fram_error *error);

/* A time interval as a number of steps: at least 1, 0 for 0. */
int64_t interval_steps(double interval, double time_step);

#endif
