/* How a prism stands in a plan view, and which lies over which. */
#include "io/plan_view.h"

#include <math.h>
#include <stdlib.h>

void plan_shape_stand(plan_shape *s, vec3 position, quat orientation, double thickness)
{
    vec3 axis = mat3_column(quat_matrix(orientation), 2);
    double down = axis.z < 0 ? thickness : -thickness;
    s->drop = vec2_make(down * axis.x, down * axis.y);
    s->height = position.z + 0.5 * thickness * fabs(axis.z);
}

static int compare_heights(const void *a, const void *b)
{
    const plan_shape *x = a, *y = b;
    if (x->height != y->height)
        return x->height < y->height ? -1 : 1;
    if (x->style != y->style)
        return x->style < y->style ? -1 : 1;
    return x->outline.vertex < y->outline.vertex ? -1 : x->outline.vertex > y->outline.vertex;
}

void plan_shapes_sort(plan_shape *shapes, int32_t count)
{
    if (count > 1)
        qsort(shapes, (size_t)count, sizeof *shapes, compare_heights);
}
