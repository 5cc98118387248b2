/* What a world is told from outside while it is stepped, as far as it does not stand in the tables of vessels,
   stations, lines and thrusters: a row each, and no row as long as nobody tells anything.  It is state: copied,
   written, hashed (a world that was told nothing has the hash of one that could not be told).  No physics. */
#ifndef MODEL_INPUTS_H
#define MODEL_INPUTS_H

#include "base/table.h"
#include "base/vec.h"

typedef enum input_kind {
    INPUT_WIND = 0, /* first: velocity in place of the scenario's, second: 1 in the components that were told [m/s] */
    INPUT_CURRENT,  /* the same at the surface */
    INPUT_DRIFT,    /* the same of the far field */
    INPUT_FORCE,    /* which: vessel; force and moment in every step until another is told */
    INPUT_WRENCH,   /* which: body slot; force and moment in the next step alone */
    INPUT_KIND_COUNT
} input_kind;

#define INPUT_FIELDS(X)                                                               \
    X(kind, int32_t, FIELD_I32, 1, "1", "enum input_kind")                            \
    X(which, int32_t, FIELD_I32, 1, "1", "what it is for: see the kind; otherwise 0") \
    X(first, vec3, FIELD_F64, 3, "m/s, N", "velocity or force, global frame")         \
    X(second, vec3, FIELD_F64, 3, "N m, 1", "moment about the centre of mass, global frame; or what was told")
TABLE_DECLARE(input, INPUT_FIELDS)

/* Row of an input, -1 while nobody told it. */
int32_t input_find(const input_table *inputs, input_kind kind, int32_t which);
/* The same, with a zero row made where there is none; -1 without memory. */
int32_t input_row(context *ctx, input_table *inputs, input_kind kind, int32_t which);
/* Tells one component of a velocity, axis 0 to 2; the others stay as they are.  false: no memory. */
bool input_tell(context *ctx, input_table *inputs, input_kind kind, int axis, double value);
/* Of a velocity: the components that were told, the others as they are without. */
vec3 input_velocity(const input_table *inputs, input_kind kind, vec3 without);
/* Forget all rows of a kind; the others keep their order. */
void input_drop(input_table *inputs, input_kind kind);

#endif
