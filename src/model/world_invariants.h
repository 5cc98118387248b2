/* What holds of a world whatever happens in it, as far as numbers tell: checked in each step of builds with asserts,
   where a breach is a fault of Fram, and in states that are read (world_check_numbers), where it is the file's. */
#ifndef MODEL_WORLD_INVARIANTS_H
#define MODEL_WORLD_INVARIANTS_H

#include "model/world.h"

enum { INVARIANT_TEXT = 200 };

/* Between two steps: bodies with unit quaternions, positive mass and inertia, shapes that are there, owners that own
   them; pairs and remembered contacts in ascending order; as many rows as the model has vessels.  Writes the first
   thing that does not hold; false when all does. */
bool world_invariant_broken(const model *m, const world *w, char text[INVARIANT_TEXT]);

/* After the solve, before fracture: contacts of two living bodies, one of which can move or which crush, with unit
   normals, impulses from 0 to their limit, and friction in its cone. */
bool contact_invariant_broken(const world *w, char text[INVARIANT_TEXT]);

#endif
