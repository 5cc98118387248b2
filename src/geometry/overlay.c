/* Overlay of polygons through GEOS; see overlay.h.

   Arguments are checked here, exactly, and not by GEOS, whose own check costs more than it tells.  Where two
   outlines do not touch, the answer is one of the arguments or nothing, and GEOS is not asked: a good half of the
   wedges of a bending failure.  GEOS takes its memory from the C++ heap; everything of Fram's comes from the
   context. */
#include "geometry/overlay.h"
#include "geometry/polygon_pieces.h"
#include "geometry/predicate.h"
#include <geos_c.h>
#include <stdio.h>
#include <string.h>

struct overlay {
    context *ctx;
    GEOSContextHandle_t geos;
    char message[256];  /* what GEOS said last */
    vec2_array ring;    /* scratch: a closed ring on its way to GEOS or back */
    polygon_list rings; /* scratch: outline and holes of one polygon */
    polygon_list found; /* scratch: the rings of a result, in normal form, before they are sorted */
};

static void keep_message(const char *text, void *user)
{
    overlay *o = user;
    snprintf(o->message, sizeof o->message, "%s", text);
}

overlay *overlay_create(context *ctx)
{
    overlay *o = memory_array(ctx, 1, sizeof *o);
    if (!o)
        return NULL;
    o->ctx = ctx;
    o->geos = GEOS_init_r();
    if (!o->geos) {
        memory_free(ctx, o);
        return NULL;
    }
    GEOSContext_setErrorMessageHandler_r(o->geos, keep_message, o);
    return o;
}

void overlay_free(overlay *o)
{
    if (!o)
        return;
    GEOS_finish_r(o->geos);
    array_free(o->ctx, &o->ring);
    polygon_list_free(o->ctx, &o->rings);
    polygon_list_free(o->ctx, &o->found);
    memory_free(o->ctx, o);
}

context *overlay_context(const overlay *o) { return o->ctx; }

/* ---- validity ---- */

/* A point that the edges i and j of p, which touch, have in common (to rounding). */
static vec2 common_point(polygon p, int32_t i, int32_t j)
{
    vec2 a = p.vertex[i], b = p.vertex[(i + 1) % p.count], c = p.vertex[j], d = p.vertex[(j + 1) % p.count];
    if (segment_contains(c, d, a))
        return a;
    if (segment_contains(c, d, b))
        return b;
    if (segment_contains(a, b, c))
        return c;
    double side_a = vec2_cross(vec2_sub(d, c), vec2_sub(a, c)), side_b = vec2_cross(vec2_sub(d, c), vec2_sub(b, c));
    return side_a == side_b ? d : vec2_add(a, vec2_scale(vec2_sub(b, a), side_a / (side_a - side_b)));
}

static bool refuse(char reason[128], vec2 *place, vec2 where, const char *why)
{
    if (reason)
        snprintf(reason, 128, "%s", why);
    if (place)
        *place = where;
    return false;
}

bool overlay_is_valid(overlay *o, polygon p, char reason[128], vec2 *place)
{
    char text[128];
    int32_t a, b;
    for (int32_t i = 0; i < p.count; i++)
        if (!isfinite(p.vertex[i].x) || !isfinite(p.vertex[i].y)) {
            snprintf(text, sizeof text, "vertex %d is not finite", (int)i);
            return refuse(reason, place, p.vertex[i], text);
        }
    if (p.count < 3)
        return refuse(reason, place, p.count > 0 ? p.vertex[0] : vec2_make(0, 0), "fewer than 3 vertices");
    if (polygon_self_intersects(o->ctx, p, &a, &b)) {
        vec2 where = common_point(p, a, b);
        snprintf(text, sizeof text, "edges %d and %d meet at (%.9g, %.9g)", (int)a, (int)b, where.x, where.y);
        return refuse(reason, place, where, text);
    }
    double area = polygon_area(p);
    if (!(area > 0))
        return refuse(reason, place, p.vertex[0], area < 0 ? "the vertices run clockwise" : "no area");
    return true;
}

static fram_status check_ring(overlay *o, polygon p, const char *role, fram_error *error)
{
    char reason[128];
    if (overlay_is_valid(o, p, reason, NULL))
        return FRAM_OK;
    return error_set(error, FRAM_ERROR_INPUT, NULL, 0, NULL, "%s is no valid polygon: %s", role, reason);
}

/* ---- to GEOS and back ---- */

static fram_status geos_failed(overlay *o, const char *what, fram_error *error)
{
    if (strstr(o->message, "bad_alloc"))
        return error_memory(error);
    return error_set(error, FRAM_ERROR_INTERNAL, NULL, 0, NULL, "GEOS could not %s: %s", what, o->message);
}

/* A GEOS polygon, or NULL with *status set. */
static GEOSGeometry *to_geos(overlay *o, polygon p, fram_status *status, fram_error *error)
{
    if (!array_resize(o->ctx, &o->ring, p.count + 1)) {
        *status = error_memory(error);
        return NULL;
    }
    memcpy(o->ring.data, p.vertex, (size_t)p.count * sizeof *p.vertex);
    o->ring.data[p.count] = p.vertex[0];
    GEOSCoordSequence *sequence =
        GEOSCoordSeq_copyFromBuffer_r(o->geos, &o->ring.data[0].x, (unsigned)p.count + 1, 0, 0);
    GEOSGeometry *ring = sequence ? GEOSGeom_createLinearRing_r(o->geos, sequence) : NULL;
    GEOSGeometry *shape = ring ? GEOSGeom_createPolygon_r(o->geos, ring, NULL, 0) : NULL;
    *status = shape ? FRAM_OK : geos_failed(o, "read a polygon", error);
    return shape;
}

/* Read a GEOS ring into the scratch ring, in normal form; *n is its count. */
static fram_status read_ring(overlay *o, const GEOSGeometry *ring, int32_t *n, fram_error *error)
{
    const GEOSCoordSequence *sequence = GEOSGeom_getCoordSeq_r(o->geos, ring);
    unsigned size = 0;
    if (!sequence || !GEOSCoordSeq_getSize_r(o->geos, sequence, &size))
        return geos_failed(o, "give a ring", error);
    if (size > INT32_MAX || !array_resize(o->ctx, &o->ring, (int32_t)size))
        return error_memory(error);
    if (size > 0 && !GEOSCoordSeq_copyToBuffer_r(o->geos, sequence, &o->ring.data[0].x, 0, 0))
        return geos_failed(o, "give a ring", error);
    *n = ring_normal_form(o->ring.data, (int32_t)size);
    return FRAM_OK;
}

/* Add a polygon to the found rings; a hole is left out or cut open. */
static fram_status read_polygon(overlay *o, const GEOSGeometry *shape, bool fill_holes, fram_error *error)
{
    int holes = fill_holes ? 0 : GEOSGetNumInteriorRings_r(o->geos, shape);
    polygon_list *list = holes > 0 ? &o->rings : &o->found;
    polygon_list_clear(&o->rings);
    for (int i = -1; i < holes; i++) {
        int32_t n = 0;
        fram_status status = read_ring(
            o, i < 0 ? GEOSGetExteriorRing_r(o->geos, shape) : GEOSGetInteriorRingN_r(o->geos, shape, i), &n, error);
        if (status != FRAM_OK)
            return status;
        for (int32_t a = 0, b = n - 1; i >= 0 && a < b; a++, b--) { /* holes run clockwise */
            vec2 t = o->ring.data[a];
            o->ring.data[a] = o->ring.data[b];
            o->ring.data[b] = t;
        }
        if (n >= 3 && !polygon_list_push(o->ctx, list, (polygon){o->ring.data, n}))
            return error_memory(error);
    }
    fram_status status = holes > 0 ? polygon_cut_holes(o->ctx, &o->rings, &o->found) : FRAM_OK;
    if (status == FRAM_ERROR_MEMORY)
        return error_memory(error);
    if (status != FRAM_OK)
        return error_set(error, FRAM_ERROR_INTERNAL, NULL, 0, NULL, "the holes of an overlay could not be cut open");
    return FRAM_OK;
}

/* Add the polygons of any geometry, whatever it nests, to the found rings. */
static fram_status read_shape(overlay *o, const GEOSGeometry *shape, bool fill_holes, fram_error *error)
{
    int type = GEOSGeomTypeId_r(o->geos, shape);
    if (type == GEOS_POLYGON)
        return GEOSisEmpty_r(o->geos, shape) ? FRAM_OK : read_polygon(o, shape, fill_holes, error);
    if (type != GEOS_MULTIPOLYGON && type != GEOS_GEOMETRYCOLLECTION)
        return FRAM_OK; /* points and lines where outlines touch */
    int count = GEOSGetNumGeometries_r(o->geos, shape);
    for (int i = 0; i < count; i++) {
        fram_status status = read_shape(o, GEOSGetGeometryN_r(o->geos, shape, i), fill_holes, error);
        if (status != FRAM_OK)
            return status;
    }
    return FRAM_OK;
}

static fram_status append_found(overlay *o, polygon_list *out, fram_error *error)
{
    return polygon_list_append_sorted(o->ctx, out, &o->found) ? FRAM_OK : error_memory(error);
}

/* Append the polygons of a result, which is freed; NULL is a failure of GEOS. */
static fram_status take_result(overlay *o, GEOSGeometry *shape, const char *what, polygon_list *out, fram_error *error)
{
    if (!shape)
        return geos_failed(o, what, error);
    polygon_list_clear(&o->found);
    fram_status status = read_shape(o, shape, false, error);
    GEOSGeom_destroy_r(o->geos, shape);
    return status == FRAM_OK ? append_found(o, out, error) : status;
}

/* Append p, in normal form. */
static fram_status take_polygon(overlay *o, polygon p, polygon_list *out, fram_error *error)
{
    if (!array_resize(o->ctx, &o->ring, p.count))
        return error_memory(error);
    memcpy(o->ring.data, p.vertex, (size_t)p.count * sizeof *p.vertex);
    polygon ring = {o->ring.data, ring_normal_form(o->ring.data, p.count)};
    return polygon_list_push(o->ctx, out, ring) ? FRAM_OK : error_memory(error);
}

/* ---- difference and intersection ---- */

/* How two valid polygons lie to each other when their outlines have no point in common. */
typedef enum relation { RELATION_MEET, RELATION_APART, RELATION_A_INSIDE_B, RELATION_B_INSIDE_A } relation;

static relation relation_of(polygon a, polygon b)
{
    box2 box = polygon_bounds(b);
    for (int32_t i = 0; i < a.count; i++) {
        vec2 p = a.vertex[i], q = a.vertex[i + 1 < a.count ? i + 1 : 0];
        if (real_max(p.x, q.x) < box.lo.x || real_min(p.x, q.x) > box.hi.x || real_max(p.y, q.y) < box.lo.y ||
            real_min(p.y, q.y) > box.hi.y)
            continue;
        for (int32_t k = 0; k < b.count; k++)
            if (segments_touch(p, q, b.vertex[k], b.vertex[k + 1 < b.count ? k + 1 : 0]))
                return RELATION_MEET;
    }
    if (polygon_contains(b, a.vertex[0]))
        return RELATION_A_INSIDE_B;
    return polygon_contains(a, b.vertex[0]) ? RELATION_B_INSIDE_A : RELATION_APART;
}

typedef GEOSGeometry *(*binary_overlay)(GEOSContextHandle_t, const GEOSGeometry *, const GEOSGeometry *);

static fram_status check_pair(overlay *o, polygon subject, polygon clip, fram_error *error)
{
    fram_status status = check_ring(o, subject, "the subject", error);
    return status == FRAM_OK ? check_ring(o, clip, "the clip", error) : status;
}

static fram_status ask_geos(overlay *o, binary_overlay call, const char *what, polygon subject, polygon clip,
                            polygon_list *out, fram_error *error)
{
    fram_status status;
    GEOSGeometry *a = to_geos(o, subject, &status, error);
    GEOSGeometry *b = a ? to_geos(o, clip, &status, error) : NULL;
    if (b)
        status = take_result(o, call(o->geos, a, b), what, out, error);
    GEOSGeom_destroy_r(o->geos, a);
    GEOSGeom_destroy_r(o->geos, b);
    return status;
}

/* The subject with the clip as a hole, cut open. */
static fram_status take_with_hole(overlay *o, polygon subject, polygon hole, polygon_list *out, fram_error *error)
{
    polygon_list_clear(&o->rings);
    polygon_list_clear(&o->found);
    if (!array_resize(o->ctx, &o->ring, hole.count) || !polygon_list_push(o->ctx, &o->rings, subject))
        return error_memory(error);
    for (int32_t i = 0; i < hole.count; i++)
        o->ring.data[i] = hole.vertex[hole.count - 1 - i];
    if (!polygon_list_push(o->ctx, &o->rings, (polygon){o->ring.data, hole.count}))
        return error_memory(error);
    fram_status status = polygon_cut_holes(o->ctx, &o->rings, &o->found);
    if (status == FRAM_ERROR_MEMORY)
        return error_memory(error);
    if (status != FRAM_OK)
        return error_set(error, FRAM_ERROR_INTERNAL, NULL, 0, NULL, "a hole could not be cut open");
    return append_found(o, out, error);
}

fram_status overlay_difference(overlay *o, polygon subject, polygon clip, polygon_list *out, fram_error *error)
{
    fram_status status = check_pair(o, subject, clip, error);
    if (status != FRAM_OK)
        return status;
    switch (relation_of(subject, clip)) {
    case RELATION_APART:
        return take_polygon(o, subject, out, error);
    case RELATION_A_INSIDE_B:
        return FRAM_OK;
    case RELATION_B_INSIDE_A:
        return take_with_hole(o, subject, clip, out, error);
    case RELATION_MEET:
        break;
    }
    return ask_geos(o, GEOSDifference_r, "subtract one polygon from another", subject, clip, out, error);
}

fram_status overlay_intersection(overlay *o, polygon subject, polygon clip, polygon_list *out, fram_error *error)
{
    fram_status status = check_pair(o, subject, clip, error);
    if (status != FRAM_OK)
        return status;
    switch (relation_of(subject, clip)) {
    case RELATION_APART:
        return FRAM_OK;
    case RELATION_A_INSIDE_B:
        return take_polygon(o, subject, out, error);
    case RELATION_B_INSIDE_A:
        return take_polygon(o, clip, out, error);
    case RELATION_MEET:
        break;
    }
    return ask_geos(o, GEOSIntersection_r, "intersect two polygons", subject, clip, out, error);
}

/* ---- union, repair, simplification, triangulation ---- */

/* A collection of GEOS polygons, or NULL with *status set. */
static GEOSGeometry *collect(overlay *o, const polygon_list *parts, fram_status *status, fram_error *error)
{
    int32_t count = polygon_list_count(parts), made = 0;
    GEOSGeometry **shape = memory_array(o->ctx, (size_t)count, sizeof *shape), *all = NULL;
    if (!shape) {
        *status = error_memory(error);
        return NULL;
    }
    *status = FRAM_OK;
    while (*status == FRAM_OK && made < count) {
        shape[made] = to_geos(o, polygon_list_get(parts, made), status, error);
        made += *status == FRAM_OK;
    }
    if (*status == FRAM_OK) {
        all = GEOSGeom_createCollection_r(o->geos, GEOS_GEOMETRYCOLLECTION, shape, (unsigned)count);
        made = 0; /* the parts are the collection's now, or gone with it */
        if (!all)
            *status = geos_failed(o, "collect polygons", error);
    }
    for (int32_t i = 0; i < made; i++)
        GEOSGeom_destroy_r(o->geos, shape[i]);
    memory_free(o->ctx, shape);
    return all;
}

static fram_status unite(overlay *o, const polygon_list *parts, polygon_list *out, fram_error *error)
{
    fram_status status;
    GEOSGeometry *all = collect(o, parts, &status, error);
    if (all)
        status = take_result(o, GEOSUnaryUnion_r(o->geos, all), "unite polygons", out, error);
    GEOSGeom_destroy_r(o->geos, all);
    return status;
}

fram_status overlay_union(overlay *o, const polygon_list *parts, polygon_list *out, fram_error *error)
{
    int32_t count = polygon_list_count(parts);
    for (int32_t i = 0; i < count; i++) {
        char role[32];
        snprintf(role, sizeof role, "part %d", (int)i);
        fram_status status = check_ring(o, polygon_list_get(parts, i), role, error);
        if (status != FRAM_OK)
            return status;
    }
    return count > 0 ? unite(o, parts, out, error) : FRAM_OK;
}

/* The valid shape of any ring, or NULL. */
static GEOSGeometry *make_valid(overlay *o, const GEOSGeometry *shape)
{
    GEOSMakeValidParams *how = GEOSMakeValidParams_create_r(o->geos);
    GEOSGeometry *valid = NULL;
    /* Structure, not linework: what an outline winds round twice is interior, not a hole. */
    if (how && GEOSMakeValidParams_setMethod_r(o->geos, how, GEOS_MAKE_VALID_STRUCTURE) &&
        GEOSMakeValidParams_setKeepCollapsed_r(o->geos, how, 0))
        valid = GEOSMakeValidWithParams_r(o->geos, shape, how);
    GEOSMakeValidParams_destroy_r(o->geos, how);
    return valid;
}

fram_status overlay_make_valid(overlay *o, polygon p, polygon_list *out, fram_error *error)
{
    for (int32_t i = 0; i < p.count; i++)
        if (!isfinite(p.vertex[i].x) || !isfinite(p.vertex[i].y))
            return error_set(error, FRAM_ERROR_INPUT, NULL, 0, NULL, "vertex %d is not finite", (int)i);
    if (p.count < 3)
        return FRAM_OK;
    fram_status status;
    GEOSGeometry *shape = to_geos(o, p, &status, error);
    if (!shape)
        return status;
    GEOSGeometry *valid = make_valid(o, shape);
    GEOSGeom_destroy_r(o->geos, shape);
    if (!valid)
        return geos_failed(o, "repair a polygon", error);
    polygon_list_clear(&o->found);
    status = read_shape(o, valid, true, error);
    GEOSGeom_destroy_r(o->geos, valid);
    if (status != FRAM_OK)
        return status;
    /* A filled hole may hold another of the rings: filled again by their union. */
    if (polygon_list_count(&o->found) < 2)
        return append_found(o, out, error);
    polygon_list filled = o->found;
    o->found = (polygon_list){0};
    status = unite(o, &filled, out, error);
    polygon_list_free(o->ctx, &filled);
    return status;
}

fram_status overlay_simplify(overlay *o, polygon p, double tolerance, vec2_array *out, fram_error *error)
{
    fram_status status = check_ring(o, p, "the polygon", error);
    if (status != FRAM_OK)
        return status;
    if (!(tolerance >= 0))
        return error_set(error, FRAM_ERROR_INPUT, NULL, 0, NULL, "the tolerance %g is negative", tolerance);
    polygon_list simple = {0};
    GEOSGeometry *shape = to_geos(o, p, &status, error);
    if (shape)
        status = take_result(o, GEOSTopologyPreserveSimplify_r(o->geos, shape, tolerance), "simplify a polygon",
                             &simple, error);
    GEOSGeom_destroy_r(o->geos, shape);
    bool usable = polygon_list_count(&simple) == 1 && overlay_is_valid(o, polygon_list_get(&simple, 0), NULL, NULL);
    polygon ring = usable ? polygon_list_get(&simple, 0) : p;
    if (status == FRAM_OK && !array_resize(o->ctx, out, ring.count))
        status = error_memory(error);
    if (status == FRAM_OK) {
        memcpy(out->data, ring.vertex, (size_t)ring.count * sizeof *ring.vertex);
        out->count = ring_normal_form(out->data, ring.count);
    }
    polygon_list_free(o->ctx, &simple);
    return status;
}

fram_status overlay_triangulate(overlay *o, polygon p, polygon_list *out, fram_error *error)
{
    fram_status status = check_ring(o, p, "the polygon", error);
    if (status != FRAM_OK)
        return status;
    GEOSGeometry *shape = to_geos(o, p, &status, error);
    if (shape)
        status =
            take_result(o, GEOSConstrainedDelaunayTriangulation_r(o->geos, shape), "triangulate a polygon", out, error);
    GEOSGeom_destroy_r(o->geos, shape);
    return status;
}
