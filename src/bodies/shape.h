/* Shapes of bodies.  A prism (floe, wall, box ship in benchmarks) is an outline extruded over
   -half_height <= z <= half_height about the centre of mass, cut into convex pieces; a solid (hull) is a closed mesh
   with convex pieces.  The body frame's origin is the centre of mass in both. Prisms are state (fracture makes and
   removes them) and live in tables; solids never change during a run: they belong to the model (model/model.h), and the
   store of a world refers to them. */
#ifndef BODIES_SHAPE_H
#define BODIES_SHAPE_H

#include "base/table.h"
#include "geometry/mesh.h"
#include "geometry/mesh_bvh.h"
#include "geometry/mesh_integrals.h"
#include "geometry/overlay.h"
#include "geometry/polyhedron.h"

typedef enum shape_kind { SHAPE_NONE = 0, SHAPE_PRISM, SHAPE_SOLID } shape_kind;

#define SHAPE_FIELDS(X)                                                                                     \
    X(kind, uint8_t, FIELD_U8, 1, "1", "enum shape_kind; none: free row")                                   \
    X(half_height, double, FIELD_F64, 1, "m", "prism: half its thickness")                                  \
    X(radius, double, FIELD_F64, 1, "m", "bounding radius about the centre of mass")                        \
    X(plan_radius, double, FIELD_F64, 1, "m", "prism: largest distance of an outline vertex from the axis") \
    X(area, double, FIELD_F64, 1, "m2", "prism: area of the outline")                                       \
    X(outline_first, int32_t, FIELD_I32, 1, "1", "prism: first vertex of the outline in the vertex pool")   \
    X(outline_count, int32_t, FIELD_I32, 1, "1", "prism: vertices of the outline")                          \
    X(piece_first, int32_t, FIELD_I32, 1, "1", "prism: first row of its convex pieces in the piece table")  \
    X(piece_count, int32_t, FIELD_I32, 1, "1", "prism: number of convex pieces, 1 when convex")             \
    X(solid, int32_t, FIELD_I32, 1, "1", "solid: index of the solid, -1 otherwise")
TABLE_DECLARE(shape, SHAPE_FIELDS)

/* The outline is itself piece 0 when it is convex; pieces then share its vertices. */
#define PIECE_FIELDS(X)                                                          \
    X(first, int32_t, FIELD_I32, 1, "1", "first vertex in the vertex pool")      \
    X(size, int32_t, FIELD_I32, 1, "1", "number of vertices, counter-clockwise") \
    X(inner_edges, uint64_t, FIELD_U64, 1, "1", "bit k: edge k is a seam inside the compound, not a face")
TABLE_DECLARE(piece, PIECE_FIELDS)

#define SHAPE_VERTEX_FIELDS(X)                                                                                   \
    X(point, vec2, FIELD_F64, 2, "m", "body frame, plan view")                                                   \
    X(side, vec2, FIELD_F64, 2, "1", "unit outward normal of the side from here to the next vertex of the ring") \
    X(corner, int32_t, FIELD_I32, 1, "1", "index in the shape's outline; -1: a point that the outline does not have")
TABLE_DECLARE(shape_vertex, SHAPE_VERTEX_FIELDS)

/* A closed mesh with what contact and fluid need of it, all in the body frame. */
typedef struct solid {
    mesh surface;
    mesh_adjacency adjacency;
    mesh_bvh tree;
    mesh_integrals integrals;
    polyhedron_array pieces;
    double concavity; /* largest distance of the mesh to its pieces [m] */
    double radius;    /* bounding radius about the origin [m] */
} solid;

typedef ARRAY(solid) solid_array;
void solid_array_free(context *ctx, solid_array *solids);

typedef struct shape_store {
    shape_table shapes;
    piece_table pieces;
    shape_vertex_table vertices;
    const solid_array *solids; /* lent, not state; NULL: none */
    uint64_t changes;          /* shapes that came or went since the store was made; no state */
    /* What living prisms have in the pools, no state either: once counted, it follows what comes and goes.  Whoever
       gives the tables another content says that it is not counted. */
    int32_t live_vertices, live_pieces;
    bool is_counted;
} shape_store;

void shape_store_free(context *ctx, shape_store *s);

enum { PIECE_MOST_VERTICES = 16 };

/* A prism of a simple outline given about its centroid (the caller moves it there), cut into convex pieces of at most
   PIECE_MOST_VERTICES vertices through `o` (may be NULL when the outline is convex).  piece_area_limit [m2]: smaller
   triangles are dropped (docs/theory.md, Ice fields).  row gets the shape's row.  The outline may be one of this store.
   FRAM_ERROR_INPUT: fewer than 3 vertices, no area, not finite, no thickness, or a concave outline without `o`; the
   store is then unchanged, as it is without memory. */
fram_status shape_add_prism(context *ctx, shape_store *s, overlay *o, polygon outline, double half_height,
                            double piece_area_limit, int32_t *row, fram_error *error);
/* A shape that refers to one of the store's solids; FRAM_ERROR_USAGE when it is not there. */
fram_status shape_add_solid(context *ctx, shape_store *s, int32_t solid_index, int32_t *row, fram_error *error);
/* Builds tree, integrals, adjacency, radius and takes over surface and pieces (moved out of the caller's objects, which
   are then empty; left to the caller on failure).  FRAM_ERROR_INPUT for a mesh without triangles. */
fram_status solid_add(context *ctx, solid_array *solids, mesh *surface, polyhedron_array *pieces, double concavity,
                      int32_t *index, fram_error *error);
void shape_remove(shape_store *s, int32_t row);
/* Squeeze the pools when the dead vertices are more than a quarter of the living; rows keep their numbers.  Depends on
   state only. */
fram_status shape_compact(context *ctx, shape_store *s);

polygon shape_outline(const shape_store *s, int32_t row);
/* The solid of a shape that is one. */
const solid *shape_solid(const shape_store *s, int32_t row);
polygon shape_piece(const shape_store *s, int32_t row, int32_t piece);

#endif
