/* Every file of tests/io/bad_scenarios is refused with the line and the key of its mistake. */
#include "io/scenario_file.h"
#include "testing.h"
#include <dirent.h>
#include <stdio.h>

typedef struct bad_scenario {
    const char *name;
    int line;
    const char *key;
    const char *message; /* part of it */
} bad_scenario;

static const bad_scenario bad[] = {
    {"above_range", 2, "ice.concentration", "expected a number from 0.01 to 1, found 1.01"},
    {"alias", 2, "run.duration", "found an anchor"},
    {"alias_only", 2, "run.duration", "found an alias"},
    {"anchor", 1, "run", "found an anchor"},
    {"automatic_where_not_allowed", 2, "vessel.speed", "expected a number in m/s, found \"auto\""},
    {"bad_indent", 3, "", "as no block above is"},
    {"below_range", 3, "ice.thickness", "found -1"},
    {"complex_key", 2, "run", "expected a name as key"},
    {"concentration_of_one", 3, "ice.concentration", "expected less than 1"},
    {"control_character", 1, "", "found a control character"},
    {"decimal_comma", 2, "ice.thickness", "found \"1,5\""},
    {"degrees_with_scale", 5, "ice.file_scale", "expected 1, since ice.file_coordinates is degrees"},
    {"domain_turned_round", 2, "domain.x_min", "expected at most domain.x_max, which is -50, found 50"},
    {"domain_without_width", 3, "domain.y_max", "expected more than domain.y_min"},
    {"duplicate_key", 4, "run.duration", "expected each key once"},
    {"duplicate_section", 5, "run", "expected each key once"},
    {"empty_key", 2, "run", "expected a name as key, found nothing"},
    {"empty_section", 2, "run", "found nothing"},
    {"empty_value", 2, "ice.thickness", "expected a value, found nothing"},
    {"floe_is_a_number", 5, "ice.floes[1]", "found a single value"},
    {"floe_out_of_range", 6, "ice.floes[1].sides", "expected an integer from 3 to 64, found 2"},
    {"floe_outside", 5, "ice.floes[1].x", "inside the domain"},
    {"floes_is_a_mapping", 3, "ice.floes", "expected a list"},
    {"floes_larger_than_domain", 2, "ice.mean_floe_area", "80000"},
    {"floes_missing", 1, "ice.floes", "expected at least one floe"},
    {"floes_unused", 2, "ice.floes", "expected no floes"},
    {"ventilation_without_water", 3, "environment.floe_ventilation", "environment.water is false"},
    {"sleep_of_drifting_ice", 3, "ice.sleep_speed", "expected 0"},
    {"friction_turned_round", 3, "ice.friction.ice_hull_static", "expected at least ice.friction.ice_hull_kinetic"},
    {"hexadecimal", 2, "ice.density", "found \"0x398\""},
    {"hull_file_missing", 2, "vessel.hull.file", "expected the path of a mesh"},
    {"hull_file_unused", 4, "vessel.hull.file", "found \"hull.stl\""},
    {"ice_sinks", 2, "ice.density", "floats"},
    {"infinite", 2, "ice.thickness", "found \"inf\""},
    {"integer_below_range", 3, "run.solver.iterations", "expected an integer from 1 to 1000000, found 0"},
    {"integer_beyond_double", 2, "run.seed", "to 9007199254740991"},
    {"integer_overflow", 2, "run.seed", "expected a smaller integer"},
    {"key_of_another_section", 3, "run.flexural_strength", "did you mean ice.flexural_strength?"},
    {"line_to_a_vessel", 6, "vessel.mooring.lines[0].vessel", "no line ties two vessels"},
    {"key_with_points", 2, "run.duration", "found \"run.duration\": write run: {duration: ...}"},
    {"key_with_points_in_section", 3, "vessel.hull.length",
     "a key of vessel, found \"hull.length\": write hull: {length"},
    {"line_break_in_text", 1, "title", "one line"},
    {"other_name_of_a_kind", 5, "vessel.mooring.lines[0].type", "did you mean kind?"},
    {"path_goes_back", 6, "vessel.path[2].time", "expected a later time"},
    {"line_table_missing", 5, "vessel.mooring.lines[0].table", "since kind is table, found neither"},
    {"line_table_of_a_spring", 6, "vessel.mooring.lines[0].table", "since kind is not table"},
    {"local_tag", 1, "run", "found a tag"},
    {"merge_key", 2, "run", "found a merge key"},
    {"not_a_number", 2, "ice.thickness", "found \".nan\""},
    {"not_utf8", 4, "", "expected UTF-8"},
    {"nul_in_text", 1, "title", "NUL"},
    {"overflow", 2, "ice.elastic_modulus", "which is too large"},
    {"population_second_of_voronoi", 3, "ice.populations", "expected one at most"},
    {"population_shape_of_voronoi", 4, "ice.populations[0].shape", "the cells are the shapes"},
    {"population_template_unused", 4, "ice.populations[0].templates", "nothing with others"},
    {"population_turned_round", 6, "ice.populations[1].diameter_max", "at least diameter_min"},
    {"population_without_histogram", 4, "ice.populations[0].histogram", "path of a CSV"},
    {"populations_missing", 1, "ice.populations", "expected at least one population"},
    {"populations_unused", 3, "ice.populations", "found 1"},
    {"root_is_a_list", 1, "", "found a list"},
    {"run_shorter_than_default_step", 3, "run.duration", "expected at least run.time_step, which is 0.01, found 0.001"},
    {"second_document", 2, "", "found a second one"},
    {"step_longer_than_run", 3, "run.time_step", "expected at most run.duration, which is 1, found 2"},
    {"tab_indent", 2, "", "the line begins with a tab: indent by blanks"},
    {"tag", 2, "run.duration", "found a tag"},
    {"text_too_long", 1, "title", "expected at most 511 bytes of text, found 600"},
    {"too_deep", 1, "title[0][0][0][0][0][0][0][0][0][0][0][0][0][0][0]", "less nesting"},
    {"transient_longer_than_run", 3, "run.transient", "found 11"},
    {"unclosed_bracket", 2, "", "bracket that opens here is not closed"},
    {"unclosed_quote", 1, "title", "not valid YAML"},
    {"unknown_choice", 3, "run.solver.kind", "expected one of: sequential fast accurate; found \"sequentiell\""},
    {"unknown_key", 4, "run.time_stp", "did you mean time_step?"},
    {"unknown_section", 2, "vesel", "did you mean vessel?"},
    {"vessel_behind_the_wall", 2, "vessel.x", "inside the walls"},
    {"wrong_type_boolean", 2, "environment.water", "expected true or false, found \"yes\""},
    {"wrong_type_integer", 3, "run.solver.iterations", "expected an integer, found \"30.5\""},
    {"wrong_type_list", 2, "run.seed", "expected a single value, found a list"},
    {"wrong_type_mapping", 2, "run.duration", "expected a single value, found a mapping"},
    {"wrong_type_quoted", 2, "run.duration", "without quotes"},
    {"wrong_type_section", 1, "run", "found a single value"},
    {"wrong_type_text", 2, "run.duration", "expected a number in s, found \"long\""},
};
enum { BAD_COUNT = sizeof bad / sizeof *bad };

START_TEST(every_bad_scenario_is_refused_at_its_place)
{
    for (int i = 0; i < BAD_COUNT; i++) {
        failing_memory memory;
        context ctx = failing_context(&memory, 0);
        scenario s;
        fram_error error = {0};
        char path[200];
        snprintf(path, sizeof path, "tests/io/bad_scenarios/%s.yaml", bad[i].name);
        fram_status status = scenario_read(&ctx, path, NULL, &s, &error);
        ck_assert_msg(status == FRAM_ERROR_INPUT && error.status == status, "%s: status %d", path, (int)status);
        ck_assert_str_eq(error.file, path);
        ck_assert_msg(error.line == bad[i].line, "%s: line %d, expected %d: %s", path, error.line, bad[i].line,
                      error.message);
        ck_assert_msg(error.column > 0, "%s: no column", path);
        ck_assert_msg(strcmp(error.key, bad[i].key) == 0, "%s: key '%s', expected '%s': %s", path, error.key,
                      bad[i].key, error.message);
        ck_assert_msg(strstr(error.message, bad[i].message) != NULL, "%s: '%s' lacks '%s'", path, error.message,
                      bad[i].message);
        ck_assert_msg(memory.live == 0, "%s: %ld blocks not freed", path, memory.live);
    }
}
END_TEST

/* No file may lie in the folder without a row above. */
START_TEST(every_file_has_its_row)
{
    DIR *folder = opendir("tests/io/bad_scenarios");
    ck_assert_ptr_nonnull(folder);
    int files = 0;
    for (struct dirent *entry; (entry = readdir(folder)) != NULL;)
        files += strstr(entry->d_name, ".yaml") != NULL;
    closedir(folder);
    ck_assert_int_eq(files, BAD_COUNT);
}
END_TEST

TEST_MAIN("bad_scenarios", every_bad_scenario_is_refused_at_its_place, every_file_has_its_row)
