/* Times of this machine, for progress and measurements: no result depends on them. */
#ifndef BASE_CLOCK_H
#define BASE_CLOCK_H

/* Time that only goes on, from a moment of its own [s]. */
double clock_wall(void);
/* Processor time of this program, all threads together [s]. */
double clock_processor(void);

#endif
