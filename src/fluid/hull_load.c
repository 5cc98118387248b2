#include "fluid/hull_load.h"

#include "base/pool.h"
#include "fluid/cut_kernel.h"
#include "fluid/facet.h"
#include "geometry/mesh_integrals.h"

/* Branches that are shared out: those at this depth of the tree, if the mesh is worth it. */
enum { BRANCH_DEPTH = 5, MOST_BRANCHES = 1 << BRANCH_DEPTH, WORTH_SHARING = 4000 };

/* Sample points waiting to be handed to the kernel: neighbours are joined to one call. */
typedef struct point_run {
    int32_t first, end;
} point_run;

/* What one branch adds up. */
typedef struct branch_sums {
    surface_moments wet; /* of the faces that whole nodes had under water, body axes */
    point_sums pressure; /* of triangles, body axes */
    wrench water, air;   /* of large facets, global axes */
    point_sums water_points, air_points;
    point_run water_run, air_run;
    cut_batch *cut; /* triangles that wait for the kernel; while the branch is walked */
} branch_sums;

typedef struct hull_walk {
    context *ctx;
    const media *media;
    const solid *body;
    const fluid_motion *state;
    water_plane plane;
    stream water, air;
    bool wet, dry; /* media whose drag is wanted */
    point_stream water_points, air_points;
    int32_t branch_count;
    int32_t branch[MOST_BRANCHES];
    branch_sums sums[MOST_BRANCHES];
} hull_walk;
_Static_assert(sizeof(hull_walk) <= 1 << 16, "it lies on the stack of whoever asks for a load, and is cleared there");

/* ---- streams ---- */

static point_stream points_of(const hull_walk *w, const stream *s)
{
    mat3 r = w->state->rotation;
    return (point_stream){.velocity = mat3_tmul_vec(r, s->velocity),
                          .spin = mat3_tmul_vec(r, s->spin),
                          .form = s->form,
                          .skin = s->skin,
                          .down = vec3_neg(w->plane.up),
                          .depth = -w->state->position.z};
}

static void add_layers(const hull_walk *w, const current_profile *p, point_stream *s)
{
    for (int32_t k = 0; k + 1 < p->count; k++) {
        double thick = p->depth[k + 1] - p->depth[k];
        vec3 change = vec3_sub(p->velocity[k + 1], p->velocity[k]);
        s->top[k] = p->depth[k];
        s->thick[k] = thick;
        s->slope[k] = mat3_tmul_vec(w->state->rotation, vec3_scale(change, 1 / thick));
        s->layers = k + 1;
    }
}

/* ---- sample points ---- */

static void flush(const hull_walk *w, const point_stream *s, point_run *run, point_sums *sums)
{
    const mesh_integrals *all = &w->body->integrals;
    int32_t i = run->first;
    const point_rows rows = {all->x.data + i,  all->y.data + i,  all->z.data + i,   all->nx.data + i,
                             all->ny.data + i, all->nz.data + i, all->area.data + i};
    if (run->first < run->end)
        KERNEL_PICK(w->ctx, point_drag)(s, &rows, run->end - i, sums);
    run->first = run->end = 0;
}

static void add_run(const hull_walk *w, const point_stream *s, int32_t first, int32_t end, point_run *run,
                    point_sums *sums)
{
    if (first == end)
        return;
    if (first != run->end) {
        flush(w, s, run, sums);
        run->first = first;
    }
    run->end = end;
}

/* ---- single triangles ---- */

static void flush_cut(const hull_walk *w, branch_sums *sums)
{
    cut_points wet, dry;
    KERNEL_PICK(w->ctx, cut_triangles)(&w->plane, sums->cut, &sums->pressure, &wet, &dry);
    const point_rows under = {wet.x, wet.y, wet.z, wet.nx, wet.ny, wet.nz, wet.area};
    const point_rows over = {dry.x, dry.y, dry.z, dry.nx, dry.ny, dry.nz, dry.area};
    if (w->wet)
        KERNEL_PICK(w->ctx, point_drag)(&w->water_points, &under, sums->cut->count, &sums->water_points);
    if (w->dry)
        KERNEL_PICK(w->ctx, point_drag)(&w->air_points, &over, sums->cut->count, &sums->air_points);
    sums->cut->count = 0;
}

/* drag: the wet and the dry part of the triangle stand for one point each. */
static void add_cut(const hull_walk *w, int32_t place, bool drag, branch_sums *sums)
{
    const solid *b = w->body;
    const int32_t *v = b->surface.face.data[b->tree.face.data[place]].v;
    cut_batch *cut = sums->cut;
    if (cut->count == CUT_ROOM)
        flush_cut(w, sums);
    int32_t at = cut->count++;
    for (int i = 0; i < 3; i++) {
        vec3 r = b->surface.vertex.data[v[i]];
        cut->corner[i][0][at] = r.x;
        cut->corner[i][1][at] = r.y;
        cut->corner[i][2][at] = r.z;
    }
    cut->drag[at] = drag;
}

static void corners_of(const hull_walk *w, int32_t place, vec3 corner[3])
{
    const solid *b = w->body;
    const int32_t *v = b->surface.face.data[b->tree.face.data[place]].v;
    for (int k = 0; k < 3; k++)
        corner[k] = mat3_mul_vec(w->state->rotation, b->surface.vertex.data[v[k]]);
}

static vec3 normal_of(const vec3 corner[3])
{
    return vec3_unit(vec3_cross(vec3_sub(corner[1], corner[0]), vec3_sub(corner[2], corner[0])));
}

/* Large triangles among the places first..end-1, wholly in one medium. */
static void add_large(const hull_walk *w, int32_t first, int32_t end, bool under, branch_sums *sums)
{
    const mesh_integrals *all = &w->body->integrals;
    for (int32_t i = all->large_first.data[first]; i < all->large_first.data[end]; i++) {
        vec3 corner[3];
        corners_of(w, all->large.data[i], corner);
        if (under)
            facet_add_water_drag(&sums->water, &w->water, w->media, w->state->position.z, corner, 3, normal_of(corner));
        else
            facet_add_drag(&sums->air, &w->air, corner, 3, normal_of(corner));
    }
}

/* Drag on a triangle of many points that the water plane cuts. */
static void add_cut_drag(const hull_walk *w, int32_t place, branch_sums *sums)
{
    double height = w->state->position.z;
    vec3 corner[3], part[4];
    corners_of(w, place, corner);
    vec3 normal = normal_of(corner);
    int n = triangle_clip_below(corner, -height, part);
    if (w->wet)
        facet_add_water_drag(&sums->water, &w->water, w->media, height, part, n, normal);
    n = w->dry ? facet_clip(corner, 3, vec3_make(0, 0, -1), height, part) : 0;
    if (n >= 3)
        facet_add_drag(&sums->air, &w->air, part, n, normal);
}

/* Whether all of a triangle is in one medium, by the heights that the kernel finds. */
static void media_of(const hull_walk *w, int32_t place, bool *under, bool *over)
{
    const solid *b = w->body;
    const int32_t *v = b->surface.face.data[b->tree.face.data[place]].v;
    *under = *over = true;
    for (int i = 0; i < 3; i++) {
        double height = w->plane.height + vec3_dot(w->plane.up, b->surface.vertex.data[v[i]]);
        *under = *under && height <= 0;
        *over = *over && height >= 0;
    }
}

/* A triangle of a leaf that the water plane may cut. */
static void add_place(const hull_walk *w, int32_t place, branch_sums *sums)
{
    const mesh_integrals *all = &w->body->integrals;
    int32_t first = all->point_first.data[place], end = all->point_first.data[place + 1];
    bool under, over, one_point = end - first == 1;
    media_of(w, place, &under, &over);
    if (!over)
        add_cut(w, place, one_point && !under, sums);
    if (under && w->wet) {
        add_run(w, &w->water_points, first, end, &sums->water_run, &sums->water_points);
        add_large(w, place, place + 1, true, sums);
    }
    if (over && w->dry) {
        add_run(w, &w->air_points, first, end, &sums->air_run, &sums->air_points);
        add_large(w, place, place + 1, false, sums);
    }
    if (!under && !over && !one_point)
        add_cut_drag(w, place, sums);
}

/* ---- the tree ---- */

static void add_moments(surface_moments *to, const surface_moments *m)
{
    to->area = vec3_add(to->area, m->area);
    to->turn = vec3_add(to->turn, m->turn);
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) {
            to->area_first.m[i][j] += m->area_first.m[i][j];
            to->turn_first.m[i][j] += m->turn_first.m[i][j];
        }
    }
}

static void add_wet_node(const hull_walk *w, int32_t n, branch_sums *sums)
{
    const mesh_bvh_node *node = &w->body->tree.node.data[n];
    const mesh_integrals *all = &w->body->integrals;
    int32_t end = node->first + node->count;
    add_moments(&sums->wet, &all->moments.data[n]);
    if (w->wet) {
        add_run(w, &w->water_points, all->point_first.data[node->first], all->point_first.data[end], &sums->water_run,
                &sums->water_points);
        add_large(w, node->first, end, true, sums);
    }
}

static void add_dry_node(const hull_walk *w, int32_t n, branch_sums *sums)
{
    const mesh_bvh_node *node = &w->body->tree.node.data[n];
    const mesh_integrals *all = &w->body->integrals;
    int32_t end = node->first + node->count;
    add_run(w, &w->air_points, all->point_first.data[node->first], all->point_first.data[end], &sums->air_run,
            &sums->air_points);
    add_large(w, node->first, end, false, sums);
}

/* Height over still water of the box: its middle, and how far it reaches from there. */
static double box_height(const hull_walk *w, box3 b, double *reach)
{
    vec3 half = vec3_scale(vec3_sub(b.hi, b.lo), 0.5), middle = vec3_add(b.lo, half);
    *reach = fabs(w->plane.up.x) * half.x + fabs(w->plane.up.y) * half.y + fabs(w->plane.up.z) * half.z;
    return w->state->position.z + vec3_dot(w->plane.up, middle);
}

/* Whether one point stands for several faces of a node, so that its parts have none of their own. */
static bool is_joined(const mesh_integrals *all, const mesh_bvh_node *node)
{
    int32_t end = node->first + node->count;
    return node->count > 1 && all->point_first.data[end] - all->point_first.data[node->first] == 1 &&
           all->large_first.data[end] == all->large_first.data[node->first];
}

/* Drag on a whole part of a joined node, as of one point. */
static void add_part_drag(const hull_walk *w, const point_stream *s, vec3 facing, const surface_moments *m,
                          point_sums *sums)
{
    double size = vec3_length(m->area), weight = vec3_dot(m->area, facing);
    if (!(weight > 0))
        return;
    vec3 r = vec3_scale(mat3_tmul_vec(m->area_first, facing), 1 / weight), n = vec3_scale(m->area, 1 / size);
    const point_rows rows = {&r.x, &r.y, &r.z, &n.x, &n.y, &n.z, &size};
    KERNEL_PICK(w->ctx, point_drag)(s, &rows, 1, sums);
}

/* A joined node that the water plane may cut, or a part of one; facing: the mean normal of the node, body axes.  Each
   wholly wet or dry part stands for one point, and each part of a triangle that is cut. */
static void add_joined(const hull_walk *w, int32_t n, vec3 facing, branch_sums *sums)
{
    const mesh_bvh_node *node = &w->body->tree.node.data[n];
    const surface_moments *m = &w->body->integrals.moments.data[n];
    double reach, height = box_height(w, node->box, &reach);
    if (height + reach <= 0) {
        add_moments(&sums->wet, m);
        if (w->wet)
            add_part_drag(w, &w->water_points, facing, m, &sums->water_points);
    } else if (height - reach >= 0) {
        if (w->dry)
            add_part_drag(w, &w->air_points, facing, m, &sums->air_points);
    } else if (node->next >= 0) {
        add_joined(w, n + 1, facing, sums);
        add_joined(w, node->next, facing, sums);
    } else {
        for (int32_t i = node->first; i < node->first + node->count; i++)
            add_cut(w, i, true, sums);
    }
}

static void add_node(const hull_walk *w, int32_t n, branch_sums *sums)
{
    const mesh_bvh_node *node = &w->body->tree.node.data[n];
    double reach, height = box_height(w, node->box, &reach);
    if (height + reach <= 0) {
        add_wet_node(w, n, sums);
        return;
    }
    if (height - reach >= 0) {
        if (w->dry)
            add_dry_node(w, n, sums);
        return;
    }
    if (is_joined(&w->body->integrals, node)) {
        add_joined(w, n, vec3_unit(w->body->integrals.moments.data[n].area), sums);
        return;
    }
    if (node->next < 0) {
        for (int32_t i = node->first; i < node->first + node->count; i++)
            add_place(w, i, sums);
        return;
    }
    add_node(w, n + 1, sums);
    add_node(w, node->next, sums);
}

static void add_branch(void *arg, int32_t block, int32_t thread)
{
    (void)thread;
    hull_walk *w = arg;
    branch_sums *sums = &w->sums[block];
    cut_batch cut;
    sums->cut = &cut;
    sums->wet = (surface_moments){0};
    sums->pressure = sums->water_points = sums->air_points = (point_sums){0};
    sums->water = sums->air = (wrench){0};
    sums->water_run = sums->air_run = (point_run){0};
    sums->cut->count = 0;
    add_node(w, w->branch[block], sums);
    flush(w, &w->water_points, &sums->water_run, &sums->water_points);
    flush(w, &w->air_points, &sums->air_run, &sums->air_points);
    flush_cut(w, sums);
    sums->cut = NULL;
}

/* The nodes at a depth, and leaves above it; a joined node is never split. */
static void find_branches(hull_walk *w, int32_t n, int depth)
{
    const mesh_bvh_node *node = &w->body->tree.node.data[n];
    if (depth == 0 || node->next < 0 || is_joined(&w->body->integrals, node)) {
        w->branch[w->branch_count++] = n;
        return;
    }
    find_branches(w, n + 1, depth - 1);
    find_branches(w, node->next, depth - 1);
}

/* ---- results ---- */

static void add_force_and_moment(wrench *to, vec3 force, vec3 moment)
{
    to->force = vec3_add(to->force, force);
    to->moment = vec3_add(to->moment, moment);
}

/* Integrals of z n and r x z n over whole nodes, z the height over still water, global axes. */
static pressure_sum pressure_of(const hull_walk *w, const surface_moments *m)
{
    mat3 r = w->state->rotation;
    double height = w->state->position.z;
    return (pressure_sum){mat3_mul_vec(r, vec3_mad(mat3_mul_vec(m->area_first, w->plane.up), m->area, height)),
                          mat3_mul_vec(r, vec3_mad(mat3_mul_vec(m->turn_first, w->plane.up), m->turn, height))};
}

/* From body axes to global ones. */
static void add_lanes(const hull_walk *w, const point_sums *p, vec3 *force, vec3 *moment)
{
    double sum[6];
    for (int i = 0; i < 6; i++) {
        const double *a = p->lane[i];
        sum[i] = ((a[0] + a[1]) + (a[2] + a[3])) + ((a[4] + a[5]) + (a[6] + a[7]));
    }
    mat3 r = w->state->rotation;
    *force = vec3_add(*force, mat3_mul_vec(r, vec3_make(sum[0], sum[1], sum[2])));
    *moment = vec3_add(*moment, mat3_mul_vec(r, vec3_make(sum[3], sum[4], sum[5])));
}

static void sum_branches(const hull_walk *w, fluid_load *load)
{
    pressure_sum pressure = {{0, 0, 0}, {0, 0, 0}};
    for (int32_t i = 0; i < w->branch_count; i++) {
        const branch_sums *b = &w->sums[i];
        pressure_sum whole = pressure_of(w, &b->wet);
        pressure.force = vec3_add(pressure.force, whole.force);
        pressure.moment = vec3_add(pressure.moment, whole.moment);
        add_lanes(w, &b->pressure, &pressure.force, &pressure.moment);
        add_force_and_moment(&load->water_drag, b->water.force, b->water.moment);
        add_force_and_moment(&load->wind_drag, b->air.force, b->air.moment);
        add_lanes(w, &b->water_points, &load->water_drag.force, &load->water_drag.moment);
        add_lanes(w, &b->air_points, &load->wind_drag.force, &load->wind_drag.moment);
    }
    double weight = w->media->water_density * w->media->gravity;
    load->hydrostatic.force = vec3_scale(pressure.force, weight);
    load->hydrostatic.moment = vec3_scale(pressure.moment, weight);
    load->submerged_volume = pressure.force.z;
}

void fluid_load_solid(context *ctx, const media *m, const drag_coefficients *c, const solid *body,
                      const fluid_motion *state, fluid_load *load)
{
    *load = (fluid_load){0};
    const mat3 *r = &state->rotation;
    hull_walk w = {.ctx = ctx,
                   .media = m,
                   .body = body,
                   .state = state,
                   .plane = {{r->m[2][0], r->m[2][1], r->m[2][2]}, state->position.z},
                   .water = stream_of_water(m, c, state->velocity, state->angular_velocity, 0),
                   .air = stream_of_air(m, c, state->velocity, state->angular_velocity)};
    w.wet = stream_acts(&w.water);
    w.dry = stream_acts(&w.air);
    w.water_points = points_of(&w, &w.water);
    w.air_points = points_of(&w, &w.air);
    add_layers(&w, &m->profile, &w.water_points);
    find_branches(&w, 0, body->surface.face.count >= WORTH_SHARING ? BRANCH_DEPTH : 0);
    pool_run(ctx, add_branch, &w, w.branch_count);
    sum_branches(&w, load);
}
