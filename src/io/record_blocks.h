/* What stands in each block of a run's record, by one way for both directions: what the recorder packs is what the
   replay unpacks.  The layout of io/record_layout.h in code; knows plain data, and must not know a world or what is
   made of a record.

   Packing, a function appends what it is given, and leaves that as it is; unpacking, it fills it from the block.  A
   block is sound to its checksum, yet lengths in it are believed only as far as it reaches: beyond its end zeros are
   given. */
#ifndef IO_RECORD_BLOCKS_H
#define IO_RECORD_BLOCKS_H

#include "base/array.h"
#include "io/record_layout.h"
#include "io/record_pose.h"

typedef struct record_stream {
    context *ctx;
    byte_array *out;               /* NULL: unpacks */
    const unsigned char *at, *end; /* what is left of a block that is unpacked */
    vec2 origin;                   /* of places in the block; those outside are global [m] */
    bool full;                     /* there was no memory: the packed block is worth nothing */
    bool unsound;                  /* something beyond the end was asked for, or what was unpacked cannot be */
} record_stream;

/* Packs into `out`, which is emptied and is the caller's. */
record_stream record_packer(context *ctx, byte_array *out, vec2 origin);
record_stream record_unpacker(const record_block *block, vec2 origin);

/* The head of deaths and births, and that of fractures and forces. */
void record_stream_count(record_stream *s, int32_t *count);
void record_stream_padded_count(record_stream *s, int32_t *count);
/* Put the count of a packed block, which is known when all is in it, to where its head has it. */
void record_stream_set_count(record_stream *s, uint32_t type, int32_t count);

/* One that died. */
void record_stream_slot(record_stream *s, int32_t *slot);

/* Before its points, then its triangles; unpacked only when the block has room for these. */
typedef struct record_solid {
    int32_t slot;
    uint32_t generation;
    int32_t vertices, faces;
} record_solid;
void record_stream_solid(record_stream *s, record_solid *b);
void record_stream_point(record_stream *s, vec3 *point);
void record_stream_face(record_stream *s, int32_t corner[3]);

/* Before its corners and, where it does not move, its pose; as above. */
typedef struct record_birth {
    int32_t slot;
    uint32_t generation;
    uint8_t material; /* enum material, not checked */
    bool moves, breakable, level;
    double thickness; /* [m] */
    double density;   /* [kg/m3] */
    int32_t number, parent, vertices;
} record_birth;
void record_stream_birth(record_stream *s, record_birth *b);
void record_stream_corner(record_stream *s, vec2 *corner);
void record_stream_pose(record_stream *s, vec3 *position, quat *orientation);

typedef struct record_fracture {
    double time;          /* [s] */
    int32_t kind;         /* enum fracture_kind */
    int32_t floe, pieces; /* number */
    vec3 place;           /* of the crack's start [m] */
    double load;          /* [N] */
    double crack_length;  /* [m] */
    double area;          /* of the floe [m2] */
} record_fracture;
void record_stream_fracture(record_stream *s, record_fracture *f);

typedef struct record_force {
    record_force_kind kind;
    int32_t vessel; /* number of the one that it is on, from 1; 0: not told */
    int32_t which;  /* slot of a body, or number of a line or thruster, from 1 */
    vec3 point;     /* [m] */
    vec3 force;     /* on the vessel [N] */
} record_force;
void record_stream_force(record_stream *s, record_force *f);

/* Before the bodies that move, by ascending slot. */
typedef struct record_frame_head {
    int64_t step;
    double time;    /* [s] */
    vec3 ice_force; /* on the first vessel, averaged [N] */
    int32_t count;
} record_frame_head;
void record_stream_frame(record_stream *s, record_frame_head *f);

typedef struct record_moving {
    vec3 position;
    quat orientation;
    double contact_force; /* sum of the magnitudes [N] */
} record_moving;
/* type: BLOCK_FRAME, or BLOCK_HALF_FRAME, which is not packed. */
void record_stream_moving(record_stream *s, uint32_t type, record_moving *m);

/* Bytes of the head of forces, of a force, and of a body in a frame that something touches. */
enum { FORCES_HEAD_SIZE = 8, RECORD_FORCE_SIZE = 32, RECORD_TOUCHED_SIZE = RECORD_POSE_SIZE + 2 };

#endif
