#include "dynamics/prism_contact.h"

/* A direction of a plan view counts as lying in the cone of normals of a corner up to this sine. */
#define CORNER_SLACK 0.05

/* ---- support of a compound's piece ---- */

static vec2 unit2(vec2 v)
{
    double l = vec2_length(v);
    return l > 0 ? vec2_scale(v, 1 / l) : v;
}

/* Whether a contact may push the piece at its vertex k against `direction` (unit, plan view, out of the piece): across
   an outer side that faces this way, or at a convex corner of the whole outline.  Points of the seams are no corners.
 */
static bool may_be_pushed(const prism *p, int32_t k, vec2 direction)
{
    if (p->seams == 0)
        return true;
    int32_t before = k > 0 ? k - 1 : p->count - 1;
    bool outer_before = !(p->seams >> before & 1u), outer_after = !(p->seams >> k & 1u);
    double flat = sqrt(1 - CORNER_SLACK * CORNER_SLACK);
    if ((outer_before && vec2_dot(p->side[before], direction) > flat) ||
        (outer_after && vec2_dot(p->side[k], direction) > flat))
        return true;
    int32_t c = p->corner[k], n = p->outline.count;
    if (c < 0)
        return false;
    vec2 here = p->outline.vertex[c];
    vec2 into = unit2(vec2_sub(here, p->outline.vertex[c > 0 ? c - 1 : n - 1]));
    vec2 away = unit2(vec2_sub(p->outline.vertex[c + 1 < n ? c + 1 : 0], here));
    return vec2_cross(into, away) > -CORNER_SLACK && vec2_dot(direction, into) >= -CORNER_SLACK &&
           vec2_dot(direction, away) <= CORNER_SLACK;
}

/* ---- axes ---- */

/* b's frame seen from a's, or the other way round. */
typedef struct relative_pose {
    mat3 r;
    vec3 t;
} relative_pose;

static relative_pose pose_from(const prism *from, const prism *to)
{
    const double(*f)[3] = from->rotation.m, (*t)[3] = to->rotation.m;
    relative_pose p = {.t = mat3_tmul_vec(from->rotation, vec3_sub(to->centre, from->centre))};
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            p.r.m[i][j] = f[0][i] * t[0][j] + f[1][i] * t[1][j] + f[2][i] * t[2][j];
    return p;
}

typedef struct best_side {
    int32_t side; /* -1: none */
    double depth;
    double barred; /* least depth along axes that no contact may take */
} best_side;

/* Sides of p as axes; `other` stands at `pose` in p's frame.  false: side *parting parts them. */
static bool search_sides(const prism *p, const prism *other, const relative_pose *pose, double slack, best_side *best,
                         int32_t *parting)
{
    *best = (best_side){-1, HUGE_VAL, HUGE_VAL};
    for (int32_t k = 0; k < p->count; k++) {
        vec2 n = p->side[k];
        /* The normal in the other's frame. */
        const double(*r)[3] = pose->r.m;
        vec3 m = {r[0][0] * n.x + r[1][0] * n.y, r[0][1] * n.x + r[1][1] * n.y, r[0][2] * n.x + r[1][2] * n.y};
        double low = HUGE_VAL;
        int32_t at = 0;
        for (int32_t i = 0; i < other->count; i++) {
            double d = m.x * other->vertex[i].x + m.y * other->vertex[i].y;
            if (d < low) {
                low = d;
                at = i;
            }
        }
        low += n.x * pose->t.x + n.y * pose->t.y - other->half_height * fabs(m.z);
        double depth = vec2_dot(n, p->vertex[k]) - low;
        if (depth < -slack) {
            *parting = k;
            return false;
        }
        if ((p->seams >> k & 1u) || !may_be_pushed(other, at, unit2(vec2_make(-m.x, -m.y)))) {
            best->barred = fmin(best->barred, depth);
        } else if (depth < best->depth) {
            best->depth = depth;
            best->side = k;
        }
    }
    return true;
}

/* Overlap along p's own axis. */
static double vertical_depth(const prism *p, const prism *other, const relative_pose *pose)
{
    const double *z = pose->r.m[2];
    double low = HUGE_VAL, high = -HUGE_VAL, rise = other->half_height * fabs(z[2]);
    for (int32_t i = 0; i < other->count; i++) {
        double d = z[0] * other->vertex[i].x + z[1] * other->vertex[i].y;
        low = d < low ? d : low;
        high = d > high ? d : high;
    }
    return pose->t.z > 0 ? p->half_height - (pose->t.z + low - rise) : (pose->t.z + high + rise) + p->half_height;
}

static vec3 global_normal(const prism *p, int32_t side)
{
    vec2 n = p->side[side];
    return mat3_mul_vec(p->rotation, vec3_make(n.x, n.y, 0));
}

static vec3 place_vertex(const prism *p, int32_t k, double z)
{
    return vec3_add(p->centre, mat3_mul_vec(p->rotation, vec3_make(p->vertex[k].x, p->vertex[k].y, z)));
}

/* ---- contact of two sides ---- */

/* A point of the opposed side in the frame of the reference side: along it, up, and how deep behind it. */
typedef struct side_point {
    double at[3];
    uint32_t edge; /* name of the polygon's edge that starts here */
} side_point;
enum { ALONG, UP, DEPTH };
/* Four clips of four corners give eight at most, but for roundings along an edge. */
enum { SIDE_CORNERS = 4, SIDE_MOST = 16 };

/* Cuts off the part of a polygon with sign * at[k] > bound; new edges are called `name`.  *in holds the result, and
   changes places with *out when something was cut. */
static int clip_side(side_point **in, side_point **out, int n, int k, double sign, double bound, uint32_t name)
{
    double beyond[SIDE_MOST];
    bool cuts = false;
    for (int i = 0; i < n; i++) {
        beyond[i] = sign * (*in)[i].at[k] - bound;
        cuts = cuts || !(beyond[i] <= 0);
    }
    if (!cuts)
        return n;
    int count = 0;
    for (int i = 0; i < n && count < SIDE_MOST - 1; i++) {
        int after = i + 1 < n ? i + 1 : 0;
        const side_point *here = &(*in)[i], *next = &(*in)[after];
        bool inside = beyond[i] <= 0;
        if (inside)
            (*out)[count++] = *here;
        if (inside == (beyond[after] <= 0))
            continue;
        double share = beyond[i] / (beyond[i] - beyond[after]);
        side_point *cut = &(*out)[count++];
        for (int c = 0; c < 3; c++)
            cut->at[c] = here->at[c] + (next->at[c] - here->at[c]) * share;
        cut->edge = inside ? name : here->edge;
    }
    side_point *swapped = *in;
    *in = *out;
    *out = swapped;
    return count;
}

/* The side of a prism that starts at vertex k, in its plan view. */
typedef struct side_frame {
    vec2 start, along, normal; /* units; normal outward */
    double length;
} side_frame;

static side_frame side_frame_of(const prism *p, int32_t k, vec2 normal)
{
    vec2 start = p->vertex[k], along = vec2_perp(normal);
    vec2 end = p->vertex[k + 1 < p->count ? k + 1 : 0];
    return (side_frame){start, along, normal, vec2_dot(vec2_sub(end, start), along)};
}

/* Corners of side k of `other`, as seen from a side of the holder: from its lower start counter-clockwise. */
static void opposed_corners(const prism *other, int32_t k, const relative_pose *pose, const side_frame *side,
                            side_point out[SIDE_CORNERS])
{
    vec2 ends[2] = {other->vertex[k], other->vertex[k + 1 < other->count ? k + 1 : 0]};
    for (uint32_t i = 0; i < SIDE_CORNERS; i++) {
        vec2 v = ends[i == 1 || i == 2];
        double z = i < 2 ? -other->half_height : other->half_height;
        vec3 p = vec3_add(mat3_mul_vec(pose->r, vec3_make(v.x, v.y, z)), pose->t);
        vec2 from = vec2_sub(vec2_make(p.x, p.y), side->start);
        out[i] = (side_point){{vec2_dot(from, side->along), p.z, -vec2_dot(from, side->normal)}, i};
    }
}

/* The opposed side clipped by the reference side: at most four points, as face_manifold names and chooses them. */
static int contact_at_side(const prism *holder, const prism *other, const prism_meeting *m, nearness near,
                           vec3 *outward, manifold_point out[4])
{
    side_point buffer[2][SIDE_MOST];
    relative_pose pose = pose_from(holder, other);
    side_frame side = side_frame_of(holder, m->side, m->normal);
    opposed_corners(other, m->opposed, &pose, &side, buffer[0]);
    side_point *corner = buffer[0], *room = buffer[1];
    int n = clip_side(&corner, &room, SIDE_CORNERS, UP, -1, holder->half_height, CLIP_MOST / 2);
    n = clip_side(&corner, &room, n, ALONG, 1, side.length, CLIP_MOST / 2 + 1);
    n = clip_side(&corner, &room, n, UP, 1, holder->half_height, CLIP_MOST / 2 + 2);
    n = clip_side(&corner, &room, n, ALONG, -1, 0, CLIP_MOST / 2 + 3);
    *outward = mat3_mul_vec(holder->rotation, vec3_make(side.normal.x, side.normal.y, 0));
    manifold_point point[SIDE_MOST];
    double deepest = -HUGE_VAL;
    int count = 0;
    for (int i = 0; i < n; i++) {
        const side_point *v = &corner[i], *before = &corner[i > 0 ? i - 1 : n - 1];
        deepest = v->at[DEPTH] > deepest ? v->at[DEPTH] : deepest;
        if (!(v->at[DEPTH] > -near.reach))
            continue;
        vec2 plan = vec2_add(
            side.start, vec2_sub(vec2_scale(side.along, v->at[ALONG]), vec2_scale(side.normal, 0.5 * v->at[DEPTH])));
        vec3 local = {plan.x, plan.y, v->at[UP]};
        point[count++] = (manifold_point){
            vec3_add(holder->centre, mat3_mul_vec(holder->rotation, local)), v->at[DEPTH],
            manifold_feature(m->swapped, (uint32_t)m->side, (uint32_t)m->opposed, before->edge, v->edge)};
    }
    return deepest > -near.slack ? manifold_reduce(point, count, *outward, out) : 0;
}

static int32_t opposed_side(const prism *p, vec3 direction)
{
    vec3 seen = mat3_tmul_vec(p->rotation, direction);
    int32_t opposed = 0;
    double least = HUGE_VAL;
    for (int32_t k = 0; k < p->count; k++) {
        double d = vec2_dot(p->side[k], vec2_make(seen.x, seen.y));
        if (d < least) {
            least = d;
            opposed = k;
        }
    }
    return opposed;
}

/* ---- the general way ---- */

bool prism_polyhedron_reserve(context *ctx, polyhedron *room)
{
    enum { MOST = PIECE_MOST_VERTICES };
    return array_reserve(ctx, &room->vertex, 2 * MOST) && array_reserve(ctx, &room->face, MOST + 2) &&
           array_reserve(ctx, &room->loop, 6 * MOST) && array_reserve(ctx, &room->edge_direction, MOST + 1);
}

static void add_face(polyhedron *room, vec3 normal, vec3 on, int32_t count)
{
    int32_t first = room->loop.count;
    room->loop.count += count;
    room->face.data[room->face.count++] = (polyhedron_face){normal, vec3_dot(normal, on), first, count, false};
}

void prism_polyhedron(const prism *p, polyhedron *room)
{
    int32_t n = p->count;
    vec3 z = mat3_column(p->rotation, 2);
    room->vertex.count = room->face.count = room->loop.count = room->edge_direction.count = 0;
    room->centre = vec3_make(0, 0, 0);
    for (int32_t k = 0; k < n; k++)
        room->vertex.data[room->vertex.count++] = place_vertex(p, k, -p->half_height);
    for (int32_t k = 0; k < n; k++)
        room->vertex.data[room->vertex.count++] = place_vertex(p, k, p->half_height);
    for (int32_t k = 0; k < 2 * n; k++)
        room->centre = vec3_mad(room->centre, room->vertex.data[k], 1 / (2.0 * n));
    for (int32_t k = 0; k < n; k++) {
        int32_t next = k + 1 < n ? k + 1 : 0, *loop = room->loop.data + room->loop.count;
        loop[0] = k;
        loop[1] = next;
        loop[2] = n + next;
        loop[3] = n + k;
        vec3 normal = global_normal(p, k), along = vec3_cross(z, normal);
        add_face(room, normal, room->vertex.data[k], 4);
        room->edge_direction.data[room->edge_direction.count++] = along;
    }
    room->edge_direction.data[room->edge_direction.count++] = z;
    int32_t *top = room->loop.data + room->loop.count, *bottom = top + n;
    for (int32_t k = 0; k < n; k++) {
        top[k] = n + k;
        bottom[k] = n - 1 - k;
    }
    add_face(room, z, room->vertex.data[n], n);
    add_face(room, vec3_neg(z), room->vertex.data[0], n);
    double square = 0;
    for (int32_t k = 0; k < 2 * n; k++) {
        vec3 d = vec3_sub(room->vertex.data[k], room->centre);
        square = fmax(square, vec3_dot(d, d));
    }
    room->radius = sqrt(square);
}

/* ---- both ---- */

int prism_meeting_points(const prism *a, const prism *b, const prism_meeting *m, nearness near, polyhedron *a_room,
                         polyhedron *b_room, vec3 *normal, manifold_point out[4], vec3 *axis)
{
    *axis = vec3_make(0, 0, 0);
    if (m->kind == PRISMS_TILTED) {
        prism_polyhedron(a, a_room);
        prism_polyhedron(b, b_room);
        return polyhedra_manifold(a_room, b_room, &(pair_seams){{.faces = a->seams}, {.faces = b->seams}, false}, near,
                                  normal, out, axis);
    }
    vec3 outward;
    int count = contact_at_side(m->swapped ? b : a, m->swapped ? a : b, m, near, &outward, out);
    *normal = m->swapped ? outward : vec3_neg(outward);
    return count;
}

/* How two pieces meet, seams and all. */
static prism_meeting prism_meet(const prism *a, const prism *b, nearness near)
{
    relative_pose b_in_a = pose_from(a, b), a_in_b = pose_from(b, a);
    best_side in_a, in_b;
    int32_t parting;
    prism_meeting m = {.kind = PRISMS_APART};
    if (!search_sides(a, b, &b_in_a, near.slack, &in_a, &parting)) {
        m.axis = vec3_neg(global_normal(a, parting));
        return m;
    }
    if (!search_sides(b, a, &a_in_b, near.slack, &in_b, &parting)) {
        m.axis = global_normal(b, parting);
        return m;
    }
    double rise_a = vertical_depth(a, b, &b_in_a), rise_b = vertical_depth(b, a, &a_in_b);
    if (rise_a < -near.slack || rise_b < -near.slack) {
        vec3 up = mat3_column((rise_a < -near.slack ? a : b)->rotation, 2);
        m.axis = vec3_scale(up, vec3_dot(up, vec3_sub(a->centre, b->centre)) < 0 ? -1 : 1);
        return m;
    }
    m.swapped = in_b.side >= 0 && (in_a.side < 0 || clearly_less(in_b.depth, in_a.depth, near.slack));
    const best_side *best = m.swapped ? &in_b : &in_a;
    bool upright =
        fabs(b_in_a.r.m[2][2]) > NEARLY_LEVEL && !clearly_less(fmin(rise_a, rise_b), best->depth, near.slack);
    m.kind = !upright                                                          ? PRISMS_TILTED
             : best->depth > SEAM_DEPTH_RATIO * fmin(in_a.barred, in_b.barred) ? PRISMS_BARRED
                                                                               : PRISMS_AT_SIDES;
    if (m.kind != PRISMS_AT_SIDES)
        return m;
    const prism *holder = m.swapped ? b : a;
    m.side = best->side;
    m.normal = holder->side[best->side];
    m.opposed = opposed_side(m.swapped ? a : b, global_normal(holder, best->side));
    return m;
}

int prism_manifold(const prism *a, const prism *b, nearness near, polyhedron *a_room, polyhedron *b_room, vec3 *normal,
                   manifold_point out[4], vec3 *axis)
{
    prism_meeting m = prism_meet(a, b, near);
    *axis = m.axis;
    if (m.kind == PRISMS_APART || m.kind == PRISMS_BARRED)
        return 0;
    return prism_meeting_points(a, b, &m, near, a_room, b_room, normal, out, axis);
}
