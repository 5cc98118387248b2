/* One piece of a solid that is being cut into convex pieces, inside geometry: a closed part of the solid, its hull, and
   how far the one stays behind the other. */
#ifndef GEOMETRY_CONVEX_PIECE_H
#define GEOMETRY_CONVEX_PIECE_H

#include "geometry/polyhedron.h"

typedef struct plane3 {
    vec3 normal;
    double offset;
} plane3;

typedef struct convex_piece {
    mesh surface;
    mesh_adjacency adjacency;
    ARRAY(plane3) cuts; /* the planes that cut it out of the solid */
    polyhedron hull;
    /* Faces of the hull at surface vertex v: hull_face[start[v] .. start[v + 1]). */
    int32_array start, hull_face;
    double volume;    /* of the surface [m3] */
    double concavity; /* by convex_piece_measure [m] */
    vec3 deepest;     /* where */
    int32_t deepest_face;
} convex_piece;

typedef ARRAY(convex_piece) convex_piece_array;
typedef ARRAY(const polyhedron *) hull_list;

void convex_piece_free(context *ctx, convex_piece *p);
void convex_piece_array_free(context *ctx, convex_piece_array *a);

/* Adjacency, volume, hull with the faces on cuts told apart, and its faces at the vertices, of a piece whose surface
   and cuts are set.  small [m]: what is nearer than this counts as touching.  FRAM_ERROR_INPUT for a flat piece,
   FRAM_ERROR_MEMORY. */
fram_status convex_piece_complete(context *ctx, convex_piece *p, double small, fram_error *error);

/* Concavity: the largest distance of the surface, where the hull covers it, to the surface of the union of all hulls
   (p's own may be among them, those of bodies that p is a part of may not); an upper bound of it.  The smaller the
   others, the smaller it is. */
void convex_piece_measure(convex_piece *p, const hull_list *all, double small);

#endif
