/* Studies through the public API: misuse is refused, and a small study runs by the command. */
#include "scratch.h"

#include "fram/study.h"

#include <locale.h>
#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <sys/stat.h>

static fram_context *context_of(void)
{
    fram_context *c = NULL;
    ck_assert_int_eq(fram_context_create(NULL, &c, NULL), FRAM_OK);
    return c;
}

/* A study of one still floe, in a folder of its own. */
static void write_study(char folder[SCRATCH_FOLDER], char study[SCRATCH_PATH])
{
    scratch_folder(folder);
    scratch_put(folder, "floe.yaml",
                "run: {duration: 0.2, time_step: 0.02}\nice: {source: floes, floes: [{length: 9, width: 9}]}\n");
    snprintf(study, SCRATCH_PATH, "%s/study.yaml", folder);
    scratch_text(study, "scenario: floe.yaml\nseeds: 2\nvary: {grid: {ice.thickness: [0.5, 1, 1.5]}}\n");
}

START_TEST(misuse_is_refused)
{
    fram_error error = {0};
    fram_context *c = context_of();
    fram_study *s = NULL;
    char folder[SCRATCH_FOLDER], path[300];
    write_study(folder, path);
    ck_assert_int_eq(fram_study_load(NULL, path, &s, &error), FRAM_ERROR_USAGE);
    ck_assert_str_eq(error.key, "context");
    ck_assert_int_eq(fram_study_load(c, NULL, &s, &error), FRAM_ERROR_USAGE);
    ck_assert_str_eq(error.key, "path");
    ck_assert_int_eq(fram_study_load(c, path, NULL, &error), FRAM_ERROR_USAGE);
    ck_assert_str_eq(error.key, "study");
    ck_assert_int_eq(fram_study_load(c, "/nowhere.yaml", &s, &error), FRAM_ERROR_INPUT);
    ck_assert_ptr_null(s);
    ck_assert_int_eq(fram_study_load(c, path, &s, &error), FRAM_OK);
    fram_study_extent extent;
    ck_assert_int_eq(fram_study_measure(NULL, &extent, &error), FRAM_ERROR_USAGE);
    ck_assert_str_eq(error.key, "study");
    ck_assert_int_eq(fram_study_measure(s, NULL, &error), FRAM_ERROR_USAGE);
    ck_assert_str_eq(error.key, "extent");
    fram_study_definition d;
    (fram_study_default)(NULL, sizeof(size_t));
    fram_study_default(&d);
    ck_assert_int_eq(fram_study_run(NULL, &d, NULL, &error), FRAM_ERROR_USAGE);
    ck_assert_int_eq(fram_study_run(s, NULL, NULL, &error), FRAM_ERROR_USAGE);
    ck_assert_int_eq(fram_study_run(s, &d, NULL, &error), FRAM_ERROR_USAGE);
    ck_assert_str_eq(error.key, "folder");
    d.folder = folder;
    ck_assert_int_eq(fram_study_run(s, &d, NULL, &error), FRAM_ERROR_USAGE);
    ck_assert_str_eq(error.key, "program");
    d.program = "/nowhere";
    for (d.jobs = -1; d.jobs <= FRAM_STUDY_JOBS + 1; d.jobs += FRAM_STUDY_JOBS + 2) {
        ck_assert_int_eq(fram_study_run(s, &d, NULL, &error), FRAM_ERROR_USAGE);
        ck_assert_str_eq(error.key, "jobs");
    }
    static const char *const no_option[] = {"--account=ice", NULL};
    d.jobs = 0;
    d.on = "slurm";
    d.slurm_option_count = 2;
    ck_assert_int_eq(fram_study_run(s, &d, NULL, &error), FRAM_ERROR_USAGE);
    ck_assert_str_eq(error.key, "slurm_options");
    d.slurm_options = no_option;
    ck_assert_int_eq(fram_study_run(s, &d, NULL, &error), FRAM_ERROR_USAGE);
    ck_assert_str_eq(error.message, "expected 2 texts, found NULL at 1");
    d.slurm_option_count = -1;
    ck_assert_int_eq(fram_study_run(s, &d, NULL, &error), FRAM_ERROR_USAGE);
    ck_assert_str_eq(error.key, "slurm_option_count");
    d.size = 1;
    ck_assert_int_eq(fram_study_run(s, &d, NULL, &error), FRAM_ERROR_USAGE);
    fram_study_destroy(s);
    fram_study_destroy(NULL);
    fram_context_destroy(c);
    scratch_remove_folder(folder);
}
END_TEST

static void count_calls(void *user, const fram_study_progress *p)
{
    ck_assert_int_le(p->done, p->planned);
    (*(int *)user)++;
}

typedef struct standing_sum {
    int conditions;
    int64_t runs, wanted;
} standing_sum;

static void add_standing(void *user, const fram_study_standing *c)
{
    standing_sum *sum = user;
    ck_assert_int_eq(c->condition, ++sum->conditions);
    ck_assert_int_eq((int)strlen(c->id), 12);
    ck_assert_ptr_nonnull(strchr(c->keys, '='));
    sum->runs += c->runs;
    sum->wanted += c->wanted;
}

static void write_program(const char *path, const char *text)
{
    FILE *file = fopen(path, "w");
    ck_assert_ptr_nonnull(file);
    fprintf(file, "#!/bin/sh\n%s", text);
    fclose(file);
    ck_assert_int_eq(chmod(path, 0700), 0);
}

/* A program that cannot write, in place of the command: that is no result of its scenario, whatever the language of the
   program that studies: German here, where the C library has its texts.  A disk that was full for its log, too, had
   room for its run.json. */
START_TEST(a_full_disk_fails_the_study_and_not_its_runs)
{
    fram_error error = {0};
    fram_context *c = context_of();
    fram_study *s = NULL;
    char folder[SCRATCH_FOLDER], path[300], out[300], program[300];
    write_study(folder, path);
    snprintf(out, sizeof out, "%s/out", folder);
    snprintf(program, sizeof program, "%s/full", folder);
    ck_assert_int_eq(fram_study_load(c, path, &s, &error), FRAM_OK);
    standing_sum sum = {0};
    ck_assert_int_eq(fram_study_list(c, out, add_standing, &sum, &error), FRAM_ERROR_INPUT);
    fram_study_definition d;
    fram_study_default(&d);
    d.folder = out;
    d.program = program;
    fram_study_result result = {.conditions = -77};
    if (setlocale(LC_ALL, "C.UTF-8"))
        setenv("LANGUAGE", "de", 1);
    static const char *const faults[] = {"No space left on device", "File too large", "Stale file handle"};
    for (int i = 0; i < 3; i++) {
        char script[128];
        snprintf(script, sizeof script, "echo 'fram: x/series.csv: cannot write: %s' >&2\nexit 1\n", faults[i]);
        write_program(program, script);
        ck_assert_int_eq(fram_study_run(s, &d, &result, &error), FRAM_ERROR_IO);
        ck_assert_int_eq(result.conditions, -77); /* a failure leaves it alone */
        ck_assert_ptr_nonnull(strstr(error.message, faults[i]));
    }
    setlocale(LC_ALL, "C");
    write_program(program, "mkdir -p $4\necho '{\"message\": \"No space left on device\"}' >$4/run.json\nexit 1\n");
    ck_assert_int_eq(fram_study_run(s, &d, &result, &error), FRAM_ERROR_IO);
    ck_assert_ptr_nonnull(strstr(error.message, "No space left"));
    ck_assert_msg(fram_study_list(c, out, add_standing, &sum, &error) == FRAM_OK, "%s", error.message);
    ck_assert_int_eq(sum.conditions, 3);
    ck_assert_int_eq(sum.runs, 0);
    ck_assert_int_eq(sum.wanted, 6);
    ck_assert_int_eq(fram_study_list(c, out, NULL, &sum, &error), FRAM_ERROR_USAGE);
    ck_assert_str_eq(error.key, "function");
    fram_study_destroy(s);
    fram_context_destroy(c);
    scratch_remove_folder(folder);
}
END_TEST

/* A program without one of its libraries, or that may not be run, says so as the system's loader and shells do. */
START_TEST(a_program_that_does_not_start_fails_the_study_and_not_its_runs)
{
    fram_error error = {0};
    fram_context *c = context_of();
    fram_study *s = NULL;
    char folder[SCRATCH_FOLDER], path[300], out[300], program[300];
    write_study(folder, path);
    snprintf(out, sizeof out, "%s/out", folder);
    snprintf(program, sizeof program, "%s/bare", folder);
    ck_assert_int_eq(fram_study_load(c, path, &s, &error), FRAM_OK);
    fram_study_definition d;
    fram_study_default(&d);
    d.folder = out;
    d.program = program;
    for (int code = 126; code <= 127; code++) {
        char script[160];
        snprintf(script, sizeof script, "echo first >&2\necho \"$0: error while loading: libbare.so.1\" >&2\nexit %d\n",
                 code);
        write_program(program, script);
        ck_assert_int_eq(fram_study_run(s, &d, NULL, &error), FRAM_ERROR_INPUT);
        snprintf(script, sizeof script, "/bare did not start (exit code %d): ", code);
        ck_assert_msg(strstr(error.message, script) &&
                          strstr(error.message, "/bare: error while loading: libbare.so.1;"),
                      "%s", error.message);
        ck_assert_ptr_nonnull(strstr(error.file, ".log"));
    }
    standing_sum sum = {0};
    ck_assert_msg(fram_study_list(c, out, add_standing, &sum, &error) == FRAM_OK, "%s", error.message);
    ck_assert_int_eq(sum.runs, 0);
    fram_study_destroy(s);
    fram_context_destroy(c);
    scratch_remove_folder(folder);
}
END_TEST

/* A study that was killed as it had started its programs leaves them: the same study, given again, meets them in
   folders that were free a moment before.  Each run meets one here, once, and the run that is made again for its
   record. */
START_TEST(a_program_of_a_killed_study_is_waited_for)
{
    const char *command = getenv("FRAM");
    if (!command)
        return; /* a build without the command */
    fram_error error = {0};
    fram_context *c = context_of();
    fram_study *s = NULL;
    char folder[SCRATCH_FOLDER], path[300], out[300], program[300];
    write_study(folder, path);
    FILE *file = fopen(path, "a");
    ck_assert_ptr_nonnull(file);
    fputs("keep: {record_of_worst: 1, by: time}\n", file);
    fclose(file);
    snprintf(out, sizeof out, "%s/out", folder);
    snprintf(program, sizeof program, "%s/met", folder);
    file = fopen(program, "w");
    ck_assert_ptr_nonnull(file);
    fprintf(file,
            "#!/bin/sh\n[ $1 != run ] || [ -e \"$4.met\" ] || { : >\"$4.met\"\n"
            "echo \"fram: $4: another run is writing into this folder; wait\" >&2; exit 2; }\nexec '%s' \"$@\"\n",
            command);
    fclose(file);
    ck_assert_int_eq(chmod(program, 0700), 0);
    ck_assert_int_eq(fram_study_load(c, path, &s, &error), FRAM_OK);
    fram_study_definition d;
    fram_study_default(&d);
    d.folder = out;
    d.program = program;
    fram_study_result result = {0};
    ck_assert_msg(fram_study_run(s, &d, &result, &error) == FRAM_OK, "%s: %s", error.file, error.message);
    ck_assert_int_eq(result.runs, 6);
    ck_assert_int_eq(result.made, 6);
    ck_assert_msg(result.failed == 0, "%s", result.reason);
    fram_study_destroy(s);
    fram_context_destroy(c);
    scratch_remove_folder(folder);
}
END_TEST

static void count_conditions(void *user, const char *what, double done, double total)
{
    int *calls = user;
    ck_assert(done < total || strcmp(what, "looking at the conditions") != 0);
    *calls += strcmp(what, "looking at the conditions") == 0;
}

/* The vessels of hundreds of conditions may take minutes before the first run begins. */
START_TEST(conditions_are_counted_and_a_stop_is_heard_between_them)
{
    fram_error error = {0};
    fram_context *c = NULL;
    fram_study *s = NULL;
    char folder[SCRATCH_FOLDER], path[300], out[300];
    int calls = 0, stop = 1;
    fram_context_definition told;
    fram_context_default(&told);
    told.work = count_conditions;
    told.work_user = &calls;
    ck_assert_int_eq(fram_context_create(&told, &c, &error), FRAM_OK);
    write_study(folder, path);
    ck_assert_int_eq(fram_study_load(c, path, &s, &error), FRAM_OK);
    fram_study_extent extent = {0};
    ck_assert_int_eq(fram_study_measure(s, &extent, &error), FRAM_OK);
    ck_assert_int_eq(calls, 3);
    snprintf(out, sizeof out, "%s/out", folder);
    fram_study_definition d;
    fram_study_default(&d);
    d.folder = out;
    d.program = "/nowhere";
    d.stop = &stop;
    ck_assert_int_eq(fram_study_run(s, &d, NULL, &error), FRAM_INTERRUPTED);
    ck_assert_ptr_nonnull(strstr(error.message, "before all conditions were looked at"));
    ck_assert_int_eq(calls, 3);
    fram_study_destroy(s);
    fram_context_destroy(c);
    scratch_remove_folder(folder);
}
END_TEST

/* Bytes of a run that is kept whole, of one floe in 1,000 steps, with these vessels and keys of its output. */
static double kept_bytes(fram_context *c, const char *vessels, const char *output)
{
    fram_error error = {0};
    fram_study *s = NULL;
    fram_study_extent extent = {0};
    char folder[SCRATCH_FOLDER], path[300], scene[300];
    write_study(folder, path);
    snprintf(scene, sizeof scene, "%s/floe.yaml", folder);
    FILE *file = fopen(scene, "a");
    ck_assert(file && fputs(vessels, file) >= 0 && fclose(file) == 0);
    file = fopen(path, "w");
    ck_assert_ptr_nonnull(file);
    fprintf(file, "scenario: floe.yaml\nset: {run.duration: 20%s}\nkeep: all\n%s", output,
            *vessels ? "vessel: a\n" : "");
    ck_assert_int_eq(fclose(file), 0);
    ck_assert_msg(fram_study_load(c, path, &s, &error) == FRAM_OK, "%s: %s", error.key, error.message);
    ck_assert_msg(fram_study_measure(s, &extent, &error) == FRAM_OK, "%s: %s", error.key, error.message);
    fram_study_destroy(s);
    scratch_remove_folder(folder);
    return extent.run_bytes;
}

/* By the rule of sim/scene_size.h: a frame of a floe and a vessel takes 652 bytes, a column in ice 7 in each row, a
 * picture 200,000. */
START_TEST(the_files_of_a_kept_run_count_as_fram_check_counts_them)
{
    fram_context *c = context_of();
    double without = kept_bytes(c, "", ", output.frame_interval: 0");
    ck_assert_double_eq_tol(kept_bytes(c, "", ", output.frame_interval: 0.02") - without, 652652, 1e-6);
    ck_assert_double_eq_tol(kept_bytes(c, "", ", output.frame_interval: 0.02, output.record_limit: 0") - without,
                            652652, 1e-6);
    ck_assert_double_eq_tol(kept_bytes(c, "", ", output.frame_interval: 0.02, output.record_limit: 0.01") - without,
                            10000, 1e-6);
    ck_assert_double_eq_tol(kept_bytes(c, "", ", output.frame_interval: 0, output.picture_interval: 2") - without, 2e6,
                            1e-6);
#define VESSEL(name, y) "{name: " name ", y: " y ", hull: {length: 48, beam: 12, draught: 4, freeboard: 2}}"
#define VESSELS \
    "vessels: [" VESSEL("a", "0") ", " VESSEL("b", "40") ", " VESSEL("c", "80") ", " VESSEL("d", "-40") "]\n"
    double more = kept_bytes(c, VESSELS, ", output.frame_interval: 0, output.csv_interval: 0.002");
    double columns = (more - without) / (3 * 1000 * 7.0); /* of a vessel more */
    ck_assert_double_eq_tol(columns, floor(columns + 0.5), 1e-6);
    ck_assert(columns > 100 && columns < 250);
    fram_context_destroy(c);
}
END_TEST

START_TEST(a_study_runs_by_the_command)
{
    const char *program = getenv("FRAM");
    if (!program)
        return; /* a build without the command */
    fram_error error = {0};
    fram_context *c = context_of();
    fram_study *s = NULL;
    char folder[SCRATCH_FOLDER], path[300], out[300];
    write_study(folder, path);
    snprintf(out, sizeof out, "%s/out", folder);
    ck_assert_int_eq(fram_study_load(c, path, &s, &error), FRAM_OK);
    fram_study_extent extent = {0};
    ck_assert_int_eq(fram_study_measure(s, &extent, &error), FRAM_OK);
    ck_assert_int_eq(extent.conditions, 3);
    ck_assert_int_eq(extent.runs_least, 6);
    ck_assert(extent.run_seconds > 0 && extent.run_bytes > 0);
    int calls = 0;
    fram_study_definition d;
    fram_study_default(&d);
    d.folder = out;
    d.program = program;
    d.progress = count_calls;
    d.progress_user = &calls;
    fram_study_result result = {0};
    ck_assert_msg(fram_study_run(s, &d, &result, &error) == FRAM_OK, "%s", error.message);
    ck_assert_int_eq(result.runs, 6);
    ck_assert_int_eq(result.failed, 0);
    ck_assert_int_eq(result.made, 6);
    ck_assert_int_ge(calls, 6);
    /* A program that is none: nothing is recorded as a result. */
    char other[300];
    snprintf(other, sizeof other, "%s/other", folder);
    d.folder = other;
    d.program = "/nowhere";
    ck_assert_int_ne(fram_study_run(s, &d, &result, &error), FRAM_OK);
    /* Nor where the system would not tell how runs end: all of them would have failed. */
    d.program = program;
    ck_assert(signal(SIGCHLD, SIG_IGN) != SIG_ERR);
    ck_assert_int_eq(fram_study_run(s, &d, &result, &error), FRAM_ERROR_USAGE);
    ck_assert_str_eq(error.key, "SIGCHLD");
    ck_assert(signal(SIGCHLD, SIG_DFL) != SIG_ERR);
    ck_assert_int_eq(fram_study_run(s, &d, &result, &error), FRAM_OK);
    ck_assert_int_eq(result.failed, 0);
    fram_study_destroy(s);
    fram_context_destroy(c);
    scratch_remove_folder(folder);
}
END_TEST

/* Runs of other files than those that name their condition are none of its runs: the program changes the file first. */
START_TEST(a_file_that_is_changed_while_the_study_runs_is_told)
{
    if (!getenv("FRAM"))
        return; /* a build without the command */
    static const char *const text[][2] = {
        {"current.csv", "time[s],x[m/s],y[m/s]\n0,0.5,0\n"},
        {"floe.yaml", "run: {duration: 0.2, time_step: 0.02}\nenvironment: {current_file: current.csv}\n"
                      "ice: {source: floes, floes: [{length: 9, width: 9}]}\n"},
        {"program", "#!/bin/sh\necho 1,0,0 >>\"${0%/*}/current.csv\"\nexec \"$FRAM\" \"$@\"\n"}};
    fram_error error = {0};
    fram_context *c = context_of();
    fram_study *s = NULL;
    char folder[SCRATCH_FOLDER], study[300], path[300], out[300];
    write_study(folder, study);
    for (int i = 0; i < 3; i++) {
        snprintf(path, sizeof path, "%s/%s", folder, text[i][0]);
        FILE *file = fopen(path, "w");
        ck_assert(file && fputs(text[i][1], file) >= 0 && fclose(file) == 0);
    }
    ck_assert_int_eq(chmod(path, 0700), 0);
    ck_assert_msg(fram_study_load(c, study, &s, &error) == FRAM_OK, "%s", error.message);
    snprintf(out, sizeof out, "%s/out", folder);
    fram_study_definition d;
    fram_study_default(&d);
    d.folder = out;
    d.program = path;
    d.jobs = 1;
    fram_study_result result = {0};
    ck_assert_int_eq(fram_study_run(s, &d, &result, &error), FRAM_ERROR_INPUT);
    ck_assert_msg(strstr(error.message, "current.csv was changed while the study ran") != NULL, "%s", error.message);
    /* Given again it makes the runs of what the file is now. */
    d.program = getenv("FRAM");
    ck_assert_msg(fram_study_run(s, &d, &result, &error) == FRAM_OK, "%s", error.message);
    ck_assert(result.made == 6 && result.failed == 0);
    fram_study_destroy(s);
    fram_context_destroy(c);
    scratch_remove_folder(folder);
}
END_TEST

TEST_MAIN("study", a_file_that_is_changed_while_the_study_runs_is_told, misuse_is_refused,
          a_full_disk_fails_the_study_and_not_its_runs, a_program_that_does_not_start_fails_the_study_and_not_its_runs,
          a_program_of_a_killed_study_is_waited_for, conditions_are_counted_and_a_stop_is_heard_between_them,
          the_files_of_a_kept_run_count_as_fram_check_counts_them, a_study_runs_by_the_command)
