/* The record of a run: an append-only file of typed, checksummed blocks.  What the blocks hold is told in
   io/record_layout.h; the recorder (sim/recorder.h) writes it, within a recording (sim/recording.h), which is all that
   is written of a run.

   Layout, all numbers in the byte order of the machine that wrote it:
     head    "FRAMREC\n", u32 version, u32 0x01020304, u32 0, u32 crc of the 20 bytes before
     block   u32 'BLK\n', u32 type, u64 length, u32 crc of the payload, u32 crc of the 20 bytes before; payload;
             zeros up to a multiple of 8

   Thus blocks begin at multiples of 8, and a length is trusted only after its checksum.  crc is that of zlib. */
#ifndef IO_RECORD_H
#define IO_RECORD_H

#include "io/atomic_file.h"

/* Refused: larger files. */
#define RECORD_BYTES_MOST ((uint64_t)1 << 40)
enum { RECORD_VERSION = 1, RECORD_BLOCK_HEAD = 24 };

typedef struct record_writer {
    atomic_file file; /* of one that is created beside its path; of any other the writer alone */
} record_writer;

/* A payload may be given in parts, which are written one after the other. */
typedef struct record_part {
    const void *data;
    size_t size;
} record_part;

fram_status record_create(context *ctx, const char *path, record_writer *w, fram_error *error);
/* The same as an atomic file (atomic_file_begin_over), for record_place. */
fram_status record_create_beside(context *ctx, const char *path, record_writer *w, fram_error *error);
/* Open a record to be continued at `length` (a record_length of before), once the caller has cut it there by file_cut;
   FRAM_ERROR_INPUT when the head is not that of a record of this version and byte order, the file is shorter, or
   `length` is not the end of a block. */
fram_status record_continue(context *ctx, const char *path, uint64_t length, record_writer *w, fram_error *error);
fram_status record_append(record_writer *w, uint32_t type, const record_part *parts, int32_t count, fram_error *error);
fram_status record_flush(record_writer *w, bool sync, fram_error *error);
uint64_t record_length(const record_writer *w);
fram_status record_close(record_writer *w, fram_error *error);
/* Close a record that was begun beside its path, and put it there (atomic_file_place).  `written`: how writing it went;
   where that or this fails, the temporary file is removed and what was at the path stays. */
fram_status record_place(record_writer *w, fram_status written, fram_error *error);

/* The head of a block with this payload, for blocks that go elsewhere than into a record file. */
void record_block_head(uint32_t type, const void *payload, size_t size, unsigned char head[RECORD_BLOCK_HEAD]);

typedef struct record_block {
    uint32_t type;
    uint64_t offset; /* of the block in the file, for record_seek */
    size_t size;
    const void *data; /* aligned to 8 bytes at least; the reader's, until the next call */
} record_block;

typedef struct record_reader {
    context *ctx;
    int descriptor;
    char *path;
    uint64_t file_size;
    uint64_t position; /* of the next block: everything before it is good */
    void *payload;
    size_t capacity;
    char damage[160]; /* why reading stopped before the end of the file; empty otherwise */
} record_reader;

/* FRAM_ERROR_INPUT when it is not a record of this version and byte order. */
fram_status record_open(context *ctx, const char *path, record_reader *r, fram_error *error);
/* The next block.  found is false at the end of the file and at the first damaged or unfinished block: the reader's
   `damage` then says which.  Statuses are for what is not the file's fault. */
fram_status record_next(record_reader *r, record_block *block, bool *found, fram_error *error);
/* Warn in the log of what stopped the reading before the end of the file, if something did, and what follows. */
void record_tell_damage(const record_reader *r, const char *consequence);
/* What a reader says that needs a frame and found none in the whole record. */
fram_status record_refuse_frameless(const record_reader *r, fram_error *error);
/* Go to a block whose offset is known. */
void record_seek(record_reader *r, uint64_t offset);
void record_reader_close(record_reader *r);

#endif
