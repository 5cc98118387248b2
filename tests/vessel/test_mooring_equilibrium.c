/* Where a moored vessel comes to rest under a steady load: on a turret in current and wind, stable and unstable. */
#include "sample_line.h"
#include "supply_ship.h"
#include "vessel/plane_motion.h"

#define LENGTH 76.2
#define TURRET 20.0

/* A ship on a turret forward of its centre of mass; its lines end in the middle of that: they have no moment about it.
 */
typedef struct moored {
    bare_vessel b;
    line_table lines;
} moored;

static void moor(moored *m, double turret)
{
    bare_vessel_open(&m->b);
    m->lines = (line_table){0};
    line_definition d = sample_line(0);
    d.turret = true;
    d.centre.x = turret;
    d.fairlead_distance = 0;
    for (int i = 0; i < 5; i++) {
        d.direction = 0.1 + 2 * PI * i / 5;
        assert_ok(mooring_add_line(&m->b.ctx, &d, &m->b.vessels, &m->b.bodies, &m->lines, &m->b.error), m->b.error);
    }
}

static void unmoor(moored *m)
{
    table_free(&m->b.ctx, &m->lines, &line_table_info);
    bare_vessel_close(&m->b);
}

/* What flows in two directions [rad] past a symmetric hull: forces with the square of the parts along and across it, as
   of drag [N], so that the moment about the turret has no slope where the bow points into one that is alone. */
typedef struct flows {
    double direction[2], along[2], across[2];
} flows;

static vec3 push_of(const void *user, double heading)
{
    const flows *f = user;
    vec3 sum = {0, 0, 0};
    for (int i = 0; i < 2; i++) {
        double c = real_cos(f->direction[i] - heading), s = real_sin(f->direction[i] - heading);
        sum = vec3_add(sum,
                       plane_to_global(heading, vec3_make(f->along[i] * c * fabs(c), f->across[i] * s * fabs(s), 0)));
    }
    return sum;
}

/* By hand: moment of the push about the turret. */
static double moment_of(const flows *f, double heading)
{
    return -TURRET * plane_to_vessel(heading, push_of(f, heading)).y;
}

typedef struct outcome {
    bool found;
    double heading;
    vec3 position;
    mooring_balance left;
} outcome;

static outcome find(moored *m, steady_load load, const void *user, double heading)
{
    outcome out = {.position = m->b.bodies.position[0]};
    quat q = quat_from_roll_pitch_yaw(0, 0, heading);
    out.found = mooring_equilibrium(&m->lines, 0, LENGTH, load, user, &out.position, &q, &out.left);
    out.heading = quat_roll_pitch_yaw(q).z;
    return out;
}

/* With the turret forward the bow comes to point into the current, from every heading but that with the stern in it. */
START_TEST(the_bow_points_into_the_current)
{
    moored m;
    moor(&m, TURRET);
    for (int i = 0; i < 12; i++) {
        double direction = radians(30 * i + 4);
        const flows current = {{direction}, {4e3}, {9e4}};
        for (int from = 0; from < 360; from += 40) {
            outcome o = find(&m, push_of, &current, radians(from));
            ck_assert_msg(o.found, "current towards %d, from %d degrees: %g N are left", 30 * i + 4, from,
                          o.left.residual);
            assert_absolute(degrees(plane_angle(o.heading - direction - PI)), 0, 0.01);
            assert_absolute(o.left.turn_left, 0, 1e-3);
            /* The lines bear the push ahead, and the turret lies behind the middle of them. */
            wrench pull = mooring_pull(&m.lines, 0, o.position, quat_from_roll_pitch_yaw(0, 0, o.heading));
            assert_absolute(pull.force.x, -4e3 * real_cos(direction), 2);
            assert_absolute(pull.force.y, -4e3 * real_sin(direction), 2);
        }
    }
    unmoor(&m);
}
END_TEST

/* Of several headings the one to which the moment turns the ship from its own, beside a search in steps of a hundredth
   of a degree. */
START_TEST(downhill_from_where_it_is_put)
{
    moored m;
    moor(&m, TURRET);
    const flows crossed = {{radians(90), 0}, {4e3, 6e3}, {9e4, 6e4}};
    for (int from = 0; from < 360; from += 15) {
        double way = moment_of(&crossed, radians(from)) > 0 ? 0.01 : -0.01, expected = from;
        while (moment_of(&crossed, radians(expected)) * way > 0)
            expected += way;
        outcome o = find(&m, push_of, &crossed, radians(from));
        ck_assert_msg(o.found, "from %d degrees: %g N are left", from, o.left.residual);
        assert_absolute(degrees(plane_angle(o.heading - radians(expected))), 0, 0.02);
        assert_absolute(moment_of(&crossed, o.heading) / LENGTH, 0, 1);
        double beside = radians(0.5);
        ck_assert(moment_of(&crossed, o.heading + beside) < 0 && moment_of(&crossed, o.heading - beside) > 0);
        assert_absolute(o.left.turn_left, 0, 1e-3);
    }
    unmoor(&m);
}
END_TEST

/* Put exactly with the stern into the current the ship stays, for it lies in balance; that any touch ends it is told.
 */
START_TEST(a_balance_that_any_touch_ends)
{
    moored m;
    moor(&m, TURRET);
    const flows current = {{radians(0)}, {4e3}, {9e4}};
    outcome stern = find(&m, push_of, &current, 0);
    ck_assert(stern.found);
    assert_absolute(stern.heading, 0, 1e-6);
    assert_absolute(fabs(stern.left.turn_left), PI, 1e-3);
    outcome bow = find(&m, push_of, &current, PI);
    ck_assert(bow.found);
    assert_absolute(plane_angle(bow.heading - PI), 0, 3e-4);
    assert_absolute(bow.left.turn_left, 0, 3e-4);
    /* A hair from the stern it turns all the way round, the near way. */
    outcome near = find(&m, push_of, &current, radians(-1));
    ck_assert(near.found);
    assert_absolute(fabs(degrees(plane_angle(near.heading))), 180, 0.01);
    unmoor(&m);
    /* With the turret aft it is the other way round. */
    moor(&m, -TURRET);
    outcome aft = find(&m, push_of, &current, radians(100));
    ck_assert(aft.found);
    assert_absolute(degrees(aft.heading), 0, 0.01);
    unmoor(&m);
}
END_TEST

/* Nothing turns a ship on a turret in still water: it stays as it is put. */
START_TEST(at_rest_at_any_heading)
{
    moored m;
    moor(&m, TURRET);
    for (int from = -170; from < 180; from += 50) {
        m.b.bodies.position[0] =
            vec3_make(TURRET * (1 - real_cos(radians(from))), -TURRET * real_sin(radians(from)), 0);
        outcome o = find(&m, NULL, NULL, radians(from));
        ck_assert(o.found);
        assert_absolute(degrees(o.heading), from, 1e-3);
        assert_absolute(o.left.turn_left, 0, 1e-3);
    }
    unmoor(&m);
}
END_TEST

static vec3 twist(const void *user, double heading)
{
    (void)heading;
    return vec3_make(0, 0, *(const double *)user);
}

/* A turret bears no moment: under a steady one there is no rest. */
START_TEST(no_rest_under_a_moment)
{
    moored m;
    moor(&m, TURRET);
    double moment = 2e6;
    outcome o = find(&m, twist, &moment, 0.3);
    ck_assert(!o.found && o.left.residual > 0.5 * moment / LENGTH);
    ck_assert(isfinite(o.heading) && isfinite(o.position.x) && isfinite(o.position.y));
    unmoor(&m);
}
END_TEST

/* A barge on one hawser from its bow: taut or slack where it is put, it comes to lie behind the anchor, as far off as
   the hawser is stretched, in a current that hardly moves it and in a strong one, were it 75 of its lengths. */
START_TEST(on_one_hawser)
{
    static const double length[] = {298, 301, 310, 6000}, push[] = {20, 3e3, 3e5};
    for (int i = 0; i < 12; i++) {
        bare_vessel b;
        line_table lines = {0};
        const flows current = {{PI}, {push[i % 3]}, {6 * push[i % 3]}};
        line_definition d = sample_line(0);
        d.kind = LINE_SPRING;
        d.centre.x = TURRET;
        d.fairlead_distance = 0;
        d.distance = 300;
        d.depth = 5 + 22;
        d.length = length[i / 3];
        d.stiffness = 2e5;
        bare_vessel_open(&b);
        quat q = b.bodies.orientation[0] = quat_from_roll_pitch_yaw(0, 0, radians(10));
        vec3 at = b.bodies.position[0];
        mooring_balance left;
        assert_ok(mooring_add_line(&b.ctx, &d, &b.vessels, &b.bodies, &lines, &b.error), b.error);
        ck_assert_msg(mooring_equilibrium(&lines, 0, LENGTH, push_of, &current, &at, &q, &left),
                      "%g m, %g N: %g N are left", d.length, push[i % 3], left.residual);
        assert_absolute(degrees(quat_roll_pitch_yaw(q).z), 0, 0.01);
        assert_absolute(at.y, lines.anchor[0].y, 0.05);
        double away = lines.anchor[0].x - at.x - TURRET, straight = sqrt(away * away + 22 * 22);
        assert_relative(d.stiffness * (straight - d.length), push[i % 3] * straight / away, 1e-3);
        table_free(&b.ctx, &lines, &line_table_info);
        bare_vessel_close(&b);
    }
}
END_TEST

TEST_MAIN("mooring_equilibrium", the_bow_points_into_the_current, downhill_from_where_it_is_put,
          a_balance_that_any_touch_ends, at_rest_at_any_heading, no_rest_under_a_moment, on_one_hawser)
