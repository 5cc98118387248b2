/* Replacing a file in one go: the rename of POSIX is atomic, and data are on the disk before it. */
#include "io/atomic_file.h"
#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* What a rename would take away instead of filling it: a device, a pipe, a link.  Not a folder. */
static bool is_special(const char *path)
{
    struct stat about;
    return lstat(path, &about) == 0 && !S_ISREG(about.st_mode) && !S_ISDIR(about.st_mode);
}

static fram_status refuse_no_file(const char *path, fram_error *error)
{
    struct stat about;
    if (!*path)
        return error_set(error, FRAM_ERROR_INPUT, NULL, 0, NULL, "expected the name of a file, found an empty text");
    if (stat(path, &about) == 0 && S_ISDIR(about.st_mode))
        return error_set(error, FRAM_ERROR_INPUT, path, 0, NULL, "expected the name of a file, found a folder");
    return FRAM_OK;
}

static fram_status begin_atomic(context *ctx, const char *path, bool direct, atomic_file *a, fram_error *error)
{
    memset(a, 0, sizeof *a);
    fram_status status = refuse_no_file(path, error);
    if (status != FRAM_OK)
        return status;
    a->direct = direct;
    a->path = memory_string(ctx, path);
    if (!a->path)
        return error_memory(error);
    status =
        a->direct ? file_create(ctx, path, &a->writer, error) : file_create_temporary(ctx, path, &a->writer, error);
    if (status != FRAM_OK) {
        memory_free(ctx, a->path);
        a->path = NULL;
    }
    return status;
}

fram_status atomic_file_begin(context *ctx, const char *path, atomic_file *a, fram_error *error)
{
    return begin_atomic(ctx, path, is_special(path), a, error);
}

fram_status atomic_file_begin_over(context *ctx, const char *path, atomic_file *a, fram_error *error)
{
    return begin_atomic(ctx, path, false, a, error);
}

/* The rename itself reaches the disk with the folder. */
static fram_status sync_folder(context *ctx, const char *path, fram_error *error)
{
    const char *slash = strrchr(path, '/');
    size_t length = slash ? (size_t)(slash - path) + 1 : 1;
    char *folder = memory_resize(ctx, NULL, length + 1);
    if (!folder)
        return error_memory(error);
    memcpy(folder, slash ? path : ".", length);
    folder[length] = '\0';
    fram_status status = FRAM_OK;
    int descriptor = open(folder, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (descriptor < 0 || !file_sync(descriptor))
        status = file_error(error, folder, "write to the disk", errno);
    if (descriptor >= 0)
        close(descriptor);
    memory_free(ctx, folder);
    return status;
}

static fram_status commit(atomic_file *a, bool sync, fram_error *error)
{
    context *ctx = a->writer.ctx;
    char *temporary = a->writer.temporary;
    fram_status status = file_flush(&a->writer, sync, error);
    a->writer.temporary = NULL; /* outlives the writer */
    fram_status closed = file_close(&a->writer, status == FRAM_OK ? error : NULL);
    if (status == FRAM_OK)
        status = closed;
    if (status == FRAM_OK && !a->direct && rename(temporary, a->path) != 0)
        status = file_error(error, a->path, "replace", errno);
    if (status != FRAM_OK && !a->direct)
        unlink(temporary);
    else if (sync && !a->direct)
        status = sync_folder(ctx, a->path, error);
    memory_free(ctx, temporary);
    memory_free(ctx, a->path);
    a->path = NULL;
    return status;
}

fram_status atomic_file_commit(atomic_file *a, fram_error *error) { return commit(a, true, error); }

fram_status atomic_file_place(atomic_file *a, fram_error *error) { return commit(a, false, error); }

void atomic_file_abandon(atomic_file *a)
{
    if (!a->path)
        return;
    context *ctx = a->writer.ctx;
    if (!a->direct)
        unlink(a->writer.temporary);
    file_abandon(&a->writer);
    memory_free(ctx, a->path);
    a->path = NULL;
}

fram_status atomic_file_check(const char *path, fram_error *error)
{
    fram_status status = refuse_no_file(path, error);
    if (status == FRAM_OK && is_special(path))
        status = error_set(error, FRAM_ERROR_INPUT, path, 0, NULL, "expected a regular file, found a device or a link");
    return status;
}

fram_status atomic_file_adopt(context *ctx, const char *temporary, const char *path, fram_error *error)
{
    fram_status status = atomic_file_check(path, error);
    int descriptor = status == FRAM_OK ? open(temporary, O_RDONLY | O_CLOEXEC) : -1;
    if (status == FRAM_OK && (descriptor < 0 || !file_sync(descriptor)))
        status = file_error(error, path, "write to the disk", errno);
    if (descriptor >= 0)
        close(descriptor);
    if (status == FRAM_OK && rename(temporary, path) != 0)
        status = file_error(error, path, "replace", errno);
    if (status == FRAM_OK)
        return sync_folder(ctx, path, error);
    unlink(temporary);
    return status;
}

static fram_status write_whole(context *ctx, const char *path, const void *data, size_t size, bool sync,
                               fram_error *error)
{
    atomic_file a;
    fram_status status = atomic_file_begin(ctx, path, &a, error);
    if (status != FRAM_OK)
        return status;
    status = file_write(&a.writer, data, size, error);
    if (status == FRAM_OK)
        return commit(&a, sync, error);
    atomic_file_abandon(&a);
    return status;
}

fram_status atomic_file_write(context *ctx, const char *path, const void *data, size_t size, fram_error *error)
{
    return write_whole(ctx, path, data, size, true, error);
}

fram_status text_file_write(context *ctx, const char *path, const text_buffer *text, fram_error *error)
{
    return text->failed ? error_memory(error) : atomic_file_write(ctx, path, text->data, (size_t)text->count, error);
}

fram_status atomic_file_put(context *ctx, const char *path, const void *data, size_t size, fram_error *error)
{
    return write_whole(ctx, path, data, size, false, error);
}
