/* What a run leaves for people when it ends, made from its finished time series: FOLDER/loads.png, the ice load over
   time, and for a vessel on station FOLDER/station.json and station.png. */
#ifndef RESULTS_RUN_RESULTS_H
#define RESULTS_RUN_RESULTS_H

#include "model/scenario.h"
#include "vessel/outcome.h"

/* Pictures are a service: a build without cairo says once in the log what it skips, and goes on. */
fram_status run_results_write(context *ctx, const scenario *s, const station_outcome *station, const char *folder,
                              fram_error *error);

#endif
