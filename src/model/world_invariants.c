#include "model/world_invariants.h"

#include <math.h>
#include <stdio.h>

/* Lengths of unit vectors and quaternions are right to this; they are normalised each step. */
#define UNIT_ROUNDING 1e-9
/* Friction is projected to its cone in double arithmetic. */
#define CONE_ROUNDING 1e-9

static bool is_unit(double square) { return fabs(square - 1) <= UNIT_ROUNDING; }

static bool broken(char text[INVARIANT_TEXT], const char *table, int32_t row, const char *what, double value)
{
    snprintf(text, INVARIANT_TEXT, "%s[%d]: %s (%.17g)", table, (int)row, what, value);
    return true;
}

/* ---- bodies ---- */

static bool body_broken(const world *w, int32_t i, char text[INVARIANT_TEXT])
{
    const body_table *b = &w->bodies;
    quat q = b->orientation[i];
    double square = q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z;
    if (!is_unit(square))
        return broken(text, "body", i, "its quaternion is no unit one", square);
    if (b->motion[i] == MOTION_DYNAMIC && !(b->mass[i] > 0))
        return broken(text, "body", i, "it moves freely without mass", b->mass[i]);
    /* Added inertia may be a rounding of what was published under 0, but takes none of the body's own away. */
    sym3 j = b->inertia[i];
    vec3 added = b->added_inertia[i];
    double least = fmin(j.xx + fmin(added.x, 0), fmin(j.yy + fmin(added.y, 0), j.zz + fmin(added.z, 0)));
    if (b->motion[i] == MOTION_DYNAMIC && !(least > 0))
        return broken(text, "body", i, "it turns freely without inertia", least);
    int32_t shape = b->shape[i];
    if (shape >= 0 && (shape >= w->shapes.shapes.count || w->shapes.shapes.kind[shape] == SHAPE_NONE))
        return broken(text, "body", i, "its shape is not there", shape);
    if (b->motion[i] == MOTION_STATIC && vec3_dot(b->velocity[i], b->velocity[i]) > 0)
        return broken(text, "body", i, "it is static and has a velocity", vec3_length(b->velocity[i]));
    return false;
}

static bool bodies_broken(const world *w, char text[INVARIANT_TEXT])
{
    for (int32_t i = 0; i < w->bodies.count; i++) {
        if (body_is_alive(&w->bodies, i) && body_broken(w, i, text))
            return true;
    }
    return false;
}

/* ---- who owns whom ---- */

static bool owns(const body_table *b, int32_t body, int32_t row, material substance)
{
    return body_is_alive(b, body) && b->owner[body] == row && b->material[body] == substance;
}

static bool owners_broken(const model *m, const world *w, char text[INVARIANT_TEXT])
{
    if (w->vessels.count > 0 && w->vessels.count != m->vessels.count)
        return broken(text, "vessel", w->vessels.count, "the model has another number of vessels", m->vessels.count);
    if (w->stations.count > w->vessels.count)
        return broken(text, "station", w->stations.count, "more stations than vessels", w->vessels.count);
    for (int32_t i = 0; i < w->vessels.count; i++) {
        int32_t body = w->vessels.body[i];
        if (!owns(&w->bodies, body, i, MATERIAL_HULL))
            return broken(text, "vessel", i, "its body is not its own", body);
    }
    for (int32_t i = 0; i < w->floes.count; i++) {
        int32_t body = w->floes.body[i];
        if (body >= 0 && !owns(&w->bodies, body, i, MATERIAL_ICE))
            return broken(text, "floe", i, "its body is not its own", body);
        if (body >= 0 && !(w->floes.thickness[i] > 0 && w->floes.area[i] > 0))
            return broken(text, "floe", i, "it has no thickness or area", w->floes.area[i]);
    }
    return false;
}

/* ---- order ---- */

static bool order_broken(const world *w, char text[INVARIANT_TEXT])
{
    for (int32_t i = 0; i < w->pairs.count; i++) {
        int32_t a = w->pairs.a[i], b = w->pairs.b[i];
        bool after = i == 0 || a > w->pairs.a[i - 1] || (a == w->pairs.a[i - 1] && b > w->pairs.b[i - 1]);
        if (a >= b || !after)
            return broken(text, "pair", i, "pairs are not ascending", b);
    }
    for (int32_t i = 1; i < w->memory.count; i++) {
        if (w->memory.key[i] <= w->memory.key[i - 1])
            return broken(text, "contact_memory", i, "keys are not ascending", (double)w->memory.key[i]);
    }
    return false;
}

bool world_invariant_broken(const model *m, const world *w, char text[INVARIANT_TEXT])
{
    return bodies_broken(w, text) || owners_broken(m, w, text) || order_broken(w, text);
}

/* ---- contacts ---- */

static bool contact_broken(const world *w, int32_t i, char text[INVARIANT_TEXT])
{
    const contact *c = &w->scratch.contacts.data[i];
    const body_table *b = &w->bodies;
    bool there = c->a >= 0 && c->a < b->count && c->b >= 0 && c->b < b->count && c->a != c->b;
    if (!there || !body_is_alive(b, c->a) || !body_is_alive(b, c->b))
        return broken(text, "contact", i, "it is not one of two living bodies", c->a);
    if (!body_is_dynamic(b, c->a) && !body_is_dynamic(b, c->b) && c->impulse[0] > 0 && !c->crush_infinite)
        return broken(text, "contact", i, "none of its bodies can move", c->b);
    if (!is_unit(vec3_dot(c->normal, c->normal)))
        return broken(text, "contact", i, "its normal is no unit vector", vec3_length(c->normal));
    if (!(c->impulse[0] >= 0 && c->impulse[0] <= c->impulse_limit))
        return broken(text, "contact", i, "its impulse is not between 0 and its limit", c->impulse[0]);
    double friction = sqrt(c->impulse[1] * c->impulse[1] + c->impulse[2] * c->impulse[2]);
    double most = fmax(c->friction_static, c->friction_kinetic) * c->impulse[0];
    if (!(friction <= most * (1 + CONE_ROUNDING)))
        return broken(text, "contact", i, "its friction leaves the cone", friction - most);
    return false;
}

bool contact_invariant_broken(const world *w, char text[INVARIANT_TEXT])
{
    for (int32_t i = 0; i < w->scratch.contacts.count; i++) {
        if (contact_broken(w, i, text))
            return true;
    }
    return false;
}
