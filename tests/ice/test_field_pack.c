/* Packed fields: what was asked for is what is measured on the outlines, seed by seed. */
#include "base/pool.h"
#include "base/transcendental.h"
#include "ice/field_measure.h"
#include "ice/field_pack.h"
#include "seeds.h"
#include "testing.h"

#include <stdlib.h>

/* Seeds of a kind: a few where everything is slow. */

/* A field and everything that came with it. */
typedef struct made_field {
    context ctx;
    overlay *plane;
    polygon_list outlines;
    field_floe_array floes;
    field_population_report parts[4];
    field_packed_report report;
    fram_error error;
} made_field;

static const size_law power = {.kind = SIZE_POWER, .lo = 4, .hi = 40, .exponent = 1.7};
static const size_law nearly_equal = {.kind = SIZE_UNIFORM, .lo = 9, .hi = 11};
static const shape_law convex = {.least_vertices = 5, .most_vertices = 9, .elongation = 1.5};

static fram_status make(made_field *f, const field_packed_request *r)
{
    *f = (made_field){0};
    context_init(&f->ctx);
    f->plane = overlay_create(&f->ctx);
    ck_assert_ptr_nonnull(f->plane);
    return field_packed(&f->ctx, f->plane, r, &f->outlines, &f->floes, f->parts, &f->report, &f->error);
}

static void drop(made_field *f)
{
    polygon_list_free(&f->ctx, &f->outlines);
    array_free(&f->ctx, &f->floes);
    overlay_free(f->plane);
}

static field_packed_request request_of(const field_population *p, int32_t count, double concentration, double side,
                                       uint64_t seed)
{
    return (field_packed_request){.domain = {{0, 0}, {side, side}},
                                  .concentration = concentration,
                                  .populations = p,
                                  .population_count = count,
                                  .seed = seed};
}

static double total_area(const polygon_list *l)
{
    double area = 0;
    for (int32_t i = 0; i < polygon_list_count(l); i++)
        area += polygon_area(polygon_list_get(l, i));
    return area;
}

/* Everything that a packed field promises, measured anew. */
static void check_promises(made_field *f, const field_packed_request *r)
{
    double overlap, side = r->domain.hi.x, area = total_area(&f->outlines);
    assert_ok(field_largest_overlap(&f->ctx, f->plane, &f->outlines, r->present, &overlap, &f->error), f->error);
    ck_assert_msg(overlap < 1e-3, "overlap %g m", overlap);
    assert_relative(f->report.field.concentration, r->concentration, 0.005);
    if (!r->present)
        assert_relative(area / f->report.field.free_area, f->report.field.concentration, 1e-9);
    ck_assert_double_lt(f->report.area_change, 1e-9);
    ck_assert_int_eq(f->report.vertex_changes, 0);
    ck_assert_int_eq(f->report.field.floes, polygon_list_count(&f->outlines));
    for (int32_t p = 0; p < r->population_count; p++)
        ck_assert_msg(f->parts[p].size_distance <= 0.02, "population %d: KS %g", p, f->parts[p].size_distance);
    for (int32_t i = 0; i < polygon_list_count(&f->outlines); i++) {
        box2 b = polygon_bounds(polygon_list_get(&f->outlines, i));
        if (!r->periodic_x)
            ck_assert_msg(b.lo.x > -1e-3 && b.hi.x < side + 1e-3, "floe %d leaves the domain", i);
    }
}

START_TEST(wide_sizes_at_90_percent_for_every_seed)
{
    const field_population p = {.share = 1, .size = power, .shape = convex};
    for (uint64_t seed = 1; seed <= seeds(); seed++) {
        made_field f;
        field_packed_request r = request_of(&p, 1, 0.9, 135, seed);
        r.periodic_x = r.periodic_y = true; /* without the water that walls keep: as in a large field */
        assert_ok(make(&f, &r), f.error);
        check_promises(&f, &r);
        drop(&f);
    }
}
END_TEST

START_TEST(wide_sizes_at_85_percent_between_walls_for_every_seed)
{
    const field_population p = {.share = 1, .size = power, .shape = convex};
    for (uint64_t seed = 1; seed <= seeds(); seed++) {
        made_field f;
        field_packed_request r = request_of(&p, 1, 0.85, 120, seed);
        assert_ok(make(&f, &r), f.error);
        check_promises(&f, &r);
        drop(&f);
    }
}
END_TEST

START_TEST(nearly_equal_sizes_at_80_percent_for_every_seed)
{
    const field_population p = {.share = 1, .size = nearly_equal, .shape = convex};
    for (uint64_t seed = 1; seed <= seeds(); seed++) {
        made_field f;
        field_packed_request r = request_of(&p, 1, 0.8, 150, seed);
        assert_ok(make(&f, &r), f.error);
        check_promises(&f, &r);
        drop(&f);
    }
}
END_TEST

/* An arrow, a boomerang, a rough rectangle. */
static bool add_templates(context *ctx, polygon_list *out)
{
    static const vec2 arrow[] = {{0, 0}, {3, -1}, {2.2, 1}, {3, 3}};
    static const vec2 boomerang[] = {{0, 0}, {4, 0}, {4, 1}, {1.2, 1.2}, {1, 4}, {0, 4}};
    static const vec2 rough[] = {{0, 0},   {1, 0.2},   {2, -0.1},  {3, 0.1}, {3.1, 1},
                                 {2.9, 2}, {1.5, 1.9}, {0.1, 2.1}, {-0.1, 1}};
    return polygon_list_push(ctx, out, (polygon){arrow, 4}) && polygon_list_push(ctx, out, (polygon){boomerang, 6}) &&
           polygon_list_push(ctx, out, (polygon){rough, 9});
}

START_TEST(concave_templates_at_75_percent_for_every_seed)
{
    context ctx;
    context_init(&ctx);
    polygon_list templates = {0};
    ck_assert(add_templates(&ctx, &templates));
    const field_population p = {.share = 1, .size = power, .shape = {.templates = &templates}};
    for (uint64_t seed = 1; seed <= seeds(); seed++) {
        made_field f;
        field_packed_request r = request_of(&p, 1, 0.75, 110, seed);
        assert_ok(make(&f, &r), f.error);
        check_promises(&f, &r);
        drop(&f);
    }
    polygon_list_free(&ctx, &templates);
}
END_TEST

START_TEST(brash_at_80_percent_for_every_seed)
{
    const field_population p = {.share = 1,
                                .size = {.kind = SIZE_LOGNORMAL, .mean = 0.8, .deviation = 0.4, .lo = 0.3, .hi = 2},
                                .shape = {4, 7, 1.5, NULL}};
    for (uint64_t seed = 1; seed <= seeds(); seed++) {
        made_field f;
        field_packed_request r = request_of(&p, 1, 0.8, 15, seed);
        assert_ok(make(&f, &r), f.error);
        ck_assert_int_gt(f.report.field.floes, 200);
        check_promises(&f, &r);
        drop(&f);
    }
}
END_TEST

START_TEST(mixed_populations_at_85_percent_for_every_seed)
{
    const field_population p[3] = {
        {.share = 3, .size = {.kind = SIZE_LOGNORMAL, .mean = 12, .deviation = 4, .lo = 5, .hi = 40}, .shape = convex},
        {.share = 2, .size = power, .shape = convex},
        {.share = 1, .size = {.kind = SIZE_CONSTANT, .mean = 3}, .shape = {4, 6, 1.3, NULL}}};
    for (uint64_t seed = 1; seed <= seeds(); seed++) {
        made_field f;
        field_packed_request r = request_of(p, 3, 0.85, 130, seed);
        assert_ok(make(&f, &r), f.error);
        check_promises(&f, &r);
        drop(&f);
    }
}
END_TEST

START_TEST(populations_keep_their_shares_and_laws)
{
    const field_population p[3] = {
        {.share = 3, .size = {.kind = SIZE_LOGNORMAL, .mean = 10, .deviation = 4}, .shape = convex},
        {.share = 1, .size = {.kind = SIZE_CONSTANT, .mean = 3}, .shape = {4, 4, 1, NULL}},
        {.share = 1, .size = nearly_equal, .shape = {6, 12, 1.2, NULL}},
    };
    made_field f;
    field_packed_request r = request_of(p, 3, 0.8, 300, 7);
    assert_ok(make(&f, &r), f.error);
    check_promises(&f, &r);
    double area = total_area(&f.outlines);
    for (int32_t k = 0; k < 3; k++)
        assert_absolute(f.parts[k].area / area, p[k].share / 5, 0.005);
    for (int32_t i = 0; i < f.floes.count; i++)
        if (f.floes.data[i].population == 1)
            ck_assert_int_eq(polygon_list_get(&f.outlines, i).count, 4);
    drop(&f);
}
END_TEST

/* Two floes of 40 m are 2513 m2, three 3770. */
START_TEST(what_whole_floes_of_one_size_miss_others_make_up)
{
    const size_law large = {.kind = SIZE_CONSTANT, .mean = 40};
    const size_law small[] = {{.kind = SIZE_POWER, .lo = 4, .hi = 12, .exponent = 1.5},
                              {.kind = SIZE_CONSTANT, .mean = 4}};
    static const struct {
        double share, concentration;
        int32_t floes; /* large ones */
    } cases[] = {{1, 0.4, 2}, {1, 0.28, 2}, {19, 0.22, 2}, {19, 0.243, 2}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        for (int k = 0; k < 4; k++) {
            field_population p[2] = {{.share = 1, .size = small[k / 2], .shape = convex},
                                     {.share = cases[i].share, .size = large, .shape = convex}};
            const field_population first = p[0];
            p[0] = k % 2 ? p[1] : first, p[1] = k % 2 ? first : p[1];
            made_field f;
            field_packed_request r = request_of(p, 2, cases[i].concentration, 120, 2);
            assert_ok(make(&f, &r), f.error);
            assert_relative(f.report.field.concentration, r.concentration, 0.003);
            ck_assert_int_eq(f.parts[k % 2 ? 0 : 1].floes, cases[i].floes);
            drop(&f);
        }
}
END_TEST

START_TEST(the_field_flows_around_zones_and_floes_that_are_there)
{
    context ctx;
    context_init(&ctx);
    static const vec2 ship[] = {{60, 90}, {130, 90}, {150, 100}, {130, 110}, {60, 110}};
    static const vec2 floe[] = {{20, 20}, {60, 20}, {60, 30}, {30, 30}, {30, 60}, {20, 60}};
    polygon_list zones = {0}, present = {0};
    ck_assert(polygon_list_push(&ctx, &zones, (polygon){ship, 5}) &&
              polygon_list_push(&ctx, &present, (polygon){floe, 6}));
    const field_population p = {.share = 1, .size = power, .shape = convex};
    made_field f;
    field_packed_request r = request_of(&p, 1, 0.85, 200, 3);
    r.keep_out = &zones;
    r.keep_out_margin = 2;
    r.present = &present;
    assert_ok(make(&f, &r), f.error);
    check_promises(&f, &r);
    assert_relative((total_area(&f.outlines) + 700) / f.report.field.free_area, f.report.field.concentration, 1e-9);
    for (int32_t i = 0; i < polygon_list_count(&f.outlines); i++) {
        polygon q = polygon_list_get(&f.outlines, i);
        ck_assert_double_lt(polygon_convex_depth(q, (polygon){ship, 5}, NULL), -1.99);
        ck_assert_double_lt(polygon_overlap_area(q, (polygon){floe, 6}), 1e-9);
    }
    polygon_list_free(&ctx, &zones);
    polygon_list_free(&ctx, &present);
    drop(&f);
}
END_TEST

START_TEST(a_periodic_field_continues_with_itself)
{
    const field_population p = {.share = 1, .size = power, .shape = convex};
    made_field f;
    field_packed_request r = request_of(&p, 1, 0.85, 120, 5);
    r.periodic_x = true;
    assert_ok(make(&f, &r), f.error);
    check_promises(&f, &r);
    polygon_list twice = {0};
    vec2_array ring = {0};
    int32_t across = 0;
    for (int32_t i = 0; i < polygon_list_count(&f.outlines); i++) {
        polygon q = polygon_list_get(&f.outlines, i);
        box2 b = polygon_bounds(q);
        across += b.lo.x < 0 || b.hi.x > 120;
        array_clear(&ring);
        for (int32_t k = 0; k < q.count; k++)
            ck_assert(array_push(&f.ctx, &ring, (vec2){q.vertex[k].x + 120, q.vertex[k].y}));
        ck_assert(polygon_list_push(&f.ctx, &twice, (polygon){ring.data, ring.count}));
    }
    ck_assert_int_gt(across, 3);
    double overlap;
    assert_ok(field_largest_overlap(&f.ctx, f.plane, &twice, &f.outlines, &overlap, &f.error), f.error);
    ck_assert_double_lt(overlap, 1e-3);
    polygon_list_free(&f.ctx, &twice);
    array_free(&f.ctx, &ring);
    drop(&f);
}
END_TEST

START_TEST(same_seed_same_bits_on_any_number_of_threads)
{
    const field_population p = {.share = 1, .size = power, .shape = convex};
    field_packed_request r = request_of(&p, 1, 0.85, 120, 11);
    made_field one, four;
    assert_ok(make(&one, &r), one.error);
    four = (made_field){0};
    context_init(&four.ctx);
    four.ctx.threads = pool_create(&four.ctx, 4);
    four.plane = overlay_create(&four.ctx);
    assert_ok(
        field_packed(&four.ctx, four.plane, &r, &four.outlines, &four.floes, four.parts, &four.report, &four.error),
        four.error);
    ck_assert_int_eq(one.outlines.vertex.count, four.outlines.vertex.count);
    assert_array_bits(&one.outlines.vertex.data[0].x, &four.outlines.vertex.data[0].x, 2 * one.outlines.vertex.count);
    r.seed = 12;
    made_field other;
    assert_ok(make(&other, &r), other.error);
    ck_assert_int_ne(memcmp(one.outlines.vertex.data, other.outlines.vertex.data, 160), 0);
    drop(&one);
    drop(&other);
    pool_free(&four.ctx, four.ctx.threads);
    four.ctx.threads = NULL;
    drop(&four);
}
END_TEST

START_TEST(an_impossible_field_says_what_was_reached)
{
    const field_population p = {.share = 1, .size = {.kind = SIZE_CONSTANT, .mean = 10}, .shape = {20, 20, 1, NULL}};
    made_field f;
    field_packed_request r = request_of(&p, 1, 0.95, 150, 1);
    assert_fails(make(&f, &r), f.error, FRAM_ERROR_INPUT, "was reached");
    const char *at = strstr(f.error.message, "concentration 0.8");
    ck_assert_msg(at != NULL, "%s", f.error.message);
    ck_assert_msg(strstr(f.error.message, "ask for less") != NULL, "%s", f.error.message);
    ck_assert_int_eq(polygon_list_count(&f.outlines), 0);
    drop(&f);
    /* Few large floes between walls: the message says that it is they. */
    const field_population wide = {.share = 1, .size = {.kind = SIZE_UNIFORM, .lo = 10, .hi = 30}, .shape = convex};
    r = request_of(&wide, 1, 0.93, 100, 1);
    assert_fails(make(&f, &r), f.error, FRAM_ERROR_INPUT, "walls keep water");
    ck_assert_msg(strstr(f.error.message, "a larger domain") != NULL, "%s", f.error.message);
    drop(&f);
}
END_TEST

START_TEST(wrong_requests_are_refused_by_name)
{
    const field_population good = {.share = 1, .size = power, .shape = convex};
    field_packed_request r = request_of(&good, 1, 0.8, 100, 1);
    made_field f;
    r.concentration = 1;
    assert_fails(make(&f, &r), f.error, FRAM_ERROR_INPUT, "over 0 and under 1");
    ck_assert_str_eq(f.error.key, "concentration");
    drop(&f);
    r = request_of(&good, 0, 0.8, 100, 1);
    assert_fails(make(&f, &r), f.error, FRAM_ERROR_INPUT, "1 to 1000");
    drop(&f);
    const field_population wide = {.share = 1, .size = {.kind = SIZE_CONSTANT, .mean = 40}, .shape = convex};
    r = request_of(&wide, 1, 0.8, 30, 1);
    assert_fails(make(&f, &r), f.error, FRAM_ERROR_INPUT, "largest floe");
    drop(&f);
    static const struct {
        field_population p;
        const char *message;
    } bad[] = {
        {{0, {.kind = SIZE_CONSTANT, .mean = 5}, {5, 9, 1, NULL}}, "share"},
        {{1, {.kind = SIZE_CONSTANT, .mean = 0}, {5, 9, 1, NULL}}, "mean"},
        {{1, {.kind = SIZE_LOGNORMAL, .mean = 5}, {5, 9, 1, NULL}}, "deviation"},
        {{1, {.kind = SIZE_POWER, .lo = 5, .hi = 4}, {5, 9, 1, NULL}}, "largest diameter"},
        {{1, {.kind = SIZE_HISTOGRAM}, {5, 9, 1, NULL}}, "bins"},
        {{1, {.kind = SIZE_CONSTANT, .mean = 5}, {2, 9, 1, NULL}}, "3 to 64"},
        {{1, {.kind = SIZE_CONSTANT, .mean = 5}, {9, 5, 1, NULL}}, "number of vertices"},
        {{1, {.kind = SIZE_CONSTANT, .mean = 5}, {5, 9, 0.5, NULL}}, "elongation"},
    };
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        r = request_of(&bad[i].p, 1, 0.8, 100, 1);
        assert_fails(make(&f, &r), f.error, FRAM_ERROR_INPUT, bad[i].message);
        ck_assert_str_eq(f.error.key, "populations");
        ck_assert_msg(strncmp(f.error.message, "population 1: ", 14) == 0, "%s", f.error.message);
        drop(&f);
    }
}
END_TEST

START_TEST(a_full_present_field_is_refused)
{
    context ctx;
    context_init(&ctx);
    static const vec2 floe[] = {{0, 0}, {90, 0}, {90, 100}, {0, 100}};
    polygon_list present = {0};
    ck_assert(polygon_list_push(&ctx, &present, (polygon){floe, 4}));
    const field_population p = {.share = 1, .size = nearly_equal, .shape = convex};
    made_field f;
    field_packed_request r = request_of(&p, 1, 0.85, 100, 3);
    r.present = &present;
    assert_fails(make(&f, &r), f.error, FRAM_ERROR_INPUT, "reached already");
    drop(&f);
    polygon_list_free(&ctx, &present);
}
END_TEST

START_TEST(memory_runs_out)
{
    const field_population p = {.share = 1, .size = nearly_equal, .shape = convex};
    const field_packed_request r = request_of(&p, 1, 0.6, 60, 1);
    for (failing_turn turn = {0}; failing_next(&turn);) {
        overlay *plane = overlay_create(&turn.ctx);
        polygon_list outlines = {0};
        field_floe_array floes = {0};
        field_population_report part;
        field_packed_report report;
        turn.status = plane ? field_packed(&turn.ctx, plane, &r, &outlines, &floes, &part, &report, &turn.error)
                            : FRAM_ERROR_MEMORY;
        polygon_list_free(&turn.ctx, &outlines);
        array_free(&turn.ctx, &floes);
        overlay_free(plane);
    }
}
END_TEST

START_TEST(the_cover_map_is_exact)
{
    context ctx;
    context_init(&ctx);
    static const vec2 square[] = {{1, 1}, {3, 1}, {3, 3}, {1, 3}};
    polygon_list floes = {0};
    ck_assert(polygon_list_push(&ctx, &floes, (polygon){square, 4}));
    double cover[6];
    field_cover_map(&floes, vec2_make(0, 0), (box2){{0, 0}, {6, 4}}, 3, 2, cover);
    const double expected[6] = {0.25, 0.25, 0, 0.25, 0.25, 0};
    assert_array_absolute(cover, expected, 6, 1e-15);
    assert_absolute(field_concentration(&floes, vec2_make(0, 0), (box2){{2, 0}, {4, 4}}), 0.25, 1e-15);
    polygon_list_free(&ctx, &floes);
}
END_TEST

TEST_MAIN("field_pack", wide_sizes_at_90_percent_for_every_seed, wide_sizes_at_85_percent_between_walls_for_every_seed,
          nearly_equal_sizes_at_80_percent_for_every_seed, concave_templates_at_75_percent_for_every_seed,
          brash_at_80_percent_for_every_seed, mixed_populations_at_85_percent_for_every_seed,
          populations_keep_their_shares_and_laws, what_whole_floes_of_one_size_miss_others_make_up,
          the_field_flows_around_zones_and_floes_that_are_there, a_periodic_field_continues_with_itself,
          same_seed_same_bits_on_any_number_of_threads, an_impossible_field_says_what_was_reached,
          wrong_requests_are_refused_by_name, a_full_present_field_is_refused, memory_runs_out, the_cover_map_is_exact)
