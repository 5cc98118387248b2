/* Programs that were built when definitions ended earlier: whatever the struct, a shorter one is taken with defaults
   for what it lacks, and one that is longer, or ends before its first member, is refused by name. */
#include "fram/field.h"
#include "fram/fmu.h"
#include "fram/hull.h"
#include "fram/ice.h"
#include "fram/live.h"
#include "fram/results.h"
#include "fram/statistics.h"
#include "fram/study.h"
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

/* ---- defaults ---- */

/* What each default function writes of a struct of `size` bytes. */
typedef void (*default_function)(void *definition, size_t size);
#define DEFAULT(name, type) \
    static void give_##name(void *definition, size_t size) { (name##_default)((type *)definition, size); }
DEFAULT(fram_field, fram_field_definition)
DEFAULT(fram_fmu, fram_fmu_definition)
DEFAULT(fram_context, fram_context_definition)
DEFAULT(fram_run, fram_run_definition)
DEFAULT(fram_playback, fram_playback_definition)
DEFAULT(fram_bench_scene, fram_bench_scene_definition)
DEFAULT(fram_hull_file, fram_hull_file_definition)
DEFAULT(fram_hull_particulars, fram_hull_particulars)
DEFAULT(fram_hull_condition, fram_hull_condition)
DEFAULT(fram_ice_edge, fram_ice_edge)
DEFAULT(fram_ice_floe, fram_ice_floe)
DEFAULT(fram_record, fram_record_definition)
DEFAULT(fram_video, fram_video_definition)
DEFAULT(fram_manage, fram_manage_definition)
DEFAULT(fram_why, fram_why_definition)
DEFAULT(fram_pressure, fram_pressure_definition)
DEFAULT(fram_capability, fram_capability_definition)
DEFAULT(fram_extremes, fram_extremes_definition)
DEFAULT(fram_fatigue, fram_fatigue_definition)
DEFAULT(fram_study, fram_study_definition)

static const struct {
    const char *name;
    default_function give;
    size_t size;
} all_defaults[] = {
    {"fram_field", give_fram_field, sizeof(fram_field_definition)},
    {"fram_fmu", give_fram_fmu, sizeof(fram_fmu_definition)},
    {"fram_context", give_fram_context, sizeof(fram_context_definition)},
    {"fram_run", give_fram_run, sizeof(fram_run_definition)},
    {"fram_playback", give_fram_playback, sizeof(fram_playback_definition)},
    {"fram_bench_scene", give_fram_bench_scene, sizeof(fram_bench_scene_definition)},
    {"fram_hull_file", give_fram_hull_file, sizeof(fram_hull_file_definition)},
    {"fram_hull_particulars", give_fram_hull_particulars, sizeof(fram_hull_particulars)},
    {"fram_hull_condition", give_fram_hull_condition, sizeof(fram_hull_condition)},
    {"fram_ice_edge", give_fram_ice_edge, sizeof(fram_ice_edge)},
    {"fram_ice_floe", give_fram_ice_floe, sizeof(fram_ice_floe)},
    {"fram_record", give_fram_record, sizeof(fram_record_definition)},
    {"fram_video", give_fram_video, sizeof(fram_video_definition)},
    {"fram_manage", give_fram_manage, sizeof(fram_manage_definition)},
    {"fram_why", give_fram_why, sizeof(fram_why_definition)},
    {"fram_pressure", give_fram_pressure, sizeof(fram_pressure_definition)},
    {"fram_capability", give_fram_capability, sizeof(fram_capability_definition)},
    {"fram_extremes", give_fram_extremes, sizeof(fram_extremes_definition)},
    {"fram_fatigue", give_fram_fatigue, sizeof(fram_fatigue_definition)},
    {"fram_study", give_fram_study, sizeof(fram_study_definition)},
};

/* Bytes between members are whatever was there: the same on a stack that was written over before each call. */
__attribute__((noinline)) static void overwrite_stack(void)
{
    volatile unsigned char stack[8192];
    for (size_t i = 0; i < sizeof stack; i++)
        stack[i] = 0xa5;
}

/* A program whose struct is shorter, or longer, than the library's: nothing is written beyond its end. */
START_TEST(defaults_are_written_as_far_as_the_program_s_struct_goes)
{
    for (size_t i = 0; i < sizeof all_defaults / sizeof *all_defaults; i++) {
        const char *name = all_defaults[i].name;
        size_t full = all_defaults[i].size, found, sizes[] = {sizeof(size_t), SHORT, full - 8, full, full + 24};
        _Alignas(max_align_t) unsigned char whole[1024], own[1024];
        ck_assert_uint_le(full + 64, sizeof whole);
        overwrite_stack();
        all_defaults[i].give(whole, full);
        for (size_t k = 0; k < sizeof sizes / sizeof *sizes; k++) {
            size_t size = sizes[k], same = size < full ? size : full;
            memset(own, 0x5a, sizeof own);
            overwrite_stack();
            all_defaults[i].give(own, size);
            memcpy(&found, own, sizeof found);
            ck_assert_uint_eq(found, size);
            ck_assert_msg(memcmp(own + sizeof size, whole + sizeof size, same - sizeof size) == 0, "%s", name);
            for (size_t at = same; at < size; at++)
                ck_assert_msg(own[at] == 0, "%s: rubbish behind what the library knows", name);
            for (size_t at = size; at < size + 32; at++)
                ck_assert_msg(own[at] == 0x5a, "%s: byte %zu of a struct of %zu was written", name, at, size);
        }
        all_defaults[i].give(NULL, full);
        memset(own, 0x5a, sizeof own);
        all_defaults[i].give(own, sizeof(size_t) - 1);
        ck_assert_int_eq(own[0], 0x5a);
    }
}
END_TEST

TEST_MAIN("definitions", defaults_are_written_as_far_as_the_program_s_struct_goes, shorter_is_taken_and_longer_refused)
