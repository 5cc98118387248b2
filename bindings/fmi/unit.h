/* What the files of a co-simulation unit share: an instance, its log and its states. */
#ifndef FMI_UNIT_H
#define FMI_UNIT_H

#include "fmi2.h"
#include "fram/live.h"

#include <stdbool.h>

#define FMI_HIDDEN __attribute__((visibility("hidden")))

typedef struct variable {
    bool is_input;
    int index; /* of the world's input or channel */
    double value;
    double told; /* input: what the world holds */
} variable;

typedef struct kept_state kept_state;

typedef struct unit {
    char *name, *folder;
    fmi2CallbackFunctions call;
    bool logging, initialised;
    fram_context *context;
    fram_scenario *scenario;
    fram_world *world;
    variable *variables;
    int count;
    double start;     /* time of the importer at the world's time 0 [s] */
    kept_state *kept; /* all states that the importer holds of this instance */
} unit;

/* A copy of an instance; the importer's handle of one is looked up before anything is read of it. */
struct kept_state {
    kept_state *next;
    fram_world *world;
    double start;
    bool initialised;
    int count;
    variable variables[]; /* so that outputs are as they were, also those of the last step */
};

/* To the importer's logger; what is no warning only while logging is on. */
FMI_HIDDEN void unit_tell(const unit *u, fmi2Status status, const char *category, const char *text);
/* An error, told; returns fmi2Error. */
FMI_HIDDEN fmi2Status unit_fail(const unit *u, const char *text);
FMI_HIDDEN fmi2Status unit_fail_by(const unit *u, const fram_error *e);
/* All states that the importer still holds. */
FMI_HIDDEN void unit_free_states(unit *u);

#endif
