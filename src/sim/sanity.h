/* What of a scenario is likely a slip: a number in another unit, two keys that do not belong together.  All of it can
   be simulated, so it is told, not refused.  One module with notes, which tells it, and sanity_parts. */
#ifndef SIM_SANITY_H
#define SIM_SANITY_H

#include "model/model.h"
#include "model/scenario_vessel.h"
#include "model/world.h"

#include <math.h>

/* Takes one sentence that names the key, what was found and what is usual. */
typedef void (*sanity_teller)(const void *to, const char *text);
/* One sentence, as printf makes it; what goes beyond SANITY_SENTENCE bytes is cut off. */
enum { SANITY_SENTENCE = 380 };
void sanity_say(sanity_teller tell, const void *to, const char *format, ...) __attribute__((format(printf, 3, 4)));
/* What was built of a scenario and knows more than its keys: NULL where there is none. */
typedef struct sanity_built {
    const model *model;        /* currents at the depth of hulls, sizes of hulls */
    const world *made;         /* before its first step */
    const media_history *read; /* what files tell of flows */
} sanity_built;
/* From the keys and from what was built; nothing is built here. */
void sanity_tell(const scenario *s, sanity_built built, sanity_teller tell, const void *to);
/* What of a vessel's gear does not belong together or to its hull.  sanity_tell asks. */
void sanity_tell_vessel(const scenario *s, int32_t vessel, sanity_built built, sanity_teller tell, const void *to);
/* Of its size, held against run.scale and against what pulls it.  sanity_tell asks. */
void sanity_tell_size(const scenario *s, const vessel_entry *e, sanity_teller tell, const void *to);
/* Of its place in the domain, and of the room that it has there.  sanity_tell asks. */
void sanity_tell_domain(const scenario *s, int32_t vessel, sanity_built built, sanity_teller tell, const void *to);
/* Of ice that no edge of the domain feeds, and a current that takes it away from vessels on station.  sanity_tell asks.
 */
void sanity_tell_drift(const scenario *s, sanity_built built, sanity_teller tell, const void *to);
/* Of its dynamic positioning, thrusters and propulsion.  sanity_tell asks. */
void sanity_tell_control(const scenario *s, const vessel_entry *e, sanity_built built, sanity_teller tell,
                         const void *to);
/* Of a bow that turns against its load: asks what was built for that load.  sanity_tell asks, and those that build ask
   whether there is such a bow. */
bool sanity_asks_of_vaning(const scenario_vessel *v);
void sanity_tell_vaning(const scenario *s, int32_t vessel, sanity_built built, sanity_teller tell, const void *to);
/* Of the ice: sizes that are left out, friction, populations, level ice.  sanity_tell asks. */
void sanity_tell_ice(const scenario *s, sanity_built built, sanity_teller tell, const void *to);
/* Of the times of the run and of what it writes.  sanity_tell asks. */
void sanity_tell_times(const scenario *s, sanity_teller tell, const void *to);
/* Keys that were set and decide nothing, since another one leaves them without a meaning.  sanity_tell asks.  All these
   sentences hold these words, and no others do. */
#define SANITY_IDLE ": without effect, since "
void sanity_tell_idle(const scenario *s, sanity_teller tell, const void *to);

/* Where the ship's origin begins and with which heading (x, y, heading: m, m, deg): as in `made` where that was found
   at the equilibrium of a mooring, else as its keys have it. */
vec3 sanity_start(const scenario *s, int32_t vessel, const world *made);

/* Whether a vessel begins so far outside of the domain that it is told to meet no ice; without ice none is.  built: has
   the size of a hull of a file; without it (NULL) such a vessel is outside as soon as its place is. */
bool sanity_lies_outside(const scenario *s, int32_t vessel, const model *built);
/* Whether the model is needed to tell that. */
bool sanity_asks_of_place(const scenario *s, int32_t vessel);

/* Whether a current of that speed across a hull [m/s] matters to its station, and acts on its faces with the drag of
   one that goes ahead. */
bool sanity_drags_as_ahead(const scenario *s, const scenario_vessel *v, double across);

/* Between two directions [deg], 0 to 180. */
static inline double sanity_degrees_apart(double a_deg, double b_deg)
{
    double apart = fmod(fabs(a_deg - b_deg), 360);
    return fmin(apart, 360 - apart);
}

#endif
