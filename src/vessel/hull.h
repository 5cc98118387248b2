/* Hulls: closed meshes in ship coordinates (x forward, y to port, z up, origin at x = 0 amidships,
   y = 0 on the centre line, z = 0 at the design waterline), and their convex pieces.  Knows no ice and no files. */
#ifndef VESSEL_HULL_H
#define VESSEL_HULL_H

#include "geometry/polyhedron.h"

typedef enum hull_form { HULL_BOX = 0, HULL_ICEBREAKER, HULL_MESH, HULL_CONE, HULL_SHIP } hull_form;

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
    double block_coefficient; /* displaced volume / (L B T) [1]; 0: sharp bilges, whatever it then is */
    double bilge_radius;      /* of a ship [m] */
    double transom;           /* of a ship: breadth of the transom at the waterline / B [1] */
    double midships;          /* x of the middle of the waterline, other than 0 for a mesh only [m] */
} hull_particulars;

/* Cotangent of an angle [rad]: how far a raked line goes forward for its height. */
double hull_cotangent(double angle);

/* Replace each NaN by what is usual for the form: 30 degrees for angles, 8 for flare and 0.4 of the length for the
   parallel body, but for a ship, whose own are in hull_ship.h. */
void hull_particulars_fill(hull_particulars *p);

/* The least and the largest block coefficient that the bilge can make of an icebreaker, or the ends of a ship, whose
   other particulars make a hull (a box has 1). */
void hull_block_range(const hull_particulars *p, double *least, double *most);

/* Whether the particulars make a hull.  FRAM_ERROR_INPUT, with key the name of the one that does not fit
   ("flare_angle"). Of HULL_MESH only length, beam and draught are looked at. */
fram_status hull_particulars_check(const hull_particulars *p, fram_error *error);

/* Mesh and convex pieces of a box or a simple icebreaking hull.  surface and pieces must be empty; on failure they
   still are. The icebreaker is bounded by planes: keel and deck; sides flared by flare_angle against the vertical; bow
   planes through the stem line (stem_angle against the water) and the waterline's entrance (entrance_angle against the
   centre line); stern planes through the stern line (stern_angle) and the waterline's run, whose length is what
   entrance and parallel body leave of L; without any left the stern is a raked transom.  So at z = 0 length, beam and
   parallel body are exactly those given, the whole is convex, and its one piece is exact.  A block coefficient is met
   to rounding by the bilge: rounded, then drawn towards a V, in flat strips; waterline, stem and sides stay.  Triangles
   of port and starboard mirror each other. The form of a ship is told in hull_ship.h. FRAM_ERROR_INPUT as
   hull_particulars_check and for HULL_MESH, which comes from a file.
 */
fram_status hull_make(context *ctx, const hull_particulars *p, mesh *surface, polyhedron_array *pieces,
                      fram_error *error);

/* Cut a closed surface into convex pieces (mesh_convex_pieces).  *tolerance: largest distance between pieces and
   surface [m], a NaN is replaced by a hundredth of the breadth; most: number of pieces.  concavity gets the distance
   that remains. */
fram_status hull_cut(context *ctx, const mesh *surface, double *tolerance, int32_t most, polyhedron_array *pieces,
                     double *concavity, fram_error *error);

/* What floats: of the part of a closed mesh under z = level. */
typedef struct hull_hydrostatics {
    double volume;                       /* displaced [m3] */
    vec3 centre_of_buoyancy;             /* [m] */
    double waterplane_area;              /* [m2] */
    vec2 centre_of_flotation;            /* [m] */
    double waterplane_xx, waterplane_yy; /* second moments of the water plane about its centroid: of y^2, of x^2 [m4] */
    double waterplane_xy;                /* product moment about it: of x y [m4] */
    box2 waterline;                      /* around the water plane [m] */
    double wetted_area;                  /* [m2] */
    vec3 volume_integrals;               /* of x n_x, y n_y, z n_z over the wet part, z from the level [m3] */
} hull_hydrostatics;
/* From surface integrals over the wet triangles (divergence theorem): exact for a closed mesh, without a section.  All
   zero when nothing floats.  FRAM_ERROR_INPUT when the volume integrals of x n_x, y n_y and z n_z differ by more than
   1e-6: the surface is not closed below the level. */
fram_status hull_hydrostatics_at(context *ctx, const mesh *surface, double level, hull_hydrostatics *out,
                                 fram_error *error);

/* Zones by which results split the load, by position in ship coordinates. */
typedef enum hull_zone { ZONE_BOW = 0, ZONE_SHOULDER, ZONE_MIDBODY, ZONE_STERN, ZONE_BOTTOM, ZONE_COUNT } hull_zone;

/* Where one zone ends and the next begins [m]. */
typedef struct hull_zones {
    double bow;      /* bow: x > bow */
    double shoulder; /* shoulder: shoulder < x <= bow */
    double stern;    /* midbody: stern < x <= shoulder; stern: x <= stern */
    double bottom;   /* bottom: z < bottom, whatever x */
} hull_zones;
/* Bow: the waterline's entrance, at least L/20.  Shoulder: the next L/10.  Stern: the run, at least L/20.  Bottom: the
   lowest twentieth of the draught.  Entrance and run of HULL_MESH and HULL_CONE count as L/5. */
hull_zones hull_zones_of(const hull_particulars *p);
hull_zone hull_zone_at(const hull_zones *zones, vec3 point);
/* "bow" */
const char *hull_zone_name(hull_zone zone);

#endif
