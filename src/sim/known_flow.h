/* What is known before a run of the drift of the ice and of the current at the surface: from the keys, or where files
   tell it from what was read of them.  Must not know what is said of it. */
#ifndef SIM_KNOWN_FLOW_H
#define SIM_KNOWN_FLOW_H

#include "fluid/media.h"
#include "model/scenario.h"

typedef struct known_flow {
    bool known;         /* false: files tell it, and nobody has read them */
    bool steady;        /* it is the same throughout the run */
    double fastest;     /* of the run [m/s] */
    double towards_deg; /* at the start, 0 to 360; as the keys have it where they tell it */
} known_flow;

/* read: what its files hold (sim/build_media.h); NULL: not read. */
known_flow known_drift(const scenario *s, const media_history *read);
known_flow known_current(const scenario *s, const media_history *read);

/* Whether it is the same throughout and not none. */
static inline bool known_flow_goes(const known_flow *f) { return f->steady && f->fastest > 0; }

#endif
