/* The outlines of a hull's parts, seen from above, as one.  Knows no ice and no files. */
#ifndef VESSEL_HULL_PLAN_H
#define VESSEL_HULL_PLAN_H

#include "geometry/overlay.h"

/* Appends what overlay_union would, with its errors, but united are only parts that lie together: the time goes by the
   parts that do, and not with the square of all, as of the members of a jacket.  Whoever asks to stop is not heard. */
fram_status hull_plan_unite(context *ctx, overlay *o, const polygon_list *parts, polygon_list *out, fram_error *error);

#endif
