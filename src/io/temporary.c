#include "io/temporary.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <string.h>
#include <sys/random.h>
#include <sys/stat.h>

/* NAME.0123456789abcdef.new; of a long NAME the beginning, so that the whole is a name that every file system takes. */
enum { RANDOM_DIGITS = 16, NAME_MOST = 200, TRIES_MOST = 100 };
static const char ending[] = ".new";

/* Memory for the name with its random part still open; *random points to that. */
static char *name_room(context *ctx, const char *path, char **random)
{
    const char *slash = strrchr(path, '/'), *base = slash ? slash + 1 : path, *here = path[0] == '/' ? "" : "./";
    int folder = (int)(base - path);
    size_t room = strlen(path) + RANDOM_DIGITS + sizeof ending + 4;
    char *name = memory_array(ctx, room, 1);
    if (!name)
        return NULL;
    int length = snprintf(name, room, "%s%.*s%.*s.", here, folder, path, NAME_MOST, base);
    *random = name + length;
    memcpy(*random + RANDOM_DIGITS, ending, sizeof ending);
    return name;
}

static bool draw_name(char *random)
{
    uint64_t bits;
    char digits[RANDOM_DIGITS + 1];
    if (getrandom(&bits, sizeof bits, 0) != (ssize_t)sizeof bits)
        return false;
    snprintf(digits, sizeof digits, "%016llx", (unsigned long long)bits);
    memcpy(random, digits, RANDOM_DIGITS);
    return true;
}

/* 0, or an errno value. */
static int make_file(const char *name, int *descriptor)
{
    *descriptor = open(name, O_RDWR | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
    return *descriptor < 0 ? errno : 0;
}

static fram_status make(context *ctx, const char *path, char **name, int *descriptor, fram_error *error)
{
    char *random;
    *name = name_room(ctx, path, &random);
    if (!*name)
        return error_memory(error);
    int failure = EEXIST;
    for (int i = 0; i < TRIES_MOST && (failure == EEXIST || failure == EINTR); i++) {
        if (!draw_name(random))
            failure = EAGAIN;
        else if (descriptor)
            failure = make_file(*name, descriptor);
        else
            failure = mkdir(*name, 0777) == 0 ? 0 : errno;
    }
    if (failure == 0)
        return FRAM_OK;
    memory_free(ctx, *name);
    *name = NULL;
    return file_place_error(error, path, "open for writing", failure);
}

fram_status temporary_file(context *ctx, const char *path, char **name, int *descriptor, fram_error *error)
{
    *descriptor = -1;
    return make(ctx, path, name, descriptor, error);
}

fram_status temporary_folder(context *ctx, const char *path, char **name, fram_error *error)
{
    return make(ctx, path, name, NULL, error);
}

bool temporary_is_of(const char *name, const char *base)
{
    size_t length = strnlen(base, NAME_MOST);
    return strncmp(name, base, length) == 0 && name[length] == '.' &&
           strspn(name + length + 1, "0123456789abcdef") == RANDOM_DIGITS &&
           strcmp(name + length + 1 + RANDOM_DIGITS, ending) == 0;
}

bool temporary_is_name(const char *name)
{
    size_t length = strlen(name), rest = 1 + RANDOM_DIGITS + strlen(ending);
    return length > rest && name[length - rest] == '.' &&
           strspn(name + length - rest + 1, "0123456789abcdef") == RANDOM_DIGITS &&
           strcmp(name + length - strlen(ending), ending) == 0;
}
