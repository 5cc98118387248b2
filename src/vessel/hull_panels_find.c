/* Which panel a point of the hull belongs to. */
#include "geometry/mesh_point.h"
#include "vessel/hull_panels.h"

/* What looks along the direction: within about 70 degrees of it. */
static const double FACING = 0.35;
/* A point lies over a face when its distance is along the face's normal, to this part of it. */
static const double OVER = 1e-6;
/* What may stand round a corner looks along the direction at least as much: not a side along which a hull moves. */
static const double ROUND = 0.02;
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

/* A patch around a corner is flat here, and reaches past what it mostly faces. What lies beside that is folded back
   around its border, as far behind as it was beside, to what stands there nearer than that. */
static int32_t face_round_corner(const panel_search *found)
{
    if (found->face < 0)
        return -1;
    vec3 c[3], n = mesh_area_vector(&found->panels->triangle, found->face), out = found->outward;
    mesh_face_points(&found->panels->triangle, found->face, c);
    vec3 border = triangle_nearest_point(c[0], c[1], c[2], found->point), way = vec3_sub(found->point, border);
    if (vec3_length(vec3_cross(way, n)) <= OVER * vec3_length(way) * vec3_length(n))
        return found->face;
    double aside = vec3_length(vec3_mad(way, out, -vec3_dot(way, out)));
    panel_search s = {found->panels, vec3_mad(border, out, -aside), out, ROUND, aside, -1};
    search(&s);
    return s.face >= 0 ? s.face : found->face;
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
    int32_t face = face_round_corner(&s);
    if (face < 0) {
        s = (panel_search){p, point, outward, -2, 2 * whole, -1};
        search(&s);
        face = s.face;
    }
    if (face < 0)
        return -1;
    p->last_face = face;
    return p->triangle_panel.data[face];
}
