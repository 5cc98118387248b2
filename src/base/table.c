/* Memory of state tables and what walks their fields.  Knows descriptors, never a particular table. */
#include "base/table.h"
#include "base/hash.h"

#include <assert.h>
#include <string.h>

/* All fields of a table lie in one block, each from a cache line on, one line apart so that equal rows of different
   fields do not all fall into the same cache set.  The block's own address stands just below the first field. */
enum { FIELD_ALIGNMENT = 64, ROW_MULTIPLE = 8 };

size_t field_kind_size(field_kind kind) { return FIELD_KIND_SIZE(kind); }

/* Field pointers have many types and are moved as bytes, so that no rule of aliasing is bent. */
void *table_field(const void *table, const field_info *field)
{
    void *data;
    memcpy(&data, (const char *)table + field->offset, sizeof data);
    return data;
}

static void field_point(void *table, const field_info *field, void *data)
{
    memcpy((char *)table + field->offset, &data, sizeof data);
}

#ifndef NDEBUG
/* Rows fit the room that there is, and each field has its own place for them, on a cache line. */
static bool table_is_sound(const void *table, const table_info *info)
{
    const table_head *head = table;
    bool good = head->count >= 0 && head->count <= head->capacity && head->capacity % ROW_MULTIPLE == 0;
    for (int f = 0; f < info->field_count && good && head->capacity > 0; f++) {
        const void *data = table_field(table, &info->fields[f]);
        good = data && (uintptr_t)data % FIELD_ALIGNMENT == 0;
    }
    return good;
}
#endif

/* Bytes of one field of `capacity` rows, with what separates it from the next. */
static uint64_t field_span(const field_info *field, int32_t capacity)
{
    uint64_t bytes = (uint64_t)capacity * field->size + FIELD_ALIGNMENT;
    return (bytes + FIELD_ALIGNMENT - 1) / FIELD_ALIGNMENT * FIELD_ALIGNMENT;
}

void *table_block(const void *table, const table_info *info)
{
    const table_head *head = table;
    if (head->capacity == 0 || info->field_count == 0)
        return NULL;
    void *block;
    memcpy(&block, (const char *)table_field(table, &info->fields[0]) - sizeof block, sizeof block);
    return block;
}

/* At least `rows` and half as much again as before; always whole groups of 8 rows. */
static int32_t capacity_for(int32_t rows, int32_t capacity)
{
    int64_t grown = (int64_t)capacity + capacity / 2;
    if (grown < rows)
        grown = rows;
    grown = (grown + ROW_MULTIPLE - 1) / ROW_MULTIPLE * ROW_MULTIPLE;
    return grown <= INT32_MAX ? (int32_t)grown : INT32_MAX / ROW_MULTIPLE * ROW_MULTIPLE;
}

bool table_reserve(context *ctx, void *table, const table_info *info, int32_t rows)
{
    table_head *head = table;
    assert(table_is_sound(table, info));
    if (rows <= head->capacity)
        return true;
    int32_t capacity = capacity_for(rows, head->capacity);
    uint64_t bytes = FIELD_ALIGNMENT + sizeof(void *);
    for (int f = 0; f < info->field_count; f++)
        bytes += field_span(&info->fields[f], capacity);
    if (capacity < rows || bytes > SIZE_MAX)
        return false;
    void *block = memory_array(ctx, 1, (size_t)bytes);
    if (!block)
        return false;
    uintptr_t start = (uintptr_t)block + sizeof block;
    char *data = (char *)block + sizeof block + (FIELD_ALIGNMENT - start % FIELD_ALIGNMENT) % FIELD_ALIGNMENT;
    void *old = table_block(table, info);
    memcpy(data - sizeof block, &block, sizeof block);
    for (int f = 0; f < info->field_count; f++) {
        const field_info *field = &info->fields[f];
        if (head->count > 0)
            memcpy(data, table_field(table, field), (size_t)head->count * field->size);
        field_point(table, field, data);
        data += field_span(field, capacity);
    }
    memory_free(ctx, old);
    head->capacity = capacity;
    assert(table_is_sound(table, info));
    return true;
}

bool table_resize(context *ctx, void *table, const table_info *info, int32_t rows)
{
    table_head *head = table;
    assert(rows >= 0);
    if (!table_reserve(ctx, table, info, rows))
        return false;
    for (int f = 0; f < info->field_count && rows > head->count; f++) {
        const field_info *field = &info->fields[f];
        char *data = table_field(table, field);
        memset(data + (size_t)head->count * field->size, 0, (size_t)(rows - head->count) * field->size);
    }
    head->count = rows;
    if (rows < head->taken)
        head->taken = rows;
    return true;
}

void table_free(context *ctx, void *table, const table_info *info)
{
    table_head *head = table;
    memory_free(ctx, table_block(table, info));
    for (int f = 0; f < info->field_count; f++)
        field_point(table, &info->fields[f], NULL);
    head->count = head->capacity = head->taken = 0;
}

uint64_t table_hash(const void *table, const table_info *info, uint64_t seed)
{
    const table_head *head = table;
    assert(table_is_sound(table, info));
    uint64_t hash = hash_bytes(&head->count, sizeof head->count, seed);
    for (int f = 0; f < info->field_count; f++) {
        const field_info *field = &info->fields[f];
        hash = hash_bytes(table_field(table, field), (size_t)head->count * field->size, hash);
    }
    return hash;
}

bool table_copy(context *ctx, void *dst, const void *src, const table_info *info)
{
    const table_head *from = src;
    table_head *to = dst;
    assert(table_is_sound(src, info));
    if (dst == src)
        return true;
    if (!table_reserve(ctx, dst, info, from->count))
        return false;
    for (int f = 0; f < info->field_count && from->count > 0; f++) {
        const field_info *field = &info->fields[f];
        memcpy(table_field(dst, field), table_field(src, field), (size_t)from->count * field->size);
    }
    to->count = from->count;
    to->taken = from->taken;
    return true;
}

void table_row_taken(void *table, int32_t row)
{
    table_head *head = table;
    assert(row >= head->taken && row < head->count);
    head->taken = row + 1;
}

void table_row_freed(void *table, int32_t row)
{
    table_head *head = table;
    assert(row >= 0 && row < head->count);
    if (row < head->taken)
        head->taken = row;
}

int32_t table_first_zero(const void *table, const uint8_t *column)
{
    const table_head *head = table;
    assert(head->taken == 0 || !memchr(column, 0, (size_t)head->taken));
    if (head->taken >= head->count)
        return head->count;
    const uint8_t *zero = memchr(column + head->taken, 0, (size_t)(head->count - head->taken));
    return zero ? (int32_t)(zero - column) : head->count;
}

void table_move_row(void *table, const table_info *info, int32_t to, int32_t from)
{
    assert(to >= 0 && from >= 0 && to < ((const table_head *)table)->capacity);
    assert(from < ((const table_head *)table)->capacity);
    for (int f = 0; f < info->field_count && to != from; f++) {
        const field_info *field = &info->fields[f];
        char *data = table_field(table, field);
        memcpy(data + (size_t)to * field->size, data + (size_t)from * field->size, field->size);
    }
}
