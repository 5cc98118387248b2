/* Framed blocks: written through a buffer, read with every checksum looked at before anything is believed. */
#include "io/record.h"
#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

typedef struct record_head {
    char magic[8];
    uint32_t version, byte_order, zero, crc;
} record_head;

typedef struct block_head {
    char magic[4];
    uint32_t type;
    uint64_t length;
    uint32_t payload_crc, crc;
} block_head;

_Static_assert(sizeof(record_head) == 24 && sizeof(block_head) == 24, "the layout of record.h, without padding");

static const char record_magic[8] = {'F', 'R', 'A', 'M', 'R', 'E', 'C', '\n'};
static const char block_magic[4] = {'B', 'L', 'K', '\n'};

static uint32_t record_head_crc(const record_head *h) { return file_crc(0, h, offsetof(record_head, crc)); }

static uint32_t block_head_crc(const block_head *h) { return file_crc(0, h, offsetof(block_head, crc)); }

/* Zeros after a payload. */
static size_t padding_of(uint64_t length) { return (size_t)((8 - length % 8) % 8); }

static fram_status refuse_record(fram_error *error, const char *path, const char *reason)
{
    return error_set(error, FRAM_ERROR_INPUT, path, 0, NULL, "%s", reason);
}

static fram_status check_record_head(int descriptor, const char *path, uint64_t file_size, fram_error *error)
{
    record_head head;
    if (file_size < sizeof head)
        return refuse_record(error, path, "expected a record, found a file that is too short");
    fram_status status = file_read_at(descriptor, path, 0, &head, sizeof head, error);
    if (status != FRAM_OK)
        return status;
    if (memcmp(head.magic, record_magic, sizeof record_magic) != 0)
        return refuse_record(error, path, "expected a record, found another kind of file");
    if (head.byte_order == FILE_BYTE_ORDER_SWAPPED)
        return refuse_record(error, path, "expected a record of this machine's byte order, found the other");
    if (head.byte_order != FILE_BYTE_ORDER || head.crc != record_head_crc(&head))
        return refuse_record(error, path, "expected a record, found one with a damaged head");
    if (head.version != RECORD_VERSION)
        return error_set(
            error, FRAM_ERROR_INPUT, path, 0, NULL,
            "expected a record of version %d, found version %u: another version of Fram wrote it: read it with that "
            "one, or run the scenario again",
            RECORD_VERSION, head.version);
    return FRAM_OK;
}

/* The head of the block at `offset`: false with the reason when it is damaged or the block goes over the end. */
static bool block_is_sound(const block_head *head, uint64_t offset, uint64_t file_size, char *reason, size_t size)
{
    if (memcmp(head->magic, block_magic, sizeof block_magic) != 0 || head->crc != block_head_crc(head)) {
        snprintf(reason, size, "damaged head of the block at byte %llu", (unsigned long long)offset);
        return false;
    }
    uint64_t left = file_size - offset - sizeof *head;
    if (head->length > left || padding_of(head->length) > left - head->length) {
        snprintf(reason, size, "unfinished block at byte %llu: %llu bytes expected, %llu found",
                 (unsigned long long)offset, (unsigned long long)head->length, (unsigned long long)left);
        return false;
    }
    return true;
}

/* ---- writing ---- */

static fram_status write_head(record_writer *w, fram_error *error)
{
    record_head head = {.version = RECORD_VERSION, .byte_order = FILE_BYTE_ORDER};
    memcpy(head.magic, record_magic, sizeof record_magic);
    head.crc = record_head_crc(&head);
    return file_write(&w->file.writer, &head, sizeof head, error);
}

fram_status record_create(context *ctx, const char *path, record_writer *w, fram_error *error)
{
    fram_status status = file_create(ctx, path, &w->file.writer, error);
    if (status != FRAM_OK)
        return status;
    status = write_head(w, error);
    if (status != FRAM_OK)
        file_abandon(&w->file.writer);
    return status;
}

fram_status record_create_beside(context *ctx, const char *path, record_writer *w, fram_error *error)
{
    fram_status status = atomic_file_begin_over(ctx, path, &w->file, error);
    if (status != FRAM_OK)
        return status;
    status = write_head(w, error);
    return status == FRAM_OK ? FRAM_OK : record_place(w, status, error);
}

/* That a block ends at `length`: heads are followed from the first block on. */
static fram_status check_length(const file_writer *file, uint64_t length, fram_error *error)
{
    uint64_t at = sizeof(record_head);
    char reason[120];
    if (length > file->length)
        return error_set(error, FRAM_ERROR_INPUT, file->path, 0, NULL, "expected at least %llu bytes, found %llu",
                         (unsigned long long)length, (unsigned long long)file->length);
    while (at < length) {
        block_head head;
        if (length - at < sizeof head)
            break;
        fram_status status = file_read_at(file->descriptor, file->path, at, &head, sizeof head, error);
        if (status != FRAM_OK)
            return status;
        if (!block_is_sound(&head, at, length, reason, sizeof reason))
            return refuse_record(error, file->path, reason);
        at += sizeof head + head.length + padding_of(head.length);
    }
    if (at == length)
        return FRAM_OK;
    return error_set(error, FRAM_ERROR_INPUT, file->path, 0, NULL,
                     "expected the end of a block at byte %llu, found none", (unsigned long long)length);
}

fram_status record_continue(context *ctx, const char *path, uint64_t length, record_writer *w, fram_error *error)
{
    file_writer *file = &w->file.writer;
    fram_status status = file_open(ctx, path, file, error);
    if (status != FRAM_OK)
        return status;
    status = check_record_head(file->descriptor, path, file->length, error);
    if (status == FRAM_OK)
        status = check_length(file, length, error);
    if (status != FRAM_OK)
        file_abandon(file);
    return status;
}

void record_block_head(uint32_t type, const void *payload, size_t size, unsigned char head[RECORD_BLOCK_HEAD])
{
    block_head h = {.type = type, .length = size, .payload_crc = file_crc(0, payload, size)};
    memcpy(h.magic, block_magic, sizeof block_magic);
    h.crc = block_head_crc(&h);
    memcpy(head, &h, sizeof h);
}

fram_status record_append(record_writer *w, uint32_t type, const record_part *parts, int32_t count, fram_error *error)
{
    static const char zeros[8] = {0};
    block_head head = {.type = type};
    memcpy(head.magic, block_magic, sizeof block_magic);
    for (int32_t i = 0; i < count; i++) {
        head.length += parts[i].size;
        if (parts[i].size > 0)
            head.payload_crc = file_crc(head.payload_crc, parts[i].data, parts[i].size);
    }
    head.crc = block_head_crc(&head);
    fram_status status = file_write(&w->file.writer, &head, sizeof head, error);
    for (int32_t i = 0; i < count && status == FRAM_OK; i++)
        status = file_write(&w->file.writer, parts[i].data, parts[i].size, error);
    if (status == FRAM_OK)
        status = file_write(&w->file.writer, zeros, padding_of(head.length), error);
    return status;
}

fram_status record_flush(record_writer *w, bool sync, fram_error *error)
{
    return file_flush(&w->file.writer, sync, error);
}

uint64_t record_length(const record_writer *w) { return w->file.writer.length; }

fram_status record_close(record_writer *w, fram_error *error) { return file_close(&w->file.writer, error); }

fram_status record_place(record_writer *w, fram_status written, fram_error *error)
{
    if (written == FRAM_OK)
        return atomic_file_place(&w->file, error);
    atomic_file_abandon(&w->file);
    return written;
}

/* ---- reading ---- */

/* A record may still be growing. */
static fram_status look_at_size(record_reader *r, fram_error *error)
{
    struct stat about;
    if (fstat(r->descriptor, &about) != 0)
        return file_error(error, r->path, "read", errno);
    r->file_size = (uint64_t)about.st_size;
    return FRAM_OK;
}

fram_status record_open(context *ctx, const char *path, record_reader *r, fram_error *error)
{
    memset(r, 0, sizeof *r);
    r->ctx = ctx;
    r->descriptor = -1;
    r->path = memory_string(ctx, path);
    fram_status status = r->path ? FRAM_OK : error_memory(error);
    if (status == FRAM_OK) {
        status = file_open_regular(path, RECORD_BYTES_MOST, &r->descriptor, &r->file_size, error);
    }
    if (status == FRAM_OK)
        status = check_record_head(r->descriptor, path, r->file_size, error);
    if (status != FRAM_OK)
        record_reader_close(r);
    r->position = sizeof(record_head);
    return status;
}

/* The payload and its padding into the reader's memory; damage is set when it is not what was written. */
static fram_status read_payload(record_reader *r, const block_head *head, fram_error *error)
{
    size_t length = (size_t)head->length, padding = padding_of(head->length), size = length + padding;
    if (size > r->capacity) {
        void *larger = memory_resize(r->ctx, r->payload, size);
        if (!larger)
            return error_memory(error);
        r->payload = larger;
        r->capacity = size;
    }
    fram_status status = file_read_at(r->descriptor, r->path, r->position + sizeof *head, r->payload, size, error);
    if (status != FRAM_OK)
        return status;
    static const char zeros[8] = {0};
    bool sound = file_crc(0, r->payload, length) == head->payload_crc;
    /* An empty payload may be NULL, which has no place behind it. */
    if (!sound || (padding > 0 && memcmp((const char *)r->payload + length, zeros, padding) != 0))
        snprintf(r->damage, sizeof r->damage, "damaged block at byte %llu: its checksum does not fit",
                 (unsigned long long)r->position);
    return FRAM_OK;
}

fram_status record_next(record_reader *r, record_block *block, bool *found, fram_error *error)
{
    *found = false;
    r->damage[0] = '\0';
    fram_status status = look_at_size(r, error);
    if (status != FRAM_OK || r->position == r->file_size)
        return status;
    block_head head;
    if (r->position > r->file_size || r->file_size - r->position < sizeof head) {
        snprintf(r->damage, sizeof r->damage, "unfinished head of the block at byte %llu",
                 (unsigned long long)r->position);
        return FRAM_OK;
    }
    status = file_read_at(r->descriptor, r->path, r->position, &head, sizeof head, error);
    if (status != FRAM_OK || !block_is_sound(&head, r->position, r->file_size, r->damage, sizeof r->damage))
        return status;
    if (head.length > SIZE_MAX - 8)
        return error_memory(error);
    status = read_payload(r, &head, error);
    if (status != FRAM_OK || r->damage[0])
        return status;
    *block = (record_block){head.type, r->position, (size_t)head.length, r->payload};
    r->position += sizeof head + head.length + padding_of(head.length);
    *found = true;
    return FRAM_OK;
}

void record_tell_damage(const record_reader *r, const char *consequence)
{
    if (r->damage[0])
        log_write(r->ctx, LOG_WARNING, "%s: %s; %s", r->path, r->damage, consequence);
}

fram_status record_refuse_frameless(const record_reader *r, fram_error *error)
{
    return error_set(error, FRAM_ERROR_INPUT, r->path, 0, NULL,
                     r->damage[0]
                         ? "the record holds no whole frame before what is damaged or unfinished: wait where the "
                           "run goes on, or run the scenario again"
                         : "the record holds no frame: there is one each output.frame_interval, none if that is "
                           "0; shorten it, or record for longer");
}

void record_seek(record_reader *r, uint64_t offset) { r->position = offset; }

void record_reader_close(record_reader *r)
{
    if (!r->ctx)
        return;
    if (r->descriptor >= 0)
        close(r->descriptor);
    memory_free(r->ctx, r->path);
    memory_free(r->ctx, r->payload);
    memset(r, 0, sizeof *r);
    r->descriptor = -1;
}
