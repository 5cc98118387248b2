#include "sim/force_chain.h"

/* The web: web_first holds for each body slot the first of its entries, web_next for each entry the next one, -1 at the
   end.  Entry 2 i is contact i seen from its body a, entry 2 i + 1 from b; each list ascends. */

static void web_enter(world *w, int32_t body, int32_t entry)
{
    w->scratch.web_next.data[entry] = w->scratch.web_first.data[body];
    w->scratch.web_first.data[body] = entry;
}

bool contact_web_make(context *ctx, world *w)
{
    int32_t contacts = w->scratch.contacts.count;
    if (contacts > INT32_MAX / 2 || !array_resize(ctx, &w->scratch.web_first, w->bodies.count) ||
        !array_resize(ctx, &w->scratch.web_next, 2 * contacts))
        return false;
    for (int32_t i = 0; i < w->bodies.count; i++)
        w->scratch.web_first.data[i] = -1;
    for (int32_t i = contacts - 1; i >= 0; i--) {
        web_enter(w, w->scratch.contacts.data[i].b, 2 * i + 1);
        web_enter(w, w->scratch.contacts.data[i].a, 2 * i);
    }
    return true;
}

/* The other body of an entry. */
static int32_t web_other(const world *w, int32_t entry)
{
    const contact *c = &w->scratch.contacts.data[entry / 2];
    return entry % 2 == 0 ? c->b : c->a;
}

/* The impulse of an entry on the body that it belongs to [N s]. */
static vec3 web_impulse(const world *w, int32_t entry)
{
    vec3 on_a = contact_impulse(&w->scratch.contacts.data[entry / 2]);
    return entry % 2 == 0 ? on_a : vec3_neg(on_a);
}

/* The contacts of a body with one other that stand together in the list from *entry on, which moves behind them. */
static int32_t next_neighbour(const world *w, int32_t *entry, vec3 *sum)
{
    int32_t other = web_other(w, *entry);
    *sum = web_impulse(w, *entry);
    for (*entry = w->scratch.web_next.data[*entry]; *entry >= 0; *entry = w->scratch.web_next.data[*entry]) {
        if (web_other(w, *entry) != other)
            break;
        *sum = vec3_add(*sum, web_impulse(w, *entry));
    }
    return other;
}

/* A link with what pushes it, and with `place` where. */
static chain_link link_of(const world *w, double per_time, int32_t from, int32_t body, bool place)
{
    chain_link l = {.body = body, .point = w->bodies.position[body]};
    vec3 sum = {0, 0, 0};
    double size = 0;
    for (int32_t entry = w->scratch.web_first.data[body]; entry >= 0; entry = w->scratch.web_next.data[entry]) {
        if (web_other(w, entry) != from)
            continue;
        vec3 impulse = web_impulse(w, entry);
        l.push = vec3_mad(l.push, impulse, per_time);
        if (!place)
            continue;
        sum = vec3_mad(sum, w->scratch.contacts.data[entry / 2].point, vec3_length(impulse));
        size += vec3_length(impulse);
    }
    if (size > 0)
        l.point = vec3_scale(sum, 1 / size);
    return l;
}

/* What holds a body that moves against the push of `from`; the one that does most is the answer, -1: none. */
static int32_t find_holders(const world *w, double per_time, int32_t from, chain_link *l)
{
    double size = vec3_length(l->push), most = 0;
    if (!(size > 0))
        return -1;
    vec3 along = vec3_scale(l->push, 1 / size), impulse;
    int32_t holder = -1;
    for (int32_t entry = w->scratch.web_first.data[l->body]; entry >= 0;) {
        int32_t other = next_neighbour(w, &entry, &impulse);
        double held = -vec3_dot(impulse, along) * per_time;
        if (other == from)
            continue;
        l->others += held;
        if (held > most) {
            most = held;
            holder = other;
        }
    }
    if (w->scratch.loads.count > l->body)
        l->water = -vec3_dot(w->scratch.loads.data[l->body].force, along);
    l->inertia = size - l->others - l->water;
    return holder;
}

/* Of a body that is not moved by forces, or is no ice.  moves: it is ice that moves freely, which is no end by itself.
 */
static chain_end end_at(const world *w, int32_t body, bool *moves)
{
    switch ((material)w->bodies.material[body]) {
    case MATERIAL_HULL:
        return CHAIN_VESSEL;
    case MATERIAL_WALL:
        return CHAIN_WALL;
    default:
        break;
    }
    switch ((motion)w->bodies.motion[body]) {
    case MOTION_STATIC:
        return CHAIN_SHEET;
    case MOTION_PRESCRIBED:
    case MOTION_CARRIED:
        return CHAIN_DRIVEN;
    default: /* free, or gone since the contacts were solved */
        *moves = true;
        return CHAIN_LONG;
    }
}

static bool is_in(const force_chain *chain, int32_t body)
{
    for (int32_t i = 0; i < chain->count; i++)
        if (chain->link[i].body == body)
            return true;
    return false;
}

/* details: what is told of the last body, and of where links act; without, only what finds the way and the first push.
 */
static void follow_chain(const world *w, double time_step, int32_t from, int32_t body, bool details, force_chain *chain)
{
    int32_t hull = from;
    chain->count = 0;
    while (chain->count < CHAIN_MOST_LINKS && !is_in(chain, body)) {
        chain_link *l = &chain->link[chain->count++];
        bool moves = false;
        chain->end = body == hull ? CHAIN_ITSELF : end_at(w, body, &moves);
        *l = details || moves ? link_of(w, 1 / time_step, from, body, details) : (chain_link){.body = body};
        if (!moves)
            return;
        int32_t holder = find_holders(w, 1 / time_step, from, l);
        if (holder < 0 || l->water >= l->others || l->inertia > l->others) {
            chain->end = l->water >= l->inertia ? CHAIN_WATER : CHAIN_INERTIA;
            return;
        }
        from = body;
        body = holder;
    }
    chain->end = is_in(chain, body) ? CHAIN_LOOP : CHAIN_LONG;
}

void force_chain_follow(const world *w, double time_step, int32_t from, int32_t body, force_chain *chain)
{
    follow_chain(w, time_step, from, body, true, chain);
}

void force_chain_end(const world *w, double time_step, int32_t from, int32_t body, force_chain *chain)
{
    follow_chain(w, time_step, from, body, false, chain);
}
