/* A world as a co-simulation unit of FMI 2.0, over include/fram alone.  The unit's folder `resources` holds the
   scenario, its files, and variables.txt: the guid, then "input NAME" or "output NAME" a line, whose number from 0 is
   the value reference.  Inputs are told to the world at the next step, and only when they changed, so that an importer
   that sets all of them in every step does not take orders from the vessel's own controller. */
#include "unit.h"

#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { PATH_ROOM = 4096, VARIABLES_MOST = 4096, LINE_ROOM = 256 };
/* A communication step is a whole multiple of the time step within this share of one. */
#define STEP_TOLERANCE 1e-6

/* NOLINTBEGIN(readability-non-const-parameter): the standard has these signatures */

/* ---- log ---- */

void unit_tell(const unit *u, fmi2Status status, const char *category, const char *text)
{
    if (u->call.logger && (u->logging || status >= fmi2Warning))
        u->call.logger(u->call.componentEnvironment, u->name, status, category, "%s", text);
}

fmi2Status unit_fail(const unit *u, const char *text)
{
    unit_tell(u, fmi2Error, "logStatusError", text);
    return fmi2Error;
}

fmi2Status unit_fail_by(const unit *u, const fram_error *e)
{
    char text[sizeof *e + 40];
    snprintf(text, sizeof text, "%s%s%s%s%s", e->file, e->file[0] ? ": " : "", e->key, e->key[0] ? ": " : "",
             e->message);
    return unit_fail(u, text);
}

static void log_of_library(void *user, fram_log_level level, const char *text)
{
    const unit *u = user;
    if (level == FRAM_LOG_WARNING)
        unit_tell(u, fmi2Warning, "logStatusWarning", text);
    else
        unit_tell(u, fmi2OK, "logAll", text);
}

/* ---- life ---- */

/* "file:///a%20b" as a path; false when it is none. */
static bool path_of_uri(const char *uri, char out[PATH_ROOM])
{
    const char *at = strncmp(uri, "file://", 7) == 0 ? uri + 7 : strncmp(uri, "file:", 5) == 0 ? uri + 5 : uri;
    if (at != uri && strncmp(at, "localhost/", 10) == 0)
        at += 9;
    bool is_uri = at != uri;
    size_t length = 0;
    for (; *at && length + 1 < PATH_ROOM; at++) {
        unsigned byte;
        if (is_uri && *at == '%' && sscanf(at + 1, "%2x", &byte) == 1 && byte != 0) {
            out[length++] = (char)(unsigned char)byte;
            at += 2;
        } else {
            out[length++] = *at;
        }
    }
    while (length > 1 && out[length - 1] == '/')
        length--;
    out[length] = '\0';
    return length > 0 && *at == '\0';
}

static char *copy_text(const char *text)
{
    size_t size = strlen(text) + 1;
    char *copy = malloc(size);
    if (copy)
        memcpy(copy, text, size);
    return copy;
}

/* One line of variables.txt. */
static bool add_variable(unit *u, const char *kind, const char *name)
{
    variable *v = &u->variables[u->count];
    v->is_input = strcmp(kind, "input") == 0;
    v->index = v->is_input ? fram_world_find_input(u->world, name) : fram_world_find_channel(u->world, name);
    u->count++;
    return v->index >= 0;
}

static fmi2Status read_variables(unit *u, FILE *file, const char *guid)
{
    char line[LINE_ROOM], kind[16], name[LINE_ROOM];
    if (!fgets(line, sizeof line, file))
        return unit_fail(u, "resources/variables.txt is empty");
    line[strcspn(line, "\n")] = '\0';
    if (strcmp(line, guid) != 0)
        return unit_fail(u, "the guid of the importer's model description is not that of this unit");
    while (fgets(line, sizeof line, file) && u->count < VARIABLES_MOST) {
        if (sscanf(line, "%15s %255s", kind, name) != 2 || !add_variable(u, kind, name))
            return unit_fail(u, "resources/variables.txt names what the scenario does not have");
    }
    return fmi2OK;
}

/* What the world says now. */
static void refresh(unit *u)
{
    for (int i = 0; i < u->count; i++) {
        variable *v = &u->variables[i];
        if (!v->is_input)
            v->value = fram_world_value(u->world, v->index);
        else
            v->told = fram_world_input_value(u->world, v->index);
    }
}

static void take_inputs(unit *u)
{
    for (int i = 0; i < u->count; i++) {
        if (u->variables[i].is_input)
            u->variables[i].value = u->variables[i].told;
    }
}

/* A new world at its start, in place of the one there is. */
static fmi2Status make_world(unit *u)
{
    fram_error e;
    fram_world *made;
    if (fram_world_create(u->scenario, &made, &e) != FRAM_OK)
        return unit_fail_by(u, &e);
    fram_world_destroy(u->world);
    u->world = made;
    u->initialised = false;
    u->start = 0;
    refresh(u);
    take_inputs(u);
    return fmi2OK;
}

static fmi2Status open_unit(unit *u, const char *guid)
{
    char path[PATH_ROOM + 20];
    fram_error e;
    fram_context_definition d;
    fram_context_default(&d);
    d.log = log_of_library;
    d.log_user = u;
    if (fram_context_create(&d, &u->context, &e) != FRAM_OK)
        return unit_fail_by(u, &e);
    snprintf(path, sizeof path, "%s/scenario.yaml", u->folder);
    if (fram_scenario_load(u->context, path, NULL, 0, &u->scenario, &e) != FRAM_OK)
        return unit_fail_by(u, &e);
    fmi2Status status = make_world(u);
    if (status != fmi2OK)
        return status;
    snprintf(path, sizeof path, "%s/variables.txt", u->folder);
    FILE *file = fopen(path, "r");
    if (!file)
        return unit_fail(u, "resources/variables.txt cannot be read");
    status = read_variables(u, file, guid);
    fclose(file);
    refresh(u);
    take_inputs(u);
    return status;
}

void fmi2FreeInstance(fmi2Component c)
{
    unit *u = c;
    if (!u)
        return;
    unit_free_states(u);
    fram_world_destroy(u->world);
    fram_scenario_destroy(u->scenario);
    fram_context_destroy(u->context);
    free(u->variables);
    free(u->name);
    free(u->folder);
    free(u);
}

fmi2Component fmi2Instantiate(fmi2String name, fmi2Type type, fmi2String guid, fmi2String resources,
                              const fmi2CallbackFunctions *functions, fmi2Boolean visible, fmi2Boolean logging)
{
    (void)visible;
    char folder[PATH_ROOM];
    if (!name || !guid || !resources || !functions)
        return NULL;
    unit *u = calloc(1, sizeof *u);
    if (!u)
        return NULL;
    u->call = *functions;
    u->logging = logging != fmi2False;
    u->name = copy_text(name);
    u->variables = calloc(VARIABLES_MOST, sizeof *u->variables);
    bool good = u->name && u->variables && path_of_uri(resources, folder);
    u->folder = good ? copy_text(folder) : NULL;
    good = good && u->folder;
    if (good && type != fmi2CoSimulation) {
        unit_fail(u, "this unit is for co-simulation");
        good = false;
    }
    if (good && open_unit(u, guid) == fmi2OK)
        return u;
    fmi2FreeInstance(u);
    return NULL;
}

fmi2Status fmi2SetupExperiment(fmi2Component c, fmi2Boolean tolerance_given, fmi2Real tolerance, fmi2Real start,
                               fmi2Boolean stop_given, fmi2Real stop)
{
    unit *u = c;
    (void)tolerance_given;
    (void)tolerance;
    (void)stop_given;
    (void)stop;
    if (!u)
        return fmi2Error;
    if (u->initialised)
        return unit_fail(u, "the experiment is set up before the unit is initialised");
    if (!isfinite(start))
        return unit_fail(u, "the start time is not finite");
    u->start = start;
    return fmi2OK;
}

fmi2Status fmi2EnterInitializationMode(fmi2Component c) { return c ? fmi2OK : fmi2Error; }

/* Inputs that changed, in their order: positioning comes before the orders that it would refuse. */
static fmi2Status tell_inputs(unit *u)
{
    fram_error e;
    for (int i = 0; i < u->count; i++) {
        variable *v = &u->variables[i];
        if (!v->is_input || v->value == v->told)
            continue;
        if (fram_world_set_input(u->world, v->index, v->value, &e) != FRAM_OK)
            return unit_fail_by(u, &e);
        v->told = v->value; /* as the importer sees it: a limited order is not told again */
    }
    return fmi2OK;
}

fmi2Status fmi2ExitInitializationMode(fmi2Component c)
{
    unit *u = c;
    if (!u)
        return fmi2Error;
    u->initialised = true;
    return tell_inputs(u);
}

fmi2Status fmi2Terminate(fmi2Component c) { return c ? fmi2OK : fmi2Error; }

fmi2Status fmi2Reset(fmi2Component c)
{
    unit *u = c;
    return u ? make_world(u) : fmi2Error;
}

/* ---- step ---- */

static fmi2Status refuse_step(const unit *u, double step, double dt)
{
    char text[200];
    snprintf(text, sizeof text,
             "a communication step of %.17g s is no whole multiple of the scenario's time step, %.17g s", step, dt);
    return unit_fail(u, text);
}

fmi2Status fmi2DoStep(fmi2Component c, fmi2Real now, fmi2Real step, fmi2Boolean no_set_state_before)
{
    unit *u = c;
    (void)no_set_state_before;
    if (!u)
        return fmi2Error;
    double dt = fram_scenario_time_step(u->scenario), count = floor(step / dt + 0.5);
    if (!u->initialised)
        return unit_fail(u, "the unit is not initialised: its initialization mode was not left");
    if (!(count >= 1 && count < 1e9 && fabs(step - count * dt) <= STEP_TOLERANCE * dt * count))
        return refuse_step(u, step, dt);
    double own = u->start + fram_world_time(u->world);
    if (!(fabs(now - own) <= 0.01 * dt + 1e-12 * fabs(own))) {
        char text[200];
        snprintf(text, sizeof text, "the step begins at %.17g s, and the unit stands at %.17g s", now, own);
        return unit_fail(u, text);
    }
    fmi2Status status = tell_inputs(u);
    fram_error e;
    for (int64_t i = 0; status == fmi2OK && i < (int64_t)count; i++) {
        if (fram_world_step(u->world, &e) != FRAM_OK)
            status = unit_fail_by(u, &e);
    }
    for (int i = 0; i < u->count; i++) {
        if (!u->variables[i].is_input)
            u->variables[i].value = fram_world_value(u->world, u->variables[i].index);
    }
    return status;
}

/* ---- variables ---- */

static bool is_variable(const unit *u, fmi2ValueReference reference) { return reference < (unsigned)u->count; }

fmi2Status fmi2GetReal(fmi2Component c, const fmi2ValueReference references[], size_t count, fmi2Real values[])
{
    const unit *u = c;
    if (u && count > 0 && (!references || !values))
        return unit_fail(u, "value references or values are NULL");
    for (size_t i = 0; u && i < count; i++) {
        if (!is_variable(u, references[i]))
            return unit_fail(u, "a value reference names no variable");
        values[i] = u->variables[references[i]].value;
    }
    return u ? fmi2OK : fmi2Error;
}

fmi2Status fmi2SetReal(fmi2Component c, const fmi2ValueReference references[], size_t count, const fmi2Real values[])
{
    unit *u = c;
    if (u && count > 0 && (!references || !values))
        return unit_fail(u, "value references or values are NULL");
    for (size_t i = 0; u && i < count; i++) {
        if (!is_variable(u, references[i]) || !u->variables[references[i]].is_input)
            return unit_fail(u, "a value reference names no input");
        if (!isfinite(values[i]))
            return unit_fail(u, "an input is not finite");
    }
    for (size_t i = 0; u && i < count; i++)
        u->variables[references[i]].value = values[i];
    return u ? fmi2OK : fmi2Error;
}

/* There are no variables of these types: none can be asked for. */
static fmi2Status none_of_type(const unit *u, size_t count)
{
    if (!u)
        return fmi2Error;
    return count == 0 ? fmi2OK : unit_fail(u, "all variables of this unit are of type Real");
}

fmi2Status fmi2GetInteger(fmi2Component c, const fmi2ValueReference r[], size_t n, fmi2Integer v[])
{
    (void)r, (void)v;
    return none_of_type(c, n);
}
fmi2Status fmi2GetBoolean(fmi2Component c, const fmi2ValueReference r[], size_t n, fmi2Boolean v[])
{
    (void)r, (void)v;
    return none_of_type(c, n);
}
fmi2Status fmi2GetString(fmi2Component c, const fmi2ValueReference r[], size_t n, fmi2String v[])
{
    (void)r, (void)v;
    return none_of_type(c, n);
}
fmi2Status fmi2SetInteger(fmi2Component c, const fmi2ValueReference r[], size_t n, const fmi2Integer v[])
{
    (void)r, (void)v;
    return none_of_type(c, n);
}
fmi2Status fmi2SetBoolean(fmi2Component c, const fmi2ValueReference r[], size_t n, const fmi2Boolean v[])
{
    (void)r, (void)v;
    return none_of_type(c, n);
}
fmi2Status fmi2SetString(fmi2Component c, const fmi2ValueReference r[], size_t n, const fmi2String v[])
{
    (void)r, (void)v;
    return none_of_type(c, n);
}

/* ---- the rest ---- */

const char *fmi2GetTypesPlatform(void) { return "default"; }
const char *fmi2GetVersion(void) { return "2.0"; }

fmi2Status fmi2SetDebugLogging(fmi2Component c, fmi2Boolean on, size_t count, const fmi2String categories[])
{
    unit *u = c;
    (void)count;
    (void)categories;
    if (!u)
        return fmi2Error;
    u->logging = on != fmi2False;
    return fmi2OK;
}

static fmi2Status not_offered(const unit *u) { return u ? unit_fail(u, "this unit does not offer that") : fmi2Error; }

fmi2Status fmi2GetDirectionalDerivative(fmi2Component c, const fmi2ValueReference a[], size_t n,
                                        const fmi2ValueReference b[], size_t m, const fmi2Real d[], fmi2Real out[])
{
    (void)a, (void)n, (void)b, (void)m, (void)d, (void)out;
    return not_offered(c);
}
fmi2Status fmi2SetRealInputDerivatives(fmi2Component c, const fmi2ValueReference r[], size_t n, const fmi2Integer o[],
                                       const fmi2Real v[])
{
    (void)r, (void)n, (void)o, (void)v;
    return not_offered(c);
}
fmi2Status fmi2GetRealOutputDerivatives(fmi2Component c, const fmi2ValueReference r[], size_t n, const fmi2Integer o[],
                                        fmi2Real v[])
{
    (void)r, (void)n, (void)o, (void)v;
    return not_offered(c);
}

/* Steps are done when fmi2DoStep returns. */
fmi2Status fmi2CancelStep(fmi2Component c) { return not_offered(c); }

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
    *value = u->start + fram_world_time(u->world);
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
