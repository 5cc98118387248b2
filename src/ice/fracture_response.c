/* Loads that floes feel over the time in which their edges respond; see ice/edge_load.h. */
#include "ice/fracture_parts.h"

#include "base/transcendental.h"

#include <stdlib.h>

#define TABLE_SELF edge_load_table
TABLE_DEFINE(edge_load, EDGE_LOAD_FIELDS)
#undef TABLE_SELF

double fracture_response_time(const fracture_settings *settings, const ice_material *ice, double thickness,
                              double reach)
{
    double k = PI / 4 / reach, k2 = k * k;
    double stiffness = ice_plate_stiffness(ice, thickness) * k2 * k2 + settings->water_density * settings->gravity;
    double mass = ice->density * thickness + settings->water_density / k;
    return sqrt(mass / stiffness);
}

/* A load that floes feel later than it acts: sheets and fixed floes do not (docs/decisions/0176). */
static bool responds(const fracture_job *j, const fracture_load *l)
{
    return !l->tile && !body_is_held(j->state->bodies, l->body);
}

static int compare_pairs(const void *a, const void *b)
{
    const load_pair *x = a, *y = b;
    if (x->floe != y->floe)
        return x->floe < y->floe ? -1 : 1;
    if (x->surface != y->surface)
        return x->surface < y->surface ? -1 : 1;
    return x->load < y->load ? -1 : x->load > y->load;
}

/* Loads by floe and surface, to be searched; none has felt anything yet. */
static bool sort_pairs(const fracture_job *j)
{
    load_work *w = &j->scratch->load;
    array_clear(&w->pairs);
    if (!array_resize(j->ctx, &w->felt, w->all.count))
        return false;
    for (int32_t i = 0; i < w->all.count; i++) {
        const fracture_load *l = &w->all.data[i];
        w->felt.data[i] = (vec3){0, 0, 0};
        load_pair p = {j->state->floes->number[l->floe], l->surface, i};
        if (responds(j, l) && !array_push(j->ctx, &w->pairs, p))
            return false;
    }
    if (w->pairs.count > 1)
        qsort(w->pairs.data, (size_t)w->pairs.count, sizeof *w->pairs.data, compare_pairs);
    return true;
}

/* The first of the pairs that is not before (floe, surface). */
static int32_t first_pair(const load_work *w, int32_t floe, int32_t surface)
{
    int32_t lo = 0, hi = w->pairs.count;
    while (lo < hi) {
        int32_t mid = lo + (hi - lo) / 2;
        const load_pair *p = &w->pairs.data[mid];
        if (p->floe < floe || (p->floe == floe && p->surface < surface))
            lo = mid + 1;
        else
            hi = mid;
    }
    return lo;
}

/* What was felt under a patch goes to the nearest patch of the same two bodies; with the last of them it is gone. */
static void hand_over(const fracture_job *j, int32_t row)
{
    load_work *w = &j->scratch->load;
    const edge_load_table *e = j->state->edge_loads;
    int32_t best = -1;
    double least = HUGE_VAL;
    if (e->surface[row] < 0 || e->surface[row] >= j->state->bodies->count ||
        j->state->bodies->generation[e->surface[row]] != e->generation[row])
        return;
    for (int32_t i = first_pair(w, e->floe[row], e->surface[row]); i < w->pairs.count; i++) {
        const load_pair *p = &w->pairs.data[i];
        if (p->floe != e->floe[row] || p->surface != e->surface[row])
            break;
        double way = vec2_length(vec2_sub(w->all.data[p->load].place, e->place[row]));
        if (way < least) {
            least = way;
            best = p->load;
        }
    }
    if (best >= 0)
        w->felt.data[best] = vec3_add(w->felt.data[best], e->load[row]);
}

/* The load of the step becomes what the edge feels: exact for a load that is constant within the step. */
static void respond(const fracture_job *j, fracture_load *l, vec3 felt)
{
    double time = fracture_response_time(j->settings, &l->ice, l->thickness, fracture_reach(j, l));
    double part = 1 - real_exp(-j->settings->time_step / time);
    l->vector = vec3_mad(felt, vec3_sub(l->vector, felt), part);
}

fram_status fracture_respond(const fracture_job *j)
{
    load_work *w = &j->scratch->load;
    edge_load_table *e = j->state->edge_loads;
    if (j->settings->load_rule != EDGE_LOAD_RESPONSE)
        return FRAM_OK;
    if (!sort_pairs(j))
        return error_memory(j->error);
    for (int32_t row = 0; row < e->count; row++)
        hand_over(j, row);
    if (!table_resize(j->ctx, e, &edge_load_table_info, w->pairs.count))
        return error_memory(j->error);
    for (int32_t i = 0, row = 0; i < w->all.count; i++) {
        fracture_load *l = &w->all.data[i];
        if (!responds(j, l))
            continue;
        respond(j, l, w->felt.data[i]);
        e->floe[row] = j->state->floes->number[l->floe];
        e->surface[row] = l->surface;
        e->generation[row] = j->state->bodies->generation[l->surface];
        e->place[row] = l->place;
        e->load[row++] = l->vector;
    }
    return FRAM_OK;
}
