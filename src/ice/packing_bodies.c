/* Bodies of the packing: convex pieces, seams between them, where they lie. */
#include "ice/packing_work.h"

#include "geometry/space_curve.h"

#include <string.h>

/* Large floes move as if they were no larger than this many smallest ones, lest they be carried right across those. */
static const double GRAIN = 10;
/* Vertices of a convex piece at most: the axis of a pair must fit 16 bits, and contacts cost their product. */
enum { PIECE_VERTICES = 24 };

static int32_t next_of(int32_t i, int32_t count) { return i + 1 < count ? i + 1 : 0; }

static bool add_body_piece(context *ctx, pack_layout *l, int32_t body, polygon p)
{
    pack_piece piece = {.body = body, .first = l->local.count};
    for (int32_t i = 0; i < p.count; i++) {
        vec2 edge = vec2_sub(p.vertex[next_of(i, p.count)], p.vertex[i]);
        double length = vec2_length(edge);
        if (length == 0)
            continue; /* a vertex given twice */
        vec2 n = {edge.y / length, -edge.x / length};
        if (!array_push(ctx, &l->local, p.vertex[i]) || !array_push(ctx, &l->local_normal, n) ||
            !array_push(ctx, &l->seam, 0))
            return false;
    }
    piece.count = l->local.count - piece.first;
    return piece.count < 3 || array_push(ctx, &l->pieces, piece);
}

/* Edges that two pieces of one body have in common are seams. */
static void mark_seams(pack_layout *l, const pack_body *b)
{
    const vec2 *v = l->local.data;
    for (int32_t p = b->piece; p < b->piece + b->piece_count; p++)
        for (int32_t q = p + 1; q < b->piece + b->piece_count; q++) {
            const pack_piece *a = &l->pieces.data[p], *c = &l->pieces.data[q];
            for (int32_t i = 0; i < a->count; i++)
                for (int32_t k = 0; k < c->count; k++) {
                    vec2 a0 = v[a->first + i], a1 = v[a->first + next_of(i, a->count)];
                    vec2 c0 = v[c->first + k], c1 = v[c->first + next_of(k, c->count)];
                    if (a0.x == c1.x && a0.y == c1.y && a1.x == c0.x && a1.y == c0.y)
                        l->seam.data[a->first + i] = l->seam.data[c->first + k] = 1;
                }
        }
}

static double farthest(polygon p)
{
    double most = 0;
    for (int32_t i = 0; i < p.count; i++)
        most = fmax(most, vec2_dot(p.vertex[i], p.vertex[i]));
    return sqrt(most);
}

static bool add_shape(pack_work *w, polygon shape, polygon_list *pieces)
{
    polygon_moments m = polygon_moments_of(shape);
    int32_t body = w->layout.bodies.count;
    double inertia = (m.xx + m.yy) / m.area; /* radius of gyration, squared */
    pack_body b = {.turn = {1, 0}, .radius = farthest(shape), .size = sqrt(m.area), .piece = w->layout.pieces.count};
    /* A mass like the diameter, not like the area: a large floe shall give way to many small ones. */
    b.weight = 1 / b.size;
    b.spin_weight = b.weight / inertia;
    polygon_list_clear(pieces);
    if (polygon_is_convex(shape) && shape.count <= PIECE_VERTICES) {
        if (!add_body_piece(w->ctx, &w->layout, body, shape))
            return false;
    } else {
        if (!w->overlay) {
            w->status = error_set(w->error, FRAM_ERROR_INPUT, NULL, 0, "shapes",
                                  "shape %d is concave; it needs an overlay", (int)body);
            return false;
        }
        w->status = overlay_convex_pieces(w->overlay, shape, 0, PIECE_VERTICES, pieces, NULL, w->error);
        if (w->status != FRAM_OK)
            return false;
        for (int32_t i = 0; i < polygon_list_count(pieces); i++)
            if (!add_body_piece(w->ctx, &w->layout, body, polygon_list_get(pieces, i)))
                return false;
    }
    b.piece_count = w->layout.pieces.count - b.piece;
    if (!array_push(w->ctx, &w->layout.bodies, b))
        return false;
    mark_seams(&w->layout, &b);
    return true;
}

/* An obstacle stands where it is given. */
static bool add_obstacle(pack_work *w, polygon zone)
{
    pack_body b = {.turn = {1, 0},
                   .radius = 0,
                   .size = sqrt(polygon_area(zone)),
                   .piece = w->layout.pieces.count,
                   .piece_count = 1};
    return add_body_piece(w->ctx, &w->layout, w->layout.bodies.count, zone) && array_push(w->ctx, &w->layout.bodies, b);
}

static bool add_bodies(pack_work *w, const polygon_list *shapes)
{
    const polygon_list *obstacles = w->request->obstacles;
    polygon_list pieces = {0};
    bool good = true;
    double sum = 0, least = HUGE_VAL;
    for (int32_t i = 0; good && i < polygon_list_count(shapes); i++) {
        w->status = work_continue(w->ctx, "packing the ice: shapes", i, polygon_list_count(shapes), w->error);
        good = w->status == FRAM_OK && add_shape(w, polygon_list_get(shapes, i), &pieces);
        if (good) {
            sum += w->layout.bodies.data[i].size;
            least = fmin(least, w->layout.bodies.data[i].size);
        }
    }
    w->layout.movable = w->layout.bodies.count;
    w->layout.concave = w->layout.pieces.count > w->layout.bodies.count;
    w->layout.mean_size = w->layout.movable > 0 ? sum / w->layout.movable : 1;
    w->layout.least_size = w->layout.movable > 0 ? least : 1;
    w->layout.grain = fmin(w->layout.mean_size, GRAIN * w->layout.least_size);
    for (int32_t i = 0; good && obstacles && i < polygon_list_count(obstacles); i++)
        good = add_obstacle(w, polygon_list_get(obstacles, i));
    polygon_list_free(w->ctx, &pieces);
    return good;
}

bool pack_bodies_make(pack_work *w)
{
    const packing_request *r = w->request;
    const polygon_list *shapes = w->layout.coarse ? r->coarse : r->shapes;
    array_clear(&w->layout.bodies);
    array_clear(&w->layout.pieces);
    array_clear(&w->layout.local);
    array_clear(&w->layout.local_normal);
    array_clear(&w->layout.seam);
    if (!add_bodies(w, shapes) || !array_resize(w->ctx, &w->layout.shape, w->layout.movable) ||
        !array_resize(w->ctx, &w->layout.vertex, w->layout.local.count) ||
        !array_resize(w->ctx, &w->layout.normal, w->layout.local.count) ||
        !array_resize(w->ctx, &w->contacts.steps, w->layout.bodies.count) ||
        !array_resize(w->ctx, &w->contacts.squeeze, w->layout.bodies.count) ||
        !array_resize(w->ctx, &w->search.pair_centre, w->layout.bodies.count))
        return false;
    for (int32_t i = 0; i < w->layout.movable; i++)
        w->layout.shape.data[i] = i;
    return true;
}

bool pack_refine(pack_work *w)
{
    packing_pose_array poses = {0};
    bool good = array_resize(w->ctx, &poses, w->layout.movable);
    if (good) {
        pack_poses(&w->layout, &poses);
        w->layout.coarse = false;
        good = pack_bodies_make(w);
    }
    for (int32_t i = 0; good && i < w->layout.movable; i++) {
        w->layout.bodies.data[i].centre = poses.data[i].centre;
        w->layout.bodies.data[i].turn = poses.data[i].turn;
    }
    array_free(w->ctx, &poses);
    return good && pack_sort_bodies(w->ctx, &w->layout);
}

void pack_poses(const pack_layout *l, packing_pose_array *poses)
{
    for (int32_t i = 0; i < l->movable; i++)
        poses->data[l->shape.data[i]] = (packing_pose){l->bodies.data[i].centre, l->bodies.data[i].turn};
}

/* Appends body i of `from` with its pieces; there is room. */
static void copy_body(pack_layout *l, const pack_layout *from, int32_t i)
{
    pack_body b = from->bodies.data[i];
    int32_t end = b.piece + b.piece_count, p = b.piece;
    b.piece = l->pieces.count;
    for (; p < end; p++) {
        pack_piece piece = from->pieces.data[p];
        int32_t first = piece.first, to = l->local.count;
        for (int32_t k = 0; k < piece.count; k++) {
            l->local.data[to + k] = from->local.data[first + k];
            l->local_normal.data[to + k] = from->local_normal.data[first + k];
            l->seam.data[to + k] = from->seam.data[first + k];
        }
        piece.first = to;
        piece.body = l->bodies.count;
        l->local.count += piece.count;
        l->local_normal.count += piece.count;
        l->seam.count += piece.count;
        l->pieces.data[l->pieces.count++] = piece;
    }
    l->bodies.data[l->bodies.count++] = b;
}

static void layout_free(context *ctx, pack_layout *l)
{
    array_free(ctx, &l->shape);
    array_free(ctx, &l->bodies);
    array_free(ctx, &l->pieces);
    array_free(ctx, &l->local);
    array_free(ctx, &l->local_normal);
    array_free(ctx, &l->vertex);
    array_free(ctx, &l->normal);
    array_free(ctx, &l->seam);
}

bool pack_sort_bodies(context *ctx, pack_layout *l)
{
    pack_layout sorted = {0};
    vec2 *place = memory_array(ctx, (size_t)l->movable + 1, sizeof *place);
    int32_t *order = memory_array(ctx, (size_t)l->movable + 1, sizeof *order);
    bool good = place && order;
    for (int32_t i = 0; good && i < l->movable; i++)
        place[i] = l->bodies.data[i].centre;
    good = good && space_curve_order(ctx, place, l->movable, order) &&
           array_reserve(ctx, &sorted.bodies, l->bodies.count) && array_reserve(ctx, &sorted.pieces, l->pieces.count) &&
           array_reserve(ctx, &sorted.local, l->local.count) && array_reserve(ctx, &sorted.seam, l->seam.count) &&
           array_reserve(ctx, &sorted.local_normal, l->local_normal.count);
    if (good) {
        for (int32_t i = 0; i < l->bodies.count; i++)
            copy_body(&sorted, l, i < l->movable ? order[i] : i);
        for (int32_t i = 0; i < l->movable; i++)
            order[i] = l->shape.data[order[i]];
        memcpy(l->shape.data, order, (size_t)l->movable * sizeof *order);
        memcpy(l->bodies.data, sorted.bodies.data, (size_t)l->bodies.count * sizeof *l->bodies.data);
        memcpy(l->pieces.data, sorted.pieces.data, (size_t)l->pieces.count * sizeof *l->pieces.data);
        memcpy(l->local.data, sorted.local.data, (size_t)l->local.count * sizeof *l->local.data);
        memcpy(l->local_normal.data, sorted.local_normal.data,
               (size_t)l->local_normal.count * sizeof *l->local_normal.data);
        memcpy(l->seam.data, sorted.seam.data, (size_t)l->seam.count * sizeof *l->seam.data);
    }
    layout_free(ctx, &sorted);
    memory_free(ctx, place);
    memory_free(ctx, order);
    return good;
}

void pack_place_body(pack_layout *l, int32_t body)
{
    const pack_body *b = &l->bodies.data[body];
    double scale = body < l->movable ? l->scale : 1;
    double c = b->turn.x * scale, s = b->turn.y * scale;
    for (int32_t p = b->piece; p < b->piece + b->piece_count; p++) {
        pack_piece *piece = &l->pieces.data[p];
        box2 box = {{HUGE_VAL, HUGE_VAL}, {-HUGE_VAL, -HUGE_VAL}};
        vec2 sum = {0, 0};
        for (int32_t i = piece->first; i < piece->first + piece->count; i++) {
            vec2 v = l->local.data[i], n = l->local_normal.data[i];
            vec2 at = {b->centre.x + c * v.x - s * v.y, b->centre.y + s * v.x + c * v.y};
            l->vertex.data[i] = at;
            l->normal.data[i] = (vec2){b->turn.x * n.x - b->turn.y * n.y, b->turn.y * n.x + b->turn.x * n.y};
            sum = vec2_add(sum, at);
            box.lo.x = at.x < box.lo.x ? at.x : box.lo.x;
            box.lo.y = at.y < box.lo.y ? at.y : box.lo.y;
            box.hi.x = at.x > box.hi.x ? at.x : box.hi.x;
            box.hi.y = at.y > box.hi.y ? at.y : box.hi.y;
        }
        piece->box = box;
        piece->middle = vec2_scale(sum, 1.0 / piece->count);
    }
}

void pack_place(pack_layout *l)
{
    for (int32_t i = 0; i < l->bodies.count; i++)
        pack_place_body(l, i);
}

void pack_work_free(pack_work *w)
{
    context *ctx = w->ctx;
    layout_free(ctx, &w->layout);
    array_free(ctx, &w->search.items);
    array_free(ctx, &w->search.cell_start);
    array_free(ctx, &w->search.cell_item);
    array_free(ctx, &w->search.pairs);
    array_free(ctx, &w->contacts.rows);
    array_free(ctx, &w->contacts.steps);
    array_free(ctx, &w->search.pair_centre);
    array_free(ctx, &w->contacts.squeeze);
}
