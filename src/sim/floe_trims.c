#include "sim/floe_trims.h"

/* A floe that came in this step by a break, or whose parent broke, or came loose with others. */
static bool is_of_event(const world *w, const floe_trim *t)
{
    for (int32_t i = 0; i < w->scratch.fractures.count; i++) {
        const fracture_event *e = &w->scratch.fractures.data[i];
        if (e->floe == t->from || (t->to >= e->first_piece && t->to < e->first_piece + e->pieces))
            return true;
    }
    return false;
}

static bool is_there(const world *w, int32_t number)
{
    for (int32_t i = 0; i < w->floes.count; i++)
        if (w->floes.body[i] >= 0 && w->floes.number[i] == number)
            return true;
    return false;
}

/* Where a floe stood when vessels touched it in this step. */
static int32_t slot_touched(const world *w, int32_t number)
{
    for (int32_t i = 0; i < w->scratch.shares.count; i++)
        if (w->scratch.shares.data[i].floe == number)
            return w->scratch.shares.data[i].body;
    return -1;
}

/* Floes that have come since the contacts of this step were found, and have a parent. */
static bool add_children(context *ctx, const world *w, floe_trim_array *trims)
{
    const floe_table *f = &w->floes;
    bool good = true;
    for (int32_t i = 0; i < f->count && good; i++) {
        if (f->body[i] < 0 || f->parent[i] < 0 || !world_came_since_contacts(w, f->body[i]))
            continue;
        const floe_trim t = {.step = w->clock.step[0], .from = f->parent[i], .to = f->number[i], .slot = f->body[i]};
        good = array_push(ctx, trims, t);
    }
    return good;
}

/* The only child of its parent. */
static bool is_only_child(const floe_trim *child, int32_t count, int32_t at)
{
    for (int32_t i = 0; i < count; i++)
        if (i != at && child[i].from == child[at].from)
            return false;
    return true;
}

/* For `had`, until it is removed. */
enum { NO_TRIM = -2 };

bool floe_trims_note(context *ctx, const world *w, floe_trim_array *trims)
{
    int32_t had = trims->count, kept = 0;
    /* Ice is crushed where there are patches. */
    if (w->scratch.patches.count == 0 || w->scratch.contact_generations.count == 0)
        return true;
    if (!add_children(ctx, w, trims))
        return false;
    int32_t all = trims->count - had;
    floe_trim *child = trims->data + had;
    for (int32_t i = 0; i < all; i++)
        child[i].had = is_only_child(child, all, i) && !is_of_event(w, &child[i]) && !is_there(w, child[i].from)
                           ? slot_touched(w, child[i].from)
                           : NO_TRIM;
    for (int32_t i = 0; i < all; i++)
        if (child[i].had != NO_TRIM)
            child[kept++] = child[i];
    trims->count = had + kept;
    return true;
}

const floe_trim *floe_trims_find(const floe_trim_array *trims, int64_t step, int32_t to)
{
    for (int32_t i = trims->count - 1; i >= 0 && trims->data[i].step == step; i--)
        if (trims->data[i].to == to)
            return &trims->data[i];
    return NULL;
}

const floe_trim *floe_trims_find_slot(const floe_trim_array *trims, int64_t step, int32_t had)
{
    for (int32_t i = trims->count - 1; i >= 0 && trims->data[i].step == step; i--)
        if (trims->data[i].had == had)
            return &trims->data[i];
    return NULL;
}
