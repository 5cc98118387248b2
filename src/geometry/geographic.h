/* Geographic coordinates as planar lengths: the oblique stereographic projection of the ellipsoid through the conformal
   sphere (IOGP Guidance Note 7-2, method 9809; "double stereographic").  It keeps angles; lengths at a distance r from
   its centre are too long by (r / 2R)^2, 6e-5 at 100 km. */
#ifndef GEOMETRY_GEOGRAPHIC_H
#define GEOMETRY_GEOGRAPHIC_H

#include "geometry/polygon.h"

typedef struct ellipsoid {
    double a, inverse_flattening; /* equatorial radius [m] */
} ellipsoid;
#define ELLIPSOID_WGS84 ((ellipsoid){6378137, 298.257223563})

typedef struct stereographic {
    double eccentricity, n, c;         /* of the ellipsoid; of the conformal sphere [1] */
    double diameter;                   /* 2 R k0 [m] */
    double longitude;                  /* of the centre [rad] */
    double sin_latitude, cos_latitude; /* of the centre on the conformal sphere */
} stereographic;

/* centre: longitude and latitude [deg], within 0.001 degrees of a pole moved to there.  scale: at the centre, 1. */
stereographic stereographic_make(ellipsoid e, vec2 centre_deg, double scale);
/* Longitude and latitude [deg] to lengths east and north of the centre [m]; longitudes may differ by whole turns. */
vec2 stereographic_project(const stereographic *s, vec2 place_deg);

#endif
