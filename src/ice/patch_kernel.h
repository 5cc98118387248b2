/* Inner loops of crushing patches, eight sides or rays at once: where points lie to the sides of a piece, and ways out
   of a prism.  Knows no bodies and no forces. */
#ifndef ICE_PATCH_KERNEL_H
#define ICE_PATCH_KERNEL_H

#include "base/kernel.h"
#include "base/vec.h"

/* A convex piece of a prism: its vertices, and the unit outward normals of the sides that start there.  From vertex on,
   `readable` entries of both may be read; those beyond `count` have no meaning. */
typedef struct piece_sides {
    const vec2 *vertex, *normal;
    int32_t count, readable;
} piece_sides;

/* Bit k of a code: the point lies outside of side k; bit PATCH_INSIDE + k: inside of it, which is set for the sides
   that the piece does not have, too. */
enum { PATCH_INSIDE = 16 };
#define PATCH_OUTSIDE_BITS 0xffffu

/* Codes of `count` points about the sides of a piece, in its plan view.  Points nearer to the line of a side than
   `margin` [m] are neither outside nor inside. */
KERNEL_DECLARE(void, patch_codes,
               (const piece_sides *piece, double margin, const vec3 *point, int32_t count, uint32_t *code));

/* Rays in the frame of a prism: row 0 to 2 their starts [m], 3 to 5 unit directions, `stride` numbers a row, which is a
   multiple of eight; all of them are numbers, those beyond the last ray too. */
typedef struct patch_rays {
    const double *data;
    int32_t stride;
} patch_rays;

/* Length of the way along each ray out of the prism of the given pieces, across seams: places nearer than `tolerance`
   [m] are the same.  0 for a start outside.  way: `stride` numbers [m]. */
KERNEL_DECLARE(void, patch_ways,
               (const piece_sides *piece, int32_t pieces, double half_height, double tolerance, const patch_rays *rays,
                double *way));

#endif
