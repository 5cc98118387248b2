/* The tiles of level ice; see tiles.h. */
#include "ice/tiles.h"

/* A vertex this near to a side of its cell, as a part of the cell, lies on it: far over rounding, far under any edge.
 */
static const double ON_SIDE = 1e-9;
/* Both sides of a cut that divides a tile lie on each other to this part of a cell. */
static const double ON_CUT = 1e-7;

/* ---- the grid ---- */

tile_grid tile_grid_over(box2 plan, double size)
{
    double length = plan.hi.x - plan.lo.x, width = plan.hi.y - plan.lo.y;
    tile_grid g = {.plan = plan};
    /* Cells are numbered in 32 bits, whatever is asked for. */
    g.columns = (int32_t)fmin(fmax(floor(length / size + 0.5), 1), INT32_MAX);
    g.rows = (int32_t)fmin(fmax(floor(width / size + 0.5), 1), floor((double)INT32_MAX / g.columns));
    return g;
}

/* Line i of a direction: the same number, to the bit, for the cells on both its sides. */
static double line_at(double lo, double hi, int32_t i, int32_t count)
{
    return i == count ? hi : lo + (hi - lo) * i / count;
}

static double drifting_line(double origin, double pitch, double moved, int64_t number)
{
    return origin + (double)number * pitch + moved;
}

static box2 drifting_box(const tile_grid *g, tile_range r)
{
    vec2 o = g->origin, p = g->pitch, m = g->moved;
    return (box2){
        {drifting_line(o.x, p.x, m.x, g->column + r.column_first), drifting_line(o.y, p.y, m.y, g->row + r.row_first)},
        {drifting_line(o.x, p.x, m.x, g->column + r.column_last + 1),
         drifting_line(o.y, p.y, m.y, g->row + r.row_last + 1)}};
}

box2 tile_grid_plan(const tile_grid *g) { return drifting_box(g, (tile_range){0, g->columns - 1, 0, g->rows - 1}); }

box2 tile_cell(const tile_grid *g, int32_t cell)
{
    int32_t i = cell % g->columns, k = cell / g->columns;
    if (g->drifts)
        return drifting_box(g, (tile_range){i, i, k, k});
    return (box2){
        {line_at(g->plan.lo.x, g->plan.hi.x, i, g->columns), line_at(g->plan.lo.y, g->plan.hi.y, k, g->rows)},
        {line_at(g->plan.lo.x, g->plan.hi.x, i + 1, g->columns), line_at(g->plan.lo.y, g->plan.hi.y, k + 1, g->rows)}};
}

static int32_t place_in(double x, double lo, double hi, int32_t count)
{
    double place = floor((x - lo) / (hi - lo) * count);
    return (int32_t)fmin(fmax(place, 0), count - 1);
}

bool tile_range_of(const tile_grid *g, box2 box, tile_range *range)
{
    if (!(box.hi.x >= g->plan.lo.x && box.lo.x <= g->plan.hi.x && box.hi.y >= g->plan.lo.y && box.lo.y <= g->plan.hi.y))
        return false;
    *range = (tile_range){place_in(box.lo.x, g->plan.lo.x, g->plan.hi.x, g->columns),
                          place_in(box.hi.x, g->plan.lo.x, g->plan.hi.x, g->columns),
                          place_in(box.lo.y, g->plan.lo.y, g->plan.hi.y, g->rows),
                          place_in(box.hi.y, g->plan.lo.y, g->plan.hi.y, g->rows)};
    return true;
}

/* ---- making the sheet ---- */

static bool boxes_part(box2 a, box2 b)
{
    return a.hi.x <= b.lo.x || b.hi.x <= a.lo.x || a.hi.y <= b.lo.y || b.hi.y <= a.lo.y;
}

/* What the openings leave of one cell, in `left`; `room` is its spare. */
static fram_status open_cell(context *ctx, overlay *plane, box2 cell, const polygon_list *openings, polygon_list *left,
                             polygon_list *room, fram_error *error)
{
    const vec2 corner[4] = {cell.lo, {cell.hi.x, cell.lo.y}, cell.hi, {cell.lo.x, cell.hi.y}};
    polygon_list_clear(left);
    if (!polygon_list_push(ctx, left, (polygon){corner, 4}))
        return error_memory(error);
    for (int32_t i = 0; i < polygon_list_count(openings); i++) {
        polygon opening = polygon_list_get(openings, i);
        if (boxes_part(cell, polygon_bounds(opening)))
            continue;
        polygon_list_clear(room);
        for (int32_t k = 0; k < polygon_list_count(left); k++) {
            fram_status status = overlay_difference(plane, polygon_list_get(left, k), opening, room, error);
            if (status != FRAM_OK)
                return status;
        }
        polygon_list swap = *left;
        *left = *room;
        *room = swap;
    }
    return FRAM_OK;
}

fram_status tile_cell_rings(context *ctx, const tile_grid *g, int32_t cell, overlay *plane,
                            const polygon_list *openings, double smallest, polygon_list *outlines, int32_array *cells,
                            fram_error *error)
{
    polygon_list left = {0}, room = {0};
    vec2_array ring = {0};
    fram_status status = open_cell(ctx, plane, tile_cell(g, cell), openings, &left, &room, error);
    for (int32_t i = 0; i < polygon_list_count(&left) && status == FRAM_OK; i++) {
        polygon p = polygon_list_get(&left, i);
        if (!array_resize(ctx, &ring, p.count)) {
            status = error_memory(error);
            break;
        }
        for (int32_t k = 0; k < p.count; k++)
            ring.data[k] = p.vertex[k];
        tile_snap(g, cell, &ring);
        p = (polygon){ring.data, ring.count};
        if (p.count < 3 || !(polygon_area(p) >= smallest))
            continue;
        if (!polygon_list_push(ctx, outlines, p) || !array_push(ctx, cells, cell))
            status = error_memory(error);
    }
    polygon_list_free(ctx, &left);
    polygon_list_free(ctx, &room);
    array_free(ctx, &ring);
    return status;
}

fram_status tile_sheet(context *ctx, const tile_grid *g, overlay *plane, const polygon_list *openings, double smallest,
                       polygon_list *outlines, int32_array *cells, fram_error *error)
{
    fram_status status = FRAM_OK;
    for (int32_t cell = 0; cell < g->columns * g->rows && status == FRAM_OK; cell++) {
        status = work_continue(ctx, "making the tiles of the sheet", cell, g->columns * g->rows, error);
        if (status == FRAM_OK)
            status = tile_cell_rings(ctx, g, cell, plane, openings, smallest, outlines, cells, error);
    }
    return status;
}

/* ---- tiles as they stand ---- */

void tile_index_free(context *ctx, tile_index *index)
{
    array_free(ctx, &index->first);
    array_free(ctx, &index->next);
}

bool tile_index_build(context *ctx, tile_index *index, const tile_grid *g, const floe_table *floes)
{
    int32_t cells = g->columns * g->rows;
    if (!array_resize(ctx, &index->first, cells) || !array_resize(ctx, &index->next, floes->count))
        return false;
    for (int32_t i = 0; i < cells; i++)
        index->first.data[i] = -1;
    for (int32_t row = floes->count - 1; row >= 0; row--) {
        int32_t cell = floes->tile[row] - 1;
        if (cell < 0 || floes->body[row] < 0)
            continue;
        index->next.data[row] = index->first.data[cell];
        index->first.data[cell] = row;
    }
    return true;
}

static double snapped(double x, double lo, double hi)
{
    double reach = ON_SIDE * (hi - lo);
    return fabs(x - lo) <= reach ? lo : fabs(x - hi) <= reach ? hi : x;
}

static vec2 snapped_point(box2 cell, vec2 v)
{
    return (vec2){snapped(v.x, cell.lo.x, cell.hi.x), snapped(v.y, cell.lo.y, cell.hi.y)};
}

static bool is_same_point(vec2 a, vec2 b, double reach) { return fabs(a.x - b.x) <= reach && fabs(a.y - b.y) <= reach; }

void tile_snap(const tile_grid *g, int32_t cell, vec2_array *ring)
{
    box2 box = tile_cell(g, cell);
    double reach = ON_SIDE * (box.hi.x - box.lo.x + box.hi.y - box.lo.y);
    int32_t kept = 0;
    for (int32_t i = 0; i < ring->count; i++) {
        vec2 v = snapped_point(box, ring->data[i]);
        if (kept == 0 || !is_same_point(v, ring->data[kept - 1], reach))
            ring->data[kept++] = v;
    }
    while (kept > 1 && is_same_point(ring->data[kept - 1], ring->data[0], reach))
        kept--;
    ring->count = kept;
}

static polygon outline_of(const tile_sheet_view *v, int32_t row)
{
    return shape_outline(v->shapes, v->bodies->shape[v->floes->body[row]]);
}

/* A tile on its way to the global plan, with what all of its corners have in common. */
typedef struct tile_ring {
    polygon outline; /* frame of its body */
    vec2 at;
    box2 cell;
} tile_ring;

static tile_ring tile_ring_of(const tile_sheet_view *v, int32_t row)
{
    vec3 at = v->bodies->position[v->floes->body[row]];
    return (tile_ring){outline_of(v, row), {at.x, at.y}, tile_cell(v->grid, v->floes->tile[row] - 1)};
}

static vec2 corner_of(const tile_ring *r, int32_t i)
{
    return snapped_point(r->cell, vec2_add(r->at, r->outline.vertex[i < r->outline.count ? i : 0]));
}

bool tile_outline(context *ctx, const tile_sheet_view *v, int32_t row, vec2_array *out)
{
    tile_ring r = tile_ring_of(v, row);
    if (!array_resize(ctx, out, r.outline.count))
        return false;
    for (int32_t i = 0; i < r.outline.count; i++)
        out->data[i] = corner_of(&r, i);
    tile_snap(v->grid, v->floes->tile[row] - 1, out);
    return true;
}

/* ---- seams ---- */

/* The side of its cell that an edge lies on, -1 when on none. */
static int side_of(box2 cell, vec2 a, vec2 b)
{
    if (a.x == b.x && a.x == cell.lo.x)
        return SHEET_X_MIN;
    if (a.x == b.x && a.x == cell.hi.x)
        return SHEET_X_MAX;
    if (a.y == b.y && a.y == cell.lo.y)
        return SHEET_Y_MIN;
    if (a.y == b.y && a.y == cell.hi.y)
        return SHEET_Y_MAX;
    return -1;
}

/* The cell beyond a side, -1 outside the sheet. */
static int32_t cell_beyond(const tile_grid *g, int32_t cell, int side)
{
    int32_t i = cell % g->columns + (side == SHEET_X_MAX) - (side == SHEET_X_MIN);
    int32_t k = cell / g->columns + (side == SHEET_Y_MAX) - (side == SHEET_Y_MIN);
    return i >= 0 && i < g->columns && k >= 0 && k < g->rows ? i + k * g->columns : -1;
}

static int opposite(int side) { return side ^ 1; }

static double along(int side, vec2 v) { return side == SHEET_X_MIN || side == SHEET_X_MAX ? v.y : v.x; }

double tile_side_length(const tile_grid *g, int32_t cell, polygon ring)
{
    box2 box = tile_cell(g, cell);
    double sum = 0;
    for (int32_t i = 0; i < ring.count; i++) {
        vec2 a = ring.vertex[i], b = ring.vertex[i + 1 < ring.count ? i + 1 : 0];
        int side = side_of(box, a, b);
        if (side >= 0 && (cell_beyond(g, cell, side) >= 0 || g->anchored[side]))
            sum += vec2_length(vec2_sub(b, a));
    }
    return sum;
}

typedef struct interval {
    double lo, hi;
} interval;

static interval interval_of(int side, vec2 a, vec2 b)
{
    double p = along(side, a), q = along(side, b);
    return (interval){fmin(p, q), fmax(p, q)};
}

/* The next part of [from, hi] on a side of a cell that the tiles beyond it cover; false when there is none. */
static bool next_cover(const tile_sheet_view *v, int32_t beyond, int side, double from, double hi, interval *cover)
{
    bool found = false;
    box2 cell = tile_cell(v->grid, beyond);
    for (int32_t row = v->index->first.data[beyond]; row >= 0; row = v->index->next.data[row]) {
        tile_ring r = tile_ring_of(v, row);
        vec2 a = corner_of(&r, 0);
        for (int32_t i = 0; i < r.outline.count; i++) {
            vec2 b = corner_of(&r, i + 1);
            if (side_of(cell, a, b) == opposite(side)) {
                interval e = interval_of(side, a, b);
                if (e.hi > from && e.lo < hi && (!found || e.lo < cover->lo)) {
                    *cover = e;
                    found = true;
                }
            }
            a = b;
        }
    }
    return found;
}

static bool push_segment(context *ctx, tile_segment_array *out, vec2 a, vec2 b)
{
    vec2 e = vec2_sub(b, a);
    double length = vec2_length(e);
    return !(length > 0) || array_push(ctx, out, (tile_segment){a, b, {-e.y / length, e.x / length}});
}

/* The part of an edge on a cell's side from s to t along it, in the edge's own direction. */
static bool push_side_part(context *ctx, tile_segment_array *out, int side, vec2 a, vec2 b, double s, double t)
{
    vec2 p = a, q = a;
    if (side == SHEET_X_MIN || side == SHEET_X_MAX)
        p.y = s, q.y = t;
    else
        p.x = s, q.x = t;
    return along(side, b) >= along(side, a) ? push_segment(ctx, out, p, q) : push_segment(ctx, out, q, p);
}

/* An edge less what the neighbour covers; gaps and seams of rounding are none. */
static bool push_uncovered(context *ctx, const tile_sheet_view *v, int32_t cell, vec2 a, vec2 b,
                           tile_segment_array *out)
{
    box2 box = tile_cell(v->grid, cell);
    int side = side_of(box, a, b);
    int32_t beyond = side < 0 ? -1 : cell_beyond(v->grid, cell, side);
    if (beyond < 0)
        return push_segment(ctx, out, a, b);
    interval whole = interval_of(side, a, b), cover;
    double reach = ON_SIDE * (box.hi.x - box.lo.x + box.hi.y - box.lo.y), from = whole.lo;
    bool good = true;
    while (good && from < whole.hi - reach && next_cover(v, beyond, side, from, whole.hi, &cover)) {
        if (cover.lo > from + reach)
            good = push_side_part(ctx, out, side, a, b, from, fmin(cover.lo, whole.hi));
        from = fmax(from, cover.hi);
    }
    return good && (from >= whole.hi - reach || push_side_part(ctx, out, side, a, b, from, whole.hi));
}

/* What of segment a runs back along segment b, from lo to hi along a [m]. */
static bool runs_back(const tile_segment *a, const tile_segment *b, double reach, double *lo, double *hi)
{
    if (!(vec2_dot(a->normal, b->normal) < 0))
        return false;
    vec2 along = {a->normal.y, -a->normal.x}, from = vec2_sub(b->b, a->a), to = vec2_sub(b->a, a->a);
    if (fabs(vec2_dot(from, a->normal)) > reach || fabs(vec2_dot(to, a->normal)) > reach)
        return false;
    *lo = fmax(vec2_dot(from, along), 0);
    *hi = fmin(vec2_dot(to, along), vec2_length(vec2_sub(a->b, a->a)));
    return *hi - *lo > reach;
}

/* Segment i less its part between two points; what is left beyond the second becomes a segment at the end. */
static bool take_out(context *ctx, tile_segment_array *line, int32_t i, vec2 from, vec2 to, double reach)
{
    tile_segment rest = line->data[i];
    line->data[i].b = vec2_length(vec2_sub(from, rest.a)) > reach ? from : rest.a;
    rest.a = to;
    return !(vec2_length(vec2_sub(rest.b, to)) > reach) || array_push(ctx, line, rest);
}

/* Cuts that divide a cell's ice around a hole have ice on both sides, and are no boundary. */
static bool drop_cuts(context *ctx, tile_segment_array *line, int32_t first, double reach)
{
    for (int32_t i = first; i < line->count; i++)
        for (int32_t k = i + 1; k < line->count; k++) {
            double lo, hi;
            const tile_segment a = line->data[i];
            if (!runs_back(&a, &line->data[k], reach, &lo, &hi))
                continue;
            vec2 along = {a.normal.y, -a.normal.x}, from = vec2_add(a.a, vec2_scale(along, lo)),
                 to = vec2_add(a.a, vec2_scale(along, hi));
            if (!take_out(ctx, line, i, from, to, reach) || !take_out(ctx, line, k, to, from, reach))
                return false;
        }
    int32_t kept = first;
    for (int32_t i = first; i < line->count; i++)
        if (vec2_length(vec2_sub(line->data[i].b, line->data[i].a)) > 0)
            line->data[kept++] = line->data[i];
    line->count = kept;
    return true;
}

bool tile_boundary(context *ctx, const tile_sheet_view *v, tile_range range, tile_segment_array *out)
{
    box2 box = tile_cell(v->grid, 0);
    double reach = ON_CUT * (box.hi.x - box.lo.x + box.hi.y - box.lo.y);
    for (int32_t k = range.row_first; k <= range.row_last; k++)
        for (int32_t i = range.column_first; i <= range.column_last; i++) {
            int32_t cell = i + k * v->grid->columns, first = out->count;
            for (int32_t row = v->index->first.data[cell]; row >= 0; row = v->index->next.data[row]) {
                tile_ring r = tile_ring_of(v, row);
                vec2 a = corner_of(&r, 0);
                for (int32_t m = 0; m < r.outline.count; m++) {
                    vec2 b = corner_of(&r, m + 1);
                    if (!push_uncovered(ctx, v, cell, a, b, out))
                        return false;
                    a = b;
                }
            }
            if (!drop_cuts(ctx, out, first, reach))
                return false;
        }
    return true;
}

double tile_seam(const tile_sheet_view *v, int32_t row_a, int32_t row_b)
{
    int32_t cell_a = v->floes->tile[row_a] - 1, cell_b = v->floes->tile[row_b] - 1;
    box2 box_a = tile_cell(v->grid, cell_a), box_b = tile_cell(v->grid, cell_b);
    int side = 0;
    while (side < SHEET_SIDES && cell_beyond(v->grid, cell_a, side) != cell_b)
        side++;
    if (side == SHEET_SIDES)
        return 0;
    double sum = 0;
    tile_ring ring_a = tile_ring_of(v, row_a), ring_b = tile_ring_of(v, row_b);
    for (int32_t i = 0; i < ring_a.outline.count; i++) {
        vec2 a = corner_of(&ring_a, i), b = corner_of(&ring_a, i + 1);
        if (side_of(box_a, a, b) != side)
            continue;
        interval mine = interval_of(side, a, b);
        for (int32_t k = 0; k < ring_b.outline.count; k++) {
            vec2 c = corner_of(&ring_b, k), d = corner_of(&ring_b, k + 1);
            if (side_of(box_b, c, d) != opposite(side))
                continue;
            interval theirs = interval_of(side, c, d);
            sum += fmax(fmin(mine.hi, theirs.hi) - fmax(mine.lo, theirs.lo), 0);
        }
    }
    return sum;
}

bool tile_grid_is_held(const tile_grid *g, vec2 a, vec2 b)
{
    int side = side_of(g->drifts ? tile_grid_plan(g) : g->plan, a, b);
    return side >= 0 && g->anchored[side];
}

bool tile_is_anchored(const tile_sheet_view *v, int32_t row)
{
    int32_t cell = v->floes->tile[row] - 1;
    tile_ring r = tile_ring_of(v, row);
    for (int32_t i = 0; i < r.outline.count; i++) {
        vec2 a = corner_of(&r, i), b = corner_of(&r, i + 1);
        int side = side_of(r.cell, a, b);
        if (side >= 0 && v->grid->anchored[side] && cell_beyond(v->grid, cell, side) < 0 &&
            vec2_length(vec2_sub(b, a)) > v->grid->least_seam)
            return true;
    }
    return false;
}

/* ---- seams of the convex pieces ---- */

/* Whether the tiles beyond cover an edge from end to end. */
static bool is_covered(const tile_sheet_view *v, int32_t cell, int side, vec2 a, vec2 b)
{
    int32_t beyond = cell_beyond(v->grid, cell, side);
    if (beyond < 0)
        return false;
    box2 box = tile_cell(v->grid, cell);
    interval whole = interval_of(side, a, b), cover;
    double reach = ON_SIDE * (box.hi.x - box.lo.x + box.hi.y - box.lo.y), from = whole.lo;
    while (from < whole.hi - reach) {
        if (!next_cover(v, beyond, side, from, whole.hi, &cover) || cover.lo > from + reach)
            return false;
        from = cover.hi;
    }
    return true;
}

static void mark_inner_edges(const tile_sheet_view *v, shape_store *shapes, int32_t row, int32_t piece)
{
    int32_t cell = v->floes->tile[row] - 1, shape = v->bodies->shape[v->floes->body[row]];
    tile_ring r = tile_ring_of(v, row);
    r.outline = shape_piece(shapes, shape, piece);
    uint64_t *inner = &shapes->pieces.inner_edges[shapes->shapes.piece_first[shape] + piece];
    for (int32_t k = 0; k < r.outline.count; k++) {
        vec2 a = corner_of(&r, k), b = corner_of(&r, k + 1);
        int side = side_of(r.cell, a, b);
        if (side < 0)
            continue;
        uint64_t bit = (uint64_t)1 << k;
        *inner = is_covered(v, cell, side, a, b) ? *inner | bit : *inner & ~bit;
    }
}

void tile_mark_seams(const tile_sheet_view *v, shape_store *shapes, tile_range range)
{
    for (int32_t k = range.row_first; k <= range.row_last; k++)
        for (int32_t i = range.column_first; i <= range.column_last; i++)
            for (int32_t row = v->index->first.data[i + k * v->grid->columns]; row >= 0; row = v->index->next.data[row])
                for (int32_t p = 0; p < shapes->shapes.piece_count[v->bodies->shape[v->floes->body[row]]]; p++)
                    mark_inner_edges(v, shapes, row, p);
}
