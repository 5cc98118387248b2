/* Convex polyhedra for collision: the convex pieces of a hull, of a tilted floe, of a wall.
   Faces are planes with their vertex loop, counter-clockwise seen from outside. */
#ifndef GEOMETRY_POLYHEDRON_H
#define GEOMETRY_POLYHEDRON_H

#include "geometry/mesh.h"

typedef struct polyhedron_face {
    vec3 normal;   /* unit, outward */
    double offset; /* dot(normal, x) = offset on the face */
    int32_t first, count; /* loop[first .. first + count) */
} polyhedron_face;

/* Faces with a common plane are one face. edges holds each edge once (vertex pairs), for edge-edge axes;
   edge_direction lists unit directions, parallel ones once. */
typedef struct polyhedron {
    ARRAY(vec3) vertex;
    ARRAY(polyhedron_face) face;
    ARRAY(int32_t) loop;
    ARRAY(vec3) edge_direction;
    vec3 centre;   /* inside */
    double radius; /* farthest vertex from centre */
} polyhedron;

typedef ARRAY(polyhedron) polyhedron_array;

void polyhedron_free(context *ctx, polyhedron *p);
void polyhedron_array_free(context *ctx, polyhedron_array *a);
/* Convex hull of points (incremental, coplanar faces merged within `tolerance` [m]).  FRAM_ERROR_INPUT for flat
   input. */
fram_status polyhedron_hull(context *ctx, const vec3 *point, int32_t count, double tolerance, polyhedron *out,
                            fram_error *error);
/* The prism of a convex outline between two heights. */
fram_status polyhedron_prism(context *ctx, polygon outline, double bottom, double top, polyhedron *out,
                             fram_error *error);
/* Move every vertex, plane and the centre; translate.c. */
void polyhedron_translate(polyhedron *p, vec3 by);
double polyhedron_volume(const polyhedron *p);
bool polyhedron_contains(const polyhedron *p, vec3 point, double margin);

/* Cut a closed mesh into convex pieces: cuts by planes across the longest axis where the concavity (largest distance of
   the mesh to the piece's hull) exceeds `tolerance` [m], until it does not or `most` pieces are reached.  concavity
   gets the largest distance of the mesh's vertices to the union's surface that remains. */
fram_status mesh_convex_pieces(context *ctx, const mesh *m, double tolerance, int32_t most, polyhedron_array *out,
                               double *concavity, fram_error *error);

#endif
