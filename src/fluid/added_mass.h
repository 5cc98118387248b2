/* Added mass of simple bodies from the literature: thin plates on the water (floes) and ellipsoids (ships).
   Knows no tables. */
#ifndef FLUID_ADDED_MASS_H
#define FLUID_ADDED_MASS_H

#include "fluid/matrix6.h"
#include "geometry/polygon.h"

/* In heave [kg], and in roll and pitch about the outline's own x and y [kg m2]. */
typedef struct plate_added_mass {
    double heave, roll, pitch;
} plate_added_mass;

/* A thin plate that floats on deep water and moves quickly, so that the surface beside it yields (zero potential): half
   of that of the plate deep under water.  Heave: the rectangle of the same area and the same ratio of second moments,
   m = 1/2 C (pi/4) rho a^2 b for sides a <= b (DNV-RP-C205 2010, table D-2: C = 0.579 for a square, 1 for a strip;
   linear in a/b between its rows); 10 x 10 m: 233 t.  Roll and pitch: m (8/15) (second moment / area), which is the
   disc's (16/45) rho r^5 (Lamb 1932, section 102) and 1.4 times the strip's about its long axis.  Surge, sway and yaw
   have none: a plate is thin. */
plate_added_mass plate_added_mass_of(const polygon_moments *outline, double water_density);

/* The lower half of an ellipsoid of semi-axes a, b, c along x, y, z, its middle plane in still water: half of that of
   the whole ellipsoid, for a volume of `volume` instead of (2/3) pi a b c, about its centre (Lamb 1932, sections 114
   and 115, with Carlson's integral for alpha_0).  The whole one's flow does not cross the middle plane in surge, sway
   and yaw, which is right for slow motion (rigid lid); in heave, roll and pitch it has no potential there, which is
   right for quick motion. */
matrix6 ellipsoid_added_mass(vec3 semi_axes, double volume, double water_density);

#endif
