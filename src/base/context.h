/* What every call may need from its surroundings: memory, log, threads, instruction set.
   No globals: a context is made by the caller and handed down; worlds with different contexts are
   independent.  A failed allocation is a status, never an abort. */
#ifndef BASE_CONTEXT_H
#define BASE_CONTEXT_H

#include "base/text.h"
#include "fram/error.h"
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct pool pool;
typedef struct lent_threads lent_threads;

typedef enum log_level { LOG_ERROR, LOG_WARNING, LOG_INFO, LOG_DEBUG } log_level;

/* realloc's contract: ptr NULL allocates, size 0 frees and returns NULL, NULL otherwise means no memory. */
typedef void *(*memory_function)(void *user, void *ptr, size_t size);
typedef void (*log_function)(void *user, log_level level, const char *text);
/* How far long work is that is no time step: `done` of `total`; total 0: rounds that are done, of nobody knows how
   many. what: "packing the ice". */
typedef void (*work_function)(void *user, const char *what, double done, double total);

typedef enum isa { ISA_BASELINE, ISA_AVX2, ISA_AVX512 } isa;

typedef struct context {
    memory_function memory; /* never NULL after context_init */
    void *memory_user;
    log_function log; /* NULL: silent */
    void *log_user;
    log_level verbosity;
    const volatile int *stop; /* non-zero: work that asks work_continue ends; may be NULL */
    work_function work;       /* NULL: silent */
    void *work_user;
    pool *threads;      /* NULL: everything runs on the calling thread, or on those of `lent` */
    lent_threads *lent; /* threads of the program, in place of a pool; NULL: none */
    isa isa;            /* which kernels to run; results are the same to the bit */
} context;

/* Defaults: the C library's memory, no log, no threads, the best instruction set of this processor. */
void context_init(context *ctx);
/* The widest instruction set this processor and build have. */
isa isa_best(void);
/* "baseline", "avx2", "avx512" */
const char *isa_name(isa i);

/* Memory; NULL when there is none.  memory_array checks count * size for overflow and zeroes what it returns. */
void *memory_resize(context *ctx, void *ptr, size_t size);
void *memory_array(context *ctx, size_t count, size_t size);
void memory_free(context *ctx, void *ptr);
/* A copy of a string, or NULL. */
char *memory_string(context *ctx, const char *text);

/* printf to the log sink when level <= verbosity. */
void log_write(context *ctx, log_level level, const char *format, ...) __attribute__((format(printf, 3, 4)));

/* Whether a caller's flag is set; NULL: no.  Read as one indivisible int, so that another thread may set it meanwhile
   as fram_stop_set does. */
static inline bool stop_is_asked(const volatile int *stop)
{
    return stop && __atomic_load_n(stop, __ATOMIC_RELAXED) != 0;
}

/* A copy for what has to be done though somebody asks to stop: nobody does in it. */
static inline context context_unstopped(const context *ctx)
{
    context own = *ctx;
    own.stop = NULL;
    return own;
}

/* Asked again and again by what may take longer than a second and is no time step, from the caller's thread: tells how
   far it is; FRAM_INTERRUPTED when the stop flag is set. */
fram_status work_continue(context *ctx, const char *what, double done, double total, fram_error *error);
/* The same for what is not to be stopped halfway: tells only. */
void work_tell(context *ctx, const char *what, double done, double total);

/* Fill e (which may be NULL) and return status.  file, key may be NULL. */
fram_status error_set(fram_error *e, fram_status status, const char *file, int line, const char *key,
                      const char *format, ...) __attribute__((format(printf, 6, 7)));
/* Place, key and message in one line, "a.yaml:3:7: ice.thickness: expected ...", as a command tells them. */
enum { ERROR_TEXT_SIZE = sizeof(fram_error) + 32 };
void error_text(const fram_error *e, char out[ERROR_TEXT_SIZE]);
/* A number that a definition cannot hold: FRAM_ERROR_INPUT, "expected a positive number of metres, found -3". */
fram_status error_value(fram_error *e, const char *key, const char *expected, double found);
/* The one message for a failed allocation.  Inline, so that a reader and an analyser see that it is never FRAM_OK. */
void error_memory_text(fram_error *e);
static inline fram_status error_memory(fram_error *e)
{
    error_memory_text(e);
    return FRAM_ERROR_MEMORY;
}

#endif
