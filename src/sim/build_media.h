/* Current and wind that change, from the files that a scenario names. */
#ifndef SIM_BUILD_MEDIA_H
#define SIM_BUILD_MEDIA_H

#include "fluid/media.h"
#include "model/scenario.h"

/* environment.current_file, wind_file: CSV with the columns time [s], x [m/s], y [m/s], at least one row, times
   ascending; the velocity is along X and Y, towards.  environment.current_profile_file: columns depth [m], x, y; 1 to
   CURRENT_LEVELS rows, depths from 0 on ascending.  FRAM_ERROR_INPUT with file, and line or what is wrong. */
fram_status build_media(context *ctx, const scenario *s, media_history *out, fram_error *error);

/* Times and speeds of the histories and of the profile that are likely in another unit, to the log. */
void history_warnings(context *ctx, const scenario *s, const media_history *h);

#endif
