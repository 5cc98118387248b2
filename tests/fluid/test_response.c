/* What the water answers to motion: matrices of vessels, added mass and strong drag of prisms. */
#include "fluid/added_mass.h"
#include "fluid/response.h"
#include "samples.h"

typedef struct rig {
    context ctx;
    body_table bodies;
    shape_store shapes;
} rig;

static void rig_close(rig *r)
{
    table_free(&r->ctx, &r->bodies, &body_table_info);
    shape_store_free(&r->ctx, &r->shapes);
}

static int32_t rig_open(rig *r, double mass, sym3 inertia)
{
    *r = (rig){0};
    context_init(&r->ctx);
    int32_t slot = body_create(&r->ctx, &r->bodies, MOTION_DYNAMIC, MATERIAL_HULL);
    r->bodies.mass[slot] = mass;
    r->bodies.inertia[slot] = inertia;
    r->bodies.position[slot] = vec3_make(0, 0, -2);
    return slot;
}

/* Symmetric, with couplings of every kind, and positive. */
static matrix6 coupled_matrix(random_stream *r, double size)
{
    matrix6 a = {0};
    double f[6][6];
    for (int i = 0; i < 6; i++)
        for (int j = 0; j < 6; j++)
            f[i][j] = random_uniform(r, -1, 1) + (i == j ? 1.5 : 0);
    for (int i = 0; i < 6; i++)
        for (int j = 0; j < 6; j++)
            for (int k = 0; k < 6; k++)
                a.m[i][j] += 0.2 * size * f[k][i] * f[k][j];
    return a;
}

static void set_diagonal(body_table *b, int32_t slot, const matrix6 *a)
{
    b->added_mass[slot] = vec3_make(a->m[0][0], a->m[1][1], a->m[2][2]);
    b->added_inertia[slot] = vec3_make(a->m[3][3], a->m[4][4], a->m[5][5]);
}

static const wrench nothing = {{0, 0, 0}, {0, 0, 0}};

/* A step as the dynamics take it: global velocities by mass and added mass along body axes, turning with the
   gyroscopic term of all inertia that they know. */
static void step(body_table *b, int32_t slot, const wrench *load, double dt)
{
    mat3 r = quat_matrix(b->orientation[slot]);
    vec3 f = mat3_tmul_vec(r, load->force), added = b->added_mass[slot], turn = b->added_inertia[slot];
    double m = b->mass[slot];
    vec3 push = {f.x / (m + added.x), f.y / (m + added.y), f.z / (m + added.z)};
    sym3 i = b->inertia[slot];
    i.xx += turn.x, i.yy += turn.y, i.zz += turn.z;
    vec3 w = mat3_tmul_vec(r, b->angular_velocity[slot]);
    vec3 moment = vec3_sub(mat3_tmul_vec(r, load->moment), vec3_cross(w, sym3_mul_vec(i, w)));
    w = vec3_mad(w, sym3_mul_vec(sym3_inverse(i), moment), dt);
    b->velocity[slot] = vec3_mad(b->velocity[slot], mat3_mul_vec(r, push), dt);
    vec3 s = b->angular_velocity[slot] = mat3_mul_vec(r, w);
    quat q = b->orientation[slot], rate = quat_mul((quat){0, s.x, s.y, s.z}, q);
    double h = 0.5 * dt;
    b->orientation[slot] = quat_unit((quat){q.w + h * rate.w, q.x + h * rate.x, q.y + h * rate.y, q.z + h * rate.z});
    b->position[slot] = vec3_mad(b->position[slot], b->velocity[slot], dt);
}

/* From rest, the acceleration is that of all of M + A, whatever the attitude; and no force does nothing. */
START_TEST(whole_matrix_accelerates)
{
    random_stream r = random_begin(41, 0, 0);
    for (int n = 0; n < 20; n++) {
        rig k;
        int32_t slot = rig_open(&k, 900, (sym3){800, 900, 1000, 20, -30, 10});
        k.bodies.orientation[slot] = quat_from_roll_pitch_yaw(0.3, -0.2, random_uniform(&r, -3, 3));
        hydrodynamics h = {.added_mass = coupled_matrix(&r, 500)};
        set_diagonal(&k.bodies, slot, &h.added_mass);
        pair6 a = {random_vector(&r, 1), random_vector(&r, 1)};
        mat3 turn = quat_matrix(k.bodies.orientation[slot]);
        pair6 f = matrix6_mul(&h.added_mass, a);
        f.linear = vec3_mad(f.linear, a.linear, 900);
        f.angular = vec3_add(f.angular, sym3_mul_vec(k.bodies.inertia[slot], a.angular));
        wrench load = {mat3_mul_vec(turn, f.linear), mat3_mul_vec(turn, f.angular)};
        hydrodynamics_respond(&h, true, &still_water, 1e-3, &k.bodies, slot, &nothing, &load);
        step(&k.bodies, slot, &load, 1);
        assert_vec3_close(mat3_tmul_vec(turn, k.bodies.velocity[slot]), a.linear, 1e-12);
        wrench none = {{0, 0, 0}, {0, 0, 0}};
        rig still;
        slot = rig_open(&still, 900, (sym3){800, 900, 1000, 20, -30, 10});
        hydrodynamics_respond(&h, true, &still_water, 1e-3, &still.bodies, slot, &nothing, &none);
        ck_assert(vec3_length(none.force) == 0 && vec3_length(none.moment) == 0);
        rig_close(&still);
        rig_close(&k);
    }
}
END_TEST

/* Velocity of a point along n after a unit push there. */
static double answer(const matrix6 *mass, vec3 n, vec3 point)
{
    pair6 push = {n, vec3_cross(point, n)}, v;
    ck_assert(matrix6_solve(mass, push, &v));
    return vec3_dot(n, v.linear) + vec3_dot(push.angular, v.angular);
}

/* Contacts know the diagonal of the added mass only.  FPSO, supply ship, box: how a push by ice at stem, shoulder,
   side, flare, bilge and quarter is answered, against all of the matrix. */
START_TEST(contacts_meet_the_diagonal)
{
    static const struct {
        double length, beam, draught, block, up, forward, bound;
    } ships[] = {{200, 44, 12, 0.93, -1, 0.8, 0.03},
                 {76.2, 18.8, 6.55, 0.62, 0.5, 0, 0.03},
                 {60, 18, 4, 1, 1, 0, 0.035},
                 {76.2, 18.8, 6.55, 0.62, 2, -2, 0.075}};
    double apart = 0;
    for (size_t i = 0; i < sizeof ships / sizeof *ships; i++) {
        double l = ships[i].length, b = ships[i].beam, t = ships[i].draught, up = ships[i].up;
        double volume = l * b * t * ships[i].block, m = 1025 * volume, roll = 0.35 * b, turn = 0.25 * l;
        matrix6 added = ellipsoid_added_mass(vec3_make(0.5 * l, 0.5 * b, t), volume, 1025), diagonal = {0};
        added = matrix6_moved(&added, vec3_make(-ships[i].forward, 0, -up));
        for (int k = 0; k < 6; k++)
            diagonal.m[k][k] = added.m[k][k];
        const matrix6 rigid = {{{m},
                                {0, m},
                                {0, 0, m},
                                {0, 0, 0, m * roll * roll},
                                {0, 0, 0, 0, m * turn * turn},
                                {0, 0, 0, 0, 0, m * turn * turn}}};
        matrix6 whole = matrix6_sum(&rigid, &added, 1), known = matrix6_sum(&rigid, &diagonal, 1);
        const vec3 pushes[][2] = {{{-1, 0, 0}, {0.5 * l, 0, -up}},
                                  {{-0.7071, 0, 0.7071}, {0.5 * l, 0, -up}},
                                  {{-0.7071, 0.7071, 0}, {0.4 * l, -0.4 * b, -up}},
                                  {{0, 1, 0}, {0, -0.5 * b, -up}},
                                  {{0, 0.95, 0.31}, {0, -0.5 * b, -up}},
                                  {{0, 0.7071, 0.7071}, {0, -0.5 * b, -t - up}},
                                  {{0, 1, 0}, {-0.4 * l, -0.5 * b, -up}}};
        for (size_t k = 0; k < sizeof pushes / sizeof *pushes; k++) {
            double ratio = answer(&known, pushes[k][0], pushes[k][1]) / answer(&whole, pushes[k][0], pushes[k][1]);
            ck_assert_msg(fabs(ratio - 1) < ships[i].bound, "ship %d, push %d: %g", (int)i, (int)k, ratio);
            apart = fmax(apart, fabs(ratio - 1));
        }
    }
    ck_assert_msg(apart > 0.01, "%g: the diagonal would be all there is", apart);
}
END_TEST

/* Sway and yaw coupled as those of the supply ship of the MSS toolbox are, about a centre of mass 2 m ahead of
 * amidships.
 */
static int32_t open_ship(rig *k, hydrodynamics *h)
{
    int32_t slot = rig_open(k, 6e6, (sym3){2.6e8, 2.2e9, 2.2e9, 0, 0, 0});
    *h = (hydrodynamics){.added_mass = {{{7.6e5},
                                         {0, 5.3e6, 0, 0, 0, 5.7e7},
                                         {0, 0, 7.6e6},
                                         {0, 0, 0, 1.9e7},
                                         {0, 0, 0, 0, 1.8e9},
                                         {0, 5.7e7, 0, 0, 0, 2.2e9}}}};
    set_diagonal(&k->bodies, slot, &h->added_mass);
    return slot;
}

static matrix6 ship_matrix(const rig *k, int32_t slot, const hydrodynamics *h)
{
    double m = k->bodies.mass[slot];
    sym3 i = k->bodies.inertia[slot];
    const matrix6 rigid = {{{m}, {0, m}, {0, 0, m}, {0, 0, 0, i.xx}, {0, 0, 0, 0, i.yy}, {0, 0, 0, 0, 0, i.zz}}};
    return matrix6_sum(&rigid, &h->added_mass, 1);
}

/* Ice that pushes the bow aside, step after step: but for a step's lag the ship goes as all of M + A says, where the
   diagonal alone would be a tenth and more off. */
START_TEST(contacts_meet_all_of_it_in_time)
{
    rig k;
    hydrodynamics h;
    int32_t slot = open_ship(&k, &h), steps = 400;
    wrench contact = {{0, 1, 0}, {0, 0, 36}}; /* so little that nothing turns */
    for (int i = 0; i < steps; i++) {
        wrench load = nothing;
        hydrodynamics_respond(&h, true, &still_water, 0.05, &k.bodies, slot, i ? &contact : &nothing, &load);
        load.force = vec3_add(load.force, contact.force);
        load.moment = vec3_add(load.moment, contact.moment);
        step(&k.bodies, slot, &load, 0.05);
    }
    matrix6 whole = ship_matrix(&k, slot, &h);
    pair6 v;
    ck_assert(matrix6_solve(&whole, (pair6){contact.force, contact.moment}, &v));
    double time = 0.05 * steps, by_diagonal = time / (6e6 + 5.3e6);
    assert_relative(k.bodies.velocity[slot].y, time * v.linear.y, 2.0 / steps);
    assert_relative(k.bodies.angular_velocity[slot].z, time * v.angular.z, 2.0 / steps);
    ck_assert(fabs(by_diagonal / k.bodies.velocity[slot].y - 1) > 0.1);
    rig_close(&k);
}
END_TEST

/* The bow leans on a wall: the contact's force settles, without swinging, at what all of M + A asks for. */
START_TEST(contacts_settle_at_a_wall)
{
    rig k;
    hydrodynamics h;
    int32_t slot = open_ship(&k, &h);
    matrix6 whole = ship_matrix(&k, slot, &h), known = {0};
    for (int i = 0; i < 6; i++)
        known.m[i][i] = whole.m[i][i];
    const vec3 bow = {36, 0, 0}, along = {0, 1, 0};
    const wrench thrust = {{0, -1, 0}, {0, 0, 10}};
    pair6 free;
    ck_assert(matrix6_solve(&whole, (pair6){thrust.force, thrust.moment}, &free));
    double wanted = -(free.linear.y + 36 * free.angular.z) / answer(&whole, along, bow), miss = HUGE_VAL;
    wrench contact = nothing;
    for (int i = 0; i < 60; i++) {
        wrench load = thrust;
        hydrodynamics_respond(&h, true, &still_water, 0.05, &k.bodies, slot, &contact, &load);
        step(&k.bodies, slot, &load, 0.05);
        /* What the solver does: an impulse that stops the bow, by the diagonal. */
        double speed = k.bodies.velocity[slot].y + 36 * k.bodies.angular_velocity[slot].z;
        double force = -speed / (0.05 * answer(&known, along, bow));
        contact = (wrench){vec3_scale(along, force), vec3_make(0, 0, 36 * force)};
        k.bodies.velocity[slot].y += 0.05 * force / known.m[1][1];
        k.bodies.angular_velocity[slot].z += 0.05 * 36 * force / known.m[5][5];
        ck_assert_msg(fabs(force - wanted) <= 0.5 * miss || miss < 1e-9, "step %d: %g N instead of %g", i, force,
                      wanted);
        miss = fabs(force - wanted);
    }
    ck_assert_msg(miss < 1e-6 * fabs(wanted), "%g N are missing of %g", miss, wanted);
    rig_close(&k);
}
END_TEST

/* However strong the coupling, of either sign, and wherever it is held: the force at the wall settles. */
START_TEST(strong_coupling_does_not_swing)
{
    for (int n = 0; n < 2 * 5 * 3; n++) {
        static const double part[] = {0.3, 0.5, 0.7, 0.9, 0.99}, at[] = {-36, 5, 36};
        rig k;
        hydrodynamics h;
        int32_t slot = open_ship(&k, &h);
        matrix6 known = ship_matrix(&k, slot, &h);
        double coupling = (n % 2 ? -1 : 1) * part[n / 2 % 5] * sqrt(known.m[1][1] * known.m[5][5]), x = at[n / 10];
        h.added_mass.m[1][5] = h.added_mass.m[5][1] = coupling;
        known.m[1][5] = known.m[5][1] = 0;
        double give = answer(&known, vec3_make(0, 1, 0), vec3_make(x, 0, 0)), before = 0, force = 0;
        wrench contact = nothing;
        for (int i = 0; i < 300; i++) {
            wrench load = {{0, -1, 0}, {0, 0, 10}};
            hydrodynamics_respond(&h, true, &still_water, 0.05, &k.bodies, slot, &contact, &load);
            step(&k.bodies, slot, &load, 0.05);
            double speed = k.bodies.velocity[slot].y + x * k.bodies.angular_velocity[slot].z;
            before = force;
            force = -speed / (0.05 * give);
            contact = (wrench){{0, force, 0}, {0, 0, x * force}};
            k.bodies.velocity[slot].y += 0.05 * force / known.m[1][1];
            k.bodies.angular_velocity[slot].z += 0.05 * x * force / known.m[5][5];
        }
        ck_assert_msg(fabs(force) < 100 && fabs(force - before) < 1e-6, "coupling %g at %g m: %g N after %g", coupling,
                      x, force, before);
        rig_close(&k);
    }
}
END_TEST

/* Kirchhoff: a body coasting and tumbling in an ideal fluid keeps its energy, fluid included; the step's error is of
   first order. */
static double energy_drift(double dt)
{
    random_stream r = random_begin(42, 0, 0);
    rig k;
    int32_t slot = rig_open(&k, 900, (sym3){800, 900, 1300, 20, -30, 10});
    hydrodynamics h = {.added_mass = coupled_matrix(&r, 300)};
    set_diagonal(&k.bodies, slot, &h.added_mass);
    k.bodies.velocity[slot] = vec3_make(1, 0.4, -0.3);
    k.bodies.angular_velocity[slot] = vec3_make(0.2, -0.3, 0.5);
    media m = still_water;
    m.current = vec3_make(0.3, -0.5, 0);
    double start = 0, worst = 0;
    for (int i = 0; i * dt <= 5; i++) {
        vec3 v = vec3_sub(k.bodies.velocity[slot], m.current);
        mat3 turned = quat_matrix(k.bodies.orientation[slot]);
        vec3 w = mat3_tmul_vec(turned, k.bodies.angular_velocity[slot]);
        pair6 own = {mat3_tmul_vec(turned, v), w}, water = matrix6_mul(&h.added_mass, own);
        double energy = 0.5 * (900 * vec3_dot(v, v) + vec3_dot(w, sym3_mul_vec(k.bodies.inertia[slot], w))) +
                        0.5 * (vec3_dot(own.linear, water.linear) + vec3_dot(own.angular, water.angular));
        start = i == 0 ? energy : start;
        worst = testing_larger(worst, fabs(energy / start - 1));
        wrench load = {{0, 0, 0}, {0, 0, 0}};
        hydrodynamics_respond(&h, true, &m, dt, &k.bodies, slot, &nothing, &load);
        step(&k.bodies, slot, &load, dt);
    }
    rig_close(&k);
    return worst;
}

START_TEST(coasting_keeps_energy)
{
    double coarse = energy_drift(0.01), fine = energy_drift(0.005);
    ck_assert_msg(fine < 2e-2 && coarse / fine > 1.8 && coarse / fine < 2.2, "drift %g, then %g", coarse, fine);
}
END_TEST

/* Linear damping is implicit: v' = v / (1 + dt D/M) for any step, and exp(-D t/M) to first order. */
START_TEST(damping_of_any_strength)
{
    for (double rate = 1e-3; rate < 1e6; rate *= 10) {
        rig k;
        int32_t slot = rig_open(&k, 500, (sym3){800, 900, 1300, 0, 0, 0});
        hydrodynamics h = {.added_mass = {{{100}, {0, 100}, {0, 0, 500}}},
                           .damping = {{{0}, {0}, {0, 0, rate}, {0, 0, 0, rate}}}};
        set_diagonal(&k.bodies, slot, &h.added_mass);
        k.bodies.velocity[slot].z = 2;
        k.bodies.angular_velocity[slot].x = 1;
        for (int coupled = 0; coupled < 2; coupled++) {
            if (coupled)
                k.bodies.angular_velocity[slot].x = 0, k.bodies.orientation[slot] = quat_identity();
            double before = k.bodies.velocity[slot].z;
            wrench load = {{0, 0, 0}, {0, 0, 0}};
            hydrodynamics_respond(&h, coupled, &still_water, 0.1, &k.bodies, slot, &nothing, &load);
            step(&k.bodies, slot, &load, 0.1);
            assert_relative(k.bodies.velocity[slot].z, before / (1 + 0.1 * rate / 1000), 1e-9);
        }
        rig_close(&k);
    }
}
END_TEST

/* What leads a body bears all that the water does to it, whatever the step: held motions meet damping in full, and a
   body that rests on something is carried by no damping. */
START_TEST(a_led_body_is_damped_in_full)
{
    for (double step = 0.01; step < 2; step *= 10) {
        rig k;
        int32_t slot = rig_open(&k, 500, (sym3){800, 900, 1300, 20, -30, 10});
        hydrodynamics h = {
            .added_mass = {{{100}, {0, 100}, {0, 0, 500}}},
            .damping = {
                {{300}, {0, 400}, {0, 0, 500, 0, 60}, {0, 0, 0, 700}, {0, 0, 70, 0, 800}, {0, 0, 0, 0, 0, 900}}}};
        set_diagonal(&k.bodies, slot, &h.added_mass);
        k.bodies.velocity[slot] = vec3_make(1, 2, 0);
        k.bodies.angular_velocity[slot] = vec3_make(0, 0, 0.5);
        const wrench all = {{30, -40, 0}, {500, -600, 700}};
        wrench load = all, held = {{0, 0, -1000}, {0, 0, 0}};
        hydrodynamics_respond(&(hydrodynamics){.damping = h.damping}, false, &still_water, step, &k.bodies, slot,
                              &nothing, &load);
        assert_vec3_close(load.force, vec3_make(30 - 300, -40 - 800, 0), 1e-9);
        assert_vec3_close(load.moment, vec3_make(500, -600, 700 - 450), 1e-9);
        k.bodies.velocity[slot] = k.bodies.angular_velocity[slot] = vec3_make(0, 0, 0);
        for (int i = 0; i < 200; i++) {
            load = (wrench){{0, 0, 1000}, {5, 6, 7}};
            hydrodynamics_respond(&h, false, &still_water, step, &k.bodies, slot, &held, &load);
            held = (wrench){vec3_neg(load.force), vec3_neg(load.moment)}; /* by what it rests on */
        }
        assert_vec3_close(load.force, vec3_make(0, 0, 1000), 1e-9);
        assert_vec3_close(load.moment, vec3_make(5, 6, 7), 1e-9);
        rig_close(&k);
    }
}
END_TEST

/* In a current that changes with depth the matrices meet that at the depth they are told, wherever the centre of mass
   is. */
START_TEST(matrices_in_a_current_of_depth)
{
    random_stream r = random_begin(46, 0, 0);
    hydrodynamics h = {.added_mass = coupled_matrix(&r, 500), .damping = {{{50}, {0, 80}, {0, 0, 60}}}, .depth = 3};
    media of_depth = still_water, uniform = still_water;
    of_depth.profile = (current_profile){3, {0, 2, 6}, {{0.8, 0.4, 0}, {0.8, 0.4, 0}, {0, 0, 0}}};
    uniform.current = vec3_make(0.6, 0.3, 0);
    static const double height[] = {1, -2, -4.5};
    for (int i = 0; i < 3; i++) {
        rig k;
        int32_t slot = rig_open(&k, 900, (sym3){800, 900, 1000, 20, -30, 10});
        set_diagonal(&k.bodies, slot, &h.added_mass);
        k.bodies.position[slot].z = height[i];
        k.bodies.velocity[slot] = vec3_make(0.2, -0.1, 0.05);
        wrench load = nothing, expected = nothing;
        hydrodynamics_respond(&h, true, &of_depth, 0.05, &k.bodies, slot, &nothing, &load);
        hydrodynamics_respond(&h, true, &uniform, 0.05, &k.bodies, slot, &nothing, &expected);
        ck_assert_double_gt(vec3_length(expected.force), 5);
        assert_vec3_close(load.force, expected.force, 1e-12 * 900);
        assert_vec3_close(load.moment, expected.moment, 1e-12 * 900);
        rig_close(&k);
    }
}
END_TEST

/* ---- prisms ---- */

static int32_t add_floe(rig *k, double thickness)
{
    *k = (rig){0};
    context_init(&k->ctx);
    int32_t shape, slot = body_create(&k->ctx, &k->bodies, MOTION_DYNAMIC, MATERIAL_ICE);
    fram_error error = {0};
    double half = 0.5 * thickness, mass = 920 * 100 * thickness, flat = mass * thickness * thickness / 12;
    assert_ok(shape_add_prism(&k->ctx, &k->shapes, NULL, OUTLINE(square_outline), half, 0, &shape, &error), error);
    k->bodies.shape[slot] = shape;
    k->bodies.mass[slot] = mass;
    k->bodies.inertia[slot] = (sym3){mass * 100 / 12 + flat, mass * 100 / 12 + flat, mass * 200 / 12, 0, 0, 0};
    k->bodies.position[slot].z = half - thickness * 920 / 1025;
    return slot;
}

static const drag_coefficients drag[MATERIAL_COUNT] = {{.water_form = 1, .water_skin = 0.01}};

static void step_floe(rig *k, const media *m, const prism_response *settings, double dt)
{
    wrench load;
    double volume;
    fram_error error = {0};
    assert_ok(
        fluid_apply(&k->ctx, m, drag, &k->bodies, &k->shapes, NULL, &load, &(fluid_details){.volume = &volume}, &error),
        error);
    prisms_respond(&k->ctx, m, drag, settings, dt, &k->bodies, &k->shapes, &volume, &load);
    step(&k->bodies, 0, &load, dt);
}

/* Weak drag: nothing is changed. */
START_TEST(weak_drag_is_left_alone)
{
    rig k;
    int32_t slot = add_floe(&k, 1);
    k.bodies.velocity[slot] = vec3_make(0.4, 0, 0.01);
    k.bodies.angular_velocity[slot] = vec3_make(0.005, 0, 0.02);
    k.bodies.added_mass[slot] = vec3_make(7, 7, 7);
    wrench load = {{1, 2, 3}, {4, 5, 6}};
    double volume = 80;
    prisms_respond(&k.ctx, &still_water, drag, &(prism_response){false, 0}, 0.01, &k.bodies, &k.shapes, &volume, &load);
    assert_vec3_close(load.force, vec3_make(1, 2, 3), 0);
    assert_vec3_close(load.moment, vec3_make(4, 5, 6), 0);
    assert_vec3_close(k.bodies.added_mass[slot], vec3_make(0, 0, 0), 0);
    assert_vec3_close(k.bodies.added_inertia[slot], vec3_make(0, 0, 0), 0);
    rig_close(&k);
}
END_TEST

/* Deep under water so that no spring pulls: every thickness, speed and step; the speed relative to the water never
   grows and never turns round. */
/* The quick bound spares floes only where the closer one finds nothing; a current of depth leaves it out. */
START_TEST(quick_bound_changes_nothing)
{
    random_stream r = random_begin(47, 0, 0);
    media plain = still_water, of_depth = still_water;
    plain.current = of_depth.current = vec3_make(0.3, -0.1, 0);
    of_depth.profile.count = 1; /* without a velocity of its own */
    const isa best = isa_best();
    int spared = 0, strong = 0;
    for (int n = 0; n < 3000; n++) {
        rig k;
        int32_t slot = add_floe(&k, real_exp(random_uniform(&r, -7, 1)));
        double speed = real_exp(random_uniform(&r, -5, 3)), spin = real_exp(random_uniform(&r, -7, 1));
        k.bodies.velocity[slot] = random_vector(&r, speed);
        k.bodies.angular_velocity[slot] = random_vector(&r, spin);
        k.ctx.isa = (isa)(n % ((int)best + 1));
        double volume = n % 7 ? 80 : 0, dt = real_exp(random_uniform(&r, -6, 0));
        wrench load = nothing;
        const prism_response none = {false, 0};
        prisms_respond(&k.ctx, &of_depth, drag, &none, dt, &k.bodies, &k.shapes, &volume, &load);
        vec3 mass = k.bodies.added_mass[slot], inertia = k.bodies.added_inertia[slot];
        k.bodies.added_mass[slot] = vec3_make(7, 7, 7);
        prisms_respond(&k.ctx, &plain, drag, &none, dt, &k.bodies, &k.shapes, &volume, &load);
        assert_array_bits(&k.bodies.added_mass[slot].x, &mass.x, 3);
        assert_array_bits(&k.bodies.added_inertia[slot].x, &inertia.x, 3);
        bool any = mass.x > 0 || mass.z > 0 || inertia.x > 0 || inertia.z > 0;
        strong += any;
        spared += !any;
        rig_close(&k);
    }
    ck_assert_int_gt(strong, 300);
    ck_assert_int_gt(spared, 300);
}
END_TEST

START_TEST(strong_drag_is_stable)
{
    static const double thickness[] = {1e-3, 1e-2, 0.1, 1}, speeds[] = {0.01, 0.3, 10, 100};
    static const double steps[] = {1e-3, 0.1, 10};
    for (int n = 0; n < 4 * 4 * 3 * 3; n++) {
        double dt = steps[n % 3], speed = speeds[n / 3 % 4];
        int way = n / 48;
        rig k;
        int32_t slot = add_floe(&k, thickness[n / 12 % 4]);
        media m = still_water;
        m.gravity = 0;
        m.current = vec3_make(0.3, 0, 0);
        k.bodies.position[slot].z = -1e6;
        vec3 direction = way == 0 ? vec3_make(1, 0, 0) : way == 1 ? vec3_make(0, 0, -1) : vec3_make(0, 0, 0);
        k.bodies.velocity[slot] = vec3_mad(m.current, direction, speed);
        if (way == 2)
            k.bodies.angular_velocity[slot] = vec3_make(0, 0, fmin(speed, 1 / dt));
        double before = way == 2 ? k.bodies.angular_velocity[slot].z : speed;
        for (int i = 0; i < 200; i++) {
            step_floe(&k, &m, &(prism_response){false, 0}, dt);
            double now = way == 2 ? k.bodies.angular_velocity[slot].z
                                  : vec3_dot(vec3_sub(k.bodies.velocity[slot], m.current), direction);
            ck_assert_msg(now >= 0 && now <= before, "case %d, step %d: %g after %g", n, i, now, before);
            before = now;
        }
        rig_close(&k);
    }
}
END_TEST

/* A thin floe pushed by a constant force: its terminal speed is that of the balance with drag, however large the step.
   And decay is 1/(1 + u t/L) to first order. */
START_TEST(strong_drag_is_right)
{
    for (int n = 0; n < 2; n++) {
        rig k;
        int32_t slot = add_floe(&k, 0.01);
        media m = still_water;
        m.gravity = 0;
        k.bodies.position[slot].z = -1e3;
        double dt = n ? 5 : 0.05, push = 5000;
        for (int i = 0; i < 400; i++) {
            wrench load;
            double volume;
            fram_error error = {0};
            assert_ok(fluid_apply(&k.ctx, &m, drag, &k.bodies, &k.shapes, NULL, &load,
                                  &(fluid_details){.volume = &volume}, &error),
                      error);
            load.force.z -= push;
            prisms_respond(&k.ctx, &m, drag, &(prism_response){false, 0}, dt, &k.bodies, &k.shapes, &volume, &load);
            step(&k.bodies, slot, &load, dt);
        }
        double sides = 0.01 * 4 * 10 * 0.01; /* their skin */
        assert_relative(-k.bodies.velocity[slot].z, sqrt(push / (0.5 * 1025 * (100 + sides))), 1e-6);
        rig_close(&k);
    }
    /* Explicit, mixed or implicit: the error is of first order in the step. */
    double rate = 0.5 * 1025 * 100.004 / 920, exact = -5 / (1 + 5 * rate * 0.1), largest = 0;
    for (int steps = 10; steps <= 20480; steps *= 2) {
        rig k;
        int32_t slot = add_floe(&k, 0.01);
        media m = still_water;
        m.gravity = 0;
        k.bodies.position[slot].z = -1e3;
        k.bodies.velocity[slot].z = -5;
        for (int i = 0; i < steps; i++)
            step_floe(&k, &m, &(prism_response){false, 0}, 0.1 / steps);
        double error = k.bodies.velocity[slot].z - exact;
        largest = fmax(largest, fabs(error) * steps);
        ck_assert_msg(fabs(error) < 2.5 / steps, "%d steps: %g m/s", steps, error);
        rig_close(&k);
    }
    ck_assert(largest > 0.01);
}
END_TEST

/* Heave of the 10 x 10 x 1 m box with the added mass of a plate: T = 2 pi sqrt((m + a)/(rho g A)). */
START_TEST(floe_with_added_mass)
{
    rig k;
    int32_t slot = add_floe(&k, 1);
    double rest = k.bodies.position[slot].z, dt = 1e-3;
    static const drag_coefficients none[MATERIAL_COUNT] = {{0}};
    double first = 0, last = 0, before = 0.01;
    int crossings = 0;
    k.bodies.position[slot].z += 0.01;
    for (int i = 1; crossings < 4; i++) {
        ck_assert_int_lt(i, 20000);
        wrench load;
        double volume;
        fram_error error = {0};
        assert_ok(fluid_apply(&k.ctx, &still_water, none, &k.bodies, &k.shapes, NULL, &load,
                              &(fluid_details){.volume = &volume}, &error),
                  error);
        prisms_respond(&k.ctx, &still_water, none, &(prism_response){true, 0}, dt, &k.bodies, &k.shapes, &volume,
                       &load);
        step(&k.bodies, slot, &load, dt);
        double now = k.bodies.position[slot].z - rest;
        if (before < 0 && now >= 0) {
            last = dt * (i - now / (now - before));
            first = crossings++ == 0 ? last : first;
        }
        before = now;
    }
    plate_added_mass plate = plate_added_mass_of(&(polygon_moments){100, {0, 0}, 1e4 / 12, 1e4 / 12, 0}, 1025);
    double period = 2 * PI * sqrt((92000 + plate.heave) / (1025 * 9.81 * 100));
    assert_relative((last - first) / 3, period, 1e-5);
    assert_absolute(period, 2 * PI * sqrt(325e3 / (1025 * 9.81 * 100)),
                    1e-3); /* 233 t of added mass (DNV-RP-C205 2010, table D-2) */
    rig_close(&k);
}
END_TEST

/* Damping: with half the critical one, a heave oscillation loses exp(-2 pi z / sqrt(1 - z^2)) a period. */
START_TEST(floe_with_damping)
{
    rig k;
    int32_t slot = add_floe(&k, 1);
    double rest = k.bodies.position[slot].z, lowest = 0, dt = 5e-4, ratio = 0.5;
    static const drag_coefficients none[MATERIAL_COUNT] = {{0}};
    k.bodies.position[slot].z += 0.05;
    for (int i = 0; i * dt < 1.5; i++) {
        wrench load;
        double volume;
        fram_error error = {0};
        assert_ok(fluid_apply(&k.ctx, &still_water, none, &k.bodies, &k.shapes, NULL, &load,
                              &(fluid_details){.volume = &volume}, &error),
                  error);
        prisms_respond(&k.ctx, &still_water, none, &(prism_response){false, ratio}, dt, &k.bodies, &k.shapes, &volume,
                       &load);
        step(&k.bodies, slot, &load, dt);
        lowest = testing_smaller(lowest, k.bodies.position[slot].z - rest);
    }
    assert_relative(lowest, -0.05 * real_exp(-PI * ratio / sqrt(1 - ratio * ratio)), 0.01);
    rig_close(&k);
}
END_TEST

/* What the response adds to a floe of 10 x 10 x 1 m at a height, with a volume under water. */
static wrench response_of(prism_response settings, vec3 velocity, vec3 spin, double height, double volume, double dt)
{
    rig k;
    int32_t slot = add_floe(&k, 1);
    static const drag_coefficients none[MATERIAL_COUNT] = {{0}};
    wrench load = {{0, 0, 0}, {0, 0, 0}};
    k.bodies.position[slot].z = height;
    k.bodies.velocity[slot] = velocity;
    k.bodies.angular_velocity[slot] = spin;
    prisms_respond(&k.ctx, &still_water, none, &settings, dt, &k.bodies, &k.shapes, &volume, &load);
    rig_close(&k);
    return load;
}

/* The parts one by one: damping over the critical one of all that moves, none under water, and water that is met. */
START_TEST(parts_of_the_response)
{
    const vec3 rest = {0, 0, 0};
    const double density = 1025, stiffness = density * 9.81, second = 1e4 / 12, dt = 1e-3, ratio = 0.2;
    const polygon_moments outline = {100, {0, 0}, second, second, 0};
    plate_added_mass whole = plate_added_mass_of(&outline, density);
    double inertia = 92000 * (100 + 1) / 12.0;
    wrench w = response_of((prism_response){true, ratio}, vec3_make(0, 0, 0.3), rest, 0.05, 90, dt);
    assert_relative(w.force.z, -0.3 * 2 * ratio * sqrt(stiffness * 100 * (92000 + whole.heave)), 1e-9);
    w = response_of((prism_response){true, ratio}, rest, vec3_make(0.1, 0, 0), 0.05, 90, dt);
    assert_relative(w.moment.x, -0.1 * 2 * ratio * sqrt(stiffness * second * (inertia + whole.roll)), 1e-9);
    w = response_of((prism_response){true, ratio}, rest, vec3_make(0, 0.1, 0), 0.05, 90, dt);
    assert_relative(w.moment.y, -0.1 * 2 * ratio * sqrt(stiffness * second * (inertia + whole.pitch)), 1e-9);
    w = response_of((prism_response){false, ratio}, rest, vec3_make(0.1, 0, 0), 0.05, 90, dt);
    assert_relative(w.moment.x, -0.1 * 2 * ratio * sqrt(stiffness * second * inertia), 1e-9);
    /* Half of the twentieth part above water: half of the damping.  Under water there are no waves. */
    w = response_of((prism_response){false, ratio}, vec3_make(0, 0, 0.3), rest, -0.475, 97.5, dt);
    assert_relative(w.force.z, -0.3 * ratio * sqrt(stiffness * 100 * 92000), 1e-9);
    w = response_of((prism_response){false, ratio}, vec3_make(0, 0, 0.3), rest, -2, 100, dt);
    assert_absolute(w.force.z, 0, 1e-9);
    /* A floe that has gone 0.05 m into the water at 1 m/s: a fifth of its added mass, of which a fiftieth came in 1 ms.
     */
    plate_added_mass part = plate_added_mass_of(&outline, 0.2 * density);
    w = response_of((prism_response){true, 0}, vec3_make(0, 0, -1), rest, 0.45, 5, dt);
    assert_relative(w.force.z, part.heave / 0.05, 1e-9);
    /* None is met on the way out. */
    w = response_of((prism_response){true, 0}, vec3_make(0, 0, 1), rest, 0.45, 5, dt);
    assert_absolute(w.force.z, 0, 1e-6);
}
END_TEST

TEST_MAIN("response", parts_of_the_response, whole_matrix_accelerates, contacts_meet_the_diagonal,
          contacts_meet_all_of_it_in_time, contacts_settle_at_a_wall, strong_coupling_does_not_swing,
          coasting_keeps_energy, damping_of_any_strength, a_led_body_is_damped_in_full, matrices_in_a_current_of_depth,
          weak_drag_is_left_alone, quick_bound_changes_nothing, strong_drag_is_stable, strong_drag_is_right,
          floe_with_added_mass, floe_with_damping)
