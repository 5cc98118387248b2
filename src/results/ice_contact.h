/* When ice last touched a vessel, and whether it will again: of a load over time.  Knows numbers only. */
#ifndef RESULTS_ICE_CONTACT_H
#define RESULTS_ICE_CONTACT_H

#include <stdint.h>

typedef struct ice_contact {
    double last;    /* time of the last value that is not 0; HUGE_VAL: none */
    double longest; /* between two of them [s] */
    double quiet;   /* from the last one to the end; 0: none */
} ice_contact;

/* Values at rising times; where they are means over a window the last one lies up to that after the contact. */
ice_contact ice_contact_of(const double *time, const double *load, int32_t count);

#endif
