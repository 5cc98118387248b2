/* The media around the bodies: still-water plane z = 0, water below with a current, air above with a wind.
   Knows nothing of contacts, ice or ships. */
#ifndef FLUID_MEDIA_H
#define FLUID_MEDIA_H

#include "base/context.h"
#include "base/vec.h"

/* Most levels of a current that changes with depth. */
enum { CURRENT_LEVELS = 16 };

/* A current that changes with depth: linear between levels, constant above the first and below the last. */
typedef struct current_profile {
    int32_t count;                 /* 0: uniform */
    double depth[CURRENT_LEVELS];  /* below still water, ascending, different [m] */
    vec3 velocity[CURRENT_LEVELS]; /* on top of the current at the surface [m/s] */
} current_profile;

/* A velocity that changes with time: its components are linear between rows, constant before the first and after the
   last one. */
typedef struct velocity_series {
    int32_t count;  /* 0: none */
    double *time;   /* ascending, different [s] */
    vec3 *velocity; /* [m/s] */
} velocity_series;

/* What is known of the media beforehand, beyond what stays as it is. */
typedef struct media_history {
    velocity_series current, wind; /* in place of the constant ones */
    velocity_series drift;         /* of ice far away; none: it goes as the scenario says */
    current_profile profile;
} media_history;

void velocity_series_free(context *ctx, velocity_series *s);
void media_history_free(context *ctx, media_history *h);
vec3 velocity_series_at(const velocity_series *s, double time);

/* State of the media at one instant. Directions are velocities towards, global frame. */
typedef struct media {
    double gravity;       /* [m/s2], down */
    double water_density; /* [kg/m3] */
    double air_density;   /* [kg/m3] */
    vec3 current;         /* [m/s] */
    vec3 wind;            /* [m/s] */
    current_profile profile;
} media;

/* The state at a time, `still` being what does not change. */
media media_at(const media *still, const media_history *history, double time);
/* Current at a height over still water (0 or less; above it, that of the surface) [m/s]. */
vec3 media_current(const media *m, double height);
/* The one current that a hull as a whole meets, where tables or matrices know no other: at half its draught, whose
   depth below still water is given [m]. */
static inline vec3 media_hull_current(const media *m, double depth) { return media_current(m, -depth); }

/* Drag of one body's surface: form -1/2 rho Cd A |vn| vn n on faces moving into the medium, skin -1/2 rho Cf A |vt| vt
   (docs/theory.md, Water and air). */
typedef struct drag_coefficients {
    double water_form, water_skin; /* [1] */
    double air_form, air_skin;     /* [1] */
} drag_coefficients;

#endif
