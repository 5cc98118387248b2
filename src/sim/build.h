/* From a scenario to a world: walls, vessels and ice, by the scenario's model (build_model.h). */
#ifndef SIM_BUILD_H
#define SIM_BUILD_H

#include "ice/field.h"
#include "model/world.h"
#include "sim/build_model.h"
#include "sim/draw_ice.h"

/* A new world at time 0, of the model that build_model makes of the same scenario.  report: of the ice that was made.
   Errors name the key at fault. */
fram_status build_world(context *ctx, const scenario *s, const model *m, world *w, field_report *report,
                        fram_error *error);

/* The same in two: what stands before the ice, and then the ice, which may take long.  Without success there is no
   world any more. */
fram_status build_world_begin(context *ctx, const scenario *s, const model *m, world *w, fram_error *error);
fram_status build_world_ice(context *ctx, const scenario *s, const model *m, world *w, field_report *report,
                            fram_error *error);

/* Looks at what was made of a scenario: at its world before the first step, or at a part of that. */
typedef void (*build_look)(context *ctx, const scenario *s, const model *m, const world *made);

/* The vessels and their stations alone, and floes that are listed, as build_world makes them, and then nothing of it:
   for what cannot be, a hull in a band that is given too, and for the warnings in the log.  store: of hulls, may be
   NULL (build_hull.h).  look: at that world, which holds no other ice; NULL: none. */
fram_status build_check(context *ctx, const scenario *s, hull_store *store, build_look look, fram_error *error);

/* The ice alone, as outlines, to look at: the same as of build_world; under domain.boundary: feeding the whole tile,
   without the cuts of vessels and zones without ice, whose file is read all the same.  domain: what it was made in.
   out must be empty; on failure it may hold some. */
fram_status build_outlines(context *ctx, const scenario *s, drawn_ice *out, box2 *domain, fram_error *error);

/* Room for the loads on so many vessels over output.averaging_window. */
fram_status build_load_window(context *ctx, const scenario *s, int32_t vessels, world *w, fram_error *error);

#endif
