#include "study/study_run.h"

#include "base/clock.h"
#include "study/no_answer.h"
#include "study/processes.h"
#include "study/seeds.h"
#include "study/slurm.h"
#include "study/study_answers.h"
#include "study/study_folder.h"
#include "study/study_worst.h"
#include "study/twins.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* What is known of one seed of a condition. */
typedef enum run_state {
    RUN_MISSING = 0,
    RUN_BUSY, /* another program still makes it */
    RUN_GOING,
    RUN_THERE
} run_state;
typedef struct study_seed {
    run_state state;
    row_file found; /* of its row, before it was made */
    run_row row;
} study_seed;

typedef struct study_condition {
    ARRAY(study_seed) seeds; /* from the first on */
    int32_t wanted;          /* seeds */
} study_condition;

typedef struct study_work {
    context *ctx;
    const study *s;
    const study_options *options;
    study_folder folder;
    study_condition *conditions;
    double *block;     /* of each condition: how long its runs are after the transient [s]; NULL: not asked */
    int32_t *first_of; /* of each condition: the first one that is the same scenario, whose runs are its own */
    process_pool pool;
    const char *node;    /* of a cluster, where the run was that ended last; NULL: here */
    ARRAY(int64_t) task; /* condition and seed of each that was started */
    int jobs;
    int32_t busy; /* runs that another program still makes */
    double started;
    int32_t made;
    bool told_other; /* that there are runs of another Fram: once */
} study_work;

/* ---- what is there ---- */

static void tell_of_another(study_work *w, const char *path)
{
    if (!w->told_other)
        log_write(w->ctx, LOG_WARNING,
                  "%s is of another Fram, some of whose figures mean something else: such runs are made again", path);
    w->told_other = true;
}

static fram_status load_row(study_work *w, int32_t condition, int32_t index, fram_error *error)
{
    study_seed *seed = &w->conditions[condition].seeds.data[index];
    char *path = study_run_path(&w->folder, condition, w->s->seeds.first + index, ".row");
    run_rows rows = {0};
    fram_status status = path ? run_rows_read(w->ctx, path, &rows, &seed->found, error) : error_memory(error);
    if (path && seed->found == ROWS_OTHER)
        tell_of_another(w, path);
    memory_free(w->ctx, path);
    const run_row *chosen = seed->found == ROWS_WHOLE ? run_rows_find(&rows, w->s->vessel) : NULL;
    if (chosen && !chosen->failed)
        study_run_finish(&w->folder, condition, w->s->seeds.first + index, w->s->keep);
    if (chosen)
        seed->row = *chosen;
    seed->state = chosen && !(seed->row.failed && w->options->retry) ? RUN_THERE : RUN_MISSING;
    array_free(w->ctx, &rows);
    return status;
}

/* Seeds from the first without a gap. */
static int32_t prefix_of(const study_condition *c)
{
    int32_t n = 0;
    while (n < c->seeds.count && c->seeds.data[n].state == RUN_THERE)
        n++;
    return n;
}

/* How many seeds the condition takes, as far as its results tell now; rows of seeds that are new are looked for. */
static fram_status update_wanted(study_work *w, int32_t condition, fram_error *error)
{
    study_condition *c = &w->conditions[condition];
    for (;;) {
        int32_t n = prefix_of(c), room = n > 0 ? n : 1;
        double *value = memory_array(w->ctx, (size_t)room, 2 * sizeof *value);
        if (!value)
            return error_memory(error);
        for (int32_t i = 0; i < n; i++) {
            value[i] = c->seeds.data[i].row.figure[ROW_load_mean];
            value[room + i] = c->seeds.data[i].row.figure[ROW_load_largest];
        }
        const seeds_extreme rare = seeds_extreme_of(w->ctx, w->s, w->block ? w->block[condition] : 1);
        c->wanted = seeds_wanted(&w->s->seeds, value, value + room, &rare, n);
        memory_free(w->ctx, value);
        if (c->wanted <= c->seeds.count)
            return FRAM_OK;
        for (int32_t i = c->seeds.count; i < c->wanted; i++) {
            const study_seed fresh = {0};
            if (!array_push(w->ctx, &c->seeds, fresh))
                return error_memory(error);
            fram_status status = load_row(w, condition, i, error);
            if (status != FRAM_OK)
                return status;
        }
    }
}

/* ---- runs ---- */

static fram_status start_run(study_work *w, int32_t condition, int32_t index, fram_error *error)
{
    int64_t seed = w->s->seeds.first + index;
    char *path = study_scenario_path(&w->folder, condition), set[48];
    char *folder = study_run_path(&w->folder, condition, seed, "");
    char *log = study_run_path(&w->folder, condition, seed, ".log");
    snprintf(set, sizeof set, "run.seed=%lld", (long long)seed);
    /* What an earlier call left of this run is no result. */
    const char *const words[] = {w->options->program, "run", path,      "-o",      folder, "--set", set,
                                 "--threads",         "1",   "--force", "--quiet", NULL};
    fram_status status = path && folder && log && array_push(w->ctx, &w->task, (int64_t)condition << 32 | index)
                             ? processes_start(w->ctx, &w->pool, words, log, w->task.count - 1, error)
                             : error_memory(error);
    if (status == FRAM_OK)
        w->conditions[condition].seeds.data[index].state = RUN_GOING;
    memory_free(w->ctx, path);
    memory_free(w->ctx, folder);
    memory_free(w->ctx, log);
    return status;
}

static fram_status find_busy(const study_work *w, int32_t condition, int32_t index, bool *busy, fram_error *error)
{
    char *folder = study_run_path(&w->folder, condition, w->s->seeds.first + index, "");
    fram_status status = folder ? study_folder_busy(folder, busy, error) : error_memory(error);
    memory_free(w->ctx, folder);
    return status;
}

/* The next run that is wanted: all conditions' first seeds come before anybody's later ones. */
static bool next_run(const study_work *w, int32_t *condition, int32_t *index)
{
    int32_t least = INT32_MAX;
    for (int32_t c = 0; c < w->s->conditions; c++) {
        const study_condition *of = &w->conditions[c];
        for (int32_t i = 0; i < of->wanted && i < least && w->first_of[c] == c; i++) {
            if (of->seeds.data[i].state != RUN_MISSING)
                continue;
            *condition = c;
            *index = least = i;
        }
    }
    return least < INT32_MAX;
}

/* Busy runs are looked at again. */
static void look_again(study_work *w)
{
    w->busy = 0;
    for (int32_t c = 0; c < w->s->conditions; c++) {
        study_condition *of = &w->conditions[c];
        for (int32_t i = 0; i < of->seeds.count; i++)
            if (of->seeds.data[i].state == RUN_BUSY)
                of->seeds.data[i].state = RUN_MISSING;
    }
}

static void set_busy(study_work *w, int32_t condition, int32_t index)
{
    w->conditions[condition].seeds.data[index].state = RUN_BUSY;
    w->busy++;
}

static fram_status fill_pool(study_work *w, fram_error *error)
{
    int32_t condition = 0, index = 0;
    fram_status status = FRAM_OK;
    bool busy = false;
    while (status == FRAM_OK && w->pool.running.count < w->jobs && next_run(w, &condition, &index)) {
        status = find_busy(w, condition, index, &busy, error);
        if (status == FRAM_OK && !busy)
            status = start_run(w, condition, index, error);
        if (!busy)
            continue;
        set_busy(w, condition, index);
    }
    return status;
}

/* The figures of a run that ended: of all vessels to its file, those of the study's vessel to *out. */
static fram_status judge_run(const study_work *w, const char *folder, const char *path, int exit_code, run_row *out,
                             fram_error *error)
{
    run_rows rows = {0};
    fram_status status = exit_code == 0 ? run_rows_of(w->ctx, folder, &rows, error)
                                        : run_rows_failed(w->ctx, folder, exit_code, &rows, error);
    if (status == FRAM_OK)
        status = run_rows_write(w->ctx, path, &rows, error);
    const run_row *chosen = status == FRAM_OK ? run_rows_find(&rows, w->s->vessel) : NULL;
    if (chosen)
        *out = *chosen;
    else if (status == FRAM_OK)
        status =
            error_set(error, FRAM_ERROR_INTERNAL, folder, 0, "vessel", "the run has no vessel \"%s\"", w->s->vessel);
    array_free(w->ctx, &rows);
    return status;
}

/* A run of a condition is that of every condition that is the same scenario. */
static fram_status share_result(study_work *w, int32_t condition, int32_t index, fram_error *error)
{
    fram_status status = FRAM_OK;
    for (int32_t c = condition; c < w->s->conditions && status == FRAM_OK; c++) {
        study_condition *of = &w->conditions[c];
        if (w->first_of[c] != condition)
            continue;
        if (c != condition && index < of->seeds.count)
            of->seeds.data[index] = w->conditions[condition].seeds.data[index];
        status = update_wanted(w, c, error);
    }
    return status;
}

static fram_status take_result(study_work *w, int32_t condition, int32_t index, int exit_code, fram_error *error)
{
    int64_t seed = w->s->seeds.first + index;
    study_seed *of = &w->conditions[condition].seeds.data[index];
    of->state = RUN_MISSING;
    if (exit_code == PROCESS_INTERRUPTED && !w->options->slurm)
        return FRAM_OK;
    char *folder = study_run_path(&w->folder, condition, seed, "");
    char *row = study_run_path(&w->folder, condition, seed, ".row");
    char *log = study_run_path(&w->folder, condition, seed, ".log");
    fram_status status = folder && row && log ? FRAM_OK : error_memory(error);
    const ended_run ended = {folder, log, w->options->program, w->node, exit_code};
    if (status == FRAM_OK && exit_code != 0)
        status = study_run_check_answer(w->ctx, &ended, error);
    /* Made when the other one has ended: a program of a study that was killed, here or on a node. */
    bool again = false;
    if (status == FRAM_OK && exit_code != 0)
        status = study_run_met_another(w->ctx, folder, log, &again, error);
    if (status == FRAM_OK && !again)
        status = study_run_check_files(&w->folder, condition, folder, error);
    if (status == FRAM_OK && !again)
        status = judge_run(w, folder, row, exit_code, &of->row, error);
    if (status == FRAM_OK && !again) {
        of->state = RUN_THERE;
        w->made++;
    }
    if (of->state == RUN_THERE && !of->row.failed)
        study_run_finish(&w->folder, condition, seed, w->s->keep);
    memory_free(w->ctx, folder);
    memory_free(w->ctx, row);
    memory_free(w->ctx, log);
    return of->state == RUN_THERE ? share_result(w, condition, index, error) : status;
}

static fram_status take_task(study_work *w, int32_t task, int exit_code, fram_error *error)
{
    int64_t of = w->task.data[task];
    return take_result(w, (int32_t)(of >> 32), (int32_t)(of & INT32_MAX), exit_code, error);
}

static void show_progress(const study_work *w, const char *waits)
{
    study_progress p = {.wall = clock_wall() - w->started, .waits = waits};
    for (int32_t c = 0; c < w->s->conditions; c++) {
        const study_condition *of = &w->conditions[c];
        p.planned += of->wanted;
        for (int32_t i = 0; i < of->wanted; i++) {
            p.done += of->seeds.data[i].state == RUN_THERE;
            p.failed += of->seeds.data[i].state == RUN_THERE && of->seeds.data[i].row.failed;
        }
    }
    if (w->made >= w->jobs)
        p.eta = p.wall / w->made * (p.planned - p.done);
    if (w->options->progress)
        w->options->progress(w->options->progress_user, &p);
}

/* Only what would be submitted is shown: tables that are there may know more, as of failures that it would retry. */
static bool is_dry(const study_work *w) { return w->options->slurm && w->options->slurm->dry_run; }

static bool asked_to_stop(const study_work *w) { return stop_is_asked(w->options->stop); }

static fram_status work_loop(study_work *w, fram_error *error)
{
    fram_status status = fill_pool(w, error);
    show_progress(w, NULL);
    double told = clock_wall();
    while (status == FRAM_OK && (w->pool.running.count > 0 || w->busy > 0) && !asked_to_stop(w)) {
        int32_t task = 0;
        int exit_code = 0;
        if (!processes_ended(&w->pool, &task, &exit_code)) {
            processes_pause();
            if (clock_wall() - told >= PROCESSES_TELL) {
                told = clock_wall();
                show_progress(w, NULL);
            }
            if (w->pool.running.count == 0) {
                look_again(w);
                status = fill_pool(w, error);
            }
            continue;
        }
        status = take_task(w, task, exit_code, error);
        if (status == FRAM_OK && !asked_to_stop(w))
            status = fill_pool(w, error);
        show_progress(w, NULL);
    }
    processes_stop(&w->pool);
    return status;
}

/* ---- runs by Slurm ---- */

/* Once: what is there from then on is of this call's tasks. */
static fram_status forget_found(study_work *w, int32_t condition, int32_t index, bool *busy, fram_error *error)
{
    study_seed *seed = &w->conditions[condition].seeds.data[index];
    *busy = false;
    if (seed->found == ROWS_NONE || is_dry(w))
        return FRAM_OK;
    char *folder = study_run_path(&w->folder, condition, w->s->seeds.first + index, "");
    fram_status status =
        folder ? study_run_forget(w->ctx, folder, !seed->row.failed, busy, error) : error_memory(error);
    if (status == FRAM_OK && !*busy)
        seed->found = ROWS_NONE;
    memory_free(w->ctx, folder);
    return status;
}

static fram_status add_missing(void *user, slurm_pool *queue, fram_error *error)
{
    study_work *w = user;
    int32_t condition = 0, index = 0;
    bool busy = false;
    look_again(w);
    while (next_run(w, &condition, &index)) {
        fram_status status = forget_found(w, condition, index, &busy, error);
        if (status != FRAM_OK)
            return status;
        if (busy) {
            set_busy(w, condition, index);
            continue;
        }
        if (!array_push(w->ctx, &w->task, (int64_t)condition << 32 | index) ||
            !slurm_add(queue, w->folder.id[condition], w->s->seeds.first + index, w->task.count - 1, 0))
            return error_memory(error);
        w->conditions[condition].seeds.data[index].state = RUN_GOING;
    }
    return FRAM_OK;
}

static fram_status take_ended(void *user, int32_t task, int exit_code, const char *node, fram_error *error)
{
    study_work *w = user;
    w->node = node;
    fram_status status = take_task(w, task, exit_code, error);
    w->node = NULL;
    return status;
}

static void tell_waits(void *user, const char *waits) { show_progress(user, waits); }

static fram_status slurm_loop(study_work *w, fram_error *error)
{
    const slurm_follower follower = {w, add_missing, take_ended, tell_waits, w->options->stop, &w->busy};
    return slurm_follow(w->ctx, w->options->slurm, w->options->folder, w->options->program, &follower, error);
}

/* ---- all ---- */

static void tell_alike(const study_work *w, const condition_rows *rows)
{
    int32_t alike = 0;
    for (int32_t c = 0; c < w->s->conditions; c++)
        alike += run_rows_alike(rows[c].rows.data, rows[c].rows.count);
    if (alike > 0)
        log_write(w->ctx, LOG_WARNING,
                  "%d of %d conditions: all runs came out the same, since nothing that run.seed draws acted in them: "
                  "one says all, and an interval of 0 says nothing of chance (ice.strength, or ice that is drawn, "
                  "varies with the seed)",
                  (int)alike, (int)w->s->conditions);
}

/* What a study keeps is decided as its runs end: those of a time when it kept less are not made again for that. */
static void tell_kept_less(const study_work *w)
{
    int64_t less = 0;
    for (int32_t c = 0; c < w->s->conditions; c++) {
        const study_condition *of = &w->conditions[c];
        for (int32_t i = 0; i < of->seeds.count && i < of->wanted && w->first_of[c] == c; i++)
            less += of->seeds.data[i].state == RUN_THERE && !of->seeds.data[i].row.failed &&
                    !study_run_has_kept(&w->folder, c, w->s->seeds.first + i, w->s->keep);
    }
    if (less > 0)
        log_write(w->ctx, LOG_WARNING,
                  "%lld %s made while the study kept less of a run than now: remove %s/runs to have all made again, or "
                  "name another folder",
                  (long long)less, less == 1 ? "run was" : "runs were", w->folder.path);
}

/* The tables of what is there, asked to stop or not; of a whole study also the worst runs, to which its page leads. */
static fram_status write_results(const study_work *w, bool whole, study_result *result, fram_error *error)
{
    context own = context_unstopped(w->ctx);
    study_folder folder = w->folder;
    folder.ctx = &own;
    condition_rows *rows = memory_array(w->ctx, (size_t)w->s->conditions, sizeof *rows);
    fram_status status = rows ? FRAM_OK : error_memory(error);
    *result = (study_result){.conditions = w->s->conditions, .made = w->made};
    for (int32_t c = 0; c < w->s->conditions && status == FRAM_OK; c++) {
        const study_condition *of = &w->conditions[c];
        int32_t n = prefix_of(of) < of->wanted ? prefix_of(of) : of->wanted;
        for (int32_t i = 0; i < n && status == FRAM_OK; i++) {
            if (!array_push(w->ctx, &rows[c].rows, of->seeds.data[i].row))
                status = error_memory(error);
            const run_row *row = &of->seeds.data[i].row;
            result->runs++;
            if (row->failed && result->failed++ == 0) {
                result->failed_condition = c + 1;
                result->failed_seed = w->s->seeds.first + i;
                memcpy(result->reason, row->reason, sizeof result->reason);
            }
        }
    }
    if (status == FRAM_OK) {
        tell_alike(w, rows);
        tell_kept_less(w);
        status = study_tables_write(&folder, rows, !is_dry(w), error);
    }
    bool changed = false;
    if (status == FRAM_OK && whole)
        status = study_worst_record(&w->folder, rows, w->options, &changed, error);
    if (changed) {
        fram_status written = study_page_write(&folder, rows, status == FRAM_OK ? error : NULL);
        status = status == FRAM_OK ? written : status;
    }
    for (int32_t c = 0; rows && c < w->s->conditions; c++)
        array_free(w->ctx, &rows[c].rows);
    memory_free(w->ctx, rows);
    return status;
}

fram_status study_run(context *ctx, const study *s, const study_options *options, study_result *result,
                      fram_error *error)
{
    context own = *ctx; /* other threads of a program may be at work in its own */
    ctx = &own;
    study_work w = {.ctx = ctx, .s = s, .options = options, .started = clock_wall()};
    const volatile int *stop = ctx->stop;
    ctx->stop = options->stop ? options->stop : stop;
    fram_status status = study_folder_open(ctx, s, options->folder, is_dry(&w), &w.folder, error);
    ctx->stop = stop;
    if (status != FRAM_OK)
        return status;
    w.jobs = options->slurm && options->jobs == 0 ? processes_cores() : study_folder_jobs(&w.folder, options->jobs);
    w.conditions = memory_array(ctx, (size_t)s->conditions, sizeof *w.conditions);
    w.first_of = twins_find(ctx, w.folder.id, s->conditions);
    if (!w.conditions || !w.first_of)
        status = error_memory(error);
    if (s->seeds.extreme_within > 0 && status == FRAM_OK)
        status = study_blocks(&w.folder, &w.block, error);
    for (int32_t c = 0; c < s->conditions && status == FRAM_OK; c++)
        status = update_wanted(&w, c, error);
    if (status == FRAM_OK)
        status = options->slurm ? slurm_loop(&w, error) : work_loop(&w, error);
    if (status == FRAM_OK && asked_to_stop(&w))
        status = study_interrupted(error);
    if (status == FRAM_OK || status == FRAM_INTERRUPTED) {
        bool whole = status == FRAM_OK && !is_dry(&w);
        fram_status written = write_results(&w, whole, result, status == FRAM_OK ? error : NULL);
        status = status == FRAM_OK ? written : status;
    }
    for (int32_t c = 0; w.conditions && c < s->conditions; c++)
        array_free(ctx, &w.conditions[c].seeds);
    memory_free(ctx, w.conditions);
    memory_free(ctx, w.first_of);
    memory_free(ctx, w.block);
    array_free(ctx, &w.task);
    processes_free(ctx, &w.pool);
    study_folder_close(&w.folder);
    return status;
}
