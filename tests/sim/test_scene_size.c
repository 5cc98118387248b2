/* The size of a scenario told before it is built: tiles and floes against those that are made, limits, no overflow. */
#include "scene.h"
#include "sim/scene_size.h"
#include "sim/series.h"

#define HOUSE "vessel: {present: false}\nrun: {duration: 1}\n"
#define PLAN "domain: {x_min: -100, x_max: 140, y_min: -80, y_max: 60, boundary: open}\n"
#define WIDE "domain: {x_min: -1e7, x_max: 1e7, y_min: -1e7, y_max: 1e7, boundary: open}\n"

static context ctx;
static fram_error error;

static void read_scenario(const char *text, scenario *s)
{
    context_init(&ctx);
    assert_ok(scenario_parse(&ctx, "scene.yaml", text, strlen(text), NULL, s, &error), error);
}

/* The estimate is within this part of what is made. */
START_TEST(floes_that_are_made)
{
    static const struct {
        const char *text;
        double part;
    } cases[] = {
        {HOUSE PLAN "ice: {source: level, level: {tile_size: 7}}\n", 0.03},
        {HOUSE PLAN "ice: {source: voronoi, concentration: 0.8, mean_floe_area: 100}\n", 0.05},
        {HOUSE PLAN "ice: {source: packed, concentration: 0.6, populations: [{size: uniform, diameter_min: 5, "
                    "diameter_max: 15}]}\n",
         0.05},
        {HOUSE PLAN "ice: {source: voronoi, concentration: 0.8, populations: [{size: lognormal, diameter: 9, "
                    "diameter_deviation: 3}]}\n",
         0.05},
        {HOUSE PLAN "ice: {source: packed, concentration: 0.6, populations: [{size: power, diameter_min: 8, "
                    "diameter_max: 30, exponent: 2}]}\n",
         0.05},
        {HOUSE PLAN "ice: {source: packed, concentration: 0.6, populations: [{size: uniform, diameter_min: 5, "
                    "diameter_max: 9, share: 30}, {size: uniform, diameter_min: 12, diameter_max: 15, share: 10}]}\n",
         0.05},
        {HOUSE PLAN "ice: {source: floes, floes: [{x: 0}, {x: 50}]}\n", 0},
        {HOUSE PLAN "ice: {source: none}\n", 0},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        scene k;
        scene_open(&k, cases[i].text);
        scene_size size = scene_size_of(&k.s);
        double made = k.w.floes.count;
        ck_assert_msg(fabs(size.floes - made) <= cases[i].part * made, "case %zu: %g floes expected, %g made", i,
                      size.floes, made);
        ck_assert(size.bytes > 1e7 && size.bytes < 1e8);
        ck_assert_ptr_null(size.uncounted);
        assert_bits(scene_size_made(&k.s, k.w.floes.count).bytes, size.bytes);
        assert_ok(scene_size_check(&k.s, &error), error);
        scene_close(&k);
    }
}
END_TEST

/* A field that is fed fills a tile, which is larger than the domain. */
START_TEST(a_tile_is_larger)
{
    scenario s;
    read_scenario(HOUSE PLAN "ice: {concentration: 0.8, mean_floe_area: 100}\n", &s);
    double open = scene_size_of(&s).floes;
    assert_relative(open, 240 * 140 / 100.0, 1e-12);
    s.domain.boundary = DOMAIN_FEEDING;
    assert_relative(scene_size_of(&s).floes, 1.25 * 240 * (140 + 60) / 100.0, 1e-12);
    scenario_free(&ctx, &s);
}
END_TEST

/* Floes of files are known when they are made. */
START_TEST(floes_that_are_not_counted)
{
    scenario s;
    read_scenario(HOUSE PLAN "ice: {source: packed, concentration: 0.8, populations: [{size: histogram, histogram: "
                             "none.csv}, {size: constant, diameter: 20}]}\n",
                  &s);
    scene_size counted = scene_size_of(&s), made = scene_size_made(&s, 1000);
    ck_assert_str_eq(counted.uncounted, "the floes of histograms");
    ck_assert(counted.floes > 0 && counted.floes < 1000);
    ck_assert_ptr_null(made.uncounted);
    assert_bits(made.floes, 1000);
    assert_relative((made.bytes - counted.bytes) / (1000 - counted.floes), 10e3, 1e-9);
    ck_assert(made.disk > counted.disk);
    assert_bits(scene_size_made(&s, 1).floes, counted.floes);
    s.ice.source = ICE_FILE;
    ck_assert_str_eq(scene_size_of(&s).uncounted, "the floes of its file and of histograms");
    scenario_free(&ctx, &s);
}
END_TEST

/* Columns of the series of a scenario, which must be as many as are told without making them. */
static double columns_of(const scenario *s)
{
    series_layout l;
    assert_ok(series_columns(&ctx, s, &l, &error), error);
    double count = l.columns.count;
    assert_bits(series_column_number(s), count);
    series_layout_free(&ctx, &l);
    return count;
}

/* Each vessel has its columns in series.csv, no row comes between two steps, and the record ends at its limit. */
START_TEST(a_folder_is_known_by_its_parts)
{
#define SHORT "run: {duration: 100, time_step: 0.1}\nice: {source: none}\n"
#define OFTEN "output: {csv_interval: 0.01, frame_interval: 1, picture_interval: 10}\n"
#define VESSEL(name, x) "{name: " name ", x: " x ", hull: {length: 48, beam: 12, draught: 4, freeboard: 2}}"
    static const char *const texts[] = {
        SHORT OFTEN, SHORT OFTEN
        "vessels: [" VESSEL("a", "0") ", " VESSEL("b", "40") ", " VESSEL("c", "80") ", " VESSEL("d", "120") "]\n"};
    scene_disk d[2];
    scenario s;
    double columns[2];
    for (int i = 0; i < 2; i++) {
        read_scenario(texts[i], &s);
        columns[i] = columns_of(&s);
        d[i] = scene_disk_of(&s, 50);
        assert_bits(d[i].all, d[i].rows + d[i].frames + d[i].checkpoints + d[i].pictures);
        /* A pose is 18 bytes, and some sixteen floes touch each vessel. */
        int vessels = i > 0 ? 4 : 1;
        assert_relative(d[i].frames, 101 * (104 + 18 * (50 + vessels) + 32 * 16), 1e-12);
        assert_relative(d[i].pictures - scene_disk_of(&s, 0).pictures, 11 * (2e5 - 2e4), 1e-12);
        s.output.record_limit = 0.05;
        assert_relative(scene_disk_of(&s, 50).frames, 0.05e6, 1e-12);
        scenario_free(&ctx, &s);
    }
    /* Of carried vessels in ice 7 bytes a number. */
    assert_relative(d[1].rows - d[0].rows, (columns[1] - columns[0]) * 1000 * 7, 1e-12);
    assert_bits(d[1].pictures, d[0].pictures);
    assert_bits(d[1].checkpoints, 2 * (15e3 + 1050 * 50));
    /* Forces of lines and thrusters stand in each frame. */
    read_scenario(SHORT OFTEN "vessel: {mode: free, thrusters: [{}, {}], mooring: {lines: [{count: 6}, {count: 4}]}}\n",
                  &s);
    assert_relative(scene_disk_of(&s, 0).frames, 101 * (104 + 18 + 32 * 12), 1e-12);
    /* A free vessel in ice fills its columns, of ten lines and two thrusters too: 8.5 bytes a number. */
    ck_assert(columns_of(&s) == columns[0] + 10 + 2 * 2);
    assert_relative(scene_disk_of(&s, 50).rows - scene_disk_of(&s, 0).rows, 1000 * (columns[0] + 14) * 3.5, 1e-9);
    scenario_free(&ctx, &s);
}
END_TEST

/* A sheet of automatic tiles in a wide domain: more cells than 32 bits number, and more memory than there is. */
START_TEST(what_is_too_large_is_refused)
{
    static const struct {
        const char *text, *key, *message;
    } cases[] = {
        {HOUSE WIDE "ice: {source: level, thickness: 0.001}\n", "ice.level.tile_size", "expected at most 2e+07 floes"},
        {HOUSE PLAN "ice: {source: level, level: {tile_size: 0.4}}\n", "ice.level.tile_size",
         "no smaller than ice.smallest_floe_area"},
        {HOUSE PLAN "ice: {source: level, smallest_floe_area: 1000}\n", "ice.smallest_floe_area",
         "no more than a tile of the sheet"},
        {"vessel: {present: false}\nrun: {memory_limit: 1}\n" WIDE "ice: {source: level, level: {tile_size: 25000}}\n",
         "ice.level.tile_size", "at most run.memory_limit, 1 GB, found about 1.295"},
        {HOUSE WIDE "ice: {source: voronoi, mean_floe_area: 1}\n", "ice.mean_floe_area", "found about 4e+14"},
        {HOUSE WIDE "ice: {source: packed, concentration: 0.5, populations: [{size: constant, diameter: 10000}]}\n",
         "ice.populations", "at most run.memory_limit, 16 GB, found about 25"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        scenario s;
        read_scenario(cases[i].text, &s);
        assert_fails(scene_size_check(&s, &error), error, FRAM_ERROR_INPUT, cases[i].message);
        ck_assert_str_eq(error.key, cases[i].key);
        world w;
        field_report report;
        const model none = {0};
        ck_assert_int_eq(build_world(&ctx, &s, &none, &w, &report, &error), FRAM_ERROR_INPUT);
        tile_grid g = build_fracture_settings(&s).tiles;
        ck_assert((int64_t)g.columns * g.rows <= INT32_MAX);
        scenario_free(&ctx, &s);
    }
}
END_TEST

TEST_MAIN("scene_size", floes_that_are_made, a_tile_is_larger, floes_that_are_not_counted,
          a_folder_is_known_by_its_parts, what_is_too_large_is_refused)
