/* Crushing patches (docs/decisions/0010): where a surface cuts into a floe, how large the contact is, and the contacts
   with their cap.  A patch is computed from a plain triangle mesh, a pose and a floe; whose mesh it is, this room does
   not know.

   A patch is one connected component of the surface inside the floe's prism, in the floe's own tilted frame:
   N = sum of the area vectors of the clipped triangles, A_c = |N|, A_h = |N . z_floe|, normal = N/|N| (outward of the
   surface), centre = area-weighted centroid.  This holds while the plate leaves through the side, for downward and
   upward breaking, vertical sides (length x thickness), tilted floes and floes held under the bottom.

   Components whose area vectors cancel (a corner of the hull or a pile wholly inside the floe) push nowhere and make no
   patch.  A floe that lies wholly inside the surface without meeting it (a small piece that slipped through a thin
   plate) gets a patch of its whole side area (perimeter x thickness, A_h = 0) with one contact at its middle, along the
   shortest way to the surface; that contact is position-corrected whatever the materials, by a thickness a step at
   most, since nothing else would ever free the floe. */
#ifndef ICE_CRUSHING_H
#define ICE_CRUSHING_H

#include "dynamics/collision.h"
#include "geometry/mesh_bvh.h"
#include "ice/edge_give.h"
#include "ice/pack_limit.h"
#include "ice/strength.h"

/* Scratch row, made anew each step.  Where the edge gives, all but plan is of what is left of the overlap then. */
typedef struct crushing_patch {
    int32_t floe; /* row of the floe table */
    int32_t floe_body, surface_body;
    vec3 normal;            /* unit, from the surface body towards the floe: the force on the floe is along +normal */
    vec3 centre;            /* centroid of the patch, global [m] */
    double area;            /* A_c [m2] */
    double horizontal_area; /* A_h [m2], in the floe's plane */
    double surface_area;    /* sum of the areas whose vectors sum to A_c: what cancels counts here [m2] */
    double pressure;        /* sigma_c(A_c), less where the edge gives before it crushes [Pa] */
    box2 plan;              /* bounds of the patch in the floe's own plane [m] */
    int32_t contact_first, contact_count; /* rows of the contact array */
    bool over;                            /* over what breaks the edge that it is on, as that is known */
    double compliance; /* deflection of the edge under it over its own vertical load, 0: rigid [m/N] */
    int32_t component; /* number of the component inside its pair, by least triangle */
} crushing_patch;
typedef ARRAY(crushing_patch) crushing_patch_array;

typedef struct crushing_settings {
    double time_step;        /* [s] */
    double smallest_area;    /* patches under it are dropped [m2] */
    double skin;             /* bodies nearer than this touch: run.solver.contact_skin [m] */
    double rest_speed;       /* a hull that goes by slower rests on the ice: it slides nowhere [m/s] */
    pack_limit pack;         /* ridges and rafts between floes */
    strength_field strength; /* how strengths vary over the ice */
    double small_patch;    /* floes: lengths of a patch under this part of the smaller radius turn neither, 0: all do */
    edge_compliance edges; /* how far edges of level and fixed ice give */
    bool correct_unbreakable; /* comparison switch: a hull pushes unbreakable floes out of itself */
    bool parts_by_motion;     /* where a hull slides along ice it is another patch than where it moves into it */
    bool top_plane_area;      /* comparison switch: the paper's area (cut with the floe's top plane, A_I / cos gamma) */
} crushing_settings;

typedef struct crushing_scratch crushing_scratch;
crushing_scratch *crushing_scratch_create(context *ctx);
void crushing_scratch_free(context *ctx, crushing_scratch *s);

/* Patches of the given pairs (a floe against a body with a solid or a prism shape, which may be another floe), appended
   in pair order together with their contacts, floe first: 1, 2 or 4 points a patch, in the plane through its centroid,
   of equal weight, with the centroid and the second moments of the patch (but for small_patch), so that force and
   moment are those of the patch; each capped by weight * sigma_c A_c dt.  Between two floes the higher slot counts as
   the floe, and the weaker one's pressure holds.  depth of the points = mean way of the overlap along the normal
   (ice/patch.h), continuous in the pose.  correct is false between hull and floe and between floes: their overlap is
   ice that is crushed or about to break.  With `edges`, breakable ice that does not move freely gives under a hull: the
   edge is where the load that crushes on what is left of the patch bends it, found by the ice that the patch stood on
   in the last step (supports, may be NULL: straight edges).  The contacts that the array holds already are given their
   limits by crushing_limit_sides.  Independent of how hull and floe are cut into convex pieces, to rounding.
   FRAM_ERROR_USAGE for a pair without ice; without memory the arrays may hold a part of the patches. */
fram_status crushing_contacts(context *ctx, crushing_scratch *scratch, const crushing_settings *settings,
                              const body_table *bodies, const shape_store *shapes, const floe_table *floes,
                              const edge_support_table *supports, pair_table *pairs, const index_array *patch_pairs,
                              const pair_policies *policies, crushing_patch_array *patches, contact_array *contacts,
                              fram_error *error);

/* The limits of contacts that the narrow phase made where the policy says `sides` (level floes side to side): per pair
   the pressure of the weaker floe on A_c, the width of the reference side's section through the other floe (within the
   skin) times the height that both have in common, shared by the points that touch; points that are still open carry
   nothing.  None of them is position-corrected: overlap that was crushed stays. */
void crushing_limit_sides(context *ctx, const crushing_settings *settings, const body_table *bodies,
                          const shape_store *shapes, const floe_table *floes, const pair_policies *policies,
                          contact_array *contacts);

#endif
