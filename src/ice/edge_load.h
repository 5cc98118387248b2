/* Loads as the edge of a floe feels them: means over the time in which it responds.  Ice cannot bend faster than it and
   the water under it are moved; a collision of a few milliseconds gives the edge a velocity and no curvature.  State of
   fracture (ice/fracture.h); docs/decisions/0176. */
#ifndef ICE_EDGE_LOAD_H
#define ICE_EDGE_LOAD_H

#include "base/table.h"
#include "base/vec.h"

/* A row for each patch on a floe that floats: what the ice under it has felt so far. */
#define EDGE_LOAD_FIELDS(X)                                                     \
    X(floe, int32_t, FIELD_I32, 1, "1", "running number of the floe")           \
    X(surface, int32_t, FIELD_I32, 1, "1", "slot of the body that pushes")      \
    X(generation, uint32_t, FIELD_U32, 1, "1", "of that body")                  \
    X(place, vec2, FIELD_F64, 2, "m", "middle of the patch, frame of the floe") \
    X(load, vec3, FIELD_F64, 3, "N", "mean over the time of response, frame of the floe")
TABLE_DECLARE(edge_load, EDGE_LOAD_FIELDS)

/* What decides whether an edge breaks. */
typedef enum edge_load_rule {
    EDGE_LOAD_STEP = 0, /* the impulse of a step over the step: the reference */
    EDGE_LOAD_RESPONSE  /* of floes that float: its mean over the time in which the edge responds */
} edge_load_rule;

#endif
