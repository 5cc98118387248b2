/* The connected parts of a surface, inside geometry: bodies, cavities, loose pieces after a cut. */
#ifndef GEOMETRY_MESH_PARTS_H
#define GEOMETRY_MESH_PARTS_H

#include "geometry/mesh.h"

typedef struct mesh_part {
    int32_t first_face; /* the least */
    int32_t face_count;
    double volume; /* signed [m3] */
    box3 box;
} mesh_part;

/* Parts in the order of their least faces. */
typedef struct mesh_parts {
    int32_array of_face; /* the part of each face */
    ARRAY(mesh_part) part;
} mesh_parts;

fram_status mesh_parts_build(context *ctx, const mesh *m, const mesh_adjacency *adjacency, mesh_parts *out);
void mesh_parts_free(context *ctx, mesh_parts *p);
/* The surface of one part, with vertices of its own in the order of m; what out held is dropped.  false: no memory. */
bool mesh_copy_part(context *ctx, const mesh *m, const mesh_parts *p, int32_t part, mesh *out);
/* The first part of a closed mesh that is turned the wrong way, or -1.  nested false: a part in the open without
   positive volume; nested true: a part inside others with positive volume, where only a cavity can be (asked of
   surfaces that do not cross). */
int32_t mesh_parts_first_inverted(const mesh *m, const mesh_parts *p, bool nested);

#endif
