/* Whether vessels are going to meet a wall of the domain: told before a run, and noted as an event when it happens, as
   is the band of an endless field; and whether they have left a domain without walls.  One module with vessel_check and
   step, which ask. */
#ifndef SIM_WALL_CHECK_H
#define SIM_WALL_CHECK_H

#include "model/scenario_vessel.h"
#include "model/world.h"

/* Warnings to the log: a vessel of given motion that reaches a wall, one under its own power that can, and waypoints in
   a wall.  w holds the vessel. */
void wall_warnings(context *ctx, const scenario *s, const vessel_entry *entry, const model *m, const world *w,
                   int32_t row);

/* Which vessels have met a wall for the first time: free ones by the solved contacts, those of given motion by where
   they are; or the band of a field that is fed, by both.  Events, told to the log.  false: no memory. */
bool wall_watch(context *ctx, const model *m, world *w);
/* At the end of a run, to the log: which vessels met a wall or band, and when, or lie where the domain has no ice. */
void wall_remind(context *ctx, const scenario *s, const model *m, const world *w);

#endif
