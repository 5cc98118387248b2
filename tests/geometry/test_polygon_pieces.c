/* Normal forms, holes cut open, merging, and the area that two polygons have in common. */
#include "geometry/outlines.h"

#include "geometry/polygon_pieces.h"
#include "geometry/predicate.h"

static context plain;

static void push(polygon_list *l, const vec2 *v, int32_t n)
{
    ck_assert(polygon_list_push(&plain, l, (polygon){v, n}));
}

static void push_hole(polygon_list *l, const vec2 *v, int32_t n)
{
    vec2 reversed[OUTLINE_ROOM];
    for (int32_t i = 0; i < n; i++)
        reversed[i] = v[n - 1 - i];
    push(l, reversed, n);
}

START_TEST(ring_in_normal_form)
{
    vec2 v[] = {{2, 0}, {2, 0}, {0, 0}, {0, 2}, {0, 2}, {2, 2}, {2, 0}};
    const vec2 expected[] = {{0, 0}, {2, 0}, {2, 2}, {0, 2}};
    ck_assert_int_eq(ring_normal_form(v, 7), 4);
    assert_array_bits(&v->x, &expected->x, 8);
    vec2 line[] = {{2, 0}, {1, 0}, {3, 0}};
    ck_assert_int_eq(ring_normal_form(line, 3), 0);
    ck_assert_int_eq(ring_normal_form(line, 0), 0);
    /* a sliver whose computed area may have either sign, or none */
    vec2 sliver[] = {{0.1, 0.1}, {0.7, 0.7 + 0x1p-53}, {0.3, 0.3}};
    int turn = orientation(sliver[0], sliver[1], sliver[2]);
    ck_assert_int_ne(turn, 0);
    ck_assert_int_eq(ring_normal_form(sliver, 3), 3);
    ck_assert_int_eq(orientation(sliver[0], sliver[1], sliver[2]), 1);
}
END_TEST

START_TEST(rings_in_order)
{
    context_init(&plain);
    polygon_list l = {0}, out = {0};
    const vec2 a[] = {{0, 0}, {1, 0}, {1, 1}}, b[] = {{0, 0}, {1, 0}, {1, 0.5}}, c[] = {{-1, 9}, {0, 9}, {0, 10}};
    push(&out, c, 3);
    push(&l, a, 3);
    push(&l, b, 3);
    push(&l, c, 3);
    ck_assert(polygon_list_append_sorted(&plain, &out, &l));
    ck_assert_int_eq(polygon_list_count(&out), 4);
    assert_array_bits(&polygon_list_get(&out, 1).vertex->x, &c->x, 6);
    assert_array_bits(&polygon_list_get(&out, 2).vertex->x, &b->x, 6);
    assert_array_bits(&polygon_list_get(&out, 3).vertex->x, &a->x, 6);
    polygon_list_free(&plain, &l);
    polygon_list_free(&plain, &out);
}
END_TEST

/* Simple rings, counter-clockwise, apart from each other, of the area of the whole; all vertices from the input. */
static void check_cut(const polygon_list *rings, const polygon_list *out)
{
    assert_relative(list_area(out), list_area(rings), 1e-13);
    for (int32_t i = 0; i < polygon_list_count(out); i++) {
        polygon p = polygon_list_get(out, i);
        ck_assert(!polygon_self_intersects(&plain, p, NULL, NULL));
        ck_assert_int_eq(polygon_orientation(p), 1);
        for (int32_t k = 0; k < i; k++)
            assert_absolute(polygon_overlap_area(p, polygon_list_get(out, k)), 0, 1e-11);
        for (int32_t k = 0; k < p.count; k++) {
            int32_t v = 0;
            while (v < rings->vertex.count && !vec2_equal(rings->vertex.data[v], p.vertex[k]))
                v++;
            ck_assert_int_lt(v, rings->vertex.count);
        }
    }
}

START_TEST(one_hole)
{
    context_init(&plain);
    polygon_list rings = {0}, out = {0};
    const vec2 square[] = {{0, 0}, {9, 0}, {9, 9}, {0, 9}}, hole[] = {{3, 3}, {6, 3}, {6, 6}, {3, 6}};
    ck_assert_int_eq(polygon_cut_holes(&plain, &rings, &out), FRAM_OK);
    ck_assert_int_eq(polygon_list_count(&out), 0);
    push(&rings, square, 4);
    ck_assert_int_eq(polygon_cut_holes(&plain, &rings, &out), FRAM_OK);
    ck_assert_int_eq(polygon_list_count(&out), 1);
    polygon_list_clear(&out);
    push_hole(&rings, hole, 4);
    ck_assert_int_eq(polygon_cut_holes(&plain, &rings, &out), FRAM_OK);
    ck_assert_int_eq(polygon_list_count(&out), 2);
    check_cut(&rings, &out);
    double cuts = polygon_perimeter(polygon_list_get(&out, 0)) + polygon_perimeter(polygon_list_get(&out, 1)) - 36 - 12;
    assert_absolute(cuts, 2 * 2 * sqrt(18), 1e-12); /* two of the four shortest bridges, each with two sides */
    polygon_list_free(&plain, &rings);
    polygon_list_free(&plain, &out);
}
END_TEST

/* Holes that touch the outline, each other, and the outline twice over a chain of three. */
START_TEST(holes_that_touch)
{
    context_init(&plain);
    polygon_list rings = {0}, out = {0};
    const vec2 square[] = {{0, 0}, {12, 0}, {12, 12}, {0, 12}, {0, 6}};
    const vec2 a[] = {{0, 6}, {4, 4}, {4, 6}}, b[] = {{4, 6}, {8, 6}, {8, 8}}, c[] = {{4, 4}, {8, 2}, {8, 6}};
    push(&rings, square, 5);
    push_hole(&rings, a, 3);
    ck_assert_int_eq(polygon_cut_holes(&plain, &rings, &out), FRAM_OK);
    check_cut(&rings, &out);
    polygon_list_clear(&out);
    push_hole(&rings, b, 3);
    ck_assert_int_eq(polygon_cut_holes(&plain, &rings, &out), FRAM_OK);
    check_cut(&rings, &out);
    polygon_list_clear(&out);
    push_hole(&rings, c, 3);
    /* a, b and c shut a pocket in, so the interior is in two parts: one ring cannot run round both */
    ck_assert_int_eq(polygon_cut_holes(&plain, &rings, &out), FRAM_ERROR_INPUT);
    polygon_list_free(&plain, &rings);
    polygon_list_free(&plain, &out);
}
END_TEST

/* Up to 25 holes on a lattice inside a star, diamonds of which many touch in a corner. */
START_TEST(many_holes)
{
    context_init(&plain);
    random_stream r = random_begin(91, 0, 0);
    polygon_list rings = {0}, out = {0};
    for (int round = 0; round < 300; round++) {
        vec2 v[OUTLINE_ROOM];
        polygon_list_clear(&rings);
        polygon_list_clear(&out);
        polygon p = outline_star(&r, vec2_make(0, 0), 12, 16, outline_count(&r, 8, 60), v);
        bool touching = round % 2;
        push(&rings, v, p.count);
        for (int i = -2; i <= 2; i++)
            for (int j = -2; j <= 2; j++) {
                vec2 centre = {3 * i, 3 * j}, hole[8];
                if (random_unit(&r) < 0.5)
                    continue;
                if (touching && (i + j) % 2 == 0 && i * i + j * j < 8) { /* diagonal neighbours only: no pockets */
                    double s = 1.5;
                    const vec2 diamond[] = {{centre.x + s, centre.y},
                                            {centre.x, centre.y + 1},
                                            {centre.x - s, centre.y},
                                            {centre.x, centre.y - 1}};
                    push_hole(&rings, diamond, 4);
                } else if (!touching) {
                    int32_t n = outline_count(&r, 3, 8);
                    outline_star(&r, centre, 0.5, 1.4, n, hole);
                    push_hole(&rings, hole, n);
                }
            }
        ck_assert_int_eq(polygon_cut_holes(&plain, &rings, &out), FRAM_OK);
        check_cut(&rings, &out);
        ck_assert_int_le(polygon_list_count(&out), polygon_list_count(&rings) + 1);
    }
    polygon_list_free(&plain, &rings);
    polygon_list_free(&plain, &out);
}
END_TEST

START_TEST(rings_that_cross_are_refused)
{
    context_init(&plain);
    polygon_list rings = {0}, out = {0};
    const vec2 square[] = {{0, 0}, {9, 0}, {9, 9}, {0, 9}}, outside[] = {{20, 3}, {26, 3}, {26, 6}};
    push(&rings, square, 4);
    push_hole(&rings, outside, 3);
    ck_assert_int_eq(polygon_cut_holes(&plain, &rings, &out), FRAM_ERROR_INPUT);
    polygon_list_free(&plain, &rings);
    polygon_list_free(&plain, &out);
}
END_TEST

START_TEST(area_in_common)
{
    const vec2 a[] = {{0, 0}, {4, 0}, {4, 4}, {0, 4}}, b[] = {{3, 3}, {6, 3}, {6, 6}, {3, 6}};
    const vec2 c[] = {{4, 0}, {8, 0}, {8, 4}, {4, 4}}, d[] = {{1, -1}, {2, -1}, {2, 5}, {1, 5}};
    const vec2 diamond[] = {{2, 0}, {4, 2}, {2, 4}, {0, 2}};
    assert_absolute(polygon_overlap_area((polygon){a, 4}, (polygon){b, 4}), 1, 1e-14);
    assert_absolute(polygon_overlap_area((polygon){a, 4}, (polygon){c, 4}), 0, 0);
    assert_absolute(polygon_overlap_area((polygon){a, 4}, (polygon){d, 4}), 4, 1e-14);
    assert_absolute(polygon_overlap_area((polygon){a, 4}, (polygon){diamond, 4}), 8, 1e-14);
    assert_absolute(polygon_overlap_area((polygon){a, 4}, (polygon){a, 4}), 16, 1e-14);
    assert_absolute(polygon_overlap_area((polygon){a, 0}, (polygon){a, 4}), 0, 0);
}
END_TEST

/* Sums over the triangles of two stars, each pair clipped: another way to the same number, also far from the origin. */
START_TEST(area_in_common_over_triangles)
{
    context_init(&plain);
    random_stream r = random_begin(92, 0, 0);
    index_array s = {0}, t = {0};
    vec2_array common = {0};
    for (int round = 0; round < 200; round++) {
        vec2 a[OUTLINE_ROOM], b[OUTLINE_ROOM], shift = {round % 2 ? 1e5 : 0, round % 2 ? -1e5 : 0};
        polygon p = outline_star(&r, shift, 3, 9, outline_count(&r, 3, 20), a);
        polygon q = outline_star(&r, vec2_add(shift, vec2_make(5, 1)), 3, 9, outline_count(&r, 3, 20), b);
        ck_assert_int_eq(polygon_triangulate_ears(&plain, p, &s), FRAM_OK);
        ck_assert_int_eq(polygon_triangulate_ears(&plain, q, &t), FRAM_OK);
        double sum = 0;
        for (int32_t i = 0; i < s.count; i += 3)
            for (int32_t k = 0; k < t.count; k += 3) {
                vec2 x[3] = {a[s.data[i]], a[s.data[i + 1]], a[s.data[i + 2]]};
                vec2 y[3] = {b[t.data[k]], b[t.data[k + 1]], b[t.data[k + 2]]};
                ck_assert(polygon_clip_convex(&plain, (polygon){x, 3}, (polygon){y, 3}, &common));
                sum += polygon_area((polygon){common.data, common.count});
            }
        assert_absolute(polygon_overlap_area(p, q), sum, round % 2 ? 1e-8 : 1e-12);
        assert_absolute(polygon_overlap_area(q, p), sum, round % 2 ? 1e-8 : 1e-12);
    }
    array_free(&plain, &s);
    array_free(&plain, &t);
    array_free(&plain, &common);
}
END_TEST

START_TEST(memory_runs_out)
{
    context_init(&plain);
    polygon_list rings = {0};
    const vec2 square[] = {{0, 0}, {9, 0}, {9, 9}, {0, 9}}, hole[] = {{3, 3}, {6, 3}, {6, 6}, {3, 6}};
    push(&rings, square, 4);
    push_hole(&rings, hole, 4);
    for (failing_turn turn = {0}; failing_next(&turn);) {
        polygon_list out = {0};
        turn.status = polygon_cut_holes(&turn.ctx, &rings, &out);
        polygon_list_free(&turn.ctx, &out);
    }
    polygon_list_free(&plain, &rings);
}
END_TEST

TEST_MAIN("polygon_pieces", ring_in_normal_form, rings_in_order, one_hole, holes_that_touch, many_holes,
          rings_that_cross_are_refused, area_in_common, area_in_common_over_triangles, memory_runs_out)
