/* What panels bear, step by step, and the largest pressures by area. */
#include "sim/hull_pressure_parts.h"

#include <string.h>

const window_shape window_shapes[WINDOW_SHAPES] = {{1, 1}, {2, 1}, {1, 2}, {3, 1}, {1, 3}, {2, 2}, {4, 1},
                                                   {1, 4}, {3, 2}, {6, 1}, {8, 1}, {3, 3}, {4, 2}, {12, 1},
                                                   {6, 2}, {4, 4}, {8, 2}, {6, 3}, {6, 6}, {8, 8}};

/* ---- windows ---- */

/* Panel numbers grow with patch, row, column; of several parts of a cell the first counts. */
static bool is_first_of_cell(const hull_panel *p) { return p->part == 0; }

static fram_status make_grids(pressure_map *p, fram_error *error)
{
    const hull_panels *h = &p->panels;
    double cells = 0;
    p->grid = memory_array(p->ctx, (size_t)h->patch.count, sizeof *p->grid);
    if (!p->grid)
        return error_memory(error);
    for (int32_t i = 0; i < h->panel.count; i++) {
        const hull_panel *q = &h->panel.data[i];
        window_grid *g = &p->grid[q->patch];
        int32_t right = g->columns == 0 ? q->column : g->first_column + g->columns - 1;
        int32_t top = g->columns == 0 ? q->row : g->first_row + g->rows - 1;
        int32_t left = g->columns == 0 || q->column < g->first_column ? q->column : g->first_column;
        int32_t bottom = g->columns == 0 || q->row < g->first_row ? q->row : g->first_row;
        right = q->column > right ? q->column : right;
        top = q->row > top ? q->row : top;
        *g = (window_grid){left, bottom, right - left + 1, top - bottom + 1, 0, false};
    }
    for (int32_t i = 0; i < h->patch.count; i++) {
        p->grid[i].table = (int32_t)cells;
        cells += (p->grid[i].columns + 1.0) * (p->grid[i].rows + 1.0);
        /* A patch that winds through space, with few panels in many cells. */
        if (!(cells < 64.0 * PANEL_MOST))
            return error_set(error, FRAM_ERROR_INPUT, NULL, 0, "panel",
                             "panels of %g m make too fine a grid of this hull; expected larger ones",
                             p->o->rules.size);
    }
    p->sum_area = memory_array(p->ctx, (size_t)cells + 1, sizeof(double));
    p->sum_cells = memory_array(p->ctx, (size_t)cells + 1, sizeof(double));
    p->sum_force = memory_array(p->ctx, (size_t)cells + 1, sizeof(double));
    return p->sum_area && p->sum_cells && p->sum_force ? FRAM_OK : error_memory(error);
}

static int32_t table_at(const window_grid *g, int32_t column, int32_t row)
{
    return g->table + (row - g->first_row) * (g->columns + 1) + (column - g->first_column);
}

/* Values in their cells become sums over all cells below and to the left. */
static void sum_up(const window_grid *g, double *table)
{
    double *t = table + g->table;
    int32_t wide = g->columns + 1;
    for (int32_t row = 1; row <= g->rows; row++)
        for (int32_t column = 1; column <= g->columns; column++)
            t[row * wide + column] +=
                t[(row - 1) * wide + column] + t[row * wide + column - 1] - t[(row - 1) * wide + column - 1];
}

static double window_sum(const window_grid *g, const double *table, int32_t column, int32_t row, window_shape s)
{
    int32_t wide = g->columns + 1, at = table_at(g, column, row);
    return table[at + s.rows * wide + s.columns] - table[at + s.rows * wide] - table[at + s.columns] + table[at];
}

static void fill_still(pressure_map *p)
{
    for (int32_t i = 0; i < p->panels.panel.count; i++) {
        const hull_panel *q = &p->panels.panel.data[i];
        if (!is_first_of_cell(q))
            continue;
        int32_t at = table_at(&p->grid[q->patch], q->column + 1, q->row + 1);
        p->sum_area[at] = q->area;
        p->sum_cells[at] = 1;
    }
    for (int32_t i = 0; i < p->panels.patch.count; i++) {
        sum_up(&p->grid[i], p->sum_area);
        sum_up(&p->grid[i], p->sum_cells);
    }
}

static void fill_step(pressure_map *p)
{
    for (int32_t t = 0; t < p->touched.count; t++) {
        const hull_panel *q = &p->panels.panel.data[p->touched.data[t]];
        window_grid *g = &p->grid[q->patch];
        if (!g->touched)
            memset(p->sum_force + g->table, 0, (size_t)(g->columns + 1) * (size_t)(g->rows + 1) * sizeof *p->sum_force);
        g->touched = true;
        if (is_first_of_cell(q))
            p->sum_force[table_at(g, q->column + 1, q->row + 1)] = p->load[p->touched.data[t]].step;
    }
    for (int32_t i = 0; i < p->panels.patch.count; i++) {
        if (p->grid[i].touched)
            sum_up(&p->grid[i], p->sum_force);
        p->grid[i].touched = false;
    }
}

/* Windows of one shape that hold the panel, all of whose cells are there. */
static void look_around(pressure_map *p, const hull_panel *q, window_shape s, window_most *most, double time)
{
    const window_grid *g = &p->grid[q->patch];
    for (int32_t row = q->row - s.rows + 1; row <= q->row; row++) {
        for (int32_t column = q->column - s.columns + 1; column <= q->column; column++) {
            if (row < g->first_row || column < g->first_column || row + s.rows > g->first_row + g->rows ||
                column + s.columns > g->first_column + g->columns)
                continue;
            if (window_sum(g, p->sum_cells, column, row, s) < s.columns * s.rows - 0.5)
                continue;
            double area = window_sum(g, p->sum_area, column, row, s),
                   force = window_sum(g, p->sum_force, column, row, s);
            if (force > most->pressure * area)
                *most = (window_most){force / area, area, time};
        }
    }
}

/* ---- panels ---- */

fram_status pressure_begin(pressure_map *p, const mesh *hull, fram_error *error)
{
    fram_status status = hull_panels_make(p->ctx, hull, &p->o->rules, &p->panels, error);
    if (status != FRAM_OK)
        return status;
    p->load = memory_array(p->ctx, (size_t)p->panels.panel.count, sizeof *p->load);
    status = p->load ? make_grids(p, error) : error_memory(error);
    if (status == FRAM_OK)
        fill_still(p);
    return status;
}

void pressure_free(pressure_map *p)
{
    hull_panels_free(p->ctx, &p->panels);
    memory_free(p->ctx, p->load);
    array_free(p->ctx, &p->touched);
    memory_free(p->ctx, p->grid);
    memory_free(p->ctx, p->sum_area);
    memory_free(p->ctx, p->sum_cells);
    memory_free(p->ctx, p->sum_force);
    p->load = NULL;
    p->grid = NULL;
    p->sum_area = p->sum_cells = p->sum_force = NULL;
}

static int32_t panel_of(pressure_map *p, vec3 point, vec3 normal, vec3 friction)
{
    vec3 push = vec3_length(normal) > 0 ? normal : friction;
    return hull_panel_at(&p->panels, point, vec3_scale(push, -1 / vec3_length(push)));
}

static bool add_to(pressure_map *p, int32_t panel, vec3 normal, vec3 friction, double part)
{
    if (panel < 0)
        return true;
    panel_load *l = &p->load[panel];
    bool first = l->step == 0 && l->force.x == 0 && l->force.y == 0 && l->force.z == 0;
    if (first && !array_push(p->ctx, &p->touched, panel))
        return false;
    l->step += part * vec3_length(normal);
    l->force = vec3_mad(l->force, vec3_add(normal, friction), part);
    return true;
}

/* A part of what a point of a patch stands for: the parallelogram from `corner` on, which bears evenly. */
typedef struct even_load {
    vec3 corner, a, b, normal, friction;
    double part;
} even_load;

/* Lengths below which a piece goes to the panel of its middle, of the lesser of its side and a panel. */
static const double FINEST = 1.0 / 16;
enum { PIECES_MOST = 64 }; /* waiting: each of at most 40 halvings leaves one */

/* A piece, and the panels of its corners. */
typedef struct piece {
    even_load load;
    int32_t panel[4];
} piece;

/* The panel of a corner, just inside, so that a piece that ends on a line of the grid lies on one side of it: 0 that
   of `corner`, 1 along a, 2 along b, 3 across. */
static int32_t panel_of_corner(pressure_map *p, const even_load *e, int k)
{
    double s = 1e-6 + (1 - 2e-6) * (k & 1), t = 1e-6 + (1 - 2e-6) * (k >> 1);
    return panel_of(p, vec3_mad(vec3_mad(e->corner, e->a, s), e->b, t), e->normal, e->friction);
}

typedef enum halving { HALVE_NOT, HALVE_A, HALVE_B } halving;

/* Pieces longer than a panel first, so that none is passed over; then across the borders that the corners tell. */
static halving choose_halving(const even_load *e, const int32_t panel[4], double size, double least_a, double least_b)
{
    double a = vec3_length(e->a), b = vec3_length(e->b);
    if (a > size || b > size)
        return a >= b ? HALVE_A : HALVE_B;
    bool along_a = panel[0] == panel[1] && panel[2] == panel[3], along_b = panel[0] == panel[2] && panel[1] == panel[3];
    bool may_a = a > least_a && !along_a, may_b = b > least_b && !along_b;
    if (may_a && may_b)
        return a * least_b >= b * least_a ? HALVE_A : HALVE_B;
    return may_a ? HALVE_A : may_b ? HALVE_B : HALVE_NOT;
}

/* Two halves side by side, which keep the corners that they have of the whole. */
static void halve(pressure_map *p, const piece *whole, halving way, piece half[2])
{
    int along = way == HALVE_A ? 1 : 2;
    for (int i = 0; i < 2; i++) {
        half[i] = *whole;
        even_load *e = &half[i].load;
        vec3 *side = way == HALVE_A ? &e->a : &e->b;
        e->part *= 0.5;
        *side = vec3_scale(*side, 0.5);
        if (i == 1)
            e->corner = vec3_add(e->corner, *side);
        for (int k = 0; k < 4; k++)
            if (((k & along) != 0) != (i == 1))
                half[i].panel[k] = panel_of_corner(p, e, k);
    }
}

/* What is not halved goes to the panel of its corners, or of its middle where that is several. */
static bool add_piece(pressure_map *p, const piece *w)
{
    const even_load *e = &w->load;
    int32_t panel = w->panel[0];
    if (panel != w->panel[1] || panel != w->panel[2] || panel != w->panel[3])
        panel = panel_of(p, vec3_mad(vec3_mad(e->corner, e->a, 0.5), e->b, 0.5), e->normal, e->friction);
    return add_to(p, panel, e->normal, e->friction, e->part);
}

/* Halves it until each piece lies on one panel, or is too small to matter. */
static bool add_spread(pressure_map *p, even_load whole)
{
    piece wait[PIECES_MOST];
    double size = p->o->rules.size;
    double least_a = FINEST * fmin(vec3_length(whole.a), size), least_b = FINEST * fmin(vec3_length(whole.b), size);
    int32_t count = 1;
    bool good = true;
    wait[0].load = whole;
    for (int k = 0; k < 4; k++)
        wait[0].panel[k] = panel_of_corner(p, &whole, k);
    while (count > 0 && good) {
        piece w = wait[--count];
        halving way = count + 2 <= PIECES_MOST ? choose_halving(&w.load, w.panel, size, least_a, least_b) : HALVE_NOT;
        if (way == HALVE_NOT) {
            good = add_piece(p, &w);
            continue;
        }
        halve(p, &w, way, &wait[count]);
        count += 2;
    }
    return good;
}

bool pressure_add(pressure_map *p, const patch_area *area, vec3 point, vec3 normal, vec3 friction)
{
    patch_area part = patch_area_part(area, point);
    return add_spread(p, (even_load){part.middle, part.a, part.b, normal, friction, 1});
}

void pressure_end_step(pressure_map *p, double time, double time_step)
{
    fill_step(p);
    for (int32_t t = 0; t < p->touched.count; t++)
        for (int k = 0; k < WINDOW_SHAPES; k++)
            look_around(p, &p->panels.panel.data[p->touched.data[t]], window_shapes[k], &p->most[k], time);
    for (int32_t t = 0; t < p->touched.count; t++) {
        panel_load *l = &p->load[p->touched.data[t]];
        l->sum += l->step * time_step;
        l->impulse = vec3_mad(l->impulse, l->force, time_step);
        if (l->step > l->most) {
            l->most = l->step;
            l->when = time;
        }
        l->step = 0;
        l->force = (vec3){0, 0, 0};
    }
    array_clear(&p->touched);
    p->time += time_step;
}
