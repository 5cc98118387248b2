#include "sim/ice_loads.h"

#include "base/pool.h"
#include "sim/fenders.h"
#include "sim/mechanisms.h"

#include <string.h>

static int32_t vessel_of(const world *w, int32_t body)
{
    return w->bodies.material[body] == MATERIAL_HULL ? w->bodies.owner[body] : -1;
}

static void add_contact(const world *w, const contact *c, int32_t vessel, double sign, double per_time, ice_load *load)
{
    vec3 centre = w->bodies.position[w->vessels.body[vessel]];
    vec3 all = vec3_scale(contact_impulse(c), sign * per_time);
    vec3 normal = vec3_scale(c->normal, sign * per_time * c->impulse[0]);
    wrench_add(&load->total, centre, all, c->point);
    wrench_add(&load->friction, centre, vec3_sub(all, normal), c->point);
    wrench_add(contact_is_capped(c) ? &load->capped : &load->below_cap, centre, normal, c->point);
    load->contacts++;
}

/* A capped row dissipates its impulse times the mean approach speed; the solved speed stands for it. */
static double crushing_work(const world *w, const contact *c)
{
    vec3 va = body_point_velocity(&w->bodies, c->a, c->point), vb = body_point_velocity(&w->bodies, c->b, c->point);
    double approach = -vec3_dot(c->normal, vec3_sub(va, vb));
    return approach > 0 ? c->impulse[0] * approach : 0;
}

/* Of a contact with another hull or a wall. */
static void add_hull_contact(const world *w, const contact *c, int32_t vessel, double scale, ice_load *load)
{
    vec3 centre = w->bodies.position[w->vessels.body[vessel]];
    wrench_add(&load->hulls, centre, vec3_scale(contact_impulse(c), scale), c->point);
}

/* Kept for the next step from the first contact on; before, there is nothing to keep. */
static bool keep_hull_contacts(context *ctx, world *w)
{
    const ice_load *loads = w->scratch.ice_loads.data;
    bool any = w->hull_contacts.count > 0;
    for (int32_t v = 0; v < w->vessels.count && !any; v++)
        any = vec3_dot(loads[v].hulls.force, loads[v].hulls.force) > 0;
    if (any && !table_resize(ctx, &w->hull_contacts, &hull_contact_table_info, w->vessels.count))
        return false;
    for (int32_t v = 0; v < w->hull_contacts.count; v++) {
        w->hull_contacts.force[v] = loads[v].hulls.force;
        w->hull_contacts.moment[v] = loads[v].hulls.moment;
    }
    return true;
}

/* ---- which contacts count ---- */

static int32_t pick_load_contacts(const void *arg, int32_t first, int32_t end, int32_t *out)
{
    const world *w = arg;
    const uint8_t *kind = w->bodies.material;
    int32_t found = 0;
    for (int32_t i = first; i < end; i++) {
        const contact *c = &w->scratch.contacts.data[i];
        bool hull = kind[c->a] == MATERIAL_HULL || kind[c->b] == MATERIAL_HULL;
        if (hull || (isfinite(c->impulse_limit) && contact_is_capped(c)))
            out[found++] = i;
    }
    return found;
}

/* Work of the listed contacts; 0 for those that crush no ice [J]. */
enum { WORK_BLOCK = 512 };
static void work_block(void *arg, int32_t block, int32_t thread)
{
    world *w = arg;
    const int32_array *rows = &w->scratch.load_contacts;
    (void)thread;
    for (int32_t i = WORK_BLOCK * block; i < pool_block_end(block, WORK_BLOCK, rows->count); i++) {
        const contact *c = &w->scratch.contacts.data[rows->data[i]];
        bool crushes = contact_is_of_ice(w, c) && isfinite(c->impulse_limit) && contact_is_capped(c);
        w->scratch.contact_work.data[i] = crushes ? crushing_work(w, c) : 0;
    }
}

/* Lists the contacts with a hull and those at their limit, in a field whose ice does not crush a few of many, and what
   work they do. */
static bool list_load_contacts(context *ctx, world *w)
{
    int32_array *rows = &w->scratch.load_contacts;
    if (!pool_pick(ctx, pick_load_contacts, w, w->scratch.contacts.count, rows) ||
        !array_resize(ctx, &w->scratch.contact_work, rows->count))
        return false;
    pool_run(ctx, work_block, w, pool_blocks(rows->count, WORK_BLOCK));
    return true;
}

/* ---- sums ---- */

fram_status sum_ice_loads(context *ctx, const model *m, world *w, fram_error *error)
{
    int32_t vessels = w->vessels.count;
    if (!array_resize(ctx, &w->scratch.ice_loads, vessels) || !list_load_contacts(ctx, w))
        return error_memory(error);
    ice_load *loads = w->scratch.ice_loads.data;
    if (vessels > 0)
        memset(loads, 0, (size_t)vessels * sizeof *loads);
    for (int32_t i = 0; i < w->scratch.load_contacts.count; i++) {
        const contact *c = &w->scratch.contacts.data[w->scratch.load_contacts.data[i]];
        bool ice = contact_is_of_ice(w, c);
        w->clock.work_crushed[0] += w->scratch.contact_work.data[i];
        int32_t va = vessel_of(w, c->a), vb = vessel_of(w, c->b);
        if (va >= 0 && ice)
            add_contact(w, c, va, 1, 1 / m->time_step, &loads[va]);
        else if (va >= 0)
            add_hull_contact(w, c, va, 1 / m->time_step, &loads[va]);
        if (vb >= 0 && ice)
            add_contact(w, c, vb, -1, 1 / m->time_step, &loads[vb]);
        else if (vb >= 0)
            add_hull_contact(w, c, vb, -1 / m->time_step, &loads[vb]);
    }
    if (!keep_hull_contacts(ctx, w))
        return error_memory(error);
    for (int32_t v = 0; v < vessels && load_window_length(w) > 0; v++) {
        int64_t row = load_window_row(w, w->clock.step[0], v);
        w->load_window.force[row] = loads[v].total.force;
        w->load_window.moment[row] = loads[v].total.moment;
    }
    return mechanisms_find(ctx, m, w, error);
}

wrench last_ice_load(const world *w, int32_t vessel)
{
    if (vessel >= w->vessels.count || load_window_length(w) == 0 || w->clock.step[0] == 0)
        return (wrench){0};
    int64_t row = load_window_row(w, w->clock.step[0] - 1, vessel);
    return (wrench){w->load_window.force[row], w->load_window.moment[row]};
}

wrench last_contact_load(const world *w, int32_t vessel)
{
    wrench load = last_ice_load(w, vessel);
    if (vessel < w->hull_contacts.count) {
        load.force = vec3_add(load.force, w->hull_contacts.force[vessel]);
        load.moment = vec3_add(load.moment, w->hull_contacts.moment[vessel]);
    }
    return load;
}

wrench load_window_average(const world *w, int32_t vessel)
{
    wrench sum = {0};
    int64_t steps = vessel < w->vessels.count ? load_window_length(w) : 0;
    for (int64_t i = 0; i < steps; i++) {
        int64_t row = load_window_row(w, i, vessel);
        sum.force = vec3_add(sum.force, w->load_window.force[row]);
        sum.moment = vec3_add(sum.moment, w->load_window.moment[row]);
    }
    if (steps == 0)
        return sum;
    return (wrench){vec3_scale(sum.force, 1 / (double)steps), vec3_scale(sum.moment, 1 / (double)steps)};
}
