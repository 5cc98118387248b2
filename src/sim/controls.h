/* What a world can be told by name while it is stepped: one real number each, as series.h has one for each column.  The
   list follows from the world and never changes; vessels are named, lines and thrusters counted, as in the columns. */
#ifndef SIM_CONTROLS_H
#define SIM_CONTROLS_H

#include "base/array.h"
#include "model/scenario_vessel.h"
#include "model/world.h"

typedef enum control_role {
    CONTROL_WIND,
    CONTROL_CURRENT,
    CONTROL_DRIFT,
    CONTROL_FORCE,
    CONTROL_MOMENT,
    CONTROL_TOW,         /* velocity of a carriage or driven hull */
    CONTROL_SET_POINT,   /* of a free vessel */
    CONTROL_POSITIONING, /* 1: by the vessel's own controller */
    CONTROL_THRUST,
    CONTROL_ANGLE,
    CONTROL_RELEASE
} control_role;

typedef struct control {
    char name[VESSEL_NAME_MOST + 48]; /* of a list of vessels: "NAME.set_point_x" */
    const char *unit, *meaning;
    control_role role;
    int32_t which; /* row of the vessel, thruster or line */
    int32_t axis;  /* 0 x, 1 y, 2 z or heading */
} control;
typedef ARRAY(control) control_array;

/* false: no memory. */
bool controls_list(context *ctx, const scenario *s, const model *m, const world *w, control_array *out);
/* As it stands: what was told, or what holds without. */
double control_get(const model *m, const world *w, const control *c);
/* Takes effect in the next step.  FRAM_ERROR_INPUT, the control's name as key, for a number that cannot be;
   FRAM_ERROR_USAGE for an order to a thruster while the vessel's own controller gives the orders. */
fram_status control_set(context *ctx, const model *m, world *w, const control *c, double value, fram_error *error);

/* A path from where the vessel is now, in place of what it had: `count` places (x, y of the ship's origin, heading
   [m, m, rad]) at times that ascend from now on; 0: none, and a carriage goes on at the velocity that it has.  A free
   vessel's set point jumps to each place at its time; a path that another vessel cannot follow under the speed limit is
   refused, and so is any of a ship that drives itself and has no thrusters, or that has its place from lines and its
   heading from the ice. */
fram_status control_path(context *ctx, const model *m, world *w, int32_t vessel, const double *times,
                         const vec3 *places, int32_t count, fram_error *error);

#endif
