/* How many bytes a frame of the record takes, about, by what there is of moving bodies and of forces on the vessels:
   for the recorder, which keeps the record under its limit, and for what is told of a run's disk before it. */
#ifndef SIM_FRAME_SIZE_H
#define SIM_FRAME_SIZE_H

#include "model/scenario.h"
#include "model/world.h"

/* Of what moves now. */
double frame_size_of_world(const world *w);
/* Of a scenario with so many floes. */
double frame_size_of_scenario(const scenario *s, double floes);

#endif
