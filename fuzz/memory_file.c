/* A file that stands in memory; see fuzzing.h.  Linux only, as it needs memfd_create. */
#define _GNU_SOURCE
#include "fuzzing.h"

#include <sys/mman.h>
#include <unistd.h>

memory_file memory_file_make(const uint8_t *data, size_t size)
{
    memory_file file = {.descriptor = memfd_create("fuzz", 0)};
    if (file.descriptor < 0)
        return file;
    snprintf(file.path, sizeof file.path, "/proc/self/fd/%d", file.descriptor);
    while (size > 0) {
        ssize_t written = write(file.descriptor, data, size);
        if (written <= 0) {
            memory_file_close(&file);
            break;
        }
        data += written;
        size -= (size_t)written;
    }
    return file;
}

void memory_file_close(memory_file *file)
{
    close(file->descriptor);
    file->descriptor = -1;
}
