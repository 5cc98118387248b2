/* Broad and narrow phase: which bodies touch, where, along which normal, how deep. */
#ifndef DYNAMICS_COLLISION_H
#define DYNAMICS_COLLISION_H

#include "bodies/shape.h"
#include "dynamics/contact.h"

typedef int32_array index_array;

typedef struct collision_settings {
    double margin;    /* fat box margin of the broad phase [m] */
    double lookahead; /* fat boxes reach ahead of a moving body by its way in this time [s] */
} collision_settings;

/* Scratch of both phases, kept between steps for its memory only: never state. */
typedef struct collision_scratch collision_scratch;
collision_scratch *collision_scratch_create(context *ctx);
void collision_scratch_free(context *ctx, collision_scratch *s);
/* Call it when boxes were given another state, a copy or one that was read: what is remembered of them goes. */
void collision_scratch_forget(collision_scratch *s);

/* Bring the kept pairs up to date, after whatever moved bodies since the last time; a body that is static or asleep has
   not been turned without being moved.  Fat boxes are renewed when a
   body's box has left its own, so the list depends on the state alone.  Pairs of two bodies that cannot move, and of
   removed bodies, are not kept. */
fram_status broad_phase_update(context *ctx, const body_table *bodies, const shape_store *shapes,
                               const collision_settings *settings, broad_table *boxes, pair_table *pairs,
                               collision_scratch *scratch, fram_error *error);

/* Contacts of all kept pairs that touch, in pair order, at most 4 points per pair of convex pieces.  Points that are
   still open by a small share of the bodies' size are listed too, with depth < 0: the solver lets them close, not
   cross. Pairs whose policy says `patch` are listed in patch_pairs (rows of pairs, in their order) instead; with
   `sides` only those that touch, and not as two level convex prisms side to side with an overlap that is small beside
   their height.  impulse_limit is infinite, correct is true, patch -1; friction from the policies.  No contact takes
   its normal from an inner seam of a compound. Remembers separating axes in pairs, and skips a pair while neither body
   has travelled far enough to have closed the gap.  Parallel over blocks of pairs; call it after broad_phase_update. */
fram_status narrow_phase_run(context *ctx, const body_table *bodies, const shape_store *shapes,
                             const pair_policies *policies, const broad_table *boxes, pair_table *pairs,
                             contact_array *contacts, index_array *patch_pairs, collision_scratch *scratch,
                             fram_error *error);

#endif
