#include "sim/ice_kinds.h"

#include <math.h>

static void take_kind(ice_range *r, ice_kind k)
{
    if (k.thickness < r->thinnest.thickness)
        r->thinnest = k;
    if (k.thickness > r->thickest.thickness)
        r->thickest = k;
}

ice_range ice_range_of(const scenario_ice *i)
{
    const ice_kind own = {i->thickness, i->flexural_strength, i->crushing_strength};
    ice_range r = {.thinnest = {.thickness = HUGE_VAL}, .thickest = {.thickness = -HUGE_VAL}};
    for (int32_t k = 0; i->source == ICE_FLOES && k < i->floes.count; k++)
        take_kind(&r, (ice_kind){automatic_or(i->floes.data[k].thickness, own.thickness), own.flexural_strength,
                                 own.crushing_strength});
    bool populated = i->source == ICE_VORONOI || i->source == ICE_PACKED || i->source == ICE_FILE;
    for (int32_t k = 0; populated && k < i->populations.count; k++) {
        const scenario_population *p = &i->populations.data[k];
        take_kind(&r, (ice_kind){automatic_or(p->thickness, own.thickness),
                                 automatic_or(p->flexural_strength, own.flexural_strength),
                                 automatic_or(p->crushing_strength, own.crushing_strength)});
    }
    /* Floes of a file have their own beside the populations that fill the water between them. */
    if (i->source == ICE_FILE || !(r.thickest.thickness > 0))
        take_kind(&r, own);
    return r;
}

bool ice_may_break(const scenario_ice *i)
{
    bool drawn = (i->source == ICE_VORONOI || i->source == ICE_PACKED) && i->populations.count > 0, breaks = !drawn;
    for (int32_t k = 0; drawn && k < i->populations.count; k++)
        breaks = breaks || i->populations.data[k].breakable;
    return i->breakable && breaks;
}

ice_material ice_kind_material(const scenario_ice *i, const ice_kind *k)
{
    return (ice_material){i->density,           i->elastic_modulus,   i->poisson_ratio,
                          k->flexural_strength, k->crushing_strength, i->crushing_exponent};
}
