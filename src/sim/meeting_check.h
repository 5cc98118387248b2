/* Whether two vessels whose motions are given are driven through each other: told before a run, since neither gives way
   and what contacts between them show means nothing. */
#ifndef SIM_MEETING_CHECK_H
#define SIM_MEETING_CHECK_H

#include "model/scenario_vessel.h"
#include "model/world.h"

/* A warning to the log for each earlier vessel that vessel `row` of w meets so within the run. */
void meeting_warnings(context *ctx, const scenario *s, const vessel_entry *entry, const model *m, const world *w,
                      int32_t row);

#endif
