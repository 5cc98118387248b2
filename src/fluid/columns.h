/* The water of the benchmark scenes (bench/peers/scene.h, sc_water): one vertical column for each sector between an
   edge and the centre of a floe; Archimedes on the submerged height, quadratic form and skin drag.  Coarser than
   fluid.h, and the same in every program of the comparison: not for simulations.  Knows nothing of contacts, ice or
   ships. */
#ifndef FLUID_COLUMNS_H
#define FLUID_COLUMNS_H

#include "bodies/body.h"
#include "bodies/shape.h"

typedef struct column_medium {
    double gravity, water_density;
    vec2 current;
    double form_drag, skin_drag;
} column_medium;

/* The sectors of every dynamic prism, laid out for eight bodies at a time.  Made once; good as long as no body is
   made, removed or given another shape. */
typedef struct column_water {
    column_medium medium;
    int32_t slots;     /* of the body table */
    int32_array first; /* of each group of eight slots: its first row; one more entry at the end */
    /* One row per column number k and group: sector k of each of its bodies, zero where a body has no such sector. */
    ARRAY(double) area, x, y;     /* [m2], [m] body frame; eight a row */
    ARRAY(double) thickness, rim; /* eight a group: [m]; share of the rim of one column, perimeter / (pi sides) [m] */
    ARRAY(double) sides;          /* eight a group */
} column_water;

/* FRAM_ERROR_USAGE for a dynamic body without a convex prism. */
fram_status column_water_make(context *ctx, const column_medium *medium, const body_table *bodies,
                              const shape_store *shapes, column_water *out, fram_error *error);
void column_water_free(context *ctx, column_water *w);

/* Water and weight on every dynamic body, written to loads[slot]; others get zero.  Parallel over blocks of slots. */
void column_water_apply(context *ctx, const column_water *w, const body_table *bodies, wrench *loads);

#endif
