/* Frames of a long run in files beside its playback page: scripts that the page loads as it comes to them, which works
   from disk where fetching does not. */
#ifndef RESULTS_PLAYBACK_CHUNKS_H
#define RESULTS_PLAYBACK_CHUNKS_H

#include "io/atomic_file.h"
#include "io/base64.h"
#include "io/path.h"

#include <stdio.h>

/* Files FOLDER/0000.js, 0001.js, ...: framChunk(NUMBER, "base64 of blocks as they stand in a record"). */
typedef struct chunk_writer {
    context *ctx;
    char folder[PATH_ROOM]; /* where they belong */
    char *stage;            /* the folder in which they stand until then; NULL while there is none */
    uint64_t limit;         /* bytes of blocks in one file, unless a single frame is larger */
    int32_t count;          /* files begun */
    uint64_t filled;        /* bytes of blocks in the open one */
    atomic_file file;
    base64_writer text;
    bool open;
} chunk_writer;

/* The folder of the page `output`: PAGE-frames for PAGE.html.  FRAM_ERROR_INPUT when its name, or that of the page, is
   one that the file system does not take. */
fram_status chunks_folder(const char *output, char out[PATH_ROOM], fram_error *error);
/* Into the folder of the page. */
fram_status chunks_begin(context *ctx, const char *output, uint64_t limit, chunk_writer *w, fram_error *error);
/* Where a frame of so many bytes is about to go: number of the file, and offset in its blocks. */
fram_status chunks_place(chunk_writer *w, uint64_t size, int32_t *chunk, int32_t *offset, fram_error *error);
/* The files into their place, instead of those of an earlier page; none when nothing was written. */
fram_status chunks_commit(chunk_writer *w, fram_error *error);
void chunks_abandon(chunk_writer *w);

#endif
