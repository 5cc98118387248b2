/* Crushing limits of level floes that meet side to side; see crushing.h.  Their contacts come from the narrow phase,
   which knows of gaps and remembers what touched: a packed field needs both, and a patch for each of its pairs would
   cost more than the rest of its step. */
#include "ice/crushing.h"

#include "base/pool.h"

#include <assert.h>

/* Points nearer than this many skins touch: at rest they stand one skin apart, to rounding. */
#define TOUCHING_SKINS 2

/* A point on a side counts as within it: rounding of places, as part of the smaller floe's size. */
#define SAME_PLACE 1e-9

/* The contacts first..end-1 of one pair. */
typedef struct side_group {
    int32_t a, b, first, end;
} side_group;

/* One of the two floes. */
typedef struct side_floe {
    mat3 turn;
    vec3 at;
    const vec2 *vertex, *side; /* of its only piece, with the sides' outward normals */
    int32_t count;
    double half_height;
} side_floe;

static side_floe floe_of(const body_table *bodies, const shape_store *shapes, int32_t body)
{
    int32_t shape = bodies->shape[body], piece = shapes->shapes.piece_first[shape];
    int32_t first = shapes->pieces.first[piece];
    return (side_floe){
        quat_matrix(bodies->orientation[body]), bodies->position[body],     shapes->vertices.point + first,
        shapes->vertices.side + first,          shapes->pieces.size[piece], shapes->shapes.half_height[shape]};
}

/* A range of the parameter of a line. */
typedef struct range {
    double lo, hi;
} range;

/* Cuts a range down by one side: `room` is left of it where the parameter is 0, `rate` of it goes with the parameter.
   Written without fmin and fmax, which are calls. */
static void range_cut(range *r, double room, double rate)
{
    if (rate > 0) {
        double t = room / rate;
        r->hi = t < r->hi ? t : r->hi;
    } else if (rate < 0) {
        double t = room / rate;
        r->lo = t > r->lo ? t : r->lo;
    } else if (room < 0) {
        r->hi = -HUGE_VAL;
    }
}

/* Cuts the ranges of two parallel lines, through p - step and p + step along d (global), down to what lies in the plan
   of a floe that is grown by `rim` [m]. */
static void cut_by_plan(const side_floe *f, vec3 p, vec3 step, vec3 d, double rim, range out[2])
{
    vec3 place = mat3_tmul_vec(f->turn, vec3_sub(p, f->at)), way = mat3_tmul_vec(f->turn, d);
    vec3 aside = mat3_tmul_vec(f->turn, step);
    for (int32_t k = 0; k < f->count; k++) {
        vec2 n = f->side[k], v = f->vertex[k];
        double rate = n.x * way.x + n.y * way.y, shift = n.x * aside.x + n.y * aside.y;
        double room = n.x * (v.x - place.x) + n.y * (v.y - place.y) + rim;
        range_cut(&out[0], room + shift, rate);
        range_cut(&out[1], room - shift, rate);
    }
}

/* Height that both floes have in common at p [m]. */
static double common_height(const side_floe floe[2], vec3 p)
{
    double bottom = -HUGE_VAL, top = HUGE_VAL;
    for (int i = 0; i < 2; i++) {
        vec3 up = mat3_column(floe[i].turn, 2), at = floe[i].at;
        double middle = at.z - (up.x * (p.x - at.x) + up.y * (p.y - at.y)) / up.z, half = floe[i].half_height / up.z;
        bottom = middle - half > bottom ? middle - half : bottom;
        top = middle + half < top ? middle + half : top;
    }
    return top > bottom ? top - bottom : 0;
}

/* The flat side that the other floe has entered lies before or behind the deepest point by half its depth: the one of
   both places where the level line along it that both floes have in common is longer.  Seen from the middle of the
   points, since any of several may be the deepest. */
static double contact_area(const side_floe floe[2], vec3 middle, const contact *deepest, double rim,
                           double *common_width)
{
    vec3 n = deepest->normal, p = vec3_mad(middle, n, vec3_dot(vec3_sub(deepest->point, middle), n));
    vec3 along = vec3_unit(vec3_make(-n.y, n.x, 0)), step = vec3_scale(n, 0.5 * deepest->depth);
    range line[2] = {{-HUGE_VAL, HUGE_VAL}, {-HUGE_VAL, HUGE_VAL}};
    double width = 0;
    for (int i = 0; i < 2; i++)
        cut_by_plan(&floe[i], p, step, along, rim, line);
    for (int i = 0; i < 2; i++)
        width = line[i].hi - line[i].lo > width ? line[i].hi - line[i].lo : width;
    *common_width = width;
    return width * common_height(floe, middle);
}

/* Largest force on a contact of two floes: the pressure of the weaker one, no more than builds a ridge or a raft. */
static double largest_force(const pack_limit *limit, const pack_floe ice[2], double friction, double area, double width)
{
    double force = fmin(ice_crushing_pressure(&ice[0].ice, area), ice_crushing_pressure(&ice[1].ice, area)) * area;
    return width > 0 ? fmin(force, pack_line_load(limit, ice, friction, width) * width) : force;
}

typedef struct sides_work {
    const crushing_settings *settings;
    const body_table *bodies;
    const shape_store *shapes;
    const floe_table *floes;
    const pair_policies *policies;
    contact_array *contacts;
} sides_work;

static void limit_group(const sides_work *w, const side_group *g)
{
    const crushing_settings *s = w->settings;
    const body_table *bodies = w->bodies;
    contact_array *contacts = w->contacts;
    const double *radius = w->shapes->shapes.radius;
    double rim = TOUCHING_SKINS * s->skin + SAME_PLACE * fmin(radius[bodies->shape[g->a]], radius[bodies->shape[g->b]]);
    int32_t touching = 0, deepest = g->first;
    vec3 middle = {0, 0, 0};
    for (int32_t i = g->first; i < g->end; i++) {
        if (contacts->data[i].depth >= -rim) {
            touching++;
            middle = vec3_add(middle, contacts->data[i].point);
        }
        deepest = contacts->data[i].depth > contacts->data[deepest].depth ? i : deepest;
    }
    double limit = 0;
    if (touching > 0) {
        middle = vec3_scale(middle, 1.0 / touching);
        const side_floe floe[2] = {floe_of(bodies, w->shapes, g->a), floe_of(bodies, w->shapes, g->b)};
        double width, area = contact_area(floe, middle, &contacts->data[deepest], rim, &width);
        const int32_t row[2] = {bodies->owner[g->a], bodies->owner[g->b]};
        pack_floe ice[2];
        for (int i = 0; i < 2; i++) {
            vec3 local = mat3_tmul_vec(floe[i].turn, vec3_sub(middle, floe[i].at));
            ice[i] = (pack_floe){strength_crushing_at(&s->strength, w->floes, row[i], vec2_make(local.x, local.y)),
                                 w->floes->thickness[row[i]]};
        }
        double friction = contacts->data[deepest].friction_static;
        limit = largest_force(&s->pack, ice, friction, area, width) * s->time_step / touching;
    }
    assert(limit >= 0 && isfinite(limit));
    for (int32_t i = g->first; i < g->end; i++) {
        contact *c = &contacts->data[i];
        c->impulse_limit = c->depth >= -rim ? limit : 0;
        c->correct = false;
    }
}

enum { SIDES_BLOCK = 512 };

static bool same_pair(const contact *c, const contact *d) { return c->a == d->a && c->b == d->b; }

/* The pairs that begin in a block of contacts. */
static void limit_block(void *arg, int32_t block, int32_t thread)
{
    const sides_work *w = arg;
    const contact *c = w->contacts->data;
    int32_t count = w->contacts->count, i = SIDES_BLOCK * block, end = pool_block_end(block, SIDES_BLOCK, count);
    (void)thread;
    while (i > 0 && i < end && same_pair(&c[i - 1], &c[i]))
        i++;
    while (i < end) {
        side_group g = {c[i].a, c[i].b, i, i};
        while (g.end < count && same_pair(&c[i], &c[g.end]))
            g.end++;
        i = g.end;
        if (c[g.first].patch < 0 && w->policies->of[w->bodies->material[g.a]][w->bodies->material[g.b]].sides)
            limit_group(w, &g);
    }
}

static bool any_sides(const pair_policies *policies)
{
    for (int i = 0; i < MATERIAL_COUNT; i++)
        for (int j = 0; j < MATERIAL_COUNT; j++)
            if (policies->of[i][j].sides)
                return true;
    return false;
}

void crushing_limit_sides(context *ctx, const crushing_settings *settings, const body_table *bodies,
                          const shape_store *shapes, const floe_table *floes, const pair_policies *policies,
                          contact_array *contacts)
{
    if (!any_sides(policies))
        return;
    sides_work w = {settings, bodies, shapes, floes, policies, contacts};
    pool_run(ctx, limit_block, &w, pool_blocks(contacts->count, SIDES_BLOCK));
}
