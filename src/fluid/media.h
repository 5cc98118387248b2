/* The media around the bodies: still-water plane z = 0, water below with a current, air above with a wind.
   Knows nothing of contacts, ice or ships. */
#ifndef FLUID_MEDIA_H
#define FLUID_MEDIA_H

#include "base/vec.h"

/* State of the media at one instant. Directions are velocities towards, global frame. */
typedef struct media {
    double gravity;       /* [m/s2], down */
    double water_density; /* [kg/m3] */
    double air_density;   /* [kg/m3] */
    vec3 current;         /* [m/s] */
    vec3 wind;            /* [m/s] */
} media;

/* Drag of one body's surface: form -1/2 rho Cd A |vn| vn n on faces moving into the medium, skin -1/2 rho Cf A |vt| vt
   (SPEC 5). */
typedef struct drag_coefficients {
    double water_form, water_skin; /* [1] */
    double air_form, air_skin;     /* [1] */
} drag_coefficients;

#endif
