/* Where the surface of a body is in the frame of a floe, and how it moves there (ice/patch.h). */
#ifndef ICE_SURFACE_FRAME_H
#define ICE_SURFACE_FRAME_H

#include "bodies/body.h"
#include "ice/patch.h"

/* Sets rotation and offset of the surface of the body `mover` in the frame of the body `floe`, whose rotation floe to
   global is given; slip and turn from their velocities of now with moves, 0 without.  rest: the
   speed under which it rests [m/s]. */
void surface_frame_set(patch_surface *surface, const body_table *bodies, int32_t mover, int32_t floe,
                       const mat3 *rotation, bool moves, double rest);

#endif
