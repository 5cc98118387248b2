/* Where a hull ends above, inside io: open tops, which are raised or decked where they are.  Knows the surface alone,
 * not how it came about nor what is said about it. */
#ifndef IO_HULL_TOP_H
#define IO_HULL_TOP_H

#include "geometry/mesh_repair.h"

#include <math.h>

/* [m] */
double hull_longest_side(const mesh *m);
/* Heights this near, relative to the longest side, are one: files hold six or seven digits. */
#define HULL_LEVEL_TOLERANCE 1e-6
/* So far, relative to the longest side, corners may be off the plane in which a hull ends, its water or centre plane:
   as far as cracks are sealed, 10 cm on a ship of 200 m. */
#define HULL_REACH (1.0 / 2000)

/* Slope up to which a triangle is level: sides that flare are steeper, and flat sterns. */
#define HULL_LEVEL_SLOPE (1.0 / 20)

/* How low a top may be that is level to `tolerance` where the highest point is at `top` [m]: off z = 0 where that is as
   near, off a plane half way down otherwise. */
static inline double hull_top_low(double top, double tolerance)
{
    return fabs(top) <= tolerance ? fmin(top - tolerance, -tolerance) : top - 2 * tolerance;
}

/* A level open top. */
typedef struct hull_top {
    mesh_rims rims;
    double z;    /* [m] */
    double area; /* in plan, positive where the surface is right side out [m2] */
    bool above;  /* the hull stands in z = 0, and ends higher */
} hull_top;

/* The rims that lie at the height of the highest point (hull_top_low), and are no holes of a deck.  Begin with
   zeros.  false: no memory. */
bool hull_find_top(context *ctx, const mesh *m, const mesh_rims *rims, double tolerance, hull_top *out);
/* Lay corners that are not level, to HULL_LEVEL_TOLERANCE, into one plane: z = 0 where that is within `tolerance`. */
void hull_level_top(mesh *m, hull_top *top, double tolerance);
/* Turn the rims as triangles are turned. */
void hull_turn_top(hull_top *top);
/* Lead the top up by `height` [m] and deck it; 0: deck it where it is.  Errors as those of mesh_raise_top. */
fram_status hull_close_top(context *ctx, mesh *m, const hull_top *top, double height, fram_error *error);
void hull_top_free(context *ctx, hull_top *top);

/* Where a hull ends whose other half, or topsides, are missing. */
typedef enum hull_ending { HULL_ENDS_NOWHERE, HULL_ENDS_AT_X, HULL_ENDS_AT_Y, HULL_ENDS_AT_WATER } hull_ending;
/* Whether the ring goes round no hole but where the hull ends: within `most` [m] of a plane x = 0 or y = 0 that the
   hull does not cross, or of z = 0, where it is level and nothing stands higher or it is no hole of a deck. */
hull_ending hull_ends_in(const mesh *m, const int32_t *ring, int32_t count, double most);

#endif
