/* ZIP archives, written: files in the order they are given, deflated, without times, so that the same content gives the
   same bytes (PKWARE's APPNOTE 6.3, the part without ZIP64: 4 GiB and 65,535 files at most). */
#ifndef IO_ZIP_FILE_H
#define IO_ZIP_FILE_H

#include "base/array.h"
#include "io/text_buffer.h"

typedef struct zip_file {
    context *ctx;
    text_buffer body, directory; /* what is written; the list that ends it */
    int32_t count;
} zip_file;

/* Starts as {.ctx = ctx}.  name: with slashes, UTF-8; executable: as the permission to execute it. */
fram_status zip_add(zip_file *zip, const char *name, const void *data, size_t size, bool executable, fram_error *error);
/* The whole archive at its place (io/atomic_file.h). */
fram_status zip_write(zip_file *zip, const char *path, fram_error *error);
void zip_free(zip_file *zip);

#endif
