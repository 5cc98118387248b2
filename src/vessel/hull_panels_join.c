/* Facets to panels: those of a cell that are connected, and slivers to their neighbours. */
#include "vessel/hull_panels_parts.h"

#include <stdlib.h>

/* A panel with less than this part of a whole one is a sliver: a force on it would be any pressure. */
static const double SLIVER = 0.25;
/* A border counts as shared where its middle lies so near to the other facet, in panel sides. */
static const double SHARED = 1e-6;

static bool index_faces(panel_work *w)
{
    int32_t faces = w->hull->face.count;
    if (!array_resize(w->ctx, &w->first_of_face, faces + 1) || !array_resize(w->ctx, &w->by_face, w->facet.count))
        return false;
    int32_t *first = w->first_of_face.data;
    for (int32_t f = 0; f <= faces; f++)
        first[f] = 0;
    for (int32_t i = 0; i < w->facet.count; i++)
        first[w->facet.data[i].face]++;
    for (int32_t f = 0, sum = 0; f <= faces; f++) {
        sum += first[f];
        first[f] = sum;
    }
    for (int32_t i = w->facet.count - 1; i >= 0; i--)
        w->by_face.data[--first[w->facet.data[i].face]] = i;
    return true;
}

static void join_facets(panel_work *w, int32_t i, int32_t k)
{
    int32_t a = facet_root(w, i), b = facet_root(w, k);
    /* The least stays, so that what comes out does not depend on the order. */
    w->facet.data[a > b ? a : b].root = a > b ? b : a;
}

/* The facet of a face in a cell of its patch, -1: none.  Those of a face stand by row, then by column. */
static int32_t facet_in(const panel_work *w, int32_t face, int32_t column, int32_t row)
{
    int32_t lo = w->first_of_face.data[face], hi = w->first_of_face.data[face + 1];
    while (lo < hi) {
        int32_t middle = lo + (hi - lo) / 2;
        const raw_facet *g = &w->facet.data[w->by_face.data[middle]];
        if (g->row == row && g->column == column)
            return w->by_face.data[middle];
        if (g->row < row || (g->row == row && g->column < column))
            lo = middle + 1;
        else
            hi = middle;
    }
    return -1;
}

/* Whether a part of the segment ab, longer than rounding, lies in the cell. */
static bool edge_in_cell(const panel_work *w, const raw_facet *f, vec3 a, vec3 b)
{
    const int32_t cell[2] = {f->column, f->row};
    double from = 0, to = 1;
    for (int k = 0; k < 2; k++) {
        const panel_ruler *r = &w->ruler.data[2 * f->patch + k];
        double lo = ruler_begin(r, cell[k]), hi = ruler_begin(r, cell[k] + 1);
        double p = vec3_dot(r->axis, a), way = vec3_dot(r->axis, b) - p;
        if (fabs(way) <= SHARED * r->size) {
            if (p < lo - SHARED * r->size || p > hi + SHARED * r->size)
                return false;
            continue;
        }
        double s = (lo - p) / way, t = (hi - p) / way;
        from = fmax(from, fmin(s, t));
        to = fmin(to, fmax(s, t));
    }
    return (to - from) * vec3_length(vec3_sub(b, a)) > SHARED * w->rules->size;
}

fram_status panels_connect(panel_work *w, fram_error *error)
{
    if (!index_faces(w))
        return error_memory(error);
    for (int32_t i = 0; i < w->facet.count; i++) {
        const raw_facet *f = &w->facet.data[i];
        vec3 c[3];
        mesh_face_points(w->hull, f->face, c);
        for (int k = 0; k < 3; k++) {
            int32_t g = w->adjacency.neighbour.data[3 * f->face + k];
            if (g < 0 || g < f->face || w->patch_of.data[g] != f->patch)
                continue;
            int32_t other = facet_in(w, g, f->column, f->row);
            if (other >= 0 && edge_in_cell(w, f, c[k], c[(k + 1) % 3]))
                join_facets(w, i, other);
        }
    }
    return FRAM_OK;
}

/* ---- slivers ---- */

/* Whether a point lies on a flat convex facet or its border. */
static bool touches(const panel_work *w, const raw_facet *f, vec3 p, double slack)
{
    const vec3 *c = &w->corner.data[f->first];
    vec3 n = {0, 0, 0};
    for (int32_t k = 1; k + 1 < f->count; k++)
        n = vec3_add(n, vec3_cross(vec3_sub(c[k], c[0]), vec3_sub(c[k + 1], c[0])));
    double size = vec3_length(n);
    if (!(size > 0))
        return false;
    n = vec3_scale(n, 1 / size);
    if (fabs(vec3_dot(n, vec3_sub(p, c[0]))) > slack)
        return false;
    for (int32_t k = 0; k < f->count; k++) {
        vec3 a = c[k], side = vec3_sub(c[(k + 1) % f->count], a);
        double length = vec3_length(side);
        if (vec3_dot(vec3_cross(side, vec3_sub(p, a)), n) < -slack * length)
            return false;
    }
    return true;
}

/* A neighbour of the panel that is looked at, and the length of the border with it. */
typedef struct border {
    int32_t root;
    double length;
} border;
typedef ARRAY(border) border_array;

static bool add_border(panel_work *w, border_array *list, int32_t root, double length)
{
    for (int32_t i = 0; i < list->count; i++)
        if (list->data[i].root == root) {
            list->data[i].length += length;
            return true;
        }
    return array_push(w->ctx, list, (border){root, length});
}

/* Where the edge from a to b of a facet of `own` is shared with other panels' facets on this face: its middle lies in
   one cell, or on the line between two, or on a crossing. */
static bool look_across(panel_work *w, border_array *list, int32_t own, int32_t face, vec3 a, vec3 b)
{
    vec3 middle = vec3_scale(vec3_add(a, b), 0.5);
    double slack = SHARED * w->rules->size, length = vec3_length(vec3_sub(b, a));
    const panel_ruler *columns = &w->ruler.data[2 * w->patch_of.data[face]], *rows = columns + 1;
    double u = vec3_dot(columns->axis, middle), v = vec3_dot(rows->axis, middle);
    for (int32_t row = ruler_cell(rows, v - slack); row <= ruler_cell(rows, v + slack); row++) {
        for (int32_t column = ruler_cell(columns, u - slack); column <= ruler_cell(columns, u + slack); column++) {
            int32_t other = facet_in(w, face, column, row);
            if (other < 0 || facet_root(w, other) == own || !touches(w, &w->facet.data[other], middle, slack))
                continue;
            if (!add_border(w, list, facet_root(w, other), length))
                return false;
        }
    }
    return true;
}

static bool borders_of(panel_work *w, int32_t facet, border_array *list)
{
    const raw_facet *f = &w->facet.data[facet];
    int32_t own = facet_root(w, facet);
    bool good = true;
    for (int32_t k = 0; k < f->count && good; k++) {
        vec3 a = w->corner.data[f->first + k], b = w->corner.data[f->first + (k + 1) % f->count];
        good = look_across(w, list, own, f->face, a, b);
        for (int e = 0; e < 3 && good; e++) {
            int32_t g = w->adjacency.neighbour.data[3 * f->face + e];
            if (g >= 0)
                good = look_across(w, list, own, g, a, b);
        }
    }
    return good;
}

/* The least area of a panel in a cell of a patch. */
static double least_area(const panel_work *w, const raw_facet *f)
{
    const int32_t cell[2] = {f->column, f->row};
    double area = SLIVER * w->rules->size * w->rules->size;
    for (int k = 0; k < 2; k++) {
        const panel_ruler *r = &w->ruler.data[2 * f->patch + k];
        area *= fmin(1, (ruler_begin(r, cell[k] + 1) - ruler_begin(r, cell[k])) / r->size);
    }
    return area;
}

/* A panel on the way: its facets are a chain. */
typedef struct chain {
    double area;
    int32_t first, last;
} chain;

static void append(chain *to, const chain *from, int32_t *next)
{
    next[to->last] = from->first;
    to->last = from->last;
    to->area += from->area;
}

static fram_status join_one(panel_work *w, chain *chains, int32_t *next, int32_t root, border_array *list,
                            fram_error *error)
{
    array_clear(list);
    for (int32_t i = chains[root].first; i >= 0; i = next[i])
        if (!borders_of(w, i, list))
            return error_memory(error);
    int32_t best = -1;
    for (int32_t i = 0; i < list->count; i++) {
        /* Of its own patch before others: a knuckle is a border. */
        bool own = w->facet.data[list->data[i].root].patch == w->facet.data[root].patch;
        bool best_own = best >= 0 && w->facet.data[list->data[best].root].patch == w->facet.data[root].patch;
        if (best < 0 || own > best_own ||
            (own == best_own && list->data[i].length > list->data[best].length * (1 + 1e-9)))
            best = i;
    }
    if (best < 0)
        return FRAM_OK;
    int32_t other = list->data[best].root;
    append(&chains[other], &chains[root], next);
    w->facet.data[root].root = other;
    return FRAM_OK;
}

typedef struct sliver {
    double area;
    int32_t root;
} sliver;

static int compare_slivers(const void *a, const void *b)
{
    const sliver *p = a, *q = b;
    if (p->area != q->area)
        return p->area < q->area ? -1 : 1;
    return p->root < q->root ? -1 : p->root > q->root;
}

static void make_chains(panel_work *w, chain *chains, int32_t *next)
{
    for (int32_t i = 0; i < w->facet.count; i++) {
        const chain one = {w->facet.data[i].area, i, i};
        int32_t root = facet_root(w, i);
        next[i] = -1;
        if (root == i)
            chains[i] = one;
        else
            append(&chains[root], &one, next);
    }
}

/* The smallest first; what has grown enough by then stays. */
fram_status panels_join_slivers(panel_work *w, fram_error *error)
{
    size_t count = (size_t)w->facet.count + 1;
    chain *chains = memory_array(w->ctx, count, sizeof *chains);
    int32_t *next = memory_array(w->ctx, count, sizeof *next);
    ARRAY(sliver) slivers = {0};
    border_array list = {0};
    fram_status status = chains && next ? FRAM_OK : error_memory(error);
    if (status == FRAM_OK)
        make_chains(w, chains, next);
    for (int32_t i = 0; i < w->facet.count && status == FRAM_OK; i++)
        if (w->facet.data[i].root == i && chains[i].area < least_area(w, &w->facet.data[i]) &&
            !array_push(w->ctx, &slivers, (sliver){chains[i].area, i}))
            status = error_memory(error);
    if (slivers.count > 0)
        qsort(slivers.data, (size_t)slivers.count, sizeof *slivers.data, compare_slivers);
    for (int32_t i = 0; i < slivers.count && status == FRAM_OK; i++) {
        int32_t root = slivers.data[i].root;
        if (w->facet.data[root].root == root && chains[root].area < least_area(w, &w->facet.data[root]))
            status = join_one(w, chains, next, root, &list, error);
    }
    array_free(w->ctx, &slivers);
    array_free(w->ctx, &list);
    memory_free(w->ctx, chains);
    memory_free(w->ctx, next);
    return status;
}
