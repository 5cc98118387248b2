/* The general narrow phase: separating axes of two convex polyhedra over face normals and edge pairs. */
#include "dynamics/manifold.h"

typedef struct axis_span {
    double low, high;
} axis_span;

static axis_span project(const polyhedron *p, vec3 axis)
{
    axis_span s = {HUGE_VAL, -HUGE_VAL};
    for (int32_t i = 0; i < p->vertex.count; i++) {
        double d = vec3_dot(axis, p->vertex.data[i]);
        s.low = d < s.low ? d : s.low;
        s.high = d > s.high ? d : s.high;
    }
    return s;
}

static double lowest(const polyhedron *p, vec3 axis)
{
    double low = HUGE_VAL;
    for (int32_t i = 0; i < p->vertex.count; i++) {
        double d = vec3_dot(axis, p->vertex.data[i]);
        low = d < low ? d : low;
    }
    return low;
}

/* Best candidate so far; depth is how far the bodies overlap along it. */
typedef struct best_face {
    int32_t face; /* -1: none */
    double depth;
    double seam_depth; /* least depth along a seam, which bounds what an outer face may stand for */
} best_face;

/* All faces come after it. */
static const best_face NO_FACE = {-1, -HUGE_VAL, HUGE_VAL};

static bool comes_after(const best_face *last, int32_t face, double depth)
{
    return depth > last->depth || (depth == last->depth && face > last->face);
}

/* The face of least depth among those that come after *best, by depth and number.  false: some face of p parts the
   bodies, and *axis is its normal. */
static bool search_faces(const polyhedron *p, const polyhedron *other, uint64_t seams, double slack, best_face *best,
                         vec3 *axis)
{
    best_face last = *best;
    *best = (best_face){-1, HUGE_VAL, last.seam_depth};
    for (int32_t i = 0; i < p->face.count; i++) {
        const polyhedron_face *f = &p->face.data[i];
        double depth = f->offset - lowest(other, f->normal);
        if (depth < -slack) {
            *axis = f->normal;
            return false;
        }
        bool seam = i < 64 && (seams >> i & 1u);
        if (seam) {
            best->seam_depth = fmin(best->seam_depth, depth);
        } else if (depth < best->depth && comes_after(&last, i, depth)) {
            best->depth = depth;
            best->face = i;
        }
    }
    return true;
}

typedef struct best_edges {
    int32_t a, b; /* edge directions; -1: none */
    double depth;
    vec3 axis; /* from b to a */
} best_edges;

/* Edge pairs nearer to parallel than this give no axis that a face does not give. */
#define PARALLEL_SINE 1e-6

static bool search_edges(const polyhedron *a, const polyhedron *b, double slack, best_edges *best)
{
    *best = (best_edges){-1, -1, HUGE_VAL, {0, 0, 0}};
    vec3 apart = vec3_sub(a->centre, b->centre);
    for (int32_t i = 0; i < a->edge_direction.count; i++) {
        for (int32_t j = 0; j < b->edge_direction.count; j++) {
            vec3 axis = vec3_cross(a->edge_direction.data[i], b->edge_direction.data[j]);
            double length = vec3_length(axis);
            if (length < PARALLEL_SINE)
                continue;
            axis = vec3_scale(axis, (vec3_dot(axis, apart) < 0 ? -1 : 1) / length);
            double depth = project(b, axis).high - project(a, axis).low;
            if (depth < best->depth)
                *best = (best_edges){i, j, depth, axis};
            if (depth < -slack)
                return false;
        }
    }
    return true;
}

/* ---- contact at a face ---- */

static void take_face(const polyhedron *p, int32_t face, flat_face *out)
{
    const polyhedron_face *f = &p->face.data[face];
    int32_t step = f->count / (CLIP_MOST / 2) + 1;
    out->count = 0;
    for (int32_t i = 0; i < f->count; i += step)
        out->point[out->count++] = p->vertex.data[p->loop.data[f->first + i]];
    out->normal = f->normal;
    out->name = (uint32_t)face;
}

static int32_t most_opposed_face(const polyhedron *p, vec3 normal)
{
    int32_t best = 0;
    double least = HUGE_VAL;
    for (int32_t i = 0; i < p->face.count; i++) {
        double d = vec3_dot(p->face.data[i].normal, normal);
        if (d < least) {
            least = d;
            best = i;
        }
    }
    return best;
}

static int contact_at_face(const polyhedron *holder, int32_t face, const polyhedron *other, nearness near, bool swapped,
                           manifold_point out[4])
{
    flat_face reference, incident;
    take_face(holder, face, &reference);
    take_face(other, most_opposed_face(other, reference.normal), &incident);
    return face_manifold(&reference, &incident, near, swapped, out);
}

/* ---- contact of two edges ---- */

typedef struct edge_found {
    vec3 from, to;
    uint32_t name;
} edge_found;

/* The edge parallel to `direction` that lies farthest along `axis`. */
static edge_found extreme_edge(const polyhedron *p, vec3 direction, vec3 axis)
{
    edge_found found = {{0, 0, 0}, {0, 0, 0}, 0};
    double most = -HUGE_VAL;
    for (int32_t i = 0; i < p->face.count; i++) {
        const polyhedron_face *f = &p->face.data[i];
        for (int32_t k = 0; k < f->count; k++) {
            vec3 from = p->vertex.data[p->loop.data[f->first + k]];
            vec3 to = p->vertex.data[p->loop.data[f->first + (k + 1 < f->count ? k + 1 : 0)]];
            vec3 e = vec3_sub(to, from), skew = vec3_cross(e, direction);
            double reach = vec3_dot(axis, vec3_add(from, to));
            if (vec3_dot(skew, skew) <= 1e-8 * vec3_dot(e, e) && reach > most) {
                most = reach;
                found = (edge_found){from, to, (uint32_t)(f->first + k)};
            }
        }
    }
    return found;
}

static double clamp_unit(double x) { return x < 0 ? 0 : x > 1 ? 1 : x; }

/* Midway between the nearest points of two segments.  Bodies may have edges without length, and edges that differ by
   less than extreme_edge tells apart, so that those found are parallel although the directions that led to them are
   not: middles serve then. */
static vec3 between_edges(edge_found a, edge_found b)
{
    vec3 d = vec3_sub(a.to, a.from), e = vec3_sub(b.to, b.from), r = vec3_sub(a.from, b.from);
    double dd = vec3_dot(d, d), ee = vec3_dot(e, e), de = vec3_dot(d, e), dr = vec3_dot(d, r), er = vec3_dot(e, r);
    double square = dd * ee - de * de;
    bool crossed = square > PARALLEL_SINE * PARALLEL_SINE * dd * ee;
    double s = crossed ? clamp_unit((de * er - dr * ee) / square) : 0.5;
    double t = ee > 0 ? clamp_unit((de * s + er) / ee) : 0.5;
    return vec3_scale(vec3_add(vec3_mad(a.from, d, s), vec3_mad(b.from, e, t)), 0.5);
}

static int contact_at_edges(const polyhedron *a, const polyhedron *b, const best_edges *edges, manifold_point out[4])
{
    edge_found ea = extreme_edge(a, a->edge_direction.data[edges->a], vec3_neg(edges->axis));
    edge_found eb = extreme_edge(b, b->edge_direction.data[edges->b], edges->axis);
    uint32_t feature = 1u << 31 | (ea.name & 0x7fffu) << 15 | (eb.name & 0x7fffu);
    out[0] = (manifold_point){between_edges(ea, eb), edges->depth, feature};
    return 1;
}

/* ---- both ---- */

/* Whether no point of a contact is on the outside of the whole solid: each lies at another of its pieces, and that one
   goes on beyond the plane through it.  `outward`: the contact's normal out of this piece. */
static bool is_inside(const piece_seams *s, const manifold_point *point, int count, vec3 outward)
{
    if (!s->pieces)
        return false;
    const polyhedron *piece = s->pieces->data;
    double seam = piece[s->piece].seam;
    vec3 out = mat3_tmul_vec(s->rotation, outward);
    for (int i = 0; i < count; i++) {
        vec3 at = vec3_mad(vec3_sub(point[i].point, s->centre), outward, 0.5 * point[i].depth);
        at = mat3_tmul_vec(s->rotation, at);
        bool covered = false;
        for (int32_t k = 0; k < s->pieces->count && !covered; k++)
            covered = k != s->piece && polyhedron_contains(&piece[k], at, seam) &&
                      project(&piece[k], out).high > vec3_dot(out, at) + seam;
        if (!covered)
            return false;
    }
    return true;
}

/* Whether a contact at a face of `holder` pushes at the inside of either solid.  Only faces on cuts can be inside their
   own: of two that meet in a hollow corner one was not cut, so that one always holds.  The other solid is met where it
   reaches deepest: if that is no outside, the face bears on no corner or side of the whole. */
static bool is_barred(const polyhedron *holder, int32_t face, const piece_seams *of_holder, const piece_seams *of_other,
                      const manifold_point *point, int count)
{
    const polyhedron_face *f = &holder->face.data[face];
    if (f->on_cut && is_inside(of_holder, point, count, f->normal))
        return true;
    int deepest = 0;
    for (int i = 1; i < count; i++)
        if (point[i].depth > point[deepest].depth)
            deepest = i;
    return is_inside(of_other, &point[deepest], 1, vec3_neg(f->normal));
}

/* The first contact that pushes at no inside, from the one of least depth on.  Once one was dropped a face that meets
   nothing is no answer either. */
static int first_contact(const polyhedron *a, const polyhedron *b, pair_seams *seams, nearness near, best_face *in_a,
                         best_face *in_b, best_edges *edges, vec3 *normal, manifold_point out[4])
{
    double seam_depth = fmin(in_a->seam_depth, in_b->seam_depth);
    bool with_edges = edges->a >= 0 && !seams->a.faces && !seams->b.faces;
    for (;;) {
        bool of_b = in_b->face >= 0 && (in_a->face < 0 || clearly_less(in_b->depth, in_a->depth, near.slack));
        best_face *best = of_b ? in_b : in_a;
        if (best->face < 0 || best->depth > SEAM_DEPTH_RATIO * seam_depth)
            return 0;
        /* Edges along a face have its axis: none are taken where that one was barred. */
        if (with_edges && clearly_less(edges->depth, fmin(best->depth, seam_depth), near.slack)) {
            *normal = edges->axis;
            int count = contact_at_edges(a, b, edges, out);
            if (!is_inside(&seams->a, out, count, vec3_neg(*normal)) && !is_inside(&seams->b, out, count, *normal))
                return count;
            with_edges = false;
            seams->dropped = true;
            continue;
        }
        const polyhedron *holder = of_b ? b : a, *other = of_b ? a : b;
        vec3 n = holder->face.data[best->face].normal, none;
        *normal = of_b ? n : vec3_neg(n);
        int count = contact_at_face(holder, best->face, other, near, of_b, out);
        bool barred = count > 0 && is_barred(holder, best->face, of_b ? &seams->b : &seams->a,
                                             of_b ? &seams->a : &seams->b, out, count);
        if (!barred && (count > 0 || !seams->dropped))
            return count;
        if (barred)
            seam_depth = fmin(seam_depth, best->depth);
        seams->dropped = seams->dropped || barred;
        search_faces(holder, other, of_b ? seams->b.faces : seams->a.faces, near.slack, best, &none);
    }
}

static bool parted_along(const polyhedron *a, const polyhedron *b, vec3 axis, double slack)
{
    return vec3_dot(axis, axis) > 0 && project(a, axis).low - project(b, axis).high > slack;
}

int polyhedra_manifold(const polyhedron *a, const polyhedron *b, pair_seams *seams, nearness near, vec3 *normal,
                       manifold_point out[4], vec3 *axis)
{
    seams->dropped = false;
    if (parted_along(a, b, *axis, near.slack))
        return 0;
    best_face in_a = NO_FACE, in_b = NO_FACE;
    best_edges edges;
    if (!search_faces(a, b, seams->a.faces, near.slack, &in_a, axis)) {
        *axis = vec3_neg(*axis);
        return 0;
    }
    if (!search_faces(b, a, seams->b.faces, near.slack, &in_b, axis))
        return 0;
    if (!search_edges(a, b, near.slack, &edges)) {
        *axis = edges.axis;
        return 0;
    }
    *axis = vec3_make(0, 0, 0);
    return first_contact(a, b, seams, near, &in_a, &in_b, &edges, normal, out);
}
