/* Makes the n-th call of a kind fail: preloaded into a command by tools/torture/part_faults.py.

   FRAM_FAULT_KIND   memory (realloc, calloc), files (what opens, reads, writes, renames, ...) or threads (programs too)
   FRAM_FAULT_AT     the number of the call that fails, from 1 on; 0: none, count only
   FRAM_FAULT_ON     1: that call and all after it fail
   FRAM_FAULT_REPORT a file that gets "hit NAME" and, at the end, "calls N"

   Only calls that come from the program itself count: what libraries do with their own memory is not Fram's to mend.
   Programs that it starts are left alone. */
#define _GNU_SOURCE
#include <dirent.h>
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <link.h>
#include <pthread.h>
#include <spawn.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

extern void *__libc_realloc(void *, size_t);
extern void *__libc_calloc(size_t, size_t);

enum kind { NOTHING, MEMORY, FILES, THREADS };

static enum kind wanted;
static long fail_at, calls;
static bool fail_on;
static int report = -1;
static uintptr_t program_begins, program_ends;

static int find_program(struct dl_phdr_info *info, size_t size, void *data)
{
    (void)size;
    (void)data;
    for (int i = 0; i < info->dlpi_phnum; i++)
        if (info->dlpi_phdr[i].p_type == PT_LOAD) {
            uintptr_t end = info->dlpi_addr + info->dlpi_phdr[i].p_vaddr + info->dlpi_phdr[i].p_memsz;
            if (program_begins == 0)
                program_begins = info->dlpi_addr + info->dlpi_phdr[i].p_vaddr;
            if (end > program_ends)
                program_ends = end;
        }
    return 1; /* the program itself is the first */
}

__attribute__((constructor)) static void begin(void)
{
    const char *kind = getenv("FRAM_FAULT_KIND"), *at = getenv("FRAM_FAULT_AT"), *on = getenv("FRAM_FAULT_ON");
    const char *path = getenv("FRAM_FAULT_REPORT");
    dl_iterate_phdr(find_program, NULL);
    fail_at = at ? atol(at) : 0;
    fail_on = on && *on == '1';
    if (path)
        report = (int)syscall(SYS_openat, AT_FDCWD, path, O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0600);
    /* A descriptor that the program does not expect would get in the way of its own. */
    if (report >= 0 && report < 100) {
        int high = (int)syscall(SYS_fcntl, report, F_DUPFD_CLOEXEC, 100);
        syscall(SYS_close, report);
        report = high;
    }
    wanted = !kind ? NOTHING : strcmp(kind, "memory") == 0 ? MEMORY : strcmp(kind, "files") == 0 ? FILES : THREADS;
    unsetenv("LD_PRELOAD");
}

static void say(const char *text, const char *more)
{
    if (report < 0)
        return;
    char line[96];
    size_t n = 0;
    for (const char *c = text; *c && n < 60; c++)
        line[n++] = *c;
    for (const char *c = more; *c && n < 94; c++)
        line[n++] = *c;
    line[n++] = '\n';
    syscall(SYS_write, report, line, n);
}

__attribute__((destructor)) static void end(void)
{
    char digits[24];
    char *d = digits + sizeof digits - 1;
    long n = __atomic_load_n(&calls, __ATOMIC_RELAXED);
    *d = 0;
    do
        *--d = (char)('0' + n % 10);
    while ((n /= 10) > 0);
    say("calls ", d);
}

static bool fails(enum kind kind, const char *name, const void *caller)
{
    uintptr_t from = (uintptr_t)caller;
    if (kind != wanted || from < program_begins || from >= program_ends)
        return false;
    long n = __atomic_add_fetch(&calls, 1, __ATOMIC_RELAXED);
    if (fail_at == 0 || (fail_on ? n < fail_at : n != fail_at))
        return false;
    if (n == fail_at)
        say("hit ", name);
    return true;
}

#define FAILS(kind, name) fails(kind, name, __builtin_return_address(0))
#define NEXT(name)                 \
    static __typeof__(&name) next; \
    if (!next)                     \
    *(void **)&next = dlsym(RTLD_NEXT, #name)
#define FILE_CALL(type, name, parameters, arguments, number, failed) \
    type name parameters                                             \
    {                                                                \
        NEXT(name);                                                  \
        if (FAILS(FILES, #name)) {                                   \
            errno = number;                                          \
            return failed;                                           \
        }                                                            \
        return next arguments;                                       \
    }

void *realloc(void *p, size_t size)
{
    if (size > 0 && FAILS(MEMORY, "realloc")) {
        errno = ENOMEM;
        return NULL;
    }
    return __libc_realloc(p, size);
}

void *calloc(size_t count, size_t size)
{
    if (FAILS(MEMORY, "calloc")) {
        errno = ENOMEM;
        return NULL;
    }
    return __libc_calloc(count, size);
}

FILE_CALL(int, access, (const char *path, int mode), (path, mode), EIO, -1)
FILE_CALL(int, close, (int fd), (fd), EIO, -1)
FILE_CALL(FILE *, fopen, (const char *path, const char *mode), (path, mode), EMFILE, NULL)
FILE_CALL(int, fseeko, (FILE * f, off_t at, int whence), (f, at, whence), EIO, -1)
FILE_CALL(int, fstat, (int fd, struct stat *s), (fd, s), EIO, -1)
FILE_CALL(int, fsync, (int fd), (fd), EIO, -1)
FILE_CALL(int, ftruncate, (int fd, off_t length), (fd, length), EIO, -1)
FILE_CALL(int, flock, (int fd, int how), (fd, how), ENOLCK, -1)
FILE_CALL(char *, getcwd, (char *path, size_t size), (path, size), ENOENT, NULL)
FILE_CALL(off_t, lseek, (int fd, off_t at, int whence), (fd, at, whence), EIO, -1)
FILE_CALL(int, lstat, (const char *path, struct stat *s), (path, s), EIO, -1)
FILE_CALL(int, stat, (const char *path, struct stat *s), (path, s), EIO, -1)
FILE_CALL(int, mkdir, (const char *path, mode_t mode), (path, mode), ENOSPC, -1)
FILE_CALL(DIR *, opendir, (const char *path), (path), EMFILE, NULL)
FILE_CALL(struct dirent *, readdir, (DIR * d), (d), EIO, NULL)
FILE_CALL(ssize_t, readlink, (const char *path, char *to, size_t size), (path, to, size), EIO, -1)
FILE_CALL(int, rename, (const char *from, const char *to), (from, to), EACCES, -1)
FILE_CALL(int, rmdir, (const char *path), (path), EACCES, -1)
FILE_CALL(int, unlink, (const char *path), (path), EACCES, -1)
FILE_CALL(ssize_t, write, (int fd, const void *data, size_t size), (fd, data, size), ENOSPC, -1)
FILE_CALL(ssize_t, pread, (int fd, void *data, size_t size, off_t at), (fd, data, size, at), EIO, -1)

int open(const char *path, int flags, ...)
{
    NEXT(open);
    va_list rest;
    va_start(rest, flags);
    mode_t mode = flags & (O_CREAT | O_TMPFILE) ? va_arg(rest, mode_t) : 0;
    va_end(rest);
    if (FAILS(FILES, "open")) {
        errno = EMFILE;
        return -1;
    }
    return next(path, flags, mode);
}

/* A stream that failed says so, as the C library's own do. */
static void stream_failed(FILE *f, int number)
{
    if (f)                 /* NULL: fflush of all streams */
        f->_flags |= 0x20; /* _IO_ERR_SEEN */
    errno = number;
}

#define STREAM_CALL(type, name, parameters, arguments, number, failed) \
    type name parameters                                               \
    {                                                                  \
        NEXT(name);                                                    \
        if (f != stderr && FAILS(FILES, #name)) {                      \
            stream_failed(f, number);                                  \
            return failed;                                             \
        }                                                              \
        return next arguments;                                         \
    }

STREAM_CALL(size_t, fread, (void *data, size_t size, size_t count, FILE *f), (data, size, count, f), EIO, 0)
STREAM_CALL(size_t, fwrite, (const void *data, size_t size, size_t count, FILE *f), (data, size, count, f), ENOSPC, 0)
STREAM_CALL(int, fputs, (const char *text, FILE *f), (text, f), ENOSPC, EOF)
STREAM_CALL(int, fputc, (int c, FILE *f), (c, f), ENOSPC, EOF)
STREAM_CALL(int, fflush, (FILE * f), (f), ENOSPC, EOF)

int fprintf(FILE *f, const char *format, ...)
{
    if (f != stderr && FAILS(FILES, "fprintf")) {
        stream_failed(f, ENOSPC);
        return -1;
    }
    va_list rest;
    va_start(rest, format);
    int n = vfprintf(f, format, rest);
    va_end(rest);
    return n;
}

/* The stream is closed in any case; what it still held did not reach the disk. */
int fclose(FILE *f)
{
    NEXT(fclose);
    bool failed = FAILS(FILES, "fclose");
    int code = next(f);
    if (!failed)
        return code;
    errno = ENOSPC;
    return EOF;
}

int pthread_create(pthread_t *thread, const pthread_attr_t *attributes, void *(*run)(void *), void *argument)
{
    NEXT(pthread_create);
    if (FAILS(THREADS, "pthread_create"))
        return EAGAIN;
    return next(thread, attributes, run, argument);
}

#define SPAWN_CALL(name)                                                                                           \
    int name(pid_t *id, const char *path, const posix_spawn_file_actions_t *actions, const posix_spawnattr_t *how, \
             char *const words[], char *const variables[])                                                         \
    {                                                                                                              \
        NEXT(name);                                                                                                \
        return FAILS(THREADS, #name) ? EAGAIN : next(id, path, actions, how, words, variables);                    \
    }

SPAWN_CALL(posix_spawn)
SPAWN_CALL(posix_spawnp)
