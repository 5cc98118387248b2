/* Fram: a world inside another program.  What `fram run` does to a world, a program that steps it can do: record it in
   a run folder, save, load and copy it to the bit, read it by channels and whole arrays, and steer it.

       int surge = fram_world_find_channel(world, "velocity_x");
       int thrust = fram_world_find_input(world, "thruster_1_order");
       fram_world_set_input(world, fram_world_find_input(world, "positioning"), 0, &error);
       while (fram_world_time(world) < 60) {
           fram_world_set_input(world, thrust, controller(fram_world_value(world, surge)), &error);
           fram_world_step(world, &error);
       }

   Rules about statuses, errors, units and frames stand in fram.h.

   Memory.  Arrays that a call fills belong to the caller and need no alignment beyond that of their type; a count that
   is larger than the room says that the rest was left out.  Pointers of a view (fram_world_view) belong to the world.
   Callbacks but `memory` are called from the thread that called the library, never from one of its own, and during that
   call alone; their user pointer is handed back as it is.  They must not call functions on the same world or context,
   and return: a C++ exception or longjmp that leaves one leaves the call half done, with its memory, a world that
   counts as busy and a run folder that is locked for good.  Set a stop flag, and raise what happened when the call has
   returned.

   Threads.  One world from one thread at a time.  A call on a world while another one changes it (steps, loads, tells
   or records it), on another thread or from a callback of it, is refused where it is seen: FRAM_ERROR_USAGE with key
   "world", functions without a status as for NULL, and fram_world_destroy does nothing.  So is a call that would change
   a world while another one copies, saves or hashes it, or reads whole arrays of it; several may do so at once.

   Worlds of one context may be used from different threads at once when its memory and log functions can be called so;
   the C library's can.  The context's threads then work for one of them at a time, and the others' work is done by the
   threads that called.

   A child of fork() has the worlds of its parent as they were, and none of the threads: a context's, a task system's
   too, do nothing there, and the child's one thread does all, to the same bits; a context that the child makes has
   threads of its own.  A world that another thread of the parent was changing stays refused in the child.

   After a step that went wrong (any status but FRAM_ERROR_USAGE) the world can be read, copied, saved and destroyed; to
   step it again is FRAM_ERROR_USAGE until a good state was loaded.  What it saves, as a run's failed.fram, leaves the
   world that loads it as failed.  A step that was made and could not be recorded is an error too, FRAM_ERROR_IO where a
   disk is full: the recording ends as that of a failed run, and the world goes on from that step.  A call of this
   header that fails changes nothing, unless it says so.

   Older programs run with a newer library, whose structs may have more members at their ends; fram.h says how. */
#ifndef FRAM_LIVE_H
#define FRAM_LIVE_H

#include "fram/fram.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Stop flag ---- */

/* Set a stop flag, as definitions name it, from any thread or signal handler without a data race (a relaxed atomic
   store; the library reads flags in the same way).  NULL: nothing happens. */
FRAM_API void fram_stop_set(volatile int *stop, int value);

/* ---- Scenarios ---- */

/* Read and check a scenario from YAML text.  base: folder that relative paths of the text start from; NULL: the working
   folder.  In errors the file is "(text)" in that folder.  overrides as in fram_scenario_load; may be NULL with 0. */
FRAM_API fram_status fram_scenario_parse(fram_context *context, const char *text, const char *base,
                                         const char *const *overrides, int override_count, fram_scenario **scenario,
                                         fram_error *error);
/* Files that the scenario names, as absolute paths, and the key of each; NULL for a number (from 0) that is none. Valid
   until the scenario is destroyed. */
FRAM_API const char *fram_scenario_file(const fram_scenario *scenario, int number);
FRAM_API const char *fram_scenario_file_key(const fram_scenario *scenario, int number);

/* ---- States ---- */

/* A second world in the same state, steered and recorded apart; with the same contacts, loads and channels of the last
   step.  It is not recorded.  The scenario must outlive both; destroy it like any world. */
FRAM_API fram_status fram_world_copy(const fram_world *world, fram_world **copy, fram_error *error);
/* The whole state with all inputs, as bytes of the context's memory, for fram_data_free; the same state gives the same
   bytes, recorded or not.  What belongs to the last step alone (contacts, fractures, channels that are made of them) is
   no part of it and is empty after loading until the next step. */
FRAM_API fram_status fram_world_save_memory(const fram_world *world, void **data, size_t *size, fram_error *error);
/* Take over a state of the same scenario, files (what is in them, wherever they lie) and version: one that was saved
   here, or a run's checkpoint (checkpoint-*.fram in its folder), from which the world goes on as the resumed run does.
   FRAM_ERROR_INPUT, and the world stays as it is, for any other and for damaged bytes.  FRAM_ERROR_USAGE while the
   world is recorded.  A run is not resumed from a state that was saved here. */
FRAM_API fram_status fram_world_load_memory(fram_world *world, const void *data, size_t size, fram_error *error);
/* The same in a file, which is there whole or not at all.  Not over the scenario's own file, nor one that it names:
   FRAM_ERROR_USAGE, key "path". */
FRAM_API fram_status fram_world_save(const fram_world *world, const char *path, fram_error *error);
FRAM_API fram_status fram_world_load(fram_world *world, const char *path, fram_error *error);
FRAM_API void fram_data_free(fram_context *context, void *data);

/* ---- Channels: every column of series.csv ---- */

typedef struct fram_channel {
    int index;
    const char *name;    /* "ice_force_x"; these texts live as long as the world */
    const char *unit;    /* "N", "1" without one */
    const char *meaning; /* a few words; "" for a channel that says it by its name */
} fram_channel;
FRAM_API int fram_world_channels(const fram_world *world);
FRAM_API fram_status fram_world_channel(const fram_world *world, int index, fram_channel *channel, fram_error *error,
                                        size_t size);
#define fram_world_channel(...) fram_world_channel(__VA_ARGS__, sizeof(fram_channel))
/* -1: there is none of this name. */
FRAM_API int fram_world_find_channel(const fram_world *world, const char *name);
/* Now; NaN for an index that is none. */
FRAM_API double fram_world_value(const fram_world *world, int index);
/* Of all channels in their order, up to `room`; returns how many there are. */
FRAM_API int fram_world_values(const fram_world *world, double *values, int room);

/* ---- Whole arrays ---- */

/* Selects bodies: any of these together, 0: all that live. */
enum {
    FRAM_SELECT_FLOES = 1 << FRAM_BODY_FLOE,
    FRAM_SELECT_VESSELS = 1 << FRAM_BODY_VESSEL,
    FRAM_SELECT_WALLS = 1 << FRAM_BODY_WALL,
    FRAM_SELECT_OTHERS = 1 << FRAM_BODY_OTHER
};

/* Where to put what; any pointer may be NULL.  Rows ascend with the slot. */
typedef struct fram_body_arrays {
    int room; /* rows of each array */
    fram_body_id *id;
    int32_t *kind;            /* fram_body_kind */
    int32_t *number;          /* running number of a floe, never used twice; -1 for others */
    int32_t *parent;          /* number of the floe that it broke from; -1 */
    double *mass;             /* [kg] */
    double *thickness;        /* of a floe or wall; 0 for others [m] */
    double *position;         /* 3 each: centre of mass, global [m] */
    double *orientation;      /* 4 each: w x y z */
    double *velocity;         /* 3 each: global [m/s] */
    double *angular_velocity; /* 3 each: global [rad/s] */
} fram_body_arrays;
/* Returns how many bodies are selected; of those the first `room` are written. */
FRAM_API int fram_world_bodies(const fram_world *world, unsigned selection, const fram_body_arrays *arrays,
                               size_t size);
#define fram_world_bodies(...) fram_world_bodies(__VA_ARGS__, sizeof(fram_body_arrays))

/* Plan outlines of the selected floes and walls, in the same order, bodies without one having no vertices: those of row
   i are xy[2 * offset[i]] to before xy[2 * offset[i + 1]], global [m].  offset has bodies + 1 numbers, xy 2 * points;
   either may be NULL with its room 0.  Returns the vertices of all; *bodies (may be NULL) how many are selected. */
FRAM_API int fram_world_outlines(const fram_world *world, unsigned selection, int32_t *offset, int offset_room,
                                 double *xy, int point_room, int *bodies);

/* Plan outlines by slot, as rows of a view, in the axes of each body: x and y about its centre of mass [m]; global are
   position + orientation applied to (x, y, 0).  offset has slots + 1 numbers, xy 2 * points; either may be NULL with
   its room 0; slots where nobody lives and bodies without an outline have no vertices.  Returns the vertices of all. */
FRAM_API int fram_world_shapes(const fram_world *world, int32_t *offset, int offset_room, double *xy, int point_room);
/* A number that is another one whenever a body came or went, a floe broke or was trimmed, or a state was loaded: as
   long as it stays, so does what fram_world_shapes gave.  Of worlds that were copied from one another not comparable.
 */
FRAM_API uint64_t fram_world_shape_changes(const fram_world *world);

/* The world's own memory, by slot: no copy.  Rows of slots where nobody lives have no meaning.  After a step or a load
   it tells the new state, unless the bodies needed more room: then the memory of this view tells the state before, for
   as long as the world lives, and another view tells the new one.  To ask for a view costs less than a microsecond. */
typedef struct fram_body_view {
    int slots;
    const double *position;         /* 3 each: centre of mass, global [m] */
    const double *orientation;      /* 4 each: w x y z */
    const double *velocity;         /* 3 each [m/s] */
    const double *angular_velocity; /* 3 each [rad/s] */
    const double *mass;             /* [kg] */
    const uint32_t *generation;
    const uint8_t *lives; /* 0: nobody */
    /* The number of fram_world_shape_changes, kept up to date where it points for as long as the world lives: read it
       after a step, without a call.  While it stays, so do this view and what fram_world_shapes gave. */
    const uint64_t *changes;
} fram_body_view;
FRAM_API fram_status fram_world_view(const fram_world *world, fram_body_view *view, fram_error *error, size_t size);
#define fram_world_view(...) fram_world_view(__VA_ARGS__, sizeof(fram_body_view))

typedef enum fram_contact_limit {
    FRAM_CONTACT_BELOW = 0, /* the normal impulse is below its limit, or has none */
    FRAM_CONTACT_CRUSHING   /* capped: the ice is crushed there */
} fram_contact_limit;
/* A point where two bodies touched in the last step; one that broke in it lives no more. */
typedef struct fram_contact {
    fram_body_id a, b;
    double point[3];   /* global [m] */
    double normal[3];  /* unit, from b towards a */
    double impulse[3]; /* on a in the step, global; its opposite on b [N s] */
    double normal_impulse;
    double limit; /* of the normal impulse; infinite without one [N s] */
    double depth; /* overlap; negative: open by so much [m] */
    fram_contact_limit capped;
} fram_contact;
/* Returns how many there are; up to `room` of them are written to contacts, which may be NULL with room 0. */
FRAM_API int fram_world_contacts(const fram_world *world, fram_contact *contacts, int room, size_t size);
#define fram_world_contacts(...) fram_world_contacts(__VA_ARGS__, sizeof(fram_contact))

typedef enum fram_fracture_kind {
    FRAM_FRACTURE_SPLIT = 1,
    FRAM_FRACTURE_BENDING = 2,
    FRAM_FRACTURE_RELEASE = 3 /* of a part of a level sheet */
} fram_fracture_kind;
/* A floe that broke in the last step. */
typedef struct fram_fracture {
    fram_fracture_kind kind;
    int32_t floe;                /* running number of the one that broke */
    int32_t first_piece, pieces; /* numbers of the pieces: the first, and how many follow one another */
    double place[3];             /* where the first crack starts, global [m] */
    double load;                 /* [N] */
    double crack_length;         /* [m] */
    double stress_ratio;         /* stress over strength [1] */
    double floe_area, pieces_area, area_lost, area_gained; /* [m2] */
} fram_fracture;
/* As fram_world_contacts. */
FRAM_API int fram_world_fractures(const fram_world *world, fram_fracture *fractures, int room, size_t size);
#define fram_world_fractures(...) fram_world_fractures(__VA_ARGS__, sizeof(fram_fracture))

/* ---- Inputs ---- */

/* Inputs stay as they were told until told again; they are part of the state.  Which there are follows from the
   scenario: wind_x, wind_y, current_x, current_y [m/s]; ice_drift_x, ice_drift_y [m/s] with an endless field or level
   ice that drifts; for the vessel outside_force_x to outside_moment_z [N, N m], tow_velocity_x, tow_velocity_y [m/s]
   while it is towed or driven, set_point_x, set_point_y [m], set_point_heading [deg] of a free one (not of one with
   propulsion and no thrusters, which goes by its track; with positioning.control: heading the heading alone, with
   positioning.heading: vaning no heading) and positioning (1 or 0) where it has thrusters; thruster_1_order [N],
   thruster_1_order_angle [deg] (not of a tunnel, nor of a main without a rudder) ... while positioning is 0;
   line_1_release (1) ...  Those of a list of vessels begin with the name and a point: NAME.set_point_x. */
FRAM_API int fram_world_inputs(const fram_world *world);
FRAM_API fram_status fram_world_input(const fram_world *world, int index, fram_channel *input, fram_error *error,
                                      size_t size);
#define fram_world_input(...) fram_world_input(__VA_ARGS__, sizeof(fram_channel))
/* -1: there is none of this name. */
FRAM_API int fram_world_find_input(const fram_world *world, const char *name);
/* What was told, or what holds without; NaN for an index that is none. */
FRAM_API double fram_world_input_value(const fram_world *world, int index);
/* For the next step and all after it.  FRAM_ERROR_INPUT, with the input's name as key, for a number that cannot be. */
FRAM_API fram_status fram_world_set_input(fram_world *world, int index, double value, fram_error *error);
/* A path of a vessel (from 0) from where it is now: `count` places (x, y of the ship's origin, heading: m, m, rad) at
   times that ascend from now on.  A towed or driven vessel moves along it linearly, and turns the shorter way to the
   first place, by whole turns too after that; the set point of a free one jumps to each place at its time.  count 0: no
   path any more, and a towed or driven vessel goes on as fast as it went along it, or stands where it stood; times and
   places may be NULL.  FRAM_ERROR_INPUT, key "times", where the way to a place would take a towed or driven vessel, or
   the turn to it the vessel's rim, to run.speed_limit.  FRAM_ERROR_USAGE, key "vessel", for a path of one with
   propulsion and no thrusters, which goes by its track, or with control: heading and heading: vaning, which follows
   neither places nor headings. */
FRAM_API fram_status fram_world_set_path(fram_world *world, int vessel, const double *times, const double *places,
                                         int count, fram_error *error);

/* ---- Recording ---- */

typedef struct fram_record_definition {
    size_t size;           /* of this struct, set by fram_record_default */
    const char *folder;    /* where results go; made when missing */
    bool force;            /* write into a folder that is not empty */
    bool with_paths;       /* the record tells where input files lie; otherwise names alone */
    const char *live_page; /* as in fram_run_definition: until the recording ends */
    fram_live_function live;
    void *live_user;
} fram_record_definition;
FRAM_API void fram_record_default(fram_record_definition *definition, size_t size);
#define fram_record_default(definition) fram_record_default((definition), sizeof *(definition))
/* From now on each step is recorded: time series, record, pictures and checkpoints come when the scenario's `output`
   says.  A world that is recorded from its start leaves what fram_run leaves, but for wall times.  One recording a
   world; in a child that fork() made there is none, and the parent's goes on. */
FRAM_API fram_status fram_world_record(fram_world *world, const fram_record_definition *definition, fram_error *error);
FRAM_API bool fram_world_is_recorded(const fram_world *world);
/* A checkpoint of now, from which fram_resume can go on (without what is told to the world later): it is on the disk
   when this returns. */
FRAM_API fram_status fram_world_checkpoint(fram_world *world, fram_error *error);
/* The end: last checkpoint, pictures, results.  The world goes on unrecorded.  result may be NULL.  Whatever is
   returned, the recording is closed.  A world that is destroyed while it is recorded ends it so; a step that fails ends
   it as a failed run. */
FRAM_API fram_status fram_world_record_end(fram_world *world, fram_run_result *result, fram_error *error, size_t size);
#define fram_world_record_end(...) fram_world_record_end(__VA_ARGS__, sizeof(fram_run_result))

#ifdef __cplusplus
}
#endif
#endif
