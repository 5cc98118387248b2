/* Repair, simplification and inset of one ring through GEOS; see overlay.h. */
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

/* How far out the mitre of a hollow corner may reach, over the distance of its edges. */
static const double MITRE_LIMIT = 2;
/* GEOS smooths hollows of a hundredth of the distance before it moves an outline. */
static const double LEAST_INSET = 0.98;

/* Whether rings are valid, in p, and away from its outline. */
static bool is_inset(overlay *o, polygon p, double by, const polygon_list *rings)
{
    for (int32_t i = 0; i < polygon_list_count(rings); i++) {
        polygon ring = polygon_list_get(rings, i);
        if (!overlay_is_valid(o, ring, NULL, NULL))
            return false;
        for (int32_t k = 0; k < ring.count; k++) {
            vec2 off = vec2_sub(polygon_nearest_boundary(p, ring.vertex[k], NULL), ring.vertex[k]);
            if (vec2_length(off) < LEAST_INSET * by || !polygon_contains(p, ring.vertex[k]))
                return false;
        }
    }
    return true;
}

fram_status overlay_inset(overlay *o, polygon p, double by, polygon_list *out, fram_error *error)
{
    fram_status status = overlay_check(o, p, "the polygon", error);
    if (status != FRAM_OK)
        return status;
    if (!(by > 0))
        return error_set(error, FRAM_ERROR_INPUT, NULL, 0, NULL, "the distance %g is not positive", by);
    polygon_list inner = {0};
    GEOSGeometry *shape = shape_of_ring(o, p, &status, error);
    if (shape)
        status = take_shape(
            o, GEOSBufferWithStyle_r(o->geos, shape, -by, 1, GEOSBUF_CAP_FLAT, GEOSBUF_JOIN_MITRE, MITRE_LIMIT),
            "move an outline inwards", &inner, error);
    GEOSGeom_destroy_r(o->geos, shape);
    if (status == FRAM_OK && !is_inset(o, p, by, &inner))
        status = error_set(error, FRAM_ERROR_INTERNAL, NULL, 0, NULL, "GEOS moves an outline wrongly by %g m", by);
    for (int32_t i = 0; i < polygon_list_count(&inner) && status == FRAM_OK; i++)
        if (!polygon_list_push(o->ctx, out, polygon_list_get(&inner, i)))
            status = error_memory(error);
    polygon_list_free(o->ctx, &inner);
    return status;
}
