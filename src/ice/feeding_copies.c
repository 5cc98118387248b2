/* Floes that the sheet has left behind, while it shows the next copy of them; see feeding.h. */
#include "ice/feeding_parts.h"

#include <math.h>

static bool is_there(const feeding_world *w, int32_t body, uint32_t generation)
{
    return body >= 0 && body_is_alive(w->bodies, body) && w->bodies->generation[body] == generation;
}

bool feeding_lives(const feeding_world *w, int32_t row)
{
    return is_there(w, w->pattern->body[row], w->pattern->generation[row]);
}

/* Whole tiles from the copy that was nearest to the window to the one that is now. */
typedef struct tiles {
    int32_t x, y;
} tiles;

/* Half a tile from the middle of the window, where places change to the other side, is farther than the sheet moved. */
static bool is_far_from_seam(const feeding_table *f, vec2 place, vec2 moved)
{
    const double rounding = 1e-6; /* of a tile */
    vec2 tile = f->tile[0], from = vec2_sub(place, vec2_scale(vec2_add(f->lo[0], f->hi[0]), 0.5));
    return fabs(from.x) + fabs(moved.x) < (0.5 - rounding) * tile.x &&
           fabs(from.y) + fabs(moved.y) < (0.5 - rounding) * tile.y;
}

static tiles jump_of(const feeding_world *w, int32_t row, vec2 before, vec2 moved)
{
    vec2 to = feeding_place(w, row), tile = w->feeding->tile[0];
    if (is_far_from_seam(w->feeding, to, moved))
        return (tiles){0, 0};
    vec2 from = feeding_place_at(w, row, before);
    vec2 jump = vec2_sub(vec2_sub(to, from), moved);
    return (tiles){(int32_t)feeding_periods(jump.x, tile.x), (int32_t)feeding_periods(jump.y, tile.y)};
}

/* Copies whose body is gone are forgotten, the others are counted from the copy that is shown now. */
static void follow_copies(const feeding_world *w, vec2 before, vec2 moved)
{
    pattern_copy_table *c = w->copies;
    int32_t kept = 0;
    for (int32_t i = 0; i < c->count; i++) {
        if (!is_there(w, c->body[i], c->generation[i]))
            continue;
        tiles jump = jump_of(w, c->row[i], before, moved);
        c->tiles_x[i] -= jump.x;
        c->tiles_y[i] -= jump.y;
        table_move_row(c, &pattern_copy_table_info, kept++, i);
    }
    c->count = kept;
}

/* The floe's body belongs to a copy that is no longer the one shown. */
static bool leave_behind(context *ctx, const feeding_world *w, int32_t row, tiles jump)
{
    pattern_copy_table *c = w->copies;
    int32_t i = c->count;
    if (!table_resize(ctx, c, &pattern_copy_table_info, i + 1))
        return false;
    c->row[i] = row;
    c->tiles_x[i] = -jump.x;
    c->tiles_y[i] = -jump.y;
    c->body[i] = w->pattern->body[row];
    c->generation[i] = w->pattern->generation[row];
    w->pattern->body[row] = -1;
    return true;
}

/* The sheet has come back to copies whose body is there still. */
static void take_back(const feeding_world *w)
{
    pattern_copy_table *c = w->copies;
    int32_t kept = 0;
    for (int32_t i = 0; i < c->count; i++) {
        if (c->tiles_x[i] == 0 && c->tiles_y[i] == 0) {
            w->pattern->body[c->row[i]] = c->body[i];
            w->pattern->generation[c->row[i]] = c->generation[i];
            w->near->is_known = false; /* the floe may not be listed, and lives again */
            continue;
        }
        table_move_row(c, &pattern_copy_table_info, kept++, i);
    }
    c->count = kept;
}

fram_status feeding_copies_step(context *ctx, const feeding_world *w, vec2 before, vec2 moved, fram_error *error)
{
    follow_copies(w, before, moved);
    for (int32_t i = 0; i < w->near->row.count; i++) {
        int32_t row = w->near->row.data[i];
        if (!feeding_lives(w, row))
            continue;
        tiles jump = jump_of(w, row, before, moved);
        if ((jump.x != 0 || jump.y != 0) && !leave_behind(ctx, w, row, jump))
            return error_memory(error);
    }
    take_back(w);
    return FRAM_OK;
}
