/* The world: all mutable state of a simulation, as the rooms' tables strung together, and the scratch of one step.
   Plain data: init, free, copy, hash.  No physics. */
#ifndef MODEL_WORLD_H
#define MODEL_WORLD_H

#include "dynamics/collision.h"
#include "dynamics/joint.h"
#include "dynamics/solver.h"
#include "fluid/fluid.h"
#include "ice/crushing.h"
#include "ice/floe.h"
#include "ice/fracture.h"
#include "vessel/mooring.h"
#include "vessel/station.h"
