#include "ice/field_measure.h"
#include "ice/import_frame.h"
#include "ice/import_parts.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Beyond this a micrometre is lost in the rounding of a coordinate [m]. */
#define COORDINATE_MOST 1e9

void import_rings_free(context *ctx, import_rings *r)
{
    polygon_list_free(ctx, &r->rings);
    array_free(ctx, &r->place);
}

void import_field_free(context *ctx, import_field *f)
{
    polygon_list_free(ctx, &f->outlines);
    array_free(ctx, &f->ring);
    array_free(ctx, &f->thickness);
    array_free(ctx, &f->notes);
}

void import_place_name(const import_place *p, char out[IMPORT_NAME_SIZE])
{
    snprintf(out, IMPORT_NAME_SIZE, "feature %d, polygon %d, ring %d", (int)p->feature, (int)p->polygon, (int)p->ring);
}

const char *import_event_text(import_event event, bool window)
{
    static const char *const text[IMPORT_EVENT_COUNT] = {
        [IMPORT_NOTE_OPEN] = "is not closed: its last position is not its first one",
        [IMPORT_NOTE_FEW] = "has fewer than 3 different vertices",
        [IMPORT_NOTE_FLAT] = "has no area",
        [IMPORT_NOTE_CROSSED] = "crosses or touches itself",
        [IMPORT_NOTE_HOLE] = "is a hole",
        [IMPORT_NOTE_SMALL] = "is under the smallest area",
        [IMPORT_NOTE_OUTSIDE] = "is outside the domain",
        [IMPORT_NOTE_KEPT_OUT] = "is in the way of a vessel or of open water",
        [IMPORT_NOTE_OVERLAP] = "overlaps a smaller floe",
        [IMPORT_NOTE_SLIVER] = "is a sliver beside the smaller floe that was cut out of it",
    };
    return window && event == IMPORT_NOTE_OUTSIDE ? "is outside the window" : text[event];
}

/* One import. */
typedef struct importing {
    context *ctx;
    overlay *plane;
    const import_rings *rings;
    const import_options *options;
    import_frame frame;
    import_field *out;
    fram_error *error;
    bool crops;        /* at the edge of the domain */
    int32_t ring;      /* at work */
    vec2_array vertex; /* of it, in place */
    polygon_list pieces, cut;
} importing;

/* ---- notes and refusals ---- */

static fram_status add_note(importing *m, import_event event, bool dropped, vec2 at)
{
    const import_note note = {m->ring, event, dropped, at};
    return array_push(m->ctx, &m->out->notes, note) ? FRAM_OK : error_memory(m->error);
}

static fram_status refuse(const importing *m, const char *what, vec2 at)
{
    char key[IMPORT_NAME_SIZE];
    const import_place *place = &m->rings->place.data[m->ring];
    import_place_name(place, key);
    error_set(m->error, FRAM_ERROR_INPUT, m->options->name, (int)place->line, key, "the ring %s, at (%.9g, %.9g) m",
              what, at.x, at.y);
    if (m->error)
        m->error->column = (int)place->column;
    return FRAM_ERROR_INPUT;
}

static const char *event_text(const importing *m, import_event event)
{
    return import_event_text(event, m->options->window);
}

/* A fault of a ring: refused, or noted as dropped or mended. */
static fram_status note_fault(importing *m, import_event event, bool can_mend, vec2 at, bool *mended)
{
    import_bad bad = m->options->bad;
    *mended = can_mend && bad == IMPORT_REPAIR;
    if (bad != IMPORT_REFUSE)
        return add_note(m, event, !*mended, at);
    char what[200];
    /* A repair fills holes, also those that islands are in open water. */
    if (m->options->as_it_is && event == IMPORT_NOTE_HOLE)
        snprintf(what, sizeof what, "%s; cut its polygon in two that have none, for a repair would fill it",
                 event_text(m, event));
    else if (m->options->as_it_is)
        snprintf(what, sizeof what, "%s; mend the file, as \"fram field\" can", event_text(m, event));
    else
        snprintf(what, sizeof what, "%s; bad rings can be dropped%s", event_text(m, event),
                 can_mend ? " or repaired" : "");
    return refuse(m, what, at);
}

/* ---- one ring ---- */

/* The ring in metres where it belongs, without repeated vertices in a row. */
static fram_status place_ring(importing *m, polygon p)
{
    array_clear(&m->vertex);
    for (int32_t k = 0; k < p.count; k++) {
        vec2 v = import_frame_place(&m->frame, p.vertex[k]);
        if (!(fabs(v.x) <= COORDINATE_MOST && fabs(v.y) <= COORDINATE_MOST))
            return refuse(m, "reaches farther than 1e9 m from the origin", v);
        vec2 *last = m->vertex.count > 0 ? &m->vertex.data[m->vertex.count - 1] : NULL;
        if (last && last->x == v.x && last->y == v.y)
            continue;
        if (!array_push(m->ctx, &m->vertex, v))
            return error_memory(m->error);
    }
    vec2 *v = m->vertex.data;
    int32_t *count = &m->vertex.count;
    while (*count > 1 && v[0].x == v[*count - 1].x && v[0].y == v[*count - 1].y)
        (*count)--;
    return FRAM_OK;
}

static fram_status is_flat(const importing *m, polygon p, bool *flat)
{
    vec2_array hull = {0};
    bool good = polygon_convex_hull(m->ctx, p, &hull);
    *flat = hull.count < 3;
    array_free(m->ctx, &hull);
    return good ? FRAM_OK : error_memory(m->error);
}

static void reverse(vec2 *v, int32_t count)
{
    for (int32_t i = 0, k = count - 1; i < k; i++, k--) {
        vec2 keep = v[i];
        v[i] = v[k];
        v[k] = keep;
    }
}

/* The outlines of all that a ring winds round that meets itself, as at a place. */
static fram_status mend_crossed(importing *m, polygon p, vec2 at)
{
    import_meetings met;
    bool cut = false;
    fram_status status = import_count_meetings(m->ctx, p, &met, m->error);
    if (status == FRAM_OK && met.elsewhere == 0)
        status = import_cut_at_corners(m->ctx, p, &m->pieces, &cut, m->error);
    if (status != FRAM_OK || cut)
        return status;
    if (import_meets_too_often(p, &met))
        return refuse(
            m, "crosses or touches itself too often to be repaired; simplify it before, or have bad rings dropped", at);
    return overlay_make_valid(m->plane, p, &m->pieces, m->error);
}

/* The sound outlines of the ring at work, in m->pieces; none when it is left out. */
static fram_status sound_pieces(importing *m)
{
    const import_place *place = &m->rings->place.data[m->ring];
    polygon p = {m->vertex.data, m->vertex.count};
    vec2 at = p.count > 0 ? p.vertex[0] : vec2_make(0, 0);
    bool mended = true, flat = false;
    fram_status status = place->open && p.count >= 3 ? note_fault(m, IMPORT_NOTE_OPEN, true, at, &mended) : FRAM_OK;
    if (status != FRAM_OK || !mended)
        return status;
    if (p.count < 3)
        return note_fault(m, IMPORT_NOTE_FEW, false, at, &mended);
    status = is_flat(m, p, &flat);
    if (status != FRAM_OK || flat)
        return status == FRAM_OK ? note_fault(m, IMPORT_NOTE_FLAT, false, at, &mended) : status;
    if (!polygon_self_intersects(m->ctx, p, NULL, NULL)) {
        if (polygon_orientation(p) < 0)
            reverse(m->vertex.data, m->vertex.count);
        return polygon_list_push(m->ctx, &m->pieces, p) ? FRAM_OK : error_memory(m->error);
    }
    char reason[OVERLAY_REASON_SIZE];
    overlay_is_valid(m->plane, p, reason, &at);
    status = note_fault(m, IMPORT_NOTE_CROSSED, true, at, &mended);
    return status == FRAM_OK && mended ? mend_crossed(m, p, at) : status;
}

/* ---- pieces of a ring ---- */

static bool boxes_meet(box2 a, box2 b, double margin)
{
    return a.lo.x - margin <= b.hi.x && b.lo.x - margin <= a.hi.x && a.lo.y - margin <= b.hi.y &&
           b.lo.y - margin <= a.hi.y;
}

static bool box_holds(box2 outer, box2 inner)
{
    return outer.lo.x <= inner.lo.x && outer.lo.y <= inner.lo.y && inner.hi.x <= outer.hi.x && inner.hi.y <= outer.hi.y;
}

/* A vertex of p is nearer than `margin` to the boundary of q. */
static bool vertex_near(polygon p, polygon q, double margin)
{
    for (int32_t i = 0; i < p.count; i++) {
        vec2 gap = vec2_sub(p.vertex[i], polygon_nearest_boundary(q, p.vertex[i], NULL));
        if (vec2_dot(gap, gap) < margin * margin)
            return true;
    }
    return false;
}

static bool is_kept_out(const import_options *o, polygon p)
{
    box2 box = polygon_bounds(p);
    for (int32_t i = 0; o->keep_out && i < polygon_list_count(o->keep_out); i++) {
        polygon zone = polygon_list_get(o->keep_out, i);
        if (zone.count < 3 || !boxes_meet(box, polygon_bounds(zone), o->keep_out_margin))
            continue;
        if (field_common_area(p, zone) > 0 || vertex_near(p, zone, o->keep_out_margin) ||
            vertex_near(zone, p, o->keep_out_margin))
            return true;
    }
    return false;
}

/* An outline in its place, if it may stay. */
static fram_status add_floe(importing *m, polygon p)
{
    if (polygon_area(p) < m->options->smallest_area)
        return add_note(m, IMPORT_NOTE_SMALL, true, p.vertex[0]);
    if (is_kept_out(m->options, p))
        return add_note(m, IMPORT_NOTE_KEPT_OUT, true, p.vertex[0]);
    double thickness = m->rings->place.data[m->ring].thickness;
    if (!polygon_list_push(m->ctx, &m->out->outlines, p) || !array_push(m->ctx, &m->out->ring, m->ring) ||
        !array_push(m->ctx, &m->out->thickness, thickness))
        return error_memory(m->error);
    return FRAM_OK;
}

/* Cut at the edge of the domain; what is left is in m->cut. */
static fram_status crop(importing *m, polygon p)
{
    box2 domain = m->options->domain, box = polygon_bounds(p);
    polygon_list_clear(&m->cut);
    if (!m->crops || box_holds(domain, box))
        return polygon_list_push(m->ctx, &m->cut, p) ? FRAM_OK : error_memory(m->error);
    const vec2 corner[4] = {domain.lo, {domain.hi.x, domain.lo.y}, domain.hi, {domain.lo.x, domain.hi.y}};
    fram_status status = FRAM_OK;
    if (boxes_meet(box, domain, 0))
        status = overlay_intersection(m->plane, p, (polygon){corner, 4}, &m->cut, m->error);
    if (status == FRAM_OK && polygon_list_count(&m->cut) == 0)
        status = add_note(m, IMPORT_NOTE_OUTSIDE, true, p.vertex[0]);
    return status;
}

static fram_status add_piece(importing *m, polygon p)
{
    vec2_array simple = {0};
    fram_status status = FRAM_OK;
    if (m->options->simplify > 0) {
        status = overlay_simplify(m->plane, p, m->options->simplify, &simple, m->error);
        p = (polygon){simple.data, simple.count};
    }
    if (status == FRAM_OK)
        status = crop(m, p);
    for (int32_t i = 0; status == FRAM_OK && i < polygon_list_count(&m->cut); i++)
        status = add_floe(m, polygon_list_get(&m->cut, i));
    array_free(m->ctx, &simple);
    return status;
}

static fram_status import_ring(importing *m)
{
    bool mended;
    polygon_list_clear(&m->pieces);
    fram_status status = place_ring(m, polygon_list_get(&m->rings->rings, m->ring));
    if (status == FRAM_OK && m->rings->place.data[m->ring].ring > 1) {
        /* The water inside a floe is left out: no mended ring comes of a hole, and nothing is lost but the hole. */
        return note_fault(m, IMPORT_NOTE_HOLE, true, m->vertex.count ? m->vertex.data[0] : vec2_make(0, 0), &mended);
    }
    if (status == FRAM_OK)
        status = sound_pieces(m);
    for (int32_t i = 0; status == FRAM_OK && i < polygon_list_count(&m->pieces); i++)
        status = add_piece(m, polygon_list_get(&m->pieces, i));
    return status;
}

/* ---- all rings ---- */

typedef struct import_loss {
    import_event event;
    int32_t count, outside; /* rings and pieces: of the event, and of those outside that it is told in place of */
} import_loss;

static import_event commonest_event(const int32_t count[IMPORT_EVENT_COUNT])
{
    import_event event = IMPORT_NOTE_FLAT;
    for (int e = 0; e < IMPORT_EVENT_COUNT; e++)
        if (count[e] > count[event])
            event = (import_event)e;
    return event;
}

/* What most rings and pieces were left out for, and how many: 0 where all were mended to nothing.  A hole is never why
   no floe is left, and what lies outside is not by itself where ice in the domain was in the way of something. */
static import_loss commonest_loss(const import_field *field)
{
    int32_t count[IMPORT_EVENT_COUNT] = {0}, outside = 0;
    for (int32_t i = 0; i < field->notes.count; i++)
        count[field->notes.data[i].event] += field->notes.data[i].dropped;
    count[IMPORT_NOTE_HOLE] = 0;
    import_event event = commonest_event(count);
    if (event == IMPORT_NOTE_OUTSIDE && count[IMPORT_NOTE_KEPT_OUT] > 0) {
        outside = count[IMPORT_NOTE_OUTSIDE];
        count[IMPORT_NOTE_OUTSIDE] = 0;
        event = commonest_event(count);
    }
    return (import_loss){event, count[event], outside};
}

static fram_status refuse_without_rings(const importing *m)
{
    const char *name = m->options->name;
    if (m->rings->passed_over == 0)
        return error_set(m->error, FRAM_ERROR_INPUT, name, 0, NULL, "the file has no floes");
    return error_set(m->error, FRAM_ERROR_INPUT, name, 0, NULL,
                     "the file has no floes; %d feature%s of kind vessel or wall %s passed over",
                     (int)m->rings->passed_over, m->rings->passed_over == 1 ? "" : "s",
                     m->rings->passed_over == 1 ? "was" : "were");
}

/* Room for what is told of the rings outside. */
#define OUTSIDE_TEXT 128
/* What says where floes and domain lie, in a scenario. */
#define PLACE_KEYS "ice.file_scale, ice.file_x, ice.file_y and domain"

/* What to look at where all of a file was left out for one reason; "" where its words say all. */
static const char *remedy_of(const importing *m, import_event event)
{
    if (event == IMPORT_NOTE_OUTSIDE)
        return m->options->window ? "; look at scale, offset and crop" : "; look at " PLACE_KEYS;
    return event == IMPORT_NOTE_KEPT_OUT ? "; look at where these lie, and at ice.keep_out_margin" : "";
}

static fram_status refuse_empty(const importing *m)
{
    const char *name = m->options->name;
    int rings = (int)m->rings->place.count;
    import_loss loss = commonest_loss(m->out);
    char others[OUTSIDE_TEXT] = "";
    if (rings == 0)
        return refuse_without_rings(m);
    if (loss.outside > 0)
        snprintf(others, sizeof others, "; %d lie outside the domain: look at " PLACE_KEYS, (int)loss.outside);
    if (loss.count == 0)
        return error_set(m->error, FRAM_ERROR_INPUT, name, 0, NULL,
                         "no floe is left of %d rings: none winds round an area", rings);
    return error_set(m->error, FRAM_ERROR_INPUT, name, 0, NULL,
                     "no floe is left of %d rings: %d of them or of their pieces were left out because each %s%s%s",
                     rings, (int)loss.count, event_text(m, loss.event), remedy_of(m, loss.event), others);
}

static fram_status import_all(importing *m, bool crops)
{
    fram_status status = FRAM_OK;
    int32_t count = m->rings->place.count;
    m->crops = crops;
    for (m->ring = 0; status == FRAM_OK && m->ring < count; m->ring++) {
        status = work_continue(m->ctx, "looking at the outlines", m->ring, count, m->error);
        if (status == FRAM_OK)
            status = import_ring(m);
    }
    return status;
}

fram_status import_field_make(context *ctx, overlay *o, const import_rings *rings, const import_options *options,
                              import_field *out, fram_error *error)
{
    importing m = {.ctx = ctx, .plane = o, .rings = rings, .options = options, .out = out, .error = error};
    bool whole = options->crop && options->tile, fits = true;
    fram_status status = import_frame_make(ctx, rings, options, &m.frame, error);
    if (status == FRAM_OK)
        status = import_all(&m, options->crop && !whole);
    if (status == FRAM_OK && whole)
        status = import_fits_tile(ctx, options, &out->outlines, &fits, error);
    if (status == FRAM_OK && !fits) {
        import_field_free(ctx, out);
        status = import_all(&m, true);
    }
    if (status == FRAM_OK && options->bad == IMPORT_REPAIR)
        status = import_cut_overlaps(ctx, o, options, out, error);
    if (status == FRAM_OK && polygon_list_count(&out->outlines) == 0)
        status = refuse_empty(&m);
    array_free(ctx, &m.vertex);
    polygon_list_free(ctx, &m.pieces);
    polygon_list_free(ctx, &m.cut);
    if (status != FRAM_OK)
        import_field_free(ctx, out);
    return status;
}
