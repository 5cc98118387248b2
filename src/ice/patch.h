/* The geometry of crushing patches (docs/decisions/0010): the connected components of a triangle surface inside a
   floe's prism, all in the floe's own frame.  Knows no bodies, no materials and no forces. */
#ifndef ICE_PATCH_H
#define ICE_PATCH_H

#include "bodies/shape.h"
#include "ice/prism_faces.h"

/* A closed surface in the coordinates of its body, and the way from there into the floe's frame:
   r_floe = rotation r_surface + offset. */
typedef struct patch_surface {
    const mesh *surface;
    const mesh_adjacency *adjacency;
    const mesh_bvh *tree;     /* may be NULL for a surface of few triangles: all of them are looked at */
    const prism_faces *faces; /* of a prism, without a tree: looked at instead of triangles; may be NULL */
    mat3 rotation;
    vec3 offset;
    int32_t prism; /* shape whose surface it is when that is a prism, of the floe's store; -1: any other */
    /* Its velocity past the floe, floe frame: slip + turn x r [m/s, rad/s]; below `rest` it has no direction [m/s]. */
    vec3 slip, turn;
    double rest;
    bool rough_way; /* ways at the centroids of parts alone */
} patch_surface;

/* The floe: a prism shape of the store, about its centre of mass. */
typedef struct patch_floe {
    const shape_store *shapes;
    int32_t shape;
} patch_floe;

/* One connected component of the surface inside the floe, floe frame. */
typedef struct patch_component {
    vec3 area;      /* sum of area vectors N, outward of the surface [m2] */
    double surface; /* sum of areas, at least |N| [m2] */
    vec3 centre;    /* area-weighted centroid [m] */
    sym3 spread;    /* mean of (r - centre)(r - centre)^T over the area [m2] */
    double way;     /* mean way of the overlap along N, see patch_components [m] */
    box2 plan;      /* bounds in the floe's plane [m] */
    bool slides;    /* beside something of the same patch that goes into the ice */
    double beside;  /* area along N of the rest of its patch, which moves otherwise [m2] */
} patch_component;
typedef ARRAY(patch_component) patch_component_array;

typedef struct patch_scratch patch_scratch;
patch_scratch *patch_scratch_create(context *ctx);
void patch_scratch_free(context *ctx, patch_scratch *s);

/* The components, ordered by their least face (of a prism, else triangle), made anew in *out (which lives in the
   scratch).  Faces are clipped by every convex piece of the floe; one that lies in a face of a piece belongs to the
   piece in front of it, so that a surface on a seam counts once and one that just touches the floe counts as touching.
   Clipped parts are connected through a seam that one face crosses, and through an edge inside a piece; where it goes
   into the ice it crushes, where it slides along or leaves it does not, and what does is never one component with what
   does not.  The result does not depend on how floe or surface are cut, to rounding.  false: no memory.

   way is how far the floe has to go along N, on the mean over the patch, until the overlap is gone: the volume that the
   component cuts off the floe over |N|.  The volume is the sum over the parts of their area along N times the way from
   there along -N out of the floe.  Of a prism's surface only parts that face N count, with the way out of floe and
   prism, whichever is shorter; of any other surface those that face away count against the others.  Volume and N are
   continuous in the pose of convex bodies, and so is their quotient while the area vectors do not cancel; it is never
   more than the floe's diameter.  The way is taken at the centroids of triangles about the centroid of each part: exact
   where it is linear over them; with rough_way at the centroid of the part: exact where it is linear over that. */
bool patch_components(context *ctx, patch_scratch *s, const patch_surface *surface, const patch_floe *floe,
                      const patch_component_array **out);

/* Area vector of what is left of a component of the last patch_components when the floe's edge gives by this much along
   the floe's z, < 0: down [m]: an edge that goes down leaves the surface above it first, one that goes up the surface
   below it.  What comes in at the other face instead is left out. */
vec3 patch_area_left(const patch_scratch *s, const patch_floe *floe, int32_t component, double give);
/* The same component with the area, surface, centre and spread of what is left, which may be nothing; way and plan stay
   those of the whole. */
patch_component patch_left(const patch_scratch *s, const patch_floe *floe, int32_t component, double give);

/* Length of the way from `point` along the unit `direction` (floe frame) out of the floe, across seams; 0 for a point
   outside [m].  false: no memory. */
bool patch_way_out(context *ctx, patch_scratch *s, const patch_floe *floe, vec3 point, vec3 direction, double *way);

/* A point inside the floe, in its frame. */
vec3 patch_inner_point(const patch_floe *floe);

/* Area of the section of the surface with the floe's top plane inside the floe's outline [m2] (the reference's A_I). */
fram_status patch_top_area(context *ctx, patch_scratch *s, const patch_surface *surface, const patch_floe *floe,
                           double *area, fram_error *error);

#endif
