/* Hulls that meet hulls and walls: impact and friction against closed forms, books of momentum and energy, loads by
   vessel.  No water, so that nothing else acts. */
#include "scene.h"

#include "bodies/energy.h"
#include "sim/ice_loads.h"

#include <stdio.h>

#define DRY "environment: {water: false}\nice: {source: none}\n"
#define SEA "domain: {boundary: open, x_min: -500, x_max: 500, y_min: -500, y_max: 500}\n"

static int32_t body_of(const scene *k, int32_t vessel) { return k->w.vessels.body[vessel]; }
static double mass_of(const scene *k, int32_t vessel) { return k->w.bodies.mass[body_of(k, vessel)]; }
static vec3 velocity_of(const scene *k, int32_t vessel) { return k->w.bodies.velocity[body_of(k, vessel)]; }

static vec3 momentum(const scene *k)
{
    vec3 sum = {0, 0, 0};
    for (int32_t v = 0; v < k->w.vessels.count; v++)
        sum = vec3_mad(sum, velocity_of(k, v), mass_of(k, v));
    return sum;
}

/* ---- head on ---- */

/* Their faces meet level with the centres of mass, so that neither is turned. */
static const char head_on[] = "run: {time_step: 0.01, duration: 100}\nvessels:\n"
                              "  - {name: a, mode: free, x: -35.05, speed: 1.5,\n"
                              "     hull: {form: box, length: 40, beam: 20, draught: 4, freeboard: 4}}\n"
                              "  - {name: b, mode: free, x: 0, heading_deg: 180, speed: 0.3,\n"
                              "     hull: {form: box, length: 30, beam: 16, draught: 4, freeboard: 4}}\n" DRY SEA;

/* Bare hulls do not rebound: both go on with the velocity of the common centre of mass (plastic impact). */
START_TEST(bare_hulls_meet_plastically)
{
    scene k;
    scene_open(&k, head_on);
    double a = mass_of(&k, 0), b = mass_of(&k, 1), common = (1.5 * a - 0.3 * b) / (a + b);
    vec3 before = momentum(&k);
    scene_steps(&k, 50);
    ck_assert_double_eq_tol(velocity_of(&k, 0).x, common, 1e-6);
    ck_assert_double_eq_tol(velocity_of(&k, 1).x, common, 1e-6);
    vec3 after = momentum(&k);
    ck_assert_double_eq_tol(after.x, before.x, 1e-9 * a);
    ck_assert_double_eq_tol(after.y, 0, 1e-9 * a);
    scene_close(&k);
}
END_TEST

typedef struct impact {
    double depth, force, energy, expected_depth, expected_force, expected_energy;
} impact;

/* Two hulls with fenders of ka and kb: k = ka kb / (ka + kb), m the reduced mass, v the approach. */
static impact with_fenders(const char *step, const char *first, const char *second, double stiffness)
{
    const char *const list[] = {step, first, second};
    scene k;
    impact i = {0};
    scene_open_with(&k, head_on, list, 3);
    double a = mass_of(&k, 0), b = mass_of(&k, 1), reduced = a * b / (a + b), v = 1.8;
    i.expected_depth = v * sqrt(reduced / stiffness);
    i.expected_force = v * sqrt(reduced * stiffness);
    i.expected_energy = 0.5 * reduced * v * v;
    double energy = body_kinetic_energy(&k.ctx, &k.w.bodies), dt = k.s.run.time_step;
    vec3 before = momentum(&k);
    for (int n = 0; n * dt < 6; n++) {
        scene_steps(&k, 1);
        for (int32_t c = 0; c < k.w.scratch.contacts.count; c++)
            i.depth = testing_larger(i.depth, k.w.scratch.contacts.data[c].depth);
        const ice_load *loads = k.w.scratch.ice_loads.data;
        i.force = testing_larger(i.force, loads[1].hulls.force.x);
        ck_assert_double_eq_tol(loads[0].hulls.force.x, -loads[1].hulls.force.x, 1e-9 * i.expected_force);
        ck_assert(loads[0].total.force.x == 0 && loads[1].total.force.x == 0);
    }
    i.energy = energy - body_kinetic_energy(&k.ctx, &k.w.bodies);
    vec3 after = momentum(&k);
    ck_assert_double_eq_tol(after.x, before.x, 1e-9 * a);
    scene_close(&k);
    return i;
}

/* A fender that yields by k d stops the approach at d = v sqrt(m / k), with v sqrt(m k), and keeps m v^2 / 2. */
static void check_fenders(const char *first, const char *second, double stiffness)
{
    impact coarse = with_fenders("run.time_step=0.02", first, second, stiffness);
    impact fine = with_fenders("run.time_step=0.005", first, second, stiffness);
    ck_assert_double_eq_tol(fine.depth / fine.expected_depth, 1, 0.02);
    ck_assert_double_eq_tol(fine.force / fine.expected_force, 1, 0.02);
    ck_assert_double_eq_tol(fine.energy / fine.expected_energy, 1, 1e-6);
    ck_assert_double_eq_tol(coarse.energy / coarse.expected_energy, 1, 1e-6);
    /* First order in the step, as the integration is. */
    double far = fabs(coarse.depth / coarse.expected_depth - 1), near = fabs(fine.depth / fine.expected_depth - 1);
    ck_assert_msg(near < 0.5 * far, "off by %g with 0.02 s, by %g with 0.005 s", far, near);
}

START_TEST(fenders_stop_at_their_depth)
{
    check_fenders("vessels.a.fender_stiffness=2e6", "vessels.b.fender_stiffness=auto", 2e6);
}
END_TEST

START_TEST(fenders_of_two_yield_in_series)
{
    check_fenders("vessels.a.fender_stiffness=3e6", "vessels.b.fender_stiffness=6e6", 2e6);
}
END_TEST

/* ---- books ---- */

static const char skewed[] = "run: {time_step: 0.01, duration: 100}\nvessels:\n"
                             "  - {name: a, mode: free, x: -42, y: 3, speed: 2, heading_deg: 10,\n"
                             "     hull: {length: 50, beam: 14, draught: 5, freeboard: 3, parallel_midbody: 0.3}}\n"
                             "  - {name: b, mode: free, x: 4, y: 0, heading_deg: 70,\n"
                             "     hull: {form: box, length: 60, beam: 16, draught: 4, freeboard: 3}}\n"
                             "  - {name: c, mode: free, x: 26, y: -3, heading_deg: 80, speed: 0.1,\n"
                             "     hull: {form: box, length: 50, beam: 12, draught: 4, freeboard: 3}}\n" DRY SEA;

static vec3 angular_momentum(const scene *k)
{
    const body_table *b = &k->w.bodies;
    vec3 sum = {0, 0, 0};
    for (int32_t v = 0; v < k->w.vessels.count; v++) {
        int32_t i = body_of(k, v);
        mat3 r = quat_matrix(b->orientation[i]);
        vec3 spin = sym3_mul_vec(b->inertia[i], mat3_tmul_vec(r, b->angular_velocity[i]));
        sum = vec3_add(sum, mat3_mul_vec(r, spin));
        sum = vec3_add(sum, vec3_cross(b->position[i], vec3_scale(b->velocity[i], b->mass[i])));
    }
    return sum;
}

/* Velocity of a body's point by the arm that the solver took. */
static vec3 point_velocity(vec3 velocity, vec3 spin, vec3 arm) { return vec3_add(velocity, vec3_cross(spin, arm)); }

/* Energy that contacts took in a step: impulses times the mean of the velocities before and after. */
static double work_of_contacts(const scene *k, const vec3 *velocity, const vec3 *spin)
{
    const body_table *b = &k->w.bodies;
    double sum = 0;
    for (int32_t i = 0; i < k->w.scratch.contacts.count; i++) {
        const contact *c = &k->w.scratch.contacts.data[i];
        vec3 old = vec3_sub(point_velocity(velocity[c->a], spin[c->a], c->arm_a),
                            point_velocity(velocity[c->b], spin[c->b], c->arm_b));
        vec3 new = vec3_sub(point_velocity(b->velocity[c->a], b->angular_velocity[c->a], c->arm_a),
                            point_velocity(b->velocity[c->b], b->angular_velocity[c->b], c->arm_b));
        sum += 0.5 * vec3_dot(contact_impulse(c), vec3_add(old, new));
    }
    return sum;
}

/* Three hulls pushed together askew, with friction: momentum stays, and energy goes where contacts take it. */
static void check_books(const char *const *list, int count, bool fenders)
{
    scene k;
    scene_open_with(&k, skewed, list, count);
    vec3 linear = momentum(&k), angular = angular_momentum(&k), velocity[8], spin[8];
    double scale = 2 * mass_of(&k, 0), start = body_kinetic_energy(&k.ctx, &k.w.bodies), taken = 0, turned = 0;
    ck_assert_int_le(k.w.bodies.count, 8);
    for (int n = 0; n < 800; n++) {
        memcpy(velocity, k.w.bodies.velocity, (size_t)k.w.bodies.count * sizeof *velocity);
        memcpy(spin, k.w.bodies.angular_velocity, (size_t)k.w.bodies.count * sizeof *spin);
        double before = body_kinetic_energy(&k.ctx, &k.w.bodies);
        scene_steps(&k, 1);
        double work = work_of_contacts(&k, velocity, spin), after = body_kinetic_energy(&k.ctx, &k.w.bodies);
        taken -= work;
        /* Turning bodies change their energy a little without any contact: gyroscopic terms of first order. */
        turned += after - before - work;
        ck_assert_msg(work <= 1e-9 * start, "step %d: contacts give %g J", n, work);
        vec3 now = vec3_sub(momentum(&k), linear);
        ck_assert_msg(vec3_length(now) < 1e-9 * scale, "step %d: momentum is off by %g N s", n, vec3_length(now));
    }
    ck_assert_msg(taken > 0.05 * start, "the hulls did not meet: %g of %g J", taken, start);
    ck_assert_msg(fabs(turned) < 1e-4 * start, "%g J of %g are not accounted for", turned, start);
    vec3 off = vec3_sub(angular_momentum(&k), angular);
    /* Rigid hulls are drawn apart after they met, which moves them along the normals of contacts. */
    double least = fenders ? 1e-6 : 1e-3;
    ck_assert_msg(vec3_length(off) < least * scale * 40, "angular momentum is off by %g of %g N m s", vec3_length(off),
                  scale * 40);
    scene_close(&k);
}

START_TEST(books_of_bare_hulls_close) { check_books(NULL, 0, false); }
END_TEST

START_TEST(books_of_fenders_close)
{
    static const char *const list[] = {"vessels.a.fender_stiffness=4e6", "vessels.c.fender_stiffness=2e6"};
    check_books(list, 2, true);
}
END_TEST

/* ---- friction ---- */

/* Slides along a body that does not move, pressed on it by 1 MN: slows down by mu N / m, mu that of sliding, and then
   stays. */
static void check_slide(const char *text, double mu, double toward)
{
    scene k;
    fram_error error = {0};
    scene_open(&k, text);
    int32_t body = body_of(&k, 0);
    double press = 1e6, m = mass_of(&k, 0), v0 = velocity_of(&k, 0).x, dt = k.s.run.time_step;
    double stop = v0 * m / (mu * press);
    ck_assert(v0 > 0);
    for (int n = 1; n * dt < stop + 4; n++) {
        assert_ok(world_add_wrench(&k.ctx, &k.w, body, (wrench){{0, toward * press, 0}, {0, 0, 0}}, &error), error);
        scene_steps(&k, 1);
        double expected = fmax(0, v0 - mu * press * n * dt / m), found = velocity_of(&k, 0).x;
        ck_assert_msg(fabs(found - expected) < 0.01 * v0, "t = %g s: %g m/s, expected %g", n * dt, found, expected);
        vec3 load = k.w.scratch.ice_loads.data[0].hulls.force;
        if (n * dt > 1 && n * dt < stop - 0.5) {
            ck_assert_double_eq_tol(load.x, -mu * press, 0.02 * mu * press);
            ck_assert_double_eq_tol(load.y, -toward * press, 0.02 * press);
        }
    }
    ck_assert_double_eq_tol(velocity_of(&k, 0).x, 0, 1e-6);
    scene_close(&k);
}

START_TEST(friction_on_another_hull)
{
    check_slide("run: {time_step: 0.01, duration: 100}\nvessels:\n"
                "  - {name: a, mode: free, x: -20, y: -16.0001, speed: 1,\n"
                "     hull: {form: box, length: 60, beam: 16, draught: 4, freeboard: 3}}\n"
                "  - {name: quay, mode: prescribed,\n"
                "     hull: {form: box, length: 160, beam: 16, draught: 4, freeboard: 3}}\n"
                "ice: {source: none, friction: {hull_hull_static: 0.4, hull_hull_kinetic: 0.2}}\n"
                "environment: {water: false}\n" SEA,
                0.2, 1);
}
END_TEST

START_TEST(friction_on_a_wall)
{
    check_slide("run: {time_step: 0.01, duration: 100}\n"
                "vessel:\n  mode: free\n  x: -20\n  y: -31.9999\n  speed: 1\n"
                "  hull: {form: box, length: 60, beam: 16, draught: 4, freeboard: 3}\n"
                "ice: {source: none, friction: {hull_wall_static: 0.5, hull_wall_kinetic: 0.3}}\n"
                "domain: {x_min: -80, x_max: 80, y_min: -40, y_max: 40}\nenvironment: {water: false}\n",
                0.3, -1);
}
END_TEST

/* A state in which hulls never met has no rows of such contacts, and then one for each vessel. */
START_TEST(contacts_are_kept_from_the_first_on)
{
    scene k;
    scene_open(&k, head_on);
    ck_assert_int_eq(k.w.hull_contacts.count, 0);
    scene_steps(&k, 1);
    ck_assert_int_eq(k.w.hull_contacts.count, 0);
    scene_steps(&k, 40);
    ck_assert_int_eq(k.w.hull_contacts.count, 2);
    scene_close(&k);
}
END_TEST

TEST_MAIN("hull_contact", bare_hulls_meet_plastically, fenders_stop_at_their_depth, fenders_of_two_yield_in_series,
          books_of_bare_hulls_close, books_of_fenders_close, friction_on_another_hull, friction_on_a_wall,
          contacts_are_kept_from_the_first_on)
