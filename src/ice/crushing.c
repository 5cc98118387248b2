/* Crushing patches and their contacts; see crushing.h. */
#include "ice/crushing_parts.h"

#include "base/pool.h"
#include "geometry/mesh_point.h"
#include "ice/crushing_blocks.h"
#include "ice/patch_points.h"
#include "ice/surface_frame.h"

#include <assert.h>

/* The comparison switch: under this |normal . z| the reference's A_I / cos(gamma) has no meaning (a vertical side has
   no section area at all), and the patch's own area is kept. */
static const double VERTICAL_SIDE = 0.02;

/* A winding number of a closed surface about a point is 1 inside and 0 outside, to rounding. */
static const double INSIDE_WINDING = 0.5;

/* Pairs a block, 0.1 ms of work: many more than waking a thread takes, and few enough to share out level ice. */
enum { BLOCK_PAIRS = 32 };

/* What debug builds grant to rounding where a length should be 1. */
#define UNIT_SLACK 1e-9

struct crushing_scratch {
    ARRAY(patch_scratch *) rooms; /* of each thread */
    prism_surfaces prisms;
    crushing_blocks blocks;
};

static bool make_rooms(context *ctx, crushing_scratch *s, int32_t threads)
{
    while (s->rooms.count < threads) {
        patch_scratch *room = patch_scratch_create(ctx);
        if (!room || !array_push(ctx, &s->rooms, room)) {
            patch_scratch_free(ctx, room);
            return false;
        }
    }
    return true;
}

crushing_scratch *crushing_scratch_create(context *ctx)
{
    crushing_scratch *s = memory_array(ctx, 1, sizeof *s);
    if (s && !make_rooms(ctx, s, 1)) {
        crushing_scratch_free(ctx, s);
        return NULL;
    }
    return s;
}

void crushing_scratch_free(context *ctx, crushing_scratch *s)
{
    if (!s)
        return;
    for (int32_t i = 0; i < s->rooms.count; i++)
        patch_scratch_free(ctx, s->rooms.data[i]);
    array_free(ctx, &s->rooms);
    prism_surfaces_free(ctx, &s->prisms);
    crushing_blocks_free(ctx, &s->blocks);
    memory_free(ctx, s);
}

/* ---- the surface of a body ---- */

static void set_surface(const crushing_job *j, crushing_pair *p)
{
    int32_t row = j->bodies->shape[p->surface_body];
    if (j->shapes->shapes.kind[row] == SHAPE_SOLID) {
        const solid *body = shape_solid(j->shapes, row);
        p->surface.surface = &body->surface;
        p->surface.adjacency = &body->adjacency;
        p->surface.tree = &body->tree;
        p->surface.faces = NULL;
        p->surface.prism = -1;
    } else {
        const prism_surface *prism = prism_surfaces_find(j->prisms, row);
        p->surface.surface = &prism->surface;
        p->surface.adjacency = &prism->adjacency;
        p->surface.tree = prism->has_tree ? &prism->tree : NULL;
        p->surface.faces = prism->has_tree ? NULL : &prism->faces;
        p->surface.prism = row;
    }
    p->surface.rough_way = j->bodies->material[p->surface_body] == MATERIAL_ICE; /* nothing is corrected by it */
    bool moves = j->settings->parts_by_motion && !p->surface.rough_way;
    surface_frame_set(&p->surface, j->bodies, p->surface_body, p->floe_body, &p->rotation, moves,
                      j->settings->rest_speed);
}

/* Of two bodies that crush: the one whose surface is looked at, see set_pair. */
static int32_t surface_body_of(const body_table *bodies, int32_t a, int32_t b)
{
    return bodies->material[b] != MATERIAL_ICE ? b : a;
}

/* Which of both is the floe: the one of ice, of two floes the higher slot, so that the surface of the lower one serves
   all its pairs (the patches are equal and opposite, since the parts of both surfaces inside the other body together
   are closed). */
static fram_status set_pair(const crushing_job *j, int32_t a, int32_t b, const pair_policies *policies,
                            crushing_pair *p)
{
    const body_table *bodies = j->bodies;
    p->surface_body = surface_body_of(bodies, a, b);
    p->floe_body = p->surface_body == b ? a : b;
    p->floe = bodies->owner[p->floe_body];
    if (bodies->material[p->floe_body] != MATERIAL_ICE || p->floe < 0)
        return error_set(j->error, FRAM_ERROR_USAGE, NULL, 0, NULL,
                         "bodies %d and %d are to crush, and neither is a floe", a, b);
    p->policy = &policies->of[bodies->material[a]][bodies->material[b]];
    p->prism = (patch_floe){j->shapes, bodies->shape[p->floe_body]};
    p->rotation = quat_matrix(bodies->orientation[p->floe_body]);
    p->position = bodies->position[p->floe_body];
    set_surface(j, p);
    return FRAM_OK;
}

/* Pressure on a patch about a centre in the frame of the floe, of which a part or all bears; between two floes that of
   the weaker one, and no more than builds a ridge or a raft: the width of the patch along the plane is its area, seen
   level, over the thickness of the thinner floe. */
static double pair_pressure(const crushing_job *j, const crushing_pair *p, vec3 centre, double area, double level_area)
{
    pack_floe floe[2];
    floe[0] =
        (pack_floe){strength_crushing_at(&j->settings->strength, j->floes, p->floe, vec2_make(centre.x, centre.y)),
                    j->floes->thickness[p->floe]};
    double pressure = ice_crushing_pressure(&floe[0].ice, area);
    if (j->bodies->material[p->surface_body] != MATERIAL_ICE)
        return pressure;
    int32_t other = j->bodies->owner[p->surface_body];
    vec3 seen = mat3_tmul_vec(p->surface.rotation, vec3_sub(centre, p->surface.offset));
    floe[1] = (pack_floe){strength_crushing_at(&j->settings->strength, j->floes, other, vec2_make(seen.x, seen.y)),
                          j->floes->thickness[other]};
    pressure = fmin(pressure, ice_crushing_pressure(&floe[1].ice, area));
    double thickness = fmin(floe[0].thickness, floe[1].thickness);
    double line = pack_line_load(&j->settings->pack, floe, p->policy->friction_static, level_area / thickness);
    return fmin(pressure, line / thickness);
}

/* ---- contacts ---- */

/* Neither a hull nor a wall that crushes it pushes a floe out of itself, nor a floe another one: the overlap is ice
   that is crushed or about to break. What slides where something else has crushed its way is not deep in the ice. */
static bool patch_corrects(const crushing_job *j, const crushing_pair *p, const patch_component *c)
{
    return !c->slides && j->bodies->material[p->surface_body] == MATERIAL_HULL && j->settings->correct_unbreakable &&
           !j->floes->breakable[p->floe];
}

static bool push_contact(const crushing_job *j, const crushing_pair *p, const crushing_patch *patch, int point,
                         vec3 place, double depth, double weight, bool correct)
{
    contact c = {.a = p->floe_body,
                 .b = p->surface_body,
                 .point = vec3_add(p->position, mat3_mul_vec(p->rotation, place)),
                 .normal = patch->normal,
                 .depth = depth,
                 .impulse_limit = weight * patch->pressure * patch->area * j->settings->time_step,
                 .friction_static = p->policy->friction_static,
                 .friction_kinetic = p->policy->friction_kinetic,
                 .correct = correct,
                 .crush_infinite =
                     !body_is_dynamic(j->bodies, p->floe_body) && !body_is_dynamic(j->bodies, p->surface_body),
                 .patch = j->patches->count,
                 .key = contact_key(j->bodies, p->floe_body, p->surface_body, patch->component, -1, (uint32_t)point)};
    return array_push(j->ctx, j->contacts, c);
}

/* ---- patches ---- */

double crushing_component_pressure(const crushing_job *j, const crushing_pair *p, const patch_component *c, double area)
{
    double z = vec3_unit(c->area).z;
    return pair_pressure(j, p, c->centre, area + c->beside, sqrt(fmax(1 - z * z, 0)) * area);
}

static bool push_patch(const crushing_job *j, const crushing_pair *p, const patch_component *c, int32_t number,
                       double area, const patch_bearing *bearing)
{
    vec3 normal = vec3_unit(c->area), point[PATCH_MOST_POINTS];
    crushing_patch patch = {.floe = p->floe,
                            .floe_body = p->floe_body,
                            .surface_body = p->surface_body,
                            .normal = mat3_mul_vec(p->rotation, normal),
                            .centre = vec3_add(p->position, mat3_mul_vec(p->rotation, c->centre)),
                            .area = area,
                            .horizontal_area = fabs(c->area.z),
                            .surface_area = c->surface,
                            .pressure = bearing->pressure,
                            .compliance = bearing->compliance,
                            .over = bearing->over,
                            .plan = c->plan,
                            .contact_first = j->contacts->count,
                            .component = number};
    /* Patches of hulls keep their shape, which loads of panels are made of. */
    const double *radius = j->shapes->shapes.radius;
    double smaller = fmin(radius[p->prism.shape], radius[j->bodies->shape[p->surface_body]]);
    bool floes = j->bodies->material[p->surface_body] == MATERIAL_ICE;
    patch.contact_count = patch_points(c, normal, floes ? j->settings->small_patch * smaller : 0, point);
    assert(patch.contact_count >= 1 && patch.contact_count <= PATCH_MOST_POINTS);
    assert(fabs(vec3_length(patch.normal) - 1) < UNIT_SLACK);
    assert(c->way >= 0 && patch.area > 0 && patch.horizontal_area <= c->surface * (1 + UNIT_SLACK));
    bool corrects = patch_corrects(j, p, c);
    for (int i = 0; i < patch.contact_count; i++)
        if (!push_contact(j, p, &patch, i, point[i], c->way, 1.0 / patch.contact_count, corrects))
            return false;
    return array_push(j->ctx, j->patches, patch);
}

/* The reference's area for one component: the section area of the pair is shared by horizontal area. */
static double top_plane_share(const patch_component *c, double section_area, double horizontal_sum)
{
    double area = vec3_length(c->area), cosine = fabs(c->area.z) / area;
    return cosine < VERTICAL_SIDE ? area : section_area * (fabs(c->area.z) / horizontal_sum) / cosine;
}

static fram_status push_patches(const crushing_job *j, const crushing_pair *p, const patch_component_array *found)
{
    double section_area = 0, horizontal_sum = 0;
    if (j->settings->top_plane_area) {
        fram_status status = patch_top_area(j->ctx, j->room, &p->surface, &p->prism, &section_area, j->error);
        if (status != FRAM_OK)
            return status;
        for (int32_t i = 0; i < found->count; i++)
            horizontal_sum += fabs(found->data[i].area.z);
    }
    for (int32_t i = 0; i < found->count; i++) {
        patch_component c = found->data[i];
        patch_bearing bearing = {0};
        double area = vec3_length(c.area);
        if (!(area > CLOSED_PATCH * c.surface))
            continue;
        bool gives = crushing_edge_gives(j, p, &c);
        if (gives) {
            c = crushing_give_way(j, p, &found->data[i], i, &bearing);
            area = fabs(c.area.z) > CLOSED_PATCH * found->data[i].surface ? vec3_length(c.area) : 0;
        }
        if (j->settings->top_plane_area)
            area = top_plane_share(&c, section_area, horizontal_sum);
        if (!gives)
            bearing.pressure = crushing_component_pressure(j, p, &c, area);
        if (area > 0 && area >= j->settings->smallest_area && !push_patch(j, p, &c, i, area, &bearing))
            return error_memory(j->error);
    }
    return FRAM_OK;
}

/* ---- a floe that has slipped inside ---- */

static bool surface_holds(const crushing_job *j, const crushing_pair *p, vec3 point)
{
    int32_t row = j->bodies->shape[p->surface_body];
    const shape_table *shapes = &j->shapes->shapes;
    if (vec3_length(point) > shapes->radius[row])
        return false;
    if (shapes->kind[row] == SHAPE_PRISM)
        return fabs(point.z) < shapes->half_height[row] &&
               polygon_contains(shape_outline(j->shapes, row), (vec2){point.x, point.y});
    const solid *body = shape_solid(j->shapes, row);
    bool near = false;
    for (int32_t i = 0; i < body->pieces.count && !near; i++)
        near = polyhedron_contains(&body->pieces.data[i], point, 0);
    /* Pieces may bulge over a hollow of the surface, which decides. */
    return near && mesh_winding(&body->surface, point) > INSIDE_WINDING;
}

/* The way from a point inside a prism to the nearest of its faces, in *out the direction there. */
static vec3 prism_way_out(const shape_store *shapes, int32_t row, vec3 point, vec3 *out)
{
    polygon outline = shape_outline(shapes, row);
    vec2 at = {point.x, point.y};
    int32_t edge = 0;
    vec2 aside = vec2_sub(polygon_nearest_boundary(outline, at, &edge), at);
    double up = shapes->shapes.half_height[row] - fabs(point.z);
    if (up < vec2_length(aside)) {
        *out = (vec3){0, 0, point.z < 0 ? -1 : 1};
        return vec3_scale(*out, up);
    }
    vec2 along = vec2_sub(outline.vertex[edge + 1 < outline.count ? edge + 1 : 0], outline.vertex[edge]);
    *out = (vec3){along.y, -along.x, 0};
    return (vec3){aside.x, aside.y, 0};
}

/* The same out of the surface of a pair, in its frame. */
static vec3 surface_way_out(const crushing_job *j, const crushing_pair *p, vec3 point, vec3 *out)
{
    int32_t row = j->bodies->shape[p->surface_body], face = 0;
    if (j->shapes->shapes.kind[row] == SHAPE_PRISM)
        return prism_way_out(j->shapes, row, point, out);
    vec3 way = vec3_sub(mesh_nearest_point(p->surface.surface, point, &face), point);
    *out = mesh_area_vector(p->surface.surface, face);
    return way;
}

/* A floe without any patch lies outside the surface or wholly inside; inside, one contact at the floe's middle holds it
   against the nearest way out.  Ice that is held or carried was crushed as the surface came over it, and is no floe
   that slipped in: the rim of a tile that the hull has passed. */
static fram_status push_buried(const crushing_job *j, const crushing_pair *p)
{
    if (!body_is_dynamic(j->bodies, p->floe_body))
        return FRAM_OK;
    vec3 inner = patch_inner_point(&p->prism);
    vec3 point = mat3_tmul_vec(p->surface.rotation, vec3_sub(inner, p->surface.offset));
    if (!surface_holds(j, p, point))
        return FRAM_OK;
    vec3 out, way = surface_way_out(j, p, point, &out);
    double distance = vec3_length(way);
    vec3 normal = vec3_unit(mat3_mul_vec(p->surface.rotation, distance > 0 ? way : out));
    double thickness = j->floes->thickness[p->floe];
    double area = polygon_perimeter(shape_outline(j->shapes, p->prism.shape)) * thickness;
    crushing_patch patch = {.floe = p->floe,
                            .floe_body = p->floe_body,
                            .surface_body = p->surface_body,
                            .normal = mat3_mul_vec(p->rotation, normal),
                            .centre = vec3_add(p->position, mat3_mul_vec(p->rotation, inner)),
                            .area = area,
                            .surface_area = area,
                            .pressure = pair_pressure(j, p, inner, area, area),
                            .contact_first = j->contacts->count,
                            .contact_count = 1};
    double way_out = 0;
    if (!patch_way_out(j->ctx, j->room, &p->prism, inner, vec3_neg(normal), &way_out) ||
        !push_contact(j, p, &patch, 0, inner, fmin(distance + way_out, thickness), 1, true) ||
        !array_push(j->ctx, j->patches, patch))
        return error_memory(j->error);
    return FRAM_OK;
}

/* The surface of a floe that lies wholly inside another one closes round and pushes nothing: then it is the floe that
   has slipped in, as it would be if the numbers of the two were exchanged. */
static fram_status push_swallowed(const crushing_job *j, const crushing_pair *p, const patch_component_array *found)
{
    for (int32_t i = 0; i < found->count; i++)
        if (vec3_length(found->data[i].area) > CLOSED_PATCH * found->data[i].surface)
            return FRAM_OK;
    crushing_pair q = {.floe = j->bodies->owner[p->surface_body],
                       .floe_body = p->surface_body,
                       .surface_body = p->floe_body,
                       .policy = p->policy,
                       .prism = {j->shapes, j->bodies->shape[p->surface_body]},
                       .rotation = quat_matrix(j->bodies->orientation[p->surface_body]),
                       .position = j->bodies->position[p->surface_body]};
    surface_frame_set(&q.surface, j->bodies, q.surface_body, q.floe_body, &q.rotation, false, j->settings->rest_speed);
    return push_buried(j, &q);
}

/* clear: of the pair; without a patch the narrow phase has to look at it again. */
static fram_status crush_pair(const crushing_job *j, int32_t a, int32_t b, double *clear, const pair_policies *policies)
{
    crushing_pair p;
    fram_status status = set_pair(j, a, b, policies, &p);
    if (status != FRAM_OK)
        return status;
    const patch_component_array *found;
    if (!patch_components(j->ctx, j->room, &p.surface, &p.prism, &found))
        return error_memory(j->error);
    if (found->count == 0 && *clear == PAIR_HAS_PATCH)
        *clear = 0;
    int32_t first = j->contacts->count;
    status = found->count > 0 ? push_patches(j, &p, found) : push_buried(j, &p);
    if (status == FRAM_OK && found->count > 0 && j->bodies->material[p.surface_body] == MATERIAL_ICE)
        status = push_swallowed(j, &p, found);
    if (j->contacts->count > first)
        contact_keys_part(j->contacts->data + first, j->contacts->count - first);
    return status;
}

/* ---- all pairs ---- */

/* What blocks share; each makes a job of its own out of it. */
typedef struct block_work {
    crushing_job job;
    crushing_scratch *scratch;
    pair_table *pairs;
    const index_array *rows;
    const pair_policies *policies;
} block_work;

static fram_status crush_rows(const block_work *w, const crushing_job *j, int32_t first, int32_t end)
{
    for (int32_t i = first; i < end; i++) {
        int32_t row = w->rows->data[i];
        fram_status status = crush_pair(j, w->pairs->a[row], w->pairs->b[row], &w->pairs->clear[row], w->policies);
        if (status != FRAM_OK)
            return status;
    }
    return FRAM_OK;
}

static void crush_block(void *arg, int32_t block, int32_t thread)
{
    const block_work *w = arg;
    crushing_block *to = &w->scratch->blocks.block.data[block];
    crushing_job j = w->job;
    j.room = w->scratch->rooms.data[thread];
    j.patches = &to->patches;
    j.contacts = &to->contacts;
    j.error = &to->error;
    to->status = crush_rows(w, &j, BLOCK_PAIRS * block, pool_block_end(block, BLOCK_PAIRS, w->rows->count));
}

/* The surfaces of all prisms that pairs ask for. */
static fram_status make_surfaces(const block_work *w)
{
    const crushing_job *j = &w->job;
    prism_surfaces_begin(&w->scratch->prisms);
    for (int32_t i = 0; i < w->rows->count; i++) {
        int32_t row = w->rows->data[i];
        int32_t shape = j->bodies->shape[surface_body_of(j->bodies, w->pairs->a[row], w->pairs->b[row])];
        if (j->shapes->shapes.kind[shape] != SHAPE_PRISM)
            continue;
        const prism_surface *made;
        fram_status status = prism_surfaces_get(j->ctx, &w->scratch->prisms, j->shapes, shape, &made, j->error);
        if (status != FRAM_OK)
            return status;
    }
    return FRAM_OK;
}

fram_status crushing_contacts(context *ctx, crushing_scratch *scratch, const crushing_settings *settings,
                              const body_table *bodies, const shape_store *shapes, const floe_table *floes,
                              const edge_support_table *supports, pair_table *pairs, const index_array *patch_pairs,
                              const pair_policies *policies, crushing_patch_array *patches, contact_array *contacts,
                              fram_error *error)
{
    block_work w = {{ctx, &scratch->prisms, scratch->rooms.data[0], settings, bodies, shapes, floes, supports, patches,
                     contacts, error},
                    scratch,
                    pairs,
                    patch_pairs,
                    policies};
    crushing_limit_sides(ctx, settings, bodies, shapes, floes, policies, contacts);
    fram_status status = make_surfaces(&w);
    if (status != FRAM_OK)
        return status;
    int32_t threads = context_threads(ctx), count = patch_pairs->count;
    int32_t blocks = pool_blocks(count, BLOCK_PAIRS);
    /* In order and into the arrays themselves: the same, and no copy.  Sections go through a library that is asked by
       one thread. */
    if (threads == 1 || blocks <= 1 || settings->top_plane_area)
        return crush_rows(&w, &w.job, 0, count);
    if (!make_rooms(ctx, scratch, threads) || !crushing_blocks_make(ctx, &scratch->blocks, blocks))
        return error_memory(error);
    pool_run(ctx, crush_block, &w, blocks);
    return crushing_blocks_join(ctx, &scratch->blocks, patches, contacts, error);
}
