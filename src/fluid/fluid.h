/* Fluid forces on bodies: hydrostatics and drag integrated over the fluid surface, clipped at the water plane.
   Sign and frame: force [N] on the body, moment [N m] about its centre of mass, both in the global frame.  Gravity is not
   included. */
#ifndef FLUID_FLUID_H
#define FLUID_FLUID_H

#include "bodies/body.h"
#include "bodies/shape.h"
#include "fluid/media.h"

/* Split by cause, for the books and the output. */
typedef struct fluid_load {
    wrench hydrostatic;
    wrench water_drag;
    wrench wind_drag;
    double submerged_volume; /* [m3] */
} fluid_load;

typedef struct fluid_motion {
    vec3 position;
    mat3 rotation;
    vec3 velocity, angular_velocity;
} fluid_motion;

/* Hydrostatic wrench of a closed mesh: exact pressure integral over each triangle clipped at z = 0 (oracles section 5):
   F = rho g zbar N, torque = rho g (int z r dS) x n. */
void hydrostatics_mesh(const media *m, const mesh *surface, const fluid_motion *motion, fluid_load *load);
/* Drag on every wet (dry) part of each triangle, velocity taken at the centroid of the part; adds to load. */
void drag_mesh(const media *m, const drag_coefficients *c, const mesh *surface, const fluid_motion *motion,
               fluid_load *load);

/* The same on a prism (outline extruded over +-half_height): equal to the mesh versions to rounding; a closed form while no
   corner cuts the water plane through top or bottom. */
void fluid_load_prism(const media *m, const drag_coefficients *c, polygon outline, double half_height,
                      const fluid_motion *motion, fluid_load *load);

/* Wrench of fluid and gravity on every dynamic body with a shape, written (not added) to loads[slot]; parallel over blocks of
   slots.  coefficients[material].  detail (may be NULL) gets the split per slot. */
fram_status fluid_apply(context *ctx, const media *m, const drag_coefficients coefficients[MATERIAL_COUNT],
                        const body_table *bodies, const shape_store *shapes, wrench *loads, fluid_load *detail,
                        fram_error *error);

#endif
