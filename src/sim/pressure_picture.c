/* The unrolled hull as a picture: each side with x or, of the ends, y to the right; hulls beside each other one above
   the other. */
#include "sim/hull_pressure_parts.h"

#include "io/plan_view.h"
#include "model/scenario_vessel.h"

#include <stdio.h>

enum { LONGEST = 1600, LAYERS_MOST = 6 };

/* Patches of a side that would cover each other are drawn in layers, the outermost first. */
typedef struct patch_view {
    box2 box; /* across and up, as the side is seen */
    double depth;
    int32_t layer;
    bool used;
} patch_view;

static vec2 seen(hull_side side, vec3 p)
{
    switch (side) {
    case SIDE_BOW:
    case SIDE_STERN:
        return vec2_make(p.y, p.z);
    case SIDE_BOTTOM:
    case SIDE_DECK:
        return vec2_make(p.x, p.y);
    default:
        return vec2_make(p.x, p.z);
    }
}

static double depth_of(hull_side side, vec3 p)
{
    const double by_side[SIDE_COUNT] = {p.y, -p.y, p.x, -p.x, -p.z, p.z};
    return by_side[side];
}

static void measure_patches(const pressure_map *p, patch_view *view)
{
    const hull_panels *h = &p->panels;
    for (int32_t i = 0; i < h->facet.count; i++) {
        const panel_facet *f = &h->facet.data[i];
        const hull_panel *q = &h->panel.data[f->panel];
        patch_view *v = &view[q->patch];
        for (int32_t k = 0; k < f->count; k++) {
            vec3 c = h->corner.data[f->first + k];
            vec2 at = seen((hull_side)q->side, c);
            if (!v->used)
                *v = (patch_view){.box = {at, at}, .depth = depth_of((hull_side)q->side, c), .used = true};
            v->box = (box2){{fmin(v->box.lo.x, at.x), fmin(v->box.lo.y, at.y)},
                            {fmax(v->box.hi.x, at.x), fmax(v->box.hi.y, at.y)}};
            v->depth = fmax(v->depth, depth_of((hull_side)q->side, c));
        }
    }
}

static bool cover(const patch_view *a, const patch_view *b, double slack)
{
    return a->box.lo.x < b->box.hi.x - slack && b->box.lo.x < a->box.hi.x - slack &&
           a->box.lo.y < b->box.hi.y - slack && b->box.lo.y < a->box.hi.y - slack;
}

/* One layer below the deepest of those outside of it that it lies behind. */
static void set_layers(const pressure_map *p, patch_view *view)
{
    int32_t count = p->panels.patch.count;
    for (int32_t round = 0; round < LAYERS_MOST; round++) {
        for (int32_t i = 0; i < count; i++) {
            for (int32_t k = 0; k < count; k++) {
                bool before = view[k].depth > view[i].depth || (view[k].depth == view[i].depth && k < i);
                if (i == k || !view[i].used || !view[k].used || !before ||
                    p->panels.patch.data[i].side != p->panels.patch.data[k].side ||
                    !cover(&view[i], &view[k], 0.5 * p->o->rules.size))
                    continue;
                if (view[i].layer <= view[k].layer && view[i].layer + 1 < LAYERS_MOST)
                    view[i].layer = view[k].layer + 1;
            }
        }
    }
}

/* Where the views stand: sides above one another, the ends to the right. */
typedef struct sheet {
    vec2 shift[SIDE_COUNT][LAYERS_MOST];
    box2 window;
    plan_label name[SIDE_COUNT * LAYERS_MOST];
    int32_t names;
} sheet;

static box2 side_box(const pressure_map *p, const patch_view *view, int side, int32_t layer)
{
    box2 box = {{HUGE_VAL, HUGE_VAL}, {-HUGE_VAL, -HUGE_VAL}};
    for (int32_t i = 0; i < p->panels.patch.count; i++) {
        if (!view[i].used || p->panels.patch.data[i].side != side || view[i].layer != layer)
            continue;
        box = (box2){{fmin(box.lo.x, view[i].box.lo.x), fmin(box.lo.y, view[i].box.lo.y)},
                     {fmax(box.hi.x, view[i].box.hi.x), fmax(box.hi.y, view[i].box.hi.y)}};
    }
    return box;
}

static void name_view(sheet *s, int side, int32_t layer, vec2 at)
{
    plan_label *l = &s->name[s->names++];
    *l = (plan_label){.at = at, .bare = true};
    if (layer > 0)
        snprintf(l->text, sizeof l->text, "%s, %d", hull_side_name((hull_side)side), (int)layer + 1);
    else
        snprintf(l->text, sizeof l->text, "%s", hull_side_name((hull_side)side));
}

/* Between two views, over the longest side: room for a name at any size of the panels. */
#define GAP 0.03

static double longest_side(const pressure_map *p, const patch_view *view)
{
    double longest = 0;
    for (int32_t i = 0; i < p->panels.patch.count; i++) {
        if (view[i].used)
            longest = fmax(longest, fmax(view[i].box.hi.x - view[i].box.lo.x, view[i].box.hi.y - view[i].box.lo.y));
    }
    return longest;
}

static void place(const pressure_map *p, const patch_view *view, sheet *s)
{
    static const int order[SIDE_COUNT] = {SIDE_PORT, SIDE_STARBOARD, SIDE_BOTTOM, SIDE_DECK, SIDE_BOW, SIDE_STERN};
    double gap = GAP * longest_side(p, view), down = 0, right = -HUGE_VAL, left = HUGE_VAL;
    s->window = (box2){{HUGE_VAL, HUGE_VAL}, {-HUGE_VAL, -HUGE_VAL}};
    for (int i = 0; i < SIDE_COUNT; i++) {
        bool end = order[i] == SIDE_BOW || order[i] == SIDE_STERN;
        if (order[i] == SIDE_BOW)
            down = 0;
        for (int32_t layer = 0; layer < LAYERS_MOST; layer++) {
            box2 box = side_box(p, view, order[i], layer);
            if (!(box.lo.x <= box.hi.x))
                continue;
            double x = end && right > -HUGE_VAL ? right + 2 * gap - box.lo.x : 0;
            s->shift[order[i]][layer] = vec2_make(x, down - box.hi.y);
            name_view(s, order[i], layer, vec2_make(box.lo.x + x, down + gap / 2));
            down -= box.hi.y - box.lo.y + gap;
            left = fmin(left, box.lo.x + x);
            s->window = (box2){{fmin(s->window.lo.x, left), fmin(s->window.lo.y, down)},
                               {fmax(s->window.hi.x, box.hi.x + x), fmax(s->window.hi.y, gap)}};
        }
        if (!end)
            right = fmax(right, s->window.hi.x);
    }
    s->window.lo.x -= gap;
    s->window.hi.x += gap;
}

static void make_shapes(const pressure_map *p, const patch_view *view, const sheet *s, double most, plan_shape *shapes,
                        vec2 *corners)
{
    const hull_panels *h = &p->panels;
    for (int32_t i = 0; i < h->facet.count; i++) {
        const panel_facet *f = &h->facet.data[i];
        const hull_panel *q = &h->panel.data[f->panel];
        double value = p->load[f->panel].most / q->area;
        vec2 shift = s->shift[q->side][view[q->patch].layer];
        for (int32_t k = 0; k < f->count; k++)
            corners[f->first + k] = vec2_add(seen((hull_side)q->side, h->corner.data[f->first + k]), shift);
        shapes[i] = (plan_shape){.outline = {&corners[f->first], f->count},
                                 .style = PLAN_LEVEL_ICE, /* without lines between the facets of a panel */
                                 .has_value = value > 0,
                                 .value = (float)(most > 0 ? value / most : 0)};
    }
}

/* "panels of 1 m", or by whose lines they are. */
static void panel_words(const panel_rules *r, char *out, size_t room)
{
    if (r->frame_count > 0 && r->stringer_count > 0)
        snprintf(out, room, "own frames and stringers");
    else if (r->frame_count > 0 || r->stringer_count > 0)
        snprintf(out, room, "own %s, else panels of %g m", r->frame_count > 0 ? "frames" : "stringers", r->size);
    else
        snprintf(out, room, "panels of %g m", r->size);
}

fram_status pressure_draw(pressure_map *p, const char *path, fram_error *error)
{
    const hull_panels *h = &p->panels;
    char caption[300], title[200], panels[120];
    vessel_entry vessel = scenario_vessel_entry(&p->s, p->vessel);
    double most = 0;
    sheet s = {0};
    plan_shape *shapes = memory_array(p->ctx, (size_t)h->facet.count, sizeof *shapes);
    vec2 *corners = memory_array(p->ctx, (size_t)h->corner.count, sizeof *corners);
    patch_view *view = memory_array(p->ctx, (size_t)h->patch.count, sizeof *view);
    fram_status status = shapes && corners && view ? FRAM_OK : error_memory(error);
    for (int32_t i = 0; i < h->panel.count; i++)
        most = fmax(most, p->load[i].most / h->panel.data[i].area);
    if (status == FRAM_OK) {
        measure_patches(p, view);
        set_layers(p, view);
        place(p, view, &s);
        make_shapes(p, view, &s, most, shapes, corners);
        snprintf(title, sizeof title, "Largest ice pressure on %s", vessel_title_of(&vessel).text);
        panel_words(&p->o->rules, panels, sizeof panels);
        snprintf(caption, sizeof caption,
                 "the bow is to the right; bottom and deck with port up, bow and stern with port to the right; "
                 "%s, from %.10g to %.10g s",
                 panels, p->o->from, p->end);
        const plan_view picture = {.window = s.window,
                                   .title = title,
                                   .caption = caption,
                                   .shapes = shapes,
                                   .shape_count = h->facet.count,
                                   .labels = s.name,
                                   .label_count = s.names,
                                   .no_axes = true,
                                   .scale_name = "pressure [MPa]",
                                   .scale_hi = most * 1e-6,
                                   .unscaled_name = "no ice met it"};
        status = plan_view_write(p->ctx, &picture, path, LONGEST, error);
    }
    memory_free(p->ctx, shapes);
    memory_free(p->ctx, corners);
    memory_free(p->ctx, view);
    return status == FRAM_ERROR_UNSUPPORTED ? FRAM_OK : status;
}
