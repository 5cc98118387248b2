/* The window on a drifting sheet: cells that leave, what is remembered of them, cells that enter; see drift.h. */
#include "ice/drift_parts.h"

#include <math.h>

/* A cell with all but this part of its area is whole. */
static const double WHOLE = 1e-9;
/* Cells beyond the window, both sides together. */
enum { SPARE_CELLS = 2 };

/* Cells of a pitch that cover a length with some to spare, and where their first line is. */
static int32_t cells_over(double lo, double hi, double pitch, double *origin)
{
    double count = fmin(ceil((hi - lo) / pitch - WHOLE) + SPARE_CELLS, 46000);
    *origin = (lo + hi) / 2 - count * pitch / 2;
    return (int32_t)count;
}

tile_grid drift_grid_over(box2 window, double size)
{
    tile_grid g = {.drifts = true, .pitch = {size, size}};
    g.columns = cells_over(window.lo.x, window.hi.x, size, &g.origin.x);
    g.rows = cells_over(window.lo.y, window.hi.y, size, &g.origin.y);
    for (int side = 0; side < SHEET_SIDES; side++)
        g.anchored[side] = true;
    g.plan = tile_grid_plan(&g);
    return g;
}

/* ---- cells as they were made ---- */

static box2 moved_box(box2 box, vec2 by) { return (box2){vec2_add(box.lo, by), vec2_add(box.hi, by)}; }

/* What of a cell lies outside the extent, as openings: a rectangle on each side. */
static bool push_outside(context *ctx, box2 cell, box2 extent, polygon_list *out)
{
    vec2 lo = cell.lo, hi = cell.hi;
    box2 beyond[4] = {{lo, {fmin(extent.lo.x, hi.x), hi.y}},
                      {{fmax(extent.hi.x, lo.x), lo.y}, hi},
                      {lo, {hi.x, fmin(extent.lo.y, hi.y)}},
                      {{lo.x, fmax(extent.hi.y, lo.y)}, hi}};
    for (int i = 0; i < 4; i++) {
        box2 b = beyond[i];
        vec2 corner[4] = {b.lo, {b.hi.x, b.lo.y}, b.hi, {b.lo.x, b.hi.y}};
        if (b.hi.x > b.lo.x && b.hi.y > b.lo.y && !polygon_list_push(ctx, out, (polygon){corner, 4}))
            return false;
    }
    return true;
}

static bool moved_openings(context *ctx, const polygon_list *openings, vec2 by, polygon_list *out)
{
    vec2_array ring = {0};
    bool good = true;
    for (int32_t i = 0; i < polygon_list_count(openings) && good; i++) {
        polygon p = polygon_list_get(openings, i);
        good = array_resize(ctx, &ring, p.count);
        for (int32_t k = 0; k < p.count && good; k++)
            ring.data[k] = vec2_add(p.vertex[k], by);
        good = good && polygon_list_push(ctx, out, (polygon){ring.data, ring.count});
    }
    array_free(ctx, &ring);
    return good;
}

fram_status drift_cell_rings(context *ctx, const drift_definition *d, const tile_grid *g, int32_t cell, overlay *plane,
                             polygon_list *outlines, int32_array *cells, fram_error *error)
{
    polygon_list openings = {0};
    bool good = moved_openings(ctx, &d->openings, g->moved, &openings) &&
                push_outside(ctx, tile_cell(g, cell), moved_box(d->extent, g->moved), &openings);
    fram_status status = good ? tile_cell_rings(ctx, g, cell, plane, &openings, d->smallest, outlines, cells, error)
                              : error_memory(error);
    polygon_list_free(ctx, &openings);
    return status;
}

/* ---- memory ---- */

static bool remember_ring(context *ctx, const drift_world *w, int64_t column, int64_t row, polygon ring, vec2 moved)
{
    int32_t at = w->cells->count, first = w->vertices->count;
    if (!table_resize(ctx, w->cells, &drift_cell_table_info, at + 1) ||
        !table_resize(ctx, w->vertices, &drift_vertex_table_info, first + ring.count))
        return false;
    w->cells->column[at] = column;
    w->cells->row[at] = row;
    w->cells->first[at] = first;
    w->cells->size[at] = ring.count;
    for (int32_t i = 0; i < ring.count; i++)
        w->vertices->point[first + i] = vec2_sub(ring.vertex[i], moved);
    return true;
}

/* What is remembered of a cell is told, where it is now, and forgotten. */
static bool recall(context *ctx, const drift_world *w, int64_t column, int64_t row, vec2 moved, polygon_list *rings,
                   bool *known)
{
    drift_cell_table *c = w->cells;
    drift_vertex_table *v = w->vertices;
    int32_t kept = 0, vertices = 0;
    *known = false;
    for (int32_t i = 0; i < c->count; i++) {
        int32_t first = c->first[i], size = c->size[i];
        if (c->column[i] == column && c->row[i] == row) {
            *known = true;
            for (int32_t k = 0; k < size; k++)
                v->point[first + k] = vec2_add(v->point[first + k], moved);
            if (size > 0 && !polygon_list_push(ctx, rings, (polygon){&v->point[first], size}))
                return false;
            continue;
        }
        for (int32_t k = 0; k < size; k++)
            v->point[vertices + k] = v->point[first + k];
        table_move_row(c, &drift_cell_table_info, kept, i);
        c->first[kept++] = vertices;
        vertices += size;
    }
    return table_resize(ctx, c, &drift_cell_table_info, kept) &&
           table_resize(ctx, v, &drift_vertex_table_info, vertices);
}

/* ---- cells that leave ---- */

static double cell_area(const tile_grid *g) { return g->pitch.x * g->pitch.y; }

/* What is known of a cell that leaves: nothing, when it is whole and so made again as it was. */
static bool remember_cell(context *ctx, const drift_world *w, const tile_grid *g, const tile_index *index, int32_t cell)
{
    tile_sheet_view view = {g, index, w->bodies, w->shapes, w->floes};
    int64_t column = g->column + cell % g->columns, row = g->row + cell / g->columns;
    int32_t tile = index->first.data[cell];
    if (tile < 0)
        return remember_ring(ctx, w, column, row, (polygon){NULL, 0}, g->moved);
    if (w->floes->area[tile] >= (1 - WHOLE) * cell_area(g))
        return true;
    vec2_array ring = {0};
    bool good = true;
    for (; tile >= 0 && good; tile = index->next.data[tile])
        good = tile_outline(ctx, &view, tile, &ring) &&
               remember_ring(ctx, w, column, row, (polygon){ring.data, ring.count}, g->moved);
    array_free(ctx, &ring);
    return good;
}

static bool let_leave(context *ctx, const drift_world *w, const tile_grid *g, const tile_index *index, int32_t cell)
{
    if (!remember_cell(ctx, w, g, index, cell))
        return false;
    for (int32_t tile = index->first.data[cell]; tile >= 0; tile = index->next.data[tile]) {
        double mass = w->bodies->mass[w->floes->body[tile]];
        *w->left += mass;
        w->drift->left[0] += mass;
        floe_remove(w->bodies, w->shapes, w->floes, tile);
    }
    return true;
}

/* ---- cells that enter ---- */

static fram_status make_tiles(context *ctx, overlay *plane, const drift_world *w, const polygon_list *rings,
                              int32_t cell, vec2 moved, fram_error *error)
{
    floe_definition d = w->definition->ice;
    d.ice_origin = vec2_scale(moved, -1);
    fram_status status = FRAM_OK;
    d.tile = cell + 1;
    for (int32_t i = 0; i < polygon_list_count(rings) && status == FRAM_OK; i++) {
        int32_t row;
        d.outline = polygon_list_get(rings, i);
        status = floe_create(ctx, &d, w->definition->smallest_piece, plane, w->bodies, w->shapes, w->floes,
                             w->next_number, &row, error);
        if (status != FRAM_OK)
            return status;
        int32_t body = w->floes->body[row];
        vec2 v = w->drift->velocity[0];
        w->bodies->velocity[body] = vec3_make(v.x, v.y, 0);
        w->drift->entered[0] += w->bodies->mass[body];
    }
    return status;
}

static fram_status let_enter(context *ctx, overlay *plane, const drift_world *w, const tile_grid *g, int32_t cell,
                             fram_error *error)
{
    polygon_list rings = {0};
    int32_array cells = {0};
    bool known;
    fram_status status = FRAM_OK;
    if (!recall(ctx, w, g->column + cell % g->columns, g->row + cell / g->columns, g->moved, &rings, &known))
        status = error_memory(error);
    else if (!known)
        status = drift_cell_rings(ctx, w->definition, g, cell, plane, &rings, &cells, error);
    if (status == FRAM_OK)
        status = make_tiles(ctx, plane, w, &rings, cell, g->moved, error);
    polygon_list_free(ctx, &rings);
    array_free(ctx, &cells);
    return status;
}

/* ---- the window moves by a column or a row ---- */

/* One of the four ways in which the window can move over the cells. */
typedef struct shift {
    int32_t columns, rows; /* -1, 0 or 1; one of them 0 */
} shift;

/* The column or row of cells that leaves, of the grid before, or that enters, of the grid after. */
static tile_range strip_cells(const tile_grid *g, shift s, bool enters)
{
    tile_range r = {0, g->columns - 1, 0, g->rows - 1};
    if (s.columns != 0)
        r.column_first = r.column_last = (s.columns > 0) == enters ? g->columns - 1 : 0;
    else
        r.row_first = r.row_last = (s.rows > 0) == enters ? g->rows - 1 : 0;
    return r;
}

static fram_status leave_strip(context *ctx, const drift_world *w, const tile_grid *g, shift s, fram_error *error)
{
    tile_index index = {0};
    tile_range r = strip_cells(g, s, false);
    bool good = tile_index_build(ctx, &index, g, w->floes);
    for (int32_t k = r.row_first; k <= r.row_last && good; k++)
        for (int32_t i = r.column_first; i <= r.column_last && good; i++)
            good = let_leave(ctx, w, g, &index, i + k * g->columns);
    tile_index_free(ctx, &index);
    return good ? FRAM_OK : error_memory(error);
}

/* Cells are numbered from the window's corner. */
static void renumber(const drift_world *w, const tile_grid *g, shift s)
{
    for (int32_t i = 0; i < w->floes->count; i++)
        if (w->floes->body[i] >= 0 && w->floes->tile[i] != 0)
            w->floes->tile[i] -= s.columns + s.rows * g->columns;
    w->drift->column[0] += s.columns;
    w->drift->row[0] += s.rows;
}

static fram_status enter_strip(context *ctx, overlay *plane, const drift_world *w, const tile_grid *g, shift s,
                               fram_error *error)
{
    tile_range r = strip_cells(g, s, true);
    fram_status status = FRAM_OK;
    for (int32_t k = r.row_first; k <= r.row_last && status == FRAM_OK; k++)
        for (int32_t i = r.column_first; i <= r.column_last && status == FRAM_OK; i++)
            status = let_enter(ctx, plane, w, g, i + k * g->columns, error);
    return status;
}

static fram_status mark_all_seams(context *ctx, const drift_world *w, const tile_grid *g, fram_error *error)
{
    tile_index index = {0};
    bool good = tile_index_build(ctx, &index, g, w->floes);
    tile_sheet_view view = {g, &index, w->bodies, w->shapes, w->floes};
    if (good)
        tile_mark_seams(&view, w->shapes, (tile_range){0, g->columns - 1, 0, g->rows - 1});
    tile_index_free(ctx, &index);
    return good ? FRAM_OK : error_memory(error);
}

static fram_status shift_window(context *ctx, overlay *plane, const drift_world *w, shift s, fram_error *error)
{
    tile_grid before = drift_grid(w->start, w->drift);
    fram_status status = leave_strip(ctx, w, &before, s, error);
    if (status != FRAM_OK)
        return status;
    renumber(w, &before, s);
    tile_grid after = drift_grid(w->start, w->drift);
    status = enter_strip(ctx, plane, w, &after, s, error);
    return status == FRAM_OK ? mark_all_seams(ctx, w, &after, error) : status;
}

/* How the window has to move so that the grid covers it: one column or row at a time; false: it does. */
static bool find_shift(const tile_grid *g, box2 window, shift *s)
{
    *s = (shift){(g->plan.hi.x < window.hi.x) - (g->plan.lo.x > window.lo.x), 0};
    if (s->columns == 0)
        s->rows = (g->plan.hi.y < window.hi.y) - (g->plan.lo.y > window.lo.y);
    return s->columns != 0 || s->rows != 0;
}

fram_status drift_shift(context *ctx, overlay *plane, const drift_world *w, fram_error *error)
{
    fram_status status = FRAM_OK;
    shift s;
    for (tile_grid g = drift_grid(w->start, w->drift); status == FRAM_OK && find_shift(&g, w->definition->window, &s);
         g = drift_grid(w->start, w->drift))
        status = shift_window(ctx, plane, w, s, error);
    return status;
}
