/* Files and the planes in which they are mirrored; see hull_mirror.h. */
#include "io/hull_mirror.h"

#include "io/hull_top.h"

#include <math.h>
#include <string.h>

/* Part of the longest side by which a whole hull may be off the plane that it lies about, or ends in. */
#define OFF_SYMMETRY 1e-3

bool hull_copy_file(context *ctx, const mesh_file *from, mesh_file *to)
{
    int32_t count = from->element.count;
    *to = *from;
    to->surface = (mesh){0};
    to->element = (int32_array){0};
    to->line = (int32_array){0};
    if (!mesh_copy(ctx, &to->surface, &from->surface) || !array_resize(ctx, &to->element, count) ||
        !array_resize(ctx, &to->line, count))
        return false;
    if (count) {
        memcpy(to->element.data, from->element.data, (size_t)count * sizeof *to->element.data);
        memcpy(to->line.data, from->line.data, (size_t)count * sizeof *to->line.data);
    }
    return true;
}

/* Which of so many images of a panel a triangle is of: bit 1 in x, bit 2 in y, as the planes. */
static int planes_of_image(const mesh_file *f, int image) { return f->mirror_x ? image : 2 * image; }

/* The images of a panel stand one after the other in the order of their planes, each as many triangles (io/gdf.c). */
bool hull_unmirror(context *ctx, const mesh_file *file, hull_half planes, mesh_file *out)
{
    if (!hull_copy_file(ctx, file, out))
        return false;
    const int32_t images = (file->mirror_x ? 2 : 1) * (file->mirror_y ? 2 : 1), count = file->element.count;
    int32_t kept = 0, end = 0;
    for (int32_t first = 0; first < count; first = end) {
        while (end < count && file->element.data[end] == file->element.data[first])
            end++;
        for (int32_t f = first; f < end; f++) {
            int32_t image = images * (f - first) / (end - first);
            if (planes_of_image(file, (int)image) & (int)planes)
                continue;
            out->surface.face.data[kept] = file->surface.face.data[f];
            out->element.data[kept] = file->element.data[f];
            out->line.data[kept++] = file->line.data[f];
        }
    }
    out->surface.face.count = out->element.count = out->line.count = kept;
    out->mirror_x = file->mirror_x && !(planes & HULL_HALF_X);
    out->mirror_y = file->mirror_y && !(planes & HULL_HALF_Y);
    return mesh_drop_unused_vertices(ctx, &out->surface);
}

bool hull_lies_about_centre(const mesh *m)
{
    box3 box = mesh_bounds(m);
    return fabs(box.lo.y + box.hi.y) <= OFF_SYMMETRY * hull_longest_side(m);
}

bool hull_begins_at_x(const mesh *m)
{
    box3 box = mesh_bounds(m);
    return fmin(fabs(box.lo.x), fabs(box.hi.x)) <= OFF_SYMMETRY * hull_longest_side(m);
}
