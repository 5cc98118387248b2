/* The container of checkpoints.  Writing walks the content twice with the same code, once for size and checksum, once
   for the bytes; reading walks the file twice, once to check all of it and once to take it over, so that a bad file
   changes nothing. */
#include "io/table_file.h"
#include <string.h>

typedef struct table_file_head {
    char magic[8];
    uint32_t version, byte_order;
    uint64_t size;
    uint32_t body_crc, crc;
} table_file_head;

_Static_assert(sizeof(table_file_head) == 32, "the layout of table_file.h, without padding");

static const char file_magic[8] = {'F', 'R', 'A', 'M', 'T', 'A', 'B', '\n'};

static uint32_t head_crc(const table_file_head *h) { return file_crc(0, h, offsetof(table_file_head, crc)); }

/* ---- writing ---- */

/* Where the body goes: into a file, into memory, or (both NULL) only into size and checksum. */
typedef struct body_sink {
    file_writer *file;
    char *memory; /* where the next bytes go */
    uint64_t size;
    uint32_t crc;
    fram_status status;
    fram_error *error;
} body_sink;

static void put_data(body_sink *s, const void *data, size_t size)
{
    s->size += size;
    if (s->memory) {
        if (size > 0)
            memcpy(s->memory, data, size);
        s->memory += size;
    } else if (!s->file)
        s->crc = file_crc(s->crc, data, size);
    else if (s->status == FRAM_OK)
        s->status = file_write(s->file, data, size, s->error);
}

static void put_u32(body_sink *s, uint32_t value) { put_data(s, &value, sizeof value); }

static void put_u64(body_sink *s, uint64_t value) { put_data(s, &value, sizeof value); }

static void put_name(body_sink *s, const char *name)
{
    size_t length = strlen(name);
    put_u32(s, (uint32_t)length);
    put_data(s, name, length);
}

static void put_table(body_sink *s, const world_table *t)
{
    const table_head *rows = t->table;
    put_name(s, t->info->name);
    put_u32(s, (uint32_t)t->info->field_count);
    for (int f = 0; f < t->info->field_count; f++) {
        put_name(s, t->info->fields[f].name);
        put_u32(s, (uint32_t)t->info->fields[f].kind);
        put_u32(s, (uint32_t)t->info->fields[f].components);
    }
    put_data(s, &rows->count, sizeof rows->count);
    for (int f = 0; f < t->info->field_count; f++)
        put_data(s, table_field(t->table, &t->info->fields[f]), (size_t)rows->count * t->info->fields[f].size);
}

static void put_body(body_sink *s, const table_file *content)
{
    put_u32(s, (uint32_t)content->number_count);
    for (int32_t i = 0; i < content->number_count; i++) {
        put_name(s, content->numbers[i].name);
        put_u64(s, content->numbers[i].value);
    }
    put_u32(s, (uint32_t)content->bytes_count);
    for (int32_t i = 0; i < content->bytes_count; i++) {
        put_name(s, content->bytes[i].name);
        put_u64(s, content->bytes[i].size);
        put_data(s, content->bytes[i].data, content->bytes[i].size);
    }
    put_u32(s, (uint32_t)content->table_count);
    for (int32_t i = 0; i < content->table_count; i++)
        put_table(s, &content->tables[i]);
}

static table_file_head head_of(const table_file *content)
{
    body_sink measure = {.status = FRAM_OK};
    put_body(&measure, content);
    table_file_head head = {.version = TABLE_FILE_VERSION, .byte_order = FILE_BYTE_ORDER};
    memcpy(head.magic, file_magic, sizeof file_magic);
    head.size = sizeof head + measure.size;
    head.body_crc = measure.crc;
    head.crc = head_crc(&head);
    return head;
}

fram_status table_file_encode(context *ctx, const table_file *content, char **data, size_t *size, fram_error *error)
{
    table_file_head head = head_of(content);
    char *bytes = memory_resize(ctx, NULL, (size_t)head.size);
    if (!bytes)
        return error_memory(error);
    body_sink body = {.memory = bytes, .status = FRAM_OK};
    put_data(&body, &head, sizeof head);
    put_body(&body, content);
    *data = bytes;
    *size = (size_t)head.size;
    return FRAM_OK;
}

fram_status table_file_begin(context *ctx, const char *path, const table_file *content, atomic_file *file,
                             fram_error *error)
{
    table_file_head head = head_of(content);
    fram_status status = atomic_file_begin(ctx, path, file, error);
    if (status != FRAM_OK)
        return status;
    body_sink body = {.file = &file->writer, .status = FRAM_OK, .error = error};
    put_data(&body, &head, sizeof head);
    put_body(&body, content);
    if (body.status != FRAM_OK)
        atomic_file_abandon(file);
    return body.status;
}

/* ---- reading ---- */

/* What is left of the body.  Every take fails for good once one did. */
typedef struct body_source {
    context *ctx;
    const char *file;
    const unsigned char *at;
    size_t left;
    bool apply; /* second walk: write into the content */
    fram_status status;
    fram_error *error;
} body_source;

static void refuse_difference(body_source *s, const char *what, const char *name)
{
    if (s->status == FRAM_OK)
        s->status = error_set(s->error, FRAM_ERROR_INPUT, s->file, 0, NULL,
                              "expected a checkpoint of this version of Fram, found one of another, in which %s%s%s "
                              "is not the same: go on with the version that made it, or start the run again",
                              what, *name ? " " : "", name);
}

/* Bytes of the body, NULL when there are not so many. */
static const void *take_data(body_source *s, uint64_t size)
{
    if (s->status != FRAM_OK)
        return NULL;
    if (size > s->left) {
        s->status =
            error_set(s->error, FRAM_ERROR_INPUT, s->file, 0, NULL, "expected more bytes, found the end of the file");
        return NULL;
    }
    const void *data = s->at;
    s->at += size;
    s->left -= (size_t)size;
    return data;
}

static uint32_t take_u32(body_source *s)
{
    uint32_t value = 0;
    const void *data = take_data(s, sizeof value);
    if (data)
        memcpy(&value, data, sizeof value);
    return value;
}

static uint64_t take_u64(body_source *s)
{
    uint64_t value = 0;
    const void *data = take_data(s, sizeof value);
    if (data)
        memcpy(&value, data, sizeof value);
    return value;
}

static void take_name(body_source *s, const char *what, const char *name)
{
    uint32_t length = take_u32(s);
    const void *data = take_data(s, length);
    if (data && (length != strlen(name) || memcmp(data, name, length) != 0))
        refuse_difference(s, what, name);
}

static void take_count(body_source *s, const char *what, int32_t count)
{
    if (take_u32(s) != (uint32_t)count)
        refuse_difference(s, what, "");
}

static void take_bytes(body_source *s, table_file_bytes *bytes)
{
    take_name(s, "the byte string", bytes->name);
    uint64_t size = take_u64(s);
    const void *data = take_data(s, size);
    if (!data || !s->apply || size == 0)
        return;
    bytes->data = memory_resize(s->ctx, NULL, (size_t)size);
    if (!bytes->data) {
        s->status = error_memory(s->error);
        return;
    }
    bytes->size = (size_t)size;
    memcpy(bytes->data, data, bytes->size);
}

static void take_fields(body_source *s, const table_info *info)
{
    take_name(s, "the table", info->name);
    take_count(s, "the number of fields of a table", info->field_count);
    for (int f = 0; f < info->field_count; f++) {
        take_name(s, "the field", info->fields[f].name);
        uint32_t kind = take_u32(s), components = take_u32(s);
        if (kind != (uint32_t)info->fields[f].kind || components != (uint32_t)info->fields[f].components)
            refuse_difference(s, "the type of the field", info->fields[f].name);
    }
}

static void take_table(body_source *s, const world_table *t)
{
    take_fields(s, t->info);
    int32_t rows = 0;
    const void *count = take_data(s, sizeof rows);
    if (count)
        memcpy(&rows, count, sizeof rows);
    if (rows < 0)
        refuse_difference(s, "the number of rows of the table", t->info->name);
    /* The rows fit the file, as the first walk has seen: a hostile count cannot ask for more memory than that. */
    if (s->status == FRAM_OK && s->apply && !table_resize(s->ctx, t->table, t->info, rows))
        s->status = error_memory(s->error);
    if (s->apply)
        ((table_head *)t->table)->taken = 0;
    for (int f = 0; f < t->info->field_count && s->status == FRAM_OK; f++) {
        uint64_t size = (uint64_t)rows * t->info->fields[f].size;
        const void *data = take_data(s, size);
        if (data && s->apply && size > 0)
            memcpy(table_field(t->table, &t->info->fields[f]), data, (size_t)size);
    }
}

static fram_status take_body(body_source s, table_file *content)
{
    take_count(&s, "the count of numbers", content->number_count);
    for (int32_t i = 0; i < content->number_count; i++) {
        take_name(&s, "the number", content->numbers[i].name);
        uint64_t value = take_u64(&s);
        if (s.status == FRAM_OK && s.apply)
            content->numbers[i].value = value;
    }
    take_count(&s, "the count of byte strings", content->bytes_count);
    for (int32_t i = 0; i < content->bytes_count; i++)
        take_bytes(&s, &content->bytes[i]);
    take_count(&s, "the count of tables", content->table_count);
    for (int32_t i = 0; i < content->table_count; i++)
        take_table(&s, &content->tables[i]);
    if (s.left > 0)
        refuse_difference(&s, "the end of the file", "");
    return s.status;
}

static fram_status check_table_head(const char *name, const void *data, size_t size, fram_error *error)
{
    table_file_head head;
    if (size < sizeof head)
        return error_set(error, FRAM_ERROR_INPUT, name, 0, NULL,
                         "expected a checkpoint, found a file that is too short");
    memcpy(&head, data, sizeof head);
    if (memcmp(head.magic, file_magic, sizeof file_magic) != 0)
        return error_set(error, FRAM_ERROR_INPUT, name, 0, NULL, "expected a checkpoint, found another kind of file");
    if (head.byte_order == FILE_BYTE_ORDER_SWAPPED)
        return error_set(error, FRAM_ERROR_INPUT, name, 0, NULL,
                         "expected a checkpoint of this machine's byte order, found the other");
    if (head.byte_order != FILE_BYTE_ORDER || head.crc != head_crc(&head))
        return error_set(error, FRAM_ERROR_INPUT, name, 0, NULL,
                         "expected a checkpoint, found one with a damaged head");
    if (head.version != TABLE_FILE_VERSION)
        return error_set(
            error, FRAM_ERROR_INPUT, name, 0, NULL,
            "expected a checkpoint of version %d, found version %u: another version of Fram wrote it: go on with "
            "that one, or start the run again",
            TABLE_FILE_VERSION, head.version);
    if (head.size != size)
        return error_set(error, FRAM_ERROR_INPUT, name, 0, NULL, "expected a checkpoint of %llu bytes, found %zu",
                         (unsigned long long)head.size, size);
    if (head.body_crc != file_crc(0, (const char *)data + sizeof head, size - sizeof head))
        return error_set(error, FRAM_ERROR_INPUT, name, 0, NULL,
                         "expected a checkpoint, found a damaged one: its checksum does not fit");
    return FRAM_OK;
}

/* What a caller may have left in the place of the results. */
static void forget_bytes(table_file *content)
{
    for (int32_t i = 0; i < content->bytes_count; i++) {
        content->bytes[i].data = NULL;
        content->bytes[i].size = 0;
    }
}

fram_status table_file_decode(context *ctx, const char *name, const void *data, size_t size, table_file *content,
                              fram_error *error)
{
    forget_bytes(content);
    content->differs = false;
    fram_status status = check_table_head(name, data, size, error);
    if (status != FRAM_OK)
        return status;
    body_source body = {.ctx = ctx,
                        .file = name,
                        .at = (const unsigned char *)data + sizeof(table_file_head),
                        .left = size - sizeof(table_file_head),
                        .status = FRAM_OK,
                        .error = error};
    status = take_body(body, content);
    content->differs = status == FRAM_ERROR_INPUT;
    if (status != FRAM_OK)
        return status;
    body.apply = true;
    status = take_body(body, content);
    if (status != FRAM_OK)
        table_file_free_bytes(ctx, content);
    return status;
}

fram_status table_file_read(context *ctx, const char *path, table_file *content, fram_error *error)
{
    char *data;
    size_t size;
    forget_bytes(content);
    fram_status status = file_read(ctx, path, TABLE_FILE_BYTES_MOST, &data, &size, error);
    if (status != FRAM_OK)
        return status;
    status = table_file_decode(ctx, path, data, size, content, error);
    memory_free(ctx, data);
    return status;
}

void table_file_free_bytes(context *ctx, table_file *content)
{
    for (int32_t i = 0; i < content->bytes_count; i++)
        memory_free(ctx, content->bytes[i].data);
    forget_bytes(content);
}
