/* What patches on level and fixed ice stand on, kept for the step to come; see ice/edge_give.h. */
#include "ice/edge_gap.h"
#include "ice/fracture_parts.h"
#include "ice/strip.h"

/* The load that was nearest to a part in the last step. */
static edge_stand old_stand(const fracture_job *j, const fracture_load *l, vec3 place)
{
    const fracture_settings *f = j->settings;
    double reach = fracture_edge_reach(f, &l->ice, l->thickness, l->horizontal_area);
    return edge_stand_find(j->state->supports, j->state->bodies, l->surface, place, reach);
}

/* Of what a patch may bear as it does all of it: sweeps leave some of a limit. */
static const double AT_LIMIT = 0.9;

static bool is_at_limit(const contact_array *contacts, const crushing_patch *p)
{
    double bears = edge_gap_pressed(p, contacts), most = 0;
    for (int32_t i = p->contact_first; i < p->contact_first + p->contact_count; i++)
        most += contacts->data[i].impulse_limit;
    return bears > 0 && bears >= AT_LIMIT * most;
}

bool fracture_note_parts(const fracture_job *j, const crushing_patch_array *patches)
{
    load_work *w = &j->scratch->load;
    const body_table *bodies = j->state->bodies;
    const edge_gap_rules rules = {j->settings->edge_gaps, j->settings->edge_melts, j->settings->latent_heat};
    array_clear(&w->parts);
    if (!j->settings->edges_give)
        return true;
    for (int32_t i = 0; i < w->all.count; i++) {
        const fracture_load *l = &w->all.data[i];
        bool held = body_is_held(bodies, l->body) && bodies->material[l->surface] == MATERIAL_HULL;
        const crushing_patch *patch = &patches->data[l->patch];
        load_part p = {.held = held,
                       .patch = l->patch,
                       .floe = l->floe,
                       .surface = l->surface,
                       .place = body_to_local(bodies, l->surface, patch->centre),
                       .level = l->horizontal_area,
                       .over = patch->over && is_at_limit(j->state->contacts, patch),
                       .own = l->vector.z,
                       .gap = held ? edge_gap_after(rules, bodies, l->ice.density, j->settings->time_step, patch,
                                                    j->state->contacts)
                                   : 0};
        if (held && j->state->supports) {
            edge_stand old = old_stand(j, l, patch->centre);
            p.impulse = old.impulse;
            p.up = old.up;
        }
        if (!array_push(j->ctx, &w->parts, p))
            return false;
    }
    return true;
}

/* Loads were kept in the order of their least parts, which are their roots. */
static void find_roots(load_work *w)
{
    int32_t kept = 0;
    for (int32_t i = 0; i < w->parts.count; i++) {
        load_part *p = &w->parts.data[i];
        p->root = i;
        while (w->root.data[p->root] != p->root)
            p->root = w->root.data[p->root];
        if (p->root == i)
            p->load = kept++;
        load_part *root = &w->parts.data[p->root];
        root->sum += p->level;
        root->impulse = fmax(root->impulse, p->impulse);
        root->up = fabs(p->up) > fabs(root->up) ? p->up : root->up;
    }
}

/* At which an edge goes up that stood up by this much a step ago: no faster than the surface that takes it along. */
static double rate_of(const fracture_job *j, const fracture_load *l, double up)
{
    double rate = (l->rise - up) / j->settings->time_step;
    return fmin(fmax(rate, fmin(l->rate, 0)), fmax(l->rate, 0));
}

bool fracture_note_rises(const fracture_job *j)
{
    load_work *w = &j->scratch->load;
    if (!array_resize(j->ctx, &w->rises, w->all.count))
        return false;
    for (int32_t i = 0; i < w->all.count; i++) {
        w->rises.data[i] = (load_rise){.time = HUGE_VAL};
        if (!j->settings->edges_give)
            w->all.data[i].rate = 0;
    }
    if (!j->settings->edges_give)
        return true;
    find_roots(w);
    for (int32_t i = 0; i < w->parts.count; i++) {
        const load_part *p = &w->parts.data[i];
        if (p->root != i)
            continue;
        fracture_load *l = &w->all.data[p->load];
        l->rate = p->held ? rate_of(j, l, p->up) : 0;
        if (!p->held)
            continue;
        load_rise *r = &w->rises.data[p->load];
        r->up = l->rise;
        if (!j->settings->edge_inertia)
            continue;
        r->load = fabs(l->vector.z);
        r->impulse = p->impulse + r->load * j->settings->time_step;
        r->time = edge_rise_time(r->impulse, r->load);
    }
    return true;
}

/* Of the strip under a wide contact: load over deflection over rho_w g, and load at its strength over that [m2]. */
static void keep_strip(const fracture_job *j, const load_part *p, const edge_ice *edge, int32_t row)
{
    const fracture_settings *f = j->settings;
    const floe_table *floes = j->state->floes;
    edge_support_table *e = j->state->supports;
    e->strip[row] = e->strip_bears[row] = 0;
    if (!(edge->strip > 0))
        return;
    double h = floes->thickness[p->floe],
           length = ice_characteristic_length(&floes->material[p->floe], h, f->water_density, f->gravity);
    strip s = strip_solve(edge->length / length);
    e->strip[row] = edge->strip * length * s.stiffness;
    e->strip_bears[row] = edge_strip_bears(edge->strip, s.moment * length, h);
}

fram_status fracture_keep_supports(const fracture_job *j)
{
    load_work *w = &j->scratch->load;
    edge_support_table *e = j->state->supports;
    if (!j->settings->edges_give || !e)
        return FRAM_OK;
    if (!table_resize(j->ctx, e, &edge_support_table_info, w->parts.count))
        return error_memory(j->error);
    int32_t row = 0;
    for (int32_t i = 0; i < w->parts.count; i++) {
        const load_part *p = &w->parts.data[i], *root = &w->parts.data[p->root];
        if (!p->held)
            continue;
        const edge_ice *edge = &w->edges.data[root->load];
        e->surface[row] = p->surface;
        e->generation[row] = j->state->bodies->generation[p->surface];
        e->place[row] = p->place;
        e->wedges[row] = edge->wedges;
        e->load[row] = w->rises.data[root->load].load;
        e->impulse[row] = w->rises.data[root->load].impulse;
        e->own[row] = p->own;
        e->gap[row] = p->gap;
        e->rise[row] = w->rises.data[root->load].up;
        e->part[row] = p->level > 0 ? p->level / root->sum : 1;
        e->known[row] = w->rises.data[root->load].known;
        e->over[row] = p->over;
        keep_strip(j, p, edge, row++);
    }
    return table_resize(j->ctx, e, &edge_support_table_info, row) ? FRAM_OK : error_memory(j->error);
}

static bool has_broken(const fracture_job *j, int32_t patch)
{
    const fracture_load_array *failed = &j->scratch->load.all;
    for (int32_t i = 0; i < failed->count; i++)
        if (failed->data[i].patch == patch && j->scratch->broken.data[failed->data[i].body])
            return true;
    return false;
}

void fracture_renew_supports(const fracture_job *j)
{
    const load_work *w = &j->scratch->load;
    edge_support_table *e = j->state->supports;
    if (!j->settings->edges_give || !e)
        return;
    for (int32_t i = 0, row = 0; i < w->parts.count; i++) {
        const load_part *p = &w->parts.data[i];
        if (!p->held)
            continue;
        if (has_broken(j, w->parts.data[p->root].patch))
            e->known[row] = e->over[row] = 0;
        row++;
    }
}
