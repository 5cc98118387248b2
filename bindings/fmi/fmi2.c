/* The face of a unit by FMI 2.0: its functions and types; unit.h says what they do. */
#include "fmi2.h"
#include "unit.h"

#include <ctype.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { PATH_ROOM = 4096 };

/* NOLINTBEGIN(readability-non-const-parameter): the standard has these signatures */

/* ---- life ---- */

/* The standard has the message as a format of printf with its arguments; importers that cannot take arguments show the
   format alone, so the text itself is it where it asks for none. */
static void tell(const unit *u, unit_status status, const char *category, const char *text)
{
    ((fmi2CallbackLogger)u->logger)(u->environment, u->name ? u->name : "", (fmi2Status)status, category,
                                    strchr(text, '%') ? "%s" : text, text);
}

/* The byte that two hexadecimal digits stand for; 0 where none stand. */
static char byte_of(const char *text)
{
    if (!isxdigit((unsigned char)text[0]) || !isxdigit((unsigned char)text[1]))
        return '\0';
    const char digits[3] = {text[0], text[1], '\0'};
    return (char)(unsigned char)strtoul(digits, NULL, 16);
}

/* "file:///a%20b" as a path; false when it is none. */
static bool path_of_uri(const char *uri, char out[PATH_ROOM])
{
    const char *at = strncmp(uri, "file://", 7) == 0 ? uri + 7 : strncmp(uri, "file:", 5) == 0 ? uri + 5 : uri;
    if (at != uri && strncmp(at, "localhost/", 10) == 0)
        at += 9;
    bool is_uri = at != uri;
    size_t length = 0;
    for (; *at && length + 1 < PATH_ROOM; at++) {
        char byte = is_uri && *at == '%' ? byte_of(at + 1) : '\0';
        out[length++] = byte ? byte : *at;
        at += byte ? 2 : 0;
    }
    out[length] = '\0';
    return length > 0 && *at == '\0';
}

/* Errors and warnings are told in any case: 2.0 switches debug messages alone. */
static unsigned log_of(fmi2Boolean on, unsigned categories)
{
    return (on ? categories : 0) | UNIT_LOG_WARNING | UNIT_LOG_ERROR;
}

fmi2Component fmi2Instantiate(fmi2String name, fmi2Type type, fmi2String guid, fmi2String resources,
                              const fmi2CallbackFunctions *functions, fmi2Boolean visible, fmi2Boolean logging)
{
    (void)visible;
    char folder[PATH_ROOM];
    unit *u = functions ? unit_new(2) : NULL;
    if (!u)
        return NULL;
    u->environment = functions->componentEnvironment;
    u->logger = (unit_any_function)functions->logger;
    u->tell = tell;
    u->log = log_of(logging, UNIT_LOG_ALL);
    if (type == fmi2CoSimulation)
        return unit_open(u, name, guid, resources && path_of_uri(resources, folder) ? folder : NULL, NULL, 0);
    unit_fail(u, "this unit is for co-simulation");
    unit_free(u);
    return NULL;
}

void fmi2FreeInstance(fmi2Component c) { unit_free(c); }

fmi2Status fmi2SetupExperiment(fmi2Component c, fmi2Boolean tolerance_given, fmi2Real tolerance, fmi2Real start,
                               fmi2Boolean stop_given, fmi2Real stop)
{
    (void)tolerance_given, (void)tolerance;
    return (fmi2Status)unit_set_up(c, "SetupExperiment", start, stop_given ? stop : (double)INFINITY);
}

fmi2Status fmi2EnterInitializationMode(fmi2Component c) { return (fmi2Status)unit_enter_initialization(c); }
fmi2Status fmi2ExitInitializationMode(fmi2Component c) { return (fmi2Status)unit_exit_initialization(c); }
fmi2Status fmi2Terminate(fmi2Component c) { return (fmi2Status)unit_terminate(c); }
fmi2Status fmi2Reset(fmi2Component c) { return (fmi2Status)unit_reset(c); }

fmi2Status fmi2SetDebugLogging(fmi2Component c, fmi2Boolean on, size_t count, const fmi2String categories[])
{
    unit *u = c;
    unsigned sum;
    if (!u || unit_log_categories(u, count, categories, &sum) != UNIT_OK)
        return fmi2Error;
    u->log = log_of(on, sum);
    return fmi2OK;
}

/* ---- steps and variables ---- */

fmi2Status fmi2DoStep(fmi2Component c, fmi2Real now, fmi2Real step, fmi2Boolean no_set_state_before)
{
    (void)no_set_state_before;
    bool early;
    return (fmi2Status)unit_step(c, now, step, &early);
}

fmi2Status fmi2GetReal(fmi2Component c, const fmi2ValueReference references[], size_t count, fmi2Real values[])
{
    return (fmi2Status)unit_get(c, references, count, values);
}
fmi2Status fmi2SetReal(fmi2Component c, const fmi2ValueReference references[], size_t count, const fmi2Real values[])
{
    return (fmi2Status)unit_set(c, references, count, values);
}

#define OTHER_TYPE(type)                                                                                    \
    fmi2Status fmi2Get##type(fmi2Component c, const fmi2ValueReference r[], size_t n, fmi2##type v[])       \
    {                                                                                                       \
        (void)r, (void)v;                                                                                   \
        return (fmi2Status)unit_no_such_type(c, "Get" #type, n);                                            \
    }                                                                                                       \
    fmi2Status fmi2Set##type(fmi2Component c, const fmi2ValueReference r[], size_t n, const fmi2##type v[]) \
    {                                                                                                       \
        (void)r, (void)v;                                                                                   \
        return (fmi2Status)unit_no_such_type(c, "Set" #type, n);                                            \
    }
OTHER_TYPE(Integer)
OTHER_TYPE(Boolean)
OTHER_TYPE(String)

/* ---- states ---- */

fmi2Status fmi2GetFMUstate(fmi2Component c, fmi2FMUstate *state) { return (fmi2Status)unit_state_get(c, state); }
fmi2Status fmi2SetFMUstate(fmi2Component c, fmi2FMUstate state) { return (fmi2Status)unit_state_set(c, state); }
fmi2Status fmi2FreeFMUstate(fmi2Component c, fmi2FMUstate *state) { return (fmi2Status)unit_state_free(c, state); }
fmi2Status fmi2SerializedFMUstateSize(fmi2Component c, fmi2FMUstate state, size_t *size)
{
    return (fmi2Status)unit_state_size(c, state, size);
}
fmi2Status fmi2SerializeFMUstate(fmi2Component c, fmi2FMUstate state, fmi2Byte out[], size_t size)
{
    return (fmi2Status)unit_state_write(c, state, out, size);
}
fmi2Status fmi2DeSerializeFMUstate(fmi2Component c, const fmi2Byte in[], size_t size, fmi2FMUstate *state)
{
    return (fmi2Status)unit_state_read(c, in, size, state);
}

/* ---- the rest ---- */

const char *fmi2GetTypesPlatform(void) { return "default"; }
const char *fmi2GetVersion(void) { return "2.0"; }

fmi2Status fmi2GetDirectionalDerivative(fmi2Component c, const fmi2ValueReference a[], size_t n,
                                        const fmi2ValueReference b[], size_t m, const fmi2Real d[], fmi2Real out[])
{
    (void)a, (void)n, (void)b, (void)m, (void)d, (void)out;
    return (fmi2Status)unit_not_offered(c, "GetDirectionalDerivative");
}
fmi2Status fmi2SetRealInputDerivatives(fmi2Component c, const fmi2ValueReference r[], size_t n, const fmi2Integer o[],
                                       const fmi2Real v[])
{
    (void)r, (void)n, (void)o, (void)v;
    return (fmi2Status)unit_not_offered(c, "SetRealInputDerivatives");
}
fmi2Status fmi2GetRealOutputDerivatives(fmi2Component c, const fmi2ValueReference r[], size_t n, const fmi2Integer o[],
                                        fmi2Real v[])
{
    (void)r, (void)n, (void)o, (void)v;
    return (fmi2Status)unit_not_offered(c, "GetRealOutputDerivatives");
}

/* Steps are done when fmi2DoStep returns. */
fmi2Status fmi2CancelStep(fmi2Component c) { return (fmi2Status)unit_not_offered(c, "CancelStep"); }

fmi2Status fmi2GetStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Status *value)
{
    (void)kind, (void)value;
    return c ? fmi2Discard : fmi2Error;
}
fmi2Status fmi2GetRealStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Real *value)
{
    const unit *u = c;
    if (!u || !value || kind != fmi2LastSuccessfulTime)
        return u ? fmi2Discard : fmi2Error;
    *value = u->finished;
    return fmi2OK;
}
fmi2Status fmi2GetIntegerStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Integer *value)
{
    (void)kind, (void)value;
    return c ? fmi2Discard : fmi2Error;
}
fmi2Status fmi2GetBooleanStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Boolean *value)
{
    if (!c || !value || kind != fmi2Terminated)
        return c ? fmi2Discard : fmi2Error;
    *value = fmi2False;
    return fmi2OK;
}
fmi2Status fmi2GetStringStatus(fmi2Component c, const fmi2StatusKind kind, fmi2String *value)
{
    (void)kind, (void)value;
    return c ? fmi2Discard : fmi2Error;
}
/* NOLINTEND(readability-non-const-parameter) */
