#include "io/fill.h"

#include "io/file.h"
#include "io/path.h"

#include <errno.h>
#include <fcntl.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

/* ---- descriptors that have a name ---- */

/* Links that lead to links; the system itself follows no more. */
enum { LINKS_MOST = 40 };

static bool are_one_folder(const char *path, const char *other)
{
    struct stat own, given;
    int held = open(other, O_RDONLY | O_DIRECTORY | O_CLOEXEC); /* so that it stays what it is meanwhile */
    bool same = held >= 0 && fstat(held, &own) == 0 && stat(path, &given) == 0 && own.st_dev == given.st_dev &&
                own.st_ino == given.st_ino;
    if (held >= 0)
        close(held);
    return same;
}

/* Whether the folder of a path, which ends at `name`, is one of this program's descriptors. */
static bool is_of_descriptors(char *path, char *name)
{
    char kept = *name;
    *name = '\0';
    bool same = are_one_folder(path, "/proc/self/fd") || are_one_folder(path, "/proc/thread-self/fd");
    *name = kept;
    return same;
}

/* The descriptor of this program that a path leads to; -1: none.  Links are followed one by one: behind the last, which
   is the system's, lies the file, which does not tell by whom it is open. */
static int descriptor_of(const char *path)
{
    char at[PATH_ROOM], target[PATH_ROOM];
    if (snprintf(at, sizeof at, "%s", path) >= (int)sizeof at)
        return -1;
    for (int i = 0; i < LINKS_MOST; i++) {
        ssize_t length = readlink(at, target, sizeof target - 1);
        char *slash = strrchr(at, '/'), *name = slash ? slash + 1 : at;
        bool number = slash && *name && strspn(name, "0123456789") == strlen(name);
        if (number && (length > 0 || errno == ENOENT) && is_of_descriptors(at, name))
            return (int)strtol(name, NULL, 10); /* one that is not open is for who writes to refuse */
        if (length <= 0)
            return -1;
        target[length] = '\0';
        char *to = target[0] == '/' ? at : name;
        if (snprintf(to, sizeof at - (size_t)(to - at), "%s", target) >= (int)(sizeof at - (size_t)(to - at)))
            return -1;
    }
    return -1;
}

bool fill_is_stream(const char *path)
{
    struct stat about;
    return descriptor_of(path) >= 0 || (stat(path, &about) == 0 && !S_ISREG(about.st_mode) && !S_ISDIR(about.st_mode));
}

/* ---- files and pipes ---- */

/* Before a pipe without a reader is tried again [ns]. */
enum { READER_PAUSE = 10 * 1000 * 1000 };

static bool is_named_pipe(const char *path)
{
    struct stat about;
    return stat(path, &about) == 0 && S_ISFIFO(about.st_mode);
}

/* -1 with EINTR: a stop was asked for.  The system would wait for a reader without an end, and not hear of a wish to
   stop that came just before. */
static int open_named(const context *ctx, const char *path)
{
    for (;;) {
        const bool pipe = is_named_pipe(path);
        int descriptor = open(path, O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC | (pipe ? O_NONBLOCK : 0), 0666);
        if (descriptor >= 0 && pipe)
            fcntl(descriptor, F_SETFL, O_WRONLY); /* from here on it waits */
        const bool no_reader = descriptor < 0 && pipe && errno == ENXIO;
        if (descriptor >= 0 || !(no_reader || errno == EINTR))
            return descriptor;
        if (stop_is_asked(ctx->stop)) {
            errno = EINTR;
            return -1;
        }
        if (no_reader)
            nanosleep(&(struct timespec){.tv_nsec = READER_PAUSE}, NULL);
    }
}

fram_status fill_open(context *ctx, const char *path, int *descriptor, fram_error *error)
{
    const int own = descriptor_of(path);
    if (own >= 0) {
        fflush(stdout);
        *descriptor = fcntl(own, F_DUPFD_CLOEXEC, 0);
    } else {
        *descriptor = open_named(ctx, path);
    }
    if (*descriptor >= 0)
        return FRAM_OK;
    if (errno == EINTR)
        return error_set(error, FRAM_INTERRUPTED, path, 0, NULL, "interrupted while waiting for a reader of the pipe");
    return file_place_error(error, path, "open for writing", errno);
}
