/* Contacts of the kept pairs: quick ways out by what the bodies travelled and by the remembered axis, then piece
   against piece.  All geometry of a pair is taken about the first body's centre of mass, so that nothing is lost far
   from the origin. */
#include "base/pool.h"
#include "dynamics/collision_scratch.h"
#include "dynamics/pair_party.h"
#include "dynamics/prism_pair_kernel.h"

#include <string.h>

/* Pairs a block: the most make about a thousand contacts in a packed field. */
enum { LEAST_PAIRS = 32, MOST_PAIRS = 512 };
/* Bounds are taken smaller by this share, far more than what rounding can take from them. */
#define SURE_OF_GAP (1 - 1e-9)

/* Pairs are contacts a little before they touch, and open points of touching faces stay in the manifold: the solver
   lets a gap close within the step but not be crossed.  So a body at rest on four points neither rocks nor loses its
   contacts, and what they carried, to the last digits of its position.  Both are shares of the smaller radius: gaps
   that a body of 5 m closes in a step or two, and corners of faces that lie nearly flat. */
#define PAIR_REACH 0.002
#define POINT_REACH 0.02

/* Two prisms lie side to side while both are level up to NEARLY_LEVEL, overlap by no more than this share of the lower
   one's height, and their normal rises from both planes by no more than this sine: farther in, the axis of least depth
   may turn from the sides to top and bottom. */
#define SHALLOW_SHARE 0.25
#define LEVEL_SINE 0.2

/* ---- piece against piece ---- */

/* The piece as a polyhedron in room, and what it knows of its seams. */
static bool place_piece(context *ctx, const party *p, int32_t piece, polyhedron *room, piece_seams *seams)
{
    *seams = (piece_seams){.piece = piece, .rotation = p->rotation, .centre = p->centre};
    if (p->is_prism) {
        prism q = prism_piece(p, piece);
        seams->faces = q.seams;
        if (!prism_polyhedron_reserve(ctx, room))
            return false;
        prism_polyhedron(&q, room);
        return true;
    }
    const polyhedron_array *pieces = solid_pieces(p);
    seams->pieces = pieces->data[piece].seam > 0 ? pieces : NULL;
    return polyhedron_place(ctx, &pieces->data[piece], p->rotation, p->centre, room);
}

/* Points of two pieces, -1 without memory.  *dropped becomes true where one was for a seam of a solid; where it is NULL
   solids have none. */
static int touch_pieces(context *ctx, narrow_room *s, const party *a, const party *b, int32_t piece_a, int32_t piece_b,
                        nearness near, bool *dropped, vec3 *normal, manifold_point out[4], vec3 *axis)
{
    if (a->is_prism && b->is_prism) {
        if (!prism_polyhedron_reserve(ctx, &s->piece_a) || !prism_polyhedron_reserve(ctx, &s->piece_b))
            return -1;
        prism p = prism_piece(a, piece_a), q = prism_piece(b, piece_b);
        return prism_manifold(&p, &q, near, &s->piece_a, &s->piece_b, normal, out, axis);
    }
    pair_seams seams;
    if (!place_piece(ctx, a, piece_a, &s->piece_a, &seams.a) || !place_piece(ctx, b, piece_b, &s->piece_b, &seams.b))
        return -1;
    if (!dropped)
        seams.a.pieces = seams.b.pieces = NULL;
    int count = polyhedra_manifold(&s->piece_a, &s->piece_b, &seams, near, normal, out, axis);
    if (dropped)
        *dropped = *dropped || seams.dropped;
    return count;
}

/* ---- pairs ---- */

static bool add_contacts(context *ctx, const body_table *bodies, const party *a, const party *b, int32_t piece_a,
                         int32_t piece_b, vec3 normal, const manifold_point *point, int count,
                         const pair_policy *policy, contact_array *contacts)
{
    if (contacts->capacity - contacts->count < count && !array_reserve(ctx, contacts, contacts->count + count))
        return false;
    if (count == 0)
        return true;
    vec3 origin = bodies->position[a->slot];
    contact_key_stem stem = contact_key_begin(bodies, a->slot, b->slot, piece_a, piece_b);
    for (int i = 0; i < count; i++) {
        contact *c = &contacts->data[contacts->count++];
        *c = (contact){.a = a->slot, .b = b->slot, .normal = normal, .impulse_limit = HUGE_VAL};
        c->point = vec3_add(origin, point[i].point);
        c->depth = point[i].depth;
        c->friction_static = policy->friction_static;
        c->friction_kinetic = policy->friction_kinetic;
        c->correct = true;
        c->patch = -1;
        c->key = contact_key_end(stem, point[i].feature);
    }
    return true;
}

/* A pair under test. */
typedef struct pair_case {
    int32_t row; /* of the pair table */
    party a, b;
    bool plain; /* two prisms of one piece each: */
    prism p, q;
    const pair_policy *policy;
    nearness near;
    bool whether; /* whether the two touch is all that is asked: the contacts are those of a patch */
    bool touches; /* out */
    /* In and out: the remembered axis, and how far apart the two are along it, when that is more than the slack. */
    vec3 axis;
    double gap;
} pair_case;

/* The two touch, and nothing is remembered of them. */
static bool touch_of_patch(pair_case *c)
{
    c->touches = true;
    c->axis = vec3_make(0, 0, 0);
    c->gap = 0;
    return true;
}

/* The contacts of all pieces that are near, and the last axis that parts two of them; apart becomes the least gap
   before the first contact.  dropped: as of touch_pieces. */
static bool touch_near_pieces(context *ctx, narrow_room *room, const body_table *bodies, const pair_case *c,
                              bool *dropped, double *apart, vec3 *last, contact_array *contacts)
{
    const party *a = &c->a, *b = &c->b;
    int32_t first = contacts->count;
    for (int32_t i = 0; i < room->near_a.count; i++) {
        for (int32_t j = 0; j < room->near_b.count; j++) {
            vec3 normal, axis = {0, 0, 0};
            manifold_point point[4];
            int32_t piece_a = room->near_a.data[i], piece_b = room->near_b.data[j];
            int count = touch_pieces(ctx, room, a, b, piece_a, piece_b, c->near, dropped, &normal, point, &axis);
            if (count < 0 ||
                !add_contacts(ctx, bodies, a, b, piece_a, piece_b, normal, point, count, c->policy, contacts))
                return false;
            if (c->whether && count > 0)
                return true;
            if (contacts->count == first)
                *apart = fmin(*apart, piece_axis_gap(a, piece_a, b, piece_b, axis));
            if (vec3_dot(axis, axis) > 0)
                *last = axis;
        }
    }
    return true;
}

/* Any two bodies, piece by piece.  Where none touches they are as far apart as the nearest two pieces: a piece in a bay
   of another body is parted from it by no plane. */
static bool touch_compounds(context *ctx, narrow_room *room, const body_table *bodies, pair_case *c,
                            contact_array *contacts)
{
    const party *a = &c->a, *b = &c->b;
    c->gap = axis_gap(a, b, c->axis);
    if (c->gap > c->near.slack)
        return true;
    bool compound = piece_count(a) > 1 || piece_count(b) > 1, dropped = false;
    box3 box_a, box_b;
    double apart = HUGE_VAL;
    if (!party_boxes(ctx, a, &room->box_a, &box_a) || !party_boxes(ctx, b, &room->box_b, &box_b) ||
        !gather_pieces(ctx, &room->box_a, box_b, c->near.slack, &room->near_a, &apart) ||
        !gather_pieces(ctx, &room->box_b, box_a, c->near.slack, &room->near_b, &apart))
        return false;
    int32_t first = contacts->count;
    vec3 last = {0, 0, 0};
    if (!touch_near_pieces(ctx, room, bodies, c, &dropped, &apart, &last, contacts))
        return false;
    /* A contact is dropped since another piece bears one.  In a hollow corner two may each count on the other. */
    if (dropped && contacts->count == first && !touch_near_pieces(ctx, room, bodies, c, NULL, &apart, &last, contacts))
        return false;
    c->touches = contacts->count > first;
    if (c->touches && c->whether)
        return touch_of_patch(c);
    contact_keys_part(contacts->data + first, contacts->count - first);
    c->gap = c->touches ? 0 : axis_gap(a, b, last);
    bool remember = !c->touches && (!compound || c->gap > c->near.slack);
    c->axis = remember ? last : vec3_make(0, 0, 0);
    if (!c->touches)
        c->gap = fmax(c->gap, apart);
    return true;
}

/* Two prisms of one piece each. */
static bool touch_prisms(context *ctx, narrow_room *room, const body_table *bodies, pair_case *c,
                         contact_array *contacts)
{
    prism_meeting meeting;
    KERNEL_PICK(ctx, prism_pair_test)(&c->p, &c->q, c->near.slack, &c->axis, &meeting);
    c->axis = meeting.axis;
    c->gap = meeting.gap;
    if (meeting.kind == PRISMS_APART)
        return true;
    if (meeting.kind == PRISMS_TILTED &&
        (!prism_polyhedron_reserve(ctx, &room->piece_a) || !prism_polyhedron_reserve(ctx, &room->piece_b)))
        return false;
    vec3 normal;
    manifold_point point[4];
    int count =
        prism_meeting_points(&c->p, &c->q, &meeting, c->near, &room->piece_a, &room->piece_b, &normal, point, &c->axis);
    int32_t first = contacts->count;
    if (!add_contacts(ctx, bodies, &c->a, &c->b, 0, 0, normal, point, count, c->policy, contacts))
        return false;
    c->touches = count > 0;
    contact_keys_part(contacts->data + first, count);
    c->gap = vec3_dot(c->axis, c->axis) > 0 ? axis_gap(&c->a, &c->b, c->axis) : 0;
    return true;
}

/* ---- pairs in their order ---- */

typedef struct narrow_work {
    context *ctx;
    const body_table *bodies;
    const shape_store *shapes;
    const broad_table *boxes;
    const pair_policies *policies;
    pair_table *pairs;
    collision_scratch *scratch;
    contact_array *contacts; /* where blocks are joined */
    index_array *patch_pairs;
    int32_t block; /* pairs of one */
} narrow_work;

static bool is_plain_prism(const party *p) { return p->is_prism && p->shapes->shapes.piece_count[p->shape] == 1; }

/* Calls for the outline of a prism, which lies in no cache of a wide field. */
static void prism_fetch(const prism *p)
{
    __builtin_prefetch(p->vertex);
    __builtin_prefetch(p->vertex + 4);
    __builtin_prefetch(p->side);
    __builtin_prefetch(p->side + 4);
}

static void case_make(const narrow_work *w, int32_t row, const pair_policy *policy, pair_case *c)
{
    int32_t slot_a = w->pairs->a[row], slot_b = w->pairs->b[row];
    vec3 origin = w->bodies->position[slot_a];
    c->row = row;
    c->policy = policy;
    if (policy->patch && !policy->sides)
        return;
    c->a = party_of(w->bodies, w->shapes, slot_a, origin);
    c->b = party_of(w->bodies, w->shapes, slot_b, origin);
    c->axis = w->pairs->axis[row];
    c->gap = 0;
    const double *radius = w->shapes->shapes.radius;
    double smaller = fmin(radius[c->a.shape], radius[c->b.shape]);
    c->near = (nearness){.slack = PAIR_REACH * smaller, .reach = POINT_REACH * smaller};
    c->plain = is_plain_prism(&c->a) && is_plain_prism(&c->b);
    if (c->plain) {
        c->p = prism_piece(&c->a, 0);
        c->q = prism_piece(&c->b, 0);
        prism_fetch(&c->p);
        prism_fetch(&c->q);
    }
}

/* Two level plain prisms. */
static bool may_meet_at_sides(const pair_case *c)
{
    return c->plain && c->a.rotation.m[2][2] >= NEARLY_LEVEL && c->b.rotation.m[2][2] >= NEARLY_LEVEL;
}

/* Whether contacts from `first` on are those of two level plain prisms side to side. */
static bool meet_at_sides(const pair_case *c, const contact_array *contacts, int32_t first)
{
    if (!may_meet_at_sides(c))
        return false;
    vec3 up_a = mat3_column(c->a.rotation, 2), up_b = mat3_column(c->b.rotation, 2);
    double deepest = SHALLOW_SHARE * 2 * fmin(c->p.half_height, c->q.half_height);
    for (int32_t i = first; i < contacts->count; i++) {
        const contact *t = &contacts->data[i];
        if (!(t->depth <= deepest && fabs(vec3_dot(t->normal, up_a)) <= LEVEL_SINE &&
              fabs(vec3_dot(t->normal, up_b)) <= LEVEL_SINE))
            return false;
    }
    return true;
}

/* Whether the contacts are those of a patch, without a look at the pair: always, or because a patch was found there in
   the last step, which tells sooner than any axis whether the two still touch. */
static bool is_of_patch(const narrow_work *w, const pair_case *c)
{
    if (!c->policy->patch)
        return false;
    return !c->policy->sides || (w->pairs->clear[c->row] == PAIR_HAS_PATCH && !may_meet_at_sides(c));
}

/* The contacts of some pairs, and what is remembered of them. */
static bool cases_test(const narrow_work *w, pair_case *cases, int count, narrow_room *room, contact_array *contacts,
                       index_array *patch_pairs)
{
    for (int k = 0; k < count; k++) {
        pair_case *c = &cases[k];
        if (is_of_patch(w, c)) {
            if (!array_push(w->ctx, patch_pairs, c->row))
                return false;
            continue;
        }
        int32_t first = contacts->count;
        c->touches = false;
        c->whether = c->policy->sides && !may_meet_at_sides(c);
        if (!(c->plain ? touch_prisms : touch_compounds)(w->ctx, room, w->bodies, c, contacts))
            return false;
        bool patch = c->policy->sides && c->touches && !meet_at_sides(c, contacts, first);
        if (patch) {
            contacts->count = first;
            if (!array_push(w->ctx, patch_pairs, c->row))
                return false;
        }
        double travel = w->boxes->travel[c->a.slot] + w->boxes->travel[c->b.slot];
        w->pairs->axis[c->row] = c->axis;
        w->pairs->clear[c->row] = patch                    ? PAIR_HAS_PATCH
                                  : c->gap > c->near.slack ? travel + SURE_OF_GAP * (c->gap - c->near.slack)
                                                           : 0;
    }
    return true;
}

/* Pairs first..end-1, what they find appended to the arrays.  Those that may have met are taken a few at a time, so
   that memory answers for the next while the last are tested. */
static bool test_pairs(const narrow_work *w, int32_t first, int32_t end, narrow_room *room, contact_array *contacts,
                       index_array *patch_pairs)
{
    enum { CASES = 8 };
    pair_case cases[CASES];
    int waiting = 0;
    const int32_t *a = w->pairs->a, *b = w->pairs->b;
    const double *clear = w->pairs->clear, *travel = w->boxes->travel;
    for (int32_t i = first; i < end; i++) {
        if (travel[a[i]] + travel[b[i]] < clear[i])
            continue;
        const pair_policy *policy = &w->policies->of[w->bodies->material[a[i]]][w->bodies->material[b[i]]];
        case_make(w, i, policy, &cases[waiting++]);
        if (waiting < CASES)
            continue;
        if (!cases_test(w, cases, waiting, room, contacts, patch_pairs))
            return false;
        waiting = 0;
    }
    return cases_test(w, cases, waiting, room, contacts, patch_pairs);
}

/* ---- blocks of pairs ---- */

static void narrow_block(void *arg, int32_t block, int32_t thread)
{
    const narrow_work *w = arg;
    pair_block *out = &w->scratch->pair_blocks.data[block];
    int32_t first = block * w->block, rest = w->pairs->count - first;
    out->memory_failed = !test_pairs(w, first, first + (rest < w->block ? rest : w->block),
                                     &w->scratch->rooms.data[thread], &out->contacts, &out->patch_pairs);
}

static bool make_rooms(context *ctx, collision_scratch *s, int32_t threads)
{
    while (s->rooms.count < threads)
        if (!array_push(ctx, &s->rooms, (narrow_room){0}))
            return false;
    return true;
}

/* Empty blocks, with the memory they had before. */
static bool make_blocks(context *ctx, collision_scratch *s, int32_t blocks)
{
    if (!array_reserve(ctx, &s->pair_blocks, blocks))
        return false;
    for (; s->pair_blocks_made < blocks; s->pair_blocks_made++)
        s->pair_blocks.data[s->pair_blocks_made] = (pair_block){0};
    s->pair_blocks.count = blocks;
    for (int32_t i = 0; i < blocks; i++) {
        pair_block *b = &s->pair_blocks.data[i];
        array_clear(&b->contacts);
        array_clear(&b->patch_pairs);
        b->memory_failed = false;
    }
    return true;
}

/* What a block found, to its place. */
static void copy_block(void *arg, int32_t block, int32_t thread)
{
    const narrow_work *w = arg;
    const pair_block *b = &w->scratch->pair_blocks.data[block];
    (void)thread;
    if (b->contacts.count > 0)
        memcpy(w->contacts->data + b->first_contact, b->contacts.data,
               (size_t)b->contacts.count * sizeof *b->contacts.data);
    if (b->patch_pairs.count > 0)
        memcpy(w->patch_pairs->data + b->first_patch, b->patch_pairs.data,
               (size_t)b->patch_pairs.count * sizeof *b->patch_pairs.data);
}

/* What the blocks found, in their order. */
static bool join_blocks(const narrow_work *w)
{
    int32_t contacts = 0, patches = 0, blocks = w->scratch->pair_blocks.count;
    for (int32_t i = 0; i < blocks; i++) {
        pair_block *b = &w->scratch->pair_blocks.data[i];
        if (b->memory_failed)
            return false;
        b->first_contact = contacts;
        b->first_patch = patches;
        contacts += b->contacts.count;
        patches += b->patch_pairs.count;
    }
    if (!array_resize(w->ctx, w->contacts, contacts) || !array_resize(w->ctx, w->patch_pairs, patches))
        return false;
    narrow_work work = *w;
    pool_run(w->ctx, copy_block, &work, blocks);
    return true;
}

fram_status narrow_phase_run(context *ctx, const body_table *bodies, const shape_store *shapes,
                             const pair_policies *policies, const broad_table *boxes, pair_table *pairs,
                             contact_array *contacts, index_array *patch_pairs, collision_scratch *scratch,
                             fram_error *error)
{
    array_clear(contacts);
    array_clear(patch_pairs);
    int32_t block = pool_block(pairs->count, LEAST_PAIRS, MOST_PAIRS);
    narrow_work work = {ctx, bodies, shapes, boxes, policies, pairs, scratch, contacts, patch_pairs, block};
    int32_t threads = context_threads(ctx), blocks = pool_blocks(pairs->count, block);
    bool ok = make_rooms(ctx, scratch, threads);
    if (ok && threads == 1) { /* in order and into the arrays themselves: the same contacts, and no copy */
        ok = test_pairs(&work, 0, pairs->count, &scratch->rooms.data[0], contacts, patch_pairs);
    } else if (ok && blocks > 0) {
        ok = make_blocks(ctx, scratch, blocks);
        if (ok)
            pool_run(ctx, narrow_block, &work, blocks);
        ok = ok && join_blocks(&work);
    }
    return ok ? FRAM_OK : error_memory(error);
}
