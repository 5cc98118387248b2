/* The ice field of a scenario as outlines, before they become bodies. */
#ifndef SIM_DRAW_ICE_H
#define SIM_DRAW_ICE_H

#include "ice/field_pack.h"
#include "ice/import.h"
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

typedef struct drawn_ice {
    polygon_list outlines;    /* global [m] */
    floe_traits_array traits; /* of each outline */
    int32_t placed;           /* outlines that were observed or cut, and come first; the others are moved shapes */
    field_floe_array shapes;  /* what each of the others was before it had a place */
    ARRAY(field_population_report) parts;
    field_packed_report packed; /* of the populations; packed.field is that of the whole field too */
    field_report report;        /* of the whole field */
    import_rings source;        /* of ice.file: where its rings stand, without the rings */
    import_field file;          /* what became of them, but its outlines, which are the first of those above */
} drawn_ice;
void drawn_ice_free(context *ctx, drawn_ice *d);

/* The ice of a scenario of source voronoi, file or packed, in its domain, around the vessels of w.  out must be empty;
   on failure it may hold some.  FRAM_ERROR_INPUT, with place, for files that cannot be read and for a concentration
   that cannot be reached. */
fram_status draw_ice(context *ctx, const scenario *s, world *w, drawn_ice *out, fram_error *error);

#endif
