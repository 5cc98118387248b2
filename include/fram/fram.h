/* Fram: vessels in sea ice.  The public C API.

   A context holds what a program lends to Fram (memory, log, threads).  A scenario is read once and never changes; a
   world is everything that moves.  Step a world yourself, or let fram_run drive it and write results:

       fram_context *context;
       fram_scenario *scenario;
       fram_world *world;
       fram_error error;
       fram_context_create(NULL, &context, &error);
       fram_scenario_load(context, "demo.yaml", NULL, 0, &scenario, &error);
       fram_world_create(scenario, &world, &error);
       while (fram_world_time(world) < 10 && fram_world_step(world, &error) == FRAM_OK)
           ;

   Every call that can fail returns a fram_status and fills the caller's fram_error (which may be NULL).  On failure the
   out-pointers are left alone (an interrupted run fills its result).  A NULL where a pointer is needed, or a definition
   that its default function did not fill, is FRAM_ERROR_USAGE, and a number that cannot be (NaN, infinite, out of
   range) an error that names it as key; functions without a status return 0, false, "" or NaN for NULL, or do nothing.
   What may be NULL says so, and so may the result of runs, exports and pages.  Objects are not locked: use one world
   from one thread at a time; worlds of different contexts are independent.  A context must outlive its scenarios, a
   scenario its worlds.

   Structs.  A program that was built with older headers runs with a newer library: structs grow at their ends alone,
   and the library is told how long the program's is.  A definition carries its size, which its default function sets. A
   function that fills a struct, or a list of them, is told it as last argument by a macro of its own name: in C there
   is nothing to do, and a language without the headers passes the size of its struct (of a row of its list).  The
   library writes no byte more.  A size that no version had (too short, longer than the library's) is FRAM_ERROR_USAGE
   with the struct's name as key; functions without a status then fill nothing and return 0 or false.  What is handed by
   value (fram_body_id), stands inside another struct or in a list of the library's (fram_level, fram_cycle), and
   fram_error keep their form; what a callback is handed is the library's own.

   Relative paths start from the working folder of the call that is given them; what a scenario or a recording has read
   or begun stays there when that folder changes.  Texts and files have decimal points in every locale.

   Units are SI.  Global frame: X, Y horizontal, Z up, still water at z = 0.  Body frame of a vessel: x forward, y to
   port, z up, origin at the centre of mass.  Quaternions are w, x, y, z and turn body coordinates into global ones. */
#ifndef FRAM_FRAM_H
#define FRAM_FRAM_H

#include "fram/error.h"
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#if defined(__GNUC__)
#define FRAM_API __attribute__((visibility("default")))
#else
#define FRAM_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Version ---- */

/* "0.1.0" */
FRAM_API const char *fram_version(void);
/* Optional parts of this build with their versions, separated by commas ("cairo 1.16.0, ..."); "none". */
FRAM_API const char *fram_features(void);
/* One word for a status: "ok", "usage", "input", ... */
FRAM_API const char *fram_status_name(fram_status status);

/* ---- Context ---- */

typedef struct fram_context fram_context;

typedef enum fram_log_level { FRAM_LOG_ERROR, FRAM_LOG_WARNING, FRAM_LOG_INFO, FRAM_LOG_DEBUG } fram_log_level;

/* realloc's contract: ptr NULL allocates, size 0 frees and returns NULL; NULL otherwise means no memory.  A context of
   more than one thread calls it from several at once. */
typedef void *(*fram_memory_function)(void *user, void *ptr, size_t size);
typedef void (*fram_log_function)(void *user, fram_log_level level, const char *text);
/* How far the making of a world or a field is: `done` of `total`; total 0: rounds that are done, of nobody knows how
   many.  what: "packing the ice", valid during the call.  Called often: look at the clock before you draw. */
typedef void (*fram_work_function)(void *user, const char *what, double done, double total);

/* A part of Fram's work: the block, from 0, of a job that a fram_parallel_function was given.  worker: from 0 to the
   context's threads - 1, no two calls at a time with the same. */
typedef void (*fram_task_function)(void *task, int block, int worker);
/* A task system of the program's own.  Calls run(task, b, worker) once for each b from 0 to blocks - 1, in any order,
   on any threads, and returns when all these calls have returned.  Called from the thread that called the library, a
   few to some hundred times a step, with blocks of some microseconds each; never nested, nor for two jobs of a context
   at once. Of the program's functions, tasks call `memory` alone. */
typedef void (*fram_parallel_function)(void *user, int blocks, fram_task_function run, void *task);

enum { FRAM_THREADS = 256 }; /* the most threads of a context */

typedef struct fram_context_definition {
    size_t size;                 /* of this struct, set by fram_context_default */
    fram_memory_function memory; /* NULL: the C library's */
    void *memory_user;
    fram_log_function log; /* NULL: silent */
    void *log_user;
    fram_log_level verbosity;
    int threads;              /* 1 to FRAM_THREADS, the caller's included; results never depend on it */
    const char *isa;          /* "baseline", "avx2", "avx512", or NULL for the best; results never depend on it */
    const volatile int *stop; /* non-zero: making a world, a field or a file of a run, reading the series of one or of a
                                 CSV file, and a bootstrap of its extremes end with FRAM_INTERRUPTED; may be NULL */
    fram_work_function work;  /* NULL: silent */
    void *work_user;
    fram_parallel_function parallel; /* in place of threads of Fram's own, of which there are none then; `threads` says
                                        how many workers it has.  NULL: Fram's own.  A call that breaks the contract is
                                        not let in, and steps fail from then on: FRAM_ERROR_USAGE, key "parallel" */
    void *parallel_user;
} fram_context_definition;

FRAM_API void fram_context_default(fram_context_definition *definition, size_t size);
#define fram_context_default(definition) fram_context_default((definition), sizeof *(definition))
/* definition NULL: the defaults (one thread, no log). */
FRAM_API fram_status fram_context_create(const fram_context_definition *definition, fram_context **context,
                                         fram_error *error);
FRAM_API void fram_context_destroy(fram_context *context);

/* ---- Scenario ---- */

typedef struct fram_scenario fram_scenario;

/* Read and check a scenario file.  overrides: texts "key=value" as on the command line, applied in order. */
FRAM_API fram_status fram_scenario_load(fram_context *context, const char *path, const char *const *overrides,
                                        int override_count, fram_scenario **scenario, fram_error *error);
/* The effective scenario as YAML text, every default filled in; valid until the scenario is destroyed. */
FRAM_API const char *fram_scenario_text(const fram_scenario *scenario);
/* What follows from the scenario for a reader's eye (lengths, loads, thresholds, warnings), as text; same lifetime. */
FRAM_API const char *fram_scenario_notes(const fram_scenario *scenario);
/* What follows for the vessel, once its hull is made: FRAM_ERROR_INPUT with the key for what cannot be (as a run would
   find), warnings of what a run would meet (capsizing, springs too stiff for the step, a wall) to the log.  The ice is
   not made. */
FRAM_API fram_status fram_scenario_check(const fram_scenario *scenario, fram_error *error);
/* 64 hexadecimal digits that name the effective scenario. */
FRAM_API const char *fram_scenario_hash(const fram_scenario *scenario);
FRAM_API double fram_scenario_duration(const fram_scenario *scenario);  /* [s] */
FRAM_API double fram_scenario_time_step(const fram_scenario *scenario); /* [s] */
FRAM_API void fram_scenario_destroy(fram_scenario *scenario);
/* Every key with unit, default, range and meaning, as Markdown.  The caller frees it with fram_text_free. */
FRAM_API fram_status fram_scenario_reference(fram_context *context, char **markdown, fram_error *error);
FRAM_API void fram_text_free(fram_context *context, char *text);

/* ---- World ---- */

typedef struct fram_world fram_world;

/* A body; an id stays valid while its body lives and never names another one. */
typedef struct fram_body_id {
    int32_t slot; /* counts from 0 */
    uint32_t generation;
} fram_body_id;

typedef enum fram_body_kind { FRAM_BODY_FLOE, FRAM_BODY_VESSEL, FRAM_BODY_WALL, FRAM_BODY_OTHER } fram_body_kind;

typedef struct fram_body_state {
    fram_body_kind kind;
    bool dynamic;               /* moved by forces; false: static or driven */
    double mass;                /* [kg] */
    double position[3];         /* centre of mass, global [m] */
    double orientation[4];      /* w x y z */
    double velocity[3];         /* global [m/s] */
    double angular_velocity[3]; /* global [rad/s] */
} fram_body_state;

/* Means over the last step of what the ice does to a vessel: forces [N], moments [N m] about its centre of mass, global
 * frame. */
typedef struct fram_ice_load {
    double force[3], moment[3];
    double capped[3];    /* part of force: normal contact at the crushing limit */
    double below_cap[3]; /* part of force: normal contact below it */
    double friction[3];  /* part of force */
    int contacts;
} fram_ice_load;

FRAM_API fram_status fram_world_create(const fram_scenario *scenario, fram_world **world, fram_error *error);
FRAM_API void fram_world_destroy(fram_world *world);
/* As fram_scenario_notes, by what was made of the scenario where its keys do not tell: the floes of a file, and where a
   vessel on its mooring begins.  For a world before its first step; the caller frees the text with fram_text_free. */
FRAM_API fram_status fram_world_notes(const fram_world *world, char **text, fram_error *error);
/* One time step.  FRAM_ERROR_SIMULATION when the state is no longer finite. */
FRAM_API fram_status fram_world_step(fram_world *world, fram_error *error);
FRAM_API double fram_world_time(const fram_world *world); /* [s] */
FRAM_API int64_t fram_world_steps(const fram_world *world);
/* 64-bit hash of the whole state: equal states, equal hashes. */
FRAM_API uint64_t fram_world_hash(const fram_world *world);

/* Bodies are counted by slot; a slot may be empty. */
FRAM_API int fram_world_slots(const fram_world *world);
/* False for an empty slot. */
FRAM_API bool fram_world_body(const fram_world *world, int slot, fram_body_id *id);
/* The first vessel; false without one. */
FRAM_API bool fram_world_vessel(const fram_world *world, fram_body_id *id);
/* How many vessels there are: those of the scenario that are present, in its order. */
FRAM_API int fram_world_vessels(const fram_world *world);
/* One of them by its number, from 0; false for a number that there is not. */
FRAM_API bool fram_world_vessel_at(const fram_world *world, int vessel, fram_body_id *id);
/* One of them by its name in the scenario, and the name of one: "" when it has none, NULL when it is not there.  The
   text lives as long as the scenario. */
FRAM_API bool fram_world_vessel_named(const fram_world *world, const char *name, fram_body_id *id);
FRAM_API const char *fram_world_vessel_name(const fram_world *world, int vessel);
/* FRAM_ERROR_USAGE when the body lives no more. */
FRAM_API fram_status fram_body_state_get(const fram_world *world, fram_body_id body, fram_body_state *state,
                                         fram_error *error, size_t size);
#define fram_body_state_get(...) fram_body_state_get(__VA_ARGS__, sizeof(fram_body_state))
/* Plan outline of a floe or wall: its number of vertices, and up to `room` of them in global coordinates (x, y pairs);
   0 for other bodies. */
FRAM_API int fram_body_outline(const fram_world *world, fram_body_id body, double *xy, int room);
/* An extra force [N] and moment [N m] about the centre of mass, global frame, on a dynamic body in the next step only;
   calls add up. */
FRAM_API fram_status fram_body_apply_wrench(fram_world *world, fram_body_id body, const double force[3],
                                            const double moment[3], fram_error *error);
/* FRAM_ERROR_USAGE when the body is no vessel. */
FRAM_API fram_status fram_world_ice_load(const fram_world *world, fram_body_id vessel, fram_ice_load *load,
                                         fram_error *error, size_t size);
#define fram_world_ice_load(...) fram_world_ice_load(__VA_ARGS__, sizeof(fram_ice_load))

/* ---- Runs ---- */

typedef struct fram_progress {
    double time, end;        /* simulated [s] */
    double wall;             /* since the start of this call [s] */
    double eta;              /* expected wall time to the end [s]; NaN in the first second, when it is not known */
    double real_time_factor; /* simulated over wall time */
} fram_progress;
typedef void (*fram_progress_function)(void *user, const fram_progress *progress);

/* Told once, when a run may be looked on at: the address to open in a browser on this machine, which lasts as long as
   the call.  Whoever knows it can see the run, and change nothing. */
typedef void (*fram_live_function)(void *user, const char *address);

typedef struct fram_run_definition {
    size_t size;        /* of this struct, set by fram_run_default */
    const char *folder; /* where results go; made when missing */
    bool force;         /* write into a folder that is not empty */
    bool with_paths;    /* the record, and so pages made of it, tells where input files lie; otherwise names alone */
    double until;       /* stop at this simulated time with a checkpoint; <= 0: run to the end of the scenario */
    fram_progress_function progress; /* called a few times a second at most; may be NULL */
    void *progress_user;
    const volatile int *stop; /* non-zero: write a checkpoint, once the world is made, and return FRAM_INTERRUPTED;
                                 NULL: the context's, while the world is made */
    const char *live_page;    /* the page without a run (make viewer): the run can be looked on at while it goes, until
                                 this call ends.  NULL: it cannot.  FRAM_ERROR_UNSUPPORTED without libmicrohttpd */
    fram_live_function live;  /* called before the world is made; must be there with live_page */
    void *live_user;
} fram_run_definition;

typedef struct fram_run_result {
    uint64_t state_hash;
    int64_t steps;           /* of the whole run so far */
    double time;             /* simulated [s] */
    double wall;             /* of this call [s] */
    double real_time_factor; /* of this call */
    int bodies, floes;
    bool finished; /* the scenario's end was reached */
} fram_run_result;

FRAM_API void fram_run_default(fram_run_definition *definition, size_t size);
#define fram_run_default(definition) fram_run_default((definition), sizeof *(definition))
/* Run a scenario from its start and write time series, record, pictures and checkpoints to definition->folder.
   FRAM_ERROR_USAGE, key "output", also with `force`, where that would be written over the file that the scenario was
   read from, or one that it names. */
FRAM_API fram_status fram_run(const fram_scenario *scenario, const fram_run_definition *definition,
                              fram_run_result *result, fram_error *error, size_t size);
#define fram_run(...) fram_run(__VA_ARGS__, sizeof(fram_run_result))
/* Continue the run in definition->folder from its newest good checkpoint; refuses changed inputs. */
FRAM_API fram_status fram_resume(fram_context *context, const fram_run_definition *definition, fram_run_result *result,
                                 fram_error *error, size_t size);
#define fram_resume(...) fram_resume(__VA_ARGS__, sizeof(fram_run_result))

/* ---- Playback ---- */

typedef struct fram_playback_definition {
    size_t size;             /* of this struct, set by fram_playback_default */
    const char *folder;      /* of the run */
    const char *viewer_page; /* the page without a run (make viewer) */
    const char *output;      /* the page to write, best NAME.html */
    uint64_t page_limit;     /* largest page [bytes]; 0: 50 MB.  Frames of a longer run go into files beside it, in the
                                folder NAME-frames; a page that goes into a stream has none:
                                FRAM_ERROR_USAGE */
    uint64_t total_limit;    /* page and files [bytes]; 0: 500 MB.  Above, only every n-th frame is kept */
    const char *pressure;    /* folder that fram_pressure wrote of this run, to be shown on the hull; NULL: none */
} fram_playback_definition;

typedef struct fram_playback_result {
    int64_t frames, left_out; /* kept and not */
    int64_t files;            /* beside the page */
} fram_playback_result;

FRAM_API void fram_playback_default(fram_playback_definition *definition, size_t size);
#define fram_playback_default(definition) fram_playback_default((definition), sizeof *(definition))
/* A page that plays a run in a browser, from disk, without a network.  result may be NULL. */
FRAM_API fram_status fram_playback(fram_context *context, const fram_playback_definition *definition,
                                   fram_playback_result *result, fram_error *error, size_t size);
#define fram_playback(...) fram_playback(__VA_ARGS__, sizeof(fram_playback_result))

/* ---- Benchmark ---- */

typedef struct fram_bench_result {
    int64_t steps;
    int floes;
    double ms_per_step_median;              /* CPU time of a step, all threads [ms] */
    double ms_wall_median;                  /* [ms] */
    double us_per_floe_step;                /* [us] */
    double collide_ms, solve_ms, forces_ms; /* CPU time of the parts of a step, medians [ms] */
    double real_time_factor;
    double contact_points; /* that overlap, mean per step */
    double pairs;          /* of bodies that overlap, mean per step */
    double loaded_pairs;   /* of bodies that press on one another, mean per step */
    double mean_penetration_m, max_penetration_m;
    double ship_force_kN; /* mean ice load against the ship's x axis */
    double kinetic_energy_J;
    double solver_residual; /* mean over the steps [m/s] */
    uint64_t state_hash;
    /* CPU time of a step, all threads, and wall time: mean, and nearest ranks [ms] */
    double ms_mean, ms_p99, ms_p999, ms_longest;
    double ms_wall_p99, ms_wall_p999, ms_wall_longest;
    /* Parts of the CPU time of all steps [1]; what is left is bookkeeping */
    double share_forces, share_collision, share_crushing, share_solver, share_fracture;
} fram_bench_result;

/* Step a scenario's world for `time` seconds after `warm` seconds of warm-up, without output, and measure. */
FRAM_API fram_status fram_bench(const fram_scenario *scenario, double warm, double time, fram_bench_result *result,
                                fram_error *error, size_t size);
#define fram_bench(...) fram_bench(__VA_ARGS__, sizeof(fram_bench_result))

/* A benchmark scene in the text format that other engines read too (bench/peers/README.md): its own simple water, a box
   ship at constant speed, walls; every floe awake. */
typedef struct fram_bench_scene_definition {
    size_t size;        /* of this struct, set by fram_bench_scene_default */
    double time_step;   /* [s] */
    double warm, time;  /* simulated seconds: unmeasured, and in all */
    int iterations;     /* of the solver, for velocities and for positions */
    const char *solver; /* "sequential", "fast", "accurate" */
    const char *dump;   /* file for the final poses, NULL: none */
    int exact_water;    /* not 0: Fram's own water, with the scene's coefficients */
} fram_bench_scene_definition;
FRAM_API void fram_bench_scene_default(fram_bench_scene_definition *definition, size_t size);
#define fram_bench_scene_default(definition) fram_bench_scene_default((definition), sizeof *(definition))
/* FRAM_ERROR_INPUT with file and line for a scene that cannot be read. */
FRAM_API fram_status fram_bench_scene(fram_context *context, const char *path,
                                      const fram_bench_scene_definition *definition, fram_bench_result *result,
                                      fram_error *error, size_t size);
#define fram_bench_scene(...) fram_bench_scene(__VA_ARGS__, sizeof(fram_bench_result))

#ifdef __cplusplus
}
#endif
#endif
