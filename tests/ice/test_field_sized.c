/* Managed ice whose floes follow a law of size. */
#include "base/pool.h"
#include "base/transcendental.h"
#include "floes_apart.h"
#include "ice/field_cells.h"
#include "ice/field_pack.h"
#include "seeds.h"

static const size_law power = {.kind = SIZE_POWER, .lo = 4, .hi = 40, .exponent = 1.7};
static const size_law lognormal = {.kind = SIZE_LOGNORMAL, .mean = 10, .deviation = 4};
static const double edge[3] = {5, 8, 14}, weight[2] = {3, 1};

static field_request request_of(const size_law *law, double concentration, uint64_t seed)
{
    return (field_request){.domain = {{-100, 50}, {200, 300}},
                           .concentration = concentration,
                           .size = law,
                           .roundness = 0.5,
                           .seed = seed};
}

/* Apart, convex, at the concentration, and of the sizes of the law. */
static void check(context *ctx, const field_request *q, const polygon_list *floes, const field_report *r)
{
    field_population_report part;
    assert_relative(r->concentration, q->concentration, 1e-6);
    assert_apart(ctx, floes);
    for (int32_t i = 0; i < r->floes; i++)
        ck_assert(polygon_is_convex(polygon_list_get(floes, i)));
    ck_assert(field_population_measure(ctx, q->size, floes, NULL, 0, &part));
    ck_assert_int_eq(part.floes, r->floes);
    ck_assert_msg(part.size_distance < 0.03, "seed %d: KS %g of %d floes", (int)q->seed, part.size_distance,
                  (int)part.floes);
    ck_assert_int_gt(part.floes, 400);
}

/* A field that is as it should be; the caller frees the floes. */
static field_report make_good(context *ctx, const field_request *q, polygon_list *floes)
{
    field_report r;
    fram_error e = {0};
    assert_ok(field_voronoi(ctx, q, floes, &r, &e), e);
    check(ctx, q, floes, &r);
    return r;
}

START_TEST(every_seed_of_a_power_law_at_98_percent)
{
    context ctx;
    context_init(&ctx);
    for (uint64_t seed = 0; seed < seeds(); seed++) {
        field_request q = request_of(&power, 0.98, seed);
        q.domain = (box2){{-100, 50}, {120, 250}};
        polygon_list floes = {0};
        make_good(&ctx, &q, &floes);
        polygon_list_free(&ctx, &floes);
    }
}
END_TEST

START_TEST(other_laws)
{
    const size_law histogram = {.kind = SIZE_HISTOGRAM, .edge = edge, .weight = weight, .bins = 2};
    const size_law *laws[2] = {&lognormal, &histogram};
    context ctx;
    context_init(&ctx);
    for (int i = 0; i < 2; i++) {
        field_request q = request_of(laws[i], 0.9, 3);
        polygon_list floes = {0};
        make_good(&ctx, &q, &floes);
        polygon_list_free(&ctx, &floes);
    }
}
END_TEST

/* A wide gap takes less of a cell than its perimeter times the width, and of small cells the more so. */
START_TEST(sizes_at_lower_concentrations)
{
    static const double concentration[2] = {0.65, 0.45};
    context ctx;
    context_init(&ctx);
    for (int i = 0; i < 2; i++) {
        field_request q = request_of(&power, concentration[i], 11);
        q.domain = (box2){{0, 0}, {270, 270}};
        q.periodic = i % 2;
        polygon_list floes = {0};
        make_good(&ctx, &q, &floes);
        polygon_list_free(&ctx, &floes);
    }
}
END_TEST

/* Cells meet their areas to a part in some hundreds, which is no other size. */
START_TEST(floes_of_one_size)
{
    const size_law law = {.kind = SIZE_CONSTANT, .mean = 8};
    context ctx;
    context_init(&ctx);
    field_request q = request_of(&law, 0.8, 1);
    q.domain = (box2){{0, 0}, {170, 170}};
    q.periodic = true;
    polygon_list floes = {0};
    make_good(&ctx, &q, &floes);
    polygon_list_free(&ctx, &floes);
}
END_TEST

/* A periodic field continues with itself: its copies beside it do not touch it. */
START_TEST(without_a_seam)
{
    context ctx;
    context_init(&ctx);
    field_request q = request_of(&power, 0.95, 5);
    q.periodic = true;
    polygon_list floes = {0};
    vec2_array ring = {0};
    int32_t count = make_good(&ctx, &q, &floes).floes, across = 0;
    /* What reaches over an edge covers the other side. */
    const vec2 period = vec2_sub(q.domain.hi, q.domain.lo);
    double cover[4], sum = 0;
    field_cover_map(&floes, period, q.domain, 4, 1, cover);
    for (int i = 0; i < 4; i++)
        sum += cover[i] / 4;
    assert_relative(sum, q.concentration, 1e-6);
    for (int32_t i = 0; i < count; i++) {
        polygon p = polygon_list_get(&floes, i);
        box2 b = polygon_bounds(p);
        across += b.lo.x < q.domain.lo.x || b.hi.x > q.domain.hi.x;
        array_clear(&ring);
        for (int32_t k = 0; k < p.count; k++)
            ck_assert(array_push(&ctx, &ring, ((vec2){p.vertex[k].x + 300, p.vertex[k].y})));
        ck_assert(polygon_list_push(&ctx, &floes, (polygon){ring.data, ring.count}));
    }
    ck_assert_int_gt(across, 5);
    assert_apart(&ctx, &floes);
    polygon_list_free(&ctx, &floes);
    array_free(&ctx, &ring);
}
END_TEST

START_TEST(same_bits_on_three_threads)
{
    context one, three;
    context_init(&one);
    context_init(&three);
    three.threads = pool_create(&three, 3);
    polygon_list a = {0}, b = {0};
    field_report r;
    fram_error e = {0};
    field_request q = request_of(&lognormal, 0.95, 9);
    assert_ok(field_voronoi(&one, &q, &a, &r, &e), e);
    assert_ok(field_voronoi(&three, &q, &b, &r, &e), e);
    ck_assert_int_eq(a.vertex.count, b.vertex.count);
    assert_array_bits(&a.vertex.data[0].x, &b.vertex.data[0].x, 2 * a.vertex.count);
    polygon_list_free(&one, &a);
    polygon_list_free(&three, &b);
    pool_free(&three, three.threads);
}
END_TEST

START_TEST(wrong_laws_are_refused)
{
    context ctx;
    context_init(&ctx);
    polygon_list floes = {0};
    field_report r;
    fram_error e = {0};
    const size_law wide = {.kind = SIZE_CONSTANT, .mean = 400}, none = {.kind = SIZE_CONSTANT};
    field_request q = request_of(&wide, 0.9, 1);
    assert_fails(field_voronoi(&ctx, &q, &floes, &r, &e), e, FRAM_ERROR_INPUT, "largest floe drawn is 400 m across");
    /* Two, and there is room for one and a half. */
    const size_law pair = {.kind = SIZE_CONSTANT, .mean = 1.128}, dust = {.kind = SIZE_CONSTANT, .mean = 1e-3};
    q = request_of(&pair, 0.95, 1);
    q.domain = (box2){{0, 0}, {1.265, 1.265}};
    assert_fails(field_voronoi(&ctx, &q, &floes, &r, &e), e, FRAM_ERROR_INPUT, "cover 1.998");
    q = request_of(&dust, 0.9, 1);
    assert_fails(field_voronoi(&ctx, &q, &floes, &r, &e), e, FRAM_ERROR_INPUT, "make the domain smaller");
    /* A floe of half the domain's width among small ones: walls leave it no cell of its area. */
    const size_law wide_law = {.kind = SIZE_POWER, .lo = 1, .hi = 60, .exponent = 1.7};
    q = request_of(&wide_law, 0.9, 1);
    q.domain = (box2){{0, 0}, {100, 100}};
    assert_fails(field_voronoi(&ctx, &q, &floes, &r, &e), e, FRAM_ERROR_INPUT, "off by");
    ck_assert_msg(strstr(e.message, "a narrower law") != NULL, "%s", e.message);
    q = request_of(&none, 0.9, 1);
    assert_fails(field_voronoi(&ctx, &q, &floes, &r, &e), e, FRAM_ERROR_INPUT, "must be positive");
    ck_assert_int_eq(polygon_list_count(&floes), 0);
}
END_TEST

START_TEST(memory_runs_out)
{
    const size_law law = {.kind = SIZE_UNIFORM, .lo = 9, .hi = 12};
    for (failing_turn turn = {0}; failing_next(&turn);) {
        polygon_list floes = {0};
        field_report r;
        field_request q = request_of(&law, 0.9, 2);
        q.domain = (box2){{0, 0}, {50, 40}};
        turn.status = field_voronoi(&turn.ctx, &q, &floes, &r, &turn.error);
        polygon_list_free(&turn.ctx, &floes);
    }
}
END_TEST

TEST_MAIN("field_sized", every_seed_of_a_power_law_at_98_percent, other_laws, sizes_at_lower_concentrations,
          floes_of_one_size, without_a_seam, same_bits_on_three_threads, wrong_laws_are_refused, memory_runs_out)
