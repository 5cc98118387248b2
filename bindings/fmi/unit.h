/* An instance of a co-simulation unit, whatever the version of the standard: a world, its variables, what may be called
   when, steps, states and the log, over include/fram alone.  fmi2.c and fmi3.c are the faces of it: they know the
   standard's names and types, and nothing else does.

   What both versions say and is kept here: a call that the state of an instance does not allow, or whose arguments
   cannot be, is an error; after an error an instance can be read, set to a state it was in before, reset and freed. */
#ifndef FMI_UNIT_H
#define FMI_UNIT_H

#include "fram/live.h"

#include <fenv.h>
#include <stdbool.h>
#include <stdint.h>

#define FMI_HIDDEN __attribute__((visibility("hidden")))

/* As both versions number them. */
typedef enum unit_status { UNIT_OK, UNIT_WARNING, UNIT_DISCARD, UNIT_ERROR } unit_status;

/* States of the standard's machine. */
typedef enum unit_phase {
    UNIT_INSTANTIATED,
    UNIT_INITIALIZING, /* "initialization mode" */
    UNIT_STEPPING,     /* "step mode", in 2.0 "step complete" */
    UNIT_INTERMEDIATE, /* the importer looks on between two internal steps; 3.0 alone */
    UNIT_TERMINATED,   /* by the importer, or after an error */
    UNIT_PHASES
} unit_phase;

/* Categories of the log, as the model description names them; sums of these. */
enum { UNIT_LOG_WARNING = 1, UNIT_LOG_ERROR = 2, UNIT_LOG_REST = 4, UNIT_LOG_ALL = 7 };

typedef enum variable_kind { VARIABLE_INPUT, VARIABLE_OUTPUT, VARIABLE_TIME } variable_kind;
/* What an input is to others of its vessel. */
typedef enum input_role { INPUT_ALONE, INPUT_TOW, INPUT_SET_POINT, INPUT_POSITIONING, INPUT_ORDER } input_role;
typedef struct variable {
    variable_kind kind;
    int index; /* of the world's input or channel */
    double value;
    double told;       /* input: what the world holds */
    bool is_looked_at; /* may be read while the importer looks on */
    bool is_due;       /* input: to be told before the next step */
    bool path_ends;    /* the first of its vessel: one of those that end its path is to be told */
    input_role role;
    int vessel; /* number of the first variable of the same vessel, or of the world */
} variable;

enum { UNIT_TOKEN_ROOM = 40 }; /* {8-4-4-4-12 hexadecimal digits} */
typedef struct kept_state kept_state;
typedef struct unit unit;

typedef void (*unit_any_function)(void); /* the importer's, of the type that its version gives it */

struct unit {
    int version;                 /* of the standard: 2 or 3 */
    char *name;                  /* the importer's, of the instance */
    char *folder;                /* resources */
    char token[UNIT_TOKEN_ROOM]; /* of the unit: scenario, files and variables */
    void *environment;           /* the importer's */
    unit_any_function logger, update;
    void (*tell)(const unit *u, unit_status status, const char *category, const char *text); /* the face's, to logger */
    /* The face's: let the importer look on at `time` after an internal step.  While may_return, *return_at may be set
       to the time where the importer wants the step to end early.  NULL: nobody looks. */
    void (*look)(unit *u, double time, bool may_return, double *return_at);
    unsigned log;
    bool may_return_early;
    fenv_t of_importer; /* its arithmetic, during a step */
    bool is_looked_on;  /* the importer's function runs within a step, whatever the phase became in it */
    unit_phase phase;
    fram_context *context;
    fram_scenario *scenario;
    fram_world *world;
    variable *variables;
    int count;
    bool is_set_up;   /* start and stop were told */
    double start;     /* time of the importer at the world's time 0 [s] */
    double stop;      /* of the importer; infinite when it told none [s] */
    double reached;   /* the end of the last time step that succeeded, of the importer [s] */
    double finished;  /* the same of the last communication step [s] */
    kept_state *kept; /* all states that the importer holds of this instance */
};

/* ---- log ---- */

/* To the importer's logger, if it listens to the status's category. */
FMI_HIDDEN void unit_tell(const unit *u, unit_status status, const char *text);
/* The same of what the library says, with the importer's time where the world's is another. */
FMI_HIDDEN void unit_tell_of_world(const unit *u, unit_status status, const char *text);
/* An error, told: the instance is terminated by it.  Returns UNIT_ERROR. */
FMI_HIDDEN unit_status unit_fail(unit *u, const char *text);
FMI_HIDDEN unit_status unit_fail_by(unit *u, const fram_error *e);
/* Something that the standard has and this unit has not: u may be NULL. */
FMI_HIDDEN unit_status unit_not_offered(unit *u, const char *call);
/* The sum of the named categories; all for none. */
FMI_HIDDEN unit_status unit_log_categories(unit *u, size_t count, const char *const names[], unsigned *sum);

/* ---- arithmetic ---- */

/* The library rounds to the nearest, and compares with what is not a number where nothing was given: importers that
   trap such exceptions, or round elsewhere, find both as they were.  About all that the library computes. */
FMI_HIDDEN void unit_arithmetic_begin(fenv_t *of_importer);
FMI_HIDDEN void unit_arithmetic_end(const fenv_t *of_importer);

/* ---- life ---- */

/* Fills what a face has set up (version, environment, functions, log) with the unit in `folder`; NULL when that cannot
   be, with the reason told, and u is freed.  token: the importer's, from the model description; references: of what it
   may read while it looks on. */
FMI_HIDDEN unit *unit_open(unit *u, const char *name, const char *token, const char *folder,
                           const uint32_t references[], size_t count);
FMI_HIDDEN void unit_free(unit *u);
/* An instance for a face to set up; NULL without memory. */
FMI_HIDDEN unit *unit_new(int version);
/* Scenario, world and variables of u->folder. */
FMI_HIDDEN unit_status unit_read_resources(unit *u, const char *token);

/* What follows takes u NULL for an error. */

/* That the call may be made now; phases: sum of 1 << unit_phase.  call: its name without the version's prefix. */
FMI_HIDDEN unit_status unit_allow(unit *u, unsigned phases, const char *call);
/* Times of the importer; stop infinite when it tells none. */
FMI_HIDDEN unit_status unit_set_up(unit *u, const char *call, double start, double stop);
/* After unit_set_up. */
FMI_HIDDEN unit_status unit_enter_initialization(unit *u);
FMI_HIDDEN unit_status unit_exit_initialization(unit *u);
FMI_HIDDEN unit_status unit_terminate(unit *u);
/* As it was when it was instantiated. */
FMI_HIDDEN unit_status unit_reset(unit *u);
/* A new world at its start, in place of the one there is. */
FMI_HIDDEN unit_status unit_make_world(unit *u);
/* Variables as the world says them now, inputs too. */
FMI_HIDDEN void unit_read_start(unit *u);

/* ---- variables ---- */

FMI_HIDDEN unit_status unit_get(unit *u, const uint32_t references[], size_t count, double values[]);
FMI_HIDDEN unit_status unit_set(unit *u, const uint32_t references[], size_t count, const double values[]);
/* There are no variables of other types: none can be asked for. */
FMI_HIDDEN unit_status unit_no_such_type(unit *u, const char *call, size_t count);

/* ---- steps ---- */

/* Time of the importer where the unit stands [s]. */
FMI_HIDDEN double unit_time(const unit *u);
/* From `now` on by `step`, a whole multiple of the scenario's time step.  *early: it ended before its end, as the
   importer wanted; u->reached tells where.  After a time step that failed the unit stands, and is read, at its end. */
FMI_HIDDEN unit_status unit_step(unit *u, double now, double step, bool *early);

/* ---- states ---- */

FMI_HIDDEN unit_status unit_state_get(unit *u, void **state);
FMI_HIDDEN unit_status unit_state_set(unit *u, const void *state);
FMI_HIDDEN unit_status unit_state_free(unit *u, void **state);
FMI_HIDDEN unit_status unit_state_size(unit *u, const void *state, size_t *size);
FMI_HIDDEN unit_status unit_state_write(unit *u, const void *state, void *out, size_t size);
FMI_HIDDEN unit_status unit_state_read(unit *u, const void *in, size_t size, void **state);
/* All states that the importer still holds. */
FMI_HIDDEN void unit_free_states(unit *u);

#endif
