/* Memory, log, instruction set and error records.  Must not know who asks. */
#include "base/context.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Longest text of one log_write, the NUL included; longer ones end in "...". */
enum { LOG_TEXT_SIZE = 1024 };

static void *library_memory(void *user, void *ptr, size_t size)
{
    (void)user;
    if (size == 0) { /* realloc(ptr, 0) means different things in different libraries */
        free(ptr);
        return NULL;
    }
    return realloc(ptr, size);
}

void context_init(context *ctx)
{
    *ctx = (context){.memory = library_memory, .verbosity = LOG_INFO, .isa = isa_best()};
}

isa isa_best(void)
{
#ifdef FRAM_KERNELS_X86 /* the build holds the wide kernels, see kernel.h */
    /* The 8-lane kernels use double and 64-bit integer operations (f, dq) and 256-bit leftovers (vl). */
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl"))
        return ISA_AVX512;
    if (__builtin_cpu_supports("avx2"))
        return ISA_AVX2;
#endif
    return ISA_BASELINE;
}

const char *isa_name(isa i)
{
    switch (i) {
    case ISA_BASELINE:
        return "baseline";
    case ISA_AVX2:
        return "avx2";
    case ISA_AVX512:
        return "avx512";
    }
    return "unknown";
}

void *memory_resize(context *ctx, void *ptr, size_t size) { return ctx->memory(ctx->memory_user, ptr, size); }

void *memory_array(context *ctx, size_t count, size_t size)
{
    if (size != 0 && count > SIZE_MAX / size)
        return NULL;
    /* NULL must mean "no memory", hence never a request for nothing. */
    size_t bytes = count * size > 0 ? count * size : 1;
    void *block = ctx->memory(ctx->memory_user, NULL, bytes);
    if (block)
        memset(block, 0, bytes);
    return block;
}

void memory_free(context *ctx, void *ptr)
{
    if (ptr)
        ctx->memory(ctx->memory_user, ptr, 0);
}

char *memory_string(context *ctx, const char *text)
{
    size_t size = strlen(text) + 1;
    char *copy = memory_resize(ctx, NULL, size);
    if (copy)
        memcpy(copy, text, size);
    return copy;
}

void log_write(context *ctx, log_level level, const char *format, ...)
{
    if (!ctx->log || level > ctx->verbosity)
        return;
    char text[LOG_TEXT_SIZE];
    va_list arguments;
    va_start(arguments, format);
    int length = vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    if (length < 0)
        return;
    if ((size_t)length >= sizeof text)
        memcpy(text + sizeof text - 4, "...", 4);
    ctx->log(ctx->log_user, level, text);
}

fram_status work_continue(context *ctx, const char *what, double done, double total, fram_error *error)
{
    if (stop_is_asked(ctx->stop))
        return error_set(error, FRAM_INTERRUPTED, NULL, 0, NULL, "interrupted while %s; nothing was written", what);
    work_tell(ctx, what, done, total);
    return FRAM_OK;
}

void work_tell(context *ctx, const char *what, double done, double total)
{
    if (ctx->work)
        ctx->work(ctx->work_user, what, done, total);
}

/* memmove, because a caller may wrap an error in its own words: text may point into the record itself. */
static void text_copy(char *out, size_t size, const char *text)
{
    size_t length = text ? strlen(text) : 0;
    if (length >= size)
        length = size - 1;
    if (length > 0)
        memmove(out, text, length);
    out[length] = '\0';
}

fram_status error_set(fram_error *e, fram_status status, const char *file, int line, const char *key,
                      const char *format, ...)
{
    if (!e)
        return status;
    char message[sizeof e->message]; /* the arguments may point into e */
    va_list arguments;
    va_start(arguments, format);
    if (vsnprintf(message, sizeof message, format, arguments) < 0)
        message[0] = '\0';
    va_end(arguments);
    text_copy(e->file, sizeof e->file, file);
    text_copy(e->key, sizeof e->key, key);
    text_copy(e->message, sizeof e->message, message);
    e->status = status;
    e->line = line;
    e->column = 0;
    return status;
}

void error_text(const fram_error *e, char out[ERROR_TEXT_SIZE])
{
    char line[16] = "", column[16] = "";
    if (e->line > 0)
        snprintf(line, sizeof line, ":%d", e->line);
    if (e->line > 0 && e->column > 0)
        snprintf(column, sizeof column, ":%d", e->column);
    snprintf(out, ERROR_TEXT_SIZE, "%s%s%s%s%s%s%s", e->file, line, column, e->file[0] ? ": " : "", e->key,
             e->key[0] ? ": " : "", e->message);
}

fram_status error_value(fram_error *e, const char *key, const char *expected, double found)
{
    return error_set(e, FRAM_ERROR_INPUT, NULL, 0, key, "expected %s, found %g", expected, found);
}

void error_memory_text(fram_error *e) { (void)error_set(e, FRAM_ERROR_MEMORY, NULL, 0, NULL, "not enough memory"); }
