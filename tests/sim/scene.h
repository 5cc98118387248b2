/* Scenes for tests of sim: a scenario from text, a world made from it and stepped. */
#ifndef TEST_SIM_SCENE_H
#define TEST_SIM_SCENE_H

#include "io/scenario_file.h"
#include "sim/build.h"
#include "sim/series.h"
#include "sim/step.h"
#include "testing.h"

/* Model and world of a scenario; neither is left after a failure. */
static inline fram_status scene_build(context *ctx, const scenario *s, model *m, world *w, fram_error *error)
{
    field_report report;
    fram_status status = build_model(ctx, s, m, error);
    if (status != FRAM_OK)
        return status;
    status = build_world(ctx, s, m, w, &report, error);
    if (status != FRAM_OK)
        model_free(ctx, m);
    return status;
}

typedef struct scene {
    context ctx;
    scenario s;
    model m;
    world w;
} scene;

static inline void scene_open_with(scene *k, const char *text, const char *const *overrides, int count)
{
    fram_error error = {0};
    const scenario_overrides list = {overrides, count};
    context_init(&k->ctx);
    assert_ok(scenario_parse(&k->ctx, "scene.yaml", text, strlen(text), &list, &k->s, &error), error);
    assert_ok(scene_build(&k->ctx, &k->s, &k->m, &k->w, &error), error);
}

static inline void scene_open(scene *k, const char *text) { scene_open_with(k, text, NULL, 0); }

static inline void scene_steps(scene *k, int64_t steps)
{
    fram_error error = {0};
    for (int64_t i = 0; i < steps; i++)
        assert_ok(world_step(&k->ctx, &k->m, &k->w, &error), error);
}

/* A velocity from outside, INPUT_WIND to INPUT_DRIFT. */
static inline void scene_tell(scene *k, input_kind kind, double x, double y)
{
    ck_assert(input_tell(&k->ctx, &k->w.inputs, kind, 0, x) && input_tell(&k->ctx, &k->w.inputs, kind, 1, y));
}

static inline void scene_close(scene *k)
{
    world_free(&k->ctx, &k->w);
    model_free(&k->ctx, &k->m);
    scenario_free(&k->ctx, &k->s);
}

/* Body slot of the n-th floe. */
static inline int32_t scene_floe(const scene *k, int32_t n) { return k->w.floes.body[n]; }

/* Mass of all floes, moving or not [kg]. */
static inline double scene_ice_mass(const scene *k)
{
    double sum = 0;
    for (int32_t i = 0; i < k->w.floes.count; i++)
        if (k->w.floes.body[i] >= 0)
            sum += k->w.bodies.mass[k->w.floes.body[i]];
    return sum;
}

/* A row of the series as recorded; to be {0} at first. */
typedef struct scene_row {
    series_layout layout;
    double value[400];
} scene_row;

static inline void scene_take(scene *k, scene_row *r)
{
    fram_error error = {0};
    series_layout_free(&k->ctx, &r->layout); /* of the last row, or nothing */
    assert_ok(series_columns(&k->ctx, &k->s, &r->layout, &error), error);
    ck_assert_int_le(r->layout.columns.count, 400);
    series_row(&k->ctx, &r->layout, &k->w, 0, r->value);
}

static inline double scene_channel(const scene_row *r, const char *name)
{
    for (int32_t i = 0; i < r->layout.columns.count; i++)
        if (strcmp(r->layout.columns.data[i].name, name) == 0)
            return r->value[i];
    ck_abort_msg("no channel %s", name);
}

/* That the scenario is refused, by its reader or as it is built, with the key at fault. */
static inline void check_refusal(const char *text, const char *const *overrides, int count, const char *key)
{
    context ctx;
    scenario s = {0};
    world w;
    model m;
    fram_error error = {0};
    const scenario_overrides list = {overrides, count};
    context_init(&ctx);
    fram_status status = scenario_parse(&ctx, "scene.yaml", text, strlen(text), &list, &s, &error);
    if (status == FRAM_OK)
        status = scene_build(&ctx, &s, &m, &w, &error);
    ck_assert_int_eq(status, FRAM_ERROR_INPUT);
    ck_assert_str_eq(error.key, key);
    scenario_free(&ctx, &s);
}

#endif
