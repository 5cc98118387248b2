/* Whether the numbers of a state that name rows of tables, kinds and counts can be what they say: what a file may get
   wrong behind a checksum that fits.  Says nothing about physics but that places, velocities and sizes can be some. */
#ifndef MODEL_WORLD_CHECK_H
#define MODEL_WORLD_CHECK_H

#include "model/world.h"

/* FRAM_ERROR_INPUT with the table, row and field as key.  m: the model that the world shall be stepped with. */
fram_status world_check(const model *m, const world *w, fram_error *error);
/* The same where a place or velocity is not finite or beyond all, ice has no area, thickness or strength, or an
   invariant is broken (world_invariants.h).  Not for the state of a step that failed, which may have failed by that. */
fram_status world_check_numbers(const model *m, const world *w, fram_error *error);

#endif
