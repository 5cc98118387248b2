/* environ is not in every standard's unistd.h. */
#define _GNU_SOURCE
#include "study/capture.h"

#include "io/file.h"

#include <errno.h>
#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

static int start(const char *const *words, const int pipe_ends[2], pid_t *id)
{
    posix_spawn_file_actions_t files;
    int bad = posix_spawn_file_actions_init(&files);
    if (bad != 0)
        return bad;
    bad = posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    if (bad == 0)
        bad = posix_spawn_file_actions_adddup2(&files, pipe_ends[1], STDOUT_FILENO);
    if (bad == 0)
        bad = posix_spawn_file_actions_adddup2(&files, pipe_ends[1], STDERR_FILENO);
    /* posix_spawnp does not change the words. */
    if (bad == 0)
        bad = posix_spawnp(id, words[0], &files, NULL, (char *const *)(uintptr_t)words, environ);
    posix_spawn_file_actions_destroy(&files);
    return bad;
}

static void read_output(context *ctx, int from, text_buffer *out)
{
    char part[4096];
    for (;;) {
        ssize_t n = read(from, part, sizeof part);
        if (n > 0)
            text_add_bytes(ctx, out, part, (size_t)n);
        else if (n == 0 || errno != EINTR)
            return;
    }
}

fram_status capture(context *ctx, const char *const *words, text_buffer *out, int *exit_code, fram_error *error)
{
    int ends[2], state = 0;
    pid_t id = 0;
    if (pipe2(ends, O_CLOEXEC) != 0)
        return file_error(error, words[0], "make a pipe to", errno);
    int bad = start(words, ends, &id);
    close(ends[1]);
    if (bad == 0) {
        read_output(ctx, ends[0], out);
        while (waitpid(id, &state, 0) < 0 && errno == EINTR)
            ;
    }
    close(ends[0]);
    if (bad != 0)
        return file_error(error, words[0], "start the program", bad);
    if (exit_code)
        *exit_code = WIFEXITED(state) ? WEXITSTATUS(state) : 128 + WTERMSIG(state);
    return out->failed ? error_memory(error) : FRAM_OK;
}

void capture_line(text_buffer *b)
{
    while (b->data && b->count > 0 && b->data[b->count - 1] == '\n')
        b->data[--b->count] = '\0';
    for (int32_t i = 0; b->data && i < b->count; i++)
        if ((unsigned char)b->data[i] < ' ')
            b->data[i] = ' ';
}
