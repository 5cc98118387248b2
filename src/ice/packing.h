/* Packing: outlines of given size and shape brought to places and angles where no two overlap.  Shapes are
   only moved and turned, never changed.

   The floes start spread over the free area, large ones first, overlapping.  Then all overlaps are removed at once,
   round by round, by projected Gauss-Seidel on positions and angles over all contacts (a linear contact problem as in
   Torquato and Jiao 2010).  Where that gets stuck, the field is shaken ever more gently, as sand is, between the
   rounds; and a squeezed floe that would have more room in open water elsewhere is carried there.  Concave floes, which
   hook into each other, grow from small ones under a steady squeeze instead, and swap places.  Everything runs in a
   fixed order: same request, same bits.  Knows outlines only. */
#ifndef ICE_PACKING_H
#define ICE_PACKING_H

#include "geometry/overlay.h"

typedef struct packing_request {
    box2 domain;                   /* [m] */
    bool periodic_x, periodic_y;   /* the field repeats itself beyond the edge; otherwise the edge is a wall */
    const polygon_list *shapes;    /* simple, counter-clockwise, each about its centroid, at its size [m] */
    const polygon_list *coarse;    /* the shapes with fewer vertices: packed first, as that costs less; may be NULL */
    const polygon_list *obstacles; /* convex, fixed; may be NULL */
    uint64_t seed;
    double effort; /* lengths of the shaking, over the usual ones; 0: 1 */
} packing_request;

typedef struct packing_report {
    bool done;      /* no two overlap */
    double overlap; /* the largest that is left when not done [m] */
    double scale;   /* largest common factor of all floes at which nothing overlapped; 1 when done, 0 when none */
    int32_t rounds; /* of contact search and solution */
    int32_t moves;  /* of squeezed floes into open water */
} packing_report;

/* Where a shape lies: its centroid, and the cosine and sine of its turn. */
typedef struct packing_pose {
    vec2 centre, turn;
} packing_pose;
typedef ARRAY(packing_pose) packing_pose_array;

/* Poses of all shapes, in their order, replace what `poses` held.  Not reaching the goal is no failure: see
   report->done.  o may be NULL when all shapes are convex.  FRAM_ERROR_INPUT for a shape that is not simple,
   FRAM_ERROR_MEMORY. */
fram_status packing_solve(context *ctx, overlay *o, const packing_request *request, packing_pose_array *poses,
                          packing_report *report, fram_error *error);

/* A shape at its pose; false when there is no memory.  out is replaced. */
bool packing_outline(context *ctx, polygon shape, packing_pose pose, vec2_array *out);

#endif
