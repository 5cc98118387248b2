#include "sim/mechanisms.h"

#include "sim/fenders.h"
#include "sim/force_chain.h"
#include "sim/patch_area.h"

#include <string.h>

/* A hull whose contact leans from the vertical by less than this slope does not push ice up or down: rounding, or a
   wall that rolls a little [1].  Range 0.01 to 0.1. */
static const double LEAST_SLOPE = 0.02;

/* A floe that is longer than this many characteristic lengths bends before it turns: beams on an elastic foundation
   shorter than lambda L = pi/4 are rigid (Hetenyi 1946), lambda = 1 / (sqrt(2) l). */
static const double BENDING_LENGTHS = PI / 4 * 1.4142135623730951;

bool contact_is_capped(const contact *c) { return c->impulse[0] >= c->impulse_limit; }

/* A contact that pushes ice up or down although friction holds it: where level ice bends rather than only crushes. */
static bool is_sloped(const contact *c)
{
    vec3 n = c->normal;
    return fabs(n.z) > fmax(c->friction_kinetic, LEAST_SLOPE) * sqrt(n.x * n.x + n.y * n.y);
}

/* Ice that may break and is a part of a sheet, or long enough. */
static bool can_bend(const model *m, const world *w, int32_t body)
{
    int32_t floe = w->bodies.owner[body], shape = w->bodies.shape[body];
    if (floe < 0 || shape < 0 || !w->floes.breakable[floe])
        return false;
    if (w->bodies.motion[body] != MOTION_DYNAMIC)
        return true;
    double length = ice_characteristic_length(&w->floes.material[floe], w->floes.thickness[floe],
                                              m->fracture.water_density, m->fracture.gravity);
    return 2 * w->shapes.shapes.plan_radius[shape] >= BENDING_LENGTHS * length;
}

/* By what holds the floe as a whole. */
static ice_mechanism by_reaction(const force_chain *chain)
{
    switch (chain->end) {
    case CHAIN_SHEET:
    case CHAIN_DRIVEN:
    case CHAIN_WALL:
    case CHAIN_VESSEL:
        return MECHANISM_CHAIN;
    case CHAIN_LOOP:
    case CHAIN_LONG:
    case CHAIN_ITSELF:
        return MECHANISM_ACCUMULATION;
    default:
        break;
    }
    if (chain->count > 1)
        return MECHANISM_ACCUMULATION;
    vec3 push = chain->link[0].push;
    bool away = push.x * push.x + push.y * push.y >= push.z * push.z;
    return chain->end == CHAIN_INERTIA && away ? MECHANISM_IMPACT : MECHANISM_SUBMERSION;
}

/* What is found of a floe once for all its contacts with a vessel. */
typedef struct reaction {
    int32_t hull, body; /* slots, -1: of none yet */
    ice_mechanism mechanism;
    bool bends;
} reaction;

static fram_status find_reaction(context *ctx, const model *m, world *w, bool *web, reaction *r, fram_error *error)
{
    if (!*web && !contact_web_make(ctx, w))
        return error_memory(error);
    *web = true;
    force_chain chain;
    force_chain_end(w, m->time_step, r->hull, r->body, &chain);
    r->mechanism = by_reaction(&chain);
    return FRAM_OK;
}

typedef struct search {
    reaction last;
    bool web; /* is made for this step */
} search;

/* A share for each zone that bears some of it. */
static bool add_by_zone(context *ctx, world *w, const ice_share *whole)
{
    double part[ZONE_COUNT];
    patch_area_zones(w, whole->vessel, whole->patch, whole->point, part);
    vec3 centre = w->bodies.position[w->vessels.body[whole->vessel]];
    wrench *zone = w->scratch.ice_loads.data[whole->vessel].zone;
    bool good = true;
    for (int z = 0; z < ZONE_COUNT && good; z++) {
        if (!(part[z] > 0))
            continue;
        ice_share share = *whole;
        share.zone = (uint8_t)z;
        share.normal = vec3_scale(whole->normal, part[z]);
        share.friction = vec3_scale(whole->friction, part[z]);
        wrench_add(&zone[z], centre, vec3_add(share.normal, share.friction), share.point);
        good = array_push(ctx, &w->scratch.shares, share);
    }
    return good;
}

static fram_status add_contact_share(context *ctx, const model *m, world *w, const contact *c, int32_t hull, search *s,
                                     fram_error *error)
{
    int32_t body = c->a == hull ? c->b : c->a, vessel = w->bodies.owner[hull];
    double scale = (c->a == hull ? 1 : -1) / m->time_step;
    bool ice = w->bodies.material[body] == MATERIAL_ICE && w->bodies.owner[body] >= 0;
    vec3 all = vec3_scale(contact_impulse(c), scale), normal = vec3_scale(c->normal, scale * c->impulse[0]);
    ice_share share = {.vessel = vessel, .body = body, .floe = ice ? w->floes.number[w->bodies.owner[body]] : -1};
    share.point = c->point;
    share.patch = c->patch;
    share.normal = normal;
    share.friction = vec3_sub(all, normal);
    share.mechanism = MECHANISM_CHAIN;
    if (s->last.hull != hull || s->last.body != body)
        s->last = (reaction){hull, body, MECHANISM_COUNT, ice && can_bend(m, w, body)};
    if (s->last.bends && is_sloped(c)) {
        share.mechanism = MECHANISM_BENDING;
    } else if (isfinite(c->impulse_limit) && contact_is_capped(c)) {
        share.mechanism = MECHANISM_CRUSHING;
    } else if (body_is_dynamic(&w->bodies, body) && ice) {
        fram_status status =
            s->last.mechanism == MECHANISM_COUNT ? find_reaction(ctx, m, w, &s->web, &s->last, error) : FRAM_OK;
        if (status != FRAM_OK)
            return status;
        share.mechanism = (uint8_t)s->last.mechanism;
    }
    return add_by_zone(ctx, w, &share) ? FRAM_OK : error_memory(error);
}

fram_status mechanisms_find(context *ctx, const model *m, world *w, fram_error *error)
{
    search s = {.last = {.hull = -1, .body = -1}};
    array_clear(&w->scratch.shares);
    fram_status status = FRAM_OK;
    for (int32_t i = 0; i < w->scratch.load_contacts.count && status == FRAM_OK; i++) {
        const contact *c = &w->scratch.contacts.data[w->scratch.load_contacts.data[i]];
        bool none = c->impulse[0] == 0 && c->impulse[1] == 0 && c->impulse[2] == 0;
        if (none || !contact_is_of_ice(w, c))
            continue;
        if (w->bodies.material[c->a] == MATERIAL_HULL && w->bodies.owner[c->a] >= 0)
            status = add_contact_share(ctx, m, w, c, c->a, &s, error);
        if (status == FRAM_OK && w->bodies.material[c->b] == MATERIAL_HULL && w->bodies.owner[c->b] >= 0)
            status = add_contact_share(ctx, m, w, c, c->b, &s, error);
    }
    return status;
}

static bool has_split(const world *w, int32_t floe)
{
    for (int32_t i = 0; i < w->scratch.fractures.count; i++) {
        const fracture_event *e = &w->scratch.fractures.data[i];
        if (e->kind == FRACTURE_SPLIT && e->floe == floe)
            return true;
    }
    return false;
}

void mechanisms_sum(world *w)
{
    for (int32_t v = 0; v < w->scratch.ice_loads.count; v++)
        memset(w->scratch.ice_loads.data[v].mechanism, 0, sizeof w->scratch.ice_loads.data[v].mechanism);
    for (int32_t i = 0; i < w->scratch.shares.count; i++) {
        ice_share *s = &w->scratch.shares.data[i];
        if (s->floe >= 0 && has_split(w, s->floe))
            s->mechanism = MECHANISM_SPLITTING;
        vec3 centre = w->bodies.position[w->vessels.body[s->vessel]];
        wrench *sums = w->scratch.ice_loads.data[s->vessel].mechanism;
        wrench_add(&sums[s->mechanism], centre, s->normal, s->point);
        wrench_add(&sums[MECHANISM_FRICTION], centre, s->friction, s->point);
    }
}
