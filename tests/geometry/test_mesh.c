#include "geometry/mesh.h"
#include "mesh_samples.h"

#define SQUARE_COUNT 4
static const vec2 square[SQUARE_COUNT] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
/* An L of area 3, its reflex corner at (1, 1). */
static const vec2 l_shape[6] = {{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}};

static context plain(void)
{
    context ctx;
    context_init(&ctx);
    return ctx;
}

static void assert_inertia(sym3 actual, sym3 expected, double tolerance)
{
    assert_array_absolute(&actual.xx, &expected.xx, 6, tolerance);
}

START_TEST(box_properties)
{
    context ctx = plain();
    mesh m = {0};
    /* A prism of ice of 10 x 4 x 1 m and 920 kg/m3: tensor of a cuboid in closed form. */
    ck_assert(mesh_make_box(&ctx, (vec3){-5, -2, -0.5}, (vec3){5, 2, 0.5}, &m));
    solid_properties p = mesh_solid_properties(&m);
    assert_relative(p.volume, 40, 1e-15);
    assert_vec3_close(p.centre, ((vec3){0, 0, 0}), 1e-15);
    assert_inertia(
        (sym3){920 * p.inertia.xx, 920 * p.inertia.yy, 920 * p.inertia.zz, p.inertia.xy, p.inertia.xz, p.inertia.yz},
        (sym3){52133.333333333336, 309733.33333333331, 355733.33333333331, 0, 0, 0}, 1e-9);
    mesh_free(&ctx, &m);
}
END_TEST

START_TEST(far_cube_keeps_its_digits)
{
    context ctx = plain();
    mesh m = {0};
    vec3 far = {1048576, -2097152, 524288};
    ck_assert(mesh_make_box(&ctx, far, vec3_add(far, (vec3){1, 1, 1}), &m));
    solid_properties p = mesh_solid_properties(&m);
    assert_relative(p.volume, 1, 1e-15);
    assert_vec3_close(p.centre, vec3_add(far, (vec3){0.5, 0.5, 0.5}), 1e-9);
    assert_inertia(p.inertia, (sym3){1.0 / 6, 1.0 / 6, 1.0 / 6, 0, 0, 0}, 1e-15);
    mesh_free(&ctx, &m);
}
END_TEST

/* Corner tetrahedron of legs a, b, c: V = abc/6, centre at a quarter of the legs, I about the corner
   V/10 (b^2 + c^2, ...), products V/20 ab. */
START_TEST(tilted_tetrahedron_properties)
{
    context ctx = plain();
    mesh m = {0};
    double a = 3, b = 2, c = 1.5, v = a * b * c / 6;
    mesh_add_vertex(&ctx, &m, (vec3){0, 0, 0});
    mesh_add_vertex(&ctx, &m, (vec3){a, 0, 0});
    mesh_add_vertex(&ctx, &m, (vec3){0, b, 0});
    mesh_add_vertex(&ctx, &m, (vec3){0, 0, c});
    mesh_add_triangle(&ctx, &m, 0, 2, 1);
    mesh_add_triangle(&ctx, &m, 0, 1, 3);
    mesh_add_triangle(&ctx, &m, 0, 3, 2);
    mesh_add_triangle(&ctx, &m, 1, 2, 3);
    vec3 g = {a / 4, b / 4, c / 4};
    sym3 expected = {v * ((b * b + c * c) / 10 - (g.y * g.y + g.z * g.z)),
                     v * ((a * a + c * c) / 10 - (g.x * g.x + g.z * g.z)),
                     v * ((a * a + b * b) / 10 - (g.x * g.x + g.y * g.y)),
                     -v * (a * b / 20 - g.x * g.y),
                     -v * (a * c / 20 - g.x * g.z),
                     -v * (b * c / 20 - g.y * g.z)};
    solid_properties p = mesh_solid_properties(&m);
    assert_relative(p.volume, v, 1e-15);
    assert_vec3_close(p.centre, g, 1e-15);
    assert_inertia(p.inertia, expected, 1e-15);
    /* Turned and moved: the tensor turns along. */
    quat q = quat_unit((quat){0.7, 0.1, -0.5, 0.4});
    vec3 shift = {-20, 5, 11};
    sample_move(&m, q, shift);
    p = mesh_solid_properties(&m);
    assert_relative(p.volume, v, 1e-14);
    assert_vec3_close(p.centre, vec3_add(mat3_mul_vec(quat_matrix(q), g), shift), 1e-14);
    assert_inertia(p.inertia, sym3_rotate(expected, quat_matrix(q)), 1e-13);
    vec3 volumes = mesh_volume_integrals(&m);
    assert_vec3_close(volumes, ((vec3){v, v, v}), 1e-13);
    mesh_free(&ctx, &m);
}
END_TEST

START_TEST(a_surface_without_volume)
{
    context ctx = plain();
    mesh m = {0};
    solid_properties p = mesh_solid_properties(&m);
    ck_assert(p.volume == 0 && p.centre.x == 0);
    box3 b = mesh_bounds(&m);
    assert_vec3_close(b.lo, b.hi, 0);
    mesh_add_vertex(&ctx, &m, (vec3){1, 2, 3});
    mesh_add_vertex(&ctx, &m, (vec3){2, 2, 3});
    mesh_add_vertex(&ctx, &m, (vec3){1, 4, 3});
    mesh_add_triangle(&ctx, &m, 0, 1, 2);
    mesh_add_triangle(&ctx, &m, 0, 2, 1);
    p = mesh_solid_properties(&m);
    ck_assert(p.volume == 0 && p.inertia.xx == 0);
    assert_vec3_close(p.centre, ((vec3){1, 2, 3}), 0);
    assert_vec3_close(mesh_area_vector(&m, 0), ((vec3){0, 0, 1}), 0);
    mesh_free(&ctx, &m);
}
END_TEST

/* Open at one side, the three integrals tell. */
START_TEST(volume_integrals_of_an_open_box)
{
    context ctx = plain();
    mesh m = {0};
    ck_assert(mesh_make_box(&ctx, (vec3){1, 1, -3}, (vec3){2, 3, 0}, &m));
    assert_vec3_close(mesh_volume_integrals(&m), ((vec3){6, 6, 6}), 1e-14);
    m.face.count = 10; /* without x = 2 */
    assert_vec3_close(mesh_volume_integrals(&m), ((vec3){-6, 6, 6}), 1e-14);
    mesh_free(&ctx, &m);
}
END_TEST

START_TEST(prism_of_a_square_is_a_box)
{
    context ctx = plain();
    mesh m = {0};
    mesh_report report;
    fram_error error;
    assert_ok(mesh_make_prism(&ctx, (polygon){square, SQUARE_COUNT}, -1, 2, &m, &error), error);
    ck_assert_int_eq(m.vertex.count, 8);
    ck_assert_int_eq(m.face.count, 12);
    ck_assert_int_eq(mesh_check(&ctx, &m, true, &report), FRAM_OK);
    ck_assert_msg(report.defect == MESH_CLOSED, "%s", report.text);
    assert_relative(mesh_solid_properties(&m).volume, 3, 1e-15);
    mesh_free(&ctx, &m);
}
END_TEST

START_TEST(prism_of_an_l)
{
    context ctx = plain();
    mesh m = {0};
    mesh_report report;
    fram_error error;
    /* Begin at every vertex, so that fans and ears are both met; repeat vertices too. */
    for (int first = 0; first < 6; first++) {
        vec2 p[8];
        int n = 0;
        for (int i = 0; i < 6; i++) {
            p[n++] = l_shape[(first + i) % 6];
            if (i == 2 || i == 5)
                p[n++] = l_shape[(first + (i == 2 ? 2 : 0)) % 6]; /* once in a row, once around the end */
        }
        assert_ok(mesh_make_prism(&ctx, (polygon){p, n}, 0, 0.5, &m, &error), error);
        ck_assert_int_eq(m.vertex.count, 12);
        ck_assert_int_eq(m.face.count, 4 * 6 - 4);
        ck_assert_int_eq(mesh_check(&ctx, &m, true, &report), FRAM_OK);
        ck_assert_msg(report.defect == MESH_CLOSED, "%s", report.text);
        solid_properties s = mesh_solid_properties(&m);
        assert_relative(s.volume, 1.5, 1e-15);
        assert_vec3_close(s.centre, ((vec3){5.0 / 6, 5.0 / 6, 0.25}), 1e-15);
    }
    mesh_free(&ctx, &m);
}
END_TEST

START_TEST(prism_with_straight_vertices)
{
    context ctx = plain();
    mesh m = {0};
    mesh_report report;
    fram_error error;
    static const vec2 p[] = {{0, 0}, {1, 0}, {2, 0}, {3, 0}, {3, 1}, {0, 1}};
    assert_ok(mesh_make_prism(&ctx, (polygon){p, 6}, 0, 1, &m, &error), error);
    ck_assert_int_eq(mesh_check(&ctx, &m, true, &report), FRAM_OK);
    ck_assert_msg(report.defect == MESH_CLOSED, "%s", report.text);
    mesh_free(&ctx, &m);
}
END_TEST

START_TEST(prisms_that_are_none)
{
    context ctx = plain();
    mesh m = {0};
    fram_error error;
    static const vec2 clockwise[] = {{0, 0}, {0, 1}, {1, 1}, {1, 0}}, bow_tie[] = {{0, 0}, {1, 1}, {1, 0}, {0, 1}};
    static const vec2 twice[] = {{0, 0}, {0, 0}, {1, 1}};
    assert_fails(mesh_make_prism(&ctx, (polygon){clockwise, 4}, 0, 1, &m, &error), error, FRAM_ERROR_INPUT, "simple");
    assert_fails(mesh_make_prism(&ctx, (polygon){bow_tie, 4}, 0, 1, &m, &error), error, FRAM_ERROR_INPUT, "simple");
    assert_fails(mesh_make_prism(&ctx, (polygon){twice, 3}, 0, 1, &m, &error), error, FRAM_ERROR_INPUT, "simple");
    assert_fails(mesh_make_prism(&ctx, (polygon){square, 2}, 0, 1, &m, &error), error, FRAM_ERROR_INPUT, "2 vertices");
    assert_fails(mesh_make_prism(&ctx, (polygon){square, 4}, 1, 1, &m, &error), error, FRAM_ERROR_INPUT, "no height");
    assert_fails(mesh_make_prism(&ctx, (polygon){square, 4}, 0, (double)NAN, &m, &error), error, FRAM_ERROR_INPUT,
                 "no height");
    ck_assert_int_eq(m.vertex.count, 0);
    ck_assert_int_eq(m.face.count, 0);
    mesh_free(&ctx, &m);
}
END_TEST

START_TEST(triangles_below_a_level)
{
    vec3 t[3] = {{0, 0, 0}, {4, 0, 0}, {0, 0, 2}}, out[4];
    ck_assert_int_eq(triangle_clip_below(t, 2, out), 3); /* the top vertex is on the plane */
    ck_assert_int_eq(triangle_clip_below(t, 1, out), 4);
    assert_vec3_close(out[2], ((vec3){2, 0, 1}), 0);
    assert_vec3_close(out[3], ((vec3){0, 0, 1}), 0);
    ck_assert_int_eq(triangle_clip_below(t, 0, out), 2); /* an edge only */
    ck_assert_int_eq(triangle_clip_below(t, -0.1, out), 0);
    vec3 down[3] = {{0, 0, 0}, {1, 0, 3}, {0, 1, 3}};
    ck_assert_int_eq(triangle_clip_below(down, 1, out), 3);
    assert_vec3_close(out[1], ((vec3){1.0 / 3, 0, 1}), 1e-16);
    ck_assert_int_eq(triangle_clip_below(down, 0, out), 1); /* a point only */
    /* Neighbours are cut at the same point to the bit. */
    vec3 p = {0.1, 0.7, -0.33}, q = {1.3, -0.2, 0.77}, left[4], right[4];
    vec3 a[3] = {p, q, {5, 5, 5}}, b[3] = {q, p, {-5, -5, 5}};
    ck_assert_int_eq(triangle_clip_below(a, 0.123, left), 3);
    ck_assert_int_eq(triangle_clip_below(b, 0.123, right), 3);
    assert_array_bits(&left[1].x, &right[0].x, 3);
    assert_bits(left[1].z, 0.123);
}
END_TEST

START_TEST(facets_below_a_plane)
{
    vec3 quad[4] = {{0, 0, 1}, {2, 0, 1}, {2, 2, 1}, {0, 2, 1}}, out[5];
    vec3 diagonal = {1, 1, 0};
    ck_assert_int_eq(facet_clip(quad, 4, diagonal, 3, out), 5);
    assert_vec3_close(out[3], ((vec3){1, 2, 1}), 0);
    ck_assert_int_eq(facet_clip(quad, 4, diagonal, 1, out), 3);
    ck_assert_int_eq(facet_clip(quad, 4, diagonal, 2, out), 3); /* along the diagonal */
    ck_assert_int_eq(facet_clip(quad, 4, diagonal, 4, out), 4);
    ck_assert_int_eq(facet_clip(quad, 4, diagonal, 0, out), 1);
    ck_assert_int_eq(facet_clip(quad, 4, diagonal, -1, out), 0);
    ck_assert_int_eq(facet_clip(quad, 0, diagonal, 1, out), 0);
    /* What no convex facet is: in and out twice.  The result is cut off, never written past its room. */
    vec3 zigzag[4] = {{0, 0, 0}, {1, 2, 0}, {2, 0, 0}, {1, 3, 0}};
    ck_assert_int_le(facet_clip(zigzag, 4, (vec3){0, 1, 0}, 1, out), 5);
}
END_TEST

START_TEST(weld_joins_what_is_near)
{
    context ctx = plain();
    mesh box = {0}, m = {0};
    mesh_report report;
    int32_t joined;
    ck_assert(mesh_make_box(&ctx, (vec3){0, 0, 0}, (vec3){1, 2, 3}, &box));
    /* Triangles with vertices of their own, as in an STL file, each moved a little. */
    random_stream r = random_begin(1, 1, 1);
    for (int32_t f = 0; f < box.face.count; f++) {
        for (int k = 0; k < 3; k++) {
            vec3 noise = {random_uniform(&r, -1, 1), random_uniform(&r, -1, 1), random_uniform(&r, -1, 1)};
            mesh_add_vertex(&ctx, &m, vec3_mad(box.vertex.data[box.face.data[f].v[k]], noise, 1e-4));
        }
        mesh_add_triangle(&ctx, &m, 3 * f, 3 * f + 1, 3 * f + 2);
    }
    mesh_add_vertex(&ctx, &m, (vec3){(double)NAN, 0, 0});
    mesh_add_triangle(&ctx, &m, 0, 1, 1);
    vec3 first = m.vertex.data[0];
    ck_assert_int_eq(mesh_weld(&ctx, &m, 1e-6, &joined), FRAM_OK);
    ck_assert_int_eq(joined, 0);
    ck_assert_int_eq(mesh_weld(&ctx, &m, 1e-3, &joined), FRAM_OK);
    ck_assert_int_eq(joined, 36 - 8);
    ck_assert_int_eq(m.vertex.count, 9); /* the one that is not a number stays */
    ck_assert_int_eq(m.face.count, 12);
    assert_array_bits(&m.vertex.data[0].x, &first.x, 3);
    ck_assert_int_eq(mesh_check(&ctx, &m, true, &report), FRAM_OK);
    ck_assert_msg(report.defect == MESH_CLOSED, "%s", report.text);
    /* Everything into one point: no triangle is left. */
    ck_assert_int_eq(mesh_weld(&ctx, &m, 10, &joined), FRAM_OK);
    ck_assert_int_eq(m.vertex.count, 2);
    ck_assert_int_eq(m.face.count, 0);
    mesh_free(&ctx, &box);
    mesh_free(&ctx, &m);
}
END_TEST

/* A row of points one step apart does not creep into one. */
START_TEST(weld_does_not_chain)
{
    context ctx = plain();
    mesh m = {0};
    int32_t joined;
    for (int i = 0; i < 10; i++)
        mesh_add_vertex(&ctx, &m, (vec3){-0.6 * i, 0, 0});
    ck_assert_int_eq(mesh_weld(&ctx, &m, 1, &joined), FRAM_OK);
    ck_assert_int_eq(joined, 5);
    for (int i = 0; i < m.vertex.count; i++)
        assert_absolute(m.vertex.data[i].x, -1.2 * i, 1e-15);
    mesh_clear(&m);
    ck_assert_int_eq(mesh_weld(&ctx, &m, 1, &joined), FRAM_OK);
    ck_assert_int_eq(joined, 0);
    mesh_free(&ctx, &m);
}
END_TEST

START_TEST(neighbours_across_edges)
{
    context ctx = plain();
    mesh m = {0};
    mesh_adjacency a = {0};
    ck_assert(mesh_make_box(&ctx, (vec3){0, 0, 0}, (vec3){1, 1, 1}, &m));
    ck_assert_int_eq(mesh_adjacency_build(&ctx, &m, &a), FRAM_OK);
    ck_assert_int_eq(a.neighbour.count, 36);
    for (int32_t f = 0; f < 12; f++)
        for (int k = 0; k < 3; k++) {
            int32_t g = a.neighbour.data[3 * f + k];
            ck_assert_int_ge(g, 0);
            int back = mesh_edge_to(&a, g, f);
            ck_assert_int_ge(back, 0);
            ck_assert_int_eq(m.face.data[g].v[back], m.face.data[f].v[(k + 1) % 3]);
            ck_assert_int_eq(m.face.data[g].v[(back + 1) % 3], m.face.data[f].v[k]);
        }
    ck_assert_int_eq(mesh_edge_to(&a, 0, 3), -1);
    m.face.count = 11;
    ck_assert_int_eq(mesh_adjacency_build(&ctx, &m, &a), FRAM_OK);
    ck_assert_int_eq(a.neighbour.data[3 * 2 + 1], -1);
    /* Three faces at one edge: none of them has a neighbour there. */
    mesh_add_triangle(&ctx, &m, 0, 3, 5);
    ck_assert_int_eq(mesh_adjacency_build(&ctx, &m, &a), FRAM_OK);
    ck_assert_int_eq(a.neighbour.data[3 * 0 + 2], -1);
    mesh_adjacency_free(&ctx, &a);
    mesh_free(&ctx, &m);
}
END_TEST

/* Everything in this file that allocates. */
static fram_status use_all(context *ctx, const mesh *sphere)
{
    fram_error error;
    mesh m = {0}, prism = {0};
    mesh_adjacency a = {0};
    int32_t joined;
    fram_status status = mesh_copy(ctx, &m, sphere) && mesh_make_box(ctx, (vec3){0, 0, 0}, (vec3){1, 1, 1}, &prism)
                             ? FRAM_OK
                             : FRAM_ERROR_MEMORY;
    if (status == FRAM_OK)
        status = mesh_weld(ctx, &m, 0.1, &joined);
    if (status == FRAM_OK)
        status = mesh_adjacency_build(ctx, &m, &a);
    if (status == FRAM_OK)
        status = mesh_make_prism(ctx, (polygon){l_shape, 6}, 0, 1, &prism, &error);
    if (status == FRAM_OK)
        status = mesh_make_prism(ctx, (polygon){square, SQUARE_COUNT}, 0, 1, &prism, &error);
    mesh_adjacency_free(ctx, &a);
    mesh_free(ctx, &prism);
    mesh_free(ctx, &m);
    return status;
}

START_TEST(memory_runs_out)
{
    context ctx = plain();
    mesh sphere = {0};
    sample_sphere_mesh(&ctx, 9, 9, 1, &sphere);
    for (failing_turn turn = {0}; failing_next(&turn);)
        turn.status = use_all(&turn.ctx, &sphere);
    mesh_free(&ctx, &sphere);
}
END_TEST

TEST_MAIN("mesh", box_properties, far_cube_keeps_its_digits, tilted_tetrahedron_properties, a_surface_without_volume,
          volume_integrals_of_an_open_box, prism_of_a_square_is_a_box, prism_of_an_l, prism_with_straight_vertices,
          prisms_that_are_none, triangles_below_a_level, facets_below_a_plane, weld_joins_what_is_near,
          weld_does_not_chain, neighbours_across_edges, memory_runs_out)
