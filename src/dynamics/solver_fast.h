/* The fast solver from inside: one module in four files, which call each other through this header and nothing else
   does. solver_fast_rows.c fills rows, solver_fast_warm.c starts from the last impulses, solver_accelerate.c steps
   along the directions of sweeps, solver_fast.c tells the order of it all; what they share is struct fast_rows. */
#ifndef DYNAMICS_SOLVER_FAST_H
#define DYNAMICS_SOLVER_FAST_H

#include "dynamics/solver_batch.h"
#include "dynamics/solver_rows.h"
#include "dynamics/solver_sweep_kernel.h"

/* Rows of eight doubles on cache lines: `rows` points into `memory`. */
typedef struct aligned_rows {
    double *rows;
    ARRAY(double) memory;
} aligned_rows;

/* What changes in a sweep: velocities of body rows, impulses of contacts, impulses of joints. */
enum { VECTOR_VELOCITY, VECTOR_IMPULSE, VECTOR_JOINT, VECTORS };

/* One of these: where the last sweeps began, what they are rolled back to when they fail, and the search
   directions. */
typedef struct sweep_vector {
    aligned_rows *x;
    int64_t count; /* doubles, a multiple of eight */
    aligned_rows start, kept, store[SEARCH_DIRECTIONS - 1];
    double *direction[SEARCH_DIRECTIONS]; /* from the newest, 1, to the oldest; 0 stands for that since `start` */
} sweep_vector;

typedef struct acceleration {
    sweep_vector vector[VECTORS];
    double product[SEARCH_DIRECTIONS][SEARCH_DIRECTIONS]; /* of directions */
    double wanted_along[SEARCH_DIRECTIONS], wanted_start;
    double kept_value, kept_energy, kept_wanted;
    double free_value;  /* f without impulses */
    double step_limit;  /* longest step, in directions */
    double predicted;   /* decrease of f by the last step if it was shortened, else 0 */
    double scale;       /* largest product of the velocities with themselves */
    int32_t directions; /* remembered */
    int32_t pause;      /* sweeps to the next step */
} acceleration;

typedef struct fast_rows {
    batch_plan plan;
    aligned_rows velocity, inverse, tensor; /* of each body row */
    aligned_rows driven;                    /* the part of velocities that no impulse changes; for the sums `wanted` */
    aligned_rows mass, inertia;             /* the same, not inverted: xx yy zz xy xz yz; zero for copies of a hub */
    aligned_rows frame, point, impulse;
    aligned_rows work, share;      /* a row for each batch */
    aligned_rows bias, correction; /* position correction: a row for each point */
    aligned_rows joint_impulse;    /* a row for each joint */
    acceleration acceleration;
    int32_array joint_row;            /* body row of each entry of solver.bodies */
    int32_array island;               /* of each body row: the row that leads its island, see solver_warm.c */
    int32_array lane_island;          /* of each lane of each batch, -1: nothing in it can move */
    ARRAY(energy_gain) gain;          /* of each body row that leads an island */
    ARRAY(direction_products) blocks; /* sums of each block of body rows */
    int32_t planned;                  /* number of contacts that the rows were made for, -1: none */
} fast_rows;

/* What a stage of the work needs; each uses a part. */
typedef struct stage {
    solver *s;
    batch_view view;
    const body_table *bodies;
    body_table *moved; /* the same, for those that may move them or change their velocities */
    const contact_array *contacts;
    contact_array *results;
    const contact_memory_table *memory; /* NULL: start cold */
    const solver_settings *settings;
    double dt;
    const double *share; /* of solver_push */
    double free_energy;  /* of the bodies without impulses */
    bool positions;      /* position correction, not velocities */
    bool weighs;         /* sweeps of velocities sum up `wanted` too */
    int32_t first_task;
    void (*run)(const struct stage *, batch_task *);
} stage;

/* ---- solver_fast.c ---- */

/* Runs a stage that only reads bodies on all tasks. */
void stage_run(stage *st, void (*run)(const stage *, batch_task *));
/* Runs a stage that moves bodies, one colour after the other. */
void stage_run_colours(stage *st, void (*run)(const stage *, batch_task *));
/* Joints keep their own list of bodies (solver_rows.h), which borrows velocities from the rows. */
void joints_borrow(solver *s);
void joints_return(solver *s);

/* ---- solver_fast_rows.c ---- */

/* At least so many rows, contents undefined; false: no memory. */
bool rows_reserve(context *ctx, aligned_rows *r, int64_t rows);
void rows_clear(aligned_rows *r, int64_t rows);
static inline double *row_of(const aligned_rows *r, int32_t row) { return r->rows + (ptrdiff_t)BATCH_LANES * row; }
/* Body rows are worked in groups of eight; rows beyond the last body are zero. */
static inline int32_t padded_rows(const fast_rows *f)
{
    return (f->plan.slot.count + BATCH_LANES - 1) / BATCH_LANES * BATCH_LANES;
}
batch_view fast_view(const fast_rows *f);

/* Rows of the bodies in the plan, and of joints' bodies; velocities as in the table. */
bool fast_bodies_make(stage *st);
void fast_velocities_load(stage *st);
void fast_velocities_store(stage *st);
/* From here on velocities, those of bodies that nothing moves included, are relative to the mean of all that is
   movable: what is judged by energies is then the same in every frame, and a common drift costs no digits. */
void fast_velocities_centre(fast_rows *f);
/* Takes the driven part of velocities out of the rows, once they are loaded and centred. */
void fast_driven_make(stage *st);
/* Kinetic energy of the body rows. */
double fast_energy(const fast_rows *f);
/* Rows of bodies and contacts. */
bool fast_rows_make(stage *st);
/* contact_reach_cap for all points of guided bodies, after the warm start. */
void fast_rows_reach_caps(stage *st);
/* Whether the rows of a batch are still those of its contacts: bodies, normals, arms. */
bool fast_batch_fits(const stage *st, int32_t number);

/* ---- solver_fast_warm.c ---- */

/* Impulses in the rows are within bounds and applied as far as they give no energy.  false: no memory. */
bool fast_warm_start(stage *st);
/* Velocities anew from those of the table and all impulses, so that what many steps of rounding have drawn apart is one
   again and momentum is kept. */
void fast_velocities_of_impulses(stage *st);

/* ---- solver_accelerate.c ---- */

/* Before the first sweep.  x: multipliers of contacts, `rows` of them.  false: no memory. */
bool acceleration_begin(stage *st, aligned_rows *x, int64_t rows);
/* What the impulses now in the rows ask for: the sum `wanted` of a sweep. */
double acceleration_wanted(stage *st);
/* After sweeps that took `energy` and left `wanted`: takes a step along their directions, or rolls back what failed.
   false: nothing is left to do. */
bool acceleration_go_on(stage *st, double energy, double wanted);
/* After the last sweep: rolls back what failed.  false: the impulses still give energy to the bodies. */
bool acceleration_end(stage *st, double energy, double wanted);
void acceleration_free(context *ctx, acceleration *a);

#endif
