/* The face of a unit by FMI 3.0, for co-simulation: its functions and types; unit.h says what they do. */
#include "fmi3.h"
#include "unit.h"

#include <math.h>

/* NOLINTBEGIN(readability-non-const-parameter): the standard has these signatures */

/* ---- life ---- */

static void tell(const unit *u, unit_status status, const char *category, const char *text)
{
    ((fmi3LogMessageCallback)u->logger)(u->environment, (fmi3Status)status, category, text);
}

/* An instance that is not made is told of, whatever was asked for. */
static fmi3Instance refuse(unit *u, const char *text)
{
    u->log = UNIT_LOG_ERROR;
    unit_fail(u, text);
    unit_free(u);
    return NULL;
}

static unit *set_up(fmi3InstanceEnvironment environment, fmi3LogMessageCallback logger, fmi3Boolean logging)
{
    unit *u = unit_new(3);
    if (u) {
        u->environment = environment;
        u->logger = (unit_any_function)logger;
        u->tell = tell;
        u->log = logging ? UNIT_LOG_ALL : 0;
    }
    return u;
}

static void look(unit *u, double time, bool may_return, double *return_at)
{
    fmi3Boolean wanted = false;
    fmi3Float64 wanted_time = time;
    ((fmi3IntermediateUpdateCallback)u->update)(u->environment, time, false, true, true, may_return, &wanted,
                                                &wanted_time);
    if (may_return && wanted)
        *return_at = isfinite(wanted_time) ? wanted_time : time;
}

fmi3Instance fmi3InstantiateCoSimulation(fmi3String name, fmi3String token, fmi3String resources, fmi3Boolean visible,
                                         fmi3Boolean logging, fmi3Boolean event_mode, fmi3Boolean early_return,
                                         const fmi3ValueReference intermediate[], size_t intermediate_count,
                                         fmi3InstanceEnvironment environment, fmi3LogMessageCallback logger,
                                         fmi3IntermediateUpdateCallback update)
{
    (void)visible;
    unit *u = set_up(environment, logger, logging);
    if (!u)
        return NULL;
    if (event_mode)
        return refuse(u, "this unit has no event mode");
    u->may_return_early = early_return;
    u->update = (unit_any_function)update;
    u->look = update ? look : NULL;
    return unit_open(u, name, token, resources, intermediate, intermediate_count);
}

fmi3Instance fmi3InstantiateModelExchange(fmi3String name, fmi3String token, fmi3String resources, fmi3Boolean visible,
                                          fmi3Boolean logging, fmi3InstanceEnvironment environment,
                                          fmi3LogMessageCallback logger)
{
    (void)name, (void)token, (void)resources, (void)visible;
    unit *u = set_up(environment, logger, logging);
    return u ? refuse(u, "this unit is for co-simulation, not for model exchange") : NULL;
}

fmi3Instance fmi3InstantiateScheduledExecution(fmi3String name, fmi3String token, fmi3String resources,
                                               fmi3Boolean visible, fmi3Boolean logging,
                                               fmi3InstanceEnvironment environment, fmi3LogMessageCallback logger,
                                               fmi3ClockUpdateCallback clock, fmi3LockPreemptionCallback lock,
                                               fmi3UnlockPreemptionCallback unlock)
{
    (void)name, (void)token, (void)resources, (void)visible, (void)clock, (void)lock, (void)unlock;
    unit *u = set_up(environment, logger, logging);
    return u ? refuse(u, "this unit is for co-simulation, not for scheduled execution") : NULL;
}

void fmi3FreeInstance(fmi3Instance c) { unit_free(c); }

fmi3Status fmi3EnterInitializationMode(fmi3Instance c, fmi3Boolean tolerance_given, fmi3Float64 tolerance,
                                       fmi3Float64 start, fmi3Boolean stop_given, fmi3Float64 stop)
{
    (void)tolerance_given, (void)tolerance;
    unit_status status = unit_set_up(c, "EnterInitializationMode", start, stop_given ? stop : (double)INFINITY);
    return (fmi3Status)(status == UNIT_OK ? unit_enter_initialization(c) : status);
}

fmi3Status fmi3ExitInitializationMode(fmi3Instance c) { return (fmi3Status)unit_exit_initialization(c); }
fmi3Status fmi3Terminate(fmi3Instance c) { return (fmi3Status)unit_terminate(c); }
fmi3Status fmi3Reset(fmi3Instance c) { return (fmi3Status)unit_reset(c); }

const char *fmi3GetVersion(void) { return "3.0"; }

fmi3Status fmi3SetDebugLogging(fmi3Instance c, fmi3Boolean on, size_t count, const fmi3String categories[])
{
    unit *u = c;
    unsigned sum;
    if (!u || unit_log_categories(u, count, categories, &sum) != UNIT_OK)
        return fmi3Error;
    u->log = on ? u->log | sum : u->log & ~sum;
    return fmi3OK;
}

/* ---- variables and steps ---- */

static bool is_scalar(unit *u, size_t references, size_t values)
{
    if (u && references != values)
        unit_fail(u, "there are as many values as value references: all variables of this unit are scalars");
    return u && references == values;
}

fmi3Status fmi3GetFloat64(fmi3Instance c, const fmi3ValueReference references[], size_t count, fmi3Float64 values[],
                          size_t value_count)
{
    return is_scalar(c, count, value_count) ? (fmi3Status)unit_get(c, references, count, values) : fmi3Error;
}

fmi3Status fmi3SetFloat64(fmi3Instance c, const fmi3ValueReference references[], size_t count,
                          const fmi3Float64 values[], size_t value_count)
{
    return is_scalar(c, count, value_count) ? (fmi3Status)unit_set(c, references, count, values) : fmi3Error;
}

fmi3Status fmi3DoStep(fmi3Instance c, fmi3Float64 now, fmi3Float64 step, fmi3Boolean no_set_state_before,
                      fmi3Boolean *event, fmi3Boolean *terminate, fmi3Boolean *early_return, fmi3Float64 *reached)
{
    (void)no_set_state_before;
    unit *u = c;
    if (!u)
        return fmi3Error;
    if (!event || !terminate || !early_return || !reached)
        return (fmi3Status)unit_fail(u, "where fmi3DoStep is to tell how it went is NULL");
    *event = *terminate = false;
    unit_status status = unit_step(u, now, step, early_return);
    *reached = u->reached;
    return (fmi3Status)status;
}

/* ---- states ---- */

fmi3Status fmi3GetFMUState(fmi3Instance c, fmi3FMUState *state) { return (fmi3Status)unit_state_get(c, state); }
fmi3Status fmi3SetFMUState(fmi3Instance c, fmi3FMUState state) { return (fmi3Status)unit_state_set(c, state); }
fmi3Status fmi3FreeFMUState(fmi3Instance c, fmi3FMUState *state) { return (fmi3Status)unit_state_free(c, state); }
fmi3Status fmi3SerializedFMUStateSize(fmi3Instance c, fmi3FMUState state, size_t *size)
{
    return (fmi3Status)unit_state_size(c, state, size);
}
fmi3Status fmi3SerializeFMUState(fmi3Instance c, fmi3FMUState state, fmi3Byte out[], size_t size)
{
    return (fmi3Status)unit_state_write(c, state, out, size);
}
fmi3Status fmi3DeserializeFMUState(fmi3Instance c, const fmi3Byte in[], size_t size, fmi3FMUState *state)
{
    return (fmi3Status)unit_state_read(c, in, size, state);
}

/* NOLINTEND(readability-non-const-parameter) */
