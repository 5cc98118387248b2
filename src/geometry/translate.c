#include "geometry/mesh.h"
#include "geometry/polyhedron.h"

void mesh_translate(mesh *m, vec3 by)
{
    for (int32_t i = 0; i < m->vertex.count; i++) m->vertex.data[i] = vec3_add(m->vertex.data[i], by);
}

void polyhedron_translate(polyhedron *p, vec3 by)
{
    for (int32_t i = 0; i < p->vertex.count; i++) p->vertex.data[i] = vec3_add(p->vertex.data[i], by);
    for (int32_t i = 0; i < p->face.count; i++) p->face.data[i].offset += vec3_dot(p->face.data[i].normal, by);
    p->centre = vec3_add(p->centre, by);
}
