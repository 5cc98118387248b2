#include "sim/fenders.h"

bool contact_is_of_ice(const world *w, const contact *c)
{
    return w->bodies.material[c->a] == MATERIAL_ICE || w->bodies.material[c->b] == MATERIAL_ICE;
}

/* Depth over force of what a body has on it; -1: it is no hull and no wall. */
static double yielding_of(const model *m, const world *w, int32_t body)
{
    int32_t vessel = w->bodies.owner[body];
    switch ((material)w->bodies.material[body]) {
    case MATERIAL_HULL:
        return vessel >= 0 ? m->vessels.data[vessel].yielding : 0;
    case MATERIAL_WALL:
        return 0;
    case MATERIAL_ICE:
    case MATERIAL_COUNT:
        break;
    }
    return -1;
}

static void limit_pair(contact *c, int32_t count, double yielding, double dt)
{
    double deepest = 0, sum = 0;
    for (int32_t i = 0; i < count; i++) {
        deepest = fmax(deepest, c[i].depth);
        sum += fmax(0, c[i].depth);
    }
    for (int32_t i = 0; i < count; i++) {
        double share = sum > 0 ? fmax(0, c[i].depth) / sum : 0;
        c[i].impulse_limit = share * deepest / yielding * dt;
        c[i].correct = false;
    }
}

static bool any_yields(const model *m)
{
    for (int32_t v = 0; v < m->vessels.count; v++)
        if (m->vessels.data[v].yielding > 0)
            return true;
    return false;
}

void fenders_limit(const model *m, world *w)
{
    if (!any_yields(m))
        return;
    contact *all = w->scratch.contacts.data;
    int32_t count = w->scratch.contacts.count;
    for (int32_t first = 0, end; first < count; first = end) {
        contact *c = &all[first];
        for (end = first + 1; end < count && all[end].a == c->a && all[end].b == c->b;)
            end++;
        double a = yielding_of(m, w, c->a), b = yielding_of(m, w, c->b);
        if (a >= 0 && b >= 0 && a + b > 0)
            limit_pair(c, end - first, a + b, m->time_step);
    }
}
