/* The hull of a scenario: made from its particulars or read from its file, as a solid about the centre of mass. */
#ifndef SIM_BUILD_HULL_H
#define SIM_BUILD_HULL_H

#include "model/model.h"
#include "model/scenario_vessel.h"

/* As many vessels as a scenario may have. */
enum { STORED_HULLS = 32 };

/* Hulls that were read from files and cut into pieces, for who looks at many scenarios of the same ones and runs none:
   a fine mesh takes seconds.  A file that changes meanwhile is not read again.  Starts as {0}. */
typedef struct stored_hull {
    scenario_hull keys;
    char path[SCENARIO_PATH_ROOM];
    mesh surface;
    polyhedron_array pieces;
    double usual_freeboard; /* of the scenario that it was read for [m] */
    double concavity;       /* of the pieces [m] */
} stored_hull;
typedef struct hull_store {
    ARRAY(stored_hull) hulls; /* STORED_HULLS at most: then the oldest one gives way */
    int32_t next;             /* that does */
} hull_store;
void hull_store_free(context *ctx, hull_store *store);

/* Appends the hull to the solids, and fills what out tells of it.  store: where hulls of files are looked for first,
   and kept; NULL: nowhere.  Errors name the key at fault, or place and element of the mesh file. */
fram_status build_hull(context *ctx, const scenario *s, const vessel_entry *entry, hull_store *store,
                       solid_array *solids, vessel_model *out, fram_error *error);

/* How the upright hull, which `hull` knows, floats with its own mass, ship coordinates: at its draught, or where it
   moves up or down to; body: its solid.  Nothing is displaced where no mass floats, as by what the hull displaces as a
   whole. */
fram_status build_upright(context *ctx, const scenario *s, const vessel_entry *entry, const vessel_model *hull,
                          const solid *body, hull_hydrostatics *out, fram_error *error);

#endif
