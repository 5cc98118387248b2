/* A strip of ice on water, loaded along its end: the beam of unit width on an elastic foundation with free ends
   (Hetenyi 1946).  Pure formulas in dimensionless form; knows neither floes nor loads.

   Length L, characteristic length l, line load p at x = 0.  The largest moment, at x_max, is where the strip breaks
   off: semi-infinite 0.455938 p l at 1.110721 l; short beside l, where the strip is rigid on the water's linear
   pressure, 4/27 p L at L/3. */
#ifndef ICE_STRIP_H
#define ICE_STRIP_H

typedef struct strip {
    double x_max;     /* place of the largest moment, over l */
    double moment;    /* largest moment over p l */
    double stiffness; /* p over k w l, w the deflection of the loaded end: semi-infinite 1/sqrt(2), short L/(4 l) */
} strip;

/* No moment is above this, over p l: the semi-infinite strip's is the largest. */
#define STRIP_MOST_MOMENT 0.46

/* The strip of this length over l, which may be infinite; to about 1e-9. */
strip strip_solve(double length_over_l);

#endif
