/* What the blocks of a run's record hold: the one rule that the recorder writes by and the replay reads by, through
   io/record_blocks.h.

   Blocks of the record, numbers in the byte order of its head; poses are packed as io/record_pose.h says, 16 bytes.
   Places (of poses, cracks and points of forces) are told from an origin near the domain, since f32 has no millimetres
   in coordinates of a map:
    16 origin    f64 x y [m], the first block; without it the origin is 0
     1 scenario  the effective scenario, text
     2 solid     i32 slot, u32 generation, i32 vertices, i32 triangles; f32 x y z per vertex (body frame);
                 i32 a b c per triangle
     4 deaths    i32 count; i32 slot each
     6 fractures i32 count, i32 0; per floe that broke since the block before: f64 time, i32 kind (1 split, 2 bending),
                 i32 number of the floe, i32 pieces, i32 0; f32 x y z of the crack's start, load [N], crack length [m],
                 area of the floe [m2]; before the first frame at or after the event
     7 births    i32 count; per body: i32 slot, u32 generation, u8 material, u8 moves, u8 breakable, u8 level ice,
                 f32 thickness, f32 density, i32 number of the floe and of the one it broke from (-1: none),
                 i32 vertices; f32 x y per outline vertex (body frame); a body that does not move adds its pose
     9 forces    i32 count, i32 0; per force on a vessel in the last step: i32 kind (1 ice, all contacts with one floe;
                 2 mooring line; 3 thruster; 4 all contacts with another hull or a wall), where there are several
                 vessels with 256 times the number of that one (from 1), i32 slot of the body or number of the vessel's
                 line or thruster (from 1), f32 x y z of the point, f32 x y z of the force [N], global frame; before the
                 frame it belongs to
    15 frame     i64 step, f64 time, f64 x 3 averaged ice force on the first vessel [N], i32 count, i32 0; per moving
                 body, by ascending slot: its pose, and, if that is marked, u16 contact force, the sum of the
                 magnitudes at its contacts: kN of 6 bits of exponent and 10 of mantissa (16 or 18 bytes)
    12 peak      only in peaks.fram: what carried a large ice load on a vessel, io/peak_block.h
    10 beside    only in playback pages: i32 number of the file beside the page, i32 offset in its blocks, then a
                 frame's first 48 bytes; the frame itself and its forces stand there
    13 loads     only in playback pages: JSON, the load of each vessel by mechanism, its peaks explained
                 (results/playback_explained.c)
    14 pressure  only in pressure.fram and playback pages: ice pressure on a hull: hash of the scenario (64 characters),
                 f64 from, f64 to [s], i32 number of the vessel (from 0), i32 panels, i32 triangles, i32 0; per panel
                 f32 mean and largest pressure [Pa], time of that [s]; per triangle i32 panel; per triangle f32 x y z
                 of its corners (ship coordinates less the centre of mass: the frame of block 2)

   Types 3, 5 and 8 are of earlier layouts: known, so that such a record is refused by what it is and not as a damaged
   or an empty one (record_check_block), and their numbers are not given again. Type 11 was a frame with contact forces
   as half floats of kN, which end at 65.5 MN; it is read. Solids are announced by block 2 and take part in frames when
   they move. */
#ifndef IO_RECORD_LAYOUT_H
#define IO_RECORD_LAYOUT_H

#include "base/vec.h"
#include "io/record.h"

enum {
    BLOCK_SCENARIO = 1,
    BLOCK_SOLID = 2,
    BLOCK_EARLIER_BIRTHS = 3, /* without density and numbers of floes */
    BLOCK_DEATHS = 4,
    BLOCK_EARLIER_FRAME = 5, /* poses of 20 bytes, no forces */
    BLOCK_TOUCHED_FRAME = 8, /* a contact force with each pose, 0 too */
    BLOCK_FRACTURES = 6,
    BLOCK_BIRTHS = 7,
    BLOCK_FORCES = 9,
    BLOCK_FRAME_BESIDE = 10,
    BLOCK_HALF_FRAME = 11, /* of an earlier layout, which is read */
    BLOCK_PEAK = 12,
    BLOCK_LOADS = 13,
    BLOCK_PRESSURE = 14,
    BLOCK_FRAME = 15,
    BLOCK_ORIGIN = 16
};

static inline bool record_is_frame(uint32_t type) { return type == BLOCK_FRAME || type == BLOCK_HALF_FRAME; }

/* Bytes of a frame before its poses. */
enum { FRAME_HEAD_SIZE = 48 };
/* Of a pressure block: the hash, and all before its panels. */
enum { PRESSURE_HASH_SIZE = 64, PRESSURE_HEAD_SIZE = 96 };

/* Kinds of a force on a vessel. */
typedef enum record_force_kind {
    RECORD_FORCE_ICE = 1,
    RECORD_FORCE_LINE,
    RECORD_FORCE_THRUSTER,
    RECORD_FORCE_HULL /* of another hull or a wall */
} record_force_kind;
/* Contacts push, and are drawn towards their point; lines and thrusters pull. */
static inline bool record_force_pushes(record_force_kind kind)
{
    return kind == RECORD_FORCE_ICE || kind == RECORD_FORCE_HULL;
}

/* FRAM_ERROR_INPUT for a type of block that earlier layouts had; path names the record in the message. */
fram_status record_check_block(const char *path, uint32_t type, fram_error *error);

/* The block of an origin, but for 0. */
fram_status record_append_origin(record_writer *w, vec2 origin, fram_error *error);
/* FRAM_ERROR_INPUT for a block of type BLOCK_ORIGIN that is none. */
fram_status record_take_origin(const char *path, const record_block *block, vec2 *origin, fram_error *error);

/* That a record is of the layout which would go on: told by its blocks up to `length`, which give its origin too.  One
   whose blocks do not go on to there is for record_continue to refuse; one with other bytes in a block than were
   written is told, for the run can go on, and what reads the record cannot.  lost: the first block is such a one, where
   the recorder writes an origin, so that none was read and there may be one all the same. */
fram_status record_check_layout(context *ctx, const char *path, uint64_t length, vec2 *origin, bool *lost,
                                fram_error *error);

#endif
