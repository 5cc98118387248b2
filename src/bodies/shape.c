/* The shape store: outlines and their convex pieces in pooled tables, solids beside them.  Knows no bodies. */
#include "bodies/shape.h"

#include "geometry/predicate.h"

#include <assert.h>
#include <stdlib.h>
#include <string.h>

#define TABLE_SELF shape_table
TABLE_DEFINE(shape, SHAPE_FIELDS)
#undef TABLE_SELF
#define TABLE_SELF piece_table
TABLE_DEFINE(piece, PIECE_FIELDS)
#undef TABLE_SELF
#define TABLE_SELF shape_vertex_table
TABLE_DEFINE(shape_vertex, SHAPE_VERTEX_FIELDS)
#undef TABLE_SELF

void shape_store_free(context *ctx, shape_store *s)
{
    table_free(ctx, &s->shapes, &shape_table_info);
    table_free(ctx, &s->pieces, &piece_table_info);
    table_free(ctx, &s->vertices, &shape_vertex_table_info);
}

void solid_array_free(context *ctx, solid_array *solids)
{
    for (int32_t i = 0; i < solids->count; i++) {
        solid *body = &solids->data[i];
        mesh_free(ctx, &body->surface);
        mesh_adjacency_free(ctx, &body->adjacency);
        mesh_bvh_free(ctx, &body->tree);
        mesh_integrals_free(ctx, &body->integrals);
        polyhedron_array_free(ctx, &body->pieces);
    }
    array_free(ctx, solids);
}

/* ---- convex pieces ---- */

/* Cut a convex ring into convex rings of at most PIECE_MOST_VERTICES vertices by chords. */
static bool cut_convex(context *ctx, polygon ring, polygon_list *pieces)
{
    vec2_array rest = {0};
    bool ok = array_resize(ctx, &rest, ring.count);
    if (ok)
        memcpy(rest.data, ring.vertex, (size_t)ring.count * sizeof *ring.vertex);
    while (ok && rest.count > PIECE_MOST_VERTICES) {
        ok = polygon_list_push(ctx, pieces, (polygon){rest.data, PIECE_MOST_VERTICES});
        /* What is left: the first vertex, and all from the last one of the piece on. */
        int32_t left = rest.count - PIECE_MOST_VERTICES + 1;
        memmove(rest.data + 1, rest.data + PIECE_MOST_VERTICES - 1, (size_t)left * sizeof *rest.data);
        rest.count = left + 1;
    }
    ok = ok && polygon_list_push(ctx, pieces, (polygon){rest.data, rest.count});
    array_free(ctx, &rest);
    return ok;
}

static fram_status cut_outline(context *ctx, overlay *o, polygon outline, double area_limit, polygon_list *pieces,
                               fram_error *error)
{
    if (polygon_is_convex(outline))
        return cut_convex(ctx, outline, pieces) ? FRAM_OK : error_memory(error);
    if (!o)
        return error_set(error, FRAM_ERROR_INPUT, NULL, 0, NULL,
                         "a concave outline of %d vertices needs an overlay to be cut into convex pieces",
                         (int)outline.count);
    fram_status status = overlay_convex_pieces(o, outline, area_limit, PIECE_MOST_VERTICES, pieces, NULL, error);
    if (status == FRAM_OK && polygon_list_count(pieces) == 0)
        return error_set(error, FRAM_ERROR_INPUT, NULL, 0, NULL,
                         "no convex piece of an outline of %d vertices is larger than %g m2", (int)outline.count,
                         area_limit);
    return status;
}

typedef struct directed_edge {
    vec2 from, to;
} directed_edge;

static int compare_edges(const void *a, const void *b)
{
    const directed_edge *x = a, *y = b;
    int order = vec2_compare(x->from, y->from);
    return order ? order : vec2_compare(x->to, y->to);
}

/* inner[i]: bit k is set when edge k of piece i is a seam, that is, when some piece has the same edge the other way
   round.  An edge that faces a dropped triangle is therefore an outer one. */
static bool find_seams(context *ctx, const polygon_list *pieces, uint64_t *inner)
{
    int32_t count = polygon_list_count(pieces), edge_count = pieces->vertex.count, next = 0;
    directed_edge *edge = memory_array(ctx, (size_t)edge_count, sizeof *edge);
    if (!edge)
        return false;
    for (int32_t i = 0; i < count; i++) {
        polygon p = polygon_list_get(pieces, i);
        for (int32_t k = 0; k < p.count; k++)
            edge[next++] = (directed_edge){p.vertex[k], p.vertex[k + 1 < p.count ? k + 1 : 0]};
    }
    qsort(edge, (size_t)edge_count, sizeof *edge, compare_edges);
    for (int32_t i = 0; i < count; i++) {
        polygon p = polygon_list_get(pieces, i);
        inner[i] = 0;
        for (int32_t k = 0; k < p.count; k++) {
            directed_edge back = {p.vertex[k + 1 < p.count ? k + 1 : 0], p.vertex[k]};
            if (bsearch(&back, edge, (size_t)edge_count, sizeof *edge, compare_edges))
                inner[i] |= (uint64_t)1 << k;
        }
    }
    memory_free(ctx, edge);
    return true;
}

typedef struct outline_corner {
    vec2 point;
    int32_t index;
} outline_corner;

static int compare_corners(const void *a, const void *b)
{
    return vec2_compare(((const outline_corner *)a)->point, ((const outline_corner *)b)->point);
}

/* For every vertex of the pieces its index in the outline, -1 without one. */
static bool find_corners(context *ctx, polygon outline, const vec2_array *vertex, int32_t *corner)
{
    outline_corner *sorted = memory_array(ctx, (size_t)outline.count, sizeof *sorted);
    if (!sorted)
        return false;
    for (int32_t i = 0; i < outline.count; i++)
        sorted[i] = (outline_corner){outline.vertex[i], i};
    qsort(sorted, (size_t)outline.count, sizeof *sorted, compare_corners);
    for (int32_t i = 0; i < vertex->count; i++) {
        outline_corner key = {vertex->data[i], 0};
        const outline_corner *found = bsearch(&key, sorted, (size_t)outline.count, sizeof key, compare_corners);
        corner[i] = found ? found->index : -1;
    }
    memory_free(ctx, sorted);
    return true;
}

/* ---- rows ---- */

/* The lowest free row, or one more, which the caller gives a kind; -1 without memory. */
static int32_t shape_row(context *ctx, shape_store *s)
{
    static_assert(SHAPE_NONE == 0, "a free row");
    shape_table *t = &s->shapes;
    int32_t row = table_first_zero(t, t->kind);
    if (row == t->count && !table_resize(ctx, t, &shape_table_info, row + 1))
        return -1;
    table_row_taken(t, row);
    return row;
}

/* Unit outward normal of the side from vertex i; at a repeated vertex that of the next side. */
static vec2 side_normal(polygon ring, int32_t i)
{
    for (int32_t k = i; k < i + ring.count; k++) {
        vec2 e = vec2_sub(ring.vertex[(k + 1) % ring.count], ring.vertex[k % ring.count]);
        double length = vec2_length(e);
        if (length > 0)
            return vec2_make(e.y / length, -e.x / length);
    }
    return vec2_make(0, 0);
}

/* A ring at the end of the vertex pool; corner NULL: it is the outline. */
static void append_ring(shape_store *s, polygon ring, const int32_t *corner)
{
    shape_vertex_table *v = &s->vertices;
    for (int32_t i = 0; i < ring.count; i++) {
        v->point[v->count] = ring.vertex[i];
        v->side[v->count] = side_normal(ring, i);
        v->corner[v->count++] = corner ? corner[i] : i;
    }
}

/* A single piece is the outline itself and shares its vertices, unless a triangle was dropped: then it has fewer. */
static bool pieces_are_outline(int32_t piece_count, int32_t first_size, int32_t outline_count)
{
    return piece_count == 1 && first_size == outline_count;
}

static int32_t vertices_of_pieces(const shape_store *s, int32_t row)
{
    int32_t sum = 0, first = s->shapes.piece_first[row], count = s->shapes.piece_count[row];
    if (count == 0 || pieces_are_outline(count, s->pieces.size[first], s->shapes.outline_count[row]))
        return 0;
    for (int32_t i = first; i < first + count; i++)
        sum += s->pieces.size[i];
    return sum;
}

/* Adds what a prism has in the pools `times` times. */
static void count_prism(shape_store *s, int32_t row, int32_t times)
{
    if (!s->is_counted || s->shapes.kind[row] != SHAPE_PRISM)
        return;
    s->live_vertices += times * (s->shapes.outline_count[row] + vertices_of_pieces(s, row));
    s->live_pieces += times * s->shapes.piece_count[row];
}

static void count_all(shape_store *s)
{
    s->is_counted = true;
    s->live_vertices = s->live_pieces = 0;
    for (int32_t i = 0; i < s->shapes.count; i++)
        count_prism(s, i, 1);
}

#ifndef NDEBUG
static bool count_is_right(const shape_store *s)
{
    shape_store again = *s;
    count_all(&again);
    return again.live_vertices == s->live_vertices && again.live_pieces == s->live_pieces;
}
#endif

#ifndef NDEBUG
/* Areas are sums of products of coordinates: what rounding may add to the pieces of an outline, as a part of it. */
static const double SAME_AREA = 1e-9;

/* Pieces have 3 to PIECE_MOST_VERTICES vertices in the pool, and together no more area than the outline. */
static bool prism_is_sound(const shape_store *s, int32_t row)
{
    double outline = polygon_area(shape_outline(s, row)), sum = 0;
    for (int32_t i = 0; i < s->shapes.piece_count[row]; i++) {
        polygon p = shape_piece(s, row, i);
        if (p.count < 3 || p.count > PIECE_MOST_VERTICES || p.vertex + p.count > s->vertices.point + s->vertices.count)
            return false;
        sum += polygon_area(p);
    }
    return s->shapes.piece_count[row] > 0 && outline > 0 && sum <= (1 + SAME_AREA) * outline;
}
#endif

/* Everything is reserved before anything is written, so that a failure leaves the store as it was. */
static fram_status store_prism(context *ctx, shape_store *s, polygon outline, double half_height,
                               const polygon_list *pieces, int32_t *row, fram_error *error)
{
    int32_t piece_count = polygon_list_count(pieces), first = s->vertices.count, piece_first = s->pieces.count;
    bool shared = pieces_are_outline(piece_count, polygon_list_get(pieces, 0).count, outline.count);
    int32_t extra = shared ? 0 : pieces->vertex.count;
    uint64_t *inner = memory_array(ctx, (size_t)piece_count, sizeof *inner);
    int32_t *corner = memory_array(ctx, (size_t)pieces->vertex.count, sizeof *corner);
    bool ok = inner && corner && find_seams(ctx, pieces, inner) &&
              find_corners(ctx, outline, &pieces->vertex, corner) &&
              table_reserve(ctx, &s->vertices, &shape_vertex_table_info, first + outline.count + extra) &&
              table_reserve(ctx, &s->pieces, &piece_table_info, piece_first + piece_count);
    *row = ok ? shape_row(ctx, s) : -1;
    if (*row >= 0) {
        append_ring(s, outline, NULL);
        for (int32_t i = 0; i < piece_count; i++) {
            int32_t at = s->pieces.count++, begin = pieces->start.data[i];
            polygon p = polygon_list_get(pieces, i);
            s->pieces.first[at] = shared ? first : s->vertices.count;
            s->pieces.size[at] = p.count;
            s->pieces.inner_edges[at] = inner[i];
            if (!shared)
                append_ring(s, p, corner + begin);
        }
        double plan_square = 0;
        for (int32_t i = 0; i < outline.count; i++)
            plan_square = real_max(plan_square, vec2_dot(outline.vertex[i], outline.vertex[i]));
        shape_table *t = &s->shapes;
        t->kind[*row] = SHAPE_PRISM;
        t->half_height[*row] = half_height;
        t->radius[*row] = sqrt(plan_square + half_height * half_height);
        t->plan_radius[*row] = sqrt(plan_square);
        t->area[*row] = polygon_area(outline);
        t->outline_first[*row] = first;
        t->outline_count[*row] = outline.count;
        t->piece_first[*row] = piece_first;
        t->piece_count[*row] = piece_count;
        t->solid[*row] = -1;
        s->changes++;
        count_prism(s, *row, 1);
        assert(prism_is_sound(s, *row));
    }
    memory_free(ctx, inner);
    memory_free(ctx, corner);
    return *row >= 0 ? FRAM_OK : error_memory(error);
}

static fram_status check_prism(polygon outline, double half_height, fram_error *error)
{
    double area = outline.count >= 3 ? polygon_area(outline) : 0;
    if (!(area > 0) || !isfinite(area))
        return error_set(error, FRAM_ERROR_INPUT, NULL, 0, NULL,
                         "an outline needs 3 vertices or more, counter-clockwise around a finite area; found %d "
                         "vertices and %g m2",
                         (int)outline.count, area);
    if (!(half_height > 0) || !isfinite(half_height))
        return error_set(error, FRAM_ERROR_INPUT, NULL, 0, NULL, "a prism needs a positive thickness, found %g m",
                         2 * half_height);
    return FRAM_OK;
}

fram_status shape_add_prism(context *ctx, shape_store *s, overlay *o, polygon outline, double half_height,
                            double piece_area_limit, int32_t *row, fram_error *error)
{
    *row = -1;
    fram_status status = check_prism(outline, half_height, error);
    if (status != FRAM_OK)
        return status;
    /* A copy: the outline may lie in the pools that are about to grow. */
    polygon_list copy = {0}, pieces = {0};
    if (polygon_list_push(ctx, &copy, outline)) {
        outline = polygon_list_get(&copy, 0);
        status = cut_outline(ctx, o, outline, piece_area_limit, &pieces, error);
        if (status == FRAM_OK)
            status = store_prism(ctx, s, outline, half_height, &pieces, row, error);
    } else {
        status = error_memory(error);
    }
    polygon_list_free(ctx, &copy);
    polygon_list_free(ctx, &pieces);
    return status;
}

fram_status shape_add_solid(context *ctx, shape_store *s, int32_t solid_index, int32_t *row, fram_error *error)
{
    *row = -1;
    int32_t solids = s->solids ? s->solids->count : 0;
    if (solid_index < 0 || solid_index >= solids)
        return error_set(error, FRAM_ERROR_USAGE, NULL, 0, NULL, "there is no solid %d; the store has %d",
                         (int)solid_index, (int)solids);
    *row = shape_row(ctx, s);
    if (*row < 0)
        return error_memory(error);
    s->shapes.kind[*row] = SHAPE_SOLID;
    s->shapes.radius[*row] = s->solids->data[solid_index].radius;
    s->shapes.solid[*row] = solid_index;
    s->changes++;
    return FRAM_OK;
}

fram_status solid_add(context *ctx, solid_array *solids, mesh *surface, polyhedron_array *pieces, double concavity,
                      int32_t *index, fram_error *error)
{
    *index = -1;
    if (surface->face.count == 0)
        return error_set(error, FRAM_ERROR_INPUT, NULL, 0, NULL, "a solid needs a closed surface; this one is empty");
    solid made = {.concavity = concavity};
    double square = 0;
    for (int32_t i = 0; i < surface->vertex.count; i++)
        square = real_max(square, vec3_dot(surface->vertex.data[i], surface->vertex.data[i]));
    made.radius = sqrt(square);
    if (!array_reserve(ctx, solids, solids->count + 1))
        return error_memory(error);
    fram_status status = mesh_adjacency_build(ctx, surface, &made.adjacency);
    if (status == FRAM_OK)
        status = mesh_bvh_build(ctx, surface, &made.tree);
    if (status == FRAM_OK && !mesh_integrals_build(ctx, surface, &made.tree, &made.integrals))
        status = FRAM_ERROR_MEMORY;
    if (status != FRAM_OK) {
        mesh_adjacency_free(ctx, &made.adjacency);
        mesh_bvh_free(ctx, &made.tree);
        return status == FRAM_ERROR_MEMORY
                   ? error_memory(error)
                   : error_set(error, status, NULL, 0, NULL, "the surface of a solid of %d triangles is no valid mesh",
                               (int)surface->face.count);
    }
    made.surface = *surface;
    made.pieces = *pieces;
    *surface = (mesh){0};
    *pieces = (polyhedron_array){0};
    *index = solids->count;
    solids->data[solids->count++] = made;
    return FRAM_OK;
}

void shape_remove(shape_store *s, int32_t row)
{
    assert(row >= 0 && row < s->shapes.count);
    count_prism(s, row, -1);
    for (int f = 0; f < shape_table_info.field_count; f++) {
        const field_info *field = &shape_table_info.fields[f];
        memset((char *)table_field(&s->shapes, field) + field->size * (size_t)row, 0, field->size);
    }
    table_row_freed(&s->shapes, row);
    s->changes++;
}

/* ---- compaction ---- */

/* Copies one shape's vertices and pieces behind what the new pools hold, and points the shape there. */
static void move_shape(shape_store *s, int32_t row, shape_vertex_table *vertices, piece_table *pieces)
{
    shape_table *t = &s->shapes;
    /* A shape's vertices are one block: the outline, then those of the pieces unless they are the outline. */
    int32_t count = t->outline_count[row] + vertices_of_pieces(s, row), from = t->outline_first[row];
    int32_t shift = vertices->count - from;
    memcpy(vertices->point + vertices->count, s->vertices.point + from, (size_t)count * sizeof *vertices->point);
    memcpy(vertices->side + vertices->count, s->vertices.side + from, (size_t)count * sizeof *vertices->side);
    memcpy(vertices->corner + vertices->count, s->vertices.corner + from, (size_t)count * sizeof *vertices->corner);
    vertices->count += count;
    t->outline_first[row] += shift;
    int32_t piece_from = t->piece_first[row];
    t->piece_first[row] = pieces->count;
    for (int32_t i = piece_from; i < piece_from + t->piece_count[row]; i++) {
        pieces->first[pieces->count] = s->pieces.first[i] + shift;
        pieces->size[pieces->count] = s->pieces.size[i];
        pieces->inner_edges[pieces->count++] = s->pieces.inner_edges[i];
    }
}

/* The pools are squeezed when there are more dead than one in so many living.  A smaller number lets memory lie idle, a
   larger one copies the living more often. */
enum { DEAD_SHARE = 4 };

fram_status shape_compact(context *ctx, shape_store *s)
{
    if (!s->is_counted)
        count_all(s);
    assert(count_is_right(s));
    int32_t live_vertices = s->live_vertices, live_pieces = s->live_pieces;
    if (DEAD_SHARE * (int64_t)(s->vertices.count - live_vertices) <= live_vertices)
        return FRAM_OK;
    shape_vertex_table vertices = {0};
    piece_table pieces = {0};
    if (!table_reserve(ctx, &vertices, &shape_vertex_table_info, live_vertices) ||
        !table_reserve(ctx, &pieces, &piece_table_info, live_pieces)) {
        table_free(ctx, &vertices, &shape_vertex_table_info);
        return FRAM_ERROR_MEMORY;
    }
    for (int32_t i = 0; i < s->shapes.count; i++)
        if (s->shapes.kind[i] == SHAPE_PRISM)
            move_shape(s, i, &vertices, &pieces);
    table_free(ctx, &s->vertices, &shape_vertex_table_info);
    table_free(ctx, &s->pieces, &piece_table_info);
    s->vertices = vertices;
    s->pieces = pieces;
    assert(vertices.count == live_vertices && pieces.count == live_pieces);
    return FRAM_OK;
}

const solid *shape_solid(const shape_store *s, int32_t row) { return &s->solids->data[s->shapes.solid[row]]; }

polygon shape_outline(const shape_store *s, int32_t row)
{
    return (polygon){s->vertices.point + s->shapes.outline_first[row], s->shapes.outline_count[row]};
}

polygon shape_piece(const shape_store *s, int32_t row, int32_t piece)
{
    assert(piece >= 0 && piece < s->shapes.piece_count[row]);
    int32_t at = s->shapes.piece_first[row] + piece;
    return (polygon){s->vertices.point + s->pieces.first[at], s->pieces.size[at]};
}
