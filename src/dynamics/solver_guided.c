/* Bodies that a joint guides along a driven body or the world: no rotation is free, and of the translations
   at most some, as of a hull on a towing carriage that may heave.  Such a body is driven in all that its joint locks,
   whatever contacts do, so the joint is solved once before the sweeps, and contacts see only the mass that is free, W =
   M^-1 - M^-1 J^T (J M^-1 J^T)^-1 J M^-1.  The joint's share of what contacts pressed follows when they are known.

   Were joint and contacts swept in turn, friction would stand against what the joint has not yet undone, and keep it:
   joint and friction both hold the body, and any division between them satisfies all rows. */
#include "base/pool.h"
#include "dynamics/motion.h"
#include "dynamics/solver_rows.h"

/* What contacts see of the mass that a guide takes away, as a share of 1 / m: a row between a guided body and one that
   nothing can move has no answer of its own, but a normal impulse must grow to its cap while they approach, and
   friction to its cone while they slide (slow bodies: contact_reach_cap).  Small enough to be nothing beside a free
   direction; what is left of it is that slips of rounding, 1e-16 of the speed, bring forces of 1e-9 N per tonne and
   step. */
#define GUIDED_GIVE 0.1

/* ---- which bodies, and their free mass ---- */

static double trace(sym3 s) { return s.xx + s.yy + s.zz; }

bool solver_body_is_movable(const solver_body *b) { return trace(b->inverse_mass) > 0; }

/* P S P with P the projector on what is perpendicular to all given unit vectors. */
static sym3 sym3_across(sym3 s, const vec3 *axis, int count)
{
    vec3 column[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    for (int pass = 0; pass < 2; pass++) {
        for (int c = 0; c < 3; c++) {
            for (int k = 0; k < count; k++)
                column[c] = vec3_mad(column[c], axis[k], -vec3_dot(axis[k], column[c]));
            if (pass == 0)
                column[c] = sym3_mul_vec(s, column[c]);
        }
    }
    return (sym3){.xx = column[0].x,
                  .yy = column[1].y,
                  .zz = column[2].z,
                  .xy = 0.5 * (column[0].y + column[1].x),
                  .xz = 0.5 * (column[0].z + column[2].x),
                  .yz = 0.5 * (column[1].z + column[2].y)};
}

/* The free part of an inverse mass. */
static sym3 free_inverse(sym3 s, const vec3 *axis, int count)
{
    for (int k = 0; k < count; k++) {
        vec3 v = sym3_mul_vec(s, axis[k]);
        double share = 1 / vec3_dot(axis[k], v);
        s = (sym3){.xx = s.xx - share * v.x * v.x,
                   .yy = s.yy - share * v.y * v.y,
                   .zz = s.zz - share * v.z * v.z,
                   .xy = s.xy - share * v.x * v.y,
                   .xz = s.xz - share * v.x * v.z,
                   .yz = s.yz - share * v.y * v.z};
    }
    return sym3_across(s, axis, count);
}

/* Directions of the locked translations, and how many; -1 when some rotation is free. */
static int locked_axes(const joint_block *j, vec3 axis[3])
{
    int locked = 0, rotations = 0;
    for (int r = 0; r < j->count; r++) {
        if (j->motion[r] >= 3)
            rotations++;
        else
            axis[locked++] = j->axis[r].direction;
    }
    return j->softness == 0 && rotations == 3 ? locked : -1;
}

static void guide(solver *s, guided_body *g, const vec3 *axis, int locked)
{
    solver_body *b = &s->bodies.data[g->place];
    g->inverse_mass = b->inverse_mass;
    g->inverse_inertia = b->inverse_inertia;
    g->mass = locked == 3 ? (sym3){0} : sym3_across(sym3_inverse(b->inverse_mass), axis, locked);
    b->give = GUIDED_GIVE * trace(b->inverse_mass) / 3;
    b->guided = true;
    b->inverse_mass = locked == 3 ? (sym3){0} : free_inverse(b->inverse_mass, axis, locked);
    b->inverse_inertia = (sym3){0};
    g->locked = locked;
    for (int k = 0; k < locked; k++)
        g->axis[k] = axis[k];
}

static int32_t joints_of(const solver *s, int32_t place)
{
    int32_t count = 0;
    for (int32_t i = 0; i < s->joints.count; i++)
        count += s->joints.data[i].body == place || s->joints.data[i].base == place;
    return count;
}

static bool find_guided(solver *s)
{
    array_clear(&s->guided);
    if (!array_reserve(s->ctx, &s->guided, s->joints.count))
        return false;
    int32_t kept = 0, all = s->joints.count;
    for (int32_t i = 0; i < all; i++) {
        const joint_block *j = &s->joints.data[i];
        bool body = solver_body_is_movable(&s->bodies.data[j->body]);
        bool base = solver_body_is_movable(&s->bodies.data[j->base]);
        vec3 axis[3];
        int locked = locked_axes(j, axis);
        int32_t place = body ? j->body : j->base;
        if (body != base && locked >= 0 && joints_of(s, place) == 1) {
            guided_body g = {.block = *j, .place = place};
            s->guided.data[s->guided.count++] = g;
        }
    }
    /* Blocks move only when all of them were counted. */
    for (int32_t i = 0, next = 0; i < all; i++) {
        if (next < s->guided.count && s->guided.data[next].block.joint == s->joints.data[i].joint) {
            vec3 axis[3];
            int locked = locked_axes(&s->joints.data[i], axis);
            guide(s, &s->guided.data[next++], axis, locked);
        } else {
            s->joints.data[kept++] = s->joints.data[i];
        }
    }
    s->joints.count = kept;
    return true;
}

fram_status solver_joints_make(solver *s, double dt, const body_table *bodies, const joint_table *joints,
                               fram_error *error)
{
    fram_status status = joint_rows_make(s, dt, bodies, joints, error);
    return status == FRAM_OK && !find_guided(s) ? error_memory(error) : status;
}

vec3 guided_velocity(const guided_body *g, vec3 velocity)
{
    vec3 driven = {0, 0, 0};
    for (int k = 0; k < g->locked; k++)
        driven = vec3_mad(driven, g->axis[k], vec3_dot(g->axis[k], velocity));
    return driven;
}

/* ---- the joint ---- */

static solver_body body_of_table(const solver *s, const body_table *bodies, int32_t place)
{
    solver_body b = s->bodies.data[place];
    b.velocity = b.angular_velocity = vec3_make(0, 0, 0);
    if (b.slot >= 0) {
        b.velocity = bodies->velocity[b.slot];
        b.angular_velocity = bodies->angular_velocity[b.slot];
    }
    return b;
}

void guided_bodies_drive(solver *s, body_table *bodies)
{
    for (int32_t i = 0; i < s->guided.count; i++) {
        guided_body *g = &s->guided.data[i];
        joint_block *j = &g->block;
        solver_body body = body_of_table(s, bodies, j->body), base = body_of_table(s, bodies, j->base);
        joint_block_solve(j, &body, &base);
        const solver_body *moved = g->place == j->body ? &body : &base;
        bodies->velocity[moved->slot] = moved->velocity;
        bodies->angular_velocity[moved->slot] = moved->angular_velocity;
    }
}

typedef struct contacts_of {
    const contact_array *contacts;
    int32_t slot;
} contacts_of;

static int32_t pick_contacts_of(const void *arg, int32_t first, int32_t end, int32_t *out)
{
    const contacts_of *w = arg;
    int32_t found = 0;
    for (int32_t i = first; i < end; i++)
        if (w->contacts->data[i].a == w->slot || w->contacts->data[i].b == w->slot)
            out[found++] = i;
    return found;
}

bool guided_bodies_load(solver *s, const body_table *bodies, const contact_array *contacts)
{
    for (int32_t i = 0; i < s->guided.count; i++) {
        guided_body *g = &s->guided.data[i];
        joint_block *j = &g->block;
        int32_t slot = s->bodies.data[g->place].slot;
        vec3 force = {0, 0, 0}, moment = {0, 0, 0};
        if (!pool_pick(s->ctx, pick_contacts_of, &(contacts_of){contacts, slot}, contacts->count, &s->picked))
            return false;
        for (int32_t k = 0; k < s->picked.count; k++) {
            const contact *c = &contacts->data[s->picked.data[k]];
            vec3 p = vec3_scale(contact_impulse(c), c->a == slot ? 1 : -1);
            force = vec3_add(force, p);
            moment = vec3_add(moment, vec3_cross(c->a == slot ? c->arm_a : c->arm_b, p));
        }
        /* Its velocity if the joint were not there, but for what contacts were allowed to change. */
        solver_body body = body_of_table(s, bodies, j->body), base = body_of_table(s, bodies, j->base);
        solver_body *moved = g->place == j->body ? &body : &base;
        vec3 all = sym3_mul_vec(g->inverse_mass, force), seen = sym3_mul_vec(moved->inverse_mass, force);
        moved->velocity = vec3_add(moved->velocity, vec3_sub(all, seen));
        moved->angular_velocity = vec3_add(moved->angular_velocity, sym3_mul_vec(g->inverse_inertia, moment));
        joint_block_solve(j, &body, &base);
    }
    return true;
}

void guided_bodies_place(solver *s, body_table *bodies, double dt)
{
    for (int32_t i = 0; i < s->guided.count; i++) {
        guided_body *g = &s->guided.data[i];
        joint_block *j = &g->block;
        solver_body body = s->bodies.data[j->body], base = s->bodies.data[j->base];
        body.velocity = body.angular_velocity = base.velocity = base.angular_velocity = vec3_make(0, 0, 0);
        joint_block_solve(j, &body, &base);
        const solver_body *moved = g->place == j->body ? &body : &base;
        body_move(bodies, moved->slot, moved->velocity, moved->angular_velocity, dt);
    }
}
