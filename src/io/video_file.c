#include "io/video_file.h"

#include "io/atomic_file.h"
#include "io/temporary.h"

#include <errno.h>
#include <signal.h>
#include <spawn.h>
#include <stdio.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

extern char **environ;

/* Colours of HD television, and the file says so: without that some players take those of SD, and all hues are off. */
#define VIDEO_COLOURS                                                                                        \
    "-vf", "scale=out_color_matrix=bt709:out_range=tv", "-colorspace", "bt709", "-color_primaries", "bt709", \
        "-color_trc", "bt709", "-color_range", "tv"

static void forget_video(video_file *v)
{
    if (v->socket >= 0)
        close(v->socket);
    memory_free(v->ctx, v->path);
    memory_free(v->ctx, v->temporary);
    *v = (video_file){.socket = -1};
}

/* An errno value, 0 when it runs: it reads from ends[1].  A process group of its own, so that Ctrl-C in a terminal
   reaches the caller alone, who ends it. */
static int spawn(const int ends[2], char *const *arguments, pid_t *process)
{
    posix_spawn_file_actions_t actions;
    posix_spawnattr_t attributes;
    int code = posix_spawnattr_init(&attributes);
    if (code != 0)
        return code;
    code = posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
    if (code == 0)
        code = posix_spawn_file_actions_init(&actions);
    if (code == 0) {
        code = posix_spawn_file_actions_adddup2(&actions, ends[1], STDIN_FILENO);
        if (code == 0)
            code = posix_spawnp(process, arguments[0], &actions, &attributes, arguments, environ);
        posix_spawn_file_actions_destroy(&actions);
    }
    posix_spawnattr_destroy(&attributes);
    return code;
}

/* A socket, not a pipe: writing to an ffmpeg that went away is an error (MSG_NOSIGNAL), not a signal to the caller.  No
   other program gets it, be it the ffmpeg of a second video: this one would wait for its end too. */
static fram_status start(video_file *v, char *const *arguments, fram_error *error)
{
    int ends[2];
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0)
        return file_error(error, v->path, "make a pipe", errno);
    pid_t process = 0;
    int code = spawn(ends, arguments, &process);
    close(ends[1]);
    v->socket = ends[0];
    v->process = (int)process;
    if (code == 0)
        return FRAM_OK;
    return error_set(error, FRAM_ERROR_UNSUPPORTED, v->path, 0, NULL,
                     "a video needs ffmpeg, which cannot be started (%s); install it (Debian: apt install ffmpeg)",
                     strerror(code));
}

fram_status video_begin(context *ctx, const char *path, int width, int height, int frames_per_second, video_file *v,
                        fram_error *error)
{
    static const char protocol[] = "file:";
    int descriptor = -1;
    *v = (video_file){.ctx = ctx, .socket = -1, .path = memory_string(ctx, path)};
    fram_status status = v->path ? atomic_file_check(path, error) : error_memory(error);
    if (status == FRAM_OK)
        status = temporary_file(ctx, path, &v->temporary, &descriptor, error);
    if (status != FRAM_OK) {
        forget_video(v);
        return status;
    }
    close(descriptor); /* ffmpeg takes a name, and as a file only with its protocol */
    size_t room = sizeof protocol + strlen(v->temporary);
    char *output = memory_array(ctx, room, 1);
    if (!output) {
        unlink(v->temporary);
        forget_video(v);
        return error_memory(error);
    }
    snprintf(output, room, "%s%s", protocol, v->temporary);
    char size[32], rate[16];
    snprintf(size, sizeof size, "%dx%d", width, height);
    snprintf(rate, sizeof rate, "%d", frames_per_second);
    /* What spawn takes is not const, and it changes nothing.  Without -xerror a full disk is no failure to ffmpeg. */
    char *const arguments[] = {
        "ffmpeg",  "-xerror", "-y", "-loglevel", "error",      "-f",  "rawvideo",    "-pix_fmt", "bgr0",    "-s",
        size,      "-r",      rate, "-i",        "pipe:0",     "-an", VIDEO_COLOURS, "-c:v",     "libx264", "-pix_fmt",
        "yuv420p", "-crf",    "21", "-movflags", "+faststart", "-f",  "mp4",         output,     NULL};
    status = start(v, arguments, error);
    memory_free(ctx, output);
    if (status != FRAM_OK) {
        unlink(v->temporary);
        forget_video(v);
    }
    return status;
}

fram_status video_frame(video_file *v, const void *pixels, size_t size, fram_error *error)
{
    const char *at = pixels;
    while (size > 0) {
        ssize_t sent = send(v->socket, at, size, MSG_NOSIGNAL);
        if (sent < 0 && errno == EINTR)
            continue;
        if (sent <= 0)
            return error_set(error, FRAM_ERROR_IO, v->path, 0, NULL, "ffmpeg stopped taking frames; see what it said");
        at += sent;
        size -= (size_t)sent;
    }
    return FRAM_OK;
}

/* True when it ended well. */
static bool wait_for(const video_file *v)
{
    int how = 0;
    while (waitpid((pid_t)v->process, &how, 0) < 0) {
        if (errno != EINTR)
            return false;
    }
    return WIFEXITED(how) && WEXITSTATUS(how) == 0;
}

fram_status video_end(video_file *v, fram_error *error)
{
    close(v->socket);
    v->socket = -1;
    fram_status status = FRAM_OK;
    if (wait_for(v)) {
        status = atomic_file_adopt(v->ctx, v->temporary, v->path, error);
    } else {
        unlink(v->temporary);
        status = error_set(error, FRAM_ERROR_IO, v->path, 0, NULL, "ffmpeg could not make the video; see what it said");
    }
    forget_video(v);
    return status;
}

void video_abandon(video_file *v)
{
    if (!v->path)
        return;
    kill((pid_t)v->process, SIGTERM);
    close(v->socket); /* first: where ffmpeg waits for a frame it does not heed the signal */
    v->socket = -1;
    (void)wait_for(v);
    unlink(v->temporary);
    forget_video(v);
}
