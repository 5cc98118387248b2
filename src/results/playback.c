#include "results/playback.h"

#include "io/fill.h"
#include "io/record_layout.h"
#include "results/playback_chunks.h"
#include "results/playback_explained.h"
#include "results/run_record.h"

#include <errno.h>
#include <string.h>

enum { TEMPLATE_LIMIT = 16 << 20, CHUNK_BYTES = 6 << 20, CHUNK_LEAST = 1 << 14, SAMPLES = 12 };
static const uint64_t page_default = 50000000, total_default = 500000000;
/* Where the viewer's page takes the name of the folder with further frames, and the record. */
static const char beside_mark[] = "<!--BESIDE-->", record_mark[] = "<!--RECORD-->";

/* ---- which frames, and where ---- */

/* Bytes are those of blocks with their heads. */
typedef struct record_measure {
    int64_t frames;
    uint64_t frame_bytes, other_bytes; /* frames with the forces that belong to them; the rest */
} record_measure;

static bool belongs_to_frame(uint32_t type) { return record_is_frame(type) || type == BLOCK_FORCES; }

static fram_status measure_record(record_reader *r, record_measure *m, fram_error *error)
{
    record_block block;
    bool found = true;
    *m = (record_measure){0};
    while (true) {
        fram_status status = record_next(r, &block, &found, error);
        if (status == FRAM_OK && !found)
            record_tell_damage(r, "what comes before it is played");
        if (status == FRAM_OK && found)
            status = record_check_block(r->path, block.type, error);
        if (status != FRAM_OK || !found)
            return status;
        m->frames += record_is_frame(block.type);
        *(belongs_to_frame(block.type) ? &m->frame_bytes : &m->other_bytes) += r->position - block.offset;
    }
}

/* How a record goes into a page and files beside it. */
typedef struct playback_layout {
    int64_t stride; /* every n-th frame is kept */
    bool beside;    /* frames go into files but for samples */
    /* In the page stay this many pairs of frames spread over the run: the viewer takes the ends of its colours from
     * them. */
    int64_t samples;
    uint64_t chunk; /* bytes of blocks in one file */
} playback_layout;

/* Bytes before base64, which makes four of three. */
static uint64_t room_for(uint64_t limit, size_t page) { return limit > page ? (limit - page) / 4 * 3 : 0; }

static playback_layout lay_out(const record_measure *m, const playback_options *o, size_t page)
{
    uint64_t room = room_for(o->page_limit ? o->page_limit : page_default, page);
    uint64_t total = room_for(o->total_limit ? o->total_limit : total_default, page);
    playback_layout l = {.stride = 1, .samples = SAMPLES, .chunk = CHUNK_BYTES};
    while (m->other_bytes + m->frame_bytes / (uint64_t)l.stride > total && l.stride < m->frames)
        l.stride++;
    l.beside = m->other_bytes + m->frame_bytes / (uint64_t)l.stride > room;
    uint64_t free = room > m->other_bytes ? room - m->other_bytes : 0;
    uint64_t frame = m->frames > 0 ? m->frame_bytes / (uint64_t)m->frames : 0;
    while (l.samples > 1 && 2 * (uint64_t)l.samples * frame > free)
        l.samples /= 2;
    if (l.chunk > room / 2)
        l.chunk = room / 2 > CHUNK_LEAST ? room / 2 : CHUNK_LEAST;
    return l;
}

/* Whether kept frame `number` of `count` is one of the pairs that stay in the page: the first of each group, and the
 * one after it. */
static bool is_sample(const playback_layout *l, int64_t number, int64_t count)
{
    int64_t group = (count + l->samples - 1) / l->samples;
    return number % group < 2;
}

/* ---- the page ---- */

typedef struct page_writer {
    record_reader *r;
    FILE *from; /* the record: blocks are copied as they stand, so that their layout is written in one place only */
    const char *path;
    playback_layout layout;
    int64_t count;              /* frames that are kept in all */
    uint64_t forces, forces_to; /* forces that belong to the next frame: where they begin and end; 0: none */
    text_buffer explained;      /* blocks that stand in the page only */
    base64_writer page;
    chunk_writer chunks;
    playback_report *report;
} page_writer;

static fram_status copy_bytes(const page_writer *w, uint64_t offset, uint64_t end, base64_writer *to, fram_error *error)
{
    char buffer[16384];
    if (fseeko(w->from, (off_t)offset, SEEK_SET) != 0)
        return file_error(error, w->path, "read", errno);
    while (offset < end) {
        size_t want = end - offset < sizeof buffer ? (size_t)(end - offset) : sizeof buffer;
        if (fread(buffer, 1, want, w->from) != want)
            return error_set(error, FRAM_ERROR_IO, w->path, 0, NULL, "the record ended while it was read");
        fram_status status = base64_write(to, buffer, want, error);
        if (status != FRAM_OK)
            return status;
        offset += want;
    }
    return FRAM_OK;
}

static fram_status copy_frame(page_writer *w, const record_block *block, base64_writer *to, fram_error *error)
{
    fram_status status = copy_bytes(w, w->forces, w->forces_to, to, error);
    return status == FRAM_OK ? copy_bytes(w, block->offset, w->r->position, to, error) : status;
}

/* The frame into a file, and where it is and what stands at its front into the page. */
static fram_status put_beside(page_writer *w, const record_block *block, fram_error *error)
{
    unsigned char payload[2 * sizeof(int32_t) + FRAME_HEAD_SIZE], head[RECORD_BLOCK_HEAD];
    int32_t place[2];
    if (block->size < FRAME_HEAD_SIZE)
        return error_set(error, FRAM_ERROR_INPUT, w->path, 0, NULL, "damaged frame at byte %llu",
                         (unsigned long long)block->offset);
    memcpy(payload + sizeof place, block->data, FRAME_HEAD_SIZE);
    uint64_t size = w->forces_to - w->forces + w->r->position - block->offset;
    fram_status status = chunks_place(&w->chunks, size, &place[0], &place[1], error);
    if (status == FRAM_OK)
        status = copy_frame(w, block, &w->chunks.text, error);
    memcpy(payload, place, sizeof place);
    record_block_head(BLOCK_FRAME_BESIDE, payload, sizeof payload, head);
    if (status == FRAM_OK)
        status = base64_write(&w->page, head, sizeof head, error);
    return status == FRAM_OK ? base64_write(&w->page, payload, sizeof payload, error) : status;
}

static fram_status put_frame(page_writer *w, const record_block *block, int64_t seen, fram_error *error)
{
    fram_status status = FRAM_OK;
    if (seen % w->layout.stride == 0) {
        int64_t number = w->report->frames++;
        if (w->layout.beside && !is_sample(&w->layout, number, w->count))
            status = put_beside(w, block, error);
        else
            status = copy_frame(w, block, &w->page, error);
    } else {
        w->report->left_out++;
    }
    w->forces = w->forces_to = 0;
    return status;
}

static fram_status copy_record(page_writer *w, fram_error *error)
{
    record_block block;
    bool found = true;
    int64_t seen = 0;
    fram_status status = copy_bytes(w, 0, w->r->position, &w->page, error);
    while (status == FRAM_OK) {
        status = record_next(w->r, &block, &found, error);
        if (status != FRAM_OK || !found)
            break;
        if (record_is_frame(block.type)) {
            status = put_frame(w, &block, seen++, error);
        } else if (block.type == BLOCK_FORCES) {
            w->forces = block.offset;
            w->forces_to = w->r->position;
        } else {
            status = copy_bytes(w, block.offset, w->r->position, &w->page, error);
        }
    }
    if (status == FRAM_OK && w->explained.count > 0)
        status = base64_write(&w->page, w->explained.data, (size_t)w->explained.count, error);
    return status == FRAM_OK ? base64_end(&w->page, error) : status;
}

/* A name as it stands in a relative address and an attribute: bytes of other than plain ones as %XX. */
static fram_status write_address(file_writer *out, const char *name, fram_error *error)
{
    fram_status status = FRAM_OK;
    for (; *name && status == FRAM_OK; name++) {
        char code[4];
        bool plain = (*name >= '0' && *name <= '9') || (*name >= 'A' && *name <= 'Z') ||
                     (*name >= 'a' && *name <= 'z') || strchr("-_.~", *name);
        int length = snprintf(code, sizeof code, plain ? "%c" : "%%%02X", (unsigned char)*name);
        status = file_write(out, code, (size_t)length, error);
    }
    return status;
}

/* The viewer's page: what stands before, between and after its two marks. */
static fram_status write_page(page_writer *w, const char *page, size_t size, file_writer *out, fram_error *error)
{
    const char *beside = strstr(page, beside_mark), *hole = strstr(page, record_mark);
    const char *folder = strrchr(w->chunks.folder, '/');
    w->page = base64_begin(out);
    fram_status status = file_write(out, page, (size_t)(beside - page), error);
    if (status == FRAM_OK && w->layout.beside)
        status = write_address(out, folder ? folder + 1 : w->chunks.folder, error);
    const char *next = beside + sizeof beside_mark - 1;
    if (status == FRAM_OK)
        status = file_write(out, next, (size_t)(hole - next), error);
    if (status == FRAM_OK)
        status = copy_record(w, error);
    next = hole + sizeof record_mark - 1;
    return status == FRAM_OK ? file_write(out, next, (size_t)(page + size - next), error) : status;
}

static bool has_marks(const char *page)
{
    const char *beside = strstr(page, beside_mark);
    return beside && strstr(beside, record_mark);
}

static fram_status read_viewer(context *ctx, const char *path, char **page, size_t *size, fram_error *error)
{
    fram_status status = file_read(ctx, path, TEMPLATE_LIMIT, page, size, error);
    if (status != FRAM_OK || has_marks(*page))
        return status;
    memory_free(ctx, *page);
    return error_set(error, FRAM_ERROR_INPUT, path, 0, NULL, "this is no playback page: it lacks %s or %s", beside_mark,
                     record_mark);
}

fram_status playback_live_page(context *ctx, const char *viewer, const char *address, char **page, size_t *size,
                               fram_error *error)
{
    char *text = NULL;
    size_t length = 0;
    fram_status status = read_viewer(ctx, viewer, &text, &length, error);
    if (status != FRAM_OK)
        return status;
    const char *beside = strstr(text, beside_mark), *hole = strstr(text, record_mark);
    char *made = memory_array(ctx, length + strlen(address) + 1, 1);
    if (made) {
        const char *between = beside + sizeof beside_mark - 1, *after = hole + sizeof record_mark - 1;
        *size = (size_t)snprintf(made, length + strlen(address) + 1, "%.*s%s%.*s%s", (int)(beside - text), text,
                                 address, (int)(hole - between), between, after);
        *page = made;
    }
    memory_free(ctx, text);
    return made ? FRAM_OK : error_memory(error);
}

/* The files first: a page that is there has all that it asks for. */
static fram_status write_playback(context *ctx, page_writer *w, const playback_options *options, const char *page,
                                  size_t size, fram_error *error)
{
    atomic_file out;
    if (w->layout.beside && fill_is_stream(options->output))
        return error_set(error, FRAM_ERROR_USAGE, options->output, 0, "output",
                         "the frames are too many for one page, and a page that goes into a stream has no files beside "
                         "it: give the name of a file, or a larger limit of the page");
    fram_status status = chunks_begin(ctx, options->output, w->layout.chunk, &w->chunks, error);
    if (status == FRAM_OK)
        status = atomic_file_begin(ctx, options->output, &out, error);
    if (status != FRAM_OK)
        return status;
    status = write_page(w, page, size, &out.writer, error);
    if (status == FRAM_OK)
        status = chunks_commit(&w->chunks, error);
    w->report->files = w->chunks.count;
    if (status == FRAM_OK)
        return atomic_file_commit(&out, error);
    chunks_abandon(&w->chunks);
    atomic_file_abandon(&out);
    return status;
}

static fram_status write_record(context *ctx, record_reader *r, const char *path, const playback_options *options,
                                page_writer *w, fram_error *error)
{
    uint64_t first = r->position;
    record_measure m;
    char *page = NULL;
    size_t size = 0;
    fram_status status = measure_record(r, &m, error);
    if (status == FRAM_OK && m.frames == 0)
        status = record_refuse_frameless(r, error);
    if (status == FRAM_OK)
        status = read_viewer(ctx, options->viewer, &page, &size, error);
    if (status != FRAM_OK)
        return status;
    m.other_bytes += (uint64_t)w->explained.count;
    w->layout = lay_out(&m, options, size);
    w->count = (m.frames + w->layout.stride - 1) / w->layout.stride;
    w->from = fopen(path, "rb");
    record_seek(r, first);
    status = w->from ? write_playback(ctx, w, options, page, size, error) : file_error(error, path, "open", errno);
    if (w->from)
        fclose(w->from);
    memory_free(ctx, page);
    return status;
}

fram_status playback_write(context *ctx, const char *folder, const playback_options *options, playback_report *report,
                           fram_error *error)
{
    char path[PATH_ROOM], beside[PATH_ROOM];
    record_reader r;
    *report = (playback_report){0};
    /* Whether the folder is needed is known only when the record has been read. */
    fram_status status = chunks_folder(options->output, beside, error);
    if (status == FRAM_OK)
        status = run_record_open(ctx, folder, path, &r, error);
    if (status != FRAM_OK)
        return status;
    page_writer w = {.r = &r, .path = path, .report = report};
    status = playback_explain(ctx, folder, options->pressure, &w.explained, error);
    if (status == FRAM_OK)
        status = write_record(ctx, &r, path, options, &w, error);
    text_free(ctx, &w.explained);
    record_reader_close(&r);
    return status;
}
