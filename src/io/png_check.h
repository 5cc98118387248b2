/* Whether a file that was found is a picture: asked before its bytes go where others see them.  Knows no pixels. */
#ifndef IO_PNG_CHECK_H
#define IO_PNG_CHECK_H

#include <stdbool.h>
#include <stddef.h>

/* Whether these bytes are a PNG file (ISO/IEC 15948, 5) from the first to the last: signature, header, chunks whose
   checksums fit, the end, and nothing behind it. */
bool png_is_whole(const void *data, size_t size);

#endif
