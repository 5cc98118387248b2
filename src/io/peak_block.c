#include "io/peak_block.h"

#include <math.h>
#include <string.h>

/* One way for both directions, so that what is written is what is read. */
typedef struct cursor {
    unsigned char *out; /* NULL: reads */
    const unsigned char *in;
    size_t at, size;
    vec2 origin;
    bool bad;
} cursor;

static void bytes(cursor *c, void *value, size_t size)
{
    if (c->size - c->at < size) {
        c->bad = true;
        return;
    }
    if (c->out)
        memcpy(c->out + c->at, value, size);
    else
        memcpy(value, c->in + c->at, size);
    c->at += size;
}

static void real(cursor *c, double *value)
{
    float f = c->out ? (float)*value : 0;
    bytes(c, &f, sizeof f);
    *value = f;
}

static void vector(cursor *c, vec3 *v)
{
    real(c, &v->x);
    real(c, &v->y);
    real(c, &v->z);
}

/* The origin is in whole metres, and what was read is written again with the same bytes. */
static void place(cursor *c, vec3 *v)
{
    vec3 near = vec3_make(v->x - c->origin.x, v->y - c->origin.y, v->z);
    vector(c, &near);
    *v = vec3_make(near.x + c->origin.x, near.y + c->origin.y, near.z);
}

static void floe(cursor *c, peak_floe *f)
{
    bytes(c, &f->number, sizeof f->number);
    bytes(c, &f->slot, sizeof f->slot);
    bytes(c, &f->mechanism, 1);
    bytes(c, &f->zone, 1);
    bytes(c, &f->links, 1);
    bytes(c, &f->end, 1);
    vector(c, &f->force);
    place(c, &f->point);
    for (int i = 0; i < MECHANISM_COUNT; i++)
        real(c, &f->part[i]);
}

static void link_of_chain(cursor *c, peak_link *l)
{
    bytes(c, &l->slot, sizeof l->slot);
    bytes(c, &l->number, sizeof l->number);
    place(c, &l->place);
    vector(c, &l->push);
    real(c, &l->others);
    real(c, &l->water);
    real(c, &l->inertia);
}

static void chain_of_floe(cursor *c, peak_floe *f)
{
    bytes(c, &f->left_out, sizeof f->left_out);
    bytes(c, &f->end_vessel, sizeof f->end_vessel);
}

/* Earlier blocks end before what is left out, and had at most this many links, of a longer chain the first ones. */
enum { EARLIER_CHAIN_LINKS = 12 };

static void take_earlier(peak_floe *f)
{
    f->end_vessel = -1;
    if (f->links == EARLIER_CHAIN_LINKS && f->end == CHAIN_LOOP)
        f->end = CHAIN_LONG;
}

static void detail(cursor *c, peak_detail *d)
{
    bytes(c, &d->time, sizeof d->time);
    bytes(c, &d->load, sizeof d->load);
    bytes(c, &d->window, sizeof d->window);
    bytes(c, &d->vessel, sizeof d->vessel);
    bytes(c, &d->bodies, sizeof d->bodies);
    bytes(c, &d->floe_count, sizeof d->floe_count);
    bytes(c, &d->link_count, sizeof d->link_count);
    vector(c, &d->force);
    for (int i = 0; i < MECHANISM_COUNT; i++)
        real(c, &d->mechanism[i]);
    for (int z = 0; z < PEAK_ZONES; z++)
        for (int i = 0; i < MECHANISM_COUNT; i++)
            real(c, &d->zone[z][i]);
    if (c->bad || d->floe_count < 0 || d->floe_count > PEAK_FLOES || d->link_count < 0 || d->link_count > PEAK_LINKS) {
        c->bad = true;
        return;
    }
    for (int32_t i = 0; i < d->floe_count; i++)
        floe(c, &d->floe[i]);
    for (int32_t i = 0; i < d->link_count; i++)
        link_of_chain(c, &d->link[i]);
    bool earlier = !c->out && c->at == c->size;
    for (int32_t i = 0; i < d->floe_count && !c->bad; i++) {
        if (earlier)
            take_earlier(&d->floe[i]);
        else
            chain_of_floe(c, &d->floe[i]);
    }
}

size_t peak_block_pack(const peak_detail *d, vec2 origin, unsigned char out[PEAK_BLOCK_ROOM])
{
    peak_detail copy = *d;
    cursor c = {.size = PEAK_BLOCK_ROOM, .origin = origin};
    c.out = out;
    detail(&c, &copy);
    return c.at;
}

/* What is read names nothing that is not there. */
static bool is_sound(const peak_detail *d)
{
    int32_t links = 0;
    for (int32_t i = 0; i < d->floe_count; i++) {
        const peak_floe *f = &d->floe[i];
        links += f->links;
        if (f->mechanism >= MECHANISM_COUNT || f->zone >= PEAK_ZONES || f->end >= CHAIN_END_COUNT ||
            f->links > PEAK_CHAIN_LINKS || (f->left_out > 0 && f->links < PEAK_CHAIN_LINKS))
            return false;
    }
    return links == d->link_count && d->vessel >= 0 && isfinite(d->time) && isfinite(d->load) && isfinite(d->window);
}

bool peak_block_unpack(const void *data, size_t size, vec2 origin, peak_detail *d)
{
    cursor c = {.in = data, .size = size, .origin = origin};
    memset(d, 0, sizeof *d);
    detail(&c, d);
    return !c.bad && c.at == size && is_sound(d);
}
