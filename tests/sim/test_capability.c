/* The capability plot of simple ships against balances by hand, and its loads. */
#include "base/channel_statistics.h"
#include "io/csv_read.h"
#include "scene.h"
#include "scratch.h"
#include "sim/capability.h"
#include "sim/ice_loads.h"
#include "sim/steady_load.h"

#include <stdlib.h>
#include <unistd.h>

/* A box whose only load is form drag of the current: 1/2 rho v^2 A with A = 12 x 4 m ahead, 60 x 4 m abeam. */
static const char box[] =
    "vessel:\n  mode: free\n  heading_deg: 30\n  hull: {form: box, length: 60, beam: 12, draught: 4, freeboard: 2}\n"
    "  thrusters:\n    - {kind: main, x: -25, thrust: 60.0e3, thrust_astern: 30.0e3}\n"
    "    - {kind: tunnel, x: 20, thrust: 50.0e3}\n    - {kind: tunnel, x: -20, thrust: 50.0e3}\n"
    "ice: {source: none}\n"
    "domain: {boundary: open}\n"
    "environment:\n  hull_drag: {water_form: 1, water_skin: 0, air_form: 0, air_skin: 0}\n";

static vec3 ice_at(const capability *c, int32_t direction, int32_t k)
{
    return c->loads.ice[capability_row(c, direction) * c->loads.speeds + k];
}

static const capability_options plain = {.directions = 8,
                                         .speed_step = 0.25,
                                         .speed_most = 3,
                                         .allowance = 1.25,
                                         .measure = 1,
                                         .line_safety = 2,
                                         .line_safety_damaged = 1.43};

static double speed_for(double force, double area) { return sqrt(force / (1.25 * 0.5 * 1025 * area)); }

static void find_in(scene *k, const char *text, const char *const *overrides, int count, const capability_options *o,
                    capability *c)
{
    fram_error error = {0};
    scene_open_with(k, text, overrides, count);
    assert_ok(capability_find(&k->ctx, &k->s, o, c, &error), error);
}

static void close_found(scene *k, capability *c)
{
    capability_free(&k->ctx, c);
    scene_close(k);
}

START_TEST(limits_by_hand)
{
    scene k;
    capability c;
    find_in(&k, box, NULL, 0, &plain, &c);
    assert_relative(c.intact[0].speed, speed_for(60e3, 48), 2e-3);
    assert_relative(c.intact[4].speed, speed_for(30e3, 48), 2e-3);
    assert_relative(c.intact[2].speed, speed_for(100e3, 240), 2e-3);
    assert_relative(c.intact[6].speed, speed_for(100e3, 240), 2e-3);
    ck_assert_int_eq(c.intact[0].at.item, HOLDING_THRUSTER);
    ck_assert_int_eq(c.intact[0].at.number, 0);
    /* A quarter: both components must be held; drag is by the component on each face. */
    ck_assert(c.intact[1].speed > c.intact[2].speed && !c.intact[1].beyond);
    assert_relative(c.intact[1].speed, sqrt(2.0) * speed_for(100e3, 240), 2e-3);
    ck_assert_int_eq(c.failures, 3);
    ck_assert(c.damaged[0].speed < 1e-3 && c.damaged[0].failure == 0);
    ck_assert(c.damaged[2].speed < 1e-3 && c.damaged[2].failure >= 1);
    /* Use grows with the square of the speed; ring 1 of direction 0 is 0.5 m/s. */
    double share = 0.25 / (speed_for(60e3, 48) * speed_for(60e3, 48));
    assert_relative(c.use[1].use, share, 2e-3);
    close_found(&k, &c);
}
END_TEST

/* By hand, without a moment.  A weak bow azimuth gives half of the sway at most.  Of two ruddered propellers one pulls
   astern and the other one steers: with the tunnel at its limit F, their arms a and 5 m, t the tangent of the rudder's
   angle and r surge over sway, x (a t + 10) = 32 F + 5 surge and sway = F + t x. */
START_TEST(limits_of_thrusters_that_turn)
{
    static const char ship[] =
        "vessel:\n  mode: free\n  hull: {form: box, length: 80, beam: 16, draught: 5}\n  thrusters:\n%s"
        "ice: {source: none}\ndomain: {boundary: open}\nenvironment: {hull_drag: {water_form: 1, water_skin: 0}}\n";
    static const char azimuths[] =
        "    - {kind: azimuth, x: 35, thrust: 5.0e4}\n    - {kind: azimuth, x: -35, thrust: 3.0e5}\n";
    static const char rudders[] =
        "    - {kind: main, x: -38, y: 5, thrust: 4.0e5, thrust_astern: 2.5e5, rudder_deg: 35}\n"
        "    - {kind: main, x: -38, y: -5, thrust: 4.0e5, thrust_astern: 2.5e5, rudder_deg: 35}\n"
        "    - {kind: tunnel, x: 32, thrust: 2.5e5}\n";
    char text[1000];
    scene k;
    capability c;
    capability_options o = plain;
    o.directions = 12;
    snprintf(text, sizeof text, ship, azimuths);
    find_in(&k, text, NULL, 0, &o, &c);
    assert_relative(c.intact[1].speed, speed_for(2 * 5e4, 400) / 0.5, 2e-3);
    close_found(&k, &c);
    snprintf(text, sizeof text, ship, rudders);
    find_in(&k, text, NULL, 0, &o, &c);
    double t = real_sin(radians(35)) / real_cos(radians(35)), share = t / (38 * t + 10), r = 80.0 / 400 / 3;
    double sway = (2.5e5 + share * 32 * 2.5e5) / (1 - share * 5 * r);
    assert_relative(c.intact[2].speed, speed_for(sway, 400) / real_sin(radians(60)), 2e-3);
    assert_relative(c.intact[10].speed, c.intact[2].speed, 1e-3);
    assert_relative(c.intact[3].speed, speed_for(2.5e5 + share * 32 * 2.5e5, 400), 2e-3);
    close_found(&k, &c);
}
END_TEST

/* Halfway between two directions and two speeds, around the bow, and beyond the ends of the table; the allowance is on
   mean loads alone. */
START_TEST(loads_between_directions_and_speeds)
{
    vec3 wind[4], damping[4], drag[4], ice[8];
    for (int i = 0; i < 4; i++) {
        wind[i] = vec3_make(1 + i, 0, 0);
        damping[i] = vec3_make(10 * (1 + i), 0, 0);
        drag[i] = vec3_make(100 * (1 + i), 0, 0);
        ice[2 * i] = vec3_make(1000 * (1 + i), 1, 0);
        ice[2 * i + 1] = vec3_make(3000 * (1 + i), 0, 1);
    }
    capability c = {.options = plain, .loads = {4, 2, 4, 0.5, wind, damping, drag, ice, .measured = 4}};
    vec3 sum = capability_load_at(&c, 0.25 * PI, 0.75);
    double mean = 1.25 * (1.5 + 15 * 0.75 + 150 * 0.75 * 0.75);
    assert_relative(sum.x, mean + 3000, 1e-12);
    assert_relative(sum.y, 0.5, 1e-12);
    assert_relative(sum.z, 0.5, 1e-12);
    /* Between ahead (1) and port (4), from either way round. */
    assert_relative(capability_load_at(&c, -0.25 * PI, 0).x, 1.25 * 2.5, 1e-12);
    assert_relative(capability_load_at(&c, 1.75 * PI, 0).x, 1.25 * 2.5, 1e-12);
    assert_relative(capability_load_at(&c, 0, 0.1).x, 1.25 * (1 + 10 * 0.1 + 100 * 0.01) + 1000, 1e-12);
    assert_relative(capability_load_at(&c, 0, 2).x, 1.25 * (1 + 10 * 2 + 100 * 4) + 3000, 1e-12);
    c.loads.measured = 0;
    assert_relative(capability_load_at(&c, 0.25 * PI, 0.75).x, mean + 1.25 * 3000, 1e-12);
}
END_TEST

/* The wind is the scenario's, from the side that the drift comes from; the damping that is given is of 1 m/s. */
START_TEST(loads_of_wind_and_damping)
{
    static const char *const blown[] = {"environment.wind_speed=20", "environment.wind_direction_deg=70",
                                        "environment.hull_drag.air_form=1", "environment.current_speed=0.7"};
    scene k;
    capability c;
    find_in(&k, box, blown, sizeof blown / sizeof *blown, &plain, &c);
    assert_relative(c.loads.wind[0].x, -0.5 * 1.225 * 400 * 24, 1e-3);
    assert_relative(c.loads.wind[capability_row(&c, 2)].y, 0.5 * 1.225 * 400 * 120, 1e-3);
    assert_relative(c.loads.drag[capability_row(&c, 2)].y, 0.5 * 1025 * 240, 1e-3);
    close_found(&k, &c);
}
END_TEST

/* In a current that changes with depth matrices meet that at half the draught, as in a run, wherever the centre of mass
   is. */
START_TEST(damping_in_a_current_of_depth)
{
    static const char *const height[] = {"vessel.centre_of_gravity_z=1", "vessel.centre_of_gravity_z=-3"};
    for (int i = 0; i < 2; i++) {
        scene k;
        scene_open_with(&k, box, &height[i], 1);
        vessel_model *hull = &k.m.vessels.data[0];
        hull->has_hydrodynamics = true;
        hull->hydrodynamics.damping = (matrix6){{{[0] = 1e5}, {[1] = 1e5}}};
        media now = k.m.media;
        now.profile = (current_profile){2, {0, 4}, {{0.6, 0.4, 0}, {0, 0, 0}}};
        vec3 load = steady_damping_load(&k.m, &k.w, 0, &now, radians(30));
        assert_vec3_close(load, vec3_make(0.3e5, 0.2e5, 0), 1e-6);
        scene_close(&k);
    }
}
END_TEST

/* Where there is no water there is neither current nor wind to hold against, as in a run. */
START_TEST(no_loads_without_water)
{
    static const char *const dry[] = {"environment.wind_speed=20", "environment.hull_drag.air_form=1",
                                      "environment.water=false", "vessel.hydrodynamics.source=estimate"};
    scene k;
    capability c;
    find_in(&k, box, dry, sizeof dry / sizeof *dry, &plain, &c);
    const vec3 none = {0, 0, 0};
    for (int i = 0; i < c.loads.rows; i++) {
        assert_vec3_close(c.loads.wind[i], none, 0);
        assert_vec3_close(c.loads.drag[i], none, 0);
        assert_vec3_close(c.loads.damping[i], none, 0);
    }
    for (int i = 0; i < plain.directions; i++) {
        ck_assert_msg(c.intact[i].beyond && c.intact[i].at.use < 1e-3, "use %g", c.intact[i].at.use);
    }
    close_found(&k, &c);
}
END_TEST

/* Thrusters that fail, and lines that are let go, at the start of a run hold nothing, nor are they what is lost. */
START_TEST(out_of_order_from_the_start)
{
    scene k;
    capability c;
    find_in(&k, box, (const char *const[]){"vessel.thrusters[1].failure_time=0"}, 1, &plain, &c);
    ck_assert_int_eq(c.failures, 2);
    ck_assert(c.failure[0].number == 0 && c.failure[1].number == 2);
    ck_assert(c.intact[2].speed < 1e-3 && c.intact[0].speed > 1);
    close_found(&k, &c);
    static const char moored[] =
        "vessel:\n  mode: free\n  hull: {form: box, length: 60, beam: 12, draught: 4, freeboard: 2}\n"
        "  mooring:\n    lines:\n"
        "      - {kind: spring, distance: 300, stiffness: 1.0e4, pretension: 1.0e5, breaking_load: 4.0e5,\n"
        "         fairlead_distance: 30, release_time: 0}\n"
        "      - {kind: spring, distance: 300, stiffness: 1.0e4, pretension: 1.0e5, breaking_load: 4.0e5,\n"
        "         fairlead_distance: 30, direction_deg: 180}\n"
        "ice: {source: none}\ndomain: {boundary: open}\n";
    find_in(&k, moored, NULL, 0, &plain, &c);
    ck_assert_int_eq(c.failures, 1);
    ck_assert(c.failure[0].line && c.failure[0].number == 1);
    close_found(&k, &c);
}
END_TEST

/* Four springs about a box, ahead, to port, astern and to starboard. */
#define SPRING(direction)                                                          \
    "      - {kind: spring, distance: 300, stiffness: 1.0e4, pretension: 1.0e5,\n" \
    "         breaking_load: 4.0e5, fairlead_distance: 5, direction_deg: " direction "}\n"
static const char sprung[] =
    "vessel:\n  mode: free\n"
    "  hull: {form: box, length: 60, beam: 12, draught: 4, freeboard: 2}\n"
    "  mooring:\n    lines:\n" SPRING("0") SPRING("90") SPRING("180")
        SPRING("270") "ice: {source: none}\ndomain: {boundary: open}\n"
                      "environment:\n  hull_drag: {water_form: 1, water_skin: 0, air_form: 0, air_skin: 0}\n";

static capability find_with(const char *const *overrides, int count, const capability_options *o)
{
    scene k;
    capability c;
    find_in(&k, sprung, overrides, count, o, &c);
    scene_close(&k);
    return c;
}

static void forget(capability *c)
{
    context ctx;
    context_init(&ctx);
    capability_free(&ctx, c);
}

/* After a failure the vessel is one that has lost the line from the start, with the factor for that. */
START_TEST(what_is_left_after_a_line)
{
    static const char *const lost[] = {
        "vessel.mooring.lines[0].release_time=0", "vessel.mooring.lines[1].release_time=0",
        "vessel.mooring.lines[2].release_time=0", "vessel.mooring.lines[3].release_time=0"};
    double least[8];
    capability_options o = plain;
    capability whole = find_with(NULL, 0, &o);
    o.line_safety = o.line_safety_damaged;
    for (int f = 0; f < 4; f++) {
        capability left = find_with(&lost[f], 1, &o);
        for (int i = 0; i < 8; i++)
            least[i] = f == 0 ? left.intact[i].speed : fmin(least[i], left.intact[i].speed);
        forget(&left);
    }
    ck_assert_int_eq(whole.damaged[2].failure, 3);
    ck_assert(whole.damaged[2].speed < whole.intact[2].speed && !whole.damaged[2].beyond);
    /* The worst of all four, though no other is looked for farther than it holds. */
    for (int i = 0; i < 8; i++)
        assert_relative(whole.damaged[i].speed, least[i], 1e-12);
    forget(&whole);
}
END_TEST

/* A ship that has lost a line turns: up to its limit, or on a turret not at all. */
START_TEST(ships_that_turn)
{
    static const char *const limit[] = {"vessel.station.heading_limit_deg=2"};
    static const char *const turret[] = {"vessel.mooring.turret=true"};
    capability held = find_with(limit, 1, &plain), free = find_with(turret, 1, &plain);
    ck_assert_int_eq(held.damaged[1].at.item, HOLDING_HEADING);
    assert_relative(degrees(held.damaged[1].at.turn), 2, 0.02);
    ck_assert_int_eq(free.damaged[1].at.item, HOLDING_LINE);
    assert_absolute(free.damaged[1].at.turn, 0, 1e-3);
    forget(&held);
    forget(&free);
}
END_TEST

/* The balance is that in which a run begins that asks for its equilibrium; the plot's own does not move with it. */
START_TEST(balances_are_those_of_a_run)
{
    /* At 1.25 m/s from 45 degrees to starboard, with the spring ahead cut down to next to nothing. */
    static const char *const asked[] = {"vessel.mooring.lines[0].stiffness=10", "vessel.mooring.lines[0].pretension=10",
                                        "vessel.mooring.equilibrium=true", "environment.current_speed=1.25",
                                        "environment.current_direction_deg=135"};
    capability_options o = plain;
    o.allowance = 1;
    o.speed_step = o.speed_most = 1.25;
    capability still = find_with(asked, 2, &o), moved = find_with(asked, 5, &o);
    const holding *at = &still.use[1];
    scene k;
    scene_open_with(&k, sprung, asked, 5);
    int32_t body = k.w.vessels.body[0];
    vec3 place = k.w.bodies.position[body];
    double turn = quat_roll_pitch_yaw(k.w.bodies.orientation[body]).z;
    ck_assert(fabs(turn) > 0.01);
    assert_relative(at->turn, fabs(turn), 1e-3);
    assert_relative(at->offset, sqrt(place.x * place.x + place.y * place.y), 1e-3);
    for (int32_t i = 0; i < still.loads.directions * still.loads.speeds; i++)
        assert_absolute(moved.use[i].offset, still.use[i].offset, 0);
    scene_close(&k);
    forget(&still);
    forget(&moved);
}
END_TEST

/* A ship that its load turns finds the load of the heading at which it lies, however many directions are asked for: in
   ice by the formula and wind, from abeam, its mooring ahead of its middle. */
START_TEST(turned_ships_know_loads_between_directions)
{
    static const char *const iced[] = {"ice.source=voronoi",        "ice.thickness=0.15",
                                       "ice.concentration=0.4",     "vessel.mooring.x=1.5",
                                       "environment.wind_speed=20", "environment.hull_drag.air_form=1"};
    static const int32_t count[] = {4, 12, 28};
    capability_options o = plain;
    o.formula = true;
    o.line_safety = 1;
    o.speed_step = o.speed_most = 0.75;
    double turn = 0;
    for (int i = 0; i < 3; i++) {
        o.directions = count[i];
        capability c = find_with(iced, sizeof iced / sizeof *iced, &o);
        const holding *abeam = &c.use[o.directions / 4];
        if (i == 0)
            turn = abeam->turn;
        ck_assert_msg(turn > radians(8) && turn < radians(60), "turned by %g degrees", degrees(turn));
        assert_relative(abeam->turn, turn, 1e-3);
        ck_assert(abeam->use <= 1);
        assert_relative(c.intact[o.directions / 4].turn, turn, 1e-3);
        forget(&c);
    }
}
END_TEST

static void keep_turn(void *user, log_level level, const char *text)
{
    if (level == LOG_WARNING && strstr(text, "held turned by up to"))
        snprintf(user, 200, "%s", text);
}

/* Half of the way between twelve, and less where fewer are measured. */
START_TEST(turns_between_measured_directions_are_told)
{
    static const struct {
        int32_t measured;
        double turn_deg;
        const char *told;
    } turned[] = {{12, 14.9, NULL},
                  {12, 15, "30 degrees apart: judge"},
                  {12, 100, "turned by up to 100 degrees"},
                  {4, 2.5, NULL},
                  {4, 2.6, "90 degrees apart: ask for 12 directions"},
                  {8, 5.5, NULL},
                  {8, 6, "45 degrees apart: ask for 12 directions"},
                  {0, 60, NULL}};
    for (size_t i = 0; i < sizeof turned / sizeof *turned; i++) {
        context ctx;
        char told[200] = "";
        context_init(&ctx);
        ctx.log = keep_turn;
        ctx.log_user = told;
        capability_limit intact[4] = {{.turn = 0}}, damaged[4] = {{.turn = 0}};
        (i % 2 ? intact : damaged)[3].turn = radians(turned[i].turn_deg);
        const capability c = {
            .intact = intact, .damaged = damaged, .loads = {.directions = 4, .measured = turned[i].measured}};
        capability_tell_turns(&ctx, &c);
        ck_assert_msg(turned[i].told ? strstr(told, turned[i].told) != NULL : told[0] == '\0', "%d: %s", (int)i, told);
    }
}
END_TEST

/* Each column of capability_use.csv holds what its head says, in every cell. */
START_TEST(use_as_it_is_written)
{
    static const char *const iced[] = {"ice.source=voronoi", "ice.thickness=0.5", "environment.wind_speed=15",
                                       "environment.hull_drag.air_form=1", "vessel.centre_of_gravity_x=3"};
    static const char thrusters[] = "  thrusters: [{x: 20, thrust: 4.0e4}, {x: -20, thrust: 5.0e4}]\n  mooring:";
    char text[sizeof sprung + sizeof thrusters], folder[SCRATCH_FOLDER], path[PATH_ROOM];
    const char *mooring = strstr(sprung, "  mooring:");
    snprintf(text, sizeof text, "%.*s%s%s", (int)(mooring - sprung), sprung, thrusters, strchr(mooring, ':') + 1);
    scene k;
    capability c;
    csv_table t;
    fram_error error = {0};
    scene_open_with(&k, text, iced, sizeof iced / sizeof *iced);
    capability_options o = plain;
    o.formula = o.force = true;
    scratch_folder(folder);
    o.folder = folder;
    assert_ok(capability_find(&k.ctx, &k.s, &o, &c, &error), error);
    assert_ok(capability_write(&k.ctx, &k.s, &o, path, &error), error);
    assert_ok(path_join(folder, "capability_use.csv", path, &error), error);
    assert_ok(csv_table_read(&k.ctx, path, NULL, &t, &error), error);
    ck_assert_int_eq(t.columns.count, 13);
    ck_assert_int_eq(t.rows, c.loads.directions * c.loads.speeds);
    bool differ = false;
    for (int32_t i = 0; i < t.rows; i++) {
        const holding *h = &c.use[i];
        double from = 45 * (i / c.loads.speeds), speed = 0.25 * (1 + i % c.loads.speeds);
        vec3 ice = ice_at(&c, i / c.loads.speeds, i % c.loads.speeds),
             load = capability_load_at(&c, radians(from), speed);
        const struct {
            const char *name, *unit;
            double value;
        } cell[] = {{"from_bow_clockwise", "deg", from},
                    {"speed", "m/s", speed},
                    {"use", "1", h->use},
                    {"thruster_use", "1", h->thruster_use},
                    {"line_use", "1", h->line_use},
                    {"offset", "m", h->offset},
                    {"turn", "deg", degrees(h->turn)},
                    {"ice_surge", "N", ice.x},
                    {"ice_sway", "N", ice.y},
                    {"ice_yaw", "N m", ice.z},
                    {"load_surge", "N", load.x},
                    {"load_sway", "N", load.y},
                    {"load_yaw", "N m", load.z}};
        for (size_t n = 0; n < sizeof cell / sizeof *cell; n++) {
            const csv_table_column *column = csv_table_find(&t, cell[n].name);
            ck_assert_msg(column && strcmp(column->unit, cell[n].unit) == 0, "%s[%s]", cell[n].name, cell[n].unit);
            ck_assert_msg(column->value.data[i] == cell[n].value, "%s of row %d is %.9g, not %.9g", cell[n].name,
                          (int)i, column->value.data[i], cell[n].value);
        }
        differ = differ || (h->use != h->thruster_use && h->thruster_use > 0 && h->line_use > 0 && ice.z != 0);
    }
    ck_assert(differ);
    csv_table_free(&k.ctx, &t);
    close_found(&k, &c);
    static const char *const files[] = {"capability.csv", "capability_use.csv", "capability.json", "capability.png",
                                        "capability.svg"};
    for (size_t i = 0; i < sizeof files / sizeof *files; i++) {
        assert_ok(path_join(folder, files[i], path, &error), error);
        unlink(path);
    }
    ck_assert_int_eq(rmdir(folder), 0);
}
END_TEST

START_TEST(broken_ice_by_formula)
{
    /* B 18, h 1, S .8, v 1.5, rho 910: 379.8 kN (docs/oracles.md, section 8). */
    assert_relative(broken_ice_resistance(910, 9.81, 18, 1, 0.8, 1.5), 379.8e3, 1e-3);
    scene k;
    scene_open_with(&k, box, (const char *const[]){"ice.source=voronoi", "ice.density=910", "ice.thickness=0.5"}, 3);
    capability_options o = plain;
    capability c;
    fram_error error = {0};
    o.formula = true;
    assert_ok(capability_find(&k.ctx, &k.s, &o, &c, &error), error);
    double ahead = broken_ice_resistance(910, 9.81, 12, 0.5, 0.8, 0.5);
    double abeam = broken_ice_resistance(910, 9.81, 60, 0.5, 0.8, 0.5);
    assert_relative(-ice_at(&c, 0, 1).x, ahead, 1e-6);
    assert_relative(ice_at(&c, 2, 1).y, abeam, 1e-6);
    assert_absolute(ice_at(&c, 2, 1).z, 0, 1e-3 * abeam);
    /* With the allowance, and the drag. */
    vec3 sum = capability_load_at(&c, 0, 0.5);
    assert_relative(-sum.x, 1.25 * (ahead + 0.5 * 1025 * 0.25 * 48), 1e-3);
    capability_free(&k.ctx, &c);
    /* Through the middle of the breadth, which is abaft a centre of gravity that lies ahead. */
    k.s.vessel.centre_of_gravity_x = 5;
    assert_ok(capability_find(&k.ctx, &k.s, &o, &c, &error), error);
    assert_relative(ice_at(&c, 2, 1).z, -5 * abeam, 1e-3);
    capability_free(&k.ctx, &c);
    k.s.vessel.centre_of_gravity_x = 0;
    /* Measuring needs ice that is driven past. */
    o.formula = false;
    ck_assert_int_eq(capability_find(&k.ctx, &k.s, &o, &c, &error), FRAM_ERROR_INPUT);
    ck_assert_str_eq(error.key, "domain.boundary");
    scene_close(&k);
}
END_TEST

/* What runs of the drift from starboard measure, made by hand: the whole ice goes the drift's way, whatever current and
   wind the scenario has.  In the ship's frame, scaled to the significant value of the load along its mean. */
static vec3 load_from_starboard(scene *k, double speed, double seconds)
{
    scenario d = k->s;
    model m;
    world w;
    fram_error error = {0};
    double_array time = {0}, part[3] = {{0}, {0}, {0}};
    d.vessel.mode = VESSEL_PRESCRIBED;
    d.vessel.propulsion.bollard_pull = (double)NAN;
    d.vessel.wash.active = false;
    d.domain.drift_speed = d.environment.current_speed = speed;
    d.domain.drift_direction_deg = d.environment.current_direction_deg = 30 - 90 + 180;
    d.environment.wind_speed = 0;
    d.environment.current_profile_file[0] = '\0';
    assert_ok(scene_build(&k->ctx, &d, &m, &w, &error), error);
    for (int i = 0; i < (int)floor(seconds / d.run.time_step + 0.5); i++) {
        assert_ok(world_step(&k->ctx, &m, &w, &error), error);
        wrench mean = load_window_average(&w, 0);
        vec3 load = plane_to_vessel(radians(30), vec3_make(mean.force.x, mean.force.y, mean.moment.z));
        const double row[3] = {load.x, load.y, load.z};
        ck_assert(array_push(&k->ctx, &time, w.clock.time[0]));
        for (int j = 0; j < 3; j++)
            ck_assert(array_push(&k->ctx, &part[j], row[j]));
    }
    double mean[3], size;
    for (int j = 0; j < 3; j++)
        mean[j] = channel_statistics_of(time.data, part[j].data, time.count, seconds / 3).mean;
    size = sqrt(mean[0] * mean[0] + mean[1] * mean[1]);
    for (int32_t i = 0; i < time.count; i++)
        part[0].data[i] = (part[0].data[i] * mean[0] + part[1].data[i] * mean[1]) / size;
    double most = channel_statistics_of(time.data, part[0].data, time.count, seconds / 3).significant_above / size;
    ck_assert(most > 1.01);
    array_free(&k->ctx, &time);
    for (int j = 0; j < 3; j++)
        array_free(&k->ctx, &part[j]);
    world_free(&k->ctx, &w);
    model_free(&k->ctx, &m);
    return vec3_make(most * mean[0], most * mean[1], most * mean[2]);
}

/* Ice that drifts onto a hull from ahead pushes it astern, from starboard to port; mirrored from port.  Neither wind
   nor what the current has on top at a depth are in it, and a hull that is held neither drives nor washes ice away. The
   sway of ice from ahead is chance, and no reason for unlike sides. */
START_TEST(measured_ice)
{
    char path[] = "/tmp/fram-profile-XXXXXX", profile[80];
    int file = mkstemp(path);
    ck_assert(file >= 0 && dprintf(file, "depth,x,y\n0,0,1\n20,0,1\n") > 0 && close(file) == 0);
    snprintf(profile, sizeof profile, "environment.current_profile_file=%s", path);
    scene k;
    const char *const ice[] = {"ice.source=voronoi",
                               "ice.concentration=0.9",
                               "ice.mean_floe_area=80",
                               "ice.thickness=0.6",
                               "domain.boundary=feeding",
                               "domain.x_min=-70",
                               "domain.x_max=70",
                               "domain.y_min=-70",
                               "domain.y_max=70",
                               "vessel.hull.length=40",
                               "environment.wind_speed=15",
                               "vessel.propulsion.bollard_pull=2e5",
                               "vessel.propulsion.open_water_speed=6",
                               "vessel.wash.active=true",
                               "run.time_step=0.05",
                               profile};
    scene_open_with(&k, box, ice, sizeof ice / sizeof *ice);
    capability_options o = plain;
    o.directions = 4;
    o.speed_step = o.speed_most = 0.8;
    o.measure = 20;
    capability c;
    fram_error error = {0};
    assert_ok(capability_find(&k.ctx, &k.s, &o, &c, &error), error);
    unlink(path);
    const vec3 load[3] = {ice_at(&c, 0, 0), ice_at(&c, 1, 0), ice_at(&c, 2, 0)};
    ck_assert(load[0].x < -1e3 && load[1].y > 1e3 && load[2].x > 1e3 && fabs(load[0].y) > 1);
    for (int32_t i = 1; 2 * i < c.loads.rows; i++) {
        const vec3 port = c.loads.ice[(c.loads.rows - i) * c.loads.speeds], image = {port.x, -port.y, -port.z};
        ck_assert_mem_eq(&c.loads.ice[i * c.loads.speeds], &image, sizeof image);
    }
    vec3 by_hand = load_from_starboard(&k, 0.8, 20);
    assert_relative(load[1].x, by_hand.x, 1e-12);
    assert_relative(load[1].y, by_hand.y, 1e-12);
    assert_relative(load[1].z, by_hand.z, 1e-12);
    close_found(&k, &c);
}
END_TEST

/* Behind their number the speeds at which ice from ahead is measured. */
static void keep_speeds(void *user, log_level level, const char *text)
{
    double *speeds = user, speed;
    (void)level;
    if (sscanf(text, "ice from 0 deg at %lf m/s", &speed) == 1) {
        speeds[0]++;
        speeds[(int)speeds[0]] = speed;
    }
}

/* Of more than four speeds four are measured, up to the largest; loads from port are those from starboard, mirrored,
   unless the centre of mass lies to one side. */
START_TEST(speeds_that_are_measured)
{
    static const char *const ice[] = {"ice.source=voronoi", "ice.mean_floe_area=400", "domain.boundary=feeding",
                                      "domain.x_min=-70",   "domain.x_max=70",        "domain.y_min=-70",
                                      "domain.y_max=70"};
    double speeds[9] = {0};
    scene k;
    scene_open_with(&k, box, ice, sizeof ice / sizeof *ice);
    k.ctx.log = keep_speeds;
    k.ctx.log_user = speeds;
    capability_options o = plain;
    o.directions = 4;
    o.speed_step = 0.25;
    o.speed_most = 2;
    o.measure = k.s.run.time_step;
    capability c;
    fram_error error = {0};
    assert_ok(capability_find(&k.ctx, &k.s, &o, &c, &error), error);
    ck_assert_double_eq(speeds[0], 4);
    for (int i = 1; i <= 4; i++)
        assert_relative(speeds[i], 0.5 * i, 1e-12);
    ck_assert(c.loads.runs == 3 * 4);
    capability_free(&k.ctx, &c);
    o.speed_most = o.speed_step;
    k.s.vessel.centre_of_gravity_y = 1;
    assert_ok(capability_find(&k.ctx, &k.s, &o, &c, &error), error);
    ck_assert(c.loads.runs == 4);
    close_found(&k, &c);
}
END_TEST

/* Four fifths of the ice in floes of 4 m, the rest in floes of 9 m: of the field that is made for the vessel as much.
 */
START_TEST(ice_that_was_met)
{
    scene k;
    scene_open_with(&k, box, (const char *const[]){"vessel.x=50", "ice.density=900"}, 2);
    k.s.ice.source = ICE_LEVEL;
    managed_ice sum = {.windows = 0};
    for (int i = 0; i < 2; i++) {
        managed_cover window = {.sheet = 0};
        managed_cover_add(&window, i ? 4 : 9, i ? 0.6 : 0.3);
        managed_cover_add(&window, 4, 0.3);
        window.volume = 0.45;
        managed_ice_add(&sum, &window, i ? 4 : 9);
    }
    capability_met_ice met = {.windows = 2, .sheet_as = (double)NAN};
    fram_error error = {0};
    assert_ok(managed_law_of(&sum, (double)NAN, &met.law, &error), error);
    const size_law sizes = managed_size_law(&met.law);
    scenario_population population;
    scenario s;
    assert_ok(capability_met_scenario(&k.s, &met, 120, &population, &sizes, &s, &error), error);
    ck_assert_double_eq(s.domain.x_min, -10);
    ck_assert_double_eq(s.domain.x_max, 110);
    ck_assert_double_eq(s.domain.y_max, 60);
    ck_assert_double_eq(s.ice.density, 900);
    assert_relative(s.ice.thickness, 0.6, 1e-12);
    model m;
    world w;
    field_report report;
    s.vessel.present = false;
    assert_ok(build_model(&k.ctx, &s, &m, &error), error);
    assert_ok(build_world(&k.ctx, &s, &m, &w, &report, &error), error);
    double small = 0, large = 0;
    for (int32_t i = 0; i < w.floes.count; i++) {
        double size = sqrt(4 / PI * w.floes.area[i]);
        *(size < 6 ? &small : &large) += w.floes.area[i];
    }
    assert_relative(report.concentration, 0.75, 0.01);
    /* The window shows some thirty of the large floes; by numbers, not areas, it would be 20. */
    assert_relative(small / large, 4, 0.25);
    world_free(&k.ctx, &w);
    model_free(&k.ctx, &m);
    scene_close(&k);
}
END_TEST

START_TEST(refusals)
{
    scene k;
    scene_open(&k, box);
    capability c;
    fram_error error = {0};
    capability_options o = plain;
    o.directions = 2;
    ck_assert_int_eq(capability_find(&k.ctx, &k.s, &o, &c, &error), FRAM_ERROR_USAGE);
    o = plain;
    const capability_met_ice met = {.windows = 1};
    o.met = &met;
    o.formula = true;
    ck_assert_int_eq(capability_find(&k.ctx, &k.s, &o, &c, &error), FRAM_ERROR_USAGE);
    ck_assert_str_eq(error.key, "formula");
    o = plain;
    o.speed_step = 0;
    ck_assert_int_eq(capability_find(&k.ctx, &k.s, &o, &c, &error), FRAM_ERROR_USAGE);
    o = plain;
    o.allowance = 0.5;
    ck_assert_int_eq(capability_find(&k.ctx, &k.s, &o, &c, &error), FRAM_ERROR_USAGE);
    ck_assert_str_eq(error.key, "allowance");
    o = plain;
    o.line_safety_damaged = 0;
    ck_assert_int_eq(capability_find(&k.ctx, &k.s, &o, &c, &error), FRAM_ERROR_USAGE);
    ck_assert_str_eq(error.key, "line_safety_damaged");
    o = plain;
    o.measure = (double)NAN;
    ck_assert_int_eq(capability_find(&k.ctx, &k.s, &o, &c, &error), FRAM_ERROR_USAGE);
    k.s.vessel.thrusters.count = 0;
    ck_assert_int_eq(capability_find(&k.ctx, &k.s, &plain, &c, &error), FRAM_ERROR_INPUT);
    ck_assert_str_eq(error.key, "vessel");
    k.s.vessel.thrusters.count = 3;
    scene_close(&k);
}
END_TEST

/* What is wrong with a vessel of a list is told by its place there, which counts vessels that are not present. */
START_TEST(refusals_name_the_place_in_the_list)
{
    static const char fleet[] =
        "ice: {source: none}\ndomain: {boundary: open}\nvessels:\n"
        "  - {name: gone, present: false, mode: free, hull: {form: box, length: 60, beam: 12, draught: 4}}\n"
        "  - {name: driven, mode: prescribed, y: 90, hull: {form: box, length: 60, beam: 12, draught: 4}}\n"
        "  - name: moored\n    mode: free\n    hull: {form: box, length: 60, beam: 12, draught: 4}\n"
        "    mooring:\n      depth: 100\n"
        "      lines: [{count: 4, spacing_deg: 90, distance: 400, pretension: 9e4, weight: 1000}]\n";
    context ctx;
    scenario s;
    capability c;
    capability_options o = plain;
    fram_error error = {0};
    context_init(&ctx);
    assert_ok(scenario_parse(&ctx, "fleet.yaml", fleet, strlen(fleet), NULL, &s, &error), error);
    o.vessel = "moored";
    ck_assert_int_eq(capability_find(&ctx, &s, &o, &c, &error), FRAM_ERROR_INPUT);
    ck_assert_str_eq(error.key, "vessels[2].mooring.lines[0].pretension");
    ck_assert_str_eq(error.file, "fleet.yaml");
    ck_assert_int_eq(error.line, 11);
    o.vessel = "driven";
    ck_assert_int_eq(capability_find(&ctx, &s, &o, &c, &error), FRAM_ERROR_INPUT);
    ck_assert_msg(strncmp(error.key, "vessels[1]", 10) == 0 && error.line == 5, "%s in line %d", error.key, error.line);
    scenario_free(&ctx, &s);
}
END_TEST

static void count_balances(void *user, const char *what, double done, double total)
{
    int *count = user;
    if (strcmp(what, "balancing") != 0)
        return;
    ck_assert(done < total && total == 8 * 4);
    (*count)++;
}

/* Who waits is told of each direction, and in it of each failure until one leaves nothing: without the propeller
   ahead and astern, without the first tunnel on all other sides. */
START_TEST(balances_are_told)
{
    scene k;
    capability c;
    int count = 0;
    fram_error error = {0};
    scene_open_with(&k, box, NULL, 0);
    k.ctx.work = count_balances;
    k.ctx.work_user = &count;
    assert_ok(capability_find(&k.ctx, &k.s, &plain, &c, &error), error);
    ck_assert_int_eq(count, 4 * 2 + 2 * 3 + 2 * 2);
    close_found(&k, &c);
}
END_TEST

static void stop_at_loads(void *user, const char *what, double done, double total)
{
    int *stop = user;
    *stop = strcmp(what, "summing loads") == 0 && done < 0.5 * total;
}

/* The sums over a hull's faces, of which there may be 1e5, are told and stopped as the balances are. */
START_TEST(sums_of_loads_are_told_and_stopped)
{
    scene k;
    capability c;
    int stop = 0;
    fram_error error = {0};
    scene_open_with(&k, box, NULL, 0);
    k.ctx.work = stop_at_loads;
    k.ctx.work_user = &stop;
    capability_options o = plain;
    o.stop = &stop;
    assert_fails(capability_find(&k.ctx, &k.s, &o, &c, &error), error, FRAM_INTERRUPTED, "nothing was written");
    scene_close(&k);
}
END_TEST

/* The balances alone, and the runs before them, see the flag. */
START_TEST(a_stop_flag_is_seen)
{
    const volatile int stop = 1;
    const char *const ice[] = {"ice.source=voronoi", "domain.boundary=feeding"};
    for (int runs = 0; runs < 2; runs++) {
        scene k;
        scene_open_with(&k, box, ice, runs ? 2 : 0);
        capability_options o = plain;
        o.stop = &stop;
        capability c;
        fram_error error = {0};
        assert_fails(capability_find(&k.ctx, &k.s, &o, &c, &error), error, FRAM_INTERRUPTED, "nothing was written");
        scene_close(&k);
    }
}
END_TEST

TEST_MAIN("capability", limits_by_hand, limits_of_thrusters_that_turn, loads_between_directions_and_speeds,
          loads_of_wind_and_damping, damping_in_a_current_of_depth, no_loads_without_water, out_of_order_from_the_start,
          what_is_left_after_a_line, ships_that_turn, balances_are_those_of_a_run,
          turned_ships_know_loads_between_directions, turns_between_measured_directions_are_told, use_as_it_is_written,
          broken_ice_by_formula, measured_ice, speeds_that_are_measured, ice_that_was_met, refusals,
          refusals_name_the_place_in_the_list, balances_are_told, a_stop_flag_is_seen,
          sums_of_loads_are_told_and_stopped)
