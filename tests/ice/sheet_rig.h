/* A level sheet of tiles under given loads. */
#ifndef SHEET_RIG_H
#define SHEET_RIG_H

#include "fracture_rig.h"

static inline tile_sheet_view sheet_view(const fracture_rig *r, const tile_index *index)
{
    return (tile_sheet_view){&r->settings.tiles, index, &r->bodies, &r->shapes, &r->floes};
}

/* Index made anew; free it with tile_index_free. */
static inline tile_index sheet_index(fracture_rig *r)
{
    tile_index index = {0};
    ck_assert(tile_index_build(&r->ctx, &index, &r->settings.tiles, &r->floes));
    return index;
}

/* A sheet over a rectangle, 1 m thick, held on all sides; false without memory. */
static inline bool sheet_try(fracture_rig *r, box2 plan, double size, const polygon_list *openings, fram_error *e)
{
    polygon_list outlines = {0}, none = {0};
    int32_array cells = {0};
    r->settings.tiles = tile_grid_over(plan, size);
    r->settings.tiles.least_seam = r->settings.edge_threshold;
    for (int i = 0; i < SHEET_SIDES; i++)
        r->settings.tiles.anchored[i] = true;
    bool good = tile_sheet(&r->ctx, &r->settings.tiles, r->plane, openings ? openings : &none,
                           r->settings.smallest_floe_area, &outlines, &cells, e) == FRAM_OK;
    for (int32_t i = 0; i < polygon_list_count(&outlines) && good; i++) {
        int32_t row;
        floe_definition d = {.outline = polygon_list_get(&outlines, i),
                             .thickness = 1,
                             .material = FRACTURE_RIG_ICE,
                             .breakable = true,
                             .motion = MOTION_STATIC,
                             .parent = -1,
                             .tile = cells.data[i] + 1};
        good = floe_create(&r->ctx, &d, r->settings.smallest_piece_area, r->plane, &r->bodies, &r->shapes, &r->floes,
                           &r->next_number, &row, e) == FRAM_OK;
    }
    tile_index index = {0};
    good = good && tile_index_build(&r->ctx, &index, &r->settings.tiles, &r->floes);
    tile_sheet_view v = sheet_view(r, &index);
    if (good)
        tile_mark_seams(&v, &r->shapes, (tile_range){0, r->settings.tiles.columns - 1, 0, r->settings.tiles.rows - 1});
    tile_index_free(&r->ctx, &index);
    polygon_list_free(&r->ctx, &outlines);
    array_free(&r->ctx, &cells);
    return good;
}

static inline void sheet_make(fracture_rig *r, box2 plan, double size, const polygon_list *openings)
{
    fram_error e = {0};
    ck_assert_msg(sheet_try(r, plan, size, openings, &e), "%s", e.message);
}

/* The tile nearest to a point. */
static inline int32_t sheet_tile_at(const fracture_rig *r, vec2 place)
{
    int32_t best = -1;
    double least = HUGE_VAL;
    for (int32_t i = 0; i < r->floes.count; i++) {
        if (r->floes.body[i] < 0 || r->floes.tile[i] == 0)
            continue;
        vec3 at = r->bodies.position[r->floes.body[i]];
        polygon p = fracture_rig_outline(r, i);
        vec2 local = {place.x - at.x, place.y - at.y};
        vec2 near = polygon_nearest_boundary(p, local, NULL);
        double way = polygon_contains(p, local) ? 0 : vec2_length(vec2_sub(near, local));
        if (way < least) {
            least = way;
            best = i;
        }
    }
    return best;
}

/* A load straight down at a place of the global plan. */
static inline bool sheet_load(fracture_rig *r, vec2 place, double load, double area)
{
    int32_t row = sheet_tile_at(r, place);
    ck_assert_int_ge(row, 0);
    vec3 at = r->bodies.position[r->floes.body[row]];
    if (!fracture_rig_load(r, row, (vec2){place.x - at.x, place.y - at.y}, load, area))
        return false;
    crushing_patch *p = &r->patches.data[r->patches.count - 1];
    p->plan = (box2){{place.x - at.x, place.y - at.y}, {place.x - at.x, place.y - at.y}};
    return true;
}

static inline double sheet_area(const fracture_rig *r, bool tiles)
{
    double sum = 0;
    for (int32_t i = 0; i < r->floes.count; i++)
        if (r->floes.body[i] >= 0 && (r->floes.tile[i] != 0) == tiles)
            sum += r->floes.area[i];
    return sum;
}

static inline int sheet_count(const fracture_rig *r, bool tiles)
{
    int sum = 0;
    for (int32_t i = 0; i < r->floes.count; i++)
        sum += r->floes.body[i] >= 0 && (r->floes.tile[i] != 0) == tiles;
    return sum;
}

/* The broken-off floes are taken out. */
static inline void sheet_clear_pieces(fracture_rig *r)
{
    for (int32_t i = 0; i < r->floes.count; i++)
        if (r->floes.body[i] >= 0 && r->floes.tile[i] == 0)
            floe_remove(&r->bodies, &r->shapes, &r->floes, i);
    ck_assert_int_eq(shape_compact(&r->ctx, &r->shapes), FRAM_OK);
}

#endif
