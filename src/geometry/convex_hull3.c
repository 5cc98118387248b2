/* Quickhull (Barber, Dobkin and Huhdanpaa 1996) with exact visibility; see convex_hull3.h.

   Which triangles a point sees is decided exactly (predicate3.h), so the triangles in sight hang together and their rim
   is one simple ring: the surface stays closed and convex whatever lies on a plane.  Distances only choose which point
   comes next, and leave out points that stand out less than the tolerance. */
#include "geometry/convex_hull3.h"

#include "geometry/predicate3.h"

/* Rounding of a coordinate, and of a distance to a plane that is made of a few of them. */
#define ROUNDING 4e-15

typedef struct work_face {
    hull_triangle t;
    vec3 normal;      /* unit, outward */
    int32_t outside;  /* first of the points above it that are its to deal with, or -1 */
    int32_t farthest; /* of them */
    double distance;  /* of the farthest */
    bool dead, seen;
} work_face;

typedef struct rim_edge {
    int32_t from, to, beyond; /* beyond: the face out of sight */
} rim_edge;

typedef struct hull {
    const vec3 *point;
    int32_t count;
    double tolerance;
    ARRAY(work_face) face;
    int32_t *next;     /* of each point, the next one outside the same face */
    int32_t *rim_face; /* of each point on the rim, the new face whose edge begins there */
    int32_array visible;
    ARRAY(rim_edge) rim;
} hull;

double hull_rounding(const vec3 *point, int32_t count)
{
    double largest = 0;
    for (int32_t i = 0; i < count; i++)
        largest = fmax(largest, fmax(fmax(fabs(point[i].x), fabs(point[i].y)), fabs(point[i].z)));
    return ROUNDING * largest;
}

static double height(const hull *h, const work_face *f, int32_t p)
{
    return vec3_dot(f->normal, vec3_sub(h->point[p], h->point[f->t.v[0]]));
}

static bool sees(const hull *h, int32_t p, const work_face *f)
{
    return orientation3(h->point[f->t.v[0]], h->point[f->t.v[1]], h->point[f->t.v[2]], h->point[p]) > 0;
}

static bool add_face(context *ctx, hull *h, int32_t a, int32_t b, int32_t c)
{
    vec3 ab = vec3_sub(h->point[b], h->point[a]), ac = vec3_sub(h->point[c], h->point[a]);
    work_face f = {
        .t = {{a, b, c}, {-1, -1, -1}}, .normal = vec3_unit(vec3_cross(ab, ac)), .outside = -1, .farthest = -1};
    return array_push(ctx, &h->face, f);
}

/* Give p to the first face from `first` on above which it stands out, if any. */
static void assign_point(hull *h, int32_t p, int32_t first)
{
    for (int32_t i = first; i < h->face.count; i++) {
        work_face *f = &h->face.data[i];
        double d = height(h, f, p);
        if (!(d > h->tolerance) || !sees(h, p, f)) /* a sliver's normal may raise points that are not above it */
            continue;
        h->next[p] = f->outside;
        f->outside = p;
        if (f->farthest < 0 || d > f->distance) {
            f->farthest = p;
            f->distance = d;
        }
        return;
    }
}

/* Four points that span as much as is easily found; false when all are within the tolerance of a plane. */
static bool first_corners(const hull *h, int32_t corner[4])
{
    const vec3 *p = h->point;
    double best = 0;
    corner[0] = corner[1] = corner[2] = corner[3] = 0;
    for (int32_t i = 1; i < h->count; i++)
        if (p[i].x < p[corner[0]].x)
            corner[0] = i;
    for (int32_t i = 0; i < h->count; i++) {
        vec3 d = vec3_sub(p[i], p[corner[0]]);
        if (vec3_dot(d, d) > best) {
            best = vec3_dot(d, d);
            corner[1] = i;
        }
    }
    vec3 axis = vec3_unit(vec3_sub(p[corner[1]], p[corner[0]]));
    best = h->tolerance * h->tolerance;
    bool found = false;
    for (int32_t i = 0; i < h->count; i++) {
        vec3 off = vec3_cross(axis, vec3_sub(p[i], p[corner[0]]));
        if (vec3_dot(off, off) > best) {
            best = vec3_dot(off, off);
            corner[2] = i;
            found = true;
        }
    }
    if (!found)
        return false;
    vec3 normal = vec3_unit(vec3_cross(axis, vec3_sub(p[corner[2]], p[corner[0]])));
    best = h->tolerance;
    found = false;
    for (int32_t i = 0; i < h->count; i++) {
        double d = fabs(vec3_dot(normal, vec3_sub(p[i], p[corner[0]])));
        if (d > best) {
            best = d;
            corner[3] = i;
            found = true;
        }
    }
    int side = orientation3(p[corner[0]], p[corner[1]], p[corner[2]], p[corner[3]]);
    if (side > 0) { /* the fourth must be below the first three */
        int32_t swap = corner[1];
        corner[1] = corner[2];
        corner[2] = swap;
    }
    return found && side != 0;
}

static bool add_first_faces(context *ctx, hull *h, const int32_t c[4])
{
    /* Neighbours across the edges, face by face. */
    static const int32_t neighbour[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};
    if (!add_face(ctx, h, c[0], c[1], c[2]) || !add_face(ctx, h, c[1], c[0], c[3]) ||
        !add_face(ctx, h, c[2], c[1], c[3]) || !add_face(ctx, h, c[0], c[2], c[3]))
        return false;
    for (int i = 0; i < 4; i++)
        for (int k = 0; k < 3; k++)
            h->face.data[i].t.neighbour[k] = neighbour[i][k];
    for (int32_t p = 0; p < h->count; p++)
        if (p != c[0] && p != c[1] && p != c[2] && p != c[3])
            assign_point(h, p, 0);
    return true;
}

/* The faces that the eye sees, from one of them on, and the rim around them. */
static bool find_visible(context *ctx, hull *h, int32_t eye, int32_t first)
{
    array_clear(&h->visible);
    array_clear(&h->rim);
    h->face.data[first].seen = true;
    if (!array_push(ctx, &h->visible, first))
        return false;
    for (int32_t i = 0; i < h->visible.count; i++) {
        int32_t f = h->visible.data[i];
        for (int k = 0; k < 3; k++) {
            const hull_triangle *t = &h->face.data[f].t;
            int32_t g = t->neighbour[k];
            work_face *beyond = &h->face.data[g];
            if (beyond->seen)
                continue;
            if (sees(h, eye, beyond)) {
                beyond->seen = true;
                if (!array_push(ctx, &h->visible, g))
                    return false;
            } else if (!array_push(ctx, &h->rim, (rim_edge){t->v[k], t->v[(k + 1) % 3], g})) {
                return false;
            }
        }
    }
    return true;
}

static int hull_edge_from(const hull_triangle *t, int32_t v) { return t->v[0] == v ? 0 : t->v[1] == v ? 1 : 2; }

/* One new face over every edge of the rim, with the eye as tip. */
static bool add_cone(context *ctx, hull *h, int32_t eye)
{
    int32_t first = h->face.count;
    for (int32_t i = 0; i < h->rim.count; i++) {
        rim_edge e = h->rim.data[i];
        if (!add_face(ctx, h, e.from, e.to, eye))
            return false;
        h->rim_face[e.from] = first + i;
        h->face.data[first + i].t.neighbour[0] = e.beyond;
        hull_triangle *beyond = &h->face.data[e.beyond].t;
        beyond->neighbour[hull_edge_from(beyond, e.to)] = first + i;
    }
    for (int32_t i = first; i < h->face.count; i++) {
        int32_t after = h->rim_face[h->face.data[i].t.v[1]];
        h->face.data[i].t.neighbour[1] = after;
        h->face.data[after].t.neighbour[2] = i;
    }
    return true;
}

/* Take the faces in sight out; their points go to the new faces, which begin at `first`. */
static void bury_visible(hull *h, int32_t eye, int32_t first)
{
    for (int32_t i = 0; i < h->visible.count; i++) {
        work_face *f = &h->face.data[h->visible.data[i]];
        f->dead = true;
        for (int32_t p = f->outside, after; p >= 0; p = after) {
            after = h->next[p];
            if (p != eye)
                assign_point(h, p, first);
        }
        f->outside = -1;
    }
}

static bool grow(context *ctx, hull *h)
{
    int32_t corner[4];
    if (!first_corners(h, corner))
        return true; /* no faces: flat */
    if (!add_first_faces(ctx, h, corner))
        return false;
    for (int32_t i = 0; i < h->face.count; i++) {
        int32_t eye = h->face.data[i].farthest, first = h->face.count;
        if (eye < 0 || h->face.data[i].dead)
            continue;
        if (!find_visible(ctx, h, eye, i) || !add_cone(ctx, h, eye))
            return false;
        bury_visible(h, eye, first);
    }
    return true;
}

/* The faces that are left, renumbered. */
static bool collect(context *ctx, hull *h, hull_triangle_array *out)
{
    for (int32_t i = 0; i < h->face.count; i++) {
        work_face *f = &h->face.data[i];
        if (f->dead)
            continue;
        f->outside = out->count; /* free by now: the new number */
        if (!array_push(ctx, out, f->t))
            return false;
    }
    for (int32_t i = 0; i < out->count; i++)
        for (int k = 0; k < 3; k++)
            out->data[i].neighbour[k] = h->face.data[out->data[i].neighbour[k]].outside;
    return true;
}

fram_status convex_hull_triangles(context *ctx, const vec3 *point, int32_t count, double tolerance,
                                  hull_triangle_array *out, fram_error *error)
{
    array_clear(out);
    for (int32_t i = 0; i < count; i++)
        if (!isfinite(point[i].x) || !isfinite(point[i].y) || !isfinite(point[i].z))
            return error_set(error, FRAM_ERROR_INPUT, NULL, 0, NULL, "point %d of a convex hull is (%g, %g, %g)", i,
                             point[i].x, point[i].y, point[i].z);
    hull h = {.point = point, .count = count, .tolerance = fmax(tolerance, hull_rounding(point, count))};
    h.next = memory_array(ctx, (size_t)count, sizeof *h.next);
    h.rim_face = memory_array(ctx, (size_t)count, sizeof *h.rim_face);
    bool done = h.next && h.rim_face && (count < 4 || grow(ctx, &h)) && collect(ctx, &h, out);
    memory_free(ctx, h.next);
    memory_free(ctx, h.rim_face);
    array_free(ctx, &h.face);
    array_free(ctx, &h.visible);
    array_free(ctx, &h.rim);
    if (!done)
        return error_memory(error);
    if (out->count == 0)
        return error_set(error, FRAM_ERROR_INPUT, NULL, 0, NULL,
                         "the %d points of a convex hull lie in a plane within %g m", count, h.tolerance);
    return FRAM_OK;
}
