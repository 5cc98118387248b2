/* A wedge of ice on water under a tip load that rises in proportion to time, when the load is what the static solution
   of ice/wedge.h has: Winkler's foundation and a mass M of ice and water per area.  Pure ratios; knows neither floes
   nor loads.

   With lengths over l and time over sqrt(M/(rho_w g)),
       xi eta_tt + (xi eta'')'' + xi eta = xi p t/tau,   p = 2/(a/l)^2 for xi < a/l, 0 beyond. */
#ifndef ICE_WEDGE_RAMP_H
#define ICE_WEDGE_RAMP_H

typedef struct wedge_ramp {
    double moment; /* largest eta'' over the static one */
    double place;  /* its place over x_max */
    double tip;    /* eta(0) over the static one */
} wedge_ramp;
#define WEDGE_RAMP_STATIC ((wedge_ramp){1, 1, 1})

/* No moment ratio is above this. */
#define WEDGE_RAMP_MOST_MOMENT 1.05
/* Nor a tip's below this: a tip of no deflection would be rigid. */
#define WEDGE_RAMP_LEAST_TIP 1e-4

/* After the time tau of rising; 0.018 <= a/l <= 1 and 0.01 <= tau, others are moved to these ends.  From tau = 15 on
   the static solution. */
wedge_ramp wedge_ramp_at(double a_over_l, double tau);

#endif
