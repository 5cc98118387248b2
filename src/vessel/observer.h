/* What the vessel knows of its own motion: two observers of place, velocity and the slowly varying force of ice, wind
   and current (the bias) from noisy measurements of place and heading.  Pure functions of plain data.
   Ice has no waves to filter out, but its load rises within seconds: both observers are tuned by how fast the bias may
   change. */
#ifndef VESSEL_OBSERVER_H
#define VESSEL_OBSERVER_H

#include "vessel/plane_motion.h"

typedef struct motion_estimate {
    vec3 place;    /* x, y, heading, global */
    vec3 velocity; /* surge, sway, yaw, vessel frame */
    vec3 bias;     /* force x, y [N], yaw moment [N m], global */
} motion_estimate;

/* Nonlinear passive observer without its wave filter (Fossen and Strand 1999, eqs. 17 to 21):
       place' = R velocity + 3 w e
       M velocity' = -D velocity + R^T bias + tau + 3 w^2 diag(M) R^T e
       bias' = -bias / T + R w^3 diag(M) R^T e            e = measured - place
   whose error has a triple pole at -w where damping and T are left out; at steps that are not small against 1/w the
   gains are less, so that the error of a step has it at exp(-w dt), however large w dt is.  Damping that would take
   more than a quarter of a velocity in a step is taken implicitly beyond that, and errors shrink however long steps
   are. */
typedef struct passive_tuning {
    double bandwidth; /* w [rad/s] */
    double bias_time; /* T [s] */
} passive_tuning;

void passive_observer_step(const plane_model *m, const passive_tuning *tuning, motion_estimate *e, vec3 tau,
                           vec3 measured, double dt);

/* Extended Kalman filter of the same model, in the same steps, with process noise. */
typedef struct kalman_tuning {
    vec3 measurement; /* standard deviations of the measurements [m, m, rad] */
    vec3 force;       /* of the unknown force on the velocities, per square root of a second [N s^0.5, N m s^0.5] */
    vec3 bias;        /* of the bias's change along and across the vessel, and of its moment's, per square root of a
                         second [N / s^0.5, N m / s^0.5] */
    double bias_time; /* [s] */
} kalman_tuning;

enum { KALMAN_STATES = 9 };
/* Covariance of place, velocity, bias in this order. */
typedef struct kalman_covariance {
    double of[KALMAN_STATES * KALMAN_STATES];
} kalman_covariance;

/* The covariance of an estimate that was just set to the measurement, with velocity and bias unknown to `speed` and
   `bias` (standard deviations along and across a vessel of this heading). */
kalman_covariance kalman_begin(const kalman_tuning *tuning, double heading, vec3 speed, vec3 bias);
/* The state as it moves on by dt. */
void kalman_predict(const plane_model *m, const kalman_tuning *tuning, motion_estimate *e, kalman_covariance *p,
                    vec3 tau, double dt);
/* A measurement, one component after the other. */
void kalman_correct(const kalman_tuning *tuning, motion_estimate *e, kalman_covariance *p, vec3 measured);

#endif
