/* An icebreaker keeps its pattern in open water: every kind, in a drift that turns, at several speeds, with two hulls;
   its room to turn is the one that is told.  Bounds are parts of its breadth. */
#include "scene.h"

#include "base/transcendental.h"
#include "model/inputs.h"
#include "sim/feed.h"
#include "sim/turning.h"

#include <stdio.h>

#define SEA_AS_GIVEN        \
    "ice: {source: none}\n" \
    "domain: {x_min: -8000, x_max: 8000, y_min: -8000, y_max: 8000, boundary: open}\n"
#define SEA SEA_AS_GIVEN "environment: {hull_drag: {water_form: 1}}\n"
/* That of the ready scenes, and a small one. */
#define LARGE_WITH(track)                                                                                 \
    "run: {duration: 9000, time_step: 0.25, scale: 30}\n"                                                 \
    "vessel:\n  mode: free\n  mass: 1.49e7\n"                                                             \
    "  hull: {form: icebreaker, length: 121, beam: 25, draught: 8.8, freeboard: 5, stem_angle_deg: 22,\n" \
    "         entrance_angle_deg: 35, flare_angle_deg: 8, stern_angle_deg: 35, parallel_midbody: 0.45,\n" \
    "         block_coefficient: 0.546}\n"                                                                \
    "  hydrodynamics: {source: estimate}\n"                                                               \
    "  propulsion: {bollard_pull: 2.44e6, open_water_speed: 8.7, propellers: 2" track "}\n" SEA
static const char *const LARGE = LARGE_WITH("");
#define SMALL_WITH(helm)                                                           \
    "run: {duration: 9000, time_step: 0.25, scale: 30}\n"                          \
    "vessel:\n  mode: free\n"                                                      \
    "  hull: {form: icebreaker, length: 60, beam: 14, draught: 5, freeboard: 4,\n" \
    "         stem_angle_deg: 25, entrance_angle_deg: 30, flare_angle_deg: 8,\n"   \
    "         stern_angle_deg: 30, parallel_midbody: 0.4}\n"                       \
    "  hydrodynamics: {source: estimate}\n"                                        \
    "  propulsion: {bollard_pull: 8.0e5, open_water_speed: 7, propellers: 2" helm "}\n" SEA
static const char *const SMALL = SMALL_WITH("");

/* That of the scenes of ice management, whose thrust turns. */
#define AZIMUTH_AT(rate)                                                                                     \
    "run: {duration: 9000, time_step: 0.25, scale: 30}\n"                                                    \
    "vessel:\n  mode: free\n  mass: 1.0961e7\n  centre_of_gravity_z: 0\n"                                    \
    "  hull: {form: icebreaker, length: 104, beam: 24, draught: 8, freeboard: 5, stem_angle_deg: 22,\n"      \
    "         entrance_angle_deg: 35, flare_angle_deg: 8, stern_angle_deg: 35, parallel_midbody: 0.45,\n"    \
    "         block_coefficient: 0.536}\n"                                                                   \
    "  hydrodynamics: {source: estimate}\n"                                                                  \
    "  propulsion: {bollard_pull: 2.10e6, open_water_speed: 8.75, rudder_area: 0, steering_angle_deg: 60,\n" \
    "               steering_rate_deg: " rate "}\n" SEA
static const char *const AZIMUTH = AZIMUTH_AT("9");

typedef struct pattern_case {
    const char *kind;
    double distance, width; /* in radii of corners */
    double speed;
    bool large;
    const char *ship; /* NULL: as it is large or small */
} pattern_case;
enum { SETS = 7 };
static const double STEP = 0.25;

static void open_case(scene *k, const pattern_case *c, double corner, const track_place *start)
{
    char key[SETS][80];
    const char *sets[SETS];
    for (int i = 0; i < SETS; i++)
        sets[i] = key[i];
    snprintf(key[0], sizeof *key, "vessel.propulsion.pattern.kind=%s", c->kind);
    snprintf(key[1], sizeof *key, "vessel.propulsion.pattern.distance=%.17g", c->distance * corner);
    snprintf(key[2], sizeof *key, "vessel.propulsion.pattern.width=%.17g", c->width * corner);
    snprintf(key[3], sizeof *key, "vessel.propulsion.speed=%g", c->speed);
    snprintf(key[4], sizeof *key, "vessel.x=%.17g", start->at.x);
    snprintf(key[5], sizeof *key, "vessel.y=%.17g", start->at.y);
    snprintf(key[6], sizeof *key, "vessel.heading_deg=%.17g", start->heading * 180 / PI);
    scene_open_with(k, c->ship ? c->ship : c->large ? LARGE : SMALL, sets, SETS);
}

/* The ship where its pattern begins. */
static void open_on_track(scene *k, const pattern_case *c)
{
    const track_place nowhere = {.at = {0, 0}};
    open_case(k, c, 100, &nowhere);
    double corner = k->w.propulsion.settings[0].turning.corner;
    pattern_shape shape = {(pattern_kind)k->w.propulsion.pattern[0], c->distance * corner, c->width * corner, 0};
    scene_close(k);
    track sailed = track_of_pattern(&shape, corner);
    track_place start = track_at(&sailed, 0);
    open_case(k, c, corner, &start);
    k->m.boundary = DOMAIN_FEEDING; /* no ice: only the drift that the pattern turns with */
    k->m.drift_given = true;
}

/* The drift turns by so many degrees within half an hour. */
static vec2 drift_at(double time, double degrees)
{
    double angle = PI + degrees * PI / 180 * fmin(time / 1800, 1);
    return vec2_make(0.3 * real_cos(angle), 0.3 * real_sin(angle));
}

static void sail(scene *k, double from, double to, double degrees)
{
    for (double time = from; time < to; time += STEP) {
        k->m.drift = drift_at(time, degrees);
        scene_steps(k, 1);
    }
}

/* Round its pattern, the drift turning for as long as it does: within the ship's breadth where it is at work,
   loops and rounded corners left out, and within half of it in the mean; a current along the
   x axis carries it too. */
static void check_kept(const pattern_case *c, double degrees, double current)
{
    scene k;
    open_on_track(&k, c);
    scene_tell(&k, INPUT_CURRENT, -current, 0);
    propulsion_table *p = &k.w.propulsion;
    sail(&k, 0, 200, degrees); /* gathers way */
    p->off_most[0] = p->off_square[0] = p->off_time[0] = 0;
    const propulsion_settings *s = &p->settings[0];
    pattern_shape shape = {(pattern_kind)p->pattern[0], s->distance, s->width, 0};
    double round = track_of_pattern(&shape, s->turning.corner).length / c->speed;
    sail(&k, 200, 200 + 1.4 * round, degrees);
    double breadth = c->large ? 25 : 14, rms = sqrt(p->off_square[0] / fmax(p->off_time[0], 1e-9));
    printf("%s, %s hull, %g m/s, drift turns by %g deg, current %g m/s: %.1f m at most, %.1f m rms, %.2f of the time\n",
           c->kind, c->large ? "large" : "small", c->speed, degrees, current, p->off_most[0], rms,
           p->off_time[0] / (1.4 * round));
    ck_assert_msg(p->off_most[0] < breadth, "%s: %g m off the track", c->kind, p->off_most[0]);
    ck_assert_msg(rms < 0.5 * breadth, "%s: %g m rms", c->kind, rms);
    ck_assert_int_ge(p->rounds[0], 1);
    ck_assert(p->off_time[0] > 0.2 * round);
    scene_close(&k);
}

static const pattern_case CASES[] = {{"circle", 3, 2, 4, true, NULL}, {"circle", 3, 1.6, 3, false, NULL},
                                     {"square", 4, 5, 3, true, NULL}, {"square", 4, 4, 5, false, NULL},
                                     {"line", 1, 4, 5, true, NULL},   {"line", 2, 4, 3, false, NULL},
                                     {"across", 3, 4, 3, true, NULL}, {"across", 3, 4, 5, false, NULL},
                                     {"sector", 5, 4, 4, true, NULL}, {"sector", 5, 4, 3, false, NULL}};

static size_t case_count(void) { return getenv("FRAM_TEST_SHORT") ? 2 : sizeof CASES / sizeof *CASES; }

/* Units whose thrust turns by 60 degrees within 24 s. */
START_TEST(a_slow_helm_keeps_its_pattern)
{
    static const pattern_case slow[] = {
        {"square", 4, 5, 4, false, SMALL_WITH(", rudder_area: 0, steering_angle_deg: 60, steering_rate_deg: 2.5")},
        {"square", 4, 5, 4, true, AZIMUTH_AT("2.5")}};
    for (size_t i = 0; i < (getenv("FRAM_TEST_SHORT") ? 1 : sizeof slow / sizeof *slow); i++)
        check_kept(&slow[i], 0, 0);
}
END_TEST

START_TEST(patterns_are_kept)
{
    for (size_t i = 0; i < case_count(); i++)
        check_kept(&CASES[i], 0, 0);
}
END_TEST

/* In water that goes with the drift, or twice as fast, a ship lies askew on every curve. */
START_TEST(patterns_are_kept_in_a_current)
{
    for (size_t i = 0; i < case_count(); i++)
        check_kept(&CASES[i], 0, i % 3 ? 0.3 : 0.6);
}
END_TEST

/* So fast that the far side of the pattern goes aside at up to a seventh of the ship's speed: more of it leaves no room
   to turn where ship and pattern go against one another. */
START_TEST(patterns_are_kept_as_the_drift_turns)
{
    for (size_t i = 0; i < case_count(); i++)
        check_kept(&CASES[i], i % 2 ? 20 : -20, 0);
}
END_TEST

/* The circle of the ready scenes, whose drift turns by 60 degrees; it is hardly wider than the ship can turn. */
START_TEST(the_ready_circle_is_kept)
{
    pattern_case ready = {"circle", 420, 300, 4, true, NULL};
    const track_place start = {.at = {570, 0}, .heading = 0.5 * PI};
    scene k;
    open_case(&k, &ready, 1, &start);
    ck_assert(k.w.propulsion.settings[0].turning.radius < 150);
    k.m.boundary = DOMAIN_FEEDING;
    k.m.drift_given = true;
    sail(&k, 0, 200, 60);
    k.w.propulsion.off_most[0] = 0;
    sail(&k, 200, 2400, 60);
    printf("ready circle: %.1f m at most\n", k.w.propulsion.off_most[0]);
    ck_assert_msg(k.w.propulsion.off_most[0] < 25, "%g m off", k.w.propulsion.off_most[0]);
    ck_assert_int_ge(k.w.propulsion.rounds[0], 8);
    scene_close(&k);
}
END_TEST

/* A leg past a corner of 90 degrees: round it, and on the next leg within a breadth; mirrored it is the same to
 * rounding. */
START_TEST(legs_are_kept_and_mirrored)
{
    vec2 end[2];
    for (int side = 0; side < 2; side++) {
        static const char *const legs[] = {LARGE_WITH(", waypoints: [{x: 1500, y: 0}, {x: 1500, y: 100000}]"),
                                           LARGE_WITH(", waypoints: [{x: 1500, y: 0}, {x: 1500, y: -100000}]")};
        static const char *const sets[] = {"vessel.propulsion.speed=4", "vessel.speed=4"};
        scene k;
        scene_open_with(&k, legs[side], sets, 2);
        double worst = 0, straight = 0;
        for (int i = 0; i < 3600; i++) {
            scene_steps(&k, 1);
            vec3 r = k.w.bodies.position[k.w.vessels.body[0]];
            straight = r.x < 900 ? testing_larger(straight, fabs(r.y)) : straight;
            worst = fabs(r.y) > 700 ? testing_larger(worst, fabs(r.x - 1500)) : worst;
            end[side] = vec2_make(r.x, r.y);
        }
        printf("straight %.2g m off, after the corner %.1f m\n", straight, worst);
        ck_assert(straight < 0.1);
        ck_assert_msg(worst < 12.5 && fabs(end[side].y) > 900, "%g m off, at %g", worst, end[side].y);
        scene_close(&k);
    }
    assert_absolute(end[0].x, end[1].x, 1e-3);
    assert_absolute(end[0].y, -end[1].y, 1e-3);
}
END_TEST

/* A hull so broad that it turns on by itself: its corners are as wide as its helm stops its turn, and it keeps them.
   More helm than its rudders have use for in that turn makes them no wider. */
START_TEST(a_broad_hull_keeps_its_corner)
{
#define BROAD                                                                                 \
    "run: {duration: 400, time_step: 0.25, scale: 30}\n"                                      \
    "vessel:\n  mode: free\n  speed: 6.75\n"                                                  \
    "  hull: {form: icebreaker, length: 60, beam: 19, draught: 7, freeboard: 3}\n"            \
    "  hydrodynamics: {source: estimate}\n"                                                   \
    "  propulsion: {bollard_pull: 1.5e6, open_water_speed: 7.5, waypoints: [{x: 480, y: 0}, " \
    "{x: 480, y: -3000}]}\n"
    static const char *const ship[] = {BROAD SEA, BROAD SEA_AS_GIVEN, BROAD SEA};
    static const char *const sets[][2] = {{"vessel.propulsion.speed=5", "vessel.propulsion.steering_angle_deg=35"},
                                          {"vessel.propulsion.speed=5", "vessel.propulsion.steering_angle_deg=35"},
                                          {"vessel.propulsion.speed=5", "vessel.propulsion.steering_angle_deg=60"}};
    static const double radius[] = {254, 419, 258};
    for (int i = 0; i < 3; i++) {
        scene k;
        scene_open_with(&k, ship[i], sets[i], 2);
        const propulsion_settings *s = &k.w.propulsion.settings[0];
        ck_assert(turning_is_sought_no_further(&s->turning, &k.m.vessels.data[0]) == (i > 0));
        ck_assert(turning_goes_on(&k.ctx, &k.m, 0, s) == (i == 1));
        assert_relative(turning_checked_radius(&k.ctx, &k.m, 0, s), radius[i], 0.01);
        double worst = 0;
        for (double time = 0; time < 180; time += STEP) {
            scene_steps(&k, 1);
            worst = testing_larger(worst, fabs(k.w.propulsion.off[0]));
        }
        printf("60 by 19 m, corners of %.0f m: %.1f m off\n", s->turning.corner, worst);
        ck_assert_msg(worst < 9.5, "%g m off", worst);
        scene_close(&k);
    }
}
END_TEST

/* Out and back by two points 10 mm apart, which no ship can round one by one: she turns about. */
START_TEST(points_on_each_other_are_one)
{
    static const char *const sets[] = {"vessel.propulsion.speed=4", "vessel.speed=4"};
    scene k;
    scene_open_with(&k, SMALL_WITH(", waypoints: [{x: 100, y: 0}, {x: 100, y: 0.01}, {x: -900, y: 0.01}]"), sets, 2);
    ck_assert_int_eq(k.w.course.count, 2);
    scene_steps(&k, (int)(400 / STEP));
    vec3 r = k.w.bodies.position[k.w.vessels.body[0]];
    ck_assert_msg(r.x < 50 && fabs(r.y) < 7, "at (%g, %g)", r.x, r.y);
    scene_close(&k);
}
END_TEST

/* Bends to either side, much narrower than the ship can turn, on legs of about its length: it comes back from wide of
   them, and goes on along the last leg. */
START_TEST(bends_that_are_too_narrow_lead_no_ship_away)
{
    static const char *const sets[] = {"vessel.propulsion.speed=4", "vessel.speed=4"};
    scene k;
    scene_open_with(&k,
                    LARGE_WITH(", waypoints: [{x: 100, y: 0}, {x: 143.5, y: -72}, {x: 57.6, y: -98.9}, {x: 170.8, y: "
                               "-233.7}, {x: 318.5, y: -145.5}, {x: 385, y: -224.7}, {x: 4220.4, y: -1360.6}]"),
                    sets, 2);
    scene_steps(&k, (int)(800 / STEP));
    printf("after bends that are too narrow: leg %d, %.1f m off\n", (int)k.w.propulsion.leg[0], k.w.propulsion.off[0]);
    ck_assert_msg(fabs(k.w.propulsion.off[0]) < 300, "%g m off", k.w.propulsion.off[0]);
    scene_close(&k);
}
END_TEST

/* Three rounds of a square of way points, begun amidst a side: how far off the ship is at most in the last of them,
   and of how wide a circle, in sides, it stays beside. */
static double worst_on_square(double side, double *round)
{
    char text[2000], legs[800];
    const double half = 0.5 * side, x[] = {half, half, -half, -half}, y[] = {0, side, side, 0};
    int length = 0;
    for (int i = 0; i < 12; i++)
        length += snprintf(legs + length, sizeof legs - (size_t)length, "%s{x: %.6f, y: %.6f}", i ? ", " : "", x[i % 4],
                           y[i % 4]);
    snprintf(text, sizeof text, SMALL_WITH(", speed: 4, waypoints: [%s]"), legs);
    static const char *const sets[] = {"vessel.speed=4"};
    scene k;
    scene_open_with(&k, text, sets, 1);
    double worst = 0, nearest = HUGE_VAL, farthest = 0;
    for (double time = 0; time < 8 * side / 4; time += STEP) {
        scene_steps(&k, 1);
        vec3 r = k.w.bodies.position[k.w.vessels.body[0]];
        if (time < 6 * side / 4)
            continue;
        double away = vec2_length(vec2_make(r.x, r.y - half));
        worst = fmax(worst, fabs(k.w.propulsion.off[0]));
        nearest = fmin(nearest, away);
        farthest = fmax(farthest, away);
    }
    *round = fmax(half - nearest, farthest - half);
    scene_close(&k);
    return worst;
}

/* A round of way points on a circle, with so many of them: how far beside it the ship is at most. */
static double worst_on_ring(double radius, int legs)
{
    char text[12000], points[11000];
    int length = 0;
    for (int i = 1; i <= legs; i++)
        length += snprintf(points + length, sizeof points - (size_t)length, "%s{x: %.6f, y: %.6f}", i > 1 ? ", " : "",
                           radius * sin(2 * PI * i / legs), radius - radius * cos(2 * PI * i / legs));
    snprintf(text, sizeof text, SMALL_WITH(", speed: 4, waypoints: [%s]"), points);
    static const char *const sets[] = {"vessel.speed=4"};
    scene k;
    scene_open_with(&k, text, sets, 1);
    double worst = 0;
    for (double time = 0; time < 0.9 * 2 * PI * radius / 4; time += STEP) {
        scene_steps(&k, 1);
        vec3 r = k.w.bodies.position[k.w.vessels.body[0]];
        if (time > 0.3 * 2 * PI * radius / 4)
            worst = fmax(worst, fabs(vec2_length(vec2_make(r.x, r.y - radius)) - radius));
    }
    scene_close(&k);
    return worst;
}

/* Corners of way points are known before the leg that leads to them, as those of a pattern are, however many of them
   lie as far ahead as the ship's helm looks: where its legs are so short that nothing straight is left of them a square
   is gone round as a circle within it, and where they are longer it is kept. */
START_TEST(a_square_of_way_points_is_kept_as_a_pattern)
{
    const pattern_case any = {"square", 4, 5, 4, false, NULL};
    const track_place nowhere = {.at = {0, 0}};
    scene k;
    open_case(&k, &any, 100, &nowhere);
    double corner = k.w.propulsion.settings[0].turning.corner, round;
    scene_close(&k);
    double narrow = worst_on_square(1.5 * corner, &round);
    printf("squares of way points, corners of %.0f m: %.1f m off and %.1f off the circle, ", corner, narrow, round);
    ck_assert_msg(narrow < 3.5 && round < 3.5, "%g m off its track, %g m off the circle", narrow, round);
    double wide = worst_on_square(2.2 * corner, &round);
    printf("%.1f m off where more is straight\n", wide);
    ck_assert_msg(wide < 7, "%g m", wide);
    double dense = worst_on_ring(3 * corner, 270);
    printf("a ring of 270 way points: %.1f m beside it\n", dense);
    ck_assert_msg(dense < 5, "%g m", dense);
}
END_TEST

/* On a circle much narrower than it can turn, joined from far away, a ship goes round at about its own radius. */
START_TEST(a_ship_goes_round_what_is_too_narrow)
{
    const pattern_case narrow = {"circle", 1, 20, 4, false, NULL};
    const track_place start = {.at = {-300, 0}};
    scene k;
    open_case(&k, &narrow, 1, &start);
    double radius = k.w.propulsion.settings[0].turning.radius, nearest = HUGE_VAL, farthest = 0;
    scene_steps(&k, (int)(350 / STEP));
    for (int i = 0; i < (int)(200 / STEP); i++) {
        scene_steps(&k, 1);
        vec3 r = k.w.bodies.position[k.w.vessels.body[0]];
        double away = vec2_length(vec2_make(r.x - 1, r.y));
        nearest = fmin(nearest, away);
        farthest = fmax(farthest, away);
    }
    printf("on a circle of 20 m: %.0f to %.0f m from its centre, turning on %.0f m; %d rounds\n", nearest, farthest,
           radius, (int)k.w.propulsion.rounds[0]);
    ck_assert(nearest > 0.4 * radius && farthest < 1.6 * radius);
    ck_assert_int_ge(k.w.propulsion.rounds[0], 3);
    scene_close(&k);
}
END_TEST

/* Linear damping of sway and turn, as if it were given. */
static void give_damping(scene *k, double sway, double yaw)
{
    matrix6 *damping = &k->m.vessels.data[0].hydrodynamics.damping;
    propulsion_settings *s = &k->w.propulsion.settings[0];
    damping->m[1][1] = sway;
    damping->m[5][5] = yaw;
    s->turning = turning_ability_of(&k->ctx, &k->m, 0, s, s->turning.speed);
}

/* A table of the current, as if it were given: the cross flow on a ship's side, and a moment that turns it abeam. */
static void give_table(scene *k)
{
    propulsion_settings *s = &k->w.propulsion.settings[0];
    vessel_model *hull = &k->m.vessels.data[0];
    hull->flows.water = (flow_table){
        .count = 5,
        .angle = {0, PI / 4, PI / 2, 3 * PI / 4, PI},
        .coefficient = {{0.05, 0, 0}, {0, 0.4, -0.06}, {0, 0.7, 0}, {0, 0.4, 0.06}, {-0.05, 0, 0}},
        .frontal = hull->particulars.beam * hull->particulars.draught,
        .lateral = hull->particulars.length * hull->particulars.draught,
        .length = hull->particulars.length,
    };
    hull->hydrodynamics.measured = true;
    s->ship.whole.y_v = s->ship.whole.n_v = 0;
    s->turning = turning_ability_of(&k->ctx, &k->m, 0, s, s->turning.speed);
}

/* The autopilot takes the damping of a turn for what it is, not for a moment from outside. */
static void check_seen(scene *k, double yaw)
{
    double seen = 0, damps = 0;
    const vec3 *turn = &k->w.bodies.angular_velocity[k->w.vessels.body[0]];
    k->w.propulsion.seen[0] = (motion_observer){.rate = turn->z};
    for (int i = 0; i < 400; i++) {
        sail(k, 0, STEP, 0);
        seen += fabs(k->w.propulsion.seen[0].moment);
        damps += yaw * fabs(turn->z);
    }
    printf("a moment of %g N m is seen, %g of damping\n", seen / 400, damps / 400);
    ck_assert(seen < 0.3 * damps);
}

/* The radius that is told is the one on which the ship turns in the end, to either side, by a table of the current, and
   with damping. */
START_TEST(turns_as_it_is_told)
{
    static const pattern_case any = {"circle", 3, 2, 4, true, NULL};
    static const double damping[3][2] = {{0, 0}, {0, 0}, {3e5, 4e8}};
    for (int i = 0; i < 3; i++) {
        int side = i % 2 ? 1 : -1;
        scene k;
        open_on_track(&k, &any);
        give_damping(&k, damping[i][0], damping[i][1]);
        if (i == 1)
            give_table(&k);
        propulsion_settings *s = &k.w.propulsion.settings[0];
        double rate = s->steering_rate;
        s->steering_rate = 1e-12;
        k.w.propulsion.steering[0] = side * s->steering_most;
        sail(&k, 0, 1200, 0);
        int32_t body = k.w.vessels.body[0];
        vec3 v = k.w.bodies.velocity[body];
        double radius = sqrt(v.x * v.x + v.y * v.y) / k.w.bodies.angular_velocity[body].z;
        printf("turns on %.1f m, told %.1f m; corners %.0f m\n", radius, s->turning.radius, s->turning.corner);
        assert_relative(side * radius, s->turning.radius, 0.05);
        s->steering_rate = rate;
        if (damping[i][1] > 0)
            check_seen(&k, damping[i][1]);
        scene_close(&k);
    }
}
END_TEST

/* Half the helm, and a tenth of the time for a length, where that is less than for the helm. */
START_TEST(slow_ships_are_steered_as_quickly_as_their_helm)
{
    const turning_ability slow = {.speed = 0.2};
    double most = radians(60), rate = radians(9), helm = 0.5 * most / rate;
    assert_relative(autopilot_lag(&slow, 104, 4, most, rate), helm + 10.4 / 4, 1e-12);
    assert_relative(autopilot_lag(&slow, 104, 0.5, most, rate), 2 * helm, 1e-12);
    assert_relative(autopilot_lag(&slow, 104, 0, most, rate), 2 * helm, 1e-12);
}
END_TEST

/* A drift of 0.3 m/s that turns by 60 degrees from 600 to 2400 s, and a current that goes with it. */
enum { DRIFT_ROWS = 61 };
static double drift_time[DRIFT_ROWS];
static vec3 drift_velocity[DRIFT_ROWS];

static void turn_the_drift(scene *k)
{
    for (int i = 0; i < DRIFT_ROWS; i++) {
        drift_time[i] = 600 + 30 * i;
        vec2 drift = drift_at(30.0 * i, 60);
        drift_velocity[i] = vec3_make(drift.x, drift.y, 0);
    }
    k->m.boundary = DOMAIN_FEEDING;
    k->m.history.drift = k->m.history.current = (velocity_series){DRIFT_ROWS, drift_time, drift_velocity};
}

static void close_turning(scene *k)
{
    k->m.history.drift = k->m.history.current = (velocity_series){0};
    scene_close(k);
}

static vec2 plane_place(const scene *k)
{
    vec3 r = k->w.bodies.position[k->w.vessels.body[0]];
    return vec2_make(r.x, r.y);
}

/* How far to port of its drift the ice goes by the origin that is at a place at a time, all that comes until `until`;
   NAN: it does not come by then. */
static double passes_at(const scene *k, vec2 at, double time, double until)
{
    for (; time < until; time += STEP) {
        vec2 drift = feed_drift(&k->m, &k->w.inputs, time);
        if (vec2_dot(at, drift) > 0)
            return vec2_cross(drift, at) / vec2_length(drift);
        at = vec2_add(at, vec2_scale(drift, STEP));
    }
    return NAN;
}

/* The way ahead while the drift turns: the ice that the ship went through passes the place by how far it is aside,
   wherever the drift has turned to by then.  Without the forecast it does not. */
static double worst_pass(const char *forecast, double aside)
{
    enum { MARKS = 100 };
    char asides[60], y[30];
    const char *sets[] = {"vessel.propulsion.pattern.kind=ahead",
                          asides,
                          forecast,
                          "vessel.x=180",
                          y,
                          "vessel.propulsion.speed=0.2",
                          "vessel.speed=0.2",
                          "vessel.propulsion.lookahead=100"};
    snprintf(asides, sizeof asides, "vessel.propulsion.pattern.aside=%g", aside);
    snprintf(y, sizeof y, "vessel.y=%g", aside);
    scene k;
    scene_open_with(&k, AZIMUTH, sets, sizeof sets / sizeof *sets);
    turn_the_drift(&k);
    double worst = 0;
    for (int mark = 0; mark < MARKS; mark++) {
        double time = 24.0 * mark, passes = passes_at(&k, plane_place(&k), time, 9000);
        ck_assert(isfinite(passes));
        worst = testing_larger(worst, fabs(passes + aside));
        scene_steps(&k, 96);
    }
    printf("ahead, %g m aside, %s: passes wrong by %.1f m at most\n", aside, forecast, worst);
    close_turning(&k);
    return worst;
}

START_TEST(ahead_is_where_ice_comes_from)
{
    ck_assert(worst_pass("vessel.propulsion.pattern.forecast=true", 0) < 8);
    ck_assert(worst_pass("vessel.propulsion.pattern.forecast=true", 10) < 8);
    ck_assert(worst_pass("vessel.propulsion.pattern.forecast=true", -10) < 7);
    ck_assert(worst_pass("vessel.propulsion.pattern.forecast=false", 0) > 40);
}
END_TEST

/* A ship that begins 15 m beside its leg; how far off it is after 20, 40, ... s. */
enum { MOMENTS = 20 };
static void come_back(double speed, double current, double *off)
{
    char demanded[60], begins[40], flows[60];
    const char *sets[] = {demanded,      begins,
                          flows,         "environment.current_direction_deg=180",
                          "vessel.y=15", "vessel.propulsion.lookahead=100"};
    snprintf(demanded, sizeof demanded, "vessel.propulsion.speed=%g", speed);
    snprintf(begins, sizeof begins, "vessel.speed=%g", speed);
    snprintf(flows, sizeof flows, "environment.current_speed=%g", fabs(current));
    sets[3] = current < 0 ? "environment.current_direction_deg=0" : sets[3];
    scene k;
    scene_open_with(&k, LARGE_WITH(", waypoints: [{x: 9000, y: 0}]"), sets, sizeof sets / sizeof *sets);
    k.w.propulsion.from[0] = vec2_make(0, 0);
    for (int i = 0; i < MOMENTS; i++) {
        scene_steps(&k, (int)(20 / STEP));
        off[i] = plane_place(&k).y;
    }
    scene_close(&k);
}

/* Galileo: against or with a current it comes back to its leg in the time that it takes in still water, but for how
   quickly its helm comes over, which it reckons with at the speed that is demanded. */
START_TEST(a_leg_along_a_current_is_kept_as_in_still_water)
{
    double still[MOMENTS], against[MOMENTS], with[MOMENTS];
    come_back(1.5, 0, still);
    come_back(0.5, 1, against);
    come_back(2.5, -1, with);
    ck_assert(fabs(still[MOMENTS - 1]) < 1 && still[3] > 3);
    for (int i = 0; i < MOMENTS; i++)
        ck_assert_msg(fabs(against[i] - still[i]) < 0.15 && fabs(with[i] - still[i]) < 0.15,
                      "after %d s %g m in still water, %g against and %g with a current", 20 * (i + 1), still[i],
                      against[i], with[i]);
}
END_TEST

/* The hull of 60 m whose form is not given, beside a circle of 300 m and heading against it: whatever the drag of its
   side it comes about, and is on its track when it heads along. */
START_TEST(a_circle_is_not_sailed_against_its_sense)
{
#define AGAINST_SHIP                                                                  \
    "run: {duration: 9000, time_step: 0.25, scale: 30}\n"                             \
    "vessel:\n  mode: free\n  speed: 3\n  hull: {length: 60, beam: 14, draught: 5}\n" \
    "  hydrodynamics: {source: estimate}\n  propulsion: {bollard_pull: 8.0e5, open_water_speed: 8}\n"
    static const char *const ship[] = {AGAINST_SHIP SEA, AGAINST_SHIP SEA_AS_GIVEN};
    static const double away[] = {178, 150}, at[] = {125, 270};
    for (int i = 0; i < (getenv("FRAM_TEST_SHORT") ? 1 : 2); i++) {
        double turn = radians(at[i]), course = i == 0 ? 0 : PI;
        const pattern_case circle = {"circle", 800, 300, 3, false, ship[i]};
        const track_place start = {.at = {800 + away[i] * real_cos(turn), away[i] * real_sin(turn)}, .heading = course};
        scene k;
        open_case(&k, &circle, 1, &start);
        k.m.boundary = DOMAIN_FEEDING;
        k.m.drift_given = true;
        const propulsion_table *p = &k.w.propulsion;
        sail(&k, 0, 1, 0);
        ck_assert_msg(p->off_time[0] == 0, "on its track, heading against it");
        sail(&k, 1, 700, 0);
        printf("against the circle at first: %d rounds in %g s on it, %.1f m off\n", (int)p->rounds[0], p->off_time[0],
               p->off[0]);
        ck_assert(p->off_time[0] > 300);
        ck_assert_int_ge(p->rounds[0], 1);
        scene_close(&k);
    }
}
END_TEST

/* The place where a ship joins is where its rounds begin: nothing is one before it has been all the way, wherever on
   the pattern that is, and the seam of the track is no round. */
START_TEST(rounds_begin_where_the_ship_joined)
{
    static const char *const sets[] = {"vessel.propulsion.pattern.kind=circle",
                                       "vessel.propulsion.pattern.distance=400",
                                       "vessel.propulsion.pattern.width=400",
                                       "vessel.propulsion.speed=4",
                                       "vessel.speed=4",
                                       "vessel.x=400",
                                       "vessel.y=-195",
                                       "vessel.heading_deg=20"};
    scene k;
    scene_open_with(&k, AZIMUTH, sets, sizeof sets / sizeof *sets);
    k.m.boundary = DOMAIN_FEEDING;
    k.m.drift_given = true;
    k.m.drift = drift_at(0, 0);
    const propulsion_table *p = &k.w.propulsion;
    double way = 0, last = -1, seam = 0, round = 400 * PI;
    while (way < 1.2 * round) {
        scene_steps(&k, 1);
        way += STEP * vec3_length(k.w.bodies.velocity[k.w.vessels.body[0]]);
        if (seam == 0 && last >= 0 && p->way[0] < last - 0.5 * round)
            seam = way;
        last = p->way[0];
        ck_assert_msg(p->rounds[0] == (p->rounds[0] > 0) && (p->rounds[0] == 0 || way > 0.95 * round), "%d after %g m",
                      (int)p->rounds[0], way);
    }
    /* It came to the seam in the middle of a round. */
    ck_assert_msg(seam > 0.1 * round && seam < 0.9 * round, "%g m", seam);
    ck_assert_int_eq(p->rounds[0], 1);
    /* A drift that turns about at once takes the pattern along, which is no way round it. */
    for (int turn = 1; turn <= 24; turn++) {
        k.m.drift = vec2_make(0.3 * real_cos(2.5 * turn), 0.3 * real_sin(2.5 * turn));
        scene_steps(&k, 1);
        ck_assert_msg(p->rounds[0] == 1, "%d rounds as the drift turns about", (int)p->rounds[0]);
    }
    scene_close(&k);
}
END_TEST

/* The speed by which a round takes its period is that at which the ship turns as it was found to. */
START_TEST(a_period_is_that_of_the_round_that_is_sailed)
{
    static const char *const kinds[] = {"sector", "line", "across", "square", "circle"};
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++) {
        char kind[60];
        const char *sets[] = {kind, "vessel.propulsion.pattern.distance=500", "vessel.propulsion.pattern.width=500",
                              "vessel.propulsion.pattern.period=500"};
        snprintf(kind, sizeof kind, "vessel.propulsion.pattern.kind=%s", kinds[i]);
        scene k;
        scene_open_with(&k, SMALL, sets, sizeof sets / sizeof *sets);
        const propulsion_settings *s = &k.w.propulsion.settings[0];
        pattern_shape shape = {(pattern_kind)k.w.propulsion.pattern[0], s->distance, s->width, 0};
        double round = track_of_pattern(&shape, s->turning.corner).length;
        assert_relative(s->speed * 500, round, 1e-12);
        assert_relative(s->turning.speed, fmin(s->speed, s->open_water_speed), 2e-3);
        scene_close(&k);
    }
}
END_TEST

/* A pattern that goes round points to the ice that comes from its own distance. */
START_TEST(a_circle_points_to_the_ice_that_comes)
{
    static const char *const sets[] = {
        "vessel.propulsion.pattern.kind=circle", "vessel.propulsion.pattern.distance=400",
        "vessel.propulsion.pattern.forecast=true", "vessel.x=600", "vessel.heading_deg=90"};
    scene k;
    scene_open_with(&k, AZIMUTH, sets, sizeof sets / sizeof *sets);
    turn_the_drift(&k);
    scene_steps(&k, 1);
    vec2 from = feed_origin(&k.m, &k.w.inputs, k.w.clock.time[0] - STEP, 400, true).at;
    ck_assert_msg(from.y > 20, "%g", from.y);
    assert_absolute(k.w.propulsion.axis[0], real_atan2(from.y, from.x), 1e-3);
    close_turning(&k);
}
END_TEST

/* Ice that comes on an arc: in a drift that turns at a steady rate it is on a chord of its circle. */
START_TEST(ice_comes_along_its_arc)
{
    scene k;
    scene_open_with(&k, AZIMUTH, NULL, 0);
    turn_the_drift(&k);
    const double rate = PI / 3 / 1800, radius = 0.3 / rate;
    track_place from = feed_origin(&k.m, &k.w.inputs, 0, 150, true), none = feed_origin(&k.m, &k.w.inputs, 0, 0, true);
    assert_absolute(from.at.x, 150, 1e-9);
    assert_absolute(from.at.y, 0, 1e-9);
    assert_absolute(from.heading, 0, 1e-9);
    ck_assert(from.curvature == 0 && none.at.x == 0 && none.at.y == 0);
    for (double distance = 50; distance < 500; distance += 50) {
        /* Half the angle by which it turns on the way. */
        double half = asin(0.5 * distance / radius);
        from = feed_origin(&k.m, &k.w.inputs, 700, distance, true);
        assert_absolute(vec2_length(from.at), distance, 1e-4 * distance);
        assert_absolute(real_atan2(from.at.y, from.at.x), rate * 100 + half, 3e-4);
        assert_absolute(from.heading, rate * 100 + 2 * half, 1e-3);
        assert_relative(from.curvature, 1 / radius, 0.02);
    }
    from = feed_origin(&k.m, &k.w.inputs, 2400, 200, false);
    assert_absolute(from.at.x, 100, 1e-6);
    assert_absolute(from.at.y, 100 * sqrt(3), 1e-6);
    ck_assert(from.curvature == 0);
    /* A drift that turns about brings nothing from farther than it goes. */
    vec3 about[] = {{-0.5, 0, 0}, {0.5, 0, 0}};
    double times[] = {0, 400};
    k.m.history.drift = (velocity_series){2, times, about};
    from = feed_origin(&k.m, &k.w.inputs, 0, 20, true);
    assert_absolute(from.at.x, 20, 0.02);
    from = feed_origin(&k.m, &k.w.inputs, 0, 1000, true);
    about[1] = vec3_make(0, 0, 0);
    track_place dies = feed_origin(&k.m, &k.w.inputs, 0, 1000, true);
    assert_absolute(dies.at.x, 100, 5);
    ck_assert(dies.heading == 0 && dies.curvature == 0);
    about[0] = about[1] = vec3_make(1e-310, 0, 0);
    track_place still = feed_origin(&k.m, &k.w.inputs, 0, 1000, true);
    ck_assert(still.at.x == 0 && still.at.y == 0);
    ck_assert_msg(from.at.x < 0 || vec2_length(from.at) < 51, "%g %g", from.at.x, from.at.y);
    close_turning(&k);
}
END_TEST

/* The ship of the ready scenes at a length, in a wind aside. */
static void open_at_size(scene *k, double size)
{
    char text[1000];
    double mass = size * size * size, speed = sqrt(size);
    snprintf(text, sizeof text,
             "run: {duration: 9000, time_step: %.17g, scale: %.17g}\n"
             "vessel:\n  mode: free\n  mass: %.17g\n  speed: %.17g\n"
             "  hull: {form: icebreaker, length: %.17g, beam: %.17g, draught: %.17g, freeboard: %.17g}\n"
             "  propulsion: {bollard_pull: %.17g, open_water_speed: %.17g, speed: %.17g,\n"
             "               waypoints: [{x: %.17g, y: 0}]}\n"
             "ice: {source: none}\n"
             "domain: {x_min: -1000, x_max: 1000, y_min: -1000, y_max: 1000, boundary: open}\n"
             "environment: {hull_drag: {water_form: 1}, wind_speed: %.17g, wind_direction_deg: 90}\n",
             STEP * speed, 30 * size, 1.49e7 * mass, speed, 121 * size, 25 * size, 8.75 * size, 5 * size, 2.5e6 * mass,
             8.5 * speed, speed, 900 * size, 7 * speed);
    scene_open(k, text);
}

/* A model in a tank is steered as the ship is, also where its speed is less than that at which a ship has a course. */
START_TEST(a_model_is_steered_as_its_ship)
{
    enum { SECONDS = 400 };
    scene ship, tank;
    open_at_size(&ship, 1);
    open_at_size(&tank, 0.0625);
    scene_steps(&ship, (int64_t)(SECONDS / STEP));
    scene_steps(&tank, (int64_t)(SECONDS / STEP));
    vec3 at = ship.w.bodies.position[ship.w.vessels.body[0]], as = tank.w.bodies.position[tank.w.vessels.body[0]];
    ck_assert(fabs(at.y) > 0.1);
    assert_relative(as.x, 0.0625 * at.x, 1e-12);
    assert_relative(as.y, 0.0625 * at.y, 1e-9);
    scene_close(&ship);
    scene_close(&tank);
}
END_TEST

TEST_MAIN("track_keeping", patterns_are_kept, a_slow_helm_keeps_its_pattern, patterns_are_kept_as_the_drift_turns,
          patterns_are_kept_in_a_current, the_ready_circle_is_kept, legs_are_kept_and_mirrored,
          a_broad_hull_keeps_its_corner, points_on_each_other_are_one, bends_that_are_too_narrow_lead_no_ship_away,
          a_square_of_way_points_is_kept_as_a_pattern, a_ship_goes_round_what_is_too_narrow, turns_as_it_is_told,
          slow_ships_are_steered_as_quickly_as_their_helm, ahead_is_where_ice_comes_from,
          a_circle_is_not_sailed_against_its_sense, rounds_begin_where_the_ship_joined,
          a_leg_along_a_current_is_kept_as_in_still_water, a_period_is_that_of_the_round_that_is_sailed,
          ice_comes_along_its_arc, a_circle_points_to_the_ice_that_comes, a_model_is_steered_as_its_ship)
