/* Lids of the water plane; see hull_lids.h. */
#include "io/hull_lids.h"

#include "io/hull_top.h"

#include <math.h>

/* Of a hull whose keel is its z = 0 triangles there are the flat of its bottom. */
hull_lids hull_lids_of(const mesh *m)
{
    double tolerance = HULL_LEVEL_TOLERANCE * hull_longest_side(m);
    return (hull_lids){mesh_bounds(m).lo.z < -tolerance, tolerance};
}

static bool is_near_water(const mesh *m, int32_t face, double tolerance)
{
    vec3 p[3];
    mesh_face_points(m, face, p);
    return fmax(fabs(p[0].z), fmax(fabs(p[1].z), fabs(p[2].z))) <= tolerance;
}

bool hull_is_lid(const hull_lids *lids, const mesh *m, int32_t face)
{
    return lids->any && is_near_water(m, face, lids->tolerance);
}

/* ---- lids off z = 0 ---- */

/* Steeper than this are the sides under a lid, or the surface only bends there. */
#define STEEP_SLOPE (1.0 / 2)

enum { NO_LID = -1, NEW_LID = -2 };

static bool is_steeper(const mesh *m, int32_t face, double slope)
{
    vec3 area = mesh_area_vector(m, face);
    return vec3_length(vec3_make(area.x, area.y, 0)) > slope * fabs(area.z);
}

/* The corner of a face that is in none of the two. */
static vec3 corner_beside(const mesh *m, int32_t face, int32_t a, int32_t b)
{
    const int32_t *v = m->face.data[face].v;
    for (int k = 0; k < 3; k++)
        if (v[k] != a && v[k] != b)
            return m->vertex.data[v[k]];
    return m->vertex.data[v[0]];
}

/* How far a point is to the left of the line from a to b, seen from above. */
static double left_of(vec3 a, vec3 b, vec3 p)
{
    double x = b.x - a.x, y = b.y - a.y, length = sqrt(x * x + y * y);
    return length > 0 ? (x * (p.y - a.y) - y * (p.x - a.x)) / length : 0;
}

/* The surface goes on, not steeply, across the edge k of a face, away from it: what is within reach of the water is but
   a part of a ledge or of a deck with camber.  Under a lid an overhanging stern leads back. */
static bool goes_on_outward(const mesh *m, int32_t face, int k, int32_t neighbour)
{
    const int32_t *v = m->face.data[face].v, from = v[k], to = v[(k + 1) % 3];
    vec3 a = m->vertex.data[from], b = m->vertex.data[to], c = corner_beside(m, neighbour, from, to);
    double own = left_of(a, b, m->vertex.data[v[(k + 2) % 3]]), out = left_of(a, b, c);
    return own * out < 0 && fabs(c.z - 0.5 * (a.z + b.z)) <= STEEP_SLOPE * fabs(out);
}

/* The heights of the patch that a face is in, whose faces get its number; false where it is not level as a whole, or no
   lid but a part of more. */
static bool follow_patch(const mesh *m, const mesh_adjacency *adjacency, int32_t number, int32_array *todo,
                         int32_array *lid, double *lo, double *hi)
{
    while (todo->count > 0) {
        int32_t face = todo->data[--todo->count];
        if (is_steeper(m, face, HULL_LEVEL_SLOPE))
            return false;
        for (int k = 0; k < 3; k++) {
            int32_t neighbour = adjacency->neighbour.data[3 * face + k];
            double z = m->vertex.data[m->face.data[face].v[k]].z;
            *lo = fmin(*lo, z);
            *hi = fmax(*hi, z);
            if (lid->data[neighbour] == NEW_LID) {
                lid->data[neighbour] = number;
                todo->data[todo->count++] = neighbour;
            } else if (lid->data[neighbour] == NO_LID && goes_on_outward(m, face, k, neighbour)) {
                return false;
            }
        }
    }
    return true;
}

/* All patches are lids, and at one height: their ranges have some height in common. */
static bool are_lids(const mesh *m, const mesh_adjacency *adjacency, int32_array *todo, int32_array *lid)
{
    const double tolerance = HULL_LEVEL_TOLERANCE * hull_longest_side(m);
    double highest_lo = -HUGE_VAL, lowest_hi = HUGE_VAL;
    for (int32_t f = 0, number = 0; f < m->face.count; f++) {
        double lo = HUGE_VAL, hi = -HUGE_VAL;
        if (lid->data[f] != NEW_LID)
            continue;
        lid->data[f] = number;
        todo->count = 0;
        todo->data[todo->count++] = f;
        if (!follow_patch(m, adjacency, number++, todo, lid, &lo, &hi))
            return false;
        highest_lo = fmax(highest_lo, lo);
        lowest_hi = fmin(lowest_hi, hi);
    }
    return highest_lo <= lowest_hi + tolerance;
}

/* Faces within reach of the water that are not steep, which make up the patches; returns how many. */
static int32_t mark_faces(const mesh *m, double reach, int32_array *lid)
{
    int32_t count = 0;
    for (int32_t f = 0; f < m->face.count; f++) {
        bool flat = is_near_water(m, f, reach) && fabs(mesh_area_vector(m, f).z) > 0 && !is_steeper(m, f, STEEP_SLOPE);
        lid->data[f] = flat ? NEW_LID : NO_LID;
        count += flat;
    }
    return count;
}

static bool is_watertight(const mesh_adjacency *adjacency)
{
    for (int32_t h = 0; h < adjacency->neighbour.count; h++)
        if (adjacency->neighbour.data[h] < 0)
            return false;
    return true;
}

bool hull_find_lids_off(context *ctx, const mesh *m, int32_array *lid, int32_t *count)
{
    box3 box = mesh_bounds(m);
    const double reach = HULL_REACH * hull_longest_side(m);
    mesh_adjacency adjacency = {0};
    int32_array todo = {0};
    *count = 0;
    if (!(box.lo.z < -reach && box.hi.z <= reach))
        return true;
    bool done = array_resize(ctx, lid, m->face.count) && array_resize(ctx, &todo, m->face.count) &&
                mesh_adjacency_build(ctx, m, &adjacency) == FRAM_OK;
    if (done) {
        int32_t marked = mark_faces(m, reach, lid);
        *count = is_watertight(&adjacency) && are_lids(m, &adjacency, &todo, lid) ? marked : 0;
    }
    mesh_adjacency_free(ctx, &adjacency);
    array_free(ctx, &todo);
    return done;
}
