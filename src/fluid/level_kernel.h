/* Fluid on eight floes at once: level ones, prisms that stand upright and whose sides alone the water plane cuts, one
   cap wholly wet and the other wholly dry, as nearly all floes of a field are; and sunken ones in any pose, as pieces
   under a hull are.  Inside fluid; knows no tables.

   Everything is done in the body's axes, where the wet part of a side is a trapezium between the wet cap and the
   waterline, or the whole side, and the caps are the outline itself.

   Hydrostatics are exact, from the second moments of the outline (docs/oracles.md, section 5).
   Form drag of the caps is exact for any motion: the inflow f = L + g . r is linear, and where it changes its sign the
   part with f > 0 is made of triangles from a point of the line f = 0.
   Form drag of a side is exact along the edge and, unless its motion changes its sign over the depth, over the depth.
   Skin drag is a quadrature: two Gauss points along each edge.  On caps it is exact along rays from the point that
   rests; on sides it is taken at the middle of the depth. */
#ifndef FLUID_LEVEL_KERNEL_H
#define FLUID_LEVEL_KERNEL_H

#include "base/kernel.h"
#include "base/vec.h"

/* Most vertices of an outline, and floes of a batch. */
enum { LEVEL_VERTICES = 24, LEVEL_LANES = 8 };

/* One number for each floe. */
typedef double level_lane[LEVEL_LANES];

/* What a medium is to each floe. */
typedef struct level_stream {
    level_lane velocity[3]; /* of the centre of mass, relative to the medium, global axes [m/s] */
    level_lane form, skin;  /* 1/2 rho Cd, 1/2 rho Cf [kg/m3] */
} level_stream;

/* Force [N] and moment about the centre of mass [N m], global axes. */
typedef struct level_wrench {
    level_lane force[3], moment[3];
} level_wrench;

/* The floes as their drag was computed, body axes: what held_drag.h keeps. */
typedef struct level_state {
    level_lane moments[6]; /* of the outline: 1, x, y, xx, yy, xy */
    level_lane line[3];    /* waterline: height at the axis [m], slopes */
    level_lane spin[3];
    level_lane through_water[3], through_air[3]; /* velocity relative to the medium [m/s] */
    level_wrench water_drag, air_drag;           /* zero where it is not wanted */
} level_state;

typedef struct level_batch {
    int32_t sides;      /* edges of the longest outline; shorter ones are padded with their last point */
    bool wet, dry;      /* whether drag of that medium is wanted */
    bool level_only;    /* none counts as sunken */
    double weight;      /* rho g of the water [N/m3] */
    level_lane height;  /* of the centre of mass over still water [m] */
    level_lane turn[4]; /* orientation w x y z */
    level_lane spin[3]; /* angular velocity, global axes [rad/s] */
    level_lane half;    /* half the thickness [m] */
    level_stream water, air;
    vec2 corner[LEVEL_VERTICES + 1][LEVEL_LANES]; /* outline, closed by its first vertex [m] */

    /* Out. */
    unsigned level, sunken; /* bit i: floe i floats level, lies wholly in the water; other floes' loads mean nothing */
    level_lane volume;      /* submerged [m3] */
    level_wrench hydrostatic, water_drag, air_drag; /* drag: only where it is wanted */
    level_wrench total;
    level_state state;
} level_batch;

KERNEL_DECLARE(void, level_loads, (level_batch * batch));

#endif
