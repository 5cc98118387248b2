/* Cutting one facet by one plane: the kernels of buoyancy, drag and crushing patches.  Knows no mesh. */
#include "geometry/mesh.h"

int triangle_clip_below(const vec3 in[3], double level, vec3 out[4])
{
    int count = 0;
    for (int i = 0; i < 3; i++) {
        vec3 a = in[i], b = in[i == 2 ? 0 : i + 1];
        double da = a.z - level, db = b.z - level;
        if (da <= 0)
            out[count++] = a;
        /* A vertex on the plane is its own crossing: it is there already. */
        if ((da < 0 && db > 0) || (da > 0 && db < 0)) {
            out[count] = da < 0 ? segment_crossing(a, da, b, db) : segment_crossing(b, db, a, da);
            out[count++].z = level;
        }
    }
    return count;
}

/* One step around a convex facet, from a to b, whose distances from the plane are da and db: what that adds to the part
   on the inner side.  It is entered and left once; rounding may pretend more, and out has room for n + 1 only. */
static inline int clip_edge(vec3 a, double da, vec3 b, double db, int n, int count, vec3 *out)
{
    if (((da < 0 && db > 0) || (da > 0 && db < 0)) && count <= n)
        out[count++] = da < 0 ? segment_crossing(a, da, b, db) : segment_crossing(b, db, a, da);
    if (db <= 0 && count <= n)
        out[count++] = b;
    return count;
}

int facet_clip(const vec3 *in, int n, vec3 normal, double d, vec3 *out)
{
    int count = 0;
    if (n == 0)
        return 0;
    vec3 a = in[n - 1];
    double da = vec3_dot(normal, a) - d;
    for (int i = 0; i < n; i++) {
        vec3 b = in[i];
        double db = vec3_dot(normal, b) - d;
        count = clip_edge(a, da, b, db, n, count, out);
        a = b;
        da = db;
    }
    return count;
}

int facet_clip_at(const vec3 *in, int n, const double *distance, vec3 *out)
{
    int count = 0;
    for (int i = 0, last = n - 1; i < n; last = i++)
        count = clip_edge(in[last], distance[last], in[i], distance[i], n, count, out);
    return count;
}
