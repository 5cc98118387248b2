/* Contact points of two convex bodies once their contact plane is known.  Inside dynamics. */
#ifndef DYNAMICS_MANIFOLD_H
#define DYNAMICS_MANIFOLD_H

#include "dynamics/collision.h"

typedef struct manifold_point {
    vec3 point; /* midway between the two surfaces */
    double depth;
    uint32_t feature;
} manifold_point;

/* Largest polygon that is clipped; faces with more than half as many vertices are thinned. */
enum { CLIP_MOST = 128 };

/* A vertex of a polygon that is being clipped, and a name of the edge that starts there. */
typedef struct clip_vertex {
    vec3 point;
    uint32_t edge;
} clip_vertex;

/* A flat face in some frame: vertices counter-clockwise seen from outside, unit outward normal. */
typedef struct flat_face {
    vec3 point[CLIP_MOST / 2];
    int32_t count;
    vec3 normal;
    uint32_t name;
} flat_face;

/* How near surfaces count. */
typedef struct nearness {
    double slack; /* pieces farther apart than this do not touch [m] */
    double reach; /* points of touching pieces that are open by less than this are reported too [m] */
} nearness;

/* The incident face clipped by the sides of the reference face; at most 4 points, none when all of them are open by
   more than the slack.  swapped goes into the features, for the case that b holds the reference. */
int face_manifold(const flat_face *reference, const flat_face *incident, nearness near, bool swapped,
                  manifold_point out[4]);

/* At most four of n points, so chosen that the patch keeps its extent; returns their number. */
int manifold_reduce(const manifold_point *points, int n, vec3 normal, manifold_point out[4]);

/* The name of a point where edges `before` and `after` of a clipped face meet. */
static inline uint32_t manifold_feature(bool swapped, uint32_t reference, uint32_t incident, uint32_t before,
                                        uint32_t after)
{
    return (swapped ? 1u << 30 : 0) | (reference & 255u) << 22 | (incident & 255u) << 14 | (before & 127u) << 7 |
           (after & 127u);
}

/* What a piece knows of its seams inside a compound: they part pieces, but no contact may take their normal. */
typedef struct piece_seams {
    uint64_t faces;                 /* bit k: face k is a seam, all of it; of prisms */
    const polyhedron_array *pieces; /* of the solid that it was cut from, in that one's frame; NULL: it was not */
    int32_t piece;                  /* among them */
    mat3 rotation;                  /* of that frame to the common one */
    vec3 centre;
} piece_seams;

typedef struct pair_seams {
    piece_seams a, b;
    bool dropped; /* out: a contact that pushes at an inside was */
} pair_seams;

/* An outer face may stand in for a nearer seam only while it is not much deeper than that: beyond this ratio it is the
   far side of the piece.  The sharpest corner that still finds its face has a half angle of atan(1/8). */
#define SEAM_DEPTH_RATIO 8.0
/* An edge pair, another body's face or a lid is taken only when it is less deep than the first choice by this factor,
   so that the choice does not waver between equals; the slack keeps it from wavering between roundings of zero. */
#define PREFERENCE 0.95
static inline bool clearly_less(double depth, double than, double slack)
{
    return depth + slack < PREFERENCE * (than + slack);
}

/* Manifold of two convex polyhedra given in a common frame: up to 4 points; normal from b to a.  Returns the number of
   points; axis in: remembered separating axis or zero, out: new one when separated.  The feature of a point is a small
   integer that names the features met. */
int polyhedra_manifold(const polyhedron *a, const polyhedron *b, pair_seams *seams, nearness near, vec3 *normal,
                       manifold_point out[4], vec3 *axis);

#endif
