/* Triangulation and convex pieces: Delaunay as GEOS finds it, every vertex kept, area and outline exact. */
#include "geometry/outlines.h"

#include "geometry/overlay.h"
#include "geometry/polygon_pieces.h"
#include "geometry/predicate.h"
#include <geos_c.h>

static context plain;
static overlay *o;
static fram_error error;

static void setup(void)
{
    context_init(&plain);
    o = overlay_create(&plain);
    ck_assert_ptr_nonnull(o);
}

/* The triangles of GEOS, in the same form. */
static void triangles_of_geos(GEOSContextHandle_t geos, polygon p, polygon_list *out)
{
    vec2 v[OUTLINE_ROOM];
    polygon_list list = {0};
    memcpy(v, p.vertex, (size_t)p.count * sizeof *v);
    v[p.count] = v[0];
    GEOSCoordSequence *s = GEOSCoordSeq_copyFromBuffer_r(geos, &v[0].x, (unsigned)p.count + 1, 0, 0);
    GEOSGeometry *shape = GEOSGeom_createPolygon_r(geos, GEOSGeom_createLinearRing_r(geos, s), NULL, 0);
    GEOSGeometry *all = GEOSConstrainedDelaunayTriangulation_r(geos, shape);
    for (int i = 0; i < GEOSGetNumGeometries_r(geos, all); i++) {
        const GEOSGeometry *ring = GEOSGetExteriorRing_r(geos, GEOSGetGeometryN_r(geos, all, i));
        GEOSCoordSeq_copyToBuffer_r(geos, GEOSGeom_getCoordSeq_r(geos, ring), &v[0].x, 0, 0);
        ck_assert(polygon_list_push(&plain, &list, (polygon){v, ring_normal_form(v, 4)}));
    }
    ck_assert(polygon_list_append_sorted(&plain, out, &list));
    polygon_list_free(&plain, &list);
    GEOSGeom_destroy_r(geos, all);
    GEOSGeom_destroy_r(geos, shape);
}

/* In general position the constrained Delaunay triangulation is unique: the very same triangles. */
START_TEST(triangles_as_geos_finds_them)
{
    setup();
    GEOSContextHandle_t geos = GEOS_init_r();
    random_stream r = random_begin(81, 0, 0);
    polygon_list ours = {0}, theirs = {0};
    for (int round = 0; round < 2000; round++) {
        vec2 v[OUTLINE_ROOM];
        polygon p = outline_star(&r, vec2_make(-4, 9), 2, 9, outline_count(&r, 3, 80), v);
        polygon_list_clear(&ours);
        polygon_list_clear(&theirs);
        assert_ok(overlay_triangulate(o, p, &ours, &error), error);
        triangles_of_geos(geos, p, &theirs);
        ck_assert_int_eq(polygon_list_count(&ours), p.count - 2);
        ck_assert_int_eq(ours.vertex.count, theirs.vertex.count);
        assert_array_bits(&ours.vertex.data->x, &theirs.vertex.data->x, 2 * ours.vertex.count);
    }
    polygon_list_free(&plain, &ours);
    polygon_list_free(&plain, &theirs);
    GEOS_finish_r(geos);
    overlay_free(o);
}
END_TEST

/* Vertices straight but for rounding, of which GEOS leaves some out, and lattices, where circles hold many vertices. */
START_TEST(triangles_of_degenerate_outlines)
{
    setup();
    random_stream r = random_begin(82, 0, 0);
    polygon_list l = {0};
    int tried = 0;
    for (int round = 0; round < 3000; round++) {
        vec2 star[40], v[OUTLINE_ROOM];
        int32_t m = outline_count(&r, 3, 40), n = 0;
        outline_star(&r, vec2_make(2, 3), 4, 9, m, star);
        if (round % 2)
            outline_snap(star, m, 1);
        for (int32_t i = 0; i < m; i++) {
            v[n++] = star[i];
            if (random_bits(&r) % 2)
                v[n++] = vec2_add(star[i], vec2_scale(vec2_sub(star[(i + 1) % m], star[i]), random_unit(&r)));
        }
        if (!overlay_is_valid(o, (polygon){v, n}, NULL, NULL))
            continue;
        tried++;
        polygon_list_clear(&l);
        assert_ok(overlay_triangulate(o, (polygon){v, n}, &l, &error), error);
        assert_relative(list_area(&l), polygon_area((polygon){v, n}), 1e-13);
        for (int32_t i = 0; i < polygon_list_count(&l); i++) {
            const vec2 *t = polygon_list_get(&l, i).vertex;
            ck_assert_int_eq(polygon_list_get(&l, i).count, 3);
            ck_assert_int_eq(orientation(t[0], t[1], t[2]), 1);
        }
    }
    ck_assert_int_gt(tried, 1000);
    polygon_list_free(&plain, &l);
    overlay_free(o);
}
END_TEST

/* A vertex that lies on a line of two others but for rounding, on its inner side: a triangle, though the computed area
   of it is not above zero. */
START_TEST(a_triangle_may_be_thinner_than_its_area_tells)
{
    setup();
    vec2 v[] = {{0, 16}, {4112, 4096}, {2056, 2056}, {-5400, 6152}};
    for (int k = 0; k < 4; k++)
        v[k] = vec2_scale(v[k], 1e-3);
    polygon_list l = {0};
    int thin = 0;
    assert_ok(overlay_triangulate(o, (polygon){v, 4}, &l, &error), error);
    ck_assert_int_eq(polygon_list_count(&l), 2);
    for (int32_t i = 0; i < 2; i++) {
        ck_assert_int_eq(polygon_orientation(polygon_list_get(&l, i)), 1);
        thin += polygon_area(polygon_list_get(&l, i)) <= 0;
    }
    ck_assert_int_eq(thin, 1);
    polygon_list_free(&plain, &l);
    overlay_free(o);
}
END_TEST

static int32_t distinct_edges_on(polygon outline, const polygon_list *pieces)
{
    int32_t found = 0;
    for (int32_t i = 0; i < outline.count; i++) {
        vec2 a = outline.vertex[i], b = outline.vertex[(i + 1) % outline.count];
        for (int32_t k = 0; k < polygon_list_count(pieces); k++) {
            polygon p = polygon_list_get(pieces, k);
            for (int32_t j = 0; j < p.count; j++)
                found += vec2_equal(p.vertex[j], a) && vec2_equal(p.vertex[(j + 1) % p.count], b);
        }
    }
    return found;
}

/* Convex, disjoint, together the polygon: every edge of the outline belongs to one piece, as it is. */
START_TEST(pieces_keep_area_and_outline)
{
    setup();
    random_stream r = random_begin(83, 0, 0);
    polygon_list l = {0};
    int triangles = 0, pieces = 0;
    for (int round = 0; round < 2000; round++) {
        vec2 v[OUTLINE_ROOM];
        polygon p = outline_star(&r, vec2_make(30, -20), 3, 9, outline_count(&r, 4, 60), v);
        double lost = -1;
        int32_t most = round % 2 ? 1000 : 5;
        polygon_list_clear(&l);
        assert_ok(overlay_convex_pieces(o, p, 0, most, &l, &lost, &error), error);
        if (polygon_is_convex(p))
            continue;
        assert_absolute(lost, 0, 0);
        assert_relative(list_area(&l), polygon_area(p), 1e-13);
        ck_assert_int_eq(distinct_edges_on(p, &l), p.count);
        for (int32_t i = 0; i < polygon_list_count(&l); i++) {
            ck_assert(polygon_is_convex(polygon_list_get(&l, i)));
            ck_assert_int_le(polygon_list_get(&l, i).count, most);
            for (int32_t k = 0; k < i; k++)
                assert_absolute(polygon_overlap_area(polygon_list_get(&l, i), polygon_list_get(&l, k)), 0, 1e-11);
        }
        if (most > 5) {
            triangles += p.count - 2;
            pieces += polygon_list_count(&l);
        }
    }
    ck_assert_int_lt(pieces, triangles * 6 / 10); /* Hertel-Mehlhorn leaves under 4 times the least; here under 60 % */
    polygon_list_free(&plain, &l);
    overlay_free(o);
}
END_TEST

START_TEST(known_pieces)
{
    setup();
    polygon_list l = {0};
    double lost = -1;
    const vec2 convex[] = {{2, 0}, {2, 2}, {0, 2}, {0, 0}};
    assert_ok(overlay_convex_pieces(o, (polygon){convex, 4}, 100, 3, &l, &lost, &error), error);
    ck_assert_int_eq(polygon_list_count(&l), 1); /* as it is: not even turned */
    assert_array_bits(&l.vertex.data->x, &convex->x, 8);
    assert_absolute(lost, 0, 0);
    polygon_list_clear(&l);
    const vec2 ell[] = {{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 3}, {0, 3}};
    assert_ok(overlay_convex_pieces(o, (polygon){ell, 6}, 0, 8, &l, NULL, &error), error);
    ck_assert_int_eq(polygon_list_count(&l), 2);
    polygon_list_clear(&l);
    /* a house whose small gable is not worth a piece: 2 m x 0.1 m */
    const vec2 gable[] = {{0, 0}, {10, 0}, {10, 4}, {6, 4}, {5, 4.1}, {4, 4}, {0, 4}};
    assert_ok(overlay_convex_pieces(o, (polygon){gable, 7}, 0.5, 4, &l, &lost, &error), error);
    assert_absolute(list_area(&l) + lost, 40.1, 1e-12);
    ck_assert_double_gt(lost, 0.05);
    assert_fails(
        overlay_convex_pieces(o, (polygon){(const vec2[]){{0, 0}, {2, 2}, {2, 0}, {0, 2}}, 4}, 0, 8, &l, NULL, &error),
        error, FRAM_ERROR_INPUT, "edges 0 and 2");
    assert_fails(overlay_triangulate(o, (polygon){convex, 2}, &l, &error), error, FRAM_ERROR_INPUT, "fewer than 3");
    polygon_list_free(&plain, &l);
    overlay_free(o);
}
END_TEST

START_TEST(memory_runs_out)
{
    const vec2 ell[] = {{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 3}, {0, 3}};
    for (int which = 0; which < 2; which++)
        for (failing_turn turn = {0}; failing_next(&turn);) {
            overlay *h = overlay_create(&turn.ctx);
            polygon_list l = {0};
            turn.status = FRAM_ERROR_MEMORY;
            if (h && which == 0)
                turn.status = overlay_triangulate(h, (polygon){ell, 6}, &l, &error);
            else if (h)
                turn.status = overlay_convex_pieces(h, (polygon){ell, 6}, 0.1, 8, &l, NULL, &error);
            if (turn.status != FRAM_OK)
                ck_assert_int_eq(polygon_list_count(&l), 0);
            polygon_list_free(&turn.ctx, &l);
            overlay_free(h);
        }
}
END_TEST

TEST_MAIN("overlay_convex", triangles_as_geos_finds_them, triangles_of_degenerate_outlines,
          a_triangle_may_be_thinner_than_its_area_tells, pieces_keep_area_and_outline, known_pieces, memory_runs_out)
