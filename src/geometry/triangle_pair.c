/* Crossing triangles, by exact predicates; see triangle_pair.h.

   Most pairs that are asked about are neighbours, and nearly in one plane.  For them the projection along an axis tells
   more cheaply than space does: what is apart in a projection is apart. */
#include "geometry/triangle_pair.h"

#include "geometry/predicate.h"
#include "geometry/predicate3.h"

/* The axis along which a triangle looks largest. */
static int dominant_axis(const vec3 t[3])
{
    vec3 n = vec3_cross(vec3_sub(t[1], t[0]), vec3_sub(t[2], t[0]));
    double x = fabs(n.x), y = fabs(n.y), z = fabs(n.z);
    if (x >= y && x >= z)
        return 0;
    return y >= z ? 1 : 2;
}

static void project(const vec3 t[3], int axis, vec2 out[3])
{
    for (int i = 0; i < 3; i++)
        out[i] = axis == 0 ? (vec2){t[i].y, t[i].z} : axis == 1 ? (vec2){t[i].z, t[i].x} : (vec2){t[i].x, t[i].y};
}

/* An edge of a (in projection) has the rest of a on one side and b on the other; b may touch the edge only in the
   vertices that it shares (twin[i]: the vertex of b that equals vertex i of a, or -1). */
static bool edge_separates(const vec2 a[3], const vec2 b[3], const int twin[3])
{
    for (int i = 0; i < 3; i++) {
        int j = (i + 1) % 3, side = orientation(a[i], a[j], a[(i + 2) % 3]);
        bool apart = side != 0;
        for (int k = 0; k < 3 && apart; k++)
            apart = k == twin[i] || k == twin[j] || orientation(a[i], a[j], b[k]) * side < 0;
        if (apart)
            return true;
    }
    return false;
}

static bool apart_in_projection(const vec3 a[3], const vec3 b[3], const int twin_of_a[3], const int twin_of_b[3],
                                int axis)
{
    vec2 p[3], q[3];
    project(a, axis, p);
    project(b, axis, q);
    return edge_separates(p, q, twin_of_a) || edge_separates(q, p, twin_of_b);
}

static bool segment_meets_flat(vec2 s, vec2 t, const vec2 tri[3])
{
    int turn[3];
    for (int i = 0; i < 3; i++) {
        if (segments_touch(s, t, tri[i], tri[(i + 1) % 3]))
            return true;
        turn[i] = orientation(tri[i], tri[(i + 1) % 3], s);
    }
    return turn[0] == turn[1] && turn[1] == turn[2];
}

/* The closed segment between vertices i and j of a meets the closed triangle b; side: of a's vertices against b's
   plane. */
static bool segment_meets(const vec3 a[3], int i, int j, const int side[3], const vec3 b[3])
{
    if (side[i] * side[j] > 0)
        return false;
    if (side[i] == 0 && side[j] == 0) {
        vec2 p[3], q[3];
        int axis = dominant_axis(b);
        project(a, axis, p);
        project(b, axis, q);
        return segment_meets_flat(p[i], p[j], q);
    }
    bool left = false, right = false;
    for (int k = 0; k < 3; k++) {
        int turn = orientation3(a[i], a[j], b[k], b[(k + 1) % 3]);
        left = left || turn > 0;
        right = right || turn < 0;
    }
    return !(left && right);
}

/* Two neighbours over an edge: they meet elsewhere only when one is folded flat on the other. */
static bool folded(const vec3 a[3], const vec3 b[3], const int twin_of_a[3], const int twin_of_b[3])
{
    int i = 0, k = 0;
    while (i < 2 && twin_of_a[i] >= 0)
        i++;
    while (k < 2 && twin_of_b[k] >= 0)
        k++;
    if (orientation3(a[0], a[1], a[2], b[k]) != 0)
        return false;
    vec2 p[3], q[3];
    int axis = dominant_axis(a);
    project(a, axis, p);
    project(b, axis, q);
    vec2 from = p[(i + 1) % 3], to = p[(i + 2) % 3];
    return orientation(from, to, p[i]) * orientation(from, to, q[k]) > 0;
}

/* side[i] of t's vertices against the plane of p; false when all are off it on one side. */
static bool straddles(const vec3 t[3], const vec3 p[3], int side[3])
{
    for (int i = 0; i < 3; i++)
        side[i] = orientation3(p[0], p[1], p[2], t[i]);
    return !(side[0] == side[1] && side[1] == side[2] && side[0] != 0);
}

bool triangles_cross(const vec3 a[3], const vec3 b[3])
{
    int twin_of_a[3] = {-1, -1, -1}, twin_of_b[3] = {-1, -1, -1}, shared = 0;
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++)
            if (vec3_equal(a[i], b[k])) {
                twin_of_a[i] = k;
                twin_of_b[k] = i;
                shared++;
            }
    if (shared == 3)
        return true;
    int axis = dominant_axis(a), other = dominant_axis(b);
    if (apart_in_projection(a, b, twin_of_a, twin_of_b, axis) ||
        (other != axis && apart_in_projection(a, b, twin_of_a, twin_of_b, other)))
        return false;
    if (shared == 2)
        return folded(a, b, twin_of_a, twin_of_b);
    int side_a[3], side_b[3];
    if (!straddles(b, a, side_b) || !straddles(a, b, side_a))
        return false;
    /* With a vertex in common, what else they share reaches the edge opposite to it in one of them. */
    for (int i = 0; i < 3; i++) {
        int j = (i + 1) % 3;
        if (twin_of_a[i] < 0 && twin_of_a[j] < 0 && segment_meets(a, i, j, side_a, b))
            return true;
        if (twin_of_b[i] < 0 && twin_of_b[j] < 0 && segment_meets(b, i, j, side_b, a))
            return true;
    }
    return false;
}
