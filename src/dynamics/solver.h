/* The multibody solve of one step: new velocities from forces, contacts and joints; and the split-impulse
   position correction (Metrikin 2014; docs/theory.md).  Several solvers stand behind this interface and can run the
   same scene. */
#ifndef DYNAMICS_SOLVER_H
#define DYNAMICS_SOLVER_H

#include "dynamics/contact.h"
#include "dynamics/joint.h"

typedef enum solver_kind {
    SOLVER_SEQUENTIAL = 0, /* projected Gauss-Seidel in contact order: the reference */
    SOLVER_FAST,           /* the fast default (batches, SIMD, threads) */
    SOLVER_ACCURATE        /* run to a tight tolerance, to judge the others by */
} solver_kind;

typedef struct solver_settings {
    solver_kind kind;
    int32_t iterations;          /* velocity sweeps */
    int32_t position_iterations; /* position correction sweeps */
    bool warm_start;
    double correction_rate;  /* beta_0 of the position correction, 0.8 */
    double contact_skin;     /* bodies nearer than this touch: gaps close down to it, no more [m] */
    bool baumgarte;          /* comparison switch: correct overlap through velocity instead */
    double tolerance;        /* accurate: stop when the largest residual is below this; fast: sweeps that change no
                                velocity by more are the last [m/s] */
    int32_t most_iterations; /* SOLVER_ACCURATE: upper bound */
} solver_settings;

typedef struct solver_report {
    double residual;              /* largest complementarity residual of the normal rows [m/s], after the last sweep */
    double mean_depth, max_depth; /* [m], over the contacts that overlap */
    int32_t overlapping;          /* their number: contacts with depth >= 0 */
    int32_t iterations;
} solver_report;

typedef struct solver solver; /* scratch, never state */
solver *solver_create(context *ctx);
void solver_free(context *ctx, solver *s);

/* Velocities of dynamic bodies become those at the end of the step: M du = loads dt + J^T p (the gyroscopic moment acts
   in integrate_poses), with 0 <= p_n <= impulse_limit, Coulomb cone (mu_s while sticking, mu_k once sliding) on the
   capped p_n, joints free-signed. Writes contact impulses, joint impulses and reactions; memory in: last step's, out:
   this step's impulses. loads: one wrench per body slot (gravity included). */
fram_status solver_solve(context *ctx, solver *s, const solver_settings *settings, double dt, body_table *bodies,
                         const wrench *loads, joint_table *joints, contact_array *contacts,
                         contact_memory_table *memory, solver_report *report, fram_error *error);

/* Positions and orientations by the solved velocities: r += dt v, Q += dt/2 (0, Omega) Q, normalised.  The gyroscopic
   moment acts here, on the free turning of each dynamic body: Omega is the mean over the step, and the angular velocity
   afterwards is that at the new orientation, so that energy and angular momentum of a free body are kept to rounding.
 */
void integrate_poses(context *ctx, body_table *bodies, double dt);

/* Split impulse on positions: normal rows only, p* >= 0, b = beta depth / dt, beta = min(beta_0, 1 - p_n/p_lim), never
   below 0; contacts with `correct` false are left alone.  Locked joints are drawn together by beta_0 of their error.
   Moves poses, adds no velocity.  Contacts must name living bodies: set `correct` false on those of a body that broke
   in this step.  Overlaps under a hundredth of the contact skin alone move nothing. */
fram_status solver_correct_positions(context *ctx, solver *s, const solver_settings *settings, double dt,
                                     body_table *bodies, const joint_table *joints, const contact_array *contacts,
                                     fram_error *error);

#endif
