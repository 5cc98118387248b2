/* A wedge-shaped beam of ice on water, loaded at its tip: the circumferential crack (Nevel 1961).  Pure
   formulas in dimensionless form; knows neither floes nor loads.

   Width b = b0 x, characteristic length l, load P spread as uniform pressure over the tip 0 < x < a.  With xi = x/l and
   eta = w k b0 l^2 / P (k = rho_w g):
       xi eta'''' + 2 eta''' + xi eta = xi p,   p = 2/(a/l)^2 for xi < a/l, 0 beyond.
   Bending stress sigma = 6 P / (b0 h^2) eta''; its largest value, at x_max, is where the wedge breaks off. */
#ifndef ICE_WEDGE_H
#define ICE_WEDGE_H

/* Range of a/l that wedge_solve takes; others are moved to its ends. */
#define WEDGE_LEAST_LOAD 1e-3
#define WEDGE_MOST_LOAD 3.0

typedef struct wedge {
    double load_length;    /* a/l */
    double inner[2];       /* eta = p + inner[0] f0 + inner[1] f1 under the load */
    double outer[2];       /* eta = outer[0] TIP + outer[1] MOM beyond it */
    double x_max;          /* place of the largest eta'', R_bending / l */
    double curvature;      /* largest eta'' */
    double capacity;       /* C = 1/curvature: the wedge carries sigma_f b0 h^2 / 6 C */
    double tip_deflection; /* eta(0) */
} wedge;

/* The wedge for a load over 0 < x < a/l; by its own power series, to about 1e-11. */
wedge wedge_solve(double a_over_l);

/* eta(0) alone, at a fraction of the cost of wedge_solve. */
double wedge_tip_deflection(double a_over_l);

/* x_max within 5 %, at the cost of two powers. */
double wedge_breaking_estimate(double a_over_l);

/* eta, eta', eta'', eta''' at 0 < xi <= 6. */
void wedge_profile(const wedge *w, double xi, double out[4]);

#endif
