/* Commits that wait for the disk in a thread of their own, so that a run goes on meanwhile: the streams that a file
   speaks of are synced first, then the file (io/atomic_file.h), then it is renamed to its place.  Whenever the program
   is stopped, a file at its place speaks only of bytes that are on the disk. */
#ifndef IO_LATE_COMMIT_H
#define IO_LATE_COMMIT_H

#include "base/background.h"
#include "io/atomic_file.h"

enum { LATE_STREAMS = 4 };

/* Starts as {0}.  One commit at a time. */
typedef struct late_commit {
    atomic_file file;
    const file_writer
        *streams[LATE_STREAMS]; /* may be written to meanwhile, but neither flushed with sync nor closed */
    int stream_count, folder;
    background thread;
    bool pending;
    int failed; /* errno, 0 */
    const char *failed_path, *attempt;
} late_commit;

/* Takes over a file that is written but not committed, and flushes all to the system; on an error the temporary file is
   removed.  Without a thread to be had the commit is done at once.  None may be pending. */
fram_status late_commit_start(late_commit *c, atomic_file *file, file_writer *const *streams, int stream_count,
                              fram_error *error);
/* Waits for the commit under way, if there is one, and says how it ended. */
fram_status late_commit_wait(late_commit *c, fram_error *error);

#endif
