/* Fields that repeat themselves: whether floes are a tile of one. */
#include "ice/import_parts.h"

static bool tile_holds(box2 tile, box2 floe)
{
    return tile.lo.x <= floe.lo.x && tile.lo.y <= floe.lo.y && floe.hi.x <= tile.hi.x && floe.hi.y <= tile.hi.y;
}

/* A generated floe may lie outside of its tile, beside the edge that its site is at; what is farther off is of a field
   that is larger than the tile. */
static bool is_near_tile(box2 tile, box2 floe)
{
    vec2 wide = vec2_sub(floe.hi, floe.lo);
    return floe.lo.x < tile.hi.x + wide.x && floe.hi.x > tile.lo.x - wide.x && floe.lo.y < tile.hi.y + wide.y &&
           floe.hi.y > tile.lo.y - wide.y;
}

/* Appends the eight copies of an outline around it. */
static bool add_copies(context *ctx, polygon p, vec2 period, vec2_array *ring, polygon_list *out)
{
    for (int n = 0; n < 9; n++) {
        int column = n % 3 - 1, row = n / 3 - 1;
        vec2 by = {column * period.x, row * period.y};
        array_clear(ring);
        for (int32_t k = 0; n != 4 && k < p.count; k++)
            if (!array_push(ctx, ring, vec2_add(p.vertex[k], by)))
                return false;
        if (n != 4 && !polygon_list_push(ctx, out, (polygon){ring->data, ring->count}))
            return false;
    }
    return true;
}

/* All floes, and the copies of those that reach over the edge; home: none is too far from the tile; over: some reach
   over its edge. */
static fram_status list_copies(context *ctx, box2 tile, const polygon_list *floes, polygon_list *out, bool *home,
                               bool *over, fram_error *error)
{
    vec2_array ring = {0};
    bool good = true;
    *home = true;
    *over = false;
    for (int32_t i = 0; good && *home && i < polygon_list_count(floes); i++) {
        polygon p = polygon_list_get(floes, i);
        box2 box = polygon_bounds(p);
        *home = is_near_tile(tile, box);
        good = polygon_list_push(ctx, out, p);
        if (tile_holds(tile, box))
            continue;
        *over = true;
        good = good && add_copies(ctx, p, vec2_sub(tile.hi, tile.lo), &ring, out);
    }
    array_free(ctx, &ring);
    return good ? FRAM_OK : error_memory(error);
}

fram_status import_fits_tile(context *ctx, const import_options *options, const polygon_list *floes, bool *fits,
                             fram_error *error)
{
    polygon_list all = {0};
    import_pair_array pairs = {0};
    bool home, over;
    fram_status status = list_copies(ctx, options->domain, floes, &all, &home, &over, error);
    if (status == FRAM_OK && home && over)
        status = import_pairs(ctx, options->name, &all, &pairs, error);
    *fits = home && pairs.count == 0;
    array_free(ctx, &pairs);
    polygon_list_free(ctx, &all);
    return status;
}
