/* A picture of a running simulation: the field from above. */
#ifndef SIM_PICTURES_H
#define SIM_PICTURES_H

#include "model/scenario.h"
#include "model/world.h"

/* Plan view of the world now, the domain in full, to `path`. */
fram_status picture_plan(context *ctx, const scenario *s, const world *w, const char *path, fram_error *error);

#endif
