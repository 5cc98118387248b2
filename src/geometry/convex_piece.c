/* How concave is a piece?  See convex_piece.h.

   A place of the solid's surface is covered when a step along its outward normal stays in the hull.  Its depth is then
   the distance to the hull's faces.  Those in a cutting plane count only where no other hull goes on behind them: a
   groove that is cut across is as deep as before.

   Inside a hull, depth is a nearly concave function over every triangle of the surface: it is sampled at seven places,
   and climbed where it may exceed what was found before. */
#include "geometry/convex_piece.h"

#include "geometry/polyhedron_build.h"

#include <string.h>

/* Depths that matter, over what is small, from which on most places are found not to be that deep by a face or two. */
#define WORTH_ASKING 4
/* Hulls of two pieces are apart by less than this, over what is small, where they were cut: each leaves points that
   stand out by less than that on its side of the plane, and the cut as much again. */
#define SEAM_TO_SMALL 4

typedef struct measure {
    const convex_piece *piece;
    double small;
    const hull_list *all;
    int32_t hint;    /* the hull face that the last uncovered place was outside of */
    int32_t nearest; /* the one that the last covered place was nearest to */
    double deepest;
    vec3 place;
    int32_t face;
    int32_t corner[3]; /* vertices of the triangle that is being measured */
} measure;

void convex_piece_free(context *ctx, convex_piece *p)
{
    mesh_free(ctx, &p->surface);
    mesh_adjacency_free(ctx, &p->adjacency);
    array_free(ctx, &p->cuts);
    polyhedron_free(ctx, &p->hull);
    array_free(ctx, &p->start);
    array_free(ctx, &p->hull_face);
}

void convex_piece_array_free(context *ctx, convex_piece_array *a)
{
    for (int32_t i = 0; i < a->count; i++)
        convex_piece_free(ctx, &a->data[i]);
    array_free(ctx, a);
}

static bool in_plane(const plane3 *cut, vec3 p, double small)
{
    return fabs(vec3_dot(cut->normal, p) - cut->offset) <= 2 * small;
}

static bool hull_face_in_cut(const convex_piece *p, const polyhedron_face *f, double small)
{
    for (int32_t c = 0; c < p->cuts.count; c++) {
        bool all = true;
        for (int32_t i = 0; i < f->count && all; i++)
            all = in_plane(&p->cuts.data[c], p->hull.vertex.data[p->hull.loop.data[f->first + i]], small);
        if (all)
            return true;
    }
    return false;
}

static bool surface_in_cut(const convex_piece *p, const vec3 t[3], double small)
{
    for (int32_t c = 0; c < p->cuts.count; c++) {
        const plane3 *cut = &p->cuts.data[c];
        if (in_plane(cut, t[0], small) && in_plane(cut, t[1], small) && in_plane(cut, t[2], small))
            return true;
    }
    return false;
}

static bool outside_of(const measure *m, int32_t face, vec3 point)
{
    const polyhedron_face *f = &m->piece->hull.face.data[face];
    return vec3_dot(f->normal, point) > f->offset + m->small;
}

/* The place a step along the outward normal from the surface. */
static vec3 ahead_of(const measure *m, vec3 point, vec3 normal) { return vec3_mad(point, normal, 4 * m->small); }

/* Whether one of the hull's faces that most likely tell says that the place is not covered. */
static bool soon_uncovered(measure *m, vec3 point, vec3 normal)
{
    vec3 ahead = ahead_of(m, point, normal);
    if (outside_of(m, m->hint, ahead))
        return true;
    const convex_piece *p = m->piece;
    for (int c = 0; c < 3; c++)
        for (int32_t i = p->start.data[m->corner[c]]; i < p->start.data[m->corner[c] + 1]; i++)
            if (outside_of(m, p->hull_face.data[i], ahead)) {
                m->hint = p->hull_face.data[i];
                return true;
            }
    return false;
}

static bool covered(measure *m, vec3 point, vec3 normal)
{
    vec3 ahead = ahead_of(m, point, normal);
    for (int32_t k = 0; k < m->piece->hull.face.count; k++)
        if (outside_of(m, k, ahead)) {
            m->hint = k;
            return false;
        }
    return true;
}

static vec3 nearest_on_face(const polyhedron *p, const polyhedron_face *f, vec3 point, double height)
{
    vec3 nearest = vec3_mad(point, f->normal, height);
    double least = HUGE_VAL;
    bool above = true;
    for (int32_t i = 0; i < f->count; i++) {
        vec3 a = p->vertex.data[p->loop.data[f->first + i]];
        vec3 b = p->vertex.data[p->loop.data[f->first + (i + 1) % f->count]];
        above = above && vec3_dot(vec3_cross(f->normal, vec3_sub(b, a)), vec3_sub(point, a)) >= 0;
    }
    for (int32_t i = 0; i < f->count && !above; i++) {
        vec3 a = p->vertex.data[p->loop.data[f->first + i]];
        vec3 q = segment_nearest3(point, a, p->vertex.data[p->loop.data[f->first + (i + 1) % f->count]]);
        double d = vec3_length(vec3_sub(q, point));
        if (d < least) {
            least = d;
            nearest = q;
        }
    }
    return nearest;
}

/* A hull goes on behind a place on a face. */
static bool goes_on(const measure *m, vec3 place, vec3 normal)
{
    vec3 behind = vec3_mad(place, normal, 4 * m->small);
    for (int32_t i = 0; i < m->all->count; i++) {
        const polyhedron *h = m->all->data[i];
        vec3 off = vec3_sub(behind, h->centre);
        if (vec3_dot(off, off) <= h->radius * h->radius && polyhedron_contains(h, behind, 0))
            return true;
    }
    return false;
}

/* Whether hull face k is nearer to the place than *best, which then becomes its distance. */
static void try_face(measure *m, int32_t k, vec3 point, double *best)
{
    const polyhedron *hull = &m->piece->hull;
    const polyhedron_face *f = &hull->face.data[k];
    double height = fmax(0, f->offset - vec3_dot(f->normal, point));
    if (height >= *best)
        return;
    vec3 nearest = nearest_on_face(hull, f, point, height);
    double distance = vec3_length(vec3_sub(nearest, point));
    if (distance < *best && !(f->on_cut && goes_on(m, nearest, f->normal))) {
        *best = distance;
        m->nearest = k;
    }
}

/* Depth of a covered place, or something at most `enough` when it is at most that.  First are asked the face that was
   nearest last time, since places that are asked about one after the other are neighbours, and those at the corners of
   the triangle: mostly one of them is near enough. */
static double depth(measure *m, vec3 point, double enough)
{
    const convex_piece *piece = m->piece;
    double best = 2 * piece->hull.radius; /* a hull that is all cuts has no surface to be far from */
    try_face(m, m->nearest, point, &best);
    for (int c = 0; c < 3; c++)
        for (int32_t i = piece->start.data[m->corner[c]]; i < piece->start.data[m->corner[c] + 1] && best > enough; i++)
            try_face(m, piece->hull_face.data[i], point, &best);
    for (int32_t k = 0; k < piece->hull.face.count && best > enough; k++)
        try_face(m, k, point, &best);
    return best;
}

static vec3 place_on(const vec3 t[3], double u, double v)
{
    return vec3_mad(vec3_mad(t[0], vec3_sub(t[1], t[0]), u), vec3_sub(t[2], t[0]), v);
}

/* Compass search from the best sample; u, v and 1 - u - v are the weights of the corners. */
static void climb(measure *m, const vec3 t[3], double u, double v, double best, int32_t face)
{
    static const double direction[6][2] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, -1}, {-1, 1}};
    for (double step = 0.25; step > 0.02;) {
        bool moved = false;
        for (int k = 0; k < 6 && !moved; k++) {
            double x = u + step * direction[k][0], y = v + step * direction[k][1];
            if (x < 0 || y < 0 || x + y > 1)
                continue;
            double d = depth(m, place_on(t, x, y), best);
            if (d > best) {
                best = d;
                u = x;
                v = y;
                moved = true;
            }
        }
        if (!moved)
            step /= 2;
    }
    if (best > m->deepest) {
        m->deepest = best;
        m->place = place_on(t, u, v);
        m->face = face;
    }
}

static void measure_face(measure *m, int32_t face)
{
    static const double sample[7][2] = {{0, 0}, {1, 0}, {0, 1}, {0.5, 0}, {0.5, 0.5}, {0, 0.5}, {1.0 / 3, 1.0 / 3}};
    vec3 t[3], normal;
    mesh_face_points(&m->piece->surface, face, t);
    if (surface_in_cut(m->piece, t, m->small))
        return;
    normal = vec3_unit(mesh_area_vector(&m->piece->surface, face));
    memcpy(m->corner, m->piece->surface.face.data[face].v, sizeof m->corner);
    double best = 0;
    int where = -1;
    /* Concave over the triangle, depth is nowhere more than three times what the best of these places has. */
    for (int k = 0; k < 7; k++) {
        vec3 p = place_on(t, sample[k][0], sample[k][1]);
        if (soon_uncovered(m, p, normal))
            continue;
        /* Depth is asked first where it may be less than enough, though it counts only where the hull covers the place:
           mostly one face tells that it is less, and only all faces tell that a place is covered. */
        double enough = fmax(best, m->deepest / 3);
        bool depth_first = enough > WORTH_ASKING * m->small;
        if (!depth_first && !covered(m, p, normal))
            continue;
        double d = depth(m, p, enough);
        if (d > enough && (!depth_first || covered(m, p, normal))) {
            best = d;
            where = k;
        }
    }
    if (where >= 0)
        climb(m, t, sample[where][0], sample[where][1], best, face);
}

/* Tells the faces of the hull that lie on cuts. */
static void mark_cuts(convex_piece *p, double small)
{
    for (int32_t k = 0; k < p->hull.face.count; k++)
        p->hull.face.data[k].on_cut = hull_face_in_cut(p, &p->hull.face.data[k], small);
    p->hull.seam = p->cuts.count > 0 ? SEAM_TO_SMALL * small : 0;
}

void convex_piece_measure(convex_piece *p, const hull_list *all, double small)
{
    measure m = {.piece = p, .small = small, .all = all, .face = -1};
    for (int32_t f = 0; f < p->surface.face.count; f++)
        measure_face(&m, f);
    p->concavity = m.deepest;
    p->deepest = m.place;
    p->deepest_face = m.face;
}

/* Which faces of the hull meet at which vertex of the surface: those of the hull are among them, in their order. */
static bool list_hull_faces(context *ctx, convex_piece *p)
{
    const polyhedron *h = &p->hull;
    int32_t count = p->surface.vertex.count;
    int32_t *vertex = memory_array(ctx, (size_t)h->vertex.count, sizeof *vertex); /* of the surface, of each hull's */
    bool done = vertex && array_resize(ctx, &p->start, count + 1) && array_resize(ctx, &p->hull_face, h->loop.count);
    if (done)
        memset(p->start.data, 0, ((size_t)count + 1) * sizeof *p->start.data);
    for (int32_t v = 0, at = 0; done && v < count && at < h->vertex.count; v++)
        if (memcmp(&p->surface.vertex.data[v], &h->vertex.data[at], sizeof *h->vertex.data) == 0)
            vertex[at++] = v;
    for (int32_t i = 0; done && i < h->loop.count; i++)
        p->start.data[vertex[h->loop.data[i]] + 1]++;
    for (int32_t v = 0; done && v < count; v++)
        p->start.data[v + 1] += p->start.data[v];
    /* Filled from behind, so that the starts come to stand where they belong. */
    for (int32_t k = h->face.count; done && k-- > 0;)
        for (int32_t i = 0; i < h->face.data[k].count; i++) {
            int32_t v = vertex[h->loop.data[h->face.data[k].first + i]];
            p->hull_face.data[--p->start.data[v + 1]] = k;
        }
    if (done)
        memmove(p->start.data, p->start.data + 1, (size_t)count * sizeof *p->start.data);
    if (done)
        p->start.data[count] = h->loop.count;
    memory_free(ctx, vertex);
    return done;
}

fram_status convex_piece_complete(context *ctx, convex_piece *p, double small, fram_error *error)
{
    if (mesh_adjacency_build(ctx, &p->surface, &p->adjacency) != FRAM_OK)
        return error_memory(error);
    p->volume = mesh_solid_properties(&p->surface).volume;
    fram_status status = polyhedron_hull(ctx, p->surface.vertex.data, p->surface.vertex.count, small, &p->hull, error);
    if (status == FRAM_OK && !list_hull_faces(ctx, p))
        status = error_memory(error);
    if (status == FRAM_OK)
        mark_cuts(p, small);
    return status;
}
