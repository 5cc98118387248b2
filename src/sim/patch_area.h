/* What the points of a crushing patch stand for: the rectangle that has the second moments of all of them, a quarter of
   it each (of two points half of a line).  Knows points and zones of hulls; no panels, no pressures. */
#ifndef SIM_PATCH_AREA_H
#define SIM_PATCH_AREA_H

#include "model/world.h"

/* The points lie at the rectangle's half sides over sqrt(3). */
typedef struct patch_area {
    vec3 middle, a, b; /* from the middle to the middles of two sides, 0: the patch is a line, or a point [m] */
} patch_area;

/* The points of a patch, loaded or not; of a contact without one (-1) its own. Returns how many: 1, 2 or 4. */
enum { PATCH_AREA_POINTS = 4 };
int32_t patch_area_points(const world *w, int32_t patch, vec3 own, vec3 out[PATCH_AREA_POINTS]);
patch_area patch_area_of(const vec3 *point, int32_t count);
/* The part that a point stands for: the parallelogram from `middle` on along a and b. */
patch_area patch_area_part(const patch_area *all, vec3 point);

/* How much of the load of a vessel's contact each zone of the hull bears, in parts of 1: by the length of what its
   point stands for, along the longer side. */
void patch_area_zones(const world *w, int32_t vessel, int32_t patch, vec3 point, double part[ZONE_COUNT]);

#endif
