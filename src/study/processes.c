/* sched_getaffinity is Linux's own. */
#define _GNU_SOURCE
#include "study/processes.h"

#include "io/file.h"
#include "io/path.h"

#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <sched.h>
#include <signal.h>
#include <spawn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

int processes_cores(void)
{
    cpu_set_t set;
    if (sched_getaffinity(0, sizeof set, &set) == 0)
        return CPU_COUNT(&set);
    long online = sysconf(_SC_NPROCESSORS_ONLN);
    return online > 0 ? (int)online : 1;
}

double processes_memory(void)
{
    char line[128];
    double kilobytes = 0;
    FILE *file = fopen("/proc/meminfo", "re");
    while (file && kilobytes == 0 && fgets(line, sizeof line, file))
        if (strncmp(line, "MemAvailable:", 13) == 0)
            kilobytes = strtod(line + 13, NULL);
    if (file)
        fclose(file);
    return kilobytes * 1024;
}

int processes_that_fit(int cores, double memory, double bytes)
{
    double fit = memory > 0 && bytes > 0 ? floor(memory / bytes) : cores;
    return fit < 1 ? 1 : fit < cores ? (int)fit : cores;
}

/* Whether the system keeps how a program ended until it is asked: not where SIGCHLD is ignored, which a program has
   from whoever started it. */
static bool ends_are_told(void)
{
    struct sigaction child;
    return sigaction(SIGCHLD, NULL, &child) != 0 ||
           (child.sa_handler != SIG_IGN && (child.sa_flags & SA_NOCLDWAIT) == 0);
}

/* The program, with its log on standard error: 0, or the system's number. */
static int start_program(const char *const *words, int log, pid_t *id)
{
    posix_spawn_file_actions_t files;
    int bad = posix_spawn_file_actions_init(&files);
    if (bad != 0)
        return bad;
    /* The log first: it has the number of one of the others where whoever started this program had closed that. */
    bad = posix_spawn_file_actions_adddup2(&files, log, STDERR_FILENO);
    if (bad == 0)
        bad = posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    if (bad == 0)
        bad = posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    /* posix_spawn does not change the words. */
    if (bad == 0)
        bad = posix_spawn(id, words[0], &files, NULL, (char *const *)(uintptr_t)words, environ);
    posix_spawn_file_actions_destroy(&files);
    return bad;
}

fram_status processes_start(context *ctx, process_pool *all, const char *const *words, const char *log, int32_t task,
                            fram_error *error)
{
    process p = {.task = task};
    if (!ends_are_told())
        return error_set(error, FRAM_ERROR_USAGE, NULL, 0, "SIGCHLD",
                         "is ignored by this program, so that nobody can tell how its runs end: set it to SIG_DFL, "
                         "without SA_NOCLDWAIT, before a study runs");
    if (!array_reserve(ctx, &all->running, all->running.count + 1))
        return error_memory(error);
    /* Here and not by the system as it starts the program, whose fault it would then be. */
    fram_status status = path_claim(log, error);
    if (status != FRAM_OK)
        return status;
    int file = open(log, O_WRONLY | O_CREAT | O_TRUNC | O_NOFOLLOW | O_CLOEXEC, 0666);
    if (file < 0)
        return file_error(error, log, "open for writing", errno);
    int bad = start_program(words, file, &p.id);
    close(file);
    if (bad != 0)
        return file_error(error, words[0], "start the program", bad);
    all->running.data[all->running.count++] = p;
    return FRAM_OK;
}

bool processes_ended(process_pool *all, int32_t *task, int *exit_code)
{
    for (int32_t i = 0; i < all->running.count; i++) {
        int state = 0;
        pid_t id = waitpid(all->running.data[i].id, &state, WNOHANG);
        if (id == 0 || (id < 0 && errno == EINTR))
            continue;
        *task = all->running.data[i].task;
        *exit_code = id < 0 ? 1 : WIFEXITED(state) ? WEXITSTATUS(state) : 128 + WTERMSIG(state);
        all->running.data[i] = all->running.data[--all->running.count];
        return true;
    }
    return false;
}

bool process_not_started(int exit_code) { return exit_code == 126 || exit_code == 127; }

void processes_pause(void)
{
    const struct timespec pause = {0, 5000000};
    nanosleep(&pause, NULL);
}

void processes_stop(process_pool *all)
{
    for (int32_t i = 0; i < all->running.count; i++)
        kill(all->running.data[i].id, SIGTERM);
    for (int32_t i = 0; i < all->running.count; i++)
        while (waitpid(all->running.data[i].id, NULL, 0) < 0 && errno == EINTR)
            ;
    array_clear(&all->running);
}

void processes_free(context *ctx, process_pool *all) { array_free(ctx, &all->running); }
