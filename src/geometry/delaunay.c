/* Half edges of a triangulation, and flips until it is Delaunay; see polygon_pieces.h.

   Half edge h = 3 t + k runs from corner k of triangle t to the next one, with the triangle to its left. */
#include "geometry/mesh_edges.h"
#include "geometry/polygon_pieces.h"
#include "geometry/predicate.h"

/* Relative error of the plain determinant, (10 + 96 u) u with u = 2^-53 (Shewchuk 1997, section 4.3). */
#define CIRCLE_FILTER 1.1102230246251577e-15

bool triangles_find_twins(context *ctx, const index_array *t, int32_t vertex_count, int32_array *twin)
{
    mesh view = {.vertex.count = vertex_count};
    int32_array sorted = {0};
    bool done = array_resize(ctx, twin, t->count) && array_resize(ctx, &view.face, t->count / 3);
    for (int32_t i = 0; done && i < t->count; i++) {
        view.face.data[i / 3].v[i % 3] = t->data[i];
        twin->data[i] = -1;
    }
    done = done && mesh_edges_sort(ctx, &view, &sorted);
    for (int32_t i = 0; done && i < sorted.count;) {
        int32_t end = mesh_edges_end(&view, &sorted, i);
        if (end - i == 2) {
            twin->data[sorted.data[i]] = sorted.data[i + 1];
            twin->data[sorted.data[i + 1]] = sorted.data[i];
        }
        i = end;
    }
    array_free(ctx, &view.face);
    array_free(ctx, &sorted);
    return done;
}

static int32_t next_half(int32_t h) { return h % 3 == 2 ? h - 2 : h + 1; }
static int32_t previous_half(int32_t h) { return h % 3 == 0 ? h + 2 : h - 1; }

/* d is inside the circle through a, b, c (counter-clockwise) beyond doubt: so that no edge is flipped to and fro. */
static bool surely_in_circle(vec2 a, vec2 b, vec2 c, vec2 d)
{
    vec2 p = vec2_sub(a, d), q = vec2_sub(b, d), r = vec2_sub(c, d);
    double p_lift = vec2_dot(p, p), q_lift = vec2_dot(q, q), r_lift = vec2_dot(r, r);
    double det = p_lift * vec2_cross(q, r) + q_lift * vec2_cross(r, p) + r_lift * vec2_cross(p, q);
    double size = p_lift * (fabs(q.x * r.y) + fabs(q.y * r.x)) + q_lift * (fabs(r.x * p.y) + fabs(r.y * p.x)) +
                  r_lift * (fabs(p.x * q.y) + fabs(p.y * q.x));
    return det > CIRCLE_FILTER * size;
}

typedef struct flipping {
    context *ctx;
    const vec2 *vertex;
    int32_t *corner; /* per half edge: the vertex where it begins */
    int32_array twin, todo;
} flipping;

static vec2 at(const flipping *f, int32_t h) { return f->vertex[f->corner[h]]; }

static void link_twins(flipping *f, int32_t h, int32_t twin)
{
    f->twin.data[h] = twin;
    if (twin >= 0)
        f->twin.data[twin] = h;
}

/* The edge is not Delaunay, and its other diagonal is inside the two triangles. */
static bool should_flip(const flipping *f, int32_t h)
{
    int32_t twin = f->twin.data[h];
    if (twin < 0)
        return false;
    vec2 a = at(f, h), b = at(f, twin), left = at(f, previous_half(h)), right = at(f, previous_half(twin));
    return surely_in_circle(a, b, left, right) && orientation(a, right, left) > 0 && orientation(right, b, left) > 0;
}

/* Replace the edge of h by the other diagonal: the triangles (a, b, left) and (b, a, right) become (right, b, left) and
   (left, a, right).  False when there is no memory for what is to be looked at again. */
static bool flip_edge(flipping *f, int32_t h)
{
    int32_t twin = f->twin.data[h], h_previous = previous_half(h), twin_previous = previous_half(twin);
    f->corner[h] = f->corner[twin_previous];
    f->corner[twin] = f->corner[h_previous];
    link_twins(f, h, f->twin.data[twin_previous]);
    link_twins(f, twin, f->twin.data[h_previous]);
    link_twins(f, h_previous, twin_previous);
    return array_push(f->ctx, &f->todo, h) && array_push(f->ctx, &f->todo, next_half(h)) &&
           array_push(f->ctx, &f->todo, twin) && array_push(f->ctx, &f->todo, next_half(twin));
}

bool triangles_make_delaunay(context *ctx, const vec2 *vertex, int32_t vertex_count, index_array *t)
{
    flipping f = {.ctx = ctx, .vertex = vertex, .corner = t->data};
    bool done = triangles_find_twins(ctx, t, vertex_count, &f.twin) && array_resize(ctx, &f.todo, t->count);
    for (int32_t h = 0; done && h < t->count; h++)
        f.todo.data[h] = h;
    while (done && f.todo.count > 0) {
        int32_t h = f.todo.data[--f.todo.count];
        done = !should_flip(&f, h) || flip_edge(&f, h);
    }
    array_free(ctx, &f.twin);
    array_free(ctx, &f.todo);
    return done;
}
