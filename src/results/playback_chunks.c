#include "results/playback_chunks.h"

#include "io/folder.h"
#include "io/temporary.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

enum { NAME_SIZE = PATH_ROOM + 64 };
enum { TRIES_MOST = 100 };
static const char ending[] = ".html", suffix[] = "-frames";

static void chunk_name(const char *folder, int32_t number, char out[NAME_SIZE])
{
    snprintf(out, NAME_SIZE, "%s/%04d.js", folder, (int)number);
}

/* "0012.js" */
static bool is_chunk(const char *name) { return name_is_numbered(name, "", 4, ".js"); }

/* The folder's files, be some of them missing, then the folder, if nothing else is in it. */
static void remove_chunks(const char *folder)
{
    folder_remove_files(folder, is_chunk);
    (void)rmdir(folder);
}

/* Files of another kind would stop the folder from being replaced in the end: they are told before the work. */
static fram_status refuse_foreign(const char *folder, fram_error *error)
{
    DIR *dir = folder_open_own(folder);
    char other[64] = "";
    if (!dir)
        return folder_refuse_other(folder, error);
    int failure = 0;
    for (const char *name = folder_next(dir, &failure); name && !other[0]; name = folder_next(dir, &failure)) {
        if (!is_chunk(name))
            snprintf(other, sizeof other, "%.60s", name);
    }
    closedir(dir);
    if (failure)
        return file_error(error, folder, "list the folder", failure);
    if (other[0])
        return error_set(error, FRAM_ERROR_INPUT, folder, 0, NULL,
                         "the frames of the page go into this folder, where %s is: move that away, or give the page "
                         "another name",
                         other);
    return FRAM_OK;
}

fram_status chunks_folder(const char *output, char out[PATH_ROOM], fram_error *error)
{
    size_t length = strlen(output), end = sizeof ending - 1;
    fram_status status = path_refuse_long(output, output, error);
    if (status != FRAM_OK)
        return status;
    if (length > end && strcmp(output + length - end, ending) == 0)
        length -= end;
    if (length + sizeof suffix > PATH_ROOM)
        return error_set(error, FRAM_ERROR_INPUT, output, 0, NULL, "the page's name is too long");
    memcpy(out, output, length);
    memcpy(out + length, suffix, sizeof suffix);
    return path_refuse_long(output, out, error);
}

fram_status chunks_begin(context *ctx, const char *output, uint64_t limit, chunk_writer *w, fram_error *error)
{
    *w = (chunk_writer){.ctx = ctx, .limit = limit};
    return chunks_folder(output, w->folder, error);
}

static fram_status close_chunk(chunk_writer *w, fram_error *error)
{
    static const char tail[] = "\");\n";
    if (!w->open)
        return FRAM_OK;
    fram_status status = base64_end(&w->text, error);
    if (status == FRAM_OK)
        status = file_write(&w->file.writer, tail, sizeof tail - 1, error);
    w->open = false;
    if (status == FRAM_OK)
        return atomic_file_commit(&w->file, error);
    atomic_file_abandon(&w->file);
    return status;
}

static fram_status open_chunk(chunk_writer *w, fram_error *error)
{
    char name[NAME_SIZE], head[40];
    fram_status status = w->count == 0 ? refuse_foreign(w->folder, error) : FRAM_OK;
    if (status == FRAM_OK && !w->stage)
        status = temporary_folder(w->ctx, w->folder, &w->stage, error);
    if (status != FRAM_OK)
        return status;
    chunk_name(w->stage, w->count, name);
    status = atomic_file_begin(w->ctx, name, &w->file, error);
    if (status != FRAM_OK)
        return status;
    w->open = true;
    w->filled = 0;
    chunk_name(w->folder, w->count, name);
    status = file_tell_as(&w->file.writer, name, error);
    if (status != FRAM_OK)
        return status;
    w->text = base64_begin(&w->file.writer);
    int length = snprintf(head, sizeof head, "framChunk(%d,\"", (int)w->count++);
    return file_write(&w->file.writer, head, (size_t)length, error);
}

fram_status chunks_place(chunk_writer *w, uint64_t size, int32_t *chunk, int32_t *offset, fram_error *error)
{
    fram_status status = FRAM_OK;
    if (w->open && w->filled + size > w->limit)
        status = close_chunk(w, error);
    if (status == FRAM_OK && !w->open)
        status = open_chunk(w, error);
    *chunk = w->count - 1;
    *offset = (int32_t)w->filled;
    w->filled += size;
    return status;
}

fram_status chunks_commit(chunk_writer *w, fram_error *error)
{
    fram_status status = close_chunk(w, error);
    if (status != FRAM_OK)
        return status;
    int failure = ENOTEMPTY;
    /* Another program may put its own frames there in between: the last one's stay. */
    for (int i = 0; i < TRIES_MOST && (failure == ENOTEMPTY || failure == EEXIST); i++) {
        remove_chunks(w->folder);
        failure = !w->stage || rename(w->stage, w->folder) == 0 ? 0 : errno;
    }
    if (failure != 0)
        return file_error(error, w->folder, "write the folder", failure);
    memory_free(w->ctx, w->stage);
    w->stage = NULL;
    return FRAM_OK;
}

void chunks_abandon(chunk_writer *w)
{
    if (w->open)
        atomic_file_abandon(&w->file);
    w->open = false;
    if (w->stage)
        remove_chunks(w->stage);
    memory_free(w->ctx, w->stage);
    w->stage = NULL;
}
