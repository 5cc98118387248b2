/* The simulator in a browser: what bindings/wasm/worker.js calls.  It stands on include/fram alone, keeps one run, and
   writes its results into the folder of the browser's memory that it is told. */
#include "fram/live.h"

#include <emscripten.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

typedef struct simulator {
    fram_context *context;
    fram_scenario *scenario;
    fram_world *world;
    fram_error error;
    int64_t end_step;
    char hash[17];
} simulator;

/* How far the making of a world is, to the worker: bindings/wasm/library.js. */
extern void simulator_tell_work(const char *what, double done, double total);

static void tell_work(void *user, const char *what, double done, double total)
{
    (void)user;
    simulator_tell_work(what, done, total);
}

static void tell_log(void *user, fram_log_level level, const char *text)
{
    (void)user;
    fprintf(stderr, "%s%s\n", level == FRAM_LOG_WARNING ? "warning: " : "", text);
}

EMSCRIPTEN_KEEPALIVE simulator *simulator_create(void) { return calloc(1, sizeof(simulator)); }

EMSCRIPTEN_KEEPALIVE void simulator_free(simulator *s)
{
    if (!s)
        return;
    fram_world_destroy(s->world);
    fram_scenario_destroy(s->scenario);
    fram_context_destroy(s->context);
    free(s);
}

/* The world of a scenario's text, whose files stand in `base`, and the first frame of its record in `folder`.  Returns
   a fram_status; simulator_message and the others tell what is wrong. */
EMSCRIPTEN_KEEPALIVE int simulator_begin(simulator *s, const char *text, const char *base, const char *folder)
{
    fram_context_definition definition;
    fram_context_default(&definition);
    definition.log = tell_log;
    definition.verbosity = FRAM_LOG_WARNING;
    definition.work = tell_work;
    fram_record_definition record;
    fram_record_default(&record);
    record.folder = folder;
    fram_status status = fram_context_create(&definition, &s->context, &s->error);
    if (status == FRAM_OK)
        status = fram_scenario_parse(s->context, text, base, NULL, 0, &s->scenario, &s->error);
    if (status == FRAM_OK)
        status = fram_world_create(s->scenario, &s->world, &s->error);
    if (status == FRAM_OK)
        status = fram_world_record(s->world, &record, &s->error);
    /* The step that is nearest, as where `fram run` ends. */
    if (status == FRAM_OK)
        s->end_step = (int64_t)floor(fram_scenario_duration(s->scenario) / fram_scenario_time_step(s->scenario) + 0.5);
    return (int)status;
}

/* Steps for about so many milliseconds, once at least, and not beyond the scenario's end.  Returns a fram_status. */
EMSCRIPTEN_KEEPALIVE int simulator_step(simulator *s, double milliseconds)
{
    double until = emscripten_get_now() + milliseconds;
    fram_status status = FRAM_OK;
    do {
        if (fram_world_steps(s->world) >= s->end_step)
            break;
        status = fram_world_step(s->world, &s->error);
    } while (status == FRAM_OK && emscripten_get_now() < until);
    return (int)status;
}

/* The end of the recording: pictures, tables and the last checkpoint. */
EMSCRIPTEN_KEEPALIVE int simulator_end(simulator *s) { return (int)fram_world_record_end(s->world, NULL, &s->error); }

EMSCRIPTEN_KEEPALIVE double simulator_time(const simulator *s) { return fram_world_time(s->world); }
EMSCRIPTEN_KEEPALIVE double simulator_duration(const simulator *s) { return fram_scenario_duration(s->scenario); }
EMSCRIPTEN_KEEPALIVE int simulator_steps(const simulator *s) { return (int)fram_world_steps(s->world); }
EMSCRIPTEN_KEEPALIVE int simulator_is_over(const simulator *s) { return fram_world_steps(s->world) >= s->end_step; }

EMSCRIPTEN_KEEPALIVE int simulator_floes(const simulator *s)
{
    return fram_world_bodies(s->world, FRAM_SELECT_FLOES, NULL);
}

/* 16 hexadecimal digits, as `fram run --json` prints them. */
EMSCRIPTEN_KEEPALIVE const char *simulator_hash(simulator *s)
{
    snprintf(s->hash, sizeof s->hash, "%016llx", (unsigned long long)fram_world_hash(s->world));
    return s->hash;
}

EMSCRIPTEN_KEEPALIVE const char *simulator_message(const simulator *s) { return s->error.message; }
EMSCRIPTEN_KEEPALIVE const char *simulator_key(const simulator *s) { return s->error.key; }
EMSCRIPTEN_KEEPALIVE const char *simulator_file(const simulator *s) { return s->error.file; }
EMSCRIPTEN_KEEPALIVE int simulator_line(const simulator *s) { return s->error.line; }
EMSCRIPTEN_KEEPALIVE const char *simulator_version(void) { return fram_version(); }
