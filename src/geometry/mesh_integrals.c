/* Moments of every node from the leaves up, and sample points from the root down; see mesh_integrals.h. */
#include "geometry/mesh_integrals.h"

static void add_outer(mat3 *to, vec3 a, vec3 b)
{
    const double x[3] = {a.x, a.y, a.z}, y[3] = {b.x, b.y, b.z};
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            to->m[i][j] += x[i] * y[j];
}

/* int r_j r dS over the triangle's area = (sum over its corners of v_j v + s_j s) / 12, s the sum of its corners. */
surface_moments triangle_moments(const vec3 corner[3])
{
    vec3 s = vec3_add(corner[0], vec3_add(corner[1], corner[2])), centre = vec3_scale(s, 1.0 / 3);
    vec3 area = vec3_scale(vec3_cross(vec3_sub(corner[1], corner[0]), vec3_sub(corner[2], corner[0])), 0.5);
    surface_moments m = {.area = area, .turn = vec3_cross(centre, area)};
    add_outer(&m.area_first, area, centre);
    add_outer(&m.turn_first, vec3_scale(vec3_cross(s, area), 1.0 / 12), s);
    for (int k = 0; k < 3; k++)
        add_outer(&m.turn_first, vec3_scale(vec3_cross(corner[k], area), 1.0 / 12), corner[k]);
    return m;
}

static surface_moments moments_sum(const surface_moments *a, const surface_moments *b)
{
    surface_moments sum = {vec3_add(a->area, b->area), vec3_add(a->turn, b->turn), a->area_first, a->turn_first};
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) {
            sum.area_first.m[i][j] += b->area_first.m[i][j];
            sum.turn_first.m[i][j] += b->turn_first.m[i][j];
        }
    }
    return sum;
}

/* A node's children follow it, so backward every node finds them done. */
static void find_moments(const mesh *m, const mesh_bvh *tree, mesh_integrals *out)
{
    for (int32_t n = tree->node.count - 1; n >= 0; n--) {
        const mesh_bvh_node *node = &tree->node.data[n];
        if (node->next >= 0) {
            out->moments.data[n] = moments_sum(&out->moments.data[n + 1], &out->moments.data[node->next]);
            continue;
        }
        surface_moments sum = {0};
        for (int32_t i = node->first; i < node->first + node->count; i++) {
            vec3 corner[3];
            mesh_face_points(m, tree->face.data[i], corner);
            surface_moments one = triangle_moments(corner);
            sum = moments_sum(&sum, &one);
        }
        out->moments.data[n] = sum;
    }
}

/* ---- points ---- */

typedef struct point_maker {
    context *ctx;
    const mesh *mesh;
    const mesh_bvh *tree;
    mesh_integrals *out;
    double spacing, part;
    double *area_before; /* per place, and one more: area of the faces before it */
} point_maker;

static bool add_point(point_maker *p, vec3 place, vec3 normal, double area)
{
    context *ctx = p->ctx;
    mesh_integrals *o = p->out;
    return array_push(ctx, &o->x, place.x) && array_push(ctx, &o->y, place.y) && array_push(ctx, &o->z, place.z) &&
           array_push(ctx, &o->nx, normal.x) && array_push(ctx, &o->ny, normal.y) &&
           array_push(ctx, &o->nz, normal.z) && array_push(ctx, &o->area, area);
}

/* The points of a triangle, or of a part of it, halved across its longest edge until that is short enough: slivers are
   cut along their length only.  What is beyond `most` points is left out; returns how many there would be, at least. */
static int32_t add_part_points(point_maker *p, const vec3 v[3], vec3 normal, int32_t most, bool *ok)
{
    int longest = 0;
    double square = 0;
    for (int k = 0; k < 3; k++) {
        vec3 edge = vec3_sub(v[(k + 1) % 3], v[k]);
        if (vec3_dot(edge, edge) > square) {
            square = vec3_dot(edge, edge);
            longest = k;
        }
    }
    if (square <= p->part * p->part || most < 1) {
        vec3 middle = vec3_scale(vec3_add(v[0], vec3_add(v[1], v[2])), 1.0 / 3);
        double area = 0.5 * vec3_length(vec3_cross(vec3_sub(v[1], v[0]), vec3_sub(v[2], v[0])));
        *ok = *ok && (most < 1 || add_point(p, middle, normal, area));
        return 1;
    }
    vec3 a = v[longest], b = v[(longest + 1) % 3], c = v[(longest + 2) % 3];
    vec3 middle = vec3_scale(vec3_add(a, b), 0.5);
    const vec3 left[3] = {a, middle, c}, right[3] = {middle, b, c};
    int32_t count = add_part_points(p, left, normal, most, ok);
    return count + add_part_points(p, right, normal, most - count, ok);
}

static void drop_points(mesh_integrals *o, int32_t count)
{
    o->x.count = o->y.count = o->z.count = o->nx.count = o->ny.count = o->nz.count = o->area.count = count;
}

static bool add_face_points(point_maker *p, int32_t place)
{
    vec3 v[3];
    bool ok = true;
    mesh_face_points(p->mesh, p->tree->face.data[place], v);
    vec3 normal = vec3_unit(vec3_cross(vec3_sub(v[1], v[0]), vec3_sub(v[2], v[0])));
    int32_t before = p->out->x.count;
    if (add_part_points(p, v, normal, MESH_MOST_PARTS, &ok) <= MESH_MOST_PARTS)
        return ok;
    drop_points(p->out, before);
    return ok && array_push(p->ctx, &p->out->large, place);
}

/* One point for a small and nearly flat node.  Its place is the centre of its area, its area that of the faces. */
static bool join_node(point_maker *p, int32_t n, bool *joined)
{
    const mesh_bvh_node *node = &p->tree->node.data[n];
    const surface_moments *m = &p->out->moments.data[n];
    double area = p->area_before[node->first + node->count] - p->area_before[node->first];
    *joined =
        vec3_length(vec3_sub(node->box.hi, node->box.lo)) <= p->spacing && vec3_length(m->area) > MESH_FLATNESS * area;
    if (!*joined)
        return true;
    vec3 normal = vec3_unit(m->area), centre = {0, 0, 0};
    for (int32_t i = node->first; i < node->first + node->count; i++) {
        vec3 v[3];
        mesh_face_points(p->mesh, p->tree->face.data[i], v);
        centre = vec3_mad(centre, vec3_add(v[0], vec3_add(v[1], v[2])),
                          (p->area_before[i + 1] - p->area_before[i]) / (3 * area));
    }
    return add_point(p, centre, normal, area);
}

/* The places first..end-1 have had their points. */
static void close_places(point_maker *p, int32_t first, int32_t end)
{
    for (int32_t i = first; i < end; i++) {
        p->out->point_first.data[i + 1] = p->out->x.count;
        p->out->large_first.data[i + 1] = p->out->large.count;
    }
}

/* Nodes are depth first: what a node does not settle itself, the following ones do. */
static bool find_points(point_maker *p)
{
    p->out->point_first.data[0] = p->out->large_first.data[0] = 0;
    int32_t settled = 0; /* places that have had their points */
    for (int32_t n = 0; n < p->tree->node.count; n++) {
        const mesh_bvh_node *node = &p->tree->node.data[n];
        int32_t end = node->first + node->count;
        if (node->first < settled)
            continue;
        bool joined;
        if (!join_node(p, n, &joined))
            return false;
        if (joined) {
            close_places(p, node->first, end);
            settled = end;
        } else if (node->next < 0) {
            for (int32_t i = node->first; i < end; i++) {
                if (!add_face_points(p, i))
                    return false;
                close_places(p, i, i + 1);
            }
            settled = end;
        }
    }
    return true;
}

static double radius_of(const mesh *m)
{
    double square = 0;
    for (int32_t i = 0; i < m->vertex.count; i++)
        square = fmax(square, vec3_dot(m->vertex.data[i], m->vertex.data[i]));
    return sqrt(square);
}

bool mesh_integrals_build(context *ctx, const mesh *m, const mesh_bvh *tree, mesh_integrals *out)
{
    *out = (mesh_integrals){0};
    double radius = radius_of(m);
    int32_t faces = tree->face.count;
    double *area_before = memory_array(ctx, (size_t)faces + 1, sizeof *area_before);
    bool ok = area_before && array_resize(ctx, &out->moments, tree->node.count) &&
              array_resize(ctx, &out->point_first, faces + 1) && array_resize(ctx, &out->large_first, faces + 1);
    if (ok) {
        for (int32_t i = 0; i < faces; i++)
            area_before[i + 1] = area_before[i] + vec3_length(mesh_area_vector(m, tree->face.data[i]));
        find_moments(m, tree, out);
        ok = find_points(&(point_maker){ctx, m, tree, out, MESH_SPACING * radius, MESH_PART * radius, area_before});
    }
    memory_free(ctx, area_before);
    if (!ok)
        mesh_integrals_free(ctx, out);
    return ok;
}

void mesh_integrals_free(context *ctx, mesh_integrals *i)
{
    array_free(ctx, &i->moments);
    array_free(ctx, &i->x);
    array_free(ctx, &i->y);
    array_free(ctx, &i->z);
    array_free(ctx, &i->nx);
    array_free(ctx, &i->ny);
    array_free(ctx, &i->nz);
    array_free(ctx, &i->area);
    array_free(ctx, &i->point_first);
    array_free(ctx, &i->large);
    array_free(ctx, &i->large_first);
}
