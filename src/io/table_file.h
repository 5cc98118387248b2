/* The container of checkpoints: any list of state tables, named 64-bit numbers and named byte strings in one
   checksummed file, which is read back only into tables of the same fields.

   Layout, numbers in the byte order of the machine that wrote it:
     head     "FRAMTAB\n", u32 version, u32 0x01020304, u64 size of the file, u32 crc of all that follows the head,
              u32 crc of the 28 bytes before
     body     u32 count of numbers, each: name, u64
              u32 count of byte strings, each: name, u64 size, bytes
              u32 count of tables, each: name, u32 count of fields, each field: name, u32 kind, u32 components;
              i32 rows; the fields' columns one after the other

   A name is a u32 length and its bytes. */
#ifndef IO_TABLE_FILE_H
#define IO_TABLE_FILE_H

#include "io/atomic_file.h"
#include "model/world.h"

enum { TABLE_FILE_VERSION = 1 };
/* Refused: larger files.  A million floes take 2 GB. */
#define TABLE_FILE_BYTES_MOST ((uint64_t)64 << 30)

typedef struct table_file_number {
    const char *name;
    uint64_t value;
} table_file_number;

typedef struct table_file_bytes {
    const char *name;
    void *data; /* reading: memory of ctx, to be freed with table_file_free_bytes; NULL when empty */
    size_t size;
} table_file_bytes;

/* What a file holds.  For writing, all of it; for reading, the names (and table descriptors) that are expected, in
   their order: values, data and tables are filled. */
typedef struct table_file {
    const world_table *tables;
    int32_t table_count;
    table_file_number *numbers;
    int32_t number_count;
    table_file_bytes *bytes;
    int32_t bytes_count;
    bool differs; /* set by reading: the file is sound, but not of these numbers, byte strings and tables */
} table_file;

/* Into a new atomic file (io/atomic_file.h), to be committed. */
fram_status table_file_begin(context *ctx, const char *path, const table_file *content, atomic_file *file,
                             fram_error *error);
/* The same bytes in memory of ctx. */
fram_status table_file_encode(context *ctx, const table_file *content, char **data, size_t *size, fram_error *error);
/* FRAM_ERROR_INPUT with the reason when the file is damaged, of another version or byte order, or holds other names or
   fields: nothing is then changed.  Without memory the tables' rows are undefined, but they can be freed. */
fram_status table_file_read(context *ctx, const char *path, table_file *content, fram_error *error);
/* The same from memory; `name` stands for the file in errors. */
fram_status table_file_decode(context *ctx, const char *name, const void *data, size_t size, table_file *content,
                              fram_error *error);
void table_file_free_bytes(context *ctx, table_file *content);

#endif
