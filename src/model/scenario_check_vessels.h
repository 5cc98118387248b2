/* What the vessels of a scenario must satisfy: rules between the keys of each, and between vessels.  One module with
   scenario_check. */
#ifndef MODEL_SCENARIO_CHECK_VESSELS_H
#define MODEL_SCENARIO_CHECK_VESSELS_H

#include "model/scenario.h"

/* FRAM_ERROR_INPUT with key and place.  That hulls keep clear of each other is known once they are made. */
fram_status scenario_check_vessels(const scenario *s, fram_error *error);

#endif
