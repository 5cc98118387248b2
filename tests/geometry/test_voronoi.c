/* Voronoi and power cells: against clipping by every bisector, on lattices and crowds, and what is refused. */
#include "geometry/outlines.h"

#include "geometry/voronoi.h"

static context plain;
static fram_error error;
static const box2 box = {{-10, 5}, {30, 25}};

static void scatter(random_stream *r, vec2 *site, int32_t n)
{
    for (int32_t i = 0; i < n; i++)
        site[i] = vec2_make(random_uniform(r, box.lo.x, box.hi.x), random_uniform(r, box.lo.y, box.hi.y));
}

/* The cell from its definition: the box clipped by the bisectors to all other sites. */
static void cell_by_definition(const vec2 *site, const double *weight, int32_t n, int32_t i, vec2_array *out)
{
    const vec2 corner[] = {box.lo, {box.hi.x, box.lo.y}, box.hi, {box.lo.x, box.hi.y}};
    vec2_array cut = {0};
    array_clear(out);
    for (int k = 0; k < 4; k++)
        ck_assert(array_push(&plain, out, corner[k]));
    for (int32_t j = 0; j < n; j++) {
        vec2 e = vec2_sub(site[j], site[i]);
        double d = (vec2_dot(site[j], site[j]) - vec2_dot(site[i], site[i])) / 2;
        if (j == i)
            continue;
        if (weight)
            d += (weight[i] - weight[j]) / 2;
        ck_assert(polygon_clip_half_plane(&plain, (polygon){out->data, out->count}, e, d, &cut));
        vec2_array t = *out;
        *out = cut;
        cut = t;
    }
    array_free(&plain, &cut);
}

/* `tolerance` [m2] is that of the definition, which loses digits where sites are close. */
static void check_cells(const vec2 *site, const double *weight, int32_t n, double tolerance)
{
    polygon_list l = {0};
    vec2_array cell = {0};
    assert_ok(voronoi_cells(&plain, site, weight, n, box, &l, &error), error);
    ck_assert_int_eq(polygon_list_count(&l), n);
    assert_relative(list_area(&l), 800, 1e-13);
    for (int32_t i = 0; i < n; i++) {
        polygon p = polygon_list_get(&l, i);
        cell_by_definition(site, weight, n, i, &cell);
        double area = polygon_area((polygon){cell.data, cell.count});
        assert_absolute(polygon_area(p), area, tolerance);
        if (p.count == 0)
            continue;
        ck_assert(polygon_is_convex(p));
        assert_absolute(polygon_overlap_area(p, (polygon){cell.data, cell.count}), area, tolerance);
        if (!weight)
            ck_assert(polygon_contains(p, site[i]));
        for (int32_t k = 0; k < p.count; k++)
            ck_assert(p.vertex[k].x >= box.lo.x && p.vertex[k].x <= box.hi.x && p.vertex[k].y >= box.lo.y &&
                      p.vertex[k].y <= box.hi.y);
    }
    polygon_list_free(&plain, &l);
    array_free(&plain, &cell);
}

START_TEST(cells_as_defined)
{
    context_init(&plain);
    random_stream r = random_begin(101, 0, 0);
    for (int round = 0; round < 30; round++) {
        vec2 site[300];
        int32_t n = outline_count(&r, 1, round < 20 ? 20 : 300);
        scatter(&r, site, n);
        check_cells(site, NULL, n, 1e-11);
    }
}
END_TEST

START_TEST(power_cells_as_defined)
{
    context_init(&plain);
    random_stream r = random_begin(102, 0, 0);
    int empty = 0;
    for (int round = 0; round < 30; round++) {
        vec2 site[200];
        double weight[200];
        int32_t n = outline_count(&r, 2, round < 20 ? 20 : 200);
        scatter(&r, site, n);
        for (int32_t i = 0; i < n; i++)
            weight[i] = random_uniform(&r, 0, round % 3 == 0 ? 1 : 300);
        check_cells(site, weight, n, 1e-11);
        polygon_list l = {0};
        assert_ok(voronoi_cells(&plain, site, weight, n, box, &l, &error), error);
        for (int32_t i = 0; i < n; i++)
            empty += polygon_list_get(&l, i).count == 0;
        polygon_list_free(&plain, &l);
    }
    ck_assert_int_gt(empty, 50);
}
END_TEST

/* Sites all in one corner, on a line, and a few far from a crowd. */
START_TEST(crowds_and_lines)
{
    context_init(&plain);
    random_stream r = random_begin(103, 0, 0);
    vec2 site[200];
    for (int32_t i = 0; i < 200; i++)
        site[i] = vec2_make(random_uniform(&r, -10, -9.9), random_uniform(&r, 5, 5.1));
    check_cells(site, NULL, 200, 1e-8);
    site[0] = box.hi;
    site[1] = vec2_make(box.hi.x, box.lo.y);
    site[2] = vec2_make(3, 25);
    check_cells(site, NULL, 200, 1e-8);
    for (int32_t i = 0; i < 200; i++)
        site[i] = vec2_make(random_uniform(&r, -10, 30), 12);
    check_cells(site, NULL, 200, 1e-8);
    for (int32_t i = 0; i < 200; i++)
        site[i] = vec2_make(-10 + 0.1 * (i + 1), 5 + 0.05 * (i + 1));
    check_cells(site, NULL, 200, 1e-8);
}
END_TEST

/* Four cells meet in a point: still squares, and not octagons with edges of rounding. */
START_TEST(lattice_gives_squares)
{
    context_init(&plain);
    vec2 site[50 * 25];
    polygon_list l = {0};
    for (int j = 0; j < 25; j++)
        for (int i = 0; i < 50; i++)
            site[50 * j + i] = vec2_make(-10 + 0.8 * (i + 0.5), 5 + 0.8 * (j + 0.5));
    assert_ok(voronoi_cells(&plain, site, NULL, 1250, box, &l, &error), error);
    for (int32_t i = 0; i < 1250; i++) {
        ck_assert_int_eq(polygon_list_get(&l, i).count, 4);
        assert_absolute(polygon_area(polygon_list_get(&l, i)), 0.64, 1e-12);
    }
    polygon_list_free(&plain, &l);
}
END_TEST

/* As many as a large field has; equal weights of any value change nothing. */
START_TEST(many_sites_tile_the_box)
{
    context_init(&plain);
    enum { MANY = 20000 };
    vec2 *site = malloc(MANY * sizeof *site);
    double *weight = malloc(MANY * sizeof *weight);
    random_stream r = random_begin(104, 0, 0);
    polygon_list l = {0}, weighted = {0};
    scatter(&r, site, MANY);
    for (int i = 0; i < MANY; i++)
        weight[i] = 0.5;
    assert_ok(voronoi_cells(&plain, site, NULL, MANY, box, &l, &error), error);
    assert_ok(voronoi_cells(&plain, site, weight, MANY, box, &weighted, &error), error);
    assert_relative(list_area(&l), 800, 1e-13);
    ck_assert_int_eq(l.vertex.count, weighted.vertex.count);
    assert_array_bits(&l.vertex.data->x, &weighted.vertex.data->x, 2 * l.vertex.count);
    ck_assert_int_lt(l.vertex.count, 6 * MANY); /* Euler: under six neighbours on average */
    polygon_list_free(&plain, &l);
    polygon_list_free(&plain, &weighted);
    free(site);
    free(weight);
}
END_TEST

START_TEST(what_is_refused)
{
    context_init(&plain);
    vec2 site[] = {{0, 10}, {5, 10}, {9, 20}};
    double weight[] = {0, 1, (double)NAN};
    polygon_list l = {0};
    assert_ok(voronoi_cells(&plain, site, NULL, 0, box, &l, &error), error);
    ck_assert_int_eq(polygon_list_count(&l), 0);
    assert_ok(voronoi_cells(&plain, site, NULL, 3, box, &l, &error), error);
    assert_fails(voronoi_cells(&plain, site, weight, 3, box, &l, &error), error, FRAM_ERROR_INPUT, "weight");
    ck_assert_str_eq(error.key, "site 2");
    site[1] = site[0];
    assert_fails(voronoi_cells(&plain, site, NULL, 3, box, &l, &error), error, FRAM_ERROR_INPUT, "same place");
    ck_assert_str_eq(error.key, "site 1");
    site[1] = vec2_make(31, 10);
    assert_fails(voronoi_cells(&plain, site, NULL, 3, box, &l, &error), error, FRAM_ERROR_INPUT, "outside");
    site[1] = vec2_make((double)NAN, 10);
    assert_fails(voronoi_cells(&plain, site, NULL, 3, box, &l, &error), error, FRAM_ERROR_INPUT, "outside");
    box2 flat = {{0, 0}, {10, 0}};
    assert_fails(voronoi_cells(&plain, site, NULL, 3, flat, &l, &error), error, FRAM_ERROR_INPUT, "box");
    ck_assert_int_eq(polygon_list_count(&l), 3); /* what it held before */
    polygon_list_free(&plain, &l);
}
END_TEST

START_TEST(memory_runs_out)
{
    const vec2 site[] = {{0, 10}, {5, 10}, {9, 20}, {9, 21}, {2, 7}};
    for (failing_turn turn = {0}; failing_next(&turn);) {
        polygon_list l = {0};
        turn.status = voronoi_cells(&turn.ctx, site, NULL, 5, box, &l, &error);
        ck_assert_int_eq(polygon_list_count(&l), turn.status == FRAM_OK ? 5 : 0);
        polygon_list_free(&turn.ctx, &l);
    }
}
END_TEST

TEST_MAIN("voronoi", cells_as_defined, power_cells_as_defined, crowds_and_lines, lattice_gives_squares,
          many_sites_tile_the_box, what_is_refused, memory_runs_out)
