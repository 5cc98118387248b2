/* Triangles that the water plane may cut, eight at a time: pressure on the wet part, and wet and dry part as sample
   points for drag (point_kernel.h).  Inside fluid. */
#ifndef FLUID_CUT_KERNEL_H
#define FLUID_CUT_KERNEL_H

#include "fluid/point_kernel.h"

/* A multiple of the lanes. */
enum { CUT_ROOM = 64 };

/* Still water as the body meets it: a point r, body axes, is height + up . r over it. */
typedef struct water_plane {
    vec3 up;
    double height; /* of the centre of mass [m] */
} water_plane;

typedef struct cut_batch {
    int32_t count;
    double corner[3][3][CUT_ROOM]; /* of corner i, component k, body axes about the centre of mass [m] */
    double drag[CUT_ROOM];         /* 1: wet and dry part stand for one point each; 0: their points have no area */
} cut_batch;

/* One point for each triangle of a batch, without area where there is none. */
typedef struct cut_points {
    double x[CUT_ROOM], y[CUT_ROOM], z[CUT_ROOM]; /* [m] */
    double nx[CUT_ROOM], ny[CUT_ROOM], nz[CUT_ROOM];
    double area[CUT_ROOM]; /* [m2] */
} cut_points;

/* Adds to `pressure` the integrals over the wet parts of h n dS [m3] and r x h n dS [m4], h the height over still
   water, body axes; writes a point for the wet and one for the dry part of each, up to a multiple of eight.  Makes the
   rest of the last eight of the batch triangles without area. A corner alone on its side of the plane makes a triangle
   whose sides are t1 and t2 of those of the whole, so its area is t1 t2 of the whole; the other part is what is left.
   The pressure integrals are those of facet_add_pressure (docs/oracles.md, section 5). */
KERNEL_DECLARE(void, cut_triangles,
               (const water_plane *plane, cut_batch *batch, point_sums *pressure, cut_points *wet, cut_points *dry));

#endif
