/* Current and wind from files: drift that turns round, and files that are wrong. */
#include "io/scenario_file.h"
#include "scratch.h"
#include "sim/build.h"
#include "sim/step.h"

#include <stdio.h>

typedef struct sea {
    char folder[SCRATCH_FOLDER];
    context ctx;
    scenario s;
    model m;
    world w;
} sea;

#define ONE_FLOE                                                                   \
    "run: {time_step: 0.05}\nvessel: {present: false}\n"                           \
    "domain: {boundary: open, x_min: -1e4, x_max: 1e4, y_min: -1e4, y_max: 1e4}\n" \
    "ice: {source: floes, floes: [{}]}\n"

static fram_status open_sea(sea *k, const char *environment, const char *series, fram_error *error)
{
    char text[1024], path[SCRATCH_PATH];
    memset(k, 0, sizeof *k);
    context_init(&k->ctx);
    scratch_folder(k->folder);
    snprintf(text, sizeof text, ONE_FLOE "environment: {%s}\n", environment);
    scratch_put(k->folder, "scene.yaml", text);
    scratch_put(k->folder, "series.csv", series);
    snprintf(path, sizeof path, "%s/scene.yaml", k->folder);
    fram_status status = scenario_read(&k->ctx, path, NULL, &k->s, error);
    if (status != FRAM_OK)
        return status;
    field_report report;
    status = build_model(&k->ctx, &k->s, &k->m, error);
    if (status != FRAM_OK)
        return status;
    status = build_world(&k->ctx, &k->s, &k->m, &k->w, &report, error);
    if (status != FRAM_OK)
        model_free(&k->ctx, &k->m);
    return status;
}

static void close_sea(sea *k)
{
    world_free(&k->ctx, &k->w);
    model_free(&k->ctx, &k->m);
    scenario_free(&k->ctx, &k->s);
    scratch_remove_folder(k->folder);
}

/* A velocity that goes evenly from one to another between two times. */
typedef struct ramp {
    vec2 from, to;
    double begin, end;
} ramp;

static vec2 ramp_at(const ramp *r, double time)
{
    double share = r->end > r->begin ? fmin(fmax((time - r->begin) / (r->end - r->begin), 0), 1) : 1;
    return vec2_add(vec2_scale(r->from, 1 - share), vec2_scale(r->to, share));
}

/* Of a medium that goes past a floe of 10 x 10 m along x and y: form on the sides that meet it, skin on the others,
   which are so high in it, and on one cap. */
static vec2 drag(double density, double skin, double height, vec2 u)
{
    double side = 10 * height, sides = side * (1 + 2 * skin), cap = 100 * skin * vec2_length(u);
    return (vec2){0.5 * density * u.x * (sides * fabs(u.x) + cap), 0.5 * density * u.y * (sides * fabs(u.y) + cap)};
}

/* The floe's velocity by its equation of motion, from rest, in small steps. */
static vec3 drift(const ramp *current, const ramp *wind, double air_density, double time)
{
    double draught = 920.0 / 1025, dt = 5e-3;
    vec2 v = {0, 0};
    for (int i = 0; i < (int)(time / dt + 0.5); i++) {
        double t = (i + 0.5) * dt;
        vec2 water = drag(1025, 0.01, draught, vec2_sub(ramp_at(current, t), v));
        vec2 air = drag(air_density, 0.003, 1 - draught, vec2_sub(ramp_at(wind, t), v));
        v = vec2_add(v, vec2_scale(vec2_add(water, air), dt / 92000));
    }
    return vec3_make(v.x, v.y, 0);
}

static const ramp STILL = {{0, 0}, {0, 0}, 0, 0};

/* The floe's velocity at a time; a step is 0.05 s. */
static vec3 run_to(sea *k, double time)
{
    fram_error error = {0};
    while (k->w.clock.time[0] < time - 0.01)
        assert_ok(world_step(&k->ctx, &k->m, &k->w, &error), error);
    return k->w.bodies.velocity[k->w.floes.body[0]];
}

/* The floe follows a current that reverses. */
START_TEST(drift_turns_round)
{
    static const ramp reverses = {{0.3, 0}, {-0.3, 0}, 60, 80};
    sea k;
    fram_error error = {0};
    assert_ok(open_sea(&k, "current_file: series.csv, air_density: 0",
                       "time [s],x [m/s],y [m/s]\n0,0.3,0\n60,0.3,0\n80,-0.3,0\n", &error),
              error);
    for (int i = 1; i <= 4; i++) {
        vec3 v = run_to(&k, 40 * i);
        assert_vec3_close(v, drift(&reverses, &STILL, 0, 40 * i), 1e-3);
        ck_assert(i == 1 ? v.x > 0.1 : i < 4 || v.x < -0.1);
    }
    close_sea(&k);
}
END_TEST

/* A current that turns through a right angle; a wind that rises evenly. */
START_TEST(current_turns)
{
    static const ramp turns = {{0.4, 0}, {0, 0.4}, 0, 300}, rises = {{0, 0}, {0, -20}, 0, 50};
    sea k;
    fram_error error = {0};
    assert_ok(open_sea(&k, "current_file: series.csv", "y,time,x\n0,0,0.4\n0.4,300,0\n", &error), error);
    for (int i = 1; i <= 3; i++)
        assert_vec3_close(run_to(&k, 200 * i), drift(&turns, &STILL, 1.225, 200 * i), 1e-3);
    close_sea(&k);

    assert_ok(open_sea(&k, "wind_file: series.csv", "time,x,y\n0,0,0\n50,0,-20\n", &error), error);
    for (int i = 1; i <= 2; i++) {
        vec3 v = run_to(&k, 60 * i), expected = drift(&STILL, &rises, 1.225, 60 * i);
        assert_relative(v.y, expected.y, 1e-3);
        assert_absolute(v.x, 0, 1e-9);
    }
    close_sea(&k);
}
END_TEST

/* The floe feels the current half its draught down, .4488 m, be it the deeper the weaker. */
START_TEST(current_of_depth)
{
    for (int i = 0; i < 2; i++) {
        sea k;
        fram_error error = {0};
        assert_ok(open_sea(&k, i ? "current_profile_file: series.csv" : "current_file: series.csv",
                           i ? "depth,x,y\n0,0.4,0\n1,0,0\n" : "time,x,y\n0,0.4,0\n", &error),
                  error);
        double felt = i ? 0.4 * (1 - 0.5 * 920 / 1025) : 0.4;
        const ramp even = {.to = {felt, 0}};
        assert_relative(run_to(&k, 100).x, drift(&even, &STILL, 1.225, 100).x, 1e-3);
        close_sea(&k);
    }
}
END_TEST

START_TEST(wrong_files)
{
    static const struct {
        const char *environment, *series, *message;
        int line;
        const char *column;
    } cases[] = {
        {"current_file: series.csv", "time,x\n0,1\n", "column", 1, ""},
        {"current_file: series.csv", "time,x,y\n", "at least one row", 2, ""},
        {"current_file: series.csv", "time,x,y\n0,1,0\n0,2,0\n", "row before", 3, ""},
        {"wind_file: series.csv", "time,x,y\n0,nan,0\n", "finite", 2, "x[m/s]"},
        {"wind_file: series.csv", "time,x,y\n0,fast,0\n", "expected a number", 2, "x[m/s]"},
        {"current_file: series.csv", "time,x,y\n0,1,0\n5,0,-201\n", "at most 200 m/s, found -201", 3, "y[m/s]"},
        {"current_file: series.csv", "time,x,y\n\n0,1,0\n \t\n5,0,-201\n", "at most 200 m/s, found -201", 5, "y[m/s]"},
        {"current_file: series.csv", "time,x,y\n0,1,0\n\n\n0,2,0\n", "row before", 5, ""},
        {"wind_file: missing.csv", "", "expected a file that can be read", 5, ""},
        {"current_profile_file: series.csv", "depth,x,y\n-1,1,0\n", "0 or more, found -1", 2, "depth[m]"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        sea k;
        fram_error error = {0};
        ck_assert_int_ne(open_sea(&k, cases[i].environment, cases[i].series, &error), FRAM_OK);
        ck_assert_msg(strstr(error.message, cases[i].message) != NULL, "case %d: %s", (int)i, error.message);
        ck_assert_int_eq(error.line, cases[i].line);
        if (*cases[i].column)
            ck_assert_str_eq(error.key, cases[i].column);
        ck_assert(error.file[0]);
        scenario_free(&k.ctx, &k.s);
        scratch_remove_folder(k.folder);
    }
}
END_TEST

TEST_MAIN("media", drift_turns_round, current_turns, current_of_depth, wrong_files)
