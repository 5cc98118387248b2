/* Drag of level floes that is held from one step to the next.  A floe that drifts meets the water and the air almost as
   it did a step ago, in its own axes, so its drag there is almost what it was: it is computed anew only when its motion
   through a medium, or the waterline on it, has changed by more than a small part (docs/decisions/0160-held-drag.md).
   Hydrostatics are computed in every step.  State: a run that is resumed goes on with what was held.
   A row holds eight body slots, one in each lane.  Inside fluid, but for the table. */
#ifndef FLUID_HELD_DRAG_H
#define FLUID_HELD_DRAG_H

#include "base/table.h"
#include "bodies/body.h"

/* Slots of a row. */
enum { HELD_LANES = 8 };

/* Changes up to which drag is held.  Of a motion: its distance from a multiple of the held one, over its size, both
   with angular velocities times the outline's radius; in air, which weighs a thousandth, over that of the faster of
   both motions.  Held drag is then within 1.5e-3 of the drag at the floe's largest speed (tests/fluid/test_held_drag.c;
   no motion can exceed 2 sqrt(2) 1e-3, since a point's velocity is at most sqrt(2) of it apart and drag goes with the
   square), which with the quadrature of a convex outline leaves 3e-3 (fluid.h). */
#define HELD_MOTION 1e-3
/* Of the waterline's height anywhere on the sides, over half the floe's thickness: a thousandth of the sides' drag. */
#define HELD_LINE 1e-3
/* Motions slower than this count as none, over the root of gravity times half the thickness: what it leaves is less
   than 1e-8 of gravity as an acceleration. */
#define HELD_STILL 1e-6

typedef struct held_generations {
    uint32_t lane[HELD_LANES];
} held_generations;

typedef struct held_numbers {
    double lane[HELD_LANES];
} held_numbers;

typedef struct held_vectors {
    double x[HELD_LANES], y[HELD_LANES], z[HELD_LANES];
} held_vectors;

/* Integrals over the outline of 1, x, y, x^2, y^2 and x y. */
typedef struct held_moments {
    double area[HELD_LANES], x[HELD_LANES], y[HELD_LANES], xx[HELD_LANES], yy[HELD_LANES], xy[HELD_LANES];
} held_moments;

#define HELD_DRAG_FIELDS(X)                                                                                         \
    X(generation, held_generations, FIELD_U32, 8, "1", "of the body whose drag is held; 0: none")                   \
    X(half, held_numbers, FIELD_F64, 8, "m", "half the thickness")                                                  \
    X(reach, held_numbers, FIELD_F64, 8, "m", "largest distance of an outline vertex from the axis")                \
    X(moments, held_moments, FIELD_F64, 48, "m2 to m4", "of the outline about the axis: 1, x, y, xx, yy, xy")       \
    X(line, held_vectors, FIELD_F64, 24, "m, 1", "waterline on the floe: height at the axis, slopes along x and y") \
    X(spin, held_vectors, FIELD_F64, 24, "rad/s", "angular velocity, body axes, as all that follows")               \
    X(through_water, held_vectors, FIELD_F64, 24, "m/s", "velocity relative to the water")                          \
    X(through_air, held_vectors, FIELD_F64, 24, "m/s", "velocity relative to the air")                              \
    X(water_force, held_vectors, FIELD_F64, 24, "N", "drag of the water")                                           \
    X(water_moment, held_vectors, FIELD_F64, 24, "N m", "about the centre of mass")                                 \
    X(air_force, held_vectors, FIELD_F64, 24, "N", "drag of the air")                                               \
    X(air_moment, held_vectors, FIELD_F64, 24, "N m", "about the centre of mass")
TABLE_DECLARE(held_drag, HELD_DRAG_FIELDS)

/* Rows for the slots of a body table. */
static inline int32_t held_drag_rows(int32_t slots) { return slots / HELD_LANES + (slots % HELD_LANES != 0); }

#endif
