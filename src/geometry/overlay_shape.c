/* Repair and simplification of one ring through GEOS; see overlay.h. */
#include "geometry/overlay_geos.h"
#include "geometry/polygon_pieces.h"
#include <string.h>

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
    GEOSGeometry *shape = shape_of_ring(o, p, &status, error);
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
    fram_status status = overlay_check(o, p, "the polygon", error);
    if (status != FRAM_OK)
        return status;
    if (!(tolerance >= 0))
        return error_set(error, FRAM_ERROR_INPUT, NULL, 0, NULL, "the tolerance %g is negative", tolerance);
    polygon_list simple = {0};
    GEOSGeometry *shape = shape_of_ring(o, p, &status, error);
    if (shape)
        status = take_shape(o, GEOSTopologyPreserveSimplify_r(o->geos, shape, tolerance), "simplify a polygon", &simple,
                            error);
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
