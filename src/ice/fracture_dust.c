/* Pieces too small to be floes of their own (docs/decisions/0042).  The reference deletes them; a stencil cuts some off
   nearly every floe, though, and of a small floe that would be a good part.  They are joined to a sibling instead. */
#include "ice/fracture_parts.h"

#include "base/transcendental.h"

/* Boundaries nearer than this part of a ring's size are the same. */
static const double SAME_BOUNDARY = 1e-7;

/* Corners nearer than this part of a ring's size, or than some rounding of places far from the origin, are one corner:
   far over rounding, and so little that the centroid does not notice. */
static const double SAME_CORNER = 1e-9, SAME_ROUNDING = 4;

/* A union has the area of its parts, but for this part of it, and rounding of places along its boundary. */
static const double SAME_AREA = 1e-11;

/* Corners nearer than this part of a ring's size to an edge of it that is not theirs may touch it after rounding. */
static const double LEAST_CLEARANCE = 1e-10;

bool fracture_outline_is_sound(context *ctx, polygon p)
{
    if (p.count < 3 || !(polygon_area(p) > 0) || polygon_self_intersects(ctx, p, NULL, NULL))
        return false;
    return polygon_has_clearance(ctx, p, LEAST_CLEARANCE * polygon_perimeter(p));
}

/* Length of a's edges that lie on b, by the edges' middles. */
static double length_on(polygon a, polygon b)
{
    double sum = 0, reach = SAME_BOUNDARY * polygon_perimeter(b);
    for (int32_t i = 0; i < a.count; i++) {
        vec2 from = a.vertex[i], to = a.vertex[i + 1 < a.count ? i + 1 : 0];
        vec2 middle = vec2_scale(vec2_add(from, to), 0.5), near = polygon_nearest_boundary(b, middle, NULL);
        if (vec2_length(vec2_sub(near, middle)) <= reach)
            sum += vec2_length(vec2_sub(to, from));
    }
    return sum;
}

/* How much boundary two pieces share: an edge of one may be a part of an edge of the other. */
static double shared_length(const fracture_scratch *s, int32_t i, int32_t k)
{
    polygon a = polygon_list_get(&s->piece.outlines, s->piece.rows.data[i].ring);
    polygon b = polygon_list_get(&s->piece.outlines, s->piece.rows.data[k].ring);
    return fmax(length_on(a, b), length_on(b, a));
}

/* A tile stays inside its cell. */
static bool pieces_may_join(const fracture_scratch *s, int32_t i, int32_t k)
{
    const cut_piece *a = &s->piece.rows.data[i], *b = &s->piece.rows.data[k];
    return b->motion == MOTION_DYNAMIC || b->tile == a->tile;
}

/* The sibling of piece i with the longest common boundary, but shorter than `under`; -1 when there is none. */
static int32_t neighbour_of(const fracture_scratch *s, int32_t i, double *under)
{
    int32_t best = -1;
    double longest = 0;
    for (int32_t k = 0; k < s->piece.rows.count; k++) {
        double length = k == i || !pieces_may_join(s, i, k) ? 0 : shared_length(s, i, k);
        if (length > longest && length < *under) {
            longest = length;
            best = k;
        }
    }
    *under = longest;
    return best;
}

static double corner_reach(polygon p)
{
    return fmax(SAME_CORNER * polygon_perimeter(p), SAME_ROUNDING * polygon_rounding(p));
}

/* The corner of p that a place is, within reach; the place itself where there is none. */
static vec2 welded_corner(polygon p, vec2 place, double reach)
{
    vec2 found = place;
    for (int32_t i = 0; i < p.count; i++) {
        double distance = vec2_length(vec2_sub(p.vertex[i], place));
        if (distance <= reach) {
            reach = distance;
            found = p.vertex[i];
        }
    }
    return found;
}

/* The corner of p on the edge from a to b that comes first after `along` [m]; false where none does. */
static bool corner_on_edge(polygon p, vec2 a, vec2 b, double reach, double *along, vec2 *found)
{
    vec2 edge = vec2_sub(b, a);
    double length = vec2_length(edge), first = length - reach;
    bool any = false;
    for (int32_t i = 0; i < p.count && length > 0; i++) {
        vec2 from = vec2_sub(p.vertex[i], a);
        double at = vec2_dot(from, edge) / length;
        if (at > *along + reach && at < first && fabs(vec2_cross(edge, from)) <= reach * length) {
            first = at;
            *found = p.vertex[i];
            any = true;
        }
    }
    *along = first;
    return any;
}

/* A piece with the corners of another where these are its own but for rounding, or lie on its edges.  Pieces are cut
   from their parent one by one: a side that two share may have ends that differ in the last bit, and is longer for one
   of them where a third begins.  United as they are they would touch, not be one. */
static bool weld(context *ctx, polygon piece, polygon to, double reach, vec2_array *out)
{
    array_clear(out);
    for (int32_t i = 0; i < piece.count; i++) {
        vec2 from = welded_corner(to, piece.vertex[i], reach), found;
        vec2 next = welded_corner(to, piece.vertex[i + 1 < piece.count ? i + 1 : 0], reach);
        if (!array_push(ctx, out, from))
            return false;
        for (double along = 0; corner_on_edge(to, from, next, reach, &along, &found);)
            if (!array_push(ctx, out, found))
                return false;
    }
    return true;
}

/* Two pieces, each with the corners of the other, in piece.pair. */
static bool weld_pair(context *ctx, fracture_scratch *s, polygon a, polygon b)
{
    piece_work *w = &s->piece;
    double reach = fmax(corner_reach(a), corner_reach(b));
    polygon_list_clear(&w->pair);
    return weld(ctx, a, b, reach, &w->welded) &&
           polygon_list_push(ctx, &w->pair, (polygon){w->welded.data, w->welded.count}) &&
           weld(ctx, b, polygon_list_get(&w->pair, 0), reach, &w->welded) &&
           polygon_list_push(ctx, &w->pair, (polygon){w->welded.data, w->welded.count});
}

/* Corners of a union that differ by rounding become one.  Its spikes stay, which are ice, unless they are none but
   rounding's: then it is sound only without them.  false: no memory. */
static bool merge_corners(context *ctx, fracture_scratch *s, polygon *ring, double area, bool *sound)
{
    polygon joined = *ring;
    double corner = corner_reach(joined);
    double same = SAME_AREA * area + polygon_rounding(joined) * polygon_perimeter(joined);
    *sound = false;
    for (int turn = 0; turn < 2 && !*sound; turn++) {
        if (!(turn == 0 ? polygon_merge(ctx, joined, corner, NULL, &s->piece.clean)
                        : polygon_clean(ctx, joined, corner, &s->piece.clean)))
            return false;
        *ring = (polygon){s->piece.clean.data, s->piece.clean.count};
        *sound = fabs(polygon_area(*ring) - area) <= same && fracture_outline_is_sound(ctx, *ring);
    }
    return true;
}

/* The union of the pair, when it is one sound ring, in *ring. */
static fram_status unite_pair(context *ctx, fracture_scratch *s, overlay *plane, double area, polygon *ring,
                              bool *sound, fram_error *error)
{
    *sound = false;
    polygon_list_clear(&s->piece.joined);
    fram_status status = overlay_union(plane, &s->piece.pair, &s->piece.joined, error);
    if (status == FRAM_ERROR_MEMORY)
        return status;
    if (status != FRAM_OK || polygon_list_count(&s->piece.joined) != 1)
        return FRAM_OK;
    *ring = polygon_list_get(&s->piece.joined, 0);
    return merge_corners(ctx, s, ring, area, sound) ? FRAM_OK : error_memory(error);
}

fram_status fracture_unite(context *ctx, fracture_scratch *s, overlay *plane, int32_t i, int32_t k, bool *joined,
                           fram_error *error)
{
    polygon a = polygon_list_get(&s->piece.outlines, s->piece.rows.data[i].ring);
    polygon b = polygon_list_get(&s->piece.outlines, s->piece.rows.data[k].ring), ring;
    *joined = false;
    polygon_list_clear(&s->piece.pair);
    if (!polygon_list_push(ctx, &s->piece.pair, a) || !polygon_list_push(ctx, &s->piece.pair, b))
        return error_memory(error);
    double area = s->piece.rows.data[i].area + s->piece.rows.data[k].area;
    bool sound;
    fram_status status = unite_pair(ctx, s, plane, area, &ring, &sound, error);
    /* Only then: a notch that is narrower than rounding would close, a sliver be gone. */
    if (status == FRAM_OK && !sound) {
        if (!weld_pair(ctx, s, a, b))
            return error_memory(error);
        status = unite_pair(ctx, s, plane, area, &ring, &sound, error);
    }
    if (status != FRAM_OK || !sound)
        return status;
    s->piece.rows.data[k].ring = polygon_list_count(&s->piece.outlines);
    s->piece.rows.data[k].area = polygon_area(ring);
    if (s->piece.rows.data[k].tile != s->piece.rows.data[i].tile)
        s->piece.rows.data[k].tile = 0;
    *joined = true;
    return polygon_list_push(ctx, &s->piece.outlines, ring) ? FRAM_OK : error_memory(error);
}

void fracture_drop_piece(fracture_scratch *s, int32_t i)
{
    for (int32_t m = i; m + 1 < s->piece.rows.count; m++)
        s->piece.rows.data[m] = s->piece.rows.data[m + 1];
    s->piece.rows.count--;
}

/* Piece i joined to the first neighbour that takes it; -1 when none does. */
static fram_status join_piece(context *ctx, fracture_scratch *s, overlay *plane, int32_t i, int32_t *to,
                              fram_error *error)
{
    double under = HUGE_VAL;
    for (int32_t k = neighbour_of(s, i, &under); k >= 0; k = neighbour_of(s, i, &under)) {
        bool joined;
        fram_status status = fracture_unite(ctx, s, plane, i, k, &joined, error);
        *to = k;
        if (status != FRAM_OK || joined)
            return status;
    }
    *to = -1;
    return FRAM_OK;
}

/* Too small, or what cleaning leaves is no floe: less than half of it, a sliver of three vertices, or a ring that
   crosses itself. */
static fram_status judge_piece(const fracture_job *j, int32_t i, bool *dust)
{
    piece_work *w = &j->scratch->piece;
    const fracture_settings *f = j->settings;
    const cut_piece *piece = &w->rows.data[i];
    polygon ring = polygon_list_get(&w->outlines, piece->ring);
    fram_status status = fracture_is_dust(j, piece, ring, dust);
    if (status != FRAM_OK || *dust || (piece->tile != 0 && piece->motion != MOTION_DYNAMIC))
        return status;
    if (!polygon_clean(j->ctx, ring, f->edge_threshold, &w->clean))
        return error_memory(j->error);
    polygon left = {w->clean.data, w->clean.count};
    *dust = polygon_area(left) < fmax(f->smallest_floe_area, piece->area / 2) ||
            !polygon_is_clean(left, f->edge_threshold) || !fracture_outline_is_sound(j->ctx, left);
    return FRAM_OK;
}

fram_status fracture_join_dust(const fracture_job *j)
{
    fracture_scratch *s = j->scratch;
    for (int32_t i = 0; i < s->piece.rows.count;) {
        int32_t to = -1;
        bool dust;
        fram_status status = judge_piece(j, i, &dust);
        if (status == FRAM_OK && dust)
            status = join_piece(j->ctx, s, j->plane, i, &to, j->error);
        if (status != FRAM_OK)
            return status;
        if (to < 0) {
            i++;
            continue;
        }
        fracture_drop_piece(s, i);
        /* The neighbour may still be too small, and may stand before. */
        if (to < i)
            i = to;
    }
    return FRAM_OK;
}
