#include "ice/prism_faces.h"

#include "geometry/predicate.h"

enum { MOST = PRISM_FACE_MOST_CORNERS };

void prism_faces_free(context *ctx, prism_faces *f)
{
    array_free(ctx, &f->first);
    array_free(ctx, &f->corner);
    array_free(ctx, &f->neighbour);
}

/* A convex ring of vertices of one level, while it grows. */
typedef struct ring {
    int32_t corner[MOST];
    int32_t count;
} ring;

static vec2 vertex_plan(const mesh *m, int32_t vertex)
{
    return (vec2){m->vertex.data[vertex].x, m->vertex.data[vertex].y};
}

static bool turns_left(const mesh *m, int32_t a, int32_t b, int32_t c)
{
    return orientation(vertex_plan(m, a), vertex_plan(m, b), vertex_plan(m, c)) >= 0;
}

/* Joins a triangle of the top lid to the ring, where they have an edge in common and stay convex together. */
static bool join_triangle(const mesh *m, const int32_t v[3], ring *r)
{
    for (int32_t i = 0; i < r->count && r->count < MOST; i++) {
        int32_t j = i + 1 < r->count ? i + 1 : 0;
        int32_t before = r->corner[i > 0 ? i - 1 : r->count - 1], after = r->corner[j + 1 < r->count ? j + 1 : 0];
        for (int k = 0; k < 3; k++) {
            int32_t apex = v[(k + 2) % 3];
            if (v[k] != r->corner[j] || v[(k + 1) % 3] != r->corner[i])
                continue;
            if (!turns_left(m, before, r->corner[i], apex) || !turns_left(m, apex, r->corner[j], after))
                return false;
            for (int32_t l = r->count++; l > i + 1; l--)
                r->corner[l] = r->corner[l - 1];
            r->corner[i + 1] = apex;
            return true;
        }
    }
    return false;
}

static bool add_face(context *ctx, prism_faces *f, const int32_t *corner, int32_t count)
{
    for (int32_t i = 0; i < count; i++)
        if (!array_push(ctx, &f->corner, corner[i]))
            return false;
    return array_push(ctx, &f->first, f->corner.count);
}

/* A ring of the top, and the same of the bottom, n vertices below. */
static bool add_lids(context *ctx, prism_faces *f, const ring *top, int32_t n)
{
    int32_t bottom[MOST];
    for (int32_t i = 0; i < top->count; i++)
        bottom[i] = top->corner[top->count - 1 - i] - n;
    return add_face(ctx, f, bottom, top->count) && add_face(ctx, f, top->corner, top->count);
}

/* Lids from their triangles, which the mesh has first, bottom and top in turn. */
static bool make_lids(context *ctx, const mesh *m, int32_t n, prism_faces *f)
{
    int32_t triangles = n - 2, left = triangles;
    int32_array used = {0};
    bool ok = array_resize(ctx, &used, triangles);
    for (int32_t i = 0; i < triangles && ok; i++)
        used.data[i] = 0;
    for (int32_t seed = 0; seed < triangles && left > 0 && ok; seed++) {
        if (used.data[seed])
            continue;
        const int32_t *v = m->face.data[2 * seed + 1].v;
        ring r = {{v[0], v[1], v[2]}, 3};
        used.data[seed] = 1;
        left--;
        for (int32_t i = seed + 1; i < triangles; i++) {
            if (used.data[i] || !join_triangle(m, m->face.data[2 * i + 1].v, &r))
                continue;
            used.data[i] = 1;
            left--;
            i = seed; /* what had no edge in common may have one now */
        }
        ok = add_lids(ctx, f, &r, n);
    }
    array_free(ctx, &used);
    return ok;
}

static bool make_sides(context *ctx, int32_t n, prism_faces *f)
{
    for (int32_t i = 0; i < n; i++) {
        int32_t j = i + 1 < n ? i + 1 : 0;
        const int32_t corner[4] = {i, j, n + j, n + i};
        if (!add_face(ctx, f, corner, 4))
            return false;
    }
    return true;
}

/* The face with the edge from b to a. */
static int32_t face_with_edge(const prism_faces *f, int32_t b, int32_t a)
{
    for (int32_t face = 0; face < prism_faces_count(f); face++) {
        int32_t first = f->first.data[face], end = f->first.data[face + 1];
        for (int32_t i = first; i < end; i++)
            if (f->corner.data[i] == b && f->corner.data[i + 1 < end ? i + 1 : first] == a)
                return face;
    }
    return -1;
}

static bool find_face_neighbours(context *ctx, prism_faces *f)
{
    if (!array_resize(ctx, &f->neighbour, f->corner.count))
        return false;
    for (int32_t face = 0; face < prism_faces_count(f); face++) {
        int32_t first = f->first.data[face], end = f->first.data[face + 1];
        for (int32_t i = first; i < end; i++)
            f->neighbour.data[i] = face_with_edge(f, f->corner.data[i + 1 < end ? i + 1 : first], f->corner.data[i]);
    }
    return true;
}

bool prism_faces_make(context *ctx, const mesh *surface, prism_faces *out)
{
    int32_t n = surface->vertex.count / 2;
    array_clear(&out->first);
    array_clear(&out->corner);
    return array_push(ctx, &out->first, 0) && make_lids(ctx, surface, n, out) && make_sides(ctx, n, out) &&
           find_face_neighbours(ctx, out);
}
