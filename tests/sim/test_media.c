/* Current and wind from files: drift that turns round, and files that are wrong. */
#include "io/scenario_file.h"
#include "sim/build.h"
#include "sim/step.h"
#include "testing.h"

#include <stdio.h>
#include <unistd.h>

typedef struct sea {
    char folder[64];
    context ctx;
    scenario s;
    model m;
    world w;
} sea;

static void write_file(const sea *k, const char *name, const char *text)
{
    char path[128];
    snprintf(path, sizeof path, "%s/%s", k->folder, name);
    FILE *file = fopen(path, "w");
    ck_assert_ptr_nonnull(file);
    fputs(text, file);
    fclose(file);
}

static void remove_folder(const sea *k)
{
    static const char *const names[] = {"scene.yaml", "series.csv"};
    char path[128];
    for (int i = 0; i < 2; i++) {
        snprintf(path, sizeof path, "%s/%s", k->folder, names[i]);
        unlink(path);
    }
    rmdir(k->folder);
}

#define ONE_FLOE                                                                   \
    "run: {time_step: 0.05}\nvessel: {present: false}\n"                           \
    "domain: {boundary: open, x_min: -1e4, x_max: 1e4, y_min: -1e4, y_max: 1e4}\n" \
    "ice: {source: floes, floes: [{}]}\n"

static fram_status open_sea(sea *k, const char *environment, const char *series, fram_error *error)
{
    char text[1024], path[128];
    memset(k, 0, sizeof *k);
    context_init(&k->ctx);
    strcpy(k->folder, "/tmp/fram-media-XXXXXX");
    ck_assert_ptr_nonnull(mkdtemp(k->folder));
    snprintf(text, sizeof text, ONE_FLOE "environment: {%s}\n", environment);
    write_file(k, "scene.yaml", text);
    write_file(k, "series.csv", series);
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
    remove_folder(k);
}

/* One degree of freedom with the drag of bottom and sides, in small steps: the floe follows a current that reverses. */
static double drift(double time, double speed)
{
    double draught = 920.0 / 1025, area = 0.5 * 10 * draught + 0.5 * 0.01 * (100 + 2 * 10 * draught);
    double length = 92000 / (1025 * area), v = 0, dt = 1e-3;
    for (int i = 0; i < (int)(time / dt + 0.5); i++) {
        double t = i * dt, u = speed * (t < 60 ? 1 : t < 80 ? 1 - (t - 60) / 10 : -1) - v;
        v += dt * u * fabs(u) / length;
    }
    return v;
}

START_TEST(drift_turns_round)
{
    sea k;
    fram_error error = {0};
    assert_ok(open_sea(&k, "current_file: series.csv, air_density: 0",
                       "time [s],x [m/s],y [m/s]\n0,0.3,0\n60,0.3,0\n80,-0.3,0\n", &error),
              error);
    int32_t floe = k.w.floes.body[0];
    double seen[4];
    for (int i = 0; i < 3200; i++) {
        assert_ok(world_step(&k.ctx, &k.m, &k.w, &error), error);
        if (i % 800 == 799)
            seen[i / 800] = k.w.bodies.velocity[floe].x;
    }
    for (int i = 0; i < 4; i++)
        assert_absolute(seen[i], drift(40 * (i + 1), 0.3), 1e-3);
    ck_assert(seen[0] > 0.1 && seen[3] < -0.1);
    close_sea(&k);
}
END_TEST

/* A current that turns through a right angle; a wind that rises. */
START_TEST(current_turns)
{
    sea k;
    fram_error error = {0};
    assert_ok(open_sea(&k, "current_file: series.csv", "y,time,x\n0,0,0.4\n0.4,300,0\n", &error), error);
    int32_t floe = k.w.floes.body[0];
    for (int i = 0; i < 20 * 900; i++)
        assert_ok(world_step(&k.ctx, &k.m, &k.w, &error), error);
    assert_vec3_close(k.w.bodies.velocity[floe], vec3_make(0, 0.4, 0), 0.03);
    close_sea(&k);

    assert_ok(open_sea(&k, "wind_file: series.csv", "time,x,y\n0,0,0\n10,0,-20\n", &error), error);
    floe = k.w.floes.body[0];
    for (int i = 0; i < 20 * 60; i++)
        assert_ok(world_step(&k.ctx, &k.m, &k.w, &error), error);
    ck_assert(k.w.bodies.velocity[floe].y < -0.05);
    close_sea(&k);
}
END_TEST

/* The deeper current is the weaker: the floe drifts slower. */
START_TEST(current_of_depth)
{
    double speed[2];
    for (int i = 0; i < 2; i++) {
        sea k;
        fram_error error = {0};
        assert_ok(open_sea(&k, i ? "current_profile_file: series.csv" : "current_file: series.csv",
                           i ? "depth,x,y\n0,0.4,0\n1,0,0\n" : "time,x,y\n0,0.4,0\n", &error),
                  error);
        for (int n = 0; n < 20 * 100; n++)
            assert_ok(world_step(&k.ctx, &k.m, &k.w, &error), error);
        speed[i] = k.w.bodies.velocity[k.w.floes.body[0]].x;
        close_sea(&k);
    }
    /* Half the draught is .4488 m: 55 % of the current. */
    ck_assert_msg(speed[1] > 0.4 * speed[0] && speed[1] < 0.6 * speed[0], "%g and %g m/s", speed[0], speed[1]);
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
        {"current_profile_file: series.csv", "depth,x,y\n-1,1,0\n", "depths", 0, ""},
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
        remove_folder(&k);
    }
}
END_TEST

TEST_MAIN("media", drift_turns_round, current_turns, current_of_depth, wrong_files)
