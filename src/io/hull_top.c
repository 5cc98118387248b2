/* Open tops of hulls; see hull_top.h. */
#include "io/hull_top.h"

#include <math.h>

double hull_longest_side(const mesh *m)
{
    box3 box = mesh_bounds(m);
    vec3 size = vec3_sub(box.hi, box.lo);
    return fmax(size.x, fmax(size.y, size.z));
}

/* ---- open tops ---- */

static int32_t ring_begin(const mesh_rims *rims, int32_t i) { return rims->start.data[i]; }
static int32_t ring_count(const mesh_rims *rims, int32_t i) { return rims->start.data[i + 1] - rims->start.data[i]; }

static bool is_within(const mesh *m, const int32_t *ring, int32_t count, double low, double high)
{
    for (int32_t k = 0; k < count; k++) {
        double z = m->vertex.data[ring[k]].z;
        if (z < low || z > high)
            return false;
    }
    return true;
}

static box3 ring_bounds(const mesh *m, const int32_t *ring, int32_t count)
{
    box3 box = box3_empty();
    for (int32_t k = 0; k < count; k++)
        box = box3_add(box, m->vertex.data[ring[k]]);
    return box;
}

/* A ring no wider than the tolerance is a crack. */
static bool is_crack(const mesh *m, const int32_t *ring, int32_t count, double tolerance)
{
    double length = 0;
    for (int32_t k = 0; k < count; k++)
        length += vec3_length(vec3_sub(m->vertex.data[ring[(k + 1) % count]], m->vertex.data[ring[k]]));
    return fabs(mesh_ring_area(m, ring, count).z) <= 0.5 * tolerance * length;
}

/* The edge from a to b is in a ring, which runs against the triangles' edges. */
static bool is_in_ring(const int32_t *ring, int32_t count, int32_t a, int32_t b)
{
    for (int32_t k = 0; k < count; k++)
        if (ring[k] == b && ring[(k + 1) % count] == a)
            return true;
    return false;
}

/* How far a corner is from the line through two others, seen from above. */
static double distance_in_plan(vec3 corner, vec3 a, vec3 b)
{
    vec3 along = vec3_make(b.x - a.x, b.y - a.y, 0), to = vec3_make(corner.x - a.x, corner.y - a.y, 0);
    double length = vec3_length(along);
    return length > 0 ? fabs(vec3_cross(along, to).z) / length : 0;
}

/* The triangle goes on level from its edge k, by more than the tolerance is wide. */
static bool goes_on_level(const mesh *m, const int32_t *v, int k, double tolerance)
{
    const vec3 *at = m->vertex.data, a = at[v[k]], b = at[v[(k + 1) % 3]], c = at[v[(k + 2) % 3]];
    double aside = distance_in_plan(c, a, b);
    return aside > 2 * tolerance && fabs(c.z - 0.5 * (a.z + b.z)) <= HULL_LEVEL_SLOPE * aside;
}

/* Triangles between two heights go on level from the ring: they are what is there of a deck, and the ring is a hole of
   it. */
static bool is_hole_of_deck(const mesh *m, const int32_t *ring, int32_t count, double low, double high,
                            double tolerance)
{
    const box3 about = ring_bounds(m, ring, count);
    for (int32_t f = 0; f < m->face.count; f++) {
        const int32_t *v = m->face.data[f].v;
        if (!is_within(m, v, 3, low, high) || !box3_meet(about, mesh_face_bounds(m, f)))
            continue;
        for (int k = 0; k < 3; k++)
            if (goes_on_level(m, v, k, tolerance) && is_in_ring(ring, count, v[k], v[(k + 1) % 3]))
                return true;
    }
    return false;
}

static bool is_top(const mesh *m, const int32_t *ring, int32_t count, double height, double tolerance)
{
    double low = hull_top_low(height, tolerance);
    return is_within(m, ring, count, low, HUGE_VAL) && !is_crack(m, ring, count, tolerance) &&
           !is_hole_of_deck(m, ring, count, low, HUGE_VAL, tolerance);
}

bool hull_find_top(context *ctx, const mesh *m, const mesh_rims *rims, double tolerance, hull_top *out)
{
    box3 box = mesh_bounds(m);
    double reach = HULL_REACH * hull_longest_side(m);
    bool done = array_push(ctx, &out->rims.start, 0);
    for (int32_t i = 0; done && i < mesh_rims_count(rims); i++) {
        const int32_t *ring = rims->vertex.data + ring_begin(rims, i);
        const int32_t count = ring_count(rims, i);
        if (!is_top(m, ring, count, box.hi.z, tolerance))
            continue;
        out->area += mesh_ring_area(m, ring, count).z;
        for (int32_t k = 0; done && k < count; k++)
            done = array_push(ctx, &out->rims.vertex, ring[k]);
        done = done && array_push(ctx, &out->rims.start, out->rims.vertex.count);
    }
    out->z = box.hi.z;
    out->above = box.lo.z < -reach && out->z > reach;
    return done;
}

void hull_level_top(mesh *m, hull_top *top, double tolerance)
{
    double low = HUGE_VAL, high = -HUGE_VAL;
    for (int32_t k = 0; k < top->rims.vertex.count; k++) {
        low = fmin(low, m->vertex.data[top->rims.vertex.data[k]].z);
        high = fmax(high, m->vertex.data[top->rims.vertex.data[k]].z);
    }
    if (!(high - low > HULL_LEVEL_TOLERANCE * hull_longest_side(m)))
        return;
    top->z = fmax(fabs(low), fabs(high)) <= tolerance ? 0 : 0.5 * (low + high);
    for (int32_t k = 0; k < top->rims.vertex.count; k++)
        m->vertex.data[top->rims.vertex.data[k]].z = top->z;
}

void hull_turn_top(hull_top *top)
{
    for (int32_t i = 0; i < mesh_rims_count(&top->rims); i++) {
        int32_t *ring = top->rims.vertex.data + ring_begin(&top->rims, i);
        for (int32_t a = 0, b = ring_count(&top->rims, i) - 1; a < b; a++, b--) {
            int32_t swap = ring[a];
            ring[a] = ring[b];
            ring[b] = swap;
        }
    }
}

/* Of a top that was led up, whose corners follow those of the surface in the order of the rims: the deck goes down to
   the rims again, and the sides between them are left out. */
static void lower_deck(mesh *m, const mesh_rims *rims, int32_t vertices, int32_t faces)
{
    int32_t kept = faces;
    for (int32_t f = faces; f < m->face.count; f++) {
        int32_t *v = m->face.data[f].v;
        if (v[0] < vertices || v[1] < vertices || v[2] < vertices)
            continue;
        for (int k = 0; k < 3; k++)
            m->face.data[kept].v[k] = rims->vertex.data[v[k] - vertices];
        kept++;
    }
    m->face.count = kept;
    m->vertex.count = vertices;
}

fram_status hull_close_top(context *ctx, mesh *m, const hull_top *top, double height, fram_error *error)
{
    const int32_t vertices = m->vertex.count, faces = m->face.count;
    fram_status status = mesh_raise_top(ctx, m, &top->rims, height > 0 ? height : 1, error);
    if (status == FRAM_OK && !(height > 0))
        lower_deck(m, &top->rims, vertices, faces);
    return status;
}

void hull_top_free(context *ctx, hull_top *top) { mesh_rims_free(ctx, &top->rims); }

/* ---- where hulls end ---- */

/* Part of its area that a ring which is where a hull ends above shows from there: one in a side shows hardly any. */
#define LEAST_SEEN 0.9

static bool is_end(double lo, double hi, double ring_lo, double ring_hi, double most)
{
    return fmax(fabs(ring_lo), fabs(ring_hi)) <= most && (lo >= -most || hi <= most);
}

/* A rim that is higher than the reach all round is that of a low deck. */
static bool ends_at_water(const mesh *m, const int32_t *ring, int32_t count, box3 rim, double most)
{
    box3 box = mesh_bounds(m);
    const double reach = HULL_REACH * hull_longest_side(m);
    vec3 area = mesh_ring_area(m, ring, count);
    if (box.lo.z >= -most || fmax(fabs(rim.lo.z), fabs(rim.hi.z)) > most || rim.lo.z > reach ||
        fabs(area.z) < LEAST_SEEN * vec3_length(area))
        return false;
    return box.hi.z <= reach || !is_hole_of_deck(m, ring, count, -most, most, reach);
}

hull_ending hull_ends_in(const mesh *m, const int32_t *ring, int32_t count, double most)
{
    box3 box = mesh_bounds(m), rim = ring_bounds(m, ring, count);
    if (is_end(box.lo.x, box.hi.x, rim.lo.x, rim.hi.x, most))
        return HULL_ENDS_AT_X;
    if (is_end(box.lo.y, box.hi.y, rim.lo.y, rim.hi.y, most))
        return HULL_ENDS_AT_Y;
    return ends_at_water(m, ring, count, rim, most) ? HULL_ENDS_AT_WATER : HULL_ENDS_NOWHERE;
}
