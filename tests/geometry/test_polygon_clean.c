/* Algorithm 10: what goes, what stays, and that a fine outline keeps its shape. */
#include "geometry/outlines.h"

#include "geometry/predicate.h"

static context plain;
static vec2_array out;

static polygon clean(const vec2 *v, int32_t n, double edge)
{
    context_init(&plain);
    ck_assert(polygon_clean(&plain, (polygon){v, n}, edge, &out));
    return (polygon){out.data, out.count};
}

static void expect(const vec2 *v, int32_t n, double edge, const vec2 *expected, int32_t m)
{
    polygon p = clean(v, n, edge);
    ck_assert_int_eq(p.count, m);
    assert_array_bits(&p.vertex->x, &expected->x, 2 * m);
    array_free(&plain, &out);
}

START_TEST(nothing_to_clean)
{
    const vec2 square[] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    expect(square, 4, 0.005, square, 4);
    expect(square, 3, 5, square, 3); /* three vertices stay whatever their size */
    expect(square, 2, 0.005, square, 2);
    /* Four with a short edge become three. */
    const vec2 clipped[] = {{0, 0}, {1, 0}, {1, 0.003}, {0, 1}}, triangle[] = {{0, 0}, {1, 0}, {0, 1}};
    ck_assert_int_eq(clean(clipped, 4, 0.005).count, 3);
    assert_absolute(polygon_area(clean(clipped, 4, 0.005)), polygon_area((polygon){triangle, 3}), 0.002);
    array_free(&plain, &out);
    ck_assert_int_eq(clean(NULL, 0, 0.005).count, 0);
}
END_TEST

START_TEST(short_edges_spikes_and_straight_vertices_go)
{
    const vec2 square[] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    const vec2 short_edge[] = {{0, 0}, {0.997, 0}, {1, 0}, {1, 1}, {0, 1}};
    expect(short_edge, 5, 0.005, square, 4);
    /* Of the two ends the one goes that costs less, here nothing. */
    const vec2 corner[] = {{0, 0}, {1, -0.003}, {1, 0}, {1, 1}, {0, 1}};
    const vec2 cheap[] = {{0, 0}, {1, -0.003}, {1, 1}, {0, 1}};
    expect(corner, 5, 0.005, cheap, 4);
    const vec2 straight[] = {{0, 0}, {0.5, 0}, {1, 0}, {1, 1}, {0, 1}};
    expect(straight, 5, 0.005, square, 4);
    const vec2 bent[] = {{0, 0}, {0.5, 0.004}, {1, 0}, {1, 1}, {0, 1}};
    expect(bent, 5, 0.005, square, 4);
    const vec2 spike[] = {{0, 0}, {1, 0}, {1, 1}, {1.02, 3}, {0.98, 1}, {0, 1}};
    const vec2 no_spike[] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    polygon p = clean(spike, 6, 0.005);
    ck_assert_int_eq(p.count, 4);
    assert_absolute(polygon_area(p), polygon_area((polygon){no_spike, 4}), 0.02);
    const vec2 repeated[] = {{0, 0}, {0, 0}, {1, 0}, {1, 1}, {1, 1}, {1, 1}, {0, 1}};
    expect(repeated, 7, 0, square, 4);
    array_free(&plain, &out);
}
END_TEST

/* 8 degrees on 50 m edges is straight by the print, and 3 m of ice. */
START_TEST(a_long_shallow_corner_stays)
{
    const vec2 v[] = {{0, 0}, {50, -3}, {100, 0}, {100, 40}, {0, 40}};
    expect(v, 5, 0.15, v, 5);
    const vec2 steep[] = {{0, 0}, {50, -0.1}, {100, 0}, {100, 40}, {0, 40}};
    ck_assert_int_eq(clean(steep, 5, 0.15).count, 4);
    array_free(&plain, &out);
}
END_TEST

START_TEST(a_bound_is_not_under_itself)
{
    const vec2 v[] = {{0, 0}, {8, -0.5}, {16, 0}, {16, 8}, {0, 8}};
    ck_assert_int_eq(clean(v, 5, 0.5).count, 5);
    ck_assert_int_eq(clean(v, 5, 0.5000001).count, 4);
    const vec2 e[] = {{0, 0}, {7.5, 0}, {8, 3}, {8, 8}, {7.5, 8}, {0, 4}};
    ck_assert_int_eq(clean(e, 6, 0.5).count, 6);
    ck_assert_int_eq(clean(e, 6, 0.5000001).count, 5);
    array_free(&plain, &out);
}
END_TEST

static double distance_to(polygon p, vec2 v) { return vec2_length(vec2_sub(polygon_nearest_boundary(p, v, NULL), v)); }

/* The listing drops every vertex of a ring whose edges are all short, down to three. */
START_TEST(a_fine_circle_keeps_its_shape)
{
    static vec2 v[4000];
    for (int i = 0; i < 4000; i++)
        v[i] = vec2_make(10 * real_cos(2 * PI * i / 4000), 10 * real_sin(2 * PI * i / 4000));
    for (double edge = 0.01; edge < 3; edge *= 2) {
        polygon p = clean(v, 4000, edge);
        ck_assert_int_ge(p.count, 5);
        ck_assert_int_lt(p.count, 250);
        for (int32_t i = 0; i < p.count; i++)
            ck_assert_double_ge(vec2_length(vec2_sub(p.vertex[(i + 1) % p.count], p.vertex[i])), edge);
        for (int i = 0; i < 4000; i++)
            ck_assert_double_le(distance_to(p, v[i]), 1.01 * edge);
    }
    array_free(&plain, &out);
}
END_TEST

/* Stars with short edges strewn in: what is left is a part of the ring in order, has no short edge, and no vertex that
   was dropped lies far from it, sharp ones apart. */
START_TEST(random_outlines)
{
    random_stream r = random_begin(51, 0, 0);
    const double edge = 0.05;
    int dropped = 0, same = 0;
    for (int round = 0; round < 2000; round++) {
        vec2 v[OUTLINE_ROOM], star[40];
        int32_t m = outline_count(&r, 5, 40), n = 0;
        outline_star(&r, vec2_make(5, 5), 4, 9, m, star);
        for (int32_t i = 0; i < m; i++) {
            v[n++] = star[i];
            for (int k = 0; k < 2 && random_unit(&r) < 0.3; k++)
                v[n++] = vec2_add(star[i], vec2_make(random_uniform(&r, -edge, edge), random_uniform(&r, -edge, edge)));
        }
        polygon p = clean(v, n, edge);
        ck_assert_int_ge(p.count, 3);
        int32_t k = 0;
        for (int32_t i = 0; i < n && k < p.count; i++)
            k += vec2_equal(v[i], p.vertex[k]);
        ck_assert_int_eq(k, p.count);
        bool sharp = false;
        for (int32_t i = 0; i < m; i++) {
            vec2 e = vec2_sub(star[i], star[(i + m - 1) % m]), f = vec2_sub(star[(i + 1) % m], star[i]);
            sharp |= vec2_dot(e, f) < -0.9 * vec2_length(e) * vec2_length(f);
        }
        for (int32_t i = 0; p.count > 3 && i < p.count; i++)
            ck_assert_double_ge(vec2_length(vec2_sub(p.vertex[(i + 1) % p.count], p.vertex[i])), edge);
        for (int32_t i = 0; !sharp && i < m; i++)
            ck_assert_double_le(distance_to(p, star[i]), 3 * edge);
        dropped += n - p.count;
        same += p.count == n;
    }
    ck_assert_int_gt(dropped, 5000);
    ck_assert_int_gt(same, 0);
    array_free(&plain, &out);
}
END_TEST

/* Two short edges in a row, of which the first alone could go without loss: the other end goes where that is better. */
START_TEST(the_other_end_of_a_short_edge)
{
    /* an arc of 1 m radius in steps of 0.04 between long legs */
    vec2 v[64];
    int32_t n = 0;
    v[n++] = vec2_make(-5, -1);
    for (int i = 0; i < 40; i++)
        v[n++] = vec2_make(real_sin(0.04 * i), -real_cos(0.04 * i));
    v[n++] = vec2_make(1, 5);
    v[n++] = vec2_make(-5, 5);
    polygon p = clean(v, n, 0.05);
    for (int32_t i = 0; i < n; i++)
        ck_assert_double_lt(distance_to(p, v[i]), 0.05);
    for (int32_t i = 0; i < p.count; i++)
        ck_assert_double_ge(vec2_length(vec2_sub(p.vertex[(i + 1) % p.count], p.vertex[i])), 0.05);
    ck_assert_int_lt(p.count, 12);
    array_free(&plain, &out);
}
END_TEST

/* A short edge between a long one and a middling one: its end on the long edge stays, from whichever side it comes, or
   half the long edge times the short one would go with it. */
START_TEST(a_short_edge_costs_no_long_one)
{
    const vec2 ring[] = {{0, -40}, {0, 0}, {-0.04, 0.03}, {-1, 1}, {-40, 1}, {-40, -40}};
    vec2 mirrored[6];
    for (int i = 0; i < 6; i++)
        mirrored[5 - i] = vec2_make(ring[i].x, -ring[i].y);
    for (int turn = 0; turn < 2; turn++) {
        polygon p = clean(turn ? mirrored : ring, 6, 0.15);
        ck_assert_int_eq(p.count, 5);
        assert_absolute(polygon_area(p), polygon_area((polygon){ring, 6}), 0.03);
    }
    array_free(&plain, &out);
}
END_TEST

START_TEST(memory_runs_out)
{
    const vec2 square[] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    for (failing_turn turn = {0}; failing_next(&turn);) {
        vec2_array result = {0};
        bool done = polygon_clean(&turn.ctx, (polygon){square, 4}, 0.1, &result);
        array_free(&turn.ctx, &result);
        turn.status = done ? FRAM_OK : FRAM_ERROR_MEMORY;
    }
}
END_TEST

/* What says whether a ring is clean: edges, then spikes of less than 8.1 degrees, inside and outside. */
START_TEST(is_clean)
{
    const vec2 triangle[] = {{0, 0}, {10, 0}, {5, 0.8}}, spike[] = {{0, 0}, {10, -0.6}, {10, 0.6}};
    const vec2 notch[] = {{0, 0}, {9, 0}, {9, 9}, {4.8, 9}, {4.5, 4}, {4.2, 9}, {0, 9}};
    ck_assert(polygon_is_clean((polygon){triangle, 3}, 1));
    ck_assert(!polygon_is_clean((polygon){triangle, 3}, 6));
    ck_assert(!polygon_is_clean((polygon){spike, 3}, 1));
    ck_assert(!polygon_is_clean((polygon){notch, 7}, 0.1));
}
END_TEST

/* Merging leaves spikes and what stands on the box, and takes short edges and straight vertices. */
START_TEST(merging_keeps_spikes)
{
    const vec2 notch[] = {{0, 0}, {5, 0}, {9, 0}, {9, 9}, {4.8, 9}, {4.5, 4}, {4.2, 9}, {0, 9}, {0, 8.99}};
    const vec2 free[] = {{0, 0}, {9, 0}, {9, 9}, {4.8, 9}, {4.5, 4}, {4.2, 9}, {0, 9}};
    const box2 box = {{0, 0}, {20, 20}};
    context_init(&plain);
    ck_assert(polygon_merge(&plain, (polygon){notch, 9}, 0.1, NULL, &out));
    ck_assert_int_eq(out.count, 7);
    ck_assert(fabs(polygon_area((polygon){out.data, 7}) - polygon_area((polygon){free, 7})) < 0.1);
    ck_assert(polygon_merge(&plain, (polygon){notch, 9}, 0.1, &box, &out));
    ck_assert_int_eq(out.count, 9);
    ck_assert(polygon_clean(&plain, (polygon){notch, 9}, 0.1, &out));
    ck_assert_int_lt(out.count, 7);
    array_free(&plain, &out);
}
END_TEST

TEST_MAIN("polygon_clean", nothing_to_clean, is_clean, merging_keeps_spikes,
          short_edges_spikes_and_straight_vertices_go, a_long_shallow_corner_stays, a_bound_is_not_under_itself,
          a_fine_circle_keeps_its_shape, random_outlines, the_other_end_of_a_short_edge, a_short_edge_costs_no_long_one,
          memory_runs_out)
