/* Points hashed by cells, to find those within a fixed distance of a place: what joins vertices.  Inside geometry. */
#ifndef GEOMETRY_POINT_GRID_H
#define GEOMETRY_POINT_GRID_H

#include "geometry/mesh.h"

typedef struct point_grid {
    vec3 origin;
    double distance, cell;
    uint32_t mask;      /* buckets - 1 */
    int32_t *bucket;    /* the point added last, or -1 */
    int32_array before; /* of each point, the one added before it to its bucket, or -1 */
    ARRAY(vec3) point;
} point_grid;

/* A grid for up to about `expected` points inside `box`, asked for neighbours within `distance` >= 0 [m].  false: no
   memory. */
bool point_grid_init(context *ctx, point_grid *g, box3 box, double distance, int32_t expected);
void point_grid_free(context *ctx, point_grid *g);
/* The point of least number at most `distance` from p, or -1. */
int32_t point_grid_find(const point_grid *g, vec3 p);
/* Points are numbered in the order in which they are added. */
bool point_grid_add(context *ctx, point_grid *g, vec3 p);

#endif
