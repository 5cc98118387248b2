/* The body table: slots, frames of reference and books.  Knows neither why bodies move nor what they are made for. */
#include "bodies/body.h"

#include <assert.h>
#include <string.h>

#define TABLE_SELF body_table
TABLE_DEFINE(body, BODY_FIELDS)
#undef TABLE_SELF

int32_t body_create(context *ctx, body_table *bodies, motion kind, material substance)
{
    /* A free slot is a zero byte in the motion column: a search at memory speed, and no free list that would have to be
       state. */
    static_assert(MOTION_NONE == 0, "a free slot");
    int32_t slot = table_first_zero(bodies, bodies->motion);
    if (slot == bodies->count && !table_resize(ctx, bodies, &body_table_info, slot + 1))
        return -1;
    assert(kind != MOTION_NONE);
    table_row_taken(bodies, slot);
    bodies->orientation[slot] = quat_identity();
    bodies->shape[slot] = -1;
    bodies->owner[slot] = -1;
    bodies->generation[slot]++;
    bodies->motion[slot] = (uint8_t)kind;
    bodies->material[slot] = (uint8_t)substance;
    return slot;
}

void body_remove(body_table *bodies, int32_t slot)
{
    assert(slot >= 0 && slot < bodies->count && body_is_alive(bodies, slot));
    /* Everything but the generation becomes zero, so that the state's hash forgets the body. */
    uint32_t generation = bodies->generation[slot];
    for (int f = 0; f < body_table_info.field_count; f++) {
        const field_info *field = &body_table_info.fields[f];
        memset((char *)table_field(bodies, field) + field->size * (size_t)slot, 0, field->size);
    }
    bodies->generation[slot] = generation;
    table_row_freed(bodies, slot);
}

/* Slots that are looked at together. */
enum { LOOK_SLOTS = 32 };

/* A byte is 0 to 5; adding 6 sets its bit 3 from MOTION_PRESCRIBED on, and adding 3 that of MOTION_ASLEEP alone. */
static bool any_moves(const uint8_t kinds[LOOK_SLOTS])
{
    static_assert(MOTION_STATIC < MOTION_PRESCRIBED && MOTION_PRESCRIBED == 2 && MOTION_CARRIED == 4 &&
                      MOTION_ASLEEP == 5,
                  "bits of the motions");
    const uint64_t each = 0x0101010101010101U;
    uint64_t bytes[LOOK_SLOTS / sizeof each], moving = 0;
    memcpy(bytes, kinds, sizeof bytes);
    for (size_t i = 0; i < sizeof bytes / sizeof *bytes; i++)
        moving |= (bytes[i] + 6 * each) & ~(bytes[i] + 3 * each);
    return (moving & (8 * each)) != 0;
}

static bool moves(const body_table *b, int32_t slot)
{
    return b->motion[slot] != MOTION_NONE && b->motion[slot] != MOTION_STATIC && b->motion[slot] != MOTION_ASLEEP;
}

int32_t body_next_moving(const body_table *b, int32_t first, int32_t end)
{
    while (first < end) {
        if (moves(b, first))
            return first;
        first += end - first >= LOOK_SLOTS && !any_moves(b->motion + first) ? LOOK_SLOTS : 1;
    }
    return end;
}

bool body_slots_stand(const body_table *b, int32_t first, int32_t end)
{
    if (first >= end)
        return true;
    const vec3 none = {0, 0, 0};
    const vec3 *v = b->velocity + first;
    return body_next_moving(b, first, end) == end && memcmp(v, &none, sizeof none) == 0 &&
           memcmp(v, v + 1, (size_t)(end - first - 1) * sizeof *v) == 0;
}

vec3 body_point_velocity(const body_table *b, int32_t slot, vec3 point)
{
    vec3 arm = vec3_sub(point, b->position[slot]);
    return vec3_add(b->velocity[slot], vec3_cross(b->angular_velocity[slot], arm));
}

vec3 body_velocity_past(const body_table *b, int32_t slot, int32_t other, vec3 point)
{
    return vec3_sub(body_point_velocity(b, slot, point), body_point_velocity(b, other, point));
}

vec3 body_to_local(const body_table *b, int32_t slot, vec3 point)
{
    return mat3_tmul_vec(quat_matrix(b->orientation[slot]), vec3_sub(point, b->position[slot]));
}

vec3 body_to_global(const body_table *b, int32_t slot, vec3 point)
{
    return vec3_add(b->position[slot], mat3_mul_vec(quat_matrix(b->orientation[slot]), point));
}

/* Of a body that moves freely; spin in its own frame. */
static double kinetic_energy(const body_table *b, int32_t slot, vec3 momentum, vec3 spin_momentum, vec3 spin)
{
    return 0.5 * (vec3_dot(momentum, b->velocity[slot]) + vec3_dot(spin_momentum, spin));
}

void body_books_add(const body_table *b, int32_t slot, body_books *sum)
{
    if (!body_is_free(b, slot))
        return;
    mat3 r = quat_matrix(b->orientation[slot]);
    vec3 spin = mat3_tmul_vec(r, b->angular_velocity[slot]);
    vec3 spin_momentum = sym3_mul_vec(b->inertia[slot], spin); /* body frame */
    vec3 momentum = vec3_scale(b->velocity[slot], b->mass[slot]);
    sum->mass += b->mass[slot];
    sum->kinetic_energy += kinetic_energy(b, slot, momentum, spin_momentum, spin);
    sum->momentum = vec3_add(sum->momentum, momentum);
    sum->angular_momentum = vec3_add(sum->angular_momentum,
                                     vec3_add(vec3_cross(b->position[slot], momentum), mat3_mul_vec(r, spin_momentum)));
}
