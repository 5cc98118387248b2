/* One floating box stepped through time: draught, heave and roll of section 6, first order in the time step. */
#include "samples.h"

/* A prism with its mass. */
typedef struct floater {
    polygon outline;
    double half_height, mass;
    vec3 inertia; /* about the body axes */
    fluid_motion state;
    quat orientation;
} floater;

static floater make_box(void)
{
    double mass = 92000;
    return (floater){OUTLINE(square_outline),
                     0.5,
                     mass,
                     {mass * 101 / 12, mass * 101 / 12, mass * 200 / 12},
                     motion_at(vec3_make(0, 0, 0.5 - 920.0 / 1025), 0, 0, 0),
                     {1, 0, 0, 0}};
}

/* Symplectic Euler: velocities first, poses by the new ones (docs/theory.md, A time step). */
static void step(floater *f, double dt)
{
    fluid_load load;
    fluid_load_prism(&still_water, &(drag_coefficients){0}, f->outline, f->half_height, &f->state, &load);
    fluid_motion *s = &f->state;
    s->velocity = vec3_mad(s->velocity, load.hydrostatic.force, dt / f->mass);
    s->velocity.z -= 9.81 * dt;
    vec3 spin = mat3_tmul_vec(s->rotation, s->angular_velocity);
    vec3 momentum = {f->inertia.x * spin.x, f->inertia.y * spin.y, f->inertia.z * spin.z};
    vec3 moment = vec3_sub(mat3_tmul_vec(s->rotation, load.hydrostatic.moment), vec3_cross(spin, momentum));
    spin = vec3_add(
        spin, vec3_make(dt * moment.x / f->inertia.x, dt * moment.y / f->inertia.y, dt * moment.z / f->inertia.z));
    s->angular_velocity = mat3_mul_vec(s->rotation, spin);
    s->position = vec3_mad(s->position, s->velocity, dt);
    vec3 w = s->angular_velocity;
    quat turn = quat_mul((quat){0, w.x, w.y, w.z}, f->orientation);
    f->orientation = quat_unit((quat){f->orientation.w + 0.5 * dt * turn.w, f->orientation.x + 0.5 * dt * turn.x,
                                      f->orientation.y + 0.5 * dt * turn.y, f->orientation.z + 0.5 * dt * turn.z});
    s->rotation = quat_matrix(f->orientation);
}

START_TEST(box_floats_at_its_draught)
{
    floater f = make_box();
    assert_absolute(0.5 - f.state.position.z, 0.8975609756, 1e-10);
    for (int i = 0; i < 1000; i++)
        step(&f, 0.01);
    assert_absolute(0.5 - f.state.position.z, 0.8975609756, 1e-10);
    assert_vec3_close(f.state.angular_velocity, vec3_make(0, 0, 0), 1e-12);
}
END_TEST

/* What is watched: height over the equilibrium, or roll. */
static double heave(const floater *f) { return f->state.position.z - (0.5 - 920.0 / 1025); }
static double roll(const floater *f) { return quat_roll_pitch_yaw(f->orientation).x; }

typedef struct decay {
    double period; /* mean over the crossings seen */
    double late;   /* value after 7.3 s */
} decay;

static decay run_free(floater f, double (*watch)(const floater *), double dt)
{
    double first = 0, last = 0, before = watch(&f);
    int crossings = 0, steps = (int)(7.3 / dt + 0.5);
    for (int i = 1; i <= steps; i++) {
        step(&f, dt);
        double now = watch(&f);
        if (before < 0 && now >= 0) {
            last = dt * (i - now / (now - before));
            if (crossings++ == 0)
                first = last;
        }
        before = now;
    }
    ck_assert_int_ge(crossings, 3);
    return (decay){(last - first) / (crossings - 1), before};
}

static void check_oscillation(floater f, double (*watch)(const floater *), double amplitude, double period)
{
    decay coarse = run_free(f, watch, 0.01), fine = run_free(f, watch, 0.005);
    assert_relative(fine.period, period, 2e-5);
    assert_relative(coarse.period, period, 1e-4);
    /* Phase and amplitude are first order: half the step, half the error. */
    double exact = amplitude * real_cos(2 * PI * 7.3 / period);
    assert_absolute((coarse.late - exact) / (fine.late - exact), 2, 0.1);
    assert_absolute(fine.late, exact, 0.02 * amplitude);
}

START_TEST(heave_period)
{
    floater f = make_box();
    f.state.position.z += 0.05;
    check_oscillation(f, heave, 0.05, 1.900541449);
}
END_TEST

START_TEST(roll_period)
{
    floater f = make_box();
    double angle = 1e-3;
    f.orientation = quat_from_roll_pitch_yaw(angle, 0, 0);
    f.state.rotation = quat_matrix(f.orientation);
    fluid_load load;
    fluid_load_prism(&still_water, &(drag_coefficients){0}, f.outline, f.half_height, &f.state, &load);
    assert_absolute(-load.hydrostatic.moment.x / (f.mass * 9.81 * real_sin(angle)), 9.233200778, 1e-5);
    check_oscillation(f, roll, angle, 1.915310938);
}
END_TEST

/* Dropped on its corner without drag, the box dives and turns over; its energy drifts by the integrator's first order.
 */
static double energy_drift(double dt)
{
    floater f = make_box();
    f.orientation = quat_from_roll_pitch_yaw(0.4, -0.3, 0.2);
    f.state.rotation = quat_matrix(f.orientation);
    f.state.position.z = 0.2;
    double worst = 0, start = 0;
    int steps = (int)(2 / dt + 0.5);
    for (int i = 0; i <= steps; i++) {
        /* Energy of the displaced water: its weight times the depth of its centre, by integrating buoyancy upward. */
        double stored = 0;
        fluid_motion probe = f.state;
        for (int k = 0; k < 1200; k++) {
            probe.position.z = f.state.position.z + (k + 0.5) * 0.01;
            fluid_load load;
            fluid_load_prism(&still_water, &(drag_coefficients){0}, f.outline, f.half_height, &probe, &load);
            stored += 0.01 * load.hydrostatic.force.z;
        }
        vec3 spin = mat3_tmul_vec(f.state.rotation, f.state.angular_velocity), v = f.state.velocity;
        double moving = 0.5 * (f.mass * vec3_dot(v, v) + f.inertia.x * spin.x * spin.x + f.inertia.y * spin.y * spin.y +
                               f.inertia.z * spin.z * spin.z);
        double energy = moving + stored + f.mass * 9.81 * f.state.position.z;
        start = i == 0 ? energy : start;
        worst = testing_larger(worst, fabs(energy - start));
        step(&f, dt);
    }
    return worst / (f.mass * 9.81);
}

START_TEST(energy_is_kept)
{
    double coarse = energy_drift(0.01), fine = energy_drift(0.005);
    ck_assert_msg(fine < 0.02 && coarse / fine > 1.7 && coarse / fine < 2.3, "drift %g m, then %g m", coarse, fine);
}
END_TEST

TEST_MAIN("floating", box_floats_at_its_draught, heave_period, roll_period, energy_is_kept)
