/* Rims of holes, and polygons that close them; see mesh_repair.h. */
#include "geometry/ear_clip.h"
#include "geometry/mesh_edges.h"
#include "geometry/mesh_repair.h"
#include "geometry/point_grid.h"
#include "geometry/polygon_pieces.h"
#include "geometry/predicate.h"
#include "geometry/triangle_flip.h"

void mesh_rims_free(context *ctx, mesh_rims *r)
{
    array_free(ctx, &r->vertex);
    array_free(ctx, &r->start);
}

vec3 mesh_ring_area(const mesh *m, const int32_t *ring, int32_t count)
{
    vec3 sum = {0, 0, 0}, origin = count ? m->vertex.data[ring[0]] : sum;
    for (int32_t i = 2; i < count; i++)
        sum = vec3_add(
            sum, vec3_cross(vec3_sub(m->vertex.data[ring[i - 1]], origin), vec3_sub(m->vertex.data[ring[i]], origin)));
    return vec3_scale(sum, 0.5);
}

bool mesh_drop_unused_vertices(context *ctx, mesh *m)
{
    int32_t *place = memory_array(ctx, (size_t)m->vertex.count + 1, sizeof *place), kept = 0;
    if (!place)
        return false;
    for (int32_t f = 0; f < m->face.count; f++)
        for (int k = 0; k < 3; k++)
            place[m->face.data[f].v[k]] = 1;
    for (int32_t v = 0; v < m->vertex.count; v++)
        if (place[v]) {
            m->vertex.data[kept] = m->vertex.data[v];
            place[v] = kept++;
        }
    m->vertex.count = kept;
    for (int32_t f = 0; f < m->face.count; f++)
        for (int k = 0; k < 3; k++)
            m->face.data[f].v[k] = place[m->face.data[f].v[k]];
    memory_free(ctx, place);
    return true;
}

/* ---- rims ---- */

/* A walk along open edges, against their direction, as a cap would have it. */
typedef struct rim_walk {
    const mesh *m;
    int32_t *ending; /* of each vertex, the first open half-edge that ends in it and is not walked yet, or -1 */
    int32_t *next;   /* of each half-edge, the next one that ends in the same vertex */
    int32_t *place;  /* of each vertex on the path: its place there, or -1 */
    int32_array path;
    mesh_rims *out;
} rim_walk;

static bool list_open_edges(context *ctx, rim_walk *w)
{
    const mesh *m = w->m;
    size_t edges = 3 * (size_t)m->face.count + 1, vertices = (size_t)m->vertex.count + 1;
    w->ending = memory_array(ctx, vertices, sizeof *w->ending);
    w->place = memory_array(ctx, vertices, sizeof *w->place);
    w->next = memory_array(ctx, edges, sizeof *w->next);
    int32_array sorted = {0};
    bool done = w->ending && w->place && w->next && mesh_edges_sort(ctx, m, &sorted);
    for (int32_t v = 0; done && v < m->vertex.count; v++)
        w->ending[v] = w->place[v] = -1;
    /* From the back, so that lists begin with what comes first. */
    for (int32_t end = done ? sorted.count : 0, i; end > 0; end = i) {
        i = end - 1;
        while (i > 0 && same_edge(m, sorted.data[i - 1], sorted.data[end - 1]))
            i--;
        int32_t h = sorted.data[i];
        if (end - i > 1)
            continue;
        w->next[h] = w->ending[half_edge_to(m, h)];
        w->ending[half_edge_to(m, h)] = h;
    }
    array_free(ctx, &sorted);
    return done;
}

/* The part of the path from `from` on is a ring. */
static bool emit_ring(context *ctx, rim_walk *w, int32_t from)
{
    for (int32_t i = from; i < w->path.count; i++) {
        if (!array_push(ctx, &w->out->vertex, w->path.data[i]))
            return false;
        w->place[w->path.data[i]] = -1;
    }
    w->path.count = from;
    return array_push(ctx, &w->out->start, w->out->vertex.count);
}

static fram_status walk_from(context *ctx, rim_walk *w, int32_t v, int32_t *edge)
{
    int32_t last = -1;
    while (w->path.count || w->ending[v] >= 0) {
        if (w->place[v] >= 0) {
            if (!emit_ring(ctx, w, w->place[v]))
                return FRAM_ERROR_MEMORY;
            if (!w->path.count && w->ending[v] < 0)
                break;
        }
        int32_t h = w->ending[v];
        if (h < 0) {
            *edge = last;
            return FRAM_ERROR_INPUT;
        }
        w->place[v] = w->path.count;
        if (!array_push(ctx, &w->path, v))
            return FRAM_ERROR_MEMORY;
        w->ending[v] = w->next[h];
        v = half_edge_from(w->m, last = h);
    }
    return FRAM_OK;
}

fram_status mesh_rims_find(context *ctx, const mesh *m, mesh_rims *out, int32_t *edge)
{
    *edge = -1;
    array_clear(&out->vertex);
    array_clear(&out->start);
    rim_walk w = {.m = m, .out = out};
    fram_status status = list_open_edges(ctx, &w) && array_push(ctx, &out->start, 0) ? FRAM_OK : FRAM_ERROR_MEMORY;
    for (int32_t v = 0; v < m->vertex.count && status == FRAM_OK; v++)
        status = walk_from(ctx, &w, v, edge);
    memory_free(ctx, w.ending);
    memory_free(ctx, w.next);
    memory_free(ctx, w.place);
    array_free(ctx, &w.path);
    return status;
}

/* ---- polygons ---- */

/* The ring seen along its area vector, so that it is counter-clockwise. */
static bool see_ring(context *ctx, const mesh *m, const int32_t *ring, int32_t count, vec2_array *plan)
{
    vec3 n = mesh_ring_area(m, ring, count);
    double x = fabs(n.x), y = fabs(n.y), z = fabs(n.z);
    int drop = x >= y && x >= z ? 0 : y >= z ? 1 : 2;
    bool flip = (drop == 0 ? n.x : drop == 1 ? n.y : n.z) < 0;
    if (!array_resize(ctx, plan, count))
        return false;
    for (int32_t i = 0; i < count; i++) {
        vec3 p = m->vertex.data[ring[i]];
        vec2 q = drop == 0 ? (vec2){p.y, p.z} : drop == 1 ? (vec2){p.z, p.x} : (vec2){p.x, p.y};
        plan->data[i] = flip ? (vec2){-q.x, q.y} : q;
    }
    return true;
}

static bool is_fan_about(const vec2 *p, int32_t count, int32_t hub)
{
    for (int32_t i = 1; i + 1 < count; i++)
        if (orientation(p[hub], p[(hub + i) % count], p[(hub + i + 1) % count]) <= 0)
            return false;
    return true;
}

/* Where a fan may begin: of a quadrilateral the end of its shorter sound diagonal.  -1: nowhere. */
static int32_t fan_hub(const mesh *m, const int32_t *ring, int32_t count, const vec2 *p)
{
    bool first = is_fan_about(p, count, 0);
    if (count != 4)
        return first ? 0 : -1;
    bool second = is_fan_about(p, count, 1);
    const vec3 *v = m->vertex.data;
    bool shorter = vec3_length(vec3_sub(v[ring[3]], v[ring[1]])) < vec3_length(vec3_sub(v[ring[2]], v[ring[0]]));
    return second && (shorter || !first) ? 1 : first ? 0 : -1;
}

static fram_status add_ears(context *ctx, mesh *m, const int32_t *ring, const vec2_array *plan)
{
    polygon p = {plan->data, plan->count};
    index_array ears = {0};
    fram_status status = polygon_self_intersects(ctx, p, NULL, NULL) ? FRAM_ERROR_INPUT : FRAM_OK;
    if (status == FRAM_OK)
        status = polygon_triangulate_ears(ctx, p, &ears);
    if (status == FRAM_OK && !polygon_flip_diagonals(ctx, p, &ears))
        status = FRAM_ERROR_MEMORY;
    int32_t before = m->face.count;
    for (int32_t i = 0; i + 2 < ears.count && status == FRAM_OK; i += 3)
        if (!mesh_add_triangle(ctx, m, ring[ears.data[i]], ring[ears.data[i + 1]], ring[ears.data[i + 2]]))
            status = FRAM_ERROR_MEMORY;
    if (status != FRAM_OK)
        m->face.count = before;
    array_free(ctx, &ears);
    return status;
}

static fram_status add_fan(context *ctx, mesh *m, const int32_t *ring, int32_t count, int32_t hub)
{
    if (!array_reserve(ctx, &m->face, m->face.count + count - 2))
        return FRAM_ERROR_MEMORY;
    for (int32_t i = 1; i + 1 < count; i++)
        mesh_add_triangle(ctx, m, ring[hub], ring[(hub + i) % count], ring[(hub + i + 1) % count]);
    return FRAM_OK;
}

fram_status mesh_add_polygon(context *ctx, mesh *m, const int32_t *ring, int32_t count)
{
    if (count < 3)
        return FRAM_ERROR_INPUT;
    vec2_array plan = {0};
    fram_status status = see_ring(ctx, m, ring, count, &plan) ? FRAM_OK : FRAM_ERROR_MEMORY;
    int32_t hub = status == FRAM_OK ? fan_hub(m, ring, count, plan.data) : -1;
    if (status == FRAM_OK)
        status = hub >= 0 ? add_fan(ctx, m, ring, count, hub) : add_ears(ctx, m, ring, &plan);
    array_free(ctx, &plan);
    return status;
}

/* ---- raising an open top ---- */

/* The deck while it is made: rims as raised rings in plan, and which vertex is where. */
typedef struct raising {
    mesh *m;
    const mesh_rims *rims;
    double deck;          /* z */
    int32_t first_raised; /* vertex above rims->vertex[0] */
    polygon_list plan;
    polygon_list group, pieces;
    point_grid grid;
    int32_array at; /* vertex of each point of the grid */
    int32_array ring;
} raising;

static bool raise_vertices(context *ctx, raising *r, double height)
{
    mesh *m = r->m;
    r->first_raised = m->vertex.count;
    r->deck = m->vertex.data[r->rims->vertex.data[0]].z + height;
    vec2_array ring = {0};
    bool done = true;
    for (int32_t i = 0; done && i < mesh_rims_count(r->rims); i++) {
        array_clear(&ring);
        for (int32_t k = r->rims->start.data[i]; done && k < r->rims->start.data[i + 1]; k++) {
            vec3 p = m->vertex.data[r->rims->vertex.data[k]];
            done = mesh_add_vertex(ctx, m, vec3_make(p.x, p.y, r->deck)) && array_push(ctx, &ring, vec2_make(p.x, p.y));
        }
        done = done && polygon_list_push(ctx, &r->plan, (polygon){ring.data, ring.count});
    }
    array_free(ctx, &ring);
    return done;
}

/* Sides between a rim, which runs as a cap would, and its raised copy. */
static bool add_sides(context *ctx, raising *r)
{
    const int32_t *v = r->rims->vertex.data;
    for (int32_t i = 0; i < mesh_rims_count(r->rims); i++) {
        int32_t begin = r->rims->start.data[i], end = r->rims->start.data[i + 1];
        for (int32_t k = begin; k < end; k++) {
            int32_t next = k + 1 < end ? k + 1 : begin, up = r->first_raised;
            if (!mesh_add_triangle(ctx, r->m, v[k], v[next], up + next) ||
                !mesh_add_triangle(ctx, r->m, v[k], up + next, up + k))
                return false;
        }
    }
    return true;
}

/* Every deck vertex under its plan coordinates. */
static bool index_deck(context *ctx, raising *r)
{
    bool done = point_grid_init(ctx, &r->grid, mesh_bounds(r->m), 0, r->rims->vertex.count);
    for (int32_t v = r->first_raised; done && v < r->m->vertex.count; v++) {
        vec3 p = r->m->vertex.data[v];
        if (point_grid_find(&r->grid, p) < 0)
            done = point_grid_add(ctx, &r->grid, p) && array_push(ctx, &r->at, v);
    }
    return done;
}

static fram_status add_deck_ring(context *ctx, raising *r, polygon p)
{
    if (!array_resize(ctx, &r->ring, p.count))
        return FRAM_ERROR_MEMORY;
    for (int32_t i = 0; i < p.count; i++) {
        int32_t point = point_grid_find(&r->grid, vec3_make(p.vertex[i].x, p.vertex[i].y, r->deck));
        if (point < 0)
            return FRAM_ERROR_INPUT;
        r->ring.data[i] = r->at.data[point];
    }
    return mesh_add_polygon(ctx, r->m, r->ring.data, r->ring.count);
}

/* Outline i with the wells in it. */
static fram_status add_deck_part(context *ctx, raising *r, int32_t i)
{
    polygon outline = polygon_list_get(&r->plan, i);
    polygon_list_clear(&r->group);
    polygon_list_clear(&r->pieces);
    bool done = polygon_list_push(ctx, &r->group, outline);
    for (int32_t j = 0; done && j < polygon_list_count(&r->plan); j++) {
        polygon well = polygon_list_get(&r->plan, j);
        if (polygon_area(well) < 0 && polygon_contains(outline, well.vertex[0]))
            done = polygon_list_push(ctx, &r->group, well);
    }
    if (!done)
        return FRAM_ERROR_MEMORY;
    if (polygon_list_count(&r->group) == 1)
        return add_deck_ring(ctx, r, outline);
    fram_status status = polygon_cut_holes(ctx, &r->group, &r->pieces);
    for (int32_t j = 0; j < polygon_list_count(&r->pieces) && status == FRAM_OK; j++)
        status = add_deck_ring(ctx, r, polygon_list_get(&r->pieces, j));
    return status;
}

static fram_status make_deck(context *ctx, raising *r, double height)
{
    if (!raise_vertices(ctx, r, height) || !add_sides(ctx, r) || !index_deck(ctx, r))
        return FRAM_ERROR_MEMORY;
    fram_status status = FRAM_OK;
    for (int32_t i = 0; i < polygon_list_count(&r->plan) && status == FRAM_OK; i++)
        if (polygon_area(polygon_list_get(&r->plan, i)) > 0)
            status = add_deck_part(ctx, r, i);
    return status;
}

fram_status mesh_raise_top(context *ctx, mesh *m, const mesh_rims *rims, double height, fram_error *error)
{
    if (mesh_rims_count(rims) == 0)
        return FRAM_OK;
    raising r = {.m = m, .rims = rims};
    fram_status status = make_deck(ctx, &r, height);
    polygon_list_free(ctx, &r.plan);
    polygon_list_free(ctx, &r.group);
    polygon_list_free(ctx, &r.pieces);
    point_grid_free(ctx, &r.grid);
    array_free(ctx, &r.at);
    array_free(ctx, &r.ring);
    if (status == FRAM_ERROR_INPUT) {
        vec3 p = m->vertex.data[rims->vertex.data[0]];
        return error_set(
            error, status, NULL, 0, NULL,
            "the open top at z = %g m (a rim begins at x = %g, y = %g) crosses itself: no deck can close it", p.z, p.x,
            p.y);
    }
    return status == FRAM_ERROR_MEMORY ? error_memory(error) : status;
}
