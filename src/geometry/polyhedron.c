/* Convex polyhedra: measures, and the prism.  Knows nothing of contact. */
#include "geometry/polyhedron.h"

#include "geometry/point_grid.h"
#include "geometry/polyhedron_build.h"

/* Directions closer than this [rad] are one: their difference moves no contact by a millionth of a body. */
#define PARALLEL 1e-6

void polyhedron_free(context *ctx, polyhedron *p)
{
    array_free(ctx, &p->vertex);
    array_free(ctx, &p->face);
    array_free(ctx, &p->loop);
    array_free(ctx, &p->edge_direction);
}

void polyhedron_array_free(context *ctx, polyhedron_array *a)
{
    for (int32_t i = 0; i < a->count; i++)
        polyhedron_free(ctx, &a->data[i]);
    array_free(ctx, a);
}

static bool reserve_like(context *ctx, polyhedron *p, const polyhedron *model)
{
    return array_reserve(ctx, &p->vertex, model->vertex.count) && array_reserve(ctx, &p->face, model->face.count) &&
           array_reserve(ctx, &p->loop, model->loop.count) &&
           array_reserve(ctx, &p->edge_direction, model->edge_direction.count);
}

bool polyhedron_place(context *ctx, const polyhedron *model, mat3 r, vec3 centre, polyhedron *out)
{
    if (!reserve_like(ctx, out, model))
        return false;
    out->vertex.count = model->vertex.count;
    for (int32_t i = 0; i < model->vertex.count; i++)
        out->vertex.data[i] = vec3_add(centre, mat3_mul_vec(r, model->vertex.data[i]));
    out->face.count = model->face.count;
    for (int32_t i = 0; i < model->face.count; i++) {
        out->face.data[i] = model->face.data[i];
        vec3 normal = mat3_mul_vec(r, model->face.data[i].normal);
        out->face.data[i].normal = normal;
        out->face.data[i].offset = model->face.data[i].offset + vec3_dot(normal, centre);
    }
    out->loop.count = model->loop.count;
    for (int32_t i = 0; i < model->loop.count; i++)
        out->loop.data[i] = model->loop.data[i];
    out->edge_direction.count = model->edge_direction.count;
    for (int32_t i = 0; i < model->edge_direction.count; i++)
        out->edge_direction.data[i] = mat3_mul_vec(r, model->edge_direction.data[i]);
    out->centre = vec3_add(centre, mat3_mul_vec(r, model->centre));
    out->radius = model->radius;
    out->seam = model->seam;
    return true;
}

void polyhedron_translate(polyhedron *p, vec3 by)
{
    for (int32_t i = 0; i < p->vertex.count; i++)
        p->vertex.data[i] = vec3_add(p->vertex.data[i], by);
    for (int32_t i = 0; i < p->face.count; i++)
        p->face.data[i].offset += vec3_dot(p->face.data[i].normal, by);
    p->centre = vec3_add(p->centre, by);
}

static vec3 corner(const polyhedron *p, const polyhedron_face *f, int32_t i)
{
    return p->vertex.data[p->loop.data[f->first + i]];
}

/* Twice the area vector of a face (Newell 1972), about its first vertex. */
static vec3 twice_face_area(const polyhedron *p, const polyhedron_face *f)
{
    vec3 origin = corner(p, f, 0), sum = {0, 0, 0};
    for (int32_t i = 2; i < f->count; i++)
        sum = vec3_add(sum, vec3_cross(vec3_sub(corner(p, f, i - 1), origin), vec3_sub(corner(p, f, i), origin)));
    return sum;
}

/* Volume about `origin`; first (may be NULL) gets the first moment about it. */
static double volume_about(const polyhedron *p, vec3 origin, vec3 *first)
{
    double volume = 0;
    vec3 moment = {0, 0, 0};
    for (int32_t k = 0; k < p->face.count; k++) {
        const polyhedron_face *f = &p->face.data[k];
        vec3 a = vec3_sub(corner(p, f, 0), origin);
        for (int32_t i = 2; i < f->count; i++) {
            vec3 b = vec3_sub(corner(p, f, i - 1), origin), c = vec3_sub(corner(p, f, i), origin);
            double v = vec3_dot(a, vec3_cross(b, c)) / 6;
            volume += v;
            moment = vec3_mad(moment, vec3_add(vec3_add(a, b), c), v / 4);
        }
    }
    if (first)
        *first = moment;
    return volume;
}

double polyhedron_volume(const polyhedron *p) { return p->vertex.count ? volume_about(p, p->vertex.data[0], NULL) : 0; }

bool polyhedron_contains(const polyhedron *p, vec3 point, double margin)
{
    for (int32_t k = 0; k < p->face.count; k++)
        if (vec3_dot(p->face.data[k].normal, point) - p->face.data[k].offset > margin)
            return false;
    return p->face.count > 0;
}

/* The plane through a face's loop; no vertex of the loop is outside it. */
static void set_plane(const polyhedron *p, polyhedron_face *f)
{
    f->normal = vec3_unit(twice_face_area(p, f));
    f->offset = vec3_dot(f->normal, corner(p, f, 0));
    for (int32_t i = 1; i < f->count; i++)
        f->offset = fmax(f->offset, vec3_dot(f->normal, corner(p, f, i)));
}

static bool add_directions(context *ctx, polyhedron *p)
{
    point_grid grid;
    bool done = point_grid_init(ctx, &grid, (box3){{-1, -1, -1}, {1, 1, 1}}, PARALLEL, p->loop.count / 2);
    for (int32_t k = 0; done && k < p->face.count; k++) {
        const polyhedron_face *f = &p->face.data[k];
        for (int32_t i = 0; done && i < f->count; i++) {
            int32_t from = p->loop.data[f->first + i], to = p->loop.data[f->first + (i + 1) % f->count];
            if (from > to)
                continue; /* each edge once */
            vec3 d = vec3_unit(vec3_sub(p->vertex.data[to], p->vertex.data[from]));
            if (point_grid_find(&grid, d) < 0 && point_grid_find(&grid, vec3_neg(d)) < 0)
                done = point_grid_add(ctx, &grid, d) && array_push(ctx, &p->edge_direction, d);
        }
    }
    point_grid_free(ctx, &grid);
    return done;
}

bool polyhedron_finish(context *ctx, polyhedron *p)
{
    for (int32_t k = 0; k < p->face.count; k++)
        set_plane(p, &p->face.data[k]);
    vec3 origin = p->vertex.data[0], first;
    double volume = volume_about(p, origin, &first);
    p->centre = vec3_add(origin, vec3_scale(first, 1 / volume));
    p->radius = 0;
    for (int32_t i = 0; i < p->vertex.count; i++)
        p->radius = fmax(p->radius, vec3_length(vec3_sub(p->vertex.data[i], p->centre)));
    array_clear(&p->edge_direction);
    return add_directions(ctx, p);
}
