/* States of an instance: kept, gone back to, as bytes.  A state is a copy of the world with what the importer last saw
   of it.  Handles are looked up in the instance's list, so that a handle that is none is refused. */
#include "unit.h"

#include <stdlib.h>
#include <string.h>

/* NOLINTBEGIN(readability-non-const-parameter): the standard has these signatures */

static void free_state(kept_state *s)
{
    fram_world_destroy(s->world);
    free(s);
}

void unit_free_states(unit *u)
{
    while (u->kept) {
        kept_state *s = u->kept;
        u->kept = s->next;
        free_state(s);
    }
}

static size_t variables_size(const unit *u) { return (size_t)u->count * sizeof(variable); }

static kept_state *keep(const unit *u, const fram_world *world)
{
    fram_error e;
    kept_state *s = calloc(1, sizeof *s + variables_size(u));
    if (!s)
        return NULL;
    if (fram_world_copy(world, &s->world, &e) != FRAM_OK) {
        unit_fail_by(u, &e);
        free(s);
        return NULL;
    }
    s->start = u->start;
    s->initialised = u->initialised;
    s->count = u->count;
    memcpy(s->variables, u->variables, variables_size(u));
    return s;
}

/* The state behind an importer's handle; NULL when this instance has given no such state, or it was freed. */
static kept_state *find_state(const unit *u, const void *handle)
{
    kept_state *s = u ? u->kept : NULL;
    while (s && s != handle)
        s = s->next;
    return s;
}

static fmi2Status refuse_state(const unit *u)
{
    return u ? unit_fail(u, "there is no such state: it was freed, or is of another instance") : fmi2Error;
}

static void forget(unit *u, kept_state *s)
{
    kept_state **at = &u->kept;
    while (*at != s)
        at = &(*at)->next;
    *at = s->next;
    free_state(s);
}

/* A new state for the importer.  One that is handed in is used again, as the standard wants; a pointer that is none of
   this instance's states is taken for one that nobody has set. */
static void hand_out(unit *u, kept_state *s, fmi2FMUstate *out)
{
    kept_state *before = find_state(u, *out);
    if (before)
        forget(u, before);
    s->next = u->kept;
    u->kept = s;
    *out = s;
}

fmi2Status fmi2FreeFMUstate(fmi2Component c, fmi2FMUstate *state)
{
    unit *u = c;
    if (!u)
        return fmi2Error;
    kept_state *s = find_state(u, (const void *)state);
    if (s) { /* fmusim 0.0.39 does that; its state is freed all the same */
        unit_tell(u, fmi2Warning, "logStatusWarning", "fmi2FreeFMUstate expects the address of a state, not the state");
        forget(u, s);
        return fmi2OK;
    }
    if (!state || !*state)
        return fmi2OK;
    s = find_state(u, *state);
    if (!s)
        return refuse_state(u);
    forget(u, s);
    *state = NULL;
    return fmi2OK;
}

fmi2Status fmi2GetFMUstate(fmi2Component c, fmi2FMUstate *state)
{
    unit *u = c;
    kept_state *s = u && state ? keep(u, u->world) : NULL;
    if (!s)
        return fmi2Error;
    hand_out(u, s, state);
    return fmi2OK;
}

fmi2Status fmi2SetFMUstate(fmi2Component c, fmi2FMUstate state)
{
    unit *u = c;
    const kept_state *s = find_state(u, state);
    fram_world *copy;
    fram_error e;
    if (!s)
        return refuse_state(u);
    if (fram_world_copy(s->world, &copy, &e) != FRAM_OK)
        return unit_fail_by(u, &e);
    fram_world_destroy(u->world);
    u->world = copy;
    u->start = s->start;
    u->initialised = s->initialised;
    memcpy(u->variables, s->variables, variables_size(u));
    return fmi2OK;
}

/* Bytes of a state: start, flag, variables, then the world. */
static size_t head_size(const unit *u) { return sizeof(double) + sizeof(int) + variables_size(u); }

fmi2Status fmi2SerializedFMUstateSize(fmi2Component c, fmi2FMUstate state, size_t *size)
{
    unit *u = c;
    const kept_state *s = find_state(u, state);
    void *data;
    size_t bytes;
    fram_error e;
    if (!s || !size)
        return refuse_state(u);
    if (fram_world_save_memory(s->world, &data, &bytes, &e) != FRAM_OK)
        return unit_fail_by(u, &e);
    fram_data_free(u->context, data);
    *size = head_size(u) + bytes;
    return fmi2OK;
}

fmi2Status fmi2SerializeFMUstate(fmi2Component c, fmi2FMUstate state, fmi2Byte out[], size_t size)
{
    unit *u = c;
    const kept_state *s = find_state(u, state);
    void *data;
    size_t bytes;
    fram_error e;
    if (!s || !out)
        return refuse_state(u);
    if (fram_world_save_memory(s->world, &data, &bytes, &e) != FRAM_OK)
        return unit_fail_by(u, &e);
    bool fits = size >= head_size(u) + bytes;
    if (fits) {
        int flag = s->initialised;
        memcpy(out, &s->start, sizeof s->start);
        memcpy(out + sizeof s->start, &flag, sizeof flag);
        memcpy(out + sizeof s->start + sizeof flag, s->variables, variables_size(u));
        memcpy(out + head_size(u), data, bytes);
    }
    fram_data_free(u->context, data);
    return fits ? fmi2OK : unit_fail(u, "there is less room than the serialized state needs");
}

fmi2Status fmi2DeSerializeFMUstate(fmi2Component c, const fmi2Byte in[], size_t size, fmi2FMUstate *state)
{
    unit *u = c;
    fram_error e;
    if (!u || !in || !state)
        return fmi2Error;
    if (size < head_size(u))
        return unit_fail(u, "the serialized state is too short");
    kept_state *s = keep(u, u->world);
    if (!s)
        return fmi2Error;
    if (fram_world_load_memory(s->world, in + head_size(u), size - head_size(u), &e) != FRAM_OK) {
        free_state(s);
        return unit_fail_by(u, &e);
    }
    int flag;
    memcpy(&s->start, in, sizeof s->start);
    memcpy(&flag, in + sizeof s->start, sizeof flag);
    s->initialised = flag != 0;
    for (int i = 0; i < u->count; i++) {
        variable from;
        memcpy(&from, in + sizeof s->start + sizeof flag + (size_t)i * sizeof from, sizeof from);
        s->variables[i].value = from.value;
        s->variables[i].told = from.told;
    }
    hand_out(u, s, state);
    return fmi2OK;
}

/* NOLINTEND(readability-non-const-parameter) */
