#include "io/png.h"

#include <string.h>
#include <zlib.h>

enum { COLOURS = 3, TRUE_COLOUR = 2, BITS = 8, LEVEL = 1, CHUNK_ROOM = 1 << 16 };

/* PNG's integers have the most significant byte first. */
static void set_u32(unsigned char out[4], uint32_t v)
{
    for (int i = 0; i < 4; i++)
        out[i] = (unsigned char)(v >> (24 - 8 * i));
}

/* Length, type, data, and the checksum of type and data. */
static void add_chunk(context *ctx, text_buffer *out, const char *type, const unsigned char *data, size_t size)
{
    unsigned char head[8], tail[4];
    set_u32(head, (uint32_t)size);
    memcpy(head + 4, type, 4);
    uLong sum = crc32_z(0, head + 4, 4);
    set_u32(tail, (uint32_t)(size > 0 ? crc32_z(sum, data, size) : sum));
    text_add_bytes(ctx, out, (const char *)head, sizeof head);
    text_add_bytes(ctx, out, (const char *)data, size);
    text_add_bytes(ctx, out, (const char *)tail, sizeof tail);
}

/* What the compressor has for the row that it was given, in chunks. */
static void compress_row(context *ctx, z_stream *z, int flush, unsigned char room[CHUNK_ROOM], text_buffer *out)
{
    for (bool done = false; !done;) {
        int answer = deflate(z, flush);
        /* With room left in the output, all of the input was taken. */
        done = flush == Z_FINISH ? answer == Z_STREAM_END : z->avail_out > 0;
        if (z->avail_out > 0 && !(done && flush == Z_FINISH))
            continue;
        add_chunk(ctx, out, "IDAT", room, CHUNK_ROOM - z->avail_out);
        z->next_out = room;
        z->avail_out = CHUNK_ROOM;
    }
}

/* "None", the first of PNG's filters, then red, green and blue of each pixel. */
static void fill_row(const png_pixels *p, int32_t y, unsigned char *row)
{
    const unsigned char *from = p->data + (size_t)y * p->stride;
    *row++ = 0;
    for (int32_t x = 0; x < p->width; x++) {
        uint32_t pixel;
        memcpy(&pixel, from + 4 * (size_t)x, sizeof pixel);
        *row++ = (unsigned char)(pixel >> 16);
        *row++ = (unsigned char)(pixel >> 8);
        *row++ = (unsigned char)pixel;
    }
}

static voidpf take_memory(voidpf ctx, uInt count, uInt size) { return memory_array(ctx, count, size); }
static void give_memory(voidpf ctx, voidpf block) { memory_free(ctx, block); }

fram_status png_encode(context *ctx, const png_pixels *pixels, text_buffer *out, fram_error *error)
{
    static const char magic[8] = {(char)0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
    unsigned char header[13] = {[8] = BITS, [9] = TRUE_COLOUR};
    size_t size = 1 + COLOURS * (size_t)pixels->width;
    unsigned char *row = memory_array(ctx, size + CHUNK_ROOM, 1), *room = row ? row + size : NULL;
    z_stream z = {.zalloc = take_memory, .zfree = give_memory, .opaque = ctx};
    if (!row || deflateInit(&z, LEVEL) != Z_OK) {
        memory_free(ctx, row);
        return error_memory(error);
    }
    set_u32(header, (uint32_t)pixels->width);
    set_u32(header + 4, (uint32_t)pixels->height);
    text_add_bytes(ctx, out, magic, sizeof magic);
    add_chunk(ctx, out, "IHDR", header, sizeof header);
    z.next_out = room;
    z.avail_out = CHUNK_ROOM;
    for (int32_t y = 0; y < pixels->height; y++) {
        fill_row(pixels, y, row);
        z.next_in = row;
        z.avail_in = (uInt)size;
        compress_row(ctx, &z, y + 1 < pixels->height ? Z_NO_FLUSH : Z_FINISH, room, out);
    }
    deflateEnd(&z);
    add_chunk(ctx, out, "IEND", row, 0);
    memory_free(ctx, row);
    return out->failed ? error_memory(error) : FRAM_OK;
}
