/* What numbers of a scenario usually are, by key: those that judge a scenario (sim/sanity.h) hold its keys against it,
   those that build, what its files say.  It knows neither. */
#ifndef SIM_USUAL_H
#define SIM_USUAL_H

#include "base/transcendental.h"
#include "model/scenario.h"

/* What a number of full size usually is.  At another scale one of its bounds goes with that power of scale / 30
   (Froude's and Cauchy's law), the default scale being that at which lengths are those of the sea; the other stays,
   since a tank may also keep full-size strengths. What may have either sign has the same bound on both sides. */
typedef struct usual_value {
    const char *key; /* without indices */
    double least, most, power;
    const char *why, *remedy;
} usual_value;

/* The bounds at the scale of a scenario. */
typedef struct usual_range {
    double least, most;
} usual_range;

/* That of a key without indices (a vessel in a list read as the one vessel); NULL: nothing is usual there. */
const usual_value *usual_value_of(const char *key);
/* From bounds of full size of which one goes with a power of the scale; a range about zero is the same on both
   sides. */
usual_range usual_range_at_scale(const scenario *s, double least, double most, double power);
/* That of a key that has one. */
usual_range usual_range_of(const scenario *s, const char *key);

/* What goes with a power of the scale has that of full size at the default one. */
static inline double usual_at_scale(const scenario *s, double power) { return real_pow(scenario_size(s), power); }

/* Longer than any ship, full size [m]. */
#define USUAL_LENGTH_MOST 500.0

/* The most that lines are set to, at full size [N]: a spring without a breaking load that pulls more is told. */
#define USUAL_PULL_MOST 3e7

#endif
