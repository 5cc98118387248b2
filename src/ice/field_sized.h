/* Cells of given sizes: a power diagram whose weights and sites are moved until its cells have the areas that floes of
   a law of size need.  Knows outlines only. */
#ifndef ICE_FIELD_SIZED_H
#define ICE_FIELD_SIZED_H

#include "geometry/polygon.h"
#include "ice/field_size.h"

/* Random streams; the numbers are part of what a seed means and never change. */
enum { ICE_STREAM_SIZED = 0x1ce30 };

typedef struct sized_request {
    box2 domain;          /* [m] */
    bool periodic;        /* the cells go on beyond the edge as they begin at the other one */
    double concentration; /* of the floes that the cells are shrunk to */
    double corners;       /* part of the water that is cut off the corners, 0 to 1 */
    const size_law *law;  /* of the floes */
    uint64_t seed;
} sized_request;

/* Appends cells: convex, counter-clockwise, tiling the domain (periodic ones reach over its edge), such that
   cells_shrink makes floes of the law of them, whose areas are within about a per cent of those drawn on the mean.
   FRAM_ERROR_INPUT for a law that does not fit the domain or whose areas are missed by over two per cent on the mean,
   FRAM_ERROR_MEMORY. */
fram_status sized_cells(context *ctx, const sized_request *r, polygon_list *cells, fram_error *error);

#endif
