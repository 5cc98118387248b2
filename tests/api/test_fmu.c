/* include/fram/fmu.h: units are written, and what cannot be is refused; tests/fmi steps them. */
#include "fram/fmu.h"
#include "fram/live.h"
#include "scratch.h"

#include <stdio.h>
#include <unistd.h>

static const char text[] = "run: {duration: 1, time_step: 0.05}\n"
                           "vessel:\n  mode: free\n  hull: {length: 48, beam: 12, draught: 4, freeboard: 2}\n"
                           "  thrusters: [{x: 18}]\n"
                           "ice: {source: none}\n";

/* What there is to see of fram_fmu.so, with the functions of 2.0, or of both versions.  The names are not in one piece,
   so that this program itself has none. */
static void write_binary(const char *path, bool both)
{
    FILE *file = fopen(path, "w");
    ck_assert_ptr_nonnull(file);
    fprintf(file, "\177ELF fmi%dInst, fmi%dInstantiate", 2, 2);
    if (both)
        fprintf(file, "fmi%dInstantiateCoSimulation", 3);
    ck_assert_int_eq(fclose(file), 0);
}

START_TEST(units_are_written_and_mistakes_refused)
{
    fram_error e;
    fram_context *ctx;
    fram_scenario *s;
    fram_fmu_result result;
    char folder[SCRATCH_FOLDER], output[340], command[340], binary[340];
    scratch_folder(folder);
    snprintf(output, sizeof output, "%s/ship_1.fmu", folder);
    assert_ok(fram_context_create(NULL, &ctx, &e), e);
    assert_ok(fram_scenario_parse(ctx, text, NULL, NULL, 0, &s, &e), e);
    fram_fmu_definition d = {0};
    (fram_fmu_default)(NULL, sizeof(size_t));
    ck_assert_int_eq(fram_fmu(s, &d, NULL, &e), FRAM_ERROR_USAGE);
    fram_fmu_default(&d);
    ck_assert_int_eq(fram_fmu(s, NULL, NULL, &e), FRAM_ERROR_USAGE);
    ck_assert_int_eq(fram_fmu(s, &d, NULL, &e), FRAM_ERROR_USAGE);
    d.output = output;
    ck_assert_int_eq(fram_fmu(s, &d, NULL, &e), FRAM_ERROR_USAGE);
    d.binary = "CMakeLists.txt"; /* tests run in the source folder */
    assert_fails(fram_fmu(s, &d, NULL, &e), e, FRAM_ERROR_INPUT, "expected a shared library");
    ck_assert_str_eq(e.key, "binary");
    ck_assert_int_ne(access(output, F_OK), 0);
    d.binary = "/proc/self/mem"; /* is said to be a regular file, and cannot be read */
    assert_fails(fram_fmu(s, &d, NULL, &e), e, FRAM_ERROR_INPUT, "one of the system");
    d.binary = "/proc/self/exe"; /* with all of the library, but none of the unit's functions */
    assert_fails(fram_fmu(s, &d, NULL, &e), e, FRAM_ERROR_INPUT, "but not fram_fmu.so");
    d.version = 3;
    assert_fails(fram_fmu(s, &d, NULL, &e), e, FRAM_ERROR_INPUT, "but not fram_fmu.so");
    d.version = 2;
    snprintf(binary, sizeof binary, "%s/unit.so", folder);
    write_binary(binary, false);
    d.binary = binary; /* told by the names of its functions, and packed as it is */
    ck_assert_int_eq(fram_fmu(NULL, &d, NULL, &e), FRAM_ERROR_USAGE);
    assert_ok(fram_fmu(s, &d, &result, &e), e);
    ck_assert(result.inputs > 5 && result.outputs > 90 && result.files == 0);
    ck_assert_int_eq(access(output, R_OK), 0);
    static const char *const inputs[] = {"thruster_*", NULL}, *const outputs[] = {"position_?"},
                             *const none[] = {"no_such"};
    d.inputs = inputs;
    d.input_count = 1;
    d.outputs = outputs;
    d.output_count = 1;
    assert_ok(fram_fmu(s, &d, &result, NULL), e);
    ck_assert(result.inputs == 2 && result.outputs == 3);
    d.input_count = 2;
    ck_assert_int_eq(fram_fmu(s, &d, NULL, &e), FRAM_ERROR_USAGE);
    d.input_count = -1;
    ck_assert_int_eq(fram_fmu(s, &d, NULL, &e), FRAM_ERROR_USAGE);
    d.input_count = 1;
    d.inputs = none;
    assert_fails(fram_fmu(s, &d, NULL, &e), e, FRAM_ERROR_USAGE, "no_such");
    ck_assert_str_eq(e.key, "inputs");
    d.inputs = NULL;
    d.input_count = 0;
    d.outputs = none;
    assert_fails(fram_fmu(s, &d, NULL, &e), e, FRAM_ERROR_USAGE, "no_such");
    ck_assert_str_eq(e.key, "outputs");
    d.outputs = outputs;
    static const int versions[] = {0, 1, 4, -2};
    for (size_t i = 0; i < sizeof versions / sizeof *versions; i++) {
        d.version = versions[i];
        assert_fails(fram_fmu(s, &d, NULL, &e), e, FRAM_ERROR_USAGE, "FMI 3.0");
        ck_assert_str_eq(e.key, "version");
    }
    d.version = 3;
    assert_fails(fram_fmu(s, &d, &result, &e), e, FRAM_ERROR_INPUT, "but not fram_fmu.so");
    write_binary(binary, true);
    assert_ok(fram_fmu(s, &d, &result, &e), e);
    ck_assert(result.inputs > 5 && result.outputs == 3);
    d.binary = output;
    assert_fails(fram_fmu(s, &d, NULL, &e), e, FRAM_ERROR_USAGE, "found one that is read");
    d.binary = binary;
    static const char *const bad[] = {"",        "ship", "1ship.fmu", "ship.zip", "a ship.fmu",
                                      "s.h.fmu", ".fmu", "int.fmu",   "while.fmu"};
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        d.output = bad[i];
        ck_assert_msg(fram_fmu(s, &d, NULL, &e) == FRAM_ERROR_USAGE, "%s", bad[i]);
    }
    memset(command, 'a', 80);
    snprintf(command + 80, sizeof command - 80, ".fmu");
    d.output = command;
    assert_fails(fram_fmu(s, &d, NULL, &e), e, FRAM_ERROR_USAGE, "at most 79");
    d.output = "/no/such/folder/ship.fmu";
    ck_assert_int_ne(fram_fmu(s, &d, NULL, &e), FRAM_OK);
    fram_scenario_destroy(s);
    fram_context_destroy(ctx);
    scratch_remove_folder(folder);
}
END_TEST

TEST_MAIN("fmu", units_are_written_and_mistakes_refused)
