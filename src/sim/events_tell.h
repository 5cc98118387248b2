/* What befalls vessels, told to the log. */
#ifndef SIM_EVENTS_TELL_H
#define SIM_EVENTS_TELL_H

#include "model/world.h"

/* The events from a row on. */
void events_tell(context *ctx, const model *m, const world *w, int32_t from);

#endif
