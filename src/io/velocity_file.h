/* Files of velocities: histories of wind, current and drift, and a current over depth.  Must not know what they move.
 */
#ifndef IO_VELOCITY_FILE_H
#define IO_VELOCITY_FILE_H

#include "fluid/media.h"
#include "model/scenario.h"

/* CSV that a scenario names, with the columns time[s] or depth[m], x[m/s] and y[m/s]: at least one row, the first
   column ascending, finite speeds within 200 m/s; FRAM_ERROR_INPUT with file and line.  A history; "": none.  What was
   read until an error is in `out`, to be freed by the caller. */
fram_status velocity_file_read(context *ctx, const scenario *s, const char *file, velocity_series *out,
                               fram_error *error);
/* A current over depth, 1 to CURRENT_LEVELS rows, depths from 0 on; "": none. */
fram_status velocity_profile_read(context *ctx, const scenario *s, const char *file, current_profile *out,
                                  fram_error *error);

#endif
