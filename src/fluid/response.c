#include "fluid/response.h"

#include "base/pool.h"
#include "fluid/added_mass.h"
#include "fluid/facet.h"
#include "fluid/weak_drag_kernel.h"

enum { BLOCK_SLOTS = 256, GROUP_SLOTS = 8 };
/* Added mass is whole when this part of a floe is under water. */
#define WHOLE_FROM 0.25
/* Damping is that of waves: whole while more than this part of a floe is above water, none when it is under it. */
#define WAVES_FROM 0.05

typedef struct response_work {
    context *ctx;
    const media *media;
    const drag_coefficients *coefficients;
    const prism_response *settings;
    double time_step;
    body_table *bodies;
    const shape_store *shapes;
    const double *volume;
    wrench *loads;
    bool screened; /* only strong drag is of interest, and `weak` says where there is none */
    drag_limits weak;
} response_work;

/* A prism as this room sees it. */
typedef struct prism_view {
    /* Speeds relative to the water, in its plane and along its axis [m/s]; spin about and across the axis [rad/s]. */
    double along, up, turn, tilt;
    double area, radius, half_height;
    /* Only where added mass or damping are asked for: body axes. */
    mat3 rotation;
    vec3 velocity, spin;
    polygon_moments moments;
} prism_view;

static vec3 times(vec3 a, vec3 b) { return (vec3){a.x * b.x, a.y * b.y, a.z * b.z}; }
/* Written out: the functions of the language ask about numbers that are none, and are called. */
static double positive(double x) { return x > 0 ? x : 0; }

static bool is_plain(const prism_response *s) { return !s->added_mass && !(s->damping_ratio > 0); }

static prism_view view_of(const response_work *w, int32_t slot)
{
    const body_table *b = w->bodies;
    const shape_table *s = &w->shapes->shapes;
    int32_t shape = b->shape[slot];
    vec3 velocity = vec3_sub(b->velocity[slot], prism_current(w->media, b, w->shapes, slot));
    vec3 spin = b->angular_velocity[slot];
    quat q = b->orientation[slot];
    vec3 axis = {2 * (q.x * q.z + q.w * q.y), 2 * (q.y * q.z - q.w * q.x), 1 - 2 * (q.x * q.x + q.y * q.y)};
    double up = vec3_dot(velocity, axis), turn = vec3_dot(spin, axis);
    prism_view v = {.along = sqrt(positive(vec3_dot(velocity, velocity) - up * up)),
                    .up = fabs(up),
                    .turn = fabs(turn),
                    .tilt = sqrt(positive(vec3_dot(spin, spin) - turn * turn)),
                    .area = s->area[shape],
                    .radius = s->plan_radius[shape],
                    .half_height = s->half_height[shape]};
    if (!is_plain(w->settings)) {
        v.rotation = quat_matrix(q);
        v.velocity = mat3_tmul_vec(v.rotation, velocity);
        v.spin = mat3_tmul_vec(v.rotation, spin);
        v.moments = polygon_moments_of(shape_outline(w->shapes, shape));
    }
    return v;
}

/* ---- drag by velocity ---- */

typedef struct drag_bound {
    vec3 linear, angular; /* [N s/m], [N m s], body axes */
} drag_bound;

/* Bounds of the derivatives: twice the drag of every face at its largest speed over that speed; sides are those of the
   box around the prism, both caps wet. */
static drag_bound bound_drag(const response_work *w, int32_t slot, const prism_view *v)
{
    const drag_coefficients *c = &w->coefficients[w->bodies->material[slot]];
    double form = w->media->water_density * c->water_form, skin = w->media->water_density * c->water_skin;
    double r = v->radius, h = v->half_height, side = 4 * r * h;
    double along = v->along + r * v->turn, up = v->up + r * v->tilt;
    double push = form * side * along, rub = skin * (2 * v->area + 4 * side) * (along + up);
    double flat = push + rub, heave = form * v->area * up + skin * 4 * side * (along + up);
    /* Levers squared, over a plank of length 2 r: a third of r^2. */
    double tilt = r * r * (1.0 / 3) * heave + h * h * flat, yaw = r * r * ((1.0 / 3) * push + 0.5 * rub);
    return (drag_bound){{flat, flat, heave}, {tilt, tilt, yaw}};
}

static double implicit_part(double bound, double mass, double time_step)
{
    return positive(time_step * bound - EXPLICIT_DRAG * mass);
}

/* ---- one prism ---- */

static double wave_share(const response_work *w, int32_t slot, const prism_view *v)
{
    double whole = 2 * v->half_height * v->area;
    return fmax(0, fmin(1, (whole - w->volume[slot]) / (WAVES_FROM * whole)));
}

static double wet_share(const response_work *w, int32_t slot, const prism_view *v)
{
    double whole = 2 * v->half_height * v->area;
    double share = w->volume[slot] / (WHOLE_FROM * whole);
    return share < 1 ? positive(share) : 1;
}

/* How much of the added mass came over the last step, as if the floe sank evenly over its height. */
static double new_share(const response_work *w, int32_t slot, const prism_view *v)
{
    double upright = v->rotation.m[2][2], tilt = sqrt(fmax(0, 1 - upright * upright));
    double reach = v->half_height * fabs(upright) + v->radius * tilt, height = w->bodies->position[slot].z;
    double before = height - w->time_step * w->bodies->velocity[slot].z;
    double now = fmin(1, fmax(0, (reach - height) / (2 * WHOLE_FROM * reach)));
    return fmax(0, now - fmin(1, fmax(0, (reach - before) / (2 * WHOLE_FROM * reach))));
}

/* Sets what added mass there is, and adds Kirchhoff's terms; the dynamics know those of turning alone. */
static void add_mass(const response_work *w, int32_t slot, const prism_view *v, double share, vec3 *mass, vec3 *inertia)
{
    plate_added_mass plate = plate_added_mass_of(&v->moments, share * w->media->water_density);
    *mass = vec3_make(0, 0, plate.heave);
    *inertia = vec3_make(plate.roll, plate.pitch, 0);
    vec3 p = times(*mass, v->velocity);
    vec3 force = vec3_sub(times(*mass, vec3_cross(v->spin, v->velocity)), vec3_cross(v->spin, p));
    vec3 moment = vec3_neg(vec3_cross(v->velocity, p));
    /* Water that is met must be set going. */
    if (share > 0)
        force.z -= fmin(1, new_share(w, slot, v) / share) * mass->z * v->velocity.z / w->time_step;
    wrench *load = &w->loads[slot];
    load->force = vec3_add(load->force, mat3_mul_vec(v->rotation, force));
    load->moment = vec3_add(load->moment, mat3_mul_vec(v->rotation, moment));
}

/* Part of the critical damping of the springs that the water plane makes; adds its force and its bound. */
static void add_damping(const response_work *w, int32_t slot, const prism_view *v, double share, vec3 mass,
                        vec3 inertia, drag_bound *bound)
{
    const body_table *b = w->bodies;
    double weight = w->media->water_density * w->media->gravity, twice = 2 * share * w->settings->damping_ratio;
    double heave = twice * sqrt(weight * v->moments.area * (b->mass[slot] + mass.z));
    double roll = twice * sqrt(weight * v->moments.xx * (b->inertia[slot].xx + inertia.x));
    double pitch = twice * sqrt(weight * v->moments.yy * (b->inertia[slot].yy + inertia.y));
    vec3 force = {0, 0, -heave * v->velocity.z}, moment = {-roll * v->spin.x, -pitch * v->spin.y, 0};
    wrench *load = &w->loads[slot];
    load->force = vec3_add(load->force, mat3_mul_vec(v->rotation, force));
    load->moment = vec3_add(load->moment, mat3_mul_vec(v->rotation, moment));
    bound->linear.z += heave;
    bound->angular.x += roll;
    bound->angular.y += pitch;
}

static void respond(const response_work *w, int32_t slot)
{
    const vec3 none = {0, 0, 0};
    body_table *b = w->bodies;
    vec3 mass = none, inertia = none;
    prism_view v = view_of(w, slot);
    double share = wet_share(w, slot, &v), dt = w->time_step;
    drag_bound bound = share > 0 ? bound_drag(w, slot, &v) : (drag_bound){none, none};
    if (w->settings->added_mass)
        add_mass(w, slot, &v, share, &mass, &inertia);
    if (w->settings->damping_ratio > 0)
        add_damping(w, slot, &v, share * wave_share(w, slot, &v), mass, inertia, &bound);
    mass.x += implicit_part(bound.linear.x, b->mass[slot] + mass.x, dt);
    mass.y += implicit_part(bound.linear.y, b->mass[slot] + mass.y, dt);
    mass.z += implicit_part(bound.linear.z, b->mass[slot] + mass.z, dt);
    inertia.x += implicit_part(bound.angular.x, b->inertia[slot].xx + inertia.x, dt);
    inertia.y += implicit_part(bound.angular.y, b->inertia[slot].yy + inertia.y, dt);
    inertia.z += implicit_part(bound.angular.z, b->inertia[slot].zz + inertia.z, dt);
    b->added_mass[slot] = mass;
    b->added_inertia[slot] = inertia;
}

/* Slots first..first+7. */
static void respond_group(const response_work *w, int32_t first)
{
    body_table *b = w->bodies;
    unsigned weak = 0;
    if (w->screened)
        weak = KERNEL_PICK(w->ctx, weak_drag)(&w->weak, b, &w->shapes->shapes, first / GROUP_SLOTS);
    for (int32_t slot = first; slot < first + GROUP_SLOTS && slot < b->count; slot++) {
        if (weak >> (slot - first) & 1u)
            b->added_mass[slot] = b->added_inertia[slot] = (vec3){0, 0, 0};
        else if (body_is_dynamic(b, slot) && b->shape[slot] >= 0 &&
                 w->shapes->shapes.kind[b->shape[slot]] == SHAPE_PRISM)
            respond(w, slot);
    }
}

static void respond_block(void *arg, int32_t block, int32_t thread)
{
    (void)thread;
    const response_work *w = arg;
    int32_t first = block * BLOCK_SLOTS, end = first + BLOCK_SLOTS;
    if (end > w->bodies->count)
        end = w->bodies->count;
    int32_t slot = body_next_moving(w->bodies, first, end);
    while (slot < end) {
        int32_t group = slot - slot % GROUP_SLOTS;
        respond_group(w, group);
        slot = body_next_moving(w->bodies, group + GROUP_SLOTS, end);
    }
}

/* The screening by weak_drag_kernel.h takes a limit this part of implicit_part's own, so that rounding decides nothing.
 */
#define SCREEN_MARGIN 0.999

static drag_limits limits_of(const media *m, const drag_coefficients coefficients[MATERIAL_COUNT], double time_step)
{
    drag_limits limits = {.current = m->current, .rate = SCREEN_MARGIN * EXPLICIT_DRAG / time_step};
    for (int i = 0; i < MATERIAL_COUNT; i++) {
        limits.form[i] = m->water_density * coefficients[i].water_form;
        limits.skin[i] = m->water_density * coefficients[i].water_skin;
    }
    return limits;
}

void prisms_respond(context *ctx, const media *m, const drag_coefficients coefficients[MATERIAL_COUNT],
                    const prism_response *settings, double time_step, body_table *bodies, const shape_store *shapes,
                    const double *volume, wrench *loads)
{
    response_work w = {ctx,
                       m,
                       coefficients,
                       settings,
                       time_step,
                       bodies,
                       shapes,
                       volume,
                       loads,
                       is_plain(settings) && m->profile.count == 0,
                       limits_of(m, coefficients, time_step)};
    pool_run(ctx, respond_block, &w, pool_blocks(bodies->count, BLOCK_SLOTS));
}

/* ---- matrices ---- */

/* The body's velocity relative to the water, body axes. */
static pair6 relative_velocity(const hydrodynamics *h, const media *m, const body_table *b, int32_t slot, mat3 r)
{
    vec3 current = media_hull_current(m, h->depth);
    return (pair6){mat3_tmul_vec(r, vec3_sub(b->velocity[slot], current)), mat3_tmul_vec(r, b->angular_velocity[slot])};
}

static matrix6 diagonal_of(const matrix6 *a)
{
    matrix6 d = {0};
    for (int i = 0; i < 6; i++)
        d.m[i][i] = a->m[i][i];
    return d;
}

static matrix6 rigid_matrix(const body_table *b, int32_t slot)
{
    double m = b->mass[slot];
    sym3 i = b->inertia[slot];
    return (matrix6){{{m},
                      {0, m},
                      {0, 0, m},
                      {0, 0, 0, i.xx, i.xy, i.xz},
                      {0, 0, 0, i.xy, i.yy, i.yz},
                      {0, 0, 0, i.xz, i.yz, i.zz}}};
}

/* Kirchhoff's terms for all of A, less what the dynamics know: w x (diagonal of A's last block) w. */
static pair6 turning_terms(const matrix6 *a, pair6 v)
{
    pair6 p = matrix6_mul(a, v), shift = matrix6_mul(a, (pair6){vec3_cross(v.angular, v.linear), {0, 0, 0}});
    vec3 known = {a->m[3][3] * v.angular.x, a->m[4][4] * v.angular.y, a->m[5][5] * v.angular.z};
    vec3 force = vec3_sub(shift.linear, vec3_cross(v.angular, p.linear));
    vec3 moment = vec3_sub(shift.angular,
                           vec3_add(vec3_cross(v.linear, p.linear), vec3_cross(v.angular, vec3_sub(p.angular, known))));
    return (pair6){force, moment};
}

static double munk(const matrix6 *a, vec3 velocity)
{
    return -vec3_cross(velocity, matrix6_mul(a, (pair6){velocity, {0, 0, 0}}).linear).z;
}

double hydrodynamics_munk(const hydrodynamics *h, vec3 velocity)
{
    return h->measured ? 0 : munk(&h->added_mass, velocity);
}

static pair6 pair_sum(pair6 a, pair6 b, double scale)
{
    return (pair6){vec3_mad(a.linear, b.linear, scale), vec3_mad(a.angular, b.angular, scale)};
}

/* Kirchhoff's terms for all of A, but for what is measured. */
static pair6 steady_terms(const hydrodynamics *h, pair6 v)
{
    pair6 terms = turning_terms(&h->added_mass, v);
    if (h->measured)
        terms.angular.z -= munk(&h->added_mass, v.linear);
    return terms;
}

/* What the diagonals leave out of the water's load on a body that a joint leads: the joint bears it. */
static pair6 led_terms(const hydrodynamics *h, const matrix6 *damping, pair6 v)
{
    pair6 coupling = pair_sum(matrix6_mul(&h->damping, v), matrix6_mul(damping, v), -1);
    return pair_sum(steady_terms(h, v), coupling, -1);
}

/* What is made up for shrinks from one step to the next by this factor at least: under 1, so that it dies out; nearer
   to 1 more is made up for, and oscillations die out more slowly. */
#define DEFERRED_SHRINK 0.9
/* Instead of no coupling at all, in a division. */
#define LEAST_COUPLING 1e-300

/* Part of the contacts' load of the step before that is made up for.  In units in which the known matrix is 1 the whole
   one is 1 + K, and a load is made up for by -K / (1 + K) of it; held against a contact this repeats itself from step
   to step and must shrink.  No eigenvalue of K is under -f, f = |K| / sqrt 2 for couplings in pairs. */
static double deferred_share(const matrix6 *whole, const matrix6 *known)
{
    double sum = 0;
    for (int i = 0; i < 6; i++)
        for (int j = 0; j < i; j++)
            sum += whole->m[i][j] * whole->m[j][i] / (known->m[i][i] * known->m[j][j]);
    double f = sqrt(fmax(0, sum));
    return f < 1 ? fmin(1, DEFERRED_SHRINK * (1 - f) / fmax(f, LEAST_COUPLING)) : 0;
}

enum { HEAVE = 2 };

/* Damping of what is free to move: to a motion that a joint holds nothing is implicit, it bears all that damps it. */
static matrix6 damping_of_free(const matrix6 *damping, bool coupled)
{
    if (coupled)
        return *damping;
    matrix6 out = {0};
    out.m[HEAVE][HEAVE] = damping->m[HEAVE][HEAVE];
    return out;
}

void hydrodynamics_respond(const hydrodynamics *h, bool coupled, const media *m, double time_step,
                           const body_table *bodies, int32_t slot, const wrench *contacts, wrench *load)
{
    mat3 r = quat_matrix(bodies->orientation[slot]);
    pair6 v = relative_velocity(h, m, bodies, slot, r);
    matrix6 diagonal = diagonal_of(&h->added_mass), rigid = rigid_matrix(bodies, slot);
    matrix6 added = coupled ? h->added_mass : diagonal, damping = coupled ? h->damping : diagonal_of(&h->damping);
    pair6 force = {mat3_tmul_vec(r, load->force), mat3_tmul_vec(r, load->moment)};
    force = pair_sum(force, matrix6_mul(&damping, v), -1);
    matrix6 known = matrix6_sum(&rigid, &diagonal, 1), whole = matrix6_sum(&rigid, &added, 1);
    matrix6 implicit = damping_of_free(&damping, coupled);
    whole = matrix6_sum(&whole, &implicit, time_step);
    vec3 gyroscopic = {0, 0, 0};
    /* Damping alone couples nothing: all of it can be made up for. */
    double share = coupled ? deferred_share(&whole, &known) : 1;
    pair6 deferred = {mat3_tmul_vec(r, vec3_scale(contacts->force, share)),
                      mat3_tmul_vec(r, vec3_scale(contacts->moment, share))};
    if (coupled) {
        /* Known to the dynamics, who divide it by what they know: it must be divided by all, and then put back. */
        vec3 turning = matrix6_mul(&diagonal, v).angular;
        gyroscopic = vec3_cross(v.angular, vec3_add(sym3_mul_vec(bodies->inertia[slot], v.angular), turning));
        force = pair_sum(force, steady_terms(h, v), 1);
        force.angular = vec3_sub(force.angular, gyroscopic);
    }
    pair6 acceleration;
    if (!matrix6_solve(&whole, pair_sum(force, deferred, 1), &acceleration))
        return;
    pair6 changed = pair_sum(matrix6_mul(&known, acceleration), deferred, -1);
    if (!coupled)
        changed = pair_sum(changed, led_terms(h, &damping, v), 1);
    load->force = mat3_mul_vec(r, changed.linear);
    load->moment = mat3_mul_vec(r, vec3_add(changed.angular, gyroscopic));
}
