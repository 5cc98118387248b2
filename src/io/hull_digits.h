/* Whether a defect of a hull is what a file's rounding of coordinates made of it, inside io.  Knows triangles alone,
   not how they are mended. */
#ifndef IO_HULL_DIGITS_H
#define IO_HULL_DIGITS_H

#include "geometry/mesh.h"

#include <stddef.h>

/* Whether rounding to the step of which all coordinates of the file are multiples, a power of ten from 1 to 1e-6, may
   have flattened a triangle of its surface m, face[0], or have laid two that have a corner in common over each other;
   face[1] is -1 for a single one.  A coordinate of the file times `scale` is one of m.  advice then gets what is to be
   done. */
bool hull_lacks_digits(const mesh *in_file, double scale, const mesh *m, const int32_t face[2], char *advice,
                       size_t size);

#endif
