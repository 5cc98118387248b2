/* Files through the calls of POSIX, so that every failure is seen where it happens. */
#include "base/clock.h"
#include "io/fill.h"
#include "io/temporary.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <math.h>
#include <poll.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zlib.h>

enum { BUFFER_SIZE = 1 << 16 };

fram_status file_error(fram_error *error, const char *path, const char *attempt, int number)
{
    char text[128];
    if (strerror_r(number, text, sizeof text) != 0)
        text[0] = '\0';
    /* Numbers that say that the name is wrong, or not for this user; the others are the system's trouble. */
    bool name = number == ENOENT || number == ENOTDIR || number == EISDIR || number == EACCES || number == ELOOP ||
                number == ENAMETOOLONG;
    return error_set(error, name ? FRAM_ERROR_INPUT : FRAM_ERROR_IO, path, 0, NULL, "cannot %s: %s", attempt, text);
}

/* Of a path the part without slashes at its end, and of that the folder that it lies in: lengths, 0 for the working
   folder. */
static size_t without_slashes(const char *path, size_t length)
{
    while (length > 1 && path[length - 1] == '/')
        length--;
    return length;
}

static size_t folder_of(const char *path, size_t length)
{
    length = without_slashes(path, length);
    while (length > 0 && path[length - 1] != '/')
        length--;
    return without_slashes(path, length);
}

/* The part of a path that there is, the whole of it or what is above: its length, 0 for the working folder. */
static size_t part_that_is(const char *path, bool *leads_nowhere)
{
    char part[PATH_MAX];
    struct stat about;
    size_t length = without_slashes(path, strlen(path));
    *leads_nowhere = false;
    for (; length > 0 && length < sizeof part; length = folder_of(path, length)) {
        memcpy(part, path, length);
        part[length] = '\0';
        if (lstat(part, &about) != 0)
            continue;
        *leads_nowhere = S_ISLNK(about.st_mode) && stat(part, &about) != 0;
        return length;
    }
    return 0;
}

fram_status file_place_error(fram_error *error, const char *path, const char *attempt, int number)
{
    enum { TOLD = 250 };
    bool leads_nowhere;
    size_t folder = folder_of(path, strlen(path)), there = part_that_is(path, &leads_nowhere);
    if (number == ENOENT && leads_nowhere)
        return error_set(error, FRAM_ERROR_INPUT, path, 0, NULL,
                         "cannot %s: the link %.*s leads nowhere; remove it, or give another name", attempt,
                         there < TOLD ? (int)there : TOLD, path);
    if (number != ENOENT || folder <= there)
        return file_error(error, path, attempt, number);
    return error_set(error, FRAM_ERROR_INPUT, path, 0, NULL,
                     "cannot %s: the folder %.*s is not there; make it, or give another name", attempt,
                     folder < TOLD ? (int)folder : TOLD, path);
}

uint32_t file_crc(uint32_t crc, const void *data, size_t size)
{
    return size > 0 ? (uint32_t)crc32_z(crc, data, size) : crc; /* crc32_z begins anew at NULL */
}

/* open() again when a signal came between. */
static int open_file(const char *path, int flags)
{
    int descriptor;
    do
        descriptor = open(path, flags | O_CLOEXEC, 0666);
    while (descriptor < 0 && errno == EINTR);
    return descriptor;
}

fram_status file_read_at(int descriptor, const char *path, uint64_t offset, void *data, size_t size, fram_error *error)
{
    char *to = data;
    for (size_t done = 0; done < size;) {
        ssize_t got = pread(descriptor, to + done, size - done, (off_t)(offset + done));
        if (got < 0 && errno == EINTR)
            continue;
        if (got < 0)
            return file_error(error, path, "read", errno);
        if (got == 0)
            return error_set(error, FRAM_ERROR_INPUT, path, 0, NULL, "expected %zu bytes at offset %llu, found the end",
                             size, (unsigned long long)offset);
        done += (size_t)got;
    }
    return FRAM_OK;
}

static const char *kind_of(mode_t mode)
{
    return S_ISDIR(mode) ? "a folder" : S_ISFIFO(mode) ? "a pipe" : S_ISSOCK(mode) ? "a socket" : "a device";
}

static fram_status check_regular(int descriptor, const char *path, uint64_t limit, uint64_t *size, fram_error *error)
{
    struct stat about;
    char byte;
    if (fstat(descriptor, &about) != 0)
        return file_error(error, path, "read", errno);
    if (!S_ISREG(about.st_mode))
        return error_set(error, FRAM_ERROR_INPUT, path, 0, NULL, "expected a regular file, found %s",
                         kind_of(about.st_mode));
    *size = (uint64_t)about.st_size;
    /* One that cannot be read from its beginning is no empty file either: /proc/self/mem. */
    if (*size == 0 && pread(descriptor, &byte, 1, 0) != 0)
        return error_set(error, FRAM_ERROR_INPUT, path, 0, NULL,
                         "expected a regular file, found one of the system that has no size");
    if (*size > limit)
        return error_set(error, FRAM_ERROR_INPUT, path, 0, NULL, "expected at most %llu bytes, found %llu",
                         (unsigned long long)limit, (unsigned long long)*size);
    return FRAM_OK;
}

fram_status file_open_regular(const char *path, uint64_t limit, int *descriptor, uint64_t *size, fram_error *error)
{
    *descriptor = open_file(path, O_RDONLY | O_NONBLOCK); /* opening a pipe must not wait for its writer */
    if (*descriptor < 0)
        return file_error(error, path, "read", errno);
    fram_status status = check_regular(*descriptor, path, limit, size, error);
    if (status != FRAM_OK) {
        close(*descriptor);
        *descriptor = -1;
    }
    return status;
}

fram_status file_check(const char *path, fram_error *error)
{
    int descriptor;
    uint64_t size;
    fram_status status = file_open_regular(path, UINT64_MAX, &descriptor, &size, error);
    if (status == FRAM_OK)
        close(descriptor);
    return status;
}

bool file_is_readable(const char *path) { return file_check(path, NULL) == FRAM_OK; }

static fram_status read_regular(context *ctx, int descriptor, const char *path, uint64_t length, char **data,
                                size_t *size, fram_error *error)
{
    char *text = length < SIZE_MAX ? memory_resize(ctx, NULL, (size_t)length + 1) : NULL;
    if (!text)
        return error_memory(error);
    fram_status status = file_read_at(descriptor, path, 0, text, (size_t)length, error);
    if (status != FRAM_OK) {
        memory_free(ctx, text);
        return status;
    }
    text[length] = '\0';
    *data = text;
    *size = (size_t)length;
    return FRAM_OK;
}

fram_status file_read(context *ctx, const char *path, uint64_t limit, char **data, size_t *size, fram_error *error)
{
    int descriptor = -1;
    uint64_t length = 0;
    fram_status status = file_open_regular(path, limit, &descriptor, &length, error);
    if (status != FRAM_OK)
        return status;
    status = read_regular(ctx, descriptor, path, length, data, size, error);
    close(descriptor);
    return status;
}

/* ---- writing ---- */

static fram_status make_room(context *ctx, const char *path, file_writer *w, fram_error *error)
{
    memset(w, 0, sizeof *w);
    w->ctx = ctx;
    w->descriptor = -1;
    w->path = memory_string(ctx, path);
    w->buffer = memory_resize(ctx, NULL, BUFFER_SIZE);
    return w->path && w->buffer ? FRAM_OK : error_memory(error);
}

static fram_status begin(context *ctx, const char *path, bool anew, file_writer *w, fram_error *error)
{
    fram_status status = make_room(ctx, path, w, error);
    if (status == FRAM_OK && anew) {
        status = fill_open(ctx, path, &w->descriptor, error);
    } else if (status == FRAM_OK) {
        w->descriptor = open_file(path, O_RDWR);
        if (w->descriptor < 0)
            status = file_error(error, path, "open for writing", errno);
    }
    if (status != FRAM_OK)
        file_abandon(w);
    return status;
}

fram_status file_create_temporary(context *ctx, const char *path, file_writer *w, fram_error *error)
{
    fram_status status = make_room(ctx, path, w, error);
    if (status == FRAM_OK)
        status = temporary_file(ctx, path, &w->temporary, &w->descriptor, error);
    if (status != FRAM_OK)
        file_abandon(w);
    return status;
}

fram_status file_tell_as(file_writer *w, const char *path, fram_error *error)
{
    char *name = memory_string(w->ctx, path);
    if (!name)
        return error_memory(error);
    memory_free(w->ctx, w->path);
    w->path = name;
    return FRAM_OK;
}

fram_status file_create(context *ctx, const char *path, file_writer *w, fram_error *error)
{
    return begin(ctx, path, true, w, error);
}

fram_status file_open(context *ctx, const char *path, file_writer *w, fram_error *error)
{
    fram_status status = begin(ctx, path, false, w, error);
    if (status != FRAM_OK)
        return status;
    off_t end = lseek(w->descriptor, 0, SEEK_END);
    if (end < 0) {
        status = file_error(error, path, "find the end", errno);
        file_abandon(w);
        return status;
    }
    w->length = (uint64_t)end;
    return FRAM_OK;
}

/* What the first failure was. */
static fram_status refuse_writing(const file_writer *w, fram_error *error)
{
    if (w->failed == EINTR)
        return error_set(error, FRAM_INTERRUPTED, w->path, 0, NULL,
                         "interrupted while writing: the reader takes no more");
    return file_error(error, w->path, "write", w->failed);
}

/* How long a stream that does not wait by itself is full before it is looked at again [ms]. */
enum { ROOM_WAIT = 100 };
/* How long a reader is waited for after a wish to stop, in all [s]: for one that reads, and pauses, it is enough. */
#define STOPPED_WAIT 0.5

/* Whether a stop was asked for and the writing may wait for a reader, which may never take what there is no room for.
   A file's bytes are written all the same. */
static bool is_stopped_stream(const file_writer *w)
{
    struct stat about;
    return stop_is_asked(w->ctx->stop) && fstat(w->descriptor, &about) == 0 && !S_ISREG(about.st_mode);
}

/* At most so many milliseconds.  False only where nothing was taken all the while: what is wrong with a descriptor is
   for write to say. */
static bool wait_for_room(const file_writer *w, int most)
{
    struct pollfd stream = {.fd = w->descriptor, .events = POLLOUT};
    int answer;
    do
        answer = poll(&stream, 1, most);
    while (answer < 0 && errno == EINTR);
    return answer != 0;
}

/* Whether there is room after a wish to stop, for which what is left of the patience is waited. */
static bool room_is_left(file_writer *w)
{
    double since = clock_wall(), patience = fmax(STOPPED_WAIT - w->waited, 0);
    bool room = wait_for_room(w, (int)(1000 * patience));
    w->waited += clock_wall() - since;
    return room;
}

/* Bytes to the system; remembers the first failure. */
static fram_status write_out(file_writer *w, const char *data, size_t size, fram_error *error)
{
    for (size_t done = 0; done < size && !w->failed;) {
        size_t part = size - done;
        if (is_stopped_stream(w)) {
            if (!room_is_left(w)) {
                w->failed = EINTR;
                break;
            }
            part = part < PIPE_BUF ? part : PIPE_BUF; /* of more the system may wait for the rest */
        }
        ssize_t put_now = write(w->descriptor, data + done, part);
        if (put_now > 0)
            done += (size_t)put_now;
        else if (put_now == 0)
            w->failed = EIO;
        else if (errno == EAGAIN)
            wait_for_room(w, ROOM_WAIT); /* who shares the stream has set it not to wait */
        else if (errno != EINTR)
            w->failed = errno;
    }
    return w->failed ? refuse_writing(w, error) : FRAM_OK;
}

bool file_is_in_place(const file_writer *w)
{
    struct stat open_one, named;
    return fstat(w->descriptor, &open_one) == 0 && stat(w->path, &named) == 0 && open_one.st_dev == named.st_dev &&
           open_one.st_ino == named.st_ino;
}

fram_status file_cut(file_writer *w, uint64_t length, fram_error *error)
{
    if (length > w->length)
        return error_set(error, FRAM_ERROR_INPUT, w->path, 0, NULL, "expected at least %llu bytes, found %llu",
                         (unsigned long long)length, (unsigned long long)w->length);
    fram_status status = file_flush(w, false, error);
    if (status != FRAM_OK)
        return status;
    if (ftruncate(w->descriptor, (off_t)length) != 0 || lseek(w->descriptor, (off_t)length, SEEK_SET) < 0)
        return file_error(error, w->path, "cut", errno);
    w->length = length;
    return FRAM_OK;
}

fram_status file_write(file_writer *w, const void *data, size_t size, fram_error *error)
{
    if (w->failed)
        return refuse_writing(w, error);
    if (size == 0)
        return FRAM_OK;
    if (size > BUFFER_SIZE - w->filled) {
        fram_status status = file_flush(w, false, error);
        if (status != FRAM_OK)
            return status;
    }
    w->length += size;
    if (size > BUFFER_SIZE)
        return write_out(w, data, size, error);
    memcpy(w->buffer + w->filled, data, size);
    w->filled += size;
    return FRAM_OK;
}

bool file_sync(int descriptor)
{
    /* A device or a pipe has no disk below it, and some file systems can only be written through. */
    return fsync(descriptor) == 0 || errno == EINVAL || errno == EROFS;
}

fram_status file_flush(file_writer *w, bool sync, fram_error *error)
{
    size_t filled = w->filled;
    w->filled = 0;
    fram_status status = write_out(w, w->buffer, filled, error);
    if (status != FRAM_OK || !sync)
        return status;
    if (!file_sync(w->descriptor)) {
        w->failed = errno;
        return file_error(error, w->path, "write to the disk", w->failed);
    }
    return FRAM_OK;
}

fram_status file_close(file_writer *w, fram_error *error)
{
    if (!w->buffer)
        return FRAM_OK;
    fram_status status = file_flush(w, false, error);
    int descriptor = w->descriptor;
    w->descriptor = -1;
    /* After EINTR the descriptor is gone all the same; the data were handed over by write. */
    if (close(descriptor) != 0 && errno != EINTR && status == FRAM_OK)
        status = file_error(error, w->path, "close", errno);
    file_abandon(w);
    return status;
}

void file_abandon(file_writer *w)
{
    if (!w->ctx)
        return;
    if (w->descriptor >= 0)
        close(w->descriptor);
    memory_free(w->ctx, w->path);
    memory_free(w->ctx, w->temporary);
    memory_free(w->ctx, w->buffer);
    memset(w, 0, sizeof *w);
    w->descriptor = -1;
}
