/* The recorder reads the world and writes the streams of a run: series.csv (one row a step, or every csv_interval) and
   record.fram (frames for playback), and fractures.csv (one row a broken floe).  It never changes what moves.

   Blocks of the record, numbers in the byte order of its head; poses are packed as sim/record_pose.h says, 16 bytes:
     1 scenario  the effective scenario, text
     2 solid     i32 slot, u32 generation, i32 vertices, i32 triangles; f32 x y z per vertex (body frame);
                 i32 a b c per triangle
     4 deaths    i32 count; i32 slot each
     6 fractures i32 count, i32 0; per floe that broke since the block before: f64 time, i32 kind (1 split, 2 bending),
                 i32 number of the floe, i32 pieces, i32 0; f32 x y z of the crack's start, load [N], crack length [m],
                 area of the floe [m2]; before the first frame at or after the event
     7 births    i32 count; per body: i32 slot, u32 generation, u8 material, u8 moves, u8 breakable, u8 level ice, f32
   thickness, f32 density, i32 number of the floe and of the one it broke from (-1: none), i32 vertices; f32 x y per
                 outline vertex (body frame); a body that does not move adds its pose
     9 forces    i32 count, i32 0; per force on the first vessel in the last step: i32 kind (1 ice, all contacts with
   one floe; 2 mooring line; 3 thruster), i32 slot of the floe or number of line or thruster (from 1), f32 x y z of the
   point, f32 x y z of the force [N], global frame; before the frame it belongs to
    11 frame     i64 step, f64 time, f64 x 3 averaged ice force on the vessel [N], i32 count, i32 0; per moving body, by
                 ascending slot: its pose, and, if that is marked, u16 contact force, the sum of the magnitudes at its
                 contacts, a half float of kN (16 or 18 bytes)
    10 beside    only in playback pages: i32 number of the file beside the page, i32 offset in its blocks, then a
   frame's first 48 bytes; the frame itself and its forces stand there

   Types 3, 5 and 8 were births and frames of earlier layouts and are not written any more. Solids are announced by
   block 2 and take part in frames when they move. */
#ifndef SIM_RECORDER_H
#define SIM_RECORDER_H

#include "io/csv.h"
#include "io/record.h"
#include "model/scenario.h"
#include "model/world.h"
#include "sim/contact_sums.h"

enum {
    BLOCK_SCENARIO = 1,
    BLOCK_SOLID = 2,
    BLOCK_EARLIER_BIRTHS = 3,
    BLOCK_DEATHS = 4,
    BLOCK_EARLIER_FRAME = 5,
    BLOCK_TOUCHED_FRAME = 8, /* of an earlier layout too */
    BLOCK_FRACTURES = 6,
    BLOCK_BIRTHS = 7,
    BLOCK_FORCES = 9,
    BLOCK_FRAME_BESIDE = 10,
    BLOCK_FRAME = 11
};

/* Bytes of a frame before its poses. */
enum { FRAME_HEAD_SIZE = 48 };

/* Kinds of a force on the vessel. */
typedef enum record_force_kind { RECORD_FORCE_ICE = 1, RECORD_FORCE_LINE, RECORD_FORCE_THRUSTER } record_force_kind;

typedef struct recorder {
    context *ctx;
    csv_writer series, fractures;
    record_writer record;
    int64_t series_every, frame_every; /* steps; 0: no frames */
    double time_step;                  /* [s] */
    double frames_most;                /* of the whole run, one every frame_every */
    double record_limit;               /* [bytes]; 0: none */
    ARRAY(unsigned char) block;        /* scratch */
    contact_sum_array sums;            /* scratch, per body slot */
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
/* FRAM_ERROR_INPUT for a type of block that earlier layouts had. */
fram_status recorder_check_block(const char *path, uint32_t type, fram_error *error);
/* What is due after a step (or, at step 0, the first frame).  Frames come every frame_interval, or every second,
   fourth, eighth ... time when as many bodies as there are now would else fill the record beyond nine tenths of its
   limit over the run; the rest is for what stands between frames.  This depends on the state alone, so a resumed run
   records the same frames. */
fram_status recorder_step(recorder *r, world *w, double wall, fram_error *error);
/* The files of the streams. */
enum { RECORDER_STREAMS = 3 };
void recorder_streams(recorder *r, file_writer *out[RECORDER_STREAMS]);
/* Everything to the disk. */
fram_status recorder_flush(recorder *r, fram_error *error);
fram_status recorder_close(recorder *r, fram_error *error);

/* A time interval as a number of steps: at least 1, 0 for 0. */
int64_t interval_steps(double interval, double time_step);

#endif
