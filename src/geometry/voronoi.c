/* Voronoi cells one by one: the box, cut by the bisectors to the sites around, nearest grid cells first, until no site
   farther out can reach the cell.  Each cell depends on the sites alone, not on the cells made before. */
#include "geometry/voronoi.h"
#include "geometry/convex_cut.h"
#include <stdio.h>

/* Sites in one grid cell on average: fewer cost empty cells, more cost sites that are too far to matter. */
#define SITES_PER_CELL 2.0

/* After so many cells, some milliseconds, the caller is asked whether to go on. */
enum { CELLS_A_WORD = 256 };

typedef struct diagram {
    context *ctx;
    const vec2 *site;
    const double *weight; /* or NULL */
    int32_t count;
    box2 box;
    double rounding;   /* of coordinates in the box */
    double top_weight; /* the largest */
    /* grid over the sites' own bounds: sites of cell c are order[start[c] .. start[c + 1]) */
    box2 bounds;
    double size;
    int32_t columns, rows;
    int32_t *start, *order;
    /* the cell at work, the one it is cut into, and distances of its vertices from the cutting line */
    vec2_array cell, cut;
    ARRAY(double) side;
} diagram;

static double weight_of(const diagram *d, int32_t i) { return d->weight ? d->weight[i] : 0; }

static fram_status refuse_site(fram_error *error, int32_t site, const char *why)
{
    char key[32];
    snprintf(key, sizeof key, "site %d", (int)site);
    return error_set(error, FRAM_ERROR_INPUT, NULL, 0, key, "%s", why);
}

static fram_status check_sites(diagram *d, fram_error *error)
{
    box2 box = d->box;
    if (!(box.lo.x < box.hi.x && box.lo.y < box.hi.y && isfinite(box.hi.x - box.lo.x) && isfinite(box.hi.y - box.lo.y)))
        return error_set(error, FRAM_ERROR_INPUT, NULL, 0, NULL, "the box of the Voronoi cells has no area");
    d->top_weight = -HUGE_VAL;
    for (int32_t i = 0; i < d->count; i++) {
        vec2 s = d->site[i];
        if (!(s.x >= box.lo.x && s.x <= box.hi.x && s.y >= box.lo.y && s.y <= box.hi.y))
            return refuse_site(error, i, "outside the box");
        if (!isfinite(weight_of(d, i)))
            return refuse_site(error, i, "the weight is not finite");
        d->top_weight = real_max(d->top_weight, weight_of(d, i));
    }
    const vec2 corners[2] = {box.lo, box.hi};
    d->rounding = polygon_rounding((polygon){corners, 2});
    return FRAM_OK;
}

static int32_t column_of(const diagram *d, int32_t i) { return (int32_t)((d->site[i].x - d->bounds.lo.x) / d->size); }
static int32_t row_of(const diagram *d, int32_t i) { return (int32_t)((d->site[i].y - d->bounds.lo.y) / d->size); }

/* Counting sort of the sites into grid cells, ascending within a cell. */
static bool make_grid(diagram *d)
{
    box2 bounds = polygon_bounds((polygon){d->site, d->count});
    double width = bounds.hi.x - bounds.lo.x, height = bounds.hi.y - bounds.lo.y, share = SITES_PER_CELL / d->count;
    d->bounds = bounds;
    d->size = real_max(sqrt(width * height * share), real_max(width, height) * share);
    if (!(d->size > 0))
        d->size = 1;
    d->columns = (int32_t)(width / d->size) + 1;
    d->rows = (int32_t)(height / d->size) + 1;
    int32_t cells = d->columns * d->rows;
    d->start = memory_array(d->ctx, (size_t)cells + 2, sizeof *d->start);
    d->order = memory_array(d->ctx, (size_t)d->count, sizeof *d->order);
    if (!d->start || !d->order)
        return false;
    int32_t *fill = d->start + 1; /* one ahead, so that filling leaves the starts in place */
    for (int32_t i = 0; i < d->count; i++)
        fill[row_of(d, i) * d->columns + column_of(d, i) + 1]++;
    for (int32_t c = 0; c < cells; c++)
        fill[c + 1] += fill[c];
    for (int32_t i = 0; i < d->count; i++)
        d->order[fill[row_of(d, i) * d->columns + column_of(d, i)]++] = i;
    return true;
}

/* Square of the distance from site i to the farthest vertex of its cell. */
static double reach_square(const diagram *d, int32_t i)
{
    double most = 0;
    for (int32_t k = 0; k < d->cell.count; k++) {
        vec2 r = vec2_sub(d->cell.data[k], d->site[i]);
        most = real_max(most, vec2_dot(r, r));
    }
    return most;
}

/* Keep what is nearer to site i than to site j: e . (x - s_i) <= (|e|^2 + w_i - w_j) / 2 with e = s_j - s_i. */
static bool cut_by_bisector(diagram *d, int32_t i, int32_t j, double *reach)
{
    vec2 s = d->site[i], e = vec2_sub(d->site[j], s);
    double square = vec2_dot(e, e), offset = 0.5 * (square + (weight_of(d, i) - weight_of(d, j))), most = -HUGE_VAL;
    if (offset > 0 && offset * offset >= *reach * square)
        return true; /* beyond the farthest vertex */
    int32_t n = d->cell.count;
    if (!array_reserve(d->ctx, &d->cut, n + 1) || !array_reserve(d->ctx, &d->side, n))
        return false;
    for (int32_t k = 0; k < n; k++) {
        d->side.data[k] = vec2_dot(e, vec2_sub(d->cell.data[k], s)) - offset;
        most = real_max(most, d->side.data[k]);
    }
    double slack = d->rounding * (fabs(e.x) + fabs(e.y));
    if (most <= slack)
        return true;
    d->cut.count = convex_cut(d->cell.data, d->side.data, n, slack, d->cut.data);
    vec2_array old = d->cell;
    d->cell = d->cut;
    d->cut = old;
    *reach = reach_square(d, i);
    return true;
}

/* Cut the cell of site i by the sites of one grid cell. */
static fram_status cut_by_grid_cell(diagram *d, int32_t i, int32_t column, int32_t row, double *reach,
                                    fram_error *error)
{
    int32_t c = row * d->columns + column;
    for (int32_t k = d->start[c]; k < d->start[c + 1] && d->cell.count > 0; k++) {
        int32_t j = d->order[k];
        if (j == i)
            continue;
        if (vec2_equal(d->site[i], d->site[j]))
            return refuse_site(error, i > j ? i : j, "at the same place as another site");
        if (!cut_by_bisector(d, i, j, reach))
            return error_memory(error);
    }
    return FRAM_OK;
}

/* Cut by all grid cells at `ring` steps (the larger of columns and rows) from the site's own. */
static fram_status cut_by_ring(diagram *d, int32_t i, int32_t column, int32_t row, int32_t ring, double *reach,
                               fram_error *error)
{
    int32_t left = column - ring, right = column + ring, bottom = row - ring, top = row + ring;
    for (int32_t y = bottom > 0 ? bottom : 0; y <= top && y < d->rows; y++) {
        int32_t step = y == bottom || y == top || ring == 0 ? 1 : 2 * ring;
        for (int32_t x = left >= 0 ? left : step == 1 ? 0 : right; x <= right && x < d->columns; x += step) {
            fram_status status = cut_by_grid_cell(d, i, x, y, reach, error);
            if (status != FRAM_OK)
                return status;
        }
    }
    return FRAM_OK;
}

/* A site somewhere in the rectangle could take a vertex v from the cell of site i: |v - s_j|^2 - w_j < |v - s_i|^2
   - w_i. */
static bool rectangle_matters(const diagram *d, int32_t i, double left, double bottom, double right, double top)
{
    double lead = d->top_weight - weight_of(d, i), margin = 1e-6 * d->size; /* a site may be binned one cell off */
    for (int32_t k = 0; k < d->cell.count; k++) {
        vec2 v = d->cell.data[k], own = vec2_sub(v, d->site[i]);
        double x = real_max(real_max(left - margin - v.x, v.x - right - margin), 0);
        double y = real_max(real_max(bottom - margin - v.y, v.y - top - margin), 0);
        if (x * x + y * y < vec2_dot(own, own) + lead)
            return true;
    }
    return false;
}

/* Grid cells beyond the ring could matter: the parts of the sites' bounds left, right, below and above of it. */
static bool beyond_matters(const diagram *d, int32_t i, int32_t column, int32_t row, int32_t ring)
{
    box2 b = d->bounds;
    double left = b.lo.x + (column - ring) * d->size, right = b.lo.x + (column + ring + 1) * d->size;
    double bottom = b.lo.y + (row - ring) * d->size, top = b.lo.y + (row + ring + 1) * d->size;
    return (column - ring > 0 && rectangle_matters(d, i, b.lo.x, b.lo.y, left, b.hi.y)) ||
           (column + ring < d->columns - 1 && rectangle_matters(d, i, right, b.lo.y, b.hi.x, b.hi.y)) ||
           (row - ring > 0 && rectangle_matters(d, i, b.lo.x, b.lo.y, b.hi.x, bottom)) ||
           (row + ring < d->rows - 1 && rectangle_matters(d, i, b.lo.x, top, b.hi.x, b.hi.y));
}

/* The cell of site i into d->cell. */
static fram_status make_cell(diagram *d, int32_t i, fram_error *error)
{
    box2 b = d->box;
    if (!array_resize(d->ctx, &d->cell, 4))
        return error_memory(error);
    d->cell.data[0] = b.lo;
    d->cell.data[1] = vec2_make(b.hi.x, b.lo.y);
    d->cell.data[2] = b.hi;
    d->cell.data[3] = vec2_make(b.lo.x, b.hi.y);
    int32_t column = column_of(d, i), row = row_of(d, i), ring = 0;
    double reach = reach_square(d, i);
    fram_status status;
    do
        status = cut_by_ring(d, i, column, row, ring, &reach, error);
    while (status == FRAM_OK && d->cell.count > 0 && beyond_matters(d, i, column, row, ring++));
    return status;
}

static fram_status make_cells(diagram *d, polygon_list *out, fram_error *error)
{
    fram_status status = check_sites(d, error);
    if (status == FRAM_OK && !make_grid(d))
        status = error_memory(error);
    for (int32_t i = 0; status == FRAM_OK && i < d->count; i++) {
        if (i % CELLS_A_WORD == 0)
            status = work_continue(d->ctx, "making Voronoi cells", i, d->count, error);
        if (status == FRAM_OK)
            status = make_cell(d, i, error);
        if (status == FRAM_OK && !polygon_list_push(d->ctx, out, (polygon){d->cell.data, d->cell.count}))
            status = error_memory(error);
    }
    return status;
}

fram_status voronoi_cells(context *ctx, const vec2 *site, const double *weight, int32_t count, box2 box,
                          polygon_list *out, fram_error *error)
{
    if (count < 1)
        return FRAM_OK;
    diagram d = {.ctx = ctx, .site = site, .weight = weight, .count = count, .box = box};
    int32_t rings = out->start.count, vertices = out->vertex.count;
    fram_status status = make_cells(&d, out, error);
    if (status != FRAM_OK) {
        out->start.count = rings;
        out->vertex.count = vertices;
    }
    memory_free(ctx, d.start);
    memory_free(ctx, d.order);
    array_free(ctx, &d.cell);
    array_free(ctx, &d.cut);
    array_free(ctx, &d.side);
    return status;
}
