/* Contacts: what the narrow phase finds, what others write on it as data, what the solver returns.  Dynamics knows
   nothing of ice or vessels; what they have to say stands in impulse_limit, friction, correction and rate. */
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
    double depth;         /* overlap along the normal; < 0: open by that much, may close but not cross [m] */
    double gap;           /* > 0: what it overlaps was crushed, and it may close by that much [m] */
    double impulse_limit; /* largest normal impulse of this step [N s], INFINITY without crushing */
    double friction_static, friction_kinetic;
    bool correct;        /* false: no position correction at all */
    bool crush_infinite; /* between two bodies of infinite mass: takes impulse_limit while approaching */
    /* Of a body that nothing moves, where it bends upright: velocity along z per impulse of the contact's group, and
       its velocity past the body without any; 0, 0: it is rigid. */
    double give;       /* [1/kg] */
    double recoil;     /* [m/s] */
    int32_t patch;     /* row of the crushing patch, -1 without */
    uint64_t key;      /* names the same geometric feature from step to step, unique within a step; warm start */
    double impulse[3]; /* result: normal, tangent 1, tangent 2 [N s] */
    vec3 arm_a, arm_b; /* set by the solver: point from the centres of mass before they move, global frame [m] */
} contact;
typedef ARRAY(contact) contact_array;

/* Two contacts in a row belong to one group: one pair of bodies, one normal, one friction, one edge. */
static inline bool contact_same_group(const contact *x, const contact *y)
{
    return x->a == y->a && x->b == y->b && x->normal.x == y->normal.x && x->normal.y == y->normal.y &&
           x->normal.z == y->normal.z && x->friction_static == y->friction_static &&
           x->friction_kinetic == y->friction_kinetic && x->give == y->give && x->recoil == y->recoil;
}
/* A group has no more points. */
enum { CONTACT_GROUP_POINTS = 4 };

/* The tangents of a normal: the same everywhere, chosen without branching on noise (Duff et al. 2017). */
void contact_tangents(vec3 normal, vec3 *t1, vec3 *t2);
/* Impulse on body a, global frame [N s]. */
vec3 contact_impulse(const contact *c);

/* The name of a feature where two bodies meet, for contact.key: the same from step to step while both bodies live,
   another one after a slot was used again.  Ascending with (lower slot, higher slot); within a pair the lower bits are
   a hash of the rest, so call contact_keys_part on the contacts of each pair.  Slots must be under CONTACT_MOST_BODIES.
 */
enum { CONTACT_MOST_BODIES = 1 << 22 };
uint64_t contact_key(const body_table *bodies, int32_t a, int32_t b, int32_t piece_a, int32_t piece_b,
                     uint32_t feature);
/* contact_key in two steps, for many features of one pair of pieces. */
typedef struct contact_key_stem {
    uint64_t slots, hash;
} contact_key_stem;
contact_key_stem contact_key_begin(const body_table *bodies, int32_t a, int32_t b, int32_t piece_a, int32_t piece_b);
uint64_t contact_key_end(contact_key_stem stem, uint32_t feature);
/* The least key of two bodies' contacts: the same for all of them. */
uint64_t contact_key_pair(uint64_t key);
/* Makes the keys of all contacts of one pair differ: of equal ones the later are counted up. */
void contact_keys_part(contact *contacts, int32_t count);

/* How two materials meet. */
typedef struct pair_policy {
    double friction_static, friction_kinetic;
    bool patch; /* contacts come from crushing patches, not from the narrow phase */
    bool sides; /* with patch: two convex prisms that meet side to side keep the contacts of the narrow phase, whose
                   limits are set afterwards; all others are listed for their patch */
} pair_policy;
typedef struct pair_policies {
    pair_policy of[MATERIAL_COUNT][MATERIAL_COUNT]; /* symmetric */
} pair_policies;

/* Warm start: what each contact carried in the last step, ascending keys.  Told of the body in the lower slot, since a
   and b change places where a pair of floes becomes one of a patch. */
#define CONTACT_MEMORY_FIELDS(X)                       \
    X(key, uint64_t, FIELD_U64, 1, "1", "contact key") \
    X(on_lower, vec3, FIELD_F64, 3, "N s", "impulse on the body in the lower slot, global frame")
TABLE_DECLARE(contact_memory, CONTACT_MEMORY_FIELDS)
/* Row of the memory with this key, -1 without.  place: where the last search ended, from 0; keys mostly come in the
   memory's order. */
int32_t contact_memory_find(const contact_memory_table *memory, uint64_t key, int32_t *place);

/* What the pair of a contact carried in the last step, on body a of that contact, global frame [N s]: the sum over all
   contacts of the pair, whatever their names were. */
vec3 contact_memory_pair(const contact_memory_table *memory, const contact *c);

/* Pairs of bodies whose margins overlap, kept until they part; ascending (a, b), a < b. */
#define PAIR_FIELDS(X)                                                                              \
    X(a, int32_t, FIELD_I32, 1, "1", "lower body slot")                                             \
    X(b, int32_t, FIELD_I32, 1, "1", "higher body slot")                                            \
    X(axis, vec3, FIELD_F64, 3, "1", "separating axis remembered from the last test; zero without") \
    X(clear, double, FIELD_F64, 1, "m", "the two cannot meet while their travels sum to less; PAIR_HAS_PATCH")
TABLE_DECLARE(pair, PAIR_FIELDS)
/* pair_table.clear of two bodies whose contacts were those of a patch: they are listed for it without being tested,
   until whoever looks for the patch finds none and writes 0. */
#define PAIR_HAS_PATCH (-1.0)

/* What the broad phase remembers of each body slot: the box it was last paired with. */
#define BROAD_FIELDS(X)                                                                                          \
    X(generation, uint32_t, FIELD_U32, 1, "1", "of the body that was boxed; 0: none")                            \
    X(fixed, uint8_t, FIELD_U8, 1, "1", "1: that body was static or carried")                                    \
    X(lo, vec3, FIELD_F64, 3, "m", "lower corner of the fat box, global frame")                                  \
    X(hi, vec3, FIELD_F64, 3, "m", "upper corner of the fat box")                                                \
    X(travel, double, FIELD_F64, 1, "m", "bound on the way of every point of the body since it was boxed first") \
    X(stay, double, FIELD_F64, 1, "m", "up to this travel it cannot have left its fat box")                      \
    X(position, vec3, FIELD_F64, 3, "m", "of the body when travel was brought up to date")                       \
    X(orientation, quat, FIELD_F64, 4, "1", "of the body when travel was brought up to date")
TABLE_DECLARE(broad, BROAD_FIELDS)

#endif
