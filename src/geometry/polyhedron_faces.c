/* From the triangles of a hull to faces; see polyhedron_build.h.

   1. Triangles are grouped: the largest one left, with everything that hangs together with it within the tolerance of
   its
      plane, is a group.  Slivers, whose planes mean nothing, join the group across their longest side.
   2. The rim of each group is traced. 3. A vertex between only two groups is on their common edge: those within the
   tolerance of a straight line are left out. A body hardly thicker than the tolerance may come out with fewer than four
   faces, or with one that is no ring of three vertices: it keeps its triangles. */
#include "geometry/polyhedron_build.h"

#include <stdlib.h>

typedef struct facet {
    vec3 normal;   /* unit */
    double area;   /* twice the area */
    double height; /* over the longest side */
    int longest;   /* that side */
} facet;

typedef struct rim {
    int32_t group, first, count; /* vertex[first .. first + count) and beyond[..] */
} rim;

typedef struct merge {
    const vec3 *point;
    const hull_triangle *t;
    int32_t count; /* of triangles */
    double tolerance;
    facet *facet;
    int32_t *order;   /* triangles, largest first */
    int32_t *group;   /* of each triangle, or -1 */
    int32_t *waiting; /* stack of a flood */
    uint8_t *traced;  /* of each half-edge 3 t + k */
    int32_t *rims_of; /* of each point: rims through it */
    uint8_t *keep;    /* of each point */
    int32_t groups;
    ARRAY(rim) rims;
    int32_array vertex, beyond; /* of the rims: points, and the group across the edge that begins there */
} merge;

static facet facet_of(const merge *m, int32_t i)
{
    const int32_t *v = m->t[i].v;
    facet f = {.longest = 0};
    double longest = 0;
    vec3 ab = vec3_sub(m->point[v[1]], m->point[v[0]]), ac = vec3_sub(m->point[v[2]], m->point[v[0]]);
    vec3 n = vec3_cross(ab, ac);
    for (int k = 0; k < 3; k++) {
        vec3 side = vec3_sub(m->point[v[(k + 1) % 3]], m->point[v[k]]);
        if (vec3_dot(side, side) > longest) {
            longest = vec3_dot(side, side);
            f.longest = k;
        }
    }
    f.normal = vec3_unit(n);
    f.area = vec3_length(n);
    f.height = longest > 0 ? f.area / sqrt(longest) : 0;
    return f;
}

typedef struct size_key {
    double area;
    int32_t triangle;
} size_key;

static int larger_first(const void *a, const void *b)
{
    const size_key *x = a, *y = b;
    if (x->area != y->area)
        return x->area > y->area ? -1 : 1;
    return (x->triangle > y->triangle) - (x->triangle < y->triangle);
}

static bool sort_by_size(context *ctx, merge *m)
{
    size_key *key = memory_array(ctx, (size_t)m->count, sizeof *key);
    if (!key)
        return false;
    for (int32_t i = 0; i < m->count; i++)
        key[i] = (size_key){m->facet[i].area, i};
    qsort(key, (size_t)m->count, sizeof *key, larger_first);
    for (int32_t i = 0; i < m->count; i++)
        m->order[i] = key[i].triangle;
    memory_free(ctx, key);
    return true;
}

static bool merge_begin(context *ctx, merge *m, int32_t points)
{
    size_t n = (size_t)m->count;
    m->facet = memory_array(ctx, n, sizeof *m->facet);
    m->order = memory_array(ctx, n, sizeof *m->order);
    m->group = memory_array(ctx, n, sizeof *m->group);
    m->waiting = memory_array(ctx, n, sizeof *m->waiting);
    m->traced = memory_array(ctx, 3 * n, sizeof *m->traced);
    m->rims_of = memory_array(ctx, (size_t)points, sizeof *m->rims_of);
    m->keep = memory_array(ctx, (size_t)points, sizeof *m->keep);
    if (!m->facet || !m->order || !m->group || !m->waiting || !m->traced || !m->rims_of || !m->keep)
        return false;
    for (int32_t i = 0; i < m->count; i++)
        m->facet[i] = facet_of(m, i);
    return sort_by_size(ctx, m);
}

static void merge_free(context *ctx, merge *m)
{
    memory_free(ctx, m->facet);
    memory_free(ctx, m->order);
    memory_free(ctx, m->group);
    memory_free(ctx, m->waiting);
    memory_free(ctx, m->traced);
    memory_free(ctx, m->rims_of);
    memory_free(ctx, m->keep);
    array_free(ctx, &m->rims);
    array_free(ctx, &m->vertex);
    array_free(ctx, &m->beyond);
}

/* ---- 1. groups ---- */

static bool is_sliver(const merge *m, int32_t i) { return m->facet[i].height <= m->tolerance; }

static bool in_plane_of(const merge *m, int32_t seed, int32_t i)
{
    const facet *plane = &m->facet[seed];
    if (!is_sliver(m, i) && !(vec3_dot(plane->normal, m->facet[i].normal) > 0))
        return false; /* the far side of a thin body */
    for (int k = 0; k < 3; k++) {
        vec3 off = vec3_sub(m->point[m->t[i].v[k]], m->point[m->t[seed].v[0]]);
        if (!(fabs(vec3_dot(plane->normal, off)) <= m->tolerance))
            return false;
    }
    return true;
}

static void flood_plane(merge *m, int32_t seed)
{
    int32_t waiting = 0;
    m->waiting[waiting++] = seed;
    m->group[seed] = m->groups;
    while (waiting) {
        int32_t i = m->waiting[--waiting];
        for (int k = 0; k < 3; k++) {
            int32_t g = m->t[i].neighbour[k];
            if (m->group[g] < 0 && in_plane_of(m, seed, g)) {
                m->group[g] = m->groups;
                m->waiting[waiting++] = g;
            }
        }
    }
    m->groups++;
}

/* Slivers that no plane took go to the group over their longest side, or over any side when that is a sliver too. */
static void join_slivers(merge *m)
{
    for (int any_side = 0; any_side < 2; any_side++)
        for (bool changed = true; changed;) {
            changed = false;
            for (int32_t i = 0; i < m->count; i++) {
                int32_t found = -1;
                for (int k = 0; m->group[i] < 0 && found < 0 && k < 3; k++)
                    if (any_side || k == m->facet[i].longest)
                        found = m->group[m->t[i].neighbour[k]];
                if (found >= 0) {
                    m->group[i] = found;
                    changed = true;
                }
            }
        }
}

static void make_groups(merge *m)
{
    m->groups = 0;
    for (int32_t i = 0; i < m->count; i++)
        m->group[i] = -1;
    for (int32_t i = 0; i < m->count; i++)
        if (m->group[m->order[i]] < 0 && !is_sliver(m, m->order[i]))
            flood_plane(m, m->order[i]);
    join_slivers(m);
}

static void every_triangle_a_group(merge *m)
{
    for (int32_t i = 0; i < m->count; i++)
        m->group[i] = i;
    m->groups = m->count;
}

/* ---- 2. rims ---- */

static int edge_from(const hull_triangle *t, int32_t v) { return t->v[0] == v ? 0 : t->v[1] == v ? 1 : 2; }

/* The rim from half-edge h on: at each vertex, turn through the group to its next border. */
static bool trace_rim(context *ctx, merge *m, int32_t h)
{
    int32_t group = m->group[h / 3], first = m->vertex.count;
    while (!m->traced[h]) {
        m->traced[h] = 1;
        int32_t i = h / 3, k = h % 3;
        if (!array_push(ctx, &m->vertex, m->t[i].v[k]) || !array_push(ctx, &m->beyond, m->group[m->t[i].neighbour[k]]))
            return false;
        int32_t corner = m->t[i].v[(k + 1) % 3];
        k = (k + 1) % 3;
        while (m->group[m->t[i].neighbour[k]] == group) {
            i = m->t[i].neighbour[k];
            k = edge_from(&m->t[i], corner);
        }
        h = 3 * i + k;
    }
    return array_push(ctx, &m->rims, (rim){group, first, m->vertex.count - first});
}

static bool trace_rims(context *ctx, merge *m)
{
    array_clear(&m->rims);
    array_clear(&m->vertex);
    array_clear(&m->beyond);
    for (int32_t h = 0; h < 3 * m->count; h++)
        m->traced[h] = 0;
    for (int32_t h = 0; h < 3 * m->count; h++)
        if (!m->traced[h] && m->group[m->t[h / 3].neighbour[h % 3]] != m->group[h / 3] && !trace_rim(ctx, m, h))
            return false;
    return true;
}

/* ---- 3. straight vertices ---- */

/* Between places a and b of a rim (b may lie beyond its end), keep what stands off the straight line (Douglas and
   Peucker 1973). */
static void keep_bends(merge *m, const rim *r, int32_t a, int32_t b)
{
    while (b - a > 1) {
        const int32_t *v = m->vertex.data + r->first;
        int32_t farthest = a;
        double most = m->tolerance;
        for (int32_t i = a + 1; i < b; i++) {
            vec3 p = m->point[v[i % r->count]];
            vec3 q = segment_nearest3(p, m->point[v[a % r->count]], m->point[v[b % r->count]]);
            double d = vec3_length(vec3_sub(p, q));
            if (d > most) {
                most = d;
                farthest = i;
            }
        }
        if (farthest == a)
            return;
        m->keep[v[farthest % r->count]] = 1;
        keep_bends(m, r, a, farthest);
        a = farthest;
    }
}

/* The chains of a rim between corners, each looked at from the group of lower number. */
static void keep_bends_of_rim(merge *m, const rim *r)
{
    const int32_t *v = m->vertex.data + r->first, *beyond = m->beyond.data + r->first;
    int32_t first = 0;
    while (first < r->count && m->rims_of[v[first]] < 3)
        first++;
    if (first == r->count) { /* all around between two groups: no corner to begin with */
        for (int32_t i = 0; i < r->count; i++)
            m->keep[v[i]] = 1;
        return;
    }
    for (int32_t a = first, b; a < first + r->count; a = b) {
        b = a + 1;
        while (m->rims_of[v[b % r->count]] < 3)
            b++;
        if (r->group < beyond[a % r->count])
            keep_bends(m, r, a, b);
    }
}

static void choose_vertices(merge *m)
{
    for (int32_t i = 0; i < m->vertex.count; i++)
        m->rims_of[m->vertex.data[i]] = m->keep[m->vertex.data[i]] = 0;
    for (int32_t i = 0; i < m->vertex.count; i++)
        m->rims_of[m->vertex.data[i]]++;
    for (int32_t i = 0; i < m->vertex.count; i++)
        m->keep[m->vertex.data[i]] = m->rims_of[m->vertex.data[i]] >= 3;
    for (int32_t i = 0; i < m->rims.count; i++)
        keep_bends_of_rim(m, &m->rims.data[i]);
}

/* ---- the polyhedron ---- */

/* Loops of kept vertices, still by point number.  false: no memory. */
static bool add_loops(context *ctx, const merge *m, polyhedron *out)
{
    array_clear(&out->loop);
    array_clear(&out->face);
    for (int32_t i = 0; i < m->rims.count; i++) {
        const rim *r = &m->rims.data[i];
        const int32_t *v = m->vertex.data + r->first;
        int32_t first = out->loop.count, start = 0;
        for (int32_t k = 1; k < r->count; k++) /* from the least kept vertex on */
            if (m->keep[v[k]] && (!m->keep[v[start]] || v[k] < v[start]))
                start = k;
        for (int32_t k = 0; k < r->count; k++)
            if (m->keep[v[(start + k) % r->count]] && !array_push(ctx, &out->loop, v[(start + k) % r->count]))
                return false;
        if (!array_push(ctx, &out->face, (polyhedron_face){.first = first, .count = out->loop.count - first}))
            return false;
    }
    return true;
}

/* Keep the points that loops name, in their order; `number` has room for all of them. */
static bool add_vertices(context *ctx, const merge *m, int32_t points, int32_t *number, polyhedron *out)
{
    for (int32_t i = 0; i < points; i++)
        number[i] = -1;
    for (int32_t i = 0; i < out->loop.count; i++)
        number[out->loop.data[i]] = 0;
    for (int32_t i = 0; i < points; i++)
        if (number[i] == 0) {
            number[i] = out->vertex.count;
            if (!array_push(ctx, &out->vertex, m->point[i]))
                return false;
        }
    for (int32_t i = 0; i < out->loop.count; i++)
        out->loop.data[i] = number[out->loop.data[i]];
    return true;
}

static bool make_faces(context *ctx, merge *m, polyhedron *out)
{
    if (!trace_rims(ctx, m))
        return false;
    choose_vertices(m);
    return add_loops(ctx, m, out);
}

static bool sound(const merge *m, const polyhedron *p)
{
    bool rings = p->face.count >= 4 && m->rims.count == m->groups;
    for (int32_t i = 0; i < p->face.count; i++)
        rings = rings && p->face.data[i].count >= 3;
    return rings;
}

bool polyhedron_from_triangles(context *ctx, const vec3 *point, const hull_triangle_array *triangles, double tolerance,
                               polyhedron *out)
{
    int32_t points = 0;
    for (int32_t i = 0; i < triangles->count; i++)
        for (int k = 0; k < 3; k++)
            if (triangles->data[i].v[k] >= points)
                points = triangles->data[i].v[k] + 1;
    merge m = {.point = point, .t = triangles->data, .count = triangles->count, .tolerance = tolerance};
    bool done = merge_begin(ctx, &m, points);
    if (done) {
        make_groups(&m);
        done = make_faces(ctx, &m, out);
    }
    if (done && !sound(&m, out)) {
        every_triangle_a_group(&m);
        done = make_faces(ctx, &m, out);
    }
    done = done && add_vertices(ctx, &m, points, m.rims_of, out) && polyhedron_finish(ctx, out);
    merge_free(ctx, &m);
    if (!done)
        polyhedron_free(ctx, out);
    return done;
}

fram_status polyhedron_hull(context *ctx, const vec3 *point, int32_t count, double tolerance, polyhedron *out,
                            fram_error *error)
{
    polyhedron_free(ctx, out);
    hull_triangle_array triangles = {0};
    fram_status status = convex_hull_triangles(ctx, point, count, tolerance, &triangles, error);
    tolerance = fmax(tolerance, hull_rounding(point, count));
    if (status == FRAM_OK && !polyhedron_from_triangles(ctx, point, &triangles, tolerance, out))
        status = error_memory(error);
    array_free(ctx, &triangles);
    return status;
}
