/* What a unit carries in its folder `resources`: scenario.yaml with its files, and variables.txt: the token, then
   "input NAME", "output NAME" or "time NAME" a line, whose number from 0 is the value reference. */
#include "unit.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void log_of_library(void *user, fram_log_level level, const char *text)
{
    unit_tell_of_world(user, level == FRAM_LOG_WARNING ? UNIT_WARNING : UNIT_OK, text);
}

/* One line of variables.txt. */
static bool add_variable(unit *u, char *line)
{
    char *name = strchr(line, ' ');
    if (!name)
        return false;
    *name++ = '\0';
    variable *more = realloc(u->variables, ((size_t)u->count + 1) * sizeof *more);
    if (!more)
        return false;
    u->variables = more;
    variable *v = &more[u->count];
    memset(v, 0, sizeof *v);
    if (strcmp(line, "input") == 0) {
        v->kind = VARIABLE_INPUT;
        v->index = fram_world_find_input(u->world, name);
    } else if (strcmp(line, "output") == 0) {
        v->kind = VARIABLE_OUTPUT;
        v->index = fram_world_find_channel(u->world, name);
    } else if (strcmp(line, "time") == 0) {
        v->kind = VARIABLE_TIME;
    } else {
        v->index = -1;
    }
    u->count++;
    return v->index >= 0;
}

static unit_status read_variables(unit *u, FILE *file, const char *token)
{
    char *line = NULL;
    size_t room = 0;
    unit_status status = UNIT_OK;
    for (int number = 0; status == UNIT_OK && getline(&line, &room, file) > 0; number++) {
        line[strcspn(line, "\n")] = '\0';
        if (number == 0 && strcmp(line, token) != 0)
            status =
                unit_fail(u, u->version == 2 ? "the guid of the importer's model description is not that of this unit"
                                             : "the instantiation token is not that of this unit's model description");
        else if (number > 0 && !add_variable(u, line))
            status = unit_fail(u, "resources/variables.txt names what the scenario does not have");
    }
    free(line);
    if (status == UNIT_OK && u->count == 0)
        status = unit_fail(u, "resources/variables.txt names no variable");
    return status;
}

/* A path in the folder of resources; NULL without memory.  Free it. */
static char *path_of(const unit *u, const char *name)
{
    size_t size = strlen(u->folder) + strlen(name) + 2;
    char *path = malloc(size);
    if (path)
        snprintf(path, size, "%s/%s", u->folder, name);
    return path;
}

static unit_status load_scenario(unit *u)
{
    fram_error e;
    char *path = path_of(u, "scenario.yaml");
    if (!path)
        return unit_fail(u, "there is no memory left");
    fram_status status = fram_scenario_load(u->context, path, NULL, 0, &u->scenario, &e);
    free(path);
    return status == FRAM_OK ? UNIT_OK : unit_fail_by(u, &e);
}

unit_status unit_read_resources(unit *u, const char *token)
{
    fram_error e;
    fram_context_definition d;
    fram_context_default(&d);
    d.log = log_of_library;
    d.log_user = u;
    if (fram_context_create(&d, &u->context, &e) != FRAM_OK)
        return unit_fail_by(u, &e);
    unit_status status = load_scenario(u);
    if (status == UNIT_OK)
        status = unit_make_world(u);
    if (status != UNIT_OK)
        return status;
    char *path = path_of(u, "variables.txt");
    FILE *file = path ? fopen(path, "r") : NULL;
    free(path);
    if (!file)
        return unit_fail(u, "resources/variables.txt cannot be read");
    status = read_variables(u, file, token);
    fclose(file);
    if (status == UNIT_OK) {
        snprintf(u->token, sizeof u->token, "%s", token);
        unit_read_start(u);
    }
    return status;
}
