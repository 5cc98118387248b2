/* The rows of the fast solver: bodies in rows of eight doubles, contacts in batches of eight lanes.  Inside dynamics.

   A lane of a batch is a group: up to four points of two bodies with one normal.  The lanes of a batch share no body
   that can be moved, so they are solved at once; the points of a lane one after the other.  Batches belong to tasks,
   tasks to colours: tasks of one colour share no movable body, so they run on any thread in any order with the same
   result.  Which group goes where follows from the contacts and the bodies' places alone.

   A hub is a body with more groups than fit into colours, such as a vessel amid its floes.  Its batches hold its groups
   in all lanes: each lane gets a copy of the hub with an eighth of its mass, and after the batch the hub moves as the
   mean of the copies (mass splitting: Tonge, Benevolenski and Voroshilov 2012).  Momentum is kept, energy never grows,
   and a hub that is heavy against its neighbours loses nothing by it.

   Bodies that nothing can move have no mass in the rows; each task has its own copy of them, so that no two threads
   write to one row. */
#ifndef DYNAMICS_SOLVER_BATCH_H
#define DYNAMICS_SOLVER_BATCH_H

#include "base/array.h"
#include "bodies/body.h"
#include "dynamics/contact.h"

enum { BATCH_LANES = 8, BATCH_MOST_POINTS = CONTACT_GROUP_POINTS };

/* Places in a body's rows. */
enum { BODY_VELOCITY = 0, BODY_SPIN = 3, BODY_ROW = 8 }; /* `velocity`: global frame */
/* `inverse`: xx yy zz xy xz yz; 1/m; 1 for a mass that depends on the direction */
enum { INVERSE_INERTIA = 0, INVERSE_MASS = 6, INVERSE_GENERAL = 7, INVERSE_ROW = 8 };
enum { TENSOR_GIVE = 6, TENSOR_ROW = 8 }; /* `tensor`: inverse mass as xx yy zz xy xz yz; give of a guided body */

/* Rows of eight lanes that a batch has once, */
enum { FRAME_NORMAL = 0, FRAME_STATIC = 3, FRAME_KINETIC = 4, FRAME_ROWS = 5 };
/* and once for each of its points: arms from the centres of mass; least relative normal velocity after the step; cap;
   then what solver_prepare makes of them: 1 / (n K n), the tangents' answer to a normal impulse, inverse of the tangent
   block (11, 12, 22), step of the projected tangent impulse, and the impulse that would stop the sliding of before the
   step. */
enum {
    POINT_ARM_A = 0,
    POINT_ARM_B = 3,
    POINT_BIAS = 6,
    POINT_LIMIT = 7,
    POINT_MASS = 8,
    POINT_COUPLING = 9,
    POINT_STICK = 11,
    POINT_SLIDE = 14,
    POINT_SLIP = 15,
    POINT_ROWS = 16
};
/* Normal, tangent 1, tangent 2 (contact_tangents). */
enum { IMPULSE_ROWS = 3 };

typedef struct contact_batch {
    int32_t a[BATCH_LANES], b[BATCH_LANES];          /* body rows */
    int32_t contact[BATCH_MOST_POINTS][BATCH_LANES]; /* rows of the contact array, -1: none */
    int32_t points;                                  /* of each lane, some may be missing */
    int32_t first;                                   /* number of its first point */
    int32_t hub, copies;                             /* body row of the hub, first of its eight copies; -1 without */
    bool general;                                    /* some body has a mass that depends on the direction */
    bool driven;                                     /* some body has a velocity that no impulse changes */
    bool overlaps;                                   /* position correction: there is overlap to correct */
} contact_batch;

/* What kernels work on. */
typedef struct batch_view {
    double *velocity;
    const double *driven; /* the part of velocities that no impulse changes */
    const double *inverse, *tensor;
    const contact_batch *batch;
    const double *frame;
    double *point, *impulse;
} batch_view;

typedef struct batch_task {
    int32_t colour;
    int32_t first, end;             /* batches */
    int32_t first_group, end_group; /* places in the order of groups */
    int32_t hub;                    /* number of its hub, -1 without */
    /* What kernels sum up over the task, see solver_sweep_kernel.h. */
    double energy, wanted, residual, slide[4];
    bool fits; /* its rows are still those of the contacts */
} batch_task;

/* Contacts of one block in a row that belong together; `continues`: with the last ones of the block before, too. */
typedef struct contact_run {
    int32_t a, b; /* body slots */
    int32_t first, count;
    bool continues;
} contact_run;

/* Points of one pair of bodies with one normal. */
typedef struct contact_group {
    int32_t first, count; /* contacts */
    int32_t task;
} contact_group;

/* The row of a body that nothing moves where it bends under one group. */
typedef struct bending_edge {
    int32_t row, contact; /* contact: the first of its group */
} bending_edge;

typedef struct batch_plan {
    /* of each body slot */
    int32_array degree; /* its groups */
    int32_array chunk;  /* region of a movable body; -1 - number for a hub */
    int32_array row;    /* of a movable body; of others that of the task at hand */
    int32_array owner;  /* of other bodies: the task that `row` belongs to */
    /* */
    int32_array touched;     /* slots of movable bodies in order of their first contact */
    int32_array hubs;        /* slots */
    ARRAY(contact_run) runs; /* of each block of contacts, from the place of its first contact on */
    int32_array run_count;   /* of each block */
    ARRAY(contact_group) groups;
    int32_array order; /* groups by task */
    int32_array slot;  /* of each body row, -1 for the world and for copies of a hub */
    ARRAY(bending_edge) edges;
    ARRAY(uint64_t) within; /* of each body row: open batches that hold it */
    ARRAY(contact_batch) batches;
    ARRAY(batch_task) tasks;
    int32_array code, code_count;    /* of tasks before they are numbered */
    int32_array colour_end;          /* number of tasks up to the end of each colour */
    int32_t chunks, points, movable; /* movable: rows that are written back, the first ones */
} batch_plan;

/* Groups, tasks, body rows and batches of the contacts that can move something.  false: no memory. */
bool batch_plan_make(context *ctx, batch_plan *plan, const body_table *bodies, const contact_array *contacts);
void batch_plan_free(context *ctx, batch_plan *plan);
/* The row of a body outside all batches (of joints), made when there is none; -1 without memory. */
int32_t batch_plan_row(context *ctx, batch_plan *plan, const body_table *bodies, int32_t slot);

/* Cuts bodies into `*chunks` regions of the plane that hold about equally many; region[slot] is written for the given
   slots.  By their places, and by how many groups of contacts there are, alone. */
void bodies_partition(const body_table *bodies, const int32_t *slots, int32_t count, int32_t groups, int32_t *region,
                      int32_t *chunks);
enum { PARTITION_MOST = 64 };

#endif
