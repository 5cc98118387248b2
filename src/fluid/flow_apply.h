/* The hull of a vessel that has tables of coefficients for wind or current. */
#ifndef FLUID_FLOW_APPLY_H
#define FLUID_FLOW_APPLY_H

#include "fluid/flow_table.h"
#include "fluid/fluid.h"

/* What a hull has tables for; a count of 0: drag of the panels. */
typedef struct hull_flows {
    flow_table water, air;
    double depth; /* below still water, where the current is taken [m] */
} hull_flows;

/* In place of what fluid_apply found for a body with a solid: drag of the table's medium is that of the table for the
   motion of the centre of mass in the plane, and that of the panels for heave and for turning alone.  Writes
   loads[slot] and the details, as fluid_apply does. */
void fluid_apply_flows(context *ctx, const media *m, const drag_coefficients *c, const hull_flows *flows,
                       const body_table *bodies, const shape_store *shapes, int32_t slot, wrench *loads,
                       const fluid_details *details);
/* The media as a hull with tables meets their panels: at rest to it in the plane. */
media flows_media(const media *m, const hull_flows *flows, vec3 velocity);
/* Adds the tables' loads to a load. */
void flows_add(const media *m, const hull_flows *flows, mat3 rotation, vec3 velocity, fluid_load *load);

#endif
