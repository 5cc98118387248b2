/* Areas, moments, bounds, containment and nearest points; and the pools that hold polygons. */
#include "geometry/outlines.h"

#include "geometry/ear_clip.h"

static const vec2 square[] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
static const vec2 ell[] = {{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 2}, {0, 2}};

static double diameter_of(polygon p)
{
    context ctx;
    context_init(&ctx);
    double found;
    ck_assert(polygon_farthest_apart(&ctx, p, &found));
    return found;
}

/* Against all pairs of vertices: rough and smooth rings, long ones, and those on a lattice, with many pairs as far
   apart and many vertices on a line. */
START_TEST(diameter_is_that_of_all_pairs)
{
    random_stream r = random_begin(23, 0, 0);
    for (int round = 0; round < 600; round++) {
        vec2 v[OUTLINE_ROOM];
        int32_t n = outline_count(&r, 1, 90);
        outline_star(&r, vec2_make(3, -2), round % 2 ? 5 : 2, 5, n, v);
        for (int32_t i = 0; round % 3 == 0 && i < n; i++)
            v[i].x *= 0.01;
        if (round % 5 == 0)
            outline_snap(v, n, round % 10 ? 0.5 : 20); /* of 20: all on one place or on a line */
        assert_absolute(diameter_of((polygon){v, n}), polygon_diameter((polygon){v, n}), 1e-14);
    }
    ck_assert(diameter_of((polygon){NULL, 0}) == 0);
    failing_memory memory;
    context none = failing_context(&memory, 1);
    double found;
    ck_assert(!polygon_farthest_apart(&none, (polygon){square, 4}, &found));
}
END_TEST

START_TEST(area_perimeter_bounds_diameter)
{
    polygon p = {ell, 6};
    assert_absolute(polygon_area(p), 4, 1e-15);
    assert_absolute(polygon_perimeter(p), 10, 1e-15);
    assert_absolute(diameter_of(p), sqrt(13), 1e-15);
    box2 b = polygon_bounds(p);
    assert_vec2_close(b.lo, vec2_make(0, 0), 0);
    assert_vec2_close(b.hi, vec2_make(3, 2), 0);
    vec2 reversed[6];
    for (int i = 0; i < 6; i++)
        reversed[i] = ell[5 - i];
    assert_absolute(polygon_area((polygon){reversed, 6}), -4, 1e-15);
    assert_absolute(polygon_area((polygon){ell, 2}), 0, 0);
    assert_absolute(polygon_area((polygon){NULL, 0}), 0, 0);
    assert_absolute(polygon_perimeter((polygon){NULL, 0}), 0, 0);
    b = polygon_bounds((polygon){NULL, 0});
    ck_assert(b.lo.x == HUGE_VAL && b.hi.y == -HUGE_VAL);
}
END_TEST

/* Square 1/12; right triangle with legs b, h: b h^3/36, h b^3/36, product -b^2 h^2/72 (any handbook). */
START_TEST(moments_of_known_shapes)
{
    polygon_moments m = polygon_moments_of((polygon){square, 4});
    assert_absolute(m.area, 1, 1e-15);
    assert_vec2_close(m.centroid, vec2_make(0.5, 0.5), 1e-15);
    assert_absolute(m.xx, 1.0 / 12, 1e-15);
    assert_absolute(m.yy, 1.0 / 12, 1e-15);
    assert_absolute(m.xy, 0, 1e-15);
    const vec2 triangle[] = {{10, -7}, {13, -7}, {10, -5}}; /* b 3, h 2 */
    m = polygon_moments_of((polygon){triangle, 3});
    assert_relative(m.area, 3, 1e-15);
    assert_vec2_close(m.centroid, vec2_make(11, -7 + 2.0 / 3), 1e-14);
    assert_relative(m.xx, 3 * 8.0 / 36, 1e-14);
    assert_relative(m.yy, 2 * 27.0 / 36, 1e-14);
    assert_relative(m.xy, -9 * 4.0 / 72, 1e-14);
    const vec2 clockwise[] = {{10, -5}, {13, -7}, {10, -7}};
    polygon_moments n = polygon_moments_of((polygon){clockwise, 3});
    assert_relative(n.area, -3, 1e-15);
    assert_relative(n.xx, -m.xx, 1e-14);
    assert_vec2_close(n.centroid, m.centroid, 1e-14);
}
END_TEST

START_TEST(moments_without_area)
{
    const vec2 line[] = {{4, 5}, {6, 5}, {8, 5}};
    polygon_moments m = polygon_moments_of((polygon){line, 3});
    assert_vec2_close(m.centroid, vec2_make(4, 5), 0);
    ck_assert(m.area == 0 && m.xx == 0 && m.yy == 0 && m.xy == 0);
    m = polygon_moments_of((polygon){NULL, 0});
    assert_vec2_close(m.centroid, vec2_make(0, 0), 0);
}
END_TEST

/* Moments of a star are the sums over its triangles, each by the parallel axis theorem. */
START_TEST(moments_add_up_over_triangles)
{
    context ctx;
    context_init(&ctx);
    random_stream r = random_begin(21, 0, 0);
    index_array t = {0};
    for (int round = 0; round < 200; round++) {
        vec2 v[OUTLINE_ROOM];
        polygon p = outline_star(&r, vec2_make(3, -8), 2, 9, outline_count(&r, 3, 60), v);
        polygon_moments whole = polygon_moments_of(p), sum = {0};
        ck_assert_int_eq(polygon_triangulate_ears(&ctx, p, &t), FRAM_OK);
        for (int32_t i = 0; i < t.count; i += 3) {
            vec2 tri[3] = {v[t.data[i]], v[t.data[i + 1]], v[t.data[i + 2]]};
            polygon_moments m = polygon_moments_of((polygon){tri, 3});
            vec2 d = vec2_sub(m.centroid, whole.centroid);
            sum.area += m.area;
            sum.centroid = vec2_add(sum.centroid, vec2_scale(m.centroid, m.area));
            sum.xx += m.xx + m.area * d.y * d.y;
            sum.yy += m.yy + m.area * d.x * d.x;
            sum.xy += m.xy + m.area * d.x * d.y;
        }
        assert_relative(sum.area, whole.area, 1e-13);
        assert_vec2_close(vec2_scale(sum.centroid, 1 / sum.area), whole.centroid, 1e-12);
        assert_relative(sum.xx, whole.xx, 1e-12);
        assert_relative(sum.yy, whole.yy, 1e-12);
        assert_absolute(sum.xy, whole.xy, 1e-12 * (whole.xx + whole.yy));
    }
    array_free(&ctx, &t);
}
END_TEST

/* 8.5e6 m from the origin a shoelace sum about the origin loses all digits; this one loses none that the coordinates
 * have. */
START_TEST(far_from_the_origin)
{
    random_stream r = random_begin(22, 0, 0);
    for (int round = 0; round < 100; round++) {
        vec2 near[OUTLINE_ROOM], far[OUTLINE_ROOM];
        int32_t n = outline_count(&r, 3, 40);
        outline_star(&r, vec2_make(0, 0), 5, 20, n, near);
        outline_snap(near, n, 0x1p-20);
        for (int32_t i = 0; i < n; i++)
            far[i] = vec2_make(near[i].x + 0x1p23, near[i].y - 0x1p23);
        polygon_moments a = polygon_moments_of((polygon){near, n}), b = polygon_moments_of((polygon){far, n});
        assert_bits(polygon_area((polygon){far, n}), polygon_area((polygon){near, n}));
        assert_bits(b.xx, a.xx);
        assert_bits(b.yy, a.yy);
        assert_bits(b.xy, a.xy);
        assert_vec2_close(b.centroid, vec2_make(a.centroid.x + 0x1p23, a.centroid.y - 0x1p23), 2e-9);
    }
}
END_TEST

START_TEST(contains_inside_edge_and_vertex)
{
    polygon p = {ell, 6};
    ck_assert(polygon_contains(p, vec2_make(0.5, 1.5)));
    ck_assert(polygon_contains(p, vec2_make(2, 0.5)));
    ck_assert(!polygon_contains(p, vec2_make(2, 1.5)));
    ck_assert(!polygon_contains(p, vec2_make(-1, 1))); /* its ray runs along an edge and through vertices */
    ck_assert(!polygon_contains(p, vec2_make(4, 1)));
    ck_assert(polygon_contains(p, vec2_make(1.5, 1)));
    ck_assert(polygon_contains(p, vec2_make(1, 1)));
    ck_assert(!polygon_contains(p, vec2_make(1.5, 1 + 0x1p-52)));
    ck_assert(!polygon_contains((polygon){NULL, 0}, vec2_make(0, 0)));
    for (int i = 0; i < 6; i++)
        ck_assert(polygon_contains(p, ell[i]));
}
END_TEST

/* A point is in a polygon when it is in one of its triangles. */
START_TEST(contains_as_the_triangles_do)
{
    context ctx;
    context_init(&ctx);
    random_stream r = random_begin(23, 0, 0);
    index_array t = {0};
    for (int round = 0; round < 100; round++) {
        vec2 v[OUTLINE_ROOM];
        int32_t n = outline_count(&r, 3, 30);
        polygon p = outline_star(&r, vec2_make(0, 0), 4, 9, n, v);
        bool snapped = round % 2 == 0;
        if (snapped)
            outline_snap(v, n, 0x1p-4);
        if (polygon_triangulate_ears(&ctx, p, &t) != FRAM_OK)
            continue; /* the snapping spoiled it */
        for (int k = 0; k < 300; k++) {
            vec2 q = {random_uniform(&r, -9, 9), random_uniform(&r, -9, 9)};
            if (snapped)
                outline_snap(&q, 1, 1);
            bool inside = false;
            for (int32_t i = 0; i < t.count; i += 3) {
                vec2 tri[3] = {v[t.data[i]], v[t.data[i + 1]], v[t.data[i + 2]]};
                inside |= polygon_contains((polygon){tri, 3}, q);
            }
            ck_assert_int_eq(polygon_contains(p, q), inside);
        }
    }
    array_free(&ctx, &t);
}
END_TEST

START_TEST(nearest_boundary_point)
{
    int32_t edge = -1;
    polygon p = {square, 4};
    assert_vec2_close(polygon_nearest_boundary(p, vec2_make(0.4, 0.1), &edge), vec2_make(0.4, 0), 1e-15);
    ck_assert_int_eq(edge, 0);
    assert_vec2_close(polygon_nearest_boundary(p, vec2_make(3, 0.25), &edge), vec2_make(1, 0.25), 1e-15);
    ck_assert_int_eq(edge, 1);
    assert_vec2_close(polygon_nearest_boundary(p, vec2_make(2, 3), NULL), vec2_make(1, 1), 0);
    assert_vec2_close(polygon_nearest_boundary(p, vec2_make(0.5, 0.5), &edge), vec2_make(0.5, 0), 1e-15);
    ck_assert_int_eq(edge, 0); /* the first of four */
    assert_vec2_close(polygon_nearest_boundary((polygon){square, 1}, vec2_make(5, 5), &edge), vec2_make(0, 0), 0);
    ck_assert_int_eq(edge, 0);
    polygon_nearest_boundary((polygon){square, 0}, vec2_make(5, 5), &edge);
    ck_assert_int_eq(edge, -1);
}
END_TEST

/* No sampled point of the boundary is nearer, and the distance is that of a sample in the limit. */
/* No segment is passed over that is nearer, to the last bit; those that are left have the point in the box around them,
   grown by as much. */
START_TEST(segments_that_may_reach_a_point)
{
    random_stream draw = random_begin(41, 0, 0);
    int32_t near = 0, passed = 0;
    for (int k = 0; k < 20000; k++) {
        vec2 c[3];
        for (int i = 0; i < 3; i++)
            c[i] = vec2_make(random_uniform(&draw, -1, 1), random_uniform(&draw, -1, 1));
        if (k % 3 == 0)
            c[1].x = c[0].x; /* upright */
        double way = vec2_length(vec2_sub(segment_nearest(c[0], c[1], c[2]), c[2]));
        ck_assert(segment_may_reach(c[0], c[1], c[2], nextafter(way, HUGE_VAL)));
        double least = random_uniform(&draw, 0, 1);
        double x = fmax(fmin(c[0].x, c[1].x) - c[2].x, c[2].x - fmax(c[0].x, c[1].x));
        double y = fmax(fmin(c[0].y, c[1].y) - c[2].y, c[2].y - fmax(c[0].y, c[1].y));
        ck_assert(segment_may_reach(c[0], c[1], c[2], least) == (fmax(x, y) < least * (1 + 1e-9)));
        near += way < least;
        passed += !segment_may_reach(c[0], c[1], c[2], least);
    }
    ck_assert(near > 4000 && passed > 4000);
}
END_TEST

START_TEST(nearest_boundary_against_samples)
{
    random_stream r = random_begin(24, 0, 0);
    for (int round = 0; round < 100; round++) {
        vec2 v[OUTLINE_ROOM], q = {random_uniform(&r, -9, 9), random_uniform(&r, -9, 9)};
        polygon p = outline_star(&r, vec2_make(0, 0), 4, 9, outline_count(&r, 3, 30), v);
        double distance = vec2_length(vec2_sub(polygon_nearest_boundary(p, q, NULL), q)), least = HUGE_VAL;
        for (int32_t i = 0; i < p.count; i++)
            for (int k = 0; k <= 200; k++) {
                vec2 e = vec2_sub(v[(i + 1) % p.count], v[i]);
                double d = vec2_length(vec2_sub(vec2_add(v[i], vec2_scale(e, k / 200.0)), q));
                least = d < least ? d : least;
            }
        ck_assert_double_le(distance, least + 1e-12);
        ck_assert_double_ge(distance, least - 0.1);
    }
}
END_TEST

START_TEST(pool_of_polygons)
{
    context ctx;
    context_init(&ctx);
    polygon_list l = {0};
    ck_assert_int_eq(polygon_list_count(&l), 0);
    ck_assert(polygon_list_push(&ctx, &l, (polygon){NULL, 0}));
    ck_assert(polygon_list_push(&ctx, &l, (polygon){ell, 6}));
    ck_assert(polygon_list_push(&ctx, &l, (polygon){square, 4}));
    ck_assert_int_eq(polygon_list_count(&l), 3);
    ck_assert_int_eq(polygon_list_get(&l, 0).count, 0);
    ck_assert_int_eq(polygon_list_get(&l, 2).count, 4);
    assert_array_bits(&polygon_list_get(&l, 1).vertex->x, &ell[0].x, 12);
    polygon_list_clear(&l);
    ck_assert_int_eq(polygon_list_count(&l), 0);
    polygon_list_free(&ctx, &l);
}
END_TEST

START_TEST(memory_runs_out)
{
    for (failing_turn turn = {0}; failing_next(&turn);) {
        polygon_list l = {0};
        bool done = polygon_list_push(&turn.ctx, &l, (polygon){square, 4}) &&
                    polygon_list_push(&turn.ctx, &l, (polygon){ell, 6});
        int32_t count = polygon_list_count(&l), vertices = l.vertex.count;
        polygon_list_free(&turn.ctx, &l);
        ck_assert_int_eq(vertices, count == 0 ? 0 : count == 1 ? 4 : 10);
        turn.status = done ? FRAM_OK : FRAM_ERROR_MEMORY;
    }
}
END_TEST

TEST_MAIN("polygon_measure", diameter_is_that_of_all_pairs, area_perimeter_bounds_diameter, moments_of_known_shapes,
          moments_without_area, moments_add_up_over_triangles, far_from_the_origin, contains_inside_edge_and_vertex,
          contains_as_the_triangles_do, nearest_boundary_point, segments_that_may_reach_a_point,
          nearest_boundary_against_samples, pool_of_polygons, memory_runs_out)
