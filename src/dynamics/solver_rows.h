/* The rows that all solvers work on, made anew each step: bodies that are touched, contact rows, joint blocks.
   Inside dynamics; solver.h is the interface.

   A direction of a contact or a joint between bodies a and b acts with +impulse on one and -impulse on the other.
   Contacts push a along +normal; joints push b along +direction. One module with solver and joint: their headers are
   its face. */
#ifndef DYNAMICS_SOLVER_ROWS_H
#define DYNAMICS_SOLVER_ROWS_H

#include "dynamics/joint.h"
#include "dynamics/solver.h"

/* A body that a contact or joint touches.  Inverse tensors are in the global frame, added mass included, zero for
   static and prescribed bodies. */
typedef struct solver_body {
    vec3 velocity, angular_velocity;
    sym3 inverse_mass, inverse_inertia;
    int32_t slot;  /* -1: the world */
    bool guided;   /* only its free mass stands here (solver_guided.c) */
    double give;   /* of a guided body: added to the inverse mass that a contact's own row sees [1/kg] */
    double recoil; /* of an edge that bends: along z, added to the velocity of its body [m/s] */
} solver_body;

/* One direction at a point: relative velocity = direction . (v_a - v_b) + arm_a . w_a - arm_b . w_b. */
typedef struct row_axis {
    vec3 direction, arm_a, arm_b;
    vec3 linear_a, linear_b; /* change of a's velocity (and minus that of b's) per impulse */
    vec3 angular_a, angular_b;
} row_axis;

typedef struct contact_row {
    int32_t a, b;       /* places in the body array */
    int32_t contact;    /* row of the contact array */
    row_axis axis[3];   /* normal, two tangents */
    double normal_mass; /* 1 / (n . K n) */
    double bias;        /* least relative normal velocity after the step [m/s] */
    double limit;       /* cap of the normal impulse */
    double friction_static, friction_kinetic;
    double slip;     /* speed of sliding before the step [m/s] */
    double stick[3]; /* inverse of the 2 x 2 tangent block: 11, 12, 22 */
    double slide;    /* step of the projected tangent impulse, 2 / trace of the tangent block */
    double impulse[3];
} contact_row;

enum { JOINT_MOST_ROWS = 6 };

/* A joint's rows, solved together. */
typedef struct joint_block {
    int32_t body, base; /* places of the joint's b, which is pushed, and a */
    int32_t joint;
    int32_t count;                   /* of rows */
    int32_t motion[JOINT_MOST_ROWS]; /* row i locks this motion (bit of the mask); spring: 0 */
    row_axis axis[JOINT_MOST_ROWS];
    double factor[JOINT_MOST_ROWS][JOINT_MOST_ROWS]; /* L below, 1/D on the diagonal of K + softness = L D L^T */
    double error[JOINT_MOST_ROWS];                   /* of position [m], [rad]; 0 for a spring */
    double bias[JOINT_MOST_ROWS];                    /* wanted: relative velocity = -bias - softness impulse */
    double softness;
    double impulse[JOINT_MOST_ROWS];
} joint_block;

/* A body whose rotations, and some of its translations, are driven by the one joint it has. */
typedef struct guided_body {
    joint_block block;                  /* made with the whole mass */
    int32_t place;                      /* in the body array */
    sym3 inverse_mass, inverse_inertia; /* whole, global frame */
    sym3 mass;                          /* in the free directions, zero in the others */
    vec3 axis[3];                       /* of the locked translations */
    int locked;                         /* their number */
} guided_body;

/* What the impulses of the last step would do to the energy of an island. */
typedef struct energy_gain {
    double linear, square;
} energy_gain;

struct solver {
    context *ctx;
    ARRAY(solver_body) bodies;
    int32_array place; /* of each body slot in `bodies`, -1: not touched */
    ARRAY(contact_row) contacts;
    ARRAY(joint_block) joints; /* but those of guided bodies */
    ARRAY(guided_body) guided;
    ARRAY(double) before;    /* accurate solver: multipliers before a sweep */
    ARRAY(double) direction; /* accurate solver: search direction */
    int32_array island;      /* of each touched body: one nearer to the island's leader, itself for the leader */
    ARRAY(energy_gain) gain; /* of each leader */
    ARRAY(vec3) recalled;    /* of each contact: impulse of the last step */
    int32_array picked;      /* contacts of one body */
    int32_array carriers;    /* how many contacts of each block carry something */
    struct memory_entry *entries;
    int32_t entry_capacity;
    struct fast_rows *fast; /* of the fast solver, made when it is first used */
};

/* ---- solver_bodies.c ---- */

/* Inverse tensors of a dynamic body in the global frame; zero for others. */
void body_inverse_tensors(const body_table *bodies, int32_t slot, sym3 *inverse_mass, sym3 *inverse_inertia);
/* Starts the list of touched bodies afresh. */
bool solver_bodies_begin(solver *s, const body_table *bodies);
/* The place of a slot (-1: the world), taken into the list when it is new; -1 without memory.  Its velocity is the one
   before the step until solver_bodies_load. */
int32_t solver_body_place(solver *s, const body_table *bodies, int32_t slot);
/* The place of a body at a contact, the row of the one before; its own where that body bends under its group. */
int32_t solver_contact_place(solver *s, const body_table *bodies, const contact_array *contacts, int32_t number,
                             int32_t slot, const contact_row *before);
/* Refuses dynamic bodies without mass or inertia. */
fram_status bodies_check(context *ctx, const body_table *bodies, fram_error *error);
/* Velocities of all dynamic bodies after dt under the loads alone; the gyroscopic moment acts in integrate_poses. */
void bodies_accelerate(context *ctx, body_table *bodies, const wrench *loads, double dt);
/* Velocities of the table into the list. */
void solver_bodies_load(solver *s, const body_table *bodies);

/* ---- solver_contacts.c ---- */

/* Rows of all contacts of bodies that can be moved; impulses of the others, between two driven bodies, are
   set here. */
fram_status contact_rows_make(solver *s, const solver_settings *settings, double dt, const body_table *bodies,
                              contact_array *contacts, fram_error *error);
/* The impulse of a contact between two bodies that nothing can move. */
void contact_load_immovable(const body_table *bodies, contact *c);
/* A point of a guided body against one that nothing moves, or an edge that bends. */
typedef struct guided_point {
    double bias, slide; /* as of contact_row */
    double normal_mass;
    double tangent[2]; /* impulses */
    bool slides;       /* whatever contacts carry */
} guided_point;
/* Where even the whole cap does not stop the approach the normal takes it in one sweep, and friction along what nothing
   answers starts on the cone: both are decided, and steps by a share of the mass may be far too short for them. Changes
   nothing where a sweep reaches as far without it.  Velocities of the table are those without impulses; w: sum of the
   free inverse masses. */
void contact_reach_cap(const body_table *bodies, const contact *c, sym3 w, guided_point *p);
/* The same for all rows, after the warm start. */
void contact_rows_reach_caps(solver *s, const body_table *bodies, const contact_array *contacts);
/* Impulses of the last step into the rows, within this step's bounds; solver_warm_start applies them.
   false: no memory. */
bool contact_rows_recall(solver *s, const contact_array *contacts, const contact_memory_table *memory);
/* Impulses back into the contacts, and the memory of this step. */
fram_status contact_rows_finish(solver *s, const body_table *bodies, contact_array *contacts,
                                contact_memory_table *memory, fram_error *error);
/* back: the points of each pair in reverse order. */
void contact_row_sweep(solver *s, bool back);
/* Complementarity residual of the normal row [m/s]. */
double contact_row_residual(const solver *s, const contact_row *row);
/* The same of the tangent rows. */
double contact_row_slip_residual(const solver *s, const contact_row *row);

/* ---- contact_memory.c ---- */

/* Impulses of the last step, on body a, global frame, of the contacts of all pairs that begin in [first, end) into
   `recalled`, which has a place for every contact. */
void contacts_recall(const contact_memory_table *memory, const contact_array *contacts, int32_t first, int32_t end,
                     vec3 *recalled);
/* The memory of this step: contacts that carry something, by ascending keys. */
fram_status contacts_remember(solver *s, const body_table *bodies, const contact_array *contacts,
                              contact_memory_table *memory, fram_error *error);
/* ---- joint.c ---- */

fram_status joint_rows_make(solver *s, double dt, const body_table *bodies, const joint_table *joints,
                            fram_error *error);
void joint_rows_recall(solver *s, const joint_table *joints);
void joint_rows_finish(solver *s, double dt, joint_table *joints);
/* Joint rows made for velocities now ask for positions: by `rate` of their error within dt. */
void joint_rows_for_positions(solver *s, double rate, double dt);
/* Returns an energy as contact sweeps do: minus the changes of impulses times the velocities that asked for them. */
double joint_row_sweep(solver *s);
/* Largest unmet velocity of the block [m/s]; rotation is taken at the radius of gyration. */
double joint_row_residual(const solver *s, const joint_block *block);

/* One exact solution of the block alone; returns an energy as sweeps do. */
double joint_block_solve(joint_block *j, solver_body *body, solver_body *base);

/* ---- solver_guided.c ---- */

/* Whether an impulse can move it. */
bool solver_body_is_movable(const solver_body *b);
/* Rows of all joints.  Those of guided bodies are taken out of them, and those bodies are left the mass that is free.
   Before rows of contacts are made. */
fram_status solver_joints_make(solver *s, double dt, const body_table *bodies, const joint_table *joints,
                               fram_error *error);
/* Velocities of guided bodies in the table become those that their joints lock; the joints carry what that takes. */
void guided_bodies_drive(solver *s, body_table *bodies);
/* Joints of guided bodies carry what contacts press on them, besides. */
bool guided_bodies_load(solver *s, const body_table *bodies, const contact_array *contacts);
/* Draws joints of guided bodies together, after joint_rows_for_positions. */
void guided_bodies_place(solver *s, body_table *bodies, double dt);
/* The part of a guided body's velocity that its joint locks. */
vec3 guided_velocity(const guided_body *g, vec3 velocity);

/* ---- solver_warm.c ---- */

/* The leader of an island in an array that gives each member one nearer to it. */
int32_t island_leader(int32_t *parent, int32_t i);
/* Makes one island of two.  The lower place leads, so that the leaders depend on the rows alone. */
void island_join(int32_t *parent, int32_t i, int32_t j);
/* The largest share x in [0, 1] of impulses that gives no energy: linear x + square x^2 / 2 <= 0. */
double energy_share(energy_gain g);
double joint_row_work(const solver *s, const joint_block *j);
void joint_row_push(solver *s, const joint_block *j, double share);

/* Applies the impulses that the rows hold, as far as they give no energy.  false: no memory. */
bool solver_warm_start(solver *s);

/* ---- solver_fast.c ---- */

/* The fast solver's solver_solve and solver_correct_positions. */
fram_status solver_solve_fast(solver *s, const solver_settings *settings, double dt, body_table *bodies,
                              const wrench *loads, joint_table *joints, contact_array *contacts,
                              contact_memory_table *memory, solver_report *report, fram_error *error);
fram_status solver_correct_fast(solver *s, const solver_settings *settings, double dt, body_table *bodies,
                                const joint_table *joints, const contact_array *contacts, fram_error *error);
void fast_rows_free(context *ctx, struct fast_rows *fast);

/* ---- solver_accurate.c ---- */

/* Sweeps until the largest residual of all rows is below the tolerance; returns the number of sweeps. */
fram_status solver_iterate_accurately(solver *s, const solver_settings *settings, int32_t *sweeps);

/* ---- shared by all ---- */

/* Least relative normal velocity after the step: what is open may close to the contact skin, a gap in crushed ice
   wholly, no more [m/s]. */
static inline double wanted_velocity(const contact *c, const solver_settings *settings, double dt)
{
    if (c->gap > 0)
        return -c->gap / dt;
    if (c->depth < -settings->contact_skin)
        return (c->depth + settings->contact_skin) / dt;
    return settings->baumgarte && c->correct && c->depth > 0 ? settings->correction_rate * c->depth / dt : 0;
}

/* beta of the position correction (Metrikin 2014): none for a contact at its cap, since that overlap is crushed ice. */
static inline double correction_share(const contact *c, double rate)
{
    double carried = c->impulse_limit > 0 ? c->impulse[0] / c->impulse_limit : 1;
    double share = 1 - carried < rate ? 1 - carried : rate;
    return share > 0 ? share : 0;
}

/* Pseudo velocity at which a contact wants to part, or may close, in the position correction [m/s]. */
static inline double correction_velocity(const contact *c, const solver_settings *settings, double dt)
{
    return (c->depth < 0 ? 1 : correction_share(c, settings->correction_rate)) * c->depth / dt;
}

/* The inverse mass by which both bodies of a contact give way to each other. */
static inline sym3 inverse_mass_of_both(sym3 a, sym3 b)
{
    return (sym3){.xx = a.xx + b.xx,
                  .yy = a.yy + b.yy,
                  .zz = a.zz + b.zz,
                  .xy = a.xy + b.xy,
                  .xz = a.xz + b.xz,
                  .yz = a.yz + b.yz};
}

static inline row_axis row_axis_make(const solver_body *a, const solver_body *b, vec3 direction, vec3 arm_a, vec3 arm_b)
{
    return (row_axis){.direction = direction,
                      .arm_a = arm_a,
                      .arm_b = arm_b,
                      .linear_a = sym3_mul_vec(a->inverse_mass, direction),
                      .linear_b = sym3_mul_vec(b->inverse_mass, direction),
                      .angular_a = sym3_mul_vec(a->inverse_inertia, arm_a),
                      .angular_b = sym3_mul_vec(b->inverse_inertia, arm_b)};
}

static inline double row_axis_velocity(const row_axis *x, const solver_body *a, const solver_body *b)
{
    return vec3_dot(x->direction, vec3_sub(a->velocity, b->velocity)) + vec3_dot(x->arm_a, a->angular_velocity) -
           vec3_dot(x->arm_b, b->angular_velocity);
}

/* Change of the velocity along x per impulse along y. */
static inline double row_axis_coupling(const row_axis *x, const row_axis *y)
{
    return vec3_dot(x->direction, vec3_add(y->linear_a, y->linear_b)) + vec3_dot(x->arm_a, y->angular_a) +
           vec3_dot(x->arm_b, y->angular_b);
}

/* The same of two directions of a contact, as its own row sees it. */
static inline double contact_row_coupling(const contact_row *row, const solver_body *a, const solver_body *b, int i,
                                          int k)
{
    return row_axis_coupling(&row->axis[i], &row->axis[k]) + (i == k ? a->give + b->give : 0);
}

static inline void row_axis_push(const row_axis *x, solver_body *a, solver_body *b, double impulse)
{
    a->velocity = vec3_mad(a->velocity, x->linear_a, impulse);
    a->angular_velocity = vec3_mad(a->angular_velocity, x->angular_a, impulse);
    b->velocity = vec3_mad(b->velocity, x->linear_b, -impulse);
    b->angular_velocity = vec3_mad(b->angular_velocity, x->angular_b, -impulse);
}

#endif
