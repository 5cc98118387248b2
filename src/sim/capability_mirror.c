#include "sim/capability_mirror.h"

#include "base/transcendental.h"
#include "sim/build_level.h"

#include <math.h>

/* Of coordinates: what rounding leaves between a place and its image. */
#define IMAGE_ROUNDED 1e-9

/* The centre line of the vessel, from above. */
typedef struct mirror_line {
    vec2 at, along;
} mirror_line;

typedef struct rectangle {
    vec2 corner[4];
} rectangle;

static vec2 image_of(const mirror_line *m, vec2 p)
{
    vec2 off = vec2_sub(p, m->at);
    return vec2_sub(vec2_add(m->at, vec2_scale(m->along, 2 * vec2_dot(off, m->along))), off);
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
    for (int k = 0; k < 4 && same; k++) {
        double size = vec2_length(a->corner[k]) + vec2_length(m->at);
        same = has_corner(b, image_of(m, a->corner[k]), IMAGE_ROUNDED * size);
    }
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

/* A sheet without edges is; where it has such, those that it lacks are far away. */
static bool is_sheet_mirrored(const mirror_line *m, const scenario *s)
{
    const double far = 1e9;
    box2 b = build_sheet_extent(s);
    if (isinf(b.lo.x) && isinf(b.lo.y) && isinf(b.hi.x) && isinf(b.hi.y))
        return true;
    const box2 sheet = {{fmax(b.lo.x, m->at.x - far), fmax(b.lo.y, m->at.y - far)},
                        {fmin(b.hi.x, m->at.x + far), fmin(b.hi.y, m->at.y + far)}};
    const rectangle edges = of_box(sheet);
    return is_image(m, &edges, &edges);
}

/* The ice is endless, but its outer band goes with the drift, whatever pushes: a vessel nearer to it on one side meets
   other ice there.  In the middle of a square both sides are alike enough on any heading. */
static bool is_domain_mirrored(const mirror_line *m, const scenario_domain *d)
{
    const box2 b = domain_box(d);
    const rectangle edges = of_box(b);
    double wide = b.hi.x - b.lo.x, high = b.hi.y - b.lo.y, near = IMAGE_ROUNDED * (wide + high);
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

bool capability_is_mirrored(const scenario *s)
{
    const scenario_vessel *v = &s->vessel;
    double heading = radians(v->heading_deg);
    const mirror_line m = {{v->x, v->y}, {real_cos(heading), real_sin(heading)}};
    return v->hull.form != HULL_MESH && automatic_or(v->centre_of_gravity_y, 0) == 0 &&
           is_domain_mirrored(&m, &s->domain) && is_ice_mirrored(&m, s);
}
