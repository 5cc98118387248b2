/* Fewer triangles for the same surface, within a distance.  Knows nothing of what the surface is for. */
#ifndef GEOMETRY_MESH_SIMPLIFY_H
#define GEOMETRY_MESH_SIMPLIFY_H

#include "geometry/mesh.h"

/* Take vertices out of a closed surface, one after the other, each by drawing it onto a neighbour, where old and new
   surface stay between two planes that are what is left of `distance` [m] apart; on a sharp edge on either side of it.
   What is left of it shrinks with every vertex that goes there, so that the new surface is nowhere farther than
   `distance` from the old one.  Vertices that stay do not move; closed stays closed.  The same surface gives the same
   bits; of port and starboard the one may keep other vertices than the other.  *largest gets the distance that may have
   been used up [m].  FRAM_ERROR_MEMORY: m is then empty. */
fram_status mesh_simplify(context *ctx, mesh *m, double distance, double *largest);

#endif
