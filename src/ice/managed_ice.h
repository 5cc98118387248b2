/* Ice that was measured in windows before a vessel, as a law from which a field of the same ice can be made.  Sizes are
   diameters of discs of a floe's area [m], in full size: who measures a model gives what its floes are there
   (results/manage.h).  Knows neither runs nor scenarios. */
#ifndef ICE_MANAGED_ICE_H
#define ICE_MANAGED_ICE_H

#include "ice/field_size.h"

/* Sixteen bins an octave, so that a floe is at most 4.5 % larger or smaller than its bin tells, from a quarter of a
   metre to 4 km: what is smaller or larger goes into the first or last. */
enum { MANAGED_OCTAVE = 16, MANAGED_BINS = 14 * MANAGED_OCTAVE };

/* Parts of a window's area. */
typedef struct managed_cover {
    double of_bin[MANAGED_BINS]; /* of floes, by size */
    double sized;                /* of floes, each times its size [m] */
    double sheet;                /* of unbroken level ice */
    double volume;               /* of all ice, times its thickness [m] */
} managed_cover;

/* Sums over windows that count alike. */
typedef struct managed_ice {
    double windows;
    managed_cover sum;
    double largest; /* size of the largest floe of which a part was seen [m] */
} managed_ice;

/* The ice between them as floes of one law. */
typedef struct managed_law {
    double edge[MANAGED_BINS + 1], weight[MANAGED_BINS]; /* [m]; floes, with any common factor */
    int32_t bins;
    double concentration, thickness; /* means over the windows, and over the ice [m] */
    double sheet;                    /* part of the ice that was unbroken */
    double mean, largest;            /* size of floes, by area; of the largest seen [m] */
} managed_law;

/* Lower edge of a bin, MANAGED_BINS: the upper one of the last. */
double managed_edge(int32_t bin);
/* Adds a part of a window's area that a floe of a size covers. */
void managed_cover_add(managed_cover *cover, double size, double part);
void managed_ice_add(managed_ice *ice, const managed_cover *window, double largest);

/* sheet_as: size of the floes that stand for unbroken ice [m]; a NaN: it is left out, and the rest takes its place.
   Within a bin diameters are even by number, as in a histogram of size_law.  FRAM_ERROR_INPUT without windows or
   floes. */
fram_status managed_law_of(const managed_ice *ice, double sheet_as, managed_law *out, fram_error *error);
/* The law of size; it refers to `from`. */
size_law managed_size_law(const managed_law *from);

#endif
