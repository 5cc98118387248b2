/* PNG files, made for speed: pictures of areas of one colour, which a run draws at its end and a video for every frame.
   Knows pixels only. */
#ifndef IO_PNG_H
#define IO_PNG_H

#include "io/text_buffer.h"

#include <stddef.h>
#include <stdint.h>

/* Rows of pixels, 0x00rrggbb each in the machine's byte order, `stride` bytes apart. */
typedef struct png_pixels {
    const unsigned char *data;
    size_t stride;
    int32_t width, height;
} png_pixels;

/* A PNG file of 8 bits a colour: rows unfiltered and compressed lightly, which for pictures of flat colours is about as
   small as libpng's defaults and four to five times as fast.  Appended to out, of which nothing changes on a failure;
   FRAM_ERROR_MEMORY is the only one up to libpng's limit of a million columns or rows, and beyond it, with libpng's
   reason. */
fram_status png_encode(context *ctx, const png_pixels *pixels, text_buffer *out, fram_error *error);

#endif
