#include "io/fill.h"

#include "io/file.h"
#include "io/path.h"

#include <errno.h>
#include <fcntl.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* ---- descriptors that have a name ---- */

/* Links that lead to links; the system itself follows no more. */
enum { LINKS_MOST = 40 };

/* Whether the folder of a path, which ends at `name`, is the one of this program's descriptors. */
static bool is_of_descriptors(char *path, char *name)
{
    struct stat own, given;
    int held = open("/proc/self/fd", O_RDONLY | O_DIRECTORY | O_CLOEXEC); /* so that it stays what it is meanwhile */
    char kept = *name;
    *name = '\0';
    bool same = held >= 0 && fstat(held, &own) == 0 && stat(path, &given) == 0 && own.st_dev == given.st_dev &&
                own.st_ino == given.st_ino;
    *name = kept;
    if (held >= 0)
        close(held);
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
        if (length <= 0)
            return -1;
        target[length] = '\0';
        char *slash = strrchr(at, '/'), *name = slash ? slash + 1 : at;
        if (slash && is_of_descriptors(at, name))
            return (int)strtol(name, NULL, 10);
        char *to = target[0] == '/' ? at : name;
        if (snprintf(to, sizeof at - (size_t)(to - at), "%s", target) >= (int)(sizeof at - (size_t)(to - at)))
            return -1;
    }
    return -1;
}

fram_status fill_open(const char *path, int *descriptor, fram_error *error)
{
    const int own = descriptor_of(path);
    if (own >= 0) {
        fflush(stdout);
        *descriptor = fcntl(own, F_DUPFD_CLOEXEC, 0);
    } else {
        do
            *descriptor = open(path, O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
        while (*descriptor < 0 && errno == EINTR);
    }
    return *descriptor < 0 ? file_error(error, path, "open for writing", errno) : FRAM_OK;
}
