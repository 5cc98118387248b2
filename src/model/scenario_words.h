/* Sentences of settings that a check tells before a run and a report after it, word for word.  Knows the scenario; must
   not know what is made of it. */
#ifndef MODEL_SCENARIO_WORDS_H
#define MODEL_SCENARIO_WORDS_H

#include "model/scenario.h"

typedef struct setting_text {
    char text[160];
} setting_text;

/* "crushing strength 2000 kPa, flexural strength 500 kPa, breaks"; strengths in Pa. */
setting_text ice_strength_text(double crushing, double flexural, bool breaks);
/* The same of a population with its thickness before it, "0.7 m thick, ..."; what it does not have is that of the ice.
 */
setting_text ice_population_text(const scenario_ice *ice, int32_t population);
/* "12 mooring lines on a turret in 100 m of water", lines counted one by one; empty without any. */
setting_text mooring_lines_text(const scenario_vessel *v);
/* What goes on behind the place or heading of a vessel that begins elsewhere, with a comma before it; or "". */
const char *vessel_equilibrium_text(const scenario_vessel *v);

#endif
