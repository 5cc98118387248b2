/* Managed ice fields: concentration, separation, zones, determinism, errors. */
#include "base/pool.h"
#include "base/transcendental.h"
#include "floes_apart.h"
#include "ice/field.h"
#include "ice/field_cells.h"
#include "seeds.h"

static field_request request_of(double concentration, uint64_t seed)
{
    return (field_request){.domain = {{-100, 50}, {200, 250}},
                           .concentration = concentration,
                           .mean_area = 200,
                           .size_deviation = 0.8,
                           .roundness = 0.3,
                           .seed = seed,
                           .smallest_area = 1};
}

/* Every outline convex, counter-clockwise, inside the domain, apart from all others and from the zones. */
static void check_field(context *ctx, const field_request *q, const polygon_list *floes, const field_report *r)
{
    double area = 0;
    ck_assert_int_eq(polygon_list_count(floes), r->floes);
    for (int32_t i = 0; i < r->floes; i++) {
        polygon p = polygon_list_get(floes, i);
        ck_assert_int_ge(p.count, 3);
        ck_assert(polygon_is_convex(p));
        double a = polygon_area(p);
        ck_assert(a >= q->smallest_area);
        area += a;
        box2 b = polygon_bounds(p);
        ck_assert(b.lo.x >= q->domain.lo.x && b.lo.y >= q->domain.lo.y && b.hi.x <= q->domain.hi.x &&
                  b.hi.y <= q->domain.hi.y);
        for (int32_t z = 0; q->keep_out && z < polygon_list_count(q->keep_out); z++)
            ck_assert(polygon_convex_depth(p, polygon_list_get(q->keep_out, z), NULL) <= -q->keep_out_margin + 1e-9);
    }
    assert_relative(r->concentration, q->concentration, 1e-6);
    assert_relative(area, q->concentration * r->free_area, 1e-6);
    assert_bits(r->largest_overlap, 0);
    assert_apart(ctx, floes);
    ck_assert(r->gap > 0);
}

/* Every pair, one by one, as a check on the sweep; and the gap between true neighbours. */
static double least_gap(const polygon_list *floes)
{
    double deepest = -HUGE_VAL;
    for (int32_t i = 0; i < polygon_list_count(floes); i++)
        for (int32_t k = i + 1; k < polygon_list_count(floes); k++)
            deepest = testing_larger(
                deepest, polygon_convex_depth(polygon_list_get(floes, i), polygon_list_get(floes, k), NULL));
    return -deepest;
}

START_TEST(concentrations)
{
    static const double target[5] = {0.3, 0.8, 0.9, 0.95, 0.98};
    context ctx;
    context_init(&ctx);
    for (int i = 0; i < 5; i += getenv("FRAM_TEST_SHORT") ? 4 : 1) { /* short: the least and the most */
        field_request q = request_of(target[i], 7);
        polygon_list floes = {0};
        field_report r;
        fram_error e = {0};
        assert_ok(field_voronoi(&ctx, &q, &floes, &r, &e), e);
        assert_relative(r.free_area, 60000, 1e-12);
        check_field(&ctx, &q, &floes, &r);
        /* Neighbours stand one gap apart.  Where the edge that parted two of them has vanished from both, the edge
           normals left tell somewhat less than their distance. */
        double least = least_gap(&floes);
        ck_assert_msg(least <= r.gap * (1 + 1e-6) && least > 0.7 * r.gap, "gap %g, least %g", r.gap, least);
        polygon_list_free(&ctx, &floes);
    }
}
END_TEST

START_TEST(every_seed)
{
    context ctx;
    context_init(&ctx);
    double first = 0;
    for (uint64_t seed = 0; seed < seeds(); seed++) {
        field_request q = request_of(0.98, seed);
        q.size_deviation = 1;
        q.roundness = 0.05 * (double)seed;
        polygon_list floes = {0};
        field_report r;
        fram_error e = {0};
        assert_ok(field_voronoi(&ctx, &q, &floes, &r, &e), e);
        check_field(&ctx, &q, &floes, &r);
        double x = floes.vertex.data[0].x;
        ck_assert(seed == 0 || x != first);
        first = x;
        polygon_list_free(&ctx, &floes);
    }
}
END_TEST

/* The same bits for the same seed, on one thread and on three. */
START_TEST(the_same_on_any_threads)
{
    context ctx;
    context_init(&ctx);
    polygon_list floes[2] = {{.start = {0}}, {.start = {0}}};
    field_request q = request_of(0.9, 42);
    field_report r;
    fram_error e = {0};
    for (int i = 0; i < 2; i++) {
        ctx.threads = i == 0 ? NULL : pool_create(&ctx, 3);
        assert_ok(field_voronoi(&ctx, &q, &floes[i], &r, &e), e);
        if (ctx.threads)
            pool_free(&ctx, ctx.threads);
        ctx.threads = NULL;
    }
    ck_assert_int_eq(floes[0].vertex.count, floes[1].vertex.count);
    assert_array_bits(&floes[1].vertex.data[0].x, &floes[0].vertex.data[0].x, 2 * floes[0].vertex.count);
    ck_assert_int_eq(memcmp(floes[0].start.data, floes[1].start.data, sizeof(int32_t) * (size_t)floes[0].start.count),
                     0);
    /* Appended after what is there. */
    int32_t count = polygon_list_count(&floes[0]);
    assert_ok(field_voronoi(&ctx, &q, &floes[0], &r, &e), e);
    ck_assert_int_eq(polygon_list_count(&floes[0]), 2 * count);
    for (int i = 0; i < 2; i++)
        polygon_list_free(&ctx, &floes[i]);
}
END_TEST

/* Regular sites give equal hexagons; scatter spreads the sizes; the mean is as asked. */
START_TEST(sizes)
{
    context ctx;
    context_init(&ctx);
    double deviation[3];
    static const double scatter[3] = {0, 0.5, 1};
    for (int i = 0; i < 3; i++) {
        field_request q = request_of(0.9, 3);
        q.size_deviation = scatter[i];
        q.roundness = 0;
        polygon_list floes = {0};
        field_report r;
        fram_error e = {0};
        assert_ok(field_voronoi(&ctx, &q, &floes, &r, &e), e);
        check_field(&ctx, &q, &floes, &r);
        assert_relative(r.floes, 300, 0.03);
        double sum = 0, squares = 0, hexagons = 0;
        for (int32_t k = 0; k < r.floes; k++) {
            polygon p = polygon_list_get(&floes, k);
            double a = polygon_area(p);
            sum += a;
            squares += a * a;
            hexagons += p.count == 6;
        }
        deviation[i] = sqrt(squares / r.floes - sum * sum / r.floes / r.floes) / (sum / r.floes);
        ck_assert(i > 0 || hexagons > 0.75 * r.floes);
        polygon_list_free(&ctx, &floes);
    }
    ck_assert_msg(deviation[0] < 0.2 && deviation[1] > deviation[0] + 0.05 && deviation[2] > deviation[1] + 0.05,
                  "%g %g %g", deviation[0], deviation[1], deviation[2]);
}
END_TEST

/* Roundness turns gaps into open corners: more vertices, less perimeter for the same area. */
START_TEST(roundness)
{
    context ctx;
    context_init(&ctx);
    double gap[3], perimeter[3] = {0, 0, 0};
    static const double part[3] = {0, 0.5, 1};
    for (int i = 0; i < 3; i++) {
        field_request q = request_of(0.9, 3);
        q.roundness = part[i];
        polygon_list floes = {0};
        field_report r;
        fram_error e = {0};
        assert_ok(field_voronoi(&ctx, &q, &floes, &r, &e), e);
        check_field(&ctx, &q, &floes, &r);
        gap[i] = r.gap;
        for (int32_t k = 0; k < r.floes; k++)
            perimeter[i] += polygon_perimeter(polygon_list_get(&floes, k));
        polygon_list_free(&ctx, &floes);
    }
    ck_assert(gap[0] > 1.5 * gap[1] && gap[1] > 2 * gap[2] && gap[2] > 0);
    /* Isoperimetric: both lose outline, corners for gaps; the area is the same. */
    ck_assert(perimeter[1] < perimeter[0] * 1.02 && perimeter[2] < perimeter[0] * 1.02);
}
END_TEST

/* A ship in the middle, two zones that overlap, one half outside the domain. */
START_TEST(keep_out_zones)
{
    context ctx;
    context_init(&ctx);
    static const vec2 ship[5] = {{0, 130}, {80, 130}, {100, 145}, {80, 160}, {0, 160}};
    static const vec2 box[4] = {{60, 100}, {140, 150}, {130, 165}, {50, 115}};
    static const vec2 outside[3] = {{180, 200}, {260, 220}, {190, 260}};
    static const vec2 needle[3] = {{-90, 60}, {-50, 62}, {-90, 61}};
    polygon_list zones = {0};
    ck_assert(polygon_list_push(&ctx, &zones, (polygon){ship, 5}) &&
              polygon_list_push(&ctx, &zones, (polygon){box, 4}) &&
              polygon_list_push(&ctx, &zones, (polygon){outside, 3}) &&
              polygon_list_push(&ctx, &zones, (polygon){needle, 3}));
    overlay *o = overlay_create(&ctx);
    for (int i = 0; i < 8; i++) {
        double margin = 0.7 * i;
        field_request q = request_of(0.8 + 0.02 * i, 11 + (uint64_t)i);
        q.keep_out = &zones;
        q.keep_out_margin = margin;
        polygon_list floes = {0};
        field_report r;
        fram_error e = {0};
        assert_ok(field_voronoi(&ctx, &q, &floes, &r, &e), e);
        check_field(&ctx, &q, &floes, &r);
        /* The free area, from the union of the grown zones inside the domain. */
        polygon_list grown = {0}, clipped = {0}, joined = {0};
        vec2_array part = {0};
        static const vec2 domain[4] = {{-100, 50}, {200, 50}, {200, 250}, {-100, 250}};
        ck_assert(zones_grow(&ctx, &zones, margin, &grown));
        for (int32_t k = 0; k < 4; k++) {
            ck_assert(polygon_clip_convex(&ctx, polygon_list_get(&grown, k), (polygon){domain, 4}, &part));
            ck_assert(polygon_list_push(&ctx, &clipped, (polygon){part.data, part.count}));
        }
        assert_ok(overlay_union(o, &clipped, &joined, &e), e);
        double covered = 0;
        for (int32_t k = 0; k < polygon_list_count(&joined); k++)
            covered += polygon_area(polygon_list_get(&joined, k));
        assert_relative(r.free_area, 60000 - covered, 1e-9);
        array_free(&ctx, &part);
        polygon_list_free(&ctx, &grown);
        polygon_list_free(&ctx, &clipped);
        polygon_list_free(&ctx, &joined);
        polygon_list_free(&ctx, &floes);
    }
    overlay_free(o);
    polygon_list_free(&ctx, &zones);
}
END_TEST

/* A grown zone holds every point within the margin, and not much more. */
START_TEST(zones_grow_all_around)
{
    context ctx;
    context_init(&ctx);
    static const vec2 needle[3] = {{0, 0}, {40, 0.5}, {0, 1}};
    static const vec2 square[4] = {{0, 0}, {2, 0}, {2, 2}, {0, 2}};
    polygon_list zones = {0}, grown = {0};
    ck_assert(polygon_list_push(&ctx, &zones, (polygon){needle, 3}) &&
              polygon_list_push(&ctx, &zones, (polygon){square, 4}));
    ck_assert(zones_grow(&ctx, &zones, 1.5, &grown));
    for (int32_t i = 0; i < 2; i++) {
        polygon zone = polygon_list_get(&zones, i), g = polygon_list_get(&grown, i);
        ck_assert(polygon_is_convex(g) && polygon_area(g) > 0);
        for (int k = 0; k < 360; k++) {
            vec2 way = {1.5 * real_cos(radians(k)), 1.5 * real_sin(radians(k))};
            for (int32_t v = 0; v < zone.count; v++) {
                ck_assert(polygon_contains(g, vec2_add(zone.vertex[v], vec2_scale(way, 1 - 1e-9))));
            }
        }
        for (int32_t k = 0; k < g.count; k++) {
            vec2 near = polygon_nearest_boundary(zone, g.vertex[k], NULL);
            double away = vec2_length(vec2_sub(near, g.vertex[k]));
            ck_assert(away >= 1.5 - 1e-9 && away < 1.5 * 1.09);
        }
    }
    polygon_list_free(&ctx, &zones);
    polygon_list_free(&ctx, &grown);
}
END_TEST

/* A rectangle opens as much water whichever way it is turned: each of its corners has four tangents. */
START_TEST(zones_grow_alike_at_any_heading)
{
    context ctx;
    context_init(&ctx);
    polygon_list zones = {0}, grown = {0};
    for (int k = 0; k < 360; k++) {
        vec2 way = {real_cos(radians(k)), real_sin(radians(k))};
        vec2 along = vec2_scale(way, 10), across = vec2_scale(vec2_perp(way), 5);
        vec2 fore = vec2_add(along, across), aft = vec2_sub(along, across);
        const vec2 corner[4] = {fore, vec2_scale(aft, -1), vec2_scale(fore, -1), aft};
        ck_assert(polygon_list_push(&ctx, &zones, (polygon){corner, 4}));
    }
    ck_assert(zones_grow(&ctx, &zones, 10, &grown));
    const double corners = 16 * real_sin(PI / 16) / real_cos(PI / 16) * 100;
    for (int32_t k = 0; k < 360; k++)
        assert_relative(polygon_area(polygon_list_get(&grown, k)), 200 + 60 * 10 + corners, 1e-12);
    polygon_list_free(&ctx, &zones);
    polygon_list_free(&ctx, &grown);
}
END_TEST

START_TEST(impossible_targets)
{
    context ctx;
    context_init(&ctx);
    polygon_list floes = {0};
    field_report r;
    fram_error e = {0};
    field_request q = request_of(0.9, 1);
    q.smallest_area = 220; /* larger than most cells */
    assert_fails(field_voronoi(&ctx, &q, &floes, &r, &e), e, FRAM_ERROR_INPUT, "cannot be reached");
    ck_assert_ptr_nonnull(strstr(e.message, "smallest area"));
    ck_assert_str_eq(e.key, "concentration");
    static const vec2 all[4] = {{-200, 0}, {300, 0}, {300, 300}, {-200, 300}};
    polygon_list zones = {0};
    ck_assert(polygon_list_push(&ctx, &zones, (polygon){all, 4}));
    q = request_of(0.9, 1);
    q.keep_out = &zones;
    assert_fails(field_voronoi(&ctx, &q, &floes, &r, &e), e, FRAM_ERROR_INPUT, "no water is left for ice");
    polygon_list_clear(&zones);
    static const vec2 dart[4] = {{0, 60}, {40, 100}, {0, 80}, {-40, 100}};
    ck_assert(polygon_list_push(&ctx, &zones, (polygon){dart, 4}));
    assert_fails(field_voronoi(&ctx, &q, &floes, &r, &e), e, FRAM_ERROR_INPUT, "convex");
    polygon_list_free(&ctx, &zones);
    ck_assert_int_eq(polygon_list_count(&floes), 0);
    ck_assert_ptr_null(floes.vertex.data);
}
END_TEST

START_TEST(wrong_requests)
{
    context ctx;
    context_init(&ctx);
    polygon_list floes = {0};
    field_report r;
    for (int i = 0; i < 12; i++) {
        field_request q = request_of(0.9, 1);
        const char *key = "";
        switch (i) {
        case 0:
            q.domain.hi.x = q.domain.lo.x, key = "domain";
            break;
        case 1:
            q.domain.hi.y = (double)NAN, key = "domain";
            break;
        case 2:
            q.concentration = 1, key = "concentration";
            break;
        case 3:
            q.concentration = 0, key = "concentration";
            break;
        case 4:
            q.concentration = (double)NAN, key = "concentration";
            break;
        case 5:
            q.mean_area = 0, key = "mean_area";
            break;
        case 6:
            q.mean_area = 1e-9, key = "mean_area";
            break;
        case 7:
            q.size_deviation = 1.1, key = "size_deviation";
            break;
        case 8:
            q.roundness = -0.1, key = "roundness";
            break;
        case 9:
            q.smallest_area = -1, key = "smallest_area";
            break;
        case 10:
            q.keep_out_margin = -1, key = "keep_out_margin";
            break;
        default:
            q.keep_out_margin = HUGE_VAL, key = "keep_out_margin";
            break;
        }
        fram_error e = {0};
        ck_assert_int_eq(field_voronoi(&ctx, &q, &floes, &r, &e), FRAM_ERROR_INPUT);
        ck_assert_str_eq(e.key, key);
        ck_assert_ptr_nonnull(strstr(e.message, "expected "));
    }
    ck_assert_ptr_null(floes.vertex.data);
}
END_TEST

/* One floe, two floes, a domain that is a strip. */
START_TEST(few_cells)
{
    context ctx;
    context_init(&ctx);
    static const double mean[3] = {1e9, 60000, 30000};
    for (int i = 0; i < 5; i++) {
        field_request q = request_of(0.9, 5);
        q.roundness = 0;
        if (i < 3)
            q.mean_area = mean[i];
        else
            q.domain = i == 3 ? (box2){{0, 0}, {1000, 2}} : (box2){{0, 0}, {1e6, 1e-3}};
        polygon_list floes = {0};
        field_report r;
        fram_error e = {0};
        assert_ok(field_voronoi(&ctx, &q, &floes, &r, &e), e);
        check_field(&ctx, &q, &floes, &r);
        ck_assert_int_eq(r.floes, i < 2 ? 1 : i == 2 ? 2 : i == 3 ? 10 : 5);
        polygon_list_free(&ctx, &floes);
    }
}
END_TEST

START_TEST(memory_runs_out)
{
    static const vec2 ship[5] = {{0, 130}, {80, 130}, {100, 145}, {80, 160}, {0, 160}};
    for (failing_turn turn = {0}; failing_next(&turn);) {
        context plain;
        context_init(&plain);
        polygon_list zones = {0}, floes = {0};
        ck_assert(polygon_list_push(&plain, &zones, (polygon){ship, 5}));
        field_request q = request_of(0.9, 1);
        q.mean_area = 2000;
        q.keep_out = &zones;
        q.keep_out_margin = 3;
        field_report r;
        turn.status = field_voronoi(&turn.ctx, &q, &floes, &r, &turn.error);
        if (turn.status != FRAM_OK)
            ck_assert_int_eq(polygon_list_count(&floes), 0);
        polygon_list_free(&turn.ctx, &floes);
        polygon_list_free(&plain, &zones);
        if (!turn.memory.failed)
            ck_assert_int_gt(turn.n, 20);
    }
}
END_TEST

/* A stop that is asked for while the work has a certain name. */
typedef struct stop_at {
    const char *work;
    int stop;
} stop_at;

static void stop_while(void *user, const char *what, double done, double total)
{
    stop_at *s = user;
    ck_assert(done <= total);
    if (strcmp(what, s->work) == 0)
        s->stop = 1;
}

/* Each part of the making ends when it is asked to, the ones between the cells and their shrinking too. */
START_TEST(every_part_listens)
{
    static const char *const parts[] = {"making Voronoi cells", "cutting cells at open water", "cutting corners",
                                        "shrinking cells to floes", "looking for overlaps"};
    static const vec2 ship[5] = {{0, 130}, {80, 130}, {100, 145}, {80, 160}, {0, 160}};
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++) {
        stop_at at = {parts[i], 0};
        context ctx;
        context_init(&ctx);
        ctx.stop = &at.stop;
        ctx.work = stop_while;
        ctx.work_user = &at;
        polygon_list zones = {0}, floes = {0};
        ck_assert(polygon_list_push(&ctx, &zones, (polygon){ship, 5}));
        field_request q = request_of(0.9, 1);
        q.mean_area = 20;
        q.keep_out = &zones;
        field_report r;
        fram_error e = {0};
        ck_assert_msg(field_voronoi(&ctx, &q, &floes, &r, &e) == FRAM_INTERRUPTED, "%s goes on", parts[i]);
        ck_assert(strstr(e.message, parts[i]) != NULL);
        polygon_list_free(&ctx, &zones);
        polygon_list_free(&ctx, &floes);
    }
}
END_TEST

/* A field that repeats itself: floes beside the seams stand as far from the copies as from other neighbours. */
START_TEST(periodic_fields)
{
    context ctx;
    context_init(&ctx);
    for (uint64_t seed = 1; seed <= 5; seed++) {
        field_request q = request_of(0.9, seed);
        q.periodic = true;
        q.mean_area = seed == 5 ? 10000 : 200; /* six cells: every one its own neighbour's neighbour */
        polygon_list floes = {0}, all = {0};
        field_report r;
        fram_error e = {0};
        assert_ok(field_voronoi(&ctx, &q, &floes, &r, &e), e);
        assert_relative(r.concentration, 0.9, 1e-6);
        assert_relative(r.free_area, 60000, 1e-9);
        for (int copy = 0; copy < 4; copy++) /* beside, above and across: what meets over an edge or a corner */
            for (int32_t i = 0; i < r.floes; i++) {
                polygon p = polygon_list_get(&floes, i);
                vec2 moved[64];
                ck_assert_int_le(p.count, 64);
                for (int32_t k = 0; k < p.count; k++)
                    moved[k] = vec2_add(p.vertex[k], vec2_make(300 * (copy % 2), 200.0 * (copy / 2)));
                ck_assert(polygon_list_push(&ctx, &all, (polygon){moved, p.count}));
            }
        assert_apart(&ctx, &all);
        double least = least_gap(&all);
        ck_assert_msg(least <= r.gap * (1 + 1e-6) && least > 0.6 * r.gap, "gap %g, least %g", r.gap, least);
        polygon_list_free(&ctx, &floes);
        polygon_list_free(&ctx, &all);
    }
}
END_TEST

TEST_MAIN("field", concentrations, every_seed, periodic_fields, the_same_on_any_threads, sizes, roundness,
          keep_out_zones, zones_grow_all_around, zones_grow_alike_at_any_heading, impossible_targets, wrong_requests,
          few_cells, memory_runs_out, every_part_listens)
