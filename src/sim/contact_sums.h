/* What the contacts of the last step did, summed by body: for the record, which keeps no single contact. */
#ifndef SIM_CONTACT_SUMS_H
#define SIM_CONTACT_SUMS_H

#include "model/world.h"

/* One row per body slot; forces are impulses over the time step. */
typedef struct contact_sum {
    double magnitude; /* sum of the magnitudes of the forces at all contacts of the body [N] */
    vec3 on_vessel;   /* what the body does to the vessel, global frame [N] */
    vec3 moment;      /* sum of the points of on_vessel, each times the magnitude there [N m] */
    double weight;    /* sum of those magnitudes [N]; 0: the body does not touch the vessel */
} contact_sum;
typedef ARRAY(contact_sum) contact_sum_array;

/* vessel: whose loads are summed, -1 for none.  A floe that broke in the step leaves its slot, and with it its sum, to
   one of its pieces.  false: no memory. */
bool contact_sums_of(context *ctx, const world *w, double time_step, int32_t vessel, contact_sum_array *sums);

#endif
