/* The jets of a vessel's propellers, from its keys. */
#ifndef SIM_BUILD_WASH_H
#define SIM_BUILD_WASH_H

#include "model/model.h"

/* hull: what is known of the vessel so far, its particulars and centre of mass among it. */
wash_model build_wash(const scenario *s, const scenario_vessel *keys, const vessel_model *hull);

#endif
