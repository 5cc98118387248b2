/* Joints against analytic cases, their reactions, and what position correction does for them. */
#include "base/transcendental.h"
#include "rig.h"

static const sym3 small_ball = {.xx = 1e-6, .yy = 1e-6, .zz = 1e-6};

/* Time of `swings` half periods of a pendulum of 1 m let go at `angle`. */
static double pendulum_period(double dt, double angle)
{
    rig r = rig_make(dt);
    int32_t bob = rig_point(&r, MOTION_DYNAMIC, 2, small_ball, vec3_make(real_sin(angle), 0, -real_cos(angle)));
    ck_assert_int_eq(
        joint_create(&r.ctx, &r.joints, &r.bodies, -1, bob, JOINT_BALL, vec3_make(0, 0, 0), quat_identity()), 0);
    double last = r.bodies.position[bob].x, began = -1, ended = 0;
    for (int k = 1; k * dt < 25; k++) {
        rig_step(&r);
        double x = r.bodies.position[bob].x;
        if (last < 0 && x >= 0) {
            ended = dt * (k - x / (x - last));
            began = began < 0 ? ended : began;
        }
        last = x;
        assert_absolute(vec3_length(r.bodies.position[bob]), 1, 1e-3);
    }
    int swings = (int)((ended - began) / 2.0 + 0.5);
    rig_free(&r);
    return (ended - began) / swings;
}

START_TEST(pendulum_swings_with_its_period)
{
    /* T = 2 pi sqrt(l/g) (1 + a^2/16 + 11 a^4/3072), a = 0.2 */
    double expected = 2 * PI / sqrt(GRAVITY) * (1 + 0.2 * 0.2 / 16 + 11 * 0.0016 / 3072);
    double coarse = pendulum_period(0.01, 0.2), fine = pendulum_period(0.005, 0.2);
    assert_relative(coarse, expected, 2e-3);
    assert_relative(fine, expected, 1e-3);
}
END_TEST

START_TEST(fixed_joint_carries_the_weight)
{
    rig r = rig_make(0.01);
    int32_t beam = rig_box(&r, MOTION_DYNAMIC, vec3_make(4, 1, 1), 250, vec3_make(2, 0, 0));
    int32_t j = joint_create(&r.ctx, &r.joints, &r.bodies, -1, beam, JOINT_FIXED, vec3_make(0, 0, 0), quat_identity());
    rig_run(&r, 50);
    double weight = 1000 * GRAVITY;
    assert_vec3_close(r.joints.reaction_force[j], vec3_make(0, 0, weight), 1e-6 * weight);
    /* The weight turns the beam about +y; the joint holds against it. */
    assert_vec3_close(r.joints.reaction_moment[j], vec3_make(0, -2 * weight, 0), 1e-6 * weight);
    assert_vec3_close(r.bodies.position[beam], vec3_make(2, 0, 0), 1e-9);
    rig_free(&r);
}
END_TEST

/* A bob that circles at a constant height: the cord carries m g / cos a. */
START_TEST(ball_joint_carries_a_conical_pendulum)
{
    const double mass = 3, length = 2, angle = 0.5, radius = length * real_sin(angle);
    rig r = rig_make(0.001);
    vec3 place = {radius, 0, -length * real_cos(angle)};
    int32_t bob = rig_point(&r, MOTION_DYNAMIC, mass, small_ball, place);
    int32_t j = joint_create(&r.ctx, &r.joints, &r.bodies, -1, bob, JOINT_BALL, vec3_make(0, 0, 0), quat_identity());
    double turn = sqrt(GRAVITY / (length * real_cos(angle)));
    r.bodies.velocity[bob] = vec3_make(0, turn * radius, 0);
    r.bodies.angular_velocity[bob] = vec3_make(0, 0, turn);
    rig_run(&r, 500);
    vec3 up = vec3_unit(vec3_neg(r.bodies.position[bob])), force = r.joints.reaction_force[j];
    double tension = mass * GRAVITY / real_cos(angle);
    assert_vec3_close(force, vec3_scale(up, tension), 5e-3 * tension);
    assert_vec3_close(r.joints.reaction_moment[j], vec3_make(0, 0, 0), 1e-6 * tension);
    assert_absolute(r.bodies.position[bob].z, place.z, 5e-3);
    rig_free(&r);
}
END_TEST

/* A beam on a level hinge, held by a load about the hinge's axis: that moment is not the hinge's, the others are. */
START_TEST(hinge_carries_all_but_the_moment_about_its_axis)
{
    rig r = rig_make(0.01);
    int32_t beam = rig_box(&r, MOTION_DYNAMIC, vec3_make(4, 1, 1), 250, vec3_make(2, 0, 0));
    quat axes = quat_from_roll_pitch_yaw(-PI / 2, 0, 0); /* z becomes y */
    int32_t j = joint_create(&r.ctx, &r.joints, &r.bodies, -1, beam, JOINT_HINGE_Z, vec3_make(0, 0, 0), axes);
    double weight = 1000 * GRAVITY;
    r.loads.data[beam] = (wrench){{0, 0, 0}, {300, -2 * weight, 700}};
    rig_run(&r, 50);
    assert_vec3_close(r.joints.reaction_force[j], vec3_make(0, 0, weight), 1e-6 * weight);
    assert_vec3_close(r.joints.reaction_moment[j], vec3_make(-300, 0, -700), 1e-6 * weight);
    assert_vec3_close(r.bodies.position[beam], vec3_make(2, 0, 0), 1e-9);
    rig_free(&r);
}
END_TEST

/* Any set of motions can be locked: here the way along x and the turn about z. */
START_TEST(what_is_not_locked_moves_freely)
{
    rig r = rig_make(0.01);
    r.gravity = vec3_make(0, 0, 0);
    int32_t box = rig_box(&r, MOTION_DYNAMIC, vec3_make(2, 2, 2), 125, vec3_make(1, 2, 3));
    int32_t j = joint_create(&r.ctx, &r.joints, &r.bodies, -1, box, 0x21, vec3_make(1, 2, 3), quat_identity());
    r.loads.data[box] = (wrench){{50, 70, -20}, {0, 0, 90}};
    int steps = 100;
    rig_run(&r, steps);
    double fall = steps * r.dt * (steps + 1) * r.dt / 2; /* per acceleration, semi-implicit */
    assert_vec3_close(r.bodies.position[box], vec3_make(1, 2 + 0.07 * fall, 3 - 0.02 * fall), 1e-9);
    assert_vec3_close(r.bodies.angular_velocity[box], vec3_make(0, 0, 0), 1e-12);
    assert_vec3_close(r.joints.reaction_force[j], vec3_make(-50, 0, 0), 1e-9);
    /* The forces along y and z act at the body's centre, which has left the anchor of the frame; the anchor on the
       body, about which the moment is told, went along. */
    assert_vec3_close(r.joints.reaction_moment[j], vec3_make(0, 0, -90), 1e-9);
    rig_free(&r);
}
END_TEST

/* A carriage that speeds up draws what is fixed to it: force = mass times acceleration. */
START_TEST(prescribed_motion_is_paid_for_by_the_joint)
{
    rig r = rig_make(0.01);
    r.gravity = vec3_make(0, 0, 0);
    int32_t carriage = rig_point(&r, MOTION_PRESCRIBED, 1, small_ball, vec3_make(0, 0, 2));
    int32_t ship = rig_box(&r, MOTION_DYNAMIC, vec3_make(10, 4, 2), 500, vec3_make(0, 0, 0));
    int32_t j =
        joint_create(&r.ctx, &r.joints, &r.bodies, carriage, ship, JOINT_FIXED, vec3_make(0, 0, 2), quat_identity());
    const double acceleration = 0.25, mass = 500 * 80.0;
    for (int k = 1; k <= 200; k++) {
        r.bodies.velocity[carriage] = vec3_make(acceleration * k * r.dt, 0, 0);
        rig_step(&r);
        assert_vec3_close(r.joints.reaction_force[j], vec3_make(mass * acceleration, 0, 0), 1e-6 * mass);
    }
    /* The force acts 2 m over the ship's centre; the moment keeps it from turning. */
    assert_vec3_close(r.joints.reaction_moment[j], vec3_make(0, -2 * mass * acceleration, 0), 1e-6 * mass);
    assert_vec3_close(r.bodies.velocity[ship], r.bodies.velocity[carriage], 1e-9);
    rig_free(&r);
}
END_TEST

START_TEST(hinge_turns_about_its_axis_only)
{
    rig r = rig_make(0.005);
    r.gravity = vec3_make(0, 0, 0);
    int32_t door = rig_box(&r, MOTION_DYNAMIC, vec3_make(2, 0.5, 1), 100, vec3_make(1, 0, 0));
    quat tilt = quat_from_roll_pitch_yaw(0.4, 0, 0); /* the hinge axis leans */
    joint_create(&r.ctx, &r.joints, &r.bodies, -1, door, JOINT_HINGE_Z, vec3_make(0, 0, 0), tilt);
    vec3 axis = mat3_column(quat_matrix(tilt), 2);
    r.bodies.angular_velocity[door] = axis;
    r.bodies.velocity[door] = vec3_cross(axis, r.bodies.position[door]);
    double energy = body_books_of(&r.bodies).kinetic_energy;
    rig_run(&r, 400);
    vec3 w = r.bodies.angular_velocity[door];
    assert_vec3_close(vec3_cross(w, axis), vec3_make(0, 0, 0), 0.01);
    assert_absolute(vec3_dot(w, axis), 1, 0.02);
    assert_absolute(vec3_length(r.bodies.position[door]), 1, 2e-3);
    assert_relative(body_books_of(&r.bodies).kinetic_energy, energy, 0.05);
    /* Two radians on: the material point of the anchor is still at the hinge. */
    assert_vec3_close(body_to_global(&r.bodies, door, vec3_make(-1, 0, 0)), vec3_make(0, 0, 0), 2e-3);
    rig_free(&r);
}
END_TEST

START_TEST(prismatic_joint_leaves_heave_free)
{
    rig r = rig_make(0.01);
    int32_t carriage = rig_point(&r, MOTION_PRESCRIBED, 1, small_ball, vec3_make(0, 0, 5));
    int32_t ship = rig_box(&r, MOTION_DYNAMIC, vec3_make(20, 6, 4), 500, vec3_make(1, 0.5, 0));
    int32_t j = joint_create(&r.ctx, &r.joints, &r.bodies, carriage, ship, JOINT_PRISMATIC_Z, vec3_make(0, 0, 5),
                             quat_identity());
    r.bodies.velocity[carriage] = r.bodies.velocity[ship] = vec3_make(0.3, 0, 0);
    r.loads.data[ship] = (wrench){{-4e4, 1e4, 0}, {1e4, 2e4, 3e4}};
    int steps = 100;
    rig_run(&r, steps);
    double t = steps * r.dt;
    assert_vec3_close(r.bodies.position[carriage], vec3_make(0.3 * t, 0, 5), 1e-12);
    assert_absolute(r.bodies.position[ship].x, 1 + 0.3 * t, 1e-7);
    assert_absolute(r.bodies.position[ship].y, 0.5, 1e-7);
    /* Free fall, semi-implicit: z = -g t (t + dt) / 2. */
    assert_absolute(r.bodies.position[ship].z, -GRAVITY * t * (t + r.dt) / 2, 1e-7);
    assert_vec3_close(r.bodies.angular_velocity[ship], vec3_make(0, 0, 0), 1e-9);
    assert_vec3_close(r.joints.reaction_force[j], vec3_make(4e4, -1e4, 0), 1e-3);
    /* Moments about the anchor on the ship, which stands where it was on the ship: 5 m over, 1 m aft, 0.5 m to
       starboard of its centre.  The load's moment is balanced by the joint's moment and its force at that arm. */
    vec3 arm = vec3_make(-1, -0.5, 5),
         moment = vec3_add(r.joints.reaction_moment[j], vec3_cross(arm, r.joints.reaction_force[j]));
    assert_vec3_close(moment, vec3_make(-1e4, -2e4, -3e4), 1e-2);
    rig_free(&r);
}
END_TEST

/* Largest extension seen and frequency of a mass on a spring between the world and itself. */
START_TEST(spring_swings_and_its_damper_damps)
{
    double wanted = 2 * PI / sqrt(400.0 / 100), period[2];
    for (int halving = 0; halving < 2; halving++) {
        rig r = rig_make(0.01 / (1 + halving));
        r.gravity = vec3_make(0, 0, 0);
        int32_t m = rig_point(&r, MOTION_DYNAMIC, 100, small_ball, vec3_make(3.1, 0, 0));
        int32_t j =
            joint_create(&r.ctx, &r.joints, &r.bodies, -1, m, JOINT_SPRING, vec3_make(0, 0, 0), quat_identity());
        r.joints.anchor_b[j] = vec3_make(0, 0, 0);
        r.joints.stiffness[j] = 400;
        r.joints.rest_length[j] = 3;
        double last = r.bodies.position[m].x, first = -1;
        period[halving] = -1;
        for (int k = 1; period[halving] < 0 && k < 2000; k++) {
            rig_step(&r);
            double x = r.bodies.position[m].x;
            if (last < 3 && x >= 3) {
                double now = r.dt * (k - (x - 3) / (x - last));
                period[halving] = first < 0 ? -1 : now - first;
                first = now;
            }
            last = x;
        }
        r.joints.damping[j] = 1e9; /* stiff beyond any explicit limit */
        rig_run(&r, 100);
        assert_absolute(vec3_length(r.bodies.velocity[m]), 0, 1e-4);
        rig_free(&r);
    }
    assert_relative(period[0], wanted, 2e-3);
    assert_relative(period[1], wanted, 1e-3);
}
END_TEST

START_TEST(spring_at_rest_carries_the_weight)
{
    rig r = rig_make(0.01);
    int32_t m = rig_point(&r, MOTION_DYNAMIC, 100, small_ball, vec3_make(0, 0, -2));
    int32_t j = joint_create(&r.ctx, &r.joints, &r.bodies, -1, m, JOINT_SPRING, vec3_make(0, 0, 0), quat_identity());
    r.joints.anchor_b[j] = vec3_make(0, 0, 0);
    r.joints.stiffness[j] = 5000;
    r.joints.damping[j] = 1400;
    r.joints.rest_length[j] = 2;
    rig_run(&r, 2000);
    assert_vec3_close(r.joints.reaction_force[j], vec3_make(0, 0, 100 * GRAVITY), 1e-6);
    assert_absolute(r.bodies.position[m].z, -2 - 100 * GRAVITY / 5000, 1e-8);
    rig_free(&r);
}
END_TEST

START_TEST(displaced_joint_is_drawn_together)
{
    rig r = rig_make(0.01);
    r.gravity = vec3_make(0, 0, 0);
    int32_t a = rig_box(&r, MOTION_DYNAMIC, vec3_make(2, 1, 1), 500, vec3_make(-1.2, 0, 0));
    int32_t b = rig_box(&r, MOTION_DYNAMIC, vec3_make(2, 1, 1), 500, vec3_make(1.2, 0, 0));
    joint_create(&r.ctx, &r.joints, &r.bodies, a, b, JOINT_FIXED, vec3_make(0, 0, 0), quat_identity());
    r.bodies.position[b].x += 0.1;
    r.bodies.orientation[b] = quat_from_roll_pitch_yaw(0, 0, 0.05);
    rig_run(&r, 30);
    assert_vec3_close(r.bodies.velocity[b], vec3_make(0, 0, 0), 1e-12);
    assert_vec3_close(vec3_sub(r.bodies.position[b], r.bodies.position[a]),
                      mat3_mul_vec(quat_matrix(r.bodies.orientation[a]), vec3_make(2.4, 0, 0)), 1e-6);
    assert_absolute(r.bodies.position[a].x + r.bodies.position[b].x, 0.1, 1e-12); /* the middle stays */
    rig_free(&r);
}
END_TEST

/* A step takes back four fifths of a slip, of a turn about any axis as of a gap. */
START_TEST(a_step_corrects_its_share)
{
    for (int axis = 0; axis < 4; axis++) {
        rig r = rig_make(0.01);
        r.gravity = vec3_make(0, 0, 0);
        int32_t b = rig_box(&r, MOTION_DYNAMIC, vec3_make(2, 1, 1), 500, vec3_make(0, 0, 0));
        joint_create(&r.ctx, &r.joints, &r.bodies, -1, b, JOINT_FIXED, vec3_make(0, 0, 0), quat_identity());
        const double slip = 0.02;
        vec3 turn = vec3_make(axis == 0 ? slip : 0, axis == 1 ? slip : 0, axis == 2 ? slip : 0);
        r.bodies.orientation[b] = quat_from_roll_pitch_yaw(turn.x, turn.y, turn.z);
        r.bodies.position[b].y = axis == 3 ? slip : 0;
        rig_step(&r);
        vec3 left = quat_roll_pitch_yaw(r.bodies.orientation[b]);
        double rest = axis == 3 ? r.bodies.position[b].y : vec3_dot(left, turn) / slip;
        assert_absolute(rest, 0.2 * slip, 0.01 * slip);
        rig_free(&r);
    }
}
END_TEST

START_TEST(joints_of_removed_bodies_rest)
{
    rig r = rig_make(0.01);
    int32_t a = rig_point(&r, MOTION_DYNAMIC, 1, small_ball, vec3_make(0, 0, 0));
    int32_t j = joint_create(&r.ctx, &r.joints, &r.bodies, -1, a, JOINT_FIXED, vec3_make(0, 0, 0), quat_identity());
    rig_run(&r, 2);
    ck_assert(r.joints.reaction_force[j].z > 9);
    body_remove(&r.bodies, a);
    rig_run(&r, 1);
    assert_vec3_close(r.joints.reaction_force[j], vec3_make(0, 0, 0), 0);
    rig_free(&r);
}
END_TEST

RIG_MAIN("joint", pendulum_swings_with_its_period, fixed_joint_carries_the_weight,
         ball_joint_carries_a_conical_pendulum, hinge_carries_all_but_the_moment_about_its_axis,
         what_is_not_locked_moves_freely, prescribed_motion_is_paid_for_by_the_joint, hinge_turns_about_its_axis_only,
         prismatic_joint_leaves_heave_free, spring_swings_and_its_damper_damps, spring_at_rest_carries_the_weight,
         displaced_joint_is_drawn_together, a_step_corrects_its_share, joints_of_removed_bodies_rest)
