/* The static balance behind capability plots, against balances by hand. */
#include "supply_ship.h"
#include "vessel/holding.h"

typedef struct held {
    bare_vessel b;
    line_table lines;
    holding_case c;
} held;

static void hold_begin(held *h)
{
    bare_vessel_open(&h->b);
    h->lines = (line_table){0};
    h->c = (holding_case){.thrusters = &h->b.thrusters,
                          .lines = &h->lines,
                          .length = 76.2,
                          .line_safety = 1,
                          .offset_limit = HUGE_VAL,
                          .heading_limit = HUGE_VAL};
}

static void hold_end(held *h)
{
    table_free(&h->b.ctx, &h->lines, &line_table_info);
    bare_vessel_close(&h->b);
}

static void add_thruster(held *h, thruster_definition d)
{
    assert_ok(thruster_add(&h->b.ctx, &d, &h->b.vessels, &h->b.thrusters, &h->b.error), h->b.error);
}

/* Level springs of 600 m. */
static void add_springs(held *h, int count, double stiffness, double breaking_load)
{
    for (int i = 0; i < count; i++) {
        const line_definition d = {.kind = LINE_SPRING,
                                   .centre = {0, 0, -5},
                                   .direction = 2 * PI * i / count,
                                   .distance = 600,
                                   .depth = 5 + 1e-6,
                                   .length = (double)NAN,
                                   .pretension = 4e5,
                                   .stiffness = stiffness,
                                   .breaking_load = breaking_load,
                                   .release_time = HUGE_VAL};
        assert_ok(mooring_add_line(&h->b.ctx, &d, &h->b.vessels, &h->b.bodies, &h->lines, &h->b.error), h->b.error);
    }
}

static vec3 steady(const void *user, double heading)
{
    (void)heading;
    return *(const vec3 *)user;
}

START_TEST(thrusters_by_hand)
{
    held h;
    hold_begin(&h);
    add_thruster(&h, supply_tunnel(30));
    add_thruster(&h, supply_tunnel(-30));
    add_thruster(&h, supply_main(8));
    add_thruster(&h, supply_main(-8));
    double main = h.b.thrusters.ahead[2], tunnel = h.b.thrusters.ahead[0];
    vec3 load = {-main, 0, 0}; /* half of what both mains can */
    holding at = holding_find(&h.c, steady, &load);
    assert_relative(at.use, 0.5, 1e-3);
    ck_assert_int_eq(at.item, HOLDING_THRUSTER);
    ck_assert(at.number == 2 || at.number == 3);
    load = vec3_make(0, 3 * tunnel, 0); /* one and a half times what both tunnels can */
    at = holding_find(&h.c, steady, &load);
    assert_relative(at.use, 1.5, 1e-3);
    load = vec3_make(0, 0, 30 * tunnel); /* a couple: the tunnels and the mains share it */
    at = holding_find(&h.c, steady, &load);
    assert_relative(at.use, 30 * tunnel / (60 * tunnel + 16 * main), 1e-3);
    /* A heading turns the load, not what it uses. */
    h.c.heading = 1;
    load = plane_to_global(1, vec3_make(-main, 0, 0));
    assert_relative(holding_find(&h.c, steady, &load).use, 0.5, 1e-3);
    h.c.heading = 0;
    /* One main is lost: the other turns the ship, and the tunnels must undo that. */
    h.b.thrusters.failed[3] = 1;
    load = vec3_make(-0.5 * main, 0, 0);
    at = holding_find(&h.c, steady, &load);
    assert_relative(at.use, 0.5, 1e-3);
    ck_assert_int_eq(at.number, 2);
    h.b.thrusters.failed[2] = 1;
    ck_assert(holding_find(&h.c, steady, &load).use > 1e3);
    hold_end(&h);
}
END_TEST

START_TEST(springs_by_hand)
{
    held h;
    hold_begin(&h);
    double k = 5e4;
    add_springs(&h, 4, k, 1e6);
    vec3 load = {2e5, 0, 0};
    double expected = 2e5 / (2 * k + 2 * 4e5 / 600);
    holding at = holding_find(&h.c, steady, &load);
    assert_relative(at.offset, expected, 1e-3);
    /* The line that leads aft carries the pretension and the stretch. */
    assert_relative(at.use, (4e5 + k * expected) / 1e6, 1e-3);
    ck_assert_int_eq(at.item, HOLDING_LINE);
    ck_assert_int_eq(at.number, 2);
    h.c.line_safety = 2;
    assert_relative(holding_find(&h.c, steady, &load).use, 2 * (4e5 + k * expected) / 1e6, 1e-3);
    h.c.line_safety = 1;
    h.c.offset_limit = 1;
    at = holding_find(&h.c, steady, &load);
    assert_relative(at.use, expected, 1e-3);
    ck_assert_int_eq(at.item, HOLDING_OFFSET);
    /* Without the line aft, nothing is there to pull back but the two across. */
    h.c.offset_limit = HUGE_VAL;
    h.lines.broken[2] = 1;
    ck_assert(holding_find(&h.c, steady, &load).offset > 5 * expected);
    hold_end(&h);
}
END_TEST

/* Thrusters take what they can, the lines the rest. */
START_TEST(both_together)
{
    held h;
    hold_begin(&h);
    double k = 5e4;
    add_springs(&h, 4, k, 1e7);
    add_thruster(&h, supply_main(8));
    add_thruster(&h, supply_main(-8));
    double main = h.b.thrusters.astern[0];
    vec3 load = {main, 0, 0}; /* within reach */
    holding at = holding_find(&h.c, steady, &load);
    assert_absolute(at.offset, 0, 1e-3);
    assert_relative(at.thruster_use, 0.5, 1e-3);
    load.x = 2 * main + 1e5;
    at = holding_find(&h.c, steady, &load);
    assert_relative(at.offset, 1e5 / (2 * k + 2 * 4e5 / 600), 5e-3);
    assert_relative(at.thruster_use, 1, 1e-3);
    /* A turret that keeps its heading takes no moment from the lines. */
    h.c.heading_given = true;
    load = vec3_make(0, 1e5, 1e8);
    at = holding_find(&h.c, steady, &load);
    assert_absolute(at.turn, 0, 1e-2);
    hold_end(&h);
}
END_TEST

/* A moment that is least, but not nothing, as the ship lies, and vanishes with a turn of 0.3 rad. */
static vec3 moment_with_a_hollow(const void *user, double heading)
{
    double most = *(const double *)user, way = heading < 0.2 ? 1 + heading * heading : 10.4 * (0.3 - heading);
    return vec3_make(1e5, 0, most * way);
}

/* Lines that end in one point do not turn a ship: its load alone tells where it comes to rest. */
START_TEST(turned_by_the_load_alone)
{
    held h;
    double most = 4e6;
    hold_begin(&h);
    add_springs(&h, 4, 5e4, 1e6);
    holding at = holding_find(&h.c, moment_with_a_hollow, &most);
    assert_relative(at.turn, 0.3, 1e-6);
    assert_relative(at.offset, 1e5 / (2 * 5e4 + 2 * 4e5 / 600), 1e-3);
    most = -most; /* the other way round it turns for ever */
    at = holding_find(&h.c, moment_with_a_hollow, &most);
    ck_assert_int_eq(at.item, HOLDING_NOTHING);
    ck_assert(isinf(at.use));
    hold_end(&h);
}
END_TEST

/* A drift along X that pushes with 1e5 N, and turns a ship across it as Munk's moment does. */
static vec3 moment_of_munk(const void *user, double heading)
{
    (void)user;
    return vec3_make(1e5, 0, 4e6 * real_sin(2 * heading));
}

static vec3 moment_of_a_vane(const void *user, double heading)
{
    vec3 load = moment_of_munk(user, heading);
    return vec3_make(load.x, load.y, -load.z);
}

/* What holds no heading is turned from a balance that does not hold, be it near, or that of its own heading.  Thrusters
   that give the moment hold the heading. */
/* The lines of another vessel, broken or not, have no part in what holds this one. */
START_TEST(lines_of_its_own)
{
    for (int row = 0; row < 2; row++) {
        held h;
        double most = 4e6;
        hold_begin(&h);
        h.c.heading_given = true;
        add_springs(&h, 4, 5e4, 1e6);
        holding alone = holding_find(&h.c, moment_with_a_hollow, &most);
        add_springs(&h, 8, 5e6, 1e12);
        for (int i = 0; i < 12; i++) {
            h.lines.vessel[i] = (i < 4) == (row == 0) ? 0 : 1;
            h.lines.tension[i] *= i < 4 ? 1 : 1e3;
        }
        h.c.vessel = row;
        holding beside = holding_find(&h.c, moment_with_a_hollow, &most);
        assert_bits(beside.turn, alone.turn);
        assert_bits(beside.offset, alone.offset);
        hold_end(&h);
    }
}
END_TEST

START_TEST(no_balance_that_any_touch_ends)
{
    static const double across[] = {40, 50, 0, 90};
    for (size_t k = 0; k < sizeof across / sizeof *across; k++) {
        held h;
        double offset = 1e5 / (2 * 5e4 + 2 * 4e5 / 600);
        hold_begin(&h);
        add_springs(&h, 4, 5e4, 1e6);
        h.c.heading = radians(across[k]);
        holding at = holding_find(&h.c, moment_of_munk, NULL);
        assert_absolute(degrees(at.turn), 90 - across[k], 1e-3);
        assert_relative(at.offset, offset, 1e-3);
        at = holding_find(&h.c, moment_of_a_vane, NULL);
        assert_absolute(degrees(at.turn), across[k], 1e-3);
        add_thruster(&h, supply_tunnel(30));
        add_thruster(&h, supply_tunnel(-30));
        h.c.heading_alone = true;
        at = holding_find(&h.c, moment_of_munk, NULL);
        assert_absolute(at.turn, 0, 1e-6);
        assert_relative(at.offset, offset, 1e-3);
        hold_end(&h);
    }
}
END_TEST

/* None with the bow in the drift; from there it turns the ship to port, or to starboard, wherever it lies. */
static vec3 moment_to_one_side(const void *user, double heading)
{
    double most = *(const double *)user, s = real_sin(heading);
    return vec3_make(1e5, 0, most * s * s * real_cos(heading));
}

/* Thrusters that can give no moment hold no heading, though none is missed: a propeller on the centreline, with the bow
   in a drift that turns the ship across, and tunnels too weak for it, across one that turns it along; stronger ones
   turn it back though they push all they can, and leave more of the push to the lines. */
START_TEST(no_heading_without_a_moment)
{
    held h;
    hold_begin(&h);
    add_springs(&h, 4, 5e4, 1e7);
    add_thruster(&h, supply_main(0));
    holding at = holding_find(&h.c, moment_of_munk, NULL);
    assert_absolute(degrees(at.turn), 90, 1e-3);
    at = holding_find(&h.c, moment_of_a_vane, NULL);
    assert_absolute(degrees(at.turn), 0, 1e-3);
    for (double most = -4e8; most < 5e8; most += 8e8) {
        at = holding_find(&h.c, moment_to_one_side, &most);
        assert_absolute(degrees(at.turn), 90, 1e-3);
    }
    vec3 little = {1e5, 0, 1e3};
    ck_assert(isinf(holding_find(&h.c, steady, &little).use));
    h.b.thrusters.failed[0] = 1;
    add_thruster(&h, supply_tunnel(30));
    add_thruster(&h, supply_tunnel(-30));
    h.c.heading = 0.5 * PI;
    at = holding_find(&h.c, moment_of_a_vane, NULL);
    assert_absolute(degrees(at.turn), 0, 1e-3);
    static const double pushes[] = {2e4, 2e3};
    for (size_t k = 0; k < sizeof pushes / sizeof *pushes; k++) {
        for (int i = 1; i < 3; i++)
            h.b.thrusters.ahead[i] = h.b.thrusters.astern[i] = pushes[k];
        at = holding_find(&h.c, moment_of_a_vane, NULL);
        assert_absolute(degrees(at.turn), k == 0 ? 0 : 90, 1e-3);
        assert_relative(at.thruster_use, 1, 1e-3);
        assert_relative(at.offset, (1e5 - 2 * pushes[k]) / (2 * 5e4 + 2 * 4e5 / 600), k == 0 ? 1e-3 : 0.05);
    }
    hold_end(&h);
}
END_TEST

/* A tunnel at the bow turns a ship only with a push aside, which the lines bear: it holds the heading under Munk's
   moment, as far as its thrust is the moment over its lever. */
START_TEST(a_moment_comes_first)
{
    static const double headings[] = {0, 5};
    for (size_t k = 0; k < sizeof headings / sizeof *headings; k++) {
        held h;
        hold_begin(&h);
        add_springs(&h, 4, 5e4, 1e7);
        add_thruster(&h, supply_main(0));
        add_thruster(&h, supply_tunnel(30));
        h.c.heading = radians(headings[k]);
        holding at = holding_find(&h.c, moment_of_munk, NULL);
        assert_absolute(at.turn, 0, 1e-3);
        double aside = 1e5 * real_sin(h.c.heading) + 4e6 * real_sin(2 * h.c.heading) / 30;
        assert_absolute(at.offset, aside / (2 * 5e4 + 2 * 4e5 / 600), 2e-3);
        h.b.thrusters.ahead[1] = h.b.thrusters.astern[1] = 1e3;
        at = holding_find(&h.c, moment_of_munk, NULL);
        ck_assert_double_gt(at.turn, 1);
        hold_end(&h);
    }
}
END_TEST

/* Lines that end before the centre of mass turn the ship as they give, by 20 m times 1e5 N.  Thrusters that give what
   load and lines leave hold it; what is beyond their couple turns the ship about the end of the lines, until these turn
   it less. */
START_TEST(a_heading_that_thrusters_hold)
{
    static const double moments[] = {4e6, 1.3e7, -1.1e7};
    held h;
    hold_begin(&h);
    add_springs(&h, 4, 5e4, 1e6);
    for (int i = 0; i < h.lines.count; i++) {
        h.lines.fairlead[i].x += 20;
        h.lines.anchor[i].x += 20;
    }
    add_thruster(&h, supply_tunnel(30));
    add_thruster(&h, supply_tunnel(-30));
    h.c.heading_alone = true;
    double most = 60 * h.b.thrusters.ahead[0];
    ck_assert(most > 1.1e7 && most < 1.3e7);
    for (size_t k = 0; k < sizeof moments / sizeof *moments; k++) {
        double asked = moments[k] - 2e6;
        vec3 load = {0, 1e5, moments[k]};
        holding at = holding_find(&h.c, steady, &load);
        assert_relative(at.thruster_use, fmin(fabs(asked) / most, 1), 1e-3);
        double cosine = (most + moments[k]) / 2e6; /* of the turn at which what is left vanishes */
        assert_absolute(cos(at.turn), fabs(asked) < most ? 1 : cosine, 1e-5);
        if (fabs(asked) < most)
            assert_relative(at.offset, 1e5 / (2 * 5e4 + 2 * 4e5 / 600), 1e-2);
    }
    hold_end(&h);
}
END_TEST

/* What is beyond the thrusters turns the ship on its lines, be it ever so little. */
START_TEST(turned_by_what_is_missed)
{
    held h;
    hold_begin(&h);
    add_springs(&h, 4, 5e4, 1e7);
    for (int i = 0; i < h.lines.count; i++) {
        vec3 out = plane_to_global(0.5 * PI * i, vec3_make(35, 0, 0));
        h.lines.fairlead[i] = vec3_add(h.lines.fairlead[i], out);
        h.lines.anchor[i] = vec3_add(h.lines.anchor[i], out);
    }
    add_thruster(&h, supply_tunnel(30));
    add_thruster(&h, supply_tunnel(-30));
    h.c.heading_alone = true;
    vec3 load = {0, 0, 60 * h.b.thrusters.ahead[0] + 5e5};
    assert_relative(holding_find(&h.c, steady, &load).turn, 5e5 / (4 * 4e5 * 35 * (1 + 35 / 600.0)), 1e-3);
    hold_end(&h);
}
END_TEST

/* A thruster at one end pushes the ship aside, and lines that end elsewhere turn it as they give.  On the far side of
   their end it turns the ship the other way than about the centre of mass, and holds nothing. */
START_TEST(turned_by_the_thruster_and_its_lines)
{
    static const double ends[] = {60, -15, -40};
    for (size_t k = 0; k < sizeof ends / sizeof *ends; k++) {
        held h;
        hold_begin(&h);
        add_springs(&h, 4, 5e4, 1e7);
        for (int i = 0; i < h.lines.count; i++) {
            h.lines.fairlead[i].x += ends[k];
            h.lines.anchor[i].x += ends[k];
        }
        add_thruster(&h, supply_tunnel(-30));
        h.c.heading_alone = true;
        vec3 load = {0, 0, 1e6};
        holding at = holding_find(&h.c, steady, &load);
        double push = 1e6 / (30 + ends[k]);
        if (push > 0) {
            assert_relative(at.thruster_use, push / h.b.thrusters.ahead[0], 1e-3);
            assert_relative(at.offset, push / (2 * 5e4 + 2 * 4e5 / 600), 1e-2);
            assert_absolute(at.turn, 0, 1e-4);
        } else {
            assert_relative(at.thruster_use, 1, 1e-9);
            ck_assert(isinf(at.use));
        }
        hold_end(&h);
    }
}
END_TEST

/* Thrusters that hold the heading alone, wherever they are: the moment is reached, and the lines hold what comes with
   it. */
START_TEST(a_moment_alone)
{
    static const double places[][2] = {{-30, -30}, {-30, -20}, {-30, 30}, {-30, 20}};
    for (size_t k = 0; k < sizeof places / sizeof *places; k++) {
        held h;
        hold_begin(&h);
        double stiffness = 5e4, a = places[k][0], b = places[k][1];
        add_springs(&h, 4, stiffness, 1e7);
        add_thruster(&h, supply_tunnel(a));
        add_thruster(&h, supply_tunnel(b));
        h.c.heading_alone = h.c.heading_given = true;
        double most = h.b.thrusters.ahead[0];
        vec3 load = {0, 0, 10 * most};
        holding at = holding_find(&h.c, steady, &load);
        assert_relative(at.thruster_use, 10 / (fabs(a) + fabs(b)), 1e-3);
        /* The least squares of thrusts go by their levers. */
        double aside = 10 * most * fabs(a + b) / (a * a + b * b);
        assert_absolute(at.offset, aside / (2 * stiffness + 2 * 4e5 / 600), 5e-3);
        assert_absolute(at.turn, 0, 1e-2);
        load = vec3_make(1e5, 2e4, 0);
        at = holding_find(&h.c, steady, &load);
        ck_assert_msg(at.thruster_use < 1e-3, "%g of the thrust is used by no moment", at.thruster_use);
        hold_end(&h);
    }
}
END_TEST

TEST_MAIN("holding", thrusters_by_hand, springs_by_hand, both_together, a_moment_alone, turned_by_the_load_alone,
          lines_of_its_own, no_balance_that_any_touch_ends, no_heading_without_a_moment, a_moment_comes_first,
          a_heading_that_thrusters_hold, turned_by_what_is_missed, turned_by_the_thruster_and_its_lines)
