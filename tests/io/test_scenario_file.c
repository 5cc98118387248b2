/* io/scenario_file: reading, overrides, limits, printing and reading again, hash, reference. */
#include "base/random.h"
#include "io/file.h"
#include "io/scenario_file.h"
#include "model/scenario_schema.h"
#include "testing.h"
#include <stdio.h>
#include <unistd.h>

static context ctx;
static fram_error error;

static fram_status parse_text(const char *text, const scenario_overrides *overrides, scenario *s)
{
    context_init(&ctx);
    memset(&error, 0, sizeof error);
    return scenario_parse(&ctx, "dir/test.yaml", text, strlen(text), overrides, s, &error);
}

static const char example[] = "title: \"Größe: 3 \\\"m\\\" # no comment\"\n"
                              "run:\n"
                              "  duration: 12.5\n"
                              "  seed: 42\n"
                              "  scale: 16\n"
                              "  solver:\n"
                              "    kind: accurate\n"
                              "    warm_start: false\n"
                              "vessel:\n"
                              "  mode: free\n"
                              "  mass: 1.5e7\n"
                              "  hull:\n"
                              "    form: file\n"
                              "    file: hulls/a.stl\n"
                              "ice:\n"
                              "  source: floes\n"
                              "  thickness: 0.1\n"
                              "  floes:\n"
                              "    - x: 0.1\n"
                              "      yaw_deg: 30\n"
                              "    - shape: regular\n"
                              "      sides: 5\n"
                              "      thickness: 0.3333333333333333\n";

static void print_to(const scenario *s, bool comments, text_buffer *out)
{
    const scenario_print_options options = {.comments = comments};
    assert_ok(scenario_print(&ctx, s, &options, out, &error), error);
}

/* A floe with every key at its default. */
static scenario_floe a_floe(void)
{
    const scenario_section *ice = scenario_schema.keys[section_find(&scenario_schema, "ice")].section;
    scenario_floe floe = {0};
    section_defaults(ice->keys[section_find(ice, "floes")].section, &floe, 30);
    return floe;
}

START_TEST(values_arrive)
{
    scenario s;
    assert_ok(parse_text(example, NULL, &s), error);
    ck_assert_str_eq(s.title, "Größe: 3 \"m\" # no comment");
    assert_bits(s.run.duration, 12.5);
    ck_assert_int_eq(s.run.seed, 42);
    ck_assert_int_eq(s.run.solver.kind, SOLVER_ACCURATE);
    ck_assert(!s.run.solver.warm_start);
    ck_assert_int_eq(s.vessel.mode, VESSEL_FREE);
    assert_bits(s.vessel.mass, 1.5e7);
    ck_assert(is_automatic(s.vessel.gyration_roll));
    ck_assert_str_eq(s.vessel.hull.file, "hulls/a.stl");
    ck_assert_int_eq(s.ice.floes.count, 2);
    assert_bits(s.ice.floes.data[0].x, 0.1);
    ck_assert(is_automatic(s.ice.floes.data[0].thickness));
    ck_assert_int_eq(s.ice.floes.data[1].shape, FLOE_REGULAR);
    ck_assert_int_eq(s.ice.floes.data[1].sides, 5);
    assert_bits(s.ice.floes.data[1].thickness, 0.3333333333333333);
    /* Not given: defaults, those with a scale at 16. */
    assert_bits(s.run.time_step, 0.01);
    assert_bits(s.ice.smallest_floe_area, 2e-4 * 256);
    ck_assert_str_eq(s.file, "dir/test.yaml");
    const scenario_place *place = scenario_given(&s, "ice.floes[1].sides");
    ck_assert_ptr_nonnull(place);
    ck_assert_int_eq(place->line, 22);
    ck_assert_int_eq(place->column, 14);
    ck_assert_ptr_null(scenario_given(&s, "run.time_step"));
    scenario_free(&ctx, &s);
}
END_TEST

/* What is left of a file that was cut off must not run with defaults. */
START_TEST(an_empty_file_is_refused)
{
    static const char *const texts[] = {
        "", "\n", "# nothing but a comment\n", "---\n...\n", "~\n", "null\n", "\xef\xbb\xbf\n"};
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        scenario s;
        fram_status status = parse_text(texts[i], NULL, &s);
        ck_assert_msg(status == FRAM_ERROR_INPUT && strstr(error.message, "found an empty file"), "text %zu: %s", i,
                      status == FRAM_OK ? "was read" : error.message);
        if (status == FRAM_OK)
            scenario_free(&ctx, &s);
    }
}
END_TEST

START_TEST(an_empty_mapping_is_all_defaults)
{
    static const char *const texts[] = {"{}", "\xef\xbb\xbf{}\n"};
    scenario defaults;
    scenario_defaults(&defaults, scenario_default_scale());
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        scenario s;
        fram_status status = parse_text(texts[i], NULL, &s);
        ck_assert_msg(status == FRAM_OK, "text %zu: %s", i, error.message);
        char hash[SHA256_TEXT_SIZE], expected[SHA256_TEXT_SIZE];
        assert_ok(scenario_hash(&ctx, &s, hash, &error), error);
        assert_ok(scenario_hash(&ctx, &defaults, expected, &error), error);
        ck_assert_str_eq(hash, expected);
        scenario_free(&ctx, &s);
    }
}
END_TEST

START_TEST(other_ways_to_write_the_same)
{
    static const char *const texts[] = {"run:\r\n  duration: 5\r\n  seed: 7\r\n",
                                        "{\"run\": {\"duration\": 5, \"seed\": 7}}",
                                        "run: {duration: 5.0, seed: +7}",
                                        "---\n\"run\":\n    seed:  007 # comment\n    duration: 50e-1\n",
                                        "%YAML 1.2\n---\nrun:\n  seed: 7\n  duration: 5\n",
                                        "{\"run\": {\"duration\": 5, \"seed\": 7.0}}",
                                        "run: {duration: 5, seed: 7.}"};
    char hash[SHA256_TEXT_SIZE], other[SHA256_TEXT_SIZE];
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        scenario s;
        fram_status status = parse_text(texts[i], NULL, &s);
        ck_assert_msg(status == FRAM_OK, "text %zu: %d:%d: %s", i, error.line, error.column, error.message);
        assert_bits(s.run.duration, 5.0);
        ck_assert_int_eq(s.run.seed, 7);
        if (i == 0)
            assert_ok(scenario_hash(&ctx, &s, hash, &error), error);
        assert_ok(scenario_hash(&ctx, &s, other, &error), error);
        ck_assert_str_eq(hash, other);
        scenario_free(&ctx, &s);
    }
}
END_TEST

START_TEST(printing_and_reading_again_gives_the_same)
{
    for (int comments = 0; comments < 2; comments++) {
        scenario s, again;
        text_buffer first = {0}, second = {0};
        char hash_first[SHA256_TEXT_SIZE], hash_second[SHA256_TEXT_SIZE];
        assert_ok(parse_text(example, NULL, &s), error);
        print_to(&s, comments, &first);
        assert_ok(parse_text(first.data, NULL, &again), error);
        print_to(&again, comments, &second);
        ck_assert_str_eq(first.data, second.data);
        assert_ok(scenario_hash(&ctx, &s, hash_first, &error), error);
        assert_ok(scenario_hash(&ctx, &again, hash_second, &error), error);
        ck_assert_str_eq(hash_first, hash_second);
        text_free(&ctx, &first);
        text_free(&ctx, &second);
        scenario_free(&ctx, &s);
        scenario_free(&ctx, &again);
    }
}
END_TEST

/* A value within the range of a key that is not the default. */
static fram_status scatter(void *user, const scenario_key *key, const void *member, const char *path, fram_error *e)
{
    (void)path;
    (void)e;
    random_stream *random = user;
    void *write = (char *)(uintptr_t)member;
    double value = random_uniform(random, key->lo, key->hi);
    if (key->kind == KEY_REAL)
        *(double *)write = value;
    if (key->kind == KEY_INTEGER)
        *(int64_t *)write = (int64_t)value;
    if (key->kind == KEY_BOOLEAN)
        *(bool *)write = random_unit(random) < 0.5;
    return FRAM_OK;
}

/* Reals of any digits survive; the rules between keys, which such values break, are restored by hand. */
START_TEST(random_scenarios_survive_printing)
{
    context_init(&ctx);
    random_stream random = random_begin(7, 0, 0);
    for (int i = 0; i < 200; i++) {
        scenario s, again;
        scenario_defaults(&s, 30);
        assert_ok(scenario_walk(&s, scatter, &random, &error), error);
        s.run.time_step = s.run.transient = s.run.duration / 7;
        s.domain = (scenario_domain){.x_min = -7.1e6,
                                     .x_max = 1e7 / 3,
                                     .y_min = -1e6,
                                     .y_max = 1e5 / 3,
                                     .boundary = DOMAIN_OPEN,
                                     .drift_speed = (double)NAN, /* with feeding only */
                                     .band = 10.0 / 3,
                                     .tile_x = (double)NAN,
                                     .tile_y = 1e7 / 3,
                                     .wall_height = 1,
                                     .wall_thickness = 1};
        s.ice.source = ICE_NONE;
        s.vessel.propulsion.bollard_pull = (double)NAN;         /* mode free only */
        s.vessel.wash.active = false;                           /* needs one that gives thrust */
        s.ice.level.line_load = s.ice.level.mass = (double)NAN; /* of a sheet that drifts only */
        s.environment.floe_ventilation &= s.environment.water;  /* of ice in water only */
        s.vessel.positioning.active = false;                    /* needs thrusters */
        s.ice.friction = (scenario_friction){0.7, 0.6, 0.5, 0.4, 0.3, 0.2, 0.7, 0.6, 0.5, 0.4};
        if (s.run.time_step > 10)
            s.run.time_step = 10;
        text_buffer first = {0}, second = {0};
        print_to(&s, false, &first);
        assert_ok(parse_text(first.data, NULL, &again), error);
        print_to(&again, false, &second);
        ck_assert_str_eq(first.data, second.data);
        assert_bits(again.vessel.mass, s.vessel.mass);
        assert_bits(again.ice.elastic_modulus, s.ice.elastic_modulus);
        ck_assert(again.run.seed == s.run.seed);
        text_free(&ctx, &first);
        text_free(&ctx, &second);
        scenario_free(&ctx, &again);
    }
}
END_TEST

/* JSON writes auto as text; other text is no number, and auto none for keys without it. */
START_TEST(auto_in_quotes)
{
    scenario s;
    assert_ok(parse_text("{\"vessel\": {\"mass\": \"auto\"}, \"domain\": {\"band\": 'auto'}}", NULL, &s), error);
    ck_assert(is_automatic(s.vessel.mass) && is_automatic(s.domain.band));
    scenario_free(&ctx, &s);
    assert_fails(parse_text("vessel: {mass: \"4e6\"}", NULL, &s), error, FRAM_ERROR_INPUT, "without quotes");
    assert_fails(parse_text("run: {duration: \"auto\"}", NULL, &s), error, FRAM_ERROR_INPUT, "without quotes");
}
END_TEST

START_TEST(the_hash_sees_every_value_and_no_comment)
{
    scenario s;
    char hash[SHA256_TEXT_SIZE], other[SHA256_TEXT_SIZE];
    assert_ok(parse_text("title: a\n", NULL, &s), error);
    assert_ok(scenario_hash(&ctx, &s, hash, &error), error);
    s.run.seed++;
    assert_ok(scenario_hash(&ctx, &s, other, &error), error);
    ck_assert_str_ne(hash, other);
    s.run.seed--;
    s.ice.thickness = nextafter(s.ice.thickness, 2);
    assert_ok(scenario_hash(&ctx, &s, other, &error), error);
    ck_assert_str_ne(hash, other);
    scenario_free(&ctx, &s);
    assert_ok(parse_text("# comment\ntitle: \"a\" # another\n", NULL, &s), error);
    assert_ok(scenario_hash(&ctx, &s, other, &error), error);
    ck_assert_str_eq(hash, other);
    scenario_free(&ctx, &s);
}
END_TEST

/* Numbers with an exponent have a point, without which other readers of YAML take them for text; the hash is that of
   texts without it, as of earlier runs. */
START_TEST(numbers_are_numbers_to_readers_of_yaml_1_1)
{
    scenario s;
    text_buffer text = {0};
    char hash[SHA256_TEXT_SIZE], expected[SHA256_TEXT_SIZE];
    assert_ok(parse_text("run: {solver: {tolerance: 1e-06}, time_step: 1.5e-05}\n", NULL, &s), error);
    print_to(&s, false, &text);
    ck_assert_ptr_nonnull(strstr(text.data, "    tolerance: 1.0e-06\n"));
    ck_assert_ptr_nonnull(strstr(text.data, "  time_step: 1.5e-05\n"));
    assert_ok(scenario_hash(&ctx, &s, hash, &error), error);
    for (char *e = text.data; (e = strstr(e, ".0e")) != NULL;)
        memmove(e, e + 2, strlen(e + 2) + 1);
    sha256_text(text.data, strlen(text.data), expected);
    ck_assert_str_eq(hash, expected);
    text_free(&ctx, &text);
    scenario_free(&ctx, &s);
}
END_TEST

/* The effective scenario in the run folder must mean the same hull, and keep the hash. */
START_TEST(absolute_paths_hold_anywhere)
{
    const scenario_print_options options = {.absolute_paths = true};
    scenario s, again;
    text_buffer text = {0};
    char hash[SHA256_TEXT_SIZE], other[SHA256_TEXT_SIZE], folder[400], expected[600];
    assert_ok(parse_text(example, NULL, &s), error);
    assert_ok(scenario_print(&ctx, &s, &options, &text, &error), error);
    assert_ok(scenario_parse(&ctx, "elsewhere.yaml", text.data, (size_t)text.count, NULL, &again, &error), error);
    ck_assert_ptr_nonnull(getcwd(folder, sizeof folder));
    snprintf(expected, sizeof expected, "%s/dir/hulls/a.stl", folder);
    ck_assert_str_eq(again.vessel.hull.file, expected);
    assert_ok(scenario_hash(&ctx, &s, hash, &error), error);
    assert_ok(scenario_hash(&ctx, &again, other, &error), error);
    ck_assert_str_eq(hash, other);
    text_free(&ctx, &text);
    memset(s.vessel.hull.file, 'x', SCENARIO_TEXT_SIZE - 1);
    assert_fails(scenario_print(&ctx, &s, &options, &text, &error), error, FRAM_ERROR_INPUT,
                 "together with its folder");
    text_free(&ctx, &text);
    scenario_free(&ctx, &s);
    scenario_free(&ctx, &again);
}
END_TEST

/* The longest values everywhere, all lists full but that of vessels. */
static void fill(const scenario_section *section, void *data, int32_t vessels)
{
    for (int32_t k = 0; k < section->key_count; k++) {
        const scenario_key *key = &section->keys[k];
        void *member = key_member(key, data);
        int32_t most = strcmp(key->name, "vessels") == 0 ? vessels : (int32_t)key->hi;
        if (key->kind == KEY_SECTION)
            fill(key->section, member, vessels);
        for (int32_t i = 0; key->kind == KEY_LIST && i < most; i++) {
            void *element = list_append(&ctx, key, member, 30);
            ck_assert_ptr_nonnull(element);
            fill(key->section, element, vessels);
        }
        if (key->kind == KEY_REAL)
            *(double *)member = -1.0000000000000002e-100;
        if (key->kind == KEY_PATH || key->kind == KEY_TEXT)
            memset(member, '"', SCENARIO_TEXT_SIZE - 1);
    }
}

START_TEST(no_scenario_prints_longer_than_can_be_read)
{
    context_init(&ctx);
    int64_t size[2];
    for (int32_t i = 0; i < 2; i++) {
        scenario s;
        text_buffer text = {0};
        scenario_defaults(&s, 30);
        fill(&scenario_schema, &s, i + 1);
        assert_ok(scenario_print(&ctx, &s, NULL, &text, &error), error);
        size[i] = text.count;
        text_free(&ctx, &text);
        scenario_free(&ctx, &s);
    }
    ck_assert_int_le(size[1] + 30 * (size[1] - size[0]), SCENARIO_FILE_LIMIT);
}
END_TEST

/* Lists that are full of long values are read again as they were. */
START_TEST(the_largest_scenario_can_be_read_again)
{
    context_init(&ctx);
    scenario s, again;
    scenario_defaults(&s, 30);
    s.ice.source = ICE_FLOES;
    for (int i = 0; i < 1000; i++) {
        scenario_floe floe = a_floe();
        floe.length = floe.width = floe.radius = 1.0000000000000002e-05;
        floe.thickness = 1.0000000000000002e-05;
        floe.x = floe.y = floe.elevation = floe.yaw_deg = floe.pitch_deg = floe.roll_deg = -1.0000000000000002e-05;
        floe.velocity_x = floe.velocity_y = floe.velocity_z = floe.spin = -1.0000000000000002e-05;
        ck_assert(array_push(&ctx, &s.ice.floes, floe));
    }
    const scenario_key *vessels = &scenario_schema.keys[section_find(&scenario_schema, "vessels")];
    for (int i = 0; i < 5; i++) {
        scenario_vessel *vessel = list_append(&ctx, vessels, &s.vessels, 30);
        ck_assert_ptr_nonnull(vessel);
        snprintf(vessel->name, sizeof vessel->name, "v%d", i);
        for (int k = 0; k < 1000; k++)
            ck_assert(array_push(&ctx, &vessel->path, ((scenario_path_point){k, 1.0000000000000002e-05, 0, 0})));
    }
    text_buffer text = {0};
    assert_ok(scenario_print(&ctx, &s, NULL, &text, &error), error);
    ck_assert_int_gt(text.count, 1 << 20);
    assert_ok(scenario_parse(&ctx, "again", text.data, (size_t)text.count, NULL, &again, &error), error);
    ck_assert_int_eq(again.ice.floes.count, 1000);
    ck_assert_int_eq(again.vessels.data[4].path.count, 1000);
    assert_bits(again.ice.floes.data[999].spin, s.ice.floes.data[999].spin);
    text_free(&ctx, &text);
    scenario_free(&ctx, &again);
    scenario_free(&ctx, &s);
    text_add(&ctx, &text, "ice:\n  source: floes\n  floes:\n");
    for (int i = 0; i < 1001; i++)
        text_add(&ctx, &text, "    - {}\n");
    assert_fails(scenario_parse(&ctx, "many", text.data, (size_t)text.count, NULL, &s, &error), error, FRAM_ERROR_INPUT,
                 "expected at most 1000 items, found 1001");
    text_free(&ctx, &text);
}
END_TEST

/* ---- overrides ---- */

START_TEST(overrides_win)
{
    static const char *const items[] = {"run.seed=7",  "run.seed=8",       "ice.floes[1].x=3",
                                        "title=a = b", "vessel.mass=auto", "run.scale=1"};
    const scenario_overrides overrides = {items, 6};
    scenario s;
    assert_ok(parse_text(example, &overrides, &s), error);
    ck_assert_int_eq(s.run.seed, 8);
    assert_bits(s.ice.floes.data[1].x, 3.0);
    ck_assert_str_eq(s.title, "a = b");
    ck_assert(is_automatic(s.vessel.mass));
    /* Defaults follow an overridden scale too. */
    assert_bits(s.ice.smallest_floe_area, 2e-4);
    scenario_free(&ctx, &s);
}
END_TEST

START_TEST(bad_overrides_are_refused)
{
    static const struct {
        const char *item, *key, *message;
    } cases[] = {
        {"run.seed", "", "expected key=value"},
        {"=3", "", "expected key=value"},
        {"", "", "expected key=value"},
        {"run.sed=3", "run.sed", "did you mean seed?"},
        {"run.SEED=3", "run.SEED", "did you mean seed?"},
        {"vessel.hull.draft=3", "vessel.hull.draft", "did you mean draught?"},
        {"run.dt=3", "run.dt", "did you mean time_step?"},
        {"environment.speed=3", "environment.speed", "did you mean current_speed?"},
        {"domain.speed=3", "domain.speed", "did you mean drift_speed?"},
        {"vessel.hull.speed=3", "vessel.hull.speed", "did you mean vessel.speed?"},
        {"domain.run=3", "domain.run", "found \"run\", which is a key of the whole scenario"},
        {"vessel.hull.vessel=3", "vessel.hull.vessel", "which is a key of the whole scenario"},
        {"vessel.tow_line=3", "vessel.tow_line", "no line ties two vessels"},
        {"vessel.mooring.hawser=3", "vessel.mooring.hawser", "no line ties two vessels"},
        {"vessel.towed_by=tug", "vessel.towed_by", "goes as its speed or path says"},
        {"vessel.draft=3", "vessel.draft", "did you mean vessel.hull.draught?"},
        {"environment.wind=3", "environment.wind", "did you mean wind_speed?"},
        {"domain.x=3", "domain.x", "did you mean x_min?"},
        {"seed=3", "seed", "did you mean run.seed?"},
        {"environment.drift_speed=3", "environment.drift_speed", "did you mean domain.drift_speed?"},
        {"environment.wind_angle=3", "environment.wind_angle", "did you mean wind_direction_deg?"},
        {"vessel.weight=3", "vessel.weight", "did you mean mass?"},
        {"vessel.hull.weight=3", "vessel.hull.weight", "did you mean vessel.mass?"},
        {"vessel.mooring.weight=3", "vessel.mooring.weight", "did you mean vessel.mooring.lines.weight?"},
        {"vessel.hull.LOA=3", "vessel.hull.LOA", "did you mean length?"},
        {"run=3", "run", "expected a key inside run, as in run.NAME=VALUE"},
        {"ice.friction=3", "ice.friction", "expected a key inside ice.friction, as in ice.friction.NAME=VALUE"},
        {"run.=3", "run.", "expected a key of run"},
        {".seed=3", ".seed", "expected a key of the scenario"},
        {"run.seed.x=3", "run.seed.x", "expected nothing after run.seed"},
        {"run.seed[0]=3", "run.seed[0]", "expected nothing after run.seed"},
        {"run.seed=", "run.seed", "expected an integer, found nothing"},
        {"run.seed= 3", "run.seed", "expected an integer"},
        {"run.seed=3.5", "run.seed", "expected an integer, found \"3.5\""},
        {"run.seed=1e2", "run.seed", "expected an integer"},
        {"run.duration=-5", "run.duration", "expected a number from 0"},
        {"run.scale=0", "run.scale", "expected a number from 0.01"},
        {"run.scale=-1", "run.scale", "expected a number from 0.01"},
        {"ice.floes=3", "ice.floes", "expected the number of an item, ice.floes[0], ice.floes[1], ..."},
        {"ice.floes.x=3", "ice.floes.x", "expected the number of an item"},
        {"ice.floes[2].x=3", "ice.floes[2].x", "expected an item below ice.floes[2], since the file lists 2"},
        {"ice.floes[-1].x=3", "ice.floes[-1].x", "since the file lists 2"},
        {"ice.floes[].x=3", "ice.floes[].x", "expected the number of an item"},
        {"ice.floes[0.x=3", "ice.floes[0.x", "expected the number of an item"},
        {"ice.floes[99999999999999999999].x=3", "ice.floes[99999999999999999999].x", "expected the number of an item"},
        {"ice.floes[0]=3", "ice.floes[0]", "expected a key inside ice.floes[0], as in ice.floes[0].NAME=VALUE"},
        {"ice.floes[0]x=3", "ice.floes[0]x", "expected a key inside ice.floes[0], as in ice.floes[0].NAME=VALUE"},
        {"title=a\nb", "title", "line break"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const scenario_overrides overrides = {&cases[i].item, 1};
        scenario s;
        fram_status status = parse_text(example, &overrides, &s);
        ck_assert_msg(status == FRAM_ERROR_INPUT, "%s: status %d", cases[i].item, (int)status);
        ck_assert_str_eq(error.file, SCENARIO_OVERRIDE);
        ck_assert_int_eq(error.line, 0);
        ck_assert_msg(strcmp(error.key, cases[i].key) == 0, "%s: key %s", cases[i].item, error.key);
        ck_assert_msg(strstr(error.message, cases[i].message) != NULL, "%s: %s", cases[i].item, error.message);
    }
    char long_item[300];
    memset(long_item, 'k', sizeof long_item);
    memcpy(long_item + 280, "=1", 3);
    const char *item = long_item;
    const scenario_overrides overrides = {&item, 1};
    scenario s;
    assert_fails(parse_text(example, &overrides, &s), error, FRAM_ERROR_INPUT, "expected a key");
}
END_TEST

/* ---- limits ---- */

START_TEST(size_and_depth_are_limited)
{
    context_init(&ctx);
    scenario s;
    assert_fails(scenario_parse(&ctx, "a", "{}", SCENARIO_FILE_LIMIT + (size_t)1, NULL, &s, &error), error,
                 FRAM_ERROR_INPUT, "at most 33554432 bytes");
    size_t size = SCENARIO_BRACKET_LIMIT + 8;
    char *text = malloc(size + 1);
    memset(text, '\n', size);
    memcpy(text, "\n{", 2);
    text[size] = '\0';
    text[size - 1] = '}';
    assert_fails(scenario_parse(&ctx, "a", text, size, NULL, &s, &error), error, FRAM_ERROR_INPUT,
                 "at most 1048576 bytes in brackets");
    ck_assert_int_eq(error.line, 2);
    text[size - 1] = '\n';
    /* Brackets of plain text, which ends with its line, are no brackets; those in quotes close none. */
    static const char *const begins[] = {"\n{}",
                                         "title: run [1 of 2",
                                         "\n[\"\n ]\",",
                                         "\n['a'' ]',",
                                         "\na \"b: [",
                                         "\n[a:\"b, [ \", ]",
                                         "\n{\"a\" :\"b}\",",
                                         "\n--- [",
                                         "\na: &b !!c [",
                                         "\n- - [",
                                         "\n[a\t# ]",
                                         "\n# a\r["};
    for (size_t i = 0; i < sizeof begins / sizeof *begins; i++) {
        memset(text, '\n', 30);
        memcpy(text, begins[i], strlen(begins[i]));
        fram_status read = scenario_parse(&ctx, "a", text, size, NULL, &s, &error);
        ck_assert_msg((read == FRAM_OK) == (i < 2), "%s: %s", begins[i], error.message);
        ck_assert_msg(read == FRAM_OK || strstr(error.message, "bytes in brackets"), "%s: %s", begins[i],
                      error.message);
        scenario_free(&ctx, &s);
    }
    /* At the end of a long file they are as short as in a short one. */
    memset(text, '\n', size);
    memcpy(text + size - 4, "\n{}", 3);
    assert_ok(scenario_parse(&ctx, "a", text, size, NULL, &s, &error), error);
    scenario_free(&ctx, &s);
    /* As deep as the file is long: refused before any stack or memory is used up. */
    for (int way = 0; way < 3; way++) {
        memset(text, "[{-"[way], size - 1);
        for (size_t i = 1; way == 2 && i < size - 1; i += 2)
            text[i] = ' ';
        fram_status status = scenario_parse(&ctx, "a", text, size - 1, NULL, &s, &error);
        ck_assert_int_eq(status, FRAM_ERROR_INPUT);
    }
    /* As many keys as fit: refused at the first, and the duplicate at the end found without comparing all with all. */
    size_t used = 0;
    for (int i = 0; used < size - 40; i++)
        used += (size_t)sprintf(text + used, "k%d: 1\n", i);
    fram_status status = scenario_parse(&ctx, "a", text, used, NULL, &s, &error);
    ck_assert_int_eq(status, FRAM_ERROR_INPUT);
    ck_assert_str_eq(error.key, "k0");
    free(text);
}
END_TEST

START_TEST(files_that_cannot_be_read)
{
    context_init(&ctx);
    scenario s;
    assert_fails(scenario_read(&ctx, "tests/io/no_such_file.yaml", NULL, &s, &error), error, FRAM_ERROR_INPUT,
                 "No such file");
    ck_assert_str_eq(error.file, "tests/io/no_such_file.yaml");
    assert_fails(scenario_read(&ctx, "tests/io", NULL, &s, &error), error, FRAM_ERROR_INPUT, "regular file");
    assert_fails(scenario_read(&ctx, "/dev/zero", NULL, &s, &error), error, FRAM_ERROR_INPUT, "regular file");
    char name[SCENARIO_TEXT_SIZE + 10];
    memset(name, 'a', sizeof name);
    name[sizeof name - 1] = '\0';
    assert_fails(scenario_parse(&ctx, name, "", 0, NULL, &s, &error), error, FRAM_ERROR_INPUT, "path");
}
END_TEST

START_TEST(memory_runs_out)
{
    static const char *const items[] = {"run.seed=7"};
    const scenario_overrides overrides = {items, 1};
    for (failing_turn turn = {0}; failing_next(&turn);) {
        scenario s;
        text_buffer text = {0};
        char hash[SHA256_TEXT_SIZE];
        turn.status = scenario_parse(&turn.ctx, "a.yaml", example, strlen(example), &overrides, &s, &error);
        if (turn.status == FRAM_OK) {
            turn.status = scenario_print(&turn.ctx, &s, NULL, &text, &error);
            if (turn.status == FRAM_OK)
                turn.status = scenario_hash(&turn.ctx, &s, hash, &error);
            if (turn.status == FRAM_OK) {
                text_free(&turn.ctx, &text);
                turn.status = scenario_reference(&turn.ctx, &text, &error);
            }
            scenario_free(&turn.ctx, &s);
        }
        text_free(&turn.ctx, &text);
        if (!turn.memory.failed)
            ck_assert_int_gt(turn.n, 20);
    }
}
END_TEST

/* docs/input-reference.md is what the schema says.  FRAM_UPDATE=1 in the environment writes it anew. */
START_TEST(the_committed_reference_is_up_to_date)
{
    static const char path[] = "docs/input-reference.md";
    context_init(&ctx);
    text_buffer text = {0};
    assert_ok(scenario_reference(&ctx, &text, &error), error);
    if (getenv("FRAM_UPDATE")) {
        FILE *file = fopen(path, "w");
        ck_assert_ptr_nonnull(file);
        ck_assert_uint_eq(fwrite(text.data, 1, (size_t)text.count, file), (size_t)text.count);
        ck_assert_int_eq(fclose(file), 0);
    }
    char *committed;
    size_t size;
    assert_ok(file_read(&ctx, path, 1 << 20, &committed, &size, &error), error);
    ck_assert_msg(size == (size_t)text.count && memcmp(committed, text.data, size) == 0,
                  "%s is out of date: run this test with FRAM_UPDATE=1", path);
    memory_free(&ctx, committed);
    text_free(&ctx, &text);
}
END_TEST

TEST_MAIN("scenario_file", values_arrive, an_empty_file_is_refused, an_empty_mapping_is_all_defaults,
          other_ways_to_write_the_same, printing_and_reading_again_gives_the_same, random_scenarios_survive_printing,
          the_hash_sees_every_value_and_no_comment, numbers_are_numbers_to_readers_of_yaml_1_1,
          absolute_paths_hold_anywhere, no_scenario_prints_longer_than_can_be_read,
          the_largest_scenario_can_be_read_again, overrides_win, auto_in_quotes, bad_overrides_are_refused,
          size_and_depth_are_limited, files_that_cannot_be_read, memory_runs_out, the_committed_reference_is_up_to_date)
