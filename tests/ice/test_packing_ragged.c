/* Packing of ragged floes, which hook into each other: what tests of other fields do not reach. */
#include "base/pool.h"
#include "base/random.h"
#include "base/transcendental.h"
#include "ice/field_measure.h"
#include "ice/field_pack.h"
#include "ice/packing_work.h"
#include "seeds.h"
#include "testing.h"

#include <stdlib.h>

/* Outlines with bays and a rough edge, each seen whole from its middle. */
static void add_ragged(context *ctx, int count, polygon_list *out)
{
    enum { VERTICES = 28 };
    vec2 v[VERTICES];
    for (int n = 0; n < count; n++) {
        random_stream r = random_begin(77, 1, (uint32_t)n);
        double bays = 2 * PI * random_unit(&r), lobes = 2 * PI * random_unit(&r);
        for (int i = 0; i < VERTICES; i++) {
            double angle = 2 * PI * i / VERTICES, rough = random_uniform(&r, -0.07, 0.07);
            double radius = 1 + 0.22 * real_cos(2 * angle + bays) + 0.15 * real_cos(3 * angle + lobes) + rough;
            v[i] = (vec2){radius * real_cos(angle), radius * real_sin(angle)};
        }
        ck_assert(polygon_list_push(ctx, out, (polygon){v, VERTICES}));
    }
}

typedef struct made_field {
    context ctx;
    overlay *plane;
    polygon_list outlines;
    field_floe_array floes;
    field_population_report part;
    field_packed_report report;
    fram_error error;
} made_field;

static fram_status make(made_field *f, const field_packed_request *r)
{
    f->plane = overlay_create(&f->ctx);
    return f->plane ? field_packed(&f->ctx, f->plane, r, &f->outlines, &f->floes, &f->part, &f->report, &f->error)
                    : FRAM_ERROR_MEMORY;
}

static void drop(made_field *f)
{
    polygon_list_free(&f->ctx, &f->outlines);
    array_free(&f->ctx, &f->floes);
    overlay_free(f->plane);
}

/* The field and its images to the right, above and in between do not overlap. */
static void check_seams(made_field *f, double side)
{
    polygon_list images = {0};
    vec2_array ring = {0};
    for (int image = 1; image < 4; image++)
        for (int32_t i = 0; i < polygon_list_count(&f->outlines); i++) {
            polygon q = polygon_list_get(&f->outlines, i);
            vec2 shift = {image & 1 ? side : 0, image & 2 ? side : 0};
            array_clear(&ring);
            for (int32_t k = 0; k < q.count; k++)
                ck_assert(array_push(&f->ctx, &ring, vec2_add(q.vertex[k], shift)));
            ck_assert(polygon_list_push(&f->ctx, &images, (polygon){ring.data, ring.count}));
        }
    double overlap;
    assert_ok(field_largest_overlap(&f->ctx, f->plane, &f->outlines, &images, &overlap, &f->error), f->error);
    ck_assert_msg(overlap < 1e-3, "overlap %g m across the edge", overlap);
    polygon_list_free(&f->ctx, &images);
    array_free(&f->ctx, &ring);
}

START_TEST(ragged_templates_at_85_percent_for_every_seed)
{
    context ctx;
    context_init(&ctx);
    polygon_list templates = {0};
    add_ragged(&ctx, 12, &templates);
    const field_population p = {1, {.kind = SIZE_POWER, .lo = 4, .hi = 40, .exponent = 1.7}, {.templates = &templates}};
    const double side = 65;
    for (uint64_t seed = 1; seed <= seeds(); seed++) {
        made_field f = {0};
        context_init(&f.ctx);
        const field_packed_request r = {.domain = {{0, 0}, {side, side}},
                                        .periodic_x = true,
                                        .periodic_y = true,
                                        .concentration = 0.85,
                                        .populations = &p,
                                        .population_count = 1,
                                        .seed = seed};
        assert_ok(make(&f, &r), f.error);
        assert_relative(f.report.field.concentration, 0.85, 0.005);
        ck_assert_double_lt(f.report.field.largest_overlap, 1e-3);
        ck_assert_double_lt(f.report.area_change, 1e-9);
        ck_assert_int_eq(f.report.vertex_changes, 0);
        ck_assert_int_gt(f.report.field.floes, 30);
        check_seams(&f, side);
        drop(&f);
    }
    polygon_list_free(&ctx, &templates);
}
END_TEST

START_TEST(same_seed_same_bits_on_any_number_of_threads)
{
    made_field one = {0}, four = {0};
    context_init(&one.ctx);
    context_init(&four.ctx);
    four.ctx.threads = pool_create(&four.ctx, 4);
    polygon_list templates = {0};
    add_ragged(&one.ctx, 12, &templates);
    const field_population p = {1, {.kind = SIZE_POWER, .lo = 4, .hi = 20, .exponent = 1.7}, {.templates = &templates}};
    const field_packed_request r = {.domain = {{0, 0}, {50, 50}},
                                    .periodic_x = true,
                                    .concentration = 0.75,
                                    .populations = &p,
                                    .population_count = 1,
                                    .seed = 3};
    assert_ok(make(&one, &r), one.error);
    assert_ok(make(&four, &r), four.error);
    ck_assert_int_gt(one.report.moves, 0);
    ck_assert_int_eq(one.outlines.vertex.count, four.outlines.vertex.count);
    assert_array_bits(&one.outlines.vertex.data[0].x, &four.outlines.vertex.data[0].x, 2 * one.outlines.vertex.count);
    polygon_list_free(&one.ctx, &templates);
    drop(&one);
    pool_free(&four.ctx, four.ctx.threads);
    four.ctx.threads = NULL;
    drop(&four);
}
END_TEST

/* A floe of nearly equal sizes leaves water that ragged ones cannot fill. */
START_TEST(an_impossible_field_says_what_was_reached)
{
    made_field f = {0};
    context_init(&f.ctx);
    polygon_list templates = {0};
    add_ragged(&f.ctx, 12, &templates);
    const field_population p = {1, {.kind = SIZE_CONSTANT, .mean = 10}, {.templates = &templates}};
    const field_packed_request r = {.domain = {{0, 0}, {50, 50}},
                                    .periodic_x = true,
                                    .periodic_y = true,
                                    .concentration = 0.95,
                                    .populations = &p,
                                    .population_count = 1,
                                    .seed = 3};
    assert_fails(make(&f, &r), f.error, FRAM_ERROR_INPUT, "concentration 0.95 cannot be reached");
    const char *reached = strstr(f.error.message, "concentration 0.7");
    reached = reached ? reached : strstr(f.error.message, "concentration 0.8");
    ck_assert_msg(reached && strstr(reached, "was reached"), "%s", f.error.message);
    polygon_list_free(&f.ctx, &templates);
    drop(&f);
}
END_TEST

/* A peg in a slot too narrow for it: the slot's sides push it to the left and to the right, and only the way back up
   leads anywhere.  Others stand free, so that the pair is squeezed more than the mean. */
START_TEST(a_hooked_pair_comes_apart_along_one_way)
{
    context ctx;
    context_init(&ctx);
    overlay *plane = overlay_create(&ctx);
    static const vec2 slotted[] = {{-3, -3}, {3, -3}, {3, 1}, {0.4, 1}, {0.4, -1}, {-0.4, -1}, {-0.4, 1}, {-3, 1}};
    static const vec2 peg[] = {{-0.5, -1.5}, {0.5, -1.5}, {0.5, 1.5}, {-0.5, 1.5}};
    enum { OTHERS = 8 };
    polygon_list shapes = {0};
    ck_assert(polygon_list_push(&ctx, &shapes, (polygon){slotted, 8}));
    for (int i = 0; i <= OTHERS; i++)
        ck_assert(polygon_list_push(&ctx, &shapes, (polygon){peg, 4}));
    const packing_request request = {.domain = {{-20, -20}, {20, 20}}, .shapes = &shapes};
    fram_error error = {0};
    pack_work w = {.ctx = &ctx, .request = &request, .overlay = plane, .error = &error, .layout.scale = 1};
    ck_assert(pack_bodies_make(&w));
    w.layout.bodies.data[0].centre = (vec2){0, 0};
    w.layout.bodies.data[1].centre = (vec2){0, 0.6}; /* its end is 0.1 m from the slot's */
    for (int i = 0; i < OTHERS; i++)
        w.layout.bodies.data[2 + i].centre = (vec2){-15 + 4 * i, -15};
    ck_assert(pack_find_pairs(&w, true) && pack_find_rows(&w));
    int32_t taking = -1, count = 0;
    for (int32_t i = 0; i < w.contacts.rows.count; i++)
        if (w.contacts.rows.data[i].mass > 0) {
            taking = i;
            count++;
        }
    ck_assert_int_eq(count, 1);
    const pack_row *r = &w.contacts.rows.data[taking];
    ck_assert_int_eq(r->b, 1);
    assert_absolute(r->normal.x, 0, 1e-12); /* out of the slot, not through its sides */
    assert_absolute(r->normal.y, 1, 1e-12);
    ck_assert_double_lt(r->gap, 0);
    /* And so it leaves. */
    for (int k = 0; k < 200 && w.contacts.overlap > 0; k++) {
        pack_solve_rows(&w, 0);
        ck_assert(pack_find_pairs(&w, true) && pack_find_rows(&w));
    }
    ck_assert_double_le(w.contacts.overlap, 0);
    assert_absolute(w.layout.bodies.data[1].centre.x - w.layout.bodies.data[0].centre.x, 0, 0.2);
    ck_assert_double_ge(w.layout.bodies.data[1].centre.y - w.layout.bodies.data[0].centre.y, 2.5);
    pack_work_free(&w);
    polygon_list_free(&ctx, &shapes);
    overlay_free(plane);
}
END_TEST

/* Every allocation of a growing field may be the one that fails; of thousands some are tried. */
START_TEST(memory_runs_out)
{
    context plain;
    context_init(&plain);
    polygon_list templates = {0};
    add_ragged(&plain, 3, &templates);
    const field_population p = {1, {.kind = SIZE_CONSTANT, .mean = 10}, {.templates = &templates}};
    const field_packed_request r = {.domain = {{0, 0}, {24, 24}},
                                    .periodic_x = true,
                                    .concentration = 0.7,
                                    .populations = &p,
                                    .population_count = 1,
                                    .seed = 2};
    for (failing_turn turn = {0}; failing_next(&turn);) {
        turn.stride = 1 + turn.n / 4;
        made_field f = {.ctx = turn.ctx};
        turn.status = make(&f, &r);
        drop(&f);
    }
    polygon_list_free(&plain, &templates);
}
END_TEST

TEST_MAIN("packing_ragged", ragged_templates_at_85_percent_for_every_seed, same_seed_same_bits_on_any_number_of_threads,
          an_impossible_field_says_what_was_reached, a_hooked_pair_comes_apart_along_one_way, memory_runs_out)
