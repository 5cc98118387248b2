/* Water that runs over ice which is pressed under.  The upper face of a floe that goes under the water plane faster
   than water runs over its edges stays dry (ventilated), and nothing presses on it from above; docs/decisions/0340.

   Over each edge under the water plane water comes at the critical discharge of its depth d, q = (8/27) sqrt(g) d^1.5 a
   width, which is that of a broken dam at the dam, at any time (Ritter 1892), and it lies at rest where the face is
   deepest, up to a level of its own.  The face feels the pressure under that level.  Once there is as much water as the
   room between face and water plane holds, the load is that of hydrostatics; a face that is then wholly under water is
   drowned, and stays so until a part of it comes out.

   State, a row a body slot, where ventilation is wanted.  Inside fluid, but for the table. */
#ifndef FLUID_FLOODING_H
#define FLUID_FLOODING_H

#include "base/table.h"
#include "bodies/body.h"
#include "fluid/media.h"
#include "geometry/polygon.h"

/* Which cap looks up. */
typedef enum flooding_face { FLOODING_NONE = 0, FLOODING_TOP, FLOODING_BOTTOM } flooding_face;

#define FLOODING_FIELDS(X)                                                                          \
    X(generation, uint32_t, FIELD_U32, 1, "1", "of the body whose upper face is followed; 0: none") \
    X(water, double, FIELD_F64, 1, "m3", "over the upper face, as much as had come with this step") \
    X(face, uint8_t, FIELD_U8, 1, "1", "enum flooding_face: the one that water is over")            \
    X(drowned, uint8_t, FIELD_U8, 1, "1", "1: the face is wholly under water, and was flooded once")
TABLE_DECLARE(flooding, FLOODING_FIELDS)

/* A row's columns but for its body. */
typedef struct flooding_state {
    double water;
    flooding_face face; /* none: a body that was not seen before; its face is taken for flooded */
    bool drowned;
} flooding_state;

/* The discharge over a straight edge whose ends are at two depths (0 or more) under the water plane [m], by its width
   in plan [m]: the integral of (8/27) sqrt(g) d^1.5 over it [m3/s]. */
double flooding_discharge(double gravity, double depth_a, double depth_b, double width);

/* What comes on top of the hydrostatic load of a prism because its upper face is not flooded, global frame, moment
   about the centre of mass, which is at a height over still water [m]; nothing where it is.  Leads the state on by a
   time step. */
wrench flooding_advance(const media *m, polygon outline, double half_height, const mat3 *rotation, double height,
                        double time_step, flooding_state *state);

#endif
