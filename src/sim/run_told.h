/* What a program told the world of a run that its scenario does not have, as far as the state of the world shows: who
   reads the scenario of such a run has to know. */
#ifndef SIM_RUN_TOLD_H
#define SIM_RUN_TOLD_H

#include "io/text_buffer.h"
#include "model/scenario.h"
#include "model/world.h"

/* Names, a line each: components of wind, current and drift, and of each vessel the force from outside,
   the path and the velocity of its carriage, by the names of inputs (controls.h); "set_point" where that ended way
   points of the scenario.  When it was told is not known, nor other set points, orders to thrusters and lines, which
   are no conditions. */
void run_told_list(context *ctx, const scenario *s, const world *w, text_buffer *out);

#endif
