/* Hulls: closed meshes in ship coordinates (x forward, y to port, z up, origin at x = 0 amidships,
   y = 0 on the centre line, z = 0 at the design waterline), and their convex pieces.  Knows no ice and no files. */
#ifndef VESSEL_HULL_H
#define VESSEL_HULL_H

#include "geometry/polyhedron.h"

typedef enum hull_form { HULL_BOX = 0, HULL_ICEBREAKER, HULL_MESH } hull_form;

/* Main particulars. */
typedef struct hull_particulars {
    hull_form form;
    double length;            /* waterline length L [m] */
    double beam;              /* waterline beam B [m] */
    double draught;           /* T [m] */
    double freeboard;         /* height of the deck over the waterline [m] */
    double stem_angle;        /* phi: stem against the water plane, at the waterline [rad] */
    double entrance_angle;    /* alpha: half entrance angle of the waterline [rad] */
    double flare_angle;       /* of the sides against the vertical, midbody [rad] */
    double stern_angle;       /* run of the stern against the water plane [rad] */
    double parallel_midbody;  /* length of the parallel middle body / L [1] */
} hull_particulars;

/* Mesh and convex pieces of a box or a simple icebreaking hull: wedge bow with stem and entrance angle, flared parallel midbody,
   raked stern; every part is itself convex, so that the pieces are exact.  FRAM_ERROR_INPUT names the particular that does not fit. */
fram_status hull_make(context *ctx, const hull_particulars *p, mesh *surface, polyhedron_array *pieces, fram_error *error);

/* What floats: of the part of a closed mesh under z = level. */
typedef struct hull_hydrostatics {
    double volume;           /* displaced [m3] */
    vec3 centre_of_buoyancy; /* [m] */
    double waterplane_area;  /* [m2] */
    vec2 centre_of_flotation; /* [m] */
    double waterplane_xx, waterplane_yy; /* second moments of the water plane about its centroid: of y^2, of x^2 [m4] */
} hull_hydrostatics;
fram_status hull_hydrostatics_at(context *ctx, const mesh *surface, double level, hull_hydrostatics *out, fram_error *error);

/* Zones for the load split (SPEC 11), by position in ship coordinates. */
typedef enum hull_zone { ZONE_BOW = 0, ZONE_SHOULDER, ZONE_MIDBODY, ZONE_STERN, ZONE_BOTTOM, ZONE_COUNT } hull_zone;
const char *hull_zone_name(hull_zone z);

#endif
