/* Where the surface of a patch goes into the ice, and where it slides along it or leaves; see patch.h. */
#include "ice/patch_parts.h"

/* The surface slides along the ice where the way that it goes in is under this part of its whole way: 6 degrees, more
   than a shoulder turns from facet to facet, less than most bows stand to their way [1].  Range 0.01 to 0.2. */
static const double SLIDING = 0.1;

/* Bisections of the side of a part on which the motion changes kind: to rounding of its length. */
enum { BISECTIONS = 52 };

/* Whether a place of the surface, outward normal of any length, goes into the ice, not along it or away.  At rest none
   goes anywhere. */
static bool enters_at(const patch_surface *surface, vec3 normal, double length, vec3 place)
{
    vec3 u = vec3_add(surface->slip, vec3_cross(surface->turn, place));
    double speed = vec3_length(u);
    return speed > surface->rest && vec3_dot(u, normal) > SLIDING * speed * length;
}

static bool part_enters(const patch_surface *surface, const patch_part *part)
{
    return enters_at(surface, part->area, part->surface, part->centre);
}

/* The corners of a part by whether they go into the ice, with the two places between them where that changes. */
typedef struct motion_cut {
    vec3 corner[2][PATCH_MOST_CORNERS + 1];
    int32_t count[2];
    int changes;
} motion_cut;

/* Where on the way from a corner to the next the motion changes kind. */
static vec3 find_change(const patch_surface *surface, const patch_part *part, vec3 a, vec3 b, bool enters)
{
    double lo = 0, hi = 1;
    vec3 way = vec3_sub(b, a);
    for (int i = 0; i < BISECTIONS; i++) {
        double middle = 0.5 * (lo + hi);
        if (enters_at(surface, part->area, part->surface, vec3_mad(a, way, middle)) == enters)
            lo = middle;
        else
            hi = middle;
    }
    return vec3_mad(a, way, lo);
}

static void cut_by_motion(const patch_surface *surface, const patch_part *part, const vec3 *v, motion_cut *out)
{
    bool enters[PATCH_MOST_CORNERS] = {false};
    out->count[0] = out->count[1] = out->changes = 0;
    for (int32_t i = 0; i < part->count; i++)
        enters[i] = enters_at(surface, part->area, part->surface, v[i]);
    for (int32_t i = 0, last = part->count - 1; i < part->count; last = i++)
        out->changes += enters[i] != enters[last];
    for (int32_t i = 0; i < part->count && out->changes == 2; i++) {
        int32_t next = i + 1 < part->count ? i + 1 : 0, kind = enters[i];
        out->corner[kind][out->count[kind]++] = v[i];
        if (enters[i] == enters[next])
            continue;
        vec3 change = find_change(surface, part, v[i], v[next], enters[i]);
        for (int k = 0; k < 2; k++)
            out->corner[k][out->count[k]++] = change;
    }
}

/* The corners of one kind of a cut as a part of their own; false where that is next to nothing. */
static bool take_kind(const motion_cut *cut, int kind, double tolerance, patch_part *part)
{
    part->enters = kind == 1;
    part->divided = true;
    part->count = cut->count[kind];
    patch_part_measure(cut->corner[kind], part->count, part);
    return part->surface > tolerance * tolerance;
}

/* What slides comes first, in the place of the whole part, then what enters. */
static bool put_kinds(context *ctx, patch_scratch *s, const motion_cut *cut, const patch_part part[2], int32_t number)
{
    if (!array_reserve(ctx, &s->corners, s->corners.count + part[0].count + part[1].count) ||
        !array_push(ctx, &s->parts, part[1]))
        return false;
    patch_part *all = s->parts.data;
    for (int32_t i = s->parts.count - 1; i > number + 1; i--)
        all[i] = all[i - 1];
    for (int kind = 0; kind < 2; kind++) {
        all[number + kind] = part[kind];
        all[number + kind].first = s->corners.count;
        for (int32_t i = 0; i < part[kind].count; i++)
            s->corners.data[s->corners.count++] = cut->corner[kind][i];
    }
    return true;
}

/* Where the motion changes kind in a part is a piece of a conic, for which its chord stands: on a plane side that turns
   about a line in it or across it, it is that. */
static bool divide_part(context *ctx, patch_scratch *s, const patch_surface *surface, double tolerance, int32_t number)
{
    patch_part part[2] = {s->parts.data[number], s->parts.data[number]};
    motion_cut cut;
    cut_by_motion(surface, &part[0], s->corners.data + part[0].first, &cut);
    if (cut.changes != 2 || !take_kind(&cut, 0, tolerance, &part[0]) || !take_kind(&cut, 1, tolerance, &part[1]))
        return true;
    return put_kinds(ctx, s, &cut, part, number);
}

bool patch_divide_by_motion(context *ctx, patch_scratch *s, const patch_surface *surface, const patch_floe *floe)
{
    double tolerance = tolerance_of(floe);
    bool moves = vec3_dot(surface->slip, surface->slip) > 0 || vec3_dot(surface->turn, surface->turn) > 0;
    bool turns = vec3_dot(surface->turn, surface->turn) > 0;
    for (int32_t i = 0; i < s->parts.count; i++) {
        int32_t before = s->parts.count;
        s->parts.data[i].enters = moves && part_enters(surface, &s->parts.data[i]);
        if (turns && !divide_part(ctx, s, surface, tolerance, i))
            return false;
        i += s->parts.count - before;
    }
    for (int32_t i = 0; i < s->parts.count; i++)
        s->parts.data[i].root = s->parts.data[i].whole = i;
    return true;
}
