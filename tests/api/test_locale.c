/* A program's locale with a decimal comma changes neither what is written nor what is read, and stays in force. */
#include "fram/live.h"
#include "fram/results.h"
#include "fram/study.h"
#include "testing.h"

#include <locale.h>

/* Two thrusters hold a ship: results of station keeping read the series again. */
static const char scene[] = "run: {duration: 1.5, time_step: 0.05, transient: 0.25}\n"
                            "output: {frame_interval: 0.5, averaging_window: 0.25}\n"
                            "vessel:\n  mode: free\n  hull: {length: 48, beam: 12, draught: 4, freeboard: 2}\n"
                            "  thrusters: [{x: 18}, {x: -18}]\n  positioning: {active: true}\n"
                            "environment: {current_speed: 0.3}\n"
                            "ice: {source: floes, floes: [{x: 40, length: 9.5, width: 9}]}\n";
static const char study[] = "scenario: scene.yaml\nset: {run.duration: 0.5}\nseeds: 2\n"
                            "vary: {latin: {count: 2, keys: {ice.thickness: [0.5, 1.5]}}}\n";

static char folder[200];

static char *path_of(const char *name, char out[320])
{
    snprintf(out, 320, "%s/%s", folder, name);
    return out;
}

/* Before the tests, where nothing can be asserted. */
static void put(const char *name, const char *text)
{
    char path[320];
    FILE *file = fopen(path_of(name, path), "w");
    if (!file || fputs(text, file) < 0 || fclose(file) != 0)
        abort();
}

/* The whole of a file; to be freed. */
static char *text_of(const char *name)
{
    char path[320];
    FILE *file = fopen(path_of(name, path), "r");
    ck_assert_msg(file != NULL, "%s is not there", path);
    char *text = calloc(1, 1 << 22);
    ck_assert_ptr_nonnull(text);
    ck_assert_uint_lt(fread(text, 1, (1 << 22) - 1, file), (1 << 22) - 1);
    ck_assert_int_eq(fclose(file), 0);
    return text;
}

/* A locale of our own, for no machine must have a certain one: false where none can be made. */
static bool make_locale(void)
{
    static const char *const parts[] = {"CTYPE", "COLLATE", "MONETARY", "TIME", "MESSAGES"};
    const char *root = getenv("TMPDIR");
    char command[700];
    snprintf(folder, sizeof folder, "%.100s/fram_locale_XXXXXX", root && *root ? root : "/tmp");
    if (!mkdtemp(folder))
        return false;
    char text[1000] = "LC_NUMERIC\ndecimal_point \",\"\nthousands_sep \".\"\ngrouping 3;3\nEND LC_NUMERIC\n";
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++)
        snprintf(text + strlen(text), sizeof text - strlen(text), "LC_%s\ncopy \"POSIX\"\nEND LC_%s\n", parts[i],
                 parts[i]);
    put("comma.src", text);
    snprintf(command, sizeof command, "localedef -c -i %s/comma.src %s/comma >/dev/null 2>&1", folder, folder);
    (void)!system(command); /* NOLINT(cert-env33-c): a folder of mkdtemp; it warns of what is not in the source */
    setenv("LOCPATH", folder, 1);
    return setlocale(LC_ALL, "comma") != NULL;
}

static void assert_comma(void)
{
    char text[16];
    (snprintf)(text, sizeof text, "%.1f", 1.5); /* that of the C library, not of base/text.h */
    ck_assert_str_eq(text, "1,5");
}

/* Lines that begin so tell of this machine's time. */
static bool tells_the_time(const char *line) { return strstr(line, "wall") || strstr(line, "recording"); }

static void assert_same_but_times(const char *name)
{
    char one[64], other[64], *rest_a, *rest_b;
    snprintf(one, sizeof one, "comma_run/%s", name);
    snprintf(other, sizeof other, "plain_run/%s", name);
    char *a = text_of(one), *b = text_of(other);
    const char *x = strtok_r(a, "\n", &rest_a), *y = strtok_r(b, "\n", &rest_b);
    int lines = 0;
    for (; x && y; x = strtok_r(NULL, "\n", &rest_a), y = strtok_r(NULL, "\n", &rest_b), lines++)
        ck_assert_msg(strcmp(x, y) == 0 || (tells_the_time(x) && tells_the_time(y) && !strchr(x, ';')),
                      "%s: \"%s\" and \"%s\"", name, x, y);
    ck_assert(!x && !y && lines > 0);
    free(a);
    free(b);
}

static void make_run(const char *name)
{
    fram_error e;
    fram_context *c;
    fram_scenario *s;
    fram_run_definition d;
    char path[320], where[320];
    fram_run_default(&d);
    assert_ok(fram_context_create(NULL, &c, &e), e);
    assert_ok(fram_scenario_load(c, path_of("scene.yaml", path), NULL, 0, &s, &e), e);
    d.folder = path_of(name, where);
    assert_ok(fram_run(s, &d, NULL, &e), e);
    assert_ok(fram_report(c, where, NULL, false, NULL, &e), e);
    assert_ok(fram_export_vtk(c, where, NULL, 1, NULL, &e), e);
    fram_scenario_destroy(s);
    fram_context_destroy(c);
}

START_TEST(runs_leave_the_same_text)
{
    assert_comma();
    make_run("comma_run");
    assert_comma();
    setlocale(LC_ALL, "C");
    make_run("plain_run");
    setlocale(LC_ALL, "comma");
    static const char *const names[] = {"scenario.yaml", "station.json", "vtk/run.pvd"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        assert_same_but_times(names[i]);
    char *note = text_of("comma_run/run.json"), *page = text_of("comma_run/report.html");
    ck_assert_ptr_nonnull(strstr(note, "\"time_s\": 1.5,"));
    ck_assert_ptr_nonnull(strstr(note, "\"finished\""));
    const char *wall = strstr(note, "\"wall_s\": ");
    ck_assert(wall && wall[strcspn(wall, ".,")] == '.');
    ck_assert_ptr_nonnull(strstr(page, "1.5 s simulated"));
    free(note);
    free(page);
}
END_TEST

/* The numbers of a design are values of keys, and rows that were written are found again. */
START_TEST(studies_find_their_rows)
{
    fram_error e;
    fram_context *c;
    fram_study *s;
    fram_study_definition d;
    fram_study_result result;
    char path[320], where[320];
    const char *program = getenv("FRAM");
    if (!program)
        return;
    assert_ok(fram_context_create(NULL, &c, &e), e);
    assert_ok(fram_study_load(c, path_of("study.yaml", path), &s, &e), e);
    fram_study_default(&d);
    d.folder = path_of("study", where);
    d.program = program;
    d.jobs = 2;
    for (int again = 0; again < 2; again++) {
        assert_ok(fram_study_run(s, &d, &result, &e), e);
        ck_assert(result.runs == 4 && result.failed == 0);
        ck_assert_int_eq(result.made, again ? 0 : 4);
    }
    assert_comma();
    fram_study_destroy(s);
    fram_context_destroy(c);
}
END_TEST

int main(void)
{
    if (!make_locale()) {
        puts("skipped: localedef makes no locale here");
        return 77;
    }
    put("scene.yaml", scene);
    put("study.yaml", study);
    const TTest *const list[] = {runs_leave_the_same_text, studies_find_their_rows};
    int code = testing_run("locale", list, (int)(sizeof list / sizeof *list));
    char command[260];
    snprintf(command, sizeof command, "rm -rf %s", folder);
    return system(command) == 0 ? code : EXIT_FAILURE; /* NOLINT(cert-env33-c): a folder of mkdtemp */
}
