/* Lines plans: a hull's profile, waterlines and body plan with the water it floats in, its surface and its convex
   pieces, on one page as PNG. */
#ifndef IO_HULL_VIEW_H
#define IO_HULL_VIEW_H

#include "vessel/hydrostatics.h"

/* Most lines of text beside the drawing. */
enum { HULL_VIEW_LINES = 24 };

typedef struct hull_view {
    const mesh *surface;
    const polyhedron_array *pieces; /* may be empty */
    hull_attitude attitude;
    const hull_stability *stability;
    const char *title, *caption;
    const char *const *names;  /* of the table beside the body plan */
    const char *const *values; /* the same number */
    int lines;
} hull_view;

/* FRAM_ERROR_UNSUPPORTED without cairo. */
fram_status hull_view_write(context *ctx, const hull_view *view, const char *path, fram_error *error);

#endif
