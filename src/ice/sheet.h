/* A floating ice sheet with a straight free edge, loaded at that edge: the stress that opens the first, radial crack
   (Westergaard 1926; docs/theory.md).  Pure formulas in dimensionless form; knows neither floes nor loads.

   The load P is spread as uniform pressure over a half disk of radius a (or a strip 2 c long) at the edge; stress is
   the bending stress along the edge, sigma_yy, at the middle of the load, as sigma h^2 / P; lengths are over the
   characteristic length l. */
#ifndef ICE_SHEET_H
#define ICE_SHEET_H

/* Up to this a/l sheet_stress is Westergaard's closed form, beyond it the exact integral as tabulated. */
#define SHEET_CLOSED_FORM_MOST 0.3
/* The table ends here; larger loads get its last value. */
#define SHEET_TABLE_MOST 3.0

/* sigma_yy h^2 / P of a half disk for 0.005 <= a/l <= 3 and a Poisson's ratio of 0 to 0.5: within 1.1 % of the plate's
   exact value (1 % at 0.3), and within 1e-4 beyond the closed form. */
double sheet_stress(double a_over_l, double poisson_ratio);

/* Westergaard's closed form for the half disk:
   3(1+nu)/(pi(3+nu)) { ln[E h^3/(100 k a^4)] + 3.84 - 4nu/3 + (1+2nu) a/(2l) }, where E h^3/k = 12(1-nu^2) l^4. */
double sheet_stress_closed_form(double a_over_l, double poisson_ratio);

/* The exact value for a half disk by quadrature, to about 1e-6: milliseconds, for tables and tests. */
double sheet_stress_integral(double a_over_l, double poisson_ratio);
/* The same for a strip of edge, |y| < c. */
double sheet_stress_strip(double c_over_l, double poisson_ratio);
/* Half disk of the same stress, a/l: within 3 % of the stress of a strip for c/l from 0.05 to 2. */
double sheet_disk_of_strip(double c_over_l);
/* Deflection of the edge under a point load, w k l^2 / P. */
double sheet_edge_deflection(double poisson_ratio);
/* The edge's deflection at this distance along it from a point load there, over l; w k l^2 / P, for a Poisson's ratio
   of 0.3, within 0.003; its sum along the edge is that of a line load, sqrt(2).  0 from SHEET_INFLUENCE_MOST on. */
#define SHEET_INFLUENCE_MOST 5.0
double sheet_edge_influence(double y_over_l);

#endif
