/* How many seeds a test of random fields looks at.  Twenty each are what docs and bench/results/fields.md speak of;
   they take minutes, so that every build looks at two of them and FRAM_TEST_LONG at all. */
#ifndef SEEDS_H
#define SEEDS_H

#include <stdint.h>
#include <stdlib.h>

static inline uint64_t seeds(void) { return getenv("FRAM_TEST_SHORT") ? 1 : getenv("FRAM_TEST_LONG") ? 20 : 2; }

#endif
