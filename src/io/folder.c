#include "io/folder.h"

#include "io/file.h"
#include "io/path.h"

#include <errno.h>
#include <fcntl.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

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

bool name_is_numbered(const char *name, const char *begin, size_t digits, const char *end)
{
    size_t length = strlen(begin);
    if (strncmp(name, begin, length) != 0)
        return false;
    size_t found = strspn(name + length, "0123456789");
    return found >= digits && strcmp(name + length + found, end) == 0;
}

DIR *folder_open_own(const char *path)
{
    int descriptor = open(path, O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
    DIR *folder = descriptor >= 0 ? fdopendir(descriptor) : NULL;
    if (!folder && descriptor >= 0)
        close(descriptor);
    return folder;
}

fram_status folder_make_own(const char *path, fram_error *error)
{
    if (mkdir(path, 0777) == 0)
        return FRAM_OK;
    return errno == EEXIST ? folder_refuse_other(path, error) : file_place_error(error, path, "make the folder", errno);
}

fram_status folder_refuse_other(const char *path, fram_error *error)
{
    struct stat about;
    if (lstat(path, &about) != 0 || S_ISDIR(about.st_mode))
        return FRAM_OK;
    return error_set(error, FRAM_ERROR_INPUT, path, 0, NULL,
                     "expected a folder to write into, found %s: remove it, or move it away",
                     S_ISLNK(about.st_mode) ? "a link" : "a file");
}

void folder_remove_files(const char *path, bool (*is_such)(const char *name))
{
    DIR *folder = folder_open_own(path);
    if (!folder)
        return;
    int failure;
    for (const char *name = folder_next(folder, &failure); name; name = folder_next(folder, &failure)) {
        if (is_such(name))
            (void)unlinkat(dirfd(folder), name, 0);
    }
    closedir(folder);
}

bool folder_file_begins(const char *folder, const char *name, const char *text)
{
    enum { BEGINNING_ROOM = 64 };
    char path[PATH_ROOM], found[BEGINNING_ROOM];
    size_t length = strlen(text);
    uint64_t size;
    int descriptor;
    if (path_join(folder, name, path, NULL) != FRAM_OK ||
        file_open_regular(path, UINT64_MAX, &descriptor, &size, NULL) != FRAM_OK)
        return false;
    bool same = length <= sizeof found && file_read_at(descriptor, path, 0, found, length, NULL) == FRAM_OK &&
                memcmp(found, text, length) == 0;
    close(descriptor);
    return same;
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

fram_status folder_check_place(const char *path, bool folder, fram_error *error)
{
    char above[PATH_ROOM] = ".";
    size_t length = strlen(path);
    struct stat about;
    int failure = 0;
    if (lstat(path, &about) == 0 || length >= sizeof above)
        return FRAM_OK;
    while (length > 0 && path[length - 1] == '/')
        length--;
    while (length > 0 && path[length - 1] != '/')
        length--;
    if (length > 0)
        snprintf(above, sizeof above, "%.*s", (int)length, path);
    if (stat(above, &about) != 0)
        failure = errno;
    else if (!S_ISDIR(about.st_mode))
        failure = ENOTDIR;
    else if (access(above, W_OK | X_OK) != 0)
        failure = errno;
    return failure ? file_place_error(error, path, folder ? "make the folder" : "open for writing", failure) : FRAM_OK;
}
