/* Connected parts by flooding; see mesh_parts.h. */
#include "geometry/mesh_parts.h"

#include "base/transcendental.h"
#include "geometry/mesh_point.h"

/* Label everything that hangs together with `seed`; `waiting` has room for all faces. */
static void flood(const mesh *m, const mesh_adjacency *adjacency, int32_t seed, int32_t label, mesh_parts *out,
                  int32_t *waiting)
{
    mesh_part part = {seed, 0, 0, box3_empty()};
    vec3 origin = m->vertex.data[m->face.data[seed].v[0]];
    int32_t count = 0;
    waiting[count++] = seed;
    out->of_face.data[seed] = label;
    while (count) {
        int32_t f = waiting[--count];
        vec3 p[3];
        mesh_face_points(m, f, p);
        part.face_count++;
        part.box = box3_union(part.box, mesh_face_bounds(m, f));
        part.volume += vec3_dot(vec3_sub(p[0], origin), mesh_area_vector(m, f)) / 3;
        for (int k = 0; k < 3; k++) {
            int32_t g = adjacency->neighbour.data[3 * f + k];
            if (g >= 0 && out->of_face.data[g] < 0) {
                out->of_face.data[g] = label;
                waiting[count++] = g;
            }
        }
    }
    out->part.data[label] = part;
}

fram_status mesh_parts_build(context *ctx, const mesh *m, const mesh_adjacency *adjacency, mesh_parts *out)
{
    int32_t faces = m->face.count;
    int32_t *waiting = memory_array(ctx, (size_t)faces, sizeof *waiting);
    bool done = waiting && array_resize(ctx, &out->of_face, faces);
    array_clear(&out->part);
    for (int32_t f = 0; done && f < faces; f++)
        out->of_face.data[f] = -1;
    for (int32_t f = 0; done && f < faces; f++)
        if (out->of_face.data[f] < 0) {
            int32_t label = out->part.count;
            done = array_resize(ctx, &out->part, label + 1);
            if (done)
                flood(m, adjacency, f, label, out, waiting);
        }
    memory_free(ctx, waiting);
    return done ? FRAM_OK : FRAM_ERROR_MEMORY;
}

void mesh_parts_free(context *ctx, mesh_parts *p)
{
    array_free(ctx, &p->of_face);
    array_free(ctx, &p->part);
}

bool mesh_copy_part(context *ctx, const mesh *m, const mesh_parts *p, int32_t part, mesh *out)
{
    mesh_clear(out);
    int32_t *number = memory_array(ctx, (size_t)m->vertex.count, sizeof *number);
    bool done = number && array_reserve(ctx, &out->face, p->part.data[part].face_count);
    for (int32_t f = 0; done && f < m->face.count; f++)
        for (int k = 0; k < 3 && p->of_face.data[f] == part; k++)
            number[m->face.data[f].v[k]] = 1;
    for (int32_t v = 0; done && v < m->vertex.count; v++)
        if (number[v]) {
            number[v] = out->vertex.count;
            done = mesh_add_vertex(ctx, out, m->vertex.data[v]);
        }
    for (int32_t f = 0; done && f < m->face.count; f++) {
        const int32_t *v = m->face.data[f].v;
        if (p->of_face.data[f] == part)
            done = mesh_add_triangle(ctx, out, number[v[0]], number[v[1]], number[v[2]]);
    }
    memory_free(ctx, number);
    return done;
}

/* How often the parts other than `own` wind about the point. */
static double winding(const mesh *m, const mesh_parts *parts, int32_t own, vec3 point)
{
    double sum = 0;
    for (int32_t i = 0; i < parts->part.count; i++) {
        const mesh_part *part = &parts->part.data[i];
        if (i == own || !box3_meet(part->box, (box3){point, point}))
            continue;
        for (int32_t f = part->first_face, left = part->face_count; left > 0; f++) {
            if (parts->of_face.data[f] != i)
                continue;
            vec3 p[3];
            mesh_face_points(m, f, p);
            sum += triangle_solid_angle(vec3_sub(p[0], point), vec3_sub(p[1], point), vec3_sub(p[2], point));
            left--;
        }
    }
    return sum / (4 * PI);
}

int32_t mesh_parts_first_inverted(const mesh *m, const mesh_parts *p, bool nested)
{
    for (int32_t i = 0; i < p->part.count; i++) {
        vec3 point = m->vertex.data[m->face.data[p->part.data[i].first_face].v[0]];
        if ((p->part.data[i].volume > 0) == nested && (winding(m, p, i, point) > 0.5) == nested)
            return i;
    }
    return -1;
}
