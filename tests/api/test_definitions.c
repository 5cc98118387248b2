/* Programs that were built when definitions ended earlier: whatever the struct, a shorter one is taken with defaults
   for what it lacks, and one that is longer, or ends before its first member, is refused by name. */
#include "fram/field.h"
#include "fram/fmu.h"
#include "fram/hull.h"
#include "fram/ice.h"
#include "fram/live.h"
#include "fram/results.h"
#include "fram/statistics.h"
#include "testing.h"

static fram_error e;
static fram_context *ctx;
static fram_scenario *s;
static fram_hull *hull;

enum { SHORT = 2 * sizeof(size_t) }; /* the size and one member */

/* What a definition of these sizes gives: `same` for as much as the call needs, whatever stands behind the end. */
static void try_sizes(void *definition, size_t size, fram_status (*call)(const void *), const char *name)
{
    unsigned char whole[1024], cut[1024];
    ck_assert_uint_le(size + 8, sizeof whole);
    memcpy(whole, definition, size);
    fram_status expected = call(whole);
    fram_error said = e;
    memset(cut, 0x5a, sizeof cut);
    memcpy(cut, whole, SHORT);
    size_t shorter = SHORT, wrong[] = {0, 1, sizeof(size_t), size + 1, size + 8, SIZE_MAX};
    memcpy(cut, &shorter, sizeof shorter);
    fram_status status = call(cut);
    ck_assert_msg(status == expected && strcmp(e.message, said.message) == 0, "%s: %s instead of %s", name, e.message,
                  said.message);
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        memcpy(whole, &wrong[i], sizeof wrong[i]);
        ck_assert_int_eq(call(whole), FRAM_ERROR_USAGE);
        ck_assert_msg(strcmp(e.key, name) == 0, "%s is called %s", name, e.key);
    }
}

/* One call with each definition, as far as a missing file or the answer. */
#define CALL(function, ...)                           \
    static fram_status call_##function(const void *d) \
    {                                                 \
        e = (fram_error){0};                          \
        return function(__VA_ARGS__);                 \
    }
static const char nowhere[] = "/nowhere/at/all";
static fram_ice_breaking breaking;
static fram_ice_splitting splitting;
static fram_hull_floating floating;
static fram_hull *made;
static fram_field *field;
static fram_bench_result bench;
static fram_extremes extremes;
static fram_fatigue fatigue;
static fram_fmu_result unit;
static char *words;
CALL(fram_ice_break, d, &breaking, &e)
CALL(fram_ice_split, d, &splitting, &e)
CALL(fram_hull_load, ctx, nowhere, d, &made, &e)
CALL(fram_hull_float, hull, d, &floating, &e)
CALL(fram_field_load, ctx, nowhere, d, &field, &e)
CALL(fram_bench_scene, ctx, nowhere, d, &bench, &e)
CALL(fram_playback, ctx, d, NULL, &e)
CALL(fram_video, ctx, nowhere, d, NULL, &e)
CALL(fram_capability, s, d, NULL, &e)
CALL(fram_why, ctx, nowhere, d, &words, &e)
CALL(fram_manage, ctx, nowhere, d, NULL, &words, &e)
CALL(fram_pressure, ctx, nowhere, d, &e)
CALL(fram_extremes_find, ctx, d, &extremes, &e)
CALL(fram_fatigue_find, ctx, d, &fatigue, &e)
CALL(fram_fmu, s, d, &unit, &e)

#define TRY(type, fill, function, name)                                   \
    do {                                                                  \
        type definition;                                                  \
        memset(&definition, 0, sizeof definition);                        \
        fill(&definition);                                                \
        try_sizes(&definition, sizeof definition, call_##function, name); \
    } while (0)

static const char text[] = "run: {duration: 1}\n"
                           "vessel: {mode: free, hull: {length: 48, beam: 12, draught: 4, freeboard: 2}}\n"
                           "ice: {source: none}\n";

START_TEST(shorter_is_taken_and_longer_refused)
{
    fram_hull_particulars particulars;
    fram_hull_particulars_default(&particulars);
    assert_ok(fram_context_create(NULL, &ctx, &e), e);
    assert_ok(fram_scenario_parse(ctx, text, NULL, NULL, 0, &s, &e), e);
    particulars.length = 48, particulars.beam = 12, particulars.draught = 4, particulars.freeboard = 2;
    assert_ok(fram_hull_make(ctx, &particulars, &hull, &e), e);
    TRY(fram_ice_edge, fram_ice_edge_default, fram_ice_break, "fram_ice_edge");
    TRY(fram_ice_floe, fram_ice_floe_default, fram_ice_split, "fram_ice_floe");
    TRY(fram_hull_file_definition, fram_hull_file_default, fram_hull_load, "fram_hull_file");
    TRY(fram_hull_condition, fram_hull_condition_default, fram_hull_float, "fram_hull_condition");
    TRY(fram_field_definition, fram_field_default, fram_field_load, "fram_field");
    TRY(fram_bench_scene_definition, fram_bench_scene_default, fram_bench_scene, "fram_bench_scene");
    TRY(fram_playback_definition, fram_playback_default, fram_playback, "fram_playback");
    TRY(fram_video_definition, fram_video_default, fram_video, "fram_video");
    TRY(fram_capability_definition, fram_capability_default, fram_capability, "fram_capability");
    TRY(fram_why_definition, fram_why_default, fram_why, "fram_why");
    TRY(fram_manage_definition, fram_manage_default, fram_manage, "fram_manage");
    TRY(fram_pressure_definition, fram_pressure_default, fram_pressure, "fram_pressure");
    TRY(fram_extremes_definition, fram_extremes_default, fram_extremes_find, "fram_extremes");
    TRY(fram_fmu_definition, fram_fmu_default, fram_fmu, "fram_fmu");
    TRY(fram_fatigue_definition, fram_fatigue_default, fram_fatigue_find, "fram_fatigue");
    fram_hull_destroy(hull);
    fram_scenario_destroy(s);
    fram_context_destroy(ctx);
}
END_TEST

TEST_MAIN("definitions", shorter_is_taken_and_longer_refused)
