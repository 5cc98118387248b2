/* What ice that gives out of its plane leaves of the load between two floes: ridges of thick ice (docs/decisions/0113),
   rafts of thin ice (docs/decisions/0556).  Bounds; what is built has no weight and no friction of its own. */
#ifndef ICE_PACK_LIMIT_H
#define ICE_PACK_LIMIT_H

#include "ice/material.h"

typedef struct pack_limit {
    double ridging;      /* R of ice_ridging_line_load, 0: no ridges */
    double edge_slope;   /* rise over run of broken edges, 0: no rafts */
    double water_weight; /* rho_w g [N/m3] */
} pack_limit;

/* One of the two floes. */
typedef struct pack_floe {
    ice_material ice;
    double thickness; /* [m] */
} pack_floe;

/* Largest line load between two floes along a front of the given width [m] with friction mu between them [N/m]; the
   lower of ridges and rafts, infinite where neither bounds it. */
double pack_line_load(const pack_limit *limit, const pack_floe floe[2], double friction, double width);

#endif
