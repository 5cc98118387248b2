/* The overlay's handle and its way to GEOS and back, for the overlay files alone. One module with overlay, whose inside
   this is. */
#ifndef GEOMETRY_OVERLAY_GEOS_H
#define GEOMETRY_OVERLAY_GEOS_H

#include "geometry/overlay.h"
#include <geos_c.h>

struct overlay {
    context *ctx;
    GEOSContextHandle_t geos;
    char message[256];   /* what GEOS said last */
    vec2_array ring;     /* scratch: a closed ring on its way to GEOS or back */
    polygon_list rings;  /* scratch: outline and holes of one polygon */
    polygon_list pieces; /* of a polygon whose holes were cut open */
    polygon_list found;  /* the rings of a result, in normal form, before they are sorted */
};

/* FRAM_ERROR_INPUT unless p is valid; role ("the clip") is what the message calls it. */
fram_status overlay_check(overlay *o, polygon p, const char *role, fram_error *error);
/* The status for a NULL from GEOS, which could not do `what` ("read a polygon"). */
fram_status geos_failed(overlay *o, const char *what, fram_error *error);
/* A GEOS polygon of a ring of at least 3 vertices, or NULL with *status set. */
GEOSGeometry *shape_of_ring(overlay *o, polygon p, fram_status *status, fram_error *error);
/* Add the polygon of the scratch rings, the outline and then its holes, cut open, to the found rings, without pieces
   thinner than rounding. */
fram_status cut_rings(overlay *o, fram_error *error);
/* Add the polygons of any geometry, whatever it nests, to the found rings; holes are filled or cut open. */
fram_status read_shape(overlay *o, const GEOSGeometry *shape, bool fill_holes, fram_error *error);
/* Append the found rings to out in order. */
fram_status append_found(overlay *o, polygon_list *out, fram_error *error);
/* Append the polygons of a result, which is freed; NULL is a failure of GEOS. */
fram_status take_shape(overlay *o, GEOSGeometry *shape, const char *what, polygon_list *out, fram_error *error);
/* Append the union of valid rings, at least one. */
fram_status unite(overlay *o, const polygon_list *parts, polygon_list *out, fram_error *error);

#endif
