/* The hull of a scenario: made from its particulars or read from its file, as a solid about the centre of mass. */
#ifndef SIM_BUILD_HULL_H
#define SIM_BUILD_HULL_H

#include "model/scenario.h"
#include "model/world.h"

/* The hull about its centre of mass, with what its making tells. */
typedef struct made_hull {
    int32_t solid;                /* in w->shapes */
    vec3 centre;                  /* of mass, ship coordinates [m] */
    double displaced_mass;        /* at the draught [kg] */
    hull_particulars particulars; /* of a file: measured at z = 0 */
    hull_hydrostatics floats;     /* at the draught, ship coordinates */
} made_hull;

/* Errors name the key at fault, or place and element of the mesh file. */
fram_status build_hull(context *ctx, const scenario *s, world *w, made_hull *out, fram_error *error);

#endif
