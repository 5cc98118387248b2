/* The faces of a prism's surface as convex polygons: sides whole, lids in as few as come of joining their triangles.
   What is clipped and connected by the face is so by fewer of them.  Knows the mesh of mesh_make_prism alone. */
#ifndef ICE_PRISM_FACES_H
#define ICE_PRISM_FACES_H

#include "geometry/mesh.h"

/* Corners of a face at most. */
enum { PRISM_FACE_MOST_CORNERS = 16 };

/* Face f has the corners first[f] to first[f + 1] - 1, counter-clockwise seen from outside. */
typedef struct prism_faces {
    int32_array first;
    int32_array corner;    /* vertices of the mesh */
    int32_array neighbour; /* face across the edge from a corner to the next */
} prism_faces;
void prism_faces_free(context *ctx, prism_faces *f);

/* Lids first, bottom and top in turn, then sides.  Time grows with the square of the number of vertices.  false: no
   memory. */
bool prism_faces_make(context *ctx, const mesh *surface, prism_faces *out);

static inline int32_t prism_faces_count(const prism_faces *f) { return f->first.count - 1; }

#endif
