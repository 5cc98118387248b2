/* What follows from a scenario, for a reader's eye before the run: lengths, loads, numbers of steps, and warnings. */
#ifndef SIM_NOTES_H
#define SIM_NOTES_H

#include "io/text_buffer.h"
#include "model/model.h"
#include "model/scenario.h"
#include "model/world.h"
#include "sim/build_hull.h"

/* A line each, those of warnings begin with "warning: ". */
void notes_take(context *ctx, const scenario *s, text_buffer *out);
/* The same, by what was made of it where keys do not tell that.  m, made: its model, and its world before the first
   step; NULL: none. */
void notes_take_made(context *ctx, const scenario *s, const model *m, const world *made, text_buffer *out);
/* The warnings alone, to the log. */
void notes_log_warnings(context *ctx, const scenario *s, const model *m, const world *made);
/* Whether some of what is warned of is known when the world is made: how thick the floes of a file are, which current a
   file has, and where a vessel on its mooring begins. */
bool notes_ask_what_was_made(const scenario *s);
/* What can be made without a run (build_check, with its store of hulls), and the warnings alone, to the log: none of a
   scenario that is refused. */
fram_status notes_build_check(context *ctx, const scenario *s, hull_store *store, fram_error *error);

#endif
