/* Rigid bodies against closed forms that need neither ice nor water: each at two time steps, with first order
 * shown. */
#include "base/transcendental.h"
#include "rig.h"

/* The error at half the time step is about half. */
static void assert_first_order(double coarse, double fine, double expected, double bound)
{
    double e1 = fabs(coarse - expected), e2 = fabs(fine - expected);
    ck_assert_msg(e1 <= bound, "coarse %.12g, expected %.12g, error over %g", coarse, expected, bound);
    ck_assert_msg(e2 <= 0.5 * bound, "fine %.12g, expected %.12g, error over %g", fine, expected, 0.5 * bound);
    ck_assert_msg(e2 <= 0.75 * e1 || e2 <= 1e-3 * bound, "not first order: errors %g, %g", e1, e2);
}

/* ---- slide ---- */

typedef struct slide_end {
    double time, distance;
} slide_end;

static slide_end slide(double dt, double heading)
{
    rig r = rig_make(dt);
    rig_friction(&r, 0.1, 0.1);
    rig_box(&r, MOTION_STATIC, vec3_make(40, 40, 1), 1, vec3_make(0, 0, -0.5));
    int32_t box = rig_box(&r, MOTION_DYNAMIC, vec3_make(2, 2, 0.5), 900, vec3_make(0, 0, 0.25));
    vec3 way = vec3_make(real_cos(heading), real_sin(heading), 0);
    r.bodies.orientation[box] = quat_from_roll_pitch_yaw(0, 0, heading);
    r.bodies.velocity[box] = vec3_scale(way, 2);
    slide_end end = {0, 0};
    while (end.time < 4 && vec3_dot(r.bodies.velocity[box], way) > 1e-9) {
        rig_step(&r);
        end.time += dt;
    }
    end.distance = vec3_dot(r.bodies.position[box], way);
    vec3 across = vec3_make(-way.y, way.x, 0);
    assert_absolute(vec3_dot(r.bodies.position[box], across), 0, 1e-5);
    rig_free(&r);
    return end;
}

START_TEST(slide_stops)
{
    slide_end coarse = slide(0.01, 0), fine = slide(0.005, 0);
    assert_absolute(coarse.time, 2.038735984, 0.021);
    assert_absolute(fine.time, 2.038735984, 0.011);
    assert_first_order(coarse.distance, fine.distance, 2.038735984, 0.03);
}
END_TEST

START_TEST(friction_is_isotropic)
{
    slide_end straight = slide(0.01, 0);
    for (int i = 1; i <= 2; i++) {
        slide_end turned = slide(0.01, radians(22.5 * i));
        assert_absolute(turned.distance, straight.distance, 1e-6);
        assert_absolute(turned.time, straight.time, 1e-6);
    }
}
END_TEST

/* ---- incline ---- */

/* Distance down the slope after `time`, from rest on it. */
static double incline(double dt, double angle, double time)
{
    rig r = rig_make(dt);
    rig_friction(&r, 0.3, 0.3);
    int32_t plane = rig_box(&r, MOTION_STATIC, vec3_make(60, 60, 2), 1, vec3_make(0, 0, 0));
    int32_t box = rig_box(&r, MOTION_DYNAMIC, vec3_make(2, 2, 0.5), 900, vec3_make(0, 0, 0));
    quat tilt = quat_from_roll_pitch_yaw(0, angle, 0); /* nose down along +x */
    r.bodies.orientation[plane] = r.bodies.orientation[box] = tilt;
    mat3 axes = quat_matrix(tilt);
    r.bodies.position[box] = mat3_mul_vec(axes, vec3_make(0, 0, 1.25));
    vec3 start = r.bodies.position[box];
    rig_run(&r, (int)(time / dt + 0.5));
    double way = vec3_dot(vec3_sub(r.bodies.position[box], start), mat3_column(axes, 0));
    rig_free(&r);
    return way;
}

START_TEST(incline_sticks_below_and_slides_above)
{
    /* tan 16.69924423 deg = 0.3; the first step falls onto the plane, which costs a little way. */
    double held = incline(0.01, radians(16.6), 2), loose = incline(0.01, radians(16.8), 2);
    ck_assert_msg(fabs(held) < 2e-3, "slid %g m", held);
    ck_assert_msg(loose > 0.01, "moved %g m only", loose);
    double coarse = incline(0.01, radians(25), 2), fine = incline(0.005, radians(25), 2);
    assert_first_order(coarse, fine, 0.5 * 1.47862133 * 4, 0.05);
}
END_TEST

/* ---- collisions ---- */

START_TEST(two_floes_end_together)
{
    for (int halving = 0; halving < 2; halving++) {
        rig r = rig_make(0.01 / (1 + halving));
        r.gravity = vec3_make(0, 0, 0);
        r.settings.kind = SOLVER_ACCURATE;
        int32_t a = rig_box(&r, MOTION_DYNAMIC, vec3_make(10, 10, 1), 920, vec3_make(-5.005, 0, 0));
        int32_t b = rig_box(&r, MOTION_DYNAMIC, vec3_make(10, 5, 1), 920, vec3_make(5.005, 0, 0));
        r.bodies.velocity[a].x = 1;
        r.bodies.velocity[b].x = -0.5;
        double before = body_books_of(&r.bodies).kinetic_energy;
        rig_run(&r, 20);
        assert_absolute(r.bodies.velocity[a].x, 0.5, 1e-12);
        assert_absolute(r.bodies.velocity[b].x, 0.5, 1e-12);
        assert_relative(before - body_books_of(&r.bodies).kinetic_energy, 34500, 1e-10);
        rig_free(&r);
    }
}
END_TEST

START_TEST(corner_hit_turns_the_floe)
{
    for (int halving = 0; halving < 2; halving++) {
        rig r = rig_make(4e-4 / (1 + halving));
        r.gravity = vec3_make(0, 0, 0);
        r.settings.kind = SOLVER_ACCURATE;
        rig_box(&r, MOTION_STATIC, vec3_make(2, 10, 4), 1, vec3_make(1, -9.999, 0)); /* reaches up to y = -4.999 */
        int32_t floe = rig_box(&r, MOTION_DYNAMIC, vec3_make(10, 10, 1), 920, vec3_make(-5.0003, 0, 0));
        r.bodies.velocity[floe].x = 1;
        double before = body_books_of(&r.bodies).kinetic_energy;
        rig_run(&r, 4); /* the gap closes, and the blow ends in the step after */
        assert_absolute(r.bodies.velocity[floe].x, 0.6, 2e-4);
        assert_absolute(r.bodies.angular_velocity[floe].z, -0.12, 2e-4);
        assert_absolute(body_books_of(&r.bodies).kinetic_energy / before, 0.6, 2e-4);
        rig_free(&r);
    }
}
END_TEST

/* ---- free turning ---- */

/* Relative changes, largest over the run, and the last orientation. */
typedef struct spin_end {
    double energy, momentum;
    quat orientation;
} spin_end;

static spin_end spin(double dt, vec3 w)
{
    rig r = rig_make(dt);
    r.gravity = vec3_make(0, 0, 0);
    int32_t p = rig_box(&r, MOTION_DYNAMIC, vec3_make(10, 4, 1), 920, vec3_make(3, 2, 1));
    assert_relative(r.bodies.inertia[p].xx, 52133.333, 1e-7);
    assert_relative(r.bodies.inertia[p].yy, 309733.333, 1e-7);
    assert_relative(r.bodies.inertia[p].zz, 355733.333, 1e-7);
    r.bodies.angular_velocity[p] = w;
    body_books start = body_books_of(&r.bodies);
    double size = vec3_length(start.angular_momentum);
    spin_end end = {0, 0, {1, 0, 0, 0}};
    for (int k = 0; k < (int)(8 / dt + 0.5); k++) {
        rig_step(&r);
        body_books now = body_books_of(&r.bodies);
        end.energy = testing_larger(end.energy, fabs(now.kinetic_energy / start.kinetic_energy - 1));
        end.momentum =
            testing_larger(end.momentum, vec3_length(vec3_sub(now.angular_momentum, start.angular_momentum)) / size);
    }
    end.orientation = r.bodies.orientation[p];
    rig_free(&r);
    return end;
}

/* Sine of half the angle between two orientations. */
static double angle_between(quat a, quat b)
{
    quat d = quat_mul((quat){a.w, -a.x, -a.y, -a.z}, b);
    return sqrt(d.x * d.x + d.y * d.y + d.z * d.z);
}

START_TEST(free_prism_keeps_energy_and_momentum)
{
    vec3 about[3] = {{1, 0.01, 0.01}, {0.01, 1, 0.01}, {0.3, 0.2, 1}};
    for (int i = 0; i < 3; i++) {
        spin_end coarse = spin(0.02, about[i]), fine = spin(0.01, about[i]), exact = spin(0.001, about[i]);
        assert_absolute(coarse.energy, 0, 1e-12);
        assert_absolute(coarse.momentum, 0, 1e-12);
        assert_absolute(fine.energy, 0, 1e-12);
        assert_absolute(fine.momentum, 0, 1e-12);
        double e1 = angle_between(coarse.orientation, exact.orientation);
        double e2 = angle_between(fine.orientation, exact.orientation);
        ck_assert_msg(e1 < 2e-3 && e2 < 0.6 * e1, "orientation off by %g, %g", e1, e2);
    }
}
END_TEST

START_TEST(middle_axis_is_unstable)
{
    double lowest[3];
    for (int i = 0; i < 3; i++) {
        rig r = rig_make(0.01);
        r.gravity = vec3_make(0, 0, 0);
        int32_t p = rig_box(&r, MOTION_DYNAMIC, vec3_make(10, 4, 1), 920, vec3_make(0, 0, 0));
        double w[3] = {0.01, 0.01, 0.01};
        w[i] = 1;
        r.bodies.angular_velocity[p] = vec3_make(w[0], w[1], w[2]);
        lowest[i] = 1;
        for (int k = 0; k < 4000; k++) {
            rig_step(&r);
            vec3 body = mat3_tmul_vec(quat_matrix(r.bodies.orientation[p]), r.bodies.angular_velocity[p]);
            lowest[i] = fmin(lowest[i], i == 0 ? body.x : i == 1 ? body.y : body.z);
        }
        rig_free(&r);
    }
    ck_assert(lowest[0] > 0.95 && lowest[2] > 0.95);
    ck_assert(lowest[1] < -0.9);
}
END_TEST

/* ---- many floes ---- */

START_TEST(many_floes_keep_momentum_and_lose_energy)
{
    /* The accurate solver takes a hundred times as long over the same heap. */
    int side = rig_kind == SOLVER_ACCURATE ? 5 : 8;
    double centre = 0.5 * (side - 1);
    rig r = rig_make(0.02);
    r.gravity = vec3_make(0, 0, 0);
    rig_friction(&r, 0.3, 0.3);
    for (int i = 0; i < side * side; i++) {
        int x = i % side, y = i / side;
        double n = 3 + i % 5, turn = 0.7 * i;
        vec2 corner[8];
        for (int k = 0; k < (int)n; k++) {
            double angle = turn + 2 * PI * k / n;
            corner[k] = vec2_make(2.4 * real_cos(angle), 2.4 * real_sin(angle));
        }
        int32_t slot = rig_prism(&r, MOTION_DYNAMIC, (polygon){corner, (int32_t)n}, 1, 900,
                                 vec3_make(5 * (x - centre), 5 * (y - centre), 0.02 * (i % 3)));
        vec3 in = vec3_scale(r.bodies.position[slot], -0.1);
        r.bodies.velocity[slot] = vec3_make(in.x + 0.3, in.y - 0.1, 0);
        r.bodies.angular_velocity[slot].z = 0.02 * (i % 7 - 3);
    }
    body_books start = body_books_of(&r.bodies), last = start;
    double spin_scale = 0;
    for (int32_t i = 0; i < r.bodies.count; i++)
        spin_scale += r.bodies.mass[i] * vec3_length(r.bodies.position[i]) * vec3_length(r.bodies.velocity[i]);
    int touched = 0;
    for (int k = 0; k < 400; k++) {
        rig_detect(&r);
        touched += r.contacts.count > 0;
        body_books free = body_books_of(&r.bodies);
        rig_solve(&r);
        body_books now = body_books_of(&r.bodies);
        ck_assert_msg(vec3_length(vec3_sub(now.momentum, start.momentum)) <= 1e-10 * vec3_length(start.momentum),
                      "momentum lost in step %d", k);
        /* Neither impulses nor free motion change the angular momentum. */
        integrate_poses(&r.ctx, &r.bodies, r.dt);
        body_books moved = body_books_of(&r.bodies);
        ck_assert_msg(vec3_length(vec3_sub(moved.angular_momentum, free.angular_momentum)) <= 1e-12 * spin_scale,
                      "angular momentum lost in step %d: %g", k,
                      vec3_length(vec3_sub(moved.angular_momentum, free.angular_momentum)) / spin_scale);
        ck_assert_msg(now.kinetic_energy <= last.kinetic_energy * (1 + 1e-9),
                      "energy grew in step %d: %.15g from %.15g", k, now.kinetic_energy, last.kinetic_energy);
        rig_correct(&r);
        last = body_books_of(&r.bodies);
    }
    ck_assert(touched > 100);
    ck_assert(last.kinetic_energy < 0.9 * start.kinetic_energy);
    rig_free(&r);
}
END_TEST

/* What a contact stands on bends by P / BENDING. */
static const double BENDING = 2e6;

static void bend(rig *r)
{
    for (int32_t i = 0; i < r->contacts.count; i++) {
        contact *c = &r->contacts.data[i];
        double up = contact_memory_pair(&r->memory, c).z * (body_is_dynamic(&r->bodies, c->b) ? 1 : -1);
        c->correct = false;
        c->give = 1 / (BENDING * r->dt * r->dt);
        c->recoil = -c->give * up;
    }
}

/* A box that lies on an edge whose weight it gets all at once: a mass on a spring, W/K (1 - cos(sqrt(K/m) t)), whose
   energy is no more than that in the end. */
START_TEST(an_edge_bends_under_what_lies_on_it)
{
    double way[2], mass = 0, end = 0.3;
    for (int k = 0; k < 2; k++) {
        rig r = rig_make(k ? 0.001 : 0.002);
        r.settings.iterations = 200;
        r.cap = bend;
        rig_box(&r, MOTION_STATIC, vec3_make(10, 10, 1), 900, vec3_make(0, 0, -1));
        int32_t box = rig_box(&r, MOTION_DYNAMIC, vec3_make(4, 4, 1), 900, vec3_make(0, 0, 0));
        mass = r.bodies.mass[box];
        rig_run(&r, (int)lround(end / r.dt));
        way[k] = -r.bodies.position[box].z;
        ck_assert(r.bodies.velocity[0].z == 0 && r.bodies.position[0].z == -1);
        assert_absolute(r.bodies.velocity[box].x, 0, 1e-6);
        double spring = 0.5 * BENDING * way[k] * way[k], speed = r.bodies.velocity[box].z;
        ck_assert(spring + 0.5 * mass * speed * speed <= mass * GRAVITY * way[k]);
        rig_free(&r);
    }
    double is = mass * GRAVITY / BENDING * (1 - real_cos(sqrt(BENDING / mass) * end));
    assert_first_order(way[0], way[1], is, 0.03 * is);
}
END_TEST

RIG_MAIN("oracles", an_edge_bends_under_what_lies_on_it, slide_stops, friction_is_isotropic,
         incline_sticks_below_and_slides_above, two_floes_end_together, corner_hit_turns_the_floe,
         free_prism_keeps_energy_and_momentum, middle_axis_is_unstable, many_floes_keep_momentum_and_lose_energy)
