/* Is a surface a sound solid, and if not, where not?  Knows nothing of files or repair. */
#include "geometry/mesh_bvh.h"
#include "geometry/mesh_edges.h"
#include "geometry/mesh_parts.h"
#include "geometry/triangle_pair.h"

#include <stdarg.h>
#include <stdio.h>

/* A triangle whose height over its longest side is under this part of that side has no area.  Slivers that seal the
   cracks of panel meshes are a hundred times thicker; coordinates read from 4-byte floats are a hundred times
   coarser. */
#define LEAST_HEIGHT 1e-9
/* A closed part whose volume is under this part of the cube of its longest side encloses nothing. */
#define LEAST_VOLUME 1e-12

static void report_text(mesh_report *r, const char *format, ...) __attribute__((format(printf, 2, 3)));
static void report_text(mesh_report *r, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(r->text, sizeof r->text, format, arguments);
    va_end(arguments);
}

/* "edge between vertices 3 (x, y, z) and 7 (x, y, z) <what>" for half-edge h. */
static void report_edge(mesh_report *r, const mesh *m, int32_t h, const char *what)
{
    r->face = h / 3;
    r->edge[0] = half_edge_from(m, h);
    r->edge[1] = half_edge_to(m, h);
    vec3 a = m->vertex.data[r->edge[0]], b = m->vertex.data[r->edge[1]];
    report_text(r, "edge between vertices %d (%g, %g, %g) and %d (%g, %g, %g) %s", r->edge[0], a.x, a.y, a.z,
                r->edge[1], b.x, b.y, b.z, what);
}

static void report_face(mesh_report *r, const mesh *m, int32_t face, const char *what)
{
    vec3 a = m->vertex.data[m->face.data[face].v[0]];
    r->face = face;
    report_text(r, "triangle %d at (%g, %g, %g) %s", face, a.x, a.y, a.z, what);
}

bool mesh_has_area(const mesh *m, int32_t face)
{
    double longest = 0;
    const int32_t *v = m->face.data[face].v;
    for (int k = 0; k < 3; k++) {
        vec3 side = vec3_sub(m->vertex.data[v[(k + 1) % 3]], m->vertex.data[v[k]]);
        longest = fmax(longest, vec3_dot(side, side));
    }
    return 2 * vec3_length(mesh_area_vector(m, face)) > LEAST_HEIGHT * longest;
}

/* Indices, numbers, areas: what the later questions take for granted. */
static void check_triangles(const mesh *m, mesh_report *r)
{
    if (m->face.count == 0) {
        r->defect = MESH_EMPTY;
        report_text(r, "surface has no triangles");
        return;
    }
    for (int32_t f = 0; f < m->face.count; f++)
        for (int k = 0; k < 3; k++) {
            int32_t v = m->face.data[f].v[k];
            if (v < 0 || v >= m->vertex.count) {
                r->defect = MESH_BAD_INDEX;
                r->face = f;
                report_text(r, "triangle %d names vertex %d, but there are %d", f, v, m->vertex.count);
                return;
            }
        }
    for (int32_t f = 0; f < m->face.count; f++)
        for (int k = 0; k < 3; k++) {
            vec3 p = m->vertex.data[m->face.data[f].v[k]];
            if (!isfinite(p.x) || !isfinite(p.y) || !isfinite(p.z)) {
                r->defect = MESH_NOT_FINITE;
                r->face = f;
                report_text(r, "vertex %d of triangle %d is (%g, %g, %g)", m->face.data[f].v[k], f, p.x, p.y, p.z);
                return;
            }
        }
    for (int32_t f = 0; f < m->face.count; f++)
        if (!mesh_has_area(m, f)) {
            r->defect = MESH_DEGENERATE;
            report_face(r, m, f, "has no area");
            return;
        }
}

/* How many triangles each edge has, and whether they run along it in opposite directions. */
static void check_edges(const mesh *m, const int32_array *sorted, mesh_report *r)
{
    /* The half-edge with which the first offence of each kind begins, in the order of faces. */
    int32_t none = sorted->count, open = none, manifold = none, turned = none, twin = -1;
    for (int32_t i = 0, end; i < sorted->count; i = end) {
        end = mesh_edges_end(m, sorted, i);
        int32_t h = sorted->data[i];
        if (end - i == 1) {
            r->open_edges++;
            open = h < open ? h : open;
        } else if (end - i > 2) {
            manifold = h < manifold ? h : manifold;
        } else if (half_edge_from(m, h) == half_edge_from(m, sorted->data[i + 1]) && h < turned) {
            turned = h;
            twin = sorted->data[i + 1] / 3;
        }
    }
    char what[120];
    if (open < none) {
        r->defect = MESH_OPEN;
        snprintf(what, sizeof what, "has one triangle (%d)", open / 3);
        report_edge(r, m, open, what);
    } else if (manifold < none) {
        r->defect = MESH_NOT_MANIFOLD;
        snprintf(what, sizeof what, "has more than two triangles (%d is the first)", manifold / 3);
        report_edge(r, m, manifold, what);
    } else if (turned < none) {
        r->defect = MESH_INCONSISTENT;
        snprintf(what, sizeof what, "is run along in one direction by triangles %d and %d", turned / 3, twin);
        report_edge(r, m, turned, what);
        r->other_face = twin;
    }
}

static void check_turn(const mesh *m, const mesh_parts *parts, bool nested, mesh_report *r)
{
    int32_t i = mesh_parts_first_inverted(m, parts, nested);
    if (i < 0)
        return;
    char what[120];
    vec3 size = vec3_sub(parts->part.data[i].box.hi, parts->part.data[i].box.lo);
    double longest = fmax(size.x, fmax(size.y, size.z));
    if (fabs(parts->part.data[i].volume) <= LEAST_VOLUME * longest * longest * longest) {
        r->defect = MESH_DEGENERATE;
        report_face(r, m, parts->part.data[i].first_face,
                    "belongs to a closed part that encloses no volume: a plate without thickness");
        return;
    }
    snprintf(what, sizeof what, "belongs to a closed part of volume %g m3 %s: it is turned the wrong way",
             parts->part.data[i].volume, nested ? "inside another part" : "in the open");
    r->defect = MESH_INSIDE_OUT;
    report_face(r, m, parts->part.data[i].first_face, what);
}

static fram_status check_crossings(context *ctx, const mesh *m, mesh_report *r)
{
    mesh_bvh tree = {0};
    int32_array near = {0};
    fram_status status = mesh_bvh_build(ctx, m, &tree);
    for (int32_t f = 0; f < m->face.count && status == FRAM_OK && r->defect == MESH_CLOSED; f++) {
        if (!mesh_bvh_query(ctx, &tree, mesh_face_bounds(m, f), &near))
            status = FRAM_ERROR_MEMORY;
        vec3 a[3], b[3];
        mesh_face_points(m, f, a);
        for (int32_t i = 0; status == FRAM_OK && i < near.count; i++) {
            int32_t g = near.data[i];
            if (g <= f)
                continue;
            mesh_face_points(m, g, b);
            if (triangles_cross(a, b)) {
                r->defect = MESH_SELF_INTERSECTING;
                r->other_face = g;
                char what[120];
                snprintf(what, sizeof what, "crosses or touches triangle %d at (%g, %g, %g)", g, b[0].x, b[0].y,
                         b[0].z);
                report_face(r, m, f, what);
                break;
            }
        }
    }
    array_free(ctx, &near);
    mesh_bvh_free(ctx, &tree);
    return status;
}

/* Everything that is asked of a closed surface. */
static fram_status check_solid(context *ctx, const mesh *m, const int32_array *sorted, bool self_intersection,
                               mesh_report *r)
{
    mesh_adjacency adjacency = {0};
    mesh_parts parts = {0};
    fram_status status = mesh_adjacency_from_edges(ctx, m, sorted, &adjacency);
    if (status == FRAM_OK)
        status = mesh_parts_build(ctx, m, &adjacency, &parts);
    if (status == FRAM_OK)
        check_turn(m, &parts, false, r);
    if (status == FRAM_OK && r->defect == MESH_CLOSED && self_intersection) {
        status = check_crossings(ctx, m, r);
        if (status == FRAM_OK && r->defect == MESH_CLOSED)
            check_turn(m, &parts, true, r);
    }
    mesh_parts_free(ctx, &parts);
    mesh_adjacency_free(ctx, &adjacency);
    return status;
}

fram_status mesh_check(context *ctx, const mesh *m, bool self_intersection, mesh_report *report)
{
    *report = (mesh_report){.defect = MESH_CLOSED, .face = -1, .other_face = -1, .edge = {-1, -1}};
    check_triangles(m, report);
    if (report->defect != MESH_CLOSED)
        return FRAM_OK;
    int32_array sorted = {0};
    fram_status status = mesh_edges_sort(ctx, m, &sorted) ? FRAM_OK : FRAM_ERROR_MEMORY;
    if (status == FRAM_OK)
        check_edges(m, &sorted, report);
    if (status == FRAM_OK && report->defect == MESH_CLOSED)
        status = check_solid(ctx, m, &sorted, self_intersection, report);
    array_free(ctx, &sorted);
    return status;
}
