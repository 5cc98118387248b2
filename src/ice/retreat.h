/* How far hulls have drawn back from the ice that they had crushed: for each floe and each hull, for one hull does not
   draw another back.  State of fracture_trim.c; docs/decisions/0041.

   The way of the first hull (row 0 of its table) stands in the floe's own row, a column that every world has; those of
   further hulls have a row here while they are not zero and their floe is there. */
#ifndef ICE_RETREAT_H
#define ICE_RETREAT_H

#include "bodies/body.h"
#include "ice/floe.h"

/* Rows ascend by floe, then by surface. */
#define HULL_RETREAT_FIELDS(X)                                          \
    X(floe, int32_t, FIELD_I32, 1, "1", "row of the floe")              \
    X(number, int32_t, FIELD_I32, 1, "1", "running number of the floe") \
    X(surface, int32_t, FIELD_I32, 1, "1", "slot of the hull's body")   \
    X(way, vec3, FIELD_F64, 3, "m", "of the hull in the floe since it last pressed on, global frame")
TABLE_DECLARE(hull_retreat, HULL_RETREAT_FIELDS)

/* The way of a hull in a floe [m]; zero where nothing is kept. */
vec3 retreat_find(const hull_retreat_table *t, const body_table *bodies, const floe_table *floes, int32_t floe,
                  int32_t surface);
/* Keeps it; the cost is that of a search by halves, and a shift of rows where a hull begins to draw back.  false: no
   memory. */
bool retreat_keep(context *ctx, hull_retreat_table *t, const body_table *bodies, floe_table *floes, int32_t floe,
                  int32_t surface, vec3 way);
/* Rows of floes that are gone, and of ways that are zero, go.  Once a step; false: no memory. */
bool retreat_sweep(context *ctx, hull_retreat_table *t, const floe_table *floes);

#endif
