#include "sim/contact_sums.h"

#include <string.h>

static void add_on_vessel(contact_sum *sum, const contact *c, vec3 force, double magnitude)
{
    sum->on_vessel = vec3_add(sum->on_vessel, force);
    sum->moment = vec3_mad(sum->moment, c->point, magnitude);
    sum->weight += magnitude;
}

bool contact_sums_of(context *ctx, const world *w, double time_step, int32_t vessel, contact_sum_array *sums)
{
    if (!array_resize(ctx, sums, w->bodies.count))
        return false;
    if (sums->count > 0)
        memset(sums->data, 0, (size_t)sums->count * sizeof *sums->data);
    int32_t hull = vessel >= 0 ? w->vessels.body[vessel] : -1;
    for (int32_t i = 0; i < w->scratch.contacts.count; i++) {
        const contact *c = &w->scratch.contacts.data[i];
        vec3 force = vec3_scale(contact_impulse(c), 1 / time_step);
        double magnitude = vec3_length(force);
        if (magnitude == 0 || c->a >= sums->count || c->b >= sums->count)
            continue;
        sums->data[c->a].magnitude += magnitude;
        sums->data[c->b].magnitude += magnitude;
        if (c->a == hull)
            add_on_vessel(&sums->data[c->b], c, force, magnitude);
        else if (c->b == hull)
            add_on_vessel(&sums->data[c->a], c, vec3_neg(force), magnitude);
    }
    return true;
}
