/* fram study: many runs of one scenario, and what they say together. */
#include "cli/cli.h"

#include "fram/study.h"

#include <limits.h>
#include <math.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

/* The program itself, which is run for each run. */
static int own_path(const common_options *common, char path[PATH_MAX])
{
    ssize_t length = readlink("/proc/self/exe", path, PATH_MAX - 1);
    if (length <= 0)
        return answer_usage(common, "study", "cannot tell where the command fram is: /proc is not mounted");
    path[length] = '\0';
    return -1;
}

/* ---- fram study check ---- */

/* From this ratio on the time of packed ice is told. */
#define MUCH_LONGER 1.2

static void print_extent(const fram_study_extent *e, int jobs)
{
    double hours = e->run_seconds / jobs / 3600;
    printf("conditions: %d\n", e->conditions);
    if (e->runs_least == e->runs_most)
        printf("runs: %lld\n", (long long)e->runs_least);
    else
        printf("runs: %lld to %lld, until the intervals are narrow enough\n", (long long)e->runs_least,
               (long long)e->runs_most);
    printf("one run: about %.3g s on one core of this machine, %.3g MB kept\n", e->run_seconds, e->run_bytes / 1e6);
    if (e->run_seconds_packed > MUCH_LONGER * e->run_seconds)
        printf(
            "         up to %.3g s where ice jams or goes on breaking: contacts and pieces take time, few at first\n",
            e->run_seconds_packed);
    double most = (double)e->runs_most * fmax(e->run_seconds, e->run_seconds_packed) / jobs / 3600;
    printf("total: about %.3g h", (double)e->runs_least * hours);
    if (most > MUCH_LONGER * (double)e->runs_least * hours)
        printf(" to %.3g h", most);
    printf(" on %d %s, %.3g MB\n", jobs, jobs == 1 ? "core" : "cores", (double)e->runs_most * e->run_bytes / 1e6);
}

static int answer_extent(const common_options *common, const fram_study *study, int jobs)
{
    fram_study_extent e;
    fram_error error = {0};
    if (fram_study_measure(study, &e, &error) != FRAM_OK)
        return answer_error(common, &error);
    if (!common->json) {
        print_extent(&e, jobs);
        return EXIT_GOOD;
    }
    json j = json_begin();
    json_integer(&j, "conditions", e.conditions);
    json_integer(&j, "runs_least", e.runs_least);
    json_integer(&j, "runs_most", e.runs_most);
    json_real(&j, "run_s", e.run_seconds);
    json_real(&j, "run_s_packed", e.run_seconds_packed);
    json_real(&j, "run_bytes", e.run_bytes);
    json_end(&j);
    return EXIT_GOOD;
}

/* ---- fram study ---- */

typedef struct study_view {
    bool terminal;
    int64_t told; /* runs done when the last line was written, -1 before */
    double when;  /* wall-clock time of it [s] */
} study_view;

/* Between lines where the output is no terminal, and on a terminal while no run ends [s]. */
#define LINE_INTERVAL 10

static void show(void *user, const fram_study_progress *p)
{
    study_view *view = user;
    bool last = p->done == p->planned && view->told != p->done;
    bool due = p->wall - view->when >= LINE_INTERVAL || view->told < 0;
    if (!last && !due && (!view->terminal || view->told == p->done))
        return;
    view->told = p->done;
    view->when = p->wall;
    fprintf(stderr, "%s%lld of %lld runs", view->terminal ? "\r\033[K" : "", (long long)p->done, (long long)p->planned);
    if (p->failed > 0)
        fprintf(stderr, ", %lld failed", (long long)p->failed);
    if (p->eta > 0)
        fprintf(stderr, ", about %.0f s left", p->eta);
    fputs(view->terminal ? "" : "\n", stderr);
    fflush(stderr);
}

static int answer_result(const common_options *common, const char *folder, const fram_study_result *r)
{
    if (!common->quiet)
        fprintf(stderr,
                "%lld runs of %lld conditions, %lld failed; %lld carried out now\n"
                "results: %s/summary.csv, %s/conditions.csv\n",
                (long long)r->runs, (long long)r->conditions, (long long)r->failed, (long long)r->made, folder, folder);
    if (!common->json)
        return EXIT_GOOD;
    json j = json_begin();
    json_integer(&j, "conditions", r->conditions);
    json_integer(&j, "runs", r->runs);
    json_integer(&j, "failed", r->failed);
    json_integer(&j, "made", r->made);
    json_text(&j, "folder", folder);
    json_end(&j);
    return EXIT_GOOD;
}

static int run_study(const common_options *common, const fram_study *study, fram_study_definition *d)
{
    char program[PATH_MAX];
    int code = own_path(common, program);
    if (code >= 0)
        return code;
    study_view view = {.terminal = isatty(STDERR_FILENO) == 1, .told = -1};
    fram_study_result result = {0};
    fram_error error = {0};
    d->program = program;
    d->progress = common->quiet ? NULL : show;
    d->progress_user = &view;
    d->stop = session_stop_flag();
    fram_status status = fram_study_run(study, d, &result, &error);
    if (view.terminal && view.told >= 0)
        fputc('\n', stderr);
    return status == FRAM_OK ? answer_result(common, d->folder, &result) : answer_error(common, &error);
}

int command_study(const command_row *self, int argc, char **argv)
{
    common_options common;
    fram_study_definition d;
    option_list sbatch = {0};
    fram_study_default(&d);
    const char *words[2] = {NULL, NULL};
    const option_row rows[] = {
        {"--output", "-o", OPTION_TEXT, &d.folder, "DIR",
         "folder for the results; a folder of this study is continued"},
        {"--jobs", "-j", OPTION_INTEGER, &d.jobs, "N", "concurrent processes (as many as this machine has cores)"},
        {"--on", NULL, OPTION_TEXT, &d.on, "WHERE", "local, or slurm: job arrays over a shared folder (local)"},
        {"--partition", NULL, OPTION_TEXT, &d.slurm_partition, "NAME", "Slurm partition (the cluster's default)"},
        {"--time", NULL, OPTION_TEXT, &d.slurm_time, "T", "time limit of a task, as for sbatch: 1:00:00"},
        {"--runs-per-task", NULL, OPTION_INTEGER, &d.slurm_runs_per_task, "N",
         "runs per task, one after another (so that there are at most 200 tasks)"},
        {"--sbatch", NULL, OPTION_LIST, &sbatch, "OPTION",
         "further option of sbatch, such as --account=ice; may be repeated"},
        {"--poll", NULL, OPTION_REAL, &d.slurm_poll, "T", "seconds between queries to the scheduler (30)"},
        {"--dry-run", NULL, OPTION_FLAG, &d.dry_run, NULL, "print the script for Slurm, submit nothing"},
        {"--retry", NULL, OPTION_FLAG, &d.retry, NULL, "repeat failed runs"},
    };
    int code = options_read_some(self, rows, sizeof rows / sizeof *rows, &common, argc, argv, words, 1, 2);
    if (code >= 0)
        return code;
    d.slurm_options = sbatch.value;
    d.slurm_option_count = sbatch.count;
    bool check = words[1] && strcmp(words[0], "check") == 0;
    if (words[1] && !check)
        return answer_usage(&common, words[0], "expected one study file, or: fram study check STUDY");
    if (!check && !d.folder)
        return answer_usage(&common, "--output", "is missing: name the folder for the results, -o DIR");
    if (d.jobs < 0 || d.jobs > 4096)
        return answer_usage(&common, "--jobs", "expected 0 to 4096 processes");
    fram_context *context = NULL;
    work_view work;
    code = session_open_reading(&common, &work, &context);
    if (code >= 0)
        return code;
    fram_study *study = NULL;
    fram_error error = {0};
    if (fram_study_load(context, words[check ? 1 : 0], &study, &error) != FRAM_OK)
        code = answer_error(&common, &error);
    else if (check)
        code = answer_extent(&common, study, d.jobs > 0 ? d.jobs : (int)sysconf(_SC_NPROCESSORS_ONLN));
    else
        code = run_study(&common, study, &d);
    fram_study_destroy(study);
    fram_context_destroy(context);
    return code;
}
