/* The jet of a propeller: a round, turbulent, submerged jet that spreads and slows down.  Behind a disc of diameter D
   that gives the thrust T the slipstream contracts to D0 = D / sqrt(2) and there has U0 = sqrt(Va^2 + 2 T / (rho A)) -
   Va over the water around (Rankine and Froude's momentum theory; A the disc's area, Va the propeller's own way through
   the water).  From there it is that of Albertson, Dai, Jensen and Rouse (1950): a core of speed U0 that ends at x0 =
   D0 / (2 C), beyond it U = U0 x0 / x on the axis, across it exp(-r^2 / (2 C^2 x^2)).  C = 0.081 for a nozzle
   (Albertson et al.: U / U0 = 6.2 D0 / x), 0.18 for a propeller (Blaauw and van de Kaa 1978: 2.8 D0 / x, exp(-15.4
   r^2 / x^2)).  Its momentum flux is the same at any distance, and at no way that of the thrust.
   Knows no vessels and no tables. */
#ifndef FLUID_JET_H
#define FLUID_JET_H

#include "base/vec.h"
#include "geometry/polygon.h"

typedef struct jet {
    vec3 origin;     /* of the propeller, global frame; a jet is level [m] */
    vec2 along;      /* unit: where the water goes */
    double diameter; /* D0 [m] */
    double speed;    /* U0, over the water around [m/s] */
    double spread;   /* C [1] */
    double length;   /* it ends there [m] */
} jet;

/* Sets speed and diameter; diameter, density > 0, thrust and advance >= 0. */
void jet_set_thrust(jet *j, double thrust, double diameter, double advance, double density);
/* Speed at a distance along the axis and off it [m/s]; 0 ahead of the propeller. */
double jet_speed(const jet *j, double x, double r);

/* What of a jet meets a level plate. */
typedef struct jet_share {
    double speed; /* root of the mean of U^2 over the outline's area [m/s]; 0: the jet misses it */
    vec3 arm;     /* where U^2 has its centre over it, from `centre`, global frame [m] */
} jet_share;

/* Over the outline (body axes about `centre`) of a nearly level plate, at the height of `centre` plus `rise` [m].
   By JET_GRID^2 points, closer where the jet is narrow. */
enum { JET_GRID = 10 };
jet_share jet_over(const jet *j, polygon outline, vec3 centre, mat3 rotation, double rise);

#endif
