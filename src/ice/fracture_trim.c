/* Crushed ice goes (crush_trims; docs/decisions/0041): a floe that is held or carried keeps no ice where a hull has
   been, so that a hull that comes again meets nothing before the old face, and so that cracks start at the face, not at
   an edge the hull has long passed.

   While the hull presses on, only what it fills over the whole thickness is cut away, less a rim of the edge threshold:
   the hull's surface inside the floe, and so patch and load, stay what they were.  When it has drawn back from its
   patch by more than the edge threshold, all goes that its section had reached at the top or the bottom of the floe.

   A floe that floats (crush_notches; docs/decisions/0177) keeps its ice while the hull presses on.  When the hull has
   drawn back from a steep patch, what it filled over the whole thickness goes: a notch.  What a hull reaches at one
   face only is no side that was crushed: a floe may lie under its bottom. */
#include "ice/edge_gap.h"
#include "ice/fracture_parts.h"

#include <string.h>

/* Patches less steep than this are no sides: the part of the normal along the floe's own vertical. */
static const double STEEP_SIDE = 0.5;

/* One hull against one floe. */
typedef struct trim_pair {
    int32_t floe, surface;
    bool floats;
    bool retreats; /* the hull has left */
    bool flush;    /* no rim stays: the hull has come nearly through */
    vec3 back;     /* from where it stands to where it was when it last pressed on, global [m] */
} trim_pair;

/* The hull as it last pressed on, in the floe's frame; a tile's is the global plan at its own height. */
static trim_place trim_place_of(const fracture_job *j, const trim_pair *p)
{
    const body_table *b = j->state->bodies;
    int32_t body = j->state->floes->body[p->floe];
    mat3 turn = mat3_transpose(quat_matrix(b->orientation[body]));
    vec3 origin = b->position[body];
    if (j->state->floes->tile[p->floe] != 0)
        origin.x = origin.y = 0;
    return (trim_place){.surface = p->surface,
                        .rotation = mat3_mul(turn, quat_matrix(b->orientation[p->surface])),
                        .offset = mat3_mul_vec(turn, vec3_sub(vec3_add(b->position[p->surface], p->back), origin)),
                        .half = j->state->floes->thickness[p->floe] / 2,
                        .rim = p->floats || p->flush ? 0 : j->settings->edge_threshold,
                        .all = p->retreats && !p->floats};
}

static bool is_same_vec(vec3 a, vec3 b) { return a.x == b.x && a.y == b.y && a.z == b.z; }

/* The tiles of a sheet lie alike, so that a hull among many of them cuts all at the same lines. */
static bool is_same_place(const trim_place *a, const trim_place *b)
{
    bool same = a->surface == b->surface && a->half == b->half && a->rim == b->rim && a->all == b->all &&
                is_same_vec(a->offset, b->offset);
    for (int i = 0; i < 3; i++)
        same = same && is_same_vec(mat3_column(a->rotation, i), mat3_column(b->rotation, i));
    return same;
}

static bool place_hull(const fracture_job *j, const trim_place *at, const solid *hull)
{
    mesh *m = &j->scratch->trim.hull;
    if (!mesh_copy(j->ctx, m, &hull->surface))
        return false;
    for (int32_t i = 0; i < m->vertex.count; i++)
        m->vertex.data[i] = vec3_add(mat3_mul_vec(at->rotation, m->vertex.data[i]), at->offset);
    return true;
}

/* A convex ring moved inwards by `rim` [m], which may leave nothing of it. */
static bool inset_convex(const fracture_job *j, polygon p, double rim, polygon_list *out)
{
    vec2_array *from = &j->scratch->trim.ring, *to = &j->scratch->trim.clipped;
    if (!array_resize(j->ctx, from, p.count))
        return false;
    memcpy(from->data, p.vertex, (size_t)p.count * sizeof *p.vertex);
    for (int32_t k = 0; k < p.count && from->count > 0; k++) {
        vec2 e = vec2_sub(p.vertex[k + 1 < p.count ? k + 1 : 0], p.vertex[k]);
        double length = vec2_length(e);
        if (!(length > 0))
            continue;
        vec2 n = {e.y / length, -e.x / length};
        if (!polygon_clip_half_plane(j->ctx, (polygon){from->data, from->count}, n, vec2_dot(n, p.vertex[k]) - rim, to))
            return false;
        vec2_array swap = *from;
        *from = *to;
        *to = swap;
    }
    return !(from->count >= 3 && polygon_area((polygon){from->data, from->count}) > 0) ||
           polygon_list_push(j->ctx, out, (polygon){from->data, from->count});
}

/* Rings moved inwards by `rim` [m]; convex ones by their edges' lines, since those are most and cost least so. */
static fram_status inset(const fracture_job *j, const polygon_list *rings, double rim, polygon_list *out)
{
    fram_status status = FRAM_OK;
    polygon_list_clear(out);
    for (int32_t i = 0; i < polygon_list_count(rings) && status == FRAM_OK; i++) {
        polygon p = polygon_list_get(rings, i);
        if (!(polygon_area(p) > 0))
            continue;
        bool convex = polygon_is_convex(p);
        if (!convex && rim > 0)
            status = overlay_inset(j->plane, p, rim, out, j->error);
        else if (convex ? !inset_convex(j, p, rim, out) : !polygon_list_push(j->ctx, out, p))
            status = error_memory(j->error);
    }
    return status;
}

static fram_status find_sections(const fracture_job *j, const trim_place *at)
{
    trim_work *t = &j->scratch->trim;
    const solid *hull = shape_solid(j->state->shapes, j->state->bodies->shape[at->surface]);
    if (!place_hull(j, at, hull))
        return error_memory(j->error);
    polygon_list_clear(&t->top);
    polygon_list_clear(&t->bottom);
    fram_status status = mesh_section_along(j->ctx, &t->hull, &hull->adjacency, at->half, &t->top, j->error);
    return status == FRAM_OK ? mesh_section_along(j->ctx, &t->hull, &hull->adjacency, -at->half, &t->bottom, j->error)
                             : status;
}

/* All rings of both sections. */
static bool take_all(const fracture_job *j)
{
    trim_work *t = &j->scratch->trim;
    for (int k = 0; k < 2; k++) {
        const polygon_list *rings = k ? &t->bottom : &t->top;
        for (int32_t i = 0; i < polygon_list_count(rings); i++)
            if (polygon_area(polygon_list_get(rings, i)) > 0 &&
                !polygon_list_push(j->ctx, &t->gone, polygon_list_get(rings, i)))
                return false;
    }
    return true;
}

/* What both sections, less the rim, have in common. */
static fram_status take_common(const fracture_job *j, double rim)
{
    trim_work *t = &j->scratch->trim;
    fram_status status = inset(j, &t->top, rim, &t->inner);
    polygon_list swap = t->top;
    t->top = t->inner;
    t->inner = swap;
    if (status == FRAM_OK)
        status = inset(j, &t->bottom, rim, &t->inner);
    for (int32_t i = 0; i < polygon_list_count(&t->top); i++)
        for (int32_t k = 0; k < polygon_list_count(&t->inner) && status == FRAM_OK; k++)
            status = overlay_intersection(j->plane, polygon_list_get(&t->top, i), polygon_list_get(&t->inner, k),
                                          &t->gone, j->error);
    return status;
}

/* What may go of the floe, into s->trim.gone: rings of the hull's sections at its two faces. */
static fram_status find_gone(const fracture_job *j, const trim_pair *p)
{
    trim_work *t = &j->scratch->trim;
    const trim_place at = trim_place_of(j, p);
    if (is_same_place(&at, &t->place))
        return FRAM_OK;
    t->place.surface = -1;
    polygon_list_clear(&t->gone);
    fram_status status = find_sections(j, &at);
    if (status == FRAM_OK && !at.all)
        status = take_common(j, at.rim);
    else if (status == FRAM_OK && !take_all(j))
        status = error_memory(j->error);
    if (status == FRAM_OK)
        t->place = at;
    return status;
}

static bool floe_ring(const fracture_job *j, int32_t floe, vec2_array *out)
{
    const fracture_state *st = j->state;
    tile_sheet_view v = fracture_sheet_view(j);
    if (st->floes->tile[floe] != 0)
        return tile_outline(j->ctx, &v, floe, out);
    polygon p = shape_outline(st->shapes, st->bodies->shape[st->floes->body[floe]]);
    if (!array_resize(j->ctx, out, p.count))
        return false;
    memcpy(out->data, p.vertex, (size_t)p.count * sizeof *p.vertex);
    return true;
}

/* The floe's rings less one of the gone rings, in s->trim.left; s->trim.room is the spare. */
static fram_status take_off(const fracture_job *j, polygon gone)
{
    fracture_scratch *s = j->scratch;
    polygon_list_clear(&s->trim.room);
    for (int32_t i = 0; i < polygon_list_count(&s->trim.left); i++) {
        fram_status status =
            overlay_difference(j->plane, polygon_list_get(&s->trim.left, i), gone, &s->trim.room, j->error);
        if (status != FRAM_OK)
            return status;
    }
    polygon_list swap = s->trim.left;
    s->trim.left = s->trim.room;
    s->trim.room = swap;
    return FRAM_OK;
}

/* Cleaning what is left may book this part of what was cut away, or it would eat ice that no hull has touched: a short
   edge beside a long one costs half of its length, at each of a thousand cuts. */
static const double MOST_CLEANED = 0.1;

/* What is left becomes floes again, which move as before; the rest is crushed. */
static fram_status commit_trim(const fracture_job *j, int32_t floe, bool *trimmed)
{
    fracture_scratch *s = j->scratch;
    const floe_table *f = j->state->floes;
    int32_t tile = f->tile[floe];
    double line = f->material[floe].density * f->thickness[floe], area = f->area[floe];
    array_clear(&s->sheet.touched);
    polygon_list_clear(&s->piece.outlines);
    array_clear(&s->piece.rows);
    if (!array_push(j->ctx, &s->sheet.touched, floe) ||
        !fracture_gather(j->ctx, s, &s->trim.left, fracture_motion(j, floe), tile, 0))
        return error_memory(j->error);
    fracture_event event = {0};
    bool broke;
    double cut = area;
    for (int32_t i = 0; i < polygon_list_count(&s->trim.left); i++)
        cut -= polygon_area(polygon_list_get(&s->trim.left, i));
    if (tile)
        fracture_sheet_touch(j);
    fram_status status =
        fracture_birth(j, s->sheet.touched.data, 1, (birth_terms){.most = MOST_CLEANED * fmax(cut, 0)}, &event, &broke);
    if (status != FRAM_OK || !broke)
        return status;
    *trimmed = true;
    /* What cleaning takes off goes with the crushed ice.  Where it adds more than was cut away nothing was crushed. */
    double less = area - event.piece_area, *kept = less >= 0 ? j->state->crushed : j->state->gained;
    if (kept)
        *kept += line * fabs(less);
    return tile ? fracture_sheet_changed(j) : FRAM_OK;
}

/* Area of the ring that may go. */
static fram_status find_overlap(const fracture_job *j, const trim_pair *p, polygon ring, double *overlap)
{
    const trim_work *t = &j->scratch->trim;
    fram_status status = find_gone(j, p);
    *overlap = 0;
    for (int32_t i = 0; i < polygon_list_count(&t->gone) && status == FRAM_OK; i++)
        *overlap += polygon_overlap_area(ring, polygon_list_get(&t->gone, i));
    return status;
}

/* A hull that has come nearly through a tile leaves no rim behind: without ice before the hull that would carry
   nothing, lie inside of it and come loose there.  Nearly: less ice is left before it than in the rim. */
static fram_status leave_no_rim(const fracture_job *j, trim_pair *p, polygon ring, double *overlap)
{
    box2 box = polygon_bounds(ring);
    double rim = 2 * j->settings->edge_threshold * (box.hi.x - box.lo.x + box.hi.y - box.lo.y), whole;
    double left = polygon_area(ring) - *overlap;
    if (p->floats || p->retreats || left > 2 * rim)
        return FRAM_OK;
    p->flush = true;
    fram_status status = find_overlap(j, p, ring, &whole);
    p->flush = polygon_area(ring) - whole < whole - *overlap;
    if (status != FRAM_OK)
        return status;
    if (p->flush)
        *overlap = whole;
    return p->flush ? FRAM_OK : find_gone(j, p);
}

static fram_status trim_floe(const fracture_job *j, trim_pair *p, bool *trimmed)
{
    fracture_scratch *s = j->scratch;
    if (!floe_ring(j, p->floe, &s->trim.outline))
        return error_memory(j->error);
    polygon ring = {s->trim.outline.data, s->trim.outline.count};
    double overlap, least = j->settings->smallest_floe_area;
    fram_status status = find_overlap(j, p, ring, &overlap);
    if (status == FRAM_OK)
        status = leave_no_rim(j, p, ring, &overlap);
    if (status != FRAM_OK)
        return status;
    /* Less than a floe is not worth a cut, unless little else is left; the next one takes it. */
    if (p->flush)
        least = fmin(least, polygon_area(ring) / 2);
    if (!(overlap > (p->retreats && !p->floats ? 0 : least)))
        return FRAM_OK;
    polygon_list_clear(&s->trim.left);
    if (!polygon_list_push(j->ctx, &s->trim.left, ring))
        return error_memory(j->error);
    for (int32_t i = 0; i < polygon_list_count(&s->trim.gone) && status == FRAM_OK; i++)
        status = take_off(j, polygon_list_get(&s->trim.gone, i));
    return status == FRAM_OK ? commit_trim(j, p->floe, trimmed) : status;
}

static bool floats(const fracture_job *j, const crushing_patch *p)
{
    return j->state->bodies->motion[p->floe_body] == MOTION_DYNAMIC;
}

/* Whether a patch is on a side of its floe, not on its top or bottom. */
static bool is_steep(const fracture_job *j, const crushing_patch *p)
{
    vec3 up = mat3_column(quat_matrix(j->state->bodies->orientation[p->floe_body]), 2);
    return fabs(vec3_dot(up, p->normal)) < STEEP_SIDE;
}

/* Ice under a hull, not broken in this step. */
static bool may_trim(const fracture_job *j, const crushing_patch *p)
{
    const fracture_state *s = j->state;
    bool held = body_is_held(s->bodies, p->floe_body);
    bool goes = held ? j->settings->crush_trims : j->settings->crush_notches && floats(j, p) && is_steep(j, p);
    return goes && s->bodies->material[p->surface_body] == MATERIAL_HULL &&
           s->shapes->shapes.kind[s->bodies->shape[p->surface_body]] == SHAPE_SOLID &&
           !j->scratch->broken.data[p->floe_body];
}

/* Whether a patch presses on: held ice by what it carries, so that the way of a hull that heaves adds up. */
static bool presses(const fracture_job *j, const crushing_patch *p, vec3 past)
{
    const fracture_settings *f = j->settings;
    if (f->edges_give && f->edge_gaps && !floats(j, p) && j->state->floes->breakable[p->floe])
        return edge_gap_pressed(p, j->state->contacts) > 0;
    return vec3_dot(past, p->normal) >= 0;
}

/* The way that the hull has gone in the floe since it last pressed on; the first patch of the two in a step counts.
   false: no memory. */
static bool find_pair(const fracture_job *j, const crushing_patch *p, bool first, trim_pair *pair)
{
    const fracture_state *s = j->state;
    vec3 v = body_velocity_past(s->bodies, p->surface_body, p->floe_body, p->centre);
    vec3 way = retreat_find(s->retreats, s->bodies, s->floes, p->floe, p->surface_body);
    if (presses(j, p, v))
        way = (vec3){0, 0, 0};
    else if (first)
        way = vec3_mad(way, v, j->settings->time_step);
    bool left = -vec3_dot(way, p->normal) > j->settings->edge_threshold;
    *pair = (trim_pair){.floe = p->floe,
                        .surface = p->surface_body,
                        .floats = floats(j, p),
                        .retreats = left,
                        .back = left ? vec3_neg(way) : (vec3){0, 0, 0}};
    return retreat_keep(j->ctx, s->retreats, s->bodies, s->floes, p->floe, p->surface_body, way);
}

fram_status fracture_trim(const fracture_job *j, const crushing_patch_array *patches, bool *trimmed)
{
    fram_status status = retreat_sweep(j->ctx, j->state->retreats, j->state->floes) ? FRAM_OK : error_memory(j->error);
    int32_t last = -1, last_surface = -1;
    j->scratch->trim.place.surface = -1;
    for (int32_t i = 0; i < patches->count && status == FRAM_OK; i++) {
        const crushing_patch *p = &patches->data[i];
        if (!may_trim(j, p))
            continue;
        trim_pair pair;
        if (!find_pair(j, p, p->floe != last || p->surface_body != last_surface, &pair))
            return error_memory(j->error);
        last = p->floe;
        last_surface = p->surface_body;
        status = pair.floats && !pair.retreats ? FRAM_OK : trim_floe(j, &pair, trimmed);
        /* No sound cut: the ice stays as it is for this step. */
        if (status == FRAM_ERROR_INTERNAL || status == FRAM_ERROR_INPUT) {
            log_write(j->ctx, LOG_DEBUG, "crushed ice could not be cut away: %s", j->error ? j->error->message : "");
            status = FRAM_OK;
        }
    }
    return status;
}
