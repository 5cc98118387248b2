#include "sim/ice_kinds.h"

#include "base/transcendental.h"

#include <math.h>

static bool is_stronger(const ice_kind *a, const ice_kind *b) { return a->crushing_strength > b->crushing_strength; }

/* Grows with how far ice is crushed before it breaks: sigma_f h^2 breaks it, and sigma_c (d h)^(1 + e) is what a patch
   as wide as it is thick bears. */
static double crushed_before(const ice_kind *k, double exponent)
{
    return k->flexural_strength * real_pow(k->thickness, 1 - exponent) / k->crushing_strength;
}

/* The same whichever comes first. */
static void take_kind(const scenario_ice *i, ice_range *r, ice_kind k, bool breaks)
{
    double thin = r->thinnest.thickness, thick = r->thickest.thickness, e = i->crushing_exponent;
    if (k.thickness < thin || (k.thickness == thin && is_stronger(&r->thinnest, &k)))
        r->thinnest = k;
    if (k.thickness > thick || (k.thickness == thick && is_stronger(&k, &r->thickest)))
        r->thickest = k;
    bool first = !(r->soonest.thickness > 0);
    if (breaks && (first || crushed_before(&k, e) < crushed_before(&r->soonest, e)))
        r->soonest = k;
    double most = r->stoutest.thickness;
    bool stronger = k.thickness == most && k.flexural_strength > r->stoutest.flexural_strength;
    if (breaks && (k.thickness > most || stronger))
        r->stoutest = k;
}

/* Of no ice. */
static const ice_range no_range = {.thinnest = {.thickness = HUGE_VAL}, .thickest = {.thickness = -HUGE_VAL}};

static const ice_kind no_kind = {(double)NAN, (double)NAN, (double)NAN};

bool ice_is_known(const ice_range *r) { return !isnan(r->thinnest.thickness); }

bool ice_kinds_alike(const ice_kind *a, const ice_kind *b)
{
    return a->thickness == b->thickness && a->flexural_strength == b->flexural_strength &&
           a->crushing_strength == b->crushing_strength;
}

bool ice_is_alike(const ice_range *r)
{
    return ice_kinds_alike(&r->thinnest, &r->thickest) && ice_kinds_alike(&r->thinnest, &r->soonest) &&
           ice_kinds_alike(&r->thinnest, &r->stoutest);
}

/* Where nothing may break the thinnest stands for what would. */
static ice_range with_soonest(ice_range r)
{
    if (!(r.soonest.thickness > 0))
        r.soonest = r.stoutest = r.thinnest;
    return r;
}

ice_kind ice_kind_of_population(const scenario_ice *i, const scenario_population *p)
{
    return (ice_kind){automatic_or(p->thickness, i->thickness),
                      automatic_or(p->flexural_strength, i->flexural_strength),
                      automatic_or(p->crushing_strength, i->crushing_strength)};
}

/* By keys. */
static ice_range ice_range_of(const scenario_ice *i)
{
    const ice_kind own = {i->thickness, i->flexural_strength, i->crushing_strength};
    ice_range r = no_range;
    for (int32_t k = 0; i->source == ICE_FLOES && k < i->floes.count; k++)
        take_kind(i, &r,
                  (ice_kind){automatic_or(i->floes.data[k].thickness, own.thickness), own.flexural_strength,
                             own.crushing_strength},
                  true);
    for (int32_t k = 0; scenario_ice_is_field(i) && k < i->populations.count; k++) {
        const scenario_population *p = &i->populations.data[k];
        take_kind(i, &r, ice_kind_of_population(i, p), p->breakable);
    }
    /* Those of a file are beside the populations that fill the water between them. */
    if (i->source == ICE_FILE || !(r.thickest.thickness > 0))
        take_kind(i, &r, own, true);
    return with_soonest(r);
}

/* Populations in use whose floes may break, or may not. */
static int32_t count_kinds(const scenario_ice *i, bool breakable)
{
    int32_t count = 0;
    for (int32_t k = 0; scenario_ice_is_field(i) && k < i->populations.count; k++)
        count += i->populations.data[k].breakable == breakable;
    return count;
}

bool ice_may_break(const scenario_ice *i)
{
    bool others = count_kinds(i, false) == 0 || i->source == ICE_FILE;
    return i->breakable && (others || count_kinds(i, true) > 0);
}

bool ice_all_breaks(const scenario_ice *i) { return i->breakable && count_kinds(i, false) == 0; }

ice_range ice_range_made(const scenario_ice *i, const world *made)
{
    ice_range r = no_range;
    if (!made || i->source != ICE_FILE)
        return ice_range_of(i);
    if (made->without_ice)
        return (ice_range){no_kind, no_kind, no_kind, no_kind};
    const floe_table *f = &made->floes;
    for (int32_t k = 0; k < f->count; k++)
        if (f->body[k] >= 0)
            take_kind(i, &r,
                      (ice_kind){f->thickness[k], f->material[k].flexural_strength, f->material[k].crushing_strength},
                      f->breakable[k]);
    /* Of an endless field some may be in the domain later, or none yet. */
    const pattern_table *p = &made->pattern;
    for (int32_t k = 0; k < p->count; k++)
        take_kind(i, &r,
                  (ice_kind){p->thickness[k], p->material[k].flexural_strength, p->material[k].crushing_strength},
                  p->breakable[k]);
    return r.thickest.thickness > 0 ? with_soonest(r) : ice_range_of(i);
}

ice_material ice_kind_material(const scenario_ice *i, const ice_kind *k)
{
    return (ice_material){i->density,           i->elastic_modulus,   i->poisson_ratio,
                          k->flexural_strength, k->crushing_strength, i->crushing_exponent};
}
