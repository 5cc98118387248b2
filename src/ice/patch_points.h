/* The points in which a crushing patch touches (docs/decisions/0010).  Knows no bodies and no pressure. */
#ifndef ICE_PATCH_POINTS_H
#define ICE_PATCH_POINTS_H

#include "ice/patch.h"

enum { PATCH_MOST_POINTS = 4 };

/* Points of equal weight with the centroid and the second moments of the patch in its plane: centre +- s1 +- s2, with
   s1 and s2 the columns of the symmetric root of its covariance.  On a rectangle they are the points of Gauss's rule.
   Two points for a patch that is nearly a line, one for a point.  Their number is returned; normal: the unit
   vector along the area of the component, floe frame.
   small: lengths of gyration under it count as none [m].  The second moment in any direction of the plane is then less
   than small^2 too small, never too large (docs/decisions/0390). */
int patch_points(const patch_component *c, vec3 normal, double small, vec3 out[PATCH_MOST_POINTS]);

#endif
