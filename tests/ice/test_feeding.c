/* Counting of tiles, and which floes a zone meets; what feeding does in a run is tested in tests/sim/test_feeding.c. */
#include "base/random.h"
#include "base/transcendental.h"
#include "ice/feeding_parts.h"
#include "testing.h"

/* Everywhere what the formula says, next to halves and on them too. */
START_TEST(periods_are_those_of_the_formula)
{
    random_stream random = random_begin(1, 0, 0);
    for (int i = 0; i < 200000; i++) {
        double period = random_uniform(&random, 0.1, 3000), x = random_uniform(&random, -4, 4) * period;
        if (i % 4 == 0) /* a few roundings from a half */
            x = period * (floor(random_uniform(&random, -4, 4)) + 0.5 + random_uniform(&random, -4e-16, 4e-16));
        ck_assert(feeding_periods(x, period) == floor(x / period + 0.5));
    }
}
END_TEST

/* ---- the first view ---- */

static void count_left_out(void *user, log_level level, const char *text)
{
    int *told = user;
    ck_assert_int_eq(level, LOG_INFO);
    ck_assert_ptr_nonnull(strstr(text, "1 concave floes left out"));
    ++*told;
}

/* Floes in the window of an endless field of one, and how often it was told that one is left out. */
static int32_t floes_beside(overlay *o, polygon floe, polygon zone, int *told)
{
    context ctx;
    context_init(&ctx);
    ctx.verbosity = LOG_INFO;
    ctx.log = count_left_out;
    ctx.log_user = told;
    body_table bodies = {0};
    shape_store shapes = {0};
    floe_table floes = {0};
    feeding_table feeding = {0};
    pattern_table pattern = {0};
    pattern_copy_table copies = {0};
    pattern_vertex_table vertices = {0};
    polygon_list zones = {0};
    int32_t number = 0, row, living = 0;
    const floe_definition f = {
        .outline = floe, .thickness = 1, .material = {.density = 920}, .motion = MOTION_DYNAMIC, .parent = -1};
    fram_error error = {0};
    assert_ok(floe_create(&ctx, &f, 0.01, o, &bodies, &shapes, &floes, &number, &row, &error), error);
    ck_assert(polygon_list_push(&ctx, &zones, zone));
    const feeding_definition d = {.window = {{-150, -150}, {150, 150}},
                                  .tile = {400, 400},
                                  .band = (double)NAN,
                                  .keep_out = &zones,
                                  .smallest_area = 1,
                                  .piece_area_limit = 0.01};
    const feeding_world w = {.feeding = &feeding,
                             .pattern = &pattern,
                             .copies = &copies,
                             .vertices = &vertices,
                             .bodies = &bodies,
                             .shapes = &shapes,
                             .floes = &floes,
                             .next_number = &number};
    *told = 0;
    assert_ok(feeding_begin(&ctx, o, &d, &w, &error), error);
    for (int32_t i = 0; i < floes.count; i++)
        living += floes.body[i] >= 0;
    table_free(&ctx, &bodies, &body_table_info);
    shape_store_free(&ctx, &shapes);
    table_free(&ctx, &floes, &floe_table_info);
    table_free(&ctx, &feeding, &feeding_table_info);
    table_free(&ctx, &pattern, &pattern_table_info);
    table_free(&ctx, &vertices, &pattern_vertex_table_info);
    polygon_list_free(&ctx, &zones);
    return living;
}

/* An L beside a box that is turned all around: it stays where the two are apart, or touch, whatever rounding
   their bounds have in common; where they are not it is left out, and counted. */
START_TEST(concave_floes_clear_of_a_zone_stay)
{
    static const vec2 bend[6] = {{30, -30}, {50, -30}, {50, -10}, {44, -10}, {44, -24}, {30, -24}};
    static const vec2 foot[4] = {{30, -30}, {50, -30}, {50, -24}, {30, -24}};
    static const vec2 leg[4] = {{44, -30}, {50, -30}, {50, -10}, {44, -10}};
    context ctx;
    context_init(&ctx);
    overlay *o = overlay_create(&ctx);
    int cases[2] = {0, 0};
    for (int k = 0; k < 360; k++) {
        vec2 way = {real_cos(radians(k)), real_sin(radians(k))};
        vec2 along = vec2_scale(way, 50), across = vec2_scale(vec2_perp(way), 10);
        vec2 fore = vec2_add(along, across), aft = vec2_sub(along, across);
        const vec2 corner[4] = {fore, vec2_scale(aft, -1), vec2_scale(fore, -1), aft};
        const polygon zone = {corner, 4};
        bool meet = polygon_convex_depth((polygon){foot, 4}, zone, NULL) > 1e-9 ||
                    polygon_convex_depth((polygon){leg, 4}, zone, NULL) > 1e-9;
        int told;
        int32_t floes = floes_beside(o, (polygon){bend, 6}, zone, &told);
        ck_assert_msg(floes == !meet && told == meet, "heading %d: %d floes, told %d times", k, (int)floes, told);
        cases[meet]++;
    }
    ck_assert(cases[0] > 180 && cases[1] > 40);
    overlay_free(o);
}
END_TEST

TEST_MAIN("feeding", periods_are_those_of_the_formula, concave_floes_clear_of_a_zone_stay)
