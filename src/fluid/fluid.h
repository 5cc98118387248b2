/* Fluid forces on bodies: hydrostatics and drag integrated over the fluid surface, clipped at the water plane.
   Sign and frame: force [N] on the body, moment [N m] about its centre of mass, both in the global frame.  Gravity is
   not included. */
#ifndef FLUID_FLUID_H
#define FLUID_FLUID_H

#include "bodies/body.h"
#include "bodies/shape.h"
#include "fluid/flooding.h"
#include "fluid/held_drag.h"
#include "fluid/media.h"

/* Split by cause, for the books and the output. */
typedef struct fluid_load {
    wrench hydrostatic;
    wrench water_drag;
    wrench wind_drag;
    double submerged_volume; /* [m3] */
} fluid_load;

/* What else fluid_apply is to write, without gravity; NULL where it is not wanted.  The whole split of 10,000 floes is
   so much memory that writing it takes a quarter of the time of computing it. */
typedef struct fluid_details {
    double *volume;     /* submerged, per body slot [m3]; zero for bodies that are not dynamic */
    fluid_load *solids; /* per row of the store's solids; rows without a dynamic body are left as they are */
    fluid_load *all;    /* per body slot; zero for bodies that are not dynamic; not with held drag */
    /* Water over the upper faces of prisms (flooding.h): used and led on by a time step [s].  NULL: faces are flooded
       as soon as they are under water. */
    flooding_table *flooding;
    double time_step;
} fluid_details;

typedef struct fluid_motion {
    vec3 position;
    mat3 rotation;
    vec3 velocity, angular_velocity;
} fluid_motion;

/* Pressure and drag on a closed mesh, triangle by triangle clipped at z = 0; writes the whole load.  Pressure is
   integrated exactly (docs/oracles.md, section 5): F = rho g zbar N, torque = rho g (int z r dS) x n.  Drag acts on the
   wet (dry) part with the velocity of each of its points (docs/theory.md, Water and air): form drag exactly, skin drag
   by quadrature (fluid/facet.h). */
void fluid_load_mesh(const media *m, const drag_coefficients *c, const mesh *surface, const fluid_motion *state,
                     fluid_load *load);

/* The same on a prism (outline, simple, extruded over +-half_height), without building its mesh: hydrostatics and form
   drag equal those of the mesh to rounding, the first in closed form while no corner cuts the water plane through a
   cap; skin drag equals it but for the quadrature: none without rotation; spinning in its plane, a disc 1e-5 and a
   square 1e-3; any motion of a floe 3e-3 of the drag at its largest speed (concave: 1e-2). Writes the whole load. */
void fluid_load_prism(const media *m, const drag_coefficients *c, polygon outline, double half_height,
                      const fluid_motion *state, fluid_load *load);

/* Wrench of fluid and gravity on every dynamic body (gravity alone on one without a shape) and zero on every other
   slot, written (not added) to loads[slot]; parallel over blocks of slots.  coefficients[material].  held: drag of
   level floes from earlier steps with the same coefficients and densities, or {0}, used and brought up to date; NULL:
   drag of all bodies is computed. */
fram_status fluid_apply(context *ctx, const media *m, const drag_coefficients coefficients[MATERIAL_COUNT],
                        const body_table *bodies, const shape_store *shapes, held_drag_table *held, wrench *loads,
                        const fluid_details *details, fram_error *error);

#endif
