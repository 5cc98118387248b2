/* What edges give in rows of the solver; see edge_rows.h. */
#include "ice/edge_rows.h"

#include "base/pool.h"
#include "ice/edge_gap.h"
#include "ice/sheet.h"

#include <stdlib.h>

/* Two points of a line have this part of its length between them in the mean, and G is nearly straight over a piece. */
static const double MEAN_DISTANCE = 1.0 / 3;

/* The body whose edge may give at a contact, -1 without: breakable ice that is held or carried against ice that is
   free. */
static int32_t edge_body(const body_table *bodies, const floe_table *floes, const contact *c)
{
    if (bodies->material[c->a] != MATERIAL_ICE || bodies->material[c->b] != MATERIAL_ICE ||
        body_is_free(bodies, c->a) == body_is_free(bodies, c->b))
        return -1;
    int32_t held = body_is_free(bodies, c->a) ? c->b : c->a, floe = bodies->owner[held];
    return floe >= 0 && body_is_held(bodies, held) && floes->breakable[floe] ? held : -1;
}

/* Where the contacts [first, end) of a pair load the edge of a body, and what they carried. */
static edge_piece piece_of(const edge_job *j, const contact *contacts, edge_piece p, int32_t floe, bool is_a)
{
    const edge_compliance *e = j->edges;
    const floe_table *floes = j->floes;
    const contact *c = &contacts[p.first];
    double h = floes->thickness[floe], sign = is_a ? -1 : 1, count = p.end - p.first;
    p.length = ice_characteristic_length(&floes->material[floe], h, e->water_density, e->gravity);
    p.stiffness = e->water_density * e->gravity * p.length * p.length;
    p.most = EDGE_MOST_DEFLECTION * h;
    p.load = -sign * contact_memory_pair(j->memory, c).z / j->time_step;
    p.facing = vec2_scale(vec2_make(c->normal.x, c->normal.y), sign);
    for (int32_t i = p.first; i < p.end; i++) {
        vec3 at = contacts[i].point;
        p.groups += i == p.first || !contact_same_group(&contacts[i - 1], &contacts[i]);
        p.place = vec2_add(p.place, vec2_scale(vec2_make(at.x, at.y), 1 / count));
        for (int32_t k = p.first; k < i; k++)
            p.width = fmax(p.width, vec2_length(vec2_make(at.x - contacts[k].point.x, at.y - contacts[k].point.y)));
    }
    p.influence = sheet_edge_influence(MEAN_DISTANCE * p.width / p.length);
    return p;
}

typedef struct edge_search {
    const edge_job *job;
    const contact *contacts;
} edge_search;

static int32_t pick_edge_contacts(const void *arg, int32_t first, int32_t end, int32_t *out)
{
    const edge_search *w = arg;
    int32_t found = 0;
    for (int32_t i = first; i < end; i++)
        if (edge_body(w->job->bodies, w->job->floes, &w->contacts[i]) >= 0)
            out[found++] = i;
    return found;
}

/* The end of the contacts of one pair that begin here, and the largest of their limits. */
static int32_t pair_end(const contact_array *contacts, int32_t first, double *limit)
{
    const contact *c = contacts->data;
    int32_t end = first;
    for (*limit = 0; end < contacts->count && c[end].a == c[first].a && c[end].b == c[first].b; end++)
        *limit = fmax(*limit, c[end].impulse_limit);
    return end;
}

static bool find_pieces(context *ctx, const edge_job *j, edge_rows_work *w, const contact_array *contacts)
{
    const contact *c = contacts->data;
    array_clear(&w->pieces);
    if (!pool_pick(ctx, pick_edge_contacts, &(edge_search){j, c}, contacts->count, &w->picked))
        return false;
    for (int32_t i = 0, first, end; i < w->picked.count; i += end - first) {
        double limit;
        first = w->picked.data[i];
        end = pair_end(contacts, first, &limit);
        if (!(limit > 0))
            continue;
        int32_t held = edge_body(j->bodies, j->floes, &c[first]);
        edge_piece p = {.first = first, .end = end};
        if (!array_push(ctx, &w->pieces, piece_of(j, c, p, j->bodies->owner[held], held == c[first].a)))
            return false;
    }
    return true;
}

/* ---- neighbours ---- */

static int compare_places(const void *a, const void *b)
{
    const edge_piece *x = a, *y = b;
    if (x->along != y->along)
        return x->along < y->along ? -1 : 1;
    return (x->first > y->first) - (x->first < y->first);
}

/* Sorts along the longer side of what they cover, so that a channel costs the same whichever way it goes. */
static void sort_pieces(edge_piece_array *work)
{
    vec2 lo = work->data[0].place, hi = lo;
    for (int32_t i = 1; i < work->count; i++) {
        vec2 p = work->data[i].place;
        lo = vec2_make(fmin(lo.x, p.x), fmin(lo.y, p.y));
        hi = vec2_make(fmax(hi.x, p.x), fmax(hi.y, p.y));
    }
    bool y_longer = hi.y - lo.y > hi.x - lo.x;
    for (int32_t i = 0; i < work->count; i++)
        work->data[i].along = y_longer ? work->data[i].place.y : work->data[i].place.x;
    qsort(work->data, (size_t)work->count, sizeof *work->data, compare_places);
}

/* By how much a neighbour's load grows with this one's: in proportion to what both carried, no more than as much. */
static double load_share(double own, double other)
{
    if (other == 0 || own * other < 0)
        return 0;
    return fabs(other) < fabs(own) ? other / own : 1;
}

/* Each adds to the other what its load bends there, if both stand at one side of a channel.  Half of all pairs stand
   at two sides, and many of the others have no loads that could grow together. */
static void add_neighbour(edge_piece *x, edge_piece *y)
{
    double alike = vec2_dot(x->facing, y->facing);
    if (alike <= 0)
        return;
    double of_x = load_share(x->load, y->load), of_y = load_share(y->load, x->load);
    if (of_x == 0 && of_y == 0)
        return;
    double apart = vec2_length(vec2_sub(x->place, y->place)), influence = sheet_edge_influence(apart / x->length);
    x->influence += alike * of_x * influence;
    y->influence += alike * of_y * (y->length == x->length ? influence : sheet_edge_influence(apart / y->length));
}

static void find_piece_neighbours(edge_piece_array *work)
{
    double reach = 0;
    for (int32_t i = 0; i < work->count; i++)
        reach = fmax(reach, SHEET_INFLUENCE_MOST * work->data[i].length);
    if (work->count > 1)
        sort_pieces(work);
    for (int32_t i = 0; i < work->count; i++)
        for (int32_t k = i + 1; k < work->count && work->data[k].along < work->data[i].along + reach; k++)
            add_neighbour(&work->data[i], &work->data[k]);
}

/* ---- rows ---- */

/* Contacts [first, end) of some groups that share a load get what a massless edge of this compliance [m/N] gives them:
   w = C P with P = p / dt moves by C (p / dt - P) / dt, give p + recoil, give = C / dt^2.  Nothing past the end of the
   theory. */
static void set_rows(const edge_job *j, int32_t first, int32_t end, int32_t groups, double compliance, double load,
                     double most, contact_array *contacts)
{
    double dt = j->time_step;
    for (int32_t i = first; i < end && fabs(load) * compliance < most; i++) {
        contacts->data[i].give = groups * compliance / (dt * dt);
        contacts->data[i].recoil = -compliance * load / dt;
    }
}

/* ---- hulls ---- */

/* The support that was under a patch in the last step, -1 without. */
static int32_t support_of(const edge_job *j, const crushing_patch *p)
{
    const floe_table *floes = j->floes;
    double reach = edge_reach(j->edges, &floes->material[p->floe], floes->thickness[p->floe], p->horizontal_area);
    return edge_support_nearest(j->supports, j->bodies, p->surface_body, p->centre, reach);
}

/* Whether a patch has a support: breakable ice that is held, under a hull. */
static bool has_support(const edge_job *j, const crushing_patch *p)
{
    return j->supports && body_is_held(j->bodies, p->floe_body) && j->floes->breakable[p->floe] &&
           j->bodies->material[p->surface_body] == MATERIAL_HULL;
}

/* What a support carried is shared by the patches that it is nearest to, by their horizontal areas: loads that seams
   divide are neither lost nor doubled. */
static void set_patches(const edge_job *j, edge_rows_work *w, const crushing_patch_array *patches,
                        contact_array *contacts)
{
    for (int32_t i = 0; i < patches->count; i++) {
        const crushing_patch *p = &patches->data[i];
        w->support.data[i] = has_support(j, p) ? support_of(j, p) : -1;
        if (w->support.data[i] >= 0 && p->compliance > 0)
            w->claimed.data[w->support.data[i]] += p->horizontal_area;
    }
    for (int32_t i = 0; i < patches->count; i++) {
        const crushing_patch *p = &patches->data[i];
        int32_t row = w->support.data[i], first = p->contact_first;
        if (row >= 0)
            edge_gap_open(j->supports, row, j->bodies, j->floes, j->time_step, p, contacts);
        if (!j->edges->elastic || !(p->compliance > 0))
            continue;
        double load = row < 0 ? 0 : j->supports->own[row] * p->horizontal_area / w->claimed.data[row];
        set_rows(j, first, first + p->contact_count, 1, p->compliance, load,
                 EDGE_MOST_DEFLECTION * j->floes->thickness[p->floe], contacts);
    }
}

/* Those of pieces. */
static bool set_pieces(context *ctx, const edge_job *j, edge_rows_work *w, contact_array *contacts)
{
    if (!find_pieces(ctx, j, w, contacts))
        return false;
    find_piece_neighbours(&w->pieces);
    for (int32_t i = 0; i < w->pieces.count; i++) {
        const edge_piece *p = &w->pieces.data[i];
        set_rows(j, p->first, p->end, p->groups, p->influence / p->stiffness, p->load, p->most, contacts);
    }
    return true;
}

bool edge_rows_set(context *ctx, const edge_job *j, edge_rows_work *w, const crushing_patch_array *patches,
                   contact_array *contacts)
{
    int32_t supports = j->supports ? j->supports->count : 0;
    if (!array_resize(ctx, &w->support, patches->count) || !array_resize(ctx, &w->claimed, supports))
        return false;
    if (j->edges->elastic && !set_pieces(ctx, j, w, contacts))
        return false;
    for (int32_t i = 0; i < supports; i++)
        w->claimed.data[i] = 0;
    set_patches(j, w, patches, contacts);
    return true;
}

void edge_rows_free(context *ctx, edge_rows_work *w)
{
    array_free(ctx, &w->picked);
    array_free(ctx, &w->pieces);
    array_free(ctx, &w->support);
    array_free(ctx, &w->claimed);
}
