/* What the vessel of a scenario cannot be, once its hull is known, and what a reader should be told of it before a run.
   One module with build_vessel, which asks before it makes anything. */
#ifndef SIM_VESSEL_CHECK_H
#define SIM_VESSEL_CHECK_H

#include "model/scenario_vessel.h"
#include "model/world.h"

/* FRAM_ERROR_INPUT with the key for a mass that sinks or is next to nothing, a centre of gravity far outside the hull,
   and radii of gyration that no mass in it has.  row: of the vessel in model and world. */
fram_status vessel_check(const scenario *s, const vessel_entry *entry, const model *m, int32_t row, fram_error *error);
/* Warnings to the log of a hull from a file in another unit, turned or moved: such a hull is refused for what follows
   from that, so they come before anything else. */
void vessel_mesh_warnings(context *ctx, const scenario *s, const vessel_entry *e, const model *of, int32_t row);
/* Warnings to the log: capsizing, a list or a trim at the start, a jump to the waterline, lines that pull it down or
   over, negative damping, springs and buoyancy too stiff for the step, a hull that reaches a wall.  w holds the vessel
   and its lines. */
fram_status vessel_warnings(context *ctx, const scenario *s, const vessel_entry *entry, const model *m, const world *w,
                            int32_t row, fram_error *error);

#endif
