/* Contacts: what the narrow phase finds, what others write on it as data, what the solver returns.  Dynamics knows nothing of ice
   or vessels; what they have to say stands in impulse_limit, friction, correction and rate. */
#ifndef DYNAMICS_CONTACT_H
#define DYNAMICS_CONTACT_H

#include "base/array.h"
#include "base/table.h"
#include "base/vec.h"
#include "bodies/body.h"

/* One point, three rows (normal and two tangents).  The impulse acts on a, its opposite on b. */
typedef struct contact {
    int32_t a, b;         /* body slots */
    vec3 point;           /* global [m] */
    vec3 normal;          /* unit, from b towards a */
    double depth;         /* overlap along the normal, > 0 [m] */
    double impulse_limit; /* largest normal impulse of this step [N s], INFINITY without crushing */
    double friction_static, friction_kinetic;
    bool correct;       /* false: no position correction at all (SPEC 9) */
    bool crush_infinite; /* between two bodies of infinite mass: takes impulse_limit while approaching (SPEC 6) */
    int32_t patch;        /* row of the crushing patch, -1 without */
    uint64_t key;         /* names the same geometric feature from step to step, unique within a step; warm start */
    double impulse[3];    /* result: normal, tangent 1, tangent 2 [N s] */
} contact;
typedef ARRAY(contact) contact_array;

/* The tangents of a normal: the same everywhere, chosen without branching on noise (Duff et al. 2017). */
void contact_tangents(vec3 normal, vec3 *t1, vec3 *t2);
/* Impulse on body a, global frame [N s]. */
vec3 contact_impulse(const contact *c);

/* How two materials meet. */
typedef struct pair_policy {
    double friction_static, friction_kinetic;
    bool patch; /* contacts come from crushing patches, not from the narrow phase */
} pair_policy;
typedef struct pair_policies {
    pair_policy of[MATERIAL_COUNT][MATERIAL_COUNT]; /* symmetric */
} pair_policies;

/* Warm start: what each contact carried in the last step, ascending keys. */
#define CONTACT_MEMORY_FIELDS(X)                                                  \
    X(key, uint64_t, FIELD_U64, 1, "1", "contact key")                            \
    X(impulse, vec3, FIELD_F64, 3, "N s", "impulse on body a, global frame")
TABLE_DECLARE(contact_memory, CONTACT_MEMORY_FIELDS)

/* Pairs of bodies whose margins overlap, kept until they part; ascending (a, b), a < b. */
#define PAIR_FIELDS(X)                                                                                \
    X(a, int32_t, FIELD_I32, 1, "1", "lower body slot")                                               \
    X(b, int32_t, FIELD_I32, 1, "1", "higher body slot")                                              \
    X(axis, vec3, FIELD_F64, 3, "1", "separating axis remembered from the last test; zero without")
TABLE_DECLARE(pair, PAIR_FIELDS)

/* What the broad phase remembers of each body slot: the box it was last paired with. */
#define BROAD_FIELDS(X)                                                                   \
    X(lo, vec3, FIELD_F64, 3, "m", "lower corner of the fat box, global frame")           \
    X(hi, vec3, FIELD_F64, 3, "m", "upper corner of the fat box")
TABLE_DECLARE(broad, BROAD_FIELDS)

#endif
