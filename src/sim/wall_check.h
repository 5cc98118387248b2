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

/* How fast a vessel goes by itself, on its path or on its carriage [m/s]; under its own power it makes a part of its
   speed in open water, or what is wanted where that is less. */
double vessel_own_speed(const scenario_vessel *v, double part);
/* The fastest that a vessel goes by itself, on its path or on its carriage [m/s]: an upper bound for one under its own
 * power. */
double vessel_fastest(const scenario_vessel *v);
/* How far it comes in a time from the start at that speed, which grows evenly over the ramp of a carriage [m]. */
double vessel_way(const scenario_vessel *v, double time);
/* What a ship with propulsion makes in open water at its power, whatever speed is wanted [m/s]. */
double vessel_open_water_speed(const scenario_propulsion *p);
/* The most that such a ship lacks of a wanted speed over the ground once ice has stopped it, which rests or drifts
   against it [m/s]; infinity where files tell the drift and nobody has read them (NULL). */
double vessel_speed_lost_in_ice(const scenario *s, const media_history *read, double wanted);
/* Whether it goes on along its course: on a carriage, or under its own power where nothing says otherwise. */
bool vessel_keeps_course(const scenario_vessel *v);

#endif
