/* Ice that rests is put to sleep: a body that has been slow for a while, and that nothing about it moves, stands still
   and is left alone (MOTION_ASLEEP: no loads, no integration, no pairs with what cannot move) until something wakes it
   (docs/decisions/0350).  Knows no vessels and no water: hulls are bodies of another material, media are two vectors.
   Where a sheet drifts, rest is rest in its frame: what sleeps is carried along with it (docs/decisions/0510).

   What wakes a body: a body of another material that can move in reach of its box; a body that touches it and is faster
   than twice the speed at which it fell asleep; pushes of bodies that touch it, beyond the mean of those it has slept
   under, by which it would have come to that speed; something within its box that was taken away, cut or let go;
   another wind or current; a sheet that changes its velocity too fast; and whoever asks for it. */
#ifndef DYNAMICS_REST_H
#define DYNAMICS_REST_H

#include "bodies/shape.h"
#include "dynamics/contact.h"

typedef struct rest_settings {
    double speed; /* of the centre plus that of the rim about it; 0: nothing sleeps [m/s] */
    double time;  /* for which a body must be slower before it sleeps; also how long pushes are remembered [s] */
} rest_settings;

/* The media that a body meets, and what rest is. */
typedef struct rest_media {
    vec3 wind, current; /* past what rests [m/s] */
    vec3 ground;        /* velocity of what rests: that of the sheet, which does not turn; 0 without one [m/s] */
    double slack;       /* changes of wind and current up to this wake nothing [m/s] */
    double swerve;      /* a change of the ground in a step beyond this wakes all [m/s] */
    bool calm;          /* neither moves anywhere past what rests */
} rest_media;

/* Of a body in contact: BUSY with something that keeps it awake, HELD by an impulse.  Of one asleep: it RECALLS pushes,
   or fell asleep so lately that its means are still young; the columns of pushes of all others are zero. */
enum { REST_BUSY = 1, REST_HELD = 2, REST_RECALLS = 4 };

/* A row for each body slot, or none.  Of a body asleep push, turn and what follows them tell what bodies awake do to
   it. */
#define REST_FIELDS(X)                                                                         \
    X(generation, uint32_t, FIELD_U32, 1, "1", "of the body that the row tells of; 0: none")   \
    X(touch, uint8_t, FIELD_U8, 1, "1", "REST_BUSY, REST_HELD, REST_RECALLS")                  \
    X(still, double, FIELD_F64, 1, "s", "time for which it has been slow")                     \
    X(wind, vec3, FIELD_F64, 3, "m/s", "past it as it fell asleep")                            \
    X(current, vec3, FIELD_F64, 3, "m/s", "past it as it fell asleep")                         \
    X(push, vec3, FIELD_F64, 3, "N s", "impulse in the last step, global frame")               \
    X(turn, vec3, FIELD_F64, 3, "N m s", "the same of the moment about its centre of mass")    \
    X(age, double, FIELD_F64, 1, "s", "time over which the means are taken, up to their most") \
    X(mean_push, vec3, FIELD_F64, 3, "N s", "mean impulse of a step")                          \
    X(mean_turn, vec3, FIELD_F64, 3, "N m s", "the same of the moment")                        \
    X(gain, vec3, FIELD_F64, 3, "N s", "sum of impulses beyond their mean, fading with time")  \
    X(spin, vec3, FIELD_F64, 3, "N m s", "the same of the moment")
TABLE_DECLARE(rest, REST_FIELDS)

/* The media in which all that sleeps is known to be undisturbed: memory that saves a look at each, never state.  {0}:
   nothing is known. */
typedef struct rest_seen {
    rest_media media;
    bool known;
} rest_seen;

/* A body that is asleep moves freely again; nothing happens to others. */
void rest_wake(body_table *bodies, rest_table *rest, int32_t slot);

/* Before the boxes of the broad phase are renewed: wakes what lies in the box of a body that is gone (one that is cut
   or let go is another body), and what fell asleep in other media; what sleeps on gets the velocity of the ground.
   false: no memory.  Nothing happens with a speed of 0, here and below. */
bool rest_follow(context *ctx, const rest_settings *settings, const rest_media *media, body_table *bodies,
                 const broad_table *boxes, rest_table *rest, rest_seen *seen);
/* With the pairs of the step: wakes, and keeps awake, what a body of another material, or one that
   is driven, may reach. */
void rest_wake_near(const rest_settings *settings, body_table *bodies, const pair_table *pairs, rest_table *rest);
/* With the contacts of the step, before they are solved: wakes what is struck, or rubbed. */
void rest_wake_struck(const rest_settings *settings, const rest_media *media, body_table *bodies,
                      const contact_array *contacts, rest_table *rest);
/* With solved contacts: who has been slow for how long, who touches what, what pushes those that are asleep; wakes
   those that would have come to move. */
void rest_note(const rest_settings *settings, const rest_media *media, double dt, body_table *bodies,
               const shape_store *shapes, const contact_array *contacts, rest_table *rest);
/* At the end of a step: puts to sleep what rests.  contacts: those of the step. */
void rest_settle(const rest_settings *settings, const rest_media *media, body_table *bodies,
                 const contact_array *contacts, rest_table *rest, rest_seen *seen);

#endif
