/* Which panel a point of the hull belongs to. */
#include "geometry/mesh_point.h"
#include "vessel/hull_panels.h"

/* What looks along the direction: within about 70 degrees of it. */
static const double FACING = 0.35;
/* As near, in the length of the hull and the way to it: a contact lies in the ice it crushed, centimetres to a few
   metres from the surface. */
static const double NEARBY = 0.64;
/* A box counts as nearer than it is by rounding, of the reach: none is passed over that holds a triangle as near as the
   best. */
static const double ROUNDING = 1e-12;
/* Each of 32 halvings of the tree leaves one node waiting. */
enum { STACK_DEPTH = 64 };

/* A search under way: the best so far, of faces that look along `outward`. */
typedef struct panel_search {
    const hull_panels *panels;
    vec3 point, outward;
    double least;   /* cosine of the angle to outward */
    double nearest; /* of the best, or the reach [m] */
    int32_t face;   /* -1: none */
} panel_search;

/* The lowest of equally near ones, so that the order of looking changes nothing. */
static void try_face(panel_search *s, int32_t face)
{
    const mesh *m = &s->panels->triangle;
    vec3 n = mesh_area_vector(m, face), c[3];
    if (!(vec3_dot(n, s->outward) >= s->least * vec3_length(n)))
        return;
    mesh_face_points(m, face, c);
    double way = vec3_length(vec3_sub(triangle_nearest_point(c[0], c[1], c[2], s->point), s->point));
    if (way < s->nearest || (way == s->nearest && s->face >= 0 && face < s->face)) {
        s->nearest = way;
        s->face = face;
    }
}

static double beyond(double at, double lo, double hi) { return at < lo ? lo - at : at > hi ? at - hi : 0; }

/* Square of the distance to a box. */
static double box_square(const box3 *b, vec3 p)
{
    double x = beyond(p.x, b->lo.x, b->hi.x), y = beyond(p.y, b->lo.y, b->hi.y), z = beyond(p.z, b->lo.z, b->hi.z);
    return x * x + y * y + z * z;
}

static bool may_hold_nearer(const panel_search *s, double square)
{
    double reach = s->nearest * (1 + ROUNDING);
    return square <= reach * reach;
}

typedef struct waiting_node {
    int32_t node;
    double square;
} waiting_node;

/* The nearer child first: what it holds bounds the search of the other. */
static void search(panel_search *s)
{
    const mesh_bvh *tree = &s->panels->tree;
    waiting_node stack[STACK_DEPTH];
    int32_t waiting = 0;
    if (tree->node.count > 0)
        stack[waiting++] = (waiting_node){0, box_square(&tree->node.data[0].box, s->point)};
    while (waiting > 0) {
        waiting_node at = stack[--waiting];
        if (!may_hold_nearer(s, at.square))
            continue;
        const mesh_bvh_node *node = &tree->node.data[at.node];
        if (node->next >= 0) {
            waiting_node a = {at.node + 1, box_square(&tree->node.data[at.node + 1].box, s->point)};
            waiting_node b = {node->next, box_square(&tree->node.data[node->next].box, s->point)};
            bool a_first = a.square <= b.square;
            stack[waiting++] = a_first ? b : a;
            stack[waiting++] = a_first ? a : b;
            continue;
        }
        for (int32_t k = node->first; k < node->first + node->count; k++)
            if (may_hold_nearer(s, box_square(&tree->box.data[k], s->point)))
                try_face(s, tree->face.data[k]);
    }
}

int32_t hull_panel_at(hull_panels *p, vec3 point, vec3 outward)
{
    box3 box = p->bounds;
    double whole = vec3_length(vec3_sub(box.hi, box.lo)) + vec3_length(vec3_sub(point, box.lo));
    panel_search s = {p, point, outward, FACING, NEARBY * whole, -1};
    /* Points come patch by patch, most beside the one before. */
    if (p->last_face < p->triangle.face.count)
        try_face(&s, p->last_face);
    search(&s);
    if (s.face < 0) {
        s = (panel_search){p, point, outward, -2, 2 * whole, -1};
        search(&s);
    }
    if (s.face < 0)
        return -1;
    p->last_face = s.face;
    return p->triangle_panel.data[s.face];
}
