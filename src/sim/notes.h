/* What follows from a scenario, for a reader's eye before the run: lengths, loads, numbers of steps, and warnings. */
#ifndef SIM_NOTES_H
#define SIM_NOTES_H

#include "io/text_buffer.h"
#include "model/scenario.h"

void scenario_notes(context *ctx, const scenario *s, text_buffer *out);

#endif
