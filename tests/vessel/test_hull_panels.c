/* Panels of a hull: every point of the surface belongs to one, of the chosen size where the surface is flat, sloping or
   not; two places of the hull never share one (flat bows, flat bottoms, two hulls beside each other); slivers join. */
#include "testing.h"
#include "vessel/hull.h"
#include "vessel/hull_panels.h"

static double surface_of(const mesh *m)
{
    double sum = 0;
    for (int32_t f = 0; f < m->face.count; f++)
        sum += vec3_length(mesh_area_vector(m, f));
    return sum;
}

static void make(context *ctx, const mesh *m, const panel_rules *rules, hull_panels *p)
{
    fram_error error = {0};
    assert_ok(hull_panels_make(ctx, m, rules, p, &error), error);
    for (int32_t f = 0; f < p->triangle.face.count; f++) {
        vec3 c[3];
        mesh_face_points(&p->triangle, f, c);
        double around =
            vec3_length(vec3_sub(c[1], c[0])) + vec3_length(vec3_sub(c[2], c[1])) + vec3_length(vec3_sub(c[0], c[2]));
        ck_assert_msg(vec3_length(mesh_area_vector(&p->triangle, f)) > 1e-12 * around, "triangle %d has no area",
                      (int)f);
    }
    assert_relative(surface_of(&p->triangle), surface_of(m), 1e-12);
}

static double sum_of(const hull_panels *p)
{
    double sum = 0;
    for (int32_t i = 0; i < p->panel.count; i++)
        sum += p->panel.data[i].area;
    return sum;
}

static int32_t count_of(const hull_panels *p, hull_side side)
{
    int32_t count = 0;
    for (int32_t i = 0; i < p->panel.count; i++)
        count += p->panel.data[i].side == side;
    return count;
}

static const hull_panel *at(hull_panels *p, vec3 point, vec3 outward)
{
    int32_t panel = hull_panel_at(p, point, outward);
    ck_assert(panel >= 0);
    return &p->panel.data[panel];
}

/* A box of 40 x 20 x 7 m in panels of 2 m: 20 x 3.5 a side, of which the rows are 2, 2, 2 and 1 m. */
START_TEST(box)
{
    context ctx;
    context_init(&ctx);
    mesh m = {0};
    hull_panels p;
    ck_assert(mesh_make_box(&ctx, (vec3){-20, -10, -4}, (vec3){20, 10, 3}, &m));
    make(&ctx, &m, &(panel_rules){.size = 2}, &p);
    assert_absolute(sum_of(&p), surface_of(&m), 1e-9);
    ck_assert_int_eq(count_of(&p, SIDE_PORT), 20 * 4);
    ck_assert_int_eq(count_of(&p, SIDE_BOW), 10 * 4);
    ck_assert_int_eq(count_of(&p, SIDE_BOTTOM), 200);
    const hull_panel *one = at(&p, (vec3){19.9, 3.1, -0.4}, (vec3){1, 0, 0});
    ck_assert_int_eq(one->side, SIDE_BOW);
    assert_absolute(one->area, 4, 1e-12);
    assert_absolute(one->bounds.lo.y, 2, 1e-12);
    assert_absolute(one->bounds.hi.y, 4, 1e-12);
    assert_absolute(one->bounds.lo.z, -2, 1e-12);
    assert_absolute(one->bounds.hi.z, 0, 1e-12);
    assert_absolute(one->normal.x, 1, 1e-12);
    /* In the corner the direction decides. */
    ck_assert_int_eq(at(&p, (vec3){19.9, 9.8, -0.4}, (vec3){0, 1, 0})->side, SIDE_PORT);
    ck_assert_int_eq(at(&p, (vec3){19.9, 9.8, -0.4}, (vec3){1, 0, 0})->side, SIDE_BOW);
    ck_assert_int_eq(at(&p, (vec3){0.3, 9.8, -3.9}, (vec3){0, 0, -1})->side, SIDE_BOTTOM);
    hull_panels_free(&ctx, &p);
    mesh_free(&ctx, &m);
}
END_TEST

/* A ridge along a panel line: corners that lie on it are those of facets to both sides, which have them once or twice,
   and what has no area looks along no direction and along all of them. */
START_TEST(corners_on_panel_lines)
{
    const double heights[] = {2, 1.9999999, 2 + 1e-12, 0.7};
    for (int i = 0; i < 4; i++) {
        context ctx;
        context_init(&ctx);
        mesh m = {0};
        hull_panels p;
        fram_error error = {0};
        const vec2 side[] = {{-20, -4}, {14, -4}, {20, heights[i]}, {20, 4}, {-20, 4}, {-20, 0}};
        ck_assert_int_eq(mesh_make_prism(&ctx, (polygon){side, 6}, -6, 6, &m, &error), FRAM_OK);
        for (int32_t v = 0; v < m.vertex.count; v++) {
            vec3 q = m.vertex.data[v];
            m.vertex.data[v] = (vec3){q.x, -q.z, q.y};
        }
        make(&ctx, &m, &(panel_rules){.size = 2}, &p);
        hull_panels_free(&ctx, &p);
        mesh_free(&ctx, &m);
    }
}
END_TEST

/* Two boxes in one mesh: the inner side of one and the outer side of the other both look to port. */
START_TEST(two_hulls)
{
    context ctx;
    context_init(&ctx);
    mesh m = {0}, other = {0};
    hull_panels p;
    ck_assert(mesh_make_box(&ctx, (vec3){-20, 6, -4}, (vec3){20, 10, 3}, &m));
    ck_assert(mesh_make_box(&ctx, (vec3){-20, -10, -4}, (vec3){20, -6, 3}, &other));
    for (int32_t v = 0; v < other.vertex.count; v++)
        ck_assert(mesh_add_vertex(&ctx, &m, other.vertex.data[v]));
    for (int32_t f = 0; f < other.face.count; f++) {
        const int32_t *v = other.face.data[f].v;
        ck_assert(mesh_add_triangle(&ctx, &m, v[0] + 8, v[1] + 8, v[2] + 8));
    }
    make(&ctx, &m, &(panel_rules){.size = 2}, &p);
    assert_absolute(sum_of(&p), surface_of(&m), 1e-9);
    ck_assert_int_eq(count_of(&p, SIDE_PORT), 2 * 20 * 4);
    for (int32_t i = 0; i < p.panel.count; i++)
        ck_assert_double_le(p.panel.data[i].area, 4 + 1e-9);
    const hull_panel *outer = at(&p, (vec3){5, 9.9, -1}, (vec3){0, 1, 0});
    const hull_panel *inner = at(&p, (vec3){5, -6.1, -1}, (vec3){0, 1, 0});
    assert_absolute(outer->centre.y, 10, 1e-12);
    assert_absolute(inner->centre.y, -6, 1e-12);
    ck_assert_int_ne(outer->patch, inner->patch);
    hull_panels_free(&ctx, &p);
    mesh_free(&ctx, &m);
    mesh_free(&ctx, &other);
}
END_TEST

/* A bow of 30 degrees against the water: whole panels of its plane have 1 m2 along the slope. */
START_TEST(sloping_bow)
{
    context ctx;
    context_init(&ctx);
    const vec2 side[] = {{-20, -4}, {14.93, -4}, {20, 1}, {20, 3}, {-20, 3}};
    mesh m = {0};
    hull_panels p;
    /* The side view extruded across the ship: the prism's z becomes -y, its y z. */
    fram_error error = {0};
    ck_assert_int_eq(mesh_make_prism(&ctx, (polygon){side, 5}, -6, 6, &m, &error), FRAM_OK);
    for (int32_t v = 0; v < m.vertex.count; v++) {
        vec3 q = m.vertex.data[v];
        m.vertex.data[v] = (vec3){q.x, -q.z, q.y};
    }
    make(&ctx, &m, &(panel_rules){.size = 1}, &p);
    assert_relative(sum_of(&p), surface_of(&m), 1e-12);
    double slope = 5 / 5.07;
    int32_t whole = 0;
    for (int32_t i = 0; i < p.panel.count; i++) {
        const hull_panel *q = &p.panel.data[i];
        ck_assert_double_ge(q->area, 0.25 * (1 - 1e-9));
        /* In a corner two slivers may join one panel. */
        ck_assert_double_le(q->area, 1.5 + 1e-9);
        whole += fabs(q->normal.x + slope * q->normal.z) < 1e-9 && fabs(q->area - 1) < 1e-9;
    }
    /* 7.12 m up the slope, 12 m across: 6 rows at least are whole. */
    ck_assert_int_ge(whole, 6 * 12);
    hull_panels_free(&ctx, &p);
    mesh_free(&ctx, &m);
}
END_TEST

/* An icebreaker: every panel found from its own facets, halves mirror each other, nothing is a sliver. */
START_TEST(icebreaker)
{
    context ctx;
    context_init(&ctx);
    mesh m = {0};
    polyhedron_array pieces = {0};
    fram_error error = {0};
    const hull_particulars h = {.form = HULL_ICEBREAKER,
                                .length = 60,
                                .beam = 14,
                                .draught = 5,
                                .freeboard = 3,
                                .stem_angle = 0.5236,
                                .entrance_angle = 0.5585,
                                .flare_angle = 0.1745,
                                .stern_angle = 0.5236,
                                .parallel_midbody = 0.45};
    assert_ok(hull_make(&ctx, &h, &m, &pieces, &error), error);
    hull_panels p;
    make(&ctx, &m, &(panel_rules){.size = 1.5}, &p);
    assert_relative(sum_of(&p), surface_of(&m), 1e-12);
    ck_assert_int_eq(count_of(&p, SIDE_PORT), count_of(&p, SIDE_STARBOARD));
    for (int32_t i = 0; i < p.facet.count; i++) {
        const panel_facet *f = &p.facet.data[i];
        vec3 middle = {0, 0, 0};
        for (int32_t k = 0; k < f->count; k++)
            middle = vec3_mad(middle, p.corner.data[f->first + k], 1.0 / f->count);
        vec3 n = mesh_area_vector(&m, f->face);
        ck_assert_int_eq(hull_panel_at(&p, middle, vec3_scale(n, 1 / vec3_length(n))), f->panel);
    }
    hull_panels_free(&ctx, &p);
    polyhedron_array_free(&ctx, &pieces);
    mesh_free(&ctx, &m);
}
END_TEST

/* Frames at -10, 0, 5 and stringers at -2 and 1 cut the side in 4 x 3 panels, the bow in rows of 3. */
START_TEST(own_lines)
{
    context ctx;
    context_init(&ctx);
    mesh m = {0};
    hull_panels p;
    const double frames[] = {-10, 0, 5}, stringers[] = {-2, 1};
    ck_assert(mesh_make_box(&ctx, (vec3){-20, -10, -4}, (vec3){20, 10, 3}, &m));
    make(&ctx, &m,
         &(panel_rules){.size = 4, .frame = frames, .frame_count = 3, .stringer = stringers, .stringer_count = 2}, &p);
    assert_absolute(sum_of(&p), surface_of(&m), 1e-9);
    ck_assert_int_eq(count_of(&p, SIDE_STARBOARD), 4 * 3);
    ck_assert_int_eq(count_of(&p, SIDE_BOW), 6 * 3);
    ck_assert_int_eq(count_of(&p, SIDE_BOTTOM), 4 * 6);
    const hull_panel *q = at(&p, (vec3){3, -10, 0}, (vec3){0, -1, 0});
    assert_absolute(q->area, 5 * 3, 1e-12);
    hull_panels_free(&ctx, &p);
    mesh_free(&ctx, &m);
}
END_TEST

START_TEST(refusals)
{
    context ctx;
    context_init(&ctx);
    mesh m = {0};
    hull_panels p;
    const double falling[] = {1, 0}, none[] = {NAN}, beyond[] = {20, 2000}, below[] = {-40, -4};
    ck_assert(mesh_make_box(&ctx, (vec3){-20, -10, -4}, (vec3){20, 10, 3}, &m));
    const struct {
        panel_rules rules;
        const char *key;
    } bad[] = {
        {{.size = 0}, "panel"},
        {{.size = -1}, "panel"},
        {{.size = NAN}, "panel"},
        {{.size = 40.1}, "panel"},
        {{.size = 1e-9}, "panel"},
        {{.size = 0.05}, "panel"},
        {{.size = 1, .frame = falling, .frame_count = 2}, "frames"},
        {{.size = 1, .stringer = none, .stringer_count = 1}, "stringers"},
        {{.size = 1, .frame = beyond, .frame_count = 2}, "frames"},
        {{.size = 1, .stringer = below, .stringer_count = 2}, "stringers"},
    };
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        fram_error error = {0};
        ck_assert_int_eq(hull_panels_make(&ctx, &m, &bad[i].rules, &p, &error), FRAM_ERROR_INPUT);
        ck_assert_str_eq(error.key, bad[i].key);
        ck_assert_int_eq(p.panel.count, 0);
    }
    mesh_free(&ctx, &m);
}
END_TEST

START_TEST(memory_runs_out)
{
    for (failing_turn turn = {0}; failing_next(&turn);) {
        context plain;
        mesh m = {0};
        hull_panels p;
        context_init(&plain);
        ck_assert(mesh_make_box(&plain, (vec3){-20, -10, -4}, (vec3){20, 10, 3}, &m));
        turn.status = hull_panels_make(&turn.ctx, &m, &(panel_rules){.size = 6}, &p, &turn.error);
        hull_panels_free(&turn.ctx, &p);
        mesh_free(&plain, &m);
    }
}
END_TEST

TEST_MAIN("hull panels", box, corners_on_panel_lines, two_hulls, sloping_bow, icebreaker, own_lines, refusals,
          memory_runs_out)
