/* The plan of a solid that leaves water open within its convex outline, as between the hulls of a catamaran.  One
   module with replay_moment. */
#ifndef RESULTS_REPLAY_PARTS_H
#define RESULTS_REPLAY_PARTS_H

#include "results/replay.h"

/* Append what a solid that is open covers of the global plan as it lies upright, turned by its heading, as simple rings
   that do not overlap; of any other solid, and where no such rings are found, nothing.  Found once for each body.
   FRAM_ERROR_MEMORY. */
fram_status replay_parts_add(replay *r, const replay_pose *p, polygon_list *out, fram_error *error);

#endif
