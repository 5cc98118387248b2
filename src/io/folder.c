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

/* Links that lead to links; the system itself follows no more. */
enum { PLACE_LINKS_MOST = 40 };

/* The path's part up to and with its last slash that something follows: its length, 0 for the working folder. */
static size_t length_above(const char *path)
{
    size_t length = strlen(path);
    while (length > 0 && path[length - 1] == '/')
        length--;
    while (length > 0 && path[length - 1] != '/')
        length--;
    return length;
}

/* Where a link leads, from the working folder as it does; false: nowhere that could be told. */
static bool link_target(const char *path, char out[PATH_ROOM])
{
    char target[PATH_ROOM];
    ssize_t length = readlink(path, target, sizeof target - 1);
    if (length <= 0)
        return false;
    target[length] = '\0';
    int above = target[0] == '/' ? 0 : (int)length_above(path);
    return snprintf(out, PATH_ROOM, "%.*s%s", above, path, target) < PATH_ROOM;
}

/* 0, or the errno value of what is in the way. */
static int failure_of_folder(const char *path)
{
    char above[PATH_ROOM] = ".";
    size_t length = length_above(path);
    struct stat about;
    if (length > 0)
        snprintf(above, sizeof above, "%.*s", (int)length, path);
    if (stat(above, &about) != 0)
        return errno;
    if (!S_ISDIR(about.st_mode))
        return ENOTDIR;
    return access(above, W_OK | X_OK) == 0 ? 0 : errno;
}

/* The same.  Of a link that leads to nothing a file is made where it leads, a folder is not. */
static int failure_of_place(const char *path, bool folder)
{
    char at[PATH_ROOM], target[PATH_ROOM];
    struct stat about;
    if (snprintf(at, sizeof at, "%s", path) >= PATH_ROOM)
        return 0; /* the system takes no such path */
    for (int i = 0; i < PLACE_LINKS_MOST; i++) {
        size_t length = strlen(at);
        while (folder && length > 1 && at[length - 1] == '/')
            at[--length] = '\0'; /* a link is seen without them only */
        if (lstat(at, &about) != 0)
            return failure_of_folder(at);
        if (!S_ISLNK(about.st_mode) || stat(at, &about) == 0)
            return 0;
        if (errno != ENOENT || folder || !link_target(at, target))
            return errno;
        memcpy(at, target, sizeof at);
    }
    return ELOOP;
}

fram_status folder_check_place(const char *path, bool folder, fram_error *error)
{
    int failure = failure_of_place(path, folder);
    return failure ? file_place_error(error, path, folder ? "make the folder" : "open for writing", failure) : FRAM_OK;
}
