/* Pictures of a run: the field from above, and the loads over time. */
#ifndef SIM_PICTURES_H
#define SIM_PICTURES_H

#include "model/scenario.h"
#include "model/world.h"

/* Plan view of the world now, the domain in full, to `path`. */
fram_status picture_plan(context *ctx, const scenario *s, const world *w, const char *path, fram_error *error);
/* Ice load on the vessel over time, raw and averaged, from FOLDER/series.csv to FOLDER/loads.png. */
fram_status picture_loads(context *ctx, const scenario *s, const char *folder, fram_error *error);

#endif
