/* What a steady current and wind exert on a hull that lies still: drag, and the linear damping of given matrices, as
   the step has them. */
#ifndef SIM_STEADY_LOAD_H
#define SIM_STEADY_LOAD_H

#include "model/world.h"

/* Force along X and Y [N] and yaw moment about the centre of mass [N m], global frame, of the media on a vessel that
   lies at its place with this heading [rad]: both together; what goes with the square of the speed alone (drag of
   panels and tables, and Munk's moment); and the linear damping of the water's motion past the hull alone (none for a
   hull that is driven). */
vec3 steady_media_load(const model *m, const world *w, int32_t vessel, const media *now, double heading);
vec3 steady_drag_load(const model *m, const world *w, int32_t vessel, const media *now, double heading);
vec3 steady_damping_load(const model *m, const world *w, int32_t vessel, const media *now, double heading);

#endif
