/* Names and axes of contacts, and the tables that outlive a step. */
#include "dynamics/contact.h"

#define TABLE_SELF contact_memory_table
TABLE_DEFINE(contact_memory, CONTACT_MEMORY_FIELDS)
#undef TABLE_SELF
#define TABLE_SELF pair_table
TABLE_DEFINE(pair, PAIR_FIELDS)
#undef TABLE_SELF
#define TABLE_SELF broad_table
TABLE_DEFINE(broad, BROAD_FIELDS)
#undef TABLE_SELF

/* Duff et al. 2017, Building an orthonormal basis, revisited: continuous but for the sign of n.z, never singular. */
void contact_tangents(vec3 normal, vec3 *t1, vec3 *t2)
{
    double sign = copysign(1, normal.z), a = -1 / (sign + normal.z), b = normal.x * normal.y * a;
    *t1 = vec3_make(1 + sign * normal.x * normal.x * a, sign * b, -sign * normal.x);
    *t2 = vec3_make(b, sign + normal.y * normal.y * a, -normal.y);
}

vec3 contact_impulse(const contact *c)
{
    vec3 t1, t2;
    contact_tangents(c->normal, &t1, &t2);
    vec3 sum = vec3_scale(c->normal, c->impulse[0]);
    return vec3_mad(vec3_mad(sum, t1, c->impulse[1]), t2, c->impulse[2]);
}

/* Key: 22 bits of the lower slot, 22 of the higher, FEATURE_BITS of a hash. */
enum { SLOT_BITS = 22, FEATURE_BITS = 20 };
#define FEATURE_MASK (((uint64_t)1 << FEATURE_BITS) - 1)

/* The finaliser of MurmurHash3 (Appleby 2011). */
static uint64_t mix(uint64_t h)
{
    h = (h ^ (h >> 33)) * 0xff51afd7ed558ccdULL;
    h = (h ^ (h >> 33)) * 0xc4ceb9fe1a85ec53ULL;
    return h ^ (h >> 33);
}

contact_key_stem contact_key_begin(const body_table *bodies, int32_t a, int32_t b, int32_t piece_a, int32_t piece_b)
{
    int32_t low = a < b ? a : b, high = a < b ? b : a;
    uint64_t h = mix(((uint64_t)bodies->generation[a] << 32) | bodies->generation[b]);
    h = mix(h ^ (((uint64_t)(uint32_t)piece_a << 32) | (uint32_t)piece_b));
    return (contact_key_stem){((uint64_t)low << (SLOT_BITS + FEATURE_BITS)) | ((uint64_t)high << FEATURE_BITS), h};
}

uint64_t contact_key_end(contact_key_stem stem, uint32_t feature)
{
    return stem.slots | (mix(stem.hash ^ feature) & FEATURE_MASK);
}

uint64_t contact_key(const body_table *bodies, int32_t a, int32_t b, int32_t piece_a, int32_t piece_b, uint32_t feature)
{
    return contact_key_end(contact_key_begin(bodies, a, b, piece_a, piece_b), feature);
}

uint64_t contact_key_pair(uint64_t key) { return key & ~FEATURE_MASK; }

void contact_keys_part(contact *contacts, int32_t count)
{
    for (int32_t i = 1; i < count; i++) {
        for (int32_t j = 0; j < i; j++) {
            if (contacts[j].key != contacts[i].key)
                continue;
            contacts[i].key = (contacts[i].key & ~FEATURE_MASK) | ((contacts[i].key + 1) & FEATURE_MASK);
            j = -1; /* the next name may be taken as well */
        }
    }
}
