/* Studies of the public API. */
#include "fram/study.h"

#include "api/arguments.h"
#include "api/handles.h"
#include "sim/bench_looks.h"
#include "sim/notes.h"
#include "sim/scene_size.h"
#include "study/extent.h"
#include "study/processes.h"
#include "study/study_file.h"
#include "study/study_folder.h"
#include "study/study_record.h"
#include "study/study_run.h"
#include "study/study_warnings.h"
#include "study/study_worst.h"
#include "study/twins.h"

#include <math.h>
#include <string.h>

struct fram_study {
    fram_context *context;
    study inner;
};

fram_status fram_study_load(fram_context *c, const char *path, fram_study **out, fram_error *error)
{
    fram_status status = REFUSE_NULL(error, {"context", c}, {"path", path}, {"study", out});
    if (status != FRAM_OK)
        return status;
    fram_study *s = memory_array(&c->inner, 1, sizeof *s);
    if (!s)
        return error_memory(error);
    s->context = c;
    status = study_read(&c->inner, path, &s->inner, error);
    if (status == FRAM_OK)
        *out = s;
    else
        memory_free(&c->inner, s);
    return status;
}

void fram_study_destroy(fram_study *s)
{
    if (!s)
        return;
    context *ctx = &s->context->inner;
    study_free(ctx, &s->inner);
    memory_free(ctx, s);
}

/* ---- what it will take ---- */

/* Computing before the looks at a run [s]: at its start and on its way. */
enum { LOOKS = 2 };
static const double looks_after[LOOKS] = {0, 5};
/* A program that starts, reads, and writes what a run leaves: what a run of no steps takes [s]. */
#define PROGRAM_SECONDS 0.1
/* A row of a summary, and the page that plays a run without its record [bytes]. */
enum { ROW_BYTES = 1200, PAGE_BYTES = 670000 };

static double bytes_of(const scenario *s, study_keep keep, int32_t floes)
{
    scene_disk folder = scene_disk_of(s, floes);
    return ROW_BYTES + (keep == KEEP_ALL ? folder.all : keep == KEEP_SERIES ? folder.rows : 0);
}

/* The whole folder of a run with a record, which its playback has once more. */
static double record_bytes_of(const scenario *s, int32_t floes)
{
    scenario one = *s;
    one.output.frame_interval = study_worst_frames(s);
    return bytes_of(&one, KEEP_ALL, floes) + scene_disk_of(&one, floes).frames + PAGE_BYTES;
}

/* Steps that the ice stays in a domain that it drifts through. */
static double steps_of_stay(const scenario *s, double drift)
{
    const scenario_domain *d = &s->domain;
    if (d->boundary == DOMAIN_WALLS || !(drift > 0))
        return (double)INFINITY;
    return fmax(d->x_max - d->x_min, d->y_max - d->y_min) / drift / s->run.time_step;
}

static step_look step_look_of(const bench_look *l)
{
    return (step_look){l->time, l->contacts, l->floes, (double)l->at};
}

/* Time and bytes of a run of one condition, added to those of the others. */
static fram_status measure_condition(const fram_study *s, int32_t condition, study_warnings *warnings,
                                     fram_study_extent *out, fram_error *error)
{
    scenario one = {0};
    bench_look found[LOOKS] = {{0}};
    double build = 0;
    context telling = study_warnings_of(warnings, condition), *ctx = &telling;
    fram_status status = study_scenario(ctx, &s->inner, condition, s->inner.seeds.first, &one, error);
    if (status != FRAM_OK)
        return status;
    const build_look made = notes_ask_what_was_made(&one) ? notes_log_warnings : NULL;
    status = bench_looks(ctx, &one, made, looks_after, LOOKS, found, &build, error);
    if (status == FRAM_OK) {
        step_look early = step_look_of(&found[0]), late = step_look_of(&found[1]);
        double steps = (double)scenario_step_at(one.run.duration, one.run.time_step);
        double breaking = breaking_step_time(&early, &late, steps, steps_of_stay(&one, found[1].drift));
        out->run_seconds += PROGRAM_SECONDS + build + steps * late.time;
        out->run_seconds_packed += PROGRAM_SECONDS + build + steps * fmax(packed_step_time(&early, &late), breaking);
        out->run_bytes += bytes_of(&one, s->inner.keep, late.floes);
        out->record_bytes += record_bytes_of(&one, late.floes);
        out->seen = fmin(out->seen, (double)(found[1].at + found[1].steps) / steps);
    } else if (status == FRAM_ERROR_INPUT) {
        study_place_error(&s->inner, condition, error);
    }
    scenario_free(ctx, &one);
    return status;
}

/* What conditions have in common while they are looked at, and what is found. */
typedef struct condition_looks {
    hull_store store;
    text_buffer known; /* files that were read */
    double bytes;      /* the most that a run may take of memory */
    study_warnings *warnings;
} condition_looks;

/* Builds the vessels of a condition, and takes its name, by which a study tells it from others. */
static fram_status look_at_condition(context *ctx, const fram_study *s, int32_t condition, condition_looks *looks,
                                     char id[CONDITION_ID], fram_error *error)
{
    scenario one = {0};
    condition_name name = {.id = ""};
    fram_status status = study_scenario(ctx, &s->inner, condition, s->inner.seeds.first, &one, error);
    if (status != FRAM_OK)
        return status;
    looks->bytes = fmax(looks->bytes, scene_size_of(&one).bytes);
    status = study_build_check(looks->warnings, condition, &one, &looks->store, error);
    if (status == FRAM_OK)
        status = condition_name_find(ctx, &one, &looks->known, &name, error);
    memcpy(id, name.id, CONDITION_ID);
    text_free(ctx, &name.files);
    scenario_free(ctx, &one);
    return status;
}

/* All conditions, for those that are not measured: how many differ, and how many of their runs go at a time. */
static fram_status look_at_conditions(context *ctx, const fram_study *s, study_warnings *warnings, int32_t *differ,
                                      int *jobs, fram_error *error)
{
    int32_t count = s->inner.conditions;
    char(*id)[CONDITION_ID] = memory_array(ctx, (size_t)count, CONDITION_ID);
    fram_status status = id ? FRAM_OK : error_memory(error);
    condition_looks looks = {.warnings = warnings};
    for (int32_t c = 0; c < count && status == FRAM_OK; c++) {
        status = work_continue(ctx, "looking at the conditions", c, count, error);
        if (status == FRAM_OK)
            status = look_at_condition(ctx, s, c, &looks, id[c], error);
    }
    hull_store_free(ctx, &looks.store);
    text_free(ctx, &looks.known);
    int32_t *first = status == FRAM_OK ? twins_find(ctx, id, count) : NULL;
    if (status == FRAM_OK && !first)
        status = error_memory(error);
    *differ = 0;
    for (int32_t c = 0; first && c < count; c++)
        *differ += first[c] == c;
    *jobs = processes_that_fit(processes_cores(), processes_memory(), looks.bytes);
    memory_free(ctx, first);
    memory_free(ctx, id);
    return status;
}

fram_status(fram_study_measure)(const fram_study *s, fram_study_extent *out, fram_error *error, size_t size)
{
    fram_status status = REFUSE_NULL(error, {"study", s}, {"extent", out});
    if (status == FRAM_OK)
        status = RESULT_CHECK(out, size, fram_study_extent, error);
    if (status != FRAM_OK)
        return status;
    const study *inner = &s->inner;
    fram_study_extent e = {.conditions = inner->conditions, .seen = 1};
    int32_t last = inner->conditions - 1, measured = last > 0 ? 2 : 1, differ = 0;
    /* What a run says of its start is not asked here. */
    context quiet = s->context->inner;
    quiet.verbosity = quiet.verbosity > LOG_WARNING ? LOG_WARNING : quiet.verbosity;
    study_warnings warnings = {.ctx = &quiet, .s = inner};
    status = look_at_conditions(&quiet, s, &warnings, &differ, &e.jobs, error);
    if (status == FRAM_OK)
        status = measure_condition(s, 0, &warnings, &e, error);
    if (status == FRAM_OK && last > 0)
        status = measure_condition(s, last, &warnings, &e, error);
    status = study_warnings_end(&warnings, status, error);
    if (status != FRAM_OK)
        return status;
    e.differ = differ;
    e.runs_least = (int64_t)differ * inner->seeds.least;
    e.runs_most = (int64_t)differ * inner->seeds.most;
    e.run_seconds /= measured;
    e.run_seconds_packed /= measured;
    e.run_bytes /= measured;
    e.record_bytes /= measured;
    e.records = inner->worst.count < e.runs_most ? inner->worst.count : e.runs_most;
    result_give(out, size, &e);
    return FRAM_OK;
}

/* ---- run ---- */

static void fram_study_fill(fram_study_definition *definition)
{
    *definition = (fram_study_definition){.size = sizeof *definition};
}
DEFINITION_DEFAULT(fram_study, fram_study_definition)

typedef struct study_progress_bridge {
    fram_study_progress_function function;
    void *user;
} study_progress_bridge;

static void forward_study_progress(void *user, const study_progress *p)
{
    const study_progress_bridge *bridge = user;
    const fram_study_progress out = {p->done, p->failed,       p->planned, p->wall,
                                     p->eta,  p->records_done, p->records, p->waits};
    bridge->function(bridge->user, &out);
}

/* Bounds of what is asked of Slurm: a script's line, runs of a task, seconds. */
enum { SLURM_WORD_MOST = 200, SLURM_RUNS_MOST = 1000000 };
#define SLURM_POLL_MOST 3600

static fram_status check_slurm_word(const char *key, const char *word, fram_error *error)
{
    if (!word || (*word && strlen(word) <= SLURM_WORD_MOST && !strpbrk(word, "\n\r")))
        return FRAM_OK;
    return error_set(error, FRAM_ERROR_USAGE, NULL, 0, key, "expected one line of 1 to %d letters", SLURM_WORD_MOST);
}

/* Letters, dashes too, by which sbatch tells those that are refused from its others. */
enum { OPTION_LEAST = 4 };

/* Whether the word is that option, or what sbatch takes for it: it does with fewer letters. */
static bool is_option(const char *word, const char *name)
{
    size_t length = strcspn(word, "= \t");
    return length >= OPTION_LEAST && strncmp(word, name, length) == 0;
}

/* Options by which tasks would not be those that are waited for. */
static fram_status check_slurm_option(const char *word, fram_error *error)
{
    fram_status status = check_slurm_word("slurm_options", word, error);
    if (status != FRAM_OK)
        return status;
    if (strncmp(word, "--", 2) != 0)
        return error_set(error, FRAM_ERROR_USAGE, NULL, 0, "slurm_options",
                         "expected an option of sbatch, as --account=ice, found %.60s", word);
    if (is_option(word, "--array"))
        return error_set(error, FRAM_ERROR_USAGE, NULL, 0, "slurm_options",
                         "the study numbers its tasks itself: expected no --array; runs a task make fewer of them");
    if (is_option(word, "--quiet"))
        return error_set(error, FRAM_ERROR_USAGE, NULL, 0, "slurm_options",
                         "expected no --quiet, with which sbatch tells no number by which tasks are waited for");
    if (is_option(word, "--clusters"))
        return error_set(error, FRAM_ERROR_USAGE, NULL, 0, "slurm_options",
                         "expected no --clusters, which squeue would not know of: set SLURM_CLUSTERS for all commands "
                         "of Slurm");
    return FRAM_OK;
}

static fram_status check_slurm_options(const fram_study_definition *d, fram_error *error)
{
    fram_status status = FRAM_OK;
    if (d->slurm_option_count < 0)
        return error_set(error, FRAM_ERROR_USAGE, NULL, 0, "slurm_option_count", "expected 0 or more, found %d",
                         d->slurm_option_count);
    for (int i = 0; status == FRAM_OK && i < d->slurm_option_count; i++) {
        if (!d->slurm_options || !d->slurm_options[i])
            return error_set(error, FRAM_ERROR_USAGE, NULL, 0, "slurm_options", "expected %d texts, found NULL at %d",
                             d->slurm_option_count, i);
        status = check_slurm_option(d->slurm_options[i], error);
    }
    return status;
}

static fram_status check_slurm(const fram_study_definition *d, fram_error *error)
{
    bool slurm = d->on && strcmp(d->on, "slurm") == 0;
    bool asked = d->slurm_partition || d->slurm_time || d->slurm_option_count != 0 || d->slurm_runs_per_task > 0 ||
                 d->slurm_poll > 0 || d->dry_run;
    if (!slurm && asked)
        return error_set(error, FRAM_ERROR_USAGE, NULL, 0, "on",
                         "partition, time, runs a task, options of sbatch, queries and a dry run are for slurm alone");
    fram_status status = check_slurm_word("slurm_partition", d->slurm_partition, error);
    if (status == FRAM_OK)
        status = check_slurm_word("slurm_time", d->slurm_time, error);
    if (status == FRAM_OK)
        status = check_slurm_options(d, error);
    if (status == FRAM_OK && (d->slurm_runs_per_task < 0 || d->slurm_runs_per_task > SLURM_RUNS_MOST))
        status = error_set(error, FRAM_ERROR_USAGE, NULL, 0, "slurm_runs_per_task", "expected 0 to %d, found %d",
                           SLURM_RUNS_MOST, d->slurm_runs_per_task);
    if (status == FRAM_OK && !(d->slurm_poll >= 0 && d->slurm_poll <= SLURM_POLL_MOST))
        status = error_set(error, FRAM_ERROR_USAGE, NULL, 0, "slurm_poll", "expected 0 to %d s, found %g",
                           SLURM_POLL_MOST, d->slurm_poll);
    return status;
}

static fram_status take_study(const fram_study_definition *given, fram_study_definition *d, fram_error *error)
{
    fram_study_fill(d);
    fram_status status = definition_take(d, given, sizeof *d, DEFINITION_LEAST, "fram_study", error);
    if (status == FRAM_OK)
        status = folder_check("folder", d->folder, error);
    if (status != FRAM_OK)
        return status;
    if (!d->program || !*d->program)
        return error_set(error, FRAM_ERROR_USAGE, NULL, 0, "program", "the path of the command fram must be given");
    if (d->jobs < 0 || d->jobs > FRAM_STUDY_JOBS)
        return error_set(error, FRAM_ERROR_USAGE, NULL, 0, "jobs", "expected 0 to %d processes, found %d",
                         FRAM_STUDY_JOBS, d->jobs);
    if (d->on && strcmp(d->on, "local") != 0 && strcmp(d->on, "slurm") != 0)
        return error_set(error, FRAM_ERROR_USAGE, NULL, 0, "on", "expected local or slurm, found %.60s", d->on);
    return check_slurm(d, error);
}

fram_status(fram_study_run)(const fram_study *s, const fram_study_definition *definition, fram_study_result *result,
                            fram_error *error, size_t size)
{
    fram_study_definition taken, *d = &taken;
    fram_status status = REFUSE_NULL(error, {"study", s});
    if (status == FRAM_OK)
        status = RESULT_CHECK(result, size, fram_study_result, error);
    if (status == FRAM_OK)
        status = take_study(definition, d, error);
    if (status != FRAM_OK)
        return status;
    study_progress_bridge bridge = {d->progress, d->progress_user};
    const slurm_options slurm = {.partition = d->slurm_partition,
                                 .time = d->slurm_time,
                                 .options = d->slurm_options,
                                 .option_count = d->slurm_option_count,
                                 .runs_per_task = d->slurm_runs_per_task,
                                 .poll = d->slurm_poll,
                                 .dry_run = d->dry_run,
                                 .jobs = d->jobs};
    const study_options options = {.folder = d->folder,
                                   .program = d->program,
                                   .jobs = d->jobs,
                                   .retry = d->retry,
                                   .progress = d->progress ? forward_study_progress : NULL,
                                   .progress_user = &bridge,
                                   .stop = d->stop,
                                   .slurm = d->on && strcmp(d->on, "slurm") == 0 ? &slurm : NULL};
    study_result inner = {0};
    status = study_run(&s->context->inner, &s->inner, &options, &inner, error);
    fram_study_result out = {.conditions = inner.conditions,
                             .runs = inner.runs,
                             .failed = inner.failed,
                             .made = inner.made,
                             .failed_condition = inner.failed_condition,
                             .failed_seed = inner.failed_seed};
    _Static_assert(sizeof out.reason == sizeof inner.reason, "a reason is told whole");
    memcpy(out.reason, inner.reason, sizeof out.reason);
    if (status == FRAM_OK || status == FRAM_INTERRUPTED)
        result_give(result, size, &out);
    return status;
}

/* ---- how it stands ---- */

typedef struct standing_bridge {
    fram_study_standing_function function;
    void *user;
} standing_bridge;

static void forward_standing(void *user, const condition_standing *c)
{
    const standing_bridge *bridge = user;
    const fram_study_standing out = {.size = sizeof out,
                                     .condition = c->condition,
                                     .runs = c->runs,
                                     .failed = c->failed,
                                     .wanted = c->wanted,
                                     .load_mean = c->load_mean,
                                     .load_mean_half = c->load_mean_half,
                                     .load_largest = c->load_largest,
                                     .keys = c->keys,
                                     .id = c->id};
    bridge->function(bridge->user, &out);
}

fram_status fram_study_list(fram_context *c, const char *folder, fram_study_standing_function function, void *user,
                            fram_error *error)
{
    fram_status status = REFUSE_NULL(error, {"context", c}, {"folder", folder});
    if (status == FRAM_OK && !*folder)
        status = error_set(error, FRAM_ERROR_USAGE, NULL, 0, "folder", "a folder of a study must be named");
    if (status == FRAM_OK && !function)
        status = error_set(error, FRAM_ERROR_USAGE, NULL, 0, "function", "expected a function, found NULL");
    if (status != FRAM_OK)
        return status;
    standing_bridge bridge = {function, user};
    return study_list(&c->inner, folder, forward_standing, &bridge, error);
}
