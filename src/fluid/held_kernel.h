/* Loads of level floes whose drag is held (held_drag.h), eight at a time: exact hydrostatics, from the moments of the
   outline, and held drag, which goes with the square of the motion's size.  Inside fluid. */
#ifndef FLUID_HELD_KERNEL_H
#define FLUID_HELD_KERNEL_H

#include "base/kernel.h"
#include "fluid/held_drag.h"

typedef struct held_media {
    held_vectors current; /* that each of the eight floes meets, global axes [m/s] */
    vec3 wind;            /* [m/s] */
    bool wet, dry;        /* whether drag of that medium is wanted */
    double weight;        /* rho g of the water [N/m3] */
    double gravity;       /* [m/s2] */
} held_media;

/* Bodies of the slots 8 row.. that may use what the row holds: bit i of the result is set when body i floats level and
   moves as it did; loads[i] is then its load of water and air, without gravity, and volume[i] its submerged volume.
   Others are left as they are. */
KERNEL_DECLARE(unsigned, held_loads,
               (const held_media *media, const body_table *bodies, const held_drag_table *held, int32_t row,
                wrench *loads, double *volume));

#endif
