/* Contacts of the kept pairs: quick way out by the remembered axis, then piece against piece.  All geometry of a pair
   is taken about the first body's centre of mass, so that nothing is lost far from the origin. */
#include "dynamics/collision_scratch.h"
#include "dynamics/prism_contact.h"

/* Pairs are contacts a little before they touch, and open points of touching faces stay in the manifold: the solver
   lets a gap close within the step but not be crossed.  So a body at rest on four points neither rocks nor loses its
   contacts, and what they carried, to the last digits of its position.  Both are shares of the smaller radius: gaps
   that a body of 5 m closes in a step or two, and corners of faces that lie nearly flat. */
#define PAIR_REACH 0.002
#define POINT_REACH 0.02

/* One body of a pair. */
typedef struct party {
    int32_t slot, shape;
    mat3 rotation;
    vec3 centre; /* about the first body's centre of mass */
    bool is_prism;
    const shape_store *shapes;
} party;

static party party_of(const body_table *bodies, const shape_store *shapes, int32_t slot, vec3 origin)
{
    int32_t row = bodies->shape[slot];
    return (party){slot,
                   row,
                   quat_matrix(bodies->orientation[slot]),
                   vec3_sub(bodies->position[slot], origin),
                   shapes->shapes.kind[row] == SHAPE_PRISM,
                   shapes};
}

static const polyhedron_array *solid_pieces(const party *p)
{
    return &p->shapes->solids.data[p->shapes->shapes.solid[p->shape]].pieces;
}

static int32_t piece_count(const party *p)
{
    return p->is_prism ? p->shapes->shapes.piece_count[p->shape] : solid_pieces(p)->count;
}

static prism prism_piece(const party *p, int32_t piece)
{
    int32_t at = p->shapes->shapes.piece_first[p->shape] + piece, first = p->shapes->pieces.first[at];
    return (prism){.vertex = p->shapes->vertices.point + first,
                   .corner = p->shapes->vertices.corner + first,
                   .outline = shape_outline(p->shapes, p->shape),
                   .count = p->shapes->pieces.size[at],
                   .half_height = p->shapes->shapes.half_height[p->shape],
                   .seams = p->shapes->pieces.inner_edges[at],
                   .rotation = p->rotation,
                   .centre = p->centre};
}

/* ---- remembered axis ---- */

/* Extent of a whole body along a unit axis. */
static void body_span(const party *p, vec3 axis, double *low, double *high)
{
    vec3 n = mat3_tmul_vec(p->rotation, axis);
    double middle = vec3_dot(axis, p->centre), least = HUGE_VAL, most = -HUGE_VAL, rise = 0;
    if (p->is_prism) {
        polygon outline = shape_outline(p->shapes, p->shape);
        rise = p->shapes->shapes.half_height[p->shape] * fabs(n.z);
        for (int32_t i = 0; i < outline.count; i++) {
            double d = n.x * outline.vertex[i].x + n.y * outline.vertex[i].y;
            least = d < least ? d : least;
            most = d > most ? d : most;
        }
    } else {
        const polyhedron_array *pieces = solid_pieces(p);
        for (int32_t k = 0; k < pieces->count; k++) {
            for (int32_t i = 0; i < pieces->data[k].vertex.count; i++) {
                double d = vec3_dot(n, pieces->data[k].vertex.data[i]);
                least = d < least ? d : least;
                most = d > most ? d : most;
            }
        }
    }
    *low = middle + least - rise;
    *high = middle + most + rise;
}

static bool axis_parts(const party *a, const party *b, vec3 axis, double slack)
{
    if (vec3_dot(axis, axis) == 0)
        return false;
    double low_a, high_a, low_b, high_b;
    body_span(a, axis, &low_a, &high_a);
    body_span(b, axis, &low_b, &high_b);
    return low_a - high_b > slack;
}

/* ---- pieces of compounds ---- */

static box3 piece_box(const party *p, int32_t piece)
{
    box3 box = box3_empty();
    if (!p->is_prism) {
        const polyhedron *hull = &solid_pieces(p)->data[piece];
        for (int32_t i = 0; i < hull->vertex.count; i++)
            box = box3_add(box, vec3_add(p->centre, mat3_mul_vec(p->rotation, hull->vertex.data[i])));
        return box;
    }
    prism q = prism_piece(p, piece);
    for (int32_t i = 0; i < 2 * q.count; i++) {
        double z = i < q.count ? q.half_height : -q.half_height;
        vec2 v = q.vertex[i < q.count ? i : i - q.count];
        box = box3_add(box, vec3_add(p->centre, mat3_mul_vec(p->rotation, vec3_make(v.x, v.y, z))));
    }
    return box;
}

static box3 party_box(const party *p)
{
    box3 box = box3_empty();
    for (int32_t i = 0; i < piece_count(p); i++)
        box = box3_union(box, piece_box(p, i));
    return box;
}

/* The pieces of p that reach into the box. */
static bool gather_pieces(context *ctx, const party *p, box3 box, int32_array *near)
{
    array_clear(near);
    int32_t count = piece_count(p);
    for (int32_t i = 0; i < count; i++)
        if ((count == 1 || box3_meet(piece_box(p, i), box)) && !array_push(ctx, near, i))
            return false;
    return true;
}

static box3 box3_grown(box3 b, double by)
{
    vec3 rim = vec3_make(by, by, by);
    return (box3){vec3_sub(b.lo, rim), vec3_add(b.hi, rim)};
}

/* ---- piece against piece ---- */

static bool reserve_polyhedron(context *ctx, polyhedron *room, const polyhedron *model)
{
    return array_reserve(ctx, &room->vertex, model->vertex.count) &&
           array_reserve(ctx, &room->face, model->face.count) && array_reserve(ctx, &room->loop, model->loop.count) &&
           array_reserve(ctx, &room->edge_direction, model->edge_direction.count);
}

static void place_polyhedron(const polyhedron *model, mat3 r, vec3 centre, polyhedron *room)
{
    room->vertex.count = model->vertex.count;
    for (int32_t i = 0; i < model->vertex.count; i++)
        room->vertex.data[i] = vec3_add(centre, mat3_mul_vec(r, model->vertex.data[i]));
    room->face.count = model->face.count;
    for (int32_t i = 0; i < model->face.count; i++) {
        room->face.data[i] = model->face.data[i];
        vec3 normal = mat3_mul_vec(r, model->face.data[i].normal);
        room->face.data[i].normal = normal;
        room->face.data[i].offset = model->face.data[i].offset + vec3_dot(normal, centre);
    }
    room->loop.count = model->loop.count;
    for (int32_t i = 0; i < model->loop.count; i++)
        room->loop.data[i] = model->loop.data[i];
    room->edge_direction.count = model->edge_direction.count;
    for (int32_t i = 0; i < model->edge_direction.count; i++)
        room->edge_direction.data[i] = mat3_mul_vec(r, model->edge_direction.data[i]);
    room->centre = vec3_add(centre, mat3_mul_vec(r, model->centre));
    room->radius = model->radius;
}

/* The piece as a polyhedron in room; seams get the faces that are none. */
static bool place_piece(context *ctx, const party *p, int32_t piece, polyhedron *room, uint64_t *seams)
{
    *seams = 0;
    if (p->is_prism) {
        prism q = prism_piece(p, piece);
        *seams = q.seams;
        if (!prism_polyhedron_reserve(ctx, room))
            return false;
        prism_polyhedron(&q, room);
        return true;
    }
    const polyhedron *model = &solid_pieces(p)->data[piece];
    if (!reserve_polyhedron(ctx, room, model))
        return false;
    place_polyhedron(model, p->rotation, p->centre, room);
    return true;
}

/* Points of two pieces, -1 without memory. */
static int touch_pieces(context *ctx, collision_scratch *s, const party *a, const party *b, int32_t piece_a,
                        int32_t piece_b, nearness near, vec3 *normal, manifold_point out[4], vec3 *axis)
{
    if (a->is_prism && b->is_prism) {
        if (!prism_polyhedron_reserve(ctx, &s->piece_a) || !prism_polyhedron_reserve(ctx, &s->piece_b))
            return -1;
        prism p = prism_piece(a, piece_a), q = prism_piece(b, piece_b);
        return prism_manifold(&p, &q, near, &s->piece_a, &s->piece_b, normal, out, axis);
    }
    seam_masks seams;
    if (!place_piece(ctx, a, piece_a, &s->piece_a, &seams.a) || !place_piece(ctx, b, piece_b, &s->piece_b, &seams.b))
        return -1;
    return polyhedra_manifold_masked(&s->piece_a, &s->piece_b, seams, near, normal, out, axis);
}

/* ---- pairs ---- */

static bool add_contacts(context *ctx, const body_table *bodies, const party *a, const party *b, int32_t piece_a,
                         int32_t piece_b, vec3 normal, const manifold_point *point, int count,
                         const pair_policy *policy, contact_array *contacts)
{
    for (int i = 0; i < count; i++) {
        contact c = {.a = a->slot,
                     .b = b->slot,
                     .point = vec3_add(bodies->position[a->slot], point[i].point),
                     .normal = normal,
                     .depth = point[i].depth,
                     .impulse_limit = HUGE_VAL,
                     .friction_static = policy->friction_static,
                     .friction_kinetic = policy->friction_kinetic,
                     .correct = true,
                     .patch = -1,
                     .key = contact_key(bodies, a->slot, b->slot, piece_a, piece_b, point[i].feature)};
        if (!array_push(ctx, contacts, c))
            return false;
    }
    return true;
}

/* All contacts of one pair; *axis in and out as in pair_table. */
static bool touch_bodies(context *ctx, collision_scratch *s, const body_table *bodies, const party *a, const party *b,
                         const pair_policy *policy, vec3 *axis, contact_array *contacts)
{
    const double *radius = a->shapes->shapes.radius;
    double smaller = fmin(radius[a->shape], radius[b->shape]);
    nearness near = {.slack = PAIR_REACH * smaller, .reach = POINT_REACH * smaller};
    if (axis_parts(a, b, *axis, near.slack))
        return true;
    bool compound = piece_count(a) > 1 || piece_count(b) > 1;
    box3 box_a = box3_empty(), box_b = box3_empty();
    if (compound) {
        box_a = box3_grown(party_box(a), near.slack);
        box_b = box3_grown(party_box(b), near.slack);
    }
    if (!gather_pieces(ctx, a, box_b, &s->near_a) || !gather_pieces(ctx, b, box_a, &s->near_b))
        return false;
    int32_t first = contacts->count;
    vec3 last = {0, 0, 0};
    for (int32_t i = 0; i < s->near_a.count; i++) {
        for (int32_t j = 0; j < s->near_b.count; j++) {
            vec3 normal, parting = {0, 0, 0};
            manifold_point point[4];
            int32_t piece_a = s->near_a.data[i], piece_b = s->near_b.data[j];
            int count = touch_pieces(ctx, s, a, b, piece_a, piece_b, near, &normal, point, &parting);
            if (count < 0 || !add_contacts(ctx, bodies, a, b, piece_a, piece_b, normal, point, count, policy, contacts))
                return false;
            if (vec3_dot(parting, parting) > 0)
                last = parting;
        }
    }
    contact_keys_part(contacts->data + first, contacts->count - first);
    bool remember = contacts->count == first && (!compound || axis_parts(a, b, last, near.slack));
    *axis = remember ? last : vec3_make(0, 0, 0);
    return true;
}

fram_status narrow_phase_run(context *ctx, const body_table *bodies, const shape_store *shapes,
                             const pair_policies *policies, pair_table *pairs, contact_array *contacts,
                             index_array *patch_pairs, collision_scratch *scratch, fram_error *error)
{
    array_clear(contacts);
    array_clear(patch_pairs);
    for (int32_t i = 0; i < pairs->count; i++) {
        int32_t slot_a = pairs->a[i], slot_b = pairs->b[i];
        const pair_policy *policy = &policies->of[bodies->material[slot_a]][bodies->material[slot_b]];
        if (policy->patch) {
            if (!array_push(ctx, patch_pairs, i))
                return error_memory(error);
            continue;
        }
        party a = party_of(bodies, shapes, slot_a, bodies->position[slot_a]);
        party b = party_of(bodies, shapes, slot_b, bodies->position[slot_a]);
        if (!touch_bodies(ctx, scratch, bodies, &a, &b, policy, &pairs->axis[i], contacts))
            return error_memory(error);
    }
    return FRAM_OK;
}
