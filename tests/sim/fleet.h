/* Several vessels in one world, each with the ice of a scenario of its own: worlds that a scenario cannot ask for. */
#ifndef TEST_SIM_FLEET_H
#define TEST_SIM_FLEET_H

#include "scene.h"

#include "sim/build_ice.h"
#include "sim/build_vessel.h"

enum { FLEET_MOST = 2 };

typedef struct fleet {
    context ctx;
    scenario s[FLEET_MOST];
    int32_t count;
    model m;
    world w;
} fleet;

/* The vessel and the floes of each text, vessels first, in this order; method, water and seed are those of the first.
   list: more keys for each, may be NULL. */
static inline void fleet_open(fleet *f, const char *const *text, int32_t count, const scenario_overrides *list)
{
    fram_error error = {0};
    *f = (fleet){.count = count};
    context_init(&f->ctx);
    context *c = &f->ctx;
    for (int32_t i = 0; i < count; i++)
        assert_ok(scenario_parse(c, "scene.yaml", text[i], strlen(text[i]), list, &f->s[i], &error), error);
    assert_ok(build_method(c, &f->s[0], &f->m, &error), error);
    for (int32_t i = 0; i < count; i++) {
        vessel_entry entry = scenario_vessel_entry(&f->s[i], 0);
        assert_ok(build_vessel_model(c, &f->s[i], &entry, NULL, &f->m, &error), error);
    }
    assert_ok(world_init(c, &f->m, &f->w, &error), error);
    assert_ok(build_load_window(c, &f->s[0], count, &f->w, &error), error);
    vessel_pose_array put = {0};
    for (int32_t i = 0; i < count; i++) {
        vessel_entry entry = scenario_vessel_entry(&f->s[i], 0);
        assert_ok(build_vessel(c, &f->s[i], &entry, &f->m, &f->w, &put, &error), error);
    }
    array_free(c, &put);
    for (int32_t i = 0; i < count; i++) {
        field_report report;
        assert_ok(build_ice(c, &f->s[i], &f->w, &report, &error), error);
    }
}

static inline void fleet_step(fleet *f)
{
    fram_error error = {0};
    assert_ok(world_step(&f->ctx, &f->m, &f->w, &error), error);
}

static inline void fleet_close(fleet *f)
{
    world_free(&f->ctx, &f->w);
    model_free(&f->ctx, &f->m);
    for (int32_t i = 0; i < f->count; i++)
        scenario_free(&f->ctx, &f->s[i]);
}

#endif
