/* Whether a hull's axes are those of ships, x forward, y to port and z up, told by its shape: files of other programs
   have others.  Knows nothing of files. */
#ifndef VESSEL_HULL_AXES_H
#define VESSEL_HULL_AXES_H

#include "geometry/mesh.h"

typedef enum hull_axes { HULL_AXES_OF_SHIPS = 0, HULL_Y_FORWARD, HULL_Y_UP } hull_axes;
/* origin: of the hull's frame in the surface's [m]; length, beam: of the waterline, along x and y [m].
   HULL_Y_FORWARD: it is wider than long by a tenth at least.
   HULL_Y_UP: both sides lie about z = 0 and not about y = 0, and the surface lies about no other plane along x and z,
   or is wider along z than along y. */
hull_axes hull_axes_of(const mesh *surface, vec3 origin, double length, double beam);

#endif
