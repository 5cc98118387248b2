/* From a scenario to a world: the settings of a step, the hull, walls, vessel and ice. */
#ifndef SIM_BUILD_H
#define SIM_BUILD_H

#include "model/scenario.h"
#include "sim/draw_ice.h"
#include "sim/step.h"

/* What every step needs to know. */
step_settings build_settings(const scenario *s);

/* What was made, for the log. */
typedef struct build_report {
    field_report field;
    double displaced_mass; /* of the hull at its draught [kg] */
} build_report;

/* A new world at time 0.  Errors name the key at fault. */
fram_status build_world(context *ctx, const scenario *s, world *w, build_report *report, fram_error *error);
/* A new world with its solids and empty tables, into which a checkpoint is read. */
fram_status build_empty_world(context *ctx, const scenario *s, world *w, fram_error *error);

/* The ice alone, as outlines, to look at: the same as of build_world; under domain.boundary: feeding the whole tile.
   domain: what it was made in.  out must be empty; on failure it may hold some. */
fram_status build_outlines(context *ctx, const scenario *s, drawn_ice *out, box2 *domain, fram_error *error);

#endif
