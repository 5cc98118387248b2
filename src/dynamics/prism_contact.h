/* Contact of two prisms: separating axes in plan view with the exact heights, clipping of the side faces while the two
   are nearly level to one another, and the general way otherwise.  Inside dynamics. */
#ifndef DYNAMICS_PRISM_CONTACT_H
#define DYNAMICS_PRISM_CONTACT_H

#include "dynamics/manifold.h"

/* One convex piece of a prism shape, placed. */
typedef struct prism {
    const vec2 *vertex;
    const int32_t *corner; /* index in the outline of each vertex, -1 without */
    polygon outline;       /* of the whole shape */
    int32_t count;
    double half_height;
    uint64_t seams; /* bit k: side k is inside the compound */
    mat3 rotation;
    vec3 centre; /* of the shape's frame, in the common axes */
} prism;

/* Like polyhedra_manifold_masked; a_room, b_room: scratch with room for a piece of PIECE_MOST_VERTICES vertices. */
int prism_manifold(const prism *a, const prism *b, nearness near, polyhedron *a_room, polyhedron *b_room, vec3 *normal,
                   manifold_point out[4], vec3 *axis);

/* The prism as a polyhedron in the common axes; room must have been reserved by prism_polyhedron_reserve. Sides are
   faces 0 to n - 1, then top and bottom. */
void prism_polyhedron(const prism *p, polyhedron *room);
bool prism_polyhedron_reserve(context *ctx, polyhedron *room);

#endif
