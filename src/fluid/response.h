/* How the water answers a body's motion beyond pressure and drag: added mass, linear damping, and the treatment of drag
   that is too strong for the time step.  What this room knows of it goes into the loads and into the added masses of
   the body table, before the solver turns loads into velocities.
   Signs: A is the added mass, D the linear damping; velocities are relative to the water. */
#ifndef FLUID_RESPONSE_H
#define FLUID_RESPONSE_H

#include "fluid/fluid.h"
#include "fluid/matrix6.h"

/* ---- prisms: floes ---- */

typedef struct prism_response {
    bool added_mass;      /* of thin plates (added_mass.h), in heave, roll and pitch */
    double damping_ratio; /* linear damping in heave, roll and pitch, over the critical one; 0: none */
} prism_response;

/* Drag is treated implicitly as far as an explicit step would take more than this part of a velocity. */
#define EXPLICIT_DRAG 0.05

/* For every dynamic prism: sets its added mass and inertia in `bodies`, and adds to its load what added mass and
   damping exert.  volume: submerged, per slot, as fluid_apply gave it in this step.

   Damping is that of the waves that a floe makes: it fades as the last twentieth of a floe goes under.
   Added mass acts in proportion to the submerged part while that is small (a quarter of the body), so that floes that
   leave the water do it without a jump; what comes to a sinking floe is set going by it, at the cost of its momentum.
   With p = A v in axes that turn with the body, the load is that of Kirchhoff's equations (Lamb 1932, section 124): -w
   x p + A (w x v), and -v x p about the centre of mass.

   Strong drag: the solver's equation becomes (M + dt C) dv = dt F, linearly implicit, with a diagonal C (body axes)
   that bounds the derivative of drag by velocity at the present speed from above, less EXPLICIT_DRAG M / dt.  For drag
   that grows with the square of the speed this is stable for any time step, does not overshoot, stays of first order,
   and leaves terminal speeds and the balance of drag with contacts as they are; where dt C < EXPLICIT_DRAG M it changes
   nothing. */
void prisms_respond(context *ctx, const media *m, const drag_coefficients coefficients[MATERIAL_COUNT],
                    const prism_response *settings, double time_step, body_table *bodies, const shape_store *shapes,
                    const double *volume, wrench *loads);

/* ---- vessels: matrices ---- */

/* Body axes, about the centre of mass. */
typedef struct hydrodynamics {
    matrix6 added_mass; /* symmetric [kg, kg m, kg m2] */
    matrix6 damping;    /* [N s/m, N s, N m s] */
    bool measured;      /* what a steady flow does is a table's, which has Munk's moment in it */
    double depth;       /* below still water, where the current is taken [m] */
} hydrodynamics;

/* Munk's moment about the body's z axis on one that goes through the water with this velocity and does not turn, body
   axes: -(v x A v)_z [N m]; 0 where it is measured. */
double hydrodynamics_munk(const hydrodynamics *h, vec3 velocity);

/* Changes the load of a dynamic body, whose added mass and inertia in `bodies` must be the diagonal of h->added_mass:
   its acceleration under the changed load by mass and diagonal is what (M + A + dt D) a = F - D v - (Kirchhoff's
   terms) gives, with all of A and D.  Contacts and joints then meet the diagonal only.
   contacts: what the contacts exerted in the step before, global axes, about the centre of mass.  They moved the body
   by the diagonal; what all of M + A + dt D would have made of them is made up for now, so that over time the body
   answers to them by all of it too.  With a lag of a step this converges while the couplings are weak against the
   diagonal, as those of ships are; where they are not, that much of it is left out as might not. coupled: false is for
   a body that a joint leads and allows to heave only: of D only its heave is implicit, the rest of D v and Kirchhoff's
   terms are loads that the joint bears whatever the step; what couplings of A make of an acceleration is left out. */
void hydrodynamics_respond(const hydrodynamics *h, bool coupled, const media *m, double time_step,
                           const body_table *bodies, int32_t slot, const wrench *contacts, wrench *load);

#endif
