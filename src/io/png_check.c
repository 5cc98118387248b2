#include "io/png_check.h"

#include "io/file.h"

#include <string.h>

static const unsigned char png_signature[] = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
/* A chunk: length, name, that many bytes, checksum of name and bytes. */
enum { PNG_WORD = 4, PNG_AROUND = 3 * PNG_WORD, PNG_HEADER_SIZE = 13 };

static uint32_t png_word(const unsigned char *at)
{
    return (uint32_t)at[0] << 24 | (uint32_t)at[1] << 16 | (uint32_t)at[2] << 8 | at[3];
}

/* The bytes of the chunk that begins here; 0: none that is whole. */
static size_t png_chunk(const unsigned char *at, size_t room)
{
    if (room < PNG_AROUND || png_word(at) > room - PNG_AROUND)
        return 0;
    size_t length = png_word(at);
    bool fits = file_crc(0, at + PNG_WORD, PNG_WORD + length) == png_word(at + 2 * PNG_WORD + length);
    return fits ? PNG_AROUND + length : 0;
}

bool png_is_whole(const void *data, size_t size)
{
    const unsigned char *at = data;
    size_t done = sizeof png_signature;
    if (size < done || memcmp(at, png_signature, done) != 0)
        return false;
    bool first = true, last = false;
    while (!last) {
        size_t chunk = png_chunk(at + done, size - done);
        const unsigned char *name = at + done + PNG_WORD;
        if (chunk == 0 || (first && (memcmp(name, "IHDR", PNG_WORD) != 0 || chunk != PNG_AROUND + PNG_HEADER_SIZE)))
            return false;
        first = false;
        last = memcmp(name, "IEND", PNG_WORD) == 0;
        done += chunk;
    }
    return done == size;
}
