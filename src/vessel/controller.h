/* The controller of a vessel on dynamic positioning: PID in the vessel's frame with feed-forward, and the heading that
   meets the ice with the bow.  Pure functions of plain data. */
#ifndef VESSEL_CONTROLLER_H
#define VESSEL_CONTROLLER_H

#include "vessel/plane_motion.h"

#include <stdbool.h>

typedef struct pid_gains {
    vec3 proportional, derivative, integral; /* surge, sway, yaw */
} pid_gains;

/* Kp = diag(M) w^2, Kd = 2 zeta w diag(M), Ki = Kp w / 10 (Fossen 2011, section 12.2.9). */
pid_gains pid_gains_for(mat3 mass, double frequency, double damping);

/* tau = -Kp R^T e - Kd (v - v_ref) - Ki R^T integral(e) + feed_forward, e = place - wanted (global, heading the short
   way), v and tau in the vessel's frame.  The integral grows only where `hold` is false: it is held while the thrusters
   cannot give more (anti-windup). */
vec3 pid_step(const pid_gains *gains, vec3 place, vec3 velocity, vec3 wanted, vec3 wanted_velocity, vec3 feed_forward,
              bool hold, vec3 *integral, double dt);

/* Ice-vaning.  The heading turns against the horizontal force `load` (x, y, global) by `rate` [rad/s] at most, in
   proportion to the angle left over `time` [s]; it stays while the load is under `least` [N]. */
typedef struct vaning {
    double rate, time, least;
} vaning;
double vaning_step(const vaning *v, double heading, vec3 load, double dt);

#endif
