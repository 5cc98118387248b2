/* A folder of its own for the files of a test. */
#ifndef TESTS_SCRATCH_H
#define TESTS_SCRATCH_H

#include "testing.h"
#include <stdio.h>
#include <unistd.h>

enum { SCRATCH_FOLDER = 200, SCRATCH_PATH = 300 };

/* Makes an empty one, in that of temporary files. */
static inline void scratch_folder(char folder[SCRATCH_FOLDER])
{
    const char *root = getenv("TMPDIR");
    snprintf(folder, SCRATCH_FOLDER, "%s/fram_test_XXXXXX", root && *root && strlen(root) < 150 ? root : "/tmp");
    ck_assert_ptr_nonnull(mkdtemp(folder));
}

/* Removes it with all that is in it. */
static inline void scratch_remove_folder(const char *folder)
{
    char command[SCRATCH_FOLDER + 16];
    ck_assert_ptr_nonnull(strstr(folder, "fram_test_"));
    snprintf(command, sizeof command, "rm -rf '%s'", folder);
    ck_assert_int_eq(system(command), 0); /* NOLINT(cert-env33-c): a folder of mkdtemp */
}

static inline void scratch_write(const char *path, const void *data, size_t size)
{
    FILE *file = fopen(path, "wb");
    ck_assert_ptr_nonnull(file);
    ck_assert_uint_eq(fwrite(data, 1, size, file), size);
    ck_assert_int_eq(fclose(file), 0);
}

static inline void scratch_text(const char *path, const char *text) { scratch_write(path, text, strlen(text)); }

static inline void scratch_put(const char *folder, const char *name, const char *text)
{
    char path[SCRATCH_PATH];
    ck_assert_int_lt(snprintf(path, sizeof path, "%s/%s", folder, name), (int)sizeof path);
    scratch_text(path, text);
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

/* ---- with one path at a time ---- */

typedef struct scratch {
    char folder[SCRATCH_FOLDER];
    char path[SCRATCH_PATH]; /* of the last scratch_path */
} scratch;

static inline scratch scratch_make(void)
{
    scratch s = {0};
    scratch_folder(s.folder);
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

#endif
