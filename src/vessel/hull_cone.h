/* The hull of a conical drilling unit: an inverted cone of flat facets, in the manner of the Kulluk (Wright 1999).
   Knows no ice and no files. One module with hull, of which it is a form. */
#ifndef VESSEL_HULL_CONE_H
#define VESSEL_HULL_CONE_H

#include "vessel/hull.h"

/* The Kulluk's number. */
enum { CONE_FACETS = 24 };

/* Of the particulars count length (diameter of the waterline over corners; the beam is the same), draught, freeboard
   and flare_angle (of the sides against the vertical, from keel to deck).  FRAM_ERROR_INPUT names the one that does not
   fit. */
fram_status hull_cone_check(const hull_particulars *p, fram_error *error);
/* Closed surface in ship coordinates, corners at the bow and every 15 degrees; false: no memory. */
bool hull_cone_make(context *ctx, const hull_particulars *p, mesh *surface);

#endif
