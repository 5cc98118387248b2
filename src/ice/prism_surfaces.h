/* Surfaces of prism bodies as closed triangle meshes, kept while their shapes stay as they are: what a surface is
   depends on outline and height alone, so that what is kept never changes a result.  Knows no bodies and no patches. */
#ifndef ICE_PRISM_SURFACES_H
#define ICE_PRISM_SURFACES_H

#include "bodies/shape.h"
#include "ice/prism_faces.h"

typedef struct prism_surface {
    vec2_array outline; /* and height, which it was made of */
    double half_height;
    mesh surface;
    mesh_adjacency adjacency;
    mesh_bvh tree;     /* empty for few triangles */
    prism_faces faces; /* empty for many */
    bool has_tree;
} prism_surface;

typedef struct prism_surfaces {
    int32_array place; /* of each row of shapes: its surface, -1: none */
    ARRAY(prism_surface) kept;
    int32_t used; /* of those */
} prism_surfaces;

void prism_surfaces_free(context *ctx, prism_surfaces *s);

/* Forgets what is kept when that is much: before the first of a step. */
void prism_surfaces_begin(prism_surfaces *s);

/* The surface of the prism in a row of shapes, which is good until the next call.  FRAM_ERROR_INPUT as
   mesh_make_prism. */
fram_status prism_surfaces_get(context *ctx, prism_surfaces *s, const shape_store *shapes, int32_t row,
                               const prism_surface **out, fram_error *error);

/* The surface that prism_surfaces_get gave last for a row whose shape is the same still, for several threads at once;
   NULL where none is kept any more. */
const prism_surface *prism_surfaces_find(const prism_surfaces *s, int32_t row);

#endif
