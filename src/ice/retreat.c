/* Ways of hulls that draw back; see retreat.h. */
#include "ice/retreat.h"

#define TABLE_SELF hull_retreat_table
TABLE_DEFINE(hull_retreat, HULL_RETREAT_FIELDS)
#undef TABLE_SELF

/* Whether the way stands in the floe's own row. */
static bool is_first(const body_table *bodies, int32_t surface) { return bodies->owner[surface] <= 0; }

/* The first row that is not before this floe and hull. */
static int32_t first_row_from(const hull_retreat_table *t, int32_t floe, int32_t surface)
{
    int32_t low = 0, high = t->count;
    while (low < high) {
        int32_t middle = low + (high - low) / 2;
        bool before = t->floe[middle] != floe ? t->floe[middle] < floe : t->surface[middle] < surface;
        *(before ? &low : &high) = before ? middle + 1 : middle;
    }
    return low;
}

static bool is_at(const hull_retreat_table *t, int32_t row, int32_t floe, int32_t surface)
{
    return row < t->count && t->floe[row] == floe && t->surface[row] == surface;
}

vec3 retreat_find(const hull_retreat_table *t, const body_table *bodies, const floe_table *floes, int32_t floe,
                  int32_t surface)
{
    if (is_first(bodies, surface))
        return floes->retreat[floe];
    int32_t row = first_row_from(t, floe, surface);
    return is_at(t, row, floe, surface) && t->number[row] == floes->number[floe] ? t->way[row] : (vec3){0, 0, 0};
}

bool retreat_keep(context *ctx, hull_retreat_table *t, const body_table *bodies, floe_table *floes, int32_t floe,
                  int32_t surface, vec3 way)
{
    if (is_first(bodies, surface)) {
        floes->retreat[floe] = way;
        return true;
    }
    int32_t row = first_row_from(t, floe, surface);
    if (!is_at(t, row, floe, surface)) {
        if (way.x == 0 && way.y == 0 && way.z == 0)
            return true;
        if (!table_resize(ctx, t, &hull_retreat_table_info, t->count + 1))
            return false;
        for (int32_t i = t->count - 1; i > row; i--)
            table_move_row(t, &hull_retreat_table_info, i, i - 1);
    }
    t->floe[row] = floe;
    t->number[row] = floes->number[floe];
    t->surface[row] = surface;
    t->way[row] = way;
    return true;
}

bool retreat_sweep(context *ctx, hull_retreat_table *t, const floe_table *floes)
{
    int32_t kept = 0;
    for (int32_t i = 0; i < t->count; i++) {
        int32_t floe = t->floe[i];
        vec3 way = t->way[i];
        bool there = floe < floes->count && floes->body[floe] >= 0 && floes->number[floe] == t->number[i];
        if (!there || (way.x == 0 && way.y == 0 && way.z == 0))
            continue;
        if (kept != i)
            table_move_row(t, &hull_retreat_table_info, kept, i);
        kept++;
    }
    return kept == t->count || table_resize(ctx, t, &hull_retreat_table_info, kept);
}
