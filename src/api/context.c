/* Version and contexts of the public API. */
#include "api/arguments.h"
#include "api/handles.h"

#include "base/build_parts.h"
#include "base/lent_threads.h"
#include "base/pool.h"
#include "fram/version.h"

#include <string.h>

const char *fram_version(void) { return FRAM_VERSION; }

const char *fram_features(void) { return build_parts(); }

const char *fram_status_name(fram_status status)
{
    switch (status) {
    case FRAM_OK:
        return "ok";
    case FRAM_ERROR_USAGE:
        return "usage";
    case FRAM_ERROR_INPUT:
        return "input";
    case FRAM_ERROR_IO:
        return "io";
    case FRAM_ERROR_MEMORY:
        return "memory";
    case FRAM_ERROR_SIMULATION:
        return "simulation";
    case FRAM_ERROR_UNSUPPORTED:
        return "unsupported";
    case FRAM_ERROR_INTERNAL:
        return "internal";
    case FRAM_INTERRUPTED:
        return "interrupted";
    }
    return "unknown";
}

static void fram_context_fill(fram_context_definition *definition)
{
    *definition = (fram_context_definition){.size = sizeof *definition, .verbosity = FRAM_LOG_INFO, .threads = 1};
}
DEFINITION_DEFAULT(fram_context, fram_context_definition)

static void forward_log(void *user, log_level level, const char *text)
{
    const fram_context *c = user;
    c->log(c->log_user, (fram_log_level)level, text);
}

static fram_status choose_isa(context *inner, const char *name, fram_error *error)
{
    if (!name)
        return FRAM_OK;
    for (isa i = ISA_BASELINE; i <= ISA_AVX512; i++) {
        if (strcmp(name, isa_name(i)) != 0)
            continue;
        if (i > isa_best())
            return error_set(error, FRAM_ERROR_USAGE, NULL, 0, "isa",
                             "%s is not available on this processor; it has up to %s", name, isa_name(isa_best()));
        inner->isa = i;
        return FRAM_OK;
    }
    return error_set(error, FRAM_ERROR_USAGE, NULL, 0, "isa", "expected baseline, avx2 or avx512, found \"%s\"", name);
}

/* Those of the program, or as many of Fram's own. */
static fram_status start_threads(context *inner, const fram_context_definition *d, fram_error *error)
{
    if (d->parallel) {
        inner->lent = lent_threads_create(inner, d->threads, d->parallel, d->parallel_user);
        return inner->lent ? FRAM_OK : error_memory(error);
    }
    if (d->threads == 1)
        return FRAM_OK;
    inner->threads = pool_create(inner, d->threads);
    if (!inner->threads)
        return error_set(error, FRAM_ERROR_MEMORY, NULL, 0, "threads", "%d threads could not be started", d->threads);
    return FRAM_OK;
}

fram_status fram_context_create(const fram_context_definition *definition, fram_context **out, fram_error *error)
{
    fram_context_definition d;
    fram_context_fill(&d);
    fram_status status = REFUSE_NULL(error, {"context", out});
    if (status == FRAM_OK && definition)
        status =
            definition_take(&d, definition, sizeof d, offsetof(fram_context_definition, isa), "fram_context", error);
    if (status != FRAM_OK)
        return status;
    if (d.threads < 1 || d.threads > FRAM_THREADS)
        return error_set(error, FRAM_ERROR_USAGE, NULL, 0, "threads", "expected 1 to %d, found %d", FRAM_THREADS,
                         d.threads);
    if ((int)d.verbosity < FRAM_LOG_ERROR || (int)d.verbosity > FRAM_LOG_DEBUG)
        return error_set(error, FRAM_ERROR_USAGE, NULL, 0, "verbosity", "expected a fram_log_level, found %d",
                         (int)d.verbosity);
    context inner;
    context_init(&inner);
    if (d.memory) {
        inner.memory = d.memory;
        inner.memory_user = d.memory_user;
    }
    inner.verbosity = (log_level)d.verbosity;
    inner.stop = d.stop;
    inner.work = d.work;
    inner.work_user = d.work_user;
    status = choose_isa(&inner, d.isa, error);
    if (status != FRAM_OK)
        return status;
    fram_context *made = memory_array(&inner, 1, sizeof *made);
    if (!made)
        return error_memory(error);
    *made = (fram_context){inner, d.log, d.log_user};
    if (d.log) {
        made->inner.log = forward_log;
        made->inner.log_user = made;
    }
    status = start_threads(&made->inner, &d, error);
    if (status != FRAM_OK) {
        memory_free(&inner, made);
        return status;
    }
    *out = made;
    return FRAM_OK;
}

void fram_context_destroy(fram_context *c)
{
    if (!c)
        return;
    pool *threads = c->inner.threads;
    c->inner.threads = NULL;
    if (threads)
        pool_free(&c->inner, threads);
    lent_threads_free(&c->inner, c->inner.lent);
    c->inner.lent = NULL;
    context inner = c->inner;
    memory_free(&inner, c);
}

void fram_text_free(fram_context *c, char *text)
{
    if (c)
        memory_free(&c->inner, text);
}
