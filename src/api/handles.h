/* What stands behind the public handles. */
#ifndef API_HANDLES_H
#define API_HANDLES_H

#include "fram/fram.h"
#include "io/text_buffer.h"
#include "model/scenario.h"
#include "sim/step.h"

struct fram_context {
    context inner;
    fram_log_function log;
    void *log_user;
};

struct fram_scenario {
    fram_context *context;
    scenario inner;
    text_buffer text, notes;
    char hash[65];
};

struct fram_world {
    const fram_scenario *scenario;
    model model;
    world inner;
};

#endif
