/* Clipping of an incident face by a reference face, and the choice of at most four points (Gregorius 2013, The
   separating axis test between convex polyhedra; Ericson 2004, Real-time collision detection, section 5.1). */
#include "dynamics/manifold.h"

/* The part of the polygon with dot(side, x) <= offset; new edges along the plane are called `name`. */
static int clip(const clip_vertex *in, int n, vec3 side, double offset, uint32_t name, clip_vertex *out)
{
    int count = 0;
    for (int i = 0; i < n && count < CLIP_MOST - 1; i++) {
        const clip_vertex *here = &in[i], *next = &in[i + 1 < n ? i + 1 : 0];
        double d0 = vec3_dot(side, here->point) - offset, d1 = vec3_dot(side, next->point) - offset;
        bool inside = d0 <= 0;
        if (inside)
            out[count++] = *here;
        if (inside != (d1 <= 0)) {
            vec3 cut = vec3_mad(here->point, vec3_sub(next->point, here->point), d0 / (d0 - d1));
            out[count++] = (clip_vertex){cut, inside ? name : here->edge};
        }
    }
    return count;
}

/* Keeps four of n points: the deepest, the one farthest from it, and on either side of the line through both the one
   that spans the largest triangle, so that the patch keeps its extent in both directions and with it the moments it can
   carry. */
static int choose_four(const manifold_point *p, int n, vec3 normal, manifold_point out[4])
{
    int chosen[4] = {0, 0, -1, -1};
    for (int i = 1; i < n; i++)
        if (p[i].depth > p[chosen[0]].depth)
            chosen[0] = i;
    double farthest = -1, left = 0, right = 0;
    for (int i = 0; i < n; i++) {
        vec3 d = vec3_sub(p[i].point, p[chosen[0]].point);
        if (vec3_dot(d, d) > farthest) {
            farthest = vec3_dot(d, d);
            chosen[1] = i;
        }
    }
    vec3 line = vec3_cross(normal, vec3_sub(p[chosen[1]].point, p[chosen[0]].point));
    for (int i = 0; i < n; i++) {
        double area = vec3_dot(line, vec3_sub(p[i].point, p[chosen[0]].point));
        if (area > left) {
            left = area;
            chosen[2] = i;
        } else if (area < right) {
            right = area;
            chosen[3] = i;
        }
    }
    int count = 0;
    for (int k = 0; k < 4; k++)
        if (chosen[k] >= 0)
            out[count++] = p[chosen[k]];
    return count;
}

int manifold_reduce(const manifold_point *points, int n, vec3 normal, manifold_point out[4])
{
    if (n > 4)
        return choose_four(points, n, normal, out);
    for (int i = 0; i < n; i++)
        out[i] = points[i];
    return n;
}

int face_manifold(const flat_face *reference, const flat_face *incident, nearness near, bool swapped,
                  manifold_point out[4])
{
    clip_vertex buffer[2][CLIP_MOST];
    int n = incident->count, from = 0;
    for (int i = 0; i < n; i++)
        buffer[0][i] = (clip_vertex){incident->point[i], (uint32_t)i};
    for (int i = 0; i < reference->count && n > 0; i++, from ^= 1) {
        vec3 here = reference->point[i], next = reference->point[i + 1 < reference->count ? i + 1 : 0];
        vec3 side = vec3_cross(vec3_sub(next, here), reference->normal);
        n = clip(buffer[from], n, side, vec3_dot(side, here), (uint32_t)(CLIP_MOST / 2 + i), buffer[from ^ 1]);
    }
    manifold_point point[CLIP_MOST];
    int count = 0;
    double offset = vec3_dot(reference->normal, reference->point[0]), deepest = -HUGE_VAL;
    for (int i = 0; i < n; i++) {
        const clip_vertex *v = &buffer[from][i], *before = &buffer[from][i > 0 ? i - 1 : n - 1];
        double depth = offset - vec3_dot(reference->normal, v->point);
        deepest = depth > deepest ? depth : deepest;
        if (!(depth > -near.reach))
            continue;
        vec3 middle = vec3_mad(v->point, reference->normal, 0.5 * depth);
        uint32_t feature = manifold_feature(swapped, reference->name, incident->name, before->edge, v->edge);
        point[count++] = (manifold_point){middle, depth, feature};
    }
    return deepest > -near.slack ? manifold_reduce(point, count, reference->normal, out) : 0;
}
