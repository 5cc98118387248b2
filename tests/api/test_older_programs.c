/* Programs that were built when structs of results ended earlier: each function that fills one writes as much as the
   program's struct holds and nothing behind it, and refuses a size that no version had before it does anything. */
#include "fram/field.h"
#include "fram/fmu.h"
#include "fram/hull.h"
#include "fram/ice.h"
#include "fram/live.h"
#include "fram/results.h"
#include "fram/statistics.h"
#include "fram/study.h"
#include "scratch.h"

#include <stdio.h>

enum { CANARY = 0x5a, BEHIND = 64, LEAST = 8, ROWS = 4, LETTERS = 16 /* that every path here has */ };

static fram_error e;
static fram_context *ctx;
static fram_scenario *s;
static fram_world *w;
static fram_field *field, *rings;
static fram_hull *hull;
static fram_study *study;
static fram_body_id vessel;
static char folder[SCRATCH_FOLDER], run[260], live[260], unit[260], library[260], table[260], outlines[260], plan[260];

/* ---- one call of each function ---- */

/* Lets a function fill a struct, or a list of ROWS, of so many bytes each. */
typedef fram_status (*filler)(void *out, size_t size);
#define FILL(function, ...)                                    \
    static fram_status fill_##function(void *out, size_t size) \
    {                                                          \
        e = (fram_error){0};                                   \
        return (function)(__VA_ARGS__, &e, size);              \
    }
FILL(fram_body_state_get, w, vessel, out)
FILL(fram_world_ice_load, w, vessel, out)
FILL(fram_world_channel, w, 3, out)
FILL(fram_world_input, w, 3, out)
FILL(fram_world_view, w, out)
FILL(fram_hull_float, hull, NULL, out)
FILL(fram_hull_cut, hull, (double)NAN, 4, out)
FILL(fram_ice_wedge, 0.1, out)
FILL(fram_ice_sheet, 0.1, 0.3, out)
FILL(fram_bench, s, 0, 0.1, out)
FILL(fram_bench_scene, ctx, "/nowhere", NULL, out)
FILL(fram_export_vtk, ctx, run, NULL, 1, out)
FILL(fram_export_geojson, ctx, run, NULL, 0.1, out)
FILL(fram_export_netcdf, ctx, run, NULL, out)
FILL(fram_report, ctx, run, NULL, false, out)
FILL(fram_compare, ctx, run, run, NULL, out)
FILL(fram_playback, ctx, NULL, out)
FILL(fram_video, ctx, run, NULL, out)
FILL(fram_capability, s, NULL, out)
FILL(fram_field_population_get, field, 0, out)
FILL(fram_study_measure, study, out)

/* Functions without an error: what cannot be is not filled. */
#define FILL_SILENT(function, type, ...)                                            \
    static fram_status fill_##function(void *out, size_t size)                      \
    {                                                                               \
        e = (fram_error){.key = type};                                              \
        (void)(function)(__VA_ARGS__, size);                                        \
        const unsigned char *byte = out;                                            \
        return byte[0] == CANARY && byte[1] == CANARY ? FRAM_ERROR_USAGE : FRAM_OK; \
    }
FILL_SILENT(fram_field_summary_get, "fram_field_summary", field, out)
FILL_SILENT(fram_field_making_get, "fram_field_making", field, out)
FILL_SILENT(fram_hull_surface_get, "fram_hull_surface", hull, out)
FILL_SILENT(fram_field_notes, "fram_field_note", rings, out, ROWS)
FILL_SILENT(fram_world_contacts, "fram_contact", w, out, ROWS)
FILL_SILENT(fram_world_fractures, "fram_fracture", w, out, ROWS)

/* Those with a definition. */
#define FILL_BY(function, definition, defaults, set, ...)      \
    static fram_status fill_##function(void *out, size_t size) \
    {                                                          \
        definition d;                                          \
        defaults(&d);                                          \
        set;                                                   \
        return (function)(__VA_ARGS__, &e, size);              \
    }
static char *words;
static const char *const tables[] = {table};
FILL_BY(fram_ice_break, fram_ice_edge, fram_ice_edge_default, d.force = 1e5, &d, out)
FILL_BY(fram_ice_split, fram_ice_floe, fram_ice_floe_default, (void)0, &d, out)
FILL_BY(fram_run, fram_run_definition, fram_run_default, (d.folder = run, d.force = true), s, &d, out)
FILL_BY(fram_resume, fram_run_definition, fram_run_default, d.folder = run, ctx, &d, out)
FILL_BY(fram_manage, fram_manage_definition, fram_manage_default, (void)0, ctx, run, &d, out, &words)
FILL_BY(fram_fmu, fram_fmu_definition, fram_fmu_default, (d.output = unit, d.binary = library), s, &d, out)
FILL_BY(fram_study_run, fram_study_definition, fram_study_default, d.folder = folder, study, &d, out)
FILL_BY(fram_extremes_find, fram_extremes_definition, fram_extremes_default,
        (d.source.files = tables, d.source.file_count = 1, d.source.channel = "x", d.method = "pot"), ctx, &d, out)
FILL_BY(fram_fatigue_find, fram_fatigue_definition, fram_fatigue_default,
        (d.source.files = tables, d.source.file_count = 1, d.source.channel = "x"), ctx, &d, out)

/* The recording that a call with a good size ends; what is refused leaves it. */
static fram_world *recorded;
static fram_status fill_fram_world_record_end(void *out, size_t size)
{
    fram_record_definition d;
    fram_record_default(&d);
    d.folder = live;
    d.force = true;
    if (!fram_world_is_recorded(recorded))
        assert_ok(fram_world_record(recorded, &d, &e), e);
    fram_status status = (fram_world_record_end)(recorded, out, &e, size);
    ck_assert(fram_world_is_recorded(recorded) == (status != FRAM_OK));
    return status;
}

/* ---- all of them ---- */

/* A struct of this version, and how much of it is the same in each call; 0: this test does not get it filled, since
   that takes minutes or parts that a build may lack, and looks at what is refused. */
typedef struct function_row {
    const char *type;
    filler fill;
    size_t size, same;
    int rows;
    struct {
        size_t from, to;
    } gap[4]; /* bytes between and behind members, which hold whatever was there */
} function_row;
#define GAP(type, member, next)                                                    \
    {                                                                              \
        offsetof(type, member) + sizeof(((type *)0)->member), offsetof(type, next) \
    }
#define GAP_AT_END(type, member)                                           \
    {                                                                      \
        offsetof(type, member) + sizeof(((type *)0)->member), sizeof(type) \
    }
#define ROW(function, type, same, ...)                                 \
    {                                                                  \
#type, fill_##function, sizeof(type), same, 1, { __VA_ARGS__ } \
    }
#define WHOLE(function, type, ...)                                             \
    {                                                                          \
#type, fill_##function, sizeof(type), sizeof(type), 1, { __VA_ARGS__ } \
    }
#define LIST(function, type, ...)                                                 \
    {                                                                             \
#type, fill_##function, sizeof(type), sizeof(type), ROWS, { __VA_ARGS__ } \
    }
#define NO_GAP \
    {          \
        0, 0   \
    }
static const function_row functions[] = {
    WHOLE(fram_body_state_get, fram_body_state, GAP(fram_body_state, dynamic, mass)),
    WHOLE(fram_world_ice_load, fram_ice_load, GAP_AT_END(fram_ice_load, contacts)),
    WHOLE(fram_world_channel, fram_channel, GAP(fram_channel, index, name)),
    WHOLE(fram_world_input, fram_channel, GAP(fram_channel, index, name)),
    WHOLE(fram_world_view, fram_body_view, GAP(fram_body_view, slots, position)),
    LIST(fram_world_contacts, fram_contact, GAP_AT_END(fram_contact, capped)),
    LIST(fram_world_fractures, fram_fracture, NO_GAP),
    ROW(fram_world_record_end, fram_run_result, offsetof(fram_run_result, wall), NO_GAP),
    ROW(fram_run, fram_run_result, offsetof(fram_run_result, wall), NO_GAP),
    ROW(fram_resume, fram_run_result, offsetof(fram_run_result, wall), NO_GAP),
    ROW(fram_bench, fram_bench_result, offsetof(fram_bench_result, ms_per_step_median),
        GAP(fram_bench_result, floes, ms_per_step_median)),
    ROW(fram_bench_scene, fram_bench_result, 0, NO_GAP),
    ROW(fram_playback, fram_playback_result, 0, NO_GAP),
    WHOLE(fram_hull_surface_get, fram_hull_surface, GAP(fram_hull_surface, mirrored_y, triangles),
          GAP(fram_hull_surface, vertices, lo), GAP(fram_hull_surface, splits, crack_width),
          GAP_AT_END(fram_hull_surface, flipped)),
    WHOLE(fram_hull_float, fram_hull_floating, GAP(fram_hull_floating, stable, volume)),
    WHOLE(fram_hull_cut, fram_hull_pieces, GAP(fram_hull_pieces, count, tolerance)),
    WHOLE(fram_ice_wedge, fram_ice_wedge_result, NO_GAP),
    WHOLE(fram_ice_sheet, fram_ice_sheet_result, NO_GAP),
    WHOLE(fram_ice_break, fram_ice_breaking, NO_GAP),
    WHOLE(fram_ice_split, fram_ice_splitting, NO_GAP),
    WHOLE(fram_field_summary_get, fram_field_summary, GAP(fram_field_summary, overlaps, overlap_area),
          GAP_AT_END(fram_field_summary, overlap_polygons)),
    WHOLE(fram_field_making_get, fram_field_making, GAP(fram_field_making, tile, tile_x)),
    WHOLE(fram_field_population_get, fram_field_population, GAP(fram_field_population, floes, area)),
    LIST(fram_field_notes, fram_field_note, GAP(fram_field_note, dropped, reason),
         GAP_AT_END(fram_field_note, outside)),
    ROW(fram_export_vtk, fram_result, LETTERS, NO_GAP),
    ROW(fram_export_geojson, fram_result, LETTERS, NO_GAP),
    ROW(fram_export_netcdf, fram_result, 0, NO_GAP),
    ROW(fram_report, fram_result, 0, NO_GAP),
    ROW(fram_video, fram_result, 0, NO_GAP),
    ROW(fram_manage, fram_result, 0, NO_GAP),
    ROW(fram_capability, fram_result, 0, NO_GAP),
    WHOLE(fram_fmu, fram_fmu_result, NO_GAP),
    ROW(fram_study_measure, fram_study_extent, offsetof(fram_study_extent, run_seconds),
        GAP(fram_study_extent, conditions, runs_least)),
    ROW(fram_study_run, fram_study_result, 0, NO_GAP),
    ROW(fram_extremes_find, fram_extremes, offsetof(fram_series_facts, unit), NO_GAP),
    /* What is freed by a function of its own stands to its end in every version: only refused when shorter. */
    ROW(fram_compare, fram_comparison, 0, NO_GAP),
    ROW(fram_fatigue_find, fram_fatigue, 0, NO_GAP),
};

static _Alignas(max_align_t) unsigned char whole[ROWS * sizeof(fram_extremes) + BEHIND], cut[sizeof whole];

static fram_status fill_clean(const function_row *f, unsigned char *out, size_t size)
{
    memset(out, CANARY, sizeof whole);
    return f->fill(out, size);
}

/* The first byte from..to of what was filled that the canary left; `to` without one.  (An assertion a byte takes long.)
 */
static size_t first_written(size_t from, size_t to)
{
    while (from < to && cut[from] == CANARY)
        from++;
    return from;
}

static bool is_in_gap(const function_row *f, size_t at)
{
    bool is = false;
    for (size_t i = 0; i < sizeof f->gap / sizeof *f->gap; i++)
        is = is || (at >= f->gap[i].from && at < f->gap[i].to);
    return is;
}

/* The first byte of a row that is not as in the whole struct; `size` without one. */
static size_t first_other(const function_row *f, int row, size_t size)
{
    const unsigned char *from = whole + (size_t)row * f->size, *to = cut + (size_t)row * size;
    for (size_t at = 0; at < size && at < f->same; at++)
        if (to[at] != from[at] && !is_in_gap(f, at))
            return at;
    return size;
}

/* A struct of `size` bytes: what is in it is what the whole one holds, what is behind it is not touched. */
static void try_shorter(const function_row *f, size_t size)
{
    ck_assert_msg(fill_clean(f, cut, size) == FRAM_OK, "%s of %zu bytes: %s", f->type, size, e.message);
    for (int row = 0; row < f->rows; row++)
        ck_assert_msg(first_other(f, row, size) == size, "%s of %zu bytes: row %d, byte %zu", f->type, size, row,
                      first_other(f, row, size));
    size_t end = (size_t)f->rows * size, written = first_written(end, end + BEHIND);
    ck_assert_msg(written == end + BEHIND, "%s of %zu bytes: byte %zu was written", f->type, size, written);
}

static void refuse(const function_row *f, size_t size)
{
    fram_status status = fill_clean(f, cut, size);
    ck_assert_msg(status == FRAM_ERROR_USAGE && strcmp(e.key, f->type) == 0, "%s of %zu bytes: %s, %s", f->type, size,
                  fram_status_name(status), e.key);
    size_t written = first_written(0, sizeof cut);
    ck_assert_msg(written == sizeof cut, "%s of %zu bytes: byte %zu was written", f->type, size, written);
}

/* Rows of a list that there are. */
static int filled_rows(const function_row *f)
{
    int rows = 0;
    for (int row = 0; row < f->rows; row++)
        for (size_t at = 0; at < f->size && rows <= row; at++)
            rows = whole[(size_t)row * f->size + at] != CANARY ? row + 1 : rows;
    return rows;
}

static void try_function(function_row f)
{
    const size_t wrong[] = {0,          1,          LEAST - 4,  LEAST + 1,    f.size - 1,   f.size + 1,
                            f.size + 4, f.size + 8, 2 * f.size, SIZE_MAX / 2, SIZE_MAX - 3, SIZE_MAX};
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++)
        refuse(&f, wrong[i]);
    if (f.same == 0)
        return;
    ck_assert_msg(fill_clean(&f, whole, f.size) == FRAM_OK, "%s: %s", f.type, e.message);
    f.rows = filled_rows(&f);
    ck_assert_int_gt(f.rows, 0);
    size_t half = f.size / 8 * 4, sizes[] = {LEAST, half > LEAST ? half : LEAST, f.size - 4};
    for (size_t i = f.same == f.size ? 0 : 1; i < sizeof sizes / sizeof *sizes; i++) /* fewer where a call takes long */
        try_shorter(&f, sizes[i]);
}

/* ---- the stage ---- */

static const char scene[] = "run: {duration: 0.1, time_step: 0.02}\n"
                            "vessel:\n  mode: towed\n  x: -26\n  speed: 3\n  ramp: 0.1\n"
                            "  hull: {length: 48, beam: 12, draught: 4, freeboard: 2}\n"
                            "ice:\n  source: floes\n  thickness: 0.5\n  breakable: true\n  floes:\n"
                            "    - {length: 40, width: 40, x: 20.5, y: 20.5, fixed: true}\n"
                            "    - {length: 40, width: 20, x: 20.5, y: -11}\n"
                            "domain: {x_min: -64, x_max: 64, y_min: -40, y_max: 44}\n"
                            "output: {frame_interval: 0.1}\n";
static const char drawn[] = "vessel: {present: false}\n"
                            "ice: {source: packed, concentration: 0.3, populations: [{size: constant, diameter: 8}]}\n"
                            "domain: {x_min: -20, x_max: 20, y_min: -20, y_max: 20}\n";

static void name_files(void)
{
    scratch_folder(folder);
    snprintf(run, sizeof run, "%s/run", folder);
    snprintf(live, sizeof live, "%s/live", folder);
    snprintf(unit, sizeof unit, "%s/ship.fmu", folder);
    snprintf(library, sizeof library, "%s/library.so", folder);
    snprintf(table, sizeof table, "%s/table.csv", folder);
    snprintf(outlines, sizeof outlines, "%s/outlines.txt", folder);
    snprintf(plan, sizeof plan, "%s/study.yaml", folder);
}

static void write_files(void)
{
    char floe[260];
    snprintf(floe, sizeof floe, "%s/floe.yaml", folder);
    scratch_text(floe, "run: {duration: 0.2, time_step: 0.02}\nice: {source: floes, floes: [{length: 9, width: 9}]}\n");
    scratch_text(library, "\177ELF fmi2Instantiate"); /* what a unit packs is told by that */
    scratch_text(plan, "scenario: floe.yaml\nseeds: 2\nvary: {grid: {ice.thickness: [0.5, 1]}}\n");
    /* A floe, and two rings that cross themselves. */
    scratch_text(outlines, "0 0\n10 0\n10 10\n0 10\n0 0\n\n20 0\n30 10\n30 0\n20 10\n20 0\n\n"
                           "40 0\n50 10\n50 0\n40 10\n40 0\n");
    FILE *file = fopen(table, "w");
    ck_assert_ptr_nonnull(file);
    fputs("time,x\n", file);
    for (int i = 0; i < 400; i++)
        fprintf(file, "%d,%d\n", i, i * 37 % 101);
    ck_assert_int_eq(fclose(file), 0);
}

static void open_stage(void)
{
    fram_scenario *ice;
    fram_field_definition d;
    fram_hull_particulars p;
    name_files();
    write_files();
    assert_ok(fram_context_create(NULL, &ctx, &e), e);
    assert_ok(fram_scenario_parse(ctx, scene, NULL, NULL, 0, &s, &e), e);
    assert_ok(fram_world_create(s, &w, &e), e);
    assert_ok(fram_world_copy(w, &recorded, &e), e);
    for (int i = 0; i < 100 && (fram_world_fractures(w, NULL, 0) == 0 || fram_world_contacts(w, NULL, 0) == 0); i++)
        assert_ok(fram_world_step(w, &e), e);
    ck_assert(fram_world_vessel(w, &vessel));
    assert_ok(fram_scenario_parse(ctx, drawn, NULL, NULL, 0, &ice, &e), e);
    assert_ok(fram_field_generate(ice, &field, &e), e);
    fram_scenario_destroy(ice);
    fram_field_default(&d);
    d.bad = FRAM_FIELD_DROP;
    assert_ok(fram_field_load(ctx, outlines, &d, &rings, &e), e);
    fram_hull_particulars_default(&p);
    p.box = true;
    assert_ok(fram_hull_make(ctx, &p, &hull, &e), e);
    assert_ok(fram_study_load(ctx, plan, &study, &e), e);
}

static void close_stage(void)
{
    fram_study_destroy(study);
    fram_hull_destroy(hull);
    fram_field_destroy(rings);
    fram_field_destroy(field);
    fram_world_destroy(recorded);
    fram_world_destroy(w);
    fram_scenario_destroy(s);
    fram_context_destroy(ctx);
    scratch_remove_folder(folder);
}

START_TEST(results_are_written_as_far_as_the_program_s_struct_goes)
{
    open_stage();
    for (size_t i = 0; i < sizeof functions / sizeof *functions; i++)
        try_function(functions[i]);
    close_stage();
}
END_TEST

/* Arrays to be filled are told in a struct, which may be shorter too: what it lacks is not asked for. */
START_TEST(arrays_of_older_programs_are_filled)
{
    open_stage();
    fram_body_id id[8];
    double position[24];
    memset(position, 0, sizeof position);
    fram_body_arrays a = {.room = 8, .id = id, .position = position};
    size_t older = offsetof(fram_body_arrays, position), wrong[] = {0, 4, older + 2, sizeof a + 8, SIZE_MAX};
    int count = fram_world_bodies(w, 0, &a);
    ck_assert(count >= 3 && position[3] != 0);
    memset(position, 0, sizeof position);
    memset(id, CANARY, sizeof id);
    ck_assert_int_eq((fram_world_bodies)(w, 0, &a, older), count);
    ck_assert(id[0].slot == 0 && position[3] == 0);
    memset(id, CANARY, sizeof id);
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        ck_assert_int_eq((fram_world_bodies)(w, 0, &a, wrong[i]), 0);
        ck_assert_int_eq(((unsigned char *)id)[0], CANARY);
    }
    close_stage();
}
END_TEST

/* What a function gives to be freed, and the free function, go by the same size. */
START_TEST(what_is_freed_is_told_its_size_too)
{
    open_stage();
    fram_fatigue cycles;
    fram_comparison comparison;
    assert_ok(fill_fram_run(NULL, 0), e); /* where a result may be NULL its size does not matter */
    assert_ok(fill_fram_fatigue_find(&cycles, sizeof cycles), e);
    assert_ok(fill_fram_compare(&comparison, sizeof comparison), e);
    ck_assert(cycles.list && comparison.count > 0);
    (fram_fatigue_free)(ctx, &cycles, 16);
    (fram_comparison_free)(ctx, &comparison, SIZE_MAX);
    ck_assert(cycles.list && comparison.rows); /* another size: not touched */
    fram_fatigue_free(ctx, &cycles);
    fram_comparison_free(ctx, &comparison);
    ck_assert(!cycles.list && !comparison.rows);
    close_stage();
}
END_TEST

TEST_MAIN("older_programs", results_are_written_as_far_as_the_program_s_struct_goes,
          arrays_of_older_programs_are_filled, what_is_freed_is_told_its_size_too)
