#include "sim/playback.h"

#include "io/atomic_file.h"
#include "io/base64.h"
#include "io/record.h"
#include "sim/recorder.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>

enum { PATH_SIZE = 1024, TEMPLATE_LIMIT = 16 << 20 };
static const char marker[] = "<!--RECORD-->";

/* ---- which frames ---- */

/* Walks the record once: its frames, and the bytes of frames and of the rest. */
typedef struct record_measure {
    int64_t frames;
    uint64_t frame_bytes, other_bytes;
} record_measure;

enum { BLOCK_OVERHEAD = 32 };

static fram_status measure(record_reader *r, record_measure *m, fram_error *error)
{
    record_block block;
    bool found = true;
    *m = (record_measure){0};
    while (true) {
        fram_status status = record_next(r, &block, &found, error);
        if (status != FRAM_OK || !found)
            return status;
        if (block.type == BLOCK_FRAME) {
            m->frames++;
            m->frame_bytes += block.size + BLOCK_OVERHEAD;
        } else {
            m->other_bytes += block.size + BLOCK_OVERHEAD;
        }
    }
}

/* Keep every n-th frame. */
static int64_t frame_stride(const record_measure *m)
{
    int64_t stride = 1;
    while (m->other_bytes + m->frame_bytes / (uint64_t)stride > PLAYBACK_LIMIT && stride < m->frames)
        stride++;
    return stride;
}

/* ---- the page ---- */

/* A block as it stands in a record file: head, payload, padding.  Read back from the file, so that the layout is
   written in one place only. */
static fram_status copy_bytes(FILE *from, uint64_t offset, uint64_t size, base64_writer *to, const char *path,
                              fram_error *error)
{
    char buffer[16384];
    if (fseek(from, (long)offset, SEEK_SET) != 0)
        return file_error(error, path, "read", errno);
    while (size > 0) {
        size_t want = size < sizeof buffer ? (size_t)size : sizeof buffer;
        if (fread(buffer, 1, want, from) != want)
            return error_set(error, FRAM_ERROR_IO, path, 0, NULL, "the record ended while it was read");
        fram_status status = base64_write(to, buffer, want, error);
        if (status != FRAM_OK)
            return status;
        size -= want;
    }
    return FRAM_OK;
}

/* The record's head, then every block but the frames that are left out. */
static fram_status copy_record(record_reader *r, FILE *from, const char *path, int64_t stride, base64_writer *to,
                               int64_t *frames, fram_error *error)
{
    record_block block;
    bool found = true;
    int64_t seen = 0;
    uint64_t head = r->position;
    fram_status status = copy_bytes(from, 0, head, to, path, error);
    *frames = 0;
    while (status == FRAM_OK) {
        status = record_next(r, &block, &found, error);
        if (status != FRAM_OK || !found)
            break;
        if (block.type == BLOCK_FRAME && seen++ % stride != 0)
            continue;
        *frames += block.type == BLOCK_FRAME;
        status = copy_bytes(from, block.offset, r->position - block.offset, to, path, error);
    }
    return status == FRAM_OK ? base64_end(to, error) : status;
}

static fram_status write_page(record_reader *r, const char *path, int64_t stride, const char *page, size_t size,
                              atomic_file *out, int64_t *frames, fram_error *error)
{
    const char *hole = strstr(page, marker);
    FILE *from = fopen(path, "rb");
    if (!from)
        return file_error(error, path, "open", errno);
    base64_writer to = {.file = &out->writer};
    fram_status status = file_write(&out->writer, page, (size_t)(hole - page), error);
    if (status == FRAM_OK)
        status = copy_record(r, from, path, stride, &to, frames, error);
    fclose(from);
    const char *after = hole + sizeof marker - 1;
    return status == FRAM_OK ? file_write(&out->writer, after, (size_t)(page + size - after), error) : status;
}

static fram_status read_template(context *ctx, const char *path, char **page, size_t *size, fram_error *error)
{
    fram_status status = file_read(ctx, path, TEMPLATE_LIMIT, page, size, error);
    if (status != FRAM_OK || strstr(*page, marker))
        return status;
    memory_free(ctx, *page);
    return error_set(error, FRAM_ERROR_INPUT, path, 0, NULL, "this is no playback page: it lacks %s", marker);
}

fram_status playback_write(context *ctx, const char *folder, const char *template, const char *output, int64_t *frames,
                           int64_t *left_out, fram_error *error)
{
    char path[PATH_SIZE];
    int n = snprintf(path, sizeof path, "%s/record.fram", folder);
    if (n < 0 || n >= PATH_SIZE)
        return error_set(error, FRAM_ERROR_INPUT, folder, 0, NULL, "the folder's name is too long");
    char *page = NULL;
    size_t size = 0;
    fram_status status = read_template(ctx, template, &page, &size, error);
    if (status != FRAM_OK)
        return status;
    record_reader r;
    record_measure m = {0};
    status = record_open(ctx, path, &r, error);
    if (status == FRAM_OK) {
        uint64_t first = r.position;
        status = measure(&r, &m, error);
        if (status == FRAM_OK && m.frames == 0)
            status = error_set(error, FRAM_ERROR_INPUT, path, 0, NULL,
                               "the record holds no frame; give the scenario an output.frame_interval above 0");
        atomic_file out;
        if (status == FRAM_OK)
            status = atomic_file_begin(ctx, output, &out, error);
        if (status == FRAM_OK) {
            record_seek(&r, first);
            status = write_page(&r, path, frame_stride(&m), page, size, &out, frames, error);
            if (status == FRAM_OK)
                status = atomic_file_commit(&out, error);
            else
                atomic_file_abandon(&out);
        }
        *left_out = m.frames - *frames;
        record_reader_close(&r);
    }
    memory_free(ctx, page);
    return status;
}
