#include "io/path.h"

#include <string.h>
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

fram_status path_given_or(const char *given, const char *folder, const char *name, char out[PATH_ROOM],
                          fram_error *error)
{
    if (!given)
        return path_join(folder, name, out, error);
    int length = snprintf(out, PATH_ROOM, "%s", given);
    if (length >= 0 && length < PATH_ROOM)
        return FRAM_OK;
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
