/* A folder of its own for the files of a test. */
#ifndef TESTS_IO_SCRATCH_H
#define TESTS_IO_SCRATCH_H

#include "testing.h"
#include <stdio.h>
#include <unistd.h>

typedef struct scratch {
    char folder[200];
    char path[300]; /* of the last scratch_path */
} scratch;

static inline scratch scratch_make(void)
{
    scratch s = {0};
    const char *root = getenv("TMPDIR");
    snprintf(s.folder, sizeof s.folder, "%s/fram_test_XXXXXX", root && strlen(root) < 150 ? root : "/tmp");
    ck_assert_ptr_nonnull(mkdtemp(s.folder));
    return s;
}

static inline const char *scratch_path(scratch *s, const char *name)
{
    snprintf(s->path, sizeof s->path, "%s/%s", s->folder, name);
    return s->path;
}

/* Removes one file and the folder, which must then be empty: nothing else was left behind. */
static inline void scratch_remove(scratch *s, const char *name)
{
    ck_assert_int_eq(unlink(scratch_path(s, name)), 0);
    ck_assert_int_eq(rmdir(s->folder), 0);
}

/* The bytes of a file, in memory of malloc. */
static inline char *scratch_read(const char *path, size_t *size)
{
    FILE *file = fopen(path, "rb");
    ck_assert_ptr_nonnull(file);
    char *data = malloc(1 << 20);
    *size = fread(data, 1, 1 << 20, file);
    fclose(file);
    return data;
}

static inline void scratch_write(const char *path, const void *data, size_t size)
{
    FILE *file = fopen(path, "wb");
    ck_assert_ptr_nonnull(file);
    ck_assert_uint_eq(fwrite(data, 1, size, file), size);
    ck_assert_int_eq(fclose(file), 0);
}

#endif
