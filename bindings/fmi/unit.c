/* realpath is of X/Open, not of POSIX alone */
#define _XOPEN_SOURCE 700
/* Log, life and calling order of an instance.  Inputs are told to the world at the next step, and only when they, or
   others that count together with them, changed, so that an importer that sets all of them in every step does not take
   orders from the vessel's own controller. */
#include "unit.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- log ---- */

static const struct {
    unsigned bit;
    const char *name;
} categories[] = {
    {UNIT_LOG_WARNING, "logStatusWarning"}, {UNIT_LOG_ERROR, "logStatusError"}, {UNIT_LOG_REST, "logAll"}};
enum { CATEGORIES = sizeof categories / sizeof *categories, TEXT_ROOM = 2 * sizeof(fram_error) + 400 };

void unit_tell(const unit *u, unit_status status, const char *text)
{
    int row = status == UNIT_OK ? 2 : status == UNIT_ERROR ? 1 : 0;
    if (!u->logger || !(u->log & categories[row].bit))
        return;
    char told[TEXT_ROOM];
    size_t length = 0;
    for (; *text && length + 2 < sizeof told; text++) { /* # begins a reference to a variable: ## is the character */
        if (*text == '#')
            told[length++] = '#';
        told[length++] = *text;
    }
    told[length] = '\0';
    u->tell(u, status, categories[row].name, told);
}

unit_status unit_fail(unit *u, const char *text)
{
    u->phase = UNIT_TERMINATED;
    unit_tell(u, UNIT_ERROR, text);
    return UNIT_ERROR;
}

/* Times of the world count from the importer's start: behind them, where that is not 0, the importer's own time. */
static void add_time(const unit *u, char *text, size_t room)
{
    bool goes_on = u->phase == UNIT_INITIALIZING || u->phase == UNIT_STEPPING;
    size_t length = strlen(text);
    if (goes_on && u->start != 0)
        snprintf(text + length, room - length, " (importer's time %.2f s)", unit_time(u));
}

void unit_tell_of_world(const unit *u, unit_status status, const char *text)
{
    char whole[TEXT_ROOM];
    snprintf(whole, sizeof whole, "%s", text);
    add_time(u, whole, sizeof whole);
    unit_tell(u, status, whole);
}

unit_status unit_fail_by(unit *u, const fram_error *e)
{
    char text[sizeof *e + 100], line[16] = "";
    if (e->line > 0)
        snprintf(line, sizeof line, ":%d", e->line);
    snprintf(text, sizeof text, "%s%s%s%s%s%s", e->file, line, e->file[0] ? ": " : "", e->key, e->key[0] ? ": " : "",
             e->message);
    add_time(u, text, sizeof text);
    return unit_fail(u, text);
}

/* "fmi3DoStep", then what is wrong with it. */
static unit_status fail_call(unit *u, const char *call, const char *text)
{
    char whole[300];
    snprintf(whole, sizeof whole, "fmi%d%s: %s", u->version, call, text);
    return unit_fail(u, whole);
}

unit_status unit_not_offered(unit *u, const char *call)
{
    return u ? fail_call(u, call, "this unit does not offer that") : UNIT_ERROR;
}

unit_status unit_no_such_type(unit *u, const char *call, size_t count)
{
    if (!u)
        return UNIT_ERROR;
    if (count == 0)
        return UNIT_OK;
    return fail_call(u, call,
                     u->version == 2 ? "all variables of this unit are of type Real"
                                     : "all variables of this unit are of type Float64");
}

unit_status unit_log_categories(unit *u, size_t count, const char *const names[], unsigned *sum)
{
    *sum = count == 0 ? UNIT_LOG_ALL : 0;
    if (count > 0 && !names)
        return unit_fail(u, "the categories of the log are NULL");
    for (size_t i = 0; i < count; i++) {
        int row = 0;
        while (row < CATEGORIES && names[i] && strcmp(names[i], categories[row].name) != 0)
            row++;
        if (row == CATEGORIES || !names[i]) {
            char text[200];
            snprintf(text, sizeof text,
                     "the log has the categories logStatusWarning, logStatusError and logAll, not %.80s",
                     names[i] ? names[i] : "NULL");
            return unit_fail(u, text);
        }
        *sum |= categories[row].bit == UNIT_LOG_REST ? UNIT_LOG_ALL : categories[row].bit;
    }
    return UNIT_OK;
}

/* ---- arithmetic ---- */

void unit_arithmetic_begin(fenv_t *of_importer)
{
    fegetenv(of_importer);
    fesetenv(FE_DFL_ENV);
}

void unit_arithmetic_end(const fenv_t *of_importer) { fesetenv(of_importer); }

/* ---- life ---- */

unit *unit_new(int version)
{
    unit *u = calloc(1, sizeof *u);
    if (u) {
        u->version = version;
        u->stop = (double)INFINITY;
    }
    return u;
}

void unit_free(unit *u)
{
    if (!u)
        return;
    if (u->is_looked_on) { /* its step goes on when the importer's function returns */
        unit_fail(u, "an instance is not freed while it makes a step");
        return;
    }
    unit_free_states(u);
    fram_world_destroy(u->world);
    fram_scenario_destroy(u->scenario);
    fram_context_destroy(u->context);
    free(u->variables);
    free(u->name);
    free(u->folder);
    free(u);
}

static bool are_variables(const unit *u, const uint32_t references[], size_t count)
{
    for (size_t i = 0; i < count; i++) {
        if (references[i] >= (uint32_t)u->count)
            return false;
    }
    return true;
}

/* That these are outputs, and may be read while the importer looks on. */
static unit_status look_at(unit *u, const uint32_t references[], size_t count)
{
    if (count > 0 && !references)
        return unit_fail(u, "the intermediate variables are NULL");
    for (size_t i = 0; i < count; i++) {
        if (!are_variables(u, &references[i], 1) || u->variables[references[i]].kind == VARIABLE_INPUT)
            return unit_fail(u, "an intermediate variable is no output of this unit");
        u->variables[references[i]].is_looked_at = true;
    }
    return UNIT_OK;
}

static unit *open_unit(unit *u, const char *name, const char *token, const char *folder, const uint32_t references[],
                       size_t count)
{
    unsigned log = u->log;
    u->log |= UNIT_LOG_ERROR; /* why there is no instance is told in any case */
    u->name = strdup(name ? name : "");
    u->folder = folder ? realpath(folder, NULL) : NULL; /* the working folder may change */
    unit_status status = UNIT_ERROR;
    if (!u->name)
        unit_fail(u, "there is no memory left");
    else if (!u->name[strspn(u->name, " \t\r\n")])
        unit_fail(u, "the instance has no name");
    else if (!token)
        unit_fail(u, "the unit's token is NULL");
    else if (!u->folder)
        unit_fail(u, folder ? "the folder of the unit's resources is not there" : "there is no path of resources");
    else
        status = unit_read_resources(u, token);
    if (status == UNIT_OK)
        status = look_at(u, references, count);
    u->log = log;
    if (status == UNIT_OK)
        return u;
    unit_free(u);
    return NULL;
}

unit *unit_open(unit *u, const char *name, const char *token, const char *folder, const uint32_t references[],
                size_t count)
{
    fenv_t of_importer;
    unit_arithmetic_begin(&of_importer);
    unit *opened = open_unit(u, name, token, folder, references, count);
    unit_arithmetic_end(&of_importer);
    return opened;
}

unit_status unit_allow(unit *u, unsigned phases, const char *call)
{
    static const char *const names[UNIT_PHASES] = {"before it enters the initialization mode",
                                                   "in the initialization mode", "between its steps", "during a step",
                                                   "after it was terminated, or after an error"};
    if (!u)
        return UNIT_ERROR;
    if (phases & 1U << u->phase)
        return UNIT_OK;
    char text[120];
    snprintf(text, sizeof text, "this is not to be called %s", names[u->phase]);
    return fail_call(u, call, text);
}

unit_status unit_set_up(unit *u, const char *call, double start, double stop)
{
    unit_status status = unit_allow(u, 1U << UNIT_INSTANTIATED, call);
    if (status != UNIT_OK)
        return status;
    if (!isfinite(start))
        return fail_call(u, call, "the start time is not finite");
    if (!isgreater(stop, start)) /* as >, but raises no exception, which the importer may trap, for a stop of NaN */
        return fail_call(u, call, "the stop time is not after the start time");
    u->start = u->reached = u->finished = start;
    u->stop = stop;
    u->is_set_up = true;
    return UNIT_OK;
}

unit_status unit_enter_initialization(unit *u)
{
    static const char call[] = "EnterInitializationMode";
    unit_status status = unit_allow(u, 1U << UNIT_INSTANTIATED, call);
    if (status == UNIT_OK && !u->is_set_up)
        return fail_call(u, call, "this is not to be called before fmi2SetupExperiment");
    if (status == UNIT_OK)
        u->phase = UNIT_INITIALIZING;
    return status;
}

/* An order to a thruster of the vessel whose input `positioning` is the other one. */
static bool is_order_of(const variable *v, const variable *positioning)
{
    return positioning && v->role == INPUT_ORDER && v->vessel == positioning->vessel;
}

static unit_status tell_input(unit *u, variable *v)
{
    fram_error e;
    if (fram_world_set_input(u->world, v->index, v->value, &e) != FRAM_OK)
        return unit_fail_by(u, &e);
    v->told = v->value; /* as the importer sees it: a limited order is not told again */
    v->is_due = false;
    return UNIT_OK;
}

static bool has_changed(const variable *v) { return v->kind == VARIABLE_INPUT && v->value != v->told; }

/* Parts of a tow velocity or of a set point, of which a vessel has one: to tell a part ends the vessel's path. */
static bool is_of_path(const variable *v) { return v->role == INPUT_TOW || v->role == INPUT_SET_POINT; }

/* Inputs that changed, and those whose path ends with that: where it has led meanwhile is not what the importer says.
 */
static void find_due(unit *u)
{
    for (int i = 0; i < u->count; i++) {
        u->variables[i].is_due = has_changed(&u->variables[i]);
        u->variables[i].path_ends = false;
    }
    for (int i = 0; i < u->count; i++) {
        const variable *v = &u->variables[i];
        if (v->is_due && is_of_path(v))
            u->variables[v->vessel].path_ends = true;
    }
    for (int i = 0; i < u->count; i++) {
        variable *v = &u->variables[i];
        if (is_of_path(v) && u->variables[v->vessel].path_ends &&
            v->value != fram_world_input_value(u->world, v->index))
            v->is_due = true;
    }
}

/* A tow velocity is judged with both axes as they are: those that become smaller go first, or one that grows would be
   judged with what the other is no more. */
static unit_status tell_slower(unit *u)
{
    unit_status status = UNIT_OK;
    for (int i = 0; i < u->count && status == UNIT_OK; i++) {
        variable *v = &u->variables[i];
        if (v->is_due && v->role == INPUT_TOW && fabs(v->value) < fabs(fram_world_input_value(u->world, v->index)))
            status = tell_input(u, v);
    }
    return status;
}

/* Inputs that are due, in their order: positioning comes before the orders that it would refuse.  When the vessel's own
   controller hands over, its thrusters have its last orders, and the importer's, changed or not, take their place. */
static unit_status tell_inputs(unit *u)
{
    const variable *handed_over = NULL;
    find_due(u);
    unit_status status = tell_slower(u);
    for (int i = 0; i < u->count && status == UNIT_OK; i++) {
        variable *v = &u->variables[i];
        if (!v->is_due && !is_order_of(v, handed_over))
            continue;
        status = tell_input(u, v);
        if (v->value == 0 && v->role == INPUT_POSITIONING)
            handed_over = v;
    }
    return status;
}

unit_status unit_exit_initialization(unit *u)
{
    unit_status status = unit_allow(u, 1U << UNIT_INITIALIZING, "ExitInitializationMode");
    fenv_t of_importer;
    unit_arithmetic_begin(&of_importer);
    if (status == UNIT_OK)
        status = tell_inputs(u);
    unit_arithmetic_end(&of_importer);
    if (status == UNIT_OK)
        u->phase = UNIT_STEPPING;
    return status;
}

unit_status unit_terminate(unit *u)
{
    unit_status status = unit_allow(u, 1U << UNIT_STEPPING, "Terminate");
    if (status == UNIT_OK)
        u->phase = UNIT_TERMINATED;
    return status;
}

/* Outputs as the world says them now. */
static void read_outputs(unit *u)
{
    for (int i = 0; i < u->count; i++) {
        if (u->variables[i].kind == VARIABLE_OUTPUT)
            u->variables[i].value = fram_world_value(u->world, u->variables[i].index);
    }
}

/* The name of an input; how long that of its vessel is, with the point. */
static const char *input_name(const unit *u, const variable *v, size_t *vessel)
{
    fram_channel input;
    *vessel = 0;
    if (v->kind != VARIABLE_INPUT || fram_world_input(u->world, v->index, &input, NULL) != FRAM_OK)
        return "";
    const char *point = strrchr(input.name, '.');
    *vessel = point ? (size_t)(point + 1 - input.name) : 0;
    return input.name;
}

static input_role role_of(const char *name)
{
    static const struct {
        const char *begin;
        input_role role;
    } roles[] = {{"tow_velocity_", INPUT_TOW},
                 {"set_point_", INPUT_SET_POINT},
                 {"positioning", INPUT_POSITIONING},
                 {"thruster_", INPUT_ORDER}};
    for (size_t i = 0; i < sizeof roles / sizeof *roles; i++) {
        if (strncmp(name, roles[i].begin, strlen(roles[i].begin)) == 0)
            return roles[i].role;
    }
    return INPUT_ALONE;
}

/* Which inputs belong together: names tell, once, since each step asks. */
static void find_roles(unit *u)
{
    for (int i = 0; i < u->count; i++) {
        variable *v = &u->variables[i];
        size_t length, other;
        const char *name = input_name(u, v, &length);
        v->role = role_of(name + length);
        v->vessel = i;
        for (int k = i - 1; k >= 0 && v->vessel == i; k--) {
            const char *before = input_name(u, &u->variables[k], &other);
            if (other == length && strncmp(before, name, length) == 0)
                v->vessel = u->variables[k].vessel;
        }
    }
}

void unit_read_start(unit *u)
{
    read_outputs(u);
    find_roles(u);
    for (int i = 0; i < u->count; i++) {
        variable *v = &u->variables[i];
        if (v->kind == VARIABLE_INPUT)
            v->value = v->told = fram_world_input_value(u->world, v->index);
    }
}

unit_status unit_make_world(unit *u)
{
    fram_error e;
    fram_world *made;
    u->phase = UNIT_INSTANTIATED; /* before anything is told of the new world, which has no time yet */
    if (fram_world_create(u->scenario, &made, &e) != FRAM_OK)
        return unit_fail_by(u, &e);
    fram_world_destroy(u->world);
    u->world = made;
    u->is_set_up = false;
    u->start = u->reached = u->finished = 0;
    u->stop = (double)INFINITY;
    unit_read_start(u);
    return UNIT_OK;
}

unit_status unit_reset(unit *u)
{
    unit_status status = unit_allow(u, ~(1U << UNIT_INTERMEDIATE), "Reset");
    fenv_t of_importer;
    unit_arithmetic_begin(&of_importer);
    if (status == UNIT_OK)
        status = unit_make_world(u);
    unit_arithmetic_end(&of_importer);
    return status;
}

/* ---- variables ---- */

static unit_status fail_reference(unit *u, uint32_t reference, const char *what)
{
    char text[120];
    snprintf(text, sizeof text, "value reference %u %s", (unsigned)reference, what);
    return unit_fail(u, text);
}

unit_status unit_get(unit *u, const uint32_t references[], size_t count, double values[])
{
    if (!u)
        return UNIT_ERROR;
    if (count > 0 && (!references || !values))
        return unit_fail(u, "value references or values are NULL");
    for (size_t i = 0; i < count; i++) {
        if (!are_variables(u, &references[i], 1))
            return fail_reference(u, references[i], "names no variable");
    }
    for (size_t i = 0; i < count; i++) {
        const variable *v = &u->variables[references[i]];
        if (u->phase == UNIT_INTERMEDIATE && !v->is_looked_at)
            return fail_reference(u, references[i],
                                  "is read during a step and was not asked for when the unit was instantiated");
        values[i] = v->kind == VARIABLE_TIME ? unit_time(u) : v->value;
    }
    return UNIT_OK;
}

unit_status unit_set(unit *u, const uint32_t references[], size_t count, const double values[])
{
    if (!u)
        return UNIT_ERROR;
    const unsigned phases = 1U << UNIT_INSTANTIATED | 1U << UNIT_INITIALIZING | 1U << UNIT_STEPPING;
    unit_status status = unit_allow(u, phases, u->version == 2 ? "SetReal" : "SetFloat64");
    if (status != UNIT_OK)
        return status;
    if (count > 0 && (!references || !values))
        return unit_fail(u, "value references or values are NULL");
    for (size_t i = 0; i < count; i++) {
        if (!are_variables(u, &references[i], 1) || u->variables[references[i]].kind != VARIABLE_INPUT)
            return fail_reference(u, references[i], "names no input");
        if (!isfinite(values[i]))
            return fail_reference(u, references[i], "is an input, and the value is not finite");
    }
    for (size_t i = 0; i < count; i++)
        u->variables[references[i]].value = values[i];
    return UNIT_OK;
}

/* ---- steps ---- */

/* A communication step is a whole multiple of the time step within this share of it. */
#define STEP_TOLERANCE 1e-6
/* Times of the importer are those of the unit within this share of a time step, and what its steps may have missed. */
#define TIME_TOLERANCE 0.01

double unit_time(const unit *u)
{
    fenv_t of_importer;
    unit_arithmetic_begin(&of_importer);
    volatile double now = u->start + fram_world_time(u->world); /* summed here, not after the end below */
    unit_arithmetic_end(&of_importer);
    return now;
}

static unit_status check_step(unit *u, double now, double step, double count)
{
    char text[200] = "";
    double dt = fram_scenario_time_step(u->scenario), own = unit_time(u);
    double tolerance = TIME_TOLERANCE * dt + STEP_TOLERANCE * fram_world_time(u->world) + 1e-12 * fabs(own);
    if (!(count >= 1 && count < 1e9 && fabs(step - count * dt) <= STEP_TOLERANCE * dt * count))
        snprintf(text, sizeof text,
                 "a communication step of %.15g s is no whole multiple of the scenario's time step, %.15g s", step, dt);
    else if (!(fabs(now - own) <= tolerance))
        snprintf(text, sizeof text, "the step begins at %.17g s, and the unit stands at %.17g s", now, own);
    else if (own + step > u->stop + tolerance)
        snprintf(text, sizeof text, "the step ends at %.17g s, past the stop time, %.17g s", own + step, u->stop);
    return text[0] ? unit_fail(u, text) : UNIT_OK;
}

/* One step of the world.  *end: the importer wants no more of them. */
static unit_status step_inside(unit *u, bool is_last, double *return_at, bool *end)
{
    fram_error e;
    double dt = fram_scenario_time_step(u->scenario);
    if (fram_world_step(u->world, &e) != FRAM_OK)
        return unit_fail_by(u, &e);
    u->reached = unit_time(u);
    *end = is_last;
    if (u->look || is_last)
        read_outputs(u);
    if (u->look) {
        u->phase = UNIT_INTERMEDIATE;
        u->is_looked_on = true;
        unit_arithmetic_end(&u->of_importer);
        u->look(u, unit_time(u), u->may_return_early && !is_last, return_at);
        unit_arithmetic_begin(&u->of_importer);
        u->is_looked_on = false;
        if (u->phase != UNIT_INTERMEDIATE)
            return unit_fail(u, "the step is given up after a call that is not to be made during one");
        u->phase = UNIT_STEPPING;
        *end = is_last || unit_time(u) + (1 - TIME_TOLERANCE) * dt > *return_at;
    }
    return UNIT_OK;
}

static unit_status make_step(unit *u, double now, double step, bool *early)
{
    double count = floor(step / fram_scenario_time_step(u->scenario) + 0.5), return_at = (double)INFINITY;
    unit_status status = check_step(u, now, step, count);
    if (status == UNIT_OK)
        status = tell_inputs(u);
    bool end = false;
    for (int64_t i = 0; status == UNIT_OK && !end; i++) {
        bool is_last = i + 1 == (int64_t)count;
        status = step_inside(u, is_last, &return_at, &end);
        *early = end && !is_last;
    }
    if (status == UNIT_OK)
        u->finished = u->reached;
    else
        read_outputs(u);
    return status;
}

unit_status unit_step(unit *u, double now, double step, bool *early)
{
    *early = false;
    unit_status status = unit_allow(u, 1U << UNIT_STEPPING, "DoStep");
    if (status != UNIT_OK)
        return status;
    unit_arithmetic_begin(&u->of_importer);
    status = make_step(u, now, step, early);
    unit_arithmetic_end(&u->of_importer);
    return status;
}
