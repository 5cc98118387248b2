#include "sim/peak_chain.h"

static int32_t number_at(const world *w, int32_t body)
{
    bool ice = w->bodies.material[body] == MATERIAL_ICE && w->bodies.owner[body] >= 0;
    return ice && body_is_alive(&w->bodies, body) ? w->floes.number[w->bodies.owner[body]] : -1;
}

/* Held ice that lost crushed ice in this step is the end, wherever it stands: its contacts are of the slot that it had,
   which by now is nobody's, or another's. */
static void end_at_trimmed(const world *w, const floe_trim_array *trims, force_chain *chain)
{
    for (int32_t i = 0; i < chain->count; i++) {
        chain_link *l = &chain->link[i];
        const floe_trim *t = floe_trims_find_slot(trims, w->clock.step[0], l->body);
        motion kind = t ? (motion)w->bodies.motion[t->slot] : MOTION_DYNAMIC;
        if (kind != MOTION_STATIC && kind != MOTION_CARRIED)
            continue;
        chain->count = i + 1;
        chain->end = kind == MOTION_STATIC ? CHAIN_SHEET : CHAIN_DRIVEN;
        l->others = l->water = l->inertia = 0;
    }
}

/* A link to a floe that was trimmed in this step is to what it is now. */
static peak_link link_now(const world *w, const floe_trim_array *trims, const chain_link *l)
{
    bool gone = world_came_since_contacts(w, l->body);
    /* The middle of a sheet or a wall may be far away, and that of what broke in this step is no more. */
    bool whole = w->bodies.motion[l->body] == MOTION_DYNAMIC && !gone;
    vec3 place = whole ? w->bodies.position[l->body] : l->point;
    const floe_trim *t = floe_trims_find_slot(trims, w->clock.step[0], l->body);
    int32_t slot = t ? t->slot : l->body, number = gone && !t ? -1 : number_at(w, slot);
    return (peak_link){slot, number, place, l->push, l->others, l->water, l->inertia};
}

static void keep_chain(const world *w, const floe_trim_array *trims, const force_chain *chain, peak_floe *f,
                       peak_detail *d)
{
    int32_t count = chain->count < PEAK_CHAIN_LINKS ? chain->count : PEAK_CHAIN_LINKS, last = chain->count - 1;
    f->links = (uint8_t)count;
    f->left_out = (uint16_t)(chain->count - count);
    f->end = (uint8_t)chain->end;
    if (chain->end == CHAIN_VESSEL)
        f->end_vessel = (int16_t)w->bodies.owner[chain->link[last].body];
    for (int32_t i = 0; i < count; i++)
        d->link[d->link_count++] =
            link_now(w, trims, &chain->link[i < PEAK_CHAIN_FIRST ? i : i + chain->count - count]);
}

void peak_chain_add(const world *w, double time_step, const floe_trim_array *trims, force_chain *chain, peak_floe *f,
                    peak_detail *d)
{
    /* The slot is another's when the floe broke in this step. */
    if (f->number < 0 || number_at(w, f->slot) != f->number)
        return;
    int32_t hull = w->vessels.body[d->vessel];
    const floe_trim *t = floe_trims_find(trims, w->clock.step[0], f->number);
    if (t && t->had < 0)
        return;
    force_chain_follow(w, time_step, hull, t ? t->had : f->slot, chain);
    end_at_trimmed(w, trims, chain);
    if (vec3_length(chain->link[0].push) == 0)
        return;
    keep_chain(w, trims, chain, f, d);
}
