/* Half-edge collapses with a slab test; see mesh_simplify.h.  A pass goes through the vertices in their order; what
   happens to one is not near what happened to another in the same pass. */
#include "geometry/mesh_simplify.h"

#include "geometry/mesh_repair.h"

#include <assert.h>
#include <string.h>

enum {
    MOST_RING = 32,           /* neighbours of a vertex that may go: the tip of a finer fan stays */
    MOST_SIMPLIFY_PASSES = 64 /* a pass takes a sixth of the vertices of a fine mesh */
};
/* A pass that takes less than this part of the vertices is the last one. */
#define LEAST_TAKEN 0.01
/* Cosine of the largest turn of a triangle against the slab that it lies in. */
#define LEAST_COSINE 0.5

typedef struct simplifying {
    mesh *m;
    double distance;
    double *used;   /* of each face: the distance from the first surface that may be used up there */
    int32_t *start; /* faces at vertex v: at[start[v] .. start[v + 1]) */
    int32_t *at;
    uint8_t *locked; /* vertices whose faces changed in this pass */
    int32_t taken;
} simplifying;

/* The neighbours of a vertex, counter-clockwise seen from outside, and the faces between them: face i is
   (vertex, ring[i], ring[i + 1]). */
typedef struct fan {
    int32_t vertex, count;
    int32_t ring[MOST_RING], face[MOST_RING];
} fan;

/* Place i of the ring, counted on over its end once. */
static int32_t around(const fan *f, int32_t i) { return i < f->count ? i : i - f->count; }

static void index_faces(simplifying *s)
{
    const mesh *m = s->m;
    memset(s->start, 0, ((size_t)m->vertex.count + 1) * sizeof *s->start);
    for (int32_t f = 0; f < m->face.count; f++)
        for (int k = 0; k < 3; k++)
            s->start[m->face.data[f].v[k] + 1]++;
    for (int32_t v = 0; v < m->vertex.count; v++)
        s->start[v + 1] += s->start[v];
    /* From behind; a vertex's start then stands one place too high. */
    for (int32_t f = m->face.count; f-- > 0;)
        for (int k = 0; k < 3; k++)
            s->at[--s->start[m->face.data[f].v[k] + 1]] = f;
    memmove(s->start, s->start + 1, (size_t)m->vertex.count * sizeof *s->start);
    s->start[m->vertex.count] = 3 * m->face.count;
}

static int corner_of(const mesh *m, int32_t face, int32_t v)
{
    const int32_t *w = m->face.data[face].v;
    return w[0] == v ? 0 : w[1] == v ? 1 : 2;
}

/* false: the faces at the vertex are no single closed fan, are too many, or changed in this pass. */
static bool fan_of(const simplifying *s, int32_t v, fan *out)
{
    const mesh *m = s->m;
    int32_t count = s->start[v + 1] - s->start[v];
    if (count < 3 || count > MOST_RING)
        return false;
    out->vertex = v;
    out->count = count;
    int32_t face = s->at[s->start[v]];
    for (int32_t i = 0; i < count; i++) {
        int k = corner_of(m, face, v);
        int32_t next = m->face.data[face].v[(k + 2) % 3];
        out->face[i] = face;
        out->ring[i] = m->face.data[face].v[(k + 1) % 3];
        if (s->locked[out->ring[i]])
            return false;
        int32_t found = -1;
        for (int32_t j = s->start[v]; j < s->start[v + 1] && found < 0; j++)
            if (m->face.data[s->at[j]].v[(corner_of(m, s->at[j], v) + 1) % 3] == next)
                found = s->at[j];
        if (found < 0 || (found == out->face[0] && i + 1 < count))
            return false;
        face = found;
    }
    return face == out->face[0];
}

/* Neighbours that two vertices share: two where the surface stays a surface when the one is drawn onto the other. */
static bool may_join(const simplifying *s, const fan *f, int32_t to)
{
    const mesh *m = s->m;
    int shared = 0;
    for (int32_t i = 0; i < f->count; i++) {
        bool neighbour = false;
        for (int32_t j = s->start[to]; j < s->start[to + 1] && !neighbour; j++)
            for (int k = 0; k < 3; k++)
                neighbour = neighbour || m->face.data[s->at[j]].v[k] == f->ring[i];
        shared += f->ring[i] != to && neighbour;
    }
    return shared == 2;
}

/* The thickness of the slab that holds the part of the fan from ring[first] over `steps` faces, and what stands in for
   it when its vertex is drawn onto ring[hub]; HUGE_VAL where that folds over. */
static double slab_of(const simplifying *s, const fan *f, int32_t first, int32_t steps, int32_t hub)
{
    const mesh *m = s->m;
    vec3 tip = m->vertex.data[f->vertex], onto = m->vertex.data[f->ring[hub]], sum = {0, 0, 0};
    for (int32_t i = 0; i < steps; i++)
        sum = vec3_add(sum, mesh_area_vector(m, f->face[around(f, first + i)]));
    vec3 normal = vec3_unit(sum);
    double lo = 0, hi = 0;
    for (int32_t i = 0; i <= steps; i++) {
        double height = vec3_dot(normal, vec3_sub(m->vertex.data[f->ring[around(f, first + i)]], tip));
        lo = fmin(lo, height);
        hi = fmax(hi, height);
    }
    for (int32_t i = 0; i < steps; i++) {
        int32_t a = around(f, first + i), b = around(f, a + 1);
        if (!(vec3_dot(normal, vec3_unit(mesh_area_vector(m, f->face[a]))) > LEAST_COSINE))
            return HUGE_VAL;
        if (a == hub || b == hub)
            continue;
        vec3 p = m->vertex.data[f->ring[a]], q = m->vertex.data[f->ring[b]];
        if (!(vec3_dot(normal, vec3_unit(vec3_cross(vec3_sub(p, onto), vec3_sub(q, onto)))) > LEAST_COSINE))
            return HUGE_VAL;
    }
    return hi - lo;
}

/* Distance that drawing the vertex onto ring[hub] uses up: in one slab, or in two on either side of the edge that goes
   on from there straight over the vertex. */
static double cost_of(const simplifying *s, const fan *f, int32_t hub)
{
    double whole = slab_of(s, f, hub, f->count, hub), off = HUGE_VAL;
    const vec3 *p = s->m->vertex.data;
    int32_t over = -1;
    for (int32_t i = 2; i + 1 < f->count; i++) {
        int32_t k = around(f, hub + i);
        vec3 q = segment_nearest3(p[f->vertex], p[f->ring[hub]], p[f->ring[k]]);
        double d = vec3_length(vec3_sub(q, p[f->vertex]));
        if (d < off) {
            off = d;
            over = i;
        }
    }
    if (over < 0)
        return whole;
    double one = slab_of(s, f, hub, over, hub), other = slab_of(s, f, around(f, hub + over), f->count - over, hub);
    return fmin(whole, fmax(off, fmax(one, other)));
}

/* The vertex goes; its faces, but for two, get the other one instead. */
static void draw_onto(simplifying *s, const fan *f, int32_t hub, double used)
{
    int32_t to = f->ring[hub];
    for (int32_t i = 0; i < f->count; i++) {
        triangle *t = &s->m->face.data[f->face[i]];
        s->used[f->face[i]] = used;
        if (i == hub || around(f, i + 1) == hub)
            t->v[0] = t->v[1] = t->v[2] = to; /* gone */
        else
            t->v[corner_of(s->m, f->face[i], f->vertex)] = to;
        s->locked[f->ring[i]] = 1;
    }
    s->locked[f->vertex] = 1;
    s->taken++;
}

static void try_vertex(simplifying *s, int32_t v)
{
    fan f;
    if (s->locked[v] || !fan_of(s, v, &f))
        return;
    double used = 0, least = HUGE_VAL;
    int32_t hub = -1;
    for (int32_t i = 0; i < f.count; i++)
        used = fmax(used, s->used[f.face[i]]);
    for (int32_t i = 0; i < f.count; i++) {
        double cost = cost_of(s, &f, i);
        if (cost < least && used + cost <= s->distance && may_join(s, &f, f.ring[i])) {
            least = cost;
            hub = i;
        }
    }
    if (hub >= 0)
        draw_onto(s, &f, hub, used + least);
}

static void drop_gone(simplifying *s)
{
    mesh *m = s->m;
    int32_t kept = 0;
    for (int32_t f = 0; f < m->face.count; f++) {
        const int32_t *v = m->face.data[f].v;
        if (v[0] == v[1])
            continue;
        m->face.data[kept] = m->face.data[f];
        s->used[kept++] = s->used[f];
    }
    m->face.count = kept;
}

static fram_status simplify(context *ctx, simplifying *s)
{
    mesh *m = s->m;
    for (int pass = 0; pass < MOST_SIMPLIFY_PASSES; pass++) {
        index_faces(s);
        memset(s->locked, 0, (size_t)m->vertex.count);
        s->taken = 0;
        for (int32_t v = 0; v < m->vertex.count; v++)
            try_vertex(s, v);
        drop_gone(s);
        int32_t before = m->vertex.count;
        if (!mesh_drop_unused_vertices(ctx, m))
            return FRAM_ERROR_MEMORY;
        if (s->taken < LEAST_TAKEN * before)
            break;
    }
    return FRAM_OK;
}

fram_status mesh_simplify(context *ctx, mesh *m, double distance, double *largest)
{
    assert(mesh_indices_are_valid(m));
    size_t vertices = (size_t)m->vertex.count, faces = (size_t)m->face.count;
    simplifying s = {.m = m, .distance = distance};
    s.used = memory_array(ctx, faces + 1, sizeof *s.used);
    s.start = memory_array(ctx, vertices + 1, sizeof *s.start);
    s.at = memory_array(ctx, 3 * faces + 1, sizeof *s.at);
    s.locked = memory_array(ctx, vertices + 1, 1);
    fram_status status = s.used && s.start && s.at && s.locked ? simplify(ctx, &s) : FRAM_ERROR_MEMORY;
    *largest = 0;
    for (int32_t f = 0; status == FRAM_OK && f < m->face.count; f++)
        *largest = fmax(*largest, s.used[f]);
    memory_free(ctx, s.used);
    memory_free(ctx, s.start);
    memory_free(ctx, s.at);
    memory_free(ctx, s.locked);
    if (status != FRAM_OK)
        mesh_clear(m);
    return status;
}
