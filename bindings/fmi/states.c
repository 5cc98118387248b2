/* States of an instance: kept, gone back to, as bytes.  A state is a copy of the world with what the importer last saw
   of it.  Handles are looked up in the instance's list, so that a handle that is none is refused. */
#include "unit.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A copy of an instance; the importer's handle of one is looked up before anything is read of it. */
struct kept_state {
    kept_state *next;
    fram_world *world;
    bool is_set_up;
    double start, stop, reached, finished;
    unit_phase phase;
    int count;
    variable variables[]; /* so that outputs are as they were, also those of the last step */
};

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

static fram_status copy_world(const fram_world *w, fram_world **out, fram_error *error)
{
    fenv_t of_importer;
    unit_arithmetic_begin(&of_importer);
    fram_status status = fram_world_copy(w, out, error);
    unit_arithmetic_end(&of_importer);
    return status;
}

static fram_status load_world(fram_world *w, const char *data, size_t size, fram_error *error)
{
    fenv_t of_importer;
    unit_arithmetic_begin(&of_importer);
    fram_status status = fram_world_load_memory(w, data, size, error);
    unit_arithmetic_end(&of_importer);
    return status;
}

static size_t variables_size(const unit *u) { return (size_t)u->count * sizeof(variable); }

static kept_state *keep(unit *u)
{
    fram_error e;
    kept_state *s = calloc(1, sizeof *s + variables_size(u));
    if (!s) {
        unit_fail(u, "there is no memory left for a state");
        return NULL;
    }
    if (copy_world(u->world, &s->world, &e) != FRAM_OK) {
        unit_fail_by(u, &e);
        free(s);
        return NULL;
    }
    s->is_set_up = u->is_set_up;
    s->start = u->start;
    s->stop = u->stop;
    s->reached = u->reached;
    s->finished = u->finished;
    s->phase = u->phase;
    s->count = u->count;
    memcpy(s->variables, u->variables, variables_size(u));
    return s;
}

/* The state behind an importer's handle; NULL when this instance has given no such state, or it was freed. */
static kept_state *find_state(const unit *u, const void *handle)
{
    kept_state *s = u->kept;
    while (s && s != handle)
        s = s->next;
    return s;
}

static unit_status refuse_state(unit *u)
{
    return unit_fail(u, "there is no such state: it was freed, or is of another instance");
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
static void hand_out(unit *u, kept_state *s, void **out)
{
    kept_state *before = find_state(u, *out);
    if (before)
        forget(u, before);
    s->next = u->kept;
    u->kept = s;
    *out = s;
}

/* States have no place in the middle of a step; at any other time they have. */
static unit_status allow(unit *u, const char *call) { return unit_allow(u, ~(1U << UNIT_INTERMEDIATE), call); }

static unit_status refuse_null(unit *u) { return unit_fail(u, "an argument about a state is NULL"); }

unit_status unit_state_free(unit *u, void **state)
{
    unit_status status = allow(u, "FreeFMUState");
    if (status != UNIT_OK)
        return status;
    kept_state *s = find_state(u, (const void *)state);
    if (s) { /* fmusim 0.0.39 does that with units of 2.0; its state is freed all the same */
        unit_tell(u, UNIT_WARNING, "a state is freed by its address, not by itself");
        forget(u, s);
        return UNIT_OK;
    }
    if (!state || !*state)
        return UNIT_OK;
    s = find_state(u, *state);
    if (!s)
        return refuse_state(u);
    forget(u, s);
    *state = NULL;
    return UNIT_OK;
}

unit_status unit_state_get(unit *u, void **state)
{
    unit_status status = allow(u, "GetFMUState");
    if (status != UNIT_OK)
        return status;
    if (!state)
        return refuse_null(u);
    kept_state *s = keep(u);
    if (!s)
        return UNIT_ERROR;
    hand_out(u, s, state);
    return UNIT_OK;
}

unit_status unit_state_set(unit *u, const void *state)
{
    unit_status status = allow(u, "SetFMUState");
    if (status != UNIT_OK)
        return status;
    const kept_state *s = find_state(u, state);
    fram_world *copy;
    fram_error e;
    if (!s)
        return refuse_state(u);
    if (copy_world(s->world, &copy, &e) != FRAM_OK)
        return unit_fail_by(u, &e);
    fram_world_destroy(u->world);
    u->world = copy;
    u->is_set_up = s->is_set_up;
    u->start = s->start;
    u->stop = s->stop;
    u->reached = s->reached;
    u->finished = s->finished;
    u->phase = s->phase;
    memcpy(u->variables, s->variables, variables_size(u));
    return UNIT_OK;
}

/* ---- bytes: a head, value and told of each variable, then the world ---- */

typedef struct state_head {
    char mark[8];
    uint64_t checksum; /* of what follows up to the world, which has its own */
    char token[UNIT_TOKEN_ROOM];
    int64_t count, phase, is_set_up;
    double start, stop, reached, finished;
} state_head;
static const char mark[sizeof((state_head *)0)->mark] = {'F', 'R', 'A', 'M', 'F', 'M', 'U', '6'};

static size_t head_size(const unit *u) { return sizeof(state_head) + (size_t)u->count * 2 * sizeof(double); }

/* FNV-1a (Fowler, Noll and Vo 1991). */
static uint64_t checksum_of(const unit *u, const char *head)
{
    uint64_t sum = 14695981039346656037U;
    for (size_t i = offsetof(state_head, token); i < head_size(u); i++)
        sum = (sum ^ (unsigned char)head[i]) * 1099511628211U;
    return sum;
}

static void write_head(const unit *u, const kept_state *s, char *out)
{
    state_head head = {.count = s->count,
                       .phase = s->phase,
                       .is_set_up = s->is_set_up,
                       .start = s->start,
                       .stop = s->stop,
                       .reached = s->reached,
                       .finished = s->finished};
    memcpy(head.mark, mark, sizeof mark);
    memcpy(head.token, u->token, sizeof head.token);
    memcpy(out, &head, sizeof head);
    for (int i = 0; i < s->count; i++) {
        const double values[2] = {s->variables[i].value, s->variables[i].told};
        memcpy(out + sizeof head + (size_t)i * sizeof values, values, sizeof values);
    }
    head.checksum = checksum_of(u, out);
    memcpy(out, &head, sizeof head);
}

/* false: no state of this unit. */
static bool read_head(const unit *u, const char *in, kept_state *s)
{
    state_head head;
    memcpy(&head, in, sizeof head);
    if (memcmp(head.mark, mark, sizeof mark) != 0 || head.checksum != checksum_of(u, in) ||
        memcmp(head.token, u->token, sizeof head.token) != 0 || head.count != u->count || head.phase < 0 ||
        head.phase >= UNIT_PHASES || head.phase == UNIT_INTERMEDIATE || (head.is_set_up != 0 && head.is_set_up != 1) ||
        !isfinite(head.start) || isnan(head.stop) || !isfinite(head.reached) || !isfinite(head.finished))
        return false;
    s->is_set_up = head.is_set_up != 0;
    s->start = head.start;
    s->stop = head.stop;
    s->reached = head.reached;
    s->finished = head.finished;
    s->phase = (unit_phase)head.phase;
    for (int i = 0; i < u->count; i++) {
        double values[2];
        memcpy(values, in + sizeof head + (size_t)i * sizeof values, sizeof values);
        s->variables[i].value = values[0];
        s->variables[i].told = values[1];
        if (s->variables[i].kind == VARIABLE_INPUT && !(isfinite(values[0]) && isfinite(values[1])))
            return false;
    }
    return true;
}

/* The world's bytes are written again for the size: a state is kept as a copy, which is made faster. */
static unit_status save(unit *u, const void *state, void *out, size_t room, size_t *size)
{
    const kept_state *s = find_state(u, state);
    void *data;
    size_t bytes;
    fram_error e;
    if (!s)
        return refuse_state(u);
    fenv_t of_importer;
    unit_arithmetic_begin(&of_importer);
    fram_status status = fram_world_save_memory(s->world, &data, &bytes, &e);
    unit_arithmetic_end(&of_importer);
    if (status != FRAM_OK)
        return unit_fail_by(u, &e);
    *size = head_size(u) + bytes;
    bool fits = !out || room >= *size;
    if (out && fits) {
        write_head(u, s, out);
        memcpy((char *)out + head_size(u), data, bytes);
    }
    fram_data_free(u->context, data);
    return fits ? UNIT_OK : unit_fail(u, "there is less room than the serialized state needs");
}

unit_status unit_state_size(unit *u, const void *state, size_t *size)
{
    unit_status status = allow(u, "SerializedFMUStateSize");
    if (status != UNIT_OK)
        return status;
    return size ? save(u, state, NULL, 0, size) : refuse_null(u);
}

unit_status unit_state_write(unit *u, const void *state, void *out, size_t size)
{
    unit_status status = allow(u, "SerializeFMUState");
    size_t needed;
    if (status != UNIT_OK)
        return status;
    return out ? save(u, state, out, size, &needed) : refuse_null(u);
}

unit_status unit_state_read(unit *u, const void *in, size_t size, void **state)
{
    unit_status status = allow(u, "DeserializeFMUState");
    if (status != UNIT_OK)
        return status;
    if (!in || !state)
        return refuse_null(u);
    fram_error e;
    if (size < head_size(u))
        return unit_fail(u, "the serialized state is too short");
    kept_state *s = keep(u);
    if (!s)
        return UNIT_ERROR;
    if (!read_head(u, in, s))
        status = unit_fail(u, "the serialized state is none of this unit");
    else if (load_world(s->world, (const char *)in + head_size(u), size - head_size(u), &e) != FRAM_OK)
        status = unit_fail_by(u, &e);
    if (status == UNIT_OK)
        hand_out(u, s, state);
    else
        free_state(s);
    return status;
}
