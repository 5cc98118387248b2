/* By which mechanism ice loads a vessel: the names and the order of the decision of docs/theory.md, Mechanisms of an
   ice load.  Plain data; who decides is sim/mechanisms.h. */
#ifndef MODEL_MECHANISM_H
#define MODEL_MECHANISM_H

#include "base/vec.h"

#include <stdint.h>

/* Identifier, name in columns, what it is called in texts. */
#define ICE_MECHANISMS(X)                                                                       \
    X(SPLITTING, "splitting", "splitting of a floe")                                            \
    X(BENDING, "bending", "bending of ice that has not broken")                                 \
    X(CRUSHING, "crushing", "crushing at the limit")                                            \
    X(CHAIN, "chain", "a chain of floes against fixed or driven ice, a wall or another vessel") \
    X(ACCUMULATION, "accumulation", "floes that other floes hold back")                         \
    X(SUBMERSION, "submersion", "turning and submerging of floes")                              \
    X(IMPACT, "impact", "impact of floes that give way freely")                                 \
    X(FRICTION, "friction", "sliding friction along the hull")

/* Raised whenever a contact may be counted as another mechanism than before: figures of runs say by which of these
   decisions they are told, and those of two are not mixed (study/run_row.h). */
enum { MECHANISM_DECISION = 1 };

typedef enum ice_mechanism {
#define ICE_MECHANISM_ENUM(id, name, text) MECHANISM_##id,
    ICE_MECHANISMS(ICE_MECHANISM_ENUM)
#undef ICE_MECHANISM_ENUM
        MECHANISM_COUNT
} ice_mechanism;

/* What holds the last body of a chain of contacts.  Records hold their order; of earlier ones VESSEL may be the vessel
   that pushes. */
#define CHAIN_ENDS(X)                                                                    \
    X(INERTIA, "inertia", "held by its inertia")                                         \
    X(WATER, "water", "held by water and weight")                                        \
    X(SHEET, "sheet", "it is fixed ice")                                                 \
    X(DRIVEN, "driven", "it is driven ice: the edge of a field, or a sheet that drifts") \
    X(WALL, "wall", "it is a wall")                                                      \
    X(VESSEL, "vessel", "it is a vessel")                                                \
    X(LOOP, "loop", "the chain comes back to a floe of its own")                         \
    X(ITSELF, "itself", "it is the vessel itself")                                       \
    X(LONG, "long", "the chain goes on beyond what is followed")

typedef enum chain_end {
#define CHAIN_END_ENUM(id, name, text) CHAIN_##id,
    CHAIN_ENDS(CHAIN_END_ENUM)
#undef CHAIN_END_ENUM
        CHAIN_END_COUNT
} chain_end;

/* One contact of a vessel in a step: where, with what, and how it loads.  Forces on the vessel, mean over the step,
   global frame [N].  Scratch. */
typedef struct ice_share {
    int32_t vessel, body; /* row of the vessel; slot of the body that it touches */
    int32_t floe;         /* running number of the floe, -1: no floe */
    int32_t patch;        /* crushing patch of this step that it is a point of, -1: none */
    uint8_t mechanism;    /* enum ice_mechanism, of the normal part; the other part is friction */
    uint8_t zone;         /* enum hull_zone; a contact has a share in each that it reaches into */
    vec3 point;           /* global [m] */
    vec3 normal, friction;
} ice_share;

#endif
