#include "fluid/prism_room.h"

#include "base/pool.h"
#include "fluid/prism_pack.h"

/* Of an outline that is cut in few places, and of one so short that it may be cut anywhere. */
enum { CROSSINGS = 16, LEAST_CROSSED = 40 };
/* Bytes of a line of the cache. */
enum { LINE = 64 };
/* Lanes of numbers for each point: outlines have two coordinates, and so have the two rooms of a kernel. */
enum { NUMBERS = 2 * PRISM_RINGS + 1 + 2 * 2 };

int32_t prism_most_crossed(int32_t points)
{
    return points + CROSSINGS > LEAST_CROSSED ? points + CROSSINGS : LEAST_CROSSED;
}

/* Vertices of the longest outline.  Four at once: one after the other they would wait for each other. */
static int32_t longest(const shape_table *s)
{
    int32_t most[4] = {0}, row = 0;
    for (; row + 4 <= s->count; row += 4)
        for (int i = 0; i < 4; i++)
            most[i] = s->outline_count[row + i] > most[i] ? s->outline_count[row + i] : most[i];
    for (; row < s->count; row++)
        most[0] = s->outline_count[row] > most[0] ? s->outline_count[row] : most[0];
    for (int i = 1; i < 4; i++)
        most[0] = most[i] > most[0] ? most[i] : most[0];
    return most[0];
}

static size_t size_of(const prism_rooms *r) { return (size_t)r->points * NUMBERS * sizeof(prism_lane); }

bool prism_rooms_make(context *ctx, const shape_table *shapes, prism_rooms *out)
{
    int32_t points = prism_points(longest(shapes));
    out->points = prism_most_crossed(points < PRISM_MOST_POINTS ? points : PRISM_MOST_POINTS) + 1;
    out->memory = memory_resize(ctx, NULL, (size_t)context_threads(ctx) * size_of(out) + LINE);
    return out->memory != NULL;
}

void prism_rooms_free(context *ctx, prism_rooms *r) { memory_free(ctx, r->memory); }

prism_room prism_room_of(const prism_rooms *r, int32_t thread)
{
    prism_room room;
    char *first = (char *)r->memory + (LINE - (uintptr_t)r->memory % LINE) + (size_t)thread * size_of(r);
    prism_lane *at = (prism_lane *)(void *)first;
    for (int i = 0; i < PRISM_RINGS; i++, at += 2 * r->points)
        room.ring[i] = (prism_corner *)(void *)at;
    room.depth = at;
    at += r->points;
    for (int i = 0; i < 2; i++, at += 2 * r->points)
        room.own[i] = at[0];
    return room;
}
