/* A vessel on station, step by step: which load turns its heading and is fed forward, when measurements and orders are
   due, and what counts as lost. */
#include "supply_ship.h"

#include "vessel/station.h"

typedef struct held {
    bare_vessel b;
    station_table stations;
    waypoint_table path;
} held;

static station_definition definition(void)
{
    const mat3 mass = {{{6e6, 0, 0}, {0, 8e6, 0}, {0, 0, 3e9}}}, damping = {{{1e5, 0, 0}, {0, 2e5, 0}, {0, 0, 3e8}}};
    return (station_definition){.positioning = true,
                                .observer = OBSERVER_PASSIVE,
                                .control_every = 1,
                                .sample_every = 1,
                                .offset_limit = HUGE_VAL,
                                .heading_limit = HUGE_VAL,
                                .model = {mass, damping},
                                .control_frequency = 0.1,
                                .control_damping = 1,
                                .filter = {0.05, 1, 1, 0.01},
                                .passive = {0.2, 1000},
                                .vaning = {radians(1), 60, 1e4},
                                .feed_gain = 1,
                                .feed_time = 0};
}

static void open_held(held *h, const station_definition *d)
{
    memset(h, 0, sizeof *h);
    bare_vessel_open(&h->b);
    fram_error error = {0};
    assert_ok(station_add(&h->b.ctx, d, 0, &h->b.vessels, &h->b.bodies, &h->stations, &error), error);
}

static void close_held(held *h)
{
    table_free(&h->b.ctx, &h->stations, &station_table_info);
    table_free(&h->b.ctx, &h->path, &waypoint_table_info);
    bare_vessel_close(&h->b);
}

/* One step of 0.1 s under a load of ice. */
static void step(held *h, int64_t number, wrench ice)
{
    const station_moment now = {number, number, 0.1 * (double)number, 0.1, ice};
    fram_error error = {0};
    assert_ok(station_step(&h->b.ctx, &h->stations, 0, &now, &h->b.vessels, &h->b.bodies, &h->path, &h->b.thrusters,
                           &h->b.events, &error),
              error);
}

static const wrench to_port = {{0, 5e5, 0}, {0, 0, 7e6}};

/* With the measured load fed forward the heading turns against that load; otherwise against what the observer takes
   for the load. */
START_TEST(the_load_that_turns_the_heading)
{
    for (int feed = FEED_NONE; feed <= FEED_OBSERVED; feed++) {
        held h;
        station_definition d = definition();
        d.heading = HEADING_VANING;
        d.feed = (feed_source)feed;
        open_held(&h, &d);
        step(&h, 1, to_port);
        /* Ice pushes to +Y: the bow goes to -Y.  The observer does not know of it yet. */
        if (feed == FEED_MEASURED)
            ck_assert(h.stations.vane_heading[0] < 0);
        else
            ck_assert(h.stations.vane_heading[0] == 0);
        h.stations.estimate[0].bias = vec3_make(0, -5e5, 0);
        double before = h.stations.vane_heading[0];
        step(&h, 2, to_port);
        double turned = h.stations.vane_heading[0] - before;
        ck_assert(feed == FEED_MEASURED ? turned < 0 : turned > 0);
        close_held(&h);
    }
}
END_TEST

/* Fed forward with a gain of 1 and without smoothing: the demand is against the load, force and moment. */
START_TEST(the_load_that_is_fed_forward)
{
    held h;
    station_definition d = definition();
    d.feed = FEED_MEASURED;
    open_held(&h, &d);
    step(&h, 1, to_port);
    assert_absolute(h.stations.load[0].y, 5e5, 1e-6);
    assert_absolute(h.stations.load[0].z, 7e6, 1e-6);
    assert_vec3_close(h.stations.demand[0], vec3_make(0, -5e5, -7e6), 1);
    close_held(&h);
    d.feed_gain = 0.5;
    d.feed_time = 1; /* a tenth of the way in a step of 0.1 s */
    open_held(&h, &d);
    step(&h, 1, to_port);
    assert_vec3_close(h.stations.load[0], vec3_make(0, 5e4, 7e5), 1e-6);
    assert_vec3_close(h.stations.demand[0], vec3_make(0, -2.5e4, -3.5e5), 1);
    close_held(&h);
    d = definition();
    d.feed = FEED_OBSERVED;
    open_held(&h, &d);
    h.stations.estimate[0].bias = vec3_make(3e5, 0, 0);
    step(&h, 1, to_port);
    ck_assert(h.stations.demand[0].x < -2e5 && fabs(h.stations.demand[0].y) < 1e3);
    close_held(&h);
}
END_TEST

START_TEST(orders_and_measurements_have_their_own_rates)
{
    held h;
    station_definition d = definition();
    d.feed = FEED_MEASURED;
    d.control_every = 5;
    d.sample_every = 2;
    open_held(&h, &d);
    h.b.bodies.position[0].x = 1;
    step(&h, 1, to_port);
    ck_assert(h.stations.measured[0].x == 0 && h.stations.demand[0].y == 0);
    step(&h, 2, to_port);
    ck_assert(h.stations.measured[0].x == 1 && h.stations.demand[0].y == 0);
    step(&h, 5, to_port);
    ck_assert(h.stations.demand[0].y < 0);
    close_held(&h);
    d.positioning = false;
    open_held(&h, &d);
    step(&h, 10, to_port);
    ck_assert(h.stations.demand[0].y == 0 && h.stations.load[0].y == 0);
    close_held(&h);
}
END_TEST

/* Position is lost beyond the limit and regained below nine tenths of it; so is the heading. */
START_TEST(lost_and_regained)
{
    held h;
    station_definition d = definition();
    d.positioning = false;
    d.offset_limit = 10;
    d.heading_limit = radians(20);
    open_held(&h, &d);
    static const double x[] = {9.9, -10.1, 9.5, 8.9, 9.9};
    static const int events[] = {0, 1, 1, 2, 2};
    for (int i = 0; i < 5; i++) {
        h.b.bodies.position[0] = vec3_make(x[i], 0, 0);
        step(&h, i + 1, (wrench){{0, 0, 0}, {0, 0, 0}});
        ck_assert_int_eq(h.b.events.count, events[i]);
    }
    ck_assert(h.b.events.kind[0] == EVENT_POSITION_LOST && h.b.events.kind[1] == EVENT_POSITION_LOST + 1);
    assert_absolute(h.b.events.value[0], 10.1, 1e-12);
    static const double turn[] = {19, -21, 18.5, 17};
    static const int more[] = {2, 3, 3, 4};
    for (int i = 0; i < 4; i++) {
        h.b.bodies.orientation[0] = quat_from_roll_pitch_yaw(0, 0, radians(turn[i]));
        step(&h, i + 6, (wrench){{0, 0, 0}, {0, 0, 0}});
        ck_assert_int_eq(h.b.events.count, more[i]);
    }
    ck_assert(h.b.events.kind[2] == EVENT_HEADING_LOST);
    close_held(&h);
}
END_TEST

/* What is watched is a point of the hull, from where it was at the start, moved with the way points. */
START_TEST(the_watched_point)
{
    held h;
    station_definition d = definition();
    d.positioning = false;
    d.watched = vec3_make(20, 0, 0);
    open_held(&h, &d);
    ck_assert(table_resize(&h.b.ctx, &h.path, &waypoint_table_info, 2));
    h.path.time[0] = 0.35;
    h.path.place[0] = vec3_make(3, 4, radians(10));
    h.path.time[1] = 1e9;
    h.path.place[1] = vec3_make(1e3, 1e3, 1);
    h.b.bodies.position[0] = vec3_make(3, 4, 0);
    step(&h, 3, (wrench){{0, 0, 0}, {0, 0, 0}});
    assert_vec3_close(h.stations.offset[0], vec3_make(3, 4, 0), 1e-12);
    step(&h, 4, (wrench){{0, 0, 0}, {0, 0, 0}});
    assert_vec3_close(h.stations.offset[0], vec3_make(0, 0, -radians(10)), 1e-12);
    h.b.bodies.orientation[0] = quat_from_roll_pitch_yaw(0, 0, PI / 2);
    step(&h, 5, (wrench){{0, 0, 0}, {0, 0, 0}});
    assert_vec3_close(h.stations.offset[0], vec3_make(-20, 20, radians(80)), 1e-12);
    close_held(&h);
}
END_TEST

/* A drilling ship 20 m before whose amidships the well lies turns about the well: the way point is 20 m off, the well
   stays.  Lines alone, and a bow that turns against the ice, do not move it; where thrusters hold the heading alone it
   stays whatever place the way point has. */
START_TEST(the_watched_point_turns)
{
    enum { HELD, ADRIFT, HEADING_ALONE, VANES, CASES };
    for (int k = 0; k < CASES; k++) {
        held h;
        station_definition d = definition();
        d.watched = vec3_make(20, 0, 0);
        d.positioning = k != ADRIFT;
        d.control = k == HEADING_ALONE ? CONTROL_HEADING : CONTROL_PLACE_AND_HEADING;
        d.heading = k == VANES ? HEADING_VANING : HEADING_FIXED;
        open_held(&h, &d);
        h.b.vessels.centre[0] = vec3_make(2, 0, 0);
        h.b.bodies.position[0] = vec3_make(2, 0, 0);
        h.stations.count = 0;
        assert_ok(station_add(&h.b.ctx, &d, 0, &h.b.vessels, &h.b.bodies, &h.stations, &h.b.error), h.b.error);
        ck_assert(table_resize(&h.b.ctx, &h.path, &waypoint_table_info, 1));
        h.path.place[0] = vec3_make(20, -20, PI / 2);
        h.b.bodies.position[0] = vec3_make(20, -18, 0);
        h.b.bodies.orientation[0] = quat_from_roll_pitch_yaw(0, 0, PI / 2);
        step(&h, 1, (wrench){{0, 0, 0}, {0, 0, 0}});
        vec3 off = h.stations.offset[0], still = vec3_make(-20, 20, 0);
        assert_vec3_close(vec3_make(off.x, off.y, 0), k == HELD || k == HEADING_ALONE ? vec3_make(0, 0, 0) : still,
                          1e-12);
        close_held(&h);
    }
}
END_TEST

/* Noise is drawn anew for each step, with the deviation asked for. */
START_TEST(noise_of_the_sensors)
{
    held h;
    station_definition d = definition();
    d.noise = vec3_make(0.5, 0.25, 0.01);
    d.seed = 7;
    open_held(&h, &d);
    enum { SAMPLES = 4000 };
    vec3 square = {0, 0, 0}, last = {0, 0, 0};
    for (int i = 0; i < SAMPLES; i++) {
        step(&h, i + 1, (wrench){{0, 0, 0}, {0, 0, 0}});
        vec3 m = h.stations.measured[0];
        ck_assert(m.x != last.x);
        square = vec3_add(square, vec3_make(m.x * m.x, m.y * m.y, m.z * m.z));
        last = m;
    }
    assert_relative(sqrt(square.x / SAMPLES), 0.5, 0.05);
    assert_relative(sqrt(square.y / SAMPLES), 0.25, 0.05);
    assert_relative(sqrt(square.z / SAMPLES), 0.01, 0.05);
    close_held(&h);
}
END_TEST

/* Every kind of event, for programs and for people: newtons as N, kN or MN, radians as degrees, numbers from 1. */
START_TEST(events_in_words)
{
    static const struct {
        station_event kind;
        double value;
        const char *name, *text;
    } told[] = {
        {EVENT_LINE_BREAK, 2.61e7, "line_break", "mooring line 3 broke at a tension of 26.1 MN"},
        {EVENT_LINE_RELEASE, 5e5, "line_release", "mooring line 3 was let go at a tension of 500 kN"},
        {EVENT_THRUSTER_FAILURE, -4e4, "thruster_failure", "thruster 3 failed at a thrust of -40 kN"},
        {EVENT_POSITION_LOST, 5.5, "position_lost", "position lost: the offset is 5.5 m"},
        {EVENT_POSITION_REGAINED, 4.5, "position_regained", "position regained: the offset is 4.5 m"},
        {EVENT_HEADING_LOST, 0.125 * PI, "heading_lost", "heading lost: it is off by 22.5 deg"},
        {EVENT_HEADING_REGAINED, -0.05 * PI, "heading_regained", "heading regained: it is off by -9 deg"},
        {EVENT_BESET, 13.5, "beset", "beset under a net thrust of 13.5 N"},
        {EVENT_RAM, 60, "ram", "backed 60 m, and rams"},
        {EVENT_APPROACH, 40, "approach", "vessel tug is going to pass at 40 m, in 90 s at present velocities"},
        {EVENT_APPROACH_OVER, 35, "approach_over", "vessel tug is clear again: it came as near as 35 m"},
        {EVENT_WALL, 7e5, "wall", "the hull runs into a wall of the domain, with 700 kN"},
        {EVENT_OFF_TRACK, 12, "off_track", "off its track by 12 m"},
        {EVENT_ON_TRACK, 15, "on_track", "back on its track: it was off by 15 m at most"},
        {EVENT_BAND, 7e5, "band", "the hull meets floes of the band, which nothing pushes aside, with 700 kN"},
    };
    context ctx;
    event_table events = {0};
    char text[160];
    context_init(&ctx);
    ck_assert_int_eq(sizeof told / sizeof *told, EVENT_COUNT);
    for (int32_t i = 0; i < EVENT_COUNT; i++) {
        ck_assert(event_add(&ctx, &events, told[i].kind, 1, 0, 2, told[i].value));
        events.ahead[i] = 90;
        ck_assert_str_eq(event_name(told[i].kind), told[i].name);
        event_text(&events, i, "tug", 300, text, sizeof text);
        ck_assert_str_eq(text, told[i].text);
        ck_assert(event_is_of_two(told[i].kind) == (strstr(text, "tug") != NULL));
    }
    table_free(&ctx, &events, &event_table_info);
}
END_TEST

TEST_MAIN("station", the_load_that_turns_the_heading, the_load_that_is_fed_forward,
          orders_and_measurements_have_their_own_rates, lost_and_regained, the_watched_point, the_watched_point_turns,
          noise_of_the_sensors, events_in_words)
