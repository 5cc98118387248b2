/* Drag on sample points (geometry/mesh_integrals.h) that lie in one medium.  Inside fluid. */
#ifndef FLUID_POINT_KERNEL_H
#define FLUID_POINT_KERNEL_H

#include "base/kernel.h"
#include "fluid/media.h"

/* A medium as the body meets it, body axes. */
typedef struct point_stream {
    vec3 velocity;     /* of the centre of mass relative to the medium, at the surface [m/s] */
    vec3 spin;         /* [rad/s] */
    double form, skin; /* 1/2 rho Cd, 1/2 rho Cf [kg/m3] */
    /* The medium's velocity grows by slope [1/s] with the depth from `top` on, until it is `thick` deeper. */
    int32_t layers;
    double top[CURRENT_LEVELS], thick[CURRENT_LEVELS];
    vec3 slope[CURRENT_LEVELS];
    vec3 down;    /* body axes */
    double depth; /* of the centre of mass under still water [m] */
} point_stream;

/* Sums of force and moment [N], [N m]; the lanes are added up at the end, in their order. */
typedef struct point_sums {
    double lane[6][8];
} point_sums;

/* Places [m], unit normals and areas [m2], body axes. */
typedef struct point_rows {
    const double *x, *y, *z, *nx, *ny, *nz, *area;
} point_rows;

/* Adds `count` points. */
KERNEL_DECLARE(void, point_drag,
               (const point_stream *stream, const point_rows *points, int32_t count, point_sums *sums));

#endif
