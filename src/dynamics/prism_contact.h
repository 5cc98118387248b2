/* Contact of two prisms: separating axes in plan view with the exact heights, clipping of the side faces while the two
   are nearly level to one another, and the general way otherwise.  Inside dynamics. */
#ifndef DYNAMICS_PRISM_CONTACT_H
#define DYNAMICS_PRISM_CONTACT_H

#include "dynamics/manifold.h"

/* One convex piece of a prism shape, placed. */
typedef struct prism {
    const vec2 *vertex;
    const vec2 *side;      /* unit outward normal of the side that starts at each vertex */
    const int32_t *corner; /* index in the outline of each vertex, -1 without */
    polygon outline;       /* of the whole shape */
    int32_t count;
    int32_t readable; /* vertices that may be read from `vertex` on, those of other pieces included; >= count */
    double half_height;
    double plan_radius; /* no vertex is farther from the axis */
    uint64_t seams;     /* bit k: side k is inside the compound */
    mat3 rotation;
    vec3 centre; /* of the shape's frame, in the common axes */
} prism;

/* cos of the angle between the axes of two prisms under which sides are clipped against sides: within it a side is
   always more opposed to a side than to top or bottom, and edge pairs add nothing that clipping does not find (their
   axes differ from a side's normal by the tilt, the depths by its product with the freeboard). */
#define NEARLY_LEVEL 0.98

/* How two prisms lie to one another. */
typedef enum meeting_kind {
    PRISMS_APART,    /* along axis by gap, farther than the slack */
    PRISMS_AT_SIDES, /* nearly level: side of the holder against the opposed side of the other */
    PRISMS_TILTED,   /* neither: the general way decides */
    PRISMS_BARRED    /* they meet along seams of compounds only */
} meeting_kind;

typedef struct prism_meeting {
    meeting_kind kind;
    bool swapped; /* the holder of the reference side is b */
    int32_t side, opposed;
    vec2 normal; /* of the side, holder's plan view, outward */
    vec3 axis;   /* from b to a */
    double gap;  /* [m] */
} prism_meeting;

/* Points of a meeting that is not apart; see prism_manifold. */
int prism_meeting_points(const prism *a, const prism *b, const prism_meeting *m, nearness near, polyhedron *a_room,
                         polyhedron *b_room, vec3 *normal, manifold_point out[4], vec3 *axis);

/* Like polyhedra_manifold; a_room, b_room: scratch with room for a piece of PIECE_MOST_VERTICES vertices. */
int prism_manifold(const prism *a, const prism *b, nearness near, polyhedron *a_room, polyhedron *b_room, vec3 *normal,
                   manifold_point out[4], vec3 *axis);

/* The prism as a polyhedron in the common axes; room must have been reserved by prism_polyhedron_reserve. Sides are
   faces 0 to n - 1, then top and bottom. */
void prism_polyhedron(const prism *p, polyhedron *room);
bool prism_polyhedron_reserve(context *ctx, polyhedron *room);

#endif
