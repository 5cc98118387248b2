/* Difference, intersection, union, repair and simplification: areas, normal form, degenerate positions, refusals. */
#include "geometry/outlines.h"

#include "geometry/overlay.h"
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

#define RING(v) ((polygon){(v), (int32_t)(sizeof(v) / sizeof *(v))})

static const vec2 square[] = {{0, 0}, {4, 0}, {4, 4}, {0, 4}};
static const vec2 right_half[] = {{2, -1}, {6, -1}, {6, 5}, {2, 5}};
static const vec2 inside[] = {{1, 1}, {2, 1}, {2, 2}, {1, 2}};
static const vec2 apart[] = {{10, 0}, {11, 0}, {11, 1}};
static const vec2 bow[] = {{0, 0}, {2, 2}, {2, 0}, {0, 2}};

/* Every ring valid, from its least vertex on, without repeated vertices; rings in order. */
static void check_normal(const polygon_list *l)
{
    for (int32_t i = 0; i < polygon_list_count(l); i++) {
        polygon p = polygon_list_get(l, i);
        char reason[OVERLAY_REASON_SIZE] = "";
        ck_assert_msg(overlay_is_valid(o, p, reason, NULL), "ring %d: %s", (int)i, reason);
        for (int32_t k = 0; k < p.count; k++) {
            ck_assert_int_le(vec2_compare(p.vertex[0], p.vertex[k]), 0);
            ck_assert(!vec2_equal(p.vertex[k], p.vertex[(k + 1) % p.count]));
        }
        if (i > 0)
            ck_assert_int_le(vec2_compare(polygon_list_get(l, i - 1).vertex[0], p.vertex[0]), 0);
    }
}

START_TEST(known_overlays)
{
    setup();
    polygon_list l = {0};
    assert_ok(overlay_difference(o, RING(square), RING(right_half), &l, &error), error);
    const vec2 left[] = {{0, 0}, {2, 0}, {2, 4}, {0, 4}};
    ck_assert_int_eq(polygon_list_count(&l), 1);
    ck_assert_int_eq(polygon_list_get(&l, 0).count, 4);
    assert_array_bits(&polygon_list_get(&l, 0).vertex->x, &left->x, 8);
    assert_ok(overlay_intersection(o, RING(square), RING(right_half), &l, &error), error); /* appends */
    const vec2 right[] = {{2, 0}, {4, 0}, {4, 4}, {2, 4}};
    ck_assert_int_eq(polygon_list_count(&l), 2);
    assert_array_bits(&polygon_list_get(&l, 1).vertex->x, &right->x, 8);
    polygon_list_clear(&l);
    assert_ok(overlay_difference(o, RING(right_half), RING(square), &l, &error), error);
    ck_assert_int_eq(polygon_list_count(&l), 1);
    assert_absolute(list_area(&l), 16, 1e-14);
    polygon_list_free(&plain, &l);
    overlay_free(o);
}
END_TEST

/* Outlines that do not meet: one of the arguments, or nothing, or a hole. */
START_TEST(outlines_that_do_not_meet)
{
    setup();
    polygon_list l = {0};
    assert_ok(overlay_difference(o, RING(square), RING(apart), &l, &error), error);
    ck_assert_int_eq(polygon_list_count(&l), 1);
    assert_array_bits(&polygon_list_get(&l, 0).vertex->x, &square->x, 8);
    polygon_list_clear(&l);
    assert_ok(overlay_intersection(o, RING(square), RING(apart), &l, &error), error);
    assert_ok(overlay_difference(o, RING(inside), RING(square), &l, &error), error);
    ck_assert_int_eq(polygon_list_count(&l), 0);
    assert_ok(overlay_intersection(o, RING(inside), RING(square), &l, &error), error);
    assert_ok(overlay_intersection(o, RING(square), RING(inside), &l, &error), error);
    ck_assert_int_eq(polygon_list_count(&l), 2);
    assert_array_bits(&polygon_list_get(&l, 0).vertex->x, &inside->x, 8);
    assert_array_bits(&polygon_list_get(&l, 1).vertex->x, &inside->x, 8);
    polygon_list_clear(&l);
    assert_ok(overlay_difference(o, RING(square), RING(inside), &l, &error), error);
    ck_assert_int_eq(polygon_list_count(&l), 2);
    assert_absolute(list_area(&l), 15, 1e-14);
    check_normal(&l);
    polygon_list_free(&plain, &l);
    overlay_free(o);
}
END_TEST

/* A common edge or vertex is no common area; a hole that touches the outline in a vertex is cut open too. */
START_TEST(outlines_that_touch)
{
    setup();
    polygon_list l = {0};
    const vec2 beside[] = {{4, 1}, {8, 1}, {8, 3}, {4, 3}}, corner[] = {{4, 4}, {5, 4}, {5, 5}};
    assert_ok(overlay_intersection(o, RING(square), RING(beside), &l, &error), error);
    assert_ok(overlay_intersection(o, RING(square), RING(corner), &l, &error), error);
    ck_assert_int_eq(polygon_list_count(&l), 0);
    const vec2 touching[] = {{0, 1}, {2, 1}, {2, 2}};
    assert_ok(overlay_difference(o, RING(square), RING(touching), &l, &error), error);
    assert_absolute(list_area(&l), 15, 1e-14);
    check_normal(&l);
    polygon_list_clear(&l);
    assert_ok(overlay_difference(o, RING(square), RING(square), &l, &error), error);
    ck_assert_int_eq(polygon_list_count(&l), 0);
    assert_ok(overlay_intersection(o, RING(square), RING(square), &l, &error), error);
    ck_assert_int_eq(polygon_list_count(&l), 1);
    polygon_list_free(&plain, &l);
    overlay_free(o);
}
END_TEST

/* The pair on which GEOS 3.11 calls the whole of b their intersection: they share an edge but for rounding. */
START_TEST(nearly_common_edge)
{
    setup();
    const vec2 a[] = {{-0x1.7e4d1bd68b8b7p+1, 0x1.20a4730b730e6p-2},
                      {0x1.1d22cf42b458dp+1, -0x1.013403988ee45p+1},
                      {0x1.23f7b67447edp-2, 0x1.7e4302095eed6p+1}};
    const vec2 b[] = {{-0x1.7e4d1bd68b8b7p+1, 0x1.20a4730b730e6p-2},
                      {0x1.1a63f6ef9c3fcp+0, 0x1.d4ce9ef35b104p+1},
                      {-0x1.9ba9811ad861bp+0, 0x1.51b5babe76a6ap+2}};
    polygon_list l = {0}, parts = {0};
    assert_ok(overlay_intersection(o, RING(a), RING(b), &l, &error), error);
    assert_absolute(list_area(&l), 0, 1e-12);
    polygon_list_clear(&l);
    assert_ok(overlay_difference(o, RING(a), RING(b), &l, &error), error);
    assert_relative(list_area(&l), polygon_area(RING(a)), 1e-12);
    polygon_list_clear(&l);
    ck_assert(polygon_list_push(&plain, &parts, RING(a)) && polygon_list_push(&plain, &parts, RING(b)));
    assert_ok(overlay_union(o, &parts, &l, &error), error);
    ck_assert_int_eq(polygon_list_count(&l), 1);
    assert_relative(list_area(&l), polygon_area(RING(a)) + polygon_area(RING(b)), 1e-12);
    polygon_list_free(&plain, &l);
    polygon_list_free(&plain, &parts);
    overlay_free(o);
}
END_TEST

/* Pairs of outlines, by kind: general, on a grid, sharing a part of an edge (its ends rounded off the edge), nearly the
   same, the same with more vertices on its edges, one half of the other. */
static void make_pair(random_stream *r, int kind, vec2 *a, int32_t *n, vec2 *b, int32_t *m)
{
    *n = outline_count(r, 4, 40);
    *m = outline_count(r, 3, 24);
    outline_star(r, vec2_make(0, 0), 7, 13, *n, a);
    outline_star(r, a[0], 4, 6, *m, b);
    vec2 e = vec2_sub(a[1], a[0]);
    int32_t far = *n / 2, k = 0;
    switch (kind) {
    case 1:
        outline_snap(a, *n, 0.25);
        outline_snap(b, *m, 0.25);
        break;
    case 2: {
        double from = random_bits(r) % 2 ? 0 : random_uniform(r, -0.5, 0.5);
        double to = random_bits(r) % 2 ? 1 : random_uniform(r, 0.6, 1.5);
        bool outward = random_bits(r) % 2;
        b[outward] = vec2_add(a[0], vec2_scale(e, from));
        b[!outward] = vec2_add(a[0], vec2_scale(e, to));
        b[2] = vec2_add(vec2_add(a[0], vec2_scale(e, 0.5)), vec2_scale(vec2_perp(e), outward ? -0.7 : 0.5));
        *m = 3;
        break;
    }
    case 3:
        for (*m = 0; *m < *n; ++*m)
            b[*m] = vec2_make(a[*m].x + random_uniform(r, -1e-12, 1e-12), a[*m].y);
        break;
    case 4:
        for (int32_t i = 0; i < *n; i++) {
            b[k++] = a[i];
            if (random_bits(r) % 2)
                b[k++] = vec2_add(a[i], vec2_scale(vec2_sub(a[(i + 1) % *n], a[i]), random_unit(r)));
        }
        *m = k;
        break;
    case 5:
        b[k++] = vec2_add(a[0], vec2_scale(e, 0.3));
        for (int32_t i = 1; i <= far; i++)
            b[k++] = a[i];
        b[k++] = vec2_add(a[far], vec2_scale(vec2_sub(a[(far + 1) % *n], a[far]), 0.6));
        b[k] = vec2_add(b[0], vec2_scale(vec2_sub(b[k - 1], b[0]), 0.37));
        *m = k + 1;
        break;
    default:
        break;
    }
}

/* Difference, intersection and union of each pair have the areas that polygon_overlap_area says, and add up. */
START_TEST(areas_balance)
{
    setup();
    polygon_list l[4] = {{{0}, {0}}}, parts = {0};
    int rounds = getenv("FRAM_TEST_SHORT") ? 100 : 500;
    for (int kind = 0; kind < 6; kind++)
        for (int round = 0; round < rounds; round++) {
            random_stream r = random_begin(71, (uint32_t)kind, (uint32_t)round);
            vec2 a[OUTLINE_ROOM], b[OUTLINE_ROOM];
            int32_t n, m;
            make_pair(&r, kind, a, &n, b, &m);
            polygon p = {a, n}, q = {b, m};
            if (!overlay_is_valid(o, p, NULL, NULL) || !overlay_is_valid(o, q, NULL, NULL))
                continue;
            polygon_list_clear(&parts);
            ck_assert(polygon_list_push(&plain, &parts, p) && polygon_list_push(&plain, &parts, q));
            for (int i = 0; i < 4; i++)
                polygon_list_clear(&l[i]);
            assert_ok(overlay_difference(o, p, q, &l[0], &error), error);
            assert_ok(overlay_intersection(o, p, q, &l[1], &error), error);
            assert_ok(overlay_difference(o, q, p, &l[2], &error), error);
            assert_ok(overlay_union(o, &parts, &l[3], &error), error);
            double area = polygon_area(p), common = polygon_overlap_area(p, q);
            assert_absolute(list_area(&l[0]) + list_area(&l[1]), area, 1e-12 * area);
            assert_absolute(list_area(&l[1]), common, 1e-12 * area);
            assert_absolute(list_area(&l[2]), polygon_area(q) - common, 1e-12 * area);
            assert_absolute(list_area(&l[3]), list_area(&l[0]) + list_area(&l[1]) + list_area(&l[2]), 1e-12 * area);
            for (int i = 0; i < 4; i++)
                check_normal(&l[i]);
        }
    for (int i = 0; i < 4; i++)
        polygon_list_free(&plain, &l[i]);
    polygon_list_free(&plain, &parts);
    overlay_free(o);
}
END_TEST

/* The same bits from another handle, after other work. */
START_TEST(same_input_same_bits)
{
    setup();
    overlay *other = overlay_create(&plain);
    polygon_list x = {0}, y = {0};
    for (int round = 0; round < 200; round++) {
        random_stream r = random_begin(72, 0, (uint32_t)round);
        vec2 a[OUTLINE_ROOM], b[OUTLINE_ROOM];
        int32_t n, m;
        make_pair(&r, 0, a, &n, b, &m);
        polygon_list_clear(&x);
        polygon_list_clear(&y);
        assert_ok(overlay_difference(o, (polygon){a, n}, (polygon){b, m}, &x, &error), error);
        if (round % 3 == 0) {
            overlay_free(other);
            other = overlay_create(&plain);
        }
        assert_ok(overlay_difference(other, (polygon){a, n}, (polygon){b, m}, &y, &error), error);
        ck_assert_int_eq(polygon_list_count(&x), polygon_list_count(&y));
        ck_assert_int_eq(x.vertex.count, y.vertex.count);
        assert_array_bits(&x.vertex.data->x, &y.vertex.data->x, 2 * x.vertex.count);
    }
    polygon_list_free(&plain, &x);
    polygon_list_free(&plain, &y);
    overlay_free(other);
    overlay_free(o);
}
END_TEST

/* One bite out of a ring, as a bending failure takes it: the remnants, and each wedge of the stencil. */
static void bite(random_stream *r, polygon p, polygon_list *out)
{
    int32_t edge = outline_count(r, 0, p.count - 1), n = 2 * outline_count(r, 2, 5);
    vec2 a = p.vertex[edge], e = vec2_sub(p.vertex[(edge + 1) % p.count], a), stencil[10];
    vec2 tip = random_unit(r) < 0.3 ? a : vec2_add(a, vec2_scale(e, random_unit(r)));
    double radius = random_uniform(r, 1, 8), turn = random_uniform(r, 0, 2 * PI);
    for (int32_t i = 0; i < n; i++) {
        double angle = turn + 2 * PI * i / n;
        stencil[i] = vec2_make(tip.x + radius * real_cos(angle), tip.y + radius * real_sin(angle));
    }
    assert_ok(overlay_difference(o, p, (polygon){stencil, n}, out, &error), error);
    for (int32_t i = 0; i < n; i++) {
        const vec2 wedge[] = {tip, stencil[i], stencil[(i + 1) % n]};
        assert_ok(overlay_intersection(o, p, RING(wedge), out, &error), error);
    }
}

/* Broken a dozen times, a sheet keeps its area; united again, its pieces fill it: thousands of edges that nearly
 * coincide. */
START_TEST(broken_and_united)
{
    setup();
    polygon_list pieces = {0}, next = {0};
    int rounds = getenv("FRAM_TEST_SHORT") ? 10 : 150;
    for (int round = 0; round < rounds; round++) {
        random_stream r = random_begin(75, 0, (uint32_t)round);
        vec2 sheet[40] = {{0, 0}, {40, 0}, {40, 30}, {0, 30}};
        polygon whole = {sheet, 4};
        if (round % 2)
            whole = outline_star(&r, vec2_make(20, 15), 12, 20, 40, sheet);
        polygon_list_clear(&pieces);
        ck_assert(polygon_list_push(&plain, &pieces, whole));
        for (int step = 0; step < 12; step++) {
            int32_t bitten = outline_count(&r, 0, polygon_list_count(&pieces) - 1);
            polygon_list_clear(&next);
            for (int32_t i = 0; i < polygon_list_count(&pieces); i++)
                if (i == bitten)
                    bite(&r, polygon_list_get(&pieces, i), &next);
                else
                    ck_assert(polygon_list_push(&plain, &next, polygon_list_get(&pieces, i)));
            polygon_list old = pieces;
            pieces = next;
            next = old;
        }
        double area = polygon_area(whole);
        assert_relative(list_area(&pieces), area, 1e-13);
        polygon_list_clear(&next);
        assert_ok(overlay_union(o, &pieces, &next, &error), error);
        assert_relative(list_area(&next), area, 1e-12);
        check_normal(&next);
    }
    polygon_list_free(&plain, &pieces);
    polygon_list_free(&plain, &next);
    overlay_free(o);
}
END_TEST

START_TEST(union_of_tiles)
{
    setup();
    polygon_list parts = {0}, l = {0};
    /* eight tiles of 3 round a ninth that is missing, then the ninth as well */
    for (int i = 0; i < 9; i++) {
        double x = 3 * ((i < 4 ? i : i + 1) % 3), y = 3 * floor((i < 4 ? i : i + 1) / 3.0);
        if (i == 8)
            x = y = 3;
        const vec2 tile[] = {{x, y}, {x + 3, y}, {x + 3, y + 3}, {x, y + 3}};
        ck_assert(polygon_list_push(&plain, &parts, RING(tile)));
        if (i < 7)
            continue;
        polygon_list_clear(&l);
        assert_ok(overlay_union(o, &parts, &l, &error), error);
        ck_assert_int_eq(polygon_list_count(&l), i == 7 ? 2 : 1);
        assert_absolute(list_area(&l), 9 * (i + 1), 1e-12);
        check_normal(&l);
    }
    polygon_list_clear(&parts);
    polygon_list_clear(&l);
    assert_ok(overlay_union(o, &parts, &l, &error), error);
    ck_assert_int_eq(polygon_list_count(&l), 0);
    ck_assert(polygon_list_push(&plain, &parts, RING(square)) && polygon_list_push(&plain, &parts, RING(apart)));
    assert_ok(overlay_union(o, &parts, &l, &error), error);
    ck_assert_int_eq(polygon_list_count(&l), 2);
    ck_assert(polygon_list_push(&plain, &parts, RING(bow)));
    assert_fails(overlay_union(o, &parts, &l, &error), error, FRAM_ERROR_INPUT, "part 2");
    ck_assert_int_eq(polygon_list_count(&l), 2);
    polygon_list_free(&plain, &parts);
    polygon_list_free(&plain, &l);
    overlay_free(o);
}
END_TEST

START_TEST(validity_and_its_reasons)
{
    setup();
    char reason[OVERLAY_REASON_SIZE];
    vec2 place;
    ck_assert(overlay_is_valid(o, RING(square), reason, &place));
    ck_assert(!overlay_is_valid(o, RING(bow), reason, &place));
    ck_assert_str_eq(reason, "edges 0 and 2 meet at (1, 1)");
    assert_vec2_close(place, vec2_make(1, 1), 1e-15);
    const vec2 touch[] = {{0, 0}, {4, 0}, {4, 4}, {2, 0}, {0, 4}};
    ck_assert(!overlay_is_valid(o, RING(touch), reason, &place));
    assert_vec2_close(place, vec2_make(2, 0), 0);
    const vec2 clockwise[] = {{0, 0}, {0, 1}, {1, 1}};
    ck_assert(!overlay_is_valid(o, RING(clockwise), reason, &place));
    ck_assert_str_eq(reason, "the vertices run clockwise");
    const vec2 line[] = {{0, 0}, {1, 1}, {2, 2}};
    ck_assert(!overlay_is_valid(o, RING(line), reason, NULL));
    ck_assert_str_eq(reason, "no area");
    ck_assert(!overlay_is_valid(o, (polygon){square, 2}, reason, &place));
    ck_assert_str_eq(reason, "fewer than 3 vertices");
    ck_assert(!overlay_is_valid(o, (polygon){NULL, 0}, NULL, &place));
    const vec2 nan[] = {{0, 0}, {1, (double)NAN}, {2, 2}};
    ck_assert(!overlay_is_valid(o, RING(nan), reason, NULL));
    ck_assert_str_eq(reason, "vertex 1 is not finite");
    polygon_list l = {0};
    assert_fails(overlay_difference(o, RING(square), RING(bow), &l, &error), error, FRAM_ERROR_INPUT, "the clip");
    assert_fails(overlay_difference(o, RING(bow), RING(square), &l, &error), error, FRAM_ERROR_INPUT, "the subject");
    assert_fails(overlay_intersection(o, RING(nan), RING(square), &l, &error), error, FRAM_ERROR_INPUT, "finite");
    ck_assert_int_eq(polygon_list_count(&l), 0);
    overlay_free(o);
    overlay_free(NULL);
}
END_TEST

/* On rings of a coarse grid, which cross, touch and double back in every way, GEOS has the same opinion. */
START_TEST(validity_as_geos_sees_it)
{
    setup();
    GEOSContextHandle_t geos = GEOS_init_r();
    random_stream r = random_begin(73, 0, 0);
    int valid = 0, tried = 0;
    for (int round = 0; round < 20000; round++) {
        vec2 v[16];
        int32_t n = outline_count(&r, 3, 7);
        for (int32_t i = 0; i < n; i++)
            v[i] = vec2_make(outline_count(&r, 0, 4), outline_count(&r, 0, 4));
        if (polygon_area((polygon){v, n}) <= 0)
            continue;
        tried++;
        v[n] = v[0];
        GEOSCoordSequence *s = GEOSCoordSeq_copyFromBuffer_r(geos, &v[0].x, (unsigned)n + 1, 0, 0);
        GEOSGeometry *shape = GEOSGeom_createPolygon_r(geos, GEOSGeom_createLinearRing_r(geos, s), NULL, 0);
        bool ours = overlay_is_valid(o, (polygon){v, n}, NULL, NULL);
        ck_assert_int_eq(ours, GEOSisValid_r(geos, shape) == 1);
        valid += ours;
        GEOSGeom_destroy_r(geos, shape);
    }
    ck_assert_int_gt(valid, 2000);
    ck_assert_int_gt(tried - valid, 2000);
    GEOS_finish_r(geos);
    overlay_free(o);
}
END_TEST

static void expect_repair(polygon p, int32_t rings, double area)
{
    polygon_list l = {0};
    assert_ok(overlay_make_valid(o, p, &l, &error), error);
    ck_assert_int_eq(polygon_list_count(&l), rings);
    assert_absolute(list_area(&l), area, 1e-12);
    check_normal(&l);
    polygon_list_free(&plain, &l);
}

START_TEST(repair)
{
    setup();
    expect_repair(RING(square), 1, 16);
    expect_repair(RING(bow), 2, 2);
    const vec2 clockwise[] = {{0, 0}, {0, 4}, {4, 4}, {4, 0}};
    expect_repair(RING(clockwise), 1, 16);
    const vec2 spike[] = {{0, 0}, {4, 0}, {4, 4}, {2, 4}, {2, 6}, {2, 4}, {0, 4}};
    expect_repair(RING(spike), 1, 16);
    const vec2 line[] = {{0, 0}, {1, 1}, {2, 2}, {1, 1}};
    expect_repair(RING(line), 0, 0);
    expect_repair((polygon){square, 2}, 0, 0);
    /* a ring that runs round a hole and back along a seam: the hole is filled */
    const vec2 seam[] = {{0, 0}, {6, 0}, {6, 6}, {0, 6}, {0, 0}, {2, 2}, {2, 4}, {4, 4}, {4, 2}, {2, 2}};
    expect_repair(RING(seam), 1, 36);
    vec2 pentagram[5];
    for (int i = 0; i < 5; i++)
        pentagram[i] = vec2_make(real_cos(4 * PI * i / 5), real_sin(4 * PI * i / 5));
    polygon_list l = {0};
    assert_ok(overlay_make_valid(o, RING(pentagram), &l, &error), error);
    ck_assert_int_eq(polygon_list_count(&l), 1); /* the pentagon in the middle is ice, wound round twice */
    ck_assert_int_eq(polygon_list_get(&l, 0).count, 10);
    const vec2 nan[] = {{0, 0}, {1, (double)NAN}, {2, 2}};
    assert_fails(overlay_make_valid(o, RING(nan), &l, &error), error, FRAM_ERROR_INPUT, "vertex 1");
    polygon_list_free(&plain, &l);
    overlay_free(o);
}
END_TEST

/* Random rings that cross themselves: what comes out is valid and lies within the ring's bounds. */
START_TEST(repair_of_random_rings)
{
    setup();
    random_stream r = random_begin(74, 0, 0);
    polygon_list l = {0};
    for (int round = 0; round < 1000; round++) {
        vec2 v[16];
        int32_t n = outline_count(&r, 3, 12);
        for (int32_t i = 0; i < n; i++)
            v[i] = vec2_make(random_uniform(&r, 0, 8), random_uniform(&r, 0, 8));
        if (round % 2)
            outline_snap(v, n, 1);
        polygon_list_clear(&l);
        assert_ok(overlay_make_valid(o, (polygon){v, n}, &l, &error), error);
        check_normal(&l);
        ck_assert_double_le(list_area(&l), 64);
        ck_assert_double_ge(list_area(&l), fabs(polygon_area((polygon){v, n})) / n - 1e-9);
        for (int32_t i = 0; i < polygon_list_count(&l); i++)
            for (int32_t k = 0; k < i; k++)
                assert_absolute(polygon_overlap_area(polygon_list_get(&l, i), polygon_list_get(&l, k)), 0, 1e-12);
    }
    polygon_list_free(&plain, &l);
    overlay_free(o);
}
END_TEST

START_TEST(simplification)
{
    setup();
    vec2 v[200];
    vec2_array out = {0};
    for (int i = 0; i < 200; i++)
        v[i] = vec2_make(10 * real_cos(2 * PI * i / 200), 10 * real_sin(2 * PI * i / 200));
    assert_ok(overlay_simplify(o, RING(v), 0.1, &out, &error), error);
    polygon p = {out.data, out.count};
    ck_assert_int_lt(p.count, 40);
    ck_assert(overlay_is_valid(o, p, NULL, NULL));
    for (int i = 0; i < 200; i++)
        ck_assert_double_le(vec2_length(vec2_sub(polygon_nearest_boundary(p, v[i], NULL), v[i])), 0.1 + 1e-12);
    assert_ok(overlay_simplify(o, RING(v), 0, &out, &error), error);
    ck_assert_int_eq(out.count, 200);
    assert_ok(overlay_simplify(o, RING(v), 1e6, &out, &error), error);
    ck_assert_int_ge(out.count, 3);
    assert_fails(overlay_simplify(o, RING(v), -1, &out, &error), error, FRAM_ERROR_INPUT, "tolerance");
    assert_fails(overlay_simplify(o, RING(bow), 1, &out, &error), error, FRAM_ERROR_INPUT, "edges 0 and 2");
    array_free(&plain, &out);
    overlay_free(o);
}
END_TEST

/* Moved inwards: mitred at hollow corners, in as many parts as are left, whatever a convex ring's lines give. */
START_TEST(insets)
{
    setup();
    polygon_list l = {0};
    const vec2 notched[] = {{-5, -5}, {5, -5}, {5, 5}, {-5, 5}, {-5, 1}, {-3, 1}, {-3, -1}, {-5, -1}};
    for (int far = 0; far < 2; far++) {
        vec2 p[8];
        for (int i = 0; i < 8; i++)
            p[i] = vec2_add(notched[i], vec2_scale((vec2){7e5, -3e5}, far));
        polygon_list_clear(&l);
        assert_ok(overlay_inset(o, RING(p), 0.5, &l, &error), error);
        ck_assert_int_eq(polygon_list_count(&l), 1);
        ck_assert_int_eq(polygon_list_get(&l, 0).count, 8);
        assert_absolute(list_area(&l), 9 * 9 - 2 * 3, far ? 1e-8 : 1e-13);
        check_normal(&l);
    }
    /* The notch meets the far side, and two arms are left. */
    polygon_list_clear(&l);
    const vec2 fork[] = {{0, 0}, {6, 0}, {6, 2}, {1, 2}, {1, 3}, {6, 3}, {6, 5}, {0, 5}};
    assert_ok(overlay_inset(o, RING(fork), 0.6, &l, &error), error);
    ck_assert_int_eq(polygon_list_count(&l), 2);
    assert_absolute(list_area(&l), 2 * 4.8 * 0.8, 1e-13);
    check_normal(&l);
    polygon_list_clear(&l);
    assert_ok(overlay_inset(o, RING(square), 2, &l, &error), error);
    ck_assert_int_eq(polygon_list_count(&l), 0);
    assert_fails(overlay_inset(o, RING(square), 0, &l, &error), error, FRAM_ERROR_INPUT, "not positive");
    assert_fails(overlay_inset(o, RING(bow), 1, &l, &error), error, FRAM_ERROR_INPUT, "edges 0 and 2");
    polygon_list_free(&plain, &l);
    overlay_free(o);
}
END_TEST

typedef fram_status (*call)(overlay *, polygon_list *, vec2_array *, fram_error *);

static fram_status call_difference(overlay *h, polygon_list *l, vec2_array *v, fram_error *e)
{
    (void)v;
    return overlay_difference(h, RING(square), RING(right_half), l, e);
}
static fram_status call_hole(overlay *h, polygon_list *l, vec2_array *v, fram_error *e)
{
    (void)v;
    return overlay_difference(h, RING(square), RING(inside), l, e);
}
static fram_status call_touching_hole(overlay *h, polygon_list *l, vec2_array *v, fram_error *e)
{
    static const vec2 touching[] = {{0, 1}, {2, 1}, {2, 2}};
    (void)v;
    return overlay_difference(h, RING(square), RING(touching), l, e);
}
static fram_status call_intersection(overlay *h, polygon_list *l, vec2_array *v, fram_error *e)
{
    (void)v;
    fram_status status = overlay_intersection(h, RING(square), RING(inside), l, e);
    return status == FRAM_OK ? overlay_intersection(h, RING(square), RING(right_half), l, e) : status;
}
static fram_status call_union(overlay *h, polygon_list *l, vec2_array *v, fram_error *e)
{
    (void)v;
    polygon_list parts = {0};
    ck_assert(polygon_list_push(&plain, &parts, RING(square)) && polygon_list_push(&plain, &parts, RING(right_half)));
    fram_status status = overlay_union(h, &parts, l, e);
    polygon_list_free(&plain, &parts);
    return status;
}
static fram_status call_inset(overlay *h, polygon_list *l, vec2_array *v, fram_error *e)
{
    (void)v;
    return overlay_inset(h, RING(square), 0.5, l, e);
}
static fram_status call_repair(overlay *h, polygon_list *l, vec2_array *v, fram_error *e)
{
    (void)v;
    return overlay_make_valid(h, RING(bow), l, e);
}
static fram_status call_simplify(overlay *h, polygon_list *l, vec2_array *v, fram_error *e)
{
    (void)l;
    return overlay_simplify(h, RING(square), 0.1, v, e);
}

START_TEST(memory_runs_out)
{
    const call calls[] = {call_difference, call_hole,   call_touching_hole, call_intersection,
                          call_union,      call_repair, call_simplify,      call_inset};
    context_init(&plain);
    for (size_t c = 0; c < sizeof calls / sizeof *calls; c++)
        for (failing_turn turn = {0}; failing_next(&turn);) {
            polygon_list l = {0};
            vec2_array v = {0};
            overlay *h = overlay_create(&turn.ctx);
            turn.status = h ? calls[c](h, &l, &v, &error) : FRAM_ERROR_MEMORY;
            if (h && turn.status != FRAM_OK)
                ck_assert_int_eq(error.status, FRAM_ERROR_MEMORY);
            overlay_free(h);
            polygon_list_free(&turn.ctx, &l);
            array_free(&turn.ctx, &v);
        }
}
END_TEST

TEST_MAIN("overlay", known_overlays, outlines_that_do_not_meet, outlines_that_touch, nearly_common_edge, areas_balance,
          same_input_same_bits, broken_and_united, union_of_tiles, validity_and_its_reasons, validity_as_geos_sees_it,
          repair, repair_of_random_rings, simplification, insets, memory_runs_out)
