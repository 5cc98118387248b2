#include "io/zip_file.h"

#include "io/atomic_file.h"

#include <string.h>
#include <zlib.h>

enum {
    LOCAL_SIZE = 30,
    CENTRAL_SIZE = 46,
    END_SIZE = 22,
    VERSION = 20,
    DEFLATED = 8,
    NAME_IS_UTF8 = 1 << 11,
    FILES_MOST = 65535
};
/* 1 January 1980, the first day that there is. */
enum { FIRST_DAY = 0x21 };
#define MADE_BY_UNIX (3 << 8 | VERSION)

static void put16(unsigned char **at, unsigned value)
{
    *(*at)++ = (unsigned char)(value & 0xff);
    *(*at)++ = (unsigned char)(value >> 8 & 0xff);
}

static void put32(unsigned char **at, uint32_t value)
{
    put16(at, value & 0xffff);
    put16(at, value >> 16);
}

typedef struct zip_entry {
    const char *name;
    uint32_t crc, packed, size, offset, mode;
} zip_entry;

/* What a local head and the directory have in common: from the version that is needed to the length of the name. */
static void put_common(unsigned char **at, const zip_entry *e)
{
    bool is_ascii = true;
    for (const char *c = e->name; *c; c++)
        is_ascii = is_ascii && (unsigned char)*c < 0x80;
    put16(at, VERSION);
    put16(at, is_ascii ? 0 : NAME_IS_UTF8);
    put16(at, DEFLATED);
    put16(at, 0);
    put16(at, FIRST_DAY);
    put32(at, e->crc);
    put32(at, e->packed);
    put32(at, e->size);
    put16(at, (unsigned)strlen(e->name));
    put16(at, 0);
}

static void add_entry(zip_file *zip, const zip_entry *e, const void *packed)
{
    unsigned char local[LOCAL_SIZE], central[CENTRAL_SIZE], *at = local;
    put32(&at, 0x04034b50);
    put_common(&at, e);
    text_add_bytes(zip->ctx, &zip->body, (const char *)local, sizeof local);
    text_add_bytes(zip->ctx, &zip->body, e->name, strlen(e->name));
    text_add_bytes(zip->ctx, &zip->body, packed, e->packed);
    at = central;
    put32(&at, 0x02014b50);
    put16(&at, MADE_BY_UNIX);
    put_common(&at, e);
    put16(&at, 0);
    put16(&at, 0);
    put16(&at, 0);
    put32(&at, e->mode << 16);
    put32(&at, e->offset);
    text_add_bytes(zip->ctx, &zip->directory, (const char *)central, sizeof central);
    text_add_bytes(zip->ctx, &zip->directory, e->name, strlen(e->name));
    zip->count++;
}

/* Raw deflate, at the end of which stands no checksum; *size becomes that of what is packed. */
static bool deflate_raw(const void *data, size_t size, void *packed, size_t *room)
{
    z_stream z = {0};
    if (deflateInit2(&z, Z_DEFAULT_COMPRESSION, Z_DEFLATED, -15, 8, Z_DEFAULT_STRATEGY) != Z_OK)
        return false;
    z.next_in = (Bytef *)data;
    z.avail_in = (uInt)size;
    z.next_out = packed;
    z.avail_out = (uInt)*room;
    bool good = deflate(&z, Z_FINISH) == Z_STREAM_END;
    *room = z.total_out;
    deflateEnd(&z);
    return good;
}

fram_status zip_add(zip_file *zip, const char *name, const void *data, size_t size, bool executable, fram_error *error)
{
    size_t room = size + size / 1000 + 64;
    if (size > INT32_MAX / 2 || zip->count == FILES_MOST || strlen(name) > FILES_MOST)
        return error_set(error, FRAM_ERROR_INPUT, name, 0, NULL, "the file is too large for the archive");
    unsigned char *packed = memory_resize(zip->ctx, NULL, room);
    if (!packed || !deflate_raw(data, size, packed, &room)) {
        memory_free(zip->ctx, packed);
        return error_memory(error);
    }
    const zip_entry e = {.name = name,
                         .crc = (uint32_t)crc32_z(crc32_z(0, NULL, 0), data, size),
                         .packed = (uint32_t)room,
                         .size = (uint32_t)size,
                         .offset = (uint32_t)zip->body.count,
                         .mode = executable ? 0100755 : 0100644};
    add_entry(zip, &e, packed);
    memory_free(zip->ctx, packed);
    if (!zip->body.failed && !zip->directory.failed)
        return FRAM_OK;
    return error_memory(error);
}

fram_status zip_write(zip_file *zip, const char *path, fram_error *error)
{
    unsigned char end[END_SIZE], *at = end;
    uint32_t offset = (uint32_t)zip->body.count, size = (uint32_t)zip->directory.count;
    put32(&at, 0x06054b50);
    put32(&at, 0);
    put16(&at, (unsigned)zip->count);
    put16(&at, (unsigned)zip->count);
    put32(&at, size);
    put32(&at, offset);
    put16(&at, 0);
    if (size > 0)
        text_add_bytes(zip->ctx, &zip->body, zip->directory.data, size);
    text_add_bytes(zip->ctx, &zip->body, (const char *)end, sizeof end);
    if (zip->body.failed)
        return error_memory(error);
    return atomic_file_write(zip->ctx, path, zip->body.data, (size_t)zip->body.count, error);
}

void zip_free(zip_file *zip)
{
    text_free(zip->ctx, &zip->body);
    text_free(zip->ctx, &zip->directory);
}
