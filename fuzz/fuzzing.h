/* What the fuzz targets share: a promise that is checked, and a file that stands in memory.
   Knows nothing of Fram. */
#ifndef FUZZING_H
#define FUZZING_H

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

/* A broken promise is a finding, as a bad read is. */
#define PROMISE(condition)                                                                  \
    do {                                                                                    \
        if (!(condition)) {                                                                 \
            fprintf(stderr, "%s:%d: broken promise: %s\n", __FILE__, __LINE__, #condition); \
            abort();                                                                        \
        }                                                                                   \
    } while (0)

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

/* A file of these bytes, for readers that take a path.  descriptor -1: the system refused. */
typedef struct memory_file {
    int descriptor;
    char path[64];
} memory_file;
memory_file memory_file_make(const uint8_t *data, size_t size);
void memory_file_close(memory_file *file);

#endif
