/* fram study: many runs of one scenario, and what they say together. */
#include "cli/cli.h"

#include "fram/statistics.h"
#include "fram/study.h"

#include <limits.h>
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
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

/* From this ratio on the time of packed ice is told; and up to this part of a run, that no more of it was looked at. */
#define MUCH_LONGER 1.2
#define MUCH_LESS 0.8

static const char *time_text(double seconds, char out[DURATION_ROOM])
{
    fram_duration_text(seconds, out, DURATION_ROOM);
    return out;
}

/* An amount in the unit in which it is read most easily. */
static const char *bytes_text(double bytes, char out[DURATION_ROOM])
{
    static const char *const units[] = {"kB", "MB", "GB", "TB"};
    size_t i = 0;
    for (bytes /= 1e3; i + 1 < sizeof units / sizeof *units && bytes >= 1e3; i++)
        bytes /= 1e3;
    snprintf(out, DURATION_ROOM, bytes < 999.5 ? "%.3g %s" : "%.0f %s", bytes, units[i]);
    return out;
}

/* Runs that each process makes, one after another: the most of them. */
static double turns(int64_t runs, int jobs) { return ceil((double)runs / jobs); }

static void print_extent(const fram_study_extent *e, int jobs)
{
    char one[DURATION_ROOM], other[DURATION_ROOM], page[BESIDE_SIZE];
    double least = turns(e->runs_least, jobs) * e->run_seconds;
    double most = turns(e->runs_most, jobs) * fmax(e->run_seconds, e->run_seconds_packed);
    printf("conditions: %d", e->conditions);
    if (e->differ < e->conditions)
        printf(", %d of them different scenarios: the runs of the others are theirs", e->differ);
    printf("\n");
    if (e->runs_least == e->runs_most)
        printf("runs: %lld\n", (long long)e->runs_least);
    else
        printf("runs: %lld to %lld, until the intervals are narrow enough\n", (long long)e->runs_least,
               (long long)e->runs_most);
    printf("one run: about %s on one core of this machine, %s kept\n", time_text(e->run_seconds, one),
           bytes_text(e->run_bytes, other));
    if (e->run_seconds_packed > MUCH_LONGER * e->run_seconds)
        printf("         up to %s where ice jams or goes on breaking: contacts and pieces take time, few at first\n",
               time_text(e->run_seconds_packed, one));
    if (e->seen < MUCH_LESS)
        printf("         told by the first %.2g %% of it, after seconds of computing: what comes later is not known\n",
               100 * e->seen);
    if (e->records > 0) {
        printf("worst runs: %lld made again with a record and their playback, about %s each\n", (long long)e->records,
               bytes_text(e->record_bytes, one));
        if (!viewer_page_find(page))
            printf("            without playbacks: the viewer's page is not beside this command (make viewer); "
                   "fram view makes them later, of the records\n");
        least += turns(e->records, jobs) * e->run_seconds;
        most += turns(e->records, jobs) * fmax(e->run_seconds, e->run_seconds_packed);
    }
    printf("total: about %s", time_text(least, one));
    if (most > MUCH_LONGER * least)
        printf(" to %s", time_text(most, one));
    printf(" on %d %s, %s\n", jobs, jobs == 1 ? "core" : "cores",
           bytes_text((double)e->runs_most * e->run_bytes + (double)e->records * e->record_bytes, other));
}

/* jobs: 0 for as many as the study takes by itself */
static int answer_extent(const common_options *common, const fram_study *study, int jobs)
{
    fram_study_extent e;
    fram_error error = {0};
    char page[BESIDE_SIZE];
    if (fram_study_measure(study, &e, &error) != FRAM_OK)
        return answer_error(common, &error);
    if (!common->json) {
        print_extent(&e, jobs > 0 ? jobs : e.jobs);
        return EXIT_GOOD;
    }
    json j = json_begin();
    json_integer(&j, "conditions", e.conditions);
    json_integer(&j, "different", e.differ);
    json_integer(&j, "runs_least", e.runs_least);
    json_integer(&j, "runs_most", e.runs_most);
    json_integer(&j, "jobs", jobs > 0 ? jobs : e.jobs);
    json_real(&j, "run_s", e.run_seconds);
    json_real(&j, "run_s_packed", e.run_seconds_packed);
    json_real(&j, "run_bytes", e.run_bytes);
    json_real(&j, "run_seen", e.seen);
    json_integer(&j, "records", e.records);
    json_real(&j, "record_bytes", e.record_bytes);
    json_integer(&j, "playbacks", viewer_page_find(page) ? e.records : 0);
    json_end(&j);
    return EXIT_GOOD;
}

/* ---- fram study list ---- */

/* A row is told when the largest load of all of them is known, whose unit their columns have. */
typedef struct list_row {
    fram_study_standing of; /* with copies of its texts */
    struct list_row *next;
} list_row;

typedef struct list_view {
    bool json, failed_memory;
    json out;
    list_row *first, **end;
    double largest; /* [N] */
    int64_t conditions, runs, failed, wanted;
} list_view;

enum { LOAD_ROOM = 64 };
/* half: NaN without an interval. */
static void tell_load(double newton, double half, double largest, char out[LOAD_ROOM])
{
    snprintf(out, LOAD_ROOM, "-");
    if (isfinite(newton))
        fram_load_text(newton, half, largest, out, LOAD_ROOM);
}

static void keep_row(list_view *view, const fram_study_standing *c)
{
    list_row *row = calloc(1, sizeof *row);
    char *keys = strdup(c->keys), *id = strdup(c->id);
    if (!row || !keys || !id) {
        free(row), free(keys), free(id);
        view->failed_memory = true;
        return;
    }
    row->of = *c;
    row->of.keys = keys, row->of.id = id;
    *view->end = row;
    view->end = &row->next;
    view->largest = fmax(view->largest, fmax(fabs(c->load_largest), fabs(c->load_mean)));
}

static void free_rows(list_view *view)
{
    while (view->first) {
        list_row *row = view->first;
        view->first = row->next;
        free((char *)(uintptr_t)row->of.keys);
        free((char *)(uintptr_t)row->of.id);
        free(row);
    }
}

static void print_rows(const list_view *view)
{
    if (view->first)
        printf("%9s %11s %6s %23s %13s  %s\n", "condition", "runs", "failed", "mean load", "largest", "id and keys");
    for (const list_row *row = view->first; row; row = row->next) {
        const fram_study_standing *c = &row->of;
        char runs[48], mean[LOAD_ROOM], largest[LOAD_ROOM];
        snprintf(runs, sizeof runs, "%lld/%lld", (long long)c->runs, (long long)c->wanted);
        tell_load(c->load_mean, c->load_mean_half, view->largest, mean);
        tell_load(c->load_largest, (double)NAN, view->largest, largest);
        tell(stdout, "%9d %11s %6lld %23s %13s  %s %s\n", c->condition, runs, (long long)c->failed, mean, largest,
             c->id, c->keys);
    }
}

static void list_condition(void *user, const fram_study_standing *c)
{
    list_view *view = user;
    view->runs += c->runs;
    view->failed += c->failed;
    view->wanted += c->wanted;
    bool first = view->conditions++ == 0;
    if (view->json) {
        if (first) {
            view->out = json_begin();
            json_open_list(&view->out, "list");
        }
        json_open(&view->out, NULL);
        json_integer(&view->out, "condition", c->condition);
        json_text(&view->out, "id", c->id);
        json_text(&view->out, "keys", c->keys);
        json_integer(&view->out, "runs", c->runs);
        json_integer(&view->out, "wanted", c->wanted);
        json_integer(&view->out, "failed", c->failed);
        json_real(&view->out, "load_mean_N", c->load_mean);
        json_real(&view->out, "load_mean_half_N", c->load_mean_half);
        json_real(&view->out, "load_largest_N", c->load_largest);
        json_close(&view->out);
        return;
    }
    keep_row(view, c);
}

static int answer_list(const common_options *common, fram_context *context, const char *folder)
{
    list_view view = {.json = common->json};
    view.end = &view.first;
    fram_error error = {0};
    fram_status status = fram_study_list(context, folder, list_condition, &view, &error);
    if (view.json && view.conditions > 0) {
        json_close_list(&view.out);
        json_integer(&view.out, "conditions", view.conditions);
        json_integer(&view.out, "runs", view.runs);
        json_integer(&view.out, "wanted", view.wanted);
        json_integer(&view.out, "failed", view.failed);
        json_end(&view.out);
    }
    if (status == FRAM_OK && !view.failed_memory)
        print_rows(&view);
    free_rows(&view);
    if (status != FRAM_OK)
        return answer_error(common, &error);
    if (view.failed_memory)
        return answer_memory(common);
    if (!view.json)
        printf("%lld of %lld runs of %lld condition%s, %lld failed\n", (long long)view.runs, (long long)view.wanted,
               (long long)view.conditions, plural(view.conditions), (long long)view.failed);
    return EXIT_GOOD;
}

/* ---- fram study ---- */

typedef struct study_view {
    bool terminal;
    int64_t told; /* runs and records done when the last line was written, -1 before */
    double when;  /* wall-clock time of it [s] */
} study_view;

/* Between lines where the output is no terminal, and on a terminal while no run ends [s]. */
#define LINE_INTERVAL 10

static void show(void *user, const fram_study_progress *p)
{
    study_view *view = user;
    int64_t done = p->done + p->records_done;
    bool last = done == p->planned + p->records && view->told != done;
    bool due = p->wall - view->when >= LINE_INTERVAL || view->told < 0;
    if (!last && !due && (!view->terminal || view->told == done))
        return;
    view->told = done;
    view->when = p->wall;
    line_part part[5] = {{.rank = 0}, {.rank = 1}, {.rank = 2}, {.rank = 3}, {.rank = 4}};
    char words[DURATION_ROOM];
    snprintf(part[0].text, sizeof part[0].text, "%lld of %lld runs", (long long)p->done, (long long)p->planned);
    if (p->failed > 0)
        snprintf(part[1].text, sizeof part[1].text, ", %lld failed", (long long)p->failed);
    if (p->eta > 0)
        snprintf(part[2].text, sizeof part[2].text, ", about %s left", duration_words(p->eta, words));
    if (p->records > 0)
        snprintf(part[3].text, sizeof part[3].text, "; %lld of %lld worst runs made again with a record",
                 (long long)p->records_done, (long long)p->records);
    if (p->waits)
        snprintf(part[4].text, sizeof part[4].text, "; %s", p->waits);
    terminal_line(part, 5);
}

static void print_study(const char *folder, const fram_study_result *r, bool dry)
{
    fprintf(stderr, "%lld run%s of %lld condition%s, %lld failed; ", (long long)r->runs, plural(r->runs),
            (long long)r->conditions, plural(r->conditions), (long long)r->failed);
    if (dry)
        fputs("nothing was submitted\n", stderr);
    else
        fprintf(stderr, "%lld carried out now\n", (long long)r->made);
    if (r->runs > 0)
        tell(stderr, "results: %s/study.html is the page, summary.csv and conditions.csv beside it the tables\n",
             folder);
}

static int answer_result(const common_options *common, const char *folder, const fram_study_result *r, bool dry)
{
    if (!common->quiet)
        print_study(folder, r, dry);
    if (r->failed > 0)
        tell(stderr, "the first that failed: condition %lld, seed %lld: %s%s\n", (long long)r->failed_condition,
             (long long)r->failed_seed, r->reason, r->made == 0 && !dry ? " (--retry repeats failed runs)" : "");
    int code = r->runs > 0 && r->failed == r->runs ? EXIT_RUN_FAILED : EXIT_GOOD;
    if (!common->json)
        return code;
    json j = json_begin();
    json_integer(&j, "conditions", r->conditions);
    json_integer(&j, "runs", r->runs);
    json_integer(&j, "failed", r->failed);
    json_integer(&j, "made", r->made);
    json_text(&j, "folder", folder);
    json_end(&j);
    return code;
}

static int run_study(const common_options *common, const fram_study *study, fram_study_definition *d)
{
    char program[PATH_MAX];
    int code = own_path(common, program);
    if (code >= 0)
        return code;
    study_view view = {.terminal = terminal_draws(), .told = -1};
    fram_study_result result = {0};
    fram_error error = {0};
    d->program = program;
    d->progress = common->quiet ? NULL : show;
    d->progress_user = &view;
    d->stop = session_stop_flag();
    fram_status status = fram_study_run(study, d, &result, &error);
    if (view.terminal && view.told >= 0)
        fputc('\n', stderr);
    return status == FRAM_OK ? answer_result(common, d->folder, &result, d->dry_run) : answer_error(common, &error);
}

/* What `check` and `list` have no use for would say something else than it does. */
static int refuse_idle(const common_options *common, const fram_study_definition *d, bool check)
{
    const struct {
        const char *name;
        bool given;
    } idle[] = {{"--output", d->folder},
                {"--jobs", !check && d->jobs != 0},
                {"--on", d->on},
                {"--partition", d->slurm_partition},
                {"--time", d->slurm_time},
                {"--runs-per-task", d->slurm_runs_per_task > 0},
                {"--sbatch", d->slurm_option_count > 0},
                {"--poll", d->slurm_poll > 0},
                {"--dry-run", d->dry_run},
                {"--retry", d->retry}};
    for (size_t i = 0; i < sizeof idle / sizeof *idle; i++)
        if (idle[i].given)
            return answer_usage(common, idle[i].name,
                                check ? "is for the study itself, and check writes nothing: leave it out"
                                      : "is for a study that runs, and list only looks: leave it out");
    return -1;
}

/* The library is not told the jobs of a check. */
static int refuse_jobs(const common_options *common, int jobs)
{
    char text[64];
    if (jobs >= 0 && jobs <= FRAM_STUDY_JOBS)
        return -1;
    snprintf(text, sizeof text, "expected 0 to %d processes, found %d", FRAM_STUDY_JOBS, jobs);
    return answer_usage(common, "--jobs", text);
}

/* Words and options that do not go together; -1: they do. */
static int refuse_words(const common_options *common, const fram_study_definition *d, const char *const words[2],
                        bool check, bool list)
{
    if (!words[1] && strcmp(words[0], "check") == 0 && access("check", F_OK) != 0)
        return answer_usage(common, "check", "lacks its study: fram study check STUDY");
    if (!words[1] && strcmp(words[0], "list") == 0 && access("list", F_OK) != 0)
        return answer_usage(common, "list", "lacks its folder: fram study list DIR");
    if (words[1] && !check && !list)
        return answer_usage(common, words[0],
                            "expected one study file, or: fram study check STUDY, or: fram study list DIR");
    int code = check || list ? refuse_idle(common, d, check) : -1;
    if (code >= 0)
        return code;
    if (!check && !list && !d->folder)
        return answer_usage(common, "--output", "is missing: name the folder for the results, -o DIR");
    return check ? refuse_jobs(common, d->jobs) : -1;
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
        {"--jobs", "-j", OPTION_INTEGER, &d.jobs, "N",
         "concurrent processes (as many as cores and free memory allow); by Slurm, concurrent tasks of an array"},
        {"--on", NULL, OPTION_TEXT, &d.on, "WHERE", "local, or slurm: job arrays over a shared folder (local)"},
        {"--partition", NULL, OPTION_TEXT, &d.slurm_partition, "NAME", "Slurm partition (the cluster's default)"},
        {"--time", NULL, OPTION_TEXT, &d.slurm_time, "T", "time limit of a task, as for sbatch: 1:00:00"},
        {"--runs-per-task", NULL, OPTION_COUNT, &d.slurm_runs_per_task, "N",
         "runs per task, one after another (so that there are at most 200 tasks)"},
        {"--sbatch", NULL, OPTION_LIST, &sbatch, "OPTION",
         "further option of sbatch, such as --account=ice; may be repeated"},
        {"--poll", NULL, OPTION_SIZE, &d.slurm_poll, "T", "seconds between queries to the scheduler (30)"},
        {"--dry-run", NULL, OPTION_FLAG, &d.dry_run, NULL, "print the script for Slurm, submit nothing"},
        {"--retry", NULL, OPTION_FLAG, &d.retry, NULL, "repeat failed runs"},
    };
    int code = options_read_some(self, rows, sizeof rows / sizeof *rows, &common, argc, argv, words, 1, 2);
    if (code >= 0)
        return code;
    d.slurm_options = sbatch.value;
    d.slurm_option_count = sbatch.count;
    bool check = words[1] && strcmp(words[0], "check") == 0, list = words[1] && strcmp(words[0], "list") == 0;
    code = refuse_words(&common, &d, words, check, list);
    if (code >= 0)
        return code;
    fram_context *context = NULL;
    work_view work;
    code = session_open_reading(&common, &work, &context);
    if (code >= 0)
        return code;
    fram_study *study = NULL;
    fram_error error = {0};
    if (list)
        code = answer_list(&common, context, words[1]);
    else if (fram_study_load(context, words[check ? 1 : 0], &study, &error) != FRAM_OK)
        code = answer_error(&common, &error);
    else if (check)
        code = answer_extent(&common, study, d.jobs);
    else
        code = run_study(&common, study, &d);
    fram_study_destroy(study);
    fram_context_destroy(context);
    return code;
}
