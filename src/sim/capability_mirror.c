#include "sim/capability_mirror.h"

#include "base/transcendental.h"
#include "sim/build_level.h"

#include <math.h>

/* What rounding leaves between a place and its image: of numbers as they are written, a part of the domain's size,
   however far away the place is; of those that are computed, a part of their own size. */
#define IMAGE_WRITTEN 1e-9
#define IMAGE_COMPUTED 1e-14

/* The centre line of the vessel, from above. */
typedef struct mirror_line {
    vec2 at, along;
    double written; /* [m] IMAGE_WRITTEN of the domain */
} mirror_line;

typedef struct rectangle {
    vec2 corner[4];
} rectangle;

static vec2 image_of(const mirror_line *m, vec2 p)
{
    vec2 off = vec2_sub(p, m->at);
    return vec2_sub(vec2_add(m->at, vec2_scale(m->along, 2 * vec2_dot(off, m->along))), off);
}

static double rounded_at(const mirror_line *m, vec2 p)
{
    return m->written + IMAGE_COMPUTED * (vec2_length(p) + vec2_length(m->at));
}

static bool has_corner(const rectangle *r, vec2 p, double near)
{
    bool found = false;
    for (int k = 0; k < 4; k++)
        found = found || vec2_length(vec2_sub(r->corner[k], p)) <= near;
    return found;
}

static bool is_image(const mirror_line *m, const rectangle *a, const rectangle *b)
{
    bool same = true;
    for (int k = 0; k < 4 && same; k++)
        same = has_corner(b, image_of(m, a->corner[k]), rounded_at(m, a->corner[k]));
    return same;
}

static rectangle of_box(box2 b) { return (rectangle){{b.lo, {b.hi.x, b.lo.y}, b.hi, {b.lo.x, b.hi.y}}}; }

static rectangle of_opening(const scenario_opening *o)
{
    rectangle r;
    build_opening_corners(o, r.corner);
    return r;
}

/* Each is its own image or that of another one. */
static bool are_openings_mirrored(const mirror_line *m, const scenario_opening_list *l)
{
    bool all = true;
    for (int32_t i = 0; i < l->count && all; i++) {
        rectangle one = of_opening(&l->data[i]);
        all = false;
        for (int32_t k = 0; k < l->count && !all; k++) {
            rectangle other = of_opening(&l->data[k]);
            all = is_image(m, &one, &other);
        }
    }
    return all;
}

/* One of the edges of a sheet that there are: straight, and without end as far as it matters. */
typedef struct sheet_edge {
    vec2 at, outward;
} sheet_edge;

/* at: the place on it that is nearest to the vessel, so that no size takes part but how far off the edge is. */
static int list_edges(const mirror_line *m, box2 b, sheet_edge out[4])
{
    const sheet_edge all[4] = {{{b.lo.x, m->at.y}, {-1, 0}},
                               {{b.hi.x, m->at.y}, {1, 0}},
                               {{m->at.x, b.lo.y}, {0, -1}},
                               {{m->at.x, b.hi.y}, {0, 1}}};
    int count = 0;
    for (int k = 0; k < 4; k++)
        if (isfinite(all[k].at.x) && isfinite(all[k].at.y))
            out[count++] = all[k];
    return count;
}

static bool is_edge_image(const mirror_line *m, const sheet_edge *a, const sheet_edge *b)
{
    vec2 at = image_of(m, a->at), outward = vec2_sub(image_of(m, vec2_add(m->at, a->outward)), m->at);
    return vec2_length(vec2_sub(outward, b->outward)) <= IMAGE_WRITTEN &&
           fabs(vec2_dot(vec2_sub(at, b->at), b->outward)) <= rounded_at(m, a->at);
}

/* Each edge is its own image or that of another one, as is a sheet without edges. */
static bool is_sheet_mirrored(const mirror_line *m, const scenario *s)
{
    sheet_edge edges[4];
    const int count = list_edges(m, build_sheet_extent(s), edges);
    bool all = true;
    for (int i = 0; i < count && all; i++) {
        all = false;
        for (int k = 0; k < count && !all; k++)
            all = is_edge_image(m, &edges[i], &edges[k]);
    }
    return all;
}

/* The ice is endless, but its outer band goes with the drift, whatever pushes: a vessel nearer to it on one side meets
   other ice there.  In the middle of a square both sides are alike enough on any heading. */
static bool is_domain_mirrored(const mirror_line *m, const scenario_domain *d)
{
    const box2 b = domain_box(d);
    const rectangle edges = of_box(b);
    const double wide = b.hi.x - b.lo.x, high = b.hi.y - b.lo.y, near = rounded_at(m, b.hi);
    vec2 middle = vec2_scale(vec2_add(b.lo, b.hi), 0.5);
    bool central = fabs(wide - high) <= near && vec2_length(vec2_sub(middle, m->at)) <= near;
    return central || is_image(m, &edges, &edges);
}

/* Outlines of a file or a list are where they are; templates are turned when floes are drawn, and not turned over. */
static bool is_ice_mirrored(const mirror_line *m, const scenario *s)
{
    const scenario_ice *i = &s->ice;
    bool drawn = scenario_ice_is_drawn(i) && i->source != ICE_FILE;
    for (int32_t k = 0; k < i->populations.count; k++)
        drawn = drawn && i->populations.data[k].shape != POPULATION_TEMPLATES;
    if (i->source == ICE_LEVEL)
        return is_sheet_mirrored(m, s) && are_openings_mirrored(m, &i->level.openings);
    return drawn && !i->open_water_file[0] && are_openings_mirrored(m, &i->open_water);
}

const char *capability_one_sided(const scenario *s)
{
    const scenario_vessel *v = &s->vessel;
    const box2 b = domain_box(&s->domain);
    double heading = radians(v->heading_deg);
    const mirror_line m = {
        {v->x, v->y}, {real_cos(heading), real_sin(heading)}, IMAGE_WRITTEN * (b.hi.x - b.lo.x + b.hi.y - b.lo.y)};
    if (v->hull.form == HULL_MESH || automatic_or(v->centre_of_gravity_y, 0) != 0)
        return "vessel";
    return !is_domain_mirrored(&m, &s->domain) ? "domain" : !is_ice_mirrored(&m, s) ? "ice" : NULL;
}
