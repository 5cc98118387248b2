#include "io/path.h"

#include "io/run_files.h"

#include <errno.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

fram_status path_join(const char *folder, const char *name, char out[PATH_ROOM], fram_error *error)
{
    int length = snprintf(out, PATH_ROOM, "%s/%s", folder, name);
    if (length >= 0 && length < PATH_ROOM)
        return FRAM_OK;
    return error_set(error, FRAM_ERROR_INPUT, folder, 0, NULL,
                     "expected a folder whose files have paths of less than %d bytes, found a longer name",
                     (int)PATH_ROOM);
}

bool path_is_same(const char *one, const char *other)
{
    struct stat a, b;
    return stat(one, &a) == 0 && stat(other, &b) == 0 && a.st_dev == b.st_dev && a.st_ino == b.st_ino;
}

bool path_is_own(const char *run, const char *path)
{
    const run_file *f;
    bool found = false;
    for (int32_t i = 0; !found && (f = run_file_at(i)) != NULL; i++) {
        char own[PATH_ROOM]; /* where that is too long there is no such file */
        found = f->source && path_join(run, f->name, own, NULL) == FRAM_OK && path_is_same(own, path);
    }
    return found;
}

fram_status path_refuse_own(const char *run, const char *path, fram_error *error)
{
    if (!path_is_own(run, path))
        return FRAM_OK;
    return error_set(error, FRAM_ERROR_USAGE, path, 0, "output",
                     "expected a file of its own, found one that the run is made of");
}

fram_status path_refuse_read(const char *read, const char *path, const char *key, fram_error *error)
{
    if (!path_is_same(read, path) && !path_is_own(read, path))
        return FRAM_OK;
    return error_set(error, FRAM_ERROR_USAGE, path, 0, key, "expected a file of its own, found one that is read");
}

/* In the same call that makes the path, and not when the file is begun: what draws, prints and prepares a file in
   between has many hands, and a link that leads outside is taken away however they end. */
fram_status path_claim(const char *path, fram_error *error)
{
    struct stat about, behind;
    bool stays = lstat(path, &about) != 0 || S_ISREG(about.st_mode) || S_ISDIR(about.st_mode) ||
                 (stat(path, &behind) == 0 && S_ISDIR(behind.st_mode));
    if (stays || unlink(path) == 0)
        return FRAM_OK;
    return error_set(error, FRAM_ERROR_IO, path, 0, NULL,
                     "cannot take away the link, device or pipe that stands in the place of the file: remove it");
}

fram_status path_own(const char *folder, const char *name, char out[PATH_ROOM], fram_error *error)
{
    fram_status status = path_join(folder, name, out, error);
    return status == FRAM_OK ? path_claim(out, error) : status;
}

/* The same of a path that lies in the folder itself, whoever named it; of another one nothing. */
static fram_status path_claim_in(const char *folder, const char *path, fram_error *error)
{
    char above[PATH_ROOM] = ".";
    const char *slash = strrchr(path, '/');
    if (slash && snprintf(above, sizeof above, "%.*s", (int)(slash + 1 - path), path) >= PATH_ROOM)
        return FRAM_OK; /* the system takes no such path */
    return path_is_same(above, folder) ? path_claim(path, error) : FRAM_OK;
}

fram_status path_take(const char *run, const char *path, fram_error *error)
{
    fram_status status = path_refuse_own(run, path, error);
    return status == FRAM_OK ? path_claim_in(run, path, error) : status;
}

fram_status path_refuse_long(const char *given, const char *path, fram_error *error)
{
    struct stat about;
    if (lstat(path, &about) == 0 || errno != ENAMETOOLONG)
        return FRAM_OK;
    const char *slash = strrchr(path, '/');
    return error_set(error, FRAM_ERROR_INPUT, given, 0, "output",
                     "expected a shorter name: a file named after it would have one of %zu bytes, which the file "
                     "system does not take",
                     strlen(slash ? slash + 1 : path));
}

fram_status path_given_or(const char *given, const char *folder, const char *name, char out[PATH_ROOM],
                          fram_error *error)
{
    if (!given)
        return path_own(folder, name, out, error);
    int length = snprintf(out, PATH_ROOM, "%s", given);
    if (length >= 0 && length < PATH_ROOM)
        return folder ? path_take(folder, given, error) : FRAM_OK;
    return error_set(error, FRAM_ERROR_INPUT, given, 0, NULL,
                     "expected a path of less than %d bytes, found a longer one", (int)PATH_ROOM);
}

bool path_absolute(const char *path, char *out, size_t size)
{
    size_t length = 0, rest = strlen(path) + 1;
    if (path[0] != '/') {
        if (!getcwd(out, size)) {
            out[0] = '\0';
            return false;
        }
        length = strlen(out);
        if (length > 1)
            out[length++] = '/'; /* in place of the NUL */
    }
    bool fits = rest <= size - length;
    if (fits)
        memcpy(out + length, path, rest);
    else
        out[0] = '\0';
    return fits;
}
