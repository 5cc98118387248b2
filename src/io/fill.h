/* Opening what is to be filled with bytes from its beginning.  What lies behind the name decides how: a file is
   emptied, a stream of this program goes on, a pipe is waited for.  Knows names; must not know what is written.
   One module with file, which writes, and temporary, which makes files that take a name's place. */
#ifndef IO_FILL_H
#define IO_FILL_H

#include "base/context.h"

/* *descriptor for the caller to close, for writing alone: who could read from a pipe too would never be told that its
   reader has gone, and wait.
   - A name that leads to a descriptor of this program (/dev/stdout, /dev/stderr, /dev/fd/3, /proc/self/fd/3) is that
   one once more, behind all that went into it, standard output's buffer too; nothing is emptied.
   - A named pipe is waited for until it has a reader; FRAM_INTERRUPTED when the stop flag is set meanwhile.
   - Anything else is emptied, or made. */
fram_status fill_open(context *ctx, const char *path, int *descriptor, fram_error *error);
/* Whether that is a descriptor of this program, wherever it leads, a pipe or a device: then nothing can stand beside
   what is written.  False for a name of which nothing is there. */
bool fill_is_stream(const char *path);

#endif
