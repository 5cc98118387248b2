/* How fast vessels go by themselves, and how far: by their keys alone, before anything is built.  Must not know what
   walls or ice make of it. */
#ifndef SIM_VESSEL_SPEED_H
#define SIM_VESSEL_SPEED_H

#include "model/model.h"
#include "model/scenario_vessel.h"

/* How fast a vessel goes by itself, on its path or on its carriage [m/s]; under its own power it makes a part of its
   speed in open water, or what is wanted where that is less. */
double vessel_own_speed(const scenario_vessel *v, double part);
/* The fastest that a vessel goes by itself, on its path or on its carriage [m/s]: an upper bound for one under its own
   power. */
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
