/* Cutting a solid into nearly convex pieces.  Knows nothing of ships, though they are what it is made for.

   The piece that is most concave is cut by a plane, until none is too concave.  Planes are tried: across the three axes
   through the deepest place, and along the sides of a notch there.  The one that leaves the least
   concave parts is taken; if parts are equal in that, the one whose hulls enclose the least.  Parts that hang together
   no more are pieces of their own. */
#include "geometry/convex_piece.h"
#include "geometry/mesh_clip.h"
#include "geometry/mesh_parts.h"
#include "geometry/mesh_rings.h"
#include "geometry/mesh_simplify.h"
#include "geometry/polyhedron_build.h"

#include <assert.h>

/* What is smaller than this part of the tolerance is nothing: hulls may be that much too small.  It halves the faces of
   smooth hulls against a part of 1/1000, and moves no surface that the tolerance would not move more. */
#define SMALL_TO_TOLERANCE 0.02
/* And than this part of the solid's size. */
#define SMALL_TO_SIZE 1e-9
/* Vertices that a cut takes to be on its plane, against what is small. */
#define SNAP_TO_SMALL 0.05
/* Sides that turn by more than about 25 degrees make a notch.  Planes along smoother surfaces shave off films. */
#define NOTCH_COSINE 0.9
/* Cosine between normals of planes that are as good as parallel. */
#define SAME_DIRECTION 0.999
/* Excesses that differ by less than this part are equal but for rounding. */
#define SAME_EXCESS 1e-6

/* Of a surface of more triangles than this a coarser one is cut, which is this part of the tolerance off at most: time
   grows with triangles, faces of hulls, and pieces. */
enum { FINE_MESH = 20000 };
#define COARSER_TO_TOLERANCE 0.1

enum { MOST_PLANES = 7 };

typedef struct carving {
    context *ctx;
    fram_error *error;
    double tolerance, small;
    int32_t most;
    convex_piece_array piece;
    hull_list hulls;
} carving;

/* Surface and cuts of a new piece: part `label` of a surface. */
static bool start_piece(carving *c, const mesh *surface, const mesh_parts *parts, int32_t label,
                        const convex_piece *parent, const plane3 *cut, convex_piece *out)
{
    if (!mesh_copy_part(c->ctx, surface, parts, label, &out->surface))
        return false;
    for (int32_t i = 0; parent && i < parent->cuts.count; i++)
        if (!array_push(c->ctx, &out->cuts, parent->cuts.data[i]))
            return false;
    return !cut || array_push(c->ctx, &out->cuts, *cut);
}

/* Append part `label` of a surface as a piece of its own unless it is too flat to have volume or hull. */
static fram_status add_part(carving *c, const mesh *surface, const mesh_parts *parts, int32_t label,
                            const convex_piece *parent, const plane3 *cut, convex_piece_array *out)
{
    if (!array_push(c->ctx, out, (convex_piece){0}))
        return error_memory(c->error);
    convex_piece *p = &out->data[out->count - 1];
    if (!start_piece(c, surface, parts, label, parent, cut, p))
        return error_memory(c->error);
    fram_status status = FRAM_ERROR_INPUT;
    if (parts->part.data[label].volume > 0)
        status = convex_piece_complete(c->ctx, p, c->small, c->error);
    if (status != FRAM_ERROR_INPUT)
        return status;
    convex_piece_free(c->ctx, p);
    out->count--;
    return FRAM_OK;
}

static fram_status add_parts(carving *c, const mesh *surface, const convex_piece *parent, const plane3 *cut,
                             convex_piece_array *out)
{
    mesh_adjacency adjacency = {0};
    mesh_parts parts = {0};
    fram_status status = mesh_adjacency_build(c->ctx, surface, &adjacency);
    if (status == FRAM_OK)
        status = mesh_parts_build(c->ctx, surface, &adjacency, &parts);
    if (status != FRAM_OK)
        error_memory(c->error);
    for (int32_t i = 0; i < parts.part.count && status == FRAM_OK; i++)
        status = add_part(c, surface, &parts, i, parent, cut, out);
    mesh_parts_free(c->ctx, &parts);
    mesh_adjacency_free(c->ctx, &adjacency);
    return status;
}

/* The parts cover the whole piece: films that the cut lost lie on what is left. */
static bool parts_cover(const carving *c, const convex_piece *p, const convex_piece_array *parts)
{
    for (int32_t i = 0; i < p->surface.vertex.count; i++) {
        bool found = false;
        for (int32_t k = 0; k < parts->count && !found; k++)
            found = polyhedron_contains(&parts->data[k].hull, p->surface.vertex.data[i], 3 * c->small);
        if (!found)
            return false;
    }
    return true;
}

/* Concavities of parts that stand in for piece number `parent`. */
static fram_status measure_parts(carving *c, int32_t parent, convex_piece_array *parts)
{
    array_clear(&c->hulls);
    bool done = true;
    for (int32_t i = 0; i < c->piece.count && done; i++)
        done = i == parent || array_push(c->ctx, &c->hulls, &c->piece.data[i].hull);
    for (int32_t i = 0; i < parts->count && done; i++)
        done = parts == &c->piece || array_push(c->ctx, &c->hulls, &parts->data[i].hull);
    for (int32_t i = 0; i < parts->count && done; i++)
        convex_piece_measure(&parts->data[i], &c->hulls, c->small);
    return done ? FRAM_OK : error_memory(c->error);
}

/* The parts of piece number `parent` on both sides of a plane; none when that does not cut it, cuts too many or loses
 * some. */
static fram_status cut_piece(carving *c, int32_t parent, plane3 cut, convex_piece_array *out)
{
    const convex_piece *p = &c->piece.data[parent];
    mesh half = {0};
    fram_status status = FRAM_OK;
    bool both = true;
    for (int side = 0; side < 2 && status == FRAM_OK && both; side++) {
        int32_t before = out->count;
        vec3 normal = side ? vec3_neg(cut.normal) : cut.normal;
        double offset = side ? -cut.offset : cut.offset;
        status =
            mesh_clip(c->ctx, &p->surface, &p->adjacency, normal, offset, SNAP_TO_SMALL * c->small, &half, c->error);
        if (status == FRAM_OK && half.face.count)
            status = add_parts(c, &half, p, &cut, out);
        both = out->count > before;
    }
    mesh_free(c->ctx, &half);
    if (status != FRAM_OK)
        return status;
    if (both && c->piece.count - 1 + out->count <= c->most && parts_cover(c, p, out))
        return measure_parts(c, parent, out);
    convex_piece_array_free(c->ctx, out);
    return FRAM_OK;
}

/* Add the plane of a face unless there is one like it. */
static int add_face_plane(const convex_piece *p, int32_t face, plane3 plane[MOST_PLANES], int count)
{
    vec3 normal = vec3_unit(mesh_area_vector(&p->surface, face));
    for (int i = 0; i < count; i++)
        if (fabs(vec3_dot(plane[i].normal, normal)) > SAME_DIRECTION)
            return count;
    plane[count] = (plane3){normal, vec3_dot(normal, p->surface.vertex.data[p->surface.face.data[face].v[0]])};
    return count + 1;
}

/* The edge between two faces is the bottom of a notch. */
static bool is_notch(const convex_piece *p, int32_t face, int32_t other)
{
    const mesh *m = &p->surface;
    vec3 normal = vec3_unit(mesh_area_vector(m, face)), beyond = vec3_unit(mesh_area_vector(m, other));
    vec3 on = m->vertex.data[m->face.data[face].v[0]];
    double highest = 0;
    for (int k = 0; k < 3; k++)
        highest = fmax(highest, vec3_dot(normal, vec3_sub(m->vertex.data[m->face.data[other].v[k]], on)));
    return highest > 0 && vec3_dot(normal, beyond) < NOTCH_COSINE;
}

static int axis_planes(vec3 through, plane3 plane[MOST_PLANES])
{
    static const vec3 axis[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    for (int i = 0; i < 3; i++)
        plane[i] = (plane3){axis[i], vec3_dot(axis[i], through)};
    return 3;
}

/* Across the axes through the deepest place, and along the sides of notches there. */
static int deepest_planes(const convex_piece *p, plane3 plane[MOST_PLANES])
{
    int count = axis_planes(p->deepest, plane);
    for (int k = 0; k < 3; k++) {
        int32_t other = p->adjacency.neighbour.data[3 * p->deepest_face + k];
        if (!is_notch(p, p->deepest_face, other))
            continue;
        count = add_face_plane(p, p->deepest_face, plane, count);
        count = add_face_plane(p, other, plane, count);
    }
    return count;
}

/* What a cut leaves to be desired: first the volumes that hulls of parts which are still too deep enclose in excess,
   then the volume of those parts.  Roots of excess are summed, so that one part to be cut again is better than two:
   neither it nor depth alone would keep a plate with a hole from being sliced along its middle plane, again and again.
 */
typedef struct fault {
    double excess, volume;
} fault;

static fault fault_of(const carving *c, const convex_piece_array *parts)
{
    fault f = {0, 0};
    for (int32_t i = 0; i < parts->count; i++) {
        const convex_piece *p = &parts->data[i];
        if (p->concavity <= c->tolerance)
            continue;
        f.excess += sqrt(fmax(0, polyhedron_volume(&p->hull) - p->volume));
        f.volume += p->volume;
    }
    return f;
}

static bool less_fault(fault a, fault b)
{
    double slack = SAME_EXCESS * b.excess;
    return a.excess < b.excess - slack || (a.excess <= b.excess + slack && a.volume < b.volume);
}

/* The parts that the best of some cuts of piece number `parent` leaves; none when no plane cuts it. */
static fram_status best_of(carving *c, int32_t parent, const plane3 *plane, int count, convex_piece_array *best)
{
    fault least = {0, 0};
    fram_status status = FRAM_OK;
    for (int i = 0; i < count && status == FRAM_OK; i++) {
        convex_piece_array parts = {0};
        status = cut_piece(c, parent, plane[i], &parts);
        fault f = fault_of(c, &parts);
        if (status == FRAM_OK && parts.count && (best->count == 0 || less_fault(f, least))) {
            convex_piece_array swap = *best;
            *best = parts;
            parts = swap;
            least = f;
        }
        convex_piece_array_free(c->ctx, &parts);
    }
    return status;
}

static fram_status best_cut(carving *c, int32_t parent, convex_piece_array *best)
{
    const convex_piece *p = &c->piece.data[parent];
    plane3 plane[MOST_PLANES];
    fram_status status = best_of(c, parent, plane, deepest_planes(p, plane), best);
    /* Planes so near the rim that they cut nothing off: halve the piece instead. */
    if (status == FRAM_OK && best->count == 0)
        status = best_of(c, parent, plane, axis_planes(p->hull.centre, plane), best);
    return status;
}

/* The deepest piece that may still be cut, or -1.  Depths are measured anew first: cuts elsewhere may have laid surface
 * bare. */
static fram_status piece_to_cut(carving *c, const uint8_t *whole, int32_t *found)
{
    fram_status status = measure_parts(c, -1, &c->piece);
    *found = -1;
    for (int32_t i = 0; i < c->piece.count; i++)
        if (!whole[i] && c->piece.data[i].concavity > c->tolerance &&
            (*found < 0 || c->piece.data[i].concavity > c->piece.data[*found].concavity))
            *found = i;
    return status;
}

/* Put the parts in the place of piece number `parent` and behind the last one; there is room. */
static void replace_piece(carving *c, int32_t parent, convex_piece_array *parts)
{
    convex_piece_free(c->ctx, &c->piece.data[parent]);
    for (int32_t i = 0; i < parts->count; i++)
        c->piece.data[i ? c->piece.count++ : parent] = parts->data[i];
    array_clear(parts);
}

static fram_status carve(carving *c)
{
    uint8_t *whole = memory_array(c->ctx, (size_t)c->most, 1); /* pieces that no plane cuts */
    if (!whole || !array_reserve(c->ctx, &c->piece, c->most)) {
        memory_free(c->ctx, whole);
        return error_memory(c->error);
    }
    int32_t i;
    fram_status status = piece_to_cut(c, whole, &i);
    while (status == FRAM_OK && i >= 0) {
        convex_piece_array parts = {0};
        status = best_cut(c, i, &parts);
        if (status == FRAM_OK && parts.count)
            replace_piece(c, i, &parts);
        else
            whole[i] = 1;
        convex_piece_array_free(c->ctx, &parts);
        if (status == FRAM_OK)
            status = piece_to_cut(c, whole, &i);
    }
    memory_free(c->ctx, whole);
    return status;
}

static fram_status begin(carving *c, const mesh *m)
{
    mesh_adjacency adjacency = {0};
    fram_status status = mesh_adjacency_build(c->ctx, m, &adjacency);
    if (status != FRAM_OK)
        error_memory(c->error);
    for (int32_t h = 0; status == FRAM_OK && h < adjacency.neighbour.count; h++)
        if (adjacency.neighbour.data[h] < 0)
            status = mesh_open_error(m, h, c->error);
    mesh_adjacency_free(c->ctx, &adjacency);
    if (status == FRAM_OK)
        status = add_parts(c, m, NULL, NULL, &c->piece);
    if (status == FRAM_OK && c->piece.count == 0)
        status = error_set(c->error, FRAM_ERROR_INPUT, NULL, 0, NULL, "the surface encloses no volume");
    return status;
}

static fram_status carve_mesh(context *ctx, const mesh *m, double tolerance, int32_t most, polyhedron_array *out,
                              double *concavity, fram_error *error)
{
    box3 box = mesh_bounds(m);
    carving c = {.ctx = ctx, .error = error};
    c.small = fmax(SMALL_TO_TOLERANCE * tolerance, SMALL_TO_SIZE * vec3_length(vec3_sub(box.hi, box.lo)));
    c.small = fmax(c.small, 8 * hull_rounding(m->vertex.data, m->vertex.count));
    c.tolerance = fmax(tolerance, 2 * c.small);
    fram_status status = begin(&c, m);
    /* Separate bodies are pieces whatever the limit. */
    c.most = most > c.piece.count ? most : c.piece.count;
    if (status == FRAM_OK)
        status = carve(&c);
    if (status == FRAM_OK && !array_reserve(ctx, out, c.piece.count))
        status = error_memory(error);
    for (int32_t i = 0; status == FRAM_OK && i < c.piece.count; i++) {
        *concavity = fmax(*concavity, c.piece.data[i].concavity);
        out->data[out->count++] = c.piece.data[i].hull;
        c.piece.data[i].hull = (polyhedron){0};
    }
    convex_piece_array_free(ctx, &c.piece);
    array_free(ctx, &c.hulls);
    return status;
}

/* Of a fine surface a coarser one is cut, and the distance between the two is added to what is found. */
static fram_status carve_fine(context *ctx, const mesh *m, double tolerance, int32_t most, polyhedron_array *out,
                              double *concavity, fram_error *error)
{
    mesh coarse = {0};
    double distance = 0;
    fram_status status = mesh_copy(ctx, &coarse, m) ? FRAM_OK : FRAM_ERROR_MEMORY;
    if (status == FRAM_OK)
        status = mesh_simplify(ctx, &coarse, COARSER_TO_TOLERANCE * tolerance, &distance);
    if (status != FRAM_OK)
        error_memory(error);
    else
        status = carve_mesh(ctx, &coarse, tolerance - distance, most, out, concavity, error);
    *concavity += distance;
    mesh_free(ctx, &coarse);
    return status;
}

fram_status mesh_convex_pieces(context *ctx, const mesh *m, double tolerance, int32_t most, polyhedron_array *out,
                               double *concavity, fram_error *error)
{
    assert(mesh_indices_are_valid(m));
    polyhedron_array_free(ctx, out);
    *concavity = 0;
    return (m->face.count > FINE_MESH ? carve_fine : carve_mesh)(ctx, m, tolerance, most, out, concavity, error);
}
