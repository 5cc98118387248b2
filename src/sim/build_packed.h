/* Floes drawn from the populations of a scenario, in places where none overlap. */
#ifndef SIM_BUILD_PACKED_H
#define SIM_BUILD_PACKED_H

#include "ice/field.h"
#include "model/scenario.h"
#include "model/world.h"

/* What floes of one field do not share. */
typedef struct floe_traits {
    double thickness;         /* [m] */
    double flexural_strength; /* [Pa] */
    double crushing_strength; /* [Pa] */
    bool breakable;
} floe_traits;
typedef ARRAY(floe_traits) floe_traits_array;

/* Those of the scenario, with a thickness of its own unless NaN [m]. */
floe_traits scenario_traits(const scenario *s, double thickness);

/* Packs floes of ice.populations to ice.concentration around the keep-out zones and around the outlines that are there
   already (as many as traits); appends both.  *report is of the whole field.  FRAM_ERROR_INPUT, with place, for files
   that cannot be read and for a concentration that cannot be reached. */
fram_status draw_populations(context *ctx, const scenario *s, world *w, const polygon_list *keep_out,
                             polygon_list *outlines, floe_traits_array *traits, field_report *report,
                             fram_error *error);

#endif
