/* Rigid bodies as plain tables: pose, velocity, mass.  Knows neither why they move nor what they are made for.
   Frames: position is the centre of mass in the global frame (z up, still water at z = 0); orientation turns body
   coordinates into global ones; velocities are global.  SI units. */
#ifndef BODIES_BODY_H
#define BODIES_BODY_H

#include "base/table.h"
#include "base/vec.h"

#include <string.h>

/* A slot is never moved while its body lives; a freed slot is used again with the next generation. */
typedef enum motion {
    MOTION_NONE = 0,   /* free slot */
    MOTION_STATIC,     /* infinite mass, never moves */
    MOTION_PRESCRIBED, /* infinite mass, velocity set from outside each step */
    MOTION_DYNAMIC,    /* moved by forces and contacts */
    MOTION_CARRIED,    /* as prescribed, and one rigid body with all others that are carried: these never meet */
    MOTION_ASLEEP      /* dynamic, but at rest and left alone until something wakes it (dynamics/rest.h) */
} motion;

/* Selects friction and contact treatment of a pair; see dynamics/contact.h. */
typedef enum material { MATERIAL_ICE = 0, MATERIAL_HULL, MATERIAL_WALL, MATERIAL_COUNT } material;

#define BODY_FIELDS(X)                                                                                        \
    X(position, vec3, FIELD_F64, 3, "m", "centre of mass, global frame")                                      \
    X(orientation, quat, FIELD_F64, 4, "1", "body to global, unit quaternion w x y z")                        \
    X(velocity, vec3, FIELD_F64, 3, "m/s", "of the centre of mass, global frame")                             \
    X(angular_velocity, vec3, FIELD_F64, 3, "rad/s", "global frame")                                          \
    X(mass, double, FIELD_F64, 1, "kg", "rigid mass")                                                         \
    X(inertia, sym3, FIELD_F64, 6, "kg m2", "inertia tensor about the centre of mass, body frame")            \
    X(added_mass, vec3, FIELD_F64, 3, "kg", "added mass in surge, sway, heave, body frame; 0 without")        \
    X(added_inertia, vec3, FIELD_F64, 3, "kg m2", "added inertia in roll, pitch, yaw, body frame; 0 without") \
    X(shape, int32_t, FIELD_I32, 1, "1", "row of the shape table, -1 without a shape")                        \
    X(owner, int32_t, FIELD_I32, 1, "1", "row of the owning room's table (floe, vessel), -1 without")         \
    X(generation, uint32_t, FIELD_U32, 1, "1", "how often this slot was used; id = slot + generation")        \
    X(motion, uint8_t, FIELD_U8, 1, "1", "enum motion")                                                       \
    X(material, uint8_t, FIELD_U8, 1, "1", "enum material")

TABLE_DECLARE(body, BODY_FIELDS)

/* External loads of one step: force [N] and moment [N m] about the centre of mass, global frame. Scratch. */
typedef struct wrench {
    vec3 force;
    vec3 moment;
} wrench;

/* A new body in the lowest free slot (so that results depend on order of events only), all fields zero but
   orientation (identity), shape and owner (-1) and generation.  Returns the slot, or -1 without memory. */
int32_t body_create(context *ctx, body_table *bodies, motion kind, material substance);
void body_remove(body_table *bodies, int32_t slot);
static inline bool body_is_alive(const body_table *b, int32_t slot) { return b->motion[slot] != MOTION_NONE; }
static inline bool body_is_dynamic(const body_table *b, int32_t slot) { return b->motion[slot] == MOTION_DYNAMIC; }
/* Dynamic, awake or asleep. */
static inline bool body_is_free(const body_table *b, int32_t slot)
{
    return b->motion[slot] == MOTION_DYNAMIC || b->motion[slot] == MOTION_ASLEEP;
}
/* Ice that something holds: fixed, or of a sheet.  A floe of a field's band is driven and floats as any other. */
static inline bool body_is_held(const body_table *b, int32_t slot)
{
    return b->motion[slot] == MOTION_STATIC || b->motion[slot] == MOTION_CARRIED;
}

/* The first slot of first..end-1 whose body moves or may move in a step (dynamic, prescribed or carried), `end`
   without. What does not is passed over many slots at a time, so that ice at rest costs a walk over bodies next to
   nothing. */
int32_t body_next_moving(const body_table *b, int32_t first, int32_t end);
/* No slot of first..end-1 has a body that moves, and all velocities are +0: none sleeps on ice that drifts. */
bool body_slots_stand(const body_table *b, int32_t first, int32_t end);
/* All slots of first..end-1 have a body. */
static inline bool body_slots_are_taken(const body_table *b, int32_t first, int32_t end)
{
    return !memchr(b->motion + first, MOTION_NONE, (size_t)(end - first));
}

/* Velocity [m/s] of the body's material point now at `point` (global). */
vec3 body_point_velocity(const body_table *b, int32_t slot, vec3 point);
/* The same of one body against another. */
vec3 body_velocity_past(const body_table *b, int32_t slot, int32_t other, vec3 point);
/* Global -> body coordinates of a point, and back. */
vec3 body_to_local(const body_table *b, int32_t slot, vec3 point);
vec3 body_to_global(const body_table *b, int32_t slot, vec3 point);

/* Add a force acting at a global point to a wrench about `centre`. */
static inline void wrench_add(wrench *w, vec3 centre, vec3 force, vec3 point)
{
    w->force = vec3_add(w->force, force);
    w->moment = vec3_add(w->moment, vec3_cross(vec3_sub(point, centre), force));
}

/* Books over bodies: kinetic energy [J], momentum [N s], angular momentum about the global origin [N m s].
 */
typedef struct body_books {
    double kinetic_energy;
    vec3 momentum, angular_momentum;
    double mass;
} body_books;
/* Adds one body's to the books, when it is dynamic, awake or asleep. */
void body_books_add(const body_table *b, int32_t slot, body_books *sum);

#endif
