#include "io/late_commit.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

static bool sync_one(late_commit *c, int descriptor, const char *path)
{
    if (file_sync(descriptor))
        return true;
    c->failed = errno;
    c->failed_path = path;
    c->attempt = "write to the disk";
    return false;
}

/* Calls of the system only: the context's memory and log belong to the thread of the run. */
static void commit_in_background(void *user)
{
    late_commit *c = user;
    for (int i = 0; i < c->stream_count; i++) {
        if (!sync_one(c, c->streams[i]->descriptor, c->streams[i]->path))
            return;
    }
    if (!sync_one(c, c->file.writer.descriptor, c->file.path))
        return;
    if (!c->file.direct && rename(c->file.writer.temporary, c->file.path) != 0) {
        c->failed = errno;
        c->failed_path = c->file.path;
        c->attempt = "replace";
        return;
    }
    (void)sync_one(c, c->folder, c->file.path);
}

/* The folder of the file's path, opened. */
static fram_status open_folder(late_commit *c, fram_error *error)
{
    char *slash = strrchr(c->file.path, '/');
    char *end = slash ? slash + 1 : NULL, kept = end ? *end : '\0';
    if (end)
        *end = '\0';
    c->folder = open(slash ? c->file.path : ".", O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    int reason = errno;
    if (end)
        *end = kept;
    return c->folder < 0 ? file_error(error, c->file.path, "open its folder", reason) : FRAM_OK;
}

fram_status late_commit_start(late_commit *c, atomic_file *file, file_writer *const *streams, int stream_count,
                              fram_error *error)
{
    *c = (late_commit){.file = *file, .stream_count = stream_count, .folder = -1};
    fram_status status = file_flush(&c->file.writer, false, error);
    for (int i = 0; i < stream_count && status == FRAM_OK; i++) {
        c->streams[i] = streams[i];
        status = file_flush(streams[i], false, error);
    }
    if (status == FRAM_OK)
        status = open_folder(c, error);
    if (status != FRAM_OK) {
        atomic_file_abandon(&c->file);
        return status;
    }
    c->pending = true;
    background_start(&c->thread, commit_in_background, c);
    return FRAM_OK;
}

fram_status late_commit_wait(late_commit *c, fram_error *error)
{
    fram_status status = FRAM_OK;
    if (!c->pending)
        return FRAM_OK;
    background_wait(&c->thread);
    c->pending = false;
    close(c->folder);
    if (c->failed)
        status = file_error(error, c->failed_path, c->attempt, c->failed);
    atomic_file_abandon(&c->file); /* closes; a file that was renamed is at its place */
    return status;
}
