/* Sealing of cracks; see mesh_repair.h.  A pass finds the open edges, joins loose vertices that are each other's
   nearest, then leads every open edge over the loose vertices that have it as their nearest; the next pass sees what
   that left. */
#include "geometry/mesh_bvh.h"
#include "geometry/mesh_edges.h"
#include "geometry/mesh_repair.h"

#include <assert.h>
#include <stdlib.h>

/* Passes after which what is left open stays open.  Real cracks take two or three, but of a corner of which every facet
   of a fan has a copy each pass leaves three quarters, for pairs that are each other's nearest are half of all: the
   largest file that is read takes some 60.  An edge can be led back and forth between two vertices without end. */
enum { MOST_SEAL_PASSES = 128, MOST_PASSES_LED = 16 };
/* Two vertices that the rim joins by a way of at most this many times their distance are not the two sides of a crack,
   but neighbours on one side of it: a rim finer than the seal is wide stays as it is.  Over a square hole the ways are
   1.41 times as long. */
#define SAME_SIDE 1.25
/* Steps along a rim that are looked at. */
enum { MOST_STEPS = 16 };
/* Nodes that wait in a walk through a tree of halves: one a level. */
enum { MOST_WAITING = 64 };
/* A place this near to the end of an edge, as a part of its length, is the end. */
#define LEAST_PART 1e-9

/* A loose vertex that an open edge is led over. */
typedef struct detour {
    int32_t edge; /* half-edge */
    double along; /* 0 to 1 from its beginning */
    double distance;
    int32_t vertex;
} detour;

typedef struct sealing {
    mesh *m;
    double width;
    int32_array *source;
    mesh_seal_report *report;
    int32_array sorted; /* half-edges */
    int32_array open;   /* open half-edges, ascending */
    uint8_t *loose;     /* of each vertex: it ends an open edge */
    mesh rims;          /* open edges as flat triangles, for the tree */
    mesh_bvh tree;
    mesh points; /* loose vertices, the same */
    mesh_bvh points_tree;
    int32_array near;
    int32_t *nearest; /* of each loose vertex, or -1 */
    double *shortest; /* of each loose vertex: length of the shortest open edge at it */
    ARRAY(detour) detours;
} sealing;

static void sealing_free(context *ctx, sealing *s)
{
    array_free(ctx, &s->sorted);
    array_free(ctx, &s->open);
    memory_free(ctx, s->loose);
    memory_free(ctx, s->nearest);
    memory_free(ctx, s->shortest);
    s->rims.vertex.data = s->points.vertex.data = NULL; /* borrowed */
    array_free(ctx, &s->rims.face);
    array_free(ctx, &s->points.face);
    mesh_bvh_free(ctx, &s->tree);
    mesh_bvh_free(ctx, &s->points_tree);
    array_free(ctx, &s->near);
    array_free(ctx, &s->detours);
}

static int compare_index(const void *a, const void *b)
{
    int32_t i = *(const int32_t *)a, j = *(const int32_t *)b;
    return (i > j) - (i < j);
}

/* Open edges and loose vertices of the mesh as it is now. */
static bool find_open(context *ctx, sealing *s)
{
    const mesh *m = s->m;
    array_clear(&s->open);
    if (!mesh_edges_sort(ctx, m, &s->sorted))
        return false;
    for (int32_t i = 0, end; i < s->sorted.count; i = end) {
        end = mesh_edges_end(m, &s->sorted, i);
        if (end - i == 1 && !array_push(ctx, &s->open, s->sorted.data[i]))
            return false;
    }
    if (s->open.count)
        qsort(s->open.data, (size_t)s->open.count, sizeof *s->open.data, compare_index);
    return true;
}

static double distance_between(vec3 a, vec3 b) { return vec3_length(vec3_sub(a, b)); }

static bool add_loose(context *ctx, sealing *s, int32_t v, double length)
{
    s->shortest[v] = s->loose[v] ? fmin(s->shortest[v], length) : length;
    bool there = s->loose[v];
    s->loose[v] = 1;
    return there || array_push(ctx, &s->points.face, ((triangle){{v, v, v}}));
}

/* The trees over the open edges and the loose vertices. */
static fram_status plant_trees(context *ctx, sealing *s)
{
    const mesh *m = s->m;
    memory_free(ctx, s->loose);
    memory_free(ctx, s->nearest);
    memory_free(ctx, s->shortest);
    s->loose = memory_array(ctx, (size_t)m->vertex.count, sizeof *s->loose);
    s->nearest = memory_array(ctx, (size_t)m->vertex.count, sizeof *s->nearest);
    s->shortest = memory_array(ctx, (size_t)m->vertex.count, sizeof *s->shortest);
    array_clear(&s->points.face);
    if (!s->loose || !s->nearest || !s->shortest || !array_resize(ctx, &s->rims.face, s->open.count))
        return FRAM_ERROR_MEMORY;
    s->rims.vertex.data = s->points.vertex.data = m->vertex.data;
    s->rims.vertex.count = s->points.vertex.count = m->vertex.count;
    for (int32_t i = 0; i < s->open.count; i++) {
        int32_t a = half_edge_from(m, s->open.data[i]), b = half_edge_to(m, s->open.data[i]);
        double length = distance_between(m->vertex.data[a], m->vertex.data[b]);
        s->rims.face.data[i] = (triangle){{a, b, b}};
        if (!add_loose(ctx, s, a, length) || !add_loose(ctx, s, b, length))
            return FRAM_ERROR_MEMORY;
    }
    fram_status status = mesh_bvh_build(ctx, &s->rims, &s->tree);
    return status == FRAM_OK ? mesh_bvh_build(ctx, &s->points, &s->points_tree) : status;
}

static bool find_near(context *ctx, sealing *s, vec3 p)
{
    vec3 reach = {s->width, s->width, s->width};
    return mesh_bvh_query(ctx, &s->tree, (box3){vec3_sub(p, reach), vec3_add(p, reach)}, &s->near);
}

/* Whether an edge joins the two vertices: a search in the sorted half-edges. */
static bool are_joined(const sealing *s, int32_t u, int32_t v)
{
    int32_t low = u < v ? u : v, high = u < v ? v : u, begin = 0, end = s->sorted.count;
    while (begin < end) {
        int32_t middle = begin + (end - begin) / 2, h = s->sorted.data[middle];
        int32_t a = half_edge_from(s->m, h), b = half_edge_to(s->m, h), l = a < b ? a : b, k = a < b ? b : a;
        if (l < low || (l == low && k < high))
            begin = middle + 1;
        else
            end = middle;
    }
    if (begin == s->sorted.count)
        return false;
    int32_t a = half_edge_from(s->m, s->sorted.data[begin]), b = half_edge_to(s->m, s->sorted.data[begin]);
    return (a == low && b == high) || (a == high && b == low);
}

/* ---- joining ---- */

/* The open edge among those at hand that leads on from v, other than the one that was come along; -1 where the rim ends
   or branches. */
static int32_t next_along(const sealing *s, int32_t v, int32_t before)
{
    int32_t found = -1;
    for (int32_t i = 0; i < s->near.count; i++) {
        int32_t a = s->rims.face.data[s->near.data[i]].v[0], b = s->rims.face.data[s->near.data[i]].v[1];
        int32_t other = a == v ? b : b == v ? a : -1;
        if (other < 0 || other == before)
            continue;
        if (found >= 0)
            return -1;
        found = other;
    }
    return found;
}

/* Whether the rim leads from v to u by hardly more than their distance, on one way or the other. */
static bool same_side(const sealing *s, int32_t v, int32_t u, double distance)
{
    const vec3 *p = s->m->vertex.data;
    for (int32_t i = 0; i < s->near.count; i++) {
        int32_t a = s->rims.face.data[s->near.data[i]].v[0], b = s->rims.face.data[s->near.data[i]].v[1];
        int32_t before = v, at = a == v ? b : b == v ? a : -1;
        double way = at < 0 ? HUGE_VAL : distance_between(p[v], p[at]);
        for (int k = 0; k < MOST_STEPS && at >= 0 && way <= SAME_SIDE * distance; k++) {
            if (at == u)
                return true;
            int32_t next = next_along(s, at, before);
            way += next < 0 ? 0 : distance_between(p[at], p[next]);
            before = at;
            at = next;
        }
    }
    return false;
}

static double distance_to_box(vec3 p, const box3 *b)
{
    return vec3_length((vec3){fmax(fmax(b->lo.x - p.x, p.x - b->hi.x), 0), fmax(fmax(b->lo.y - p.y, p.y - b->hi.y), 0),
                              fmax(fmax(b->lo.z - p.z, p.z - b->hi.z), 0)});
}

/* Whether u, which is no neighbour of v, is nearer to it than the nearest so far; of equally near ones the least is. */
static bool comes_nearer(const sealing *s, int32_t v, int32_t u, double distance, double least)
{
    bool nearer = distance < least || (distance == least && (s->nearest[v] < 0 || u < s->nearest[v]));
    return u != v && nearer && !are_joined(s, u, v);
}

/* The nearest loose vertex within `most` that v is not joined to, or none: its distance.  No box that may
   hold it is passed over: what is rounded is rounded alike. */
static double look_for_nearest(sealing *s, int32_t v, double most)
{
    const mesh_bvh *t = &s->points_tree;
    const vec3 p = s->m->vertex.data[v];
    double least = most;
    int32_t stack[MOST_WAITING], waiting = 0;
    s->nearest[v] = -1;
    stack[waiting++] = 0;
    while (waiting > 0) {
        int32_t i = stack[--waiting];
        const mesh_bvh_node *node = &t->node.data[i];
        if (distance_to_box(p, &node->box) > least)
            continue;
        if (node->next >= 0) {
            bool second = distance_to_box(p, &t->node.data[node->next].box) < distance_to_box(p, &node[1].box);
            stack[waiting++] = second ? i + 1 : node->next;
            stack[waiting++] = second ? node->next : i + 1;
        }
        for (int32_t k = node->first; node->next < 0 && k < node->first + node->count; k++) {
            int32_t u = s->points.face.data[t->face.data[k]].v[0];
            double distance = distance_between(p, s->m->vertex.data[u]);
            if (!comes_nearer(s, v, u, distance, least))
                continue;
            least = distance;
            s->nearest[v] = u;
        }
    }
    return least;
}

/* The same where those on v's own side of a crack are left out. */
static bool find_across(context *ctx, sealing *s, int32_t v, double most)
{
    vec3 p = s->m->vertex.data[v];
    double least = most;
    s->nearest[v] = -1;
    if (!find_near(ctx, s, p))
        return false;
    for (int32_t i = 0; i < s->near.count; i++)
        for (int k = 0; k < 2; k++) {
            int32_t u = s->rims.face.data[s->near.data[i]].v[k];
            double distance = distance_between(p, s->m->vertex.data[u]);
            bool far_along = s->shortest[v] > SAME_SIDE * distance;
            if (comes_nearer(s, v, u, distance, least) && (far_along || !same_side(s, v, u, distance))) {
                least = distance;
                s->nearest[v] = u;
            }
        }
    return true;
}

/* Rims are followed only where the nearest may be on v's own side: where the rim's first edge is no longer than the way
   there may be.  Of a corner of which thousands of facets have a copy all their rims would be at hand each time. */
static bool find_nearest(context *ctx, sealing *s, int32_t v)
{
    const double most = s->width;
    double distance = look_for_nearest(s, v, most);
    bool far_along = s->shortest[v] > SAME_SIDE * distance;
    return s->nearest[v] < 0 || (far_along && distance < most * (1 - LEAST_PART)) || find_across(ctx, s, v, most);
}

/* Pairs that are each other's nearest become the one of lower number. */
static bool join_pairs(context *ctx, sealing *s, bool *changed)
{
    mesh *m = s->m;
    for (int32_t v = 0; v < m->vertex.count; v++)
        if (s->loose[v] && !find_nearest(ctx, s, v))
            return false;
    int32_t joined = 0;
    for (int32_t v = 0; v < m->vertex.count; v++) {
        int32_t u = s->loose[v] ? s->nearest[v] : -1;
        if (u >= 0 && u < v && s->nearest[u] == v) {
            s->report->width = fmax(s->report->width, distance_between(m->vertex.data[u], m->vertex.data[v]));
            joined++;
        }
    }
    s->report->joined += joined;
    *changed = joined > 0;
    for (int32_t f = 0; *changed && f < m->face.count; f++)
        for (int k = 0; k < 3; k++) {
            int32_t v = m->face.data[f].v[k], u = s->loose[v] ? s->nearest[v] : -1;
            if (u >= 0 && u < v && s->nearest[u] == v)
                m->face.data[f].v[k] = u;
        }
    return true;
}

/* ---- detours ---- */

static bool has_vertex(const mesh *m, int32_t face, int32_t v)
{
    const int32_t *w = m->face.data[face].v;
    return w[0] == v || w[1] == v || w[2] == v;
}

/* The open edge nearest to a loose vertex that it does not belong to. */
static bool find_detour(context *ctx, sealing *s, int32_t v)
{
    const mesh *m = s->m;
    vec3 p = m->vertex.data[v];
    detour best = {-1, 0, HUGE_VAL, v};
    if (!find_near(ctx, s, p))
        return false;
    for (int32_t i = 0; i < s->near.count; i++) {
        int32_t h = s->open.data[s->near.data[i]];
        if (has_vertex(m, h / 3, v))
            continue;
        vec3 a = m->vertex.data[half_edge_from(m, h)], ab = vec3_sub(m->vertex.data[half_edge_to(m, h)], a);
        double square = vec3_dot(ab, ab), along = vec3_dot(ab, vec3_sub(p, a)) / square;
        if (!(along > LEAST_PART && along < 1 - LEAST_PART))
            continue;
        double distance = distance_between(p, vec3_mad(a, ab, along));
        if (distance <= s->width && distance < best.distance)
            best = (detour){h, along, distance, v};
    }
    return best.edge < 0 || array_push(ctx, &s->detours, best);
}

static int compare_detour(const void *left, const void *right)
{
    const detour *a = left, *b = right;
    if (a->edge != b->edge)
        return a->edge < b->edge ? -1 : 1;
    if (a->along != b->along)
        return a->along < b->along ? -1 : 1;
    return (a->vertex > b->vertex) - (a->vertex < b->vertex);
}

/* The piece of a triangle that owns the edge from a to b; pieces are `face` and all from `first` on. */
static int32_t owner_of(const mesh *m, int32_t face, int32_t first, int32_t a, int32_t b, int *corner)
{
    for (int32_t f = face; f < m->face.count; f = f == face ? first : f + 1)
        for (int k = 0; k < 3; k++)
            if (m->face.data[f].v[k] == a && m->face.data[f].v[(k + 1) % 3] == b) {
                *corner = k;
                return f;
            }
    return -1;
}

/* Lead the edge from a to b of (a piece of) `face` over the vertex v. */
static bool lead_over(context *ctx, sealing *s, int32_t face, int32_t first, int32_t a, int32_t b, const detour *d)
{
    mesh *m = s->m;
    int corner = 0;
    int32_t owner = owner_of(m, face, first, a, b, &corner);
    int32_t apex = m->face.data[owner].v[(corner + 2) % 3], v = d->vertex;
    vec3 to_v = vec3_sub(m->vertex.data[v], m->vertex.data[a]), to_b = vec3_sub(m->vertex.data[b], m->vertex.data[a]);
    s->report->area += 0.5 * vec3_length(vec3_cross(to_v, to_b));
    s->report->width = fmax(s->report->width, d->distance);
    s->report->splits++;
    m->face.data[owner].v[(corner + 1) % 3] = v;
    return mesh_add_triangle(ctx, m, v, b, apex) && (!s->source || array_push(ctx, s->source, s->source->data[face]));
}

static bool lead_edges(context *ctx, sealing *s)
{
    mesh *m = s->m;
    for (int32_t i = 0; i < s->detours.count;) {
        int32_t face = s->detours.data[i].edge / 3, first = m->face.count;
        const triangle whole = m->face.data[face];
        for (; i < s->detours.count && s->detours.data[i].edge / 3 == face; i++) {
            const detour *d = &s->detours.data[i];
            bool begins = i == 0 || d[-1].edge != d->edge;
            int k = d->edge % 3;
            if (!lead_over(ctx, s, face, first, begins ? whole.v[k] : d[-1].vertex, whole.v[(k + 1) % 3], d))
                return false;
        }
    }
    return true;
}

static bool make_detours(context *ctx, sealing *s, bool *changed)
{
    array_clear(&s->detours);
    for (int32_t v = 0; v < s->m->vertex.count; v++)
        if (s->loose[v] && !find_detour(ctx, s, v))
            return false;
    *changed = s->detours.count > 0;
    if (*changed)
        qsort(s->detours.data, (size_t)s->detours.count, sizeof *s->detours.data, compare_detour);
    return lead_edges(ctx, s);
}

/* ---- all of it ---- */

/* One pass; first vertices alone, so that edges are led over what is left. */
static fram_status seal_once(context *ctx, sealing *s, bool *changed)
{
    *changed = false;
    if (!s->open.count)
        return FRAM_OK;
    fram_status status = plant_trees(ctx, s);
    if (status == FRAM_OK && !join_pairs(ctx, s, changed))
        status = FRAM_ERROR_MEMORY;
    if (status == FRAM_OK && !*changed && !make_detours(ctx, s, changed))
        status = FRAM_ERROR_MEMORY;
    if (status == FRAM_OK && *changed && !find_open(ctx, s))
        status = FRAM_ERROR_MEMORY;
    return status;
}

static vec3 area_sum(const mesh *m)
{
    vec3 sum = {0, 0, 0};
    for (int32_t f = 0; f < m->face.count; f++)
        sum = vec3_add(sum, mesh_area_vector(m, f));
    return sum;
}

static bool begin_source(context *ctx, const mesh *m, int32_array *source)
{
    if (!array_resize(ctx, source, m->face.count))
        return false;
    for (int32_t f = 0; f < m->face.count; f++)
        source->data[f] = f;
    return true;
}

fram_status mesh_seal(context *ctx, mesh *m, double width, int32_array *source, mesh_seal_report *report)
{
    assert(mesh_indices_are_valid(m));
    *report = (mesh_seal_report){0};
    sealing s = {.m = m, .width = width, .source = source, .report = report};
    bool ready = (!source || begin_source(ctx, m, source)) && find_open(ctx, &s);
    fram_status status = ready ? FRAM_OK : FRAM_ERROR_MEMORY;
    report->open_before = s.open.count;
    bool changed = width > 0 && status == FRAM_OK;
    vec3 area = area_sum(m), volume = mesh_volume_integrals(m);
    for (int pass = 0, led = 0; pass < MOST_SEAL_PASSES && led < MOST_PASSES_LED && changed; pass++) {
        int32_t splits = report->splits;
        status = seal_once(ctx, &s, &changed);
        led += report->splits > splits;
        changed = changed && status == FRAM_OK;
    }
    report->open_after = s.open.count;
    report->area_vector = vec3_sub(area_sum(m), area);
    report->volume = vec3_sub(mesh_volume_integrals(m), volume);
    assert(status != FRAM_OK || mesh_indices_are_valid(m));
    sealing_free(ctx, &s);
    return status;
}
