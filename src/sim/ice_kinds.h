/* How thick and strong the ice of a scenario is, as far as its keys tell: floes and populations may have their own.
   What a file tells of its floes is known once they are made; nothing is known of scatter. */
#ifndef SIM_ICE_KINDS_H
#define SIM_ICE_KINDS_H

#include "ice/material.h"
#include "model/scenario.h"
#include "model/world.h"

typedef struct ice_kind {
    double thickness, flexural_strength, crushing_strength; /* [m], [Pa] */
} ice_kind;

typedef struct ice_range {
    ice_kind thinnest, thickest; /* of equally thick ones the weakest and the strongest in crushing */
    ice_kind soonest;            /* of what may break: breaks at its edge after the least of crushing */
    ice_kind stoutest;           /* of what may break: the thickest, of equally thick ones the strongest in bending */
} ice_range;
/* Whether any ice of the scenario, and all of it, may break. */
bool ice_may_break(const scenario_ice *i);
bool ice_all_breaks(const scenario_ice *i);
/* Of all ice that the scenario makes; of floes of a file by those that were made, in an endless field by all of its
   tile.  made: the world of the scenario, before its first step or later; NULL, or it holds no floes: all goes by keys.
   Of floes of a file in a world whose vessels alone were made nothing is known: all is NaN, which is neither more nor
   less than any number. */
ice_range ice_range_made(const scenario_ice *i, const world *made);
bool ice_is_known(const ice_range *r);
/* Whether it is all of one kind. */
bool ice_is_alike(const ice_range *r);
bool ice_kinds_alike(const ice_kind *a, const ice_kind *b);
/* What the floes of a population are in the mean: what it leaves out is that of all ice. */
ice_kind ice_kind_of_population(const scenario_ice *i, const scenario_population *p);
/* With the rest of what all ice has in common. */
ice_material ice_kind_material(const scenario_ice *i, const ice_kind *k);

#endif
