/* Whether the numbers of a state that name rows of tables, kinds and counts can be what they say: what a file may get
   wrong behind a checksum that fits.  Says nothing about physics. */
#ifndef MODEL_WORLD_CHECK_H
#define MODEL_WORLD_CHECK_H

#include "model/world.h"

/* FRAM_ERROR_INPUT with the table, row and field as key.  m: the model that the world shall be stepped with. */
fram_status world_check(const model *m, const world *w, fram_error *error);

#endif
