#include "ice/prism_surfaces.h"

#include <string.h>

/* With so many at the start of a step all are made anew, so that memory does not grow with the floes that ever crushed.
 */
enum { MOST_KEPT = 4096 };
/* A surface of up to so many vertices is searched faster without a tree. */
enum { VERTICES_WITHOUT_TREE = 64 };

void prism_surfaces_free(context *ctx, prism_surfaces *s)
{
    for (int32_t i = 0; i < s->kept.count; i++) {
        prism_surface *p = &s->kept.data[i];
        array_free(ctx, &p->outline);
        mesh_free(ctx, &p->surface);
        mesh_adjacency_free(ctx, &p->adjacency);
        mesh_bvh_free(ctx, &p->tree);
        prism_faces_free(ctx, &p->faces);
    }
    array_free(ctx, &s->kept);
    array_free(ctx, &s->place);
    s->used = 0;
}

static bool is_same(const prism_surface *p, polygon outline, double half_height)
{
    return p->half_height == half_height && p->outline.count == outline.count &&
           memcmp(p->outline.data, outline.vertex, (size_t)outline.count * sizeof *outline.vertex) == 0;
}

static fram_status make(context *ctx, prism_surface *p, polygon outline, double half_height, fram_error *error)
{
    p->outline.count = 0; /* is the surface of nothing until it is whole */
    fram_status status = mesh_make_prism(ctx, outline, -half_height, half_height, &p->surface, error);
    if (status != FRAM_OK)
        return status;
    p->has_tree = p->surface.vertex.count > VERTICES_WITHOUT_TREE;
    if (mesh_adjacency_build(ctx, &p->surface, &p->adjacency) != FRAM_OK ||
        (p->has_tree ? mesh_bvh_build(ctx, &p->surface, &p->tree) != FRAM_OK
                     : !prism_faces_make(ctx, &p->surface, &p->faces)) ||
        !array_resize(ctx, &p->outline, outline.count))
        return error_memory(error);
    memcpy(p->outline.data, outline.vertex, (size_t)outline.count * sizeof *outline.vertex);
    p->half_height = half_height;
    return FRAM_OK;
}

static bool make_places(context *ctx, prism_surfaces *s, int32_t rows)
{
    int32_t before = s->place.count;
    if (rows <= before)
        return true;
    if (!array_resize(ctx, &s->place, rows))
        return false;
    for (int32_t i = before; i < rows; i++)
        s->place.data[i] = -1;
    return true;
}

/* The place of a row's surface, a new one where it has none; -1: no memory. */
static int32_t surface_place(context *ctx, prism_surfaces *s, int32_t row)
{
    if (s->place.data[row] >= 0)
        return s->place.data[row];
    if (s->used == s->kept.count && !array_push(ctx, &s->kept, (prism_surface){.half_height = 0}))
        return -1;
    s->place.data[row] = s->used;
    return s->used++;
}

void prism_surfaces_begin(prism_surfaces *s)
{
    if (s->used < MOST_KEPT)
        return;
    s->used = 0;
    for (int32_t i = 0; i < s->place.count; i++)
        s->place.data[i] = -1;
}

fram_status prism_surfaces_get(context *ctx, prism_surfaces *s, const shape_store *shapes, int32_t row,
                               const prism_surface **out, fram_error *error)
{
    int32_t at = make_places(ctx, s, shapes->shapes.count) ? surface_place(ctx, s, row) : -1;
    if (at < 0)
        return error_memory(error);
    prism_surface *p = &s->kept.data[at];
    polygon outline = shape_outline(shapes, row);
    double half_height = shapes->shapes.half_height[row];
    *out = p;
    return is_same(p, outline, half_height) ? FRAM_OK : make(ctx, p, outline, half_height, error);
}

const prism_surface *prism_surfaces_find(const prism_surfaces *s, int32_t row)
{
    return row < s->place.count && s->place.data[row] >= 0 ? &s->kept.data[s->place.data[row]] : NULL;
}
