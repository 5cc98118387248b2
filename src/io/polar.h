/* A polar chart in the manner of capability plots: bow up, directions clockwise from it, coloured cells and closed
   curves over direction and radius; as PNG or SVG. */
#ifndef IO_POLAR_H
#define IO_POLAR_H

#include "io/text_buffer.h"

typedef struct polar_curve {
    const char *name;
    const double *radius; /* by direction */
    bool dashed;
} polar_curve;

typedef struct polar_chart {
    const char *title, *subtitle;
    const char *radius_label; /* with unit */
    const char *value_label;  /* of the cells */
    int32_t directions;       /* evenly round, from the bow on, clockwise */
    int32_t rings;
    double ring_step;    /* the cell of ring k ends at the radius (k + 1) ring_step */
    const double *value; /* [direction * rings + k]: 0 to 1 by colour, beyond 1 grey */
    const polar_curve *curves;
    int32_t curve_count;
    const char *const *outer; /* a word outside each direction, or NULL; "": none */
    const char *text;         /* lines beside the chart, each ended by a newline */
} polar_chart;

/* SVG when the path ends in .svg, else PNG.  FRAM_ERROR_UNSUPPORTED without cairo. */
fram_status polar_write(context *ctx, const polar_chart *p, const char *path, fram_error *error);

#endif
