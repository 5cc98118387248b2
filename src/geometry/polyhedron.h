/* Convex polyhedra for collision: the convex pieces of a hull, of a tilted floe, of a wall.
   Faces are planes with their vertex loop, counter-clockwise seen from outside. */
#ifndef GEOMETRY_POLYHEDRON_H
#define GEOMETRY_POLYHEDRON_H

#include "geometry/mesh.h"

typedef struct polyhedron_face {
    vec3 normal;          /* unit, outward */
    double offset;        /* dot(normal, x) = offset on the face */
    int32_t first, count; /* loop[first .. first + count) */
    bool on_cut;          /* it lies in a plane along which the piece was cut from others: parts of it may be inside */
} polyhedron_face;

/* Faces with a common plane are one face, and no vertex is straight.  Loops begin at their least vertex.
   edge_direction lists the unit directions of edges for edge-edge axes, parallel ones once, either way round. */
typedef struct polyhedron {
    ARRAY(vec3) vertex;
    ARRAY(polyhedron_face) face;
    ARRAY(int32_t) loop;
    ARRAY(vec3) edge_direction;
    vec3 centre;   /* inside */
    double radius; /* farthest vertex from centre */
    double seam;   /* faces of the pieces that it was cut from lie this near to its own [m]; 0: it was not cut */
} polyhedron;

typedef ARRAY(polyhedron) polyhedron_array;

void polyhedron_free(context *ctx, polyhedron *p);
void polyhedron_array_free(context *ctx, polyhedron_array *a);
/* Move vertices, planes and centre. */
void polyhedron_translate(polyhedron *p, vec3 by);
/* `model` turned by r about its origin and moved by `centre`, in place of what out held; out's memory is used again.
   false: no memory. */
bool polyhedron_place(context *ctx, const polyhedron *model, mat3 r, vec3 centre, polyhedron *out);

/* Convex hull of points: quickhull with exact predicates.  Points that stand out less than `tolerance` [m] (at least
   the rounding of the coordinates) may be left outside, and triangles within it of a common plane are one face.  Its
   vertices are points, in the order of the points; the same points give the same bits.  What out held is dropped (it
   must be initialised); it is empty on failure.  FRAM_ERROR_INPUT: points not finite, or all within the tolerance of a
   plane; FRAM_ERROR_MEMORY. */
fram_status polyhedron_hull(context *ctx, const vec3 *point, int32_t count, double tolerance, polyhedron *out,
                            fram_error *error);
double polyhedron_volume(const polyhedron *p);
/* Not farther than `margin` [m] beyond the plane of any face. */
bool polyhedron_contains(const polyhedron *p, vec3 point, double margin);

/* Cut a closed mesh into convex pieces.  The deepest piece is cut by a plane across an axis through its deepest place,
   or along a side of a notch there, whichever leaves the hulls of the parts least to enclose in excess, until no piece
   is deeper than `tolerance` [m], there are `most` of them, or no plane helps.  Depth is the distance of the mesh,
   where the hull of its piece covers it, to the surface of the union of the hulls; concavity gets the largest that
   remains.  So no place of the mesh is deeper than that in the union, but a hole right through that is shallower than
   twice the tolerance is filled, and its lids may be farther from the mesh; inside it stays a few hundredths of the
   tolerance at most, which saves half of the faces.  Bodies that do not hang together are pieces of their own even
   beyond `most`; cavities are filled. What out held is dropped (it must be initialised); it is empty on failure.
   FRAM_ERROR_INPUT: open mesh, or without volume; FRAM_ERROR_MEMORY. */
fram_status mesh_convex_pieces(context *ctx, const mesh *m, double tolerance, int32_t most, polyhedron_array *out,
                               double *concavity, fram_error *error);

#endif
