/* By how much a hull stands off the face of level or fixed ice that it left or melted (docs/decisions/0569): state of
   the table of ice/edge_give.h, found again by the nearest place on the hull, which lets contacts close by that much in
   the next step (contact.gap). */
#ifndef ICE_EDGE_GAP_H
#define ICE_EDGE_GAP_H

#include "ice/crushing.h"

/* Opens the contacts of a patch by the gap of a row, if that is this patch's and no neighbour's. */
void edge_gap_open(const edge_support_table *supports, int32_t row, const body_table *bodies, const floe_table *floes,
                   double time_step, const crushing_patch *p, contact_array *contacts);

/* What happens to gaps. */
typedef struct edge_gap_rules {
    bool gaps;          /* a hull that draws back keeps the way */
    bool melts;         /* the heat of friction melts the face of an edge that is bent */
    double latent_heat; /* that melts ice; what warms it first, and what flows into the hull, is left out [J/kg] */
} edge_gap_rules;

/* The gap of a patch after the solve [m]: where it presses what friction melts, of ice of this density [kg/m3]; where
   it does not what the surface has drawn back, less what a bent edge comes back. */
double edge_gap_after(edge_gap_rules rules, const body_table *bodies, double density, double time_step,
                      const crushing_patch *p, const contact_array *contacts);

/* Impulse that a patch carries, along its normals [N s]. */
double edge_gap_pressed(const crushing_patch *p, const contact_array *contacts);

#endif
