/* Level ice breaks (docs/decisions/0040): the stencil of a load cuts the tiles that it reaches, and no others; what it
   takes out of several tiles is one piece.  All in the global plan. */
#include "ice/fracture_parts.h"

#include "base/transcendental.h"

#include <string.h>

tile_sheet_view fracture_sheet_view(const fracture_job *j)
{
    const fracture_state *s = j->state;
    return (tile_sheet_view){&j->settings->tiles, &j->scratch->sheet.index, s->bodies, s->shapes, s->floes};
}

fram_status fracture_sheet_index(const fracture_job *j)
{
    fracture_scratch *s = j->scratch;
    if (!s->sheet.index_is_made && !tile_index_build(j->ctx, &s->sheet.index, &j->settings->tiles, j->state->floes))
        return error_memory(j->error);
    s->sheet.index_is_made = true;
    return FRAM_OK;
}

double fracture_sheet_reach(const tile_grid *g)
{
    return fmin((g->plan.hi.x - g->plan.lo.x) / g->columns, (g->plan.hi.y - g->plan.lo.y) / g->rows);
}

static box2 box_around(vec2 centre, double reach)
{
    return (box2){{centre.x - reach, centre.y - reach}, {centre.x + reach, centre.y + reach}};
}

/* ---- where cracks start ---- */

/* The nearest of the boundary's points, and the mean of the inward normals there.  false: there is none within reach.
 */
static bool nearest_start(const tile_segment_array *boundary, vec2 load, double reach, double snap, crack_start *start)
{
    const tile_segment *best = NULL;
    double least = reach;
    for (int32_t i = 0; i < boundary->count; i++) {
        const tile_segment *e = &boundary->data[i];
        if (!segment_may_reach(e->a, e->b, load, least))
            continue;
        vec2 near = segment_nearest(e->a, e->b, load);
        double distance = vec2_length(vec2_sub(near, load));
        if (distance < least) {
            least = distance;
            best = e;
            *start = (crack_start){near, -1, e->normal, distance};
        }
    }
    if (!best)
        return false;
    for (int k = 0; k < 2; k++) {
        vec2 corner = k ? best->b : best->a;
        if (vec2_length(vec2_sub(corner, start->point)) <= snap)
            start->point = corner;
    }
    vec2 sum = {0, 0};
    for (int32_t i = 0; i < boundary->count; i++) {
        const tile_segment *e = &boundary->data[i];
        if (segment_may_reach(e->a, e->b, start->point, 2 * snap) &&
            vec2_length(vec2_sub(segment_nearest(e->a, e->b, start->point), start->point)) <= snap)
            sum = vec2_add(sum, e->normal);
    }
    double length = vec2_length(sum);
    if (length > 0)
        start->direction = vec2_scale(sum, 1 / length);
    return true;
}

fram_status fracture_sheet_boundary(const fracture_job *j, vec2 place, double reach, tile_segment_array *out)
{
    fram_status status = fracture_sheet_index(j);
    if (status != FRAM_OK)
        return status;
    tile_sheet_view v = fracture_sheet_view(j);
    tile_range range;
    if (!tile_range_of(v.grid, box_around(place, reach), &range))
        return FRAM_OK;
    return tile_boundary(j->ctx, &v, range, out) ? FRAM_OK : error_memory(j->error);
}

fram_status fracture_sheet_start(const fracture_job *j, vec2 load, double reach, double radius, crack_start *start,
                                 bool *found)
{
    tile_segment_array *boundary = &j->scratch->sheet.boundary;
    array_clear(boundary);
    fram_status status = fracture_sheet_boundary(j, load, reach, boundary);
    *found = status == FRAM_OK && nearest_start(boundary, load, reach, CRACK_CORNER_REACH * radius, start);
    return status;
}

double fracture_sheet_crack_length(const fracture_job *j, const crack_start *start, double snap, bool past_held)
{
    const tile_segment_array *boundary = &j->scratch->sheet.boundary;
    const tile_grid *grid = &j->settings->tiles;
    double least = HUGE_VAL;
    for (int32_t i = 0; i < boundary->count; i++) {
        const tile_segment *e = &boundary->data[i];
        double length = least;
        crack_shorten(start, e->a, e->b, snap, &length);
        if (length < least && !(past_held && tile_grid_is_held(grid, e->a, e->b)))
            least = length;
    }
    return least;
}

/* ---- how much ice is where ---- */

fram_status fracture_sheet_areas(const fracture_job *j, const vec2 *corner, const int32_t *size, int count, double *out)
{
    fracture_scratch *s = j->scratch;
    tile_sheet_view v = fracture_sheet_view(j);
    int32_t corners = 0;
    for (int i = 0; i < count; i++)
        corners += size[i];
    tile_range range;
    if (!tile_range_of(v.grid, polygon_bounds((polygon){corner, corners}), &range))
        return FRAM_OK;
    for (int32_t k = range.row_first; k <= range.row_last; k++)
        for (int32_t i = range.column_first; i <= range.column_last; i++)
            for (int32_t row = s->sheet.index.first.data[i + k * v.grid->columns]; row >= 0;
                 row = s->sheet.index.next.data[row]) {
                if (!tile_outline(j->ctx, &v, row, &s->sheet.ring))
                    return error_memory(j->error);
                const vec2 *at = corner;
                for (int m = 0; m < count; at += size[m], m++)
                    out[m] += polygon_overlap_area((polygon){s->sheet.ring.data, s->sheet.ring.count},
                                                   (polygon){at, size[m]});
            }
    return FRAM_OK;
}

/* ---- cutting ---- */

/* Rings of the list that rounding moved off the cell's sides go back there. */
static bool snap_rings(const fracture_job *j, polygon_list *rings, int32_t cell)
{
    fracture_scratch *s = j->scratch;
    polygon_list_clear(&s->sheet.snapped);
    for (int32_t i = 0; i < polygon_list_count(rings); i++) {
        polygon p = polygon_list_get(rings, i);
        if (!array_resize(j->ctx, &s->sheet.snapped_ring, p.count))
            return false;
        memcpy(s->sheet.snapped_ring.data, p.vertex, (size_t)p.count * sizeof *p.vertex);
        tile_snap(&j->settings->tiles, cell, &s->sheet.snapped_ring);
        p = (polygon){s->sheet.snapped_ring.data, s->sheet.snapped_ring.count};
        if (p.count >= 3 && polygon_area(p) > 0 && !polygon_list_push(j->ctx, &s->sheet.snapped, p))
            return false;
    }
    polygon_list swap = *rings;
    *rings = s->sheet.snapped;
    s->sheet.snapped = swap;
    return true;
}

/* One tile under the stencil: its remnants and the parts of the wedges inside it join the cut pieces. */
static fram_status cut_tile(const fracture_job *j, int32_t row, const break_shape *shape)
{
    fracture_scratch *s = j->scratch;
    tile_sheet_view v = fracture_sheet_view(j);
    int32_t tile = j->state->floes->tile[row];
    if (!tile_outline(j->ctx, &v, row, &s->sheet.ring))
        return error_memory(j->error);
    polygon ring = {s->sheet.ring.data, s->sheet.ring.count};
    polygon stencil = {shape->outline, shape->count};
    if (!(polygon_overlap_area(ring, stencil) > 0))
        return FRAM_OK;
    polygon_list_clear(&s->sheet.remnants);
    fram_status status = overlay_difference(j->plane, ring, stencil, &s->sheet.remnants, j->error);
    if (status != FRAM_OK)
        return status;
    if (!array_push(j->ctx, &s->sheet.touched, row) || !snap_rings(j, &s->sheet.remnants, tile - 1) ||
        !fracture_gather(j->ctx, s, &s->sheet.remnants, fracture_motion(j, row), tile, 0))
        return error_memory(j->error);
    bool convex = polygon_is_convex(ring);
    for (int i = 0; i < shape->parts; i++) {
        polygon corner = {shape->part[i], shape->corners[i]};
        polygon_list_clear(&s->sheet.wedge_parts);
        status = fracture_cut_wedge(j->ctx, j->plane, ring, convex, corner, &s->sheet.wedge_parts, j->error);
        if (status != FRAM_OK)
            return status;
        if (!snap_rings(j, &s->sheet.wedge_parts, tile - 1) ||
            !fracture_gather(j->ctx, s, &s->sheet.wedge_parts, MOTION_DYNAMIC, tile, i + 1))
            return error_memory(j->error);
    }
    return FRAM_OK;
}

/* Parts of one wedge on both sides of a seam become one again. */
static fram_status unite_wedges(const fracture_job *j)
{
    fracture_scratch *s = j->scratch;
    for (int32_t i = 0; i < s->piece.rows.count; i++) {
        for (int32_t k = 0; k < s->piece.rows.count; k++) {
            const cut_piece *a = &s->piece.rows.data[i], *b = &s->piece.rows.data[k];
            bool joined = false;
            if (i == k || a->wedge == 0 || a->wedge != b->wedge || (a->tile != 0 && a->tile == b->tile))
                continue;
            fram_status status = fracture_unite(j->ctx, s, j->plane, i, k, &joined, j->error);
            if (status != FRAM_OK)
                return status;
            if (!joined)
                continue;
            fracture_drop_piece(s, i);
            i = -1; /* from the beginning: there are few */
            break;
        }
    }
    return FRAM_OK;
}

void fracture_sheet_touch(const fracture_job *j)
{
    fracture_scratch *s = j->scratch;
    tile_range *c = &s->sheet.changed;
    for (int32_t i = 0; i < s->sheet.touched.count; i++) {
        int32_t cell = j->state->floes->tile[s->sheet.touched.data[i]] - 1;
        int32_t column = cell % j->settings->tiles.columns, row = cell / j->settings->tiles.columns;
        if (!s->sheet.has_changed)
            *c = (tile_range){column, column, row, row};
        s->sheet.has_changed = true;
        c->column_first = column < c->column_first ? column : c->column_first;
        c->column_last = column > c->column_last ? column : c->column_last;
        c->row_first = row < c->row_first ? row : c->row_first;
        c->row_last = row > c->row_last ? row : c->row_last;
    }
}

fram_status fracture_sheet_changed(const fracture_job *j)
{
    j->scratch->sheet.index_is_made = false;
    return fracture_sheet_index(j);
}

/* A geometry that admits no sound cut leaves the sheet as it is, for this step. */
static fram_status or_refuse(const fracture_job *j, fram_status status, bool *refused)
{
    *refused = status == FRAM_ERROR_INTERNAL || status == FRAM_ERROR_INPUT;
    if (*refused)
        log_write(j->ctx, LOG_DEBUG, "level ice could not be cut in bending: %s", j->error ? j->error->message : "");
    return *refused ? FRAM_OK : status;
}

static fram_status cut_sheet(const fracture_job *j, const fracture_load *l, const crack_start *start)
{
    fracture_scratch *s = j->scratch;
    const tile_grid *g = &j->settings->tiles;
    double radius = l->stress.breaking_radius;
    break_size size = fracture_break_size(j->settings, l);
    break_shape shape;
    fracture_shape(j->settings->wedges, start, &size, &shape);
    tile_range range;
    bool refused = false, broke;
    polygon_list_clear(&s->piece.outlines);
    array_clear(&s->piece.rows);
    array_clear(&s->sheet.touched);
    if (!tile_range_of(g, polygon_bounds((polygon){shape.outline, shape.count}), &range))
        return FRAM_OK;
    fram_status status = FRAM_OK;
    for (int32_t k = range.row_first; k <= range.row_last; k++)
        for (int32_t i = range.column_first; i <= range.column_last; i++)
            for (int32_t row = s->sheet.index.first.data[i + k * g->columns]; row >= 0;
                 row = s->sheet.index.next.data[row]) {
                status = or_refuse(j, cut_tile(j, row, &shape), &refused);
                if (status != FRAM_OK || refused)
                    return status;
            }
    if (s->sheet.touched.count == 0)
        return FRAM_OK;
    status = unite_wedges(j);
    if (status != FRAM_OK)
        return status;
    double z = j->state->bodies->position[j->state->floes->body[s->sheet.touched.data[0]]].z;
    vec3 place = {start->point.x, start->point.y, z};
    fracture_event event = fracture_event_of(l, place, FRACTURE_BENDING, radius);
    fracture_sheet_touch(j);
    edge_bend bend = fracture_bend_of(j, l, start);
    status = fracture_birth(j, s->sheet.touched.data, s->sheet.touched.count,
                            (birth_terms){.least = 2, .most = HUGE_VAL, .bends = &bend}, &event, &broke);
    if (status != FRAM_OK || !broke)
        return status;
    return array_push(j->ctx, j->events, event) ? fracture_sheet_changed(j) : error_memory(j->error);
}

/* ---- all loads of the sheet ---- */

static fram_status find_starts(const fracture_job *j, const fracture_load *load, int32_t count)
{
    fracture_scratch *s = j->scratch;
    double reach = fracture_sheet_reach(&j->settings->tiles);
    if (!array_resize(j->ctx, &s->sheet.starts, count))
        return error_memory(j->error);
    for (int32_t i = 0; i < count; i++) {
        bool found;
        fram_status status = fracture_sheet_start(j, load[i].place, reach, load[i].stress.breaking_radius,
                                                  &s->sheet.starts.data[i], &found);
        if (status != FRAM_OK)
            return status;
        if (!found)
            s->sheet.starts.data[i].distance = -1;
    }
    return FRAM_OK;
}

/* The crack's start, unless an earlier stencil took it; its direction on the boundary that is left. */
static fram_status renew_start(const fracture_job *j, const fracture_load *l, crack_start *start, bool *is_there)
{
    double radius = l->stress.breaking_radius, distance = start->distance;
    vec2 point = start->point;
    fram_status status = fracture_sheet_start(j, point, radius, radius, start, is_there);
    if (status != FRAM_OK || !*is_there)
        return status;
    *is_there = start->distance <= CRACK_GONE_REACH * radius;
    if (*is_there && j->settings->wedge_room)
        *is_there = fracture_sheet_crack_length(j, start, CRACK_CORNER_REACH * radius, false) > radius;
    start->distance = distance;
    return FRAM_OK;
}

fram_status fracture_break_sheet(const fracture_job *j, const fracture_load *load, int32_t count)
{
    fram_status status = fracture_sheet_index(j);
    if (status == FRAM_OK)
        status = find_starts(j, load, count);
    for (int32_t i = 0; i < count && status == FRAM_OK; i++) {
        crack_start start = j->scratch->sheet.starts.data[i];
        bool there;
        if (load[i].wedge_ratio < 1 || start.distance < 0)
            continue;
        status = renew_start(j, &load[i], &start, &there);
        if (status == FRAM_OK && there)
            status = cut_sheet(j, &load[i], &start);
    }
    return status;
}
