/* Cutting solids by planes; see mesh_clip.h.

   Vertices are below the plane or not; those on it are not.  Every triangle with vertices of both kinds is cut at its
   two crossing edges, and a crossing is a new vertex, named by the triangle through whose edge up the section's ring
   leaves. Crossings that follow one another in a ring and have their upper end in common, on the plane, are one
   vertex.  So the cut surface and the rings name the same vertices, each ring by itself, and the result is a closed
   manifold whatever rounding does to their places, also where it touches itself in the plane. */
#include "geometry/mesh_clip.h"

#include "geometry/convex_hull3.h"
#include "geometry/ear_clip.h"
#include "geometry/mesh_edges.h"
#include "geometry/mesh_rings.h"
#include "geometry/predicate3.h"

typedef struct cut {
    const mesh *m;
    const mesh_adjacency *adjacency;
    double *distance;    /* of each vertex, 0 when on the plane */
    uint8_t *above;      /* distance >= 0 */
    int32_t *new_vertex; /* of each vertex of m, or -1 */
    int32_t *crossing;   /* new vertex of each face's edge up, or -1 */
    mesh_rings rings;
    double straight;  /* vertices no farther off a line are on it */
    int drop;         /* the axis along which caps are seen: 0 x, 1 y, 2 z */
    bool flip;        /* seen against the normal */
    int32_array ring; /* a ring's new vertices */
    vec2_array plan;
    index_array ears;
    mesh *out;
} cut;

static bool cut_begin(context *ctx, cut *c, vec3 normal, double d, double snap)
{
    size_t vertices = (size_t)c->m->vertex.count, faces = (size_t)c->m->face.count;
    c->distance = memory_array(ctx, vertices, sizeof *c->distance);
    c->above = memory_array(ctx, vertices, sizeof *c->above);
    c->new_vertex = memory_array(ctx, vertices, sizeof *c->new_vertex);
    c->crossing = memory_array(ctx, faces, sizeof *c->crossing);
    if (!c->distance || !c->above || !c->new_vertex || !c->crossing)
        return false;
    for (size_t i = 0; i < vertices; i++) {
        double distance = vec3_dot(normal, c->m->vertex.data[i]) - d;
        c->distance[i] = fabs(distance) <= snap ? 0 : distance;
        c->above[i] = c->distance[i] >= 0;
        c->new_vertex[i] = -1;
    }
    for (size_t i = 0; i < faces; i++)
        c->crossing[i] = -1;
    c->straight = snap + 4 * hull_rounding(c->m->vertex.data, c->m->vertex.count);
    double x = fabs(normal.x), y = fabs(normal.y), z = fabs(normal.z);
    c->drop = x >= y && x >= z ? 0 : y >= z ? 1 : 2;
    c->flip = (c->drop == 0 ? normal.x : c->drop == 1 ? normal.y : normal.z) < 0;
    return true;
}

static void cut_free(context *ctx, cut *c)
{
    memory_free(ctx, c->distance);
    memory_free(ctx, c->above);
    memory_free(ctx, c->new_vertex);
    memory_free(ctx, c->crossing);
    mesh_rings_free(ctx, &c->rings);
    array_free(ctx, &c->ring);
    array_free(ctx, &c->plan);
    array_free(ctx, &c->ears);
}

/* The new vertex of an old one that is kept. */
static bool keep_vertex(context *ctx, cut *c, int32_t v)
{
    if (c->new_vertex[v] >= 0)
        return true;
    c->new_vertex[v] = c->out->vertex.count;
    return mesh_add_vertex(ctx, c->out, c->m->vertex.data[v]);
}

/* Both half-edges end in the same vertex, which is on the plane. */
static bool same_crossing(const cut *c, int32_t g, int32_t h)
{
    int32_t top = half_edge_to(c->m, h);
    return half_edge_to(c->m, g) == top && c->distance[top] == 0;
}

static bool add_crossing(context *ctx, cut *c, int32_t h)
{
    int32_t low = half_edge_from(c->m, h), high = half_edge_to(c->m, h);
    const vec3 *p = c->m->vertex.data;
    return mesh_add_vertex(ctx, c->out, segment_crossing(p[low], c->distance[low], p[high], c->distance[high]));
}

static bool add_crossings_of_ring(context *ctx, cut *c, const int32_t *h, int32_t count)
{
    int32_t first = 0; /* where a new vertex begins; a ring about a single vertex has no such place */
    while (first + 1 < count && same_crossing(c, h[first > 0 ? first - 1 : count - 1], h[first]))
        first++;
    for (int32_t i = 0, before = -1; i < count; i++) {
        int32_t g = h[(first + i) % count];
        if ((before < 0 || !same_crossing(c, before, g)) && !add_crossing(ctx, c, g))
            return false;
        c->crossing[g / 3] = c->out->vertex.count - 1;
        before = g;
    }
    return true;
}

static bool add_crossings(context *ctx, cut *c)
{
    for (int32_t i = 0; i < mesh_rings_count(&c->rings); i++) {
        int32_t begin = c->rings.start.data[i], end = c->rings.start.data[i + 1];
        if (!add_crossings_of_ring(ctx, c, c->rings.half_edge.data + begin, end - begin))
            return false;
    }
    return true;
}

/* A triangle that lost its second crossing, because both are one vertex, is left out. */
static bool add_unless_flat(context *ctx, mesh *out, int32_t a, int32_t b, int32_t c)
{
    return a == b || b == c || c == a || mesh_add_triangle(ctx, out, a, b, c);
}

/* What the plane leaves of a face with vertices on both sides. */
static bool add_cut_face(context *ctx, cut *c, int32_t f, int up)
{
    const int32_t *v = c->m->face.data[f].v;
    int32_t last = v[up], next = v[(up + 2) % 3]; /* `last` below, then one above, then `next` */
    bool two_below = !c->above[next];
    /* The edge down begins at the last vertex above. */
    int32_t down = 3 * f + (up + (two_below ? 1 : 2)) % 3;
    int32_t leave = c->crossing[f], enter = c->crossing[c->adjacency->neighbour.data[down]];
    int32_t b = c->new_vertex[last];
    if (!two_below)
        return add_unless_flat(ctx, c->out, b, leave, enter);
    return add_unless_flat(ctx, c->out, c->new_vertex[next], b, leave) &&
           add_unless_flat(ctx, c->out, c->new_vertex[next], leave, enter);
}

static bool add_faces_below(context *ctx, cut *c)
{
    for (int32_t f = 0; f < c->m->face.count; f++) {
        const int32_t *v = c->m->face.data[f].v;
        int above = c->above[v[0]] + c->above[v[1]] + c->above[v[2]];
        if (above == 3)
            continue;
        for (int k = 0; k < 3; k++)
            if (!c->above[v[k]] && !keep_vertex(ctx, c, v[k]))
                return false;
        bool done = above == 0
                        ? mesh_add_triangle(ctx, c->out, c->new_vertex[v[0]], c->new_vertex[v[1]], c->new_vertex[v[2]])
                        : add_cut_face(ctx, c, f, mesh_edge_up(c->m, f, c->above));
        if (!done)
            return false;
    }
    return true;
}

static vec2 seen_point(const cut *c, int32_t vertex)
{
    vec3 p = c->out->vertex.data[vertex];
    vec2 q = c->drop == 0 ? (vec2){p.y, p.z} : c->drop == 1 ? (vec2){p.z, p.x} : (vec2){p.x, p.y};
    return c->flip ? (vec2){-q.x, q.y} : q;
}

/* Take the vertices of ring[first + 1 ..] out that are straight but for rounding, each with a flat triangle over its
   neighbours: a flat side leaves rows of them, which may even run back and forth by a last digit, and no ring of ears
   could be found then. */
static bool cap_straight_vertices(context *ctx, cut *c, int32_t first)
{
    int32_t *ring = c->ring.data + first;
    const vec3 *p = c->out->vertex.data;
    int32_t before, count = c->ring.count - first;
    if (count < 4)
        return true;
    do {
        before = count;
        int32_t kept = 1;
        for (int32_t i = 1; i < before; i++) {
            int32_t a = ring[kept - 1], v = ring[i], b = i + 1 < before ? ring[i + 1] : ring[0];
            vec3 off = vec3_sub(segment_nearest3(p[v], p[a], p[b]), p[v]);
            bool straight = vec3_dot(off, off) <= c->straight * c->straight;
            if (!straight || kept + before - i <= 3)
                ring[kept++] = v;
            else if (!add_unless_flat(ctx, c->out, a, v, b))
                return false;
        }
        count = kept;
    } while (count < before);
    c->ring.count = first + count;
    return true;
}

/* Ears of ring[first ..] as places in it, counter-clockwise as the ring is; FRAM_ERROR_INPUT when it has none. */
static fram_status find_ears(context *ctx, cut *c, int32_t first)
{
    int32_t count = c->ring.count - first;
    if (!array_resize(ctx, &c->plan, count))
        return FRAM_ERROR_MEMORY;
    for (int32_t i = 0; i < count; i++)
        c->plan.data[i] = seen_point(c, c->ring.data[first + i]);
    bool hole = polygon_area((polygon){c->plan.data, count}) < 0;
    for (int32_t i = 0; hole && i < count; i++)
        c->plan.data[count - 1 - i] = seen_point(c, c->ring.data[first + i]);
    fram_status status = polygon_triangulate_ears(ctx, (polygon){c->plan.data, count}, &c->ears);
    if (status != FRAM_OK)
        return status;
    int32_t *ear = c->ears.data;
    for (int32_t i = 0; hole && i < c->ears.count; i++)
        ear[i] = count - 1 - ear[i];
    for (int32_t i = 0; hole && i < c->ears.count; i += 3) {
        int32_t swap = ear[i];
        ear[i] = ear[i + 2];
        ear[i + 2] = swap;
    }
    /* Fewer where two vertices are seen at one place. */
    return c->ears.count == 3 * (count - 2) ? FRAM_OK : FRAM_ERROR_INPUT;
}

/* Cap of the ring ring[first ..] of places that are all different; only ring[first] is sure to stay in the ring. */
static fram_status add_cap(context *ctx, cut *c, int32_t first)
{
    if (c->ring.count - first < 3)
        return FRAM_OK;
    fram_status status = find_ears(ctx, c, first);
    if (status == FRAM_ERROR_INPUT) {
        if (!cap_straight_vertices(ctx, c, first))
            return FRAM_ERROR_MEMORY;
        status = find_ears(ctx, c, first);
    }
    if (status == FRAM_ERROR_MEMORY)
        return status;
    const int32_t *ring = c->ring.data + first, *ear = c->ears.data;
    for (int32_t i = 0; i < c->ring.count - first - 2; i++) {
        bool done = status == FRAM_OK
                        ? mesh_add_triangle(ctx, c->out, ring[ear[3 * i]], ring[ear[3 * i + 1]], ring[ear[3 * i + 2]])
                        : mesh_add_triangle(ctx, c->out, ring[0], ring[i + 1], ring[i + 2]);
        if (!done)
            return FRAM_ERROR_MEMORY;
    }
    return FRAM_OK;
}

/* Where the ring has been at this place before, or -1. */
static int32_t same_place(const cut *c, int32_t vertex)
{
    const vec3 *p = c->out->vertex.data;
    for (int32_t i = 0; i < c->ring.count; i++)
        if (vec3_equal(p[c->ring.data[i]], p[vertex]))
            return i;
    return -1;
}

/* Follow a ring with the vertices a, b, ..., and when it comes to a place again cap what it has gone round since and go
   on from the vertex that was there first.  Triangles without area between the two vertices of the place and their
   neighbours keep the surface closed: (before, second, first) and (first, second, after). */
static fram_status add_caps_of_ring(context *ctx, cut *c, int32_t begin, int32_t end)
{
    fram_status status = FRAM_OK;
    int32_t last = -1, twin = -1; /* twin: the second vertex at the place of the last one in the ring, to be left */
    array_clear(&c->ring);
    for (int32_t i = begin; i < end && status == FRAM_OK; i++) {
        int32_t vertex = c->crossing[c->rings.half_edge.data[i] / 3];
        if (vertex == last || (i + 1 == end && vertex == c->ring.data[0]))
            continue;
        last = vertex;
        int32_t top = c->ring.count ? c->ring.data[c->ring.count - 1] : -1, before = same_place(c, vertex);
        if (twin >= 0 && !add_unless_flat(ctx, c->out, top, twin, vertex))
            return FRAM_ERROR_MEMORY;
        twin = -1;
        if (before >= 0) {
            status = add_cap(ctx, c, before);
            if (!add_unless_flat(ctx, c->out, top, vertex, c->ring.data[before]))
                return FRAM_ERROR_MEMORY;
            c->ring.count = before + 1;
            twin = vertex;
        } else if (!array_push(ctx, &c->ring, vertex)) {
            return FRAM_ERROR_MEMORY;
        }
    }
    if (twin >= 0 && status == FRAM_OK &&
        !add_unless_flat(ctx, c->out, c->ring.data[c->ring.count - 1], twin, c->ring.data[0]))
        return FRAM_ERROR_MEMORY;
    return status == FRAM_OK ? add_cap(ctx, c, 0) : status;
}

static fram_status add_caps(context *ctx, cut *c)
{
    fram_status status = FRAM_OK;
    for (int32_t i = 0; i < mesh_rings_count(&c->rings) && status == FRAM_OK; i++)
        status = add_caps_of_ring(ctx, c, c->rings.start.data[i], c->rings.start.data[i + 1]);
    return status;
}

fram_status mesh_clip(context *ctx, const mesh *m, const mesh_adjacency *adjacency, vec3 normal, double d, double snap,
                      mesh *out, fram_error *error)
{
    cut c = {.m = m, .adjacency = adjacency, .out = out};
    int32_t edge = -1;
    mesh_clear(out);
    fram_status status = cut_begin(ctx, &c, normal, d, snap) ? FRAM_OK : FRAM_ERROR_MEMORY;
    if (status == FRAM_OK)
        status = mesh_rings_build(ctx, m, adjacency, c.above, &c.rings, &edge);
    if (status == FRAM_OK && !(add_crossings(ctx, &c) && add_faces_below(ctx, &c)))
        status = FRAM_ERROR_MEMORY;
    if (status == FRAM_OK)
        status = add_caps(ctx, &c);
    cut_free(ctx, &c);
    if (status != FRAM_OK)
        mesh_clear(out);
    if (edge >= 0)
        mesh_open_error(m, edge, error);
    return status == FRAM_ERROR_MEMORY ? error_memory(error) : status;
}
