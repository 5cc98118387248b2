/* The media around the bodies: still-water plane z = 0, water below with a current, air above with a wind.
   Knows nothing of contacts, ice or ships. */
#ifndef FLUID_MEDIA_H
#define FLUID_MEDIA_H

#include "base/vec.h"

#include <stdint.h>

/* Most levels of a current that changes with depth. */
enum { CURRENT_LEVELS = 16 };

/* A current that changes with depth: linear between levels, constant above the first and below the last. */
typedef struct current_profile {
    int32_t count;                 /* 0: uniform */
    double depth[CURRENT_LEVELS];  /* below still water, ascending, different [m] */
    vec3 velocity[CURRENT_LEVELS]; /* on top of the current at the surface [m/s] */
} current_profile;

/* State of the media at one instant. Directions are velocities towards, global frame. */
typedef struct media {
    double gravity;       /* [m/s2], down */
    double water_density; /* [kg/m3] */
    double air_density;   /* [kg/m3] */
    vec3 current;         /* [m/s] */
    vec3 wind;            /* [m/s] */
    current_profile profile;
} media;

/* Current at a height over still water (0 or less; above it, that of the surface) [m/s]. */
vec3 media_current(const media *m, double height);

/* Drag of one body's surface: form -1/2 rho Cd A |vn| vn n on faces moving into the medium, skin -1/2 rho Cf A |vt| vt
   (SPEC 5). */
typedef struct drag_coefficients {
    double water_form, water_skin; /* [1] */
    double air_form, air_skin;     /* [1] */
} drag_coefficients;

#endif
