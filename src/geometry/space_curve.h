/* An order of points of the plane in which neighbours in the list are neighbours in the plane: along Hilbert's curve.
   Bodies made in this order lie near one another in memory when they lie near one another in the water. */
#ifndef GEOMETRY_SPACE_CURVE_H
#define GEOMETRY_SPACE_CURVE_H

#include "base/context.h"
#include "base/vec.h"

/* order[0..count) becomes the indices of the points along the curve that fills their bounds; equal places by index.
   Points must be finite.  false: no memory. */
bool space_curve_order(context *ctx, const vec2 *points, int32_t count, int32_t *order);

#endif
