/* Forces of wind or current on a vessel by tables of coefficients, in the manner of OCIMF (Prediction of Wind and
   Current Loads on VLCCs, 2nd edition, 1994): with the speed u of the medium past the vessel and the angle of its
   motion, X = 1/2 rho CX A_frontal u^2,  Y = 1/2 rho CY A_lateral u^2,  N = 1/2 rho CN A_lateral L u^2 forward, to port
   and counter-clockwise, at a reference point.  The angle is that of the medium's motion past the vessel,
   counter-clockwise from the bow: 0 from astern, 90 degrees from starboard, 180 from ahead.
   Knows no tables of bodies. */
#ifndef FLUID_FLOW_TABLE_H
#define FLUID_FLOW_TABLE_H

#include "bodies/body.h"

enum { FLOW_ANGLES = 73 };

typedef struct flow_table {
    int32_t count;                 /* 0: none given */
    double angle[FLOW_ANGLES];     /* ascending from 0; the last is pi (sides are alike) or 2 pi [rad] */
    vec3 coefficient[FLOW_ANGLES]; /* CX, CY, CN */
    double frontal, lateral;       /* A [m2] */
    double length;                 /* L [m] */
    vec3 point;                    /* where X and Y act, body frame about the centre of mass [m] */
} flow_table;

/* CX, CY, CN at any angle [rad], linear between rows. */
vec3 flow_coefficients(const flow_table *t, double angle);
/* Force [N] and moment about the centre of mass [N m], global frame, for a medium of a density that moves past with
   `past` [m/s], global frame; its vertical component does not count. */
wrench flow_load(const flow_table *t, double density, mat3 rotation, vec3 past);

#endif
