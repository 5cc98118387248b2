#include "io/video_file.h"

#include "io/atomic_file.h"
#include "io/temporary.h"

#include <errno.h>
#include <fcntl.h>
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
    if (v->words >= 0)
        close(v->words);
    memory_free(v->ctx, v->path);
    memory_free(v->ctx, v->temporary);
    *v = (video_file){.socket = -1, .words = -1};
}

/* An errno value, 0 when it runs: it reads from `frames` and says what it has to say to `words`.  A process group of
   its own, so that Ctrl-C in a terminal reaches the caller alone, who ends it. */
static int spawn(int frames, int words, char *const *arguments, pid_t *process)
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
        code = posix_spawn_file_actions_adddup2(&actions, frames, STDIN_FILENO);
        if (code == 0)
            code = posix_spawn_file_actions_adddup2(&actions, words, STDERR_FILENO);
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
    int ends[2], words[2];
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0)
        return file_error(error, v->path, "make a pipe", errno);
    v->socket = ends[0];
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, words) != 0) {
        close(ends[1]);
        return file_error(error, v->path, "make a pipe", errno);
    }
    v->words = words[0];
    /* Nobody reads its words before its end: what has no room is lost, and it does not wait. */
    (void)fcntl(words[1], F_SETFL, O_NONBLOCK);
    pid_t process = 0;
    int code = spawn(ends[1], words[1], arguments, &process);
    close(ends[1]);
    close(words[1]);
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
    *v = (video_file){.ctx = ctx, .socket = -1, .words = -1, .path = memory_string(ctx, path)};
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

/* True when it ended well. */
static bool wait_for(video_file *v)
{
    pid_t process = (pid_t)v->process;
    int how = 0;
    if (process <= 0)
        return false;
    v->process = 0;
    while (waitpid(process, &how, 0) < 0) {
        if (errno != EINTR)
            return false;
    }
    return WIFEXITED(how) && WEXITSTATUS(how) == 0;
}

/* What it said, when it has ended, in one line; it knows the file by the name that it has until it is whole. */
static void take_words(const video_file *v, char *out, size_t room)
{
    static const char protocol[] = "file:";
    char said[2048];
    ssize_t length = recv(v->words, said, sizeof said - 1, MSG_DONTWAIT);
    size_t own = strlen(v->temporary), used = 0;
    said[length > 0 ? length : 0] = '\0';
    for (const char *at = said; *at && used + 1 < room;) {
        const char *name = strncmp(at, protocol, sizeof protocol - 1) == 0 ? at + sizeof protocol - 1 : at;
        if (strncmp(name, v->temporary, own) == 0) {
            int put = snprintf(out + used, room - used, "%s", v->path);
            used = put > 0 && (size_t)put < room - used ? used + (size_t)put : room - 1;
            at = name + own;
        } else if (*at == '\n') {
            for (; *at == '\n'; at++)
                ;
            if (*at)
                out[used++] = ';';
            if (*at && used + 1 < room)
                out[used++] = ' ';
        } else {
            out[used++] = *at++;
        }
    }
    out[used] = '\0';
}

/* When it has ended. */
static fram_status refuse_ended(const video_file *v, const char *what, fram_error *error)
{
    char words[400];
    take_words(v, words, sizeof words);
    return error_set(error, FRAM_ERROR_IO, v->path, 0, NULL, "%s%s%s", what, words[0] ? ": " : "", words);
}

/* It takes no more: it has ended, or is ended. */
static fram_status refuse_video(video_file *v, const char *what, fram_error *error)
{
    kill((pid_t)v->process, SIGTERM);
    (void)wait_for(v);
    return refuse_ended(v, what, error);
}

fram_status video_frame(video_file *v, const void *pixels, size_t size, fram_error *error)
{
    const char *at = pixels;
    while (size > 0) {
        ssize_t sent = send(v->socket, at, size, MSG_NOSIGNAL);
        if (sent < 0 && errno == EINTR)
            continue;
        if (sent <= 0)
            return refuse_video(v, "ffmpeg stopped taking frames", error);
        at += sent;
        size -= (size_t)sent;
    }
    return FRAM_OK;
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
        status = refuse_ended(v, "ffmpeg could not make the video", error);
    }
    forget_video(v);
    return status;
}

void video_abandon(video_file *v)
{
    if (!v->path)
        return;
    if (v->process > 0)
        kill((pid_t)v->process, SIGTERM);
    close(v->socket); /* first: where ffmpeg waits for a frame it does not heed the signal */
    v->socket = -1;
    (void)wait_for(v);
    unlink(v->temporary);
    forget_video(v);
}
