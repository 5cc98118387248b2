/* State tables: structures of arrays whose fields are declared once.

   A room declares its state as an X-macro of fields
       #define BODY_FIELDS(X) \
           X(position, vec3, FIELD_F64, 3, "m", "centre of mass, global frame") ...
   and TABLE_DECLARE(body, BODY_FIELDS) makes `body_table`, a struct of `count`, `capacity` and one pointer
   per field, and the descriptor `body_table_info` (TABLE_DEFINE in one .c file).  Hash, checkpoint, diff,
   resize and output columns walk the descriptor; nobody writes a field list a second time.

   Fields hold plain numbers (no pointers, no padding): kind and components describe all bytes.  A table starts
   as {0} and may be moved by assignment; its field pointers must not be exchanged one by one, because all
   fields share one block of memory.  Every field starts on a cache line (64 bytes), and the capacity is a multiple
   of 8 rows, so that the last group of 8 can be loaded whole; rows from count on have no meaning.

   Some tables use rows again, the lowest free one first, so that results depend on the order of events only.  For them
   a table knows below which row none is free: no state, but what it is costs a search of all rows to find out. */
#ifndef BASE_TABLE_H
#define BASE_TABLE_H

#include "base/context.h"

typedef enum field_kind { FIELD_F64, FIELD_I32, FIELD_U32, FIELD_I64, FIELD_U64, FIELD_U8 } field_kind;

/* Bytes of one number of a kind, as a constant. */
#define FIELD_KIND_SIZE(kind) \
    ((kind) == FIELD_U8 ? (size_t)1 : (kind) == FIELD_I32 || (kind) == FIELD_U32 ? (size_t)4 : (size_t)8)

typedef struct field_info {
    const char *name;
    const char *unit;
    const char *meaning;
    field_kind kind;
    int components; /* numbers per row */
    size_t size;    /* bytes per row */
    size_t offset;  /* of the pointer inside the table struct */
} field_info;

typedef struct table_info {
    const char *name;
    int field_count;
    const field_info *fields;
} table_info;

/* What every table begins with. */
typedef struct table_head {
    int32_t count, capacity;
    int32_t taken; /* no row below it is free; whoever writes rows by other ways than those here makes it 0 */
} table_head;

#define TABLE_FIELD_POINTER(name, ctype, kind, components, unit, meaning) ctype *name;
#define TABLE_DECLARE(noun, FIELDS) \
    typedef struct noun##_table {   \
        int32_t count, capacity;    \
        int32_t taken;              \
        FIELDS(TABLE_FIELD_POINTER) \
    } noun##_table;                 \
    extern const table_info noun##_table_info;

/* TABLE_DEFINE needs the struct's own name inside the field list, hence TABLE_SELF:
       #define TABLE_SELF body_table
       TABLE_DEFINE(body, BODY_FIELDS)
       #undef TABLE_SELF */
#define TABLE_FIELD_INFO(name, ctype, kind, components, unit, meaning) \
    {#name, unit, meaning, kind, components, sizeof(ctype), offsetof(TABLE_SELF, name)},
#define TABLE_FIELD_CHECK(name, ctype, kind, components, unit, meaning) \
    _Static_assert(sizeof(ctype) == (components)*FIELD_KIND_SIZE(kind), "kind and components of " #name);
#define TABLE_DEFINE(noun, FIELDS)                                                                            \
    FIELDS(TABLE_FIELD_CHECK)                                                                                 \
    static const field_info noun##_field_list[] = {FIELDS(TABLE_FIELD_INFO)};                                 \
    const table_info noun##_table_info = {#noun, (int)(sizeof noun##_field_list / sizeof *noun##_field_list), \
                                          noun##_field_list};

/* Bytes of one number of a kind. */
size_t field_kind_size(field_kind kind);
/* Room for `rows`, growing by half at least; count stays, pointers into the table may change.  false: no memory, table
   unchanged. */
bool table_reserve(context *ctx, void *table, const table_info *info, int32_t rows);
/* Set count; new rows are zero.  false: no memory. */
bool table_resize(context *ctx, void *table, const table_info *info, int32_t rows);
void table_free(context *ctx, void *table, const table_info *info);
/* 64-bit hash of count and every field's bytes, folded into `seed`; the same on every machine of one endianness. */
uint64_t table_hash(const void *table, const table_info *info, uint64_t seed);
/* dst becomes a copy of src.  false: no memory, dst unchanged. */
bool table_copy(context *ctx, void *dst, const void *src, const table_info *info);
/* The lowest free row was put to use: the next is looked for behind it. */
void table_row_taken(void *table, int32_t row);
/* A row became free. */
void table_row_freed(void *table, int32_t row);
/* The lowest row whose byte of a column is 0, which is a free one; count without. */
int32_t table_first_zero(const void *table, const uint8_t *column);
/* Row `from` over row `to`, all fields. */
void table_move_row(void *table, const table_info *info, int32_t to, int32_t from);
/* The address that the memory function gave for the block of all fields; NULL without rows.  The block begins with
   bytes that are nobody's once the table has let it go. */
void *table_block(const void *table, const table_info *info);
/* Pointer to a field's first number. */
void *table_field(const void *table, const field_info *field);

#endif
