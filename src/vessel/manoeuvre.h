/* A ship that goes ahead in the water plane: what the water does to a hull that slides aside and turns, added mass
   included, counted once (docs/decisions/0380).  Ship's axes through the centre of mass (x forward, y to port,
   counter-clockwise), speeds through the water.

   A regression of forces that were measured on models holds all that goes with u v and u r, so also the moment of Munk
   and the other terms that Kirchhoff's equations have of them:  Y = -a11 u r,  N = -(a22 - a11) u v - a26 u r. Where
   the equations of motion hold these already the hull's lift is the regression less these.

   A table of the current has all that goes with u v.  A hull that has one has no y_v and n_v of the regression, and its
   equations of motion leave Munk's moment out (docs/decisions/0555). */
#ifndef VESSEL_MANOEUVRE_H
#define VESSEL_MANOEUVRE_H

/* Y = u (y_v v + y_r r) to port, N = u (n_v v + n_r r) counter-clockwise, at a speed u ahead. */
typedef struct hull_lift {
    double y_v; /* [kg/m] */
    double y_r; /* [kg] */
    double n_v; /* [kg] */
    double n_r; /* [kg m] */
} hull_lift;
/* Of a hull's waterline length, beam, draught and displaced volume, by the regression of Clarke, Gedling and Hine
   (1983), which was made of merchant hulls: about the middle of the waterline. */
hull_lift hull_lift_of(double length, double beam, double draught, double volume, double water_density);
/* The same about a point that lies this far aft of the one it is about [m]. */
hull_lift hull_lift_moved(hull_lift lift, double aft);

typedef struct manoeuvring {
    double mass;          /* of the ship alone [kg] */
    double inertia;       /* in yaw, with that of the water [kg m2] */
    double a11, a22, a26; /* added mass of surge, sway, and of sway by yaw; 0 where the ship has none [kg, kg, kg m] */
    hull_lift whole;      /* all that goes with u v and u r; y_v and n_v 0: a table has what goes with u v */
} manoeuvring;

/* What the equations of motion do not hold of it. */
hull_lift manoeuvring_lift(const manoeuvring *m);
/* Yaw acceleration is (N - lever (Y - m u r)) / inertia, where the sway that goes with it is taken out. */
double manoeuvring_lever(const manoeuvring *m);   /* [m] */
double manoeuvring_inertia(const manoeuvring *m); /* [kg m2] */

#endif
