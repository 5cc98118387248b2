#include "io/folder.h"

#include "io/file.h"

#include <errno.h>
#include <string.h>

const char *folder_next(DIR *folder, int *failure)
{
    for (;;) {
        errno = 0;
        const struct dirent *entry = readdir(folder);
        *failure = entry ? 0 : errno;
        if (!entry)
            return NULL;
        if (strcmp(entry->d_name, ".") != 0 && strcmp(entry->d_name, "..") != 0)
            return entry->d_name;
    }
}

fram_status folder_is_empty(const char *path, bool *empty, fram_error *error)
{
    *empty = true;
    DIR *folder = opendir(path);
    if (!folder && errno == ENOENT)
        return FRAM_OK;
    if (!folder)
        return file_error(error, path, "open the folder", errno);
    int failure;
    *empty = !folder_next(folder, &failure);
    closedir(folder);
    return failure ? file_error(error, path, "list the folder", failure) : FRAM_OK;
}

fram_status folder_refuse(const char *path, fram_error *error)
{
    return error_set(error, FRAM_ERROR_USAGE, path, 0, "folder",
                     "the folder is not empty; name another one, or allow that the results in it are overwritten");
}
