/* A floe that flies off, or whose place is no number, is told: it does not leave by the edge of the domain unseen. */
#include "base/pool.h"
#include "scene.h"

#include <math.h>

static const char field[] = "run: {duration: 10, time_step: 0.05, seed: 5}\n"
                            "vessel: {present: false}\n"
                            "ice: {concentration: 0.6, mean_floe_area: 60}\n"
                            "domain: {x_min: -40, x_max: 40, y_min: -40, y_max: 40}\n"
                            "environment: {current_speed: 0.2}\n";

/* The floe nearest to the middle: it moves by itself under every boundary. */
static int32_t middle_floe(const world *w)
{
    int32_t found = -1;
    double least = HUGE_VAL;
    for (int32_t i = 0; i < w->floes.count; i++) {
        double away = w->floes.body[i] < 0 ? HUGE_VAL : vec3_length(w->bodies.position[w->floes.body[i]]);
        if (away < least) {
            least = away;
            found = i;
        }
    }
    return found;
}

/* What a step says of a floe with this velocity. */
static void step_with(const char *boundary, vec3 velocity, int threads, fram_error *error)
{
    scene k;
    scene_open_with(&k, field, &boundary, 1);
    k.ctx.threads = threads > 1 ? pool_create(&k.ctx, threads) : NULL;
    scene_steps(&k, 2);
    int32_t floe = middle_floe(&k.w), body = k.w.floes.body[floe];
    k.w.bodies.velocity[body] = velocity;
    double left = k.w.clock.ice_left[0];
    ck_assert_int_eq(world_step(&k.ctx, &k.m, &k.w, error), FRAM_ERROR_SIMULATION);
    char name[40];
    snprintf(name, sizeof name, "body %d (floe", (int)body);
    ck_assert_msg(strstr(error->message, name) && strstr(error->message, "in step 3 (t = 0.15 s)"), "%s",
                  error->message);
    ck_assert(k.w.floes.body[floe] == body && k.w.clock.ice_left[0] == left);
    ck_assert_int_eq(k.w.clock.step[0], 3);
    pool_free(&k.ctx, k.ctx.threads);
    scene_close(&k);
}

START_TEST(floes_that_go_astray_are_told)
{
    static const char *const boundaries[] = {"domain.boundary=open", "domain.boundary=walls",
                                             "domain.boundary=feeding"};
    const double nan = NAN;
    for (int b = 0; b < 3; b++) {
        for (int threads = 1; threads <= 2; threads++) {
            fram_error error = {0};
            step_with(boundaries[b], (vec3){1e5, 0, 0}, threads, &error);
            ck_assert_msg(strstr(error.message, "run.speed_limit"), "%s", error.message);
            ck_assert_msg(strstr(error.message, "velocity at the start"), "%s", error.message);
            for (int k = 0; k < 4; k++) {
                step_with(boundaries[b],
                          (vec3){k == 0 || k == 3 ? nan : 0, k == 1 || k == 3 ? nan : 0, k == 2 ? nan : 0}, threads,
                          &error);
                ck_assert_msg(strstr(error.message, "no finite number"), "%s", error.message);
            }
        }
    }
}
END_TEST

/* A beam of ice of 20 x 1 m and a hull of 60 x 12 m, both far longer than they are wide. */
static const char beams[] = "run: {duration: 10, time_step: 0.01}\n"
                            "vessel: {mode: free, heading_deg: 30, x: -40,\n"
                            "         hull: {form: box, length: 60, beam: 12, draught: 4, freeboard: 2}}\n"
                            "ice: {source: floes, thickness: 0.5, floes: [{length: 20, width: 1, x: 30}]}\n"
                            "domain: {boundary: open}\n"
                            "environment: {water: false}\n";

/* What a step says of the floe or the hull with this turn, in its own axes. */
static fram_status turn_with(bool hull, vec3 turn, fram_error *error)
{
    scene k;
    scene_open_with(&k, beams, NULL, 0);
    int32_t body = hull ? k.w.vessels.body[0] : k.w.floes.body[0];
    k.w.bodies.angular_velocity[body] = mat3_mul_vec(quat_matrix(k.w.bodies.orientation[body]), turn);
    fram_status status = world_step(&k.ctx, &k.m, &k.w, error);
    scene_close(&k);
    return status;
}

/* About its own length either may turn at a rate with which its ends would be too fast about any other axis. */
START_TEST(what_turns_is_judged_by_its_rim)
{
    const double nan = NAN;
    const struct {
        bool hull;
        vec3 turn;
        const char *told; /* NULL: nothing */
    } of[] = {{false, {12, 0, 0}, NULL},
              {false, {179, 0, 0}, "turns at 179 rad/s, its rim 0.559 m off at 100.1 m/s"},
              {false, {0, 0, 9.9}, NULL},
              {false, {0, 0, -12}, "turns at 12 rad/s, its rim 10.01 m off at 120.1 m/s"},
              {false, {1e200, 0, 0}, "no finite number"},
              {false, {nan, 0, 0}, "no finite number"},
              {true, {5, 0, 0}, NULL},
              {true, {0, 0, 5}, "turns at 5 rad/s, its rim 30.59 m off at 153 m/s"}};
    for (size_t i = 0; i < sizeof of / sizeof *of; i++) {
        fram_error error = {0};
        fram_status status = turn_with(of[i].hull, of[i].turn, &error);
        ck_assert_msg(status == (of[i].told ? FRAM_ERROR_SIMULATION : FRAM_OK), "%d: %s", (int)i, error.message);
        ck_assert_msg(!of[i].told || strstr(error.message, of[i].told), "%d: %s", (int)i, error.message);
    }
}
END_TEST

TEST_MAIN("astray", floes_that_go_astray_are_told, what_turns_is_judged_by_its_rim)
