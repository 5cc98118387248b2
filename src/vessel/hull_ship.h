/* The hull of a merchant ship of full form (tanker, FPSO, drillship): flat of side and bottom, bulbless, with rounded
   entrance, run and bilge, a raked stem and a raked transom.  Knows no ice and no files. One module with hull and
   hull_cone, all of them forms.

   Half its breadth is b g(x) - d(z): the waterline b g, moved along x with the rake of stem and stern, less what the
   bilge takes.  Both parts are polygons and concave, so that every facet is plane, the hull convex, its one convex
   piece exact, and its volume a sum of polynomials. */
#ifndef VESSEL_HULL_SHIP_H
#define VESSEL_HULL_SHIP_H

#include "vessel/hull.h"

/* Replace NaN in stem_angle, stern_angle, flare_angle, bilge_radius and transom by what is usual; entrance_angle and
   parallel_midbody may stay NaN: they then follow from the block coefficient. */
void hull_ship_fill(hull_particulars *p);
/* FRAM_ERROR_INPUT names the particular that does not fit; a block coefficient out of reach is told with its range. */
fram_status hull_ship_check(const hull_particulars *p, fram_error *error);
/* FRAM_ERROR_INPUT, of any form: a block coefficient beyond what the other particulars leave.  remedy: what a larger
   one takes, and a smaller one. */
fram_status hull_block_refuse(double least, double most, double asked, const char *remedy, fram_error *error);
/* The least and the largest block coefficient that the other particulars leave. */
void hull_ship_block_range(const hull_particulars *p, double *least, double *most);
/* Lengths of entrance and run at the waterline [m]. */
void hull_ship_ends(const hull_particulars *p, double *entrance, double *run);
/* Closed surface in ship coordinates; false: no memory. */
bool hull_ship_make(context *ctx, const hull_particulars *p, mesh *surface);

#endif
