/* How a hull floats, as a naval architect asks: at a draught, or with a mass and a centre of mass; what follows for its
   stability and its form.  Everything from surface integrals over the exact wet part (hull_hydrostatics_at).  Knows
   neither time nor waves. */
#ifndef VESSEL_HYDROSTATICS_H
#define VESSEL_HYDROSTATICS_H

#include "vessel/hull.h"

/* The still water seen from the hull: the hull, in its own frame, is turned by trim (about y, positive: bow down) after
   heel (about x, positive: starboard down), and then the water stands at z = level. */
typedef struct hull_attitude {
    double level; /* [m] */
    double heel;  /* [rad] */
    double trim;  /* [rad] */
} hull_attitude;

/* From the hull's frame to that of the still water. */
mat3 hull_rotation(const hull_attitude *a);
/* hull_hydrostatics_at of the turned hull: all in the frame of the still water.  Errors as there. */
fram_status hull_hydrostatics_in(context *ctx, const mesh *surface, const hull_attitude *a, hull_hydrostatics *out,
                                 fram_error *error);

/* The level at which the upright hull displaces a volume [m3] over 0 and under all it encloses. */
fram_status hull_level_of(context *ctx, const mesh *surface, double volume, double *level, fram_error *error);

/* Equilibrium with the displaced volume [m3] (mass over density) and the centre of mass [m, hull's frame]: the level
   holds the volume, heel and trim follow by Newton's method on the moments of the pressure integrals, whose derivative
   is the exact hydrostatic stiffness.  Started upright; where that is unstable it goes downhill in energy, so that a
   hull that lists finds its list if anything tips it.  To rounding: arms under 1e-12 of the length. FRAM_ERROR_INPUT
   with key "mass" (it sinks, or displaces nothing) or "centre" (no equilibrium is found: it turns over). */
fram_status hull_float(context *ctx, const mesh *surface, double volume, vec3 centre, hull_attitude *out,
                       fram_error *error);

/* Stability and stiffness about the centre of mass, and the coefficients of form. */
typedef struct hull_stability {
    hull_hydrostatics at;     /* frame of the still water */
    vec3 centre_of_buoyancy;  /* hull's frame [m] */
    vec3 centre_of_flotation; /* hull's frame [m] */
    vec3 centre;              /* of mass, hull's frame [m] */
    double enclosed_volume;   /* of the whole hull [m3] */
    double kb, kg;            /* heights over the lowest point, along the hull's z [m] */
    double bm_transverse, bm_longitudinal, gm_transverse, gm_longitudinal; /* [m] */
    bool stable;                                                           /* heel and trim come back */
    /* Restoring coefficients over rho g, x forward, y to port, z up, about the centre of mass: heave [m2], heave-roll
       and heave-pitch [m3], roll, roll-pitch and pitch [m4] (Faltinsen 1990, eq. 3.40). */
    double c33, c34, c35, c44, c45, c55;
    double length_overall, breadth_overall, depth; /* of the whole hull, its frame [m] */
    double length_waterline, breadth_waterline;    /* of the water plane [m] */
    double draught;                                /* of the lowest point, amidships, along the hull's z [m] */
    double draught_fore, draught_aft;              /* of the same height at the ends of the waterline [m] */
    double midships;                               /* x of the middle of the waterline [m] */
    double midship_area;                           /* wet part of the section there [m2] */
    double block, waterplane, midship,
        prismatic; /* coefficients of the waterline's length and breadth, and the draught */
} hull_stability;

/* Whether the water stands between the lowest and the highest point, off both by more than the digits of a file. */
bool hull_is_cut(const mesh *surface, const hull_attitude *a);

/* FRAM_ERROR_INPUT when nothing floats at that attitude, or the surface is open; FRAM_ERROR_MEMORY. */
fram_status hull_stability_of(context *ctx, const mesh *surface, const hull_attitude *a, vec3 centre,
                              hull_stability *out, fram_error *error);

/* A surface prepared for many sections square to one of its axes (0 x, 1 y, 2 z). */
typedef struct hull_slicer {
    int axis;
    mesh turned;
    mesh_adjacency adjacency;
} hull_slicer;
fram_status hull_slicer_make(context *ctx, const mesh *surface, int axis, hull_slicer *out, fram_error *error);
void hull_slicer_free(context *ctx, hull_slicer *s);
/* Appends the section's rings, counter-clockwise around solid, in the coordinates (y, z), (z, x) or (x, y). */
fram_status hull_slice(context *ctx, const hull_slicer *s, double at, polygon_list *out, fram_error *error);

#endif
