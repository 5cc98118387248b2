/* Eight prisms side by side as the kernels of level and of tilted floes are handed them, and what they hand back.
   Inside fluid; knows no tables and no outlines. */
#ifndef FLUID_PRISM_BATCH_H
#define FLUID_PRISM_BATCH_H

#include "base/vec.h"

#include <stdbool.h>
#include <stdint.h>

enum { PRISM_LANES = 8 };

/* One number for each prism. */
typedef double prism_lane[PRISM_LANES];
/* One point of each outline [m]. */
typedef vec2 prism_corner[PRISM_LANES];

/* What a medium is to each prism. */
typedef struct prism_medium {
    prism_lane velocity[3]; /* of the centre of mass, relative to the medium, global axes [m/s] */
    prism_lane form, skin;  /* 1/2 rho Cd, 1/2 rho Cf [kg/m3] */
} prism_medium;

/* Force [N] and moment about the centre of mass [N m]. */
typedef struct prism_wrench {
    prism_lane force[3], moment[3];
} prism_wrench;

typedef struct prism_batch {
    bool wet, dry;      /* whether drag of that medium is wanted */
    double weight;      /* rho g of the water [N/m3] */
    prism_lane height;  /* of the centre of mass over still water [m] */
    prism_lane turn[4]; /* orientation w x y z */
    prism_lane spin[3]; /* angular velocity, global axes [rad/s] */
    prism_lane half;    /* half the thickness [m] */
    prism_medium water, air;

    /* Out, global axes. */
    prism_lane volume;                              /* submerged [m3] */
    prism_wrench hydrostatic, water_drag, air_drag; /* drag: only where it is wanted */
    prism_wrench total;
} prism_batch;

#endif
