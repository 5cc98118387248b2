/* Fracture of breakable floes (Metrikin 2014, 5.5): from the solved contact impulses of a step to cracks, new floes and
   the books of every event.  Knows floes, patches and contacts; whose surface pushes, it does not know, but for the
   material.

   In a floe's own plane, with the velocities and impulses of this step's solve:
     1. loads: one per crushing patch (fracture_load.c), the ice that it stands on (fracture_edge.c), and the stresses
        it makes there, with others that are near (fracture_joint.c);
     2. a radial crack opens when sigma_yy >= sigma_f; where it finds the floe's other side near enough, the floe splits
        (fracture_split.c); by toughness it splits when the load in its plane is large enough, whatever bends it;
     3. otherwise wedges break off when sigma_wedge >= sigma_f (fracture_bend.c);
     4. the parent goes, its pieces are cleaned and become floes, and what was lost is booked (fracture_birth.c).
   Floes are treated by ascending body slot, patches of a floe by falling stress over strength.
   The tiles of a level sheet are one floe, treated last (fracture_sheet.c): patches that a seam divides are one load,
   and only the tiles that a stencil reaches are cut; its radial cracks do not run through. */
#ifndef ICE_FRACTURE_H
#define ICE_FRACTURE_H

#include "ice/crushing.h"
#include "ice/edge_load.h"
#include "ice/retreat.h"
#include "ice/tiles.h"

typedef enum fracture_kind {
    FRACTURE_SPLIT = 1,
    FRACTURE_BENDING = 2,
    FRACTURE_RELEASE = 3 /* a part of a level sheet hangs on no anchored side any more, and drifts */
} fracture_kind;

/* What decides whether a radial crack runs through. */
typedef enum splitting_rule {
    SPLITTING_LENGTH = 0, /* R_bending < length < S_k R_bending: the reference */
    SPLITTING_TOUGHNESS,  /* fracture mechanics: in-plane load >= the floe's largest for K_IC (docs/theory.md) */
    SPLITTING_NONE
} splitting_rule;

/* How the wedges share a load. */
typedef enum wedge_sharing {
    SHARING_WIDTH = 0, /* each by the width of the ice in its sector */
    SHARING_EQUAL      /* N whole wedges, whatever ice is there: the reference */
} wedge_sharing;

/* Along what R_bending is measured from the load. */
typedef enum wedge_radius {
    RADIUS_ALONG_AXES = 0, /* the wedges' axes, as in Nevel's solution */
    RADIUS_ALONG_CRACKS    /* the cracks between them: the reference */
} wedge_radius;

typedef struct fracture_settings {
    double time_step;     /* [s] */
    double water_density; /* [kg/m3] */
    double gravity;       /* [m/s2] */
    int32_t wedges;       /* N_wedges; the stencil has twice as many */
    wedge_sharing sharing;
    wedge_radius radius_along;
    splitting_rule splitting;
    edge_load_rule load_rule;
    double splitting_factor;    /* S_k */
    double toughness;           /* K_IC [Pa m^0.5], for SPLITTING_TOUGHNESS */
    double narrowness;          /* R_size: a split child's box may be this much longer than wide */
    double smallest_floe_area;  /* pieces under it are lost [m2] */
    double smallest_piece_area; /* as in shape_add_prism [m2] */
    double edge_threshold;      /* as in polygon_clean [m] */
    bool thick_plate_radius;    /* small loads act as on a radius that grows with the thickness (Westergaard) */
    bool wide_contacts;         /* a load that is wide along the edge breaks a strip off between its wedges */
    bool joint_loads;           /* loads near each other on the same ice bend its edge together */
    bool wedge_room;            /* option: no wedges where the floe ends within R_bending along the first crack */
    bool under_pieces;          /* patches of free floes on held ice break that */
    bool under_ice_contacts;    /* option: patches between floes break them too */
    tile_grid tiles;            /* level sheet, if there is one */
    strength_field strength;    /* how strengths vary over the ice */
    bool crush_notches;         /* floes that float lose what a hull had crushed when it draws back */
    bool edges_give;            /* edges of level and fixed ice give before they break: supports are kept */
    bool edge_inertia;          /* with edges_give: ice and water under a bending edge have mass */
    bool edge_gaps;             /* with edges_give: a hull that drew back meets the edge where it left it */
    bool edge_melts;            /* with edges_give: by the heat of friction where a hull slides along it */
    double latent_heat;         /* of that [J/kg] */
    bool crush_trims;           /* static ice loses what a hull has taken the place of (fracture_trim.c) */
} fracture_settings;

/* One event: a floe that broke.  Scratch row, made anew each step. */
typedef struct fracture_event {
    int32_t kind;         /* enum fracture_kind */
    int32_t floe;         /* running number of the parent */
    int32_t first_piece;  /* running number of the first piece; the others follow */
    int32_t pieces;       /* floes made */
    vec3 place;           /* where the first crack starts, global [m] */
    double load;          /* P; of a split by toughness the load in the plane [N] */
    double crack_length;  /* split: of the crack; bending: R_bending of the first stencil [m] */
    double stress_ratio;  /* of the criterion that was met: stress over flexural strength, load over largest; of bending
                             under all loads that are near, while `load` is that of one */
    double loaded_radius; /* a of that criterion [m] */
    double parent_area, piece_area; /* of the parent, and of all pieces together [m2] */
    double area_lost, area_gained;  /* parent = pieces + lost - gained, to rounding [m2] */
    double mass_lost, mass_gained;  /* [kg] */
    vec3 momentum_lost;             /* of the parent less that of the pieces [N s] */
    vec3 angular_momentum_lost;     /* the same about the global origin [N m s] */
} fracture_event;
typedef ARRAY(fracture_event) fracture_event_array;

typedef struct fracture_scratch fracture_scratch;
fracture_scratch *fracture_scratch_create(context *ctx);
/* What is known of the level sheet from step to step belongs to one state: floes become those of another, or somebody
   else than fracture takes tiles of a sheet that is held, or adds some. */
void fracture_scratch_forget(fracture_scratch *s);
void fracture_scratch_free(context *ctx, fracture_scratch *s);

/* Everything that fracture changes. */
typedef struct fracture_state {
    body_table *bodies;
    shape_store *shapes;
    floe_table *floes;
    contact_array *contacts;
    contact_memory_table *memory;
    int32_t *next_number;
    double *crushed;              /* mass of ice that was trimmed [kg], added to; may be NULL without crush_trims */
    double *gained;               /* where cleaning added more than was trimmed [kg], likewise */
    edge_load_table *edge_loads;  /* what floes feel; may be NULL with EDGE_LOAD_STEP */
    edge_support_table *supports; /* what patches stand on; may be NULL without edges_give */
    hull_retreat_table *retreats; /* of further hulls; may be NULL without crush_trims and crush_notches */
} fracture_state;

/* All fracture of one step.  Children keep the parent's orientation, material, thickness and motion of their material
   points; a static parent's remnants stay static, its wedges do not.  Contacts of a floe that broke are void: correct
   becomes false, and what they carried is forgotten.  Events are appended.  A floe whose geometry admits no sound cut
   is left as it is for this step.  Without memory the step cannot go on: the tables keep their meaning, a floe may be
   gone. */
fram_status fracture_run(context *ctx, fracture_scratch *scratch, const fracture_settings *settings, overlay *plane,
                         const crushing_patch_array *patches, const fracture_state *state, fracture_event_array *events,
                         fram_error *error);

/* --- the formulas, one load at a time --- */

/* Time in which an edge responds to a load with this R_bending [m] [s]: 1/omega of the waves of an ice sheet on deep
   water, omega^2 = (D k^4 + rho_w g)/(rho_i h + rho_w/k) (Greenhill 1887), of the wave number k = pi/(4 R_bending),
   with which a beam that is loaded at its end has its largest moment at R_bending (Hetenyi 1946). */
double fracture_response_time(const fracture_settings *settings, const ice_material *ice, double thickness,
                              double reach);

/* The ice that a load stands on. */
typedef struct edge_ice {
    double wedges; /* ice of the wedges over that of N whole ones: 1 on a straight edge, less at a corner [1] */
    double strip;  /* width of the ice between the wedges, for a load that is wide along the edge [m] */
    double length; /* of that ice across the edge, which may be infinite [m] */
    double rise;   /* for how long the load has risen, infinite for one that rests [s] */
} edge_ice;
/* A straight edge under a narrow load: Nevel's N wedges. */
#define EDGE_STRAIGHT ((edge_ice){1, 0, HUGE_VAL, HUGE_VAL})

/* What a load P on a horizontal area A_h does to the edge of a floe. */
typedef struct edge_stress {
    double length;                          /* characteristic length l [m] */
    double radial_radius, wedge_radius;     /* loaded radii [m] */
    double radial_stress, wedge_stress;     /* sigma_yy, sigma_wedge_max [Pa] */
    double radial_capacity, wedge_capacity; /* loads P that make them equal to the flexural strength [N] */
    double breaking_radius;                 /* R_bending [m] */
    double strip_capacity;                  /* what of wedge_capacity the strip carries [N] */
    double strip_length;                    /* from the edge to where the strip breaks [m]; 0 without a strip */
    double inertia;                         /* largest moment under the load as it rises, over that of one at rest */
} edge_stress;
/* Length of the cracks on both sides of a wedge that breaks off at this R_bending [m]. */
double fracture_wedge_side(const fracture_settings *f, double radius);
/* All wedges have the deflection of their tips in common, so each carries by its width and all reach the strength
   together (Nevel 1961).  Under a wide load a strip (ice/strip.h) breaks off between the end wedges: each part carries
   what its ice bears, and stands on the contact area that crushes at that share of the load
   (docs/decisions/0128). */
edge_stress fracture_edge_stress(const fracture_settings *settings, const ice_material *ice, double thickness,
                                 double load, double horizontal_area, edge_ice edge);

/* Factor F of the largest opening force of an edge crack in a floe, F h K_IC sqrt(length): by the crack's length
   through the floe and how far the floe reaches to both sides of it [m] (docs/theory.md); 0 without a side. */
double fracture_splitting_factor(double length, double side, double other_side);
/* That force, for this thickness [m] and toughness K_IC [Pa m^0.5] [N]. */
double fracture_splitting_force(double thickness, double toughness, double length, double side, double other_side);

#endif
