/* Ice pressure on a hull by panel: a finished run is computed again, and the forces of its contacts are summed on the
   panels of a vessel's hull (vessel/hull_panels.h).  Reads the run's folder; writes into another. */
#ifndef SIM_HULL_PRESSURE_H
#define SIM_HULL_PRESSURE_H

#include "vessel/hull_panels.h"

typedef struct pressure_options {
    const char *folder; /* of the run */
    const char *output; /* folder for the results, made where it is not there */
    panel_rules rules;  /* size NaN: a metre of full size */
    double from, to;    /* steps that end after `from`, up to `to`; `to` <= 0: the run's end [s] */
    const char *vessel; /* its name; NULL: the only one, or the first */
    bool force;         /* write into a folder that is not empty */
} pressure_options;

/* Writes panels.csv, area.csv, zones.csv, hull.vtp, pressure.fram, and pressure.png in a build with cairo.  The force
   of a crushing patch is spread over the rectangle that has its second moments, each part to the nearest panel that
   faces it.  Pressure is the normal force on a panel over its area [Pa], in a step; cumulative is the integral over
   time [Pa s].  The forces of all panels, friction included, add up to the ice load on the vessel in its own axes.
   FRAM_ERROR_INPUT: no run, no such vessel, panels that hull_panels_make refuses, no step between the times, inputs
   that were changed since. FRAM_ERROR_USAGE: a file of the run's scenario would be written over.  FRAM_INTERRUPTED when
   the context's stop flag is set; nothing is written then. */
fram_status hull_pressure_write(context *ctx, const pressure_options *o, fram_error *error);

#endif
