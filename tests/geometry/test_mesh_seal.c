/* What sealing may join, by meshes of a few triangles whose distances are known. */
#include "base/random.h"
#include "base/transcendental.h"
#include "geometry/mesh_repair.h"
#include "testing.h"

typedef struct rig {
    context ctx;
    mesh m;
    mesh_seal_report report;
} rig;

static rig rig_make(void)
{
    rig r = {0};
    context_init(&r.ctx);
    return r;
}

static void triangle_of(rig *r, vec3 a, vec3 b, vec3 c)
{
    int32_t first = r->m.vertex.count;
    ck_assert(mesh_add_vertex(&r->ctx, &r->m, a) && mesh_add_vertex(&r->ctx, &r->m, b) &&
              mesh_add_vertex(&r->ctx, &r->m, c) && mesh_add_triangle(&r->ctx, &r->m, first, first + 1, first + 2));
}

static void seal(rig *r, double width)
{
    ck_assert_int_eq(mesh_seal(&r->ctx, &r->m, width, NULL, &r->report), FRAM_OK);
}

static void rig_free(rig *r) { mesh_free(&r->ctx, &r->m); }

/* Two corners 1.27 apart, by 0.9 along each of two axes, stay apart under a seal of 1, and meet under one of 1.3. */
START_TEST(corners_out_of_reach_stay_apart)
{
    for (int wide = 0; wide < 2; wide++) {
        rig r = rig_make();
        triangle_of(&r, (vec3){0, 0, 0}, (vec3){-5, 1, 0}, (vec3){-5, -9, 0});
        triangle_of(&r, (vec3){0.9, 0.9, 0}, (vec3){6, -0.1, 0}, (vec3){6, 9, 0});
        seal(&r, wide ? 1.3 : 1);
        ck_assert_int_eq(r.report.joined, wide);
        ck_assert_int_eq(r.report.splits, 0);
        ck_assert_int_eq(r.report.open_after, 6);
        assert_absolute(r.report.width, wide ? 0.9 * sqrt(2) : 0, 1e-15);
        rig_free(&r);
    }
}
END_TEST

/* Of four corners in a row, 0.9, 0.8 and 0.9 apart, the middle ones meet first, then the first joins them; the last is
   now 1.7 from them and out of the reach of 1. */
START_TEST(the_nearest_join_first)
{
    static const double place[4] = {0.9, 1.7, 0, 2.6};
    rig r = rig_make();
    for (int i = 0; i < 4; i++) {
        double x = place[i], y = 10 * real_cos(i * PI / 2), z = 10 * real_sin(i * PI / 2);
        triangle_of(&r, (vec3){x, 0, 0}, (vec3){x, y, z}, (vec3){x, y - 0.3 * z, z + 0.3 * y});
    }
    seal(&r, 1);
    ck_assert_int_eq(r.report.joined, 2);
    ck_assert_int_eq(r.m.face.data[1].v[0], 0);
    ck_assert_int_eq(r.m.face.data[2].v[0], 0);
    ck_assert_int_eq(r.m.face.data[3].v[0], 9);
    assert_absolute(r.report.width, 0.9, 1e-15);
    rig_free(&r);
}
END_TEST

static vec3 off_by(random_stream *r, vec3 p, double most)
{
    return (vec3){p.x + random_uniform(r, -most, most), p.y + random_uniform(r, -most, most),
                  p.z + random_uniform(r, -most, most)};
}

/* Two fans, upward and downward from one rim, each corner of each facet off by itself: a tip has as many copies as the
   fan has facets. */
START_TEST(fans_of_any_number_of_facets_become_one)
{
    static const int sides[] = {40, 100, 400, 1200, 4000};
    for (size_t k = 0; k < sizeof sides / sizeof *sides; k++) {
        int n = sides[k];
        rig r = rig_make();
        random_stream chance = random_begin(5, 0, (uint32_t)k);
        for (int i = 0; i < 2 * n; i++) {
            double from = 2 * PI * (i / 2) / n, to = 2 * PI * ((i / 2 + 1) % n) / n, most = 1e-5;
            vec3 a = {real_cos(from), real_sin(from), 0}, b = {real_cos(to), real_sin(to), 0};
            vec3 tip = {0, 0, i % 2 ? -1 : 1};
            triangle_of(&r, off_by(&chance, i % 2 ? b : a, most), off_by(&chance, i % 2 ? a : b, most),
                        off_by(&chance, tip, most));
        }
        seal(&r, 1e-3);
        ck_assert_int_eq(r.report.open_before, 6 * n);
        ck_assert_int_eq(r.report.open_after, 0);
        ck_assert_int_eq(r.report.joined, 6 * n - (n + 2));
        ck_assert_int_eq(r.report.splits, 0);
        rig_free(&r);
    }
}
END_TEST

/* A plate of 3 x 3 squares without the one in its middle: a seal wider than the hole draws it together over its
   diagonals, which the rim joins by a way that is 1.41 times as long. */
START_TEST(a_small_hole_is_drawn_together)
{
    rig r = rig_make();
    static const double line[4] = {-9, 1, 1.1, 9};
    for (int i = 0; i < 16; i++)
        ck_assert(mesh_add_vertex(&r.ctx, &r.m, (vec3){line[i % 4], line[i / 4], 0}));
    for (int k = 0; k < 9; k++) {
        int32_t a = k % 3 + 4 * (k / 3);
        if (k != 4)
            ck_assert(mesh_add_triangle(&r.ctx, &r.m, a, a + 1, a + 5) &&
                      mesh_add_triangle(&r.ctx, &r.m, a, a + 5, a + 4));
    }
    seal(&r, 0.16);
    ck_assert_int_eq(r.report.open_before, 12 + 4);
    ck_assert_int_eq(r.report.open_after, 12);
    ck_assert_int_eq(r.report.joined, 2);
    ck_assert_int_eq(r.report.splits, 0);
    rig_free(&r);
}
END_TEST

/* The rim of a disc of 64 sides is finer than the seal is wide: it has no crack, and nothing happens to it. */
START_TEST(a_fine_rim_stays_as_it_is)
{
    enum { SIDES = 64 };
    rig r = rig_make();
    ck_assert(mesh_add_vertex(&r.ctx, &r.m, (vec3){0, 0, 0}));
    for (int i = 0; i < SIDES; i++) {
        double angle = 2 * PI * i / SIDES;
        ck_assert(mesh_add_vertex(&r.ctx, &r.m, (vec3){real_cos(angle), real_sin(angle), 0}));
    }
    for (int i = 0; i < SIDES; i++)
        ck_assert(mesh_add_triangle(&r.ctx, &r.m, 0, 1 + i, 1 + (i + 1) % SIDES));
    seal(&r, 0.35);
    ck_assert_int_eq(r.report.joined, 0);
    ck_assert_int_eq(r.report.splits, 0);
    ck_assert_int_eq(r.report.open_after, SIDES);
    rig_free(&r);
}
END_TEST

/* A corner 1.2 off the middle of an oblique edge, whose box it is in, and the same 0.9 off. */
START_TEST(edges_are_led_over_what_is_in_reach)
{
    for (int near = 0; near < 2; near++) {
        double off = (near ? 0.9 : 1.2) * sqrt(0.5);
        rig r = rig_make();
        triangle_of(&r, (vec3){-10, -10, 0}, (vec3){10, 10, 0}, (vec3){-10, 10, 0});
        triangle_of(&r, (vec3){off, -off, 0}, (vec3){8, -20, 0}, (vec3){20, -8, 0});
        seal(&r, 1);
        ck_assert_int_eq(r.report.splits, near);
        ck_assert_int_eq(r.m.face.count, 2 + near);
        assert_absolute(r.report.width, near ? 0.9 : 0, 1e-15);
        /* The edge's triangle over the corner: half of 20 sqrt 2 times the distance. */
        assert_absolute(r.report.area, near ? 0.5 * 20 * sqrt(2) * 0.9 : 0, 1e-12);
        rig_free(&r);
    }
}
END_TEST

/* A corner between two edges, 0.5 under the one and 0.9 over the other: the nearer one is led over it first. */
START_TEST(the_nearest_edge_is_led_over)
{
    for (int turned = 0; turned < 2; turned++) {
        double side = turned ? -1 : 1;
        rig r = rig_make();
        triangle_of(&r, (vec3){-10, 0.9 * side, 0}, (vec3){10, 0.9 * side, 0}, (vec3){0, 20 * side, 0});
        triangle_of(&r, (vec3){10, -0.5 * side, 0}, (vec3){-10, -0.5 * side, 0}, (vec3){0, -20 * side, 0});
        triangle_of(&r, (vec3){0, 0, 0}, (vec3){-3, 0, 20}, (vec3){3, 0, 20});
        seal(&r, 1);
        ck_assert_int_eq(r.report.splits, 2);
        ck_assert_int_eq(r.m.face.count, 5);
        /* The first new triangle is of the nearer edge's, whose apex is vertex 5. */
        const int32_t *v = r.m.face.data[3].v;
        ck_assert(v[0] == 5 || v[1] == 5 || v[2] == 5);
        assert_absolute(r.report.area, 0.5 * 20 * (0.5 + 0.9), 1e-12);
        rig_free(&r);
    }
}
END_TEST

/* Welding takes out what has two corners in one place, whichever two these are. */
START_TEST(welding_takes_out_closed_triangles)
{
    for (int same = 0; same < 3; same++) {
        rig r = rig_make();
        vec3 p[3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
        p[(same + 1) % 3] = vec3_add(p[same], (vec3){1e-6, 0, 0});
        triangle_of(&r, p[0], p[1], p[2]);
        triangle_of(&r, (vec3){0, 0, 5}, (vec3){1, 0, 5}, (vec3){0, 1, 5});
        int32_t joined;
        ck_assert_int_eq(mesh_weld(&r.ctx, &r.m, 1e-3, &joined), FRAM_OK);
        ck_assert_int_eq(joined, 1);
        ck_assert_int_eq(r.m.face.count, 1);
        rig_free(&r);
    }
}
END_TEST

TEST_MAIN("mesh seal", corners_out_of_reach_stay_apart, the_nearest_join_first, fans_of_any_number_of_facets_become_one,
          a_small_hole_is_drawn_together, a_fine_rim_stays_as_it_is, edges_are_led_over_what_is_in_reach,
          the_nearest_edge_is_led_over, welding_takes_out_closed_triangles)
