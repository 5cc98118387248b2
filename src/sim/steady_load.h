/* What a steady current and wind exert on a hull that lies still: drag, and the linear damping of given matrices, as
   the step has them. */
#ifndef SIM_STEADY_LOAD_H
#define SIM_STEADY_LOAD_H

#include "sim/step.h"

/* Force along X and Y [N] and yaw moment about the centre of mass [N m], global frame, of the media on a body of a
   vessel that lies at its place with this heading [rad]. */
vec3 steady_media_load(const step_settings *settings, const world *w, int32_t body, const media *m, double heading);

#endif
