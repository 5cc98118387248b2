/* What a level sheet lets go of (docs/decisions/0040): tiles that no chain of seams joins to an anchored side become
   one floe, which drifts.  Where every tile is known to have hung on an anchored side before an event, the search
   begins at what changed and ends when the smaller parts are known.  Otherwise the whole sheet is searched unless the
   neighbourhood of the change holds together. */
#include "ice/fracture_parts.h"

#include <stdlib.h>
#include <string.h>

/* Cells around those that changed whose tiles must hold together. */
enum { NEIGHBOURHOOD = 2 };
/* Marks of floe rows. */
enum { MARK_NONE = 0, MARK_HELD, MARK_LOOSE };
enum { PART_OPEN = 0, PART_HELD, PART_LOOSE };

static tile_range grown(const tile_grid *g, tile_range r, int32_t by)
{
    r.column_first = r.column_first > by ? r.column_first - by : 0;
    r.row_first = r.row_first > by ? r.row_first - by : 0;
    r.column_last = r.column_last + by < g->columns ? r.column_last + by : g->columns - 1;
    r.row_last = r.row_last + by < g->rows ? r.row_last + by : g->rows - 1;
    return r;
}

static bool holds(const tile_range *r, int32_t column, int32_t row)
{
    return column >= r->column_first && column <= r->column_last && row >= r->row_first && row <= r->row_last;
}

/* Marks all tiles within the range that hang together with those on the front, which is used up; all of a mark are
   appended to `out` when it is given. */
static bool flood(const fracture_job *j, const tile_range *within, uint8_t mark, int32_array *out)
{
    fracture_scratch *s = j->scratch;
    tile_sheet_view v = fracture_sheet_view(j);
    const int32_t step[4][2] = {{-1, 0}, {1, 0}, {0, -1}, {0, 1}};
    while (s->sheet.front.count > 0) {
        int32_t row = s->sheet.front.data[--s->sheet.front.count], cell = v.floes->tile[row] - 1;
        if (out && !array_push(j->ctx, out, row))
            return false;
        for (int k = 0; k < 4; k++) {
            int32_t column = cell % v.grid->columns + step[k][0], line = cell / v.grid->columns + step[k][1];
            if (!holds(within, column, line))
                continue;
            int32_t other = v.index->first.data[column + line * v.grid->columns];
            for (; other >= 0; other = v.index->next.data[other]) {
                if (s->sheet.mark.data[other] != MARK_NONE || !(tile_seam(&v, row, other) > v.grid->least_seam))
                    continue;
                s->sheet.mark.data[other] = mark;
                if (!array_push(j->ctx, &s->sheet.front, other))
                    return false;
            }
        }
    }
    return true;
}

static bool start_marks(const fracture_job *j)
{
    fracture_scratch *s = j->scratch;
    int32_t rows = j->state->floes->count;
    array_clear(&s->sheet.front);
    if (!array_resize(j->ctx, &s->sheet.mark, rows))
        return false;
    if (rows > 0)
        memset(s->sheet.mark.data, MARK_NONE, (size_t)rows);
    return true;
}

static int32_t first_in_cell(const tile_sheet_view *v, int32_t column, int32_t row)
{
    return v->index->first.data[column + row * v->grid->columns];
}

static bool on_anchored_side(const tile_grid *g, const tile_range *r)
{
    return (r->column_first == 0 && g->anchored[SHEET_X_MIN]) || (r->row_first == 0 && g->anchored[SHEET_Y_MIN]) ||
           (r->column_last == g->columns - 1 && g->anchored[SHEET_X_MAX]) ||
           (r->row_last == g->rows - 1 && g->anchored[SHEET_Y_MAX]);
}

/* Whether the tiles around the change hang together without a look at the rest: then each of them still hangs on what
   it hung on before, by the last place where its way to the anchored side left the neighbourhood. */
static bool hangs_together(const fracture_job *j, bool *together)
{
    fracture_scratch *s = j->scratch;
    tile_sheet_view v = fracture_sheet_view(j);
    tile_range around = grown(v.grid, s->sheet.changed, NEIGHBOURHOOD);
    *together = !on_anchored_side(v.grid, &s->sheet.changed);
    if (!*together)
        return true;
    if (!start_marks(j))
        return false;
    for (int32_t k = around.row_first; k <= around.row_last; k++)
        for (int32_t i = around.column_first; i <= around.column_last; i++) {
            int32_t row = first_in_cell(&v, i, k);
            if (row >= 0 && s->sheet.front.count == 0) {
                s->sheet.mark.data[row] = MARK_HELD;
                if (!array_push(j->ctx, &s->sheet.front, row))
                    return false;
            }
        }
    if (!flood(j, &around, MARK_HELD, NULL))
        return false;
    for (int32_t k = around.row_first; k <= around.row_last; k++)
        for (int32_t i = around.column_first; i <= around.column_last; i++)
            for (int32_t row = first_in_cell(&v, i, k); row >= 0; row = v.index->next.data[row])
                *together = *together && s->sheet.mark.data[row] == MARK_HELD;
    return true;
}

/* Marks the part of the sheet that `seed` belongs to, and its area [m2]. */
static bool mark_part(const fracture_job *j, int32_t seed, uint8_t mark, double *area)
{
    fracture_scratch *s = j->scratch;
    tile_range all = {0, j->settings->tiles.columns - 1, 0, j->settings->tiles.rows - 1};
    array_clear(&s->sheet.touched);
    s->sheet.mark.data[seed] = mark;
    if (!array_push(j->ctx, &s->sheet.front, seed) || !flood(j, &all, mark, &s->sheet.touched))
        return false;
    *area = 0;
    for (int32_t i = 0; i < s->sheet.touched.count; i++)
        *area += j->state->floes->area[s->sheet.touched.data[i]];
    return true;
}

/* A drifting sheet whose edges all lie within the window hangs on nothing: its largest part is the sheet, and what came
   off that is loose. */
static bool mark_largest(const fracture_job *j)
{
    fracture_scratch *s = j->scratch;
    const floe_table *floes = j->state->floes;
    int32_t largest = -1;
    double most = 0, area;
    for (int32_t row = 0; row < s->sheet.mark.count; row++) {
        if (s->sheet.mark.data[row] != MARK_NONE || floes->body[row] < 0 || floes->tile[row] == 0)
            continue;
        if (!mark_part(j, row, MARK_LOOSE, &area))
            return false;
        largest = area > most ? row : largest;
        most = fmax(most, area);
    }
    return start_marks(j) && (largest < 0 || mark_part(j, largest, MARK_HELD, &area));
}

/* Marks all that hangs on an anchored side. */
static bool mark_held(const fracture_job *j)
{
    fracture_scratch *s = j->scratch;
    tile_sheet_view v = fracture_sheet_view(j);
    tile_range all = {0, v.grid->columns - 1, 0, v.grid->rows - 1};
    if (!start_marks(j))
        return false;
    for (int32_t row = 0; row < v.floes->count; row++) {
        if (v.floes->body[row] < 0 || v.floes->tile[row] == 0 || !tile_is_anchored(&v, row))
            continue;
        s->sheet.mark.data[row] = MARK_HELD;
        if (!array_push(j->ctx, &s->sheet.front, row))
            return false;
    }
    if (s->sheet.front.count == 0 && v.grid->drifts)
        return mark_largest(j);
    return flood(j, &all, MARK_HELD, NULL);
}

/* Lists the tiles that the whole sheet does not hold. */
static bool list_loose_everywhere(const fracture_job *j)
{
    fracture_scratch *s = j->scratch;
    const floe_table *floes = j->state->floes;
    if (!mark_held(j))
        return false;
    array_clear(&s->sheet.cut_off);
    for (int32_t row = 0; row < s->sheet.mark.count; row++)
        if (s->sheet.mark.data[row] == MARK_NONE && floes->body[row] >= 0 && floes->tile[row] != 0 &&
            !array_push(j->ctx, &s->sheet.cut_off, row))
            return false;
    return true;
}

/* ---- the search from a change ---- */

/* Every part that came loose has a tile among those in and around the cells that changed: any other tile hangs as it
   did.  So parts are grown from these, a tile of each in turn, until they meet, end, or reach an anchored side.  What
   is cut off is known when its tiles are exhausted, whatever lies on the other side. */

static int32_t part_root(sheet_work *w, int32_t part)
{
    while (w->parts.data[part].joined >= 0)
        part = w->parts.data[part].joined;
    return part;
}

/* The tile becomes the last in the front of a part. */
static bool add_to_part(const fracture_job *j, int32_t row, int32_t part)
{
    sheet_work *w = &j->scratch->sheet;
    sheet_part *p = &w->parts.data[part];
    w->mark.data[row] = MARK_HELD;
    w->part.data[row] = part;
    w->behind.data[row] = -1;
    if (p->last >= 0)
        w->behind.data[p->last] = row;
    else
        p->first = row;
    p->last = row;
    return array_push(j->ctx, &w->reached, row);
}

/* Two parts are one, held if either is; returns the root. */
static int32_t join_parts(sheet_work *w, int32_t a, int32_t b)
{
    sheet_part *to = &w->parts.data[a < b ? a : b], *from = &w->parts.data[a < b ? b : a];
    from->joined = a < b ? a : b;
    to->state = to->state == PART_HELD || from->state == PART_HELD ? PART_HELD : PART_OPEN;
    if (from->first >= 0 && to->last >= 0)
        w->behind.data[to->last] = from->first;
    else if (from->first >= 0)
        to->first = from->first;
    to->last = from->last >= 0 ? from->last : to->last;
    return from->joined;
}

static bool start_parts(const fracture_job *j)
{
    sheet_work *w = &j->scratch->sheet;
    tile_sheet_view v = fracture_sheet_view(j);
    tile_range around = grown(v.grid, w->changed, 1);
    int32_t rows = v.floes->count;
    array_clear(&w->parts);
    array_clear(&w->reached);
    array_clear(&w->open);
    if (!start_marks(j) || !array_resize(j->ctx, &w->part, rows) || !array_resize(j->ctx, &w->behind, rows))
        return false;
    for (int32_t k = around.row_first; k <= around.row_last; k++)
        for (int32_t i = around.column_first; i <= around.column_last; i++)
            for (int32_t row = first_in_cell(&v, i, k); row >= 0; row = v.index->next.data[row])
                if (!array_push(j->ctx, &w->open, w->parts.count) ||
                    !array_push(j->ctx, &w->parts, ((sheet_part){-1, -1, -1, PART_OPEN})) ||
                    !add_to_part(j, row, w->parts.count - 1))
                    return false;
    return true;
}

/* All tiles of a cell that a seam joins to this one come to its part; *part stays its root. */
static bool grow_into(const fracture_job *j, int32_t row, int32_t other, int32_t *part)
{
    sheet_work *w = &j->scratch->sheet;
    tile_sheet_view v = fracture_sheet_view(j);
    for (; other >= 0; other = v.index->next.data[other]) {
        bool marked = w->mark.data[other] != MARK_NONE;
        int32_t of = marked ? part_root(w, w->part.data[other]) : -1;
        if (of == *part || !(tile_seam(&v, row, other) > v.grid->least_seam))
            continue;
        if (marked)
            *part = join_parts(w, *part, of);
        else if (!add_to_part(j, other, *part))
            return false;
    }
    return true;
}

/* The first tile in the front of a part is looked at. */
static bool grow_part(const fracture_job *j, int32_t part)
{
    sheet_work *w = &j->scratch->sheet;
    tile_sheet_view v = fracture_sheet_view(j);
    sheet_part *p = &w->parts.data[part];
    int32_t row = p->first;
    if (row < 0) {
        p->state = PART_LOOSE;
        return true;
    }
    p->first = w->behind.data[row];
    p->last = p->first >= 0 ? p->last : -1;
    int32_t column = (v.floes->tile[row] - 1) % v.grid->columns, line = (v.floes->tile[row] - 1) / v.grid->columns;
    tile_range all = {0, v.grid->columns - 1, 0, v.grid->rows - 1}, own = {column, column, line, line};
    if (on_anchored_side(v.grid, &own) && tile_is_anchored(&v, row)) {
        p->state = PART_HELD;
        return true;
    }
    const int32_t step[4][2] = {{-1, 0}, {1, 0}, {0, -1}, {0, 1}};
    for (int k = 0; k < 4; k++)
        if (holds(&all, column + step[k][0], line + step[k][1]) &&
            !grow_into(j, row, first_in_cell(&v, column + step[k][0], line + step[k][1]), &part))
            return false;
    return true;
}

/* Drops what is no longer open; whether a part is known to be held. */
static bool keep_open(sheet_work *w)
{
    int32_t kept = 0;
    bool held = false;
    for (int32_t i = 0; i < w->open.count; i++) {
        const sheet_part *p = &w->parts.data[w->open.data[i]];
        held = held || (p->joined < 0 && p->state == PART_HELD);
        if (p->joined < 0 && p->state == PART_OPEN)
            w->open.data[kept++] = w->open.data[i];
    }
    w->open.count = kept;
    return held;
}

static int compare_loose_rows(const void *a, const void *b) { return *(const int32_t *)a - *(const int32_t *)b; }

/* Lists the tiles that a change let go of, when all hung on an anchored side before it.  One part does so still, the
   way of a tile to that side having left the cells that changed for the last time somewhere around them, unless these
   lie on the side itself: it need not be followed there once it is the only one left. */
static bool list_loose_near(const fracture_job *j)
{
    sheet_work *w = &j->scratch->sheet;
    bool one_is_held = !on_anchored_side(&j->settings->tiles, &w->changed), held = false;
    if (!start_parts(j))
        return false;
    while (w->open.count > 1 || (w->open.count == 1 && (held || !one_is_held))) {
        for (int32_t i = 0; i < w->open.count; i++) {
            const sheet_part *p = &w->parts.data[w->open.data[i]];
            if (p->joined < 0 && p->state == PART_OPEN && !grow_part(j, w->open.data[i]))
                return false;
        }
        held = keep_open(w) || held;
    }
    array_clear(&w->cut_off);
    for (int32_t i = 0; i < w->reached.count; i++) {
        int32_t row = w->reached.data[i];
        if (w->parts.data[part_root(w, w->part.data[row])].state != PART_LOOSE)
            continue;
        w->mark.data[row] = MARK_NONE;
        if (!array_push(j->ctx, &w->cut_off, row))
            return false;
    }
    if (w->cut_off.count > 1)
        qsort(w->cut_off.data, (size_t)w->cut_off.count, sizeof *w->cut_off.data, compare_loose_rows);
    return true;
}

/* ---- letting go ---- */

/* Tiles of which cleaning had made two lie over one another lose that once they are one floe; what corners that are put
   on a seam move is in here too [m2]. */
static double area_merged(const fracture_job *j)
{
    const fracture_scratch *s = j->scratch;
    double area = 0;
    for (int32_t i = 0; i < s->sheet.touched.count; i++)
        area += j->state->floes->area[s->sheet.touched.data[i]];
    for (int32_t i = 0; i < s->piece.rows.count; i++)
        area -= s->piece.rows.data[i].area;
    return area;
}

/* One outline for the tiles in sheet.touched where there is one, theirs otherwise, as pieces that move. */
static fram_status gather_loose(const fracture_job *j)
{
    fracture_scratch *s = j->scratch;
    tile_sheet_view v = fracture_sheet_view(j);
    polygon_list_clear(&s->piece.outlines);
    array_clear(&s->piece.rows);
    polygon_list_clear(&s->sheet.loose);
    polygon_list_clear(&s->sheet.united);
    for (int32_t i = 0; i < s->sheet.touched.count; i++)
        if (!tile_outline(j->ctx, &v, s->sheet.touched.data[i], &s->sheet.ring) ||
            !polygon_list_push(j->ctx, &s->sheet.loose, (polygon){s->sheet.ring.data, s->sheet.ring.count}))
            return error_memory(j->error);
    fram_status status = overlay_union(j->plane, &s->sheet.loose, &s->sheet.united, j->error);
    if (status == FRAM_ERROR_MEMORY)
        return status;
    const polygon_list *rings = status == FRAM_OK ? &s->sheet.united : &s->sheet.loose;
    return fracture_gather(j->ctx, s, rings, MOTION_DYNAMIC, 0, 0) ? FRAM_OK : error_memory(j->error);
}

static fram_status let_go(const fracture_job *j, bool *broke)
{
    fracture_scratch *s = j->scratch;
    fram_status status = gather_loose(j);
    if (status != FRAM_OK)
        return status;
    polygon first = polygon_list_get(&s->piece.outlines, 0);
    vec2 centre = polygon_moments_of(first).centroid;
    double merged = area_merged(j);
    fracture_event event = {
        .kind = FRACTURE_RELEASE,
        .area_lost = merged > 0 ? merged : 0,
        .area_gained = merged < 0 ? -merged : 0,
        .place = {centre.x, centre.y, j->state->bodies->position[j->state->floes->body[s->sheet.touched.data[0]]].z}};
    status = fracture_birth(j, s->sheet.touched.data, s->sheet.touched.count,
                            (birth_terms){.least = 1, .most = HUGE_VAL}, &event, broke);
    if (status != FRAM_OK || !*broke)
        return status;
    return array_push(j->ctx, j->events, event) ? FRAM_OK : error_memory(j->error);
}

/* Every part of the tiles that are listed becomes a floe, by their lowest rows; *all_gone stays where each did. */
static fram_status release_loose(const fracture_job *j, bool *all_gone)
{
    fracture_scratch *s = j->scratch;
    tile_range all = {0, j->settings->tiles.columns - 1, 0, j->settings->tiles.rows - 1};
    for (int32_t i = 0; i < s->sheet.cut_off.count; i++) {
        int32_t row = s->sheet.cut_off.data[i];
        if (s->sheet.mark.data[row] != MARK_NONE)
            continue;
        array_clear(&s->sheet.touched);
        s->sheet.mark.data[row] = MARK_LOOSE;
        if (!array_push(j->ctx, &s->sheet.front, row) || !flood(j, &all, MARK_LOOSE, &s->sheet.touched))
            return error_memory(j->error);
        bool broke = false;
        fram_status status = let_go(j, &broke);
        if (status != FRAM_OK)
            return status;
        *all_gone = *all_gone && broke;
        /* What was made stands in rows that were marked, or behind them, and is of no sheet. */
        if (!tile_index_build(j->ctx, &s->sheet.index, &j->settings->tiles, j->state->floes))
            return error_memory(j->error);
    }
    return FRAM_OK;
}

/* The sheet of a scratch that knows of none is looked at as a whole once; that of one that drifts, whose cells come and
   go, each time. */
static fram_status release_from_sheet(const fracture_job *j)
{
    sheet_work *w = &j->scratch->sheet;
    bool known = w->all_held, together = false;
    w->all_held = false;
    if (!known && !hangs_together(j, &together))
        return error_memory(j->error);
    if (together)
        return FRAM_OK;
    if (!(known ? list_loose_near(j) : list_loose_everywhere(j)))
        return error_memory(j->error);
    bool all_gone = true;
    fram_status status = release_loose(j, &all_gone);
    w->all_held = status == FRAM_OK && all_gone && !j->settings->tiles.drifts;
    return status;
}

fram_status fracture_release(const fracture_job *j)
{
    /* A trim that was refused after all has touched the sheet, and left no index. */
    fram_status status = fracture_sheet_index(j);
    if (status == FRAM_OK)
        status = release_from_sheet(j);
    if (status != FRAM_OK)
        return status;
    tile_sheet_view v = fracture_sheet_view(j);
    tile_mark_seams(&v, j->state->shapes, grown(v.grid, j->scratch->sheet.changed, 1));
    return FRAM_OK;
}
