/* How many floes may lie over one another.  Knows numbers only. */
#ifndef ICE_CROWD_H
#define ICE_CROWD_H

#include "base/context.h"

/* Pairs of floes whose boxes may overlap before a field is refused.  A dense field has about three for every floe; more
   than ten thousand, and thirty for each floe on the mean, are several pictures of one field, or floes that were all
   put to one place.  A pair costs about 10 kB and 10 us a step in a run: a thousand floes in one place, half a million
   pairs, took 4.4 GB and a minute a step. */
int64_t crowd_most_pairs(int32_t floes);
/* FRAM_ERROR_INPUT; file: that the floes are of, or NULL. */
fram_status crowd_refuse(const char *file, int32_t floes, fram_error *error);

#endif
