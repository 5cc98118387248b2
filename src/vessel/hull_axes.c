/* Axes of a hull by its symmetry; see hull_axes.h. */
#include "vessel/hull_axes.h"

#include <math.h>

/* Part of its extent by which box and centre of a hull may lie off the plane between its two sides. */
#define OFF_PLANE 0.01
/* Beam over length of what may still be a round or square hull, whose facets reach less far one way: it has no sides.
 */
#define ROUND_HULL 1.1

/* Whether a hull that reaches from lo to hi, with its centre of volume at `centre`, may be alike on both sides of a
   plane. */
static bool lies_about(double lo, double hi, double centre, double plane)
{
    double most = OFF_PLANE * (hi - lo);
    return fabs(0.5 * (lo + hi) - plane) <= most && fabs(centre - plane) <= most;
}

static bool has_y_up(const mesh *surface, vec3 origin)
{
    const box3 box = mesh_bounds(surface);
    const vec3 centre = mesh_solid_properties(surface).centre;
    if (!lies_about(box.lo.z, box.hi.z, centre.z, origin.z) || lies_about(box.lo.y, box.hi.y, centre.y, origin.y))
        return false;
    bool moved = lies_about(box.lo.y, box.hi.y, centre.y, 0.5 * (box.lo.y + box.hi.y));
    return !moved || box.hi.z - box.lo.z > box.hi.y - box.lo.y;
}

hull_axes hull_axes_of(const mesh *surface, vec3 origin, double length, double beam)
{
    if (has_y_up(surface, origin))
        return HULL_Y_UP;
    return beam > ROUND_HULL * length ? HULL_Y_FORWARD : HULL_AXES_OF_SHIPS;
}
