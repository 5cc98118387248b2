/* One mooring line as a quasi-static elastic catenary over a flat bottom without friction.  Pure functions of numbers;
   knows neither vessels nor worlds. */
#ifndef VESSEL_CATENARY_H
#define VESSEL_CATENARY_H

#include <stdbool.h>

typedef struct catenary_line {
    double length;    /* unstretched [m] */
    double weight;    /* in water, per metre [N/m] */
    double stiffness; /* axial, E A [N]; infinity: inextensible */
} catenary_line;

/* Pull of the line on its upper end. */
typedef struct catenary_pull {
    double horizontal; /* towards the anchor [N] */
    double vertical;   /* down [N] */
} catenary_pull;

double catenary_tension(catenary_pull pull);

/* Horizontal distance of the ends for a horizontal pull, the upper end `height` above the bottom (Jonkman 2007, eqs.
   2-35 to 2-38, without bottom friction).  pull gets the rest.  The distance grows with the pull. */
double catenary_distance(const catenary_line *line, double height, double horizontal, catenary_pull *pull);

/* Pull for a horizontal distance of the ends: Newton's method on the horizontal pull within a bracket, so that it
   cannot fail.  A line that lies on the bottom to below its upper end pulls down only.  `guess` (a horizontal pull, 0
   without) saves iterations and changes the answer by less than 1e-12 of the tension.  An inextensible line that is too
   short pulls with CATENARY_MOST. */
#define CATENARY_MOST 1e12 /* [N], beyond any breaking load */
catenary_pull catenary_solve(const catenary_line *line, double height, double distance, double guess);

/* The unstretched length with which the line pulls with `tension` at its upper end; false when no length does: the
   tension is less than the weight of the height. */
bool catenary_length_for(catenary_line line, double height, double distance, double tension, double *length);

#endif
