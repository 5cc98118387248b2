#include "sim/peak_state.h"

#include <math.h>
#include <string.h>

/* One way for both directions, so that what is saved is what is restored. */
typedef struct byte_stream {
    peak_watch *watch;
    byte_array *out; /* NULL: reads */
    const byte_array *in;
    int32_t at;
    bool full, bad;
} byte_stream;

static bool goes(const byte_stream *s) { return !s->full && !s->bad; }

static void bytes(byte_stream *s, void *value, size_t size)
{
    if (!goes(s))
        return;
    if (s->out) {
        int32_t at = s->out->count;
        s->full = size > (size_t)(INT32_MAX - at) || !array_resize(s->watch->ctx, s->out, at + (int32_t)size);
        if (!s->full)
            memcpy(s->out->data + at, value, size);
        return;
    }
    s->bad = size > (size_t)(s->in->count - s->at);
    if (s->bad)
        return;
    memcpy(value, s->in->data + s->at, size);
    s->at += (int32_t)size;
}

static void whole(byte_stream *s, int32_t *value, int32_t most)
{
    bytes(s, value, sizeof *value);
    if (s->out)
        return;
    s->bad = s->bad || *value < 0 || *value > most;
    *value = s->bad ? 0 : *value;
}

static void finite_real(byte_stream *s, double *value)
{
    bytes(s, value, sizeof *value);
    s->bad = s->bad || (!s->out && !isfinite(*value));
}

static void vector(byte_stream *s, vec3 *v)
{
    finite_real(s, &v->x);
    finite_real(s, &v->y);
    finite_real(s, &v->z);
}

static void detail(byte_stream *s, peak_detail *d)
{
    unsigned char room[PEAK_BLOCK_ROOM];
    int32_t size = s->out ? (int32_t)peak_block_pack(d, s->watch->origin, room) : 0;
    whole(s, &size, PEAK_BLOCK_ROOM);
    bytes(s, room, (size_t)size);
    if (!s->out && goes(s))
        s->bad = !peak_block_unpack(room, (size_t)size, s->watch->origin, d) || d->vessel >= s->watch->vessels.count;
}

/* What it rose to, and what carried it where it is kept, or may be. */
static void peak(byte_stream *s, vessel_peaks *v, load_peak *k, bool kept)
{
    finite_real(s, &k->time);
    finite_real(s, &k->value);
    if (!s->out) {
        k->room = v->detail.count;
        s->full = s->full || !array_push(s->watch->ctx, &v->detail, (peak_detail){0});
    }
    if (goes(s) && (kept || peak_picker_may_keep(&v->picker, k)))
        detail(s, &v->detail.data[k->room]);
}

static void recent(byte_stream *s, peak_picker *p)
{
    whole(s, &p->recent_count, p->recent.count);
    for (int32_t i = 0; i < p->recent_count && goes(s); i++) {
        load_value *value = peak_picker_recent(p, i);
        finite_real(s, &value->time);
        finite_real(s, &value->value);
    }
}

static void peaks(byte_stream *s, vessel_peaks *v)
{
    peak_picker *p = &v->picker;
    int32_t open = p->open;
    finite_real(s, &p->from);
    whole(s, &p->count, PEAKS_KEPT);
    for (int32_t i = 0; i < p->count && goes(s); i++)
        peak(s, v, &p->kept[i], true);
    whole(s, &p->awaited_count, PEAKS_AWAITED);
    for (int32_t i = 0; i < p->awaited_count && goes(s); i++)
        peak(s, v, &p->awaited[i], false);
    whole(s, &open, 1);
    p->open = open;
    if (open)
        peak(s, v, &p->candidate, false);
    recent(s, p);
}

static void share(byte_stream *s, const world *w, ice_share *c)
{
    whole(s, &c->vessel, w->vessels.count - 1);
    whole(s, &c->body, w->bodies.count - 1);
    bytes(s, &c->floe, sizeof c->floe);
    bytes(s, &c->mechanism, sizeof c->mechanism);
    bytes(s, &c->zone, sizeof c->zone);
    vector(s, &c->point);
    vector(s, &c->normal);
    vector(s, &c->friction);
    if (!s->out)
        c->patch = -1; /* of its own step */
    s->bad = s->bad || c->mechanism >= MECHANISM_COUNT || c->zone >= ZONE_COUNT;
}

/* The rows of the window from the oldest on; they are restored into the ring's first ones. */
static void steps(byte_stream *s, const world *w)
{
    peak_watch *p = s->watch;
    int32_t oldest = s->out ? p->next + p->ring.count - p->filled : 0;
    whole(s, &p->filled, p->ring.count);
    if (p->block > 1)
        whole(s, &p->within, p->block);
    else
        p->within = 1;
    s->bad = s->bad || (!s->out && p->filled > 0 && p->within == 0);
    for (int32_t k = 0; k < p->filled && goes(s); k++) {
        ice_share_array *row = &p->ring.data[(oldest + k) % p->ring.count];
        int32_t count = row->count;
        whole(s, &count, INT32_MAX);
        for (int32_t i = 0; i < count && goes(s); i++) {
            if (!s->out && !array_resize(p->ctx, row, i + 1))
                s->full = true;
            else
                share(s, w, &row->data[i]);
        }
    }
    if (!s->out && p->ring.count > 0)
        p->next = p->filled % p->ring.count;
}

/* Of these bytes; those of before had none, and begin with another number. */
enum { STATE_LAYOUT = 2 };

static void trims(byte_stream *s, const world *w)
{
    floe_trim_array *a = &s->watch->trims;
    int32_t count = a->count, last = w->bodies.count - 1;
    whole(s, &count, INT32_MAX);
    for (int32_t i = 0; i < count && goes(s); i++) {
        floe_trim t = s->out ? a->data[i] : (floe_trim){0};
        int32_t had = t.had + 1; /* -1: none */
        bytes(s, &t.step, sizeof t.step);
        whole(s, &t.from, INT32_MAX);
        whole(s, &t.to, INT32_MAX);
        whole(s, &had, last + 1);
        whole(s, &t.slot, last);
        t.had = had - 1;
        s->full = s->full || (!s->out && !array_push(s->watch->ctx, a, t));
    }
}

static void state(byte_stream *s, const world *w)
{
    peak_watch *p = s->watch;
    int32_t layout = STATE_LAYOUT;
    whole(s, &layout, INT32_MAX);
    s->bad = s->bad || layout != STATE_LAYOUT;
    for (int32_t v = 0; v < p->vessels.count && goes(s); v++)
        peaks(s, &p->vessels.data[v]);
    steps(s, w);
    trims(s, w);
}

bool peak_state_save(peak_watch *p, const world *w, byte_array *out)
{
    byte_stream s = {.watch = p, .out = out};
    array_clear(out);
    if (!peak_watch_begin(p, w))
        return false;
    state(&s, w);
    return !s.full;
}

fram_status peak_state_restore(peak_watch *p, const world *w, const byte_array *saved, fram_error *error)
{
    byte_stream s = {.watch = p, .in = saved};
    if (!peak_watch_begin(p, w))
        return error_memory(error);
    state(&s, w);
    if (s.full)
        return error_memory(error);
    if (!s.bad && s.at == saved->count)
        return FRAM_OK;
    peak_watch fresh;
    peak_watch_init(p->ctx, p->time_step, p->from, &fresh);
    fresh.origin = p->origin;
    peak_watch_free(p);
    *p = fresh;
    return error_set(error, FRAM_ERROR_INPUT, NULL, 0, NULL, "the peaks of the load so far do not fit the run");
}
