#include "study/study_worst.h"

#include "base/clock.h"
#include "base/number_text.h"
#include "io/atomic_file.h"
#include "io/folder.h"
#include "io/path.h"
#include "io/temporary.h"
#include "study/no_answer.h"
#include "study/processes.h"
#include "study/slurm.h"
#include "study/study_file.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

/* Between frames of a run whose scenario asks for none [s]. */
#define FRAMES_USUAL 1.0

/* ---- which ---- */

static bool is_among(const study_folder *f, const worst_run *all, int32_t count, int32_t condition, int32_t index)
{
    for (int32_t i = 0; i < count; i++)
        if (all[i].index == index && memcmp(f->id[all[i].condition], f->id[condition], CONDITION_ID) == 0)
            return true;
    return false;
}

int32_t study_worst_find(const study_folder *f, const condition_rows *conditions, run_figure figure, int32_t most,
                         worst_run *out)
{
    int32_t count = 0;
    for (int32_t c = 0; c < f->s->conditions; c++) {
        for (int32_t i = 0; i < conditions[c].rows.count; i++) {
            const run_row *row = &conditions[c].rows.data[i];
            double value = row->failed ? (double)NAN : row->figure[figure];
            int32_t at = count;
            while (at > 0 && value > out[at - 1].value)
                at--;
            if (!isfinite(value) || at >= most || is_among(f, out, count, c, i))
                continue;
            count += count < most;
            memmove(out + at + 1, out + at, (size_t)(count - at - 1) * sizeof *out);
            out[at] = (worst_run){c, i, value};
        }
    }
    return count;
}

/* "ID-SEED", the name of a run among the worst. */
enum { NAME_ROOM = CONDITION_ID + 24 };
static void name_of(const study_folder *f, const worst_run *run, char out[NAME_ROOM])
{
    snprintf(out, NAME_ROOM, "%s-%lld", f->id[run->condition], (long long)f->s->seeds.first + run->index);
}

static char *path_of(const study_folder *f, const char *name, const char *ending)
{
    text_buffer b = {0};
    text_format(f->ctx, &b, "%s/worst%s%s%s", f->path, *name ? "/" : "", name, ending);
    char *path = b.failed ? NULL : memory_string(f->ctx, b.data);
    text_free(f->ctx, &b);
    return path;
}

/* "DIR/worst/ID-SEED" and an ending, to be freed; NULL without memory. */
static char *study_worst_path(const study_folder *f, const worst_run *run, const char *ending)
{
    char name[NAME_ROOM];
    name_of(f, run, name);
    return path_of(f, name, ending);
}

void study_worst_folder(const study_folder *f, const worst_run *run, worst_place place, char out[WORST_FOLDER])
{
    long long seed = (long long)f->s->seeds.first + run->index;
    snprintf(out, WORST_FOLDER, place == WORST_AGAIN ? "worst/%s-%lld" : "runs/%s/%lld", f->id[run->condition], seed);
}

bool study_worst_has(const study_folder *f, const worst_run *run, worst_place place, const char *file)
{
    char folder[WORST_FOLDER];
    text_buffer path = {0};
    study_worst_folder(f, run, place, folder);
    text_format(f->ctx, &path, "%s/%s/%s", f->path, folder, file);
    bool there = !path.failed && access(path.data, F_OK) == 0;
    text_free(f->ctx, &path);
    return there;
}

/* ---- work ---- */

typedef enum worst_stage { WORST_RUN = 0, WORST_VIEW, WORST_DONE } worst_stage;
typedef struct worst_entry {
    worst_run run;
    worst_stage stage;
    bool going; /* here, or given to the cluster */
    bool old;   /* what is there was made to be another row */
} worst_entry;

typedef struct worst_work {
    const study_folder *f;
    const study_options *options;
    worst_entry *entry;
    int32_t count;
    int64_t runs; /* of the study */
    process_pool pool;
    const char *node; /* as in study_run.c */
    int32_t held;     /* runs that the cluster is to make when another program has ended */
    double started;
    bool changed;
} worst_work;

static void tell(const worst_work *w, const char *waits)
{
    study_progress p = {.wall = clock_wall() - w->started, .records = w->count, .waits = waits};
    p.done = p.planned = (int32_t)w->runs;
    for (int32_t i = 0; i < w->count; i++)
        p.records_done += w->entry[i].stage == WORST_DONE;
    if (w->options->progress)
        w->options->progress(w->options->progress_user, &p);
}

/* The figures of a run as its first time left them. */
static fram_status read_first_row(const study_folder *f, const worst_run *run, char **text, size_t *size,
                                  fram_error *error)
{
    char *path = study_run_path(f, run->condition, f->s->seeds.first + run->index, ".row");
    fram_status status = path ? file_read(f->ctx, path, ROW_FILE_LIMIT, text, size, error) : error_memory(error);
    memory_free(f->ctx, path);
    return status;
}

/* A run is there when its figures are those that stand in the table now. */
static fram_status find_stage(const study_folder *f, worst_entry *e, fram_error *error)
{
    char *first = NULL, *again = NULL, *path = study_worst_path(f, &e->run, ".row");
    char *log = study_worst_path(f, &e->run, ".log");
    size_t size = 0, other = 0;
    fram_status status = path && log ? read_first_row(f, &e->run, &first, &size, error) : error_memory(error);
    e->stage = WORST_RUN;
    e->old = status == FRAM_OK && access(path, F_OK) == 0;
    if (e->old && file_read(f->ctx, path, ROW_FILE_LIMIT, &again, &other, NULL) == FRAM_OK && size == other &&
        memcmp(first, again, size) == 0)
        e->stage = study_worst_has(f, &e->run, WORST_AGAIN, "playback.html") ? WORST_DONE : WORST_VIEW;
    /* A study that was killed behind the last page left it. */
    if (status == FRAM_OK && e->stage == WORST_DONE)
        (void)unlink(log);
    memory_free(f->ctx, first);
    memory_free(f->ctx, again);
    memory_free(f->ctx, path);
    memory_free(f->ctx, log);
    return status;
}

/* ---- what is no longer among them ---- */

/* False: a program of a study that was killed still makes it. */
static bool remove_run(const study_folder *f, const char *name)
{
    char *folder = path_of(f, name, ""), *log = path_of(f, name, ".log");
    bool busy = false;
    /* The marks go last: without them the folder would be somebody else's. */
    bool gone = folder && log && study_run_forget(f->ctx, folder, true, &busy, NULL) == FRAM_OK && !busy;
    if (gone)
        (void)unlink(log);
    memory_free(f->ctx, folder);
    memory_free(f->ctx, log);
    return gone;
}

static void prune(worst_work *w)
{
    char *path = path_of(w->f, "", "");
    DIR *dir = path ? folder_open_own(path) : NULL;
    memory_free(w->f->ctx, path);
    if (!dir)
        return;
    int failure; /* what is not listed stays */
    for (const char *file = folder_next(dir, &failure); file; file = folder_next(dir, &failure)) {
        char name[NAME_ROOM], own[NAME_ROOM];
        const char *dot = strrchr(file, '.');
        /* What a study that was killed was about to put in place. */
        if (temporary_is_name(file))
            (void)unlinkat(dirfd(dir), file, 0);
        bool kept = !dot || dot - file >= NAME_ROOM ||
                    (strcmp(dot, ".row") != 0 && strcmp(dot, ".log") != 0 && strcmp(dot, ".exit") != 0);
        if (kept)
            continue;
        snprintf(name, sizeof name, "%.*s", (int)(dot - file), file);
        for (int32_t i = 0; i < w->count && !kept; i++) {
            name_of(w->f, &w->entry[i].run, own);
            kept = strcmp(name, own) == 0;
        }
        if (kept)
            continue;
        w->changed = remove_run(w->f, name) || w->changed;
    }
    closedir(dir);
}

/* ---- a run again ---- */

double study_worst_frames(const scenario *s)
{
    return s->output.frame_interval > 0 ? s->output.frame_interval : FRAMES_USUAL;
}

fram_status study_worst_frames_of(const study_folder *f, const worst_run *run, double *out, bool *own,
                                  fram_error *error)
{
    scenario one = {0};
    fram_status status = study_scenario(f->ctx, f->s, run->condition, f->s->seeds.first, &one, error);
    if (status != FRAM_OK)
        return status;
    *out = study_worst_frames(&one);
    *own = one.output.frame_interval > 0;
    scenario_free(f->ctx, &one);
    return FRAM_OK;
}

/* The figures of the second time are those of the first, or the record shows another run. */
static fram_status judge(const worst_work *w, worst_entry *e, const char *folder, fram_error *error)
{
    context *ctx = w->f->ctx;
    run_rows rows = {0};
    text_buffer again = {0};
    char *first = NULL, *row = study_worst_path(w->f, &e->run, ".row");
    size_t size = 0;
    fram_status status = row ? run_rows_of(ctx, folder, &rows, error) : error_memory(error);
    if (status == FRAM_OK) {
        run_rows_text(ctx, &rows, &again);
        status = again.failed ? error_memory(error) : read_first_row(w->f, &e->run, &first, &size, error);
    }
    if (status == FRAM_OK && (size != (size_t)again.count || memcmp(first, again.data, size) != 0))
        status = error_set(error, FRAM_ERROR_INPUT, folder, 0, "record_of_worst",
                           "made again for its record, the run has other figures than its row runs/%s/%lld.row: the "
                           "command fram is not the one that made the row; give the study a new folder",
                           w->f->id[e->run.condition], (long long)w->f->s->seeds.first + e->run.index);
    if (status == FRAM_OK)
        status = path_claim(row, error);
    if (status == FRAM_OK)
        status = text_file_write(ctx, row, &again, error);
    if (status == FRAM_OK)
        e->stage = WORST_VIEW;
    array_free(ctx, &rows);
    text_free(ctx, &again);
    memory_free(ctx, first);
    memory_free(ctx, row);
    return status;
}

/* A run or a view that ended. */
static fram_status take(worst_work *w, worst_entry *e, int exit_code, fram_error *error)
{
    context *ctx = w->f->ctx;
    char *folder = study_worst_path(w->f, &e->run, ""), *log = study_worst_path(w->f, &e->run, ".log");
    fram_status status = folder && log ? FRAM_OK : error_memory(error);
    bool stopped = exit_code == PROCESS_INTERRUPTED && !w->options->slurm, met = false;
    e->going = false;
    if (status == FRAM_OK && exit_code != 0 && !stopped && !w->options->slurm)
        status = study_run_met_another(ctx, folder, log, &met, error);
    if (stopped || met) {
        /* It is made when the study goes on, or when the other program has ended. */
    } else if (status == FRAM_OK && exit_code != 0) {
        const ended_run ended = {folder, log, w->options->program, w->node, exit_code};
        status = study_run_check_answer(ctx, &ended, error);
        if (status == FRAM_OK && e->stage == WORST_RUN)
            status = error_set(error, FRAM_ERROR_IO, log, 0, "record_of_worst",
                               "made again for its record, a run ended with exit code %d; the tables are whole, and "
                               "the same command tries again",
                               exit_code);
        /* Without its page a record can still be played. */
        if (status == FRAM_OK) {
            char why[ROW_REASON] = "";
            if (!run_log_reason(ctx, log, why))
                snprintf(why, sizeof why, "exit code %d", exit_code);
            log_write(ctx, LOG_WARNING, "%s: the record is there, its playback was not made: %s", folder, why);
            e->stage = WORST_DONE;
        }
    } else if (status == FRAM_OK && exit_code == 0 && e->stage == WORST_RUN) {
        status = judge(w, e, folder, error);
    } else if (status == FRAM_OK && exit_code == 0) {
        e->stage = WORST_DONE;
        (void)unlink(log);
    }
    w->changed = true;
    memory_free(ctx, folder);
    memory_free(ctx, log);
    return status;
}

/* ---- on this machine ---- */

static fram_status start_on_core(worst_work *w, int32_t at, fram_error *error)
{
    worst_entry *e = &w->entry[at];
    context *ctx = w->f->ctx;
    char seed[48], frames[NUMBER_TEXT_SIZE + 32] = "output.frame_interval=";
    double interval = 0;
    bool own;
    char *scenario_file = study_scenario_path(w->f, e->run.condition);
    char *folder = study_worst_path(w->f, &e->run, ""), *log = study_worst_path(w->f, &e->run, ".log");
    fram_status status = scenario_file && folder && log ? study_worst_frames_of(w->f, &e->run, &interval, &own, error)
                                                        : error_memory(error);
    real_to_text(interval, frames + strlen(frames));
    snprintf(seed, sizeof seed, "run.seed=%lld", (long long)w->f->s->seeds.first + e->run.index);
    const char *const run[] = {
        w->options->program, "run", scenario_file, "-o",      folder, "--set", seed, "--set", frames,
        "--threads",         "1",   "--force",     "--quiet", NULL};
    const char *const view[] = {w->options->program, "view", folder, "--force", "--quiet", NULL};
    if (status == FRAM_OK)
        status = processes_start(ctx, &w->pool, e->stage == WORST_RUN ? run : view, log, at, error);
    e->going = status == FRAM_OK;
    memory_free(ctx, scenario_file);
    memory_free(ctx, folder);
    memory_free(ctx, log);
    return status;
}

/* Starts what can be; *left: what cannot yet, since a program of a study that was killed still makes it, or for want of
   cores. */
static fram_status fill_cores(worst_work *w, int jobs, bool *left, fram_error *error)
{
    fram_status status = FRAM_OK;
    *left = false;
    for (int32_t i = 0; i < w->count && status == FRAM_OK; i++) {
        worst_entry *e = &w->entry[i];
        if (e->going || e->stage == WORST_DONE)
            continue;
        char *folder = study_worst_path(w->f, &e->run, "");
        bool core = w->pool.running.count < jobs, busy = false;
        if (core)
            status = folder ? study_folder_busy(folder, &busy, error) : error_memory(error);
        memory_free(w->f->ctx, folder);
        *left = *left || !core || busy;
        if (status == FRAM_OK && core && !busy)
            status = start_on_core(w, i, error);
    }
    return status;
}

static fram_status record_here(worst_work *w, fram_error *error)
{
    int jobs = study_folder_jobs(w->f, w->options->jobs);
    bool left = false;
    fram_status status = fill_cores(w, jobs, &left, error);
    double told = clock_wall();
    while (status == FRAM_OK && (left || w->pool.running.count > 0) && !stop_is_asked(w->options->stop)) {
        int32_t at = 0;
        int exit_code = 0;
        if (processes_ended(&w->pool, &at, &exit_code)) {
            status = take(w, &w->entry[at], exit_code, error);
            tell(w, NULL);
        } else {
            processes_pause();
        }
        if (clock_wall() - told >= PROCESSES_TELL) {
            told = clock_wall();
            tell(w, NULL);
        }
        if (status == FRAM_OK && !stop_is_asked(w->options->stop))
            status = fill_cores(w, jobs, &left, error);
    }
    processes_stop(&w->pool);
    return status;
}

/* ---- on Slurm ---- */

/* From what a task finds it would go on, to figures of that other row. */
static fram_status forget_old(const study_folder *f, worst_entry *e, bool *busy, fram_error *error)
{
    char *folder = e->old ? study_worst_path(f, &e->run, "") : NULL;
    fram_status status = folder || !e->old ? FRAM_OK : error_memory(error);
    if (folder)
        status = study_run_forget(f->ctx, folder, true, busy, error);
    e->old = e->old && (status != FRAM_OK || *busy);
    memory_free(f->ctx, folder);
    return status;
}

static fram_status add_runs(void *user, slurm_pool *queue, fram_error *error)
{
    worst_work *w = user;
    fram_status status = FRAM_OK;
    w->held = 0;
    for (int32_t i = 0; i < w->count && status == FRAM_OK; i++) {
        worst_entry *e = &w->entry[i];
        bool own, busy = false;
        double frames = 0;
        if (e->stage != WORST_RUN || e->going)
            continue;
        status = forget_old(w->f, e, &busy, error);
        w->held += busy;
        if (status != FRAM_OK || busy)
            continue;
        status = study_worst_frames_of(w->f, &e->run, &frames, &own, error);
        e->going = status == FRAM_OK;
        if (e->going && !slurm_add(queue, w->f->id[e->run.condition], w->f->s->seeds.first + e->run.index, i, frames))
            status = error_memory(error);
    }
    return status;
}

static fram_status take_ended_worst(void *user, int32_t at, int exit_code, const char *node, fram_error *error)
{
    worst_work *w = user;
    w->node = node;
    fram_status status = take(w, &w->entry[at], exit_code, error);
    w->node = NULL;
    return status;
}

static void tell_waits_of_worst(void *user, const char *waits) { tell(user, waits); }

/* The runs alone: their pages are made here, a few seconds each. */
static fram_status record_by_slurm(worst_work *w, fram_error *error)
{
    const slurm_follower follower = {w, add_runs, take_ended_worst, tell_waits_of_worst, w->options->stop, &w->held};
    return slurm_follow(w->f->ctx, w->options->slurm, w->f->path, w->options->program, &follower, error);
}

/* ---- all ---- */

static fram_status find_entries(worst_work *w, const condition_rows *conditions, fram_error *error)
{
    context *ctx = w->f->ctx;
    int32_t most = w->f->s->worst.count;
    worst_run *all = memory_array(ctx, (size_t)most + 1, sizeof *all);
    w->entry = memory_array(ctx, (size_t)most + 1, sizeof *w->entry);
    fram_status status = all && w->entry ? FRAM_OK : error_memory(error);
    if (status == FRAM_OK && most > 0)
        w->count = study_worst_find(w->f, conditions, (run_figure)w->f->s->worst.figure, most, all);
    for (int32_t i = 0; i < w->count && status == FRAM_OK; i++) {
        w->entry[i] = (worst_entry){.run = all[i]};
        status = find_stage(w->f, &w->entry[i], error);
    }
    for (int32_t c = 0; c < w->f->s->conditions; c++)
        w->runs += conditions[c].rows.count;
    memory_free(ctx, all);
    return status;
}

static fram_status make_worst_folder(const worst_work *w, fram_error *error)
{
    char *path = path_of(w->f, "", "");
    fram_status status = !path ? error_memory(error) : study_folder_make(w->f->ctx, path, error);
    memory_free(w->f->ctx, path);
    return status;
}

static int32_t left_of(const worst_work *w, worst_stage up_to)
{
    int32_t n = 0;
    for (int32_t i = 0; i < w->count; i++)
        n += w->entry[i].stage <= up_to;
    return n;
}

fram_status study_worst_record(const study_folder *f, const condition_rows *conditions, const study_options *options,
                               bool *changed, fram_error *error)
{
    worst_work w = {.f = f, .options = options, .started = clock_wall()};
    fram_status status = find_entries(&w, conditions, error);
    if (status == FRAM_OK)
        prune(&w);
    if (status == FRAM_OK && left_of(&w, WORST_VIEW) > 0) {
        status = make_worst_folder(&w, error);
        bool by_slurm = options->slurm && left_of(&w, WORST_RUN) > 0; /* which tells when they are submitted */
        if (!by_slurm)
            tell(&w, NULL);
        if (status == FRAM_OK && by_slurm)
            status = record_by_slurm(&w, error);
        if (status == FRAM_OK && !stop_is_asked(options->stop))
            status = record_here(&w, error);
    }
    if (status == FRAM_OK && left_of(&w, WORST_VIEW) > 0 && stop_is_asked(options->stop))
        status = study_interrupted(error);
    *changed = w.changed;
    processes_free(f->ctx, &w.pool);
    memory_free(f->ctx, w.entry);
    return status;
}
