/* Bodies that a joint guides along a driven one: what contacts see of them, what friction does at slips of rounding,
   and what the joint reports.  Driven bodies against fixed ones beside them. */
#include "rig.h"

enum { WALL = 0, HULL = 1, CARRIAGE = 2 };
#define MASS 4e6
#define CAP 2e5 /* of each contact [N s] */

/* A hull of 60 m x 14 m on a carriage that lets it heave, bow at x = 0, at `velocity`. */
static rig towed(vec3 velocity)
{
    rig r = rig_make(0.01);
    r.gravity = vec3_make(0, 0, 0);
    sym3 inertia = {.xx = MASS * 25, .yy = MASS * 225, .zz = MASS * 225};
    rig_point(&r, MOTION_STATIC, 1, inertia, vec3_make(0, 0, 0));
    rig_point(&r, MOTION_DYNAMIC, MASS, inertia, vec3_make(-30, 0, 0));
    rig_point(&r, MOTION_PRESCRIBED, 1, inertia, vec3_make(-30, 0, 0));
    r.bodies.added_mass[HULL] = vec3_make(0.05 * MASS, 0.8 * MASS, MASS);
    r.bodies.velocity[HULL] = r.bodies.velocity[CARRIAGE] = velocity;
    joint_create(&r.ctx, &r.joints, &r.bodies, CARRIAGE, HULL, JOINT_PRISMATIC_Z, r.bodies.position[HULL],
                 quat_identity());
    return r;
}

/* A contact of the hull with the wall at a place ahead of x = 0; the wall is pushed along `normal`. */
static void touch(rig *r, vec3 place, vec3 normal, double cap)
{
    contact c = {.a = WALL,
                 .b = HULL,
                 .point = place,
                 .normal = vec3_unit(normal),
                 .depth = 0.01,
                 .impulse_limit = cap,
                 .friction_static = 0.1,
                 .friction_kinetic = 0.1,
                 .patch = -1,
                 .crush_infinite = !body_is_dynamic(&r->bodies, HULL),
                 .key = contact_key(&r->bodies, WALL, HULL, 0, 0, (uint32_t)r->contacts.count)};
    ck_assert(array_push(&r->ctx, &r->contacts, c));
}

/* Four points of a bow that is a wall, the middle of the ice aside and below. */
static void touch_bow(rig *r)
{
    array_clear(&r->contacts);
    for (int i = 0; i < 4; i++)
        touch(r, vec3_make(0, i & 1 ? 5 : -6.5, i & 2 ? 0.1 : -0.6), vec3_make(1, 0, 0), CAP);
}

/* Two bodies that touch nothing else and run into each other, far from the hull. */
static void collide_afar(rig *r)
{
    const sym3 inertia = {.xx = 100, .yy = 100, .zz = 100};
    int32_t a = rig_point(r, MOTION_DYNAMIC, 1000, inertia, vec3_make(200, 0, 0));
    int32_t b = rig_point(r, MOTION_DYNAMIC, 1000, inertia, vec3_make(201, 0, 0));
    r->bodies.velocity[a].x = 0.3;
    contact c = {.a = b,
                 .b = a,
                 .point = vec3_make(200.5, 0.2, 0),
                 .normal = vec3_make(1, 0, 0),
                 .impulse_limit = HUGE_VAL,
                 .friction_static = 0.1,
                 .friction_kinetic = 0.1,
                 .patch = -1,
                 .key = contact_key(&r->bodies, b, a, 0, 0, 0)};
    ck_assert(array_push(&r->ctx, &r->contacts, c));
}

/* Impulses on the hull, and their moment about its centre. */
static wrench on_hull(const rig *r)
{
    wrench sum = {{0, 0, 0}, {0, 0, 0}};
    for (int32_t i = 0; i < r->contacts.count; i++) {
        const contact *c = &r->contacts.data[i];
        if (c->b != HULL)
            continue;
        vec3 p = vec3_neg(contact_impulse(c));
        sum.force = vec3_add(sum.force, p);
        sum.moment = vec3_add(sum.moment, vec3_cross(vec3_sub(c->point, r->bodies.position[HULL]), p));
    }
    return sum;
}

START_TEST(a_wall_driven_straight_into_ice_feels_no_friction)
{
    const double noise[] = {0, 1e-17, -3e-17, 1e-16};
    for (int i = 0; i < 4; i++) {
        rig r = towed(vec3_make(1, noise[i], 0));
        for (int k = 0; k < 200; k++) {
            touch_bow(&r);
            rig_solve(&r);
            wrench w = on_hull(&r);
            assert_bits(w.force.x, -4 * CAP);
            assert_absolute(w.force.y, 0, 1e-6 * CAP);
            assert_absolute(w.force.z, 0, 1e-6 * CAP);
        }
        rig_free(&r);
    }
}
END_TEST

START_TEST(what_slides_has_all_its_friction)
{
    /* Aside by the carriage; up and down too, which is free and so stops where friction is enough. */
    rig r = towed(vec3_make(1, -0.2, 0));
    for (int k = 0; k < 20; k++) {
        touch_bow(&r);
        rig_solve(&r);
    }
    wrench w = on_hull(&r);
    assert_relative(w.force.x, -4 * CAP, 1e-12);
    assert_relative(w.force.y, 0.1 * 4 * CAP, 1e-9);
    rig_free(&r);
    r = towed(vec3_make(1, 0, 0));
    r.bodies.velocity[HULL].z = 0.005; /* 2 MASS in heave: 40 kN s, and friction may take 80 */
    touch_bow(&r);
    rig_solve(&r);
    assert_absolute(r.bodies.velocity[HULL].z, 0, 1e-12);
    assert_relative(on_hull(&r).force.z, -0.005 * 2 * MASS, 1e-9);
    rig_free(&r);
}
END_TEST

/* A hull slower than caps are large: MASS v is 1/500 of one.  Wall that leans by `lean`; velocity of heave. */
static rig towed_slowly(double lean, double heave, bool afar)
{
    rig r = towed(vec3_make(1e-4, -2e-5, 0));
    r.settings.warm_start = false;
    r.bodies.velocity[HULL].z = heave;
    for (int i = 0; i < 4; i++) {
        touch(&r, vec3_make(0, i & 1 ? 5 : -6.5, i & 2 ? 0.1 : -0.6), vec3_make(1, 0, lean), CAP);
        r.contacts.data[i].friction_static = 0.3;
    }
    if (afar)
        collide_afar(&r);
    return r;
}

START_TEST(however_slow_a_carriage_is_its_hull_crushes)
{
    for (int afar = 0; afar < 2; afar++) {
        rig r = towed_slowly(0, 0, afar);
        rig_solve(&r);
        assert_vec3_close(on_hull(&r).force, vec3_make(-4 * CAP, 0.1 * 4 * CAP, 0), 1e-9 * CAP);
        assert_absolute(r.report.residual, 0, 1e-9);
        rig_free(&r);
        /* Friction is against the sliding, where it has stopped most of the heave. */
        r = towed_slowly(0, 1e-3, afar);
        r.settings.iterations = 1000;
        rig_solve(&r);
        wrench w = on_hull(&r);
        assert_relative(sqrt(w.force.y * w.force.y + w.force.z * w.force.z), 0.1 * 4 * CAP, 5e-3);
        if (rig_kind == SOLVER_ACCURATE)
            assert_absolute(w.force.z / w.force.y, r.bodies.velocity[HULL].z / -2e-5, 1e-3);
        rig_free(&r);
        /* A wall that leans a little could be climbed, by more than the caps lift. */
        r = towed_slowly(0.003, 0, afar);
        rig_solve(&r);
        assert_relative(on_hull(&r).force.x, -4 * CAP, 1e-3);
        rig_free(&r);
    }
    /* Without a cap there is no answer: each sweep presses on, though it changes no velocity. */
    rig r = towed(vec3_make(1e-4, 0, 0));
    r.settings.most_iterations = r.settings.iterations;
    touch(&r, vec3_make(0, 0, 0), vec3_make(1, 0, 0), HUGE_VAL);
    rig_solve(&r);
    ck_assert_int_eq(r.report.iterations, r.settings.iterations);
    rig_free(&r);
}
END_TEST

START_TEST(the_joint_reports_what_contacts_press)
{
    rig r = towed(vec3_make(1, 0, 0));
    r.gravity = vec3_make(0, 0, -GRAVITY);
    for (int k = 0; k < 3; k++) {
        double fall = r.bodies.velocity[HULL].z;
        touch_bow(&r);
        touch(&r, vec3_make(-10, 3, -5), vec3_make(0.6, 0, -0.8), CAP);
        rig_solve(&r);
        wrench w = on_hull(&r);
        vec3 carried = vec3_scale(r.joints.reaction_force[0], r.dt);
        vec3 turned = vec3_scale(r.joints.reaction_moment[0], r.dt);
        /* All but heave is as the carriage has it, so the joint bears the rest; heave has its own mass. */
        assert_vec3_close(carried, vec3_make(-w.force.x, -w.force.y, 0), 1e-9 * CAP);
        assert_vec3_close(turned, vec3_neg(w.moment), 1e-7 * CAP);
        assert_absolute(2 * MASS * (r.bodies.velocity[HULL].z - fall), w.force.z - MASS * GRAVITY * r.dt, 1e-6 * CAP);
        assert_vec3_close(vec3_make(r.bodies.velocity[HULL].x, r.bodies.velocity[HULL].y, 0), vec3_make(1, 0, 0),
                          1e-14);
        assert_vec3_close(r.bodies.angular_velocity[HULL], vec3_make(0, 0, 0), 1e-16);
    }
    rig_free(&r);
}
END_TEST

/* The first blow of a hull that a joint holds in all six, against a free floe of a tonne: as of an infinite mass. */
START_TEST(a_hull_held_in_all_is_driven)
{
    rig r = towed(vec3_make(1, 0, 0));
    table_resize(&r.ctx, &r.joints, &joint_table_info, 0);
    joint_create(&r.ctx, &r.joints, &r.bodies, CARRIAGE, HULL, JOINT_FIXED, r.bodies.position[HULL], quat_identity());
    r.bodies.motion[WALL] = MOTION_DYNAMIC;
    r.bodies.mass[WALL] = 1000;
    r.bodies.position[WALL] = vec3_make(1, 0, 0);
    r.bodies.velocity[WALL] = vec3_make(-1, 0, 0);
    touch(&r, vec3_make(0, 0, 0), vec3_make(1, 0, 0), HUGE_VAL);
    rig_solve(&r);
    assert_relative(r.bodies.velocity[WALL].x, 1, 1e-3);
    assert_absolute(r.bodies.velocity[HULL].x, 1, 1e-14);
    assert_relative(r.joints.reaction_force[0].x * r.dt, -on_hull(&r).force.x, 1e-9);
    rig_free(&r);
}
END_TEST

/* ---- driven against fixed ---- */

/* Impulse on a hull that is driven itself, by one contact ahead. */
static vec3 driven(vec3 velocity, vec3 spin)
{
    rig r = towed(velocity);
    table_resize(&r.ctx, &r.joints, &joint_table_info, 0);
    r.bodies.motion[HULL] = MOTION_PRESCRIBED;
    r.bodies.angular_velocity[HULL] = spin;
    touch(&r, vec3_make(0, 0, 0), vec3_make(1, 0, 0), CAP);
    rig_solve(&r);
    vec3 p = on_hull(&r).force;
    rig_free(&r);
    return p;
}

START_TEST(rounding_is_neither_approach_nor_slip)
{
    const vec3 still = {0, 0, 0};
    assert_vec3_close(driven(vec3_make(1, 0.5, 0), still), vec3_make(-CAP, -0.1 * CAP, 0), 1e-9 * CAP);
    assert_vec3_close(driven(vec3_make(1, 1e-6, 0), still), vec3_make(-CAP, -0.1 * CAP, 0), 1e-9 * CAP);
    assert_vec3_close(driven(vec3_make(1, 1e-17, -2e-16), still), vec3_make(-CAP, 0, 0), 1e-7 * CAP);
    /* Along the ice, and away from it. */
    assert_vec3_close(driven(vec3_make(1e-16, 2, 0), still), still, 1e-6 * CAP);
    assert_vec3_close(driven(vec3_make(-1e-3, 2, 0), still), still, 0);
    assert_vec3_close(driven(still, still), still, 0);
    /* A hull that turns about its middle: the bow goes aside at 30 m times the turn. */
    assert_vec3_close(driven(vec3_make(1e-3, -0.3, 0), vec3_make(0, 0, 0.01)), vec3_make(-CAP, 0, 0), 1e-6 * CAP);
}
END_TEST

RIG_MAIN("guided", a_wall_driven_straight_into_ice_feels_no_friction, what_slides_has_all_its_friction,
         however_slow_a_carriage_is_its_hull_crushes, the_joint_reports_what_contacts_press,
         a_hull_held_in_all_is_driven, rounding_is_neither_approach_nor_slip)
