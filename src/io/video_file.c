#include "io/video_file.h"

#include "io/atomic_file.h"
#include "io/temporary.h"
#include "io/text_buffer.h"

#include <errno.h>
#include <poll.h>
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

/* So often it is looked at whether it goes on [ms]. */
#define LOOK_EVERY 20

/* Whether it has; who else holds its standard error, as what a script in its place left behind, may go on. */
static bool has_ended(const video_file *v)
{
    siginfo_t about = {0};
    return v->process <= 0 || waitid(P_PID, (id_t)v->process, &about, WEXITED | WNOHANG | WNOWAIT) != 0 ||
           about.si_pid != 0;
}

static void keep_words(video_file *v, const char *said, int count)
{
    int kept = v->said_count, room = VIDEO_SAID - count;
    if (kept > room) {
        memmove(v->said, v->said + (kept - room), (size_t)room);
        v->said_more = true;
        kept = room;
    }
    memcpy(v->said + kept, said, (size_t)count);
    v->said_count = kept + count;
}

/* Joins what it has said since to the last of its words: more than a socket holds, but of one that says more and more
   not all. */
static void hear(video_file *v)
{
    enum { TURNS = 1000 };
    char said[VIDEO_SAID];
    for (int i = 0; i < TURNS && v->words >= 0; i++) {
        ssize_t got = recv(v->words, said, sizeof said, MSG_DONTWAIT);
        if (got < 0 && errno == EAGAIN)
            return;
        if (got > 0)
            keep_words(v, said, (int)got);
        if (got == 0 || (got < 0 && errno != EINTR)) {
            close(v->words);
            v->words = -1;
        }
    }
}

/* A line of its words.  It knows the file by the name that it has until it is whole. */
static void put_line(const video_file *v, const char *line, const char *end, text_buffer *out)
{
    static const char protocol[] = "file:";
    size_t own = strlen(v->temporary), skip = sizeof protocol - 1;
    while (line < end) {
        size_t left = (size_t)(end - line);
        size_t before = left >= skip && memcmp(line, protocol, skip) == 0 ? skip : 0;
        if (left - before >= own && memcmp(line + before, v->temporary, own) == 0) {
            text_add(v->ctx, out, v->path);
            line += before + own;
        } else {
            text_add_bytes(v->ctx, out, line++, 1);
        }
    }
}

/* Its last words, in one line: where they have no room, without the first lines.  The reason stands at the end. */
static void take_words(const video_file *v, char *out, size_t room)
{
    static const char left_out[] = "... ", between[] = "; ";
    text_buffer b = {0};
    const char *at = v->said, *end = v->said + v->said_count, *stop = memchr(at, '\n', (size_t)(end - at));
    if (v->said_more && stop)
        at = stop;
    for (; at < end; at = stop + (stop < end)) {
        stop = memchr(at, '\n', (size_t)(end - at));
        stop = stop ? stop : end;
        if (stop > at && b.count > 0)
            text_add(v->ctx, &b, between);
        put_line(v, at, stop, &b);
    }
    const char *text = b.data && !b.failed ? b.data : "", *from = text;
    size_t length = strlen(text), most = room - sizeof left_out;
    if (length > most) {
        from += length - most;
        const char *line = strstr(from, between);
        from = line ? line + strlen(between) : from;
        while (((unsigned char)*from & 0xC0) == 0x80) /* no part of a character */
            from++;
    }
    snprintf(out, room, "%s%s", from > text || v->said_more ? left_out : "", from);
    text_free(v->ctx, &b);
}

enum { TOLD_ROOM = 400 };

/* When it has ended. */
static fram_status refuse_ended(const video_file *v, const char *what, fram_error *error)
{
    char words[TOLD_ROOM];
    take_words(v, words, sizeof words);
    return error_set(error, FRAM_ERROR_IO, v->path, 0, NULL, "%s%s%s", what, words[0] ? ": " : "", words);
}

/* It made the video, and said something. */
static void tell_words(const video_file *v)
{
    char words[TOLD_ROOM];
    take_words(v, words, sizeof words);
    if (words[0])
        log_write(v->ctx, LOG_WARNING, "%s: ffmpeg made the video, and said: %s", v->path, words);
}

static void close_frames(video_file *v)
{
    if (v->socket >= 0)
        close(v->socket);
    v->socket = -1;
}

/* Until it says something or a while has gone by; it may wait to be heard. */
static void hear_for_a_while(video_file *v)
{
    struct pollfd words = {v->words, POLLIN, 0};
    (void)poll(&words, 1, LOOK_EVERY);
    hear(v);
}

static void end_it(video_file *v)
{
    if (v->process > 0)
        kill((pid_t)v->process, SIGTERM);
    close_frames(v); /* where ffmpeg waits for a frame it does not heed the signal */
    while (!has_ended(v))
        hear_for_a_while(v);
    hear(v);
    (void)wait_for(v);
}

/* It takes no more: it has ended, or is ended. */
static fram_status refuse_video(video_file *v, const char *what, fram_error *error)
{
    end_it(v);
    return refuse_ended(v, what, error);
}

static fram_status refuse_stopped(fram_error *error)
{
    return error_set(error, FRAM_INTERRUPTED, NULL, 0, NULL, "interrupted while making the video; nothing was written");
}

fram_status video_frame(video_file *v, const void *pixels, size_t size, fram_error *error)
{
    static const char none_taken[] = "ffmpeg stopped taking frames";
    const char *at = pixels;
    while (size > 0) {
        struct pollfd ends[] = {{v->socket, POLLOUT, 0}, {v->words, POLLIN, 0}};
        int ready = poll(ends, 2, LOOK_EVERY);
        if (ready <= 0 && stop_is_asked(v->ctx->stop))
            return refuse_stopped(error);
        if (ready == 0 && has_ended(v))
            return refuse_video(v, none_taken, error);
        hear(v);
        ssize_t sent = send(v->socket, at, size, MSG_NOSIGNAL | MSG_DONTWAIT);
        if (sent < 0 && (errno == EINTR || errno == EAGAIN))
            continue;
        if (sent <= 0)
            return refuse_video(v, none_taken, error);
        at += sent;
        size -= (size_t)sent;
    }
    hear(v);
    return FRAM_OK;
}

fram_status video_end(video_file *v, fram_error *error)
{
    fram_status status = FRAM_OK;
    close_frames(v);
    while (!has_ended(v)) {
        hear_for_a_while(v);
        if (stop_is_asked(v->ctx->stop)) {
            video_abandon(v);
            return refuse_stopped(error);
        }
    }
    hear(v);
    if (wait_for(v)) {
        status = atomic_file_adopt(v->ctx, v->temporary, v->path, error);
        if (status == FRAM_OK)
            tell_words(v);
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
    end_it(v);
    unlink(v->temporary);
    forget_video(v);
}
