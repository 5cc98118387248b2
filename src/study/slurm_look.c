/* What the scheduler says of tasks: "JOB_TASK STATE REASON" on a line. */
#include "study/slurm.h"

#include "base/clock.h"
#include "study/capture.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Questions in a row whose answer must lack a task before it is lost. */
enum { MISSED_MOST = 2 };
/* Questions in a row without an answer before that is told. */
enum { SILENT_MOST = 5 };
#define POLL_USUAL 30.0

double slurm_poll(const slurm_pool *all) { return all->options->poll > 0 ? all->options->poll : POLL_USUAL; }

/* Whether the answer has the task. */
static bool has_task(const char *answer, long long job, int32_t place)
{
    char word[64];
    int length = snprintf(word, sizeof word, "%lld_%d", job, (int)place);
    for (const char *c = answer; c; c = strchr(c, '\n'), c = c ? c + 1 : NULL)
        if (strncmp(c, word, (size_t)length) == 0 && (c[length] == ' ' || c[length] == '\n' || c[length] == '\0'))
            return true;
    return false;
}

/* Whether the line is of a job of this call. */
static bool is_ours(const slurm_pool *all, const char *line)
{
    long long job = strtoll(line, NULL, 10);
    for (int32_t i = 0; i < all->jobs.count; i++)
        if ((long long)all->jobs.data[i] == job)
            return true;
    return false;
}

/* Tasks of ours that are pending, with the reasons in the order in which they come. */
static void find_waits(slurm_pool *all, const char *answer)
{
    enum { REASON_MOST = 40 };
    char reasons[64] = "", one[REASON_MOST + 1];
    int32_t waiting_tasks = 0;
    for (const char *c = answer; c && *c; c = strchr(c, '\n'), c = c ? c + 1 : NULL) {
        char state[8] = "";
        if (sscanf(c, "%*s %7s %40[^\n]", state, one) != 2 || strcmp(state, "PD") != 0 || !is_ours(all, c))
            continue;
        waiting_tasks++;
        size_t used = strlen(reasons);
        if (!strstr(reasons, one) && used + strlen(one) + 3 < sizeof reasons)
            snprintf(reasons + used, sizeof reasons - used, "%s%s", used > 0 ? ", " : "", one);
    }
    all->waits[0] = '\0';
    if (waiting_tasks > 0)
        snprintf(all->waits, sizeof all->waits, "%d %s at Slurm: %s", (int)waiting_tasks,
                 waiting_tasks == 1 ? "task waits" : "tasks wait", reasons);
}

const char *slurm_waits(const slurm_pool *all) { return *all->waits ? all->waits : NULL; }

/* Which tasks the scheduler has: by whatever name, which an option of sbatch or a variable of its environment may give;
   in all partitions, also those that are hidden from the many; and whatever a user has set to see less at a terminal.
 */
static bool ask_scheduler(slurm_pool *all, text_buffer *answer)
{
    static const char *const words[] = {"env",
                                        "-uSQUEUE_STATES",
                                        "-uSQUEUE_PARTITION",
                                        "-uSQUEUE_NAMES",
                                        "-uSQUEUE_ACCOUNT",
                                        "-uSQUEUE_QOS",
                                        "-uSQUEUE_LICENSES",
                                        "squeue",
                                        "--all",
                                        "--noheader",
                                        "--array",
                                        "--me",
                                        "--format=%i %t %r",
                                        NULL};
    int code = 0;
    bool answered = capture(all->ctx, words, answer, &code, NULL) == FRAM_OK && code == 0;
    all->silent = answered ? 0 : all->silent + 1;
    /* One that starts anew answers soon; one without the command, or too old for it, never does. */
    if (!answered)
        capture_line(answer);
    if (all->silent == SILENT_MOST)
        log_write(all->ctx, LOG_WARNING,
                  "squeue does not answer (%.200s): runs of tasks that are lost are not made again until it does",
                  answer->data ? answer->data : "it says nothing");
    return answered;
}

void slurm_look(slurm_pool *all)
{
    if (clock_wall() - all->asked < slurm_poll(all) || all->runs.count == 0)
        return;
    all->asked = clock_wall();
    text_buffer answer = {0};
    /* A scheduler that does not answer has lost nothing. */
    if (ask_scheduler(all, &answer)) {
        for (int32_t i = 0; i < all->runs.count; i++) {
            slurm_run *run = &all->runs.data[i];
            if (run->array < 0)
                continue;
            run->missed = has_task(answer.data ? answer.data : "", (long long)all->jobs.data[run->array], run->place)
                              ? 0
                              : run->missed + 1;
            if (run->missed >= MISSED_MOST) {
                run->array = -1;
                run->tries -= run->excused;
            }
        }
        find_waits(all, answer.data ? answer.data : "");
    }
    text_free(all->ctx, &answer);
}
