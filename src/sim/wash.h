/* The wash of propellers: jets of thrusters and propulsion (fluid/jet.h) that push floes. */
#ifndef SIM_WASH_H
#define SIM_WASH_H

#include "model/world.h"

/* After the thrusts of the step are known: adds to scratch.loads what the jets of vessels with `wash.active` do to
   floes that move, and writes scratch.wash_force.  A floe meets the root of the mean square of a jet's speed over it,
   as a current on top of that which is there, by the drag that it has in any current (fluid_load_prism), acting where
   the jet's momentum on it has its centre.  A jet gives the floes no more than its thrust: where the sum is larger,
   all get their share of it.  Jets add their forces.  Nothing where no vessel has wash. */
fram_status wash_forces(context *ctx, const model *m, world *w, fram_error *error);

#endif
