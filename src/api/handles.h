/* What stands behind the public handles. */
#ifndef API_HANDLES_H
#define API_HANDLES_H

#include "api/kept_memory.h"
#include "base/hash.h"
#include "fram/fram.h"
#include "io/text_buffer.h"
#include "model/scenario.h"
#include "results/live_view.h"
#include "sim/controls.h"
#include "sim/recording.h"
#include "sim/series.h"
#include "sim/step.h"

#include <stdatomic.h>
#include <sys/types.h>

struct fram_context {
    context inner;
    fram_log_function log;
    void *log_user;
};

struct fram_scenario {
    fram_context *context;
    scenario inner;
    text_buffer text, notes;
    text_buffer files; /* of the scenario: key, path, each ended by a NUL, one after the other */
    int32_t file_count;
    text_buffer read; /* paths from the root of its own file and of those, each ended by a NUL */
    char hash[SHA256_TEXT_SIZE];
};

/* What the worlds of one scenario that were copied from one another have in common; it never changes while they live,
   but for `users`, which is counted atomically, since they may be on different threads. */
typedef struct world_base {
    atomic_int users;
    model model;
    control_array controls;
    series_layout columns;
    char inputs[SHA256_TEXT_SIZE]; /* run_inputs_digest of the files that the scenario names */
} world_base;

/* In place of the number of calls that read. */
enum { CHANGED_BY_A_CALL = -1 };
/* Of a world, beside its state. */
typedef struct world_aside {
    atomic_int calls; /* that are going on: CHANGED_BY_A_CALL, or how many read the whole state */
    bool row_is_new;  /* the row of all channels tells what is now */
    kept_memory kept;
} world_aside;

struct fram_world {
    const fram_scenario *scenario;
    world_base *base;
    world inner;
    recording *recording; /* NULL: not recorded */
    live_view *live;      /* of the recording; NULL: none */
    pid_t process;        /* that began the recording; its children have no part in it */
    double step_wall;     /* time that the last step took [s] */
    bool failed;          /* the last step did; nothing is stepped from such a state */
    double *row;          /* values of all channels ... */
    world_aside *aside;   /* what const functions may change */
};

/* FRAM_ERROR_USAGE, with the key, where the path is one of a list as fram_scenario has it of what was read: nothing is
   written over that. */
fram_status list_refuse_read(const text_buffer *read, const char *path, const char *key, fram_error *error);
/* A handle without a state, of a base that gets a user more; NULL without memory. */
fram_world *world_handle(const fram_scenario *s, world_base *base);
/* The handle, and the base with its last user; not the state. */
void world_handle_free(fram_world *w);
/* A few words about a channel; "" for one that says it by its name. */
const char *channel_meaning(const char *channel);
/* Room for the values of all channels; false: no memory. */
bool world_make_row(fram_world *w);
/* Fills base->inputs. */
fram_status world_find_inputs(fram_world *w, fram_error *error);
/* A call that changes a world has it to itself: FRAM_ERROR_USAGE when another one is going on that changes it or reads
   all of it, on another thread or around the callback that this one comes from, and for NULL.  world_leave ends it. */
fram_status world_enter(fram_world *w, fram_error *error);
void world_leave(fram_world *w);
/* Calls that read the whole state keep those out that would change it meanwhile, and no others.  FRAM_ERROR_USAGE, or
   false, while one that changes it is going on, and for NULL; world_end_reading ends the others. */
fram_status world_begin_reading(const fram_world *w, fram_error *error);
bool world_reads(const fram_world *w);
void world_end_reading(const fram_world *w);
/* FRAM_ERROR_USAGE while a call that changes the world is going on: there is no state to be told of. */
fram_status world_refuse_taken(const fram_world *w, fram_error *error);
/* The same for functions without a status; false for NULL too. */
bool world_can_be_read(const fram_world *w);
/* FRAM_ERROR_USAGE after a step that failed. */
fram_status world_refuse_failed(const fram_world *w, fram_error *error);
/* A live view of a folder whose address the caller was told; page NULL: none.  FRAM_ERROR_USAGE without `live`. */
fram_status live_open(context *ctx, const char *folder, const char *page, fram_live_function live, void *user,
                      live_view **view, fram_error *error);
/* As callers are told. */
fram_run_result run_answer(const run_result *from);
/* The recording of a world that went wrong, if it has one, is closed as a failed run. */
void recording_abandon(fram_world *w, const fram_error *reason);
/* The row of all channels now. */
const double *world_row(const fram_world *w);
/* What follows from the state is to be found again. */
void world_changed(fram_world *w);
/* What a body is for callers; inline, as whole arrays of bodies are told. */
static inline fram_body_kind world_body_kind(const body_table *b, int32_t slot)
{
    static const fram_body_kind kinds[MATERIAL_COUNT] = {
        [MATERIAL_ICE] = FRAM_BODY_FLOE, [MATERIAL_HULL] = FRAM_BODY_VESSEL, [MATERIAL_WALL] = FRAM_BODY_WALL};
    return b->shape[slot] >= 0 && b->material[slot] < MATERIAL_COUNT ? kinds[b->material[slot]] : FRAM_BODY_OTHER;
}
/* A vector into three numbers of a caller. */
static inline void copy3(double out[3], vec3 v) { out[0] = v.x, out[1] = v.y, out[2] = v.z; }

#endif
