/* Algorithm 10: what is too small for the simulator leaves an outline. */
#include "geometry/polygon.h"
#include "geometry/predicate.h"

/* Cosine of the turn beyond which a vertex is straight, or below the negative of which it is a spike (about 8
   degrees). */
#define TURN_COSINE 0.99

typedef enum fate { FATE_KEPT, FATE_MERGED, FATE_SPIKE } fate;

/* The ring that is left, linked through the numbers of the original vertices. */
typedef struct clean_node {
    int32_t previous, next;
    fate fate;
} clean_node;

typedef struct cleaning {
    polygon p;
    double edge;
    const box2 *box; /* vertices on its sides stay; NULL: all may go */
    bool spikes_stay;
    clean_node *node;
    int32_t first, left;
} cleaning;

static bool stays(const cleaning *c, int32_t i)
{
    vec2 v = c->p.vertex[i];
    return c->box && (v.x <= c->box->lo.x || v.x >= c->box->hi.x || v.y <= c->box->lo.y || v.y >= c->box->hi.y);
}

/* Every vertex merged between the kept ones a and b, and those between them now, lie within the edge threshold of
   the chord ab. */
static bool chord_serves(const cleaning *c, int32_t a, int32_t b)
{
    vec2 from = c->p.vertex[a], to = c->p.vertex[b];
    for (int32_t i = a + 1 < c->p.count ? a + 1 : 0; i != b; i = i + 1 < c->p.count ? i + 1 : 0) {
        vec2 v = c->p.vertex[i];
        double height = vec2_length(vec2_sub(segment_nearest(from, to, v), v));
        if (c->node[i].fate != FATE_SPIKE && height >= c->edge && height > 0)
            return false;
    }
    return true;
}

/* Twice the area that goes or comes with a kept vertex. */
static double area_at(const cleaning *c, int32_t i)
{
    const vec2 *v = c->p.vertex;
    return fabs(vec2_cross(vec2_sub(v[i], v[c->node[i].previous]), vec2_sub(v[c->node[i].next], v[i])));
}

/* Which vertex of the short edge from i goes; -1 when both must stay.  Of two for which a chord serves alike, or does
   not, the one that costs less area: where a corner between long edges has a short one beside it, the other end. */
static int32_t short_edge_victim(const cleaning *c, int32_t i)
{
    int32_t next = c->node[i].next;
    if (stays(c, i) || stays(c, next))
        return !stays(c, i) ? i : !stays(c, next) ? next : -1;
    bool serves = chord_serves(c, c->node[i].previous, next), other = chord_serves(c, i, c->node[next].next);
    if (serves != other)
        return serves ? i : next;
    return area_at(c, i) <= area_at(c, next) ? i : next;
}

/* The vertex that goes because of vertex i, or -1. */
static int32_t victim_at(const cleaning *c, int32_t i, fate *why)
{
    int32_t previous = c->node[i].previous, next = c->node[i].next;
    vec2 e0 = vec2_sub(c->p.vertex[i], c->p.vertex[previous]), e1 = vec2_sub(c->p.vertex[next], c->p.vertex[i]);
    double l0 = vec2_length(e0), l1 = vec2_length(e1);
    *why = FATE_MERGED;
    if (l1 < c->edge || l1 == 0)
        return short_edge_victim(c, i);
    if (l0 == 0 || stays(c, i))
        return -1; /* of a doubled vertex the one before goes, in its turn */
    double cosine = vec2_dot(e0, e1) / (l0 * l1);
    if (cosine < -TURN_COSINE) {
        *why = FATE_SPIKE;
        return c->spikes_stay ? -1 : i;
    }
    return cosine > TURN_COSINE && chord_serves(c, previous, next) ? i : -1;
}

static void drop(cleaning *c, int32_t i, fate why)
{
    int32_t previous = c->node[i].previous, next = c->node[i].next;
    c->node[i].fate = why;
    c->node[previous].next = next;
    c->node[next].previous = previous;
    if (c->first == i)
        c->first = next;
    c->left--;
}

/* Once round; true when a vertex was dropped. */
static bool clean_pass(cleaning *c)
{
    int32_t before = c->left, i = c->first;
    for (int32_t visits = c->left; visits > 0 && c->left > 3; visits--) {
        fate why;
        int32_t victim = victim_at(c, i, &why), next = c->node[i].next;
        if (victim >= 0)
            drop(c, victim, why);
        if (victim != next)
            i = next;
    }
    return c->left < before;
}

static bool clean(context *ctx, cleaning c, vec2_array *out)
{
    polygon p = c.p;
    array_clear(out);
    if (p.count == 0)
        return true;
    c.left = p.count;
    c.node = memory_array(ctx, (size_t)p.count, sizeof *c.node);
    if (!c.node || !array_reserve(ctx, out, p.count)) {
        memory_free(ctx, c.node);
        return false;
    }
    for (int32_t i = 0; i < p.count; i++)
        c.node[i] = (clean_node){i > 0 ? i - 1 : p.count - 1, i + 1 < p.count ? i + 1 : 0, FATE_KEPT};
    while (clean_pass(&c))
        continue;
    for (int32_t i = 0; i < p.count; i++)
        if (c.node[i].fate == FATE_KEPT)
            out->data[out->count++] = p.vertex[i];
    memory_free(ctx, c.node);
    return true;
}

bool polygon_clean(context *ctx, polygon p, double edge, vec2_array *out)
{
    return clean(ctx, (cleaning){.p = p, .edge = edge}, out);
}

bool polygon_clean_inside(context *ctx, polygon p, double edge, box2 box, vec2_array *out)
{
    return clean(ctx, (cleaning){.p = p, .edge = edge, .box = &box}, out);
}

bool polygon_merge(context *ctx, polygon p, double edge, const box2 *box, vec2_array *out)
{
    return clean(ctx, (cleaning){.p = p, .edge = edge, .box = box, .spikes_stay = true}, out);
}

bool polygon_is_clean(polygon p, double edge)
{
    for (int32_t i = 0; i < p.count; i++) {
        vec2 here = p.vertex[i], last = p.vertex[i > 0 ? i - 1 : p.count - 1];
        vec2 e0 = vec2_sub(here, last), e1 = vec2_sub(p.vertex[i + 1 < p.count ? i + 1 : 0], here);
        double l0 = vec2_length(e0), l1 = vec2_length(e1);
        if (l1 < edge || l1 == 0 || vec2_dot(e0, e1) < -TURN_COSINE * l0 * l1)
            return false;
    }
    return true;
}
