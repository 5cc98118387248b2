/* Difference, intersection and union of polygons through GEOS; see overlay.h.

   GEOS is not asked where two outlines do not touch: then the answer is one of the arguments or nothing, which is
   so for a good half of the wedges of a bending failure.

   GEOS is not trusted either.  Where outlines share a part of an edge, so that a vertex of one lies on an edge of
   the other but for rounding, GEOS 3.11 takes inside for outside in one case out of fifty, and says nothing.  The
   area of a result follows from the arguments alone (polygon_overlap_area), so each result is measured and its
   rings are checked; a wrong one is computed again on a grid of coordinates, coarse enough to make the near vertex
   lie on the edge and far finer than anything that matters.  None of 10,000 such cases failed on the finest of
   these grids. */
#include "geometry/overlay_geos.h"
#include "geometry/polygon_pieces.h"
#include "geometry/predicate.h"
#include <stdio.h>
#include <string.h>

/* Grids of coordinates that are tried one after the other, by the largest coordinate; 0: none.  2^-46 is 1.4e-14. */
static const double grids[] = {0, 0x1p-46, 0x1p-42, 0x1p-38};
/* How far outlines may move in an overlay without a grid, by the largest coordinate: GEOS snaps by as much at times. */
#define SLACK 1e-12

typedef enum operation { DIFFERENCE, INTERSECTION, UNION } operation;

/* What is asked of GEOS, and what is known about the answer. */
typedef struct request {
    operation operation;
    const GEOSGeometry *a, *b;
    double area;      /* of the result */
    double extent;    /* a power of two that no coordinate exceeds */
    double perimeter; /* of both arguments */
} request;

/* ---- asking GEOS, and checking what it says ---- */

static GEOSGeometry *ask(overlay *o, const request *r, double grid)
{
    switch (r->operation) {
    case DIFFERENCE:
        return GEOSDifferencePrec_r(o->geos, r->a, r->b, grid);
    case INTERSECTION:
        return GEOSIntersectionPrec_r(o->geos, r->a, r->b, grid);
    case UNION:
        break;
    }
    return GEOSUnionPrec_r(o->geos, r->a, r->b, grid);
}

static bool found_is_right(overlay *o, const request *r, double grid)
{
    double area = 0;
    for (int32_t i = 0; i < polygon_list_count(&o->found); i++) {
        polygon ring = polygon_list_get(&o->found, i);
        if (!overlay_is_valid(o, ring, NULL, NULL))
            return false;
        area += polygon_area(ring);
    }
    return fabs(area - r->area) <= (SLACK + grid) * r->extent * r->perimeter;
}

/* The right answer, its rings in the found ones; NULL with *status set when there is none. */
static GEOSGeometry *solve(overlay *o, const request *r, fram_status *status, fram_error *error)
{
    for (size_t i = 0; i < sizeof grids / sizeof *grids; i++) {
        polygon_list_clear(&o->found);
        GEOSGeometry *shape = ask(o, r, grids[i] * r->extent);
        *status = shape ? read_shape(o, shape, false, error) : geos_failed(o, "overlay two polygons", error);
        if (*status == FRAM_OK && found_is_right(o, r, grids[i]))
            return shape;
        GEOSGeom_destroy_r(o->geos, shape);
        if (*status == FRAM_ERROR_MEMORY)
            return NULL;
    }
    *status = error_set(error, FRAM_ERROR_INTERNAL, NULL, 0, NULL,
                        "GEOS finds no overlay of the right area (%.17g m2) for two valid polygons", r->area);
    return NULL;
}

/* The largest coordinate of p by magnitude, but at least `least`. */
static double reach_of(polygon p, double least)
{
    box2 b = polygon_bounds(p);
    double x = real_max(fabs(b.lo.x), fabs(b.hi.x)), y = real_max(fabs(b.lo.y), fabs(b.hi.y));
    return real_max(least, real_max(x, y));
}

static double power_of_two_above(double x)
{
    int exponent;
    frexp(x, &exponent);
    return ldexp(1, exponent);
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

static fram_status check_pair(overlay *o, polygon subject, polygon clip, fram_error *error)
{
    fram_status status = overlay_check(o, subject, "the subject", error);
    return status == FRAM_OK ? overlay_check(o, clip, "the clip", error) : status;
}

/* Difference or intersection of two polygons whose outlines meet. */
static fram_status take_overlay(overlay *o, operation which, polygon subject, polygon clip, polygon_list *out,
                                fram_error *error)
{
    fram_status status;
    double common = polygon_overlap_area(subject, clip);
    GEOSGeometry *a = shape_of_ring(o, subject, &status, error);
    GEOSGeometry *b = a ? shape_of_ring(o, clip, &status, error) : NULL;
    if (b) {
        request r = {which,
                     a,
                     b,
                     which == INTERSECTION ? common : polygon_area(subject) - common,
                     power_of_two_above(reach_of(subject, reach_of(clip, 0))),
                     polygon_perimeter(subject) + polygon_perimeter(clip)};
        GEOSGeom_destroy_r(o->geos, solve(o, &r, &status, error));
        if (status == FRAM_OK)
            status = append_found(o, out, error);
    }
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
    memcpy(o->ring.data, hole.vertex, (size_t)hole.count * sizeof *hole.vertex);
    ring_reverse(o->ring.data, hole.count);
    if (!polygon_list_push(o->ctx, &o->rings, (polygon){o->ring.data, hole.count}))
        return error_memory(error);
    fram_status status = cut_rings(o, error);
    return status == FRAM_OK ? append_found(o, out, error) : status;
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
    return take_overlay(o, DIFFERENCE, subject, clip, out, error);
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
    return take_overlay(o, INTERSECTION, subject, clip, out, error);
}

/* ---- union ---- */

/* The polygons of a collection, without the points and lines that GEOS leaves in a union at times but takes in none.
   NULL with *status set when there is no memory. */
static GEOSGeometry *polygons_of(overlay *o, const GEOSGeometry *collection, fram_status *status, fram_error *error)
{
    int count = GEOSGetNumGeometries_r(o->geos, collection);
    unsigned kept = 0;
    GEOSGeometry **part = memory_array(o->ctx, (size_t)count + 1, sizeof *part);
    if (!part) {
        *status = error_memory(error);
        return NULL;
    }
    for (int i = 0; i < count; i++) {
        const GEOSGeometry *g = GEOSGetGeometryN_r(o->geos, collection, i);
        GEOSGeometry *copy = GEOSGeomTypeId_r(o->geos, g) == GEOS_POLYGON ? GEOSGeom_clone_r(o->geos, g) : NULL;
        if (copy)
            part[kept++] = copy;
    }
    GEOSGeometry *polygons = GEOSGeom_createCollection_r(o->geos, GEOS_MULTIPOLYGON, part, kept);
    memory_free(o->ctx, part);
    if (!polygons)
        *status = geos_failed(o, "collect polygons", error);
    return polygons;
}

/* Unite *sum, whose rings are the found ones, with one more part. */
static fram_status unite_one(overlay *o, GEOSGeometry **sum, polygon part, double extent, fram_error *error)
{
    fram_status status;
    request r = {UNION, *sum, NULL, polygon_area(part), extent, polygon_perimeter(part)};
    for (int32_t i = 0; i < polygon_list_count(&o->found); i++) {
        polygon ring = polygon_list_get(&o->found, i);
        r.area += polygon_area(ring) - polygon_overlap_area(ring, part);
        r.perimeter += polygon_perimeter(ring);
    }
    GEOSGeometry *shape = shape_of_ring(o, part, &status, error);
    if (!shape)
        return status;
    r.b = shape;
    GEOSGeometry *more = solve(o, &r, &status, error);
    GEOSGeom_destroy_r(o->geos, shape);
    GEOSGeom_destroy_r(o->geos, *sum);
    *sum = more;
    if (more && GEOSGeomTypeId_r(o->geos, more) == GEOS_GEOMETRYCOLLECTION) {
        *sum = polygons_of(o, more, &status, error);
        GEOSGeom_destroy_r(o->geos, more);
    }
    return status;
}

/* One part after the other, so that each step can be measured. */
fram_status unite(overlay *o, const polygon_list *parts, polygon_list *out, fram_error *error)
{
    fram_status status;
    double reach = 0;
    for (int32_t i = 0; i < polygon_list_count(parts); i++)
        reach = reach_of(polygon_list_get(parts, i), reach);
    double extent = power_of_two_above(reach);
    GEOSGeometry *sum = shape_of_ring(o, polygon_list_get(parts, 0), &status, error);
    polygon_list_clear(&o->found);
    if (sum)
        status = read_shape(o, sum, false, error);
    for (int32_t i = 1; status == FRAM_OK && i < polygon_list_count(parts); i++)
        status = unite_one(o, &sum, polygon_list_get(parts, i), extent, error);
    GEOSGeom_destroy_r(o->geos, sum);
    return status == FRAM_OK ? append_found(o, out, error) : status;
}

fram_status overlay_union(overlay *o, const polygon_list *parts, polygon_list *out, fram_error *error)
{
    int32_t count = polygon_list_count(parts);
    for (int32_t i = 0; i < count; i++) {
        char role[32];
        snprintf(role, sizeof role, "part %d", (int)i);
        fram_status status = overlay_check(o, polygon_list_get(parts, i), role, error);
        if (status != FRAM_OK)
            return status;
    }
    return count > 0 ? unite(o, parts, out, error) : FRAM_OK;
}
