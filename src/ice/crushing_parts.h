/* What crushing.c and crushing_give.c share: one module with crushing and crushing_blocks.  Not for
   others. */
#ifndef ICE_CRUSHING_PARTS_H
#define ICE_CRUSHING_PARTS_H

#include "ice/crushing.h"
#include "ice/patch.h"
#include "ice/prism_surfaces.h"

/* A component whose area vectors cancel to less than this part of its area closes round inside the floe (a hull's
   corner, a pile), or is less when its edge has given: what is left is rounding and has no direction. */
#define CLOSED_PATCH 1e-9

/* What one call works on, or one block of it. */
typedef struct crushing_job {
    context *ctx;
    const prism_surfaces *prisms; /* with all that are asked for */
    patch_scratch *room;          /* of the thread */
    const crushing_settings *settings;
    const body_table *bodies;
    const shape_store *shapes;
    const floe_table *floes;
    const edge_support_table *supports;
    crushing_patch_array *patches;
    contact_array *contacts;
    fram_error *error;
} crushing_job;

/* One pair, seen from its floe. */
typedef struct crushing_pair {
    int32_t floe, floe_body, surface_body;
    const pair_policy *policy;
    patch_floe prism;
    patch_surface surface;
    mat3 rotation; /* floe to global */
    vec3 position;
} crushing_pair;

/* The pressure on a component of this area [Pa]. */
double crushing_component_pressure(const crushing_job *j, const crushing_pair *p, const patch_component *c,
                                   double area);

/* Whether a component loads an edge that gives: ice that can break and does not move freely, under a hull that presses
   it down or up.  A face that is upright but for rounding does not, nor one on which friction takes off all of that;
   areas by the paper's rule are not those of the patch. */
bool crushing_edge_gives(const crushing_job *j, const crushing_pair *p, const patch_component *c);

/* What a component bears. */
typedef struct patch_bearing {
    double pressure;   /* at most [Pa] */
    double compliance; /* of the edge under it: deflection over the component's own vertical load [m/N] */
    bool over;         /* it would be over what breaks the edge that it is on, as that is known */
} patch_bearing;

/* What is left of a component when its edge has given, and the pressure there: no more than bends the edge so far, nor
   much more than breaks it (docs/decisions/0566). */
patch_component crushing_give_way(const crushing_job *j, const crushing_pair *p, const patch_component *c,
                                  int32_t number, patch_bearing *bearing);

#endif
