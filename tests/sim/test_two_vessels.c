/* Two vessels in one world: each has its own hull, hydrodynamics, flows, loads and station, whatever its row, so that
   two that are far apart do what each does alone: to the bit with the sequential solver, which treats contacts one by
   one; the steps of the fast one are found over all bodies (docs/limits.md). */
#include "fleet.h"

#include "sim/ice_loads.h"

#define METHOD "run: {time_step: 0.02, duration: 10, solver: {kind: sequential}}\n"
#define SEA "environment: {current_speed: 0.3, current_direction_deg: 180, wind_speed: 12, wind_direction_deg: 90}\n"
#define OPEN "domain: {boundary: open, x_min: -500, x_max: 3000, y_min: -500, y_max: 500}\n"

/* A towed icebreaker among three floes, and a wider box that is towed on a path, with a table of its own. */
static const char towed_icebreaker[] =
    METHOD "vessel:\n  mode: towed\n  speed: 1.5\n"
           "  hull: {length: 60, beam: 14, draught: 5, freeboard: 3, parallel_midbody: 0.3}\n"
           "  hydrodynamics: {source: estimate}\n" OPEN SEA "ice:\n  source: floes\n  thickness: 0.8\n  floes:\n"
           "    - {x: 39, y: 2, length: 16, width: 20, yaw_deg: 10}\n"
           "    - {x: 57, y: -4, length: 18, width: 16}\n"
           "    - {x: 54, y: 15, length: 12, width: 12, velocity_y: -0.5}\n";
static const char towed_box[] =
    METHOD "vessel:\n  mode: towed\n"
           "  path: [{x: 2000, y: 12, heading_deg: 30}, {time: 5, x: 2004, y: 14, heading_deg: 32}]\n"
           "  hull: {form: box, length: 40, beam: 20, draught: 4, freeboard: 3}\n"
           "  current_coefficients: {table: [{angle_deg: 0, cx: 0.1},\n"
           "    {angle_deg: 90, cy: 0.7}, {angle_deg: 180, cx: -0.1}]}\n" OPEN SEA
           "ice:\n  source: floes\n  thickness: 0.8\n  floes:\n"
           "    - {x: 2022.5, y: 25, length: 10, width: 20, yaw_deg: 30}\n"
           "    - {x: 2034, y: 38, length: 12, width: 12, yaw_deg: 5}\n";

/* On dynamic positioning that feeds the measured ice load forward, pushed by floes; and a moored one. */
static const char positioned[] = METHOD
    "vessel:\n  mode: free\n"
    "  hull: {length: 60, beam: 14, draught: 5, freeboard: 3, parallel_midbody: 0.3}\n"
    "  hydrodynamics: {source: estimate}\n"
    "  thrusters: [{x: 20, thrust: 3e5}, {x: -20, thrust: 3e5}, {kind: tunnel, x: 25, thrust: 1e5}]\n"
    "  positioning: {active: true, feed_forward: measured, feed_forward_time: 1, noise_position: 0,\n"
    "    noise_heading_deg: 0, interval: 0.1, sample_interval: 0.1, waypoints: [{time: 1, x: 3, y: 1}]}\n" OPEN SEA
    "ice:\n  source: floes\n  thickness: 0.8\n  floes:\n"
    "    - {x: 38.5, y: 1, length: 16, width: 20, velocity_x: -1}\n"
    "    - {x: 3, y: 16, length: 12, width: 12, velocity_y: -0.6}\n";
static const char moored[] =
    METHOD "vessel:\n  mode: free\n  x: 2000\n  y: -20\n  heading_deg: -15\n"
           "  hull: {length: 50, beam: 16, draught: 4, freeboard: 3, parallel_midbody: 0.3}\n"
           "  hydrodynamics: {source: estimate}\n  station: {offset_limit: 0.01}\n"
           "  mooring:\n    equilibrium: false\n    lines:\n"
           "      - {count: 4, spacing_deg: 90, direction_deg: 45, distance: 400, pretension: 2e5}\n" OPEN SEA
           "ice:\n  source: floes\n  thickness: 0.8\n  floes:\n"
           "    - {x: 2034, y: -28, length: 16, width: 20, velocity_x: -1}\n";

/* What is written of a vessel, in a step. */
typedef struct seen {
    vec3 position, velocity, angular_velocity, response, missed, offset;
    quat orientation;
    wrench ice, averaged, mooring, thrust;
    int32_t contacts;
} seen;

static seen look(const fleet *f, int32_t vessel)
{
    const world *w = &f->w;
    int32_t body = w->vessels.body[vessel];
    const ice_load *ice = &w->scratch.ice_loads.data[vessel];
    seen s;
    memset(&s, 0, sizeof s);
    s.position = w->bodies.position[body];
    s.velocity = w->bodies.velocity[body];
    s.angular_velocity = w->bodies.angular_velocity[body];
    s.orientation = w->bodies.orientation[body];
    s.response = w->scratch.responses.data[vessel].force;
    s.ice = ice->total;
    s.contacts = ice->contacts;
    s.averaged = load_window_average(w, vessel);
    if (vessel < w->stations.count) {
        s.mooring = w->stations.mooring_load[vessel];
        s.thrust = w->stations.thruster_load[vessel];
        s.missed = w->stations.missed[vessel];
        s.offset = w->stations.offset[vessel];
    }
    return s;
}

/* The vessels of two texts together, in this order and swapped, against each alone. */
static void compare(const char *first, const char *second, const scenario_overrides *override, int steps)
{
    fleet alone[2], both, swapped;
    const char *const texts[2] = {first, second}, *const back[2] = {second, first};
    fleet_open(&alone[0], &texts[0], 1, override);
    fleet_open(&alone[1], &texts[1], 1, override);
    fleet_open(&both, texts, 2, override);
    fleet_open(&swapped, back, 2, override);
    double pushed[2] = {0, 0};
    for (int n = 0; n < steps; n++) {
        fleet_step(&alone[0]);
        fleet_step(&alone[1]);
        fleet_step(&both);
        fleet_step(&swapped);
        for (int32_t v = 0; v < 2; v++) {
            seen expected = look(&alone[v], 0), found = look(&both, v), turned = look(&swapped, 1 - v);
            ck_assert_msg(memcmp(&expected, &found, sizeof found) == 0,
                          "step %d: vessel %d moves by another way than alone: ice load %.17g and %.17g N", n, (int)v,
                          expected.ice.force.x, found.ice.force.x);
            ck_assert_msg(memcmp(&expected, &turned, sizeof turned) == 0, "step %d: vessel %d differs in the other row",
                          n, (int)v);
            pushed[v] = fmax(pushed[v], vec3_length(found.averaged.force));
        }
    }
    /* Both met ice, or the test says nothing of loads. */
    ck_assert_msg(pushed[0] > 1e4 && pushed[1] > 1e4, "largest loads %g and %g N", pushed[0], pushed[1]);
    ck_assert_int_eq(both.w.events.count, alone[0].w.events.count + alone[1].w.events.count);
    fleet_close(&alone[0]);
    fleet_close(&alone[1]);
    fleet_close(&both);
    fleet_close(&swapped);
}

/* Positions are corrected in all of the world or, where nothing overlaps by more than a part of the skin, nowhere:
   there they are equal to that part only, which this leaves out. */
static const char *const no_correction[] = {"run.solver.position_iterations=0"};
static const scenario_overrides uncorrected = {no_correction, 1};

START_TEST(towed_vessels_far_apart_do_as_alone) { compare(towed_icebreaker, towed_box, NULL, 200); }
END_TEST

START_TEST(vessels_on_station_far_apart_do_as_alone) { compare(positioned, moored, &uncorrected, 200); }
END_TEST

/* A station is that of its vessel though the one before it has none. */
START_TEST(a_station_behind_a_towed_vessel) { compare(towed_icebreaker, moored, &uncorrected, 200); }
END_TEST

TEST_MAIN("two_vessels", towed_vessels_far_apart_do_as_alone, vessels_on_station_far_apart_do_as_alone,
          a_station_behind_a_towed_vessel)
