/* Whether a table of current coefficients has the moment that it stands for: told before a run, since without it a
   moored vessel may swing itself up. */
#ifndef SIM_MUNK_CHECK_H
#define SIM_MUNK_CHECK_H

#include "model/model.h"
#include "model/scenario_vessel.h"

/* A warning to the log for a free vessel whose heading nothing steers. */
void munk_warnings(context *ctx, const scenario *s, const vessel_entry *entry, const model *m, int32_t row);

#endif
