/* The order of fracture: which floes break, by which patch, in which way; see fracture.h. */
#include "ice/fracture_parts.h"

#include "geometry/predicate.h"

#include <string.h>

fracture_scratch *fracture_scratch_create(context *ctx) { return memory_array(ctx, 1, sizeof(fracture_scratch)); }

void fracture_scratch_forget(fracture_scratch *s) { s->sheet.all_held = false; }

static void free_floe(context *ctx, floe_work *f)
{
    array_free(ctx, &f->outline);
    polygon_list_free(ctx, &f->whole);
    polygon_list_free(ctx, &f->wedges);
    array_free(ctx, &f->bends);
    polygon_list_free(ctx, &f->remnants);
    polygon_list_free(ctx, &f->pieces);
    polygon_list_free(ctx, &f->room);
}

static void free_sheet(context *ctx, sheet_work *w)
{
    tile_index_free(ctx, &w->index);
    array_free(ctx, &w->boundary);
    array_free(ctx, &w->starts);
    array_free(ctx, &w->touched);
    array_free(ctx, &w->mark);
    array_free(ctx, &w->front);
    array_free(ctx, &w->parts);
    array_free(ctx, &w->open);
    array_free(ctx, &w->part);
    array_free(ctx, &w->behind);
    array_free(ctx, &w->reached);
    array_free(ctx, &w->cut_off);
    array_free(ctx, &w->ring);
    array_free(ctx, &w->snapped_ring);
    polygon_list_free(ctx, &w->remnants);
    polygon_list_free(ctx, &w->wedge_parts);
    polygon_list_free(ctx, &w->snapped);
    polygon_list_free(ctx, &w->loose);
    polygon_list_free(ctx, &w->united);
}

static void free_trim(context *ctx, trim_work *w)
{
    mesh_free(ctx, &w->hull);
    polygon_list_free(ctx, &w->top);
    polygon_list_free(ctx, &w->bottom);
    polygon_list_free(ctx, &w->inner);
    polygon_list_free(ctx, &w->gone);
    polygon_list_free(ctx, &w->left);
    polygon_list_free(ctx, &w->room);
    array_free(ctx, &w->ring);
    array_free(ctx, &w->clipped);
    array_free(ctx, &w->outline);
}

void fracture_scratch_free(context *ctx, fracture_scratch *s)
{
    if (!s)
        return;
    free_floe(ctx, &s->floe);
    free_sheet(ctx, &s->sheet);
    free_trim(ctx, &s->trim);
    array_free(ctx, &s->load.all);
    array_free(ctx, &s->load.root);
    array_free(ctx, &s->load.pairs);
    array_free(ctx, &s->load.felt);
    array_free(ctx, &s->load.parts);
    array_free(ctx, &s->load.edges);
    array_free(ctx, &s->load.rises);
    array_free(ctx, &s->load.joint);
    array_free(ctx, &s->load.beside);
    array_free(ctx, &s->load.line);
    array_free(ctx, &s->load.arcs);
    array_free(ctx, &s->piece.rows);
    polygon_list_free(ctx, &s->piece.outlines);
    polygon_list_free(ctx, &s->piece.pair);
    polygon_list_free(ctx, &s->piece.joined);
    array_free(ctx, &s->piece.welded);
    polygon_list_free(ctx, &s->piece.parts);
    array_free(ctx, &s->piece.clean);
    array_free(ctx, &s->broken);
    array_free(ctx, &s->forgotten);
    memory_free(ctx, s);
}

/* The failing loads of one floe. */
typedef struct floe_loads {
    const fracture_load *load;
    int32_t count;
} floe_loads;

static crack_start start_of(polygon p, const fracture_load *l)
{
    return crack_start_of(p, l->place, CRACK_CORNER_REACH * l->stress.breaking_radius);
}

fracture_event fracture_event_of(const fracture_load *l, vec3 place, fracture_kind kind, double length)
{
    bool split = kind == FRACTURE_SPLIT, plane = split && l->split_ratio > 0;
    return (fracture_event){
        .kind = (int32_t)kind,
        .place = place,
        .load = plane ? l->plane_force : l->force,
        .crack_length = length,
        .stress_ratio = plane   ? l->split_ratio
                        : split ? l->radial_ratio
                                : l->wedge_ratio,
        .loaded_radius = split ? l->stress.radial_radius : l->stress.wedge_radius,
    };
}

static fracture_event event_of(const fracture_job *j, const fracture_load *l, const crack_start *start,
                               fracture_kind kind, double length)
{
    vec3 place = body_to_global(j->state->bodies, l->body, (vec3){start->point.x, start->point.y, 0});
    return fracture_event_of(l, place, kind, length);
}

/* bends: one per wedge, or NULL where there are none. */
static fram_status commit(const fracture_job *j, const fracture_load *l, const edge_bend *bends, fracture_event *event)
{
    fracture_scratch *s = j->scratch;
    bool broke;
    polygon_list_clear(&s->piece.outlines);
    array_clear(&s->piece.rows);
    if (!fracture_gather(j->ctx, s, &s->floe.whole, fracture_motion(j, l->floe), 0, 0) ||
        !fracture_gather(j->ctx, s, &s->floe.wedges, MOTION_DYNAMIC, 0, 1))
        return error_memory(j->error);
    for (int32_t i = 0, wedges = polygon_list_count(&s->floe.wedges); i < wedges; i++)
        s->piece.rows.data[s->piece.rows.count - wedges + i].bend = i;
    fram_status status =
        fracture_birth(j, &l->floe, 1, (birth_terms){.least = 2, .most = HUGE_VAL, .bends = bends}, event, &broke);
    if (status != FRAM_OK || !broke)
        return status;
    return array_push(j->ctx, j->events, *event) ? FRAM_OK : error_memory(j->error);
}

/* ---- splitting ---- */

/* The first valid split, by falling stress over strength; *done says whether there was one. */
static fram_status split_floe(const fracture_job *j, polygon outline, floe_loads loads, bool *done)
{
    fracture_scratch *s = j->scratch;
    for (int32_t i = 0; i < loads.count; i++) {
        const fracture_load *l = &loads.load[i];
        crack_start start = start_of(outline, l);
        double length;
        bool memory = false;
        if (!fracture_splits(j->settings, outline, l, j->state->floes->thickness[l->floe], &start, &length))
            continue;
        polygon_list_clear(&s->floe.whole);
        polygon_list_clear(&s->floe.wedges);
        if (fracture_split(j->ctx, j->settings, outline, &start, &s->floe.whole, &memory)) {
            fracture_event event = event_of(j, l, &start, FRACTURE_SPLIT, length);
            *done = true;
            return commit(j, l, NULL, &event);
        }
        if (memory)
            return error_memory(j->error);
    }
    return FRAM_OK;
}

/* ---- bending ---- */

/* The ring that still has the crack's start on its boundary, -1 when that is gone. */
static int32_t ring_with_start(const polygon_list *rings, const fracture_load *l, const crack_start *start)
{
    for (int32_t i = 0; i < polygon_list_count(rings); i++) {
        vec2 near = polygon_nearest_boundary(polygon_list_get(rings, i), start->point, NULL);
        if (vec2_length(vec2_sub(near, start->point)) <= CRACK_GONE_REACH * l->stress.breaking_radius)
            return i;
    }
    return -1;
}

/* Whether a wedge has room to develop (option). */
static bool has_room(const fracture_job *j, polygon ring, const fracture_load *l, const crack_start *start)
{
    int32_t edge;
    return !j->settings->wedge_room || crack_length(ring, start, &edge) > l->stress.breaking_radius;
}

/* rings with ring `at` replaced by `others`. */
static bool replace_ring(context *ctx, polygon_list *rings, int32_t at, const polygon_list *others, polygon_list *room)
{
    polygon_list_clear(room);
    bool good = true;
    for (int32_t i = 0; i < polygon_list_count(rings) && good; i++)
        if (i != at)
            good = polygon_list_push(ctx, room, polygon_list_get(rings, i));
    for (int32_t i = 0; i < polygon_list_count(others) && good; i++)
        good = polygon_list_push(ctx, room, polygon_list_get(others, i));
    polygon_list moved = *rings;
    *rings = *room;
    *room = moved;
    return good;
}

/* One stencil on what is left of the floe; *cut says whether it took something off. */
static fram_status cut_stencil(const fracture_job *j, const fracture_load *l, crack_start *start, bool *cut)
{
    fracture_scratch *s = j->scratch;
    *cut = false;
    int32_t at = ring_with_start(&s->floe.whole, l, start);
    if (at < 0)
        return FRAM_OK;
    polygon ring = polygon_list_get(&s->floe.whole, at);
    *start = crack_start_of(ring, start->point, CRACK_CORNER_REACH * l->stress.breaking_radius);
    if (!has_room(j, ring, l, start))
        return FRAM_OK;
    polygon_list_clear(&s->floe.remnants);
    polygon_list_clear(&s->floe.pieces);
    break_size size = fracture_break_size(j->settings, l);
    break_shape shape;
    fracture_shape(j->settings->wedges, start, &size, &shape);
    fram_status status = fracture_bend(j->ctx, j->plane, &shape, ring, &s->floe.remnants, &s->floe.pieces, j->error);
    /* No sound cut of this outline: it stays whole, and the next step tries again. */
    if (status == FRAM_ERROR_INTERNAL || status == FRAM_ERROR_INPUT) {
        log_write(j->ctx, LOG_DEBUG, "a floe could not be cut in bending: %s", j->error ? j->error->message : "");
        return FRAM_OK;
    }
    if (status != FRAM_OK || polygon_list_count(&s->floe.pieces) == 0)
        return status;
    *cut = true;
    for (int32_t i = 0; i < polygon_list_count(&s->floe.pieces); i++)
        if (!polygon_list_push(j->ctx, &s->floe.wedges, polygon_list_get(&s->floe.pieces, i)))
            return error_memory(j->error);
    return replace_ring(j->ctx, &s->floe.whole, at, &s->floe.remnants, &s->floe.room) ? FRAM_OK
                                                                                      : error_memory(j->error);
}

/* The wedges that a load has cut come off as the edge stood under that load, not under the first. */
static bool note_bends(const fracture_job *j, const fracture_load *l, const crack_start *start)
{
    floe_work *f = &j->scratch->floe;
    edge_bend bend = fracture_bend_of(j, l, start);
    while (f->bends.count < polygon_list_count(&f->wedges))
        if (!array_push(j->ctx, &f->bends, bend))
            return false;
    return true;
}

/* All failing patches cut in turn; the event tells of the first that did. */
static fram_status bend_floe(const fracture_job *j, polygon outline, floe_loads loads)
{
    fracture_scratch *s = j->scratch;
    polygon_list_clear(&s->floe.whole);
    polygon_list_clear(&s->floe.wedges);
    array_clear(&s->floe.bends);
    if (!polygon_list_push(j->ctx, &s->floe.whole, outline))
        return error_memory(j->error);
    const fracture_load *first = NULL;
    fracture_event event;
    for (int32_t i = 0; i < loads.count; i++) {
        const fracture_load *l = &loads.load[i];
        if (l->wedge_ratio < 1)
            continue;
        /* Where the floe as it was has its boundary; gone when an earlier stencil took that. */
        crack_start start = start_of(outline, l);
        bool cut;
        fram_status status = cut_stencil(j, l, &start, &cut);
        if (status != FRAM_OK)
            return status;
        if (cut && !note_bends(j, l, &start))
            return error_memory(j->error);
        if (!cut || first)
            continue;
        first = l;
        event = event_of(j, l, &start, FRACTURE_BENDING, l->stress.breaking_radius);
    }
    return first ? commit(j, first, s->floe.bends.data, &event) : FRAM_OK;
}

/* ---- contacts of broken floes ---- */

/* A child may stand in its parent's slot: what contacts of the parent carried must not reach it. */
static bool void_contacts(const fracture_job *j)
{
    fracture_scratch *s = j->scratch;
    contact_memory_table *memory = j->state->memory;
    if (!array_resize(j->ctx, &s->forgotten, memory->count))
        return false;
    if (memory->count > 0)
        memset(s->forgotten.data, 0, (size_t)memory->count);
    for (int32_t i = 0, place = 0; i < j->state->contacts->count; i++) {
        contact *c = &j->state->contacts->data[i];
        if (!s->broken.data[c->a] && !s->broken.data[c->b])
            continue;
        c->correct = false;
        int32_t row = contact_memory_find(memory, c->key, &place);
        if (row >= 0)
            s->forgotten.data[row] = 1;
    }
    int32_t kept = 0;
    for (int32_t i = 0; i < memory->count; i++) {
        if (s->forgotten.data[i])
            continue;
        if (kept != i)
            table_move_row(memory, &contact_memory_table_info, kept, i);
        kept++;
    }
    return table_resize(j->ctx, memory, &contact_memory_table_info, kept);
}

/* ---- all floes ---- */

static fram_status break_floe(const fracture_job *j, floe_loads loads)
{
    fracture_scratch *s = j->scratch;
    polygon view = shape_outline(j->state->shapes, j->state->bodies->shape[loads.load[0].body]);
    /* A copy: new shapes move the pool that the outline stands in. */
    if (!array_resize(j->ctx, &s->floe.outline, view.count))
        return error_memory(j->error);
    memcpy(s->floe.outline.data, view.vertex, (size_t)view.count * sizeof *view.vertex);
    polygon outline = {s->floe.outline.data, s->floe.outline.count};
    bool split = false;
    fram_status status = split_floe(j, outline, loads, &split);
    return status != FRAM_OK || split ? status : bend_floe(j, outline, loads);
}

static fram_status break_all(const fracture_job *j)
{
    const fracture_load_array *loads = &j->scratch->load.all;
    fram_status status = FRAM_OK;
    for (int32_t i = 0, end; i < loads->count && status == FRAM_OK; i = end) {
        const fracture_load *l = &loads->data[i];
        if (l->tile) {
            end = loads->count;
            status = fracture_break_sheet(j, l, end - i);
            continue;
        }
        for (end = i + 1; end < loads->count && !loads->data[end].tile && loads->data[end].body == l->body; end++)
            continue;
        status = break_floe(j, (floe_loads){l, end - i});
    }
    return status;
}

/* What a floe that fracture made is refused for is no fault of the scenario. */
static fram_status own_fault(fram_status status, fram_error *error)
{
    if (status != FRAM_ERROR_INPUT)
        return status;
    fram_error found = error ? *error : (fram_error){0};
    return error_set(error, FRAM_ERROR_INTERNAL, NULL, 0, "fracture", "%s", found.message);
}

fram_status fracture_run(context *ctx, fracture_scratch *scratch, const fracture_settings *settings, overlay *plane,
                         const crushing_patch_array *patches, const fracture_state *state, fracture_event_array *events,
                         fram_error *error)
{
    fracture_job j = {ctx, scratch, settings, plane, state, events, error};
    scratch->sheet.index_is_made = scratch->sheet.has_changed = false;
    fram_status status = fracture_loads(&j, patches);
    if (status != FRAM_OK)
        return own_fault(status, error);
    bool trims = (settings->crush_trims || settings->crush_notches) && patches->count > 0, trimmed = false;
    if (scratch->load.all.count == 0 && !trims)
        return FRAM_OK;
    int32_t slots = state->bodies->count, had = events->count;
    if (!array_resize(ctx, &scratch->broken, slots))
        return error_memory(error);
    memset(scratch->broken.data, 0, (size_t)slots);
    scratch->sheet.index_is_made = false; /* floes of their own may break first */
    status = break_all(&j);
    fracture_renew_supports(&j);
    if (status == FRAM_OK && trims)
        status = fracture_trim(&j, patches, &trimmed);
    if (status == FRAM_OK && scratch->sheet.has_changed)
        status = fracture_release(&j);
    if (status != FRAM_OK) {
        fracture_scratch_forget(scratch);
        return own_fault(status, error);
    }
    return (events->count == had && !trimmed) || void_contacts(&j) ? FRAM_OK : error_memory(error);
}
