/* The overlay's handle and its way to GEOS and back; see overlay_geos.h.  GEOS takes its memory from the C++ heap;
   everything of Fram's comes from the context. */
#include "geometry/overlay_geos.h"
#include "geometry/polygon_pieces.h"
#include <assert.h>
#include <stdio.h>
#include <string.h>

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
    polygon_list_free(o->ctx, &o->pieces);
    polygon_list_free(o->ctx, &o->found);
    memory_free(o->ctx, o);
}

fram_status geos_failed(overlay *o, const char *what, fram_error *error)
{
    if (strstr(o->message, "bad_alloc"))
        return error_memory(error);
    return error_set(error, FRAM_ERROR_INTERNAL, NULL, 0, NULL, "GEOS could not %s: %s", what, o->message);
}

GEOSGeometry *shape_of_ring(overlay *o, polygon p, fram_status *status, fram_error *error)
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

/* Thinner than rounding: what is left over or missing between outlines that nearly coincide. */
static bool is_noise(polygon p)
{
    return p.count < 3 || fabs(polygon_area(p)) <= polygon_rounding(p) * polygon_perimeter(p);
}

fram_status cut_rings(overlay *o, fram_error *error)
{
    polygon_list_clear(&o->pieces);
    fram_status status = polygon_cut_holes(o->ctx, &o->rings, &o->pieces);
    if (status == FRAM_ERROR_MEMORY)
        return error_memory(error);
    if (status != FRAM_OK)
        return error_set(error, FRAM_ERROR_INTERNAL, NULL, 0, NULL, "the holes of an overlay could not be cut open");
    for (int32_t i = 0; i < polygon_list_count(&o->pieces); i++) {
        polygon piece = polygon_list_get(&o->pieces, i);
        if (!is_noise(piece) && !polygon_list_push(o->ctx, &o->found, piece))
            return error_memory(error);
    }
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
        if (i >= 0)
            ring_reverse(o->ring.data, n); /* holes run clockwise */
        bool noise = is_noise((polygon){o->ring.data, n});
        if (noise && i < 0)
            return FRAM_OK;
        if (!noise && !polygon_list_push(o->ctx, list, (polygon){o->ring.data, n}))
            return error_memory(error);
    }
    return holes > 0 ? cut_rings(o, error) : FRAM_OK;
}

fram_status read_shape(overlay *o, const GEOSGeometry *shape, bool fill_holes, fram_error *error)
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

#ifndef NDEBUG
/* What every overlay promises of its rings.  Exactly: the area of a triangle of nearly straight vertices may round to
   nothing or less. */
static void assert_rings(const polygon_list *rings)
{
    for (int32_t i = 0; i < polygon_list_count(rings); i++) {
        polygon p = polygon_list_get(rings, i);
        assert(p.count >= 3 && polygon_orientation(p) > 0);
    }
}
#endif

fram_status append_found(overlay *o, polygon_list *out, fram_error *error)
{
#ifndef NDEBUG
    assert_rings(&o->found);
#endif
    return polygon_list_append_sorted(o->ctx, out, &o->found) ? FRAM_OK : error_memory(error);
}

fram_status take_shape(overlay *o, GEOSGeometry *shape, const char *what, polygon_list *out, fram_error *error)
{
    if (!shape)
        return geos_failed(o, what, error);
    polygon_list_clear(&o->found);
    fram_status status = read_shape(o, shape, false, error);
    GEOSGeom_destroy_r(o->geos, shape);
    return status == FRAM_OK ? append_found(o, out, error) : status;
}
