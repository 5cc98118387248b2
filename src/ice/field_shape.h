/* Shapes of floes before they have a place: random convex polygons and templates. */
#ifndef ICE_FIELD_SHAPE_H
#define ICE_FIELD_SHAPE_H

#include "base/random.h"
#include "geometry/polygon.h"

enum { SHAPE_MOST_VERTICES = 64 };

typedef struct shape_law {
    int32_t least_vertices, most_vertices; /* 3 .. SHAPE_MOST_VERTICES */
    double elongation;                     /* longest axis ratio: drawn between 1 and this */
    const polygon_list *templates;         /* simple and counter-clockwise; NULL: random convex polygons */
} shape_law;

/* A shape whose area is that of a disc of `diameter` [m], about its centroid: a convex polygon with its corners on an
   ellipse at uneven angles, or one of the templates as it is but for its size.  out is replaced; false: no memory. */
bool shape_draw(context *ctx, const shape_law *law, double diameter, random_stream *r, vec2_array *out);

#endif
