/* A list of vessels in a scenario: read, named, overridden by name, printed, refused. */
#include "io/scenario_file.h"
#include "model/scenario_vessel.h"
#include "testing.h"

#include <stdio.h>

static context ctx;
static fram_error error;

static fram_status parse(const char *text, const char *override, scenario *s)
{
    const scenario_overrides list = {&override, override ? 1 : 0};
    context_init(&ctx);
    memset(&error, 0, sizeof error);
    return scenario_parse(&ctx, "list.yaml", text, strlen(text), &list, s, &error);
}

static const char two[] = "vessels:\n"
                          "  - name: icebreaker-1\n"
                          "    hull: {length: 60}\n"
                          "    mode: towed\n"
                          "    speed: 2\n"
                          "  - name: tanker\n"
                          "    present: true\n"
                          "    x: 400\n"
                          "    hull: {form: box, length: 80}\n"
                          "    mode: free\n"
                          "    mooring: {lines: [{count: 3, spacing_deg: 120}]}\n"
                          "domain: {x_min: -500, x_max: 900}\n";

START_TEST(items_arrive)
{
    scenario s;
    assert_ok(parse(two, NULL, &s), error);
    ck_assert_int_eq(scenario_vessel_count(&s), 2);
    vessel_entry first = scenario_vessel_entry(&s, 0), second = scenario_vessel_entry(&s, 1);
    ck_assert_str_eq(first.keys->name, "icebreaker-1");
    ck_assert_str_eq(first.path, "vessels[0]");
    assert_bits(first.keys->hull.length, 60);
    assert_bits(second.keys->x, 400);
    ck_assert_str_eq(vessel_channel_name(&s, 1, "ice_force_x").text, "tanker.ice_force_x");
    ck_assert_str_eq(vessel_file_name(&s, 0, "loads", ".png").text, "loads-icebreaker-1.png");
    ck_assert_str_eq(vessel_title_of(&second).text, "vessel tanker");
    scenario_free(&ctx, &s);
}
END_TEST

/* The short form is called nothing, and its channels and files are what they were. */
START_TEST(one_vessel_has_plain_names)
{
    scenario s;
    assert_ok(parse("vessel: {x: 3}\n", NULL, &s), error);
    ck_assert_int_eq(scenario_vessel_count(&s), 1);
    ck_assert_str_eq(vessel_channel_name(&s, 0, "ice_force_x").text, "ice_force_x");
    ck_assert_str_eq(vessel_file_name(&s, 0, "loads", ".png").text, "loads.png");
    text_buffer text = {0};
    assert_ok(scenario_print(&ctx, &s, NULL, &text, &error), error);
    ck_assert_ptr_null(strstr(text.data, "vessels"));
    ck_assert_ptr_null(strstr(text.data, "name:"));
    text_free(&ctx, &text);
    scenario_free(&ctx, &s);
}
END_TEST

START_TEST(absent_items_are_left_out)
{
    scenario s;
    assert_ok(parse(two, "vessels.icebreaker-1.present=false", &s), error);
    ck_assert_int_eq(scenario_vessel_count(&s), 1);
    vessel_entry only = scenario_vessel_entry(&s, 0);
    ck_assert_str_eq(only.keys->name, "tanker");
    ck_assert_str_eq(only.path, "vessels[1]");
    scenario_free(&ctx, &s);
}
END_TEST

START_TEST(overrides_by_name_and_number)
{
    static const char *const items[] = {"vessels.tanker.x=410", "vessels.1.x=410", "vessels[1].x=410",
                                        "vessels[tanker].x=410"};
    for (size_t i = 0; i < sizeof items / sizeof *items; i++) {
        scenario s;
        assert_ok(parse(two, items[i], &s), error);
        assert_bits(s.vessels.data[1].x, 410);
        const scenario_place *place = scenario_given(&s, "vessels[1].x");
        ck_assert_ptr_nonnull(place);
        ck_assert(place->override);
        scenario_free(&ctx, &s);
    }
    scenario s;
    assert_ok(parse(two, "vessels.tanker.mooring.lines[0].count=5", &s), error);
    ck_assert_int_eq(s.vessels.data[1].mooring.lines.data[0].count, 5);
    scenario_free(&ctx, &s);
}
END_TEST

/* Printed and read again it is the same scenario. */
START_TEST(printed_and_read_again)
{
    scenario s, again;
    text_buffer text = {0};
    char hash[SHA256_TEXT_SIZE], hash_again[SHA256_TEXT_SIZE];
    assert_ok(parse(two, NULL, &s), error);
    assert_ok(scenario_print(&ctx, &s, NULL, &text, &error), error);
    ck_assert_ptr_null(strstr(text.data, "\nvessel:"));
    assert_ok(parse(text.data, NULL, &again), error);
    assert_ok(scenario_hash(&ctx, &s, hash, &error), error);
    assert_ok(scenario_hash(&ctx, &again, hash_again, &error), error);
    ck_assert_str_eq(hash, hash_again);
    text_free(&ctx, &text);
    scenario_free(&ctx, &s);
    scenario_free(&ctx, &again);
}
END_TEST

static const struct {
    const char *text, *override, *key;
    int line;
} refused[] = {
    {"run: {seed: 1}\nvessels: []\n", NULL, "vessels", 2},
    {"vessels:\n  - hull: {form: box}\n", NULL, "vessels[0].name", 2},
    {"vessels:\n  - name: a\n    x: 3\n", NULL, "vessels[0].hull", 2},
    {"vessels:\n  - name: a\n    hull: {form: box}\n  - name: a\n    hull: {form: box}\n", NULL, "vessels[1].name", 4},
    {"vessels:\n  - name: Tug\n    hull: {form: box}\n  - name: tUG\n    hull: {form: box}\n", NULL, "vessels[1].name",
     4},
    {"vessels:\n  - name: a b\n    hull: {form: box}\n", NULL, "vessels[0].name", 2},
    {"vessels:\n  - name: a.b\n    hull: {form: box}\n", NULL, "vessels[0].name", 2},
    {"vessels:\n  - name: \"12\"\n    hull: {form: box}\n", NULL, "vessels[0].name", 2},
    {"vessels:\n  - name: _\n    hull: {form: box}\n", NULL, "vessels[0].name", 2},
    {"vessels:\n  - name: an-icebreaker-of-many-words\n    hull: {form: box}\n", NULL, "vessels[0].name", 2},
    {"vessel: {x: 1}\nvessels: [{name: a, hull: {form: box}}]\n", NULL, "vessel", 1},
    {"vessels:\n  - name: a\n    hull: {form: box}\n    mode: towed\n    thrusters: [{x: 1}]\n", NULL,
     "vessels[0].thrusters", 5},
    {"vessels:\n  - name: a\n    hull: {form: box}\n    sped: 3\n", NULL, "vessels[0].sped", 4},
    {"vessels:\n  a: {hull: {form: box}}\n", NULL, "vessels", 1},
    {two, "vessel.x=3", "vessel.x", 0},
    {two, "vessels.tug.x=3", "vessels.tug.x", 0},
    {two, "vessels.2.x=3", "vessels.2.x", 0},
    {two, "vessels[1.x=3", "vessels[1.x", 0},
    {two, "vessels..x=3", "vessels..x", 0},
    {two, "vessels.tanker=3", "vessels.tanker", 0},
    {two, "vessels.tanker.speed=300", "vessels[1].speed", 0},
};

START_TEST(refusals_name_line_and_key)
{
    scenario s;
    ck_assert_int_eq(parse(refused[_i].text, refused[_i].override, &s), FRAM_ERROR_INPUT);
    ck_assert_msg(strcmp(error.key, refused[_i].key) == 0, "key %s, expected %s: %s", error.key, refused[_i].key,
                  error.message);
    ck_assert_int_eq(error.line, refused[_i].line);
    ck_assert_str_eq(error.file, refused[_i].override ? "(override)" : "list.yaml");
}
END_TEST

static const char one[] = "vessel: {name: solo}\n";
static const char six[] = "vessels:\n  - {name: a1, hull: {form: box}}\n  - {name: b1, x: 100, hull: {form: box}}\n"
                          "  - {name: c1, x: 200, hull: {form: box}}\n  - {name: d1, x: 300, hull: {form: box}}\n"
                          "  - {name: e1, x: 400, hull: {form: box}}\n  - {name: f1, x: 500, hull: {form: box}}\n";

static const char letters[] = "vessels:\n  - {name: Icebreaker-A, hull: {form: box}}\n"
                              "  - {name: Icebreaker-B, x: 400, hull: {form: box}}\n";

/* Where an item is none of a list, what is there instead. */
static const struct {
    const char *text, *override, *message;
} other_items[] = {
    {two, "vessels.tug.x=3",
     "expected the number of an item, vessels[0], vessels[1], ..., or the name, icebreaker-1, tanker; found \"tug\""},
    {two, "vessels.tnaker.x=3", "found \"tnaker\"; did you mean tanker?"},
    {six, "vessels[f2].x=3", "or the name, a1, b1, c1, d1, ...; found \"f2\"; did you mean f1?"},
    {letters, "vessels.icebreaker-b.x=70", "found \"icebreaker-b\"; did you mean Icebreaker-B?"},
    {letters, "vessels.Icebreaker-C.x=70", "found \"Icebreaker-C\""},
    {two, "vessels.tanker.thrusters[0].x=3", "expected an item of vessels[1].thrusters, and the file lists none"},
    {one, "vessels.solo.hull.length=3", "the file lists no vessels; the key of its one vessel is vessel.hull.length"},
    {one, "vessels[0].speed=3", "the file lists no vessels; the key of its one vessel is vessel.speed"},
    {"{}", "vessels.0.speed=3", "the file lists no vessels; the key of its one vessel is vessel.speed"},
    {"{}", "vessels=3", "the key of its one vessel is vessel.NAME"},
    {"vessels: []\n", "vessels[0].speed=3", "expected an item of vessels, and the file lists none"},
    {"{}", "ice.floes[0].x=3", "expected an item of ice.floes, and the file lists none"},
};

START_TEST(what_there_is_instead_is_told)
{
    scenario s;
    ck_assert_int_eq(parse(other_items[_i].text, other_items[_i].override, &s), FRAM_ERROR_INPUT);
    ck_assert_msg(strstr(error.message, other_items[_i].message), "%s: %s", other_items[_i].override, error.message);
    bool guess = strstr(other_items[_i].message, "did you mean") != NULL;
    ck_assert_msg((strstr(error.message, "did you mean") != NULL) == guess, "%s", error.message);
}
END_TEST

static void list_of(int32_t count, char *text, size_t size)
{
    int at = snprintf(text, size, "vessels:\n");
    for (int32_t i = 0; i < count; i++)
        at += snprintf(text + at, size - (size_t)at, "  - {name: v%d, x: %d, hull: {length: 50}}\n", (int)i,
                       (int)(100 * i));
}

START_TEST(as_many_as_the_limit)
{
    char text[4096];
    scenario s;
    list_of(32, text, sizeof text);
    assert_ok(parse(text, "domain.x_max=9000", &s), error);
    ck_assert_int_eq(scenario_vessel_count(&s), 32);
    scenario_free(&ctx, &s);
    list_of(33, text, sizeof text);
    ck_assert_int_eq(parse(text, NULL, &s), FRAM_ERROR_INPUT);
    ck_assert_str_eq(error.key, "vessels");
}
END_TEST

int main(void)
{
    TCase *c = tcase_create("vessel_list");
    tcase_add_test(c, items_arrive);
    tcase_add_test(c, one_vessel_has_plain_names);
    tcase_add_test(c, absent_items_are_left_out);
    tcase_add_test(c, overrides_by_name_and_number);
    tcase_add_test(c, printed_and_read_again);
    tcase_add_test(c, as_many_as_the_limit);
    tcase_add_loop_test(c, refusals_name_line_and_key, 0, (int)(sizeof refused / sizeof *refused));
    tcase_add_loop_test(c, what_there_is_instead_is_told, 0, (int)(sizeof other_items / sizeof *other_items));
    Suite *suite = suite_create("vessel_list");
    suite_add_tcase(suite, c);
    SRunner *runner = srunner_create(suite);
    srunner_run_all(runner, CK_NORMAL);
    int failed = srunner_ntests_failed(runner);
    srunner_free(runner);
    return failed > 0;
}
