/* Mooring lines on a vessel: pulls, symmetry, springs, turret, failure, equilibrium. */
#include "sample_line.h"
#include "supply_ship.h"

typedef struct moored {
    bare_vessel b;
    line_table lines;
} moored;

static void moor(moored *m, line_definition d, int count)
{
    bare_vessel_open(&m->b);
    m->lines = (line_table){0};
    double first = d.direction;
    for (int i = 0; i < count; i++) {
        d.direction = first + 2 * PI * i / count;
        assert_ok(mooring_add_line(&m->b.ctx, &d, &m->b.vessels, &m->b.bodies, &m->lines, &m->b.error), m->b.error);
    }
}

static void unmoor(moored *m)
{
    table_free(&m->b.ctx, &m->lines, &line_table_info);
    bare_vessel_close(&m->b);
}

START_TEST(spread_is_balanced_and_restores)
{
    moored m;
    moor(&m, sample_line(0.3), 8);
    vec3 at = m.b.bodies.position[0];
    wrench none = mooring_pull(&m.lines, 0, at, quat_identity());
    assert_absolute(none.force.x, 0, 1);
    assert_absolute(none.force.y, 0, 1);
    assert_absolute(none.moment.z, 0, 10);
    /* Tension 400 kN, 100 m of height at 1 kN/m: H = 300 kN but for the stretch. */
    assert_relative(m.lines.tension[0], 4e5, 1e-6);
    assert_relative(m.lines.horizontal[0], 3e5, 1e-3);
    /* They pull down. */
    assert_relative(none.force.z, -8 * sqrt(4e5 * 4e5 - 3e5 * 3e5), 2e-3);
    wrench back = mooring_pull(&m.lines, 0, vec3_make(5, 0, 0), quat_identity());
    ck_assert(back.force.x < -1e4);
    assert_absolute(back.force.y, 0, 0.02 * fabs(back.force.x));
    wrench turned = mooring_pull(&m.lines, 0, at, quat_from_roll_pitch_yaw(0, 0, 0.1));
    ck_assert(turned.moment.z < -1e5);
    unmoor(&m);
}
END_TEST

START_TEST(a_turret_does_not_hold_the_heading)
{
    moored m;
    line_definition d = sample_line(0.3);
    d.turret = true;
    moor(&m, d, 8);
    wrench turned = mooring_pull(&m.lines, 0, m.b.bodies.position[0], quat_from_roll_pitch_yaw(0, 0, 1));
    assert_absolute(turned.moment.z, 0, 10);
    assert_absolute(turned.force.x, 0, 1);
    /* Each line stays 10 m out in its own direction, however the ship lies. */
    line_pull first = mooring_line_pull(&m.lines, 0, m.b.bodies.position[0], quat_from_roll_pitch_yaw(0, 0, 1));
    assert_vec3_close(first.point, vec3_make(10 * real_cos(0.3), 10 * real_sin(0.3), -5), 1e-12);
    unmoor(&m);
    /* Nor does one line that pulls aside on its fairlead turn the ship. */
    d.centre.x = 20;
    moor(&m, d, 1);
    wrench pull = mooring_pull(&m.lines, 0, vec3_make(0, -5, 0), quat_identity()), sum = {{0, 0, 0}, {0, 0, 0}};
    ck_assert(pull.force.y > 5e4);
    assert_relative(pull.moment.z, 20 * pull.force.y, 1e-9);
    m.b.bodies.position[0].y = -5;
    wrench load = sum;
    assert_ok(mooring_step(&m.b.ctx, &m.lines, &m.b.vessels, &m.b.bodies, 1, &load, &sum, &m.b.events, &m.b.error),
              m.b.error);
    assert_relative(sum.moment.z, 20 * sum.force.y, 1e-9);
    assert_relative(load.moment.z, 20 * load.force.y, 1e-9);
    unmoor(&m);
}
END_TEST

/* What a step adds to the body's load and to the sum that is recorded: the pull of all lines, its moment about the
   centre of mass. */
START_TEST(a_step_adds_force_and_moment)
{
    moored m;
    moor(&m, sample_line(0.3), 5);
    m.b.bodies.position[0] = vec3_make(4, -3, 0.5);
    m.b.bodies.orientation[0] = quat_from_roll_pitch_yaw(0.02, -0.05, 0.2);
    wrench expected = mooring_pull(&m.lines, 0, m.b.bodies.position[0], m.b.bodies.orientation[0]);
    wrench load = {{1, 2, 3}, {4, 5, 6}}, sum = {{0, 0, 0}, {0, 0, 0}};
    assert_ok(mooring_step(&m.b.ctx, &m.lines, &m.b.vessels, &m.b.bodies, 1, &load, &sum, &m.b.events, &m.b.error),
              m.b.error);
    ck_assert(fabs(expected.moment.x) > 1e5 && fabs(expected.moment.z) > 1e5);
    assert_vec3_close(sum.force, expected.force, 1e-6);
    assert_vec3_close(sum.moment, expected.moment, 1e-3);
    assert_vec3_close(vec3_sub(load.force, vec3_make(1, 2, 3)), expected.force, 1e-6);
    assert_vec3_close(vec3_sub(load.moment, vec3_make(4, 5, 6)), expected.moment, 1e-3);
    unmoor(&m);
}
END_TEST

/* A spring of stiffness k displaced by a steady force moves by force / k (statics). */
START_TEST(spring_offset)
{
    moored m;
    line_definition d = sample_line(0);
    d.kind = LINE_SPRING;
    d.stiffness = 5e4;
    d.pretension = 2e6;
    d.depth = 5 + 1e-6; /* level springs */
    moor(&m, d, 4);
    wrench back = mooring_pull(&m.lines, 0, vec3_make(1, 0, 0), quat_identity());
    /* Two along: 2 k x; two across: their tension turns with x / distance. */
    assert_relative(-back.force.x, 2 * 5e4 + 2 * 2e6 / 600, 1e-4);
    /* A spring never pushes. */
    back = mooring_pull(&m.lines, 0, vec3_make(50, 0, 0), quat_identity());
    assert_relative(-back.force.x,
                    5e4 * (50 + 40) + 2 * (2e6 + 5e4 * (sqrt(600 * 600 + 2500) - 600)) * 50 / sqrt(600 * 600 + 2500),
                    1e-6);
    unmoor(&m);
}
END_TEST

/* Tension of level lines by a table of two slopes, on its points, between and beyond them. */
START_TEST(tabulated_lines)
{
    moored m;
    line_definition d = sample_line(0);
    d.kind = LINE_TABLE;
    d.depth = 5 + 1e-6;
    d.points = 4;
    d.curve = (line_curve){{-10, 0, 10, 20}, {1e5, 3e5, 6e5, 1.6e6}};
    moor(&m, d, 1);
    assert_relative(m.lines.tension[0], 3e5, 1e-12);
    const struct {
        double offset, tension;
    } expected[] = {{-30, 1e5}, {-10, 1e5}, {-5, 2e5}, {5, 4.5e5}, {10, 6e5}, {15, 1.1e6}, {30, 2.6e6}};
    for (size_t i = 0; i < sizeof expected / sizeof *expected; i++) {
        vec3 at = vec3_make(-expected[i].offset, 0, 0);
        line_pull pull = mooring_line_pull(&m.lines, 0, at, quat_identity());
        assert_relative(pull.tension, expected[i].tension, 1e-9);
        assert_relative(pull.force.x, expected[i].tension, 1e-9);
        assert_absolute(pull.force.y, 0, 1e-6);
    }
    unmoor(&m);
    /* Four of them, one slope about the start: 2 k x along, 2 T x / L across, as springs. */
    d.curve = (line_curve){{-10, 10, 11, 12}, {1e5, 5e5, 6e5, 7e5}};
    moor(&m, d, 4);
    wrench back = mooring_pull(&m.lines, 0, vec3_make(1, 0, 0), quat_identity());
    assert_relative(-back.force.x, 2 * 2e4 + 2 * 3e5 / 600, 1e-4);
    unmoor(&m);
}
END_TEST

static vec3 steady(const void *user, double heading)
{
    (void)heading;
    return *(const vec3 *)user;
}

/* A line that goes down as far as it goes out: offsets are horizontal, the tension is that of the straight line, and a
   ship that heaves stretches nothing.  Statics: H = T / sqrt(2) at the start. */
START_TEST(tables_go_by_the_horizontal_offset)
{
    moored m;
    line_definition d = sample_line(0);
    d.kind = LINE_TABLE;
    d.depth = 305;
    d.distance = 300;
    d.points = 3;
    d.curve = (line_curve){{-10, 0, 20}, {1e5, 1e5, 3e5}};
    moor(&m, d, 1);
    assert_relative(m.lines.horizontal[0], 1e5 / sqrt(2), 1e-12);
    line_pull pull = mooring_line_pull(&m.lines, 0, vec3_make(-12, 0, 0), quat_identity());
    assert_relative(pull.tension, 2.2e5, 1e-12);
    assert_vec3_close(pull.force, vec3_scale(vec3_make(312, 0, -300), 2.2e5 / hypot(312, 300)), 1e-6);
    pull = mooring_line_pull(&m.lines, 0, vec3_make(0, 0, 3), quat_identity());
    assert_relative(pull.tension, 1e5, 1e-12);
    /* Aside by 80 m the anchor is 310.5 m off. */
    pull = mooring_line_pull(&m.lines, 0, vec3_make(0, 80, 0), quat_identity());
    assert_relative(pull.tension, 1e5 + 1e4 * (hypot(300, 80) - 300), 1e-12);
    /* The ship lies where the horizontal part of the tension is the load: the equilibrium goes by the same offsets. */
    double load_x = -2.2e5 * 312 / hypot(312, 300);
    vec3 load = {load_x, 0, 0}, at = m.b.bodies.position[0];
    quat q = quat_identity();
    mooring_balance left;
    ck_assert(mooring_equilibrium(&m.lines, 0, 76, steady, &load, &at, &q, &left));
    assert_absolute(at.x, -12, 1e-3);
    unmoor(&m);
}
END_TEST

static void refuse_curve(int32_t points, line_curve curve, const char *key)
{
    moored m;
    line_definition d = sample_line(0);
    bare_vessel_open(&m.b);
    m.lines = (line_table){0};
    d.kind = LINE_TABLE;
    d.points = points;
    d.curve = curve;
    fram_status status = mooring_add_line(&m.b.ctx, &d, &m.b.vessels, &m.b.bodies, &m.lines, &m.b.error);
    ck_assert_int_eq(status, FRAM_ERROR_INPUT);
    ck_assert_str_eq(m.b.error.key, key);
    unmoor(&m);
}

START_TEST(faulty_tables)
{
    refuse_curve(1, (line_curve){{0}, {1e5}}, "table");
    refuse_curve(3, (line_curve){{-1, 2, 2}, {0, 1, 2}}, "table[2].offset");
    refuse_curve(3, (line_curve){{-1, 2, 3}, {0, 2, 1}}, "table[2].tension");
    refuse_curve(2, (line_curve){{-1, 2}, {-1, 2}}, "table[0].tension");
    refuse_curve(2, (line_curve){{1, 2}, {1, 2}}, "table[0].offset");
}
END_TEST

START_TEST(equilibrium_under_a_steady_load)
{
    moored m;
    moor(&m, sample_line(0.3), 8);
    vec3 load = {2e5, -1e5, 1e6}, at = m.b.bodies.position[0];
    quat q = quat_identity();
    mooring_balance left;
    ck_assert(mooring_equilibrium(&m.lines, 0, 76, steady, &load, &at, &q, &left));
    ck_assert(at.x > 0.5 && at.y < -0.2);
    wrench pull = mooring_pull(&m.lines, 0, at, q);
    assert_absolute(pull.force.x, -2e5, 1);
    assert_absolute(pull.force.y, 1e5, 1);
    assert_absolute(pull.moment.z, -1e6, 100);
    /* Without lines there is none. */
    line_table none = {0};
    ck_assert(!mooring_equilibrium(&none, 0, 76, steady, &load, &at, &q, &left));
    unmoor(&m);
}
END_TEST

START_TEST(lines_break_and_are_let_go)
{
    moored m;
    moor(&m, sample_line(0), 4);
    m.lines.breaking_load[0] = 3.9e5;
    m.lines.release_time[2] = 1;
    wrench load = {0}, sum = {0};
    bare_vessel *b = &m.b;
    assert_ok(mooring_step(&b->ctx, &m.lines, &b->vessels, &b->bodies, 0.5, &load, &sum, &b->events, &b->error),
              b->error);
    ck_assert_int_eq(b->events.count, 1);
    ck_assert_int_eq(b->events.kind[0], EVENT_LINE_BREAK);
    ck_assert(m.lines.broken[0] && m.lines.tension[0] == 0);
    assert_relative(load.force.x, -3e5, 1e-2);
    assert_vec3_close(load.force, sum.force, 0);
    load = sum = (wrench){0};
    assert_ok(mooring_step(&b->ctx, &m.lines, &b->vessels, &b->bodies, 1, &load, &sum, &b->events, &b->error),
              b->error);
    ck_assert_int_eq(b->events.count, 2);
    ck_assert_int_eq(b->events.kind[1], EVENT_LINE_RELEASE);
    ck_assert_int_eq(b->events.number[1], 2);
    assert_absolute(load.force.x, 0, 1);
    unmoor(&m);
}
END_TEST

START_TEST(refusals)
{
    moored m;
    moor(&m, sample_line(0), 0);
    line_definition d = sample_line(0);
    d.pretension = 5e4;
    assert_fails(mooring_add_line(&m.b.ctx, &d, &m.b.vessels, &m.b.bodies, &m.lines, &m.b.error), m.b.error,
                 FRAM_ERROR_INPUT, "pretension");
    d = sample_line(0);
    d.depth = 3;
    assert_fails(mooring_add_line(&m.b.ctx, &d, &m.b.vessels, &m.b.bodies, &m.lines, &m.b.error), m.b.error,
                 FRAM_ERROR_INPUT, "expected more than the depth");
    ck_assert_str_eq(m.b.error.key, "depth");
    d = sample_line(0);
    d.weight = 0;
    assert_fails(mooring_add_line(&m.b.ctx, &d, &m.b.vessels, &m.b.bodies, &m.lines, &m.b.error), m.b.error,
                 FRAM_ERROR_INPUT, "expected a positive number");
    ck_assert_str_eq(m.b.error.key, "weight");
    ck_assert_int_eq(m.lines.count, 0);
    unmoor(&m);
}
END_TEST

TEST_MAIN("mooring", spread_is_balanced_and_restores, a_turret_does_not_hold_the_heading, a_step_adds_force_and_moment,
          spring_offset, tabulated_lines, tables_go_by_the_horizontal_offset, faulty_tables,
          equilibrium_under_a_steady_load, lines_break_and_are_let_go, refusals)
