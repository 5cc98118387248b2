/* Contact rows: made, warm started, swept, judged and written back. */
#include "dynamics/solver_rows.h"

#include <string.h>

/* A relative velocity is known to about 1e-16 of the velocities that it is the difference of.  Approaches and slips
   below this share of those bring less in proportion, so that rounding brings nothing; a slip of a billionth of the
   speed is no direction of sliding that any real wall has. */
#define RESOLVED_SHARE 1e-9

/* From 0 to 1 as a speed grows from nothing to what is resolved. */
static double resolved(double speed, double least) { return speed < least ? speed / least : 1; }

/* A hull driven against static ice takes its cap while they approach, and kinetic friction against the sliding; all
   others carry nothing. */
void contact_load_immovable(const body_table *bodies, contact *c)
{
    memset(c->impulse, 0, sizeof c->impulse);
    if (!c->crush_infinite || !isfinite(c->impulse_limit))
        return;
    vec3 va = body_point_velocity(bodies, c->a, c->point), vb = body_point_velocity(bodies, c->b, c->point);
    vec3 t1, t2, u = vec3_sub(va, vb);
    double approach = -vec3_dot(u, c->normal), least = RESOLVED_SHARE * (vec3_length(va) + vec3_length(vb));
    if (approach <= 0)
        return;
    contact_tangents(c->normal, &t1, &t2);
    double u1 = vec3_dot(u, t1), u2 = vec3_dot(u, t2), speed = sqrt(u1 * u1 + u2 * u2);
    c->impulse[0] = c->impulse_limit * resolved(approach, least);
    if (speed > 0) {
        double share = c->friction_kinetic * c->impulse[0] * resolved(speed, least) / speed;
        c->impulse[1] = -share * u1;
        c->impulse[2] = -share * u2;
    }
}

/* ---- guided bodies ---- */

/* A direction answers when it has more than this share of the free inverse mass. */
#define ANSWERING_SHARE 1e-12

static vec3 point_velocity(const body_table *bodies, const contact *c, int32_t slot)
{
    vec3 v = body_point_velocity(bodies, slot, c->point);
    v.z += body_is_dynamic(bodies, slot) || c->give == 0 ? 0 : c->recoil;
    return v;
}

/* The unit direction in the plane of the tangents that no impulse changes a velocity along; with both such: that of the
   slip u.  false: none. */
static bool locked_tangent(sym3 w, const vec3 tangent[2], const double u[2], double along[2])
{
    vec3 w1 = sym3_mul_vec(w, tangent[0]), w2 = sym3_mul_vec(w, tangent[1]);
    double k11 = vec3_dot(tangent[0], w1), k12 = vec3_dot(tangent[0], w2), k22 = vec3_dot(tangent[1], w2);
    double least = ANSWERING_SHARE * (w.xx + w.yy + w.zz);
    if (k11 + k22 > least && k11 * k22 - k12 * k12 > least * (k11 + k22))
        return false;
    bool both = k11 + k22 <= least;
    along[0] = both ? u[0] : k11 > k22 ? -k12 : k22;
    along[1] = both ? u[1] : k11 > k22 ? k11 : -k12;
    double length = sqrt(along[0] * along[0] + along[1] * along[1]);
    if (length == 0)
        return false;
    along[0] /= length;
    along[1] /= length;
    return true;
}

void contact_reach_cap(const body_table *bodies, const contact *c, sym3 w, guided_point *p)
{
    vec3 va = point_velocity(bodies, c, c->a), vb = point_velocity(bodies, c, c->b), tangent[2], u = vec3_sub(va, vb);
    double least = RESOLVED_SHARE * (vec3_length(va) + vec3_length(vb));
    double approach = p->bias - vec3_dot(u, c->normal), limit = c->impulse_limit;
    if (approach <= least || !isfinite(limit) || vec3_dot(c->normal, sym3_mul_vec(w, c->normal)) * limit >= approach)
        return;
    p->normal_mass = fmax(p->normal_mass, limit / approach);
    contact_tangents(c->normal, &tangent[0], &tangent[1]);
    double along[2], slip[2] = {vec3_dot(u, tangent[0]), vec3_dot(u, tangent[1])}, cone = c->friction_kinetic * limit;
    if (!locked_tangent(w, tangent, slip, along))
        return;
    double sliding = along[0] * slip[0] + along[1] * slip[1];
    if (fabs(sliding) <= least || fabs(sliding) * p->slide >= cone)
        return;
    double change = (sliding > 0 ? -cone : cone) - (along[0] * p->tangent[0] + along[1] * p->tangent[1]);
    p->tangent[0] += change * along[0];
    p->tangent[1] += change * along[1];
    p->slides = true;
}

static bool turns(const solver_body *b)
{
    return b->inverse_inertia.xx + b->inverse_inertia.yy + b->inverse_inertia.zz > 0;
}

void contact_rows_reach_caps(solver *s, const body_table *bodies, const contact_array *contacts)
{
    for (int32_t i = 0; i < s->contacts.count && s->guided.count > 0; i++) {
        contact_row *row = &s->contacts.data[i];
        const solver_body *a = &s->bodies.data[row->a], *b = &s->bodies.data[row->b];
        if ((!a->guided && !b->guided) || turns(a) || turns(b))
            continue;
        guided_point p = {row->bias, row->slide, row->normal_mass, {row->impulse[1], row->impulse[2]}, false};
        contact_reach_cap(bodies, &contacts->data[row->contact], inverse_mass_of_both(a->inverse_mass, b->inverse_mass),
                          &p);
        row->normal_mass = p.normal_mass;
        row->impulse[1] = p.tangent[0];
        row->impulse[2] = p.tangent[1];
        row->slip = p.slides ? HUGE_VAL : row->slip;
    }
}

/* ---- rows ---- */

static void fill_row(contact_row *row, const solver_body *a, const solver_body *b, const contact *c, vec3 arm_a,
                     vec3 arm_b)
{
    vec3 direction[3] = {c->normal};
    contact_tangents(c->normal, &direction[1], &direction[2]);
    for (int i = 0; i < 3; i++)
        row->axis[i] =
            row_axis_make(a, b, direction[i], vec3_cross(arm_a, direction[i]), vec3_cross(arm_b, direction[i]));
    row->normal_mass = 1 / contact_row_coupling(row, a, b, 0, 0);
    double k11 = contact_row_coupling(row, a, b, 1, 1), k12 = contact_row_coupling(row, a, b, 1, 2);
    double k22 = contact_row_coupling(row, a, b, 2, 2), square = k11 * k22 - k12 * k12;
    /* Of a matrix whose couplings are positive: none where rounding has eaten it. */
    double scale = square > 0 ? 1 / square : 0;
    row->stick[0] = k22 * scale;
    row->stick[1] = -k12 * scale;
    row->stick[2] = k11 * scale;
    row->slide = 2 / (k11 + k22);
    row->limit = c->impulse_limit;
    row->friction_kinetic = c->friction_kinetic;
    row->friction_static = c->friction_static > c->friction_kinetic ? c->friction_static : c->friction_kinetic;
    double u1 = row_axis_velocity(&row->axis[1], a, b), u2 = row_axis_velocity(&row->axis[2], a, b);
    row->slip = sqrt(u1 * u1 + u2 * u2);
}

fram_status contact_rows_make(solver *s, const solver_settings *settings, double dt, const body_table *bodies,
                              contact_array *contacts, fram_error *error)
{
    array_clear(&s->contacts);
    if (!array_reserve(s->ctx, &s->contacts, contacts->count))
        return error_memory(error);
    for (int32_t i = 0; i < contacts->count; i++) {
        contact *c = &contacts->data[i];
        if (!body_is_dynamic(bodies, c->a) && !body_is_dynamic(bodies, c->b)) {
            contact_load_immovable(bodies, c);
            continue;
        }
        contact_row *row = &s->contacts.data[s->contacts.count++];
        const contact_row *before = s->contacts.count > 1 ? row - 1 : NULL;
        memset(row, 0, sizeof *row);
        row->contact = i;
        row->a = solver_contact_place(s, bodies, contacts, i, c->a, before);
        row->b = solver_contact_place(s, bodies, contacts, i, c->b, before);
        if (row->a < 0 || row->b < 0)
            return error_memory(error);
        c->arm_a = vec3_sub(c->point, bodies->position[c->a]);
        c->arm_b = vec3_sub(c->point, bodies->position[c->b]);
        fill_row(row, &s->bodies.data[row->a], &s->bodies.data[row->b], c, c->arm_a, c->arm_b);
        row->bias = wanted_velocity(c, settings, dt);
    }
    return FRAM_OK;
}

/* ---- warm start ---- */

/* Largest friction impulse: mu_s p_n while sticking, mu_k p_n once sliding.  A contact slides when kinetic friction
   could not stop it within this step; below that it counts as sticking, so that what a finite number of sweeps leaves
   of a velocity does not free a body at rest. */
static double friction_radius(const contact_row *row)
{
    double kinetic = row->friction_kinetic * row->impulse[0];
    return row->slip * row->slide > kinetic ? kinetic : row->friction_static * row->impulse[0];
}

static void project_friction(const contact_row *row, double *p1, double *p2)
{
    double square = *p1 * *p1 + *p2 * *p2, radius = friction_radius(row);
    if (square <= radius * radius)
        return;
    double scale = radius / sqrt(square);
    *p1 *= scale;
    *p2 *= scale;
}

bool contact_rows_recall(solver *s, const contact_array *contacts, const contact_memory_table *memory)
{
    if (!array_resize(s->ctx, &s->recalled, contacts->count))
        return false;
    contacts_recall(memory, contacts, 0, contacts->count, s->recalled.data);
    for (int32_t i = 0; i < s->contacts.count; i++) {
        contact_row *row = &s->contacts.data[i];
        double p[3];
        for (int k = 0; k < 3; k++)
            p[k] = vec3_dot(row->axis[k].direction, s->recalled.data[row->contact]);
        row->impulse[0] = fmin(fmax(p[0], 0), row->limit);
        project_friction(row, &p[1], &p[2]);
        row->impulse[1] = p[1];
        row->impulse[2] = p[2];
    }
    return true;
}

/* ---- one sweep ---- */

/* Sticking impulse by the exact 2 x 2 block; when that leaves the cone, a projected step, whose rest point opposes the
   sliding velocity.  Both are free of the choice of tangents: friction is isotropic. */
static void solve_friction(contact_row *row, solver_body *a, solver_body *b)
{
    double u1 = row_axis_velocity(&row->axis[1], a, b), u2 = row_axis_velocity(&row->axis[2], a, b);
    double p1 = row->impulse[1] - (row->stick[0] * u1 + row->stick[1] * u2);
    double p2 = row->impulse[2] - (row->stick[1] * u1 + row->stick[2] * u2);
    double radius = friction_radius(row);
    if (p1 * p1 + p2 * p2 > radius * radius) {
        p1 = row->impulse[1] - row->slide * u1;
        p2 = row->impulse[2] - row->slide * u2;
        project_friction(row, &p1, &p2);
    }
    row_axis_push(&row->axis[1], a, b, p1 - row->impulse[1]);
    row_axis_push(&row->axis[2], a, b, p2 - row->impulse[2]);
    row->impulse[1] = p1;
    row->impulse[2] = p2;
}

static void solve_contact(solver *s, contact_row *row)
{
    solver_body *a = &s->bodies.data[row->a], *b = &s->bodies.data[row->b];
    double u = row_axis_velocity(&row->axis[0], a, b);
    double p = row->impulse[0] - (u - row->bias) * row->normal_mass;
    p = p > 0 ? p : 0;
    p = p < row->limit ? p : row->limit;
    row_axis_push(&row->axis[0], a, b, p - row->impulse[0]);
    row->impulse[0] = p;
    if (row->friction_static > 0)
        solve_friction(row, a, b);
}

void contact_row_sweep(solver *s, bool back)
{
    contact_row *rows = s->contacts.data;
    for (int32_t first = 0, end; first < s->contacts.count; first = end) {
        for (end = first + 1; end < s->contacts.count && rows[end].a == rows[first].a && rows[end].b == rows[first].b;)
            end++;
        for (int32_t i = first; i < end; i++)
            solve_contact(s, &rows[back ? first + end - 1 - i : i]);
    }
}

double contact_row_residual(const solver *s, const contact_row *row)
{
    double u = row_axis_velocity(&row->axis[0], &s->bodies.data[row->a], &s->bodies.data[row->b]) - row->bias;
    double residual = fabs(u);
    if (row->impulse[0] <= 0)
        residual = u < 0 ? -u : 0;
    if (row->impulse[0] >= row->limit)
        residual = row->limit > 0 && u > 0 ? u : 0;
    return residual;
}

double contact_row_slip_residual(const solver *s, const contact_row *row)
{
    if (row->friction_static <= 0)
        return 0;
    /* What one more solve of this contact alone would change, as a velocity. */
    contact_row again = *row;
    solver_body a = s->bodies.data[row->a], b = s->bodies.data[row->b];
    solve_friction(&again, &a, &b);
    double d1 = again.impulse[1] - row->impulse[1], d2 = again.impulse[2] - row->impulse[2];
    return sqrt(d1 * d1 + d2 * d2) / row->slide;
}

/* ---- write back ---- */

fram_status contact_rows_finish(solver *s, const body_table *bodies, contact_array *contacts,
                                contact_memory_table *memory, fram_error *error)
{
    for (int32_t i = 0; i < s->contacts.count; i++) {
        const contact_row *row = &s->contacts.data[i];
        memcpy(contacts->data[row->contact].impulse, row->impulse, sizeof row->impulse);
    }
    return contacts_remember(s, bodies, contacts, memory, error);
}
