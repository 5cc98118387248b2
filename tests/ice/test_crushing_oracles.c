/* Crushing-limited contact against closed forms (docs/theory.md): each at two time steps, of first order. */
#include "base/transcendental.h"
#include "ice_rig.h"

/* A floe of 92 t at 0.5 m/s against a fixed wall, no fluid, gap exactly 0. */
static const double MASS = 92000, SPEED = 0.5;

typedef struct impact {
    double force, penetration, stop; /* largest force [N], way until the stop [m], time of the stop [s] */
    double rebound;                  /* speed away from the wall in the end [m/s] */
} impact;

/* The floe 10 x 10 x 1 moves along +x, face or corner first. */
static void impact_scene(ice_rig *r, bool corner_first, double exponent, double dt)
{
    ice_rig_make(r, dt);
    r->solver.kind = SOLVER_ACCURATE;
    int32_t row = ice_rig_plate(r, 10, 10, 1, MOTION_DYNAMIC), slot = r->floes.body[row];
    r->floes.material[row].crushing_exponent = exponent;
    assert_relative(r->bodies.mass[slot], MASS, 1e-14);
    double reach = 5;
    if (corner_first) {
        ice_rig_place(r, slot, (vec3){0, 0, 0}, 0, 0, PI / 4);
        reach = sqrt(50);
    }
    r->bodies.velocity[slot] = (vec3){SPEED, 0, 0};
    int32_t wall = ice_rig_box(r, (vec3){0, -40, -30}, (vec3){20, 40, 30}, MOTION_STATIC, MATERIAL_WALL);
    ice_rig_place(r, wall, (vec3){reach, 0, 0}, 0, 0, 0);
    ice_rig_pair(r, slot, wall);
}

static impact run_impact(bool corner_first, double exponent, double dt)
{
    ice_rig r;
    impact seen = {0, 0, 0, 0};
    impact_scene(&r, corner_first, exponent, dt);
    double energy = body_books_of(&r.bodies).kinetic_energy, speed = SPEED;
    int step = 0;
    for (; speed > 1e-9 && step < 4000; step++) {
        ice_rig_step(&r);
        double after = r.bodies.velocity[0].x, force = -ice_rig_force(&r).x, limit = 0, work = 0;
        for (int32_t i = 0; i < r.contacts.count; i++) {
            const contact *c = &r.contacts.data[i];
            limit += c->impulse_limit;
            work += c->impulse[0] * (speed + after) / 2;
            ck_assert(c->impulse[0] <= c->impulse_limit * (1 + 1e-12));
        }
        double left = body_books_of(&r.bodies).kinetic_energy;
        /* What the capped rows take is what the floe loses. */
        assert_absolute(energy - left, work, 1e-9 * MASS * SPEED * SPEED);
        ck_assert(left <= energy);
        energy = left;
        /* The last step needs only a part of the cap: the stop falls inside it. */
        seen.stop += after > 1e-9 ? dt : dt * -force * dt / -limit;
        seen.force = testing_larger(seen.force, force);
        seen.penetration += after * dt;
        speed = after;
    }
    ck_assert_int_lt(step, 4000);
    /* Nothing moves any more, whatever the wall pushes back. */
    for (int i = 0; i < 5; i++) {
        ice_rig_step(&r);
        seen.rebound = testing_larger(seen.rebound, fabs(r.bodies.velocity[0].x));
    }
    ck_assert(fabs(r.bodies.velocity[0].y) < 1e-6 && fabs(r.bodies.angular_velocity[0].z) < 1e-6);
    ice_rig_free(&r);
    return seen;
}

/* Errors at dt and dt/2: both small, and at least halved with the step (a tenth is left for where in a step the end
   falls), unless they are down at the digits of the closed form. */
#define ASSERT_FIRST_ORDER(coarse, fine, exact, tolerance, digits)                                                    \
    do {                                                                                                              \
        double e1_ = fabs((coarse) - (exact)), e2_ = fabs((fine) - (exact));                                          \
        ck_assert_msg(e1_ <= (tolerance)*fabs(exact), "%s is %.9g, expected %.9g", #coarse, (coarse),                 \
                      (double)(exact));                                                                               \
        ck_assert_msg(e2_ <= 0.6 * e1_ || e1_ <= (digits)*fabs(exact), "errors of %s: %g at dt, %g at dt/2", #coarse, \
                      e1_, e2_);                                                                                      \
    } while (0)

START_TEST(corner_into_wall)
{
    impact a = run_impact(true, 0, 1e-3), b = run_impact(true, 0, 5e-4);
    /* A = 2 h d makes F = K d, and the impact a quarter of an oscillation.
     */
    double stiffness = 2e6 * 2, frequency = sqrt(stiffness / MASS);
    assert_relative(SPEED / frequency, 75.8288e-3, 1e-5);
    assert_relative(stiffness * SPEED / frequency, 303.315e3, 1e-5);
    assert_relative(PI / 2 / frequency, 0.238223, 1e-5);
    /* The largest force falls between two steps, where it is stationary: no clean order, but small errors. */
    assert_relative(a.force, 303315.0, 1e-4);
    assert_relative(b.force, 303315.0, 5e-5);
    ASSERT_FIRST_ORDER(a.penetration, b.penetration, 0.0758288, 2e-5, 1e-6);
    ASSERT_FIRST_ORDER(a.stop, b.stop, 0.238223, 0.01, 2e-6);
    assert_absolute(a.rebound, 0, 1e-9);
}
END_TEST

START_TEST(corner_with_pressure_area_law)
{
    impact a = run_impact(true, -0.1, 1e-3), b = run_impact(true, -0.1, 5e-4);
    /* The largest force falls between two steps, where it is stationary: no clean order, but small errors. */
    assert_relative(a.force, 326930.0, 1e-4);
    assert_relative(b.force, 326930.0, 5e-5);
    ASSERT_FIRST_ORDER(a.penetration, b.penetration, 0.066834, 2e-5, 1e-5);
    assert_absolute(a.rebound, 0, 1e-9);
}
END_TEST

START_TEST(flat_face_into_wall)
{
    impact a = run_impact(false, 0, 1e-4), b = run_impact(false, 0, 5e-5);
    assert_relative(a.force, 20e6, 1e-9);
    assert_relative(b.force, 20e6, 1e-9);
    assert_relative(a.stop, 2.300e-3, 1e-6);
    ASSERT_FIRST_ORDER(a.penetration, b.penetration, 0.575e-3, 0.05, 1e-6);
    assert_absolute(a.rebound, 0, 1e-9);
}
END_TEST

/* At 10 ms the cap does not bind: a plain inelastic stop in one step. */
START_TEST(flat_face_with_a_long_step)
{
    impact a = run_impact(false, 0, 0.01);
    assert_relative(a.force, MASS * SPEED / 0.01, 1e-9);
    assert_absolute(a.penetration, 0, 1e-9);
    assert_absolute(a.rebound, 0, 1e-9);
}
END_TEST

/* A moored hull at rest is not moved by the ice that was crushed in it, breakable or not, nor the ice by a wall that
   crushed it; the comparison switch moves the hull.  At two steps. */
START_TEST(crushed_overlap_moves_nothing)
{
    for (int turn = 0; turn < 8; turn++) {
        ice_rig r;
        ice_rig_make(&r, turn < 4 ? 0.02 : 0.01);
        bool corrects = turn % 4 == 2, wall = turn % 4 == 3;
        r.settings.correct_unbreakable = corrects;
        int32_t row = ice_rig_plate(&r, 30, 20, 1, MOTION_DYNAMIC);
        r.floes.breakable[row] = turn % 4 == 0;
        int32_t hull = ice_rig_box(&r, (vec3){0, -8, -6}, (vec3){60, 8, 6}, wall ? MOTION_STATIC : MOTION_DYNAMIC,
                                   wall ? MATERIAL_WALL : MATERIAL_HULL);
        ice_rig_place(&r, hull, (vec3){14.5, 0, 0}, 0, 0, 0);
        ice_rig_pair(&r, r.floes.body[row], hull);
        double before = r.bodies.position[r.floes.body[row]].x;
        for (int i = 0; i < 10; i++)
            ice_rig_step(&r);
        vec3 at = r.bodies.position[hull];
        if (!corrects) {
            assert_bits(at.x, 14.5);
            assert_bits(r.bodies.position[r.floes.body[row]].x, before);
        } else {
            ck_assert_double_gt(at.x, 14.6);
        }
        ice_rig_free(&r);
    }
}
END_TEST

/* A vertical wall driven 3 h into a static floe: the normal stays level and F = sigma_c L h at every step. */
START_TEST(wall_driven_into_a_static_floe)
{
    ice_rig r;
    ice_rig_make(&r, 0.01);
    int32_t row = ice_rig_plate(&r, 30, 20, 0.8, MOTION_STATIC);
    int32_t wall = ice_rig_box(&r, (vec3){-4, -3, -10}, (vec3){0, 3, 10}, MOTION_PRESCRIBED, MATERIAL_HULL);
    ice_rig_place(&r, wall, (vec3){-15, 0, 0}, 0, 0, 0);
    r.bodies.velocity[wall] = (vec3){0.5, 0, 0};
    ice_rig_pair(&r, r.floes.body[row], wall);
    while (r.bodies.position[wall].x < -15 + 3 * 0.8) {
        ice_rig_step(&r);
        ck_assert_int_eq(r.patches.count, 1);
        assert_vec3_close(r.patches.data[0].normal, ((vec3){1, 0, 0}), 1e-12);
        assert_vec3_close(ice_rig_force(&r), ((vec3){2e6 * 6 * 0.8, 0, 0}), 1e-3);
    }
    /* Drawn back, it meets no load. */
    r.bodies.velocity[wall] = (vec3){-0.5, 0, 0};
    ice_rig_step(&r);
    assert_vec3_close(ice_rig_force(&r), ((vec3){0, 0, 0}), 1e-9);
    ice_rig_free(&r);
}
END_TEST

/* All contacts of a box that has crushed its way into the edge of a plate are as deep as its overlap over the area of
   front and side together, w s / hypot(w, s), however the motion divides them; what slides is not pushed out. */
static void check_depths(const ice_rig *r, vec3 ahead, double width, double way)
{
    ck_assert_int_eq(r->patches.count, 2);
    for (int32_t i = 0; i < r->contacts.count; i++) {
        const contact *c = &r->contacts.data[i];
        double depth = way * width / sqrt(way * way + width * width);
        assert_absolute(c->depth, depth, 0.01 * depth + 1e-12); /* a few lines stand for the volume */
        bool is_hull = r->bodies.material[c->b] == MATERIAL_HULL;
        ck_assert(c->correct == (is_hull && fabs(vec3_dot(c->normal, ahead)) > 0.5));
    }
}

/* A box whose front crushes half of a plate's edge, and whose side slides along what it has cut, askew in the world:
   the front carries sigma_c w h and nothing to rub against, the side nothing, however far the box has come. */
START_TEST(a_side_that_slides_carries_nothing)
{
    for (int kind = 0; kind < 2; kind++) {
        ice_rig r;
        ice_rig_make(&r, 0.01);
        r.settings.parts_by_motion = r.settings.correct_unbreakable = true;
        r.settings.rest_speed = 1e-3;
        for (int i = 0; i < MATERIAL_COUNT; i++)
            for (int k = 0; k < MATERIAL_COUNT; k++)
                r.policies.of[i][k].friction_static = r.policies.of[i][k].friction_kinetic = 0.3;
        const double yaw = 0.7, width = 3, thickness = 0.8;
        mat3 turn = quat_matrix(quat_from_roll_pitch_yaw(0, 0, yaw));
        vec3 ahead = mat3_column(turn, 0);
        int32_t row = ice_rig_plate(&r, 30, 20, thickness, MOTION_STATIC);
        r.floes.breakable[row] = false;
        ice_rig_place(&r, r.floes.body[row], mat3_mul_vec(turn, (vec3){15, 10, 0}), 0, 0, yaw);
        int32_t box = ice_rig_box(&r, (vec3){-20, -3, -10}, (vec3){0, width, 10}, MOTION_PRESCRIBED,
                                  kind ? MATERIAL_WALL : MATERIAL_HULL);
        ice_rig_place(&r, box, (vec3){0, 0, 0}, 0, 0, yaw);
        r.bodies.velocity[box] = vec3_scale(ahead, 0.5);
        ice_rig_pair(&r, r.floes.body[row], box);
        for (int step = 0; step < 600; step++) {
            ice_rig_step(&r);
            assert_vec3_close(ice_rig_force(&r), vec3_scale(ahead, 2e6 * width * thickness), 1);
            if (step < 60)
                check_depths(&r, ahead, width, 0.5 * 0.01 * step);
        }
        /* By a hair into the ice aside: nothing stops such a box, so that its side crushes too, each with its own
           normal and friction along the other. */
        const double side = 0.5 * 0.01 * 600;
        r.bodies.velocity[box] = mat3_mul_vec(turn, (vec3){0.5, 1e-3, 0});
        ice_rig_step(&r);
        assert_vec3_close(mat3_tmul_vec(turn, ice_rig_force(&r)),
                          ((vec3){2e6 * thickness * (width + 0.3 * side), 2e6 * thickness * (side + 0.3 * width), 0}),
                          1);
        /* A box at rest bears on both. */
        r.bodies.velocity[box] = mat3_mul_vec(turn, (vec3){9e-4, 0, 0});
        ice_rig_step(&r);
        ck_assert_int_eq(r.patches.count, 1);
        ck_assert(vec3_dot(ice_rig_force(&r), mat3_column(turn, 1)) > 2e6 * thickness * side * 0.5);
        ice_rig_free(&r);
    }
}
END_TEST

/* A side in a plate that turns about a place `aside` of it goes into the ice from x / hypot(x, aside) = 1/10 on, and
   carries sigma_c h times what of it does, exactly, with a triangle or two across that place; the other way likewise.
   Where pressure falls with area it is that of the whole side, which the motion alone divides. */
START_TEST(a_side_that_turns_carries_what_enters)
{
    const double aside = 3, half = 15, thickness = 0.8, from = 0.1 * aside / sqrt(1 - 0.1 * 0.1);
    for (int turn = 0; turn < 4; turn++) {
        int way = turn % 2 ? 1 : -1;
        double exponent = turn < 2 ? 0 : -0.1, pressure = 2e6 * pow(2 * half * thickness, exponent);
        ice_rig r;
        ice_rig_make(&r, 0.01);
        r.settings.parts_by_motion = true;
        r.settings.rest_speed = 1e-3;
        int32_t row = ice_rig_plate(&r, 2 * half, 20, thickness, MOTION_STATIC);
        r.floes.material[row].crushing_exponent = exponent;
        ice_rig_place(&r, r.floes.body[row], (vec3){0, aside + 10 - 0.1, 0}, 0, 0, 0);
        int32_t box =
            ice_rig_box(&r, (vec3){-20, -aside, -10}, (vec3){20, aside, 10}, MOTION_PRESCRIBED, MATERIAL_HULL);
        ice_rig_place(&r, box, (vec3){0, 0, 0}, 0, 0, 0);
        r.bodies.angular_velocity[box] = (vec3){0, 0, 0.1 * way};
        ice_rig_pair(&r, r.floes.body[row], box);
        ice_rig_step(&r);
        ck_assert_int_eq(r.patches.count, 2);
        assert_vec3_close(ice_rig_force(&r), ((vec3){0, pressure * thickness * (half - from), 0}), 1);
        double first = r.patches.data[0].centre.x * way, other = r.patches.data[1].centre.x * way;
        assert_absolute(fmax(first, other), (half + from) / 2, 1e-9);
        assert_absolute(fmin(first, other), (from - half) / 2, 1e-9);
        ice_rig_free(&r);
    }
}
END_TEST

/* A box of 1e6 kg that goes ahead through held ice while 1 MN presses it aside: its side bears that 1 MN and no more,
   with friction on it; the front bears sigma_c w h. */
START_TEST(a_side_bears_what_presses_on_it)
{
    for (double dt = 0.01; dt > 0.004; dt /= 2) {
        ice_rig r;
        ice_rig_make(&r, dt);
        r.solver.kind = SOLVER_ACCURATE;
        r.settings.parts_by_motion = true;
        r.settings.rest_speed = 1e-3;
        for (int i = 0; i < MATERIAL_COUNT; i++)
            for (int k = 0; k < MATERIAL_COUNT; k++)
                r.policies.of[i][k].friction_static = r.policies.of[i][k].friction_kinetic = 0.1;
        const double width = 0.1, thickness = 0.8, aside = 1e6, mass = 1e6, front = 2e6 * width * thickness;
        int32_t row = ice_rig_plate(&r, 60, 20, thickness, MOTION_STATIC);
        ice_rig_place(&r, r.floes.body[row], (vec3){27, 10, 0}, 0, 0, 0);
        int32_t box = ice_rig_box(&r, (vec3){-20, -3, -10}, (vec3){0, width, 10}, MOTION_DYNAMIC, MATERIAL_HULL);
        r.bodies.mass[box] = mass;
        r.bodies.inertia[box] = (sym3){1e12, 1e12, 1e12, 0, 0, 0};
        r.bodies.velocity[box] = (vec3){3, 0, 0};
        ice_rig_pair(&r, r.floes.body[row], box);
        for (double t = dt; t < 1; t += dt) {
            double before = r.bodies.velocity[box].x;
            r.bodies.velocity[box].y += aside * dt / mass;
            ice_rig_step(&r);
            assert_absolute(ice_rig_force(&r).y, aside, 1e-3 * aside);
            /* Friction of the front takes 0.1 front of what presses aside. */
            double ahead = (before - r.bodies.velocity[box].x) * mass / dt;
            assert_absolute(ahead, front + 0.1 * (aside - 0.05 * front), 0.005 * front + 1e-3 * aside);
            assert_absolute(r.bodies.velocity[box].y, 0, 1e-5);
        }
        ice_rig_free(&r);
    }
}
END_TEST

/* A floe that meets the wall askew turns: force and moment are those of the patch, so the path does not depend on how
   the floe is cut into pieces. */
START_TEST(askew_impact_in_pieces)
{
    body_books books[3];
    vec3 position[3], spin[3];
    static const int cuts[3] = {1, 2, 4};
    for (int i = 0; i < 3; i++) {
        ice_rig r;
        impact_scene(&r, false, 0, 1e-3);
        ice_rig_place(&r, 0, (vec3){-1, 0, 0}, 0, 0, 0.15);
        if (cuts[i] > 1)
            ice_rig_cut(&r, r.bodies.shape[0], cuts[i]);
        r.bodies.velocity[0] = (vec3){2, 0.3, 0};
        for (int step = 0; step < 400; step++)
            ice_rig_step(&r);
        books[i] = body_books_of(&r.bodies);
        position[i] = r.bodies.position[0];
        spin[i] = r.bodies.angular_velocity[0];
        ice_rig_free(&r);
    }
    ck_assert(fabs(spin[0].z) > 0.01);
    for (int i = 1; i < 3; i++) {
        assert_vec3_close(position[i], position[0], 1e-6);
        assert_vec3_close(spin[i], spin[0], 1e-6);
        assert_relative(books[i].kinetic_energy, books[0].kinetic_energy, 1e-5);
    }
}
END_TEST

TEST_MAIN("crushing oracles", corner_into_wall, corner_with_pressure_area_law, flat_face_into_wall,
          flat_face_with_a_long_step, wall_driven_into_a_static_floe, a_side_that_slides_carries_nothing,
          a_side_that_turns_carries_what_enters, a_side_bears_what_presses_on_it, crushed_overlap_moves_nothing,
          askew_impact_in_pieces)
