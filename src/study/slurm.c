#define _GNU_SOURCE
#include "study/slurm.h"

#include "base/clock.h"
#include "base/number_text.h"
#include "io/atomic_file.h"
#include "io/folder.h"
#include "io/path.h"
#include "study/capture.h"
#include "study/no_answer.h"

#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* Tasks of an array, by Slurm's own default limit (MaxArraySize 1001); of all, when nothing else is asked. */
enum { ARRAY_MOST = 1000, TASKS_USUAL = 200 };
/* Submissions of a run before it counts as failed. */
enum { TRIES_MOST = 4 };
/* How long a scheduler may refuse what it took before [s]: longer than it takes to start anew, or to be mended. */
#define REFUSED_MOST 3600.0
/* Exit code of a run that the cluster lost again and again: as if it had been killed. */
enum { LOST = 137, SIGNAL_CODES = 128 };
/* Of one whose folder another program holds: a run that is made twice, or a scenario that is none. */
enum { MET_ANOTHER = 2 };

/* ---- names ---- */

/* "FOLDER/slurm/N.ENDING", to be freed. */
static char *array_path(const slurm_pool *all, int32_t array, const char *ending)
{
    text_buffer b = {0};
    text_format(all->ctx, &b, "%s/slurm/%d.%s", all->folder, (int)array, ending);
    char *path = b.failed ? NULL : memory_string(all->ctx, b.data);
    text_free(all->ctx, &b);
    return path;
}

/* "FOLDER/runs/ID/SEED.ENDING", to be freed; in the folder of the worst of one that is made again with a record. */
static char *run_path(const slurm_pool *all, const slurm_run *run, const char *ending)
{
    text_buffer b = {0};
    text_format(all->ctx, &b, run->frames > 0 ? "%s/worst/%s-%lld.%s" : "%s/runs/%s/%lld.%s", all->folder, run->id,
                (long long)run->seed, ending);
    char *path = b.failed ? NULL : memory_string(all->ctx, b.data);
    text_free(all->ctx, &b);
    return path;
}

static fram_status put(const slurm_pool *all, int32_t array, const char *ending, const text_buffer *text,
                       fram_error *error)
{
    char *path = text->failed ? NULL : array_path(all, array, ending);
    fram_status status = path ? path_claim(path, error) : error_memory(error);
    if (status == FRAM_OK)
        status = atomic_file_write(all->ctx, path, text->data, (size_t)text->count, error);
    memory_free(all->ctx, path);
    return status;
}

/* ---- beginning and end ---- */

/* Words of a scheduler by which there is nothing left to cancel: some call that a mistake. */
static bool is_gone(const char *answer)
{
    return answer && (strstr(answer, "Invalid job id") || strstr(answer, "already complet"));
}

/* Whether the scheduler has taken it: one that does not answer, as while it starts anew, goes on with the array. */
static bool cancel(slurm_pool *all, long long job)
{
    char number[32];
    snprintf(number, sizeof number, "%lld", job);
    /* Nobody is there to say yes. */
    const char *const words[] = {"env", "-uSCANCEL_INTERACTIVE", "scancel", number, NULL};
    text_buffer answer = {0};
    int code = 0;
    bool taken = capture(all->ctx, words, &answer, &code, NULL) == FRAM_OK && (code == 0 || is_gone(answer.data));
    capture_line(&answer);
    if (!taken)
        log_write(all->ctx, LOG_WARNING,
                  "array %lld goes on at Slurm, which does not cancel it (%.200s): the same command tries again", job,
                  answer.data ? answer.data : "scancel says nothing");
    text_free(all->ctx, &answer);
    return taken;
}

/* Arrays of an earlier call: their numbers go on, and what is still queued is cancelled. */
static void cancel_earlier(slurm_pool *all)
{
    text_buffer path = {0};
    text_format(all->ctx, &path, "%s/slurm", all->folder);
    DIR *dir = path.failed ? NULL : opendir(path.data);
    for (struct dirent *e = dir ? readdir(dir) : NULL; e; e = readdir(dir)) {
        char *end = NULL;
        long n = strtol(e->d_name, &end, 10);
        if (n < 1 || n > INT32_MAX / 2 || end == e->d_name)
            continue;
        all->arrays = n > all->arrays ? (int32_t)n : all->arrays;
        if (strcmp(end, ".job") != 0)
            continue;
        char *job = array_path(all, (int32_t)n, "job"), *text = NULL;
        size_t size = 0;
        if (job && file_read(all->ctx, job, 64, &text, &size, NULL) == FRAM_OK) {
            if (cancel(all, strtoll(text, NULL, 10)))
                (void)unlink(job);
        }
        memory_free(all->ctx, text);
        memory_free(all->ctx, job);
    }
    if (dir)
        closedir(dir);
    text_free(all->ctx, &path);
}

static fram_status check_commands(slurm_pool *all, fram_error *error)
{
    const char *const words[] = {"sbatch", "--version", NULL};
    text_buffer answer = {0};
    int code = 0;
    fram_status status = capture(all->ctx, words, &answer, &code, error);
    capture_line(&answer);
    if (status != FRAM_OK)
        status = error_set(error, FRAM_ERROR_USAGE, NULL, 0, "on",
                           "the command sbatch is not there: run this on a machine that submits to Slurm");
    else if (code != 0)
        status = error_set(error, FRAM_ERROR_USAGE, NULL, 0, "on", "the command sbatch does not work: %.300s",
                           answer.data ? answer.data : "it says nothing");
    text_free(all->ctx, &answer);
    return status;
}

fram_status slurm_begin(context *ctx, const slurm_options *options, const char *folder, const char *program,
                        slurm_pool *all, fram_error *error)
{
    *all = (slurm_pool){.ctx = ctx, .options = options, .program = program, .asked = clock_wall()};
    char *whole = realpath(folder, NULL);
    all->folder = whole ? memory_string(ctx, whole) : NULL;
    free(whole);
    if (!all->folder)
        return error_memory(error);
    if (options->dry_run)
        return FRAM_OK;
    fram_status status = check_commands(all, error);
    text_buffer path = {0};
    text_format(ctx, &path, "%s/slurm", all->folder);
    if (status == FRAM_OK && path.failed)
        status = error_memory(error);
    if (status == FRAM_OK)
        status = folder_make_own(path.data, error);
    text_free(ctx, &path);
    if (status == FRAM_OK)
        cancel_earlier(all);
    all->earlier = all->arrays;
    if (status != FRAM_OK)
        slurm_free(all);
    return status;
}

void slurm_end(slurm_pool *all, bool whole)
{
    /* Of what was submitted twice one may go on when the other has ended; of all else nothing does, and what is
       cancelled as it ends would be told so in the cluster's accounts. */
    if (whole && !all->again)
        return;
    for (int32_t i = 0; i < all->jobs.count && !all->unstopped; i++)
        all->unstopped = !cancel(all, (long long)all->jobs.data[i]);
}

/* The numbers of this call's arrays: told on, a later call would cancel what a cluster that was set up anew has given
   the same number.  Those of a call that was killed, and those that go on, stay for the next one to cancel.  A call
   that only shows what it would submit has none, and has not looked for theirs. */
static void forget_jobs(const slurm_pool *all)
{
    if (all->options->dry_run)
        return;
    for (int32_t i = all->earlier + 1; !all->unstopped && i <= all->arrays; i++) {
        char *job = array_path(all, i, "job");
        if (job)
            (void)unlink(job);
        memory_free(all->ctx, job);
    }
}

void slurm_free(slurm_pool *all)
{
    forget_jobs(all);
    memory_free(all->ctx, all->folder);
    all->folder = NULL;
    array_free(all->ctx, &all->runs);
    array_free(all->ctx, &all->jobs);
    text_free(all->ctx, &all->without);
}

/* "CODE NODE", as the script writes it. */
static bool read_exit(slurm_pool *all, const slurm_run *run, int *code)
{
    enum { EXIT_MOST = 2 * SLURM_NODE };
    char *path = run_path(all, run, "exit"), *text = NULL;
    size_t size = 0;
    bool found = path && access(path, F_OK) == 0 &&
                 file_read(all->ctx, path, EXIT_MOST, &text, &size, NULL) == FRAM_OK && size > 1;
    all->node[0] = '\0';
    if (found) {
        char *rest = NULL;
        *code = (int)strtol(text, &rest, 10);
        rest += strspn(rest, " ");
        snprintf(all->node, sizeof all->node, "%.*s", (int)strcspn(rest, " \n"), rest);
    }
    memory_free(all->ctx, text);
    memory_free(all->ctx, path);
    return found;
}

static void remove_exit(const slurm_pool *all, const slurm_run *run)
{
    char *path = run_path(all, run, "exit");
    if (path)
        (void)unlink(path);
    memory_free(all->ctx, path);
}

bool slurm_add(slurm_pool *all, const char *id, int64_t seed, int32_t task, double frames)
{
    slurm_run run = {.task = task, .seed = seed, .frames = frames, .array = -1};
    int code = 0;
    snprintf(run.id, sizeof run.id, "%s", id);
    /* What failed when nobody was there to hear why is tried again: what stopped the call before, a full disk perhaps,
       stopped other tasks too. */
    if (!all->options->dry_run && read_exit(all, &run, &code) && code != 0)
        remove_exit(all, &run);
    return array_push(all->ctx, &all->runs, run);
}

/* ---- submitting ---- */

/* sbatch says the number of the job, ";CLUSTER" after it perhaps, on a line of its own among those that the cluster has
   for who submits (an account that is taken, an option that is not), before it or behind.  0: it says none. */
static long long job_in(const char *answer)
{
    long long job = 0;
    for (const char *c = answer; c && job < 1; c = strchr(c, '\n'), c = c ? c + 1 : NULL) {
        char *end = NULL;
        long long number = strtoll(c, &end, 10);
        if (end != c && (*end == ';' || *end == '\n' || *end == '\0'))
            job = number;
    }
    return job;
}

/* What may have been taken is not offered again, as what was refused is: its runs would be made twice. */
static fram_status refuse_answer(const char *script, int code, const char *answer, fram_error *error)
{
    if (code != 0)
        return error_set(error, FRAM_ERROR_USAGE, script, 0, "on", "sbatch refuses the script: %.300s", answer);
    return error_set(error, FRAM_ERROR_IO, script, 0, "on",
                     "sbatch told no number; look with squeue whether it has taken the script: %.300s", answer);
}

static fram_status submit_script(slurm_pool *all, const slurm_script_facts *f, fram_error *error)
{
    char *script = array_path(all, f->number, "sh"), array[SLURM_ARRAY_SIZE];
    slurm_script_array(f, array);
    const char **words = script ? slurm_submission(all->ctx, f, array, script) : NULL;
    text_buffer answer = {0};
    int code = 0;
    fram_status status = words ? capture(all->ctx, words, &answer, &code, error) : error_memory(error);
    memory_free(all->ctx, words);
    long long job = status == FRAM_OK ? job_in(answer.data) : 0;
    if (status == FRAM_OK && (code != 0 || job < 1)) {
        capture_line(&answer);
        status = refuse_answer(script, code, answer.data ? answer.data : "it says nothing", error);
    }
    if (status == FRAM_OK && !array_push(all->ctx, &all->jobs, job))
        status = error_memory(error);
    text_buffer number = {0};
    text_format(all->ctx, &number, "%lld\n", job);
    if (status == FRAM_OK)
        status = put(all, f->number, "job", &number, error);
    text_free(all->ctx, &number);
    text_free(all->ctx, &answer);
    memory_free(all->ctx, script);
    return status;
}

/* Whether the run is to be submitted: one that was too often is lost. */
static bool is_waiting(const slurm_run *run) { return run->array < 0 && run->tries < TRIES_MOST; }

static int32_t waiting(const slurm_pool *all)
{
    int32_t n = 0;
    for (int32_t i = 0; i < all->runs.count; i++)
        n += is_waiting(&all->runs.data[i]);
    return n;
}

/* The next runs that wait, as one array of at most ARRAY_MOST tasks. */
static fram_status submit_array(slurm_pool *all, int32_t each, fram_error *error)
{
    text_buffer list = {0}, script = {0}, exclude = {0};
    int32_t n = 0;
    all->arrays++;
    for (int32_t i = 0; i < all->runs.count && n < (int64_t)ARRAY_MOST * each; i++) {
        slurm_run *run = &all->runs.data[i];
        if (!is_waiting(run))
            continue;
        text_format(all->ctx, &list, "%s %lld", run->id, (long long)run->seed);
        if (run->frames > 0) {
            char frames[NUMBER_TEXT_SIZE];
            real_to_text(run->frames, frames);
            text_format(all->ctx, &list, " %s", frames);
        }
        text_add(all->ctx, &list, "\n");
        all->again = all->again || run->tries > 0;
        run->array = all->jobs.count;
        run->place = n++ / each;
        run->tries++;
        run->missed = 0;
        run->excused = false;
    }
    if (all->without.count > 0)
        slurm_script_exclusion(all->ctx, all->options, all->without.data, &exclude);
    const slurm_script_facts facts = {all->options, all->folder, all->program, exclude.data, all->arrays, n, each};
    slurm_script(all->ctx, &facts, &script);
    fram_status status = script.failed || list.failed || exclude.failed ? error_memory(error) : FRAM_OK;
    if (status == FRAM_OK && all->options->dry_run) {
        fputs(script.data, stdout);
    } else if (status == FRAM_OK) {
        status = put(all, all->arrays, "list", &list, error);
        if (status == FRAM_OK)
            status = put(all, all->arrays, "sh", &script, error);
        if (status == FRAM_OK)
            status = submit_script(all, &facts, error);
    }
    text_free(all->ctx, &list);
    text_free(all->ctx, &script);
    text_free(all->ctx, &exclude);
    return status;
}

/* The runs of the newest array, which was refused, wait as before, and no try of theirs is lost. */
static void take_back(slurm_pool *all)
{
    for (int32_t i = 0; i < all->runs.count; i++) {
        slurm_run *run = &all->runs.data[i];
        if (run->array != all->jobs.count)
            continue;
        run->array = -1;
        run->tries--;
    }
}

/* Whether the refusal of an array, the newest, is waited for: one of a scheduler that has taken others of this call may
   be that of one which starts anew, or has its fill. */
static bool may_wait(slurm_pool *all, const fram_error *error)
{
    double now = clock_wall();
    if (all->jobs.count == 0 || (all->refused > 0 && now - all->refused > REFUSED_MOST))
        return false;
    take_back(all);
    if (all->refused <= 0) {
        all->refused = now;
        log_write(all->ctx, LOG_WARNING, "%s; it is tried again for an hour", error->message);
    }
    all->offered = now;
    return true;
}

fram_status slurm_submit(slurm_pool *all, fram_error *error)
{
    int32_t n = waiting(all), each = all->options->runs_per_task;
    fram_error own = {0};
    if (all->refused > 0 && clock_wall() - all->offered < slurm_poll(all))
        return FRAM_OK;
    if (each < 1)
        each = (n + TASKS_USUAL - 1) / TASKS_USUAL;
    while (waiting(all) > 0) {
        fram_status status = submit_array(all, each, &own);
        /* Perhaps for want of other nodes than those that are left out. */
        if (status == FRAM_ERROR_USAGE && all->without.count > 0) {
            take_back(all);
            text_free(all->ctx, &all->without);
            continue;
        }
        if (status == FRAM_ERROR_USAGE && may_wait(all, &own))
            return FRAM_OK;
        if (status != FRAM_OK && error)
            *error = own;
        if (status != FRAM_OK)
            return status;
        all->refused = 0;
    }
    return FRAM_OK;
}

/* ---- what became of them ---- */

/* A run of the task has ended: those behind it lose no try when the task is lost, whose time was not theirs. */
static void excuse_others(slurm_pool *all, const slurm_run *ended)
{
    for (int32_t i = 0; i < all->runs.count; i++) {
        slurm_run *run = &all->runs.data[i];
        run->excused = run->excused || (run->array >= 0 && run->array == ended->array && run->place == ended->place);
    }
}

/* Whether a run of this exit code has not had its answer. */
static bool is_lost(int exit_code) { return exit_code > SIGNAL_CODES || process_not_started(exit_code); }

/* Whether the node is among those that are left out. */
static bool is_left_out(const slurm_pool *all, const char *node)
{
    size_t length = strlen(node);
    for (const char *c = all->without.count > 0 ? all->without.data : NULL; c; c = strchr(c, ','), c = c ? c + 1 : NULL)
        if (strncmp(c, node, length) == 0 && (c[length] == ',' || c[length] == '\0'))
            return true;
    return false;
}

/* A node that cannot start the program ends its tasks at once, and so gets more of them than the others do. */
static void leave_out_node(slurm_pool *all, const slurm_run *run)
{
    if (!*all->node || is_left_out(all, all->node))
        return;
    char *log = run_path(all, run, "log"), why[NO_START_REASON];
    if (log) {
        study_run_why_not_started(all->ctx, log, why);
        log_write(all->ctx, LOG_WARNING, "the node %s cannot start %.200s: %s; its runs are submitted for other nodes",
                  all->node, all->program, why);
    }
    text_format(all->ctx, &all->without, "%s%s", all->without.count > 0 ? "," : "", all->node);
    memory_free(all->ctx, log);
}

bool slurm_ended(slurm_pool *all, int32_t *task, int *exit_code)
{
    for (; all->looked < all->runs.count; all->looked++) {
        slurm_run *run = &all->runs.data[all->looked];
        bool ended = read_exit(all, run, exit_code);
        if (ended)
            remove_exit(all, run);
        all->again = all->again || (ended && *exit_code == MET_ANOTHER);
        if (ended && process_not_started(*exit_code))
            leave_out_node(all, run);
        /* A signal is no answer of the run: the node was short of memory, or the task of time. */
        if (ended && is_lost(*exit_code) && run->tries < TRIES_MOST) {
            run->array = -1;
            continue;
        }
        if (!ended && run->array < 0 && run->tries >= TRIES_MOST) {
            ended = true;
            *exit_code = LOST;
        }
        if (!ended)
            continue;
        excuse_others(all, run);
        *task = run->task;
        *run = all->runs.data[--all->runs.count];
        return true;
    }
    all->looked = 0;
    return false;
}
