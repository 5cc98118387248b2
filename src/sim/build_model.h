/* From a scenario to the model: method, media, hulls and what is fixed of each vessel. */
#ifndef SIM_BUILD_MODEL_H
#define SIM_BUILD_MODEL_H

#include "model/model.h"
#include "model/scenario_vessel.h"
#include "sim/build_hull.h"
#include "sim/ice_kinds.h"

/* The model of a scenario, with its vessels.  Errors name the key at fault, or place and element of the mesh file. */
fram_status build_model(context *ctx, const scenario *s, model *m, fram_error *error);
/* The same, for looking at many scenarios (build_hull.h); store: may be NULL. */
fram_status build_model_of(context *ctx, const scenario *s, hull_store *store, model *m, fram_error *error);

/* Its parts: all but the vessels, and one vessel more. */
fram_status build_method(context *ctx, const scenario *s, model *m, fram_error *error);
fram_status build_vessel_model(context *ctx, const scenario *s, const vessel_entry *entry, hull_store *store, model *m,
                               fram_error *error);

/* What fracture is told, which needs no world. */
fracture_settings build_fracture_settings(const scenario *s);
/* Area of one of the N wedges that break off an edge of ice of a kind at rest, N corners of its stencil apart
   (docs/theory.md) [m2]: what ice.smallest_floe_area has to be small beside.  Where floes must be larger a sheet keeps
   the wedges: a ship of 30 m made 3.3 m/s in ice of 0.2 m where floes had 1 wedge at least, 1.0 m/s at 2, and was beset
   from 4 on. */
double build_wedge_area(const scenario *s, const ice_kind *k);

#endif
