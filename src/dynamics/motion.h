/* How a single body moves when nothing touches it.  Inside dynamics. */
#ifndef DYNAMICS_MOTION_H
#define DYNAMICS_MOTION_H

#include "bodies/body.h"

/* r += dt v, Q += dt/2 (0, Omega) Q, normalised; velocities in the global frame. */
void body_move(body_table *bodies, int32_t slot, vec3 velocity, vec3 angular_velocity, double dt);
/* Angular velocity after dt without moment; inertia and velocities in the body frame. */
vec3 spin_freely(sym3 inertia, vec3 angular_velocity, double dt);

#endif
